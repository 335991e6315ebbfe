//! What is true? The reference that the errors are taken against, and how far
//! it can be relied on.
//!
//! The exact method where it applies; else two different methods, each at its
//! finest setting, that agree with each other. How well the motion is determined
//! at all is asked of the mechanism: with loads and gaps changed by one part in
//! 10¹⁰, how far does the deviation move? Rounding is a change of one part in
//! 10¹⁵ and moves it by a 10⁵th of that, which no method can avoid. From the
//! instant on at which that change alone moves the motion by a hundredth, the
//! motion is not determined, and nothing is judged.

mod moved;

use super::attempt::{Attempt, Effort, Problem};
use super::doubt::{AGREE, Doubt, Witness, doubt_about_reference};
use super::light::Trace;
use super::setting::{Setting, is_exact};
use crate::dynamics::integrate::Method;
use crate::dynamics::record::Figures;
use crate::studies::spread::CHANGE;
use moved::PerturbedRun;
use serde::Serialize;

/// The motion is determined until the change of loads has moved it by this share.
pub const HORIZON: f64 = 1e-2;

/// Rounding, as a share of the change of loads.
const CHANGE_ROUNDING: f64 = 1e-15 / CHANGE;

/// Below this share of a coordinate's scale a deviation is none, and an error is taken
/// relative to the scale.
const NO_DEVIATION: f64 = 1e-12;

/// Reference that the errors are taken against.
#[derive(Clone, Debug, PartialEq, Serialize)]
pub struct Reference {
    /// The method.
    pub method: Method,
    /// Tolerance, if it has one.
    pub tolerance: Option<f64>,
    /// Step (s), if it is of fixed step.
    pub step: Option<f64>,
    /// True: propagated without truncation error; false: two methods agree.
    pub exact: bool,
    /// The different method that comes nearest to it.
    pub confirmed_by: Option<Distance>,
    /// How far the deviation moves, relative to max|δ|, when loads and gaps
    /// change by one part in 10¹⁰ (up to the horizon).
    pub moved: f64,
    /// Errors below this cannot be told from none.
    pub resolution: f64,
    /// The motion is determined up to here (s).
    pub horizon: f64,
    /// Switches of pairs up to the horizon.
    pub switches: usize,
    /// Figures that are not determined to 1e-7 and are not judged.
    pub undetermined: Vec<String>,
}

/// Distance between two points.
#[derive(Clone, Debug, PartialEq, Serialize)]
pub struct Distance {
    /// One method with its setting.
    pub one: String,
    /// The other.
    pub other: String,
    /// Greatest difference of the deviations relative to max|δ|.
    pub distance: f64,
}

/// No reference can be relied on.
#[derive(Clone, Debug, Default, PartialEq)]
pub(super) struct NoReference {
    /// How far the finest points are apart.
    pub(super) distances: Vec<Distance>,
    /// Doubt about the one that there would be.
    pub(super) doubt: Option<Doubt>,
}

/// A reference in use.
pub(super) struct ReferenceInUse {
    pub(super) public: Reference,
    pub(super) trace: Trace,
    /// Index of the point that it is among all, shown or not.
    pub(super) index: usize,
    pub(super) figures: Option<Figures>,
    /// max|δ| of every track; the scale of its coordinate for tracks at rest.
    pub(super) sizes: Vec<f64>,
    /// Last sample that is judged.
    pub(super) until: usize,
    /// True when that is the last sample of the run.
    pub(super) throughout: bool,
    /// The run ends in a physical stop.
    pub(super) end: f64,
}

/// Greatest difference of two traces up to a sample, relative to `sizes`.
/// `None`: one of them does not go so far.
pub(super) fn difference_of_traces(
    a: &Trace,
    b: &Trace,
    sizes: &[f64],
    until: usize,
) -> Option<f64> {
    let tracks = a.samples.iter().zip(&b.samples).zip(sizes);
    let mut greatest = 0.0f64;
    for ((a, b), size) in tracks.filter(|(_, size)| **size > 0.0) {
        let (a, b) = (a.get(..=until)?, b.get(..=until)?);
        for (a, b) in a.iter().zip(b) {
            let difference = (a - b).abs() / size;
            if difference.is_nan() {
                return None;
            }
            greatest = greatest.max(difference);
        }
    }
    Some(greatest)
}

