//! Evaluation of a system for the foreign solvers: counts, checks, and keeps
//! the modes and the working memory behind a shared reference.

use super::{Dynamics, Modes, PhysicalStop, Probe};
use std::cell::{Cell, RefCell};

/// A system with its present modes and its working memory. Solvers call the
/// right-hand side through a shared reference, hence the cells.
pub(super) struct Evaluator<'a, D: Dynamics> {
    pub(super) dynamics: &'a D,
    pub(super) modes: RefCell<Modes>,
    scratch: RefCell<D::Scratch>,
    evaluations: Cell<u64>,
    not_finite: Cell<Option<usize>>,
    obstacle: RefCell<Option<PhysicalStop>>,
}

impl<'a, D: Dynamics> Evaluator<'a, D> {
    pub(super) fn new(dynamics: &'a D, modes: &Modes) -> Self {
        Self {
            dynamics,
            modes: RefCell::new(modes.clone()),
            scratch: RefCell::new(dynamics.scratch()),
            evaluations: Cell::new(0),
            not_finite: Cell::new(None),
            obstacle: RefCell::new(None),
        }
    }

    /// dy/dt; remembers the first entry that is not a finite number.
    pub(super) fn derivatives(&self, time: f64, y: &[f64], dy: &mut [f64]) {
        let modes = self.modes.borrow();
        let mut scratch = self.scratch.borrow_mut();
        self.dynamics.derivatives(time, y, &modes, &mut scratch, dy);
        self.evaluations.set(self.evaluations.get() + 1);
        if let Some(index) = dy.iter().position(|entry| !entry.is_finite()) {
            self.not_finite.set(self.not_finite.get().or(Some(index)));
            if let Some(obstacle) = self.dynamics.obstacle(time, &modes, &scratch) {
                self.obstacle.replace(Some(obstacle));
            }
        }
    }

    /// Derivatives of the accelerations along directions, see
    /// [`Dynamics::tangents`]; each counts as one evaluation.
    pub(super) fn tangents(&self, time: f64, y: &[f64], directions: &[f64], out: &mut [f64]) {
        let modes = self.modes.borrow();
        let mut scratch = self.scratch.borrow_mut();
        self.dynamics
            .tangents(time, y, &modes, directions, &mut scratch, out);
        let count = out.len() / self.dynamics.coordinates().max(1);
        self.evaluations.set(self.evaluations.get() + count as u64);
    }

    /// Jacobian times `direction`.
    #[cfg(feature = "diffsol")]
    pub(super) fn tangent(&self, time: f64, y: &[f64], direction: &[f64], out: &mut [f64]) {
        let modes = self.modes.borrow();
        let mut scratch = self.scratch.borrow_mut();
        self.dynamics
            .tangent(time, y, &modes, direction, &mut scratch, out);
        self.evaluations.set(self.evaluations.get() + 1);
    }

    /// Derivative with respect to time at a fixed state.
    pub(super) fn derivative_by_time(&self, time: f64, y: &[f64], out: &mut [f64]) {
        let modes = self.modes.borrow();
        let mut scratch = self.scratch.borrow_mut();
        self.dynamics
            .derivative_by_time(time, y, &modes, &mut scratch, out);
        self.evaluations.set(self.evaluations.get() + 1);
    }

    /// The motion as power series, see [`Dynamics::expand`]; counted as one
    /// evaluation for every order.
    pub(super) fn expand(
        &self,
        span: [f64; 2],
        y: &[f64],
        dy: &[f64],
        degree: usize,
        out: &mut [f64],
    ) -> f64 {
        let modes = self.modes.borrow();
        let mut scratch = self.scratch.borrow_mut();
        self.evaluations
            .set(self.evaluations.get() + degree as u64 - 1);
        self.dynamics
            .expand(span, y, dy, &modes, degree, &mut scratch, out)
    }

    /// All signals as (s, ṡ, s̈) at a state whose derivative is known.
    pub(super) fn signals(&self, time: f64, y: &[f64], dy: &[f64], out: &mut [[f64; 3]]) {
        let count = self.dynamics.coordinates();
        for index in 0..count {
            out[index] = [y[index], y[count + index], dy[count + index]];
        }
        if out.len() > count {
            let modes = self.modes.borrow();
            let mut scratch = self.scratch.borrow_mut();
            self.dynamics
                .extra_signals(time, y, dy, &modes, &mut scratch, &mut out[count..]);
        }
    }

    /// A probe at a state; see [`Dynamics::probe`].
    pub(super) fn probe(&self, probe: &Probe, time: f64, y: &mut [f64]) -> f64 {
        let modes = self.modes.borrow();
        let mut scratch = self.scratch.borrow_mut();
        self.dynamics.probe(probe, time, y, &modes, &mut scratch)
    }

    /// See [`Dynamics::pole_near`].
    pub(super) fn pole_near(&self, span: [f64; 2], y: &[f64], dy: &[f64]) -> Option<PhysicalStop> {
        let modes = self.modes.borrow();
        let mut scratch = self.scratch.borrow_mut();
        self.dynamics.pole_near(span, y, dy, &modes, &mut scratch)
    }

    /// See [`Dynamics::given_end`].
    pub(super) fn given_end(&self, time: f64) -> Option<PhysicalStop> {
        let modes = self.modes.borrow();
        let mut scratch = self.scratch.borrow_mut();
        self.dynamics.given_end(time, &modes, &mut scratch)
    }

    /// Evaluations so far.
    pub(super) fn evaluations(&self) -> u64 {
        self.evaluations.get()
    }

    /// The entry that was not finite since this was last asked; forgets it.
    pub(super) fn take_not_finite(&self) -> Option<usize> {
        self.obstacle.take();
        self.not_finite.take()
    }

    /// Why the mechanism itself gave no numbers since that was last asked.
    pub(super) fn take_obstacle(&self) -> Option<PhysicalStop> {
        self.obstacle.take()
    }
}
