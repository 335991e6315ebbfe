//! Velocities of gears, belts and racks inside larger groups.
//!
//! One equation a coupling, linear in the velocities of three bodies: the second wheel less the
//! carrier, less ρ times the first wheel less the carrier; of a rack its velocity along its guide in
//! place of the second angular velocity. Accelerations follow the same equation: angles in the plane
//! add up, and along a guide on which nothing turns the change of its direction makes nothing.

use super::twist::{Motion, Parts, PartsMoved, Pose};
use crate::kinematics::linkage::couplings::Meeting;
use crate::kinematics::linkage::elements::elements;
use crate::kinematics::linkage::spec::{CouplingSpec, PairSpec};
use crate::math::number::Number;

/// A coupling of wheels made ready.
#[derive(Clone, Copy, Debug)]
pub(super) struct Geared {
    /// The bodies of both wheels (or of wheel and rack), and of their carrier.
    pub(super) bodies: [usize; 3],
    /// ρ.
    ratio: f64,
    /// Of a rack the body that carries it, and the direction of its guide there.
    guide: Option<(usize, [f64; 2])>,
}

impl Geared {
    /// Of a coupling that meets its carrier so; `ground`: index of the ground.
    pub(super) fn new(
        coupling: &CouplingSpec,
        meeting: &Meeting,
        pairs: &[PairSpec],
        ground: usize,
    ) -> Self {
        let body = |link: Option<usize>| link.unwrap_or(ground);
        let guide = meeting.guide.map(|(pair, _)| {
            let [on, link] = elements(&pairs[pair]);
            let own = if on.link == coupling.carrier {
                on
            } else {
                link
            };
            (body(coupling.carrier), own.along)
        });
        let [one, other] = coupling.wheels.map(body);
        Self {
            bodies: [one, other, body(coupling.carrier)],
            ratio: coupling.kind.ratio(),
            guide,
        }
    }

    /// Its equation at a position.
    pub(super) fn parts<N: Number>(&self, poses: &[Pose<N>], size: f64) -> Parts<N> {
        let [one, other, carrier] = self.bodies;
        let (zero, ratio) = (N::from(0.0), N::from(self.ratio));
        let turning = |factor: N| [factor, zero, zero];
        match self.guide {
            None => [
                (one, turning(-ratio)),
                (other, turning(N::from(1.0))),
                (carrier, turning(ratio - N::from(1.0))),
            ],
            Some((owner, along)) => {
                let ratio = ratio.scale(size.recip());
                let [x, y] = poses[owner].turn(along);
                [
                    (one, turning(-ratio)),
                    (other, [zero, x, y]),
                    (carrier, [ratio, -x, -y]),
                ]
            }
        }
    }

    /// First and second derivative in time of [`Self::parts`], the carrier moving so.
    pub(super) fn parts_moved(&self, poses: &[Pose<f64>], motion: Motion<'_>) -> PartsMoved {
        let [one, other, carrier] = self.bodies;
        let none = [[0.0; 2]; 3];
        let Some((owner, along)) = self.guide else {
            return [(one, none), (other, none), (carrier, none)];
        };
        let (velocity, acceleration) = motion(owner);
        let (turning, bend) = (velocity[0], acceleration[0]);
        let [u, v] = poses[owner].turn(along);
        let square = turning * turning;
        let x = [-turning * v, -bend * v - square * u];
        let y = [turning * u, bend * u - square * v];
        let minus = |[a, b]: [f64; 2]| [-a, -b];
        [
            (one, none),
            (other, [[0.0; 2], x, y]),
            (carrier, [[0.0; 2], minus(x), minus(y)]),
        ]
    }
}
