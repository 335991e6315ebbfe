//! The scene at a place: its figures, and their slopes.

use super::Variable;
use crate::dynamics::system::System;
use crate::frontend::lower::lower;
use crate::studies::condition::Condition;
use crate::studies::find::Goal;
use crate::studies::gradient::{DerivativeVerdict, Parameter, Place, Subject, gradient};
use crate::studies::prepared::{Prepared, Verdict};
use crate::studies::{Control, RunSettings};
use std::sync::atomic::{AtomicUsize, Ordering::Relaxed};

/// A scene with what is chosen and what is asked.
pub(crate) struct OptimizationTask<'t> {
    /// What is chosen.
    pub(crate) variables: Vec<Variable>,
    /// Under which conditions.
    pub(crate) conditions: Vec<Condition>,
    /// What is to be least or greatest.
    pub(crate) goal: Goal,
    /// The figures of the goal and of the conditions, each once.
    pub(crate) figures: Vec<AskedFigure>,
    /// The scene, made ready for the figures that runs and studies have.
    pub(crate) prepared: Prepared<'t>,
    /// Why no figure has exact slopes; empty: some may have.
    pub(crate) why_differences: String,
    /// Step of the differences of all others, as a share of the range.
    pub(crate) step: f64,
    /// How long it may take.
    pub(crate) control: &'t Control<'t>,
    /// Receives the number of places that were looked at, from any thread.
    pub(crate) heard: &'t (dyn Fn(usize) + Sync),
    /// The number of places.
    pub(crate) looked: AtomicUsize,
}

/// A figure that is asked for.
#[derive(Clone, Debug)]
pub(crate) struct AskedFigure {
    /// Address.
    pub(crate) address: String,
    /// SI unit.
    pub(crate) unit: String,
    /// Its index among those of the prepared scene; `None`: it comes with the derivatives alone.
    pub(crate) index: Option<usize>,
    /// Whether it may have exact slopes.
    pub(crate) smooth: bool,
}

/// Slopes of all figures over the shares of the ranges.
#[derive(Clone, Debug)]
pub(super) struct FigureSlopes {
    /// Of each figure by each variable.
    pub(super) values: Vec<Vec<f64>>,
    /// Of which figures they are exact.
    pub(super) exact: Vec<bool>,
}

/// Derivatives of the figures that have them, as [`gradient`] gives them.
type Exact = Vec<Option<(f64, Option<Vec<f64>>)>>;

