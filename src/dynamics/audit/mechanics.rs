//! The mechanics of a model in the terms of the scene: motions of all nodes, momenta and
//! forces on its coordinates at a state.
//!
//! Lagrange's equations in the coordinates of the state. A node n moves by φₙ, a coordinate
//! q moves it by ∂φₙ/∂q. With pₙ = mₙ·φ̇ₙ and the forces Fₙ on it
//!
//! d/dt Σ pₙ·∂φₙ/∂q = Σ Fₙ·∂φₙ/∂q + Σ pₙ·d/dt(∂φₙ/∂q),
//!
//! both sums handed from each node to what drives it. The force of a link is inner to the
//! law of its mass: it works on the coordinates of masses alone.

use super::contact::{Contact, ContactState};
use crate::dynamics::builder::FREE_FALL;
use crate::dynamics::integrate::Dynamics;
use crate::dynamics::model::{
    DryFriction, Law, LinkBase, LoadLaw, LoadVariable, Model, NodeMotion, WrittenLoad,
};
use crate::dynamics::stated::{
    LoadStatement, StatedDrive, StatedLoad, StatedPosition, differentiate, nearest_by_turns,
};
use crate::dynamics::system::{Scratch, System, dry_friction};
use crate::kinematics::constraint::ConstraintJet;
use std::sync::Arc;

/// Rounding of a function that is known by its values, in its first and second differences
/// (rad or m of an angle or a length of the order of 1).
const UNSURE: [f64; 2] = [1e-9, 1e-6];

/// A node at an instant.
#[derive(Clone, Copy, Debug, Default)]
pub(super) struct At {
    /// φ, φ̇, of a prescribed node φ̈.
    pub(super) motion: [f64; 3],
    /// What speed and acceleration are unsure by where a law is known by its values.
    pub(super) unsure: [f64; 2],
    /// ∂φ/∂φ of the driver and its slope.
    slope: f64,
    bend: f64,
    /// Σ p·∂φ/∂φₙ.
    pub(super) momentum: f64,
    /// Σ F·∂φ/∂φₙ + Σ p·d/dt(∂φ/∂φₙ), without links.
    pub(super) force: f64,
    /// Force of the links on the coordinate of the node.
    pub(super) link: f64,
    /// Magnitudes of the terms of both.
    pub(super) size: f64,
    /// Σ c·|u| of the links on it, before they cancel.
    pub(super) stiff: f64,
}

/// Why something cannot be checked.
type Uncheckable = Option<&'static str>;

/// A link with the numbers of its pair.
struct LinkPlace {
    mass: usize,
    base: Option<usize>,
    stiffness: f64,
    damping: f64,
    contact: Option<Contact>,
}

/// The mechanics of a model.
pub(super) struct Mechanics<'s> {
    system: &'s System,
    pub(super) coordinate: Vec<Option<usize>>,
    drives: Vec<Option<StatedDrive>>,
    positions: Vec<Option<Arc<StatedPosition>>>,
    links: Vec<LinkPlace>,
    loads: Vec<Option<LoadStatement>>,
    /// Contacts of stops, by load.
    stops: Vec<Option<Contact>>,
    /// Why the motion, or the force, of a node is not checked.
    pub(super) no_motion: Vec<Uncheckable>,
    pub(super) no_force: Vec<Uncheckable>,
    pub(super) nodes: Vec<At>,
    /// Forces and depths of all contacts at the state looked at last.
    pub(super) pressed: Vec<ContactState>,
    /// Forces of all dry contacts at rest at that state, as the system has them: by load.
    held: Vec<f64>,
    /// How far every dry friction is engaged at that state: by load.
    engaged: Vec<f64>,
    scratch: Option<Box<Scratch>>,
    /// Kinetic energy at the state looked at last.
    pub(super) kinetic: f64,
}

