//! The tolerance of results.

use super::Mechanism;
use super::gradient::{GradientQuestion, default_figures, figure_unit, gradient};
use super::prepared::{PointSource, numbers, system_of};
use crate::Error;
use crate::dynamics::model::Model;
use crate::frontend::diagnostics::{Diagnostic, Diagnostics, Sources};
use crate::frontend::scene::{Number, Reading, ToleranceSpec};
use crate::studies::Control;
use crate::studies::axis::Parameter;
use crate::studies::condition::{Condition, counts};
use crate::studies::gradient::DerivativeVerdict;
use crate::studies::prepared::{Point, Prepared, Verdict};
use crate::studies::tolerance::{
    Dimension, Figure, MOST_DIMENSIONS, MOST_SAMPLES, Outcome, ToleranceTask, Tolerances,
    USUAL_SAMPLES, WrittenLimits, WrittenTolerance, tolerances,
};
use crate::units::parse;
use std::cell::Cell;

/// What is toleranced, and which results are looked at.
#[derive(Clone, Debug, Default)]
pub struct ToleranceQuestion {
    /// Tolerances of numbers of the scene: `rocker.pair.gap=±0.02 mm`, with `uniform` behind it,
    /// `+0.01 -0.03 mm`, `±1 %`, of a length `h7`. Numbers that deviate by the same are separated
    /// by commas. Empty: those of the scene's block `tolerance`.
    pub tolerances: Vec<String>,
    /// Addresses of results. Empty: those of the block, else those of the limits, else those of
    /// every elastic object that are asked for most.
    pub figures: Vec<String>,
    /// Limits that samples are to meet: `rocker.delta_max <= 0.2 mrad`. Empty: those of the block.
    pub limits: Vec<String>,
    /// Number of samples, 0 for the stack alone; `None`: that of the block, else
    /// [`USUAL_SAMPLES`].
    pub samples: Option<usize>,
    /// Seed of the samples; `None`: that of the block, else 1.
    pub seed: Option<u32>,
    /// Number of threads; default: one for every processor core. Results do not depend on it.
    pub threads: Option<usize>,
}

impl ToleranceQuestion {
    /// The question with what it leaves open as the scene has it.
    fn filled(&self, block: Option<&ToleranceSpec>) -> Self {
        let mut all = self.clone();
        let Some(block) = block else {
            return all;
        };
        for (own, given) in [
            (&mut all.tolerances, &block.tol),
            (&mut all.figures, &block.figures),
            (&mut all.limits, &block.limit),
        ] {
            if own.is_empty() {
                own.clone_from(given);
            }
        }
        // (The block has been read within these bounds.)
        let seed = block.seed.and_then(|seed| u32::try_from(seed).ok());
        all.samples = all.samples.or(block.samples.map(|count| count as usize));
        all.seed = all.seed.or(seed);
        all
    }
}

/// Makes the scene ready with further settings.
type Prepare<'p> = dyn Fn(&[String]) -> Result<Mechanism, Error> + 'p;

