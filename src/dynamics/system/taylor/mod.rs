//! The motion as a power series in time, from the equations of motion.
//!
//! With s = (t − t₀)/L, every quantity of the passes (see `passes`) is a series
//! Σ q_k·s^k. Accelerations of order k need displacements up to order k + 1
//! only, and give those of order k + 2. One pass over the equations for each
//! order, each operation by its rule for series (product, quotient, and for
//! tanh its differential equation), as in the Taylor methods of A. Griewank and
//! A. Walther, Evaluating derivatives (2008), chapter 13. Laws are taken along
//! the way of their driver, see [`law`].
//!
//! The speed table of a motor has kinks that no series knows of: systems with
//! one have no expansion here, and neither have those with a linkage.
//!
//! Series are extended order by order, in memory that the passes lay out: a product of whole
//! series would do the work of all orders again.

mod accelerations;
mod begin;
mod law;
mod points;
#[cfg(test)]
mod tests;
mod written;

pub(crate) use law::HIGHEST;
pub(super) use law::expansion_range as way_of_law;

use super::constraints::ConstrainedNode;
use super::frozen::{Chain, Frozen, Rigid, Step};
use super::pairs::OPEN;
use super::passes::Work;
use super::stops::FrozenStop;
use super::written::WrittenSeries;
use crate::dynamics::load::LoadSeries;
use crate::dynamics::model::{Closure, LoadLaw};
use crate::math::polynomial::product;
use law::{LawSeries, Series};

/// The polynomial of a law is good a little beyond its reach.
const BEYOND: f64 = 1.1;

/// True for a function of speed with corners, which no series knows of.
fn has_corners(law: &LoadLaw) -> bool {
    law.function().is_some_and(|own| !own.corners().is_empty())
}

const ZERO: Series = [0.0; HIGHEST + 1];

/// Series of everything; made once, used for every step.
#[derive(Clone, Debug)]
pub(super) struct Taylor {
    /// φ and φ̇ of the nodes (k).
    pub(super) displacement: Vec<Series>,
    pub(super) speed: Vec<Series>,
    /// φ̈.
    acceleration: Vec<Series>,
    force: Vec<Series>,
    mass: Vec<Series>,
    /// F of each chain's link 1.
    reaction: Vec<Series>,
    /// Mode of each chain's pair, and of each stop.
    modes: Vec<i64>,
    stop_modes: Vec<i64>,
    /// Of each law that a rigid object follows: U″φ̇², φ̇² of its driver, U′·M and
    /// F − M·U″φ̇².
    bias: Vec<Series>,
    square: Vec<Series>,
    slope: Vec<Series>,
    rest: Vec<Series>,
    laws: Vec<LawSeries>,
    /// Of each load that is a function of its node's motion its series.
    loads: Vec<Option<Box<dyn LoadSeries>>>,
    /// Of each load by an expression its series, and the force as one.
    written: Vec<Option<(WrittenSeries, Series)>>,
    /// u and u̇ of the coordinates (n).
    u: Vec<Series>,
    v: Vec<Series>,
    /// Time of the whole series, s from 0 to 1 (s).
    length: f64,
    /// Share of U′ that the last coefficients of a law may have.
    last: f64,
    /// Factor by which the length is too great for the motions of the drives.
    excess: f64,
}

impl Taylor {
    pub(super) fn new(frozen: &Frozen) -> Self {
        let (nodes, laws) = (frozen.inertia.len(), frozen.laws.len());
        let series = |count: usize| vec![ZERO; count];
        Self {
            displacement: series(nodes),
            speed: series(nodes),
            acceleration: series(nodes),
            force: series(nodes),
            mass: series(nodes),
            reaction: series(frozen.chains.len()),
            modes: vec![OPEN; frozen.chains.len()],
            stop_modes: vec![OPEN; frozen.stops.len()],
            bias: series(laws),
            square: series(laws),
            slope: series(laws),
            rest: series(laws),
            laws: vec![LawSeries::default(); laws],
            loads: (frozen.loads.iter())
                .map(|load| load.law.function()?.series())
                .collect(),
            written: (frozen.loads.iter())
                .map(|load| Some((load.written.as_ref()?.series(), ZERO)))
                .collect(),
            u: series(frozen.coordinates),
            v: series(frozen.coordinates),
            length: 1.0,
            last: law::last(HIGHEST),
            excess: 0.0,
        }
    }

