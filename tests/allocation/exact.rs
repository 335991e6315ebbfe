//! An exact run allocates when it is set up and when it meets a combination of
//! pairs for the first time, not at every switch.

use crate::counting::allocations;
use dam::exact::{
    ExactTree, ForcePiece, ForceSource, LAW_DEGREE, Law, Request, Sine, TimeLoad, TreeMass,
    TreeObject, TreePair, TreeProblem,
};
use std::f64::consts::{FRAC_PI_2, PI, TAU};
use std::sync::Arc;
use std::sync::atomic::{AtomicUsize, Ordering::Relaxed};

/// Two masses that are thrown off once a cycle.
fn problem() -> TreeProblem {
    let mass = |m: usize| {
        let inertia = [0.0125, 0.0875][m];
        let damping = 0.4 * (2e7f64 * inertia).sqrt() / TAU;
        TreeMass::new(inertia, m.checked_sub(1), 2e7, damping)
    };
    let mut masses = vec![mass(0), mass(1)];
    masses[0].pair = TreePair::Force { opens: 1.0 };
    masses[1].loads.push(TimeLoad::Constant(-600.0));
    let sines = vec![Sine {
        amplitude: FRAC_PI_2,
        frequency: 20.0 * PI,
        phase: 0.0,
    }];
    let (mean, slope) = (0.0, 0.0);
    TreeProblem {
        masses,
        law: Law::Harmonic { mean, slope, sines },
        displacement: vec![0.0; 2],
        speed: vec![0.0; 2],
        objects: vec![TreeObject {
            first: 0,
            output: vec![(1, 1.0)],
            driver: None,
        }],
    }
}

#[test]
fn switches_allocate_nothing() {
    let tree = ExactTree::new(problem());
    let count = |end: f64| {
        let request = Request {
            figures: true,
            audit: true,
            ..Request::new(end, 0)
        };
        let before = allocations();
        let run = tree.run(&request).expect("runs");
        let after = allocations();
        (after - before, run.switches.len())
    };
    let ((short, few), (long, many)) = (count(0.2), count(2.0));
    assert!(few > 50 && many > 8 * few, "{few} {many}");
    // The list of switches, which is handed out, doubles its room twice.
    assert!(long - short <= 2, "{short} {long}");
    assert!(short > 10, "the counter counts: {short}");
}

/// A load in pieces of 20 ms, which counts how often one is made.
#[derive(Debug, Default)]
struct Pieces(AtomicUsize);

impl ForceSource for Pieces {
    fn piece(&self, time: f64) -> ForcePiece {
        self.0.fetch_add(1, Relaxed);
        let start = 0.02 * (time / 0.02 + 1e-9).floor();
        let mut coefficients = [0.0; LAW_DEGREE + 1];
        coefficients[..2].copy_from_slice(&[-3.0, 100.0]);
        ForcePiece {
            start,
            end: start + 0.02,
            coefficients,
        }
    }
}

#[test]
fn a_piece_of_a_load_is_made_once_and_not_at_every_switch() {
    let source = Arc::new(Pieces::default());
    let mut problem = problem();
    let load = TimeLoad::Pieces(Arc::clone(&source) as Arc<dyn ForceSource>);
    problem.masses[1].loads.push(load);
    let tree = ExactTree::new(problem);
    let run = |end: f64| {
        let request = Request {
            figures: true,
            audit: true,
            ..Request::new(end, 0)
        };
        let before = source.0.load(Relaxed);
        let run = tree.run(&request).expect("runs");
        (source.0.load(Relaxed) - before, run.switches.len())
    };
    let ((short, few), (long, many)) = (run(0.2), run(2.0));
    assert!(many > few + 50, "{few} {many}");
    // Ninety pieces more; one at the ends may be begun twice by rounding.
    assert!((88..=92).contains(&(long - short)), "{short} {long}");
}
