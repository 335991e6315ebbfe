//! The question as the methods take it: one function and conditions, all about 1.

use super::evaluate::{FigureSlopes, OptimizationTask};
use crate::math::optimise::constrained::{Problem, Slopes, Values};
use crate::studies::condition::Relation;
use crate::studies::find::Aim;
use std::cell::{Cell, RefCell};

/// Violation that counts as none, scaled.
pub(super) const FEASIBLE: f64 = 1e-7;

/// Least size of the goal and of a condition about a place, as a share of their change from start
/// to start.
const GOAL_SHARE: f64 = 1e-4;
const CONDITION_SHARE: f64 = 1e-6;

/// Sizes of the goal and of the conditions.
#[derive(Clone, Debug, PartialEq)]
pub(super) struct Scales {
    pub(super) goal: f64,
    /// In the order of the conditions.
    pub(super) conditions: Vec<f64>,
}

/// What is known of a place that was looked at.
#[derive(Clone, Debug, PartialEq)]
pub(super) struct Looked {
    /// The goal in its unit.
    pub(super) goal: f64,
    /// The greatest violation, scaled.
    pub(super) violation: f64,
}

/// A place with its figures and values.
type Best = (Vec<f64>, Vec<f64>, Values);

/// The question of one start.
pub(super) struct Scaled<'t> {
    pub(super) task: &'t OptimizationTask<'t>,
    pub(super) scales: Scales,
    /// The conditions in the order of the methods: equalities first.
    pub(super) order: Vec<usize>,
    equalities: usize,
    /// Places in the order in which they were looked at; `None`: without values.
    pub(super) trace: RefCell<Vec<Option<Looked>>>,
    /// The best place that was looked at, with its figures and values.
    pub(super) best: RefCell<Option<Best>>,
    /// Why the last place without values has none.
    pub(super) cause: RefCell<String>,
    last: RefCell<Option<(Vec<f64>, Vec<f64>)>>,
    last_slopes: RefCell<Option<(Vec<f64>, FigureSlopes)>>,
    /// Numbers of slopes that were exact, and that were differences.
    pub(super) slopes: Cell<[usize; 2]>,
}

impl<'t> Scaled<'t> {
    pub(super) fn new(task: &'t OptimizationTask<'t>, scales: Scales) -> Self {
        let equal = |own: &usize| task.conditions[*own].relation == Relation::Equal;
        let (mut order, others): (Vec<usize>, Vec<usize>) =
            (0..task.conditions.len()).partition(equal);
        let equalities = order.len();
        order.extend(others);
        Self {
            task,
            scales,
            order,
            equalities,
            trace: RefCell::default(),
            best: RefCell::default(),
            cause: RefCell::default(),
            last: RefCell::default(),
            last_slopes: RefCell::default(),
            slopes: Cell::default(),
        }
    }

    /// The same question in other sizes; what was looked at is known further on.
    pub(super) fn with_scales(mut self, scales: Scales) -> Self {
        self.scales = scales;
        let best = self.best.take();
        let best = best.map(|(at, figures, _)| {
            let values = self.scaled(&at, &figures);
            (at, figures, values)
        });
        self.best.replace(best);
        self
    }

    /// Sizes about a place: how much goal and conditions change over the ranges by their slopes
    /// there. What lies far away from it, in a great range, does not count. `None`: no slopes are
    /// known there.
    pub(super) fn scales_at(&self, at: &[f64], overall: &Scales) -> Option<Scales> {
        let figures = self.figures(at)?;
        let slopes = self.figure_slopes(at)?;
        let steepness = |slopes: &[f64]| slopes.iter().map(|x| x * x).sum::<f64>().sqrt();
        let sound = |size: f64, other: f64| match size.is_finite() && size > 0.0 {
            true => size,
            false => other,
        };
        let goal = match self.task.goal_variable() {
            Some(variable) => self.task.variables[variable].slope(at[variable]).abs(),
            None => {
                let own = self.task.goal_figure();
                let least = (GOAL_SHARE * overall.goal).max(figures[own].abs().min(overall.goal));
                steepness(&slopes.values[own]).max(least)
            }
        };
        let condition = |own: usize| {
            let figure = self.task.figure_of(own);
            let limit = self.task.conditions[own].value.abs();
            let least = limit.max(CONDITION_SHARE * overall.conditions[own]);
            let size = steepness(&slopes.values[figure]).max(least);
            sound(size, overall.conditions[own])
        };
        Some(Scales {
            goal: sound(goal, overall.goal),
            conditions: (0..self.task.conditions.len()).map(condition).collect(),
        })
    }

    /// −1 of a greatest value: the methods look for the least.
    pub(super) fn sign(&self) -> f64 {
        match self.task.goal.aim {
            Aim::Minimize => 1.0,
            Aim::Maximize => -1.0,
        }
    }

    /// The goal at a place whose figures are known, in its unit.
    pub(super) fn goal(&self, at: &[f64], figures: &[f64]) -> f64 {
        goal(self.task, at, figures)
    }

