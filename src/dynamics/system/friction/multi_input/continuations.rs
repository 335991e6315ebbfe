//! The ways in which pairs at rest may go on, and which of them agree with Coulomb's law.

use super::super::force::solver_options;
use super::super::standstill::EXCESS;
use super::{Several, SeveralWork};
use crate::kinematics::linkage::kinetostatics::Sliding;

/// An acceleration of a pair that nothing but motions determine is rounding below this part of
/// what it is the sum of.
const STANDS: f64 = 1e-9;
/// At the limit of what friction holds, whether something starts is a matter of rounding: parts of
/// forces and accelerations.
const ROUNDING: f64 = 1e-9;

/// A way in which pairs at rest go on.
#[derive(Clone, Debug, PartialEq)]
pub(super) struct Continuation {
    /// The direction of each, 0 where it stays at rest.
    pub(super) directions: Vec<i8>,
    /// Least acceleration of those that start, in parts of what it is the sum of.
    quickness: f64,
}

impl Continuation {
    /// True of two ways that are one but for rounding: one pair that is at the limit of what
    /// friction holds stays at rest, or starts.
    fn is_next_to(&self, other: &Self) -> bool {
        let pairs = self.directions.iter().zip(&other.directions);
        let mut differing = pairs.filter(|(a, b)| a != b);
        let (one, more) = (differing.next(), differing.next());
        let at_limit = self.quickness.min(other.quickness) <= ROUNDING;
        at_limit && more.is_none() && one.is_some_and(|(a, b)| *a == 0 || *b == 0)
    }

    /// Number of pairs that start.
    fn starting(&self) -> usize {
        self.directions.iter().filter(|&&one| one != 0).count()
    }
}

/// Pairs whose rates are zero, out of all that have friction, at a state whose accelerations
/// without friction are in the memory.
pub(super) struct Ways<'a> {
    pub(super) several: &'a Several,
    pub(super) own: &'a mut SeveralWork<f64>,
    /// What every pair of the linkage does, those at rest to be filled in.
    sliding: Vec<Sliding>,
}

impl<'a> Ways<'a> {
    /// With the sliding pairs as the memory has them.
    pub(super) fn new(several: &'a Several, own: &'a mut SeveralWork<f64>) -> Self {
        let sliding = own.sliding.clone();
        Self {
            several,
            own,
            sliding,
        }
    }

    /// The pairs of the linkage that have friction and rest as the memory has it.
    pub(super) fn resting(&self) -> Vec<usize> {
        let pairs = self.several.pairs.iter().map(|pair| pair.pair);
        pairs
            .filter(|&pair| self.sliding[pair] == Sliding::Held)
            .collect()
    }

    pub(super) fn set(&mut self, pair: usize, sliding: Sliding) {
        self.sliding[pair] = sliding;
    }

    /// Friction with the pairs doing what is set; false where there is none.
    pub(super) fn find(&mut self) -> bool {
        let SeveralWork {
            forces,
            mobility_values,
            ..
        } = &mut *self.own;
        let solver = &self.several.kinetostatics;
        solver
            .solve_friction(
                mobility_values,
                &self.sliding,
                &solver_options(false),
                forces,
            )
            .is_ok()
    }

    /// True of a pair whose motion no force changes.
    pub(super) fn is_given(&self, pair: usize) -> bool {
        let solver = &self.several.kinetostatics;
        solver.is_given(pair, &self.own.mobility_values, &self.own.forces)
    }

    /// Pairs that move when one is pushed, with those held that are set so, and how.
    fn coupled_motion(&self, pushed: usize, pairs: &[usize]) -> Vec<f64> {
        let (solver, forces) = (&self.several.kinetostatics, &self.own.forces);
        let moved = pairs.iter().map(|&pair| match self.is_given(pair) {
            true => 0.0,
            false => solver.relative_mobility(pair, pushed, forces),
        });
        moved.collect()
    }

    /// True of a pair that rests because others are held.
    pub(super) fn is_held_by_others(&self, pair: usize) -> bool {
        let (solver, forces) = (&self.several.kinetostatics, &self.own.forces);
        !self.is_given(pair) && solver.relative_mobility(pair, pair, forces) == 0.0
    }

    /// By how much what holds the pairs at rest passes what friction can hold, with the friction
    /// of a start: positive where something breaks loose; `None` where no forces agree.
    ///
    /// Where the pairs hold one another, each of them by itself could bear anything between its
    /// limits, and what all can hold together is told by the motions in which they may start.
    /// Those in which as many pairs as possible stay at rest, since the power of the forces less
    /// the friction is linear between these.
    pub(super) fn loosens(&mut self, resting: &[usize], slack: f64) -> Option<f64> {
        for &pair in resting {
            self.sliding[pair] = Sliding::Held;
        }
        if !self.find() {
            return None;
        }
        let free: Vec<usize> = resting
            .iter()
            .copied()
            .filter(|&pair| !self.is_given(pair))
            .collect();
        let rank = self.several.kinetostatics.held_pairs(&self.own.forces);
        if rank == free.len() {
            let solver = &self.several.kinetostatics;
            let margins = solver.holding_margins(EXCESS + slack, &self.own.forces);
            let most = margins.map(|(_, margin)| margin);
            return Some(most.fold(-f64::MIN_POSITIVE, f64::max));
        }
        let mut most = -f64::MIN_POSITIVE;
        each_choice(free.len(), rank.saturating_sub(1), &mut |chosen| {
            for (index, &pair) in free.iter().enumerate() {
                self.sliding[pair] = match chosen.contains(&index) {
                    true => Sliding::Held,
                    false => Sliding::Idle,
                };
            }
            most = most.max(self.starts_along(&free, chosen.len(), slack));
        });
        for &pair in resting {
            self.sliding[pair] = Sliding::Held;
        }
        Some(most)
    }

