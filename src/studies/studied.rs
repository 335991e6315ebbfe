//! Does a linkage have the kinematics and the forces that its scene expects?
//!
//! Figures are addressed `kinematics.OBJECT.FIGURE` and `forces.OBJECT.FIGURE`
//! ([`Kinematics::figure`], [`ForceStudy::figure`]); they are those that `dam
//! kinematics` and `dam forces` find when nothing further is asked.

use super::expectations::{Verdict, did_you_mean, verdict_on};
use super::forces::{
    self, ForceChoice, ForceStudy, NoForces, figures, figures_of_inputs, only_loaded_output,
};
use super::kinematics::{
    self, AskedSeveral, Kinematics, KinematicsRequest, NamedFigure, Over, Question, linkage_of,
    several_of,
};
use crate::dynamics::model::Model;
use crate::fault::Fault;
use crate::frontend::read::{QuantityChoice, UnitFault, closest};
use crate::frontend::scene::{Expectation, Expected, MeasuredValue, SpanAddress};
use crate::kinematics::linkage::kinetostatics::Kinetostatics;
use crate::units::quantities::{ALL, NUMBER};
use crate::units::{Mismatch, Quantity, parse};

pub use super::kinematics::{DescribedFigure, POSITIONS, ends};

/// All results of linkages that a scene can expect, by study.
pub fn described_results() -> [(&'static str, Vec<DescribedFigure>); 2] {
    [
        ("kinematics", kinematics::described_results()),
        ("forces", forces::described_results()),
    ]
}

/// Address of a figure.
#[derive(Clone, Copy, Debug, PartialEq)]
struct Address<'a> {
    study: &'static str,
    object: &'a str,
    figure: &'a str,
}

impl<'a> Address<'a> {
    fn of(figure: &'a str) -> Option<Self> {
        if SpanAddress::of(figure).is_some() {
            return None; // over a part of the course: `spans`
        }
        let studies = ["kinematics", "forces"];
        let (study, rest) = figure.split_once('.')?;
        let study = studies.into_iter().find(|known| *known == study)?;
        let (object, figure) = rest.split_once('.')?;
        Some(Self {
            study,
            object,
            figure,
        })
    }
}

/// The question that is put when nothing is said but the object.
pub(super) fn question(object: &str, duration: f64) -> Question {
    Question {
        object: Some(object.to_owned()),
        duration,
        ..Question::default()
    }
}

/// Kinematics of an object as its scene has it.
///
/// # Errors
/// What cannot be answered, in words.
pub fn kinematics_of(model: &Model, object: &str, duration: f64) -> Result<Kinematics, String> {
    kinematics_over(model, object, duration, None)
}

/// The same over a part of its course.
///
/// # Errors
/// What cannot be answered, in words.
pub(super) fn kinematics_over(
    model: &Model,
    object: &str,
    duration: f64,
    over: Option<Over>,
) -> Result<Kinematics, String> {
    let question = Question {
        over,
        ..question(object, duration)
    };
    kinematics::kinematics_of(model, &question)
}

/// Forces of a linkage as its scene has them, with all that acts on its outputs.
///
/// # Errors
/// What cannot be answered, in words; what acts on the outputs and is not known along the input.
pub fn forces_of(model: &Model, object: &str, duration: f64) -> Result<ForceStudy, String> {
    forces_over(model, object, duration, None)
}

/// The same over a part of its course.
///
/// # Errors
/// What cannot be answered, in words.
pub(super) fn forces_over(
    model: &Model,
    object: &str,
    duration: f64,
    over: Option<Over>,
) -> Result<ForceStudy, String> {
    let question = Question {
        over,
        ..question(object, duration)
    };
    let found = forces::forces_of(model, &question, &ForceChoice::default());
    let found = found.map_err(|refused| match refused {
        NoForces::Question(message) => message,
        NoForces::Linkage(faults) => in_words(faults),
    })?;
    // Without a part of its loads it answers another question.
    match forces::loads_left_out(&found, model, object) {
        Some(why) => Err(why),
        None => Ok(found),
    }
}

fn in_words(faults: Vec<Fault>) -> String {
    let messages: Vec<String> = faults.into_iter().map(|fault| fault.message).collect();
    messages.join("; ")
}

/// Judges what is expected of the kinematics that were found, in its order.
pub fn check_kinematics(expectations: &[Expectation], found: &Kinematics) -> Vec<Verdict> {
    check(expectations, "kinematics", &found.object, |figure| {
        found.figure(figure)
    })
}

/// Judges what is expected of the forces that were found, in its order.
pub fn check_forces(
    expectations: &[Expectation],
    object: &str,
    found: &ForceStudy,
) -> Vec<Verdict> {
    check(expectations, "forces", object, |figure| {
        found.figure(figure)
    })
}

fn check(
    expectations: &[Expectation],
    study: &str,
    object: &str,
    figure: impl Fn(&str) -> Option<f64>,
) -> Vec<Verdict> {
    let judge = |expectation: &Expectation| {
        let Expected::Figure {
            figure: address,
            allowed,
        } = &expectation.what
        else {
            return None;
        };
        let at = Address::of(address)?;
        (at.study == study && at.object == object).then(|| Verdict {
            source: expectation.source.clone(),
            ..verdict_on(address, allowed, figure(at.figure))
        })
    };
    expectations.iter().filter_map(judge).collect()
}

