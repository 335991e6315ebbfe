//! Works of a step for the energy audit, integrated between the kinks of the powers.

use super::Recorder;
use crate::integrate::Modes;
use crate::polynomial::{MAX_DEGREE, Step};
use crate::record::peaks::PLACES;
use crate::record::tracker::StepView;

/// Bisections that a kink of the friction is located by.
const KINK_BISECTIONS: usize = 24;

impl Recorder<'_> {
    /// Works of the step, integrated between the kinks of the powers, and the
    /// energy at its end.
    pub(super) fn balance_step(&mut self, step: &Step<'_>, modes: &Modes) {
        self.kinks.clear();
        self.kinks.extend(self.pairs.iter().filter_map(|pair| {
            let mut room = [0.0; MAX_DEGREE + 1];
            let x = step.signal(pair.coordinate(), &mut room);
            pair.leaves_flank(modes.0[pair.component], x, step.end)
        }));
        self.add_kinks_of_friction(step, modes);
        if self.kinks.is_empty() && self.joints.is_empty() {
            for (index, power) in self.powers.iter().enumerate().take(6).skip(1) {
                self.ledger.add(index, step.end * step.length, *power);
            }
            return self.ledger.see(self.energy);
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
        self.ledger.see(self.energy);
    }

    /// Kinks of the friction in the joints: between neighbouring places that differ.
    fn add_kinks_of_friction(&mut self, step: &Step<'_>, modes: &Modes) {
        let places = StepView::places(step.end);
        for index in 0..6 {
            let before = self.sides[index];
            if before == self.sides[index + 1] {
                continue;
            }
            let [mut low, mut high] = [places[index], places[index + 1]];
            for _ in 0..KINK_BISECTIONS {
                let middle = 0.5 * (low + high);
                self.observer.at(step, middle, modes);
                match self.observer.friction_side() == before {
                    true => low = middle,
                    false => high = middle,
                }
            }
            self.kinks.push(high);
        }
    }
}
