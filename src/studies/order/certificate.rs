//! What a choice of the model leaves: every figure with its error, every object with its
//! level.

use crate::dynamics::builder::spec::Level;
use crate::studies::spread::Spread;
use crate::units::shown;
use serde::Serialize;
use std::collections::BTreeMap;

/// How sure the error of a figure is.
#[derive(Clone, Copy, Debug, PartialEq, Eq, Serialize)]
#[serde(rename_all = "snake_case")]
pub enum Certainty {
    /// Nothing that the model leaves out can change the figure by more: of linear objects
    /// behind prescribed drives.
    Bound,
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
    /// Why it has no limit, is not determined, or is not judged relative to itself.
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
pub struct TriedModel {
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
    pub tried: Vec<TriedModel>,
}

impl FigureAccuracy {
    /// What is wrong, where the figure does not hold the accuracy that is asked for.
    pub fn shortfall(&self, figure: &str) -> Option<String> {
        let unit = match self.unit.as_str() {
            "" => String::new(),
            unit => format!(" {unit}"),
        };
        let asked = format!("{figure} does not have the required accuracy");
        let words = match (self.error, &self.why) {
            (Some(error), _) => format!(
                "{asked}: its error may be {}{unit}, and {}{unit} is allowed",
                shown(error, 2),
                shown(self.asked, 2)
            ),
            (None, Some(why)) => format!("{asked}: {why}"),
            (None, None) => format!("{asked}: its error is not known"),
        };
        (!self.holds).then_some(words)
    }
}

impl Certificate {
    /// What is wrong with each figure that does not hold the accuracy that is asked for.
    pub fn shortfalls(&self) -> Vec<String> {
        let figures = self.accuracy.iter();
        figures
            .filter_map(|(figure, found)| found.shortfall(figure))
            .collect()
    }

    /// The same, with how far rounding alone moves each figure (loads and gaps changed by one
    /// part in 10¹⁰, the tolerance halved) in its error. A figure that is gone by it is not
    /// determined.
    #[must_use]
    pub fn with_spread(mut self, spread: &Spread) -> Self {
        for found in &spread.figures {
            let Some(figure) = self.accuracy.get_mut(&found.figure) else {
                continue;
            };
            let (Some(error), Some(shares)) = (&mut figure.error, &mut figure.shares) else {
                continue;
            };
            let Some(moved) = found.by_loads.zip(found.by_tolerance) else {
                figure.error = None;
                figure.relative = None;
                figure.shares = None;
                figure.holds = false;
                figure.kind = Certainty::NotDetermined;
                let why = "it is gone when the loads change by one part in 10¹⁰".to_owned();
                figure.why = Some(why);
                continue;
            };
            let moved = moved.0.max(moved.1);
            shares.spread = Some(moved);
            *error += moved;
            let relative = *error / figure.value.abs();
            // None before: the figure is zero within the resolution of the run.
            figure.relative = figure.relative.and(Some(relative));
            figure.relative = figure.relative.filter(|share| share.is_finite());
            figure.holds = *error <= figure.asked;
        }
        self
    }

    /// True when every figure that has a limit is as accurate as it is asked to be.
    pub fn holds(&self) -> bool {
        let mut figures = self.accuracy.values();
        figures.all(|figure| figure.holds || figure.kind == Certainty::NoLimit)
    }
}

#[cfg(test)]
mod tests {
    use super::{Certainty, Certificate, FigureAccuracy, Shares};
    use crate::studies::spread::{FigureSpread, Spread};

    fn certificate(error: f64) -> Certificate {
        let figure = FigureAccuracy {
            value: 2.0,
            unit: String::new(),
            error: Some(error),
            relative: Some(error / 2.0),
            asked: 0.02,
            holds: true,
            kind: Certainty::Estimate,
            shares: Some(Shares {
                model: error,
                integration: 0.0,
                spread: None,
            }),
            limit: Some(2.0),
            why: None,
        };
        Certificate {
            accuracy: [("one.delta_abs".to_owned(), figure)].into(),
            ..Certificate::default()
        }
    }

    fn spread(by_loads: Option<f64>, by_tolerance: Option<f64>) -> Spread {
        let figure = FigureSpread {
            figure: "one.delta_abs".to_owned(),
            value: 2.0,
            scale: 2.0,
            by_loads,
            by_tolerance,
            determined: false,
        };
        Spread {
            change: 1e-10,
            tolerance_factor: 0.5,
            figures: vec![figure],
        }
    }

    #[test]
    fn what_rounding_moves_is_a_share_of_the_error() {
        let found = certificate(0.01).with_spread(&spread(Some(0.002), Some(0.005)));
        let figure = &found.accuracy["one.delta_abs"];
        assert_eq!((figure.error, figure.holds), (Some(0.015), true));
        assert_eq!(figure.shares.and_then(|shares| shares.spread), Some(0.005));
        let found = certificate(0.01).with_spread(&spread(Some(0.02), Some(0.0)));
        assert!(!found.accuracy["one.delta_abs"].holds);
        let found = certificate(0.01).with_spread(&spread(None, None));
        let figure = &found.accuracy["one.delta_abs"];
        assert_eq!(
            (figure.kind, figure.error),
            (Certainty::NotDetermined, None)
        );
    }
}
