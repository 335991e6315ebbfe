//! A figure over one or two parameters of a scene, with a verdict and its cause
//! for every point.
//!
//! A [`Study`] is a scene, one or two [axes](crate::studies::axis::Axis), a figure,
//! and the panels, one map each. Every cell is a scene of its own, decoded
//! with the cell's values set (objects that do not change from cell to cell once only),
//! lowered, frozen, run and judged ([`Verdict`]). Cells depend on nothing but their values, so that the results
//! are the same for any number of threads and in any order.
//!
//! A cell decodes only what varies (`scene::Variation`). Plain numbers of chains are set in
//! place, and the rigid motion is kept as long as the laws are the same. Threads take cell by
//! cell. `--cells` and `--merge` of the program, and `dam/distributed.py`, work on the same
//! cells (`map_cells`, `journal::part`, `journal::merge`).

mod cell;
mod ends;
mod figure;
mod grid;
pub mod journal;
mod judge;
mod levels;
mod panels;
mod rigid;
mod scenes;
mod study;
mod summary;
mod verdict;

pub use cell::{Cell, MOST_STEPS};
pub(super) use figure::{check_figure, unit as figure_unit};
pub use grid::{Listener, MapResult, Silent, map, map_cells};
pub use panels::{MOST_PANELS, Panel, Panels};
pub use rigid::{RigidMotion, rigid_motion};
pub use study::{MOST_CELLS, Question, Study, StudyFault};
pub use summary::{Extreme, PanelSummary, summary};
pub use verdict::{Family, NEAR_HARMONIC, RESONANCE, STEADY, THROWN_OFF, Verdict};
