//! The rocker against event-exact reference figures (tests/reference/README.md).

use dam::integrate::Method;
use dam::model::{
    Closure, ContactForm, Coordinate, Link, LinkBase, Load, LoadLaw, Model, Node, NodeMotion,
    ObjectPart, Pair, PartInput, Start,
};
use dam::motion::DriveMotion;
use dam::position::Position;
use dam::record::{ObjectFigures, Quantity};
use dam::studies::run::{RunResult, run};
use dam::studies::{Control, RunSettings};
use dam::system::System;
use serde::Deserialize;
use std::collections::BTreeMap;
use std::f64::consts::TAU;

#[derive(Deserialize)]
struct Reference {
    cases: BTreeMap<String, Case>,
}

#[derive(Deserialize)]
struct Case {
    inputs: Inputs,
    outputs: Outputs,
    samples: Vec<Sample>,
}

#[derive(Deserialize)]
struct Inputs {
    masses: usize,
    inertia_kg_m2: f64,
    #[serde(rename = "stiffness_N_m_per_rad")]
    stiffness_n_m_per_rad: f64,
    #[serde(rename = "closing_moment_N_m")]
    closing_moment_n_m: f64,
    psi: f64,
    #[serde(rename = "frequency_Hz")]
    frequency_hz: f64,
    amplitude_rad: f64,
    duration_s: f64,
    gap_rad: f64,
    closure: String,
    start: String,
}

#[derive(Deserialize)]
struct Outputs {
    delta_max_rad: f64,
    delta_min_rad: f64,
    sigma_rad: f64,
    phi_n_end_rad: f64,
    phidot_n_end_rad_per_s: f64,
    separations: u64,
    closures: u64,
    separated_time_s: f64,
    longest_separation_s: f64,
    max_approach_speed_rad_per_s: f64,
    first_switch_times_s: Vec<f64>,
}

#[derive(Deserialize)]
struct Sample {
    t: f64,
    phi_n: f64,
    phidot_n: f64,
}

fn case(name: &str) -> Case {
    let text = include_str!("../reference/elastic-rocker.json");
    let mut reference: Reference = serde_json::from_str(text).expect("the reference is readable");
    reference.cases.remove(name).expect("the case exists")
}

/// The model of a case: the inertia cut by cubes, c_m = n·c, b_m = ψ·c_m/(2π·√(c/J)).
fn rocker(inputs: &Inputs) -> Model {
    let n = inputs.masses;
    let mut model = Model {
        nodes: vec![Node {
            inertia: 0.0,
            motion: NodeMotion::Prescribed {
                motion: DriveMotion::Constant {
                    speed: TAU * inputs.frequency_hz,
                    angle: 0.0,
                },
                track: None,
            },
        }],
        ..Model::default()
    };
    let pair = Pair {
        closure: match inputs.closure.as_str() {
            "force" => Closure::Force,
            "form" => Closure::Form,
            other => panic!("closure {other}"),
        },
        gap: inputs.gap_rad,
        opens: 1.0,
        form: ContactForm::default(),
    };
    let (inertia, stiffness) = (inputs.inertia_kg_m2, inputs.stiffness_n_m_per_rad);
    let base_frequency = (stiffness / inertia).sqrt();
    let cubes = (n * n * n) as f64;
    for m in 1..=n {
        let law = dam::model::Law {
            driver: 0,
            position: Position::Sine {
                amplitude: inputs.amplitude_rad,
                harmonic: 1.0,
                phase: 0.0,
                offset: 0.0,
            },
            lever: 1.0,
            track: None,
        };
        model.nodes.push(Node {
            inertia: inertia * (m * m * m - (m - 1) * (m - 1) * (m - 1)) as f64 / cubes,
            motion: NodeMotion::Mass { law },
        });
        let stiffness = n as f64 * stiffness;
        model.links.push(Link {
            mass: m,
            base: if m == 1 {
                LinkBase::Law { pair }
            } else {
                LinkBase::Mass(m - 1)
            },
            stiffness,
            damping: inputs.psi * stiffness / (TAU * base_frequency),
        });
    }
    if inputs.closing_moment_n_m != 0.0 {
        model.loads.push(Load {
            node: n,
            name: "rocker.loads.closing".to_owned(),
            law: LoadLaw::constant(-inputs.closing_moment_n_m),
        });
    }
    model.objects = objects(n);
    model.start = match inputs.start.as_str() {
        "static" => Start::Static,
        "on_law" => Start::OnLaw,
        other => panic!("start {other}"),
    };
    model
}

fn objects(masses: usize) -> Vec<ObjectPart> {
    let part = |id: &str, kind, nodes, driver, links| ObjectPart {
        id: id.to_owned(),
        kind,
        coordinate: Coordinate::Turning,
        nodes,
        inputs: PartInput::behind_one_driver(driver),
        links,
        combination: None,
        contact: None,
        driven_end: None,
        rigid_pair: None,
        pressing: None,
    };
    vec![
        part("drive", "drive", vec![0], None, Vec::new()),
        part(
            "rocker",
            "rocker",
            (1..=masses).collect(),
            Some(0),
            (0..masses).collect(),
        ),
    ]
}

fn run_case(case: &Case, method: Option<Method>, tolerance: f64) -> RunResult {
    let system = System::new(rocker(&case.inputs)).expect("the model is sound");
    let settings = RunSettings {
        method,
        tolerance,
        samples: case.samples.len() - 1,
        ..RunSettings::new(case.inputs.duration_s)
    };
    let result = run(&system, &settings, &Control::default(), &mut []).expect("the run starts");
    assert!(result.is_complete(), "{:?}", result.outcome);
    assert!(result.is_trusted(), "{:?}", result.warnings);
    result
}

