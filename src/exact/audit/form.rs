//! Integrals of products of two sums of lanes.

use super::moments::integral;
use crate::exact::basis::{Basis, Lane};
use crate::exact::lanes::{Arith, V, WIDTH};
use crate::exact::pencil::C;
use crate::exact::phase::{Exponentials, Phase};

/// A pair of lanes whose exponents cancel (in this share of their size) is
/// integrated by itself.
const LEVEL: f64 = 1e-6;

/// ∫ Σ_jk Re(u_j z_j e^{λ_j s})·Re(w_k z_k e^{λ_k s}) ds with weights u_j·w_k summed
/// over whatever they belong to.
///
/// A product of two real parts is half the real part of the product and of
/// that with the conjugate, and so every pair of lanes gives
/// Re(P_jk·z_j z_k(E_j E_k − 1) + Q_jk·z_j z̄_k(E_j Ē_k − 1)), P and Q being the
/// weights over twice λ_j + λ_k and λ_j + λ̄_k. The difference loses digits where
/// a sum of exponents is small, but then the dissipation is as small: what is
/// lost is rounding of the energy.
#[derive(Clone, Debug)]
pub(super) struct Form {
    /// Lanes j.
    rows: Vec<usize>,
    /// P re, im, Q re, im by row and block of lanes k.
    cells: Vec<[V; 4]>,
    level: Vec<Level>,
    /// Only pairs with k ≤ j, those with k < j twice.
    symmetric: bool,
}

/// A pair of lanes whose exponents cancel.
#[derive(Clone, Copy, Debug)]
struct Level {
    j: usize,
    k: usize,
    conjugate: bool,
    exponent: C,
    weight: C,
}

impl Form {
    /// The form over `rows` with `weight(j, k, conjugate)`, the weight of lane k
    /// being conjugate in the last case; `symmetric`: over all rows, and the same
    /// with j and k exchanged.
    pub(super) fn new(
        (lanes, blocks): (&[Lane], usize),
        (rows, symmetric): (Vec<usize>, bool),
        weight: impl Fn(usize, usize, bool) -> C,
    ) -> Self {
        let mut cells = vec![[V::ZERO; 4]; rows.len() * blocks];
        let mut level = Vec::new();
        for (row, &j) in rows.iter().enumerate() {
            let others = if symmetric { j + 1 } else { lanes.len() };
            for (k, other) in lanes[..others].iter().enumerate() {
                let share = if symmetric && k < j { 1.0 } else { 0.5 };
                for conjugate in [false, true] {
                    let own = lanes[j].lambda;
                    let exponent = own
                        + if conjugate {
                            other.lambda.conj()
                        } else {
                            other.lambda
                        };
                    let weight = weight(j, k, conjugate) * share;
                    if weight.norm_sqr() == 0.0 {
                        continue;
                    }
                    if exponent.norm() <= LEVEL * (own.norm() + other.lambda.norm()) {
                        level.push(Level {
                            j,
                            k,
                            conjugate,
                            exponent,
                            weight,
                        });
                        continue;
                    }
                    let value = weight / exponent;
                    let cell = &mut cells[row * blocks + k / WIDTH];
                    let at = 2 * usize::from(conjugate);
                    cell[at].0[k % WIDTH] = value.re;
                    cell[at + 1].0[k % WIDTH] = value.im;
                }
            }
        }
        Self {
            rows,
            cells,
            level,
            symmetric,
        }
    }

    /// The integral from the start of the phase to the instant of `e`.
    #[inline(always)]
    pub(super) fn integral<A: Arith>(&self, basis: &Basis, phase: &Phase, e: &Exponentials) -> f64 {
        let blocks = basis.blocks;
        let mut sum = V::ZERO;
        for (row, &j) in self.rows.iter().enumerate() {
            let (jb, ji) = (j / WIDTH, j % WIDTH);
            let (br, bi) = (phase.re[jb].0[ji], phase.im[jb].0[ji]);
            let (er, ei) = (e.re[jb].0[ji], e.im[jb].0[ji]);
            let (ar, ai) = (br * er - bi * ei, br * ei + bi * er);
            let [ar, ai, br, bi] = [V::splat(ar), V::splat(ai), V::splat(br), V::splat(bi)];
            for b in 0..if self.symmetric { jb + 1 } else { blocks } {
                let (cr, ci) = (phase.re[b], phase.im[b]);
                let wr = cr.fma::<A>(e.re[b], -(ci * e.im[b]));
                let wi = cr.fma::<A>(e.im[b], ci * e.re[b]);
                // The four products of parts, ends less starts.
                let rr = ar.fma::<A>(wr, -(br * cr));
                let ii = ai.fma::<A>(wi, -(bi * ci));
                let ri = ar.fma::<A>(wi, -(br * ci));
                let ir = ai.fma::<A>(wr, -(bi * cr));
                let [pr, pi, qr, qi] = self.cells[row * blocks + b];
                sum = pr.fma::<A>(rr - ii, sum) - pi * (ri + ir);
                sum = qr.fma::<A>(rr + ii, sum) - qi * (ir - ri);
            }
        }
        let mut total = sum.sum();
        let amplitude = |k: usize| {
            let (b, i) = (k / WIDTH, k % WIDTH);
            C::new(phase.re[b].0[i], phase.im[b].0[i])
        };
        for pair in &self.level {
            let other = amplitude(pair.k);
            let other = if pair.conjugate { other.conj() } else { other };
            let size = amplitude(pair.j) * other * pair.weight;
            let length = if pair.exponent.norm_sqr() == 0.0 {
                C::from(e.s)
            } else {
                integral(pair.exponent, e.s)
            };
            total += (size * length).re;
        }
        total
    }
}
