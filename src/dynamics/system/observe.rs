//! What every object is doing: read off a complete evaluation.

use super::frozen::{Chain, Frozen, Rigid, Step};
use super::passes::{Extent, Work};
use super::reduced::Modal;
use super::{Energy, ObjectState, Power, Scratch, System};
use crate::dynamics::integrate::Modes;
use crate::dynamics::model::{Closure, ContactPartner, Model, ObjectPart, Pair};
use std::sync::Arc;

/// Place of an object of the model in the frozen layout.
#[derive(Clone, Debug)]
pub(super) struct ObjectPlace {
    /// Internal index of the last node.
    pub(super) node: usize,
    /// Body of the object.
    pub(super) body: Body,
    /// The inertia of an elastic object that moves with its law.
    driven_end: Option<Rigid>,
    /// Of an object that is reduced to modes what it is the sum of.
    pub(super) modal: Option<Modal>,
    /// What it is pressed on, with the node that turns that.
    pressing: Option<(Arc<ContactPartner>, usize)>,
}

/// Body of an object: drive, motor, rigid object or chain.
#[derive(Clone, Debug)]
pub(super) enum Body {
    /// A drive with given motion.
    Prescribed,
    /// A motor: its loads that are its torque, and the constant part of it.
    Motor {
        /// Indices into [`Frozen::loads`].
        loads: Vec<usize>,
        /// Constant torque.
        constant: f64,
    },
    /// A rigid object, with its pair.
    Rigid(Rigid, Pair),
    /// An output of a linkage of several inputs.
    Output,
    /// A chain, index into [`Frozen::chains`].
    Chain(usize),
    /// A stop, index into [`Frozen::stops`].
    Stop(usize),
}

impl Rigid {
    /// The force with which it pulls at its law.
    fn pull(&self, work: &Work<f64>) -> f64 {
        work.force[self.node] - work.mass[self.node] * work.acceleration[self.node]
    }
}

/// The force with which a pair that is taken to stay closed is pressed together, of that
/// with which the object pulls at its law; negative where it would open.
fn pressed(pair: &Pair, pull: f64) -> f64 {
    match pair.closure {
        Closure::Bilateral => 0.0,
        Closure::Force => -pair.opens * pull,
        Closure::Form => pull.abs(),
    }
}

impl ObjectPlace {
    /// Finds an object of the model in the frozen layout.
    pub(super) fn find(frozen: &Frozen, model: &Model, part: &ObjectPart) -> Self {
        let own = part.nodes[part.nodes.len() - 1];
        // Such a linkage shows its first input.
        let multi = model.multi_linkages.iter().find(|multi| multi.node == own);
        let node = frozen.internal[multi.map_or(own, |multi| multi.inputs[0])];
        let body = frozen
            .steps
            .iter()
            .find_map(|step| match step {
                Step::Prescribed(drive) if drive.node == node => Some(Body::Prescribed),
                Step::Rotor(rotor) if rotor.node == node => Some(motor(frozen, model, part, node)),
                Step::Rigid(index) if frozen.rigids[*index].node == node => Some(Body::Rigid(
                    frozen.rigids[*index],
                    part.rigid_pair.unwrap_or_default(),
                )),
                Step::Chain(index) if frozen.chains[*index].nodes().contains(&node) => {
                    Some(Body::Chain(*index))
                }
                Step::Constrained(index) if frozen.constraints[*index].node == node => {
                    Some(Body::Output)
                }
                _ => None,
            })
            // Every node has its step.
            .unwrap_or(Body::Prescribed);
        let rigid = |node: usize| frozen.rigids.iter().find(|rigid| rigid.node == node);
        let end = part.driven_end.map(|node| frozen.internal[node]);
        Self {
            node,
            body,
            driven_end: end.and_then(rigid).copied(),
            modal: None,
            pressing: part.pressing.clone().and_then(|pressing| {
                let law = frozen.law_of_node(node)?;
                Some((pressing, frozen.laws[law].driver))
            }),
        }
    }
}

/// The torque of a motor: its characteristic over speed, or the constant load
/// that bears the torque's own address.
fn motor(frozen: &Frozen, model: &Model, part: &ObjectPart, internal: usize) -> Body {
    let own = |name: &str| {
        let rest = name.strip_prefix(part.id.as_str());
        rest.is_some_and(|rest| [".torque", ".motor.torque", ".motor.force"].contains(&rest))
    };
    // Constant loads have no place of their own in the layout.
    let varying = (model.loads.iter()).filter(|load| load.law.as_constant().is_none());
    let torque: Vec<usize> = (varying.enumerate())
        .filter(|(_, load)| load.node == part.nodes[0] && own(&load.name))
        .map(|(index, _)| index)
        .collect();
    let loads = (0..frozen.loads.len())
        .filter(|&load| {
            let own = &frozen.loads[load];
            own.node == internal && (own.law.running_speed().is_some() || torque.contains(&load))
        })
        .collect();
    let constant = model
        .loads
        .iter()
        .filter(|load| load.node == part.nodes[0] && own(&load.name))
        .filter_map(|load| load.law.as_constant())
        .sum();
    Body::Motor { loads, constant }
}

