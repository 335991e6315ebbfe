//! Andrews' squeezing mechanism for 0.03 s: as a linkage with one coordinate,
//! and by the full equations of its seven angles with six multipliers (as in the
//! Test Set for IVP Solvers, index reduced to one), both integrated by
//! ode_solvers' Dop853.
//!
//! `cargo bench --bench squeezer`: for a ladder of tolerances the error of β at
//! the end and the best time of a number of runs.

#![allow(clippy::print_stdout)] // the table is what it is run for

use dam::linkage::spec::{
    AssemblyChoice, AssemblySpec, ForceLaw, ForceSpec, LinkSpec, LinkageSpec, PairKind, PairSpec,
    PointOf,
};
use dam::linkage::{Linkage, Workspace};
use nalgebra::{SMatrix, SVector};
use ode_solvers::{Dop853, OutputType, System};
use std::cell::RefCell;
use std::time::Instant;

/// β, Θ, γ, Φ, δ, Ω, ε at rest (rad).
const START: [f64; 7] = [
    -0.061_713_890_014_276_45,
    0.0,
    0.455_279_819_163_070_4,
    0.222_668_390_165_885_88,
    0.487_364_979_543_842_55,
    -0.222_668_390_165_885_88,
    1.230_547_444_549_821_2,
];
/// β at t = 0.03 s (Test Set for IVP Solvers).
const END: f64 = 15.81077119629904;
const DURATION: f64 = 0.03;
const MASSES: [f64; 7] = [
    0.04325, 0.00365, 0.02373, 0.00706, 0.07050, 0.00706, 0.05498,
];
const MOMENTS: [f64; 7] = [
    2.194e-6, 4.410e-7, 5.255e-6, 5.667e-7, 1.169e-5, 5.667e-7, 1.912e-5,
];
const A: [f64; 2] = [-0.06934, -0.00227];
const B: [f64; 2] = [-0.03635, 0.03273];
const C: [f64; 2] = [0.014, 0.072];
const TORQUE: f64 = 0.033;
const RATE: f64 = 4530.0;
const FREE_LENGTH: f64 = 0.07785;

// ---- one coordinate

fn linkage() -> Linkage {
    let at = |(link, at): (usize, [f64; 2])| PointOf {
        link: link.checked_sub(1),
        at,
    };
    let o = [0.0; 2];
    let end = [-0.028, 0.0];
    // Links 1 to 7, 0 the ground.
    let pins = [
        ((0, o), (1, o)),
        ((1, [0.007, 0.0]), (2, o)),
        ((0, B), (3, o)),
        ((2, end), (3, [0.0, -0.035])),
        ((0, A), (5, o)),
        ((5, [0.04, 0.0]), (4, [0.0, 0.02])),
        ((2, end), (4, o)),
        ((0, A), (7, o)),
        ((7, [0.0, -0.04]), (6, [-0.02, 0.0])),
        ((2, end), (6, o)),
    ];
    let centres = [
        [0.00092, 0.0],
        [-0.0115, 0.0],
        [0.01043, -0.01874],
        [0.0, 0.01421],
        [0.02308, 0.00916],
        [-0.01421, 0.0],
        [-0.00449, -0.01228],
    ];
    let [beta, theta, gamma, phi, delta, omega, epsilon] = START;
    let angles = [
        beta,
        beta + theta,
        gamma,
        phi + delta,
        delta,
        omega + epsilon,
        epsilon,
    ];
    let spring = ForceLaw::Strut {
        from: at((0, C)),
        to: at((3, [0.02, -0.018])),
        rate: RATE,
        free_length: FREE_LENGTH,
        damping: 0.0,
    };
    let torque = ForceLaw::Couple {
        link: 0,
        couple: TORQUE,
    };
    Linkage::new(LinkageSpec {
        links: (0..7)
            .map(|k| LinkSpec {
                name: format!("K{}", k + 1),
                mass: MASSES[k],
                centre: centres[k],
                moment: MOMENTS[k],
                ..LinkSpec::default()
            })
            .collect(),
        pairs: pins
            .iter()
            .enumerate()
            .map(|(k, &(on, link))| PairSpec {
                name: format!("p{k}"),
                on: at(on),
                link: at(link),
                kind: PairKind::Revolute { diameter: 0.0 },
                friction: 0.0,
            })
            .collect(),
        start: beta,
        assembly: (1..7)
            .map(|link| AssemblySpec {
                link,
                choice: AssemblyChoice::Angle(angles[link]),
            })
            .collect(),
        forces: [("spring", spring), ("torque", torque)]
            .map(|(name, law)| ForceSpec {
                name: name.to_owned(),
                law,
            })
            .to_vec(),
        ..LinkageSpec::default()
    })
    .expect("the squeezing mechanism")
}

/// q̈ from the reduced inertia, potential and forces.
struct OneCoordinate<'a> {
    linkage: &'a Linkage,
    workspace: RefCell<Workspace>,
}

