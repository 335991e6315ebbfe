//! Bounds of numbers.

use crate::units::shown;
use serde_json::{Map, Value, json};

/// The interval a number must lie in.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Bounds {
    /// Lower end and whether it is included.
    pub lower: Option<(f64, bool)>,
    /// Upper end and whether it is included.
    pub upper: Option<(f64, bool)>,
    /// Whether zero is refused.
    pub not_zero: bool,
}

impl Bounds {
    /// Any finite number.
    pub const ANY: Self = Self {
        lower: None,
        upper: None,
        not_zero: false,
    };
    /// > 0.
    pub const POSITIVE: Self = Self {
        lower: Some((0.0, false)),
        ..Self::ANY
    };
    /// ≥ 0.
    pub const NOT_NEGATIVE: Self = Self {
        lower: Some((0.0, true)),
        ..Self::ANY
    };
    /// ≠ 0.
    pub const NOT_ZERO: Self = Self {
        not_zero: true,
        ..Self::ANY
    };

    /// From `lower` to `upper`, both included.
    pub const fn between(lower: f64, upper: f64) -> Self {
        Self {
            lower: Some((lower, true)),
            upper: Some((upper, true)),
            not_zero: false,
        }
    }

    /// Greater than zero and at most `upper`.
    pub const fn up_to(upper: f64) -> Self {
        Self {
            upper: Some((upper, true)),
            ..Self::POSITIVE
        }
    }

    /// Whether a number lies within.
    pub fn hold(&self, number: f64) -> bool {
        let above = self
            .lower
            .is_none_or(|(end, included)| number > end || (included && number == end));
        let below = self
            .upper
            .is_none_or(|(end, included)| number < end || (included && number == end));
        above && below && !(self.not_zero && number == 0.0)
    }

    /// In words: `at least 0 and less than 1`.
    pub fn words(&self) -> String {
        let mut parts = Vec::new();
        if let Some((end, included)) = self.lower {
            let word = if included { "at least" } else { "greater than" };
            parts.push(format!("{word} {}", number_text(end)));
        }
        if let Some((end, included)) = self.upper {
            let word = if included { "at most" } else { "less than" };
            parts.push(format!("{word} {}", number_text(end)));
        }
        if self.not_zero {
            parts.push("not 0".to_owned());
        }
        parts.join(" and ")
    }

    /// Writes them into a JSON Schema.
    pub(super) fn describe(&self, schema: &mut Map<String, Value>) {
        if let Some((end, included)) = self.lower {
            let name = if included {
                "minimum"
            } else {
                "exclusiveMinimum"
            };
            schema.insert(name.into(), json!(end));
        }
        if let Some((end, included)) = self.upper {
            let name = if included {
                "maximum"
            } else {
                "exclusiveMaximum"
            };
            schema.insert(name.into(), json!(end));
        }
        if self.not_zero {
            schema.insert("not".into(), json!({ "const": 0 }));
        }
    }
}

/// Digits of a number that somebody wrote: rounding stands behind them.
const ALL_THAT_IS_MEANT: usize = 12;

/// A number as people write it.
pub(super) fn number_text(value: f64) -> String {
    shown(value, ALL_THAT_IS_MEANT)
}