/// Finds the tolerances. `prepare`: the scene with further settings made ready; `heard`: told the
/// number of runs that are done, from any thread, and of how many.
///
/// # Errors
/// As of [`Scene::tolerances`](super::Scene::tolerances).
pub(crate) fn tolerance(
    question: &ToleranceQuestion,
    source: &PointSource<'_, '_>,
    prepare: &Prepare<'_>,
    control: &Control<'_>,
    heard: &(dyn Fn(usize, usize) + Sync),
) -> Result<Tolerances, Error> {
    let reading = source.decode(&[])?;
    let question = &question.filled(reading.scene.tolerance.as_ref());
    let samples = question.samples.unwrap_or(USUAL_SAMPLES);
    let system = system_of(&reading)?;
    let written_numbers = source.document.numbers(&*source.catalogue);
    let mut wrong = Vec::new();
    let dimensions = dimensions(
        &question.tolerances,
        (source, &reading),
        (&written_numbers, system.model()),
        &mut wrong,
    );
    let limits = limits(&question.limits, system.model(), &mut wrong);
    let mut figures = figures(&question.figures, &limits, system.model(), &mut wrong);
    for figure in &mut figures {
        figure.exact = vec![None; dimensions.len()];
    }
    if samples > MOST_SAMPLES {
        let message = format!("{samples} samples are wanted");
        let hint = format!("give at most {MOST_SAMPLES}");
        wrong.push(Diagnostic::error("question", message).hint(hint));
    }
    if !wrong.is_empty() {
        return Err(Diagnostics::new(Sources::default(), wrong).into());
    }
    let paths: Vec<&str> = dimensions
        .iter()
        .flat_map(|one| &one.paths)
        .map(String::as_str)
        .collect();
    let addresses: Vec<&str> = figures.iter().map(|one| one.address.as_str()).collect();
    let points = source.prepare(&paths, &addresses)?;
    let mut remarks = points.remarks.clone();
    let mut task = ToleranceTask {
        dimensions,
        figures,
        limits,
        samples,
        seed: question.seed.unwrap_or(1),
    };
    match points.prepared.question.levels().is_empty() {
        true => {
            let ready = (prepare, written_numbers.as_slice());
            remarks.extend(take_exact(&mut task, ready, system.model(), control));
        }
        false => remarks.push("derivatives are differences of runs with these levels".to_owned()),
    }
    let (done, all) = (Cell::new(0), task.runs());
    let evaluate = |rows: &[Vec<f64>]| {
        let values: Vec<Vec<f64>> = rows
            .iter()
            .map(|row| values_at(&task.dimensions, row))
            .collect();
        let (before, prepared): (usize, &Prepared<'_>) = (done.get(), &points.prepared);
        let told = |now: usize| heard(before + now, all.max(before + now));
        let found = prepared.table(&values, question.threads, control, &told)?;
        done.set(before + rows.len());
        Some(
            found
                .into_iter()
                .map(|point| outcome(point, &task.figures))
                .collect(),
        )
    };
    let mut found = tolerances(&task, &evaluate).map_err(Error::question)?;
    found.remarks.splice(0..0, remarks);
    Ok(found)
}

/// Values of all numbers at deviations of the dimensions.
fn values_at(dimensions: &[Dimension], deviations: &[f64]) -> Vec<f64> {
    let each = dimensions.iter().zip(deviations);
    each.flat_map(|(one, own)| one.nominal.iter().map(move |nominal| nominal + own))
        .collect()
}

fn outcome(point: Point, figures: &[Figure]) -> Outcome {
    let values: Vec<Option<f64>> = (0..figures.len()).map(|at| point.value(at)).collect();
    let failed = matches!(
        point.verdict,
        Verdict::Refused | Verdict::Stopped | Verdict::NotFinished | Verdict::NumericalFailure
    );
    let absent = values.iter().position(Option::is_none);
    let cause = match (failed, absent) {
        (true, _) if point.cause.is_empty() => point.verdict.words().to_owned(),
        (true, _) => point.cause,
        (false, Some(at)) => format!("{} has no value", figures[at].address),
        (false, None) => String::new(),
    };
    Outcome {
        values,
        verdict: point.verdict,
        cause,
    }
}

/// The dimensions; all that is wrong with them.
fn dimensions(
    texts: &[String],
    (source, reading): (&PointSource<'_, '_>, &Reading),
    (written, model): (&[Number], &Model),
    wrong: &mut Vec<Diagnostic>,
) -> Vec<Dimension> {
    let refused = |what: String| Diagnostic::error("question", what);
    if texts.is_empty() {
        let hint =
            "give numbers of the scene with their tolerances: --tol rocker.pair.gap=\"±0.02 mm\"";
        wrong.push(refused("no tolerance is named".to_owned()).hint(hint));
        return Vec::new();
    }
    if texts.len() > MOST_DIMENSIONS {
        let message = format!("{} tolerances are named", texts.len());
        wrong.push(refused(message).hint(format!("name at most {MOST_DIMENSIONS}")));
        return Vec::new();
    }
    let mut read = Vec::new();
    for text in texts {
        match WrittenTolerance::parse(text) {
            Ok(tolerance) => read.push(tolerance),
            Err(what) => wrong.push(refused(format!("--tol {what}"))),
        }
    }
    let paths: Vec<&str> = read
        .iter()
        .flat_map(|one| &one.paths)
        .map(String::as_str)
        .collect();
    let before = wrong.len();
    let values = match paths.is_empty() {
        true => Vec::new(),
        false => numbers(reading, &paths, wrong),
    };
    if wrong.len() > before {
        return Vec::new();
    }
    let mut values = values.into_iter();
    let mut found = Vec::new();
    for tolerance in read {
        let nominal: Vec<f64> = values.by_ref().take(tolerance.paths.len()).collect();
        match dimension(&tolerance, nominal, source, (written, model)) {
            Ok(one) => found.push(one),
            Err(what) => {
                let paths = tolerance.paths.join(",");
                wrong.push(refused(format!("--tol {paths}={}: {what}", tolerance.text)));
            }
        }
    }
    found
}

/// A dimension: its zone is the same about all its nominal values.
fn dimension(
    tolerance: &WrittenTolerance,
    nominal: Vec<f64>,
    source: &PointSource<'_, '_>,
    (written, model): (&[Number], &Model),
) -> Result<Dimension, String> {
    let mut found: Option<Dimension> = None;
    for (path, value) in tolerance.paths.iter().zip(&nominal) {
        let size = unit_size(path, *value, tolerance, source)?;
        let zone = tolerance.zone(*value, size)?;
        // (Halfway to a limit nothing is whole by chance.)
        let between = si_setting(path, value + 0.4321 * (zone.upper - zone.lower));
        let refused = source.decode(&[between]).err();
        if refused.is_some_and(|faults| faults.items.iter().any(Diagnostic::is_of_a_count)) {
            return Err(format!("`{path}` counts, and has no tolerance"));
        }
        let number = written.iter().find(|one| one.address == *path);
        let display = || {
            Parameter {
                path: path.clone(),
                unit: String::new(),
            }
            .display_unit(model)
        };
        let mut unit = number.map_or_else(display, |one| one.si.to_owned());
        if unit.is_empty()
            && let Ok(one) = parse(&format!("1 {}", tolerance.unit()))
        {
            // (A property that the scene leaves out is known by the unit of its tolerance alone.)
            unit = one.dimension.to_string();
        }
        let one = found.get_or_insert_with(|| Dimension {
            paths: tolerance.paths.clone(),
            nominal: nominal.clone(),
            unit: unit.clone(),
            tolerance: tolerance.text.clone(),
            zone,
        });
        let same = (one.zone.lower, one.zone.upper) == (zone.lower, zone.upper);
        if !same || one.unit != unit {
            let fault = "numbers that deviate by the same have one tolerance in one unit";
            return Err(fault.to_owned());
        }
    }
    found.ok_or_else(|| "the address of a number is missing".to_owned())
}

fn si_setting(path: &str, value: f64) -> String {
    let parameter = Parameter {
        path: path.to_owned(),
        unit: String::new(),
    };
    parameter.setting(value)
}

/// The size of the unit of a tolerance in the SI unit of a number, as the number itself takes it.
fn unit_size(
    path: &str,
    value: f64,
    tolerance: &WrittenTolerance,
    source: &PointSource<'_, '_>,
) -> Result<f64, String> {
    let unit = tolerance.unit();
    if unit.is_empty() {
        return Ok(1.0);
    }
    let one = parse(&format!("1 {unit}")).map_err(|_| format!("`{unit}` is no unit"))?;
    let parameter = Parameter {
        path: path.to_owned(),
        unit: unit.to_owned(),
    };
    let reading = source.decode(&[parameter.setting(value / one.value)]);
    let reading = reading.map_err(|faults| {
        let first = faults.items.first();
        // (The text of the setting is not that of the question.)
        let what = first.map_or("", |fault| match fault.code {
            "wrong-unit" => fault.hints.first().unwrap_or(&fault.message),
            _ => &fault.message,
        });
        match tolerance.limits {
            WrittenLimits::Class(_) => {
                format!("classes are those of lengths, which `{path}` is not: {what}")
            }
            _ => format!("`{unit}` does not fit `{path}`: {what}"),
        }
    })?;
    // (A number may take its unit in a sense of its own: 1/min as turns.)
    match reading.number(path) {
        Ok(read) if value != 0.0 && (read / value - 1.0).abs() > 1e-9 => {
            Ok(one.value * read / value)
        }
        _ => Ok(one.value),
    }
}

fn limits(texts: &[String], model: &Model, wrong: &mut Vec<Diagnostic>) -> Vec<Condition> {
    let mut found = Vec::new();
    for text in texts {
        match Condition::parse(text, model) {
            Ok(limit) if limit.is_equality() => {
                let message = format!("--limit `{text}`: no sample meets an equality");
                let hint = "write a limit on each side, with `>=` and `<=`";
                wrong.push(Diagnostic::error("question", message).hint(hint));
            }
            Ok(limit) => found.push(limit),
            Err(what) => wrong.push(Diagnostic::error("question", format!("--limit {what}"))),
        }
    }
    found
}

/// The results, each once: those that are named, those of the limits, else the usual ones.
fn figures(
    named: &[String],
    limits: &[Condition],
    model: &Model,
    wrong: &mut Vec<Diagnostic>,
) -> Vec<Figure> {
    let of_limits = limits.iter().map(|limit| limit.figure.clone());
    let mut all: Vec<String> = named.iter().cloned().chain(of_limits).collect();
    if all.is_empty() && wrong.is_empty() {
        all = default_figures(model)
            .into_iter()
            .map(|one| one.0)
            .collect();
    }
    if all.is_empty() && wrong.is_empty() {
        let hint = "name results, for example --figure kinematics.press.ram.stroke";
        wrong.push(Diagnostic::error("question", "no result is named").hint(hint));
    }
    let mut found: Vec<Figure> = Vec::new();
    for address in all {
        if found.iter().any(|one| one.address == address) {
            continue;
        }
        match Condition::unit_of(&address, model) {
            Ok(unit) => found.push(Figure {
                unit,
                counts: counts(&address),
                exact: Vec::new(),
                address,
            }),
            Err(what) => wrong.push(Diagnostic::error(
                "unknown-name",
                format!("--figure {address}: {what}"),
            )),
        }
    }
    found
}

/// Takes the derivatives that are carried exactly; says why there are none.
fn take_exact(
    task: &mut ToleranceTask,
    (prepare, numbers): (&Prepare<'_>, &[Number]),
    model: &Model,
    control: &Control<'_>,
) -> Option<String> {
    let has_derivatives = |figure: &Figure| {
        let plain = !figure.counts && !figure.address.contains(' ');
        plain && figure_unit(&figure.address, model).is_ok()
    };
    let eligible = task.figures.iter().filter(|figure| has_derivatives(figure));
    let figures: Vec<String> = eligible.map(|figure| figure.address.clone()).collect();
    if figures.is_empty() {
        return None;
    }
    let by = task.dimensions.iter().flat_map(|one| one.paths.clone());
    let question = GradientQuestion {
        by: by.collect(),
        figures,
        check: None,
    };
    let middles = task
        .dimensions
        .iter()
        .filter(|one| one.zone.middle() != 0.0);
    let middles: Vec<String> = middles
        .flat_map(|one| {
            let each = one.paths.iter().zip(&one.nominal);
            each.map(|(path, nominal)| si_setting(path, nominal + one.zone.middle()))
        })
        .collect();
    let at_middle = |further: &[String]| {
        let all: Vec<String> = middles.iter().chain(further).cloned().collect();
        prepare(&all)
    };
    let found = match gradient(&question, &at_middle, numbers, control) {
        Ok(found) => found,
        Err(error) => {
            let first = error
                .faults()
                .first()
                .map_or_else(String::new, |fault| fault.message.clone());
            return Some(format!("derivatives are differences of runs: {first}"));
        }
    };
    for own in &found.figures {
        let Some(figure) = task
            .figures
            .iter_mut()
            .find(|one| one.address == own.figure)
        else {
            continue;
        };
        let mut by = own.by.iter();
        for (slot, dimension) in figure.exact.iter_mut().zip(&task.dimensions) {
            // (All by which a dimension acts, added.)
            let parts = by.by_ref().take(dimension.paths.len()).map(|one| {
                let exact = one.verdict == DerivativeVerdict::Exact;
                one.derivative.filter(|_| exact)
            });
            let parts: Vec<Option<f64>> = parts.collect();
            *slot = parts.into_iter().sum();
        }
    }
    None
}
