//! Scenes from text, run.

use dam::linkage::spec::LinkageSpec;
use dam::lower::lower;
use dam::scene::{BuiltIn, Document, Overrides, TypedScene};
use dam::studies::run::{RunResult, run};
use dam::studies::{Control, RunSettings};
use dam::system::System;

pub(crate) fn read(text: &str, overrides: &[&str]) -> TypedScene {
    let document = Document::parse("scene", text.as_bytes()).expect("JSON");
    match document.scene(&BuiltIn, &Overrides::new(overrides.to_vec())) {
        Ok(reading) => reading.scene,
        Err(faults) => panic!("{}", faults.render(false)),
    }
}

/// The linkage of an object.
pub(crate) fn linkage_of(scene: &TypedScene, id: &str) -> LinkageSpec {
    let driven = scene.objects[id].object.linkage();
    driven.expect("a linkage").linkage.clone()
}

pub(crate) fn scene_of(objects: &str, run: &str) -> String {
    format!(
        r#"{{ "dam": 1, "name": "joint friction", "objects": {{ {objects} }}, "run": {{ {run} }} }}"#
    )
}

/// Runs a scene; the run must be worth trusting.
pub(crate) fn run_of(text: &str, overrides: &[&str]) -> RunResult {
    let result = ran(&read(text, overrides));
    let (stop, warnings) = (&result.outcome.stop, &result.figures.warnings);
    assert!(
        result.is_trusted(),
        "{stop:?} at {}, {warnings:?}",
        result.outcome.time
    );
    result
}

/// Runs a scene, whatever comes of it.
pub(crate) fn ran(scene: &TypedScene) -> RunResult {
    let model = lower(scene).unwrap_or_else(|faults| panic!("{faults:?}"));
    let system = System::new(model).unwrap_or_else(|faults| panic!("{faults:?}"));
    let settings = RunSettings::of(scene).expect("settings");
    run(&system, &settings, &Control::default(), &mut []).expect("a run")
}

/// A figure that must have a value.
pub(crate) fn figure(result: &RunResult, address: &str) -> f64 {
    match result.figures.value(address) {
        Ok(value) => value,
        Err(error) => panic!("{address}: {error:?}"),
    }
}

/// Why a run stopped before its end.
pub(crate) fn stopped(result: &RunResult) -> Option<&str> {
    result.figures.run.stopped.as_deref()
}
