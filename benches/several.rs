//! Linkages of several inputs against equations written by hand for them: a five-bar on two
//! rotors, a slider-crank on a floating frame, a pendulum of ten bars.
//!
//! `cargo bench -p dam-benches --bench several`; the time of a step of the classical Runge-Kutta
//! method by the system's right-hand side over that of the same step by the equations in closed
//! form, dense, with one Cholesky factorisation a call. Both accelerations are compared first.

#![allow(clippy::print_stdout)] // the ratios are what it is run for

use dam::integrate::{Dynamics, Modes};
use dam::lower::lower;
use dam::scene::{BuiltIn, Document, Overrides};
use dam::system::System;
use std::hint::black_box;
use std::time::{Duration, Instant};

const G: f64 = 9.80665;

/// Solves a symmetric positive system of N equations by Cholesky's factorisation.
fn cholesky<const N: usize>(a: &mut [[f64; N]; N], b: &mut [f64; N]) {
    for i in 0..N {
        for j in 0..i {
            let mut sum = a[i][j];
            for k in 0..j {
                sum -= a[i][k] * a[j][k];
            }
            a[i][j] = sum / a[j][j];
        }
        let mut sum = a[i][i];
        for k in 0..i {
            sum -= a[i][k] * a[i][k];
        }
        a[i][i] = sum.sqrt();
    }
    for i in 0..N {
        for k in 0..i {
            b[i] -= a[i][k] * b[k];
        }
        b[i] /= a[i][i];
    }
    for i in (0..N).rev() {
        for k in i + 1..N {
            b[i] -= a[k][i] * b[k];
        }
        b[i] /= a[i][i];
    }
}

/// Bars of 0.5 m and 1 kg, angles from the horizontal.
fn pendulum(y: &[f64], dy: &mut [f64]) {
    const N: usize = 10;
    let l = 0.5;
    let (mut sin, mut cos) = ([0.0; N], [0.0; N]);
    for i in 0..N {
        (sin[i], cos[i]) = y[i].sin_cos();
    }
    let (mut mass, mut right) = ([[0.0; N]; N], [0.0; N]);
    for i in 0..N {
        let beyond = (N - 1 - i) as f64;
        mass[i][i] = l * l * (1.0 / 3.0 + beyond);
        right[i] -= G * l * cos[i] * (0.5 + beyond);
        for j in 0..i {
            let a = l * l * (0.5 + beyond);
            mass[i][j] = a * (cos[i] * cos[j] + sin[i] * sin[j]);
            let turned = a * (sin[i] * cos[j] - cos[i] * sin[j]);
            right[i] -= turned * y[N + j] * y[N + j];
            right[j] += turned * y[N + i] * y[N + i];
        }
    }
    cholesky(&mut mass, &mut right);
    dy[..N].copy_from_slice(&y[N..]);
    dy[N..].copy_from_slice(&right);
}

