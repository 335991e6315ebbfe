//! `dam kinematics`: a slider-crank and a slotted link against their closed
//! forms, and the program's answers.

use dam::lower::lower;
use dam::model::Model;
use dam::scene::{BuiltIn, Document, Overrides};
use dam::studies::kinematics::{Kinematics, KinematicsRequest, Over, Question, kinematics};
use std::f64::consts::{PI, TAU};
use std::process::{Command, Output};

const CRANK: f64 = 0.05;
const ROD: f64 = 0.2;
const OFFSET: f64 = 0.03;

fn slider_crank() -> Model {
    model(
        r#"{ "dam": 1, "name": "Offset slider-crank", "objects": {
            "drive": { "kind": "drive", "motion": { "speed": 10 } },
            "press": { "from": "linkage/slider-crank", "input": "drive",
                       "dimensions": { "crank": 0.05, "rod": 0.2, "offset": 0.03 } } },
          "run": { "duration": 2, "samples": 100 } }"#,
    )
}

fn model(text: &str) -> Model {
    let document = Document::parse("scene", text.as_bytes()).unwrap();
    let reading = document.scene(&BuiltIn, &Overrides::default()).unwrap();
    lower(&reading.scene).unwrap()
}

fn question(over: Option<Over>, positions: usize) -> Question {
    Question {
        object: None,
        over,
        positions,
        speed: None,
        acceleration: None,
        duration: 2.0,
        ..Question::default()
    }
}

fn column<'a>(found: &'a Kinematics, name: &str) -> &'a [f64] {
    let mut columns = found.columns.iter();
    let column = columns.find(|column| column.name() == name);
    &column.unwrap_or_else(|| panic!("no column {name}")).values
}

/// Slide of the offset slider-crank and its derivatives by the crank's angle.
fn slide(q: f64) -> [f64; 4] {
    // x = r cos q + √(l² − w²), w = e − r sin q.
    let (sin, cos) = q.sin_cos();
    let w = OFFSET - CRANK * sin;
    let (w1, w2, w3) = (-CRANK * cos, CRANK * sin, CRANK * cos);
    let root = (ROD * ROD - w * w).sqrt();
    let r1 = -w * w1 / root;
    let r2 = -(w1 * w1 + w * w2 + r1 * r1) / root;
    let r3 = -(3.0 * w1 * w2 + w * w3 + 3.0 * r1 * r2) / root;
    [
        CRANK * cos + root,
        -CRANK * sin + r1,
        -CRANK * cos + r2,
        CRANK * sin + r3,
    ]
}

#[test]
fn a_slider_crank_moves_as_its_formula_says() {
    let model = slider_crank();
    let asked = KinematicsRequest::new(&model, &question(None, 72)).unwrap();
    let found = kinematics(&asked);
    assert!(found.closed && found.stopped.is_none());
    assert_eq!(found.axis.values.len(), 73);
    for (row, &q) in found.axis.values.iter().enumerate() {
        let [x, x1, x2, x3] = slide(q);
        let expected = [
            ("slide.displacement", x),
            ("slide.first_transfer", x1),
            ("slide.second_transfer", x2),
            ("slide.third_transfer", x3),
            ("slide.speed", 10.0 * x1),
            ("slide.acceleration", 100.0 * x2),
        ];
        for (name, value) in expected {
            let found = column(&found, name)[row];
            assert!(
                (found - value).abs() <= 1e-12 * (1.0 + value.abs()),
                "{name} at {q}: {found} {value}"
            );
        }
    }
}

