//! The quadratic pencil Q(λ) = λ²J + λB + K of a tree, and its eigenvalues.
//!
//! Q is never assembled: masses are eliminated from the leaves to the root by
//! impedances. Mass i with everything beyond it has the dynamic stiffness
//!
//! Y_i = λ²J_i + g_i + Σ_children lever²·k·Y/(k + Y),  k = c + λb, g = ground,
//!
//! and det Q = Π (k_i + Y_i). No term cancels artificially (an assembled
//! c_m + c_{m+1} loses digits of the slow modes as n² grows).

use nalgebra::{Complex, DMatrix, SymmetricEigen};

pub(crate) type C = Complex<f64>;

/// A node of the pencil: one mass with its link.
#[derive(Clone, Debug)]
pub(crate) struct Node {
    pub(crate) inertia: f64,
    pub(crate) parent: Option<usize>,
    pub(crate) lever: f64,
    /// 0 when the pair is open.
    pub(crate) stiffness: f64,
    pub(crate) damping: f64,
    pub(crate) ground_stiffness: f64,
    pub(crate) ground_damping: f64,
}

/// A connected part of the tree: no link of its root, or its root's link
/// engaged with the law.
#[derive(Clone, Debug)]
pub(crate) struct Pencil {
    /// Parents first; `parent` counts within this list.
    pub(crate) nodes: Vec<Node>,
}

/// Why eigenvalues were refused.
#[derive(Clone, Debug, PartialEq)]
pub(crate) struct NotFound;

impl Pencil {
    /// True when nothing elastic holds it: rigid motion costs no force but damping.
    pub(crate) fn floats(&self) -> bool {
        self.nodes[0].stiffness == 0.0 && self.nodes.iter().all(|n| n.ground_stiffness == 0.0)
    }

    /// True when rigid motion is damped.
    pub(crate) fn dragged(&self) -> bool {
        self.nodes[0].damping > 0.0 || self.nodes.iter().any(|n| n.ground_damping > 0.0)
    }

    /// The shape of rigid motion, 1 at the root.
    pub(crate) fn rigid_shape(&self) -> Vec<f64> {
        let mut shape = vec![1.0; self.nodes.len()];
        for i in 1..shape.len() {
            shape[i] = self.nodes[i].lever * self.nodes[i].parent.map_or(1.0, |p| shape[p]);
        }
        shape
    }

    /// The deformation operator: f(x_i − lever·x_parent) for every link, as
    /// `gather` of link factors: out += Dᵀ·diag(factor)·D·x + diag(ground)·x.
    pub(crate) fn apply(
        &self,
        x: &[C],
        link: impl Fn(&Node) -> f64,
        ground: impl Fn(&Node) -> f64,
    ) -> Vec<C> {
        let mut out = vec![C::new(0.0, 0.0); x.len()];
        for (i, node) in self.nodes.iter().enumerate() {
            let base = node.parent.map_or(C::new(0.0, 0.0), |p| x[p] * node.lever);
            let force = (x[i] - base) * link(node);
            out[i] += force + x[i] * ground(node);
            if let Some(p) = node.parent {
                out[p] -= force * node.lever;
            }
        }
        out
    }

    /// Y of every mass with everything beyond it, and its derivative.
    fn impedances(&self, lambda: C) -> Vec<[C; 2]> {
        let mut y: Vec<[C; 2]> = self
            .nodes
            .iter()
            .map(|n| {
                let own = lambda * lambda * n.inertia + lambda * n.ground_damping;
                [
                    own + n.ground_stiffness,
                    lambda * (2.0 * n.inertia) + n.ground_damping,
                ]
            })
            .collect();
        for i in (1..y.len()).rev() {
            let n = &self.nodes[i];
            let Some(p) = n.parent else { continue };
            let k = lambda * n.damping + n.stiffness;
            let [own, slope] = y[i];
            let inverse = (k + own).inv();
            let (a, b) = (own * inverse, k * inverse);
            let square = n.lever * n.lever;
            // d(kY/(k+Y)) = k'·a² + Y'·b².
            y[p][0] += k * a * square;
            y[p][1] += (a * a * n.damping + b * b * slope) * square;
        }
        y
    }

    /// (det Q)'/det Q.
    fn log_derivative(&self, lambda: C) -> C {
        let y = self.impedances(lambda);
        let mut sum = C::new(0.0, 0.0);
        for (n, [own, slope]) in self.nodes.iter().zip(&y) {
            let k = lambda * n.damping + n.stiffness;
            sum += (slope + n.damping) / (k + own);
        }
        sum
    }

