//! Bad input of the kinds that people write: each is refused with its place, or runs soundly.

use std::process::{Command, Output};

const SCENE: &str = r#"{
  "dam": 1, "name": "t",
  "objects": {
    "shaft": { "kind": "drive", "motion": { "speed": "10 rev/s" } },
    "rocker": {
      "kind": "rocker", "input": "shaft",
      "position": { "sine": { "amplitude": 0.5 } },
      "inertia": 0.1, "stiffness": 1e6, "damping_capacity": 0.2, "masses": 1,
      "pair": { "closure": "force" },
      "loads": { "closing": { "constant": -600 } }
    }
  },
  "run": { "duration": 0.5 }
}
"#;

fn run(bytes: &[u8], form: &[&str]) -> Output {
    let folder = tempfile::tempdir().unwrap();
    let path = folder.path().join("scene.json");
    std::fs::write(&path, bytes).unwrap();
    let path = path.display().to_string();
    Command::new(env!("CARGO_BIN_EXE_dam"))
        .args(["run", &path, "--quiet", "--time-limit", "60"])
        .args(form)
        .output()
        .unwrap()
}

/// The scene with a part of its text in place of another.
fn with(old: &str, new: &str) -> String {
    assert!(SCENE.contains(old), "{old}");
    SCENE.replacen(old, new, 1)
}

