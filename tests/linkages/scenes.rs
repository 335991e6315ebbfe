//! Linkages in scenes: the published cases at the start, rows before a dead-centre
//! position, named dimensions, inputs, exact propagation behind them.

use dam::integrate::Dynamics;
use dam::lower::lower;
use dam::record::Quantity;
use dam::scene::{BuiltIn, Document, Overrides, TypedScene};
use dam::studies::run::{RunResult, run};
use dam::studies::{Control, RunSettings};
use dam::system::{ObjectState, System};
use std::path::Path;

fn file(path: &str) -> String {
    std::fs::read_to_string(Path::new(env!("CARGO_MANIFEST_DIR")).join(path)).expect("a file")
}

fn read(text: &str, overrides: &[&str]) -> TypedScene {
    let document = Document::parse("scene", text.as_bytes()).expect("JSON");
    let overrides = Overrides::new(overrides.iter().map(|one| (*one).to_owned()));
    match document.scene(&BuiltIn, &overrides) {
        Ok(reading) => reading.scene,
        Err(faults) => panic!("{}", faults.render(false)),
    }
}

fn system(scene: &TypedScene) -> System {
    System::new(lower(scene).expect("a model")).expect("a system")
}

fn solve(scene: &TypedScene) -> RunResult {
    let settings = RunSettings::of(scene).expect("settings");
    run(&system(scene), &settings, &Control::default(), &mut []).expect("a start")
}

#[test]
fn the_squeezing_mechanism_has_the_published_accelerations_at_the_start() {
    let system = system(&read(&file("scenarios/linkages/andrews.json"), &[]));
    let start = system.initial_state().expect("a start");
    let mut scratch = system.scratch();
    let mut states = vec![ObjectState::default(); system.model().objects.len()];
    system.observe(0.0, &start.y, &start.modes, &mut scratch, &mut states);
    let acceleration = |id: &str| {
        let objects = &system.model().objects;
        let index = objects.iter().position(|part| part.id == id);
        states[index.expect("an output")].acceleration
    };
    let (beta, theta) = (14222.4439199541, -10666.8329399656);
    approx::assert_relative_eq!(acceleration("squeezer.beta"), beta, max_relative = 1e-9);
    approx::assert_relative_eq!(acceleration("squeezer.theta"), theta, max_relative = 1e-9);
    for id in ["gamma", "phi", "delta", "omega", "epsilon"] {
        let found = acceleration(&format!("squeezer.{id}"));
        assert!(found.abs() < 1e-9 * beta, "{id}: {found}");
    }
}

/// The published rows of a case of the slotted link, as far as the run goes.
fn rows_before_the_dead_position(scenario: &str, case: &str, end: f64) {
    let scene = read(
        &file(&format!("scenarios/slotted_link/{scenario}.json")),
        &["run.samples=150"],
    );
    let result = solve(&scene);
    let stopped = result.figures.run.stopped.as_deref();
    assert_eq!(stopped, Some("dead_position"), "{case}");
    approx::assert_abs_diff_eq!(result.figures.run.time, end, epsilon = 1e-5);
    let message = format!("{:?}", result.outcome.stop);
    assert!(
        message.contains("a dead-centre position of dyad RRR"),
        "{message}"
    );
    let reference: serde_json::Value =
        serde_json::from_str(&file("tests/reference/slide-crank.json")).expect("JSON");
    let cases = reference["cases"].as_array().expect("cases");
    let case = cases
        .iter()
        .find(|one| one["id"] == case)
        .expect("the case");
    let column = |object: &str, quantity: Quantity| {
        let found = result.record.column(object, quantity);
        &found
            .unwrap_or_else(|| panic!("no {quantity} of {object}"))
            .values
    };
    let mut seen = 0;
    for row in case["results"].as_array().expect("rows") {
        let time = row["t"].as_f64().expect("a time");
        let times = &result.record.times;
        let Some(at) = times.iter().position(|t| (t - time).abs() < 1e-9) else {
            continue;
        };
        seen += 1;
        for (link, quantity, key, bound) in [
            ("crank", Quantity::Displacement, "phi1", 1e-9),
            ("crank", Quantity::Speed, "omega1", 1e-8),
            ("slot", Quantity::Displacement, "phi2", 1e-9),
            ("slot", Quantity::Speed, "omega2", 1e-8),
            ("slot", Quantity::Acceleration, "eps2", 1e-6),
        ] {
            let wanted = row[key].as_f64().expect("a number");
            let found = column(&format!("mechanism.{link}"), quantity)[at];
            approx::assert_abs_diff_eq!(found, wanted, epsilon = bound);
        }
    }
    assert!(seen >= 12, "{seen} rows");
}

