//! Linkages of several inputs that move: prescribed drives, motors and free coordinates, their
//! energies, their singular positions; by methods that look at derivatives and such that do not.

use dam::integrate::{Dynamics, Stop};
use dam::lower::lower;
use dam::scene::{BuiltIn, Document, Expected, Overrides, TypedScene};
use dam::studies::run::{RunResult, run};
use dam::studies::{Control, RunSettings};
use dam::system::System;
use std::f64::consts::TAU;
use std::fs::read_to_string;

/// Cranks of 0.3 and 0.25 m, 0.8 m apart, and rods of 0.7 and 0.6 m: it cannot turn fully.
const FIVE_BAR: &str = r#""bar": { "kind": "linkage", "ground": { "O": [0, 0], "P": [0.8, 0] },
    "inputs": { "left": { "pair": "O"LEFT }, "right": { "pair": "P"RIGHT } },
    "links": {
        "crank": { "points": { "A": [0.3, 0] }, "geometry": { "mass": 1.1 } },
        "rod": { "points": { "C": [0.7, 0] }, "geometry": { "mass": 0.9 } },
        "coupler": { "points": { "C": [0.6, 0] }, "geometry": { "mass": 0.8 } },
        "servo": { "points": { "B": [0.25, 0] }, "geometry": { "mass": 1.3 } } },
    "pairs": {
        "O": { "revolute": ["ground.O", "crank.origin"] }, "A": { "revolute": ["crank.A", "rod.origin"] },
        "C": { "revolute": ["rod.C", "coupler.C"] }, "B": { "revolute": ["servo.B", "coupler.origin"] },
        "P": { "revolute": ["ground.P", "servo.origin"] } },
    "forces": { "spring": { "strut": { "from": "ground.O", "to": "coupler.C", "rate": 150, "free_length": 0.4, "damping": 3 } } },
    "gravity": true, "outputs": { "x": { "point": "rod.C" }, "pin": { "pair": "C" } } }"#;

fn five_bar(drives: &str, [left, right]: [&str; 2], duration: f64) -> String {
    let bar = FIVE_BAR.replace("LEFT", left).replace("RIGHT", right);
    format!(
        r#"{{ "dam": 1, "name": "five-bar", "objects": {{ {drives} {bar} }},
            "run": {{ "duration": {duration}, "tolerance": 1e-11, "start": "on_law" }} }}"#
    )
}

pub(super) fn read(text: &str, overrides: &[&str]) -> TypedScene {
    let document = Document::parse("scene", text.as_bytes()).expect("JSON");
    let overrides = Overrides::new(overrides.iter().copied());
    match document.scene(&BuiltIn, &overrides) {
        Ok(reading) => reading.scene,
        Err(faults) => panic!("{}", faults.render(false)),
    }
}

pub(super) fn result(text: &str, overrides: &[&str]) -> RunResult {
    let scene = read(text, overrides);
    let system = System::new(lower(&scene).expect("a model")).expect("a system");
    let settings = RunSettings::of(&scene).expect("settings");
    run(&system, &settings, &Control::default(), &mut []).expect("a run")
}

pub(super) fn figure(result: &RunResult, address: &str) -> f64 {
    result.figures.value(address).expect("a figure")
}

/// True when the mechanism itself ended the run, in a singular position.
pub(super) fn physical(result: &RunResult) -> bool {
    matches!(&result.outcome.stop, Stop::Physical(stop) if stop.name == "dead_position")
}

/// Complete, and its energies balanced.
pub(super) fn sound(name: &str, result: &RunResult) {
    let run = &result.figures.run;
    assert!(
        run.energy_error < 1e-9,
        "{name}: energy error {:e}",
        run.energy_error
    );
    assert!(!physical(result), "{name} stopped");
}

/// What drives the left and the right input.
pub(super) const DRIVES: [(&str, &str); 4] = [
    (
        "prescribed",
        r#"{ "kind": "drive", "motion": { "speed": "1 rev/s" } }"#,
    ),
    (
        "motor",
        r#"{ "kind": "drive", "motor": { "inertia": 0.03, "angle": 0.4, "speed": 1, "torque": { "linear": { "stall_torque": 9, "no_load_speed": 6 } } } }"#,
    ),
    (
        "elastic",
        r#"{ "kind": "shaft", "input": "motor", "inertia": 0.02, "stiffness": 900, "damping": 0.5, "masses": 2 }"#,
    ),
    ("free", ""),
];

#[test]
fn all_mixtures_of_drives_keep_the_balance_of_the_energies() {
    let addresses = ["bar.left", "bar.right", "bar.x", "bar.pin"];
    balanced(&five_bar, &addresses);
}

