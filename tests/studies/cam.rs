//! Cams of scenes: against independent figures, as files and on the command line.

use dam::cam::DiscCam;
use dam::cam::closing::LetsGo;
use dam::cam::sizing::PressureLimits;
use dam::lower::lower;
use dam::report::cam::{curves, cycle_rows, dxf, polygon_rows};
use dam::scene::{BuiltIn, Document, Overrides, Reading};
use dam::studies::cam::{CamForce, ElasticContact, Question, Reserve, disc_cam, figures};
use dam::studies::{Control, RunSettings};
use dam::system::System;
use serde_json::Value;
use std::path::PathBuf;
use std::process::{Command, Output};

fn root() -> PathBuf {
    PathBuf::from(env!("CARGO_MANIFEST_DIR"))
}

fn scene_path(name: &str) -> String {
    let path = root().join(format!("scenarios/cams/{name}.json"));
    path.display().to_string()
}

struct Machine {
    reading: Reading,
    system: System,
}

fn machine(name: &str, overrides: &[&str]) -> Machine {
    let bytes = std::fs::read(scene_path(name)).unwrap();
    let document = Document::parse(name, &bytes).unwrap();
    let overrides = Overrides::new(overrides.iter().map(|one| (*one).to_owned()));
    let reading = document.scene(&BuiltIn, &overrides).unwrap();
    let system = System::new(lower(&reading.scene).unwrap()).unwrap();
    Machine { reading, system }
}

impl Machine {
    fn cam(&self, id: &str) -> DiscCam {
        disc_cam(&self.reading.scene, self.system.model(), id).unwrap()
    }

    fn index(&self, id: &str) -> usize {
        let objects = &self.system.model().objects;
        objects.iter().position(|part| part.id == id).unwrap()
    }
}

fn question() -> Question {
    Question {
        pressure: PressureLimits {
            outward: 0.6,
            inward: 0.6,
        },
        roller_factor: 0.7,
        least_radius: 0.0,
        reserve: Reserve::Share(0.2),
    }
}

#[track_caller]
fn close(found: f64, expected: &Value, what: &str) {
    let expected = expected.as_f64().unwrap();
    let error = (found - expected).abs();
    assert!(error <= 1e-9 * expected.abs(), "{what}: {found} {expected}");
}

#[test]
fn cams_have_the_figures_of_independent_constructions() {
    let text = include_str!("../reference/cams.json");
    let reference: Value = serde_json::from_str(text).unwrap();
    for (name, id) in [
        ("eccentric_jump", "follower"),
        ("yarn_traverse", "guide"),
        ("flat_tappet", "valve"),
        ("indexing_dwells", "table"),
    ] {
        let machine = machine(name, &[]);
        let cam = machine.cam(id);
        let force = CamForce::new(machine.system.model(), machine.index(id), &cam, None).unwrap();
        let found = figures(&cam, &question(), Ok(&force)).unwrap();
        let force = found.force.unwrap();
        let expected = reference[name]["cam"].as_object().unwrap();
        for (key, value) in expected {
            let lets_go = || match force.lets_go {
                Some(LetsGo::At(at)) => at.value,
                other => panic!("{name}: {other:?}"),
            };
            let found = match key.as_str() {
                "lets_go" => lets_go(),
                "lets_go_rpm" => lets_go() * 60.0 / std::f64::consts::TAU,
                "profile_convex" => found.profiles[0].convex.unwrap().value,
                "pitch_convex" => found.pitch.unwrap().convex.unwrap().value,
                "needed_width" => found.face.unwrap().needed_width,
                "pressure_greatest" => found.pressure[1].value,
                "pressure_least" => found.pressure[0].value,
                "margin" => force.margin.value,
                "torque" => force.torque.value,
                other => panic!("{other}"),
            };
            close(found, value, &format!("{name} {key}"));
        }
    }
}

