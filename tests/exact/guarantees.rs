//! What exact propagation promises of its switches, against closed forms and
//! Taylor series of the equations of motion.

use crate::support::{Series, problem, rows, sine};
use dam::exact::{
    Cursor, ExactRun, ExactTree, LAW_DEGREE, Law, PairState, PolynomialSpan, Request, SpanSource,
    TimeLoad, TreeMass, TreePair, TreeProblem,
};
use std::sync::Arc;

const FORCE: TreePair = TreePair::Force { opens: 1.0 };
const ENGAGED: PairState = PairState::Engaged(0);

fn run(problem: &TreeProblem, end: f64) -> ExactRun {
    let request = Request {
        all_masses: true,
        audit: true,
        ..Request::new(end, 50)
    };
    let run = ExactTree::new(problem.clone()).run(&request).expect("runs");
    assert!(run.complete);
    let audit = run.audit.expect("audit");
    assert!(audit.error() < 1e-10, "{audit:?}");
    run
}

/// Runs both and compares start, switches one by one, and the motion.
fn compare(
    problem: &TreeProblem,
    states: Vec<PairState>,
    end: f64,
    step: f64,
    bound: f64,
) -> ExactRun {
    let exact = run(problem, end);
    assert_eq!(exact.start, states, "states at the start");
    let mut series = Series::new(problem, states, step);
    let expected = rows(&mut series, end, 50);
    let list = |run: &ExactRun| -> Vec<(usize, PairState)> {
        run.switches.iter().map(|s| (s.mass, s.after)).collect()
    };
    let met: Vec<(usize, PairState)> = series.met.iter().map(|s| (s.mass, s.after)).collect();
    assert_eq!(list(&exact), met, "switches");
    for (a, b) in exact.switches.iter().zip(&series.met) {
        assert!((a.time - b.time).abs() < bound * end, "{a:?} {b:?}");
    }
    let error = crate::support::motion_error(&exact, &expected);
    assert!(error < bound, "{error:e}");
    exact
}

/// One undamped mass in pure forced motion x = −W/c + Q·sin Ωt, whose pull is
/// greatest at Ωt = π/2: W = c·Q·(1 − excess).
fn grazing_pull(excess: f64) -> (TreeProblem, f64) {
    let (j, c, omega, a) = (0.1, 1e5, 200.0, 0.01);
    let mut mass = TreeMass::new(j, None, c, 0.0);
    mass.pair = FORCE;
    let forced = j * omega * omega * a / (c - j * omega * omega);
    let load = c * forced * (1.0 - excess);
    mass.loads.push(TimeLoad::Constant(-load));
    let mut p = problem(vec![mass], vec![sine(a, omega, 0.0)]);
    p.displacement[0] = -load / c;
    p.speed[0] = forced * omega;
    (p, omega)
}

#[test]
fn a_pull_that_grazes_zero_by_a_ten_billionth_opens_and_one_that_does_not_stays() {
    for excess in [1e-10, 1e-8, 1e-6] {
        let (p, omega) = grazing_pull(excess);
        let exact = run(&p, 3.0 / omega);
        let first = exact.switches.first().expect("opens");
        // 1 − cos δ = excess at the phase π/2 − δ.
        let at = (std::f64::consts::FRAC_PI_2 - (2.0 * excess).sqrt()) / omega;
        assert_eq!(first.after, PairState::Free);
        assert!(
            (first.time - at).abs() < 2e-5 * (2.0 * excess).sqrt() / omega,
            "{first:?} {at}"
        );
        let (p, omega) = grazing_pull(-excess);
        let exact = run(&p, 30.0 / omega);
        assert!(exact.switches.is_empty(), "{excess:e} {:?}", exact.switches);
    }
}

#[test]
fn a_flank_grazed_from_the_open_side_is_touched_or_passed_by_a_ten_billionth() {
    // A mass on a ground spring swings freely in its gap.
    for excess in [1e-10, 1e-8, 1e-6] {
        for sign in [1.0, -1.0] {
            let mut mass = TreeMass::new(0.1, None, 1e6, 30.0);
            mass.pair = TreePair::Form { gap: 2e-3 };
            mass.ground_stiffness = 1e3;
            let mut p = problem(vec![mass], vec![]);
            p.speed[0] = -1e-3 * (1.0 + sign * excess) * 100.0;
            let exact = run(&p, 0.05);
            if sign > 0.0 {
                // sin ωt = 1/(1 + excess), ω = 100/s, on the lower flank.
                let at = (1.0 / (1.0 + excess)).asin() / 100.0;
                let first = exact.switches.first().expect("touches");
                assert_eq!(first.after, ENGAGED);
                assert!((first.time - at).abs() < 2e-5 * (2.0 * excess).sqrt() / 100.0);
            } else {
                assert!(
                    exact.switches.is_empty(),
                    "{excess:e}: {:?}",
                    exact.switches
                );
            }
        }
    }
}

