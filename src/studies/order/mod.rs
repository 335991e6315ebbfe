//! How many masses are enough? The error of the model itself, and the least model that is
//! accurate enough.
//!
//! The truth of an elastic object that is described by inertia, stiffness and damping is the
//! continuum; chains of masses and vibration modes are models of it (explicit lists are
//! their own truth). The scene is run with models of doubled coordinates until the figures
//! that are asked for settle ([`settling`]); of the models run, and of some in which single
//! objects are less ([`choose()`]), the least that is within the accuracy is taken. What was
//! found stands in the [`Certificate`].
//!
//! A level (`builder::level`) is set in the typed scene (`scene::levels`), which is lowered
//! anew; the text is not read again. `row` doubles the coordinates, `settling` gives the limit
//! as n → ∞ with an interval, for each result that is requested. The row is one of modes if no
//! pair opens, of masses otherwise: modes make the forces of stiff impacts too great. Behind a
//! contact element modes are taken for a pair that opens only if they agree with the limit of
//! the chains. Of an object behind a prescribed drive whose output drives nothing, what the
//! modes not kept may add is bounded (`bound`): such results are reported as bounds, and end the row
//! as soon as the bound serves.
//!
//! `Mechanism::of_within` makes the choice if an object leaves its level open
//! (`BodySpec::Open`), a map once for all its points (`map::levels`). `dam compare` needs the
//! limits alone (`limits`). `report::accuracy` shows the result.

mod bound;
mod certificate;
pub(super) mod choose;
pub(super) mod figure_limits;
mod integration;
pub(super) mod judge;
pub(super) mod lessen;
mod limits;
pub(super) mod requested_figures;
pub(super) mod row;
pub mod settling;
pub(super) mod trial;

pub use certificate::{
    Certainty, Certificate, Cheaper, FigureAccuracy, ObjectModel, Shares, TriedModel,
};
pub use choose::{LevelChoice, choose, finer};
pub use limits::{Limits, limits};
pub use requested_figures::RequestedFigure;
pub(in crate::studies) use requested_figures::USUAL;
pub use requested_figures::USUAL_SHARE;
