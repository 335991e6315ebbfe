//! Exact propagation of scenes against integration at a tight tolerance, and
//! what it refuses.

use dam::exact::{Parts, Request};
use dam::fault::Fault;
use dam::integrate::Method;
use dam::lower::lower;
use dam::record::Quantity;
use dam::scene::{BuiltIn, Document, Overrides};
use dam::studies::run::{RunResult, run};
use dam::studies::{Control, RunSettings, Warning};
use dam::system::System;
use serde_json::{Value, json};

fn prepare(objects: &Value, run: &Value) -> Result<(System, RunSettings), String> {
    let text = json!({ "dam": 1, "name": "test", "objects": objects, "run": run }).to_string();
    let document = Document::parse("scene.json", text.as_bytes()).expect("a document");
    let reading = document
        .scene(&BuiltIn, &Overrides::none())
        .map_err(|faults| faults.to_string())?;
    let model = lower(&reading.scene).map_err(|faults| format!("{faults:?}"))?;
    let system = System::new(model).map_err(|faults| format!("{faults:?}"))?;
    let settings = RunSettings::of(&reading.scene).map_err(|fault| format!("{fault:?}"))?;
    Ok((system, settings))
}

fn solve(
    system: &System,
    settings: &RunSettings,
    method: Method,
    tolerance: f64,
) -> Result<RunResult, Vec<Fault>> {
    let settings = RunSettings {
        method: Some(method),
        tolerance,
        ..settings.clone()
    };
    run(system, &settings, &Control::default(), &mut [])
}

/// Deterministic random numbers (SplitMix64).
struct Random(u64);

impl Random {
    fn unit(&mut self) -> f64 {
        self.0 = self.0.wrapping_add(0x9E37_79B9_7F4A_7C15);
        let mut z = self.0;
        z = (z ^ (z >> 30)).wrapping_mul(0xBF58_476D_1CE4_E5B9);
        z = (z ^ (z >> 27)).wrapping_mul(0x94D0_49BB_1331_11EB);
        ((z ^ (z >> 31)) >> 11) as f64 / (1u64 << 53) as f64
    }

    fn between(&mut self, low: f64, high: f64) -> f64 {
        low + (high - low) * self.unit()
    }

    fn below(&mut self, count: usize) -> usize {
        (self.unit() * count as f64) as usize
    }

    fn signed(&mut self, low: f64, high: f64) -> f64 {
        let size = self.between(low, high);
        if self.below(2) == 0 { size } else { -size }
    }
}

fn drive(random: &mut Random) -> Value {
    let speed = random.signed(15.0, 60.0);
    match random.below(4) {
        0 => json!({ "kind": "drive", "motion": { "run_up": { "speed": speed, "time": 0.12 } } }),
        1 => {
            let points: Vec<_> = (0..6)
                .map(|k| json!([0.05 * f64::from(k), random.between(-2.0, 2.0)]))
                .collect();
            json!({ "kind": "drive", "motion": { "table": points } })
        }
        _ => {
            json!({ "kind": "drive", "motion": { "speed": speed, "angle": random.between(0.0, 6.0) } })
        }
    }
}

/// A position function for something that turns.
fn position(random: &mut Random) -> Value {
    match random.below(7) {
        0 => json!({ "ratio": random.signed(0.3, 2.0) }),
        1 => {
            json!({ "sine": { "amplitude": random.between(0.05, 0.5), "harmonic": 1 + random.below(3), "phase": 0.4 } })
        }
        2 => json!({ "polynomial": { "coefficients": [0.1, 0.2, random.between(-0.01, 0.01)] } }),
        3 => {
            let top = random.between(0.1, 0.4);
            json!({ "table": { "periodic": true, "points":
                [[0, 0], [1, 0.4 * top], [2, top], [4, 0.3 * top], [std::f64::consts::TAU, 0]] } })
        }
        4 => {
            json!({ "four_bar": { "crank": 0.04, "coupler": 0.12, "rocker": 0.1, "frame": 0.13, "phase": random.between(0.0, 6.0) } })
        }
        _ => {
            let laws = [
                "harmonic",
                "cycloidal",
                "3-4-5",
                "4-5-6-7",
                "modified_trapezoid",
            ];
            json!({ "cam": { "lift": random.signed(0.05, 0.3), "rise": "100 deg", "dwell": "30 deg",
                "return": format!("{} deg", random.between(80.0, 150.0)), "phase": "-20 deg",
                "law": { "rise": laws[random.below(5)], "return": laws[random.below(5)] } } })
        }
    }
}