impl<'s> Mechanics<'s> {
    pub(super) fn new(system: &'s System) -> Self {
        let model = system.model();
        let count = model.nodes.len();
        let mut mechanics = Self {
            system,
            coordinate: (0..count).map(|node| system.coordinate_of(node)).collect(),
            drives: vec![None; count],
            positions: vec![None; count],
            links: links(system),
            loads: loads(model),
            stops: stops(system),
            no_motion: vec![None; count],
            no_force: vec![None; count],
            nodes: vec![At::default(); count],
            pressed: Vec::new(),
            held: vec![0.0; model.loads.len()],
            engaged: vec![1.0; model.loads.len()],
            scratch: (model
                .loads
                .iter()
                .any(|load| load.law.dry_friction().is_some()))
            .then(|| Box::new(system.scratch())),
            kinetic: 0.0,
        };
        mechanics.state_motions();
        mechanics.find_unknown();
        mechanics
    }

    fn state_motions(&mut self) {
        let model = self.system.model();
        for (index, node) in model.nodes.iter().enumerate() {
            match &node.motion {
                NodeMotion::Prescribed { motion, .. } => {
                    let stated = model.stated.drives.get(&index).cloned();
                    let own = || StatedDrive::Own(motion.clone());
                    self.drives[index] = Some(stated.unwrap_or_else(own));
                }
                NodeMotion::Mass { law } | NodeMotion::Rigid { law } => {
                    let stated = model.stated.positions.get(&index).cloned();
                    let own = || Arc::new(StatedPosition::of_unstated_position(&law.position));
                    self.positions[index] = Some(stated.unwrap_or_else(own));
                }
                NodeMotion::Rotor { .. } | NodeMotion::Constrained { .. } => {}
            }
        }
    }

    /// What is not known, handed on: motions from drivers, forces to drivers.
    fn find_unknown(&mut self) {
        let model = self.system.model();
        let count = model.nodes.len();
        for node in 0..count {
            let own = match (&self.drives[node], self.positions[node].as_deref()) {
                (Some(StatedDrive::Unknown(why)), _) => Some(*why),
                (_, Some(StatedPosition::Unknown(why))) => Some(*why),
                _ => None,
            };
            let drivers = drivers(model, node);
            let handed = drivers.iter().find_map(|&driver| self.no_motion[driver]);
            self.no_motion[node] = own.or(handed);
        }
        for body in model.linkages.iter().filter(|body| body.friction.is_some()) {
            self.no_force[body.node] = Some("the friction of its joints");
        }
        for body in &model.multi_linkages {
            for &input in &body.inputs {
                self.no_force[input] = Some("the forces of a linkage of several inputs");
            }
        }
        for (load, statement) in model.loads.iter().zip(&self.loads) {
            if statement.is_none() && load.law.pieces().is_some() {
                self.no_force[load.node] = Some("a load that no text states");
            }
            let others = load.law.read_nodes();
            let axis = statement.as_ref().map(|own| own.driver);
            let mut looked_at = axis.into_iter().chain(others);
            if let Some(why) = looked_at.find_map(|node| self.no_motion[node]) {
                self.no_force[load.node] = Some(why);
            }
        }
        for node in (0..count).rev() {
            if let Some(why) = self.no_force[node].or(self.no_motion[node]) {
                self.no_force[node] = Some(why);
                for driver in drivers(model, node) {
                    self.no_force[driver] = Some(why);
                }
            }
        }
    }

    /// Looks at a state: motions, momenta, forces.
    pub(super) fn take_state(&mut self, time: f64, y: &[f64], modes: &[i64]) {
        self.nodes.fill(At::default());
        self.pressed.clear();
        self.move_nodes(time, y);
        if let Some(scratch) = &mut self.scratch {
            dry_friction::forces_at_rest(self.system, (time, y), modes, scratch, &mut self.held);
        }
        self.load_nodes(time, modes);
        self.add_link_forces(y, modes);
        self.add_linkages();
        let momenta = self.nodes.iter().map(|at| 0.5 * at.momentum * at.motion[1]);
        self.kinetic = momenta.sum();
        self.transfer_to_drivers();
    }

