//! Machines with a motor and elastic objects: the stiff limit, a closed form, the decay
//! and the long run of a simulation in time, ratios, what cannot be.

use super::scenes::{faults, of_text, scene};
use dam::budget::Budget;
use dam::integrate::{Limits, Method, Modes, Settings, Sink, Stop, SwitchEvent, integrate};
use dam::polynomial::Step;
use dam::scene::SteadySpec;
use dam::studies::RunSettings;
use dam::studies::run::run;
use dam::studies::steady::{
    Answer, DriveFigures, PeriodicAnswer, Stability, steady_motion, steady_motion_within,
};
use dam::system::System;
use std::f64::consts::TAU;
use std::sync::atomic::AtomicBool;

fn answered(found: &(System, RunSettings, SteadySpec)) -> PeriodicAnswer {
    let (system, settings, spec) = found;
    match steady_motion(system, settings, spec).unwrap() {
        Answer::Periodic(answer) => *answer,
        Answer::Rigid(_) => panic!("it is elastic"),
    }
}

fn drive(answer: &PeriodicAnswer) -> &DriveFigures {
    answer.drive.as_ref().unwrap()
}

fn greatest(answer: &PeriodicAnswer) -> f64 {
    answer.parts[0].multipliers[0].modulus
}

/// ω of the drive each time it has turned through a cycle, from a run in time.
struct Passes {
    rotor: usize,
    cycle: f64,
    speeds: Vec<f64>,
    times: Vec<f64>,
    states: Vec<Vec<f64>>,
}

impl Sink for Passes {
    fn start(&mut self, _: f64, _: &[f64], _: &Modes) {}

    fn step(&mut self, step: &Step<'_>, _: &Modes) {
        loop {
            let target = self.cycle * (self.speeds.len() + 1) as f64;
            let beyond = |s: f64| step.value(self.rotor, s).0 - target;
            if beyond(step.end) < 0.0 {
                return;
            }
            let [mut low, mut high] = [0.0, step.end];
            for _ in 0..80 {
                let middle = 0.5 * (low + high);
                if beyond(middle) < 0.0 {
                    low = middle;
                } else {
                    high = middle;
                }
            }
            let mut state = vec![0.0; 2 * step.coordinates];
            step.state(high, &mut state);
            state[self.rotor] -= target;
            self.speeds.push(step.value(self.rotor, high).1);
            self.times.push(step.time(high));
            self.states.push(state);
        }
    }

    fn switch(&mut self, _: &SwitchEvent<'_>) {}
}

/// A simulation in time from a state at φ = 0.
fn passes(system: &System, y: &[f64], cycle: f64, duration: f64) -> Passes {
    let drives = system.model().objects.iter();
    let index = drives.into_iter().position(|part| part.is_drive()).unwrap();
    let mut sink = Passes {
        rotor: system.last_coordinate(index).unwrap(),
        cycle,
        speeds: Vec::new(),
        times: Vec::new(),
        states: Vec::new(),
    };
    let settings = Settings {
        method: Method::Dop853,
        tolerance: 1e-12,
        step: None,
    };
    let limits = Limits {
        switches: 1_000_000,
        steps: 10_000_000,
        budget: Budget::FREE,
    };
    let modes = system.modes_at_start(y);
    let end = integrate(
        system, 0.0, duration, y, &modes, &settings, &limits, &mut sink,
    );
    assert_eq!(end.stop, Stop::Complete);
    sink
}

#[test]
fn a_press_that_stiffens_comes_to_the_rigid_press() {
    let (system, settings, spec) = scene("steady/press_motor", &[]);
    let Answer::Rigid(rigid) = steady_motion(&system, &settings, &spec).unwrap() else {
        panic!("rigid");
    };
    let regime = rigid.regime.unwrap();
    let wanted = [
        rigid.figures.means.time,
        rigid.figures.means.angle,
        rigid.figures.least_speed.value,
        regime.multiplier,
    ];
    // What is left is proportional to the give at first: twice the stiffness twice.
    let figures = ["400 MN/m", "800 MN/m", "1600 MN/m"].map(|stiffness| {
        let set = [
            format!("ram.stiffness=\"{stiffness}\""),
            "ram.damping=\"100 kN s/m\"".to_owned(),
        ];
        let answer = answered(&scene(
            "steady/press_elastic",
            &set.each_ref().map(String::as_str),
        ));
        let found = drive(&answer);
        [
            found.means.time,
            found.means.angle,
            found.least_speed.value,
            greatest(&answer),
        ]
    });
    for (index, wanted) in wanted.into_iter().enumerate() {
        let off = figures.map(|found| (found[index] / wanted - 1.0).abs());
        println!("figure {index}: {off:?}");
        assert!(off[2] < 4e-3, "{off:?}");
        // (The multiplier is not in proportion yet.)
        if index < 3 {
            assert!(off[1] < 0.6 * off[0] && off[2] < 0.6 * off[1], "{off:?}");
            assert!((2.0 * off[2] - off[1]).abs() < 1e-4, "{off:?}");
        }
    }
}

/// A motor with a straight characteristic, a shaft that yields on a ratio, a fan of
/// linear resistance.
const FAN: &str = r#"{ "dam": 1, "name": "fan", "objects": {
    "motor": { "kind": "drive", "motor": { "inertia": 0.02, "speed": 10,
        "torque": { "linear": { "stall_torque": 60, "no_load_speed": 100 } } } },
    "fan": { "kind": "shaft", "input": "motor", "position": { "ratio": 0.6 },
        "inertia": 0.05, "stiffness": 800, "damping": 0.4,
        "loads": { "air": { "viscous": 0.9 } } } },
    "run": { "duration": 1 } }"#;

