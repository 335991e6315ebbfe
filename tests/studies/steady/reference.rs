//! The steady motion against figures computed elsewhere
//! (`tests/reference/steady-state.json`: 34-digit arithmetic, composite Gauss
//! quadrature), against closed forms and against textbooks.

use super::machines::{Worst, machine, number, question, reference};
use dam::steady::{FunctionKind, Mean, Profile, Question, Refusal, Table, find_steady_motion};
use serde_json::Value;
use std::f64::consts::{PI, TAU};

#[test]
fn functions_give_the_reference_to_nine_digits() {
    let mut worst = Worst::default();
    for case in reference()["cases"].as_array().unwrap() {
        let profile = machine(case).profile().unwrap();
        for mean in Mean::ALL {
            let expected = &case["continuous"][mean.name()];
            let id = format!("{} {}", case["id"], mean.name());
            let found = find_steady_motion(&profile, &question(case, mean));
            if expected["feasible"] == false {
                let Err(Refusal::TooSlow { lowest, .. }) = found else {
                    panic!("{id}: {found:?}");
                };
                worst.see(&id, lowest, number(&expected["lowest_mean"]), 1e-9);
                continue;
            }
            let motion = found.unwrap();
            let f = &motion.figures;
            assert!(f.met, "{id}: {:?}", f.warnings);
            for (name, found) in [
                ("T_at_phi0", f.energy_at_start),
                ("E0_paper", f.reference_energy),
                ("omega_min", f.least_speed.value),
                ("omega_max", f.greatest_speed.value),
                ("delta", f.fluctuation),
                ("period", f.period),
                ("mean_time", f.means.time),
                ("mean_angle", f.means.angle),
                ("mean_midrange", f.means.midrange),
            ] {
                worst.see(
                    &format!("{id} {name}"),
                    found,
                    number(&expected[name]),
                    1e-9,
                );
            }
            for (name, found) in [
                ("phi_omega_min", f.least_speed.at),
                ("phi_omega_max", f.greatest_speed.at),
                ("phi_of_J_min", f.reference_position),
            ] {
                let expected = number(&expected[name]);
                worst.see_of(&format!("{id} {name}"), found, expected, TAU, 1e-9);
            }
            let bracket = &expected["bracket_paper"];
            for (name, found) in [
                ("E0_min", f.first_bracket[0]),
                ("E0_max", f.first_bracket[1]),
            ] {
                let expected = number(&bracket[name]);
                worst.see_of(&format!("{id} {name}"), found, expected, 1e3, 1e-9);
            }
            assert!(f.bracket[0] <= f.reference_energy * (1.0 + 1e-12));
            assert!(f.bracket[1] >= f.reference_energy * (1.0 - 1e-12));
            let rows = motion.rows(24);
            let profile = expected["profile"].as_array().unwrap();
            let most = profile
                .iter()
                .map(|row| number(&row["eps"]).abs())
                .fold(0.0, f64::max);
            for (row, expected) in rows.iter().zip(profile) {
                let at = format!("{id} at {}", expected["phi_deg"]);
                worst.see(&at, row.speed, number(&expected["omega"]), 1e-9);
                worst.see_of(&at, row.acceleration, number(&expected["eps"]), most, 1e-9);
            }
            let end = rows.last().unwrap();
            worst.see(&format!("{id} t(Φ)"), end.time, f.period, 1e-9);
            let check = motion.check().unwrap();
            assert!(
                check.speed.abs() < 1e-9 && check.period.abs() < 1e-9,
                "{id}: {check:?}"
            );
        }
    }
    println!("functions: worst {:.1e} ({})", worst.0, worst.1);
}

fn table(case: &Value) -> Table {
    let list = |name: &str| -> Vec<f64> {
        case["table"][name]
            .as_array()
            .unwrap()
            .iter()
            .map(number)
            .collect()
    };
    let (cycle, inertia) = (number(&case["cycle"]), list("J"));
    let count = inertia.len() as f64;
    let positions: Vec<f64> = (0..inertia.len())
        .map(|k| cycle * k as f64 / count)
        .collect();
    Table::new(cycle, &positions, &inertia, &list("A")).unwrap()
}

