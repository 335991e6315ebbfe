//! Whether a fit explains its records.

use super::certainty::Certainty;
use super::differences::{Precision, Residuals};
use super::fit::Fit;
use super::misfit::{ChiSquared, Misfit};
use super::result::FittedSignal;

/// Multiple of a stated standard deviation up to which it may be the statement that is wrong.
const FAR_ABOVE: f64 = 1.5;

/// Share of the variation of a signal beyond which residuals that are not random are no small
/// error of the model.
const UNEXPLAINED: f64 = 0.1;

/// Multiple of the error of runs below which residuals say nothing.
const PRECISE: f64 = 10.0;

/// Multiple of the usual deviation beyond which a row is an outlier.
const OUTLIER: f64 = 6.0;

/// Standard deviation of the normal distribution over its median absolute deviation.
const OF_MEDIAN: f64 = 1.482_602_218_505_602;

/// Least part of a standard error at which the sum of squares is tried.
const LEAST_PART: f64 = 0.1;

/// Rise of the sum of squares over the predicted one, within which a standard error holds.
const LINEAR: [f64; 2] = [0.4, 2.5];

/// Why a fit does not explain its records. `share`: degrees of freedom of a residual.
pub(super) fn misfit(signals: &[FittedSignal], share: f64) -> Option<Misfit> {
    let worst = |found: Vec<(f64, &FittedSignal)>| {
        let worst = found
            .into_iter()
            .max_by(|one, other| one.0.total_cmp(&other.0));
        worst.map(|(value, one)| (value, one.column.clone()))
    };
    let above = signals.iter().filter_map(|one| {
        one.sigma?;
        let own = ChiSquared::of(&one.residuals, share * one.residuals.len() as f64);
        let is_far = own.is_improbable() && own.ratio() > FAR_ABOVE;
        is_far.then(|| (own.ratio(), one))
    });
    if let Some((ratio, column)) = worst(above.collect()) {
        return Some(Misfit::AboveSigma { column, ratio });
    }
    // (Whatever is stated: a large σ explains nothing.)
    let left = signals.iter().filter_map(|one| {
        let is_random = one.test.is_some_and(|test| test.is_random());
        let left = one.unexplained();
        (!is_random && !one.is_exact && left > UNEXPLAINED).then_some((left, one))
    });
    let (share, column) = worst(left.collect())?;
    Some(Misfit::Unexplained { column, share })
}

/// Whether residuals are no more than what runs are known to.
pub(super) fn is_exact(signal: &FittedSignal, precision: Precision) -> bool {
    let squares: f64 = signal.measured.iter().map(|one| one * one).sum();
    let size = (squares / signal.measured.len().max(1) as f64).sqrt();
    signal.rms() <= PRECISE * precision.error * size
}

/// Rows of a signal whose residuals stand out from all others, with their multiples of the usual
/// deviation.
pub(super) fn outliers(signal: &FittedSignal) -> Vec<(usize, f64)> {
    let middle = median(signal.residuals.clone());
    let off = |own: &f64| (own - middle).abs();
    let usual = OF_MEDIAN * median(signal.residuals.iter().map(off).collect());
    if !(usual > 0.0) || signal.is_exact {
        return Vec::new();
    }
    let each = signal.residuals.iter().map(|own| off(own) / usual);
    let found = each.enumerate().filter(|(_, ratio)| *ratio > OUTLIER);
    found.collect()
}

fn median(mut values: Vec<f64>) -> f64 {
    values.sort_by(f64::total_cmp);
    match (values.len() / 2, values.len() % 2) {
        (0, 0) => 0.0,
        (half, 0) => 0.5 * (values[half - 1] + values[half]),
        (half, _) => values[half],
    }
}

/// Whether the standard error of each parameter holds: at one of it to either side the sum of
/// squares rises by about s², as linear residuals have it. `None`: ended from outside.
pub(super) fn linear(
    fit: &Fit,
    certainty: &Certainty,
    error: f64,
    residuals: &Residuals<'_>,
) -> Option<Vec<bool>> {
    let (mut rows, mut of) = (Vec::new(), Vec::new());
    for at in 0..fit.shares.len() {
        let Some(changes) = certainty.one_error(at) else {
            continue;
        };
        for sign in [1.0, -1.0] {
            let part = part_within(&fit.shares, &changes, sign);
            let rise = 0.5 * (certainty.sigma * part).powi(2);
            // (Errors of runs hide a smaller rise.)
            let noise = error * ((2.0 * fit.cost()).sqrt() + error);
            if part >= LEAST_PART && rise >= PRECISE * noise {
                let each = fit.shares.iter().zip(&changes);
                let own = each.map(|(share, change)| share + sign * part * change);
                rows.push(own.map(|share| share.clamp(0.0, 1.0)).collect());
                of.push((at, rise));
            }
        }
    }
    let found = match rows.is_empty() {
        true => Vec::new(),
        false => residuals(&rows)?,
    };
    let mut holds = vec![true; fit.shares.len()];
    for ((at, rise), own) in of.into_iter().zip(found) {
        let cost = |own: Vec<f64>| 0.5 * own.iter().map(|one| one * one).sum::<f64>();
        let ratio = own.map(|own| (cost(own) - fit.cost()) / rise);
        holds[at] &= ratio.is_some_and(|ratio| (LINEAR[0]..=LINEAR[1]).contains(&ratio));
    }
    Some(holds)
}

