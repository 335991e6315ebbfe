//! What polynomials (laws in spans, loads that change, drifts) add to work and
//! dissipation over a phase.

use super::form::PhaseEnds;
use super::forms::{Forms, Work};
use super::moments::{moments, polynomial_moment, product};
use super::varying;
use crate::exact::basis::{Basis, LaneKind};
use crate::exact::lanes::{Arith, Task, WIDTH};
use crate::exact::law::LAW_DEGREE;
use crate::exact::pencil::C;
use crate::exact::phase::{Exponentials, POLY, Phase};
use crate::exact::problem::TreeProblem;

/// Contribution of polynomials over a phase of length h.
pub(super) struct PolynomialPart<'a> {
    pub(super) forms: &'a Forms,
    pub(super) problem: &'a TreeProblem,
    pub(super) basis: &'a Basis,
    pub(super) phase: &'a Phase,
    pub(super) room: &'a mut Room,
    pub(super) h: f64,
}

/// Working memory: polynomials of the present phase.
#[derive(Clone, Debug, Default)]
pub(super) struct Room {
    /// The lanes at its ends.
    pub(super) ends: Vec<PhaseEnds>,
    /// Speed of every damper.
    speeds: Vec<[f64; POLY]>,
    /// Loads that change, with their masses.
    forces: Vec<(usize, [f64; POLY])>,
}

impl Task for PolynomialPart<'_> {
    type Output = Work;

    #[inline(always)]
    fn run<A: Arith>(mut self) -> Work {
        let Self {
            forms, phase, h, ..
        } = self;
        let mut law = [0.0; POLY];
        for k in 1..=phase.forcing.degree {
            law[k - 1] = k as f64 * phase.forcing.law[k];
        }
        let constant = forms.constant(self.problem, phase);
        let mut work = Work {
            drives: -product(&constant, &law, h),
            ..Work::default()
        };
        self.room.speeds.clear();
        for (number, damper) in forms.dampers.iter().enumerate() {
            let own = damper.polynomial(phase);
            self.room.speeds.push(own);
            let lost = damper.rate * product(&own, &own, h);
            if number < forms.grounded {
                work.dissipated += lost;
            } else {
                work.loads -= lost;
            }
        }
        self.loads(&law, &mut work);
        let mut at = [C::default(); POLY];
        for k in 0..self.basis.lanes.len() {
            self.contribution_of_lane(k, (&law, &constant), &mut at, &mut work);
        }
        work
    }
}

impl PolynomialPart<'_> {
    /// Loads that change over the phase, and their work on its polynomials.
    fn loads(&mut self, law: &[f64; POLY], work: &mut Work) {
        let (phase, h) = (self.phase, self.h);
        self.room.forces.clear();
        let mut held = phase.held.iter();
        for (i, mass) in self.problem.masses.iter().enumerate() {
            let own = mass.loads.iter().zip(&mut held);
            if !varying(mass) {
                own.for_each(drop);
                continue;
            }
            let mut force = [0.0; POLY];
            for (load, held) in own {
                let mut held = *held;
                load.add(phase.start, phase.low, &mut held, &mut force[..=LAW_DEGREE]);
            }
            let mut speed = law.map(|c| c * mass.ratio);
            for k in 1..=phase.degree {
                speed[k - 1] += k as f64 * phase.poly[i * POLY + k];
            }
            // The constant part of a flight's speed: Re(−iΩ·amplitude).
            for flight in &phase.flights {
                let shape = self.basis.rigid[flight.rigid].shape[i];
                speed[0] += shape * flight.omega * flight.amplitude.im;
            }
            work.loads += product(&force, &speed, h);
            self.room.forces.push((i, force));
        }
    }

    /// Common contribution of lane k and the polynomials.
    fn contribution_of_lane(
        &self,
        k: usize,
        (law, constant): (&[f64; POLY], &[f64; POLY]),
        at: &mut [C; POLY],
        work: &mut Work,
    ) {
        let (forms, phase, h) = (self.forms, self.phase, self.h);
        let lane = &self.basis.lanes[k];
        let z = C::new(
            phase.re[k / WIDTH].0[k % WIDTH],
            phase.im[k / WIDTH].0[k % WIDTH],
        );
        if z.norm_sqr() == 0.0 {
            return;
        }
        moments(lane.lambda * h, at);
        work.drives -= (z * forms.moment[k] * polynomial_moment(law, at, h)).re;
        if let LaneKind::Harmonic(_) = lane.kind {
            work.drives -= (z * lane.lambda * polynomial_moment(constant, at, h)).re;
        }
        let dampers = forms.dampers.iter().zip(&self.room.speeds);
        for (number, (damper, own)) in dampers.enumerate() {
            let both = (z * damper.speed(lane) * polynomial_moment(own, at, h)).re;
            let lost = 2.0 * damper.rate * both;
            if number < forms.grounded {
                work.dissipated += lost;
            } else {
                work.loads -= lost;
            }
        }
        for (i, force) in &self.room.forces {
            let integral = polynomial_moment(force, at, h);
            let mut shape = lane.shape[*i];
            if let LaneKind::Harmonic(_) = lane.kind {
                shape += self.problem.masses[*i].ratio;
            }
            work.loads += (z * lane.lambda * shape * integral).re;
            if let LaneKind::Harmonic(j) = lane.kind {
                for flight in phase.flights.iter().filter(|f| f.harmonic == j) {
                    let shape = self.basis.rigid[flight.rigid].shape[*i];
                    let speed = flight.amplitude * lane.lambda * shape;
                    work.loads += (speed * integral).re;
                }
            }
        }
    }
}

impl Forms {
    /// Over the phase, from its start to the instant of `e`.
    #[inline(always)]
    pub(super) fn work_over_phase<A: Arith>(
        &self,
        problem: &TreeProblem,
        basis: &Basis,
        phase: &Phase,
        e: &Exponentials,
        room: &mut Room,
    ) -> Work {
        PhaseEnds::collect_until::<A>(phase, e, basis.blocks, &mut room.ends);
        let ends = &room.ends;
        let mut work = Work {
            drives: self.drive.integral_over_phase::<A>(ends, phase, e),
            loads: 0.0,
            dissipated: self.links.integral_over_phase::<A>(ends, phase, e),
        };
        if let Some(ground) = &self.ground {
            work.loads -= ground.integral_over_phase::<A>(ends, phase, e);
        }
        if self.plain && phase.forcing.degree == 0 {
            // The moment's constant part moves with the harmonics alone.
            let mut constant = 0.0;
            for d in &self.driven {
                let mass = &problem.masses[d.mass];
                let base = mass
                    .parent
                    .map_or(0.0, |p| mass.lever * phase.poly[p * POLY]);
                let x = phase.poly[d.mass * POLY] - base + d.relaxed;
                constant += d.ratio * mass.stiffness * x;
            }
            for (z, &(k, _)) in phase.forcing.harmonics.iter().zip(&self.harmonic) {
                let (re, im) = (e.re[k / WIDTH].0[k % WIDTH], e.im[k / WIDTH].0[k % WIDTH]);
                work.drives -= constant * (z.re * (re - 1.0) - z.im * im);
            }
            return work;
        }
        let more = A::run_out_of_line(PolynomialPart {
            forms: self,
            problem,
            basis,
            phase,
            room,
            h: e.s,
        });
        Work {
            drives: work.drives + more.drives,
            loads: work.loads + more.loads,
            dissipated: work.dissipated + more.dissipated,
        }
    }
}
