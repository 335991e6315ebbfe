//! Loads on outputs and inputs of linkages, over time and position.

use super::{dam, document, system};
use dam::studies::Control;
use dam::studies::run::run;
use serde_json::Value;
use serde_json::json;

/// A slider-crank that a motor without torque leaves to its forces, with more of the linkage's
/// parts, and for so long.
fn free_slider_crank(forces: Value, loads: Value, duration: f64) -> Value {
    let rod = |point: &str, length: f64| json!({ "points": { point: [length, 0] }, "mass": 1, "centre": [0.5 * length, 0], "moment": 0.01 });
    json!({
        "dam": 1, "name": "free slider-crank",
        "objects": {
            "free": { "kind": "drive", "motor": { "inertia": 0, "angle": "40 deg", "torque": { "constant": 0 } } },
            "m": {
                "kind": "linkage", "input": "free", "driver": "O", "start": "40 deg", "ground": { "O": [0, 0] },
                "links": { "crank": rod("A", 0.1), "rod": rod("B", 0.35), "slide": { "mass": 2 } },
                "pairs": {
                    "O": { "revolute": ["ground.O", "crank.origin"] }, "A": { "revolute": ["crank.A", "rod.origin"] },
                    "B": { "revolute": ["rod.B", "slide.origin"] },
                    "guide": { "sliding": { "guide": "ground.O", "block": "slide.origin" } }
                },
                "assembly": { "slide": { "near": [0.4, 0] } }, "forces": forces,
                "outputs": { "ram": { "point": "slide.origin", "loads": loads }, "crank": { "angle": "crank" } }
            }
        },
        "run": { "duration": duration, "tolerance": 1e-11, "start": "on_law", "samples": 200 }
    })
}

fn final_angle(scene: &Value) -> f64 {
    let (system, settings) = system(scene);
    let result = run(&system, &settings, &Control::default(), &mut []).expect("a start");
    assert!(result.is_complete(), "{:?}", result.outcome);
    result.figures.objects["m.crank"].end.displacement
}

/// A force over time on an output is that force on its point.
#[test]
fn loads_on_outputs_are_forces_on_their_points() {
    let force = json!({ "f": { "force": { "point": "slide.origin", "force": [-5, 0] } } });
    let wanted = final_angle(&free_slider_crank(force, json!({}), 0.8));
    for law in [
        json!({ "constant": -5 }),
        json!({ "time_table": [[0, -5], [1, -5]] }),
    ] {
        let found = final_angle(&free_slider_crank(json!({}), json!({ "f": law }), 0.8));
        assert!((found - wanted).abs() < 1e-8, "{found} {wanted}");
    }
    // One that ends half way is another.
    let half = json!({ "f": { "time_table": [[0, -5], [0.4, -5], [0.4001, 0]] } });
    let found = final_angle(&free_slider_crank(json!({}), half, 0.8));
    assert!((found - wanted).abs() > 1e-3, "{found} {wanted}");
}

/// A crank alone under a couple that grows with time, t·1 N·m: q = t³/(6·J).
#[test]
fn a_couple_over_time_accelerates_as_its_integral() {
    let scene = json!({
        "dam": 1, "name": "crank",
        "objects": {
            "free": { "kind": "drive", "motor": { "inertia": 0, "torque": { "constant": 0 } } },
            "m": {
                "kind": "linkage", "input": "free", "driver": "O", "ground": { "O": [0, 0] },
                "links": { "crank": { "mass": 0, "moment": 0.5 } },
                "pairs": { "O": { "revolute": ["ground.O", "crank.origin"] } },
                "outputs": { "crank": { "angle": "crank", "loads": { "t": { "time_table": [[0, 0], [2, 2]] } } } }
            }
        },
        "run": { "duration": 2, "tolerance": 1e-11, "start": "on_law", "samples": 20 }
    });
    assert!((final_angle(&scene) - 8.0 / 3.0).abs() < 1e-9);
}