/// Compares with the reference: figures, end and samples within `share` of the
/// greatest |δ|, speeds within `share` of the peak speed, counts exactly.
fn compare(name: &str, method: Option<Method>, share: f64) {
    let case = case(name);
    let result = run_case(&case, method, 1e-10);
    let figures = &result.figures.objects["rocker"];
    let expected = &case.outputs;
    let delta = expected
        .delta_max_rad
        .abs()
        .max(expected.delta_min_rad.abs());
    let near = |what: &str, found: f64, wanted: f64, scale: f64| {
        let off = (found - wanted).abs() / scale;
        assert!(
            off <= share,
            "{name} {what}: {found} for {wanted}, off {off:.1e}"
        );
    };
    near(
        "delta_max",
        figures.delta_max,
        expected.delta_max_rad,
        delta,
    );
    near(
        "delta_min",
        figures.delta_min,
        expected.delta_min_rad,
        delta,
    );
    near("sigma", figures.sigma, expected.sigma_rad, delta);
    near(
        "end",
        figures.end.displacement,
        expected.phi_n_end_rad,
        delta,
    );
    let speed = figures.peak_speed;
    near(
        "end speed",
        figures.end.speed,
        expected.phidot_n_end_rad_per_s,
        speed,
    );
    compare_pair(&case, figures, &near);
    compare_samples(&case, &result, (delta, speed), &near);
}

fn compare_pair(case: &Case, figures: &ObjectFigures, near: &impl Fn(&str, f64, f64, f64)) {
    let expected = &case.outputs;
    let pair = figures.pair.as_ref().expect("the pair can open");
    assert_eq!(pair.separations, expected.separations);
    assert_eq!(pair.closures, expected.closures);
    let duration = case.inputs.duration_s;
    near(
        "separated",
        pair.separated_time,
        expected.separated_time_s,
        duration,
    );
    near(
        "longest",
        pair.longest_separation,
        expected.longest_separation_s,
        duration,
    );
    let wanted = expected.max_approach_speed_rad_per_s;
    near("approach", pair.max_approach_speed, wanted, wanted.max(1.0));
    for (found, wanted) in pair.switch_times.iter().zip(&expected.first_switch_times_s) {
        near("switch", *found, *wanted, duration);
    }
    assert!(pair.switch_times.len() >= expected.first_switch_times_s.len());
}

fn compare_samples(
    case: &Case,
    result: &RunResult,
    (delta, speed): (f64, f64),
    near: &impl Fn(&str, f64, f64, f64),
) {
    let column = |quantity| {
        let column = result.record.column("rocker", quantity);
        column.expect("the column exists")
    };
    assert_eq!(result.record.times.len(), case.samples.len());
    let displacements = &column(Quantity::Displacement).values;
    let speeds = &column(Quantity::Speed).values;
    for (row, sample) in case.samples.iter().enumerate() {
        assert!((result.record.times[row] - sample.t).abs() < 1e-12);
        near("sample", displacements[row], sample.phi_n, delta);
        near("sample speed", speeds[row], sample.phidot_n, speed);
    }
}

/// The accuracy wanted of exact propagation where the contact is damped.
const EXACT: f64 = 1e-9;
/// The accuracy wanted of cases that stay near their law.
const CLOSE: f64 = 1e-7;
/// The accuracy wanted of cases that multiply small differences.
const THROWN_OFF: f64 = 1e-5;

macro_rules! cases {
    ($($test:ident: $name:literal, $share:ident;)*) => {
        $(#[test] fn $test() { compare($name, None, $share); })*
    };
}

cases! {
    one_mass_damped: "one_mass_damped", CLOSE;
    two_mass_damped: "two_mass_damped", CLOSE;
    ten_mass_damped: "ten_mass_damped", CLOSE;
    ten_mass_closed: "ten_mass_closed", CLOSE;
    two_mass_gap_form_closed: "two_mass_gap_form_closed", CLOSE;
    light_rocker_stays_closed: "map_J0.05_c0.25e7_nu10_M600", CLOSE;
    slow_rocker_stays_closed: "map_J0.5_c2e7_nu1_M600", CLOSE;
    heavy_rocker_closed_hard: "map_J1_c1e7_nu10_M6000", CLOSE;
    heavy_rocker_thrown_off: "map_J1_c5e7_nu10_M600", THROWN_OFF;
    soft_heavy_rocker_thrown_off: "map_J1_c0.25e7_nu5_M600", THROWN_OFF;
    one_mass_undamped: "one_mass_undamped", THROWN_OFF;
}

macro_rules! exact_cases {
    ($($test:ident: $name:literal, $share:ident;)*) => {
        $(#[test] fn $test() { compare($name, Some(Method::Exact), $share); })*
    };
}

exact_cases! {
    exact_one_mass_damped: "one_mass_damped", EXACT;
    exact_two_mass_damped: "two_mass_damped", EXACT;
    exact_ten_mass_damped: "ten_mass_damped", EXACT;
    exact_ten_mass_closed: "ten_mass_closed", EXACT;
    exact_two_mass_gap_form_closed: "two_mass_gap_form_closed", EXACT;
    exact_light_rocker_stays_closed: "map_J0.05_c0.25e7_nu10_M600", EXACT;
    exact_slow_rocker_stays_closed: "map_J0.5_c2e7_nu1_M600", EXACT;
    exact_heavy_rocker_closed_hard: "map_J1_c1e7_nu10_M6000", EXACT;
    exact_heavy_rocker_thrown_off: "map_J1_c5e7_nu10_M600", EXACT;
    exact_soft_heavy_rocker_thrown_off: "map_J1_c0.25e7_nu5_M600", EXACT;
    exact_one_mass_undamped: "one_mass_undamped", CLOSE;
}