#[test]
fn rows_before_the_dead_positions_of_the_slotted_link_are_kept() {
    rows_before_the_dead_position("block_uniform", "paper-3a", 12.616300);
    rows_before_the_dead_position("block_accelerated", "paper-3b", 12.943897);
}

const PRESS: &str = r#"{ "dam": 1, "name": "press", "objects": {
    "motor": { "kind": "drive", "motion": { "speed": "60 rpm" } },
    "press": { "from": "linkage/slider-crank", "input": "motor", "dimensions": { "crank": "40 mm" } },
    "tool": { "kind": "slider", "input": "press.slide", "position": { "ratio": 1 },
        "inertia": 5, "stiffness": 1e6, "damping_capacity": 0.3, "loads": { "work": { "constant": -300 } } }
  }, "run": { "duration": 3, "tolerance": 1e-9 } }"#;

#[test]
fn dimensions_of_a_catalogue_object_are_replaced_one_by_one() {
    let scene = read(PRESS, &["press.dimensions.offset=\"5 mm\""]);
    let Some(press) = scene.objects["press"].object.linkage() else {
        panic!("a linkage");
    };
    let links = &press.linkage.links;
    let point = |link: usize| links[link].points[0].at[0];
    // Links stand in the order of their names: crank, rod, slide.
    assert_eq!((point(0), point(1)), (0.04, 0.2));
    assert_eq!(press.linkage.ground[0].at, [0.0, 0.005]);
    approx::assert_relative_eq!(
        links[0].mass,
        7850.0 * 0.02 * 0.03 * 0.04,
        max_relative = 1e-14
    );
    assert_eq!(
        scene.objects["tool"].connection("input"),
        Some("press.slide")
    );
    assert_eq!(scene.graph().inputs("tool")[0].0, "press");
}

#[test]
fn a_linkage_moves_like_the_position_function_that_is_its_short_form() {
    let short = r#"{ "dam": 1, "name": "press", "objects": {
        "motor": { "kind": "drive", "motion": { "speed": "60 rpm" } },
        "tool": { "kind": "slider", "input": "motor", "position": { "slider_crank": { "crank": "40 mm", "rod": "200 mm" } },
            "inertia": 5, "stiffness": 1e6, "damping_capacity": 0.3, "loads": { "work": { "constant": -300 } } }
      }, "run": { "duration": 3, "tolerance": 1e-9 } }"#;
    let (linkage, short) = (solve(&read(PRESS, &[])), solve(&read(short, &[])));
    // Behind a prescribed drive its masses change nothing in the tool's motion.
    assert_eq!(
        linkage.method.name(),
        "exact",
        "{}",
        linkage.figures.run.why
    );
    for (address, bound) in [
        ("delta_max", 1e-12),
        ("delta_min", 1e-12),
        ("peak_speed", 1e-10),
    ] {
        let of = |result: &RunResult| {
            result
                .figures
                .value(&format!("tool.{address}"))
                .expect("a figure")
        };
        approx::assert_abs_diff_eq!(of(&linkage), of(&short), epsilon = bound);
    }
    let general = solve(&read(PRESS, &["run.method=dop853"]));
    let of = |result: &RunResult| result.figures.value("tool.delta_max").expect("a figure");
    approx::assert_abs_diff_eq!(of(&linkage), of(&general), epsilon = 1e-10);
    // The drive must also move crank, rod and slide.
    let reaction = |result: &RunResult| {
        result
            .figures
            .value("motor.peak_reaction")
            .expect("a figure")
    };
    assert!(reaction(&linkage) > reaction(&short));
}

