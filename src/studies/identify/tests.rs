//! Fits of functions in closed form.

use super::{Certainty, Ending, Fit, Precision, RunsTest, fit};

/// Free decay of a mass from rest: J·ẍ + b·ẋ + c·x = 0 with b = ψ·√(cJ)/2π.
fn decay([stiffness, capacity]: [f64; 2], time: f64) -> f64 {
    let (inertia, start) = (0.1, 1e-3);
    let natural = (stiffness / inertia).sqrt();
    let share = capacity / (2.0 * std::f64::consts::TAU);
    let own = natural * (1.0 - share * share).sqrt();
    let slow = (-share * natural * time).exp();
    start * slow * ((own * time).cos() + share * natural / own * (own * time).sin())
}

fn record() -> Vec<(f64, f64)> {
    let one = |number: i32| {
        let (time, place) = (f64::from(number) * 2e-5, f64::from(number).powi(2));
        (time, decay([1e7, 0.4], time) + 1e-6 * place.sin())
    };
    (1..=200).map(one).collect()
}

/// Ranges of stiffness and damping capacity.
const RANGES: [[f64; 2]; 2] = [[2e6, 3e7], [0.0, 1.0]];

/// Precision of functions that are known to rounding.
const PRECISION: Precision = Precision {
    step: 1e-4,
    error: 1e-15,
};

fn values(shares: &[f64], ranges: &[[f64; 2]]) -> Vec<f64> {
    let each = shares.iter().zip(ranges);
    each.map(|(share, [low, high])| low + share * (high - low))
        .collect()
}

/// The fit of a function of the values, from a start in their ranges, and where it ended.
fn fit_in(
    ranges: &[[f64; 2]],
    start: &[f64],
    of: &dyn Fn(&[f64]) -> Option<Vec<f64>>,
) -> Option<(Fit, Vec<f64>)> {
    let each = start.iter().zip(ranges);
    let start: Vec<f64> = each
        .map(|(value, [low, high])| (value - low) / (high - low))
        .collect();
    let residuals =
        |rows: &[Vec<f64>]| Some(rows.iter().map(|row| of(&values(row, ranges))).collect());
    let found = fit(&start, 1.0, PRECISION, &residuals)?;
    let at = values(&found.shares, ranges);
    Some((found, at))
}

fn residuals(row: &[f64]) -> Option<Vec<f64>> {
    let each = record().into_iter();
    Some(
        each.map(|(time, own)| decay([row[0], row[1]], time) - own)
            .collect(),
    )
}

/// √Σy² of the record.
fn size() -> f64 {
    let squares = record().into_iter().map(|(_, own)| own * own);
    squares.sum::<f64>().sqrt()
}

fn assert_close(found: f64, wanted: f64, within: f64) {
    let off = (found / wanted - 1.0).abs();
    assert!(off <= within, "{found} and {wanted}: {off}");
}

/// `identify` of tests/reference/design-optimum-tolerance.json.
#[test]
fn a_free_decay_is_that_of_the_reference() {
    let (found, at) = fit_in(&RANGES, &[9e6, 0.2], &residuals).unwrap();
    assert_eq!(found.ending, Ending::Converged);
    assert_close(at[0], 10_000_177.414_787_5, 1e-10);
    assert_close(at[1], 0.400_086_167_145_674_3, 1e-8);
    let certainty = Certainty::of(&found, size(), PRECISION).unwrap();
    let error = |at: usize| certainty.errors[at].unwrap() * (RANGES[at][1] - RANGES[at][0]);
    assert_close(error(0), 146.0661925, 1e-7);
    assert_close(error(1), 9.314005888e-5, 1e-7);
    assert_close(certainty.correlations[(0, 1)], 0.05026532297, 1e-6);
    assert_close(certainty.sigma, 7.02094445905e-7, 1e-9);
    assert!(certainty.correlated().is_empty());
    assert!(RunsTest::of(&found.residuals).unwrap().is_random());
}

