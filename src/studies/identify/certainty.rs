//! What a fit says of its parameters: standard errors, correlations, and the directions in which
//! the record says least.

use super::differences::Precision;
use super::fit::Fit;
use nalgebra::DMatrix;

/// Correlation from which on a record determines only a combination of two parameters.
pub const CORRELATED: f64 = 0.95;

/// Relative standard error beyond which a record does not determine a parameter.
pub const UNDETERMINED: f64 = 1.0;

/// Singular value of the scaled derivatives below which a direction has no effect in any case.
const NO_EFFECT: f64 = 1e-7;

/// Multiple of the error of the derivatives below which an effect is not known.
const NOISE: f64 = 10.0;

/// Share of a direction without effect in a parameter below which the parameter is known.
const NO_SHARE: f64 = 1e-6;

/// Certainty of the parameters of a fit, as shares of their ranges.
#[derive(Clone, Debug, PartialEq)]
pub struct Certainty {
    /// Degrees of freedom: residuals less parameters that are not held.
    pub free: usize,
    /// Standard deviation of a residual of weight 1: s² = Σr²/(n − k).
    pub sigma: f64,
    /// Standard errors, from s²(JᵀJ)⁻¹; `None`: the record says nothing of the parameter, or it is
    /// held.
    pub errors: Vec<Option<f64>>,
    /// Correlations of the parameters; 0 where an error is not known.
    pub correlations: DMatrix<f64>,
    directions: Vec<Direction>,
}

/// A combination of the parameters: a right singular vector of the derivatives.
#[derive(Clone, Debug, PartialEq)]
struct Direction {
    /// Part of each parameter, in multiples of the inverse of its effect.
    parts: Vec<f64>,
    /// Effect on the residuals.
    effect: f64,
    /// Whether the effect is more than the error of the derivatives.
    has_effect: bool,
    /// Change of each parameter, the greatest 1.
    changes: Vec<f64>,
}

impl Certainty {
    /// Of a fit to signals of a size √Σ(y/σ)². Parameters at an end of their range are held there.
    /// `None`: there are no more residuals than other parameters, or the derivatives are unknown.
    pub fn of(fit: &Fit, size: f64, precision: Precision) -> Option<Self> {
        let jacobian = fit.jacobian.as_ref()?;
        let (residuals, count) = jacobian.shape();
        let is_held = |at: usize| is_at_end(fit.shares[at]);
        let sought = (0..count).filter(|at| !is_held(*at)).count();
        let free = residuals.checked_sub(sought).filter(|free| *free > 0)?;
        // (The runs themselves are known to no more than their error.)
        let error = precision.error * size;
        let sigma = (2.0 * fit.cost() / free as f64 + error * error / residuals as f64).sqrt();
        let noise = NOISE * error / fit.step;
        let norms: Vec<f64> = jacobian
            .column_iter()
            .map(|column| column.norm())
            .enumerate()
            .map(|(at, norm)| {
                if norm > noise && !is_held(at) {
                    norm
                } else {
                    0.0
                }
            })
            .collect();
        let directions = directions(jacobian, &norms, noise)?;
        let covariance = DMatrix::from_fn(count, count, |row, column| {
            let known = directions.iter().filter(|one| one.has_effect);
            let each = known.map(|one| one.parts[row] * one.parts[column] / one.effect.powi(2));
            each.sum::<f64>()
        });
        // (What a direction without effect contains is not known at all.)
        let is_known = |at: usize| {
            let open = directions.iter().filter(|one| !one.has_effect);
            let share: f64 = open.map(|one| one.parts[at].powi(2)).sum();
            norms[at] > 0.0 && share < NO_SHARE
        };
        let error = |at: usize| is_known(at).then(|| covariance[(at, at)].sqrt() / norms[at]);
        let correlation = |row: usize, column: usize| match (row == column, is_known(row)) {
            (true, _) => 1.0,
            (false, true) if is_known(column) => {
                let sizes = covariance[(row, row)] * covariance[(column, column)];
                covariance[(row, column)] / sizes.sqrt()
            }
            (false, _) => 0.0,
        };
        Some(Self {
            free,
            sigma,
            errors: (0..count)
                .map(|at| error(at).map(|error| sigma * error))
                .collect(),
            correlations: DMatrix::from_fn(count, count, correlation),
            directions,
        })
    }

    /// Changes of all parameters for one standard error of one of them, the sum of squares least:
    /// the sum of squares rises by s². `None`: its error is not known.
    pub fn one_error(&self, parameter: usize) -> Option<Vec<f64>> {
        self.errors[parameter]?;
        let changes = self.errors.iter().enumerate();
        let own = |(at, error): (usize, &Option<f64>)| {
            error.unwrap_or(0.0) * self.correlations[(parameter, at)]
        };
        Some(changes.map(own).collect())
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

    /// Change of all parameters in the direction that makes the error of one the greatest: the
    /// greatest change is 1.
    pub fn open_direction(&self, parameter: usize) -> &[f64] {
        let weight = |one: &Direction| {
            let part = one.parts[parameter].powi(2);
            match one.has_effect {
                // (Any part of a direction without effect is worse than all others.)
                false if part >= NO_SHARE => (1, part),
                false => (0, 0.0),
                true => (0, part / one.effect.powi(2)),
            }
        };
        let worst = self.directions.iter().max_by(|one, other| {
            let (one, other) = (weight(one), weight(other));
            one.0.cmp(&other.0).then(one.1.total_cmp(&other.1))
        });
        worst.map_or(&[], |one| &one.changes)
    }
}

/// Whether a share of a range is an end of it.
pub(super) fn is_at_end(share: f64) -> bool {
    share <= 0.0 || share >= 1.0
}

/// The singular vectors of the derivatives, each column over its norm; a norm of 0 is that of a
/// parameter without effect.
fn directions(jacobian: &DMatrix<f64>, norms: &[f64], noise: f64) -> Option<Vec<Direction>> {
    let (residuals, count) = jacobian.shape();
    let scaled = DMatrix::from_fn(residuals, count, |row, column| match norms[column] > 0.0 {
        true => jacobian[(row, column)] / norms[column],
        false => 0.0,
    });
    let parts = scaled.svd(false, true);
    let vectors = parts.v_t?;
    let direction = |at: usize| {
        let own: Vec<f64> = vectors.row(at).iter().copied().collect();
        let effect = parts.singular_values[at];
        let each = own.iter().zip(norms).filter(|(_, norm)| **norm > 0.0);
        let error = each
            .map(|(part, norm)| (part * noise / norm).powi(2))
            .sum::<f64>()
            .sqrt();
        let has_effect = effect > error.max(NO_EFFECT);
        Direction {
            changes: changes(&own, norms),
            parts: own,
            effect,
            has_effect,
        }
    };
    Some((0..count).map(direction).collect())
}

/// Changes of parameters, the greatest 1, of the parts of a direction.
fn changes(parts: &[f64], norms: &[f64]) -> Vec<f64> {
    let alone = parts
        .iter()
        .zip(norms)
        .any(|(part, norm)| *norm == 0.0 && part.abs() > 0.5);
    let own = |(part, norm): (&f64, &f64)| match (alone, *norm > 0.0) {
        (true, false) => *part,
        (true, true) | (false, false) => 0.0,
        (false, true) => part / norm,
    };
    let each: Vec<f64> = parts.iter().zip(norms).map(own).collect();
    let greatest = each
        .iter()
        .fold(0.0, |greatest: f64, one| greatest.max(one.abs()));
    each.iter().map(|one| one / greatest).collect()
}
