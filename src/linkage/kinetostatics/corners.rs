//! On which sides the corners of blocks press: where the normal force on a corner
//! passes through zero, the friction of its guide has a kink, |N|. With the sides
//! given it has none.

use super::Kinetostatics;
use super::friction::{Law, Term};
use super::workspace::ForceWorkspace;

/// Blocks whose sides are told: two bits each in a number.
const BLOCKS: usize = 31;
/// Normal forces below this part of the greatest reaction are rounding; more, where
/// the equations are badly conditioned.
const ROUNDING: f64 = 1e-12;
const ROUNDINGS: f64 = 8.0 * f64::EPSILON;

impl Kinetostatics {
    /// Number of guides that have friction.
    pub fn rubbing_guides(&self) -> usize {
        let factors = self.friction_factors.iter().flatten();
        factors.filter(|law| matches!(law, Law::Guide(_))).count()
    }

    /// Which corners of blocks with friction press with a positive normal force in
    /// the motion found by [`Self::resist`], as bits (of the first 31 blocks): a
    /// change makes a kink in the friction.
    pub fn pressing_corners(&self, w: &ForceWorkspace) -> u64 {
        let bits = guides(&w.terms).enumerate().map(|(block, term)| {
            let [first, second] = [0, 1].map(|k| u64::from(w.unknowns[term.unknown + k] > 0.0));
            (second << 1 | first) << (2 * block)
        });
        bits.fold(0, |sum, bits| sum | bits)
    }

    /// Corners that press on the other side than the one that was given to
    /// [`Self::resist`], as bits that are to be changed.
    pub fn lifted_corners(&self, w: &ForceWorkspace) -> u64 {
        let bits = guides(&w.terms).enumerate().map(|(block, term)| {
            let forces = term.normal_forces(w);
            let [first, second] = forces.map(|force| u64::from(force < 0.0));
            (second << 1 | first) << (2 * block)
        });
        bits.fold(0, |sum, bits| sum | bits)
    }

    /// How far the corners are from pressing on the other side than the one that
    /// was given to [`Self::resist`]: the least normal force over the greatest
    /// reaction, plus what is rounding. Negative where one has changed its side.
    pub fn pressing_margin(&self, w: &ForceWorkspace) -> f64 {
        let scale = w.scale();
        let least = guides(&w.terms)
            .flat_map(|term| term.normal_forces(w))
            .fold(f64::INFINITY, f64::min);
        if scale > 0.0 {
            least / scale + ROUNDING.max(ROUNDINGS / w.factors.pivots())
        } else {
            f64::INFINITY
        }
    }
}

impl Term {
    /// Normal forces on a block's corners, positive on the sides given.
    fn normal_forces(&self, w: &ForceWorkspace) -> [f64; 2] {
        let [a, b] = [0, 1].map(|k| w.unknowns[self.unknown + k]);
        match self.pressed {
            Some([p, q]) => [p * a, q * b],
            None => [a.abs(), b.abs()],
        }
    }
}

/// The guides whose corners are told.
fn guides(terms: &[Term]) -> impl Iterator<Item = &Term> {
    let is_guide = |term: &&Term| matches!(term.law, Law::Guide(_));
    terms.iter().filter(is_guide).take(BLOCKS)
}

/// Gives the corners of all guides the sides on which they press.
pub(super) fn press(bits: u64, terms: &mut [Term]) {
    let is_guide = |term: &&mut Term| matches!(term.law, Law::Guide(_));
    let guides = terms.iter_mut().filter(is_guide).take(BLOCKS);
    for (block, term) in guides.enumerate() {
        let sign = |corner: usize| match bits >> (2 * block + corner) & 1 {
            1 => 1.0,
            _ => -1.0,
        };
        term.pressed = Some([sign(0), sign(1)]);
    }
}
