//! What moves on the picture of a machine, and how.

use crate::report::html::player::Body;

/// A picture with its parts.
#[derive(Clone, Debug, Default)]
pub(super) struct Picture {
    /// Elements within its `<svg>`.
    pub(super) drawn: String,
    /// Width and height (pixels).
    pub(super) size: [f64; 2],
    /// Moving parts.
    pub(super) bodies: Vec<Body>,
    /// Length of a unit of the displacement (pixels).
    pub(super) pixels: f64,
}

/// Way of an object: where it was over a run.
#[derive(Clone, Copy, Debug)]
pub(super) struct ObjectPath {
    /// Displacement at the first sample.
    pub(super) start: f64,
    /// Least and greatest displacement.
    pub(super) range: [f64; 2],
}
