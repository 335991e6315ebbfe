//! Andrews' squeezing mechanism: the scene of the scenarios, reduced to its one
//! degree of freedom, against the full equations in seven coordinates with six
//! multipliers (index 1), both integrated by Dop853 at the tolerance at which the
//! positions at t = 0.03 s are good to 1e-6.
//!
//! The full equations are those of the Test Set for Initial Value Problem
//! Solvers (F. Mazzia, C. Magherini, 2008), problem "andrews". Their system of
//! thirteen unknowns is solved twice, both times without allocation: by Gauss's
//! elimination with pivots, as for any mechanism, and by hand: the mass matrix is
//! made of blocks of two, and the equation of the multipliers, six by six, is
//! solved by Cholesky's method.

#![allow(clippy::print_stdout)] // a bench tells its figures

mod full;

use dam::integrate::{
    Dynamics, Limits, Method, Modes, Settings, Sink, Stop, SwitchEvent, integrate,
};
use dam::lower::lower;
use dam::model::Model;
use dam::polynomial::Step;
use dam::scene::{BuiltIn, Document, Overrides, Reading};
use dam::system::System;
use full::{Full, START};
use ode_solvers::SVector;
use ode_solvers::dop853::Dop853;
use std::hint::black_box;
use std::time::Instant;

const SCENE: &str = include_str!("../../scenarios/linkages/andrews.json");
const END: f64 = 0.03;

/// β, Θ, γ, Φ, δ, Ω, ε at t = 0.03 s, from the test set.
const POSITIONS: [f64; 7] = [
    15.81077119629904,
    -15.75637105984298,
    0.04082224013073101,
    -0.5347301163226948,
    0.5244099658805304,
    0.5347301163226948,
    1.048080741042263,
];
/// The outputs of the scene in the order of their names.
const ORDER: [usize; 7] = [0, 4, 6, 2, 5, 3, 1];

/// Greatest error of the positions and the number of steps.
type Result = (f64, u64);

fn full(how: Full, tolerance: f64) -> Result {
    let start = SVector::<f64, 14>::from_fn(|i, _| if i < 7 { START[i] } else { 0.0 });
    let mut solver = Dop853::from_param(
        how,
        0.0,
        END,
        END,
        start,
        tolerance,
        tolerance,
        0.9,
        0.0,
        0.333,
        6.0,
        END,
        0.0,
        u32::MAX,
        u32::MAX,
        ode_solvers::OutputType::Sparse,
    );
    let counts = match solver.integrate() {
        Ok(counts) => counts,
        Err(_) => return (f64::INFINITY, 0),
    };
    let end = solver.y_out().last().expect("an end");
    let errors = (0..7).map(|i| (end[i] - POSITIONS[i]).abs());
    (errors.fold(0.0, f64::max), u64::from(counts.accepted_steps))
}

/// Keeps the state at the end of the last step, and looks at nothing else, as
/// the other solver does.
struct Last(Vec<f64>);

impl Sink for Last {
    fn start(&mut self, _: f64, y: &[f64], _: &Modes) {
        self.0.copy_from_slice(y);
    }

    fn step(&mut self, step: &Step<'_>, _: &Modes) {
        step.state(step.end, &mut self.0);
    }

    fn switch(&mut self, _: &SwitchEvent<'_>) {}

    fn reads_within_steps(&self, _: f64) -> bool {
        false
    }
}

struct Reduced {
    system: System,
    start: Vec<f64>,
    modes: Modes,
}

/// The scene, read.
fn read() -> Reading {
    let document = Document::parse("andrews.json", SCENE.as_bytes()).expect("JSON");
    document
        .scene(&BuiltIn, &Overrides::none())
        .expect("a scene")
}

/// Its model, the structure of the linkage found.
fn model(reading: &Reading) -> Model {
    lower(&reading.scene).expect("a model")
}

impl Reduced {
    fn new() -> Self {
        let system = System::new(model(&read())).expect("a system");
        let start = system.initial_state().expect("a start");
        Self {
            system,
            start: start.y,
            modes: start.modes,
        }
    }

