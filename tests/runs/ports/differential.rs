//! Sums of several inputs against closed forms, and against the same equations by hand.

use super::{METHODS, run_by, system_of};
use approx::{assert_abs_diff_eq, assert_relative_eq};
use dam::integrate::{Dynamics, Method};
use dam::system::{ObjectState, Regime};

/// Sun 24 teeth, ring 72: i₀ = −3, φ_carrier = φ_sun/4 + 3·φ_ring/4.
const PLANETARY: &str = r#""gear": { "kind": "differential",
    "inputs": { "sun": { "object": "motor" }, "ring": { "object": "housing" } },
    "planetary": { "teeth": { "sun": 24, "ring": 72 } },"#;

#[test]
fn a_held_ring_gears_the_motor_down() {
    let objects = format!(
        r#""motor": {{ "kind": "drive", "motor": {{ "inertia": 0.02, "torque": {{ "constant": 3 }} }} }},
        "housing": {{ "kind": "drive", "motion": {{ "fixed": 0 }} }},
        {PLANETARY} "inertia": 0.4, "masses": 0,
            "loads": {{ "work": {{ "constant": -2 }} }} }}"#
    );
    let run = r#""duration": 0.5, "start": "on_law", "tolerance": 1e-10"#;
    let (system, settings) = system_of(&objects, run);
    // J₁ + J/16 and T − W/4 at the sun; F = −2 − J·φ̈/4 on the carrier, of which the
    // ring has to bear 3/4, turned round.
    let acceleration = (3.0 - 2.0 / 4.0) / (0.02 + 0.4 / 16.0);
    let force = -2.0 - 0.4 * acceleration / 4.0;
    for method in METHODS.map(Some).into_iter().chain([None]) {
        let found = run_by(&system, &settings, method);
        let figures = &found.figures.objects;
        assert_relative_eq!(
            figures["motor"].end.speed,
            0.5 * acceleration,
            max_relative = 1e-9
        );
        let angle = 0.125 * acceleration;
        assert_relative_eq!(
            figures["gear"].end.displacement,
            angle / 4.0,
            max_relative = 1e-9
        );
        assert_relative_eq!(figures["gear"].peak_reaction, -force, max_relative = 1e-9);
        assert_relative_eq!(
            figures["housing"].peak_reaction,
            -0.75 * force,
            max_relative = 1e-9
        );
        assert_eq!(figures["housing"].end.displacement, 0.0);
        assert!(found.figures.run.energy_error < 1e-9, "{method:?}");
    }
}

/// Two motors move one rigid carrier: the mass matrix is not diagonal.
#[test]
fn two_motors_share_the_inertia_of_a_rigid_carrier() {
    let objects = r#""left": { "kind": "drive", "motor": { "inertia": 0.3, "torque": { "constant": 5 } } },
        "right": { "kind": "drive", "motor": { "inertia": 0.2, "speed": 4, "torque": { "constant": -1 } } },
        "sum": { "kind": "differential", "inertia": 0.7, "masses": 0,
            "inputs": { "a": { "object": "left", "ratio": 0.5 }, "b": { "object": "right", "ratio": -2 } } }"#;
    let run = r#""duration": 0.8, "start": "on_law", "tolerance": 1e-10"#;
    let (system, settings) = system_of(objects, run);
    let matrix = nalgebra::Matrix2::new(0.3 + 0.7 * 0.25, -0.7, -0.7, 0.2 + 0.7 * 4.0);
    let found = matrix
        .lu()
        .solve(&nalgebra::Vector2::new(5.0, -1.0))
        .unwrap();
    for method in METHODS.map(Some).into_iter().chain([None]) {
        let result = run_by(&system, &settings, method);
        let figures = &result.figures.objects;
        assert_relative_eq!(
            figures["left"].end.speed,
            0.8 * found[0],
            max_relative = 1e-9
        );
        assert_relative_eq!(
            figures["right"].end.displacement,
            4.0 * 0.8 + 0.32 * found[1],
            max_relative = 1e-9
        );
        let own = 0.5 * figures["left"].end.displacement - 2.0 * figures["right"].end.displacement;
        assert_relative_eq!(figures["sum"].end.displacement, own, max_relative = 1e-12);
        assert!(result.figures.run.energy_error < 1e-9, "{method:?}");
    }
}

