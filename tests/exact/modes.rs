//! Modes that coincide, nearly coincide or do not decay, in exact propagation,
//! against Taylor series of the equations of motion.

use crate::support::{Series, motion_error, problem, rows, sine};
use dam::exact::{ExactTree, PairState, Request, TimeLoad, TreeMass, TreePair, TreeProblem};
use nalgebra::DMatrix;

/// Error of the motion over `end`, all pairs bilateral.
fn error(problem: TreeProblem, end: f64, step: f64) -> f64 {
    let n = problem.masses.len();
    let mut series = Series::new(&problem, vec![PairState::Free; n], step);
    let expected = rows(&mut series, end, 60);
    let request = Request {
        all_masses: true,
        ..Request::new(end, 60)
    };
    let run = ExactTree::new(problem.clone()).run(&request).expect("runs");
    motion_error(&run, &expected)
}

fn shaken(masses: Vec<TreeMass>) -> TreeProblem {
    let n = masses.len();
    let mut out = problem(masses, vec![sine(0.5, 300.0, 0.3)]);
    out.masses[n - 1].loads.push(TimeLoad::Constant(-50.0));
    for i in 0..n {
        out.displacement[i] = 1e-3 * (1.0 + i as f64);
        out.speed[i] = 2.0 - i as f64;
    }
    out
}

/// Offsets from the critical damping, relative: on both sides and through it.
const OFFSETS: [f64; 17] = [
    0.0, 1e-16, 1e-14, 1e-12, 1e-10, 1e-8, 1e-7, 1e-6, 1e-5, 1e-4, 1e-3, -1e-14, -1e-11, -1e-8,
    -1e-6, -1e-4, -1e-2,
];

#[test]
fn one_mass_is_exact_through_critical_damping() {
    let (j, c) = (0.1f64, 1e5f64);
    for offset in OFFSETS {
        let b = 2.0 * (j * c).sqrt() * (1.0 + offset);
        let e = error(shaken(vec![TreeMass::new(j, None, c, b)]), 0.05, 1e-4);
        assert!(e < 1e-12, "{offset:e}: {e:e}");
    }
}

/// Number of eigenvalues off the real axis, from the dense companion matrix.
fn oscillating(masses: &[TreeMass]) -> usize {
    let n = masses.len();
    let (mut k, mut b) = (DMatrix::<f64>::zeros(n, n), DMatrix::<f64>::zeros(n, n));
    for (i, m) in masses.iter().enumerate() {
        for (a, f) in [(&mut k, m.stiffness), (&mut b, m.damping)] {
            a[(i, i)] += f;
            if let Some(p) = m.parent {
                a[(p, p)] += f * m.lever * m.lever;
                a[(i, p)] -= f * m.lever;
                a[(p, i)] -= f * m.lever;
            }
        }
    }
    let mut a = DMatrix::<f64>::zeros(2 * n, 2 * n);
    for i in 0..n {
        a[(i, n + i)] = 1e3;
        for l in 0..n {
            a[(n + i, l)] = -k[(i, l)] / masses[i].inertia / 1e3;
            a[(n + i, n + l)] = -b[(i, l)] / masses[i].inertia;
        }
    }
    let values = a.complex_eigenvalues();
    values
        .iter()
        .filter(|l| l.im.abs() > 1e-14 * l.norm())
        .count()
}

#[test]
fn a_chain_is_exact_where_one_of_its_pairs_becomes_real() {
    // Damping in the last link alone, so that no modes are proportional.
    let chain = |b: f64| -> Vec<TreeMass> {
        (0..4usize)
            .map(|i| {
                let own = if i == 3 { b } else { 3.0 };
                TreeMass::new(0.05 + 0.02 * i as f64, i.checked_sub(1), 1e5, own)
            })
            .collect()
    };
    let (mut low, mut high) = (3.0, 1e4);
    let all = oscillating(&chain(low));
    assert!(all == 8 && oscillating(&chain(high)) < all);
    for _ in 0..60 {
        let middle = 0.5 * (low + high);
        if oscillating(&chain(middle)) == all {
            low = middle
        } else {
            high = middle
        }
    }
    for offset in OFFSETS {
        let e = error(shaken(chain(low * (1.0 + offset))), 0.05, 1e-4);
        assert!(e < 5e-12, "{offset:e}: {e:e}");
    }
}

/// A stem with `count` equal branches of two masses.
fn branches(count: usize, stiffness_damping: impl Fn(f64) -> f64) -> Vec<TreeMass> {
    let b = &stiffness_damping;
    let mut masses = vec![TreeMass::new(0.2, None, 2e5, b(2e5))];
    for k in 0..count {
        masses.push(TreeMass::new(0.05, Some(0), 1e5, b(1e5)));
        masses.push(TreeMass::new(0.03, Some(2 * k + 1), 1.5e5, b(1.5e5)));
    }
    masses
}

#[test]
fn equal_branches_keep_their_independent_modes() {
    for count in [2, 3, 4] {
        for share in [0.0, 1e-7, 1e-5, 1e-4, 4e-4, 1.2e-3, 5e-3] {
            let mut p = shaken(branches(count, |c| share * c));
            p.speed[3] = -7.0;
            let e = error(p, 0.1, 1e-4);
            assert!(e < 5e-12, "{count} branches, b = {share:e} c: {e:e}");
        }
    }
}

