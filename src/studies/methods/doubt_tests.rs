//! Doubt over tables of results: the end values of a wheel behind a smooth written motion.

use super::{Doubt, Witness, doubt_about_reference};
use crate::dynamics::integrate::Method;

/// A run: its method, its tolerance, and the greatest deflection that it found (rad).
type Row = (Method, f64, f64);

/// What two right methods find: 0.307973416 rad, within their tolerances.
fn right() -> Vec<Row> {
    let mut rows = Vec::new();
    for (method, share) in [(Method::Dop853, 0.7), (Method::Radau, -0.4)] {
        for tolerance in [1e-6, 1e-8, 1e-10] {
            rows.push((method, tolerance, 0.307_973_416 * (1.0 + share * tolerance)));
        }
    }
    rows
}

fn judge(rows: &[Row], resolution: f64) -> Option<Doubt> {
    let witness = |row: &Row| {
        Some(Witness {
            method: row.0,
            tolerance: (row.0 != Method::Exact).then_some(row.1),
        })
    };
    let witnesses: Vec<_> = rows.iter().map(witness).collect();
    doubt_about_reference(&witnesses, (0, "exact"), resolution, |a, b| {
        let (a, b) = (rows[a].2, rows[b].2);
        Some((a - b).abs() / a.abs().max(b.abs()))
    })
}

fn with_reference(value: f64, others: Vec<Row>) -> Vec<Row> {
    std::iter::once((Method::Exact, 0.0, value))
        .chain(others)
        .collect()
}

#[test]
fn a_reference_that_sees_no_deflection_is_in_doubt() {
    let found = judge(&with_reference(0.0, right()), 1e-15).expect("a doubt");
    assert_eq!(found.methods, [Method::Dop853, Method::Radau]);
    assert_eq!((found.settings, found.from_reference), (3, 1.0));
    assert!(found.between < 2e-6, "{found:?}");
    let text = found.sentence();
    assert!(
        text.starts_with("the reference exact is in doubt: dop853 and radau agree to"),
        "{text}"
    );
}

#[test]
fn a_reference_that_is_a_little_wrong_is_in_doubt_too() {
    let wrong = 0.307_973_416 * 1.001;
    assert!(judge(&with_reference(wrong, right()), 1e-15).is_some());
}

#[test]
fn a_right_reference_is_not_in_doubt() {
    assert_eq!(judge(&with_reference(0.307_973_416, right()), 1e-15), None);
    // Off by less than the coarsest tolerance that is compared.
    let near = 0.307_973_416 * (1.0 + 3e-6);
    assert_eq!(judge(&with_reference(near, right()), 1e-15), None);
}

#[test]
fn what_cannot_be_resolved_raises_no_doubt() {
    let wrong = 0.307_973_416 * 1.001;
    assert_eq!(judge(&with_reference(wrong, right()), 1e-3), None);
}

#[test]
fn methods_that_do_not_agree_raise_no_doubt() {
    let mut others = right();
    for row in &mut others[3..] {
        row.2 *= 1.1;
    }
    assert_eq!(judge(&with_reference(0.0, others), 1e-15), None);
}

#[test]
fn one_method_alone_or_one_setting_each_raises_no_doubt() {
    let alone = right()[..3].to_vec();
    assert_eq!(judge(&with_reference(0.0, alone), 1e-15), None);
    let once = vec![right()[2], right()[5]];
    assert_eq!(judge(&with_reference(0.0, once), 1e-15), None);
}
