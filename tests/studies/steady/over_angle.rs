//! Loads over the angle of rigid machines: which speeds they leave open, and which cycle they have.

use super::scenes::{faults, of_text};
use dam::studies::steady::{Answer, Forces, RigidAnswer, steady_motion};
use std::f64::consts::{PI, TAU};

/// A rotor of 0.6 kg·m² with a load on it.
fn rotor(load: &str) -> String {
    format!(
        r#"{{ "dam": 1, "name": "rotor", "objects": {{
            "d": {{ "kind": "drive", "motor": {{ "inertia": 0.5, "speed": "20 rad/s",
                    "torque": {{ "constant": 0 }} }} }},
            "p": {{ "kind": "crank", "input": "d", "masses": 0, "inertia": 0.1,
                    "position": {{ "ratio": 1 }}, "loads": {{ "h": {load} }} }} }},
          "run": {{ "duration": 1 }} }}"#
    )
}

/// A slider-crank with a force on the slide over the crank's angle.
fn press(period: &str) -> String {
    format!(
        r#"{{ "dam": 1, "name": "press", "objects": {{
            "drive": {{ "kind": "drive", "motion": {{ "speed": "30 rad/s" }} }},
            "m": {{ "kind": "linkage", "input": "drive", "driver": "O",
                "ground": {{ "O": [0, 0] }},
                "links": {{
                    "crank": {{ "points": {{ "A": ["50 mm", 0] }}, "mass": "5 kg",
                                "moment": "0.05 kg m^2" }},
                    "rod": {{ "points": {{ "B": ["200 mm", 0] }}, "mass": "1 kg",
                              "moment": "3e-3 kg m^2" }},
                    "slide": {{ "mass": "1 kg" }} }},
                "pairs": {{
                    "O": {{ "revolute": ["ground.O", "crank.origin"] }},
                    "A": {{ "revolute": ["crank.A", "rod.origin"] }},
                    "B": {{ "revolute": ["rod.B", "slide.origin"] }},
                    "g": {{ "sliding": {{ "guide": "ground.O", "block": "slide.origin" }} }} }},
                "assembly": {{ "slide": {{ "near": ["250 mm", 0] }} }},
                "forces": {{ "cut": {{ "table": {{ "point": "slide.origin",
                    "points": [["180 deg", "0 N"], ["190 deg", "-200 N"],
                               ["350 deg", "-200 N"], ["360 deg", "0 N"]]{period} }} }} }},
                "outputs": {{ "slide": {{ "point": "slide.origin" }} }} }} }},
          "run": {{ "duration": "1 s" }} }}"#
    )
}

fn answer(text: &str, mean_speed: f64, balance: bool) -> RigidAnswer {
    let (system, settings, mut spec) = of_text(text, &[]);
    (spec.mean_speed, spec.balance) = (Some(mean_speed), balance);
    match steady_motion(&system, &settings, &spec).unwrap() {
        Answer::Rigid(answer) => *answer,
        Answer::Periodic(_) => panic!("it is rigid"),
    }
}

