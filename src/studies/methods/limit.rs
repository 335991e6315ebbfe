//! The greatest stable step of a method of fixed step, measured.
//!
//! The step is halved; the middles are moved to the step that was really taken. So it has a
//! search of its own.

use super::attempt::{Attempt, Effort, Problem};
use super::reference::ReferenceInUse;
use super::setting::Setting;
use super::stability::{Bound, SERIES_SLACK};
use super::verdict::{Verdict, axis, judge};
use crate::dynamics::integrate::{Dynamics, Method};
use crate::dynamics::system::System;
use crate::math::roots::try_bisect;
use crate::studies::RunSettings;
use serde::Serialize;

/// The stable and the unstable step are brought this close to each other.
const RATIO: f64 = 1.004;

/// Least number of steps of a run that decides whether a step is stable: what
/// grows by a hundredth a step from rounding is then seen. Shorter scenes go on
/// beyond their end.
const STEPS: f64 = 1500.0;

/// Steps that are tried where no point was unstable, or none stable, in shares
/// of the stable one in theory.
const ABOVE: f64 = 1.3;
const BELOW: f64 = 0.8;

/// A motion that goes on beyond the scene's end has grown when it exceeds the
/// true one within it by this factor.
const GROWN_BEYOND: f64 = 1e3;

/// Steps of a series that are tried, in units of 1/|λ|: the first, the factor to
/// the next, and the farthest.
const FIRST_LEAP: f64 = 0.5;
const COARSE: f64 = 1.05;
const FARTHEST: f64 = 60.0;

/// Most coordinates for which the growth in a step of a series is measured.
const MOST_COORDINATES: usize = 30;

/// True when a point has failed because its step is too long.
pub(super) fn too_long(verdict: Verdict) -> bool {
    matches!(verdict, Verdict::Unstable | Verdict::Chatter)
}

/// The limit of stability of a method on a system.
#[derive(Clone, Debug, PartialEq, Serialize)]
pub struct StabilityLimit {
    /// The eigenvalue that bounds the step, real and imaginary part (1/s), all
    /// pairs engaged; null when theory knows no limit.
    pub eigenvalue: Option<[f64; 2]>,
    /// Place in words.
    pub place: Option<&'static str>,
    /// Greatest |λ|h by theory.
    pub theory: Option<f64>,
    /// Greatest stable step by theory (s).
    pub theory_step: Option<f64>,
    /// Greatest |λ|h at which the motion did not grow; null: not measured.
    pub measured: Option<f64>,
    /// The step at that (s).
    pub measured_step: Option<f64>,
    /// Remark where there is no limit.
    pub remark: Option<&'static str>,
    /// Degree of the series at the accuracy asked for, of a method of power
    /// series; the limits are those of this degree.
    pub degree: Option<usize>,
}

impl StabilityLimit {
    /// Limit as theory has it.
    pub(super) fn by_theory(bound: Option<&Bound>, remark: Option<&'static str>) -> Self {
        Self {
            eigenvalue: bound.map(|bound| bound.eigenvalue),
            place: bound.map(|bound| axis(bound.eigenvalue)),
            theory: bound.map(|bound| bound.limit),
            theory_step: bound.map(Bound::step),
            measured: None,
            measured_step: None,
            remark,
            degree: None,
        }
    }

    /// The same for power series, whose steps the tolerance keeps short: what
    /// is measured is by how much a single step multiplies a deviation.
    pub(super) fn of_series(system: &System, bound: Option<&Bound>, degree: usize) -> Self {
        let mut limit = Self::by_theory(bound, None);
        limit.degree = Some(degree);
        limit.measured_step = bound.and_then(|bound| stable_leap(system, degree, bound.rate()));
        let measured = bound.zip(limit.measured_step);
        limit.measured = measured.map(|(bound, step)| bound.rate() * step);
        limit
    }

