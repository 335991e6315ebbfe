//! Samples at equal intervals.

use super::basis::Basis;
use super::lanes::{Arith, V, WIDTH, exp, reduced, sin_cos};
use super::phase::{Exponentials, POLY, Phase, scalar_sin_cos};
use super::problem::TreeProblem;
use super::request::Request;

/// Takes the samples that fall into each phase.
#[derive(Clone, Debug)]
pub(crate) struct Sampler {
    next: usize,
    count: usize,
    end: f64,
    all: bool,
    e: Exponentials,
    q: Vec<f64>,
    v: Vec<f64>,
}

impl Sampler {
    pub(crate) fn new(problem: &TreeProblem, request: &Request, blocks: usize) -> Self {
        let n = problem.masses.len();
        Self {
            next: 1,
            count: request.samples,
            end: request.end,
            all: request.all_masses,
            e: Exponentials::new(blocks),
            q: vec![0.0; n],
            v: vec![0.0; n],
        }
    }

    fn time(&self, k: usize) -> f64 {
        if k == self.count {
            self.end
        } else {
            self.end * (k as f64 / self.count as f64)
        }
    }

    /// Appends the samples in (start, start + s].
    #[inline(always)]
    pub(crate) fn phase<A: Arith>(
        &mut self,
        basis: &Basis,
        phase: &Phase,
        s: f64,
        out: &mut Vec<f64>,
    ) {
        while self.next <= self.count && phase.local(self.time(self.next)) <= s {
            let left = self.count + 1 - self.next;
            if !self.all && left >= WIDTH && phase.local(self.time(self.next + WIDTH - 1)) <= s {
                let times = V([0, 1, 2, 3].map(|k| phase.local(self.time(self.next + k))));
                out.extend_from_slice(&last_mass::<A>(basis, phase, times).0);
                self.next += WIDTH;
                continue;
            }
            let local = phase.local(self.time(self.next));
            phase.exponentials::<A>(basis, local, &mut self.e);
            phase.state::<A>(basis, &self.e, &mut self.q, &mut self.v);
            if self.all {
                out.extend_from_slice(&self.q);
                out.extend_from_slice(&self.v);
            } else {
                out.push(self.q[self.q.len() - 1]);
            }
            self.next += 1;
        }
    }
}

/// q of the last mass at four times.
#[inline(always)]
fn last_mass<A: Arith>(basis: &Basis, phase: &Phase, s: V) -> V {
    let (i, blocks) = (basis.masses - 1, basis.blocks);
    let c = &phase.poly[i * POLY..(i + 1) * POLY];
    let mut sum = V::splat(c[phase.degree]);
    for k in (0..phase.degree).rev() {
        sum = sum.fma::<A>(s, V::splat(c[k]));
    }
    for k in 0..basis.lanes.len() {
        let (b, l) = (k / WIDTH, k % WIDTH);
        let at = i * blocks + b;
        let (wr, wi) = (basis.shape[0][at].0[l], basis.shape[1][at].0[l]);
        let (zr, zi) = (phase.re[b].0[l], phase.im[b].0[l]);
        let (cr, ci) = (wr * zr - wi * zi, wr * zi + wi * zr);
        let decay = basis.re[b].0[l] * s.0[0];
        // e^-45 = 3e-20: gone.
        if decay < -45.0 {
            continue;
        }
        let size = if basis.re[b].0[l] == 0.0 {
            V::splat(1.0)
        } else {
            exp::<A>(s * V::splat(basis.re[b].0[l]))
        };
        let (sin, cos) = sin_cos::<A>(s * V::splat(basis.im[b].0[l]));
        sum = size.fma::<A>(cos * V::splat(cr) - sin * V::splat(ci), sum);
    }
    for flight in &phase.flights {
        let shape = basis.rigid[flight.rigid].shape[i];
        let a = flight.amplitude;
        sum = sum
            + s.map(|s| {
                let x = flight.omega * s;
                let (sin, cos) = scalar_sin_cos::<A>(x);
                let (c, l) = reduced::<A>(x, sin, cos);
                shape * (a.re * c - a.im * l)
            });
    }
    sum
}
