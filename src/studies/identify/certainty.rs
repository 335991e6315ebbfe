//! What a fit says of its parameters: standard errors, correlations, and whether the residuals are
//! random.

use super::fit::Fit;
use crate::math::probability::normal_share_below;
use nalgebra::DMatrix;
use serde::Serialize;

/// Correlation from which on a record determines only a combination of two parameters.
pub const CORRELATED: f64 = 0.95;

/// Relative standard error beyond which a record does not determine a parameter.
pub const UNDETERMINED: f64 = 1.0;

/// Probability below which residuals do not count as random.
pub const RANDOM: f64 = 0.01;

/// Share of the greatest singular value below which a direction of the parameters has no effect.
const NO_EFFECT: f64 = 1e-10;

/// Certainty of the parameters of a fit.
#[derive(Clone, Debug, PartialEq)]
pub struct Certainty {
    /// Standard deviation of a residual of weight 1: s² = Σr²/(n − k).
    pub sigma: f64,
    /// Standard errors, from s²(JᵀJ)⁻¹; `None`: the record says nothing of the parameter.
    pub errors: Vec<Option<f64>>,
    /// Correlations of the parameters; 0 where an error is not known.
    pub correlations: DMatrix<f64>,
}

impl Certainty {
    /// Of a fit; `None`: there are no more residuals than parameters.
    pub fn of(fit: &Fit) -> Option<Self> {
        let (residuals, count) = (fit.residuals.len(), fit.values.len());
        let free = residuals.checked_sub(count).filter(|free| *free > 0)?;
        let sigma = (2.0 * fit.cost() / free as f64).sqrt();
        let norms: Vec<f64> = fit
            .jacobian
            .column_iter()
            .map(|column| column.norm())
            .collect();
        let scaled = DMatrix::from_fn(residuals, count, |row, column| {
            let norm = norms[column];
            if norm > 0.0 {
                fit.jacobian[(row, column)] / norm
            } else {
                0.0
            }
        });
        let parts = scaled.svd(false, true);
        let directions = parts.v_t?;
        let greatest = parts.singular_values.max();
        let has_effect = |at: usize| parts.singular_values[at] > NO_EFFECT * greatest;
        let covariance = DMatrix::from_fn(count, count, |row, column| {
            let each = (0..count).filter(|at| has_effect(*at)).map(|at| {
                let weight = parts.singular_values[at].powi(-2);
                weight * directions[(at, row)] * directions[(at, column)]
            });
            each.sum::<f64>()
        });
        // (What a direction without effect contains is not known at all.)
        let known = |at: usize| {
            let unknown = (0..count).filter(|one| !has_effect(*one));
            let share: f64 = unknown.map(|one| directions[(one, at)].powi(2)).sum();
            norms[at] > 0.0 && share < 1e-6
        };
        let errors: Vec<Option<f64>> = (0..count)
            .map(|at| known(at).then(|| sigma * covariance[(at, at)].sqrt() / norms[at]))
            .collect();
        let correlations = DMatrix::from_fn(count, count, |row, column| {
            match (row == column, known(row) && known(column)) {
                (true, _) => 1.0,
                (false, false) => 0.0,
                (false, true) => {
                    let sizes = covariance[(row, row)] * covariance[(column, column)];
                    covariance[(row, column)] / sizes.sqrt()
                }
            }
        });
        Some(Self {
            sigma,
            errors,
            correlations,
        })
    }

    /// Pairs of parameters of which the record determines a combination alone.
    pub fn correlated(&self) -> Vec<(usize, usize, f64)> {
        let count = self.errors.len();
        let pairs = (0..count).flat_map(|one| (one + 1..count).map(move |other| (one, other)));
        pairs
            .map(|(one, other)| (one, other, self.correlations[(one, other)]))
            .filter(|(.., own)| own.abs() > CORRELATED)
            .collect()
    }
}

/// Test of the runs of equal signs (A. Wald and J. Wolfowitz, Annals of Mathematical Statistics
/// 11, 1940).
#[derive(Clone, Copy, Debug, PartialEq, Serialize)]
pub struct RunsTest {
    /// Runs that were counted.
    pub runs: usize,
    /// Runs that are expected of random residuals.
    pub expected: f64,
    /// Probability of a number of runs as far from that, or farther.
    pub probability: f64,
}

impl RunsTest {
    /// Of residuals in the order of time; `None`: all have one sign.
    pub fn of(residuals: &[f64]) -> Option<Self> {
        let signs: Vec<bool> = residuals
            .iter()
            .filter(|own| **own != 0.0)
            .map(|own| *own > 0.0)
            .collect();
        let above = signs.iter().filter(|own| **own).count() as f64;
        let below = signs.len() as f64 - above;
        if above == 0.0 || below == 0.0 {
            return None;
        }
        let runs = 1 + signs.windows(2).filter(|pair| pair[0] != pair[1]).count();
        let (all, product) = (above + below, 2.0 * above * below);
        let expected = 1.0 + product / all;
        let variance = product * (product - all) / (all * all * (all - 1.0));
        let probability = match variance > 0.0 {
            true => {
                let off = (runs as f64 - expected).abs() / variance.sqrt();
                2.0 * normal_share_below(-off)
            }
            false => 1.0,
        };
        Some(Self {
            runs,
            expected,
            probability,
        })
    }

    /// Whether the residuals are random as far as this test sees.
    pub fn is_random(&self) -> bool {
        self.probability >= RANDOM
    }
}
