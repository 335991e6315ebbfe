//! What is sought.

use serde::Serialize;

/// Which end is sought.
#[derive(Clone, Copy, Debug, PartialEq, Eq, Serialize)]
#[serde(rename_all = "snake_case")]
pub enum Aim {
    /// The greatest.
    Maximize,
    /// The least.
    Minimize,
}

impl Aim {
    /// In words.
    pub fn words(self) -> &'static str {
        match self {
            Self::Maximize => "greatest",
            Self::Minimize => "least",
        }
    }

    /// What a value is worth: the more the better.
    pub(super) fn rank_of_value(self, value: f64) -> f64 {
        match self {
            Self::Maximize => value,
            Self::Minimize => -value,
        }
    }
}

/// What is to be greatest or least.
#[derive(Clone, Debug, PartialEq, Serialize)]
pub struct Goal {
    /// Which end.
    pub aim: Aim,
    /// Address of the parameter that varies, or of a figure.
    pub of: String,
    /// True: the parameter itself.
    pub is_parameter: bool,
    /// Unit: of a figure the SI one, of the parameter that in which it is written.
    pub unit: String,
}