/// Part of changes that stays within the ranges, at most 1.
fn part_within(shares: &[f64], changes: &[f64], sign: f64) -> f64 {
    let each = shares.iter().zip(changes).map(|(share, change)| {
        let own = sign * change;
        match own > 0.0 {
            true => (1.0 - share) / own,
            false if own < 0.0 => share / -own,
            false => f64::INFINITY,
        }
    });
    each.fold(1.0, f64::min)
}

#[cfg(test)]
mod tests {
    use super::{misfit, outliers, part_within};
    use crate::studies::identify::{ChiSquared, FittedSignal, Misfit, RunsTest};

    fn signal(sigma: Option<f64>, measured: Vec<f64>, residuals: Vec<f64>) -> FittedSignal {
        FittedSignal {
            record: "a.csv".to_owned(),
            column: "x".to_owned(),
            address: "wheel.delta".to_owned(),
            unit: "rad".to_owned(),
            sigma,
            times: (0..measured.len()).map(|at| at as f64).collect(),
            test: RunsTest::of(&residuals),
            measured,
            residuals,
            is_exact: false,
            outliers: Vec::new(),
        }
    }

    fn wave(count: usize, size: f64, step: f64) -> Vec<f64> {
        (0..count)
            .map(|at| size * (step * at as f64).sin())
            .collect()
    }

    #[test]
    fn residuals_far_above_a_stated_error_are_no_fit() {
        let at = |size| signal(Some(1e-3), wave(200, 1.0, 0.1), wave(200, size, 9.7));
        assert_eq!(misfit(&[at(1.4)], 0.99), None);
        assert_eq!(
            misfit(&[at(2.0)], 0.99),
            None,
            "within what a statement may be off by"
        );
        let found = misfit(&[at(1.0), at(20.0)], 0.99);
        let Some(Misfit::AboveSigma { ratio, .. }) = found else {
            panic!("{found:?}");
        };
        // The root mean square of a wave, over the share of the degrees of freedom.
        assert!(
            (ratio - 20.0 / (2.0f64 * 0.99).sqrt()).abs() < 0.05,
            "{ratio}"
        );
        assert!(ChiSquared::of(&at(1.8).residuals, 198.0).is_improbable());
    }

    #[test]
    fn a_wave_that_is_left_over_is_no_fit() {
        let at = |size, step| signal(None, wave(200, 1.0, 0.1), wave(200, size, step));
        assert_eq!(
            misfit(&[at(0.5, 2.0)], 0.99).is_some(),
            !at(0.5, 2.0).test.unwrap().is_random()
        );
        assert!(matches!(
            misfit(&[at(0.5, 0.2)], 0.99),
            Some(Misfit::Unexplained { share, .. }) if (share - 0.5).abs() < 0.02
        ));
        // A stated error that is far too large does not excuse it.
        let stated = signal(Some(10.0), wave(200, 1.0, 0.1), wave(200, 0.05, 0.2));
        assert!(matches!(
            misfit(&[stated], 0.99),
            Some(Misfit::Unexplained { share, .. }) if (share - 0.5).abs() < 0.02
        ));
        assert_eq!(
            misfit(&[at(0.05, 0.2)], 0.99),
            None,
            "a small error of the model"
        );
    }

    #[test]
    fn an_outlier_stands_out() {
        let mut residuals = wave(101, 1.0, 9.7);
        assert!(outliers(&signal(None, vec![0.0; 101], residuals.clone())).is_empty());
        residuals[17] = 40.0;
        let found = outliers(&signal(None, vec![0.0; 101], residuals));
        assert!(
            found.len() == 1 && found[0].0 == 17 && found[0].1 > 20.0,
            "{found:?}"
        );
    }

    #[test]
    fn steps_stay_within_ranges() {
        let part = part_within(&[0.5, 0.9], &[0.1, 0.2], 1.0);
        assert!((part - 0.5).abs() < 1e-12, "{part}");
        assert_eq!(part_within(&[0.5, 0.9], &[0.1, 0.2], -1.0), 1.0);
        assert_eq!(part_within(&[0.5, 0.9], &[0.0, 0.0], 1.0), 1.0);
    }
}
