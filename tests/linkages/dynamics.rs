//! Linkages that move: against absolute coordinates with multipliers, against
//! differences, against the conservation of energy.

use crate::multipliers::Mechanism;
use dam::integrate::Dynamics;
use dam::linkage::Linkage;
use dam::linkage::spec::OutputKind;
use dam::lower::lower;
use dam::scene::{BuiltIn, Document, Overrides, TypedScene};
use dam::studies::run::run;
use dam::studies::{Control, RunSettings};
use dam::system::System;

/// A motor of 0.02 kg m² with a torque of 4 N m that starts at 3 rad/s.
fn motor(angle: &str) -> String {
    format!(
        r#""motor": {{ "kind": "drive", "motor": {{ "inertia": 0.02, "angle": "{angle}", "speed": 3,
            "torque": {{ "constant": 4 }} }} }}"#
    )
}

fn scene_of(objects: &str) -> String {
    format!(
        r#"{{ "dam": 1, "name": "linkage", "objects": {{ {objects} }},
            "run": {{ "duration": 0.2, "tolerance": 1e-11, "method": "dop853", "start": "on_law" }} }}"#
    )
}

fn read(text: &str, overrides: &[String]) -> TypedScene {
    let document = Document::parse("scene", text.as_bytes()).expect("JSON");
    let overrides = Overrides::new(overrides.to_vec());
    match document.scene(&BuiltIn, &overrides) {
        Ok(reading) => reading.scene,
        Err(faults) => panic!("{}", faults.render(false)),
    }
}

/// Runs a scene with the linkage `m` behind the motor `motor`, and the same in
/// absolute coordinates: the angle of the motor and every output must agree.
fn compare(name: &str, text: &str, overrides: &[String]) {
    let scene = read(text, overrides);
    let Some(driven) = scene.objects["m"].object.linkage() else {
        panic!("{name}: m is a linkage");
    };
    let spec = driven.linkage.clone();
    let linkage = Linkage::new(spec.clone()).unwrap_or_else(|faults| panic!("{name}: {faults:?}"));
    let system = System::new(lower(&scene).expect("a model")).expect("a system");
    let settings = RunSettings::of(&scene).expect("settings");
    let result = run(&system, &settings, &Control::default(), &mut []).expect("a run");
    let audit = result.figures.run.energy_error;
    assert!(audit < 1e-9, "{name}: energy error {audit:e}");

    let mechanism = Mechanism {
        spec: &spec,
        torque: 4.0,
        rotor: 0.02,
    };
    let start = mechanism.start(&linkage, spec.start, 3.0);
    let (fine, coarse) = (
        mechanism.integrate(&start, 0.2, 800),
        mechanism.integrate(&start, 0.2, 400),
    );
    for (output, part) in spec.outputs.iter().enumerate() {
        let figures = &result.figures.objects[&format!("m.{}", part.name)].end;
        let OutputKind::Angle { link } = spec.outputs[output].kind else {
            continue;
        };
        let at = |state: &crate::multipliers::State| {
            (state.place[3 * link + 2], state.speed[3 * link + 2])
        };
        let ((angle, speed), (rough, _)) = (at(&fine), at(&coarse));
        assert!((angle - rough).abs() < 1e-7, "{name}: the reference stands");
        let turn = std::f64::consts::TAU;
        let miss = (figures.displacement - angle + 0.5 * turn).rem_euclid(turn) - 0.5 * turn;
        assert!(miss.abs() < 1e-8, "{name}.{}: {miss:e}", part.name);
        approx::assert_abs_diff_eq!(figures.speed, speed, epsilon = 1e-6 * (1.0 + speed.abs()));
    }
}

/// Numbers between 0 and 1, the same every time.
struct Random(u64);

impl Random {
    fn next(&mut self) -> f64 {
        self.0 = self
            .0
            .wrapping_mul(6364136223846793005)
            .wrapping_add(1442695040888963407);
        (self.0 >> 11) as f64 / (1u64 << 53) as f64
    }
}

