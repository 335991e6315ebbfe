//! The scenes of kinetostatics give the reference's figures, and the program
//! tells them.

use super::{number, reference};
use dam::linkage::kinetostatics::{InputMotion, Kinetostatics};
use dam::lower::lower;
use dam::scene::{BuiltIn, Document, Overrides};
use dam::studies::forces::{
    Course, Extremes, ForceSettings, ForceStudy, Instant, LinkagePositions, ZoneKind,
    only_loaded_output, study,
};
use dam::studies::judgement::Judgement;
use serde_json::Value;
use std::f64::consts::TAU;
use std::path::{Path, PathBuf};
use std::process::{Command, Output};

fn root() -> PathBuf {
    PathBuf::from(env!("CARGO_MANIFEST_DIR"))
}

fn of_scene(name: &str, speed: f64) -> ForceStudy {
    let path = root().join("scenarios/kinetostatics").join(name);
    let bytes = std::fs::read(&path).unwrap();
    let document = Document::parse(name, &bytes).unwrap();
    let reading = document.scene(&BuiltIn, &Overrides::none()).unwrap();
    let model = lower(&reading.scene).unwrap();
    let linkage = &model.linkages[0].linkage;
    let solver = Kinetostatics::new(linkage.spec()).unwrap();
    let course = Course::Even {
        from: 0.0,
        to: TAU,
        count: 24,
        speed,
        acceleration: 0.0,
        closed: true,
    };
    let settings = ForceSettings {
        output: only_loaded_output(&solver),
        ..ForceSettings::default()
    };
    let mut positions = LinkagePositions::new(linkage);
    study(linkage.spec(), &mut positions, course, settings).unwrap()
}

#[test]
fn scenes_are_the_mechanisms_of_the_reference() {
    for (scene, id) in [
        ("slider_crank.json", "paper-rod-mass-ratio0.1"),
        ("slotted_lever.json", "slotted-lever"),
    ] {
        let reference = reference();
        let cases = reference["cases"].as_array().unwrap();
        let case = cases.iter().find(|case| case["id"] == id).unwrap();
        let found = of_scene(scene, number(&case["phi1dot"]));
        let results = case["results"].as_array().unwrap();
        // The end of the turn stands there as well.
        assert_eq!(found.rows.len(), results.len() + 1);
        for ((_, forces), wanted) in found.solved().zip(results) {
            let near = |value: f64, name: &str, scale: f64| {
                let wanted = number(&wanted[name]);
                assert!(
                    (value - wanted).abs() < 1e-9 * scale,
                    "{scene} {name}: {value} {wanted}"
                );
            };
            near(forces.drive, "M1", 30.0);
            near(forces.chi.unwrap(), "chi", 0.06);
            near(forces.balance.loss, "loss_W", 30.0);
            near(forces.transmission.unwrap().ratio, "i", 0.06);
        }
        assert_eq!(found.solved().count(), results.len() + 1);
    }
}

/// Two rockers between dead-centre positions, the second under a couple or not.
fn two_rockers(couple: &str) -> ForceStudy {
    let scene = format!(
        r#"{{ "dam": 1, "name": "two rockers", "run": {{ "duration": 1 }}, "objects": {{
            "drive": {{ "kind": "drive", "motion": {{ "speed": "1 rad/s" }} }},
            "rockers": {{ "kind": "linkage", "input": "drive", "driver": "A",
                "ground": {{ "A": [0, 0], "D": [0.3, 0] }},
                "links": {{ "first": {{ "points": {{ "B": [0.2, 0] }} }}, "rod": {{ "points": {{ "C": [0.15, 0] }} }},
                    "second": {{ "points": {{ "C": [0.17, 0] }} }} }},
                "pairs": {{ "A": {{ "revolute": ["ground.A", "first.origin"] }}, "B": {{ "revolute": ["first.B", "rod.origin"] }},
                    "C": {{ "revolute": ["rod.C", "second.C"] }}, "D": {{ "revolute": ["ground.D", "second.origin"] }} }},
                "assembly": {{ "rod": {{ "angle": "70 deg" }}, "second": {{ "angle": "120 deg" }} }},
                "forces": {{ "load": {{ "couple": {{ "link": "second", "moment": {couple} }} }} }},
                "outputs": {{ "second": {{ "angle": "second" }} }} }} }} }}"#
    );
    let document = Document::parse("two rockers", scene.as_bytes()).unwrap();
    let reading = document.scene(&BuiltIn, &Overrides::none());
    let reading = reading.unwrap_or_else(|faults| panic!("{}", faults.render(false)));
    let model = lower(&reading.scene).unwrap();
    let linkage = &model.linkages[0].linkage;
    let [from, to] = linkage.range().ends();
    let course = Course::Even {
        from,
        to,
        count: 41,
        speed: 1.0,
        acceleration: 0.0,
        closed: false,
    };
    let mut positions = LinkagePositions::new(linkage);
    study(
        linkage.spec(),
        &mut positions,
        course,
        ForceSettings::default(),
    )
    .unwrap()
}

