//! Dry friction that sticks: closed forms, event-driven references, laws that must hold.

use dam::integrate::Method;
use dam::lower::lower;
use dam::record::ObjectFigures;
use dam::scene::{BuiltIn, Document, Overrides};
use dam::studies::run::{RunResult, run};
use dam::studies::{Control, RunSettings};
use dam::system::System;
use std::f64::consts::PI;
use std::fmt::Write;

pub(super) const METHODS: [Method; 4] = [
    Method::Dop853,
    Method::Rodas5p,
    Method::Radau,
    Method::Dopri5,
];

pub(super) fn system(text: &str) -> System {
    let document = Document::parse("friction.json", text.as_bytes()).expect(text);
    let read = document.scene(&BuiltIn, &Overrides::none()).expect(text);
    System::new(lower(&read.scene).expect(text)).expect(text)
}

pub(super) fn refused(text: &str) -> String {
    let document = Document::parse("friction.json", text.as_bytes()).expect(text);
    let faults = match document.scene(&BuiltIn, &Overrides::none()) {
        Err(faults) => faults,
        Ok(read) => match lower(&read.scene) {
            Err(faults) => return format!("{faults:?}"),
            Ok(model) => return format!("{:?}", System::new(model).err()),
        },
    };
    format!("{faults:?}")
}

pub(super) fn ran(system: &System, method: Method, duration: f64, tolerance: f64) -> RunResult {
    let settings = RunSettings {
        method: Some(method),
        tolerance,
        ..RunSettings::new(duration)
    };
    let result = run(system, &settings, &Control::FREE, &mut []).expect("it runs");
    assert!(result.is_complete(), "{method:?}");
    assert!(
        result.is_trusted(),
        "{method:?} {:?} {:?}",
        result.audit,
        result.equations
    );
    result
}

pub(super) fn figures<'r>(result: &'r RunResult, object: &str) -> &'r ObjectFigures {
    &result.figures.objects[object]
}

/// A slide on a spring to `driver` with one or several loads, at rest at a place.
fn slide(driver: &str, numbers: [f64; 3], loads: &str, place: f64) -> String {
    let [mass, stiffness, damping] = numbers;
    format!(
        r#"{{ "dam": 1, "name": "friction", "objects": {{
            "stand": {{ "kind": "drive", "coordinate": "sliding", "motion": {driver} }},
            "slide": {{ "kind": "slider", "input": "stand", "position": {{ "ratio": 1 }},
                "inertia": {mass}, "stiffness": {stiffness}, "damping": {damping}, "masses": 1,
                "loads": {{ {loads} }} }} }},
            "run": {{ "duration": 1,
                "start": {{ "slide": {{ "displacement": [{place}], "speed": [0] }} }} }} }}"#
    )
}

const STILL: &str = r#"{ "expression": "0*t" }"#;

