//! The positions at which the short form of a linkage can be assembled.
//!
//! A linkage in full finds its reach by a walk from an assembled start. A short
//! form is also asked from where it cannot be assembled, how far off that is; its
//! reach is where the least values of the factors of its closure are negative,
//! known in closed form. The tests of [`super::short_form`] hold both against each
//! other.

use crate::math::order::by_first;
use crate::units::shown;
use std::f64::consts::{PI, TAU};
use std::fmt;

/// The driver's displacement is outside what the position function reaches.
#[derive(Clone, Debug, PartialEq)]
pub struct OutOfReach {
    /// The intervals of φ in which it can be assembled, those nearest to the
    /// displacement asked for, ascending (rad, or m of a sliding driver).
    pub intervals: Vec<(f64, f64)>,
}

impl fmt::Display for OutOfReach {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        for (index, (from, to)) in self.intervals.iter().enumerate() {
            let word = if index > 0 { " or " } else { "" };
            let (from, to) = (shown(*from, 7), shown(*to, 7));
            write!(f, "{word}from {from} to {to}")?;
        }
        Ok(())
    }
}

impl std::error::Error for OutOfReach {}

/// The forbidden crank angles of a planar linkage: up to two arcs, each
/// symmetric about its centre, the centres half a turn apart.
///
/// An arc of half-width 0 is a single angle: a dead-centre position that can be
/// reached but past which the linkage may go on in two ways (a change point);
/// it ends the reach like any other.
#[derive(Clone, Copy, Debug, PartialEq)]
pub(super) struct ForbiddenArcs {
    /// Crank angle θ at the centre of the first arc (rad); the second is at + π.
    pub(super) centre: f64,
    /// Half-widths of the two arcs (rad); `None`: no arc.
    pub(super) half_widths: [Option<f64>; 2],
}

impl ForbiddenArcs {
    /// The open interval around θ, `None` when the crank turns fully.
    pub(super) fn reach_from(&self, theta: f64) -> Result<Option<(f64, f64)>, OutOfReach> {
        let intervals = self.nearest_intervals(theta);
        if intervals.is_empty() {
            return Ok(None);
        }
        let holds = |&(from, to): &(f64, f64)| from < theta && theta < to;
        match intervals.iter().copied().find(holds) {
            Some(interval) => Ok(Some(interval)),
            None => Err(OutOfReach { intervals }),
        }
    }

    /// The one or two intervals nearest to θ; empty when the crank turns fully.
    fn nearest_intervals(&self, theta: f64) -> Vec<(f64, f64)> {
        let ForbiddenArcs {
            centre,
            half_widths,
        } = *self;
        let near = |middle: f64, half: f64| {
            let middle = middle + TAU * ((theta - middle) / TAU).round();
            (middle - half, middle + half)
        };
        let mut intervals = match half_widths {
            [None, None] => Vec::new(),
            [Some(width), None] => vec![near(centre + PI, PI - width)],
            [None, Some(width)] => vec![near(centre, PI - width)],
            [Some(first), Some(second)] => {
                // Between the arcs, on either side of the centre line.
                let half = 0.5 * (PI - first - second);
                let middle = 0.5 * (PI + first - second);
                vec![near(centre - middle, half), near(centre + middle, half)]
            }
        };
        by_first(&mut intervals);
        intervals
    }
}

/// Half-width of an arc from a quantity that is negative inside it: `depth` at
/// its centre (≥ 0 where there is an arc) and `height` at the opposite angle,
/// going as height·sin²(α/2) − depth·cos²(α/2) at α from the centre.
///
/// A depth below rounding of `size` counts as an arc of no width.
pub(super) fn half_width(depth: f64, height: f64, size: f64) -> Option<f64> {
    if depth < -1e-13 * size {
        return None;
    }
    Some(2.0 * depth.max(0.0).sqrt().atan2(height.max(0.0).sqrt()))
}

#[cfg(test)]
mod tests {
    use super::ForbiddenArcs;
    use std::f64::consts::{PI, TAU};

    #[test]
    fn reach_is_the_interval_around_the_angle_on_its_turn() {
        let arcs = ForbiddenArcs {
            centre: 0.0,
            half_widths: [Some(0.5), Some(0.25)],
        };
        for turn in [-3.0, 0.0, 7.0] {
            let shift = turn * TAU;
            for (theta, from, to) in [(1.0, 0.5, PI - 0.25), (-2.0, 0.25 - PI, -0.5)] {
                let found = arcs.reach_from(theta + shift).unwrap().unwrap();
                approx::assert_abs_diff_eq!(found.0, from + shift, epsilon = 1e-13);
                approx::assert_abs_diff_eq!(found.1, to + shift, epsilon = 1e-13);
            }
        }
        let outside = arcs.reach_from(0.1).unwrap_err();
        assert_eq!(outside.intervals.len(), 2);
        assert!(outside.to_string().contains("from 0.5 to 2.891593"));
        let free = ForbiddenArcs {
            centre: 1.0,
            half_widths: [None, None],
        };
        assert_eq!(free.reach_from(3.0), Ok(None));
    }

    #[test]
    fn one_arc_leaves_one_interval_a_turn() {
        let arcs = ForbiddenArcs {
            centre: PI / 2.0,
            half_widths: [None, Some(1.0)],
        };
        let (from, to) = arcs.reach_from(0.0).unwrap().unwrap();
        approx::assert_abs_diff_eq!(from, 1.0 - PI / 2.0, epsilon = 1e-15);
        approx::assert_abs_diff_eq!(to, 1.5 * PI - 1.0, epsilon = 1e-15);
        assert!(arcs.reach_from(-PI / 2.0).is_err());
    }
}
