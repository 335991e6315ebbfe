//! A law along a motion: U(φ(s)) as a power series, for any law.
//!
//! Laws are known by their values and derivatives at a place. Over the short way
//! that the driver goes in a step, U′ is taken as the polynomial of degree 8 that
//! has the true value and first two derivatives at the step's start and at a
//! distance r to both sides. It is exact for polynomial laws to degree 9; of a
//! sine it misses less than 0.06·(r·k)⁹/9! of the amplitude of U′, k its harmonic.

use crate::math::jet::Jet;
use crate::math::polynomial::{Coefficients, MAX_DEGREE, convolution_term};

/// Highest power of a series.
pub(crate) const HIGHEST: usize = MAX_DEGREE;

/// A power series in s.
pub(super) type Series = Coefficients;

/// Degree of the polynomial for U′.
const DEGREE: usize = 8;

/// Bounds on the greatest share of the last two coefficients in U′ over the whole
/// reach; what the polynomial leaves out is then some hundred times smaller.
const LAST: [f64; 2] = [1e-8, 1e-5];

/// Below the least of those the share falls with this power of the tolerance only: measured,
/// that is enough for errors of runs to fall with the tolerance down to 1e-12, where the
/// least share alone left some 1e-9.
const FINER: f64 = 0.5;

/// This share for a series of a degree, which follows the tolerance: ten times
/// less than that (`integrate::taylor::degree`) down to 1e-7.
pub(super) fn last(degree: usize) -> f64 {
    let digits = (degree as f64 - 6.0) / 1.25;
    let share = 10f64.powf(-1.0 - digits).min(LAST[1]);
    match share < LAST[0] {
        true => LAST[0] * (share / LAST[0]).powf(FINER),
        false => share,
    }
}

/// Way over which the polynomial of a law around a place, looked at within a radius, has
/// no more than the least share in its last two coefficients; at most `most`.
pub(in crate::dynamics::system) fn expansion_range(
    phi: f64,
    radius: f64,
    most: f64,
    jet: impl Fn(f64) -> Jet,
) -> f64 {
    let found = polynomial(jet(phi), jet(phi - radius), jet(phi + radius), radius);
    let [size, last] = sizes(&found);
    // What is not a number is not known over any way.
    match last > 0.0 || last.is_nan() {
        true => (radius * (LAST[0] * size / last).powf(1.0 / DEGREE as f64)).min(most),
        false => most,
    }
}

/// Greatest of all coefficients and of the last two.
fn sizes(polynomial: &[f64; DEGREE + 1]) -> [f64; 2] {
    let greatest = |sum: f64, c: &f64| sum.max(c.abs());
    [
        polynomial.iter().fold(0.0, greatest),
        polynomial[DEGREE - 1..].iter().fold(0.0, greatest),
    ]
}

/// What rounding may put into a coefficient: so many times that of U′, near whose zeros
/// the terms of size U″ and U‴ that it is the difference of count. Taken for a bend of the
/// law it would shorten steps, and all the more relative to what is left, the shorter they are.
const COEFFICIENT_ROUNDING: f64 = 64.0 * f64::EPSILON;

/// Powers whose share of U′ is below this are left out.
const NEGLIGIBLE: f64 = 1e-18;

/// Coefficients c_j of the polynomial Σ c_j·x^j for f = U′ over x = Δφ/r with
/// the values, first and second derivatives of three jets of U, at x = 0, −1
/// and 1.
pub(super) fn polynomial(middle: Jet, below: Jet, above: Jet, radius: f64) -> [f64; DEGREE + 1] {
    let (r, rr) = (radius, radius * radius);
    let (c0, c1, c2) = (middle.first, r * middle.second, 0.5 * rr * middle.third);
    let half_sum = |a: f64, b: f64| 0.5 * (a + b);
    // Odd powers from differences of f and f″ and the sum of f′ …
    let a = half_sum(above.first, -below.first) - c1;
    let b = r * half_sum(above.second, below.second) - c1;
    let c = rr * half_sum(above.third, -below.third);
    let c7 = (c - 7.0 * b + 15.0 * a) / 8.0;
    let c5 = 0.5 * (b - 3.0 * a) - 2.0 * c7;
    let c3 = a - c5 - c7;
    // … and even ones the other way round.
    let a = half_sum(above.first, below.first) - c0 - c2;
    let b = r * half_sum(above.second, -below.second) - 2.0 * c2;
    let c = rr * half_sum(above.third, below.third) - 2.0 * c2;
    let c8 = (c - 9.0 * b + 24.0 * a) / 8.0;
    let c6 = 0.5 * (b - 4.0 * a) - 2.0 * c8;
    let c4 = a - c6 - c8;
    [c0, c1, c2, c3, c4, c5, c6, c7, c8]
}

