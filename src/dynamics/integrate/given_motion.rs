//! Legs of systems without coordinates: every motion is given, so that there is
//! nothing to integrate. Breaks and switches are still to be found, and listeners
//! still want steps: the leg is walked in steps of equal length.

use super::run::{Run, Verdict};
use super::{Dynamics, Stop};

/// Steps in a leg where the settings name no longest one.
const STEPS: f64 = 1024.0;

/// Takes the run to its target, or to a switch.
pub(super) fn follow_leg<D: Dynamics>(run: &mut Run<'_, D>) {
    let (start, span) = (run.from.time, run.target - run.from.time);
    let step = run.settings.step.unwrap_or(span / STEPS);
    let step = step.min(run.narrow_step()).min(run.given_longest);
    // A whole number of steps; a rest below a millionth of one is rounding.
    let count = (span / step - 1e-6).ceil().max(run.fewest_steps());
    let step = span / count;
    if step <= 4.0 * f64::EPSILON * start.abs().max(run.target.abs()) {
        run.end(Stop::StepFloor { step });
        return;
    }
    let mut taken = 0.0;
    while taken < count {
        taken += 1.0;
        let time = match taken < count {
            true => start + taken * step,
            false => run.target,
        };
        if end_without_law(run, time) || run.accept_step(time, &[], &[], None) != Verdict::Continue
        {
            return;
        }
    }
}

/// Ends a run at the time, up to `until`, from which on a law of the scene has no value.
fn end_without_law<D: Dynamics>(run: &mut Run<'_, D>, until: f64) -> bool {
    let Some(mut found) = run.evaluator.given_end(until) else {
        return false;
    };
    let [mut before, mut at] = [run.from.time, until];
    loop {
        let middle = 0.5 * (before + at);
        if middle <= before || middle >= at {
            break;
        }
        match run.evaluator.given_end(middle) {
            Some(stop) => (at, found) = (middle, stop),
            None => before = middle,
        }
    }
    if run.accept_step(before, &[], &[], None) == Verdict::Continue {
        run.end(Stop::Physical(found));
    }
    true
}
