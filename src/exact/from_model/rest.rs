//! What of a system is left beside its trees, as a system of its own.

mod numbers;

use super::{Holder, Parts};
use crate::dynamics::integrate::{Dynamics, Modes};
use crate::dynamics::model::{Load, Model, NodeIndex, NodeMotion, Start, StopPart, TrackSource};
use crate::dynamics::system::{InitialState, System};
use numbers::Numbers;

/// The objects that no tree holds, and where they are in the whole system.
#[derive(Debug)]
pub struct Rest {
    /// The objects as a system.
    pub system: System,
    /// Index in the model of the whole system of each of its objects, ascending.
    pub(crate) objects: Vec<usize>,
    /// Coordinate of the whole system of each of its coordinates.
    pub(crate) coordinates: Vec<usize>,
    /// Component of the whole system's modes of each of its own.
    pub(crate) components: Vec<usize>,
}

impl Rest {
    /// The rest of a system that has to be integrated. `None` where there are no trees
    /// or nothing is left to integrate, or what is left looks at what a tree moves, or
    /// a prescribed motion leads to a dead-centre position, at which everything ends.
    pub fn of(system: &System, parts: &Parts) -> Option<Self> {
        let held = |holder| parts.holders.contains(&holder);
        if parts.trees.is_empty() || !held(Holder::Other) || dead_positions(system.model(), parts) {
            return None;
        }
        Self::outside_trees(system, parts)
    }

    /// All that no tree holds, be it prescribed throughout. `None` where it looks at
    /// what a tree moves.
    pub fn outside_trees(system: &System, parts: &Parts) -> Option<Self> {
        let model = system.model();
        let kept = objects_outside_trees(model, parts)?;
        let (model, tracks) = cut_out(model, &kept)?;
        let own = System::new(model).ok()?;
        let places = Places { system, own: &own };
        let (coordinates, components) = (
            places.coordinates(&kept),
            places.components(&kept, &tracks)?,
        );
        Some(Self {
            system: own,
            objects: kept,
            coordinates,
            components,
        })
    }

    /// The rest's part of the whole system's modes.
    pub(crate) fn modes(&self, whole: &Modes) -> Modes {
        let modes = self.components.iter();
        Modes(modes.map(|&component| whole.0[component]).collect())
    }

    /// True when `own` is the rest's part of the whole system's modes.
    pub(crate) fn has_modes(&self, whole: &Modes, own: &Modes) -> bool {
        let mut modes = self.components.iter().zip(&own.0);
        modes.all(|(&component, own)| whole.0[component] == *own)
    }

    /// The rest's part of a state at t = 0.
    pub(crate) fn initial(&self, whole: &InitialState) -> InitialState {
        let n = whole.y.len() / 2;
        let places = || self.coordinates.iter();
        let speeds = places().map(|place| whole.y[n + place]);
        InitialState {
            y: places()
                .map(|&place| whole.y[place])
                .chain(speeds)
                .collect(),
            modes: self.modes(&whole.modes),
            warnings: Vec::new(),
        }
    }
}

/// True when a prescribed motion can meet a place beyond which there is none.
fn dead_positions(model: &Model, parts: &Parts) -> bool {
    let prescribed = |source| match source {
        TrackSource::Time => true,
        TrackSource::Node(node) => parts.courses[node].is_some(),
    };
    let mut tracks = model.tracks.iter();
    tracks.any(|track| track.stops && prescribed(track.source))
}

/// The objects that no tree holds, in the order of the model; `None` when one of
/// them looks at what a tree moves.
pub(super) fn objects_outside_trees(model: &Model, parts: &Parts) -> Option<Vec<usize>> {
    let free = |object: usize| !matches!(parts.holders[object], Holder::Tree(_));
    let holds = |node: NodeIndex| model.objects.iter().position(|o| o.nodes.contains(&node));
    let kept: Vec<usize> = (0..model.objects.len()).filter(|&o| free(o)).collect();
    let inputs = |object: usize| model.objects[object].inputs.iter();
    if kept
        .iter()
        .any(|&object| inputs(object).any(|input| !free(input.driver)))
    {
        return None;
    }
    for load in &model.loads {
        if let Some((track, _)) = load.law.pieces()
            && let TrackSource::Node(source) = model.tracks[track].source
            && free(holds(load.node)?)
            && !free(holds(source)?)
        {
            return None;
        }
        for source in load.law.read_nodes() {
            if free(holds(load.node)?) && !free(holds(source)?) {
                return None;
            }
        }
    }
    Some(kept)
}

