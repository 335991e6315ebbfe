//! One point: what the scene is, does and is worth at some values of its parameters.

use super::bench::{Bench, MotionCache};
use super::ends::failure_verdict;
use super::figure::{FoundFigures, requested};
use super::judge::{self, Begun, Evidence, judge};
use super::question::PointQuestion;
use super::rigid::RigidMotion;
use super::verdict::Verdict;
use crate::dynamics::integrate::Method;
use crate::dynamics::record::{Quantity, Record, drive_cycle};
use crate::dynamics::system::System;
use crate::exact::{KeptLaws, RequestedFigures};
use crate::fault::Fault;
use crate::frontend::lower::lower;
use crate::frontend::scene::TypedScene;
use crate::studies::clock::not_followable;
use crate::studies::demand::Demand;
use crate::studies::document::doubts;
use crate::studies::run::{Motion, motion};
use crate::studies::spread::{CHANGE, with_scaled_loads};
use crate::studies::{Control, RunSettings, lookup};
use crate::units::shown;
use std::cell::RefCell;

/// Most steps of the run of one point: where a general method would crawl, a
/// study says so and goes on.
pub const MOST_STEPS: u64 = 20_000_000;

/// Samples in a cycle where the last cycles of an exact motion are looked at.
const SAMPLES: f64 = 256.0;

/// Most samples of such a run.
const MOST_SAMPLES: f64 = 1e6;

/// Factor on the tolerance of a general method below which a difference may be
/// its own: an accepted step here, a rejected one there.
const OWN_NOISE: f64 = 10.0;

/// Point: the scene at some values of its parameters.
#[derive(Clone, Debug, PartialEq)]
pub struct Point {
    /// The verdict.
    pub verdict: Verdict,
    /// Cause of the verdict in words.
    pub cause: String,
    /// The figures, in the order in which they were asked for.
    pub figures: Vec<PointFigure>,
    /// Least force of the force-closed pairs of the rigid mechanism: see
    /// [`RigidMotion::margin`].
    pub rigid_margin: Option<f64>,
    /// Warnings of the run that results are not determined: contacts that are open and closed
    /// at one instant, chaotic motion, peaks that may be rounding. Empty of most points.
    pub doubts: Vec<String>,
}

/// A figure at a point.
#[derive(Clone, Copy, Debug, Default, PartialEq)]
pub struct PointFigure {
    /// The value in SI units; `None` when there is none: the run stopped, failed or never
    /// began, or the figure is null. Never a number that is not finite.
    pub value: Option<f64>,
    /// How far the figure moves when all loads and gaps change by one part in
    /// 10¹⁰, as a share of its scale; `None`: not asked, no value, or the figure is
    /// gone then.
    pub moved: Option<f64>,
    /// Whether the figure is known to the digits asked for ([`PointQuestion::digits`]):
    /// it moves by no more than one of the last; `None`: not asked, or no value.
    pub determined: Option<bool>,
}

impl Point {
    fn without_values(verdict: Verdict, cause: String) -> Self {
        Self {
            verdict,
            cause,
            figures: Vec::new(),
            rigid_margin: None,
            doubts: Vec::new(),
        }
    }

    /// The value of the figure at an index of those asked for; `None`: it has none here.
    pub fn value(&self, index: usize) -> Option<f64> {
        self.figures.get(index)?.value
    }
}

/// Works out one point; `None` when interrupted. `checked`: its equations of motion are
/// checked.
pub(in crate::studies) fn evaluate(
    question: &PointQuestion<'_>,
    bench: &mut Bench,
    (values, checked): (&[f64], bool),
    control: &Control<'_>,
) -> Option<Point> {
    let point = bench.show(question, values, |scene| {
        let refused = |cause: String| Some(Point::without_values(Verdict::Refused, cause));
        match scene {
            Ok((scene, kept)) => match prepare(scene, &question.figures) {
                Ok((system, settings)) => point_of_system(
                    (question, checked),
                    (scene, &system),
                    &settings,
                    kept,
                    control,
                ),
                Err(faults) => refused(in_words(&faults)),
            },
            Err(diagnostics) => {
                let errors = diagnostics.items.iter();
                let first = errors.map(|item| item.message.as_str()).next();
                refused(first.unwrap_or("the scene is wrong").to_owned())
            }
        }
    });
    let mut point = point?;
    let count = question.figures.len();
    point.figures.resize(count, PointFigure::default());
    Some(point)
}

