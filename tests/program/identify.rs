//! `dam identify` as a program: a free decay beside its reference, its files, records that it
//! refuses, and numbers that a record does not determine.

use serde_json::Value;
use std::path::Path;
use std::process::{Command, Output};

fn dam(arguments: &[&str]) -> Output {
    Command::new(env!("CARGO_BIN_EXE_dam"))
        .arg("identify")
        .args(arguments)
        .current_dir(env!("CARGO_MANIFEST_DIR"))
        .output()
        .unwrap()
}

fn document(arguments: &[&str], status: i32) -> Value {
    let output = dam(&[arguments, &["--json"]].concat());
    let errors = String::from_utf8_lossy(&output.stderr).into_owned();
    assert_eq!(
        output.status.code(),
        Some(status),
        "{arguments:?}: {errors}"
    );
    serde_json::from_slice(&output.stdout).unwrap()
}

/// Text in one line, without the frame of a message.
fn in_a_line(bytes: &[u8]) -> String {
    let text = String::from_utf8_lossy(bytes);
    text.split_whitespace().collect::<Vec<_>>().join(" ")
}

fn errors(arguments: &[&str]) -> String {
    let output = dam(arguments);
    assert_eq!(output.status.code(), Some(2), "{arguments:?}");
    in_a_line(&output.stderr)
}

fn number(value: &Value) -> f64 {
    match value {
        Value::String(text) => text.parse().unwrap(),
        other => other.as_f64().unwrap(),
    }
}

/// `tests/reference/design-optimum-tolerance.json`.
fn reference() -> Value {
    let text = std::fs::read_to_string("tests/reference/design-optimum-tolerance.json").unwrap();
    serde_json::from_str::<Value>(&text).unwrap()["identify"].clone()
}

const SCENE: &str = r#"{
    "dam": 1, "name": "Free decay",
    "objects": {
        "drive": { "kind": "drive", "motion": { "speed": "1 rad/s" } },
        "wheel": { "kind": "shaft", "input": "drive", "inertia": 0.1, "stiffness": "9 MN m/rad", "damping_capacity": 0.2 }
    },
    "run": { "duration": 0.01, "start": { "wheel": { "displacement": [0.001], "speed": [1] } } }
}"#;

/// The record of the reference, times in ms and angles in µrad.
fn record() -> String {
    let decay = |time: f64| {
        let natural = 1e4;
        let share = 0.4 / (2.0 * std::f64::consts::TAU);
        let own = natural * f64::sqrt(1.0 - share * share);
        let slow = f64::exp(-share * natural * time);
        1e-3 * slow * ((own * time).cos() + share * natural / own * (own * time).sin())
    };
    let row = |at: i32| {
        let time = f64::from(at) * 2e-5;
        let value = decay(time) + 1e-6 * f64::from(at * at).sin();
        format!("{:?};{:?}\n", time * 1e3, value * 1e6)
    };
    let rows: String = (1..=200).map(row).collect();
    format!("t [ms];x [µrad]\n{rows}")
}

fn write(folder: &Path, name: &str, text: &str) -> String {
    let path = folder.join(name);
    std::fs::write(&path, text).unwrap();
    path.display().to_string()
}

const SOUGHT: [&str; 6] = [
    "--match",
    "x=wheel.delta",
    "--vary",
    "wheel.stiffness=2:30 MN m/rad",
    "--vary",
    "wheel.damping_capacity=0:1",
];

#[test]
fn a_free_decay_is_that_of_the_reference() {
    let folder = tempfile::tempdir().unwrap();
    let scene = write(folder.path(), "scene.json", SCENE);
    let record = write(folder.path(), "test.csv", &record());
    let out = folder.path().join("out").display().to_string();
    let arguments = [
        &[
            scene.as_str(),
            "--record",
            &record,
            "--starts",
            "4",
            "--out",
            &out,
        ],
        &SOUGHT[..],
    ]
    .concat();
    let found = document(&arguments, 0);
    let wanted = reference();
    let sizes = [("stiffness", 1e6), ("damping_capacity", 1.0)];
    for (at, (name, size)) in sizes.into_iter().enumerate() {
        let own = &found["estimates"][at];
        let value = number(&own["value"]) * size / number(&wanted["estimate"][name]) - 1.0;
        assert!(value.abs() < 1e-8, "{own}");
        let error =
            number(&own["standard_error"]) * size / number(&wanted["standard_errors"][name]);
        assert!((error - 1.0).abs() < 1e-5, "{own}");
        assert_eq!(own["determined"], true);
    }
    assert_eq!(found["answered"], true);
    // The settings and the scene that is written are the estimates.
    let stiffness = number(&found["estimates"][0]["value"]);
    let setting = format!("wheel.stiffness={stiffness:?} MN m/rad");
    assert_eq!(found["settings"][0], setting.as_str());
    let written = std::fs::read_to_string(format!("{out}/identified.json")).unwrap();
    assert!(written.contains(&format!("{stiffness:?}")), "{written}");
    let rows = std::fs::read_to_string(format!("{out}/fit.csv")).unwrap();
    assert_eq!(rows.lines().count(), 201);
    let page = std::fs::read_to_string(format!("{out}/report.html")).unwrap();
    assert!(page.contains("Residuals: fit less record"));
    let answer = std::fs::read_to_string(format!("{out}/identification.json")).unwrap();
    assert_eq!(serde_json::from_str::<Value>(&answer).unwrap(), found);
}

