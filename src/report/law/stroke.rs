//! A synthesised stroke as text, table and diagram.

use super::{diagrams, ratio};
use crate::kinematics::motion::stroke::{Stroke, StrokeFigures};
use crate::math::jet::Jet;
use crate::report::csv::{number, write};
use crate::report::plot::Plot;
use crate::report::quantity::significant;
use std::fmt::Write as _;

/// Structure and criteria of a stroke; `unit` is that of its displacement.
pub fn stroke_text(stroke: &Stroke, unit: &str) -> String {
    let found = stroke.figures();
    let per = |power: &str| format!("{unit}/rad{power}");
    let rows: [(&str, f64, String); 17] = [
        ("stroke Π_III", found.stroke, unit.to_owned()),
        ("span φ_III", found.span, "rad".to_owned()),
        ("skewness f", found.skewness, String::new()),
        (
            "uniform share of stroke ζ_Π",
            found.uniform_stroke,
            String::new(),
        ),
        (
            "uniform share of span ζ_φ",
            found.uniform_span,
            String::new(),
        ),
        ("ν1", found.speed_ratio, String::new()),
        ("ν2", found.law_acceleration_ratio, String::new()),
        ("U", found.u, String::new()),
        ("run-up ends at φ_I", found.angle_run_up, "rad".to_owned()),
        (
            "run-out begins at φ_II",
            found.angle_run_out,
            "rad".to_owned(),
        ),
        ("Π_I", found.stroke_run_up, unit.to_owned()),
        ("Π_II", found.stroke_run_out, unit.to_owned()),
        ("greatest speed Π′", found.peak_speed, per("")),
        ("run-up: greatest Π″", found.acceleration_run_up, per("²")),
        (
            "run-out: greatest |Π″|",
            found.acceleration_run_out,
            per("²"),
        ),
        (
            "run-up: greatest Π′Π″",
            found.product_run_up,
            format!("{unit}²/rad³"),
        ),
        (
            "run-out: greatest |Π′Π″|",
            found.product_run_out,
            format!("{unit}²/rad³"),
        ),
    ];
    let mut text = String::new();
    for (name, value, unit) in rows {
        let line = format!("  {name:<28} {:>16} {unit}", significant(value, 10));
        let _ = writeln!(text, "{}", line.trim_end());
    }
    let lambda = significant(found.acceleration_ratio, 10);
    let _ = writeln!(text, "  {:<28} {lambda:>16}", "acceleration ratio λ");
    text
}

/// Samples over the span with both sides of the ends of the sections.
pub(super) fn sampled(stroke: &Stroke, count: usize) -> Vec<(f64, Jet)> {
    let figures = stroke.figures();
    let count = count.max(1);
    let steps = (0..=count).map(|i| figures.span * i as f64 / count as f64);
    let ends = [figures.angle_run_up, figures.angle_run_out];
    let mut places: Vec<f64> = steps.chain(ends).collect();
    places.sort_by(f64::total_cmp);
    places.dedup();
    let mut rows = Vec::new();
    for phi in places {
        let [before, after] = stroke.sides(phi);
        if phi > 0.0 {
            rows.push((phi, before));
        }
        if phi == 0.0 || phi < figures.span && before != after {
            rows.push((phi, after));
        }
    }
    rows
}

/// Π and its derivatives as CSV: `count` equal steps, both sides of every jump.
///
/// # Errors
/// Never in practice: writing into memory.
pub fn stroke_csv(stroke: &Stroke, unit: &str, count: usize) -> Result<String, csv::Error> {
    let header = [
        "phi [rad]".to_owned(),
        format!("Pi [{unit}]"),
        format!("Pi1 [{unit}/rad]"),
        format!("Pi2 [{unit}/rad^2]"),
        format!("Pi3 [{unit}/rad^3]"),
    ];
    let rows = sampled(stroke, count).into_iter().map(|(phi, jet)| {
        let cells = [phi, jet.value, jet.first, jet.second, jet.third];
        cells.map(number).to_vec()
    });
    write(header.into_iter(), rows)
}

/// The stroke's diagrams over each other, each divided by its greatest value.
pub fn stroke_chart(title: &str, stroke: &Stroke) -> Plot {
    let found: &StrokeFigures = stroke.figures();
    let rows = sampled(stroke, 400);
    let acceleration = found
        .acceleration_run_up
        .abs()
        .max(found.acceleration_run_out);
    let jerk = rows
        .iter()
        .fold(0.0, |size: f64, row| size.max(row.1.third.abs()));
    let speed = found.peak_speed.abs();
    diagrams(
        title,
        "φ",
        &rows,
        [
            (ratio("Π", found.stroke.abs()), found.stroke.abs()),
            (ratio("Π′", speed), speed),
            (ratio("Π″", acceleration), acceleration),
            (ratio("Π‴", jerk), jerk),
        ],
        "rad",
    )
}
