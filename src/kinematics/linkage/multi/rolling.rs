//! Velocities of cams inside larger groups.
//!
//! The roller's centre P stays on the pitch curve: its velocity against the cam has no part along
//! the gradient n of |p| − R(angle of p), which is n = e − κ·e⊥ with the direction e from the
//! curve's own centre to P and κ = R′/|p|. As a line n through P, w = (P × n, n), it is
//! w·(t₂ − t₁) = 0 with the velocities of roller and cam; accelerations follow
//! w·(a₂ − a₁) + ẇ·(t₂ − t₁) = 0. In ẇ the roller's centre moves along the pitch curve, so that
//! the curvature counts: e turns by Ω, the angular velocity of the line of both centres, and the
//! polar angle in the cam by ψ̇ = Ω − ω₁.

use super::twist::{Motion, Parts, PartsMoved, Pose, Twist, at, dot, minus};
use crate::kinematics::linkage::couplings::PitchCurve;
use crate::kinematics::linkage::spec::CamPairSpec;
use crate::math::jet::Jet;
use crate::math::number::{Number, atan, sqrt};

/// A cam made ready.
#[derive(Clone, Debug)]
pub(super) struct Rolling {
    /// The bodies of the cam and of the roller.
    pub(super) bodies: [usize; 2],
    /// The points about which the pitch curve is polar and of the roller's centre (m).
    points: [[f64; 2]; 2],
    curve: PitchCurve,
}

/// Where the roller is, seen from the cam. Lengths in m.
struct Seen<N> {
    /// The roller's centre.
    place: [N; 2],
    /// Direction to it from the curve's centre.
    radial: [N; 2],
    /// Distance from there.
    far: N,
    /// R, R′ and R″.
    radius: [N; 3],
    /// R with its derivatives, without those of the position.
    jet: Jet,
}

/// How the roller moves against the cam's centre.
struct Turning<N> {
    /// Velocity of the roller's centre.
    place: [N; 2],
    /// Ω.
    line: N,
    /// Rate of the distance.
    far: N,
    /// ψ̇.
    angle: N,
    /// κ̇.
    slope: N,
}

fn left<N: Number>([x, y]: [N; 2]) -> [N; 2] {
    [-y, x]
}

fn inner<N: Number>([a, b]: [N; 2], [x, y]: [N; 2]) -> N {
    a * x + b * y
}

fn cross<N: Number>([a, b]: [N; 2], [x, y]: [N; 2]) -> N {
    a * y - b * x
}

