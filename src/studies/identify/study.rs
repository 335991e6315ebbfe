//! Fits from several starts, and what they say.

use super::certainty::{Certainty, is_at_end};
use super::differences::{Precision, Residuals};
use super::fit::{Ending, Fit, fit};
use super::misfit::ChiSquared;
use super::quality::{is_exact, linear, misfit, outliers};
use super::result::{Change, Estimate, FittedSignal, Identification, Standing, StartResult};
use super::runs_test::RunsTest;
use crate::math::optimise::constrained::starts;
use crate::studies::optimize::Variable;

/// Standard errors by which two fits differ that are not the same.
const APART: f64 = 10.0;

/// Relative difference of sums of squares of which neither is the better one.
const SAME: f64 = 1e-6;

/// Least difference of such fits, as a share of the range.
const LEAST_APART: f64 = 1e-6;

/// Part of an open direction below which a number has no share in it.
const NO_PART: f64 = 0.01;

/// What is sought.
pub struct IdentificationTask {
    /// The numbers.
    pub variables: Vec<Variable>,
    /// Their values in the scene, in their units.
    pub given: Vec<f64>,
    /// The signals in the order of the residuals, without residuals yet.
    pub signals: Vec<FittedSignal>,
    /// Number of starts.
    pub starts: usize,
    /// Precision of the residuals.
    pub precision: Precision,
}

/// A fit with its standard errors, if they are known.
struct BestFit<'f> {
    fit: &'f Fit,
    certainty: Option<Certainty>,
    /// Whether the standard error of each number holds.
    linear: Vec<bool>,
}

impl IdentificationTask {
    /// The values at shares of the ranges.
    pub fn values(&self, shares: &[f64]) -> Vec<f64> {
        let each = self.variables.iter().zip(shares);
        each.map(|(variable, share)| variable.value(*share))
            .collect()
    }

    /// Shares of the ranges from which fits start: the values of the scene, then points that fill
    /// the ranges.
    fn places(&self) -> Vec<Vec<f64>> {
        let each = self.variables.iter().zip(&self.given);
        let first = each.map(|(variable, given)| {
            let start = variable.start.unwrap_or(*given);
            variable.share(start).unwrap_or(0.5)
        });
        let count = u32::try_from(self.starts).unwrap_or(u32::MAX);
        let others = (1..count).map(|number| starts(number - 1, self.variables.len()));
        std::iter::once(first.collect()).chain(others).collect()
    }

    /// Size of all signals over their weights: √Σ(y/σ)².
    fn size(&self) -> f64 {
        let own = |one: &FittedSignal| {
            let squares = one.measured.iter().map(|value| value * value);
            squares.sum::<f64>() / one.weight().powi(2)
        };
        self.signals.iter().map(own).sum::<f64>().sqrt()
    }
}

/// The numbers from the best of the fits of all starts. `residuals` belong to shares of the
/// ranges. `None`: there are no residuals at any start.
pub fn identify(task: IdentificationTask, residuals: &Residuals<'_>) -> Option<Identification> {
    let places = task.places();
    let (mut fits, mut complete) = (Vec::new(), true);
    for place in &places {
        let is_ended = std::cell::Cell::new(false);
        let watched = |rows: &[Vec<f64>]| {
            let found = residuals(rows);
            is_ended.set(is_ended.get() || found.is_none());
            found
        };
        let found = fit(place, task.size(), task.precision, &watched);
        complete = !is_ended.get();
        if complete || found.is_some() {
            fits.push(found);
        }
        if !complete {
            break;
        }
    }
    let best = best_of(&fits)?;
    let certainty = match best.ending {
        Ending::Converged => Certainty::of(best, task.size(), task.precision),
        Ending::Stalled | Ending::MostSteps | Ending::NoResiduals | Ending::Interrupted => None,
    };
    let tried = match &certainty {
        Some(own) => linear(best, own, task.precision.error * task.size(), residuals),
        None => Some(Vec::new()),
    };
    complete &= tried.is_some();
    let best = BestFit {
        linear: tried.unwrap_or_default(),
        certainty,
        fit: best,
    };
    let count = places.len();
    let results = start_results(&task, &best, &places, &fits);
    let found = summary(task, &best, &fits, results);
    Some(Identification {
        starts_requested: count,
        complete,
        ..found
    })
}

