//! What became of a point, and why.

use super::attempt::Attempt;
use super::light::{TimedRun, Trace};
use super::reference::{ReferenceInUse, difference_of_traces};
use super::stability::Bound;
use crate::dynamics::integrate::Stop;
use crate::studies::spread::CHANGE;
use crate::units::shown;
use serde::Serialize;

/// A scene that multiplies a small difference so many times is named as the
/// cause of an error.
const MULTIPLIES: f64 = 100.0;

/// A deviation this many times that of the reference has grown.
pub const GROWN: f64 = 3.0;

/// So many switches beyond the true count are chatter (or as many as the true
/// count, if that is more).
const CHATTER: usize = 20;

/// So many switches at one instant are chatter.
const AT_ONCE: usize = 32;

/// Verdict on a point.
#[derive(Clone, Copy, Debug, PartialEq, Eq, Serialize)]
#[serde(rename_all = "snake_case")]
pub enum Verdict {
    /// The error is within the tolerance; of a fixed step, within the accuracy
    /// asked for.
    Converged,
    /// Reported success, but the error exceeds that.
    Inaccurate,
    /// The motion grows as the true one does not.
    Unstable,
    /// The step it needs is below what the clock resolves.
    StepFloor,
    /// Pairs switched less often than they do in truth, or a little more often.
    SwitchesMissed,
    /// A pair switches to and fro far more often than in truth.
    Chatter,
    /// Cannot be used on this scene or with this setting.
    Refused,
    /// Gave up for another reason.
    GaveUp,
    /// Took longer than a point may.
    TimeLimit,
    /// Nothing is known to judge it against.
    NotJudged,
}

impl Verdict {
    /// True where the run came to its end with all switches, so that its error
    /// says all there is to say.
    pub(super) fn has_an_error(self) -> bool {
        matches!(self, Self::Converged | Self::Inaccurate)
    }

    /// In words.
    pub fn words(self) -> &'static str {
        match self {
            Self::Converged => "converged",
            Self::Inaccurate => "inaccurate",
            Self::Unstable => "unstable",
            Self::StepFloor => "step at its floor",
            Self::SwitchesMissed => "events missed",
            Self::Chatter => "chatter",
            Self::Refused => "refused",
            Self::GaveUp => "gave up",
            Self::TimeLimit => "time limit",
            Self::NotJudged => "not judged",
        }
    }
}

/// A verdict with its reasons.
#[derive(Clone, Debug, PartialEq)]
pub(super) struct Judgement {
    pub(super) verdict: Verdict,
    /// Cause in one sentence.
    pub(super) cause: String,
    /// Error of the deviation relative to max|δ|.
    pub(super) error: Option<f64>,
    /// Greatest |δ| over that of the reference.
    pub(super) growth: Option<f64>,
}

impl Judgement {
    fn of(verdict: Verdict, cause: String) -> Self {
        Self {
            verdict,
            cause,
            error: None,
            growth: None,
        }
    }
}

/// Judges a point. `accuracy`: what is asked where the point itself has no
/// tolerance; `bound`: what theory says of the method's step.
pub(super) fn judge(
    attempt: &Attempt,
    truth: Option<&ReferenceInUse>,
    accuracy: f64,
    bound: Option<&Bound>,
) -> Judgement {
    let timed = match (&attempt.timed, &attempt.refused) {
        (Some(timed), _) => timed,
        (None, reason) => {
            let reason = reason.clone().unwrap_or_default();
            return Judgement::of(Verdict::Refused, reason);
        }
    };
    let growth = truth.and_then(|truth| growth_of_run(timed, truth));
    let error = truth.and_then(|truth| {
        difference_of_traces(&truth.trace, &timed.trace, &truth.sizes, truth.until)
    });
    let broken = truth.and_then(|truth| broken_off(timed, truth, growth, bound));
    let stopped = || stopped(timed, truth.is_some(), growth, bound);
    let (verdict, cause) = match broken.or_else(stopped) {
        Some(found) => found,
        None => match truth {
            None => (
                Verdict::NotJudged,
                "no reference is known: no two methods agree".to_owned(),
            ),
            Some(truth) => verdict_on_run(attempt, timed, truth, error, growth, accuracy, bound),
        },
    };
    Judgement {
        verdict,
        cause,
        error,
        growth,
    }
}

