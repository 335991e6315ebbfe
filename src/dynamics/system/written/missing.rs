//! Loads by expressions where they have no finite value: the run ends there, for the law of
//! the scene does.

use super::switches::Along;
use super::{FrozenExpression, Input};
use crate::dynamics::builder::written::variable_name;
use crate::dynamics::integrate::PhysicalStop;
use crate::dynamics::model::Load;
use crate::dynamics::system::System;
use crate::dynamics::system::passes::Work;
use crate::math::expression::{Interval, Program, RateBounds, Scalar, Stretch, VARIABLES};
use crate::math::polynomial::Step;
use crate::units::shown;

/// Digits of times and arguments in messages.
const DIGITS: usize = 9;
/// Roundings of an argument within which a pole counts as met.
const ROUNDINGS: f64 = 16.0 * f64::EPSILON;
/// Share of a step to which a pole is located.
const NARROW: f64 = 1e-12;
/// Most stretches of a step that are bounded to locate one.
const STRETCHES: usize = 400;
/// Room for stretches that wait, as many as a step can be halved, and some.
const DEPTH: usize = 48;
/// A pole is compared at so many narrow stretches from it …
const NEAR: f64 = 32.0;
/// … with so many times farther away, …
const AWAY: f64 = 1e4;
/// … whence it grows by more than this.
const GROWS: f64 = 30.0;

impl FrozenExpression {
    /// The values of its variables where the motion is known.
    fn arguments(&self, time: f64, work: &Work<f64>) -> [f64; VARIABLES] {
        self.values(time, &work.displacement, &work.speed)
    }

    /// True where it is beyond bounds for arguments that are known to within bounds.
    fn is_unbounded(&self, arguments: &[RateBounds], modes: &[i64]) -> bool {
        let own = |guard: u16| modes[self.component + usize::from(guard)];
        let code = &self.expression.program().value;
        let Interval { low, high } = code.evaluate(arguments, &own).value;
        !(low.is_finite() && high.is_finite())
    }

    /// The first place of a step, up to `end`, towards which it grows without bound.
    fn pole(&self, along: &Along<'_>, modes: &[i64], end: f64) -> Option<f64> {
        let still = RateBounds::number(0.0);
        // (Each halving leaves one stretch that waits.)
        let (mut waiting, mut count) = ([[0.0, end]; DEPTH], 1);
        for _ in 0..STRETCHES {
            count = usize::checked_sub(count, 1)?;
            let [from, to] = waiting[count];
            let mut bounds = [still; VARIABLES];
            along.over(from, to, &mut bounds);
            if !self.is_unbounded(&bounds, modes) {
                continue;
            }
            if to - from <= NARROW {
                if self.grows_towards(0.5 * (from + to), along, modes, end) {
                    return Some(from);
                }
                continue;
            }
            let middle = 0.5 * (from + to);
            waiting[count] = [middle, to];
            waiting[count + 1] = [from, middle];
            count += 2;
        }
        None
    }

    /// Whether it grows towards a place of a step; what is only not told at the place
    /// itself, sin(phi)/phi, does not.
    fn grows_towards(&self, place: f64, along: &Along<'_>, modes: &[i64], end: f64) -> bool {
        let size = |s: f64| {
            let mut values = [0.0; VARIABLES];
            along.at(s, &mut values);
            self.at(&values, modes).abs()
        };
        [-1.0, 1.0].into_iter().any(|side| {
            let [close, away] = [NEAR, AWAY * NEAR].map(|narrow| place + side * narrow * NARROW);
            let within = (0.0..=end).contains(&away);
            within && size(close) > GROWS * size(away) && size(away) > 0.0
        })
    }
}

/// True of an expression that may grow without bound at a finite place.
pub(super) fn may_have_poles(program: &Program) -> bool {
    program.value.ops().iter().any(|op| op.may_have_poles())
}

impl System {
    /// The loads by expressions, with their place in the layout.
    fn written_loads(&self) -> impl Iterator<Item = (&Load, &FrozenExpression)> {
        // Constant loads have no place of their own in the layout.
        let varying = |load: &&Load| load.law.as_constant().is_none();
        let loads = self.model.loads.iter().filter(varying);
        let pairs = loads.zip(&self.frozen.loads);
        pairs.filter_map(|(load, frozen)| Some((load, frozen.written.as_ref()?)))
    }

