//! `dam tolerance` as a program: its stacks and yields beside a reference in closed form, its
//! files, what it refuses.

use serde_json::Value;
use std::path::Path;
use std::process::{Command, Output};

fn dam(arguments: &[&str]) -> Output {
    Command::new(env!("CARGO_BIN_EXE_dam"))
        .args(arguments)
        .current_dir(env!("CARGO_MANIFEST_DIR"))
        .output()
        .unwrap()
}

fn document(arguments: &[&str]) -> Value {
    let output = dam(&[&["tolerance"], arguments, &["--json"]].concat());
    let errors = String::from_utf8_lossy(&output.stderr).into_owned();
    assert!(output.status.success(), "{arguments:?}: {errors}");
    serde_json::from_slice(&output.stdout).unwrap()
}

fn errors(arguments: &[&str]) -> String {
    let output = dam(&[&["tolerance"], arguments].concat());
    assert_eq!(output.status.code(), Some(2), "{arguments:?}");
    String::from_utf8(output.stderr).unwrap()
}

fn scene(folder: &Path, text: &str) -> String {
    let path = folder.join("scene.json");
    std::fs::write(&path, text).unwrap();
    path.display().to_string()
}

/// `tests/reference/design-optimum-tolerance.json`.
fn reference(name: &str) -> Value {
    let text = std::fs::read_to_string("tests/reference/design-optimum-tolerance.json").unwrap();
    serde_json::from_str::<Value>(&text).unwrap()[name].clone()
}

/// A number that is written as one or as a text of many digits.
fn number(value: &Value) -> f64 {
    match value {
        Value::String(text) => text.parse().unwrap(),
        other => other.as_f64().unwrap(),
    }
}

fn assert_close(found: &Value, wanted: &Value, within: f64) {
    let (found, wanted) = (number(found), number(wanted));
    let off = (found - wanted).abs();
    assert!(off <= within * wanted.abs(), "{found} and {wanted}: {off}");
}

fn slider_crank(offset: &str) -> String {
    format!(
        r#"{{
    "dam": 1, "name": "Slider-crank",
    "objects": {{
        "shaft": {{ "kind": "drive", "motion": {{ "speed": "10 rad/s" }} }},
        "slide": {{
            "kind": "slider", "input": "shaft", "masses": 0, "inertia": "1 kg",
            "position": {{ "slider_crank": {{ "crank": "50 mm", "rod": "150 mm", "offset": "{offset}" }} }}
        }}
    }},
    "run": {{ "duration": "0.7 s" }}
}}"#
    )
}

const CRANK: &str = "slide.position.slider_crank.crank=±0.05 mm";
const ROD: &str = "slide.position.slider_crank.rod=+-0.1 mm";
const STROKE: &str = "kinematics.slide.slide.stroke";

#[test]
fn a_slider_crank_with_an_offset_is_that_of_the_reference() {
    let folder = tempfile::tempdir().unwrap();
    let path = scene(folder.path(), &slider_crank("20 mm"));
    let wanted = reference("stroke_offset");
    let limit = number(&wanted["limit"]);
    let limits = [limit, -limit].map(|limit| number(&wanted["stroke"]) + limit);
    let found = document(&[
        &path,
        "--tol",
        CRANK,
        "--tol",
        ROD,
        "--tol",
        "slide.position.slider_crank.offset=±0.1 mm",
        "--limit",
        &format!("{STROKE} <= {:?} m", limits[0]),
        "--limit",
        &format!("{STROKE} >= {:?} m", limits[1]),
        "--samples",
        "256",
    ]);
    let stroke = &found["figures"][STROKE];
    assert_close(&stroke["nominal"], &wanted["stroke"], 1e-13);
    let by = |name: &str| &stroke["by"][format!("slide.position.slider_crank.{name}")];
    for name in ["crank", "rod", "offset"] {
        assert_close(&by(name)["derivative"], &wanted["gradient"][name], 1e-8);
        assert_eq!(by(name)["source"], "differences");
        assert!(by(name)["not_linear"].is_null());
    }
    let reach = number(&stroke["first_order"]["worst_case"][1]) - number(&stroke["middle"]);
    assert_close(&reach.into(), &wanted["linear_worst_case"], 1e-9);
    assert_close(
        &stroke["first_order"]["sigma"],
        &wanted["linear_sigma"],
        1e-9,
    );
    assert_close(
        &stroke["mean_shift"],
        &wanted["second_order_mean_shift"],
        1e-2,
    );
    for end in 0..2 {
        let runs = &stroke["worst_case_of_runs"][end];
        assert_close(runs, &wanted["exact_extremes"][end], 1e-12);
    }
    let samples = &stroke["distribution"];
    assert_close(&samples["mean"]["value"], &wanted["exact_mean"], 2e-6);
    assert_close(&samples["sigma"], &wanted["exact_sigma"], 5e-2);
    for (at, name) in ["crank", "rod", "offset"].iter().enumerate() {
        let [first, total] = ["first_index", "total_index"].map(|kind| &by(name)[kind]);
        for (own, wanted) in [
            (first, &wanted["sobol_first"]),
            (total, &wanted["sobol_total"]),
        ] {
            let wanted = number(&wanted[at]);
            let within = [0, 1].map(|end| number(&own["within"][end]));
            assert!(
                within[0] <= wanted && wanted <= within[1],
                "{name}: {own} {wanted}"
            );
        }
    }
    assert!(!by("rod")["first_at_most"].is_null());
    assert!(by("crank")["first_at_most"].is_null());
    let share = &found["yield"]["share"];
    let within = [0, 1].map(|end| number(&share["within"][end]));
    let exact = number(&wanted["yield"]);
    assert!(within[0] < exact && exact < within[1], "{share}");
    assert_eq!(found["yield"]["samples"], 256);
}

