//! Motions that become stiff on the way, springs that hold, motions of drives that change
//! briefly: steps follow what is there, whatever the method.

use approx::assert_relative_eq;
use dam::prelude::*;
use dam::studies::run::RunResult;
use serde_json::{Value, json};

fn run(scene: &Value) -> RunResult {
    let scene = Scene::from_json(&scene.to_string()).expect("a scene");
    scene.run().expect("a run")
}

fn by(scene: &Value, method: &str) -> RunResult {
    let mut scene = scene.clone();
    scene["run"]["method"] = method.into();
    run(&scene)
}

fn figure(result: &RunResult, name: &str) -> f64 {
    let found = result.figures.value(name);
    found.unwrap_or_else(|_| panic!("{name}"))
}

/// A brake on a turning disc, down to a creep: −J·ω̇ = F·tanh(ω/w) − M.
fn brake() -> Value {
    json!({ "dam": 1, "name": "Brake", "objects": { "d": {
        "kind": "drive",
        "motor": { "inertia": 0.5, "speed": 80, "torque": { "constant": 3 } },
        "loads": { "brake": { "friction": { "force": 40, "width": 0.001 } } } } },
        "run": { "duration": 2 } })
}

/// Two inertias, driven and free, that a clutch joins from 0.2 s on.
fn clutch() -> Value {
    let load = |text: &str, over: &str| json!({ "c": { "expression": text, "over": over } });
    json!({ "dam": 1, "name": "Clutch", "objects": {
        "a": { "kind": "drive",
            "motor": { "inertia": 0.4, "speed": 100, "torque": { "constant": 5 } },
            "loads": load("-(t<0.2 ? 0 : 60)*tanh((phi_dot - over_phi_dot)/0.01)", "b") },
        "b": { "kind": "drive",
            "motor": { "inertia": 0.6, "speed": 0, "torque": { "constant": 0 } },
            "loads": load("(t<0.2 ? 0 : 60)*tanh((over_phi_dot - phi_dot)/0.01)", "a") } },
        "run": { "duration": 1.5, "tolerance": 1e-8 } })
}

#[test]
fn a_motion_that_becomes_stiff_goes_on_by_another_method() {
    let found = run(&brake());
    // It slides for 80/74 s, then creeps at w·artanh(3/40).
    assert!(found.is_trusted());
    let creep = 0.001 * 0.075f64.atanh();
    let way = 80.0f64.powi(2) / 148.0 + creep * (2.0 - 80.0 / 74.0);
    let end = figure(&found, "d.final.displacement");
    assert_relative_eq!(end, way, max_relative = 1e-8);
    assert_relative_eq!(figure(&found, "d.final.speed"), creep, max_relative = 1e-4);
    let summary = &found.figures.run;
    assert!(summary.method.ends_with("radau"), "{}", summary.method);
    let best = by(&brake(), "radau").figures.run.evaluations;
    assert!(
        summary.evaluations < 3 * best,
        "{} {best}",
        summary.evaluations
    );

    let found = run(&clutch());
    assert!(found.is_trusted());
    let summary = &found.figures.run;
    assert_eq!(summary.method, "taylor, then radau");
    assert!(summary.why.contains("stiff"), "{}", summary.why);
    // Momentum: 0.4·100 + 5·1.5 = 47.5, on both in the end.
    let [a, b] = ["a", "b"].map(|id| figure(&found, &format!("{id}.final.speed")));
    assert_relative_eq!(0.4 * a + 0.6 * b, 47.5, max_relative = 1e-9);
    assert_relative_eq!(
        figure(&found, "a.final.displacement"),
        91.0463136,
        max_relative = 1e-8
    );
    assert!(found.figures.run.steps < 300, "{}", found.figures.run.steps);
    // One method by name stays what it is, and comes to the same.
    let alone = by(&clutch(), "taylor");
    assert_eq!(alone.figures.run.method, "taylor");
    assert_relative_eq!(
        figure(&alone, "a.final.displacement"),
        91.0463136,
        max_relative = 1e-8
    );
}