/// The same two rotors on springs: the generalised eigenvalue problem of two coordinates.
#[test]
fn coupled_inertia_is_felt_by_the_natural_frequencies() {
    let objects = r#""left": { "kind": "drive",
            "motor": { "inertia": 0.3, "torque": { "constant": 0 } },
            "loads": { "k": { "spring": { "rate": 50 } } } },
        "right": { "kind": "drive", "motor": { "inertia": 0.2, "torque": { "constant": 0 } },
            "loads": { "k": { "spring": { "rate": 80 } } } },
        "sum": { "kind": "differential", "inertia": 0.7, "masses": 0,
            "inputs": { "a": { "object": "left", "ratio": 0.5 }, "b": { "object": "right", "ratio": -2 } } }"#;
    let (system, _) = system_of(objects, r#""duration": 1"#);
    let [a, b, c] = [0.3 + 0.7 * 0.25, -0.7, 0.2 + 0.7 * 4.0];
    // det(K − λM) = 0.
    let (two, one, none) = (a * c - b * b, -(50.0 * c + 80.0 * a), 50.0 * 80.0);
    let root = f64::sqrt(one * one - 4.0 * two * none);
    let squares = [(-one - root) / (2.0 * two), (-one + root) / (2.0 * two)];
    let modes = system.modes_of_vibration(Regime::Engaged);
    for (mode, square) in modes.iter().zip(squares) {
        assert_relative_eq!(mode.frequency, square.sqrt(), max_relative = 1e-12);
        // (K − λM)·x = 0 in the first row.
        let row = (50.0 - square * a) * mode.shape[0] - square * b * mode.shape[1];
        assert_abs_diff_eq!(row, 0.0, epsilon = 1e-9);
    }
    assert_eq!(modes.len(), 2);
    assert_relative_eq!(
        system.fastest_rate(),
        modes[1].frequency,
        max_relative = 1e-9
    );
}

const ELASTIC: &str = r#""left": { "kind": "drive", "motor": { "inertia": 0.3,
            "torque": { "linear": { "stall_torque": 20, "no_load_speed": 30 } } } },
        "right": { "kind": "drive", "motor": { "inertia": 0.2, "speed": 5,
            "torque": { "linear": { "stall_torque": 10, "no_load_speed": 40 } } } },
        "sum": { "kind": "differential", "inertia": 0.05, "stiffness": 4000, "damping": 2, "masses": 1,
            "inputs": { "a": { "object": "left", "ratio": 0.5 }, "b": { "object": "right", "ratio": -2 } },
            "loads": { "brake": { "viscous": 0.4 } } }"#;

/// The equations of the scene above, in absolute displacements.
fn by_hand(y: &[f64; 6]) -> [f64; 6] {
    let [left, right, own, v_left, v_right, v_own] = *y;
    let x = own - (0.5 * left - 2.0 * right);
    let rate = v_own - (0.5 * v_left - 2.0 * v_right);
    let pull = 4000.0 * x + 2.0 * rate;
    [
        v_left,
        v_right,
        v_own,
        (20.0 * (1.0 - v_left / 30.0) + 0.5 * pull) / 0.3,
        (10.0 * (1.0 - v_right / 40.0) - 2.0 * pull) / 0.2,
        (-pull - 0.4 * v_own) / 0.05,
    ]
}

#[test]
fn two_motors_and_an_elastic_output_agree_with_the_equations_by_hand() {
    let run = r#""duration": 0.3, "start": "on_law", "tolerance": 1e-10"#;
    let (system, settings) = system_of(ELASTIC, run);
    let mut y = [0.0, 0.0, 0.0, 0.0, 5.0, -10.0];
    let (steps, length) = (60_000, 0.3 / 60_000.0);
    let moved = |y: &[f64; 6], k: &[f64; 6], h: f64| std::array::from_fn(|i| y[i] + h * k[i]);
    for _ in 0..steps {
        let k1 = by_hand(&y);
        let k2 = by_hand(&moved(&y, &k1, length / 2.0));
        let k3 = by_hand(&moved(&y, &k2, length / 2.0));
        let k4 = by_hand(&moved(&y, &k3, length));
        for i in 0..6 {
            y[i] += length / 6.0 * (k1[i] + 2.0 * k2[i] + 2.0 * k3[i] + k4[i]);
        }
    }
    let all = METHODS.into_iter().chain([Method::Taylor]);
    for method in all.map(Some).chain([None]) {
        let result = run_by(&system, &settings, method);
        let figures = &result.figures.objects;
        for (id, at) in [("left", 0), ("right", 1), ("sum", 2)] {
            let end = figures[id].end;
            assert_relative_eq!(end.displacement, y[at], max_relative = 1e-8);
            assert_relative_eq!(end.speed, y[at + 3], max_relative = 1e-7);
        }
        assert!(result.figures.run.energy_error < 1e-7, "{method:?}");
    }
}

