//! Is there a motion, and only one?

use super::{Group, Obstacle};
use crate::dynamics::system::frozen::Frozen;
use crate::dynamics::system::passes::{Extent, Work};

/// Distances from the acceleration found at which others are looked for, in parts of
/// its size: beyond the last, friction is in proportion to the acceleration.
const DISTANCES: [f64; 7] = [1e-3, 0.03, 0.3, 3.0, 30.0, 1e3, 1e8];

impl Frozen {
    /// Why the motion of a group has no solution, or not just one: the member and
    /// the reason.
    pub(super) fn unsolved(
        &self,
        group: &Group,
        time: f64,
        state: &[f64],
        modes: &[i64],
        work: &mut Work<f64>,
    ) -> Option<(usize, Obstacle)> {
        self.forces_without_friction(time, state, modes, work);
        self.add_friction(state, modes, Extent::Full, work);
        let link = self.link_force(group, state, work);
        let root = self.root_acceleration(group, link, work);
        let free = group.component.is_some();
        for (number, member) in group.members.iter().enumerate() {
            if let Some(failure) = work.rubbing[member.linkage].failure {
                return Some((number, failure));
            }
            if work.rubbing[member.linkage].force == 0.0 {
                continue;
            }
            let moving = self.moving(group, member, root, modes, work);
            self.friction(member, &moving, free, work);
            if let Some(failure) = work.rubbing[member.linkage].failure {
                return Some((number, failure));
            }
        }
        let together = free && group.members.len() > 1;
        let others = together && self.has_other_acceleration(group, link, root, modes, work);
        others.then_some((0, Obstacle::Several))
    }

    /// Whether several linkages of a group agree on another acceleration than the one
    /// found, `root`, although each of them by itself has no other.
    ///
    /// What an acceleration leaves over, M·A − Q − ΣT(A), has the sign of A − A* on
    /// both sides of the only solution A*; where it has the other sign, there is
    /// another root in between. An acceleration with which no friction agrees, or not
    /// just one, decides nothing.
    fn has_other_acceleration(
        &self,
        group: &Group,
        link: f64,
        root: f64,
        modes: &[i64],
        work: &mut Work<f64>,
    ) -> bool {
        let members = group.members.iter();
        let found: Vec<f64> = members
            .map(|member| work.rubbing[member.linkage].force)
            .collect();
        self.remove_friction(group, work);
        let without = self.root_acceleration(group, link, work);
        let size = root.abs() + without.abs();
        let mut differs = false;
        for distance in DISTANCES.iter().flat_map(|d| [-d, *d]) {
            if size == 0.0 {
                break;
            }
            let tried = root + distance * size;
            let left = self.left_over(group, [link, tried], modes, work);
            self.remove_friction(group, work);
            differs |= left.is_some_and(|left| left * distance < 0.0);
        }
        for (member, force) in group.members.iter().zip(found) {
            work.rubbing[member.linkage].force = force;
            work.rubbing[member.linkage].failure = None;
            self.push(member, force, work);
        }
        differs
    }

    /// Takes the friction of a group off all forces.
    fn remove_friction(&self, group: &Group, work: &mut Work<f64>) {
        for member in &group.members {
            let own = &mut work.rubbing[member.linkage].force;
            let force = std::mem::take(own);
            self.push(member, -force, work);
        }
    }

    /// By how much an acceleration of the root exceeds the one that it leads to;
    /// `None` where no friction agrees with it, or not just one.
    fn left_over(
        &self,
        group: &Group,
        [link, tried]: [f64; 2],
        modes: &[i64],
        work: &mut Work<f64>,
    ) -> Option<f64> {
        for member in group.members.iter().rev() {
            let mut moving = self.moving(group, member, tried, modes, work);
            // The acceleration is given, whatever friction does.
            moving.mobility = 0.0;
            let force = self.friction(member, &moving, true, work);
            if !force.is_finite() {
                return None;
            }
            work.rubbing[member.linkage].force = force;
            self.push(member, force, work);
        }
        Some(tried - self.root_acceleration(group, link, work))
    }
}
