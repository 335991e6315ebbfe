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

/// The lanes of one vector at the start of the phase.
#[derive(Clone, Copy, Debug, Default)]
struct Amplitudes {
    /// In g and its derivatives: re, im.
    c: [[V; 2]; ORDERS],
    /// Of g, absolute.
    size: V,
}

/// Share that the lanes of one vector have in a signal at one instant.
#[derive(Clone, Copy, Debug, Default)]
pub(crate) struct Share {
    /// In g and its derivatives.
    pub(crate) orders: [V; ORDERS],
    /// |amplitude| in g.
    pub(crate) size: V,
}

/// A functional over the present phase.
#[derive(Clone, Debug)]
pub(crate) struct Signal {
    /// By vectors of lanes.
    lanes: Vec<Amplitudes>,
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
    /// Nobody asks for its root once something else has come about, which most
    /// often it does before: near the start the step ends in front of the root.
    pub(crate) passing: bool,
}

/// Value and derivatives, with the lanes' own contributions left in the scratch.
#[derive(Clone, Debug, Default)]
pub(crate) struct Terms {
    /// By vectors of lanes.
    pub(crate) lanes: Vec<Share>,
    /// Polynomial and arcs.
    pub(crate) slow: [f64; ORDERS],
}

/// Sums over the lanes.
struct Sums {
    orders: [V; ORDERS],
    /// |fifth derivative| at most.
    fifth: V,
}

impl Sums {
    #[inline(always)]
    fn first(share: &Share, fifth: V) -> Self {
        Self {
            orders: share.orders,
            fifth: share.size * fifth,
        }
    }

    #[inline(always)]
    fn add<A: Arith>(&mut self, share: &Share, fifth: V) {
        for order in 0..ORDERS {
            self.orders[order] = self.orders[order] + share.orders[order];
        }
        self.fifth = share.size.fma::<A>(fifth, self.fifth);
    }

    /// g and its derivatives, and a bound on the next one, with what does not
    /// belong to the lanes.
    #[inline(always)]
    fn with_bound(&self, slow: [f64; ORDERS], slow5: f64) -> ([f64; ORDERS], f64) {
        let mut jet = slow;
        for order in 0..ORDERS {
            jet[order] += self.orders[order].sum();
        }
        (jet, slow5 + self.fifth.sum())
    }
}

impl Amplitudes {
    #[inline(always)]
    fn lane_share<A: Arith>(&self, re: V, im: V, size: V) -> Share {
        let mut orders = [V::ZERO; ORDERS];
        for order in 0..ORDERS {
            let [own, other] = self.c[order];
            orders[order] = re.fma::<A>(own, -(im * other));
        }
        Share {
            orders,
            size: self.size * size,
        }
    }
}

impl Signal {
    pub(crate) fn new(blocks: usize, flights: usize) -> Self {
        Self {
            lanes: vec![Amplitudes::default(); blocks],
            poly: [0.0; POLY],
            degree: 0,
            arcs: Vec::with_capacity(flights),
            slow5: 0.0,
            noise: 0.0,
            zeros: 0,
            leaving: false,
            passing: false,
        }
    }

    /// Takes up `functional` over `phase`; `sign` ±1 turns it round.
    #[inline(always)]
    pub(crate) fn set_functional<A: Arith>(
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
        let (re, im) = (&phase.re[..blocks], &phase.im[..blocks]);
        let (w, lanes) = (&weights.w[..blocks], &mut self.lanes[..blocks]);
        for b in 0..blocks {
            let (zr, zi) = (re[b] * turn, im[b] * turn);
            for order in 0..ORDERS {
                let [wr, wi] = w[b][order];
                lanes[b].c[order] = [wr.fma::<A>(zr, -(wi * zi)), wr.fma::<A>(zi, wi * zr)];
            }
            let [cr, ci] = lanes[b].c[0];
            lanes[b].size = cr.fma::<A>(cr, ci * ci).map(f64::sqrt);
            total = total + lanes[b].size;
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
        self.passing = false;
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

    /// g and its derivatives at the instant of `e`, all lanes followed, and a
    /// bound on the next one from there on.
    #[inline(always)]
    pub(crate) fn jet<A: Arith>(
        &self,
        basis: &Basis,
        active: usize,
        e: &Exponentials,
    ) -> ([f64; ORDERS], f64) {
        let (re, im, size) = (&e.re[..active], &e.im[..active], &e.size[..active]);
        let (lanes, fifth) = (&self.lanes[..active], &basis.fifth[..active]);
        let mut sums = Sums::first(&lanes[0].lane_share::<A>(re[0], im[0], size[0]), fifth[0]);
        for b in 1..active {
            sums.add::<A>(&lanes[b].lane_share::<A>(re[b], im[b], size[b]), fifth[b]);
        }
        sums.with_bound(self.slow::<A>(e), self.slow5)
    }

    /// The same, with what it is made of left in `out`.
    #[inline(always)]
    pub(crate) fn terms<A: Arith>(
        &self,
        basis: &Basis,
        active: usize,
        e: &Exponentials,
        out: &mut Terms,
    ) -> ([f64; ORDERS], f64) {
        let (re, im, size) = (&e.re[..active], &e.im[..active], &e.size[..active]);
        let (lanes, fifth) = (&self.lanes[..active], &basis.fifth[..active]);
        let room = &mut out.lanes[..active];
        room[0] = lanes[0].lane_share::<A>(re[0], im[0], size[0]);
        let mut sums = Sums::first(&room[0], fifth[0]);
        for b in 1..active {
            room[b] = lanes[b].lane_share::<A>(re[b], im[b], size[b]);
            sums.add::<A>(&room[b], fifth[b]);
        }
        out.slow = self.slow::<A>(e);
        sums.with_bound(out.slow, self.slow5)
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
