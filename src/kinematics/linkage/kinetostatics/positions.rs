//! Where the links are and how they move with the input coordinate.

use crate::kinematics::linkage::Workspace;
use crate::kinematics::linkage::spec::PairKind;

/// Motion of the input at a position.
#[derive(Clone, Copy, Debug, Default, PartialEq)]
pub struct InputMotion {
    /// Coordinate (rad or m).
    pub coordinate: f64,
    /// Speed (rad/s or m/s).
    pub speed: f64,
    /// Acceleration (rad/s² or m/s²).
    pub acceleration: f64,
}

/// Place of a link's frame and its first two derivatives by the input
/// coordinate q.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct LinkPosition {
    /// Origin of the frame in the frame of the ground (m).
    pub origin: [f64; 2],
    /// Cosine of the frame's angle.
    pub cos: f64,
    /// Sine of the frame's angle.
    pub sin: f64,
    /// d/dq of the origin's coordinates and of the angle.
    pub first: [f64; 3],
    /// d²/dq² of the same.
    pub second: [f64; 3],
}

/// A point with its first two derivatives by the input coordinate.
#[derive(Clone, Copy, Debug, Default, PartialEq)]
pub struct PointPosition {
    /// The place (m).
    pub place: [f64; 2],
    /// First derivative of the point.
    pub first: [f64; 2],
    /// Second derivative of the point.
    pub second: [f64; 2],
}

/// Positions and transfer functions of a linkage at one input coordinate.
pub trait Positions {
    /// The link with this index.
    fn link(&self, index: usize) -> LinkPosition;
    /// First three derivatives of a pair's relative coordinate by the input
    /// coordinate.
    fn pair_rates(&self, index: usize) -> [f64; 3];
    /// Relative coordinate of a pair (rad or m).
    fn pair_coordinate(&self, index: usize) -> f64;
    /// Motions of several inputs; where there are any, all derivatives are over time.
    fn inputs(&self) -> Vec<InputMotion> {
        Vec::new()
    }
}

impl Positions for Workspace {
    #[inline]
    fn link(&self, index: usize) -> LinkPosition {
        let pose = self.pose(index);
        LinkPosition {
            origin: [pose.x, pose.y],
            cos: pose.cos,
            sin: pose.sin,
            first: self.transfer(index, 1),
            second: self.transfer(index, 2),
        }
    }

    #[inline]
    fn pair_rates(&self, index: usize) -> [f64; 3] {
        let pair = self.pair_spec(index);
        if let PairKind::Sliding { .. } = pair.kind {
            let jet = self.pair(index);
            return [jet.first, jet.second, jet.third];
        }
        let turning =
            |link: Option<usize>, k: usize| link.map_or(0.0, |link| self.transfer(link, k)[2]);
        [1, 2, 3].map(|k| turning(pair.link.link, k) - turning(pair.on.link, k))
    }

    fn pair_coordinate(&self, index: usize) -> f64 {
        self.pair(index).value
    }
}

impl LinkPosition {
    /// The ground: at rest.
    pub const GROUND: Self = Self {
        origin: [0.0; 2],
        cos: 1.0,
        sin: 0.0,
        first: [0.0; 3],
        second: [0.0; 3],
    };

    /// A vector of the link's frame in the frame of the ground.
    #[inline]
    pub fn vector_in_ground(&self, v: [f64; 2]) -> [f64; 2] {
        [
            self.cos * v[0] - self.sin * v[1],
            self.sin * v[0] + self.cos * v[1],
        ]
    }

    /// A point of the link's frame.
    #[inline]
    pub fn point(&self, at: [f64; 2]) -> PointPosition {
        let [rx, ry] = self.vector_in_ground(at);
        let [u, v, w] = self.first;
        let [a, b, e] = self.second;
        PointPosition {
            place: [self.origin[0] + rx, self.origin[1] + ry],
            first: [u - w * ry, v + w * rx],
            second: [a - e * ry - w * w * rx, b + e * rx - w * w * ry],
        }
    }
}

impl Default for LinkPosition {
    fn default() -> Self {
        Self::GROUND
    }
}