/// Finds the reference among the points of all methods, shown or not.
///
/// # Errors
/// No two methods agree, or two agree with each other and not with the reference: how far
/// they are apart.
pub(super) fn find(
    problem: &Problem<'_>,
    attempts: &[Attempt],
    effort: &Effort<'_>,
) -> Result<ReferenceInUse, NoReference> {
    let finest = finest_of_each(attempts);
    let scales = scales(problem);
    let exact = finest.iter().position(|&i| is_exact(attempts[i].method));
    let Some(guess) =
        exact.or_else(|| nearest(attempts, &finest, &scales, None).map(|best| best.0))
    else {
        return Err(NoReference::default());
    };
    let guess = finest[guess];
    let moved = PerturbedRun::of(problem, &attempts[guess], effort);
    let last = last_sample(trace(&attempts[guess]));
    let (until, share) = moved.determined_until(trace(&attempts[guess]), last);
    let pair = nearest(attempts, &finest, &scales, Some(until));
    let (index, agreement) = match (exact, pair) {
        (Some(exact), _) => (finest[exact], None),
        (None, Some((one, _, distance))) if distance <= AGREE => (finest[one], Some(distance)),
        _ => {
            return Err(NoReference {
                distances: mutual_distances(attempts, &finest, &scales, until),
                doubt: None,
            });
        }
    };
    let sizes = sizes(&scales, trace(&attempts[index]), until);
    let confirmed_by = confirmation(attempts, index, &sizes, until);
    let rounding = (CHANGE_ROUNDING * share).max(1e-15);
    let resolution = agreement.map_or(rounding, |distance| rounding.max(distance));
    let attempt = &attempts[index];
    let witnesses: Vec<Option<Witness>> = attempts.iter().map(Witness::of).collect();
    // A pair of methods is no nearer to the truth than it is to itself.
    let doubt = doubt_about_reference(&witnesses, (index, &name(attempt)), resolution, |a, b| {
        distance_between(attempts, a, b, &scales, Some(until))
    });
    if doubt.is_some() {
        let distances = mutual_distances(attempts, &finest, &scales, until);
        return Err(NoReference { distances, doubt });
    }
    let end = attempt.timed.as_ref().map_or(0.0, |t| t.outcome.time);
    let horizon = match until == last {
        true => end,
        false => problem.settings.duration * until as f64 / problem.settings.samples as f64,
    };
    let trace = trace(attempt).clone();
    Ok(ReferenceInUse {
        public: Reference {
            method: attempt.method,
            tolerance: attempt.setting.tolerance(),
            step: attempt.setting.step(),
            exact: exact.is_some(),
            confirmed_by,
            moved: share,
            resolution,
            horizon,
            switches: trace.switches.iter().filter(|t| **t <= horizon).count(),
            undetermined: moved.figures(attempt.figures.as_ref(), until == last),
        },
        trace,
        index,
        figures: attempt.figures.clone(),
        sizes,
        until,
        throughout: until == last,
        end,
    })
}

/// The trace of a point that ended well.
fn trace(attempt: &Attempt) -> &Trace {
    static NO_DEVIATION: Trace = Trace::EMPTY;
    attempt
        .timed
        .as_ref()
        .map_or(&NO_DEVIATION, |timed| &timed.trace)
}

fn last_sample(trace: &Trace) -> usize {
    let lengths = trace.samples.iter().map(Vec::len);
    lengths.min().unwrap_or(0).saturating_sub(1)
}

/// Index of the finest point of every method that ended well.
fn finest_of_each(attempts: &[Attempt]) -> Vec<usize> {
    let mut finest: Vec<usize> = Vec::new();
    for (index, attempt) in attempts.iter().enumerate() {
        if !attempt.has_ended_well() {
            continue;
        }
        match finest.last_mut() {
            Some(last) if attempts[*last].method == attempt.method => *last = index,
            _ => finest.push(index),
        }
    }
    finest
}

/// The scale of every track's coordinate.
fn scales(problem: &Problem<'_>) -> Vec<f64> {
    use crate::dynamics::integrate::Dynamics;
    let scales = problem.system.scales();
    let tracks = problem.tracks.iter();
    tracks.map(|track| scales[track.coordinate]).collect()
}