    /// Undamped frequencies ω and damping ratios to first order, ascending.
    fn first_guess(&self) -> Vec<(f64, f64)> {
        let n = self.nodes.len();
        let mut k = DMatrix::<f64>::zeros(n, n);
        let mut b = DMatrix::<f64>::zeros(n, n);
        for (i, node) in self.nodes.iter().enumerate() {
            k[(i, i)] += node.ground_stiffness + node.stiffness;
            b[(i, i)] += node.ground_damping + node.damping;
            if let Some(p) = node.parent {
                let l = node.lever;
                for (m, f) in [(&mut k, node.stiffness), (&mut b, node.damping)] {
                    m[(p, p)] += l * l * f;
                    m[(i, p)] -= l * f;
                    m[(p, i)] -= l * f;
                }
            }
        }
        let root: Vec<f64> = self.nodes.iter().map(|node| node.inertia.sqrt()).collect();
        for i in 0..n {
            for j in 0..n {
                k[(i, j)] /= root[i] * root[j];
                b[(i, j)] /= root[i] * root[j];
            }
        }
        let eigen = SymmetricEigen::new(k);
        let mut guess: Vec<(f64, f64)> = (0..n)
            .map(|j| {
                let x = eigen.eigenvectors.column(j);
                let damping = (x.transpose() * &b * x)[(0, 0)];
                (eigen.eigenvalues[j].max(0.0).sqrt(), damping / 2.0)
            })
            .collect();
        guess.sort_by(|a, b| a.0.total_cmp(&b.0));
        guess
    }

    /// All eigenvalues but the zero ones, upper half-plane only: complex ones
    /// stand for their conjugate too, real ones for themselves.
    pub(crate) fn eigenvalues(&self) -> Result<Vec<C>, NotFound> {
        let floats = self.floats();
        let zeros = match (floats, self.dragged()) {
            (false, _) => 0,
            (true, false) => 2,
            (true, true) => 1,
        };
        if let ([node], 0) = (&self.nodes[..], zeros) {
            return Ok(single(node));
        }
        let guess = self.first_guess();
        let elastic = &guess[usize::from(floats)..];
        let light = elastic.iter().all(|(omega, decay)| *decay < 0.7 * omega);
        let roots = if light && zeros != 1 {
            let start = elastic
                .iter()
                .map(|&(omega, decay)| C::new(-decay, (omega * omega - decay * decay).sqrt()));
            self.aberth(start.collect(), zeros, true)?
        } else {
            self.aberth(self.full_start(&guess, zeros), zeros, false)?
        };
        self.checked(roots, zeros)
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
                let step = (self.log_derivative(z[i]) - repulsion).inv();
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
        out.sort_by(|a, b| a.norm().total_cmp(&b.norm()).then(a.re.total_cmp(&b.re)));
        Ok(out)
    }

    /// Eigenvector by twisted elimination: everything is eliminated onto the
    /// mass whose pivot is least relative to its inertia, from where the shape
    /// grows outwards (one-ended recurrences are unstable for modes that sit
    /// on the light masses).
    pub(crate) fn eigenvector(&self, lambda: C) -> Vec<C> {
        let n = self.nodes.len();
        if n == 1 {
            return vec![C::new(1.0, 0.0)];
        }
        let y = self.impedances(lambda);
        let k: Vec<C> = self
            .nodes
            .iter()
            .map(|node| lambda * node.damping + node.stiffness)
            .collect();
        // What mass i feels through its link from the parent's side; `rest[i]`
        // is the parent's stiffness without branch i.
        let mut up = vec![k[0]; n];
        let mut rest = vec![C::new(0.0, 0.0); n];
        for i in 1..n {
            let Some(p) = self.nodes[i].parent else {
                continue;
            };
            let own = &self.nodes[p];
            let mut sum = lambda * lambda * own.inertia
                + lambda * own.ground_damping
                + own.ground_stiffness
                + up[p];
            for j in (p + 1)..n {
                if j != i && self.nodes[j].parent == Some(p) {
                    let square = self.nodes[j].lever * self.nodes[j].lever;
                    sum += k[j] * y[j][0] / (k[j] + y[j][0]) * square;
                }
            }
            rest[i] = sum;
            let square = self.nodes[i].lever * self.nodes[i].lever;
            up[i] = k[i] * sum / (k[i] * square + sum);
        }
        let pivot = |i: usize| (y[i][0] + up[i]).norm() / self.nodes[i].inertia;
        let twist = (0..n)
            .filter(|i| pivot(*i).is_finite())
            .min_by(|a, b| pivot(*a).total_cmp(&pivot(*b)))
            .unwrap_or(0);
        self.grow(twist, &y, &k, &rest)
    }

