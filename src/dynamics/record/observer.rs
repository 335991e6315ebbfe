//! A system and the memory to look at it anywhere in a step.

use super::peaks::PLACES;
use crate::dynamics::integrate::{Dynamics, Modes};
use crate::dynamics::system::{
    Energy, MassState, ObjectState, OutputAccelerations, Power, Scratch, System,
};
use crate::math::polynomial::{Places, Step};

/// Looks at a system between the ends of a step.
pub(crate) struct Observer<'s> {
    system: &'s System,
    scratch: Scratch,
    y: Vec<f64>,
    states: Vec<ObjectState>,
    /// Where accelerations are read off long steps.
    bends: Option<OutputAccelerations>,
    places: Places,
    /// States of the system at the places of the step at hand, place after place.
    states_there: Vec<f64>,
    /// Second derivatives there, where accelerations are read off it.
    bends_there: Vec<f64>,
}

impl<'s> Observer<'s> {
    /// An observer with memory of its own.
    pub(crate) fn new(system: &'s System) -> Self {
        let coordinates = system.coordinates();
        Self {
            system,
            scratch: system.scratch(),
            y: vec![0.0; 2 * coordinates],
            states: vec![ObjectState::default(); system.model().objects.len()],
            bends: None,
            places: Places::new(&PLACES),
            states_there: vec![0.0; 2 * coordinates * PLACES.len()],
            bends_there: vec![0.0; coordinates * PLACES.len()],
        }
    }

    /// Of steps of an implicit method: what is stiff is accelerated as they tell.
    pub(crate) fn of_steps(self, implicit: bool) -> Self {
        let bends = implicit.then(|| OutputAccelerations::new(self.system));
        Self { bends, ..self }
    }

    /// A step of a length (s) is looked at next, whole or in pieces.
    pub(crate) fn begin_step(&mut self, length: f64) {
        if let Some(bends) = &mut self.bends {
            bends.begin_step(length);
        }
    }

    /// The system.
    pub(crate) fn system(&self) -> &'s System {
        self.system
    }

    /// States of all objects at the place s of a step.
    pub(crate) fn at(&mut self, step: &Step<'_>, s: f64, modes: &Modes) -> &[ObjectState] {
        let mut states = std::mem::take(&mut self.states);
        self.observe_into(step, s, modes, &mut states);
        self.states = states;
        &self.states
    }

    /// States of all objects at s, into `states`.
    pub(crate) fn observe_into(
        &mut self,
        step: &Step<'_>,
        s: f64,
        modes: &Modes,
        states: &mut [ObjectState],
    ) {
        self.states_at(step, (s, step.time(s)), modes, states);
    }

    /// States of all objects at s, which is told to be at an instant, into `states`.
    fn states_at(
        &mut self,
        step: &Step<'_>,
        (s, time): (f64, f64),
        modes: &Modes,
        states: &mut [ObjectState],
    ) {
        step.state(s, &mut self.y);
        if let Some(bends) = self.bends.as_mut().filter(|bends| bends.is_wanted()) {
            bends.read(step, s);
        }
        self.observe_current(time, modes, states);
    }

    /// Looks at a step at all its [`PLACES`], for [`Self::states_at_place`].
    pub(crate) fn evaluate_places(&mut self, step: &Step<'_>) {
        if step.coordinates == 0 {
            return;
        }
        self.places.states(step, &mut self.states_there);
        if self
            .bends
            .as_ref()
            .is_some_and(OutputAccelerations::is_wanted)
        {
            self.places.accelerations(step, &mut self.bends_there);
        }
    }

    /// States of all objects at one of the [`PLACES`] of the step gone to, into `states`.
    pub(crate) fn states_at_place(
        &mut self,
        step: &Step<'_>,
        place: usize,
        modes: &Modes,
        states: &mut [ObjectState],
    ) {
        let n = step.coordinates;
        self.y
            .copy_from_slice(&self.states_there[2 * n * place..][..2 * n]);
        if let Some(bends) = self.bends.as_mut().filter(|bends| bends.is_wanted()) {
            bends.set(&self.bends_there[n * place..][..n]);
        }
        self.observe_current(step.time(PLACES[place] * step.end), modes, states);
    }

    /// States of all objects at an instant at which the state is there, and what bends the
    /// step.
    fn observe_current(&mut self, time: f64, modes: &Modes, states: &mut [ObjectState]) {
        let (system, scratch) = (self.system, &mut self.scratch);
        match self.bends.as_ref().filter(|bends| bends.is_wanted()) {
            Some(bends) => {
                system.observe_with_accelerations(time, &self.y, modes, bends, scratch, states)
            }
            None => system.observe(time, &self.y, modes, scratch, states),
        }
    }

    /// Displacements and speeds of all objects at s; what else was seen of them stays.
    pub(crate) fn motion_at(&mut self, step: &Step<'_>, s: f64, modes: &Modes) -> &[ObjectState] {
        step.state(s, &mut self.y);
        let (scratch, states) = (&mut self.scratch, &mut self.states);
        (self.system).observe_motion(step.time(s), &self.y, modes, scratch, states);
        &self.states
    }

    /// States of all objects at a state of the system.
    pub(crate) fn state(&mut self, time: f64, y: &[f64], modes: &Modes) -> &[ObjectState] {
        self.state_of(time, modes, |own| own.copy_from_slice(y))
    }

    /// States of all objects at the state of the system that `fill` gives.
    pub(crate) fn state_of(
        &mut self,
        time: f64,
        modes: &Modes,
        fill: impl FnOnce(&mut [f64]),
    ) -> &[ObjectState] {
        fill(&mut self.y);
        self.system
            .observe(time, &self.y, modes, &mut self.scratch, &mut self.states);
        &self.states
    }

    /// States of all objects at an instant of a step.
    pub(crate) fn state_in(&mut self, step: &Step<'_>, time: f64, modes: &Modes) {
        let s = ((time - step.start) / step.length).clamp(0.0, step.end);
        self.begin_step(step.length);
        let mut states = std::mem::take(&mut self.states);
        self.states_at(step, (s, time), modes, &mut states);
        self.states = states;
    }

    /// States of all masses where it was looked last.
    pub(crate) fn masses(&self, modes: &Modes, masses: &mut [MassState]) {
        self.system
            .observe_masses(&self.y, modes, &self.scratch, masses);
    }

    /// States of all objects where it was looked last.
    pub(crate) fn states(&self) -> &[ObjectState] {
        &self.states
    }

    /// Powers where it was looked last.
    pub(crate) fn last_power(&self, modes: &Modes) -> Power {
        (self.system).power_observed(&self.y, modes, &self.scratch)
    }

    /// Energies at the place of a step where it was looked last.
    pub(crate) fn last_energy(&self) -> Energy {
        self.system.energy_observed(&self.y, &self.scratch)
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
