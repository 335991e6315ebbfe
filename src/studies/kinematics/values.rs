//! The values of all columns at a position, in the order of [`super::columns::headings`].

use super::ask::Asked;
use crate::kinematics::linkage::Workspace;
use crate::kinematics::linkage::spec::{PairKind, PointOf};
use crate::math::jet::Jet;

/// First transfer function, in parts of the second, at which something stands still, and sine
/// of the angle between them at which a path is straight.
const AT_REST: f64 = 1e-12;

/// Derivatives over time of something with these transfer functions.
fn moved(along: Jet, q: Jet) -> [f64; 2] {
    [
        along.first * q.first,
        along.second * q.first * q.first + along.first * q.second,
    ]
}

/// All columns at the position in `work`, with the input's motion `q`.
pub(super) fn values(asked: &Asked<'_>, work: &Workspace, q: Jet, out: &mut Vec<f64>) {
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
        let [speed, acceleration] = moved(angle, q);
        out.extend([angle.value, speed, acceleration, first, second, third]);
        out.extend(instant_centre(work, index));
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
        let [speed, acceleration] = moved(along, q);
        out.extend([along.value, speed, acceleration]);
        out.extend([along.first, along.second, along.third]);
    }
}

fn point_values([x, y]: [Jet; 2], q: Jet, out: &mut Vec<f64>) {
    let ([vx, ax], [vy, ay]) = (moved(x, q), moved(y, q));
    out.extend([x.value, y.value, vx, vy, vx.hypot(vy), ax, ay, ax.hypot(ay)]);
    out.extend([x.first, y.first, x.second, y.second, x.third, y.third]);
    let [along, across] = path_acceleration([x, y], q);
    out.extend([along, across, curvature_radius([x, y])]);
}

/// The point that a link turns about: its velocity is θ′ times the quarter turn of the
/// distance from there. Not a number where θ′ = 0.
fn instant_centre(work: &Workspace, link: usize) -> [f64; 2] {
    let pose = work.pose(link);
    let [x, y, turning] = work.transfer(link, 1);
    [pose.x - y / turning, pose.y + x / turning].map(|place| match place.is_finite() {
        true => place,
        false => f64::NAN,
    })
}

/// Acceleration of a point along and across its path, which at a reversal is taken as
/// just after it.
fn path_acceleration([x, y]: [Jet; 2], q: Jet) -> [f64; 2] {
    let ([vx, ax], [vy, ay]) = (moved(x, q), moved(y, q));
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
fn slide_values(asked: &Asked<'_>, work: &Workspace, index: usize, q: Jet, out: &mut Vec<f64>) {
    let pair = &asked.linkage.spec().pairs[index];
    let PairKind::Sliding { direction, .. } = pair.kind else {
        return;
    };
    let along = work.pair(index);
    let [relative_speed, relative_acceleration] = moved(along, q);
    out.extend([along.value, relative_speed, relative_acceleration]);
    out.extend([along.first, along.second, along.third]);
    let guide = match pair.on.link {
        Some(link) => Guide::moving(work, link, direction, q),
        None => Guide::fixed(direction),
    };
    // The point of the guide that lies under the block now.
    let under = PointOf {
        link: pair.on.link,
        at: [
            pair.on.at[0] + along.value * direction.cos(),
            pair.on.at[1] + along.value * direction.sin(),
        ],
    };
    let ([vx, ax], [vy, ay]) = match pair.on.link {
        Some(_) => {
            let [x, y] = work.point(under);
            (moved(x, q), moved(y, q))
        }
        None => ([0.0; 2], [0.0; 2]),
    };
    let (c, s) = (guide.angle.cos(), guide.angle.sin());
    out.push(guide.angle);
    out.extend([c * vx + s * vy, c * vy - s * vx]);
    out.extend([c * ax + s * ay, c * ay - s * ax]);
    out.push(2.0 * guide.speed * relative_speed);
}

/// Direction of a guide in the plane and its angular speed.
struct Guide {
    angle: f64,
    speed: f64,
}

impl Guide {
    fn moving(work: &Workspace, link: usize, direction: f64, q: Jet) -> Self {
        Self {
            angle: work.angle(link) + direction,
            speed: work.transfer(link, 1)[2] * q.first,
        }
    }

    fn fixed(direction: f64) -> Self {
        Self {
            angle: direction,
            speed: 0.0,
        }
    }
}
