//! The coefficients for any number of stages; compiled once for all of them.

use crate::math::order::Total;
use crate::math::quadrature::{legendre, rule, zeros};
use nalgebra::{Complex, DMatrix, DVector};

/// A square matrix by columns.
type Columns = Vec<Vec<f64>>;

/// What a [`Tableau`](super::Tableau) and its [`Output`](super::Output) hold, by the same names.
pub(super) struct Coefficients {
    pub(super) nodes: Vec<f64>,
    pub(super) weights: Vec<f64>,
    pub(super) once: Columns,
    pub(super) twice: Columns,
    pub(super) eigenvalues: Vec<[f64; 2]>,
    pub(super) eigenvectors: Columns,
    pub(super) inverse: Columns,
    pub(super) once_eigenvectors: Columns,
    pub(super) twice_eigenvectors: Columns,
    pub(super) at_start: Vec<f64>,
    /// By coefficients, then by nodes.
    pub(super) rates: Vec<Vec<f64>>,
    pub(super) bend: Vec<f64>,
    pub(super) greatest_bend: f64,
    pub(super) slope: Vec<f64>,
}

impl Coefficients {
    /// Coefficients of a number of stages, which is odd.
    pub(super) fn new(stages: usize) -> Self {
        let nodes = nodes(stages);
        let quadrature = Quadrature::new();
        let column = |j: usize| -> Vec<f64> {
            let value = |x: f64| lagrange(&nodes, j, x);
            let integral = |&to: &f64| quadrature.integral(to, &value);
            nodes.iter().map(integral).collect()
        };
        let once: Columns = (0..stages).map(column).collect();
        let twice = product(&once, &once);
        let (eigenvalues, eigenvectors) = eigen(&once);
        let difference = |j: usize, k: usize| if k == j { 1.0 } else { nodes[j] - nodes[k] };
        let weight = |j: usize| -> f64 {
            let factors = (0..stages).map(|k| difference(j, k).recip());
            factors.product()
        };
        let bend = bend(&nodes, &quadrature);
        // ℓ_j′(0) = 1/c_j · Π_{i≠j} c_i/(c_i − c_j)
        let at_start: Vec<f64> = (0..stages).map(|j| lagrange(&nodes, j, 0.0)).collect();
        let slope: Vec<f64> = (0..stages).map(|j| at_start[j] / nodes[j]).collect();
        Self {
            weights: (0..stages).map(weight).collect(),
            eigenvalues,
            inverse: inverse(&eigenvectors),
            once_eigenvectors: product(&once, &eigenvectors),
            twice_eigenvectors: product(&twice, &eigenvectors),
            eigenvectors,
            at_start,
            rates: rates(&nodes, &slope, &quadrature),
            greatest_bend: bend.iter().fold(0.0, |most, c| most.max(c.abs())),
            bend,
            slope,
            once,
            twice,
            nodes,
        }
    }
}

/// The product of two matrices.
fn product(one: &Columns, other: &Columns) -> Columns {
    let times = |vector: &Vec<f64>| {
        let mut out = vec![0.0; one.len()];
        for (column, &factor) in one.iter().zip(vector) {
            for (out, entry) in out.iter_mut().zip(column) {
                *out += entry * factor;
            }
        }
        out
    };
    other.iter().map(times).collect()
}

fn inverse(columns: &Columns) -> Columns {
    let size = columns.len();
    let dense = DMatrix::from_fn(size, size, |i, j| columns[j][i]);
    let inverse = dense.try_inverse().expect("the eigenvalues are distinct");
    let column = |j: usize| (0..size).map(|i| inverse[(i, j)]).collect();
    (0..size).map(column).collect()
}

/// The third Bernstein coefficient of a signal with s₀ = ṡ₀ = 0 and s̈₀ = 1. What is known
/// of the start is set without rounding: a guard that is zero there must not seem to set
/// out in another direction.
fn second(stages: usize) -> f64 {
    1.0 / ((stages + 2) * (stages + 1)) as f64
}

