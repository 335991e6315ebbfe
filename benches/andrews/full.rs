//! The squeezing mechanism in seven coordinates with six multipliers, index 1.

use ode_solvers::SVector;

pub(crate) const START: [f64; 7] = [
    -0.06171389001427645,
    0.0,
    0.45527981916307038,
    0.22266839016588588,
    0.48736497954384255,
    -0.22266839016588588,
    1.2305474445498212,
];

/// The full equations, state [p, ṗ], and how they are solved.
#[derive(Clone, Copy)]
pub(crate) enum Full {
    /// Thirteen unknowns by elimination with pivots.
    General,
    /// By blocks, made for this mechanism.
    Blocks,
}

const MASS: [f64; 7] = [
    0.04325, 0.00365, 0.02373, 0.00706, 0.07050, 0.00706, 0.05498,
];
const INERTIA: [f64; 7] = [
    2.194e-6, 4.410e-7, 5.255e-6, 5.667e-7, 1.169e-5, 5.667e-7, 1.912e-5,
];
const D: f64 = 0.028;
const DA: f64 = 0.0115;
const E: f64 = 0.02;
const EA: f64 = 0.01421;
const RR: f64 = 0.007;
const RA: f64 = 0.00092;
const SS: f64 = 0.035;
const SA: f64 = 0.01874;
const SB: f64 = 0.01043;
const SC: f64 = 0.018;
const SD: f64 = 0.02;
const TA: f64 = 0.02308;
const TB: f64 = 0.00916;
const U: f64 = 0.04;
const UA: f64 = 0.01228;
const UB: f64 = 0.00449;
const ZF: f64 = 0.02;
const ZT: f64 = 0.04;
const FA: f64 = 0.01421;
const C: [f64; 2] = [0.014, 0.072];
const B: [f64; 2] = [-0.03635, 0.03273];
const RATE: f64 = 4530.0;
const FREE: f64 = 0.07785;
const TORQUE: f64 = 0.033;

impl ode_solvers::System<f64, SVector<f64, 14>> for Full {
    fn system(&self, _: f64, y: &SVector<f64, 14>, dy: &mut SVector<f64, 14>) {
        let p: [f64; 7] = std::array::from_fn(|i| y[i]);
        let v: [f64; 7] = std::array::from_fn(|i| y[7 + i]);
        let a = accelerations(*self, &p, &v);
        for i in 0..7 {
            dy[i] = v[i];
            dy[7 + i] = a[i];
        }
    }
}

/// Inverse of a symmetric block of two, [a, b, c] for [[a, b], [b, c]].
fn inverse([a, b, c]: [f64; 3]) -> [f64; 3] {
    let scale = 1.0 / (a * c - b * b);
    [c * scale, -b * scale, a * scale]
}

fn accelerations(how: Full, p: &[f64; 7], v: &[f64; 7]) -> [f64; 7] {
    let [be, th, ga, ph, de, om, ep] = *p;
    let [bep, thp, gap, php, dep, omp, epp] = *v;
    let (sibe, cobe) = be.sin_cos();
    let (sith, coth) = th.sin_cos();
    let (siga, coga) = ga.sin_cos();
    let (siph, coph) = ph.sin_cos();
    let (side, code) = de.sin_cos();
    let (siom, coom) = om.sin_cos();
    let (siep, coep) = ep.sin_cos();
    let (sibeth, cobeth) = (be + th).sin_cos();
    let (siphde, cophde) = (ph + de).sin_cos();
    let (siomep, coomep) = (om + ep).sin_cos();
    // The mass matrix: blocks (β, Θ), γ, (Φ, δ), (Ω, ε).
    let [m1, m2, m3, m4, m5, m6, m7] = MASS;
    let [i1, i2, i3, i4, i5, i6, i7] = INERTIA;
    let (e, z) = (E - EA, ZF - FA);
    let first = [
        m1 * RA * RA + m2 * (RR * RR - 2.0 * DA * RR * coth + DA * DA) + i1 + i2,
        m2 * (DA * DA - DA * RR * coth) + i2,
        m2 * DA * DA + i2,
    ];
    let second = m3 * (SA * SA + SB * SB) + i3;
    let third = [
        m4 * e * e + i4,
        m4 * (e * e + ZT * e * siph) + i4,
        m4 * (ZT * ZT + 2.0 * ZT * e * siph + e * e) + m5 * (TA * TA + TB * TB) + i4 + i5,
    ];
    let fourth = [
        m6 * z * z + i6,
        m6 * (z * z - U * z * siom) + i6,
        m6 * (z * z - 2.0 * U * z * siom + U * U) + m7 * (UA * UA + UB * UB) + i6 + i7,
    ];
    let (xd, yd) = (SD * coga + SC * siga + B[0], SD * siga - SC * coga + B[1]);
    let length = (xd - C[0]).hypot(yd - C[1]);
    let force = -RATE * (length - FREE) / length;
    let (fx, fy) = (force * (xd - C[0]), force * (yd - C[1]));
    let f = [
        TORQUE - m2 * DA * RR * thp * (thp + 2.0 * bep) * sith,
        m2 * DA * RR * bep * bep * sith,
        fx * (SC * coga - SD * siga) + fy * (SD * coga + SC * siga),
        m4 * ZT * e * dep * dep * coph,
        -m4 * ZT * e * php * (php + 2.0 * dep) * coph,
        -m6 * U * z * epp * epp * coom,
        m6 * U * z * omp * (omp + 2.0 * epp) * coom,
    ];
    // Rows of the constraints' Jacobian.
    let (b1, b2) = (-RR * sibe + D * sibeth, RR * cobe - D * cobeth);
    let (t1, t2) = (D * sibeth, -D * cobeth);
    let g: [[f64; 7]; 6] = [
        [b1, t1, -SS * coga, 0.0, 0.0, 0.0, 0.0],
        [b2, t2, -SS * siga, 0.0, 0.0, 0.0, 0.0],
        [b1, t1, 0.0, -E * cophde, -E * cophde + ZT * side, 0.0, 0.0],
        [b2, t2, 0.0, -E * siphde, -E * siphde - ZT * code, 0.0, 0.0],
        [b1, t1, 0.0, 0.0, 0.0, ZF * siomep, ZF * siomep - U * coep],
        [b2, t2, 0.0, 0.0, 0.0, -ZF * coomep, -ZF * coomep - U * siep],
    ];
    // −Ġ·ṗ.
    let (w, q, r) = (bep + thp, php + dep, omp + epp);
    let crank = [
        RR * cobe * bep * bep - D * cobeth * w * w,
        RR * sibe * bep * bep - D * sibeth * w * w,
    ];
    let gamma = [
        crank[0] - SS * siga * gap * gap,
        crank[1] + SS * coga * gap * gap,
        crank[0] - E * siphde * q * q - ZT * code * dep * dep,
        crank[1] + E * cophde * q * q - ZT * side * dep * dep,
        crank[0] - ZF * coomep * r * r - U * siep * epp * epp,
        crank[1] - ZF * siomep * r * r + U * coep * epp * epp,
    ];
    let blocks = Blocks {
        pairs: [first, third, fourth],
        single: second,
    };
    match how {
        Full::General => eliminate(&blocks, &g, &f, &gamma),
        Full::Blocks => by_blocks(&blocks, &g, &f, &gamma),
    }
}

