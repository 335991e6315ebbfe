//! Position functions as a scene states them: plain numbers in SI units.

use super::function::PositionFunction;
use crate::kinematics::motion::{CycleSpec, LawSpec};
use std::sync::Arc;

/// A position function as described in a scene.
#[derive(Clone, Debug, PartialEq)]
pub enum PositionSpec {
    /// `{ "ratio": 0.5 }` or `{ "ratio": { "ratio": 0.5, "offset": "10 deg" } }`.
    Ratio {
        /// U′.
        ratio: f64,
        /// U(0).
        offset: f64,
    },
    /// `{ "sine": { "amplitude", "harmonic" = 1, "phase" = 0, "offset" = 0 } }`.
    Sine {
        /// Half the stroke.
        amplitude: f64,
        /// Oscillations per radian·2π of the driver.
        harmonic: f64,
        /// Phase (rad).
        phase: f64,
        /// Middle of the stroke.
        offset: f64,
    },
    /// `{ "polynomial": { "coefficients": [a0, a1, …] } }`: U = Σ a_k φ^k.
    Polynomial {
        /// Coefficients in SI, lowest power first; at least one.
        coefficients: Vec<f64>,
    },
    /// `{ "table": { "points": [[φ, U], …], "periodic": bool } }`: a spline
    /// through the points, at least three, φ ascending.
    Table {
        /// (φ, U), φ strictly ascending.
        points: Vec<(f64, f64)>,
        /// True: the last point closes the period (U equal to the first).
        periodic: bool,
        /// Slopes U′ at both ends of a clamped table (default 0, 0).
        end_slopes: (f64, f64),
    },
    /// `{ "slider_crank": { "crank", "rod", "offset" = 0, "branch" = "+", "phase" = 0 } }`:
    /// U = r cos θ ± √(l² − (r sin θ − e)²), θ = φ + phase; the slide's
    /// distance from the crank's axis along the guide (m).
    SliderCrank {
        /// Crank radius r (m).
        crank: f64,
        /// Connecting rod length l (m).
        rod: f64,
        /// Offset e of the guide from the crank's axis (m).
        offset: f64,
        /// +1 or −1: sign of the root.
        branch: f64,
        /// Added to the driver's displacement (rad).
        phase: f64,
    },
    /// `{ "four_bar": { "crank", "coupler", "rocker", "frame", "branch" = "+", "phase" = 0 } }`:
    /// the rocker's angle, both angles measured from the line of the two fixed
    /// pivots, from the crank's pivot towards the rocker's (rad).
    FourBar {
        /// Driving crank length (m).
        crank: f64,
        /// Coupler length (m).
        coupler: f64,
        /// Rocker length (m).
        rocker: f64,
        /// Distance of the fixed pivots (m).
        frame: f64,
        /// +1: open; −1: crossed.
        branch: f64,
        /// Added to the driver's displacement (rad).
        phase: f64,
    },
    /// `{ "slotted_link": { "crank", "frame", "driver" = "crank", "output" =
    /// "link", "branch" = "+", "phase" = 0 } }`: crank, block and slotted link
    /// on two fixed pivots.
    SlottedLink(SlottedLinkSpec),
    /// `{ "cam": { "rise", "dwell", "return", "rest", "lift", "law", "phase" } }`.
    Cam(CamSpec),
    /// `{ "plan": { "stations", "period", "advance" = 0, "phase" = 0 } }`: any
    /// number of rises, dwells and returns.
    Plan(CycleSpec),
    /// Anything else: no scene describes it, a kind of object brings it along.
    Custom(CustomPosition),
}

/// A position function that this library does not know. Two are equal that are the same
/// one.
#[derive(Clone, Debug)]
pub struct CustomPosition(pub Arc<dyn PositionFunction>);

impl PartialEq for CustomPosition {
    fn eq(&self, other: &Self) -> bool {
        Arc::ptr_eq(&self.0, &other.0)
    }
}

/// A crank whose end carries a block that slides along a slotted link; crank and
/// link turn about fixed pivots.
///
/// Both angles are measured from the line of the pivots, from that of the
/// slotted link towards that of the crank: at 0 the block is farthest from the
/// pivot of the slotted link.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct SlottedLinkSpec {
    /// Crank length l (m).
    pub crank: f64,
    /// Distance D of the fixed pivots (m); may be 0 when the crank drives.
    pub frame: f64,
    /// Driver: the member whose coordinate, less the phase, is φ.
    pub driver: SlottedDriver,
    /// Output: the coordinate that U is.
    pub output: SlottedOutput,
    /// When the block drives, +1 or −1: the crank turns counterclockwise or
    /// clockwise as the block moves away from the pivot of the slotted link.
    pub branch: f64,
    /// Added to the driver's displacement (rad; m when the block drives).
    pub phase: f64,
}

/// The driven part of a slotted-link mechanism.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum SlottedDriver {
    /// The crank: its angle φ1 (rad).
    Crank,
    /// The block: its distance S from the pivot of the slotted link (m).
    Block,
}

/// The output of a slotted-link mechanism.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum SlottedOutput {
    /// Angle φ2 of the slotted link (rad).
    Link,
    /// Angle φ1 of the crank (rad).
    Crank,
    /// Distance S of the block from the pivot of the slotted link (m).
    Block,
}

impl PositionSpec {
    /// A position function of your own.
    pub fn own(function: impl PositionFunction + 'static) -> Self {
        Self::Custom(CustomPosition(Arc::new(function)))
    }
}

/// A cam with one rise and one return per turn.
///
/// θ = φ + phase runs: rise from 0 to `lift` over `rise`, dwell at the top over
/// `dwell`, return over `return_angle`, rest at 0 for what is left of the turn.
#[derive(Clone, Debug, PartialEq)]
pub struct CamSpec {
    /// Full stroke (rad or m).
    pub lift: f64,
    /// Angle of the rise (rad), > 0.
    pub rise: f64,
    /// Angle of the upper dwell (rad), ≥ 0.
    pub dwell: f64,
    /// Angle of the return (rad), > 0.
    pub return_angle: f64,
    /// Law of the rise.
    pub rise_law: LawSpec,
    /// Law of the return, run backwards.
    pub return_law: LawSpec,
    /// Added to the driver's displacement (rad).
    pub phase: f64,
}
