//! What the skewness of a stroke is to make least.

use super::StrokeFigures;

/// What the skewness is to make least, (1.6). The weight ξ ≥ 0 says how much
/// the run-out counts.
#[derive(Clone, Copy, Debug, PartialEq)]
pub enum Criterion {
    /// K1 = Π″_max + ξ·|Π″_min|: forces.
    Acceleration {
        /// ξ.
        weight: f64,
    },
    /// K2 = (Π′Π″)_max + ξ·|(Π′Π″)_min|: torques.
    Product {
        /// ξ.
        weight: f64,
    },
}

impl Criterion {
    /// ξ.
    pub fn weight(self) -> f64 {
        match self {
            Self::Acceleration { weight } | Self::Product { weight } => weight,
        }
    }

    /// Value of the criterion for a stroke, counted in the direction of the stroke.
    pub fn of(self, figures: &StrokeFigures) -> f64 {
        match self {
            Self::Acceleration { weight } => {
                figures.acceleration_run_up.abs() + weight * figures.acceleration_run_out
            }
            Self::Product { weight } => figures.product_run_up + weight * figures.product_run_out,
        }
    }
}