/// A catalogue object, the angle of its start, two links that are looked at, and
/// its dimensions.
type Entry = (
    &'static str,
    &'static str,
    [&'static str; 2],
    &'static [(&'static str, f64)],
);

const CATALOGUE: [Entry; 5] = [
    (
        "slider-crank",
        "0 deg",
        ["crank", "rod"],
        &[("crank", 0.05), ("rod", 0.2)],
    ),
    (
        "four-bar",
        "0 deg",
        ["coupler", "rocker"],
        &[
            ("crank", 0.06),
            ("coupler", 0.18),
            ("rocker", 0.15),
            ("frame", 0.2),
        ],
    ),
    (
        "shaper",
        "0 deg",
        ["lever", "link"],
        &[("crank", 0.08), ("distance", 0.3), ("link", 0.18)],
    ),
    (
        "drag-link",
        "90 deg",
        ["follower", "rod"],
        &[("arm", 0.1), ("rod", 0.35)],
    ),
    (
        "toggle-press",
        "0 deg",
        ["upper", "lower"],
        &[("upper", 0.2), ("lower", 0.2)],
    ),
];

#[test]
fn catalogue_linkages_of_random_size_move_as_absolute_coordinates_with_multipliers() {
    let mut random = Random(7);
    for (name, angle, links, dimensions) in CATALOGUE {
        let text = scene_of(&format!(
            r#"{}, "m": {{ "from": "linkage/{name}", "input": "motor", "gravity": true, "outputs": {{
                "a": {{ "angle": "{}" }}, "b": {{ "angle": "{}" }} }} }}"#,
            motor(angle),
            links[0],
            links[1]
        ));
        // Those with five links take long in absolute coordinates.
        for round in 0..if dimensions.len() == 4 { 2 } else { 1 } {
            let mut overrides = Vec::new();
            for (dimension, value) in dimensions {
                let value = value * (1.0 + 0.04 * (random.next() - 0.5));
                overrides.push(format!("m.dimensions.{dimension}={value}"));
            }
            compare(&format!("{name}, {round}"), &text, &overrides);
        }
    }
}

/// The dyads that no catalogue object has, with springs, dampers and forces of
/// all kinds.
const OTHERS: [(&str, &str); 3] = [
    (
        "Scotch yoke (PRP)",
        r#""links": {
            "crank": { "points": { "A": [0.1, 0] }, "mass": 1, "centre": [0.03, 0.01], "moment": 0.01 },
            "block": { "mass": 0.3, "moment": 0.001, "points": { "C": [0.02, 0.01] } },
            "yoke": { "mass": 0.8, "centre": [0.1, 0], "points": { "E": [0.2, 0.05] } } },
        "pairs": {
            "O": { "revolute": ["ground.O", "crank.origin"] },
            "A": { "revolute": ["crank.A", "block.origin"] },
            "slot": { "sliding": { "guide": "yoke.origin", "direction": "80 deg", "block": "block.origin" } },
            "guide": { "sliding": { "guide": "ground.O", "direction": "10 deg", "block": "yoke.origin" } } },
        "forces": {
            "spring": { "strut": { "from": "ground.P", "to": "yoke.E", "rate": 400, "free_length": 0.1, "damping": 3, "force": -25 } },
            "load": { "force": { "point": "yoke.E", "force": [-5, 2] } },
            "turning": { "force": { "point": "crank.A", "force": [3, 1], "follows": true } } }"#,
    ),
    (
        "slotted link (RPR)",
        r#""links": {
            "crank": { "points": { "A": [0.1, 0] }, "mass": 1, "centre": [0.03, 0.01], "moment": 0.01 },
            "block": { "mass": 0.3, "centre": [0.01, 0.02], "moment": 0.001 },
            "slot": { "mass": 0.8, "centre": [0.15, 0.02], "moment": 0.02 } },
        "pairs": {
            "O": { "revolute": ["ground.O", "crank.origin"] },
            "A": { "revolute": ["crank.A", "block.origin"] },
            "slot": { "sliding": { "guide": "slot.origin", "block": "block.origin", "angle": 0.3 } },
            "P": { "revolute": ["ground.P", "slot.origin"] } },
        "forces": {
            "twist": { "torsion": { "pair": "P", "rate": 5, "free_angle": 0.2, "damping": 0.1 } },
            "hinge": { "torsion": { "pair": "A", "rate": 0, "damping": 0.02 } },
            "push": { "couple": { "link": "slot", "moment": -0.7 } } }"#,
    ),
    (
        "sliding rod (RPP)",
        r#""links": {
            "crank": { "points": { "A": [0.1, 0] }, "mass": 1, "centre": [0.03, 0.01], "moment": 0.01 },
            "rod": { "mass": 0.3, "centre": [0.05, 0.02], "moment": 0.001 },
            "table": { "mass": 0.8, "centre": [0.1, 0] } },
        "pairs": {
            "O": { "revolute": ["ground.O", "crank.origin"] },
            "A": { "revolute": ["crank.A", "rod.origin"] },
            "sleeve": { "sliding": { "guide": "rod.origin", "direction": "70 deg", "block": "table.origin", "angle": "-60 deg" } },
            "guide": { "sliding": { "guide": "ground.P", "direction": "10 deg", "block": "table.origin" } } },
        "forces": {
            "spring": { "strut": { "from": "ground.O", "to": "table.origin", "damping": 2, "force": 15 } } }"#,
    ),
];