/// Cranks of 0.2 and 0.15 m, 0.6 m apart, with rotors of 0.02 and 0.03 kg m²; rods of 0.7 m.
fn five_bar(y: &[f64], dy: &mut [f64]) {
    let (l, apart, rod) = ([0.2, 0.15], 0.6, 0.7);
    let (m, rods, rotors) = ([1.1, 1.3], [0.9, 0.8], [0.02, 0.03]);
    let ((sa, ca), (sb, cb)) = (y[0].sin_cos(), y[1].sin_cos());
    // The cranks' pins, and the pin between the rods to the left of the line from A to B.
    let (a, b) = ([l[0] * ca, l[0] * sa], [apart + l[1] * cb, l[1] * sb]);
    let d = [b[0] - a[0], b[1] - a[1]];
    let square = d[0] * d[0] + d[1] * d[1];
    let h = (rod * rod / square - 0.25).sqrt();
    let c = [
        0.5 * (a[0] + b[0]) - h * d[1],
        0.5 * (a[1] + b[1]) + h * d[0],
    ];
    let r = [[c[0] - a[0], c[1] - a[1]], [c[0] - b[0], c[1] - b[1]]];
    let inverse = 1.0 / (r[0][0] * r[1][1] - r[0][1] * r[1][0]);
    // Velocities of A and B by the cranks; w0·(k × r0) − w1·(k × r1) = vB − vA.
    let pins = [[-a[1], a[0]], [-b[1], b[0] - apart]];
    let turn = |v: [f64; 2]| {
        [
            (v[0] * r[1][0] + v[1] * r[1][1]) * inverse,
            (v[0] * r[0][0] + v[1] * r[0][1]) * inverse,
        ]
    };
    let by = [
        turn([-pins[0][0], -pins[0][1]]),
        turn([pins[1][0], pins[1][1]]),
    ];
    let rate = [y[2], y[3]];
    let w = [0, 1].map(|k| by[0][k] * rate[0] + by[1][k] * rate[1]);
    // Accelerations without those of the cranks.
    let pin = [
        [-a[0] * rate[0] * rate[0], -a[1] * rate[0] * rate[0]],
        [
            -(b[0] - apart) * rate[1] * rate[1],
            -b[1] * rate[1] * rate[1],
        ],
    ];
    let (p, q) = (w[0] * w[0], w[1] * w[1]);
    let bias = turn([
        pin[1][0] - pin[0][0] + p * r[0][0] - q * r[1][0],
        pin[1][1] - pin[0][1] + p * r[0][1] - q * r[1][1],
    ]);
    let (mut mass, mut right) = ([[0.0; 2]; 2], [0.0; 2]);
    for k in 0..2 {
        mass[k][k] = m[k] * l[k] * l[k] / 3.0 + rotors[k];
        right[k] = -0.5 * m[k] * G * [l[0] * ca, l[1] * cb][k];
    }
    for k in 0..2 {
        let (x, z) = (0.5 * r[k][0], 0.5 * r[k][1]);
        let inertia = rods[k] * rod * rod / 12.0;
        // Velocities of the rod's centre by both cranks.
        let v = [0, 1].map(|j| {
            let own = f64::from(u8::from(j == k));
            [
                own * pins[k][0] - by[j][k] * z,
                own * pins[k][1] + by[j][k] * x,
            ]
        });
        let turned = w[k] * w[k];
        let acceleration = [
            pin[k][0] - bias[k] * z - turned * x,
            pin[k][1] + bias[k] * x - turned * z,
        ];
        for i in 0..2 {
            for j in 0..=i {
                mass[i][j] += rods[k] * (v[i][0] * v[j][0] + v[i][1] * v[j][1])
                    + inertia * by[i][k] * by[j][k];
            }
            right[i] -= rods[k] * (v[i][0] * acceleration[0] + v[i][1] * (acceleration[1] + G))
                + inertia * by[i][k] * bias[k];
        }
    }
    right[0] += 6.0 * (1.0 - rate[0] / 9.0);
    right[1] += -8.0 * (1.0 + rate[1] / 7.0);
    cholesky(&mut mass, &mut right);
    dy[..2].copy_from_slice(&y[2..]);
    dy[2..].copy_from_slice(&right);
}