    /// The figures at a place.
    pub(super) fn figures(&self, at: &[f64]) -> Option<Vec<f64>> {
        if let Some((place, found)) = &*self.last.borrow()
            && place == at
        {
            return Some(found.clone());
        }
        match self.task.figures_at(at) {
            Ok(found) => {
                self.last.replace(Some((at.to_vec(), found.clone())));
                let values = self.scaled(at, &found);
                let looked = Looked {
                    goal: self.goal(at, &found),
                    violation: values.violation(self.equalities),
                };
                self.trace.borrow_mut().push(Some(looked));
                self.keep_best(at, &found, values);
                Some(found)
            }
            Err(why) => {
                self.cause.replace(why);
                self.trace.borrow_mut().push(None);
                None
            }
        }
    }

    fn keep_best(&self, at: &[f64], figures: &[f64], values: Values) {
        let rank = |values: &Values| {
            let violation = values.violation(self.equalities);
            match violation <= FEASIBLE {
                true => (0.0, values.objective),
                false => (violation, 0.0),
            }
        };
        let mut best = self.best.borrow_mut();
        if (best.as_ref()).is_none_or(|(_, _, known)| rank(&values) < rank(known)) {
            *best = Some((at.to_vec(), figures.to_vec(), values));
        }
    }

    fn scaled(&self, at: &[f64], figures: &[f64]) -> Values {
        let condition = |&own: &usize| {
            let condition = &self.task.conditions[own];
            let above = figures[self.task.figure_of(own)] - condition.value;
            self.toward(own) * above / self.scales.conditions[own]
        };
        Values {
            objective: self.sign() * self.goal(at, figures) / self.scales.goal,
            conditions: self.order.iter().map(condition).collect(),
        }
    }

    /// −1 of a condition whose figure is to be greater than its limit.
    pub(super) fn toward(&self, condition: usize) -> f64 {
        match self.task.conditions[condition].relation {
            Relation::AtMost | Relation::Equal => 1.0,
            Relation::AtLeast => -1.0,
        }
    }

    /// The slopes of the figures at a place.
    pub(super) fn figure_slopes(&self, at: &[f64]) -> Option<FigureSlopes> {
        if let Some((place, found)) = &*self.last_slopes.borrow()
            && place == at
        {
            return Some(found.clone());
        }
        let figures = self.figures(at)?;
        match self.task.slopes_at(at, &figures) {
            Ok(found) => {
                let [exact, differences] = self.slopes.get();
                let own = found.exact.iter().filter(|exact| **exact).count();
                self.slopes
                    .set([exact + own, differences + found.exact.len() - own]);
                self.last_slopes.replace(Some((at.to_vec(), found.clone())));
                Some(found)
            }
            Err(why) => {
                self.cause.replace(why);
                None
            }
        }
    }
}

/// The goal at a place whose figures are known, in its unit.
pub(super) fn goal(task: &OptimizationTask<'_>, at: &[f64], figures: &[f64]) -> f64 {
    match task.goal_variable() {
        Some(variable) => task.variables[variable].value(at[variable]),
        None => figures[task.goal_figure()],
    }
}

impl OptimizationTask<'_> {
    /// The variable that is itself to be least or greatest.
    pub(super) fn goal_variable(&self) -> Option<usize> {
        let of = self.goal.of.as_str();
        match self.goal.is_parameter {
            true => self.variables.iter().position(|one| one.path == of),
            false => None,
        }
    }

    fn goal_figure(&self) -> usize {
        self.figure_named(&self.goal.of)
    }

    /// The index of the figure of a condition.
    pub(super) fn figure_of(&self, condition: usize) -> usize {
        self.figure_named(&self.conditions[condition].figure)
    }

    fn figure_named(&self, address: &str) -> usize {
        let found = self.figures.iter().position(|one| one.address == address);
        found.expect("the figures of goal and conditions are asked for")
    }
}

impl Problem for Scaled<'_> {
    fn variables(&self) -> usize {
        self.task.variables.len()
    }

    fn equalities(&self) -> usize {
        self.equalities
    }

    fn inequalities(&self) -> usize {
        self.order.len() - self.equalities
    }

    fn values(&self, at: &[f64]) -> Option<Values> {
        let figures = self.figures(at)?;
        Some(self.scaled(at, &figures))
    }

    fn slopes(&self, at: &[f64]) -> Option<Slopes> {
        let found = self.figure_slopes(at)?;
        let objective = match self.task.goal_variable() {
            Some(variable) => {
                let mut slopes = vec![0.0; at.len()];
                slopes[variable] = self.task.variables[variable].slope(at[variable]);
                slopes
            }
            None => found.values[self.task.goal_figure()].clone(),
        };
        let scale = self.sign() / self.scales.goal;
        let condition = |&own: &usize| {
            let scale = self.toward(own) / self.scales.conditions[own];
            let slopes = &found.values[self.task.figure_of(own)];
            slopes.iter().map(|slope| scale * slope).collect()
        };
        let slopes = Slopes {
            objective: objective.into_iter().map(|slope| scale * slope).collect(),
            conditions: self.order.iter().map(condition).collect(),
        };
        let finite = slopes
            .conditions
            .iter()
            .chain([&slopes.objective])
            .flatten();
        let finite = finite.copied().all(f64::is_finite);
        finite.then_some(slopes)
    }
}