/// A range from a position to itself is that position alone.
#[test]
fn one_position_is_a_range() {
    let model = slider_crank();
    for (q, positions) in [(0.7, 1), (0.7, 360), (0.0, 1)] {
        let over = Over::Range { from: q, to: q };
        let found =
            kinematics(&KinematicsRequest::new(&model, &question(Some(over), positions)).unwrap());
        assert_eq!(found.axis.values, [q]);
        assert!(found.stopped.is_none() && !found.closed && found.warnings.is_empty());
        let [x, x1, ..] = slide(q);
        assert!((column(&found, "slide.displacement")[0] - x).abs() < 1e-12);
        assert!((column(&found, "slide.first_transfer")[0] - x1).abs() < 1e-12);
        for (extremes, column) in found.extremes.iter().zip(&found.columns) {
            let ends = [extremes.least, extremes.greatest];
            let value = column.values[0];
            let same = |end: &(f64, f64)| end.0 == q && end.1 == value;
            assert!(!value.is_finite() || ends.iter().all(same));
        }
    }
}

/// So it is with several inputs, whether their values are held or are such ranges.
#[test]
fn one_position_of_several_inputs_is_a_range() {
    let scene = concat!(
        env!("CARGO_MANIFEST_DIR"),
        "/scenarios/linkages/five_bar.json"
    );
    let table = |command: &str, inputs: [&str; 2]| {
        let (code, table, error) = ran(&[
            command,
            scene,
            "--csv",
            "--input",
            inputs[0],
            "--input",
            inputs[1],
            "--speed",
            "left=2 rad/s",
            "--speed",
            "right=-1 rad/s",
        ]);
        assert_eq!(code, Some(0), "{error}");
        assert!(!table.contains("NaN") && !table.contains("inf"), "{table}");
        table
    };
    for command in ["kinematics", "forces"] {
        let held = table(command, ["left=10 deg", "right=40 deg"]);
        assert_eq!(held.lines().count(), 2);
        assert_eq!(table(command, ["left=10:10 deg", "right=40 deg"]), held);
        assert_eq!(table(command, ["left=10:10 deg", "right=40:40 deg"]), held);
        let way = table(command, ["left=10:20 deg", "right=40:40 deg"]);
        let first = |table: &str| table.lines().nth(1).map(str::to_owned);
        assert_eq!(first(&way), first(&held));
    }
}

#[test]
fn strokes_extremes_and_transmission_angles_are_those_of_the_triangle() {
    let model = slider_crank();
    let found = {
        let asked = KinematicsRequest::new(&model, &question(Some(Over::Turn), 360)).unwrap();
        kinematics(&asked)
    };
    let stroke = found.strokes.iter().find(|s| s.owner == "slide").unwrap();
    let (far, near) = (
        ((ROD + CRANK).powi(2) - OFFSET * OFFSET).sqrt(),
        ((ROD - CRANK).powi(2) - OFFSET * OFFSET).sqrt(),
    );
    assert!((stroke.ends[1].1 - far).abs() < 1e-14 && (stroke.ends[0].1 - near).abs() < 1e-14);
    // Crank and rod in line: outwards at asin(e/(l + r)), inwards at π + asin(e/(l − r)).
    let out = (OFFSET / (ROD + CRANK)).asin();
    let back = PI + (OFFSET / (ROD - CRANK)).asin();
    assert!((stroke.ends[1].0.rem_euclid(TAU) - out).abs() < 1e-8);
    assert!((stroke.ends[0].0.rem_euclid(TAU) - back).abs() < 1e-8);
    let falling = back - out;
    let ratio = falling.max(TAU - falling) / falling.min(TAU - falling);
    assert!((stroke.time_ratio - ratio).abs() < 1e-7);
    // cos μ = (e + r)/l, at the crank's lowest position.
    let angle = &found.transmission[0];
    assert!((angle.least.1 - ((OFFSET + CRANK) / ROD).acos()).abs() < 1e-12);
    assert!((angle.least.0 - 1.5 * PI).abs() < 1e-7);
    assert!((angle.greatest.1 - PI / 2.0).abs() < 1e-7);
    let index = found
        .columns
        .iter()
        .position(|c| c.name() == "slide.displacement");
    let extremes = found.extremes[index.unwrap()];
    assert!((extremes.greatest.1 - far).abs() < 1e-15 + 1e-14);
    assert!((extremes.greatest.0.rem_euclid(TAU) - out).abs() < 1e-6);
}