#[test]
fn what_a_record_does_not_determine_has_a_direction_and_no_number() {
    let folder = tempfile::tempdir().unwrap();
    let scene = write(folder.path(), "scene.json", SCENE);
    let record = write(folder.path(), "test.csv", &record());
    let arguments = [
        &[scene.as_str(), "--record", &record, "--starts", "2"],
        &SOUGHT[..],
        &["--vary", "wheel.inertia=0.05:0.3"],
    ]
    .concat();
    let output = dam(&arguments);
    assert_eq!(output.status.code(), Some(1));
    let text = in_a_line(&output.stdout);
    assert!(
        text.contains("The record does not determine stiffness"),
        "{text}"
    );
    assert!(
        text.contains("These changes together leave the fit as it is"),
        "{text}"
    );
    let found = document(&arguments, 1);
    assert!(found["estimates"][0]["value"].is_null() && found["estimates"][2]["value"].is_null());
    assert_eq!(found["open_directions"][0].as_array().unwrap().len(), 2);
    assert_eq!(found["settings"].as_array().unwrap().len(), 0);
}

#[test]
fn records_that_are_wrong_are_refused_with_their_place() {
    let folder = tempfile::tempdir().unwrap();
    let scene = write(folder.path(), "scene.json", SCENE);
    let refused = |text: &str| {
        let record = write(folder.path(), "bad.csv", text);
        errors(&[&[scene.as_str(), "--record", &record], &SOUGHT[..]].concat())
    };
    for (text, parts) in [
        ("t [s],y [rad]\n0,1\n", &["no column `x`", "bad.csv:1"][..]),
        (
            "t [s],x [mm]\n0,1\n",
            &["column `x` has the wrong unit", "bad.csv:1"],
        ),
        (
            "t [mm],x [mm]\n0,1\n",
            &[
                "column `t` has the wrong unit",
                "column `x` has the wrong unit",
            ],
        ),
        (
            "t [s],x [rad]\n0,1\n1,NaN\n",
            &["`NaN` is not a number", "bad.csv:3"],
        ),
        ("t [s],x [rad]\n0,1\n1,\n", &["no number here", "bad.csv:3"]),
        ("t [s],x [rad]\n0,1\n1,1e999\n", &["too large"]),
        (
            "t [s],x [rad]\n0,1\n2,1\n1,1\n2,3\n",
            &["not later than the one before", "bad.csv:4"],
        ),
        ("t [s],x [rad]\n-1,1\n1,1\n", &["below 0", "bad.csv:2"]),
        ("t [s],x [rad]\n0,1\n", &["no row after the start"]),
        (
            "t [s],x [rad]\n1e-3,1\n2e-3,1\n",
            &["have 2 values in all", "more rows"],
        ),
        ("t [s],x [rad]\n", &["no rows"]),
        ("", &["empty"]),
    ] {
        let found = refused(text);
        for part in parts {
            assert!(found.contains(part), "{text:?}: {part}: {found}");
        }
    }
}