#[test]
fn a_loss_of_contact_shorter_than_any_search_step_is_found() {
    // Opens for a ten-thousandth of the cycle; search steps are a radian.
    let (p, omega) = grazing_pull(1e-8);
    let exact = compare(&p, vec![ENGAGED], 2.0 / omega, 2e-5 / omega, 1e-8);
    let open = exact.switches.iter().filter(|s| !s.after.engaged()).count();
    assert!(
        open >= 1 && exact.switches.len() > open,
        "{:?}",
        exact.switches
    );
    let apart = exact.switches[1].time - exact.switches[0].time;
    assert!(apart * omega < 2e-3, "{apart}");
    assert!(exact.steps < 60, "{}", exact.steps);
}

#[test]
fn switches_at_the_very_start_are_taken() {
    let mut mass = TreeMass::new(0.1, None, 1e5, 20.0);
    mass.pair = FORCE;
    mass.loads.push(TimeLoad::Constant(-100.0));
    let start = |x: f64, v: f64| {
        let mut p = problem(vec![mass.clone()], vec![sine(0.001, 50.0, 0.0)]);
        p.displacement[0] = x;
        p.speed[0] = v;
        p
    };
    // On the flank and leaving, on the flank and arriving, on it at rest under load.
    compare(&start(0.0, 1.0), vec![PairState::Free], 0.05, 1e-5, 1e-9);
    compare(&start(0.0, -1.0), vec![ENGAGED], 0.05, 1e-5, 1e-9);
    compare(&start(0.0, 0.0), vec![ENGAGED], 0.05, 1e-5, 1e-9);
    // Behind the flank, thrown out so fast that the force is cut off.
    compare(
        &start(-1e-4, 1.0),
        vec![PairState::Pressed(0)],
        0.05,
        1e-5,
        1e-9,
    );
    // The force exactly zero: c·x + b·ẋ = 0, the load presses it on again.
    compare(
        &start(-1e-4, 0.5),
        vec![PairState::Pressed(0)],
        0.05,
        1e-5,
        1e-9,
    );
}

#[test]
fn two_equal_branches_switch_together() {
    let branch = |parent| {
        let mut mass = TreeMass::new(0.05, parent, 1e5, 8.0);
        mass.pair = FORCE;
        mass.loads.push(TimeLoad::Constant(-40.0));
        mass
    };
    let masses = vec![
        TreeMass::new(0.2, None, 3e5, 20.0),
        branch(Some(0)),
        branch(Some(0)),
    ];
    let mut p = problem(masses, vec![sine(0.05, 150.0, 0.0)]);
    p.displacement = vec![-80.0 / 3e5, -80.0 / 3e5 - 4e-4, -80.0 / 3e5 - 4e-4];
    let exact = run(&p, 0.1);
    let of = |mass: usize| -> Vec<_> { exact.switches.iter().filter(|s| s.mass == mass).collect() };
    let (first, second) = (of(1), of(2));
    assert!(
        first.len() > 8 && first.len() == second.len(),
        "{} {}",
        first.len(),
        second.len()
    );
    for (a, b) in first.iter().zip(&second) {
        assert_eq!(a.after, b.after);
        assert!((a.time - b.time).abs() < 1e-13, "{a:?} {b:?}");
    }
    // The two move as one branch of twice the size would.
    let mut one = p.clone();
    one.masses.truncate(2);
    one.masses[1].inertia *= 2.0;
    one.masses[1].stiffness *= 2.0;
    one.masses[1].damping *= 2.0;
    one.masses[1].loads.push(TimeLoad::Constant(-40.0));
    one.displacement.truncate(2);
    one.speed.truncate(2);
    one.objects[0].output = vec![(1, 1.0)];
    let mut series = Series::new(&one, vec![PairState::Free, ENGAGED], 2e-5);
    series.run(0.1);
    assert_eq!(series.met.len(), first.len());
    for (a, b) in first.iter().zip(&series.met) {
        assert!((a.time - b.time).abs() < 1e-9, "{a:?} {b:?}");
    }
    assert!((exact.displacement[1] - series.q[1]).abs() < 1e-9 * series.q[1].abs().max(1e-3));
}