#[test]
fn free_swings_shrink_by_twice_the_sliding_deflection_until_they_rest() {
    let (mass, stiffness, sliding, most): (f64, f64, f64, f64) = (2.0, 800.0, 6.0, 8.0);
    let friction =
        format!(r#""rub": {{ "friction": {{ "sliding": {sliding}, "static": {most} }} }}"#);
    for start in [0.103f64, -0.0777, 0.0101, 0.0099] {
        let text = slide(STILL, [mass, stiffness, 0.0], &friction, start);
        let (mut place, mut swings, mut way) = (start, 0, 0.0);
        while stiffness * place.abs() > most {
            let next = -place + 2.0 * place.signum() * sliding / stiffness;
            way += (next - place).abs();
            (place, swings) = (next, swings + 1);
        }
        for method in METHODS {
            let result = ran(&system(&text), method, 2.0, 1e-10);
            let own = figures(&result, "slide");
            let rubs = own.joints.as_ref().expect("friction");
            assert!(
                (own.end.displacement - place).abs() < 1e-9,
                "{method:?} {start}"
            );
            assert_eq!(rubs.standstills, swings, "{method:?} {start}");
            assert!(own.end.speed.abs() < 1e-14, "{method:?} {start}");
            let rest = 2.0 - swings as f64 * PI * (mass / stiffness).sqrt();
            assert!(
                (rubs.time_at_rest - rest).abs() < 1e-8,
                "{method:?} {start}"
            );
            assert!(
                (rubs.friction_loss - sliding * way).abs() < 1e-8,
                "{method:?} {start}"
            );
        }
    }
}

/// Time at rest, greatest speed and displacement of a slide that is pulled at 0.1 m/s through a
/// spring of 100 N/m, 1 kg, by closed form over so many slips.
fn pulled([sliding, most]: [f64; 2], slips: i32) -> [f64; 4] {
    let (rate, speed): (f64, f64) = (10.0, 0.1);
    let drop = (most - sliding) / 100.0;
    let slip = 2.0 * (PI - (rate * drop / speed).atan()) / rate;
    let stick = 2.0 * drop / speed;
    let peak = speed + speed.hypot(rate * drop);
    let many = f64::from(slips);
    let rest = most / (100.0 * speed) + stick * many;
    [
        rest + many * slip,
        rest,
        peak,
        many * speed * (slip + stick),
    ]
}

#[test]
fn a_pulled_slide_sticks_and_slips_by_closed_form() {
    for numbers in [[4.0, 6.0], [1.0, 6.0], [3.9, 4.0]] {
        let [sliding, most] = numbers;
        let friction =
            format!(r#""rub": {{ "friction": {{ "sliding": {sliding}, "static": {most} }} }}"#);
        let text = slide(r#"{ "speed": 0.1 }"#, [1.0, 100.0, 0.0], &friction, 0.0);
        let [until, rest, peak, way] = pulled(numbers, 4);
        for method in METHODS {
            let result = ran(&system(&text), method, until, 1e-10);
            let own = figures(&result, "slide");
            let rubs = own.joints.as_ref().expect("friction");
            assert!(
                (own.peak_speed - peak).abs() < 1e-8,
                "{method:?} {}",
                own.peak_speed
            );
            assert!((own.end.displacement - way).abs() < 1e-8, "{method:?}");
            assert!((rubs.time_at_rest - rest).abs() < 1e-7, "{method:?}");
        }
    }
}

#[test]
fn without_a_static_excess_a_pulled_slide_sticks_once() {
    let friction = r#""rub": { "friction": { "sliding": 4 } }"#;
    let text = slide(r#"{ "speed": 0.1 }"#, [1.0, 100.0, 0.0], friction, 0.0);
    for method in METHODS {
        let result = ran(&system(&text), method, 3.0, 1e-10);
        let own = figures(&result, "slide");
        // v·t − v/ω·sin ωt after 0.4 s, which comes to a touch of rest each period.
        let t: f64 = 2.6;
        let place = 0.1 * t - 0.01 * (10.0 * t).sin();
        assert!((own.end.displacement - place).abs() < 1e-8, "{method:?}");
    }
}

#[test]
fn falling_friction_keeps_to_the_reference() {
    // tests/reference/dry_friction.json, stribeck: times of slip and stick.
    let friction =
        r#""rub": { "friction": { "sliding": 4, "static": 6, "stribeck_speed": 0.05 } }"#;
    let text = slide(r#"{ "speed": 0.1 }"#, [1.0, 100.0, 0.0], friction, 0.0);
    let rest = 0.6
        + (1.4811225260816 - 1.0340196877864)
        + (2.3622450521633 - 1.9151422138681)
        + (3.0 - 2.7962647399497);
    for method in METHODS {
        let result = ran(&system(&text), method, 3.0, 1e-11);
        let own = figures(&result, "slide");
        let rubs = own.joints.as_ref().expect("friction");
        assert!(
            (own.end.displacement - 0.26433675782449).abs() < 1e-8,
            "{method:?}"
        );
        assert!(
            (rubs.time_at_rest - rest).abs() < 1e-7,
            "{method:?} {}",
            rubs.time_at_rest
        );
    }
}

#[test]
fn a_harmonic_force_leaves_the_amplitude_of_den_hartog() {
    let (stiffness, friction, force, rate): (f64, f64, f64, f64) = (400.0, 3.0, 10.0, 12.0);
    let ratio = rate / stiffness.sqrt();
    let v = 1.0 / (1.0 - ratio * ratio);
    let u = (PI / ratio).sin() / (ratio * (1.0 + (PI / ratio).cos()));
    let amplitude = ((force / stiffness * v).powi(2) - (friction / stiffness * u).powi(2)).sqrt();
    assert!((amplitude - 0.038_390_045_232_021_63).abs() < 1e-15);
    let frequency = rate / (2.0 * PI);
    let loads = format!(
        r#""rub": {{ "friction": {{ "sliding": {friction} }} }},
           "shake": {{ "harmonic": {{ "amplitude": {force}, "frequency": {frequency} }} }}"#
    );
    let text = slide(STILL, [1.0, stiffness, 0.0], &loads, 0.0);
    let settings = RunSettings {
        method: Some(Method::Radau),
        tolerance: 1e-9,
        window: Some((118.0, 120.0)),
        samples: 600_000,
        ..RunSettings::new(120.0)
    };
    let result = run(&system(&text), &settings, &Control::FREE, &mut []).expect("it runs");
    assert!(result.is_complete() && result.is_trusted());
    let column = result
        .record
        .column("slide", dam::record::Quantity::Displacement)
        .expect("a column");
    let late = column.values.iter().zip(&result.record.times);
    let late = late.filter(|(_, time)| **time > 118.0);
    let found = late.fold(0.0, |most: f64, (x, _)| most.max(x.abs()));
    assert!(
        (found / amplitude - 1.0).abs() < 1e-5,
        "{found} {amplitude}"
    );
}

#[test]
fn frictions_on_one_mass_add_up_and_none_is_none() {
    let [one, three, none, zero] = [
        r#""a": { "friction": { "sliding": 4, "static": 6 } }"#,
        r#""a": { "friction": { "sliding": 1, "static": 1 } },
           "b": { "friction": { "sliding": 2, "static": 3 } },
           "c": { "friction": { "sliding": 1, "static": 2 } }"#,
        "",
        r#""a": { "friction": { "sliding": 0 } }"#,
    ]
    .map(|loads| {
        let text = slide(r#"{ "speed": 0.1 }"#, [1.0, 100.0, 0.5], loads, 0.0);
        ran(&system(&text), Method::Radau, 3.0, 1e-11)
    });
    let same = |one: &RunResult, other: &RunResult| {
        let [one, other] = [one, other].map(|result| figures(result, "slide"));
        assert!((one.end.displacement - other.end.displacement).abs() < 1e-9);
        assert!((one.peak_reaction - other.peak_reaction).abs() < 1e-7);
    };
    same(&one, &three);
    same(&none, &zero);
    let loss = |result: &RunResult| {
        figures(result, "slide")
            .joints
            .as_ref()
            .map(|f| f.friction_loss)
    };
    let [one, three] = [&one, &three].map(|result| loss(result).expect("friction"));
    assert!((one - three).abs() < 1e-8, "{one} {three}");
    assert_eq!(loss(&zero), None);
}

/// A block on a belt of 0.1 m/s, held by a spring to the ground: the same as one that is pulled.
#[test]
fn a_block_on_a_belt_moves_as_one_that_is_pulled_seen_from_the_belt() {
    let text = r#"{ "dam": 1, "name": "friction", "objects": {
        "stand": { "kind": "drive", "coordinate": "sliding", "motion": { "expression": "0*t" } },
        "belt": { "kind": "drive", "coordinate": "sliding", "motion": { "speed": 0.1 } },
        "block": { "kind": "slider", "input": "stand", "position": { "ratio": 1 },
            "inertia": 1, "stiffness": 100, "damping": 0, "masses": 1,
            "loads": { "rub": { "friction": { "sliding": 4, "static": 6 }, "over": "belt" } } } },
        "run": { "duration": 1,
            "start": { "block": { "displacement": [0], "speed": [0.1] } } } }"#;
    let [until, rest, _, way] = pulled([4.0, 6.0], 3);
    for method in METHODS {
        let result = ran(&system(text), method, until, 1e-10);
        let own = figures(&result, "block");
        let rubs = own.joints.as_ref().expect("friction");
        assert!(
            (own.end.displacement - (0.1 * until - way)).abs() < 1e-8,
            "{method:?}"
        );
        assert!((rubs.time_at_rest - rest).abs() < 1e-7, "{method:?}");
        assert_eq!(rubs.standstills, 3, "{method:?}");
        let belt = figures(&result, "belt").peak_reaction;
        assert!((belt - 6.0).abs() < 1e-6, "{method:?}: {belt}");
    }
}

/// Two rotors joined by a dry clutch, with a torque on the first.
fn clutch(torque: &str, speeds: [f64; 2], friction: &str) -> String {
    let [one, other] = speeds;
    format!(
        r#"{{ "dam": 1, "name": "friction", "objects": {{
            "motor": {{ "kind": "drive",
                "motor": {{ "inertia": 0.4, "speed": {one}, "torque": {torque} }} }},
            "wheel": {{ "kind": "drive",
                "motor": {{ "inertia": 0.6, "speed": {other}, "torque": {{ "constant": 0 }} }},
                "loads": {{ "clutch": {{ "friction": {friction}, "over": "motor" }} }} }} }},
            "run": {{ "duration": 1 }} }}"#
    )
}

