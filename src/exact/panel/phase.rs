//! Four functionals over the present phase.

use super::Panel;
use crate::exact::basis::Basis;
use crate::exact::hermite::Bounds;
use crate::exact::lanes::{Arith, V};
use crate::exact::pencil::C;
use crate::exact::phase::{Exponentials, POLY, Phase, Swing};

/// A flight seen by the four functionals.
#[derive(Clone, Copy, Debug)]
struct Arc {
    harmonic: usize,
    omega: f64,
    /// α, β: re, im each.
    c: [V; 4],
}

/// The panel over the present phase.
#[derive(Clone, Debug)]
pub(crate) struct PanelPhase {
    poly: [V; POLY],
    degree: usize,
    arcs: Vec<Arc>,
    /// |fourth derivative| of polynomial and arcs.
    pub(crate) slow4: V,
    /// |amplitude| of the lanes at the start.
    pub(crate) size: Vec<V>,
}

impl PanelPhase {
    pub(crate) fn new(blocks: usize, flights: usize) -> Self {
        Self {
            poly: [V::ZERO; POLY],
            degree: 0,
            arcs: Vec::with_capacity(flights),
            slow4: V::ZERO,
            size: vec![V::ZERO; blocks],
        }
    }

    /// Takes up the phase.
    #[inline(always)]
    pub(crate) fn begin_phase<A: Arith>(&mut self, basis: &Basis, panel: &Panel, phase: &Phase) {
        for b in 0..basis.blocks {
            let (re, im) = (phase.re[b], phase.im[b]);
            self.size[b] = re.fma::<A>(re, im * im).map(f64::sqrt);
        }
        self.take_polynomials::<A>(panel, phase);
        self.slow4 = if self.degree > 3 {
            self.fourth(phase.reach)
        } else {
            V::ZERO
        };
        self.arcs.clear();
        for flight in &phase.flights {
            let [x, y, folded] = panel.rigid[flight.rigid];
            let drive = C::new(0.0, flight.omega);
            let (a, b) = (flight.amplitude, flight.amplitude * drive);
            let (re, im) = (y * V::splat(b.re), y * V::splat(b.im));
            self.poly[0] = self.poly[0] - re * folded;
            let whole = V::splat(1.0) - folded;
            let c = [
                x * V::splat(a.re),
                x * V::splat(a.im),
                re * whole,
                im * whole,
            ];
            let (re, im) = (c[0] + c[2], c[1] + c[3]);
            let square = flight.omega * flight.omega;
            let size = (re * re + im * im).map(f64::sqrt);
            self.slow4 = self.slow4 + size * V::splat(square * square);
            self.arcs.push(Arc {
                harmonic: flight.harmonic,
                omega: flight.omega,
                c,
            });
        }
    }

    #[inline(always)]
    fn take_polynomials<A: Arith>(&mut self, panel: &Panel, phase: &Phase) {
        self.degree = phase.degree.max(phase.forcing.degree);
        if self.degree <= 2 {
            self.poly[..3].copy_from_slice(&[panel.constant, V::ZERO, V::ZERO]);
            for &(i, factors) in &panel.terms {
                self.accumulate::<A>(&phase.poly[i * POLY..i * POLY + 3], factors);
            }
            let mut law = [0.0; 3];
            let count = phase.forcing.degree + 1;
            law[..count].copy_from_slice(&phase.forcing.law[..count]);
            self.accumulate::<A>(&law, panel.law);
            return;
        }
        let mut work = [0.0; POLY];
        self.poly[..=self.degree].fill(V::ZERO);
        for (f, functional) in panel.functionals.iter().enumerate() {
            let degree = functional.polynomial(phase, &mut work);
            for (lanes, value) in self.poly.iter_mut().zip(&work[..=degree]) {
                lanes.0[f] = *value;
            }
        }
    }

