//! Figures of δ alone, which envelopes settle for most of a run, against those
//! of a run that looks at everything, and against dense samples.

use crate::exact::tests::chain;
use crate::exact::{ExactRun, ExactTree, Request, RequestedFigures, TimeLoad, TreePair};

/// Samples of a run: a tenth of a radian of its fastest mode apart.
const SAMPLES: u32 = 200_000;

/// Two masses under 600 N m on ten cycles a second.
fn rocker(inertia: f64, stiffness: f64) -> ExactTree {
    let damping = |c: f64, j: f64| 0.4 * (c * j).sqrt() / std::f64::consts::TAU;
    let mut problem = chain(inertia, stiffness, 2, 10.0, damping);
    problem.masses[0].pair = TreePair::Force { opens: 1.0 };
    problem.masses[1].loads.push(TimeLoad::Constant(-600.0));
    ExactTree::new(problem)
}

fn run(tree: &ExactTree, asked: RequestedFigures, samples: usize) -> ExactRun {
    let request = Request {
        figures: true,
        asked,
        ..Request::new(0.35, samples)
    };
    tree.run(&request).expect("runs")
}

#[test]
fn figures_do_not_depend_on_what_else_is_asked() {
    let (mut thrown, mut open) = (0, 0);
    for k in 0..30 {
        let (i, j) = (f64::from(k % 6), f64::from(k / 6));
        let tree = rocker(0.05 + 0.15 * i, 0.25e7 + 1.1e7 * j);
        let alone = run(&tree, RequestedFigures::DEVIATION, SAMPLES as usize);
        let all = run(&tree, RequestedFigures::ALL, 0);
        let (own, other) = (alone.figures[0], all.figures[0]);
        let size = other.delta_max.abs().max(other.delta_min.abs());
        assert!((own.delta_max - other.delta_max).abs() <= 1e-13 * size);
        assert!((own.delta_min - other.delta_min).abs() <= 1e-13 * size);
        let extreme = |f: fn(f64, f64) -> f64| alone.samples.iter().copied().fold(0.0, f);
        let (most, least) = (extreme(f64::max), extreme(f64::min));
        for (figure, sampled) in [(own.delta_max, most), (-own.delta_min, -least)] {
            let over = (figure - sampled) / size;
            assert!((-1e-13..1e-3).contains(&over), "cell {k}: {over:e}");
        }
        // The mean, which asks for every change of sign, by the trapezium rule.
        let mean = alone.samples.iter().map(|x| x.abs()).sum::<f64>() / f64::from(SAMPLES);
        let off = (all.figures[0].sigma - mean).abs() / size;
        assert!(off < 1e-4, "cell {k}: {off:e}");
        thrown += usize::from(size > 0.5);
        open += usize::from(all.switches.len() > 20);
    }
    // The grid holds cells of every kind.
    assert!((5..30).contains(&thrown) && open > 0, "{thrown} {open}");
}