/// Factor by which a step is too long for the polynomial of a prescribed motion over a
/// time `radius` to both sides of `time`, when the last two coefficients may have a share
/// `allowed`. At least 1, or 0 where the polynomial is the motion itself.
///
/// The share is one of the change of speed: what a machine answers to is not the mean speed.
pub(super) fn excess_in_time(
    speeds: &[f64; DEGREE + 1],
    middle: Jet,
    time: f64,
    radius: f64,
    allowed: f64,
) -> f64 {
    let greatest = |list: &[f64]| list.iter().fold(0.0, |sum: f64, c| greater(sum, c.abs()));
    let bends = (radius + time.abs()) * (middle.second.abs() + radius * middle.third.abs());
    let rounding = COEFFICIENT_ROUNDING * (middle.first.abs() + bends);
    let last = greatest(&speeds[DEGREE - 1..]) - rounding;
    let size = greatest(&speeds[1..]);
    // (A way below the rounding of the displacement is none.)
    if last <= 0.0 || last * radius <= COEFFICIENT_ROUNDING * middle.value.abs() {
        return 0.0;
    }
    // What is not a number is not known over any time.
    greater(1.0, (last / (allowed * size)).powf(1.0 / DEGREE as f64))
}

/// The greater of two; not a number where either is none.
fn greater(one: f64, other: f64) -> f64 {
    if other > one || other.is_nan() {
        other
    } else {
        one
    }
}

/// U, U′ and U″ along a motion.
#[derive(Clone, Debug)]
pub(super) struct LawSeries {
    /// U.
    pub(super) value: Series,
    /// U′.
    pub(super) first: Series,
    /// U″.
    pub(super) second: Series,
    /// r.
    radius: f64,
    /// c_j.
    polynomial: [f64; DEGREE + 1],
    /// Factor by which r is too great for the polynomial to be good.
    excess: f64,
    /// Number of powers x¹ … that count.
    terms: usize,
    /// x^(j+1).
    powers: [Series; DEGREE + 1],
}

impl Default for LawSeries {
    fn default() -> Self {
        Self {
            value: [0.0; HIGHEST + 1],
            first: [0.0; HIGHEST + 1],
            second: [0.0; HIGHEST + 1],
            radius: 1.0,
            polynomial: [0.0; DEGREE + 1],
            excess: 1.0,
            terms: 1,
            powers: [[0.0; HIGHEST + 1]; DEGREE + 1],
        }
    }
}

impl LawSeries {
    /// Begins anew around a driver's displacement `phi`; the last two coefficients
    /// may have a share `allowed` of U′.
    pub(super) fn begin_around(
        &mut self,
        phi: f64,
        radius: f64,
        allowed: f64,
        jet: impl Fn(f64) -> Jet,
    ) {
        let middle = jet(phi);
        self.radius = radius;
        self.polynomial = polynomial(middle, jet(phi - radius), jet(phi + radius), radius);
        let [size, last] = sizes(&self.polynomial);
        let bends = (1.0 + phi.abs()) * (middle.second.abs() + middle.third.abs());
        let last = (last - COEFFICIENT_ROUNDING * (middle.first.abs() + bends)).max(0.0);
        self.excess = (last / (allowed * size)).powf(1.0 / DEGREE as f64).max(1.0);
        // What is not a number counts.
        let counts = |c: &f64| !(c.abs() <= NEGLIGIBLE * size);
        let last = self.polynomial.iter().rposition(counts).unwrap_or(0);
        self.terms = last + 1;
        self.value[0] = middle.value;
        self.first[0] = middle.first;
        self.second[0] = middle.second;
    }

    /// Begins a law of constant ratio.
    pub(super) fn begin_straight(&mut self, jet: Jet) {
        self.radius = 1.0;
        self.excess = 1.0;
        self.polynomial = [0.0; DEGREE + 1];
        self.polynomial[0] = jet.first;
        self.terms = 1;
        self.value[0] = jet.value;
        self.first[0] = jet.first;
        self.second[0] = 0.0;
    }

    /// The next coefficients, all those before being known: the driver's
    /// displacement has the coefficient `phi` at this `order` ≥ 1.
    pub(super) fn next_coefficients(&mut self, order: usize, phi: f64) {
        let c = &self.polynomial;
        let x = phi / self.radius;
        self.powers[0][order] = x;
        let (mut value, mut first, mut second) = (c[0] * x, 0.0, 0.0);
        if self.terms > 1 {
            first = c[1] * x;
            second = 2.0 * c[2] * x;
        }
        for j in 1..self.terms {
            // x^(j+1) = x^j·x begins with s^(j+1).
            let (known, rest) = self.powers.split_at_mut(j);
            let power = if order > j {
                convolution_term(&known[j - 1][j..order], &known[0][1..=order - j])
            } else {
                0.0
            };
            rest[0][order] = power;
            value += c[j] / (j + 1) as f64 * power;
            if j < DEGREE {
                first += c[j + 1] * power;
            }
            if j + 2 <= DEGREE {
                second += (j + 2) as f64 * c[j + 2] * power;
            }
        }
        self.value[order] = self.radius * value;
        self.first[order] = first;
        self.second[order] = second / self.radius;
    }

