//! Which questions a scene fits, and of what in it they can be asked.

use super::TABS;
use crate::ask::{Mechanism, ModelAssessment};
use crate::dynamics::model::{Closure, Model, Pair};
use crate::frontend::scene::{BuiltIn, Document, LayeredCatalogue, Number, Overrides};
use crate::kinematics::motion::LawName;
use crate::studies::cam::objects_with_cam;
use crate::studies::kinematics::{Subject, linkage_of, several_of};
use crate::studies::linear::LinearModel;
use crate::studies::methods::all_methods;
use crate::studies::{orders, steady};
use crate::studio::commands::CommandScene;
use serde::Serialize;
use serde_json::Value;
use std::collections::BTreeMap;

/// Whether a scene fits a question.
#[derive(Clone, Debug, Serialize)]
pub(super) struct Fit {
    pub(super) command: &'static str,
    /// Why it does not.
    pub(super) why: Option<String>,
    /// What options may be, by their names; the first is taken where one is needed.
    pub(super) choices: BTreeMap<&'static str, Vec<String>>,
}

/// Of every question; empty: the scene has faults.
pub(super) fn of(asked: &CommandScene<'_>) -> Vec<Fit> {
    let Ok(document) = Document::parse(asked.name, asked.text.as_bytes()) else {
        return Vec::new();
    };
    let catalogue = LayeredCatalogue(asked.catalogue, &BuiltIn);
    let Ok(reading) = document.scene(&catalogue, &Overrides::none()) else {
        return Vec::new();
    };
    let ready = Mechanism::of_within(reading, ModelAssessment::Never, &asked.budget);
    let tree: Value = serde_json::from_str(asked.text).unwrap_or_default();
    let one = |ready: &Mechanism, command| {
        let (choices, why) = match command {
            "find" => found(ready, &document.numbers(&catalogue)),
            _ => choices_for_scene(command, ready, &tree),
        };
        Fit {
            command,
            why,
            choices: choices.into_iter().collect(),
        }
    };
    match ready {
        Ok(ready) => TABS.iter().map(|tab| one(&ready, tab.command)).collect(),
        Err(_) => Vec::new(),
    }
}

type Choices = Vec<(&'static str, Vec<String>)>;

/// What is most often looked for: the highest speed at which nothing separates.
fn found(ready: &Mechanism, numbers: &[Number]) -> (Choices, Option<String>) {
    let speed = |one: &Number| one.address.ends_with("motion.speed");
    let usable = numbers.iter().filter(|one| !one.whole && one.value > 0.0);
    let usable = usable.filter(|one| {
        !["run.", "steady."]
            .iter()
            .any(|of| one.address.starts_with(of))
    });
    let (first, rest): (Vec<_>, Vec<_>) = usable.partition(|one| speed(one));
    let all: Vec<_> = first.into_iter().chain(rest).collect();
    let range = |one: &&Number| {
        let [low, high] = [one.value / 4.0, one.value * 4.0];
        format!("{}={low}:{high} {}", one.address, one.unit)
            .trim_end()
            .to_owned()
    };
    let ranges: Vec<_> = all.iter().map(range).collect();
    let why = ranges
        .is_empty()
        .then(|| "no number stands in the scene".to_owned());
    let model = ready.model();
    let opens = |pair: Pair| pair.closure != Closure::Bilateral;
    let parts = model.objects.iter();
    let parts = parts.filter(|part| model.elastic_pair(part).is_some_and(opens));
    let subject = parts
        .map(|part| format!("{}.pair.separations <= 0", part.id))
        .collect();
    let addresses: Vec<_> = all.iter().map(|one| one.address.clone()).collect();
    (
        vec![
            ("vary", ranges),
            ("maximize", addresses),
            ("subject", subject),
        ],
        why,
    )
}

fn choices_for_scene(command: &str, ready: &Mechanism, tree: &Value) -> (Choices, Option<String>) {
    let model = ready.model();
    let named = |option, names: Vec<String>, why: &str| {
        let none = names.is_empty().then(|| why.to_owned());
        (vec![(option, names)], none)
    };
    match command {
        "kinematics" => linkages(model, |id| Subject::of(model, id).err()),
        "forces" => linkages(model, |id| linkage_of(model, id).err()),
        "steady" => {
            let spec = ready.scene().steady.clone().unwrap_or_default();
            let wrong = steady::suits(model, &spec).err().unwrap_or_default();
            let first = wrong.into_iter().next();
            (
                Vec::new(),
                first.map(|fault| format!("{}: {}", fault.path, fault.message)),
            )
        }
        "orders" => {
            let wrong = orders::suits(&ready.system).err().unwrap_or_default();
            (
                Vec::new(),
                wrong.into_iter().next().map(|fault| fault.message),
            )
        }
        "linearise" | "response" => {
            let wrong = LinearModel::of(&ready.system).err().unwrap_or_default();
            (
                Vec::new(),
                wrong.into_iter().next().map(|fault| fault.message),
            )
        }
        "cam" => {
            let names = objects_with_cam(ready.scene())
                .into_iter()
                .map(str::to_owned);
            named(
                "object",
                names.collect(),
                "no object of the scene describes its cam",
            )
        }
        "law cycle" => {
            let parts = model.objects.iter().map(|part| part.id.clone());
            let follows = parts.filter(|id| ready.law_cycle(id).is_ok());
            named(
                "of",
                follows.collect(),
                "no object of the scene follows the cycle of a cam",
            )
        }
        "law compare" => {
            let mut found = Vec::new();
            laws(&tree["objects"], "", &mut found);
            named("at", found, "no law of motion is in the scene")
        }
        "law show" => {
            let names = LawName::ALL.map(|name| name.name().to_owned());
            (vec![("law", names.to_vec())], None)
        }
        "methods" => {
            let all = all_methods();
            let names = all.iter().map(|method| method.name().to_owned());
            (vec![("methods", names.collect())], None)
        }
        _ => (Vec::new(), None),
    }
}

/// The linkages that can be asked, where there are several by name.
fn linkages(
    model: &Model,
    refused: impl Fn(Option<&str>) -> Option<String>,
) -> (Choices, Option<String>) {
    let fits = |id: &str| several_of(model, Some(id)).is_some() || refused(Some(id)).is_none();
    let names = model.objects.iter().map(|part| part.id.clone());
    let names: Vec<String> = names.filter(|id| fits(id)).collect();
    let why = match names.is_empty() {
        true => refused(None),
        false => None,
    };
    (vec![("object", names)], why)
}

/// Addresses of laws of motion.
fn laws(value: &Value, at: &str, found: &mut Vec<String>) {
    let inner = |name: &str| match at {
        "" => name.to_owned(),
        at => format!("{at}.{name}"),
    };
    match value {
        Value::Object(members) => {
            for (name, value) in members {
                match name == "law" && !at.is_empty() {
                    true => found.push(inner(name)),
                    false => laws(value, &inner(name), found),
                }
            }
        }
        Value::Array(items) => {
            for (index, item) in items.iter().enumerate() {
                laws(item, &format!("{at}[{index}]"), found);
            }
        }
        _ => {}
    }
}
