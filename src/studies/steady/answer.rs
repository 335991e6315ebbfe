//! What the steady motion of a rigid machine is, and how well independent ways to it agree.

use crate::dynamics::steady::cycle_map::Regime;
use crate::dynamics::steady::flywheel::Flywheel;
use crate::dynamics::steady::{Check, SteadyFigures, SteadyMotion};
use serde::Serialize;

/// The steady motion of a machine with rigid objects.
#[derive(Clone, Debug, Serialize)]
pub struct RigidAnswer {
    /// What moves it.
    pub forces: Forces,
    /// Φ (rad).
    pub cycle: f64,
    /// The figures.
    pub figures: SteadyFigures,
    /// The fixed point of the cycle map, where a moment depends on speed.
    #[serde(skip_serializing_if = "Option::is_none")]
    pub regime: Option<Regime>,
    /// The flywheel, where one was asked for; the motion is the one with it.
    #[serde(skip_serializing_if = "Option::is_none")]
    pub flywheel: Option<Flywheel>,
    /// How well independent ways agree.
    pub agreement: Agreement,
    /// The motion.
    #[serde(skip)]
    pub motion: SteadyMotion,
}

/// How well independent ways to the same motion agree.
#[derive(Clone, Debug, Default, PartialEq, Serialize)]
pub struct Agreement {
    /// The equation of motion, integrated over the cycle, against the energy theorem.
    pub equation: Option<Check>,
    /// Greatest relative difference of ω(φ) between the cycle map and the
    /// energy-mass method.
    pub cycle_map: Option<f64>,
    /// A simulation of the scene in time.
    pub simulation: Option<Simulation>,
    /// Why there is no simulation.
    pub simulation_missing: Option<String>,
}

/// What a simulation of the scene in time came to.
#[derive(Clone, Copy, Debug, PartialEq, Serialize)]
pub struct Simulation {
    /// Cycles simulated.
    pub cycles: u32,
    /// Relative difference of its start from the steady motion.
    pub disturbed: f64,
    /// Relative difference of its last speed from that of the steady motion at
    /// the same position.
    pub speed: f64,
}

/// What moves the machine.
#[derive(Clone, Copy, Debug, PartialEq, Eq, Serialize)]
#[serde(rename_all = "snake_case")]
pub enum Forces {
    /// Forces depend on the position alone: the mean speed was asked for.
    Position,
    /// A moment depends on the speed: the mean speed is a result.
    Speed,
}
