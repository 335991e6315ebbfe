//! The objects of a scene, and who drives whom.

use super::address::RESERVED;
use super::{SceneObject, driver_of};
use crate::diagnostics::{Diagnostic, Related};
use crate::graph::MechanismGraph;
use crate::model::Coordinate;
use crate::object::spec::{BodySpec, DriveSpec};
use crate::object::{Context, Description, KINDS, Kind};
use crate::read::{Fields, Node, Slot, did_you_mean, is_name, quoted_list};
use serde_json::{Value as Json, json};
use std::collections::BTreeMap;

/// What the rest of the scene must know of the objects, also of faulty ones.
#[derive(Debug, Default)]
pub(super) struct Known {
    /// By id; outputs of objects as `object.output`.
    pub(super) objects: BTreeMap<String, KnownObject>,
}

/// What is known of one object; `None`: not known.
#[derive(Clone, Copy, Debug, Default, PartialEq)]
pub(super) struct KnownObject {
    pub(super) coordinate: Option<Coordinate>,
    /// Number of coordinates that a start state has: its masses, 1 for a
    /// motor, 0 for a rigid object or a prescribed drive.
    pub(super) masses: Option<usize>,
}

/// Reads the objects; fills in `known` on the way.
pub(super) fn read(mut slot: Slot<'_>, known: &mut Known) -> Option<BTreeMap<String, SceneObject>> {
    if slot.describing() {
        describe(slot);
        return None;
    }
    let node = slot.node()?;
    for member in node.members() {
        let kind = kind_of(&member.value);
        let object = KnownObject {
            coordinate: kind.and_then(|kind| (kind.coordinate)(&member.value)),
            masses: None,
        };
        known.objects.insert(member.name.clone(), object);
        let outputs = kind.map(|kind| (kind.outputs)(&member.value));
        for (output, coordinate) in outputs.unwrap_or_default() {
            let id = format!("{}.{output}", member.name);
            let masses = Some(0);
            known.objects.insert(id, KnownObject { coordinate, masses });
        }
    }
    let objects = slot.look(|slot| slot.map(|id, slot| object(slot, id, known)));
    let sound = check_graph(&mut slot, node);
    objects.filter(|_| sound)
}

fn kind_of(node: &Node) -> Option<Kind> {
    let name = node.get("kind")?.text()?;
    KINDS.iter().find(|kind| kind.name == name).copied()
}