#[test]
fn a_pair_thrown_from_one_flank_onto_the_other_hits_it() {
    // A narrow gap: the damper cuts the force off behind one flank, and the next
    // that happens is the other flank.
    let mut mass = TreeMass::new(0.1, None, 1e5, 60.0);
    mass.pair = TreePair::Form { gap: 2e-4 };
    mass.loads.push(TimeLoad::Constant(-20.0));
    let mut p = problem(vec![mass], vec![sine(0.02, 300.0, 0.0)]);
    p.displacement[0] = -3e-4;
    p.speed[0] = 2.0;
    let exact = compare(&p, vec![PairState::Pressed(0)], 0.05, 1e-5, 1e-8);
    let over = |s: &&dam::exact::ExactSwitch| {
        s.before == PairState::Pressed(0) && s.after == PairState::Engaged(1)
    };
    assert!(
        exact.switches.iter().any(|s| over(&s)),
        "{:?}",
        exact.switches
    );
}

#[test]
fn chatter_ends_in_contact() {
    // Dropped onto its flank it bounces ever lower and stays: the law stands still.
    let mut mass = TreeMass::new(0.1, None, 1e5, 4.0);
    mass.pair = FORCE;
    mass.loads.push(TimeLoad::Constant(-10.0));
    let mut p = problem(vec![mass], vec![]);
    p.displacement[0] = 5e-3;
    let exact = compare(&p, vec![PairState::Free], 1.0, 1e-5, 1e-8);
    assert!(exact.switches.len() > 10, "{}", exact.switches.len());
    assert_eq!(exact.switches.last().map(|s| s.after), Some(ENGAGED));
    let off = (exact.displacement[0] + 1e-4).abs();
    assert!(off < 1e-7, "rests under its load: {off:e}");
}

/// x = 1 − cos over one second in two spans of opposite curvature.
#[derive(Debug)]
struct Cam;

impl SpanSource for Cam {
    fn span(&self, time: f64) -> PolynomialSpan {
        let cycle = (time / 0.02).floor();
        let start = cycle * 0.02;
        let up = cycle as i64 % 2 == 0;
        let sign = if up { 1.0 } else { -1.0 };
        let mut acceleration = [0.0; LAW_DEGREE + 1];
        // L = ±h(10u³ − 15u⁴ + 6u⁵): at rest at both ends.
        let (h, d) = (0.002, 0.02f64);
        acceleration[1] = sign * h * 60.0 / d.powi(3);
        acceleration[2] = -sign * h * 180.0 / d.powi(4);
        acceleration[3] = sign * h * 120.0 / d.powi(5);
        PolynomialSpan {
            start,
            low: 0.0,
            end: (cycle + 1.0) * 0.02,
            value: if up { 0.0 } else { h },
            speed: 0.0,
            acceleration,
        }
    }
}

/// A tree with everything in it: levers, a bilateral link, force- and
/// form-closed pairs, ground springs and dampers, a table, an overdamped branch.
fn everything() -> TreeProblem {
    let mut m: Vec<TreeMass> = vec![
        TreeMass::new(0.2, None, 3e5, 20.0),
        TreeMass::new(0.05, Some(0), 1e5, 12.0),
        TreeMass::new(0.03, Some(1), 8e4, 6.0),
        TreeMass::new(0.04, Some(0), 6e4, 10.0),
        TreeMass::new(0.01, Some(0), 1e4, 60.0),
    ];
    m[0].pair = FORCE;
    m[1].lever = 0.7;
    m[1].ratio = 0.7;
    m[1].pair = TreePair::Form { gap: 4e-4 };
    m[2].lever = -1.3;
    m[2].ratio = -0.91;
    m[3].lever = 1.8;
    m[3].ratio = 1.8;
    m[3].pair = TreePair::Force { opens: -1.0 };
    m[3].ground_stiffness = 500.0;
    m[3].offset = 0.03;
    m[4].ground_damping = 2.0;
    m[0].loads.push(TimeLoad::Constant(-60.0));
    m[2].loads.push(TimeLoad::Table(vec![
        (0.01, 0.0),
        (0.02, 40.0),
        (0.035, -30.0),
        (0.05, 5.0),
    ]));
    m[3].loads.push(TimeLoad::Constant(25.0));
    let mut p = problem(m, vec![sine(0.01, 150.0, 0.2), sine(0.004, 390.0, 1.0)]);
    p.displacement = vec![-3e-4, -5e-4, 1e-4, 1e-4, 0.0];
    p.displacement[3] = 1.8 * p.displacement[0] + 2e-4;
    p.speed = vec![0.0, 0.0, 0.1, 0.0, 0.0];
    p
}