/// EXUDYN's sliderCrankFloatingTest: crank against the frame, angle, x and y of the frame.
fn floating(y: &[f64], dy: &mut [f64]) {
    let (l1, l2, m) = (0.1, 0.3, 0.2);
    let ((s, c), (sf, cf)) = (y[0].sin_cos(), y[1].sin_cos());
    let (rate, tilt) = (y[4], y[5]);
    // In the frame: the rod's angle b below the guide with sin b = l1 sin(φ)/l2.
    let sb = l1 * s / l2;
    let cb = (1.0 - sb * sb).sqrt();
    let (b1, b2) = {
        let first = l1 * c / (l2 * cb);
        (first, (-l1 * s / l2 + sb * first * first) / cb)
    };
    // Centre of each body in the frame with its two derivatives by φ; its angle's too.
    let crank = [
        [0.5 * l1 * c, 0.5 * l1 * s],
        [-0.5 * l1 * s, 0.5 * l1 * c],
        [-0.5 * l1 * c, -0.5 * l1 * s],
    ];
    let rod = [
        [l1 * c + 0.5 * l2 * cb, 0.5 * l1 * s],
        [-l1 * s - 0.5 * l2 * sb * b1, 0.5 * l1 * c],
        [-l1 * c - 0.5 * l2 * (cb * b1 * b1 + sb * b2), -0.5 * l1 * s],
    ];
    let slide = [
        [l1 * c + l2 * cb, 0.0],
        [-l1 * s - l2 * sb * b1, 0.0],
        [-l1 * c - l2 * (cb * b1 * b1 + sb * b2), 0.0],
    ];
    let bodies = [
        (m, m * l1 * l1 / 12.0, crank, [1.0, 0.0]),
        (m, m * l2 * l2 / 12.0, rod, [-b1, -b2]),
        (0.4, 0.0, slide, [0.0, 0.0]),
    ];
    let mut mass = [[0.0; 4]; 4];
    let spring = |q: f64, v: f64| -5000.0 * q - 50.0 * v;
    let mut right = [
        0.1,
        spring(y[1], y[5]) + 0.1,
        spring(y[2], y[6]),
        spring(y[3], y[7]),
    ];
    (mass[1][1], mass[2][2], mass[3][3]) = (1.0, 2.0, 2.0);
    for (m, inertia, at, [turn, bend]) in bodies {
        // Velocities by φ, the tilt, x and y, seen in the frame.
        let (p, v, a) = (at[0], at[1], at[2]);
        let by = [v, [-p[1], p[0]], [cf, -sf], [sf, cf]];
        let turning = [turn, 1.0, 0.0, 0.0];
        let acceleration = [
            a[0] * rate * rate - 2.0 * tilt * v[1] * rate - tilt * tilt * p[0],
            a[1] * rate * rate + 2.0 * tilt * v[0] * rate - tilt * tilt * p[1],
        ];
        for i in 0..4 {
            for j in 0..=i {
                mass[i][j] += m * (by[i][0] * by[j][0] + by[i][1] * by[j][1])
                    + inertia * turning[i] * turning[j];
            }
            right[i] -= m * (by[i][0] * acceleration[0] + by[i][1] * acceleration[1])
                + inertia * turning[i] * bend * rate * rate;
        }
    }
    cholesky(&mut mass, &mut right);
    dy[..4].copy_from_slice(&y[4..]);
    dy[4..].copy_from_slice(&right);
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

/// Least time of many rows of steps.
fn time(f: &mut dyn FnMut(&[f64], &mut [f64]), start: &[f64]) -> Duration {
    let mut room = std::array::from_fn(|_| vec![0.0; start.len()]);
    let mut best = Duration::MAX;
    for _ in 0..60 {
        let mut y = start.to_vec();
        let begin = Instant::now();
        for _ in 0..2000 {
            step(f, &mut y, 1e-5, &mut room);
        }
        black_box(&y);
        best = best.min(begin.elapsed());
    }
    best / 8000
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

/// A case: the system and what is written by hand, with its state for a state of the system
/// and the system's accelerations for its own.
struct Case {
    name: &'static str,
    text: String,
    hand: fn(&[f64], &mut [f64]),
    /// From relative angles to absolute ones.
    summed: bool,
}

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

fn main() {
    let scene = |name: &str| {
        let path = format!(
            "{}/../scenarios/linkages/{name}.json",
            env!("CARGO_MANIFEST_DIR")
        );
        std::fs::read_to_string(path).expect("a scene")
    };
    let cases = [
        Case {
            name: "five-bar",
            text: scene("five_bar"),
            hand: five_bar,
            summed: false,
        },
        Case {
            name: "floating slider-crank",
            text: scene("floating_slider_crank"),
            hand: floating,
            summed: false,
        },
        Case {
            name: "pendulum of ten bars",
            text: pendulum_scene(),
            hand: pendulum,
            summed: true,
        },
    ];
    // A word picks cases: `cargo bench -p dam-benches --bench several -- five`.
    let word = std::env::args().skip(1).find(|word| !word.starts_with('-'));
    let asked = |case: &Case| {
        word.as_ref()
            .is_none_or(|word| case.name.contains(word.as_str()))
    };
    for case in cases.into_iter().filter(asked) {
        let system = system(&case.text);
        let start = system.initial_state().expect("a start");
        let n = system.coordinates();
        // Not at rest, and not where anything is zero.
        let mut y = start.y.clone();
        for (k, y) in y.iter_mut().enumerate() {
            *y += 1e-3 * (1.0 + k as f64);
        }
        let mut scratch = system.scratch();
        let modes = Modes(start.modes.0.clone());
        let mut own =
            |y: &[f64], dy: &mut [f64]| system.derivatives(0.0, y, &modes, &mut scratch, dy);
        let (mut found, mut wanted) = (vec![0.0; 2 * n], vec![0.0; 2 * n]);
        own(&y, &mut found);
        let mut by_hand = sums(&y[..n], case.summed);
        by_hand.extend(sums(&y[n..], case.summed));
        (case.hand)(&by_hand, &mut wanted);
        for (found, wanted) in sums(&found[n..], case.summed).iter().zip(&wanted[n..]) {
            assert!(
                (found - wanted).abs() < 1e-8 * (1.0 + wanted.abs()),
                "{}: {found} and {wanted}",
                case.name
            );
        }
        let ours = time(&mut own, &y);
        let mut hand = case.hand;
        let theirs = time(&mut hand, &by_hand);
        println!(
            "{:24} {:7.1} ns by hand, {:7.1} ns by the system: {:.2} times",
            case.name,
            theirs.as_secs_f64() * 1e9,
            ours.as_secs_f64() * 1e9,
            ours.as_secs_f64() / theirs.as_secs_f64()
        );
    }
}
