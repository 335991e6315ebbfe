//! Velocities of cams inside larger groups.
//!
//! The roller's centre P stays on the pitch curve: its velocity against the cam has no part along
//! the normal n of the curve that goes through P ([`PitchCurve::gradient_over`]). As a line n through
//! P, w = (P × n, n), it is w·(t₂ − t₁) = 0 with the velocities of roller and cam; accelerations
//! follow w·(a₂ − a₁) + ẇ·(t₂ − t₁) = 0. The derivatives of w in time are the coefficients of the
//! same formula over power series in time.
//!
//! The line w moves along the pitch curve with the roller. So the curvature counts in the
//! accelerations, and R‴ in the second derivative of the matrix.

use super::twist::{Motion, Parts, PartsMoved, Pose, Twist, at, dot, minus};
use crate::kinematics::linkage::couplings::PitchCurve;
use crate::kinematics::linkage::spec::CamPairSpec;
use crate::math::number::Number;
use crate::math::series::Series;

/// A cam made ready.
#[derive(Clone, Debug)]
pub(super) struct Rolling {
    /// The bodies of the cam and of the roller.
    pub(super) bodies: [usize; 2],
    /// The points about which the pitch curve is polar and of the roller's centre (m).
    points: [[f64; 2]; 2],
    curve: PitchCurve,
}

/// A vector over time.
type Path<const K: usize, N> = [Series<K, N>; 2];

/// A body's pose with its velocity and acceleration.
type Moving<N> = (Pose<N>, Twist<N>, Twist<N>);

impl Rolling {
    /// Of a cam that has been checked; `ground`: index of the ground.
    pub(super) fn new(links: [Option<usize>; 2], cam: &CamPairSpec, ground: usize) -> Option<Self> {
        Some(Self {
            bodies: links.map(|link| link.unwrap_or(ground)),
            points: [cam.centre, cam.roller],
            curve: PitchCurve::new(cam).ok()?,
        })
    }

    /// Its equation at a position.
    pub(super) fn parts<N: Number>(&self, poses: &[Pose<N>], size: f64) -> Parts<N> {
        let none = [N::from(0.0); 3];
        let line = self.line::<1, N>(self.bodies.map(|body| (poses[body], none, none)), size);
        self.of_both(line.map(|part| part.0[0]))
    }

    /// ẇ·(t₂ − t₁), the bodies having these velocities; over the size.
    pub(super) fn drift<N: Number>(
        &self,
        poses: &[Pose<N>],
        velocity: &[Twist<N>],
        size: f64,
    ) -> N {
        let none = [N::from(0.0); 3];
        let both = self.bodies.map(|body| (poses[body], velocity[body], none));
        let [moment, x, y] = self.line::<2, N>(both, size).map(|part| part.0[1]);
        let [cam, roller] = self.bodies.map(|body| velocity[body]);
        let [turning, u, v] = minus(roller, cam);
        dot(
            &[moment, x, y],
            &[turning, u.scale(size.recip()), v.scale(size.recip())],
        )
    }

    /// First and second derivative in time of [`Self::parts`], the bodies moving so.
    pub(super) fn parts_moved(
        &self,
        poses: &[Pose<f64>],
        motion: Motion<'_>,
        size: f64,
    ) -> PartsMoved {
        let both = self.bodies.map(|body| {
            let (velocity, acceleration) = motion(body);
            (poses[body], velocity, acceleration)
        });
        let line = self.line::<3, f64>(both, size);
        let signed = |sign: f64| line.map(|part| [sign * part.0[1], 2.0 * sign * part.0[2]]);
        let [cam, roller] = self.bodies;
        [
            (cam, signed(-1.0)),
            (roller, signed(1.0)),
            (cam, [[0.0; 2]; 3]),
        ]
    }

    /// A line as it acts on the roller, and against that on the cam, which is its own carrier.
    fn of_both<N: Number>(&self, line: Twist<N>) -> Parts<N> {
        let [cam, roller] = self.bodies;
        let none = [N::from(0.0); 3];
        [(cam, line.map(|part| -part)), (roller, line), (cam, none)]
    }

    /// w over time, as velocities over the size act along it.
    #[inline(always)]
    fn line<const K: usize, N: Number>(
        &self,
        [cam, roller]: [Moving<N>; 2],
        size: f64,
    ) -> [Series<K, N>; 3] {
        let [centre, place] = [path(&cam, self.points[0]), path(&roller, self.points[1])];
        let [cos, sin] = axis(&cam);
        let gap = [place[0] - centre[0], place[1] - centre[1]];
        let seen = [cos * gap[0] + sin * gap[1], cos * gap[1] - sin * gap[0]];
        let [x, y] = self.curve.gradient_over(seen);
        let normal = [cos * x - sin * y, sin * x + cos * y];
        let moment = place[0] * normal[1] - place[1] * normal[0];
        let moment = Series(moment.0.map(|part| part.scale(size.recip())));
        [moment, normal[0], normal[1]]
    }
}

/// Where a point of a body is over time.
#[inline(always)]
fn path<const K: usize, N: Number>(
    (pose, velocity, acceleration): &Moving<N>,
    point: [f64; 2],
) -> Path<K, N> {
    let place = pose.place(point);
    let [vx, vy] = at(velocity, place);
    let [ax, ay] = at(acceleration, place);
    let bend = [ax - velocity[0] * vy, ay + velocity[0] * vx];
    course([place, [vx, vy], bend])
}

/// The x axis of a body's frame over time.
#[inline(always)]
fn axis<const K: usize, N: Number>((pose, velocity, acceleration): &Moving<N>) -> Path<K, N> {
    let (axis, across) = ([pose.cos, pose.sin], [-pose.sin, pose.cos]);
    let (turning, bend) = (velocity[0], acceleration[0]);
    let square = turning * turning;
    let twice = [0, 1].map(|k| bend * across[k] - square * axis[k]);
    course([axis, across.map(|part| turning * part), twice])
}

/// A vector over time, by its value and derivatives.
#[inline(always)]
fn course<const K: usize, N: Number>(derivatives: [[N; 2]; 3]) -> Path<K, N> {
    [0, 1].map(|k| {
        let [value, rate, bend] = derivatives.map(|vector| vector[k]);
        let taylor = [value, rate, bend.scale(0.5)];
        Series(std::array::from_fn(|order| taylor[order]))
    })
}