/// Where rod and second rocker lie in one line, the first cannot turn what resists.
#[test]
fn towards_dead_positions_at_the_ends_forces_grow_without_bound() {
    let end = ((0.2f64 * 0.2 + 0.3 * 0.3 - 0.32 * 0.32) / (2.0 * 0.2 * 0.3)).acos();
    let found = two_rockers("-2");
    let zones: Vec<_> = found
        .zones
        .iter()
        .map(|zone| (zone.kind, zone.unbounded))
        .collect();
    let dead = |sides| (ZoneKind::Dead, sides);
    assert_eq!(zones, [dead([false, true]), dead([true, false])]);
    for (zone, sign) in found.zones.iter().zip([-1.0, 1.0]) {
        assert!((zone.from - sign * end).abs() < 1e-9 && zone.from == zone.to);
    }
    assert!(found.rows[0].forces.is_err() && found.rows[40].forces.is_err());
    assert_eq!(found.solved().count(), 39);
    let drive = found
        .extremes
        .iter()
        .find(|one| one.name == "drive")
        .unwrap();
    assert!(drive.least.value.is_infinite() || drive.greatest.value.is_infinite());
    assert!(found.cycle.is_none());
    // Without a load there is nothing that grows.
    let found = two_rockers("0");
    assert!(found.zones.len() == 2 && found.zones.iter().all(|zone| zone.unbounded == [false; 2]));
    let ends = |one: &Extremes| one.least.value.is_finite() && one.greatest.value.is_finite();
    assert!(found.extremes.iter().all(ends));
}

/// A slider-crank that its slider drives, between dead-centre positions at 0.15 m and 0.25 m.
const PISTON: &str = r#"{ "dam": 1, "name": "piston", "run": { "duration": 1 }, "objects": {
    "drive": { "kind": "drive", "coordinate": "sliding", "motion": { "speed": "25 mm/s", "displacement": "0.2 m" } },
    "engine": { "kind": "linkage", "input": "drive", "driver": "guide", "start": "0.2 m",
        "ground": { "O": [0, 0], "G": [0, 0] },
        "links": { "crank": { "points": { "A": [0.05, 0] }, "moment": 0.01 }, "rod": { "points": { "B": [0.2, 0] } },
            "piston": { "mass": 1 } },
        "pairs": { "O": { "revolute": ["ground.O", "crank.origin"] }, "A": { "revolute": ["crank.A", "rod.origin"] },
            "B": { "revolute": ["rod.B", "piston.origin"] },
            "guide": { "sliding": { "guide": "ground.G", "block": "piston.origin" } } },
        "assembly": { "crank": { "angle": "60 deg" } },
        "forces": { "load": { "force": { "point": "piston.origin", "force": [-400, 0] } } },
        "outputs": { "piston": { "point": "piston.origin" } } } } }"#;

fn of_piston(course: Course) -> ForceStudy {
    let document = Document::parse("piston", PISTON.as_bytes()).unwrap();
    let reading = document.scene(&BuiltIn, &Overrides::none()).unwrap();
    let model = lower(&reading.scene).unwrap();
    let linkage = &model.linkages[0].linkage;
    let settings = ForceSettings::default();
    study(
        linkage.spec(),
        &mut LinkagePositions::new(linkage),
        course,
        settings,
    )
    .unwrap()
}

fn sliding([from, to]: [f64; 2], count: usize) -> Course {
    Course::Even {
        from,
        to,
        count,
        speed: 0.025,
        acceleration: 0.0,
        closed: false,
    }
}