    /// Σ|x_k| of the driver's way over the whole step, in units of what the
    /// polynomial is good for.
    pub(super) fn relative_travel(&self, degree: usize) -> f64 {
        let sizes = self.powers[0][1..=degree].iter().map(|x| x.abs());
        self.excess * sizes.sum::<f64>()
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::kinematics::position::Position;

    /// Composed with φ(s) = 0.4 + 0.2·s − 0.05·s², against the law itself.
    fn errors(position: &Position) -> [f64; 3] {
        let mut law = LawSeries::default();
        law.begin_around(0.4, 0.2, LAST[0], |phi| position.jet(0, phi));
        for order in 1..=HIGHEST {
            law.next_coefficients(order, [0.0, 0.2, -0.05].get(order).copied().unwrap_or(0.0));
        }
        let at = |series: &Series, s: f64| series.iter().rev().fold(0.0, |sum, c| sum * s + c);
        let mut errors = [0.0f64; 3];
        for k in 0..=10 {
            let s = 0.1 * f64::from(k);
            let jet = position.jet(0, 0.4 + 0.2 * s - 0.05 * s * s);
            let pairs = [
                (&law.value, jet.value),
                (&law.first, jet.first),
                (&law.second, jet.second),
            ];
            for (error, (series, exact)) in errors.iter_mut().zip(pairs) {
                *error = error.max((at(series, s) - exact).abs());
            }
        }
        errors
    }

    #[test]
    fn rounding_is_no_bend_of_a_law() {
        // Beside its dead centre, at a great angle, over ways from far too long to minute.
        let sine = Position::Sine {
            amplitude: 0.04,
            harmonic: 1.0,
            phase: 0.0,
            offset: 0.0,
        };
        let excess = |radius: f64| {
            let mut law = LawSeries::default();
            let phi = 4.5 * std::f64::consts::PI + 0.1 * radius;
            law.begin_around(phi, radius, last(20), |phi| sine.jet(0, phi));
            law.excess
        };
        assert!(excess(1.0) > 2.0);
        for digits in 2..=14 {
            let radius = 10f64.powi(-digits);
            assert_eq!(excess(radius), 1.0, "{radius:e}");
        }
    }

    #[test]
    fn a_way_is_as_long_as_the_law_is_known() {
        let sine = |harmonic: f64| Position::Sine {
            amplitude: 1.0,
            harmonic,
            phase: 0.3,
            offset: 0.0,
        };
        let known = |law: &Position| expansion_range(0.4, 0.1, 1.0, |phi| law.jet(0, phi));
        let (one, five) = (known(&sine(1.0)), known(&sine(5.0)));
        approx::assert_relative_eq!(one / five, 5.0, max_relative = 0.25);
        // There the last two coefficients have about the share allowed.
        let jet = |phi: f64| sine(5.0).jet(0, phi);
        let found = polynomial(jet(0.4), jet(0.4 - five), jet(0.4 + five), five);
        let [size, last] = sizes(&found);
        let share = last / (LAST[0] * size);
        assert!((0.3..3.0).contains(&share), "{share}");
        assert!(known(&Position::Polynomial(vec![0.0, 0.0, 1.0])) > 0.8);
    }

    #[test]
    fn polynomials_are_exact_and_smooth_laws_as_good_as_stated() {
        let power = Position::Polynomial(vec![0.3, -1.0, 0.5, 0.2, -0.7, 0.1, 0.0, 0.4]);
        let bounds = |law: &Position, bounds: [f64; 3]| {
            for (error, bound) in errors(law).into_iter().zip(bounds) {
                assert!(error <= bound, "{error:e} {bound:e}");
            }
        };
        bounds(&power, [1e-15, 1e-14, 1e-12]);
        let sine = Position::Sine {
            amplitude: 1.0,
            harmonic: 2.0,
            phase: 0.3,
            offset: 0.0,
        };
        // 2·0.06·0.4⁹/9! = 9e-11, integrated over 0.2; U″ one power of r worse.
        bounds(&sine, [2e-11, 9e-11, 2e-9]);
        assert!(errors(&sine)[0] > 1e-15);
    }
}
