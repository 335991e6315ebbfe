//! The propagation against an integration of the equations of motion that
//! shares nothing with it but the problem: Runge and Kutta's fourth-order method
//! with small fixed steps, pair rules tested after every step, switches found
//! by halving the step.
//!
//! It has its own integrator on purpose.

mod integrate;

use super::*;
use integrate::{LawAt, integrate};
use std::sync::Arc;

/// Runs both and compares end states, switch counts and times.
fn compare(problem: TreeProblem, law: &LawAt, end: f64, steps: usize, tolerance: f64) -> ExactRun {
    let tree = ExactTree::new(problem.clone());
    let request = Request {
        figures: true,
        audit: true,
        ..Request::new(end, 0)
    };
    let run = tree.run(&request).expect("runs");
    assert!(run.complete);
    let audit = run.audit.expect("audit");
    assert!(audit.error() < 1e-10, "{audit:?}");
    let other = integrate(&problem, law, &run.start, end, steps);
    let own: Vec<f64> = run
        .switches
        .iter()
        .filter(|s| s.before.engaged() != s.after.engaged())
        .map(|s| s.time)
        .collect();
    assert_eq!(
        own.len(),
        other.switches.len(),
        "{own:?} {:?}",
        other.switches
    );
    for (a, b) in own.iter().zip(&other.switches) {
        assert!((a - b).abs() < tolerance * end, "{a} {b}");
    }
    let scale = |y: &[f64]| y.iter().fold(0.0f64, |m, x| m.max(x.abs()));
    for (mine, theirs) in [(&run.displacement, &other.q), (&run.speed, &other.v)] {
        let size = scale(theirs);
        for (a, b) in mine.iter().zip(theirs) {
            assert!(
                (a - b).abs() < tolerance * size,
                "{a} {b} {:e}",
                (a - b).abs() / size
            );
        }
    }
    let f = run.figures[0];
    assert!(f.delta_max >= f.delta_min && f.sigma <= f.delta_max.max(-f.delta_min));
    run
}

fn sines(parts: &[(f64, f64, f64)]) -> Law {
    let sine = |&(amplitude, frequency, phase): &(f64, f64, f64)| Sine {
        amplitude,
        frequency,
        phase,
    };
    Law::Harmonic {
        mean: 0.2,
        slope: 0.5,
        sines: parts.iter().map(sine).collect(),
    }
}

fn sines_at(parts: Vec<(f64, f64, f64)>) -> Box<LawAt> {
    Box::new(move |t, _| {
        let mut sum = [0.2 + 0.5 * t, 0.5, 0.0];
        for (a, w, p) in &parts {
            let (s, c) = (w * t + p).sin_cos();
            sum[0] += a * s;
            sum[1] += a * w * c;
            sum[2] -= a * w * w * s;
        }
        sum
    })
}

fn tree(masses: Vec<TreeMass>, law: Law) -> TreeProblem {
    let n = masses.len();
    let object = |m: usize| TreeObject {
        first: m,
        output: vec![(m, 1.0)],
        driver: None,
    };
    TreeProblem {
        displacement: vec![0.0; n],
        speed: vec![0.0; n],
        objects: (0..n).map(object).collect(),
        masses,
        law,
    }
}

/// A root with two branches on levers, one with a gap, everything held to the
/// ground a little.
fn branched(law: Law) -> TreeProblem {
    let mut root = TreeMass::new(1.0, None, 900.0, 3.0);
    root.pair = TreePair::Force { opens: 1.0 };
    root.ground_stiffness = 20.0;
    root.ground_damping = 0.3;
    root.offset = 0.1;
    root.loads.push(TimeLoad::Constant(-30.0));
    let mut left = TreeMass::new(0.4, Some(0), 700.0, 1.0);
    (left.lever, left.ratio) = (0.7, 0.7);
    left.pair = TreePair::Form { gap: 0.02 };
    left.ground_damping = 0.2;
    left.loads
        .push(TimeLoad::Table(vec![(0.1, -4.0), (0.35, 6.0), (0.8, -5.0)]));
    let mut right = TreeMass::new(0.3, Some(0), 500.0, 2.0);
    (right.lever, right.ratio) = (-1.3, -1.3);
    right.ground_stiffness = 15.0;
    tree(vec![root, left, right], law)
}

