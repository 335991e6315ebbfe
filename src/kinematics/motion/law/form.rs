//! Formulas of pieces of laws of motion.

use super::polynomial::EndPolynomial;
use super::trapezoid::{Trapezoid, TrapezoidPart};
use crate::math::fourier::Terms;
use crate::math::jet::Jet;
use std::f64::consts::PI;

/// A formula on the unit interval.
#[derive(Clone, Debug, PartialEq)]
pub(super) enum Form {
    /// (1 − cos πx)/2.
    Harmonic,
    /// x − sin(2πx)/2π.
    Cycloidal,
    /// 10x³ − 15x⁴ + 6x⁵.
    Polynomial345,
    /// 35x⁴ − 84x⁵ + 70x⁶ − 20x⁷.
    Polynomial4567,
    /// A part of a modified trapezoid.
    Trapezoid(Trapezoid, TrapezoidPart),
    /// x.
    Uniform,
    /// Σ c_k·xᵏ.
    Cubic([f64; 4]),
    /// Conditions at both ends.
    Polynomial(EndPolynomial),
}

impl Form {
    /// Value and derivatives at `x`.
    pub(super) fn jet(&self, x: f64) -> Jet {
        match self {
            Self::Harmonic => harmonic(x),
            Self::Cycloidal => cycloidal(x),
            Self::Polynomial345 => polynomial345(x),
            Self::Polynomial4567 => polynomial4567(x),
            Self::Trapezoid(law, part) => law.jet(*part, x),
            Self::Uniform => Jet {
                value: x,
                first: 1.0,
                ..Jet::default()
            },
            Self::Cubic([a, b, c, d]) => Jet {
                value: a + x * (b + x * (c + x * d)),
                first: b + x * (2.0 * c + x * 3.0 * d),
                second: 2.0 * c + x * 6.0 * d,
                third: 6.0 * d,
            },
            Self::Polynomial(polynomial) => polynomial.jet(x),
        }
    }
}

impl Form {
    /// The same in closed form on the interval about `place[0]` of half the length `place[1]`.
    pub(super) fn terms(&self, place: [f64; 2]) -> Terms {
        let powers = |powers: &[f64]| Terms::of_powers(powers, place);
        match self {
            Self::Harmonic => powers(&[0.5]).plus_sine([-0.5, PI, 0.5 * PI], place),
            Self::Cycloidal => {
                let turn = 2.0 * PI;
                powers(&[0.0, 1.0]).plus_sine([-1.0 / turn, turn, 0.0], place)
            }
            Self::Polynomial345 => powers(&[0.0, 0.0, 0.0, 10.0, -15.0, 6.0]),
            Self::Polynomial4567 => powers(&[0.0, 0.0, 0.0, 0.0, 35.0, -84.0, 70.0, -20.0]),
            Self::Trapezoid(law, part) => law.terms(*part, place),
            Self::Uniform => powers(&[0.0, 1.0]),
            Self::Cubic(own) => powers(own),
            Self::Polynomial(own) => own.terms(place),
        }
    }
}

fn harmonic(tau: f64) -> Jet {
    let half = (0.5 * PI * tau).sin();
    let (sin, cos) = (PI * tau).sin_cos();
    Jet {
        value: half * half,
        first: 0.5 * PI * sin,
        second: 0.5 * PI * PI * cos,
        third: -0.5 * PI * PI * PI * sin,
    }
}

fn cycloidal(tau: f64) -> Jet {
    let turn = 2.0 * PI;
    let (sin, cos) = (turn * tau).sin_cos();
    let half = (PI * tau).sin();
    Jet {
        value: tau - sin / turn,
        first: 2.0 * half * half,
        second: turn * sin,
        third: turn * turn * cos,
    }
}

/// Derivatives in factored form: they vanish at both ends without rounding.
fn polynomial345(tau: f64) -> Jet {
    let rest = 1.0 - tau;
    let product = tau * rest;
    Jet {
        value: tau * tau * tau * (10.0 + tau * (6.0 * tau - 15.0)),
        first: 30.0 * product * product,
        second: 60.0 * product * (rest - tau),
        third: 60.0 * (1.0 - 6.0 * product),
    }
}

fn polynomial4567(tau: f64) -> Jet {
    let rest = 1.0 - tau;
    let product = tau * rest;
    let square = tau * tau;
    Jet {
        value: square * square * (35.0 + tau * (tau * (70.0 - 20.0 * tau) - 84.0)),
        first: 140.0 * product * product * product,
        second: 420.0 * product * product * (rest - tau),
        third: 840.0 * product * (1.0 - 5.0 * product),
    }
}
