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
    /// Pixels at which the motion of what drives it comes in, and its own goes out.
    pub(super) inlet: [f64; 2],
    pub(super) outlet: [f64; 2],
    /// Pixels a metre of a picture to scale.
    pub(super) scale: Option<f64>,
    /// True where it shows what drives the object too: its cam, its crank.
    pub(super) shows_driver: bool,
    /// Where loads act on the object.
    pub(super) grip: Option<Grip>,
}

/// Place of the arrow of a load on a moving part.
#[derive(Clone, Copy, Debug)]
pub(super) struct Grip {
    /// Number of the part within its picture.
    pub(super) part: usize,
    /// The place in the frame of the part (pixels, y downwards).
    pub(super) at: [f64; 2],
    /// Direction of a positive force there, of length 1.
    pub(super) along: [f64; 2],
}

/// Way of an object: where it was over a run.
#[derive(Clone, Copy, Debug)]
pub(super) struct ObjectPath {
    /// Displacement at the first sample.
    pub(super) start: f64,
    /// Least and greatest displacement.
    pub(super) range: [f64; 2],
    /// True where the displacement at the last sample is not below that at the first.
    pub(super) forward: bool,
    /// True where it never goes back.
    pub(super) one_way: bool,
}

/// Least angle by which a drive turns whose sense is shown (rad).
pub(super) const TURNS: f64 = 0.3;