/// A damper of 20 kN·m·s that acts from 1 s on, and two clutches in series.
#[test]
fn late_dampers_and_clutches_in_series_take_few_steps() {
    let late = json!({ "dam": 1, "name": "Late", "objects": { "d": { "kind": "drive",
        "motor": { "inertia": 1, "speed": 3, "torque": { "constant": 4 } },
        "loads": { "c": { "expression": "-(t<1 ? 0 : 20000)*phi_dot" } } } },
        "run": { "duration": 3, "tolerance": 1e-8 } });
    let mut series = clutch();
    let slip = "tanh((over_phi_dot - phi_dot)/0.01)";
    series["objects"]["c"] = json!({ "kind": "drive",
        "motor": { "inertia": 0.6, "speed": 0, "torque": { "constant": 0 } },
        "loads": { "e": { "expression": format!("(t<0.5 ? 0 : 40)*{slip}"), "over": "b" } } });
    series["objects"]["b"]["loads"]["e"] =
        json!({ "expression": format!("(t<0.5 ? 0 : 40)*{slip}"), "over": "c" });
    for scene in [late, series] {
        let found = run(&scene);
        assert!(found.is_trusted(), "{:?}", found.warnings);
        let best = by(&scene, "radau");
        let [own, least] = [&found, &best].map(|found| found.figures.run.evaluations);
        assert!(
            found.figures.run.steps < 400 && own < 6 * least,
            "{own} {least}"
        );
        let end = |found: &RunResult| {
            let objects = found.figures.objects.values();
            objects.map(|one| one.end.displacement).sum::<f64>()
        };
        assert_relative_eq!(end(&found), end(&best), max_relative = 1e-7);
    }
}

#[test]
fn a_motion_that_does_not_become_stiff_stays_with_its_method() {
    let mut scene = clutch();
    for id in ["a", "b"] {
        let own = scene["objects"][id]["loads"]["c"]["expression"]
            .as_str()
            .unwrap();
        let soft = own.replace("/0.01)", "/20)").replace("t<0.2", "t<0");
        scene["objects"][id]["loads"]["c"]["expression"] = soft.into();
    }
    scene["run"]["duration"] = 20.into();
    let found = run(&scene);
    assert!(found.is_trusted() && !found.figures.run.method.contains("then"));
}

/// A mass on a cam with a spring to the ground, from soft to much stiffer than what drives it.
fn held(rate: f64) -> Value {
    json!({ "dam": 1, "name": "Held", "objects": {
        "cam": { "kind": "drive", "motion": { "speed": "300 rpm" } },
        "f": { "kind": "slider", "input": "cam", "masses": 1, "inertia": 2,
            "stiffness": 1e5, "damping_capacity": 0.3,
            "position": { "cam": { "lift": "20 mm", "rise": "60 deg", "dwell": "120 deg",
                "return": "60 deg", "law": "cycloidal" } },
            "loads": { "s": { "spring": { "rate": rate } } } } },
        "run": { "duration": 0.033, "tolerance": 1e-9 } })
}

#[test]
fn a_spring_that_holds_does_not_loosen_the_error() {
    for rate in [1e6, 1e7, 1e8, 1e9] {
        let exact = run(&held(rate));
        assert_eq!(exact.figures.run.method, "exact");
        for method in ["radau", "rodas5p", "dop853"] {
            if method == "dop853" && rate > 1e8 {
                continue;
            }
            let found = by(&held(rate), method);
            assert!(found.is_trusted(), "{rate} {method}: {:?}", found.warnings);
            for name in ["f.delta_abs", "f.peak_reaction"] {
                let [a, b] = [&exact, &found].map(|result| figure(result, name));
                assert!(
                    (a - b).abs() < 1e-7 * a.abs(),
                    "{rate} {method} {name}: {a} {b}"
                );
            }
        }
    }
}

