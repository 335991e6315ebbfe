//! Least squares by the method of K. Levenberg (1944) and D. W. Marquardt (1963), with the damping
//! of H. B. Nielsen (IMM-REP-1999-05), between bounds.
//!
//! Parameters are shares of their ranges, from 0 to 1: so all steps have one measure.

use super::differences::{Differences, Precision, Residuals, differences};
use nalgebra::{DMatrix, DVector};

/// Most steps.
const MOST_STEPS: usize = 100;

/// Step of a fit that has converged.
const CONVERGED: f64 = 1e-11;

/// Share of the sum of squares below which a predicted gain is rounding.
const NO_GAIN: f64 = 1e-15;

/// Damping at the start, relative to the greatest curvature.
const FIRST_DAMPING: f64 = 1e-3;

/// Most damping.
const MOST_DAMPING: f64 = 1e16;

/// Gain, over the variance of a residual, below which an estimate is that of the minimum: a
/// hundredth of a standard error.
const SMALL_GAIN: f64 = 1e-4;

/// Factor of a step of differences that is too long.
const SHORTER: f64 = 0.25;

/// Step of differences that is not made shorter.
const SHORTEST_STEP: f64 = 1e-9;

/// Curvature, over the greatest one, below which a direction has no effect.
const NO_EFFECT: f64 = 1e-10;

/// Why a fit ended.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Ending {
    /// The slopes say that no step improves it.
    Converged,
    /// No step improves it, though the slopes say that one does: a kink or a jump.
    Stalled,
    /// After the most steps.
    MostSteps,
    /// The residuals cannot be computed about these values.
    NoResiduals,
    /// From outside.
    Interrupted,
}

/// A fit.
#[derive(Clone, Debug, PartialEq)]
pub struct Fit {
    /// The parameters, as shares of their ranges.
    pub shares: Vec<f64>,
    /// The residuals there.
    pub residuals: Vec<f64>,
    /// Their derivatives by the shares, a column a parameter; `None`: unknown there.
    pub jacobian: Option<DMatrix<f64>>,
    /// Step of the differences there.
    pub step: f64,
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

/// The fit from a start to signals of a size √Σ(y/σ)². `None`: there are no residuals at the start,
/// or it was ended from outside before they were known.
pub fn fit(
    start: &[f64],
    size: f64,
    precision: Precision,
    residuals: &Residuals<'_>,
) -> Option<Fit> {
    let shares = within_ranges(start.to_vec());
    let found = residuals(std::slice::from_ref(&shares))?.pop()??;
    let mut descent = Descent {
        step: precision.step,
        error: precision.error * size,
        of: residuals,
        shares,
        residuals: found,
        jacobian: None,
        damping: None,
        factor: 2.0,
        steps: 0,
    };
    let ending = descent.go();
    Some(Fit {
        shares: descent.shares,
        residuals: descent.residuals,
        jacobian: descent.jacobian,
        step: descent.step,
        steps: descent.steps,
        ending,
    })
}

fn within_ranges(mut shares: Vec<f64>) -> Vec<f64> {
    for share in &mut shares {
        *share = share.clamp(0.0, 1.0);
    }
    shares
}

/// A fit on its way.
struct Descent<'r> {
    /// Step of the differences.
    step: f64,
    /// Error of all residuals: the root of the sum of its squares.
    error: f64,
    of: &'r Residuals<'r>,
    shares: Vec<f64>,
    residuals: Vec<f64>,
    /// Known at `shares` if it is there.
    jacobian: Option<DMatrix<f64>>,
    damping: Option<f64>,
    factor: f64,
    steps: usize,
}

