//! The objects of a scene, and who drives whom.

use super::address::RESERVED;
use super::{Catalogue, MeasuredValue, SceneObject};
use crate::dynamics::model::Coordinate;
use crate::frontend::diagnostics::{Diagnostic, RelatedPlace};
use crate::frontend::graph::MechanismGraph;
use crate::frontend::object::{Context, Inputs, Kind, KnownObject, Object, OwnObject, Registry};
use crate::frontend::read::{Fields, Node, Slot, Value, is_name};
use serde_json::{Value as Json, json};
use std::cell::RefCell;
use std::collections::BTreeMap;

/// Objects of a scene, also faulty ones, as the rest of the scene must know them.
#[derive(Debug)]
pub(super) struct ObjectTable {
    /// The kinds that they may be of.
    pub(super) registry: Registry,
    /// By id; outputs of objects as `object.output`.
    pub(super) objects: BTreeMap<String, KnownObject>,
    /// Stops of objects as `object.stop`, with what their object does: turn or slide.
    pub(super) stops: BTreeMap<String, Option<Coordinate>>,
    /// Numbers with units of figures whose quantity follows from the model.
    pub(super) measured: RefCell<Vec<MeasuredValue>>,
    /// Names that editors offer for `from`, with the kind of each.
    offered: Vec<(String, String)>,
}

impl ObjectTable {
    /// Nothing yet.
    pub(super) fn new(registry: &Registry) -> Self {
        Self {
            registry: registry.clone(),
            objects: BTreeMap::new(),
            stops: BTreeMap::new(),
            measured: RefCell::default(),
            offered: Vec::new(),
        }
    }

    /// The same, to be described: with the ids of a scene, if there is one, and what
    /// a catalogue has.
    pub(super) fn offering(mut self, scene: Option<&Node>, catalogue: &dyn Catalogue) -> Self {
        let objects = scene.and_then(|scene| scene.get("objects"));
        for member in objects.map_or(&[][..], Node::members) {
            self.note_object(&member.name, &member.value);
        }
        let kind = |name: &String| -> Option<String> {
            let (_, text) = catalogue.lookup(name)?;
            let object: Json = serde_json::from_str(&text).ok()?;
            Some(object.get("kind")?.as_str()?.to_owned())
        };
        let names = catalogue.names().into_iter();
        self.offered = names
            .filter_map(|name| Some((kind(&name)?, name)))
            .map(|(kind, name)| (name, kind))
            .collect();
        self
    }

    /// Keeps a number that was written with a unit, until it is known what the figure measures.
    pub(super) fn keep_measure(&self, figure: &str, slot: &mut Slot<'_>) {
        let text = slot.node().and_then(Node::text);
        if let Some(text) = text
            && let Some(measure) = slot.quantity_of(text)
        {
            self.measured.borrow_mut().push(MeasuredValue {
                figure: figure.to_owned(),
                path: slot.path().to_owned(),
                text: text.to_owned(),
                measure,
            });
        }
    }

    /// What the catalogue has of a kind.
    fn catalogue_entries(&self, kind: &Kind) -> Vec<&str> {
        let fitting = self.offered.iter().filter(|one| one.1 == kind.name);
        fitting.map(|one| one.0.as_str()).collect()
    }

    fn kind_of(&self, node: &Node) -> Option<&Kind> {
        self.registry.kind(node.get("kind")?.text()?)
    }

    /// How the inputs of an object are written; `None`: its kind is not known.
    fn inputs_of(&self, node: &Node) -> Option<Inputs> {
        let own = OwnObject::of(node).map(OwnObject::inputs);
        own.or_else(|| Some(self.kind_of(node)?.inputs))
    }

    /// Takes down what the text tells of an object and its outputs.
    fn note_object(&mut self, id: &str, node: &Node) {
        let (coordinate, outputs) = match (OwnObject::of(node), self.kind_of(node)) {
            (Some(own), _) => {
                let others = own.ports().outputs.into_iter().skip(1);
                let named = others.map(|port| (port.name.into_owned(), port.coordinate));
                (Some(own.coordinate()), named.collect())
            }
            (None, Some(kind)) => ((kind.coordinate)(node), (kind.outputs)(node)),
            (None, None) => (None, Vec::new()),
        };
        for stop in node.get("stops").map_or(&[][..], Node::members) {
            self.stops.insert(format!("{id}.{}", stop.name), coordinate);
        }
        let masses = None;
        self.objects
            .insert(id.to_owned(), KnownObject { coordinate, masses });
        for (output, coordinate) in outputs {
            let masses = Some(0);
            self.objects
                .insert(format!("{id}.{output}"), KnownObject { coordinate, masses });
        }
    }
}

