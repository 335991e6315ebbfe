//! Groups at rest: what friction can hold, and what it does hold.

use super::force::LinkageMotion;
use super::passes::sign_of;
use super::{Direction, Group, Member};
use crate::dynamics::system::frozen::{Frozen, segment};
use crate::dynamics::system::passes::{Extent, Work};
use crate::math::quantity::Quantity;

impl Frozen {
    /// A group that friction holds: no force is left on its root.
    pub(super) fn hold_group<N: Quantity>(
        &self,
        group: &Group,
        state: &[N],
        modes: &[i64],
        extent: Extent,
        work: &mut Work<N>,
    ) {
        let link = self.link_force(group, state, work);
        if extent == Extent::Full {
            let missing = work.force[group.root] + link;
            self.distribute_holding_force(group, -missing.value(), modes, work);
        }
        work.force[group.root] = -link;
    }

    /// Parts of the force that holds a group, handed out to its linkages in the
    /// proportion of what they can hold at most: they are not determined.
    fn distribute_holding_force<N: Quantity>(
        &self,
        group: &Group,
        hold: f64,
        modes: &[i64],
        work: &mut Work<N>,
    ) {
        if hold == 0.0 {
            return;
        }
        // Friction holds against the direction of a start.
        let most = self.impending(group, -hold.signum(), modes, work);
        let limit = |member: &Member| work.rubbing[member.linkage].force.value();
        let limits: Vec<f64> = group.members.iter().map(limit).collect();
        for (member, limit) in group.members.iter().zip(limits) {
            let share = match most {
                Some(most) if most != 0.0 => hold / most * limit,
                // Whatever holds it, a single one holds it alone.
                _ => {
                    let [ratio, _] = self.member_ratio(member, N::from(0.0), work);
                    hold / ratio.value() / group.members.len() as f64
                }
            };
            work.rubbing[member.linkage].force = N::from(share);
            self.push(member, N::from(share), work);
        }
    }

    /// Friction of a group at rest that is about to start in a direction, on its
    /// root; `None` where no force would start it. Each linkage's part is in `work`;
    /// the forces are left as they were.
    pub(super) fn impending<N: Quantity>(
        &self,
        group: &Group,
        root: f64,
        modes: &[i64],
        work: &mut Work<N>,
    ) -> Option<f64> {
        let mut sum = 0.0;
        let mut locked = false;
        for member in group.members.iter().rev() {
            let [ratio, _] = self.member_ratio(member, N::from(0.0), work);
            let direction = match member.direction {
                Direction::OfRoot(sign) => sign * root,
                Direction::Own { .. } => sign_of(ratio.value()) * root,
            };
            let zero = N::from(0.0);
            let moving = LinkageMotion {
                speed: zero,
                free: zero,
                mobility: zero,
                direction,
                segment: self.segment_towards(member, direction, modes, work),
                pressed: None,
            };
            let force = self.friction(member, &moving, false, work);
            let force = N::from(force.value());
            locked |= !force.value().is_finite();
            let force = if locked { N::from(0.0) } else { force };
            work.rubbing[member.linkage].force = force;
            work.rubbing[member.linkage].failure = None;
            self.push(member, force, work);
            sum += (ratio * force).value();
        }
        for member in &group.members {
            let force = work.rubbing[member.linkage].force;
            self.push(member, -force, work);
        }
        (!locked).then_some(sum)
    }

    /// The segment of a linkage's course that it enters in a direction; at its
    /// edges another one than that of the modes.
    pub(super) fn segment_towards<N: Quantity>(
        &self,
        member: &Member,
        direction: f64,
        modes: &[i64],
        work: &Work<N>,
    ) -> i64 {
        let now = segment(modes, member.segment);
        let breaks = &member.reversals.breaks;
        if breaks.is_empty() {
            return now;
        }
        let q = work.displacement[member.node].value();
        let (low, high) = breaks.edges(now);
        let near = 1e-9 * member.kinetostatics.length_scale().max(q.abs()).max(1.0);
        if direction < 0.0 && (q - low).abs() <= near {
            now - 1
        } else if direction > 0.0 && (q - high).abs() <= near {
            now + 1
        } else {
            now
        }
    }
}
