//! Sobol indices: shares of the variance of a result that single dimensions make.
//!
//! The index of first order is the share that a dimension makes by itself, the total one that
//! with its interactions. The estimators are those of A. Saltelli and others (Computer Physics
//! Communications 181, 2010, table 2 b) and of M. J. W. Jansen (1999). Intervals are those of the
//! bootstrap: the points are drawn anew with repetition, and the estimates ordered.

use crate::dynamics::audit::draw;
use serde::Serialize;

/// Level of confidence of all intervals.
pub const LEVEL: f64 = 0.95;

/// Draws of the bootstrap.
const DRAWS: usize = 400;

/// An estimate with its interval.
#[derive(Clone, Copy, Debug, PartialEq, Serialize)]
pub struct Estimate {
    /// The estimate.
    pub value: f64,
    /// Interval at the level of confidence.
    pub within: [f64; 2],
}

impl Estimate {
    /// The upper end of an interval that contains 0: the index is no greater, and may be none.
    pub fn bound(&self) -> Option<f64> {
        (self.within[0] <= 0.0).then_some(self.within[1].max(0.0))
    }
}

/// Indices of a dimension.
#[derive(Clone, Copy, Debug, PartialEq, Serialize)]
pub struct Indices {
    /// Index of first order.
    pub first: Estimate,
    /// Total index.
    pub total: Estimate,
}

/// Indices of all dimensions from the results of the runs of each point (`rows` of
/// [`SamplePlan`](super::SamplePlan)), all finite; `None`: there are too few points, or nothing varies.
pub(super) fn indices(points: &[Vec<f64>]) -> Option<Vec<Indices>> {
    let count = points
        .first()?
        .len()
        .checked_sub(2)
        .filter(|count| *count > 0)?;
    let all: Vec<usize> = (0..points.len()).collect();
    let own = estimates(points, &all, count)?;
    let mut drawn: Vec<Vec<[f64; 2]>> = (0..DRAWS)
        .filter_map(|number| estimates(points, &resampled(points.len(), number), count))
        .collect();
    if points.len() < 8 || drawn.len() < DRAWS / 2 {
        return None;
    }
    let within = |at: usize, kind: usize, drawn: &mut Vec<Vec<[f64; 2]>>| {
        drawn.sort_by(|a, b| a[at][kind].total_cmp(&b[at][kind]));
        let place = |share: f64| (share * (drawn.len() - 1) as f64).round() as usize;
        let outside = 0.5 * (1.0 - LEVEL);
        [place(outside), place(1.0 - outside)].map(|place| drawn[place][at][kind])
    };
    let mut estimate = |at: usize, kind: usize| Estimate {
        value: own[at][kind],
        within: within(at, kind, &mut drawn),
    };
    let of = |at: usize| Indices {
        first: estimate(at, 0),
        total: estimate(at, 1),
    };
    Some((0..count).map(of).collect())
}

/// Places of one draw of the bootstrap; the same for every result.
fn resampled(count: usize, number: usize) -> Vec<usize> {
    let place = |at: usize| {
        let drawn = draw(draw(number as u64 + 1) ^ at as u64);
        ((u128::from(drawn) * count as u128) >> 64) as usize
    };
    (0..count).map(place).collect()
}

/// First and total index of all dimensions from some of the points; `None`: nothing varies.
fn estimates(points: &[Vec<f64>], chosen: &[usize], count: usize) -> Option<Vec<[f64; 2]>> {
    let number = chosen.len() as f64;
    let chosen = || chosen.iter().map(|at| points[*at].as_slice());
    let mean = chosen().map(|own| own[0] + own[1]).sum::<f64>() / (2.0 * number);
    let squares = chosen().map(|own| (own[0] - mean).powi(2) + (own[1] - mean).powi(2));
    let variance = squares.sum::<f64>() / (2.0 * number);
    if variance.is_nan() || variance <= 0.0 {
        return None;
    }
    let mut sums = vec![[0.0; 2]; count];
    for own in chosen() {
        let (a, b) = (own[0], own[1]);
        for (sum, mixed) in sums.iter_mut().zip(&own[2..]) {
            sum[0] += (b - mean) * (mixed - a);
            sum[1] += 0.5 * (mixed - a).powi(2);
        }
    }
    let share = |sum: [f64; 2]| sum.map(|one| one / number / variance);
    Some(sums.into_iter().map(share).collect())
}

#[cfg(test)]
mod tests {
    use super::super::SamplePlan;
    use super::super::zone::{Distribution, Zone};
    use super::{Estimate, indices};
    use std::f64::consts::PI;

    /// The function of T. Ishigami and T. Homma (1990) with a = 7 and b = 0.1.
    fn ishigami(x: &[f64]) -> f64 {
        x[0].sin() + 7.0 * x[1].sin().powi(2) + 0.1 * x[2].powi(4) * x[0].sin()
    }

    /// `ishigami` of tests/reference/design-optimum-tolerance.json, in closed form.
    const FIRST: [f64; 3] = [0.31390519114781146, 0.4424111447900408, 0.0];
    const TOTAL: [f64; 3] = [0.5575888552099592, 0.4424111447900408, 0.24368366406214773];

    fn points(seed: u32, count: usize) -> Vec<Vec<f64>> {
        let zone = Zone {
            lower: -PI,
            upper: PI,
            distribution: Distribution::Uniform,
        };
        let plan = SamplePlan::new(vec![zone; 3], seed);
        (0..count)
            .map(|point| plan.rows(point).iter().map(|row| ishigami(row)).collect())
            .collect()
    }

    #[test]
    fn indices_of_the_ishigami_function_are_found() {
        let found = indices(&points(1, 16384)).unwrap();
        for (at, own) in found.iter().enumerate() {
            assert!((own.first.value - FIRST[at]).abs() < 3e-3, "{at}: {own:?}");
            assert!((own.total.value - TOTAL[at]).abs() < 3e-3, "{at}: {own:?}");
        }
        assert!(
            found[2]
                .first
                .bound()
                .is_some_and(|bound| (0.0..0.03).contains(&bound))
        );
        assert_eq!(found[0].first.bound(), None);
    }

    #[test]
    fn intervals_hold_the_index_for_95_of_100_seeds() {
        let holds = |own: &Estimate, wanted: f64| (own.within[0]..=own.within[1]).contains(&wanted);
        let mut held = [[0; 2]; 3];
        for seed in 0..100 {
            let found = indices(&points(seed, 512)).unwrap();
            for (at, own) in found.iter().enumerate() {
                held[at][0] += u32::from(holds(&own.first, FIRST[at]));
                held[at][1] += u32::from(holds(&own.total, TOTAL[at]));
            }
        }
        assert!(held.iter().flatten().all(|count| *count >= 95), "{held:?}");
    }

    #[test]
    fn nothing_that_varies_has_no_indices() {
        assert_eq!(indices(&vec![vec![1.0; 5]; 100]), None);
        assert_eq!(indices(&[]), None);
        assert_eq!(indices(&vec![vec![1.0, 2.0]; 100]), None);
    }
}
