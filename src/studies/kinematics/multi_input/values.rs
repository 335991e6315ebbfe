//! The columns of a linkage of several inputs and their values, in one order: inputs, links,
//! their named points, sliding pairs, outputs; transfer functions by every input, the columns
//! of the Jacobian.

use super::super::values::{along_path, instant_centre, time_derivatives, transport, under_block};
use super::request::AskedSeveral;
use crate::kinematics::linkage::multi::MultiMotion;
use crate::kinematics::linkage::spec::{OutputKind, PairKind, PointOf};
use crate::math::jet::Jet;

/// Time in place of the input coordinate: what goes by as it does.
const TIME: Jet = Jet {
    value: 0.0,
    first: 1.0,
    second: 0.0,
    third: 0.0,
};

/// All columns at the instant of a motion.
pub(super) fn values(asked: &AskedSeveral<'_>, motion: &MultiMotion, out: &mut Vec<f64>) {
    let spec = &asked.linkage.spec().linkage;
    let inputs = 0..asked.inputs.len();
    let mut first = vec![0.0; inputs.len()];
    out.clear();
    for input in motion.inputs() {
        out.extend([input.value, input.first, input.second]);
    }
    for (index, link) in spec.links.iter().enumerate() {
        let angle = motion.angle(index);
        out.extend([angle.value, angle.first, angle.second]);
        let pose = motion.pose(index);
        let [x, y] = motion.point(of_link(index, [0.0; 2]));
        out.extend(instant_centre(
            [pose.x, pose.y],
            [x.first, y.first, angle.first],
        ));
        out.extend(
            inputs
                .clone()
                .map(|input| motion.angle_transfer(index, input)),
        );
        for point in &link.points {
            let at = of_link(index, point.at);
            point_values(motion.point(at), out);
            for input in inputs.clone() {
                out.extend(motion.point_transfer(at, input));
            }
        }
    }
    for (index, pair) in spec.pairs.iter().enumerate() {
        let PairKind::Sliding { direction, .. } = pair.kind else {
            continue;
        };
        let along = motion.pair(index);
        out.extend([along.value, along.first, along.second]);
        let guide = pair.on.link.map(|link| {
            let under = motion.point(under_block(pair, direction, along.value));
            let angle = motion.angle(link);
            (
                angle.value,
                angle.first,
                under.map(|x| time_derivatives(x, TIME)),
            )
        });
        transport(direction, along.first, guide, out);
        motion.output_transfer(&OutputKind::Pair { pair: index }, &mut first);
        out.extend(&first);
    }
    for output in &spec.outputs {
        let along = motion.output(&output.kind);
        out.extend([along.value, along.first, along.second]);
        motion.output_transfer(&output.kind, &mut first);
        out.extend(&first);
    }
}

fn of_link(link: usize, at: [f64; 2]) -> PointOf {
    PointOf {
        link: Some(link),
        at,
    }
}

fn point_values([x, y]: [Jet; 2], out: &mut Vec<f64>) {
    let ([vx, ax], [vy, ay]) = (time_derivatives(x, TIME), time_derivatives(y, TIME));
    out.extend([x.value, y.value, vx, vy, vx.hypot(vy), ax, ay, ax.hypot(ay)]);
    along_path([x, y], TIME, out);
}
