//! Exact propagation of piecewise-linear chains.

mod basis;
mod bound;
mod lanes;
mod law;
mod panel;
mod pencil;
mod phase;
mod problem;
mod run;
mod sample;
mod search;
mod signal;
mod start;
#[cfg(test)]
mod tests;
mod track;

pub use law::{Law, PolynomialSpan, Sine, SpanSource};
pub use problem::{
    Flank, PairState, Refusal, TimeLoad, TreeMass, TreeObject, TreePair, TreeProblem,
};
pub use run::{ExactRun, ExactSwitch, Request};
pub use track::TreeFigures;

/// A problem ready to be run.
#[derive(Clone, Debug)]
pub struct ExactTree {
    problem: TreeProblem,
    functionals: Vec<signal::Functional>,
    first: Vec<usize>,
}

impl ExactTree {
    /// Prepares a problem.
    pub fn new(problem: TreeProblem) -> Self {
        let (functionals, first) = run::pair_functionals(&problem);
        Self {
            problem,
            functionals,
            first,
        }
    }

    /// Runs it.
    ///
    /// # Errors
    /// The modes of a regime cannot be separated, or numbers stop being finite.
    pub fn run(&self, request: &Request) -> Result<ExactRun, Refusal> {
        run::run(&self.problem, &self.functionals, &self.first, request)
    }
}
