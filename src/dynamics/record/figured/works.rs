//! Works of a step for the energy audit, integrated between the kinks of the powers.

use super::Figured;
use crate::dynamics::energy::EnergyAudit;
use crate::dynamics::integrate::Modes;
use crate::dynamics::model::NodeMotion;
use crate::dynamics::record::observed::places;
use crate::dynamics::record::peaks::PLACES;
use crate::dynamics::system::System;
use crate::math::polynomial::{MAX_DEGREE, Step};
use crate::math::roots::bisect;

/// Bisections that a kink of the friction is located by.
const KINK_BISECTIONS: u32 = 24;

/// Joints of motions within a step that its works are integrated between: of a table that
/// is finer than the steps, each is hardly a kink.
const MOST_JOINTS: usize = 16;

/// Times at which a derivative of a prescribed motion jumps, ascending (s).
pub(super) fn joint_times(system: &System) -> Vec<f64> {
    let mut times: Vec<f64> = Vec::new();
    for node in &system.model().nodes {
        match &node.motion {
            NodeMotion::Prescribed { motion, .. } => times.extend(motion.joints()),
            NodeMotion::Rotor { .. }
            | NodeMotion::Mass { .. }
            | NodeMotion::Rigid { .. }
            | NodeMotion::Constrained { .. } => {}
        }
    }
    times.sort_by(f64::total_cmp);
    times.dedup();
    times
}

impl Figured<'_> {
    /// Works of the step, integrated between the kinks of the powers.
    pub(super) fn balance_step(&mut self, step: &Step<'_>, modes: &Modes) -> EnergyAudit {
        self.kinks.clear();
        let openings = self.coordinates.iter().filter_map(|own| own.opening);
        self.kinks.extend(openings.filter_map(|opening| {
            let mut room = [0.0; MAX_DEGREE + 1];
            let mode = modes.0[opening.component];
            (mode == 0).then_some(())?;
            let x = opening.deformation(step, &mut room);
            opening.leaves_flank(mode, x, step.end)
        }));
        self.add_kinks_of_friction(step, modes);
        self.add_joints_of_motions(step);
        if self.kinks.is_empty() && self.joints.is_empty() {
            for (index, power) in self.powers.iter().enumerate().take(6).skip(1) {
                self.ledger.add(index, step.end * step.length, *power);
            }
            return self.ledger.close(self.energy);
        }
        self.kinks.sort_by(f64::total_cmp);
        self.kinks.push(step.end);
        let mut from = 0.0;
        for &to in &self.kinks {
            for (index, place) in PLACES.iter().enumerate().take(6).skip(1) {
                let s = from + place * (to - from);
                let power = self.observer.power(step, s, modes);
                let span = (to - from) * step.length;
                self.ledger.add(index, span, power);
                if self.joints.is_empty() {
                    continue;
                }
                let losses = self.observer.friction_losses(modes);
                for (joints, (_, loss)) in self.joints.iter_mut().zip(losses) {
                    joints.add(index, span, loss);
                }
            }
            from = to;
        }
        self.ledger.close(self.energy)
    }

    /// Joints of prescribed motions that no step ends at: the points of a table.
    fn add_joints_of_motions(&mut self, step: &Step<'_>) {
        let times = &self.joint_times;
        let (from, until) = (step.start, step.end_time());
        let inner = times.partition_point(|&time| time <= from)
            ..times.partition_point(|&time| time < until);
        if inner.len() > MOST_JOINTS {
            return;
        }
        let inner = times.get(inner).unwrap_or_default();
        (self.kinks).extend(inner.iter().map(|time| (time - from) / step.length));
    }

    /// Kinks of the friction in the joints: between neighbouring places that differ.
    fn add_kinks_of_friction(&mut self, step: &Step<'_>, modes: &Modes) {
        let places = places(step.end);
        for index in 0..6 {
            let before = self.sides[index];
            if before == self.sides[index + 1] {
                continue;
            }
            let ends = [places[index], places[index + 1]];
            let [_, kink] = bisect(ends, KINK_BISECTIONS, |s| {
                self.observer.at(step, s, modes);
                self.observer.friction_side() == before
            });
            self.kinks.push(kink);
        }
    }
}