/// The best fit: a converged one, if it is as good as the one of least squares. A fit that was ended
/// from outside is worse than each that was not.
fn best_of(fits: &[Option<Fit>]) -> Option<&Fit> {
    let rank = |fit: &Fit| (fit.ending == Ending::Interrupted, fit.cost());
    let order = |one: &&Fit, other: &&Fit| {
        let (one, other) = (rank(one), rank(other));
        one.0.cmp(&other.0).then(one.1.total_cmp(&other.1))
    };
    let least = fits.iter().flatten().min_by(order)?;
    let is_same = |one: &&Fit| one.cost() <= least.cost() * (1.0 + SAME);
    let converged = fits.iter().flatten().filter(is_same);
    let converged = converged.filter(|one| one.ending == Ending::Converged);
    Some(converged.min_by(order).unwrap_or(least))
}

/// The signals with the residuals of a fit.
fn with_residuals(
    mut signals: Vec<FittedSignal>,
    fit: &Fit,
    precision: Precision,
) -> Vec<FittedSignal> {
    let mut rest = fit.residuals.iter().copied();
    for signal in &mut signals {
        signal.residuals = rest.by_ref().take(signal.times.len()).collect();
        signal.test = RunsTest::of(&signal.residuals);
        signal.is_exact = is_exact(signal, precision);
        signal.outliers = outliers(signal);
    }
    signals
}

/// Whether a fit is as good as the best one.
fn is_as_good(task: &IdentificationTask, best: &BestFit<'_>, other: &Fit) -> bool {
    let Some(certainty) = &best.certainty else {
        return false;
    };
    // Two standard errors of one number, and what runs are known to.
    let noise = APART * task.precision.error * task.size();
    let margin = 2.0 * certainty.sigma.powi(2) + 0.5 * noise * noise;
    other.cost() <= best.fit.cost() + margin
}

/// Whether a fit has the values of the best one.
fn is_same(best: &BestFit<'_>, other: &Fit) -> bool {
    let Some(certainty) = &best.certainty else {
        return false;
    };
    let each = other.shares.iter().zip(&best.fit.shares);
    let mut each = each.zip(&certainty.errors);
    each.all(|((own, best), error)| {
        let within = error.map_or(0.0, |error| APART * error);
        (own - best).abs() <= within.max(LEAST_APART)
    })
}

/// The numbers by which a fit that is as good differs from the best one.
fn differs(task: &IdentificationTask, best: &BestFit<'_>, other: &Fit) -> Vec<bool> {
    let count = other.shares.len();
    let Some(certainty) = &best.certainty else {
        return vec![false; count];
    };
    let is_as_good = is_as_good(task, best, other);
    let own = |at: usize| {
        let apart = (other.shares[at] - best.fit.shares[at]).abs();
        let is_apart = |error: f64| apart > (APART * error).max(LEAST_APART);
        is_as_good && certainty.errors[at].is_some_and(is_apart)
    };
    (0..count).map(own).collect()
}

fn start_results(
    task: &IdentificationTask,
    best: &BestFit<'_>,
    places: &[Vec<f64>],
    fits: &[Option<Fit>],
) -> Vec<StartResult> {
    let one = |(place, fit): (&Vec<f64>, &Option<Fit>)| {
        let end = fit.as_ref().map_or(place, |fit| &fit.shares);
        let has = |wanted: &dyn Fn(&Fit) -> bool| fit.as_ref().is_some_and(wanted);
        let is_rival = has(&|fit| differs(task, best, fit).contains(&true));
        StartResult {
            start: task.values(place),
            end: task.values(end),
            rms: fit.as_ref().map(rms),
            ending: fit.as_ref().map_or(Ending::NoResiduals, |fit| fit.ending),
            is_best: has(&|fit| is_same(best, fit)),
            is_rival,
        }
    };
    places.iter().zip(fits).map(one).collect()
}

fn rms(fit: &Fit) -> f64 {
    (2.0 * fit.cost() / fit.residuals.len().max(1) as f64).sqrt()
}

