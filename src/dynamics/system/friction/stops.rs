//! Named ends of runs whose motion friction does not allow or does not determine.

use super::Obstacle;
use crate::dynamics::integrate::PhysicalStop;
use crate::dynamics::system::System;
use crate::dynamics::system::passes::Work;
use crate::kinematics::linkage::kinetostatics::ForceFailure;
use crate::units::shown;

/// How far beyond a state the reason of a stop is looked for, in parts of the time.
const AHEAD: [f64; 5] = [0.0, 1e-15, 1e-14, 1e-12, 1e-9];
/// No acceleration agrees with its friction.
pub(super) const LOCKED: Obstacle = Obstacle::Failed(ForceFailure::SelfLocking {
    change: f64::NAN,
    iterations: 0,
});

impl System {
    /// A group at rest that may start in either direction.
    pub(super) fn ambiguous_direction(&self, index: usize, time: f64) -> PhysicalStop {
        let id = self.member_id(index, 0);
        PhysicalStop {
            name: "several_solutions",
            message: format!(
                "{id} is at rest at t = {} s and may start in either direction: with the friction \
                 of its joints the motion is not determined",
                shown(time, 9)
            ),
            object: id,
        }
    }

    /// The end of a run whose motion has no solution or several, at a state or just
    /// beyond it.
    pub(super) fn without_solution(
        &self,
        index: usize,
        time: f64,
        y: &[f64],
        modes: &[i64],
    ) -> PhysicalStop {
        let mut work = Work::new(&self.frozen);
        let group = &self.frozen.groups[index];
        let (u, v) = y.split_at(self.frozen.coordinates);
        let found = AHEAD.iter().find_map(|ahead| {
            let ahead = ahead * time;
            let moved = u.iter().zip(v).map(|(u, v)| u + ahead * v);
            let state: Vec<f64> = moved.chain(v.iter().copied()).collect();
            self.frozen
                .unsolved(group, time + ahead, &state, modes, &mut work)
        });
        // Found by following the motion itself: friction goes on as it came beyond a
        // kink, where the other side of it does not lead on.
        let (member, failure) = found.unwrap_or((0, LOCKED));
        self.friction_stop(index, member, failure)
    }

    fn member_id(&self, index: usize, member: usize) -> String {
        let object = self.frozen.groups[index].members[member].object;
        self.model.objects[object].id.clone()
    }

    pub(super) fn friction_stop(
        &self,
        index: usize,
        member: usize,
        failure: Obstacle,
    ) -> PhysicalStop {
        let given = self.frozen.groups[index].coordinate.is_none();
        stop_for(self.member_id(index, member), given, failure)
    }

    /// Why the last evaluation gave no numbers, where friction is the reason.
    pub(in crate::dynamics::system) fn friction_obstacle(
        &self,
        work: &Work<f64>,
    ) -> Option<PhysicalStop> {
        for (index, group) in self.frozen.groups.iter().enumerate() {
            for (number, member) in group.members.iter().enumerate() {
                if let Some(failure) = named_obstacle(work.rubbing[member.linkage].failure) {
                    return Some(self.friction_stop(index, number, failure));
                }
            }
        }
        self.multi_input_obstacle(work)
    }
}

/// The end of a run whose motion friction does not allow or does not determine; `given`: the
/// motion is prescribed.
pub(super) fn stop_for(object: String, given: bool, failure: Obstacle) -> PhysicalStop {
    let (name, message) = match failure {
        Obstacle::Several => (
            "several_solutions",
            format!(
                "the motion of {object} is not determined: several accelerations agree with \
                 the friction that they cause in its joints (Painlevé)"
            ),
        ),
        Obstacle::Unproved => (
            "several_solutions",
            format!(
                "the motion of {object} is not determined: its joints are near self-locking, \
                 where one acceleration was found and others are not excluded (Painlevé)"
            ),
        ),
        Obstacle::Failed(ForceFailure::DeadPosition { .. }) => (
            "self_locking",
            format!("{object} locks: the equations of its motion are singular here"),
        ),
        _ if given => (
            "self_locking",
            format!("{object} locks: no force of its drive overcomes the friction of its joints"),
        ),
        _ => (
            "self_locking",
            format!(
                "{object} locks: no acceleration agrees with the friction that it causes in \
                 its joints"
            ),
        ),
    };
    PhysicalStop {
        name,
        object,
        message,
    }
}

/// An obstacle that ends a run by name: numbers that are not finite have other reasons.
pub(super) fn named_obstacle(failure: Option<Obstacle>) -> Option<Obstacle> {
    failure.filter(|failure| *failure != Obstacle::Failed(ForceFailure::NotFinite))
}
