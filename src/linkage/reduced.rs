//! The linkage as one moving mass on its input coordinate.

use super::Linkage;
use super::forces::Part;
use super::workspace::Workspace;

/// What a linkage amounts to on its input coordinate q:
///
/// J q̈ + ½ J′ q̇² = −V′ + Q − D q̇ + (what drives it)
///
/// All derivatives are by q. J, V and Q need the transfer functions of one
/// order more than their own derivative; those that the order solved to does
/// not give are zero.
#[derive(Clone, Copy, Debug, Default, PartialEq)]
pub struct Reduced {
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
    pub fn reduced(&self, workspace: &Workspace) -> Reduced {
        let mut reduced = Reduced::default();
        let gravity = self.spec().gravity;
        for (index, link) in self.spec().links.iter().enumerate() {
            if link.mass == 0.0 && link.moment == 0.0 {
                continue;
            }
            let [x, y] = workspace.point(super::spec::PointOf {
                link: Some(index),
                at: link.centre,
            });
            let [first, second, third] = [1, 2, 3].map(|k| workspace.transfer(index, k)[2]);
            let squares = [
                (link.mass, [x.first, x.second, x.third]),
                (link.mass, [y.first, y.second, y.third]),
                (link.moment, [first, second, third]),
            ];
            for (m, [one, two, three]) in squares {
                reduced.inertia[0] += m * one * one;
                reduced.inertia[1] += 2.0 * m * one * two;
                if workspace.order() >= 3 {
                    reduced.inertia[2] += 2.0 * m * (two * two + one * three);
                }
            }
            for (g, axis) in gravity.iter().zip([x, y]) {
                let weight = link.mass * g;
                reduced.potential[0] -= weight * axis.value;
                reduced.potential[1] -= weight * axis.first;
                reduced.potential[2] -= weight * axis.second;
            }
        }
        for index in 0..self.spec().forces.len() {
            reduced.add(&self.force_part(index, workspace));
        }
        reduced
    }
}

impl Reduced {
    fn add(&mut self, part: &Part) {
        for k in 0..3 {
            self.potential[k] += part.potential[k];
        }
        for k in 0..2 {
            self.force[k] += part.force[k];
            self.damping[k] += part.damping[k];
        }
    }
}
