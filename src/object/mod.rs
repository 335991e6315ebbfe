//! The objects of a scene: one file a kind.
//!
//! A new kind is one file and one line in [`KINDS`].

mod body;
mod cam;
mod cam_follower;
mod cam_geometry;
mod chain;
mod crank;
mod drive;
mod geometry;
pub mod law;
mod linkage;
mod load;
mod measures;
mod motor;
pub(crate) mod numbers;
mod pair;
mod plan;
mod position;
mod rocker;
mod shaft;
mod slider;
pub mod spec;

use crate::cam::CamGeometry;
use crate::model::Coordinate;
use crate::read::{Fields, Node};
use spec::{ChainSpec, DriveSpec, DrivenLinkage};
use std::fmt;

pub use cam_follower::CamFollower;
pub use crank::Crank;
pub use drive::Drive;
pub use linkage::Linkage;
pub use measures::Measures;
pub use rocker::Rocker;
pub use shaft::Shaft;
pub use slider::Slider;

/// An object as described in a scene.
pub trait Object: fmt::Debug + Send + Sync {
    /// Its `kind`.
    fn kind(&self) -> &'static str;

    /// Whether its displacement is an angle or a length.
    fn coordinate(&self) -> Coordinate;

    /// What it lowers to.
    fn description(&self) -> Description<'_>;

    /// The disc cam that realises its position function, if the scene tells of one.
    fn cam(&self) -> Option<&CamGeometry> {
        None
    }

    /// Its chain, where single numbers may be set in place.
    fn chain_mut(&mut self) -> Option<&mut ChainSpec> {
        None
    }
}

/// The things an object can be underneath.
#[derive(Clone, Copy, Debug)]
pub enum Description<'a> {
    /// A source of motion, without input.
    Drive(&'a DriveSpec),
    /// A chain of masses (or a rigid object) behind a driving pair.
    Chain(&'a ChainSpec),
    /// A planar linkage of rigid links, with outputs of its own.
    Linkage(&'a DrivenLinkage),
}

/// Outputs by name, with whether they turn or slide; `None`: not known.
pub type Outputs = Vec<(String, Option<Coordinate>)>;

/// A kind of object: how it is read from a scene.
#[derive(Clone, Copy, Debug)]
pub struct Kind {
    /// The value of the property `kind`.
    pub name: &'static str,
    /// What it is, in one line.
    pub doc: &'static str,
    /// Whether it has an `input`.
    pub driven: bool,
    /// Its outputs besides its own displacement, as far as the text tells: their
    /// names, and whether they turn or slide.
    pub outputs: fn(&Node) -> Outputs,
    /// Whether it turns or slides, as far as the text tells.
    pub coordinate: fn(&Node) -> Option<Coordinate>,
    /// Reads its properties, those common to all kinds excepted.
    pub read: fn(&mut Fields<'_>, &Context) -> Option<Box<dyn Object>>,
}

/// Most kinds have no outputs but their own displacement.
fn no_outputs(_: &Node) -> Outputs {
    Vec::new()
}

/// What an object's reading knows of its surroundings.
#[derive(Clone, Copy, Debug, Default)]
pub struct Context {
    /// Whether the driver turns or slides; `None`: not known.
    pub driver: Option<Coordinate>,
}

/// All kinds, in the order they are presented.
pub const KINDS: &[Kind] = &[
    drive::KIND,
    shaft::KIND,
    crank::KIND,
    rocker::KIND,
    slider::KIND,
    cam_follower::KIND,
    linkage::KIND,
];
