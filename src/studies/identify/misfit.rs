//! How far residuals are from what a right model leaves.

use crate::math::probability::chi_squared_share_above;
use serde::Serialize;

/// Probability below which residuals are too great for their standard deviation.
const IMPROBABLE: f64 = 1e-3;

/// Sum of the squared residuals over their stated variances.
#[derive(Clone, Copy, Debug, PartialEq, Serialize)]
pub struct ChiSquared {
    /// The sum.
    pub value: f64,
    /// Degrees of freedom: residuals less numbers that are sought.
    pub degrees: f64,
    /// Probability of as great a sum, or a greater one, if the model and the stated standard
    /// deviations are right.
    pub probability: f64,
}

impl ChiSquared {
    /// Of residuals over their standard deviations.
    pub fn of(residuals: &[f64], degrees: f64) -> Self {
        let value = residuals.iter().map(|own| own * own).sum();
        Self {
            value,
            degrees,
            probability: chi_squared_share_above(degrees, value),
        }
    }

    /// Residuals over their stated standard deviation.
    pub fn ratio(&self) -> f64 {
        (self.value / self.degrees).sqrt()
    }

    /// Whether the residuals are greater than those of a right model.
    pub fn is_improbable(&self) -> bool {
        self.probability < IMPROBABLE
    }
}

/// Why a fit does not explain its records.
#[derive(Clone, Debug, PartialEq)]
pub enum Misfit {
    /// Residuals of a column are far above its stated standard deviation.
    AboveSigma {
        /// Column.
        column: String,
        /// Residuals over the stated standard deviation.
        ratio: f64,
    },
    /// Residuals of a column are not random, and no small part of its variation.
    Unexplained {
        /// Column.
        column: String,
        /// Residuals over the variation of the column, as root mean squares.
        share: f64,
    },
}
