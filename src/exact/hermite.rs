//! Bounds between two instants at which value and slope are known.
//!
//! With p the cubic that has f's values and slopes at the ends of an interval
//! of length h,
//!
//! f(s) = p(s) + f⁗(ξ)/24·(s − a)²(b − s)²  (the error of Hermite interpolation),
//!
//! and (s − a)²(b − s)² is h⁴/6 times the middle Bernstein polynomial of degree
//! four. So f lies between the two quartics whose Bernstein coefficients are
//! those of p with ∓M·h⁴/144 on the middle one, M ≥ |f⁗|: sixteen times nearer
//! than Taylor's remainder from one end, and exact where the slope vanishes.

use super::lanes::{Arith, V};

/// Four functionals and their slopes at an instant.
#[derive(Clone, Copy, Debug, Default)]
pub(crate) struct Point {
    pub(crate) s: f64,
    pub(crate) value: V,
    pub(crate) slope: V,
    /// Bound on the fourth derivatives from here on.
    pub(crate) fourth: V,
    /// Bound of all lanes together from here on.
    pub(crate) envelope: V,
}

/// Loss: what the quartics take on top of the cubic.
#[derive(Clone, Copy, Debug, Default)]
pub(crate) struct Loss {
    /// On the middle coefficient.
    pub(crate) middle: V,
    /// On every coefficient.
    pub(crate) flat: V,
}

/// Bounds of the four over an interval.
#[derive(Clone, Copy, Debug)]
pub(crate) struct Bounds {
    pub(crate) low: V,
    pub(crate) high: V,
}

/// Bounds between two points.
#[inline(always)]
pub(crate) fn enclose<A: Arith>(a: &Point, b: &Point, loss: &Loss) -> Bounds {
    let h = V::splat(b.s - a.s);
    let (first, last) = (h * a.slope, h * b.slope);
    let quarter = V::splat(0.25);
    let c1 = first.fma::<A>(quarter, a.value);
    let c3 = last.fma::<A>(-quarter, b.value);
    let c2 = (first - last).fma::<A>(V::splat(1.0 / 6.0), (a.value + b.value) * V::splat(0.5));
    let ends = (a.value.min(b.value), a.value.max(b.value));
    let low = ends.0.min(c1.min(c3)).min(c2 - loss.middle);
    let high = ends.1.max(c1.max(c3)).max(c2 + loss.middle);
    Bounds {
        low: low - loss.flat,
        high: high + loss.flat,
    }
}

/// Value and slope of one function at an instant.
#[derive(Clone, Copy, Debug, Default, PartialEq)]
pub(crate) struct End {
    pub(crate) s: f64,
    pub(crate) f: f64,
    pub(crate) g: f64,
}

/// Two ends.
#[derive(Clone, Copy, Debug, Default, PartialEq)]
pub(crate) struct Piece {
    pub(crate) a: End,
    pub(crate) b: End,
}

impl Piece {
    #[inline(always)]
    pub(crate) fn length(&self) -> f64 {
        self.b.s - self.a.s
    }

    /// Least and greatest Bernstein coefficient.
    #[inline(always)]
    pub(crate) fn range(&self, middle: f64, flat: f64) -> (f64, f64) {
        let h = self.length();
        let (a, b) = (self.a, self.b);
        let (c1, c3) = (a.f + 0.25 * h * a.g, b.f - 0.25 * h * b.g);
        let c2 = 0.5 * (a.f + b.f) + h * (a.g - b.g) / 6.0;
        let low = a.f.min(b.f).min(c1).min(c3).min(c2 - middle);
        let high = a.f.max(b.f).max(c1).max(c3).max(c2 + middle);
        (low - flat, high + flat)
    }

    /// Place of the cubic's summit; the middle when it has none well inside.
    #[inline(always)]
    pub(crate) fn extremum_place(&self) -> f64 {
        let h = self.length();
        let rise = 3.0 * (self.b.f - self.a.f);
        let (first, last) = (h * self.a.g, h * self.b.g);
        // p′(t) = first + 2·bend·t + cube·t².
        let bend = rise - 2.0 * first - last;
        let cube = 3.0 * (first + last) - 2.0 * rise;
        let root = (bend * bend - first * cube).sqrt();
        // The root where p′ falls.
        let t = if bend > 0.0 {
            -(bend + root) / cube
        } else {
            first / (root - bend)
        };
        well_inside(t)
    }

