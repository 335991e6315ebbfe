//! Cost of the right-hand side: the rocker with ten masses, assembled, against
//! a loop written by hand for the same equations.
//!
//! `cargo bench -p dam-benches --bench right_hand_side`; the ratio of the two is printed first.

#![allow(clippy::print_stdout)] // the ratio is what it is run for

use criterion::{Criterion, criterion_group, criterion_main};
use dam::integrate::{Dynamics, Modes};
use dam::model::*;
use dam::motion::DriveMotion;
use dam::position::Position;
use dam::system::System;
use std::f64::consts::{FRAC_PI_2, PI};
use std::hint::black_box;
use std::time::{Duration, Instant};

const MASSES: usize = 10;
const SPEED: f64 = 20.0 * PI;
const MOMENT: f64 = -600.0;

/// Numbers of the ten-mass rocker.
struct Numbers {
    inertia: [f64; MASSES],
    stiffness: [f64; MASSES],
    damping: [f64; MASSES],
}

fn numbers() -> Numbers {
    let n = MASSES as f64;
    let cube = |m: usize| ((m + 1) as f64 / n).powi(3);
    let mut inertia = [0.0; MASSES];
    for (m, inertia) in inertia.iter_mut().enumerate() {
        *inertia = 0.1 * (cube(m) - if m == 0 { 0.0 } else { cube(m - 1) });
    }
    Numbers {
        inertia,
        stiffness: [n * 1e7; MASSES],
        damping: [0.4 * n * 1e7 / (2.0 * PI * 1e4); MASSES],
    }
}

fn system() -> System {
    let numbers = numbers();
    let mut model = Model::default();
    model.nodes.push(Node {
        inertia: 0.0,
        motion: NodeMotion::Prescribed {
            motion: DriveMotion::Constant {
                speed: SPEED,
                angle: 0.0,
            },
            track: None,
        },
    });
    let pair = Pair {
        closure: Closure::Force,
        gap: 0.0,
        opens: 1.0,
        form: ContactForm::default(),
    };
    for m in 0..MASSES {
        model.nodes.push(Node {
            inertia: numbers.inertia[m],
            motion: NodeMotion::Mass {
                law: Law {
                    driver: 0,
                    position: Position::Sine {
                        amplitude: FRAC_PI_2,
                        harmonic: 1.0,
                        phase: 0.0,
                        offset: 0.0,
                    },
                    lever: 1.0,
                    track: None,
                },
            },
        });
        model.links.push(Link {
            mass: m + 1,
            base: if m == 0 {
                LinkBase::Law { pair }
            } else {
                LinkBase::Mass(m)
            },
            stiffness: numbers.stiffness[m],
            damping: numbers.damping[m],
        });
    }
    model.loads.push(Load {
        node: MASSES,
        name: "rocker.loads.closing".into(),
        law: LoadLaw::constant(MOMENT),
    });
    System::new(model).expect("the model is sound")
}

/// The same equations by hand: deviations u from the law, u̇ behind them. All
/// slices of one length, the number of masses.
#[inline(always)]
fn by_hand(
    [inverse_inertia, stiffness, damping]: [&[f64]; 3],
    time: f64,
    [u, v]: [&[f64]; 2],
    engaged: bool,
    [speeds, accelerations]: [&mut [f64]; 2],
) {
    let masses = inverse_inertia.len();
    speeds.copy_from_slice(v);
    let law = -FRAC_PI_2 * SPEED * SPEED * (SPEED * time).sin();
    let mut below = if engaged {
        stiffness[0] * u[0] + damping[0] * v[0]
    } else {
        0.0
    };
    for m in 0..masses - 1 {
        let above = stiffness[m + 1] * (u[m + 1] - u[m]) + damping[m + 1] * (v[m + 1] - v[m]);
        accelerations[m] = (above - below) * inverse_inertia[m] - law;
        below = above;
    }
    accelerations[masses - 1] = (MOMENT - below) * inverse_inertia[masses - 1] - law;
}

/// By hand for any number of masses, as a program for chains has it.
struct AnyMasses {
    inverse_inertia: Vec<f64>,
    stiffness: Vec<f64>,
    damping: Vec<f64>,
}

impl AnyMasses {
    fn new() -> Self {
        let numbers = numbers();
        Self {
            inverse_inertia: numbers.inertia.map(|inertia| 1.0 / inertia).to_vec(),
            stiffness: numbers.stiffness.to_vec(),
            damping: numbers.damping.to_vec(),
        }
    }

    #[inline(never)]
    fn derivatives(&self, time: f64, y: &[f64], engaged: bool, dy: &mut [f64]) {
        let masses = self.inverse_inertia.len();
        let numbers = [&self.inverse_inertia, &self.stiffness, &self.damping];
        let (u, v) = y.split_at(masses);
        let (speeds, accelerations) = dy.split_at_mut(masses);
        let numbers = numbers.map(|list| &list[..masses]);
        let out = [speeds, &mut accelerations[..masses]];
        by_hand(numbers, time, [u, &v[..masses]], engaged, out);
    }
}