#[test]
fn a_clutch_that_slips_loses_what_the_balance_of_momentum_leaves() {
    let text = clutch(r#"{ "constant": 5 }"#, [100.0, 0.0], r#"{ "sliding": 60 }"#);
    let slip = 100.0 / (55.0 / 0.4 + 60.0 / 0.6);
    let angle = 0.5 * 100.0 * slip;
    for method in METHODS {
        let result = ran(&system(&text), method, 1.5, 1e-10);
        for object in ["motor", "wheel"] {
            let speed = figures(&result, object).end.speed;
            assert!((speed - 47.5).abs() < 1e-8, "{method:?}: {speed}");
        }
        let rubs = figures(&result, "wheel").joints.expect("friction");
        assert!(
            (rubs.friction_loss - 60.0 * angle).abs() < 1e-6,
            "{method:?}"
        );
        assert!(
            (rubs.time_at_rest - (1.5 - slip)).abs() < 1e-9,
            "{method:?}"
        );
    }
}

#[test]
fn a_clutch_holds_while_the_power_flow_reverses_through_zero() {
    // The clutch has 0.6 of the torque to carry: up to 0.6·10 N m, forwards and backwards.
    let torque = r#"{ "expression": "10*cos(7*t)" }"#;
    for (limit, holds) in [(6.001, true), (5.9, false)] {
        let friction = format!(r#"{{ "sliding": {limit} }}"#);
        let result = ran(
            &system(&clutch(torque, [3.0, 3.0], &friction)),
            Method::Radau,
            3.0,
            1e-10,
        );
        let [motor, wheel] = ["motor", "wheel"].map(|object| figures(&result, object).end.speed);
        let rubs = figures(&result, "wheel").joints.expect("friction");
        if holds {
            let speed = 3.0 + 10.0 / 7.0 * (21.0f64).sin();
            assert!((motor - speed).abs() < 1e-8 && (wheel - speed).abs() < 1e-8);
            assert_eq!((rubs.standstills, rubs.time_at_rest), (0, 3.0));
        } else {
            assert!(rubs.time_at_rest < 3.0 && rubs.friction_loss > 0.0);
        }
    }
}

/// Times at which a rotor (1 kg m², 3 N m sliding, 5 N m at rest) under a harmonic torque breaks
/// loose and comes to rest: (rest, standstills) by its closed form between events.
fn shaken(torque: f64, rate: f64, until: f64) -> (f64, u64) {
    let (sliding, most) = (3.0f64, 5.0f64);
    let root = |mut low: f64, mut high: f64, f: &dyn Fn(f64) -> f64| {
        for _ in 0..200 {
            let middle = 0.5 * (low + high);
            match f(low) * f(middle) > 0.0 {
                true => low = middle,
                false => high = middle,
            }
        }
        high
    };
    let (mut time, mut rest, mut stops) = (0.0f64, 0.0, 0);
    let step = 1e-4 / rate;
    loop {
        let from = time;
        let force = |t: f64| torque * (rate * t).sin();
        while force(time).abs() <= most && time < until {
            time += step;
        }
        if time >= until {
            return (rest + until - from, stops);
        }
        let loose = root(time - step, time, &|t| force(t).abs() - most);
        rest += loose - from;
        let sense = force(loose).signum();
        let speed = move |t: f64| {
            sense * (torque / rate) * ((rate * loose).cos() - (rate * t).cos())
                - sliding * (t - loose)
        };
        time = loose + step;
        while speed(time) > 0.0 {
            time += step;
        }
        time = root(time - step, time, &speed);
        if time > until {
            return (rest, stops);
        }
        stops += 1;
    }
}

#[test]
fn what_rests_breaks_loose_at_every_short_excess_of_its_force() {
    for (torque, frequency, until) in [(5.05, 10.0, 3.0), (5.0001, 10.0, 3.0), (5.2, 50.0, 1.0)] {
        let rate = 2.0 * PI * frequency;
        let (rest, stops) = shaken(torque, rate, until);
        let text = format!(
            r#"{{ "dam": 1, "name": "friction", "objects": {{
                "motor": {{ "kind": "drive",
                    "motor": {{ "inertia": 1, "speed": 0, "torque": {{ "constant": 0 }} }},
                    "loads": {{
                        "rub": {{ "friction": {{ "sliding": 3, "static": 5 }} }},
                        "shake": {{ "expression": "{torque}*sin({rate}*t)" }} }} }} }},
                "run": {{ "duration": {until} }} }}"#
        );
        for method in [Method::Radau, Method::Dop853] {
            let result = ran(&system(&text), method, until, 1e-9);
            let rubs = figures(&result, "motor").joints.expect("friction");
            assert_eq!(rubs.standstills, stops, "{method:?} {torque} {frequency}");
            assert!(
                (rubs.time_at_rest - rest).abs() < 1e-6,
                "{method:?} {} {rest}",
                rubs.time_at_rest
            );
        }
    }
}

