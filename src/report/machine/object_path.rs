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
    /// Pixels at which the motion of what drives it comes in: one, or one for each input.
    pub(super) inlets: Vec<[f64; 2]>,
    /// Pixel at which its own motion goes out.
    pub(super) outlet: [f64; 2],
    /// Pixels at which the motion of outputs goes out, by their ids.
    pub(super) outlets: Vec<(String, [f64; 2])>,
    /// Pixels a metre of a picture to scale.
    pub(super) scale: Option<f64>,
    /// True where it shows what drives the object too: its cam, its crank.
    pub(super) shows_driver: bool,
    /// Where loads act: on the object, on its outputs, on what drives it, by their ids.
    pub(super) grips: Vec<(String, Grip)>,
}

impl Picture {
    /// The pixel at which an input comes in.
    pub(super) fn inlet(&self, input: usize) -> [f64; 2] {
        let own = self.inlets.get(input).or(self.inlets.first());
        own.copied().unwrap_or([0.0, 0.5 * self.size[1]])
    }

    /// The pixel at which the motion of an output goes out, or of the object itself.
    pub(super) fn outlet(&self, output: Option<&str>) -> [f64; 2] {
        let named = |id| self.outlets.iter().find(|(own, _)| own == id);
        output.and_then(named).map_or(self.outlet, |(_, at)| *at)
    }
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
    /// True where the direction is that of the picture, and does not turn with the part.
    pub(super) fixed: bool,
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
