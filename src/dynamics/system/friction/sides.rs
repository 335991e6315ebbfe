//! The sides on which pairs press, as modes: within them friction is smooth, and where
//! the normal force on a block's corner passes through zero, or the reaction of a pin
//! close by, the run is cut.
//!
//! Both are located from the state.

use super::{Group, Member, StickSlip};
use crate::dynamics::integrate::PhysicalStop;
use crate::dynamics::system::System;
use crate::dynamics::system::frozen::Frozen;
use crate::dynamics::system::passes::{Extent, Work};
use crate::kinematics::linkage::kinetostatics::{ForceWorkspace, Kinetostatics};

/// Mode of pairs whose sides are not known: they press as they turn out. Otherwise it
/// is one more than the bits that tell the sides.
const OPEN: i64 = 0;

impl Member {
    /// Sides on which its pairs press, as far as the modes tell.
    pub(super) fn pressed(&self, modes: &[i64]) -> Option<u64> {
        let mode = modes[self.sides?];
        (mode != OPEN).then_some((mode - 1) as u64)
    }
}

impl Group {
    /// True if it moves, with known directions.
    fn moves(&self, modes: &[i64]) -> bool {
        self.component
            .is_some_and(|component| StickSlip::of(modes[component]).slides())
    }

    /// Number of guides with friction.
    pub(in crate::dynamics::system) fn rubbing_guides(&self) -> f64 {
        let members = self.members.iter();
        members
            .map(|member| member.kinetostatics.rubbing_guides() as f64)
            .sum()
    }

    /// Components of the sides on which pairs press.
    fn side_components(&self) -> impl Iterator<Item = usize> + '_ {
        self.members.iter().filter_map(|member| member.sides)
    }

    /// The first of them, where they are to be watched.
    pub(super) fn pressing(&self, modes: &[i64]) -> Option<usize> {
        self.side_components().next().filter(|_| self.moves(modes))
    }

    /// True where some pairs press as they turn out.
    fn is_open(&self, modes: &[i64]) -> bool {
        self.side_components()
            .any(|component| modes[component] == OPEN)
    }
}

/// Puts sides into the modes of a group's linkages: what `bits` says of the forces
/// found last and the mode before.
fn write_sides(
    group: &Group,
    work: &Work<f64>,
    modes: &mut [i64],
    bits: impl Fn(&Kinetostatics, &ForceWorkspace, i64) -> u64,
) {
    for member in &group.members {
        let forces = work.rubbing[member.linkage].forces.as_ref();
        if let (Some(component), Some(forces)) = (member.sides, forces) {
            let sides = bits(&member.kinetostatics, forces, modes[component]);
            modes[component] = 1 + sides as i64;
        }
    }
}

impl Frozen {
    /// Positive where a pair of a group presses on another side than the modes say.
    pub(super) fn lifts(
        &self,
        group: &Group,
        time: f64,
        state: &[f64],
        modes: &[i64],
        work: &mut Work<f64>,
    ) -> f64 {
        if group.is_open(modes) {
            return 1.0;
        }
        self.forces_without_friction(time, state, modes, work);
        self.add_friction(state, modes, Extent::Full, work);
        let members = group.members.iter();
        let margins = members.filter_map(|member| {
            let forces = work.rubbing[member.linkage].forces.as_ref()?;
            member.sides?;
            Some(member.kinetostatics.side_margin(forces))
        });
        -margins.fold(f64::INFINITY, f64::min)
    }

    /// Lets all pairs press as they turn out, until they are looked at again.
    pub(in crate::dynamics::system) fn open_sides(&self, modes: &mut [i64]) {
        for component in self.groups.iter().flat_map(Group::side_components) {
            modes[component] = OPEN;
        }
    }

    /// Finds the sides on which all pairs press at a state; left open where that is
    /// not determined.
    pub(in crate::dynamics::system) fn settle_sides(
        &self,
        time: f64,
        y: &[f64],
        modes: &mut [i64],
    ) {
        if self
            .groups
            .iter()
            .all(|group| group.side_components().count() == 0)
        {
            return;
        }
        self.open_sides(modes);
        let mut work = Work::new(self);
        self.forces_without_friction(time, y, modes, &mut work);
        self.add_friction(y, modes, Extent::Full, &mut work);
        for group in &self.groups {
            let failed = |member: &Member| work.rubbing[member.linkage].failure.is_some();
            if group.moves(modes) && !group.members.iter().any(failed) {
                write_sides(group, &work, modes, |kinetostatics, forces, _| {
                    kinetostatics.pressed_sides(forces)
                });
            }
        }
    }
}

impl System {
    /// Pairs of a group have begun to press on another side.
    pub(super) fn change_sides(
        &self,
        index: usize,
        time: f64,
        y: &[f64],
        modes: &mut [i64],
    ) -> Result<(), PhysicalStop> {
        let frozen = &self.frozen;
        let group = &frozen.groups[index];
        let before = modes.to_vec();
        frozen.settle_sides(time, y, modes);
        let mut work = Work::new(frozen);
        if *modes == *before && !group.is_open(modes) {
            // By rounding they press as before: those that do not are turned round.
            frozen.lifts(group, time, y, modes, &mut work);
            write_sides(group, &work, modes, |kinetostatics, forces, mode| {
                (mode - 1) as u64 ^ kinetostatics.lifted_corners(forces)
            });
        }
        // Beyond the kink the force goes on as it came: there is no such motion.
        if frozen.lifts(group, time, y, modes, &mut work) > 0.0 {
            return Err(self.without_solution(index, time, y, modes));
        }
        Ok(())
    }
}
