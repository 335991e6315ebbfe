//! The linear equations of a tree with all its pairs engaged: matrices, modes, poles and the
//! answer to a frequency.
//!
//! In the deviations q of [`TreeProblem`] and with the Laplace variable s
//!
//! (J·s² + B·s + K)·q = f,  f = W − ratio·(J·s² + g_b·s + g_k)·L
//!
//! of loads W on the masses and of the law L, where g are dampers and springs to the ground.
//! In the displacements φ = q + ratio·L the same law enters as (c₁ + b₁·s)·L at the first link.
//! The deviations are kept, since φ/L − 1 of slow motions would cancel.
//!
//! Masses are eliminated from the leaves to the root by their impedances ([`Pencil`]), so that
//! an answer takes time in proportion to their number and no term cancels.
//!
//! Limits: which flank is touched, gaps and constant loads change the place about which a tree
//! vibrates, and none of these numbers.

use super::pencil::{C, Node, Pencil};
use super::problem::TreeProblem;
use nalgebra::{DMatrix, DVector, SymmetricEigen};

/// Modes whose frequencies are nearer than this share of each other have shapes that a
/// frequency alone does not decide.
const COINCIDENT: f64 = 1e-6;

/// The linear equations of a tree.
#[derive(Clone, Debug)]
pub struct LinearTree {
    pencil: Pencil,
    ratios: Vec<f64>,
}

/// A natural mode of a tree without its dampers, and what they do to it.
#[derive(Clone, Debug, PartialEq)]
pub struct TreeMode {
    /// ω (rad/s).
    pub frequency: f64,
    /// q of each mass; the size is arbitrary.
    pub shape: Vec<f64>,
    /// xᵀJx of the shape (kg·m² or kg).
    pub inertia: f64,
    /// Damping ratio ζ = xᵀBx/(2·ω·xᵀJx).
    pub damping_ratio: f64,
}

impl LinearTree {
    /// The equations of a tree with all its pairs engaged.
    pub fn of(problem: &TreeProblem) -> Self {
        let node = |mass: &super::TreeMass| Node {
            inertia: mass.inertia,
            parent: mass.parent,
            lever: mass.lever,
            stiffness: mass.stiffness,
            damping: mass.damping,
            ground_stiffness: mass.ground_stiffness,
            ground_damping: mass.ground_damping,
        };
        Self {
            pencil: Pencil {
                nodes: problem.masses.iter().map(node).collect(),
            },
            ratios: problem.masses.iter().map(|mass| mass.ratio).collect(),
        }
    }

    /// Number n of masses.
    pub fn masses(&self) -> usize {
        self.ratios.len()
    }

    /// The inertia J of each mass (n, kg·m² or kg).
    pub fn inertias(&self) -> Vec<f64> {
        self.pencil.nodes.iter().map(|node| node.inertia).collect()
    }

    /// Displacement of each mass for a unit of the law, without deviations (n).
    pub fn ratios(&self) -> &[f64] {
        &self.ratios
    }

    /// c and b of the link of a mass, with its parent and the lever between them.
    pub fn link(&self, mass: usize) -> ([f64; 2], Option<(usize, f64)>) {
        let node = &self.pencil.nodes[mass];
        let parent = node.parent.map(|parent| (parent, node.lever));
        ([node.stiffness, node.damping], parent)
    }

    /// c and b of springs and dampers from a mass to the ground.
    pub fn ground(&self, mass: usize) -> [f64; 2] {
        let node = &self.pencil.nodes[mass];
        [node.ground_stiffness, node.ground_damping]
    }

    /// The stiffness matrix K and the damping matrix B (n × n, symmetric).
    pub fn stiffness_and_damping(&self) -> [DMatrix<f64>; 2] {
        let assembled = |link: fn(&Node) -> f64, ground: fn(&Node) -> f64| {
            let n = self.masses();
            let mut matrix = DMatrix::zeros(n, n);
            for (i, node) in self.pencil.nodes.iter().enumerate() {
                matrix[(i, i)] += link(node) + ground(node);
                if let Some(parent) = node.parent {
                    let coupling = node.lever * link(node);
                    matrix[(i, parent)] -= coupling;
                    matrix[(parent, i)] -= coupling;
                    matrix[(parent, parent)] += node.lever * coupling;
                }
            }
            matrix
        };
        [
            assembled(|node| node.stiffness, |node| node.ground_stiffness),
            assembled(|node| node.damping, |node| node.ground_damping),
        ]
    }

    /// Force on each mass by a law of amplitude 1 (n).
    pub fn force_of_law(&self, s: C) -> Vec<C> {
        let force = |(node, ratio): (&Node, &f64)| {
            let own = s * s * node.inertia + s * node.ground_damping + node.ground_stiffness;
            -own * *ratio
        };
        self.pencil
            .nodes
            .iter()
            .zip(&self.ratios)
            .map(force)
            .collect()
    }

