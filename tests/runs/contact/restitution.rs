//! Rigid contacts against closed forms: impacts, what rests, what is held, by every method.

use super::run_text;
use dam::integrate::Method;
use dam::record::{ImpactFigures, PairFigures, SwitchRow};
use dam::studies::run::RunResult;

const METHODS: [Method; 6] = [
    Method::Dop853,
    Method::Rodas5p,
    Method::Radau,
    Method::Dopri5,
    Method::Taylor,
    Method::Exact,
];

/// The methods that integrate.
const INTEGRATED: &[Method] = METHODS.split_at(5).0;

const GRAVITY: f64 = 9.81;

/// A ball of 0.5 kg above a table that moves as `position` of a drive that turns at 1 rad/s.
fn ball(position: &str, contact: &str, [place, speed]: [f64; 2], duration: f64) -> String {
    let motion = match position == FIXED {
        true => "\"fixed\": 0",
        false => "\"speed\": \"1 rad/s\"",
    };
    format!(
        r#"{{ "dam": 1, "name": "ball", "objects": {{
            "drive": {{ "kind": "drive", "motion": {{ {motion} }} }},
            "table": {{ "kind": "slider", "input": "drive", "position": {position}, "inertia": 2, "masses": 0 }},
            "ball": {{ "kind": "slider", "input": "table", "position": {{ "ratio": 1 }}, "inertia": 0.5, "masses": 0,
                "pair": {{ "closure": "force", "contact": {contact} }},
                "loads": {{ "weight": {{ "constant": {:?} }} }} }} }},
            "run": {{ "duration": {duration:?}, "tolerance": 1e-11, "record": "all",
                "start": {{ "ball": {{ "displacement": [{place:?}], "speed": [{speed:?}] }} }} }} }}"#,
        -0.5 * GRAVITY
    )
}

fn pair<'r>(result: &'r RunResult, object: &str) -> &'r PairFigures {
    result.figures.objects[object].pair.as_ref().unwrap()
}

fn impacts(result: &RunResult, object: &str) -> ImpactFigures {
    pair(result, object).impacts.unwrap()
}

fn rows<'r>(result: &'r RunResult, what: &str) -> Vec<&'r SwitchRow> {
    let rows = result.record.switches.iter();
    rows.filter(|row| row.what == what).collect()
}

fn close(found: f64, wanted: f64, share: f64, what: &str) {
    let off = (found - wanted).abs();
    assert!(
        off <= share * wanted.abs(),
        "{what}: {found} and not {wanted}"
    );
}

/// On a drive that stands still.
const FIXED: &str = r#"{ "sine": { "amplitude": 1 } }"#;