#[test]
fn an_offset_about_zero_is_told_not_to_be_linear() {
    let folder = tempfile::tempdir().unwrap();
    let path = scene(folder.path(), &slider_crank("0 mm"));
    let offset = "slide.position.slider_crank.offset=±3 mm";
    let output = dam(&[
        "tolerance",
        &path,
        "--tol",
        CRANK,
        "--tol",
        offset,
        "--figure",
        STROKE,
        "--samples",
        "0",
    ]);
    let text = String::from_utf8(output.stdout).unwrap();
    let text = text.split_whitespace().collect::<Vec<_>>().join(" ");
    assert!(text.contains("is not linear in the"), "{text}");
    assert!(text.contains("it is 0.02251 mm"), "{text}");
    assert!(
        text.contains("in the worst case of runs. First order does not hold"),
        "{text}"
    );
    let found = document(&[
        &path,
        "--tol",
        CRANK,
        "--tol",
        ROD,
        "--tol",
        offset,
        "--figure",
        STROKE,
        "--samples",
        "0",
    ]);
    let wanted = reference("stroke_in_line");
    let stroke = &found["figures"][STROKE];
    for end in 0..2 {
        let runs = &stroke["worst_case_of_runs"][end];
        assert_close(runs, &wanted["exact_extremes"][end], 1e-12);
    }
    assert_close(
        &stroke["mean_shift"],
        &wanted["second_order_mean_shift"],
        2e-3,
    );
    assert!(found["yield"].is_null() && stroke["distribution"].is_null());
}

#[test]
fn a_four_bar_is_that_of_the_reference() {
    let folder = tempfile::tempdir().unwrap();
    let path = scene(
        folder.path(),
        r#"{
    "dam": 1, "name": "Four-bar",
    "objects": {
        "shaft": { "kind": "drive", "motion": { "speed": "40 deg/s" } },
        "rocker": {
            "kind": "rocker", "input": "shaft", "masses": 0, "inertia": 1,
            "position": { "four_bar": { "crank": "40 mm", "coupler": "120 mm", "rocker": "80 mm", "frame": "100 mm" } }
        }
    },
    "run": { "duration": "1 s", "start": "on_law" }
}"#,
    );
    let wanted = reference("four_bar");
    let names = ["crank", "coupler", "rocker", "frame"];
    let tolerances = names.iter().zip(["0.02", "0.04", "0.04", "0.05"]);
    let tolerances: Vec<String> = tolerances
        .map(|(name, half)| format!("rocker.position.four_bar.{name}=±{half} mm"))
        .collect();
    let mut arguments = vec![
        path.as_str(),
        "--figure",
        "rocker.final.displacement",
        "--samples",
        "0",
    ];
    for one in &tolerances {
        arguments.extend(["--tol", one]);
    }
    let found = document(&arguments);
    let angle = &found["figures"]["rocker.final.displacement"];
    for name in names {
        let own = &angle["by"][format!("rocker.position.four_bar.{name}")]["derivative"];
        let name = if name == "frame" { "ground" } else { name };
        assert_close(own, &wanted["gradient"][name], 1e-7);
    }
    assert_close(
        &angle["first_order"]["sigma"],
        &wanted["linear_sigma_rad"],
        1e-8,
    );
    let reach = number(&angle["first_order"]["worst_case"][1]) - number(&angle["middle"]);
    assert_close(&reach.into(), &wanted["linear_worst_case_rad"], 1e-8);
}

