//! Where a group stops: does it turn back, go on, or rest? And when does what rests
//! break loose?
//!
//! The friction of an impending start in both directions decides.

use super::passes::sign_of;
use super::stick_slip::ProbeAction;
use super::{Direction, Group, Member, Obstacle, StickSlip};
use crate::dynamics::integrate::{Modes, PhysicalStop, Probe};
use crate::dynamics::system::frozen::Frozen;
use crate::dynamics::system::passes::{Extent, Work};
use crate::dynamics::system::{System, dry_friction};
use crate::kinematics::linkage::kinetostatics::ForceFailure;

/// Friction of what is about to start exceeds that of what has just started by this
/// share, so that nothing stops and starts by rounding.
pub(super) const EXCESS: f64 = 1e-10;
/// Speeds at t = 0 below this share of what they are the difference of are rest.
pub(super) const AT_REST: f64 = 1e-13;
/// Places of a step at which a group at rest is looked at: between them a start is
/// located by bisection.
pub(super) const LOOKS: usize = 8;
/// The same for a group that moves, whose pairs may begin to press on another side.
const SIDES: usize = 4;

impl Frozen {
    /// What to look for besides the event_functions: starts of what rests, and motions with
    /// no solution or several.
    pub(in crate::dynamics::system) fn probes(&self, modes: &[i64], out: &mut Vec<Probe>) {
        for (index, group) in self.groups.iter().enumerate() {
            let mut probe = |component: usize, action: ProbeAction, looks: usize| {
                out.push(Probe {
                    index,
                    component,
                    target: action.target(),
                    looks,
                    refined: false,
                });
            };
            match group.component {
                Some(component) => match StickSlip::of(modes[component]) {
                    StickSlip::Stuck => {
                        probe(component, ProbeAction::Start(StickSlip::Forward), LOOKS);
                        probe(component, ProbeAction::Start(StickSlip::Backward), LOOKS);
                    }
                    StickSlip::Unset => {}
                    StickSlip::Forward | StickSlip::Backward => {
                        probe(component, ProbeAction::Stop, 1);
                    }
                },
                None => {
                    if let Some(Direction::Own { component, .. }) =
                        group.members.first().map(|member| member.direction)
                    {
                        probe(component, ProbeAction::Stop, 1);
                    }
                }
            }
            if let Some(component) = group.pressing(modes) {
                probe(component, ProbeAction::FlipSide, SIDES);
            }
        }
        self.multi_input_probes(modes, out);
    }

    /// A probe at a state: positive where it fires.
    pub(in crate::dynamics::system) fn probe(
        &self,
        probe: &Probe,
        time: f64,
        state: &mut [f64],
        modes: &[i64],
        work: &mut Work<f64>,
    ) -> f64 {
        let Some(group) = self.groups.get(probe.index) else {
            return self.evaluate_multi_input_probe(probe, (time, state, modes), work);
        };
        match ProbeAction::of(probe.target) {
            ProbeAction::Stop => match self.unsolved(group, time, state, modes, work) {
                Some((_, Obstacle::Failed(ForceFailure::SelfLocking { .. }))) => Probe::NO_FORCES,
                Some(_) => Probe::FIRES,
                None => Probe::RESTS,
            },
            ProbeAction::FlipSide => self.lifts(group, time, state, modes, work),
            ProbeAction::Start(direction) => {
                self.stop_root(group, time, state, modes, work);
                let [forwards, backwards] = self.starts(group, time, state, modes, work);
                match direction {
                    StickSlip::Forward => forwards,
                    _ => backwards,
                }
            }
        }
    }

    /// All forces at a state, friction left out.
    pub(super) fn forces_without_friction(
        &self,
        time: f64,
        state: &[f64],
        modes: &[i64],
        work: &mut Work<f64>,
    ) {
        let extent = Extent::Full;
        self.motion(time, state, modes, extent, work);
        self.apply_loads(time, modes, extent, work);
        self.apply_reactions(state, modes, extent, work);
        self.reduce_rigid(extent, work);
    }

    /// Takes the speed of a group's root out of a state; `work` then holds its motion.
    fn stop_root(
        &self,
        group: &Group,
        time: f64,
        state: &mut [f64],
        modes: &[i64],
        work: &mut Work<f64>,
    ) {
        let Some(coordinate) = group.coordinate else {
            return;
        };
        let law_speed = match group.mass {
            Some((chain, _)) => {
                self.motion(time, state, modes, Extent::Full, work);
                work.laws[self.chains[chain].law].speed
            }
            None => 0.0,
        };
        state[self.coordinates + coordinate] = -law_speed;
    }

    /// Force on the root of a group at rest beyond what friction can hold, forwards
    /// and backwards: positive where it starts.
    fn starts(
        &self,
        group: &Group,
        time: f64,
        state: &[f64],
        modes: &[i64],
        work: &mut Work<f64>,
    ) -> [f64; 2] {
        self.forces_without_friction(time, state, modes, work);
        let force = work.force[group.root] + self.link_force(group, state, work);
        [1.0, -1.0].map(|direction| {
            match self.impending(group, direction, modes, work) {
                Some(friction) => direction * (force + friction * (1.0 + EXCESS)),
                // No force would start it in this direction.
                None => -1.0 - force.abs(),
            }
        })
    }

