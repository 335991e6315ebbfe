//! What is solved in place of a linkage of several inputs: welded links as one body, without the
//! constraints that are redundant.
//!
//! Welded links have the same velocity, taken as a screw about one point: an attached link is a
//! body of its own to all that asks for places and velocities, and takes those of its base. Its
//! pairs are solved as pairs of the base, and what acts on it acts on the base.
//!
//! A link that floats is the base of its body. An input whose pair is on attached links is that
//! between the bases, and a constant.

use super::columns::Columns;
use super::dynamics::MultiReduced;
use super::plan::MultiPlan;
use super::spec::MultiSpec;
use crate::kinematics::linkage::skeleton::Skeleton;
use crate::kinematics::linkage::state::State;
use crate::kinematics::linkage::welds::{self, AttachedLink};
use crate::math::number::Number;

/// A linkage of several inputs as it is solved.
#[derive(Clone, Debug)]
pub(super) struct WeldedLinkage {
    /// The linkage, all its pairs between bases, with hidden links and pairs behind its own.
    pub(super) spec: MultiSpec,
    pub(super) skeleton: Skeleton,
    /// For each pair its coordinate between the bases less that between its links (rad).
    shifts: Vec<f64>,
}

impl WeldedLinkage {
    /// Of a linkage whose numbers are right. A link that floats is the base of its body.
    pub(super) fn of(linkage: &MultiSpec) -> Self {
        let skeleton = Skeleton::with_bases(&linkage.linkage, floating(linkage));
        let pairs = linkage.linkage.pairs.iter();
        let shifts = pairs.map(|pair| welds::shift(pair, &skeleton.attached));
        Self {
            shifts: shifts.collect(),
            spec: MultiSpec {
                linkage: skeleton.spec.clone(),
                inputs: linkage.inputs.clone(),
            },
            skeleton,
        }
    }

    /// How a link is attached to another one, or to the ground.
    pub(super) fn attachment(&self, link: usize) -> Option<&AttachedLink> {
        self.skeleton.attached.iter().find(|one| one.link == link)
    }

    /// Coordinate of a pair between the bodies that it joins here, less its own (rad).
    pub(super) fn shift(&self, pair: usize) -> f64 {
        self.shifts[pair]
    }
}

impl MultiPlan {
    /// Places the attached links, their bases being placed.
    #[inline]
    pub(super) fn attach(&self, state: &mut State) {
        self.plan.attach::<1>(state);
    }

    /// The angles of the attached links over whole turns, those of their bases being known.
    #[inline]
    pub(super) fn turn_attached(&self, angles: &mut [f64]) {
        for one in &self.plan.attached {
            angles[one.link] = one.angle_of_link(angles);
        }
    }
}

impl<N: Number> Columns<N> {
    /// Velocities of the attached links by every input, those of their bases being known.
    #[inline]
    pub(super) fn find_attached(&mut self, plan: &MultiPlan) {
        for one in &plan.plan.attached {
            let Some(base) = one.base.filter(|&base| !plan.placed[base]) else {
                continue;
            };
            for input in 0..plan.inputs {
                self.columns[one.link * plan.inputs + input] =
                    self.columns[base * plan.inputs + input];
            }
        }
    }

    /// Velocities and accelerations of the attached links, those of their bases being known.
    #[inline]
    pub(super) fn set_attached_rates(&mut self, plan: &MultiPlan) {
        for one in &plan.plan.attached {
            let base = plan.body_of_link(one.base);
            self.velocity[one.link] = self.velocity[base];
            self.acceleration[one.link] = self.acceleration[base];
        }
    }
}

impl<N: Number> MultiReduced<N> {
    /// Lets what inputs alone place carry the inertia of what is welded to it.
    #[inline]
    pub(super) fn carry_attached(&mut self, plan: &MultiPlan) {
        for one in &plan.plan.attached {
            let Some(base) = one.base.filter(|&base| plan.placed[base]) else {
                continue;
            };
            let own = self.carried[one.link];
            for (sum, part) in self.carried[base].iter_mut().zip(own) {
                *sum += part;
            }
        }
    }

    /// Adds the wrenches on the attached links to those on their bases.
    #[inline]
    pub(super) fn load_attached(&mut self, plan: &MultiPlan) {
        for one in &plan.plan.attached {
            let own = self.wrenches[one.link];
            let base = &mut self.wrenches[plan.body_of_link(one.base)];
            for (sum, part) in base.iter_mut().zip(own) {
                *sum += part;
            }
        }
    }
}

/// The links whose coordinates are inputs.
fn floating(spec: &MultiSpec) -> impl Iterator<Item = usize> {
    let inputs = spec.inputs.iter();
    inputs.filter_map(|input| input.coordinate.floating_link())
}
