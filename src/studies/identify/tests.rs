//! Fits of functions in closed form.

use super::{Bounds, Certainty, Ending, RunsTest, fit};

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

fn bounds() -> [Bounds; 2] {
    let of = |lower: f64, upper: f64| Bounds {
        lower,
        upper,
        scale: upper - lower,
    };
    [of(2e6, 3e7), of(0.0, 1.0)]
}

fn residuals(rows: &[Vec<f64>]) -> Option<Vec<Option<Vec<f64>>>> {
    let one = |row: &Vec<f64>| {
        let each = record().into_iter();
        Some(
            each.map(|(time, own)| decay([row[0], row[1]], time) - own)
                .collect(),
        )
    };
    Some(rows.iter().map(one).collect())
}

fn assert_close(found: f64, wanted: f64, within: f64) {
    let off = (found / wanted - 1.0).abs();
    assert!(off <= within, "{found} and {wanted}: {off}");
}

/// `identify` of tests/reference/design-optimum-tolerance.json.
#[test]
fn a_free_decay_is_that_of_the_reference() {
    let found = fit(&[9e6, 0.2], &bounds(), &residuals).unwrap();
    assert_eq!(found.ending, Ending::Converged);
    assert_close(found.values[0], 10000177.4147875, 1e-10);
    assert_close(found.values[1], 0.4000861671456743, 1e-8);
    let certainty = Certainty::of(&found).unwrap();
    assert_close(certainty.errors[0].unwrap(), 146.0661925, 1e-7);
    assert_close(certainty.errors[1].unwrap(), 9.314005888e-5, 1e-7);
    assert_close(certainty.correlations[(0, 1)], 0.05026532297, 1e-6);
    assert_close(certainty.sigma, 7.02094445905e-7, 1e-9);
    assert!(certainty.correlated().is_empty());
    assert!(RunsTest::of(&found.residuals).unwrap().is_random());
}

#[test]
fn a_far_start_ends_in_another_minimum_or_the_same() {
    let found = fit(&[2.5e7, 0.2], &bounds(), &residuals).unwrap();
    let best = fit(&[1e7, 0.4], &bounds(), &residuals).unwrap();
    assert!(found.cost() >= best.cost() * (1.0 - 1e-9));
}

/// A sum of which the record determines the product of two parameters alone.
#[test]
fn a_product_is_named() {
    let rows = |rows: &[Vec<f64>]| {
        let one = |row: &Vec<f64>| {
            let at = |number: i32| {
                let t = f64::from(number) / 50.0;
                let wanted = 6.0 * t + 0.01 * f64::from(number * number).sin();
                row[0] * row[1] * t + 1e-6 * row[0] * t * t - wanted
            };
            Some((0..50).map(at).collect())
        };
        Some(rows.iter().map(one).collect())
    };
    let both = [Bounds {
        lower: 0.1,
        upper: 10.0,
        scale: 1.0,
    }; 2];
    let found = fit(&[2.0, 2.5], &both, &rows).unwrap();
    assert_close(found.values[0] * found.values[1], 6.0, 1e-2);
    let certainty = Certainty::of(&found).unwrap();
    let unknown = certainty.errors.iter().any(Option::is_none);
    assert!(
        unknown || certainty.correlated().len() == 1,
        "{certainty:?}"
    );
}

#[test]
fn bounds_are_kept() {
    let rows = |rows: &[Vec<f64>]| {
        Some(
            rows.iter()
                .map(|row| Some(vec![row[0] - 5.0, 2.0 * row[1] - 2.0, 0.0]))
                .collect(),
        )
    };
    let both = [Bounds {
        lower: 0.0,
        upper: 3.0,
        scale: 1.0,
    }; 2];
    let found = fit(&[1.0, 2.0], &both, &rows).unwrap();
    assert_eq!(found.values[0], 3.0);
    assert_close(found.values[1], 1.0, 1e-10);
    assert_eq!(found.ending, Ending::Converged);
}

#[test]
fn what_cannot_be_computed_ends_a_fit() {
    let rows = |rows: &[Vec<f64>]| {
        let one = |row: &Vec<f64>| (row[0] < 1.0).then(|| vec![row[0] - 2.0, 0.0]);
        Some(rows.iter().map(one).collect())
    };
    let own = [Bounds {
        lower: 0.0,
        upper: 5.0,
        scale: 1.0,
    }];
    let found = fit(&[0.5], &own, &rows).unwrap();
    assert!(found.values[0] > 0.99 && found.values[0] < 1.0, "{found:?}");
    assert!(fit(&[4.0], &own, &rows).is_none());
    assert!(fit(&[0.5], &own, &|_| None).is_none());
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