    /// Adds what is measured: the steps between the greatest stable and the
    /// least unstable one tried so far are halved until they meet. `tried`: the
    /// longest step taken, and whether the motion grew.
    pub(super) fn measure(
        &mut self,
        problem: &Problem<'_>,
        method: Method,
        truth: &ReferenceInUse,
        bound: Option<&Bound>,
        tried: &[(f64, bool)],
        effort: &Effort<'_>,
    ) {
        let unstable = tried.iter().filter(|(_, grew)| *grew);
        let high = unstable.map(|(step, _)| *step).reduce(f64::min);
        let below = high.unwrap_or(f64::INFINITY);
        let stable = tried.iter().filter(|(step, grew)| !*grew && *step < below);
        let low = stable.map(|(step, _)| *step).reduce(f64::max);
        // What the points do not enclose is looked for beside the theory.
        let beside = |factor: f64, wanted: bool| {
            let step = factor * bound?.step();
            let (taken, grew) = try_step(problem, method, truth, bound, step, effort)?;
            (grew == wanted).then_some(taken)
        };
        let high = high.or_else(|| beside(ABOVE, true));
        let low = low.or_else(|| beside(BELOW, false));
        let (Some(mut high), Some(mut low)) = (high, low) else {
            return;
        };
        while high > RATIO * low {
            let middle = (low * high).sqrt();
            let Some((taken, grew)) = try_step(problem, method, truth, bound, middle, effort)
            else {
                return;
            };
            // The step that was really taken: a whole number of them fits the run.
            let taken = if taken > low && taken < high {
                taken
            } else {
                middle
            };
            if grew {
                high = taken;
            } else {
                low = taken;
            }
        }
        self.measured_step = Some(low);
        self.measured = bound.map(|bound| bound.rate() * low);
    }
}

/// The greatest step at which a series of a degree multiplies no deviation: the
/// end of those from zero on, found without the theory from the rate of the
/// system alone.
fn stable_leap(system: &System, degree: usize, rate: f64) -> Option<f64> {
    if Dynamics::coordinates(system) > MOST_COORDINATES {
        return None;
    }
    let grows = |step: f64| Some(system.growth_in_step(degree, step)? > 1.0 + SERIES_SLACK);
    let mut low = FIRST_LEAP / rate;
    if grows(low)? {
        return None;
    }
    let mut high = COARSE * low;
    while !grows(high)? {
        (low, high) = (high, COARSE * high);
        if high * rate > FARTHEST {
            return None;
        }
    }
    // As ratios, until the two are within `RATIO` of each other.
    let halvings = (COARSE.ln() / RATIO.ln()).log2().ceil() as u32;
    let ends = [low.ln(), high.ln()];
    let found = try_bisect(ends, halvings, 0.0, |step| Some(!grows(step.exp())?));
    found.ok().map(|[stable, _]| stable.exp())
}

/// Runs with a step: the longest one taken, and whether the motion grew.
/// `None`: interrupted, or out of time.
fn try_step(
    problem: &Problem<'_>,
    method: Method,
    truth: &ReferenceInUse,
    bound: Option<&Bound>,
    step: f64,
    effort: &Effort<'_>,
) -> Option<(f64, bool)> {
    let duration = problem.settings.duration;
    let longer = RunSettings {
        duration: duration.max(STEPS * step),
        ..problem.settings.clone()
    };
    let goes_on = longer.duration > duration;
    let problem = Problem {
        settings: &longer,
        ..*problem
    };
    let attempt = Attempt::light(&problem, method, Setting::Step(step), effort);
    let judged = judge(&attempt, Some(truth), 1.0, bound);
    if attempt.was_interrupted() || judged.verdict == Verdict::TimeLimit {
        return None;
    }
    let grew = match goes_on {
        true => !attempt.has_ended_well() || judged.growth.is_some_and(|g| g > GROWN_BEYOND),
        false => too_long(judged.verdict),
    };
    let taken = attempt.timed.as_ref()?.trace.longest_step;
    Some((taken, grew))
}
