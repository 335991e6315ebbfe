//! What a choice of the model leaves: every figure with its error, every object with its
//! level.

use crate::dynamics::builder::spec::Level;
use serde::Serialize;
use std::collections::BTreeMap;

/// How sure the error of a figure is.
#[derive(Clone, Copy, Debug, PartialEq, Eq, Serialize)]
#[serde(rename_all = "snake_case")]
pub enum Certainty {
    /// Estimated from how the figure settles as the model is refined.
    Estimate,
    /// It has no limit: the figure grows with the number of masses.
    NoLimit,
    /// It does not settle: the order of the model does not determine it.
    NotDetermined,
}

/// A figure with its error, that of the model included.
#[derive(Clone, Debug, PartialEq, Serialize)]
pub struct FigureAccuracy {
    /// The value, by the model chosen.
    pub value: f64,
    /// SI unit; empty for counts.
    pub unit: String,
    /// How far the value may be from that of the continuum; absent where it has no limit.
    #[serde(skip_serializing_if = "Option::is_none")]
    pub error: Option<f64>,
    /// The same as a share of the value.
    #[serde(skip_serializing_if = "Option::is_none")]
    pub relative: Option<f64>,
    /// The greatest error that is asked for.
    pub asked: f64,
    /// False where the error is greater than that, or there is none.
    pub holds: bool,
    /// How sure the error is.
    pub kind: Certainty,
    /// What the error is made of.
    #[serde(skip_serializing_if = "Option::is_none")]
    pub shares: Option<Shares>,
    /// Where the figure leads as the model is refined.
    #[serde(skip_serializing_if = "Option::is_none")]
    pub limit: Option<f64>,
    /// Why it has no limit, or is not determined.
    #[serde(skip_serializing_if = "Option::is_none")]
    pub why: Option<String>,
}

/// What an error is made of.
#[derive(Clone, Copy, Debug, PartialEq, Serialize)]
pub struct Shares {
    /// Error of the model: its masses or modes.
    pub model: f64,
    /// Error of the integration.
    pub integration: f64,
    /// How far rounding alone moves the figure; null where it was not looked at.
    pub spread: Option<f64>,
}

/// The level of an object, and why it is this one.
#[derive(Clone, Debug, PartialEq, Serialize)]
pub struct ObjectModel {
    /// The level, with its number of coordinates and lumping.
    #[serde(flatten)]
    pub level: Level,
    /// Coordinates: modes or masses.
    pub coordinates: usize,
    /// True when it was chosen; false when the scene gives it.
    pub chosen: bool,
    /// Why.
    pub why: String,
    /// The level below and the greatest error of a figure, as a share of what is allowed,
    /// that ruled it out.
    #[serde(skip_serializing_if = "Option::is_none")]
    pub next_cheaper: Option<Cheaper>,
}

/// A level that was ruled out.
#[derive(Clone, Debug, PartialEq, Serialize)]
pub struct Cheaper {
    /// The level.
    #[serde(flatten)]
    pub level: Level,
    /// The figure that ruled it out.
    pub figure: String,
    /// Its error, in the figure's unit.
    pub error: f64,
}

/// A model that was tried.
#[derive(Clone, Debug, PartialEq, Serialize)]
pub struct Tried {
    /// The level of every elastic object.
    pub levels: BTreeMap<String, Level>,
    /// Coordinates of all of them.
    pub coordinates: usize,
    /// Value of every figure that is asked for; null where it has none.
    pub values: BTreeMap<String, Option<f64>>,
    /// True for the model that was chosen.
    pub chosen: bool,
}

/// What the figures of a run are worth, the error of the model included.
#[derive(Clone, Debug, Default, PartialEq, Serialize)]
pub struct Certificate {
    /// Every figure that is asked for, by its address.
    pub accuracy: BTreeMap<String, FigureAccuracy>,
    /// Every elastic object.
    pub models: BTreeMap<String, ObjectModel>,
    /// Every model that was tried, in the order of their coordinates.
    pub tried: Vec<Tried>,
}

impl Certificate {
    /// True when every figure that has a limit is as accurate as it is asked to be.
    pub fn holds(&self) -> bool {
        let mut figures = self.accuracy.values();
        figures.all(|figure| figure.holds || figure.kind == Certainty::NoLimit)
    }
}
