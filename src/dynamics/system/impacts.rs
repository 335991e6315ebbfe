//! Rigid contacts: impacts with a coefficient of restitution, and what is held at rest.
//!
//! A rigid contact, of a pair or of a stop, has the penetration p of its flank and a force
//! N ≥ 0 that is no function of p. Open, it transmits nothing. Where p rises to zero at the
//! speed ṗ⁻ > 0 the speeds jump (Newton's law of restitution): an impulse P ≥ 0 acts on both
//! sides of the contact so that ṗ⁺ = −e·ṗ⁻. Held, p = 0 and N follows from the motion; the
//! contact opens when it would pull. While others are held they bear their part of the
//! impulse, as far as they press; those that would pull come apart (complementarity of
//! impulses and speeds, after J. J. Moreau, Unilateral contact and dry friction in finite
//! freedom dynamics, 1988).
//!
//! All forces act on accelerations linearly, and so do impulses on speeds: what an impulse
//! of 1 does is one evaluation without speeds, deformations and loads.
//!
//! Impacts that follow each other in ever shorter times (e < 1) make a geometric series:
//! what is too low to be followed is held ([`crate::dynamics::restitution`]), and the time at
//! which the series ends is reported.
//!
//! A held body is one with its law: it hands inertia and forces to its driver as a rigid node
//! does, and the contact force is what the balance leaves. A held stop takes the acceleration
//! of its mass. Separation is a probe, the acceleration with which the bodies would part. Steps
//! are bounded while bodies are held, since no state shows that force. `Dynamics::switch`
//! returns the `Impact`, which goes to the listeners with the event. `exact` has impacts of its
//! own on single masses (`exact::impacts`).

mod passing;

use super::constraints::Chains;
use super::frozen::{Frozen, Step};
use super::pairs::{Contact, OPEN};
use super::passes::{Extent, Work};
use crate::dynamics::integrate::Probe;

/// Share of the response with all other contacts open below which an impulse moves nothing.
const NO_RESPONSE: f64 = 1e-9;

/// Looks in a step at what is held.
const LOOKS: usize = 4;

/// What rigid contacts do in response to an impulse of 1 in one of them.
struct Response {
    /// Jumps of the rates of all coordinates (n).
    rates: Vec<f64>,
    /// Jump of ṗ of the contact itself.
    own: f64,
    /// Impulse N of every contact that is held, by component; 0 of all others.
    held: Vec<f64>,
    /// Work of every prescribed drive (J), with its node.
    drives: Vec<(usize, f64)>,
}

impl Response {
    /// Work of all prescribed drives (J).
    fn work_of_drives(&self) -> f64 {
        self.drives.iter().map(|(_, work)| work).sum()
    }
}

impl Frozen {
    /// The contact of a component of the modes.
    fn contact_of(&self, component: usize) -> &Contact {
        match self.pairs.get(component) {
            Some(&chain) => &self.chains[chain].contact,
            None => &self.stops[component - self.pairs.len()].contact,
        }
    }

    /// True of a component that is a rigid contact.
    pub(super) fn is_rigid(&self, component: usize) -> bool {
        component < self.contacts() && self.contact_of(component).restitution().is_some()
    }

    /// True where there are rigid contacts.
    pub(super) fn has_rigid_contacts(&self) -> bool {
        (0..self.contacts()).any(|component| self.is_rigid(component))
    }

    /// ṗ, p̈ of a contact on a side, from a complete evaluation at a state.
    fn approach_rates(
        &self,
        (component, side): (usize, i64),
        state: &[f64],
        accelerations: &[f64],
        work: &Work<f64>,
    ) -> [f64; 2] {
        let sign = side as f64;
        match self.pairs.get(component) {
            Some(&chain) => {
                let first = self.chains[chain].first_coordinate;
                [
                    sign * state[self.coordinates + first],
                    sign * accelerations[first],
                ]
            }
            None => {
                let node = self.stops[component - self.pairs.len()].node;
                [sign * work.speed[node], sign * work.acceleration[node]]
            }
        }
    }

    /// What an impulse of 1 in a contact, in modes in which it is open, does at a state.
    fn response(
        &self,
        time: f64,
        state: &[f64],
        modes: &[i64],
        (component, side): (usize, i64),
        work: &mut Work<f64>,
    ) -> Response {
        let extent = Extent::Full;
        self.motion(time, state, modes, extent, work);
        let speeds = work.speed.clone();
        let still = vec![0.0; state.len()];
        self.apply_reactions(&still, modes, extent, work);
        for law in &mut work.laws {
            law.bias = 0.0;
        }
        for constraint in &mut work.constraints {
            constraint.bias = 0.0;
        }
        work.acceleration.fill(0.0);
        work.force.fill(0.0);
        work.reaction.fill(0.0);
        let push = side as f64;
        match self.pairs.get(component) {
            Some(&index) => {
                let law = self.chains[index].law;
                work.reaction[index] = push;
                work.force[self.laws[law].driver] += push * work.laws[law].first;
            }
            None => work.force[self.stops[component - self.pairs.len()].node] -= push,
        }
        self.reduce_rigid(extent, work);
        let mut rates = vec![0.0; self.coordinates];
        self.accelerate(&still, extent, work, &mut rates);
        if !self.heavy.is_empty() && self.couple_inertia_forces(extent, Chains::Free, work) {
            self.accelerate(&still, extent, work, &mut rates);
        }
        // The rate of a massless point follows from the balance of its forces.
        for chain in self.chains.iter().filter(|chain| chain.point) {
            rates[chain.first_coordinate] = 0.0;
        }
        let [_, own] = self.approach_rates((component, side), &still, &rates, work);
        let held = (0..self.contacts()).map(|other| match self.held_force(other, modes, work) {
            Some(force) if other != component => force,
            _ => 0.0,
        });
        let held = held.collect();
        let drives = self.steps.iter().filter_map(|step| match step {
            Step::Prescribed(drive) => {
                Some((drive.node, -work.force[drive.node] * speeds[drive.node]))
            }
            _ => None,
        });
        Response {
            rates,
            own,
            held,
            drives: drives.collect(),
        }
    }