/// The verdict on a run that was out of time after it had failed already.
fn broken_off(
    timed: &TimedRun,
    truth: &ReferenceInUse,
    growth: Option<f64>,
    bound: Option<&Bound>,
) -> Option<(Verdict, String)> {
    let stop = &timed.outcome.stop;
    if !matches!(stop, Stop::WallClock { .. } | Stop::TooManySteps { .. }) {
        return None;
    }
    if growth.is_some_and(|growth| growth > GROWN) {
        return Some((Verdict::Unstable, grown(timed, growth, bound)));
    }
    let (found, total) = (timed.trace.switches.len(), truth.trace.switches.len());
    (found > total + CHATTER.max(total)).then(|| {
        let cause = format!(
            "{found} events until t = {} s, where the run was stopped; the true number is {total}",
            shown(timed.outcome.time, 7)
        );
        (Verdict::Chatter, with_limit(cause, timed, bound))
    })
}

/// The verdict on a run that did not reach its end. `known`: a reference got
/// there, within the same bound on switches.
fn stopped(
    timed: &TimedRun,
    known: bool,
    growth: Option<f64>,
    bound: Option<&Bound>,
) -> Option<(Verdict, String)> {
    let time = timed.outcome.time;
    let at = format!("at t = {} s", shown(time, 7));
    let found = match &timed.outcome.stop {
        Stop::Complete | Stop::Physical(_) => return None,
        Stop::Interrupted => (Verdict::TimeLimit, format!("interrupted {at}")),
        Stop::WallClock { limit } => (
            Verdict::TimeLimit,
            format!("stopped {at} after {:.3} s", limit.as_secs_f64()),
        ),
        Stop::TooManySteps { bound } => (
            Verdict::TimeLimit,
            format!("stopped {at} after {bound} steps"),
        ),
        Stop::TooManySwitches { bound: most } => {
            let cause = format!("more than {most} events {at}");
            match known || has_accumulated_events(&timed.trace) {
                true => (Verdict::Chatter, with_limit(cause, timed, bound)),
                false => (Verdict::GaveUp, cause),
            }
        }
        Stop::StepFloor { step } => (
            Verdict::StepFloor,
            format!(
                "needs a step of {step} s {at}, below what the clock resolves",
                step = shown(*step, 2)
            ),
        ),
        Stop::NotFinite { what } => {
            let beyond = stability_excess(timed, bound);
            match growth.is_some_and(|growth| growth > GROWN) || beyond.is_some() {
                true => (Verdict::Unstable, grown(timed, growth, bound)),
                false => (
                    Verdict::GaveUp,
                    format!("{what} is no longer a finite number {at}"),
                ),
            }
        }
        Stop::Method { reason, .. } => match has_accumulated_events(&timed.trace) {
            true => (Verdict::Chatter, with_limit(reason.clone(), timed, bound)),
            false => (Verdict::GaveUp, format!("{reason} ({at})")),
        },
    };
    Some(found)
}

/// True when the run ended in switches at one and the same instant.
fn has_accumulated_events(trace: &Trace) -> bool {
    let switches = &trace.switches;
    let count = switches.len();
    count >= AT_ONCE && switches[count - AT_ONCE] == switches[count - 1]
}

/// The verdict on a run that reached its end.
fn verdict_on_run(
    attempt: &Attempt,
    timed: &TimedRun,
    truth: &ReferenceInUse,
    error: Option<f64>,
    growth: Option<f64>,
    accuracy: f64,
    bound: Option<&Bound>,
) -> (Verdict, String) {
    if growth.is_some_and(|growth| growth > GROWN) {
        return (Verdict::Unstable, grown(timed, growth, bound));
    }
    let found = count_of_samples(&timed.trace, truth.public.horizon);
    if let Some((verdict, cause)) = switches(found, truth.public.switches) {
        return (verdict, with_limit(cause, timed, bound));
    }
    let Some(error) = error else {
        let stop = match &timed.outcome.stop {
            Stop::Physical(stop) => stop.name.replace('_', " "),
            _ => "its end".to_owned(),
        };
        let cause = format!(
            "ends at t = {} s ({stop}), where the reference goes on to {} s",
            shown(timed.outcome.time, 7),
            shown(truth.end, 7)
        );
        return (Verdict::Inaccurate, cause);
    };
    let (asked, name) = match attempt.setting.tolerance() {
        Some(tolerance) => (tolerance, "tolerance"),
        None => (accuracy, "accuracy asked for"),
    };
    if error <= asked.max(3.0 * truth.public.resolution) {
        return (Verdict::Converged, converged(error, asked, name));
    }
    let mut cause = format!(
        "the error is {} times the {name} of {asked}, although it reported success",
        factor_in_words(error / asked),
        asked = shown(asked, 1)
    );
    let multiplied = truth.public.moved / CHANGE;
    if multiplied > MULTIPLIES && error <= 10.0 * multiplied * asked {
        cause.push_str(&format!(
            "; the scene itself multiplies small differences {}-fold",
            factor_in_words(multiplied)
        ));
    }
    if let Some(bound) = bound.filter(|_| attempt.setting.step().is_some()) {
        cause.push_str(&format!(
            "; |λ|h = {:.3}, stable below {:.3}",
            bound.rate() * timed.trace.longest_step,
            bound.limit
        ));
    }
    (Verdict::Inaccurate, cause)
}