#[test]
fn tables_give_the_reference_to_eleven_digits() {
    let mut worst = Worst::default();
    for case in reference()["cases"].as_array().unwrap() {
        let table = table(case);
        for mean in Mean::ALL {
            let expected = &case["sampled"][mean.name()];
            let id = format!("{} {}", case["id"], mean.name());
            let found = table.find_steady_motion(&question(case, mean));
            if expected["feasible"] == false {
                let Err(Refusal::TooSlow { lowest, .. }) = found else {
                    panic!("{id}: {found:?}");
                };
                worst.see(&id, lowest, number(&expected["lowest_mean"]), 1e-11);
                continue;
            }
            let motion = found.unwrap();
            let f = &motion.figures.steady;
            for (name, found) in [
                ("T_at_first_sample", f.energy_at_start),
                ("omega_min", f.least_speed.value),
                ("omega_max", f.greatest_speed.value),
                ("delta", f.fluctuation),
                ("omega_first", motion.rows()[0].speed),
            ] {
                worst.see(
                    &format!("{id} {name}"),
                    found,
                    number(&expected[name]),
                    1e-11,
                );
            }
            // The estimate is of the size of the distance to the functions; that
            // of extremes knows nothing where they stand on even samples.
            if mean == Mean::Midrange {
                continue;
            }
            let exact = number(&case["continuous"][mean.name()]["T_at_phi0"]);
            let halving = motion.figures.halving.unwrap();
            let off = (f.energy_at_start - exact).abs();
            assert!(
                off <= 2.0 * halving.energy_at_start.abs() + 1e-9 * exact,
                "{id}: {off:e} off, {:e} estimated",
                halving.energy_at_start
            );
        }
    }
    println!("tables: worst {:.1e} ({})", worst.0, worst.1);
}

/// Near stalling, where figures amplify what a mean is off, against a level chosen first.
#[test]
fn tables_almost_at_a_stop_keep_eleven_digits_by_every_mean() {
    let count = 288;
    let cycle = 2.0 * TAU;
    let positions: Vec<f64> = (0..count)
        .map(|k| cycle * k as f64 / count as f64)
        .collect();
    let inertia: Vec<f64> = positions
        .iter()
        .map(|phi| 0.2 + 0.03 * (2.0 * phi).cos())
        .collect();
    let work: Vec<f64> = positions
        .iter()
        .map(|phi| 300.0 * (phi / 2.0).sin() + 120.0 * (1.5 * phi).cos() + 40.0 * (3.0 * phi).sin())
        .collect();
    let table = Table::new(cycle, &positions, &inertia, &work).unwrap();
    let least = work.iter().copied().fold(f64::INFINITY, f64::min);
    for level in (-48..=16).map(|power| 10f64.powf(f64::from(power) / 8.0)) {
        let speeds: Vec<f64> = work
            .iter()
            .zip(&inertia)
            .map(|(work, inertia)| (2.0 * (level + work - least) / inertia).sqrt())
            .collect();
        let low = speeds.iter().copied().fold(f64::INFINITY, f64::min);
        let high = speeds.iter().copied().fold(0.0, f64::max);
        let n = count as f64;
        for (mean, mean_speed) in [
            (
                Mean::Time,
                n / speeds.iter().map(|speed| 1.0 / speed).sum::<f64>(),
            ),
            (Mean::Angle, speeds.iter().sum::<f64>() / n),
            (Mean::Midrange, 0.5 * (low + high)),
        ] {
            // Means over samples hardly know of the slowest: theirs are ill-conditioned sooner.
            if mean != Mean::Midrange && level < 1.0 {
                continue;
            }
            let question = Question {
                mean,
                ..Question::new(mean_speed)
            };
            let found = table.find_steady_motion(&question).unwrap().figures.steady;
            approx::assert_relative_eq!(found.least_speed.value, low, max_relative = 1e-11);
            approx::assert_relative_eq!(found.greatest_speed.value, high, max_relative = 1e-13);
        }
    }
}

