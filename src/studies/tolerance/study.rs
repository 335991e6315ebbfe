//! The study: a stack about the middle of the zones, then samples of them.

use super::answer::{Effect, Failure, FigureTolerance, LimitYield, SlopeSource, Tolerances};
use super::extremes::extremes;
use super::indices::{Indices, indices};
use super::sampling::SamplePlan;
use super::slopes::{PLACES, Slope, slope};
use super::stack::{AtLimits, FirstOrder, mean_shift, not_linear};
use super::statistics::{Spread, Yield};
use super::task::{Evaluate, Outcome, ToleranceTask};
use crate::math::probability::normal_share_below;
use crate::studies::condition::{Condition, Relation};
use crate::studies::prepared::Verdict;
use std::collections::BTreeMap;

/// Runs of one batch of samples: between two of them a study can be ended with what it has.
const BATCH: usize = 64;

/// Answers a question.
///
/// # Errors
/// The scene cannot be run in the middle of the zones; it was ended before the stack was known.
pub fn tolerances(task: &ToleranceTask, evaluate: &Evaluate<'_>) -> Result<Tolerances, String> {
    let ended = || "the study was interrupted".to_owned();
    let rows = evaluate(&task.stack_rows()).ok_or_else(ended)?;
    let middle = &rows[0];
    if middle.values.iter().all(Option::is_none) {
        return Err(format!(
            "the scene has no results in the middle of the tolerances: {}",
            middle.cause
        ));
    }
    let mut figures: Vec<FigureTolerance> = (0..task.figures.len())
        .map(|figure| figure_stack(task, &rows, figure))
        .collect();
    let Some(worst) = extremes(task, &figures, evaluate) else {
        return Ok(summary(task, figures, &[], false));
    };
    let mut remarks = Vec::new();
    for (figure, worst) in figures.iter_mut().zip(worst) {
        figure.extremes = worst.ends;
        if worst.failed > 0 {
            remarks.push(format!(
                "the worst case by runs of {} leaves out what has no result with numbers at their \
                 limits (runs: {})",
                figure.figure, worst.failed
            ));
        }
    }
    let (points, complete) = sampled(task, evaluate);
    let mut found = summary(task, figures, &points, complete);
    found.remarks.splice(0..0, remarks);
    Ok(found)
}

/// The stack of a result from the runs of [`ToleranceTask::stack_rows`].
fn figure_stack(task: &ToleranceTask, rows: &[Outcome], number: usize) -> FigureTolerance {
    let figure = &task.figures[number];
    let value = |row: usize| rows[row].values[number];
    let (middle, zones) = (value(0), task.zones());
    let first = |at: usize| 2 + 2 * PLACES.len() * at;
    let side =
        |from: usize| -> Vec<Option<f64>> { (from..from + PLACES.len()).map(value).collect() };
    let effect = |at: usize| {
        let (above, below) = (side(first(at)), side(first(at) + PLACES.len()));
        let by_differences = || {
            let own = slope(&zones[at], &above, &below).filter(|_| !figure.counts)?;
            Some((own, SlopeSource::Differences))
        };
        let exact = figure.exact[at].map(|value| (Slope { value, error: 0.0 }, SlopeSource::Exact));
        let known = exact.or_else(by_differences);
        Effect {
            derivative: known.map(|(own, _)| own.value),
            source: known.map(|(_, source)| source),
            error: known
                .map(|(own, _)| own.error)
                .filter(|error| error.is_finite()),
            contribution: None,
            limits: AtLimits {
                lower: below[PLACES.len() - 1],
                upper: above[PLACES.len() - 1],
            },
            not_linear: None,
            indices: None,
        }
    };
    let mut effects: Vec<Effect> = (0..zones.len()).map(effect).collect();
    let slopes: Option<Vec<f64>> = effects.iter().map(|own| own.derivative).collect();
    let limits: Vec<AtLimits> = effects.iter().map(|own| own.limits).collect();
    let first_order = middle.zip(slopes).map(|(middle, slopes)| {
        let found = FirstOrder::of(middle, &slopes, &zones);
        let rest = not_linear(middle, &slopes, &limits, &zones);
        for ((own, share), rest) in effects.iter_mut().zip(&found.contributions).zip(rest) {
            own.contribution = Some(*share);
            own.not_linear = rest;
        }
        found
    });
    let shift = middle.filter(|_| !figure.counts);
    FigureTolerance {
        figure: figure.address.clone(),
        unit: figure.unit.clone(),
        nominal: value(1),
        middle,
        first_order,
        mean_shift: shift.and_then(|middle| mean_shift(middle, &limits, &zones)),
        extremes: [None, None],
        spread: None,
        values: Vec::new(),
        effects,
    }
}

/// The runs of a point of the plan, and the deviations of its two samples.
struct SampledPoint {
    runs: Vec<Outcome>,
    deviations: [Vec<f64>; 2],
}

