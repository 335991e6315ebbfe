//! One start: where it ends, and what holds it there.

use super::evaluate::{ENDED, OptimizationTask};
use super::result::{StartEnd, StartResult};
use super::scaled::{FEASIBLE, Looked, Scaled, Scales};
use crate::math::optimise::constrained::{
    Multipliers, Problem, SmoothPiece, SqpEnd, Values, bundle, multipliers, sqp,
};

/// A step that promises less than this, of the change of the goal over the ranges, is none.
const ACCURACY: f64 = 1e-13;

/// Most steps of a start.
const STEPS: u64 = 200;

/// Most times that a start goes on from where it ended, in the sizes there.
const ROUNDS: usize = 8;

/// A fall of the goal that counts where it has a kink.
const FALL: f64 = 1e-11;

/// Distance from its limit within which a condition holds an optimum, scaled.
const ACTIVE: f64 = 1e-6;

/// Slope that counts as none, scaled: of a smooth optimum, and of one at a kink.
const STATIONARY: f64 = 1e-5;
const STATIONARY_AT_KINK: f64 = 2e-3;

/// Distance from the end of a range that is rounding.
const AT_END: f64 = 1e-10;

/// A start that has ended.
pub(super) struct Ended {
    pub(super) result: StartResult,
    pub(super) found: Option<EndPlace>,
    pub(super) slopes: [usize; 2],
}

/// Where a start ended.
#[derive(Clone)]
pub(super) struct EndPlace {
    pub(super) at: Vec<f64>,
    pub(super) values: Values,
    pub(super) figures: Vec<f64>,
    pub(super) held: Multipliers,
    pub(super) stationary: bool,
    /// Slope that counts as none here, scaled.
    pub(super) limit: f64,
    pub(super) violation: f64,
    /// The sizes in which all this is stated.
    pub(super) scales: Scales,
}

/// Goes from a start to where nothing is better.
pub(super) fn go(task: &OptimizationTask<'_>, scales: &Scales, start: &[f64]) -> Ended {
    let mut problem = Scaled::new(task, scales.clone());
    let mut result = StartResult {
        from: task.values_of(start),
        to: None,
        goal: None,
        end: StartEnd::Failed,
        why: String::new(),
        optimum: None,
        evaluations: 0,
        failed: 0,
        progress: Vec::new(),
    };
    let mut found = end_from(&problem, start);
    // What is small beside all that the ranges hold may be great where a start ends.
    for _ in 0..ROUNDS {
        let Some(end) = found.as_ref().filter(|_| !task.control.is_spent()) else {
            break;
        };
        let from = end.at.clone();
        let Some(local) = problem.scales_at(&from, scales) else {
            break;
        };
        problem = problem.with_scales(local);
        let again = end_from(&problem, &from).or_else(|| place(&problem, &from, None));
        let better = again.as_ref().and_then(|end| better_nearby(&problem, end));
        match better {
            Some(better) => found = Some(better),
            None => {
                let moved = again.as_ref().is_some_and(|end| end.at != from);
                let settled = again
                    .as_ref()
                    .is_some_and(|end| end.stationary && end.violation <= FEASIBLE);
                found = again;
                if settled || !moved {
                    break;
                }
            }
        }
    }
    // An end from outside keeps the best that was looked at.
    let found = match task.control.is_spent() {
        true => best_so_far(&problem)
            .filter(|best| found.as_ref().is_none_or(|found| is_better(best, found)))
            .or(found),
        false => found,
    };
    let trace = problem.trace.borrow();
    result.evaluations = trace.len();
    result.failed = trace.iter().filter(|looked| looked.is_none()).count();
    result.progress = progress(&trace, problem.sign());
    let spent = task.control.is_spent();
    result.end = match &found {
        _ if spent => StartEnd::Interrupted,
        None => StartEnd::Failed,
        Some(found) if found.violation > FEASIBLE => StartEnd::Infeasible,
        Some(found) if found.stationary => StartEnd::Optimum,
        Some(_) => StartEnd::Stalled,
    };
    result.why = match result.end {
        StartEnd::Failed | StartEnd::Interrupted => problem.cause.borrow().clone(),
        StartEnd::Stalled if result.failed > 0 => {
            format!("places nearby have no values: {}", problem.cause.borrow())
        }
        StartEnd::Stalled => "slopes of results are not smooth enough here".to_owned(),
        StartEnd::Optimum | StartEnd::Infeasible => String::new(),
    };
    if result.why == ENDED {
        result.why.clear();
    }
    if let Some(found) = &found {
        result.to = Some(task.values_of(&found.at));
        result.goal = Some(problem.goal(&found.at, &found.figures));
    }
    Ended {
        result,
        found,
        slopes: problem.slopes.get(),
    }
}