#[test]
fn the_scales_of_a_figure_belong_to_the_output() {
    let result = solve(&read(PRESS, &[]));
    let speed = result
        .figures
        .value("press.slide.peak_speed")
        .expect("a figure");
    assert_eq!(result.figures.scale("press.slide.final.speed"), speed);
    assert_eq!(result.figures.units["press.slide"].displacement, "m");
    assert_eq!(result.figures.units["press"].displacement, "rad");
}

#[test]
fn a_rotor_without_inertia_needs_something_behind_it_that_has_some() {
    let text = |mass: &str| {
        format!(
            r#"{{ "dam": 1, "name": "light", "objects": {{
            "motor": {{ "kind": "drive", "motor": {{ "inertia": 0, "torque": {{ "constant": 1 }} }} }},
            "m": {{ "from": "linkage/slotted-link", "input": "motor" }},
            "gear": {{ "kind": "shaft", "input": "motor", "inertia": {mass}, "masses": 0 }} }},
            "run": {{ "duration": 0.1, "start": "on_law" }} }}"#
        )
    };
    let faults =
        System::new(lower(&read(&text("0"), &[])).expect("a model")).expect_err("no inertia");
    assert_eq!(faults[0].path, "motor.inertia");
    assert!(faults[0].hint.contains("follows it rigidly"), "{faults:?}");
    // A gear of 2 kg m² turned by 1 N m: ½·α·t².
    let result = solve(&read(&text("2"), &["run.tolerance=1e-10"]));
    let angle = result
        .figures
        .value("motor.final.displacement")
        .expect("a figure");
    approx::assert_relative_eq!(angle, 0.5 * 0.5 * 0.01, max_relative = 1e-9);
}

#[test]
fn a_start_beyond_the_reach_is_a_fault_with_the_interval() {
    let text = r#"{ "dam": 1, "name": "short", "objects": {
        "motor": { "kind": "drive", "motion": { "speed": 1, "angle": "60 deg" } },
        "m": { "from": "linkage/slider-crank", "input": "motor", "dimensions": { "rod": "30 mm" } } },
        "run": { "duration": 1 } }"#;
    let faults = lower(&read(text, &[])).expect_err("a start beyond");
    assert_eq!(faults[0].path, "m.start");
    // The rod reaches the guide up to asin(30/50).
    assert!(
        faults[0].hint.contains("-36.8698976 and 36.8698976 deg"),
        "{faults:?}"
    );
}

/// The boom of an excavator on a hydraulic cylinder of 0.9 to 1.4 m.
const BOOM: &str = r#"{ "dam": 1, "name": "boom", "objects": {
    "pump": { "kind": "drive", "coordinate": "sliding", "motion": { "speed": 0.05, "displacement": 0.9 } },
    "boom": { "kind": "linkage", "input": "pump", "driver": "piston",
      "ground": { "A": [0, 0], "B": [0.3, -0.6] },
      "links": { "barrel": {}, "rod": {},
        "boom": { "points": { "C": [1.0, 0.1] }, "mass": 120, "centre": [1.2, 0.05], "moment": 60 } },
      "pairs": {
        "A": { "revolute": ["ground.A", "boom.origin"] },
        "B": { "revolute": ["ground.B", "barrel.origin"] },
        "C": { "revolute": ["boom.C", "rod.origin"] },
        "piston": { "sliding": { "guide": "barrel.origin", "block": "rod.origin" } } },
      "start": 0.9, "assembly": { "boom": { "branch": "+" } }, "travel": [0.9, 1.4],
      "outputs": { "boom": { "angle": "boom" } } } },
  "run": { "duration": 8 } }"#;