/// However long the course is, and on whichever side of it: at a dead-centre position the crank, which
/// has inertia, is driven with any angular acceleration.
#[test]
fn no_course_has_forces_at_a_dead_position_that_ends_the_reach() {
    for (at, inwards) in [(0.25, -1.0), (0.15, 1.0)] {
        // Ranges over the reach keep off its ends by a millionth of it.
        for off in [0.0, 1e-7] {
            let end = at + inwards * off;
            let alone = of_piston(sliding([end; 2], 1));
            assert!(alone.rows.len() == 1 && alone.solved().next().is_none());
            assert_eq!(alone.zones[0].unbounded, [inwards < 0.0, inwards > 0.0]);
            for length in [0.09, 0.02, 1e-3, 1e-5] {
                let far = at + inwards * length;
                for (course, without) in [([far, end], 10), ([end, far], 0)] {
                    let found = of_piston(sliding(course, 11));
                    let solved = found.rows.iter().map(|row| row.forces.is_ok());
                    let expected = (0..11).map(|row| row != without);
                    assert!(solved.eq(expected), "{course:?}");
                    let drive = found.extremes.iter().find(|one| one.name == "A.force");
                    assert!(drive.unwrap().greatest.value.is_infinite(), "{course:?}");
                    assert!(found.cycle.is_none());
                    assert_eq!(found.judgement(), Judgement::NotInWorkingOrder);
                    assert!(
                        found
                            .warnings()
                            .iter()
                            .any(|one| one.contains("dead-centre position"))
                    );
                }
            }
        }
        // A position beside it has forces: those of the crank's inertia, and the load.
        let beside = of_piston(sliding([at + inwards * 1e-6; 2], 1));
        assert_eq!(beside.solved().count(), 1);
        assert_eq!(beside.judgement(), Judgement::InWorkingOrder);
    }
}

/// A motion over time that turns back at the dead-centre position, and one that ends there.
#[test]
fn a_motion_over_time_has_no_forces_where_it_touches_a_dead_position() {
    // Cubics between instants go a little beyond the motion.
    let (rate, stroke) = (std::f64::consts::PI, 0.05 * (1.0 - 1e-7));
    let instant = |time: f64| Instant {
        motion: InputMotion {
            coordinate: 0.2 + stroke * (rate * time).sin(),
            speed: stroke * rate * (rate * time).cos(),
            acceleration: -stroke * rate * rate * (rate * time).sin(),
        },
        ..Instant::default()
    };
    for count in [11, 21] {
        let times: Vec<f64> = (0..count).map(|k| 0.05 * f64::from(k)).collect();
        let found = of_piston(Course::Instants {
            instants: times.iter().map(|time| instant(*time)).collect(),
            times,
            closed: false,
        });
        let without = found.rows.iter().filter(|row| row.forces.is_err());
        let without: Vec<f64> = without.filter_map(|row| row.time).collect();
        assert_eq!(without, [0.5]);
        let dead = &found.zones[0];
        assert_eq!((found.zones.len(), dead.kind), (1, ZoneKind::Dead));
        assert_eq!([dead.from, dead.to], [0.5; 2]);
        assert!(dead.unbounded[0]);
        assert_eq!(found.judgement(), Judgement::NotInWorkingOrder);
    }
}

#[test]
fn the_program_says_that_forces_at_a_dead_position_grow_without_bound() {
    let folder = tempfile::tempdir().unwrap();
    std::fs::write(folder.path().join("piston.json"), PISTON).unwrap();
    for (range, code) in [("0.25:0.25 m", 1), ("0.23:0.25 m", 0), ("0.15:0.2 m", 0)] {
        let asked = [
            "forces",
            "piston.json",
            "--range",
            range,
            "--positions",
            "9",
        ];
        let out = dam(&asked, folder.path());
        assert_eq!(out.status.code(), Some(code), "{out:?}");
        let text = String::from_utf8(out.stdout).unwrap();
        assert!(text.contains("Not in working order."), "{text}");
        assert!(!text.contains("GN") && text.contains("forces unbounded towards"));
        let said = String::from_utf8(out.stderr).unwrap();
        assert!(said.contains("towards which forces grow without bound"));
        // So do speeds, but that of the input.
        let out = dam(&[&["kinematics"], &asked[1..]].concat(), folder.path());
        let text = String::from_utf8(out.stdout).unwrap();
        let row = |name: &str| {
            let mut rows = text
                .lines()
                .filter(|line| line.trim_start().starts_with(name));
            rows.next().unwrap_or_default().contains("unbounded")
        };
        assert!(row("links.crank.angular_speed") && row("links.rod.angular_speed"));
        assert!(!row("input.speed") && !row("links.crank.angle "));
    }
}

