//! CVODE, in a program of its own (`cvode/cvode.c`) whose path is given.

use crate::case::Case;
use crate::solution::{Solution, Timing};
use std::path::{Path, PathBuf};
use std::process::Command;

/// The methods.
pub(crate) const METHODS: [&str; 2] = ["adams", "bdf"];

/// The program.
#[derive(Clone, Debug)]
pub(crate) struct Cvode {
    program: PathBuf,
}

impl Cvode {
    /// At a path.
    pub(crate) fn at(program: &Path) -> Self {
        Self {
            program: program.to_owned(),
        }
    }

    /// Solves a case, repeated for `budget` seconds (0: once).
    ///
    /// # Errors
    /// The program cannot be run, or the solver fails.
    pub(crate) fn solve(
        &self,
        case: &Case,
        method: &str,
        tolerance: f64,
        budget: f64,
    ) -> Result<(Solution, Timing), String> {
        let chain = &case.chain;
        let psi = if chain.damping[0] == 0.0 { 0.0 } else { 0.4 };
        let numbers = [
            chain.masses.to_string(),
            chain.load.to_string(),
            psi.to_string(),
            chain.duration.to_string(),
            method.to_owned(),
            tolerance.to_string(),
            budget.to_string(),
        ];
        let text = self.output("case", &numbers)?;
        let mut lines = text.lines();
        let head = numbers_of(lines.next().unwrap_or_default())?;
        let &[least, median, runs, steps, switches] = head.as_slice() else {
            return Err(format!("cvode: {text:.80}"));
        };
        let solution = Solution {
            samples: lines.map(number).collect::<Result<_, _>>()?,
            switches: Some(switches as usize),
            steps: steps as u64,
            ..Solution::default()
        };
        let timing = Timing {
            least,
            median,
            runs: runs as usize,
        };
        Ok((solution, timing))
    }

    /// Wall time (s) of the map and max|δ| of its cells.
    ///
    /// # Errors
    /// The program cannot be run.
    pub(crate) fn map(
        &self,
        method: &str,
        tolerance: f64,
        cells: usize,
    ) -> Result<(f64, Vec<f64>), String> {
        let numbers = [method.to_owned(), tolerance.to_string(), cells.to_string()];
        let text = self.output("map", &numbers)?;
        let values: Vec<f64> = text.lines().map(number).collect::<Result<_, _>>()?;
        let (time, peaks) = values.split_first().ok_or("cvode: no output")?;
        Ok((*time, peaks.to_vec()))
    }

    /// Standard output of the program.
    ///
    /// # Errors
    /// It cannot be run, or ends with a failure.
    pub(crate) fn output(&self, command: &str, numbers: &[String]) -> Result<String, String> {
        let output = Command::new(&self.program)
            .arg(command)
            .args(numbers)
            .output()
            .map_err(|error| format!("{}: {error}", self.program.display()))?;
        let text = String::from_utf8_lossy(&output.stdout).into_owned();
        if output.status.success() {
            Ok(text)
        } else {
            Err(format!("cvode: {} {text:.80}", output.status))
        }
    }
}

/// The numbers of a line.
pub(crate) fn numbers_of(line: &str) -> Result<Vec<f64>, String> {
    line.split_whitespace().map(number).collect()
}

fn number(text: &str) -> Result<f64, String> {
    text.parse()
        .map_err(|error| format!("cvode printed `{text}`: {error}"))
}
