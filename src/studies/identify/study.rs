//! Fits from several starts, and what they say.

use super::certainty::{Certainty, RunsTest, UNDETERMINED};
use super::fit::{Bounds, Ending, Fit, Residuals, fit};
use sobol_burley::sample;

/// Relative difference of costs below which two fits are the same.
const SAME: f64 = 1e-6;

/// Number of the scene that is sought.
#[derive(Clone, Debug, PartialEq)]
pub struct Unknown {
    /// Address.
    pub path: String,
    /// Unit of its values; empty: the SI unit, or none.
    pub unit: String,
    /// Its range, in that unit.
    pub bounds: Bounds,
    /// Its value in the scene, in that unit; within the range.
    pub given: f64,
}

/// Signal of a record beside that of the best fit.
#[derive(Clone, Debug, PartialEq)]
pub struct FittedSignal {
    /// Record in which it stands.
    pub record: String,
    /// Column of the record.
    pub column: String,
    /// Address of the signal in the scene.
    pub address: String,
    /// SI unit.
    pub unit: String,
    /// Its standard deviation (SI): 1 if none is stated.
    pub weight: f64,
    /// Times (s).
    pub times: Vec<f64>,
    /// The signal of the record (SI).
    pub measured: Vec<f64>,
    /// Residuals of the fit over the weight, in the order of the times.
    pub residuals: Vec<f64>,
    /// Whether they are random; `None`: all have one sign.
    pub test: Option<RunsTest>,
}

/// An estimate.
#[derive(Clone, Debug, PartialEq)]
pub struct Estimate {
    /// Number of the scene.
    pub unknown: Unknown,
    /// Its value, in its unit.
    pub value: f64,
    /// Standard error; `None`: the record says nothing of it.
    pub error: Option<f64>,
    /// Whether the value lies at an end of its range.
    pub at_bound: bool,
}

impl Estimate {
    /// Whether the record determines it.
    pub fn is_determined(&self) -> bool {
        let relative = self.error.map(|error| error / self.value.abs());
        !self.at_bound && relative.is_some_and(|relative| relative <= UNDETERMINED)
    }
}

/// Result of one start.
#[derive(Clone, Debug, PartialEq)]
pub struct StartResult {
    /// The start, in the units of the numbers.
    pub start: Vec<f64>,
    /// Where it ended.
    pub end: Vec<f64>,
    /// Root of the mean square of the residuals there; `None`: the scene cannot be run at the
    /// start.
    pub rms: Option<f64>,
    /// Why it ended.
    pub ending: Ending,
}

/// Numbers of a scene from records.
#[derive(Clone, Debug, PartialEq)]
pub struct Identification {
    /// The estimates.
    pub estimates: Vec<Estimate>,
    /// Pairs of which the record determines a combination alone, with their correlations.
    pub correlated: Vec<(usize, usize, f64)>,
    /// Correlations of all pairs, row by row.
    pub correlations: Vec<Vec<f64>>,
    /// Standard deviation of a residual over its weight.
    pub sigma: f64,
    /// The signals.
    pub signals: Vec<FittedSignal>,
    /// The starts, in their order.
    pub starts: Vec<StartResult>,
    /// Why the best fit ended.
    pub ending: Ending,
    /// What is to be known, a line each.
    pub remarks: Vec<String>,
}

impl Identification {
    /// Whether the best fit converged and the record determines all numbers.
    pub fn is_answered(&self) -> bool {
        self.ending == Ending::Converged && self.estimates.iter().all(Estimate::is_determined)
    }

    /// Starts that ended at the best fit.
    pub fn starts_at_best(&self) -> usize {
        let rms = |one: &StartResult| one.rms;
        let best = self
            .starts
            .iter()
            .filter_map(rms)
            .fold(f64::INFINITY, f64::min);
        let same = |one: &&StartResult| one.rms.is_some_and(|own| own <= best * (1.0 + SAME));
        self.starts.iter().filter(same).count()
    }
}

/// Places from which fits start: the values of the scene, then points that fill the ranges.
pub fn starts(unknowns: &[Unknown], count: usize, seed: u32) -> Vec<Vec<f64>> {
    let given = unknowns.iter().map(|one| one.given).collect();
    let point = |number: usize| {
        let each = unknowns.iter().enumerate();
        each.map(|(at, one)| {
            let share = f64::from(sample(number as u32, at as u32, seed));
            one.bounds.lower + share * (one.bounds.upper - one.bounds.lower)
        })
        .collect()
    };
    std::iter::once(given)
        .chain((1..count).map(point))
        .collect()
}

/// The numbers from the best of the fits of all starts. `signals`: those of the residuals, in
/// their order, without residuals yet.
///
/// # Errors
/// The scene can be run at no start; the record has too few rows; it was ended from outside.
pub fn identify(
    unknowns: &[Unknown],
    places: &[Vec<f64>],
    signals: Vec<FittedSignal>,
    residuals: &Residuals<'_>,
) -> Result<Identification, String> {
    let bounds: Vec<Bounds> = unknowns.iter().map(|one| one.bounds).collect();
    let ended = std::cell::Cell::new(false);
    let watched = |rows: &[Vec<f64>]| {
        let found = residuals(rows);
        ended.set(ended.get() || found.is_none());
        found
    };
    let (mut best, mut results): (Option<Fit>, Vec<StartResult>) = (None, Vec::new());
    for start in places {
        let found = fit(start, &bounds, &watched);
        if ended.get() {
            return Err("the fit was interrupted".to_owned());
        }
        results.push(StartResult {
            start: start.clone(),
            end: found
                .as_ref()
                .map_or_else(|| start.clone(), |own| own.values.clone()),
            rms: found.as_ref().map(rms),
            ending: found.as_ref().map_or(Ending::NoResiduals, |own| own.ending),
        });
        best = match (best, found) {
            (Some(best), Some(found)) if found.cost() < best.cost() => Some(found),
            (None, found) => found,
            (best, _) => best,
        };
    }
    let best = best.ok_or("the scene cannot be run at any start")?;
    let certainty = Certainty::of(&best).ok_or_else(|| {
        let (rows, count) = (best.residuals.len(), unknowns.len());
        format!("the record has {rows} values, and {count} numbers are sought: more are needed")
    })?;
    Ok(summary(unknowns, (&best, &certainty), signals, results))
}

fn rms(fit: &Fit) -> f64 {
    (2.0 * fit.cost() / fit.residuals.len() as f64).sqrt()
}

fn summary(
    unknowns: &[Unknown],
    (best, certainty): (&Fit, &Certainty),
    mut signals: Vec<FittedSignal>,
    starts: Vec<StartResult>,
) -> Identification {
    let mut rest = best.residuals.iter().copied();
    for signal in &mut signals {
        signal.residuals = rest.by_ref().take(signal.times.len()).collect();
        signal.test = RunsTest::of(&signal.residuals);
    }
    let each = unknowns.iter().zip(&best.values).zip(&certainty.errors);
    let estimate = |((unknown, value), error): ((&Unknown, &f64), &Option<f64>)| Estimate {
        unknown: unknown.clone(),
        value: *value,
        error: *error,
        at_bound: *value <= unknown.bounds.lower || *value >= unknown.bounds.upper,
    };
    let rows = certainty.correlations.row_iter();
    Identification {
        estimates: each.map(estimate).collect(),
        correlated: certainty.correlated(),
        correlations: rows.map(|row| row.iter().copied().collect()).collect(),
        sigma: certainty.sigma,
        signals,
        starts,
        ending: best.ending,
        remarks: Vec::new(),
    }
}