/// Reads the objects; fills in `known` on the way.
pub(super) fn read(
    mut slot: Slot<'_>,
    known: &mut ObjectTable,
) -> Option<BTreeMap<String, SceneObject>> {
    if slot.describing() {
        describe(slot, known);
        return None;
    }
    let node = slot.node()?;
    for member in node.members() {
        known.note_object(&member.name, &member.value);
    }
    let objects = slot.read_in_place(|slot| slot.map(|id, slot| read_object(slot, id, known)));
    let sound = check_graph(&mut slot, node, known);
    objects.filter(|_| sound)
}

fn read_kind(fields: &mut Fields<'_>, registry: &Registry) -> Option<Kind> {
    let kinds: Vec<(&'static str, Kind)> = (registry.kinds().iter())
        .map(|kind| (kind.name, *kind))
        .collect();
    fields.need("kind", "What the object is.", |slot| slot.choice(&kinds))
}

/// Reads one object; notes in `known` how many masses it has.
pub(super) fn read_object(
    mut slot: Slot<'_>,
    id: &str,
    known: &mut ObjectTable,
) -> Option<SceneObject> {
    let sound = check_id(&mut slot, id);
    let is_own = slot
        .node()
        .is_some_and(|node| OwnObject::of(node).is_some());
    let object = slot.record(|fields| {
        fields.remark("description", "Remarks for people.");
        if is_own {
            let mut context = Context::among(&known.objects);
            let object = OwnObject::read(fields, &mut context)?;
            let (connections, mentions) = context.into_references();
            return Some(SceneObject {
                object,
                connections,
                mentions,
            });
        }
        // A `from` is still there only when nothing could be copied.
        let kind = match fields.has("from") {
            true => None,
            false => read_kind(fields, &known.registry),
        };
        let Some(kind) = kind else {
            fields.ignore_others();
            return None;
        };
        let mut context = Context::among(&known.objects);
        let connected = match kind.inputs {
            Inputs::None => {
                let message = "a drive has no `input`: it is where motion comes from";
                let hint = "remove `input`, or choose another `kind`";
                (!fields.forbid("input", message, hint)).then_some(())
            }
            Inputs::One => read_only_input(fields, &mut context, kind.name),
            Inputs::OneOrSeveral if fields.has("inputs") => {
                let message = "its `inputs` name what drives it";
                let hint = "remove `input`, or give `input` and `driver` in place of `inputs`";
                (!fields.forbid("input", message, hint)).then_some(())
            }
            Inputs::OneOrSeveral => read_only_input(fields, &mut context, kind.name),
            Inputs::Several => Some(()),
        };
        let object = (kind.read)(fields, &context);
        connected?;
        let (connections, mentions) = context.into_references();
        Some(SceneObject {
            object: object?,
            connections,
            mentions,
        })
    })?;
    if let Some(entry) = known.objects.get_mut(id) {
        entry.masses = Some(object.object.masses());
    }
    sound.then_some(object)
}

/// Reads `input` of an object with one driver; several are told as such.
fn read_only_input(fields: &mut Fields<'_>, context: &mut Context<'_>, kind: &str) -> Option<()> {
    let message = format!("a {kind} takes one input");
    let hint = "name the one output that drives it: \"input\": \"shaft\"; a `differential` sums \
                several motions to one that can drive it";
    let beside = fields.forbid("inputs", &message, hint);
    let given = fields.member("input").map(|member| &member.value);
    let count = match given.map(|node| &node.value) {
        Some(Value::List(list)) => Some(list.len()),
        Some(Value::Object(members)) => Some(members.len()),
        _ => None,
    };
    if let Some(count) = count {
        fields.maybe("input", "", |mut slot| -> Option<()> {
            let message = format!("{message}, found {count} in `input`");
            let fault = slot.refuse("wrong-type", message);
            fault.hints.push(hint.to_owned());
            None
        });
        return None;
    }
    if beside && given.is_none() {
        return None;
    }
    let connected = context.input(fields);
    connected.filter(|()| !beside)
}

fn check_id(slot: &mut Slot<'_>, id: &str) -> bool {
    let place = slot.name_place();
    let (message, hint) = if RESERVED.contains(&id) {
        let what = match id {
            "kinematics" | "forces" | "steady" => {
                format!("addresses of results of `dam {id}` begin with it")
            }
            _ => "it addresses the scene itself".to_owned(),
        };
        (
            format!("`{id}` cannot be the id of an object: {what}"),
            "choose another id".to_owned(),
        )
    } else if !is_name(id) {
        (
            format!("`{id}` cannot be the id of an object"),
            crate::frontend::read::NAME_RULE.to_owned(),
        )
    } else {
        return true;
    };
    let fault = slot.refuse("bad-id", message);
    fault.place = Some(place);
    fault.hints.push(hint);
    false
}

/// Cycles, and whether there is a drive at all.
fn check_graph(slot: &mut Slot<'_>, node: &Node, known: &ObjectTable) -> bool {
    let graph = MechanismGraph::new(node.members().iter().map(|member| {
        // Without a kind it may yet become one with an input.
        let inputs = known.inputs_of(&member.value).unwrap_or(Inputs::One);
        let inputs = inputs.references(&member.value);
        (member.name.as_str(), None, inputs)
    }));
    let cycles = graph.cycles();
    for cycle in &cycles {
        report_cycle(slot, node, known, cycle);
    }
    let is_drive = |node: &Node| match node.get("kind").and_then(Node::text) {
        _ if OwnObject::of(node).is_some() => known.inputs_of(node) == Some(Inputs::None),
        Some(name) => {
            let kind = known.registry.kind(name);
            kind.is_none_or(|kind| kind.inputs.is_source(node))
        }
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

fn report_cycle(slot: &mut Slot<'_>, node: &Node, known: &ObjectTable, cycle: &[&str]) {
    let place = |id: &str| {
        let object = node.get(id)?;
        let input = match known.inputs_of(object) {
            Some(Inputs::Several) => "inputs",
            Some(Inputs::OneOrSeveral) if object.get("inputs").is_some() => "inputs",
            _ => "input",
        };
        Some(object.get(input)?.place.clone())
    };
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
            Some(RelatedPlace {
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
fn describe(mut slot: Slot<'_>, known: &ObjectTable) {
    let registry = &known.registry;
    let mut by_kind = Vec::new();
    for kind in registry.kinds() {
        slot.read_in_place(|slot| {
            slot.defined(kind.name, |slot| read_describe_kind(slot, kind, known))
        });
        if let Some(schema) = slot.definition(kind.name) {
            allow_from(schema, kind);
        }
        // What is copied from the catalogue need not say its kind again.
        by_kind.push(json!({
            "if": { "anyOf": [
                { "properties": { "kind": { "const": kind.name } }, "required": ["kind"] },
                {
                    "properties": { "from": { "enum": known.catalogue_entries(kind) } },
                    "required": ["from"], "not": { "required": ["kind"] },
                },
            ] },
            "then": { "$ref": format!("#/$defs/{}", kind.name) },
        }));
    }
    let names: Vec<&str> = registry.kinds().iter().map(|kind| kind.name).collect();
    let all: Vec<&str> = known.offered.iter().map(|one| one.0.as_str()).collect();
    let from = json!({ "type": "string", "examples": all });
    slot.describe(json!({
        "type": "object",
        "minProperties": 1,
        "propertyNames": {
            "pattern": crate::frontend::read::NAME_PATTERN,
            "not": { "enum": RESERVED },
        },
        "additionalProperties": {
            "type": "object",
            "properties": { "kind": { "enum": names }, "from": from },
            "anyOf": [{ "required": ["kind"] }, { "required": ["from"] }],
            "allOf": by_kind,
        },
    }));
}

fn read_describe_kind(slot: Slot<'_>, kind: &Kind, known: &ObjectTable) -> Option<()> {
    slot.record(|fields| {
        fields.remark("description", "Remarks for people.");
        fields.need("kind", kind.doc, |slot| slot.choice(&[(kind.name, ())]));
        fields.maybe(
            "from",
            "Catalogue object to copy, as in `rocker/steel-lever-205mm`; properties given here replace its own.",
            |slot| slot.text_like(known.catalogue_entries(kind).into_iter()),
        );
        let mut context = Context::among(&known.objects);
        if kind.inputs == Inputs::One {
            context.input(fields);
        }
        if kind.inputs == Inputs::OneOrSeveral {
            context.maybe_input(fields);
        }
        (kind.read)(fields, &context);
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
