//! Where follower and cam touch: positions, normals, curvature.
//!
//! Worked out in a frame that stands still, for a cam that turns
//! counter-clockwise: the axis is the origin; a translating follower moves
//! outwards along +y, a turning one has its axis at (a, 0). In the cam's own
//! frame the reference curve is C(φ) = R(−φ)·B(φ), so that with J the turn by
//! 90° and primes for derivatives by φ
//!
//! C′ → v = B′ − J·B,  C″ → w = B″ − 2J·B′ − B  (both in the standing frame),
//!
//! κ = −(v × w)/|v|³, positive where the curve is convex, and n = J·v/|v|
//! pointing away from the axis. For a roller the reference curve is the pitch
//! curve of its centre B; for a flat face the envelope of the face's lines
//! with distance p(φ) from the axis: radius of curvature p + d²p/dθ² over the
//! normal's angle θ in the cam.

use super::spec::{CamGeometry, Contact, Guide};
use crate::math::number::{Number, sqrt};

/// A vector of the plane.
pub(crate) type Vector<N> = [N; 2];

/// Follower and cam at one angle, in the standing frame of a cam that turns
/// counter-clockwise.
#[derive(Clone, Copy, Debug)]
pub(crate) struct Touch<N> {
    /// Centre of the roller, or the point where a flat face touches.
    pub(crate) point: Vector<N>,
    /// Normal of the cam there, away from its axis.
    pub(crate) normal: Vector<N>,
    /// Tangent of the pressure angle, positive where the cam pushes the
    /// follower to the side of its own motion.
    pub(crate) pressure: N,
    /// Rate by φ of the reference curve's length (roller), of the normal's angle
    /// in the cam (flat face).
    pub(crate) rate: N,
    /// Curvature of the pitch curve (roller), radius of curvature of the
    /// profile (flat face); positive where convex.
    pub(crate) bend: N,
    /// Lever of the contact force: displacement along the normal by outward
    /// displacement of the follower.
    pub(crate) lever: N,
    /// Place of the contact on a flat face: from the follower's line of motion
    /// or axis; 0 of a roller.
    pub(crate) face: N,
}

/// The follower's place when it is innermost: distance along its line
/// (translating) or angle between the arm and the line of centres (turning).
///
/// `None` when it cannot reach that circle.
pub(crate) fn start(geometry: &CamGeometry) -> Option<f64> {
    let prime = geometry.prime_radius();
    match (geometry.guide, geometry.contact) {
        (Guide::Translating { .. }, Contact::Flat { .. }) => Some(prime),
        (Guide::Translating { offset }, _) => {
            let square = (prime - offset.abs()) * (prime + offset.abs());
            (prime > 0.0 && square > 0.0).then(|| square.sqrt())
        }
        (
            Guide::Turning {
                centre_distance, ..
            },
            Contact::Flat { face_offset, .. },
        ) => {
            let sine = (prime + face_offset) / centre_distance;
            (sine > 0.0 && sine < 1.0).then(|| sine.asin())
        }
        (
            Guide::Turning {
                centre_distance,
                arm,
                ..
            },
            _,
        ) => {
            let (a, l) = (centre_distance, arm);
            // Half-angle form: cos ψ = (a² + l² − r²)/(2al) loses digits near 0 and π.
            let square =
                (prime - (a - l)) * (prime + (a - l)) / (((a + l) - prime) * ((a + l) + prime));
            (prime > 0.0 && square > 0.0 && square.is_finite()).then(|| 2.0 * square.sqrt().atan())
        }
    }
}

/// Follower and cam for outward displacement s, s′, s″ from the place `start`.
pub(crate) fn touch<N: Number>(geometry: &CamGeometry, start: f64, s: [N; 3]) -> Touch<N> {
    match (geometry.guide, geometry.contact) {
        (Guide::Translating { offset }, Contact::Flat { inclination, .. }) => {
            flat_translating(start, s, offset, inclination)
        }
        (Guide::Translating { offset }, _) => {
            let zero = N::from(0.0);
            let [y, first, second] = [N::from(start) + s[0], s[1], s[2]];
            let motion = [[N::from(offset), y], [zero, first], [zero, second]];
            round(motion, [zero, N::from(1.0)], 1.0)
        }
        (
            Guide::Turning {
                centre_distance,
                against,
                ..
            },
            Contact::Flat { face_offset, .. },
        ) => flat_turning(start, s, [centre_distance, face_offset, against]),
        (
            Guide::Turning {
                centre_distance,
                arm,
                against,
            },
            _,
        ) => round_turning(start, s, [centre_distance, arm, against]),
    }
}

fn round_turning<N: Number>(start: f64, s: [N; 3], [distance, arm, against]: [f64; 3]) -> Touch<N> {
    let (along, outward) = arm_directions(N::from(start) + s[0], against);
    let centre = [N::from(distance) + along[0].scale(arm), along[1].scale(arm)];
    let first = times(outward, s[1].scale(arm));
    let second = plus(
        times(outward, s[2].scale(arm)),
        times(along, -(s[1] * s[1]).scale(arm)),
    );
    round([centre, first, second], outward, arm)
}

