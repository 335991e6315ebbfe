//! A linear functional over one phase, with its derivatives: what is watched and bounded.

use super::basis::Basis;
use super::functional::{Functional, ORDERS, Weights};
use super::lanes::{Arith, V};
use super::pencil::C;
use super::phase::{Exponentials, POLY, Phase, Swing};

/// Rigid flight in a signal: Re(α·E₂(iΩs) + β·E₁(iΩs)), E_k the exponential
/// without its first k Taylor terms.
#[derive(Clone, Copy, Debug)]
struct Arc {
    harmonic: usize,
    omega: f64,
    alpha: C,
    beta: C,
}

/// A functional over the present phase.
#[derive(Clone, Debug)]
pub(crate) struct Signal {
    /// Amplitude of each lane in g and its derivatives: `[order][re/im][block]`.
    c: Vec<V>,
    /// |amplitude| in g at the start.
    size: Vec<V>,
    poly: [f64; POLY],
    degree: usize,
    arcs: Vec<Arc>,
    /// Bound on |fifth derivative| of the polynomial and the arcs.
    slow5: f64,
    /// Rounding of g: what cannot be told from zero.
    pub(crate) noise: f64,
    /// g and its next derivatives known to be zero at the start.
    pub(crate) zeros: usize,
    /// Started at zero and has not yet been seen clearly positive.
    pub(crate) leaving: bool,
}

/// Value and derivatives, with the lanes' own contributions left in the scratch.
#[derive(Clone, Debug, Default)]
pub(crate) struct Terms {
    /// Lane contributions to g and its derivatives, and |amplitude| now:
    /// `[ORDERS + 1][block]`.
    pub(crate) lane: Vec<V>,
    /// Polynomial and arcs.
    pub(crate) slow: [f64; ORDERS],
}

impl Terms {
    /// g and its derivatives with all lanes followed, and a bound on the next
    /// one, of which `slow5` belongs to the polynomial and the arcs.
    #[inline(always)]
    pub(crate) fn jet(&self, basis: &Basis, active: usize, slow5: f64) -> ([f64; ORDERS], f64) {
        let blocks = basis.blocks;
        let mut sums = [V::ZERO; ORDERS];
        let mut r = V::ZERO;
        for b in 0..active {
            for (order, sum) in sums.iter_mut().enumerate() {
                *sum = *sum + self.lane[order * blocks + b];
            }
            r = r + self.lane[ORDERS * blocks + b] * basis.fifth[b];
        }
        let mut a = self.slow;
        for (value, sum) in a.iter_mut().zip(sums) {
            *value += sum.sum();
        }
        (a, slow5 + r.sum())
    }
}

impl Signal {
    pub(crate) fn new(blocks: usize, flights: usize) -> Self {
        Self {
            c: vec![V::ZERO; 2 * ORDERS * blocks],
            size: vec![V::ZERO; blocks],
            poly: [0.0; POLY],
            degree: 0,
            arcs: Vec::with_capacity(flights),
            slow5: 0.0,
            noise: 0.0,
            zeros: 0,
            leaving: false,
        }
    }

    /// Takes up `functional` over `phase`; `sign` ±1 turns it round.
    #[inline(always)]
    pub(crate) fn take<A: Arith>(
        &mut self,
        basis: &Basis,
        phase: &Phase,
        functional: &Functional,
        weights: &Weights,
        sign: f64,
    ) {
        let blocks = basis.blocks;
        let turn = V::splat(sign);
        let mut total = V::ZERO;
        for b in 0..blocks {
            let (zr, zi) = (phase.re[b] * turn, phase.im[b] * turn);
            for order in 0..ORDERS {
                let at = 2 * order * blocks + b;
                let (wr, wi) = (weights.w[at], weights.w[at + blocks]);
                self.c[at] = wr.fma::<A>(zr, -(wi * zi));
                self.c[at + blocks] = wr.fma::<A>(zi, wi * zr);
            }
            let (cr, ci) = (self.c[b], self.c[b + blocks]);
            self.size[b] = cr.fma::<A>(cr, ci * ci).map(f64::sqrt);
            total = total + self.size[b];
        }
        self.take_slow::<A>(phase, functional, weights, sign, total.sum());
    }