impl System {
    /// True of a motor, and of a free input of a linkage: its displacement is a coordinate.
    pub(super) fn is_rotor(&self, object: usize) -> bool {
        matches!(self.places[object].body, Body::Motor { .. })
    }

    /// A complete evaluation into `scratch`.
    pub(super) fn evaluate_fully(
        &self,
        time: f64,
        y: &[f64],
        modes: &Modes,
        scratch: &mut Scratch,
    ) {
        self.frozen.evaluate(
            time,
            y,
            &modes.0,
            Extent::Full,
            &mut scratch.work,
            &mut scratch.accelerations,
        );
    }

    /// Observes the motion and forces of every object of the model; `out` has one entry
    /// an object. Allocates nothing.
    pub fn observe(
        &self,
        time: f64,
        y: &[f64],
        modes: &Modes,
        scratch: &mut Scratch,
        out: &mut [ObjectState],
    ) {
        self.evaluate_fully(time, y, modes, scratch);
        self.read_states(time, y, modes, &scratch.work, out);
    }

    /// Observes displacements and speeds alone.
    pub(crate) fn observe_motion(
        &self,
        time: f64,
        y: &[f64],
        modes: &Modes,
        scratch: &mut Scratch,
        out: &mut [ObjectState],
    ) {
        let work = &mut scratch.work;
        (self.frozen).motion(time, y, &modes.0, Extent::Full, work);
        for (out, place) in out.iter_mut().zip(&self.places) {
            out.displacement = work.displacement[place.node];
            out.speed = work.speed[place.node];
        }
    }

    /// Energies, of the last complete evaluation, which was of the state `y`.
    pub(crate) fn energy_observed(&self, y: &[f64], scratch: &Scratch) -> Energy {
        let [kinetic, elastic] = self.frozen.energy_of(y, &scratch.work);
        Energy { kinetic, elastic }
    }

    /// Powers, of the last complete evaluation, which was of this state.
    pub(crate) fn power_observed(&self, y: &[f64], modes: &Modes, scratch: &Scratch) -> Power {
        self.read_power(y, modes, &scratch.work)
    }

    /// States, read off a complete evaluation.
    pub(super) fn read_states(
        &self,
        time: f64,
        y: &[f64],
        modes: &Modes,
        work: &Work<f64>,
        out: &mut [ObjectState],
    ) {
        for (out, place) in out.iter_mut().zip(&self.places) {
            *out = ObjectState {
                displacement: work.displacement[place.node],
                speed: work.speed[place.node],
                acceleration: work.acceleration[place.node],
                ..ObjectState::default()
            };
            match &place.body {
                Body::Prescribed => out.reaction = self.drive_moment(place.node, work),
                Body::Motor { loads, constant } => {
                    let torque = loads.iter().map(|&load| work.loads[load]);
                    out.reaction = constant + torque.sum::<f64>();
                }
                Body::Rigid(rigid, pair) => {
                    out.reaction = rigid.pull(work);
                    out.contact_force = pressed(pair, out.reaction);
                }
                // The force with which what hangs on it pulls.
                Body::Output => {
                    let inertia = work.mass[place.node] * work.acceleration[place.node];
                    out.reaction = work.force[place.node] - inertia;
                }
                Body::Stop(stop) => {
                    let held = work.stop_reaction[*stop];
                    self.frozen.stops[*stop].observe(&modes.0, held, work, out);
                }
                Body::Chain(chain) => {
                    let reaction = work.reaction[*chain];
                    self.observe_chain(&self.frozen.chains[*chain], y, modes, reaction, out);
                }
            }
            if let (Some(modal), Some(end)) = (&place.modal, &place.driven_end) {
                self.observe_modal(modal, end.node, (time, y), &modes.0, work, out);
            }
            if let Some(modal) = &place.modal {
                self.observe_sum(modal, y, work, out);
            }
            if let Some(end) = &place.driven_end {
                out.reaction += end.pull(work);
                if let Body::Rigid(_, pair) = &place.body {
                    out.contact_force = pressed(pair, out.reaction);
                }
            }
            if let Some((pressing, cam)) = &place.pressing {
                out.pressure = pressing.pressure(work.displacement[*cam], out.reaction);
            }
        }
    }

    /// Speed of the deformation of an object's pair, where the state itself tells it.
    pub(crate) fn pair_speed(&self, object: usize, y: &[f64], modes: &Modes) -> Option<f64> {
        let place = &self.places[object];
        match &place.body {
            Body::Chain(chain) => {
                let chain = &self.frozen.chains[*chain];
                let (u, v) = self.frozen.deviations(chain, y);
                let mode = self.frozen.pair_mode(chain, &modes.0);
                Some(self.frozen.pair_rate(chain, mode, u, v))
            }
            _ => None,
        }
    }