#[test]
fn what_is_held_from_the_start_does_not_creep() {
    for friction in [
        r#"{ "sliding": 3, "static": 5 }"#,
        r#"{ "sliding": 3, "static": 4 }"#,
    ] {
        let text = format!(
            r#"{{ "dam": 1, "name": "friction", "objects": {{
                "motor": {{ "kind": "drive",
                    "motor": {{ "inertia": 1, "speed": 0, "torque": {{ "constant": 4 }} }},
                    "loads": {{ "rub": {{ "friction": {friction} }} }} }} }},
                "run": {{ "duration": 1 }} }}"#
        );
        for method in METHODS {
            let result = ran(&system(&text), method, 2.0, 1e-9);
            let own = figures(&result, "motor");
            assert_eq!(
                (own.end.displacement, own.peak_speed),
                (0.0, 0.0),
                "{method:?}"
            );
        }
    }
}

/// A block that rests on the ground and on a belt, which starts after a while: the stronger
/// friction keeps it, and the other slides.
#[test]
fn a_block_between_ground_and_belt_goes_with_the_stronger() {
    let text = |ground: f64, belt: f64| {
        format!(
            r#"{{ "dam": 1, "name": "friction", "objects": {{
                "belt": {{ "kind": "drive", "coordinate": "sliding",
                    "motion": {{ "expression": "t < 0.5 ? 0 : 0.2*(t - 0.5)^2" }} }},
                "block": {{ "kind": "drive", "coordinate": "sliding",
                    "motor": {{ "inertia": 2, "speed": 0, "force": {{ "constant": 0 }} }},
                    "loads": {{
                        "ground": {{ "friction": {{ "sliding": {ground} }} }},
                        "belt": {{ "friction": {{ "sliding": {belt} }}, "over": "belt" }} }} }} }},
                "run": {{ "duration": 1.5 }} }}"#
        )
    };
    for method in [Method::Radau, Method::Dop853] {
        let kept = ran(&system(&text(3.0, 2.0)), method, 1.5, 1e-9);
        let own = figures(&kept, "block");
        assert!(
            own.end.displacement.abs() < 1e-12,
            "{method:?} {}",
            own.end.displacement
        );
        // 2 N against the way of the belt, 0.2 m in the second that it moves.
        let lost = own.joints.expect("friction").friction_loss;
        assert!((lost - 0.4).abs() < 1e-7, "{method:?} {lost}");
        // The belt takes it along: 0.4 m/s² needs 0.8 N beside the 3 N of the ground.
        let taken = ran(&system(&text(3.0, 4.0)), method, 1.5, 1e-9);
        let own = figures(&taken, "block");
        assert!(
            (own.end.displacement - 0.2).abs() < 1e-6,
            "{method:?} {}",
            own.end.displacement
        );
    }
}

