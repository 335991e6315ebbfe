//! A torque-driven press with an elastic shaft and an elastic rocker that lifts
//! off: what `auto` picks, against the general solvers.

mod diffsol;
mod ode_solvers;
mod own;
mod scene;

use crate::case::SAMPLES;
use crate::cvode_peer::{Cvode, numbers_of};
use crate::ladder::{Climb, Point, Reached, Runner, climb};
use crate::solution::{Solution, Timing};
use crate::table::{milliseconds, power, reached, table};
use dam::integrate::{Dynamics, Method};
pub(crate) use scene::Press;
use std::time::{Duration, Instant};

/// Errors to be reached.
const TARGETS: [f64; 3] = [1e-4, 1e-6, 1e-8];

/// How many times faster `auto` is meant to be than the best of the others.
const AIM: f64 = 3.0;

/// Numbers of masses of the ejector: as the scene has it, and a finer one.
const MASSES: [usize; 2] = [5, 10];

const ABOUT: &str = "\
`scenarios/press/ejector.json`: motor by Kloss, belt and flywheel, elastic crankshaft, ram,
and an elastic lever behind an eccentric that lifts off and strikes back. From the model ready to
1000 samples of δ of the lever and its switches. diffsol and ode_solvers are given `dam`'s own
right-hand side (and its derivative), CVODE the equations written by hand with a dense Jacobian by
differences. Errors are relative to max|δ|.
";

/// Who solves.
enum Solver<'a> {
    Auto,
    Own(Method),
    Diffsol(&'static str),
    OdeSolvers(&'static str),
    Cvode(&'a Cvode, &'static str),
}

impl Solver<'_> {
    fn name(&self) -> String {
        match self {
            Self::Auto => "`dam` auto".to_owned(),
            Self::Own(method) => format!("`dam` {method}"),
            Self::Diffsol(method) => format!("diffsol {method}"),
            Self::OdeSolvers(method) => format!("ode_solvers {method}"),
            Self::Cvode(_, method) => format!("CVODE {method}"),
        }
    }

    fn is_own(&self) -> bool {
        matches!(self, Self::Auto | Self::Own(_))
    }
}

/// A solver on the press.
struct OnPress<'a> {
    solver: &'a Solver<'a>,
    press: &'a Press,
    masses: usize,
    reference: &'a [f64],
}

impl OnPress<'_> {
    fn cvode(
        &self,
        cvode: &Cvode,
        method: &str,
        tolerance: f64,
        budget: f64,
    ) -> Result<(Solution, Timing), String> {
        let mut numbers = vec![
            self.masses.to_string(),
            method.to_owned(),
            tolerance.to_string(),
            budget.to_string(),
        ];
        let scales = self.press.in_order(self.press.system.scales());
        numbers.extend(scales.iter().map(f64::to_string));
        let text = cvode.output("press", &numbers)?;
        let mut lines = text.lines();
        let head = numbers_of(lines.next().unwrap_or_default())?;
        let &[least, median, runs, steps, switches] = head.as_slice() else {
            return Err(format!("cvode: {text:.80}"));
        };
        let samples: Result<Vec<f64>, _> = lines.map(str::parse).collect();
        let solution = Solution {
            samples: samples.map_err(|error| error.to_string())?,
            switches: Some(switches as usize),
            steps: steps as u64,
            ..Solution::default()
        };
        let runs = runs as usize;
        Ok((
            solution,
            Timing {
                least,
                median,
                runs,
            },
        ))
    }
}

