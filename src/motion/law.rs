//! Dimensionless laws of motion: a rise from 0 to 1 while τ runs from 0 to 1.

use crate::jet::Jet;
use std::f64::consts::PI;

/// A named dimensionless law of motion θ(τ), 0 ≤ τ ≤ 1.
///
/// θ(0) = 0, θ(1) = 1, θ′(0) = θ′(1) = 0, and θ(1 − τ) = 1 − θ(τ) for all of
/// them. θ″ vanishes at both ends, except for the harmonic law.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum LawName {
    /// `harmonic`: (1 − cos πτ)/2; acceleration jumps at both ends.
    Harmonic,
    /// `cycloidal`: τ − sin(2πτ)/2π.
    Cycloidal,
    /// `3-4-5`: 10τ³ − 15τ⁴ + 6τ⁵.
    Polynomial345,
    /// `4-5-6-7`: 35τ⁴ − 84τ⁵ + 70τ⁶ − 20τ⁷.
    Polynomial4567,
    /// `modified_trapezoid`: sine, constant, sine, … acceleration in eighths.
    ModifiedTrapezoid,
}

impl LawName {
    /// All laws, in the order they are presented.
    pub const ALL: [Self; 5] = [
        Self::Harmonic,
        Self::Cycloidal,
        Self::Polynomial345,
        Self::Polynomial4567,
        Self::ModifiedTrapezoid,
    ];