#[test]
fn a_tree_with_everything_in_it_follows_the_series() {
    let p = everything();
    let states = vec![ENGAGED, ENGAGED, PairState::Free, ENGAGED, PairState::Free];
    let exact = compare(&p, states, 0.06, 1e-5, 1e-7);
    for mass in [0, 1, 3] {
        let own = exact.switches.iter().filter(|s| s.mass == mass).count();
        assert!(own > 0, "mass {mass}: {own}");
    }
}

#[test]
fn polynomial_spans_follow_the_series() {
    let mut p = everything();
    p.law = Law::Spans(Arc::new(Cam));
    let states = vec![ENGAGED, ENGAGED, PairState::Free, ENGAGED, PairState::Free];
    let exact = compare(&p, states, 0.09, 1e-5, 1e-7);
    assert!(exact.switches.len() > 10);
}

#[test]
fn more_combinations_of_pairs_than_are_kept_give_the_same_motion() {
    // Fourteen pairs of different rates on one stem: 2¹⁴ combinations; damped so
    // well that the motion is not chaotic.
    let mut masses = vec![TreeMass::new(5.0, None, 3e7, 3000.0)];
    for k in 0..14 {
        let f = 1.0 + 0.13 * k as f64;
        let mut mass = TreeMass::new(0.02 * f, Some(0), 2e4 / f, 14.0);
        mass.pair = FORCE;
        mass.loads.push(TimeLoad::Constant(-5.0));
        masses.push(mass);
    }
    let mut p = problem(
        masses,
        vec![sine(0.001, 600.0, 0.0), sine(0.0015, 371.0, 1.0)],
    );
    for k in 1..15 {
        p.displacement[k] = -4e-4;
    }
    let end = 0.45;
    let exact = run(&p, end);
    let mut now = exact.start.clone();
    let mut met = std::collections::BTreeSet::new();
    for s in &exact.switches {
        now[s.mass] = s.after;
        met.insert(now.iter().map(|s| s.engaged()).collect::<Vec<bool>>());
    }
    assert!(
        met.len() > 256,
        "{} combinations, {} switches",
        met.len(),
        exact.switches.len()
    );
    let mut series = Series::new(&p, exact.start.clone(), 1e-4);
    series.run(end);
    assert_eq!(exact.switches.len(), series.met.len());
    for (a, b) in exact.switches.iter().zip(&series.met) {
        assert!((a.time - b.time).abs() < 1e-8, "{a:?} {b:?}");
    }
}

#[test]
fn numbers_that_are_not_finite_are_refused() {
    for (displacement, load) in [
        (f64::NAN, 0.0),
        (f64::INFINITY, 0.0),
        (0.0, f64::NAN),
        (1e308, 1e308),
    ] {
        for pair in [TreePair::Bilateral, FORCE] {
            let mut mass = TreeMass::new(0.1, None, 1e5, 20.0);
            mass.pair = pair;
            mass.loads.push(TimeLoad::Constant(load));
            let mut p = problem(vec![mass], vec![sine(0.01, 50.0, 0.0)]);
            p.displacement[0] = displacement;
            let refused = ExactTree::new(p).run(&Request::new(1.0, 10));
            assert!(refused.is_err(), "{displacement} {load} {pair:?}");
        }
    }
    let p = problem(
        vec![TreeMass::new(0.1, None, f64::NAN, 0.0)],
        vec![sine(0.01, 50.0, 0.0)],
    );
    assert!(ExactTree::new(p).run(&Request::new(1.0, 10)).is_err());
}

#[test]
fn a_search_that_takes_too_many_steps_is_an_error() {
    let p = everything();
    let request = Request {
        steps: 2,
        ..Request::new(0.06, 0)
    };
    let refused = ExactTree::new(p).run(&request).expect_err("refused");
    assert!(refused.reason.contains("2 steps"), "{refused:?}");
}

