//! Least and greatest values, located between the rows.

use super::ask::Asked;
use super::columns;
use super::{Column, Extremes};
use crate::linkage::Workspace;

/// Most evaluations for an extreme; some ten are usual.
const STEPS: usize = 60;
/// Part of the bracket to which an extreme is located: values nearer to it differ by rounding
/// only.
const LOCATED: f64 = 1e-9;
/// (3 − √5)/2, the part that golden section cuts off.
const GOLDEN: f64 = 0.381_966_011_250_105_1;

/// Extremes of every column over the places of its rows.
pub(super) fn extremes(asked: &Asked<'_>, places: &[f64], columns: &[Column]) -> Vec<Extremes> {
    let mut seeker = Seeker {
        asked,
        work: asked.linkage.workspace(),
        values: Vec::new(),
    };
    let mut all = Vec::with_capacity(columns.len());
    for (index, column) in columns.iter().enumerate() {
        let mut find = |sign: f64| {
            let best = greatest_row(&column.values, sign);
            best.map_or((f64::NAN, f64::NAN), |row| {
                // Between rows that are not all determined, nothing is looked for.
                if column.undetermined > 0 || is_level(column) {
                    return (places[row], column.values[row]);
                }
                let mut at = |place: f64| seeker.at(place, index);
                located(places, &column.values, row, sign, &mut at)
            })
        };
        all.push(Extremes {
            least: find(-1.0),
            greatest: find(1.0),
        });
    }
    all
}

/// True for a column in which nothing changes but rounding.
fn is_level(column: &Column) -> bool {
    let ends = column
        .values
        .iter()
        .fold([f64::INFINITY, f64::NEG_INFINITY], |[low, high], &v| {
            [low.min(v), high.max(v)]
        });
    ends[1] - ends[0] <= column.error
}

/// The first row at which sign·value is greatest.
pub(super) fn greatest_row(values: &[f64], sign: f64) -> Option<usize> {
    let mut best: Option<usize> = None;
    for (row, value) in values.iter().enumerate() {
        let better = best.is_none_or(|best| sign * value > sign * values[best]);
        if value.is_finite() && better {
            best = Some(row);
        }
    }
    best
}

struct Seeker<'q, 'a> {
    asked: &'q Asked<'a>,
    work: Workspace,
    values: Vec<f64>,
}

impl Seeker<'_, '_> {
    /// The value of a column at a place.
    fn at(&mut self, place: f64, column: usize) -> f64 {
        let q = self.asked.input_at(place);
        if self
            .asked
            .linkage
            .solve(q.value, 3, &mut self.work)
            .is_err()
        {
            return f64::NAN;
        }
        columns::values(self.asked, &self.work, q, &mut self.values);
        self.values[column]
    }
}

/// The extreme of sign·value next to a row, between its neighbours, by Brent's method: steps to
/// the vertex of a parabola through the last three places, or else golden section (R. P. Brent,
/// *Algorithms for Minimization without Derivatives*, 1973, chapter 5).
pub(super) fn located(
    places: &[f64],
    values: &[f64],
    row: usize,
    sign: f64,
    at: &mut dyn FnMut(f64) -> f64,
) -> (f64, f64) {
    let found = (places[row], values[row]);
    let (Some(before), Some(after)) = (row.checked_sub(1), places.get(row + 1)) else {
        return found;
    };
    let flat = |other: f64| (other - found.1).abs() <= 1e-13 * found.1.abs();
    if flat(values[before]) && flat(values[row + 1]) {
        return found;
    }
    let (mut low, mut high) = (places[before].min(*after), places[before].max(*after));
    let near = LOCATED * (high - low);
    let mut worth = |place: f64| {
        let value = sign * at(place);
        if value.is_nan() {
            f64::NEG_INFINITY
        } else {
            value
        }
    };
    // The best place, the one before, and the one before that, with what they are worth.
    let mut best = (found.0, sign * found.1);
    let (mut second, mut third) = (best, best);
    let (mut step, mut before_last) = (0.0f64, 0.0f64);
    for _ in 0..STEPS {
        let middle = 0.5 * (low + high);
        if (best.0 - middle).abs() <= 2.0 * near - 0.5 * (high - low) {
            break;
        }
        let vertex = vertex([best, second, third]);
        let inside = best.0 + vertex;
        // A parabola is trusted where its steps become shorter.
        if vertex.abs() < 0.5 * before_last.abs() && low < inside && inside < high {
            (before_last, step) = (step, vertex);
            if inside - low < 2.0 * near || high - inside < 2.0 * near {
                step = near.copysign(middle - best.0);
            }
        } else {
            before_last = if best.0 < middle {
                high - best.0
            } else {
                low - best.0
            };
            step = GOLDEN * before_last;
        }
        let place = best.0
            + if step.abs() >= near {
                step
            } else {
                near.copysign(step)
            };
        let tried = (place, worth(place));
        if tried.1 >= best.1 {
            if tried.0 < best.0 {
                high = best.0;
            } else {
                low = best.0;
            }
            (third, second, best) = (second, best, tried);
        } else {
            if tried.0 < best.0 {
                low = tried.0;
            } else {
                high = tried.0;
            }
            if tried.1 >= second.1 || second.0 == best.0 {
                (third, second) = (second, tried);
            } else if tried.1 >= third.1 || third.0 == best.0 || third.0 == second.0 {
                third = tried;
            }
        }
    }
    (best.0, sign * best.1)
}

/// From the first place to the vertex of the parabola through three; not a number where they do
/// not make one.
fn vertex([x, w, v]: [(f64, f64); 3]) -> f64 {
    let r = (x.0 - w.0) * (x.1 - v.1);
    let q = (x.0 - v.0) * (x.1 - w.1);
    let above = (x.0 - v.0) * q - (x.0 - w.0) * r;
    let below = 2.0 * (q - r);
    -above / below
}

#[cfg(test)]
mod tests {
    use super::located;

    #[test]
    fn extremes_between_rows_are_located_in_few_evaluations() {
        type Case = (fn(f64) -> f64, f64);
        let cases: [Case; 3] = [
            (|x| -(x - 0.3) * (x - 0.3), 0.3),
            (|x| (x - 0.2).cos() + 0.1 * x, 0.2 + 0.1f64.asin()),
            // With a kink nothing but sections help.
            (|x| -(x - 0.37).abs(), 0.37),
        ];
        for (f, wanted) in cases {
            for sign in [1.0, -1.0] {
                let places = [-1.0, 0.0, 1.0];
                let values = places.map(|x| sign * f(x));
                let mut count = 0;
                let mut at = |x: f64| {
                    count += 1;
                    sign * f(x)
                };
                let (place, value) = located(&places, &values, 1, sign, &mut at);
                assert!((place - wanted).abs() < 3e-8, "{place} {wanted}");
                assert!((sign * value - f(wanted)).abs() < 3e-8);
                assert!(count <= 60);
            }
        }
        let mut count = 0;
        let places = [1.0, 0.0, -1.0];
        let mut smooth = |x: f64| {
            count += 1;
            (x - 0.2).cos()
        };
        let values = places.map(|x: f64| (x - 0.2).cos());
        let (place, _) = located(&places, &values, 1, 1.0, &mut smooth);
        assert!((place - 0.2).abs() < 3e-8, "downwards too: {place}");
        assert!(count <= 25, "{count} evaluations");
    }
}
