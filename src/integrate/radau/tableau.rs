//! Coefficients of the Radau IIA methods, worked out from their definition.
//!
//! The nodes are the zeros of P_s(x) − P_{s−1}(x), P Legendre's polynomials moved
//! to [0, 1]; the last is 1. A integrates the polynomials through the stages. Its
//! eigenvalues, one real and the others in pairs (s is odd), decouple the stages:
//! E. Hairer and G. Wanner, Solving Ordinary Differential Equations II (1996),
//! IV.5 and IV.8, and Stiff differential equations solved by Radau methods,
//! Journal of Computational and Applied Mathematics 111 (1999).

use nalgebra::{Complex, DMatrix, DVector};

/// A square matrix by columns: `m[j][i]` stands in row i and column j.
pub(super) type Matrix<const S: usize> = [[f64; S]; S];

/// A matrix times a vector.
#[inline(always)]
pub(super) fn times<const S: usize>(matrix: &Matrix<S>, vector: &[f64; S]) -> [f64; S] {
    let mut out = [0.0; S];
    for (column, &factor) in matrix.iter().zip(vector) {
        for (out, entry) in out.iter_mut().zip(column) {
            *out += entry * factor;
        }
    }
    out
}

/// The coefficients of a method of S stages, L = (S + 1)/2.
#[derive(Clone, Debug)]
pub(super) struct Tableau<const S: usize, const L: usize> {
    /// Nodes c, ascending.
    pub(super) nodes: [f64; S],
    /// 1/Π(c_j − c_k), k ≠ j.
    pub(super) weights: [f64; S],
    /// A.
    pub(super) once: Matrix<S>,
    /// A².
    pub(super) twice: Matrix<S>,
    /// Eigenvalues of A, the real one first, then those above the real axis.
    pub(super) eigenvalues: [[f64; 2]; L],
    /// T, whose columns are the real eigenvector, and the real and imaginary parts
    /// of the others: vectors from what they are in terms of these.
    pub(super) eigenvectors: Matrix<S>,
    /// T⁻¹.
    pub(super) inverse: Matrix<S>,
    /// A·T and A²·T.
    pub(super) once_eigenvectors: Matrix<S>,
    pub(super) twice_eigenvectors: Matrix<S>,
    /// What a polynomial of degree s − 1 through the nodes is at 0.
    pub(super) at_start: [f64; S],
    /// The continuous output.
    pub(super) output: Output<S>,
}

/// A signal over the step from the rates at its start and at the nodes:
/// s(θ) = s₀ + h·∫ṡ, in Bernstein form of degree S + 2.
#[derive(Clone, Debug)]
pub(super) struct Output<const S: usize> {
    /// Of h·(ṡ_j − ṡ₀) for every node: what each adds to the coefficients.
    pub(super) rates: Vec<[f64; S]>,
    /// Of h²·(s̈₀ − what the polynomial through the rates has there): a term that is
    /// zero at the nodes and has an integral of zero.
    pub(super) bend: Vec<f64>,
    /// The greatest of these.
    pub(super) greatest_bend: f64,
    /// The slope at the start that the polynomial through the rates has, of
    /// ṡ_j − ṡ₀, times h.
    pub(super) slope: [f64; S],
}

