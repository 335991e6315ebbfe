//! The values of all columns at a position, in the order of [`super::columns::headings`].

use super::request::KinematicsRequest;
use crate::kinematics::linkage::Workspace;
use crate::kinematics::linkage::spec::{PairKind, PairSpec, PointOf};
use crate::math::jet::Jet;

/// First transfer function, in parts of the second, at which something stands still, and sine
/// of the angle between them at which a path is straight.
const AT_REST: f64 = 1e-12;

/// Derivatives over time of something with these transfer functions.
pub(super) fn time_derivatives(along: Jet, q: Jet) -> [f64; 2] {
    [
        along.first * q.first,
        along.second * q.first * q.first + along.first * q.second,
    ]
}

/// All columns at the position in `work`, with the input's motion `q`.
pub(super) fn values(asked: &KinematicsRequest<'_>, work: &Workspace, q: Jet, out: &mut Vec<f64>) {
    let spec = asked.linkage.spec();
    out.clear();
    out.extend([q.value, q.first, q.second]);
    for (index, link) in spec.links.iter().enumerate() {
        let [first, second, third] = [1, 2, 3].map(|order| work.transfer(index, order)[2]);
        let angle = Jet {
            value: work.angle(index),
            first,
            second,
            third,
        };
        let [speed, acceleration] = time_derivatives(angle, q);
        out.extend([angle.value, speed, acceleration, first, second, third]);
        let pose = work.pose(index);
        out.extend(instant_centre([pose.x, pose.y], work.transfer(index, 1)));
        for point in &link.points {
            let at = PointOf {
                link: Some(index),
                at: point.at,
            };
            point_values(work.point(at), q, out);
        }
    }
    for (index, pair) in spec.pairs.iter().enumerate() {
        if matches!(pair.kind, PairKind::Sliding { .. }) {
            slide_values(asked, work, index, q, out);
        }
    }
    for index in 0..spec.outputs.len() {
        let along = asked.linkage.output(index, work);
        let [speed, acceleration] = time_derivatives(along, q);
        out.extend([along.value, speed, acceleration]);
        out.extend([along.first, along.second, along.third]);
    }
}

fn point_values([x, y]: [Jet; 2], q: Jet, out: &mut Vec<f64>) {
    let ([vx, ax], [vy, ay]) = (time_derivatives(x, q), time_derivatives(y, q));
    out.extend([x.value, y.value, vx, vy, vx.hypot(vy), ax, ay, ax.hypot(ay)]);
    out.extend([x.first, y.first, x.second, y.second, x.third, y.third]);
    along_path([x, y], q, out);
}

/// Acceleration of a point along and across its path, and the radius of that.
pub(super) fn along_path(point: [Jet; 2], q: Jet, out: &mut Vec<f64>) {
    let [along, across] = path_acceleration(point, q);
    out.extend([along, across, curvature_radius(point)]);
}

/// The point that a link turns about: its velocity is θ′ times the quarter turn of the
/// distance from there. Not a number where θ′ = 0.
pub(super) fn instant_centre(origin: [f64; 2], [x, y, turning]: [f64; 3]) -> [f64; 2] {
    [origin[0] - y / turning, origin[1] + x / turning].map(|place| match place.is_finite() {
        true => place,
        false => f64::NAN,
    })
}

/// Acceleration of a point along and across its path, which at a reversal is taken as
/// just after it.
fn path_acceleration([x, y]: [Jet; 2], q: Jet) -> [f64; 2] {
    let ([vx, ax], [vy, ay]) = (time_derivatives(x, q), time_derivatives(y, q));
    let sense = if q.first < 0.0 { -1.0 } else { 1.0 };
    let (tangent, bend) = ([x.first, y.first], [x.second, y.second]);
    let rest = AT_REST * bend[0].hypot(bend[1]);
    let [tx, ty] = match () {
        () if tangent[0].hypot(tangent[1]) <= rest => bend,
        () if vx != 0.0 || vy != 0.0 => [vx, vy],
        () => tangent.map(|t| sense * t),
    };
    let length = tx.hypot(ty);
    if length == 0.0 {
        // A point that does not move has no path.
        return [0.0; 2];
    }
    [(tx * ax + ty * ay) / length, (tx * ay - ty * ax) / length]
}

/// |r′|³/(r′ × r″); not a number where the path is straight or has a cusp.
fn curvature_radius([x, y]: [Jet; 2]) -> f64 {
    let speed = x.first.hypot(y.first);
    let bend = x.second.hypot(y.second);
    let cross = x.first * y.second - y.first * x.second;
    match cross.abs() > AT_REST * speed * bend && speed > AT_REST * bend {
        true => speed.powi(3) / cross,
        false => f64::NAN,
    }
}

/// The composition of a block's motion: with the guide (transport), along the
/// guide (relative), and Coriolis.
fn slide_values(
    asked: &KinematicsRequest<'_>,
    work: &Workspace,
    index: usize,
    q: Jet,
    out: &mut Vec<f64>,
) {
    let pair = &asked.linkage.spec().pairs[index];
    let PairKind::Sliding { direction, .. } = pair.kind else {
        return;
    };
    let along = work.pair(index);
    let [relative_speed, relative_acceleration] = time_derivatives(along, q);
    out.extend([along.value, relative_speed, relative_acceleration]);
    out.extend([along.first, along.second, along.third]);
    let guide = pair.on.link.map(|link| {
        let under = work.point(under_block(pair, direction, along.value));
        let turning = work.transfer(link, 1)[2] * q.first;
        (
            work.angle(link),
            turning,
            under.map(|x| time_derivatives(x, q)),
        )
    });
    transport(direction, relative_speed, guide, out);
}

/// The point of the guide that lies under the block now.
pub(super) fn under_block(pair: &PairSpec, direction: f64, along: f64) -> PointOf {
    PointOf {
        link: pair.on.link,
        at: [
            pair.on.at[0] + along * direction.cos(),
            pair.on.at[1] + along * direction.sin(),
        ],
    }
}

/// Angle and angular speed of a guide's link, and speed and acceleration of its point under
/// the block along x and y.
type Guide = (f64, f64, [[f64; 2]; 2]);

/// Direction of a guide in the plane, speed and acceleration of its point under the block
/// along and across it, Coriolis acceleration. `None`: the guide is fixed.
pub(super) fn transport(
    direction: f64,
    relative_speed: f64,
    guide: Option<Guide>,
    out: &mut Vec<f64>,
) {
    let (angle, turning, [[vx, ax], [vy, ay]]) = guide.unwrap_or_default();
    let angle = angle + direction;
    let (c, s) = (angle.cos(), angle.sin());
    out.push(angle);
    out.extend([c * vx + s * vy, c * vy - s * vx]);
    out.extend([c * ax + s * ay, c * ay - s * ax]);
    out.push(2.0 * turning * relative_speed);
}