/// A wheel on a shaft behind a motion by an expression.
fn behind(motion: &str, duration: f64) -> Value {
    json!({ "dam": 1, "name": "Written", "objects": {
        "d": { "kind": "drive", "motion": { "expression": motion } },
        "w": { "kind": "shaft", "input": "d", "masses": 1, "inertia": 0.05,
            "stiffness": 5000, "damping": 2 } },
        "run": { "duration": duration, "start": "on_law", "tolerance": 1e-8 } })
}

/// Values by scipy's DOP853 at 1e-11, in pieces around the pulse.
#[test]
fn a_brief_motion_is_seen_by_every_method_wherever_it_is() {
    for (place, duration) in [(0.7, 1.7), (0.7131, 20.0)] {
        let mut scene = behind(&format!("0.01*exp(-((t-{place})/0.01)^2)"), duration);
        scene["run"]["tolerance"] = 1e-9.into();
        for method in ["taylor", "radau", "rodas5p", "dop853", "dopri5"] {
            let found = by(&scene, method);
            // (Long behind the pulse nothing but rounding is left for the check of the run.)
            let trusted = found.is_trusted() || duration > 2.0;
            assert!(trusted, "{method}: {:?}", found.warnings);
            let delta = figure(&found, "w.delta_abs");
            assert_relative_eq!(delta, 4.041857e-3, max_relative = 1e-6);
        }
    }
}

/// Values by scipy's DOP853 at 1e-12, piece by piece.
#[test]
fn a_motion_out_of_exact_rest_begins_with_every_method() {
    let mut scene = behind("sin(2*pi*t)>0 ? sin(2*pi*t)^3 : 0", 1.7);
    scene["objects"]["w"]
        .as_object_mut()
        .unwrap()
        .remove("damping");
    scene["objects"]["w"]["damping_capacity"] = 0.3.into();
    for method in ["taylor", "radau", "rodas5p", "dop853"] {
        let found = by(&scene, method);
        assert!(found.is_complete() && found.is_trusted(), "{method}");
        assert_relative_eq!(
            figure(&found, "w.delta_abs"),
            1.19023e-3,
            max_relative = 1e-5
        );
        assert_relative_eq!(
            figure(&found, "w.peak_reaction"),
            5.951,
            max_relative = 1e-4
        );
    }
}

#[test]
fn a_rigid_follower_over_a_moving_ground_touches_it_when_it_does() {
    // The ball falls freely from rest at 0.1 m.
    let clearance = |t: f64| {
        let ground = 0.005 * (60.0 * std::f64::consts::PI * t).sin();
        0.1 - 4.905 * t * t - ground
    };
    let ground = json!({ "kind": "drive", "coordinate": "sliding",
        "motion": { "expression": "0.005*sin(2*pi*30*t)" } });
    let scene = json!({ "dam": 1, "name": "Ground", "objects": { "ground": ground,
        "ball": { "kind": "slider", "input": "ground", "position": { "ratio": 1 },
            "inertia": 0.5, "masses": 0,
            "pair": { "closure": "force", "contact": { "law": "hunt_crossley",
                "stiffness": 1e4, "dissipation": 0.3 } },
            "loads": { "w": { "constant": -4.905 } } } },
        "run": { "duration": 0.17, "start": { "ball": { "displacement": [0.1], "speed": [0] } } } });
    for method in ["auto", "taylor", "radau", "dop853", "rodas5p"] {
        let found = by(&scene, method);
        assert!(found.is_trusted(), "{method}: {:?}", found.warnings);
        let first = figure(&found, "ball.pair.separated_time");
        assert!(
            clearance(first - 1e-6) * clearance(first + 1e-6) < 0.0,
            "{method}: {first}"
        );
    }
}

/// Fast layers behind each closure, thinner than the clock resolves them: no method is doubted
/// for what rounding leaves of them.
#[test]
fn fine_chains_that_strike_are_certified_at_the_first_attempt() {
    let path = concat!(
        env!("CARGO_MANIFEST_DIR"),
        "/scenarios/rocker/two_masses.json"
    );
    let text = std::fs::read_to_string(path).expect("a scenario");
    let mut scene: Value = serde_json::from_str(&text).expect("JSON");
    for masses in [96, 128] {
        scene["objects"]["rocker"]["masses"] = masses.into();
        let found = run(&scene);
        assert!(found.is_trusted(), "{masses}: {}", found.equations);
        let why = &found.figures.run.why;
        assert!(!why.contains("not kept"), "{masses}: {why}");
        assert_eq!(figure(&found, "rocker.pair.separations"), 60.0);
    }
}