#[test]
fn a_far_start_ends_in_another_minimum_or_the_same() {
    let (found, _) = fit_in(&RANGES, &[2.5e7, 0.2], &residuals).unwrap();
    let (best, _) = fit_in(&RANGES, &[1e7, 0.4], &residuals).unwrap();
    assert!(found.cost() >= best.cost() * (1.0 - 1e-9));
}

/// A sum of which the record determines the product of two parameters alone.
#[test]
fn a_product_leaves_a_direction_open() {
    let rows = |row: &[f64]| {
        let at = |number: i32| {
            let t = f64::from(number) / 50.0;
            let wanted = 6.0 * t + 0.01 * f64::from(number * number).sin();
            row[0] * row[1] * t - wanted
        };
        Some((0..50).map(at).collect())
    };
    let (found, at) = fit_in(&[[0.1, 10.0]; 2], &[2.0, 2.5], &rows).unwrap();
    assert_close(at[0] * at[1], 6.0, 1e-2);
    let certainty = Certainty::of(&found, 20.0, PRECISION).unwrap();
    assert_eq!(certainty.errors, [None, None]);
    // Along it p₁p₂ stays: δp₁/δp₂ = −p₁/p₂.
    let open = certainty.open_direction(0);
    assert_eq!(open, certainty.open_direction(1));
    assert_close(open[0] / open[1], -at[0] / at[1], 1e-5);
}

/// The same with a second effect of one of both: each has an error, and both are correlated.
#[test]
fn a_product_with_a_small_second_effect_is_correlated() {
    let rows = |row: &[f64]| {
        let at = |number: i32| {
            let t = f64::from(number) / 50.0;
            let wanted = 6.0 * t + 0.2 * t * t + 1e-4 * f64::from(number * number).sin();
            row[0] * row[1] * t + 0.1 * row[0] * t * t - wanted
        };
        Some((0..50).map(at).collect())
    };
    let (found, _) = fit_in(&[[0.1, 10.0]; 2], &[2.0, 2.5], &rows).unwrap();
    let certainty = Certainty::of(&found, 20.0, PRECISION).unwrap();
    assert!(
        certainty.errors.iter().all(Option::is_some),
        "{certainty:?}"
    );
    let correlated = certainty.correlated();
    assert!(
        correlated.len() == 1 && correlated[0].2 < -0.99,
        "{correlated:?}"
    );
}

/// A number without any effect has no error, and takes nothing from the others.
#[test]
fn a_number_without_effect_is_unknown_alone() {
    let rows = |row: &[f64]| {
        let at = |number: i32| row[0] * f64::from(number) - 3.0 * f64::from(number) - 0.1;
        Some((0..9).map(at).collect())
    };
    let (found, _) = fit_in(&[[0.0, 10.0]; 2], &[1.0, 4.0], &rows).unwrap();
    let certainty = Certainty::of(&found, 40.0, PRECISION).unwrap();
    assert!(certainty.errors[0].is_some() && certainty.errors[1].is_none());
    assert_eq!(certainty.open_direction(1), [0.0, 1.0]);
}

#[test]
fn ends_of_ranges_are_kept() {
    let rows = |row: &[f64]| Some(vec![row[0] - 5.0, 2.0 * row[1] - 2.0, 0.0]);
    let (found, at) = fit_in(&[[0.0, 3.0]; 2], &[1.0, 2.0], &rows).unwrap();
    assert_eq!((at[0], found.ending), (3.0, Ending::Converged));
    assert_close(at[1], 1.0, 1e-10);
}