/// The mass matrix: (β, Θ), (Φ, δ), (Ω, ε), and γ by itself.
struct Blocks {
    pairs: [[f64; 3]; 3],
    single: f64,
}

/// [M Gᵀ; G 0]·[p̈; λ] = [f; γ] by elimination with partial pivoting.
fn eliminate(blocks: &Blocks, g: &[[f64; 7]; 6], f: &[f64; 7], gamma: &[f64; 6]) -> [f64; 7] {
    let mut a = [[0.0; 14]; 13];
    for (&[one, both, other], i) in blocks.pairs.iter().zip([0, 3, 5]) {
        a[i][i] = one;
        (a[i][i + 1], a[i + 1][i]) = (both, both);
        a[i + 1][i + 1] = other;
    }
    a[2][2] = blocks.single;
    for i in 0..6 {
        for j in 0..7 {
            (a[7 + i][j], a[j][7 + i]) = (g[i][j], g[i][j]);
        }
        a[7 + i][13] = gamma[i];
    }
    for i in 0..7 {
        a[i][13] = f[i];
    }
    for column in 0..13 {
        let mut pivot = column;
        for row in column + 1..13 {
            if a[row][column].abs() > a[pivot][column].abs() {
                pivot = row;
            }
        }
        a.swap(column, pivot);
        let top = a[column];
        for row in &mut a[column + 1..] {
            let factor = row[column] / top[column];
            if factor != 0.0 {
                for k in column + 1..14 {
                    row[k] -= factor * top[k];
                }
            }
        }
    }
    let mut x = [0.0; 13];
    for i in (0..13).rev() {
        let known: f64 = (i + 1..13).map(|k| a[i][k] * x[k]).sum();
        x[i] = (a[i][13] - known) / a[i][i];
    }
    std::array::from_fn(|i| x[i])
}

/// The same by M⁻¹ and (G·M⁻¹·Gᵀ)·λ = G·M⁻¹·f − γ.
fn by_blocks(blocks: &Blocks, g: &[[f64; 7]; 6], f: &[f64; 7], gamma: &[f64; 6]) -> [f64; 7] {
    let [first, third, fourth] = blocks.pairs.map(inverse);
    let second = 1.0 / blocks.single;
    let solve = |x: &[f64; 7]| -> [f64; 7] {
        [
            first[0] * x[0] + first[1] * x[1],
            first[1] * x[0] + first[2] * x[1],
            second * x[2],
            third[0] * x[3] + third[1] * x[4],
            third[1] * x[3] + third[2] * x[4],
            fourth[0] * x[5] + fourth[1] * x[6],
            fourth[1] * x[5] + fourth[2] * x[6],
        ]
    };
    let free = solve(f);
    let rows: [[f64; 7]; 6] = std::array::from_fn(|i| solve(&g[i]));
    let dot = |a: &[f64; 7], b: &[f64; 7]| -> f64 { (0..7).map(|k| a[k] * b[k]).sum() };
    let mut s = [[0.0; 6]; 6];
    let mut lambda = [0.0; 6];
    for i in 0..6 {
        for j in 0..=i {
            s[i][j] = dot(&g[i], &rows[j]);
        }
        lambda[i] = dot(&g[i], &free) - gamma[i];
    }
    for j in 0..6 {
        for k in 0..j {
            s[j][j] -= s[j][k] * s[j][k];
        }
        s[j][j] = s[j][j].sqrt();
        for i in j + 1..6 {
            for k in 0..j {
                s[i][j] -= s[i][k] * s[j][k];
            }
            s[i][j] /= s[j][j];
        }
    }
    for i in 0..6 {
        for k in 0..i {
            lambda[i] -= s[i][k] * lambda[k];
        }
        lambda[i] /= s[i][i];
    }
    for i in (0..6).rev() {
        for k in i + 1..6 {
            lambda[i] -= s[k][i] * lambda[k];
        }
        lambda[i] /= s[i][i];
    }
    std::array::from_fn(|k| free[k] - (0..6).map(|i| rows[i][k] * lambda[i]).sum::<f64>())
}
