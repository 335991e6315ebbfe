//! How far a signal certainly stays positive, and where it certainly has one root.
//!
//! Over [0, h] every lane is either *followed*, with its derivatives of order
//! 0 … 3 and |c||λ|⁴ in the remainder (Re λ ≤ 0: the value at the left end is a
//! bound on the whole interval), or *enveloped*: it takes |c| off the constant
//! and nothing else. Any split is valid. Then
//!
//! g(s) ≥ a₀ + a₁s + a₂s²/2 + a₃s³/6 − R·s⁴/24 on [0, h],
//!
//! and this quartic is not negative if its five Bernstein coefficients are not.

use super::basis::Basis;
use super::lanes::{Arith, V, WIDTH};
use super::signal::{Signal, Terms};

/// What is known of a signal from one evaluation.
#[derive(Clone, Copy, Debug, Default)]
pub(crate) struct Assessment {
    /// g, ġ, g̈, g⃛ now.
    pub(crate) jet: [f64; 4],
    /// Bound on |fourth derivative| from now on.
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

/// Assesses `signal` from `terms`, up to `left` ahead.
#[inline(always)]
pub(crate) fn assess<A: Arith>(
    basis: &Basis,
    active: usize,
    signal: &Signal,
    terms: &Terms,
    s: f64,
    left: f64,
) -> Assessment {
    let (mut a, r) = terms.jet(basis, active, signal.slow4());
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
            let free = longest::<A>([a[0] + lift, a[1], a[2], a[3]], r, reach, left);
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
    let blocks = basis.blocks;
    let lane = |order: usize, k: usize| terms.lane[order * blocks + k / WIDTH].0[k % WIDTH];
    let (mut value, mut rest) = (terms.slow[0], 0.0);
    for k in 0..lanes {
        rest += lane(4, k);
    }
    let mut reach = basis.follow_flights;
    for k in 0..lanes {
        // All lanes before k followed, k and later enveloped.
        if value > rest && reach > best {
            let mut a = terms.slow;
            let mut r = signal.slow4();
            for i in 0..k {
                for (order, value) in a.iter_mut().enumerate() {
                    *value += lane(order, i);
                }
                r += lane(4, i) * basis.fourth[i / WIDTH].0[i % WIDTH];
            }
            a[0] -= rest;
            best = best.max(longest::<A>(a, r, reach, left));
            if best >= left {
                break;
            }
        }
        value += lane(0, k);
        rest -= lane(4, k);
        reach = reach.min(basis.follow[k]);
    }
    best
}

/// The longest trial h ≤ `left`, found from `reach` downwards or upwards, on
/// which the quartic is proven not negative.
#[inline(always)]
fn longest<A: Arith>(a: [f64; 4], r: f64, reach: f64, left: f64) -> f64 {
    let mut top = reach.min(left);
    let free = trial::<A>(a, r, top);
    if free == top {
        // Nothing in sight: leap.
        while top < left {
            let next = (top * 8.0).min(left);
            if !passes(a, r, next) {
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

/// Greatest of eight shares of `top` on which the quartic is proven not
/// negative; 0 when none is.
#[inline(always)]
fn trial<A: Arith>(a: [f64; 4], r: f64, top: f64) -> f64 {
    let mut best = V::ZERO;
    for shares in LADDER {
        let h = shares * V::splat(top);
        let least = least_coefficient::<A>(a, r, h);
        let proven = h.zip(least, |h, least| if least >= 0.0 { h } else { 0.0 });
        best = best.max(proven);
    }
    best.greatest()
}

/// Least Bernstein coefficient on [0, h] of the quartic.
#[inline(always)]
fn least_coefficient<A: Arith>(a: [f64; 4], r: f64, h: V) -> V {
    let f = V::splat;
    let (p0, p1) = (f(a[0]), h * f(a[1]));
    let h2 = h * h;
    let (p2, p3) = (h2 * f(a[2] * 0.5), h2 * h * f(a[3] / 6.0));
    let b1 = p1.fma::<A>(f(0.25), p0);
    let b2 = p2.fma::<A>(f(1.0 / 6.0), p1.fma::<A>(f(0.5), p0));
    let b3 = p2.fma::<A>(f(0.5), p1.fma::<A>(f(0.75), p0)) + p3 * f(0.25);
    let b4 = (p0 + p1) + (p2 + p3) - h2 * h2 * f(r / 24.0);
    p0.min(b1).min(b2.min(b3)).min(b4)
}

#[inline(always)]
fn passes(a: [f64; 4], r: f64, h: f64) -> bool {
    let (p1, h2) = (a[1] * h, h * h);
    let (p2, p3) = (a[2] * h2 * 0.5, a[3] * h2 * h / 6.0);
    // All at once: which of them fails first cannot be foreseen.
    (a[0] >= 0.0)
        & (a[0] + 0.25 * p1 >= 0.0)
        & (a[0] + 0.5 * p1 + p2 / 6.0 >= 0.0)
        & (a[0] + 0.75 * p1 + 0.5 * p2 + 0.25 * p3 >= 0.0)
        & (a[0] + p1 + p2 + p3 - r * h2 * h2 / 24.0 >= 0.0)
}

/// The first positive root of the parabola; not a number, or not positive,
/// where there is none.
#[inline(always)]
fn foresee<A: Arith>(a: [f64; 4]) -> f64 {
    let root = A::fma(a[1], a[1], -2.0 * a[0] * a[2]).sqrt();
    if a[1] < 0.0 {
        2.0 * a[0] / (root - a[1])
    } else {
        -(a[1] + root) / a[2]
    }
}

/// A root u of the parabola brought near to that of the cubic, by Halley's rule.
#[inline(always)]
fn predict<A: Arith>(a: [f64; 4], u: f64) -> f64 {
    let value = A::fma(u, A::fma(u, A::fma(u, a[3] / 6.0, a[2] * 0.5), a[1]), a[0]);
    let slope = A::fma(u, A::fma(u, a[3] * 0.5, a[2]), a[1]);
    let bend = A::fma(u, a[3], a[2]);
    u - value * slope / A::fma(slope, slope, -0.5 * value * bend)
}

/// Proves, where it can, that g has exactly one root in (0.9u, 1.1u) around
/// the predicted u and none before: the quartic is positive up to 0.9u, ġ is
/// negative between, and g(1.1u) is negative.
#[inline(always)]
fn certify<A: Arith>(a: [f64; 4], r: f64, lift: f64, left: f64) -> Option<Bracket> {
    let u = foresee::<A>(a);
    // The root of the cubic is seldom so much nearer.
    if !(u > 0.0 && 0.5 * u < left) {
        return None;
    }
    let u = predict::<A>(a, u);
    let (low, high) = (0.9 * u, 1.1 * u);
    if !(u > 0.0 && low < left) {
        return None;
    }
    let fast = r * high * high * high / 6.0;
    let slope = |s: f64| a[1] + s * (a[2] + s * (a[3] * 0.5));
    let bend = a[2] + low * a[3];
    let (first, last) = (slope(low), slope(high));
    let middle = first + bend * (high - low) * 0.5;
    let steepest = first.max(last).max(middle) + fast;
    let end = a[0] + high * (a[1] + high * (a[2] * 0.5 + high * (a[3] / 6.0))) + fast * high * 0.25;
    let free = passes([a[0] + lift, a[1], a[2], a[3]], r, low);
    ((steepest < 0.0) & (end < 0.0) & free).then_some(Bracket {
        low,
        guess: u,
        high,
    })
}

/// Correction to the root from a point close to it: the reversed cubic series
/// u = x(1 − x(α − x(2α² − β))), x = −g/ġ, α = g̈/2ġ, β = g⃛/6ġ.
#[inline(always)]
pub(crate) fn reversed(a: [f64; 4]) -> f64 {
    let inverse = 1.0 / a[1];
    let x = -a[0] * inverse;
    let (alpha, beta) = (a[2] * 0.5 * inverse, a[3] / 6.0 * inverse);
    x * (1.0 - x * (alpha - x * (2.0 * alpha * alpha - beta)))
}

#[cfg(test)]
mod tests {
    use super::super::lanes::Plain;
    use super::*;

    /// g(s) with fourth derivative bounded by r, worst case below the cubic.
    fn lowest(a: [f64; 4], r: f64, s: f64) -> f64 {
        a[0] + s * (a[1] + s * (a[2] / 2.0 + s * (a[3] / 6.0 - s * r / 24.0)))
    }

    #[test]
    fn what_is_called_free_is_free_in_the_worst_case() {
        let mut found = 0;
        for i in 0..3000 {
            let u = |k: u64| {
                let x = (i as u64 * 7 + k).wrapping_mul(0x9e37_79b9_7f4a_7c15);
                (x >> 11) as f64 / (1u64 << 53) as f64 * 2.0 - 1.0
            };
            let a = [u(0).abs(), u(1) * 3.0, u(2) * 9.0, u(3) * 27.0];
            let r = u(4).abs() * 81.0;
            let h = longest::<Plain>(a, r, 1.0, 5.0);
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
    fn reversed_series_converges_to_fourth_order() {
        // g = e^{-s} − e^{-0.01}: all derivatives ∓e^{-s}.
        let error = |d: f64| {
            let a = [1.0 - (-d).exp(), -1.0, 1.0, -1.0];
            (reversed(a) - d).abs()
        };
        assert!(error(0.02) / error(0.01) > 14.0);
        assert!(error(1e-4) < 1e-16);
    }
}