#[test]
fn a_ball_comes_to_rest_after_the_sum_of_its_bounces() {
    let (height, e) = (1.0, 0.6);
    let text = ball(FIXED, r#"{ "restitution": 0.6 }"#, [height, 0.0], 2.5);
    let speed = (2.0 * GRAVITY * height).sqrt();
    let first = speed / GRAVITY;
    for method in METHODS {
        let result = run_text(&text, Some(method));
        let what = format!("{method:?}");
        let struck = rows(&result, "impact");
        let (mut time, mut approach) = (first, speed);
        for row in &struck[..12] {
            close(row.time, time, 1e-9, &what);
            close(row.speed, approach, 1e-8, &what);
            approach *= e;
            time += 2.0 * approach / GRAVITY;
        }
        // T = v₀/g·(1 + e)/(1 − e).
        let rests = rows(&result, "closes");
        assert_eq!(rests.len(), 1, "{what}");
        close(rests[0].time, first * (1.0 + e) / (1.0 - e), 1e-9, &what);
        assert!((20..80).contains(&impacts(&result, "ball").count), "{what}");
        // All that it fell is lost, and its first impulse is the greatest.
        close(
            impacts(&result, "ball").loss,
            0.5 * GRAVITY * height,
            1e-8,
            &what,
        );
        close(
            impacts(&result, "ball").max_impulse,
            0.5 * speed * (1.0 + e),
            1e-8,
            &what,
        );
        close(
            pair(&result, "ball").max_contact_force,
            0.5 * GRAVITY,
            1e-12,
            &what,
        );
        assert_eq!(pair(&result, "ball").separations, 0);
        assert!(
            result.figures.objects["ball"].end.displacement.abs() < 1e-14,
            "{what}"
        );
    }
}

/// With a fixed step, and of diffsol where that is built in, too.
#[test]
fn every_method_there_is_locates_impacts_and_lets_them_end() {
    let (height, e) = (1.0, 0.6);
    let text = ball(FIXED, r#"{ "restitution": 0.6 }"#, [height, 0.0], 2.5);
    let text = text.replace(
        r#""tolerance": 1e-11"#,
        r#""tolerance": 1e-8, "step": 0.01"#,
    );
    let first = (2.0 * height / GRAVITY).sqrt();
    for method in Method::available() {
        let result = run_text(&text, Some(method));
        let what = format!("{method:?}");
        let (mut time, mut flight) = (first, 2.0 * first);
        for row in &rows(&result, "impact")[..8] {
            close(row.time, time, 1e-6, &what);
            flight *= e;
            time += flight;
        }
        let rests = rows(&result, "closes");
        assert_eq!(rests.len(), 1, "{what}");
        close(rests[0].time, first * (1.0 + e) / (1.0 - e), 1e-6, &what);
        let loss = impacts(&result, "ball").loss;
        close(loss, 0.5 * GRAVITY * height, 1e-6, &what);
    }
}

#[test]
fn a_ball_of_restitution_one_keeps_its_energy() {
    let text = ball(FIXED, r#"{ "restitution": 1 }"#, [0.2, 0.0], 10.0);
    let flight = 2.0 * (2.0 * 0.2 / GRAVITY).sqrt();
    let result = run_text(&text, Some(Method::Radau));
    let struck = rows(&result, "impact");
    assert_eq!(struck.len(), (10.0 / flight + 0.5) as usize);
    for (number, row) in struck.iter().enumerate() {
        close(row.time, (number as f64 + 0.5) * flight, 1e-9, "time");
    }
    assert_eq!(impacts(&result, "ball").loss, 0.0);
}

/// Impacts of a ball on a table A·sin t, each flight in closed form and its end by bisection.
fn bounces(amplitude: f64, e: f64, [mut place, mut speed]: [f64; 2], end: f64) -> Vec<[f64; 2]> {
    let mut start = 0.0;
    let mut found = Vec::new();
    loop {
        let above = |t: f64| {
            let s = t - start;
            place + speed * s - 0.5 * GRAVITY * s * s - amplitude * t.sin()
        };
        let mut low = start + 1e-9;
        while low < end && above(low + 1e-4) > 0.0 {
            low += 1e-4;
        }
        if low >= end || found.len() > 50 {
            return found;
        }
        let mut high = low + 1e-4;
        for _ in 0..80 {
            let middle = 0.5 * (low + high);
            if above(middle) > 0.0 {
                low = middle;
            } else {
                high = middle;
            }
        }
        let table = amplitude * high.cos();
        let approach = table - (speed - GRAVITY * (high - start));
        found.push([high, approach]);
        (place, speed) = (amplitude * high.sin(), table + e * approach);
        start = high;
    }
}

/// The bouncing ball of P. J. Holmes (1982) without his simplification that the table's
/// displacement counts for nothing.
#[test]
fn a_ball_on_a_harmonic_table_follows_the_map_of_its_impacts() {
    let amplitude = 15.0;
    let position = r#"{ "sine": { "amplitude": 15 } }"#;
    let text = ball(position, r#"{ "restitution": 0.8 }"#, [0.5, 25.0], 45.0);
    let wanted = bounces(amplitude, 0.8, [0.5, 25.0], 45.0);
    assert!((5..20).contains(&wanted.len()), "{wanted:?}");
    for method in METHODS {
        let result = run_text(&text, Some(method));
        let struck = rows(&result, "impact");
        assert_eq!(struck.len(), wanted.len(), "{method:?}");
        for (row, [time, approach]) in struck.iter().zip(&wanted) {
            close(row.time, *time, 1e-6, &format!("{method:?}"));
            close(row.speed, *approach, 1e-5, &format!("{method:?}"));
        }
    }
}

/// A ball that lies on a table leaves it where that falls with more than g, and lies on it
/// again after a flight without a rebound.
#[test]
fn what_rests_is_held_until_its_force_would_pull() {
    let amplitude = 15.0;
    let position = r#"{ "sine": { "amplitude": 15 } }"#;
    let text = ball(position, r#"{ "restitution": 0 }"#, [0.0, 15.0], 5.5);
    let lifts = (GRAVITY / amplitude).asin();
    let speed = amplitude * lifts.cos();
    let state = [amplitude * lifts.sin(), speed];
    for method in METHODS {
        let what = format!("{method:?}");
        let result = run_text(&text, Some(method));
        let opens = rows(&result, "opens");
        assert_eq!(opens.len(), 1, "{what}");
        close(opens[0].time, lifts, 1e-8, &what);
        let struck = rows(&result, "impact");
        assert_eq!(struck.len(), 1, "{what}");
        let above = |t: f64| {
            let s = t - lifts;
            state[0] + state[1] * s - 0.5 * GRAVITY * s * s - amplitude * t.sin()
        };
        let (mut low, mut high) = (lifts + 0.2, 5.0);
        assert!(above(low) > 0.0 && above(high) < 0.0);
        for _ in 0..80 {
            let middle = 0.5 * (low + high);
            if above(middle) > 0.0 {
                low = middle;
            } else {
                high = middle;
            }
        }
        close(struck[0].time, high, 1e-7, &what);
        assert_eq!(rows(&result, "closes").len(), 1, "{what}");
        // Held to the end: m·(g + ÿ).
        let force = 0.5 * (GRAVITY + amplitude);
        assert!(
            pair(&result, "ball").max_contact_force <= force * (1.0 + 1e-9),
            "{what}"
        );
        let end = &result.figures.objects["ball"].end;
        close(end.displacement, amplitude * 5.5f64.sin(), 1e-12, &what);
        close(end.speed, amplitude * 5.5f64.cos(), 1e-12, &what);
    }
}

/// A rotor of 2 kg·m² strikes a disc of 1 kg·m² that stands in a gap before it.
fn discs(e: f64, torque: f64, duration: f64) -> String {
    format!(
        r#"{{ "dam": 1, "name": "discs", "objects": {{
            "rotor": {{ "kind": "drive", "motor": {{ "inertia": 2, "torque": {{ "constant": {torque:?} }} }} }},
            "gear": {{ "kind": "shaft", "input": "rotor", "lever_ratio": 2, "inertia": 0.25, "masses": 0 }},
            "disc": {{ "kind": "rocker", "input": "gear", "position": {{ "ratio": 1 }}, "inertia": 1, "masses": 0,
                "pair": {{ "closure": "form", "gap": 0.5, "contact": {{ "restitution": {e:?} }} }} }} }},
            "run": {{ "duration": {duration:?}, "tolerance": 1e-11, "record": "all",
                "start": {{ "rotor": {{ "displacement": [0], "speed": [1] }},
                    "disc": {{ "displacement": [0], "speed": [0] }} }} }} }}"#
    )
}

/// On the disc's coordinate the rotor with its gear has the inertia (2 + 4·0.25)/4 = 0.75.
#[test]
fn a_free_drive_takes_the_other_half_of_the_impulse() {
    let reduced = 0.75f64;
    for e in [0.0, 0.5, 1.0] {
        for &method in INTEGRATED {
            let what = format!("{method:?} e = {e}");
            let result = run_text(&discs(e, 0.0, 0.3), Some(method));
            let struck = rows(&result, "impact");
            assert_eq!(struck.len(), 1, "{what}");
            // 2 rad/s over half the gap.
            close(struck[0].time, 0.125, 1e-10, &what);
            let mean = reduced * 2.0 / (reduced + 1.0);
            let [gear, disc] = [
                mean - 2.0 * e / (reduced + 1.0),
                mean + 2.0 * e * reduced / (reduced + 1.0),
            ];
            let end = |id: &str| result.figures.objects[id].end.speed;
            assert!((end("rotor") - 0.5 * gear).abs() < 1e-10, "{what}");
            close(end("disc"), disc, 1e-10, &what);
            let own = impacts(&result, "disc");
            let both = reduced / (reduced + 1.0);
            close(own.max_impulse, both * 2.0 * (1.0 + e), 1e-10, &what);
            assert!(
                (own.loss - 0.5 * both * 4.0 * (1.0 - e * e)).abs() < 1e-10,
                "{what}"
            );
            assert!(result.figures.run.energy_error < 1e-10, "{what}");
        }
    }
}

#[test]
fn held_on_a_free_drive_both_are_one_inertia() {
    for &method in INTEGRATED {
        let what = format!("{method:?}");
        let result = run_text(&discs(0.0, 5.0, 1.0), Some(method));
        // 2 − on the gear: φ = 2·(t + t²·5/(2·3)), up to η/2 = 0.25.
        let reached = |t: f64| 2.0 * (t + 5.0 / 6.0 * t * t) - 0.25;
        let (mut low, mut high) = (0.0, 1.0);
        for _ in 0..80 {
            let middle = 0.5 * (low + high);
            if reached(middle) < 0.0 {
                low = middle;
            } else {
                high = middle;
            }
        }
        close(rows(&result, "impact")[0].time, high, 1e-9, &what);
        let before = 1.0 + 5.0 / 3.0 * high;
        let after = before * 3.0 / 7.0;
        // Rotor, gear and disc: 2 + 4·(0.25 + 1).
        let end = after + 5.0 / 7.0 * (1.0 - high);
        close(result.figures.objects["rotor"].end.speed, end, 1e-9, &what);
        close(
            result.figures.objects["disc"].end.speed,
            2.0 * end,
            1e-9,
            &what,
        );
        close(
            pair(&result, "disc").max_contact_force,
            2.0 * 5.0 / 7.0,
            1e-9,
            &what,
        );
    }
}

/// A body of 1 kg on its weight above a rigid floor, its driver far below.
#[test]
fn a_rigid_floor_is_a_stop() {
    let text = r#"{ "dam": 1, "name": "thrown", "objects": {
        "hook": { "kind": "drive", "coordinate": "sliding", "motion": { "fixed": "-1 m" } },
        "body": { "kind": "slider", "input": "hook", "position": { "ratio": 1 }, "inertia": 1,
            "stiffness": 1e6, "pair": { "closure": "force" }, "loads": { "weight": { "constant": -9.81 } },
            "stops": { "floor": { "at": 0, "side": "-", "contact": { "restitution": 0.5 } } } } },
        "run": { "duration": 1.5, "tolerance": 1e-10,
            "start": { "body": { "displacement": [0.3], "speed": [0] } } } }"#;
    let speed = (2.0 * GRAVITY * 0.3f64).sqrt();
    for &method in INTEGRATED {
        let what = format!("{method:?}");
        let result = run_text(text, Some(method));
        let own = result.figures.objects["body.floor"].stop.as_ref().unwrap();
        assert_eq!(own.closures, 1, "{what}");
        close(own.switch_times[0], speed / GRAVITY * 3.0, 1e-8, &what);
        close(own.max_approach_speed, speed, 1e-9, &what);
        close(own.max_contact_force, GRAVITY, 1e-9, &what);
        let struck = own.impacts.unwrap();
        close(struck.loss, GRAVITY * 0.3, 1e-8, &what);
        close(struck.max_impulse, 1.5 * speed, 1e-9, &what);
        assert!(
            result.figures.objects["body"].end.displacement.abs() < 1e-9,
            "{what}"
        );
        assert!(result.figures.run.energy_error < 1e-9, "{what}");
    }
}