impl Descent<'_> {
    fn go(&mut self) -> Ending {
        while self.steps < MOST_STEPS {
            let precision = (self.step, self.error);
            let jacobian = match differences(&self.shares, precision, &self.residuals, self.of) {
                Differences::Known { is_too_long, .. }
                    if is_too_long && self.step > SHORTEST_STEP =>
                {
                    self.step *= SHORTER;
                    continue;
                }
                Differences::Known { jacobian, .. } => jacobian,
                Differences::Unknown => return Ending::NoResiduals,
                Differences::Interrupted => return Ending::Interrupted,
            };
            let slopes = Slopes::of(&jacobian, &self.residuals);
            self.jacobian = Some(jacobian);
            if let Some(ending) = self.improve(&slopes) {
                return ending;
            }
            self.jacobian = None;
            self.steps += 1;
        }
        Ending::MostSteps
    }

    /// Goes on to better values; `Some`: there are none.
    fn improve(&mut self, slopes: &Slopes) -> Option<Ending> {
        let free = free_parameters(&self.shares, &slopes.gradient);
        let cost_here = cost(&self.residuals);
        // (Without damping: a step that damping makes small has not converged.)
        let newton = slopes.damped_step(0.0, &free);
        let has_converged = newton.is_some_and(|step| {
            step.amax() <= CONVERGED || slopes.predicted_gain(&step) <= NO_GAIN * cost_here
        });
        if has_converged {
            return Some(Ending::Converged);
        }
        loop {
            let damping = self.damping.unwrap_or(FIRST_DAMPING * slopes.greatest);
            let step = slopes.damped_step(damping, &free);
            let moved = step.map(|step| self.moved_by(&step));
            let stays = moved.as_ref().is_some_and(|moved| *moved == self.shares);
            // (A curvature of 0: nothing has an effect.)
            if slopes.greatest == 0.0 {
                return Some(Ending::Converged);
            }
            if stays || damping > MOST_DAMPING * slopes.greatest {
                return Some(self.ending_without_a_step(slopes, &free));
            }
            let tried = match &moved {
                None => None,
                Some(moved) => match (self.of)(std::slice::from_ref(moved)) {
                    None => return Some(Ending::Interrupted),
                    Some(mut found) => found.pop().flatten(),
                },
            };
            let better = tried.filter(|new| cost(new) < cost_here).zip(moved);
            if let Some((residuals, moved)) = better {
                self.accept(residuals, moved, damping, slopes);
                return None;
            }
            self.damping = Some((damping * self.factor).max(f64::MIN_POSITIVE));
            self.factor *= 2.0;
        }
    }

    /// Why no step improves it: the slopes predict no gain, or they do not hold.
    fn ending_without_a_step(&self, slopes: &Slopes, free: &[bool]) -> Ending {
        // (Directions without effect have slopes of rounding alone.)
        let step = slopes.damped_step(NO_EFFECT * slopes.greatest, free);
        let gain = step.map_or(f64::INFINITY, |step| slopes.predicted_gain(&step));
        match gain <= self.small_gain() {
            true => Ending::Converged,
            false => Ending::Stalled,
        }
    }

    /// Gain that is less than what residuals are known to, or without meaning for the estimates.
    fn small_gain(&self) -> f64 {
        let squares = 2.0 * cost(&self.residuals);
        let noise = self.error * (squares.sqrt() + self.error);
        noise.max(SMALL_GAIN * squares / self.residuals.len().max(1) as f64)
    }

    fn moved_by(&self, step: &DVector<f64>) -> Vec<f64> {
        let each = self.shares.iter().zip(step.iter());
        within_ranges(each.map(|(share, step)| share + step).collect())
    }

    /// Takes better values; the damping follows from how well the gain was predicted.
    fn accept(&mut self, residuals: Vec<f64>, moved: Vec<f64>, damping: f64, slopes: &Slopes) {
        let step = DVector::from_fn(moved.len(), |at, _| moved[at] - self.shares[at]);
        let gain = cost(&self.residuals) - cost(&residuals);
        let ratio = gain / slopes.predicted_gain(&step);
        let less = (1.0 - (2.0 * ratio - 1.0).powi(3)).clamp(1.0 / 3.0, 2.0);
        (self.shares, self.residuals) = (moved, residuals);
        (self.damping, self.factor) = (Some(damping * less), 2.0);
    }
}

/// Slope and curvature of half the sum of squares.
struct Slopes {
    gradient: DVector<f64>,
    normal: DMatrix<f64>,
    /// Greatest curvature by one parameter.
    greatest: f64,
}

impl Slopes {
    fn of(jacobian: &DMatrix<f64>, residuals: &[f64]) -> Self {
        let normal = jacobian.transpose() * jacobian;
        Self {
            gradient: jacobian.transpose() * DVector::from_column_slice(residuals),
            greatest: normal.diagonal().iter().copied().fold(0.0, f64::max),
            normal,
        }
    }

    fn predicted_gain(&self, step: &DVector<f64>) -> f64 {
        -(self.gradient.dot(step) + 0.5 * (&self.normal * step).dot(step))
    }

    /// The step of the free parameters with a damping; `None`: the matrix is singular.
    fn damped_step(&self, damping: f64, free: &[bool]) -> Option<DVector<f64>> {
        let count = free.len();
        let matrix = DMatrix::from_fn(count, count, |row, column| {
            match (row == column, free[row] && free[column]) {
                (true, true) => self.normal[(row, row)] + damping,
                (true, false) => 1.0,
                (false, true) => self.normal[(row, column)],
                (false, false) => 0.0,
            }
        });
        let right = |row: usize, _| if free[row] { -self.gradient[row] } else { 0.0 };
        let step = matrix.cholesky()?.solve(&DVector::from_fn(count, right));
        step.iter().all(|one| one.is_finite()).then_some(step)
    }
}

/// The parameters that are not held by an end of their range.
fn free_parameters(shares: &[f64], gradient: &DVector<f64>) -> Vec<bool> {
    let each = shares.iter().zip(gradient.iter());
    each.map(|(share, slope)| {
        let is_held = *share <= 0.0 && *slope > 0.0 || *share >= 1.0 && *slope < 0.0;
        !is_held
    })
    .collect()
}