/// A drive that rests at the top of a cam for `rest` and makes a stroke in `span` then (s).
fn stroke_after_rest(rest: f64, span: f64) -> Value {
    json!({ "dam": 1, "name": "Stroke after a rest", "objects": {
        "drive": { "kind": "drive", "motion": { "plan": { "stations": [
            { "at": 0, "displacement": 1, "motion": "dwell" },
            { "at": rest, "displacement": 1, "motion": "4-5-6-7" },
            { "at": rest + span, "displacement": 1.05 } ] } } },
        "follower": { "kind": "slider", "input": "drive", "inertia": 0.1, "masses": 1,
            "stiffness": 40000, "damping": 20,
            "position": { "cam": { "rise": "1 rad", "return": "1 rad", "lift": 0.001,
                "law": "parabolic" } } } },
        "run": { "duration": rest + span + 0.1, "start": "kinetostatic", "tolerance": 1e-9 } })
}

#[test]
fn the_torque_of_a_drive_in_a_brief_stroke_is_the_same_by_every_method() {
    for (rest, span) in [(0.5, 2e-4), (5.0, 1e-3), (5.0, 1e-2)] {
        let scene = stroke_after_rest(rest, span);
        let [exact, general] = ["exact", "dop853"].map(|method| by(&scene, method));
        assert!(general.is_trusted());
        let [exact, general] = [exact, general].map(|found| figure(&found, "drive.peak_reaction"));
        assert_relative_eq!(exact, general, max_relative = 2e-8);
    }
}

/// A follower that its cam throws off, behind a drive whose speed goes up and down.
fn thrown() -> Value {
    json!({ "dam": 1, "name": "Thrown", "objects": {
        "a": { "kind": "drive", "motion": {
            "expression": "264*t + 0.3155*sin(604*t)*cos(264*t)" } },
        "c": { "kind": "slider", "input": "a", "inertia": 0.1832, "masses": 1,
            "stiffness": 29280, "damping": 8.137,
            "position": { "cam": { "lift": 0.2478, "rise": "100 deg", "dwell": "40 deg",
                "return": "120 deg", "law": "4-5-6-7" } },
            "pair": { "closure": "force", "law": "hunt_crossley" },
            "loads": { "closing": { "constant": -187.5, "mass": "last" } } } },
        "run": { "duration": 0.11, "start": "on_law", "tolerance": 1e-9, "samples": 65 } })
}

#[test]
fn what_flies_keeps_to_its_parabola_whatever_the_drive_does_meanwhile() {
    let fall = 187.5 / 0.1832;
    for method in ["dop853", "dopri5", "rodas5p", "radau", "taylor"] {
        let found = by(&thrown(), method);
        assert!(found.is_trusted(), "{method}: {:?}", found.warnings);
        let times = &found.record.times;
        let column = |quantity: Quantity| {
            let mut columns = found.record.columns.iter();
            let own = columns.find(|own| own.object == "c" && own.quantity == quantity);
            &own.expect("a column").values
        };
        let (way, speed) = (column(Quantity::Displacement), column(Quantity::Speed));
        let begin = times.iter().position(|time| *time > 0.005).expect("a row");
        let last = times.len() - 1;
        let flight = times[last] - times[begin];
        assert!(flight > 0.1);
        assert_relative_eq!(
            speed[last],
            speed[begin] - fall * flight,
            max_relative = 1e-6
        );
        let landing = way[begin] + (speed[begin] - 0.5 * fall * flight) * flight;
        assert_relative_eq!(way[last], landing, max_relative = 1e-6);
    }
}

