//! Cost of the right-hand side: the rocker with ten masses, assembled, against
//! a loop written by hand for the same equations.
//!
//! `cargo bench --bench right_hand_side`; the ratio of the two is printed first.

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
        law: DampingLaw::KelvinVoigt,
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
        law: LoadLaw::Constant(MOMENT),
    });
    System::new(model).expect("the model is sound")
}

/// The same equations by hand: deviations u from the law, u̇ behind them.
struct ByHand {
    inverse_inertia: [f64; MASSES],
    stiffness: [f64; MASSES],
    damping: [f64; MASSES],
}

impl ByHand {
    #[inline(never)]
    fn derivatives(&self, time: f64, y: &[f64], engaged: bool, dy: &mut [f64]) {
        let (u, v) = y.split_at(MASSES);
        let (speeds, accelerations) = dy.split_at_mut(MASSES);
        speeds.copy_from_slice(v);
        let law = -FRAC_PI_2 * SPEED * SPEED * (SPEED * time).sin();
        let mut below = if engaged {
            self.stiffness[0] * u[0] + self.damping[0] * v[0]
        } else {
            0.0
        };
        for m in 0..MASSES {
            let above = if m + 1 < MASSES {
                self.stiffness[m + 1] * (u[m + 1] - u[m]) + self.damping[m + 1] * (v[m + 1] - v[m])
            } else {
                MOMENT
            };
            accelerations[m] = (above - below) * self.inverse_inertia[m] - law;
            below = above;
        }
    }
}

fn by_hand() -> ByHand {
    let numbers = numbers();
    ByHand {
        inverse_inertia: numbers.inertia.map(|inertia| 1.0 / inertia),
        stiffness: numbers.stiffness,
        damping: numbers.damping,
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
            call(1e-6 * f64::from(index));
        }
        begin.elapsed().as_secs_f64() * 1e9 / f64::from(CALLS)
    };
    (0..300)
        .map(|_| round(&mut call))
        .fold(f64::INFINITY, f64::min)
}

fn compare(criterion: &mut Criterion) {
    let (system, hand, y) = (system(), by_hand(), state());
    let modes = Modes(vec![-1]);
    let mut scratch = system.scratch();
    let (mut dy, mut expected) = (vec![0.0; 2 * MASSES], vec![0.0; 2 * MASSES]);
    system.derivatives(0.013, &y, &modes, &mut scratch, &mut dy);
    hand.derivatives(0.013, &y, true, &mut expected);
    for (one, other) in dy.iter().zip(&expected) {
        assert!((one - other).abs() <= 1e-12 * other.abs(), "{one} {other}");
    }
    let assembled = fastest(|time| {
        system.derivatives(
            black_box(time),
            black_box(&y),
            &modes,
            &mut scratch,
            &mut dy,
        );
        black_box(&mut dy);
    });
    let manual = fastest(|time| {
        hand.derivatives(black_box(time), black_box(&y), black_box(true), &mut dy);
        black_box(&mut dy);
    });
    println!(
        "ten-mass rocker: assembled {assembled:.1} ns, by hand {manual:.1} ns, ratio {:.2}",
        assembled / manual
    );
    let mut group = criterion.benchmark_group("ten-mass rocker");
    group.measurement_time(Duration::from_secs(2));
    group.bench_function("assembled", |bencher| {
        bencher.iter(|| {
            system.derivatives(
                black_box(0.013),
                black_box(&y),
                &modes,
                &mut scratch,
                &mut dy,
            );
            black_box(&mut dy);
        });
    });
    group.bench_function("by hand", |bencher| {
        bencher.iter(|| {
            hand.derivatives(black_box(0.013), black_box(&y), black_box(true), &mut dy);
            black_box(&mut dy);
        });
    });
    group.bench_function("tangent", |bencher| {
        let direction = state();
        bencher.iter(|| {
            system.tangent(
                0.013,
                black_box(&y),
                &modes,
                &direction,
                &mut scratch,
                &mut dy,
            );
            black_box(&mut dy);
        });
    });
    group.finish();
}

criterion_group!(benches, compare);
criterion_main!(benches);