impl OptimizationTask<'_> {
    /// The values of the variables at a place, in their units.
    pub(super) fn values_of(&self, at: &[f64]) -> Vec<f64> {
        let each = self.variables.iter().zip(at);
        each.map(|(variable, share)| variable.value(*share))
            .collect()
    }

    /// The figures at a place (SI).
    ///
    /// # Errors
    /// Why one has no value there.
    pub(super) fn figures_at(&self, at: &[f64]) -> Result<Vec<f64>, String> {
        let found = self.figures_with(at, None);
        (self.heard)(self.looked.fetch_add(1, Relaxed) + 1);
        found
    }

    fn figures_with(&self, at: &[f64], exact: Option<&Exact>) -> Result<Vec<f64>, String> {
        // (A scene may take long before its run listens.)
        if self.control.is_spent() {
            return Err(ENDED.to_owned());
        }
        let values = self.values_of(at);
        let mut found = vec![f64::NAN; self.figures.len()];
        if self.figures.iter().any(|one| one.index.is_some()) {
            let point = self.prepared.point(&values, self.control);
            let point = point.ok_or_else(|| ENDED.to_owned())?;
            let failed = || match point.cause.is_empty() {
                true => point.verdict.words().to_owned(),
                false => format!("{}: {}", point.verdict.words(), point.cause),
            };
            if !has_values(point.verdict) {
                return Err(failed());
            }
            for (value, figure) in found.iter_mut().zip(&self.figures) {
                let Some(index) = figure.index else { continue };
                *value = (point.value(index))
                    .ok_or_else(|| format!("`{}` has no value: {}", figure.address, failed()))?;
            }
        }
        if self.figures.iter().any(|one| one.index.is_none()) {
            let own;
            let exact = match exact {
                Some(exact) => exact,
                None => {
                    own = self.derivatives(at)?;
                    &own
                }
            };
            let missing = |figure: &AskedFigure| {
                format!(
                    "`{}` has no value: the contact separates, or nothing is known of it",
                    figure.address
                )
            };
            for (at, figure) in self.figures.iter().enumerate() {
                if figure.index.is_none() {
                    let value = exact[at].as_ref().map(|(value, _)| *value);
                    found[at] = value.ok_or_else(|| missing(figure))?;
                }
            }
        }
        match found.iter().all(|value| value.is_finite()) {
            true => Ok(found),
            false => Err("a result is not finite".to_owned()),
        }
    }

    /// The slopes at a place, where the figures are known.
    ///
    /// # Errors
    /// Why there are none.
    pub(super) fn slopes_at(&self, at: &[f64], figures: &[f64]) -> Result<FigureSlopes, String> {
        let count = self.figures.len();
        let mut found = FigureSlopes {
            values: vec![Vec::new(); count],
            exact: vec![false; count],
        };
        if self.figures.iter().any(|one| one.smooth)
            && let Ok(exact) = self.derivatives(at)
        {
            for (own, derivatives) in exact.into_iter().enumerate() {
                if let Some((_, Some(slopes))) = derivatives {
                    (found.values[own], found.exact[own]) = (slopes, true);
                }
            }
        }
        if found.exact.iter().any(|exact| !exact) {
            let all = self.differences(at, figures)?;
            for (own, slopes) in all.into_iter().enumerate() {
                if !found.exact[own] {
                    found.values[own] = slopes;
                }
            }
        }
        Ok(found)
    }

    /// Central differences; one-sided ones of order 2 at the ends of a range.
    fn differences(&self, at: &[f64], figures: &[f64]) -> Result<Vec<Vec<f64>>, String> {
        let mut found = vec![Vec::with_capacity(at.len()); self.figures.len()];
        for variable in 0..at.len() {
            let x = at[variable];
            let moved = |steps: f64| {
                let mut place = at.to_vec();
                place[variable] = x + steps * self.step;
                self.figures_at(&place)
            };
            let (one, other, weights) = match (x < self.step, x > 1.0 - self.step) {
                (true, _) => (1.0, 2.0, [-1.5, 2.0, -0.5]),
                (false, true) => (-1.0, -2.0, [1.5, -2.0, 0.5]),
                (false, false) => (1.0, -1.0, [0.0, 0.5, -0.5]),
            };
            let (first, second) = (moved(one)?, moved(other)?);
            for (own, slopes) in found.iter_mut().enumerate() {
                let sum =
                    weights[0] * figures[own] + weights[1] * first[own] + weights[2] * second[own];
                slopes.push(sum / self.step);
            }
        }
        Ok(found)
    }

    /// Learns whether results have exact slopes: at the first of some places at which the scene can
    /// be. If none has, all are differences from now on.
    pub(super) fn probe(&mut self, places: &[Vec<f64>]) {
        if !self.figures.iter().any(|one| one.smooth) {
            return;
        }
        let mut first = None;
        for place in places {
            match self.derivatives(place) {
                Ok(_) => return,
                Err(_) if self.control.is_spent() => return,
                Err(why) => first = first.or(Some(why)),
            }
        }
        self.why_differences = first.unwrap_or_default();
        self.figures.iter_mut().for_each(|one| one.smooth = false);
    }

    /// Values and exact slopes over the shares; of a figure that has no value `None`, of one that
    /// is not smooth here no slopes.
    fn derivatives(&self, at: &[f64]) -> Result<Exact, String> {
        let smooth: Vec<usize> = (0..self.figures.len())
            .filter(|&own| self.figures[own].smooth || self.figures[own].index.is_none())
            .collect();
        let values = self.values_of(at);
        let sized = self.variables.iter().zip(&values);
        let parameters: Vec<Parameter> = sized
            .map(|(variable, value)| Parameter {
                path: variable.path.clone(),
                value: value * variable.size,
                unit: String::new(),
            })
            .collect();
        let values: Vec<f64> = parameters.iter().map(|one| one.value).collect();
        let base = self.place(&values).ok_or("there is no such mechanism")?;
        let addressed = |&own: &usize| {
            let figure = &self.figures[own];
            (figure.address.clone(), figure.unit.clone())
        };
        let subject = Subject {
            parameters,
            figures: smooth.iter().map(addressed).collect(),
            base,
            at: &|values| self.place(values),
            control: self.control,
            check: Some(false),
        };
        let found = gradient(&subject).map_err(|faults| {
            let first = faults.first();
            first.map_or_else(String::new, |fault| fault.message.clone())
        })?;
        if self.control.is_spent() {
            return Err(ENDED.to_owned());
        }
        let mut all: Exact = vec![None; self.figures.len()];
        for (own, figure) in smooth.into_iter().zip(found.figures) {
            let Some(value) = figure.value else { continue };
            let slope = |(variable, derivative): (usize, &crate::studies::gradient::Derivative)| {
                let exact = matches!(derivative.verdict, DerivativeVerdict::Exact);
                let slope = derivative.derivative.filter(|_| exact)?;
                let own = &self.variables[variable];
                Some(slope * own.size * own.slope(at[variable]))
            };
            let slopes: Option<Vec<f64>> = figure.by.iter().enumerate().map(slope).collect();
            all[own] = Some((value, slopes));
        }
        Ok(all)
    }

    /// The scene at values of the variables in SI units; `None`: it cannot be.
    fn place(&self, values: &[f64]) -> Option<Place> {
        let settings = self.variables.iter().zip(values);
        let settings = settings.map(|(variable, value)| {
            let parameter = crate::studies::axis::Parameter {
                path: variable.path.clone(),
                unit: String::new(),
            };
            parameter.setting(*value)
        });
        let reading = self.prepared.question.read(settings.collect()).ok()?;
        let model = lower(&reading.scene).ok()?;
        Some(Place {
            system: System::new(model).ok()?,
            settings: RunSettings::of(&reading.scene).ok()?,
        })
    }
}

/// Why there is no value after an end from outside.
pub(super) const ENDED: &str = "ended before it was known";

/// Whether the figures of a place with this verdict are values. Those of a mechanism that is far off
/// its law are not: its contact has no effect any more.
fn has_values(verdict: Verdict) -> bool {
    match verdict {
        Verdict::InWorkingOrder
        | Verdict::LiftOffDiesAway
        | Verdict::LiftOff
        | Verdict::LiftOffNotJudged
        | Verdict::CreepNotJudged
        | Verdict::NotJudged
        | Verdict::Resonance => true,
        Verdict::ThrownOff
        | Verdict::Stopped
        | Verdict::NotFinished
        | Verdict::NumericalFailure
        | Verdict::Refused => false,
    }
}
