//! Building a model: what an object's lowering may say.
//!
//! An object is given its [`Place`], which knows the nodes that its inputs hang on,
//! and adds nodes, links, laws, loads and linkages to a [`ModelBuilder`]. The
//! builder checks numbers, makes the tracks of break points, follows the motion on
//! its law to find positions that cannot be assembled, and collects faults with the
//! address of the property that each lies in.
//!
//! Two levels: [`ModelBuilder::add_drive`], [`ModelBuilder::chain`] and
//! [`ModelBuilder::linkage`] lower what most kinds are made of, in plain numbers
//! ([`spec`]); [`ModelBuilder::law`], [`ModelBuilder::rigid`],
//! [`ModelBuilder::masses`], [`ModelBuilder::output`] and [`ModelBuilder::force`]
//! are the single steps.

mod assembly_range;
mod chain;
mod contact;
mod continuum;
mod drive;
mod driven_end;
mod free_body;
mod free_modes;
pub(crate) mod left_out;
mod level;
mod level_of_body;
mod linkage;
mod load;
mod modal_output;
mod modes;
mod multi;
mod nodes;
mod pieces;
mod place;
mod smooth;
pub mod spec;
mod stop;
pub(crate) mod written;

pub use chain::ChainParameters;
pub(crate) use contact::{STATIC_BEHIND_A_CURVE, instead_of_static};
pub(crate) use driven_end::{BALANCED_BEHIND_AN_OPENING_PAIR, INSTEAD_OF_BALANCED};
pub use place::{InputConnection, Place};

use crate::dynamics::model::{Model, NodeIndex, ObjectPart, Track, TrackSource};
use crate::fault::{Fault, Faults};
use crate::kinematics::breaks::Breaks;
use std::collections::{BTreeMap, BTreeSet};

/// Standard acceleration of free fall (m/s²), for weights.
pub const FREE_FALL: f64 = 9.80665;

/// A model under construction.
#[derive(Debug)]
pub struct ModelBuilder {
    model: Model,
    faults: Faults,
    /// Length of the run (s).
    duration: f64,
    /// Displacements of the masses of objects in an explicit start, by id.
    explicit: BTreeMap<String, Vec<f64>>,
    /// Places of the objects and of their outputs in [`Model::objects`].
    indices: BTreeMap<String, usize>,
    /// The nodes of outputs: those of the last masses of objects, by id, and those
    /// of further outputs, by `object.output`.
    outputs: BTreeMap<String, NodeIndex>,
    /// For each node the object part that it belongs to, and where it will be.
    known: Vec<NodeEntry>,
    /// Outputs that others hang on.
    followed: BTreeSet<String>,
    /// Loads that look at objects which may have no node yet.
    waiting: Vec<written::PendingReference>,
}

/// A node as the builder knows it: its object, and where it stands at the start.
#[derive(Clone, Copy, Debug)]
struct NodeEntry {
    /// Index into [`Model::objects`].
    part: usize,
    /// Displacement at t = 0.
    start: f64,
}

impl ModelBuilder {
    /// A model of objects that are still to be lowered. `parts`: objects and their
    /// outputs, in the order of their ids, without nodes; `duration`: length of the
    /// run (s); `explicit`: displacements of the masses at t = 0 of objects whose
    /// start is given.
    pub(crate) fn new(
        parts: Vec<ObjectPart>,
        duration: f64,
        explicit: BTreeMap<String, Vec<f64>>,
    ) -> Self {
        let ids = parts.iter().map(|part| part.id.clone());
        Self {
            indices: ids.enumerate().map(|(index, id)| (id, index)).collect(),
            model: Model {
                objects: parts,
                horizon: Some(duration),
                ..Model::default()
            },
            faults: Faults::default(),
            duration,
            explicit,
            outputs: BTreeMap::new(),
            known: Vec::new(),
            followed: BTreeSet::new(),
            waiting: Vec::new(),
        }
    }

    /// Says which outputs others hang on.
    pub(crate) fn with_followed(self, followed: BTreeSet<String>) -> Self {
        Self { followed, ..self }
    }

    /// The place of an object, its inputs given as (port, output) pairs. Outputs of
    /// objects with faults have no node: those inputs are left out.
    pub(crate) fn place<'c>(
        &self,
        id: &str,
        inputs: impl IntoIterator<Item = (&'c str, &'c str)>,
    ) -> Option<Place> {
        let connected = |(port, output): (&str, &str)| {
            Some(InputConnection {
                port: port.to_owned(),
                output: output.to_owned(),
                coordinate: self.model.objects[*self.indices.get(output)?].coordinate,
                node: *self.outputs.get(output)?,
            })
        };
        Some(Place {
            id: id.to_owned(),
            object: *self.indices.get(id)?,
            inputs: inputs.into_iter().filter_map(connected).collect(),
        })
    }

    /// The model as far as it stands.
    pub fn model(&self) -> &Model {
        &self.model
    }

    /// Notes a fault of a property of the object (`""`: of the object itself).
    pub fn fault(&mut self, at: &Place, property: &str, message: impl Into<String>, hint: &str) {
        self.faults.add(at.path(property), message, hint);
    }

    /// Notes faults found elsewhere, their paths being relative to a property of the
    /// object (`""`: the object itself).
    pub fn faults(&mut self, at: &Place, property: &str, faults: Vec<Fault>) {
        self.faults.absorb(&at.path(property), faults);
    }

    /// Notes what the user should know before the run.
    pub fn warn(&mut self, warning: impl Into<String>) {
        self.model.warnings.push(warning.into());
    }

    /// The track over these breaks, made when there is none yet; `None`: no breaks. Whether
    /// it is that of a law of motion that repeats.
    fn track(
        &mut self,
        source: TrackSource,
        (breaks, repeats): (Breaks, bool),
        object: usize,
    ) -> Option<usize> {
        if breaks.is_empty() {
            return None;
        }
        let same = |track: &Track| {
            let own = (track.source, track.stops, track.repeats);
            own == (source, false, repeats) && track.breaks == breaks
        };
        if let Some(found) = self.model.tracks.iter().position(same) {
            return Some(found);
        }
        self.model.tracks.push(Track {
            source,
            breaks,
            repeats,
            stops: false,
            object,
        });
        Some(self.model.tracks.len() - 1)
    }

    /// Faults of what belongs to no object.
    pub(crate) fn other_faults(&mut self) -> &mut Faults {
        &mut self.faults
    }

    /// The model, to be completed.
    pub(crate) fn model_mut(&mut self) -> &mut Model {
        &mut self.model
    }

    /// The finished model.
    ///
    /// # Errors
    /// Every fault noted.
    pub(crate) fn finish(mut self) -> Result<Model, Vec<Fault>> {
        self.connect_waiting();
        self.faults.check()?;
        Ok(self.model)
    }
}
