//! Where a group stops: does it turn back, go on, or rest? And when does what rests
//! break loose?

use super::force::Moving;
use super::passes::sign_of;
use super::{Direction, Group, HELD, Obstacle, UNSETTLED, UNSOLVED};
use crate::integrate::{Modes, PhysicalStop, Probe};
use crate::linkage::kinetostatics::ForceFailure;
use crate::system::System;
use crate::system::frozen::{Frozen, segment};
use crate::system::passes::{Extent, Work};

/// Friction of what is about to start exceeds that of what has just started by this
/// share, so that nothing stops and starts by rounding.
const EXCESS: f64 = 1e-10;
/// Speeds at t = 0 below this share of what they are the difference of are rest.
const ROUNDING: f64 = 1e-13;
/// Places of a step at which a group at rest is looked at: between them a start is
/// located by bisection.
const LOOKS: usize = 8;

impl Frozen {
    /// What to look for besides the watches: starts of what rests, and motions with
    /// no solution or several.
    pub(in crate::system) fn probes(&self, modes: &[i64], out: &mut Vec<Probe>) {
        for (index, group) in self.groups.iter().enumerate() {
            let mut probe = |component: usize, target: i64, looks: usize| {
                out.push(Probe {
                    index,
                    component,
                    target,
                    looks,
                });
            };
            match group.component {
                Some(component) if modes[component] == HELD => {
                    probe(component, 1, LOOKS);
                    probe(component, -1, LOOKS);
                }
                Some(component) if modes[component] != UNSETTLED => probe(component, UNSOLVED, 1),
                Some(_) => {}
                None => {
                    if let Some(Direction::Own { component, .. }) =
                        group.members.first().map(|member| member.direction)
                    {
                        probe(component, UNSOLVED, 1);
                    }
                }
            }
        }
    }

    /// A probe at a state: positive where it fires.
    pub(in crate::system) fn probe(
        &self,
        probe: &Probe,
        time: f64,
        state: &mut [f64],
        modes: &[i64],
        work: &mut Work<f64>,
    ) -> f64 {
        let group = &self.groups[probe.index];
        if probe.target == UNSOLVED {
            return match self.unsolved(group, time, state, modes, work) {
                Some(_) => 1.0,
                None => -1.0,
            };
        }
        self.stop_root(group, time, state, modes, work);
        let [forwards, backwards] = self.starts(group, time, state, modes, work);
        if probe.target > 0 {
            forwards
        } else {
            backwards
        }
    }

    /// All forces at a state, friction left out.
    fn forces(&self, time: f64, state: &[f64], modes: &[i64], work: &mut Work<f64>) {
        let extent = Extent::Full;
        self.motion(time, state, modes, extent, work);
        self.apply_loads(time, modes, extent, work);
        self.apply_reactions(state, modes, extent, work);
        self.reduce_rigid(extent, work);
    }

