//! The period of a table that repeats: given, or that of its last point.

use super::super::measures::Measures;
use crate::dynamics::model::Coordinate;
use crate::frontend::read::Fields;
use std::f64::consts::TAU;

/// How far lengths in turns may be off a whole number.
const WHOLE: f64 = 1e-6;

/// The points of a period that is given, with the one that closes it.
pub(super) fn closed(
    fields: &mut Fields<'_>,
    mut points: Vec<(f64, f64)>,
    period: f64,
) -> Option<Vec<(f64, f64)>> {
    let (first, last) = (points[0], points[points.len() - 1]);
    let length = last.0 - first.0;
    if length > period * (1.0 + 1e-12) {
        let message = format!("the points span {length}, the period is {period}");
        let hint = "give the points of one period; the curve goes on to the first point by itself";
        let fault = fields.refuse("period", "out-of-range", message);
        fault.hints.push(hint.to_owned());
        return None;
    }
    if length >= period * (1.0 - 1e-12) {
        returns(fields, &points, None)?;
        return Some(points);
    }
    points.push((first.0 + period, first.1));
    Some(points)
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
    returns(fields, points, likely)?;
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

/// The last point of a period must have the displacement of the first.
fn returns(fields: &mut Fields<'_>, points: &[(f64, f64)], likely: Option<f64>) -> Option<()> {
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

/// Turns, where the points end one usual step before them and not at the end of turns.
fn likely_period(points: &[(f64, f64)]) -> Option<f64> {
    let mut steps: Vec<f64> = points
        .windows(2)
        .map(|ends| ends[1].0 - ends[0].0)
        .collect();
    steps.sort_by(f64::total_cmp);
    let step = steps[steps.len() / 2];
    let length = points[points.len() - 1].0 - points[0].0;
    let turns = (length + step) / TAU;
    let is_whole = |turns: f64| turns > 0.5 && (turns - turns.round()).abs() <= WHOLE;
    (is_whole(turns) && !is_whole(length / TAU)).then(|| turns.round() * TAU)
}

fn degrees(angle: f64) -> f64 {
    (angle.to_degrees() * 1e6).round() / 1e6
}
