//! A motor whose torque falls along a straight line: T₀·(1 − ω/ω₀).

use super::{Domain, ForceLaw, Measure, Parameter};
use crate::dynamics::model::{LinearLoad, LoadLaw};

/// Of a motor that turns.
pub(crate) const LINEAR_TORQUE: ForceLaw = ForceLaw {
    key: "linear",
    doc: "T₀·(1 − ω/ω₀).",
    parameters: &[stall("stall_torque", "Torque at rest, T₀"), NO_LOAD],
    formula: "stall_torque*(1 - phi_dot/no_load_speed)",
    words: "motor, {stall_torque} at rest, none at {no_load_speed}",
    law,
};

/// Of a motor that slides.
pub(crate) const LINEAR_FORCE: ForceLaw = ForceLaw {
    parameters: &[stall("stall_force", "Force at rest, F₀"), NO_LOAD],
    formula: "stall_force*(1 - phi_dot/no_load_speed)",
    words: "motor, {stall_force} at rest, none at {no_load_speed}",
    ..LINEAR_TORQUE
};

const fn stall(key: &'static str, doc: &'static str) -> Parameter {
    Parameter {
        key,
        doc,
        letter: ("T", "0"),
        meaning: "stall torque",
        measure: Measure::Force,
        domain: Domain::NotZero,
        usual: None,
    }
}

const NO_LOAD: Parameter = Parameter {
    key: "no_load_speed",
    doc: "Speed without load, ω₀",
    letter: ("ω", "0"),
    meaning: "no-load speed",
    measure: Measure::Speed,
    domain: Domain::NotZero,
    usual: None,
};

fn law(values: &[f64]) -> LoadLaw {
    LoadLaw::Linear(LinearLoad {
        force: values[0],
        damping: values[0] / values[1],
        ..LinearLoad::default()
    })
}
