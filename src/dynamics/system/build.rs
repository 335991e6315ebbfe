//! From the model to the frozen layout, with every check on its numbers.

mod linkages;
mod refusals;

use super::check::chains_of;
use super::constraints::ConstrainedNode;
use super::dry_friction;
use super::frozen::{Chain, Frozen, FrozenLaw, FrozenTrack, PrescribedNode, Rigid, Rotor, Step};
use super::loads::{Argument, FrozenLoad};
use super::pairs::Contact;
use super::stops::FrozenStop;
use super::written::FrozenExpression;
use crate::dynamics::model::{Law, LinkBase, LoadLaw, Model, NodeMotion, Stop, TrackSource};
use crate::fault::Fault;

/// Lays a model out; the faults of all its parts together.
pub(super) fn freeze(model: &Model) -> Result<Frozen, Vec<Fault>> {
    let faults = super::check::faults(model);
    if !faults.is_empty() {
        return Err(faults);
    }
    let mut builder = Builder::new(model);
    for node in 0..model.nodes.len() {
        builder.place_node(node);
    }
    builder.place_linkages();
    builder.place_multi();
    builder.place_tracks();
    builder.frozen.place_distances();
    builder.place_dry_contacts();
    builder.place_friction();
    builder.place_loads();
    builder.frozen.impacts = builder.frozen.has_rigid_contacts();
    builder.frozen.mark_heavy();
    builder.frozen.find_roots();
    builder.refuse_coupled_friction();
    builder.refuse_passed_on_friction();
    builder.refuse_rigid_contacts();
    builder
        .faults
        .extend(dry_friction::faults(&builder.frozen, model));
    builder.frozen.mark_chains();
    builder.frozen.separate_driven_parts();
    if builder.faults.is_empty() {
        builder.refuse_massless();
    }
    if builder.faults.is_empty() {
        builder.frozen.rigid_given = builder.frozen.find_rigid_given();
        Ok(builder.frozen)
    } else {
        Err(builder.faults)
    }
}

struct Builder<'a> {
    model: &'a Model,
    frozen: Frozen,
    /// Links of each chain in order, by its first mass's node.
    chains: Vec<Vec<usize>>,
    placed: Vec<bool>,
    faults: Vec<Fault>,
}

impl<'a> Builder<'a> {
    fn new(model: &'a Model) -> Self {
        let mut frozen = Frozen {
            internal: vec![0; model.nodes.len()],
            horizon: model.horizon.unwrap_or(f64::INFINITY),
            ..Frozen::default()
        };
        let chains = chains_of(model);
        let opening = |links: &&Vec<usize>| match &model.links[links[0]].base {
            LinkBase::Law { pair } => pair.closure != crate::dynamics::model::Closure::Bilateral,
            LinkBase::Mass(_) => false,
        };
        // Only their number matters yet: tracks are numbered after the pairs.
        frozen.pairs = vec![usize::MAX; chains.iter().filter(opening).count()];
        let stops = (model.loads.iter()).filter(|load| load.law.is_stop());
        frozen.stops = vec![FrozenStop::UNPLACED; stops.count()];
        Self {
            model,
            frozen,
            chains,
            placed: vec![false; model.nodes.len()],
            faults: Vec::new(),
        }
    }

    /// Gives a node its place, with its whole chain when it is a mass.
    fn place_node(&mut self, node: usize) {
        if self.placed[node] {
            return;
        }
        match &self.model.nodes[node].motion {
            NodeMotion::Prescribed { motion, track } => {
                let component = self.component(*track);
                let motion = motion.clone();
                let node = self.add_node(node, false);
                self.frozen.steps.push(Step::Prescribed(PrescribedNode {
                    node,
                    motion,
                    component,
                }));
            }
            NodeMotion::Rotor { angle, speed } => {
                let coordinate = self.frozen.coordinates;
                let node = self.add_node(node, true);
                self.frozen.steps.push(Step::Rotor(Rotor {
                    node,
                    coordinate,
                    angle: *angle,
                    speed: *speed,
                }));
                self.frozen.stiffness.push(0.0);
                self.frozen.damping.push(0.0);
            }
            NodeMotion::Rigid { law } => {
                let law = self.add_law(law);
                let node = self.add_node(node, false);
                self.frozen
                    .steps
                    .push(Step::Rigid(self.frozen.rigids.len()));
                self.frozen.rigids.push(Rigid { node, law });
            }
            NodeMotion::Mass { law } => {
                let law = self.add_law(law);
                self.place_chain(node, law);
            }
            NodeMotion::Constrained {
                drivers,
                constraint,
            } => {
                let internal = |&driver: &usize| self.frozen.internal[driver];
                let drivers = drivers.iter().map(internal).collect();
                let constraint = constraint.clone();
                let node = self.add_node(node, false);
                let index = self.frozen.constraints.len();
                self.frozen.steps.push(Step::Constrained(index));
                self.frozen.constraints.push(ConstrainedNode {
                    node,
                    drivers,
                    constraint,
                    heavy: false,
                    multi: None,
                });
            }
        }
    }

