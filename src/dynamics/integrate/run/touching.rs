//! Contacts that just touch.
//!
//! A contact that closes with neither depth nor speed, as one does that starts on its law
//! or behind a massless point, has no sign yet that numbers could tell. It is closed and
//! stays so until it is pressed beyond the tolerance, or comes apart beyond it. Otherwise
//! the rounding of zero would open and close it without end.

use super::Run;
use crate::dynamics::integrate::{Dynamics, EventFunction, Guard};

/// Share of the tolerance of a state within which a contact just touches: errors of some
/// steps add up.
const TOLERANCES: f64 = 10.0;

/// A contact that just touches.
#[derive(Clone, Copy, Debug, PartialEq)]
pub(in crate::dynamics::integrate) struct Touching {
    /// Component of the modes.
    pub(in crate::dynamics::integrate) component: usize,
    /// Values that its two guards must fall below, less than zero by so much.
    pub(in crate::dynamics::integrate) floors: [f64; 2],
}

impl<D: Dynamics> Run<'_, D> {
    /// Finds which contacts of those components just touch where the run stands.
    pub(super) fn find_touching(&mut self, of: impl Fn(usize) -> bool) {
        for function in &self.event_functions {
            let component = function.component;
            let known = self.touching.iter().any(|own| own.component == component);
            if of(component) && !known && self.touches(function) {
                let floors = function.guards.map(|guard| self.floor(&guard));
                self.touching.push(Touching { component, floors });
            }
        }
    }

    /// Lets go of those that are pressed, or have come apart.
    pub(super) fn release_touching(&mut self) {
        if self.touching.is_empty() {
            return;
        }
        let mut touching = std::mem::take(&mut self.touching);
        touching.retain(|own| {
            let mut functions = self.event_functions.iter();
            functions.any(|f| f.component == own.component && self.touches(f))
        });
        self.touching = touching;
    }

    /// True of the opening of an elastic contact whose depth and its rate cannot be told
    /// from zero.
    fn touches(&self, function: &EventFunction) -> bool {
        let dynamics = self.evaluator.dynamics;
        let coordinates = dynamics.coordinates();
        let [depth, _] = function.guards;
        let own = depth.signal < coordinates && dynamics.is_pair(function.component);
        if function.rising || !own || dynamics.is_rigid_contact(function.component) {
            return false;
        }
        let [value, rate, _] = self.from.signals[depth.signal];
        let moving = Guard {
            offset: 0.0,
            displacement: 0.0,
            speed: depth.displacement,
            ..depth
        };
        (depth.offset + depth.displacement * value).abs() <= self.floor(&depth)
            && (depth.displacement * rate).abs() <= self.floor(&moving)
    }

    /// Size of a guard of a coordinate that is nothing but the tolerance of the run.
    fn floor(&self, guard: &Guard) -> f64 {
        let dynamics = self.evaluator.dynamics;
        let (n, scales) = (dynamics.coordinates(), dynamics.scales());
        let size = guard.displacement.abs() * scales[guard.signal]
            + guard.speed.abs() * scales[n + guard.signal];
        TOLERANCES * self.settings.tolerance * size
    }
}
