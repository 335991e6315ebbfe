//! The law L(t) that the driver prescribes, in a form that can be integrated exactly.
//!
//! A law is a sequence of *spans*. On each, L is a sum of harmonics and a
//! polynomial; at the joint of two spans the propagation is restarted (a
//! planned break, no search needed for it).

use super::lanes::{Arith, Plain, ROUND, SIN_COS_LIMIT, sin_cos_one};
use nalgebra::Complex;
use std::fmt;
use std::sync::Arc;

/// Highest degree of the polynomial that a span's L̈ may have.
pub const LAW_DEGREE: usize = 12;

/// The law over time.
#[derive(Clone, Debug)]
pub enum Law {
    /// L = mean + slope·t + Σ amplitude·sin(frequency·t + phase), for ever.
    Harmonic {
        /// Constant part.
        mean: f64,
        /// Linear part.
        slope: f64,
        /// The sines.
        sines: Vec<Sine>,
    },
    /// Spans made when they are reached.
    Spans(Arc<dyn SpanSource>),
}

/// amplitude·sin(frequency·t + phase).
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Sine {
    /// Amplitude (rad).
    pub amplitude: f64,
    /// Angular frequency (rad/s), > 0.
    pub frequency: f64,
    /// Phase at t = 0 (rad).
    pub phase: f64,
}

/// A law in polynomial spans.
pub trait SpanSource: fmt::Debug + Send + Sync {
    /// The span in force just after `time`.
    fn span(&self, time: f64) -> PolynomialSpan;
}

/// L on an interval: value and speed at its start, and L̈ as a polynomial in
/// τ = t − start.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct PolynomialSpan {
    /// Start (s).
    pub start: f64,
    /// Rounding error of `start` (s).
    pub low: f64,
    /// End (s), +∞ for ever.
    pub end: f64,
    /// L at the start.
    pub value: f64,
    /// L̇ at the start.
    pub speed: f64,
    /// Coefficients of L̈ in powers of τ.
    pub acceleration: [f64; LAW_DEGREE + 1],
}

/// Forcing of a phase, from its start to the end of the span.
#[derive(Clone, Debug)]
pub(crate) struct Forcing {
    /// End of validity (s).
    pub(crate) end: f64,
    /// e^{iΩt}-amplitude of each harmonic at the phase's start: L ∋ Re(z).
    pub(crate) harmonics: Vec<Complex<f64>>,
    /// L without harmonics at the phase's start, in powers of the local time:
    /// value, slope, and the doubly integrated polynomial of L̈.
    pub(crate) law: [f64; LAW_DEGREE + 3],
    /// Highest power in `law` that is not zero.
    pub(crate) degree: usize,
    /// Longest time that it holds for besides (s).
    pub(crate) reach: f64,
}

impl Law {
    /// Angular frequencies of the harmonics.
    pub(crate) fn frequencies(&self) -> impl ExactSizeIterator<Item = f64> + '_ {
        let sines: &[Sine] = match self {
            Self::Harmonic { sines, .. } => sines,
            Self::Spans(_) => &[],
        };
        sines.iter().map(|sine| sine.frequency)
    }

    /// L and L̇ at an instant.
    pub fn at(&self, time: f64) -> (f64, f64) {
        let mut forcing = self.forcing();
        self.start::<Plain>(time, 0.0, &mut None, &mut forcing);
        let (mut value, mut speed) = (forcing.law[0], forcing.law[1]);
        for (z, omega) in forcing.harmonics.iter().zip(self.frequencies()) {
            value += z.re;
            speed -= omega * z.im;
        }
        (value, speed)
    }

    /// L, L̇ and L̈ just after an instant, a double-double.
    pub(crate) fn jet(&self, (time, low): (f64, f64)) -> [f64; 3] {
        let mut forcing = self.forcing();
        self.start::<Plain>(time, low, &mut None, &mut forcing);
        let [mut value, mut speed] = [forcing.law[0], forcing.law[1]];
        let mut acceleration = 2.0 * forcing.law[2];
        for (z, omega) in forcing.harmonics.iter().zip(self.frequencies()) {
            value += z.re;
            speed -= omega * z.im;
            acceleration -= omega * omega * z.re;
        }
        [value, speed, acceleration]
    }

    /// An empty forcing with room for this law's harmonics.
    pub(crate) fn forcing(&self) -> Forcing {
        Forcing {
            end: f64::INFINITY,
            harmonics: vec![Complex::new(0.0, 0.0); self.frequencies().len()],
            law: [0.0; LAW_DEGREE + 3],
            degree: 0,
            reach: f64::INFINITY,
        }
    }

    /// Fills in the forcing of a phase that starts at `time` + `low`
    /// (a double-double) inside `span`, the span last asked for.
    #[inline(always)]
    pub(crate) fn start<A: Arith>(
        &self,
        time: f64,
        low: f64,
        span: &mut Option<PolynomialSpan>,
        out: &mut Forcing,
    ) {
        match self {
            Self::Harmonic { mean, slope, sines } => {
                for (z, sine) in out.harmonics.iter_mut().zip(sines) {
                    let theta =
                        phase_angle::<A>(sine.frequency, time) + sine.frequency * low + sine.phase;
                    let near = theta.abs() < SIN_COS_LIMIT;
                    let (sin, cos) = if near {
                        sin_cos_one::<A>(theta)
                    } else {
                        theta.sin_cos()
                    };
                    // A sin θ = Re(−iA e^{iθ}).
                    *z = Complex::new(sine.amplitude * sin, -sine.amplitude * cos);
                }
                if out.reach < f64::INFINITY {
                    // What harmonics at resonance have left.
                    out.law.fill(0.0);
                    out.reach = f64::INFINITY;
                }
                out.law[0] = mean + slope * time;
                out.law[1] = *slope;
                out.degree = usize::from(*slope != 0.0);
            }
            Self::Spans(source) => {
                if span.is_none_or(|s| time < s.start || time >= s.end) {
                    *span = Some(source.span(time));
                }
                let span = span.expect("a span was just made");
                out.end = span.end;
                recentre(&span, (time - span.start) + (low - span.low), out);
            }
        }
    }
}

