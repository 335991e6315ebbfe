//! What a scene states, evaluated as it stands.
//!
//! Runs are computed with laws that are laid out for speed: pieces, tables, series, fits,
//! frozen passes. Here the same laws are written a second time, plainly, from the numbers of
//! the scene, and share nothing with them but the language of expressions. The check of a
//! run ([`super::audit`]) reads its motions and forces from here. All matches over kinds
//! are exhaustive; what has no second form says so.
//!
//! `Model::stated` keeps these laws; the solver never reads them.

mod curve;
mod drive;
mod law;
mod load;
mod local;
mod plan;
mod position;

pub(crate) use drive::StatedDrive;
pub(crate) use load::StatedLoad;
pub(crate) use local::differentiate;
pub(crate) use position::StatedPosition;
pub(crate) use position::nearest_by_turns;

use std::collections::BTreeMap;

/// What a scene states of the nodes and the loads of a model. What is not in it is supplied
/// in code, and is its own statement.
#[derive(Clone, Debug, Default)]
pub struct SceneStatements {
    /// Motions of prescribed nodes.
    pub(crate) drives: BTreeMap<usize, StatedDrive>,
    /// Position functions of the laws of nodes, without the lever.
    pub(crate) positions: BTreeMap<usize, std::sync::Arc<StatedPosition>>,
    /// Loads by their index in the model.
    pub(crate) loads: BTreeMap<usize, LoadStatement>,
}

/// A load with what it looks at.
#[derive(Clone, Debug)]
pub(crate) struct LoadStatement {
    /// The law.
    pub(crate) law: StatedLoad,
    /// Node of the driver.
    pub(crate) driver: usize,
    /// Share of it that acts.
    pub(crate) share: f64,
}