#[test]
fn accelerations_of_a_smooth_table_are_those_of_the_functions() {
    let file = reference();
    let case = &file["cases"][0];
    let rows = table(case)
        .find_steady_motion(&question(case, Mean::Time))
        .unwrap()
        .rows();
    let expected = case["continuous"]["time"]["profile"].as_array().unwrap();
    assert_eq!(rows.len(), 73);
    for (k, expected) in expected.iter().enumerate() {
        let row = &rows[3 * k];
        approx::assert_abs_diff_eq!(row.acceleration, number(&expected["eps"]), epsilon = 1e-4);
        approx::assert_relative_eq!(row.speed, number(&expected["omega"]), max_relative = 1e-9);
    }
}

#[test]
fn failures_are_refused_in_their_words() {
    let file = reference();
    let failures = file["failures"].as_array().unwrap();
    let list =
        |value: &Value| -> Vec<f64> { value.as_array().unwrap().iter().map(number).collect() };
    let closed = |failure: &Value| {
        let (mut inertia, work) = (list(&failure["J"]), list(&failure["A_incl_end"]));
        let count = inertia.len();
        inertia.push(inertia[0]);
        let positions: Vec<f64> = (0..=count).map(|k| TAU * k as f64 / count as f64).collect();
        Table::new(TAU, &positions, &inertia, &work)
    };
    let open = closed(&failures[0]).unwrap();
    let refusal = open.find_steady_motion(&Question::new(10.0)).unwrap_err();
    assert!(
        matches!(refusal, Refusal::Surplus { work: 5.0, .. }),
        "{refusal:?}"
    );
    assert!(refusal.message().contains("gains speed") && refusal.message().contains("do 5 J"));
    assert!(refusal.hint().contains("balance") && refusal.hint().contains("-0.7957747"));
    let balanced = Question {
        balance: true,
        ..Question::new(10.0)
    };
    let motion = open.find_steady_motion(&balanced).unwrap();
    let moment = motion.figures.steady.balance.unwrap();
    approx::assert_relative_eq!(moment, -5.0 / TAU, max_relative = 1e-15);
    let refusal = closed(&failures[1]).unwrap_err();
    assert!(
        matches!(refusal, Refusal::Inertia { position, inertia: -0.1 } if position == PI / 2.0),
        "{refusal:?}"
    );
    let profile = Profile::new(TAU, &[], FunctionKind::Moment, &mut |_, phi| {
        [phi.cos(), 0.0]
    });
    assert!(matches!(profile, Err(Refusal::Inertia { .. })));
}

#[test]
fn bad_numbers_are_refused_by_their_field_all_at_once() {
    let profile =
        Profile::new(TAU, &[], FunctionKind::Work, &mut |_, phi| [2.0, phi.sin()]).unwrap();
    for speed in [0.0, -1.0, f64::NAN, f64::INFINITY] {
        let question = Question {
            tolerance: 0.0,
            ..Question::new(speed)
        };
        let Err(Refusal::Input { faults }) = find_steady_motion(&profile, &question) else {
            panic!("{speed} passed");
        };
        let fields: Vec<&str> = faults.iter().map(|fault| fault.field.as_str()).collect();
        assert_eq!(fields, ["mean_speed", "tolerance"]);
    }
    for (positions, inertia, work, field) in [
        (vec![0.0, 1.0], vec![1.0; 2], vec![0.0; 2], "position"),
        (vec![0.0, 1.0, 2.0], vec![1.0; 2], vec![0.0; 3], "inertia"),
        (vec![0.0, 1.0, 2.0], vec![1.0; 3], vec![0.0; 4], "work"),
        (vec![0.0, 2.0, 1.0], vec![1.0; 3], vec![0.0; 3], "position"),
        (
            vec![0.0, 1.0, f64::NAN],
            vec![1.0; 3],
            vec![0.0; 3],
            "position",
        ),
        (vec![0.0, 1.0, 9.0], vec![1.0; 3], vec![0.0; 3], "position"),
        (
            vec![0.0, 1.0, 2.0],
            vec![1.0; 3],
            vec![0.0, f64::INFINITY, 0.0],
            "work",
        ),
    ] {
        let Err(Refusal::Input { faults }) = Table::new(TAU, &positions, &inertia, &work) else {
            panic!("{positions:?} {inertia:?} {work:?} passed");
        };
        assert!(
            faults.iter().any(|fault| fault.field == field),
            "{faults:?}"
        );
    }
    for cycle in [0.0, -1.0, f64::NAN] {
        let found = Profile::new(cycle, &[], FunctionKind::Work, &mut |_, _| [1.0, 0.0]);
        assert!(matches!(found, Err(Refusal::Input { .. })));
    }
    let found = Profile::new(TAU, &[], FunctionKind::Moment, &mut |_, phi| {
        [1.0, 1.0 / (phi - phi)]
    });
    assert!(matches!(found, Err(Refusal::Moment { .. })));
}