#[test]
fn frictions_in_a_loop_are_refused() {
    let text = r#"{ "dam": 1, "name": "friction", "objects": {
        "a": { "kind": "drive", "motor": { "inertia": 1, "speed": 0, "torque": { "constant": 3 } },
            "loads": { "g": { "friction": { "sliding": 1 } } } },
        "b": { "kind": "drive", "motor": { "inertia": 1, "speed": 0, "torque": { "constant": 0 } },
            "loads": { "g": { "friction": { "sliding": 1 } },
                "c": { "friction": { "sliding": 1 }, "over": "a" } } } },
        "run": { "duration": 1 } }"#;
    assert!(refused(text).contains("loop"), "{}", refused(text));
}

#[test]
fn two_clutches_that_stick_at_once_carry_their_shares() {
    // Three wheels in a row: pulled by 3 N m the joints carry 2 and 1 of it.
    let text = |limits: [f64; 2]| {
        format!(
            r#"{{ "dam": 1, "name": "friction", "objects": {{
            "a": {{ "kind": "drive", "motor": {{ "inertia": 1, "speed": 0, "torque": {{ "constant": 3 }} }} }},
            "b": {{ "kind": "drive", "motor": {{ "inertia": 1, "speed": 0, "torque": {{ "constant": 0 }} }},
                "loads": {{ "j": {{ "friction": {{ "sliding": {} }}, "over": "a" }} }} }},
            "c": {{ "kind": "drive", "motor": {{ "inertia": 1, "speed": 0, "torque": {{ "constant": 0 }} }},
                "loads": {{ "k": {{ "friction": {{ "sliding": {} }}, "over": "b" }} }} }} }},
            "run": {{ "duration": 2 }} }}"#,
            limits[0], limits[1]
        )
    };
    let speeds = |limits: [f64; 2]| {
        let result = ran(&system(&text(limits)), Method::Radau, 2.0, 1e-10);
        ["a", "b", "c"].map(|object| figures(&result, object).end.speed)
    };
    let near = |found: [f64; 3], right: [f64; 3]| {
        for (found, right) in found.iter().zip(right) {
            assert!((found - right).abs() < 1e-8, "{found} {right}");
        }
    };
    near(speeds([2.1, 1.1]), [2.0, 2.0, 2.0]);
    // The first slips: b and c go with half of its friction each.
    near(speeds([1.6, 1.1]), [2.0 * 1.4, 1.6, 1.6]);
    // The second slips: a and b share what it leaves.
    near(speeds([2.1, 0.9]), [2.1, 2.1, 1.8]);
    near(speeds([1.6, 0.7]), [2.0 * 1.4, 2.0 * 0.9, 1.4]);
}

