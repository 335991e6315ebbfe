//! The quantities that a record has columns of.

use super::{Column, Record};
use crate::model::Coordinate;
use serde::{Serialize, Serializer};
use std::fmt;

/// A quantity of an object over time. Of a chain all but the forces are those of its
/// last mass.
#[derive(Clone, Copy, Debug, PartialEq, Eq, PartialOrd, Ord, Hash)]
pub enum Quantity {
    /// Displacement φ (rad or m).
    Displacement,
    /// Speed φ̇.
    Speed,
    /// Acceleration φ̈.
    Acceleration,
    /// Positioning error δ = φ − U.
    Delta,
    /// Reaction F of link 1, which loads the driver with F·U′ (N·m or N).
    Reaction,
    /// Contact force N of the driving pair, ≥ 0 while it is engaged.
    ContactForce,
}

impl Quantity {
    /// All quantities, in the order of the columns.
    pub const ALL: [Self; 6] = [
        Self::Displacement,
        Self::Speed,
        Self::Acceleration,
        Self::Delta,
        Self::Reaction,
        Self::ContactForce,
    ];

    /// Its name in files: `contact_force`.
    pub const fn name(self) -> &'static str {
        match self {
            Self::Displacement => "displacement",
            Self::Speed => "speed",
            Self::Acceleration => "acceleration",
            Self::Delta => "delta",
            Self::Reaction => "reaction",
            Self::ContactForce => "contact_force",
        }
    }

    /// Its SI unit for an object that turns or slides.
    pub const fn unit(self, coordinate: Coordinate) -> &'static str {
        match (self, coordinate) {
            (Self::Displacement | Self::Delta, Coordinate::Turning) => "rad",
            (Self::Displacement | Self::Delta, Coordinate::Sliding) => "m",
            (Self::Speed, Coordinate::Turning) => "rad/s",
            (Self::Speed, Coordinate::Sliding) => "m/s",
            (Self::Acceleration, Coordinate::Turning) => "rad/s²",
            (Self::Acceleration, Coordinate::Sliding) => "m/s²",
            (Self::Reaction | Self::ContactForce, Coordinate::Turning) => "N m",
            (Self::Reaction | Self::ContactForce, Coordinate::Sliding) => "N",
        }
    }
}

impl fmt::Display for Quantity {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        f.write_str(self.name())
    }
}

impl Serialize for Quantity {
    fn serialize<S: Serializer>(&self, serializer: S) -> Result<S::Ok, S::Error> {
        serializer.serialize_str(self.name())
    }
}

impl Record {
    /// The column of a quantity of an object, or of an output of one (`press.ram`).
    pub fn column(&self, object: &str, quantity: Quantity) -> Option<&Column> {
        let wanted = |column: &&Column| column.quantity == quantity && column.object == object;
        self.columns.iter().find(wanted)
    }
}