/// A chain of three masses, pressed on a rigid seat by 50 N with its cam below: at rest from
/// the start.
#[test]
fn a_chain_lies_on_a_rigid_seat() {
    let text = r#"{ "dam": 1, "name": "seat", "objects": {
        "cam": { "kind": "drive", "coordinate": "sliding", "motion": { "fixed": "-1 mm" } },
        "valve": { "kind": "slider", "input": "cam", "position": { "ratio": 1 }, "inertia": 1, "masses": 3,
            "stiffness": 1e6, "damping_capacity": 0.1, "pair": { "closure": "force" },
            "loads": { "spring": { "constant": -50 } },
            "stops": { "seat": { "at": 0, "side": "-", "contact": { "restitution": 0.2 } } } } },
        "run": { "duration": 0.02, "tolerance": 1e-10, "start": "static" } }"#;
    for &method in INTEGRATED {
        let what = format!("{method:?}");
        let result = run_text(text, Some(method));
        let figures = &result.figures.objects;
        let seat = figures["valve.seat"].stop.as_ref().unwrap();
        assert!(figures["valve"].end.displacement.abs() < 1e-12, "{what}");
        assert_eq!(seat.impacts.unwrap().count, 0, "{what}");
        close(seat.max_contact_force, 50.0, 1e-9, &what);
        assert!(figures["valve"].peak_speed < 1e-9, "{what}");
        close(seat.contact_time, 0.02, 1e-12, &what);
    }
}

