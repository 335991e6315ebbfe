//! The objects of a scene: one file a kind.
//!
//! An [`Object`] has [`Ports`] and lowers itself to nodes, links, laws and loads of
//! the model, through a [`ModelBuilder`]. Its [`Kind`] says how it is read from a
//! scene; kinds live in a [`Registry`]. A new kind of this library is one file, with its
//! builder, and two lines in this one (`ARCHITECTURE.md` says what else goes with it); one of
//! another crate is added with [`Registry::with_kind`].
//!
//! `Ports` are named inputs, none, one or several, and outputs. The first output is the
//! object's own displacement; the others have an address such as `press.ram`. A connection
//! leads from an output to an input: φ and φ̇ go along it, the reaction goes back.
//! `Object::lower` is given a [`Place`], which knows the nodes that drive its inputs, and adds
//! its parts to the [`ModelBuilder`].
//!
//! `Object::chain`, `linkage` and `cam` are `None` by default. They state what an object is, so
//! that a start state knows its number of masses, maps set single numbers in place, and `dam
//! cam` finds the geometry. The model is made by `lower` alone. Behind the [`Registry`] a kind
//! is only a name that is shown.
//!
//! Limits: the program `dam` knows the kinds of this library alone.

mod body;
mod cam;
mod cam_contact;
mod cam_follower;
mod cam_geometry;
pub mod chain;
mod contact;
mod contact_geometry;
mod context;
mod crank;
mod differential;
mod drive;
pub mod geometry;
mod kind;
pub mod law;
mod level;
mod linkage;
mod load;
mod measures;
mod motor;
pub(crate) mod numbers;
mod own;
mod pair;
mod plan;
mod ports;
mod position;
mod rocker;
mod shaft;
mod slider;
mod stop;
mod table_period;
mod written;

use crate::dynamics::model::Coordinate;
use crate::kinematics::cam::CamGeometry;
use spec::{ChainSpec, DrivenLinkage, DrivenMultiLinkage};
use std::fmt;

pub use crate::dynamics::builder::{ModelBuilder, Place, spec};
pub use chain::ChainObject;
pub use context::{Connection, Context, KnownObject, object_of};
pub use differential::Differential;
pub use drive::Drive;
pub use kind::{Inputs, Kind, Outputs, Registry};
pub use linkage::Linkage;
pub use measures::Measures;
pub(crate) use own::OwnObject;
pub use ports::{INPUT, OWN, Port, Ports};
pub(in crate::frontend) use written::read_condition;

/// An object of a mechanism.
pub trait Object: fmt::Debug + Send + Sync {
    /// Name of its kind, the property `kind` of a scene.
    fn kind(&self) -> &'static str;

    /// Input and output ports; the first output is the object's own displacement.
    fn ports(&self) -> Ports;

    /// Adds what it is made of to the model: nodes, links, laws, loads. Faults are
    /// noted in the builder; every output must have its node, unless there are faults.
    fn lower(&self, at: &Place, into: &mut ModelBuilder);

    /// Whether its displacement is an angle or a length.
    fn coordinate(&self) -> Coordinate {
        let own = self.ports().outputs.into_iter().next();
        own.and_then(|port| port.coordinate).unwrap_or_default()
    }

    /// Number of coordinates that a start state has: its masses, 1 for a motor's
    /// rotor, 0 for what follows rigidly and for a prescribed drive. Default: those of
    /// its chain.
    fn masses(&self) -> usize {
        self.chain().map_or(0, |chain| chain.masses())
    }

    /// The chain of masses, or rigid object, that it is; `None`: something else.
    fn chain(&self) -> Option<&ChainSpec> {
        None
    }

    /// The chain of [`Self::chain`], of which single numbers may be set in place.
    fn chain_mut(&mut self) -> Option<&mut ChainSpec> {
        None
    }

    /// The linkage of rigid links that it is; `None`: something else.
    fn linkage(&self) -> Option<&DrivenLinkage> {
        None
    }

    /// The linkage of several inputs that it is; `None`: something else.
    fn multi_linkage(&self) -> Option<&DrivenMultiLinkage> {
        None
    }

    /// The disc cam that realises its position function, if the scene tells of one.
    fn cam(&self) -> Option<&CamGeometry> {
        None
    }
}

/// The kinds, by their files, each with the builder that its file declares, if it does.
macro_rules! kinds {
    ($($file:ident $(: $Builder:ident)?;)*) => {
        /// The kinds of this library, in the order they are presented.
        const STANDARD: &[Kind] = &[$($file::KIND),*];

        /// Builders that the files of kinds declare.
        pub(in crate::frontend) mod builders {
            $($(pub use super::$file::$Builder;)?)*
        }

        /// The properties that these builders have methods for, by the names of the kinds.
        #[cfg(test)]
        pub(in crate::frontend) const BUILT: &[(&str, &[&str])] =
            &[$($(($file::KIND.name, $file::$Builder::PROPERTIES),)?)*];
    };
}

kinds! {
    drive;
    shaft: Shaft;
    crank: Crank;
    rocker: Rocker;
    slider: Slider;
    cam_follower: CamFollower;
    differential;
    linkage;
}