/// Flat face, the profile's radius R + U + U″; steel on steel, 15 mm wide.
#[test]
fn the_pressure_on_a_flat_tappet_is_that_of_the_closed_form() {
    let machine = machine("flat_tappet", &[]);
    let cam = machine.cam("valve");
    let index = machine.index("valve");
    let force = CamForce::new(machine.system.model(), index, &cam, None).unwrap();
    let found = figures(&cam, &question(), Ok(&force)).unwrap();
    let found = found.force.unwrap().pressure.expect("a pressure");
    let omega = 3000.0 * std::f64::consts::TAU / 60.0;
    let modulus = 206e9 / (2.0 * (1.0 - 0.3 * 0.3));
    let mut greatest: f64 = 0.0;
    for piece in cam.motion().pieces() {
        for share in 0..=20_000 {
            let phi = piece.from + f64::from(share) / 20_000.0 * (piece.to - piece.from);
            let state = cam.at(piece, phi);
            let load = 0.1 * state.second * omega * omega + 160.0 + 25e3 * state.lift;
            let radius = 0.017 + state.lift + state.second;
            let square = load / 0.015 * modulus / (std::f64::consts::PI * radius);
            greatest = greatest.max(square.sqrt());
        }
    }
    approx::assert_relative_eq!(found.value, greatest, max_relative = 1e-7);
}

#[test]
fn the_follower_of_the_eccentric_jumps_at_52_30_rpm_in_runs_too() {
    let margin = |rpm: f64| {
        let machine = machine("eccentric_jump", &[&format!("cam.motion.speed={rpm} rpm")]);
        let settings = RunSettings::of(&machine.reading.scene).unwrap();
        let object = machine.index("follower");
        let contact = ElasticContact {
            system: &machine.system,
            object,
            settings: &settings,
            control: &Control::default(),
        };
        contact.force().unwrap().least.value
    };
    // By the formula 52.3037 rpm for a rigid follower; on 1 kN/mm the jump moves by less than 1e-5 of it.
    assert!(margin(52.295) > 0.0);
    assert_eq!(margin(52.312), 0.0);
}

/// Code and value of every pair of a DXF file.
fn pairs(text: &str) -> Vec<(i32, String)> {
    assert!(text.ends_with("EOF\r\n"));
    let lines: Vec<&str> = text.split("\r\n").collect();
    let lines = &lines[..lines.len() - 1];
    assert_eq!(lines.len() % 2, 0, "a value for every code");
    let pair = |two: &[&str]| (two[0].trim().parse().unwrap(), two[1].to_owned());
    lines.chunks(2).map(pair).collect()
}

/// Polylines of a DXF file: layer, closed, points (mm). Checks the structure
/// that readers of release 12 rely on.
fn polylines(text: &str) -> Vec<(String, bool, Vec<[f64; 2]>)> {
    let pairs = pairs(text);
    let mut sections = Vec::new();
    let mut open = false;
    let mut found: Vec<(String, bool, Vec<[f64; 2]>)> = Vec::new();
    let mut entity = String::new();
    let mut inside = false;
    let mut layers = Vec::new();
    for (index, (code, value)) in pairs.iter().enumerate() {
        match (code, value.as_str()) {
            (0, "SECTION") => {
                assert!(!open, "sections do not nest");
                open = true;
                sections.push(pairs[index + 1].1.clone());
            }
            (0, "ENDSEC") => open = false,
            (0, name) => {
                if name == "POLYLINE" {
                    assert!(!inside);
                    inside = true;
                    found.push((String::new(), false, Vec::new()));
                }
                if name == "SEQEND" {
                    assert!(inside);
                    inside = false;
                }
                assert!(name != "VERTEX" || inside, "a vertex belongs to a polyline");
                entity = name.to_owned();
            }
            (2, name) if entity == "LAYER" => layers.push(name.to_owned()),
            (8, layer) => {
                assert!(layers.iter().any(|known| known == layer), "layer {layer}");
                if entity == "POLYLINE" {
                    found.last_mut().unwrap().0 = layer.to_owned();
                }
            }
            (66, flag) if entity == "POLYLINE" => assert_eq!(flag, "1", "vertices follow"),
            (70, flag) if entity == "POLYLINE" => found.last_mut().unwrap().1 = flag == "1",
            (10, x) if entity == "VERTEX" => {
                let y = pairs[index + 1].1.parse().unwrap();
                assert_eq!(pairs[index + 1].0, 20);
                found.last_mut().unwrap().2.push([x.parse().unwrap(), y]);
            }
            _ => {}
        }
    }
    assert!(!open && !inside);
    assert_eq!(sections, ["HEADER", "TABLES", "ENTITIES"]);
    assert!(pairs.contains(&(1, "AC1009".to_owned())));
    found
}

