//! The map of δ_max over inertia and stiffness of the two-mass rocker, 20 by 20
//! cells, as `dam map` works it out: every cell read, lowered, run and judged.

use criterion::{Criterion, criterion_group, criterion_main};
use dam::scene::{BuiltIn, Document};
use dam::studies::Control;
use dam::studies::axis::Axis;
use dam::studies::map::{Panels, Question, Silent, Study, map};
use std::collections::BTreeMap;
use std::hint::black_box;
use std::time::Duration;

/// The allocator of the program.
#[global_allocator]
static ALLOCATOR: mimalloc::MiMalloc = mimalloc::MiMalloc;

fn question() -> Question {
    let axis = |text: &str| Axis::parse(text).expect("an axis");
    let settings = ["run.duration=1", "run.start=\"on_law\""];
    Question {
        overrides: settings.map(str::to_owned).to_vec(),
        x: axis("rocker.inertia=0.05:1:20"),
        y: Some(axis("rocker.stiffness=0.25e7:5e7:20")),
        panels: Panels::default(),
        figure: Some("rocker.delta_max".to_owned()),
        check_determined: false,
        digits: 7,
    }
}

fn maps(criterion: &mut Criterion) {
    let text = include_bytes!("../scenarios/rocker/two_masses.json");
    let document = Document::parse("two_masses.json", text).expect("a scene");
    let study = Study::new(&document, &BuiltIn, question()).expect("a study");
    let mut group = criterion.benchmark_group("map of 20 by 20 cells");
    group
        .sample_size(10)
        .measurement_time(Duration::from_secs(3));
    for threads in [1, 2] {
        group.bench_function(format!("{threads} threads"), |bencher| {
            bencher.iter(|| {
                let control = Control::default();
                let known = BTreeMap::new();
                black_box(map(&study, known, Some(threads), &control, &Silent)).expect("a map")
            });
        });
    }
    group.finish();
}

criterion_group!(benches, maps);
criterion_main!(benches);
