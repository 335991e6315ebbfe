//! The same motion written in other ways: in other units, with its objects in another order,
//! through a rigid object more, in two runs, and with another machine in its scene.

use super::agreement::{Answer, answer, difference, numbers};
use super::draw::Units;
use super::scene::{BODIES, Drawn, MOTIONS, draw, draw_named};
use dam::integrate::Method;
use dam::prelude::{Quantity, RunResult};
use serde_json::{Value, json};

/// What the same motion may differ by, as a share of the scale of a figure.
const SAME: f64 = 1e-6;

/// The same beside another machine: its steps and switches are those of both.
const SAME_BESIDE: f64 = 1e-5;

/// Names of the other machine.
const BESIDE: [&str; 3] = ["u", "v", "w"];

/// Other units of time and inertia.
const OTHER: Units = Units {
    time: 0.03125,
    inertia: 8.0,
};

fn certified(scene: &Value, method: Option<Method>) -> Option<Box<RunResult>> {
    match answer(scene, method) {
        Ok(Answer::Certified(result)) => Some(result),
        Ok(Answer::Doubted(_) | Answer::Refused) | Err(_) => None,
    }
}

/// The figures of a result in SI units, where the scene was written in others, and with the
/// names of objects changed.
fn translated(mut result: RunResult, units: Units, names: &[(&str, &str)]) -> RunResult {
    let objects = std::mem::take(&mut result.figures.objects);
    for (id, mut own) in objects {
        own.end.speed *= units.time;
        own.peak_speed *= units.time;
        own.peak_acceleration *= units.time * units.time;
        own.peak_reaction *= units.time * units.time / units.inertia;
        let mut parts = id.splitn(2, '.');
        let first = parts.next().unwrap_or_default();
        let to = names.iter().find(|(from, _)| *from == first);
        let mut name = to.map_or(first, |(_, to)| *to).to_owned();
        if let Some(rest) = parts.next() {
            name = format!("{name}.{rest}");
        }
        // (What was inserted has no twin.)
        if name != "i" {
            result.figures.objects.insert(name, own);
        }
    }
    result
}

/// The scene with a duration in ms and inertias and stiffnesses in g and N/mm, as texts.
fn in_texts(scene: &Value) -> Value {
    let mut scene = scene.clone();
    let text = |value: &mut Value, factor: f64, unit: &str| {
        if let Some(number) = value.as_f64() {
            *value = json!(format!("{:?} {unit}", number * factor));
        }
    };
    text(&mut scene["run"]["duration"], 1e3, "ms");
    let objects = scene["objects"].as_object_mut().expect("objects");
    for object in objects
        .values_mut()
        .filter(|object| object["kind"] == "slider")
    {
        text(&mut object["inertia"], 1e3, "g");
        if object.get("stiffness").is_some() {
            text(&mut object["stiffness"], 1e-3, "N/mm");
        }
    }
    scene
}

/// The scene with a rigid shaft between the drive and what it drives.
fn lengthened(scene: &Value) -> Value {
    let mut scene = scene.clone();
    let objects = scene["objects"].as_object_mut().expect("objects");
    for object in objects.values_mut() {
        if object.get("input").is_some_and(|input| input == "a") {
            object["input"] = json!("i");
        }
        let inputs = object.get_mut("inputs").and_then(Value::as_object_mut);
        for input in inputs.into_iter().flat_map(|inputs| inputs.values_mut()) {
            if input["object"] == "a" {
                input["object"] = json!("i");
            }
        }
    }
    let shaft = json!({ "kind": "shaft", "input": "a", "inertia": 0, "masses": 0 });
    objects.insert("i".to_owned(), shaft);
    scene
}

/// The scene with the machine of the next number beside its own.
fn beside(scene: &Value, number: u64) -> Value {
    let mut scene = scene.clone();
    let mut other = draw_named(number + 1, Units::SI, BESIDE).scene;
    let more = other["objects"].as_object_mut().expect("objects");
    let objects = scene["objects"].as_object_mut().expect("objects");
    objects.append(more);
    scene
}

/// A result without the machine beside.
fn without_beside(mut result: RunResult) -> RunResult {
    let is_own = |id: &str| !BESIDE.contains(&id.split('.').next().unwrap_or_default());
    result.figures.objects.retain(|id, _| is_own(id));
    result
}

