//! All starts, and the optima at which they end.

use super::Optimization;
use super::conflict::least_violation;
use super::evaluate::OptimizationTask;
use super::result::{FlatStretch, HeldBound, HeldCondition, Optimum, SlopeSources, StartEnd};
use super::scaled::{FEASIBLE, Scaled, Scales, goal};
use super::start::{EndPlace, Ended, go};
use crate::math::optimise::constrained::{FlatDirection, Problem, flat_directions, starts};
use crate::studies::gradient::unit_of;
use crate::studies::side_by_side::side_by_side;
use std::sync::atomic::Ordering::Relaxed;
use std::sync::{Mutex, PoisonError};

/// Distance of two optima, as a share of the range of a variable, from which on they are distinct.
const DISTINCT: f64 = 0.01;

/// Difference of goals, as a share of their size, within which two optima are as good.
const AS_GOOD: f64 = 1e-6;

/// Share of the size of a goal that is rounding.
const ROUNDING: f64 = 1e-10;

/// Finds the best values; `own`: the values of the scene itself, in the units of the variables.
pub(crate) fn optimize(
    mut task: OptimizationTask<'_>,
    own: &[f64],
    count: usize,
    threads: usize,
) -> Optimization {
    let places = places(&task, own, count);
    task.probe(&places);
    let task = &task;
    let figures = in_order(&places, threads, |at| task.figures_at(at).ok());
    let scales = scales(task, &places, &figures);
    let ended = in_order(&places, threads, |at| go(task, &scales, at));
    let mut found = Optimization {
        variables: task.variables.clone(),
        conditions: task.conditions.clone(),
        goal: task.goal.clone(),
        optima: Vec::new(),
        starts: ended.iter().map(|one| one.result.clone()).collect(),
        least_violation: None,
        finer: None,
        slopes: SlopeSources {
            exact: ended.iter().map(|one| one.slopes[0]).sum(),
            differences: ended.iter().map(|one| one.slopes[1]).sum(),
            why_differences: task.why_differences.clone(),
        },
        evaluations: 0,
        complete: true,
        rigid: None,
        settings: Vec::new(),
        scene_text: String::new(),
    };
    gather(task, &ended, &mut found);
    if found.optima.is_empty() && !task.control.is_spent() {
        found.least_violation = least_violation(task, &ended);
    }
    found.complete = !task.control.is_spent();
    found.evaluations = task.looked.load(Relaxed);
    found
}

/// Where the starts begin, as shares of the ranges: at the values that are given, then evenly.
fn places(task: &OptimizationTask<'_>, own: &[f64], count: usize) -> Vec<Vec<f64>> {
    let each = task.variables.iter().zip(own);
    let first = each.map(|(variable, own)| {
        let given = variable.start.unwrap_or(*own);
        variable.share(given).unwrap_or(0.5)
    });
    let evenly = (0..count.saturating_sub(1)).map(|number| {
        let number = u32::try_from(number).unwrap_or(u32::MAX);
        starts(number, task.variables.len())
    });
    std::iter::once(first.collect()).chain(evenly).collect()
}

/// What becomes of each place, worked out side by side, in their order.
fn in_order<T: Send>(
    places: &[Vec<f64>],
    threads: usize,
    of: impl Fn(&[f64]) -> T + Sync,
) -> Vec<T> {
    let found: Vec<Mutex<Option<T>>> = places.iter().map(|_| Mutex::default()).collect();
    let take = |(): &mut (), number: usize| {
        let own = of(&places[number]);
        *found[number].lock().unwrap_or_else(PoisonError::into_inner) = Some(own);
        true
    };
    side_by_side(places.len(), threads, || (), take);
    let found = found.into_iter();
    found
        .filter_map(|one| one.into_inner().unwrap_or_else(PoisonError::into_inner))
        .collect()
}

/// Sizes of the goal and of the conditions: how far they differ from start to start.
fn scales(
    task: &OptimizationTask<'_>,
    places: &[Vec<f64>],
    figures: &[Option<Vec<f64>>],
) -> Scales {
    let known = || {
        places
            .iter()
            .zip(figures)
            .filter_map(|(at, own)| Some((at, own.as_ref()?)))
    };
    let size = |values: Vec<f64>, own: f64| {
        let greatest = values.iter().copied().fold(f64::MIN, f64::max);
        let least = values.iter().copied().fold(f64::MAX, f64::min);
        let size = values
            .iter()
            .fold(own.abs(), |size, value| size.max(value.abs()));
        match (greatest - least).max(1e-3 * size) {
            spread if spread.is_finite() && spread > 0.0 => spread,
            _ => 1.0,
        }
    };
    let condition = |own: usize| {
        let limit = task.conditions[own].value;
        let figure = task.figure_of(own);
        size(known().map(|(_, all)| all[figure] - limit).collect(), limit)
    };
    let goal = match task.goal_variable() {
        Some(variable) => task.variables[variable].high - task.variables[variable].low,
        None => size(known().map(|(at, own)| goal(task, at, own)).collect(), 0.0),
    };
    Scales {
        goal,
        conditions: (0..task.conditions.len()).map(condition).collect(),
    }
}

