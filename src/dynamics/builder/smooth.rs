//! Laws whose motion is known beforehand, with a continuous acceleration.

use crate::dynamics::model::{Law, Model, NodeMotion};
use crate::kinematics::breaks::Breaks;
use crate::math::jet::Jet;

/// Jumps of a derivative below this share of what it is nearby are rounding.
const JUMP: f64 = 1e-6;

/// True when what a law asks for is known beforehand, with a continuous acceleration:
/// rigid objects behind a prescribed drive.
pub(super) fn is_smooth(model: &Model, law: &Law) -> bool {
    let own = |segment, x| law.position.jet(segment, x);
    smooth(&law.position.breaks(), own)
        && match &model.nodes[law.driver].motion {
            NodeMotion::Prescribed { motion, .. } => {
                smooth(&motion.breaks(), |segment, time| motion.jet(segment, time))
            }
            NodeMotion::Rigid { law } => is_smooth(model, law),
            NodeMotion::Mass { .. } | NodeMotion::Rotor { .. } | NodeMotion::Constrained { .. } => {
                false
            }
        }
}

/// True when the second derivative is continuous where the formula changes.
fn smooth(breaks: &Breaks, jet: impl Fn(i64, f64) -> Jet) -> bool {
    let continuous = |&x: &f64| {
        let [before, after] = [-1.0, 1.0].map(|sense| jet(breaks.segment_at(x, sense), x));
        // What is small is small beside what the segments have within.
        let mut scale = [0.0f64; 2];
        for segment in [-1.0, 1.0].map(|sense| breaks.segment_at(x, sense)) {
            let (from, to) = breaks.edges(segment);
            for share in [0.2, 0.4, 0.6, 0.8] {
                let within = from + share * (to - from);
                let within = jet(segment, if within.is_finite() { within } else { x });
                scale[0] = scale[0].max(within.first.abs());
                scale[1] = scale[1].max(within.second.abs());
            }
        }
        let [slope, bend] = scale.map(|scale| JUMP * scale);
        (after.first - before.first).abs() <= slope && (after.second - before.second).abs() <= bend
    };
    breaks.points.iter().all(continuous)
}
