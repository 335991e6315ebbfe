//! The friction of one linkage as a force on its input, with its derivatives.

use super::{Member, Obstacle};
use crate::dynamics::system::frozen::Frozen;
use crate::dynamics::system::passes::Work;
use crate::kinematics::linkage::kinetostatics::{Options, ResistanceModel};
use crate::math::quantity::Quantity;

/// Friction is found to rounding: the equations of motion are differentiated.
const TOLERANCE: f64 = 1e-14;
/// Steps of differences: of the position in the linkage's own lengths, and of the
/// speed, relative.
pub(super) const STEP: f64 = 1e-5;

/// Motion of a linkage in one question.
#[derive(Clone, Copy, Debug)]
pub(super) struct LinkageMotion<N> {
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
    /// Sides on which the corners of its blocks press, where they are given.
    pub(super) pressed: Option<u64>,
}

pub(super) fn solver_options(search: bool) -> Options {
    Options {
        tolerance: TOLERANCE,
        search,
        ..Options::default()
    }
}

impl Frozen {
    /// T of one linkage, with its derivatives; not a number, and the reason in
    /// `work`, where there is none (or, where others are searched for, several).
    pub(super) fn friction<N: Quantity>(
        &self,
        member: &Member,
        moving: &LinkageMotion<N>,
        search: bool,
        work: &mut Work<N>,
    ) -> N {
        let options = solver_options(search);
        // What is searched for presses on any side.
        let pressed = moving.pressed.filter(|_| !search);
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
        let asked = ResistanceModel {
            coordinate: q.value(),
            speed: moving.speed.value(),
            free_acceleration: moving.free.value(),
            mobility: moving.mobility.value(),
            loads: &own.loads,
            inertias: &own.inertias,
            direction: moving.direction,
            senses: member.reversals.at(moving.segment),
            pressed,
        };
        let solver = &member.kinetostatics;
        let mut solved = linkages[member.linkage].borrow_mut();
        let Some(at) = solved.place_linkage(q.value(), 2) else {
            return N::from(f64::NAN);
        };
        let found = match solver.resist(at, &asked, &options, forces) {
            Ok(found) if !search || found.unique => found,
            Ok(found) => {
                own.failure = Some(match found.solutions {
                    1 => Obstacle::Unproved,
                    _ => Obstacle::Several,
                });
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
            let asked = ResistanceModel {
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
            let asked = ResistanceModel { speed, ..asked };
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
pub(super) fn slope(x: f64, step: f64, here: f64, f: &mut impl FnMut(f64) -> Option<f64>) -> f64 {
    match (f(x + step), f(x - step)) {
        (Some(above), Some(below)) => (above - below) / (2.0 * step),
        (Some(above), None) => (above - here) / step,
        (None, Some(below)) => (here - below) / step,
        (None, None) => f64::NAN,
    }
}