    fn solve(&self, tolerance: f64) -> (Vec<f64>, u64) {
        let settings = Settings {
            method: Method::Dop853,
            tolerance,
            step: None,
        };
        let limits = Limits {
            switches: 1,
            steps: 1_000_000,
            budget: dam::budget::Budget::FREE,
        };
        let (system, mut last) = (&self.system, Last(vec![0.0; self.start.len()]));
        let outcome = integrate(
            system,
            0.0,
            END,
            &self.start,
            &self.modes,
            &settings,
            &limits,
            &mut last,
        );
        assert_eq!(outcome.stop, Stop::Complete);
        (last.0, outcome.statistics.steps)
    }

    fn error(&self, tolerance: f64) -> Result {
        let (y, steps) = self.solve(tolerance);
        let mut scratch = self.system.scratch();
        let mut states = vec![Default::default(); self.system.model().objects.len()];
        self.system
            .observe(END, &y, &self.modes, &mut scratch, &mut states);
        let objects = self.system.model().objects.iter();
        let outputs = objects
            .zip(&states)
            .filter(|(part, _)| part.kind == dam::model::OUTPUT);
        let errors = outputs
            .enumerate()
            .map(|(index, (_, state))| (state.displacement - POSITIONS[ORDER[index]]).abs());
        (errors.fold(0.0, f64::max), steps)
    }
}

/// The least time of many repetitions (s).
fn least(repetitions: usize, mut work: impl FnMut()) -> f64 {
    let mut best = f64::INFINITY;
    for _ in 0..repetitions {
        let start = Instant::now();
        work();
        best = best.min(start.elapsed().as_secs_f64());
    }
    best
}

/// The loosest tolerance at which the error is at most 1e-6 there and at the
/// next tighter ones, so that it is no lucky hit.
fn tolerance(error: impl Fn(f64) -> Result) -> f64 {
    let ladder: Vec<f64> = (0..=36)
        .map(|k| 10f64.powf(-3.0 - 0.25 * f64::from(k)))
        .collect();
    let good: Vec<bool> = ladder.iter().map(|&t| error(t).0 <= 1e-6).collect();
    let from = good
        .iter()
        .rposition(|good| !good)
        .map_or(0, |last| last + 1);
    ladder[from.min(ladder.len() - 1)]
}

fn main() {
    if std::env::args().any(|argument| argument == "--test") {
        return;
    }
    let reduced = Reduced::new();
    let of_full = tolerance(|tolerance| full(Full::Blocks, tolerance));
    let of_reduced = tolerance(|tolerance| reduced.error(tolerance));
    let [mut general, mut blocks, mut own] = [f64::INFINITY; 3];
    // In turns, so that a busy moment of the machine meets all.
    for _ in 0..60 {
        let solve = |how| {
            move || {
                black_box(full(how, black_box(of_full)));
            }
        };
        general = general.min(least(5, solve(Full::General)));
        blocks = blocks.min(least(5, solve(Full::Blocks)));
        own = own.min(least(5, || {
            drop(black_box(reduced.solve(black_box(of_reduced))))
        }));
    }
    println!("Andrews' squeezing mechanism to 0.03 s, positions to 1e-6, Dop853");
    let line = |name: &str, tolerance: f64, (error, steps): Result, time: f64| {
        println!(
            "{name:<46} tolerance {tolerance:.1e}  error {error:.1e}  {steps:4} steps  {:7.3} ms  ratio {:5.2}",
            1e3 * time,
            time / own
        );
    };
    let of = |how| full(how, of_full);
    line(
        "seven coordinates, elimination with pivots",
        of_full,
        of(Full::General),
        general,
    );
    line(
        "seven coordinates, by blocks made for it",
        of_full,
        of(Full::Blocks),
        blocks,
    );
    line(
        "dam, one coordinate",
        of_reduced,
        reduced.error(of_reduced),
        own,
    );
    told_of_preparing();
}

/// What is done once a scene.
fn told_of_preparing() {
    let reading = read();
    let found = model(&reading);
    let read = least(200, || drop(black_box(read())));
    let structure = least(200, || drop(black_box(model(&reading))));
    let [frozen, copied] = [true, false].map(|frozen| {
        least(200, || {
            let model = black_box(found.clone());
            if frozen {
                drop(black_box(System::new(model)));
            }
        })
    });
    println!(
        "once a scene: reading {:.3} ms, structure and reach {:.3} ms, tables of J and the forces {:.3} ms",
        1e3 * read,
        1e3 * structure,
        1e3 * (frozen - copied)
    );
}