#[test]
fn derivatives_of_elastic_objects_are_exact() {
    let found = document(&[
        "scenarios/rocker/two_masses.json",
        "--tol",
        "rocker.inertia=±0.01 %",
        "--figure",
        "rocker.delta_max",
        "--figure",
        "rocker.pair.separations",
        "--samples",
        "0",
    ]);
    let own = &found["figures"]["rocker.delta_max"]["by"]["rocker.inertia"];
    assert_eq!(own["source"], "exact");
    assert_close(&own["derivative"], &4.48636538940934.into(), 1e-8);
    // A number of separations has no stack, but it has values at the limits.
    let count = &found["figures"]["rocker.pair.separations"];
    assert!(count["first_order"].is_null());
    assert!(count["by"]["rocker.inertia"]["at_limits"]["upper"].is_number());
}

#[test]
fn files_are_the_same_bytes_on_any_number_of_threads() {
    let folder = tempfile::tempdir().unwrap();
    let path = scene(folder.path(), &slider_crank("20 mm"));
    let made = |threads: &str| {
        let out = folder.path().join(threads);
        let name = out.display().to_string();
        let arguments = [
            "tolerance",
            &path,
            "--tol",
            CRANK,
            "--tol",
            ROD,
            "--figure",
            STROKE,
            "--samples",
            "400",
            "--threads",
            threads,
            "--quiet",
            "--out",
            &name,
        ];
        assert!(dam(&arguments).status.success());
        ["samples.csv", "tolerance.json"]
            .map(|file| std::fs::read_to_string(out.join(file)).unwrap())
    };
    let [samples, json] = made("1");
    assert_eq!([samples.clone(), json], made("3"));
    assert_eq!(samples.lines().count(), 401);
    let head = samples.lines().next().unwrap();
    assert!(
        head.starts_with("slide.position.slider_crank.crank,") && head.ends_with("verdict,cause")
    );
}

#[test]
fn a_rod_that_cannot_follow_makes_failed_samples() {
    let folder = tempfile::tempdir().unwrap();
    // The crank turns as long as rod − crank is no less than the offset.
    let text = slider_crank("99.99 mm");
    let path = scene(folder.path(), &text);
    let rod = "slide.position.slider_crank.rod=±0.03 mm";
    let limit = format!("{STROKE} <= 1 m");
    let found = document(&[&path, "--tol", rod, "--limit", &limit, "--samples", "200"]);
    let failures = found["failures"].as_array().unwrap();
    let failed: u64 = failures
        .iter()
        .map(|one| one["count"].as_u64().unwrap())
        .sum();
    // A rod that is 0.01 mm too short by σ = 0.01 mm: 1 − Φ(1).
    assert!(
        (number(&failed.into()) / 200.0 - 0.1587).abs() < 0.03,
        "{found:#}"
    );
    assert!(
        failures[0]["cause"]
            .as_str()
            .is_some_and(|cause| !cause.is_empty())
    );
    assert_eq!(found["yield"]["good"], 200 - failed);
    assert_eq!(found["yield_without_failures"]["samples"], 200 - failed);
    assert_eq!(found["yield_without_failures"]["share"]["value"], 1.0);
}

#[test]
fn numbers_may_deviate_by_the_same() {
    let folder = tempfile::tempdir().unwrap();
    let path = scene(folder.path(), &slider_crank("20 mm"));
    let both = "slide.position.slider_crank.crank,slide.position.slider_crank.rod=±0.1 mm";
    let found = document(&[&path, "--tol", both, "--figure", STROKE, "--samples", "0"]);
    let by = found["figures"][STROKE]["by"].as_object().unwrap();
    let (_, own) = by.iter().next().unwrap();
    let gradient = &reference("stroke_offset")["gradient"];
    let wanted = number(&gradient["crank"]) + number(&gradient["rod"]);
    assert_close(&own["derivative"], &wanted.into(), 1e-8);
    assert_eq!(
        found["tolerances"][0]["nominal"].as_array().unwrap().len(),
        2
    );
}

