//! Series of massless points between a contact element and link 1.

use super::{Taylor, ZERO};
use crate::dynamics::model::Closure;
use crate::dynamics::system::frozen::Frozen;
use crate::dynamics::system::pairs::OPEN;
use crate::math::polynomial::product;

impl Frozen {
    /// Coefficient `order` of z̈ of a chain's point, ü of mass 1 being known to that order:
    /// (b₁ + D)·z̈ = c₁(u̇₁ − ż) + b₁ü₁ − k·ż − k·κ·s·ż², with D = b_c or k·κ·p.
    pub(super) fn point_of(&self, index: usize, order: usize, taylor: &Taylor) -> f64 {
        let chain = &self.chains[index];
        let contact = &chain.contact;
        let (c, b) = self.link_behind(chain);
        let first = chain.first_coordinate;
        let (z, rate) = (&taylor.u[first], &taylor.v[first]);
        let acceleration = |coordinate: usize, k: usize| {
            (k + 1) as f64 * taylor.v[coordinate][k + 1] / taylor.length
        };
        let next = acceleration(first + 1, order);
        let bilateral = contact.closure == Closure::Bilateral;
        let mode = taylor.modes[index];
        let pull = c * (taylor.v[first + 1][order] - rate[order]) + b * next;
        if mode == OPEN && !bilateral {
            return if b == 0.0 { next } else { pull / b };
        }
        let k = contact.stiffness();
        let (damping, kappa) = contact.losses();
        let Some(kappa) = kappa else {
            return match b + damping {
                0.0 => next,
                sum => (pull - k * rate[order]) / sum,
            };
        };
        let side = mode as f64;
        let mut depth = ZERO;
        for (depth, z) in depth[..=order].iter_mut().zip(z) {
            *depth = side * z;
        }
        depth[0] -= contact.half_gap;
        let known: f64 = (1..=order)
            .map(|j| depth[j] * acceleration(first, order - j))
            .sum();
        let square = product(rate, rate, order);
        let lost = k * (rate[order] + kappa * (side * square + known));
        (pull - lost) / (b + k * kappa * depth[0])
    }
}