#[test]
fn a_linear_machine_has_the_speed_and_the_multipliers_of_its_closed_form() {
    let found = of_text(FAN, &[]);
    let answer = answered(&found);
    let (ratio, inertia, fan, c, b, air) = (0.6, 0.02, 0.05, 800.0, 0.4, 0.9);
    let slope = 60.0 / 100.0;
    let speed = 60.0 / (slope + ratio * ratio * air);
    let figures = drive(&answer);
    approx::assert_relative_eq!(figures.means.time, speed, max_relative = 1e-11);
    approx::assert_relative_eq!(figures.means.angle, speed, max_relative = 1e-10);
    assert!(figures.fluctuation < 1e-9, "{}", figures.fluctuation);
    assert_eq!(answer.parts[0].stability, Stability::Attracts);
    // u = −air·ratio·ω/c, in a state without rates of u.
    let twist = -air * ratio * speed / c;
    let (name, points) = &answer.parts[0].orbit[0];
    assert_eq!(name, "fan");
    for (_, value) in points {
        approx::assert_relative_eq!(*value, twist, max_relative = 1e-8);
    }
    // ω̇·J = −slope·ω + r·(c·u + b·u̇); (ü + r·ω̇)·J₂ = −c·u − b·u̇ − air·(u̇ + r·ω).
    let rotor = [ratio * c, -slope, ratio * b].map(|x| x / inertia);
    let wheel = [-c, -air * ratio, -(b + air)].map(|x| x / fan);
    let row = |i: usize| wheel[i] - ratio * rotor[i];
    let matrix = nalgebra::Matrix3::new(
        0.0,
        0.0,
        1.0,
        rotor[0],
        rotor[1],
        rotor[2],
        row(0),
        row(1),
        row(2),
    );
    let turn = TAU / speed;
    let mut expected: Vec<f64> = matrix
        .complex_eigenvalues()
        .iter()
        .map(|z| (z.re * turn).exp())
        .collect();
    expected.sort_by(|a, b| b.total_cmp(a));
    let multipliers = &answer.parts[0].multipliers;
    assert_eq!(multipliers.len(), 3);
    for (multiplier, expected) in multipliers.iter().zip(expected) {
        println!("{multiplier:?} against {expected}");
        approx::assert_abs_diff_eq!(multiplier.modulus, expected, epsilon = 1e-8);
    }
}

#[test]
fn a_disturbed_press_comes_back_as_its_multiplier_says() {
    let found = scene("steady/press_elastic", &[]);
    let answer = answered(&found);
    let (system, figures) = (&found.0, drive(&answer));
    let multiplier = answer.parts[0].multipliers[0];
    assert_eq!(multiplier.im, 0.0);
    let mut y = answer.state.clone();
    let count = y.len() / 2;
    let rotor = system
        .last_coordinate(1)
        .or(system.last_coordinate(0))
        .unwrap();
    y[count + rotor] *= 1.02;
    let run = passes(system, &y, answer.cycle, 12.0 * answer.turn);
    assert!(run.speeds.len() >= 11, "{:?}", run.speeds);
    let left: Vec<f64> = (run.speeds.iter())
        .map(|speed| speed - figures.speed_at_start)
        .collect();
    println!("left: {left:?}");
    // The first turns hold what is not linear and what dies away at once.
    for turn in 3..6 {
        let ratio = left[turn + 1] / left[turn];
        approx::assert_relative_eq!(ratio, multiplier.re, max_relative = 1e-3);
    }
    let last = run.times.len() - 1;
    let period = run.times[last] - run.times[last - 1];
    approx::assert_relative_eq!(period, answer.parts[0].period, max_relative = 1e-6);
}