#[test]
fn a_branched_tree_with_two_pairs_on_two_sines() {
    let parts = vec![(0.3, 9.0, 0.4), (0.05, 23.0, 1.0)];
    let run = compare(
        branched(sines(&parts)),
        &*sines_at(parts),
        1.5,
        30_000,
        1e-7,
    );
    assert!(run.switches.iter().any(|s| s.mass == 0));
    assert!(run.switches.iter().any(|s| s.mass == 1));
    assert!(run.switches.len() > 10, "{}", run.switches.len());
}

#[test]
fn overdamped_modes_under_a_time_table() {
    let parts = vec![(0.2, 7.0, 0.0)];
    let mut masses: Vec<TreeMass> = (0..3)
        .map(|m: usize| TreeMass::new(0.5, m.checked_sub(1), 400.0, 60.0))
        .collect();
    masses[1].damping = 5.0;
    masses[0].pair = TreePair::Force { opens: 1.0 };
    let table = vec![(0.0, -8.0), (0.4, 8.0), (0.7, -10.0), (1.1, -3.0)];
    masses[2].loads.push(TimeLoad::Table(table));
    let run = compare(
        tree(masses, sines(&parts)),
        &*sines_at(parts),
        1.5,
        30_000,
        1e-7,
    );
    assert!(run.switches.len() >= 2, "{:?}", run.switches);
}

#[test]
fn a_floating_part_dragged_by_dampers_to_the_ground() {
    let parts = vec![(0.5, 12.0, 0.0)];
    let mut masses = vec![
        TreeMass::new(0.5, None, 800.0, 2.0),
        TreeMass::new(0.2, Some(0), 300.0, 0.5),
    ];
    masses[0].pair = TreePair::Force { opens: 1.0 };
    masses[1].ground_damping = 0.6;
    masses[1].loads.push(TimeLoad::Constant(-20.0));
    let run = compare(
        tree(masses, sines(&parts)),
        &*sines_at(parts),
        1.2,
        24_000,
        1e-7,
    );
    assert!(run.switches.len() >= 4, "{}", run.switches.len());
}

#[test]
fn a_floating_part_drifts_against_its_damper_under_a_constant_load() {
    let mut mass = TreeMass::new(0.5, None, 800.0, 2.0);
    mass.pair = TreePair::Force { opens: 1.0 };
    mass.ground_damping = 3.0;
    mass.loads.push(TimeLoad::Constant(-5.0));
    let still = |_: f64, _: f64| [0.0; 3];
    let law = Law::Harmonic {
        mean: 0.0,
        slope: 0.0,
        sines: Vec::new(),
    };
    let mut problem = tree(vec![mass], law);
    problem.displacement[0] = 0.4;
    let run = compare(problem, &still, 1.0, 20_000, 1e-7);
    assert!(!run.switches.is_empty());
}

/// Accelerations ±40 and a ramp in turn, every 0.1 s.
#[derive(Debug)]
struct Ramps;

impl Ramps {
    fn acceleration(k: usize) -> [f64; 2] {
        [[40.0, 0.0], [-40.0, 0.0], [-40.0, 800.0], [40.0, -800.0]][k % 4]
    }

    fn joint(k: usize) -> [f64; 2] {
        (0..k).fold([0.0, 0.0], |[l, v], j| {
            let ([a, b], h) = (Self::acceleration(j), 0.1f64);
            [
                l + h * (v + h * (a / 2.0 + h * b / 6.0)),
                v + h * (a + h * b / 2.0),
            ]
        })
    }

    fn at(t: f64, side: f64) -> [f64; 3] {
        let k = (side / 0.1).floor() as usize;
        let (h, [a, b], [l, v]) = (t - 0.1 * k as f64, Self::acceleration(k), Self::joint(k));
        [
            l + h * (v + h * (a / 2.0 + h * b / 6.0)),
            v + h * (a + h * b / 2.0),
            a + b * h,
        ]
    }
}

impl SpanSource for Ramps {
    fn span(&self, time: f64) -> PolynomialSpan {
        let k = ((time + 1e-12) / 0.1).floor() as usize;
        let ([value, speed], [a, b]) = (Self::joint(k), Self::acceleration(k));
        let mut acceleration = [0.0; LAW_DEGREE + 1];
        (acceleration[0], acceleration[1]) = (a, b);
        PolynomialSpan {
            start: 0.1 * k as f64,
            low: 0.0,
            end: 0.1 * (k + 1) as f64,
            value,
            speed,
            acceleration,
        }
    }
}

#[test]
fn polynomial_spans_of_the_law() {
    let mut problem = branched(Law::Spans(Arc::new(Ramps)));
    problem.masses[1].loads.clear();
    // Steps end on the joints of the law: 24 000 over 1.2 s do.
    let run = compare(problem, &Ramps::at, 1.2, 24_000, 1e-7);
    assert!(run.switches.len() > 4, "{}", run.switches.len());
}

