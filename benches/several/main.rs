//! Linkages of several inputs against equations written by hand for them: a five-bar on two
//! rotors, a slider-crank on a floating frame, a pendulum of ten bars.
//!
//! `cargo bench -p dam-benches --bench several`. Both are integrated by the same methods of the
//! program, from the same state to the same end at the same tolerance, and the whole time of
//! the one stands over that of the other: what `dam run` takes (`radau`, with the Jacobian on
//! numbers with derivatives), an explicit method of high order, and the classical method with a fixed
//! step. The last column is the right-hand side alone, four calls a step of a bare loop.
//! Accelerations are compared first, and the states at the end.

#![allow(clippy::print_stdout)] // the ratios are what it is run for

mod hand;
mod problem;

use dam::budget::Budget;
use dam::integrate::{
    Dynamics, Limits, Method, Modes, Settings, Sink, Stop, SwitchEvent, integrate,
};
use dam::lower::lower;
use dam::number::Number;
use dam::polynomial::Step;
use dam::scene::{BuiltIn, Document, Overrides};
use dam::system::System;
use problem::{ByHand, Equations};
use std::hint::black_box;
use std::time::{Duration, Instant};

/// What both are integrated by, how finely, with which step (s), and how far the states may be
/// apart at the end.
const METHODS: [(Method, f64, Option<f64>, f64); 3] = [
    (Method::Radau, 1e-9, None, 1e-6),
    (Method::Dop853, 1e-9, None, 1e-6),
    (Method::Rk4, 1e-6, Some(2e-4), 1e-6),
];

struct FiveBar;
struct Floating;
struct Pendulum;

impl Equations for FiveBar {
    fn derivatives<N: Number>(y: &[N], dy: &mut [N]) {
        hand::five_bar(y, dy);
    }
}

impl Equations for Floating {
    fn derivatives<N: Number>(y: &[N], dy: &mut [N]) {
        hand::floating(y, dy);
    }
}

impl Equations for Pendulum {
    fn derivatives<N: Number>(y: &[N], dy: &mut [N]) {
        hand::pendulum(y, dy);
    }
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

/// Hears where it ends.
struct Last(Vec<f64>);

impl Sink for Last {
    fn start(&mut self, _time: f64, _y: &[f64], _modes: &Modes) {}

    fn step(&mut self, step: &Step<'_>, _modes: &Modes) {
        step.state(step.end, &mut self.0);
    }

    fn switch(&mut self, _event: &SwitchEvent<'_>) {}
}

fn go<D: Dynamics>(
    dynamics: &D,
    (start, modes): (&[f64], &Modes),
    (method, tolerance, step, _): (Method, f64, Option<f64>, f64),
    sink: &mut dyn Sink,
) -> u64 {
    let settings = Settings {
        method,
        tolerance,
        step,
    };
    let limits = Limits {
        switches: 10,
        steps: 1_000_000,
        budget: Budget::FREE,
    };
    let outcome = integrate(dynamics, 0.0, END, start, modes, &settings, &limits, sink);
    assert!(matches!(outcome.stop, Stop::Complete), "{:?}", outcome.stop);
    outcome.statistics.steps
}

/// How long it is integrated (s).
const END: f64 = 0.3;
const ROUNDS: usize = 60;

/// Least time of many, both in turns, so that what else the machine does meets both.
fn least(mut one: impl FnMut(), mut other: impl FnMut()) -> [Duration; 2] {
    let mut best = [Duration::MAX; 2];
    let mut measure = |which: usize, act: &mut dyn FnMut()| {
        let begin = Instant::now();
        act();
        best[which] = best[which].min(begin.elapsed());
    };
    for _ in 0..ROUNDS {
        measure(0, &mut one);
        measure(1, &mut other);
    }
    best
}

/// A step of the classical Runge-Kutta method.
fn step(f: &mut dyn FnMut(&[f64], &mut [f64]), y: &mut [f64], h: f64, room: &mut [Vec<f64>; 5]) {
    let [k1, k2, k3, k4, at] = room;
    let go = |at: &mut [f64], y: &[f64], k: &[f64], h: f64| {
        for ((at, y), k) in at.iter_mut().zip(y).zip(k) {
            *at = y + h * k;
        }
    };
    f(y, k1);
    go(at, y, k1, 0.5 * h);
    f(at, k2);
    go(at, y, k2, 0.5 * h);
    f(at, k3);
    go(at, y, k3, h);
    f(at, k4);
    for (i, y) in y.iter_mut().enumerate() {
        *y += h / 6.0 * (k1[i] + 2.0 * (k2[i] + k3[i]) + k4[i]);
    }
}

/// Steps of the bare loop that are timed at once.
const BARE: u32 = 2000;

fn bare(f: &mut dyn FnMut(&[f64], &mut [f64]), start: &[f64]) {
    let mut room = std::array::from_fn(|_| vec![0.0; start.len()]);
    let mut y = start.to_vec();
    for _ in 0..BARE {
        step(f, &mut y, 1e-5, &mut room);
    }
    black_box(&y);
}

fn system(text: &str) -> System {
    let document = Document::parse("scene", text.as_bytes()).expect("JSON");
    let scene = document.scene(&BuiltIn, &Overrides::new(Vec::<String>::new()));
    let scene = scene
        .map_err(|faults| faults.render(false))
        .expect("a scene");
    System::new(lower(&scene.scene).expect("a model")).expect("a system")
}

/// The scene of a pendulum of ten bars.
fn pendulum_scene() -> String {
    let (mut links, mut pairs, mut inputs) = (Vec::new(), Vec::new(), Vec::new());
    for k in 0..10 {
        links.push(format!(
            r#""bar{k}": {{ "points": {{ "end": [0.5, 0] }}, "geometry": {{ "mass": 1 }} }}"#
        ));
        let before = match k {
            0 => "ground.O".to_owned(),
            _ => format!("bar{}.end", k - 1),
        };
        pairs.push(format!(
            r#""pin{k}": {{ "revolute": ["{before}", "bar{k}.origin"] }}"#
        ));
        let start = if k == 0 { 0.3 } else { 0.05 };
        inputs.push(format!(
            r#""q{k}": {{ "pair": "pin{k}", "start": {start}, "speed": 0.1 }}"#
        ));
    }
    let [links, pairs, inputs] = [links, pairs, inputs].map(|list| list.join(","));
    format!(
        r#"{{ "dam": 1, "name": "pendulum", "objects": {{ "p": {{ "kind": "linkage", "ground": {{ "O": [0, 0] }},
            "links": {{ {links} }}, "pairs": {{ {pairs} }}, "inputs": {{ {inputs} }}, "gravity": true }} }},
            "run": {{ "duration": 1 }} }}"#
    )
}