fn dam(arguments: &[&str], folder: &Path) -> Output {
    Command::new(env!("CARGO_BIN_EXE_dam"))
        .args(arguments)
        .current_dir(folder)
        .output()
        .unwrap()
}

fn scene(name: &str) -> String {
    let path = root().join("scenarios/kinetostatics").join(name);
    path.display().to_string()
}

#[test]
fn the_program_tells_forces_as_text_table_document_and_page() {
    let folder = tempfile::tempdir().unwrap();
    let scene = scene("slider_crank.json");
    let text = dam(
        &[
            "forces",
            &scene,
            "--compare-massless",
            "0.1,10",
            "--out",
            "out",
        ],
        folder.path(),
    );
    assert_eq!(text.status.code(), Some(0), "{text:?}");
    let text = String::from_utf8(text.stdout).unwrap();
    for part in [
        "Extremes",
        "self-locking",
        "shaking force",
        "Massless",
        "R12.force",
        "χ",
    ] {
        assert!(text.contains(part), "{part} missing in {text}");
    }
    let page = std::fs::read_to_string(folder.path().join("out/report.html")).unwrap();
    assert!(page.contains("class=\"moving\"") && page.contains("class=\"first\""));
    assert!(!page.contains("NaN"));
    let json = dam(
        &["forces", &scene, "--json", "--positions", "24"],
        folder.path(),
    );
    let json: Value = serde_json::from_slice(&json.stdout).unwrap();
    assert_eq!(
        // Both ends of the turn are rows.
        json["columns"]["drive"]["values"].as_array().unwrap().len(),
        25
    );
    assert_eq!(json["convention"], "paper");
    let csv = dam(
        &["forces", &scene, "--csv", "--positions", "24"],
        folder.path(),
    );
    let csv = String::from_utf8(csv.stdout).unwrap();
    assert_eq!(csv.lines().count(), 26);
    assert!(csv.starts_with("coordinate [rad],speed [rad/s]"), "{csv}");
    assert!(csv.contains(",chi (paper) [m],"), "{csv}");
}

/// Forces over the motion in a run's record are those over the drive's time.
#[test]
fn a_record_gives_the_motion() {
    let folder = tempfile::tempdir().unwrap();
    let scene = scene("slotted_lever.json");
    let run = dam(
        &["run", &scene, "--set", "run.samples=10", "--out", "run"],
        folder.path(),
    );
    assert_eq!(run.status.code(), Some(0), "{run:?}");
    let drives = |more: &[&str]| -> Vec<f64> {
        let mut arguments = vec!["forces", &scene, "--json"];
        arguments.extend(more);
        let json: Value = serde_json::from_slice(&dam(&arguments, folder.path()).stdout).unwrap();
        let values = json["columns"]["drive"]["values"].as_array().unwrap();
        values.iter().map(number).collect()
    };
    let of_record = drives(&["--record", "run/record.csv"]);
    let of_time = drives(&["--time", "--positions", "10"]);
    assert_eq!(of_record.len(), 11);
    for (a, b) in of_record.iter().zip(&of_time) {
        assert!((a - b).abs() < 1e-8, "{a} {b}");
    }
}

