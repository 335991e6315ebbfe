//! The guards of loads by expressions: where they change on a step, and what a change
//! does.

use super::{FrozenExpression, Input};
use crate::dynamics::integrate::{EventFunction, Guard, Modes, PhysicalStop, UndecidedGuard};
use crate::dynamics::model::Load;
use crate::dynamics::system::System;
use crate::dynamics::system::frozen::Frozen;
use crate::dynamics::system::passes::{Extent, Work};
use crate::math::expression::{Interval, OPEN, RateBounds, Stretch, Third, VARIABLES, change_mode};
use crate::math::jet::Jet;
use crate::math::number::Dual;
use crate::math::polynomial::{MAX_DEGREE, Step, divide};
use crate::units::shown;

/// A rate that drives a guard back by less than this share of the rate at which it came
/// is taken for none.
const TURNED_BACK: f64 = 1e-9;

/// The variables of a load along a step.
pub(in crate::dynamics::system) struct Along<'a> {
    pub(in crate::dynamics::system) written: &'a FrozenExpression,
    pub(in crate::dynamics::system) step: &'a Step<'a>,
}

impl Stretch for Along<'_> {
    fn at(&self, s: f64, out: &mut [f64]) {
        for (out, input) in out.iter_mut().zip(&self.written.inputs) {
            *out = match *input {
                Input::Time => self.step.time(s),
                Input::Displacement { signal, .. } if signal != usize::MAX => {
                    self.step.value(signal, s).0
                }
                Input::Speed { signal, .. } if signal != usize::MAX => self.step.value(signal, s).1,
                _ => 0.0,
            };
        }
    }

    fn over(&self, from: f64, to: f64, out: &mut [RateBounds]) {
        let length = self.step.length;
        for (out, input) in out.iter_mut().zip(&self.written.inputs) {
            *out = match *input {
                Input::Time => RateBounds {
                    value: Interval::between(self.step.time(from), self.step.time(to)),
                    rate: Interval::of(length),
                },
                Input::Displacement { signal, .. } if signal != usize::MAX => {
                    let [value, rate, _] = bounds(self.step, signal, from, to);
                    RateBounds { value, rate }
                }
                Input::Speed { signal, .. } if signal != usize::MAX => {
                    let [_, value, rate] = bounds(self.step, signal, from, to);
                    let per_second =
                        |one: Interval| Interval::between(one.low / length, one.high / length);
                    RateBounds {
                        value: per_second(value),
                        rate: per_second(rate),
                    }
                }
                _ => *out,
            };
        }
    }
}

/// Bounds of a signal, of its derivative by s and of its second, between two places:
/// the coefficients in Bernstein form of that part.
fn bounds(step: &Step<'_>, signal: usize, from: f64, to: f64) -> [Interval; 3] {
    let degree = step.degree;
    let mut rest = [0.0; MAX_DEGREE + 1];
    let mut left = [0.0; MAX_DEGREE + 1];
    rest[..=degree].copy_from_slice(step.differences(signal));
    if from > 0.0 {
        divide(&mut left[..=degree], &mut rest[..=degree], from);
    }
    if to < 1.0 {
        let share = (to - from) / (1.0 - from);
        divide(&mut left[..=degree], &mut rest[..=degree], share);
        rest = left;
    }
    let width = to - from;
    let hull = |row: &[f64], factor: f64, base: f64| {
        let low = row.iter().copied().fold(f64::INFINITY, f64::min);
        let high = row.iter().copied().fold(f64::NEG_INFINITY, f64::max);
        Interval::between(base + factor * low, base + factor * high)
    };
    let mut found = [Interval::of(0.0); 3];
    found[0] = hull(&rest[..=degree], 1.0, step.bases[signal]);
    let mut factor = 1.0;
    for (order, found) in found.iter_mut().enumerate().skip(1) {
        if order > degree {
            break;
        }
        let count = degree + 1 - order;
        for k in 0..count {
            rest[k] = rest[k + 1] - rest[k];
        }
        factor *= count as f64 / width;
        *found = hull(&rest[..count], factor, 0.0);
    }
    found
}

impl FrozenExpression {
    /// The component of the modes of a guard.
    fn components(&self) -> std::ops::Range<usize> {
        self.component..self.component + self.expression.program().guards.len()
    }

    /// Value and rate of a guard at a motion whose accelerations are known.
    fn value_and_rate_of_guard(
        &self,
        guard: usize,
        time: f64,
        modes: &[i64],
        work: &Work<f64>,
    ) -> Dual {
        let mut values = [Dual::from(0.0); VARIABLES];
        for (value, input) in values.iter_mut().zip(&self.inputs) {
            *value = match *input {
                Input::Unused => Dual::from(0.0),
                Input::Time => Dual::new(time, 1.0),
                Input::Displacement { node, .. } => {
                    Dual::new(work.displacement[node], work.speed[node])
                }
                Input::Speed { node, .. } => Dual::new(work.speed[node], work.acceleration[node]),
            };
        }
        let modes = |own: u16| modes[self.component + usize::from(own)];
        self.expression.program().guards[guard]
            .code
            .evaluate(&values, &modes)
    }