/// From relative angles to absolute ones, where the equations by hand have those.
fn sums(values: &[f64], summed: bool) -> Vec<f64> {
    let mut sum = 0.0;
    let each = |&value: &f64| match summed {
        true => {
            sum += value;
            sum
        }
        false => value,
    };
    values.iter().map(each).collect()
}

fn by_hand(y: &[f64], summed: bool) -> Vec<f64> {
    let (u, v) = y.split_at(y.len() / 2);
    [sums(u, summed), sums(v, summed)].concat()
}

fn compared(name: &str, found: &[f64], wanted: &[f64], within: f64) {
    for (found, wanted) in found.iter().zip(wanted) {
        assert!(
            (found - wanted).abs() < within * (1.0 + wanted.abs()),
            "{name}: {found} and {wanted}"
        );
    }
}

/// A case: the scene of the system, and whether what is written by hand has absolute angles.
fn case<E: Equations>(name: &str, text: &str, summed: bool) {
    let system = system(text);
    let start = system.initial_state().expect("a start");
    // Not at rest, and not where anything is zero.
    let mut y = start.y.clone();
    for (k, y) in y.iter_mut().enumerate() {
        *y += 1e-3 * (1.0 + k as f64);
    }
    let modes = Modes(start.modes.0.clone());
    let own = (system, y);
    let hand = (ByHand::<E>::new(own.0.scales()), by_hand(&own.1, summed));
    let mut scratch = own.0.scratch();
    let mut ours = |y: &[f64], dy: &mut [f64]| own.0.derivatives(0.0, y, &modes, &mut scratch, dy);
    let (mut found, mut wanted) = (vec![0.0; own.1.len()], vec![0.0; own.1.len()]);
    ours(&own.1, &mut found);
    E::derivatives(&hand.1, &mut wanted);
    compared(name, &by_hand(&found, summed), &wanted, 1e-8);
    print!("{name:24}");
    for plan in METHODS {
        let mut ends = [0, 1].map(|_| Last(vec![f64::NAN; own.1.len()]));
        let steps = [
            go(&hand.0, (&hand.1, &modes), plan, &mut ends[0]),
            go(&own.0, (&own.1, &modes), plan, &mut ends[1]),
        ];
        compared(name, &by_hand(&ends[1].0, summed), &ends[0].0, plan.3);
        let [theirs, ours] = least(
            || _ = go(&hand.0, (&hand.1, &modes), plan, &mut Nobody),
            || _ = go(&own.0, (&own.1, &modes), plan, &mut Nobody),
        );
        let (theirs, ours) = (theirs.as_secs_f64() * 1e6, ours.as_secs_f64() * 1e6);
        let ratio = format!("{:.2}", ours / theirs);
        print!(
            " | {:6} {theirs:7.0} {ours:7.0} µs {ratio} ({} and {} steps)",
            plan.0.to_string(),
            steps[0],
            steps[1]
        );
    }
    let [theirs, ours] = least(
        || bare(&mut |y, dy| E::derivatives(y, dy), &hand.1),
        || bare(&mut ours, &own.1),
    );
    let each = |time: Duration| time.as_secs_f64() * 1e9 / f64::from(4 * BARE);
    let (theirs, ours) = (each(theirs), each(ours));
    println!(" | alone {theirs:6.1} {ours:6.1} ns {:.2}", ours / theirs);
}

fn main() {
    let scene = |name: &str| {
        let path = format!(
            "{}/../scenarios/linkages/{name}.json",
            env!("CARGO_MANIFEST_DIR")
        );
        std::fs::read_to_string(path).expect("a scene")
    };
    // A word picks cases: `cargo bench -p dam-benches --bench several -- five`.
    let word = std::env::args().skip(1).find(|word| !word.starts_with('-'));
    let asked = |name: &str| {
        word.as_ref()
            .is_none_or(|word| name.contains(word.as_str()))
    };
    if asked("five-bar") {
        case::<FiveBar>("five-bar", &scene("five_bar"), false);
    }
    if asked("floating slider-crank") {
        let text = scene("floating_slider_crank");
        case::<Floating>("floating slider-crank", &text, false);
    }
    if asked("pendulum of ten bars") {
        case::<Pendulum>("pendulum of ten bars", &pendulum_scene(), true);
    }
}
