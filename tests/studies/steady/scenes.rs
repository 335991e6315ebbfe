//! The steady motion of scenes: what independent ways agree on, what is refused.

use dam::exact::{Parts, Request};
use dam::fault::Fault;
use dam::lower::lower;
use dam::scene::{BuiltIn, Document, Overrides, SteadySpec};
use dam::steady::{Mean, Refusal};
use dam::studies::RunSettings;
use dam::studies::steady::{Answer, PeriodicAnswer, RigidAnswer, Stability, steady_motion};
use dam::system::System;

/// A scene's system, settings and question.
pub(super) fn scene(name: &str, set: &[&str]) -> (System, RunSettings, SteadySpec) {
    let path = format!("{}/scenarios/{name}.json", env!("CARGO_MANIFEST_DIR"));
    of_text(&std::fs::read_to_string(path).unwrap(), set)
}

pub(super) fn of_text(text: &str, set: &[&str]) -> (System, RunSettings, SteadySpec) {
    let document = Document::parse("scene", text.as_bytes()).unwrap();
    let set: Vec<String> = set.iter().map(|set| (*set).to_owned()).collect();
    let reading = document.scene(&BuiltIn, &Overrides::new(set)).unwrap();
    let system = System::new(lower(&reading.scene).unwrap()).unwrap();
    let settings = RunSettings::of(&reading.scene).unwrap();
    (system, settings, reading.scene.steady.unwrap_or_default())
}

fn rigid(name: &str, change: impl Fn(&mut SteadySpec)) -> RigidAnswer {
    let (system, settings, mut spec) = scene(name, &[]);
    change(&mut spec);
    match steady_motion(&system, &settings, &spec).unwrap() {
        Answer::Rigid(answer) => *answer,
        Answer::Periodic(_) => panic!("{name} is rigid"),
    }
}

fn periodic(name: &str, set: &[&str]) -> (System, PeriodicAnswer) {
    let (system, settings, spec) = scene(name, set);
    match steady_motion(&system, &settings, &spec).unwrap() {
        Answer::Periodic(answer) => (system, *answer),
        Answer::Rigid(_) => panic!("{name} is elastic"),
    }
}

pub(super) fn faults(text: &str, change: impl Fn(&mut SteadySpec)) -> Vec<Fault> {
    let (system, settings, mut spec) = of_text(text, &[]);
    change(&mut spec);
    steady_motion(&system, &settings, &spec).unwrap_err()
}

/// Greatest |a − b| over the size of the trajectory's own entries.
fn apart(a: &[f64], b: &[f64]) -> f64 {
    let size = |list: &[f64]| list.iter().fold(0.0, |size: f64, x| size.max(x.abs()));
    let n = a.len() / 2;
    let half = |range: std::ops::Range<usize>| {
        let difference = a[range.clone()].iter().zip(&b[range.clone()]);
        let difference = difference.fold(0.0, |most: f64, (a, b)| most.max((a - b).abs()));
        difference / size(&a[range])
    };
    half(0..n).max(half(n..2 * n))
}

/// The end of an exact run of the only tree, over a number of turns from y.
fn exact_end(system: &System, y: &[f64], time: f64) -> Vec<f64> {
    let parts = Parts::of(system);
    let tree = &parts.trees[0];
    let run = tree.tree(y).run(&Request::new(time, 0)).unwrap();
    let mut end = y.to_vec();
    tree.put_state(&run.displacement, &run.speed, &mut end);
    end
}

#[test]
fn the_rocker_of_two_masses_settles_on_the_motion_that_shooting_finds() {
    let (system, answer) = periodic("rocker/two_masses", &[]);
    let part = &answer.parts[0];
    assert_eq!((part.periods, part.stability), (1, Stability::Attracts));
    let start = system.initial_state().unwrap().y;
    let end = exact_end(&system, &start, 60.0 * answer.turn);
    let off = apart(&answer.state, &end);
    println!("60 turns from the start: {off:.1e} apart");
    assert!(off < 1e-9, "{off:e}");
    assert!(part.long_run.settles && part.long_run.distance < 1e-9);
}

