//! What was found.

use super::sample::{Sample, State};
use serde::Serialize;

/// Why a range ends.
#[derive(Clone, Debug, PartialEq, Serialize)]
#[serde(rename_all = "snake_case", tag = "kind", content = "is")]
pub enum Limit {
    /// The range of the parameter ends.
    Range,
    /// Conditions, by their index.
    Conditions(Vec<usize>),
    /// The mechanism cannot be, or stops, beyond it; or nothing is known there.
    State(State),
    /// An equality is met here alone.
    Equality(usize),
    /// The figure jumps here, or has no bound.
    Abrupt,
}

/// An end of a range in which all conditions hold.
#[derive(Clone, Debug, PartialEq, Serialize)]
pub struct ConditionEnd {
    /// The last place that is known to meet the conditions.
    pub sample: Sample,
    /// Why it ends.
    #[serde(flatten)]
    pub limit: Limit,
    /// How far the end may lie beyond it, in the unit of the parameter.
    pub within: f64,
    /// The first place beyond it.
    #[serde(skip)]
    pub beyond: Option<Sample>,
}

/// A range in which all conditions hold, as far as places have been looked at.
#[derive(Clone, Debug, PartialEq, Serialize)]
pub struct Range {
    /// Its first end, as the parameter goes.
    pub from: ConditionEnd,
    /// Its last end.
    pub to: ConditionEnd,
}

/// The best place.
#[derive(Clone, Debug, PartialEq, Serialize)]
pub struct Best {
    /// What is known there.
    #[serde(flatten)]
    pub sample: Sample,
    /// What keeps it from being better; `None`: the figure itself is greatest or least here.
    pub limit: Option<Limit>,
    /// How far it may be off, in the unit of the parameter.
    pub within: f64,
    /// The first place beyond its limit.
    pub beyond: Option<Sample>,
}

/// What was found.
#[derive(Clone, Debug, PartialEq, Serialize)]
pub struct FindResult {
    /// The best place; `None` where no place meets the conditions, or nothing was to be best.
    pub best: Option<Best>,
    /// The ranges in which all conditions hold, in the order of the parameter.
    pub ranges: Vec<Range>,
    /// All places that were looked at.
    pub samples: Vec<Sample>,
    /// False: a place of which nothing is known could better the answer.
    pub certain: bool,
    /// False: ended before everything was looked at.
    pub complete: bool,
}