#[test]
fn equal_branches_switch_together() {
    let parts = vec![(0.3, 11.0, 0.2)];
    let mut masses = vec![TreeMass::new(0.8, None, 900.0, 2.0)];
    for _ in 0..2 {
        let mut branch = TreeMass::new(0.3, Some(0), 400.0, 1.0);
        branch.pair = TreePair::Force { opens: 1.0 };
        branch.loads.push(TimeLoad::Constant(-9.0));
        masses.push(branch);
    }
    let run = compare(
        tree(masses, sines(&parts)),
        &*sines_at(parts),
        1.5,
        30_000,
        1e-7,
    );
    assert!(run.switches.len() >= 4, "{}", run.switches.len());
    let times = |mass: usize| {
        run.switches
            .iter()
            .filter(move |s| s.mass == mass)
            .map(|s| s.time)
    };
    assert_eq!(times(1).count(), times(2).count());
    for (a, b) in times(1).zip(times(2)) {
        assert!((a - b).abs() < 1e-12, "{a} {b}");
    }
}

/// A mass dropped on a damped flank under its weight.
fn dropped(damping: f64) -> TreeProblem {
    let mut mass = TreeMass::new(1.0, None, 1e4, damping);
    mass.pair = TreePair::Force { opens: 1.0 };
    mass.loads.push(TimeLoad::Constant(-9.81));
    let law = Law::Harmonic {
        mean: 0.0,
        slope: 0.0,
        sines: Vec::new(),
    };
    let mut problem = tree(vec![mass], law);
    problem.displacement[0] = 0.01;
    problem
}

#[test]
fn bounces_end_in_lasting_contact() {
    let still = |_: f64, _: f64| [0.0; 3];
    let run = compare(dropped(8.0), &still, 3.0, 60_000, 1e-7);
    assert!(run.switches.len() > 10, "{}", run.switches.len());
    let last = run.switches[run.switches.len() - 1];
    assert!(last.after.engaged() && last.time < 2.5, "{last:?}");
    assert!((run.displacement[0] + 9.81e-4).abs() < 1e-7);
    // Every bounce is lower than the one before.
    let speeds: Vec<f64> = run
        .switches
        .iter()
        .filter(|s| s.after.engaged())
        .map(|s| -s.speed)
        .collect();
    assert!(speeds.windows(2).all(|w| w[1] < w[0]));
}

#[test]
fn a_graze_is_told_from_a_miss() {
    // q = −c̄ + A sin: a mass on a bilateral spring would just reach 0; the pair
    // behind it opens when the load is a 10⁻¹⁰ smaller than the peak of the
    // pull and not when it is as much greater.
    let count = |share: f64| {
        let parts = [(1e-3, 20.0, 0.0)];
        let (j, c, w) = (1.0, 1e4, 20.0f64);
        let mut mass = TreeMass::new(j, None, c, 0.0);
        mass.pair = TreePair::Force { opens: 1.0 };
        // Steady answer of q: A·J·Ω²/(c − JΩ²)·sin Ωt.
        let swing = parts[0].0 * j * w * w / (c - j * w * w);
        let load = c * swing * (1.0 + share);
        mass.loads.push(TimeLoad::Constant(-load));
        let law = Law::Harmonic {
            mean: 0.0,
            slope: 0.0,
            sines: parts
                .iter()
                .map(|&(amplitude, frequency, phase)| Sine {
                    amplitude,
                    frequency,
                    phase,
                })
                .collect(),
        };
        let mut problem = tree(vec![mass], law);
        problem.displacement[0] = -load / c;
        problem.speed[0] = swing * w;
        let run = ExactTree::new(problem)
            .run(&Request::new(0.3, 0))
            .expect("runs");
        run.switches.len()
    };
    assert_eq!(count(1e-10), 0);
    assert_eq!(count(1e-6), 0);
    assert!(count(-1e-10) >= 2);
    assert!(count(-1e-6) >= 2);
}

#[test]
fn what_cannot_be_run_is_refused_by_name() {
    let refusal = |problem: TreeProblem| {
        let run = ExactTree::new(problem).run(&Request::new(1.0, 0));
        run.expect_err("refused").reason
    };
    let masses = vec![TreeMass::new(1.0, None, f64::NAN, 0.0)];
    let broken = tree(masses, sines(&[(1.0, 3.0, 0.0)]));
    assert!(!refusal(broken).is_empty());
}