/// |p − 5| + 1 is least at its kink: slopes of either side promise more.
#[test]
fn a_kink_is_an_ending_of_its_own() {
    for start in [1.0, 2.7, 7.3, 9.9] {
        let rows = |row: &[f64]| Some(vec![(row[0] - 5.0).abs() + 1.0, 0.3, -0.2]);
        let (found, at) = fit_in(&[[0.0, 10.0]], &[start], &rows).unwrap();
        assert_eq!(found.ending, Ending::Stalled, "{start}: {at:?}");
        assert!((at[0] - 5.0).abs() < 0.05, "{start}: {at:?}");
    }
    // A jump: the sum of squares is least just before it.
    let rows = |row: &[f64]| match row[0] < 5.0 {
        true => Some(vec![7.0 - row[0], 0.1]),
        false => Some(vec![9.0, 0.1]),
    };
    let (found, at) = fit_in(&[[0.0, 10.0]], &[1.0], &rows).unwrap();
    assert_eq!(found.ending, Ending::Stalled, "{at:?}");
}

/// Residuals without noise end at rounding, which is no kink.
#[test]
fn an_exact_record_converges() {
    let exact = |row: &[f64]| {
        let times = (1..=200).map(|number| 2e-5 * f64::from(number));
        Some(
            times
                .map(|t| decay([row[0], row[1]], t) - decay([1e7, 0.4], t))
                .collect(),
        )
    };
    let (found, at) = fit_in(&RANGES, &[9e6, 0.2], &exact).unwrap();
    assert_eq!(found.ending, Ending::Converged, "{at:?}");
}

/// At a bound the errors of the others are those of a fit in which the number is not sought.
#[test]
fn errors_at_an_end_are_those_of_the_others_alone() {
    let noise = |at: i32| 0.01 * f64::from(at * at).sin();
    let at = |p: f64, q: f64, t: f64| p * t + q * t * t;
    let rows = |row: &[f64]| {
        let own = |n: i32| {
            let t = f64::from(n) / 40.0;
            at(row[0], row[1], t) - at(2.0, 5.0, t) - noise(n)
        };
        Some((1..=40).map(own).collect())
    };
    let alone = |row: &[f64]| rows(&[row[0], 3.0]);
    let (held, at_held) = fit_in(&[[0.0, 10.0], [0.0, 3.0]], &[1.0, 1.0], &rows).unwrap();
    let (fixed, at_fixed) = fit_in(&[[0.0, 10.0]], &[1.0], &alone).unwrap();
    assert_eq!(at_held[1], 3.0);
    assert_close(at_held[0], at_fixed[0], 1e-9);
    let of = |fit: &Fit| Certainty::of(fit, 1.0, PRECISION).unwrap();
    let (held, fixed) = (of(&held), of(&fixed));
    assert_eq!((held.errors[1], held.free), (None, fixed.free));
    assert_close(held.errors[0].unwrap(), fixed.errors[0].unwrap(), 1e-9);
    assert_close(held.sigma, fixed.sigma, 1e-9);
}

/// Along one standard error the sum of squares of linear residuals rises by s².
#[test]
fn one_error_raises_the_sum_of_squares_by_the_variance() {
    let rows = |row: &[f64]| {
        let own = |n: i32| {
            let t = f64::from(n) / 40.0;
            (row[0] - 2.0) * t + (row[1] - 5.0) * t * t - 0.1 * f64::from(n * n).sin()
        };
        Some((1..=40).map(own).collect())
    };
    let ranges = [[0.0, 10.0]; 2];
    let (found, _) = fit_in(&ranges, &[1.0, 1.0], &rows).unwrap();
    let certainty = Certainty::of(&found, 1.0, PRECISION).unwrap();
    for at in 0..2 {
        let changes = certainty.one_error(at).unwrap();
        let moved: Vec<f64> = found
            .shares
            .iter()
            .zip(&changes)
            .map(|(own, by)| own + by)
            .collect();
        let own: Vec<f64> = rows(&values(&moved, &ranges)).unwrap();
        let rise = own.iter().map(|one| one * one).sum::<f64>() - 2.0 * found.cost();
        assert_close(rise, certainty.sigma.powi(2), 1e-6);
    }
    let share_of = |rows: &dyn Fn(&[f64]) -> Option<Vec<f64>>| {
        let all =
            |own: &[Vec<f64>]| Some(own.iter().map(|row| rows(&values(row, &ranges))).collect());
        super::quality::linear(&found, &certainty, 1e-15, &all).unwrap()
    };
    assert_eq!(share_of(&rows), [true, true]);
    // The same fit, but behind it a kink.
    let fitted = values(&found.shares, &ranges)[0];
    let kink = |row: &[f64]| rows(&[row[0] + 5.0 * (row[0] - fitted).max(0.0), row[1]]);
    assert!(share_of(&kink).contains(&false));
}

