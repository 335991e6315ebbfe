//! Results of other studies as figures of `run`, `compare`, `map` and accuracy, against closed
//! forms, the values that scenarios expect, and the commands of the studies.

use serde_json::{Value, json};
use std::f64::consts::TAU;
use std::process::{Command, Output};

fn dam(arguments: &[&str]) -> Output {
    Command::new(env!("CARGO_BIN_EXE_dam"))
        .args(arguments)
        .arg("--quiet")
        .output()
        .unwrap()
}

#[track_caller]
fn document(arguments: &[&str]) -> Value {
    let arguments: Vec<&str> = arguments.iter().copied().chain(["--json"]).collect();
    let output = dam(&arguments);
    let error = String::from_utf8_lossy(&output.stderr).into_owned();
    assert_eq!(output.status.code(), Some(0), "{arguments:?}: {error}");
    serde_json::from_slice(&output.stdout).unwrap()
}

/// A scene in a file, gone with the folder.
fn written(scene: &Value) -> (tempfile::TempDir, String) {
    let folder = tempfile::tempdir().unwrap();
    let path = folder.path().join("scene.json");
    std::fs::write(&path, serde_json::to_string_pretty(scene).unwrap()).unwrap();
    let path = path.display().to_string();
    (folder, path)
}

#[track_caller]
fn near(found: &Value, wanted: f64, share: f64) {
    let found = found.as_f64().unwrap_or_else(|| panic!("{found}"));
    let off = (found - wanted).abs();
    assert!(off <= share * wanted.abs(), "{found} for {wanted}");
}

/// The row of a figure in a comparison of two runs that differ in their tolerance alone.
#[track_caller]
fn compared(scene: &str, figure: &str) -> Value {
    let over = ["--over", "run.tolerance=1e-6,1e-7", "--figure", figure];
    let mut arguments = vec!["compare", scene];
    arguments.extend(over);
    let found = document(&arguments);
    let rows = found["table"]["rows"].as_array().unwrap();
    let row = rows.iter().find(|row| row["figure"] == figure);
    row.unwrap_or_else(|| panic!("{figure}")).clone()
}

fn rocker() -> Value {
    json!({
        "dam": 1, "name": "t",
        "objects": {
            "shaft": { "kind": "drive", "motion": { "speed": "10 rev/s" } },
            "rocker": {
                "kind": "rocker", "input": "shaft", "position": { "sine": { "amplitude": 0.5 } },
                "inertia": 2, "stiffness": 2e4, "damping_capacity": 0, "masses": 1
            }
        },
        "run": { "duration": 0.2 }
    })
}

#[test]
fn natural_frequencies_are_figures() {
    let wanted = 100.0 / TAU;
    let mut scene = rocker();
    scene["expect"] = json!([
        { "figure": "frequency.1", "value": format!("{wanted} Hz"), "within": "1e-10 %" },
        { "figure": "frequency.open.1", "at_least": 0 },
    ]);
    let (_folder, path) = written(&scene);
    let found = document(&["run", &path]);
    near(&found["studies"]["frequency.1"]["value"], wanted, 1e-14);
    assert_eq!(found["studies"]["frequency.1"]["unit"], "Hz");
    assert_eq!(found["expect"][0]["holds"], true);
    let over = ["compare", &path, "--over", "rocker.stiffness=20000,80000"];
    let mut arguments = over.to_vec();
    arguments.extend(["--figure", "frequency.1"]);
    let found = document(&arguments);
    let rows = found["table"]["rows"].as_array().unwrap().iter();
    let row = rows.clone().find(|row| row["figure"] == "frequency.1");
    let row = row.unwrap();
    near(&row["values"][0], wanted, 1e-14);
    near(&row["values"][1], 2.0 * wanted, 1e-14);
    near(&row["errors"][0], -0.5, 1e-12);
    let x = "rocker.stiffness=20000:80000:4";
    let found = document(&["map", &path, "--x", x, "--figure", "frequency.1"]);
    assert_eq!(found["unit"], "Hz");
    let values = found["panels"][0]["values"].as_array().unwrap();
    for (value, stiffness) in values.iter().zip([1.0, 2.0, 3.0, 4.0f64]) {
        near(value, wanted * stiffness.sqrt(), 1e-14);
    }
    assert_eq!(values.len(), 4);
}