impl Runner for OnPress<'_> {
    fn solve(&self, tolerance: f64) -> Result<(Solution, f64), String> {
        let press = self.press;
        // The choice costs nothing that a user would see; it is not timed.
        let method = match self.solver {
            Solver::Auto => Some(own::choice(press, tolerance)?),
            Solver::Own(method) => Some(*method),
            _ => None,
        };
        let begin = Instant::now();
        let solution = match (self.solver, method) {
            (_, Some(method)) => own::solve(press, method, tolerance, SAMPLES)?,
            (Solver::Diffsol(method), _) => diffsol::solve(press, method, tolerance, SAMPLES)?,
            (Solver::OdeSolvers(method), _) => {
                ode_solvers::solve(press, method, tolerance, SAMPLES)?
            }
            (Solver::Cvode(cvode, method), _) => {
                let (solution, timing) = self.cvode(cvode, method, tolerance, 0.0)?;
                return Ok((solution, timing.median));
            }
            (Solver::Auto | Solver::Own(_), None) => return Err("no method".to_owned()),
        };
        Ok((solution, begin.elapsed().as_secs_f64()))
    }

    fn error(&self, samples: &[f64]) -> f64 {
        distance(samples, self.reference)
    }

    fn time(&self, tolerance: f64, budget: Duration) -> Option<Timing> {
        match self.solver {
            Solver::Cvode(cvode, method) => {
                let timed = self.cvode(cvode, method, tolerance, budget.as_secs_f64());
                timed.ok().map(|(_, timing)| timing)
            }
            Solver::Auto => {
                let method = own::choice(self.press, tolerance).ok()?;
                let run = || own::solve(self.press, method, tolerance, SAMPLES).is_ok();
                Some(Timing::measure(budget, run))
            }
            _ => Some(Timing::measure(budget, || self.solve(tolerance).is_ok())),
        }
    }
}

/// Greatest difference relative to the greatest value.
fn distance(samples: &[f64], reference: &[f64]) -> f64 {
    let largest = reference.iter().fold(0.0, |m: f64, q| m.max(q.abs()));
    let differences = samples.iter().zip(reference).map(|(s, r)| (s - r).abs());
    let greatest = differences.fold(
        0.0,
        |m: f64, d| if d.is_nan() { f64::INFINITY } else { m.max(d) },
    );
    greatest / largest
}

/// A fine solution by two unrelated methods.
pub(crate) struct Fine {
    /// Samples of the first.
    pub(crate) samples: Vec<f64>,
    /// How far the other is from it, relative to max|δ|.
    pub(crate) apart: f64,
    /// Switches of both.
    pub(crate) switches: [usize; 2],
}

/// The fine solution.
///
/// # Errors
/// One of the methods fails.
pub(crate) fn fine(press: &Press) -> Result<Fine, String> {
    let one = own::solve(press, Method::Dop853, 1e-13, SAMPLES)?;
    let other = diffsol::solve(press, "tsit45", 1e-12, SAMPLES)?;
    Ok(Fine {
        apart: distance(&other.samples, &one.samples),
        switches: [one.switches, other.switches].map(Option::unwrap_or_default),
        samples: one.samples,
    })
}

/// Runs the press and returns the tables.
///
/// # Errors
/// The fine solutions do not agree.
pub(crate) fn press(cvode: Option<&Cvode>, quick: bool) -> Result<String, String> {
    let mut text = format!("## Press\n\n{ABOUT}");
    for masses in &MASSES[..if quick { 1 } else { 2 }] {
        text += &one_press(*masses, cvode, quick)?;
    }
    Ok(text + &cost_per_step()?)
}

