//! Derivatives of residuals as differences of runs.

use nalgebra::DMatrix;

/// Share of the step by which differences of order 1, at the ends of ranges, are taken.
const SHORT: f64 = 1e-3;

/// Multiple of the error of differences beyond which two of them differ.
const NOISE: f64 = 10.0;

/// Difference of central differences of one and of two steps, as a share of the former, from which on
/// the step is too long.
const TOO_LONG: f64 = 0.2;

/// Residuals at rows of parameters; those that cannot be computed are `None`. `None` for all: ended
/// from outside.
pub type Residuals<'r> = dyn Fn(&[Vec<f64>]) -> Option<Vec<Option<Vec<f64>>>> + 'r;

/// Precision of residuals and of their derivatives.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Precision {
    /// Step of the differences, as a share of the range of a parameter.
    pub step: f64,
    /// Error of the signals of a run, as a share of their size.
    pub error: f64,
}

/// Derivatives, if they can be computed.
pub(super) enum Differences {
    /// A column a parameter.
    Known {
        /// The derivatives.
        jacobian: DMatrix<f64>,
        /// Whether the step is too long for the curvature of the residuals.
        is_too_long: bool,
    },
    /// Residuals beside the values cannot be computed.
    Unknown,
    /// Ended from outside.
    Interrupted,
}

/// Derivatives of the residuals by the shares: central differences of order 4, and of order 1 at
/// the end of a range. `centre`: the residuals there; `error`: root of the sum of their squared
/// errors.
pub(super) fn differences(
    shares: &[f64],
    (step, error): (f64, f64),
    centre: &[f64],
    residuals: &Residuals<'_>,
) -> Differences {
    let places: Vec<Vec<f64>> = shares.iter().map(|share| places(*share, step)).collect();
    let rows: Vec<Vec<f64>> = places
        .iter()
        .enumerate()
        .flat_map(|(at, own)| {
            own.iter().map(move |place| {
                let mut row = shares.to_vec();
                row[at] += place;
                row
            })
        })
        .collect();
    let Some(found) = residuals(&rows) else {
        return Differences::Interrupted;
    };
    let Some(found) = found.into_iter().collect::<Option<Vec<Vec<f64>>>>() else {
        return Differences::Unknown;
    };
    let mut next = rows.iter().zip(&found);
    let mut jacobian = DMatrix::zeros(centre.len(), shares.len());
    let mut is_too_long = false;
    // (Errors of runs are no curvature.)
    let noise = (NOISE * error / step).powi(2);
    for (at, places) in places.iter().enumerate() {
        let own: Vec<_> = next.by_ref().take(places.len()).collect();
        // (The step as it is after rounding.)
        let step = |number: usize| own[number].0[at] - shares[at];
        let (mut size, mut apart) = (0.0, 0.0);
        for row in 0..centre.len() {
            let value = |number: usize| own[number].1[row];
            jacobian[(row, at)] = match places.len() {
                1 => (value(0) - centre[row]) / step(0),
                _ => {
                    let near = (value(0) - value(1)) / (step(0) - step(1));
                    let far = (value(2) - value(3)) / (step(2) - step(3));
                    size += near * near;
                    apart += (near - far).powi(2);
                    (4.0 * near - far) / 3.0
                }
            };
        }
        is_too_long |= apart > noise.max(TOO_LONG * TOO_LONG * size);
    }
    Differences::Known {
        jacobian,
        is_too_long,
    }
}

/// Where the residuals are computed beside a share.
fn places(share: f64, step: f64) -> Vec<f64> {
    let is_within = 2.0 * step <= share && share + 2.0 * step <= 1.0;
    match is_within {
        true => vec![step, -step, 2.0 * step, -2.0 * step],
        false if share + SHORT * step <= 1.0 && share < 0.5 => vec![SHORT * step],
        false => vec![-SHORT * step],
    }
}