/// Crank on O1 = (0, 0.3), slotted link on O2 = (0, 0), under constant
/// acceleration of the crank: the composition of the block's motion.
#[test]
fn the_block_of_a_slotted_link_moves_with_the_link_along_it_and_by_coriolis() {
    let model = model(
        r#"{ "dam": 1, "name": "Slotted link", "objects": {
            "drive": { "kind": "drive", "motion": { "acceleration": 0.1, "start_speed": 0.4 } },
            "link": { "from": "linkage/slotted-link", "input": "drive" } },
          "run": { "duration": 20, "samples": 100 } }"#,
    );
    let asked =
        KinematicsRequest::new(&model, &question(Some(Over::Time { to: 20.0 }), 500)).unwrap();
    let found = kinematics(&asked);
    let body = &model.linkages[0];
    let spec = body.linkage.spec();
    let slot = spec
        .pairs
        .iter()
        .position(|pair| pair.name == "slide")
        .unwrap();
    let crank = spec.links.iter().find(|link| link.name == "crank").unwrap();
    let length = crank.points[0].at[0];
    let get = |quantity: &str| {
        column(
            &found,
            &format!("pairs.{}.{quantity}", spec.pairs[slot].name),
        )
    };
    let relative = get("relative_acceleration");
    for row in 0..found.axis.values.len() {
        let time = found.axis.values[row];
        let (speed, acceleration) = (0.4 + 0.1 * time, 0.1);
        // V_r² + V_e² = l²ω², (a_r + a_e,t)² + (a_e,n + a_c)² = l²(ω⁴ + ε²).
        let velocity = get("relative_speed")[row].hypot(get("transport_speed_across")[row]);
        assert!((velocity - length * speed).abs() < 1e-13, "{time}");
        assert!(get("transport_speed_along")[row].abs() < 1e-13);
        let along = relative[row] + get("transport_acceleration_along")[row];
        let across = get("transport_acceleration_across")[row] + get("coriolis_acceleration")[row];
        let whole = length * (speed.powi(4) + acceleration * acceleration).sqrt();
        assert!((along.hypot(across) - whole).abs() < 1e-12, "{time}");
        // a_e^n = S·ω₂² towards the pivot, a_e^τ = S·ε₂.
        let distance = get("displacement")[row];
        let slow = column(&found, "links.slot.angular_speed")[row];
        let growth = column(&found, "links.slot.angular_acceleration")[row];
        assert!((get("transport_acceleration_along")[row] + distance * slow * slow).abs() < 1e-13);
        assert!((get("transport_acceleration_across")[row] - distance * growth).abs() < 1e-13);
    }
}

/// Lever below the crank: cos(half the return) = crank/distance.
#[test]
fn a_shaper_returns_faster_than_it_cuts() {
    let text = include_str!("../../scenarios/linkages/shaper.json");
    let model = model(text);
    let asked = KinematicsRequest::new(&model, &question(None, 360)).unwrap();
    let found = kinematics(&asked);
    let stroke = found.strokes.iter().find(|s| s.owner == "ram").unwrap();
    assert!(
        (stroke.time_ratio - 1.41500555502).abs() < 1e-9,
        "{stroke:?}"
    );
}

fn dam(arguments: &[&str]) -> Output {
    let mut command = Command::new(env!("CARGO_BIN_EXE_dam"));
    command.args(arguments).output().unwrap()
}

fn scene_file(folder: &std::path::Path, text: &str) -> String {
    let path = folder.join("scene.json");
    std::fs::write(&path, text).unwrap();
    path.display().to_string()
}

