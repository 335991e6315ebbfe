//! Massless points between a contact element and link 1.
//!
//! A chain behind such a point begins with it: coordinate z, without inertia. The force
//! F(z, ż) of the contact and that of link 1 are in balance,
//!
//! F(z, ż) = c₁(u₁ − z) + b₁(u̇₁ − ż),  F = s·e(p) + D·ż,  p = s·z − η/2,
//!
//! with the elastic force e of the contact and its damping D = b_c or κ·e; F = 0 while the
//! pair is open. That determines ż: the point is a state of first order, which relaxes at
//! 1/τ = c₁/b₁ while the pair is open. The state holds ż too, as it does of every coordinate,
//! and z̈ is the derivative of the balance; so guards, Jacobians and series are those of all
//! other coordinates. Forces are taken from the balance and not from the ż of the state, and
//! a switch of the pair sets that one anew.
//!
//! The balance is a first integral. It is linear if the contact is, and every method then keeps
//! it; if it is not linear, ż is drawn back to it. A point has no inertia: statics, scales and
//! the pattern of the Jacobian treat it as a node without load. Natural frequencies leave it
//! out, with contact and link 1 in series.

use super::System;
use super::balance::Balance;
use super::frozen::{Chain, Frozen};
use super::pairs::OPEN;
use crate::dynamics::model::Closure;
use crate::math::quantity::Quantity;

/// The contact at an instant, as the balance of a point needs it.
struct Felt<N> {
    /// s·e(p) and e′.
    elastic: [N; 2],
    /// D and dD/dz.
    damping: [N; 2],
}

impl Frozen {
    /// Deformation rate of a chain's pair: ẋ, of a massless point from the balance.
    #[inline(always)]
    pub(super) fn pair_rate<N: Quantity>(&self, chain: &Chain, mode: i64, u: &[N], v: &[N]) -> N {
        if chain.point {
            self.balanced_rate(chain, mode, u, v)
        } else {
            v[0]
        }
    }

    /// F of the link that holds a chain's pair.
    #[inline(always)]
    pub(super) fn reaction_of_link<N: Quantity>(
        &self,
        chain: &Chain,
        mode: i64,
        u: &[N],
        v: &[N],
    ) -> N {
        chain
            .contact
            .force(mode, u[0], self.pair_rate(chain, mode, u, v))
    }

    fn balanced_rate<N: Quantity>(&self, chain: &Chain, mode: i64, u: &[N], v: &[N]) -> N {
        let (c, b) = self.link_behind(chain);
        let felt = contact_force_at(chain, mode, u[0]);
        if b == 0.0 && felt.damping[0].value() == 0.0 {
            // Nothing but link 1, undamped: it is not stretched, and goes with mass 1.
            return v[1];
        }
        let pull = (u[1] - u[0]).scale(c) + v[1].scale(b) - felt.elastic[0];
        pull / (N::from(b) + felt.damping[0])
    }

    /// z̈ of a chain's point, given ü of mass 1.
    pub(super) fn point_acceleration<N: Quantity>(
        &self,
        chain: &Chain,
        mode: i64,
        (u, v): (&[N], &[N]),
        next: N,
    ) -> N {
        let (c, b) = self.link_behind(chain);
        let felt = contact_force_at(chain, mode, u[0]);
        if b == 0.0 && felt.damping[0].value() == 0.0 {
            return next;
        }
        let pull = (v[1] - v[0]).scale(c) + next.scale(b);
        let lost = (felt.elastic[1] + felt.damping[1] * v[0]) * v[0];
        let damping = N::from(b) + felt.damping[0];
        if chain.contact.losses().1.is_none() {
            return (pull - lost) / damping;
        }
        // No method keeps a balance that is not linear: ż is drawn back to it, as fast as
        // the point relaxes.
        let balance = (u[1] - u[0]).scale(c) + v[1].scale(b) - felt.elastic[0];
        let miss = v[0] - balance / damping;
        let relaxing = N::from(c) + felt.elastic[1];
        (pull - lost - miss * relaxing) / damping
    }

