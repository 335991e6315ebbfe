//! What a point of a prepared scene costs beside a cell of `dam map`: the two-mass rocker over
//! inertia and stiffness, 20 by 20 points, by turns in one process. Least times of several
//! rounds, as a table in Markdown: `cargo bench --package dam-benches --bench prepared`.

// It prints, as a program does.
#![allow(clippy::print_stdout)]

use dam::prelude::*;
use dam::studies::Control;
use dam::studies::map::{Silent, map};
use std::collections::BTreeMap;
use std::hint::black_box;
use std::path::Path;
use std::time::Instant;

/// The allocator of the program.
#[global_allocator]
static ALLOCATOR: mimalloc::MiMalloc = mimalloc::MiMalloc;

const ROUNDS: usize = 15;
const COUNT: usize = 20;
const PARAMETERS: [&str; 2] = ["rocker.inertia", "rocker.stiffness"];
const FIGURES: [&str; 3] = [
    "rocker.delta_max",
    "rocker.pair.separations",
    "rocker.sigma",
];

fn scene() -> Scene {
    let scenarios = Path::new(env!("CARGO_MANIFEST_DIR")).join("../scenarios");
    let scene = Scene::read(scenarios.join("rocker/two_masses.json")).expect("a scene");
    scene.set("run.duration", 1.0).set("run.start", "on_law")
}

/// Least time of a call (s), kept in `least`.
fn time(least: &mut f64, call: impl FnOnce()) {
    let begun = Instant::now();
    call();
    *least = least.min(begun.elapsed().as_secs_f64());
}

fn main() {
    let scene = scene();
    let axes = [
        Axis::linear(PARAMETERS[0], 0.05, 1.0, COUNT),
        Axis::linear(PARAMETERS[1], 0.25e7, 5e7, COUNT),
    ];
    let values = axes.each_ref().map(Axis::values);
    let rows: Vec<[f64; 2]> = (values[1].iter())
        .flat_map(|&stiffness| values[0].iter().map(move |&inertia| [inertia, stiffness]))
        .collect();
    let [x, y] = axes;
    let question = scene.map(x).up(y).figure_at(FIGURES[0]).unchecked();
    let prepare = |figures: &[&str]| scene.prepare_points(&PARAMETERS, figures).expect("figures");
    let (one, three) = (prepare(&FIGURES[..1]), prepare(&FIGURES));
    let (control, heard) = (Control::default(), |_: usize| {});
    let mut least = [f64::INFINITY; 5];
    let told = question.studied(|study| {
        for _ in 0..ROUNDS {
            let cells = || map(study, BTreeMap::new(), Some(1), &control, &Silent);
            time(&mut least[0], || drop(black_box(cells())));
            let table = || one.table_within(&rows, Some(1), &control, &heard);
            time(&mut least[1], || drop(black_box(table())));
            time(&mut least[2], || {
                for row in &rows {
                    drop(black_box(one.at(row)));
                }
            });
            let table = || three.table_within(&rows, Some(1), &control, &heard);
            time(&mut least[3], || drop(black_box(table())));
            time(&mut least[4], || {
                for row in rows.iter().take(COUNT) {
                    let set = PARAMETERS.iter().zip(row);
                    let scene = set.fold(scene.clone(), |scene, (path, &value)| {
                        scene.set(path, value)
                    });
                    drop(black_box(scene.run()));
                }
            });
        }
        Ok(())
    });
    told.expect("a map");
    let count = rows.len() as f64;
    let costs = [
        ("a cell of a map", least[0] / count),
        ("a point of a table", least[1] / count),
        ("a point by itself", least[2] / count),
        ("a point of three figures", least[3] / count),
        (
            "a run of the scene with its values set",
            least[4] / COUNT as f64,
        ),
    ];
    println!("| one thread | µs | in cells |");
    println!("| --- | --- | --- |");
    for (name, cost) in costs {
        println!("| {name} | {:.1} | {:.2} |", cost * 1e6, cost / costs[0].1);
    }
}