/// A crank that runs out, its rigid ram rubbing: on a dead centre the ram stops, the crank does not.
#[test]
fn a_rigid_ram_turns_in_its_dead_centres_and_stops_its_crank() {
    let text = |friction: &str| {
        format!(
            r#"{{ "dam": 1, "name": "friction", "objects": {{
                "main": {{ "kind": "drive",
                    "motor": {{ "inertia": 0.05, "speed": 10, "torque": {{ "constant": 0 }} }} }},
                "ram": {{ "kind": "slider", "input": "main", "masses": 0, "inertia": 2,
                    "position": {{ "slider_crank": {{ "crank": 0.05, "rod": 0.2 }} }},
                    "loads": {{ "gib": {{ "friction": {friction} }} }} }} }},
                "run": {{ "duration": 1 }} }}"#
        )
    };
    // All of ½·0.05·10² J goes into friction of 20 N; at the start the ram stands in a dead centre.
    let dry = system(&text(r#"{ "sliding": 20, "static": 30 }"#));
    let smooth = system(&text(r#"{ "force": 20, "width": 1e-6 }"#));
    let smooth = ran(&smooth, Method::Radau, 3.0, 1e-10);
    for method in [Method::Radau, Method::Dop853] {
        let result = ran(&dry, method, 3.0, 1e-10);
        let rubs = figures(&result, "ram").joints.expect("friction");
        assert!(
            (rubs.friction_loss - 2.5).abs() < 1e-7,
            "{method:?} {}",
            rubs.friction_loss
        );
        assert_eq!(rubs.standstills, 2, "{method:?}");
        let [place, near] = [&result, &smooth].map(|run| figures(run, "main").end.displacement);
        assert!((place - near).abs() < 1e-5, "{method:?} {place} {near}");
    }
}

#[test]
fn random_chains_keep_their_balance_and_methods_agree() {
    let mut seed = 7u64;
    let mut random = |from: f64, to: f64| {
        seed = seed
            .wrapping_mul(6_364_136_223_846_793_005)
            .wrapping_add(1_442_695_040_888_963_407);
        from + (to - from) * (seed >> 11) as f64 / (1u64 << 53) as f64
    };
    for scene in 0..12 {
        let count = 1 + scene % 3;
        let mut objects = format!(
            r#""base": {{ "kind": "drive", "coordinate": "sliding",
                "motion": {{ "expression": "{}*sin({}*t)" }} }}"#,
            random(0.01, 0.03),
            random(8.0, 30.0)
        );
        for k in 0..count {
            let driver = if k == 0 {
                "base".to_owned()
            } else {
                format!("m{}", k - 1)
            };
            let sliding = random(0.5, 4.0);
            let most = sliding * random(1.0, 1.6);
            let over = match scene % 2 == 1 && k > 0 {
                true => format!(r#", "over": "{driver}""#),
                false => String::new(),
            };
            write!(
                objects,
                r#", "m{k}": {{ "kind": "slider", "input": "{driver}", "position": {{ "ratio": 1 }},
                    "inertia": {}, "stiffness": {}, "damping": {}, "masses": 1,
                    "loads": {{ "rub": {{ "friction": {{ "sliding": {sliding}, "static": {most} }}{over} }} }} }}"#,
                random(0.3, 2.0),
                random(300.0, 1200.0),
                random(0.5, 3.0),
            )
            .expect("text");
        }
        let starts: Vec<String> = (0..count)
            .map(|k| format!(r#""m{k}": {{ "displacement": [0], "speed": [0] }}"#))
            .collect();
        let text = format!(
            r#"{{ "dam": 1, "name": "friction", "objects": {{ {objects} }},
                "run": {{ "duration": 1, "start": {{ {} }} }} }}"#,
            starts.join(", ")
        );
        let system = system(&text);
        let [one, other] =
            [Method::Radau, Method::Dop853].map(|method| ran(&system, method, 1.0, 1e-10));
        for k in 0..count {
            let name = format!("m{k}");
            let [one, other] = [&one, &other].map(|result| figures(result, &name));
            let off = (one.end.displacement - other.end.displacement).abs();
            assert!(off < 1e-7, "scene {scene}, {name}: {off}\n{text}");
        }
    }
}

