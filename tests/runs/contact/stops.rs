//! One-sided stops against the ground.

use super::{INTEGRATED, run_text};
use dam::integrate::Method;
use dam::record::{ObjectFigures, StopFigures};
use dam::studies::run::RunResult;
use std::f64::consts::{FRAC_PI_2, PI};

/// A body of 1 kg that nothing but its stops holds: its driver is far away.
fn thrown(stops: &str, loads: &str, [place, speed]: [f64; 2], run: &str) -> String {
    format!(
        r#"{{ "dam": 1, "name": "thrown", "objects": {{
            "hook": {{ "kind": "drive", "coordinate": "sliding", "motion": {{ "fixed": "-1 m" }} }},
            "body": {{ "kind": "slider", "input": "hook", "position": {{ "ratio": 1 }}, "inertia": 1,
                "stiffness": 1e6, "pair": {{ "closure": "force" }}, "loads": {{ {loads} }},
                "stops": {{ {stops} }} }} }},
            "run": {{ {run}, "tolerance": 1e-10,
                "start": {{ "body": {{ "displacement": [{place:?}], "speed": [{speed:?}] }} }} }} }}"#
    )
}

fn floor(contact: &str) -> String {
    format!(r#""floor": {{ "at": 0, "side": "-", "contact": {contact} }}"#)
}

fn body(result: &RunResult) -> &ObjectFigures {
    &result.figures.objects["body"]
}

fn stop<'r>(result: &'r RunResult, id: &str) -> &'r StopFigures {
    result.figures.objects[id].stop.as_ref().unwrap()
}

