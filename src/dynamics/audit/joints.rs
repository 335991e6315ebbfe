//! Laws at the places where one formula follows another, and the end of a run.

use super::judge::Judge;
use super::sampler::DrawnInstants;
use crate::dynamics::model::{Node, NodeMotion};
use crate::kinematics::breaks::Breaks;
use crate::units::shown;

/// Most places of a law that are looked at.
const PLACES: i64 = 64;

/// Jump that is allowed, as a share of the greatest displacement.
const JUMP: f64 = 1e-6;

/// Share of the time by which a run may end late: rounding.
const LATE: f64 = 1e-12;

impl Judge<'_> {
    /// Displacements are continuous where one formula of a law follows another.
    pub(super) fn judge_joints(&mut self) {
        let model = self.system.model();
        for (index, node) in model.nodes.iter().enumerate() {
            let Some(jump) = jump_of(node).filter(|jump| jump.height != 0.0) else {
                continue;
            };
            // (Of a node that was not seen to move, the run tells no size.)
            if self.scales.motion[index][0] == 0.0 && !jump.height.is_nan() {
                continue;
            }
            let greatest = self.scales.motion[index][0].max(jump.size);
            let at = shown(jump.place, 7);
            let name = format!("{} (where its law is at {at})", self.names[index]);
            let what = "displacement at a joint of the law";
            (self.found).include(jump.height / greatest, JUMP, (0.0, &name), what);
        }
    }

    /// A run ends when it was asked to, not later.
    pub(super) fn judge_end(&mut self, looks: &DrawnInstants) {
        let [reached, duration] = looks.end;
        if duration > 0.0 && reached > duration {
            let late = (reached - duration) / duration;
            (self.found).include(late, LATE, (reached, "the run"), "end");
        }
    }
}

/// A jump of a law between two of its formulas.
struct Jump {
    /// On the axis of the law.
    place: f64,
    height: f64,
    /// The greatest displacement on either side.
    size: f64,
}

/// The greatest jump of the displacement of a node between the formulas of its own law.
fn jump_of(node: &Node) -> Option<Jump> {
    match &node.motion {
        NodeMotion::Prescribed { motion, .. } => {
            let value = |segment: i64, time: f64| motion.jet(segment, time).value;
            greatest_jump(&motion.breaks(), &value)
        }
        NodeMotion::Mass { law } | NodeMotion::Rigid { law } => {
            let position = &law.position;
            let value = |segment: i64, phi: f64| law.lever * position.jet(segment, phi).value;
            greatest_jump(&position.breaks(), &value)
        }
        NodeMotion::Rotor { .. } | NodeMotion::Constrained { .. } => None,
    }
}

fn greatest_jump(breaks: &Breaks, value: &dyn Fn(i64, f64) -> f64) -> Option<Jump> {
    let count = (breaks.points.len() as i64).min(PLACES);
    let jumps = (0..count).map(|segment| {
        let (_, place) = breaks.edges(segment);
        let (before, after) = (value(segment, place), value(segment + 1, place));
        Jump {
            place,
            height: (after - before).abs(),
            size: before.abs().max(after.abs()),
        }
    });
    // (What is not a number is greater than any.)
    jumps.max_by(|one, other| one.height.total_cmp(&other.height))
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn the_greatest_jump_is_found_and_what_is_no_number_is_greater() {
        let breaks = Breaks {
            points: vec![1.0, 2.0, 3.0],
            ..Breaks::default()
        };
        let steps = |segment: i64, _: f64| [0.0, 1e-3, 1e-3, 0.5][segment as usize];
        let jump = greatest_jump(&breaks, &steps).unwrap();
        assert_eq!([jump.place, jump.height, jump.size], [3.0, 0.499, 0.5]);
        let none = |segment: i64, _: f64| [0.0, f64::NAN, 1e-3, 0.5][segment as usize];
        assert!(greatest_jump(&breaks, &none).unwrap().height.is_nan());
    }
}