/// With an elastic slide behind the linkage the driving moment of the run, found
/// on the reduced coordinate, is that of the free-body equations.
#[test]
fn what_hangs_behind_is_among_the_loads() {
    let folder = tempfile::tempdir().unwrap();
    let text = std::fs::read_to_string(scene("slotted_lever.json")).unwrap();
    let behind = r#""table": { "kind": "rocker", "input": "mechanism.lever",
        "position": { "ratio": 2 }, "inertia": 0.3, "stiffness": 2e4, "damping_capacity": 0.3,
        "masses": 2, "loads": { "work": { "constant": -5 } } },
      "drive":"#;
    let mut text = text
        .replacen("\"drive\":", behind, 1)
        .replace("0.1\n        },", "0\n },");
    text = text.replace("\"friction\": 0.1", "\"friction\": 0");
    let start = text.find("\"expect\"").unwrap();
    let text = format!("{} }}", text[..start].trim_end().trim_end_matches(','));
    std::fs::write(folder.path().join("scene.json"), text).unwrap();
    let run = dam(
        &[
            "run",
            "scene.json",
            "--set",
            "run.samples=40",
            "--out",
            "run",
        ],
        folder.path(),
    );
    assert_eq!(run.status.code(), Some(0), "{run:?}");
    let found = dam(
        &[
            "forces",
            "scene.json",
            "--json",
            "--record",
            "run/record.csv",
        ],
        folder.path(),
    );
    assert_eq!(found.status.code(), Some(0), "{found:?}");
    let found: Value = serde_json::from_slice(&found.stdout).unwrap();
    let record = std::fs::read_to_string(folder.path().join("run/record.csv")).unwrap();
    let mut lines = record.lines();
    let head = lines.next().unwrap();
    let column = |name: &str| {
        head.split(',')
            .position(|cell| cell.starts_with(name))
            .unwrap()
    };
    let reaction = column("mechanism.reaction");
    assert!(head.contains("mechanism.lever.reaction"));
    let drives = found["columns"]["drive"]["values"].as_array().unwrap();
    assert_eq!(drives.len(), 41);
    for (line, drive) in lines.zip(drives) {
        let wanted: f64 = line.split(',').nth(reaction).unwrap().parse().unwrap();
        let drive = number(drive);
        assert!(
            (drive + wanted).abs() < 1e-7 * (1.0 + drive.abs()),
            "{drive} {wanted}"
        );
    }
}

#[test]
fn what_cannot_be_answered_is_said() {
    let folder = tempfile::tempdir().unwrap();
    let scene = scene("slider_crank.json");
    let refused = |more: &[&str], words: &str| {
        let mut arguments = vec!["forces", &scene];
        arguments.extend(more);
        let output = dam(&arguments, folder.path());
        assert_eq!(output.status.code(), Some(2), "{more:?}");
        let text = String::from_utf8_lossy(&output.stderr).into_owned();
        assert!(text.contains(words), "{more:?}: {text}");
    };
    refused(&["--load", "ram"], "there is no output `ram`; one of slide");
    refused(
        &["--load", "slide=wind"],
        "there is no force `wind`; one of load",
    );
    refused(
        &["--compare-massless", "0.1,-4"],
        "-4 is not a number above zero",
    );
    refused(&["--record", "nothing.csv"], "cannot read the record");
    refused(&["--speed", "3 m"], "--speed");
    refused(&["--speed", "0"], "--direction forwards or backwards");
    // Locked positions are told and end with status 1.
    let all = ["R01", "R12", "R23", "P03"];
    let sets: Vec<String> = all
        .iter()
        .map(|pair| format!("mechanism.pairs.{pair}.friction=1.3"))
        .collect();
    let mut arguments = vec![
        "forces",
        &scene,
        "--range",
        "150:210 deg",
        "--positions",
        "30",
    ];
    for set in &sets {
        arguments.extend(["--set", set]);
    }
    let output = dam(&arguments, folder.path());
    assert_eq!(output.status.code(), Some(1), "{output:?}");
    let text = String::from_utf8_lossy(&output.stdout).into_owned();
    assert!(
        text.contains("locked: no driving force overcomes friction"),
        "{text}"
    );
}

#[test]
fn what_a_scene_expects_of_its_forces_is_judged() {
    let folder = tempfile::tempdir().unwrap();
    let forces = |text: String| {
        std::fs::write(folder.path().join("scene.json"), text).unwrap();
        let output = dam(&["forces", "scene.json"], folder.path());
        let talk = String::from_utf8_lossy(&output.stderr).into_owned();
        (output.status.code(), talk)
    };
    let text = std::fs::read_to_string(scene("slider_crank.json")).unwrap();
    let (code, talk) = forces(text.clone());
    assert_eq!(code, Some(0), "{talk}");
    assert!(talk.contains("14 of 14 hold"), "{talk}");
    let (code, talk) = forces(text.replace("66.262843", "66.2629"));
    assert_eq!(code, Some(1), "{talk}");
    assert!(
        talk.contains("expectation failed: forces.mechanism.drive.greatest"),
        "{talk}"
    );
    let (code, talk) = forces(text.replace("drive.greatest\"", "drive.greatst\""));
    assert_eq!(code, Some(2), "{talk}");
    assert!(
        talk.contains("did you mean `forces.mechanism.drive.greatest`?"),
        "{talk}"
    );
}

