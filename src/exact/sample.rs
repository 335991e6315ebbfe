//! Samples at equal intervals.
//!
//! Over a phase the sample times are equally spaced, and so every lane is a
//! geometric sequence: its powers ρ⁰ … ρ⁷ over one interval stand side by side
//! and ρ⁸ takes all eight to the next ones. The exponentials themselves are
//! evaluated once a phase, at its first sample.

use super::basis::Basis;
use super::lanes::{Arith, V, WIDTH, cosine_and_sine_remainders, exp, sin_cos};
use super::pencil::C;
use super::phase::{Exponentials, POLY, Phase};
use super::problem::TreeProblem;
use super::request::Request;

/// Samples side by side.
const STRIDE: usize = 8;

/// A lane that has shrunk below this share of its start is gone.
const GONE: f64 = 3e-20;

/// Share of an interval within which of a sample it is looked at closely whether
/// the sample lies before the end of a phase.
const NEAR_END: f64 = 1e-6;

/// More samples than this are always looked at closely.
const MANY: usize = 1 << 28;

/// Powers of a lane's ρ = e^{λΔ}, Δ the interval of the samples.
#[derive(Clone, Copy, Debug)]
struct Powers {
    /// ρ⁰ … ρ⁷.
    re: [V; 2],
    im: [V; 2],
    /// ρ⁸.
    next: C,
}

/// The lanes of a basis over the interval of the samples.
#[derive(Clone, Debug)]
pub(crate) struct Strides {
    lanes: Vec<Powers>,
}

impl Strides {
    pub(crate) fn new<A: Arith>(basis: &Basis, interval: f64) -> Self {
        let over = |b: usize, time: f64| {
            let size = exp::<A>(basis.re[b] * V::splat(time));
            let (sin, cos) = sin_cos::<A>(basis.im[b] * V::splat(time));
            (size * cos, size * sin)
        };
        let mut lanes = Vec::with_capacity(basis.lanes.len());
        for b in 0..basis.blocks {
            let (one, eight) = (over(b, interval), over(b, STRIDE as f64 * interval));
            for i in 0..WIDTH.min(basis.lanes.len() - b * WIDTH) {
                lanes.push(Powers::new(
                    C::new(one.0.0[i], one.1.0[i]),
                    C::new(eight.0.0[i], eight.1.0[i]),
                ));
            }
        }
        Self { lanes }
    }
}

impl Powers {
    fn new(one: C, next: C) -> Self {
        let two = one * one;
        let four = two * two;
        let low = [C::new(1.0, 0.0), one, two, two * one];
        let high = low.map(|power| power * four);
        Self {
            re: [V(low.map(|c| c.re)), V(high.map(|c| c.re))],
            im: [V(low.map(|c| c.im)), V(high.map(|c| c.im))],
            next,
        }
    }

    /// Adds Re(c·ρᵏ) to `out`, k = 0 …; its length is a multiple of four.
    #[inline(always)]
    fn add<A: Arith>(&self, c: C, out: &mut [f64]) {
        let f = V::splat;
        let start = |re: V, im: V| {
            (
                re.fma::<A>(f(c.re), -(im * f(c.im))),
                re.fma::<A>(f(c.im), im * f(c.re)),
            )
        };
        let (mut low, mut high) = (start(self.re[0], self.im[0]), start(self.re[1], self.im[1]));
        let (nr, ni) = (f(self.next.re), f(self.next.im));
        let shrink = self.next.norm_sqr();
        let mut size = 1.0;
        for eight in out.chunks_mut(STRIDE) {
            for (four, re) in eight.chunks_exact_mut(WIDTH).zip([low.0, high.0]) {
                for (sum, re) in four.iter_mut().zip(re.0) {
                    *sum += re;
                }
            }
            size *= shrink;
            if size < GONE * GONE {
                return;
            }
            let on = |(re, im): (V, V)| (re.fma::<A>(nr, -(im * ni)), re.fma::<A>(ni, im * nr));
            (low, high) = (on(low), on(high));
        }
    }
}

/// Takes the samples that fall into each phase.
#[derive(Clone, Debug)]
pub(crate) struct Sampler {
    next: usize,
    count: usize,
    end: f64,
    /// Between two samples (s), and its inverse (1/s).
    interval: f64,
    rate: f64,
    all: bool,
    /// Time at which the next sample is due (s).
    due: f64,
    e: Exponentials,
    q: Vec<f64>,
    v: Vec<f64>,
}

impl Sampler {
    pub(crate) fn new(problem: &TreeProblem, request: &Request, blocks: usize) -> Self {
        let room = if request.all_masses && request.samples > 0 {
            problem.masses.len()
        } else {
            0
        };
        let mut sampler = Self {
            next: 1,
            count: request.samples,
            end: request.end,
            interval: request.end / request.samples as f64,
            rate: request.samples as f64 / request.end,
            all: request.all_masses,
            due: f64::INFINITY,
            e: Exponentials::new(blocks, problem.law.frequencies().len()),
            q: vec![0.0; room],
            v: vec![0.0; room],
        };
        sampler.skip_samples(0);
        sampler
    }

