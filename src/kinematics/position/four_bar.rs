//! Four-bar linkage: a crank drives a rocker through a coupler.

use super::assembly_range::{ForbiddenArcs, OutOfReach, half_width};
use crate::fault::{Fault, Faults};
use crate::kinematics::linkage::closure::TwoCircles;
use crate::math::jet::Jet;
use crate::math::series::Series;
use std::f64::consts::PI;

/// The rocker's angle ψ over the crank's angle θ = φ + phase, both measured
/// from the line of the fixed pivots, from the crank's towards the rocker's (rad).
///
/// Loop: a·(cos θ, sin θ) + coupler b = (d, 0) + c·(cos ψ, sin ψ). The open
/// branch has the rocker on the same side of the pivots' line as the crank for
/// 0 < θ < π, its coupler not crossing that line. The crossed one is its mirror
/// image, ψ₋(−θ) = −ψ₊(θ). ψ is continuous over any number of turns: with a
/// crank longer than the frame (a double crank) it gains 2π a turn, otherwise
/// it comes back.
///
/// Where coupler and rocker are in line is a dead-centre position of the crank: ψ′
/// grows without bound there and ψ has no value beyond (derivatives, then
/// values, that are not numbers). A linkage that can fold flat (a
/// parallelogram) may leave that position in two ways; it is held to be dead.
///
/// It is the massless short form of a linkage ([`super::Position::as_linkage`])
/// and closes as its dyad does, coupler and rocker between the crank's end and
/// the rocker's pivot, with the same branches.
#[derive(Clone, Debug, PartialEq)]
pub struct FourBar {
    /// Driving crank length a (m), > 0.
    pub crank: f64,
    /// Coupler length b (m), > 0.
    pub coupler: f64,
    /// Rocker length c (m), > 0.
    pub rocker: f64,
    /// Distance d of the fixed pivots (m), > 0.
    pub frame: f64,
    /// +1: open; −1: crossed.
    pub branch: f64,
    /// Added to the driver's displacement (rad).
    pub phase: f64,
    /// Least values of the factors of the discriminant, f being the distance of
    /// the crank's end from the rocker's pivot: f² − (b − c)² at θ = 0,
    /// (b + c)² − f² at θ = π (m²).
    least: [f64; 2],
    arcs: ForbiddenArcs,
}

impl FourBar {
    /// A four-bar linkage of given lengths: `[crank, coupler, rocker, frame]`.
    ///
    /// # Errors
    /// Lengths that are out of range or cannot be closed at any angle; paths
    /// relative to `position`.
    pub fn new(lengths: [f64; 4], branch: f64, phase: f64) -> Result<Self, Vec<Fault>> {
        const NAMES: [&str; 4] = ["crank", "coupler", "rocker", "frame"];
        let mut faults = Faults::default();
        for (name, length) in NAMES.iter().zip(lengths) {
            faults.length(&format!("four_bar.{name}"), length);
        }
        faults.finite("four_bar.phase", phase);
        faults.branch("four_bar.branch", branch);
        faults.check()?;
        let total: f64 = lengths.iter().sum();
        for (name, length) in NAMES.iter().zip(lengths) {
            if length >= total - length {
                let others = total - length;
                let message = format!("{length} m is not shorter than the other three, {others} m");
                let hint = "no link may be as long as the other three together";
                faults.add(format!("four_bar.{name}"), message, hint);
            }
        }
        faults.check()?;
        let [a, b, c, d] = lengths;
        let least = [
            difference_of_squares(a - d, b - c),
            difference_of_squares(b + c, a + d),
        ];
        let size = total * total;
        let folded = half_width(-least[0], difference_of_squares(a + d, b - c), size);
        let stretched = half_width(-least[1], difference_of_squares(b + c, a - d), size);
        Ok(Self {
            crank: a,
            coupler: b,
            rocker: c,
            frame: d,
            branch,
            phase,
            least,
            arcs: ForbiddenArcs {
                centre: 0.0,
                half_widths: [folded, stretched],
            },
        })
    }

    /// ψ and its derivatives at `phi`.
    pub fn jet(&self, phi: f64) -> Jet {
        let Self {
            crank: a,
            coupler: b,
            rocker: c,
            frame: d,
            ..
        } = *self;
        let theta = phi + self.phase;
        let (half_sin, half_cos) = Series::<4>::sin_cos(0.5 * theta, 0.5);
        let (sin_square, cos_square) = (half_sin * half_sin, half_cos * half_cos);
        let sin = (half_sin * half_cos).scale(2.0);
        // Squares and differences of squares from sums of terms of one sign.
        let reach = sin_square.scale(4.0 * a * d);
        let closure = TwoCircles {
            factors: [
                cos_square.scale(4.0 * a * d).shift(self.least[1]),
                reach.shift(self.least[0]),
            ],
            along: reach.shift((a - d) * (a - d) + difference_of_squares(c, b)),
        };
        // Rocker first, seen from its pivot towards the crank's end: the dyad
        // looks the other way, from the crank's end, so that left is right.
        let swing = closure.vector_to_inner_pin(-self.branch).angle();
        self.direction(theta, sin, sin_square, swing).jet()
    }

    /// Direction from the rocker's pivot to the crank's end, unwrapped, and from
    /// there by `swing` to the rocker.
    // A linkage unwraps its angles by the table of its walk; here the vector is
    // known to stay within 90° of a direction that is continuous itself.
    fn direction(
        &self,
        theta: f64,
        sin: Series<4>,
        sin_square: Series<4>,
        swing: Series<4>,
    ) -> Series<4> {
        let (a, d) = (self.crank, self.frame);
        if a < d {
            // The vector never turns round: ψ stays about ±π.
            let towards = sin_square.scale(2.0 * a).shift(d - a);
            Series::atan2(-sin.scale(a), towards) + swing.shift(self.branch * PI)
        } else {
            // The vector turns with the crank, leading it by less than 90°.
            let towards = sin_square.scale(2.0 * d).shift(a - d);
            (Series::atan2(sin.scale(d), towards) + swing)
                .shift(theta)
                .tilt(1.0)
        }
    }

    /// The interval around `phi` in which it can be assembled; `None`: a full turn.
    ///
    /// # Errors
    /// It cannot be assembled at `phi`.
    pub fn reach_from(&self, phi: f64) -> Result<Option<(f64, f64)>, OutOfReach> {
        super::shifted(self.arcs.reach_from(phi + self.phase), self.phase)
    }
}

fn difference_of_squares(x: f64, y: f64) -> f64 {
    (x - y) * (x + y)
}

#[cfg(test)]
#[path = "four_bar_tests.rs"]
mod tests;
