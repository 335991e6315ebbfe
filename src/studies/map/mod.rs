//! A figure over one or two parameters of a scene, with a verdict and its cause
//! for every point.
//!
//! A [`Study`] is a scene, one or two [axes](crate::studies::axis::Axis), a figure,
//! and the panels, one map each. Every cell is a point of a
//! [prepared scene](crate::studies::prepared), one for each panel. Cells depend on nothing but
//! their values, so that the results are the same for any number of threads and in any order.
//!
//! Threads take cell by cell. `--cells` and `--merge` of the program, and
//! `dam/distributed.py`, work on the same cells (`map_cells`, `journal::part`,
//! `journal::merge`).

mod cell;
mod default_figure;
mod grid;
pub mod journal;
mod panels;
mod study;
mod summary;

pub use super::prepared::{
    Family, MOST_STEPS, NEAR_HARMONIC, RESONANCE, RigidMotion, STEADY, THROWN_OFF, Verdict,
    rigid_motion,
};
pub use cell::Cell;
pub use grid::{Listener, MapResult, Silent, map, map_cells};
pub use panels::{MOST_PANELS, Panel, Panels};
pub use study::{MOST_CELLS, Question, Study, StudyFault};
pub use summary::{Extreme, PanelSummary, summary};
