//! A cam of one link on which a roller of another one runs, in plain numbers.

use crate::kinematics::cam::spec::Surface;
use crate::kinematics::position::spec::PositionSpec;

/// A cam of one link and a roller (or a point) of another one.
///
/// In the frame of the cam the roller's centre lies on the pitch curve, polar about `centre`:
/// R(ψ) = prime radius + lift(φ), φ = sense·(ψ − direction), ψ counterclockwise.
#[derive(Clone, Debug, PartialEq)]
pub struct CamPairSpec {
    /// Centre of the polar form in the frame of the cam's link (m).
    pub centre: [f64; 2],
    /// The roller's centre, or the point, in the frame of its link (m).
    pub roller: [f64; 2],
    /// Radius of the roller ≥ 0 (m); 0: a point.
    pub roller_radius: f64,
    /// Radius of the profile (of a groove: of its inner flank) where the lift is zero (m), > 0.
    pub base_radius: f64,
    /// The lift over the angle φ (m over rad), which repeats after a turn; `None`: a circle.
    pub lift: Option<PositionSpec>,
    /// Direction from which φ is counted, in the frame of the cam's link (rad).
    pub direction: f64,
    /// +1: φ is counted counterclockwise; −1: clockwise.
    pub sense: f64,
    /// The side of the cam that is touched.
    pub surface: Surface,
}

impl CamPairSpec {
    /// Radius of the pitch curve where the lift is zero (m).
    pub fn prime_radius(&self) -> f64 {
        self.surface
            .prime_radius(self.base_radius, self.roller_radius)
    }
}
