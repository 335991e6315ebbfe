//! `dam forces` at chosen positions: the table of reactions, and the words about a single position.

use serde_json::Value;
use std::process::{Command, Output};

/// A slider-crank without masses and friction: the rod is a member of two forces.
const SCENE: &str = r#"{ "dam": 1, "name": "Press", "objects": {
    "drive": { "kind": "drive", "motion": { "speed": "10 rad/s" } },
    "press": { "kind": "linkage", "input": "drive", "driver": "R01",
        "ground": { "O": [0, 0] },
        "links": { "crank": { "points": { "A": ["60 mm", 0] } }, "rod": { "points": { "C": ["300 mm", 0] } },
            "slide": { "mass": "1 g" } },
        "pairs": {
            "R01": { "revolute": ["ground.O", "crank.origin"] },
            "R12": { "revolute": ["crank.A", "rod.origin"] },
            "R23": { "revolute": ["rod.C", "slide.origin"] },
            "P03": { "sliding": { "guide": "ground.O", "block": "slide.origin" } } },
        "assembly": { "slide": { "near": ["360 mm", 0] } },
        "forces": { "load": { "force": { "point": "slide.origin", "force": ["-1 kN", 0] } } },
        "outputs": { "slide": { "point": "slide.origin" } } } },
    "run": { "duration": 0.3 } }"#;

fn forces(arguments: &[&str]) -> Output {
    let folder = tempfile::tempdir().unwrap();
    let scene = folder.path().join("press.json");
    std::fs::write(&scene, SCENE).unwrap();
    Command::new(env!("CARGO_BIN_EXE_dam"))
        .args(["forces", &scene.display().to_string(), "--speed", "0 rad/s"])
        .args(arguments)
        .output()
        .unwrap()
}

fn text(arguments: &[&str]) -> String {
    let output = forces(arguments);
    let errors = String::from_utf8_lossy(&output.stderr).into_owned();
    assert!(output.status.success(), "{errors}");
    String::from_utf8(output.stdout).unwrap()
}

/// Force of the rod (N), and its angle (rad) at an angle of the crank.
fn rod(phi: f64) -> (f64, f64) {
    let beta = (0.06 * phi.sin() / 0.3).asin();
    (1000.0 / beta.cos(), -beta)
}

#[test]
fn reactions_at_chosen_positions_are_those_of_a_member_of_two_forces() {
    let document: Value = serde_json::from_str(&text(&["--at", "0:330:30 deg", "--json"])).unwrap();
    let values = |name: &str| {
        let values = document["columns"][name]["values"].as_array().unwrap();
        values
            .iter()
            .map(|one| one.as_f64().unwrap())
            .collect::<Vec<f64>>()
    };
    let coordinates = values("coordinate");
    assert_eq!(coordinates.len(), 12);
    let (size, direction) = (values("R12.force"), values("R12.direction"));
    for (row, phi) in coordinates.into_iter().enumerate() {
        assert!((phi - (30.0 * row as f64).to_radians()).abs() < 1e-12);
        let (force, angle) = rod(phi);
        assert!((size[row] / force - 1.0).abs() < 1e-12, "{}", size[row]);
        assert!(
            (direction[row] - angle).abs() < 1e-12,
            "{} {angle}",
            direction[row]
        );
    }
}

#[test]
fn text_has_a_row_a_position_and_csv_the_directions() {
    let shown = text(&["--at", "0:330:30 deg"]);
    let rows: Vec<&str> = shown
        .lines()
        .skip_while(|line| line.trim() != "Reactions")
        .collect();
    let head = rows
        .iter()
        .find(|row| row.contains("input coordinate"))
        .unwrap();
    assert!(head.contains("P03") && head.contains("R12"), "{head}");
    let at_90 = rows
        .iter()
        .find(|row| row.trim_start().starts_with("90 deg"))
        .unwrap();
    let (force, angle) = rod(90f64.to_radians());
    let wanted = format!("{:.3} kN  {:.2} deg", force / 1e3, angle.to_degrees());
    assert!(at_90.contains(&wanted), "{at_90}: {wanted}");
    let csv = text(&["--at", "0:330:30 deg", "--csv"]);
    assert!(csv.lines().next().unwrap().contains("R12.direction [rad]"));
    assert_eq!(csv.lines().count(), 13);
    // The step must lead to the end.
    let refused = forces(&["--at", "0:330:40 deg"]);
    let errors = String::from_utf8_lossy(&refused.stderr).into_owned();
    assert!(!refused.status.success());
    assert!(
        errors.contains("does not divide the range, but 0:320 deg"),
        "{errors}"
    );
}

#[test]
fn a_single_position_is_called_so() {
    let shown = text(&["--at", "30 deg"]);
    assert_eq!(shown, text(&["--range", "30:30 deg"]));
    assert!(shown.contains("at 30 deg"), "{shown}");
    for odd in ["at every position", "rms", "Extremes", "counterweighted"] {
        assert!(!shown.contains(odd), "{odd}: {shown}");
    }
    let beta = (0.06 * 0.5f64 / 0.3).asin();
    let moment = 1000.0 * 0.06 * (30f64.to_radians() + beta).sin() / beta.cos();
    let headline = shown.lines().nth(1).unwrap();
    assert!(
        headline.contains(&format!("Driving moment -{moment:.2} N m")),
        "{headline}"
    );
}