#[test]
fn works_behind_a_table_over_time_are_summed_between_its_points() {
    let points = [0.0, -0.048, 0.01, 0.035, 0.142, 0.162, 0.003, 0.153];
    let table: Vec<[f64; 2]> = (0..8)
        .map(|k| [0.25 * f64::from(k), points[k as usize]])
        .collect();
    let scene = json!({ "dam": 1, "name": "Table", "objects": {
        "a": { "kind": "drive", "motion": { "table": table } },
        "c": { "kind": "slider", "input": "a", "inertia": 0.1086, "masses": 0,
            "position": { "ratio": 1.77 },
            "pair": { "closure": "force", "contact": { "restitution": 0.5585 } },
            "loads": { "closing": { "constant": -1.438, "mass": "last" } } } },
        "run": { "duration": 1.75, "tolerance": 1e-9, "samples": 64 } });
    for method in ["dop853", "dopri5", "rodas5p", "radau"] {
        let found = by(&scene, method);
        let error = found.audit.error();
        assert!(error < 1e-12 && found.is_trusted(), "{method}: {error}");
    }
}

/// A pulse of a load at a place that samples of a halved span hit, and a high power of a sine,
/// whose bumps a few samples hit by chance: the speed is the impulse over the inertia.
#[test]
fn pulses_that_single_samples_hit_are_not_passed_over() {
    let scene = |load: &str, speed: f64, duration: f64| {
        json!({ "dam": 1, "name": "Pulses", "objects": { "m": { "kind": "drive",
            "motor": { "inertia": 0.5, "speed": speed, "torque": { "constant": 0 } },
            "loads": { "p": { "expression": load } } } },
            "run": { "duration": duration } })
    };
    let root = std::f64::consts::PI.sqrt();
    for (place, duration) in [(5.0, 8.0), (1.0, 2.0), (3.0, 4.0)] {
        let found = run(&scene(
            &format!("100*exp(-((t-{place})/0.001)^2)"),
            1.0,
            duration,
        ));
        assert!(found.is_trusted(), "{:?}", found.warnings);
        let speed = figure(&found, "m.final.speed");
        assert_relative_eq!(speed, 1.0 + 0.2 * root, max_relative = 1e-6);
    }
    // The mean of sin^200 is C(200, 100)/2^200, over whole periods.
    let mean: f64 = (1..=100)
        .map(|k| (100 + k) as f64 / (4 * k) as f64)
        .product();
    let duration = 4.0 * std::f64::consts::PI / 3.0;
    let found = run(&scene("5*sin(3*t)^200", 0.0, duration));
    assert!(found.is_trusted(), "{:?}", found.warnings);
    let speed = figure(&found, "m.final.speed");
    assert_relative_eq!(speed, 10.0 * mean * duration, max_relative = 1e-5);
}

/// A load that is a pulse once a turn, from the start on: in its narrow pulses it is an
/// impulse on one mass of 0.05 on 50 with the damping 0.05.
#[test]
fn a_load_that_begins_at_the_top_of_its_pulse_is_propagated_exactly() {
    let scene = json!({ "dam": 1, "name": "Pulses", "objects": {
        "m": { "kind": "drive", "motion": { "speed": 2 } },
        "w": { "kind": "shaft", "input": "m", "masses": 1, "inertia": 0.05, "stiffness": 50,
            "damping": 0.05, "loads": { "p": { "expression":
                "50*exp(-((((driver_phi+pi)%(2*pi))-pi)/0.001)^2)" } } } },
        "run": { "duration": 20, "start": "on_law" } });
    let found = run(&scene);
    assert!(found.is_trusted());
    assert_eq!(found.figures.run.method, "exact");
    // By scipy's DOP853 with steps of at most 10 ms, ended at each pulse.
    let end = figure(&found, "w.final.displacement") - 40.0;
    assert_relative_eq!(end, -0.016683982, max_relative = 1e-6);
    assert_relative_eq!(
        figure(&found, "w.delta_abs"),
        0.029441029,
        max_relative = 1e-6
    );
}