/// Under a law of the drive the forces go with the time, from rest on; over one
/// turn they sum up like those over the turn.
#[test]
fn a_law_of_the_drive_gives_the_motion() {
    let folder = tempfile::tempdir().unwrap();
    let scene = scene("slotted_lever.json");
    let law = r#"drive.motion={"run_up": {"speed": "200 rpm", "time": "0.5 s"}}"#;
    let output = dam(
        &["forces", &scene, "--time", "0.5 s", "--set", law],
        folder.path(),
    );
    assert_eq!(output.status.code(), Some(0), "{output:?}");
    let cycle = |over: &[&str]| -> Value {
        let mut arguments = vec!["forces", &scene, "--json"];
        arguments.extend(over);
        let found: Value = serde_json::from_slice(&dam(&arguments, folder.path()).stdout).unwrap();
        found["cycle"].clone()
    };
    let period = (TAU / 12.0).to_string();
    let (of_time, of_turn) = (cycle(&["--time", &period]), cycle(&["--turn"]));
    assert_eq!(of_time["closed"], true);
    for name in ["loss", "drive_work", "rms_drive", "duration"] {
        let (a, b) = (number(&of_time[name]), number(&of_turn[name]));
        assert!((a - b).abs() < 1e-9 * b.abs(), "{name}: {a} {b}");
    }
    assert_eq!(
        of_time["efficiency"].is_null(),
        of_turn["efficiency"].is_null()
    );
}

/// A table of forces between two positions, and one across the end of the turn.
#[test]
fn tables_narrower_than_the_distance_of_positions_are_met() {
    for (first, width) in [(100.03f64, 0.5f64), (200.0, 0.02), (359.8, 0.15)] {
        let ends = [first, first + width / 2.0, first + width];
        let text = format!(
            r#"{{ "dam": 1, "name": "press", "objects": {{
                "shaft": {{ "kind": "drive", "motion": {{ "speed": 2 }} }},
                "press": {{ "kind": "linkage", "input": "shaft", "driver": "O", "ground": {{ "O": [0, 0] }},
                    "links": {{ "crank": {{ "points": {{ "A": [0.08, 0] }} }},
                                "rod": {{ "points": {{ "B": [0.4, 0] }} }}, "ram": {{ "mass": 0 }} }},
                    "pairs": {{ "O": {{ "revolute": ["ground.O", "crank.origin"] }},
                                "A": {{ "revolute": ["crank.A", "rod.origin"] }},
                                "B": {{ "revolute": ["rod.B", "ram.origin"] }},
                                "g": {{ "sliding": {{ "guide": "ground.O", "block": "ram.origin" }} }} }},
                    "assembly": {{ "ram": {{ "near": [0.48, 0] }} }},
                    "forces": {{ "w": {{ "couple_table": {{ "link": "crank", "period": "1 rev",
                        "points": [["{} deg", 0], ["{} deg", -1800], ["{} deg", 0]] }} }} }},
                    "outputs": {{ "ram": {{ "point": "ram.origin" }} }} }} }},
              "run": {{ "duration": 4 }} }}"#,
            ends[0], ends[1], ends[2]
        );
        let scene = dam::Scene::from_json(&text).unwrap();
        let found = scene.forces(&Default::default()).unwrap();
        let drive = found.extremes.iter().find(|one| one.name == "drive");
        // The driver bears the couple alone, and the work of a triangle.
        approx::assert_relative_eq!(drive.unwrap().greatest.value, 1800.0, max_relative = 1e-9);
        let work = 0.5 * 1800.0 * width.to_radians();
        let cycle = found.cycle.as_ref().unwrap();
        approx::assert_relative_eq!(cycle.drive_work, work, max_relative = 1e-9);
    }
}
