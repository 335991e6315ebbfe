//! Least squares by the method of K. Levenberg (1944) and D. W. Marquardt (1963), with the damping
//! of H. B. Nielsen (IMM-REP-1999-05), between bounds.

use nalgebra::{DMatrix, DVector};

/// Most steps.
const MOST_STEPS: usize = 100;

/// Step of the differences, as a share of the scale of a parameter.
const STEP: f64 = 1e-4;

/// Step of a fit that has converged, as a share of the scales.
const CONVERGED: f64 = 1e-11;

/// Damping at the start, relative to the greatest curvature.
const FIRST_DAMPING: f64 = 1e-3;

/// Most damping.
const MOST_DAMPING: f64 = 1e16;

/// Residuals at rows of parameters; those that cannot be computed are `None`. `None` for all: ended
/// from outside.
pub type Residuals<'r> = dyn Fn(&[Vec<f64>]) -> Option<Vec<Option<Vec<f64>>>> + 'r;

/// Bounds of a parameter, and what a step of it is measured by.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Bounds {
    /// Least value.
    pub lower: f64,
    /// Greatest value.
    pub upper: f64,
    /// Size of a usual change.
    pub scale: f64,
}

/// Why a fit ended.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Ending {
    /// No step improves it.
    Converged,
    /// After the most steps.
    MostSteps,
    /// The residuals cannot be computed about these values.
    NoResiduals,
}

/// A fit.
#[derive(Clone, Debug, PartialEq)]
pub struct Fit {
    /// The parameters.
    pub values: Vec<f64>,
    /// The residuals there.
    pub residuals: Vec<f64>,
    /// Their derivatives, a column a parameter.
    pub jacobian: DMatrix<f64>,
    /// Steps that were taken.
    pub steps: usize,
    /// Why it ended.
    pub ending: Ending,
}

impl Fit {
    /// Half the sum of the squares.
    pub fn cost(&self) -> f64 {
        cost(&self.residuals)
    }
}

fn cost(residuals: &[f64]) -> f64 {
    0.5 * residuals.iter().map(|one| one * one).sum::<f64>()
}

/// The fit from a start; `None`: ended from outside, or there are no residuals at the start.
pub fn fit(start: &[f64], bounds: &[Bounds], residuals: &Residuals<'_>) -> Option<Fit> {
    let inside = |values: &[f64]| -> Vec<f64> {
        let each = values.iter().zip(bounds);
        each.map(|(value, own)| value.clamp(own.lower, own.upper))
            .collect()
    };
    let mut values = inside(start);
    let mut found = residuals(&[values.clone()])?.pop()??;
    let (mut damping, mut factor) = (None, 2.0);
    let mut jacobian = DMatrix::zeros(found.len(), bounds.len());
    for steps in 0..MOST_STEPS {
        let done = |ending, values: &[f64], residuals: &[f64], jacobian: &DMatrix<f64>| Fit {
            values: values.to_vec(),
            residuals: residuals.to_vec(),
            jacobian: unscaled(jacobian, bounds),
            steps,
            ending,
        };
        let Some(scaled) = differences(&values, bounds, &found, residuals)? else {
            return Some(done(Ending::NoResiduals, &values, &found, &jacobian));
        };
        jacobian = scaled;
        let normal = jacobian.transpose() * &jacobian;
        let slope = jacobian.transpose() * DVector::from_column_slice(&found);
        let greatest = (0..bounds.len())
            .map(|at| normal[(at, at)])
            .fold(0.0, f64::max);
        loop {
            let own = *damping.get_or_insert(FIRST_DAMPING * greatest);
            let free = free_parameters(&values, bounds, &slope);
            let step = damped_step(&normal, &slope, own, &free);
            let moved = step.as_ref().map(|step| {
                let each = values.iter().zip(step.iter()).zip(bounds);
                inside(
                    &each
                        .map(|((value, step), own)| value + step * own.scale)
                        .collect::<Vec<_>>(),
                )
            });
            // (Without damping: a step that damping makes small has not converged.)
            let newton = damped_step(&normal, &slope, 0.0, &free);
            let converged = newton.is_some_and(|step| step.amax() <= CONVERGED);
            let stays = moved.as_ref().is_some_and(|moved| *moved == values);
            if converged || stays || own > MOST_DAMPING * greatest {
                return Some(done(Ending::Converged, &values, &found, &jacobian));
            }
            let tried = match &moved {
                Some(moved) => residuals(std::slice::from_ref(moved))?.pop()?,
                None => None,
            };
            let better = tried.filter(|new| cost(new) < cost(&found));
            if let Some((new, moved)) = better.zip(moved) {
                let step = DVector::from_fn(bounds.len(), |at, _| {
                    (moved[at] - values[at]) / bounds[at].scale
                });
                let predicted = -(slope.dot(&step) + 0.5 * (&normal * &step).dot(&step));
                let gain = (cost(&found) - cost(&new)) / predicted;
                let less = (1.0 - (2.0 * gain - 1.0).powi(3)).clamp(1.0 / 3.0, 2.0);
                (values, found) = (moved, new);
                (damping, factor) = (Some(own * less), 2.0);
                break;
            }
            damping = Some((own * factor).max(f64::MIN_POSITIVE));
            factor *= 2.0;
        }
    }
    Some(Fit {
        values,
        residuals: found,
        jacobian: unscaled(&jacobian, bounds),
        steps: MOST_STEPS,
        ending: Ending::MostSteps,
    })
}