/// max|δ| of every track up to a sample; of a track at rest the scale of its coordinate, so
/// that no error is taken relative to nothing.
fn sizes(scales: &[f64], trace: &Trace, until: usize) -> Vec<f64> {
    let tracks = scales.iter().enumerate();
    tracks
        .map(|(index, scale)| reference_size(greatest(trace, index, until), *scale))
        .collect()
}

/// What a difference of a deviation is taken relative to.
fn reference_size(greatest: f64, scale: f64) -> f64 {
    match greatest <= NO_DEVIATION * scale {
        true => scale,
        false => greatest,
    }
}

/// Greatest |value| of a track up to a sample; up to the last one, what lies
/// between samples counts as well.
fn greatest(trace: &Trace, index: usize, until: usize) -> f64 {
    if until >= last_sample(trace) {
        return trace.greatest[index];
    }
    let samples = trace.samples[index].iter().take(until + 1);
    samples.fold(0.0, |a: f64, b| a.max(b.abs()))
}

/// Greatest |δ| of both, for a distance that favours neither.
fn common_sizes(a: &Trace, b: &Trace, scales: &[f64], until: usize) -> Vec<f64> {
    let tracks = scales.iter().enumerate();
    tracks
        .map(|(k, scale)| {
            let greatest = greatest(a, k, until).max(greatest(b, k, until));
            reference_size(greatest, *scale)
        })
        .collect()
}

/// The nearest pair among the finest points, up to a sample or as far as both
/// go: positions in `finest`, the one nearer to all others first.
fn nearest(
    attempts: &[Attempt],
    finest: &[usize],
    scales: &[f64],
    until: Option<usize>,
) -> Option<(usize, usize, f64)> {
    let mut best: Option<(usize, usize, f64)> = None;
    for one in 0..finest.len() {
        for other in one + 1..finest.len() {
            let (a, b) = (finest[one], finest[other]);
            let Some(distance) = distance_between(attempts, a, b, scales, until) else {
                continue;
            };
            if best.is_none_or(|(_, _, least)| distance < least) {
                best = Some((one, other, distance));
            }
        }
    }
    let (one, other, distance) = best?;
    // Of the two, the one with the nearer third is the more accurate.
    let third = |member: usize| {
        let others = (0..finest.len()).filter(|&k| k != one && k != other);
        let distances = others
            .filter_map(|k| distance_between(attempts, finest[member], finest[k], scales, until));
        distances.fold(f64::INFINITY, f64::min)
    };
    Some(if third(other) < third(one) {
        (other, one, distance)
    } else {
        (one, other, distance)
    })
}

fn distance_between(
    attempts: &[Attempt],
    one: usize,
    other: usize,
    scales: &[f64],
    until: Option<usize>,
) -> Option<f64> {
    let (a, b) = (trace(&attempts[one]), trace(&attempts[other]));
    let until = until.unwrap_or(last_sample(a).min(last_sample(b)));
    difference_of_traces(a, b, &common_sizes(a, b, scales, until), until)
}

/// All distances between the finest points.
fn mutual_distances(
    attempts: &[Attempt],
    finest: &[usize],
    scales: &[f64],
    until: usize,
) -> Vec<Distance> {
    let mut all = Vec::new();
    for (k, &one) in finest.iter().enumerate() {
        for &other in &finest[k + 1..] {
            if let Some(distance) = distance_between(attempts, one, other, scales, Some(until)) {
                all.push(Distance {
                    one: name(&attempts[one]),
                    other: name(&attempts[other]),
                    distance,
                });
            }
        }
    }
    all
}

/// The point of a different method that comes nearest to the reference.
fn confirmation(
    attempts: &[Attempt],
    index: usize,
    sizes: &[f64],
    until: usize,
) -> Option<Distance> {
    let own = &attempts[index];
    let others = attempts
        .iter()
        .filter(|other| other.method != own.method && other.has_ended_well());
    let distances = others.filter_map(|other| {
        Some((
            difference_of_traces(trace(own), trace(other), sizes, until)?,
            other,
        ))
    });
    let (distance, other) = distances.min_by(|a, b| a.0.total_cmp(&b.0))?;
    Some(Distance {
        one: name(own),
        other: name(other),
        distance,
    })
}

fn name(attempt: &Attempt) -> String {
    match attempt.setting {
        Setting::Exact => attempt.method.to_string(),
        setting => format!("{} at {setting}", attempt.method),
    }
}