#[test]
fn all_faults_of_several_records_are_named() {
    let folder = tempfile::tempdir().unwrap();
    let scene = write(folder.path(), "scene.json", SCENE);
    let one = write(folder.path(), "one.csv", "t [s],x [rad]\n0,1\n0,2\n");
    let two = write(folder.path(), "two.csv", "t [s],z [rad]\n0,1\n");
    let found = errors(
        &[
            &[scene.as_str(), "--record", &one, "--record", &two],
            &SOUGHT[..],
        ]
        .concat(),
    );
    assert!(
        found.contains("one.csv:3") && found.contains("two.csv:1"),
        "{found}"
    );
    let absent = errors(&[&[scene.as_str(), "--record", "no/such.csv"], &SOUGHT[..]].concat());
    assert!(absent.contains("cannot read `no/such.csv`"), "{absent}");
    let good = write(folder.path(), "good.csv", &record());
    let sets = format!("{good}; wheel.stiffness=1e6; wheel.mass=1 kg");
    let found = errors(&[&[scene.as_str(), "--record", &sets], &SOUGHT[..]].concat());
    assert!(
        found.contains("sets `wheel.stiffness`, which is sought"),
        "{found}"
    );
}

#[test]
fn questions_that_are_wrong_are_refused() {
    let folder = tempfile::tempdir().unwrap();
    let scene = write(folder.path(), "scene.json", SCENE);
    let record = write(folder.path(), "test.csv", &record());
    let refused = |more: &[&str]| {
        errors(&[&[scene.as_str(), "--record", &record], &SOUGHT[..], more].concat())
    };
    for (more, part) in [
        (&["--vary", "wheel.masses=1:3"][..], "counts"),
        (&["--vary", "wheel.inertia=1:2 mm"], "unit"),
        (&["--vary", "wheel.inertia=2:1"], "lesser"),
        (&["--vary", "wheel.stiffness=1:2 MN m/rad"], "twice"),
        (&["--match", "x=wheel.speed"], "twice"),
        (&["--match", "y=wheel.spede"], "wheel.speed"),
        (&["--match", "x2=wheel.speed"], "weighed"),
        (&["--sigma", "x=1 mm"], "rad"),
        (&["--sigma", "x=0 rad"], "greater than 0"),
        (&["--sigma", "q=1 rad"], "no column"),
        (&["--starts", "0"], "1 to 1000"),
    ] {
        let found = refused(more);
        assert!(found.contains(part), "{more:?}: {part}: {found}");
    }
}

/// What is known when the time is over is kept.
#[test]
fn an_end_from_outside_keeps_what_is_done() {
    let folder = tempfile::tempdir().unwrap();
    let scene = write(folder.path(), "scene.json", SCENE);
    let record = write(folder.path(), "test.csv", &record());
    let arguments = [
        &[scene.as_str(), "--record", &record, "--starts", "1000"],
        &SOUGHT[..],
        &["--time-limit", "2", "--json"],
    ]
    .concat();
    let output = dam(&arguments);
    let found: Value = serde_json::from_slice(&output.stdout).unwrap();
    assert_eq!(found["complete"], false);
    assert_eq!(found["starts_requested"], 1000);
    let starts = found["starts"].as_array().unwrap();
    assert!(!starts.is_empty() && starts.len() < 1000);
    assert_ne!(output.status.code(), Some(0));
}

/// A record of the free decay with other values at each time.
fn record_of(value: &dyn Fn(usize, f64) -> f64) -> String {
    let decay = |time: f64| {
        let share = 0.4 / (2.0 * std::f64::consts::TAU);
        let own = 1e4 * f64::sqrt(1.0 - share * share);
        let slow = f64::exp(-share * 1e4 * time);
        1e-3 * slow * ((own * time).cos() + share * 1e4 / own * (own * time).sin())
    };
    let row = |at: usize| {
        let time = at as f64 * 2e-5;
        format!("{time:?},{:?}\n", value(at, decay(time)))
    };
    format!("t [s],x [rad]\n{}", (0..=200).map(row).collect::<String>())
}

fn noise(at: usize) -> f64 {
    1e-6 * ((at * at) as f64).sin()
}

/// The answer to a record, with its text; `status`: exit status.
fn asked(record: &str, more: &[&str], status: i32) -> (Value, String) {
    let folder = tempfile::tempdir().unwrap();
    let scene = write(folder.path(), "scene.json", SCENE);
    let record = write(folder.path(), "test.csv", record);
    let arguments = [&[scene.as_str(), "--record", &record], &SOUGHT[..], more].concat();
    let text = in_a_line(&dam(&arguments).stdout);
    (document(&arguments, status), text)
}