/// The point of a system; `None` when interrupted.
fn point_of_system(
    (question, checked): (&PointQuestion<'_>, bool),
    (scene, system): (&TypedScene, &System),
    settings: &RunSettings,
    kept: &mut MotionCache,
    control: &Control<'_>,
) -> Option<Point> {
    let rigid = kept.rigid_motion(system.model(), settings.duration);
    if let Some(samples) = &kept.samples {
        system.take_samples(samples.clone());
    }
    let task = Task {
        question,
        scene,
        system,
        settings,
        laws: &kept.exact,
        control,
        checked,
    };
    let found = task.answer(&rigid);
    if kept.samples.is_none() {
        kept.samples = system.samples_of_laws();
    }
    let point = match found {
        Ok(point) => point?,
        Err(faults) => Point::without_values(verdict_on(&faults), in_words(&faults)),
    };
    Some(Point {
        rigid_margin: rigid.margin,
        ..point
    })
}

/// What becomes of a point of which a study has no answer.
fn verdict_on(faults: &[Fault]) -> Verdict {
    match faults.iter().any(|fault| fault.code == lookup::NOT_TRUSTED) {
        true => Verdict::NumericalFailure,
        false => Verdict::Refused,
    }
}

/// A system and how to run it for some figures.
fn prepare(scene: &TypedScene, figures: &[String]) -> Result<(System, RunSettings), Vec<Fault>> {
    let model = lower(scene)?;
    let mut settings = RunSettings::of(scene).map_err(|fault| vec![fault])?;
    let faults = not_followable(&model, &settings);
    if !faults.is_empty() {
        return Err(faults);
    }
    settings.max_steps = settings.max_steps.min(MOST_STEPS);
    settings.switch_rows = false;
    let spans = figures.iter().filter_map(|one| lookup::span_of_run(one));
    settings.spans = spans.collect();
    Ok((System::new(model)?, settings))
}

fn in_words(faults: &[Fault]) -> String {
    let Some(first) = faults.first() else {
        return "the scene is wrong".to_owned();
    };
    match first.path.is_empty() {
        true => first.message.clone(),
        false => format!("{}: {}", first.path, first.message),
    }
}

/// Task of a point: what is run, and what is asked of it.
#[derive(Clone, Copy)]
struct Task<'t> {
    question: &'t PointQuestion<'t>,
    scene: &'t TypedScene,
    system: &'t System,
    settings: &'t RunSettings,
    /// Laws of motion that are known from points before.
    laws: &'t RefCell<KeptLaws>,
    control: &'t Control<'t>,
    /// True: the equations of motion are checked.
    checked: bool,
}