fn one_press(masses: usize, cvode: Option<&Cvode>, quick: bool) -> Result<String, String> {
    let press = Press::new(masses)?;
    let Fine {
        samples: reference,
        apart,
        switches,
    } = fine(&press)?;
    if apart > 0.1 * TARGETS[2] || switches[0] != switches[1] {
        return Err(format!(
            "press of {masses}: the fine solutions are {apart:.1e} apart, {switches:?} switches"
        ));
    }
    let mut solvers = vec![
        Solver::Auto,
        Solver::Own(Method::Radau),
        Solver::Own(Method::Rodas5p),
        Solver::Own(Method::Taylor),
        Solver::Diffsol("bdf"),
        Solver::Diffsol("esdirk34"),
        Solver::Diffsol("tsit45"),
        Solver::OdeSolvers("dop853"),
        Solver::OdeSolvers("dopri5"),
    ];
    if let Some(cvode) = cvode {
        solvers.extend(["bdf", "adams"].map(|method| Solver::Cvode(cvode, method)));
    }
    let mut points: Vec<(&Solver<'_>, Vec<Reached>)> = Vec::new();
    for solver in &solvers {
        let runner = OnPress {
            solver,
            press: &press,
            masses,
            reference: &reference,
        };
        // A climb is given up when a single run takes twelve times as long as
        // `auto` at the smallest error.
        let auto = points.first().and_then(|auto| auto.1[2].as_ref().ok());
        let limits = Climb {
            budget: Duration::from_millis(if quick { 50 } else { 200 }),
            longest: auto.map_or(3.0, |point| (12.0 * point.timing.median).max(0.2)),
        };
        points.push((solver, climb(&runner, &TARGETS, limits)));
    }
    Ok(format!(
        "\n### {masses} masses\n\nTwo fine solutions (`dam` dop853 at 1e-13, diffsol tsit45 at 1e-12) \
         agree to {apart:.1e}; {} switches.\n\n{}\n{}",
        switches[0],
        ratios(&press, &points)?,
        details(&points)
    ))
}

/// `auto` against the best of the others at every error.
fn ratios(press: &Press, points: &[(&Solver<'_>, Vec<Reached>)]) -> Result<String, String> {
    let head = [
        "error",
        "`auto` picks",
        "ms",
        "best other",
        "ms",
        "ratio (aim)",
        "by least times",
    ];
    let mut rows = Vec::new();
    for (index, target) in TARGETS.iter().enumerate() {
        let of = |entry: &(&Solver<'_>, Vec<Reached>)| -> Option<(String, Point)> {
            Some((entry.0.name(), entry.1[index].ok()?))
        };
        let others = points.iter().filter(|entry| !entry.0.is_own());
        let median = |point: &Point| point.timing.median;
        let best = others
            .filter_map(of)
            .min_by(|a, b| median(&a.1).total_cmp(&median(&b.1)));
        let (Some((_, auto)), Some((name, best))) = (of(&points[0]), best) else {
            rows.push(vec![power(*target); 1]);
            rows.last_mut()
                .expect("just pushed")
                .extend(std::iter::repeat_n("not reached".to_owned(), 6));
            continue;
        };
        rows.push(vec![
            power(*target),
            own::choice(press, auto.tolerance)?.to_string(),
            milliseconds(median(&auto)),
            name,
            milliseconds(median(&best)),
            format!("{:.1} ({AIM})", median(&best) / median(&auto)),
            format!("{:.1}", best.timing.least / auto.timing.least),
        ]);
    }
    Ok(table(&head.map(str::to_owned), &rows))
}

fn details(points: &[(&Solver<'_>, Vec<Reached>)]) -> String {
    let head = [
        "solver",
        "error asked",
        "tolerance",
        "error reached",
        "switches",
        "median, ms",
        "least, ms",
        "runs",
    ];
    let mut rows = Vec::new();
    for (solver, points) in points {
        for (target, point) in TARGETS.iter().zip(points) {
            let mut row = vec![solver.name(), power(*target)];
            row.extend(reached(point));
            rows.push(row);
        }
    }
    table(&head.map(str::to_owned), &rows)
}

/// Time of a step of the stiff methods over the number of masses.
fn cost_per_step() -> Result<String, String> {
    const STEPS: u64 = 100;
    const METHODS: [Method; 2] = [Method::Radau, Method::Rodas5p];
    let mut rows = Vec::new();
    let mut first = [0.0; METHODS.len()];
    for masses in [10, 100, 1000] {
        let press = Press::new(masses)?;
        let mut row = vec![masses.to_string(), press.system.coordinates().to_string()];
        for (method, first) in METHODS.into_iter().zip(&mut first) {
            let mut times: Vec<f64> = Vec::new();
            for _ in 0..5 {
                let begin = Instant::now();
                let steps = own::first_steps(&press, method, 1e-6, STEPS);
                times.push(begin.elapsed().as_secs_f64() / steps as f64);
            }
            let time = Timing::of(times).least;
            if masses == 10 {
                *first = time;
            }
            row.push(format!("{:.1}", 1e6 * time));
            row.push(format!("{:.1}", time / *first));
        }
        rows.push(row);
    }
    let head = [
        "masses",
        "coordinates",
        "radau, µs a step",
        "times the first (aim 150)",
        "rodas5p, µs a step",
        "times the first (aim 150)",
    ];
    Ok(format!(
        "\n### Cost of a step of the stiff methods\n\nThe first {STEPS} steps at tolerance 1e-6, the least of five; \
         attempts count as steps.\n\n{}",
        table(&head.map(str::to_owned), &rows)
    ))
}