    /// Why the motion of a group has no solution, or not just one: the member and
    /// the reason.
    fn unsolved(
        &self,
        group: &Group,
        time: f64,
        state: &[f64],
        modes: &[i64],
        work: &mut Work<f64>,
    ) -> Option<(usize, Obstacle)> {
        self.forces(time, state, modes, work);
        self.rub(state, modes, Extent::Full, work);
        let link = self.link_force(group, state, work);
        for (number, member) in group.members.iter().enumerate() {
            if let Some(failure) = work.rubbing[member.linkage].failure {
                return Some((number, failure));
            }
            let held = work.rubbing[member.linkage].force;
            if held == 0.0 {
                continue;
            }
            let root = match group.component {
                Some(_) => (work.force[group.root] + link) / work.mass[group.root],
                None => work.acceleration[group.root],
            };
            let [ratio, acceleration] = self.along(member, root, work);
            let mobility = match group.component {
                Some(_) => ratio * ratio / work.mass[group.root],
                None => 0.0,
            };
            let direction = match member.direction {
                Direction::OfRoot(sign) => sign * segment(modes, group.component) as f64,
                Direction::Own { component, .. } => modes[component] as f64,
            };
            let direction = if direction == 0.0 {
                sign_of(work.speed[member.node])
            } else {
                direction
            };
            let moving = Moving {
                speed: work.speed[member.node],
                free: acceleration - mobility * held,
                mobility,
                direction,
                segment: segment(modes, member.segment),
            };
            let search = group.component.is_some();
            self.friction(member, &moving, search, work);
            if let Some(failure) = work.rubbing[member.linkage].failure {
                return Some((number, failure));
            }
        }
        None
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
        self.forces(time, state, modes, work);
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
    fn set_out(&self, group: &Group, now: i64, modes: &mut [i64], work: &Work<f64>) {
        if let Some(component) = group.component {
            modes[component] = now;
        }
        if now == HELD {
            return;
        }
        for member in &group.members {
            let [ratio, _] = self.along(member, 0.0, work);
            let direction = match member.direction {
                Direction::OfRoot(sign) => sign * now as f64,
                Direction::Own { component, .. } => {
                    let direction = sign_of(ratio) * now as f64;
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
    pub(in crate::system) fn decide(
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
            (true, false) => 1,
            (false, true) => -1,
            (false, false) => HELD,
            (true, true) => {
                let id = self.rubbing_id(index, 0);
                return Err(PhysicalStop {
                    name: "several_solutions",
                    message: format!(
                        "{id} stands at t = {time:.9} s and may start in either direction: with \
                         the friction of its joints the motion is not determined"
                    ),
                    object: id,
                });
            }
        };
        frozen.set_out(group, now, modes, &work);
        Ok(())
    }

    /// Passes a switch of a direction.
    pub(in crate::system) fn pass_direction(
        &self,
        time: f64,
        y: &mut [f64],
        component: usize,
        target: i64,
        modes: &mut Modes,
    ) -> Result<(), PhysicalStop> {
        let own = |group: &Group| {
            group.members.iter().any(|member| {
                matches!(member.direction, Direction::Own { component: c, .. } if c == component)
            })
        };
        let mut groups = self.frozen.groups.iter();
        let Some(index) = groups.position(|group| group.component == Some(component) || own(group))
        else {
            return Ok(());
        };
        if target == UNSOLVED {
            return Err(self.without_solution(index, time, y, &modes.0));
        }
        if self.frozen.groups[index].component == Some(component) {
            return self.decide(index, time, y, &mut modes.0);
        }
        modes.0[component] = target;
        Ok(())
    }

    /// The end of a run whose motion has no solution or several.
    fn without_solution(&self, index: usize, time: f64, y: &[f64], modes: &[i64]) -> PhysicalStop {
        let mut work = Work::new(&self.frozen);
        let group = &self.frozen.groups[index];
        let found = self.frozen.unsolved(group, time, y, modes, &mut work);
        let (member, failure) = found.unwrap_or((0, Obstacle::Several));
        self.friction_stop(index, member, failure)
    }

    fn rubbing_id(&self, index: usize, member: usize) -> String {
        let object = self.frozen.groups[index].members[member].object;
        self.model.objects[object].id.clone()
    }

    fn friction_stop(&self, index: usize, member: usize, failure: Obstacle) -> PhysicalStop {
        let object = self.rubbing_id(index, member);
        let given = self.frozen.groups[index].coordinate.is_none();
        let (name, message) = match failure {
            Obstacle::Several => (
                "several_solutions",
                format!(
                    "the motion of {object} is not determined: several accelerations agree with \
                     the friction that they cause in its joints (Painlevé)"
                ),
            ),
            Obstacle::Failed(ForceFailure::DeadPosition { .. }) => (
                "self_locking",
                format!("{object} locks: the equations of its motion are singular here"),
            ),
            _ if given => (
                "self_locking",
                format!(
                    "{object} locks: no force of its drive overcomes the friction of its joints"
                ),
            ),
            _ => (
                "self_locking",
                format!(
                    "{object} locks: no acceleration agrees with the friction that it causes in \
                     its joints"
                ),
            ),
        };
        PhysicalStop {
            name,
            object,
            message,
        }
    }

    /// Why the last evaluation gave no numbers, where friction is the reason.
    pub(in crate::system) fn friction_obstacle(&self, work: &Work<f64>) -> Option<PhysicalStop> {
        for (index, group) in self.frozen.groups.iter().enumerate() {
            for (number, member) in group.members.iter().enumerate() {
                match work.rubbing[member.linkage].failure {
                    None | Some(Obstacle::Failed(ForceFailure::NotFinite)) => {}
                    Some(failure) => return Some(self.friction_stop(index, number, failure)),
                }
            }
        }
        None
    }

    /// Directions of all groups at t = 0: by their speeds, and where they rest by what
    /// they do next. What may start either way is left at rest: the run ends there.
    pub(in crate::system) fn settle_directions(&self, y: &mut [f64], modes: &mut [i64]) {
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
            } else if speed.abs() > ROUNDING * size {
                frozen.set_out(group, speed.signum() as i64, modes, &work);
            } else {
                frozen.set_out(group, HELD, modes, &work);
                // An undetermined start ends the run at once, with its reason.
                let _ = self.decide(index, 0.0, y, modes);
            }
        }
    }
}

impl Frozen {
    /// Directions of linkages whose motion is given.
    fn settle_driven(&self, group: &Group, modes: &mut [i64], work: &Work<f64>) {
        for member in &group.members {
            let Direction::Own { component, .. } = member.direction else {
                continue;
            };
            let [_, acceleration] = self.along(member, work.acceleration[group.root], work);
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
