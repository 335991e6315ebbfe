//! Static equilibrium of the whole graph, with or without inertia loads.
//!
//! Link m of a chain carries F_m, the sum of the forces on the masses from m
//! on; so the deflections follow from the forces, u₁ = F₁/c₁ (plus half the gap)
//! and u_m = u_{m−1} + F_m/c_m. The forces depend on the positions in turn
//! (springs, weights over a lever, followers on a curved law), so u is found
//! by Newton's method with exact derivatives.

mod krylov;
mod rotors;

use super::frozen::{Chain, Frozen, Step};
use super::pairs::OPEN;
use super::passes::{Extent, Work};
use super::stops::FrozenStop;
use crate::dynamics::model::Closure;
use crate::math::number::Dual;
use crate::math::quantity::Quantity;
use nalgebra::{DMatrix, DVector};

/// Most iterations of Newton's method.
const ITERATIONS: usize = 60;

/// Coordinates above which the dense matrix of a step of Newton's method takes longer
/// than some products with it.
const MANY: usize = 40;

/// Coordinates above which the dense matrix of a step is not worth its time, which grows with
/// the third power: at this number about a second.
const TOO_MANY: usize = 1000;

/// Below this share of the forces added up, the force of a link is zero: loads
/// that cancel leave no rounding behind that would choose a flank.
const NO_FORCE: f64 = 1e-12;

/// Loads that are balanced.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub(super) enum Balance {
    /// Loads that a body at rest feels.
    Static,
    /// All loads and the inertia loads of the law's motion.
    Kinetostatic,
}

/// A balance found.
#[derive(Clone, Debug)]
pub(super) struct BalanceState {
    /// [u, u̇]: chains at rest on their laws but for the deflection.
    pub(super) state: Vec<f64>,
    /// F of link 1 of each chain.
    pub(super) reactions: Vec<f64>,
}

impl Frozen {
    /// Solves the balance in given modes, from a state on; `None` when
    /// Newton's method finds none.
    pub(super) fn balance(
        &self,
        kind: Balance,
        start: &[f64],
        modes: &[i64],
    ) -> Option<BalanceState> {
        let n = self.coordinates;
        let mut state = start.to_vec();
        let mut work = Work::new(self);
        let mut miss = vec![0.0; n];
        self.imbalance(kind, 0.0, &state, modes, &mut work, &mut miss);
        if n == 0 {
            let reactions = work.reaction;
            return Some(BalanceState { state, reactions });
        }
        for _ in 0..ITERATIONS {
            let step = self.newton_step(kind, &state, modes, &miss)?;
            let size = largest(&miss);
            let mut share = 1.0;
            loop {
                let mut next = state.clone();
                for index in 0..n {
                    next[index] -= share * step[index];
                }
                self.imbalance(kind, 0.0, &next, modes, &mut work, &mut miss);
                // At the solution rounding decides whether the miss still falls.
                if largest(&miss) < size
                    || share * largest(step.as_slice()) <= resolution(&next[..n])
                {
                    state = next;
                    break;
                }
                share *= 0.5;
                if share < 1e-6 {
                    return None;
                }
            }
            if share * largest(step.as_slice()) <= resolution(&state[..n]) {
                let reactions = work.reaction;
                return miss
                    .iter()
                    .all(|miss| miss.is_finite())
                    .then_some(BalanceState { state, reactions });
            }
        }
        None
    }

    /// u̇ of the balanced deflection as the mechanism moves on: the derivative
    /// in time of the condition that the balance holds.
    pub(super) fn balance_rate(
        &self,
        kind: Balance,
        state: &[f64],
        modes: &[i64],
    ) -> Option<Vec<f64>> {
        let n = self.coordinates;
        let mut work = Work::new(self);
        let mut miss = vec![0.0; n];
        self.imbalance(kind, 0.0, state, modes, &mut work, &mut miss);
        let mut moving: Vec<Dual> = state.iter().map(|&value| Dual::from(value)).collect();
        for step in &self.steps {
            if let Step::Rotor(rotor) = step {
                let c = rotor.coordinate;
                moving[c] = Dual::new(state[c], state[n + c]);
                moving[n + c] = Dual::new(state[n + c], work.acceleration[rotor.node]);
            }
        }
        let mut dual_work = Work::new(self);
        let mut dual_miss = vec![Dual::default(); n];
        self.imbalance(
            kind,
            Dual::new(0.0, 1.0),
            &moving,
            modes,
            &mut dual_work,
            &mut dual_miss,
        );
        let change: Vec<f64> = dual_miss.iter().map(|miss| miss.derivative).collect();
        let rate = self.newton_step(kind, state, modes, &change)?;
        let rate: Vec<f64> = rate.iter().map(|rate| -rate).collect();
        rate.iter().all(|rate| rate.is_finite()).then_some(rate)
    }

