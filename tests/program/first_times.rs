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
        text.contains("10.47 ms") && text.contains("never"),
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

const METHODS: [&str; 5] = ["exact", "auto", "taylor", "dop853", "radau"];

/// Conditions that hold for much less than a step: between two times, between two angles,
/// at the crests of a vibration of the time or of the motion.
#[test]
fn conditions_that_hold_briefly_are_met_by_every_method() {
    let crest = |share: f64| share.acos() / 100.0;
    let wanted = [
        ("t > 0.05001 && t < 0.05002", 0.05001),
        ("t > 0.1 && t < 0.1 + 1e-11", 0.1),
        ("phi < 0.002 && phi > 0.0019999", crest(0.2)),
        (
            "phi > 0.002 && phi_dot > 0 && phi < 0.0020001",
            2.0 * PI / 100.0 - crest(0.2),
        ),
        ("sin(1e4*t) > 0.9999", 0.9999f64.asin() / 1e4),
        ("abs(phi + 0.01) < 1e-8", crest(-1.0 + 1e-6)),
        (
            "t > 0.03 && reaction > 99.9999",
            2.0 * PI / 100.0 - crest(0.999999),
        ),
        ("phi_dot^2 > 0.999999", 0.999999f64.sqrt().asin() / 100.0),
        ("min(t - 0.0701, 0.07011 - t) > 0", 0.0701),
        ("t > 0.15 && floor(1e5*t) == 15003", 0.15003),
        ("acceleration > 0 && delta > -1e-8", PI / 200.0),
        ("sqrt(t - 0.19) < 1e-5 && t > 0.1", 0.19),
        ("sin(1e6*t) + 10*phi > 1.1001", f64::NAN),
        ("phi > 0.01 + 1e-9", f64::NAN),
        ("phi_dot > 1 + 1e-7 || phi*phi_dot > 0.0050001", f64::NAN),
    ];
    for method in METHODS {
        let times = wanted.iter().enumerate();
        let times = times.map(|(place, (condition, _))| (format!("c{place}"), of(condition)));
        let times: serde_json::Map<String, Value> = times.collect();
        let run = run_of(&json!({ "first_times": times, "method": method, "tolerance": 1e-11 }));
        let found = document("run", &swinging(&run), &[]);
        for (place, (condition, wanted)) in wanted.iter().enumerate() {
            let time = &found["run"]["first_times"][format!("c{place}")];
            match wanted.is_nan() {
                true => assert_eq!(*time, Value::Null, "{method}: {condition}"),
                false => {
                    let time = time
                        .as_f64()
                        .unwrap_or_else(|| panic!("{method}: {condition}"));
                    assert!(
                        (time - wanted).abs() < 2e-8,
                        "{method}: {condition}: {time} {wanted}"
                    );
                }
            }
        }
        assert!(
            found["run"]["undetermined_times"].is_null(),
            "{method}: {found}"
        );
        assert_eq!(found["warnings"], json!([]), "{method}");
    }
}

#[test]
fn a_brief_condition_ends_the_run_by_every_method() {
    for method in METHODS {
        let until = of("phi < 0.002 && phi > 0.0019999");
        let run = run_of(&json!({ "until": until, "method": method }));
        let found = document("run", &swinging(&run), &[]);
        near(&found["run"]["time"], 0.2f64.acos() / 100.0, 1e-9);
        near(
            &found["objects"]["rocker"]["final"]["displacement"],
            0.002,
            1e-9,
        );
    }
}

/// φ̇² + 10⁴·φ² is 1 at all times: whether it is above 1 is a matter of rounding.
#[test]
fn a_condition_that_stays_on_its_edge_is_not_called_never() {
    let edge = "phi_dot^2 + 1e4*phi^2 > 1 + 1e-13";
    for method in ["exact", "dop853"] {
        let run = run_of(&json!({
            "first_times": { "edge": of(edge), "later": of("phi < 0.005") }, "method": method
        }));
        let found = document("run", &swinging(&run), &[]);
        let since = found["run"]["undetermined_times"]["edge"].as_f64().unwrap();
        assert!((0.0..0.2).contains(&since), "{found}");
        assert!(found["run"]["undetermined_times"]["later"].is_null());
        near(&found["run"]["first_times"]["later"], PI / 300.0, 1e-9);
        let warnings = found["warnings"].to_string();
        assert!(warnings.contains("`edge` is not determined"), "{warnings}");
        let text = dam("run", &swinging(&run), &[]);
        let text = String::from_utf8(text.stdout).unwrap();
        let line = text.lines().find(|line| line.contains("first time, edge"));
        assert!(line.unwrap().contains("not determined"), "{text}");
    }
}

#[test]
fn what_stays_exactly_on_its_edge_never_holds() {
    // The shaft rests at 0.
    let shaft = |condition: &str| json!({ "of": "shaft", "condition": condition });
    let run = run_of(&json!({ "first_times": {
        "turned": shaft("phi > 0"), "back": shaft("phi_dot < 0 || phi < 0"), "at": shaft("phi >= 0")
    } }));
    let found = document("run", &swinging(&run), &[]);
    let times = &found["run"]["first_times"];
    assert_eq!(
        (&times["turned"], &times["back"]),
        (&Value::Null, &Value::Null)
    );
    near(&times["at"], 0.0, 0.0);
    assert!(found["run"]["undetermined_times"].is_null());
}

#[test]
fn a_window_behind_the_end_of_the_run_is_reported_as_that() {
    for (window, words) in [
        (
            [0.1, 0.15],
            "the window from 0.1 to 0.15 s lies beyond the end of the run at 0.05 s",
        ),
        (
            [0.03, 0.15],
            "the window from 0.03 to 0.15 s reaches beyond the end of the run at 0.05 s",
        ),
    ] {
        let run = run_of(&json!({ "until": of("t > 0.05"), "window": window }));
        let found = document("run", &swinging(&run), &[]);
        assert_eq!(found["run"]["window"], Value::Null);
        assert_eq!(found["run"]["window_missing"], words);
    }
    let run = run_of(&json!({ "until": of("t > 0.05"), "window": [0.01, 0.04] }));
    let found = document("run", &swinging(&run), &[]);
    assert_eq!(found["run"]["window"], json!([0.01, 0.04]));
}