fn loads(random: &mut Random, over_position: bool) -> Value {
    let mut loads = json!({});
    if random.below(2) == 0 {
        loads["spring"] = json!({ "spring": { "rate": random.between(10.0, 500.0), "preload": random.between(-5.0, 5.0) } });
    }
    if random.below(2) == 0 {
        loads["oil"] = json!({ "viscous": random.between(0.01, 2.0), "mass": "first" });
    }
    if random.below(2) == 0 {
        let force = random.signed(1.0, 50.0);
        loads["table"] =
            json!({ "time_table": [[0.03, 0], [0.05, force], [0.11, 0.5 * force], [0.2, -force]] });
    }
    if over_position && random.below(2) == 0 {
        loads["window"] =
            json!({ "window": { "from": 0.3, "to": 1.4, "force": random.signed(1.0, 30.0) } });
        loads["over"] = json!({ "position_table": {
            "points": [[0, 0], [1, random.between(-20.0, 20.0)], [2.5, 3], [4, 0]], "period": "360 deg" } });
    }
    loads
}

fn elastic(random: &mut Random, input: &str, position: Value, over_position: bool) -> Value {
    let mut object = json!({
        "kind": "rocker", "input": input, "position": position,
        "inertia": random.between(0.05, 0.3), "stiffness": random.between(2e4, 3e5),
        "masses": 1 + random.below(3), "damping_capacity": random.between(0.3, 2.0),
        "loads": loads(random, over_position),
    });
    match random.below(3) {
        0 => {
            let opens = if random.below(2) == 0 { "+" } else { "-" };
            let force = if opens == "+" { -1.0 } else { 1.0 } * random.between(30.0, 200.0);
            object["pair"] = json!({ "closure": "force", "opens": opens });
            object["loads"]["closing"] = json!({ "constant": force });
        }
        1 => object["pair"] = json!({ "closure": "form", "gap": random.between(1e-4, 2e-3) }),
        _ => {}
    }
    object
}

/// A random scene all of which can be propagated exactly.
fn scene(random: &mut Random) -> Value {
    let mut objects = json!({ "drive": drive(random) });
    let mut prescribed = vec!["drive".to_owned()];
    if random.below(2) == 0 {
        objects["lever"] = json!({ "kind": "rocker", "input": "drive", "position": position(random),
            "inertia": 0.1, "masses": 0 });
        prescribed.push("lever".to_owned());
    }
    for name in ["a", "b"].iter().take(1 + random.below(2)) {
        let input = prescribed[random.below(prescribed.len())].clone();
        let law = position(random);
        objects[name] = elastic(random, &input, law, true);
        let mut carrier = (*name).to_owned();
        if random.below(2) == 0 {
            let rigid = format!("{name}_rigid");
            objects[&rigid] = json!({ "kind": "shaft", "input": carrier, "masses": 0,
                "position": { "ratio": { "ratio": random.signed(0.3, 2.0), "offset": 0.1 } },
                "inertia": random.between(0.01, 0.2), "loads": loads(random, false) });
            carrier = rigid;
        }
        for follower in 0..random.below(3) {
            let ratio = json!({ "ratio": { "ratio": random.signed(0.3, 2.0), "offset": -0.2 } });
            objects[format!("{name}_{follower}")] = elastic(random, &carrier, ratio, false);
        }
    }
    objects
}