/// frequency·time modulo 2π: the product is split so that its own rounding
/// does not count, then reduced.
#[inline(always)]
fn phase_angle<A: Arith>(frequency: f64, time: f64) -> f64 {
    let (product, error) = A::product(frequency, time);
    const TWO_PI_LOW: f64 = 2.449_293_598_294_706_4e-16;
    let turns = (product * (1.0 / std::f64::consts::TAU) + ROUND) - ROUND;
    let (whole, lost) = A::product(turns, std::f64::consts::TAU);
    (product - whole) - lost - turns * TWO_PI_LOW + error
}

/// a·b as a sum of two numbers, on every processor the same.
#[inline(always)]
pub(crate) fn product(a: f64, b: f64) -> (f64, f64) {
    Plain::product(a, b)
}

/// The span's law as a polynomial in the time from `tau` on.
#[inline(never)]
fn recentre(span: &PolynomialSpan, tau: f64, out: &mut Forcing) {
    let mut law = [0.0; LAW_DEGREE + 3];
    law[0] = span.value;
    law[1] = span.speed;
    for (k, a) in span.acceleration.iter().enumerate() {
        law[k + 2] = a / ((k + 1) as f64 * (k + 2) as f64);
    }
    let degree = law.iter().rposition(|c| *c != 0.0).unwrap_or(0);
    if tau != 0.0 {
        shift(&mut law[..=degree], tau);
    }
    out.law = law;
    out.degree = degree;
}

/// Taylor shift: p(x) → p(x + by), by repeated synthetic division.
pub(crate) fn shift(coefficients: &mut [f64], by: f64) {
    let n = coefficients.len();
    for i in 0..n {
        for k in (i..n - 1).rev() {
            coefficients[k] += by * coefficients[k + 1];
        }
    }
}

#[cfg(test)]
mod tests {
    use super::super::lanes::FusedMultiplyAdd;
    use super::*;

    #[test]
    fn a_shifted_polynomial_has_the_same_values() {
        let mut c = [1.0, -2.0, 0.5, 3.0];
        shift(&mut c, 0.7);
        let p = |x: f64| 1.0 - 2.0 * x + 0.5 * x * x + 3.0 * x * x * x;
        let x = 0.3;
        approx::assert_relative_eq!(
            c[0] + x * (c[1] + x * (c[2] + x * c[3])),
            p(x + 0.7),
            max_relative = 1e-14
        );
    }

    #[test]
    fn the_phase_of_a_harmonic_is_reduced_without_loss() {
        // 10⁶ turns and a quarter, with a frequency whose product rounds.
        let frequency = 62.831_853_071_795_86;
        let time = 100_000.025;
        let (p, e) = Plain::product(frequency, time);
        assert_eq!(FusedMultiplyAdd::product(frequency, time), (p, e));
        let reference = (p % std::f64::consts::TAU) + e;
        let close = |turn: fn(f64, f64) -> f64| {
            let difference = turn(frequency, time) - reference;
            let whole = difference / std::f64::consts::TAU;
            assert!((whole - whole.round()).abs() < 1e-9, "{difference}");
            assert!((turn(frequency, 0.025) - frequency * 0.025).abs() < 3e-16);
        };
        close(phase_angle::<Plain>);
        close(phase_angle::<FusedMultiplyAdd>);
    }
}