/// The distinct optima, the best first, and which start ended at which.
fn gather(task: &OptimizationTask<'_>, ended: &[Ended], found: &mut Optimization) {
    let mut ends: Vec<(usize, Scaled<'_>, &EndPlace)> = (ended.iter().enumerate())
        .filter_map(|(number, one)| Some((number, one.found.as_ref()?)))
        .filter(|(_, end)| end.violation <= FEASIBLE)
        .map(|(number, end)| (number, Scaled::new(task, end.scales.clone()), end))
        .collect();
    let goal =
        |problem: &Scaled<'_>, end: &EndPlace| problem.sign() * problem.goal(&end.at, &end.figures);
    ends.sort_by(|(_, one, a), (_, other, b)| goal(one, a).total_cmp(&goal(other, b)));
    // Of those as good as the best what is stationary goes first, then the first start.
    if let Some((_, problem, end)) = ends.first() {
        let (best, room) = (goal(problem, end), as_good(problem, end));
        let as_good = ends.partition_point(|(_, one, a)| goal(one, a) <= best + room);
        ends[..as_good].sort_by_key(|(number, _, end)| (!end.stationary, *number));
    }
    for (number, problem, end) in &ends {
        let same = |known: &Optimum| is_same(known, end, problem);
        let at = match found.optima.iter().position(same) {
            Some(at) => at,
            None => {
                // Only an optimum is one; the best place that is known stands first all the same.
                if !end.stationary && !found.optima.is_empty() {
                    continue;
                }
                let is_best = found.optima.is_empty();
                found.optima.push(optimum(problem, end, is_best));
                found.optima.len() - 1
            }
        };
        found.optima[at].starts.push(*number);
        if found.starts[*number].end == StartEnd::Optimum {
            found.starts[*number].optimum = Some(at);
        }
    }
    for one in &mut found.optima {
        one.starts.sort_unstable();
    }
}

/// Difference of goals within which an end is as good as another one, in the unit of the goal.
fn as_good(problem: &Scaled<'_>, end: &EndPlace) -> f64 {
    let goal = problem.goal(&end.at, &end.figures).abs();
    (AS_GOOD * end.scales.goal.min(goal)).max(ROUNDING * end.scales.goal)
}

/// Whether a place is an optimum that is known: near it, or on its stretch of equally good places.
fn is_same(known: &Optimum, end: &EndPlace, problem: &Scaled<'_>) -> bool {
    let at = end.at.as_slice();
    let near = |one: &[f64], within: f64| {
        let mut each = one.iter().zip(at);
        each.all(|(a, b)| (a - b).abs() <= within)
    };
    if near(&known.at, DISTINCT) {
        return true;
    }
    (known.goal - problem.goal(at, &end.figures)).abs() <= as_good(problem, end)
        && known.flat.iter().any(|stretch| {
            let [from, to] = &stretch.ends;
            let along: Vec<f64> = from.iter().zip(to).map(|(a, b)| b - a).collect();
            let square: f64 = along.iter().map(|x| x * x).sum();
            let to_place = from.iter().zip(at).zip(&along);
            let share: f64 = to_place.map(|((a, x), d)| (x - a) * d).sum::<f64>() / square;
            let share = share.clamp(0.0, 1.0);
            let on: Vec<f64> = from
                .iter()
                .zip(&along)
                .map(|(a, d)| a + share * d)
                .collect();
            near(&on, DISTINCT)
        })
}

/// What a place where a start ended is worth. `stretches`: flat stretches are looked for.
fn optimum(problem: &Scaled<'_>, end: &EndPlace, stretches: bool) -> Optimum {
    let task = problem.task;
    let flat = match stretches && end.stationary {
        true => problem.slopes(&end.at).map_or_else(Vec::new, |slopes| {
            flat_directions(problem, &end.at, (&end.values, &slopes), &end.held)
        }),
        false => Vec::new(),
    };
    let mut conditions: Vec<Option<HeldCondition>> = vec![None; task.conditions.len()];
    for (at, &own) in problem.order.iter().enumerate() {
        conditions[own] = Some(held_condition(problem, end, at, own));
    }
    let stretch = |FlatDirection { ends }: FlatDirection| FlatStretch {
        from: task.values_of(&ends[0]),
        to: task.values_of(&ends[1]),
        ends,
    };
    Optimum {
        values: task.values_of(&end.at),
        goal: problem.goal(&end.at, &end.figures),
        conditions: conditions.into_iter().flatten().collect(),
        bounds: held_bounds(problem, end),
        residual: Some(end.held.residual).filter(|residual| residual.is_finite()),
        stationary: end.stationary,
        flat: flat.into_iter().map(stretch).collect(),
        starts: Vec::new(),
        at: end.at.clone(),
    }
}

fn held_condition(problem: &Scaled<'_>, end: &EndPlace, at: usize, own: usize) -> HeldCondition {
    let task = problem.task;
    let condition = &task.conditions[own];
    let multiplier = end.held.conditions[at];
    let active = at < problem.equalities() || multiplier > 0.0;
    // What a looser limit gains, in the units of both.
    let sized = multiplier * problem.scales.goal / problem.scales.conditions[own];
    HeldCondition {
        figure: end.figures[task.figure_of(own)],
        active,
        multiplier: active.then(|| -problem.sign() * problem.toward(own) * sized),
        unit: unit_of(&task.goal.unit, &condition.unit),
    }
}

fn held_bounds(problem: &Scaled<'_>, end: &EndPlace) -> Vec<HeldBound> {
    let task = problem.task;
    let bounds = end.held.bounds.iter().enumerate();
    let held = bounds.filter(|(_, multiplier)| **multiplier != 0.0);
    held.map(|(at, multiplier)| {
        let variable = &task.variables[at];
        let size = problem.scales.goal / variable.slope(end.at[at]);
        HeldBound {
            variable: variable.path.clone(),
            upper: end.at[at] > 0.5,
            multiplier: problem.sign() * multiplier * size,
            unit: unit_of(&task.goal.unit, &variable.unit),
        }
    })
    .collect()
}