/// Eigenvalues of the cycle map by central differences, the greatest first.
fn by_differences(system: &System, answer: &PeriodicAnswer, step: f64) -> Vec<f64> {
    let n = answer.state.len();
    let mut matrix = nalgebra::DMatrix::zeros(n, n);
    for column in 0..n {
        let h = step * answer.state[column].abs().max(1e-6);
        let shifted = |by: f64| {
            let mut y = answer.state.clone();
            y[column] += by;
            exact_end(system, &y, answer.parts[0].period)
        };
        let (above, below) = (shifted(h), shifted(-h));
        for row in 0..n {
            matrix[(row, column)] = (above[row] - below[row]) / (2.0 * h);
        }
    }
    let eigenvalues = matrix.complex_eigenvalues();
    let mut moduli: Vec<f64> = eigenvalues.iter().map(|z| z.re.hypot(z.im)).collect();
    moduli.sort_by(|a, b| b.total_cmp(a));
    moduli
}

#[test]
fn multipliers_agree_with_differences_of_the_cycle_map() {
    // Impacts with more and less damping: multipliers of either sign, and a pair.
    let (bounces, rings) = (
        ["rocker.damping_capacity=0.15"],
        ["valve.damping_capacity=0.2"],
    );
    for (name, set) in [
        ("rocker/two_masses", &[][..]),
        ("valve_train/lift_off", &[][..]),
        ("rocker/two_masses", &bounces[..]),
        ("valve_train/lift_off", &rings[..]),
    ] {
        let (system, answer) = periodic(name, set);
        let found = &answer.parts[0].multipliers;
        let differences = by_differences(&system, &answer, 1e-6);
        for (multiplier, difference) in found.iter().zip(&differences) {
            let off = (multiplier.modulus - difference).abs();
            println!(
                "{name}: {} against {difference}: {off:.1e}",
                multiplier.modulus
            );
            assert!(
                off < 1e-6,
                "{name}: {} against {difference}",
                multiplier.modulus
            );
        }
    }
}

#[test]
fn an_unstable_motion_started_on_itself_stays_within_its_multiplier() {
    let (system, answer) = periodic(
        "valve_train/lift_off",
        &["camshaft.motion.speed=\"2200 rpm\""],
    );
    let part = &answer.parts[0];
    assert_eq!(part.stability, Stability::Repels);
    assert!(!part.long_run.settles, "{:?}", part.long_run);
    let grows = part.multipliers[0].modulus;
    assert!(grows > 2.0, "{grows}");
    let mut state = answer.state.clone();
    for turn in 1..=10 {
        state = exact_end(&system, &state, answer.turn);
        let off = apart(&state, &answer.state);
        assert!(off < 1e-10 * grows.powi(turn), "turn {turn}: {off:e}");
    }
    // Beside it, it leaves by just that factor.
    let mut beside = answer.state.clone();
    beside[0] += 1e-6 * beside[0].abs();
    let mut off = Vec::new();
    for _ in 0..7 {
        beside = exact_end(&system, &beside, answer.turn);
        off.push(apart(&beside, &answer.state));
    }
    for pair in off[3..].windows(2) {
        approx::assert_relative_eq!(pair[1] / pair[0], grows, max_relative = 0.02);
    }
}

#[test]
fn an_undamped_vibration_is_neutral_and_its_multiplier_is_known() {
    let (system, answer) = periodic("indexing/residual_vibration", &[]);
    let part = &answer.parts[0];
    assert_eq!(part.stability, Stability::Neutral);
    // exp(±i·ω₀·T).
    let tree = &Parts::of(&system).trees[0];
    let mass = &tree.problem().masses[0];
    let angle = (mass.stiffness / mass.inertia).sqrt() * part.period;
    approx::assert_abs_diff_eq!(part.multipliers[0].re, angle.cos(), epsilon = 1e-10);
    approx::assert_abs_diff_eq!(
        part.multipliers[0].im.abs(),
        angle.sin().abs(),
        epsilon = 1e-10
    );
}

