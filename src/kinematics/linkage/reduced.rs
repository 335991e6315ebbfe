//! The linkage as one moving mass on its input coordinate.

use super::Linkage;
use super::forces::ForcePart;
use super::workspace::Workspace;

/// What a linkage amounts to on its input coordinate q:
///
/// J q̈ + ½ J′ q̇² = −V′ + Q − D q̇ + (what drives it)
///
/// All derivatives are by q. J, V and Q need the transfer functions of one
/// order more than their own derivative; those that the order solved to does
/// not give are zero.
#[derive(Clone, Copy, Debug, Default, PartialEq)]
pub struct ReducedLinkage {
    /// J, J′, J″: reduced inertia (kg·m², or kg for a sliding input). J′ needs
    /// order 2, J″ order 3.
    pub inertia: [f64; 3],
    /// V, V′, V″: potential energy of weights and springs (J). V′ needs
    /// order 1, V″ order 2.
    pub potential: [f64; 3],
    /// Q, Q′: generalised force of all other forces, positive along +q (N·m or
    /// N). Q needs order 1, Q′ order 2.
    pub force: [f64; 2],
    /// D, D′: damping, acting as −D q̇ (N·m·s or N·s/m). D needs order 1, D′
    /// order 2.
    pub damping: [f64; 2],
}

impl Linkage {
    /// The linkage on its input coordinate, at the position solved for.
    pub fn reduced_linkage(&self, workspace: &Workspace) -> ReducedLinkage {
        let mut reduced = ReducedLinkage::default();
        match workspace.order() {
            0 => self.masses::<1>(workspace, &mut reduced),
            1 => self.masses::<2>(workspace, &mut reduced),
            2 => self.masses::<3>(workspace, &mut reduced),
            _ => self.masses::<4>(workspace, &mut reduced),
        }
        for index in 0..self.spec().forces.len() {
            reduced.add(&self.force_part(index, workspace));
        }
        reduced
    }

    /// Inertia and weights.
    fn masses<const N: usize>(&self, workspace: &Workspace, reduced: &mut ReducedLinkage) {
        let [gx, gy] = self.spec().gravity;
        for (link, motion) in self.spec().links.iter().zip(&workspace.state.links) {
            if link.mass == 0.0 && link.moment == 0.0 {
                continue;
            }
            let centre = motion.frame::<N>().place(link.centre);
            let (x, y) = (centre.x.jet(), centre.y.jet());
            let [first, second, third] = motion.turning();
            let (m, i) = (link.mass, link.moment);
            if N > 1 {
                let square = x.first * x.first + y.first * y.first;
                reduced.inertia[0] += m * square + i * first * first;
            }
            if N > 2 {
                let slope = x.first * x.second + y.first * y.second;
                reduced.inertia[1] += 2.0 * (m * slope + i * first * second);
            }
            if N > 3 {
                let squares = x.second * x.second + y.second * y.second;
                let products = x.first * x.third + y.first * y.third;
                let turning = second * second + first * third;
                reduced.inertia[2] += 2.0 * (m * (squares + products) + i * turning);
            }
            let values = [(x.value, y.value), (x.first, y.first), (x.second, y.second)];
            for (potential, (x, y)) in reduced.potential.iter_mut().zip(values) {
                *potential -= m * (gx * x + gy * y);
            }
        }
    }
}

impl ReducedLinkage {
    fn add(&mut self, part: &ForcePart) {
        for k in 0..3 {
            self.potential[k] += part.potential[k];
        }
        for k in 0..2 {
            self.force[k] += part.force[k];
            self.damping[k] += part.damping[k];
        }
    }
}
