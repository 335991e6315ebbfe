//! `dam reduce`, as a user calls it.

use serde_json::Value;
use std::path::Path;
use std::process::{Command, Output};

fn dam(arguments: &[&str], folder: &Path) -> Output {
    let root = Path::new(env!("CARGO_MANIFEST_DIR"));
    let scene = |argument: &&str| match argument.starts_with("scenarios/") {
        true => root.join(argument).display().to_string(),
        false => (*argument).to_owned(),
    };
    let arguments: Vec<String> = arguments.iter().map(scene).collect();
    let mut command = Command::new(env!("CARGO_BIN_EXE_dam"));
    command.args(arguments).current_dir(folder);
    command.output().expect("the program")
}

fn json(output: &Output) -> Value {
    serde_json::from_slice(&output.stdout).expect("a document")
}

#[test]
fn the_reduced_scene_runs_and_gives_what_is_said_of_it() {
    let folder = tempfile::tempdir().expect("a folder");
    let scene = "scenarios/rocker/ten_masses_closed.json";
    let arguments = ["reduce", scene, "--figure", "rocker.delta_abs", "--json"];
    let out = ["--out", "out"];
    let found = dam(&[&arguments[..], &out[..]].concat(), folder.path());
    assert_eq!(found.status.code(), Some(0));
    let found = json(&found);
    assert_eq!(found["holds"], true);
    let run = dam(&["run", "out/reduced.json", "--json"], folder.path());
    assert_eq!(run.status.code(), Some(0));
    let run = json(&run);
    let said = &found["accuracy"]["rocker.delta_abs"]["value"];
    assert_eq!(run["objects"]["rocker"]["delta_abs"], *said);
    let page = std::fs::read_to_string(folder.path().join("out/report.html"));
    assert!(
        page.expect("a page")
            .contains("Parts that the scene does not need")
    );
    // The document is in the folder as it was printed, but for the times of runs.
    let kept = std::fs::read(folder.path().join("out/reduction.json")).expect("a document");
    let kept: Value = serde_json::from_slice(&kept).expect("a document");
    assert_eq!(kept["steps"], found["steps"]);
}

/// The model of one mass is off by some percent, and more coordinates are needed.
#[test]
fn a_scene_that_is_itself_inaccurate_is_said_to_be() {
    let folder = tempfile::tempdir().expect("a folder");
    let reduce = |accuracy: &str| {
        let scene = "scenarios/rocker/ten_masses_closed.json";
        let arguments = [
            "reduce",
            scene,
            "--figure",
            "rocker.delta_max",
            "--accuracy",
        ];
        let arguments = [&arguments[..], &[accuracy, "--json"]].concat();
        json(&dam(&arguments, folder.path()))
    };
    for (accuracy, holds) in [("1e-9 rad", false), ("0.1 mrad", true)] {
        let found = reduce(accuracy);
        let given = found["models"].as_array().expect("models").iter();
        let mut given = given.filter(|model| model["role"] == "given");
        let given = given.next().expect("the scene as given");
        let error = given["errors"]["rocker.delta_max"]
            .as_f64()
            .expect("an error");
        let asked = found["accuracy"]["rocker.delta_max"]["asked"].as_f64();
        assert_eq!(error <= asked.expect("a bound"), holds, "{error}");
        assert_eq!(found["given_holds"], holds, "{accuracy}");
        let answer = found["answer"].as_str().expect("an answer");
        let words = "The scene as given is not that accurate: greatest δ of rocker is up to";
        assert_eq!(answer.contains(words), !holds, "{answer}");
    }
}

#[test]
fn a_figure_that_has_no_limit_or_does_not_exist_is_told() {
    let folder = tempfile::tempdir().expect("a folder");
    let scene = "scenarios/rocker/two_masses.json";
    let figure = "rocker.pair.max_contact_force";
    let found = dam(&["reduce", scene, "--figure", figure], folder.path());
    assert_eq!(found.status.code(), Some(1));
    let text = String::from_utf8_lossy(&found.stdout).into_owned();
    assert!(text.contains("no converged value"), "{text}");
    let found = dam(
        &["reduce", scene, "--figure", "rocker.delta"],
        folder.path(),
    );
    assert_eq!(found.status.code(), Some(2));
    let text = String::from_utf8_lossy(&found.stderr).into_owned();
    assert!(text.contains("rocker.delta"), "{text}");
}

#[test]
fn models_and_methods_are_recommended_together() {
    let folder = tempfile::tempdir().expect("a folder");
    let scene = "scenarios/rocker/ten_masses_closed.json";
    let arguments = ["methods", scene, "--models", "--repeats", "1", "--json"];
    let few = ["--methods", "exact,radau", "--tolerances", "1e-4,1e-6"];
    let found = dam(&[&arguments[..], &few[..]].concat(), folder.path());
    assert_eq!(found.status.code(), Some(0));
    let found = json(&found);
    let models = &found["models"];
    let error = models["error"].as_f64().expect("an error");
    assert!(error < 0.01, "{error}");
    // Methods need to be no better than a tenth of what is asked of the model.
    assert_eq!(found["accuracy"], 1e-3);
    let tried = models["tried"].as_array().expect("models");
    assert!(
        tried
            .iter()
            .any(|model| model["given"] == true && model["error"].as_f64() > Some(0.01))
    );
    let text = found["recommendation"]["text"]
        .as_str()
        .expect("a sentence");
    assert!(text.starts_with("model: rocker"), "{text}");
    let clash = dam(
        &["methods", scene, "--models", "--x", "rocker.masses=1:3:3"],
        folder.path(),
    );
    assert_eq!(clash.status.code(), Some(2));
}