/// The second part of a run that is split at a sample, from the state that the first part came
/// to; `None` where a state cannot be given: something but a chain moves by itself.
fn second_part(drawn: &Drawn, whole: &RunResult, sample: usize) -> Option<Value> {
    let written = drawn.written.as_ref()?;
    if !matches!(BODIES[drawn.body], "chain" | "friction" | "written load") {
        return None;
    }
    let time = whole.record.times[sample];
    let mut scene = drawn.scene.clone();
    let shifted = shift(written, time);
    scene["objects"]["a"]["motion"]["expression"] = json!(shifted);
    let masses = scene["objects"]["c"]["masses"].as_u64()? as usize;
    let entry = |quantity: Quantity| {
        let mut columns = whole.record.columns.iter();
        let own = columns.find(|own| own.object == "c" && own.quantity == quantity)?;
        own.values.get(sample).copied()
    };
    let (mut displacement, mut speed) = (Vec::new(), Vec::new());
    for mass in 1..=masses {
        displacement.push(entry(Quantity::MassDisplacement(mass))?);
        speed.push(entry(Quantity::MassSpeed(mass))?);
    }
    scene["run"]["start"] = json!({ "c": { "displacement": displacement, "speed": speed } });
    let duration = drawn.scene["run"]["duration"].as_f64()?;
    scene["run"]["duration"] = json!(duration - time);
    // Loads over time go on as well.
    if let Some(push) = scene["objects"]["c"]["loads"].get_mut("push") {
        let w = std::f64::consts::TAU * push["harmonic"]["frequency"].as_f64()?;
        push["harmonic"]["phase"] = json!(w * time);
    }
    Some(scene)
}

/// An expression in t at a later time.
fn shift(text: &str, time: f64) -> String {
    let is_name = |c: char| c.is_alphanumeric() || c == '_';
    let letters: Vec<char> = text.chars().collect();
    let mut found = String::new();
    for (k, &letter) in letters.iter().enumerate() {
        let before = k.checked_sub(1).map(|k| letters[k]);
        let alone =
            !before.is_some_and(is_name) && !letters.get(k + 1).copied().is_some_and(is_name);
        match letter == 't' && alone {
            true => found.push_str(&format!("(t + {time:?})")),
            false => found.push(letter),
        }
    }
    found
}

/// Differences found, by what was done.
#[derive(Default)]
struct Found {
    compared: [u32; 6],
    differ: Vec<String>,
}

const WAYS: [&str; 6] = [
    "similar",
    "other order",
    "texts",
    "a rigid shaft more",
    "two runs",
    "another machine beside",
];

fn compare(number: u64, found: &mut Found) {
    let drawn = draw(number, Units::SI, false);
    let method = [None, Some(Method::Radau), Some(Method::Dop853)][(number % 3) as usize];
    let mut scene = drawn.scene.clone();
    scene["run"]["record"] = json!("all");
    let Some(own) = certified(&scene, method) else {
        return;
    };
    let own = *own;
    let mut see = |way: usize, other: Option<RunResult>, own: &RunResult| {
        let Some(other) = other else {
            return; // not certified
        };
        found.compared[way] += 1;
        let (share, address) = difference(own, &other);
        let same = if way == 5 { SAME_BESIDE } else { SAME };
        if !(share <= same) {
            let kinds = format!("{} before {}", MOTIONS[drawn.motion], BODIES[drawn.body]);
            let way = WAYS[way];
            found.differ.push(format!(
                "{number}, {kinds}, {way}: {share:.1e} in {address}"
            ));
        }
    };
    let run = |scene: &Value| certified(scene, method).map(|result| *result);
    let names = [("z", "a"), ("y", "b"), ("a", "c")];
    let similar = run(&draw(number, OTHER, false).scene);
    see(0, similar.map(|other| translated(other, OTHER, &[])), &own);
    let other = run(&draw(number, Units::SI, true).scene);
    see(
        1,
        other.map(|other| translated(other, Units::SI, &names)),
        &own,
    );
    see(2, run(&in_texts(&drawn.scene)), &own);
    let longer = run(&lengthened(&drawn.scene));
    see(
        3,
        longer.map(|other| translated(other, Units::SI, &[])),
        &own,
    );
    let both = run(&beside(&drawn.scene, number));
    see(5, both.map(without_beside), &own);
    let sample = 1 + (number % 62) as usize;
    if let Some(second) = second_part(&drawn, &own, sample).and_then(|scene| run(&scene)) {
        // Only where it ends is the same.
        let mut other = own.clone();
        for (id, figures) in &mut other.figures.objects {
            figures.end = second.figures.objects[id].end;
        }
        see(4, Some(other), &own);
    }
}

#[test]
fn a_motion_is_the_same_however_it_is_written() {
    let mut found = Found::default();
    numbers(200).for_each(|number| compare(number, &mut found));
    for (way, count) in WAYS.iter().zip(found.compared) {
        println!("{way}: {count} compared");
    }
    println!("differences: {}", found.differ.len());
    found.differ.iter().for_each(|line| println!("  {line}"));
    assert!(
        found.differ.is_empty(),
        "the same motion written otherwise is another one"
    );
    assert!(
        found.compared.iter().all(|count| *count > 0),
        "{:?}",
        found.compared
    );
}
