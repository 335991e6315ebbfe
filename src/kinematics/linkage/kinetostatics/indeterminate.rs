//! Reactions that rigid links leave open.
//!
//! The equations of equilibrium of a linkage with redundant constraints have more unknowns than rows.
//! The further rows take the forces of what is redundant as zero; with a unit in one of them in place
//! of that zero, and nothing else on the right side, they give a state of self-stress: forces that
//! the pairs exert on each other without any load. All such states together are the null space of
//! the equilibrium, whichever constraints were called redundant. An unknown that takes part in one of
//! them is statically indeterminate: it depends on elasticity, clearances and errors of length.

use super::Kinetostatics;
use super::positions::LinkPosition;
use super::workspace::ForceWorkspace;
use crate::kinematics::linkage::spec::{LinkageSpec, Redundant, RedundantPart};

/// Part of the greatest force of a state of self-stress that is rounding.
const ROUNDING: f64 = 1e-8;

/// An unknown, or a sum of the two of a pair, that is zero.
#[derive(Clone, Copy, Debug, PartialEq)]
pub(super) enum Idle {
    /// One of the two unknowns of a pair.
    One { pair: usize, which: usize },
    /// The force of a pin along a direction of its link.
    Along {
        pair: usize,
        link: usize,
        direction: [f64; 2],
    },
    /// The couple of a guide about its block's point.
    Couple { pair: usize },
}

/// What is zero where the redundant constraints carry nothing.
pub(super) fn idle(spec: &LinkageSpec) -> Vec<Idle> {
    let of = |one: &Redundant| {
        let pair = one.pair;
        match one.part {
            RedundantPart::Whole => {
                vec![Idle::One { pair, which: 0 }, Idle::One { pair, which: 1 }]
            }
            RedundantPart::Couple => vec![Idle::Couple { pair }],
            RedundantPart::Along(link) => {
                let direction = one.direction(spec).unwrap_or([1.0, 0.0]);
                vec![Idle::Along {
                    pair,
                    link,
                    direction,
                }]
            }
        }
    };
    spec.redundant.iter().flat_map(of).collect()
}

/// Forces that depend on how the redundant constraints share the load.
#[derive(Clone, Debug, Default, PartialEq)]
pub struct Indeterminate {
    /// Of every pair whether its reaction does.
    pub pairs: Vec<bool>,
    /// Of every coupling whether its force does.
    pub couplings: Vec<bool>,
    /// True where the driving force does: by the friction of such pairs.
    pub drive: bool,
}

impl Indeterminate {
    /// True where nothing is left open.
    pub fn is_empty(&self) -> bool {
        !(self.drive || self.pairs.contains(&true) || self.couplings.contains(&true))
    }

    /// Takes in what is left open at another position.
    pub fn join(&mut self, other: &Self) {
        let join = |own: &mut Vec<bool>, other: &[bool]| {
            own.resize(other.len(), false);
            for (own, other) in own.iter_mut().zip(other) {
                *own |= other;
            }
        };
        join(&mut self.pairs, &other.pairs);
        join(&mut self.couplings, &other.couplings);
        self.drive |= other.drive;
    }
}

impl Kinetostatics {
    /// Entries of the rows of what is zero: row, column, value.
    pub(super) fn each_idle_entry(
        &self,
        links: &[LinkPosition],
        mut add: impl FnMut(usize, usize, f64),
    ) {
        let first = 3 * self.spec.links.len();
        for (k, idle) in self.idle.iter().enumerate() {
            let row = first + k;
            let (pair, values) = match *idle {
                Idle::One { pair, which: 0 } => (pair, [1.0, 0.0]),
                Idle::One { pair, .. } => (pair, [0.0, 1.0]),
                Idle::Along {
                    pair,
                    link,
                    direction,
                } => (pair, links[link].turned(direction)),
                Idle::Couple { pair } => (pair, self.corners[pair].map(|b| b / self.length)),
            };
            add(row, 2 * pair, values[0]);
            add(row, 2 * pair + 1, values[1]);
        }
    }

    /// Which forces rigid links leave open, at the position that [`Self::solve`] solved last.
    ///
    /// Friction of a pair that is left open leaves open what it acts on, the driving force too.
    pub fn indeterminate(&self, w: &ForceWorkspace) -> Indeterminate {
        if self.idle.is_empty() {
            return Indeterminate {
                pairs: vec![false; self.spec.pairs.len()],
                couplings: vec![false; self.spec.couplings.len()],
                drive: false,
            };
        }
        let mut open = self.in_self_stress(w);
        while self.rubs_on(&mut open, w) {}
        let [pairs, rest] = {
            let (pairs, rest) = open.split_at(2 * self.spec.pairs.len());
            [pairs, rest]
        };
        let (couplings, drives) = rest.split_at(self.spec.couplings.len());
        Indeterminate {
            pairs: pairs.chunks_exact(2).map(|two| two[0] | two[1]).collect(),
            couplings: couplings.to_vec(),
            drive: drives.contains(&true),
        }
    }

    /// Unknowns that take part in a state of self-stress.
    fn in_self_stress(&self, w: &ForceWorkspace) -> Vec<bool> {
        let (size, count) = (self.size(), self.idle.len());
        let mut states = vec![0.0; size * count];
        for k in 0..count {
            states[(size - count + k) * count + k] = 1.0;
        }
        w.factors.solve(&mut states, count);
        columns_in_use(&states, count, size)
    }

    /// Takes in the unknowns that the friction of open pairs acts on; true if there were new ones.
    fn rubs_on(&self, open: &mut [bool], w: &ForceWorkspace) -> bool {
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
