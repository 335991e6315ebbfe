//! Ends of a course towards which quantities grow without bound: what they come to beside
//! them tells how near to the end a row lies, and is not what a picture is to scale with.

use crate::studies::kinematics::{Column, Kinematics};

/// Part of the axis that counts as beside an end.
const BESIDE: f64 = 0.04;

/// The places towards which some columns grow without bound.
pub(super) struct Endless {
    pub(super) ends: Vec<f64>,
    beside: f64,
}

impl Endless {
    /// Of the columns that are picked.
    pub(super) fn of(found: &Kinematics, picked: impl Fn(&Column) -> bool) -> Self {
        let columns = found.columns.iter().filter(|column| picked(column));
        let mut ends: Vec<f64> = columns.flat_map(|own| own.unbounded.clone()).collect();
        ends.sort_by(f64::total_cmp);
        ends.dedup();
        let places = &found.axis.values;
        let length = match (places.first(), places.last()) {
            (Some(first), Some(last)) => (last - first).abs(),
            _ => 0.0,
        };
        Self {
            ends,
            beside: BESIDE * length,
        }
    }

    /// True beside one of the ends.
    pub(super) fn is_near(&self, at: f64) -> bool {
        self.ends.iter().any(|end| (at - end).abs() <= self.beside)
    }
}