    #[inline(always)]
    fn take_slow<A: Arith>(
        &mut self,
        phase: &Phase,
        functional: &Functional,
        weights: &Weights,
        sign: f64,
        total: f64,
    ) {
        self.degree = functional.polynomial(phase, &mut self.poly);
        let mut scale = total + functional.constant.abs() + self.poly[0].abs();
        for &(i, abc) in &functional.terms {
            scale += (abc[0] * phase.poly[i * POLY]).abs();
        }
        if sign != 1.0 {
            for c in &mut self.poly[..=self.degree] {
                *c *= sign;
            }
        }
        self.slow5 = if self.degree > 4 {
            self.fifth(phase.reach)
        } else {
            0.0
        };
        self.arcs.clear();
        for flight in &phase.flights {
            let [x, y, _] = weights.rigid[flight.rigid];
            let drive = C::new(0.0, flight.omega);
            let alpha = flight.amplitude * (sign * x);
            let mut beta = flight.amplitude * drive * (sign * y);
            if functional.folds() {
                self.poly[0] -= beta.re;
                beta = C::default();
            }
            let square = flight.omega * flight.omega;
            // Orders ≥ 2 see the two together, as (α + β)e^{iΩs}.
            self.slow5 += (alpha + beta).norm_sqr().sqrt() * square * square * flight.omega;
            self.arcs.push(Arc {
                harmonic: flight.harmonic,
                omega: flight.omega,
                alpha,
                beta,
            });
        }
        self.noise = 4.0 * f64::EPSILON * scale;
        self.zeros = 0;
        self.leaving = false;
    }

    /// Bound on the fifth derivative of the polynomial over the phase.
    #[inline(never)]
    fn fifth(&self, reach: f64) -> f64 {
        let mut sum = 0.0;
        for k in (5..=self.degree).rev() {
            let factor = (k * (k - 1) * (k - 2) * (k - 3) * (k - 4)) as f64;
            sum = sum * reach + factor * self.poly[k].abs();
        }
        sum
    }

    /// Evaluates at the instant of `e`.
    #[inline(always)]
    pub(crate) fn terms<A: Arith>(
        &self,
        basis: &Basis,
        active: usize,
        e: &Exponentials,
        out: &mut Terms,
    ) {
        let blocks = basis.blocks;
        for b in 0..active {
            for order in 0..ORDERS {
                let at = 2 * order * blocks + b;
                out.lane[order * blocks + b] =
                    e.re[b].fma::<A>(self.c[at], -(e.im[b] * self.c[at + blocks]));
            }
            out.lane[ORDERS * blocks + b] = self.size[b] * e.size[b];
        }
        out.slow = self.slow::<A>(e);
    }

    /// Polynomial and arcs at the instant of `e`: value and derivatives.
    #[inline(always)]
    fn slow<A: Arith>(&self, e: &Exponentials) -> [f64; ORDERS] {
        let mut d = self.polynomial::<A>(e.s);
        for arc in &self.arcs {
            let w = arc.omega;
            let Swing {
                sin,
                cos,
                less_one,
                less_x,
            } = e.swings[arc.harmonic];
            let (a, b) = (arc.alpha, arc.beta);
            let sum = a + b;
            d[0] += (a.re * less_one - a.im * less_x) + (b.re * less_one - b.im * sin);
            d[1] -= w * ((a.re * sin + a.im * less_one) + (b.re * sin + b.im * cos));
            d[2] -= w * w * (sum.re * cos - sum.im * sin);
            d[3] += w * w * w * (sum.re * sin + sum.im * cos);
            d[4] += (w * w) * (w * w) * (sum.re * cos - sum.im * sin);
        }
        d
    }

    /// The polynomial at s: value and derivatives.
    #[inline(always)]
    fn polynomial<A: Arith>(&self, s: f64) -> [f64; ORDERS] {
        if self.degree <= 2 {
            let [a, b, c] = [self.poly[0], self.poly[1], self.poly[2]];
            let value = A::fma(A::fma(c, s, b), s, a);
            return [value, A::fma(2.0 * c, s, b), 2.0 * c, 0.0, 0.0];
        }
        let c = &self.poly[..=self.degree];
        let mut d = [c[self.degree], 0.0, 0.0, 0.0, 0.0];
        for k in (0..self.degree).rev() {
            d[4] = A::fma(d[4], s, d[3]);
            d[3] = A::fma(d[3], s, d[2]);
            d[2] = A::fma(d[2], s, d[1]);
            d[1] = A::fma(d[1], s, d[0]);
            d[0] = A::fma(d[0], s, c[k]);
        }
        d[2] *= 2.0;
        d[3] *= 6.0;
        d[4] *= 24.0;
        d
    }

    /// Bound on the fifth derivative of the polynomial and the arcs.
    #[inline(always)]
    pub(crate) fn slow5(&self) -> f64 {
        self.slow5
    }
}
