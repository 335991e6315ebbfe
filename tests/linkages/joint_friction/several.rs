//! Linkages of several inputs: beside the same linkage of one input, at rest against closed forms,
//! and random five-bars, whose friction takes energy and never gives any.

use super::support::{figure, ran, read, run_of, scene_of, stopped};
use proptest::prelude::*;
use proptest::test_runner::{Config, RngAlgorithm, TestRng, TestRunner};

/// A crank press whose guide lies on a table: that of `press_runs_out` with the table on the
/// ground, or as a second input that is held.
fn press(inputs: &str, ground: &str, table: [&str; 2]) -> String {
    let [link, bed] = table;
    let objects = format!(
        r#""coupling": {{ "kind": "drive", "motor": {{ "inertia": 0, "angle": 0.4, "speed": 12, "torque": {{ "constant": 0 }} }} }},
        "held": {{ "kind": "drive", "coordinate": "sliding", "motion": {{ "fixed": 0 }} }},
        "press": {{ "kind": "linkage", "joint_friction": true, "gravity": {{ "acceleration": 9.81 }},
            "ground": {{ "O": [0, 0] }}, {inputs},
            "links": {{ {link}
                "crank": {{ "points": {{ "A": [0.06, 0] }}, "mass": 40, "moment": 0.12 }},
                "rod": {{ "points": {{ "B": [0.24, 0] }}, "mass": 1.8, "centre": [0.09, 0], "moment": 0.012 }},
                "slide": {{ "mass": 6 }} }},
            "pairs": {{ {bed}
                "O": {{ "revolute": ["ground.O", "crank.origin"], "diameter": 0.05, "friction": 0.12 }},
                "A": {{ "revolute": ["crank.A", "rod.origin"], "diameter": 0.04, "friction": 0.12 }},
                "B": {{ "revolute": ["rod.B", "slide.origin"], "diameter": 0.03, "friction": 0.12 }},
                "guide": {{ "sliding": {{ "guide": "{ground}", "block": "slide.origin",
                    "corners": [0.05, -0.06], "half_height": 0.02 }}, "friction": 0.12 }} }},
            "assembly": {{ "slide": {{ "near": [0.3, 0] }} }},
            "outputs": {{ "slide": {{ "point": "slide.origin" }} }} }}"#
    );
    scene_of(
        &objects,
        r#""duration": 2, "tolerance": 1e-11, "start": "on_law""#,
    )
}

fn press_of_one() -> String {
    press(
        r#""input": "coupling", "driver": "O", "start": 0.4"#,
        "ground.O",
        ["", ""],
    )
}

fn press_of_two() -> String {
    let bed = r#""bed": { "sliding": { "guide": "ground.O", "block": "table.origin", "corners": [0.1, -0.1] }, "friction": 0.2 },"#;
    press(
        r#""inputs": { "crank": { "pair": "O", "object": "coupling" }, "table": { "pair": "bed", "object": "held" } }"#,
        "table.origin",
        [r#""table": { "mass": 3 },"#, bed],
    )
}

/// Whatever rests in a given motion makes no difference to a linkage of one input.
#[test]
fn a_second_input_that_is_held_changes_nothing() {
    let wanted = run_of(&press_of_one(), &[]);
    assert_eq!(figure(&wanted, "press.standstills"), 1.0);
    for method in ["auto", "dop853", "rodas5p"] {
        let found = run_of(&press_of_two(), &[&format!("run.method={method}")]);
        for address in [
            "coupling.final.displacement",
            "press.slide.final.displacement",
            "press.slide.peak_speed",
            "press.time_at_rest",
            "press.friction_loss",
            "press.standstills",
        ] {
            let (found, wanted) = (figure(&found, address), figure(&wanted, address));
            approx::assert_abs_diff_eq!(found, wanted, epsilon = 1e-8);
        }
    }
}

const ARM: &str = r#""arm": { "kind": "linkage", "joint_friction": true, "gravity": { "acceleration": 9.81 },
    "ground": { "O": [0, 0] },
    "inputs": { "shoulder": { "pair": "O", "start": -1.5707963267948966 SHOULDER }, "elbow": { "pair": "A" ELBOW } },
    "links": { "upper": { "points": { "A": [0.5, 0] }, "mass": 2, "centre": [0.25, 0], "moment": 0.05 },
               "fore": { "mass": 1.5, "centre": [0.2, 0], "moment": 0.02 } },
    "pairs": { "O": { "revolute": ["ground.O", "upper.origin"], "diameter": 0.08, "friction": 0.3 },
               "A": { "revolute": ["upper.A", "fore.origin"], "diameter": 0.06, "friction": 0.25 } } }"#;

