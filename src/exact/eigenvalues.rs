//! The eigenvalues of a pencil: Ehrlich–Aberth iteration on the logarithmic
//! derivative of det Q, from the undamped frequencies, checked against the trace.

use super::pencil::{C, Node, Pencil};
use crate::math::order::{Total, by_first};
use nalgebra::{DMatrix, SymmetricEigen};

/// Why eigenvalues were refused.
#[derive(Clone, Debug, PartialEq)]
pub(crate) struct NotFound;

impl Pencil {
    /// (det Q)'/det Q; `room` is for the impedances.
    fn log_derivative(&self, lambda: C, room: &mut Vec<[C; 2]>) -> C {
        self.impedances(lambda, room);
        let mut sum = C::new(0.0, 0.0);
        for (n, [own, slope]) in self.nodes.iter().zip(&*room) {
            let k = lambda * n.damping + n.stiffness;
            sum += (slope + n.damping) / (k + own);
        }
        sum
    }

    /// Undamped frequencies ω and damping ratios to first order, ascending.
    fn first_guess(&self) -> Vec<(f64, f64)> {
        let n = self.nodes.len();
        let k = self.scaled(|node| node.stiffness, |node| node.ground_stiffness);
        let b = self.scaled(|node| node.damping, |node| node.ground_damping);
        if n == 2 {
            return two(&k, &b).into();
        }
        let eigen = SymmetricEigen::new(k);
        let mut guess: Vec<(f64, f64)> = (0..n)
            .map(|j| {
                let x = eigen.eigenvectors.column(j);
                let damping = (x.transpose() * &b * x)[(0, 0)];
                (eigen.eigenvalues[j].max(0.0).sqrt(), damping / 2.0)
            })
            .collect();
        by_first(&mut guess);
        guess
    }

    /// All eigenvalues but the zero ones, upper half-plane only: complex ones
    /// stand for their conjugate too, real ones for themselves.
    pub(crate) fn eigenvalues(&self) -> Result<Vec<C>, NotFound> {
        let floats = self.floats();
        let zeros = match (floats, self.has_damped_rigid_motion()) {
            (false, _) => 0,
            (true, false) => 2,
            (true, true) => 1,
        };
        if let ([node], 0) = (&self.nodes[..], zeros) {
            return Ok(roots_of_single_node(node));
        }
        let guess = self.first_guess();
        let elastic = &guess[usize::from(floats)..];
        let light = elastic.iter().all(|(omega, decay)| *decay < 0.7 * omega);
        let roots = if light && zeros != 1 {
            let start = elastic
                .iter()
                .map(|&(omega, decay)| C::new(-decay, (omega * omega - decay * decay).sqrt()));
            self.aberth(start.collect(), zeros, true)
        } else {
            self.aberth(self.full_start(&guess, zeros), zeros, false)
        };
        roots
            .and_then(|roots| self.checked(roots, zeros))
            .or_else(|_| self.fallback(zeros))
    }

    /// Eigenvalues from the dense matrix, those that stand alone polished on
    /// det Q: for modes that coincide, on which the iteration stalls.
    fn fallback(&self, zeros: usize) -> Result<Vec<C>, NotFound> {
        let mut all = self.schur_eigenvalues(zeros).ok_or(NotFound)?;
        let mut room = Vec::new();
        for i in 0..all.len() {
            if all[i].im < 0.0 {
                continue;
            }
            for _ in 0..4 {
                let z = all[i];
                let mut repulsion = z.inv() * zeros as f64;
                let mut near = f64::INFINITY;
                for (_, other) in all.iter().enumerate().filter(|(j, _)| *j != i) {
                    repulsion += (z - other).inv();
                    near = near.min((z - other).norm());
                }
                let step = (self.log_derivative(z, &mut room) - repulsion).inv();
                if near < 1e-3 * z.norm() || step.norm().is_nan() || step.norm() > 0.01 * near {
                    break;
                }
                let real = z.im == 0.0;
                all[i] = z - if real { C::from(step.re) } else { step };
                if let Some(pair) = all.iter().position(|l| *l == z.conj()).filter(|_| !real) {
                    all[pair] = all[i].conj();
                }
            }
        }
        let upper = all.iter().filter(|l| l.im > 0.0).count();
        let lower = all.iter().filter(|l| l.im < 0.0).count();
        if upper != lower || all.iter().any(|l| !l.norm().is_finite()) {
            return Err(NotFound);
        }
        all.retain(|l| l.im >= 0.0);
        all.sort_by_cached_key(|l| [l.norm(), l.re].map(Total));
        Ok(all)
    }

