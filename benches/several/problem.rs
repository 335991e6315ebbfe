//! Equations written by hand as something that the methods of the program integrate.

use dam::integrate::{Dynamics, EventFunction, Impact, Modes, PhysicalStop};
use dam::number::{Dual, Duals, Number};
use std::marker::PhantomData;

/// u″ of a state, in dy together with u′.
pub(crate) trait Equations: Sync {
    fn derivatives<N: Number>(y: &[N], dy: &mut [N]);
}

/// As many directions at once as the program takes.
const DIRECTIONS: usize = 8;

/// Such equations, with the scales that the program has for the same mechanism.
pub(crate) struct ByHand<E> {
    pub(crate) scales: Vec<f64>,
    equations: PhantomData<E>,
}

impl<E> ByHand<E> {
    pub(crate) fn new(scales: &[f64]) -> Self {
        Self {
            scales: scales.to_vec(),
            equations: PhantomData,
        }
    }
}

/// State and derivative on numbers with derivatives.
pub(crate) struct Room {
    dual: [Vec<Dual>; 2],
    bundle: [Vec<Duals<DIRECTIONS>>; 2],
}

impl<E: Equations> Dynamics for ByHand<E> {
    type Scratch = Room;

    fn scratch(&self) -> Room {
        let count = self.scales.len();
        Room {
            dual: [0, 1].map(|_| vec![Dual::default(); count]),
            bundle: [0, 1].map(|_| vec![Duals::from(0.0); count]),
        }
    }

    fn coordinates(&self) -> usize {
        self.scales.len() / 2
    }

    fn signals(&self) -> usize {
        self.coordinates()
    }

    fn derivatives(&self, _: f64, y: &[f64], _: &Modes, _: &mut Room, dy: &mut [f64]) {
        E::derivatives(y, dy);
    }

    fn tangent(
        &self,
        _: f64,
        y: &[f64],
        _: &Modes,
        direction: &[f64],
        room: &mut Room,
        out: &mut [f64],
    ) {
        let [state, found] = &mut room.dual;
        for ((state, &y), &along) in state.iter_mut().zip(y).zip(direction) {
            *state = Dual::new(y, along);
        }
        E::derivatives(state, found);
        for (out, found) in out.iter_mut().zip(found) {
            *out = found.derivative;
        }
    }

    fn tangents(
        &self,
        _: f64,
        y: &[f64],
        _: &Modes,
        directions: &[f64],
        room: &mut Room,
        out: &mut [f64],
    ) {
        let count = self.coordinates();
        let [state, found] = &mut room.bundle;
        let directions = directions.chunks(DIRECTIONS * 2 * count);
        for (directions, out) in directions.zip(out.chunks_mut(DIRECTIONS * count)) {
            for (state, &y) in state.iter_mut().zip(y) {
                *state = Duals::from(y);
            }
            for (k, direction) in directions.chunks_exact(2 * count).enumerate() {
                for (state, &along) in state.iter_mut().zip(direction) {
                    state.derivatives[k] = along;
                }
            }
            E::derivatives(state, found);
            for (k, out) in out.chunks_exact_mut(count).enumerate() {
                for (out, found) in out.iter_mut().zip(&found[count..]) {
                    *out = found.derivatives[k];
                }
            }
        }
    }

    fn is_autonomous(&self) -> bool {
        true
    }

    fn derivative_by_time(&self, _: f64, _: &[f64], _: &Modes, _: &mut Room, out: &mut [f64]) {
        out.fill(0.0);
    }

    fn extra_signals(
        &self,
        _: f64,
        _: &[f64],
        _: &[f64],
        _: &Modes,
        _: &mut Room,
        _: &mut [[f64; 3]],
    ) {
    }

    fn scales(&self) -> &[f64] {
        &self.scales
    }

    fn state_name(&self, index: usize) -> String {
        format!("entry {index}")
    }

    fn event_functions(&self, _: &Modes, out: &mut Vec<EventFunction>) {
        out.clear();
    }

    fn switch(
        &self,
        _: f64,
        _: &mut [f64],
        _: &EventFunction,
        _: &mut Modes,
    ) -> Result<Option<Impact>, PhysicalStop> {
        Ok(None)
    }

    fn next_break(&self, _: f64, _: &Modes) -> f64 {
        f64::INFINITY
    }

    fn pass_break(&self, _: f64, _: &mut Modes) {}

    fn is_pair(&self, _: usize) -> bool {
        false
    }
}