const FOUR_BAR: &str = r#"{ "dam": 1, "name": "Double rocker", "objects": {
    "drive": { "kind": "drive", "motion": { "speed": "60 rpm", "angle": "30 deg" } },
    "bars": { "from": "linkage/four-bar", "input": "drive", "start": "30 deg",
              "dimensions": { "crank": 0.2, "coupler": 0.1, "rocker": 0.15, "frame": 0.25 } } },
  "run": { "duration": 2, "samples": 100 } }"#;

#[test]
fn a_dead_position_ends_the_rows_and_is_named() {
    let folder = tempfile::tempdir().unwrap();
    let scene = scene_file(folder.path(), FOUR_BAR);
    let set = ["--set", "bars.assembly={\"rocker\": {\"branch\": \"+\"}}"];
    let out = dam(&["kinematics", &scene, "--json", "--time", set[0], set[1]]);
    let document: serde_json::Value = serde_json::from_slice(&out.stdout).unwrap();
    assert_eq!(
        out.status.code(),
        Some(1),
        "{}",
        String::from_utf8_lossy(&out.stderr)
    );
    // The crank goes no further than where coupler and rocker are in line:
    // a² + d² − 2ad cos q = (b + c)².
    let (a, b, c, d): (f64, f64, f64, f64) = (0.2, 0.1, 0.15, 0.25);
    let end = ((a * a + d * d - (b + c) * (b + c)) / (2.0 * a * d)).acos();
    let stopped = &document["stopped"];
    assert!((stopped["input"].as_f64().unwrap() - end).abs() < 1e-12);
    let time = (end - PI / 6.0) / TAU;
    assert!((stopped["at"].as_f64().unwrap() - time).abs() < 1e-12);
    let rows = document["axis"]["values"].as_array().unwrap().len();
    assert!(rows > 0 && rows < 361);
    let limits = document["input"]["limits"].as_array().unwrap();
    assert_eq!(limits.len(), 2);
    let out = dam(&["kinematics", &scene, "--turn", set[0], set[1]]);
    assert_eq!(out.status.code(), Some(2));
    assert!(String::from_utf8_lossy(&out.stderr).contains("does not repeat after a turn"));
    // Over the whole reach speeds have no bounds, and what is finite has its values.
    let near = end * (1.0 - 1e-7);
    let range = format!("--range={} rad:{near} rad", -near);
    let out = dam(&["kinematics", &scene, "--json", &range, set[0], set[1]]);
    assert_eq!(out.status.code(), Some(0));
    let document: serde_json::Value = serde_json::from_slice(&out.stdout).unwrap();
    let extremes = |name: &str| {
        let column = &document["columns"][name];
        [&column["least"], &column["greatest"]].map(Clone::clone)
    };
    let [least, greatest] = extremes("links.rocker.angular_speed");
    assert!(greatest["value"].is_null() && least["value"].is_f64());
    assert!((greatest["unbounded_towards"].as_f64().unwrap().abs() - end).abs() < 1e-12);
    assert!(extremes("links.coupler.angular_speed")[0]["value"].is_null());
    for name in [
        "links.rocker.angle",
        "links.crank.angular_speed",
        "links.crank.angle",
    ] {
        for one in extremes(name) {
            assert!(
                one["value"].is_f64() || one["value"].is_i64(),
                "{name}: {one}"
            );
        }
    }
    let pages = folder.path().join("pages").display().to_string();
    let asked = [
        "kinematics",
        &scene,
        &range,
        set[0],
        set[1],
        "--out",
        &pages,
    ];
    let out = dam(&asked);
    assert!(String::from_utf8_lossy(&out.stdout).contains("unbounded  → "));
    charts_show_what_lies_between_the_ends(&pages);
}