fn delta_columns(result: &RunResult) -> Vec<(&str, &[f64])> {
    let columns = result.record.columns.iter();
    columns
        .filter(|column| column.quantity == Quantity::Delta)
        .map(|column| (column.object.as_str(), column.values.as_slice()))
        .collect()
}

/// Greatest difference of δ of any object, relative to its greatest |δ|.
fn difference(one: &RunResult, other: &RunResult) -> f64 {
    let columns = delta_columns(one).into_iter().zip(delta_columns(other));
    columns
        .map(|((_, a), (_, b))| {
            let size = b.iter().fold(0.0f64, |m, x| m.max(x.abs()));
            let off = a.iter().zip(b).map(|(a, b)| (a - b).abs());
            let off = off.fold(0.0, f64::max);
            if size > 0.0 { off / size } else { off }
        })
        .fold(0.0, f64::max)
}

/// Figures of the closed form are those that the recorder finds of an integration:
/// of every object, within so much of their size.
fn compare_figures(exact: &RunResult, general: &RunResult, share: f64, label: &str) {
    for (id, own) in &exact.figures.objects {
        let wanted = &general.figures.objects[id];
        let near = |what: &str, a: f64, b: f64, scale: f64| {
            let size = b.abs().max(scale);
            assert!(
                (a - b).abs() <= share * size,
                "{label} {id} {what}: {a} for {b}"
            );
        };
        let delta = wanted.delta_max.abs().max(wanted.delta_min.abs());
        let (speed, force) = (wanted.peak_speed, wanted.peak_reaction);
        near("delta_max", own.delta_max, wanted.delta_max, delta);
        near("delta_min", own.delta_min, wanted.delta_min, delta);
        near("sigma", own.sigma, wanted.sigma, delta);
        near("peak_speed", own.peak_speed, speed, 0.0);
        let (a, b) = (own.peak_acceleration, wanted.peak_acceleration);
        near("peak_acceleration", a, b, 1e-9 * speed);
        near("peak_reaction", own.peak_reaction, force, 1e-9);
        let (a, b) = (own.end.displacement, wanted.end.displacement);
        near("displacement", a, b, delta);
        near("speed", own.end.speed, wanted.end.speed, speed);
        let (Some(own), Some(wanted)) = (&own.pair, &wanted.pair) else {
            assert!(own.pair.is_none() && wanted.pair.is_none(), "{label} {id}");
            continue;
        };
        assert_eq!(own.separations, wanted.separations, "{label} {id}");
        assert_eq!(own.closures, wanted.closures, "{label} {id}");
        assert_eq!(own.in_working_order, wanted.in_working_order, "{label}");
        assert_eq!(own.switch_times.len(), wanted.switch_times.len());
        let end = general.outcome.time;
        near("separated", own.separated_time, wanted.separated_time, end);
        let (a, b) = (own.longest_separation, wanted.longest_separation);
        near("longest", a, b, end);
        near("lift", own.max_lift, wanted.max_lift, delta);
        let (a, b) = (own.max_approach_speed, wanted.max_approach_speed);
        near("approach", a, b, speed);
        let (a, b) = (own.max_contact_force, wanted.max_contact_force);
        near("contact", a, b, 1e-9);
        assert_eq!(own.margin.is_some(), wanted.margin.is_some());
        if let (Some(a), Some(b)) = (own.margin, wanted.margin) {
            near("margin", a, b, force);
        }
    }
}

