//! Dense matrices of a part: what elimination along the tree cannot give.
//!
//! In the coordinates u = √J·q the state y = (u, u̇/ω₀) moves as ẏ = ω₀·A·y,
//!
//! A = [0, 1; −K̃/ω₀², −B̃/ω₀],  K̃ = J^{-½} K J^{-½},  B̃ likewise.
//!
//! Used for clusters of eigenvalues and where the iteration on det Q finds
//! none; the cost is that of a dense decomposition, once a regime.

use super::basis::{Lane, LaneKind};
use super::pencil::{C, Node, Pencil};
use crate::math::order::Total;
use nalgebra::{DMatrix, Schur, SymmetricEigen};

/// Sweeps of the inverse iteration: a factor of about ten each.
const SWEEPS: usize = 20;

impl Pencil {
    /// True when anything is damped.
    pub(crate) fn damped(&self) -> bool {
        self.nodes
            .iter()
            .any(|n| n.damping > 0.0 || n.ground_damping > 0.0)
    }

    /// J^{-½}·(Dᵀ·diag(link)·D + diag(ground))·J^{-½}.
    pub(super) fn scaled(
        &self,
        link: impl Fn(&Node) -> f64,
        ground: impl Fn(&Node) -> f64,
    ) -> DMatrix<f64> {
        let n = self.nodes.len();
        let mut out = DMatrix::<f64>::zeros(n, n);
        for (i, node) in self.nodes.iter().enumerate() {
            let f = link(node);
            out[(i, i)] += ground(node) + f;
            if let Some(p) = node.parent {
                out[(p, p)] += node.lever * node.lever * f;
                out[(i, p)] -= node.lever * f;
                out[(p, i)] -= node.lever * f;
            }
        }
        let root: Vec<f64> = self.nodes.iter().map(|node| node.inertia.sqrt()).collect();
        for i in 0..n {
            for j in 0..n {
                out[(i, j)] /= root[i] * root[j];
            }
        }
        out
    }

    /// A for the rate ω₀ (1/s).
    fn companion_matrix(&self, rate: f64) -> DMatrix<f64> {
        let n = self.nodes.len();
        let k = self.scaled(|n| n.stiffness, |n| n.ground_stiffness);
        let b = self.scaled(|n| n.damping, |n| n.ground_damping);
        let mut a = DMatrix::<f64>::zeros(2 * n, 2 * n);
        for i in 0..n {
            a[(i, n + i)] = 1.0;
            for j in 0..n {
                a[(n + i, j)] = -k[(i, j)] / (rate * rate);
                a[(n + i, n + j)] = -b[(i, j)] / rate;
            }
        }
        a
    }

    /// All eigenvalues but the `zeros` least, from the real Schur form: pairs
    /// come out as exact conjugates. Absolute error about 10⁻¹⁶ of the greatest.
    pub(super) fn schur_eigenvalues(&self, zeros: usize) -> Option<Vec<C>> {
        let k = self.scaled(|n| n.stiffness, |n| n.ground_stiffness);
        let rate = k.diagonal().max().sqrt();
        if !(rate > 0.0 && rate.is_finite()) {
            return None;
        }
        let schur = Schur::try_new(self.companion_matrix(rate), f64::EPSILON, 20_000)?;
        let mut all: Vec<C> = schur.complex_eigenvalues().iter().copied().collect();
        all.sort_by_cached_key(|l| Total(l.norm()));
        Some(all[zeros..].iter().map(|l| l * rate).collect())
    }
}