/// Between a rising table and a stop, both rigid, nothing gives way.
#[test]
fn what_is_pressed_between_rigid_contacts_jams() {
    use dam::prelude::*;
    let text = r#"{ "dam": 1, "name": "jam", "objects": {
        "table": { "kind": "drive", "coordinate": "sliding", "motion": { "speed": "1 m/s" } },
        "body": { "kind": "slider", "input": "table", "position": { "ratio": 1 }, "inertia": 1, "masses": 0,
            "pair": { "closure": "force", "contact": { "restitution": 0.5 } },
            "loads": { "weight": { "constant": -10 } },
            "stops": { "lid": { "at": 0.25, "side": "+", "contact": { "restitution": 0.5 } } } } },
        "run": { "duration": 1, "start": "on_law" } }"#;
    let run = Scene::from_json(text)
        .and_then(|scene| scene.run())
        .unwrap();
    assert_eq!(run.figures.run.stopped.as_deref(), Some("jammed"));
    close(run.figures.run.time, 0.25, 1e-9, "time");
}

/// Two bodies on each other, dropped on a fixed table: all that they fell is lost, and each
/// contact carries what stands on it.
#[test]
fn bodies_on_each_other_come_to_rest() {
    let text = r#"{ "dam": 1, "name": "stack", "objects": {
        "ground": { "kind": "drive", "coordinate": "sliding", "motion": { "fixed": 0 } },
        "lower": { "kind": "slider", "input": "ground", "position": { "ratio": 1 }, "inertia": 2, "masses": 0,
            "pair": { "closure": "force", "contact": { "restitution": 0.4 } },
            "loads": { "weight": { "constant": -19.62 } } },
        "upper": { "kind": "slider", "input": "lower", "position": { "ratio": 1 }, "inertia": 1, "masses": 0,
            "pair": { "closure": "force", "contact": { "restitution": 0.3 } },
            "loads": { "weight": { "constant": -9.81 } } } },
        "run": { "duration": 2, "tolerance": 1e-10, "start": {
            "lower": { "displacement": [0.1], "speed": [0] },
            "upper": { "displacement": [0.15], "speed": [0] } } } }"#;
    let mut rest = Vec::new();
    for &method in INTEGRATED {
        let what = format!("{method:?}");
        let result = run_text(text, Some(method));
        let [lower, upper] = ["lower", "upper"].map(|id| impacts(&result, id));
        let fell = 19.62 * 0.1 + 9.81 * 0.15;
        close(lower.loss + upper.loss, fell, 1e-8, &what);
        close(pair(&result, "lower").max_contact_force, 29.43, 1e-9, &what);
        close(pair(&result, "upper").max_contact_force, 9.81, 1e-9, &what);
        assert!(
            result.figures.objects["upper"].end.displacement.abs() < 1e-12,
            "{what}"
        );
        rest.push(pair(&result, "upper").switch_times.last().copied().unwrap());
    }
    assert!(
        rest.iter().all(|time| (time - rest[0]).abs() < 1e-7),
        "{rest:?}"
    );
}