    /// Adds a·p + b·ṗ + c·p̈ for a polynomial of degree 2.
    #[inline(always)]
    fn accumulate<A: Arith>(&mut self, p: &[f64], [a, b, c]: [V; 3]) {
        let [p0, p1, p2] = [V::splat(p[0]), V::splat(p[1]), V::splat(p[2])];
        let twice = p2 + p2;
        self.poly[0] = a.fma::<A>(p0, b.fma::<A>(p1, c.fma::<A>(twice, self.poly[0])));
        self.poly[1] = a.fma::<A>(p1, b.fma::<A>(twice, self.poly[1]));
        self.poly[2] = a.fma::<A>(p2, self.poly[2]);
    }

    #[inline(never)]
    fn fourth(&self, reach: f64) -> V {
        let mut sum = V::ZERO;
        for k in (4..=self.degree).rev() {
            let factor = (k * (k - 1) * (k - 2) * (k - 3)) as f64;
            sum = sum * V::splat(reach) + V::splat(factor) * self.poly[k].map(f64::abs);
        }
        sum
    }

    /// Bounds between two instants with all lanes together within `envelope`;
    /// nothing has to be evaluated for them. `None` under a law or loads of
    /// higher powers of time.
    #[inline(always)]
    pub(crate) fn envelope<A: Arith>(&self, from: f64, to: f64, envelope: V) -> Option<Bounds> {
        if self.degree > 2 {
            return None;
        }
        let [a, b, c] = [self.poly[0], self.poly[1], self.poly[2]];
        let (s, h) = (V::splat(from), V::splat(to - from));
        // Bernstein coefficients of the parabola.
        let first = c.fma::<A>(s, b).fma::<A>(s, a);
        let slope = (c + c).fma::<A>(s, b);
        let middle = slope.fma::<A>(V::splat(0.5) * h, first);
        let last = c.fma::<A>(h, slope).fma::<A>(h, first);
        let spread = envelope + self.swung(to);
        Some(Bounds {
            low: first.min(middle.min(last)) - spread,
            high: first.max(middle.max(last)) + spread,
        })
    }

    /// Greatest magnitude of polynomial and arcs of functional f between two instants.
    pub(crate) fn range(&self, f: usize, from: f64, to: f64) -> f64 {
        let (middle, half) = (0.5 * (from + to), 0.5 * (to - from));
        let mut c = [0.0; POLY];
        for (c, poly) in c.iter_mut().zip(&self.poly[..=self.degree]) {
            *c = poly.0[f];
        }
        // Taylor's coefficients at the middle, by repeated synthetic division.
        let (mut sum, mut power) = (0.0, 1.0);
        for order in 0..=self.degree {
            for k in (order..self.degree).rev() {
                c[k] += middle * c[k + 1];
            }
            sum += power * c[order].abs();
            power *= half;
        }
        sum + self.swung(to).0[f]
    }

    /// What the arcs amount to at most up to the local time s:
    /// 1 − cos x ≤ x²/2, x − sin x ≤ x³/6.
    #[inline(always)]
    fn swung(&self, s: f64) -> V {
        let mut sum = V::ZERO;
        for arc in &self.arcs {
            let x = arc.omega * s;
            let (even, odd) = (V::splat((0.5 * x * x).min(2.0)), V::splat(x * x * x / 6.0));
            let [ar, ai, br, bi] = arc.c.map(|v| v.map(f64::abs));
            sum = sum + (ar + br) * even + ai * odd + bi * V::splat(x.min(1.0));
        }
        sum
    }

    /// Rounding of the four up to the local time s, `envelope` being that of all
    /// lanes at the start of the phase.
    #[inline(always)]
    pub(crate) fn noise(&self, s: f64, envelope: V) -> V {
        let mut sum = V::ZERO;
        for k in (0..=self.degree).rev() {
            sum = sum * V::splat(s) + self.poly[k].map(f64::abs);
        }
        sum = sum + envelope;
        for arc in &self.arcs {
            let x = (arc.omega * s).min(2.0);
            let [ar, ai, br, bi] = arc.c.map(|v| v.map(f64::abs));
            sum = sum + ((ar + ai) * V::splat(x) + (br + bi)) * V::splat(x);
        }
        sum * V::splat(8.0 * f64::EPSILON)
    }

