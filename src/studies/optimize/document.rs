//! The answer as a JSON document.

use super::Optimization;
use serde_json::{Value, json};

impl Optimization {
    /// The JSON document. `scene`: its name.
    pub fn document(&self, scene: &str) -> Value {
        json!({
            "dam": 1, "scene": scene, "variables": self.variables, "subject": self.conditions,
            "goal": self.goal, "best": self.best(), "optima": self.optima, "starts": self.starts,
            "least_violation": self.least_violation, "finer": self.finer,
            "slopes": self.slopes, "evaluations": self.evaluations, "settings": self.settings,
            "complete": self.complete, "rigid": self.rigid,
        })
    }
}
