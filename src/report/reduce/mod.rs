//! The smallest scene: what was left out of it and what stays.

mod chart;
mod findings;

pub use findings::findings;

use crate::report::addresses::result_words;
use crate::report::quantity::{counted, significant, with_unit};
use crate::studies::reduce::{Cost, Part, Reduction, Refusal, Role, Step};
use serde_json::{Value, json};

/// The answer in a sentence.
fn answer(reduction: &Reduction) -> String {
    let figures = reduction.certificate.accuracy.values();
    let judged = figures.filter(|figure| figure.error.is_some()).count();
    if judged == 0 {
        return "No wanted result has a converged value: there is nothing to judge a simpler scene \
                by."
            .to_owned();
    }
    if !reduction.holds() {
        let none = "Not even the finest model has the required accuracy: nothing is simplified.";
        return format!("{none}{}", excess(reduction));
    }
    let left_out = reduction.removed().count();
    if let Some(cost) = reduction.cost.as_ref().filter(|_| !reduction.is_offered()) {
        return format!(
            "The scene as given is the answer. A smaller scene is accurate enough, but it runs slower: \
             {}.",
            times_in_words(cost)
        );
    }
    let coordinates = |role| reduction.model(role).map(|model| model.coordinates);
    let size = match (coordinates(Role::Given), coordinates(Role::Reduced)) {
        (Some(given), Some(reduced)) if given != reduced => {
            format!(
                " Its elastic objects need {} in place of {given}.",
                counted(reduced, "coordinate")
            )
        }
        _ => String::new(),
    };
    let size = match &reduction.cost {
        Some(cost) if cost.is_slower() => format!(
            "{size} It runs slower than the scene as given: {}.",
            times_in_words(cost)
        ),
        Some(cost) => format!("{size} Time of a run: {}.", times_in_words(cost)),
        None => size,
    };
    let size = format!("{}{size}", excess(reduction));
    match left_out {
        0 => format!("Nothing in the scene can be simplified within the required accuracy.{size}"),
        _ => format!(
            "{} can be removed or simplified, and {} within {} accuracy.{size}",
            counted(left_out, "thing"),
            match judged {
                1 => "the result stays".to_owned(),
                2 => "both results stay".to_owned(),
                _ => format!("all {judged} results stay"),
            },
            if judged == 1 { "its" } else { "their" },
        ),
    }
}

/// By how much the scene as given misses the accuracy asked for, as a sentence; empty where it
/// does not.
fn excess(reduction: &Reduction) -> String {
    let Some((figure, error, accuracy)) = reduction.given_excess() else {
        return String::new();
    };
    let size = |value: f64| with_unit(value, &accuracy.unit, 2);
    match error {
        Some(error) => format!(
            " The scene as given is not that accurate: {} is up to {} off, {} is allowed.",
            result_words(figure),
            size(error),
            size(accuracy.asked)
        ),
        None => format!(
            " The scene as given is not that accurate: it has no {}.",
            result_words(figure)
        ),
    }
}

/// The measured times of both scenes.
fn times_in_words(cost: &Cost) -> String {
    format!(
        "{} reduced, {} as given (least of {} runs each)",
        with_unit(cost.reduced.least, "s", 2),
        with_unit(cost.given.least, "s", 2),
        cost.repeats
    )
}

/// What a step changes most, in words.
fn greatest(reduction: &Reduction, step: &Step) -> String {
    let Some((figure, change)) = step.greatest() else {
        return "no wanted result is left to compare".to_owned();
    };
    if change.change == 0.0 {
        return "changes no wanted result".to_owned();
    }
    let by = with_unit(change.change.abs(), unit(reduction, figure), 2);
    match change.share {
        Some(share) => format!(
            "changes {} by {by}, {} % of what is allowed",
            result_words(figure),
            significant(100.0 * share, 2)
        ),
        None => format!("changes {} by {by}", result_words(figure)),
    }
}

/// Why a step is not made, in words.
fn refusal_in_words(reduction: &Reduction, refused: &Refusal) -> String {
    match refused {
        Refusal::Figure {
            figure,
            error: Some(error),
        } => {
            let off = with_unit(*error, unit(reduction, figure), 2);
            format!("{} would be up to {off} off", result_words(figure))
        }
        Refusal::Figure {
            figure,
            error: None,
        } => format!("there would be no {}", result_words(figure)),
        Refusal::Opens(id) => format!("the contact of {id} would separate"),
        Refusal::Doubt(why) => format!("its run cannot be trusted: {why}"),
        Refusal::Impossible(why) => format!("there is no such scene: {why}"),
    }
}

fn unit<'r>(reduction: &'r Reduction, figure: &str) -> &'r str {
    let found = reduction.certificate.accuracy.get(figure);
    found.map_or("", |found| &found.unit)
}

/// The document: figures, models, steps, and the reduced scene itself.
pub fn document(reduction: &Reduction) -> Value {
    let scene = serde_json::from_str(reduction.document.text()).unwrap_or(Value::Null);
    json!({
        "dam": 1,
        "scene": reduction.scene,
        "complete": reduction.complete,
        "holds": reduction.holds(),
        "given_holds": reduction.given_holds(),
        "offered": reduction.is_offered(),
        "cost": reduction.cost,
        "answer": answer(reduction),
        "accuracy": reduction.certificate.accuracy,
        "objects": reduction.certificate.models,
        "steps": reduction.steps.iter().map(step).collect::<Vec<_>>(),
        "models": reduction.models,
        "reduced": scene,
    })
}

fn step(step: &Step) -> Value {
    let (part, name) = part_in_words(&step.removal.part);
    let mut document = json!({
        "object": step.removal.object,
        "part": part,
        "what": step.removal.part.to_string(),
        "left_out": step.refused.is_none(),
        "changes": step.changes,
    });
    if let Some(name) = name {
        document["name"] = json!(name);
    }
    if let Part::Level { from, to } = step.removal.part {
        document["from"] = json!(from);
        document["to"] = json!(to);
    }
    if let Some(refused) = &step.refused {
        document["refused"] = match refused {
            Refusal::Figure { figure, error } => json!({ "figure": figure, "error": error }),
            Refusal::Opens(id) => json!({ "opens": id }),
            Refusal::Doubt(why) => json!({ "doubt": why }),
            Refusal::Impossible(why) => json!({ "impossible": why }),
        };
    }
    document
}

fn part_in_words(part: &Part) -> (&'static str, Option<&str>) {
    match part {
        Part::Level { .. } => ("level", None),
        Part::Opening => ("opening", None),
        Part::Contact => ("contact", None),
        Part::Load(name) => ("load", Some(name)),
        Part::Stop(name) => ("stop", Some(name)),
        Part::JointFriction => ("joint_friction", None),
        Part::Friction(name) => ("friction", Some(name)),
        Part::Gravity => ("gravity", None),
        Part::Masses => ("masses", None),
        Part::Mass(name) => ("mass", Some(name)),
    }
}
