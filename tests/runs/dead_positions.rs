//! Dead-centre positions: whatever drives a linkage into one, and whatever the method,
//! the run says so, at the right time, and keeps what was right before.

use dam::integrate::Method;
use dam::scene::{BuiltIn, Document, Overrides};
use dam::studies::run::{RunResult, run};
use dam::studies::{Control, RunSettings};
use dam::system::System;
use std::process::Command;

/// Crank and rod of the slider-crank (m); its dead-centre positions are at ±asin(l/r).
const CRANK: f64 = 0.25;
const ROD: f64 = 0.2;

const GIVEN: &str = r#""d": { "kind": "drive", "motion": { "speed": 2 } }"#;
const MOTOR: &str = r#""d": { "kind": "drive", "motor": { "inertia": 0.1, "speed": 5, "torque": { "constant": 3 } } }"#;
const RIGID: &str = r#""inertia": 1, "masses": 0"#;
const ELASTIC: &str = r#""inertia": 1, "stiffness": 1e5, "masses": 1"#;
const DAMPED: &str = r#""inertia": 1, "stiffness": 1e5, "masses": 2, "damping_capacity": 0.4"#;

fn edge() -> f64 {
    (ROD / CRANK).asin()
}

/// A ram on a slider-crank, driven by `input`.
fn ram(input: &str, body: &str) -> String {
    format!(
        r#""ram": {{ "kind": "slider", "input": "{input}",
            "position": {{ "slider_crank": {{ "crank": {CRANK}, "rod": {ROD} }} }}, {body} }}"#
    )
}

fn scene(drive: &str, body: &str) -> String {
    format!("{drive}, {}", ram("d", body))
}

/// An elastic lever that carries the rigid ram.
fn behind_a_lever() -> String {
    let lever = r#""l": { "kind": "rocker", "input": "d", "position": { "ratio": 1 },
        "inertia": 0.1, "stiffness": 1e4, "masses": 1 }"#;
    format!("{GIVEN}, {lever}, {}", ram("l", RIGID))
}

fn solve(objects: &str, duration: f64, method: Method, tolerance: f64) -> RunResult {
    let text = format!(
        r#"{{ "dam": 1, "name": "dead-centre position", "objects": {{ {objects} }},
            "run": {{ "duration": {duration}, "start": "on_law" }} }}"#
    );
    let document = Document::parse("scene.json", text.as_bytes()).expect("a scene");
    let reading = document.scene(&BuiltIn, &Overrides::none());
    let scene = reading.expect("a right scene").scene;
    let system = System::new(dam::lower::lower(&scene).expect("a model")).expect("a system");
    let settings = RunSettings {
        method: Some(method),
        tolerance,
        step: (method == Method::Rk4).then_some(1e-4),
        samples: 100,
        ..RunSettings::of(&scene).expect("settings")
    };
    run(&system, &settings, &Control::default(), &mut []).expect("a start")
}

/// The run ended in the dead-centre position, with all it has found being numbers.
fn assert_dead(result: &RunResult, what: &str) {
    let figures = &result.figures;
    assert_eq!(
        figures.run.stopped.as_deref(),
        Some("dead_position"),
        "{what}: {:?}",
        result.outcome
    );
    let columns = &result.record.columns;
    let numbers = columns.iter().flat_map(|column| &column.values);
    assert!(numbers.clone().all(|value| value.is_finite()), "{what}");
    let addresses = figures.addresses();
    let null = |(_, value): &(&String, &Option<f64>)| value.is_none_or(|v| !v.is_finite());
    let nulls: Vec<_> = addresses
        .iter()
        .filter(null)
        .map(|(name, _)| name)
        .collect();
    let expected = |name: &&String| name.ends_with(".pair") || *name == "run.window";
    assert!(nulls.iter().all(expected), "{what}: {nulls:?}");
    // Every sample before the edge is kept; the last instants may fall on one.
    let whole = result.outcome.time * 100.0;
    let rows = result.record.times.len() as f64;
    assert!(
        rows == whole.floor() + 1.0,
        "{what}: {rows} rows to {whole} samples"
    );
}

