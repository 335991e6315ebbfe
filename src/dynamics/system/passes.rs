//! The equations of motion, in passes over flat arrays.
//!
//! Forward: displacements and speeds of all nodes, each law evaluated once.
//! Forces: loads, and the reaction of each link 1 on its driver.
//! Backward: rigid nodes hand their inertia and forces to their drivers.
//! Forward: the links' forces and the accelerations, a driver's before those of
//! what it drives (`accelerations`).
//!
//! Written once for every kind of number.
//!
//! The mass matrix stays diagonal, but for nodes with several drivers (`constraints`) and
//! linkages of several inputs (`multi`). Rigid objects are eliminated exactly on the way: a
//! body of inertia J behind a law U adds J·U′² to the inertia of its driver and J·U′·U″·φ̇² to
//! its bias force. On dual numbers the passes give the exact Jacobian. `trains` and
//! `multi/direct` replace them in scenes of rigid bodies at constant ratios.

use super::constraints::{Chains, ConstraintValues, Coupling};
use super::dry_friction::{self, DryWork};
use super::friction::{FrictionMemory, SeveralWork};
use super::frozen::{Chain, Frozen, Step, segment};
use super::linkages::{Cursor, LinkageState};
use super::multi::{Dense, MultiWork};
use crate::math::quantity::Quantity;
use std::cell::{Cell, RefCell};

/// A law at an instant.
#[derive(Clone, Copy, Debug)]
pub(super) struct LawValues<N> {
    /// U.
    pub(super) value: N,
    /// U′.
    pub(super) first: N,
    /// U′·φ̇_driver.
    pub(super) speed: N,
    /// U″·φ̇²_driver, the part of the acceleration that needs no φ̈.
    pub(super) bias: N,
}

/// Working arrays of one evaluation (k: nodes).
#[derive(Clone, Debug)]
pub(super) struct Work<N> {
    /// φ (k); of masses only where somebody looks, see [`Chain::watched`].
    pub(super) displacement: Vec<N>,
    /// φ̇ (k), likewise.
    pub(super) speed: Vec<N>,
    /// φ̈ (k), likewise.
    pub(super) acceleration: Vec<N>,
    /// Q: loads, reactions of followers and forces of rigid followers on each
    /// node (k); not the forces of a mass's own links.
    pub(super) force: Vec<N>,
    /// The forces of the loads that are not constant, as last applied.
    pub(super) loads: Vec<N>,
    /// M: inertia of each node with that of its rigid followers (k).
    pub(super) mass: Vec<N>,
    /// The laws (one for each chain and rigid node).
    pub(super) laws: Vec<LawValues<N>>,
    /// F of link 1 (one for each chain).
    pub(super) reaction: Vec<N>,
    /// The modes of the chains' pairs that these reactions belong to.
    pub(super) pair_modes: Vec<i64>,
    /// The modes of the stops, where there are rigid contacts.
    pub(super) stop_modes: Vec<i64>,
    /// Forces of rigid stops on their masses.
    pub(super) stop_reaction: Vec<N>,
    /// Room for modes with a rigid contact opened, and for accelerations in them.
    pub(super) opened: Vec<i64>,
    pub(super) parting: Vec<N>,
    /// The constraints with several drivers.
    pub(super) constraints: Vec<ConstraintValues<N>>,
    /// Room for the inertia forces on them.
    pub(super) coupling: Coupling<N>,
    /// The linkages of several inputs.
    pub(super) multi: Vec<MultiWork<N>>,
    /// Room for their inertia forces.
    pub(super) dense: Dense<N>,
    /// J of the linkages, for the right-hand side.
    pub(super) reduced_inertia: Vec<N>,
    /// The linkages, solved once for all that looks at them.
    pub(super) linkages: Vec<RefCell<LinkageState>>,
    /// The friction of their joints.
    pub(super) rubbing: Vec<FrictionMemory<N>>,
    /// The same of a linkage of several inputs.
    pub(super) several: Option<Box<SeveralWork<N>>>,
    /// Dry friction at rest.
    pub(super) dry: DryWork<N>,
    /// Places at which the linkages' tables were last looked up.
    pub(super) cursors: Vec<Cell<Cursor>>,
}