#[test]
fn the_dxf_file_holds_the_curves_in_millimetres() {
    let machine = machine("indexing_dwells", &[]);
    let cam = machine.cam("table");
    let curves = curves(&cam, 1e-6, Some(0.012)).unwrap();
    let names: Vec<&str> = curves.iter().map(|curve| curve.name.as_str()).collect();
    assert_eq!(names, ["profile", "pitch", "cutter"]);
    let found = polylines(&dxf(&curves, 0.03));
    assert_eq!(found.len(), 3);
    for ((layer, closed, points), curve) in found.iter().zip(&curves) {
        assert_eq!(*layer, curve.name.to_uppercase());
        assert!(*closed);
        assert_eq!(points.len(), curve.polygon.points.len());
        for (a, b) in points.iter().zip(&curve.polygon.points) {
            assert!((a[0] - 1e3 * b[0]).abs() < 1e-6 && (a[1] - 1e3 * b[1]).abs() < 1e-6);
        }
    }
    let csv = polygon_rows(&curves).csv();
    let rows: usize = curves.iter().map(|curve| curve.polygon.points.len()).sum();
    assert_eq!(csv.lines().count(), 1 + rows);
    // A cutter that cannot reach into the hollow of the profile is refused.
    let fault = dam::report::cam::curves(&cam, 1e-6, Some(0.06)).unwrap_err();
    assert!(fault.hint.contains("0.056496"), "{fault:?}");
}

#[test]
fn a_groove_has_two_flanks_a_rollers_diameter_apart() {
    let machine = machine("yarn_traverse", &[]);
    let cam = machine.cam("guide");
    let list = curves(&cam, 1e-6, Some(0.006)).unwrap();
    let names: Vec<&str> = list.iter().map(|curve| curve.name.as_str()).collect();
    assert_eq!(
        names,
        [
            "inner_flank",
            "outer_flank",
            "pitch",
            "cutter_inner",
            "cutter_outer"
        ]
    );
    let lengths: Vec<f64> = list.iter().map(|curve| curve.polygon.length()).collect();
    // Parallel curves of a closed convex curve differ by 2π times their distance.
    let tau = std::f64::consts::TAU;
    for (index, offset) in [(0, -0.01), (1, 0.01), (3, -0.004), (4, 0.004)] {
        let expected = lengths[2] + tau * offset;
        assert!((lengths[index] - expected).abs() < 2e-5, "{}", names[index]);
    }
    assert!(curves(&cam, 1e-6, Some(0.011)).is_err());
}