    /// The first of the higher derivatives of a guard that is not zero, as far as the motion
    /// tells them: its sign just behind where it and its rate are zero, whatever the unit of
    /// time.
    fn first_nonzero_derivative(
        &self,
        guard: usize,
        time: f64,
        modes: &[i64],
        work: &Work<f64>,
    ) -> f64 {
        let third = |value: f64, first: f64, second: f64| {
            Third(Jet {
                value,
                first,
                second,
                third: 0.0,
            })
        };
        let mut values = [third(0.0, 0.0, 0.0); VARIABLES];
        for (value, input) in values.iter_mut().zip(&self.inputs) {
            *value = match *input {
                Input::Unused => *value,
                Input::Time => third(time, 1.0, 0.0),
                Input::Displacement { node, .. } => third(
                    work.displacement[node],
                    work.speed[node],
                    work.acceleration[node],
                ),
                Input::Speed { node, .. } => third(work.speed[node], work.acceleration[node], 0.0),
            };
        }
        let modes = |own: u16| modes[self.component + usize::from(own)];
        let code = &self.expression.program().guards[guard].code;
        let Third(bend) = code.evaluate(&values, &modes);
        match bend.second == 0.0 {
            true => bend.third,
            false => bend.second,
        }
    }
}

impl System {
    /// Leaves every condition of a load by an expression to its operands: where the motion is
    /// known in closed form nothing locates their edges.
    pub(crate) fn open_guards(&self, modes: &mut Modes) {
        modes.0[self.frozen.first_guard()..].fill(OPEN);
    }
}

impl Frozen {
    /// The component of the modes of the first guard.
    pub(in crate::dynamics::system) fn first_guard(&self) -> usize {
        self.contacts() + self.tracks.len() + self.directions
    }

    /// The loads by expressions.
    pub(in crate::dynamics::system) fn expression_loads(
        &self,
    ) -> impl Iterator<Item = &FrozenExpression> {
        self.loads.iter().filter_map(|load| load.written.as_ref())
    }

    /// Sets every guard to the mode in which the motion at `time` goes on.
    pub(in crate::dynamics::system) fn locate_guards(
        &self,
        time: f64,
        state: &[f64],
        modes: &mut [i64],
    ) {
        if self.guards == 0 {
            return;
        }
        modes[self.first_guard()..].fill(OPEN);
        let mut work = Work::new(self);
        let mut out = vec![0.0; self.coordinates];
        self.evaluate(time, state, modes, Extent::Full, &mut work, &mut out);
        for written in self.expression_loads() {
            let guards = &written.expression.program().guards;
            for (index, component) in written.components().enumerate() {
                let at = written.value_and_rate_of_guard(index, time, modes, &work);
                let rate = match at.derivative == 0.0 && at.value == 0.0 {
                    true => written.first_nonzero_derivative(index, time, modes, &work),
                    false => at.derivative,
                };
                modes[component] = guards[index].mode_at(at.value, rate);
            }
        }
    }

    /// The guards that are zero with their rates, up to errors of the entries of a state.
    pub(in crate::dynamics::system) fn undecided_guards(
        &self,
        time: f64,
        state: &[f64],
        modes: &[i64],
        errors: &[f64],
    ) -> Vec<UndecidedGuard> {
        if self.guards == 0 {
            return Vec::new();
        }
        let mut work = Work::new(self);
        let mut out = vec![0.0; self.coordinates];
        let mut values = |state: &[f64]| -> Vec<(usize, Dual)> {
            self.evaluate(time, state, modes, Extent::Full, &mut work, &mut out);
            let of = |written: &FrozenExpression| {
                let components = written.components().enumerate();
                let guards = components.filter(|&(_, component)| modes[component] != OPEN);
                let values = guards.map(|(guard, own)| {
                    (
                        own,
                        written.value_and_rate_of_guard(guard, time, modes, &work),
                    )
                });
                values.collect::<Vec<_>>()
            };
            self.expression_loads().flat_map(of).collect()
        };
        let now = values(state);
        let mut floors = vec![0.0; now.len()];
        let mut moved = state.to_vec();
        for (index, error) in errors.iter().enumerate() {
            moved[index] = state[index] + error;
            for ((floor, (_, there)), (_, here)) in floors.iter_mut().zip(values(&moved)).zip(&now)
            {
                *floor += (there.value - here.value).abs();
            }
            moved[index] = state[index];
        }
        let pairs = now.iter().zip(floors);
        let undecided =
            pairs.filter(|((_, at), floor)| floor.is_finite() && at.value.abs() < *floor);
        let resting = undecided.map(|(&(component, at), floor)| UndecidedGuard {
            component,
            floor,
            rate: at.derivative,
        });
        resting.collect()
    }