/// The first object that no tree holds under a load by an expression.
pub(super) fn expression_outside_trees(model: &Model, parts: &Parts) -> Option<usize> {
    let mut loads = model.loads.iter();
    loads.find_map(|load| {
        let mut objects = model.objects.iter();
        let object = objects.position(|one| one.nodes.contains(&load.node))?;
        let outside = !matches!(parts.holders[object], Holder::Tree(_));
        (outside && load.law.expression_load().is_some()).then_some(object)
    })
}

/// The model of some objects (ascending) alone, and the tracks it keeps;
/// `None` when they look at others.
fn cut_out(model: &Model, kept: &[usize]) -> Option<(Model, Vec<usize>)> {
    let mut numbers = Numbers {
        nodes: vec![None; model.nodes.len()],
        tracks: vec![None; model.tracks.len()],
        links: vec![None; model.links.len()],
    };
    let owned = |node: &usize| {
        // (What two objects rub on each other by goes with the one that has the load.)
        let node = model.rubbing_nodes(*node).map_or(*node, |[own, _]| own);
        kept.iter().any(|&object| {
            let part = &model.objects[object];
            let point = part.contact.and_then(|contact| contact.point);
            let own = part.nodes.contains(&node) || part.combination == Some(node);
            own || point == Some(node)
        })
    };
    let nodes: Vec<usize> = (0..model.nodes.len()).filter(owned).collect();
    assign_numbers(&mut numbers.nodes, &nodes);
    let here = |node: usize| numbers.nodes[node].is_some();
    let loads: Vec<&Load> = model.loads.iter().filter(|load| here(load.node)).collect();
    let links: Vec<usize> = (0..model.links.len())
        .filter(|&l| here(model.links[l].mass))
        .collect();
    assign_numbers(&mut numbers.links, &links);
    let tracks = tracks_of_kept(model, kept, &nodes, &loads);
    assign_numbers(&mut numbers.tracks, &tracks);
    let mut out = Model::default();
    for &node in &nodes {
        out.nodes.push(numbers.node(&model.nodes[node])?);
    }
    for &link in &links {
        out.links.push(numbers.link(&model.links[link])?);
    }
    for load in loads {
        out.loads.push(numbers.load(load)?);
    }
    for &track in &tracks {
        let mut copy = model.tracks[track].clone();
        if let TrackSource::Node(node) = copy.source {
            copy.source = TrackSource::Node(numbers.nodes[node]?);
        }
        // Shared tracks never stop a run: whose they are does not matter.
        copy.object = kept.iter().position(|&own| own == copy.object).unwrap_or(0);
        out.tracks.push(copy);
    }
    for body in model.linkages.iter().filter(|body| here(body.node)) {
        out.linkages.push(numbers.linkage(body, kept)?);
    }
    for &object in kept {
        out.objects
            .push(numbers.object(&model.objects[object], kept)?);
    }
    let reduced = model.reduced.iter();
    let reduced = reduced.filter(|one| kept.contains(&one.object));
    out.reduced = reduced
        .map(|one| numbers.renumbered_reduction(one, kept))
        .collect::<Option<_>>()?;
    let held = |index: &usize| here(model.loads[*index].node);
    let loads: Vec<usize> = (0..model.loads.len()).filter(held).collect();
    let object = |old: usize| kept.iter().position(|&own| own == old);
    for stop in model.stops.iter().filter(|stop| kept.contains(&stop.part)) {
        out.stops.push(StopPart {
            object: object(stop.object)?,
            part: object(stop.part)?,
            load: loads.iter().position(|&own| own == stop.load)?,
        });
    }
    out.start = start_of_objects(&model.start, kept);
    out.horizon = model.horizon;
    Some((out, tracks))
}