impl<const S: usize, const L: usize> Tableau<S, L> {
    pub(super) fn new() -> Self {
        let nodes = nodes::<S>();
        let quadrature = Quadrature::new();
        let once: Matrix<S> = std::array::from_fn(|j| {
            std::array::from_fn(|i| quadrature.integral(nodes[i], |x| lagrange(&nodes, j, x)))
        });
        let twice = std::array::from_fn(|j| times(&once, &once[j]));
        let (eigenvalues, eigenvectors) = eigen(&once);
        let dense = DMatrix::from_fn(S, S, |i, j| eigenvectors[j][i]);
        let inverse = dense.try_inverse().expect("the eigenvalues are distinct");
        let difference = |j: usize, k: usize| if k == j { 1.0 } else { nodes[j] - nodes[k] };
        Self {
            nodes,
            weights: std::array::from_fn(|j| (0..S).map(|k| difference(j, k).recip()).product()),
            eigenvalues,
            inverse: std::array::from_fn(|j| std::array::from_fn(|i| inverse[(i, j)])),
            once_eigenvectors: std::array::from_fn(|j| times(&once, &eigenvectors[j])),
            twice_eigenvectors: std::array::from_fn(|j| times(&twice, &eigenvectors[j])),
            eigenvectors,
            at_start: std::array::from_fn(|j| lagrange(&nodes, j, 0.0)),
            output: Output::new(&nodes, &quadrature),
            once,
            twice,
        }
    }
}

impl<const S: usize> Output<S> {
    fn new(nodes: &[f64; S], quadrature: &Quadrature) -> Self {
        let mut all = vec![0.0];
        all.extend(nodes);
        // θ·Π(θ − c_i) with the slope 1 at its start.
        let product = |x: f64| nodes.iter().map(|c| 1.0 - x / c).product::<f64>();
        let rates: Vec<Vec<f64>> = (0..S)
            .map(|j| {
                bernstein(S + 2, &|to| {
                    quadrature.integral(to, |x| lagrange(&all, j + 1, x))
                })
            })
            .collect();
        // ℓ_j′(0) = 1/c_j · Π_{i≠j} c_i/(c_i − c_j)
        let slope: [f64; S] = std::array::from_fn(|j| lagrange(nodes, j, 0.0) / nodes[j]);
        let mut rates: Vec<[f64; S]> = (0..S + 3)
            .map(|k| std::array::from_fn(|j| rates[j][k]))
            .collect();
        let mut bend = bernstein(S + 2, &|to| quadrature.integral(to, |x| x * product(x)));
        // What is known of the start, without rounding: a guard that is zero there
        // must not seem to set out in another direction.
        let second = 1.0 / ((S + 2) * (S + 1)) as f64;
        rates[0] = [0.0; S];
        rates[1] = [0.0; S];
        rates[2] = slope.map(|slope| slope * second);
        bend[..3].copy_from_slice(&[0.0, 0.0, second]);
        Self {
            greatest_bend: bend.iter().fold(0.0, |most, c| most.max(c.abs())),
            rates,
            bend,
            slope,
        }
    }
}

/// The polynomial through points 1 at `points[j]` and 0 at the others.
fn lagrange(points: &[f64], j: usize, x: f64) -> f64 {
    let others = points.iter().enumerate().filter(|&(i, _)| i != j);
    others
        .map(|(_, point)| (x - point) / (points[j] - point))
        .product()
}

/// Bernstein coefficients of a polynomial of a degree given by its values.
fn bernstein(degree: usize, value: &dyn Fn(f64) -> f64) -> Vec<f64> {
    let binomial = |k: usize| -> f64 {
        (0..k)
            .map(|i| (degree - i) as f64 / (i + 1) as f64)
            .product()
    };
    // Points that crowd towards the ends keep the system well conditioned.
    let point = |i: usize| 0.5 - 0.5 * (std::f64::consts::PI * i as f64 / degree as f64).cos();
    let matrix = DMatrix::from_fn(degree + 1, degree + 1, |i, k| {
        let x = point(i);
        binomial(k) * x.powi(k as i32) * (1.0 - x).powi((degree - k) as i32)
    });
    let values = DVector::from_fn(degree + 1, |i, _| value(point(i)));
    let solution = matrix.lu().solve(&values);
    let solution = solution.expect("the points are distinct: the system is regular");
    solution.iter().copied().collect()
}

/// Legendre's polynomial of a degree on [0, 1].
fn legendre(degree: usize, x: f64) -> f64 {
    let x = 2.0 * x - 1.0;
    let (mut before, mut value) = (0.0, 1.0);
    for k in 0..degree {
        let k = k as f64;
        let next = ((2.0 * k + 1.0) * x * value - k * before) / (k + 1.0);
        (before, value) = (value, next);
    }
    value
}

