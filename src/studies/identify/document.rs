//! What was identified, as JSON.

use super::{Ending, Estimate, FittedSignal, Identification, Misfit, StartResult};
use serde_json::{Value, json};

impl Ending {
    /// The name as it is written: `converged`.
    pub fn name(self) -> &'static str {
        match self {
            Self::Converged => "converged",
            Self::Stalled => "stalled",
            Self::MostSteps => "most_steps",
            Self::NoResiduals => "cannot_be_run",
            Self::Interrupted => "interrupted",
        }
    }
}

impl Identification {
    /// The JSON document. `scene`: its name.
    pub fn document(&self, scene: &str) -> Value {
        let path = |at: usize| self.estimates[at].variable.path.as_str();
        let correlated = self.correlated.iter().map(|(one, other, value)| {
            json!({ "paths": [path(*one), path(*other)], "correlation": value })
        });
        json!({
            "dam": 1, "scene": scene,
            "estimates": self.estimates.iter().map(estimate).collect::<Vec<_>>(),
            "open_directions": self.open_directions,
            "correlations": self.correlations,
            "correlated": correlated.collect::<Vec<_>>(),
            "residual_sigma": self.sigma,
            "chi_squared": self.chi_squared,
            "misfit": self.misfit.as_ref().map(misfit),
            "signals": self.signals.iter().map(signal).collect::<Vec<_>>(),
            "starts": self.starts.iter().map(start).collect::<Vec<_>>(),
            "starts_requested": self.starts_requested,
            "ending": self.ending.name(), "answered": self.is_answered(),
            "evaluations": self.evaluations, "complete": self.complete,
            "remarks": self.remarks, "settings": self.settings,
        })
    }
}

fn estimate(one: &Estimate) -> Value {
    let known = one.value();
    json!({
        "path": one.variable.path, "unit": one.variable.unit,
        "value": known.map(|(value, _)| value), "standard_error": known.map(|(_, error)| error),
        "determined": one.is_determined(), "standing": one.standing.name(),
        "low": one.variable.low, "high": one.variable.high, "given": one.given,
    })
}

fn signal(one: &FittedSignal) -> Value {
    json!({
        "record": one.record, "column": one.column, "signal": one.address, "unit": one.unit,
        "sigma": one.sigma, "rows": one.times.len(), "rms": one.rms(), "runs_test": one.test,
        "random": one.test.filter(|_| !one.is_exact).map(|test| test.is_random()),
        "outliers": one.outliers.iter().map(|(row, _)| one.times[*row]).collect::<Vec<_>>(),
    })
}

fn misfit(one: &Misfit) -> Value {
    match one {
        Misfit::AboveSigma { column, ratio } => json!({
            "cause": "above_sigma", "column": column, "ratio": ratio,
        }),
        // (A constant signal has no variation.)
        Misfit::Unexplained { column, share } => json!({
            "cause": "unexplained", "column": column, "ratio": share.is_finite().then_some(share),
        }),
    }
}

fn start(one: &StartResult) -> Value {
    json!({
        "start": one.start, "end": one.end, "rms": one.rms, "ending": one.ending.name(),
        "rival": one.is_rival,
    })
}
