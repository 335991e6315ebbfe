//! Where no place meets all conditions: the least violation, and which conditions it is between.

use super::evaluate::OptimizationTask;
use super::result::LeastViolation;
use super::scaled::{FEASIBLE, Scaled};
use super::start::Ended;
use crate::math::optimise::constrained::{Problem, Slopes, SmoothPiece, Values, multipliers, sqp};
use crate::studies::condition::Relation;

/// A step that promises less than this is none.
const ACCURACY: f64 = 1e-12;

/// Most steps.
const STEPS: u64 = 200;

/// Share of the greatest multiplier from which on a condition is in conflict.
const COUNTS: f64 = 1e-6;

/// The conditions, each with the room of one more variable, which is to be least.
struct Relaxed<'r, 't> {
    of: &'r Scaled<'t>,
    /// Greatest value of the room.
    most: f64,
}

impl Relaxed<'_, '_> {
    fn own(&self) -> usize {
        self.of.variables()
    }

    /// The conditions as they are to be at most zero: an equality from both sides.
    fn signs(&self) -> Vec<(usize, f64)> {
        let all = self.of.equalities() + self.of.inequalities();
        let below = (0..self.of.equalities()).map(|own| (own, -1.0));
        (0..all).map(|own| (own, 1.0)).chain(below).collect()
    }
}

impl Problem for Relaxed<'_, '_> {
    fn variables(&self) -> usize {
        self.own() + 1
    }

    fn equalities(&self) -> usize {
        0
    }

    fn inequalities(&self) -> usize {
        2 * self.of.equalities() + self.of.inequalities()
    }

    fn values(&self, at: &[f64]) -> Option<Values> {
        let room = at[self.own()];
        let found = self.of.values(&at[..self.own()])?;
        let condition = |(own, sign): (usize, f64)| sign * found.conditions[own] / self.most - room;
        Some(Values {
            objective: room,
            conditions: self.signs().into_iter().map(condition).collect(),
        })
    }

    fn slopes(&self, at: &[f64]) -> Option<Slopes> {
        let found = self.of.slopes(&at[..self.own()])?;
        let condition = |(own, sign): (usize, f64)| {
            let slopes = found.conditions[own]
                .iter()
                .map(|slope| sign * slope / self.most);
            slopes.chain([-1.0]).collect()
        };
        let mut objective = vec![0.0; self.own()];
        objective.push(1.0);
        Some(Slopes {
            objective,
            conditions: self.signs().into_iter().map(condition).collect(),
        })
    }
}

/// The least violation from where the starts ended; `None`: none ended anywhere.
pub(super) fn least_violation(
    task: &OptimizationTask<'_>,
    ended: &[Ended],
) -> Option<LeastViolation> {
    let ends = ended.iter().filter_map(|one| one.found.as_ref());
    let best = ends.min_by(|a, b| a.violation.total_cmp(&b.violation))?;
    if best.violation <= FEASIBLE {
        return None;
    }
    let problem = Scaled::new(task, best.scales.clone());
    let relaxed = Relaxed {
        of: &problem,
        most: 2.0 * best.violation,
    };
    let mut start = best.at.clone();
    start.push(0.5);
    let (found, _) = sqp(&relaxed, &start, ACCURACY, STEPS);
    let found = match relaxed.values(&found) {
        Some(values) if values.violation(0) <= FEASIBLE && found[relaxed.own()] <= 0.5 => found,
        _ => start,
    };
    let at = &found[..relaxed.own()];
    let figures = problem.figures(at)?;
    let values = relaxed.values(&found)?;
    let active: Vec<bool> = values
        .conditions
        .iter()
        .map(|value| *value >= -1e-6)
        .collect();
    let held = multipliers(
        &relaxed,
        &found,
        &active,
        &SmoothPiece::all(&relaxed.slopes(&found)?),
    );
    let greatest = held.conditions.iter().copied().fold(0.0, f64::max);
    let counts = |own: &usize| held.conditions[*own] > COUNTS * greatest;
    let mut conflict: Vec<usize> = (0..active.len())
        .filter(counts)
        .map(|own| problem.order[relaxed.signs()[own].0])
        .collect();
    conflict.sort_unstable();
    conflict.dedup();
    let bounds = task.variables.iter().zip(&held.bounds);
    let bounds = bounds.filter(|(_, held)| **held != 0.0);
    let violation = |(own, condition): (usize, &crate::studies::condition::Condition)| {
        let margin = condition.margin(figures[task.figure_of(own)]);
        match condition.relation {
            Relation::Equal => margin.abs(),
            Relation::AtMost | Relation::AtLeast => (-margin).max(0.0),
        }
    };
    Some(LeastViolation {
        values: task.values_of(at),
        violations: task.conditions.iter().enumerate().map(violation).collect(),
        figures: (0..task.conditions.len())
            .map(|own| figures[task.figure_of(own)])
            .collect(),
        conflict,
        bounds: bounds.map(|(variable, _)| variable.path.clone()).collect(),
    })
}
