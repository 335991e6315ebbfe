//! What is looked at within every step: whether what friction holds breaks loose, and whether
//! there is one motion.

use super::super::Obstacle;
use super::super::force::solver_options;
use super::super::standstill::LOOKS;
use super::super::stick_slip::ProbeAction;
use super::super::stick_slip::StickSlip;
use super::continuations::Ways;
use super::{Several, SeveralWork};
use crate::dynamics::integrate::Probe;
use crate::dynamics::system::frozen::Frozen;
use crate::dynamics::system::passes::{Extent, Work};
use crate::kinematics::linkage::kinetostatics::ForceFailure;

/// A pair at rest in a given motion begins to slide where its rate passes this part of what it
/// is the sum of.
const MOVES: f64 = 1e-9;

impl Several {
    /// Rate of a pair, and the size of what it is the sum of.
    pub(super) fn rate(&self, pair: usize, own: &SeveralWork<f64>) -> [f64; 2] {
        let rates = self.kinetostatics.pair_rates(pair, &own.forces);
        let parts = rates.iter().zip(&own.inputs);
        parts.fold([0.0; 2], |[sum, size], (rate, input)| {
            let part = rate * input.first;
            [sum + part, size + part.abs()]
        })
    }
}

impl Frozen {
    /// Number of the probe of the linkage of several inputs: after those of all groups.
    fn multi_input_probe_index(&self) -> usize {
        self.groups.len()
    }

    /// Number of things with joint friction that have probes.
    pub(in crate::dynamics::system) fn friction_group_count(&self) -> usize {
        self.groups.len() + usize::from(self.several.is_some())
    }

    /// What of the linkage of several inputs to look for.
    pub(in crate::dynamics::system::friction) fn multi_input_probes(
        &self,
        modes: &[i64],
        out: &mut Vec<Probe>,
    ) {
        let Some(several) = &self.several else {
            return;
        };
        // (The component of the whole is no cause of a switch.)
        let mut probe = |action: ProbeAction, looks: usize| {
            out.push(Probe {
                index: self.multi_input_probe_index(),
                component: several.component + 1,
                target: action.target(),
                looks,
                refined: false,
            });
        };
        if several.states(modes).any(|state| state == StickSlip::Stuck) {
            probe(ProbeAction::Start(StickSlip::Forward), LOOKS);
        }
        if several.states(modes).any(StickSlip::slides) {
            probe(ProbeAction::Stop, 1);
        }
    }

    /// A probe of the linkage of several inputs at a state: positive where it fires.
    pub(in crate::dynamics::system::friction) fn evaluate_multi_input_probe(
        &self,
        probe: &Probe,
        (time, state, modes): (f64, &[f64], &[i64]),
        work: &mut Work<f64>,
    ) -> f64 {
        let mut out = vec![0.0; self.coordinates];
        self.evaluate(time, state, modes, Extent::Full, work, &mut out);
        let (Some(several), Some(own)) = (&self.several, &mut work.several) else {
            return Probe::RESTS;
        };
        match ProbeAction::of(probe.target) {
            ProbeAction::Stop => match several.unsolved(own) {
                Some(Obstacle::Failed(ForceFailure::SelfLocking { .. })) => Probe::NO_FORCES,
                Some(_) => Probe::FIRES,
                None => Probe::RESTS,
            },
            _ => several.breaks_loose(own),
        }
    }
}

impl Several {
    /// Why the motion last evaluated has no solution, or not just one.
    pub(super) fn unsolved(&self, own: &mut SeveralWork<f64>) -> Option<Obstacle> {
        if own.failure.is_some() {
            return own.failure;
        }
        let SeveralWork {
            forces,
            mobility_values,
            sliding,
            ..
        } = own;
        let solver = &self.kinetostatics;
        match solver.solve_friction(mobility_values, sliding, &solver_options(true), forces) {
            Ok(1) => None,
            Ok(_) => Some(Obstacle::Several),
            Err(failure) => Some(Obstacle::Failed(failure)),
        }
    }

    /// Positive where something that rests no longer does so.
    fn breaks_loose(&self, own: &mut SeveralWork<f64>) -> f64 {
        if matches!(own.failure, Some(Obstacle::Failed(failure))
            if !matches!(failure, ForceFailure::SelfLocking { .. }))
        {
            return Probe::RESTS;
        }
        let ways = Ways::new(self, own);
        let resting = ways.resting();
        let moves = resting
            .iter()
            .filter(|&&pair| ways.is_given(pair))
            .any(|&pair| {
                let [rate, size] = self.rate(pair, ways.own);
                rate.abs() > MOVES * size
            });
        if moves {
            return Probe::FIRES;
        }
        let mut ways = ways;
        ways.loosens(&resting, 0.0).unwrap_or(Probe::NO_FORCES)
    }
}
