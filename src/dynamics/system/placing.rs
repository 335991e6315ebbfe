//! Where everything is at t = 0: nodes, segments of tracks, flanks of pairs.

use super::balance::{Balance, BalanceState, resting_mode};
use super::frozen::{Chain, Frozen, Step};
use super::passes::{Extent, Work};
use crate::math::expression::OPEN;

/// Side of t = 0.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub(super) enum Side {
    /// The past: of laws that repeat, the segment that they come from.
    Before,
    /// The future: the segment that they move on in.
    After,
}

impl Frozen {
    /// Modes with every pair open, every track in segment 0 and every guard of an expression
    /// by its value.
    pub(super) fn no_modes(&self) -> Vec<i64> {
        let mut modes = vec![0; self.first_guard()];
        modes.resize(modes.len() + self.guards, OPEN);
        modes
    }

    /// The state on the law: u = 0, u̇ = 0, rotors at their start.
    pub(super) fn law_state(&self) -> Vec<f64> {
        let mut state = vec![0.0; 2 * self.coordinates];
        for step in &self.steps {
            if let Step::Rotor(rotor) = step {
                state[rotor.coordinate] = rotor.angle;
                state[self.coordinates + rotor.coordinate] = rotor.speed;
            }
        }
        state
    }

    /// The law that a node follows.
    pub(super) fn law_of_node(&self, node: usize) -> Option<usize> {
        let rigid = self.rigids.iter().find(|rigid| rigid.node == node);
        let of_chain = |chain: &&Chain| chain.nodes().contains(&node);
        rigid
            .map(|rigid| rigid.law)
            .or_else(|| self.chains.iter().find(of_chain).map(|chain| chain.law))
    }

    /// Balance from the law on, with the modes that belong to it.
    pub(super) fn balance_from_law(
        &self,
        kind: Balance,
        modes: &mut [i64],
    ) -> Option<BalanceState> {
        self.settle_on(Side::After, kind, modes)
    }

    /// The same with the laws as they are on a side of t = 0.
    pub(super) fn settle_on(
        &self,
        side: Side,
        kind: Balance,
        modes: &mut [i64],
    ) -> Option<BalanceState> {
        let mut state = self.law_state();
        self.locate_tracks_on(side, &state, modes);
        // Each round may change flanks and segments; a balance that depends on
        // them so that it never settles is none.
        for _ in 0..8 + 2 * modes.len() {
            let balanced = self.balance(kind, &state, modes)?;
            let before = modes.to_vec();
            let mut balanced = balanced;
            for (component, &chain) in self.pairs.iter().enumerate() {
                // (What rests on a stop tells by its place whether it touches its flanks.)
                if !self.lies_on_stop(chain, &before) {
                    let reaction = balanced.reactions[chain];
                    modes[component] = resting_mode(&self.chains[chain], reaction);
                }
            }
            self.settle_stops(&mut balanced, &before, modes);
            self.locate_tracks_on(side, &balanced.state, modes);
            if *modes == before {
                return Some(balanced);
            }
            state = balanced.state;
        }
        None
    }

    /// Turns given absolute displacements and speeds of nodes into a state.
    pub(super) fn place_given(
        &self,
        given: &[Option<(f64, f64)>],
        modes: &[i64],
        state: &mut [f64],
    ) {
        let mut work = Work::new(self);
        let n = self.coordinates;
        for step in &self.steps {
            // Everything before this step is in its place by now.
            match step {
                Step::Prescribed(_) | Step::Rigid(_) | Step::Constrained(_) => {}
                Step::Rotor(rotor) => {
                    if let Some((displacement, speed)) = given[rotor.node] {
                        state[rotor.coordinate] = displacement;
                        state[n + rotor.coordinate] = speed;
                    }
                }
                Step::Chain(index) => {
                    let chain = &self.chains[*index];
                    self.motion(0.0, state, modes, Extent::Full, &mut work);
                    let law = work.laws[chain.law];
                    for (node, coordinate) in chain.nodes().zip(chain.coordinates()) {
                        if let Some((displacement, speed)) = given[node] {
                            state[coordinate] = displacement - law.value;
                            state[n + coordinate] = speed - law.speed;
                        }
                    }
                }
            }
        }
    }

    /// Sets every track to the segment in which the state at t = 0 moves on.
    pub(super) fn locate_tracks(&self, state: &[f64], modes: &mut [i64]) {
        self.locate_tracks_on(Side::After, state, modes);
    }

    /// Sets every track to the segment on a side of t = 0. Only a law of motion that
    /// repeats has one before it.
    pub(super) fn locate_tracks_on(&self, side: Side, state: &[f64], modes: &mut [i64]) {
        if self.tracks.is_empty() {
            return self.locate_guards(0.0, state, modes);
        }
        let mut work = Work::new(self);
        let mut out = vec![0.0; self.coordinates];
        // Each round gives the right segments one driver further on; one that changes
        // none is the last.
        for _ in 0..=self.tracks.len() {
            let mut settled = true;
            self.evaluate(0.0, state, modes, Extent::Full, &mut work, &mut out);
            self.find_distances(&mut work);
            for (index, track) in self.tracks.iter().enumerate() {
                let (place, sense) = match track.node {
                    None => (0.0, 1.0),
                    Some(node) => {
                        let speed = work.speed[node];
                        let moving = if speed == 0.0 {
                            work.acceleration[node]
                        } else {
                            speed
                        };
                        (work.displacement[node], moving)
                    }
                };
                let component = self.track_component(index);
                if place.is_finite() {
                    let sense = match (side, track.repeats) {
                        // (Upwards is ≥ 0: at rest nothing lies behind.)
                        (Side::Before, true) if sense != 0.0 => -sense,
                        (Side::Before | Side::After, _) => sense,
                    };
                    let segment = track.breaks.segment_at(place, sense);
                    settled &= modes[component] == segment;
                    modes[component] = segment;
                }
            }
            if settled {
                break;
            }
        }
        self.locate_guards(0.0, state, modes);
    }
}
