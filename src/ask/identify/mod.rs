//! Numbers of a scene from records of its motion.

mod channels;
mod evaluation;
mod question;
mod records;

pub use question::{IdentifyQuestion, MeasuredRecord, USUAL_STARTS};

use super::prepared::PointSource;
use super::variables::{is_exact, own_values, ready, step, variables};
use crate::Error;
use crate::dynamics::model::Model;
use crate::frontend::diagnostics::{Diagnostic, Diagnostics, Sources};
use crate::frontend::lower::lower;
use crate::frontend::scene::{Levels, Reading, in_words};
use crate::studies::Control;
use crate::studies::identify::{
    Estimate, Identification, IdentificationTask, Precision, identify as fit_all,
};
use crate::studies::optimize::Variable;
use crate::studies::prepared::finest_levels;
use crate::studies::side_by_side::threads as number_of_threads;
use channels::{Channel, channels};
use evaluation::Evaluation;
use records::{tables, tests, wrong_settings};
use std::sync::atomic::{AtomicUsize, Ordering};
use std::sync::{Arc, Mutex, PoisonError};

/// Most starts.
const MOST_STARTS: usize = 1000;

/// Error of the signals of a run that is known to rounding, as a share of their size.
const ROUNDING: f64 = 1e-13;

/// Finds the numbers. `heard`: receives the number of runs that are done, from any thread.
///
/// # Errors
/// As of [`Scene::identify`](super::Scene::identify).
pub(crate) fn identify(
    question: &IdentifyQuestion,
    source: &PointSource<'_, '_>,
    control: &Control<'_>,
    heard: &(dyn Fn(usize) + Sync),
) -> Result<Identification, Error> {
    let reading = source.decode(&[])?;
    let block = reading.scene.identify.as_ref();
    let question = &question.filled(block, &*source.catalogue)?;
    let starts = question.starts.unwrap_or(USUAL_STARTS);
    let model = lower(&reading.scene).map_err(|faults| reading.places.diagnose(&faults))?;
    let resolved = Resolved::of(question, (&reading, source), &model)?;
    let tables = tables(&question.records, &resolved.channels)?;
    let levels = levels(source, &resolved.channels)?;
    let base = ready(source.decode(&[])?, &levels, control)?;
    let precision = Precision {
        step: step(&base),
        error: match is_exact(&base) {
            true => ROUNDING,
            false => base.settings.tolerance,
        },
    };
    let (channels, lean) = (&resolved.channels, source.document.without_expectations());
    let lean = PointSource {
        document: &lean,
        catalogue: Arc::clone(&source.catalogue),
        settings: source.settings,
    };
    let found = tests(question, tables, (channels, &levels), (&lean, control))?;
    check_rows(
        found.signals.iter().map(|one| one.times.len()).sum(),
        resolved.variables.len(),
    )?;
    let evaluation = Evaluation {
        variables: &resolved.variables,
        tests: &found.tests,
        signals: &found.signals,
        levels: &levels,
        source: &lean,
        control,
        heard,
        done: AtomicUsize::new(0),
        threads: number_of_threads(question.threads),
        cause: Mutex::default(),
    };
    let task = IdentificationTask {
        variables: resolved.variables.clone(),
        given: resolved.own,
        signals: found.signals.clone(),
        starts,
        precision,
    };
    let Some(mut answer) = fit_all(task, &|rows| evaluation.residuals(rows)) else {
        return Err(Error::question(no_residuals(&evaluation)));
    };
    answer.evaluations = evaluation.done.load(Ordering::Relaxed);
    answer.remarks = found.remarks.clone();
    if !levels.is_empty() {
        answer
            .remarks
            .push(format!("all runs have {}", in_words(&levels)));
    }
    if answer.is_answered() {
        answer.settings = answer.estimates.iter().map(setting).collect();
        let written = source.decode(&answer.settings)?;
        answer.scene_text = source.document.decoded(&written.places).text().to_owned();
    }
    Ok(answer)
}

/// The question as the scene has it.
struct Resolved {
    variables: Vec<Variable>,
    /// Values of the variables in the scene, in their units.
    own: Vec<f64>,
    channels: Vec<Channel>,
}

impl Resolved {
    /// All that is wrong with the question at once.
    fn of(
        question: &IdentifyQuestion,
        (reading, source): (&Reading, &PointSource<'_, '_>),
        model: &Model,
    ) -> Result<Self, Error> {
        let mut wrong: Vec<Diagnostic> = Vec::new();
        if question.records.is_empty() {
            let hint =
                "give a CSV file with a column of time and columns of signals: --record test.csv";
            wrong.push(Diagnostic::error("question", "no record is named").hint(hint));
        }
        if let Some(starts) = question
            .starts
            .filter(|count| !(1..=MOST_STARTS).contains(count))
        {
            let message = format!("--starts {starts}: 1 to {MOST_STARTS} starts");
            wrong.push(Diagnostic::error("question", message));
        }
        let channels = channels(question, model, &mut wrong);
        let variables = variables(&question.vary, model, &mut wrong);
        let own = own_values(&variables, (reading, source), &mut wrong);
        for record in &question.records {
            wrong.extend(wrong_settings(record, &variables, (reading, source)));
        }
        match wrong.is_empty() {
            true => Ok(Self {
                variables,
                own,
                channels,
            }),
            false => Err(Diagnostics::new(Sources::default(), wrong).into()),
        }
    }
}

/// Levels of the objects that leave theirs open: the same in all runs.
fn levels(source: &PointSource<'_, '_>, channels: &[Channel]) -> Result<Levels, Error> {
    let owner = |one: &Channel| {
        let (object, _) = one.address.rsplit_once('.')?;
        Some(format!("{object}.delta_abs"))
    };
    let figures: Vec<String> = channels.iter().filter_map(owner).collect();
    let reading = source.decode(&[])?;
    Ok(finest_levels(std::iter::once(reading), &figures))
}

fn check_rows(values: usize, sought: usize) -> Result<(), Error> {
    if values > sought {
        return Ok(());
    }
    let message =
        format!("the records have {values} values in all, and the number of numbers is {sought}");
    let fault = Diagnostic::error("question", message).hint("give more rows than numbers");
    Err(Diagnostics::new(Sources::default(), vec![fault]).into())
}

/// Why there is no fit at all.
fn no_residuals(evaluation: &Evaluation<'_>) -> String {
    if evaluation.control.is_spent() {
        return "ended before anything was known of the numbers: give it more time".to_owned();
    }
    let cause = evaluation
        .cause
        .lock()
        .unwrap_or_else(PoisonError::into_inner);
    let cause = cause.as_deref().unwrap_or("no cause is known");
    format!("the scene cannot be run at any start: {cause}")
}

fn setting(one: &Estimate) -> String {
    one.variable.parameter().setting(one.fitted)
}