#[test]
fn other_dyads_with_all_forces_move_as_absolute_coordinates_with_multipliers() {
    for (name, parts) in OTHERS {
        let outputs: &str = if name.contains("RPR") {
            "slot"
        } else {
            "crank"
        };
        let text = scene_of(&format!(
            r#"{}, "m": {{ "kind": "linkage", "input": "motor", "driver": "O",
                "ground": {{ "O": [0, 0], "P": [0.05, -0.3] }}, {parts},
                "gravity": {{ "direction": "-70 deg" }},
                "outputs": {{ "a": {{ "angle": "crank" }}, "b": {{ "angle": "{outputs}" }} }} }}"#,
            motor("0 deg")
        ));
        compare(name, &text, &[]);
    }
}

/// Elastic shaft, linkage with weights, spring, damper and a load over the
/// angle, elastic tool behind an output of it.
const ELASTIC: &str = r#"
    "motor": { "kind": "drive", "motor": { "inertia": 0.05, "angle": 0.3, "speed": 12,
        "torque": { "linear": { "stall_torque": 30, "no_load_speed": 40 } } } },
    "shaft": { "kind": "shaft", "input": "motor", "inertia": 0.01, "stiffness": 3000, "damping_capacity": 0.2, "masses": 2 },
    "m": { "from": "linkage/slider-crank", "input": "shaft", "gravity": true, "position": { "ratio": 0.5 },
        "forces": {
            "spring": { "strut": { "from": "ground.O", "to": "slide.origin", "rate": 900, "free_length": 0.15, "damping": 8, "force": -40 } },
            "cut": { "table": { "point": "slide.origin", "direction": "180 deg", "points": [[0, 0], [2, 60], [4, 0]], "period": 6.283185307179586 } } } },
    "tool": { "kind": "slider", "input": "m.slide", "position": { "ratio": 1.5 }, "inertia": 0.4, "stiffness": 2e5, "damping_capacity": 0.1, "masses": 2 }"#;

