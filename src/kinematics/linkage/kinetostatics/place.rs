//! Where pairs are at a position and in which direction they slide.

use super::Kinetostatics;
use super::friction::sliding_sign;
use super::positions::{LinkPosition, Positions};
use super::workspace::ForceWorkspace;
use crate::kinematics::linkage::spec::ForceLaw;

/// A rate below this part of the greatest is rounding, and the pair's
/// direction of sliding is that of the rate's change.
pub(super) const AT_REST: f64 = 1e-12;

impl Kinetostatics {
    /// Reads positions and places of pairs, for an input moving in `direction`.
    pub(super) fn read_positions<P: Positions>(
        &self,
        positions: &P,
        direction: f64,
        w: &mut ForceWorkspace,
    ) {
        self.place_links(positions, w);
        let scales = self.scales(w);
        for (index, pair) in w.pairs.iter_mut().enumerate() {
            let unit = self.units[index];
            let scales = scales.map(|scale| scale / unit);
            pair.sense = sliding_sign(pair.rates, scales, direction);
        }
    }

    /// The same for pairs that slide in the directions `senses` (−1, 0 or 1) while
    /// the input moves forwards.
    pub(super) fn place_sliding<P: Positions>(
        &self,
        positions: &P,
        senses: &[f64],
        direction: f64,
        w: &mut ForceWorkspace,
    ) {
        self.place_links(positions, w);
        for (pair, &sense) in w.pairs.iter_mut().zip(senses) {
            pair.sense = sense * direction;
        }
    }

    fn place_links<P: Positions>(&self, positions: &P, w: &mut ForceWorkspace) {
        for (index, link) in w.links.iter_mut().enumerate() {
            *link = positions.link(index);
        }
        for index in 0..self.spec.links.len() {
            w.centres[index] = w.links[index].point(self.spec.links[index].centre);
        }
        for index in 0..self.spec.pairs.len() {
            w.pairs[index].rates = positions.pair_rates(index);
            self.place_pair(index, w);
        }
        for force in &self.spec.forces {
            if let ForceLaw::Torsion { pair, .. } = force.law {
                w.pairs[pair].coordinate = positions.pair_coordinate(pair);
            }
        }
    }

    /// Rates, as lengths per unit of the input, that are rounding.
    fn scales(&self, w: &ForceWorkspace) -> [f64; 3] {
        let mut scales = [0.0f64; 3];
        for (pair, unit) in w.pairs.iter().zip(&self.units) {
            for (scale, rate) in scales.iter_mut().zip(pair.rates) {
                *scale = scale.max(rate.abs() * unit);
            }
        }
        let [first, second, third] = scales;
        [first, second.max(first), third.max(second).max(first)].map(|scale| AT_REST * scale)
    }

    /// Point, direction and corners of a pair.
    fn place_pair(&self, index: usize, w: &mut ForceWorkspace) {
        let pair = &self.spec.pairs[index];
        let link = frame(&w.links, pair.link.link);
        let place = &mut w.pairs[index];
        place.point = link.point(pair.link.at).place;
        place.tangent = frame(&w.links, pair.on.link).vector_in_ground(self.directions[index]);
    }
}

/// The frame of a link or of the ground.
pub(super) fn frame(links: &[LinkPosition], link: Option<usize>) -> LinkPosition {
    link.map_or(LinkPosition::GROUND, |link| links[link])
}
