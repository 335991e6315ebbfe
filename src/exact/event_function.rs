//! What is watched in the present states of the pairs, and what a switch does to them.

use super::functional::value;
use super::lanes::Arith;
use super::problem::PairState;
use super::request::ExactSwitch;
use super::workspace::Workspace;

/// A watched pair function.
#[derive(Clone, Copy, Debug)]
pub(super) struct EventFunction {
    pub(super) mass: usize,
    pub(super) functional: usize,
    pub(super) sign: f64,
    pub(super) target: PairState,
}

impl Workspace<'_> {
    /// Collects what has to be watched in the present states.
    #[inline(always)]
    pub(super) fn watch(&mut self) {
        self.watches.clear();
        self.watched.clear();
        for i in 0..self.states.len() {
            let (_, count) = self.problem.masses[i].pair.flanks();
            for f in 0..count {
                let clear = self.first[i] + 2 * f;
                let flank = f as u8;
                let (functional, sign, target) = match self.states[i] {
                    PairState::Engaged(own) if own == flank => {
                        (clear + 1, -1.0, PairState::Pressed(flank))
                    }
                    PairState::Pressed(own) if own == flank => {
                        (clear + 1, 1.0, PairState::Engaged(flank))
                    }
                    PairState::Engaged(_) => continue,
                    _ => (clear, 1.0, PairState::Engaged(flank)),
                };
                self.watches.push(EventFunction {
                    mass: i,
                    functional,
                    sign,
                    target,
                });
                self.watched.push(functional);
            }
        }
    }

    #[inline(always)]
    pub(super) fn take_signals<A: Arith>(&mut self, regime: usize) {
        let entry = &self.regimes[regime];
        for watch in &self.watches {
            let f = watch.functional;
            let signal = &mut self.signals[f];
            signal.set_functional::<A>(
                &entry.basis,
                &self.phase,
                &self.functionals[f],
                &entry.weights[f],
                watch.sign,
            );
            signal.zeros = self.zeros[f];
            signal.leaving = self.zeros[f] > 0;
            // The pull of a pair that has let go vanishes before it pulls again, where
            // the pair has come clear by then.
            signal.passing = match (self.states[watch.mass], watch.target) {
                (PairState::Pressed(own), PairState::Engaged(flank)) => own == flank,
                _ => false,
            };
        }
    }

    /// Pressed pairs that have come clear of their flank become free: from
    /// X > 0 the next event can only be the root of X itself (Ẋ < 0 there, so
    /// the pull is negative too).
    #[inline(always)]
    pub(super) fn release_cleared_pairs<A: Arith>(
        &mut self,
        regime: usize,
        fired: Option<usize>,
    ) -> bool {
        let mut changed = false;
        for number in 0..self.watches.len() {
            let watch = self.watches[number];
            let PairState::Pressed(f) = self.states[watch.mass] else {
                continue;
            };
            if watch.target != PairState::Engaged(f) || fired.is_some_and(|k| k != number) {
                continue;
            }
            let clear = watch.functional - 1;
            let entry = &self.regimes[regime];
            let (x, noise) = value::<A>(
                &self.functionals[clear],
                &entry.weights[clear],
                &self.phase,
                &self.search.e,
            );
            if x > noise {
                self.states[watch.mass] = PairState::Free;
                changed = true;
            }
        }
        changed
    }

    /// Takes the switch of a watch at the state now in q, v.
    pub(super) fn switch(&mut self, number: usize, time: f64) {
        let watch = self.watches[number];
        let i = watch.mass;
        let before = self.states[i];
        let (PairState::Pressed(f) | PairState::Engaged(f)) = watch.target else {
            return;
        };
        if self.problem.masses[i].restitution.is_some() {
            return match watch.target {
                PairState::Pressed(_) => self.release(i, f, time),
                _ => self.apply_impact(i, f, time),
            };
        }
        let clear = self.first[i] + 2 * usize::from(f);
        let speed = self.functionals[clear].rate(&self.v);
        let undamped = self.problem.masses[i].damping == 0.0;
        let after = match watch.target {
            // Without damping the force vanishes with the penetration.
            PairState::Pressed(_) if undamped => PairState::Free,
            target => target,
        };
        // The function that fired is zero; without damping so is the force where
        // the flank is touched. (Coming over from the other flank's Pressed it is not.)
        if after == PairState::Free {
            self.zeros[clear] = 1;
        } else if watch.functional > clear || undamped {
            self.zeros[clear + 1] = 1;
        }
        self.states[i] = after;
        self.out.switches.push(ExactSwitch {
            time,
            mass: i,
            before,
            after,
            speed,
            impact: None,
        });
    }
}