#[test]
fn a_given_drive_meets_the_edge_on_time() {
    for body in [RIGID, ELASTIC, DAMPED] {
        for method in Method::available() {
            let what = format!("{method}, {body}");
            let result = solve(&scene(GIVEN, body), 1.0, method, 1e-8);
            assert_dead(&result, &what);
            let off = (result.outcome.time - edge() / 2.0).abs();
            assert!(off < 1e-12, "{what}: {off:e} off");
            let error = result.audit.error();
            let within = if body == RIGID { 1e-9 } else { 1e-5 };
            assert!(error < within, "{what}: energies {error:e}");
            assert!(result.is_trusted() || error > 3e-7, "{what}");
        }
    }
}

#[test]
fn the_lower_edge_is_the_upper_ones_mirror() {
    let back = GIVEN.replace("\"speed\": 2", "\"speed\": -2");
    for method in Method::available() {
        let result = solve(&scene(&back, ELASTIC), 1.0, method, 1e-6);
        assert_dead(&result, method.name());
        assert!((result.outcome.time - edge() / 2.0).abs() < 1e-12);
    }
}

#[test]
fn the_figures_end_a_millionth_of_the_reach_before_the_edge() {
    let result = solve(&scene(GIVEN, RIGID), 1.0, Method::Dop853, 1e-8);
    // U′ at asin(l/r) − ε, times the drive's speed.
    let phi = edge() - 2e-6 * edge();
    let (sin, cos) = phi.sin_cos();
    let root = (ROD * ROD - (CRANK * sin).powi(2)).sqrt();
    let slope = -CRANK * sin - CRANK * CRANK * sin * cos / root;
    let peak = result.figures.objects["ram"].peak_speed;
    approx::assert_relative_eq!(peak, 2.0 * slope.abs(), max_relative = 1e-6);
    approx::assert_abs_diff_eq!(
        result.figures.objects["d"].end.displacement,
        phi,
        epsilon = 1e-12
    );
}

/// Time at which a motor with constant torque T drives the rigid ram into the
/// edge, by the balance of energies: φ̇ = √((J ω₀² + 2Tφ)/(J + m·U′²)), φ from 0.
/// With φ = φ* − p² the integrand of t is smooth: Simpson's rule.
fn motor_time() -> f64 {
    let (rotor, speed, torque, mass) = (0.1, 5.0, 3.0, 1.0);
    let integrand = |p: f64| {
        let phi = edge() - p * p;
        let (sin, cos) = phi.sin_cos();
        // l² − r²·sin²φ = r²·sin(φ* − φ)·sin(φ* + φ), divided by p².
        let square = p * p;
        let sinc = if p == 0.0 { 1.0 } else { square.sin() / square };
        let root = CRANK * (sinc * (edge() + phi).sin()).sqrt();
        // p·U′, regular at p = 0.
        let slope = -CRANK * sin * p - CRANK * CRANK * sin * cos / root;
        let inertia = rotor * square + mass * slope * slope;
        2.0 * (inertia / (rotor * speed * speed + 2.0 * torque * phi)).sqrt()
    };
    let (count, last) = (2000, edge().sqrt());
    let h = last / f64::from(count);
    let inner = (1..count).map(|i| {
        let weight = if i % 2 == 1 { 4.0 } else { 2.0 };
        weight * integrand(f64::from(i) * h)
    });
    h / 3.0 * (integrand(0.0) + inner.sum::<f64>() + integrand(last))
}

