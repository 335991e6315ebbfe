//! The couplings of larger groups: one equation each, linear in the velocities of their bodies.
//!
//! It is w·t = 0, with the row w of the joint and the velocities t of its bodies; accelerations follow
//! w·a + ẇ·t = 0. The derivatives of w in time are the coefficients of the same row over power series
//! in time.

use super::twist::{Motion, Parts, PartsMoved, Pose, Twist, at};
use crate::kinematics::linkage::elements::Frame;
use crate::kinematics::linkage::joints::{CouplingSpec, Frames, Joint};
use crate::kinematics::linkage::spec::PairSpec;
use crate::kinematics::linkage::vector::Vector;
use crate::math::number::Number;
use crate::math::series::Series;

/// A coupling made ready.
#[derive(Clone, Debug)]
pub(super) struct PreparedCoupling {
    joint: Joint,
    /// The bodies that it ties, some of them perhaps twice.
    pub(super) bodies: [usize; 3],
}

/// Bodies with their velocities and accelerations over time.
struct Moving<'a, N, M> {
    bodies: &'a [usize; 3],
    poses: &'a [Pose<N>],
    motion: M,
}

impl PreparedCoupling {
    /// Of a coupling that has been checked; `ground`: index of the ground.
    pub(super) fn new(coupling: &CouplingSpec, pairs: &[PairSpec], ground: usize) -> Option<Self> {
        Some(Self {
            joint: coupling.ready(pairs)?,
            bodies: coupling.links().map(|link| link.unwrap_or(ground)),
        })
    }

    /// Its equation at a position.
    pub(super) fn parts<N: Number>(&self, poses: &[Pose<N>], size: f64) -> Parts<N> {
        let none = [N::from(0.0); 3];
        let mut parts = self.bodies.map(|body| (body, none));
        let still = |_| (none, none);
        self.row::<1, N>(poses, still, size, |link, entries| {
            for (part, entry) in parts[link].1.iter_mut().zip(entries) {
                *part += entry.0[0];
            }
        });
        parts
    }

    /// What the change of its equation makes of the velocities: the accelerations follow the same
    /// equation with that added to it.
    pub(super) fn drift<N: Number>(
        &self,
        poses: &[Pose<N>],
        velocity: &[Twist<N>],
        size: f64,
    ) -> N {
        let none = [N::from(0.0); 3];
        let mut drift = N::from(0.0);
        let moving = |body: usize| (velocity[body], none);
        self.row::<2, N>(poses, moving, size, |link, [turned, x, y]| {
            let [turning, u, v] = velocity[self.bodies[link]];
            drift += turned.0[1] * turning + (x.0[1] * u + y.0[1] * v).scale(size.recip());
        });
        drift
    }

    /// First and second derivative in time of [`Self::parts`], the bodies moving so.
    pub(super) fn parts_moved(
        &self,
        poses: &[Pose<f64>],
        motion: Motion<'_>,
        size: f64,
    ) -> PartsMoved {
        let mut parts = self.bodies.map(|body| (body, [[0.0; 2]; 3]));
        self.row::<3, f64>(poses, motion, size, |link, entries| {
            for (part, entry) in parts[link].1.iter_mut().zip(entries) {
                part[0] += entry.0[1];
                part[1] += 2.0 * entry.0[2];
            }
        });
        parts
    }

    /// Adds what velocities (ω, v over the size) of its links contribute to its equation, over time.
    #[inline(always)]
    fn row<const K: usize, N: Number>(
        &self,
        poses: &[Pose<N>],
        motion: impl Fn(usize) -> (Twist<N>, Twist<N>),
        size: f64,
        mut add: impl FnMut(usize, [Series<K, N>; 3]),
    ) {
        let moving = Moving {
            bodies: &self.bodies,
            poses,
            motion,
        };
        let measure = self.joint.measure();
        self.joint.row::<K, N>(&moving, |link, wrench| {
            add(link, measure.entries(wrench.about_origin(), size));
        });
    }
}

impl<const K: usize, N: Number, M> Frames<K, N> for Moving<'_, N, M>
where
    M: Fn(usize) -> (Twist<N>, Twist<N>),
{
    #[inline(always)]
    fn frame(&self, link: usize) -> Frame<K, N> {
        let body = self.bodies[link];
        let (pose, (velocity, acceleration)) = (&self.poses[body], (self.motion)(body));
        let place = [pose.x, pose.y];
        let [vx, vy] = at(&velocity, place);
        let [ax, ay] = at(&acceleration, place);
        let (turning, square) = (velocity[0], velocity[0] * velocity[0]);
        let bend = [ax - turning * vy, ay + turning * vx];
        let (along, across) = ([pose.cos, pose.sin], [-pose.sin, pose.cos]);
        let twice = [0, 1].map(|k| acceleration[0] * across[k] - square * along[k]);
        Frame {
            at: course([place, [vx, vy], bend]),
            direction: course([along, across.map(|part| turning * part), twice]),
        }
    }
}

/// A vector over time, by its value and derivatives.
#[inline(always)]
fn course<const K: usize, N: Number>(derivatives: [[N; 2]; 3]) -> Vector<K, N> {
    let [x, y] = [0, 1].map(|k| {
        let [value, rate, bend] = derivatives.map(|vector| vector[k]);
        let taylor = [value, rate, bend.scale(0.5)];
        Series(std::array::from_fn(|order| taylor[order]))
    });
    Vector::new(x, y)
}