#[test]
fn what_cannot_be_computed_ends_a_fit() {
    let rows = |row: &[f64]| (row[0] < 1.0).then(|| vec![row[0] - 2.0, 0.0]);
    let (_, at) = fit_in(&[[0.0, 5.0]], &[0.5], &rows).unwrap();
    assert!(at[0] > 0.99 && at[0] < 1.0, "{at:?}");
    assert!(fit_in(&[[0.0, 5.0]], &[4.0], &rows).is_none());
    assert!(fit(&[0.5], 1.0, PRECISION, &|_| None).is_none());
}

/// What is known when it is ended from outside is kept.
#[test]
fn an_interrupted_fit_keeps_its_values() {
    for calls in 1..12 {
        let left = std::cell::Cell::new(calls);
        let rows = |rows: &[Vec<f64>]| {
            left.set(left.get() - 1);
            let own = |row: &Vec<f64>| residuals(&values(row, &RANGES));
            (left.get() >= 0).then(|| rows.iter().map(own).collect())
        };
        let start = [0.25, 0.2];
        let found = fit(&start, size(), PRECISION, &rows).unwrap();
        assert_eq!(found.ending, Ending::Interrupted, "{calls}");
        assert_eq!(
            found.residuals,
            residuals(&values(&found.shares, &RANGES)).unwrap()
        );
        let first = residuals(&values(&start, &RANGES)).unwrap();
        assert!(
            found.residuals == first
                || found.cost() < 0.5 * first.iter().map(|r| r * r).sum::<f64>()
        );
    }
}

#[test]
fn runs_of_signs_are_counted() {
    // Of 20 residuals in two runs: μ = 11, σ² = 90/19·… (hand: 200·180/(400·19)).
    let half: Vec<f64> = (0..20).map(|at| if at < 10 { 1.0 } else { -1.0 }).collect();
    let found = RunsTest::of(&half).unwrap();
    assert_eq!((found.runs, found.expected), (2, 11.0));
    let sigma = (200.0f64 * 180.0 / (400.0 * 19.0)).sqrt();
    let z: f64 = 9.0 / sigma;
    assert!(
        z > 4.0 && found.probability < 1e-4 && !found.is_random(),
        "{found:?}"
    );
    assert_eq!(RunsTest::of(&[1.0, 2.0]), None);
    assert_eq!(RunsTest::of(&[1.0, 0.0, -2.0]).unwrap().runs, 2);
}

/// In a great range the step of differences is too long at first for so many oscillations.
#[test]
fn a_great_range_has_shorter_steps() {
    let rows = |row: &[f64]| {
        let at = |number: i32| {
            let time = f64::from(number) * 0.01;
            (row[0] * time).sin() - (100.0 * time).sin() - 1e-3 * f64::from(number * number).sin()
        };
        Some((0..400).map(at).collect())
    };
    let ranges = [[0.0, 1e5]];
    let (found, at) = fit_in(&ranges, &[100.1], &rows).unwrap();
    assert_eq!(found.ending, Ending::Converged);
    assert!(found.step < PRECISION.step, "{}", found.step);
    assert!((at[0] - 100.0).abs() < 1e-3, "{at:?}");
    // dr/dω = t·cos ωt.
    let jacobian = found.jacobian.as_ref().unwrap();
    for number in [17, 399] {
        let time = f64::from(number) * 0.01;
        let wanted = 1e5 * time * (at[0] * time).cos();
        let own = jacobian[(number as usize, 0)];
        assert!((own - wanted).abs() < 0.02 * 1e5 * time, "{own} {wanted}");
    }
}
