//! `dam check` and `dam schema`.

use super::args::{CheckArgs, SchemaArgs};
use super::failure::Failure;
use super::input::{Input, print_doubts};
use super::status::Status;
use super::{console, described};
use crate::ask::ModelAssessment;
use crate::cli::args::scene::SceneArgs;
use crate::frontend::diagnostics::Diagnostics;
use crate::frontend::object::Registry;
use crate::frontend::scene::{schema, schema_of, schema_text};
use crate::report::quantity::counted;
use crate::studies::kinematics::{assembly_modes, limited_inputs};
use serde_json::{Value, json};

/// Checks a scene as far as is possible without running it.
pub(crate) fn command(args: &CheckArgs) -> Result<Status, Failure> {
    let ready = Input::load(&args.scene)?.prepare_judging(&[], ModelAssessment::Never)?;
    let start = ready.system.initial_state();
    let start = start.map_err(|faults| ready.reading.places.diagnose(&faults))?;
    let warnings = &ready.reading.warnings;
    let model = ready.system.model();
    let said: Vec<&String> = model.warnings.iter().chain(&start.warnings).collect();
    let reaches = limited_inputs(model);
    let modes = assembly_modes(model);
    let scene = ready.scene();
    if args.scene.json {
        console::json(&json!({
            "dam": 1,
            "scene": scene.name,
            "hash": scene.hash,
            "errors": [],
            "warnings": all_warnings(warnings, &said),
            "diagnostics": warnings.json(),
            "remarks": said,
            "reaches": reaches,
            "assembly_modes": modes,
        }))?;
        return Ok(Status::Answered);
    }
    print_doubts(&ready.reading, args.scene.quiet);
    if !args.scene.quiet {
        for text in said {
            console::print_message(&format!("warning: {text}"));
        }
    }
    let coordinates = start.y.len() / 2;
    console::print_text(&format!(
        "{} is valid: {}, {}, hash {}\n",
        scene.name,
        counted(scene.objects.len(), "object"),
        counted(coordinates, "coordinate"),
        &scene.hash[..16]
    ))?;
    for sentence in modes.iter().chain(&reaches) {
        console::print_text(&format!("{sentence}\n"))?;
    }
    Ok(Status::Answered)
}

/// Everything that the terminal warns of: what is doubtful in the text, with its places,
/// and what the model says of itself, as `dam run` has it in its `warnings`.
fn all_warnings(doubts: &Diagnostics, said: &[&String]) -> Vec<Value> {
    let mut all = match doubts.json() {
        Value::Array(list) => list,
        _ => Vec::new(),
    };
    all.extend(said.iter().map(|text| {
        json!({
            "severity": "warning", "code": "model", "path": "", "message": text, "label": "",
            "hints": [], "file": null, "line": null, "column": null,
        })
    }));
    all
}

/// Prints the JSON Schema of scenes, or that of one scene; or what else is declared.
pub(crate) fn print_schema(args: &SchemaArgs) -> Result<Status, Failure> {
    if let Some(found) = described::document(args.of) {
        if args.scene.is_some() {
            return Err(
                "results, units and codes are the same for every scene: leave the scene out"
                    .to_owned()
                    .into(),
            );
        }
        console::data(&schema_text(&found))?;
        return Ok(Status::Answered);
    }
    let found = match &args.scene {
        None => schema(&Registry::standard()),
        Some(scene) => {
            let input = Input::load(&SceneArgs::of(scene))?;
            schema_of(input.document(), &input.catalogue())
        }
    };
    console::data(&schema_text(&found))?;
    Ok(Status::Answered)
}