fn assign_numbers(numbers: &mut [Option<usize>], kept: &[usize]) {
    for (new, &old) in kept.iter().enumerate() {
        numbers[old] = Some(new);
    }
}

/// The tracks that the nodes, loads and objects kept look at, ascending.
fn tracks_of_kept(model: &Model, kept: &[usize], nodes: &[usize], loads: &[&Load]) -> Vec<usize> {
    let mut used = vec![false; model.tracks.len()];
    let by_nodes = nodes
        .iter()
        .filter_map(|&node| match &model.nodes[node].motion {
            NodeMotion::Prescribed { track, .. } => *track,
            NodeMotion::Mass { law } | NodeMotion::Rigid { law } => law.track,
            NodeMotion::Rotor { .. } | NodeMotion::Constrained { .. } => None,
        });
    let by_loads = loads.iter().filter_map(|load| Some(load.law.pieces()?.0));
    by_nodes
        .chain(by_loads)
        .for_each(|track| used[track] = true);
    for (used, track) in used.iter_mut().zip(&model.tracks) {
        *used |= track.stops && kept.contains(&track.object);
    }
    (0..used.len()).filter(|&track| used[track]).collect()
}

fn start_of_objects(start: &Start, kept: &[usize]) -> Start {
    let Start::Explicit(all) = start else {
        return start.clone();
    };
    let own = all.iter().filter_map(|given| {
        let object = kept.iter().position(|&own| own == given.object)?;
        let mut given = given.clone();
        given.object = object;
        Some(given)
    });
    Start::Explicit(own.collect())
}

/// A system and a part of it.
struct Places<'a> {
    system: &'a System,
    own: &'a System,
}

impl Places<'_> {
    fn coordinates(&self, kept: &[usize]) -> Vec<usize> {
        let mut places = vec![0; self.own.coordinates()];
        for (new, &old) in kept.iter().enumerate() {
            let part = &self.own.model().objects[new];
            let point = part.contact.and_then(|contact| contact.point);
            let count = part.nodes.len() + usize::from(point.is_some());
            let ends = self
                .own
                .last_coordinate(new)
                .zip(self.system.last_coordinate(old));
            if let Some((own, whole)) = ends {
                // The masses of a chain, or a rotor, one after the other.
                for k in 0..count {
                    places[own - k] = whole - k;
                }
            }
        }
        places
    }

    /// `None`: a pair is not found again.
    fn components(&self, kept: &[usize], tracks: &[usize]) -> Option<Vec<usize>> {
        let pairs = |system: &System| (0..).take_while(|&c| system.is_pair(c)).count();
        let (own, whole) = (pairs(self.own), pairs(self.system));
        let mut places = vec![0; own];
        for (new, &old) in kept.iter().enumerate() {
            if let Some(component) = self.own.pair_component(new) {
                places[component] = self.system.pair_component(old)?;
            }
        }
        places.extend(tracks.iter().map(|track| whole + track));
        // Guards of expressions stand last, load by load.
        let mut guards = self.system.guards_of_loads();
        let kept_loads = self.own.model().loads.iter();
        for (name, node) in kept_loads.map(|load| (&load.name, load.node)) {
            let own = self.own.model().objects.iter();
            let owner = own.clone().position(|part| part.nodes.contains(&node));
            let place = owner.and_then(|part| {
                let nodes = &self.own.model().objects[part].nodes;
                let mass = nodes.iter().position(|&one| one == node)?;
                self.system.model().objects[kept[part]].nodes.get(mass)
            });
            let found = guards
                .iter()
                .position(|(load, _)| load.name == *name && Some(&load.node) == place);
            if let Some(found) = found {
                places.extend(guards.remove(found).1);
            }
        }
        Some(places)
    }
}