    /// Name in scenes.
    pub fn name(self) -> &'static str {
        match self {
            Self::Harmonic => "harmonic",
            Self::Cycloidal => "cycloidal",
            Self::Polynomial345 => "3-4-5",
            Self::Polynomial4567 => "4-5-6-7",
            Self::ModifiedTrapezoid => "modified_trapezoid",
        }
    }

    /// Where the formula changes, strictly between 0 and 1, ascending.
    pub fn joints(self) -> &'static [f64] {
        match self {
            Self::ModifiedTrapezoid => &[0.125, 0.375, 0.625, 0.875],
            _ => &[],
        }
    }

    /// θ, θ′, θ″, θ‴ at `tau` by the formula of `piece` (0 before the first
    /// joint), also a little beyond the ends of the piece.
    pub fn jet(self, piece: usize, tau: f64) -> Jet {
        match self {
            Self::Harmonic => harmonic(tau),
            Self::Cycloidal => cycloidal(tau),
            Self::Polynomial345 => polynomial345(tau),
            Self::Polynomial4567 => polynomial4567(tau),
            Self::ModifiedTrapezoid => modified_trapezoid(piece, tau),
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

/// Greatest acceleration of the modified trapezoid, 8π/(π + 2).
const TRAPEZOID_PEAK: f64 = 8.0 * PI / (PI + 2.0);

/// Acceleration: a quarter sine over the first eighth, constant over a quarter,
/// half a cosine over the middle quarter; the second half mirrors the first.
fn modified_trapezoid(piece: usize, tau: f64) -> Jet {
    let rate = 4.0 * PI;
    let step = TRAPEZOID_PEAK / rate;
    match piece {
        0 => {
            let (sin, cos) = (rate * tau).sin_cos();
            let half = (0.5 * rate * tau).sin();
            Jet {
                value: step * (tau - sin / rate),
                first: 2.0 * step * half * half,
                second: TRAPEZOID_PEAK * sin,
                third: TRAPEZOID_PEAK * rate * cos,
            }
        }
        1 => {
            let x = tau - 0.125;
            Jet {
                value: step * (0.125 - 1.0 / rate) + x * (step + 0.5 * TRAPEZOID_PEAK * x),
                first: step + TRAPEZOID_PEAK * x,
                second: TRAPEZOID_PEAK,
                third: 0.0,
            }
        }
        2 => {
            let x = tau - 0.5;
            let (sin, cos) = (rate * x).sin_cos();
            Jet {
                value: 0.5 + (2.0 - step) * x + step / rate * sin,
                first: 2.0 + step * (cos - 1.0),
                second: -TRAPEZOID_PEAK * sin,
                third: -TRAPEZOID_PEAK * rate * cos,
            }
        }
        _ => {
            let mirrored = modified_trapezoid(if piece == 3 { 1 } else { 0 }, 1.0 - tau);
            Jet {
                value: 1.0 - mirrored.value,
                second: -mirrored.second,
                ..mirrored
            }
        }
    }
}

#[cfg(test)]
mod tests {
    use super::LawName;
    use crate::jet::Jet;

    fn edges(law: LawName) -> Vec<f64> {
        let mut edges = vec![0.0];
        edges.extend_from_slice(law.joints());
        edges.push(1.0);
        edges
    }

    fn sweep(law: LawName, mut visit: impl FnMut(usize, f64, Jet)) {
        for (piece, ends) in edges(law).windows(2).enumerate() {
            for i in 0..=20_000 {
                let tau = ends[0] + (ends[1] - ends[0]) * f64::from(i) / 20_000.0;
                visit(piece, tau, law.jet(piece, tau));
            }
        }
    }

    #[test]
    fn ends_and_joints_match_and_the_law_is_antisymmetric() {
        for law in LawName::ALL {
            let last = law.joints().len();
            let (start, end) = (law.jet(0, 0.0), law.jet(last, 1.0));
            assert!(start.value.abs() < 1e-15 && (end.value - 1.0).abs() < 1e-15);
            assert!(start.first.abs() < 1e-15 && end.first.abs() < 1e-15);
            for (piece, &joint) in law.joints().iter().enumerate() {
                let (left, right) = (law.jet(piece, joint), law.jet(piece + 1, joint));
                assert!((left.value - right.value).abs() < 1e-15, "{law:?} {joint}");
                assert!((left.first - right.first).abs() < 1e-14, "{law:?} {joint}");
                assert!(
                    (left.second - right.second).abs() < 1e-13,
                    "{law:?} {joint}"
                );
            }
            sweep(law, |piece, tau, jet| {
                let mirrored = law.jet(last - piece, 1.0 - tau);
                assert!((jet.value + mirrored.value - 1.0).abs() < 1e-14);
                assert!((jet.second + mirrored.second).abs() < 1e-11);
            });
        }
    }

    #[test]
    fn peaks_are_the_published_ones() {
        let pi = std::f64::consts::PI;
        let known = [
            (
                LawName::Harmonic,
                pi / 2.0,
                pi * pi / 2.0,
                pi.powi(3) / 2.0,
                3.87578,
            ),
            (LawName::Cycloidal, 2.0, 2.0 * pi, 4.0 * pi * pi, 8.16210),
            (
                LawName::Polynomial345,
                1.875,
                10.0 / 3f64.sqrt(),
                60.0,
                6.69427,
            ),
            (
                LawName::Polynomial4567,
                35.0 / 16.0,
                84.0 * 5f64.sqrt() / 25.0,
                52.5,
                10.7502,
            ),
            (
                LawName::ModifiedTrapezoid,
                2.0,
                8.0 * pi / (pi + 2.0),
                61.4260,
                8.08998,
            ),
        ];
        for (law, speed, acceleration, jerk, torque) in known {
            let mut peaks = [0.0f64; 4];
            sweep(law, |_, _, jet| {
                let found = [jet.first, jet.second, jet.third, jet.first * jet.second];
                for (peak, value) in peaks.iter_mut().zip(found) {
                    *peak = peak.max(value.abs());
                }
            });
            approx::assert_relative_eq!(peaks[0], speed, max_relative = 1e-9);
            approx::assert_relative_eq!(peaks[1], acceleration, max_relative = 1e-7);
            approx::assert_relative_eq!(peaks[2], jerk, max_relative = 2e-6);
            approx::assert_relative_eq!(peaks[3], torque, max_relative = 5e-6);
        }
    }

    #[test]
    fn derivatives_agree_with_differences() {
        let h = 1e-4;
        for law in LawName::ALL {
            for (piece, ends) in edges(law).windows(2).enumerate() {
                for i in 0..=10 {
                    // Also a little beyond the ends of the piece.
                    let tau = ends[0] + (ends[1] - ends[0]) * (f64::from(i) * 0.11 - 0.05);
                    let [left, middle, right] = [-h, 0.0, h].map(|d| law.jet(piece, tau + d));
                    let slope = |f: fn(&Jet) -> f64| (f(&right) - f(&left)) / (2.0 * h);
                    assert!((slope(|j| j.value) - middle.first).abs() < 1e-6, "{law:?}");
                    assert!((slope(|j| j.first) - middle.second).abs() < 1e-5, "{law:?}");
                    assert!((slope(|j| j.second) - middle.third).abs() < 1e-4, "{law:?}");
                }
            }
        }
    }
}