/// The quiet start of the same: without characteristics over speed the deflection stays
/// what the common acceleration makes it.
#[test]
fn a_quiet_start_behind_two_motors_stays_quiet() {
    let objects = r#""left": { "kind": "drive", "motor": { "inertia": 0.3, "torque": { "constant": 5 } } },
        "right": { "kind": "drive", "motor": { "inertia": 0.2, "torque": { "constant": -1 } } },
        "sum": { "kind": "differential", "inertia": 0.7, "stiffness": 9000, "masses": 1,
            "damping_capacity": 0,
            "inputs": { "a": { "object": "left", "ratio": 0.5 }, "b": { "object": "right", "ratio": -2 } } }"#;
    let (system, settings) = system_of(objects, r#""duration": 0.2, "tolerance": 1e-11"#);
    let matrix = nalgebra::Matrix2::new(0.3 + 0.7 * 0.25, -0.7, -0.7, 0.2 + 0.7 * 4.0);
    let found = matrix
        .lu()
        .solve(&nalgebra::Vector2::new(5.0, -1.0))
        .unwrap();
    let deflection = -0.7 * (0.5 * found[0] - 2.0 * found[1]) / 9000.0;
    let result = run_by(&system, &settings, Some(Method::Dop853));
    let own = &result.figures.objects["sum"];
    assert_relative_eq!(own.delta_max, deflection, max_relative = 1e-6);
    assert_relative_eq!(own.delta_min, deflection, max_relative = 1e-6);
}

/// A prescribed drive and a motor.
#[test]
fn a_drive_and_a_motor_balance_their_energies() {
    let objects = r#""feed": { "kind": "drive", "motion": { "speed": 20 } },
        "motor": { "kind": "drive", "motor": { "inertia": 0.01,
            "torque": { "linear": { "stall_torque": 4, "no_load_speed": 60 } } } },
        "sum": { "kind": "differential", "inertia": 0.02, "stiffness": 900, "damping": 0.3, "masses": 2,
            "inputs": { "a": { "object": "feed", "ratio": 0.7 }, "b": { "object": "motor", "ratio": 0.3 } },
            "loads": { "work": { "viscous": 0.05 } } }"#;
    let run = r#""duration": 1, "start": "on_law", "tolerance": 1e-9"#;
    let (system, settings) = system_of(objects, run);
    let mut ends = Vec::new();
    for method in METHODS
        .map(Some)
        .into_iter()
        .chain([Some(Method::Taylor), None])
    {
        let result = run_by(&system, &settings, method);
        assert!(result.figures.run.energy_error < 1e-7, "{method:?}");
        ends.push(result.figures.objects["sum"].end.speed);
    }
    for end in &ends {
        assert_relative_eq!(*end, ends[0], max_relative = 1e-7);
    }
}

/// Everything prescribed: exact propagation, its law the sum.
#[test]
fn sums_of_prescribed_motions_are_propagated_exactly() {
    let scene = |second: &str| {
        format!(
            r#""a": {{ "kind": "drive", "motion": {{ "speed": 30 }} }},
            "b": {{ "kind": "drive", "motion": {second} }},
            "swing": {{ "kind": "rocker", "input": "a", "inertia": 0.01, "masses": 0,
                "position": {{ "sine": {{ "amplitude": 0.2 }} }} }},
            "sum": {{ "kind": "differential", "inertia": 0.08, "stiffness": 3000, "damping": 1,
                "masses": 2, "pair": {{ "closure": "form", "gap": 0.0005 }},
                "inputs": {{ "one": {{ "object": "swing", "ratio": 0.6 }},
                    "two": {{ "object": "b", "ratio": 0.4 }} }},
                "loads": {{ "work": {{ "constant": -1.5 }} }} }}"#
        )
    };
    let motions = [
        r#"{ "speed": 45 }"#,
        r#"{ "fixed": 0.3 }"#,
        r#"{ "run_up": { "speed": 20, "time": 0.4 } }"#,
        r#"{ "table": [[0, 0], [0.3, 0.4], [0.7, 0.1], [1, 0.2]] }"#,
    ];
    for motion in motions {
        let run = r#""duration": 0.9, "tolerance": 1e-11"#;
        let (system, settings) = system_of(&scene(motion), run);
        let exact = run_by(&system, &settings, Some(Method::Exact));
        let other = run_by(&system, &settings, Some(Method::Dop853));
        let auto = run_by(&system, &settings, None);
        assert_eq!(auto.method, Method::Exact, "{motion}");
        let (one, two) = (&exact.figures.objects["sum"], &other.figures.objects["sum"]);
        for (one, two) in [
            (one.delta_max, two.delta_max),
            (one.delta_min, two.delta_min),
            (one.sigma, two.sigma),
            (one.peak_reaction, two.peak_reaction),
            (one.end.displacement, two.end.displacement),
        ] {
            assert_relative_eq!(one, two, max_relative = 2e-6, epsilon = 1e-10);
        }
        for id in ["a", "b"] {
            let peaks = [&exact, &other].map(|run| run.figures.objects[id].peak_reaction);
            assert_relative_eq!(peaks[0], peaks[1], max_relative = 1e-5);
        }
        assert!(exact.figures.run.energy_error < 1e-9, "{motion}");
        let switches = [&exact, &other].map(|run| run.outcome.statistics.switches);
        assert_eq!(switches[0], switches[1], "{motion}");
    }
}

/// Σ Mᵢ·φ̇ᵢ of the drives is the power that goes into the output, at every instant.
#[test]
fn the_inputs_give_what_the_output_takes() {
    let objects = r#""a": { "kind": "drive", "motion": { "speed": 30 } },
        "b": { "kind": "drive", "motion": { "run_up": { "speed": 12, "time": 0.5 } } },
        "c": { "kind": "drive", "motion": { "acceleration": 7 } },
        "sum": { "kind": "differential", "inertia": 0.08, "stiffness": 3000, "damping": 1, "masses": 2,
            "inputs": { "one": { "object": "a", "ratio": 0.6 }, "two": { "object": "b", "ratio": -0.4 },
                "three": { "object": "c", "ratio": 2 } } }"#;
    let (system, _) = system_of(objects, r#""duration": 1"#);
    let start = system.initial_state().unwrap();
    let (mut scratch, count) = (system.scratch(), system.model().objects.len());
    let mut states = vec![ObjectState::default(); count];
    let index = |id: &str| {
        let mut objects = system.model().objects.iter();
        objects.position(|part| part.id == id).unwrap()
    };
    for (time, shift) in [(0.0, 0.0), (0.2, 1e-3), (0.7, -2e-3)] {
        let y: Vec<f64> = start.y.iter().map(|y| y + shift).collect();
        system.observe(time, &y, &start.modes, &mut scratch, &mut states);
        let power = |id: &str| states[index(id)].reaction * states[index(id)].speed;
        let sum = &states[index("sum")];
        let law = 0.6 * states[index("a")].speed - 0.4 * states[index("b")].speed
            + 2.0 * states[index("c")].speed;
        let given: f64 = ["a", "b", "c"].map(power).iter().sum();
        assert_relative_eq!(given, -sum.reaction * law, max_relative = 1e-12);
        let own = system.power(time, &y, &start.modes, &mut scratch);
        assert_relative_eq!(own.drives, given, max_relative = 1e-12);
    }
}

/// One rotor moves both inputs: φ = φ_m/2 + 0.3·sin φ_m. Without loads the energy
/// ½(J_m + J·T²)·φ̇² stays, T = ½ + 0.3·cos φ_m.
#[test]
fn two_ways_from_one_rotor_are_one_inertia() {
    let objects = r#""m": { "kind": "drive", "motor": { "inertia": 0.1, "speed": 10, "torque": { "constant": 0 } } },
        "swing": { "kind": "rocker", "input": "m", "inertia": 0, "masses": 0,
            "position": { "sine": { "amplitude": 0.3 } } },
        "sum": { "kind": "differential", "inertia": 0.9, "masses": 0,
            "inputs": { "one": { "object": "m", "ratio": 0.5 }, "two": { "object": "swing", "ratio": 1 } } }"#;
    let run = r#""duration": 0.77, "start": "on_law", "tolerance": 1e-11"#;
    let (system, settings) = system_of(objects, run);
    let twice = |angle: f64, speed: f64| {
        let slope = 0.5 + 0.3 * angle.cos();
        (0.1 + 0.9 * slope * slope) * speed * speed
    };
    for method in METHODS {
        let result = run_by(&system, &settings, Some(method));
        let end = result.figures.objects["m"].end;
        assert!(end.displacement > 3.0);
        let energies = [twice(0.0, 10.0), twice(end.displacement, end.speed)];
        assert_relative_eq!(energies[1], energies[0], max_relative = 1e-8);
    }
}

/// The Jacobian that implicit methods use, against differences, and its pattern.
#[test]
fn derivatives_agree_with_differences_also_where_coordinates_are_coupled() {
    let rigid = r#""left": { "kind": "drive", "motor": { "inertia": 0.3,
            "torque": { "linear": { "stall_torque": 20, "no_load_speed": 30 } } } },
        "right": { "kind": "drive", "motor": { "inertia": 0.2, "speed": 5,
            "torque": { "linear": { "stall_torque": 10, "no_load_speed": 40 } } } },
        "lever": { "kind": "rocker", "input": "left", "inertia": 0.02, "stiffness": 500, "masses": 2,
            "damping": 0.1, "position": { "sine": { "amplitude": 0.4 } } },
        "swing": { "kind": "rocker", "input": "lever", "inertia": 0.03, "masses": 0,
            "position": { "sine": { "amplitude": 0.8, "phase": 0.4 } } },
        "sum": { "kind": "differential", "inertia": 0.6, "masses": 0,
            "inputs": { "a": { "object": "swing", "ratio": 0.5 }, "b": { "object": "right", "ratio": -2 } },
            "loads": { "spring": { "spring": { "rate": 30 } } } },
        "tip": { "kind": "rocker", "input": "sum", "inertia": 0.01, "stiffness": 900, "masses": 1,
            "position": { "sine": { "amplitude": 0.3 } } }"#;
    for objects in [rigid, ELASTIC] {
        let (system, _) = system_of(objects, r#""duration": 1, "start": "on_law""#);
        let start = system.initial_state().unwrap();
        let n = system.coordinates();
        let y: Vec<f64> = (0..2 * n)
            .map(|k| start.y[k] + 0.01 * (1.0 + k as f64).sin())
            .collect();
        let mut scratch = system.scratch();
        let rows = system.pattern();
        for column in 0..2 * n {
            let mut direction = vec![0.0; 2 * n];
            direction[column] = 1.0;
            let mut exact = vec![0.0; 2 * n];
            system.tangent(0.3, &y, &start.modes, &direction, &mut scratch, &mut exact);
            let step = 1e-6;
            let mut at = |side: f64| {
                let mut moved = y.clone();
                moved[column] += side * step;
                let mut dy = vec![0.0; 2 * n];
                system.derivatives(0.3, &moved, &start.modes, &mut scratch, &mut dy);
                dy
            };
            let (above, below) = (at(1.0), at(-1.0));
            for row in n..2 * n {
                let difference = (above[row] - below[row]) / (2.0 * step);
                let size = exact[row].abs().max(1e3);
                assert_abs_diff_eq!(exact[row], difference, epsilon = 1e-6 * size);
                if exact[row] != 0.0 {
                    assert!(rows[row - n].contains(&(column % n)), "{row} {column}");
                }
            }
        }
    }
}

/// Where the output of a sum has a position function with a reach, the run stops there.
#[test]
fn what_follows_a_sum_is_watched_for_its_dead_position() {
    let objects = r#""a": { "kind": "drive", "motion": { "speed": 1 } },
        "b": { "kind": "drive", "motion": { "fixed": 0.2 } },
        "sum": { "kind": "differential", "inertia": 0.1, "masses": 0,
            "inputs": { "one": { "object": "a", "ratio": 0.5 }, "two": { "object": "b", "ratio": 1 } } },
        "ram": { "kind": "slider", "input": "sum", "inertia": 1, "masses": 0,
            "position": { "slider_crank": { "crank": 0.25, "rod": 0.2 } } }"#;
    let scene = super::read(&super::document(
        objects,
        r#""duration": 4, "start": "on_law""#,
        dam::object::Registry::standard(),
    ));
    let (system, settings) = super::ready(&scene);
    // sin θ = 0.2/0.25 at θ = 0.5·t + 0.2.
    let time = ((0.8f64).asin() - 0.2) / 0.5;
    let warning = &system.model().warnings[0];
    assert!(
        warning.contains(&format!("t = {} s", dam::units::shown(time, 6))),
        "{warning}"
    );
    let control = dam::studies::Control::default();
    let result = dam::studies::run::run(&system, &settings, &control, &mut []).unwrap();
    assert_eq!(result.figures.run.stopped.as_deref(), Some("dead_position"));
    assert_abs_diff_eq!(result.outcome.time, time, epsilon = 1e-4);
}
