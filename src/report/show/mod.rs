//! The three models of a scene as text: the object graph, the dynamic model
//! (masses, links, frequencies) and the equations of motion.

mod contact;
pub mod equations;
pub mod graph;
pub mod linkages;
pub mod masses;
pub mod motion;
pub mod position;
pub(crate) mod reduced;
pub mod scene;

use crate::dynamics::laws::Measure;
use crate::dynamics::model::Coordinate;

/// Units of an object's quantities, by its kind of coordinate.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub struct QuantityUnits {
    /// Displacement.
    pub displacement: &'static str,
    /// Speed.
    pub speed: &'static str,
    /// Force or moment.
    pub force: &'static str,
    /// Inertia.
    pub inertia: &'static str,
    /// Stiffness.
    pub stiffness: &'static str,
    /// Damping.
    pub damping: &'static str,
    /// Time per displacement.
    pub time_per_displacement: &'static str,
}

impl QuantityUnits {
    /// Unit of a number of a law.
    pub fn of(&self, measure: Measure) -> &'static str {
        match measure {
            Measure::Force => self.force,
            Measure::Stiffness => self.stiffness,
            Measure::Damping => self.damping,
            Measure::Speed => self.speed,
            Measure::TimePerDisplacement => self.time_per_displacement,
            Measure::Number => "",
        }
    }
}

/// Units of an object's quantities.
pub fn units(coordinate: Coordinate) -> QuantityUnits {
    match coordinate {
        Coordinate::Turning => QuantityUnits {
            displacement: "rad",
            speed: "rad/s",
            force: "N m",
            inertia: "kg m²",
            stiffness: "N m/rad",
            damping: "N m s/rad",
            time_per_displacement: "s/rad",
        },
        Coordinate::Sliding => QuantityUnits {
            displacement: "m",
            speed: "m/s",
            force: "N",
            inertia: "kg",
            stiffness: "N/m",
            damping: "N s/m",
            time_per_displacement: "s/m",
        },
    }
}

/// The last part of a load's full name: `rocker.loads.closing` → `closing`.
fn load_word(name: &str) -> &str {
    name.rsplit('.').next().unwrap_or(name)
}