/// The lowest frequency of a uniform rod that is held at one end is √(k/J)/4 cycles a second.
#[test]
fn models_are_chosen_for_the_accuracy_of_a_frequency() {
    let (_folder, path) = written(&json!({
        "dam": 1, "name": "t",
        "objects": {
            "shaft": { "kind": "drive", "motion": { "speed": "1 rev/s" } },
            "rod": {
                "kind": "shaft", "input": "shaft", "inertia": 1, "stiffness": 1e4,
                "damping_capacity": 0.2, "masses": "auto"
            }
        },
        "run": { "duration": 0.2 }
    }));
    let found = document(&["run", &path, "--accuracy", "frequency.1=0.5 %"]);
    near(&found["studies"]["frequency.1"]["value"], 25.0, 5e-3);
    // (A lumped mass alone would have √(k/J)/2π.)
    let (_folder, rocker) = written(&rocker());
    let output = dam(&["run", &rocker, "--accuracy", "frequency.0=1 %"]);
    assert_eq!(output.status.code(), Some(2));
}

#[test]
fn steady_motions_are_figures() {
    let scene = "scenarios/steady/press_motor.json";
    let expected = std::fs::read_to_string(scene).unwrap();
    let expected: Value = serde_json::from_str(&expected).unwrap();
    let mut seen = 0;
    for one in expected["expect"].as_array().unwrap() {
        let figure = one["figure"].as_str().unwrap_or_default();
        let (Some(value), true) = (one["value"].as_f64(), figure.starts_with("steady.")) else {
            continue;
        };
        let row = compared(scene, figure);
        near(&row["values"][0], value, 1e-6);
        seen += 1;
    }
    assert!(seen > 0);
}

#[test]
fn kinematics_are_figures() {
    let scene = "scenarios/linkages/shaper.json";
    let found = document(&["kinematics", scene]);
    let judged = found["expect"].as_array().unwrap().iter();
    let mut judged = judged.filter(|one| one["what"] == "kinematics.shaper.ram.time_ratio");
    let wanted = judged.next().unwrap()["found"].as_f64().unwrap();
    let row = compared(scene, "kinematics.shaper.ram.time_ratio");
    near(&row["values"][1], wanted, 1e-12);
    for (figure, unit) in [
        ("kinematics.shaper.ram.time_ratio", ""),
        ("kinematics.shaper.ram.stroke", "m"),
        ("kinematics.shaper.lever.acceleration.greatest", "rad/s²"),
        ("forces.shaper.drive.greatest", "N m"),
    ] {
        assert_eq!(compared(scene, figure)["unit"], unit, "{figure}");
        let x = ["--x", "run.tolerance=1e-6:1e-5:2"];
        let found = document(&["map", scene, x[0], x[1], "--figure", figure]);
        assert_eq!(found["unit"], unit, "{figure}");
    }
    // The ram moves at the speed of the motor in the run too.
    let row = compared(scene, "kinematics.shaper.ram.acceleration.greatest");
    let run = document(&["run", scene]);
    let peak = run["objects"]["shaper.ram"]["peak_acceleration"].as_f64();
    assert!(row["values"][0].as_f64().unwrap() <= peak.unwrap() * (1.0 + 1e-9));
}

#[test]
fn cams_are_figures() {
    let scene = "scenarios/cams/flat_tappet.json";
    let cam = document(&["cam", scene]);
    // Under a flat face the radius of curvature is R + y + y″.
    let figures = &cam["cam"];
    let number = |value: &Value| value.as_f64().unwrap_or_else(|| panic!("{value}"));
    let base = number(&figures["base_radius"]);
    let radius = base + number(&figures["stroke"]) + number(&figures["acceleration"][1]["value"]);
    near(
        &compared(scene, "cam.valve.least_radius")["values"][0],
        radius,
        1e-9,
    );
    let force = number(&figures["force"]["contact_force"]["value"]);
    let row = compared(scene, "cam.valve.greatest_contact_force");
    near(&row["values"][0], force, 1e-12);
    assert_eq!(row["unit"], "N");
    assert_eq!(
        compared(scene, "cam.valve.greatest_pressure_angle")["values"][0],
        0.0
    );
    let x = "valve.cam.base_radius=15:21 mm:3";
    let figure = ["--figure", "cam.valve.least_radius"];
    let found = document(&["map", scene, "--x", x, figure[0], figure[1]]);
    let values = found["panels"][0]["values"].as_array().unwrap();
    for (value, other) in values.iter().zip([0.015, 0.018, 0.021]) {
        near(value, radius - base + other, 1e-9);
    }
}