    /// Sets ż of every point to what the balance of its forces asks for.
    pub(super) fn settle_points(&self, y: &mut [f64], modes: &[i64]) {
        for chain in self.chains.iter().filter(|chain| chain.point) {
            let (u, v) = self.deviations(chain, y);
            let rate = self.balanced_rate(chain, self.pair_mode(chain, modes), u, v);
            y[self.coordinates + chain.first_coordinate] = rate;
        }
    }

    /// Sets z of every point to where contact and link 1 are in balance at rest: of a state
    /// that is given by the masses alone.
    pub(super) fn rest_points(&self, y: &mut [f64]) {
        for chain in self.chains.iter().filter(|chain| chain.point) {
            let (u, _) = self.deviations(chain, y);
            y[chain.first_coordinate] = self.point_at_rest(chain, u[1]);
        }
    }

    /// z at rest where mass 1 is at u₁.
    fn point_at_rest(&self, chain: &Chain, next: f64) -> f64 {
        let (c, _) = self.link_behind(chain);
        let contact = &chain.contact;
        let share = |depth: f64| match contact.power() {
            None => depth * c / (c + contact.stiffness()),
            Some(power) => power.in_series_with_compliance(1.0 / c).indentation(depth),
        };
        if contact.closure == Closure::Bilateral {
            return share(next);
        }
        let pressed = contact.sides().iter().find_map(|&side| {
            let (depth, _) = contact.penetration(side, next, 0.0);
            let flank = side as f64 * contact.half_gap;
            (depth > 0.0).then(|| flank + side as f64 * share(depth))
        });
        // Clear of its flanks it goes with mass 1.
        pressed.unwrap_or(next)
    }

    /// c and b of link 1 behind a chain's point.
    pub(super) fn link_behind(&self, chain: &Chain) -> (f64, f64) {
        let link = chain.first_coordinate + 1;
        (self.stiffness[link], self.damping[link])
    }
}

/// The contact of a chain at z.
fn contact_force_at<N: Quantity>(chain: &Chain, mode: i64, z: N) -> Felt<N> {
    let zero = N::from(0.0);
    let contact = &chain.contact;
    let (damping, kappa) = contact.losses();
    let bilateral = contact.closure == Closure::Bilateral;
    if mode == OPEN && !bilateral {
        return Felt {
            elastic: [zero; 2],
            damping: [zero; 2],
        };
    }
    // (A bilateral pair has no side: its force is c·z + b·ż.)
    let side = if bilateral { 1 } else { mode };
    let (p, _) = contact.penetration(side, z, zero);
    let [force, slope] = contact.elastic_force(p);
    let damping = match kappa {
        None => [N::from(damping), zero],
        Some(kappa) => [force.scale(kappa), slope.scale(side as f64 * kappa)],
    };
    Felt {
        elastic: [force.scale(side as f64), slope],
        damping,
    }
}

impl System {
    /// Sets the stiffness of contacts by a power of the indentation, as scales and frequencies need one, to that
    /// at the static penetration; where nothing presses, at the least deflection that counts.
    pub(super) fn find_tangents(&mut self) {
        let nonlinear = |chain: &Chain| chain.contact.power().is_some();
        if !self.frozen.chains.iter().any(nonlinear) {
            return;
        }
        let mut modes = self.frozen.no_modes();
        let balanced = self.frozen.balance_from_law(Balance::Static, &mut modes);
        for (index, chain) in self.frozen.chains.iter().enumerate() {
            let Some(power) = chain.contact.power() else {
                continue;
            };
            let force = balanced.as_ref().map_or(0.0, |own| own.reactions[index]);
            let depth = power.penetration(force.abs()).max(super::scales::FLOOR);
            let first = chain.first_coordinate;
            self.frozen.stiffness[first] = power.jet(depth).first;
            let mut branches = self.frozen.branches.iter_mut();
            let own = |branch: &&mut super::frozen::Branch| branch.chain.first_coordinate == first;
            if let Some(branch) = branches.find(own) {
                branch.stiffness[0] = self.frozen.stiffness[first];
            }
        }
    }
}
