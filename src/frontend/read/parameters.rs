//! Named parameters of a scene: `"parameters": { "r": "50 mm", "half": "r/2" }`.
//!
//! They are evaluated once, in the order in which they depend on each other, before
//! anything else is read. A number or an expression of the scene then refers to them.

use super::formulas::FORMULA_PATTERN;
use super::parameter::{MOST_FAULTS, MOST_OF_CIRCLE, Parameter, Parameters};
use super::slot::Slot;
use super::tree::{Member, Node, Value};
use super::wanted::QuantityChoice;
use crate::dynamics::builder::written::{DRIVER, OVER, OWN};
use crate::dynamics::model::CONDITION_NAMES;
use crate::frontend::diagnostics::{Diagnostic, Place};
use crate::units::quantities::{ALL, ANYTHING};
use crate::units::{Measure, Scope, formula, parse, reserved_meaning};
use serde_json::{Map, Value as Json, json};
use std::collections::BTreeMap;

/// True for a name that parameters may have; a hyphen would be a minus in formulas.
fn is_sound(name: &str) -> bool {
    super::is_name(name) && !name.contains('-')
}

/// What a name means in expressions already.
fn known_meaning(name: &str) -> Option<&'static str> {
    let variables = OWN
        .iter()
        .chain(&DRIVER)
        .chain(&OVER)
        .chain(&CONDITION_NAMES);
    let mut names = variables.map(|one| one.0);
    match names.any(|variable| variable == name) {
        true => Some("a variable"),
        false => reserved_meaning(name),
    }
}

/// Reads the parameters of a scene.
pub(super) fn read(mut slot: Slot<'_>) -> Option<()> {
    if slot.describing() {
        slot.describe(json!({
            "type": "object",
            "propertyNames": { "pattern": "^[A-Za-z_][A-Za-z0-9_]*$" },
            "additionalProperties": {
                "anyOf": [{ "type": "number" }, { "type": "string", "pattern": FORMULA_PATTERN }],
            },
        }));
        return None;
    }
    let Some(Value::Object(members)) = slot.node.map(|node| &node.value) else {
        slot.wrong_type("an object");
        return None;
    };
    let mut evaluation = Evaluation::new(members);
    evaluation.check_names();
    evaluation.evaluate();
    for (member, value) in members.iter().zip(&evaluation.values) {
        declare(&mut slot, member, *value);
    }
    let mut canonical = Map::new();
    let mut all = BTreeMap::new();
    for (at, member) in members.iter().enumerate() {
        let value = evaluation.values[at];
        canonical.insert(
            member.name.clone(),
            value.map_or(Json::Null, |one| json!(one.value)),
        );
        let parameter = Parameter {
            place: member.name_place.clone(),
            value_place: member.value.place.clone(),
            value,
            used: evaluation.used[at],
        };
        all.insert(member.name.clone(), parameter);
    }
    let sound = evaluation.values.iter().all(Option::is_some);
    let left_out = evaluation.faults.len().saturating_sub(MOST_FAULTS);
    for fault in evaluation.faults.drain(..).take(MOST_FAULTS) {
        let path = format!("{}.{}", slot.path, fault.path);
        slot.reader.diagnostics.push(Diagnostic { path, ..fault });
    }
    if left_out > 0 {
        let message = format!("{left_out} more parameters are wrong");
        slot.refuse("parameters", message);
    }
    *slot.out = Json::Object(canonical);
    slot.reader.parameters = Parameters::new(all);
    sound.then_some(())
}

/// Keeps what is known of a parameter that is a number, for those who ask for numbers.
fn declare(slot: &mut Slot<'_>, member: &Member, value: Option<Measure>) {
    let Some(value) = value else { return };
    let known = ALL.iter().find(|one| one.accept(value).is_ok());
    let wanted = QuantityChoice::from(*known.unwrap_or(&ANYTHING));
    slot.declare_at(&member.name, &member.value, wanted);
}

/// Parameters on the way to their values, by their place in the text.
struct Evaluation<'m> {
    members: &'m [Member],
    index: BTreeMap<&'m str, usize>,
    values: Vec<Option<Measure>>,
    used: Vec<bool>,
    faults: Vec<Diagnostic>,
}

impl<'m> Evaluation<'m> {
    fn new(members: &'m [Member]) -> Self {
        Self {
            members,
            index: members
                .iter()
                .map(|one| one.name.as_str())
                .zip(0..)
                .collect(),
            values: vec![None; members.len()],
            used: vec![false; members.len()],
            faults: Vec::new(),
        }
    }

    fn fault(&mut self, at: usize, code: &'static str, message: String) -> &mut Diagnostic {
        let member = &self.members[at];
        let fault = Diagnostic::error(code, message)
            .at(member.value.place.clone())
            .path(member.name.clone());
        super::slot::push(&mut self.faults, fault)
    }

    /// Refuses names that formulas could not tell from something else.
    fn check_names(&mut self) {
        for at in 0..self.members.len() {
            let name = &self.members[at].name;
            let (message, hint) = match known_meaning(name) {
                _ if !is_sound(name) => (
                    format!("`{name}` cannot be the name of a parameter"),
                    "names are made of letters, digits and `_`, and begin with a letter or `_`",
                ),
                Some(what) => (
                    format!(
                        "`{name}` cannot be the name of a parameter: it is {what} of expressions"
                    ),
                    "choose another name",
                ),
                None => continue,
            };
            let place = self.members[at].name_place.clone();
            let fault = self.fault(at, "bad-name", message);
            fault.place = Some(place);
            fault.hints.push(hint.to_owned());
        }
    }