/// A rigid contact that begins on its flank with a speed strikes at t = 0.
#[test]
fn an_impact_at_the_start_is_one() {
    let scene = json!({ "dam": 1, "name": "Ball", "objects": {
        "g": { "kind": "drive", "coordinate": "sliding", "motion": { "fixed": 0 } },
        "a": { "kind": "slider", "input": "g", "position": { "ratio": 1 }, "inertia": 0.5,
            "masses": 0, "pair": { "closure": "force", "contact": { "restitution": 0.5 } },
            "loads": { "w": { "constant": -4.905 } } } },
        "run": { "duration": 0.1, "start": { "a": { "displacement": [0], "speed": [-2] } } } });
    for method in ["exact", "dop853"] {
        let found = by(&scene, method);
        assert!(found.is_trusted());
        assert_relative_eq!(
            figure(&found, "a.pair.impacts.max_impulse"),
            1.5,
            max_relative = 1e-9
        );
        assert_relative_eq!(
            figure(&found, "a.pair.impacts.loss"),
            0.75,
            max_relative = 1e-9
        );
        // 1 m/s upwards, less the fall of 0.1 s.
        let end = figure(&found, "a.final.displacement");
        assert_relative_eq!(end, 0.1 - 0.5 * 9.81 * 0.01, max_relative = 1e-9);
    }
}

/// A free rotor of 0.5 kg m² that starts at 10 rad/s passes spikes of a torque over its own
/// angle, once a turn: by every method its speed at the end is that of the work done until
/// there, by quadrature.
#[test]
fn spikes_of_a_torque_over_an_angle_are_met() {
    let inertia = 0.5;
    let mut certified = 0;
    for (text, torque) in spikes() {
        for method in ["auto", "taylor", "dop853", "dopri5", "radau", "rodas5p"] {
            let scene = format!(
                r#"{{ "dam": 1, "name": "spikes", "objects": {{ "m": {{ "kind": "drive",
                    "motor": {{ "inertia": {inertia}, "speed": 10, "torque": {{ "constant": 0 }} }},
                    "loads": {{ "spike": {{ "expression": "{text}" }} }} }} }},
                    "run": {{ "duration": 2.1, "tolerance": 1e-7, "method": "{method}" }} }}"#
            );
            let run = Scene::from_json(&scene).unwrap().run().unwrap();
            if !run.is_trusted() {
                assert_ne!(method, "auto", "{text}");
                continue;
            }
            certified += 1;
            let end = &run.figures.objects["m"].end;
            let work = quadrature(&torque, end.displacement);
            let speed = (100.0 + 2.0 * work / inertia).sqrt();
            assert!(work.abs() > 0.5, "{text}: {work}");
            assert!(
                (end.speed - speed).abs() < 2e-5 * speed,
                "{text} by {method}: {} for {speed}",
                end.speed
            );
        }
    }
    assert!(certified >= 24, "{certified} of 30");
}

type Torque = Box<dyn Fn(f64) -> f64>;

/// Narrow and steep functions of an angle.
fn spikes() -> Vec<(&'static str, Torque)> {
    vec![
        (
            "-8*exp(200*(cos(phi-1)-1))",
            Box::new(|phi| -8.0 * (200.0 * ((phi - 1.0).cos() - 1.0)).exp()),
        ),
        (
            "-20*exp(20000*(cos(phi-2)-1))",
            Box::new(|phi| -20.0 * (20000.0 * ((phi - 2.0).cos() - 1.0)).exp()),
        ),
        (
            "5*cos(phi-0.3)^2000",
            Box::new(|phi| 5.0 * (phi - 0.3).cos().powi(2000)),
        ),
        (
            "-3/(1+1e4*sin(phi/2-1)^2)",
            Box::new(|phi| -3.0 / (1.0 + 1e4 * (phi / 2.0 - 1.0).sin().powi(2))),
        ),
        (
            "-2*(tanh(300*(phi-7))-tanh(300*(phi-7.3)))",
            Box::new(|phi| -2.0 * ((300.0 * (phi - 7.0)).tanh() - (300.0 * (phi - 7.3)).tanh())),
        ),
    ]
}