fn kind(fields: &mut Fields<'_>) -> Option<Kind> {
    let kinds: Vec<(&'static str, Kind)> = KINDS.iter().map(|kind| (kind.name, *kind)).collect();
    fields.need("kind", "What the object is.", |slot| slot.choice(&kinds))
}

/// Reads one object; notes in `known` how many masses it has.
pub(super) fn object(mut slot: Slot<'_>, id: &str, known: &mut Known) -> Option<SceneObject> {
    let sound = check_id(&mut slot, id);
    let object = slot.record(|fields| {
        fields.remark("description", "Remarks for people.");
        // A `from` is still there only when nothing could be copied.
        let kind = match fields.has("from") {
            true => None,
            false => kind(fields),
        };
        let Some(kind) = kind else {
            fields.ignore_others();
            return None;
        };
        let input = match kind.driven {
            true => read_input(fields, known).map(Some),
            false => {
                let message = "a drive has no `input`: it is where motion comes from";
                let hint = "remove `input`, or choose another `kind`";
                (!fields.forbid("input", message, hint)).then_some(None)
            }
        };
        let driver = input.clone().flatten();
        let driver = driver.and_then(|id| known.objects.get(&id)?.coordinate);
        let object = (kind.read)(fields, &Context { driver });
        Some(SceneObject {
            input: input?,
            object: object?,
        })
    })?;
    if let Some(entry) = known.objects.get_mut(id) {
        entry.masses = Some(start_size(object.object.description()));
    }
    sound.then_some(object)
}

fn start_size(description: Description<'_>) -> usize {
    match description {
        Description::Drive(DriveSpec::Prescribed(_)) | Description::Linkage(_) => 0,
        Description::Drive(DriveSpec::Motor(_)) => 1,
        Description::Chain(chain) => match &chain.body {
            BodySpec::Rigid { .. } => 0,
            BodySpec::Uniform { masses, .. } => *masses,
            BodySpec::Lists { inertias, .. } => inertias.len(),
        },
    }
}

fn check_id(slot: &mut Slot<'_>, id: &str) -> bool {
    let place = slot.name_place();
    let (message, hint) = if RESERVED.contains(&id) {
        (
            format!("`{id}` cannot be the id of an object: it addresses the scene itself"),
            "choose another id".to_owned(),
        )
    } else if !is_name(id) {
        (
            format!("`{id}` cannot be the id of an object"),
            crate::read::NAME_RULE.to_owned(),
        )
    } else {
        return true;
    };
    let fault = slot.refuse("bad-id", message);
    fault.place = Some(place);
    fault.hints.push(hint);
    false
}

const INPUT: &str =
    "Id of the object that drives this one, or one of its outputs: `press`, `press.ram`.";

/// The id of the driver, which must exist.
fn read_input(fields: &mut Fields<'_>, known: &Known) -> Option<String> {
    let input = fields.maybe("input", INPUT, |mut slot| {
        let input = slot.look(|slot| slot.text())?;
        if known.objects.contains_key(&input) {
            return Some(input);
        }
        match input.split_once('.') {
            Some((id, output)) if known.objects.contains_key(id) => {
                unknown_output(&mut slot, id, output, known);
            }
            _ => {
                let id = driver_of(&input);
                let ids = || known.objects.keys().map(String::as_str);
                let guess = did_you_mean(id, ids());
                let all = format!("the objects are {}", quoted_list(ids().take(20), "and"));
                let fault = slot.refuse("unknown-object", format!("unknown object `{id}`"));
                fault.hints.push(guess.unwrap_or(all));
            }
        }
        None
    })?;
    if input.is_none() {
        let ids = known.objects.keys().map(String::as_str);
        let others = ids.filter(|id| fields.path().rsplit('.').next() != Some(id));
        let hint = format!(
            "name what drives it: {}",
            quoted_list(others.take(20), "or")
        );
        fields.lack("input", Some(hint));
    }
    input
}

fn unknown_output(slot: &mut Slot<'_>, id: &str, output: &str, known: &Known) {
    let outputs: Vec<&str> = (known.objects.keys())
        .filter_map(|known| known.strip_prefix(id)?.strip_prefix('.'))
        .collect();
    let hint = match did_you_mean(output, outputs.iter().copied()) {
        Some(guess) => guess,
        None if outputs.is_empty() => format!("it has one output: write \"{id}\""),
        None => format!("its outputs are {}", quoted_list(outputs, "and")),
    };
    let fault = slot.refuse("unknown-object", format!("`{id}` has no output `{output}`"));
    fault.hints.push(hint);
}

/// Cycles, and whether there is a drive at all.
fn check_graph(slot: &mut Slot<'_>, node: &Node) -> bool {
    let inputs = node.members().iter().map(|member| {
        let input = member.value.get("input").and_then(Node::text);
        let drive = kind_of(&member.value).is_some_and(|kind| !kind.driven);
        (
            member.name.as_str(),
            input.filter(|_| !drive).map(driver_of),
        )
    });
    let graph = MechanismGraph::new(inputs);
    let cycles = graph.cycles();
    for cycle in &cycles {
        report_cycle(slot, node, cycle);
    }
    let is_drive = |node: &Node| match node.get("kind").and_then(Node::text) {
        Some(name) => KINDS.iter().all(|kind| kind.name != name || !kind.driven),
        // Without a kind it may yet become one.
        None => true,
    };
    let drive = node.members().iter().any(|member| is_drive(&member.value));
    if !drive {
        let place = slot.name_place();
        let fault = slot.refuse("no-drive", "no object of the scene is a drive");
        fault.place = Some(place);
        fault.hints.push(
            r#"add one: "shaft": { "kind": "drive", "motion": { "speed": "10 rev/s" } }"#
                .to_owned(),
        );
    }
    drive && cycles.is_empty()
}

fn report_cycle(slot: &mut Slot<'_>, node: &Node, cycle: &[&str]) {
    let place = |id: &str| Some(node.get(id)?.get("input")?.place.clone());
    let mut path = cycle.join(" → ");
    path.push_str(" → ");
    path.push_str(cycle[0]);
    let fault: &mut Diagnostic = slot.refuse(
        "cycle",
        format!("objects drive each other in a circle: {path}"),
    );
    fault.path = cycle[0].to_owned();
    fault.place = place(cycle[0]);
    fault.related = cycle[1..]
        .iter()
        .filter_map(|id| {
            Some(Related {
                place: place(id)?,
                label: String::new(),
            })
        })
        .collect();
    fault
        .hints
        .push("motion must come from a drive: change one `input`".to_owned());
}

/// The schema of all objects: one definition a kind.
fn describe(mut slot: Slot<'_>) {
    let mut by_kind = Vec::new();
    for kind in KINDS {
        slot.look(|slot| slot.defined(kind.name, |slot| describe_kind(slot, kind)));
        if let Some(schema) = slot.definition(kind.name) {
            allow_from(schema, kind);
        }
        by_kind.push(json!({
            "if": { "properties": { "kind": { "const": kind.name } }, "required": ["kind"] },
            "then": { "$ref": format!("#/$defs/{}", kind.name) },
        }));
    }
    let names: Vec<&str> = KINDS.iter().map(|kind| kind.name).collect();
    slot.describe(json!({
        "type": "object",
        "minProperties": 1,
        "propertyNames": {
            "pattern": crate::read::NAME_PATTERN,
            "not": { "enum": RESERVED },
        },
        "additionalProperties": {
            "type": "object",
            "properties": { "kind": { "enum": names }, "from": { "type": "string" } },
            "anyOf": [{ "required": ["kind"] }, { "required": ["from"] }],
            "allOf": by_kind,
        },
    }));
}

fn describe_kind(slot: Slot<'_>, kind: &Kind) -> Option<()> {
    slot.record(|fields| {
        fields.remark("description", "Remarks for people.");
        fields.need("kind", kind.doc, |slot| slot.choice(&[(kind.name, ())]));
        fields.maybe(
            "from",
            "Catalogue object to copy, as in `rocker/steel-lever-205mm`; properties given here replace its own.",
            |slot| slot.text(),
        );
        if kind.driven {
            fields.need("input", INPUT, |slot| slot.text());
        }
        (kind.read)(fields, &Context::default());
        None
    })
}

/// With `from`, what is required may come from the catalogue.
fn allow_from(schema: &mut Json, kind: &Kind) {
    let Some(map) = schema.as_object_mut() else {
        return;
    };
    let mut demands = serde_json::Map::new();
    for keyword in ["required", "allOf"] {
        if let Some(value) = map.remove(keyword) {
            demands.insert(keyword.to_owned(), value);
        }
    }
    map.insert("description".to_owned(), json!(kind.doc));
    map.insert("if".to_owned(), json!({ "not": { "required": ["from"] } }));
    map.insert("then".to_owned(), Json::Object(demands));
}