/// Lanes of the `count` undamped modes whose frequencies are nearest to `omega`
/// (rad/s): the eigenvectors of a symmetric matrix, orthogonal whatever
/// coincides.
pub(super) fn undamped_modes(pencil: &Pencil, omega: f64, count: usize) -> Option<Vec<Lane>> {
    let n = pencil.nodes.len();
    let eigen = SymmetricEigen::try_new(
        pencil.scaled(|n| n.stiffness, |n| n.ground_stiffness),
        f64::EPSILON,
        20_000,
    )?;
    let mut order: Vec<usize> = (0..n).collect();
    let far = |i: &usize| (eigen.eigenvalues[*i].max(0.0).sqrt() - omega).abs();
    order.sort_by_cached_key(|column| Total(far(column)));
    let lane = |&column: &usize| {
        let u = eigen.eigenvectors.column(column);
        let x: Vec<f64> = (0..n)
            .map(|i| u[i] / pencil.nodes[i].inertia.sqrt())
            .collect();
        // Rayleigh's quotient link by link: no stiffness cancels.
        let energy: f64 = pencil
            .nodes
            .iter()
            .enumerate()
            .map(|(i, node)| {
                let d = x[i] - node.parent.map_or(0.0, |p| node.lever * x[p]);
                node.stiffness * d * d + node.ground_stiffness * x[i] * x[i]
            })
            .sum();
        let lambda = C::new(0.0, energy.sqrt());
        // ν = 2λ·xᵀJx = 2λ.
        let inertia = |i: usize| C::from(x[i] * pencil.nodes[i].inertia);
        Lane {
            kind: LaneKind::Mode,
            lambda,
            shape: x.iter().map(|x| C::from(*x)).collect(),
            row_q: (0..n).map(inertia).collect(),
            row_v: (0..n).map(|i| inertia(i) / lambda).collect(),
            row_f: x.iter().map(|x| C::from(*x) / lambda).collect(),
        }
    };
    (count <= n).then(|| order[..count].iter().map(lane).collect())
}

/// The invariant subspace of a cluster.
#[derive(Clone, Debug)]
pub(super) struct Subspace {
    /// Right basis by mass: q = x·a.
    x: DMatrix<C>,
    /// Left basis: a = wq·q + wv·q̇, ȧ = T·a + wf·f.
    wq: DMatrix<C>,
    wv: DMatrix<C>,
    wf: DMatrix<C>,
    /// T (1/s).
    pub(super) t: DMatrix<C>,
    real: bool,
}

impl Subspace {
    /// That of the `m` eigenvalues about `mean`, the next being `gap` away, by
    /// inverse iteration from both sides.
    pub(super) fn new(pencil: &Pencil, mean: C, gap: f64, m: usize, real: bool) -> Option<Self> {
        let n = pencil.nodes.len();
        let rate = mean.norm();
        let a = pencil.companion_matrix(rate).map(C::from);
        let shift = mean / rate + 0.03 * gap.min(rate) / rate;
        let shifted = &a - DMatrix::from_diagonal_element(2 * n, 2 * n, shift);
        let right = shifted.clone().lu();
        let left = shifted.transpose().lu();
        let (mut x, mut y) = (start(2 * n, m), start(2 * n, m));
        for _ in 0..SWEEPS {
            x = right.solve(&x)?;
            orthonormal(&mut x);
            y = left.solve(&y)?;
            orthonormal(&mut y);
        }
        let w = &y * (y.transpose() * &x).try_inverse()?.transpose();
        // (A − s)⁻¹ = X(T − s)⁻¹Wᵀ on the subspace: no large entry of A counts.
        let inverse = (w.transpose() * right.solve(&x)?).try_inverse()?;
        let mut t = (inverse + DMatrix::from_diagonal_element(m, m, shift)) * C::from(rate);
        let (mut x, mut w) = (x, w);
        if real {
            for matrix in [&mut t, &mut x, &mut w] {
                matrix.apply(|c| c.im = 0.0);
            }
        }
        let root = |i: usize| pencil.nodes[i].inertia.sqrt();
        let out = Self {
            x: DMatrix::from_fn(n, m, |i, j| x[(i, j)] / root(i)),
            wq: DMatrix::from_fn(n, m, |i, j| w[(i, j)] * root(i)),
            wv: DMatrix::from_fn(n, m, |i, j| w[(n + i, j)] * (root(i) / rate)),
            wf: DMatrix::from_fn(n, m, |i, j| w[(n + i, j)] / (root(i) * rate)),
            t,
            real,
        };
        let finite = |m: &DMatrix<C>| m.iter().all(|c| c.re.is_finite() && c.im.is_finite());
        (finite(&out.t) && finite(&out.x) && finite(&out.wq)).then_some(out)
    }

    /// Mean eigenvalue.
    pub(super) fn mean(&self) -> C {
        self.t.trace() / self.t.nrows() as f64
    }