    /// Place where the cubic crosses zero between ends of opposite sign, roughly.
    #[inline(always)]
    pub(crate) fn zero_crossing(&self) -> f64 {
        let h = self.length();
        let (first, last) = (h * self.a.g, h * self.b.g);
        let rise = 3.0 * (self.b.f - self.a.f);
        let (bend, cube) = (rise - 2.0 * first - last, first + last - rise * 2.0 / 3.0);
        let (mut low, mut high) = (0.0, 1.0);
        // First by the cubic of the inverse function, where it is one.
        let fall = self.b.f - self.a.f;
        let u = -self.a.f / fall;
        let (start, end) = (fall / first, fall / last);
        let (mut t, tries) = if start > 0.0 && start < 3.0 && end > 0.0 && end < 3.0 {
            let v = 1.0 - u;
            (u * (v * (v * start - u * end) + u * (3.0 - 2.0 * u)), 1)
        } else {
            (u, 4)
        };
        for _ in 0..tries {
            let value = self.a.f + t * (first + t * (bend + t * cube));
            if (value > 0.0) == (self.a.f > 0.0) {
                low = t
            } else {
                high = t
            }
            let next = t - value / (first + t * (2.0 * bend + t * 3.0 * cube));
            t = if next > low && next < high {
                next
            } else {
                0.5 * (low + high)
            };
        }
        t
    }
}

/// t, or ½ when it is not well inside (0, 1).
#[inline(always)]
fn well_inside(t: f64) -> f64 {
    if t > 0.01 && t < 0.99 { t } else { 0.5 }
}

#[cfg(test)]
mod tests {
    use super::super::lanes::Plain;
    use super::*;

    /// f = sin(3s + φ) + s²/2 with f⁗ ≤ 81.
    fn end(s: f64, phase: f64) -> End {
        End {
            s,
            f: (3.0 * s + phase).sin() + 0.5 * s * s,
            g: 3.0 * (3.0 * s + phase).cos() + s,
        }
    }

    #[test]
    fn bounds_hold_between_the_points_and_are_near() {
        for i in 0..200 {
            let (phase, from) = (0.7 * f64::from(i), 0.1 * f64::from(i % 7) - 0.3);
            let h = 0.05 + 0.004 * f64::from(i);
            let piece = Piece {
                a: end(from, phase),
                b: end(from + h, phase),
            };
            let middle = 81.0 * h.powi(4) / 144.0;
            let (low, high) = piece.range(middle, 0.0);
            let point = |e: End| Point {
                s: e.s,
                value: V::splat(e.f),
                slope: V::splat(e.g),
                fourth: V::splat(81.0),
                envelope: V::ZERO,
            };
            let loss = Loss {
                middle: V::splat(middle),
                flat: V::ZERO,
            };
            let four = enclose::<Plain>(&point(piece.a), &point(piece.b), &loss);
            approx::assert_relative_eq!(four.low.0[1], low, epsilon = 1e-12);
            approx::assert_relative_eq!(four.high.0[2], high, epsilon = 1e-12);
            let (mut least, mut most) = (f64::INFINITY, f64::NEG_INFINITY);
            for k in 0..=100 {
                let f = end(from + h * f64::from(k) / 100.0, phase).f;
                assert!(f >= low - 1e-14 && f <= high + 1e-14, "{f} {low} {high}");
                (least, most) = (least.min(f), most.max(f));
            }
            // Bernstein coefficients of a quartic overshoot by a share of its bend.
            let slack = 2.0 * middle + 9.0 * h * h;
            assert!(low > least - slack && high < most + slack);
        }
    }

    #[test]
    fn a_flat_summit_is_not_overshot() {
        let summit = (std::f64::consts::FRAC_PI_2) / 3.0;
        let f = |s: f64| End {
            s,
            f: (3.0 * s).sin(),
            g: if s == summit {
                0.0
            } else {
                3.0 * (3.0 * s).cos()
            },
        };
        for h in [0.01, 0.1, 0.3] {
            let piece = Piece {
                a: f(summit),
                b: f(summit + h),
            };
            assert_eq!(piece.range(81.0 * h.powi(4) / 144.0, 0.0).1, 1.0);
        }
    }

    #[test]
    fn summits_and_crossings_of_the_cubic() {
        let piece = |a: f64, b: f64| Piece {
            a: end(a, 0.0),
            b: end(b, 0.0),
        };
        let t = piece(0.4, 0.8).extremum_place();
        assert!(end(0.4 + 0.4 * t, 0.0).g.abs() < 0.05, "{t}");
        let t = piece(-0.2, 0.25).zero_crossing();
        assert!(end(-0.2 + 0.45 * t, 0.0).f.abs() < 2e-3, "{t}");
        // None inside: the middle.
        assert_eq!(piece(0.0, 0.1).extremum_place(), 0.5);
    }
}