fn arm(shoulder: &str, elbow: &str, run: &str) -> String {
    let objects = ARM.replace("SHOULDER", shoulder).replace("ELBOW", elbow);
    scene_of(&objects, run)
}

/// An arm that hangs straight down: the weights load its pins, and turn nothing. A couple that
/// grows on one of the pins starts it at μ·(d/2)·(weight below).
#[test]
fn a_hanging_arm_starts_where_a_couple_passes_what_its_pin_holds() {
    let (upper, fore) = (2.0 * 9.81, 1.5 * 9.81);
    let load = |rate: f64| format!(r#", "loads": {{ "couple": {{ "expression": "{rate}*t" }} }}"#);
    let run = r#""duration": 0.6, "tolerance": 1e-11, "start": "on_law""#;
    for method in ["auto", "dop853"] {
        for rate in [0.8, -0.8] {
            let method = format!("run.method={method}");
            let found = run_of(&arm("", &load(rate), run), &[&method]);
            let start = 0.25 * 0.03 * fore / rate.abs();
            approx::assert_abs_diff_eq!(figure(&found, "arm.time_at_rest"), start, epsilon = 1e-9);
            assert!(figure(&found, "arm.elbow.final.displacement") * rate > 1e-4);
            let found = run_of(&arm(&load(4.0 * rate), "", run), &[&method]);
            let start = 0.3 * 0.04 * (upper + fore) / (4.0 * rate.abs());
            approx::assert_abs_diff_eq!(figure(&found, "arm.time_at_rest"), start, epsilon = 1e-9);
        }
    }
}

/// Held at rest by the friction of its pins, whatever small loads do, it stays where it is.
#[test]
fn a_hanging_arm_holds_below_the_limit() {
    let run = r#""duration": 3, "tolerance": 1e-9, "start": "on_law""#;
    let load = r#", "loads": { "couple": { "expression": "0.11*sin(5*t)" } }"#;
    let found = run_of(&arm("", load, run), &[]);
    assert_eq!(figure(&found, "arm.time_at_rest"), 3.0);
    // (What holds it is known to rounding.)
    for address in ["arm.elbow.final.displacement", "arm.friction_loss"] {
        assert!(figure(&found, address).abs() < 1e-13);
    }
}

/// A five-bar of random links, pins and torques.
fn five_bar([m, f, d]: [&[f64]; 3], torques: [f64; 2], speeds: [f64; 2], gravity: bool) -> String {
    let pin = |name: &str, points: [&str; 2], k: usize| {
        let [one, other] = points;
        format!(
            r#""{name}": {{ "revolute": ["{one}", "{other}"], "friction": {}, "diameter": {} }}"#,
            f[k], d[k]
        )
    };
    let pins = [
        pin("O", ["ground.O", "crank.origin"], 0),
        pin("A", ["crank.A", "rod.origin"], 1),
        pin("C", ["rod.C", "coupler.C"], 2),
        pin("B", ["servo.B", "coupler.origin"], 3),
        pin("P", ["ground.P", "servo.origin"], 4),
    ]
    .join(", ");
    let motor = |side: usize| {
        let (torque, angle) = (torques[side], [0.5, 2.0][side]);
        format!(
            r#"{{ "kind": "drive", "motor": {{ "inertia": 0.02, "angle": {angle}, "speed": {}, "torque": {{ "expression": "{torque}*sin(9*t)" }} }} }}"#,
            speeds[side]
        )
    };
    let objects = format!(
        r#""one": {}, "two": {}, "bar": {{ "kind": "linkage", "joint_friction": true, "gravity": {gravity},
        "ground": {{ "O": [0, 0], "P": [0.8, 0] }},
        "inputs": {{ "left": {{ "pair": "O", "object": "one" }}, "right": {{ "pair": "P", "object": "two" }} }},
        "links": {{
            "crank": {{ "points": {{ "A": [0.3, 0] }}, "mass": {}, "centre": [0.1, 0], "moment": 0.01 }},
            "rod": {{ "points": {{ "C": [0.7, 0] }}, "mass": {}, "centre": [0.3, 0.02], "moment": 0.02 }},
            "coupler": {{ "points": {{ "C": [0.6, 0] }}, "mass": {}, "centre": [0.3, 0], "moment": 0.02 }},
            "servo": {{ "points": {{ "B": [0.25, 0] }}, "mass": {}, "centre": [0.1, 0], "moment": 0.01 }} }},
        "pairs": {{ {pins} }} }}"#,
        motor(0),
        motor(1),
        m[0],
        m[1],
        m[2],
        m[3]
    );
    scene_of(
        &objects,
        r#""duration": 1.5, "tolerance": 1e-9, "start": "on_law""#,
    )
}