    /// Starting points for all roots when some are overdamped.
    fn full_start(&self, guess: &[(f64, f64)], zeros: usize) -> Vec<C> {
        let mut start = Vec::new();
        for (index, &(omega, decay)) in guess.iter().enumerate() {
            if index == 0 && self.floats() {
                if zeros == 1 {
                    start.push(C::new(-2.0 * decay, 0.01 * decay));
                }
                continue;
            }
            if decay < omega {
                let s = (omega * omega - decay * decay).sqrt();
                // A little apart from each other's conjugates, so that they can part.
                start.push(C::new(-decay * 1.01, s + 0.01 * omega));
                start.push(C::new(-decay * 0.99, -s + 0.003 * omega));
            } else {
                let s = (decay * decay - omega * omega).sqrt();
                let fast = decay + s;
                start.push(C::new(-fast, 0.01 * fast));
                start.push(C::new(-omega * omega / fast, 0.01 * omega * omega / fast));
            }
        }
        start
    }

    /// Ehrlich–Aberth iteration on all roots at once. With `halves` each root
    /// stands for its conjugate too.
    fn aberth(&self, mut z: Vec<C>, zeros: usize, halves: bool) -> Result<Vec<C>, NotFound> {
        let mut done = vec![false; z.len()];
        let mut room = Vec::new();
        for _ in 0..200 {
            for i in 0..z.len() {
                if done[i] {
                    continue;
                }
                let mut repulsion = z[i].inv() * zeros as f64;
                if halves {
                    repulsion += (z[i] - z[i].conj()).inv();
                }
                for (j, other) in z.iter().enumerate() {
                    if j != i {
                        repulsion += (z[i] - other).inv();
                        if halves {
                            repulsion += (z[i] - other.conj()).inv();
                        }
                    }
                }
                let step = (self.log_derivative(z[i], &mut room) - repulsion).inv();
                // An iterate exactly on a root makes det 0 and the step 0/0.
                if !(step.re.is_finite() && step.im.is_finite()) {
                    done[i] = true;
                    continue;
                }
                z[i] -= step;
                done[i] = step.norm() <= 2e-15 * z[i].norm();
            }
            if done.iter().all(|d| *d) {
                break;
            }
        }
        if z.iter().all(|r| r.re.is_finite() && r.im.is_finite()) {
            Ok(z)
        } else {
            Err(NotFound)
        }
    }

    /// Pairs up the roots and checks them against the trace: Σλ = −ΣB_ii/J_i.
    fn checked(&self, roots: Vec<C>, zeros: usize) -> Result<Vec<C>, NotFound> {
        let mut out: Vec<C> = Vec::with_capacity(roots.len());
        let halves = roots.len() + zeros / 2 == self.nodes.len() && zeros != 1;
        for root in roots {
            if root.im.abs() <= 1e-9 * root.norm() && !halves {
                out.push(C::new(root.re, 0.0));
            } else if root.im > 0.0 {
                out.push(root);
            } else if halves {
                return Err(NotFound);
            }
        }
        let mut trace = 0.0;
        for node in &self.nodes {
            trace += (node.damping + node.ground_damping) / node.inertia;
            if let Some(p) = node.parent {
                trace += node.lever * node.lever * node.damping / self.nodes[p].inertia;
            }
        }
        let count: usize = out.iter().map(|r| if r.im > 0.0 { 2 } else { 1 }).sum();
        let sum: f64 = out
            .iter()
            .map(|r| if r.im > 0.0 { 2.0 * r.re } else { r.re })
            .sum();
        let scale = out.iter().fold(0.0f64, |m, r| m.max(r.norm()));
        if count + zeros != 2 * self.nodes.len() || (sum + trace).abs() > 1e-9 * scale {
            return Err(NotFound);
        }
        out.sort_by_cached_key(|l| [l.norm(), l.re].map(Total));
        Ok(out)
    }
}

/// The guess of two masses, from the rotation that makes the symmetric `k` diagonal.
fn two(k: &DMatrix<f64>, b: &DMatrix<f64>) -> [(f64, f64); 2] {
    let (mean, half) = (0.5 * (k[(0, 0)] + k[(1, 1)]), 0.5 * (k[(0, 0)] - k[(1, 1)]));
    let radius = half.hypot(k[(0, 1)]);
    let (sin, cos) = (0.5 * k[(0, 1)].atan2(half)).sin_cos();
    // The smaller one without cancellation.
    let determinant = k[(0, 0)] * k[(1, 1)] - k[(0, 1)] * k[(0, 1)];
    let pairs = [
        (determinant / (mean + radius), [-sin, cos]),
        (mean + radius, [cos, sin]),
    ];
    pairs.map(|(square, [x, y])| {
        let damping = x * x * b[(0, 0)] + 2.0 * x * y * b[(0, 1)] + y * y * b[(1, 1)];
        (square.max(0.0).sqrt(), damping / 2.0)
    })
}

/// Roots of Jλ² + bλ + c, in the form without cancellation.
fn roots_of_single_node(node: &Node) -> Vec<C> {
    let c = node.stiffness + node.ground_stiffness;
    let half = (node.damping + node.ground_damping) / (2.0 * node.inertia);
    let square = c / node.inertia - half * half;
    if square > 0.0 {
        vec![C::new(-half, square.sqrt())]
    } else {
        let fast = -half - (-square).sqrt();
        vec![C::new(c / (node.inertia * fast), 0.0), C::new(fast, 0.0)]
    }
}