    fn move_nodes(&mut self, time: f64, y: &[f64]) {
        let model = self.system.model();
        let half = y.len() / 2;
        for (index, node) in model.nodes.iter().enumerate() {
            let free = self.coordinate[index].map_or([0.0; 2], |own| [y[own], y[half + own]]);
            let mut at = At::default();
            match &node.motion {
                NodeMotion::Prescribed { .. } => {
                    let found = self.drives[index].as_ref().and_then(|drive| drive.at(time));
                    if let Some(found) = found {
                        at.motion = [found.value, found.first, found.second];
                    }
                }
                NodeMotion::Rotor { .. } => at.motion = [free[0], free[1], 0.0],
                NodeMotion::Mass { law } | NodeMotion::Rigid { law } => {
                    let driver = self.nodes[law.driver].motion;
                    let stated = self.positions[index].as_ref();
                    let found = stated.and_then(|stated| stated.at(driver[0]));
                    if let (Some(stated), Some((mut found, unsure))) = (stated, found) {
                        if let Some(turn) = stated.whole_turn() {
                            // (How often it has turned round, its formula does not tell.)
                            let segment = law.position.breaks().segment_at(driver[0], driver[1]);
                            let known = law.position.jet(segment, driver[0]).value;
                            found.value = nearest_by_turns(found.value, turn, known);
                        }
                        (at.slope, at.bend) = (law.lever * found.first, law.lever * found.second);
                        let unsure = match **stated {
                            StatedPosition::Values(_) => {
                                [UNSURE[0] + unsure[0], UNSURE[1] + unsure[1]]
                            }
                            StatedPosition::Formula(_) | StatedPosition::Unknown(_) => [0.0; 2],
                        };
                        at.unsure = self.handed_on(law, at.slope, unsure);
                        at.motion = [
                            law.lever * found.value + free[0],
                            at.slope * driver[1] + free[1],
                            at.slope * driver[2] + at.bend * driver[1] * driver[1],
                        ];
                    }
                }
                NodeMotion::Constrained {
                    drivers,
                    constraint,
                } => {
                    let places: Vec<f64> =
                        drivers.iter().map(|&d| self.nodes[d].motion[0]).collect();
                    let mut jet = ConstraintJet::new(drivers.len());
                    constraint.jet(&places, &mut jet);
                    at.motion[0] = jet.value;
                    for (k, &driver) in drivers.iter().enumerate() {
                        let motion = self.nodes[driver].motion;
                        at.motion[1] += jet.first[k] * motion[1];
                        at.motion[2] += jet.first[k] * motion[2];
                        for (own, handed) in at.unsure.iter_mut().zip(self.nodes[driver].unsure) {
                            *own += jet.first[k].abs() * handed;
                        }
                        for (l, &other) in drivers.iter().enumerate() {
                            at.motion[2] += jet.second[k * drivers.len() + l]
                                * motion[1]
                                * self.nodes[other].motion[1];
                        }
                    }
                }
            }
            at.momentum = node.inertia * at.motion[1];
            self.nodes[index] = at;
        }
    }

    /// What speed and acceleration behind a law are unsure by.
    fn handed_on(&self, law: &Law, slope: f64, [first, second]: [f64; 2]) -> [f64; 2] {
        let driver = &self.nodes[law.driver];
        let [_, speed, acceleration] = driver.motion.map(f64::abs);
        let lever = law.lever.abs();
        [
            slope.abs() * driver.unsure[0] + lever * first * speed,
            slope.abs() * driver.unsure[1]
                + lever * (first * acceleration + second * speed * speed),
        ]
    }

    fn load_nodes(&mut self, time: f64, modes: &[i64]) {
        let model = self.system.model();
        for (index, load) in model.loads.iter().enumerate() {
            let motion = |node: usize| (self.nodes[node].motion[0], self.nodes[node].motion[1]);
            let own = motion(load.node);
            let force = match (&self.loads[index], &load.law) {
                (Some(statement), law) => {
                    let variables = law
                        .expression_load()
                        .into_iter()
                        .flat_map(|own| &own.variables);
                    let mut others = variables.skip(5);
                    let over = others.find_map(|variable| match variable {
                        LoadVariable::Displacement(node) => Some(motion(*node)),
                        LoadVariable::Time | LoadVariable::Speed(_) => None,
                    });
                    let motions = [own, motion(statement.driver), over.unwrap_or(own)];
                    let inertia = model.nodes[load.node].inertia;
                    let force = statement.law.force(time, motions, inertia, FREE_FALL);
                    statement.share * force
                }
                (None, LoadLaw::Stop(stop)) => {
                    let contact = self.stops[index].as_ref();
                    let pressed =
                        contact.map(|contact| contact.state_at(own.0 - stop.at, own.1, modes));
                    let force = pressed.map_or(0.0, |pressed| -pressed.force);
                    self.pressed.extend(pressed);
                    force
                }
                (None, LoadLaw::Written(written)) => written.force(time, motion),
                (None, LoadLaw::Function { function, factor }) => {
                    factor * function.force(own.0, own.1).value
                }
                (None, LoadLaw::Linear(law)) => law.force - law.rate * own.0 - law.damping * own.1,
                (
                    None,
                    LoadLaw::Dry {
                        friction,
                        engagement,
                    },
                ) => {
                    let by = |written: &WrittenLoad| written.force(time, motion).max(0.0);
                    self.engaged[index] = engagement.as_ref().map_or(1.0, by);
                    match self.held[index] {
                        held if held.is_nan() => self.engaged[index] * friction.opposing(own.1),
                        held => held,
                    }
                }
                (None, LoadLaw::Pieces { .. }) => 0.0,
            };
            self.nodes[load.node].force += force;
            self.nodes[load.node].size += force.abs();
        }
    }