/// Zeros within (0, 1) of a polynomial with simple zeros only, by halving.
fn zeros(f: &dyn Fn(f64) -> f64) -> Vec<f64> {
    const PARTS: usize = 499;
    let mut found = Vec::new();
    for part in 0..PARTS {
        let [mut low, mut high] =
            [part, part + 1].map(|k| (k as f64 + 0.01) / (PARTS as f64 + 1.0));
        let rises = f(high) > 0.0;
        if (f(low) > 0.0) == rises {
            continue;
        }
        while {
            let middle = 0.5 * (low + high);
            let outside = middle <= low || middle >= high;
            if (f(middle) > 0.0) == rises {
                high = middle;
            } else {
                low = middle;
            }
            !outside
        } {}
        found.push(0.5 * (low + high));
    }
    found
}

fn nodes<const S: usize>() -> [f64; S] {
    // Without its zero at 1 the polynomial keeps its digits near there.
    let inner = zeros(&|x| (legendre(S, x) - legendre(S - 1, x)) / (1.0 - x));
    std::array::from_fn(|i| inner.get(i).copied().unwrap_or(1.0))
}

/// Gauss' quadrature of six points.
struct Quadrature(Vec<(f64, f64)>);

impl Quadrature {
    const POINTS: usize = 6;

    fn new() -> Self {
        let weight = |x: f64| {
            let n = Self::POINTS as f64;
            let below = legendre(Self::POINTS - 1, x);
            let z = 2.0 * x - 1.0;
            (1.0 - z * z) / (n * n * below * below)
        };
        let points = zeros(&|x| legendre(Self::POINTS, x));
        Self(points.into_iter().map(|x| (x, weight(x))).collect())
    }

    /// The integral from 0 to a place; exact to degree 11.
    fn integral(&self, to: f64, f: impl Fn(f64) -> f64) -> f64 {
        self.0.iter().map(|(x, w)| to * w * f(to * x)).sum()
    }
}

/// Eigenvalues of A and the real form of its eigenvectors.
fn eigen<const S: usize, const L: usize>(once: &Matrix<S>) -> ([[f64; 2]; L], Matrix<S>) {
    let real = DMatrix::from_fn(S, S, |i, j| once[j][i]);
    let mut values: Vec<Complex<f64>> = real.complex_eigenvalues().iter().copied().collect();
    values.retain(|value| value.im > -1e-9);
    values.sort_by(|a, b| a.im.total_cmp(&b.im));
    let complex = real.map(|entry| Complex::new(entry, 0.0));
    let (mut eigenvalues, mut vectors) = ([[0.0; 2]; L], [[0.0; S]; S]);
    for (lane, mut value) in values.into_iter().take(L).enumerate() {
        if lane == 0 {
            value.im = 0.0;
        }
        // Inverse iteration, beside the eigenvalue so that the matrix is regular.
        let mut vector = DVector::from_fn(S, |i, _| Complex::new(1.0, 0.3 * i as f64));
        for _ in 0..3 {
            let beside = value * 1.000_001;
            let shifted = &complex - DMatrix::identity(S, S) * beside;
            let Some(next) = shifted.lu().solve(&vector) else {
                break;
            };
            vector = next.unscale(next.norm());
            value = vector.dotc(&(&complex * &vector));
        }
        // The last component real and one: the same every time.
        let last = vector[S - 1];
        let vector = vector.map(|entry| entry / last);
        eigenvalues[lane] = [value.re, if lane == 0 { 0.0 } else { value.im }];
        for i in 0..S {
            if lane == 0 {
                vectors[0][i] = vector[i].re;
            } else {
                vectors[2 * lane - 1][i] = vector[i].re;
                vectors[2 * lane][i] = vector[i].im;
            }
        }
    }
    (eigenvalues, vectors)
}

#[cfg(test)]
mod tests;
