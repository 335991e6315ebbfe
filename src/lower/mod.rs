//! From objects to the model.
//!
//! Objects are taken drivers first, ids breaking ties, so that the model
//! depends on the objects and their ids alone, not on their order in a file.

mod chain;
mod drive;
mod linkage;
mod load;
mod order;
mod pieces;
mod reach;
#[cfg(test)]
mod tests;

pub use chain::ChainParameters;

use crate::breaks::Breaks;
use crate::fault::{Fault, Faults};
use crate::model::{
    ExplicitStart, Model, NodeIndex, NodeMotion, OUTPUT, ObjectPart, Start, Track, TrackSource,
};
use crate::object::Description;
use crate::scene::{Scene, StartSpec};
use std::collections::BTreeMap;

/// Standard acceleration of free fall (m/s²), for weights.
pub const FREE_FALL: f64 = 9.80665;

/// Masses of a model beyond which its user is asked whether they are meant.
const MANY_MASSES: usize = 3000;

/// Lowers a scene's objects to a model.
///
/// Positions that cannot be assembled are looked for here: at t = 0 they are
/// faults; where the drive's prescribed motion leads into one later, the
/// model's warnings say when and name the reachable interval, and a stopping
/// track ends the run there.
///
/// # Errors
/// Every fault found, with the property it lies in.
pub fn lower(scene: &Scene) -> Result<Model, Vec<Fault>> {
    let order = order::drivers_first(scene)?;
    let mut lowering = Lowering::new(scene);
    for id in order {
        match scene.objects[id].object.description() {
            Description::Drive(spec) => lowering.drive(id, spec),
            Description::Chain(spec) => lowering.chain(id, spec),
            Description::Linkage(spec) => lowering.linkage(id, spec),
        }
    }
    lowering.start();
    lowering.count_masses();
    lowering.finish()
}

/// The objects of a scene and their outputs, without nodes and drivers.
fn parts(scene: &Scene) -> Vec<ObjectPart> {
    let part = |id: String, kind, coordinate| ObjectPart {
        id,
        kind,
        coordinate,
        nodes: Vec::new(),
        driver: None,
        links: Vec::new(),
        rigid_pair: None,
    };
    let mut parts = Vec::new();
    for (id, entry) in &scene.objects {
        let object = &entry.object;
        parts.push(part(id.clone(), object.kind(), object.coordinate()));
        if let Description::Linkage(spec) = object.description() {
            for output in &spec.linkage.outputs {
                let coordinate = spec.output_coordinate(&output.kind);
                parts.push(part(format!("{id}.{}", output.name), OUTPUT, coordinate));
            }
        }
    }
    parts
}

/// A model under construction.
struct Lowering<'a> {
    scene: &'a Scene,
    model: Model,
    faults: Faults,
    /// Places of the objects and of their outputs in the order of their ids.
    indices: BTreeMap<String, usize>,
    /// Nodes of the last masses of the objects lowered so far, and of their
    /// outputs.
    outputs: BTreeMap<String, NodeIndex>,
    /// The objects' motions as long as every mass follows its law, as far as
    /// they are known beforehand; boxed, since a tree keeps room for several.
    courses: BTreeMap<String, Box<reach::Course>>,
}

impl<'a> Lowering<'a> {
    fn new(scene: &'a Scene) -> Self {
        let mut parts = parts(scene);
        parts.sort_by(|one, other| one.id.cmp(&other.id));
        let indices: BTreeMap<String, usize> = (parts.iter().enumerate())
            .map(|(index, part)| (part.id.clone(), index))
            .collect();
        for part in &mut parts {
            let input = match scene.objects.get(&part.id) {
                Some(entry) => entry.input.as_deref(),
                // An output is driven by its own object.
                None => part.id.split_once('.').map(|(id, _)| id),
            };
            part.driver = input.and_then(|input| indices.get(input)).copied();
        }
        Self {
            scene,
            model: Model {
                objects: parts,
                ..Model::default()
            },
            faults: Faults::default(),
            indices,
            outputs: BTreeMap::new(),
            courses: BTreeMap::new(),
        }
    }

    /// The track over these breaks, made when there is none yet; `None`: no breaks.
    fn track(&mut self, source: TrackSource, breaks: Breaks, object: usize) -> Option<usize> {
        if breaks.is_empty() {
            return None;
        }
        let same = |track: &Track| track.source == source && track.breaks == breaks && !track.stops;
        if let Some(found) = self.model.tracks.iter().position(same) {
            return Some(found);
        }
        self.model.tracks.push(Track {
            source,
            breaks,
            stops: false,
            object,
        });
        Some(self.model.tracks.len() - 1)
    }

    /// A word on models of more masses than engineers mean.
    fn count_masses(&mut self) {
        let masses = self.model.nodes.iter();
        let masses = masses.filter(|node| matches!(node.motion, NodeMotion::Mass { .. }));
        let count = masses.count();
        if count > MANY_MASSES {
            self.model.warnings.push(format!(
                "{count} masses: every step takes time in proportion to their number, and there \
                 are as many natural frequencies; `dam compare --over OBJECT.masses=10,100,1000` \
                 shows how many are needed"
            ));
        }
    }

    /// Explicit starts, checked and by index.
    fn start(&mut self) {
        self.model.start = match &self.scene.run.start {
            StartSpec::Kinetostatic => Start::Kinetostatic,
            StartSpec::Static => Start::Static,
            StartSpec::OnLaw => Start::OnLaw,
            StartSpec::Explicit(states) => {
                let mut explicit = Vec::new();
                for (id, (displacement, speed)) in states {
                    let path = format!("run.start.{id}");
                    let Some(&object) = self.indices.get(id.as_str()) else {
                        let message = format!("there is no object `{id}`");
                        self.faults.add(path, message, "");
                        continue;
                    };
                    self.check_start(object, &path, displacement, speed);
                    explicit.push(ExplicitStart {
                        object,
                        displacement: displacement.clone(),
                        speed: speed.clone(),
                    });
                }
                Start::Explicit(explicit)
            }
        };
    }

    fn check_start(&mut self, object: usize, path: &str, displacement: &[f64], speed: &[f64]) {
        let nodes = &self.model.objects[object].nodes;
        let free = |&&node: &&NodeIndex| self.model.nodes[node].motion.is_free();
        let masses = nodes.iter().filter(free).count();
        // An object with faults of its own has no nodes to compare with.
        if masses == 0 && !nodes.is_empty() {
            let message = "it has no masses of its own: its motion follows from its driver";
            self.faults.add(path, message, "leave it out of the start");
            return;
        }
        for (name, values) in [("displacement", displacement), ("speed", speed)] {
            let path = format!("{path}.{name}");
            if values.len() != masses && !nodes.is_empty() {
                let message = format!("{} values for {masses} masses", values.len());
                self.faults.add(&*path, message, "give one value a mass");
            }
            for (index, &value) in values.iter().enumerate() {
                self.faults.finite(&format!("{path}[{index}]"), value);
            }
        }
    }

    fn finish(mut self) -> Result<Model, Vec<Fault>> {
        self.faults.check()?;
        Ok(self.model)
    }
}
