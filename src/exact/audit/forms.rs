//! Work and dissipation over a phase of one combination of engaged pairs.

use super::form::Form;
use super::varying;
use crate::exact::basis::{Basis, Lane, LaneKind};
use crate::exact::pencil::C;
use crate::exact::phase::{POLY, Phase};
use crate::exact::problem::{PairState, TreeProblem};

/// Work and dissipation over a phase (J).
#[derive(Clone, Copy, Debug, Default)]
pub(super) struct Work {
    pub(super) drives: f64,
    /// Of loads that change, and of dampers to the ground.
    pub(super) loads: f64,
    pub(super) dissipated: f64,
}

/// A link through which the law does work, with what its moment is.
#[derive(Clone, Copy, Debug)]
pub(super) struct LawLink {
    pub(super) mass: usize,
    /// Speed of the place it starts from, for L̇ = 1, in its own deformation.
    pub(super) ratio: f64,
    /// Deformation at which it is relaxed, sign turned.
    pub(super) relaxed: f64,
}

/// A damper: b, the mass and its parent with the lever between (a link), or
/// the mass and what it moves with the law (to the ground).
#[derive(Clone, Copy, Debug)]
pub(super) struct Damper {
    pub(super) rate: f64,
    pub(super) mass: usize,
    parent: Option<(usize, f64)>,
    pub(super) ratio: f64,
}

/// The integrals of a regime.
#[derive(Clone, Debug)]
pub(in crate::exact) struct Forms {
    /// Lane and Ω of each harmonic.
    pub(in crate::exact) harmonic: Vec<(usize, f64)>,
    pub(super) links: Form,
    pub(super) ground: Option<Form>,
    pub(super) drive: Form,
    pub(super) driven: Vec<LawLink>,
    /// Engaged links that are damped, then dampers to the ground from `grounded` on.
    pub(super) dampers: Vec<Damper>,
    pub(super) grounded: usize,
    /// Moment of the driven links times their ratio, by lane.
    pub(super) moment: Vec<C>,
    /// Nothing but lanes and constants: no polynomial moves a damper or the law.
    pub(super) plain: bool,
}

impl Damper {
    /// Speed per amplitude of a lane.
    pub(super) fn speed(&self, lane: &Lane) -> C {
        let mut shape = lane.shape[self.mass];
        if let Some((p, lever)) = self.parent {
            shape -= lane.shape[p] * lever;
        }
        if let LaneKind::Harmonic(_) = lane.kind {
            shape += self.ratio;
        }
        shape * lane.lambda
    }

    /// The speed's polynomial part.
    pub(super) fn polynomial(&self, phase: &Phase) -> [f64; POLY] {
        let mut out = [0.0; POLY];
        let place = |i: usize, k: usize| phase.poly[i * POLY + k];
        for k in 1..=phase.degree.max(phase.forcing.degree) {
            let mut sum = 0.0;
            if k <= phase.degree {
                sum += place(self.mass, k);
                if let Some((p, lever)) = self.parent {
                    sum -= lever * place(p, k);
                }
            }
            if k <= phase.forcing.degree {
                sum += self.ratio * phase.forcing.law[k];
            }
            out[k - 1] = k as f64 * sum;
        }
        out
    }
}

impl Forms {
    pub(in crate::exact) fn new(
        problem: &TreeProblem,
        key: &[PairState],
        basis: &Basis,
        steady: bool,
    ) -> Self {
        let (mut dampers, mut driven) = (Vec::new(), Vec::new());
        for (i, mass) in problem.masses.iter().enumerate() {
            let (flanks, count) = mass.pair.flanks();
            let relaxed = match key[i] {
                _ if count == 0 => 0.0,
                PairState::Engaged(f) => {
                    let flank = flanks[usize::from(f)];
                    flank.sign * flank.offset
                }
                _ => continue,
            };
            let parent = mass.parent.map(|p| (p, mass.lever));
            if mass.damping != 0.0 {
                dampers.push(Damper {
                    rate: mass.damping,
                    mass: i,
                    parent,
                    ratio: 0.0,
                });
            }
            let base = parent.map_or(0.0, |(p, lever)| lever * problem.masses[p].ratio);
            let ratio = mass.ratio - base;
            if ratio != 0.0 {
                driven.push(LawLink {
                    mass: i,
                    ratio,
                    relaxed,
                });
            }
        }
        let grounded = dampers.len();
        for (i, mass) in problem.masses.iter().enumerate() {
            if mass.ground_damping != 0.0 {
                dampers.push(Damper {
                    rate: mass.ground_damping,
                    mass: i,
                    parent: None,
                    ratio: mass.ratio,
                });
            }
        }
        let moment = |lane: &Lane| {
            let one = |d: &LawLink| {
                let mass = &problem.masses[d.mass];
                let base = mass
                    .parent
                    .map_or(C::default(), |p| lane.shape[p] * mass.lever);
                let factor = lane.lambda * mass.damping + mass.stiffness;
                factor * (lane.shape[d.mass] - base) * d.ratio
            };
            driven.iter().map(one).sum::<C>()
        };
        let moment: Vec<C> = basis.lanes.iter().map(moment).collect();
        let lanes = (&basis.lanes[..], basis.blocks);
        let lane = |&k: &usize| (k, basis.lanes[k].lambda.im);
        let harmonic: Vec<(usize, f64)> = basis.harmonic.iter().map(lane).collect();
        let drive = Form::new(lanes, (basis.harmonic.clone(), false), |j, k, conjugate| {
            let own = -basis.lanes[j].lambda;
            own * conjugate_if(moment[k], conjugate)
        });
        let plain = steady && dampers.len() == grounded && !problem.masses.iter().any(varying);
        Self {
            harmonic,
            links: quadratic(basis, &dampers[..grounded]),
            ground: (grounded < dampers.len()).then(|| quadratic(basis, &dampers[grounded..])),
            drive,
            driven,
            dampers,
            grounded,
            moment,
            plain,
        }
    }

    /// The driven links' moment times their ratio: its polynomial part.
    pub(super) fn constant(&self, problem: &TreeProblem, phase: &Phase) -> [f64; POLY] {
        let mut out = [0.0; POLY];
        for d in &self.driven {
            let mass = &problem.masses[d.mass];
            let x = |k: usize| {
                let base = mass
                    .parent
                    .map_or(0.0, |p| mass.lever * phase.poly[p * POLY + k]);
                phase.poly[d.mass * POLY + k] - base
            };
            for k in 0..=phase.degree {
                out[k] += d.ratio * mass.stiffness * x(k);
                if k > 0 {
                    out[k - 1] += d.ratio * mass.damping * k as f64 * x(k);
                }
            }
            out[0] += d.ratio * mass.stiffness * d.relaxed;
        }
        out
    }
}

fn conjugate_if(c: C, conjugate: bool) -> C {
    if conjugate { c.conj() } else { c }
}

/// Σ b·(speed)² of dampers.
fn quadratic(basis: &Basis, dampers: &[Damper]) -> Form {
    let speeds: Vec<Vec<C>> = basis
        .lanes
        .iter()
        .map(|lane| dampers.iter().map(|d| d.speed(lane)).collect())
        .collect();
    let rows = if dampers.is_empty() {
        Vec::new()
    } else {
        (0..basis.lanes.len()).collect()
    };
    let lanes = (&basis.lanes[..], basis.blocks);
    Form::new(lanes, (rows, true), |j, k, conjugate| {
        let pairs = dampers.iter().zip(&speeds[j]).zip(&speeds[k]);
        pairs
            .map(|((d, a), b)| a * conjugate_if(*b, conjugate) * d.rate)
            .sum()
    })
}
