//! What a quantity rests on, and which quantities rigid links leave open.

use super::{Column, ForceStudy, Row};
use crate::kinematics::linkage::kinetostatics::Indeterminate;

/// A force that a quantity is reckoned from.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Rests {
    /// Reaction of a pair, index into the linkage's pairs.
    Pair(usize),
    /// Force of a coupling, index into the linkage's couplings.
    Coupling(usize),
    /// Force and couple of a weld, index into the linkage's welds.
    Weld(usize),
    /// Driving force, or all friction together.
    Drive,
}

impl Rests {
    /// True where the force is statically indeterminate.
    fn is_open(self, open: &Indeterminate) -> bool {
        let among = |list: &[bool], index: usize| list.get(index).copied().unwrap_or(false);
        match self {
            Self::Pair(pair) => among(&open.pairs, pair),
            Self::Coupling(coupling) => among(&open.couplings, coupling),
            Self::Weld(weld) => among(&open.welds, weld),
            Self::Drive => open.drive,
        }
    }
}

/// What is left open at any position.
pub(super) fn indeterminate_anywhere(rows: &[Row]) -> Indeterminate {
    let mut all = Indeterminate::default();
    for forces in rows.iter().filter_map(|row| row.forces.as_ref().ok()) {
        all.merge_with(&forces.indeterminate);
    }
    all
}

/// Marks the quantities that are left open.
pub(super) fn mark_indeterminate(columns: &mut [Column], open: &Indeterminate) {
    for column in columns {
        column.indeterminate = column.rests.iter().any(|force| force.is_open(open));
    }
}

impl ForceStudy {
    /// True where the reaction of a pair is statically indeterminate.
    pub fn is_open(&self, pair: usize) -> bool {
        Rests::Pair(pair).is_open(&self.indeterminate)
    }

    /// Names of the pairs, welds and couplings whose forces are statically indeterminate.
    pub fn open_names(&self) -> Vec<&str> {
        let pairs = self.linkage.pairs.iter().zip(&self.indeterminate.pairs);
        let pairs = pairs.filter(|(_, open)| **open).map(|(one, _)| &one.name);
        let couplings = &self.indeterminate.couplings;
        let couplings = self.linkage.couplings.iter().zip(couplings);
        let couplings = couplings
            .filter(|(_, open)| **open)
            .map(|(one, _)| &one.name);
        let welds = self.linkage.welds.iter().zip(&self.indeterminate.welds);
        let welds = welds.filter(|(_, open)| **open).map(|(one, _)| &one.name);
        let all = pairs.chain(welds).chain(couplings);
        all.map(String::as_str).collect()
    }
}