/// The frames of all charts: at the last positions angular accelerations are beyond 1e12 rad/s²,
/// in the middle 1 020.
fn charts_show_what_lies_between_the_ends(pages: &str) {
    let page = std::fs::read_to_string(format!("{pages}/report.html")).unwrap();
    let frames: Vec<[f64; 2]> = (page.split("\"y\":{\"ends\":").skip(1))
        .map(|rest| serde_json::from_str(&rest[..=rest.find(']').unwrap()]).unwrap())
        .collect();
    assert!(frames.len() > 10);
    for [low, high] in &frames {
        assert!(
            -2000.0 < *low && low < high && *high < 2000.0,
            "{low} {high}"
        );
    }
    let reach = |frame: &&[f64; 2]| frame[1] > 1020.0;
    assert_eq!(frames.iter().filter(reach).count(), 2);
    assert!(page.contains("grows without bound towards here"));
    assert!(page.contains("acceleration away from the ends, where it has no bounds, longest 346."));
}

#[test]
fn the_program_prints_tables_documents_and_pictures_and_says_what_is_wrong() {
    let folder = tempfile::tempdir().unwrap();
    let scene = scene_file(
        folder.path(),
        r#"{ "dam": 1, "name": "Press", "objects": {
            "drive": { "kind": "drive", "motion": { "speed": "60 rpm" } },
            "press": { "from": "linkage/slider-crank", "input": "drive" } },
          "run": { "duration": 2, "samples": 100 } }"#,
    );
    let text = |arguments: &[&str]| {
        let out = dam(arguments);
        (
            out.status.code(),
            String::from_utf8_lossy(&out.stdout).into_owned(),
            String::from_utf8_lossy(&out.stderr).into_owned(),
        )
    };
    let (code, shown, _) = text(&["kinematics", &scene]);
    assert_eq!(code, Some(0));
    assert!(shown.contains("1 degree of freedom") && shown.contains("Transmission angles"));
    let (_, table, _) = text(&["kinematics", &scene, "--csv", "--positions", "10"]);
    assert_eq!(table.lines().count(), 12);
    assert!(table.starts_with("input coordinate [rad],input.displacement [rad]"));
    let (code, picture, _) = text(&["kinematics", &scene, "--svg", "33.3 deg"]);
    assert_eq!(code, Some(0));
    assert!(picture.starts_with("<svg") && picture.contains("33.3 deg"));
    let out = folder.path().join("out").display().to_string();
    let (code, _, _) = text(&["kinematics", &scene, "--quiet", "--out", &out]);
    assert_eq!(code, Some(0));
    for file in [
        "kinematics.csv",
        "kinematics.json",
        "mechanism.svg",
        "report.html",
    ] {
        assert!(folder.path().join("out").join(file).exists(), "{file}");
    }
    for (arguments, message) in [
        (vec!["--object", "pres"], "no linkage"),
        (vec!["--range", "0 deg"], "FROM:TO"),
        (vec!["--range", "0:1e999 deg"], "too large"),
        (vec!["--speed", "3 kg"], "3 kg"),
        (
            vec!["--time", "1", "--speed", "60 rpm"],
            "drive gives speed",
        ),
        (vec!["--svg", "400 deg"], "outside"),
    ] {
        let mut all = vec!["kinematics", scene.as_str()];
        all.extend(&arguments);
        let (code, _, error) = text(&all);
        assert_eq!(code, Some(2), "{arguments:?}: {error}");
        assert!(error.contains(message), "{arguments:?}: {error}");
    }
}

fn ran(arguments: &[&str]) -> (Option<i32>, String, String) {
    let out = dam(arguments);
    let text = |bytes: &[u8]| String::from_utf8_lossy(bytes).into_owned();
    (out.status.code(), text(&out.stdout), text(&out.stderr))
}

const SLEY: &str = r#"{ "dam": 1, "name": "Sley", "objects": {
    "crank": { "kind": "drive", "motion": { "speed": "300 rpm" } },
    "sley": { "kind": "rocker", "input": "crank", "inertia": 0.15, "masses": 0,
      "position": { "four_bar": { "crank": 0.04, "coupler": 0.12, "rocker": 0.1, "frame": 0.13 } } } EXPECT
  "run": { "duration": 1 } }"#;

