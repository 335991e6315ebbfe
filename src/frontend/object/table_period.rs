//! The period of a table that repeats: given, or that of its last point; and what a table seems to
//! leave out of a turn.

use super::measures::Measures;
use crate::dynamics::model::Coordinate;
use crate::frontend::read::Fields;
use std::f64::consts::TAU;

/// How far lengths may be off a whole number of parts of a turn.
const WHOLE: f64 = 1e-6;

/// Most lobes of a cam, so that a table may hold one of them.
const LOBES: usize = 12;

/// Largest gap before the end of a period, in its table's largest steps.
const GAP: f64 = 1.5;

/// Share of a step by which the end of a lobe may be missed: rows are rounded.
const ROUNDED: f64 = 0.02;

/// The points of a period that is given, with the one that closes it.
pub(super) fn read_closed(
    fields: &mut Fields<'_>,
    mut points: Vec<(f64, f64)>,
    period: f64,
    driver: Measures,
) -> Option<Vec<(f64, f64)>> {
    let (first, last) = (points[0], points[points.len() - 1]);
    let length = last.0 - first.0;
    if length > period * (1.0 + 1e-12) {
        let message = spans("points span", length, period, driver);
        let hint = "give the points of one period; the curve goes on to the first point by itself";
        let fault = fields.refuse("period", "out-of-range", message);
        fault.hints.push(hint.to_owned());
        return None;
    }
    if length >= period * (1.0 - 1e-12) {
        read_returns(fields, &points, None)?;
        return Some(points);
    }
    points.push((first.0 + period, first.1));
    Some(points)
}

/// Words for a length beyond the period.
pub(super) fn spans(what: &str, length: f64, period: f64, driver: Measures) -> String {
    let [length, period] = [length, period].map(|value| match driver.0 {
        Some(Coordinate::Turning) => format!("{} deg", degrees(value)),
        Some(Coordinate::Sliding) => format!("{} mm", rounded(value * 1e3)),
        None => value.to_string(),
    });
    format!("the {what} {length}, more than the period of {period}")
}

/// Points of which the last one closes the period: it must come back, and should not lie one
/// step before the end of a turn.
pub(super) fn check(
    fields: &mut Fields<'_>,
    points: &[(f64, f64)],
    driver: Measures,
) -> Option<()> {
    let likely = match driver.0 {
        Some(Coordinate::Sliding) => None,
        Some(Coordinate::Turning) | None => likely_period(points),
    };
    read_returns(fields, points, likely)?;
    if let Some(likely) = likely {
        let length = points[points.len() - 1].0 - points[0].0;
        let message = format!(
            "the table repeats after {} deg: its last point, one step before {} deg, counts as \
             the first one of the next period",
            degrees(length),
            degrees(likely)
        );
        let warning = fields.warn("points", "open-period", message);
        warning.hints.push(format!(
            "give the table \"period\": \"{} deg\", or \"{} deg\" if that is meant",
            degrees(likely),
            degrees(length)
        ));
    }
    Some(())
}

/// Notes a table without `period` that holds for whole turns: what comes after them has the value
/// of its last point.
pub(super) fn check_single_turn(fields: &mut Fields<'_>, points: &[(f64, f64)], driver: Measures) {
    if driver.0 != Some(Coordinate::Turning) {
        return;
    }
    let length = points[points.len() - 1].0 - points[0].0;
    let turns = length / TAU;
    let likely = match is_whole(turns) {
        true => Some(turns.round() * TAU),
        false => likely_period(points).filter(|&likely| likely > TAU * (1.0 - WHOLE)),
    };
    if let Some(likely) = likely {
        let message = format!(
            "the table ends at {} deg and does not repeat: from there on its last value holds",
            degrees(points[points.len() - 1].0)
        );
        let warning = fields.warn("points", "open-period", message);
        warning.hints.push(format!(
            "give the table \"period\": \"{} deg\" if it repeats, else a last point beyond the turn",
            degrees(likely)
        ));
    }
}