    /// The interval of the samples, where their lanes are to be kept.
    pub(crate) fn interval(&self) -> Option<f64> {
        (self.count > 0 && !self.all).then_some(self.interval)
    }

    fn time(&self, k: usize) -> f64 {
        if k == self.count {
            self.end
        } else {
            self.end * (k as f64 / self.count as f64)
        }
    }

    #[inline(always)]
    fn skip_samples(&mut self, by: usize) {
        self.next += by;
        self.due = if self.next <= self.count {
            self.time(self.next)
        } else {
            f64::INFINITY
        };
    }

    /// Appends the samples in (start, start + s].
    #[inline(always)]
    pub(crate) fn phase<A: Arith>(
        &mut self,
        basis: &Basis,
        strides: Option<&Strides>,
        phase: &Phase,
        s: f64,
        out: &mut Vec<f64>,
    ) {
        let first = phase.local(self.due);
        if first > s {
            return;
        }
        phase.exponentials::<A>(basis, first, &mut self.e);
        if let Some(strides) = strides {
            let count = self.count_of_samples(phase, first, s);
            self.last_mass::<A>(basis, strides, phase, count, out);
            self.skip_samples(count);
            return;
        }
        loop {
            phase.state::<A>(basis, &mut self.e, &mut self.q, &mut self.v);
            out.extend_from_slice(&self.q);
            out.extend_from_slice(&self.v);
            self.skip_samples(1);
            let local = phase.local(self.due);
            if local > s {
                return;
            }
            phase.exponentials::<A>(basis, local, &mut self.e);
        }
    }

    /// How many samples lie in [first, s], of which `first` is one.
    #[inline(always)]
    fn count_of_samples(&self, phase: &Phase, first: f64, s: f64) -> usize {
        let left = self.count - self.next + 1;
        let turns = (s - first) * self.rate;
        let mut count = (turns as usize + 1).min(left);
        let part = turns - turns.floor();
        // Rounding is some 10⁻¹⁶ of the number of samples.
        if part > NEAR_END && part < 1.0 - NEAR_END && self.count < MANY {
            return count;
        }
        // The guess may be one off where a sample falls on the end.
        while count < left && phase.local(self.time(self.next + count)) <= s {
            count += 1;
        }
        while count > 1 && phase.local(self.time(self.next + count - 1)) > s {
            count -= 1;
        }
        count
    }

    /// Appends `count` samples of q of the last mass.
    #[inline(always)]
    fn last_mass<A: Arith>(
        &self,
        basis: &Basis,
        strides: &Strides,
        phase: &Phase,
        count: usize,
        out: &mut Vec<f64>,
    ) {
        let (i, blocks) = (basis.masses - 1, basis.blocks);
        let begin = out.len();
        out.resize(begin + count.next_multiple_of(WIDTH), 0.0);
        let room = &mut out[begin..];
        for (k, four) in room.chunks_exact_mut(WIDTH).enumerate() {
            let step = V::splat((k * WIDTH) as f64) + V([0.0, 1.0, 2.0, 3.0]);
            let s = step.fma::<A>(V::splat(self.interval), V::splat(self.e.s));
            four.copy_from_slice(&slow::<A>(basis, phase, i, s).0);
        }
        for (k, powers) in strides.lanes.iter().enumerate() {
            let (b, l) = (k / WIDTH, k % WIDTH);
            if self.e.size[b].0[l] < GONE {
                continue;
            }
            let shape = &basis.shape[i * blocks + b];
            let weight = C::new(shape[0].0[l], shape[1].0[l]);
            let z = C::new(phase.re[b].0[l], phase.im[b].0[l]);
            let c = weight * z * C::new(self.e.re[b].0[l], self.e.im[b].0[l]);
            if c.re != 0.0 || c.im != 0.0 {
                powers.add::<A>(c, room);
            }
        }
        out.truncate(begin + count);
    }
}

/// Polynomial and flights of mass i at four times.
#[inline(always)]
fn slow<A: Arith>(basis: &Basis, phase: &Phase, i: usize, s: V) -> V {
    let c = &phase.poly[i * POLY..(i + 1) * POLY];
    let mut sum = V::splat(c[phase.degree]);
    for k in (0..phase.degree).rev() {
        sum = sum.fma::<A>(s, V::splat(c[k]));
    }
    for flight in &phase.flights {
        let shape = basis.rigid[flight.rigid].shape[i];
        let a = flight.amplitude * shape;
        let x = s * V::splat(flight.omega);
        let (sin, cos) = sin_cos::<A>(x);
        let (c, l) = cosine_and_sine_remainders::<A>(x, sin, cos);
        sum = V::splat(a.re).fma::<A>(c, sum) - V::splat(a.im) * l;
    }
    sum
}
