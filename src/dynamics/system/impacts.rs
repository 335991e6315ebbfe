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
//! what is too low to be followed is held ([`restitution`]), and the time at which the series
//! ends is told.

use super::System;
use super::constraints::Chains;
use super::frozen::{Frozen, Step};
use super::pairs::{Contact, OPEN};
use super::passes::{Extent, Work};
use crate::dynamics::integrate::{EventFunction, Impact, Modes, PhysicalStop, Probe};
use crate::dynamics::restitution;

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
    /// Work of the prescribed drives (J).
    drives: f64,
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
    fn approach(
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
        if !self.heavy.is_empty() && self.couple(extent, Chains::Free, work) {
            self.accelerate(&still, extent, work, &mut rates);
        }
        // The rate of a massless point follows from the balance of its forces.
        for chain in self.chains.iter().filter(|chain| chain.point) {
            rates[chain.first_coordinate] = 0.0;
        }
        let [_, own] = self.approach((component, side), &still, &rates, work);
        let held = (0..self.contacts()).map(|other| match self.held_force(other, modes, work) {
            Some(force) if other != component => force,
            _ => 0.0,
        });
        let held = held.collect();
        let drives = self.steps.iter().map(|step| match step {
            Step::Prescribed(drive) => -work.force[drive.node] * speeds[drive.node],
            _ => 0.0,
        });
        let drives = drives.sum();
        Response {
            rates,
            own,
            held,
            drives,
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
        if !self.contact_of(component).holds(mode) {
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
    fn put_on_flank(
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
        (0..self.contacts()).any(|component| self.contact_of(component).holds(modes[component]))
    }

    /// Probes of the rigid contacts that are held: whether one would pull.
    pub(super) fn probe_held(&self, modes: &[i64], out: &mut Vec<Probe>) {
        for component in 0..self.contacts() {
            if self.contact_of(component).holds(modes[component]) {
                out.push(Probe {
                    index: self.groups.len() + component,
                    component,
                    target: OPEN,
                    looks: LOOKS,
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
        let [_, acceleration] = self.approach((component, side), state, &accelerations, work);
        work.opened = open;
        work.parting = accelerations;
        -acceleration
    }
}

impl System {
    /// True when the pair of an object, or the stop that it is, is a rigid contact.
    pub fn is_rigid_contact(&self, object: usize) -> bool {
        let component = self.pair_component(object);
        component.is_some_and(|component| self.frozen.is_rigid(component))
    }

    /// A rigid contact comes together, or apart.
    ///
    /// # Errors
    /// It is pressed together between what cannot give way.
    pub(super) fn pass_rigid(
        &self,
        time: f64,
        y: &mut [f64],
        watch: &EventFunction,
        modes: &mut Modes,
    ) -> Result<Option<Impact>, PhysicalStop> {
        let frozen = &self.frozen;
        let mut work = Work::new(frozen);
        let component = watch.component;
        if watch.target == OPEN {
            let contact = (component, modes.0[component]);
            frozen.put_on_flank(contact, 0.0, (time, &modes.0), y, &mut work);
            modes.0[component] = OPEN;
            return Ok(None);
        }
        self.collide(time, y, (component, watch.target), &mut modes.0, &mut work)
    }

    /// The impact of a contact that comes together.
    fn collide(
        &self,
        time: f64,
        y: &mut [f64],
        contact: (usize, i64),
        modes: &mut [i64],
        work: &mut Work<f64>,
    ) -> Result<Option<Impact>, PhysicalStop> {
        let frozen = &self.frozen;
        let (component, side) = contact;
        let n = frozen.coordinates;
        // What is held is where it is held, whatever an integration has made of that.
        for other in 0..frozen.contacts() {
            if frozen.contact_of(other).holds(modes[other]) {
                frozen.put_on_flank((other, modes[other]), 0.0, (time, modes), y, work);
            }
        }
        frozen.motion(time, y, modes, Extent::Full, work);
        let still = vec![0.0; n];
        let approach = frozen.approach(contact, y, &still, work)[0];
        if approach < 0.0 {
            // It is going apart: by no more than rounding it was behind its flank.
            frozen.put_on_flank(contact, approach, (time, modes), y, work);
            return Ok(None);
        }
        let response = frozen.complementary(time, y, modes, contact, work);
        let response = response.ok_or_else(|| self.jammed(time, component))?;
        let coefficient = frozen.contact_of(component).restitution().unwrap_or(0.0);
        let jump = |y: &mut [f64], rate: f64| {
            let impulse = (approach + rate) / -response.own;
            for (index, jump) in response.rates.iter().enumerate() {
                y[n + index] += impulse * jump;
            }
            impulse
        };
        let before = y.to_vec();
        let mut rate = coefficient * approach;
        let mut impulse = jump(y, rate);
        frozen.put_on_flank(contact, -rate, (time, modes), y, work);
        modes[component] = side;
        let pressing = -frozen.parting(component, time, y, modes, work);
        let rests = restitution::rests(
            time,
            frozen.size_of(component, y),
            [rate, pressing],
            coefficient,
        );
        if rests.is_some() {
            y.copy_from_slice(&before);
            rate = 0.0;
            impulse = jump(y, rate);
            frozen.put_on_flank(contact, 0.0, (time, modes), y, work);
        } else {
            modes[component] = OPEN;
        }
        Ok(Some(Impact {
            component,
            side,
            approach,
            impulse,
            lost: 0.5 * impulse * (approach - rate),
            drives: impulse * response.drives,
            rests,
        }))
    }

    fn jammed(&self, time: f64, component: usize) -> PhysicalStop {
        let is = |part: &usize| self.pair_component(*part) == Some(component);
        let object = (0..self.model.objects.len()).find(is).unwrap_or(0);
        let id = &self.model.objects[object].id;
        let at = crate::units::shown(time, 9);
        PhysicalStop {
            name: "jammed",
            object: id.clone(),
            message: format!(
                "{id} is pressed together between rigid contacts at t = {at} s: nothing gives way \
                 there, and no motion goes on"
            ),
        }
    }

    /// Sets the modes of rigid contacts that touch without a speed: held, but for those
    /// that would come apart.
    ///
    /// # Errors
    /// What stands within a rigid flank.
    pub(super) fn settle_rigid(
        &self,
        y: &mut [f64],
        noise: &[f64],
        modes: &mut [i64],
    ) -> Result<(), Vec<crate::fault::Fault>> {
        let frozen = &self.frozen;
        let mut work = Work::new(frozen);
        let mut faults = Vec::new();
        let mut touching = Vec::new();
        for component in 0..frozen.contacts() {
            if !frozen.is_rigid(component) {
                continue;
            }
            modes[component] = OPEN;
            frozen.motion(0.0, y, modes, Extent::Full, &mut work);
            let place = frozen.place_of(component);
            let still = vec![0.0; frozen.coordinates];
            let (x, at) = match frozen.pairs.get(component) {
                Some(_) => (y[place], 0.0),
                None => {
                    let stop = &frozen.stops[component - frozen.pairs.len()];
                    let displacement = work.displacement[stop.node];
                    (
                        stop.deformation(displacement),
                        displacement.abs() + stop.at.abs(),
                    )
                }
            };
            let contact = frozen.contact_of(component);
            let doubt = TOUCH * (noise[place] + at + contact.half_gap);
            for &side in contact.sides() {
                let (depth, _) = contact.penetration(side, x, 0.0);
                if depth > doubt {
                    faults.push(self.inside(component, depth));
                } else if depth >= -doubt {
                    let rate = frozen.approach((component, side), y, &still, &work)[0];
                    let speeds = noise[frozen.coordinates + place]
                        + work.speed[frozen.node_of(component)].abs();
                    if rate.abs() <= TOUCH * speeds {
                        frozen.put_on_flank((component, side), 0.0, (0.0, modes), y, &mut work);
                        modes[component] = side;
                        touching.push(component);
                    } else if rate > 0.0 {
                        frozen.put_on_flank((component, side), rate, (0.0, modes), y, &mut work);
                    }
                }
            }
        }
        // Each round opens one; what has opened presses on none of the others.
        for _ in 0..touching.len() {
            let parts = |&&component: &&usize| {
                modes[component] != OPEN
                    && frozen.parting(component, 0.0, y, modes, &mut work) > 0.0
            };
            match touching.iter().find(parts) {
                Some(&component) => modes[component] = OPEN,
                None => break,
            }
        }
        match faults.is_empty() {
            true => Ok(()),
            false => Err(faults),
        }
    }

    fn inside(&self, component: usize, depth: f64) -> crate::fault::Fault {
        let is = |part: &usize| self.pair_component(*part) == Some(component);
        let object = (0..self.model.objects.len()).find(is).unwrap_or(0);
        let id = &self.model.objects[object].id;
        let depth = crate::units::shown(depth, 6);
        crate::fault::Fault::new(
            format!("run.start.{id}"),
            format!("at t = 0 {id} stands {depth} within its rigid contact"),
            "a start on the flank or clear of it, or a contact with a stiffness",
        )
    }
}

/// Roundings of a displacement within which a contact touches at t = 0.
const TOUCH: f64 = 8.0 * f64::EPSILON;