#[test]
fn results_that_no_study_has_are_refused() {
    let (_folder, path) = written(&rocker());
    let x = ["--x", "rocker.stiffness=20000:80000:3"];
    for (figure, words) in [
        ("frequency.0", "counted from 1"),
        ("steady.mean_tim", "did you mean `steady.mean_time`?"),
        ("cam.roker.least_radius", "there is no object `roker`"),
        ("kinematics.rocker.x.y", "kinematics"),
    ] {
        let compare = [
            "compare",
            &path,
            "--over",
            "rocker.masses=1,2",
            "--figure",
            figure,
        ];
        let map = ["map", &path, x[0], x[1], "--figure", figure];
        for arguments in [&compare[..], &map[..]] {
            let output = dam(arguments);
            let error = String::from_utf8_lossy(&output.stderr).into_owned();
            assert_eq!(output.status.code(), Some(2), "{arguments:?}: {error}");
            let known = error.contains(words) || words == "kinematics";
            assert!(known, "{words}: {error}");
        }
    }
    let own = [
        "compare",
        &path,
        "--over",
        "rocker.masses=1,2",
        "--figure",
        "rocker.delta_abs",
    ];
    let output = dam(&own);
    assert_eq!(output.status.code(), Some(2));
    let error = String::from_utf8_lossy(&output.stderr).into_owned();
    assert!(error.contains("compared in any case"), "{error}");
    let mut scene = rocker();
    for (figure, words) in [
        ("frequency.0", "counted from 1"),
        ("cam.rocker.least_radius", "does not describe its cam"),
    ] {
        scene["expect"] = json!([{ "figure": figure, "at_least": 0 }]);
        let (_folder, path) = written(&scene);
        let output = dam(&["run", &path]);
        let error = String::from_utf8_lossy(&output.stderr).into_owned();
        assert_eq!(output.status.code(), Some(2), "{error}");
        assert!(
            error.contains(words) && error.contains("scene.json:"),
            "{error}"
        );
    }
}

/// A slider-crank on a motor with a cam beside it, which every study has results of.
fn machine() -> Value {
    json!({
        "dam": 1, "name": "t",
        "objects": {
            "drive": { "kind": "drive", "motion": { "speed": "300 rpm" } },
            "press": { "from": "linkage/slider-crank", "input": "drive",
                       "assembly": { "slide": { "near": [0.25, 0] } } },
            "valve": {
                "kind": "cam_follower", "input": "drive", "motion": "sliding", "masses": 1,
                "inertia": "1 kg", "stiffness": "1 MN/m", "damping_capacity": 0.4,
                "pair": { "closure": "force" },
                "position": { "cam": { "lift": "20 mm", "rise": "120 deg", "dwell": "30 deg",
                                       "return": "120 deg", "law": "cycloidal" } },
                "cam": { "base_radius": "40 mm", "contact": { "roller": "10 mm" } },
                "loads": { "spring": { "spring": { "rate": "20 N/mm", "preload": "500 N" } } }
            }
        },
        "run": { "duration": 0.8 }
    })
}