#[test]
fn a_mass_thrown_on_an_elastic_stop_stays_for_half_a_period() {
    let (k, v, height) = (1e5f64, 0.9, 1e-3);
    let text = thrown(
        &floor(r#"{ "stiffness": 1e5 }"#),
        "",
        [height, -v],
        r#""duration": 0.05"#,
    );
    for method in INTEGRATED.into_iter().chain([Method::Taylor]) {
        let result = run_text(&text, Some(method));
        let own = stop(&result, "body.floor");
        let (touch, stay) = (height / v, PI / k.sqrt());
        assert_eq!(own.closures, 1, "{method:?}");
        approx::assert_relative_eq!(own.max_contact_force, v * k.sqrt(), max_relative = 1e-8);
        approx::assert_relative_eq!(own.max_indentation, v / k.sqrt(), max_relative = 1e-8);
        approx::assert_relative_eq!(own.contact_time, stay, max_relative = 1e-8);
        approx::assert_relative_eq!(own.switch_times[0], touch, max_relative = 1e-9);
        approx::assert_relative_eq!(own.switch_times[1], touch + stay, max_relative = 1e-8);
        approx::assert_relative_eq!(own.max_approach_speed, v, max_relative = 1e-8);
        approx::assert_relative_eq!(body(&result).end.speed, v, max_relative = 1e-8);
        assert!(result.figures.run.energy_error < 1e-8);
    }
}

#[test]
fn between_two_stops_it_goes_to_and_fro() {
    // Each way takes gap/v, each stay half a period of its own stop.
    let stops = format!(
        r#"{}, "roof": {{ "at": "30 mm", "side": "+", "contact": {{ "stiffness": 4e4 }} }}"#,
        floor(r#"{ "stiffness": 1e4 }"#)
    );
    let (v, way) = (1.5, 0.03 / 1.5);
    let [below, above] = [PI / 100.0, PI / 200.0];
    let text = thrown(&stops, "", [0.0, v], r#""duration": 0.3"#);
    let result = run_text(&text, Some(Method::Dop853));
    let (floor, roof) = (stop(&result, "body.floor"), stop(&result, "body.roof"));
    let period = 2.0 * way + below + above;
    assert_eq!((floor.closures, roof.closures), (3, 4));
    approx::assert_relative_eq!(floor.max_contact_force, v * 100.0, max_relative = 1e-7);
    approx::assert_relative_eq!(roof.max_contact_force, v * 200.0, max_relative = 1e-7);
    for (turn, pair) in roof.switch_times.chunks(2).enumerate() {
        let at = way + turn as f64 * period;
        approx::assert_abs_diff_eq!(pair[0], at, epsilon = 1e-8);
        approx::assert_abs_diff_eq!(pair[1], at + above, epsilon = 1e-8);
    }
}

/// The same contacts, as what stands between the body and its driver.
#[test]
fn a_stop_is_a_pair_with_the_ground() {
    for contact in [
        r#"{ "law": "kelvin_voigt", "stiffness": 400, "damping": 6 }"#,
        r#"{ "law": "hunt_crossley", "stiffness": 400, "dissipation": 0.4 }"#,
        r#"{ "law": "hertz", "stiffness": 3e4, "dissipation": 0.3 }"#,
    ] {
        let loads = r#""pull": { "constant": -3 }"#;
        let run = r#""duration": 1.5"#;
        let own = thrown(&floor(contact), loads, [0.02, -0.7], run);
        let pair = own
            .replace("\"-1 m\"", "0")
            .replace("\"stiffness\": 1e6", "\"masses\": 0")
            .replace(
                r#""closure": "force" }"#,
                &format!(r#""closure": "force", "contact": {contact} }}"#),
            );
        let (from, _) = pair.split_once(r#""stops""#).unwrap();
        let (_, to) = pair.split_once(r#""run""#).unwrap();
        let pair = format!(
            r#"{} }} }}, "run"{to}"#,
            from.trim_end().trim_end_matches(',')
        );
        let other = run_text(&pair, Some(Method::Dop853));
        let other = &other.figures.objects["body"];
        let wanted = other.pair.as_ref().unwrap();
        let series = !contact.contains("hertz");
        let methods = INTEGRATED
            .into_iter()
            .chain(series.then_some(Method::Taylor));
        for method in methods {
            let result = run_text(&own, Some(method));
            let found = stop(&result, "body.floor");
            assert_eq!(found.closures, wanted.closures, "{method:?} {contact}");
            assert!(found.closures >= 2, "{} {contact}", found.closures);
            let close = |a: f64, b: f64| approx::assert_relative_eq!(a, b, max_relative = 1e-6);
            close(found.max_contact_force, wanted.max_contact_force);
            close(found.max_indentation, wanted.max_indentation.unwrap());
            close(found.max_approach_speed, wanted.max_approach_speed);
            close(1.5 - found.contact_time, wanted.separated_time);
            approx::assert_abs_diff_eq!(
                body(&result).end.displacement,
                other.end.displacement,
                epsilon = 1e-8
            );
            assert!(
                result.figures.run.energy_error < 1e-7,
                "{method:?} {contact}"
            );
        }
    }
}

/// A body that a spring presses on a seat, before its cam comes for it.
fn valve(more: &str, start: &str, duration: f64) -> String {
    format!(
        r#"{{ "dam": 1, "name": "valve", "objects": {{
            "camshaft": {{ "kind": "drive", "motion": {{ "speed": "600 rpm" }} }},
            "valve": {{ "kind": "cam_follower", "motion": "sliding", "input": "camshaft", {more}
                "position": {{ "plan": {{ "period": "360 deg", "stations": [
                    {{ "at": 0, "displacement": "-0.3 mm", "motion": "dwell" }},
                    {{ "at": "100 deg", "displacement": "-0.3 mm", "motion": "4-5-6-7" }},
                    {{ "at": "180 deg", "displacement": "9 mm", "motion": "4-5-6-7" }},
                    {{ "at": "260 deg", "displacement": "-0.3 mm", "motion": "dwell" }} ] }} }},
                "inertia": 0.3, "stiffness": 3e6, "damping_capacity": 0.5,
                "loads": {{ "spring": {{ "spring": {{ "rate": 4e4, "preload": 300 }} }} }} }} }},
            "run": {{ "duration": {duration:?}, "start": "{start}", "tolerance": 1e-10 }} }}"#
    )
}

const SEAT: &str = r#""stops": { "seat": { "at": "0 mm", "side": "-", "contact": { "law": "kelvin_voigt", "stiffness": 2e7, "damping": 1500 } } },"#;

#[test]
fn what_is_pressed_on_its_seat_rests_there_in_working_order() {
    for start in ["static", "kinetostatic"] {
        for (masses, contact) in [
            (r#""masses": 1,"#, ""),
            (r#""masses": 4,"#, ""),
            (
                r#""masses": 3,"#,
                r#""pair": { "contact": { "stiffness": 1e7 } },"#,
            ),
            (
                r#""masses": 3,"#,
                r#""pair": { "contact": { "law": "hertz", "stiffness": 1e10 } },"#,
            ),
        ] {
            for method in INTEGRATED {
                let more = format!("{SEAT} {masses} {contact}");
                let result = run_text(&valve(&more, start, 0.02), Some(method));
                let own = stop(&result, "valve.seat");
                let depth = 300.0 / (2e7 + 4e4);
                let valve = &result.figures.objects["valve"];
                let pair = valve.pair.as_ref().unwrap();
                approx::assert_abs_diff_eq!(valve.end.displacement, -depth, epsilon = 1e-15);
                approx::assert_abs_diff_eq!(valve.peak_speed, 0.0, epsilon = 1e-9);
                approx::assert_relative_eq!(own.max_indentation, depth, max_relative = 1e-7);
                approx::assert_relative_eq!(own.contact_time, 0.02);
                assert_eq!((own.closures, pair.separations, pair.closures), (0, 0, 0));
                assert_eq!((pair.separated_time, pair.max_contact_force), (0.0, 0.0));
                assert!(result.record.separations.is_empty());
                let opens = |warning: &String| warning.contains("open for");
                assert!(!result.figures.warnings.iter().any(opens));
            }
        }
    }
}

#[test]
fn on_a_seat_by_hertz_it_rests_at_the_depth_of_the_force() {
    let seat = SEAT.replace(
        r#""law": "kelvin_voigt", "stiffness": 2e7, "damping": 1500"#,
        r#""law": "hertz", "stiffness": 5e9"#,
    );
    let result = run_text(&valve(&seat, "static", 0.02), None);
    let own = stop(&result, "valve.seat");
    // K·p^(3/2) + rate·p = preload.
    let mut depth = 1e-5f64;
    for _ in 0..60 {
        let (force, slope) = (
            5e9 * depth.powf(1.5) + 4e4 * depth,
            7.5e9 * depth.sqrt() + 4e4,
        );
        depth -= (force - 300.0) / slope;
    }
    approx::assert_relative_eq!(own.max_indentation, depth, max_relative = 1e-9);
    approx::assert_relative_eq!(
        own.max_contact_force,
        300.0 - 4e4 * depth,
        max_relative = 1e-8
    );
}

#[test]
fn a_turn_of_the_cam_takes_it_off_its_seat_and_lays_it_down() {
    for masses in [1, 5] {
        let more = format!(r#"{SEAT} "masses": {masses},"#);
        let mut last: Option<f64> = None;
        for method in INTEGRATED.into_iter().chain([Method::Taylor]) {
            let result = run_text(&valve(&more, "static", 0.1), Some(method));
            let own = stop(&result, "valve.seat");
            let pair = result.figures.objects["valve"].pair.as_ref().unwrap();
            assert!(own.closures >= 1 && pair.closures >= 1);
            assert_eq!(pair.separations, 0, "{method:?}");
            assert!(result.figures.run.energy_error < 1e-8);
            let before = last.replace(own.max_contact_force);
            if let Some(before) = before {
                approx::assert_relative_eq!(own.max_contact_force, before, max_relative = 1e-6);
            }
        }
    }
}

#[test]
fn an_end_stop_holds_what_is_pulled_off_its_driver() {
    // The load pulls the pair open; the stop on that side takes it.
    let text = r#"{ "dam": 1, "name": "end", "objects": {
        "shaft": { "kind": "drive", "motion": { "fixed": "0.1 rad" } },
        "arm": { "kind": "rocker", "input": "shaft", "position": { "ratio": 1 }, "inertia": 0.02, "stiffness": 1e5,
            "masses": 3, "pair": { "closure": "force" }, "loads": { "pull": { "constant": 5 } },
            "stops": { "end": { "at": "0.2 rad", "side": "+", "contact": { "stiffness": 2e4 } } } } },
        "run": { "duration": 0.01, "start": "static" } }"#;
    let result = run_text(text, None);
    let arm = &result.figures.objects["arm"];
    approx::assert_relative_eq!(arm.end.displacement, 0.2 + 5.0 / 2e4, max_relative = 1e-12);
    let own = stop(&result, "arm.end");
    approx::assert_relative_eq!(own.max_contact_force, 5.0, max_relative = 1e-9);
    assert_eq!(arm.pair.as_ref().unwrap().separations, 0);
}

#[test]
fn a_motor_runs_against_a_stop() {
    // A quarter of a period: rotor and arm together on the stop.
    let text = r#"{ "dam": 1, "name": "motor", "objects": {
        "motor": { "kind": "drive", "motor": { "inertia": 0.5, "speed": 2, "torque": { "constant": 0 } } },
        "arm": { "kind": "rocker", "input": "motor", "position": { "ratio": 1 }, "inertia": 0.5, "stiffness": 1e9,
            "damping_capacity": 0, "stops": { "end": { "at": 0, "side": "+", "contact": { "stiffness": 100 } } } } },
        "run": { "duration": 0.1, "start": "on_law", "tolerance": 1e-9 } }"#;
    for method in [Method::Rodas5p, Method::Radau] {
        let result = run_text(text, Some(method));
        let own = stop(&result, "arm.end");
        let angle = 0.1 * 10.0;
        approx::assert_relative_eq!(
            own.max_contact_force,
            100.0 * 0.2 * f64::sin(angle),
            max_relative = 1e-5
        );
        let motor = &result.figures.objects["motor"];
        approx::assert_relative_eq!(motor.end.speed, 2.0 * angle.cos(), max_relative = 1e-5);
        assert!(angle < FRAC_PI_2 && result.figures.run.energy_error < 1e-6);
    }
}

#[test]
fn what_has_no_stop_beside_it_stays_exact() {
    let text = valve(SEAT, "static", 0.1).replace(
        r#""valve": {"#,
        r#""lever": { "kind": "rocker", "input": "camshaft", "position": { "sine": { "amplitude": 0.2 } },
            "inertia": 0.02, "stiffness": 1e5, "damping_capacity": 0.5 },
           "valve": {"#,
    );
    let both = run_text(&text, None);
    assert!(
        both.figures.run.method.contains("exact"),
        "{}",
        both.figures.run.method
    );
    let alone = run_text(&text, Some(Method::Radau));
    for (address, value) in both.figures.addresses() {
        let (Some(value), true) = (value, address.starts_with("valve.seat.stop")) else {
            continue;
        };
        let other = alone.figures.value(&address).unwrap();
        approx::assert_relative_eq!(value, other, max_relative = 1e-6, epsilon = 1e-9);
    }
}