    /// The end of a run at a motion, evaluated last, at which a load has no finite value.
    pub(in crate::dynamics::system) fn without_value(
        &self,
        time: f64,
        modes: &[i64],
        work: &Work<f64>,
    ) -> Option<PhysicalStop> {
        self.written_loads().find_map(|(load, written)| {
            let arguments = written.arguments(time, work);
            let known = arguments.iter().all(|argument| argument.is_finite());
            let valueless = known && !written.force(time, modes, work).is_finite();
            valueless.then(|| ends(load, written, time, &arguments))
        })
    }

    /// The end of a run that comes to a pole of a load within `reach` (s) of a motion.
    pub(in crate::dynamics::system) fn at_pole(
        &self,
        [time, reach]: [f64; 2],
        modes: &[i64],
        work: &Work<f64>,
    ) -> Option<PhysicalStop> {
        self.written_loads().find_map(|(load, written)| {
            let arguments = written.arguments(time, work);
            let bounds = written.variable_bounds_near([time, reach], work);
            let met = may_have_poles(written.expression.program())
                && written.is_unbounded(&bounds, modes);
            met.then(|| ends(load, written, time, &arguments))
        })
    }

    /// The first pole of a load on a step, up to `end`.
    pub(in crate::dynamics::system) fn poles_on(
        &self,
        step: &Step<'_>,
        modes: &[i64],
        end: f64,
    ) -> Option<PhysicalStop> {
        self.written_loads()
            .filter(|(_, written)| may_have_poles(written.expression.program()))
            .find_map(|(load, written)| {
                let along = Along { written, step };
                let place = written.pole(&along, modes, end)?;
                let mut arguments = [0.0; VARIABLES];
                along.at(place, &mut arguments);
                Some(ends(load, written, step.time(place), &arguments))
            })
    }

    /// True where a load may have a pole.
    pub(in crate::dynamics::system) fn may_meet_poles(&self) -> bool {
        self.frozen
            .expression_loads()
            .any(|written| may_have_poles(written.expression.program()))
    }
}

impl FrozenExpression {
    /// Bounds of its variables within `reach` (s) of a motion.
    fn variable_bounds_near(
        &self,
        [time, reach]: [f64; 2],
        work: &Work<f64>,
    ) -> [RateBounds; VARIABLES] {
        let beside = |value: f64, rate: f64| {
            let width = reach * rate.abs() + ROUNDINGS * value.abs();
            RateBounds {
                value: Interval::between(value - width, value + width),
                rate: Interval::of(0.0),
            }
        };
        let mut bounds = [RateBounds::number(0.0); VARIABLES];
        for (bounds, input) in bounds.iter_mut().zip(&self.inputs) {
            *bounds = match *input {
                Input::Unused => *bounds,
                Input::Time => beside(time, 1.0),
                Input::Displacement { node, .. } => {
                    beside(work.displacement[node], work.speed[node])
                }
                Input::Speed { node, .. } => beside(work.speed[node], work.acceleration[node]),
            };
        }
        bounds
    }
}

fn ends(load: &Load, written: &FrozenExpression, time: f64, arguments: &[f64]) -> PhysicalStop {
    let read = (written.inputs.iter().enumerate())
        .filter(|(_, input)| !matches!(input, Input::Unused | Input::Time))
        .map(|(index, _)| {
            let name = variable_name(index);
            format!(", {name} = {}", shown(arguments[index], DIGITS))
        });
    let at: String = read.collect();
    let object = load.name.split('.').next().unwrap_or_default().to_owned();
    let time = shown(time, DIGITS);
    PhysicalStop {
        name: PhysicalStop::NO_VALUE,
        message: format!(
            "the load {} ends: \"{}\" has no finite value at t = {time} s{at}; write a condition before \
             it (`… ? … : …`) or a shorter `duration`",
            load.name,
            written.expression.text()
        ),
        object,
    }
}