/// What can go everywhere has no range of its own.
#[test]
fn a_lone_block_behind_a_motor_needs_a_range() {
    let folder = tempfile::tempdir().unwrap();
    let scene = scene_file(
        folder.path(),
        r#"{ "dam": 1, "name": "Block", "objects": {
    "cylinder": { "kind": "drive", "coordinate": "sliding", "motor": { "inertia": "1 kg", "force": { "constant": "5 N" } } },
    "block": { "kind": "linkage", "input": "cylinder", "driver": "guide",
      "ground": { "O": [0, 0] }, "links": { "block": { "mass": "3 kg" } },
      "pairs": { "guide": { "sliding": { "guide": "ground.O", "block": "block.origin" } } } } },
  "run": { "duration": 1 } }"#,
    );
    for command in ["kinematics", "forces"] {
        let (code, _, error) = ran(&[command, &scene]);
        assert_eq!(code, Some(2));
        assert!(
            error.contains("goes everywhere: say over which range"),
            "{error}"
        );
        let (code, _, error) = ran(&[command, &scene, "--range", "0:1", "--speed", "0.1"]);
        assert_eq!(code, Some(0), "{error}");
    }
}

/// A position function has the kinematics of the linkage that it is short for.
#[test]
fn a_position_function_is_looked_at_as_its_linkage() {
    let folder = tempfile::tempdir().unwrap();
    let scene = scene_file(folder.path(), &SLEY.replace("EXPECT", "},"));
    let (code, document, _) = ran(&["kinematics", &scene, "--json"]);
    assert_eq!(code, Some(0));
    let document: serde_json::Value = serde_json::from_str(&document).unwrap();
    assert_eq!(document["object"], "sley");
    // Crank and coupler in line at both ends of the stroke.
    let at_pivot = |reach: f64| {
        PI - ((0.13f64 * 0.13 + 0.1 * 0.1 - reach * reach) / (2.0 * 0.13 * 0.1)).acos()
    };
    let stroke = document["strokes"][0]["stroke"].as_f64().unwrap();
    let wanted = at_pivot(0.08) - at_pivot(0.16);
    assert!((stroke - wanted).abs() < 1e-12, "{stroke} {wanted}");
    // Its forces cannot be told: it has no pairs.
    let (code, _, error) = ran(&["forces", &scene]);
    assert_eq!(code, Some(2));
    assert!(error.contains("write it as a linkage"), "{error}");
    let without = r#"{ "dam": 1, "name": "none", "objects": {
        "crank": { "kind": "drive", "motion": { "speed": 1 } } }, "run": { "duration": 1 } }"#;
    let scene = scene_file(folder.path(), without);
    let (code, _, error) = ran(&["kinematics", &scene]);
    assert_eq!(code, Some(2));
    assert!(error.contains("`four_bar`"), "{error}");
}