    /// Factor from coefficient k of φ̈ to coefficient k + 2 of φ.
    fn integration_factor(&self, order: usize) -> f64 {
        self.length * self.length / ((order + 1) * (order + 2)) as f64
    }

    /// Sets φ of a node at an order, and φ̇ at the one before.
    fn set_coefficient(&mut self, node: usize, order: usize, value: f64) {
        self.displacement[node][order] = value;
        if order > 0 {
            self.speed[node][order - 1] = order as f64 * value / self.length;
        }
    }
}

/// State at which a motion starts.
pub(super) struct Start<'a> {
    pub(super) time: f64,
    pub(super) y: &'a [f64],
    /// Derivative there.
    pub(super) dy: &'a [f64],
    pub(super) modes: &'a [i64],
}

impl Frozen {
    /// True when motions can be expanded.
    pub(super) fn expands(&self) -> bool {
        self.without_series().is_none()
    }

    /// What of the motion has no power series, in words; `None`: it has one.
    pub(super) fn without_series(&self) -> Option<&'static str> {
        let mut contacts = self.chains.iter().map(|chain| chain.contact.power());
        let mut stops = self.stops.iter().map(|stop| stop.contact.power());
        let linear = |one: &ConstrainedNode| one.constraint.is_linear();
        if !self.multi.is_empty() {
            Some("a linkage with several inputs, which couples coordinates,")
        } else if !self.linkages.is_empty() {
            Some("a linkage, whose inertia changes with its position,")
        } else if !self.constraints.iter().all(linear) {
            Some("a constraint that is not linear")
        } else if !self.heavy.is_empty() {
            Some("inertia on an object with several inputs, which couples coordinates,")
        } else if !self.dry.is_empty() {
            Some("dry friction that sticks")
        } else if self.loads.iter().any(|load| has_corners(&load.law)) {
            Some("a motor's torque by a table of speeds")
        } else if self.loads.iter().any(|load| !load.has_series) {
            Some("a load from outside the library")
        } else if contacts.any(|contact| contact.is_some()) {
            Some(
                "a contact force that grows with a power of the indentation, such as that of Hertz,",
            )
        } else if stops.any(|stop| stop.is_some()) {
            Some(
                "the force of a stop that grows with a power of the indentation, such as that of Hertz,",
            )
        } else {
            None
        }
    }

    /// Series to the power `degree` over the time `length`: coefficients of all
    /// signals into `out`, one after the other. Returns what they take for
    /// granted, at 1 just all of it. The longest way that a driver goes, in units
    /// of that for which its law is known, and how many times the length is that
    /// for which the series of the loads can be relied on.
    pub(super) fn expand(
        &self,
        start: &Start<'_>,
        degree: usize,
        length: f64,
        work: &mut Work<f64>,
        taylor: &mut Taylor,
        out: &mut [f64],
    ) -> f64 {
        taylor.length = length;
        taylor.last = law::last(degree);
        self.set_first_orders(start, work, taylor);
        for order in 0..=degree - 2 {
            self.forces_of(start, order, work, taylor);
            self.hand_to_drivers(order, taylor);
            self.accelerations_of(order, taylor);
        }
        let extra = self.extra.iter().map(|&node| &taylor.displacement[node]);
        let signals = taylor.u.iter().chain(extra);
        for (out, series) in out.chunks_exact_mut(degree + 1).zip(signals) {
            out.copy_from_slice(&series[..=degree]);
        }
        let bending = self.laws.iter().zip(&taylor.laws);
        let ways = bending
            .filter(|(law, _)| law.has_variable_ratio())
            .map(|(_, series)| series.relative_travel(degree) / BEYOND);
        // Speeds are known to one order less.
        let loads = self.loads.iter().zip(&taylor.loads);
        let shares = loads.map(|(load, series)| {
            let speed = &taylor.speed[load.node];
            let share = series.as_ref().map(|own| own.reliable(speed, degree - 1));
            1.0 / share.unwrap_or(1.0)
        });
        let written = self.loads.iter().zip(&taylor.written);
        let written = written.filter_map(|(load, series)| {
            let (own, (_, force)) = (load.written.as_ref()?, series.as_ref()?);
            Some(1.0 / self.reliable(own, force, start, degree - 2, taylor))
        });
        ways.chain(shares)
            .chain(written)
            .chain([taylor.excess / BEYOND])
            .fold(
                0.0,
                |greatest: f64, one| {
                    if one.is_nan() { one } else { greatest.max(one) }
                },
            )
    }

    /// Loads and reactions of an order.
    fn forces_of(&self, start: &Start<'_>, order: usize, work: &Work<f64>, taylor: &mut Taylor) {
        for (force, &constant) in taylor.force.iter_mut().zip(&self.constant_force) {
            force[order] = if order == 0 { constant } else { 0.0 };
        }
        if order == 0 {
            for (mode, stop) in taylor.stop_modes.iter_mut().zip(&self.stops) {
                *mode = start.modes[stop.component];
            }
        }
        for (index, load) in self.loads.iter().enumerate() {
            let force = if let Some(written) = &load.written {
                self.expression_coefficient(index, written, start, order, taylor)
            } else if order == 0 {
                if let Some(series) = &mut taylor.loads[index] {
                    let node = load.node;
                    series.begin(taylor.displacement[node][0], taylor.speed[node][0]);
                }
                self.load(index, start.time, start.modes, work)
            } else if let Some(stop) = load.stop {
                self.stop_of_order(&self.stops[stop], start.modes, order, taylor)
            } else {
                let [displacement, speed] =
                    [&taylor.displacement[load.node], &taylor.speed[load.node]];
                match (&load.law, &mut taylor.loads[index]) {
                    (LoadLaw::Linear(own), _) => {
                        -own.rate * displacement[order] - own.damping * speed[order]
                    }
                    (LoadLaw::Function { factor, .. }, Some(series)) => {
                        factor * series.advance(order, displacement, speed)
                    }
                    (LoadLaw::Pieces { .. }, _) => load.argument.as_ref().map_or(0.0, |axis| {
                        let time = if order == 1 { taylor.length } else { 0.0 };
                        let place = axis
                            .node
                            .map_or(time, |node| taylor.displacement[node][order]);
                        place * load.slope(start.modes[axis.component])
                    }),
                    // (Systems with such a function are not expanded; the others are above.)
                    (LoadLaw::Function { .. }, None)
                    | (LoadLaw::Written(_) | LoadLaw::Stop(_) | LoadLaw::Dry { .. }, _) => 0.0,
                }
            };
            taylor.force[load.node][order] += force;
        }
        for (index, chain) in self.chains.iter().enumerate() {
            if order == 0 {
                taylor.modes[index] = self.pair_mode(chain, start.modes);
            }
            let reaction = self.reaction_of(chain, start.modes, order, taylor);
            taylor.reaction[index][order] = reaction;
            let first = &taylor.laws[chain.law].first;
            taylor.force[self.laws[chain.law].driver][order] +=
                product(&taylor.reaction[index], first, order);
        }
    }

    /// F of a chain's link 1 at an order.
    fn reaction_of(&self, chain: &Chain, modes: &[i64], order: usize, taylor: &Taylor) -> f64 {
        let first = chain.first_coordinate;
        let (c, b) = (self.stiffness[first], self.damping[first]);
        let (x, v) = (&taylor.u[first], &taylor.v[first]);
        let contact = &chain.contact;
        let mode = self.pair_mode(chain, modes);
        if contact.closure == Closure::Bilateral {
            return c * x[order] + b * v[order];
        }
        if mode == OPEN || contact.restitution().is_some() {
            return 0.0;
        }
        let side = mode as f64;
        let clearance = if order == 0 { contact.half_gap } else { 0.0 };
        let Some(kappa) = contact.kappa else {
            return c * (x[order] - side * clearance) + b * v[order];
        };
        // c·p·(1 + κ·ṗ), p = side·x − η/2.
        let depth = side * x[order] - clearance;
        let crossed = product(x, v, order) - side * contact.half_gap * v[order];
        side * c * (depth + kappa * crossed)
    }

    /// Force of a stop on its mass at an order ≥ 1.
    fn stop_of_order(
        &self,
        stop: &FrozenStop,
        modes: &[i64],
        order: usize,
        taylor: &Taylor,
    ) -> f64 {
        let mode = modes[stop.component];
        if mode == OPEN || stop.contact.restitution().is_some() {
            return 0.0;
        }
        let (x, v) = (&taylor.displacement[stop.node], &taylor.speed[stop.node]);
        let (c, (b, kappa)) = (stop.contact.stiffness(), stop.contact.losses());
        let Some(kappa) = kappa else {
            return -(c * x[order] + b * v[order]);
        };
        // c·x·(1 + κ·s·v), x = φ − at.
        let crossed = product(x, v, order) - stop.at * v[order];
        -c * (x[order] + mode as f64 * kappa * crossed)
    }

    /// Rigid nodes hand inertia and forces of an order to their drivers.
    fn hand_to_drivers(&self, order: usize, taylor: &mut Taylor) {
        if self.rigids.is_empty() && self.constraints.is_empty() && !self.impacts {
            return;
        }
        for (mass, &inertia) in taylor.mass.iter_mut().zip(&self.inertia) {
            mass[order] = if order == 0 { inertia } else { 0.0 };
        }
        if self.constraints.is_empty() && !self.impacts {
            for rigid in self.rigids.iter().rev() {
                self.reduce_rigid_of(rigid, order, taylor);
            }
            return;
        }
        for step in self.steps.iter().rev() {
            match *step {
                Step::Rigid(index) => self.reduce_rigid_of(&self.rigids[index], order, taylor),
                Step::Chain(index) => {
                    let chain = &self.chains[index];
                    if chain.contact.contact_holds(taylor.modes[index]) {
                        let (node, law) = (chain.first_node, chain.law);
                        self.reduce_rigid_of(&Rigid { node, law }, order, taylor);
                    }
                }
                Step::Constrained(index) => {
                    let own = &self.constraints[index];
                    let force = taylor.force[own.node][order];
                    for (driver, ratio) in own.terms() {
                        taylor.force[driver][order] += ratio * force;
                    }
                }
                _ => {}
            }
        }
    }

    fn reduce_rigid_of(&self, rigid: &Rigid, order: usize, taylor: &mut Taylor) {
        let driver = self.laws[rigid.law].driver;
        let law = rigid.law;
        let speed = &taylor.speed[driver];
        taylor.square[law][order] = product(speed, speed, order);
        let series = &taylor.laws[law];
        let mass = &taylor.mass[rigid.node];
        taylor.bias[law][order] = product(&series.second, &taylor.square[law], order);
        // U′·M and F − M·bias, then both times U′ to the driver.
        taylor.slope[law][order] = product(&series.first, mass, order);
        let carried = product(mass, &taylor.bias[law], order);
        taylor.rest[law][order] = taylor.force[rigid.node][order] - carried;
        let inertia = product(&series.first, &taylor.slope[law], order);
        let force = product(&series.first, &taylor.rest[law], order);
        taylor.mass[driver][order] += inertia;
        taylor.force[driver][order] += force;
    }
}
