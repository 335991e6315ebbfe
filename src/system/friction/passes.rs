//! Friction within an evaluation: after the forces, before the accelerations.

use super::{Direction, Group, HELD, Member, Obstacle, UNSETTLED};
use crate::linkage::kinetostatics::{ForceFailure, Options, Resisted};
use crate::system::frozen::{Frozen, segment};
use crate::system::passes::{Extent, Work};
use crate::system::quantity::Quantity;

/// Friction is found to rounding: the equations of motion are differentiated.
const TOLERANCE: f64 = 1e-14;
/// Rounds over the linkages of a group at most, and what they may still change.
const ROUNDS: usize = 200;
const SETTLED: f64 = 1e-14;
/// Steps of differences: of the position in the linkage's own lengths, and of the speed,
/// relative.
const STEP: f64 = 1e-5;

/// How a linkage moves in one question.
#[derive(Clone, Copy, Debug)]
pub(super) struct Moving<N> {
    /// Speed of its input.
    pub(super) speed: N,
    /// Acceleration of its input without its own friction.
    pub(super) free: N,
    /// ∂q̈/∂T.
    pub(super) mobility: N,
    /// Direction, −1 or 1.
    pub(super) direction: f64,
    /// Segment of its course.
    pub(super) segment: i64,
}

pub(super) fn options(search: bool) -> Options {
    Options {
        tolerance: TOLERANCE,
        search,
        ..Options::default()
    }
}