/// Why a model has no figure at an address of kinematics or forces, with a hint; `None`: it has
/// one, or the address is another.
pub(super) fn unknown(figure: &str, model: &Model) -> Option<(String, String)> {
    let at = Address::of(figure)?;
    let known = match figures_at(model, at) {
        Ok(known) => known,
        Err(reason) => return Some((reason, String::new())),
    };
    if unit_of(at, &known).is_some() {
        return None;
    }
    let close = closest(at.figure, known.all.iter().map(|one| one.name.as_str()));
    let close = close.map(|name| format!("{}.{}.{name}", at.study, at.object));
    let message = format!("there is no result `{figure}`");
    Some((message, did_you_mean(close.as_slice())))
}

/// SI unit of a figure of kinematics or forces; empty of pure numbers; `None`: the model has no
/// such figure.
pub(super) fn unit(figure: &str, model: &Model) -> Option<String> {
    let at = Address::of(figure)?;
    let known = figures_at(model, at).ok()?;
    unit_of(at, &known).map(str::to_owned)
}

/// Faults of numbers whose unit is none of what their figure measures, once the model says it.
pub fn wrong_units(measured: &[MeasuredValue], model: &Model) -> Vec<Fault> {
    let wrong = |one: &MeasuredValue| {
        let at = Address::of(&one.figure)?;
        let known = figures_at(model, at).ok()?;
        wrong_unit(one, unit_of(at, &known)?)
    };
    measured.iter().filter_map(wrong).collect()
}

/// The quantity that is measured in an SI unit; empty of plain numbers.
pub(crate) fn quantity_of(unit: &str) -> Quantity {
    let dimension = match unit {
        "" | "1" => NUMBER.dimension,
        unit => parse(&format!("1 {unit}")).map_or(NUMBER.dimension, |one| one.dimension),
    };
    let known = ALL.iter().find(|known| known.dimension == dimension);
    known.copied().unwrap_or(Quantity {
        name: "quantity",
        dimension,
        angle_may_be_left_out: true,
        units: &[],
    })
}

/// Why a number has another unit than one that is wanted; `None`: it has not.
fn wrong_unit(one: &MeasuredValue, unit: &str) -> Option<Fault> {
    let si = if unit.is_empty() { "1" } else { unit };
    let quantity = quantity_of(unit);
    let words = match quantity.units {
        [] => format!("in {si}"),
        _ => QuantityChoice::from(quantity).words(),
    };
    let mismatch = match quantity.accept(one.measure) {
        // Turns a minute: the number was read as a frequency before it was known.
        Ok(value) if value != one.measure.value => Mismatch::FrequencyForSpeed,
        Ok(_) => return None,
        Err(mismatch) => mismatch,
    };
    let refused = UnitFault::new(
        (&one.path, &one.text),
        (one.measure, mismatch),
        (si, &words),
    );
    Some(Fault {
        code: refused.code,
        label: refused.label,
        ..Fault::new(one.path.as_str(), refused.message, refused.hint)
    })
}

/// `zones.3.from`: how many zones there will be is not known beforehand.
fn is_zone(figure: &str) -> bool {
    let Some((index, end)) = figure
        .strip_prefix("zones.")
        .and_then(|rest| rest.split_once('.'))
    else {
        return false;
    };
    index.parse::<usize>().is_ok() && ["from", "to"].contains(&end)
}

/// The figures of a study, but those of zones, and the SI unit of places on its course.
struct KnownFigures {
    all: Vec<NamedFigure>,
    place: &'static str,
}

/// SI unit of a figure of a study; `None`: it has none of that name.
fn unit_of<'k>(at: Address<'_>, known: &'k KnownFigures) -> Option<&'k str> {
    if at.study == "forces" && is_zone(at.figure) {
        return Some(known.place);
    }
    let found = known.all.iter().find(|one| one.name == at.figure)?;
    Some(&found.unit)
}

fn figures_at(model: &Model, at: Address<'_>) -> Result<KnownFigures, String> {
    let question = question(at.object, 1.0);
    let of_forces = at.study == "forces";
    if let Some(body) = several_of(model, Some(at.object)) {
        let asked = AskedSeveral::new(model, body, &question)?;
        let (_, place) = asked.axis();
        let all = match of_forces {
            true => figures_of_inputs(body.linkage.spec(), place),
            false => asked.figures(),
        };
        return Ok(KnownFigures { all, place });
    }
    if of_forces {
        // (What else moves by a position function has kinematics and no forces.)
        let spec = linkage_of(model, Some(at.object))?.linkage.spec();
        let solver = Kinetostatics::new(spec).map_err(in_words)?;
        let place = KinematicsRequest::new(model, &question)?.axis_unit();
        let all = figures(spec, only_loaded_output(&solver), place);
        return Ok(KnownFigures { all, place });
    }
    let asked = KinematicsRequest::new(model, &question)?;
    Ok(KnownFigures {
        all: asked.figures(),
        place: asked.axis_unit(),
    })
}
