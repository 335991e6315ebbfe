//! Extremes of functions of a law.

use super::{Law, Peak};
use crate::math::jet::Jet;
use crate::math::optimise::greatest;
use crate::math::roots::{bisect, middle};

impl Law {
    /// The greatest value of a function of the law, and the first τ where it is reached.
    pub(super) fn peak_of(&self, value: &dyn Fn(&Jet) -> f64) -> Peak {
        greatest(&mut self.pieces(), &|piece, tau| {
            value(&self.jet(piece, tau))
        })
    }

    /// As [`Self::peak_of`], the place sharpened where the `slope` of the
    /// value along τ changes its sign.
    pub(super) fn sharp_peak(
        &self,
        value: &dyn Fn(&Jet) -> f64,
        slope: &dyn Fn(&Jet) -> f64,
    ) -> Peak {
        let rough = self.peak_of(value);
        let reach = 1e-4;
        for (piece, from, to) in self.pieces() {
            let (low, high) = ((rough.at - reach).max(from), (rough.at + reach).min(to));
            if low >= high || !(low..=high).contains(&rough.at) {
                continue;
            }
            let at = |tau: f64| slope(&self.jet(piece, tau));
            if at(low) > 0.0 && at(high) < 0.0 {
                let place = middle(bisect([low, high], 60, |tau| at(tau) > 0.0));
                return Peak {
                    value: value(&self.jet(piece, place)),
                    at: place,
                };
            }
        }
        rough
    }
}