    /// Load, numbers and component of the modes of every dry contact.
    pub(super) fn dry_contacts(&self) -> Vec<(usize, DryFriction, Option<usize>)> {
        let loads = self.system.model().loads.iter().enumerate();
        let dry = loads.filter_map(|(index, load)| Some((index, *load.law.dry_friction()?)));
        let components = dry_friction::components(self.system);
        dry.zip(components)
            .map(|((load, friction), component)| (load, friction, component))
            .collect()
    }

    /// Force of a dry friction at rest, and how far it is engaged, at the state looked at last.
    pub(super) fn held_force(&self, load: usize) -> [f64; 2] {
        [self.held[load], self.engaged[load]]
    }

    fn add_link_forces(&mut self, y: &[f64], modes: &[i64]) {
        let half = y.len() / 2;
        for link in &self.links {
            let at =
                |node: usize| self.coordinate[node].map_or([0.0; 2], |own| [y[own], y[half + own]]);
            let ([u, v], base) = (at(link.mass), link.base.map_or([0.0; 2], at));
            let (x, rate) = (u - base[0], v - base[1]);
            let force = match &link.contact {
                Some(contact) => {
                    let pressed = contact.state_at(x, rate, modes);
                    self.pressed.push(pressed);
                    pressed.force
                }
                None => link.stiffness * x + link.damping * rate,
            };
            let stiff = link.stiffness * (u.abs() + base[0].abs())
                + link.damping * (v.abs() + base[1].abs());
            let stiff = if force == 0.0 { 0.0 } else { stiff };
            for (node, sign) in [(Some(link.mass), -1.0), (link.base, 1.0)] {
                if let Some(node) = node {
                    let own = &mut self.nodes[node];
                    own.link += sign * force;
                    own.size += force.abs();
                    own.stiff += stiff;
                }
            }
        }
    }

    /// Linkages: their inertia and their potential solved at the place, and differenced.
    fn add_linkages(&mut self) {
        let model = self.system.model();
        for body in &model.linkages {
            let [q, rate, _] = self.nodes[body.node].motion;
            let mut workspace = body.linkage.workspace();
            let mut reduced = |q: f64| {
                let solved = body.linkage.solve(q, 1, &mut workspace);
                solved
                    .ok()
                    .map(|()| body.linkage.reduced_linkage(&workspace))
            };
            let Some(here) = reduced(q) else {
                continue;
            };
            let reach = 0.01 * body.linkage.typical_length().min(1.0);
            let cell = std::cell::RefCell::new(reduced);
            let of = |q: f64| (cell.borrow_mut())(q);
            let value = |q| of(q).map_or(f64::NAN, |found| found.inertia[0]);
            let (inertia, _) = differentiate(value, q, reach);
            let potential = |q| of(q).map_or(f64::NAN, |found| found.potential[0]);
            let (potential, _) = differentiate(potential, q, reach);
            let own = &mut self.nodes[body.node];
            own.momentum += here.inertia[0] * rate;
            let terms = [
                0.5 * inertia.first * rate * rate,
                -potential.first,
                here.force[0],
                -here.damping[0] * rate,
            ];
            own.force += terms.iter().sum::<f64>();
            own.size += terms.iter().map(|term| term.abs()).sum::<f64>();
        }
    }