    /// The first switch of a guard on a step, up to `end`.
    pub(in crate::dynamics::system) fn first_guard_crossing(
        &self,
        step: &Step<'_>,
        modes: &[i64],
        end: f64,
        fresh: bool,
        resting: &[UndecidedGuard],
    ) -> Option<(f64, EventFunction)> {
        let mut first: Option<(f64, EventFunction)> = None;
        for written in self.expression_loads() {
            let along = Along { written, step };
            let of_guard = |own: u16| modes[written.component + usize::from(own)];
            let guards = &written.expression.program().guards;
            for (guard, component) in guards.iter().zip(written.components()) {
                let mode = modes[component];
                if mode == OPEN {
                    continue;
                }
                let end = first.as_ref().map_or(end, |first| first.0);
                let rests = resting.iter().find(|own| own.component == component);
                let floor = rests.map_or(0.0, |own| own.floor);
                let found = guard.first_crossing(mode, &of_guard, &along, end, (fresh, floor));
                let Some(found) = found else { continue };
                if first.as_ref().is_some_and(|first| first.0 <= found.s) {
                    continue;
                }
                let watch = EventFunction {
                    guards: [Guard::default(); 2],
                    rising: true,
                    component,
                    target: found.target,
                };
                first = Some((found.s, watch));
            }
        }
        first
    }
}

impl System {
    /// The loads whose guards are components of the modes, with those components.
    pub(crate) fn guards_of_loads(&self) -> Vec<(&Load, std::ops::Range<usize>)> {
        let varying = |load: &&Load| load.law.as_constant().is_none();
        let loads = self.model.loads.iter().filter(varying);
        let guarded = loads.zip(&self.frozen.loads).filter_map(|(load, frozen)| {
            let components = frozen.written.as_ref()?.components();
            (!components.is_empty()).then_some((load, components))
        });
        guarded.collect()
    }

    /// A guard of a load changes.
    ///
    /// # Errors
    /// The load jumps so that the motion can go on on neither side.
    pub(in crate::dynamics::system) fn pass_guard(
        &self,
        time: f64,
        y: &[f64],
        watch: &EventFunction,
        modes: &mut [i64],
    ) -> Result<(), PhysicalStop> {
        let frozen = &self.frozen;
        let component = watch.component;
        let Some((index, load)) = self.load_of_guard(component) else {
            return Ok(());
        };
        let Some(written) = frozen.loads[index].written.as_ref() else {
            return Ok(());
        };
        let guard = component - written.component;
        let mut work = Work::new(frozen);
        let mut out = vec![0.0; frozen.coordinates];
        let mut all = modes.to_vec();
        let at = |guard: usize, own: &[i64]| {
            all[written.components()].copy_from_slice(own);
            frozen.evaluate(time, y, &all, Extent::Full, &mut work, &mut out);
            written.value_and_rate_of_guard(guard, time, &all, &work)
        };
        let sense = (watch.target - modes[component]).signum() as f64;
        let guards = &written.expression.program().guards;
        let own = &mut modes[written.components()];
        let [came, goes] = change_mode(guards, guard, watch.target, own, at);
        let (came, goes) = (came.derivative, goes.derivative);
        if sense * came > 0.0 && sense * goes < -TURNED_BACK * came.abs() {
            return Err(self.held_at_jump(time, load));
        }
        frozen.open_sides(modes);
        frozen.settle_sides(time, y, modes);
        Ok(())
    }

    /// The load that a guard belongs to, in the layout and in the model.
    fn load_of_guard(&self, component: usize) -> Option<(usize, usize)> {
        let holds = |written: &FrozenExpression| written.components().contains(&component);
        let loads = &self.frozen.loads;
        let index = loads
            .iter()
            .position(|load| load.written.as_ref().is_some_and(holds))?;
        // Constant loads have no place of their own in the layout.
        let loads = &self.model.loads;
        let mut varying = (0..loads.len()).filter(|&load| loads[load].law.as_constant().is_none());
        Some((index, varying.nth(index)?))
    }

    /// The stop of a motion that a jump of a load drives back from both sides.
    fn held_at_jump(&self, time: f64, load: usize) -> PhysicalStop {
        let load = &self.model.loads[load];
        let id = load.name.split('.').next().unwrap_or_default().to_owned();
        PhysicalStop {
            name: "held_at_jump",
            message: format!(
                "{} jumps at t = {} s so that it drives the motion back from both sides. No \
                 motion goes on from there by this expression. For dry friction give a load \
                 `friction`, or a slope in place of the jump: tanh(phi_dot/0.001)",
                load.name,
                shown(time, 9)
            ),
            object: id,
        }
    }
}
