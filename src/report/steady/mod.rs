//! The steady motion as findings, rows and charts.

mod charts;
mod over_period;
mod periodic;
mod rigid;

pub use charts::wittenbauer;
pub use periodic::{periodic_findings, periodic_rows};
pub use rigid::{rigid_findings, rigid_rows};

use crate::dynamics::steady::cycle_map::Regime;
use crate::dynamics::steady::flywheel::Flywheel;
use crate::dynamics::steady::{Row, SampleHalving, SteadyFigures};
use crate::studies::steady::Agreement;

/// The steady motion of a machine reduced to its drive, as it is shown.
#[derive(Clone, Copy, Debug)]
pub struct SteadyReport<'a> {
    /// Title: the scene's name, or where the functions come from.
    pub title: &'a str,
    /// Φ (rad).
    pub cycle: f64,
    /// The figures.
    pub figures: &'a SteadyFigures,
    /// The motion, both ends of the cycle included.
    pub rows: &'a [Row],
    /// The fixed point of the cycle map.
    pub regime: Option<&'a Regime>,
    /// The flywheel.
    pub flywheel: Option<&'a Flywheel>,
    /// Agreement of independent ways.
    pub agreement: Option<&'a Agreement>,
    /// Of a table: what leaving out every second sample changes.
    pub halving: Option<&'a SampleHalving>,
}
