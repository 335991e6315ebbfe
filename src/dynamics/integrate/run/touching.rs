//! Contacts that just touch.
//!
//! A contact that closes with neither depth nor speed, as one does that starts on its law
//! or behind a massless point, has no sign yet that numbers could tell. It is closed and
//! stays so until it is pressed beyond the tolerance, or comes apart beyond it. Otherwise
//! the rounding of zero would open and close it without end. One that a derivative opens at
//! the start stays open in the same way.

use super::Run;
use crate::dynamics::integrate::{Dynamics, EventFunction, Guard, UndecidedGuard};

/// Share of the tolerance of a state within which a contact just touches: errors of some
/// steps add up.
const TOLERANCES: f64 = 10.0;

/// How much farther it may seem to come apart between two states at which it touches: what
/// a method knows between them is less exact than they are.
const BETWEEN: f64 = 10.0;

/// A contact that just touches.
#[derive(Clone, Copy, Debug, PartialEq)]
pub(in crate::dynamics::integrate) struct GrazingContact {
    /// Component of the modes.
    pub(in crate::dynamics::integrate) component: usize,
    /// True where it is open and would close.
    pub(in crate::dynamics::integrate) rising: bool,
    /// Values by which its two guards must be on the other side of zero.
    pub(in crate::dynamics::integrate) floors: [f64; 2],
}

impl GrazingContact {
    /// Shifts the coefficients of its two guards, signed so that it comes apart where one is
    /// above zero, and closes where both are; `degree` is the last, which is the value at
    /// the end of the step.
    pub(in crate::dynamics::integrate) fn shift(&self, guards: [&mut [f64]; 2], degree: usize) {
        let ends = [guards[0][degree], guards[1][degree]];
        let beyond = [0, 1].map(|index| ends[index] > self.floors[index]);
        let changed = match self.rising {
            true => beyond == [true, true],
            false => beyond != [false, false],
        };
        let factor = if changed { 1.0 } else { BETWEEN };
        for (guard, floor) in guards.into_iter().zip(self.floors) {
            guard.iter_mut().for_each(|c| *c -= factor * floor);
        }
    }
}

impl<D: Dynamics> Run<'_, D> {
    /// Finds which elastic contacts just touch where the run stands, by those of their
    /// functions.
    pub(super) fn find_touching(&mut self, of: impl Fn(&EventFunction) -> bool) {
        let dynamics = self.evaluator.dynamics;
        self.hold_touching(|own| of(own) && !dynamics.is_rigid_contact(own.component));
    }

    /// Keeps a rigid contact open that has just come apart: it leaves with neither distance
    /// nor speed, and the polynomial of a method may lie on the other side by its error.
    pub(super) fn keep_apart(&mut self, components: &[usize]) {
        self.hold_touching(|own| own.rising && components.contains(&own.component));
    }

    fn hold_touching(&mut self, of: impl Fn(&EventFunction) -> bool) {
        for function in &self.event_functions {
            let component = function.component;
            let known = self.touching.iter().any(|own| own.component == component);
            if of(function) && !known && self.touches(function) {
                let floors = function.guards.map(|guard| self.floor(&guard));
                self.touching.push(GrazingContact {
                    component,
                    rising: function.rising,
                    floors,
                });
            }
        }
    }

    /// Lets go of those that are pressed, or apart, beyond the tolerance, or have changed.
    pub(super) fn release_touching(&mut self) {
        if self.touching.is_empty() {
            return;
        }
        let mut touching = std::mem::take(&mut self.touching);
        touching.retain(|own| {
            let mut functions = self.event_functions.iter();
            functions.any(|f| {
                let same = f.component == own.component && f.rising == own.rising;
                let sense = if f.rising { -1.0 } else { 1.0 };
                // (Not by its rate: that of a massless point is no better than its place
                // over its time constant.)
                same && sense * self.depth(f) <= self.floor(&f.guards[0])
            })
        });
        self.touching = touching;
    }

    /// Finds which guards have neither a sign nor a rate where the run starts.
    pub(super) fn find_resting(&mut self) {
        if self.evaluator.dynamics.has_crossings() {
            self.resting = self.undecided_guards();
            self.resting.retain(|own| own.rate == 0.0);
        }
    }

    /// Lets go of those that have a sign by now.
    pub(super) fn release_resting(&mut self) {
        if !self.resting.is_empty() {
            let undecided = self.undecided_guards();
            let still =
                |own: &UndecidedGuard| undecided.iter().any(|one| one.component == own.component);
            self.resting.retain(still);
        }
    }

    fn undecided_guards(&self) -> Vec<UndecidedGuard> {
        let modes = self.evaluator.modes.borrow();
        let share = TOLERANCES * self.settings.tolerance;
        let dynamics = self.evaluator.dynamics;
        dynamics.undecided_guards(self.from.time, &self.from.y, &modes, share)
    }

    /// True of a change of a contact whose depth and its rate cannot be told from zero.
    fn touches(&self, function: &EventFunction) -> bool {
        let dynamics = self.evaluator.dynamics;
        let [depth, _] = function.guards;
        let known = dynamics.scales_of_signal(depth.signal).is_some();
        if !(known && dynamics.is_pair(function.component)) {
            return false;
        }
        let rate = depth.displacement * self.from.signals[depth.signal][1];
        let moving = Guard {
            offset: 0.0,
            displacement: 0.0,
            speed: depth.displacement,
            ..depth
        };
        self.depth(function).abs() <= self.floor(&depth) && rate.abs() <= self.floor(&moving)
    }

    /// How deep a contact is pressed where the run stands.
    fn depth(&self, function: &EventFunction) -> f64 {
        let guard = &function.guards[0];
        guard.offset + guard.displacement * self.from.signals[guard.signal][0]
    }

    /// Size of a guard of a coordinate that is nothing but the tolerance of the run.
    fn floor(&self, guard: &Guard) -> f64 {
        let dynamics = self.evaluator.dynamics;
        let [place, rate] = dynamics.scales_of_signal(guard.signal).unwrap_or_default();
        let size = guard.displacement.abs() * place + guard.speed.abs() * rate;
        TOLERANCES * self.settings.tolerance * size
    }
}
