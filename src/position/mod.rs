//! Position functions U(φ): where the driver asks the driven object to be.
//!
//! A position function is pure. It gives U with its geometric transfer
//! functions U′, U″ and U‴ at any driver displacement φ it can reach, says
//! where it changes its formula ([`Breaks`]) and which interval of φ it
//! reaches. The system evaluates [`Position`], a closed set for speed, with one
//! open variant.

mod spec;

pub use spec::{CamSpec, LawName, PositionSpec};

use crate::breaks::Breaks;
use crate::jet::Jet;
use std::fmt;
use std::sync::Arc;

/// A position function that this library does not know, supplied by its user.
pub trait PositionFunction: fmt::Debug + Send + Sync {
    /// U and its first three derivatives at `phi`, by the formula of `segment`
    /// (see [`Breaks`]), which may be asked a little beyond the segment's edges.
    fn jet(&self, segment: i64, phi: f64) -> Jet;

    /// Where the formula changes.
    fn breaks(&self) -> Breaks {
        Breaks::NONE
    }

    /// The interval of φ in which the function exists; `None`: everywhere.
    fn reach(&self) -> Option<(f64, f64)> {
        None
    }
}

/// A position function, ready to be evaluated.
#[derive(Clone, Debug)]
pub enum Position {
    /// U = ratio·φ + offset.
    Ratio {
        /// U′: dimensionless, metres per radian or radians per metre.
        ratio: f64,
        /// U at φ = 0.
        offset: f64,
    },
    /// U = amplitude·sin(harmonic·φ + phase) + offset.
    Sine {
        /// Half the full stroke (rad or m).
        amplitude: f64,
        /// Oscillations per turn of the driver.
        harmonic: f64,
        /// Phase at φ = 0 (rad).
        phase: f64,
        /// Middle of the stroke (rad or m).
        offset: f64,
    },
    /// Anything else.
    Custom(Arc<dyn PositionFunction>),
}

impl Position {
    /// U and its first three derivatives at `phi`, by the formula of `segment`.
    #[inline]
    pub fn jet(&self, segment: i64, phi: f64) -> Jet {
        match self {
            Self::Ratio { ratio, offset } => Jet {
                value: ratio * phi + offset,
                first: *ratio,
                ..Jet::default()
            },
            Self::Sine {
                amplitude,
                harmonic,
                phase,
                offset,
            } => {
                let (sin, cos) = (harmonic * phi + phase).sin_cos();
                let first = amplitude * harmonic;
                let second = first * harmonic;
                Jet {
                    value: amplitude * sin + offset,
                    first: first * cos,
                    second: -second * sin,
                    third: -second * harmonic * cos,
                }
            }
            Self::Custom(function) => function.jet(segment, phi),
        }
    }

    /// Where the formula changes.
    pub fn breaks(&self) -> Breaks {
        match self {
            Self::Custom(function) => function.breaks(),
            _ => Breaks::NONE,
        }
    }

    /// The interval of φ in which the function exists; `None`: everywhere.
    pub fn reach(&self) -> Option<(f64, f64)> {
        match self {
            Self::Custom(function) => function.reach(),
            _ => None,
        }
    }
}
