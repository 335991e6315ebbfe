//! One-sided stops of masses against the ground.
//!
//! A stop is a contact like that of a force-closed pair ([`super::pairs`]), of the
//! deformation x = φ − at of its mass's own displacement, and a load on that mass: it pushes
//! with −F. Its mode is a component of its own.
//!
//! The components of all stops follow those of the pairs, so that whatever asks for a pair's
//! component treats them as pairs with the ground. φ of the mass is an extra signal, as that of
//! a track. In the model a stop is an inner part of its object, `valve.seat`. Its state is read
//! off its contact, and what it does is stored or lost energy, no work of a load.
//!
//! A chain rests while its pair is open and one of its stops is engaged. Statics then omit its
//! pair, and an opening is no separation. Natural frequencies omit stops.

use super::balance::BalanceState;
use super::frozen::{Chain, Frozen, segment};
use super::pairs::{Contact, OPEN};
use super::passes::{Extent, Work};
use super::{ObjectState, System};
use crate::dynamics::integrate::EventFunction;
use crate::dynamics::model::{Closure, Pair};
use crate::math::number::Number;
use crate::math::quantity::Quantity;

/// A stop with its numbers.
#[derive(Clone, Copy, Debug)]
pub(super) struct FrozenStop {
    /// Internal index of the mass that it stops.
    pub(super) node: usize,
    /// The chain that this mass belongs to.
    pub(super) chain: usize,
    /// Signal that is its displacement.
    pub(super) signal: usize,
    /// Component of the modes: 0 open, else the side on which it is engaged.
    pub(super) component: usize,
    /// Displacement at which it is touched.
    pub(super) at: f64,
    /// Its contact, of x = φ − at.
    pub(super) contact: Contact,
}

impl FrozenStop {
    /// One that has no place yet.
    pub(super) const UNPLACED: Self = Self {
        node: 0,
        chain: 0,
        signal: 0,
        component: 0,
        at: 0.0,
        contact: Contact::NONE,
    };

    /// The only side on which it can be engaged.
    pub(super) fn engaged_side(&self) -> i64 {
        self.contact.sides()[0]
    }

    /// x of its contact at a displacement of the mass.
    #[inline(always)]
    pub(super) fn deformation<N: Number>(&self, displacement: N) -> N {
        displacement - N::from(self.at)
    }

    /// Its force on the mass.
    #[inline(always)]
    pub(super) fn force<N: Quantity>(&self, mode: i64, displacement: N, speed: N) -> N {
        -self
            .contact
            .force(mode, self.deformation(displacement), speed)
    }

    /// The switches to look for in a mode.
    pub(super) fn event_functions(&self, mode: i64, out: &mut Vec<EventFunction>) {
        let x = (self.signal, self.at);
        self.contact.event_functions(mode, x, self.component, out);
    }

    /// Power lost in its contact.
    pub(super) fn dissipated(&self, modes: &[i64], work: &Work<f64>) -> f64 {
        let x = self.deformation(work.displacement[self.node]);
        let speed = work.speed[self.node];
        self.contact.dissipated(modes[self.component], x, speed)
    }

    /// What it is doing.
    /// `held`: the force of a rigid one that holds its mass.
    pub(super) fn observe(
        &self,
        modes: &[i64],
        held: f64,
        work: &Work<f64>,
        out: &mut ObjectState,
    ) {
        let (displacement, speed) = (work.displacement[self.node], work.speed[self.node]);
        let (x, mode) = (self.deformation(displacement), modes[self.component]);
        out.deformation = x;
        out.deformation_speed = speed;
        out.reaction = match self.contact.contact_holds(mode) {
            true => held,
            false => self.force(mode, displacement, speed),
        };
        // At a switch located to rounding the force may be a rounding below 0.
        out.contact_force = (-mode as f64 * out.reaction).max(0.0);
        if mode == OPEN {
            out.lift = self.contact.clearance(x);
        }
        let (depth, _) = self.contact.penetration(self.engaged_side(), x, 0.0);
        out.indentation = depth.max(0.0);
    }
}