/// Figures of every study, the command that judges them, a value in a unit of theirs that they
/// exceed, one in a unit that is none of theirs, and what they are.
const MEASURED: &[(&str, &str, &str, &str, &str)] = &[
    (
        "kinematics",
        "kinematics.press.slide.stroke",
        "99 mm",
        "1 s",
        "length in m",
    ),
    (
        "kinematics",
        "kinematics.press.slide.speed.greatest",
        "100 cm/s",
        "1 m",
        "speed in m/s",
    ),
    (
        "kinematics",
        "kinematics.press.slide.acceleration.greatest",
        "1 m/s^2",
        "1 m/s",
        "acceleration in m/s^2",
    ),
    (
        "kinematics",
        "kinematics.press.slide.time_ratio",
        "90 %",
        "1 rad",
        "a pure number",
    ),
    (
        "kinematics",
        "kinematics.press.slide.input_while_rising",
        "170 deg",
        "1 mm",
        "angle in rad",
    ),
    (
        "kinematics",
        "kinematics.press.links.rod.angular_speed.greatest",
        "1 rpm",
        "1 m/s",
        "angular speed in rad/s",
    ),
    (
        "kinematics",
        "kinematics.press.slide.first_transfer.greatest",
        "0.1 mm/rad",
        "1 m/s",
        "length per angle in m/rad",
    ),
    (
        "kinematics",
        "kinematics.press.slide.third_transfer.greatest",
        "0.1 mm/rad^3",
        "1 m/s",
        "in m/rad³",
    ),
    (
        "kinematics",
        "kinematics.press.slide.speed.greatest_at",
        "1 deg",
        "1 s",
        "angle in rad",
    ),
    (
        "kinematics",
        "kinematics.press.transmission_angles.rod.greatest",
        "80 deg",
        "1 m",
        "angle in rad",
    ),
    (
        "forces",
        "forces.press.drive.greatest",
        "1 N mm",
        "1 N",
        "moment in N m",
    ),
    (
        "forces",
        "forces.press.A.force.greatest",
        "1e-3 kN",
        "1 N m",
        "force in N",
    ),
    (
        "forces",
        "forces.press.power.drive.greatest",
        "1e-3 kW",
        "1 N",
        "power in W",
    ),
    (
        "forces",
        "forces.press.drive.greatest_at",
        "0.01 deg",
        "1 m",
        "angle in rad",
    ),
    (
        "forces",
        "forces.press.cycle.duration",
        "199 ms",
        "1 m",
        "time in s",
    ),
    (
        "forces",
        "forces.press.cycle.rms_drive",
        "1e-3 N m",
        "1 J/s",
        "moment in N m",
    ),
    (
        "forces",
        "forces.press.counterweight.mass_radius",
        "1 kg mm",
        "1 kg",
        "in kg m",
    ),
    (
        "forces",
        "forces.press.zones.count",
        "-1",
        "1 m",
        "a pure number",
    ),
    (
        "cam",
        "cam.valve.base_radius",
        "39 mm",
        "1 N",
        "length in m",
    ),
    (
        "cam",
        "cam.valve.greatest_contact_force",
        "0.1 kN",
        "1 m",
        "force in N",
    ),
    (
        "cam",
        "cam.valve.greatest_pressure_angle",
        "1 deg",
        "1 m",
        "angle in rad",
    ),
    (
        "run",
        "cam.valve.greatest_torque",
        "1 N mm",
        "1 N",
        "moment in N m",
    ),
    ("run", "frequency.1", "0.01 kHz", "1 m", "frequency in Hz"),
    ("run", "valve.delta_abs", "1 nm", "1 rad", "length in m"),
    ("steady", "steady.period", "100 ms", "1 m", "time in s"),
];

/// Each is right in its unit, wrong beyond its value, and refused in another unit, at its place
/// and with the message that figures of a run have.
#[test]
fn expectations_of_every_study_take_the_units_of_their_figures() {
    for &(command, figure, below, wrong, words) in MEASURED {
        let judged = |property: &str, value: &str| {
            let mut scene = machine();
            scene["expect"] = json!([{ "figure": figure, property: value }]);
            let (folder, path) = written(&scene);
            (dam(&[command, &path, "--json"]), folder)
        };
        let (output, _folder) = judged("at_least", below);
        let found: Value = serde_json::from_slice(&output.stdout).unwrap();
        assert_eq!(found["expect"][0]["holds"], true, "{figure}: {found}");
        let (output, _folder) = judged("at_most", below);
        assert_eq!(output.status.code(), Some(1), "{figure}");
        let found: Value = serde_json::from_slice(&output.stdout).unwrap();
        assert_eq!(found["expect"][0]["holds"], false, "{figure}");
        let mut scene = machine();
        scene["expect"] = json!([{ "figure": figure, "at_most": wrong }]);
        let (_folder, path) = written(&scene);
        // Whatever command reads the scene.
        for command in [command, "check"] {
            let output = dam(&[command, &path]);
            let said = String::from_utf8_lossy(&output.stderr).into_owned();
            assert_eq!(output.status.code(), Some(2), "{figure}: {said}");
            for part in [
                "error[wrong-unit]: `at_most` has the wrong unit",
                "this is in",
                words,
            ] {
                assert!(said.contains(part), "{figure}: {part}: {said}");
            }
            assert!(
                said.contains("scene.json:") && said.contains("\"at_most\""),
                "{said}"
            );
        }
    }
}