/// A rigid follower on a cam of several pieces at a speed at which it lifts off.
fn follower(e: f64, turns: f64) -> String {
    format!(
        r#"{{ "dam": 1, "name": "follower", "objects": {{
            "shaft": {{ "kind": "drive", "motion": {{ "speed": "40 rev/s" }} }},
            "valve": {{ "kind": "cam_follower", "motion": "sliding", "input": "shaft",
                "position": {{ "cam": {{ "lift": "10 mm", "rise": "80 deg", "dwell": "20 deg", "return": "80 deg",
                    "rest": "180 deg", "law": "modified_trapezoid" }} }},
                "inertia": "0.2 kg", "masses": 0,
                "pair": {{ "closure": "force", "contact": {{ "restitution": {e:?} }} }},
                "loads": {{ "spring": {{ "constant": "-150 N" }} }} }} }},
            "run": {{ "duration": {:?}, "tolerance": 1e-11, "record": "all", "start": "on_law" }} }}"#,
        turns / 40.0
    )
}

#[test]
fn exact_propagation_and_integration_agree_on_a_cam() {
    for e in [0.0, 0.3] {
        let text = follower(e, 2.0);
        let rows_of = |method| run_text(&text, Some(method)).record.switches;
        let exact = rows_of(Method::Exact);
        let opens = exact.iter().filter(|row| row.what == "opens").count();
        assert!(opens >= 2, "{exact:?}");
        for method in [Method::Radau, Method::Dop853] {
            let rows = rows_of(method);
            assert_eq!(rows.len(), exact.len(), "{method:?} e = {e}");
            for (row, own) in rows.iter().zip(&exact) {
                assert_eq!((row.what, row.flank), (own.what, own.flank), "{method:?}");
                close(row.time, own.time, 1e-7, &format!("{method:?} {own:?}"));
                assert!((row.speed - own.speed).abs() < 1e-5, "{row:?} {own:?}");
            }
        }
    }
}