    fn observe_chain(
        &self,
        chain: &Chain,
        y: &[f64],
        modes: &Modes,
        reaction: f64,
        out: &mut ObjectState,
    ) {
        let (u, v) = self.frozen.deviations(chain, y);
        out.delta = u[chain.masses - 1];
        out.delta_speed = v[chain.masses - 1];
        out.deformation = u[0];
        let mode = self.frozen.pair_mode(chain, &modes.0);
        out.deformation_speed = self.frozen.pair_rate(chain, mode, u, v);
        out.reaction = reaction;
        if chain.contact.can_open() {
            // At a switch located to rounding the force may be a rounding below 0.
            out.contact_force = (mode as f64 * reaction).max(0.0);
            if mode == super::pairs::OPEN {
                out.lift = chain.contact.clearance(u[0]);
            }
            out.indentation = chain.indentation(u[0], out.contact_force);
        }
    }

    /// The moment (or force) that gives a prescribed node its motion.
    fn drive_moment(&self, node: usize, work: &Work<f64>) -> f64 {
        work.mass[node] * work.acceleration[node] - work.force[node]
    }

    /// Powers of drives, loads and dampers. Allocates nothing.
    pub fn power(&self, time: f64, y: &[f64], modes: &Modes, scratch: &mut Scratch) -> Power {
        self.evaluate_fully(time, y, modes, scratch);
        self.read_power(y, modes, &scratch.work)
    }

    /// Powers, read off a complete evaluation.
    fn read_power(&self, y: &[f64], modes: &Modes, work: &Work<f64>) -> Power {
        let frozen = &self.frozen;
        let drive = |step: &Step| match step {
            Step::Prescribed(drive) => self.drive_moment(drive.node, work) * work.speed[drive.node],
            _ => 0.0,
        };
        let constant = frozen.constant_force.iter().zip(&work.speed);
        // (What stops take is stored or lost.)
        let loads = frozen.loads.iter().zip(&work.loads);
        // (… and dry friction is a loss of its own.)
        let loads = loads.filter(|(load, _)| load.stop.is_none() && load.dry.is_none());
        let varying = loads.map(|(load, force)| force * work.speed[load.node]);
        let (mut applied, mut damped) = (0.0, 0.0);
        for (index, linkage) in frozen.linkages.iter().enumerate() {
            let (reduced, speed) = (frozen.linkage(index, work), work.speed[linkage.node]);
            applied += reduced.applied * speed;
            damped -= reduced.damping * speed;
        }
        for own in &work.multi {
            let power = own.space.power();
            applied += power.applied;
            damped += power.dissipated;
        }
        let chains = frozen.chains.iter();
        Power {
            drives: frozen.steps.iter().map(drive).sum(),
            loads: constant.map(|(force, speed)| force * speed).sum::<f64>()
                + varying.sum::<f64>()
                + applied,
            dissipated: chains
                .map(|chain| frozen.dissipated(chain, y, modes))
                .sum::<f64>()
                + (frozen.stops.iter())
                    .map(|stop| stop.dissipated(&modes.0, work))
                    .sum::<f64>()
                + damped,
            friction: frozen
                .friction_losses(&modes.0, work)
                .map(|(_, loss)| loss)
                .sum(),
        }
    }

    /// Power lost to the friction of joints, as the last call of [`Self::power`] found
    /// it: object and loss (W).
    pub fn friction_losses<'a>(
        &'a self,
        modes: &'a Modes,
        scratch: &'a Scratch,
    ) -> impl Iterator<Item = (usize, f64)> + 'a {
        self.frozen.friction_losses(&modes.0, &scratch.work)
    }

    /// A number that changes where friction has a kink that no switch marks: where in
    /// a given motion a corner of a block begins to press on the other side of its
    /// guide. As of the last evaluation.
    pub(crate) fn friction_side(&self, scratch: &Scratch) -> u64 {
        self.frozen.pressing_corners(&scratch.work)
    }

    /// Objects whose joints have friction, each with the component of [`Modes`] that
    /// says whether friction holds it; without one its motion is given.
    pub fn objects_with_friction(&self) -> impl Iterator<Item = (usize, Option<usize>)> + '_ {
        let groups = self.frozen.groups.iter();
        let groups = groups.flat_map(|group| {
            let members = group.members.iter();
            members.map(|member| (member.object, group.component))
        });
        let several = self.frozen.several.iter();
        let joints = groups.chain(several.map(|several| (several.object, Some(several.component))));
        joints.chain(
            self.frozen
                .dry
                .iter()
                .map(|contact| (contact.object, contact.component)),
        )
    }
}