#[test]
fn force_and_torque_are_those_of_the_motion() {
    // The work of the torque over a turn is nothing, and where the follower
    // dwells the force is the spring's.
    let machine = machine("indexing_dwells", &[]);
    let cam = machine.cam("table");
    let force = CamForce::new(machine.system.model(), machine.index("table"), &cam, None).unwrap();
    let pieces = cam.motion().pieces();
    let mut work = 0.0;
    for piece in pieces {
        let count = 2000;
        let step = (piece.to - piece.from) / f64::from(count);
        for index in 0..count {
            let phi = piece.from + (f64::from(index) + 0.5) * step;
            work += step * force.at_within_piece(phi, piece.from, piece.to)[2];
        }
    }
    assert!(work.abs() < 1e-6, "{work}");
    let dwell = cam.motion().piece_at(1.5).0;
    let [along, normal, torque] = force.at_within_piece(1.5, dwell.from, dwell.to);
    let expected = 3.0 + 8.0 * 10f64.to_radians();
    approx::assert_relative_eq!(along, expected, max_relative = 1e-13);
    let lever = cam.at(dwell, 1.5).lever;
    approx::assert_relative_eq!(normal, expected / lever, max_relative = 1e-13);
    assert!(torque.abs() < 1e-15);
    let csv = cycle_rows(&cam, "rad", Some(&force), 90).csv();
    assert!(csv.starts_with("phi [rad],s [rad],s1 [rad/rad]"), "{csv}");
    assert!(csv.lines().all(|line| line.split(',').count() == 11));
}

#[test]
fn loads_and_followers_behind_the_cam_are_carried() {
    // A window of force, a viscous load and a rigid slide behind a lever ratio of 2:
    // by hand P = (J + m·4)·q″ω² + b·q′ω − W(φ) + preload + rate·q.
    let text = r#"{ "dam": 1, "name": "carried", "objects": {
        "cam": { "kind": "drive", "motion": { "speed": 20 } },
        "follower": { "kind": "cam_follower", "input": "cam", "motion": "sliding",
          "position": { "sine": { "amplitude": 0.01, "phase": "-90 deg", "offset": 0.01 } },
          "cam": { "base_radius": 0.03, "contact": { "roller": 0.008 } },
          "inertia": 0.5, "masses": 0,
          "loads": { "spring": { "spring": { "rate": 3000, "preload": 40 } }, "damper": { "viscous": 5 },
                     "cut": { "window": { "from": 1, "to": 2, "force": -25 } }, "rub": { "friction": { "force": 2, "width": 0.1 } } } },
        "slide": { "kind": "slider", "input": "follower", "position": { "ratio": 2 }, "inertia": 0.25, "masses": 0,
          "loads": { "pull": { "constant": -3 } } } },
      "run": { "duration": 1 } }"#;
    let document = Document::parse("carried", text.as_bytes()).unwrap();
    let reading = document.scene(&BuiltIn, &Overrides::none()).unwrap();
    let model = lower(&reading.scene).unwrap();
    let cam = disc_cam(&reading.scene, &model, "follower").unwrap();
    let index = model
        .objects
        .iter()
        .position(|part| part.id == "follower")
        .unwrap();
    let force = CamForce::new(&model, index, &cam, None).unwrap();
    for phi in [0.5f64, 1.5, 1.999, 2.5, 4.0] {
        let (q, q1, q2) = (0.01 - 0.01 * phi.cos(), 0.01 * phi.sin(), 0.01 * phi.cos());
        let cut = if (1.0..2.0).contains(&phi) { 25.0 } else { 0.0 };
        let expected =
            (0.5 + 4.0 * 0.25) * q2 * 400.0 + 5.0 * q1 * 20.0 + cut + 2.0 * 3.0 + 40.0 + 3000.0 * q;
        let (piece, _) = cam.motion().piece_at(phi);
        let found = force.at_within_piece(phi, piece.from, piece.to)[0];
        approx::assert_relative_eq!(found, expected, max_relative = 1e-12);
    }
    let found = figures(&cam, &question(), Ok(&force))
        .unwrap()
        .force
        .unwrap();
    assert!(
        found.notes.iter().any(|note| note.contains("friction")),
        "{:?}",
        found.notes
    );
    assert_eq!(found.springs, ["follower.loads.spring"]);
}

fn dam(arguments: &[&str]) -> Output {
    Command::new(env!("CARGO_BIN_EXE_dam"))
        .args(arguments)
        .output()
        .unwrap()
}

