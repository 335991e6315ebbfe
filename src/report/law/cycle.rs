//! The cycle of a cam as findings and rows.

use super::curve::{Curve, DIAGRAM_POINTS, rows};
use super::{shock_verdict, shocks};
use crate::kinematics::motion::law::Peak;
use crate::kinematics::position::Position;
use crate::math::jet::Jet;
use crate::report::course::samples;
use crate::report::csv::Rows;
use crate::report::findings::{Figure, Findings, Section, Source, Table, Value};
use crate::report::plot::Axis;
use crate::report::quantity::DIGITS;
use crate::report::verdict::Verdict;
use crate::studies::cycle::CycleFigures;

/// Joints, extremes, shocks and diagrams of an object's cycle; units of the object and of its
/// driver.
pub fn cycle_findings<'a>(
    scene: &str,
    object: &str,
    (position, lever): (&Position, f64),
    found: &CycleFigures,
    [unit, driver]: [&str; 2],
    source: Source<'a>,
) -> Findings<'a> {
    let (sort, said) = shock_verdict(&found.jumps);
    let [_, size] = sizes(found);
    let greatest = Value::new(size, &format!("{unit}/{driver}²"), DIGITS).words();
    let headline = format!("Greatest acceleration |U″| = {greatest}.");
    let peak = |name: &str, peak: Peak, unit: String| {
        let at = Value::angle_or(peak.at, driver, 8).words();
        Figure::number(name, peak.value, &unit, 8).with_note(format!("at {at}"))
    };
    let per = |power: &str| format!("{unit}/{driver}{power}");
    let extremes = vec![
        peak("greatest U′", found.speed, per("")),
        peak("least U′", found.return_speed, per("")),
        peak("greatest U″", found.acceleration, per("²")),
        peak("least U″", found.deceleration, per("²")),
        peak("greatest |U‴|", found.jerk, per("³")),
        peak(
            "greatest |U′U″|",
            found.product,
            format!("{unit}²/{driver}³"),
        ),
    ];
    let period = Value::angle_or(found.period, driver, 10).words();
    Findings {
        title: scene.to_owned(),
        subtitle: format!("cycle of {object}, {period}"),
        answer: Some(Verdict::answer(sort, headline, said.to_owned())),
        warnings: Vec::new(),
        sections: vec![
            curve(position, lever, found, [unit, driver]).section(object),
            Section::new("Joints").table(joints(found, [unit, driver])),
            Section::new("Extremes")
                .figures(extremes)
                .item(shocks(&found.jumps, ["φ", driver])),
        ],
        source,
    }
}

fn joints(found: &CycleFigures, [unit, driver]: [&str; 2]) -> Table {
    let [speed, acceleration] = sizes(found);
    // What is rounding of zero reads as zero; the CSV has it as it is.
    let clean = |value: f64, size: f64| match value.abs() > 1e-13 * size {
        true => value,
        false => 0.0,
    };
    let second = format!("{unit}/{driver}²");
    let rows = found.joints.iter().map(|joint| {
        vec![
            Value::angle_or(joint.at, driver, 8),
            Value::angle_or(joint.value[1], unit, 8),
            Value::new(clean(joint.first[1], speed), &format!("{unit}/{driver}"), 8),
            Value::new(clean(joint.second[0], acceleration), &second, 8),
            Value::new(clean(joint.second[1], acceleration), &second, 8),
        ]
    });
    Table::new([">at", ">U", ">U′", ">U″ before", ">U″ after"]).rows(rows)
}

/// Greatest sizes of speed and acceleration.
fn sizes(found: &CycleFigures) -> [f64; 2] {
    [
        found.speed.value.max(-found.return_speed.value),
        found.acceleration.value.max(-found.deceleration.value),
    ]
}

/// One cycle: `count` equal steps, and both sides of every joint.
fn sample_cycle(position: &Position, lever: f64, count: usize) -> Vec<(f64, Jet)> {
    let breaks = position.breaks();
    let (Some(period), Some(&first)) = (breaks.period, breaks.points.first()) else {
        return Vec::new();
    };
    let pieces = (0..breaks.points.len() as i64).map(|segment| breaks.edges(segment).into());
    samples(pieces, [first, period], count, |piece, phi| {
        (phi, position.jet(piece as i64, phi).scaled(lever))
    })
}

/// U and its derivatives over one cycle, both sides of every joint.
pub fn cycle_rows(position: &Position, lever: f64, units: [&str; 2], count: usize) -> Rows {
    rows(["phi", "U"], units, &sample_cycle(position, lever, count))
}

fn curve<'a>(
    position: &Position,
    lever: f64,
    found: &CycleFigures,
    [unit, driver]: [&'a str; 2],
) -> Curve<'a> {
    let rows = sample_cycle(position, lever, 2 * DIAGRAM_POINTS);
    let strokes = rows.iter().map(|row| row.1.value.abs());
    let stroke = strokes.fold(0.0, f64::max);
    let [speed, acceleration] = sizes(found);
    Curve {
        rows,
        symbol: "U",
        x: Axis::new("φ", driver),
        unit,
        sizes: [stroke, speed, acceleration, found.jerk.value],
    }
}
