//! The general solvers on the cases.

use crate::case::{Case, SAMPLES};
use crate::cvode_peer::{self, Cvode};
use crate::ladder::Runner;
use crate::solution::{Solution, Timing};
use crate::{diffsol_peer, ode_solvers_peer};
use std::time::{Duration, Instant};

/// A solver with one of its methods.
#[derive(Clone, Debug)]
pub(crate) enum Peer {
    /// diffsol.
    Diffsol(&'static str),
    /// ode_solvers.
    OdeSolvers(&'static str),
    /// CVODE.
    Cvode(Cvode, &'static str),
}

impl Peer {
    /// All of them, CVODE where its program is given.
    pub(crate) fn all(cvode: Option<&Cvode>) -> Vec<Self> {
        let diffsol = diffsol_peer::METHODS.map(Self::Diffsol);
        let ode_solvers = ode_solvers_peer::METHODS.map(Self::OdeSolvers);
        let cvode = cvode.into_iter().flat_map(|cvode| {
            let methods = cvode_peer::METHODS.into_iter();
            methods.map(|method| Self::Cvode(cvode.clone(), method))
        });
        // The explicit ones first: what takes far longer than they do is given up.
        let (explicit, implicit) = diffsol.split_at(1);
        let explicit = explicit.iter().chain(&ode_solvers).cloned();
        let implicit = implicit.iter().cloned();
        explicit.chain(implicit).chain(cvode).collect()
    }

    /// Solver and method.
    pub(crate) fn name(&self) -> String {
        match self {
            Self::Diffsol(method) => format!("diffsol {method}"),
            Self::OdeSolvers(method) => format!("ode_solvers {method}"),
            Self::Cvode(_, method) => format!("CVODE {method}"),
        }
    }

    /// True for CVODE.
    pub(crate) fn is_cvode(&self) -> bool {
        matches!(self, Self::Cvode(..))
    }

    /// One run, and its time (s).
    ///
    /// # Errors
    /// What the solver says.
    pub(crate) fn solve(&self, case: &Case, tolerance: f64) -> Result<(Solution, f64), String> {
        let begin = Instant::now();
        let solution = match self {
            Self::Diffsol(method) => diffsol_peer::solve(&case.chain, method, tolerance, SAMPLES)?,
            Self::OdeSolvers(method) => {
                ode_solvers_peer::solve(&case.chain, method, tolerance, SAMPLES)?
            }
            Self::Cvode(cvode, method) => {
                let (solution, timing) = cvode.solve(case, method, tolerance, 0.0)?;
                return Ok((solution, timing.median));
            }
        };
        Ok((solution, begin.elapsed().as_secs_f64()))
    }

    /// Repeated runs.
    pub(crate) fn time(&self, case: &Case, tolerance: f64, budget: Duration) -> Option<Timing> {
        if let Self::Cvode(cvode, method) = self {
            let timed = cvode.solve(case, method, tolerance, budget.as_secs_f64());
            return timed.ok().map(|(_, timing)| timing);
        }
        let run = || self.solve(case, tolerance).is_ok();
        Some(Timing::measure(budget, run))
    }
}

/// A peer on a case.
pub(crate) struct OnCase<'a> {
    /// The peer.
    pub(crate) peer: &'a Peer,
    /// The case.
    pub(crate) case: &'a Case,
}

impl Runner for OnCase<'_> {
    fn solve(&self, tolerance: f64) -> Result<(Solution, f64), String> {
        self.peer.solve(self.case, tolerance)
    }

    fn error(&self, samples: &[f64]) -> f64 {
        self.case.error(samples)
    }

    fn time(&self, tolerance: f64, budget: Duration) -> Option<Timing> {
        self.peer.time(self.case, tolerance, budget)
    }
}
