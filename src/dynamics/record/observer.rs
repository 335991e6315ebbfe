//! A system and the memory to look at it anywhere in a step.

use super::peaks::PLACES;
use crate::dynamics::integrate::{Dynamics, Modes};
use crate::dynamics::system::{Bends, Energy, MassState, ObjectState, Power, Scratch, System};
use crate::math::polynomial::{Coefficients, MAX_DEGREE, Step, weights};

/// Looks at a system between the ends of a step.
pub(crate) struct Observer<'s> {
    system: &'s System,
    scratch: Scratch,
    y: Vec<f64>,
    states: Vec<ObjectState>,
    /// Where accelerations are read off long steps.
    bends: Option<Bends>,
    /// What the coefficients of a step of this degree count at [`PLACES`].
    weights: (usize, [Coefficients; 7]),
}

impl<'s> Observer<'s> {
    /// An observer with memory of its own.
    pub(crate) fn new(system: &'s System) -> Self {
        Self {
            system,
            scratch: system.scratch(),
            y: vec![0.0; 2 * system.coordinates()],
            states: vec![ObjectState::default(); system.model().objects.len()],
            bends: None,
            weights: (0, [[0.0; MAX_DEGREE + 1]; 7]),
        }
    }

    /// Of steps of an implicit method: what is stiff is accelerated as they tell.
    pub(crate) fn of_steps(self, implicit: bool) -> Self {
        let bends = implicit.then(|| Bends::new(self.system));
        Self { bends, ..self }
    }

    /// A step of a length (s) is looked at next, whole or in pieces.
    pub(crate) fn begin(&mut self, length: f64) {
        if let Some(bends) = &mut self.bends {
            bends.begin(length);
        }
    }

    /// The system.
    pub(crate) fn system(&self) -> &'s System {
        self.system
    }

    /// States of all objects at the place s of a step.
    pub(crate) fn at(&mut self, step: &Step<'_>, s: f64, modes: &Modes) -> &[ObjectState] {
        let mut states = std::mem::take(&mut self.states);
        self.put(step, s, modes, &mut states);
        self.states = states;
        &self.states
    }

    /// States of all objects at s, into `states`.
    pub(crate) fn put(
        &mut self,
        step: &Step<'_>,
        s: f64,
        modes: &Modes,
        states: &mut [ObjectState],
    ) {
        step.state(s, &mut self.y);
        self.look(step, s, modes, states);
    }

    /// States of all objects at one of the [`PLACES`] of a step, into `states`.
    pub(crate) fn put_at(
        &mut self,
        step: &Step<'_>,
        place: usize,
        modes: &Modes,
        states: &mut [ObjectState],
    ) {
        let s = PLACES[place] * step.end;
        if step.end == 1.0 && step.degree > 0 {
            let (degree, of_places) = &mut self.weights;
            if *degree != step.degree {
                *degree = step.degree;
                *of_places = PLACES.map(|s| weights(step.degree - 1, s));
            }
            step.weighted_state(s, &of_places[place], &mut self.y);
        } else {
            step.state(s, &mut self.y);
        }
        self.look(step, s, modes, states);
    }

    /// States of all objects at s of a step, of which the state is there.
    fn look(&mut self, step: &Step<'_>, s: f64, modes: &Modes, states: &mut [ObjectState]) {
        let (time, system, scratch) = (step.time(s), self.system, &mut self.scratch);
        let bends = self.bends.as_mut();
        match bends.and_then(|bends| bends.read(step, s).then_some(bends)) {
            Some(bends) => system.observe_bent(time, &self.y, modes, bends, scratch, states),
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
        self.system
            .observe(time, y, modes, &mut self.scratch, &mut self.states);
        &self.states
    }

    /// States of all objects at an instant and a state, of a step where there is one.
    pub(crate) fn state_in(
        &mut self,
        step: Option<&Step<'_>>,
        (time, y): (f64, &[f64]),
        modes: &Modes,
    ) {
        match step.filter(|_| self.bends.is_some()) {
            Some(step) => {
                let s = (time - step.start) / step.length;
                self.begin(step.length);
                self.at(step, s.clamp(0.0, step.end), modes);
            }
            None => {
                self.state(time, y, modes);
            }
        }
    }

    /// States of all masses where it was looked last.
    pub(crate) fn masses(&self, y: &[f64], modes: &Modes, masses: &mut [MassState]) {
        self.system.observe_masses(y, modes, &self.scratch, masses);
    }

    /// States of all objects where it was looked last.
    pub(crate) fn states(&self) -> &[ObjectState] {
        &self.states
    }

    /// Powers where it was looked last.
    pub(crate) fn power_there(&self, modes: &Modes) -> Power {
        (self.system).power_observed(&self.y, modes, &self.scratch)
    }

    /// Energies at the place of a step where it was looked last.
    pub(crate) fn energy_there(&self) -> Energy {
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
