//! Numbers of a scene from records, as data.

use super::certainty::UNDETERMINED;
use super::fit::Ending;
use super::misfit::{ChiSquared, Misfit};
use super::runs_test::RunsTest;
use crate::studies::optimize::Variable;

/// Variation of a constant signal, as a share of it.
const ROUNDING: f64 = 1e-12;

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
    /// Its stated standard deviation (SI).
    pub sigma: Option<f64>,
    /// Times (s).
    pub times: Vec<f64>,
    /// The signal of the record (SI).
    pub measured: Vec<f64>,
    /// Residuals of the fit over the weight, in the order of the times.
    pub residuals: Vec<f64>,
    /// Whether they are random; `None`: all have one sign.
    pub test: Option<RunsTest>,
    /// Whether they are no more than what runs are known to.
    pub is_exact: bool,
    /// Rows that stand out, with their multiples of the usual deviation.
    pub outliers: Vec<(usize, f64)>,
}

impl FittedSignal {
    /// Root of the mean square of the residuals (SI).
    pub fn rms(&self) -> f64 {
        let squares: f64 = self.residuals.iter().map(|own| own * own).sum();
        self.weight() * (squares / self.residuals.len().max(1) as f64).sqrt()
    }

    /// What residuals are divided by (SI): 1 if no standard deviation is stated.
    pub fn weight(&self) -> f64 {
        self.sigma.unwrap_or(1.0)
    }

    /// Residuals over the variation of the signal about its mean, as root mean squares; infinite
    /// for a signal that is constant.
    pub fn unexplained(&self) -> f64 {
        let count = self.measured.len().max(1) as f64;
        let mean = self.measured.iter().sum::<f64>() / count;
        let squares = self.measured.iter().map(|one| (one - mean).powi(2));
        match squares.sum::<f64>() / count {
            variance if variance > (ROUNDING * mean).powi(2) => self.rms() / variance.sqrt(),
            _ => f64::INFINITY,
        }
    }

    /// Whether the residuals are random, or too small to tell.
    pub fn is_random(&self) -> bool {
        self.is_exact || self.test.is_some_and(|test| test.is_random())
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
    /// What the record says of it.
    pub standing: Standing,
}

/// What a record says of a number.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Standing {
    /// It is determined.
    Determined,
    /// It is determined if others have the value at the end of their range at which the fit is.
    Conditional,
    /// The fit is at an end of its range.
    AtEnd,
    /// The standard error exceeds the value, or the number has no effect.
    Undetermined,
    /// Another start ended as well with another value.
    Ambiguous,
    /// Its standard error does not hold: the sum of squares rises otherwise than that says.
    NotLinear,
    /// The fit does not explain the record.
    Misfit,
    /// The best fit did not converge.
    NoFit,
}

impl Standing {
    /// The name as it is written: `determined`.
    pub fn name(self) -> &'static str {
        match self {
            Self::Determined => "determined",
            Self::Conditional => "conditional",
            Self::AtEnd => "at_end",
            Self::Undetermined => "undetermined",
            Self::Ambiguous => "ambiguous",
            Self::NotLinear => "not_linear",
            Self::Misfit => "misfit",
            Self::NoFit => "no_fit",
        }
    }
}

impl Estimate {
    /// Whether the record determines it.
    pub fn is_determined(&self) -> bool {
        self.standing == Standing::Determined
    }

    /// Whether its error is known and not greater than itself.
    pub(super) fn is_known(&self) -> bool {
        self.error
            .is_some_and(|error| error <= UNDETERMINED * self.fitted.abs())
    }

    /// Its value and its standard error; `None`: the record determines it under no condition.
    pub fn value(&self) -> Option<(f64, f64)> {
        let has_value = matches!(self.standing, Standing::Determined | Standing::Conditional);
        let error = self.error.filter(|_| has_value)?;
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
    /// True: it is the best fit, or ended at the same values.
    pub is_best: bool,
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
    /// Standard deviation of a residual over its weight; `None`: the fit did not converge.
    pub sigma: Option<f64>,
    /// χ² of the fit; `None`: no standard deviation is stated, or the fit did not converge.
    pub chi_squared: Option<ChiSquared>,
    /// Why the fit does not explain the records.
    pub misfit: Option<Misfit>,
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
    /// Whether the best fit converged, explains the records, and these determine all numbers.
    pub fn is_answered(&self) -> bool {
        self.ending == Ending::Converged
            && self.misfit.is_none()
            && self.estimates.iter().all(Estimate::is_determined)
    }

    /// Whether the residuals of all signals are random, or too small to tell.
    pub fn is_random(&self) -> bool {
        self.signals.iter().all(FittedSignal::is_random)
    }

    /// Number of starts that ended at the best fit.
    pub fn starts_at_best(&self) -> usize {
        self.starts.iter().filter(|one| one.is_best).count()
    }
}
