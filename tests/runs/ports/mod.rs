//! Objects with several inputs, and kinds of objects from outside the library.

mod differential;
mod doors;
mod faults;
mod geneva;
mod wheel;

use dam::integrate::Method;
use dam::lower::lower;
use dam::object::Registry;
use dam::scene::{BuiltIn, Document, Overrides, TypedScene};
use dam::studies::run::{RunResult, run};
use dam::studies::{Control, RunSettings};
use dam::system::System;

/// A scene of objects, run as said.
fn text(objects: &str, run: &str) -> String {
    format!(r#"{{ "dam": 1, "name": "ports", "objects": {{ {objects} }}, "run": {{ {run} }} }}"#)
}

fn document(objects: &str, run: &str, registry: Registry) -> Document {
    let text = text(objects, run);
    let document = Document::parse("scene.json", text.as_bytes());
    document
        .unwrap_or_else(|e| panic!("{e}"))
        .with_kinds(registry)
}

fn read(document: &Document) -> TypedScene {
    let reading = document.scene(&BuiltIn, &Overrides::none());
    reading.unwrap_or_else(|e| panic!("{e}")).scene
}

fn system_of(objects: &str, run: &str) -> (System, RunSettings) {
    let scene = read(&document(objects, run, Registry::standard()));
    ready(&scene)
}

fn ready(scene: &TypedScene) -> (System, RunSettings) {
    let model = lower(scene).unwrap_or_else(|faults| panic!("{faults:?}"));
    let system = System::new(model).unwrap_or_else(|faults| panic!("{faults:?}"));
    (system, RunSettings::of(scene).expect("settings"))
}

/// A run by a method; `None`: the one that the program chooses.
fn run_by(system: &System, settings: &RunSettings, method: Option<Method>) -> RunResult {
    let settings = RunSettings {
        method,
        ..settings.clone()
    };
    let result = run(system, &settings, &Control::default(), &mut []);
    let result = result.unwrap_or_else(|faults| panic!("{method:?}: {faults:?}"));
    assert!(result.is_complete(), "{method:?}: {:?}", result.outcome);
    assert!(result.is_trusted(), "{method:?}: {:?}", result.warnings);
    result
}

/// The integrated methods that need no series.
const METHODS: [Method; 4] = [
    Method::Dopri5,
    Method::Dop853,
    Method::Rodas5p,
    Method::Radau,
];