/// Records that no values of the numbers explain have least squares too: they are no answer.
#[test]
fn a_fit_that_does_not_explain_the_record_is_no_answer() {
    let time = |at: usize| at as f64 * 2e-5;
    let wave = |at: usize| 1e-3 * (2.0e4 * time(at)).cos();
    let reversed = record_of(&|_, own| own);
    let reversed: Vec<&str> = reversed.lines().collect();
    let turned = reversed[1..].iter().enumerate().map(|(at, _)| {
        let value = reversed[reversed.len() - 1 - at].split(',').nth(1).unwrap();
        format!("{:?},{value}\n", time(at))
    });
    let turned = format!("{}\n{}", reversed[0], turned.collect::<String>());
    for (name, record) in [
        ("another wave", record_of(&|at, _| wave(at))),
        ("a wrong unit", record_of(&|at, own| 1e3 * own + noise(at))),
        ("a zero", record_of(&|at, own| own + 5e-4 + noise(at))),
        ("a constant", record_of(&|_, _| 1e-3)),
        ("reversed", turned),
    ] {
        let (found, text) = asked(&record, &["--starts", "3"], 1);
        assert_eq!(found["answered"], false, "{name}");
        assert_eq!(found["misfit"]["cause"], "unexplained", "{name}: {text}");
        assert!(
            text.contains("The fit does not explain the record"),
            "{name}: {text}"
        );
        for own in found["estimates"].as_array().unwrap() {
            assert!(
                own["value"].is_null() && own["standing"] == "misfit",
                "{name}: {own}"
            );
        }
        assert_eq!(found["settings"].as_array().unwrap().len(), 0, "{name}");
    }
}

/// A stated standard deviation is held against the residuals by χ².
#[test]
fn residuals_are_held_against_a_stated_error() {
    let record = record_of(&|at, own| own + noise(at));
    let (found, text) = asked(&record, &["--starts", "2", "--sigma", "x=0.7 µrad"], 0);
    // Σ sin² of 201 rows over 0.49.
    let chi = &found["chi_squared"];
    assert!(
        (number(&chi["value"]) / (201.0 * 0.5 / 0.49) - 1.0).abs() < 0.05,
        "{chi}"
    );
    assert_eq!(number(&chi["degrees"]), 199.0);
    assert!(number(&chi["probability"]) > 0.1, "{chi}");
    assert!(text.contains("residuals over σ"), "{text}");
    let (found, text) = asked(&record, &["--starts", "2", "--sigma", "x=0.1 µrad"], 1);
    assert_eq!(found["misfit"]["cause"], "above_sigma");
    assert!(number(&found["chi_squared"]["probability"]) < 1e-10);
    assert!(
        text.contains("times its σ") && !text.contains("(±"),
        "{text}"
    );
    // A little more than stated is said, and the errors are those of the residuals.
    let (found, text) = asked(&record, &["--starts", "2", "--sigma", "x=0.55 µrad"], 0);
    assert!(
        found["misfit"].is_null() && text.contains("times the stated σ"),
        "{text}"
    );
    // Without σ residuals have their unit.
    let (found, text) = asked(&record, &["--starts", "2"], 0);
    assert!(found["chi_squared"].is_null() && found["signals"][0]["sigma"].is_null());
    assert!(
        !text.contains("over σ") && text.contains("697 nrad"),
        "{text}"
    );
}

/// Small errors of the model leave an estimate, without a standard error in the headline.
#[test]
fn residuals_that_are_not_random_take_the_error_from_the_headline() {
    let slow = |at: usize| 2e-5 * (at as f64 / 30.0).sin();
    let (found, text) = asked(&record_of(&|at, own| own + slow(at)), &["--starts", "2"], 0);
    assert_eq!(found["answered"], true);
    assert_eq!(found["signals"][0]["random"], false);
    assert!(
        text.contains("The model has errors") && !text.contains("(±"),
        "{text}"
    );
}

#[test]
fn rows_that_stand_out_are_named() {
    let record = record_of(&|at, own| own + noise(at) + if at == 77 { 9e-5 } else { 0.0 });
    let (found, text) = asked(&record, &["--starts", "2"], 0);
    assert_eq!(found["signals"][0]["outliers"].as_array().unwrap().len(), 1);
    assert!(
        text.contains("1 row of `x` in") && text.contains("1.54 ms"),
        "{text}"
    );
}

/// A record without errors is known to what runs are known to, and no better.
#[test]
fn an_exact_record_has_the_errors_of_runs() {
    let (found, text) = asked(&record_of(&|_, own| own), &["--starts", "3"], 0);
    let own = &found["estimates"][0];
    assert!((number(&own["value"]) - 10.0).abs() < 1e-9, "{own}");
    assert!(number(&own["standard_error"]) > 1e-14, "{own}");
    assert!(found["signals"][0]["random"].is_null());
    assert!(text.contains("3 starts of 3 ended there"), "{text}");
}