#[test]
fn the_command_answers_in_every_form() {
    let scene = scene_path("indexing_dwells");
    let text = |more: &[&str]| {
        let output = dam(&[&["cam", &scene, "--quiet"], more].concat());
        let said = String::from_utf8_lossy(&output.stderr).into_owned();
        assert_eq!(output.status.code(), Some(0), "{said}");
        String::from_utf8(output.stdout).unwrap()
    };
    let words: Vec<String> = text(&[]).split_whitespace().map(str::to_owned).collect();
    assert!(words.join(" ").contains("lift-off, rigid 461.8 rpm"));
    assert!(text(&["--form", "svg"]).starts_with("<svg"));
    assert!(text(&["--form", "cycle"]).starts_with("phi [rad]"));
    assert!(text(&["--form", "profile", "--cutter", "10 mm"]).contains("\ncutter,"));
    let coarse = polylines(&text(&["--form", "dxf", "--tolerance", "0.1 mm"]));
    let fine = polylines(&text(&["--form", "dxf", "--tolerance", "1 um"]));
    assert!(fine[0].2.len() > 5 * coarse[0].2.len());
    let json: Value = serde_json::from_str(&text(&["--json", "--speed", "470 rpm"])).unwrap();
    assert!(json["cam"]["force"]["margin"]["value"].as_f64().unwrap() < 0.0);
    assert_eq!(json["curves"][0]["name"], "profile");
    let jump = scene_path("eccentric_jump");
    let output = dam(&["cam", &jump, "--lift-off", "--json", "--quiet"]);
    let json: Value = serde_json::from_slice(&output.stdout).unwrap();
    let said = String::from_utf8(dam(&["cam", &jump]).stdout).unwrap();
    assert!(said.contains("less than the reserve"), "{said}");
    let elastic = json["cam"]["force"]["elastic"]["at"].as_f64().unwrap();
    assert!((elastic / 30f64.sqrt() - 1.0).abs() < 1e-3, "{elastic}");
    let folder = tempfile::tempdir().unwrap();
    let out = folder.path().display().to_string();
    text(&["--out", &out]);
    let page = std::fs::read_to_string(folder.path().join("report.html")).unwrap();
    for part in [
        "data-link=\"0\"",
        "data-link=\"1\"",
        "id=\"cam-data\"",
        "Least preload",
    ] {
        assert!(page.contains(part), "{part}");
    }
    assert!(!page.contains("NaN") && !page.contains("http://localhost"));
}

#[test]
fn the_command_refuses_in_words() {
    let refused = |arguments: &[&str], words: &str| {
        let output = dam(arguments);
        let said = String::from_utf8_lossy(&output.stderr).into_owned();
        assert_eq!(output.status.code(), Some(2), "{said}");
        assert!(said.contains(words), "{said}");
    };
    let scene = scene_path("indexing_dwells");
    refused(&["cam", &scene, "--object", "tabel"], "these do: table");
    refused(
        &["cam", &scene, "--set", "table.cam.base_radius=0.2"],
        "between 0.012 m and ",
    );
    refused(
        &["cam", &scene, "--pressure-angle", "95 deg"],
        "pressure-angle",
    );
    refused(&["cam", &scene, "--roller-factor", "1.5"], "roller-factor");
    refused(&["cam", &scene, "--tolerance", "0 mm"], "tolerance");
    refused(&["cam", &scene, "--cutter", "60 mm"], "0.056496");
    refused(
        &["cam", &scene, "--set", "table.cam.positive=\"inward\""],
        "towards the cam",
    );
    refused(
        &["cam", &scene, "--set", "table.cam.base_radius=1e300"],
        "1e300 m",
    );
    let output = dam(&["cam", &scene, "--speed", "1e300 rad/s"]);
    let said = String::from_utf8_lossy(&output.stdout).into_owned();
    assert!(
        said.contains("not known: the forces are no numbers"),
        "{said}"
    );
    let without = root()
        .join("scenarios/rocker/two_masses.json")
        .display()
        .to_string();
    refused(&["cam", &without], "base_radius");
    let groove = scene_path("yarn_traverse");
    refused(&["cam", &groove, "--lift-off"], "closed by force");
}
