//! What a run leaves behind: columns of samples, figures, switches, provenance.

mod addresses;
mod audit;
mod figure;
mod figures;
mod joints;
mod observer;
mod pairs;
mod peaks;
mod pieces;
mod quantity;
mod recorder;
mod rows;
mod smoothness;
mod subdivision;
mod tee;
mod tracker;
mod window;

pub use addresses::AddressError;
pub use audit::EnergyAudit;
pub use figure::Figure;
pub use figures::{
    Figures, FinalState, JointFigures, ObjectFigures, PairFigures, RunSummary, Units,
    greatest_magnitude,
};
pub use quantity::Quantity;
pub use recorder::{Failure, Recorded, Recorder, RecorderSettings};
pub use tee::Tee;
pub use window::{choose_window, choose_window_of, drive_cycle};

/// A table over time.
#[derive(Clone, Debug, Default, PartialEq)]
pub struct Record {
    /// Sample times (s).
    pub times: Vec<f64>,
    /// Columns of the same length.
    pub columns: Vec<Column>,
    /// Every switch of every pair.
    pub switches: Vec<SwitchRow>,
    /// Open intervals of every pair, for shading plots.
    pub separations: Vec<Interval>,
}

/// One quantity of one object.
#[derive(Clone, Debug, PartialEq)]
pub struct Column {
    /// Object id.
    pub object: String,
    /// What it shows.
    pub quantity: Quantity,
    /// Unit: `rad`, `rad/s`, `N m`, …
    pub unit: &'static str,
    /// One value a sample.
    pub values: Vec<f64>,
}

/// A switch of a pair.
#[derive(Clone, Debug, PartialEq)]
pub struct SwitchRow {
    /// When (s).
    pub time: f64,
    /// Object id.
    pub object: String,
    /// `opens` or `closes`.
    pub what: &'static str,
    /// `lower` or `upper` flank.
    pub flank: &'static str,
    /// Approach speed at a closure, speed of parting at an opening (≥ 0).
    pub speed: f64,
}

/// An interval in which a pair is open.
#[derive(Clone, Debug, PartialEq)]
pub struct Interval {
    /// Object id.
    pub object: String,
    /// Start (s).
    pub from: f64,
    /// End (s).
    pub to: f64,
}
