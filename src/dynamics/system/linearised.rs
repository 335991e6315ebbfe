//! The equations of small vibrations about the position at t = 0.

use super::forest::Forest;

use super::frozen::{Chain, Frozen, Step};
use super::multi::SmallMotion;
use super::pairs::OPEN;
use super::passes::{Extent, Work};
use crate::dynamics::model::LoadLaw;
use nalgebra::{DMatrix, DVector};

impl Frozen {
    /// Mass and stiffness at the position at t = 0, on the law.
    pub(super) fn linearised(&self, regime: Regime, modes: &[i64]) -> LinearModel {
        // A massless point has no motion of its own: contact and link 1 are in series. Nor
        // has a body that a rigid contact holds.
        let held =
            |chain: &Chain| regime == Regime::Engaged && chain.contact.restitution().is_some();
        let left_out = || (self.chains.iter()).filter(|chain| chain.point || held(chain));
        let place = |coordinate: usize| {
            let before = left_out().filter(|chain| chain.first_coordinate < coordinate);
            coordinate - before.count()
        };
        let n = self.coordinates - left_out().count();
        let mut work = Work::new(self);
        self.motion(0.0, &self.law_state(), modes, Extent::Full, &mut work);
        for (mode, chain) in work.pair_modes.iter_mut().zip(&self.chains) {
            *mode = match held(chain) {
                true => chain.contact.sides()[0],
                false => OPEN,
            };
        }
        self.reduce_rigid(Extent::Full, &mut work);
        // Every node's displacement is a sum of factors times free coordinates: none,
        // where it is prescribed, and more than one only behind a constraint.
        let mut moves: Vec<Vec<(usize, f64)>> = vec![Vec::new(); self.inertia.len()];
        let through = |moves: &[(usize, f64)], slope: f64| -> Vec<(usize, f64)> {
            moves.iter().map(|&(c, f)| (c, f * slope)).collect()
        };
        let mut mass = vec![1.0; n];
        let mut stiffness = match self.constraints.is_empty() {
            true => Stiffness::Forest(Forest::new(n)),
            false => Stiffness::Full(DMatrix::zeros(n, n)),
        };
        for step in &self.steps {
            match step {
                Step::Prescribed(_) => {}
                Step::Rotor(rotor) => {
                    let coordinate = place(rotor.coordinate);
                    moves[rotor.node] = vec![(coordinate, 1.0)];
                    mass[coordinate] = work.mass[rotor.node];
                }
                Step::Rigid(index) => {
                    let rigid = self.rigids[*index];
                    let slope = work.laws[rigid.law].first;
                    moves[rigid.node] = through(&moves[self.laws[rigid.law].driver], slope);
                }
                Step::Chain(index) => {
                    let chain = &self.chains[*index];
                    let slope = work.laws[chain.law].first;
                    let own = chain.points();
                    let first = chain.first_coordinate;
                    // (Drivers, and so their coordinates, come first.)
                    let reduced = place(first);
                    let base = through(&moves[self.laws[chain.law].driver], slope);
                    if held(chain) {
                        moves[chain.first_node] = base;
                        continue;
                    }
                    for (m, node) in chain.nodes().skip(own).enumerate() {
                        moves[node] = vec![(reduced + m, 1.0)];
                        mass[reduced + m] = work.mass[node];
                    }
                    if regime == Regime::Engaged || !chain.contact.can_open() {
                        let series = match chain.point {
                            true => {
                                1.0 / (1.0 / self.stiffness[first]
                                    + 1.0 / self.stiffness[first + 1])
                            }
                            false => self.stiffness[first],
                        };
                        add_link(&mut stiffness, series, reduced, &base);
                    }
                    for (m, c) in chain.coordinates().skip(own + 1).enumerate() {
                        let end = reduced + m + 1;
                        add_link(&mut stiffness, self.stiffness[c], end, &[(end - 1, 1.0)]);
                    }
                }
                Step::Constrained(index) => {
                    let constrained = &self.constraints[*index];
                    let first = &work.constraints[*index].first;
                    let mut sum: Vec<(usize, f64)> = Vec::new();
                    for (&driver, &slope) in constrained.drivers.iter().zip(first) {
                        for (c, f) in through(&moves[driver], slope) {
                            match sum.iter_mut().find(|term| term.0 == c) {
                                Some(term) => term.1 += f,
                                None => sum.push((c, f)),
                            }
                        }
                    }
                    moves[constrained.node] = sum;
                }
            }
        }
        for load in &self.loads {
            if let LoadLaw::Linear(own) = &load.law {
                add_square(&mut stiffness, own.rate, &moves[load.node]);
            }
            if let Some(written) = load.written.as_ref().filter(|own| own.rate != 0.0) {
                add_square(&mut stiffness, written.rate, &moves[load.node]);
            }
        }
        for (index, linkage) in self.linkages.iter().enumerate() {
            let own = self.potential_stiffness(index, &work);
            add_square(&mut stiffness, own, &moves[linkage.node]);
        }
        let several: Vec<SmallMotion> = (0..self.multi.len())
            .map(|index| self.small_motion(index, &work))
            .collect();
        for (multi, own) in self.multi.iter().zip(&several) {
            add_form(&mut stiffness, &own.stiffness, &multi.nodes, &moves);
        }
        let mut coupled = (!self.heavy.is_empty() || !several.is_empty()).then(|| {
            let diagonal = DVector::from_column_slice(&mass);
            let mut matrix = Stiffness::Full(DMatrix::from_diagonal(&diagonal));
            for &index in &self.heavy {
                let node = self.constraints[index].node;
                add_square(&mut matrix, work.mass[node], &moves[node]);
            }
            for (multi, own) in self.multi.iter().zip(&several) {
                add_form(&mut matrix, &own.mass, &multi.nodes, &moves);
            }
            matrix.full()
        });
        if let Some(coupled) = coupled.as_mut().filter(|_| !several.is_empty()) {
            // Coordinates may have no inertia but that of a linkage of several inputs.
            mass = coupled.diagonal().iter().copied().collect();
        }
        LinearModel {
            mass,
            coupled,
            stiffness,
        }
    }
}

