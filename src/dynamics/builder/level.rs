//! Levels: how much of a uniform elastic object is modelled.

use serde::Serialize;
use std::fmt;

/// A uniform elastic object, of which the model says how much is kept.
#[derive(Clone, Debug, PartialEq)]
pub struct Uniform {
    /// Total inertia J.
    pub inertia: f64,
    /// Stiffness c seen at the output.
    pub stiffness: f64,
    /// Specific damping capacity ψ.
    pub damping_capacity: f64,
    /// How J lies along the object.
    pub split: InertiaSplit,
}

/// How much of an elastic object is modelled.
#[derive(Clone, Copy, Debug, PartialEq, Eq, Serialize)]
#[serde(rename_all = "snake_case", tag = "level")]
pub enum Level {
    /// Nothing of its flexibility.
    Rigid,
    /// It gives way as under slow forces; no vibrations.
    Static,
    /// Its lowest vibration modes; the others give way as under slow forces.
    Modes {
        /// How many.
        count: usize,
    },
    /// A chain of masses.
    Masses {
        /// How many.
        count: usize,
        /// Where the inertia of each cell is put.
        lumping: Lumping,
    },
}

impl Level {
    /// Its coordinates, as it is named: modes or masses.
    pub fn coordinates(self) -> usize {
        match self {
            Self::Rigid | Self::Static => 0,
            Self::Modes { count } | Self::Masses { count, .. } => count,
        }
    }

    /// The level of the same family with so many times the coordinates; `None`: it has no
    /// coordinates to be multiplied.
    pub fn refined(self, times: usize) -> Option<Self> {
        match self {
            Self::Rigid | Self::Static => None,
            Self::Modes { count } => Some(Self::Modes {
                count: count * times,
            }),
            Self::Masses { count, lumping } => Some(Self::Masses {
                count: count * times,
                lumping,
            }),
        }
    }
}

impl fmt::Display for Level {
    /// `2 modes`, `8 masses, balanced`, `static flexibility`.
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        match *self {
            Self::Rigid => f.write_str("rigid"),
            Self::Static => f.write_str("static flexibility"),
            Self::Modes { count: 1 } => f.write_str("1 mode"),
            Self::Modes { count } => write!(f, "{count} modes"),
            Self::Masses { count, lumping } => {
                let masses = if count == 1 { "mass" } else { "masses" };
                write!(f, "{count} {masses}")?;
                match lumping {
                    Lumping::Ends => Ok(()),
                    Lumping::Balanced => f.write_str(", balanced"),
                }
            }
        }
    }
}

/// Split of a chain's total inertia over its masses.
#[derive(Clone, Debug, PartialEq)]
pub enum InertiaSplit {
    /// `"cubes"`: J_m = J·(m³ − (m−1)³)/n³, a uniform lever.
    Cubes,
    /// `"equal"`: J/n.
    Equal,
    /// Shares, summing to 1.
    Shares(Vec<f64>),
}

/// Place of the inertia of each of the n cells of a chain.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq, Serialize)]
#[serde(rename_all = "snake_case")]
pub enum Lumping {
    /// `"ends"`: all of it at the end of the cell that is away from the driver.
    #[default]
    Ends,
    /// `"balanced"`: at both ends of the cell, so that its first moment of compliance
    /// is kept. What lies at the driven end moves with the law.
    Balanced,
}