    fn place_chain(&mut self, node: usize, law: usize) {
        let holds = |links: &&Vec<usize>| {
            links
                .iter()
                .any(|&link| self.model.links[link].mass == node)
        };
        let Some(links) = self.chains.iter().find(holds).cloned() else {
            return; // refused by the checks
        };
        let first = &self.model.links[links[0]];
        let LinkBase::Law { pair } = &first.base else {
            return; // refused by the checks
        };
        let object = super::check::object_of(self.model, first.mass);
        let contact = match Contact::new(pair, first.stiffness, first.damping, &object) {
            Ok(contact) => contact,
            Err(fault) => {
                self.faults.push(fault);
                return;
            }
        };
        let index = self.frozen.chains.len();
        let component = contact.can_open().then(|| {
            let known = self.frozen.chains.iter();
            known.filter(|chain| chain.component.is_some()).count()
        });
        if let Some(component) = component {
            self.frozen.pairs[component] = index;
        }
        self.frozen.steps.push(Step::Chain(index));
        self.frozen.chains.push(Chain {
            law,
            first_node: self.frozen.inertia.len(),
            first_coordinate: self.frozen.coordinates,
            masses: links.len(),
            point: self.is_point(first.mass),
            indented: self.indented(links[0]),
            contact,
            component,
            watched: false,
            carries: false,
        });
        for &link in &links {
            let link = &self.model.links[link];
            self.add_node(link.mass, true);
            self.frozen.stiffness.push(link.stiffness);
            self.frozen.damping.push(link.damping);
        }
    }

    /// True of a massless point between a contact element and link 1.
    fn is_point(&self, node: usize) -> bool {
        let mut contacts = self.model.objects.iter().flat_map(|part| part.contact);
        contacts.any(|contact| contact.point == Some(node))
    }

    /// The stiffness of the contact element that a link holds.
    fn indented(&self, link: usize) -> Option<f64> {
        let mut contacts = self.model.objects.iter().flat_map(|part| part.contact);
        let own = contacts.find(|contact| contact.link == link)?;
        (!own.law.is_rigid()).then_some(own.stiffness)
    }

    fn add_node(&mut self, node: usize, free: bool) -> usize {
        let index = self.frozen.inertia.len();
        let inertia = self.model.nodes[node].inertia;
        self.placed[node] = true;
        self.frozen.internal[node] = index;
        self.frozen.inertia.push(inertia);
        self.frozen.constant_force.push(0.0);
        let coordinate = free.then_some(self.frozen.coordinates);
        self.frozen.coordinate.push(coordinate);
        if free {
            // (Nothing divides by the inertia of a massless point.)
            let inverse = if inertia > 0.0 { 1.0 / inertia } else { 0.0 };
            self.frozen.inverse_inertia.push(inverse);
            self.frozen.coordinates += 1;
        }
        index
    }

    fn add_law(&mut self, law: &Law) -> usize {
        let component = self.component(law.track);
        self.frozen.laws.push(FrozenLaw {
            driver: self.frozen.internal[law.driver],
            position: law.position.clone(),
            lever: law.lever,
            component,
            output: None,
        });
        self.frozen.laws.len() - 1
    }

    fn component(&self, track: Option<usize>) -> Option<usize> {
        track.map(|track| self.frozen.track_component(track))
    }