/// The trees' own audits, in closed form, against that of the recorder, which
/// integrates powers: [drives, loads, dissipated, change] of all trees.
fn audits(system: &System, duration: f64, label: &str) -> [f64; 4] {
    let initial = system.initial_state().expect("a start");
    let mut sums = [0.0; 4];
    for part in &Parts::of(system).trees {
        let request = Request {
            audit: true,
            ..Request::new(duration, 0)
        };
        let run = part.tree(&initial.y).run(&request).expect("runs");
        let audit = run.audit.expect("an audit");
        assert!(audit.error() < 1e-10, "{label}: {audit:?}");
        let own = [audit.drives, audit.loads, audit.dissipated, audit.change];
        for (sum, own) in sums.iter_mut().zip(own) {
            *sum += own;
        }
    }
    sums
}

#[test]
fn the_audit_of_a_tree_agrees_with_the_recorders_in_every_part() {
    let objects = json!({
        "drive": { "kind": "drive", "motion": { "speed": "10 rev/s" } },
        "rocker": { "kind": "rocker", "input": "drive", "position": { "sine": { "amplitude": "90 deg" } },
            "inertia": 0.1, "stiffness": 1e7, "damping_capacity": 0.4, "masses": 2,
            "pair": { "closure": "force" },
            "loads": { "closing": { "mass": "last", "constant": -600 } } }
    });
    for duration in [0.1, 0.137] {
        let settings = json!({ "duration": duration, "start": "static", "samples": 10 });
        let (system, settings) = prepare(&objects, &settings).expect("a scene");
        let recorded = solve(&system, &settings, Method::Exact, 1e-12).expect("runs");
        let (own, other) = (audits(&system, duration, "rocker"), recorded.audit);
        let theirs = [other.drives, other.loads, other.dissipated, other.change];
        assert!(theirs[2] > 1.0, "it lifts off and dissipates: {theirs:?}");
        for (a, b) in own.iter().zip(theirs) {
            assert!(
                (a - b).abs() < 1e-9 * other.balance_scale(),
                "{own:?} {theirs:?}"
            );
        }
    }
}

#[test]
fn random_scenes_agree_with_integration_at_a_tight_tolerance() {
    let (mut compared, mut switches, mut worst) = (0, 0, 0.0f64);
    for seed in 0..40 {
        let mut random = Random(seed);
        let objects = scene(&mut random);
        let start = ["on_law", "static"][random.below(2)];
        let settings = json!({ "duration": 0.25, "start": start, "samples": 200 });
        let Ok((system, settings)) = prepare(&objects, &settings) else {
            continue;
        };
        let parts = Parts::of(&system);
        assert!(parts.is_whole(), "seed {seed}: {:?}", parts.refusals);
        let Ok(exact) = solve(&system, &settings, Method::Exact, 1e-12) else {
            continue; // no static balance
        };
        let label = format!("seed {seed}: {objects}");
        assert!(exact.is_complete(), "{label}: {:?}", exact.outcome);
        assert!(
            exact.audit.error() < 1e-10,
            "{label}: {:e}",
            exact.audit.error()
        );
        let [_, loads, dissipated, _] = audits(&system, 0.25, &label);
        let theirs = &exact.audit;
        let near = |a: f64, b: f64| (a - b).abs() < 1e-9 * theirs.balance_scale();
        assert!(near(loads, theirs.loads), "{label}: {loads} {theirs:?}");
        assert!(
            near(dissipated, theirs.dissipated),
            "{label}: {dissipated} {theirs:?}"
        );
        let coarse = solve(&system, &settings, Method::Dop853, 1e-10).expect("it starts");
        let fine = solve(&system, &settings, Method::Dop853, 1e-12).expect("it starts");
        // Where integration is not sure of itself it judges nobody.
        let unsure = difference(&coarse, &fine);
        if unsure > 1e-7 || !fine.is_complete() {
            continue;
        }
        let off = difference(&exact, &fine);
        assert!(off < 1e-8, "off {off:e} (unsure {unsure:e}) {label}");
        let counts = [&exact, &fine].map(|result| result.outcome.statistics.switches);
        assert_eq!(counts[0], counts[1], "{label}");
        let sure = 1e-8f64.max(100.0 * unsure);
        compare_figures(&exact, &fine, sure, &label);
        (compared, switches, worst) = (compared + 1, switches + counts[0], worst.max(off));
    }
    assert!(
        compared >= 30 && switches > 500,
        "{compared} scenes, {switches} switches"
    );
}