#[test]
fn what_is_no_dry_friction_is_refused_with_the_reason() {
    let with = |friction: &str| {
        let loads = format!(r#""rub": {{ "friction": {friction} }}"#);
        refused(&slide(STILL, [1.0, 100.0, 0.0], &loads, 0.0))
    };
    for (friction, words) in [
        (
            r#"{ "sliding": 4, "static": 3 }"#,
            "`static` is less than `sliding`",
        ),
        (r#"{ "sliding": -4 }"#, "sliding"),
        (
            r#"{ "sliding": 4, "stribeck_speed": 0.1 }"#,
            "without `static`",
        ),
        (r#"{ "sliding": 4, "width": 0.1 }"#, "no `width`"),
        (
            r#"{ "force": 4, "width": 0.1, "static": 5 }"#,
            "no `static`",
        ),
        (r#"{ "force": 4 }"#, "width"),
        (r#"{ }"#, "sliding"),
        (
            r#"{ "sliding": 4, "static": 6, "stribeck_speed": 0 }"#,
            "stribeck_speed",
        ),
    ] {
        let message = with(friction);
        assert!(message.contains(words), "{friction}: {message}");
    }
    let over = |over: &str| {
        let loads = format!(r#""rub": {{ "friction": {{ "sliding": 4 }}, "over": "{over}" }}"#);
        refused(&slide(STILL, [1.0, 100.0, 0.0], &loads, 0.0))
    };
    assert!(over("slide").contains("rub on itself"), "{}", over("slide"));
    assert!(over("nothing").contains("nothing"), "{}", over("nothing"));
}
