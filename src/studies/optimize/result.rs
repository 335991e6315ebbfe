//! What was found.

use super::Variable;
use crate::studies::condition::Condition;
use crate::studies::find::Goal;
use crate::studies::rigid::Rigid;
use serde::Serialize;

/// The best values of several variables under conditions.
#[derive(Clone, Debug)]
pub struct Optimization {
    /// What was chosen.
    pub variables: Vec<Variable>,
    /// Under which conditions.
    pub conditions: Vec<Condition>,
    /// What was to be least or greatest.
    pub goal: Goal,
    /// The distinct optima, the best first; empty: none meets the conditions.
    pub optima: Vec<Optimum>,
    /// The starts in their order.
    pub starts: Vec<StartResult>,
    /// Where no place meets the conditions: the least violation.
    pub least_violation: Option<LeastViolation>,
    /// The best optimum by a finer model; `None`: there is no optimum.
    pub finer: Option<FinerCheck>,
    /// Where slopes came from.
    pub slopes: SlopeSources,
    /// Places that were looked at.
    pub evaluations: usize,
    /// False: ended from outside before all starts were done.
    pub complete: bool,
    /// The label of figures that take elastic objects for rigid.
    pub rigid: Option<Rigid>,
    /// The best values as settings of the scene, `PATH=VALUE UNIT`.
    pub settings: Vec<String>,
    /// The scene with the best values; empty: there are none.
    pub scene_text: String,
}

/// An optimum.
#[derive(Clone, Debug, PartialEq, Serialize)]
pub struct Optimum {
    /// Values of the variables, in their units.
    pub values: Vec<f64>,
    /// The goal, in its unit.
    pub goal: f64,
    /// The conditions in their order.
    pub conditions: Vec<HeldCondition>,
    /// The bounds that hold it.
    pub bounds: Vec<HeldBound>,
    /// What is left of the slope of the goal when that of everything that holds it is taken away,
    /// as a share of the change of the goal over all ranges: zero at an optimum. Null: not known,
    /// since the search was ended.
    pub residual: Option<f64>,
    /// True: the slope that is left is none, so that nothing is better nearby.
    pub stationary: bool,
    /// Stretches through it along which the goal stays the same.
    pub flat: Vec<FlatStretch>,
    /// The starts that ended here, by their number.
    pub starts: Vec<usize>,
    /// Place as shares of the ranges.
    #[serde(skip)]
    pub(super) at: Vec<f64>,
}

/// A condition at an optimum.
#[derive(Clone, Debug, PartialEq, Serialize)]
pub struct HeldCondition {
    /// The figure (SI).
    pub figure: f64,
    /// True: the figure is at its limit, and the optimum is held by it.
    pub active: bool,
    /// Change of the goal over that of the limit, in units of both; `None`: it holds nothing.
    pub multiplier: Option<f64>,
    /// Unit of the multiplier.
    pub unit: String,
}

/// The end of a range that holds an optimum.
#[derive(Clone, Debug, PartialEq, Serialize)]
pub struct HeldBound {
    /// Which variable.
    pub variable: String,
    /// True: the greatest value; false: the least one.
    pub upper: bool,
    /// Change of the goal over that of the bound.
    pub multiplier: f64,
    /// Unit of the multiplier.
    pub unit: String,
}

/// A straight stretch of equally good values.
#[derive(Clone, Debug, PartialEq, Serialize)]
pub struct FlatStretch {
    /// Values of the variables at one end.
    pub from: Vec<f64>,
    /// At the other.
    pub to: Vec<f64>,
    #[serde(skip)]
    pub(super) ends: [Vec<f64>; 2],
}

/// A start and what became of it.
#[derive(Clone, Debug, PartialEq, Serialize)]
pub struct StartResult {
    /// Values of the variables where it began.
    pub from: Vec<f64>,
    /// Where it ended; null: it had no values where it began.
    pub to: Option<Vec<f64>>,
    /// The goal there, in its unit.
    pub goal: Option<f64>,
    /// How it ended.
    pub end: StartEnd,
    /// The cause in words; empty where none is needed.
    pub why: String,
    /// The optimum at which it ended, by its number; null: at none.
    pub optimum: Option<usize>,
    /// Places that it looked at.
    pub evaluations: usize,
    /// Places without values among them.
    pub failed: usize,
    /// The best goal so far, of places that meet the conditions: at which place it was bettered,
    /// and the goal there.
    pub progress: Vec<(usize, f64)>,
}

/// How a start ended.
#[derive(Clone, Copy, Debug, PartialEq, Eq, Serialize)]
#[serde(rename_all = "snake_case")]
pub enum StartEnd {
    /// At an optimum.
    Optimum,
    /// No step does better, but a slope is left.
    Stalled,
    /// Where no step lessens the violation of the conditions.
    Infeasible,
    /// The scene has no values where it began.
    Failed,
    /// Ended from outside.
    Interrupted,
}

impl StartEnd {
    /// In words.
    pub fn words(self) -> &'static str {
        match self {
            Self::Optimum => "optimum",
            Self::Stalled => "no better step",
            Self::Infeasible => "conditions not met",
            Self::Failed => "no values at the start",
            Self::Interrupted => "interrupted",
        }
    }
}

/// The place at which the conditions are violated least.
#[derive(Clone, Debug, PartialEq, Serialize)]
pub struct LeastViolation {
    /// Values of the variables.
    pub values: Vec<f64>,
    /// The figure of each condition (SI).
    pub figures: Vec<f64>,
    /// By how much each is violated (SI); zero of those that hold.
    pub violations: Vec<f64>,
    /// The conditions that cannot be met together, by their number.
    pub conflict: Vec<usize>,
    /// The bounds that stand against them.
    pub bounds: Vec<String>,
}

/// The best optimum by a model one level finer.
#[derive(Clone, Debug, Default, PartialEq, Serialize)]
pub struct FinerCheck {
    /// Levels of the finer model in words; empty: there is none.
    pub levels: String,
    /// The goal by it.
    pub goal: Option<f64>,
    /// How far the goal moves.
    pub moved: Option<f64>,
    /// What the optimum gains over the best start that meets the conditions; null: none does.
    pub gain: Option<f64>,
    /// Conditions that do not hold by it, by their number, of those that move by more than one part
    /// in 10⁴.
    pub violated: Vec<usize>,
    /// True: the optimum stands; null: there is no finer model.
    pub stands: Option<bool>,
    /// Why there is no finer model, or no result of it.
    pub why_not: String,
}

/// Where slopes came from.
#[derive(Clone, Debug, Default, PartialEq, Serialize)]
pub struct SlopeSources {
    /// Slopes of results that were exact.
    pub exact: usize,
    /// Slopes of results that were central differences.
    pub differences: usize,
    /// Why there are no exact ones; empty: there are, or nobody asked.
    pub why_differences: String,
}

impl Optimization {
    /// The best optimum.
    pub fn best(&self) -> Option<&Optimum> {
        self.optima.first()
    }

    /// Whether there is an optimum that stands.
    pub fn is_answered(&self) -> bool {
        let stands = self
            .finer
            .as_ref()
            .is_none_or(|finer| finer.stands != Some(false));
        self.best().is_some_and(|best| best.stationary) && stands
    }
}
