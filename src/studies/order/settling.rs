//! What a row of values settles on, each of a model with twice the coordinates of the one
//! before.
//!
//! A row has settled when its changes have shrunk twice running. What is left after the last
//! change d is that of a geometric series, d·ρ/(1 − ρ), with the measured factor ρ. No order
//! is assumed: where a scene has impacts, orders measured between n and 2n jump between −1.6
//! and 5. Only where the factor is the same twice is the row extrapolated.

/// Greatest factor by which changes may shrink in a row that counts as settled.
const GREATEST_FACTOR: f64 = 0.8;
/// Least factor that is believed: a change may be small by chance.
const LEAST_FACTOR: f64 = 0.2;
/// A change that is less than this share of the one before is small by chance too: what is
/// left may be of another origin than what has gone.
const LEAST_CHANGE: f64 = 0.02;
/// Factors that differ by less than this share of themselves are the same.
const SAME_FACTOR: f64 = 0.2;
/// An interval is so many times what the row shows of its rest.
const SAFETY: f64 = 3.0;

/// The limit of a row.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct SettledRow {
    /// Where it leads.
    pub limit: f64,
    /// How far the limit may be off, ≥ 0.
    pub error: f64,
    /// Order in 1/n, where the row shows one: changes shrink by 2^−order.
    pub order: Option<f64>,
}

/// What a row of values settles on; `None`: it has not settled. Changes up to `noise` are
/// none.
pub fn settled_row(values: &[f64], noise: f64) -> Option<SettledRow> {
    let &[.., a, b, c, d] = values else {
        return None;
    };
    let changes = [b - a, c - b, d - c];
    if !changes.iter().all(|change| change.is_finite()) {
        return None;
    }
    let size = changes.map(|change| change.abs());
    if size[1].max(size[2]) <= noise {
        return Some(SettledRow {
            limit: d,
            error: noise,
            order: None,
        });
    }
    // What cannot be told from nothing cannot have grown.
    let factor = |from: f64, to: f64| match to <= noise {
        true => 0.0,
        false => to / from,
    };
    let factors = [factor(size[0], size[1]), factor(size[1], size[2])];
    // Written so that a number that is none has not settled.
    if !(factors[0] <= GREATEST_FACTOR && factors[1] <= GREATEST_FACTOR) {
        return None;
    }
    let rest = |factor: f64| factor / (1.0 - factor);
    let last = factors[1];
    let greatest = factors[0].max(last).max(LEAST_FACTOR);
    let one_sided = changes[0] * changes[1] > 0.0 && changes[1] * changes[2] > 0.0;
    let same = (factors[0] - last).abs() <= SAME_FACTOR * last && last > LEAST_FACTOR;
    Some(match one_sided && same {
        true => {
            // As far as the factor has moved, it may move again.
            let moved = (factors[0] - last).abs();
            let further = rest((last + moved).min(0.9)) - rest((last - moved).max(0.0));
            SettledRow {
                limit: d + changes[2] * rest(last),
                error: SAFETY * size[2] * further.max(LEAST_FACTOR * rest(last)) + noise,
                order: Some(-last.log2()),
            }
        }
        false => SettledRow {
            limit: d,
            error: SAFETY * size[2].max(LEAST_CHANGE * size[1]) * rest(greatest) + noise,
            order: None,
        },
    })
}

/// How far the last values of a row lie apart.
pub fn scatter(values: &[f64]) -> f64 {
    let last = &values[values.len().saturating_sub(3)..];
    let greatest = last.iter().copied().fold(f64::NEG_INFINITY, f64::max);
    let least = last.iter().copied().fold(f64::INFINITY, f64::min);
    greatest - least
}

#[cfg(test)]
mod tests {
    use super::{scatter, settled_row};

    /// Values of L + C·n^−p for n = 1, 2, 4, …
    fn row(limit: f64, order: f64, length: u32) -> Vec<f64> {
        let value = |k: u32| limit + 3.0 * 0.5f64.powf(order * f64::from(k));
        (0..length).map(value).collect()
    }

    #[test]
    fn a_row_with_an_order_is_extrapolated_by_it() {
        for order in [0.5, 1.0, 2.0] {
            let found = settled_row(&row(7.0, order, 4), 0.0).unwrap();
            assert!((found.limit - 7.0).abs() < 1e-12, "{found:?}");
            assert!((found.order.unwrap() - order).abs() < 1e-12, "{found:?}");
            assert!(found.error > 0.0);
        }
        // Quicker than any factor that is believed: no order, but a limit.
        let found = settled_row(&row(7.0, 4.0, 4), 0.0).unwrap();
        assert_eq!(found.order, None);
        assert!((found.limit - 7.0).abs() < found.error);
    }

    #[test]
    fn the_interval_holds_the_limit_of_nearly_all_rows_of_two_orders() {
        // Where two orders cancel, the first changes tell nothing of the last ones.
        let (mut rows, mut missed) = (0, 0);
        for (first, second) in [(1.0, 2.0), (1.0, 1.5), (2.0, 1.0), (0.7, 1.0)] {
            for share in [-0.5, 0.3, 2.0] {
                let (one, other) = (row(0.0, first, 7), row(0.0, second, 7));
                let sum: Vec<f64> = one.iter().zip(&other).map(|(a, b)| a + share * b).collect();
                for length in 4..=7 {
                    if let Some(found) = settled_row(&sum[..length], 0.0) {
                        rows += 1;
                        missed += usize::from(found.limit.abs() > found.error);
                    }
                }
            }
        }
        assert!(rows > 30 && missed <= 1, "{missed} of {rows}");
    }

    #[test]
    fn what_grows_or_scatters_has_not_settled() {
        for wild in [
            &[1.0, 2.0, 4.0, 8.0][..],
            &[1.0, 2.0, 1.0, 2.0],
            &[5.0, 1.0, 1.5, 3.0],
            &[1.0, 2.0, 2.1, 2.2],
            &[1.0, 2.0, f64::NAN, 2.0],
            &[1.0, 1.5, 1.75],
        ] {
            assert_eq!(settled_row(wild, 0.0), None, "{wild:?}");
        }
        assert_eq!(scatter(&[9.0, 1.0, 2.0, 1.5]), 1.0);
    }

    #[test]
    fn changes_below_the_noise_are_none() {
        let found = settled_row(&[3.0, 2.0, 2.0 + 1e-9, 2.0 - 1e-9], 1e-8).unwrap();
        assert_eq!((found.limit, found.error), (2.0 - 1e-9, 1e-8));
        // The last change is rounding: what was before it counts.
        let found = settled_row(&[3.0, 2.0, 1.9, 1.9 + 1e-9], 1e-8).unwrap();
        assert!(found.error >= 1e-8 && found.error < 2e-3, "{found:?}");
    }
}
