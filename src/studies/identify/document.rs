//! What was identified, as JSON.

use super::{Ending, Estimate, FittedSignal, Identification, StartResult};
use crate::studies::axis::Parameter;
use serde_json::{Value, json};

impl Ending {
    /// The name as it is written: `converged`.
    pub fn name(self) -> &'static str {
        match self {
            Self::Converged => "converged",
            Self::MostSteps => "most_steps",
            Self::NoResiduals => "cannot_be_run",
        }
    }
}

impl Estimate {
    /// The setting of the scene: `rocker.stiffness=1.0002e7 N m/rad`.
    pub fn setting(&self) -> String {
        let parameter = Parameter {
            path: self.unknown.path.clone(),
            unit: self.unknown.unit.clone(),
        };
        parameter.setting(self.value)
    }
}

impl Identification {
    /// The JSON document. `scene`: its name.
    pub fn document(&self, scene: &str) -> Value {
        let path = |at: usize| self.estimates[at].unknown.path.as_str();
        let correlated = self.correlated.iter().map(|(one, other, value)| {
            json!({ "paths": [path(*one), path(*other)], "correlation": value })
        });
        json!({
            "dam": 1, "scene": scene,
            "estimates": self.estimates.iter().map(estimate).collect::<Vec<_>>(),
            "set": self.estimates.iter().map(Estimate::setting).collect::<Vec<_>>(),
            "correlations": self.correlations,
            "correlated": correlated.collect::<Vec<_>>(),
            "residual_sigma": self.sigma,
            "signals": self.signals.iter().map(signal).collect::<Vec<_>>(),
            "starts": self.starts.iter().map(start).collect::<Vec<_>>(),
            "ending": self.ending.name(), "answered": self.is_answered(),
            "remarks": self.remarks,
        })
    }
}

fn estimate(one: &Estimate) -> Value {
    json!({
        "path": one.unknown.path, "unit": one.unknown.unit, "value": one.value,
        "standard_error": one.error, "determined": one.is_determined(), "at_bound": one.at_bound,
        "from": one.unknown.bounds.lower, "to": one.unknown.bounds.upper, "given": one.unknown.given,
    })
}

fn signal(one: &FittedSignal) -> Value {
    json!({
        "record": one.record, "column": one.column, "signal": one.address, "unit": one.unit,
        "weight": one.weight, "rows": one.times.len(), "runs_test": one.test,
        "random": one.test.map(|test| test.is_random()),
    })
}

fn start(one: &StartResult) -> Value {
    json!({ "start": one.start, "end": one.end, "rms": one.rms, "ending": one.ending.name() })
}
