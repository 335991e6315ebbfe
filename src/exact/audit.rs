//! The energy audit of a run: does what went in equal what is there and what
//! was lost?
//!
//! Work and dissipation are integrals of products of two sums of lanes and
//! polynomials, and as such known in closed form over every phase
//! ([`form`], [`moments`]); nothing is sampled. A pair stores c·X²/2, X < 0 the
//! clearance to its flank, engaged or open. It loses b·Ẋ² while engaged, and
//! while open behind its flank what it stores, −c·X·Ẋ.

mod form;
mod forms;
mod moments;
mod moving;

pub(super) use forms::Forms;

use super::lanes::Arith;
use super::law::LAW_DEGREE;
use super::phase::{Exponentials, Phase};
use super::problem::{Flank, PairState, TimeLoad, TreeMass, TreeProblem};
use super::regime::Regime;
use crate::dynamics::energy::EnergyAudit;
use crate::dynamics::integrate::Impact;
use moving::Room;

/// The state at one instant, the law included.
#[derive(Clone, Copy, Debug)]
pub(super) struct Instant<'a> {
    pub(super) q: &'a [f64],
    pub(super) v: &'a [f64],
    /// L and L̇.
    pub(super) law: (f64, f64),
}

/// Store of energy: a mass, and the link that holds it.
#[derive(Clone, Copy, Debug)]
struct Store {
    inertia: f64,
    ratio: f64,
    stiffness: f64,
    /// The mass that the link stands on, with the lever between.
    parent: usize,
    lever: f64,
    flanks: [Flank; 2],
    count: usize,
}

/// Collects the energies phase by phase.
#[derive(Clone, Debug)]
pub(super) struct Ledger {
    stores: Vec<Store>,
    drives: f64,
    loads: f64,
    dissipated: f64,
    put_in: [f64; 2],
    /// Kinetic and elastic energy, and work of constant loads and springs up to
    /// a place, at t = 0.
    start: Option<([f64; 2], f64)>,
    greatest: [f64; 2],
    /// Energy lost in impacts.
    impacts: f64,
    /// Energy stored in open pairs at the start of the phase.
    held: f64,
    /// Kinetic and potential energy at the start of a phase in which a rigid pair holds.
    carried: Option<f64>,
    /// L and L̇ at the end of the last phase.
    law: (f64, f64),
    room: Room,
}

/// True when a mass has a load that changes.
pub(super) fn varying(mass: &TreeMass) -> bool {
    !mass
        .loads
        .iter()
        .all(|load| matches!(load, TimeLoad::Constant(_)))
}

/// L and L̇ in the phase at the instant of `e`.
#[inline(always)]
pub(super) fn law_at(phase: &Phase, harmonic: &[(usize, f64)], e: &Exponentials) -> (f64, f64) {
    let forcing = &phase.forcing;
    let (mut value, mut speed) = (0.0, 0.0);
    for c in forcing.law[..=forcing.degree].iter().rev() {
        speed = speed * e.s + value;
        value = value * e.s + c;
    }
    for (z, &(lane, omega)) in forcing.harmonics.iter().zip(harmonic) {
        let (b, i) = (lane / super::lanes::WIDTH, lane % super::lanes::WIDTH);
        let (re, im) = (e.re[b].0[i], e.im[b].0[i]);
        value += z.re * re - z.im * im;
        speed -= omega * (z.re * im + z.im * re);
    }
    (value, speed)
}

impl Ledger {
    pub(super) fn new(problem: &TreeProblem) -> Self {
        Self {
            stores: problem.masses.iter().map(Store::new).collect(),
            drives: 0.0,
            loads: 0.0,
            dissipated: 0.0,
            put_in: [0.0; 2],
            start: None,
            greatest: [0.0; 2],
            impacts: 0.0,
            held: 0.0,
            carried: None,
            law: (0.0, 0.0),
            room: Room::default(),
        }
    }

