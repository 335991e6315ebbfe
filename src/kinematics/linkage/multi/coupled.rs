//! The couplings of larger groups: one equation each, linear in the velocities of their bodies.

use super::geared::Geared;
use super::rolling::Rolling;
use super::twist::{Motion, Parts, PartsMoved, Pose, Twist};
use crate::kinematics::linkage::spec::{CouplingKind, CouplingSpec, PairSpec};
use crate::math::number::Number;

/// A coupling made ready.
#[derive(Clone, Debug)]
pub(super) enum PreparedCoupling {
    /// Gears, a belt, or a rack.
    Wheels(Geared),
    /// A cam.
    Cam(Box<Rolling>),
}

impl PreparedCoupling {
    /// Of a coupling that has been checked; `ground`: index of the ground.
    pub(super) fn new(coupling: &CouplingSpec, pairs: &[PairSpec], ground: usize) -> Option<Self> {
        match &coupling.kind {
            CouplingKind::Cam(cam) => Rolling::new(coupling.wheels, cam, ground)
                .map(Box::new)
                .map(Self::Cam),
            _ => {
                let meeting = coupling.axis_positions(pairs).ok()?;
                Some(Self::Wheels(Geared::new(coupling, &meeting, pairs, ground)))
            }
        }
    }

    /// The bodies that it ties, some of them perhaps twice.
    pub(super) fn bodies(&self) -> [usize; 3] {
        match self {
            Self::Wheels(geared) => geared.bodies,
            Self::Cam(rolling) => {
                let [cam, roller] = rolling.bodies;
                [cam, roller, cam]
            }
        }
    }

    /// Its equation at a position.
    pub(super) fn parts<N: Number>(&self, poses: &[Pose<N>], size: f64) -> Parts<N> {
        match self {
            Self::Wheels(geared) => geared.parts(poses, size),
            Self::Cam(rolling) => rolling.parts(poses, size),
        }
    }

    /// What the change of its equation makes of the velocities: the accelerations follow the same
    /// equation with that added to it.
    pub(super) fn drift<N: Number>(
        &self,
        poses: &[Pose<N>],
        velocity: &[Twist<N>],
        size: f64,
    ) -> N {
        match self {
            // A rack does not turn on its guide.
            Self::Wheels(_) => N::from(0.0),
            Self::Cam(rolling) => rolling.drift(poses, velocity, size),
        }
    }

    /// First and second derivative in time of [`Self::parts`], the bodies moving so.
    pub(super) fn parts_moved(
        &self,
        poses: &[Pose<f64>],
        motion: Motion<'_>,
        size: f64,
    ) -> PartsMoved {
        match self {
            Self::Wheels(geared) => geared.parts_moved(poses, motion),
            Self::Cam(rolling) => rolling.parts_moved(poses, motion, size),
        }
    }
}