#[test]
fn a_text_without_a_unit_and_turns_a_minute_are_told_apart_for_linkages_too() {
    let stroke = "kinematics.press.slide.stroke";
    let speed = "kinematics.press.input.speed.greatest";
    for (expectation, words) in [
        (
            json!({ "figure": stroke, "at_most": "100" }),
            "write 100 without quotes, or \"100 m\"",
        ),
        (
            json!({ "figure": stroke, "value": "0.1 m", "within": "1 s" }),
            "`within` has the wrong unit",
        ),
        (
            json!({ "figure": speed, "at_most": "300 1/min" }),
            "not a frequency",
        ),
        (json!({ "figure": speed, "at_most": "5 Hz" }), "\"5 rev/s\""),
    ] {
        let mut scene = machine();
        scene["expect"] = json!([expectation]);
        let (_folder, path) = written(&scene);
        let output = dam(&["check", &path]);
        let said = String::from_utf8_lossy(&output.stderr).into_owned();
        assert_eq!(output.status.code(), Some(2), "{expectation}");
        assert!(said.contains(words), "{words}: {said}");
    }
    let mut scene = machine();
    scene["expect"] = json!([{ "figure": stroke, "value": "100 mm", "within": "1e-9 %" }]);
    let (_folder, path) = written(&scene);
    assert_eq!(document(&["kinematics", &path])["expect"][0]["holds"], true);
    for (accuracy, code) in [("1 mm", 0), ("1 s", 2)] {
        let accuracy = format!("{stroke}={accuracy}");
        let output = dam(&["run", &path, "--accuracy", &accuracy]);
        assert_eq!(output.status.code(), Some(code), "{accuracy}");
    }
}

/// What each command says on standard error of a scene that expects something of every study.
#[test]
fn every_study_judges_its_own_and_names_the_command_for_the_rest() {
    let mut scene = machine();
    let figures = [
        ("kinematics.press.slide.stroke", "dam kinematics"),
        ("forces.press.drive.greatest", "dam forces"),
        ("cam.valve.base_radius", "dam cam"),
        ("steady.period", "dam steady"),
        ("valve.delta_abs", "dam run"),
        ("frequency.1", "dam run"),
    ];
    let expected = figures.map(|(figure, _)| json!({ "figure": figure, "at_most": 0 }));
    scene["expect"] = json!(expected);
    let (_folder, path) = written(&scene);
    for command in ["kinematics", "forces", "cam", "steady", "run"] {
        let own = |figure: &str, judge: &str| {
            judge == format!("dam {command}") || command == "run" && figure.starts_with("cam.")
        };
        let run = |more: &[&str]| {
            let output = Command::new(env!("CARGO_BIN_EXE_dam"))
                .args([&[command, &path], more].concat())
                .output()
                .unwrap();
            (
                output.status.code(),
                String::from_utf8(output.stderr).unwrap(),
            )
        };
        let (code, said) = run(&[]);
        assert_eq!(code, Some(1), "{command}: {said}");
        for (figure, judge) in figures {
            let mut lines = said
                .lines()
                .filter(|line| line.starts_with("expectation") && line.contains(figure));
            let line = lines
                .next()
                .unwrap_or_else(|| panic!("{command} {figure}: {said}"));
            match own(figure, judge) {
                true => assert!(line.starts_with("expectation failed:"), "{line}"),
                false => {
                    assert!(line.starts_with("expectations not judged here:"), "{line}");
                    assert!(line.contains(&format!("`{judge}` judges them")), "{line}");
                }
            }
        }
        // Another machine than the scene's has no expectations.
        let (code, said) = run(&["--set", "name=other"]);
        assert_eq!(code, Some(0), "{command}: {said}");
        let words = "expectations: not judged, the options change the scene's data";
        assert!(said.contains(words), "{command}: {said}");
        assert!(!said.contains("not judged here"), "{command}: {said}");
    }
}