    /// The start of a phase in the states `key`, with the displacements `q`;
    /// `first` gives the state at the start of the run.
    #[inline(always)]
    pub(super) fn begin<'a>(
        &mut self,
        problem: &TreeProblem,
        key: &[PairState],
        q: &[f64],
        first: impl FnOnce() -> Instant<'a>,
    ) {
        let holds =
            |(mass, state): (&TreeMass, &PairState)| mass.restitution.is_some() && state.engaged();
        let carried = problem.masses.iter().zip(key).any(holds);
        if self.start.is_none() || carried {
            let at = first();
            self.carried = carried.then(|| total(&self.stores, problem, &at));
            self.start_at(problem, &at);
        } else {
            self.carried = None;
        }
        self.held = stored_energy(&self.stores, key, q);
    }

    fn start_at(&mut self, problem: &TreeProblem, at: &Instant<'_>) {
        if self.start.is_none() {
            self.start = Some((energy(&self.stores, at), potential(problem, at)));
            self.add_instant(at);
        }
    }

    /// An impact, with the work of the law in it.
    pub(super) fn add_impact(&mut self, impact: &Impact) {
        self.drives += impact.drives;
        self.put_in[0] += impact.drives.max(0.0);
        self.impacts += impact.lost;
    }

    #[inline(always)]
    fn add_instant(&mut self, at: &Instant<'_>) {
        let now = energy(&self.stores, at);
        for k in 0..2 {
            self.greatest[k] = now[k].max(self.greatest[k]);
        }
    }

    /// The end of a phase, at the instant of `e`.
    #[inline(always)]
    pub(super) fn end<A: Arith>(
        &mut self,
        problem: &TreeProblem,
        regime: &Regime,
        phase: &Phase,
        e: &Exponentials,
        at: &Instant<'_>,
    ) {
        let Some(forms) = &regime.forms else {
            return;
        };
        let work = forms.work_over_phase::<A>(problem, &regime.basis, phase, e, &mut self.room);
        // What moves as prescribed takes from the law what its energy changes by.
        let carried = self
            .carried
            .map(|before| total(&self.stores, problem, at) - before);
        let drives = work.drives + carried.unwrap_or(0.0);
        self.drives += drives;
        self.loads += work.loads;
        self.dissipated +=
            work.dissipated + self.held - stored_energy(&self.stores, &regime.key, at.q);
        self.law = at.law;
        self.add_instant(at);
        self.put_in[0] += drives.max(0.0);
        self.put_in[1] += work.loads.max(0.0);
    }

    /// The end of the run.
    pub(super) fn final_energies(
        &self,
        problem: &TreeProblem,
        q: &[f64],
        v: &[f64],
    ) -> EnergyAudit {
        let law = self.law;
        let at = &Instant { q, v, law };
        let end = (energy(&self.stores, at), potential(problem, at));
        let (energy, potential) = self.start.unwrap_or(end);
        let fell = potential - end.1;
        let total = |e: [f64; 2]| e[0] + e[1];
        let [law, loads] = self.put_in;
        EnergyAudit {
            drives: self.drives,
            loads: self.loads + fell,
            dissipated: self.dissipated,
            friction: 0.0,
            impacts: self.impacts,
            change: total(end.0) - total(energy),
            put_in: [law, loads.max(loads + fell)],
            greatest: self.greatest,
        }
    }
}

impl Store {
    fn new(mass: &TreeMass) -> Self {
        let (flanks, count) = mass.pair.flanks();
        // A link on the law stands on what is at rest in q.
        let (parent, lever) = mass.parent.map_or((0, 0.0), |p| (p, mass.lever));
        Self {
            inertia: mass.inertia,
            ratio: mass.ratio,
            stiffness: mass.stiffness,
            parent,
            lever,
            flanks,
            count,
        }
    }

    /// Energy stored in the link of mass i, or in its pair.
    #[inline(always)]
    fn stored(&self, i: usize, q: &[f64]) -> f64 {
        let x = q[i] - self.lever * q[self.parent];
        if self.count == 0 {
            return 0.5 * self.stiffness * x * x;
        }
        let mut sum = 0.0;
        for flank in &self.flanks[..self.count] {
            let clear = (flank.sign * x + flank.offset).min(0.0);
            sum += 0.5 * self.stiffness * clear * clear;
        }
        sum
    }
}

/// Kinetic energy, and elastic energy of links and pairs.
#[inline(always)]
fn energy(stores: &[Store], at: &Instant<'_>) -> [f64; 2] {
    let mut out = [0.0; 2];
    for (i, store) in stores.iter().enumerate() {
        let speed = at.v[i] + store.ratio * at.law.1;
        out[0] += 0.5 * store.inertia * speed * speed;
        out[1] += store.stored(i, at.q);
    }
    out
}

/// Kinetic and elastic energy with the potential of constant loads and springs.
fn total(stores: &[Store], problem: &TreeProblem, at: &Instant<'_>) -> f64 {
    let [kinetic, elastic] = energy(stores, at);
    kinetic + elastic + potential(problem, at)
}

/// Energy stored in the open pairs.
#[inline(always)]
fn stored_energy(stores: &[Store], key: &[PairState], q: &[f64]) -> f64 {
    let mut sum = 0.0;
    for (i, store) in stores.iter().enumerate() {
        if store.count > 0 && !key[i].engaged() {
            sum += store.stored(i, q);
        }
    }
    sum
}

/// Potential energy of constant loads and springs to the ground.
fn potential(problem: &TreeProblem, at: &Instant<'_>) -> f64 {
    let mut sum = 0.0;
    for (i, mass) in problem.masses.iter().enumerate() {
        let place = at.q[i] + mass.ratio * at.law.0 + mass.offset;
        sum += 0.5 * mass.ground_stiffness * place * place;
        if !varying(mass) {
            let mut force = [0.0; LAW_DEGREE + 1];
            for load in &mass.loads {
                load.add(0.0, 0.0, &mut None, &mut force);
            }
            sum -= force[0] * place;
        }
    }
    sum
}
