//! Numbers of a scene from records, as data.

use super::certainty::UNDETERMINED;
use super::fit::Ending;
use super::runs_test::RunsTest;
use crate::studies::optimize::Variable;

/// Relative difference of residuals below which two fits are the same.
const SAME: f64 = 1e-6;

/// Signal of a record beside that of the best fit.
#[derive(Clone, Debug, PartialEq)]
pub struct FittedSignal {
    /// Record in which it stands.
    pub record: String,
    /// Column of the record.
    pub column: String,
    /// Address of the signal in the scene.
    pub address: String,
    /// SI unit.
    pub unit: String,
    /// Its standard deviation (SI): 1 if none is stated.
    pub weight: f64,
    /// Times (s).
    pub times: Vec<f64>,
    /// The signal of the record (SI).
    pub measured: Vec<f64>,
    /// Residuals of the fit over the weight, in the order of the times.
    pub residuals: Vec<f64>,
    /// Whether they are random; `None`: all have one sign.
    pub test: Option<RunsTest>,
}

impl FittedSignal {
    /// Root of the mean square of the residuals (SI).
    pub fn rms(&self) -> f64 {
        let squares: f64 = self.residuals.iter().map(|own| own * own).sum();
        self.weight * (squares / self.residuals.len().max(1) as f64).sqrt()
    }
}

/// An estimate.
#[derive(Clone, Debug, PartialEq)]
pub struct Estimate {
    /// Number of the scene with its range.
    pub variable: Variable,
    /// Its value in the scene, in the unit of the variable.
    pub given: f64,
    /// Its value in the best fit. It is an answer only if the record determines it.
    pub fitted: f64,
    /// Standard error; `None`: the record says nothing of it.
    pub error: Option<f64>,
    /// Whether the fit lies at an end of the range.
    pub at_end: bool,
    /// Whether another start ended as well with another value.
    pub is_ambiguous: bool,
}

impl Estimate {
    /// Whether the record determines it.
    pub fn is_determined(&self) -> bool {
        let is_known = self
            .error
            .is_some_and(|error| error <= UNDETERMINED * self.fitted.abs());
        is_known && !self.at_end && !self.is_ambiguous
    }

    /// Its value and its standard error; `None`: the record does not determine it.
    pub fn value(&self) -> Option<(f64, f64)> {
        let error = self.error.filter(|_| self.is_determined())?;
        Some((self.fitted, error))
    }
}

/// Result of one start.
#[derive(Clone, Debug, PartialEq)]
pub struct StartResult {
    /// The start, in the units of the numbers.
    pub start: Vec<f64>,
    /// Where it ended.
    pub end: Vec<f64>,
    /// Root of the mean square of the residuals there; `None`: the scene cannot be run at the
    /// start.
    pub rms: Option<f64>,
    /// Why it ended.
    pub ending: Ending,
    /// True: it fits as well as the best one, with other values.
    pub is_rival: bool,
}

/// Change of a number, as a share of its value.
#[derive(Clone, Debug, PartialEq, serde::Serialize)]
pub struct Change {
    /// Address of the number.
    pub path: String,
    /// The change; the greatest of a direction is 1.
    pub change: f64,
}

/// Numbers of a scene from records.
#[derive(Clone, Debug, PartialEq)]
pub struct Identification {
    /// The estimates.
    pub estimates: Vec<Estimate>,
    /// Directions in which the record does not determine the numbers: these change together, and
    /// the fit does not follow.
    pub open_directions: Vec<Vec<Change>>,
    /// Pairs of which the record determines a combination alone, with their correlations.
    pub correlated: Vec<(usize, usize, f64)>,
    /// Correlations of all pairs, row by row; empty if they are unknown.
    pub correlations: Vec<Vec<f64>>,
    /// Standard deviation of a residual over its weight; `None`: the fit did not end.
    pub sigma: Option<f64>,
    /// The signals.
    pub signals: Vec<FittedSignal>,
    /// The starts that were worked on, in their order.
    pub starts: Vec<StartResult>,
    /// Number of starts that were asked for.
    pub starts_requested: usize,
    /// Why the best fit ended.
    pub ending: Ending,
    /// Number of runs, each of all records.
    pub evaluations: usize,
    /// Whether all starts came to their end.
    pub complete: bool,
    /// What is to be known, a line each.
    pub remarks: Vec<String>,
    /// The estimates as settings of the scene; empty unless all are determined.
    pub settings: Vec<String>,
    /// The scene with the estimates; empty unless all are determined.
    pub scene_text: String,
}

impl Identification {
    /// Whether the best fit converged and the record determines all numbers.
    pub fn is_answered(&self) -> bool {
        self.ending == Ending::Converged && self.estimates.iter().all(Estimate::is_determined)
    }

    /// Number of starts that ended at the best fit.
    pub fn starts_at_best(&self) -> usize {
        let known = self.starts.iter().filter_map(|one| one.rms);
        let best = known.fold(f64::INFINITY, f64::min);
        let is_same = |one: &&StartResult| {
            !one.is_rival && one.rms.is_some_and(|own| own <= best * (1.0 + SAME))
        };
        self.starts.iter().filter(is_same).count()
    }
}