/// What stands beside a body, and in which order, does not change its impacts.
#[test]
fn impacts_do_not_depend_on_what_stands_beside() {
    let ball = |id: &str, e: f64| {
        format!(
            r#""{id}": {{ "kind": "slider", "input": "table", "position": {{ "sine": {{ "amplitude": 0.02 }} }},
                "inertia": 1, "masses": 0, "pair": {{ "closure": "force", "contact": {{ "restitution": {e:?} }} }},
                "loads": {{ "weight": {{ "constant": -9.81 }} }} }}"#
        )
    };
    let scene = |balls: &[String]| {
        format!(
            r#"{{ "dam": 1, "name": "balls", "objects": {{
                "table": {{ "kind": "drive", "motion": {{ "speed": "40 rad/s" }} }}, {} }},
                "run": {{ "duration": 1, "tolerance": 1e-10, "start": "on_law" }} }}"#,
            balls.join(", ")
        )
    };
    let (one, other) = (ball("one", 0.3), ball("other", 0.6));
    let rows_of = |balls: &[String], method| {
        let all = run_text(&scene(balls), Some(method)).record.switches;
        let own = all.into_iter().filter(|row| row.object == "one");
        own.take(6).collect::<Vec<_>>()
    };
    let alone = rows_of(std::slice::from_ref(&one), Method::Exact);
    assert_eq!(alone.len(), 6);
    for balls in [[one.clone(), other.clone()], [other.clone(), one.clone()]] {
        assert_eq!(rows_of(&balls, Method::Exact), alone);
        for (row, own) in rows_of(&balls, Method::Radau).iter().zip(&alone) {
            close(row.time, own.time, 1e-6, &format!("{own:?}"));
        }
    }
}