/// By hand for ten masses and no other number: the compiler unrolls the loop.
struct TenMasses {
    inverse_inertia: [f64; MASSES],
    stiffness: [f64; MASSES],
    damping: [f64; MASSES],
}

impl TenMasses {
    fn new() -> Self {
        let numbers = numbers();
        Self {
            inverse_inertia: numbers.inertia.map(|inertia| 1.0 / inertia),
            stiffness: numbers.stiffness,
            damping: numbers.damping,
        }
    }

    #[inline(never)]
    fn derivatives(&self, time: f64, y: &[f64], engaged: bool, dy: &mut [f64]) {
        let numbers: [&[f64]; 3] = [&self.inverse_inertia, &self.stiffness, &self.damping];
        let (u, v) = y.split_at(MASSES);
        let (speeds, accelerations) = dy.split_at_mut(MASSES);
        let out = [speeds, &mut accelerations[..MASSES]];
        by_hand(numbers, time, [u, &v[..MASSES]], engaged, out);
    }
}

fn state() -> Vec<f64> {
    let wave = |k: usize| 1e-4 * ((7 * k) as f64).sin();
    (0..2 * MASSES).map(wave).collect()
}

/// Fastest of many rounds, in nanoseconds a call.
fn fastest(mut call: impl FnMut(f64)) -> f64 {
    const CALLS: u32 = 10_000;
    let round = |call: &mut dyn FnMut(f64)| {
        let begin = Instant::now();
        for index in 0..CALLS {
            call(1e-5 * f64::from(index)); // one cycle of the drive
        }
        begin.elapsed().as_secs_f64() * 1e9 / f64::from(CALLS)
    };
    (0..300)
        .map(|_| round(&mut call))
        .fold(f64::INFINITY, f64::min)
}

fn compare(criterion: &mut Criterion) {
    let (system, y) = (system(), state());
    let (any, ten) = (AnyMasses::new(), TenMasses::new());
    let modes = Modes(vec![-1]);
    let mut scratch = system.scratch();
    let mut dy = vec![0.0; 2 * MASSES];
    let mut expected = [vec![0.0; 2 * MASSES], vec![0.0; 2 * MASSES]];
    system.derivatives(0.013, &y, &modes, &mut scratch, &mut dy);
    any.derivatives(0.013, &y, true, &mut expected[0]);
    ten.derivatives(0.013, &y, true, &mut expected[1]);
    for expected in &expected {
        for (one, other) in dy.iter().zip(expected) {
            assert!((one - other).abs() <= 1e-12 * other.abs(), "{one} {other}");
        }
    }
    let assembled = fastest(|time| {
        let time = black_box(time);
        system.derivatives(time, black_box(&y), &modes, &mut scratch, &mut dy);
        black_box(&mut dy);
    });
    let manual = fastest(|time| {
        any.derivatives(black_box(time), black_box(&y), black_box(true), &mut dy);
        black_box(&mut dy);
    });
    let fixed = fastest(|time| {
        ten.derivatives(black_box(time), black_box(&y), black_box(true), &mut dy);
        black_box(&mut dy);
    });
    println!(
        "ten-mass rocker: assembled {assembled:.1} ns; by hand for any number of masses \
         {manual:.1} ns, ratio {:.2}; by hand for exactly ten {fixed:.1} ns, ratio {:.2}",
        assembled / manual,
        assembled / fixed
    );
    let mut group = criterion.benchmark_group("ten-mass rocker");
    group.measurement_time(Duration::from_secs(2));
    group.bench_function("assembled", |bencher| {
        bencher.iter(|| {
            let time = black_box(0.013);
            system.derivatives(time, black_box(&y), &modes, &mut scratch, &mut dy);
            black_box(&mut dy);
        });
    });
    group.bench_function("by hand", |bencher| {
        bencher.iter(|| {
            any.derivatives(black_box(0.013), black_box(&y), black_box(true), &mut dy);
            black_box(&mut dy);
        });
    });
    group.bench_function("by hand, ten", |bencher| {
        bencher.iter(|| {
            ten.derivatives(black_box(0.013), black_box(&y), black_box(true), &mut dy);
            black_box(&mut dy);
        });
    });
    group.bench_function("tangent", |bencher| {
        let direction = state();
        bencher.iter(|| {
            let y = black_box(&y);
            system.tangent(0.013, y, &modes, &direction, &mut scratch, &mut dy);
            black_box(&mut dy);
        });
    });
    group.finish();
}

criterion_group!(benches, compare);
criterion_main!(benches);
