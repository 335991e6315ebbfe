//! Exact propagation of cases A–E of the comparison with general solvers: from
//! the problem ready to 1000 samples of δ and all switch times, alone, with the
//! figures between samples, and with these and the energy audit; and of one contact phase.

use criterion::{Criterion, criterion_group, criterion_main};
use dam::exact::{
    ExactTree, Law, Request, Sine, TimeLoad, TreeMass, TreeObject, TreePair, TreeProblem,
};
use std::f64::consts::{FRAC_PI_2, PI, TAU};
use std::hint::black_box;

/// J = 0.1 kg·m², c = 10⁷ N·m/rad, ν = 10 Hz, b_m = ψ√(c_m J_m)/2π, on the law.
fn problem(n: usize, load: f64, psi: f64) -> TreeProblem {
    let mass = |m: usize| {
        let (a, b) = ((m + 1) as f64 / n as f64, m as f64 / n as f64);
        let inertia = 0.1 * (a.powi(3) - b.powi(3));
        let stiffness = n as f64 * 1e7;
        let damping = psi * (stiffness * inertia).sqrt() / TAU;
        TreeMass::new(inertia, m.checked_sub(1), stiffness, damping)
    };
    let mut masses: Vec<TreeMass> = (0..n).map(mass).collect();
    masses[0].pair = TreePair::Force { opens: 1.0 };
    masses[n - 1].loads.push(TimeLoad::Constant(-load));
    let sine = Sine {
        amplitude: FRAC_PI_2,
        frequency: 20.0 * PI,
        phase: 0.0,
    };
    TreeProblem {
        masses,
        law: Law::Harmonic {
            mean: 0.0,
            slope: 0.0,
            sines: vec![sine],
        },
        displacement: vec![0.0; n],
        speed: vec![0.0; n],
        objects: vec![TreeObject {
            first: 0,
            output: vec![(n - 1, 1.0)],
            driver: None,
        }],
    }
}

fn cases(criterion: &mut Criterion) {
    let mut group = criterion.benchmark_group("exact");
    for (name, n, load, psi, end) in [
        ("A", 1, 1000.0, 0.4, 1.0),
        ("B", 1, 600.0, 0.4, 1.0),
        ("C", 2, 600.0, 0.4, 1.0),
        ("D", 10, 1000.0, 0.4, 1.0),
        ("E", 1, 600.0, 0.0, 0.1),
    ] {
        let tree = ExactTree::new(problem(n, load, psi));
        for (suffix, figures, audit) in [
            ("", false, false),
            (" with figures", true, false),
            (" with figures and audit", true, true),
        ] {
            let request = Request {
                figures,
                audit,
                ..Request::new(end, 1000)
            };
            group.bench_function(format!("{name}{suffix}"), |bencher| {
                bencher.iter(|| black_box(tree.run(black_box(&request)).expect("runs")));
            });
        }
    }
    group.finish();
}

/// The first contact, from the load's onset until just before the pair opens:
/// the modes of the regime and a search through the whole transient that finds
/// nothing.
fn contact_phase(criterion: &mut Criterion) {
    let mut group = criterion.benchmark_group("contact phase");
    for (name, n, end) in [("one mass", 1, 0.0209), ("two masses", 2, 0.0185)] {
        let tree = ExactTree::new(problem(n, 600.0, 0.4));
        let request = Request::new(end, 0);
        let run = tree.run(&request).expect("runs");
        assert!(run.complete && run.switches.is_empty());
        group.bench_function(name, |bencher| {
            bencher.iter(|| black_box(tree.run(black_box(&request)).expect("runs")));
        });
    }
    group.finish();
}

criterion_group!(benches, cases, contact_phase);
criterion_main!(benches);