impl Task<'_> {
    /// Runs the system and judges what it did; `None` when interrupted.
    fn answer(&self, rigid: &RigidMotion) -> Result<Option<Point>, Vec<Fault>> {
        let found = self.motion(self.system, self.settings)?;
        if found.outcome.stop.is_from_outside() {
            return Ok(None);
        }
        if let Some(point) = self.point_of_failed_run(&found) {
            return Ok(Some(point));
        }
        let cycle = drive_cycle(self.system.model()).ok();
        let (verdict, mut cause) = judge(&mut Evidence {
            system: self.system,
            figures: found.recorded.figures.iter().collect(),
            rigid,
            cycle,
            time: found.outcome.time,
            steady: &mut |object, begun| self.greatest_in_last_cycle(&found, object, begun, cycle?),
        });
        if found.grazing > 0 {
            cause.push_str("; a contact grazes, its events are not certain");
        }
        // What was interrupted in between may have been judged by half of it.
        if self.control.is_spent() {
            return Ok(None);
        }
        let figures = self.values(self.system, self.settings, &found)?;
        let doubts = doubts(self.system.model(), &found.recorded);
        let mut point = Point {
            figures: figures.into_iter().map(PointFigure::of).collect(),
            doubts: doubts.map(|warning| warning.to_string()).collect(),
            ..Point::without_values(verdict, cause)
        };
        let has_values = point.figures.iter().any(|one| one.value.is_some());
        if let Some(digits) = self.question.digits.filter(|_| has_values) {
            let Some(moved) = self.moves(&found, &point)? else {
                return Ok(None);
            };
            let bound = bound(digits, &found, self.settings);
            note_sensitivity(&self.question.figures, &mut point, &moved, bound);
        }
        Ok(Some(point))
    }

    /// Runs a system for the figures and what a mechanism is judged by.
    fn motion(&self, system: &System, settings: &RunSettings) -> Result<Motion, Vec<Fault>> {
        let asked = requested(&self.question.figures, system.model());
        let of_object = |object: usize| match &asked {
            Some(asked) => asked[object],
            None => RequestedFigures::ALL,
        };
        let demand = Demand {
            figures: asked.is_some().then_some(&of_object),
            laws: Some(self.laws),
            checked: self.checked,
        };
        motion(system, settings, demand, self.control, &mut [])
    }

    /// The figures: of the run, or of other studies of the system.
    fn values(
        &self,
        system: &System,
        settings: &RunSettings,
        found: &Motion,
    ) -> Result<Vec<Option<f64>>, Vec<Fault>> {
        let of_run = FoundFigures::new(system.model(), settings, found);
        let mut of_studies = lookup::Lookup::new(lookup::Subject {
            scene: self.scene,
            system,
            settings,
            control: self.control,
        });
        let value = |figure: &String| {
            let value = match lookup::span_of_run(figure) {
                Some(span) => of_run.value_within(&span),
                None => match of_studies.figure(figure)? {
                    Some(of_study) => of_study.value,
                    None => of_run.value(figure),
                },
            };
            Ok(value.filter(|value| value.is_finite()))
        };
        self.question.figures.iter().map(value).collect()
    }

    /// The point of a run that did not come to its end or is not to be trusted.
    fn point_of_failed_run(&self, found: &Motion) -> Option<Point> {
        let (verdict, cause) = failure_verdict(self.system.model(), self.settings, found)?;
        Some(Point::without_values(verdict, cause))
    }

    /// Greatest |δ| of an object over the cycle before the last and over the last one.
    fn greatest_in_last_cycle(
        &self,
        found: &Motion,
        object: usize,
        begun: Begun,
        cycle: f64,
    ) -> Option<[f64; 2]> {
        let id = &self.system.model().objects[object].id;
        if begun == Begun::AsGiven && !found.recorded.record.times.is_empty() {
            return self.over_last_cycles(found, id, cycle);
        }
        // Run again for it, since few points ask.
        let on_law;
        let system = match begun {
            Begun::AsGiven => self.system,
            Begun::OnLaw => {
                on_law = System::new(judge::on_law(self.system.model())).ok()?;
                &on_law
            }
        };
        let samples = (self.settings.duration / cycle * SAMPLES).ceil();
        let settings = RunSettings {
            samples: match found.choice.method {
                Method::Exact => samples.clamp(SAMPLES, MOST_SAMPLES) as usize,
                _ => self.settings.samples,
            },
            ..self.settings.clone()
        };
        let demand = Demand {
            laws: Some(self.laws),
            ..Demand::EVERYTHING
        };
        let again = motion(system, &settings, demand, self.control, &mut []).ok()?;
        let good = again.is_complete() && self.point_of_failed_run(&again).is_none();
        good.then(|| self.over_last_cycles(&again, id, cycle))?
    }

    fn over_last_cycles(&self, found: &Motion, id: &str, cycle: f64) -> Option<[f64; 2]> {
        let window = found.window.as_ref().ok();
        let whole = (found.outcome.time / cycle * (1.0 + 1e-12)).floor() * cycle;
        let end = window.map_or(whole, |[_, to]| *to);
        greatest_in_last_cycle(&found.recorded.record, id, end, cycle)
    }

    /// How far each figure that has a value moves when loads and gaps change by [`CHANGE`],
    /// as a share of its scale; infinite when it is gone. `None` when interrupted.
    fn moves(&self, base: &Motion, point: &Point) -> Result<Option<Vec<f64>>, Vec<Fault>> {
        let same_method = RunSettings {
            method: Some(base.choice.method),
            // (Of `auto` finer than the one asked for.)
            tolerance: base.choice.tolerance,
            ..self.settings.clone()
        };
        let changed = with_scaled_loads(self.system.model().clone(), 1.0 + CHANGE);
        let changed = System::new(changed)?;
        let other = self.motion(&changed, &same_method)?;
        if other.outcome.stop.is_from_outside() {
            return Ok(None);
        }
        let gone = self.point_of_failed_run(&other).is_some();
        let others = self.values(&changed, &same_method, &other)?;
        let of_run = FoundFigures::new(self.system.model(), self.settings, base);
        let all = self.question.figures.iter().zip(&point.figures).zip(others);
        let moved = all.map(|((figure, own), other)| {
            let value = own.value.unwrap_or_default();
            let scale = match lookup::is_address(figure) {
                true => value.abs(),
                false => of_run.scale(figure),
            };
            match other {
                Some(other) if !gone => relative_difference(other - value, scale),
                _ => f64::INFINITY,
            }
        });
        Ok(Some(moved.collect()))
    }
}