    fn grow(&self, twist: usize, y: &[[C; 2]], k: &[C], rest: &[C]) -> Vec<C> {
        let n = self.nodes.len();
        let mut x = vec![None; n];
        x[twist] = Some(C::new(1.0, 0.0));
        let mut at = twist;
        while let Some(p) = self.nodes[at].parent {
            let l = self.nodes[at].lever;
            let own = x[at].unwrap_or_default();
            x[p] = Some(own * k[at] * l / (k[at] * (l * l) + rest[at]));
            at = p;
        }
        for i in 0..n {
            if x[i].is_none() {
                let base = self.nodes[i].parent.and_then(|p| x[p]).unwrap_or_default();
                x[i] = Some(base * k[i] * self.nodes[i].lever / (k[i] + y[i][0]));
            }
        }
        x.into_iter().map(Option::unwrap_or_default).collect()
    }
}

/// Roots of Jλ² + bλ + c, in the form without cancellation.
fn single(node: &Node) -> Vec<C> {
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

#[cfg(test)]
mod tests {
    use super::*;

    pub(crate) fn chain(n: usize, first: bool, psi: f64, local: bool) -> Pencil {
        let nodes = (0..n).map(|m| {
            let (a, b) = ((m + 1) as f64 / n as f64, m as f64 / n as f64);
            let inertia = 0.1 * (a.powi(3) - b.powi(3));
            let stiffness = n as f64 * 1e7;
            let damping = if local {
                psi * (stiffness * inertia).sqrt() / std::f64::consts::TAU
            } else {
                psi * stiffness / (std::f64::consts::TAU * 1e4)
            };
            let on = if m == 0 && !first { 0.0 } else { 1.0 };
            Node {
                inertia,
                parent: m.checked_sub(1),
                lever: 1.0,
                stiffness: stiffness * on,
                damping: damping * on,
                ground_stiffness: 0.0,
                ground_damping: 0.0,
            }
        });
        Pencil {
            nodes: nodes.collect(),
        }
    }

    fn residual(p: &Pencil, lambda: C) -> f64 {
        let x = p.eigenvector(lambda);
        let k = p.apply(&x, |n| n.stiffness, |n| n.ground_stiffness);
        let b = p.apply(&x, |n| n.damping, |n| n.ground_damping);
        let mut worst = 0.0f64;
        let mut scale = 0.0f64;
        for i in 0..x.len() {
            let inertial = lambda * lambda * x[i] * p.nodes[i].inertia;
            worst = worst.max((inertial + lambda * b[i] + k[i]).norm());
            scale = scale.max(inertial.norm()).max(k[i].norm());
        }
        worst / scale
    }

    #[test]
    fn eigenpairs_of_chains_solve_the_pencil() {
        for n in [1, 2, 3, 10, 24] {
            for first in [true, false] {
                for (psi, local) in [(0.0, true), (0.4, true), (0.4, false), (9.0, true)] {
                    let p = chain(n, first, psi, local);
                    if n == 1 && !first {
                        continue;
                    }
                    let roots = p.eigenvalues().expect("found");
                    for root in roots {
                        assert!(residual(&p, root) < 2e-13, "{n} {first} {psi} {root}");
                    }
                }
            }
        }
    }

    #[test]
    fn uniform_shaft_has_the_closed_form_frequencies() {
        // ω_k = 2n√(c/J)·sin((2k−1)π/(2(2n+1))) for n equal masses, c_m = n·c.
        let n = 7;
        let nodes = (0..n).map(|m| Node {
            inertia: 0.1 / n as f64,
            parent: (m as usize).checked_sub(1),
            lever: 1.0,
            stiffness: n as f64 * 1e7,
            damping: 0.0,
            ground_stiffness: 0.0,
            ground_damping: 0.0,
        });
        let roots = Pencil {
            nodes: nodes.collect(),
        }
        .eigenvalues()
        .expect("found");
        for (k, root) in roots.iter().enumerate() {
            let angle = (2 * k + 1) as f64 * std::f64::consts::PI / (2.0 * (2 * n + 1) as f64);
            let exact = 2.0 * n as f64 * 1e4 * angle.sin();
            approx::assert_relative_eq!(root.im, exact, max_relative = 1e-14);
        }
    }
}