    /// Plain modes: T = S·diag(values)·S⁻¹.
    pub(super) fn plain_modes(&self, split: &Split) -> Vec<Lane> {
        let factor = if self.real { 1.0 } else { 2.0 };
        self.lanes(&split.values, &split.vectors, &split.inverse, factor)
    }

    /// One lane a column of `right`: shape x·right, rows left·w, times `factor`.
    pub(super) fn lanes(
        &self,
        values: &[C],
        right: &DMatrix<C>,
        left: &DMatrix<C>,
        factor: f64,
    ) -> Vec<Lane> {
        let shape = &self.x * right;
        let rows = [&self.wq, &self.wv, &self.wf].map(|w| w * left.transpose() * C::from(factor));
        let column = |m: &DMatrix<C>, j: usize| m.column(j).iter().copied().collect();
        values
            .iter()
            .enumerate()
            .map(|(j, lambda)| Lane {
                kind: LaneKind::Mode,
                lambda: *lambda,
                shape: column(&shape, j),
                row_q: column(&rows[0], j),
                row_v: column(&rows[1], j),
                row_f: column(&rows[2], j),
            })
            .collect()
    }
}

/// A start for the iteration that favours no mass.
fn start(rows: usize, columns: usize) -> DMatrix<C> {
    DMatrix::from_fn(rows, columns, |i, j| {
        C::from((1.0 + 1.618 * (i + 1) as f64 * (j + 1) as f64).cos() + 0.1)
    })
}

/// Gram and Schmidt's process, twice.
fn orthonormal(x: &mut DMatrix<C>) {
    for j in 0..x.ncols() {
        for _ in 0..2 {
            for k in 0..j {
                let share = x.column(k).dotc(&x.column(j));
                let other = x.column(k).clone_owned();
                x.column_mut(j).axpy(-share, &other, C::new(1.0, 0.0));
            }
        }
        let norm = x.column(j).norm();
        x.column_mut(j).unscale_mut(norm);
    }
}

/// T = vectors·diag(values)·inverse.
#[derive(Clone, Debug)]
pub(super) struct Split {
    pub(super) values: Vec<C>,
    pub(super) vectors: DMatrix<C>,
    pub(super) inverse: DMatrix<C>,
    /// ‖vectors‖·‖inverse‖.
    pub(super) condition: f64,
}

impl Split {
    /// A multiple of 1.
    pub(super) fn scalar(value: C, m: usize) -> Self {
        Self {
            values: vec![value; m],
            vectors: DMatrix::identity(m, m),
            inverse: DMatrix::identity(m, m),
            condition: 1.0,
        }
    }

    /// Eigenvalues and eigenvectors of a small matrix; `None` when it has not
    /// as many independent vectors. With `real`, imaginary parts that are
    /// rounding are dropped.
    pub(super) fn of(t: &DMatrix<C>, real: bool) -> Option<Self> {
        let m = t.nrows();
        let (q, r) = Schur::try_new(t.clone(), f64::EPSILON, 2_000)?.unpack();
        let mut values: Vec<C> = r.diagonal().iter().copied().collect();
        let mut vectors = DMatrix::<C>::zeros(m, m);
        for j in 0..m {
            let mut z = vec![C::default(); m];
            z[j] = C::new(1.0, 0.0);
            for i in (0..j).rev() {
                let sum: C = (i + 1..=j).map(|k| r[(i, k)] * z[k]).sum();
                z[i] = sum / (values[j] - values[i]);
            }
            let full = &q * nalgebra::DVector::from_vec(z);
            let peak = full[full.icamax()];
            vectors.set_column(j, &(full / peak));
        }
        if real {
            let size = values.iter().fold(0.0f64, |s, l| s.max(l.norm()));
            for value in values.iter_mut().filter(|l| l.im.abs() < 1e-13 * size) {
                value.im = 0.0;
            }
            if values.iter().all(|l| l.im == 0.0) {
                vectors.apply(|c| c.im = 0.0);
            }
        }
        let inverse = vectors.clone().try_inverse()?;
        let condition = vectors.norm() * inverse.norm();
        condition.is_finite().then_some(Self {
            values,
            vectors,
            inverse,
            condition,
        })
    }
}