    /// N of a rigid contact that is held, as of the last evaluation.
    pub(super) fn held_force(
        &self,
        component: usize,
        modes: &[i64],
        work: &Work<f64>,
    ) -> Option<f64> {
        let mode = modes[component];
        if !self.contact_of(component).contact_holds(mode) {
            return None;
        }
        Some(match self.pairs.get(component) {
            Some(&chain) => mode as f64 * work.reaction[chain],
            None => -(mode as f64) * work.stop_reaction[component - self.pairs.len()],
        })
    }

    /// The response in modes that are changed until none of the contacts held would pull;
    /// `None` where the impulse moves nothing.
    fn complementary(
        &self,
        time: f64,
        state: &[f64],
        modes: &mut [i64],
        contact: (usize, i64),
        work: &mut Work<f64>,
    ) -> Option<Response> {
        let free: Vec<i64> = (modes.iter().enumerate())
            .map(|(component, &mode)| match self.is_rigid(component) {
                true => OPEN,
                false => mode,
            })
            .collect();
        let most = self.response(time, state, &free, contact, work).own.abs();
        for _ in 0..=self.contacts() {
            let response = self.response(time, state, modes, contact, work);
            let least = (response.held.iter().enumerate()).min_by(|a, b| a.1.total_cmp(b.1));
            match least {
                Some((component, &force)) if force < -NO_RESPONSE => modes[component] = OPEN,
                _ if response.own < -NO_RESPONSE * most => return Some(response),
                _ => return None,
            }
        }
        None
    }

    /// Puts what a rigid contact binds where it is bound: on its flank, at a speed ṗ.
    fn set_on_flank(
        &self,
        (component, side): (usize, i64),
        rate: f64,
        (time, modes): (f64, &[i64]),
        state: &mut [f64],
        work: &mut Work<f64>,
    ) {
        let sign = side as f64;
        let n = self.coordinates;
        match self.pairs.get(component) {
            Some(&chain) => {
                let chain = &self.chains[chain];
                state[chain.first_coordinate] = sign * chain.contact.half_gap;
                state[n + chain.first_coordinate] = sign * rate;
            }
            None => {
                let stop = &self.stops[component - self.pairs.len()];
                let chain = &self.chains[stop.chain];
                self.motion(time, state, modes, Extent::Full, work);
                let law = work.laws[chain.law];
                let own = stop.node - chain.first_node + chain.first_coordinate;
                state[own] = stop.at - law.value;
                state[n + own] = sign * rate - law.speed;
            }
        }
    }

    /// Size of the numbers that the clearance of a contact is the difference of.
    fn size_of(&self, component: usize, state: &[f64]) -> f64 {
        match self.pairs.get(component) {
            Some(&chain) => self.chains[chain].contact.half_gap,
            // φ = U + u, in which the law's part may be many times the rest.
            None => {
                let at = self.stops[component - self.pairs.len()].at.abs();
                at + state[self.place_of(component)].abs()
            }
        }
    }

    /// The node that comes into contact.
    fn node_of(&self, component: usize) -> usize {
        match self.pairs.get(component) {
            Some(&chain) => self.chains[chain].first_node,
            None => self.stops[component - self.pairs.len()].node,
        }
    }

    /// Coordinate of the node that comes into contact.
    fn place_of(&self, component: usize) -> usize {
        match self.pairs.get(component) {
            Some(&chain) => self.chains[chain].first_coordinate,
            None => {
                let stop = &self.stops[component - self.pairs.len()];
                let chain = &self.chains[stop.chain];
                stop.node - chain.first_node + chain.first_coordinate
            }
        }
    }

    /// True where a rigid contact is held.
    pub(super) fn holds_any(&self, modes: &[i64]) -> bool {
        (0..self.contacts())
            .any(|component| self.contact_of(component).contact_holds(modes[component]))
    }

    /// Probes of the rigid contacts that are held: whether one would pull.
    pub(super) fn probe_held(&self, modes: &[i64], out: &mut Vec<Probe>) {
        for component in 0..self.contacts() {
            if self.contact_of(component).contact_holds(modes[component]) {
                out.push(Probe {
                    index: self.friction_group_count() + component,
                    component,
                    target: OPEN,
                    looks: LOOKS,
                    refined: false,
                });
            }
        }
    }

    /// The acceleration with which a contact that is held would come apart, were it open.
    pub(super) fn parting(
        &self,
        component: usize,
        time: f64,
        state: &[f64],
        modes: &[i64],
        work: &mut Work<f64>,
    ) -> f64 {
        let side = modes[component];
        let mut open = std::mem::take(&mut work.opened);
        open.clear();
        open.extend_from_slice(modes);
        open[component] = OPEN;
        let mut accelerations = std::mem::take(&mut work.parting);
        self.evaluate(time, state, &open, Extent::Full, work, &mut accelerations);
        let [_, acceleration] = self.approach_rates((component, side), state, &accelerations, work);
        work.opened = open;
        work.parting = accelerations;
        -acceleration
    }
}
