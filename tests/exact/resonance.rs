//! Exact propagation of modes driven at their own frequency and next to it,
//! against Taylor series of the equations of motion and closed forms.

use crate::support::{Series, motion_error, problem, rows, sine};
use dam::exact::{
    ExactRun, ExactTree, Law, PairState, Request, TimeLoad, TreeMass, TreePair, TreeProblem,
};
use nalgebra::DMatrix;

/// Distances of the drive from the mode, relative: at it, next to it, on both
/// sides of where the one form of the answer takes over from the other.
const OFFSETS: [f64; 15] = [
    0.0, 1e-15, -1e-12, 1e-12, -1e-8, 1e-8, 1e-6, -1e-4, 1e-4, 9.9e-4, -9.9e-4, 1.01e-3, -1.01e-3,
    3e-3, 1e-2,
];

/// Greatest error of the motion; a light drag of what floats costs digits.
const BOUND: f64 = 1e-12;
const DRAGGED: f64 = 1e-10;

/// Step of the series (s): a power of two, so that the clock does not drift.
const STEP: f64 = 1.0 / 1024.0;

fn run(problem: &TreeProblem, end: f64) -> ExactRun {
    let request = Request {
        all_masses: true,
        audit: true,
        figures: true,
        ..Request::new(end, 60)
    };
    let run = ExactTree::new(problem.clone()).run(&request).expect("runs");
    assert!(run.complete);
    let audit = run.audit.expect("audit");
    assert!(audit.error() < 1e-11, "{audit:?}");
    run
}

/// Runs both and compares switches, motion and the extremes of δ.
fn compare(problem: &TreeProblem, states: &[PairState], end: f64, step: f64, what: &str) -> usize {
    compared(problem, states, end, step, (what, BOUND))
}

/// The same to a bound.
fn compared(
    problem: &TreeProblem,
    states: &[PairState],
    end: f64,
    step: f64,
    (what, bound): (&str, f64),
) -> usize {
    let exact = run(problem, end);
    assert_eq!(exact.start, states, "{what}: states at the start");
    let mut series = Series::new(problem, states.to_vec(), step);
    let expected = rows(&mut series, end, 60);
    let list = |run: &ExactRun| -> Vec<(usize, PairState)> {
        run.switches.iter().map(|s| (s.mass, s.after)).collect()
    };
    let met: Vec<(usize, PairState)> = series.met.iter().map(|s| (s.mass, s.after)).collect();
    assert_eq!(list(&exact), met, "{what}: switches");
    for (a, b) in exact.switches.iter().zip(&series.met) {
        assert!((a.time - b.time).abs() < bound * end, "{what}: {a:?} {b:?}");
    }
    let error = motion_error(&exact, &expected);
    assert!(error < bound, "{what}: {error:e}");
    let last = problem.objects[0].output[0].0;
    let (greatest, least) = expected.iter().fold((0.0f64, 0.0f64), |(a, b), row| {
        (a.max(row[last]), b.min(row[last]))
    });
    let figures = exact.figures[0];
    let swing = greatest.max(-least);
    assert!(figures.delta_max >= greatest - bound * swing, "{what}");
    assert!(figures.delta_min <= least + bound * swing, "{what}");
    exact.switches.len()
}

/// One mass of unit inertia at 100 rad/s, driven `offset` beside it.
fn one_mass(offset: f64, damping: f64) -> TreeProblem {
    let mass = TreeMass::new(1.0, None, 1e4, damping);
    problem(vec![mass], vec![sine(0.01, 100.0 * (1.0 + offset), 0.4)])
}

#[test]
fn one_mass_is_exact_through_resonance() {
    for damping in [0.0, 1e-12, 1e-8, 1e-4, 1e-2, 1.0] {
        for offset in OFFSETS {
            // 48 cycles: at resonance the swing grows to 150 times the drive's.
            let what = format!("b = {damping:e}, {offset:e} beside");
            let none = compare(
                &one_mass(offset, damping),
                &[PairState::Free],
                3.0,
                STEP,
                &what,
            );
            assert_eq!(none, 0);
        }
    }
}

#[test]
fn the_growth_at_resonance_is_that_of_the_closed_form() {
    // q̈ + ω²q = aω²sin ωt from rest: q = a(sin ωt − ωt cos ωt)/2.
    let (a, omega, end) = (0.01, 100.0f64, 40.0);
    let mass = TreeMass::new(1.0, None, omega * omega, 0.0);
    let problem = problem(vec![mass], vec![sine(a, omega, 0.0)]);
    let run = run(&problem, end);
    let at = |t: f64| 0.5 * a * ((omega * t).sin() - omega * t * (omega * t).cos());
    for (k, q) in run
        .samples
        .chunks(run.columns)
        .map(|row| row[0])
        .enumerate()
    {
        let t = end * (k + 1) as f64 / 60.0;
        assert!(
            (q - at(t)).abs() < 1e-12 * at(end).abs().max(0.5 * a * omega * t),
            "{t}: {q}"
        );
    }
    // Extremes of δ where q̇ = aω²t·sin(ωt)/2 = 0, at whole half-turns: the last
    // even one before the end is the least, the last odd one the greatest.
    let last = (omega * end / std::f64::consts::PI).floor();
    let turns = |even: bool| {
        if (last % 2.0 == 0.0) == even {
            last
        } else {
            last - 1.0
        }
    };
    let summit = |even: bool| 0.5 * a * std::f64::consts::PI * turns(even);
    let figures = run.figures[0];
    approx::assert_relative_eq!(figures.delta_max, summit(false), max_relative = 1e-12);
    approx::assert_relative_eq!(figures.delta_min, -summit(true), max_relative = 1e-12);
}