#[test]
fn a_run_from_the_scene_s_own_start_settles_on_the_steady_motion() {
    let found = scene("steady/press_elastic", &[]);
    let answer = answered(&found);
    assert!(answer.parts[0].long_run.settles, "{answer:?}");
    let start = found.0.initial_state().unwrap().y;
    let run = passes(&found.0, &start, answer.cycle, 40.0 * answer.turn);
    let figures = drive(&answer);
    let last = run.speeds.last().unwrap();
    approx::assert_relative_eq!(*last, figures.speed_at_start, max_relative = 1e-9);
    // The rows are those of the run.
    let [first, end] = [&figures.rows[0], &figures.rows[720]];
    assert_eq!((first.position, first.time), (0.0, 0.0));
    approx::assert_relative_eq!(end.position, TAU, max_relative = 1e-15);
    approx::assert_relative_eq!(end.speed, first.speed, max_relative = 1e-9);
    approx::assert_relative_eq!(end.time, answer.turn, max_relative = 1e-12);
}

#[test]
fn a_scene_started_on_the_motion_stays_there() {
    let found = scene("steady/press_elastic", &[]);
    let answer = answered(&found);
    let start = serde_json::to_string(&drive(&answer).start).unwrap();
    let duration = 3.0 * answer.turn;
    let set = [
        format!("run.start={start}"),
        format!("run.duration={duration}"),
        "run.tolerance=1e-12".to_owned(),
    ];
    let (system, settings, _) = scene("steady/press_elastic", &set.each_ref().map(String::as_str));
    let result = run(&system, &settings, &Budget::FREE, &mut []).unwrap();
    assert!(result.is_complete());
    let y = system.initial_state().unwrap().y;
    let run = passes(&system, &y, answer.cycle, 3.01 * answer.turn);
    for (turn, (speed, time)) in run.speeds.iter().zip(&run.times).enumerate() {
        approx::assert_relative_eq!(*speed, drive(&answer).speed_at_start, max_relative = 1e-9);
        let expected = (turn + 1) as f64 * answer.turn;
        approx::assert_relative_eq!(*time, expected, max_relative = 1e-9);
    }
    assert_eq!(run.speeds.len(), 3);
}

/// A valve that leaves its cam and meets it again, its camshaft on a motor.
const VALVE: &str = r#"{ "dam": 1, "name": "valve", "objects": {
    "camshaft": { "kind": "drive", "motor": { "inertia": 0.05, "speed": "2200 rpm",
        "torque": { "linear": { "stall_torque": 400, "no_load_speed": "2205 rpm" } } } },
    "valve": { "from": "cam_follower/valve-pushrod-one-mass", "input": "camshaft",
        "position": { "cam": { "lift": "10.5 mm", "rise": "70 deg", "dwell": "4 deg",
            "return": "70 deg", "law": "4-5-6-7", "phase": "-30 deg" } } } },
    "run": { "duration": 0.16, "start": "static" } }"#;

#[test]
fn an_unstable_motion_started_on_itself_stays_within_its_multiplier() {
    let found = of_text(VALVE, &[]);
    let answer = answered(&found);
    let part = &answer.parts[0];
    assert_eq!(part.stability, Stability::Repels);
    assert!(!part.long_run.settles);
    let grows = greatest(&answer);
    assert!(grows > 1.5 && part.multipliers[0].im == 0.0, "{part:?}");
    let away = |state: &[f64]| {
        let each = state.iter().zip(&answer.state);
        each.map(|(found, own)| (found - own).abs() / (own.abs() + 1e-3))
            .fold(0.0, f64::max)
    };
    let own = passes(&found.0, &answer.state, answer.cycle, 9.5 * answer.turn);
    assert!(own.states.len() >= 9);
    for (turn, state) in own.states.iter().enumerate() {
        let bound = 1e-9 * grows.powi(turn as i32 + 1);
        assert!(away(state) < bound, "turn {turn}: {:e}", away(state));
    }
    // Beside it, it leaves by just that factor.
    let mut beside = answer.state.clone();
    beside[1] += 1e-6 * 1e-3;
    let left = passes(&found.0, &beside, answer.cycle, 7.5 * answer.turn);
    for turn in 3..6 {
        let ratio = away(&left.states[turn + 1]) / away(&left.states[turn]);
        println!("turn {turn}: {ratio} of {grows}");
        approx::assert_relative_eq!(ratio, grows, max_relative = 0.02);
    }
}