#[test]
fn energy_theorem_cycle_map_and_simulation_agree() {
    for name in [
        "steady/engine",
        "steady/press_flywheel",
        "steady/press_motor",
        "rigid/pump",
    ] {
        let answer = rigid(name, |_| {});
        let agreement = &answer.agreement;
        let check = agreement.equation.unwrap();
        assert!(
            check.speed.abs() < 1e-10 && check.period.abs() < 1e-10,
            "{name}: {check:?}"
        );
        let run = agreement.simulation.as_ref().unwrap();
        println!(
            "{name}: simulation {:.1e}, {:?}",
            run.speed, agreement.cycle_map
        );
        assert!(run.speed.abs() < 1e-8, "{name}: {run:?}");
        assert_eq!(answer.regime.is_some(), agreement.cycle_map.is_some());
        assert!(
            agreement.cycle_map.is_none_or(|apart| apart < 1e-10),
            "{name}"
        );
    }
}

#[test]
fn a_flywheel_for_a_machine_on_its_motor_keeps_what_it_promises() {
    let answer = rigid("steady/press_motor", |spec| spec.fluctuation = Some(0.1));
    let wheel = answer.flywheel.unwrap();
    approx::assert_relative_eq!(wheel.fluctuation_with, 0.1, max_relative = 1e-9);
    approx::assert_relative_eq!(answer.figures.fluctuation, 0.1, max_relative = 1e-9);
    assert!(wheel.inertia > 5.0 && wheel.approximations[2].error.unwrap().abs() < 0.05);
    let run = answer.agreement.simulation.unwrap();
    assert!(run.speed.abs() < 1e-8, "{run:?}");
}

#[test]
fn a_linkage_reduces_to_the_press_of_the_reference() {
    let root = env!("CARGO_MANIFEST_DIR");
    let read = |name: &str| std::fs::read_to_string(format!("{root}/{name}")).unwrap();
    let text = read("scenarios/steady/press_with_rod.json");
    let torque =
        r#"{ "linear": { "stall_torque": "800 N m", "no_load_speed": 53.333333333333336 } }"#;
    let text = text.replace(torque, r#"{ "constant": 0 }"#);
    let (system, settings, mut spec) = of_text(&text, &[]);
    (spec.mean_speed, spec.balance) = (Some(32.0), true);
    let file: serde_json::Value =
        serde_json::from_str(&read("tests/reference/steady-state.json")).unwrap();
    for mean in Mean::ALL {
        spec.mean = mean;
        let Answer::Rigid(answer) = steady_motion(&system, &settings, &spec).unwrap() else {
            panic!("rigid");
        };
        let f = &answer.figures;
        let expected = &file["cases"][3]["continuous"][mean.name()];
        for (name, found) in [
            ("T_at_phi0", f.energy_at_start),
            ("omega_min", f.least_speed.value),
            ("omega_max", f.greatest_speed.value),
            ("delta", f.fluctuation),
            ("period", f.period),
        ] {
            let expected = expected[name].as_f64().unwrap();
            approx::assert_relative_eq!(found, expected, max_relative = 1e-9);
        }
    }
}

#[test]
fn all_three_means_can_be_held() {
    for mean in Mean::ALL {
        let answer = rigid("steady/engine", |spec| spec.mean = mean);
        let means = answer.figures.means;
        let held = match mean {
            Mean::Time => means.time,
            Mean::Angle => means.angle,
            Mean::Midrange => means.midrange,
        };
        approx::assert_relative_eq!(held, 200.0, max_relative = 1e-11);
    }
}

/// A slider of 3 kg on a crank with a rotor; the rest is put in.
fn crank(drive: &str, rest: &str, steady: &str) -> String {
    format!(
        r#"{{ "dam": 1, "name": "test", "objects": {{
            "crank": {{ "kind": "drive", {drive} }},
            "slide": {{ "kind": "slider", "input": "crank", {rest},
                "position": {{ "slider_crank": {{ "crank": 0.06, "rod": 0.24 }} }} }} }},
            "run": {{ "duration": 1 }} {steady} }}"#
    )
}

