//! Impacts of rigid pairs, and what they hold.
//!
//! A mass behind a prescribed law strikes a flank at the speed w: the impulse J·(1 + e)·w lets
//! its clearance grow at e·w. The law bears it, keeps its speed, and does work by it on the
//! mass. When impacts come to rest stands in [`restitution`].

use super::problem::PairState;
use super::request::ExactSwitch;
use super::workspace::Workspace;
use crate::dynamics::integrate::Impact;
use crate::dynamics::restitution;

impl Workspace<'_> {
    /// The force away from the flank, that of inertia left out of what has no acceleration
    /// of its own: of a mass that stands on flank f, just after the present instant.
    fn pull_on_flank(&self, mass: usize, flank: u8) -> f64 {
        let pull = &self.functionals[self.first[mass] + 2 * usize::from(flank) + 1];
        let law = self.problem.law.jet(self.at);
        let moved = pull.law.iter().zip(law).map(|(factor, law)| factor * law);
        pull.value(&self.q, &self.v) + moved.sum::<f64>()
    }

    /// Puts a mass on flank f, of which its clearance grows at a speed.
    fn set_on_flank(&mut self, mass: usize, flank: u8, rate: f64) {
        let own = self.problem.masses[mass].pair.flanks().0[usize::from(flank)];
        self.q[mass] = -own.sign * own.offset;
        self.v[mass] = own.sign * rate;
    }

    /// Mass i strikes its flank f.
    pub(super) fn apply_impact(&mut self, i: usize, f: u8, time: f64) {
        let mass = &self.problem.masses[i];
        let coefficient = mass.restitution.unwrap_or(0.0);
        let flank = mass.pair.flanks().0[usize::from(f)];
        let (sign, place) = (flank.sign, flank.offset);
        let clear = self.first[i] + 2 * usize::from(f);
        let speed = self.functionals[clear].rate(&self.v);
        let approach = (-speed).max(0.0);
        let mut rate = coefficient * approach;
        let (before, inertia) = (self.states[i], mass.inertia);
        let [_, law, _] = self.problem.law.jet(self.at);
        let carried = mass.ratio * law;
        self.set_on_flank(i, f, rate);
        let pressing = -self.pull_on_flank(i, f) / inertia;
        let rests = restitution::time_of_rest(time, place, [rate, pressing], coefficient);
        if rests.is_some() {
            rate = 0.0;
            self.set_on_flank(i, f, rate);
            self.states[i] = PairState::Engaged(f);
            self.zeros[clear + 1] = if pressing == 0.0 { 4 } else { 0 };
        } else {
            self.states[i] = PairState::Free;
            self.zeros[clear] = 1;
        }
        let impulse = inertia * (approach + rate);
        let impact = Impact {
            component: i,
            side: if sign > 0.0 { -1 } else { 1 },
            approach,
            impulse,
            lost: 0.5 * impulse * (approach - rate),
            drives: sign * impulse * carried,
            rests,
        };
        if let Some(ledger) = &mut self.ledger {
            ledger.add_impact(&impact);
        }
        self.out.switches.push(ExactSwitch {
            time,
            mass: i,
            before,
            after: self.states[i],
            speed,
            impact: Some(impact),
        });
    }

    /// Mass i comes off its flank f, where nothing presses it on any longer.
    pub(super) fn release(&mut self, i: usize, f: u8, time: f64) {
        let clear = self.first[i] + 2 * usize::from(f);
        self.set_on_flank(i, f, 0.0);
        // Clearance, its speed and its acceleration begin at zero.
        self.zeros[clear] = 3;
        self.record_separation(i, f, time);
    }

    fn record_separation(&mut self, i: usize, f: u8, time: f64) {
        self.states[i] = PairState::Free;
        self.out.switches.push(ExactSwitch {
            time,
            mass: i,
            before: PairState::Engaged(f),
            after: PairState::Free,
            speed: 0.0,
            impact: None,
        });
    }

    /// Lets go what its law has begun to leave with a jump of the acceleration, where the
    /// run stands: at the end of a piece of the law.
    pub(super) fn release_from_law(&mut self) {
        for i in 0..self.states.len() {
            let PairState::Engaged(f) = self.states[i] else {
                continue;
            };
            if self.problem.masses[i].restitution.is_none() || self.pull_on_flank(i, f) <= 0.0 {
                continue;
            }
            let clear = self.first[i] + 2 * usize::from(f);
            self.set_on_flank(i, f, 0.0);
            self.zeros[clear] = 2;
            self.record_separation(i, f, self.at.0);
        }
    }
}