/// A rigid valve with lash: it bounces on its seat, is struck by its cam, bounces there and is
/// carried; no energy is lost but in the impacts, and all methods tell the same.
#[test]
fn a_rigid_valve_with_lash_goes_from_its_seat_to_its_cam_and_back() {
    let text = r#"{ "dam": 1, "name": "lash", "objects": {
        "cam": { "kind": "drive", "motion": { "speed": "600 rpm" } },
        "valve": { "kind": "cam_follower", "motion": "sliding", "input": "cam",
            "position": { "cam": { "lift": "9 mm", "rise": "60 deg", "dwell": "10 deg", "return": "60 deg", "rest": "230 deg", "law": "3-4-5" } },
            "inertia": "0.1 kg", "masses": 0, "pair": { "closure": "force", "contact": { "restitution": 0.3 } },
            "loads": { "spring": { "spring": { "rate": "20 N/mm", "preload": "150 N" } } },
            "stops": { "seat": { "at": "0.3 mm", "side": "-", "contact": { "restitution": 0.3 } } } } },
        "run": { "duration": 0.3, "tolerance": 1e-10, "start": "static" } }"#;
    // On the rise U = h·(10τ³ − 15τ⁴ + 6τ⁵), τ = ωt/β, reaches the lash at the speed w.
    let (h, beta, omega, lash) = (
        9e-3,
        60f64.to_radians(),
        600.0 * std::f64::consts::TAU / 60.0,
        0.3e-3,
    );
    let lift = |tau: f64| h * tau.powi(3) * (10.0 - 15.0 * tau + 6.0 * tau * tau);
    let (mut low, mut high) = (0.0, 0.5);
    for _ in 0..80 {
        let middle = 0.5 * (low + high);
        if lift(middle) < lash {
            low = middle;
        } else {
            high = middle;
        }
    }
    let speed = h * 30.0 * high * high * (1.0 - high).powi(2) * omega / beta;
    for &method in INTEGRATED {
        let what = format!("{method:?}");
        let result = run_text(text, Some(method));
        let seat = result.figures.objects["valve.seat"].stop.as_ref().unwrap();
        let own = pair(&result, "valve");
        close(own.max_approach_speed, speed, 1e-7, &what);
        close(seat.max_approach_speed, speed, 1e-7, &what);
        close(
            own.impacts.unwrap().max_impulse,
            0.1 * speed * 1.3,
            1e-7,
            &what,
        );
        // Three turns, in each of which it takes the valve along and lays it down.
        assert_eq!((own.closures, seat.closures), (3, 3), "{what}");
        // On its seat: preload and spring over the lash.
        close(seat.max_contact_force, 156.0, 1e-7, &what);
        assert!(result.figures.run.energy_error < 1e-8, "{what}");
    }
}

/// A ram comes to rest on its stop and leaves it again in every turn, with neither distance nor
/// speed: the polynomial of a step may lie behind the stop there by its error.
#[test]
fn a_stop_that_is_left_without_speed_is_left_once() {
    let text = r#"{ "dam": 1, "name": "Ram on a stop", "objects": {
        "shaft": { "kind": "drive", "motion": { "speed": "600 rpm" } },
        "ram": { "kind": "slider", "input": "shaft", "masses": 1, "inertia": "1 kg",
            "stiffness": "40 N/mm", "damping_capacity": 0.3,
            "position": { "sine": { "amplitude": "10 mm", "phase": "-90 deg", "offset": "10 mm" } },
            "stops": { "seat": { "at": "19 mm", "side": "+", "contact": { "restitution": 0.4 } } } } },
        "run": { "duration": 1, "tolerance": 1e-8 } }"#;
    let places = INTEGRATED.iter().map(|&method| {
        let result = run_text(text, Some(method));
        assert!(
            result.figures.run.complete,
            "{method:?}: {:?}",
            result.outcome.stop
        );
        result.figures.objects["ram"].end.displacement
    });
    let places: Vec<f64> = places.collect();
    for place in &places {
        assert!((place - places[0]).abs() < 1e-8, "{places:?}");
    }
}