#[test]
fn nearly_equal_branches_are_as_exact_as_equal_ones() {
    for difference in [1e-15, 1e-13, 1e-11, 1e-9, 1e-7, 1e-5, 1e-3] {
        for share in [0.0, 1e-5, 4e-4] {
            let mut masses = branches(3, |c| share * c);
            masses[3].inertia *= 1.0 + difference;
            masses[6].stiffness *= 1.0 - 0.7 * difference;
            let e = error(shaken(masses), 0.1, 1e-4);
            assert!(e < 5e-12, "{difference:e}, b = {share:e} c: {e:e}");
        }
    }
}

#[test]
fn critically_damped_equal_branches_are_exact() {
    // Each branch alone is critical: modes coincide four at a time.
    let (j, c) = (0.05f64, 1e5f64);
    let b = 2.0 * (j * c).sqrt();
    for offset in [0.0, 1e-12, 1e-7, -1e-9, 1e-4] {
        let mut masses = vec![TreeMass::new(0.2, None, 2e5, 30.0)];
        for _ in 0..3 {
            masses.push(TreeMass::new(j, Some(0), c, b * (1.0 + offset)));
        }
        let e = error(shaken(masses), 0.05, 1e-4);
        assert!(e < 5e-12, "{offset:e}: {e:e}");
    }
}

#[test]
fn several_parts_float_at_once() {
    // Three branches thrown off their stem together: each floats by itself,
    // one of them dragged through a viscous medium, one with two masses.
    let mut masses = branches(3, |c| 1e-4 * c);
    for k in 0..3 {
        masses[2 * k + 1].pair = TreePair::Force { opens: 1.0 };
    }
    masses[4].ground_damping = 3.0;
    let mut p = problem(masses, vec![sine(0.02, 120.0, 0.3)]);
    for i in 1..7 {
        p.displacement[i] = 1e-3;
        p.speed[i] = 4.0;
    }
    let end = 0.01;
    let mut series = Series::new(&p, vec![PairState::Free; 7], 1e-5);
    let expected = rows(&mut series, end, 40);
    assert!(series.met.is_empty());
    let request = Request {
        all_masses: true,
        ..Request::new(end, 40)
    };
    let run = ExactTree::new(p.clone()).run(&request).expect("runs");
    assert!(run.switches.is_empty());
    let e = motion_error(&run, &expected);
    assert!(e < 1e-12, "{e:e}");
}

#[test]
fn a_part_that_floats_may_be_dragged_ever_so_lightly() {
    // Open, two masses fall against a damper to the ground: a mode 0 beside one
    // that decays with b/ΣJ, which is next to nothing.
    for drag in [1e-6, 1e-3, 0.1, 3.0, 100.0] {
        let mut head = TreeMass::new(1.0, None, 4e4, 0.0);
        head.pair = TreePair::Force { opens: 1.0 };
        let mut tail = TreeMass::new(0.5, Some(0), 5e3, 2.0);
        tail.ground_damping = drag;
        tail.loads.push(TimeLoad::Constant(-20.0));
        let mut problem = problem(vec![head, tail], vec![sine(0.01, 30.0, 0.0)]);
        problem.displacement = vec![0.01, 0.0101];
        problem.speed = vec![1.0, 1.1];
        let mut series = Series::new(&problem, vec![PairState::Free; 2], 1.0 / 4096.0);
        let expected = rows(&mut series, 0.3, 60);
        let request = Request {
            all_masses: true,
            audit: true,
            ..Request::new(0.3, 60)
        };
        let run = ExactTree::new(problem.clone()).run(&request).expect("runs");
        assert_eq!(run.switches.len(), series.met.len(), "drag {drag:e}");
        let (error, audit) = (motion_error(&run, &expected), run.audit.expect("audit"));
        // What is left of cancelling: the time over which the drag tells.
        let bound = 1e-12 + 1e-13 / drag;
        assert!(error < bound, "drag {drag:e}: {error:e}");
        assert!(audit.error() < bound, "drag {drag:e}: {:e}", audit.error());
    }
}

#[test]
fn chains_too_long_for_their_modes_are_refused_in_time() {
    let chain = |count: usize, share: f64| -> TreeProblem {
        let stiffness = count as f64 * 1e7;
        let inertia = 0.1 / count as f64;
        let masses = (0..count)
            .map(|i| TreeMass::new(inertia, i.checked_sub(1), stiffness, share * stiffness));
        shaken(masses.collect())
    };
    let begun = std::time::Instant::now();
    // Overdamped modes gather at stiffness over damping.
    let refused = ExactTree::new(chain(120, 1e-5))
        .check()
        .expect_err("gather");
    assert!(
        refused.reason.contains("run into each other"),
        "{refused:?}"
    );
    let refused = ExactTree::new(chain(201, 0.0))
        .check()
        .expect_err("too many");
    assert!(refused.reason.contains("201 masses"), "{refused:?}");
    assert!(begun.elapsed() < std::time::Duration::from_secs(100));
    assert!(ExactTree::new(chain(40, 1e-8)).check().is_ok());
}