fn rates(nodes: &[f64], slope: &[f64], quadrature: &Quadrature) -> Vec<Vec<f64>> {
    let stages = nodes.len();
    let mut all = vec![0.0];
    all.extend(nodes);
    let by_node = |j: usize| {
        let value = |x: f64| lagrange(&all, j + 1, x);
        bernstein(stages + 2, &|to| quadrature.integral(to, &value))
    };
    let by_node: Columns = (0..stages).map(by_node).collect();
    let row = |k: usize| by_node.iter().map(|column| column[k]).collect();
    let mut rates: Vec<Vec<f64>> = (0..stages + 3).map(row).collect();
    rates[0] = vec![0.0; stages];
    rates[1] = vec![0.0; stages];
    rates[2] = slope.iter().map(|slope| slope * second(stages)).collect();
    rates
}

fn bend(nodes: &[f64], quadrature: &Quadrature) -> Vec<f64> {
    let stages = nodes.len();
    // θ·Π(θ − c_i) with the slope 1 at its start.
    let product = |x: f64| nodes.iter().map(|c| 1.0 - x / c).product::<f64>();
    let value = |x: f64| x * product(x);
    let mut bend = bernstein(stages + 2, &|to| quadrature.integral(to, &value));
    bend[..3].copy_from_slice(&[0.0, 0.0, second(stages)]);
    bend
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

fn nodes(stages: usize) -> Vec<f64> {
    // Without its zero at 1 the polynomial keeps its digits near there.
    let mut all = zeros(&|x| (legendre(stages, x) - legendre(stages - 1, x)) / (1.0 - x));
    all.push(1.0);
    all
}

/// Gauss' quadrature of six points.
struct Quadrature(Vec<(f64, f64)>);

impl Quadrature {
    const POINTS: usize = 6;

    fn new() -> Self {
        Self(rule(Self::POINTS))
    }

    /// The integral from 0 to a place; exact to degree 11.
    fn integral(&self, to: f64, f: &dyn Fn(f64) -> f64) -> f64 {
        self.0.iter().map(|(x, w)| to * w * f(to * x)).sum()
    }
}

/// Eigenvalues of A and the real form of its eigenvectors.
fn eigen(once: &Columns) -> (Vec<[f64; 2]>, Columns) {
    let stages = once.len();
    let real = DMatrix::from_fn(stages, stages, |i, j| once[j][i]);
    let mut values: Vec<Complex<f64>> = real.complex_eigenvalues().iter().copied().collect();
    values.retain(|value| value.im > -1e-9);
    values.sort_by_cached_key(|value| Total(value.im));
    let complex = real.map(|entry| Complex::new(entry, 0.0));
    let (mut eigenvalues, mut vectors) = (Vec::new(), Vec::new());
    for (lane, mut value) in values.into_iter().enumerate() {
        if lane == 0 {
            value.im = 0.0;
        }
        // Inverse iteration, beside the eigenvalue so that the matrix is regular.
        let mut vector = DVector::from_fn(stages, |i, _| Complex::new(1.0, 0.3 * i as f64));
        for _ in 0..3 {
            let beside = value * 1.000_001;
            let shifted = &complex - DMatrix::identity(stages, stages) * beside;
            let Some(next) = shifted.lu().solve(&vector) else {
                break;
            };
            vector = next.unscale(next.norm());
            value = vector.dotc(&(&complex * &vector));
        }
        // The last component real and one: the same every time.
        let last = vector[stages - 1];
        let vector = vector.map(|entry| entry / last);
        vectors.push(vector.iter().map(|entry| entry.re).collect());
        if lane == 0 {
            eigenvalues.push([value.re, 0.0]);
        } else {
            eigenvalues.push([value.re, value.im]);
            vectors.push(vector.iter().map(|entry| entry.im).collect());
        }
    }
    (eigenvalues, vectors)
}