    /// Deviation q of each mass under forces of these amplitudes; `None` at a pole.
    pub fn respond(&self, s: C, force: &[C]) -> Option<Vec<C>> {
        let nodes = &self.pencil.nodes;
        let mut impedances = Vec::with_capacity(nodes.len());
        self.pencil.impedances(s, &mut impedances);
        let mut force = force.to_vec();
        let link = |node: &Node| s * node.damping + node.stiffness;
        // From the leaves: what a mass with all beyond it presses on its parent.
        for i in (1..nodes.len()).rev() {
            if let Some(parent) = nodes[i].parent {
                let k = link(&nodes[i]);
                let passed = force[i] * k / (k + impedances[i][0]) * nodes[i].lever;
                force[parent] += passed;
            }
        }
        let mut q = force;
        for i in 0..nodes.len() {
            let k = link(&nodes[i]);
            let base = nodes[i].parent.map_or(C::new(0.0, 0.0), |p| q[p]);
            q[i] = (q[i] + k * nodes[i].lever * base) / (k + impedances[i][0]);
        }
        q.iter()
            .all(|one| one.re.is_finite() && one.im.is_finite())
            .then_some(q)
    }

    /// The eigenvalues with an imaginary part ≥ 0 (1/s), least modulus first; `None` where they
    /// cannot be separated.
    pub fn poles(&self) -> Option<Vec<C>> {
        self.pencil.eigenvalues().ok()
    }

    /// The natural modes, lowest first; `None` where they cannot be found.
    pub fn modes(&self) -> Option<Vec<TreeMode>> {
        let undamped = self.undamped();
        let eigen = self.symmetric_modes()?;
        let exact = undamped.eigenvalues().ok();
        let exact = exact.filter(|all| all.len() == eigen.len());
        let frequency = |k: usize| match &exact {
            Some(all) => all[k].norm(),
            None => eigen[k].0,
        };
        let apart = |k: usize| {
            let near = |other: usize| (frequency(other) - frequency(k)).abs();
            let next = [k.checked_sub(1), (k + 1 < eigen.len()).then_some(k + 1)];
            let gap = next
                .into_iter()
                .flatten()
                .map(near)
                .fold(f64::INFINITY, f64::min);
            gap > COINCIDENT * frequency(k)
        };
        let mode = |k: usize| {
            let shape = match exact.is_some() && apart(k) {
                true => {
                    let lambda = C::new(0.0, frequency(k));
                    let shape = undamped.eigenvector(lambda);
                    shape.iter().map(|one| one.re).collect()
                }
                false => eigen[k].1.clone(),
            };
            self.mode(frequency(k), shape)
        };
        Some((0..eigen.len()).map(mode).collect())
    }

    fn mode(&self, frequency: f64, shape: Vec<f64>) -> TreeMode {
        let complex: Vec<C> = shape.iter().map(|one| C::from(*one)).collect();
        let (link, ground) = (
            |node: &Node| node.damping,
            |node: &Node| node.ground_damping,
        );
        let forces = self
            .pencil
            .apply_deformation_operator(&complex, link, ground);
        let damping: f64 = shape.iter().zip(&forces).map(|(x, f)| x * f.re).sum();
        let nodes = self.pencil.nodes.iter().zip(&shape);
        let inertia: f64 = nodes.map(|(node, x)| node.inertia * x * x).sum();
        TreeMode {
            frequency,
            damping_ratio: damping / (2.0 * frequency * inertia),
            inertia,
            shape,
        }
    }

    fn undamped(&self) -> Pencil {
        let mut undamped = self.pencil.clone();
        for node in &mut undamped.nodes {
            (node.damping, node.ground_damping) = (0.0, 0.0);
        }
        undamped
    }