#[test]
fn the_tangent_agrees_with_differences_through_shaft_linkage_and_tool() {
    let scene = read(&scene_of(ELASTIC), &[]);
    let system = System::new(lower(&scene).expect("a model")).expect("a system");
    let start = system.initial_state().expect("a start");
    let n = 2 * system.coordinates();
    let (mut scratch, scales) = (system.scratch(), system.scales().to_vec());
    let mut random = Random(3);
    let y: Vec<f64> = (0..n)
        .map(|i| start.y[i] + scales[i] * 0.3 * (random.next() - 0.5))
        .collect();
    let (mut above, mut below, mut tangent) = (vec![0.0; n], vec![0.0; n], vec![0.0; n]);
    for column in 0..n {
        let mut direction = vec![0.0; n];
        direction[column] = scales[column];
        let step = 1e-4;
        let moved = |sign: f64| -> Vec<f64> {
            let add = |(y, d): (&f64, &f64)| y + sign * step * d;
            y.iter().zip(&direction).map(add).collect()
        };
        let modes = &start.modes;
        system.derivatives(0.0, &moved(1.0), modes, &mut scratch, &mut above);
        system.derivatives(0.0, &moved(-1.0), modes, &mut scratch, &mut below);
        system.tangent(0.0, &y, modes, &direction, &mut scratch, &mut tangent);
        for row in n / 2..n {
            let difference = (above[row] - below[row]) / (2.0 * step);
            let size = above[row].abs().max(tangent[row].abs()).max(1.0);
            assert!(
                (difference - tangent[row]).abs() < 2e-6 * size,
                "row {row}, column {column}: {difference} {}",
                tangent[row]
            );
        }
    }
}

#[test]
fn energy_is_balanced_by_every_method_through_shaft_linkage_and_tool() {
    let mut found = Vec::new();
    for method in ["dop853", "dopri5", "rodas5p"] {
        let overrides = [
            format!("run.method={method}"),
            "run.tolerance=1e-9".to_owned(),
        ];
        let scene = read(&scene_of(ELASTIC), &overrides);
        let system = System::new(lower(&scene).expect("a model")).expect("a system");
        let settings = RunSettings::of(&scene).expect("settings");
        let result = run(&system, &settings, &Control::default(), &mut []).expect("a run");
        assert!(
            result.is_trusted(),
            "{method}: {:?}",
            result.figures.warnings
        );
        assert!(result.figures.run.energy_error < 1e-7, "{method}");
        found.push(result.figures.objects["tool"].end.displacement);
    }
    approx::assert_abs_diff_eq!(found[0], found[1], epsilon = 1e-8);
    approx::assert_abs_diff_eq!(found[0], found[2], epsilon = 1e-8);
}

/// Forces of a given motion that overflow: the run is no success.
#[test]
fn forces_that_are_no_numbers_end_a_run_as_a_numerical_failure() {
    let scene_with = |drive: &str, rate: &str, free: &str| {
        scene_of(&format!(
            r#""motor": {{ "kind": "drive", {drive} }},
            "m": {{ "from": "linkage/slider-crank", "input": "motor", "forces": {{ "spring": {{
                "strut": {{ "from": "ground.O", "to": "slide.origin", "rate": {rate}, "free_length": {free} }} }} }} }}"#
        ))
    };
    let given = r#""motion": { "speed": 12 }"#;
    let free = r#""motor": { "inertia": 0.05, "speed": 12, "torque": { "constant": 1 } }"#;
    // At once; on the way, where the slide draws in; and with a motor.
    for (drive, rate, length, at_start) in [
        (given, "1e308", "100", true),
        (given, "1e308", "2.03", false),
        (free, "1e308", "100", true),
    ] {
        let scene = read(&scene_with(drive, rate, length), &[]);
        let system = System::new(lower(&scene).expect("a model")).expect("a system");
        let settings = RunSettings::of(&scene).expect("settings");
        let result = run(&system, &settings, &Control::default(), &mut []).expect("a run");
        let summary = &result.figures.run;
        assert!(!result.is_complete() && !summary.complete && !result.is_trusted());
        assert_eq!(summary.stopped.as_deref(), Some("not_finite"));
        assert!(summary.energy_error.is_finite());
        assert_eq!(summary.time == 0.0, at_start, "{}", summary.time);
        assert_eq!(result.record.times.is_empty(), at_start);
        let object = &result.figures.objects["m"];
        approx::assert_relative_eq!(object.peak_speed, 12.0, max_relative = 1e-12);
        assert_eq!(object.peak_reaction.is_finite(), !at_start);
        let mut columns = result.record.columns.iter().flat_map(|c| &c.values);
        assert!(columns.all(|value| value.is_finite()));
    }
}