/// The equations of small vibrations.
pub(super) struct LinearModel {
    /// The mass of every coordinate by itself.
    pub(super) mass: Vec<f64>,
    /// The mass matrix, where inertia on constrained nodes couples the coordinates.
    coupled: Option<DMatrix<f64>>,
    stiffness: Stiffness,
}

impl LinearModel {
    /// The squares of the natural frequencies, ascending; `None` where a number is not
    /// finite or the masses have no motion of their own.
    pub(super) fn squares(&self) -> Option<Vec<f64>> {
        if let (Stiffness::Forest(forest), None) = (&self.stiffness, &self.coupled) {
            let factors: Vec<f64> = self.mass.iter().map(|mass| 1.0 / mass.sqrt()).collect();
            let mut forest = forest.clone();
            forest.scale(&factors);
            return forest.is_finite().then(|| forest.eigenvalues());
        }
        if self.mass.is_empty() {
            return Some(Vec::new());
        }
        let (scaled, _) = self.scaled()?;
        let mut squares: Vec<f64> = scaled.symmetric_eigenvalues().iter().copied().collect();
        squares.sort_by(f64::total_cmp);
        Some(squares)
    }

    /// The stiffness matrix in coordinates of unit mass (scaled by the roots of the
    /// masses), and what makes the scaled masses unit ones where constraints couple
    /// them: the inverse, transposed, of the lower factor of the scaled mass matrix.
    pub(super) fn scaled(&self) -> Option<(DMatrix<f64>, Option<DMatrix<f64>>)> {
        let root: Vec<f64> = self.mass.iter().map(|mass| mass.sqrt()).collect();
        let n = root.len();
        let by_roots = |matrix: &DMatrix<f64>| {
            DMatrix::from_fn(n, n, |i, j| matrix[(i, j)] / (root[i] * root[j]))
        };
        let mut scaled = by_roots(&self.stiffness.full());
        let mut unit = None;
        if let Some(coupled) = &self.coupled {
            let lower = by_roots(coupled).cholesky()?.unpack();
            let inverse = lower.try_inverse()?;
            scaled = &inverse * scaled * inverse.transpose();
            unit = Some(inverse.transpose());
        }
        let finite = scaled.iter().all(|entry| entry.is_finite());
        finite.then_some((scaled, unit))
    }
}

/// A symmetric matrix over the coordinates.
enum Stiffness {
    /// Every coordinate hangs on one other at most, which comes before it.
    Forest(Forest),
    /// Constraints may couple any of them.
    Full(DMatrix<f64>),
}

impl Stiffness {
    /// Adds to the entry in row i and column j.
    fn add(&mut self, i: usize, j: usize, a: f64) {
        match self {
            Self::Full(matrix) => matrix[(i, j)] += a,
            Self::Forest(forest) if i == j => forest.diagonal[i] += a,
            // Of the two equal entries the one of the later coordinate is kept.
            Self::Forest(forest) if i > j => {
                let before = forest.parent[i].map_or(0.0, |(_, entry)| entry);
                forest.parent[i] = Some((j, before + a));
            }
            Self::Forest(_) => {}
        }
    }

    /// The matrix with all its entries.
    fn full(&self) -> DMatrix<f64> {
        let forest = match self {
            Self::Full(matrix) => return matrix.clone(),
            Self::Forest(forest) => forest,
        };
        let mut matrix = DMatrix::from_diagonal(&DVector::from_column_slice(&forest.diagonal));
        for (index, parent) in forest.parent.iter().enumerate() {
            if let Some((parent, entry)) = *parent {
                matrix[(index, parent)] = entry;
                matrix[(parent, index)] = entry;
            }
        }
        matrix
    }
}

/// Adds Σ a_ij·x_i·x_j, each x the displacement of a node, a sum of factors times coordinates.
fn add_form(matrix: &mut Stiffness, a: &[f64], nodes: &[usize], moves: &[Vec<(usize, f64)>]) {
    for (i, &one) in nodes.iter().enumerate() {
        for (j, &other) in nodes.iter().enumerate() {
            for &(c, f) in &moves[one] {
                for &(d, g) in &moves[other] {
                    matrix.add(c, d, a[i * nodes.len() + j] * f * g);
                }
            }
        }
    }
}

/// Adds a·x², x a sum of factors times coordinates.
fn add_square(matrix: &mut Stiffness, a: f64, x: &[(usize, f64)]) {
    for &(i, f) in x {
        for &(j, g) in x {
            matrix.add(i, j, a * f * g);
        }
    }
}

/// A spring between coordinate `end` and a sum of factors times others.
fn add_link(stiffness: &mut Stiffness, c: f64, end: usize, base: &[(usize, f64)]) {
    stiffness.add(end, end, c);
    add_square(stiffness, c, base);
    for &(base, factor) in base {
        stiffness.add(end, base, -c * factor);
        stiffness.add(base, end, -c * factor);
    }
}

/// Links that count in a linearisation.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Regime {
    /// All pairs engaged.
    Engaged,
    /// All pairs that can open are open.
    Open,
}