#[test]
fn an_expression_that_reads_no_speed_leaves_the_mean_speed_open() {
    let found = answer(&rotor(r#"{ "expression": "-10*sin(phi)" }"#), 20.0, false);
    assert_eq!(found.forces, Forces::Position);
    // From the top to the bottom it does 20 J of work on 0.6 kg·m².
    let [least, greatest] = [found.figures.least_speed, found.figures.greatest_speed];
    let squares = greatest.value.powi(2) - least.value.powi(2);
    approx::assert_relative_eq!(squares, 2.0 * 20.0 / 0.6, max_relative = 1e-12);
    approx::assert_relative_eq!(least.at, PI, max_relative = 1e-6);
    approx::assert_relative_eq!(found.figures.period, TAU / 20.0, max_relative = 1e-11);
    let asked = faults(&rotor(r#"{ "expression": "-10*sin(phi)" }"#), |_| ());
    assert!(asked[0].message.contains("none is given"), "{asked:?}");
}

#[test]
fn an_expression_that_reads_a_speed_decides_it() {
    let text = rotor(r#"{ "expression": "10*sin(phi) + 6 - 0.3*phi_dot" }"#);
    let found = faults(&text, |spec| spec.mean_speed = Some(20.0));
    assert!(
        found[0].message.contains("depends on the speed"),
        "{found:?}"
    );
}

#[test]
fn a_force_table_of_a_linkage_lengthens_the_cycle_to_its_period() {
    let period = |turns: f64| format!(r#", "period": "{} deg""#, 360.0 * turns);
    for turns in [1.0, 2.0, 3.0] {
        let found = answer(&press(&period(turns)), 30.0, true);
        approx::assert_relative_eq!(found.cycle, turns * TAU, max_relative = 1e-12);
        // The simulation of the scene in time knows nothing of cycles.
        assert!(found.is_trusted(), "{turns} turns: {:?}", found.agreement);
        // One stroke of the press a cycle: by parts, −∮F dx = 200 N times the stroke of 100 mm
        // less what its two ramps leave out.
        let stroke = |angle: f64| {
            let sin = 0.25 * angle.sin();
            0.05 * angle.cos() + 0.2 * (1.0 - sin * sin).sqrt()
        };
        let mean = |from: f64, to: f64| {
            let at =
                |i: i32| stroke((from + (to - from) * (f64::from(i) + 0.5) / 1e4).to_radians());
            (0..10_000).map(at).sum::<f64>() / 1e4
        };
        let work = -200.0 * (mean(350.0, 360.0) - mean(180.0, 190.0));
        approx::assert_relative_eq!(found.figures.cycle_work, work, max_relative = 1e-7);
    }
}

#[test]
fn what_does_not_repeat_with_the_angle_is_refused() {
    let found = faults(&press(""), |spec| {
        (spec.mean_speed, spec.balance) = (Some(30.0), true);
    });
    assert_eq!(found[0].path, "m.forces.cut");
    assert!(found[0].message.contains("moves past it"), "{found:?}");
    for load in [
        r#"{ "expression": "-10*sin(phi^2)" }"#,
        r#"{ "position_table": { "points": [[0, 0], ["90 deg", -5], ["180 deg", 0]] } }"#,
        r#"{ "spring": { "rate": 2 } }"#,
    ] {
        let found = faults(&rotor(load), |spec| {
            (spec.mean_speed, spec.balance) = (Some(20.0), true);
        });
        let wanted = found[0].path.ends_with("loads.h");
        assert!(wanted && found.len() == 1, "{load}: {found:?}");
    }
}

/// A rotor with a motor of some torque and a load through a gear.
fn geared(torque: &str, ratio: f64, load: &str) -> String {
    format!(
        r#"{{ "dam": 1, "name": "rotor", "objects": {{
            "d": {{ "kind": "drive", "motor": {{ "inertia": 0.5, "speed": "20 rad/s",
                    "torque": {torque} }} }},
            "p": {{ "kind": "crank", "input": "d", "masses": 0, "inertia": 0.1,
                    "position": {{ "ratio": {ratio} }}, "loads": {{ "h": {load} }} }} }},
          "run": {{ "duration": 1 }} }}"#
    )
}

#[test]
fn moments_that_cancel_but_for_rounding_are_a_steady_motion() {
    // 60·(1 − ω/40) = 0.3·ω.
    let motor = r#"{ "linear": { "stall_torque": 60, "no_load_speed": 40 } }"#;
    let (system, settings, spec) = of_text(&geared(motor, 1.0, r#"{ "viscous": 0.3 }"#), &[]);
    let Answer::Rigid(found) = steady_motion(&system, &settings, &spec).unwrap() else {
        panic!("it is rigid");
    };
    assert_eq!(found.forces, Forces::Speed);
    assert!(found.is_trusted(), "{:?}", found.agreement);
    approx::assert_relative_eq!(found.figures.means.time, 100.0 / 3.0, max_relative = 1e-10);
    assert!(found.figures.fluctuation < 1e-10);
    // 2.1 and 0.7 times 3 differ in their last digit.
    let gears = |load: &str| {
        geared(
            r#"{ "constant": 2.1 }"#,
            0.7,
            &format!(r#"{{ "constant": {load} }}"#),
        )
    };
    let found = answer(&gears("-3"), 20.0, false);
    assert!(
        found.is_trusted() && found.figures.balance.is_none(),
        "{:?}",
        found.agreement
    );
    assert!(found.figures.fluctuation < 1e-12);
    // What is small and no rounding stays work left over.
    let found = faults(&gears("-3.0000000001"), |spec| spec.mean_speed = Some(20.0));
    assert!(found[0].message.contains("loses speed"), "{found:?}");
}

/// A ram of 220 kg on a crank and a rod without mass, on a motor: `object` states them.
fn motor_press(object: &str) -> RigidAnswer {
    let text = format!(
        r#"{{ "dam": 1, "name": "motor press", "objects": {{
            "motor": {{ "kind": "drive", "motor": {{ "inertia": 1.5, "speed": 25,
                "torque": {{ "linear": {{ "stall_torque": 800, "no_load_speed": 53 }} }} }} }},
            "press": {{ "input": "motor", {object} }} }},
          "run": {{ "duration": 1 }} }}"#
    );
    let (system, settings, spec) = of_text(&text, &[]);
    match steady_motion(&system, &settings, &spec).unwrap() {
        Answer::Rigid(answer) => *answer,
        Answer::Periodic(_) => panic!("it is rigid"),
    }
}

#[test]
fn steep_ramps_of_a_force_within_a_linkage_are_followed_as_those_of_a_load() {
    // The blow comes and goes within a tenth of a degree.
    let points = r#"[["322 deg", 0], ["322.1 deg", FORCE], ["359.9 deg", FORCE], ["360 deg", 0]]"#;
    let load = points.replace("FORCE", "-90000");
    let short = motor_press(&format!(
        r#""kind": "slider", "masses": 0, "inertia": 220,
            "position": {{ "slider_crank": {{ "crank": 0.08, "rod": 0.4 }} }},
            "loads": {{ "blow": {{ "position_table": {{ "points": {load}, "period": "1 rev" }} }} }}"#
    ));
    let full = motor_press(&format!(
        r#""kind": "linkage", "driver": "O", "ground": {{ "O": [0, 0] }},
            "links": {{ "crank": {{ "points": {{ "A": [0.08, 0] }} }},
                        "rod": {{ "points": {{ "B": [0.4, 0] }} }}, "ram": {{ "mass": 220 }} }},
            "pairs": {{ "O": {{ "revolute": ["ground.O", "crank.origin"] }},
                        "A": {{ "revolute": ["crank.A", "rod.origin"] }},
                        "B": {{ "revolute": ["rod.B", "ram.origin"] }},
                        "g": {{ "sliding": {{ "guide": "ground.O", "block": "ram.origin" }} }} }},
            "assembly": {{ "ram": {{ "near": [0.48, 0] }} }},
            "forces": {{ "blow": {{ "table": {{ "point": "ram.origin", "points": {load},
                                               "period": "1 rev" }} }} }}"#
    ));
    let [short, full] = [short.figures, full.figures];
    approx::assert_relative_eq!(full.period, short.period, max_relative = 1e-9);
    for (one, other) in [
        (full.least_speed, short.least_speed),
        (full.greatest_speed, short.greatest_speed),
    ] {
        approx::assert_relative_eq!(one.value, other.value, max_relative = 1e-9);
    }
}
