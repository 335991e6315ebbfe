//! A spring to the ground.

use super::{Domain, ForceLaw, Measure, Parameter};
use crate::dynamics::model::LoadLaw;

pub(crate) const SPRING: ForceLaw = ForceLaw {
    key: "spring",
    doc: "Spring: W = −preload − rate·φ.",
    parameters: &[
        Parameter {
            key: "rate",
            doc: "Rate of the spring",
            letter: ("k", ""),
            meaning: "spring rate",
            measure: Measure::Stiffness,
            domain: Domain::NotNegative,
            usual: None,
        },
        Parameter {
            key: "preload",
            doc: "Force at φ = 0, positive towards negative displacement",
            letter: ("P", ""),
            meaning: "preload",
            measure: Measure::Force,
            domain: Domain::Any,
            usual: Some(0.0),
        },
    ],
    formula: "-preload - rate*phi",
    words: "spring, rate {rate}, preload {preload}",
    law: |values| LoadLaw::spring(values[0], values[1]),
};