/// The points that were run; true: all of them.
fn sampled(task: &ToleranceTask, evaluate: &Evaluate<'_>) -> (Vec<SampledPoint>, bool) {
    let plan = SamplePlan::new(task.zones(), task.seed);
    let batch = (BATCH / plan.runs()).max(1);
    let mut found = Vec::with_capacity(task.points());
    while found.len() < task.points() {
        let points = found.len()..(found.len() + batch).min(task.points());
        let rows: Vec<Vec<f64>> = points.flat_map(|point| plan.rows(point)).collect();
        let Some(outcomes) = evaluate(&rows) else {
            return (found, false);
        };
        let each = rows.chunks(plan.runs()).zip(outcomes.chunks(plan.runs()));
        found.extend(each.map(|(rows, runs)| SampledPoint {
            runs: runs.to_vec(),
            deviations: [rows[0].clone(), rows[1].clone()],
        }));
    }
    (found, true)
}

/// What the samples say.
fn summary(
    task: &ToleranceTask,
    mut figures: Vec<FigureTolerance>,
    points: &[SampledPoint],
    complete: bool,
) -> Tolerances {
    let samples: Vec<&Outcome> = points.iter().flat_map(|point| &point.runs[..2]).collect();
    let mut remarks = Vec::new();
    // (An odd number of samples leaves the last one out.)
    let asked = if complete {
        task.samples
    } else {
        samples.len()
    };
    let samples = &samples[..asked.min(samples.len())];
    for (number, figure) in figures.iter_mut().enumerate() {
        figure.values = samples
            .iter()
            .filter_map(|one| one.values[number])
            .collect();
        figure.spread = Spread::of(&figure.values);
        let own = of_points(points, number);
        if own.is_none() && points.len() > 1 && figure.values.len() < 2 * points.len() {
            remarks.push(format!(
                "{} has no indices, since samples failed",
                figure.figure
            ));
        }
        let own = own.map_or_else(Vec::new, |own| own.into_iter().map(Some).collect());
        for (effect, own) in figure.effects.iter_mut().zip(own) {
            effect.indices = own;
        }
    }
    let place = |limit: &Condition| {
        let mut all = task.figures.iter();
        all.position(|figure| figure.address == limit.figure)
    };
    let holds = |limit: &Condition, one: &Outcome| {
        let value = place(limit).and_then(|number| one.values[number]);
        value.is_some_and(|value| limit.holds(value))
    };
    let limits = task.limits.iter().map(|limit| {
        let good = samples.iter().filter(|one| holds(limit, one)).count();
        let stack = place(limit).and_then(|number| figures[number].first_order.as_ref());
        LimitYield {
            limit: limit.clone(),
            by_first_order: stack.and_then(|stack| share_within(limit, stack)),
            found: Yield::of(good, samples.len()),
        }
    });
    let limits: Vec<LimitYield> = limits.collect();
    let good = |one: &&&Outcome| !one.failed() && task.limits.iter().all(|limit| holds(limit, one));
    let good = samples.iter().filter(good).count();
    let failures = failures(samples);
    let failed: usize = failures.iter().map(|one| one.count).sum();
    Tolerances {
        dimensions: task.dimensions.clone(),
        figures,
        limits,
        of_all: Yield::of(good, samples.len()),
        of_run: Yield::of(good, samples.len() - failed),
        failures,
        samples: samples.iter().map(|one| (*one).clone()).collect(),
        deviations: (points.iter().flat_map(|point| &point.deviations))
            .take(samples.len())
            .cloned()
            .collect(),
        asked: task.samples,
        seed: task.seed,
        complete,
        remarks,
    }
}

/// Indices of a result; `None`: a run of a point has no result. (Points chosen by that are no
/// longer independent.)
fn of_points(points: &[SampledPoint], number: usize) -> Option<Vec<Indices>> {
    let own = points.iter().map(|point| {
        let values = point.runs.iter().map(|one| one.values[number]);
        values.collect::<Option<Vec<f64>>>()
    });
    indices(&own.collect::<Option<Vec<_>>>()?)
}

/// The share of a normal distribution that meets a limit, from the stack of first order.
fn share_within(limit: &Condition, stack: &FirstOrder) -> Option<f64> {
    if stack.sigma <= 0.0 {
        return Some(f64::from(u8::from(limit.holds(stack.mean))));
    }
    let below = normal_share_below((limit.value - stack.mean) / stack.sigma);
    match limit.relation {
        Relation::AtMost => Some(below),
        Relation::AtLeast => Some(1.0 - below),
        Relation::Equal => None,
    }
}

/// Samples that failed, by their causes, the most frequent first.
fn failures(samples: &[&Outcome]) -> Vec<Failure> {
    let mut counts: BTreeMap<(Verdict, String), (usize, String)> = BTreeMap::new();
    for one in samples.iter().filter(|one| one.failed()) {
        let kind = without_numbers(&one.cause);
        let own = counts
            .entry((one.verdict, kind))
            .or_insert((0, one.cause.clone()));
        own.0 += 1;
    }
    let each = counts.into_iter();
    let mut found: Vec<Failure> = each
        .map(|((verdict, _), (count, cause))| Failure {
            verdict,
            cause,
            count,
        })
        .collect();
    found.sort_by_key(|one| std::cmp::Reverse(one.count));
    found
}

/// A cause without its numbers, which differ from sample to sample.
fn without_numbers(cause: &str) -> String {
    let of_number = |c: char| c.is_ascii_digit() || matches!(c, '.' | '-' | '+');
    cause.chars().filter(|c| !of_number(*c)).collect()
}