fn factor_in_words(factor: f64) -> String {
    match factor {
        ..100.0 => format!("{factor:.1}"),
        ..1e4 => format!("{factor:.0}"),
        _ => shown(factor, 2),
    }
}

fn converged(error: f64, asked: f64, name: &str) -> String {
    match error <= asked {
        true => format!(
            "the error is within the {name} of {asked}",
            asked = shown(asked, 1)
        ),
        false => "as near to the reference as can be measured".to_owned(),
    }
}

/// The verdict on a count of switches that is not the true one.
fn switches(found: usize, truth: usize) -> Option<(Verdict, String)> {
    let cause = format!("{found} events, the true number is {truth}");
    if found == truth {
        None
    } else if found > truth + CHATTER.max(truth) {
        Some((Verdict::Chatter, cause))
    } else {
        Some((Verdict::SwitchesMissed, cause))
    }
}

fn count_of_samples(trace: &Trace, horizon: f64) -> usize {
    trace.switches.iter().filter(|t| **t <= horizon).count()
}

/// Greatest |δ| over that of the reference, the worst track.
fn growth_of_run(timed: &TimedRun, truth: &ReferenceInUse) -> Option<f64> {
    let whole = truth.throughout || !matches!(timed.outcome.stop, Stop::Complete);
    let mut worst: Option<f64> = None;
    for (index, &size) in truth.sizes.iter().enumerate().filter(|(_, s)| **s > 0.0) {
        let greatest = if whole {
            timed.trace.greatest.get(index).copied()?
        } else {
            let samples = timed.trace.samples.get(index)?.iter().take(truth.until + 1);
            samples.fold(0.0, |a: f64, b| a.max(b.abs()))
        };
        let ratio = greatest / size;
        let ratio = if ratio.is_nan() { f64::INFINITY } else { ratio };
        worst = Some(worst.map_or(ratio, |worst| worst.max(ratio)));
    }
    worst
}

/// |λ|h where it exceeds the method's limit of stability.
fn stability_excess(timed: &TimedRun, bound: Option<&Bound>) -> Option<f64> {
    let bound = bound?;
    let product = bound.rate() * timed.trace.longest_step;
    (product > bound.limit).then_some(product)
}

/// A cause, with the limit of stability where the step exceeds it.
fn with_limit(cause: String, timed: &TimedRun, bound: Option<&Bound>) -> String {
    let beyond = stability_excess(timed, bound).zip(bound);
    beyond.map_or(cause.clone(), |(product, bound)| {
        let place = axis(bound.eigenvalue);
        format!(
            "{cause}; |λ|h = {product:.3} exceeds the limit {:.3} {place}",
            bound.limit
        )
    })
}

/// Why a motion has grown.
fn grown(timed: &TimedRun, growth: Option<f64>, bound: Option<&Bound>) -> String {
    let how_far = match growth {
        Some(growth) if growth.is_finite() => {
            format!(
                "|δ| grows to {growth} times that of the reference",
                growth = shown(growth, 2)
            )
        }
        _ => "the motion grows beyond all numbers".to_owned(),
    };
    let Some(bound) = bound else {
        return how_far;
    };
    let product = bound.rate() * timed.trace.longest_step;
    let [limit, axis] = [
        format!("{:.3}", bound.limit),
        axis(bound.eigenvalue).to_owned(),
    ];
    if product > bound.limit {
        format!("{how_far}: |λ|h = {product:.3} exceeds the limit {limit} {axis}")
    } else {
        format!(
            "{how_far}, although |λ|h = {product:.3} is below the limit {limit} {axis}: \
             what grows is not the linear motion"
        )
    }
}

/// Where an eigenvalue lies.
pub(super) fn axis([re, im]: [f64; 2]) -> &'static str {
    if im.abs() < 1e-6 * re.abs() {
        "on the real axis"
    } else if re.abs() < 1e-6 * im.abs() {
        "on the imaginary axis"
    } else {
        "in the direction of λ"
    }
}

#[cfg(test)]
#[path = "verdict_tests.rs"]
mod tests;