    /// Frequencies and shapes from the matrix that unit masses make symmetric, lowest first.
    fn symmetric_modes(&self) -> Option<Vec<(f64, Vec<f64>)>> {
        let [stiffness, _] = self.stiffness_and_damping();
        let roots: Vec<f64> = self.inertias().iter().map(|own| own.sqrt()).collect();
        let n = roots.len();
        let scaled = DMatrix::from_fn(n, n, |i, j| stiffness[(i, j)] / (roots[i] * roots[j]));
        if scaled.iter().any(|entry| !entry.is_finite()) {
            return None;
        }
        let eigen = SymmetricEigen::new(scaled);
        let shape = |column: DVector<f64>| -> Vec<f64> {
            column
                .iter()
                .zip(&roots)
                .map(|(x, root)| x / root)
                .collect()
        };
        let each = (0..n).map(|k| {
            let column = eigen.eigenvectors.column(k).clone_owned();
            (eigen.eigenvalues[k].max(0.0).sqrt(), shape(column))
        });
        let mut all: Vec<(f64, Vec<f64>)> = each.collect();
        all.sort_by(|a, b| a.0.total_cmp(&b.0));
        Some(all)
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::exact::{Law, TreeMass};

    /// A branched tree with levers, springs and dampers to the ground.
    fn branched() -> LinearTree {
        let mut masses = vec![
            TreeMass::new(0.3, None, 4e4, 12.0),
            TreeMass::new(0.2, Some(0), 9e4, 3.0),
            TreeMass::new(0.5, Some(0), 2e4, 40.0),
            TreeMass::new(0.1, Some(2), 7e4, 1.0),
        ];
        (masses[2].lever, masses[2].ratio) = (-1.7, -1.7);
        (masses[3].lever, masses[3].ratio) = (0.6, -1.02);
        (masses[1].ground_stiffness, masses[1].ground_damping) = (5e3, 2.0);
        LinearTree::of(&problem(masses))
    }

    fn problem(masses: Vec<TreeMass>) -> TreeProblem {
        let n = masses.len();
        TreeProblem {
            masses,
            law: Law::Harmonic {
                mean: 0.0,
                slope: 0.0,
                sines: Vec::new(),
            },
            displacement: vec![0.0; n],
            speed: vec![0.0; n],
            objects: Vec::new(),
        }
    }

    #[test]
    fn answers_solve_the_assembled_equations() {
        let tree = branched();
        let [stiffness, damping] = tree.stiffness_and_damping();
        for omega in [1.0, 90.0, 350.0, 2e3] {
            let s = C::new(0.0, omega);
            let force: Vec<C> = (0..4).map(|i| C::new(1.0 + f64::from(i), -0.5)).collect();
            let all = [force, tree.force_of_law(s)];
            for force in all {
                let q = tree.respond(s, &force).expect("no pole");
                for i in 0..4 {
                    let mut sum = s * s * tree.inertias()[i] * q[i] - force[i];
                    let mut size = force[i].norm();
                    for j in 0..4 {
                        let entry = (s * damping[(i, j)] + stiffness[(i, j)]) * q[j];
                        sum += entry;
                        size += entry.norm();
                    }
                    assert!(sum.norm() < 1e-13 * size, "{omega} {i}");
                }
            }
        }
    }

    #[test]
    fn modes_solve_the_undamped_equations_and_poles_the_damped_ones() {
        let tree = branched();
        let [stiffness, damping] = tree.stiffness_and_damping();
        let inertias = tree.inertias();
        for mode in tree.modes().expect("modes") {
            let x = DVector::from_column_slice(&mode.shape);
            let left = &stiffness * &x;
            for i in 0..4 {
                let right = mode.frequency * mode.frequency * inertias[i] * x[i];
                assert!((left[i] - right).abs() < 1e-11 * left.norm());
            }
            let modal = (x.transpose() * &damping * &x)[(0, 0)];
            let ratio = modal / (2.0 * mode.frequency * mode.inertia);
            approx::assert_relative_eq!(mode.damping_ratio, ratio, max_relative = 1e-13);
        }
        // Next to a pole everything moves without bound.
        for pole in tree.poles().expect("poles") {
            let near = pole * (1.0 + 1e-9);
            let q = tree
                .respond(near, &[C::new(1.0, 0.0); 4])
                .expect("beside it");
            let far = tree
                .respond(pole * 1.1, &[C::new(1.0, 0.0); 4])
                .expect("far");
            let size = |q: &[C]| q.iter().fold(0.0f64, |most, one| most.max(one.norm()));
            assert!(size(&q) > 1e5 * size(&far));
        }
    }

    #[test]
    fn equal_branches_have_shapes_of_their_own() {
        let masses = vec![
            TreeMass::new(0.3, None, 4e4, 0.0),
            TreeMass::new(0.1, Some(0), 2e4, 0.0),
            TreeMass::new(0.1, Some(0), 2e4, 0.0),
            TreeMass::new(0.1, Some(0), 2e4, 0.0),
        ];
        let modes = LinearTree::of(&problem(masses)).modes().expect("modes");
        let inertias = [0.3, 0.1, 0.1, 0.1];
        for (k, one) in modes.iter().enumerate() {
            for other in &modes[..k] {
                let products = one.shape.iter().zip(&other.shape).zip(inertias);
                let product: f64 = products.map(|((x, y), own)| own * x * y).sum();
                assert!(product.abs() < 1e-9 * (one.inertia * other.inertia).sqrt());
            }
        }
    }
}