/// A cylinder may start where it is fully retracted, and runs out to its end.
#[test]
fn the_ends_of_a_travel_belong_to_it() {
    let short = solve(&read(BOOM, &[]));
    assert_eq!(short.figures.run.stopped, None);
    let length = short.figures.value("boom.final.displacement").unwrap();
    assert!((length - 1.3).abs() < 1e-12, "{length}");
    // Law of cosines at the boom's pivot.
    let (a, b) = (0.3f64.hypot(0.6), 1f64.hypot(0.1));
    let opening = |c: f64| ((a * a + b * b - c * c) / (2.0 * a * b)).acos();
    let angle = short.figures.value("boom.boom.final.displacement").unwrap();
    let start = (-0.6f64).atan2(0.3) - 0.1f64.atan2(1.0);
    let apart = (angle - start).cos();
    assert!((apart - opening(1.3).cos()).abs() < 1e-12, "{angle}");
    let long = solve(&read(BOOM, &["run.duration=20"]));
    // The cylinder is at its stop; the links are far from any dead-centre position.
    assert_eq!(long.figures.run.stopped.as_deref(), Some("end_of_travel"));
    approx::assert_abs_diff_eq!(long.figures.run.time, 10.0, epsilon = 1e-9);
    let why = long.figures.run.stopped_because.as_deref().unwrap_or("");
    assert!(why.contains("the end of its travel"), "{why}");
    // Without a travel it goes on to where boom and cylinder are in line.
    let free = BOOM.replace(r#" "travel": [0.9, 1.4],"#, "");
    assert_ne!(free, BOOM);
    let dead = solve(&read(&free, &["run.duration=20"]));
    assert_eq!(dead.figures.run.stopped.as_deref(), Some("dead_position"));
    approx::assert_abs_diff_eq!(dead.figures.run.time, (a + b - 0.9) / 0.05, epsilon = 1e-4);
    let warning = &lower(&read(BOOM, &["run.duration=20"]))
        .expect("a model")
        .warnings[0];
    assert!(
        warning.contains("stops at the end of its travel"),
        "{warning}"
    );
}

/// A piston that arrives at the end of its travel with hardly any speed: a
/// tenth of a micrometre before the top of its 3-4-5 law. The stop lies where
/// the law reaches it, not where a parabola from a little before would.
#[test]
fn an_end_of_travel_is_told_where_the_law_reaches_it() {
    let plan = r#""motion": { "plan": { "stations": [
        { "at": 0, "displacement": 0.9, "motion": "3-4-5" },
        { "at": 1, "displacement": 1.4000001, "motion": "3-4-5" } ], "period": 3 } }"#;
    let steady = r#""motion": { "speed": 0.05, "displacement": 0.9 }"#;
    let text = BOOM.replace(steady, plan);
    assert_ne!(text, BOOM);
    // What is left of the way at u = 1 − t: 10u³ − 15u⁴ + 6u⁵ of 0.5000001 m.
    let left = |u: f64| 0.500_000_1 * u.powi(3) * (10.0 - 15.0 * u + 6.0 * u * u) - 1e-7;
    let (mut low, mut high) = (0.0, 0.1);
    for _ in 0..60 {
        let middle = 0.5 * (low + high);
        if left(middle) < 0.0 {
            low = middle;
        } else {
            high = middle;
        }
    }
    for tolerance in ["1e-4", "1e-6", "1e-9"] {
        let result = solve(&read(&text, &[&format!("run.tolerance={tolerance}")]));
        assert_eq!(result.figures.run.stopped.as_deref(), Some("end_of_travel"));
        // The lengths of the law and the travel are known to 1e-16 m of 1e-7 m.
        approx::assert_abs_diff_eq!(result.figures.run.time, 1.0 - high, epsilon = 1e-9);
        let why = result.figures.run.stopped_because.as_deref().unwrap_or("");
        assert!(why.contains("the end of its travel"), "{why}");
    }
}
