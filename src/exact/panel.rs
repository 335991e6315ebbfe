//! Four functionals side by side, bounded over a step.
//!
//! For every object the figures need δ, φ̇, φ̈ and the force (or the clearance)
//! of its pair. The four ride in one vector; over a step of the switch search
//! the same quartic bound as in [`super::bound`] says whether any can pass the
//! greatest value met so far. Almost always none can.

use super::basis::Basis;
use super::functional::{Functional, Weights};
use super::lanes::{Arith, V, WIDTH, reduced};
use super::pencil::C;
use super::phase::{Exponentials, POLY, Phase, scalar_sin_cos};

/// Lanes are followed over steps of up to this many radians of theirs.
const FOLLOW: f64 = 2.0;

/// In a second bound lanes are enveloped beyond this many radians: over half a
/// swing the envelope is nearer to the truth than the quartic.
const CLOSE: f64 = 0.4;

/// The four functionals of an object in a basis.
#[derive(Clone, Debug)]
pub(crate) struct Panel {
    pub(crate) functionals: [Functional; WIDTH],
    /// Weights: lane-major, then order 0 … 3, then re, im.
    weights: Vec<V>,
    /// |weight|, and |weight|·|λ|⁴, by lane.
    sizes: Vec<[V; 2]>,
    /// Weight/λ of the first functional: its primitive.
    primitive: Vec<C>,
    /// Factors of η, η̇ of every floating part, and 1 where the speed is folded
    /// into the harmonic's lane.
    rigid: Vec<[V; 3]>,
    /// The same four one by one, for climbing to an extreme.
    pub(crate) single: [Weights; WIDTH],
}

/// A flight seen by the four functionals.
#[derive(Clone, Copy, Debug)]
struct Arc {
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
    slow4: V,
    /// |amplitude| of the lanes at the start.
    size: Vec<V>,
}

/// Bounds of the four over a step.
#[derive(Clone, Copy, Debug)]
pub(crate) struct Bounds {
    pub(crate) low: V,
    pub(crate) high: V,
}

