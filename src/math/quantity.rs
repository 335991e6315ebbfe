//! Numbers that pass through laws and characteristics.
//!
//! [`Number`] knows the chain rule to first order. The start needs more: the
//! series in time of a motion, for which a law has to be composed to a higher
//! order. Handing over the law itself, not its value, lets every kind of number
//! take from it what it needs.

use crate::math::expression::Scalar;
use crate::math::jet::Jet;
use crate::math::number::{Dual, Duals, Number};

/// A number on which the equations of motion can be evaluated.
pub(crate) trait Quantity: Number + Scalar {
    /// Highest derivative of a function that [`Self::lift`] looks at.
    const DERIVATIVES: usize;

    /// U, U′ and U″ at `self`, for a function U given by its jets.
    fn lift(self, jet: impl Fn(f64) -> Jet) -> [Self; 3];

    /// f at `self`, for a function given by its value and derivative.
    fn apply(self, function: impl Fn(f64) -> (f64, f64)) -> Self;
}

impl Quantity for f64 {
    const DERIVATIVES: usize = 2;

    #[inline(always)]
    fn lift(self, jet: impl Fn(f64) -> Jet) -> [Self; 3] {
        let jet = jet(self);
        [jet.value, jet.first, jet.second]
    }

    #[inline(always)]
    fn apply(self, function: impl Fn(f64) -> (f64, f64)) -> Self {
        function(self).0
    }
}

impl Quantity for Dual {
    const DERIVATIVES: usize = 3;

    #[inline(always)]
    fn lift(self, jet: impl Fn(f64) -> Jet) -> [Self; 3] {
        jet(self.value).lift(self)
    }

    #[inline(always)]
    fn apply(self, function: impl Fn(f64) -> (f64, f64)) -> Self {
        let (value, derivative) = function(self.value);
        self.compose(value, derivative)
    }
}

impl<const K: usize> Quantity for Duals<K> {
    const DERIVATIVES: usize = 3;

    #[inline(always)]
    fn lift(self, jet: impl Fn(f64) -> Jet) -> [Self; 3] {
        jet(self.value).lift(self)
    }

    #[inline(always)]
    fn apply(self, function: impl Fn(f64) -> (f64, f64)) -> Self {
        let (value, derivative) = function(self.value);
        self.compose(value, derivative)
    }
}