    /// Value and slope of polynomial and arcs.
    #[inline(always)]
    pub(super) fn slow_two<A: Arith>(&self, e: &Exponentials) -> [V; 2] {
        let time = V::splat(e.s);
        let (mut value, mut slope) = (self.poly[self.degree], V::ZERO);
        if self.degree <= 2 {
            let [a, b, c] = [self.poly[0], self.poly[1], self.poly[2]];
            value = c.fma::<A>(time, b).fma::<A>(time, a);
            slope = (c + c).fma::<A>(time, b);
        } else {
            for k in (0..self.degree).rev() {
                slope = slope.fma::<A>(time, value);
                value = value.fma::<A>(time, self.poly[k]);
            }
        }
        for arc in &self.arcs {
            let f = V::splat;
            let w = arc.omega;
            let Swing {
                sin,
                cos,
                less_one: c,
                less_x: l,
            } = e.swings[arc.harmonic];
            let [ar, ai, br, bi] = arc.c;
            value = value + (ar * f(c) - ai * f(l)) + (br * f(c) - bi * f(sin));
            slope = slope - f(w) * (ar * f(sin) + ai * f(c) + br * f(sin) + bi * f(cos));
        }
        [value, slope]
    }

    /// Polynomial and arcs in functional f: value and three derivatives.
    #[inline(always)]
    pub(super) fn slow_one<A: Arith>(&self, e: &Exponentials, f: usize) -> [f64; 4] {
        let poly = |k: usize| self.poly[k].0[f];
        let mut d = if self.degree <= 2 {
            let (a, b, c) = (poly(0), poly(1), poly(2));
            let value = A::fma(A::fma(c, e.s, b), e.s, a);
            [value, A::fma(c + c, e.s, b), c + c, 0.0]
        } else {
            let mut d = [poly(self.degree), 0.0, 0.0, 0.0];
            for k in (0..self.degree).rev() {
                d[3] = A::fma(d[3], e.s, d[2]);
                d[2] = A::fma(d[2], e.s, d[1]);
                d[1] = A::fma(d[1], e.s, d[0]);
                d[0] = A::fma(d[0], e.s, poly(k));
            }
            [d[0], d[1], 2.0 * d[2], 6.0 * d[3]]
        };
        for arc in &self.arcs {
            let w = arc.omega;
            let Swing {
                sin,
                cos,
                less_one: c,
                less_x: l,
            } = e.swings[arc.harmonic];
            let [ar, ai, br, bi] = arc.c.map(|v| v.0[f]);
            let (sr, si) = (ar + br, ai + bi);
            d[0] += (ar * c - ai * l) + (br * c - bi * sin);
            d[1] -= w * (ar * sin + ai * c + br * sin + bi * cos);
            d[2] -= w * w * (sr * cos - si * sin);
            d[3] += w * w * w * (sr * sin + si * cos);
        }
        d
    }

    /// Primitive of polynomial and arcs in the first functional.
    #[inline(always)]
    pub(super) fn slow_primitive<A: Arith>(&self, e: &Exponentials) -> f64 {
        let poly = |k: usize| self.poly[k].0[0];
        let mut sum = 0.0;
        if self.degree <= 2 {
            let high = A::fma(poly(2) * (1.0 / 3.0), e.s, 0.5 * poly(1));
            sum += A::fma(high, e.s, poly(0)) * e.s;
        } else {
            let mut value = 0.0;
            for k in (0..=self.degree).rev() {
                value = A::fma(value, e.s, poly(k) / (k + 1) as f64);
            }
            sum += value * e.s;
        }
        for arc in &self.arcs {
            let x = arc.omega * e.s;
            let Swing {
                less_one: c,
                less_x: l,
                ..
            } = e.swings[arc.harmonic];
            let [ar, ai, br, bi] = arc.c.map(|v| v.0[0]);
            // ∫E_k ds = E_{k+1}/(iΩ).
            let third = c + 0.5 * x * x;
            sum += (ar * l + ai * third) / arc.omega;
            sum += (br * l + bi * c) / arc.omega;
        }
        sum
    }
}
