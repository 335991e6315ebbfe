//! First times of conditions, and runs that a condition ends, against closed forms.

use serde_json::{Value, json};
use std::f64::consts::PI;
use std::process::{Command, Output};

/// A mass of 1 kg·m² on 10⁴ N·m/rad, let go at 0.01 rad: φ = 0.01·cos(100·t).
fn swinging(run: &Value) -> Value {
    json!({
        "dam": 1, "name": "t",
        "objects": {
            "shaft": { "kind": "drive", "motion": { "expression": "0*t" } },
            "rocker": {
                "kind": "rocker", "input": "shaft", "position": { "ratio": 1 },
                "inertia": 1, "stiffness": 1e4, "damping_capacity": 0, "masses": 1
            }
        },
        "run": run
    })
}

fn run_of(more: &Value) -> Value {
    let mut run = json!({
        "duration": 0.2, "tolerance": 1e-9,
        "start": { "rocker": { "displacement": [0.01], "speed": [0] } }
    });
    for (name, value) in more.as_object().unwrap() {
        run[name] = value.clone();
    }
    run
}

/// A condition on the rocker.
fn of(condition: &str) -> Value {
    json!({ "of": "rocker", "condition": condition })
}

fn dam(command: &str, scene: &Value, options: &[&str]) -> Output {
    let folder = tempfile::tempdir().unwrap();
    let path = folder.path().join("scene.json");
    std::fs::write(&path, serde_json::to_string_pretty(scene).unwrap()).unwrap();
    Command::new(env!("CARGO_BIN_EXE_dam"))
        .args([command, &path.display().to_string(), "--quiet"])
        .args(options)
        .output()
        .unwrap()
}

#[track_caller]
fn document(command: &str, scene: &Value, options: &[&str]) -> Value {
    let options: Vec<&str> = options.iter().copied().chain(["--json"]).collect();
    let output = dam(command, scene, &options);
    let error = String::from_utf8_lossy(&output.stderr).into_owned();
    assert_eq!(output.status.code(), Some(0), "{error}");
    serde_json::from_slice(&output.stdout).unwrap()
}

#[track_caller]
fn near(found: &Value, wanted: f64, within: f64) {
    let found = found.as_f64().unwrap_or_else(|| panic!("{found}"));
    assert!((found - wanted).abs() <= within, "{found} for {wanted}");
}

#[test]
fn every_method_ends_where_the_condition_first_holds() {
    // φ < 0.005 from 100·t = π/3 on.
    let wanted = PI / 300.0;
    for (method, within) in [
        ("exact", 1e-14),
        ("auto", 1e-12),
        ("taylor", 1e-9),
        ("radau", 1e-9),
        ("rodas5p", 1e-8),
        ("dop853", 1e-9),
        ("dopri5", 1e-8),
        ("rk4", 1e-8),
    ] {
        let mut run = run_of(&json!({ "until": of("phi < 0.005"), "method": method }));
        if method == "rk4" {
            run["step"] = json!(2e-5);
        }
        let found = document("run", &swinging(&run), &[]);
        near(&found["run"]["time"], wanted, within);
        near(&found["run"]["first_times"]["until"], wanted, within);
        assert_eq!(found["run"]["complete"], true, "{method}");
        near(
            &found["objects"]["rocker"]["final"]["displacement"],
            0.005,
            1e-8,
        );
        let speed = -(PI / 3.0).sin();
        near(&found["objects"]["rocker"]["final"]["speed"], speed, 1e-6);
        near(&found["objects"]["rocker"]["peak_speed"], -speed, 1e-6);
    }
}

#[test]
fn conditions_of_all_signals_have_first_times() {
    let run = run_of(&json!({ "first_times": {
        "half": of("phi < 0.005"),
        "fast": of("abs(phi_dot) > 0.5"),
        "slow_again": of("t > 0.02 && abs(phi_dot) < 0.5"),
        "braked": of("acceleration > 50"),
        "pulled": of("reaction < 0"),
        "deflected": of("delta < -0.009"),
        "at_once": of("phi > 0.001"),
        "later": of("t > 0.123"),
        "never": of("phi > 0.02"),
        "of_the_shaft": { "of": "shaft", "condition": "phi > 1" }
    } }));
    let found = document("run", &swinging(&run), &[]);
    let times = &found["run"]["first_times"];
    // φ̇ = −sin, φ̈ = −100·cos, F = 100·cos of 100·t.
    near(&times["half"], PI / 300.0, 1e-12);
    near(&times["fast"], PI / 600.0, 1e-12);
    near(&times["slow_again"], 5.0 * PI / 600.0, 1e-12);
    near(&times["braked"], 2.0 * PI / 300.0, 1e-12);
    near(&times["pulled"], PI / 200.0, 1e-12);
    near(&times["deflected"], (PI - 0.9f64.acos()) / 100.0, 1e-12);
    near(&times["at_once"], 0.0, 0.0);
    near(&times["later"], 0.123, 1e-15);
    assert_eq!(times["never"], Value::Null);
    assert_eq!(times["of_the_shaft"], Value::Null);
    near(&found["run"]["time"], 0.2, 1e-15);
    let text = dam("run", &swinging(&run), &[]);
    let text = String::from_utf8(text.stdout).unwrap();
    for line in ["first time, half", "first time, never"] {
        assert!(text.contains(line), "{text}");
    }
    assert!(
        text.contains("10.4719755 ms") && text.contains("never"),
        "{text}"
    );
}

