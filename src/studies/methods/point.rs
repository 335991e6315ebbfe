//! One point of the chart: a method at one setting.

use super::attempt::Attempt;
use super::reference::ReferenceInUse;
use super::stability::Bound;
use super::verdict::{Judgement, Verdict};
use crate::dynamics::record::Figures;
use crate::studies::spread::is_result;
use crate::units::shown;
use serde::Serialize;

/// A method at one setting: what it cost, how near it came, what became of it.
#[derive(Clone, Debug, PartialEq, Serialize)]
pub struct Point {
    /// Tolerance, if the method has one.
    pub tolerance: Option<f64>,
    /// Step (s), if it is of fixed step.
    pub step: Option<f64>,
    /// Verdict on the point.
    pub verdict: Verdict,
    /// Why, in a sentence.
    pub cause: String,
    /// Error of δ relative to max|δ|, the worst object; null: not known. Of the
    /// reference itself: its distance from the nearest different method.
    pub error: Option<f64>,
    /// True for the point that the errors are taken against.
    pub is_reference: bool,
    /// Median wall-clock time of the repetitions (s); varies from run to run.
    pub measured_seconds: Option<f64>,
    /// Number of repetitions.
    pub repetitions: usize,
    /// Evaluations of the right-hand side.
    pub evaluations: Option<u64>,
    /// Accepted steps.
    pub steps: Option<u64>,
    /// Rejected steps.
    pub rejected: Option<u64>,
    /// Switches of pairs.
    pub switches: Option<u64>,
    /// Time reached (s).
    pub time: Option<f64>,
    /// Longest step taken (s).
    pub longest_step: Option<f64>,
    /// |λ| × the longest step, λ the eigenvalue that bounds the method's step.
    pub rate_times_step: Option<f64>,
    /// Greatest |δ| over that of the reference.
    pub growth: Option<f64>,
    /// Error of the energy balance.
    pub energy_error: Option<f64>,
    /// The figure with the greatest error.
    pub worst_figure: Option<String>,
    /// Errors of all determined figures relative to their scales.
    pub figures: Vec<FigureError>,
}

/// The error of one figure.
#[derive(Clone, Debug, PartialEq, Serialize)]
pub struct FigureError {
    /// Address.
    pub figure: String,
    /// |value − true value| relative to its scale (greatest |δ| for
    /// displacements, peaks for rates and forces, 1 for counts), at least to what the
    /// run resolves; null where the figure is missing or has no scale.
    pub error: Option<f64>,
}

impl Point {
    /// The setting in words: `1e-6`, `2.5e-5 s`, `–`.
    pub fn setting(&self) -> String {
        match (self.tolerance, self.step) {
            (Some(tolerance), _) => shown(tolerance, 1),
            (_, Some(step)) => format!("{step} s", step = shown(step, 3)),
            _ => "–".to_owned(),
        }
    }

    pub(super) fn new(
        attempt: &Attempt,
        judged: Judgement,
        truth: Option<&ReferenceInUse>,
        bound: Option<&Bound>,
        is_reference: bool,
    ) -> Self {
        let outcome = attempt.timed.as_ref().map(|timed| &timed.outcome);
        let count = |get: fn(&crate::dynamics::integrate::Statistics) -> u64| {
            outcome.map(|outcome| get(&outcome.statistics))
        };
        let longest = attempt.timed.as_ref().map(|timed| timed.trace.longest_step);
        let figures = match (
            truth.and_then(|t| Some((t, t.figures.as_ref()?))),
            is_reference,
        ) {
            (Some((truth, figures)), false) => figure_errors(attempt, figures, truth),
            _ => Vec::new(),
        };
        let error = match is_reference {
            true => truth.and_then(|t| Some(t.public.confirmed_by.as_ref()?.distance)),
            false => judged.error,
        };
        Self {
            tolerance: attempt.setting.tolerance(),
            step: attempt.setting.step(),
            verdict: judged.verdict,
            cause: judged.cause,
            error: error.filter(|error| error.is_finite()),
            is_reference,
            measured_seconds: attempt.median_seconds(),
            repetitions: attempt.seconds.len(),
            evaluations: count(|s| s.evaluations),
            steps: count(|s| s.steps),
            rejected: count(|s| s.rejected),
            switches: count(|s| s.switches),
            time: outcome.map(|outcome| outcome.time),
            longest_step: longest,
            rate_times_step: bound.zip(longest).map(|(bound, h)| bound.rate() * h),
            growth: judged.growth.filter(|growth| growth.is_finite()),
            energy_error: attempt.figures.as_ref().map(|f| f.run.energy_error),
            worst_figure: worst(&figures),
            figures,
        }
    }
}

fn worst(figures: &[FigureError]) -> Option<String> {
    let known = figures.iter().filter(|figure| figure.error.is_some());
    let worst = known.max_by(|a, b| {
        let key = |figure: &FigureError| figure.error.unwrap_or(0.0);
        key(a).total_cmp(&key(b))
    })?;
    Some(worst.figure.clone())
}

/// Errors of the figures that are determined.
fn figure_errors(
    attempt: &Attempt,
    reference: &Figures,
    truth: &ReferenceInUse,
) -> Vec<FigureError> {
    let Some(figures) = &attempt.figures else {
        return Vec::new();
    };
    let own = figures.addresses();
    let judged = reference
        .addresses()
        .into_iter()
        .filter(|(figure, _)| is_result(figure) && !truth.public.undetermined.contains(figure));
    judged
        .filter_map(|(figure, value)| {
            let value = value?;
            let scale = reference.common_scale(figures, &figure);
            let error = own.get(&figure).copied().flatten().and_then(|own| {
                let difference = (own - value).abs();
                match (difference == 0.0, scale > 0.0) {
                    (true, _) => Some(0.0),
                    (false, true) => Some(difference / scale),
                    (false, false) => None,
                }
            });
            Some(FigureError { figure, error })
        })
        .collect()
}