/// Every mixture of what drives both inputs keeps the balance of the energies, and the figures at
/// these addresses whatever the method.
pub(super) fn balanced(scene: &dyn Fn(&str, [&str; 2], f64) -> String, addresses: &[&str]) {
    let common = r#""motor": { "kind": "drive", "motor": { "inertia": 0.05, "angle": 0.4, "torque": { "constant": 2 } } },"#;
    for (one, left) in DRIVES {
        for (other, right) in DRIVES {
            let name = format!("{one} and {other}");
            let own = |side: &str, drive: &str| match drive {
                "" => (String::new(), r#", "start": 0.5"#.to_owned()),
                _ => (
                    format!(r#""drive_{side}": {drive},"#),
                    format!(r#", "object": "drive_{side}", "ratio": 0.5, "offset": 1"#),
                ),
            };
            let ((first, to_left), (second, to_right)) = (own("left", left), own("right", right));
            let drives = format!("{common}{first}{second}");
            let text = scene(&drives, [&to_left, &to_right], 0.1);
            let found = result(&text, &[]);
            sound(&name, &found);
            // The same by a method that takes derivatives and by one that takes none.
            let [radau, dop] = ["radau", "dop853"].map(|method| {
                result(
                    &text,
                    &[&format!("run.method={method}"), "run.tolerance=1e-12"],
                )
            });
            for address in addresses {
                for kind in ["displacement", "speed"] {
                    let address = format!("{address}.final.{kind}");
                    let [a, b] = [&radau, &dop].map(|one| figure(one, &address));
                    approx::assert_relative_eq!(a, b, max_relative = 1e-8, epsilon = 1e-9);
                }
            }
        }
    }
}

/// The first instant at which a function that begins below zero is zero.
pub(super) fn first_zero(missing: impl Fn(f64) -> f64) -> f64 {
    let (mut low, mut high) = (0.0, 0.0);
    while missing(high) < 0.0 {
        (low, high) = (high, high + 1e-3);
    }
    for _ in 0..60 {
        let middle = 0.5 * (low + high);
        match missing(middle) < 0.0 {
            true => low = middle,
            false => high = middle,
        }
    }
    low
}

/// Both cranks turn evenly until the rods are in line.
#[test]
fn a_run_ends_in_the_singular_position_that_its_inputs_come_to() {
    let drives = r#""one": { "kind": "drive", "motion": { "speed": "1 rev/s", "angle": 1 } },
        "two": { "kind": "drive", "motion": { "speed": "-0.4 rev/s", "angle": 2.1 } },"#;
    let text = five_bar(
        drives,
        [r#", "object": "one""#, r#", "object": "two""#],
        4.0,
    );
    let found = result(&text, &[]);
    assert!(physical(&found));
    // The distance of the outer pins less the length of both rods, as far as it is below.
    let missing = |t: f64| {
        let (a, b) = (1.0 + TAU * t, 2.1 - 0.4 * TAU * t);
        let [x, y] = [
            0.8 + 0.25 * b.cos() - 0.3 * a.cos(),
            0.25 * b.sin() - 0.3 * a.sin(),
        ];
        x.hypot(y) - 1.3
    };
    let time = first_zero(missing);
    approx::assert_abs_diff_eq!(found.outcome.time, time, epsilon = 1e-9);
}

/// Moved by torques, the rods come into line too: there the run ends and says so.
#[test]
fn motors_that_stretch_the_rods_end_the_run_physically() {
    let drives = r#""one": { "kind": "drive", "motor": { "inertia": 0.02, "angle": 1.2, "torque": { "constant": 6 } } },
        "two": { "kind": "drive", "motor": { "inertia": 0.02, "angle": 1.4, "torque": { "constant": -6 } } },"#;
    let text = five_bar(
        drives,
        [r#", "object": "one""#, r#", "object": "two""#],
        5.0,
    );
    for method in ["dop853", "radau"] {
        let found = result(&text, &[&format!("run.method={method}")]);
        assert!(physical(&found), "{method}");
        assert!(found.figures.run.energy_error < 1e-8, "{method}");
    }
}

/// A rod that floats falls like a stone and turns on.
#[test]
fn a_link_that_floats_alone_falls_and_turns() {
    let text = r#"{ "dam": 1, "name": "rod", "objects": { "rod": { "kind": "linkage", "pairs": {},
        "links": { "rod": { "mass": 2, "centre": [0.3, 0.1], "moment": 0.05 } },
        "inputs": { "a": { "angle": "rod", "start": 0.3, "speed": 4 }, "x": { "x": "rod", "speed": 1 }, "y": { "y": "rod", "speed": 2 } },
        "gravity": true, "outputs": { "cx": { "point": "rod.origin" } } } },
        "run": { "duration": 0.7, "tolerance": 1e-12, "start": "on_law" } }"#;
    let found = result(text, &[]);
    sound("rod", &found);
    let (t, turning) = (0.7, 4.0);
    let centre = |angle: f64| {
        let (sin, cos) = f64::sin_cos(angle);
        [0.3 * cos - 0.1 * sin, 0.3 * sin + 0.1 * cos]
    };
    let (start, end) = (centre(0.3), centre(0.3 + turning * t));
    // The centre of mass flies on a parabola.
    let x = start[0] + (1.0 - turning * start[1]) * t - end[0];
    let y = start[1] + (2.0 + turning * start[0]) * t - 0.5 * 9.80665 * t * t - end[1];
    let of = |address: &str| figure(&found, &format!("{address}.final.displacement"));
    approx::assert_abs_diff_eq!(of("rod.a"), 0.3 + turning * t, epsilon = 1e-10);
    approx::assert_abs_diff_eq!(of("rod.x"), x, epsilon = 1e-10);
    approx::assert_abs_diff_eq!(of("rod.y"), y, epsilon = 1e-10);
}

/// The scene of a hybrid machine keeps its figures whatever the method.
#[test]
fn the_scenes_agree_between_methods() {
    for name in [
        "five_bar",
        "floating_slider_crank",
        "triple_pendulum",
        "cam_with_adjusted_lever",
    ] {
        let path = format!("scenarios/linkages/{name}.json");
        let text = read_to_string(path).expect("a scene");
        let of = |method: &str| result(&text, &[&format!("run.method={method}")]);
        let (one, other) = (of("dop853"), of("rodas5p"));
        let scene = read(&text, &[]);
        for expected in &scene.expect {
            if let Expected::Figure {
                figure: address, ..
            } = &expected.what
            {
                let (a, b) = (figure(&one, address), figure(&other, address));
                approx::assert_relative_eq!(a, b, max_relative = 1e-7, epsilon = 1e-8);
            }
        }
    }
}

#[test]
fn what_it_does_not_know_is_refused_in_its_place() {
    let text = five_bar("", ["", ""], 0.1);
    let faults = |overrides: &[&str]| -> String {
        let document = Document::parse("scene", text.as_bytes()).expect("JSON");
        let overrides = Overrides::new(overrides.iter().copied());
        match document.scene(&BuiltIn, &overrides) {
            Err(faults) => faults.render(false),
            Ok(reading) => {
                let faults = lower(&reading.scene);
                let faults = faults.and_then(|model| System::new(model).map(|_| ()));
                faults.map_or_else(|faults| format!("{faults:?}"), |()| String::new())
            }
        }
    };
    for (change, words) in [
        ("bar.start=1", "belongs to a linkage of one input"),
        ("bar.inputs.left.ratio=2", "has no driver"),
        ("bar.inputs.left.pair=C", "4 moving links, 5 pairs"),
    ] {
        let found = faults(&[change]);
        assert!(
            found.contains(words) || change.ends_with("pair=C"),
            "{change}: {found}"
        );
    }
    let bare = ["1.1", "0.9", "0.8", "1.3"]
        .iter()
        .fold(text.clone(), |text, mass| {
            text.replace(
                &format!(r#""geometry": {{ "mass": {mass} }}"#),
                r#""mass": 0"#,
            )
        });
    let scene = read(&bare, &[]);
    let found = lower(&scene).and_then(|model| System::new(model).map(|_| ()));
    let faults = found.expect_err("nothing has mass");
    assert!(faults[0].message.contains("moves no inertia"), "{faults:?}");
}

/// The right-hand side of rotors on one linkage leaves the passes out: what it gives is what
/// they give.
#[test]
fn accelerations_without_the_passes_are_those_of_the_passes() {
    let drives = r#""one": { "kind": "drive", "motor": { "inertia": 0.02, "angle": 1.2, "speed": 3, "torque": { "linear": { "stall_torque": 9, "no_load_speed": 6 } } } },
        "gear": { "kind": "shaft", "input": "one", "position": { "ratio": -0.5 }, "inertia": 0.01, "masses": 0, "loads": { "spring": { "spring": { "rate": 2 } } } },"#;
    let left = r#", "object": "gear", "ratio": 2, "offset": 3.6"#;
    let right = r#", "start": 1.3, "speed": -2, "loads": { "damper": { "viscous": 0.3 } }"#;
    let text = five_bar(drives, [left, right], 0.1);
    let scene = read(&text, &[]);
    let system = System::new(lower(&scene).expect("a model")).expect("a system");
    let start = system.initial_state().expect("a start");
    let mut scratch = system.scratch();
    let mut dy = vec![0.0; start.y.len()];
    system.derivatives(0.0, &start.y, &start.modes, &mut scratch, &mut dy);
    let mut states = vec![Default::default(); system.model().objects.len()];
    system.observe(0.0, &start.y, &start.modes, &mut scratch, &mut states);
    let of = |id: &str| {
        let mut objects = system.model().objects.iter();
        objects.position(|part| part.id == id).expect("an object")
    };
    for id in ["one", "bar.right"] {
        let coordinate = system.last_coordinate(of(id)).expect("a coordinate");
        let found = dy[system.coordinates() + coordinate];
        let wanted: f64 = states[of(id)].acceleration;
        assert!(wanted.abs() > 1.0);
        approx::assert_relative_eq!(found, wanted, max_relative = 1e-12);
    }
}
