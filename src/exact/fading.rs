//! Modes that have died away leave the search until a switch excites them again.
//!
//! Lanes stand in ascending |λ|; a vector with a harmonic of the law stays. The last vector of lanes is left out once none of
//! its lanes adds as much as 10⁻²² of the greatest lane that stays, neither to
//! displacements nor to accelerations: six digits below rounding, so that it
//! is nothing in any functional either. It stays out to the end of the phase:
//! modes only decay.

use super::basis::Basis;
use super::lanes::V;
use super::phase::{Exponentials, Phase};

/// Square of the share below which a lane is nothing.
const FADED: f64 = 1e-44;

impl Phase {
    /// True when the last vector has faded at the instant of `e`.
    #[inline(always)]
    pub(super) fn fades(&self, basis: &Basis, e: &Exponentials) -> bool {
        if self.active <= basis.kept {
            return false;
        }
        let last = self.active - 1;
        // A look at the decay alone tells most often that it is too early.
        let alive = e.size[last].zip(basis.present[last], |size, one| size * one);
        alive.greatest() <= 1e-9 && self.faded(basis, e, last)
    }

    /// Leaves out the last vector, whose entries in `e` become zero.
    pub(super) fn drop_last_vector(&mut self, e: &mut Exponentials) {
        let last = self.active - 1;
        e.re[last] = V::ZERO;
        e.im[last] = V::ZERO;
        e.size[last] = V::ZERO;
        self.active = last;
    }

    /// True when vector `last` is nothing beside those before it.
    #[inline(never)]
    fn faded(&self, basis: &Basis, e: &Exponentials, last: usize) -> bool {
        let square = |b: usize| {
            let own = self.re[b] * self.re[b] + self.im[b] * self.im[b];
            own * e.size[b] * e.size[b] * basis.extent[b]
        };
        let (mut place, mut force) = (0.0f64, 0.0f64);
        for b in 0..last {
            place = place.max(square(b).greatest());
            force = force.max((square(b) * basis.fourth[b]).greatest());
        }
        let own = square(last);
        own.greatest() <= FADED * place && (own * basis.fourth[last]).greatest() <= FADED * force
    }

    /// Takes all lanes in again.
    #[inline(always)]
    pub(super) fn revive(&mut self, basis: &Basis) {
        self.active = basis.blocks;
    }
}
