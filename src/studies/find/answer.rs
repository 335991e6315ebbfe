//! The answer as a whole.

use super::{FindResult, Goal, Span};
use crate::studies::condition::Condition;
use crate::studies::rigid::Rigid;
use serde_json::{Value, json};

/// The best value of a parameter, and the ranges in which the conditions hold.
#[derive(Clone, Debug)]
pub struct FoundValue {
    /// The parameter and its range.
    pub span: Span,
    /// SI unit of the parameter where its range names none and it is known; else its own unit.
    pub unit: String,
    /// The conditions.
    pub conditions: Vec<Condition>,
    /// What was sought; `None`: the ranges alone.
    pub goal: Option<Goal>,
    /// What was found.
    pub found: FindResult,
    /// The label of figures that take elastic objects for rigid.
    pub rigid: Option<Rigid>,
}

impl FoundValue {
    /// Whether there is an answer and nothing that is unknown could change it.
    pub fn is_answered(&self) -> bool {
        let any = match self.goal {
            Some(_) => self.found.best.is_some(),
            None => !self.found.ranges.is_empty(),
        };
        any && self.found.certain && self.found.complete
    }

    /// The JSON document. `scene`: its name.
    pub fn document(&self, scene: &str) -> Value {
        json!({
            "dam": 1, "scene": scene, "vary": self.span, "unit": self.unit,
            "subject": self.conditions, "goal": self.goal, "best": self.found.best,
            "ranges": self.found.ranges, "certain": self.found.certain,
            "complete": self.found.complete, "places": self.found.samples, "rigid": self.rigid,
        })
    }
}
