//! Derivatives as a JSON document and as rows.

use super::{Derivative, DerivativeVerdict, FigureGradient, Gradient, Parameter};
use serde_json::{Map, Value, json};

impl Gradient {
    /// The JSON document. `scene`: its name.
    pub fn document(&self, scene: &str) -> Value {
        let parameters: Map<String, Value> = (self.parameters.iter())
            .map(|one| {
                (
                    one.path.clone(),
                    json!({ "value": one.value, "unit": one.unit }),
                )
            })
            .collect();
        let gradients: Map<String, Value> = (self.figures.iter())
            .map(|figure| (figure.figure.clone(), self.of_figure(figure)))
            .collect();
        json!({
            "dam": 1, "scene": scene, "parameters": parameters, "gradients": gradients,
            "events": self.events, "check": self.check,
        })
    }

    fn of_figure(&self, figure: &FigureGradient) -> Value {
        let by: Map<String, Value> = (self.parameters.iter().zip(&figure.by))
            .map(|(parameter, own)| (parameter.path.clone(), of_pair(figure, parameter, own)))
            .collect();
        json!({ "value": figure.value, "unit": figure.unit, "by": by })
    }
}

fn of_pair(figure: &FigureGradient, parameter: &Parameter, own: &Derivative) -> Value {
    let [below, above] = sides(&own.verdict);
    json!({
        "derivative": own.derivative,
        "unit": unit_of(&figure.unit, &parameter.unit),
        "elasticity": own.elasticity,
        "verdict": own.verdict.name(),
        "why": own.verdict.why(),
        "below": below,
        "above": above,
        "agrees_to": own.agrees_to,
        "sequence_changes_at": own.sequence_changes_at,
    })
}

/// Derivatives on the two sides where they differ.
pub(crate) fn sides(verdict: &DerivativeVerdict) -> [Option<f64>; 2] {
    match verdict {
        DerivativeVerdict::OneSided { below, above } => [*below, *above],
        DerivativeVerdict::Exact
        | DerivativeVerdict::NotDifferentiable { .. }
        | DerivativeVerdict::NotDetermined { .. }
        | DerivativeVerdict::NotApplicable { .. } => [None, None],
    }
}

/// The unit of a derivative: `rad/(kg m²)`.
pub(crate) fn unit_of(figure: &str, parameter: &str) -> String {
    let whole = if figure.is_empty() { "1" } else { figure };
    let whole = match whole.contains(['/', ' ']) {
        true => format!("({whole})"),
        false => whole.to_owned(),
    };
    match parameter {
        "" => figure.to_owned(),
        unit if unit.contains(['/', ' ']) => format!("{whole}/({unit})"),
        unit => format!("{whole}/{unit}"),
    }
}