#[test]
fn the_period_of_a_sine_is_the_elliptic_integral_down_to_standing_still() {
    let (inertia, work) = (2.0, 30.0);
    let at = &mut |_: usize, phi: f64| [inertia, work * phi.cos()];
    let profile = Profile::new(TAU, &[], FunctionKind::Moment, at).unwrap();
    for speed in [10.0, 5.0, 3.0, 1.5, 1.0] {
        let motion = find_steady_motion(&profile, &Question::new(speed)).unwrap();
        let start = motion.figures.energy_at_start;
        // K by the arithmetic-geometric mean; 1 − m from the least energy, which
        // start − work has no digits of.
        let least = 0.5 * inertia * motion.figures.least_speed.value.powi(2);
        let rest = least / (start + work);
        let (mut a, mut b) = (1.0, rest.sqrt());
        for _ in 0..60 {
            (a, b) = (0.5 * (a + b), (a * b).sqrt());
        }
        let exact = (inertia / 2.0).sqrt() * 4.0 / (start + work).sqrt() * PI / (2.0 * a);
        approx::assert_relative_eq!(motion.figures.period, exact, max_relative = 1e-11);
        let stops = motion
            .figures
            .warnings
            .iter()
            .any(|w| w.contains("almost stops"));
        assert_eq!(stops, motion.figures.energy_ratio < 1e-9, "{speed}");
        // The equation of motion confirms it however slow the machine is at its slowest.
        let check = motion.check().unwrap();
        assert!(check.speed.abs() < 1e-11, "{speed}: {check:?}");
        assert!(check.period.abs() < 1e-9, "{speed}: {check:?}");
    }
    let refusal = find_steady_motion(&profile, &Question::new(0.1)).unwrap_err();
    assert!(
        matches!(
            refusal,
            Refusal::TooSlow {
                mean: Mean::Time,
                ..
            }
        ),
        "{refusal:?}"
    );
}

#[test]
fn a_corner_of_the_work_gives_the_mean_over_time_a_lowest_value() {
    // A triangle: M = +m, then −m; T = m·|φ − π| at the limit, J = 1.
    let moment = 3.0;
    let at = &mut |piece: usize, _: f64| [1.0, if piece == 0 { -moment } else { moment }];
    let profile = Profile::new(TAU, &[PI], FunctionKind::Moment, at).unwrap();
    let refusal = find_steady_motion(&profile, &Question::new(1.0)).unwrap_err();
    let Refusal::TooSlow {
        lowest, position, ..
    } = refusal
    else {
        panic!("{refusal:?}");
    };
    // ∫dφ/√(2m|φ−π|) = 2·√(2π/m).
    approx::assert_relative_eq!(
        lowest,
        TAU / (2.0 * (TAU / moment).sqrt()),
        max_relative = 1e-8
    );
    approx::assert_relative_eq!(position, PI, max_relative = 1e-12);
    let motion = find_steady_motion(&profile, &Question::new(1.01 * lowest)).unwrap();
    assert!(motion.figures.met);
}

#[test]
fn constant_machines_and_long_cycles_are_no_special_case() {
    let profile =
        Profile::new(2.0 * TAU, &[], FunctionKind::Moment, &mut |_, _| [2.0, 0.0]).unwrap();
    for mean in Mean::ALL {
        let question = Question {
            mean,
            ..Question::new(7.0)
        };
        let motion = find_steady_motion(&profile, &question).unwrap();
        approx::assert_relative_eq!(motion.figures.energy_at_start, 49.0, max_relative = 1e-12);
        approx::assert_relative_eq!(motion.figures.period, 2.0 * TAU / 7.0, max_relative = 1e-12);
        assert!(motion.figures.fluctuation.abs() < 1e-12);
    }
}