/// What several objects have is judged one object at a time.
#[test]
fn the_object_that_was_not_chosen_is_named() {
    let mut scene = machine();
    scene["objects"]["other"] = scene["objects"]["press"].clone();
    let figures = [
        "kinematics.press.slide.stroke",
        "kinematics.other.slide.stroke",
    ];
    scene["expect"] = json!(figures.map(|figure| json!({ "figure": figure, "at_least": 0 })));
    let (_folder, path) = written(&scene);
    let output = Command::new(env!("CARGO_BIN_EXE_dam"))
        .args(["kinematics", &path, "--object", "press"])
        .output()
        .unwrap();
    let said = String::from_utf8(output.stderr).unwrap();
    assert_eq!(output.status.code(), Some(0), "{said}");
    let words = "kinematics.other.slide.stroke; `dam kinematics --object other` judges them";
    assert!(
        said.contains("1 of 1 hold") && said.contains(words),
        "{said}"
    );
}

/// `cam` and `frequency` may be ids: what an object has and what a study has differ in name.
#[test]
fn objects_called_as_a_study_have_their_own_figures() {
    let text = machine().to_string();
    for (id, code) in [
        ("cam", 0),
        ("frequency", 0),
        ("kinematics", 2),
        ("forces", 2),
        ("steady", 2),
        ("run", 2),
    ] {
        let mut scene: Value =
            serde_json::from_str(&text.replace("\"valve\"", &format!("\"{id}\""))).unwrap();
        let own = format!("{id}.delta_abs");
        let of_cam = format!("cam.{id}.base_radius");
        scene["expect"] = json!([
            { "figure": own, "at_least": "1 nm" },
            { "figure": of_cam, "value": "40 mm", "within": "1 nm" },
            { "figure": "frequency.1", "at_least": "1 Hz" },
            { "figure": "frequency.open.1", "at_least": 0 },
        ]);
        let (_folder, path) = written(&scene);
        let output = dam(&["run", &path, "--json"]);
        assert_eq!(output.status.code(), Some(code), "{id}");
        let found: Value = serde_json::from_slice(&output.stdout).unwrap();
        match code {
            0 => {
                let judged = found["expect"].as_array().unwrap();
                assert!(
                    judged.iter().all(|one| one["holds"] == true),
                    "{id}: {judged:?}"
                );
                let (delta, told) = (&found["objects"][id]["delta_abs"], &judged[0]["found"]);
                assert_eq!(delta, told, "{id}");
            }
            _ => {
                let said = String::from_utf8(dam(&["run", &path]).stderr).unwrap();
                let words = format!("`{id}` cannot be the id of an object");
                assert!(
                    said.contains(&words) && said.contains("scene.json:"),
                    "{said}"
                );
            }
        }
    }
}

#[test]
fn a_figure_of_a_study_that_is_mistyped_is_not_taken_for_an_object() {
    for (figure, message, hint) in [
        (
            "cam.valve.least_radiu",
            "`cam.valve` has no result `least_radiu`",
            "did you mean `cam.valve.least_radius`?",
        ),
        (
            "cam.valv.least_radius",
            "unknown object `valv`",
            "did you mean `valve`?",
        ),
        (
            "cam.valve",
            "`cam.valve` names no result",
            "as in `cam.valve.least_radius`",
        ),
        (
            "frequency.x",
            "there is no result `frequency.x`",
            "write `frequency.1`",
        ),
        (
            "frequency",
            "there is no result `frequency`",
            "write `frequency.1`",
        ),
        (
            "steady",
            "`steady` names no result",
            "write `steady.` and one of",
        ),
        ("run", "`run` names no result", "write `run.` and one of"),
        (
            "valve",
            "`valve` names no result",
            "write `valve.` and one of",
        ),
    ] {
        let mut scene = machine();
        scene["expect"] = json!([{ "figure": figure, "at_least": 0 }]);
        let (_folder, path) = written(&scene);
        let output = dam(&["check", &path]);
        let said = String::from_utf8(output.stderr).unwrap();
        assert_eq!(output.status.code(), Some(2), "{figure}");
        assert!(
            said.contains(message) && said.contains(hint),
            "{figure}: {said}"
        );
    }
}