/// Σ factor·vector.
fn sum<N: Number, const K: usize>(parts: [(N, [N; 2]); K]) -> [N; 2] {
    let none = [N::from(0.0); 2];
    parts.into_iter().fold(none, |[x, y], (factor, [u, v])| {
        [x + factor * u, y + factor * v]
    })
}

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
        let seen = self.seen(poses);
        let normal = seen.normal();
        self.of_both(line(cross(seen.place, normal), normal, size))
    }

    /// ẇ·(t₂ − t₁), the bodies having these velocities; over the size.
    pub(super) fn drift<N: Number>(
        &self,
        poses: &[Pose<N>],
        velocity: &[Twist<N>],
        size: f64,
    ) -> N {
        let seen = self.seen(poses);
        let both = self.bodies.map(|body| velocity[body]);
        let turning = self.turning(&seen, both);
        let [once, normal] = [seen.normal_moved(&turning), seen.normal()];
        let moment = cross(turning.place, normal) + cross(seen.place, once);
        let relative = minus(both[1], both[0]);
        dot(&[moment, once[0], once[1]], &relative).scale(size.recip())
    }

    /// First and second derivative in time of [`Self::parts`], the bodies moving so.
    pub(super) fn parts_moved(
        &self,
        poses: &[Pose<f64>],
        motion: Motion<'_>,
        size: f64,
    ) -> PartsMoved {
        let seen = self.seen(poses);
        let both = self.bodies.map(motion);
        let turning = self.turning(&seen, both.map(|(velocity, _)| velocity));
        let (normal, once) = (seen.normal(), seen.normal_moved(&turning));
        let (place, twice) = self.bent(&seen, &turning, both);
        let rate = cross(turning.place, normal) + cross(seen.place, once);
        let bend =
            cross(place, normal) + 2.0 * cross(turning.place, once) + cross(seen.place, twice);
        let (rate, bend) = (line(rate, once, size), line(bend, twice, size));
        let signed = |sign: f64| [0, 1, 2].map(|k| [sign * rate[k], sign * bend[k]]);
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

    fn seen<N: Number>(&self, poses: &[Pose<N>]) -> Seen<N> {
        let [cam, roller] = self.bodies.map(|body| poses[body]);
        let (centre, place) = (cam.place(self.points[0]), roller.place(self.points[1]));
        let gap = [place[0] - centre[0], place[1] - centre[1]];
        let far = sqrt(inner(gap, gap));
        let radial = gap.map(|part| part / far);
        let axes = [cam.cos, cam.sin];
        let [x, y] = [inner(axes, radial), cross(axes, radial)];
        let angle = y.value().atan2(x.value());
        // What is left beyond the angle's value is zero, but for its derivatives.
        let (sin, cos) = angle.sin_cos();
        let rest = atan((y.scale(cos) - x.scale(sin)) / (x.scale(cos) + y.scale(sin)));
        let jet = self.curve.radius(angle);
        Seen {
            place,
            radial,
            far,
            radius: jet.lift(N::from(angle) + rest),
            jet,
        }
    }

    /// How cam and roller move against each other, at velocities of both.
    fn turning<N: Number>(&self, seen: &Seen<N>, [cam, roller]: [Twist<N>; 2]) -> Turning<N> {
        let place = at(&roller, seen.place);
        let [x, y] = at(&cam, seen.centre());
        let gap = [place[0] - x, place[1] - y];
        let far = inner(seen.radial, gap);
        let line = cross(seen.radial, gap) / seen.far;
        let angle = line - cam[0];
        let [_, first, second] = seen.radius;
        Turning {
            place,
            line,
            far,
            angle,
            slope: (second * angle - first * far / seen.far) / seen.far,
        }
    }

    /// Second derivatives in time of the roller's centre and of the normal.
    fn bent(
        &self,
        seen: &Seen<f64>,
        turning: &Turning<f64>,
        [cam, roller]: [(Twist<f64>, Twist<f64>); 2],
    ) -> ([f64; 2], [f64; 2]) {
        let place = accelerated(&roller, seen.place);
        let [x, y] = accelerated(&cam, seen.centre());
        let gap = [place[0] - x, place[1] - y];
        let (far, way) = (seen.far, turning.far);
        let line = (cross(seen.radial, gap) - 2.0 * way * turning.line) / far;
        let bend = inner(seen.radial, gap) + far * turning.line * turning.line;
        let (angle, psi) = (turning.angle, line - cam.1[0]);
        let Jet {
            first,
            second,
            third,
            ..
        } = seen.jet;
        let slope = (third * angle * angle + second * psi
            - (2.0 * second * angle * way + first * bend) / far
            + 2.0 * first * way * way / (far * far))
            / far;
        let across = left(seen.radial);
        let normal = sum([
            (line, left(seen.normal())),
            (turning.line, left(seen.normal_moved(turning))),
            (turning.line * turning.slope, seen.radial),
            (-slope, across),
        ]);
        (place, normal)
    }
}

impl<N: Number> Seen<N> {
    /// The centre about which the pitch curve is polar.
    fn centre(&self) -> [N; 2] {
        sum([(N::from(1.0), self.place), (-self.far, self.radial)])
    }

    /// n.
    fn normal(&self) -> [N; 2] {
        let slope = self.radius[1] / self.far;
        sum([(N::from(1.0), self.radial), (-slope, left(self.radial))])
    }

    /// ṅ = Ω·n⊥ − κ̇·e⊥.
    fn normal_moved(&self, turning: &Turning<N>) -> [N; 2] {
        sum([
            (turning.line, left(self.normal())),
            (-turning.slope, left(self.radial)),
        ])
    }
}

/// A line as velocities over the size act along it.
fn line<N: Number>(moment: N, [x, y]: [N; 2], size: f64) -> Twist<N> {
    [moment.scale(size.recip()), x, y]
}

/// Acceleration of the point of a body that lies at `place`.
fn accelerated((velocity, acceleration): &(Twist<f64>, Twist<f64>), place: [f64; 2]) -> [f64; 2] {
    let ([vx, vy], [ax, ay]) = (at(velocity, place), at(acceleration, place));
    [ax - velocity[0] * vy, ay + velocity[0] * vx]
}
