//! Friction within an evaluation: after the forces, before the accelerations.

use super::force::LinkageMotion;
use super::{Direction, Group, Member, Obstacle, StickSlip};
use crate::dynamics::system::dry_friction;
use crate::dynamics::system::frozen::{Frozen, segment};
use crate::dynamics::system::passes::{Extent, Work};
use crate::kinematics::linkage::kinetostatics::ForceFailure;
use crate::math::quantity::Quantity;

/// Rounds over the linkages of a group at most, and what they may still change.
const ROUNDS: usize = 200;
const SETTLED: f64 = 1e-14;

impl Frozen {
    /// Adds the friction of all joints to the forces, along with what it hands on
    /// to the drivers.
    pub(in crate::dynamics::system) fn add_friction<N: Quantity>(
        &self,
        state: &[N],
        modes: &[i64],
        extent: Extent,
        work: &mut Work<N>,
    ) {
        for group in &self.groups {
            for member in &group.members {
                work.rubbing[member.linkage].force = N::from(0.0);
                work.rubbing[member.linkage].failure = None;
            }
            let direction = group.component.map(|c| StickSlip::of(modes[c]));
            match direction {
                // A given motion is not changed; what drives it is.
                None if extent == Extent::Full => self.add_driven_friction(group, modes, work),
                None | Some(StickSlip::Unset) => {}
                Some(StickSlip::Stuck) => self.hold_group(group, state, modes, extent, work),
                Some(_) => self.add_sliding_friction(group, state, modes, work),
            }
        }
    }