    /// Evaluates each after those that it refers to.
    fn evaluate(&mut self) {
        let count = self.members.len();
        let references: Vec<Vec<usize>> = (0..count).map(|at| self.references(at)).collect();
        let mut open: Vec<usize> = references.iter().map(Vec::len).collect();
        let mut dependents: Vec<Vec<usize>> = vec![Vec::new(); count];
        for (at, references) in references.iter().enumerate() {
            for &other in references {
                dependents[other].push(at);
                self.used[other] |= other != at;
            }
        }
        let mut ready: Vec<usize> = (0..count).filter(|&at| open[at] == 0).collect();
        while let Some(at) = ready.pop() {
            self.values[at] = self.parameter_value(at);
            for &dependent in &dependents[at] {
                open[dependent] -= 1;
                if open[dependent] == 0 {
                    ready.push(dependent);
                }
            }
        }
        self.report_circles(&references, &open);
    }

    /// The parameters that a text names.
    fn references(&self, at: usize) -> Vec<usize> {
        let text = self.members[at].value.text().unwrap_or_default();
        let words = text.split(|c: char| !(c.is_alphanumeric() || c == '_'));
        // A number may stand right before a unit: `5mm`.
        let found = words.filter_map(|word| self.index.get(word).copied());
        let mut found: Vec<usize> = found.collect();
        found.sort_unstable();
        found.dedup();
        found
    }

    /// The circles among those that could not be evaluated.
    fn report_circles(&mut self, references: &[Vec<usize>], open: &[usize]) {
        // 0: not seen; otherwise the walk that came by first.
        let mut seen = vec![0usize; open.len()];
        for start in (0..open.len()).filter(|&at| open[at] > 0) {
            let (mut path, mut at) = (Vec::new(), start);
            while seen[at] == 0 {
                seen[at] = start + 1;
                path.push(at);
                // Each that is left refers to another that is left.
                let next = references[at].iter().find(|&&other| open[other] > 0);
                at = next.copied().unwrap_or(at);
            }
            let circle = path.iter().position(|&one| one == at);
            if let Some(from) = circle.filter(|_| seen[at] == start + 1) {
                self.report_circle(&path[from..]);
            }
        }
    }

    fn report_circle(&mut self, circle: &[usize]) {
        let name = |at: &usize| self.members[*at].name.as_str();
        let mut names: Vec<&str> = circle.iter().take(MOST_OF_CIRCLE).map(name).collect();
        if circle.len() > MOST_OF_CIRCLE {
            names.push("…");
        }
        names.push(name(&circle[0]));
        let message = format!(
            "parameters depend on each other in a circle: {}",
            names.join(" → ")
        );
        let others: Vec<Place> = (circle[1..].iter().take(MOST_OF_CIRCLE))
            .map(|&at| self.members[at].value.place.clone())
            .collect();
        let mut fault = self.fault(circle[0], "cycle", message).clone();
        for place in others {
            fault = fault.with_place(place, "");
        }
        fault
            .hints
            .push("give one of them a value of its own".to_owned());
        self.faults.pop();
        self.faults.push(fault);
    }

    fn parameter_value(&mut self, at: usize) -> Option<Measure> {
        let node: &'m Node = &self.members[at].value;
        let text = match &node.value {
            Value::Number(value) if value.is_finite() => return Some(Measure::unitless(*value)),
            Value::Number(_) => {
                self.fault(
                    at,
                    "not-finite",
                    "this is too large for a number".to_owned(),
                );
                return None;
            }
            Value::Text(text) => text,
            _ => {
                let message = format!("a parameter must be a number, found {}", node.type_name());
                let hint = "a number, or a text: \"50 mm\", \"r/2\"";
                self.fault(at, "wrong-type", message)
                    .hints
                    .push(hint.to_owned());
                return None;
            }
        };
        let refers = !self.references(at).is_empty();
        if let Some(measure) = parse(text).ok().filter(|_| !refers) {
            return Some(measure);
        }
        match formula(text, &mut *self) {
            Ok(found) => found,
            Err(mistake) => {
                let wrong = super::formulas::fault(text, &mistake, &Scope::names(self));
                let place = super::formulas::place_of_mistake(&node.place, text, &mistake);
                let fault = self.fault(at, wrong.code, wrong.message);
                fault.place = Some(place);
                fault.hints.push(wrong.hint);
                None
            }
        }
    }
}

impl Scope for Evaluation<'_> {
    fn quantity(&mut self, name: &str) -> Option<Option<Measure>> {
        self.index.get(name).map(|&at| self.values[at])
    }

    fn names(&self) -> Vec<String> {
        // Of many faults the first ones are shown.
        let most = match self.faults.len() > MOST_FAULTS {
            true => 0,
            false => super::formulas::MOST_NAMES,
        };
        let names = self.members.iter().take(most);
        names.map(|one| one.name.clone()).collect()
    }
}
