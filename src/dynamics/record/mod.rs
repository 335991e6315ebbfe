//! What a run leaves behind: columns of samples, switches, figures.
//!
//! Columns and results have typed keys, [`Quantity`] and [`Figure`]; files and addresses have
//! the same by name.

mod addresses;
mod area;
mod audit;
mod closeups;
mod confirmed;
mod contact;
pub(crate) mod failure;
mod figure;
mod figure_collector;
mod figures;
mod fitted;
mod joints;
mod log;
mod observed;
mod observer;
mod pairs;
mod peaks;
mod pieces;
mod quantity;
mod recorder;
mod resolution;
mod rows;
mod sampled;
mod settings;
mod smoothness;
mod spans;
mod subdivision;
mod tally;
mod tee;
mod watch;
mod window;

pub use crate::dynamics::audit::EquationCheck;
pub use crate::dynamics::energy::EnergyAudit;
pub use addresses::AddressError;
pub(crate) use confirmed::{acceleration_rounding, check_confirmed_peaks};
pub use failure::Failure;
pub use figure::Figure;
pub(crate) use figure_collector::FigureCollector;
pub use figures::{
    CreepFigures, Figures, FinalState, ImpactFigures, JointFigures, ObjectFigures, PairFigures,
    PressingFigures, RunSummary, StopFigures, StudyFigure, Units, greatest_magnitude,
};
pub(crate) use log::{Course, Log, Stretch};
pub use quantity::Quantity;
pub use recorder::{Recorder, RunRecord};
pub use settings::RecorderSettings;
pub use spans::SpanExtreme;
pub(crate) use spans::span_figures;
pub use tee::Tee;
pub use window::{choose_window, choose_window_of, drive_cycle};
pub(crate) use {observer::Observer, sampled::SampledStretch, tally::Tally};

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
    /// More samples behind switches of pairs, where they were asked for.
    pub closeups: Closeups,
}

/// Samples between those at equal intervals, so close that straight lines between them
/// show the true course of what follows a switch.
#[derive(Clone, Debug, Default, PartialEq)]
pub struct Closeups {
    /// Sample times (s).
    pub times: Vec<f64>,
    /// Values of the record's columns, in their order.
    pub columns: Vec<Vec<f64>>,
    /// They follow every switch (1), every second one (2), …; 0: none was asked for.
    pub every: u64,
}

impl Record {
    /// The record with the closeups among its samples.
    #[must_use]
    pub fn with_closeups(&self) -> Self {
        let mut order: Vec<(f64, bool, usize)> = Vec::new();
        for (close, times) in [(false, &self.times), (true, &self.closeups.times)] {
            order.extend(times.iter().enumerate().map(|(k, &time)| (time, close, k)));
        }
        // (Two rows at a switch stay in their order.)
        order.sort_by(|a, b| a.0.total_cmp(&b.0));
        let columns = self.columns.iter().zip(0..).map(|(column, index)| {
            let close = self.closeups.columns.get(index);
            let value = |&(_, is_close, k): &(f64, bool, usize)| match (is_close, close) {
                (true, Some(close)) => close[k],
                _ => column.values[k],
            };
            Column {
                values: order.iter().map(value).collect(),
                ..column.clone()
            }
        });
        Self {
            times: order.iter().map(|entry| entry.0).collect(),
            columns: columns.collect(),
            switches: self.switches.clone(),
            separations: self.separations.clone(),
            closeups: Closeups {
                every: self.closeups.every,
                ..Closeups::default()
            },
        }
    }
}

/// A column of the record: one quantity of one object.
#[derive(Clone, Debug, PartialEq)]
pub struct Column {
    /// Object id.
    pub object: String,
    /// Quantity in the column.
    pub quantity: Quantity,
    /// Unit: `rad`, `rad/s`, `N m`, …
    pub unit: &'static str,
    /// Values, one a sample.
    pub values: Vec<f64>,
}

/// A switch of a pair.
#[derive(Clone, Debug, PartialEq)]
pub struct SwitchRow {
    /// Time (s).
    pub time: f64,
    /// Object id.
    pub object: String,
    /// `opens` or `closes`; `impact` of a rigid contact.
    pub what: &'static str,
    /// `lower` or `upper` flank.
    pub flank: &'static str,
    /// Approach speed at a closure and at an impact, speed of parting at an opening (≥ 0).
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