    /// Puts a group into a direction, or to rest, at the state that is in `work`.
    fn set_out(&self, group: &Group, now: StickSlip, modes: &mut [i64], work: &Work<f64>) {
        if let Some(component) = group.component {
            modes[component] = now.mode();
        }
        if now == StickSlip::Stuck {
            return;
        }
        for member in &group.members {
            let [ratio, _] = self.member_ratio(member, 0.0, work);
            let direction = match member.direction {
                Direction::OfRoot(sign) => sign * now.sense(),
                Direction::Own { component, .. } => {
                    let direction = sign_of(ratio) * now.sense();
                    modes[component] = direction as i64;
                    direction
                }
            };
            if let Some(component) = member.segment {
                modes[component] = self.segment_towards(member, direction, modes, work);
            }
        }
    }
}

impl System {
    /// Decides what a group that stands does next; takes its speed out of the state.
    pub(in crate::dynamics::system) fn decide_on_group(
        &self,
        index: usize,
        time: f64,
        y: &mut [f64],
        modes: &mut [i64],
    ) -> Result<(), PhysicalStop> {
        let frozen = &self.frozen;
        let group = &frozen.groups[index];
        let mut work = Work::new(frozen);
        frozen.stop_root(group, time, y, modes, &mut work);
        let [forwards, backwards] = frozen.starts(group, time, y, modes, &mut work);
        let now = match (forwards > 0.0, backwards > 0.0) {
            (true, false) => StickSlip::Forward,
            (false, true) => StickSlip::Backward,
            (false, false) => StickSlip::Stuck,
            (true, true) => return Err(self.ambiguous_direction(index, time)),
        };
        frozen.set_out(group, now, modes, &work);
        Ok(())
    }

    /// Passes a switch of a direction.
    pub(in crate::dynamics::system) fn pass_direction(
        &self,
        time: f64,
        y: &mut [f64],
        component: usize,
        target: i64,
        modes: &mut Modes,
    ) -> Result<(), PhysicalStop> {
        if dry_friction::has_component(&self.frozen, component) {
            return dry_friction::decide_on(self, component, (time, y), &mut modes.0);
        }
        let several = self.frozen.several.as_ref();
        if several.is_some_and(|several| several.has_component(component)) {
            self.pass_pair(time, y, (component, target), &mut modes.0)?;
            self.frozen.settle_sides(time, y, &mut modes.0);
            return Ok(());
        }
        let own = |member: &Member| {
            let directed =
                matches!(member.direction, Direction::Own { component: c, .. } if c == component);
            directed || member.sides == Some(component)
        };
        let mut groups = self.frozen.groups.iter();
        let concerned = groups
            .position(|group| group.component == Some(component) || group.members.iter().any(own));
        let Some(index) = concerned else {
            return Ok(());
        };
        match ProbeAction::of(target) {
            ProbeAction::Stop => return Err(self.without_solution(index, time, y, &modes.0)),
            ProbeAction::FlipSide => return self.change_sides(index, time, y, &mut modes.0),
            ProbeAction::Start(_) => {}
        }
        if self.frozen.groups[index].component == Some(component) {
            self.decide_on_group(index, time, y, &mut modes.0)?;
        } else {
            modes.0[component] = target;
        }
        self.frozen.settle_sides(time, y, &mut modes.0);
        Ok(())
    }

    /// Directions of all groups at t = 0: by their speeds, and where they rest by what
    /// they do next. What may start either way is left at rest: the run ends there.
    pub(in crate::dynamics::system) fn settle_directions(&self, y: &mut [f64], modes: &mut [i64]) {
        let frozen = &self.frozen;
        for index in 0..frozen.groups.len() {
            let group = &frozen.groups[index];
            let mut work = Work::new(frozen);
            frozen.motion(0.0, y, modes, Extent::Full, &mut work);
            let speed = work.speed[group.root];
            let size = match group.mass {
                Some((chain, _)) => work.laws[frozen.chains[chain].law].speed.abs(),
                None => 0.0,
            };
            if group.component.is_none() {
                frozen.settle_driven(group, modes, &work);
            } else if speed.abs() > AT_REST * size {
                let forward = speed > 0.0;
                let state = if forward {
                    StickSlip::Forward
                } else {
                    StickSlip::Backward
                };
                frozen.set_out(group, state, modes, &work);
            } else {
                frozen.set_out(group, StickSlip::Stuck, modes, &work);
                // An undetermined start ends the run at once, with its reason.
                let _ = self.decide_on_group(index, 0.0, y, modes);
            }
        }
        self.settle_multi_input_pairs(y, modes);
    }
}

impl Frozen {
    /// Directions of linkages whose motion is given.
    fn settle_driven(&self, group: &Group, modes: &mut [i64], work: &Work<f64>) {
        for member in &group.members {
            let Direction::Own { component, .. } = member.direction else {
                continue;
            };
            let [_, acceleration] = self.member_ratio(member, work.acceleration[group.root], work);
            let direction = match work.speed[member.node] {
                0.0 => sign_of(acceleration),
                speed => speed.signum(),
            };
            modes[component] = direction as i64;
            if let Some(segment) = member.segment {
                modes[segment] = self.segment_towards(member, direction, modes, work);
            }
        }
    }
}
