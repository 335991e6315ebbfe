//! The quantities that a record has columns of.

use super::{Column, Record};
use crate::dynamics::model::Coordinate;
use serde::{Serialize, Serializer};
use std::borrow::Cow;
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
    /// Greatest Hertzian pressure of the contact (Pa): of objects alone of which it is known,
    /// on their cam or by the geometry of their contact.
    ContactPressure,
    /// Displacement φ_m of mass m of a chain, counted from 1; recorded on request.
    MassDisplacement(usize),
    /// Speed φ̇_m of mass m.
    MassSpeed(usize),
    /// Force of link m, which loads mass m towards the driver.
    LinkForce(usize),
}

impl Quantity {
    /// The quantities of every object, in the order of the columns.
    pub const ALL: [Self; 6] = [
        Self::Displacement,
        Self::Speed,
        Self::Acceleration,
        Self::Delta,
        Self::Reaction,
        Self::ContactForce,
    ];

    /// The quantities of mass m of a chain and of its link, in the order of the columns.
    pub const fn of_mass(mass: usize) -> [Self; 3] {
        [
            Self::MassDisplacement(mass),
            Self::MassSpeed(mass),
            Self::LinkForce(mass),
        ]
    }

    /// Name in files: `contact_force`, `mass_2.speed`.
    pub fn name(self) -> Cow<'static, str> {
        Cow::Borrowed(match self {
            Self::Displacement => "displacement",
            Self::Speed => "speed",
            Self::Acceleration => "acceleration",
            Self::Delta => "delta",
            Self::Reaction => "reaction",
            Self::ContactForce => "contact_force",
            Self::ContactPressure => "contact_pressure",
            Self::MassDisplacement(mass) => return format!("mass_{mass}.displacement").into(),
            Self::MassSpeed(mass) => return format!("mass_{mass}.speed").into(),
            Self::LinkForce(mass) => return format!("link_{mass}.force").into(),
        })
    }

    /// SI unit for an object that turns or slides.
    pub const fn unit(self, coordinate: Coordinate) -> &'static str {
        let [turning, sliding] = match self {
            Self::Displacement | Self::Delta | Self::MassDisplacement(_) => ["rad", "m"],
            Self::Speed | Self::MassSpeed(_) => ["rad/s", "m/s"],
            Self::Acceleration => ["rad/s²", "m/s²"],
            Self::Reaction | Self::ContactForce | Self::LinkForce(_) => ["N m", "N"],
            Self::ContactPressure => ["Pa", "Pa"],
        };
        match coordinate {
            Coordinate::Turning => turning,
            Coordinate::Sliding => sliding,
        }
    }
}

impl fmt::Display for Quantity {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        f.write_str(&self.name())
    }
}

impl Serialize for Quantity {
    fn serialize<S: Serializer>(&self, serializer: S) -> Result<S::Ok, S::Error> {
        serializer.serialize_str(&self.name())
    }
}

impl Record {
    /// The column of a quantity of an object, or of an output of one (`press.ram`).
    pub fn column(&self, object: &str, quantity: Quantity) -> Option<&Column> {
        let wanted = |column: &&Column| column.quantity == quantity && column.object == object;
        self.columns.iter().find(wanted)
    }
}
