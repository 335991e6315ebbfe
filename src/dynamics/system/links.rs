//! The forces of a chain's links, and chains on which nothing else acts.

use super::frozen::{Branch, Frozen, segment};
use crate::kinematics::motion::DriveMotion;
use crate::math::quantity::Quantity;

impl Frozen {
    /// u¨ of a branch: a chain on its own behind a prescribed drive, which
    /// nothing else has a say in. The same equations, in one go.
    #[inline(always)]
    pub(super) fn evaluate_branch<N: Quantity>(
        &self,
        branch: &Branch,
        time: N,
        state: &[N],
        modes: &[i64],
        out: &mut [N],
    ) {
        let chain = &branch.chain;
        let piece = segment(modes, branch.drive.component);
        let base = match branch.drive.motion {
            // φ̈ = 0: U′ is not needed, nor its cosine computed.
            DriveMotion::Constant { .. } => {
                let [place, speed, _] = time.lift(|time| branch.drive.motion.jet(piece, time));
                let [_, _, second] = place.lift(|phi| branch.law.jet(modes, phi));
                second * speed * speed
            }
            _ => {
                let [place, speed, acceleration] =
                    time.lift(|time| branch.drive.motion.jet(piece, time));
                let [_, first, second] = place.lift(|phi| branch.law.jet(modes, phi));
                first * acceleration + second * speed * speed
            }
        };
        let (u, v) = self.deviations(chain, state);
        let mode = self.pair_mode(chain, modes);
        let skip = chain.points();
        let links = LinkForces {
            u: &u[skip..],
            v: &v[skip..],
            stiffness: &branch.stiffness[skip..],
            damping: &branch.damping[skip..],
            reaction: self.reaction_of_link(chain, mode, u, v),
        };
        let out = &mut out[chain.coordinates()];
        accelerate_alone(&links, branch, base, &mut out[skip..]);
        if chain.point {
            out[0] = self.point_acceleration(chain, mode, (u, v), out[1]);
        }
    }
}

/// u¨ of masses on which only their links and constant loads act. On its own,
/// so that the compiler knows that `out` overlaps nothing.
#[inline(never)]
fn accelerate_alone<N: Quantity>(
    links: &LinkForces<'_, N>,
    branch: &Branch,
    base: N,
    out: &mut [N],
) {
    let skip = branch.chain.points();
    let constant = &branch.constant_force[skip..][..out.len()];
    let inverse = &branch.inverse_inertia[skip..][..out.len()];
    links.for_each_mass(out, |m, out, force| {
        *out = (N::from(constant[m]) + force).scale(inverse[m]) - base;
    });
}

/// The links of one chain at an instant.
pub(super) struct LinkForces<'a, N> {
    /// Deviations of the masses.
    pub(super) u: &'a [N],
    /// Rates of the coordinates.
    pub(super) v: &'a [N],
    /// c of the link below each mass.
    pub(super) stiffness: &'a [f64],
    /// b of the link below each mass.
    pub(super) damping: &'a [f64],
    /// F of link 1.
    pub(super) reaction: N,
}

impl<N: Quantity> LinkForces<'_, N> {
    /// Calls `each` with every mass, its entry of `out`, and the force of the
    /// links above and below on it.
    #[inline(always)]
    pub(super) fn for_each_mass(&self, out: &mut [N], each: impl Fn(usize, &mut N, N)) {
        let last = out.len() - 1;
        let (u, v) = (&self.u[..=last], &self.v[..=last]);
        let (stiffness, damping) = (&self.stiffness[..=last], &self.damping[..=last]);
        let mut below = self.reaction;
        for m in 0..last {
            let stretch = (u[m + 1] - u[m]).scale(stiffness[m + 1]);
            let above = stretch + (v[m + 1] - v[m]).scale(damping[m + 1]);
            each(m, &mut out[m], above - below);
            below = above;
        }
        each(last, &mut out[last], -below);
    }
}
