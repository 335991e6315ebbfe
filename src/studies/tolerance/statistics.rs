//! What samples say of a result: mean, spread, quantiles, and how many meet a limit.

use super::indices::{Estimate, LEVEL};
use crate::math::probability::{normal_quantile, share_interval};
use serde::Serialize;

/// Shares of the quantiles: ±3 standard deviations of a normal distribution, 95 of 100, half.
pub const QUANTILES: [f64; 5] = [0.00135, 0.025, 0.5, 0.975, 0.99865];

/// Distribution of a result over the samples that have it.
#[derive(Clone, Debug, PartialEq, Serialize)]
pub struct Spread {
    /// Number of these samples.
    pub count: usize,
    /// Mean with its interval.
    pub mean: Estimate,
    /// Standard deviation.
    pub sigma: f64,
    /// Skewness: 0 of what is symmetric.
    pub skewness: f64,
    /// Least value.
    pub least: f64,
    /// Greatest value.
    pub greatest: f64,
    /// Values that are not exceeded by shares of all: [`QUANTILES`].
    pub quantiles: [f64; 5],
}

impl Spread {
    /// Of values; `None`: there are fewer than two.
    pub fn of(values: &[f64]) -> Option<Self> {
        let count = values.len();
        if count < 2 {
            return None;
        }
        let number = count as f64;
        // (About one of them, so that the digits of a small spread are kept.)
        let origin = values[0];
        let mean = values.iter().map(|value| value - origin).sum::<f64>() / number;
        let moment = |power: i32| {
            let each = values
                .iter()
                .map(|value| (value - origin - mean).powi(power));
            each.sum::<f64>()
        };
        let sigma = (moment(2) / (number - 1.0)).sqrt();
        let skewness = match sigma > 0.0 {
            true => moment(3) / number / sigma.powi(3),
            false => 0.0,
        };
        let mean = origin + mean;
        let reach = normal_quantile(0.5 * (1.0 + LEVEL)) * sigma / number.sqrt();
        let mut sorted = values.to_vec();
        sorted.sort_by(f64::total_cmp);
        Some(Self {
            count,
            mean: Estimate {
                value: mean,
                within: [mean - reach, mean + reach],
            },
            sigma,
            skewness,
            least: sorted[0],
            greatest: sorted[count - 1],
            quantiles: QUANTILES.map(|share| quantile(&sorted, share)),
        })
    }
}

/// Quantile of ascending values, linear between two of them.
fn quantile(sorted: &[f64], share: f64) -> f64 {
    let place = share * (sorted.len() - 1) as f64;
    let below = place.floor() as usize;
    let above = (below + 1).min(sorted.len() - 1);
    sorted[below] + (place - below as f64) * (sorted[above] - sorted[below])
}

/// Share of samples that are good, with its interval.
#[derive(Clone, Copy, Debug, PartialEq, Serialize)]
pub struct Yield {
    /// Good samples.
    pub good: usize,
    /// All samples.
    pub samples: usize,
    /// Their share with its interval of Clopper and Pearson.
    pub share: Estimate,
}

impl Yield {
    /// Of so many good ones among all; `None`: there are no samples.
    pub fn of(good: usize, samples: usize) -> Option<Self> {
        (samples > 0).then(|| Self {
            good,
            samples,
            share: Estimate {
                value: good as f64 / samples as f64,
                within: share_interval(good, samples, LEVEL),
            },
        })
    }
}

#[cfg(test)]
mod tests {
    use super::{Spread, Yield};

    #[test]
    fn spreads_are_those_of_their_definitions() {
        // NumPy 2: mean, std(ddof=1), quantile.
        let found = Spread::of(&[3.0, 1.0, 2.0, 10.0]).unwrap();
        assert_eq!(
            (found.mean.value, found.least, found.greatest),
            (4.0, 1.0, 10.0)
        );
        assert!((found.sigma - 4.08248290463863).abs() < 1e-13);
        assert!((found.quantiles[2] - 2.5).abs() < 1e-14);
        assert!((found.quantiles[1] - 1.075).abs() < 1e-13);
        let shifted = Spread::of(&[1e9 + 3.0, 1e9 + 1.0, 1e9 + 2.0, 1e9 + 10.0]).unwrap();
        assert!((shifted.sigma - found.sigma).abs() < 1e-12);
        assert!((shifted.skewness - found.skewness).abs() < 1e-12);
        assert_eq!(Spread::of(&[1.0]), None);
        assert_eq!(Spread::of(&[1.0, 1.0]).unwrap().skewness, 0.0);
    }

    #[test]
    fn a_yield_of_all_samples_has_an_interval_below_one() {
        let found = Yield::of(10, 10).unwrap();
        assert_eq!(found.share.value, 1.0);
        assert_eq!(found.share.within[1], 1.0);
        assert!((found.share.within[0] - 0.6915028921812371).abs() < 1e-9);
        assert_eq!(Yield::of(0, 0), None);
    }
}