fn with_motion(expression: &str) -> String {
    let motion = format!(r#"{{ "expression": "{expression}" }}"#);
    with(r#"{ "speed": "10 rev/s" }"#, &motion)
}

fn with_load(expression: &str) -> String {
    let load = format!(r#""x": {{ "expression": "{expression}", "unit": "N m" }}, "closing""#);
    with(r#""closing""#, &load)
}

fn with_table(points: &str) -> String {
    let table = format!(r#"{{ "table": {{ "points": {points} }} }}"#);
    with(r#"{ "sine": { "amplitude": 0.5 } }"#, &table)
}

fn with_name(name: &str) -> String {
    with(r#""rocker": {"#, &format!(r#""{name}": {{"#))
}

/// Refused with exit status 2: what is wrong, its line, and the text that is there.
#[track_caller]
fn refused(text: &str, words: &str, place: &str) {
    let output = run(text.as_bytes(), &[]);
    let error = String::from_utf8_lossy(&output.stderr).into_owned();
    assert_eq!(output.status.code(), Some(2), "{text}\n{error}");
    assert!(error.contains(words), "{words}:\n{error}");
    assert!(error.contains("scene.json:"), "{error}");
    let excerpt = error
        .lines()
        .any(|line| line.contains(" | ") && line.contains(place));
    assert!(excerpt, "{place}:\n{error}");
    assert!(
        !error.contains('\u{7}') && !error.contains('\u{1b}'),
        "{error:?}"
    );
}

/// Runs with exit status 0, and every figure is a number.
#[track_caller]
fn sound(text: &str) -> serde_json::Value {
    let output = run(text.as_bytes(), &["--json"]);
    let error = String::from_utf8_lossy(&output.stderr).into_owned();
    assert_eq!(output.status.code(), Some(0), "{text}\n{error}");
    let document: serde_json::Value = serde_json::from_slice(&output.stdout).unwrap();
    let rocker = &document["objects"]["rocker"];
    for figure in ["delta_abs", "peak_speed", "peak_reaction"] {
        assert!(rocker[figure].is_f64(), "{figure}: {rocker}");
    }
    document
}

#[test]
fn names_that_are_given_twice_are_refused() {
    let inertia = r#""inertia": 0.1, "inertia": 0.2"#;
    refused(
        &with(r#""inertia": 0.1"#, inertia),
        "given twice",
        "inertia",
    );
    refused(&with_name("shaft"), "`shaft` is given twice", "shaft");
}

#[test]
fn byte_order_marks_and_line_ends_of_windows_change_nothing() {
    let hash = |text: &str| sound(text)["hash"].clone();
    let plain = hash(SCENE);
    let windows = SCENE.replace('\n', "\r\n");
    assert_eq!(hash(&format!("\u{feff}{SCENE}")), plain);
    assert_eq!(hash(&windows), plain);
    let both = format!("\u{feff}{}", windows.replace("masses", "mases"));
    refused(&both, "unknown property `mases`", "mases");
    let output = run(both.as_bytes(), &[]);
    let error = String::from_utf8_lossy(&output.stderr).into_owned();
    assert!(error.contains("scene.json:8:"), "{error}");
}

#[test]
fn numbers_that_are_none_are_refused() {
    for number in ["NaN", "Infinity", "-Infinity", "0,1"] {
        let text = with(r#""inertia": 0.1"#, &format!(r#""inertia": {number}"#));
        refused(&text, "error[not-json]", "inertia");
    }
    for number in ["1e999", "-1e999", "\"1e999 kg m^2\"", "\"1e400\""] {
        let text = with(r#""inertia": 0.1"#, &format!(r#""inertia": {number}"#));
        refused(&text, "too large for a number", "inertia");
    }
    let comma = with(r#""inertia": 0.1"#, r#""inertia": "0,1 kg m^2""#);
    refused(&comma, "a decimal comma", "0,1 kg m^2");
    refused(&comma, "write a point: \"0.1 kg m^2\"", "0,1 kg m^2");
    refused(&with_load("2,5*t"), "`,` cannot stand here", "2,5*t");
}

#[test]
fn tables_without_sense_are_refused() {
    refused(&with_table("[]"), "`points` must have 3", "points");
    refused(&with_table("[[0, 0]]"), "`points` must have 3", "points");
    let back = "[[0, 0], [2, 0.1], [1, 0.2], [3, 0.3]]";
    refused(&with_table(back), "must ascend: 1 follows 2", "[1, 0.2]");
    let again = "[[0, 0], [1, 0.1], [1, 0.2], [3, 0.3]]";
    refused(&with_table(again), "must ascend: 1 follows 1", "[1, 0.2]");
    let open = r#"[[0, 0], [1, 0.1], [2, 0.2], ["360 deg", 0.3]], "periodic": true"#;
    refused(
        &with_table(open),
        "must come back to 0, found 0.3",
        "360 deg",
    );
}

#[test]
fn motions_without_a_value_are_refused_with_the_time() {
    for (expression, words) in [
        ("1/(t-0.25)", "no finite value at t = 0.25 s"),
        ("tan(10*t)", "no finite value at t = 0.15708 s"),
        ("sqrt(0.2-t)", "no finite value at t = 0.2 s"),
        ("log(0.3-t)", "no finite value at t = 0.3 s"),
        ("acos(1+t)", "at t = 0"),
        ("log(t-0.3)", "at t = 0"),
        ("(t-0.3)^0.5", "at t = 0"),
        ("t/0", "at t = 0"),
        ("0/0*t", "at t = 0"),
        ("sin(t)/t", "at t = 0"),
        ("exp(1e4*t)", "no finite value at t = 0.0709783 s"),
        ("t<0.2 ? t : t+0.5", "the displacement jumps at t = 0.2"),
        ("t<0.2 ? t : 2*t-0.2", "the speed jumps at t = 0.2"),
    ] {
        refused(&with_motion(expression), words, expression);
    }
}

#[test]
fn loads_without_a_value_are_refused() {
    for (expression, words) in [
        ("1/(t-0.25)", "no finite value at t = 0.25 s"),
        ("sqrt(0.2-t)", "no finite value at t = 0.2 s"),
        ("log(t-0.3)", "no finite value at t = 0 s"),
        ("1/0", "no finite value"),
        ("0/0", "no finite value"),
        ("(-2)^0.5", "no finite value"),
        ("sqrt(5*pi-driver_phi)", "no finite value at t = 0.25 s"),
        ("1/(driver_phi-5*pi)", "no finite value at t = 0.25 s"),
        ("log(0.3-t)-20*phi", "no finite value at t = 0.3 s"),
        (
            "sqrt(phi-10)",
            "no finite value at t = 0 where every object is on its law",
        ),
        (
            "log(phi)",
            "no finite value at t = 0 where every object is on its law",
        ),
    ] {
        refused(&with_load(expression), words, expression);
    }
    // Beyond the end of the run they may do as they like.
    sound(&with_load("1/(t-0.75)"));
    sound(&with_load("t<0.2 ? log(0.3-t) : 0"));
}

/// What only the motion tells ends the run, as a dead-centre position does.
#[test]
fn a_run_ends_where_a_load_has_no_value() {
    let text = with_load("sqrt(0.3-phi)");
    let output = run(text.as_bytes(), &["--json"]);
    assert_eq!(output.status.code(), Some(1));
    let document: serde_json::Value = serde_json::from_slice(&output.stdout).unwrap();
    assert_eq!(document["verdict"], "not_judged");
    assert_eq!(document["run"]["stopped"], "no_value");
    let because = document["run"]["stopped_because"].as_str().unwrap();
    for words in ["rocker.loads.x", "sqrt(0.3-phi)", "at t = 0.0", "phi = 0.3"] {
        assert!(because.contains(words), "{words}: {because}");
    }
    let expected = text.replace(
        r#""run": {"#,
        r#""expect": [{ "stops": "no_value", "time": 0.0102, "within": 0.001 }], "run": {"#,
    );
    let output = run(expected.as_bytes(), &[]);
    let error = String::from_utf8_lossy(&output.stderr).into_owned();
    assert_eq!(output.status.code(), Some(0), "{error}");
}

#[test]
fn masses_and_stiffnesses_at_the_ends_of_all_numbers() {
    let inertia = |value: &str| with(r#""inertia": 0.1"#, &format!(r#""inertia": {value}"#));
    refused(
        &inertia("0"),
        "must be greater than 0 for an elastic object",
        "inertia",
    );
    for subnormal in ["5e-324", "1e-310"] {
        refused(
            &inertia(subnormal),
            "no finite natural frequency",
            "stiffness",
        );
    }
    refused(&inertia("-0.1"), "must be at least 0", "inertia");
    let stiffness = |value: &str| with(r#""stiffness": 1e6"#, &format!(r#""stiffness": {value}"#));
    refused(&stiffness("0"), "must be greater than 0", "stiffness");
    refused(&stiffness("5e-324"), "no balance of loads and links", "run");
    // Twelve orders between two objects in series.
    let stiff = r#""behind": { "kind": "rocker", "input": "rocker", "position": { "ratio": 1 },
        "inertia": 1e-3, "stiffness": 1e18, "damping_capacity": 0.2, "masses": 1 }, "rocker""#;
    let document = sound(&with(r#""rocker""#, stiff));
    let [soft, behind] =
        ["rocker", "behind"].map(|id| document["objects"][id]["delta_abs"].as_f64().unwrap());
    assert!(behind < 1e-9 * soft, "{soft} {behind}");
}

#[test]
fn durations_of_nothing_are_refused_and_the_shortest_run() {
    let duration = |value: &str| with(r#""duration": 0.5"#, &format!(r#""duration": {value}"#));
    for none in ["0", "\"0 s\"", "-1", "-0.0"] {
        refused(&duration(none), "must be greater than 0", "duration");
    }
    refused(&duration("1e300"), "turns more than 10¹² times", "duration");
    refused(
        &duration("5e-324"),
        "`duration` (5e-324 s) is too short",
        "duration",
    );
    for short in ["2.220446049250313e-16", "1e-300"] {
        let document = sound(&duration(short));
        assert_eq!(document["run"]["complete"], true, "{short}");
        assert_eq!(
            document["run"]["time"].as_f64().unwrap(),
            short.parse::<f64>().unwrap()
        );
        assert_eq!(document["run"]["switches"], 0, "{short}");
    }
}

#[test]
fn names_with_dots_or_control_characters_are_refused() {
    for name in [
        "a.b",
        "a b",
        "",
        "a[0]",
        "ä",
        "a\\u0000b",
        "a\\nb",
        "\\u202e",
        "a\\u001b[31m",
    ] {
        refused(&with_name(name), "cannot be the id of an object", "{");
    }
    refused(&with_name("run"), "it addresses the scene itself", "run");
}

/// All that is wrong is said at once.
#[test]
fn several_mistakes_are_said_together() {
    let text = with(r#""inertia": 0.1"#, r#""inertia": "0,1 kg m^2""#)
        .replace("\"masses\": 1", "\"mases\": 1")
        .replace("\"duration\": 0.5", "\"duration\": 0");
    for (words, place) in [
        ("a decimal comma", "0,1"),
        ("unknown property `mases`", "mases"),
        ("must be greater than 0", "duration"),
        ("3 errors", "duration"),
    ] {
        refused(&text, words, place);
    }
}