/// One start cannot show that no other minimum fits better.
#[test]
fn one_start_is_not_confirmed() {
    let record = record_of(&|at, own| own + noise(at));
    let (_, text) = asked(&record, &["--starts", "1"], 0);
    assert!(text.contains("No other start confirms it"), "{text}");
}

/// Beside a number at an end of its range the others hold under this condition alone.
#[test]
fn a_number_at_an_end_makes_the_others_conditional() {
    let folder = tempfile::tempdir().unwrap();
    let scene = write(folder.path(), "scene.json", SCENE);
    let record = write(folder.path(), "test.csv", &record());
    let arguments = [
        scene.as_str(),
        "--record",
        &record,
        "--starts",
        "2",
        "--match",
        "x=wheel.delta",
        "--vary",
        "wheel.stiffness=9.5:9.99 MN m/rad",
        "--vary",
        "wheel.damping_capacity=0:1",
    ];
    let found = document(&arguments, 1);
    let [stiffness, capacity] = [&found["estimates"][0], &found["estimates"][1]];
    assert_eq!(stiffness["standing"], "at_end");
    assert_eq!(
        (&capacity["standing"], &capacity["determined"]),
        (&"conditional".into(), &false.into())
    );
    // Its error is that of a fit in which the stiffness is not sought.
    let alone = [
        scene.as_str(),
        "--record",
        &record,
        "--starts",
        "2",
        "--match",
        "x=wheel.delta",
        "--set",
        "wheel.stiffness=9.99 MN m/rad",
        "--vary",
        "wheel.damping_capacity=0:1",
    ];
    let alone = document(&alone, 0);
    for key in ["value", "standard_error"] {
        let ratio = number(&capacity[key]) / number(&alone["estimates"][0][key]);
        assert!((ratio - 1.0).abs() < 1e-4, "{key}: {capacity} {alone}");
    }
}

/// The scene holds the question, and its record lies beside it; options go before the block.
#[test]
fn a_scene_holds_its_own_question() {
    let folder = tempfile::tempdir().unwrap();
    let plain = write(folder.path(), "plain.json", SCENE);
    let file = write(folder.path(), "test.csv", &record());
    let block = |record: &str| {
        let block = format!(
            r#""identify": {{
        "record": ["{record}"], "match": ["x=wheel.delta"], "sigma": ["x=0.7 µrad"], "starts": 2,
        "vary": ["wheel.stiffness=2:30 MN m/rad", "wheel.damping_capacity=0:1"]
    }},
    "run""#
        );
        SCENE.replace("\"run\"", &block)
    };
    let scene = write(
        folder.path(),
        "scene.json",
        &block("test.csv; run.tolerance=1e-9"),
    );
    let own = document(&[&scene], 0);
    let given = format!("{file}; run.tolerance=1e-9");
    let options = ["--record", &given, "--starts", "2", "--sigma", "x=0.7 µrad"];
    let named = document(&[&[plain.as_str()], &options[..], &SOUGHT[..]].concat(), 0);
    for key in ["estimates", "starts", "chi_squared", "settings"] {
        assert_eq!(own[key], named[key], "{key}");
    }
    assert_eq!(own["signals"][0]["record"], "test.csv");
    // Other signals have no standard deviations of the block.
    let less = document(&[&scene, "--starts", "3", "--match", "x=wheel.delta"], 0);
    assert_eq!(less["starts"].as_array().unwrap().len(), 3);
    assert!(less["chi_squared"].is_null());
    let absent = write(folder.path(), "absent.json", &block("tset.csv"));
    let text = errors(&[&absent]);
    assert!(text.contains("names the record `tset.csv`"), "{text}");
    assert!(text.contains("test.csv"), "{text}");
    let wrong = write(
        folder.path(),
        "wrong.json",
        &block("test.csv").replace("\"vary\"", "\"vry\""),
    );
    let text = errors(&[&wrong]);
    assert!(
        text.contains("vry") && text.contains("wrong.json"),
        "{text}"
    );
    // Without a block all that is missing is said at once.
    let text = errors(&[&plain]);
    for part in ["no record is named", "no column is matched", "--vary"] {
        assert!(text.contains(part), "{part}: {text}");
    }
    // Other commands pass the block over.
    let shown = Command::new(env!("CARGO_BIN_EXE_dam"))
        .args(["show", &scene])
        .output()
        .unwrap();
    assert!(shown.status.success());
}
