//! What is known at one value of the parameter.

use crate::studies::condition::Condition;
use serde::Serialize;

/// What became of the scene at a value of the parameter.
#[derive(Clone, Debug, PartialEq, Serialize)]
#[serde(rename_all = "snake_case", tag = "state", content = "why")]
pub enum State {
    /// Everything that was asked is known.
    Computed,
    /// There is no such mechanism, or a study has no answer.
    Refused(String),
    /// The mechanism stops before the end of the run.
    Stopped(String),
    /// The computation failed, or failed its own checks: nothing is known.
    NotTrusted(String),
}

/// The scene at one value of the parameter.
#[derive(Clone, Debug, PartialEq, Serialize)]
pub struct Sample {
    /// Place, as a share of the range.
    #[serde(skip)]
    pub share: f64,
    /// Value of the parameter, in the unit in which it is written.
    pub value: f64,
    /// What was to be greatest or least; null where that has no value.
    pub goal: Option<f64>,
    /// The figures of the conditions, in their order (SI); null where one has no value.
    pub figures: Vec<Option<f64>>,
    /// What became of it.
    #[serde(flatten)]
    pub state: State,
}

impl Sample {
    /// Whether all conditions hold; `None`: nothing is known. (An equality counts as met: its
    /// places are found between others.)
    pub(super) fn holds(&self, conditions: &[Condition]) -> Option<bool> {
        match self.state {
            State::Computed => Some(self.violated(conditions).is_empty()),
            State::Refused(_) | State::Stopped(_) => Some(false),
            State::NotTrusted(_) => None,
        }
    }

    /// The conditions that do not hold, in their order; those of an equality are not among them.
    pub fn violated(&self, conditions: &[Condition]) -> Vec<usize> {
        let wrong = |&index: &usize| {
            let condition = &conditions[index];
            match self.figures[index] {
                Some(found) => !condition.is_equality() && !condition.holds(found),
                None => true,
            }
        };
        (0..conditions.len()).filter(wrong).collect()
    }

    /// How far a condition is from its limit; `None`: nobody knows.
    pub(super) fn margin(&self, conditions: &[Condition], index: usize) -> Option<f64> {
        match self.state {
            State::Computed => Some(conditions[index].margin(self.figures[index]?)),
            State::Refused(_) | State::Stopped(_) | State::NotTrusted(_) => None,
        }
    }
}