#[test]
fn a_motor_that_is_brought_to_rest_by_it_meets_the_edge_on_time() {
    let exact = motor_time();
    for method in Method::available() {
        let result = solve(&scene(MOTOR, RIGID), 1.0, method, 1e-8);
        assert_dead(&result, method.name());
        let off = (result.outcome.time - exact).abs();
        let within = match method {
            Method::TrBdf2 => 2e-7,
            Method::Bdf | Method::Esdirk34 => 3e-8,
            Method::Taylor | Method::Rodas5p => 5e-9,
            _ => 1e-9,
        };
        assert!(off < within, "{method}: {off:e} off");
        let error = result.audit.error();
        assert!(error < 1e-5, "{method}: energies {error:e}");
    }
}

#[test]
fn no_tolerance_is_loose_enough_to_step_over_the_edge() {
    let exact = motor_time();
    for method in Method::available() {
        for tolerance in [1e-2, 1e-3, 1e-4, 1e-5, 1e-6, 1e-10] {
            if tolerance < 1e-6 && method == Method::TrBdf2 {
                continue; // of order 2: too many steps
            }
            let result = solve(&scene(MOTOR, RIGID), 1.0, method, tolerance);
            let what = format!("{method} at {tolerance:e}");
            assert_eq!(
                result.figures.run.stopped.as_deref(),
                Some("dead_position"),
                "{what}: {:?}",
                result.outcome
            );
            let off = (result.outcome.time - exact).abs();
            assert!(off < 1e-7 + 3.0 * tolerance, "{what}: {off:e} off");
        }
    }
}

#[test]
fn methods_agree_where_something_elastic_is_turned_back() {
    for (objects, within) in [
        (behind_a_lever(), 3e-9),
        (scene(MOTOR, ELASTIC), 1e-8),
        (scene(MOTOR, DAMPED), 1e-8),
    ] {
        let best = solve(&objects, 1.0, Method::Dop853, 1e-10);
        assert_dead(&best, "dop853");
        // A fixed step of 1e-4 s is too long for a motor in front of a stiff link.
        let fixed = |method: &Method| *method != Method::Rk4 || within < 1e-8;
        for method in Method::available().filter(fixed) {
            let result = solve(&objects, 1.0, method, 1e-8);
            assert_dead(&result, method.name());
            let off = (result.outcome.time - best.outcome.time).abs();
            assert!(off < within, "{method}: {off:e} off in {objects}");
        }
    }
}

#[test]
fn turning_back_before_the_edge_is_no_dead_position() {
    // The torque takes all energy out at φ = 0.9, 0.027 rad before the edge.
    let brake = 0.5 * 0.1 * 25.0 / 0.9;
    let motor = MOTOR.replace("\"constant\": 3", &format!("\"constant\": {}", -brake));
    for method in Method::available() {
        let result = solve(&scene(&motor, RIGID), 0.7, method, 1e-8);
        assert!(result.is_complete(), "{method}: {:?}", result.outcome);
        let drive = &result.figures.objects["d"];
        assert!(
            drive.end.speed < 0.0 && drive.end.displacement < 0.9,
            "{method}"
        );
        assert!(result.audit.error() < 1e-5, "{method}");
        let angles = &result.record.columns[0].values;
        let top = angles.iter().copied().fold(0.0, f64::max);
        assert!((0.89..0.9 + 1e-6).contains(&top), "{method}: {top}");
    }
}

#[test]
fn a_run_that_ends_just_before_the_edge_is_complete() {
    for method in Method::available() {
        for body in [RIGID, ELASTIC] {
            let result = solve(&scene(GIVEN, body), edge() / 2.0 - 1e-8, method, 1e-8);
            assert!(result.is_complete(), "{method}: {:?}", result.outcome);
        }
    }
}