/// q̈ + ω²q = aω²sin ωt from rest: q = a(sin ωt − ωt cos ωt)/2, greatest after whole
/// half-turns n, where it is aπn/2.
#[test]
fn a_scene_at_resonance_grows_as_the_closed_form_says() {
    let (a, omega, duration) = (0.01, 100.0f64, 3.1);
    let objects = json!({
        "drive": { "kind": "drive", "motion": { "speed": omega } },
        "arm": { "kind": "rocker", "input": "drive", "position": { "sine": { "amplitude": a } },
            "inertia": 1, "stiffness": omega * omega, "masses": 1 },
    });
    let settings = json!({ "duration": duration, "samples": 400, "start": "on_law" });
    let (system, settings) = prepare(&objects, &settings).expect("a scene");
    let exact = solve(&system, &settings, Method::Exact, 1e-12).expect("runs");
    assert!(
        exact.is_trusted() && exact.is_complete(),
        "{:?}",
        exact.outcome
    );
    assert!(exact.audit.error() < 1e-11, "{:e}", exact.audit.error());
    let at = |t: f64| 0.5 * a * ((omega * t).sin() - omega * t * (omega * t).cos());
    let columns = delta_columns(&exact);
    let (_, delta) = columns.iter().find(|c| c.0 == "arm").expect("a column");
    for (t, delta) in exact.record.times.iter().zip(*delta) {
        assert!(
            (delta - at(*t)).abs() < 1e-12 * 0.5 * a * omega * duration,
            "{t}: {delta}"
        );
    }
    // 3.1 s are 98.7 half-turns.
    let summit = |turns: f64| 0.5 * a * std::f64::consts::PI * turns;
    let figures = &exact.figures.objects["arm"];
    approx::assert_relative_eq!(figures.delta_max, summit(97.0), max_relative = 1e-12);
    approx::assert_relative_eq!(figures.delta_min, -summit(98.0), max_relative = 1e-12);
    let fine = solve(&system, &settings, Method::Dop853, 1e-12).expect("it starts");
    compare_figures(&exact, &fine, 1e-9, "at resonance");
}

#[test]
fn drives_that_accelerate_or_repeat_a_plan_are_propagated_too() {
    let accelerated = json!({ "acceleration": 90, "start_speed": -12 });
    let plan = json!({ "plan": { "period": 0.08, "advance": "180 deg", "phase": 0.01, "stations": [
        { "at": 0, "displacement": 0, "motion": "modified_sine" },
        { "at": 0.05, "displacement": "180 deg", "motion": "dwell" } ] } });
    let cam = json!({ "cam": { "lift": 0.1, "rise": "100 deg", "dwell": "30 deg",
        "return": "120 deg", "law": "4-5-6-7" } });
    let sine = json!({ "sine": { "amplitude": 0.1 } });
    for motion in [accelerated, plan] {
        for position in [&cam, &sine] {
            let objects = json!({
                "drive": { "kind": "drive", "motion": motion },
                "arm": { "kind": "rocker", "input": "drive", "position": position,
                    "inertia": 0.1, "stiffness": 1e5, "masses": 2, "damping_capacity": 1.0,
                    "pair": { "closure": "force" },
                    "loads": { "closing": { "constant": -40 }, "window": { "window":
                        { "from": 0.02, "to": 0.05, "force": -9 } } } },
            });
            let settings = json!({ "duration": 0.5, "start": "on_law", "samples": 200 });
            let (system, settings) = prepare(&objects, &settings).expect("a scene");
            let parts = Parts::of(&system);
            assert!(parts.is_whole(), "{:?}", parts.refusals);
            let exact = solve(&system, &settings, Method::Exact, 1e-12).expect("it runs");
            let fine = solve(&system, &settings, Method::Dop853, 1e-12).expect("it starts");
            assert!(exact.is_complete() && fine.is_complete());
            assert!(exact.audit.error() < 1e-10, "{:e}", exact.audit.error());
            let counts = [&exact, &fine].map(|result| result.outcome.statistics.switches);
            assert_eq!(counts[0], counts[1], "{objects}");
            let off = difference(&exact, &fine);
            assert!(off < 1e-8, "{off:e} {objects}");
        }
    }
}