/// A rotor of 0.5 kg·m² under the couple 3 N·m − q·1 N·m/rad swings about q = 3 rad with √2 rad/s.
#[test]
fn a_couple_over_the_input_is_a_function_of_it() {
    let scene = json!({
        "dam": 1, "name": "crank",
        "objects": {
            "free": { "kind": "drive", "motor": { "inertia": 0, "angle": 2.5, "torque": { "constant": 0 } } },
            "m": {
                "kind": "linkage", "input": "free", "driver": "O", "start": 2.5, "ground": { "O": [0, 0] },
                "links": { "crank": { "mass": 0, "moment": 0.5 } },
                "pairs": { "O": { "revolute": ["ground.O", "crank.origin"] } },
                "forces": { "c": { "couple_table": { "link": "crank", "points": [[0, 3], [6, -3]] } } },
                "outputs": { "crank": { "angle": "crank" } }
            }
        },
        "run": { "duration": 1.7, "tolerance": 1e-11, "start": "on_law", "samples": 20 }
    });
    let wanted = 3.0 - 0.5 * (2f64.sqrt() * 1.7).cos();
    assert!((final_angle(&scene) - wanted).abs() < 1e-9);
    // Its equilibrium is where the couple is zero, with the slope as stiffness.
    let folder = tempfile::tempdir().unwrap();
    let path = folder.path().join("scene.json");
    std::fs::write(&path, scene.to_string()).unwrap();
    let found = document(&[
        "kinematics",
        &path.display().to_string(),
        "--turn",
        "--json",
    ]);
    let equilibria = found["equilibria"].as_array().unwrap();
    let rest = equilibria
        .iter()
        .find(|rest| (rest["input"].as_f64().unwrap() - 3.0).abs() < 1e-9);
    let frequency = rest.unwrap()["angular_frequency"].as_f64().unwrap();
    assert!((frequency - 2f64.sqrt()).abs() < 1e-9, "{frequency}");
}

/// What a run records at an output is what `forces` takes as its load.
#[test]
fn forces_over_a_record_take_the_loads_of_outputs() {
    let folder = tempfile::tempdir().unwrap();
    let write = |name: &str, scene: &Value| {
        let path = folder.path().join(name);
        std::fs::write(&path, scene.to_string()).unwrap();
        path.display().to_string()
    };
    let loaded = free_slider_crank(json!({}), json!({ "f": { "constant": -5 } }), 0.3);
    let loaded = write("loaded.json", &loaded);
    let out = folder.path().join("out").display().to_string();
    let run = dam(&["run", &loaded, "--out", &out]);
    assert_eq!(
        run.status.code(),
        Some(0),
        "{}",
        String::from_utf8_lossy(&run.stderr)
    );
    let record = format!("{out}/record.csv");
    let found = document(&["forces", &loaded, "--record", &record, "--json"]);
    // The motor gives nothing: the drive's moment is zero with the load, and not without it.
    let drives = found["columns"]["drive"]["values"].as_array().unwrap();
    let greatest = drives
        .iter()
        .map(|drive| drive.as_f64().unwrap().abs())
        .fold(0.0, f64::max);
    assert!(greatest < 1e-6, "{greatest}");
    // Over a turn a constant load acts. One over time is missing, and the document says so.
    let turn = |path: &str| {
        document(&["forces", path, "--turn", "--speed", "1 rad/s", "--json"])["warnings"]
            .to_string()
    };
    let warnings = turn(&loaded);
    assert!(!warnings.contains("m.outputs.ram"), "{warnings}");
    let timed = json!({ "f": { "time_table": [[0, -5], [1, -6]] } });
    let timed = write("timed.json", &free_slider_crank(json!({}), timed, 0.3));
    let warnings = turn(&timed);
    assert!(warnings.contains("m.outputs.ram.loads.f"), "{warnings}");
}
