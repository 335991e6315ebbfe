//! The result of the check of a run.

use crate::units::shown;
use serde::Serialize;
use std::fmt;

/// Defect of the equations of motion of a run, found from the scene by another way than the
/// one that the run was computed by.
#[derive(Clone, Debug, Default, PartialEq, Serialize)]
pub struct EquationCheck {
    /// Seed of the draws of instants and events.
    pub seed: u64,
    /// Instants looked at.
    pub instants: usize,
    /// Switches looked at.
    pub switches: usize,
    /// Greatest defect against its bound, as a share of the terms of its equation.
    pub defect: f64,
    /// Bound of the defect.
    pub bound: f64,
    /// Time of the defect (s).
    pub time: f64,
    /// Object that the defect concerns.
    pub object: String,
    /// Equation that the defect is one of.
    pub what: &'static str,
    /// Parts of the run that were not checked, and why.
    pub unchecked: Vec<String>,
}

impl fmt::Display for EquationCheck {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        write!(
            f,
            "{} of {} at {} s: the scene's own laws leave {} of its terms open, where {} is \
             allowed",
            self.what,
            self.object,
            shown(self.time, 7),
            shown(self.defect, 2),
            shown(self.bound, 2)
        )
    }
}

impl EquationCheck {
    /// True when every defect is within its bound; a defect that is not a number is not.
    pub fn is_kept(&self) -> bool {
        self.defect <= self.bound
    }

    /// Takes a defect into account: the one that is greatest against its bound stays.
    pub(crate) fn include(
        &mut self,
        defect: f64,
        bound: f64,
        place: (f64, &str),
        what: &'static str,
    ) {
        let worse = match (self.defect.is_nan(), defect.is_nan()) {
            (true, _) => false,
            (false, true) => true,
            (false, false) => defect * self.bound > self.defect * bound || self.what.is_empty(),
        };
        if worse {
            (self.defect, self.bound, self.time, self.what) = (defect, bound, place.0, what);
            self.object = place.1.to_owned();
        }
    }
}
