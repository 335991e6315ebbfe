//! The joints of larger groups: equations that are linear in the velocities of their bodies.
//!
//! Each is w·t = 0, with a row w of the joint and the velocities t of its bodies; accelerations follow
//! w·a + ẇ·t = 0. The derivatives of w in time are the coefficients of the same row over power series
//! in time.

use super::twist::{Motion, Parts, Pose, Twist, at};
use crate::kinematics::linkage::elements::Frame;
use crate::kinematics::linkage::joints::{CouplingSpec, Frames, Joint};
use crate::kinematics::linkage::spec::PairSpec;
use crate::kinematics::linkage::vector::Vector;
use crate::math::number::Number;
use crate::math::series::Series;

/// A joint made ready.
#[derive(Clone, Debug)]
pub(super) struct TiedBodies {
    joint: Joint,
    /// The bodies of its links.
    bodies: [usize; 3],
}

/// Bodies with their velocities and accelerations over time.
struct BodyMotions<'a, N, M> {
    bodies: &'a [usize; 3],
    poses: &'a [Pose<N>],
    motion: M,
}

impl TiedBodies {
    /// A pair; `ground`: index of the ground.
    pub(super) fn of_pair(pair: &PairSpec, ground: usize) -> Self {
        let [on, link] = [pair.on.link, pair.link.link].map(|link| link.unwrap_or(ground));
        Self {
            joint: Joint::of_pair(pair),
            bodies: [on, link, on],
        }
    }

    /// A coupling that has been checked; `ground`: index of the ground.
    pub(super) fn of_coupling(
        coupling: &CouplingSpec,
        pairs: &[PairSpec],
        ground: usize,
    ) -> Option<Self> {
        Some(Self {
            joint: coupling.to_joint(pairs)?,
            bodies: coupling.links().map(|link| link.unwrap_or(ground)),
        })
    }

    /// The bodies that it ties.
    pub(super) fn bodies(&self) -> &[usize] {
        &self.bodies[..self.joint.shape().links]
    }

    /// Number of its equations.
    pub(super) fn rows(&self) -> usize {
        self.joint.shape().rows.len()
    }

    /// Its equations at a position.
    pub(super) fn write_equations<N: Number>(
        &self,
        poses: &[Pose<N>],
        size: f64,
        parts: &mut [Parts<N>],
    ) {
        let none = [N::from(0.0); 3];
        parts.fill([none; 3]);
        let still = |_| (none, none);
        self.add_velocity_terms::<1, N>(poses, still, size, |row, link, entries| {
            let part = &mut parts[row][link];
            for k in 0..3 {
                part[k] += entries[k].0[0];
            }
        });
    }

    /// What the change of its equations makes of the velocities: the accelerations follow the same
    /// equations with that added to them.
    pub(super) fn drift<N: Number>(
        &self,
        poses: &[Pose<N>],
        velocity: &[Twist<N>],
        size: f64,
    ) -> [N; 3] {
        let none = [N::from(0.0); 3];
        let mut drift = none;
        let moving = |body: usize| (velocity[body], none);
        self.add_velocity_terms::<2, N>(poses, moving, size, |row, link, [turned, x, y]| {
            let [turning, u, v] = velocity[self.bodies[link]];
            drift[row] += turned.0[1] * turning + (x.0[1] * u + y.0[1] * v).scale(size.recip());
        });
        drift
    }

    /// First and second derivative in time of [`Self::write_equations`], the bodies moving so: row, body, and
    /// both for each part.
    pub(super) fn parts_moved(
        &self,
        poses: &[Pose<f64>],
        motion: Motion<'_>,
        size: f64,
        mut add: impl FnMut(usize, usize, [[f64; 2]; 3]),
    ) {
        self.add_velocity_terms::<3, f64>(poses, motion, size, |row, link, entries| {
            let moved = entries.map(|entry| [entry.0[1], 2.0 * entry.0[2]]);
            add(row, self.bodies[link], moved);
        });
    }

    /// Adds what velocities (ω, v over the size) of its links contribute to its equations, over time.
    #[inline(always)]
    fn add_velocity_terms<const K: usize, N: Number>(
        &self,
        poses: &[Pose<N>],
        motion: impl Fn(usize) -> (Twist<N>, Twist<N>),
        size: f64,
        mut add: impl FnMut(usize, usize, [Series<K, N>; 3]),
    ) {
        let moving = BodyMotions {
            bodies: &self.bodies,
            poses,
            motion,
        };
        let measures = self.joint.shape().rows;
        self.joint.rows::<K, N>(&moving, |row, link, wrench| {
            let entries = measures[row].velocity_terms(wrench.about_origin(), size);
            add(row, link, entries);
        });
    }
}

impl<const K: usize, N: Number, M> Frames<K, N> for BodyMotions<'_, N, M>
where
    M: Fn(usize) -> (Twist<N>, Twist<N>),
{
    #[inline(always)]
    fn frame(&self, link: usize) -> Frame<K, N> {
        let body = self.bodies[link];
        let pose = &self.poses[body];
        let (cos, sin, zero) = (pose.cos, pose.sin, N::from(0.0));
        let (mut rate, mut twice) = ([zero; 4], [zero; 4]);
        if K > 1 {
            let (velocity, acceleration) = (self.motion)(body);
            let (turning, bend) = (velocity[0], acceleration[0]);
            let [vx, vy] = at(&velocity, [pose.x, pose.y]);
            rate = [vx, vy, -turning * sin, turning * cos];
            if K > 2 {
                let [ax, ay] = at(&acceleration, [pose.x, pose.y]);
                let square = turning * turning;
                twice = [
                    ax - turning * vy,
                    ay + turning * vx,
                    -bend * sin - square * cos,
                    bend * cos - square * sin,
                ];
            }
        }
        let over = |k: usize, value: N| number_over_time([value, rate[k], twice[k]]);
        Frame {
            at: Vector::new(over(0, pose.x), over(1, pose.y)),
            direction: Vector::new(over(2, cos), over(3, sin)),
        }
    }
}

/// A number over time, by its value and derivatives.
#[inline(always)]
fn number_over_time<const K: usize, N: Number>([value, rate, bend]: [N; 3]) -> Series<K, N> {
    let taylor = [value, rate, bend.scale(0.5)];
    let mut series = Series::fixed(0.0);
    series.0[..K].copy_from_slice(&taylor[..K]);
    series
}
