//! On which sides pairs press: where the normal force on a block's corner passes
//! through zero, the friction of its guide has a kink, |N|; where the reaction of a pin
//! passes close by zero, √(X² + Y²) has nearly one. With the sides of blocks given they
//! have none, and it is known where to look at pins.

use super::Kinetostatics;
use super::friction::{Law, Term};
use super::workspace::ForceWorkspace;

/// Pairs whose sides are told: two bits each in a number.
const PAIRS: usize = 31;
/// Normal forces below this part of the greatest reaction are rounding; more, where
/// the equations are badly conditioned.
const NO_NORMAL_FORCE: f64 = 1e-12;
const ROUNDINGS: f64 = 8.0 * f64::EPSILON;
/// The reaction of a pin that turns by more than a right angle is smooth as long as it
/// keeps this part of the greatest reaction.
const SHARP: f64 = 0.2;

impl Kinetostatics {
    /// Number of guides that have friction.
    pub fn rubbing_guides(&self) -> usize {
        let factors = self.friction_factors.iter().flatten();
        factors.filter(|law| matches!(law, Law::Guide(_))).count()
    }

    /// Which corners of blocks with friction press with a positive normal force in
    /// the motion found by [`Self::resist`], as bits: a change makes a kink in the
    /// friction.
    pub fn pressing_corners(&self, w: &ForceWorkspace) -> u64 {
        bits(&w.terms, |term| match term.law {
            Law::Pin(_) | Law::HeldGuide { .. } => 0,
            Law::Guide(_) => term.pressed_side(w),
        })
    }

    /// The sides on which pairs with friction press in the motion found by
    /// [`Self::resist`], as bits (of the first 31): those of blocks' corners, and the
    /// quadrants of the reactions of pins.
    pub fn pressed_sides(&self, w: &ForceWorkspace) -> u64 {
        bits(&w.terms, |term| term.pressed_side(w))
    }

    /// Corners that press on the other side than the one that was given to
    /// [`Self::resist`], as bits that are to be changed.
    pub fn lifted_corners(&self, w: &ForceWorkspace) -> u64 {
        bits(&w.terms, |term| match term.law {
            Law::Pin(_) | Law::HeldGuide { .. } => 0,
            Law::Guide(_) => {
                let [first, second] = term.forces_towards(w).map(|force| u64::from(force < 0.0));
                second << 1 | first
            }
        })
    }

    /// How far the pairs are from pressing on another side than the one that was
    /// given to [`Self::resist`]: the least normal force over the greatest reaction,
    /// plus what is rounding. Negative where one has changed its side; a pin only
    /// where its reaction has nearly vanished on the way.
    pub fn side_margin(&self, w: &ForceWorkspace) -> f64 {
        let scale = w.greatest_magnitude();
        let terms = w.terms.iter().take(PAIRS);
        let least = terms.map(|term| {
            let [first, second] = term.forces_towards(w);
            match term.law {
                Law::Guide(_) => first.min(second),
                Law::Pin(_) if second.abs() > SHARP * scale => first.max(0.0),
                Law::Pin(_) | Law::HeldGuide { .. } => first,
            }
        });
        let least = least.fold(f64::INFINITY, f64::min);
        if scale > 0.0 {
            least / scale + NO_NORMAL_FORCE.max(ROUNDINGS / w.factors.pivots())
        } else {
            f64::INFINITY
        }
    }
}

impl Term {
    /// The side on which it presses, as two bits.
    fn pressed_side(&self, w: &ForceWorkspace) -> u64 {
        let [a, b] = [0, 1].map(|k| w.unknowns[self.unknown + k]);
        match self.law {
            Law::Guide(_) => u64::from(b > 0.0) << 1 | u64::from(a > 0.0),
            Law::Pin(_) if a.abs() >= b.abs() => u64::from(a > 0.0),
            Law::Pin(_) | Law::HeldGuide { .. } => 2 | u64::from(b > 0.0),
        }
    }

    /// What the two bits of a side say: the signs of both corners' normal forces, or
    /// the direction in the middle of a quadrant.
    fn of_side(&self, bits: u64) -> [f64; 2] {
        let sign = |bit: u64| if bits & bit == 0 { -1.0 } else { 1.0 };
        match self.law {
            Law::Guide(_) => [sign(1), sign(2)],
            Law::Pin(_) if bits & 2 == 0 => [sign(1), 0.0],
            Law::Pin(_) | Law::HeldGuide { .. } => [0.0, sign(1)],
        }
    }

    /// Normal forces on a block's corners, positive on the sides given; reaction of a
    /// pin along the direction given, and across it.
    fn forces_towards(&self, w: &ForceWorkspace) -> [f64; 2] {
        let [a, b] = [0, 1].map(|k| w.unknowns[self.unknown + k]);
        match (self.law, self.pressed) {
            (Law::Guide(_), Some([p, q])) => [p * a, q * b],
            (Law::Guide(_), None) => [a.abs(), b.abs()],
            (_, Some([p, q])) => [p * a + q * b, q * a - p * b],
            (_, None) => [(a * a + b * b).sqrt(), 0.0],
        }
    }
}

/// Two bits of each pair with friction.
fn bits(terms: &[Term], of: impl Fn(&Term) -> u64) -> u64 {
    let terms = terms.iter().take(PAIRS).enumerate();
    terms.fold(0, |bits, (index, term)| bits | of(term) << (2 * index))
}

/// Gives all pairs with friction the sides on which they press.
pub(super) fn press(sides: u64, terms: &mut [Term]) {
    for (index, term) in terms.iter_mut().take(PAIRS).enumerate() {
        term.pressed = Some(term.of_side(sides >> (2 * index) & 3));
    }
}