#[test]
fn a_thousand_cycles_bring_no_drift() {
    let cam = json!({ "cam": { "lift": 0.1, "rise": "110 deg", "dwell": "20 deg", "return": "130 deg", "law": "modified_trapezoid" } });
    for position in [
        cam,
        json!({ "slider_crank": { "crank": 0.04, "rod": 0.13 } }),
    ] {
        let kind = if position.get("cam").is_some() {
            "rocker"
        } else {
            "slider"
        };
        let objects = json!({
            "drive": { "kind": "drive", "motion": { "speed": "600 rpm" } },
            "arm": { "kind": kind, "input": "drive", "position": position, "inertia": 0.1,
                "stiffness": 1e5, "masses": 2, "damping_capacity": 1.5,
                "loads": { "return": { "spring": { "rate": 300 } } } },
        });
        let settings = json!({ "duration": 100.0, "samples": 64_000 });
        let (system, settings) = prepare(&objects, &settings).expect("a scene");
        let result = solve(&system, &settings, Method::Exact, 1e-12).expect("it runs");
        let columns = delta_columns(&result);
        let (_, delta) = columns
            .iter()
            .find(|column| column.0 == "arm")
            .expect("a column");
        let delta = &delta[1..];
        let size = delta.iter().fold(0.0f64, |m, x| m.max(x.abs()));
        let cycle = |k: usize| &delta[64 * k..64 * (k + 1)];
        let pairs = cycle(20).iter().zip(cycle(999));
        let off = pairs.fold(0.0f64, |m, (a, b)| m.max((a - b).abs())) / size;
        assert!(off < 1e-11, "{kind}: {off:e}");
    }
}

#[test]
fn what_does_not_qualify_is_refused_with_its_reason() {
    let arm = |input: &str| {
        json!({ "kind": "rocker", "input": input, "position": { "ratio": 1 }, "inertia": 0.1,
            "stiffness": 1e5, "masses": 1 })
    };
    let drive = json!({ "kind": "drive", "motion": { "speed": 30 } });
    let with = |key: &str, value: Value| {
        let mut arm = arm("drive");
        arm[key] = value;
        json!({ "drive": drive, "arm": arm })
    };
    let behind = |value: Value| {
        let mut objects = json!({ "drive": drive, "arm": arm("drive"), "tip": arm("arm") });
        for (key, value) in value.as_object().expect("an object") {
            objects["tip"][key] = value.clone();
        }
        objects
    };
    let motor = json!({ "drive": { "kind": "drive", "motor": { "inertia": 1, "torque": { "constant": 3 } } }, "arm": arm("drive") });
    let stuck = json!({ "drive": drive, "arm": arm("drive"),
        "slide": { "kind": "slider", "input": "drive", "masses": 0, "inertia": 1,
            "position": { "slider_crank": { "crank": 0.25, "rod": 0.2 } } } });
    let mut written = json!({ "drive": drive, "arm": arm("drive"), "ram": arm("drive") });
    written["ram"]["masses"] = json!(0);
    written["ram"]["loads"] = json!({ "w": { "expression": "3*sin(t)" } });
    let cases = [
        (written, "ram", "a load by an expression on a rigid object"),
        (motor, "drive", "turned by a torque"),
        (
            with(
                "pair",
                json!({ "closure": "force", "law": { "hunt_crossley": { "kappa": 1 } } }),
            ),
            "arm",
            "Hunt–Crossley",
        ),
        (
            with(
                "loads",
                json!({ "rub": { "friction": { "force": 3, "width": 0.1 } } }),
            ),
            "arm",
            "`rub` is friction",
        ),
        (
            behind(json!({ "position": { "sine": { "amplitude": 0.2 } } })),
            "tip",
            "not a straight line, and `arm`",
        ),
        (
            behind(
                json!({ "loads": { "cut": { "window": { "from": 0.1, "to": 0.2, "force": 5 } } } }),
            ),
            "tip",
            "`cut` depends on a displacement",
        ),
        (stuck, "slide", "dead-centre positions"),
    ];
    for (objects, object, reason) in cases {
        let run = json!({ "duration": 0.1, "start": "on_law" });
        let (system, settings) = prepare(&objects, &run).expect("a scene");
        let faults = solve(&system, &settings, Method::Exact, 1e-6).expect_err(reason);
        assert_eq!(faults.len(), 1, "{faults:?}");
        assert_eq!(faults[0].path, "run.method");
        let message = &faults[0].message;
        assert!(
            message.contains(&format!("{object}: ")) && message.contains(reason),
            "{message}"
        );
        let free = RunSettings {
            method: None,
            ..settings
        };
        let chosen = dam::studies::run::run(&system, &free, &Control::default(), &mut []);
        assert_ne!(chosen.expect("it runs").method, Method::Exact);
    }
}