impl Frozen {
    /// Adds the friction of all joints to the forces, along with what it hands on
    /// to the drivers.
    pub(in crate::system) fn rub<N: Quantity>(
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
            match group.component.map(|component| modes[component]) {
                // A given motion is not changed; what drives it is.
                None if extent == Extent::Full => self.rub_driven(group, modes, work),
                None | Some(UNSETTLED) => {}
                Some(HELD) => self.hold(group, state, modes, extent, work),
                Some(_) => self.rub_moving(group, state, modes, work),
            }
        }
    }

    /// Power lost to friction in every object that has any (W).
    pub(in crate::system) fn friction_losses<'a>(
        &'a self,
        modes: &'a [i64],
        work: &'a Work<f64>,
    ) -> impl Iterator<Item = (usize, f64)> + 'a {
        self.groups.iter().flat_map(move |group| {
            let held = group.component.is_some_and(|c| modes[c] == HELD);
            group.members.iter().map(move |member| {
                let force = work.rubbing[member.linkage].force;
                let loss = 0.0 - force * work.speed[member.node];
                (member.object, if held { 0.0 } else { loss })
            })
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
    pub(super) fn along<N: Quantity>(&self, member: &Member, root: N, work: &Work<N>) -> [N; 2] {
        let (mut ratio, mut acceleration) = (N::from(1.0), root);
        for &law in &member.path {
            let values = &work.laws[law];
            ratio = ratio * values.first;
            acceleration = values.first * acceleration + values.bias;
        }
        [ratio, acceleration]
    }

    /// Direction of a linkage's input in the present modes, its root moving in
    /// `root`; 0 where it is not known.
    fn direction_of(member: &Member, root: f64, modes: &[i64]) -> f64 {
        match member.direction {
            Direction::OfRoot(sign) => sign * root,
            Direction::Own { component, .. } => modes[component] as f64,
        }
    }

    /// Friction of a group that moves: T of every linkage with the acceleration
    /// that they leave together.
    fn rub_moving<N: Quantity>(
        &self,
        group: &Group,
        state: &[N],
        modes: &[i64],
        work: &mut Work<N>,
    ) {
        let root = segment(modes, group.component) as f64;
        let link = self.link_force(group, state, work);
        let mass = work.mass[group.root];
        let alone = group.members.len() == 1;
        let mut left = if alone { 1 } else { ROUNDS };
        let mut extra = None;
        while left > 0 {
            left -= 1;
            let mut change = 0.0f64;
            let mut size = 0.0f64;
            for member in group.members.iter().rev() {
                let now = (work.force[group.root] + link) / mass;
                let [ratio, acceleration] = self.along(member, now, work);
                let mobility = ratio * ratio / mass;
                let before = work.rubbing[member.linkage].force;
                let direction = match Self::direction_of(member, root, modes) {
                    0.0 => sign_of(ratio.value()) * root,
                    direction => direction,
                };
                let moving = Moving {
                    speed: work.speed[member.node],
                    free: acceleration - mobility * before,
                    mobility,
                    direction,
                    segment: segment(modes, member.segment),
                };
                let force = self.friction(member, &moving, false, work);
                work.rubbing[member.linkage].force = force;
                self.push(member, force - before, work);
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

    /// A group that friction holds: no force is left on its root.
    fn hold<N: Quantity>(
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
            self.share_hold(group, -missing.value(), modes, work);
        }
        work.force[group.root] = -link;
    }

    /// What holds a group, handed out to its linkages in the proportion of what they
    /// can hold at most: their parts are not determined.
    fn share_hold<N: Quantity>(&self, group: &Group, hold: f64, modes: &[i64], work: &mut Work<N>) {
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
                    let [ratio, _] = self.along(member, N::from(0.0), work);
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
            let [ratio, _] = self.along(member, N::from(0.0), work);
            let direction = match member.direction {
                Direction::OfRoot(sign) => sign * root,
                Direction::Own { .. } => sign_of(ratio.value()) * root,
            };
            let zero = N::from(0.0);
            let moving = Moving {
                speed: zero,
                free: zero,
                mobility: zero,
                direction,
                segment: self.segment_towards(member, direction, modes, work),
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

    /// Friction of linkages whose motion is given: it only loads the drive.
    fn rub_driven<N: Quantity>(&self, group: &Group, modes: &[i64], work: &mut Work<N>) {
        let root = work.acceleration[group.root];
        for member in group.members.iter().rev() {
            let [_, free] = self.along(member, root, work);
            let speed = work.speed[member.node];
            let direction = match (Self::direction_of(member, 0.0, modes), speed.value()) {
                // In a dwell friction may be anything up to its limit: none is told.
                (_, 0.0) if free.value() == 0.0 => continue,
                (0.0, 0.0) => sign_of(free.value()),
                (0.0, speed) => speed.signum(),
                (direction, _) => direction,
            };
            let moving = Moving {
                speed,
                free,
                mobility: N::from(0.0),
                direction,
                segment: segment(modes, member.segment),
            };
            let force = self.friction(member, &moving, false, work);
            work.rubbing[member.linkage].force = force;
            self.push(member, force, work);
        }
    }

    /// T of one linkage, with its derivatives; not a number, and the reason in
    /// `work`, where there is none (or, where others are searched for, several).
    pub(super) fn friction<N: Quantity>(
        &self,
        member: &Member,
        moving: &Moving<N>,
        search: bool,
        work: &mut Work<N>,
    ) -> N {
        let options = options(search);
        let q = work.displacement[member.node];
        let Work {
            rubbing,
            linkages,
            force,
            mass,
            ..
        } = work;
        let own = &mut rubbing[member.linkage];
        let (Some(forces), Some(beside)) = (&mut own.forces, &mut own.beside) else {
            return N::from(f64::NAN);
        };
        for (k, &node) in member.outputs.iter().enumerate() {
            own.loads[k] = force[node].value();
            own.inertias[k] = mass[node].value();
        }
        let asked = Resisted {
            coordinate: q.value(),
            speed: moving.speed.value(),
            free_acceleration: moving.free.value(),
            mobility: moving.mobility.value(),
            loads: &own.loads,
            inertias: &own.inertias,
            direction: moving.direction,
            senses: member.reversals.at(moving.segment),
        };
        let solver = &member.kinetostatics;
        let mut solved = linkages[member.linkage].borrow_mut();
        let Some(at) = solved.placed(q.value(), 2) else {
            return N::from(f64::NAN);
        };
        let found = match solver.resist(at, &asked, &options, forces) {
            Ok(found) if !search || found.solutions == 1 => found,
            Ok(_) => {
                own.failure = Some(Obstacle::Several);
                return N::from(f64::NAN);
            }
            Err(failure) => {
                own.failure = Some(Obstacle::Failed(failure));
                return N::from(f64::NAN);
            }
        };
        let mut sum = N::from(found.force);
        if N::DERIVATIVES <= 2 {
            return sum;
        }
        let mut add = |value: N, slope: f64| {
            sum += (value - N::from(value.value())).scale(slope);
        };
        let by_free = solver.resistance_slopes(forces, &mut own.by_loads);
        add(moving.free, by_free);
        add(moving.mobility, by_free * found.force);
        for (k, &node) in member.outputs.iter().enumerate() {
            add(force[node], own.by_loads[k]);
            let acceleration = solver.output_acceleration(k, forces);
            add(mass[node], -own.by_loads[k] * acceleration);
        }
        let linkage = &self.linkages[member.linkage].linkage;
        let step = STEP * solver.coordinate_scale();
        let mut at_place = |place: f64| {
            linkage.solve(place, 2, beside).ok()?;
            let asked = Resisted {
                coordinate: place,
                ..asked
            };
            let found = solver.resist(&*beside, &asked, &options, forces).ok()?;
            Some(found.force)
        };
        let by_place = slope(q.value(), step, found.force, &mut at_place);
        add(q, by_place);
        let rates = asked.speed.abs().max(asked.free_acceleration.abs().sqrt());
        let mut at_speed = |speed: f64| {
            let asked = Resisted { speed, ..asked };
            let found = solver.resist(at, &asked, &options, forces).ok()?;
            Some(found.force)
        };
        let by_speed = match rates {
            0.0 => 0.0,
            rates => slope(asked.speed, STEP * rates, found.force, &mut at_speed),
        };
        add(moving.speed, by_speed);
        sum
    }
}

/// Derivative of a function by a central difference, one-sided where it does not
/// exist on both sides.
fn slope(x: f64, step: f64, here: f64, f: &mut impl FnMut(f64) -> Option<f64>) -> f64 {
    match (f(x + step), f(x - step)) {
        (Some(above), Some(below)) => (above - below) / (2.0 * step),
        (Some(above), None) => (above - here) / step,
        (None, Some(below)) => (here - below) / step,
        (None, None) => f64::NAN,
    }
}

/// The sign of a number, 1 for zero.
pub(super) fn sign_of(x: f64) -> f64 {
    if x < 0.0 { -1.0 } else { 1.0 }
}
