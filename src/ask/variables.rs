//! Numbers of a scene that a question varies.

use super::prepared::{PointSource, numbers};
use super::{Mechanism, ModelAssessment};
use crate::Error;
use crate::dynamics::model::Model;
use crate::frontend::diagnostics::Diagnostic;
use crate::frontend::scene::{Levels, Reading};
use crate::studies::Control;
use crate::studies::exact::exact_parts;
use crate::studies::optimize::{MOST_VARIABLES, Variable};

/// Step of differences, as a share of the range, of results that are known to rounding.
const STEP: f64 = 1e-4;

/// Step of differences of results of an integrated run, at most.
const LONGEST_STEP: f64 = 0.02;

/// The variables; what is wrong with their texts is added to the faults.
pub(super) fn variables(
    texts: &[String],
    model: &Model,
    wrong: &mut Vec<Diagnostic>,
) -> Vec<Variable> {
    let mut fault = |what: String| wrong.push(Diagnostic::error("question", what));
    let mut variables = Vec::new();
    for text in texts {
        match Variable::parse(text) {
            Ok(mut variable) => {
                variable.unit = variable.parameter().display_unit(model);
                variables.push(variable);
            }
            Err(what) => fault(format!("--vary {what}")),
        }
    }
    if texts.is_empty() || variables.len() > MOST_VARIABLES {
        fault(format!(
            "--vary: 1 to {MOST_VARIABLES} variables can be chosen, and {} are named",
            texts.len()
        ));
    }
    variables
}

/// Values of the variables in the scene, in their units; what is wrong with these or with values
/// in the ranges is added to the faults.
pub(super) fn own_values(
    variables: &[Variable],
    (reading, source): (&Reading, &PointSource<'_, '_>),
    wrong: &mut Vec<Diagnostic>,
) -> Vec<f64> {
    if variables.is_empty() {
        return Vec::new();
    }
    let paths: Vec<&str> = variables.iter().map(|one| one.path.as_str()).collect();
    let is_right = wrong.is_empty();
    let own = numbers(reading, &paths, wrong);
    if is_right && wrong.is_empty() {
        wrong.extend(refused_values(variables, source));
    }
    let own = own.iter().zip(variables);
    own.map(|(value, variable)| value / variable.size).collect()
}

/// What is wrong with values within the ranges: units, numbers that count.
fn refused_values(variables: &[Variable], source: &PointSource<'_, '_>) -> Vec<Diagnostic> {
    let mut wrong = Vec::new();
    for variable in variables {
        // (Between the ends no number is whole by chance.)
        let between = variable.low + 0.4321 * (variable.high - variable.low);
        let Err(found) = source.decode(&[variable.parameter().setting(between)]) else {
            continue;
        };
        for fault in found.items {
            let counts = fault.is_of_a_count();
            if counts || fault.code.contains("unit") || fault.code.contains("dimension") {
                let path = &variable.path;
                let message = match counts {
                    true => format!("--vary {path}: it counts, and has no slopes"),
                    false => format!("--vary {path}: {}", fault.message),
                };
                let own = Diagnostic::error("question", message);
                wrong.push(match counts {
                    true => own.hint(format!("compare its values: dam compare --over {path}=…")),
                    false => fault.hints.into_iter().fold(own, Diagnostic::hint),
                });
            }
        }
    }
    wrong
}

/// The scene at some levels of the objects that leave theirs open.
pub(super) fn ready(
    mut reading: Reading,
    levels: &Levels,
    control: &Control<'_>,
) -> Result<Mechanism, Error> {
    reading.scene.elastic().set(&mut reading.scene, levels);
    Mechanism::of_within(reading, ModelAssessment::Never, control)
}

/// Whether a mechanism has results that are known to rounding.
pub(super) fn is_exact(base: &Mechanism) -> bool {
    let model = base.model();
    let is_rigid = model.objects.iter().all(|part| part.links.is_empty());
    is_rigid || exact_parts(&base.system).is_ok()
}

/// Step of central differences: by the digits to which runs are known.
pub(super) fn step(base: &Mechanism) -> f64 {
    match is_exact(base) {
        true => STEP,
        false => base.settings.tolerance.cbrt().clamp(STEP, LONGEST_STEP),
    }
}