#[test]
fn exact_is_chosen_where_everything_qualifies() {
    let objects = json!({
        "drive": { "kind": "drive", "motion": { "speed": 30 } },
        "arm": { "kind": "rocker", "input": "drive", "position": { "sine": { "amplitude": 0.2 } },
            "inertia": 0.1, "stiffness": 1e5, "masses": 1 },
    });
    let (system, settings) = prepare(&objects, &json!({ "duration": 0.1 })).expect("a scene");
    let result = run(&system, &settings, &Control::default(), &mut []).expect("it runs");
    assert_eq!(result.method, Method::Exact);
    assert!(result.figures.run.why.contains("closed form"));
}

/// The lever of a cam as a chain of many masses, pressed on at rest.
fn long_chain(masses: usize, damping_capacity: f64) -> (System, RunSettings) {
    let objects = json!({
        "drive": { "kind": "drive", "motion": { "speed": "10 rev/s" } },
        "arm": { "kind": "rocker", "input": "drive", "position": { "sine": { "amplitude": "90 deg" } },
            "inertia": 0.1, "stiffness": 1e7, "damping_capacity": damping_capacity, "masses": masses,
            "pair": { "closure": "force" }, "loads": { "closing": { "mass": "last", "constant": -1000 } } },
    });
    let settings = json!({ "duration": 0.02, "start": "static" });
    prepare(&objects, &settings).expect("a scene")
}

#[test]
fn modes_that_are_never_excited_do_not_spoil_the_balance() {
    // Hardly damped; and overdamped links, whose rates gather at stiffness over damping.
    for (masses, damping_capacity) in [(80, 0.02), (70, 0.4)] {
        let (system, settings) = long_chain(masses, damping_capacity);
        let result = solve(&system, &settings, Method::Exact, 1e-9).expect("it runs");
        let error = result.audit.error();
        assert!(error < 1e-10, "{masses} masses: {error:e}");
    }
}

/// One mass on a very strongly damped link behind a sine.
fn strongly_damped(inertia: f64, capacity: f64, start: &str) -> (Value, Value) {
    let objects = json!({
        "shaft": { "kind": "drive", "motion": { "speed": "10 rev/s" } },
        "rocker": {
            "kind": "rocker", "input": "shaft",
            "position": { "sine": { "amplitude": "90 deg" } },
            "inertia": inertia, "stiffness": 1.8e7, "damping_capacity": capacity, "masses": 1,
            "pair": { "closure": "force" },
            "loads": { "closing": { "mass": "last", "constant": -600 } }
        }
    });
    let run = json!({ "duration": 0.5, "start": start, "tolerance": 1e-9 });
    (objects, run)
}

