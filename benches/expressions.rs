//! What a load by an expression costs beside the same load of a built-in kind: the
//! right-hand side, and a whole run.
//!
//! `cargo bench -p dam-benches --bench expressions`; the ratios are printed first.

#![allow(clippy::print_stdout)] // the ratios are what it is run for

use criterion::{Criterion, criterion_group, criterion_main};
use dam::integrate::Dynamics;
use dam::prelude::*;
use dam::system::System;
use std::hint::black_box;
use std::time::Instant;

/// Loads of the library, and the same as expressions that none of its kinds is made of.
const ALIKE: [(&str, &str, &str); 5] = [
    (
        "friction",
        r#"{ "friction": { "force": 4, "width": 0.7 } }"#,
        r#"{ "expression": "-4*tanh(phi_dot/0.7)" }"#,
    ),
    (
        "spring",
        r#"{ "spring": { "rate": 40, "preload": 3 } }"#,
        r#"{ "expression": "-3 - 40*phi" }"#,
    ),
    (
        "viscous",
        r#"{ "viscous": 0.6 }"#,
        r#"{ "expression": "-0.6*phi_dot" }"#,
    ),
    (
        "time table",
        r#"{ "time_table": [[0, 0], [0.1, 6], [0.25, -4]] }"#,
        r#"{ "expression": "t < 0.1 ? 60*t : t < 0.25 ? 6 - (t - 0.1)*200/3 : -4" }"#,
    ),
    (
        "window",
        r#"{ "window": { "from": 0.5, "to": 1.5, "force": 9 } }"#,
        r#"{ "expression": "driver_phi % (2*pi) > 0.5 && driver_phi % (2*pi) < 1.5 ? 9 : 0" }"#,
    ),
];

/// A lever of two masses on a motor.
fn scene(load: &str) -> Scene {
    let text = format!(
        r#"{{ "dam": 1, "name": "lever", "objects": {{
            "motor": {{ "kind": "drive", "motor": {{ "inertia": 0.5, "speed": 30, "torque": {{ "constant": 5 }} }} }},
            "lever": {{ "kind": "rocker", "input": "motor", "position": {{ "sine": {{ "amplitude": 0.4 }} }},
                "inertia": 0.02, "stiffness": 4000, "damping_capacity": 0.2, "masses": 2,
                "loads": {{ "own": {load} }} }} }},
            "run": {{ "duration": 2, "tolerance": 1e-8, "method": "dop853" }} }}"#
    );
    Scene::from_json(&text).expect("a scene")
}

fn system(load: &str) -> System {
    let mechanism = scene(load).prepare().expect("a mechanism");
    System::new(mechanism.model().clone()).expect("a system")
}

/// Nanoseconds of one evaluation: the least of several trials.
fn evaluation(system: &System) -> f64 {
    let start = system.initial_state().expect("a start");
    let (mut scratch, mut dy) = (system.scratch(), vec![0.0; start.y.len()]);
    let mut least = f64::INFINITY;
    for _ in 0..20 {
        let begun = Instant::now();
        for k in 0..20_000 {
            let time = 1e-6 * f64::from(k);
            system.derivatives(
                time,
                black_box(&start.y),
                &start.modes,
                &mut scratch,
                &mut dy,
            );
            black_box(&dy);
        }
        least = least.min(begun.elapsed().as_secs_f64() / 20_000.0);
    }
    1e9 * least
}

/// Milliseconds of a run: the least of several.
fn whole(load: &str) -> f64 {
    let scene = scene(load);
    let mut least = f64::INFINITY;
    for _ in 0..5 {
        let begun = Instant::now();
        black_box(scene.run().expect("a run"));
        least = least.min(begun.elapsed().as_secs_f64());
    }
    1e3 * least
}

fn expressions(criterion: &mut Criterion) {
    for (name, built_in, written) in ALIKE {
        let [a, b] = [built_in, written].map(|load| evaluation(&system(load)));
        let [c, d] = [built_in, written].map(whole);
        println!(
            "{name}: right-hand side {a:.0} ns built in, {b:.0} ns by expression, ratio {:.2}; \
             run {c:.2} ms and {d:.2} ms, ratio {:.2}",
            b / a,
            d / c
        );
    }
    let mut group = criterion.benchmark_group("expressions");
    for (name, built_in, written) in ALIKE {
        for (kind, load) in [("built in", built_in), ("expression", written)] {
            let system = system(load);
            let start = system.initial_state().expect("a start");
            let (mut scratch, mut dy) = (system.scratch(), vec![0.0; start.y.len()]);
            group.bench_function(format!("{name}, {kind}"), |bencher| {
                bencher.iter(|| {
                    system.derivatives(
                        black_box(0.01),
                        black_box(&start.y),
                        &start.modes,
                        &mut scratch,
                        &mut dy,
                    );
                });
            });
        }
    }
    group.finish();
}

criterion_group!(benches, expressions);
criterion_main!(benches);