/// A place with what holds it; `pieces`: the tangents that hold there, if it is at a kink.
pub(super) fn place(
    problem: &Scaled<'_>,
    at: &[f64],
    pieces: Option<&[SmoothPiece]>,
) -> Option<EndPlace> {
    let at: Vec<f64> = at.iter().map(|x| snapped(*x)).collect();
    let at = at.as_slice();
    let values = problem.values(at)?;
    let figures = problem.figures(at)?;
    let active: Vec<bool> = values
        .conditions
        .iter()
        .map(|value| *value >= -ACTIVE)
        .collect();
    let smooth = problem.slopes(at).map(|slopes| SmoothPiece::all(&slopes));
    let held = |pieces: &[SmoothPiece]| multipliers(problem, at, &active, pieces);
    let of_slopes = smooth.as_deref().map(held);
    let of_pieces = pieces.filter(|pieces| !pieces.is_empty()).map(held);
    let (held, limit) = match (of_slopes, of_pieces) {
        (Some(smooth), Some(kink)) if smooth.residual <= STATIONARY.max(kink.residual) => {
            (smooth, STATIONARY)
        }
        (_, Some(kink)) => (kink, STATIONARY_AT_KINK),
        (Some(smooth), None) => (smooth, STATIONARY),
        (None, None) => return None,
    };
    Some(EndPlace {
        at: at.to_vec(),
        violation: values.violation(problem.equalities()),
        stationary: held.residual <= limit,
        limit,
        scales: problem.scales.clone(),
        values,
        figures,
        held,
    })
}

/// Where the methods end from a place.
fn end_from(problem: &Scaled<'_>, start: &[f64]) -> Option<EndPlace> {
    let (at, end) = sqp(problem, start, ACCURACY, STEPS);
    let found = match end {
        SqpEnd::NoValues => None,
        SqpEnd::Converged | SqpEnd::Stalled => place(problem, &at, None),
    };
    found.map(
        |found| match found.stationary && found.violation <= FEASIBLE {
            true => found,
            false => better_along_kinks(problem, found),
        },
    )
}

/// A place one step of differences away, along one variable, that is better than the slopes say:
/// without a slope an end may be anything. `None`: there is none.
fn better_nearby(problem: &Scaled<'_>, end: &EndPlace) -> Option<EndPlace> {
    if !end.stationary || end.violation > FEASIBLE {
        return None;
    }
    let step = problem.task.step;
    let explained = 2.0 * end.limit * step + FALL;
    let each = (0..end.at.len()).flat_map(|variable| [(variable, -step), (variable, step)]);
    let beside = each.filter_map(|(variable, step)| {
        let mut at = end.at.clone();
        at[variable] += step;
        if !(0.0..=1.0).contains(&at[variable]) {
            return None;
        }
        let values = problem.values(&at)?;
        let feasible = values.violation(problem.equalities()) <= FEASIBLE;
        let better = values.objective < end.values.objective - explained;
        (feasible && better).then_some((values.objective, at))
    });
    let (_, at) = beside.min_by(|a, b| a.0.total_cmp(&b.0))?;
    let mut found = place(problem, &at, None)?;
    // It is where a start goes on, and no end.
    found.stationary = false;
    Some(found)
}

/// The best place that was looked at; nothing is known of what holds it.
fn best_so_far(problem: &Scaled<'_>) -> Option<EndPlace> {
    let (at, figures, values) = problem.best.borrow().clone()?;
    let held = Multipliers {
        conditions: vec![0.0; values.conditions.len()],
        bounds: vec![0.0; at.len()],
        residual: f64::INFINITY,
    };
    Some(EndPlace {
        violation: values.violation(problem.equalities()),
        at,
        values,
        figures,
        held,
        stationary: false,
        limit: STATIONARY,
        scales: problem.scales.clone(),
    })
}

/// A share of the range; at its end, if rounding alone keeps it away.
fn snapped(share: f64) -> f64 {
    match share {
        share if share.abs() <= AT_END => 0.0,
        share if (1.0 - share).abs() <= AT_END => 1.0,
        share => share,
    }
}

/// Goes on where slopes jump.
fn better_along_kinks(problem: &Scaled<'_>, from: EndPlace) -> EndPlace {
    let Some(found) = bundle(problem, &from.at, FALL) else {
        return from;
    };
    match place(problem, &found.at, Some(&found.pieces)) {
        Some(found) if is_better(&found, &from) => found,
        Some(found) if found.stationary && found.violation <= FEASIBLE => found,
        Some(_) | None => from,
    }
}

/// Whether one place is better than another: less violated, or as good and with a better goal.
pub(super) fn is_better(one: &EndPlace, other: &EndPlace) -> bool {
    let feasible = [one, other].map(|end| end.violation <= FEASIBLE);
    match feasible {
        [true, true] => one.values.objective < other.values.objective,
        [true, false] => true,
        [false, true] => false,
        [false, false] => one.violation < other.violation,
    }
}

/// The best goal so far, where it was bettered.
fn progress(trace: &[Option<Looked>], sign: f64) -> Vec<(usize, f64)> {
    let mut best: Vec<(usize, f64)> = Vec::new();
    for (number, looked) in trace.iter().enumerate() {
        let Some(looked) = looked.as_ref().filter(|one| one.violation <= FEASIBLE) else {
            continue;
        };
        if best
            .last()
            .is_none_or(|(_, goal)| sign * looked.goal < sign * goal)
        {
            best.push((number + 1, looked.goal));
        }
    }
    best
}