/// A motor with a lever behind a shaft of a ratio, pressed onto its cam by a load.
fn geared(ratio: &str) -> String {
    format!(
        r#"{{ "dam": 1, "name": "geared", "objects": {{
            "motor": {{ "kind": "drive", "motor": {{ "inertia": 0.05, "speed": 60,
                "torque": {{ "linear": {{ "stall_torque": 60, "no_load_speed": 100 }} }} }} }},
            "cam": {{ "kind": "shaft", "input": "motor", "position": {{ "ratio": {ratio} }},
                "inertia": 0.01, "stiffness": 4000, "damping": 2 }},
            "lever": {{ "kind": "rocker", "input": "cam", "masses": 0, "inertia": 0.3,
                "position": {{ "sine": {{ "amplitude": "20 deg" }} }},
                "loads": {{ "drag": {{ "viscous": 2 }} }} }} }},
            "run": {{ "duration": 1 }} }}"#
    )
}

#[test]
fn the_cycle_follows_from_the_ratios() {
    for (ratio, turns) in [
        ("1", 1.0),
        ("0.5", 2.0),
        ("0.6666666666666666", 1.5),
        ("0.07", 1.0 / 0.07),
        ("2", 1.0),
    ] {
        let found = of_text(&geared(ratio), &[]);
        let answer = answered(&found);
        // A motor is the same at every angle: the cycle need not be of whole turns.
        approx::assert_relative_eq!(answer.cycle, turns * TAU, max_relative = 1e-15);
        let start = found.0.initial_state().unwrap().y;
        let run = passes(&found.0, &start, answer.cycle, 30.0 * answer.turn);
        let last = run.speeds.last().unwrap();
        let figures = drive(&answer);
        println!("{ratio}: {} and {last}", figures.speed_at_start);
        approx::assert_relative_eq!(*last, figures.speed_at_start, max_relative = 1e-8);
        assert!(figures.fluctuation > 1e-3);
    }
    // 0.7071 is 7071 turns for 10 000.
    let found = faults(&geared("0.7071"), |_| {});
    assert_eq!(found[0].path, "steady.cycle");
    assert!(found[0].message.contains("ratios"), "{found:?}");
}

#[test]
fn behind_a_prescribed_drive_the_cycle_follows_from_the_ratios_too() {
    let text = geared("0.5").replace(
        r#""motor": { "inertia": 0.05, "speed": 60,
                "torque": { "linear": { "stall_torque": 60, "no_load_speed": 100 } } }"#,
        r#""motion": { "speed": 60 }"#,
    );
    let found = of_text(&text, &[]);
    let answer = answered(&found);
    approx::assert_relative_eq!(answer.cycle, 2.0 * TAU, max_relative = 1e-15);
    approx::assert_relative_eq!(answer.turn, 2.0 * TAU / 60.0, max_relative = 1e-15);
    assert!(answer.drive.is_none() && answer.parts[0].periods == 1);
}

#[test]
fn what_cannot_repeat_behind_a_motor_is_refused_with_the_reason() {
    for (was, is, path, words) in [
        (
            r#""loads": { "drag": { "viscous": 2 } }"#,
            r#""loads": { "drag": { "time_table": [[0, 0], [1, 5]] } }"#,
            "lever.loads.drag",
            "over time",
        ),
        (
            r#""stiffness": 4000, "damping": 2"#,
            r#""stiffness": 4000, "damping": 2, "loads": { "wound": { "spring": { "rate": 3 } } }"#,
            "cam.loads.wound",
            "wound up",
        ),
        (
            r#""cam": {"#,
            r#""other": { "kind": "drive", "motion": { "speed": 3 } }, "cam": {"#,
            "other",
            "keeps no pace",
        ),
    ] {
        let text = geared("1");
        assert!(text.contains(was), "{was}");
        let found = faults(&text.replace(was, is), |spec| {
            spec.drive = Some("motor".to_owned());
        });
        assert!(
            found
                .iter()
                .any(|fault| fault.path.starts_with(path) && fault.message.contains(words)),
            "{found:?}"
        );
    }
}

#[test]
fn time_limit_and_flag_end_the_search_for_a_steady_motion() {
    for name in [
        "steady/press_elastic",
        "steady/press_motor",
        "valve_train/lift_off",
    ] {
        let (system, settings, mut spec) = scene(name, &[]);
        if name == "steady/press_motor" {
            spec.fluctuation = Some(0.1);
        }
        let flag = AtomicBool::new(true);
        let nothing = Budget::FREE.within(std::time::Duration::ZERO);
        for (control, words) in [
            (Budget::interrupted_by(&flag), "interrupted"),
            (nothing, "time limit"),
        ] {
            let found = steady_motion_within(&system, &settings, &spec, &control).unwrap_err();
            assert_eq!(found.len(), 1);
            assert!(found[0].message.contains(words), "{name}: {found:?}");
        }
    }
}