#[test]
fn a_run_that_is_refused_stands_at_the_end_of_its_last_phase() {
    let tree = ExactTree::new(everything());
    let mut refused = 0;
    for steps in 1..=12 {
        let request = Request {
            steps,
            ..Request::new(0.06, 0)
        };
        let goes_on = || true;
        let mut cursor = Cursor::of(&tree, &request, &goes_on).expect("a start");
        let n = cursor.end_state().0.len();
        let (mut q, mut v) = (vec![0.0; n], vec![0.0; n]);
        loop {
            let (last, time) = (cursor.end_state(), cursor.time());
            let last = (last.0.to_vec(), last.1.to_vec());
            match cursor.next_phase() {
                Ok(true) => {}
                Ok(false) => break,
                Err(_) => {
                    refused += 1;
                    assert_eq!(cursor.time(), time);
                    cursor.state(cursor.local(time), &mut q, &mut v);
                    assert_eq!((&q, &v), (&last.0, &last.1), "{steps} steps");
                    break;
                }
            }
        }
    }
    assert!(refused > 2, "{refused}");
}

#[test]
fn once_the_transient_is_gone_a_cycle_costs_what_the_forced_motion_costs() {
    // Held in contact by its load: switches at most while the start dies away.
    let chain = |n: usize| {
        let masses = (0..n).map(|m| {
            let (a, b) = ((m + 1) as f64 / n as f64, m as f64 / n as f64);
            let (j, c) = (0.1 * (a.powi(3) - b.powi(3)), n as f64 * 1e7);
            TreeMass::new(
                j,
                m.checked_sub(1),
                c,
                0.4 * c / (std::f64::consts::TAU * 1e4),
            )
        });
        let mut p = problem(masses.collect(), vec![sine(1.57, 62.83, 0.0)]);
        p.masses[0].pair = FORCE;
        p.masses[n - 1].loads.push(TimeLoad::Constant(-1000.0));
        for m in 0..n {
            p.displacement[m] = -1e-4 * (m + 1) as f64 / n as f64;
        }
        p
    };
    let second = |n: usize| {
        let run = |end: f64| {
            ExactTree::new(chain(n))
                .run(&Request::new(end, 0))
                .expect("runs")
        };
        let (one, two) = (run(1.0), run(2.0));
        assert_eq!(
            one.switches.len(),
            two.switches.len(),
            "the second is undisturbed"
        );
        (
            one.evaluations,
            two.evaluations - one.evaluations,
            two.exponentials - one.exponentials,
        )
    };
    let (_, forced, _) = second(1);
    for n in [4, 10, 24] {
        let (start, after, exponentials) = second(n);
        assert!(
            after <= forced + 2 && forced <= 100,
            "{n}: {after} {forced}"
        );
        assert!(start > after, "{n}: {start} {after}");
        assert_eq!(
            exponentials,
            4 * after,
            "{n}: one vector holds what is left"
        );
    }
}

#[test]
fn figures_of_a_stiff_mechanism_cost_what_those_of_a_soft_one_cost() {
    // δ rises slowly for a quarter of a turn after a start that shakes every mode:
    // each instant sets a new record.
    let least = |stiffness: f64| {
        let mut masses = vec![
            TreeMass::new(0.05, None, stiffness, 0.0),
            TreeMass::new(0.05, Some(0), stiffness, 0.0),
        ];
        for mass in &mut masses {
            mass.damping = 0.3 * (stiffness * mass.inertia).sqrt();
        }
        masses[1].loads.push(TimeLoad::Constant(-600.0));
        let mut p = problem(masses, vec![sine(1.57, 6.3, 0.0)]);
        p.speed = vec![1e-3, -2e-3];
        let tree = ExactTree::new(p);
        let request = Request {
            figures: true,
            ..Request::new(0.25, 0)
        };
        let mut best = std::time::Duration::MAX;
        for _ in 0..30 {
            let begun = std::time::Instant::now();
            let run = tree.run(&request).expect("runs");
            best = best.min(begun.elapsed());
            assert!(run.figures[0].delta_max > -1200.0 / stiffness);
        }
        best.as_secs_f64()
    };
    let (soft, stiff) = (least(1e6), least(1e12));
    assert!(stiff < 10.0 * soft, "{stiff} for {soft}");
}
