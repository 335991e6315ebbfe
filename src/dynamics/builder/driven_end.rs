//! Balanced chains: inertia at both ends of every cell, and thus at the driven end.
//!
//! A uniform elastic object is cut into n cells. A force in it at the share s of its
//! length (0: the driven end, 1: the output) makes the output give way by s/c. What the
//! output does when the object is moved slowly follows from ∫s dJ, the first moment of
//! compliance of its inertia. Here the inertia of each cell is split over the two ends of
//! the cell so that this moment is kept: the quasi-static deviation is right for every n.
//! Behind a contact element, which nothing may lie on, the first cell has its inertia at its
//! far end.
//!
//! The inertia at the driven end follows the law rigidly. It stands in the model as an inner
//! part of the object, `rocker.driven_end`.

use super::spec::{ChainSpec, InertiaSplit, LoadLawSpec, LoadSpec, Lumping, MassChoice};
use super::{ChainParameters, Place};
use crate::dynamics::builder::spec::BodySpec;
use crate::dynamics::model::{Closure, NodeIndex};
use crate::fault::Faults;

/// What a balanced chain cannot be behind, and why.
pub(crate) const BALANCED_BEHIND_AN_OPENING_PAIR: &str = "the inertia at the driven end would \
                                                          stay on the driver after a separation";

/// What to give in its place.
pub(crate) const INSTEAD_OF_BALANCED: &str = "\"ends\", where all inertia is behind the pair; \
     closure `bilateral`; or a contact element, `pair.contact`";

/// Shares of the inertia at the driven end and at the masses 1 to n of a balanced chain;
/// `None`: of a split that no continuum has.
///
/// Cell m = k + 1 of a uniform rod has 1/n, half of it at each end. That of a lever, whose
/// inertia up to the share s of its length is s³, has (k + x)² at the share x of the cell,
/// times 3/n³: (3k²/2 + 2k + ¾)/n³ at the far end, (3k²/2 + k + ¼)/n³ at the near one.
pub(super) fn balanced_shares(split: &InertiaSplit, masses: usize) -> Option<(f64, Vec<f64>)> {
    let n = masses as f64;
    // Coefficients of 1, k, k² at the near and at the far end.
    let (near, far, whole) = match split {
        InertiaSplit::Equal => ([0.5, 0.0, 0.0], [0.5, 0.0, 0.0], n),
        InertiaSplit::Cubes => ([0.25, 1.0, 1.5], [0.75, 2.0, 1.5], n * n * n),
        InertiaSplit::Shares(_) => return None,
    };
    let of = |[a, b, c]: [f64; 3], k: f64| (c * k + b) * k + a;
    let (near, far) = (|k| of(near, k), |k| of(far, k));
    let at = |m: usize| {
        let above = if m < masses { near(m as f64) } else { 0.0 };
        (far(m as f64 - 1.0) + above) / whole
    };
    Some((near(0.0) / whole, (1..=masses).map(at).collect()))
}

impl BodySpec {
    /// True when the inertia of its cells is split over their ends.
    fn is_balanced(&self) -> bool {
        let balanced = Lumping::Balanced;
        matches!(self, Self::Uniform { lumping, .. } if *lumping == balanced)
    }
}

impl ChainSpec {
    /// True when some of its inertia moves with the law.
    pub fn has_driven_end(&self) -> bool {
        self.body.is_balanced() && self.pair.contact.is_none()
    }
}

impl ChainParameters {
    /// The inertia at the driven end moved to the first mass.
    pub(super) fn with_far_first_cell(mut self) -> Self {
        if let Some(first) = self.inertias.first_mut() {
            *first += std::mem::take(&mut self.driven_end);
        }
        self
    }
}

/// The fault of a balanced chain behind a pair that can open.
pub(super) fn check(at: &Place, spec: &ChainSpec, faults: &mut Faults) {
    if spec.has_driven_end() && spec.pair.closure != Closure::Bilateral {
        let message = format!(
            "`balanced` needs a contact that cannot separate: \
                     {BALANCED_BEHIND_AN_OPENING_PAIR}"
        );
        faults.add(at.path("lumping"), message, INSTEAD_OF_BALANCED);
    }
}

/// The nodes that a load may choose from: a weight of all masses acts on the inertia at
/// the driven end too.
pub(super) fn loaded(
    load: &LoadSpec,
    masses: &[NodeIndex],
    end: Option<NodeIndex>,
) -> Vec<NodeIndex> {
    let weight = matches!(load.law, LoadLawSpec::Weight { .. }) && load.mass == MassChoice::All;
    let end = end.filter(|_| weight);
    masses.iter().copied().chain(end).collect()
}

#[cfg(test)]
mod tests {
    use super::balanced_shares;
    use crate::dynamics::builder::spec::InertiaSplit;

    /// Σ J_m·s_m/J and Σ J_m/J.
    fn moments(split: &InertiaSplit, masses: usize) -> [f64; 2] {
        let (end, shares) = balanced_shares(split, masses).unwrap();
        let place = |m: usize| (m + 1) as f64 / masses as f64;
        let moments = shares.iter().enumerate().map(|(m, share)| share * place(m));
        [moments.sum(), end + shares.iter().sum::<f64>()]
    }

    #[test]
    fn inertia_and_its_first_moment_of_compliance_are_those_of_the_continuum() {
        for masses in [1, 2, 3, 8, 100] {
            for (split, moment) in [(InertiaSplit::Equal, 0.5), (InertiaSplit::Cubes, 0.75)] {
                let [first, whole] = moments(&split, masses);
                approx::assert_relative_eq!(first, moment, max_relative = 1e-13);
                approx::assert_relative_eq!(whole, 1.0, max_relative = 1e-13);
            }
        }
        assert_eq!(
            balanced_shares(&InertiaSplit::Cubes, 1),
            Some((0.25, vec![0.75]))
        );
        assert_eq!(
            balanced_shares(&InertiaSplit::Equal, 1),
            Some((0.5, vec![0.5]))
        );
        assert_eq!(balanced_shares(&InertiaSplit::Shares(vec![1.0]), 1), None);
    }

    #[test]
    fn each_cell_keeps_its_own_moment() {
        // By a sum over a fine division of the cell, in place of the closed form.
        let (n, fine) = (5, 4000);
        let (end, shares) = balanced_shares(&InertiaSplit::Cubes, n).unwrap();
        let mut expected = vec![0.0; n + 1];
        for piece in 0..n * fine {
            let s = (piece as f64 + 0.5) / (n * fine) as f64;
            let (cell, inertia) = (piece / fine, 3.0 * s * s / (n * fine) as f64);
            let x = s * n as f64 - cell as f64;
            expected[cell] += inertia * (1.0 - x);
            expected[cell + 1] += inertia * x;
        }
        for (found, expected) in std::iter::once(&end).chain(&shares).zip(&expected) {
            approx::assert_abs_diff_eq!(found, expected, epsilon = 1e-8);
        }
    }
}