#[test]
fn a_start_beside_the_edge_leaves_it() {
    let angle = edge() - 1e-8;
    let away = GIVEN.replace(
        "\"speed\": 2",
        &format!("\"speed\": -2, \"angle\": {angle}"),
    );
    let into = GIVEN.replace("\"speed\": 2", &format!("\"speed\": 2, \"angle\": {angle}"));
    for method in Method::available() {
        let result = solve(&scene(&away, RIGID), 1.0, method, 1e-8);
        assert_eq!(result.figures.run.stopped.as_deref(), Some("dead_position"));
        let off = (result.outcome.time - (edge() - 0.5e-8)).abs();
        assert!(off < 1e-12, "{method}: {off:e} off");
        let result = solve(&scene(&into, RIGID), 1.0, method, 1e-8);
        assert_eq!(result.figures.run.stopped.as_deref(), Some("dead_position"));
        assert!((result.outcome.time - 0.5e-8).abs() < 1e-15, "{method}");
    }
}

#[test]
fn switches_before_the_edge_are_found_though_what_follows_is_no_number_beyond() {
    // A follower behind the ram meets a window over the ram's displacement.
    let window = r#""f": { "kind": "slider", "input": "ram", "position": { "ratio": 1 },
        "inertia": 1, "masses": 0,
        "loads": { "w": { "window": { "from": 0.2, "to": 0.3, "force": 100, "once": true } } } }"#;
    let objects = format!("{}, {window}", scene(GIVEN, RIGID));
    for method in Method::available() {
        let result = solve(&objects, 1.0, method, 1e-8);
        assert_dead(&result, method.name());
        // ½·(m₁ + m₂)·ẋ² with the 10 J of the window in the balance.
        let error = result.audit.error();
        assert!(error < 1e-9, "{method}: energies {error:e}");
        assert!(
            (result.audit.loads + 10.0).abs() < 1e-6,
            "{method}: {:?}",
            result.audit
        );
    }
}

#[test]
fn rigid_mechanisms_behind_given_drives_are_the_same_by_every_method() {
    let table = r#""d": { "kind": "drive", "motion": { "table":
        [[0, 0], [0.3, "40 deg"], [0.6, "15 deg"], [1, "10 deg"]] } }"#;
    let loaded = r#""inertia": 1, "masses": 0, "pair": { "closure": "force" }, "loads": {
        "closing": { "constant": -50 },
        "work": { "window": { "from": "10 deg", "to": "20 deg", "force": -80, "once": true } } }"#;
    let solve = |method| solve(&scene(table, loaded), 1.0, method, 1e-8);
    let first = solve(Method::Dop853);
    assert!(
        first.is_complete() && first.is_trusted(),
        "{:?}",
        first.outcome
    );
    assert!(first.audit.error() < 1e-9, "{:e}", first.audit.error());
    for method in Method::available() {
        let other = solve(method);
        assert!(other.is_complete() && other.is_trusted(), "{method}");
        for (one, two) in first.record.columns.iter().zip(&other.record.columns) {
            for (a, b) in one.values.iter().zip(&two.values) {
                assert!((a - b).abs() <= 1e-9 * (1.0 + a.abs()), "{method}: {a} {b}");
            }
        }
    }
}

#[test]
fn the_program_answers_with_its_status_and_writes_numbers_only() {
    let file = concat!(
        env!("CARGO_MANIFEST_DIR"),
        "/scenarios/limits/short_rod.json"
    );
    let folder = tempfile::tempdir().expect("a folder");
    let out = folder.path().join("out");
    let status = |more: &[&str]| {
        let output = Command::new(env!("CARGO_BIN_EXE_dam"))
            .args(["run", file, "--quiet", "--out"])
            .arg(&out)
            .args(more)
            .output();
        output.expect("the program").status.code()
    };
    assert_eq!(status(&[]), Some(0), "as expected");
    let text = std::fs::read_to_string(out.join("record.csv")).expect("a record");
    assert!(text.lines().count() > 400, "samples before the edge");
    let cells = text.lines().skip(1).flat_map(|line| line.split(','));
    let finite = |cell: &str| cell.parse::<f64>().is_ok_and(f64::is_finite);
    assert!(cells.into_iter().all(finite));
    assert_eq!(
        status(&["--set", "run.samples=10"]),
        Some(1),
        "nothing expected"
    );
}