    /// Acceleration of a start of the only motion that the pairs set as held leave to those of
    /// `free`; not positive where there is none, or more than one.
    fn starts_along(&mut self, free: &[usize], held: usize, slack: f64) -> f64 {
        if !self.find() || self.several.kinetostatics.held_pairs(&self.own.forces) < held {
            return f64::NEG_INFINITY;
        }
        let idle = |pair: &&usize| self.sliding[**pair] == Sliding::Idle;
        let pushed = free.iter().filter(idle).copied();
        let Some(pushed) = pushed
            .into_iter()
            .find(|&pair| !self.is_held_by_others(pair))
        else {
            return f64::NEG_INFINITY;
        };
        let moved = self.coupled_motion(pushed, free);
        let before = self.sliding.clone();
        let mut most = f64::NEG_INFINITY;
        for direction in [1.0, -1.0] {
            for (&pair, &moved) in free.iter().zip(&moved) {
                self.sliding[pair] = match moved == 0.0 {
                    true => Sliding::Held,
                    false => Sliding::Slides(direction * moved.signum() * (1.0 + EXCESS)),
                };
            }
            if self.find() {
                let [found, size] = self.acceleration(pushed);
                most = most.max(direction * found - slack * size);
            }
        }
        self.sliding = before;
        most
    }

    pub(super) fn acceleration(&self, pair: usize) -> [f64; 2] {
        let solver = &self.several.kinetostatics;
        solver.pair_acceleration(pair, &self.own.forces)
    }

    /// All ways in which pairs at rest go on that agree with Coulomb's law; of two that are one
    /// but for rounding the one in which more pairs start, where some are to, or fewer.
    pub(super) fn consistent(&mut self, resting: &[usize], start: bool) -> Vec<Continuation> {
        let mut found = self.all_continuations(resting, 0.0);
        if found.is_empty() {
            found = self.all_continuations(resting, ROUNDING);
        }
        if let [one, other] = &found[..]
            && one.is_next_to(other)
        {
            let first = (one.starting() > other.starting()) == start;
            found.remove(usize::from(first));
        }
        found
    }

    fn all_continuations(&mut self, resting: &[usize], slack: f64) -> Vec<Continuation> {
        let mut found = Vec::new();
        for number in 0..3usize.pow(resting.len() as u32) {
            let digit = |place: usize| number / 3usize.pow(place as u32) % 3;
            let directions = (0..resting.len()).map(|place| [0, 1, -1][digit(place)]);
            let directions: Vec<i8> = directions.collect();
            if let Some(quickness) = self.least_consistent_acceleration(resting, &directions, slack)
            {
                found.push(Continuation {
                    directions,
                    quickness,
                });
            }
        }
        found
    }

    /// Puts pairs at rest into the directions of a way.
    fn set_directions(&mut self, resting: &[usize], way: &[i8]) {
        for (&pair, &direction) in resting.iter().zip(way) {
            self.sliding[pair] = match direction {
                0 => Sliding::Held,
                direction => Sliding::Slides(f64::from(direction) * (1.0 + EXCESS)),
            };
        }
    }

    /// Least acceleration of what starts in a way whose accelerations have its directions, and
    /// whose held pairs can be held; `None` of any other.
    fn least_consistent_acceleration(
        &mut self,
        resting: &[usize],
        way: &[i8],
        slack: f64,
    ) -> Option<f64> {
        self.set_directions(resting, way);
        if !self.find() {
            return None;
        }
        let mut held = Vec::new();
        let mut quickness = f64::INFINITY;
        for (&pair, &direction) in resting.iter().zip(way) {
            let [acceleration, size] = self.acceleration(pair);
            let along = acceleration * f64::from(direction);
            // Neither forces nor friction change how it moves: its rate may pass zero because
            // of the position alone.
            let given = self.is_given(pair);
            let led = given || self.is_held_by_others(pair);
            let moves = acceleration.abs() > STANDS * size;
            let agrees = match direction {
                0 => !moves,
                _ if led => moves && along > 0.0,
                _ => along > -slack * size,
            };
            if !agrees {
                return None;
            }
            if direction == 0 && !given {
                held.push(pair);
            }
            if direction != 0 && size > 0.0 {
                quickness = quickness.min(along / size);
            }
        }
        let loosens = self.loosens(&held, slack);
        loosens
            .is_some_and(|margin| margin <= 0.0)
            .then_some(quickness)
    }
}

/// Calls back with every choice of `count` numbers below `all`.
fn each_choice(all: usize, count: usize, visit: &mut impl FnMut(&[usize])) {
    fn extend([all, count]: [usize; 2], chosen: &mut Vec<usize>, visit: &mut impl FnMut(&[usize])) {
        if chosen.len() == count {
            return visit(chosen);
        }
        let first = chosen.last().map_or(0, |last| last + 1);
        for next in first..all {
            chosen.push(next);
            extend([all, count], chosen, visit);
            chosen.pop();
        }
    }
    extend([all, count], &mut Vec::with_capacity(count), visit);
}
