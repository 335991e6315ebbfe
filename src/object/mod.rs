//! The objects of a scene: one file a kind.

pub mod spec;

use crate::model::Coordinate;
use spec::{ChainSpec, DriveSpec};
use std::fmt;

/// An object as described in a scene.
pub trait Object: fmt::Debug + Send + Sync {
    /// Its `kind`.
    fn kind(&self) -> &'static str;

    /// Whether its displacement is an angle or a length.
    fn coordinate(&self) -> Coordinate;

    /// What it lowers to.
    fn description(&self) -> Description<'_>;
}

/// The two things an object can be underneath.
#[derive(Clone, Copy, Debug)]
pub enum Description<'a> {
    /// A source of motion, without input.
    Drive(&'a DriveSpec),
    /// A chain of masses (or a rigid object) behind a driving pair.
    Chain(&'a ChainSpec),
}