    /// Hands momenta and forces to the drivers.
    fn transfer_to_drivers(&mut self) {
        let model = self.system.model();
        for (index, node) in model.nodes.iter().enumerate().rev() {
            let at = self.nodes[index];
            match &node.motion {
                NodeMotion::Prescribed { .. } | NodeMotion::Rotor { .. } => {}
                NodeMotion::Mass { law } | NodeMotion::Rigid { law } => {
                    let speed = self.nodes[law.driver].motion[1];
                    let turned = at.bend * speed * at.momentum;
                    let own = &mut self.nodes[law.driver];
                    own.momentum += at.slope * at.momentum;
                    own.force += at.slope * at.force + turned;
                    own.size += at.slope.abs() * at.size + turned.abs();
                }
                NodeMotion::Constrained {
                    drivers,
                    constraint,
                } => {
                    let places: Vec<f64> =
                        drivers.iter().map(|&d| self.nodes[d].motion[0]).collect();
                    let mut jet = ConstraintJet::new(drivers.len());
                    constraint.jet(&places, &mut jet);
                    for (k, &driver) in drivers.iter().enumerate() {
                        let turned: f64 = (drivers.iter().enumerate())
                            .map(|(l, &other)| {
                                jet.second[k * drivers.len() + l] * self.nodes[other].motion[1]
                            })
                            .sum();
                        let turned = turned * at.momentum;
                        let own = &mut self.nodes[driver];
                        own.momentum += jet.first[k] * at.momentum;
                        own.force += jet.first[k] * at.force + turned;
                        own.size += jet.first[k].abs() * at.size + turned.abs();
                    }
                }
            }
        }
    }
}

/// The nodes that drive a node.
fn drivers(model: &Model, node: usize) -> Vec<usize> {
    match &model.nodes[node].motion {
        NodeMotion::Prescribed { .. } | NodeMotion::Rotor { .. } => Vec::new(),
        NodeMotion::Mass { law } | NodeMotion::Rigid { law } => vec![law.driver],
        NodeMotion::Constrained { drivers, .. } => drivers.clone(),
    }
}

fn links(system: &System) -> Vec<LinkPlace> {
    let model = system.model();
    let place = |(index, link): (usize, &crate::dynamics::model::Link)| {
        let (base, contact) = match &link.base {
            LinkBase::Mass(base) => (Some(*base), None),
            LinkBase::Law { pair } => {
                let own = |object: &usize| model.pair_link(&model.objects[*object]) == Some(index);
                let object = (0..model.objects.len()).find(own);
                let contact = object.map(|object| {
                    Contact::of_link(
                        pair,
                        [link.stiffness, link.damping],
                        object,
                        (system.pair_component(object), system.dissipation(object)),
                    )
                });
                (None, contact)
            }
        };
        LinkPlace {
            mass: link.mass,
            base,
            stiffness: link.stiffness,
            damping: link.damping,
            contact,
        }
    };
    model.links.iter().enumerate().map(place).collect()
}

fn stops(system: &System) -> Vec<Option<Contact>> {
    let model = system.model();
    let mut found: Vec<Option<Contact>> = vec![None; model.loads.len()];
    for own in &model.stops {
        if let Some(stop) = model.loads[own.load].law.stop() {
            let (pair, damping) = stop.pair();
            let place = (system.pair_component(own.part), None);
            found[own.load] = Some(Contact::of_link(
                &pair,
                [stop.stiffness, damping],
                own.part,
                place,
            ));
        }
    }
    found
}

/// What is stated of all loads; loads that are supplied in code state themselves.
fn loads(model: &Model) -> Vec<Option<LoadStatement>> {
    let statement = |(index, load): (usize, &crate::dynamics::model::Load)| {
        if let Some(stated) = model.stated.loads.get(&index) {
            return Some(stated.clone());
        }
        let (declared, share) = load.law.declared()?;
        Some(LoadStatement {
            law: StatedLoad::declared(&declared)?,
            driver: load.node,
            share,
        })
    };
    model.loads.iter().enumerate().map(statement).collect()
}