/// The parameters that are not held by a bound.
fn free_parameters(values: &[f64], bounds: &[Bounds], slope: &DVector<f64>) -> Vec<bool> {
    let each = values.iter().zip(bounds).zip(slope.iter());
    each.map(|((value, own), slope)| {
        !(*value <= own.lower && *slope > 0.0 || *value >= own.upper && *slope < 0.0)
    })
    .collect()
}

/// The step of the free parameters with a damping; `None`: the matrix is singular.
fn damped_step(
    normal: &DMatrix<f64>,
    slope: &DVector<f64>,
    damping: f64,
    free: &[bool],
) -> Option<DVector<f64>> {
    let count = slope.len();
    let matrix = DMatrix::from_fn(count, count, |row, column| {
        match (row == column, free[row] && free[column]) {
            (true, true) => normal[(row, row)] + damping,
            (true, false) => 1.0,
            (false, true) => normal[(row, column)],
            (false, false) => 0.0,
        }
    });
    let right = DVector::from_fn(count, |row, _| if free[row] { -slope[row] } else { 0.0 });
    let step = matrix.cholesky()?.solve(&right);
    step.iter().all(|one| one.is_finite()).then_some(step)
}

/// Derivatives of the residuals by the scaled parameters: central differences of order 4, and of
/// order 1 at a bound. Inner `None`: they cannot be computed.
fn differences(
    values: &[f64],
    bounds: &[Bounds],
    centre: &[f64],
    residuals: &Residuals<'_>,
) -> Option<Option<DMatrix<f64>>> {
    let places = |at: usize| {
        let (own, value) = (bounds[at], values[at]);
        let step = STEP * own.scale;
        let within = own.lower <= value - 2.0 * step && value + 2.0 * step <= own.upper;
        match within {
            true => vec![step, -step, 2.0 * step, -2.0 * step],
            false if value + step <= own.upper => vec![1e-3 * step],
            false => vec![-1e-3 * step],
        }
    };
    let all: Vec<Vec<f64>> = (0..values.len()).map(places).collect();
    let rows = all.iter().enumerate().flat_map(|(at, places)| {
        places.iter().map(move |place| {
            let mut row = values.to_vec();
            row[at] += place;
            row
        })
    });
    let rows: Vec<Vec<f64>> = rows.collect();
    let found: Option<Vec<Vec<f64>>> = residuals(&rows)?.into_iter().collect();
    let Some(found) = found else {
        return Some(None);
    };
    let mut next = rows.iter().zip(found);
    let mut jacobian = DMatrix::zeros(centre.len(), values.len());
    for (at, places) in all.iter().enumerate() {
        let own: Vec<_> = next.by_ref().take(places.len()).collect();
        // (The step as it is after rounding.)
        let step = |number: usize| (own[number].0[at] - values[at]) / bounds[at].scale;
        for row in 0..centre.len() {
            let value = |number: usize| own[number].1[row];
            jacobian[(row, at)] = match places.len() {
                1 => (value(0) - centre[row]) / step(0),
                _ => {
                    let near = (value(0) - value(1)) / (step(0) - step(1));
                    let far = (value(2) - value(3)) / (step(2) - step(3));
                    (4.0 * near - far) / 3.0
                }
            };
        }
    }
    Some(Some(jacobian))
}

fn unscaled(jacobian: &DMatrix<f64>, bounds: &[Bounds]) -> DMatrix<f64> {
    let mut own = jacobian.clone();
    for (at, one) in bounds.iter().enumerate() {
        own.column_mut(at).unscale_mut(one.scale);
    }
    own
}