impl PointFigure {
    fn of(value: Option<f64>) -> Self {
        Self {
            value,
            ..Self::default()
        }
    }
}

/// Greatest |δ| of an object over the cycle before the last one and over that which
/// ends at `end` (s), from the samples.
fn greatest_in_last_cycle(record: &Record, id: &str, end: f64, cycle: f64) -> Option<[f64; 2]> {
    let column = record.column(id, Quantity::Delta)?;
    let over = |from: f64, to: f64| {
        let samples = record.times.iter().zip(&column.values);
        samples
            .filter(|&(&time, _)| from <= time && time <= to)
            .map(|(_, value)| value.abs())
            .fold(None, |most: Option<f64>, value| {
                Some(most.map_or(value, |most| most.max(value)))
            })
    };
    Some([
        over(end - 2.0 * cycle, end - cycle)?,
        over(end - cycle, end)?,
    ])
}

fn relative_difference(difference: f64, scale: f64) -> f64 {
    if difference == 0.0 {
        0.0
    } else {
        // A difference without a scale is beyond every bound.
        (difference / scale).abs()
    }
}

/// The greatest move of a figure that is still determined: one of the last digit
/// asked for, and for a method with steps of a tolerance at least ten times that.
fn bound(digits: u8, found: &Motion, settings: &RunSettings) -> f64 {
    let precision = 10f64.powi(-i32::from(digits));
    match found.choice.method {
        Method::Rk4 | Method::Exact => precision,
        _ => precision.max(OWN_NOISE * settings.tolerance),
    }
}

/// Notes how far each figure moves, and whether that is too far; the verdict on the
/// mechanism stays.
fn note_sensitivity(figures: &[String], point: &mut Point, moved: &[f64], bound: f64) {
    for ((figure, own), &moved) in figures.iter().zip(&mut point.figures).zip(moved) {
        if own.value.is_none() {
            continue;
        }
        own.determined = Some(moved <= bound);
        own.moved = moved.is_finite().then_some(moved);
        if moved <= bound {
            continue;
        }
        let what = match figures.len() {
            1 => "the result",
            _ => figure.as_str(),
        };
        let how = match moved.is_finite() {
            true => format!("moves by {moved} of its scale", moved = shown(moved, 2)),
            false => "is gone".to_owned(),
        };
        let not = format!("{what} {how} when the loads change by {CHANGE:e}: not determined");
        if !point.cause.is_empty() {
            point.cause.push_str("; ");
        }
        point.cause.push_str(&not);
    }
}