fn summary(
    task: IdentificationTask,
    best: &BestFit<'_>,
    fits: &[Option<Fit>],
    starts: Vec<StartResult>,
) -> Identification {
    let rivals: Vec<Vec<bool>> = fits
        .iter()
        .flatten()
        .map(|fit| differs(&task, best, fit))
        .collect();
    let signals = with_residuals(task.signals.clone(), best.fit, task.precision);
    let known = best.certainty.as_ref();
    let residuals = best.fit.residuals.len() as f64;
    let misfit = known.and_then(|own| misfit(&signals, own.free as f64 / residuals));
    let has_end = best.fit.shares.iter().copied().any(is_at_end);
    let estimate = |at: usize| {
        let (variable, share) = (&task.variables[at], best.fit.shares[at]);
        let error = known.and_then(|own| own.errors[at]);
        let mut one = Estimate {
            variable: variable.clone(),
            given: task.given[at],
            fitted: variable.value(share),
            error: error.map(|error| error * variable.slope(share).abs()),
            standing: Standing::NoFit,
        };
        one.standing = match best.fit.ending {
            Ending::Stalled | Ending::MostSteps | Ending::NoResiduals | Ending::Interrupted => {
                Standing::NoFit
            }
            Ending::Converged if misfit.is_some() => Standing::Misfit,
            Ending::Converged if is_at_end(share) => Standing::AtEnd,
            Ending::Converged if !one.is_known() => Standing::Undetermined,
            Ending::Converged if rivals.iter().any(|own| own[at]) => Standing::Ambiguous,
            Ending::Converged if best.linear.get(at) != Some(&true) => Standing::NotLinear,
            Ending::Converged if has_end => Standing::Conditional,
            Ending::Converged => Standing::Determined,
        };
        one
    };
    let estimates: Vec<Estimate> = (0..task.variables.len()).map(estimate).collect();
    let has_sigma = signals.iter().all(|one| one.sigma.is_some());
    let chi_squared = known.filter(|_| has_sigma);
    let rows = |own: &Certainty| {
        let rows = own.correlations.row_iter();
        rows.map(|row| row.iter().copied().collect()).collect()
    };
    Identification {
        open_directions: open_directions(&estimates, best),
        correlated: known.map_or_else(Vec::new, Certainty::correlated),
        correlations: known.map_or_else(Vec::new, rows),
        sigma: known.map(|own| own.sigma),
        chi_squared: chi_squared.map(|own| ChiSquared::of(&best.fit.residuals, own.free as f64)),
        misfit,
        signals,
        starts,
        starts_requested: 0,
        ending: best.fit.ending,
        evaluations: 0,
        complete: true,
        remarks: Vec::new(),
        settings: Vec::new(),
        scene_text: String::new(),
        estimates,
    }
}

/// Directions, each once, in which numbers are not determined.
fn open_directions(estimates: &[Estimate], best: &BestFit<'_>) -> Vec<Vec<Change>> {
    let Some(certainty) = &best.certainty else {
        return Vec::new();
    };
    let mut found: Vec<&[f64]> = Vec::new();
    for (at, one) in estimates.iter().enumerate() {
        let own = certainty.open_direction(at);
        let is_open = one.standing == Standing::Undetermined;
        if is_open && !found.contains(&own) {
            found.push(own);
        }
    }
    let relative = |own: &[f64]| {
        let each = estimates.iter().zip(&best.fit.shares).zip(own);
        let each = each.map(|((one, share), change)| {
            let range = one.variable.high - one.variable.low;
            let size = match one.fitted.abs() {
                value if value > LEAST_APART * range => value,
                _ => range,
            };
            change * one.variable.slope(*share) / size
        });
        let each: Vec<f64> = each.collect();
        let greatest = each
            .iter()
            .copied()
            .max_by(|one, other| one.abs().total_cmp(&other.abs()))
            .unwrap_or(1.0);
        let each = estimates.iter().zip(each).map(|(one, own)| Change {
            path: one.variable.path.clone(),
            change: own / greatest,
        });
        each.filter(|one| one.change.abs() >= NO_PART).collect()
    };
    found.into_iter().map(relative).collect()
}