/// Direction from the follower's axis along its arm, and outwards across it,
/// at the angle ψ between the arm and the line of centres.
fn arm_directions<N: Number>(psi: N, against: f64) -> (Vector<N>, Vector<N>) {
    let (sin, cos) = sin_cos(psi);
    ([-cos, sin.scale(against)], [sin, cos.scale(against)])
}

/// A roller or edge with its centre's B, B′, B″, moving along `outward`.
fn round<N: Number>(motion: [Vector<N>; 3], outward: Vector<N>, arm: f64) -> Touch<N> {
    let [centre, first, second] = motion;
    let v = minus(first, rotated_quarter_turn(centre));
    let w = minus(
        minus(second, times(rotated_quarter_turn(first), N::from(2.0))),
        centre,
    );
    let rate = sqrt(dot(v, v));
    let normal = times(rotated_quarter_turn(v), N::from(1.0) / rate);
    let across = dot(normal, outward);
    Touch {
        point: centre,
        normal,
        pressure: dot(v, outward) / (rate * across),
        rate,
        bend: -cross(v, w) / (rate * rate * rate),
        lever: across.scale(arm),
        face: N::from(0.0),
    }
}

fn flat_translating<N: Number>(start: f64, s: [N; 3], offset: f64, inclination: f64) -> Touch<N> {
    let (sin, cos) = inclination.sin_cos();
    let normal = [N::from(-sin), N::from(cos)];
    let (p, first) = (N::from(start) + s[0].scale(cos), s[1].scale(cos));
    // Along the face, to the side on which the cam's surface moves outwards.
    let along = [N::from(cos), N::from(sin)];
    let axis = (N::from(offset) + p.scale(sin)).scale(1.0 / cos);
    let radius = p + s[2].scale(cos);
    Touch {
        point: plus(times(normal, p), times(along, first)),
        normal,
        pressure: N::from(sin / cos),
        rate: N::from(1.0),
        bend: radius,
        lever: N::from(cos),
        face: first - axis,
    }
}

fn flat_turning<N: Number>(
    start: f64,
    s: [N; 3],
    [distance, face_offset, against]: [f64; 3],
) -> Touch<N> {
    let psi = N::from(start) + s[0];
    let (sin, cos) = sin_cos(psi);
    let (along, normal) = arm_directions(psi, against);
    let p = sin.scale(distance) - N::from(face_offset);
    let first = (cos * s[1]).scale(distance);
    let second = (cos * s[2] - sin * s[1] * s[1]).scale(distance);
    // The normal turns in the cam by −k a radian of its turn.
    let k = N::from(1.0) + s[1].scale(against);
    let bend = p + (second * k - first * s[2].scale(against)) / (k * k * k);
    let face = cos.scale(distance) / k;
    let across = (first / k).scale(-against);
    Touch {
        point: plus(times(normal, p), times(along, across)),
        normal,
        pressure: N::from(-against * face_offset) / face,
        rate: k,
        bend,
        lever: face,
        face,
    }
}

/// Where the normal of a turning flat face stands still in the cam, no profile
/// exists: 1 ± s′, which must stay positive.
pub(crate) fn turning_of_normal<N: Number>(geometry: &CamGeometry, s: [N; 3]) -> Option<N> {
    match (geometry.guide, geometry.contact) {
        (Guide::Turning { against, .. }, Contact::Flat { .. }) => {
            Some(N::from(1.0) + s[1].scale(against))
        }
        _ => None,
    }
}

pub(crate) fn plus<N: Number>(a: Vector<N>, b: Vector<N>) -> Vector<N> {
    [a[0] + b[0], a[1] + b[1]]
}

pub(crate) fn minus<N: Number>(a: Vector<N>, b: Vector<N>) -> Vector<N> {
    [a[0] - b[0], a[1] - b[1]]
}

pub(crate) fn times<N: Number>(a: Vector<N>, factor: N) -> Vector<N> {
    [a[0] * factor, a[1] * factor]
}

/// Turned by 90° counter-clockwise.
pub(crate) fn rotated_quarter_turn<N: Number>(a: Vector<N>) -> Vector<N> {
    [-a[1], a[0]]
}

pub(crate) fn dot<N: Number>(a: Vector<N>, b: Vector<N>) -> N {
    a[0] * b[0] + a[1] * b[1]
}

pub(crate) fn cross<N: Number>(a: Vector<N>, b: Vector<N>) -> N {
    a[0] * b[1] - a[1] * b[0]
}

/// A vector turned by an angle, counter-clockwise.
pub(crate) fn rotated(a: [f64; 2], angle: f64) -> [f64; 2] {
    let (sin, cos) = angle.sin_cos();
    [a[0] * cos - a[1] * sin, a[0] * sin + a[1] * cos]
}

fn sin_cos<N: Number>(x: N) -> (N, N) {
    let (sin, cos) = x.value().sin_cos();
    (x.compose(sin, cos), x.compose(cos, -sin))
}
