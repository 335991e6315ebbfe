//! Laws at the places where one formula follows another, and the end of a run.

use super::judge::Judge;
use super::look::Looks;
use crate::dynamics::model::{Node, NodeMotion};
use crate::kinematics::breaks::Breaks;

/// Most places of a law that are looked at.
const PLACES: i64 = 64;

/// Jump that is allowed, as a share of the greatest displacement.
const JUMP: f64 = 1e-8;

/// Share of the time by which a run may end late: rounding.
const LATE: f64 = 1e-12;

impl Judge<'_> {
    /// Displacements are continuous where one formula of a law follows another.
    pub(super) fn judge_joints(&mut self) {
        let model = self.system.model();
        for (index, node) in model.nodes.iter().enumerate() {
            let jump = jump_of(node);
            let Some((place, jump)) = jump.filter(|&(_, jump)| jump > 0.0) else {
                continue;
            };
            let greatest = self.scales.motion[index][0].max(f64::MIN_POSITIVE);
            let place = (place, &*self.names[index]);
            (self.found).see(
                jump / greatest,
                JUMP,
                place,
                "displacement at a joint of the law",
            );
        }
    }

    /// A run ends when it was asked to, not later.
    pub(super) fn judge_end(&mut self, looks: &Looks) {
        let [reached, duration] = looks.end;
        if duration > 0.0 && reached > duration {
            let late = (reached - duration) / duration;
            (self.found).see(late, LATE, (reached, "the run"), "end");
        }
    }
}

/// The greatest jump of the displacement of a node between the formulas of its own law, and
/// where it is: on the axis of the law.
fn jump_of(node: &Node) -> Option<(f64, f64)> {
    match &node.motion {
        NodeMotion::Prescribed { motion, .. } => {
            greatest_jump(&motion.breaks(), &|segment, time| {
                motion.jet(segment, time).value
            })
        }
        NodeMotion::Mass { law } | NodeMotion::Rigid { law } => {
            let position = &law.position;
            let value = |segment: i64, phi: f64| law.lever * position.jet(segment, phi).value;
            greatest_jump(&position.breaks(), &value)
        }
        NodeMotion::Rotor { .. } | NodeMotion::Constrained { .. } => None,
    }
}

fn greatest_jump(breaks: &Breaks, value: &dyn Fn(i64, f64) -> f64) -> Option<(f64, f64)> {
    let count = (breaks.points.len() as i64).min(PLACES);
    let jumps = (0..count).map(|segment| {
        let (_, place) = breaks.edges(segment);
        (
            place,
            (value(segment + 1, place) - value(segment, place)).abs(),
        )
    });
    // (A jump that is no number stays the greatest.)
    jumps.reduce(|one, other| if one.1 >= other.1 { one } else { other })
}