impl System<f64, SVector<f64, 2>> for OneCoordinate<'_> {
    fn system(&self, _: f64, y: &SVector<f64, 2>, dy: &mut SVector<f64, 2>) {
        let workspace = &mut *self.workspace.borrow_mut();
        dy[0] = y[1];
        dy[1] = match self.linkage.solve(y[0], 2, workspace) {
            Ok(()) => {
                let r = self.linkage.reduced(workspace);
                (r.force[0] - r.potential[1] - 0.5 * r.inertia[1] * y[1] * y[1]) / r.inertia[0]
            }
            Err(_) => f64::NAN,
        };
    }
}

// ---- seven coordinates

/// A point as a sum of vectors (x, y) turned by sums of the coordinates (bits).
struct Place {
    fixed: [f64; 2],
    turned: &'static [([f64; 2], u8)],
}

const BETA: u8 = 1;
const BETA_THETA: u8 = 1 | 2;
const GAMMA: u8 = 4;
const DELTA: u8 = 16;
const PHI_DELTA: u8 = 8 | 16;
const EPSILON: u8 = 64;
const OMEGA_EPSILON: u8 = 32 | 64;
const O: [f64; 2] = [0.0; 2];

/// Centres of mass with the coordinates that their links turn with.
const BODIES: [(Place, u8); 7] = [
    (place(O, &[([0.00092, 0.0], BETA)]), BETA),
    (
        place(O, &[([0.007, 0.0], BETA), ([-0.0115, 0.0], BETA_THETA)]),
        BETA_THETA,
    ),
    (place(B, &[([0.01043, -0.01874], GAMMA)]), GAMMA),
    (
        place(A, &[([0.04, 0.0], DELTA), ([0.0, -0.00579], PHI_DELTA)]),
        PHI_DELTA,
    ),
    (place(A, &[([0.02308, 0.00916], DELTA)]), DELTA),
    (
        place(
            A,
            &[([0.0, -0.04], EPSILON), ([0.00579, 0.0], OMEGA_EPSILON)],
        ),
        OMEGA_EPSILON,
    ),
    (place(A, &[([-0.00449, -0.01228], EPSILON)]), EPSILON),
];
/// The point of the spring on K3.
const SPRING: Place = place(B, &[([0.02, -0.018], GAMMA)]);
/// What must stay zero: the end of K2 less that of K3, K4 and K6.
const LOOPS: [Place; 3] = [
    place(
        [-B[0], -B[1]],
        &[
            ([0.007, 0.0], BETA),
            ([-0.028, 0.0], BETA_THETA),
            ([0.0, 0.035], GAMMA),
        ],
    ),
    place(
        [-A[0], -A[1]],
        &[
            ([0.007, 0.0], BETA),
            ([-0.028, 0.0], BETA_THETA),
            ([0.0, 0.02], PHI_DELTA),
            ([-0.04, 0.0], DELTA),
        ],
    ),
    place(
        [-A[0], -A[1]],
        &[
            ([0.007, 0.0], BETA),
            ([-0.028, 0.0], BETA_THETA),
            ([-0.02, 0.0], OMEGA_EPSILON),
            ([0.0, 0.04], EPSILON),
        ],
    ),
];

const fn place(fixed: [f64; 2], turned: &'static [([f64; 2], u8)]) -> Place {
    Place { fixed, turned }
}

/// Directions and speeds of the seven sums of coordinates, found once.
struct Turned {
    sums: [(u8, f64, f64, f64); 7],
}

impl Turned {
    fn new(q: &[f64], v: &[f64]) -> Self {
        let masks = [
            BETA,
            BETA_THETA,
            GAMMA,
            DELTA,
            PHI_DELTA,
            EPSILON,
            OMEGA_EPSILON,
        ];
        Self {
            sums: masks.map(|mask| {
                let sum = |x: &[f64]| (0..7).filter(|k| mask >> k & 1 == 1).map(|k| x[k]).sum();
                let (angle, speed): (f64, f64) = (sum(q), sum(v));
                let (sin, cos) = angle.sin_cos();
                (mask, cos, sin, speed)
            }),
        }
    }

    /// The point, its derivatives by the coordinates, and its acceleration
    /// without that of the coordinates.
    fn place(&self, place: &Place) -> ([f64; 2], [[f64; 7]; 2], [f64; 2]) {
        let (mut at, mut slope, mut bias) = (place.fixed, [[0.0; 7]; 2], [0.0; 2]);
        for &([x, y], wanted) in place.turned {
            let index = match wanted {
                BETA => 0,
                BETA_THETA => 1,
                GAMMA => 2,
                DELTA => 3,
                PHI_DELTA => 4,
                EPSILON => 5,
                _ => 6,
            };
            let (mask, cos, sin, speed) = self.sums[index];
            let (u, v) = (cos * x - sin * y, sin * x + cos * y);
            at[0] += u;
            at[1] += v;
            bias[0] -= u * speed * speed;
            bias[1] -= v * speed * speed;
            for k in 0..7 {
                if mask >> k & 1 == 1 {
                    slope[0][k] -= v;
                    slope[1][k] += u;
                }
            }
        }
        (at, slope, bias)
    }
}

