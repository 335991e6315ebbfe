//! A position function that is a sine.

use crate::math::jet::Jet;

/// U = amplitude·sin(harmonic·φ + phase) + offset, with its derivatives.
#[inline(always)]
pub(crate) fn jet([amplitude, harmonic, phase, offset]: [f64; 4], phi: f64) -> Jet {
    let (sin, cos) = (harmonic * phi + phase).sin_cos();
    let first = amplitude * harmonic;
    let second = first * harmonic;
    Jet {
        value: amplitude * sin + offset,
        first: first * cos,
        second: -second * sin,
        third: -second * harmonic * cos,
    }
}