/// How many five-bars are tried; `DAM_FIVE_BARS=1000 cargo test --release --test linkages five_bars` tries more.
fn tries() -> u32 {
    let told = std::env::var("DAM_FIVE_BARS").ok();
    told.and_then(|number| number.parse().ok()).unwrap_or(24)
}

#[test]
fn friction_of_random_five_bars_takes_energy() {
    let of = |least: f64, most: f64, count: usize| proptest::collection::vec(least..most, count);
    let strategy = (
        (of(0.2, 2.0, 4), of(0.0, 0.4, 5), of(0.01, 0.08, 5)),
        ([-4.0..4.0f64, -4.0..4.0f64], [-2.0..2.0f64, -2.0..2.0f64]),
        (any::<bool>(), any::<bool>()),
    );
    let config = Config {
        cases: tries(),
        failure_persistence: None,
        ..Config::default()
    };
    let rng = TestRng::from_seed(RngAlgorithm::ChaCha, &[17; 32]);
    let check = |((masses, friction, diameters), (torques, speeds), (gravity, still)): Drawn| {
        let speeds = if still { [0.0; 2] } else { speeds };
        let text = five_bar([&masses, &friction, &diameters], torques, speeds, gravity);
        takes_energy(&text)
    };
    TestRunner::new_with_rng(config, rng)
        .run(&strategy, check)
        .unwrap_or_else(|error| panic!("{error}"));
}

/// Masses, coefficients and diameters of pins; torques and speeds; gravity, and a start at rest.
type Drawn = (
    (Vec<f64>, Vec<f64>, Vec<f64>),
    ([f64; 2], [f64; 2]),
    (bool, bool),
);

/// Friction takes energy, the balance closes, and methods that know nothing of each other switch alike.
fn takes_energy(text: &str) -> Result<(), TestCaseError> {
    let [one, other] =
        ["radau", "dop853"].map(|method| ran(&read(text, &[&format!("run.method={method}")])));
    for found in [&one, &other] {
        let stop = stopped(found);
        prop_assert!(
            matches!(stop, None | Some("dead_position")),
            "{stop:?} {text}"
        );
        prop_assert!(figure(found, "bar.friction_loss") > -1e-15);
        prop_assert!(
            found.figures.run.energy_error < 1e-6,
            "{} {text}",
            found.figures.run.energy_error
        );
    }
    for address in [
        "bar.friction_loss",
        "bar.time_at_rest",
        "bar.left.final.displacement",
    ] {
        let (a, b) = (figure(&one, address), figure(&other, address));
        let near = if stopped(&one).is_some() { 1e-3 } else { 1e-5 };
        prop_assert!(
            (a - b).abs() <= near * (1.0 + a.abs()),
            "{address}: {a} {b} {text}"
        );
    }
    Ok(())
}
