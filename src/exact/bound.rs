//! How far a signal certainly stays positive, and where it certainly has one root.
//!
//! Over [0, h] every lane is either *followed*, with its derivatives of order
//! 0 … 4 and |c||λ|⁵ in the remainder (Re λ ≤ 0: the value at the left end is a
//! bound on the whole interval), or *enveloped*. It takes |c| off the constant
//! and nothing else. Any split is valid. Then
//!
//! g(s) ≥ a₀ + a₁s + a₂s²/2 + a₃s³/6 + a₄s⁴/24 − R·s⁵/120 on [0, h],
//!
//! and this quintic is not negative if its six Bernstein coefficients are not.

use super::basis::Basis;
use super::functional::ORDERS;
use super::lanes::{Arith, V, WIDTH};
use super::phase::Exponentials;
use super::signal::{Signal, Terms};

/// g and its derivatives.
pub(crate) type Jet = [f64; ORDERS];

/// Assessment of a signal from one evaluation.
#[derive(Clone, Copy, Debug, Default)]
pub(crate) struct Assessment {
    /// g and its derivatives now.
    pub(crate) jet: Jet,
    /// Bound on |fifth derivative| from now on.
    pub(crate) remainder: f64,
    /// No root in [0, free].
    pub(crate) free: f64,
    /// Exactly one root in (low, high), and g is falling there; none before.
    pub(crate) root: Option<Bracket>,
}

/// A bracket around exactly one downward root.
#[derive(Clone, Copy, Debug, PartialEq)]
pub(crate) struct Bracket {
    pub(crate) low: f64,
    pub(crate) guess: f64,
    pub(crate) high: f64,
}

/// Trial lengths tested at once, as shares of the greatest.
const LADDER: [V; 2] = [V([1.0, 0.8, 0.62, 0.47]), V([0.35, 0.22, 0.1, 0.03])];

/// Assesses `signal` at the instant of `e`, up to `left` ahead.
#[inline(always)]
pub(crate) fn assess<A: Arith>(
    basis: &Basis,
    active: usize,
    signal: &Signal,
    e: &Exponentials,
    terms: &mut Terms,
    left: f64,
) -> Assessment {
    let s = e.s;
    let (mut a, r) = signal.terms::<A>(basis, active, e, terms);
    if s == 0.0 {
        a[..signal.zeros].fill(0.0);
    }
    let lift = if signal.leaving {
        2.0 * signal.noise + 2.0 * f64::EPSILON * s * a[1].abs()
    } else {
        0.0
    };
    let root = certify::<A>(a, r, lift, left);
    let free = match root {
        Some(bracket) => bracket.low,
        None => {
            let lanes = basis.lanes.len().min(active * WIDTH);
            let reach = if lanes > 0 {
                basis.follow_flights.min(basis.follow[lanes - 1])
            } else {
                basis.follow_flights
            };
            let free = longest_trial::<A>([a[0] + lift, a[1], a[2], a[3], a[4]], r, reach, left);
            if free < left && lanes > 0 {
                enveloped::<A>(basis, lanes, signal, terms, left, free)
            } else {
                free
            }
        }
    };
    Assessment {
        jet: a,
        remainder: r,
        free,
        root,
    }
}

/// The longest of `best` and what is free of roots with the fastest lanes
/// enveloped, however many of them.
#[inline(always)]
fn enveloped<A: Arith>(
    basis: &Basis,
    lanes: usize,
    signal: &Signal,
    terms: &Terms,
    left: f64,
    mut best: f64,
) -> f64 {
    let lane = |order: usize, k: usize| terms.lanes[k / WIDTH].orders[order].0[k % WIDTH];
    let size = |k: usize| terms.lanes[k / WIDTH].size.0[k % WIDTH];
    let (mut value, mut rest) = (terms.slow[0], 0.0);
    for k in 0..lanes {
        rest += size(k);
    }
    let mut reach = basis.follow_flights;
    for k in 0..lanes {
        // All lanes before k followed, k and later enveloped.
        if value > rest && reach > best {
            let mut a = terms.slow;
            let mut r = signal.slow5();
            for i in 0..k {
                for (order, value) in a.iter_mut().enumerate() {
                    *value += lane(order, i);
                }
                r += size(i) * basis.fifth[i / WIDTH].0[i % WIDTH];
            }
            a[0] -= rest;
            best = best.max(longest_trial::<A>(a, r, reach, left));
            if best >= left {
                break;
            }
        }
        value += lane(0, k);
        rest -= size(k);
        reach = reach.min(basis.follow[k]);
    }
    best
}

/// The longest trial h ≤ `left`, found from `reach` downwards or upwards, on
/// which the quintic is proven not negative.
#[inline(always)]
fn longest_trial<A: Arith>(a: Jet, r: f64, reach: f64, left: f64) -> f64 {
    let mut top = reach.min(left);
    let free = trial::<A>(a, r, top);
    if free == top {
        // Nothing in sight: leap.
        while top < left {
            let next = (top * 8.0).min(left);
            if !stays_nonzero::<A>(a, r, next) {
                break;
            }
            top = next;
        }
        return top;
    }
    if free > 0.0 {
        return free;
    }
    for _ in 0..14 {
        top *= 0.04;
        let free = trial::<A>(a, r, top);
        if free > 0.0 {
            return free;
        }
    }
    0.0
}