/// Natural frequencies of a tree without pairs.
fn frequencies(masses: &[TreeMass]) -> Vec<f64> {
    let n = masses.len();
    let mut k = DMatrix::<f64>::zeros(n, n);
    for (i, m) in masses.iter().enumerate() {
        let root = |i: usize| masses[i].inertia.sqrt();
        k[(i, i)] += (m.stiffness + m.ground_stiffness) / m.inertia;
        if let Some(p) = m.parent {
            k[(p, p)] += m.stiffness * m.lever * m.lever / masses[p].inertia;
            k[(i, p)] -= m.stiffness * m.lever / (root(i) * root(p));
            k[(p, i)] -= m.stiffness * m.lever / (root(i) * root(p));
        }
    }
    let mut all: Vec<f64> = k.symmetric_eigenvalues().iter().map(|x| x.sqrt()).collect();
    all.sort_by(f64::total_cmp);
    all
}

/// A root with two branches on levers.
fn branched() -> Vec<TreeMass> {
    let mut root = TreeMass::new(1.0, None, 2e4, 0.0);
    root.ground_stiffness = 800.0;
    root.offset = 0.01;
    let mut left = TreeMass::new(0.4, Some(0), 7e3, 0.0);
    (left.lever, left.ratio) = (0.7, 0.7);
    let table = vec![(0.1, -4.0), (0.35, 6.0), (0.8, -5.0)];
    left.loads.push(TimeLoad::Table(table));
    let mut right = TreeMass::new(0.3, Some(0), 5e3, 0.0);
    (right.lever, right.ratio) = (-1.3, -1.3);
    right.ground_stiffness = 15.0;
    vec![root, left, right]
}

#[test]
fn every_mode_of_a_tree_may_be_driven_at_its_own_frequency() {
    let free = vec![PairState::Free; 3];
    for omega in frequencies(&branched()) {
        for offset in [0.0, -1e-12, 1e-8, 1e-4, -2e-3] {
            // With a second sine that stays a lane, a line, loads over time.
            let parts = vec![
                sine(0.01, omega * (1.0 + offset), 0.4),
                sine(0.02, 37.0, 1.0),
            ];
            let mut problem = problem(branched(), parts);
            if let Law::Harmonic { mean, slope, .. } = &mut problem.law {
                (*mean, *slope) = (0.2, 0.05);
            }
            compare(
                &problem,
                &free,
                1.2,
                0.5 * STEP,
                &format!("{omega}, {offset:e}"),
            );
        }
    }
}

#[test]
fn two_modes_at_once_and_the_slowest_among_fast_ones() {
    let masses = branched();
    let own = frequencies(&masses);
    let both = vec![sine(0.01, own[0], 0.4), sine(0.002, own[2], 1.0)];
    compare(
        &problem(masses, both),
        &[PairState::Free; 3],
        1.2,
        0.5 * STEP,
        "both",
    );
    let mut masses = branched();
    masses[2].stiffness *= 1e4;
    let slow = frequencies(&masses)[0];
    let slowly = vec![sine(0.01, slow, 0.4)];
    compare(
        &problem(masses, slowly),
        &[PairState::Free; 3],
        0.4,
        STEP / 128.0,
        "slow",
    );
}

#[test]
fn a_gap_makes_resonance_switch() {
    let engaged = PairState::Engaged(0);
    for damping in [0.0, 1e-8, 1e-4] {
        for offset in [0.0, 1e-12, -1e-8, 1e-4, 9.9e-4, 1.01e-3] {
            // Pressed on by its load; the swing grows until the pair opens, hits
            // the other flank and comes back.
            let mut problem = one_mass(offset, damping);
            problem.masses[0].pair = TreePair::Form { gap: 0.02 };
            problem.masses[0].loads.push(TimeLoad::Constant(-2000.0));
            problem.displacement[0] = -0.21;
            let what = format!("b = {damping:e}, {offset:e} beside");
            let count = compare(&problem, &[engaged], 1.2, 0.25 * STEP, &what);
            assert!(count > 20, "{what}: {count}");
        }
    }
}

#[test]
fn a_part_that_floats_may_be_driven_at_its_own_frequency() {
    // Two masses behind a pair that opens; open, they swing against each other at
    // √(c/J₁ + c/J₂), and dampers to the ground are what drives them there.
    let open = || {
        let mut head = TreeMass::new(1.0, None, 4e4, 0.0);
        head.pair = TreePair::Force { opens: 1.0 };
        let mut tail = TreeMass::new(0.5, Some(0), 5e3, 0.0);
        tail.ground_damping = 0.1;
        tail.loads.push(TimeLoad::Constant(-100.0));
        vec![head, tail]
    };
    let own = (5e3f64 / 1.0 + 5e3 / 0.5).sqrt();
    for offset in [0.0, 1e-12, 1e-8, -1e-4] {
        let mut problem = problem(open(), vec![sine(0.01, own * (1.0 + offset), 0.0)]);
        problem.displacement = vec![0.01, 0.0101];
        problem.speed = vec![1.0, 1.1];
        let count = compared(
            &problem,
            &[PairState::Free; 2],
            0.6,
            0.125 * STEP,
            (&format!("{offset:e}"), DRAGGED),
        );
        assert!(count >= 4, "{offset:e}: {count}");
    }
}