/// The integral from 0 on by Simpson's rule, fine enough for the narrowest.
fn quadrature(function: &Torque, to: f64) -> f64 {
    let parts = 400_000;
    let step = to / f64::from(parts);
    let at = |k: i32| function(f64::from(k) * 0.5 * step);
    let of_part = |k: i32| at(2 * k) + 4.0 * at(2 * k + 1) + at(2 * k + 2);
    (0..parts).map(of_part).sum::<f64>() * step / 6.0
}

/// Displacement and speed at `end` of a mass of 0.05 on 50 with the damping 0.05, at rest at
/// first, under a load of bumps of a width about their middles: Duhamel's integral, in the
/// middle of each bump as fine as it asks for.
fn under_bumps(load: &dyn Fn(f64) -> f64, middles: &[f64], width: f64, end: f64) -> [f64; 2] {
    let fading: f64 = 0.5;
    let rate = (1000.0 - fading * fading).sqrt();
    let answer = |t: f64| {
        let (sin, cos) = (rate * t).sin_cos();
        let size = (-fading * t).exp() / (0.05 * rate);
        [size * sin, size * (rate * cos - fading * sin)]
    };
    let mut sum = [0.0; 2];
    for (index, &middle) in middles.iter().enumerate() {
        let half_way =
            |other: Option<&f64>, edge: f64| other.map_or(edge, |other| 0.5 * (other + middle));
        let low = half_way(index.checked_sub(1).map(|before| &middles[before]), 0.0);
        let high = half_way(middles.get(index + 1), end);
        let [from, to] = [low, high].map(|at| ((at - middle) / width).asinh());
        let parts = 40_000;
        let part = (to - from) / f64::from(parts);
        for k in 0..=parts {
            let y = from + part * f64::from(k);
            let weight = match k {
                0 => 1.0,
                k if k == parts => 1.0,
                k => 2.0 + 2.0 * f64::from(k % 2),
            };
            let at = middle + width * y.sinh();
            let own = weight * part / 3.0 * width * y.cosh() * load(at);
            let by = answer(end - at);
            sum = [sum[0] + own * by[0], sum[1] + own * by[1]];
        }
    }
    sum
}