const RIGID: &str = r#""masses": 0, "inertia": "3 kg""#;
const LOADED: &str = r#""masses": 0, "inertia": "3 kg", "loads": { "cut": { "window":
    { "from": "180 deg", "to": "300 deg", "force": -500 } } }"#;
const ROTOR: &str = r#""motor": { "inertia": 0.05, "torque": { "constant": 1 } }"#;

#[test]
fn questions_without_an_answer_are_refused_at_their_place() {
    let at_100 = |spec: &mut SteadySpec| spec.mean_speed = Some(100.0);
    for (text, change, path, words) in [
        (
            crank(ROTOR, RIGID, ""),
            None,
            "steady.mean_speed",
            "none is given",
        ),
        (
            crank(ROTOR, LOADED, ""),
            Some(100.0),
            "steady",
            "loses speed",
        ),
        (
            crank(r#""motion": { "speed": 100 }"#, RIGID, ""),
            None,
            "steady",
            "must be above zero",
        ),
        (
            crank(
                r#""motor": { "inertia": 0.05, "torque": { "linear":
                    { "stall_torque": 10, "no_load_speed": 100 } } }"#,
                LOADED,
                "",
            ),
            Some(100.0),
            "steady.mean_speed",
            "no place",
        ),
        (
            crank(
                ROTOR,
                r#""inertia": "3 kg", "stiffness": "1 MN/m", "damping_capacity": 0.3"#,
                "",
            ),
            Some(100.0),
            "steady.mean_speed",
            "result of its motor",
        ),
        (
            crank(
                ROTOR,
                r#""masses": 0, "inertia": "3 kg",
                    "loads": { "pulse": { "time_table": [[0, 0], [1, 5]] } }"#,
                "",
            ),
            Some(100.0),
            "slide.loads.pulse",
            "over time",
        ),
    ] {
        let found = faults(&text, |spec| {
            if let Some(speed) = change {
                at_100(spec);
                spec.mean_speed = Some(speed);
            }
        });
        assert!(
            found
                .iter()
                .any(|f| f.path.starts_with(path) && f.message.contains(words)),
            "{path}: {found:?}"
        );
    }
}

#[test]
fn a_cycle_that_does_not_bring_the_inertia_back_is_refused() {
    let found = faults(&crank(ROTOR, RIGID, ""), |spec| {
        spec.mean_speed = Some(100.0);
        spec.cycle = 2.0;
    });
    assert_eq!(found[0].path, "steady.cycle");
    let twice = crank(ROTOR, LOADED, "");
    let (system, settings, mut spec) = of_text(&twice, &[]);
    (spec.mean_speed, spec.balance) = (Some(100.0), true);
    let mut speeds = Vec::new();
    for turns in [1.0, 2.0] {
        spec.cycle = turns * std::f64::consts::TAU;
        let Answer::Rigid(answer) = steady_motion(&system, &settings, &spec).unwrap() else {
            panic!("rigid");
        };
        speeds.push(answer.motion.speed(0.3));
    }
    approx::assert_relative_eq!(speeds[0], speeds[1], max_relative = 1e-10);
}

#[test]
fn a_weak_motor_stalls_under_its_load() {
    let weak = crank(
        r#""motor": { "inertia": 0.05, "torque": { "linear":
            { "stall_torque": 6, "no_load_speed": 20 } } }"#,
        LOADED,
        "",
    );
    let found = faults(&weak, |_| {});
    assert!(
        found.iter().any(
            |fault| fault.message.contains("stalls at φ") || fault.message.contains("no cycle")
        ),
        "{found:?}"
    );
    let refusal = Refusal::Stalls {
        position: 4.0,
        speed: 2.0,
    };
    assert!(refusal.message().contains("φ = 4 rad"));
}
