//! The frozen system: numbers laid out for the right-hand side.
//!
//! Immutable and `Sync`. State enters as slices, results leave through
//! `&mut` slices; nothing here allocates, hashes or walks a graph once built.

use crate::fault::Fault;
use crate::integrate::Modes;
use crate::model::Model;

/// A model frozen for integration; implements [`crate::integrate::Dynamics`].
#[derive(Debug)]
pub struct System {
    model: Model,
}

/// Working memory of one evaluation.
#[derive(Clone, Debug, Default)]
pub struct Scratch {}

/// What one object is doing at an instant.
#[derive(Clone, Copy, Debug, Default, PartialEq)]
pub struct ObjectState {
    /// φ of the last mass.
    pub displacement: f64,
    /// φ̇ of the last mass.
    pub speed: f64,
    /// φ̈ of the last mass.
    pub acceleration: f64,
    /// δ = φ_n − U(φ_driver); 0 for drives and rigid objects.
    pub delta: f64,
    /// dδ/dt.
    pub delta_speed: f64,
    /// F of link 1, the force with which the object pulls at its law (the
    /// driver receives F·U′); of a rigid object the constraint's F. For a
    /// drive: the moment that drives it (prescribed: the moment needed).
    pub reaction: f64,
    /// N ≥ 0 of the pair (force and form closures); of a rigid force-closed
    /// pair the margin, negative where it would lift off; 0 when open; NaN
    /// never. Bilateral: 0.
    pub contact_force: f64,
    /// Deformation x of link 1.
    pub deformation: f64,
    /// ẋ of link 1.
    pub deformation_speed: f64,
    /// Clearance of an open pair: distance to the nearest flank, 0 when engaged
    /// or penetrating.
    pub lift: f64,
}

/// Powers at an instant (W).
#[derive(Clone, Copy, Debug, Default, PartialEq)]
pub struct Power {
    /// Work rate of prescribed drives on the mechanism.
    pub drives: f64,
    /// Work rate of all loads (motors and springs included).
    pub loads: f64,
    /// Dissipation in links and pairs, ≥ 0.
    pub dissipated: f64,
}

/// Energies at an instant (J).
#[derive(Clone, Copy, Debug, Default, PartialEq)]
pub struct Energy {
    /// Kinetic energy of all inertias.
    pub kinetic: f64,
    /// Elastic energy of links and pairs.
    pub elastic: f64,
}

/// State at t = 0.
#[derive(Clone, Debug, Default, PartialEq)]
pub struct InitialState {
    /// y = [u, u̇].
    pub y: Vec<f64>,
    /// Modes just after t = 0.
    pub modes: Modes,
    /// Things the user should know (inertia load left out, …).
    pub warnings: Vec<String>,
}

impl System {
    /// Freezes a model.
    ///
    /// # Errors
    /// Every fault that only shows in numbers.
    pub fn new(model: Model) -> Result<Self, Vec<Fault>> {
        Ok(Self { model })
    }

    /// The model it was made from.
    pub fn model(&self) -> &Model {
        &self.model
    }

    /// State just after t = 0, as the model's `start` asks.
    ///
    /// # Errors
    /// No static balance, a start outside the reach of a position function, …
    pub fn initial_state(&self) -> Result<InitialState, Vec<Fault>> {
        todo!()
    }

    /// What every object of the model is doing; `out` has one entry an object.
    pub fn observe(
        &self,
        _time: f64,
        _y: &[f64],
        _modes: &Modes,
        _scratch: &mut Scratch,
        _out: &mut [ObjectState],
    ) {
        todo!()
    }

    /// Powers of drives, loads and dampers.
    pub fn power(&self, _time: f64, _y: &[f64], _modes: &Modes, _scratch: &mut Scratch) -> Power {
        todo!()
    }

    /// Kinetic and elastic energy.
    pub fn energy(&self, _time: f64, _y: &[f64], _modes: &Modes, _scratch: &mut Scratch) -> Energy {
        todo!()
    }

    /// Coordinate index (in y) of the last mass of an object; `None` for
    /// prescribed drives and rigid objects.
    pub fn last_coordinate(&self, _object: usize) -> Option<usize> {
        todo!()
    }

    /// Coordinate index of the first mass (deformation x of link 1).
    pub fn first_coordinate(&self, _object: usize) -> Option<usize> {
        todo!()
    }

    /// Component of [`Modes`] of an object's pair, when it can open.
    /// Values: 0 open, −1 engaged on the lower flank (x < 0), +1 on the upper.
    pub fn pair_component(&self, _object: usize) -> Option<usize> {
        todo!()
    }
}
