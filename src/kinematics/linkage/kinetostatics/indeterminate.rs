//! Reactions that rigid links leave open.
//!
//! The equations of equilibrium of a linkage with redundant constraints have more unknowns than rows.
//! The further rows take as many unknowns as zero, at each position those that the others replace
//! best: so nothing is singular that moves. With a unit in one of these rows in place of that zero,
//! and nothing else on the right side, they give a state of self-stress: forces that the pairs exert on
//! each other without any load. All such states together are the null space of the equilibrium. An
//! unknown that takes part in one of them is statically indeterminate: it depends on elasticity,
//! clearances and errors of length.
//!
//! Elimination with the greatest pivot of all finds the unknowns that the others replace best.
//! The columns of the inverse at these rows span the null space. Friction of an indeterminate
//! pair makes what it acts on indeterminate too.

use super::workspace::ForceWorkspace;
use super::{InputMotion, Kinetostatics, Options};
use crate::fault::Fault;
use crate::kinematics::linkage::Linkage;
use crate::kinematics::linkage::multi::spec::InputSpec;
use crate::kinematics::linkage::multi::{MultiLinkage, MultiMotion};
use crate::math::jet::Jet;
use crate::math::linear::Factors;

/// Part of the greatest force of a state of self-stress that is rounding.
const ROUNDING: f64 = 1e-8;

/// Forces that depend on how the redundant constraints share the load.
#[derive(Clone, Debug, Default, PartialEq)]
pub struct Indeterminate {
    /// Of every pair whether its reaction does.
    pub pairs: Vec<bool>,
    /// Of every coupling whether its force does.
    pub couplings: Vec<bool>,
    /// Of every weld whether its force or couple does.
    pub welds: Vec<bool>,
    /// True where the driving force does: by the friction of such pairs.
    pub drive: bool,
}

impl Indeterminate {
    /// True where nothing is left open.
    pub fn is_empty(&self) -> bool {
        !(self.drive
            || self.pairs.contains(&true)
            || self.couplings.contains(&true)
            || self.welds.contains(&true))
    }

    /// Takes in what is left open at another position.
    pub fn merge_with(&mut self, other: &Self) {
        let join = |own: &mut Vec<bool>, other: &[bool]| {
            own.resize(other.len(), false);
            for (own, other) in own.iter_mut().zip(other) {
                *own |= other;
            }
        };
        join(&mut self.pairs, &other.pairs);
        join(&mut self.couplings, &other.couplings);
        join(&mut self.welds, &other.welds);
        self.drive |= other.drive;
    }
}

impl Kinetostatics {
    /// Writes the rows of the unknowns that are zero, as many as there are redundant constraints.
    pub(super) fn set_spare_unknowns(&self, factors: &mut Factors) {
        if self.redundant == 0 {
            return;
        }
        let first = 3 * self.spec.links.len();
        let spare = factors.spare_columns(first, self.drivers.len());
        for (k, column) in spare.into_iter().enumerate() {
            factors.add(first + k, column, 1.0);
        }
    }

    /// Which forces rigid links leave open, at the position that [`Self::solve`] solved last.
    ///
    /// Friction of a pair that is left open leaves open what it acts on, the driving force too.
    pub fn indeterminate(&self, w: &ForceWorkspace) -> Indeterminate {
        if self.redundant == 0 {
            return Indeterminate {
                pairs: vec![false; self.spec.pairs.len()],
                couplings: vec![false; self.spec.couplings.len()],
                welds: vec![false; self.spec.welds.len()],
                drive: false,
            };
        }
        let mut open = self.in_self_stress(w);
        while self.add_friction_unknowns(&mut open, w) {}
        let [pairs, rest] = {
            let (pairs, rest) = open.split_at(2 * self.spec.pairs.len());
            [pairs, rest]
        };
        let (couplings, rest) = rest.split_at(self.spec.couplings.len());
        let (welds, drives) = rest.split_at(3 * self.spec.welds.len());
        Indeterminate {
            pairs: pairs.chunks_exact(2).map(|two| two[0] | two[1]).collect(),
            couplings: couplings.to_vec(),
            welds: welds
                .chunks_exact(3)
                .map(|three| three.contains(&true))
                .collect(),
            drive: drives.contains(&true),
        }
    }

