//! What a whole run costs beside its motion: from the system ready to all figures, the
//! energy audit and 1000 samples of all columns.
//!
//! Of scenes that are propagated exactly beside [`ExactTree::run`] with figures and
//! audit, which knows nothing of the other objects and takes no samples; of integrated
//! scenes beside the integration alone. The ratios are those of one process.

use criterion::{BenchmarkId, Criterion, criterion_group, criterion_main};
use dam::exact::{Parts, Request};
use dam::integrate::{Limits, Modes, Settings, Sink, SwitchEvent, integrate};
use dam::lower::lower;
use dam::polynomial::Step;
use dam::scene::{BuiltIn, Document, Overrides};
use dam::studies::run::run;
use dam::studies::{Control, RunSettings};
use dam::system::System;
use std::hint::black_box;
use std::path::Path;
use std::time::Duration;

/// The allocator of the program.
#[global_allocator]
static ALLOCATOR: mimalloc::MiMalloc = mimalloc::MiMalloc;

fn scene(path: &str, overrides: &[&str]) -> (System, RunSettings) {
    let path = Path::new(env!("CARGO_MANIFEST_DIR"))
        .join("../scenarios")
        .join(path);
    let text = std::fs::read(&path).expect("a scenario");
    let document = Document::parse("scene.json", &text).expect("a document");
    let overrides = Overrides::new(overrides.iter().copied());
    let reading = document.scene(&BuiltIn, &overrides).expect("a scene");
    let settings = RunSettings::of(&reading.scene).expect("settings");
    let model = lower(&reading.scene).expect("a model");
    (System::new(model).expect("a system"), settings)
}

fn recorded((system, settings): &(System, RunSettings)) {
    let result = run(system, settings, &Control::default(), &mut []).expect("a start");
    assert!(black_box(result).is_trusted());
}

fn exact(criterion: &mut Criterion) {
    let mut group = criterion.benchmark_group("exact");
    group.measurement_time(Duration::from_secs(2));
    let cases: [(&str, &[&str]); 5] = [
        ("1 mass", &["rocker.masses=1"]),
        ("2 masses", &[]),
        ("2 masses, 16 s", &["run.duration=16"]),
        ("10 masses", &["rocker.masses=10"]),
        ("64 masses", &["rocker.masses=64"]),
    ];
    for (name, overrides) in cases {
        let scene = scene("rocker/two_masses.json", overrides);
        let parts = Parts::of(&scene.0);
        let start = scene.0.initial_state().expect("a start");
        let tree = parts.trees[0].tree(&start.y);
        let request = Request {
            figures: true,
            audit: true,
            ..Request::new(scene.1.duration, 0)
        };
        group.bench_function(BenchmarkId::new("tree", name), |bencher| {
            bencher.iter(|| black_box(tree.run(black_box(&request)).expect("runs")));
        });
        group.bench_function(BenchmarkId::new("run", name), |bencher| {
            bencher.iter(|| recorded(&scene));
        });
    }
    group.finish();
}

/// Hears nothing.
struct Nobody;

impl Sink for Nobody {
    fn start(&mut self, _time: f64, _y: &[f64], _modes: &Modes) {}

    fn step(&mut self, _step: &Step<'_>, _modes: &Modes) {}

    fn switch(&mut self, _event: &SwitchEvent<'_>) {}

    fn reads_within_steps(&self, _until: f64) -> bool {
        false
    }
}

fn integrated(criterion: &mut Criterion) {
    let mut group = criterion.benchmark_group("integrated");
    group.measurement_time(Duration::from_secs(3));
    group.sample_size(20);
    for (path, tolerance) in [
        ("press/ejector.json", 1e-4),
        ("press/ejector.json", 1e-9),
        ("press/run_up.json", 1e-6),
        ("packaging/pusher.json", 1e-6),
        ("fan_out/sewing_machine.json", 1e-6),
        ("linkages/one_window.json", 1e-6),
    ] {
        let (system, settings) = scene(path, &[]);
        let settings = RunSettings {
            tolerance,
            ..settings
        };
        let chosen = run(&system, &settings, &Control::default(), &mut []).expect("a start");
        let plan = Settings {
            method: chosen.method,
            tolerance: chosen.tolerance,
            step: settings.step,
        };
        let limits = Limits {
            switches: settings.max_switches,
            steps: settings.max_steps,
            budget: dam::budget::Budget::FREE,
        };
        let name = format!("{path} at {tolerance:e} by {}", chosen.method);
        group.bench_function(BenchmarkId::new("integration", &name), |bencher| {
            bencher.iter(|| {
                let start = system.initial_state().expect("a start");
                let end = settings.duration;
                let (y, modes) = (&start.y, &start.modes);
                black_box(integrate(
                    &system,
                    0.0,
                    end,
                    y,
                    modes,
                    &plan,
                    &limits,
                    &mut Nobody,
                ))
            });
        });
        let scene = (system, settings);
        group.bench_function(BenchmarkId::new("run", &name), |bencher| {
            bencher.iter(|| recorded(&scene));
        });
    }
    group.finish();
}

criterion_group!(benches, exact, integrated);
criterion_main!(benches);