/// Bumps of all widths, once a turn and once ever, at the start, in a turn and at odd places:
/// in closed form where their shape can be computed at all.
#[test]
fn bumps_of_loads_are_never_passed_over() {
    let end = 7.0;
    let check = |text: &str, load: &dyn Fn(f64) -> f64, middles: &[f64], width: f64| {
        let found = run(&json!({ "dam": 1, "name": "Bumps", "objects": {
            "m": { "kind": "drive", "motion": { "speed": 2 } },
            "w": { "kind": "shaft", "input": "m", "masses": 1, "inertia": 0.05,
                "stiffness": 50, "damping": 0.05, "loads": { "p": { "expression": text } } } },
            "run": { "duration": end, "start": "on_law" } }));
        assert!(found.is_trusted(), "{text}: {:?}", found.warnings);
        assert_eq!(found.figures.run.method, "exact", "{text}");
        let [place, speed] = under_bumps(load, middles, width, end);
        let own = [
            figure(&found, "w.final.displacement") - 2.0 * end,
            figure(&found, "w.final.speed") - 2.0,
        ];
        let size = place.hypot(speed / 1000f64.sqrt());
        let error = (own[0] - place).hypot((own[1] - speed) / 1000f64.sqrt());
        // (A wide bump hardly moves the mass beyond its end.)
        let near = 1e-6 * size + 1e-12;
        assert!(error < near, "{text}: {own:?}, not {place} {speed}");
    };
    for width in [3e-1, 3e-2, 1e-3, 1e-4, 1e-6] {
        let (height, sharp) = (0.05 / width, 1.0 / (width * width));
        for place in [0.0, 1.0, std::f64::consts::PI, 5.4321] {
            // φ = 2t: a bump in every half of 2π seconds.
            let turn = std::f64::consts::PI;
            let middles: Vec<f64> = (-1..4).map(|k| 0.5 * place + f64::from(k) * turn).collect();
            let middles: Vec<f64> = middles
                .into_iter()
                .filter(|at| (-1.0..=end).contains(at))
                .collect();
            let half = |t: f64| (t - 0.5 * place).sin().powi(2);
            let phi = format!("(driver_phi-{place})");
            if width > 1e-4 {
                let text = format!("{height}*exp({sharp}*(cos{phi}-1))");
                let load = |t: f64| height * (-2.0 * sharp * half(t)).exp();
                check(&text, &load, &middles, width);
                let text = format!("{height}*((1+cos{phi})/2)^{}", sharp.round());
                let load = |t: f64| height * (sharp.round() * (-half(t)).ln_1p()).exp();
                check(&text, &load, &middles, width);
            }
            let text = format!("{height}*exp(-{sharp}*sin({phi}/2)^2)");
            let load = |t: f64| height * (-sharp * half(t)).exp();
            check(&text, &load, &middles, width);
            let text = format!("{height}/(1+{sharp}*sin({phi}/2)^2)");
            let load = |t: f64| height / (1.0 + sharp * half(t));
            check(&text, &load, &middles, width);
            let load = |t: f64| height / (1.0 + ((t - place) / width).powi(2));
            let text = format!("{height}/(1+((t-{place})/{width})^2)");
            check(&text, &load, &[place], width);
            let load = |t: f64| height * (-((t - place) / width).powi(2)).exp();
            let text = format!("{height}*exp(-((t-{place})/{width})^2)");
            check(&text, &load, &[place], width);
            let later = place + 20.0 * width;
            let load = |t: f64| {
                0.05 * height * (((t - place) / width).tanh() - ((t - later) / width).tanh())
            };
            let text = format!(
                "{}*(tanh((t-{place})/{width})-tanh((t-{later})/{width}))",
                0.05 * height
            );
            if later < end {
                check(&text, &load, &[place, later], width);
            }
        }
    }
}

/// A load that comes and goes in steps of 10 or 100 microseconds, a millisecond apart: the greatest
/// speed is the impulse over the inertia.
#[test]
fn steep_steps_of_a_load_leave_no_peak_of_their_own() {
    for (place, width) in [(3.0, 1e-5), (1.7, 1e-5), (4.1, 1e-4)] {
        let later = place + 1e-3;
        let load = format!("3*(tanh((t-{place})/{width})-tanh((t-{later})/{width}))");
        let found = run(&json!({ "dam": 1, "name": "Window", "objects": { "m": {
            "kind": "drive", "motor": { "inertia": 0.5, "torque": { "constant": 0 } },
            "loads": { "p": { "expression": load } } } }, "run": { "duration": 5 } }));
        assert!(found.is_complete());
        for name in ["m.peak_speed", "m.final.speed"] {
            assert_relative_eq!(figure(&found, name), 0.012, max_relative = 1e-4);
        }
    }
}

/// A condition over a product of two functions that are bounded alike is met by every method:
/// sin·cos is below −0.45 for acos(0.9)/π of the time.
#[test]
fn a_condition_over_a_product_is_met() {
    let turns = 10.0;
    let (rate, duration) = (30.0, turns * std::f64::consts::PI / 30.0);
    let share = 0.9f64.acos() / std::f64::consts::PI;
    for method in ["auto", "taylor", "dop853", "dopri5", "radau", "rodas5p"] {
        let text = format!("sin({rate}*t)*cos({rate}*t) < -0.45 ? 10 : 0");
        let found = run(&json!({ "dam": 1, "name": "Product", "objects": { "m": {
            "kind": "drive", "motor": { "inertia": 1, "torque": { "constant": 0 } },
            "loads": { "p": { "expression": text } } } },
            "run": { "duration": duration, "method": method, "tolerance": 1e-9 } }));
        let speed = figure(&found, "m.final.speed");
        assert_relative_eq!(speed, 10.0 * share * duration, max_relative = 1e-6);
    }
}
