//! Conditions on a motion: the first time at which each holds is a result of the run.

use crate::math::expression::Expression;

/// Name of the condition that ends a run.
pub const UNTIL: &str = "until";

/// Names that a condition may use, each with the index of its value: the time, then what the
/// object does (`Watch`).
pub(crate) const NAMES: [(&str, usize); 13] = [
    ("t", 0),
    ("phi", 1),
    ("phi_dot", 2),
    ("φ", 1),
    ("φ\u{307}", 2),
    ("displacement", 1),
    ("speed", 2),
    ("acceleration", 3),
    ("delta", 4),
    ("δ", 4),
    ("reaction", 5),
    ("contact_force", 6),
    ("clearance", 7),
];

/// A condition on the motion of an object.
#[derive(Clone, Debug, PartialEq)]
pub struct Condition {
    /// Name of its first time among the figures of the run; [`UNTIL`] ends the run.
    pub name: String,
    /// Id of the object, or of an output (`press.ram`).
    pub object: String,
    /// True where its value is not 0, in SI units.
    pub expression: Expression,
}