impl<N: Quantity> Work<N> {
    /// Arrays of the size that `frozen` needs.
    pub(super) fn new(frozen: &Frozen) -> Self {
        let zero = N::from(0.0);
        let nodes = frozen.inertia.len();
        let law = LawValues {
            value: zero,
            first: zero,
            speed: zero,
            bias: zero,
        };
        Self {
            displacement: vec![zero; nodes],
            speed: vec![zero; nodes],
            acceleration: vec![zero; nodes],
            force: vec![zero; nodes],
            loads: vec![zero; frozen.loads.len()],
            mass: vec![zero; nodes],
            laws: vec![law; frozen.laws.len()],
            reaction: vec![zero; frozen.chains.len()],
            pair_modes: vec![0; frozen.chains.len()],
            stop_modes: vec![0; frozen.stops.len()],
            stop_reaction: vec![zero; frozen.stops.len()],
            opened: Vec::with_capacity(match frozen.impacts {
                true => frozen.no_modes().len(),
                false => 0,
            }),
            parting: match frozen.impacts || !frozen.dry.is_empty() {
                true => vec![zero; frozen.coordinates],
                false => Vec::new(),
            },
            constraints: (frozen.constraints.iter())
                .map(ConstraintValues::new)
                .collect(),
            coupling: Coupling::new(frozen),
            multi: frozen.multi.iter().map(MultiWork::new).collect(),
            dense: Dense::new(frozen),
            reduced_inertia: vec![zero; frozen.linkages.len()],
            linkages: frozen.linkage_memory(),
            rubbing: frozen.friction_memory(),
            several: frozen.multi_input_friction_memory(),
            dry: DryWork::new(frozen),
            cursors: vec![Cell::default(); frozen.linkages.len()],
        }
    }
}

/// Extent of an evaluation: the nodes that it has to fill in.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub(super) enum Extent {
    /// Nodes that the right-hand side needs.
    Needed,
    /// All of them.
    Full,
}

impl Frozen {
    /// u¨ of every coordinate, and everything in `work` on the way to it.
    #[inline(always)]
    pub(super) fn evaluate<N: Quantity>(
        &self,
        time: N,
        state: &[N],
        modes: &[i64],
        extent: Extent,
        work: &mut Work<N>,
        out: &mut [N],
    ) {
        if extent == Extent::Needed {
            for branch in &self.branches {
                self.evaluate_branch(branch, time, state, modes, out);
            }
            if self.coupled.is_empty() {
                return;
            }
            if let Some(direct) = &self.direct {
                return self.evaluate_direct(direct, (time, state, modes), work, out);
            }
            if !self.trains.is_empty() {
                return self.evaluate_trains(time, state, modes, work, out);
            }
        }
        self.motion(time, state, modes, extent, work);
        self.apply_loads(time, modes, extent, work);
        self.apply_reactions(state, modes, extent, work);
        self.reduce_rigid(extent, work);
        if !self.groups.is_empty() {
            self.add_friction(state, modes, extent, work);
        }
        if !self.dry.is_empty() {
            dry_friction::hold_all(self, state, modes, extent, work, out);
        }
        if !self.multi.is_empty() {
            self.hold_rotors(work);
            self.accelerate(state, extent, work, out);
            self.couple_densely(extent, Chains::Free, Some(modes), work);
            return self.accelerate(state, extent, work, out);
        }
        self.accelerate(state, extent, work, out);
        if !self.dry.is_empty() {
            dry_friction::stand_still(self, work, out);
        }
        if !self.heavy.is_empty() && self.couple_inertia_forces(extent, Chains::Free, work) {
            self.accelerate(state, extent, work, out);
        }
    }

    /// The steps that an evaluation goes through.
    #[inline(always)]
    pub(super) fn steps_of(&self, extent: Extent) -> &[Step] {
        match extent {
            Extent::Needed => &self.coupled,
            Extent::Full => &self.steps,
        }
    }

    /// Displacements and speeds; the acceleration of prescribed nodes.
    pub(super) fn motion<N: Quantity>(
        &self,
        time: N,
        state: &[N],
        modes: &[i64],
        extent: Extent,
        work: &mut Work<N>,
    ) {
        let (u, v) = state.split_at(self.coordinates);
        for step in self.steps_of(extent) {
            match step {
                Step::Prescribed(drive) => {
                    let piece = segment(modes, drive.component);
                    let [value, first, second] = time.lift(|time| drive.motion.jet(piece, time));
                    work.displacement[drive.node] = value;
                    work.speed[drive.node] = first;
                    work.acceleration[drive.node] = second;
                }
                Step::Rotor(rotor) => {
                    work.displacement[rotor.node] = u[rotor.coordinate];
                    work.speed[rotor.node] = v[rotor.coordinate];
                }
                Step::Rigid(index) => {
                    let rigid = self.rigids[*index];
                    let law = self.law(rigid.law, modes, extent, work);
                    work.displacement[rigid.node] = law.value;
                    work.speed[rigid.node] = law.speed;
                }
                Step::Chain(index) => {
                    let chain = &self.chains[*index];
                    let law = self.law(chain.law, modes, extent, work);
                    if chain.watched || extent == Extent::Full {
                        for (node, coordinate) in chain.nodes().zip(chain.coordinates()) {
                            work.displacement[node] = law.value + u[coordinate];
                            work.speed[node] = law.speed + v[coordinate];
                        }
                    }
                }
                Step::Constrained(index) => self.constrain(*index, work),
            }
        }
    }