impl Panel {
    pub(crate) fn new(basis: &Basis, functionals: [Functional; WIDTH]) -> Self {
        let mut weights = Vec::with_capacity(8 * basis.lanes.len());
        let mut sizes = Vec::new();
        let mut primitive = Vec::new();
        for lane in &basis.lanes {
            let w = [0, 1, 2, 3].map(|f| functionals[f].weight(&basis.rigid, lane));
            let mut power = C::new(1.0, 0.0);
            for _ in 0..4 {
                weights.push(V(w.map(|x| (x * power).re)));
                weights.push(V(w.map(|x| (x * power).im)));
                power *= lane.lambda;
            }
            let size = V(w.map(|x| x.norm()));
            sizes.push([size, size * V::splat(lane.lambda.norm().powi(4))]);
            let zero = lane.lambda.norm() == 0.0;
            primitive.push(if zero {
                C::default()
            } else {
                w[0] / lane.lambda
            });
        }
        let rigid = basis
            .rigid
            .iter()
            .map(|part| {
                let f = [0, 1, 2, 3].map(|f| functionals[f].rigid(part));
                let folds = [0, 1, 2, 3].map(|f| f64::from(u8::from(functionals[f].folds())));
                [V(f.map(|x| x[0])), V(f.map(|x| x[1])), V(folds)]
            })
            .collect();
        let single = [0, 1, 2, 3].map(|f| Weights::new(basis, &functionals[f]));
        Self {
            single,
            functionals,
            weights,
            sizes,
            primitive,
            rigid,
        }
    }
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
    pub(crate) fn take<A: Arith>(&mut self, basis: &Basis, panel: &Panel, phase: &Phase) {
        for b in 0..basis.blocks {
            let (re, im) = (phase.re[b], phase.im[b]);
            self.size[b] = re.fma::<A>(re, im * im).map(f64::sqrt);
        }
        self.take_polynomials(panel, phase);
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
                omega: flight.omega,
                c,
            });
        }
    }

    #[inline(always)]
    fn take_polynomials(&mut self, panel: &Panel, phase: &Phase) {
        let mut work = [0.0; POLY];
        self.degree = phase.degree.max(phase.forcing.degree);
        self.poly[..=self.degree].fill(V::ZERO);
        for (f, functional) in panel.functionals.iter().enumerate() {
            let degree = functional.polynomial(phase, &mut work);
            for (lanes, value) in self.poly.iter_mut().zip(&work[..=degree]) {
                lanes.0[f] = *value;
            }
        }
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

    /// Bounds over [e.s, e.s + h].
    #[inline(always)]
    pub(crate) fn bounds<A: Arith>(
        &self,
        basis: &Basis,
        panel: &Panel,
        phase: &Phase,
        e: &Exponentials,
        h: f64,
    ) -> Bounds {
        let mut a = self.slow::<A>(e.s);
        let (mut r, mut rest) = (self.slow4, V::ZERO);
        let mut close: Option<([V; 4], V)> = None;
        let mut beyond = V::ZERO;
        let lanes = basis.lanes.len().min(phase.active * WIDTH);
        for b in 0..phase.active {
            let (zr, zi) = (phase.re[b], phase.im[b]);
            let re = zr.fma::<A>(e.re[b], -(zi * e.im[b]));
            let im = zr.fma::<A>(e.im[b], zi * e.re[b]);
            let size = self.size[b] * e.size[b];
            for i in 0..WIDTH {
                let k = b * WIDTH + i;
                if k >= lanes {
                    break;
                }
                let [plain, fourth] = panel.sizes[k];
                if basis.modulus[k] * h > CLOSE {
                    close.get_or_insert((a, r));
                    beyond = plain.fma::<A>(V::splat(size.0[i]), beyond);
                }
                if basis.modulus[k] * h > FOLLOW {
                    rest = plain.fma::<A>(V::splat(size.0[i]), rest);
                    continue;
                }
                r = fourth.fma::<A>(V::splat(size.0[i]), r);
                let (pr, pi) = (V::splat(re.0[i]), V::splat(-im.0[i]));
                let w = &panel.weights[8 * k..8 * k + 8];
                for (order, sum) in a.iter_mut().enumerate() {
                    *sum = w[2 * order].fma::<A>(pr, w[2 * order + 1].fma::<A>(pi, *sum));
                }
            }
        }
        let mut bounds = enclose::<A>(a, r, rest, h);
        if let Some((a, r)) = close {
            let second = enclose::<A>(a, r, beyond, h);
            bounds.low = bounds.low.max(second.low);
            bounds.high = bounds.high.min(second.high);
        }
        bounds
    }

    #[inline(always)]
    fn slow<A: Arith>(&self, s: f64) -> [V; 4] {
        let time = V::splat(s);
        let mut d = [self.poly[self.degree], V::ZERO, V::ZERO, V::ZERO];
        for k in (0..self.degree).rev() {
            d[3] = d[3].fma::<A>(time, d[2]);
            d[2] = d[2].fma::<A>(time, d[1]);
            d[1] = d[1].fma::<A>(time, d[0]);
            d[0] = d[0].fma::<A>(time, self.poly[k]);
        }
        d[2] = d[2] * V::splat(2.0);
        d[3] = d[3] * V::splat(6.0);
        for arc in &self.arcs {
            let f = V::splat;
            let w = arc.omega;
            let (sin, cos) = scalar_sin_cos::<A>(w * s);
            let (c, l) = reduced::<A>(w * s, sin, cos);
            let [ar, ai, br, bi] = arc.c;
            let (sr, si) = (ar + br, ai + bi);
            d[0] = d[0] + (ar * f(c) - ai * f(l)) + (br * f(c) - bi * f(sin));
            d[1] = d[1] - f(w) * (ar * f(sin) + ai * f(c) + br * f(sin) + bi * f(cos));
            d[2] = d[2] - f(w * w) * (sr * f(cos) - si * f(sin));
            d[3] = d[3] + f(w * w * w) * (sr * f(sin) + si * f(cos));
        }
        d
    }

    /// Primitive of the first functional at the instant of `e`.
    #[inline(always)]
    pub(crate) fn primitive<A: Arith>(
        &self,
        basis: &Basis,
        panel: &Panel,
        phase: &Phase,
        e: &Exponentials,
    ) -> f64 {
        let mut sum = 0.0;
        let lanes = basis.lanes.len().min(phase.active * WIDTH);
        for k in 0..lanes {
            let (b, i) = (k / WIDTH, k % WIDTH);
            let (zr, zi) = (phase.re[b].0[i], phase.im[b].0[i]);
            let (er, ei) = (e.re[b].0[i], e.im[b].0[i]);
            let (pr, pi) = (zr * er - zi * ei, zr * ei + zi * er);
            let w = panel.primitive[k];
            sum += w.re * pr - w.im * pi;
            if basis.modulus[k] == 0.0 {
                let w = &panel.weights[8 * k..];
                sum += (w[0].0[0] * zr - w[1].0[0] * zi) * e.s;
            }
        }
        let mut poly = 0.0;
        for k in (0..=self.degree).rev() {
            poly = A::fma(poly, e.s, self.poly[k].0[0] / (k + 1) as f64);
        }
        sum += poly * e.s;
        for arc in &self.arcs {
            let x = arc.omega * e.s;
            let (sin, cos) = scalar_sin_cos::<A>(x);
            let (c, l) = reduced::<A>(x, sin, cos);
            let [ar, ai, br, bi] = arc.c.map(|v| v.0[0]);
            // ∫E_k ds = E_{k+1}/(iΩ).
            let third = c + 0.5 * x * x;
            sum += (ar * l + ai * third) / arc.omega;
            sum += (br * l + bi * c) / arc.omega;
        }
        sum
    }
}

#[inline(always)]
fn enclose<A: Arith>(a: [V; 4], r: V, rest: V, h: f64) -> Bounds {
    let f = V::splat;
    let h2 = h * h;
    let (p0, p1) = (a[0], a[1] * f(h));
    let (p2, p3) = (a[2] * f(0.5 * h2), a[3] * f(h * h2 / 6.0));
    let b1 = p1.fma::<A>(f(0.25), p0);
    let b2 = p2.fma::<A>(f(1.0 / 6.0), p1.fma::<A>(f(0.5), p0));
    let b3 = p2.fma::<A>(f(0.5), p1.fma::<A>(f(0.75), p0)) + p3 * f(0.25);
    let b4 = (p0 + p1) + (p2 + p3);
    let lost = r * f(h2 * h2 / 24.0);
    let low = p0.min(b1).min(b2.min(b3)).min(b4 - lost) - rest;
    let high = p0.max(b1).max(b2.max(b3)).max(b4 + lost) + rest;
    Bounds { low, high }
}
