//! The columns of a linkage of several inputs and their values, in one order: inputs, links,
//! their named points, sliding pairs, outputs; transfer functions by every input, the columns
//! of the Jacobian.

use super::super::Quantity;
use super::super::columns::{CENTRE, Heading, OUTPUT, SLIDE, heading, unit_of};
use super::super::values::{along_path, instant_centre, time_derivatives, transport, under_block};
use super::request::AskedSeveral;
use crate::kinematics::linkage::multi::MultiMotion;
use crate::kinematics::linkage::spec::{OutputKind, PairKind, PointOf};
use crate::math::jet::Jet;

const LINK: [Quantity; 3] = [
    Quantity::Angle,
    Quantity::AngularSpeed,
    Quantity::AngularAcceleration,
];
const POINT: [Quantity; 11] = [
    Quantity::X,
    Quantity::Y,
    Quantity::SpeedX,
    Quantity::SpeedY,
    Quantity::SpeedSize,
    Quantity::AccelerationX,
    Quantity::AccelerationY,
    Quantity::AccelerationSize,
    Quantity::AccelerationAlong,
    Quantity::AccelerationAcross,
    Quantity::CurvatureRadius,
];

/// Time in place of the input coordinate: what goes by as it does.
const TIME: Jet = Jet {
    value: 0.0,
    first: 1.0,
    second: 0.0,
    third: 0.0,
};

/// The columns.
pub(super) fn headings(asked: &AskedSeveral<'_>) -> Vec<Heading> {
    let spec = &asked.linkage.spec().linkage;
    let mut out = Vec::new();
    let by_all = |out: &mut Vec<Heading>, owner: &str, quantities: &[Quantity], own: &str| {
        for (input, coordinate) in asked.inputs.iter().enumerate() {
            for &quantity in quantities {
                out.push(Heading {
                    by: Some(asked.name(input).to_owned()),
                    ..heading(owner, quantity, own, unit_of(*coordinate))
                });
            }
        }
    };
    for (input, coordinate) in asked.inputs.iter().enumerate() {
        let unit = unit_of(*coordinate);
        out.extend(
            OUTPUT[..3]
                .iter()
                .map(|&what| heading(asked.name(input), what, unit, unit)),
        );
    }
    for link in &spec.links {
        let name = format!("links.{}", link.name);
        out.extend(LINK.map(|what| heading(&name, what, "rad", "")));
        out.extend(CENTRE.map(|what| heading(&name, what, "m", "")));
        by_all(&mut out, &name, &[Quantity::First], "rad");
        for point in &link.points {
            let owner = format!("{name}.{}", point.name);
            out.extend(POINT.map(|what| heading(&owner, what, "m", "")));
            by_all(&mut out, &owner, &[Quantity::FirstX, Quantity::FirstY], "m");
        }
    }
    for pair in &spec.pairs {
        if matches!(pair.kind, PairKind::Sliding { .. }) {
            let name = format!("pairs.{}", pair.name);
            out.extend(SLIDE[..3].iter().map(|&what| heading(&name, what, "m", "")));
            out.extend(SLIDE[6..].iter().map(|&what| {
                let own = if what == Quantity::GuideDirection {
                    "rad"
                } else {
                    "m"
                };
                heading(&name, what, own, "")
            }));
            by_all(&mut out, &name, &[Quantity::First], "m");
        }
    }
    for (output, coordinate) in spec.outputs.iter().zip(&asked.outputs) {
        let unit = unit_of(*coordinate);
        out.extend(
            OUTPUT[..3]
                .iter()
                .map(|&what| heading(&output.name, what, unit, "")),
        );
        by_all(&mut out, &output.name, &[Quantity::First], unit);
    }
    out
}

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
