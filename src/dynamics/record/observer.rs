//! A system and the memory to look at it anywhere in a step.

use crate::dynamics::integrate::{Dynamics, Modes};
use crate::dynamics::system::{Energy, MassState, ObjectState, Power, Scratch, System};
use crate::math::polynomial::Step;

/// Looks at a system between the ends of a step.
pub(crate) struct Observer<'s> {
    system: &'s System,
    scratch: Scratch,
    y: Vec<f64>,
    states: Vec<ObjectState>,
}

impl<'s> Observer<'s> {
    /// An observer with memory of its own.
    pub(crate) fn new(system: &'s System) -> Self {
        Self {
            system,
            scratch: system.scratch(),
            y: vec![0.0; 2 * system.coordinates()],
            states: vec![ObjectState::default(); system.model().objects.len()],
        }
    }

    /// The system.
    pub(crate) fn system(&self) -> &'s System {
        self.system
    }

    /// States of all objects at the place s of a step.
    pub(crate) fn at(&mut self, step: &Step<'_>, s: f64, modes: &Modes) -> &[ObjectState] {
        step.state(s, &mut self.y);
        let time = step.time(s);
        self.system
            .observe(time, &self.y, modes, &mut self.scratch, &mut self.states);
        &self.states
    }

    /// States of all objects at a state of the system.
    pub(crate) fn state(&mut self, time: f64, y: &[f64], modes: &Modes) -> &[ObjectState] {
        self.system
            .observe(time, y, modes, &mut self.scratch, &mut self.states);
        &self.states
    }

    /// States of all masses where it was looked last.
    pub(crate) fn masses(&self, y: &[f64], modes: &Modes, masses: &mut [MassState]) {
        self.system.observe_masses(y, modes, &self.scratch, masses);
    }

    /// States of all objects where it was looked last.
    pub(crate) fn states(&self) -> &[ObjectState] {
        &self.states
    }

    /// What all objects are doing at s, into `states`, with powers and energies.
    pub(crate) fn closely(
        &mut self,
        step: &Step<'_>,
        s: f64,
        modes: &Modes,
        states: &mut [ObjectState],
    ) -> (Power, Energy) {
        step.state(s, &mut self.y);
        self.system
            .observe_closely(step.time(s), &self.y, modes, &mut self.scratch, states)
    }

    /// Powers at s.
    pub(crate) fn power(&mut self, step: &Step<'_>, s: f64, modes: &Modes) -> Power {
        step.state(s, &mut self.y);
        self.system
            .power(step.time(s), &self.y, modes, &mut self.scratch)
    }

    /// Power lost to the friction of joints where the powers were asked for last, an
    /// object each.
    pub(crate) fn friction_losses<'a>(
        &'a self,
        modes: &'a Modes,
    ) -> impl Iterator<Item = (usize, f64)> + 'a {
        self.system.friction_losses(modes, &self.scratch)
    }

    /// A number that changes at kinks of the friction, where the system was looked at
    /// last.
    pub(crate) fn friction_side(&self) -> u64 {
        self.system.friction_side(&self.scratch)
    }

    /// Energies at a state.
    pub(crate) fn energy_of(&mut self, time: f64, y: &[f64], modes: &Modes) -> Energy {
        self.system.energy(time, y, modes, &mut self.scratch)
    }
}
