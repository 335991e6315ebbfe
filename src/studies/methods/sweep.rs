//! The same over a parameter: where each method starts to fail as the scene changes.

use super::line::MethodLine;
use super::setting::{first_step, is_fixed_step};
use super::stability::Spectrum;
use super::study::{Now, Plan, Study, judge_working, start, study};
use super::verdict::Verdict;
use crate::dynamics::integrate::{Dynamics, Method};
use crate::dynamics::system::System;
use crate::studies::axis::Axis;
use crate::studies::judgement::Judgement as Working;
use crate::studies::{Control, RunSettings};
use serde::Serialize;

/// Tolerances at every value: the asked accuracy and these shares of it.
const SHARES: [f64; 4] = [1.0, 1e-1, 1e-2, 1e-3];

/// Finest tolerance that is tried.
const FINEST: f64 = 1e-13;

/// Halvings of the first step.
const STEPS: i32 = 7;

/// Methods over a parameter.
#[derive(Clone, Debug, PartialEq, Serialize)]
pub struct Sweep {
    /// Version of the document: 1.
    pub dam: u32,
    /// The parameter and its values, with the unit that they are shown in
    /// ([`Axis::display_unit`]).
    pub axis: Axis,
    /// False when interrupted.
    pub complete: bool,
    /// The verdict: a doubt about a reference takes all trust; the mechanism is not judged.
    pub verdict: Working,
    /// The step at which methods of fixed step are judged over the whole axis (s).
    pub fixed_step: Option<f64>,
    /// Slices, one a value.
    pub slices: Vec<Slice>,
}

/// All methods at one value of the parameter.
#[derive(Clone, Debug, PartialEq, Serialize)]
pub struct Slice {
    /// The value, in the axis's unit.
    pub x: f64,
    /// The study; its first points are at the accuracy asked for.
    pub study: Study,
}

/// Standing of a method at one value.
#[derive(Clone, Debug, PartialEq, Serialize)]
pub struct MethodStanding {
    /// The verdict at the asked accuracy (at the fixed step for methods of
    /// fixed step).
    pub verdict: Verdict,
    /// Cause of the verdict.
    pub cause: String,
    /// Least time to an error within the accuracy (s); null: not reached.
    pub measured_seconds: Option<f64>,
    /// Evaluations of that point.
    pub evaluations: Option<u64>,
    /// Greatest stable step, measured (s).
    pub stable_step: Option<f64>,
    /// Greatest stable step by theory (s).
    pub stable_step_by_theory: Option<f64>,
}

impl Sweep {
    /// True where the reference is in doubt at some value.
    pub fn is_doubted(&self) -> bool {
        self.slices.iter().any(|slice| slice.study.doubt.is_some())
    }
}

impl Slice {
    /// Standing of a method here; `None`: it was not tried.
    pub fn standing(&self, method: Method) -> Option<MethodStanding> {
        let line = self.study.methods.iter().find(|l| l.method == method)?;
        let first = line.points.first()?;
        let best = cheapest(line, self.study.accuracy);
        Some(MethodStanding {
            verdict: first.verdict,
            cause: first.cause.clone(),
            measured_seconds: best.and_then(|point| point.measured_seconds),
            evaluations: best.and_then(|point| point.evaluations),
            stable_step: line.stability.measured_step,
            stable_step_by_theory: line.stability.theory_step,
        })
    }
}

/// The fastest point of a method that is within the accuracy.
fn cheapest(line: &MethodLine, accuracy: f64) -> Option<&super::Point> {
    let fit = line.points.iter().filter(|point| {
        point.verdict.has_an_error() && point.error.is_some_and(|error| error <= accuracy)
    });
    fit.min_by(|a, b| {
        let seconds = |p: &super::Point| p.measured_seconds.unwrap_or(f64::INFINITY);
        seconds(a).total_cmp(&seconds(b))
    })
}

/// Studies the methods of a plan at every value of an axis. `prepare` makes the
/// system of a value; `progress` hears of every value and point.
///
/// Methods of fixed step are judged at one and the same step throughout: the
/// first of `plan.steps`, else half the greatest stable one at the first value.
///
/// # Errors
/// The first error of `prepare`, or of a start that cannot be found, at any value:
/// all are tried before the first is studied.
pub fn sweep<E>(
    axis: &Axis,
    plan: &Plan,
    control: &Control<'_>,
    mut prepare: impl FnMut(f64) -> Result<(System, RunSettings), E>,
    mut fail: impl FnMut(f64, Vec<crate::fault::Fault>) -> E,
    progress: &mut dyn FnMut(usize, &Now),
) -> Result<Sweep, E> {
    let mut found = Sweep {
        dam: 1,
        axis: axis.clone(),
        complete: true,
        verdict: Working::NotJudged,
        fixed_step: None,
        slices: Vec::new(),
    };
    for x in axis.values() {
        let (system, _) = prepare(x)?;
        found.axis.unit = axis.display_unit(system.model());
        start(&system).map_err(|faults| fail(x, faults))?;
    }
    for (index, x) in axis.values().into_iter().enumerate() {
        let (system, settings) = prepare(x)?;
        if found.fixed_step.is_none() {
            found.fixed_step = fixed_step(&system, &settings, plan);
        }
        let plan = at_value(plan, found.fixed_step);
        let mut tell = |now: &Now| progress(index, now);
        let study = study(&system, &settings, &plan, control, &mut tell)
            .map_err(|faults| fail(x, faults))?;
        let complete = study.complete;
        if complete {
            found.slices.push(Slice { x, study });
        } else {
            found.complete = false;
            break;
        }
    }
    found.verdict = judge_working(found.complete, found.is_doubted());
    Ok(found)
}

/// The step at which methods of fixed step are judged.
fn fixed_step(system: &System, settings: &RunSettings, plan: &Plan) -> Option<f64> {
    let method = plan.methods.iter().copied().find(|&m| is_fixed_step(m))?;
    let given = plan.steps.as_ref().and_then(|steps| steps.first().copied());
    given.or(settings.step).or_else(|| {
        let spectrum = Spectrum::of(system, system.coordinates());
        let stable = spectrum.bound(method).map(|bound| 0.5 * bound.step());
        Some(stable.unwrap_or_else(|| first_step(method, &spectrum, settings.duration)))
    })
}

/// The plan at one value: tolerances from the accuracy downwards, steps from
/// the fixed one.
fn at_value(plan: &Plan, fixed_step: Option<f64>) -> Plan {
    let tolerances = SHARES
        .iter()
        .map(|share| (share * plan.accuracy).max(FINEST));
    let mut tolerances: Vec<f64> = tolerances.collect();
    tolerances.dedup();
    Plan {
        tolerances,
        steps: fixed_step.map(|step| (0..STEPS).map(|k| step * 0.5f64.powi(k)).collect()),
        ..plan.clone()
    }
}
