//! A curve of a cam over its turn, sampled for charts.

use super::tables::rows;
use crate::kinematics::cam::DiscCam;

/// Angles of the diagrams (rad), with the piece of each.
pub(super) fn sampled(cam: &DiscCam) -> Vec<(usize, f64)> {
    rows(cam, PLACES)
}

/// Places of the cam that the page's player knows.
pub(super) const PLACES: usize = 720;