    /// Power lost to friction in every object that has any (W).
    pub(in crate::dynamics::system) fn friction_losses<'a>(
        &'a self,
        modes: &'a [i64],
        work: &'a Work<f64>,
    ) -> impl Iterator<Item = (usize, f64)> + 'a {
        let groups = self.groups.iter().flat_map(move |group| {
            let held = group
                .component
                .is_some_and(|c| StickSlip::of(modes[c]) == StickSlip::Stuck);
            group.members.iter().map(move |member| {
                let force = work.rubbing[member.linkage].force;
                let loss = 0.0 - force * work.speed[member.node];
                (member.object, if held { 0.0 } else { loss })
            })
        });
        let joints = groups.chain(self.multi_input_friction_loss(work));
        joints.chain(dry_friction::losses(self, modes, work))
    }

    /// Corners of blocks that press, as found last, of linkages whose motion is given;
    /// one number for all. Of those that move freely modes tell it.
    pub(in crate::dynamics::system) fn pressing_corners(&self, work: &Work<f64>) -> u64 {
        let driven = self.groups.iter().filter(|group| group.component.is_none());
        let members = driven.flat_map(|group| &group.members);
        members.fold(0, |sum: u64, member| {
            let forces = work.rubbing[member.linkage].forces.as_ref();
            let bits = forces.map_or(0, |w| member.kinetostatics.pressing_corners(w));
            sum.rotate_left(7) ^ bits
        })
    }

    /// The force of a chain's links on a root that is one of its masses.
    pub(super) fn link_force<N: Quantity>(&self, group: &Group, state: &[N], work: &Work<N>) -> N {
        let Some((index, mass)) = group.mass else {
            return N::from(0.0);
        };
        let chain = &self.chains[index];
        let (u, v) = self.deviations(chain, state);
        let first = chain.first_coordinate;
        let inner = |m: usize| {
            let stretch = (u[m] - u[m - 1]).scale(self.stiffness[first + m]);
            stretch + (v[m] - v[m - 1]).scale(self.damping[first + m])
        };
        let below = if mass == 0 {
            work.reaction[index]
        } else {
            inner(mass)
        };
        if mass + 1 < chain.masses {
            inner(mass + 1) - below
        } else {
            -below
        }
    }

    /// Adds a force on a linkage's input and hands it on to the root.
    pub(super) fn push<N: Quantity>(&self, member: &Member, force: N, work: &mut Work<N>) {
        let mut force = force;
        work.force[member.node] += force;
        for &law in member.path.iter().rev() {
            force = work.laws[law].first * force;
            work.force[self.laws[law].driver] += force;
        }
    }

    /// Ratio of a member's speed to the root's, and its acceleration where the root
    /// has the acceleration `root`.
    pub(super) fn member_ratio<N: Quantity>(
        &self,
        member: &Member,
        root: N,
        work: &Work<N>,
    ) -> [N; 2] {
        let (mut ratio, mut acceleration) = (N::from(1.0), root);
        for &law in &member.path {
            let values = &work.laws[law];
            ratio = ratio * values.first;
            acceleration = values.first * acceleration + values.bias;
        }
        [ratio, acceleration]
    }

    /// Acceleration of a group's root with the forces that are on it now, `link` being
    /// those of its links.
    pub(super) fn root_acceleration<N: Quantity>(
        &self,
        group: &Group,
        link: N,
        work: &Work<N>,
    ) -> N {
        match group.component {
            Some(_) => (work.force[group.root] + link) / work.mass[group.root],
            None => work.acceleration[group.root],
        }
    }

    /// Motion of a linkage of a group where its root has the acceleration `root`, its own
    /// friction, as far as `work` has it, taken off.
    pub(super) fn moving<N: Quantity>(
        &self,
        group: &Group,
        member: &Member,
        root: N,
        modes: &[i64],
        work: &Work<N>,
    ) -> LinkageMotion<N> {
        let [ratio, acceleration] = self.member_ratio(member, root, work);
        let speed = work.speed[member.node];
        let (mobility, free) = match group.component {
            Some(_) => {
                let mobility = ratio * ratio / work.mass[group.root];
                let own = work.rubbing[member.linkage].force;
                (mobility, acceleration - mobility * own)
            }
            None => (N::from(0.0), acceleration),
        };
        let forwards = segment(modes, group.component) as f64;
        let known = match member.direction {
            Direction::OfRoot(sign) => sign * forwards,
            Direction::Own { component, .. } => modes[component] as f64,
        };
        let direction = match (known, group.component) {
            (0.0, Some(_)) => sign_of(ratio.value()) * forwards,
            (0.0, None) if speed.value() == 0.0 => sign_of(free.value()),
            (0.0, None) => speed.value().signum(),
            (known, _) => known,
        };
        LinkageMotion {
            speed,
            free,
            mobility,
            direction,
            segment: segment(modes, member.segment),
            pressed: member.pressed(modes),
        }
    }

    /// Friction of a group that moves: T of every linkage with the acceleration
    /// that they leave together.
    fn add_sliding_friction<N: Quantity>(
        &self,
        group: &Group,
        state: &[N],
        modes: &[i64],
        work: &mut Work<N>,
    ) {
        let link = self.link_force(group, state, work);
        let alone = group.members.len() == 1;
        let mut left = if alone { 1 } else { ROUNDS };
        let mut extra = None;
        while left > 0 {
            left -= 1;
            let mut change = 0.0f64;
            let mut size = 0.0f64;
            for member in group.members.iter().rev() {
                let root = self.root_acceleration(group, link, work);
                let moving = self.moving(group, member, root, modes, work);
                let before = work.rubbing[member.linkage].force;
                let force = self.friction(member, &moving, false, work);
                work.rubbing[member.linkage].force = force;
                self.push(member, force - before, work);
                let [ratio, _] = self.member_ratio(member, root, work);
                let share = ratio.value().abs();
                change = change.max(share * (force - before).value().abs());
                size = size.max(share * force.value().abs());
                if !force.value().is_finite() {
                    return;
                }
            }
            // Derivatives settle as fast as values, from then on.
            if extra.is_none() && change <= SETTLED * size {
                extra = Some(ROUNDS - left);
                left = if N::DERIVATIVES > 2 { ROUNDS - left } else { 0 };
            }
        }
        if !alone && extra.is_none() {
            let first = &group.members[0];
            work.rubbing[first.linkage].failure =
                Some(Obstacle::Failed(ForceFailure::SelfLocking {
                    change: f64::NAN,
                    iterations: ROUNDS,
                }));
            self.push(first, N::from(f64::NAN), work);
        }
    }

    /// Friction of linkages whose motion is given: it only loads the drive.
    fn add_driven_friction<N: Quantity>(&self, group: &Group, modes: &[i64], work: &mut Work<N>) {
        let root = work.acceleration[group.root];
        for member in group.members.iter().rev() {
            let moving = self.moving(group, member, root, modes, work);
            // In a dwell friction may be anything up to its limit: none is told.
            if moving.speed.value() == 0.0 && moving.free.value() == 0.0 {
                continue;
            }
            let force = self.friction(member, &moving, false, work);
            work.rubbing[member.linkage].force = force;
            self.push(member, force, work);
        }
    }
}

/// The sign of a number, 1 for zero.
pub(super) fn sign_of(x: f64) -> f64 {
    if x < 0.0 { -1.0 } else { 1.0 }
}