#[test]
fn very_strong_damping_is_played_as_it_is_integrated() {
    for (inertia, capacity) in [
        (0.006, 300.0),
        (0.006, 1000.0),
        (0.006, 16_000.0),
        (0.06, 1000.0),
    ] {
        for start in ["static", "on_law"] {
            let (objects, run) = strongly_damped(inertia, capacity, start);
            let (system, settings) = prepare(&objects, &run).expect("a system");
            let exact = solve(&system, &settings, Method::Exact, 1e-9).expect("runs");
            let radau = solve(&system, &settings, Method::Radau, 1e-11).expect("runs");
            assert!(
                exact.warnings.iter().all(|w| !w.spoils_figures()),
                "{capacity} {start}: {:?}",
                exact.warnings
            );
            let [a, b] = [&exact, &radau].map(|run| &run.figures.objects["rocker"]);
            for (x, y, scale) in [
                (a.delta_max, b.delta_max, 3.3e-5),
                (a.delta_min, b.delta_min, 3.3e-5),
                (a.sigma, b.sigma, 3.3e-5),
                (a.peak_acceleration, b.peak_acceleration, 6e3),
            ] {
                assert!(
                    (x - y).abs() < 1e-7 * scale,
                    "{inertia} {capacity} {start}: {x} {y}"
                );
            }
        }
    }
}

#[test]
fn counts_of_switches_that_rounding_decides_are_marked() {
    // Rates 10¹⁰ apart: the pair opens more slowly than its damper's rounding tells.
    let run_of = |capacity: f64, stiffness: f64| {
        let (mut objects, mut run) = strongly_damped(0.12, capacity, "static");
        objects["rocker"]["stiffness"] = json!(stiffness);
        objects["rocker"]["masses"] = json!(5);
        run["duration"] = json!(0.1);
        let (system, settings) = prepare(&objects, &run).expect("a system");
        [Method::Exact, Method::Radau]
            .map(|method| solve(&system, &settings, method, 1e-9).expect("runs"))
    };
    let counts = |run: &RunResult| {
        let figures = &run.figures.objects["rocker"];
        let pair = figures.pair.as_ref().expect("a pair");
        (pair.separations, pair.closures, figures.delta_max)
    };
    let marked = |run: &RunResult| {
        let marks = |w: &Warning| matches!(w, Warning::SwitchesUndetermined { .. });
        run.warnings.iter().any(marks)
    };
    for (capacity, stiffness) in [(0.4, 1e7), (100.0, 1e7), (1000.0, 1.8e7), (16_000.0, 1e9)] {
        let [exact, radau] = run_of(capacity, stiffness);
        let (a, b) = (counts(&exact), counts(&radau));
        // The motion is right, and so are counts that are not marked.
        assert!((a.2 - b.2).abs() < 1e-6 * b.2, "{a:?} {b:?}");
        assert!((a.0, a.1) == (b.0, b.1) || marked(&exact), "{a:?} {b:?}");
        assert!(!(marked(&exact) && capacity < 1e4), "{capacity}: marked");
    }
    // Without a gap a pair goes from flank to flank at one instant: no such thing.
    let (mut objects, mut run) = strongly_damped(0.1, 0.0, "static");
    objects["rocker"]["stiffness"] = json!(1e7);
    objects["rocker"]["pair"]["closure"] = json!("form");
    run["duration"] = json!(0.1);
    let (system, settings) = prepare(&objects, &run).expect("a system");
    let exact = solve(&system, &settings, Method::Exact, 1e-9).expect("runs");
    assert!(counts(&exact).0 > 3 && !marked(&exact));
}