    fn place_tracks(&mut self) {
        for track in &self.model.tracks {
            let node = match track.source {
                TrackSource::Time => None,
                TrackSource::Node(node) => Some(self.frozen.internal[node]),
            };
            let signal = node.map(|node| self.frozen.signal(node));
            self.frozen.tracks.push(FrozenTrack {
                node,
                signal,
                breaks: track.breaks.clone(),
                repeats: track.repeats,
                stops: track.stops,
                object: track.object,
            });
        }
    }

    /// Dry friction: its states are numbered with the directions of joints.
    fn place_dry_contacts(&mut self) {
        for load in &self.model.loads {
            if let Some(friction) = load.law.dry_friction() {
                let owner = self.model.owner_of_load(load);
                let (node, object) = (self.frozen.internal[load.node], self.object_of(owner));
                dry_friction::place(&mut self.frozen, *friction, node, object);
            }
        }
    }

    fn place_loads(&mut self) {
        let (mut stops, mut placed) = (0, 0);
        for load in &self.model.loads {
            let node = self.frozen.internal[load.node];
            let (mut stop, mut written, mut dry) = (None, None, None);
            if let Some(force) = load.law.as_constant() {
                self.frozen.constant_force[node] += force;
                continue;
            }
            let argument = match &load.law {
                LoadLaw::Pieces { track, .. } => {
                    let component = self.frozen.track_component(*track);
                    let place = self.frozen.tracks[*track].node;
                    Some(Argument::new(&self.model.tracks[*track], component, place))
                }
                LoadLaw::Stop(own) => {
                    self.place_stop(own, (node, stops), &load.name);
                    stop = Some(stops);
                    stops += 1;
                    None
                }
                LoadLaw::Written(own) => {
                    written = Some(FrozenExpression::new(own, load.node, &mut self.frozen));
                    None
                }
                LoadLaw::Dry { engagement, .. } => {
                    written = engagement.as_ref().map(|own| {
                        // (It pulls nothing back.)
                        let engaged = FrozenExpression::new(own, load.node, &mut self.frozen);
                        FrozenExpression {
                            rate: 0.0,
                            ..engaged
                        }
                    });
                    self.frozen.dry[placed].load = self.frozen.loads.len();
                    dry = Some(placed);
                    placed += 1;
                    None
                }
                LoadLaw::Linear(_) | LoadLaw::Function { .. } => None,
            };
            self.frozen.loads.push(FrozenLoad {
                node,
                has_series: (load.law.function()).is_none_or(|own| own.series().is_some()),
                law: load.law.clone(),
                argument,
                stop,
                written,
                dry,
            });
        }
    }

    /// The object that a node belongs to.
    fn object_of(&self, node: usize) -> usize {
        let mut parts = self.model.objects.iter();
        parts
            .position(|part| part.nodes.contains(&node))
            .unwrap_or(0)
    }

    /// Gives a stop its place, the `index`-th of all.
    fn place_stop(&mut self, stop: &Stop, (node, index): (usize, usize), name: &str) {
        let (pair, damping) = stop.pair();
        let contact = match Contact::new(&pair, stop.stiffness, damping, name) {
            Ok(contact) => contact,
            Err(fault) => return self.faults.push(fault),
        };
        let mut chains = self.frozen.chains.iter();
        let Some(chain) = chains.position(|chain| chain.nodes().contains(&node)) else {
            self.faults.push(Fault::new(
                name,
                "a stop of what is no mass: nothing between it and its driver is elastic",
                "an object with masses, or with a contact element",
            ));
            return;
        };
        let signal = self.frozen.signal(node);
        let component = self.frozen.pairs.len() + index;
        self.frozen.stops[index] = FrozenStop {
            node,
            chain,
            signal,
            component,
            at: stop.at,
            contact,
        };
    }
}

impl Frozen {
    /// The signal that is a node's displacement: a rotor's coordinate, or one
    /// of the extra signals.
    pub(super) fn signal(&mut self, node: usize) -> usize {
        for step in &self.steps {
            if let Step::Rotor(rotor) = step
                && rotor.node == node
            {
                return rotor.coordinate;
            }
        }
        let known = self.extra.iter().position(|&extra| extra == node);
        let index = known.unwrap_or_else(|| {
            self.extra.push(node);
            self.extra.len() - 1
        });
        self.coordinates + index
    }
}