/// Greatest of eight shares of `top` on which the quintic is proven not
/// negative; 0 when none is.
#[inline(always)]
fn trial<A: Arith>(a: Jet, r: f64, top: f64) -> f64 {
    let mut best = V::ZERO;
    for shares in LADDER {
        let h = shares * V::splat(top);
        let least = least_coefficient::<A>(a, r, h);
        let proven = h.zip(least, |h, least| if least >= 0.0 { h } else { 0.0 });
        best = best.max(proven);
    }
    best.greatest()
}

/// Least Bernstein coefficient on [0, h] of the quintic.
#[inline(always)]
fn least_coefficient<A: Arith>(a: Jet, r: f64, h: V) -> V {
    let f = V::splat;
    let h2 = h * h;
    let (p0, p1, p2) = (f(a[0]), h * f(a[1]), h2 * f(a[2] * 0.5));
    let (p3, p4) = (
        h2 * h * f(a[3] * (1.0 / 6.0)),
        h2 * h2 * f(a[4] * (1.0 / 24.0)),
    );
    let p5 = (h2 * h2) * (h * f(r * (1.0 / 120.0)));
    let b1 = p1.fma::<A>(f(0.2), p0);
    let b2 = p2.fma::<A>(f(0.1), p1.fma::<A>(f(0.4), p0));
    let b3 = p2.fma::<A>(f(0.3), p1.fma::<A>(f(0.6), p0)) + p3 * f(0.1);
    let b4 = p2.fma::<A>(f(0.6), p1.fma::<A>(f(0.8), p0)) + p3.fma::<A>(f(0.4), p4 * f(0.2));
    let b5 = (p0 + p1) + (p2 + p3) + (p4 - p5);
    p0.min(b1).min(b2.min(b3)).min(b4.min(b5))
}

#[inline(always)]
fn stays_nonzero<A: Arith>(a: Jet, r: f64, h: f64) -> bool {
    let h2 = h * h;
    let (p1, p2) = (a[1] * h, a[2] * h2 * 0.5);
    let (p3, p4) = (a[3] * h2 * h * (1.0 / 6.0), a[4] * h2 * h2 * (1.0 / 24.0));
    let p5 = r * (h2 * h2) * h * (1.0 / 120.0);
    let b4 = A::fma(p1, 0.8, a[0]) + A::fma(p2, 0.6, p3 * 0.4);
    // All at once: which of them fails first cannot be foreseen.
    (a[0] >= 0.0)
        & (A::fma(p1, 0.2, a[0]) >= 0.0)
        & (A::fma(p2, 0.1, A::fma(p1, 0.4, a[0])) >= 0.0)
        & (A::fma(p1, 0.6, a[0]) + A::fma(p2, 0.3, p3 * 0.1) >= 0.0)
        & (A::fma(p4, 0.2, b4) >= 0.0)
        & ((a[0] + p1) + (p2 + p3) + (p4 - p5) >= 0.0)
}

#[inline(always)]
fn greater(a: f64, b: f64) -> f64 {
    if a > b { a } else { b }
}

/// The first positive root of the parabola; not a number, or not positive,
/// where there is none.
#[inline(always)]
fn foresee<A: Arith>(a: Jet) -> f64 {
    let root = A::fma(a[1], a[1], -2.0 * a[0] * a[2]).sqrt();
    if a[1] < 0.0 {
        2.0 * a[0] / (root - a[1])
    } else {
        -(a[1] + root) / a[2]
    }
}

/// A root u of the parabola brought near to that of the quartic, by Halley's rule.
#[inline(always)]
fn predict<A: Arith>(a: Jet, u: f64) -> f64 {
    let (c2, c3, c4) = (a[2] * 0.5, a[3] * (1.0 / 6.0), a[4] * (1.0 / 24.0));
    let square = u * u;
    let (low, high) = (A::fma(u, a[1], a[0]), A::fma(u, c3, c2));
    let value = A::fma(square, A::fma(square, c4, high), low);
    let (low, high) = (
        A::fma(u, a[2], a[1]),
        A::fma(u, a[4] * (1.0 / 6.0), a[3] * 0.5),
    );
    let slope = A::fma(square, high, low);
    let bend = A::fma(square, a[4] * 0.5, A::fma(u, a[3], a[2]));
    u - value * slope / A::fma(slope, slope, -0.5 * value * bend)
}