    /// A law at its driver's displacement and speed; kept in `work`.
    #[inline(always)]
    fn law<N: Quantity>(
        &self,
        index: usize,
        modes: &[i64],
        extent: Extent,
        work: &mut Work<N>,
    ) -> LawValues<N> {
        let law = &self.laws[index];
        let displacement = work.displacement[law.driver];
        let speed = work.speed[law.driver];
        let [value, first, second] = match law.output {
            None => displacement.lift(|phi| law.jet(modes, phi)),
            Some(place) => self.output(place, extent, work),
        };
        let values = LawValues {
            value,
            first,
            speed: first * speed,
            bias: second * speed * speed,
        };
        work.laws[index] = values;
        values
    }

    /// Sets the force of the nodes to their loads.
    #[inline]
    pub(super) fn apply_loads<N: Quantity>(
        &self,
        time: N,
        modes: &[i64],
        extent: Extent,
        work: &mut Work<N>,
    ) {
        for (force, &constant) in work.force.iter_mut().zip(&self.constant_force) {
            *force = N::from(constant);
        }
        for index in 0..self.loads.len() {
            let force = self.load(index, time, modes, work);
            work.loads[index] = force;
            work.force[self.loads[index].node] += force;
        }
        self.apply_linkages(extent, work);
        if !self.multi.is_empty() {
            self.apply_multi(true, work);
        }
    }

    /// The force of one of the loads that are not constant.
    #[inline]
    pub(super) fn load<N: Quantity>(
        &self,
        index: usize,
        time: N,
        modes: &[i64],
        work: &Work<N>,
    ) -> N {
        let load = &self.loads[index];
        let (displacement, speed) = (work.displacement[load.node], work.speed[load.node]);
        if let Some(stop) = load.stop {
            let stop = &self.stops[stop];
            return stop.force(modes[stop.component], displacement, speed);
        }
        if let Some(dry) = load.dry {
            let sliding = self.dry[dry].sliding_force(speed, modes);
            return match &load.written {
                None => sliding,
                Some(_) => sliding * dry_friction::engagement(self, dry, (time, modes), work),
            };
        }
        if let Some(written) = &load.written {
            return written.force(time, modes, work);
        }
        load.force(displacement, speed, |axis| {
            let place = axis.node.map_or(time, |node| work.displacement[node]);
            (place, modes[axis.component])
        })
    }

    /// F of every link 1, and what it does to the driver.
    #[inline]
    pub(super) fn apply_reactions<N: Quantity>(
        &self,
        state: &[N],
        modes: &[i64],
        extent: Extent,
        work: &mut Work<N>,
    ) {
        if self.impacts {
            for (mode, stop) in work.stop_modes.iter_mut().zip(&self.stops) {
                *mode = modes[stop.component];
            }
        }
        for step in self.steps_of(extent) {
            let Step::Chain(index) = *step else {
                continue;
            };
            let chain = &self.chains[index];
            let (u, v) = self.deviations(chain, state);
            let mode = self.pair_mode(chain, modes);
            let reaction = self.reaction_of_link(chain, mode, u, v);
            work.reaction[index] = reaction;
            work.pair_modes[index] = mode;
            let first = work.laws[chain.law].first;
            work.force[self.laws[chain.law].driver] += reaction * first;
        }
    }

    /// Deviations u and their rates of a chain.
    #[inline(always)]
    pub(super) fn deviations<'a, N>(&self, chain: &Chain, state: &'a [N]) -> (&'a [N], &'a [N]) {
        let (u, v) = state.split_at(self.coordinates);
        (&u[chain.coordinates()], &v[chain.coordinates()])
    }

    /// Hands the inertia and the forces of rigid nodes to their drivers, the
    /// last driven first.
    pub(super) fn reduce_rigid<N: Quantity>(&self, extent: Extent, work: &mut Work<N>) {
        if !self.constraints.is_empty() || self.impacts {
            return self.reduce_steps(extent, work);
        }
        let rigids = match extent {
            Extent::Needed => &self.needed_rigids,
            Extent::Full => &self.rigids,
        };
        if rigids.is_empty() && extent == Extent::Needed {
            return;
        }
        self.own_masses(extent, work);
        for rigid in rigids.iter().rev() {
            self.reduce_node(rigid.law, rigid.node, work);
        }
    }

    /// Hands the inertia and the force of a node that follows a law exactly to
    /// the law's driver.
    #[inline(always)]
    pub(super) fn reduce_node<N: Quantity>(&self, law: usize, node: usize, work: &mut Work<N>) {
        let values = work.laws[law];
        let driver = self.laws[law].driver;
        let (mass, force) = (work.mass[node], work.force[node]);
        work.mass[driver] += values.first * values.first * mass;
        work.force[driver] += values.first * (force - mass * values.bias);
    }
}
