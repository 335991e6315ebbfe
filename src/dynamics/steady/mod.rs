//! The steady motion of a machine with one degree of freedom and rigid links.
//!
//! The machine is reduced to its input link: a moment of inertia J(φ) and a
//! moment M of all external forces (driving positive, weights and springs
//! included), over a cycle Φ. SI units, angles in radians.
//!
//! * [`Profile`]: J and M as functions of the position, followed to rounding by
//!   polynomials; [`Table`]: the same as samples.
//! * [`find_steady_motion`]: forces that depend on the position alone. Every speed level is
//!   periodic; the mean speed asked for selects one ([`Mean`]: over time, over
//!   the angle, or midway between the extremes). The energy-mass method.
//! * [`cycle_map`]: moments that depend on speed, such as a motor's
//!   characteristic: the motion that comes back to its speed after a cycle, and
//!   whether others settle on it.
//! * [`flywheel`]: the inertia for a required coefficient of fluctuation.
//! * [`Formula`]: J, M or the work written as an expression of φ.
//!
//! What has no answer is a [`Refusal`] with its numbers: work left over in a
//! cycle, J not above zero, a mean below the lowest of all motions without a
//! stop, a stall.
//!
//! Nothing here depends on a scene.
//!
//! Source: V. Malkov, A. Vlasova, P. Nosko, V. Stavitsky, An iterative method of
//! dynamic analysis of a mechanism, TEKA Kom. Mot. i Energ. Roln. 11A, 2011,
//! 145–150. Two things differ from it: the lower end of its bracket is raised
//! to where the kinetic energy stays above zero, and the bracket shrinks.

pub mod cycle_map;
mod extrapolation;
mod fit;
pub mod flywheel;
mod formula;
mod given;
mod law;
mod motion;
mod panel;
mod profile;
mod refusal;
mod repeat;
mod samples;
mod table;
mod table_motion;

pub use formula::Formula;
pub use given::FunctionKind;
pub use law::{Means, Question, SteadyFigures};
pub use motion::{Check, Row, SteadyMotion, find_steady_motion};
pub use panel::Point;
pub use profile::{Extreme, MOST_TURNS, Profile};
pub use refusal::{Field, Refusal};
pub use repeat::least_cycle;
pub use table::Table;
pub use table_motion::{SampleHalving, TableFigures, TableMotion};

use serde::Serialize;

/// Meaning of the mean angular speed.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq, Serialize)]
#[serde(rename_all = "snake_case")]
pub enum Mean {
    /// Φ / ∫dφ/ω: angle turned over time, what a rev counter shows.
    #[default]
    Time,
    /// (1/Φ)·∫ω dφ: the mean of the graph ω(φ).
    Angle,
    /// (ω_max + ω_min)/2.
    Midrange,
}

impl Mean {
    /// All readings.
    pub const ALL: [Self; 3] = [Self::Time, Self::Angle, Self::Midrange];

    /// Name in scenes and arguments.
    pub fn name(self) -> &'static str {
        match self {
            Self::Time => "time",
            Self::Angle => "angle",
            Self::Midrange => "midrange",
        }
    }

    /// Meaning in words.
    pub fn words(self) -> &'static str {
        match self {
            Self::Time => "mean over time",
            Self::Angle => "mean over the angle",
            Self::Midrange => "midway between the extremes",
        }
    }
}