    /// Forces of link 1 of all chains for the loads at a state.
    pub(super) fn link_forces(&self, kind: Balance, state: &[f64], modes: &[i64]) -> Vec<f64> {
        let mut work = Work::new(self);
        let mut miss = vec![0.0; self.coordinates];
        self.imbalance(kind, 0.0, state, modes, &mut work, &mut miss);
        work.reaction
    }

    /// Solves (∂miss/∂u)·step = miss.
    fn newton_step(
        &self,
        kind: Balance,
        state: &[f64],
        modes: &[i64],
        miss: &[f64],
    ) -> Option<DVector<f64>> {
        let n = self.coordinates;
        if n == 0 {
            return Some(DVector::zeros(0));
        }
        if n > MANY {
            let step = self.krylov_step(kind, state, modes, miss);
            if step.is_some() || n > TOO_MANY {
                return step;
            }
        }
        let mut work = Work::new(self);
        let mut column = vec![Dual::default(); n];
        let mut jacobian = DMatrix::zeros(n, n);
        let mut point: Vec<Dual> = state.iter().map(|&value| Dual::from(value)).collect();
        for j in 0..n {
            point[j].derivative = 1.0;
            self.imbalance(kind, Dual::from(0.0), &point, modes, &mut work, &mut column);
            point[j].derivative = 0.0;
            for i in 0..n {
                jacobian[(i, j)] = column[i].derivative;
            }
        }
        // A rotor's angle is given.
        for step in &self.steps {
            if let Step::Rotor(rotor) = step {
                jacobian.column_mut(rotor.coordinate).fill(0.0);
                jacobian[(rotor.coordinate, rotor.coordinate)] = 1.0;
            }
        }
        let step = jacobian.lu().solve(&DVector::from_column_slice(miss))?;
        step.iter().all(|step| step.is_finite()).then_some(step)
    }

    /// u less the deflection that the forces at u make; 0 for rotors.
    fn imbalance<N: Quantity>(
        &self,
        kind: Balance,
        time: N,
        state: &[N],
        modes: &[i64],
        work: &mut Work<N>,
        miss: &mut [N],
    ) {
        self.motion(time, state, modes, Extent::Full, work);
        if kind == Balance::Kinetostatic {
            self.law_accelerations(time, modes, work);
        }
        self.apply_resting_loads(time, modes, work);
        if !self.multi.is_empty() {
            self.balance_multi(kind, work);
        }
        if kind == Balance::Kinetostatic {
            for (node, &inertia) in self.inertia.iter().enumerate() {
                let load = work.acceleration[node].scale(inertia);
                work.force[node] -= load;
            }
            for (index, linkage) in self.linkages.iter().enumerate() {
                let reduced = self.linkage(index, work);
                let load = reduced.inertia * work.acceleration[linkage.node] + reduced.bias;
                work.force[linkage.node] -= load;
            }
        }
        for step in self.steps.iter().rev() {
            match step {
                Step::Prescribed(_) => {}
                Step::Rotor(rotor) => miss[rotor.coordinate] = N::from(0.0),
                Step::Rigid(index) => {
                    let rigid = self.rigids[*index];
                    let force = work.laws[rigid.law].first * work.force[rigid.node];
                    work.force[self.laws[rigid.law].driver] += force;
                }
                Step::Chain(index) => self.deflect(*index, state, modes, work, miss),
                Step::Constrained(index) => {
                    let force = work.force[self.constraints[*index].node];
                    self.load_drivers(*index, force, work);
                }
            }
        }
    }