#[test]
fn what_is_wrong_is_refused_all_at_once() {
    let folder = tempfile::tempdir().unwrap();
    let path = scene(folder.path(), &slider_crank("20 mm"));
    let text = errors(&[
        &path,
        "--tol",
        "slide.position.slider_crank.crank=0.05 mm",
        "--tol",
        "slide.position.slider_crank.rot=±1 mm",
        "--figure",
        "slide.no_such",
        "--limit",
        "kinematics.slide.slide.stroke = 100 mm",
        "--samples",
        "999999999",
    ]);
    for words in [
        "one limit",
        "no number `slide.position.slider_crank.rot`",
        "slide.no_such",
        "equality",
        "at most 131072",
    ] {
        assert!(text.contains(words), "{words}: {text}");
    }
    for (tolerance, words) in [
        (
            "slide.position.slider_crank.crank=±1 kg",
            "`kg` does not fit `slide.position.slider_crank.crank`: it is length",
        ),
        ("slide.inertia=h7", "lengths"),
        ("slide.masses=±1", "counts"),
        ("slide.position=±1", "a group of properties"),
        ("slide.position.slider_crank.crank=±1e-30", "too small"),
    ] {
        let text = errors(&[&path, "--tol", tolerance, "--figure", STROKE]);
        assert!(text.contains(words), "{tolerance}: {text}");
    }
    let text = errors(&[&path, "--tol", CRANK]);
    assert!(text.contains("no result is named"), "{text}");
    let text = errors(&[
        &path,
        "--tol",
        "slide.position.slider_crank.crank=+200 +150 mm",
        "--figure",
        STROKE,
    ]);
    assert!(text.contains("middle of the tolerances"), "{text}");
}

#[test]
fn levels_that_the_scene_leaves_open_are_chosen_first() {
    let folder = tempfile::tempdir().unwrap();
    let text = std::fs::read_to_string("scenarios/rocker/two_masses.json").unwrap();
    let mut open: Value = serde_json::from_str(&text).unwrap();
    open["objects"]["rocker"]["masses"] = "auto".into();
    open["run"]["accuracy"] = "5 %".into();
    open.as_object_mut().unwrap().remove("expect");
    let path = scene(folder.path(), &open.to_string());
    let found = document(&[
        &path,
        "--tol",
        "rocker.inertia=±1 %",
        "--figure",
        "rocker.delta_max",
        "--samples",
        "0",
    ]);
    let own = &found["figures"]["rocker.delta_max"];
    assert!(own["first_order"]["sigma"].as_f64().unwrap() > 0.0, "{own}");
}

/// At a nominal value of zero too a message shows the question, and no probe of it.
#[test]
fn a_wrong_unit_is_that_of_the_question() {
    let folder = tempfile::tempdir().unwrap();
    let path = scene(folder.path(), &slider_crank("0 mm"));
    let tolerance = "slide.position.slider_crank.offset=±0.1 rad";
    let text = errors(&[&path, "--tol", tolerance, "--figure", STROKE]);
    assert!(
        text.contains("does not fit") && !text.contains("0 rad"),
        "{text}"
    );
}

/// The scene holds the question; options go before its block.
#[test]
fn a_scene_holds_its_own_question() {
    let folder = tempfile::tempdir().unwrap();
    let block = format!(
        r#""tolerance": {{ "tol": ["{CRANK}", "{ROD}"], "figures": ["{STROKE}"], "limit": ["{STROKE} <= 102 mm"], "samples": 64, "seed": 3 }},
    "run""#
    );
    let text = slider_crank("20 mm").replace("\"run\"", &block);
    let path = scene(folder.path(), &text);
    let own = document(&[&path]);
    let plain = tempfile::tempdir().unwrap();
    let plain = scene(plain.path(), &slider_crank("20 mm"));
    let limit = format!("{STROKE} <= 102 mm");
    let named = document(&[
        &plain,
        "--tol",
        CRANK,
        "--tol",
        ROD,
        "--figures",
        STROKE,
        "--limit",
        &limit,
        "--samples",
        "64",
        "--seed",
        "3",
    ]);
    assert_eq!(own, named);
    let less = document(&[&path, "--samples", "0", "--tol", CRANK]);
    assert_eq!(less["figures"][STROKE]["by"].as_object().unwrap().len(), 1);
    assert_ne!(less["yield"], own["yield"]);
    assert!(errors(&[&plain]).contains("no tolerance is named"));
    let wrong = text.replace("\"seed\": 3", "\"seeds\": 3");
    let text = errors(&[&scene(folder.path(), &wrong)]);
    assert!(
        text.contains("seeds") && text.contains("scene.json"),
        "{text}"
    );
}
