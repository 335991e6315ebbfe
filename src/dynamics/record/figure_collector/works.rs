//! Works of a step for the energy audit, integrated between the kinks of the powers.

use super::FigureCollector;
use crate::dynamics::energy::EnergyAudit;
use crate::dynamics::integrate::Modes;
use crate::dynamics::record::observed::places;
use crate::dynamics::record::peaks::PLACES;
use crate::math::polynomial::{MAX_DEGREE, Step};
use crate::math::roots::bisect;

/// Bisections that a kink of the friction is located by.
const KINK_BISECTIONS: u32 = 24;

impl FigureCollector<'_> {
    /// Works of the step, integrated between the kinks of the powers.
    pub(super) fn balance_step(&mut self, step: &Step<'_>, modes: &Modes) -> EnergyAudit {
        self.kinks.clear();
        let openings = self.coordinates.iter().filter_map(|own| own.opening);
        self.kinks.extend(openings.filter_map(|opening| {
            let mut room = [0.0; MAX_DEGREE + 1];
            let mode = modes.0[opening.component];
            (mode == 0).then_some(())?;
            let x = opening.deformation(step, &mut room);
            opening.flank_exit(mode, x, step.end)
        }));
        self.add_kinks_of_friction(step, modes);
        if self.kinks.is_empty() && self.joints.is_empty() {
            for (index, power) in self.powers.iter().enumerate().take(6).skip(1) {
                self.ledger.add(index, step.end * step.length, *power);
            }
            return self.ledger.close_step(self.energy);
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
        self.ledger.close_step(self.energy)
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