/// M q̈ + Gᵀλ = f, G q̈ = −Ġ q̇.
struct SevenCoordinates;

impl System<f64, SVector<f64, 14>> for SevenCoordinates {
    fn system(&self, _: f64, y: &SVector<f64, 14>, dy: &mut SVector<f64, 14>) {
        let (q, v) = y.as_slice().split_at(7);
        let turned = Turned::new(q, v);
        let mut matrix = SMatrix::<f64, 13, 13>::zeros();
        let mut right = SVector::<f64, 13>::zeros();
        for (k, (centre, mask)) in BODIES.iter().enumerate() {
            let (_, slope, bias) = turned.place(centre);
            let own = |i: usize| f64::from(mask >> i & 1);
            for i in 0..7 {
                for j in 0..7 {
                    let squares = slope[0][i] * slope[0][j] + slope[1][i] * slope[1][j];
                    matrix[(i, j)] += MASSES[k] * squares + MOMENTS[k] * own(i) * own(j);
                }
                right[i] -= MASSES[k] * (slope[0][i] * bias[0] + slope[1][i] * bias[1]);
            }
        }
        let (at, slope, _) = turned.place(&SPRING);
        let (dx, dy_spring) = (at[0] - C[0], at[1] - C[1]);
        let length = dx.hypot(dy_spring);
        let tension = RATE * (length - FREE_LENGTH) / length;
        for i in 0..7 {
            right[i] -= tension * (dx * slope[0][i] + dy_spring * slope[1][i]);
        }
        right[0] += TORQUE;
        for (k, closure) in LOOPS.iter().enumerate() {
            let (_, slope, bias) = turned.place(closure);
            for axis in 0..2 {
                let row = 7 + 2 * k + axis;
                for i in 0..7 {
                    matrix[(row, i)] = slope[axis][i];
                    matrix[(i, row)] = slope[axis][i];
                }
                right[row] = -bias[axis];
            }
        }
        let solved = matrix.lu().solve(&right);
        for i in 0..7 {
            dy[i] = v[i];
            dy[7 + i] = solved.map_or(f64::NAN, |solution| solution[i]);
        }
    }
}

// ---- the comparison

/// Error of β at the end, number of evaluations, best time of several runs (s).
fn measure<const N: usize, S: System<f64, SVector<f64, N>>>(
    system: impl Fn() -> S,
    start: SVector<f64, N>,
    tolerance: f64,
) -> (f64, u32, f64) {
    let mut best = f64::INFINITY;
    let mut result = (f64::NAN, 0);
    for _ in 0..15 {
        // With dense output the last sample of this version is wrong.
        let sparse = OutputType::Sparse;
        let mut stepper = Dop853::from_param(
            system(),
            0.0,
            DURATION,
            DURATION,
            start,
            tolerance,
            tolerance,
            0.9,
            0.0,
            0.333,
            6.0,
            DURATION,
            0.0,
            100_000,
            1000,
            sparse,
        );
        let begun = Instant::now();
        let statistics = stepper.integrate();
        best = best.min(begun.elapsed().as_secs_f64());
        let end = stepper.y_out().last().map_or(f64::NAN, |y| y[0]);
        let evaluations = statistics.map_or(0, |statistics| statistics.num_eval);
        result = ((end - END).abs(), evaluations);
    }
    (result.0, result.1, best)
}

fn main() {
    let linkage = linkage();
    let one = || OneCoordinate {
        linkage: &linkage,
        workspace: RefCell::new(linkage.workspace()),
    };
    let mut seven_start = SVector::<f64, 14>::zeros();
    seven_start.as_mut_slice()[..7].copy_from_slice(&START);
    // The time at which each comes to an error of 1e-6.
    let mut reached = [f64::INFINITY; 2];
    println!("tolerance   one coordinate: error, evaluations, ms   seven: error, evaluations, ms");
    for exponent in 4..=12 {
        let tolerance = 10f64.powi(-exponent);
        let found = [
            measure(one, SVector::from([START[0], 0.0]), tolerance),
            measure(|| SevenCoordinates, seven_start, tolerance),
        ];
        let cells = found.map(|(error, evaluations, time)| {
            format!("{error:9.1e} {evaluations:6} {:8.3}", 1e3 * time)
        });
        println!(
            "    1e-{exponent:02}   {}             {}",
            cells[0], cells[1]
        );
        for (reached, (error, _, time)) in reached.iter_mut().zip(found) {
            if error <= 1e-6 {
                *reached = reached.min(time);
            }
        }
    }
    println!(
        "to an error of 1e-6 in β: {:.3} ms and {:.3} ms, {:.1} times faster",
        1e3 * reached[0],
        1e3 * reached[1],
        reached[1] / reached[0]
    );
}