    /// The fault of a linkage whose motion cannot follow from the friction of its pairs, because
    /// rigid links leave their reactions open.
    pub fn friction_left_open(&self, linkage: &Linkage) -> Option<Fault> {
        let options = Options {
            friction: false,
            ..Options::default()
        };
        let motion = InputMotion {
            coordinate: linkage.range().start,
            speed: 0.0,
            acceleration: 0.0,
        };
        let (mut at, mut w) = (linkage.workspace(), self.workspace());
        linkage.solve(motion.coordinate, 3, &mut at).ok()?;
        self.solve(&at, motion, &options, &mut w).ok()?;
        self.open_friction(&w)
    }

    /// The same of a linkage of several inputs.
    pub fn friction_of_inputs_left_open(&self, linkage: &MultiLinkage) -> Option<Fault> {
        let (mut motion, mut w) = (MultiMotion::new(linkage), self.workspace());
        let start = |input: &InputSpec| Jet {
            value: input.start,
            first: 1.0,
            ..Jet::default()
        };
        let inputs: Vec<Jet> = linkage.inputs().iter().map(start).collect();
        motion.set_inputs(&inputs).ok()?;
        let rates = vec![1.0; inputs.len()];
        let options = Options {
            friction: false,
            ..Options::default()
        };
        self.solve_over_time(&motion, &rates, &options, &mut w)
            .ok()?;
        self.open_friction(&w)
    }

    /// The fault of the first pair that rubs and whose reaction is left open.
    fn open_friction(&self, w: &ForceWorkspace) -> Option<Fault> {
        let open = self.indeterminate(w).pairs;
        let mut pairs = (0..open.len()).filter(|&pair| open[pair]);
        let pair = pairs.find(|&pair| self.friction_factors[pair].is_some())?;
        let name = &self.spec.pairs[pair].name;
        let hint = "leave out its friction, or what is redundant";
        Some(Fault::new(
            format!("pairs.{name}.friction"),
            format!(
                "the reaction of `{name}` is statically indeterminate, and so is its friction in the motion"
            ),
            hint,
        ))
    }

    /// Unknowns that take part in a state of self-stress.
    fn in_self_stress(&self, w: &ForceWorkspace) -> Vec<bool> {
        let (size, count) = (self.equations_count(), self.redundant);
        let mut states = vec![0.0; size * count];
        for k in 0..count {
            states[(size - count + k) * count + k] = 1.0;
        }
        w.factors.solve(&mut states, count);
        columns_in_use(&states, count, size)
    }

    /// Takes in the unknowns that the friction of open pairs acts on; true if there were new ones.
    fn add_friction_unknowns(&self, open: &mut [bool], w: &ForceWorkspace) -> bool {
        let mut grew = false;
        for term in &w.terms {
            if !(open[term.unknown] || open[term.unknown + 1]) {
                continue;
            }
            for column in term.column..term.column + term.width() {
                let each: Vec<f64> = (0..open.len()).map(|row| w.k(row, column)).collect();
                for (open, used) in open.iter_mut().zip(columns_in_use(&each, 1, each.len())) {
                    grew |= used && !*open;
                    *open |= used;
                }
            }
        }
        grew
    }
}

/// Rows in which one of `count` columns is more than rounding of its greatest entry.
fn columns_in_use(values: &[f64], count: usize, size: usize) -> Vec<bool> {
    let mut used = vec![false; size];
    for column in 0..count {
        let entry = |row: usize| values[row * count + column].abs();
        let greatest = (0..size).map(entry).fold(0.0, f64::max);
        for (row, used) in used.iter_mut().enumerate() {
            *used |= entry(row) > ROUNDING * greatest;
        }
    }
    used
}
