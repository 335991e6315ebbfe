//! Integrals of products of two sums of lanes.

use super::moments::integral_of_exponential;
use crate::exact::basis::Lane;
use crate::exact::lanes::{Arith, V, WIDTH};
use crate::exact::pencil::C;
use crate::exact::phase::{Exponentials, Phase};

/// A pair of lanes whose exponents cancel (in this share of their size) is
/// integrated by itself.
const CANCELLING: f64 = 1e-6;

/// ∫ Σ_jk Re(u_j z_j e^{λ_j s})·Re(w_k z_k e^{λ_k s}) ds with weights u_j·w_k summed
/// over whatever they belong to.
///
/// A product of two real parts is half the real part of the product and of
/// that with the conjugate. So every pair of lanes gives
/// Re(P_jk·z_j z_k(E_j E_k − 1) + Q_jk·z_j z̄_k(E_j Ē_k − 1)), P and Q being the
/// weights over twice λ_j + λ_k and λ_j + λ̄_k. The difference loses digits where
/// a sum of exponents is small, but then the dissipation is as small: what is
/// lost is rounding of the energy.
#[derive(Clone, Debug)]
pub(super) struct Form {
    /// Lanes j.
    rows: Vec<usize>,
    /// By row and block of lanes k, what the products of the lanes' parts count:
    /// re·re, im·im, re·im, im·re.
    cells: Vec<[V; 4]>,
    cancelling: Vec<CancellingPair>,
    /// Only pairs with k ≤ j, those with k < j twice.
    symmetric: bool,
}

/// Real and imaginary parts of a vector of lanes at the ends of a phase.
#[derive(Clone, Copy, Debug, Default)]
pub(super) struct PhaseEnds {
    start: [V; 2],
    end: [V; 2],
}

impl PhaseEnds {
    /// Those of the phase up to the instant of `e`.
    #[inline(always)]
    pub(super) fn collect_until<A: Arith>(
        phase: &Phase,
        e: &Exponentials,
        blocks: usize,
        out: &mut Vec<Self>,
    ) {
        out.clear();
        let start = phase.re[..blocks].iter().zip(&phase.im[..blocks]);
        let now = e.re[..blocks].iter().zip(&e.im[..blocks]);
        for ((cr, ci), (er, ei)) in start.zip(now) {
            out.push(Self {
                start: [*cr, *ci],
                end: [cr.fma::<A>(*er, -(*ci * *ei)), cr.fma::<A>(*ei, *ci * *er)],
            });
        }
    }
}

/// A pair of lanes whose exponents cancel.
#[derive(Clone, Copy, Debug)]
struct CancellingPair {
    j: usize,
    k: usize,
    conjugate: bool,
    exponent: C,
    weight: C,
}

impl Form {
    /// The form over the lanes j of `rows`, the lanes being in `blocks` of `WIDTH`.
    /// `weight(j, k, conjugate)` is u_j·w_k, with the conjugate of w_k if `conjugate`;
    /// `symmetric`: `rows` are all lanes, and weights do not change if j and k are exchanged,
    /// so that only pairs k ≤ j are kept.
    pub(super) fn new(
        (lanes, blocks): (&[Lane], usize),
        (rows, symmetric): (Vec<usize>, bool),
        weight: impl Fn(usize, usize, bool) -> C,
    ) -> Self {
        let mut cells = vec![[V::ZERO; 4]; rows.len() * blocks];
        let mut cancelling = Vec::new();
        for (row, &j) in rows.iter().enumerate() {
            let others = if symmetric { j + 1 } else { lanes.len() };
            let own = lanes[j].lambda;
            for (k, other) in lanes[..others].iter().enumerate() {
                let share = if symmetric && k < j { 1.0 } else { 0.5 };
                let whole = own.norm_sqr() + other.lambda.norm_sqr();
                for conjugate in [false, true] {
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
                    if exponent.norm_sqr() <= CANCELLING * CANCELLING * whole {
                        cancelling.push(CancellingPair {
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
                    let sign = if conjugate { -1.0 } else { 1.0 };
                    cell[0].0[k % WIDTH] += value.re;
                    cell[1].0[k % WIDTH] -= sign * value.re;
                    cell[2].0[k % WIDTH] -= sign * value.im;
                    cell[3].0[k % WIDTH] -= value.im;
                }
            }
        }
        Self {
            rows,
            cells,
            cancelling,
            symmetric,
        }
    }

    /// The integral over the lanes' parts at the ends of a phase.
    #[inline(always)]
    pub(super) fn integral_over_phase<A: Arith>(
        &self,
        ends: &[PhaseEnds],
        phase: &Phase,
        e: &Exponentials,
    ) -> f64 {
        let (mut even, mut odd) = (V::ZERO, V::ZERO);
        let count = ends.len();
        for (row, &j) in self.rows.iter().enumerate() {
            let used = if self.symmetric { j / WIDTH + 1 } else { count };
            let cells = &self.cells[row * count..][..used];
            let own = &ends[j / WIDTH];
            let part = |v: &V| V::splat(v.0[j % WIDTH]);
            let (br, bi) = (part(&own.start[0]), part(&own.start[1]));
            let (ar, ai) = (part(&own.end[0]), part(&own.end[1]));
            for (b, other) in ends[..used].iter().enumerate() {
                let ([cr, ci], [wr, wi]) = (other.start, other.end);
                let [rr, ii, ri, ir] = cells[b];
                // The four products of parts, ends less starts.
                even = rr.fma::<A>(ar.fma::<A>(wr, -(br * cr)), even);
                odd = ii.fma::<A>(ai.fma::<A>(wi, -(bi * ci)), odd);
                even = ri.fma::<A>(ar.fma::<A>(wi, -(br * ci)), even);
                odd = ir.fma::<A>(ai.fma::<A>(wr, -(bi * cr)), odd);
            }
        }
        let mut total = (even + odd).sum();
        let amplitude = |k: usize| {
            let (b, i) = (k / WIDTH, k % WIDTH);
            C::new(phase.re[b].0[i], phase.im[b].0[i])
        };
        for pair in &self.cancelling {
            let other = amplitude(pair.k);
            let other = if pair.conjugate { other.conj() } else { other };
            let size = amplitude(pair.j) * other * pair.weight;
            let length = if pair.exponent.norm_sqr() == 0.0 {
                C::from(e.s)
            } else {
                integral_of_exponential(pair.exponent, e.s)
            };
            total += (size * length).re;
        }
        total
    }
}