    /// u less the deflection of one chain; its F of link 1 goes to its driver.
    fn deflect<N: Quantity>(
        &self,
        index: usize,
        state: &[N],
        modes: &[i64],
        work: &mut Work<N>,
        miss: &mut [N],
    ) {
        let chain = &self.chains[index];
        let rests = self.lies_on_stop(index, modes);
        if rests && let Some(stop) = self.rigid_rest(index, modes) {
            return self.deflect_to_stop(index, stop, state, work, miss);
        }
        let rigid = chain.contact.restitution().is_some();
        let (u, _) = self.deviations(chain, state);
        let miss = &mut miss[chain.coordinates()];
        let stiffness = &self.stiffness[chain.coordinates()];
        let mut carried = N::from(0.0);
        let mut size = 0.0;
        for m in (0..chain.masses).rev() {
            let force = work.force[chain.first_node + m];
            carried += force;
            size += force.value().abs();
            if carried.value().abs() <= NO_FORCE * size {
                carried = carried - N::from(carried.value());
            }
            if m == 0 && rests {
                // The pair carries nothing: all that acts is in balance on the stop.
                let scale = match rigid {
                    true => self.stop_stiffness(index, modes),
                    false => stiffness[0],
                };
                miss[0] = -carried.scale(1.0 / scale);
                continue;
            }
            let below = if m > 0 {
                u[m - 1]
            } else {
                N::from(self.flank(chain, modes))
            };
            if m == 0 && rigid {
                miss[0] = u[0] - below;
                continue;
            }
            miss[m] = match chain.contact.power().filter(|_| m == 0) {
                None => u[m] - below - carried.scale(1.0 / stiffness[m]),
                Some(power) => u[m] - below - carried.lift(|force| power.deflection(force))[0],
            };
        }
        if rests {
            work.reaction[index] = N::from(0.0);
            return;
        }
        work.reaction[index] = carried;
        let reaction = carried * work.laws[chain.law].first;
        work.force[self.laws[chain.law].driver] += reaction;
    }

    /// u less the deflection of a chain whose pair is open and that lies on a rigid stop: its
    /// last mass stands there, and its links carry the forces to it.
    fn deflect_to_stop<N: Quantity>(
        &self,
        index: usize,
        stop: &FrozenStop,
        state: &[N],
        work: &mut Work<N>,
        miss: &mut [N],
    ) {
        let chain = &self.chains[index];
        let (u, _) = self.deviations(chain, state);
        let miss = &mut miss[chain.coordinates()];
        let stiffness = &self.stiffness[chain.coordinates()];
        let mut before = N::from(0.0);
        for m in 0..chain.masses {
            if m > 0 {
                // Link m carries what acts on the masses before it, towards the stop.
                miss[m] = u[m] - u[m - 1] + before.scale(1.0 / stiffness[m]);
            }
            before += work.force[chain.first_node + m];
        }
        miss[0] = stop.deformation(work.displacement[stop.node]);
        work.reaction[index] = N::from(0.0);
    }

    /// The rigid stop that a chain lies on.
    fn rigid_rest(&self, index: usize, modes: &[i64]) -> Option<&FrozenStop> {
        let mut stops = self.stops_of(index);
        stops.find(|stop| stop.contact.contact_holds(modes[stop.component]))
    }

    /// Stiffness of the stop that a chain lies on.
    fn stop_stiffness(&self, index: usize, modes: &[i64]) -> f64 {
        let mut stops = self.stops_of(index);
        let own = stops.find(|stop| modes[stop.component] != OPEN);
        own.map_or(1.0, |stop| stop.contact.stiffness())
    }

    /// x at which the flank of a mode is touched; 0, the middle, when open.
    fn flank(&self, chain: &Chain, modes: &[i64]) -> f64 {
        match chain.contact.closure {
            Closure::Form => self.pair_mode(chain, modes) as f64 * chain.contact.half_gap,
            Closure::Bilateral | Closure::Force => 0.0,
        }
    }

    /// Loads that need no speed: a start at rest does not feel the others.
    fn apply_resting_loads<N: Quantity>(&self, time: N, modes: &[i64], work: &mut Work<N>) {
        for (force, &constant) in work.force.iter_mut().zip(&self.constant_force) {
            *force = N::from(constant);
        }
        for index in 0..self.loads.len() {
            if !self.loads[index].law.needs_speed() {
                let force = self.load(index, time, modes, work);
                work.force[self.loads[index].node] += force;
            }
        }
        for (index, linkage) in self.linkages.iter().enumerate() {
            let force = self.linkage(index, work).resting_force();
            work.force[linkage.node] += force;
        }
    }
}

/// The largest absolute value; ∞ when one is not a number.
fn largest(values: &[f64]) -> f64 {
    values.iter().fold(0.0, |largest: f64, value| {
        if value.is_nan() {
            f64::INFINITY
        } else {
            largest.max(value.abs())
        }
    })
}

/// A change of u too small to matter.
fn resolution(u: &[f64]) -> f64 {
    4.0 * f64::EPSILON * largest(u) + f64::MIN_POSITIVE
}

/// The mode that a pair has under a force of its link at rest.
pub(super) fn resting_mode(chain: &Chain, reaction: f64) -> i64 {
    let pressed = |&&side: &&i64| side as f64 * reaction > 0.0;
    chain
        .contact
        .sides()
        .iter()
        .find(pressed)
        .copied()
        .unwrap_or(OPEN)
}