/// The last point of a period must have the displacement of the first.
fn read_returns(fields: &mut Fields<'_>, points: &[(f64, f64)], likely: Option<f64>) -> Option<()> {
    let (first, last) = (points[0].1, points[points.len() - 1].1);
    let size = points
        .iter()
        .fold(0.0, |size: f64, point| size.max(point.1.abs()));
    if (last - first).abs() <= 1e-9 * size {
        return Some(());
    }
    let message =
        format!("the last point of a periodic table must come back to {first}, found {last}");
    let fault = fields.refuse("points", "contradiction", message);
    if let Some(likely) = likely {
        fault.hints.push(format!(
            "the last row seems to be missing: give the table \"period\": \"{} deg\"",
            degrees(likely)
        ));
    }
    None
}

/// The period that points seem to stop short of: whole turns that end within about one step of
/// the table, or a lobe, an equal part of a turn, that ends after one step like its last.
fn likely_period(points: &[(f64, f64)]) -> Option<f64> {
    let steps = || points.windows(2).map(|ends| ends[1].0 - ends[0].0);
    let largest = steps().fold(0.0, f64::max);
    let last = steps().next_back()?;
    let length = points[points.len() - 1].0 - points[0].0;
    let turns = length / TAU;
    let is_lobe = |parts: usize| (turns * parts as f64 - 1.0).abs() <= WHOLE;
    if is_whole(turns) || (2..=LOBES).any(is_lobe) {
        return None;
    }
    let whole = turns.ceil() * TAU;
    if whole - length <= GAP * largest {
        return Some(whole);
    }
    let lobe = (2..=LOBES).map(|parts| TAU / parts as f64);
    lobe.into_iter()
        .find(|lobe| (lobe - length - last).abs() <= ROUNDED * last)
}

fn is_whole(turns: f64) -> bool {
    turns > 0.5 && (turns - turns.round()).abs() <= WHOLE
}

fn degrees(angle: f64) -> f64 {
    rounded(angle.to_degrees())
}

fn rounded(value: f64) -> f64 {
    (value * 1e6).round() / 1e6
}

#[cfg(test)]
mod tests {
    use super::likely_period;

    /// A table over angles in degrees.
    fn likely(angles: &[f64]) -> Option<f64> {
        let points: Vec<_> = angles.iter().map(|one| (one.to_radians(), 0.0)).collect();
        likely_period(&points).map(|period| period.to_degrees().round())
    }

    fn rows(step: f64, count: usize) -> Vec<f64> {
        (0..count).map(|k| k as f64 * step).collect()
    }

    #[test]
    fn a_turn_that_lacks_its_last_row_is_seen() {
        assert_eq!(likely(&rows(5.0, 72)), Some(360.0));
        assert_eq!(likely(&rows(5.0, 73)), None);
        assert_eq!(likely(&rows(5.0, 144)), Some(720.0));
        // Rounded to three decimals, or with an uneven last step.
        let rounded: Vec<f64> = (0..70)
            .map(|k| (k as f64 * 36e4 / 70.0).round() / 1e3)
            .collect();
        assert_eq!(likely(&rounded), Some(360.0));
        assert_eq!(
            likely(&[0.0, 90.0, 180.0, 240.0, 300.0, 345.0]),
            Some(360.0)
        );
        assert_eq!(likely(&[10.0, 100.0, 190.0, 280.0]), Some(360.0));
    }

    #[test]
    fn lobes_are_parts_of_a_turn() {
        assert_eq!(likely(&rows(10.0, 18)), Some(180.0));
        assert_eq!(likely(&rows(10.0, 12)), Some(120.0));
        // A whole lobe is no part of a greater one, and other periods are nobody's business.
        for whole in [
            rows(10.0, 19),
            rows(10.0, 13),
            rows(30.0, 3),
            rows(10.0, 15),
        ] {
            assert_eq!(likely(&whole), None, "{whole:?}");
        }
    }
}
