//! The discrete state just after t = 0.
//!
//! A pair that only touches (p = 0, or no force) is engaged or open by what
//! happens next: by the sign of the first derivative of p and of the pressing
//! force that does not vanish. The motion just after t = 0 is developed into a
//! series in time under a supposition about every pair; suppositions that it
//! contradicts are changed until none is.

use super::System;
use super::frozen::Frozen;
use super::pairs::{Contact, OPEN};
use super::passes::{Extent, Work};
use crate::math::bounded_series::{ORDER, Series};

impl System {
    /// Settles the modes of all pairs for the motion that leaves `state`;
    /// those given are the first supposition. `noise` is the size of the
    /// numbers whose rounding is in each state entry.
    pub(super) fn settle_pairs(&self, state: &[f64], noise: &[f64], modes: &mut [i64]) {
        let frozen = &self.frozen;
        if frozen.contacts() == 0 {
            return;
        }
        let mut decided = true;
        let now = frozen.state_of(state, noise);
        let deformations = frozen.deformations(&now, modes);
        for (contact, mode) in deformations
            .iter()
            .zip(modes[..frozen.contacts()].iter_mut())
        {
            if contact.is_rigid() {
                // Its mode has been settled by itself.
                continue;
            }
            match contact.mode_now() {
                Some(now) => *mode = now,
                None => decided = false,
            }
        }
        if decided {
            return;
        }
        let mut tried: Vec<Vec<i64>> = Vec::new();
        // Each round changes one pair; a supposition that comes back means that
        // no motion is free of contradiction, and the first is kept.
        while !tried.iter().any(|before| before == modes) {
            tried.push(modes.to_vec());
            let motion = frozen.develop(state, noise, modes);
            let contradicted = frozen.deformations(&motion, modes);
            let ahead = contradicted.iter().enumerate();
            let ahead = ahead.filter(|(_, contact)| !contact.is_rigid());
            let contradicted = ahead
                .map(|(number, contact)| (number, contact.mode_ahead()))
                .find(|&(contact, mode)| mode != modes[contact]);
            match contradicted {
                Some((contact, mode)) => modes[contact] = mode,
                None => return,
            }
        }
        modes.copy_from_slice(&tried[0]);
    }
}

/// The deformation of a pair that can open, or of a stop, in a motion.
struct Deformation<'f> {
    contact: &'f Contact,
    x: Series,
    v: Series,
}

impl Deformation<'_> {
    fn is_rigid(&self) -> bool {
        self.contact.restitution().is_some()
    }

    fn engagement_conditions(&self, side: i64) -> [Series; 2] {
        self.contact.engagement_conditions(side, self.x, self.v)
    }

    /// True when a motion of which the powers up to `known` of displacements and
    /// rates are known decides the contact: what is not known yet comes after the
    /// first derivative that does not vanish.
    fn decides_contact(&self, known: usize) -> bool {
        if self.is_rigid() {
            return true;
        }
        let sides = self.contact.sides().iter();
        let mut guards = sides.flat_map(|&side| {
            self.engagement_conditions(side)
                .map(|guard| guard.leading())
        });
        guards.all(|power| power.is_some_and(|power| power <= known))
    }

    /// The mode by the state alone, without looking ahead; `None` when it just touches
    /// or just presses.
    fn mode_now(&self) -> Option<i64> {
        let mut mode = OPEN;
        for &side in self.contact.sides() {
            let [depth, pressing] = self.engagement_conditions(side).map(|guard| guard.sign());
            if depth > 0.0 && pressing > 0.0 {
                mode = side;
            } else if depth >= 0.0 && pressing >= 0.0 {
                return None;
            }
        }
        Some(mode)
    }

    /// The mode in the motion.
    fn mode_ahead(&self) -> i64 {
        let pressed = |&&side: &&i64| {
            self.engagement_conditions(side)
                .iter()
                .all(|guard| guard.sign() > 0.0)
        };
        let side = self.contact.sides().iter().find(pressed);
        side.copied().unwrap_or_else(|| self.undecided_mode())
    }

    /// The mode of what no derivative decides: the only flank of a force-closed pair that
    /// touches it is closed, without a force.
    fn undecided_mode(&self) -> i64 {
        let &[side] = self.contact.sides() else {
            return OPEN;
        };
        let [depth, pressing] = self.engagement_conditions(side).map(|guard| guard.sign());
        let touches = depth >= 0.0 && pressing >= 0.0;
        if touches { side } else { OPEN }
    }
}

impl Frozen {
    /// A state as series that know nothing of its motion: [u, u̇].
    fn state_of(&self, state: &[f64], noise: &[f64]) -> Vec<Series> {
        let entries = state.iter().zip(noise);
        let entries = entries.map(|(&value, &noise)| Series::constant(value, noise));
        entries.collect()
    }

    /// The deformations of all pairs that can open, then of all stops, in a motion.
    fn deformations(&self, motion: &[Series], modes: &[i64]) -> Vec<Deformation<'_>> {
        let pairs = self.pairs.iter().map(|&chain| {
            let chain = &self.chains[chain];
            let (u, v) = self.deviations(chain, motion);
            let (x, v) = (u[0], v[0]);
            let contact = &chain.contact;
            Deformation { contact, x, v }
        });
        let mut all: Vec<Deformation<'_>> = pairs.collect();
        if self.stops.is_empty() {
            return all;
        }
        let mut work = Work::new(self);
        let time = Series::time(ORDER);
        self.motion(time, motion, modes, Extent::Full, &mut work);
        all.extend(self.stops.iter().map(|stop| {
            // (The rounding of the place at which it stands.)
            let at = Series::constant(stop.at, stop.at.abs());
            Deformation {
                contact: &stop.contact,
                x: work.displacement[stop.node] - at,
                v: work.speed[stop.node],
            }
        }));
        all
    }

    /// The motion that leaves a state, as series: [u, u̇]; no further than it
    /// takes to tell what every pair does.
    fn develop(&self, state: &[f64], noise: &[f64], modes: &[i64]) -> Vec<Series> {
        let n = self.coordinates;
        let mut state = state.to_vec();
        self.settle_points(&mut state, modes);
        let mut motion: Vec<Series> = vec![Series::constant(0.0, 0.0); 2 * n];
        for index in 0..n {
            motion[index].set(0, state[index], noise[index]);
            motion[index].set(1, state[n + index], noise[n + index]);
            motion[n + index] = motion[index].rate();
        }
        let mut work = Work::new(self);
        let mut accelerations = vec![Series::constant(0.0, 0.0); n];
        for power in 0..=ORDER - 2 {
            // One power beyond: no more is known of the motion.
            let time = Series::time(power + 1);
            self.evaluate(
                time,
                &motion,
                modes,
                Extent::Needed,
                &mut work,
                &mut accelerations,
            );
            let factor = 1.0 / ((power + 1) * (power + 2)) as f64;
            for index in 0..n {
                let acceleration = &accelerations[index];
                let value = factor * acceleration.coefficients[power];
                motion[index].set(power + 2, value, factor * acceleration.magnitude(power));
                motion[n + index] = motion[index].rate();
            }
            let deformations = self.deformations(&motion, modes);
            if deformations
                .iter()
                .all(|one| one.decides_contact(power + 1))
            {
                break;
            }
        }
        motion
    }
}