/// They are figures of `expect`, `compare` and `map` like any other.
#[test]
fn first_times_are_expected_compared_and_mapped() {
    let run = run_of(&json!({ "first_times": { "half": of("phi < 0.005") } }));
    let mut scene = swinging(&run);
    let wanted = PI / 300.0;
    let expect = |figure: &str| json!([{ "figure": figure, "value": wanted, "within": "0.01 %" }]);
    scene["expect"] = expect("run.first_times.half");
    let found = document("run", &scene, &[]);
    assert_eq!(found["run"]["complete"], true);
    scene["expect"] = expect("run.first_times.halve");
    let output = dam("run", &scene, &[]);
    let error = String::from_utf8_lossy(&output.stderr).into_owned();
    assert_eq!(output.status.code(), Some(2), "{error}");
    assert!(
        error.contains("did you mean `run.first_times.half`"),
        "{error}"
    );
    scene["expect"] = json!([]);
    // √2 times as stiff, √2 times as fast.
    let over = "rocker.stiffness=10000,20000";
    let found = document("compare", &scene, &["--over", over]);
    let rows = found["rows"]
        .as_array()
        .or(found["table"]["rows"].as_array());
    let row = rows.unwrap().iter();
    let mut row = row.filter(|row| row["figure"] == "run.first_times.half");
    let row = row.next().unwrap_or_else(|| panic!("{found}"));
    assert_eq!(row["unit"], "s");
    near(&row["values"][0], wanted, 1e-12);
    near(&row["values"][1], wanted / 2f64.sqrt(), 1e-12);
    let figure = "run.first_times.half";
    let axis = "rocker.stiffness=10000:20000:2";
    let found = document("map", &scene, &["--x", axis, "--figure", figure]);
    let values = &found["panels"][0]["values"];
    near(&values[0], wanted, 1e-12);
    near(&values[1], wanted / 2f64.sqrt(), 1e-12);
    let accuracy = format!("{figure}=1 %");
    let output = dam("run", &scene, &["--accuracy", &accuracy, "--json"]);
    assert_eq!(output.status.code(), Some(1));
    let found: Value = serde_json::from_slice(&output.stdout).unwrap();
    let accuracy = &found["accuracy"][figure];
    near(&accuracy["value"], wanted, 1e-9);
    assert_eq!(accuracy["unit"], "s");
    // One mass in place of a continuum: the error is stated, and it is that of the model.
    assert_eq!(accuracy["holds"], false, "{accuracy}");
    let limit = accuracy["limit"].as_f64().unwrap();
    let off = accuracy["error"].as_f64().unwrap();
    assert!(
        (limit - wanted).abs() <= off && off < 0.3 * wanted,
        "{accuracy}"
    );
    near(&accuracy["shares"]["integration"], 0.0, 1e-9);
}

#[test]
fn what_is_no_condition_is_refused_with_its_place() {
    for (until, words) in [
        (of("phi"), "compares nothing"),
        (of("phi - 0.3"), "compares nothing"),
        (of("phi == 0.3"), "`==` of what changes continuously"),
        (of("psi > 0.3"), "`psi` is not known"),
        (of("phi > 0,3"), "`,` cannot stand here"),
        (
            json!({ "of": "rokker", "condition": "phi > 1" }),
            "unknown object `rokker`",
        ),
        (json!({ "of": "rocker" }), "condition"),
        (of("phi > 0.001"), "holds at t = 0 already"),
    ] {
        let scene = swinging(&run_of(&json!({ "until": until })));
        let output = dam("run", &scene, &[]);
        let error = String::from_utf8_lossy(&output.stderr).into_owned();
        assert_eq!(output.status.code(), Some(2), "{until}: {error}");
        assert!(error.contains(words), "{words}: {error}");
        assert!(error.contains("scene.json:"), "{error}");
    }
    let run = run_of(&json!({ "first_times": { "until": of("phi > 1") } }));
    let output = dam("run", &swinging(&run), &[]);
    let error = String::from_utf8_lossy(&output.stderr).into_owned();
    assert_eq!(output.status.code(), Some(2), "{error}");
    assert!(error.contains("condition that ends the run"), "{error}");
}

/// A condition that never holds leaves the run as long as it is.
#[test]
fn a_run_whose_condition_never_holds_goes_to_its_end() {
    let run = run_of(&json!({ "until": of("phi > 0.02") }));
    let found = document("run", &swinging(&run), &[]);
    near(&found["run"]["time"], 0.2, 1e-15);
    assert_eq!(found["run"]["first_times"]["until"], Value::Null);
}