/// Proves, where it can, that g has exactly one root in (0.9u, 1.1u) around
/// the predicted u and none before: the quintic is positive up to 0.9u, ġ is
/// negative between, and g(1.1u) is negative.
#[inline(always)]
fn certify<A: Arith>(a: Jet, r: f64, lift: f64, left: f64) -> Option<Bracket> {
    let u = foresee::<A>(a);
    // The root of the quartic is seldom so much nearer.
    if !(u > 0.0 && 0.5 * u < left) {
        return None;
    }
    let u = predict::<A>(a, u);
    let (low, high) = (0.9 * u, 1.1 * u);
    if !(u > 0.0 && low < left) {
        return None;
    }
    // ġ over [low, high] in Bernstein form, and what it may be off there.
    let off = r * (high * high) * (high * high) * (1.0 / 24.0);
    let w = high - low;
    let d0 = A::fma(low, a[4] * (1.0 / 6.0), a[3] * 0.5);
    let d0 = A::fma(low, A::fma(low, d0, a[2]), a[1]);
    let d1 = w * A::fma(low, A::fma(low, a[4] * 0.5, a[3]), a[2]);
    let d2 = w * w * 0.5 * A::fma(low, a[4], a[3]);
    let d3 = w * w * w * (1.0 / 6.0) * a[4];
    let c1 = A::fma(d1, 1.0 / 3.0, d0);
    let c2 = A::fma(d1 + d1 + d2, 1.0 / 3.0, d0);
    let steepest = greater(greater(d0, c1), greater(c2, d0 + d1 + d2 + d3)) + off;
    let (c2, c3, c4) = (a[2] * 0.5, a[3] * (1.0 / 6.0), a[4] * (1.0 / 24.0));
    let end = A::fma(high, A::fma(high, A::fma(high, c4, c3), c2), a[1]);
    let end = A::fma(high, end, a[0]) + off * high * 0.2;
    let free = stays_nonzero::<A>([a[0] + lift, a[1], a[2], a[3], a[4]], r, low);
    ((steepest < 0.0) & (end < 0.0) & free).then_some(Bracket {
        low,
        guess: u,
        high,
    })
}

/// Correction to the root from a point close to it: the reversed series
/// u = x(1 − x(α − x(2α² − β − x(5α³ − 5αβ + γ)))), x = −g/ġ, α = g̈/2ġ,
/// β = g⃛/6ġ, γ = g⁗/24ġ. A bound on what it leaves out relative to x,
/// r being one on |fifth derivative|.
#[inline(always)]
pub(crate) fn root_correction<A: Arith>(a: Jet, r: f64) -> (f64, f64) {
    let inverse = 1.0 / a[1];
    let x = -a[0] * inverse;
    let (alpha, beta) = (a[2] * 0.5 * inverse, a[3] * (1.0 / 6.0) * inverse);
    let gamma = a[4] * (1.0 / 24.0) * inverse;
    let (square, bend) = (alpha * alpha, alpha * x);
    let last = A::fma(5.0 * alpha, square - beta, gamma);
    let third = A::fma(-x, last, A::fma(2.0, square, -beta));
    let second = A::fma(-x, third, alpha);
    let u = x * A::fma(-x, second, 1.0);
    let fourth = (x * x) * (x * x);
    let lost = (r * fourth * inverse * (1.0 / 120.0)).abs() + 14.0 * (bend * bend) * (bend * bend);
    (u, lost)
}

#[cfg(test)]
mod tests {
    use super::super::lanes::Plain;
    use super::*;

    /// g(s) with fifth derivative bounded by r, worst case below the quartic.
    fn lowest(a: Jet, r: f64, s: f64) -> f64 {
        let last = a[4] / 24.0 - s * r / 120.0;
        a[0] + s * (a[1] + s * (a[2] / 2.0 + s * (a[3] / 6.0 + s * last)))
    }

    #[test]
    fn what_is_called_free_is_free_in_the_worst_case() {
        let mut found = 0;
        for i in 0..3000 {
            let u = |k: u64| {
                let x = (i as u64 * 7 + k).wrapping_mul(0x9e37_79b9_7f4a_7c15);
                (x >> 11) as f64 / (1u64 << 53) as f64 * 2.0 - 1.0
            };
            let a = [u(0).abs(), u(1) * 3.0, u(2) * 9.0, u(3) * 27.0, u(4) * 81.0];
            let r = u(5).abs() * 243.0;
            let h = longest_trial::<Plain>(a, r, 1.0, 5.0);
            for k in 0..=50 {
                assert!(lowest(a, r, h * k as f64 / 50.0) >= -1e-12, "{a:?} {r} {h}");
            }
            if let Some(root) = certify::<Plain>(a, r, 0.0, 5.0) {
                found += 1;
                for k in 0..=50 {
                    assert!(lowest(a, r, root.low * k as f64 / 50.0) >= -1e-12);
                }
                assert!(lowest(a, -r, root.high) < 0.0);
            }
        }
        assert!(found > 300, "{found}");
    }

    #[test]
    fn reversed_series_converges_to_fifth_order() {
        // g = e^{-s} − e^{-d}: all derivatives ∓e^{-s}.
        let error = |d: f64| {
            let a = [1.0 - (-d).exp(), -1.0, 1.0, -1.0, 1.0];
            let (u, lost) = root_correction::<Plain>(a, 1.0);
            let error = (u - d).abs();
            assert!(error <= lost * d + 1e-17, "{error:e} {lost:e}");
            error
        };
        assert!(error(0.02) / error(0.01) > 28.0);
        assert!(error(1e-3) < 1e-15);
    }
}