impl Frozen {
    /// The stops of a chain's masses.
    pub(super) fn stops_of(&self, chain: usize) -> impl Iterator<Item = &FrozenStop> {
        self.stops.iter().filter(move |stop| stop.chain == chain)
    }

    /// True when a chain's pair is open and one of its stops engaged: it lies on the stop.
    pub(super) fn lies_on_stop(&self, chain: usize, modes: &[i64]) -> bool {
        if self.stops.is_empty() {
            return false;
        }
        let own: &Chain = &self.chains[chain];
        own.contact.closure != Closure::Bilateral
            && self.pair_mode(own, modes) == OPEN
            && self
                .stops_of(chain)
                .any(|stop| segment(modes, Some(stop.component)) != OPEN)
    }
}

impl Frozen {
    /// Sets the modes of stops, and of pairs of what rests on them, to what a balance asks
    /// for that was found in the modes `before`. What comes to rest on a stop is put there.
    pub(super) fn settle_stops(
        &self,
        balanced: &mut BalanceState,
        before: &[i64],
        modes: &mut [i64],
    ) {
        if self.stops.is_empty() {
            return;
        }
        let mut work = Work::new(self);
        self.motion(0.0, &balanced.state, before, Extent::Full, &mut work);
        for (index, chain) in self.chains.iter().enumerate() {
            let rested = self.lies_on_stop(index, before);
            let mut lands = false;
            for stop in self.stops_of(index) {
                let x = stop.deformation(work.displacement[stop.node]);
                let (depth, _) = stop.contact.penetration(stop.engaged_side(), x, 0.0);
                // (What lies on a rigid stop touches it, but for rounding.)
                let lies = rested && stop.contact.contact_holds(before[stop.component]);
                modes[stop.component] = if depth > 0.0 || lies {
                    stop.engaged_side()
                } else {
                    OPEN
                };
                lands |= depth > 0.0 && !rested && stop.contact.restitution().is_some();
            }
            let Some(component) = chain.component else {
                continue;
            };
            if lands {
                // What would stand within a rigid stop lies on it.
                modes[component] = OPEN;
                continue;
            }
            let reaction = balanced.reactions[index];
            if rested {
                let x = balanced.state[chain.first_coordinate];
                let pressed = |&&side: &&i64| chain.contact.penetration(side, x, 0.0).0 > 0.0;
                let side = chain.contact.sides().iter().find(pressed);
                modes[component] = side.copied().unwrap_or(OPEN);
            } else if modes[component] == OPEN && reaction != 0.0 {
                // Pulled off its law, it goes to the stop on that side.
                let side = reaction.signum() as i64;
                if let Some(stop) = self
                    .stops_of(index)
                    .find(|stop| stop.engaged_side() == side)
                {
                    modes[stop.component] = side;
                    let depth = stop.contact.depth_under(reaction.abs());
                    let place = stop.at + side as f64 * depth;
                    let way = place - work.displacement[stop.node];
                    for coordinate in chain.coordinates() {
                        balanced.state[coordinate] += way;
                    }
                }
            }
        }
    }
}

impl System {
    /// The stop that an object part is: its signal, and the pair that it is of the
    /// deformation x = signal − zero.
    pub(crate) fn stop_signal(&self, part: usize) -> Option<(usize, f64, Pair)> {
        let stop = &self.frozen.stops[self.stop_of(part)?];
        let (pair, _) = self.model.stop(part)?.pair();
        Some((stop.signal, stop.at, pair))
    }

    /// Components of the modes of an object's stops.
    pub(crate) fn stops_of_object(&self, object: usize) -> impl Iterator<Item = usize> {
        let own = self.model.stops.iter().filter(move |s| s.object == object);
        own.filter_map(|stop| self.pair_component(stop.part))
    }
}
