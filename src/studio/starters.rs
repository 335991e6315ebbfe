//! What an object begins with when it is put down: values with which it runs at once.
//!
//! `starters.json` has one object for each kind, by the motion of what drives it: a rotation,
//! a swing, or a travel along a line. Of what a catalogue object leaves open, the position in
//! which it hangs on its driver and the closing force among it, the same values are taken.

use serde_json::{Map, Value, json};
use std::sync::LazyLock;

static STARTERS: LazyLock<Value> = LazyLock::new(|| {
    serde_json::from_str(include_str!("starters.json")).expect("tested by every_part_runs")
});

/// Motions of what drives an object, the first for all kinds.
const MOTIONS: [&str; 3] = ["rotation", "swing", "travel"];
/// What an object needs of its surroundings, besides its own masses and stiffness.
const SURROUNDINGS: [&str; 4] = ["position", "lever_arm", "pair", "loads"];

/// The motion that objects of a kind give on, and what one begins with, by the motion of what drives
/// it; `own`: a catalogue object of this kind with its name. Null: the kind is unknown, or such
/// an object cannot hang on what moves so.
pub(super) fn begins(kind: &str, own: Option<(&str, &Map<String, Value>)>) -> Value {
    let Some(starter) = STARTERS.get(kind) else {
        return Value::Null;
    };
    let of = |motion: &str| {
        // The members of a gear turn.
        if motion == "travel" && own.is_some_and(|(_, own)| own.contains_key("planetary")) {
            return Value::Null;
        }
        // A block that begins away from zero wants a drive that begins there.
        if own.is_some_and(|(_, own)| begins_away(own)) {
            return Value::Null;
        }
        let object = starter.get(motion).unwrap_or(&starter[MOTIONS[0]]);
        own.map_or_else(|| object.clone(), |own| copy(kind, own, object, motion))
    };
    let mut begins = json!({ "gives": starter["gives"] });
    for motion in MOTIONS {
        begins[motion] = of(motion);
    }
    begins
}

/// True: the driver of a linkage is a block, and its travel is not zero at the start.
fn begins_away(own: &Map<String, Value>) -> bool {
    let driver = own.get("driver").and_then(Value::as_str);
    let pair = driver.and_then(|name| own.get("pairs")?.get(name));
    own.contains_key("start") && pair.is_some_and(|pair| pair.get("sliding").is_some())
}

/// A copy of a catalogue object with what it leaves open.
fn copy(
    kind: &str,
    (name, own): (&str, &Map<String, Value>),
    starter: &Value,
    motion: &str,
) -> Value {
    let mut object = json!({ "from": name });
    // What turns may hang on its driver in another way.
    let turns = own.get("motion").is_some_and(|motion| motion == "turning");
    let turning = STARTERS[kind].get("turning").filter(|_| turns);
    let around = turning.map_or(starter, |by| &by[motion]);
    let is_planetary = own.contains_key("planetary");
    if is_planetary {
        let input = json!({ "object": "" });
        object["inputs"] = json!({ "sun": input, "ring": input });
    } else if let (Some(input), false) = (starter.get("input"), own.contains_key("inputs")) {
        object["input"] = input.clone();
    }
    if is_planetary || own.contains_key("position") {
        return object;
    }
    for property in SURROUNDINGS {
        if let (Some(value), false) = (around.get(property), own.contains_key(property)) {
            object[property] = value.clone();
        }
    }
    object
}

#[cfg(test)]
mod tests {
    use crate::ask::Mechanism;
    use crate::frontend::object::Registry;
    use crate::frontend::scene::{BuiltIn, Document, Overrides};
    use crate::studio::asides::Aside;
    use serde_json::{Value, json};

    /// What drives the object that is put down.
    fn driven_by(motion: &str) -> (Value, &'static str) {
        let start = |kind: &str| super::begins(kind, None)["rotation"].clone();
        let mut objects = json!({ "drive": start("drive") });
        let driver = match motion {
            "swing" => "rocker",
            "travel" => "slider",
            _ => return (objects, "drive"),
        };
        objects["driver"] = start(driver);
        objects["driver"]["input"] = json!("drive");
        (objects, "driver")
    }

    fn hang(object: &mut Value, driver: &str) {
        if let Some(input) = object.get_mut("input") {
            *input = json!(driver);
        }
        let inputs = object.get_mut("inputs").and_then(Value::as_object_mut);
        for input in inputs.into_iter().flat_map(|inputs| inputs.values_mut()) {
            input["object"] = json!(driver);
        }
    }

    #[test]
    fn every_part_runs_as_it_is_put_down() {
        let aside = Aside {
            version: 0,
            name: "scene",
            text: "{}",
            catalogue: &BuiltIn,
        };
        let parts = aside.available_parts();
        let all = ["kinds", "objects"].map(|list| parts[list].as_array().unwrap());
        let mut ran = 0;
        for part in all.into_iter().flatten() {
            for motion in super::MOTIONS {
                let (mut objects, driver) = driven_by(motion);
                let mut own = part["begins"][motion].clone();
                if own.is_null() {
                    continue;
                }
                hang(&mut own, driver);
                objects["put"] = own;
                let run = json!({ "duration": "1 s", "start": "static" });
                let scene = json!({ "dam": 1, "name": "put down", "objects": objects, "run": run });
                let text = serde_json::to_string_pretty(&scene).unwrap();
                let document = Document::parse("scene", text.as_bytes()).unwrap();
                let reading = document.scene(&BuiltIn, &Overrides::none());
                let reading = reading.unwrap_or_else(|faults| panic!("{text}\n{faults:?}"));
                let mechanism =
                    Mechanism::of(reading).unwrap_or_else(|why| panic!("{text}\n{why:?}"));
                mechanism
                    .run()
                    .unwrap_or_else(|why| panic!("{text}\n{why:?}"));
                ran += 1;
            }
        }
        let kinds = Registry::standard().kinds().len();
        assert!(ran >= 3 * (kinds + 30) - 1, "{ran} parts were put down");
    }
}