#[test]
fn what_a_scene_expects_of_its_kinematics_is_judged() {
    let folder = tempfile::tempdir().unwrap();
    let expect = |figure: &str, value: &str| {
        let text = format!(
            r#"}}, "expect": [ {{ "figure": "kinematics.sley.{figure}", "value": {value}, "within": 1e-3 }} ],"#
        );
        scene_file(folder.path(), &SLEY.replace("EXPECT", &text))
    };
    let ratio = "rocker.time_ratio";
    let scene = expect("rocker.displacement.least", "1.6208");
    let (code, _, talk) = ran(&["kinematics", &scene]);
    assert_eq!(code, Some(0), "{talk}");
    assert!(talk.contains("1 of 1 hold"), "{talk}");
    // Another question has no expectations, and a run names the command that judges these.
    let (code, _, talk) = ran(&["kinematics", &scene, "--positions", "10"]);
    assert!(code == Some(0) && !talk.contains("hold"), "{talk}");
    let (code, _, talk) = ran(&["run", &scene]);
    let named = talk.contains("`dam kinematics` judges them");
    assert!(code == Some(0) && named, "{talk}");
    let (code, document, _) = ran(&["kinematics", &expect(ratio, "7"), "--json"]);
    assert_eq!(code, Some(1));
    let document: serde_json::Value = serde_json::from_str(&document).unwrap();
    assert_eq!(document["expect"][0]["holds"], false);
    for (figure, words) in [
        (
            "rocker.time_ratios",
            "did you mean `kinematics.sley.rocker.time_ratio`?",
        ),
        ("wheel.speed.least", "there is no result"),
    ] {
        let (code, _, error) = ran(&["check", &expect(figure, "1")]);
        assert_eq!(code, Some(2));
        assert!(error.contains(words), "{error}");
    }
    let scene = scene_file(
        folder.path(),
        &SLEY.replace(
            "EXPECT",
            r#"}, "expect": [
            { "figure": "kinematics.sly.rocker.stroke", "value": 1, "within": 1 },
            { "figure": "kinematics.sley", "value": 1, "within": 1 } ],"#,
        ),
    );
    let (code, _, error) = ran(&["check", &scene]);
    assert_eq!(code, Some(2));
    for words in ["did you mean `sley`?", "names no result"] {
        assert!(error.contains(words), "{words}: {error}");
    }
    // The rocker turns.
    let (code, _, error) = ran(&["check", &expect("rocker.stroke", r#""5 mm""#)]);
    assert!(
        code == Some(2) && error.contains("5 mm") && error.contains("angle"),
        "{error}"
    );
}

#[test]
fn speeds_beyond_all_numbers_are_not_passed_over() {
    let folder = tempfile::tempdir().unwrap();
    let scene = scene_file(folder.path(), &SLEY.replace("EXPECT", "},"));
    let (code, _, talk) = ran(&["kinematics", &scene, "--speed", "1e300"]);
    assert_eq!(code, Some(1));
    assert!(talk.contains("grow beyond all numbers"), "{talk}");
    let (_, table, _) = ran(&["kinematics", &scene, "--speed", "1e300", "--csv"]);
    let mut cells = table.lines().skip(1).flat_map(|line| line.split(','));
    assert!(cells.clone().any(str::is_empty));
    assert!(cells.all(|cell| cell.is_empty() || cell.parse().is_ok_and(f64::is_finite)));
}

#[test]
fn a_check_tells_how_far_an_input_can_go() {
    let folder = tempfile::tempdir().unwrap();
    let scene = scene_file(folder.path(), FOUR_BAR);
    let (code, text, _) = ran(&["check", &scene]);
    assert_eq!(code, Some(0));
    assert!(text.contains("`bars`: input from -66.4"), "{text}");
    assert!(text.contains("dead-centre position"), "{text}");
}

/// A parallelogram could fold over flat; its position function ends there, and so
/// does what is shown of it.
#[test]
fn a_position_function_that_ends_when_flat_is_shown_up_to_there() {
    let folder = tempfile::tempdir().unwrap();
    let text = SLEY
        .replace("EXPECT", "},")
        .replace("\"300 rpm\"", "1, \"angle\": 1")
        .replace(
            "\"crank\": 0.04, \"coupler\": 0.12",
            "\"crank\": 0.1, \"coupler\": 0.13",
        );
    let scene = scene_file(folder.path(), &text);
    let (code, document, error) = ran(&["kinematics", &scene, "--range", "30:150 deg", "--json"]);
    assert_eq!(code, Some(0), "{error}");
    let document: serde_json::Value = serde_json::from_str(&document).unwrap();
    let limit = |index: usize| document["input"]["limits"][index]["at"].as_f64().unwrap();
    // Where both assemblies meet, lengths rounded by 1e-16 move the place by 1e-8 and more.
    assert!(
        limit(0).abs() < 1e-5 && (limit(1) - PI).abs() < 1e-5,
        "{document}"
    );
    let (_, text, _) = ran(&["check", &scene]);
    assert!(text.contains("`sley`: input from"), "{text}");
}
