//! The quadratic pencil Q(λ) = λ²J + λB + K of a tree, and its eigenvectors.
//!
//! Q is never assembled: masses are eliminated from the leaves to the root by
//! impedances. Mass i with everything beyond it has the dynamic stiffness
//!
//! Y_i = λ²J_i + g_i + Σ_children lever²·k·Y/(k + Y),  k = c + λb, g = ground,
//!
//! and det Q = Π (k_i + Y_i). No term cancels artificially (an assembled
//! c_m + c_{m+1} loses digits of the slow modes as n² grows).
//!
//! Elimination along a branch is Holzer's method.

use nalgebra::Complex;

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

impl Pencil {
    /// True when nothing elastic holds it: rigid motion costs no force but damping.
    pub(crate) fn floats(&self) -> bool {
        self.nodes[0].stiffness == 0.0 && self.nodes.iter().all(|n| n.ground_stiffness == 0.0)
    }

    /// True when rigid motion is damped.
    pub(crate) fn has_damped_rigid_motion(&self) -> bool {
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
    pub(crate) fn apply_deformation_operator(
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
    pub(super) fn impedances(&self, lambda: C, y: &mut Vec<[C; 2]>) {
        y.clear();
        y.extend(self.nodes.iter().map(|n| {
            let own = lambda * lambda * n.inertia + lambda * n.ground_damping;
            [
                own + n.ground_stiffness,
                lambda * (2.0 * n.inertia) + n.ground_damping,
            ]
        }));
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
        let mut y = Vec::with_capacity(n);
        self.impedances(lambda, &mut y);
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
        let k = p.apply_deformation_operator(&x, |n| n.stiffness, |n| n.ground_stiffness);
        let b = p.apply_deformation_operator(&x, |n| n.damping, |n| n.ground_damping);
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
