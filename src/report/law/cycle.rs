//! The cycle of a cam as text, table and diagram.

use super::{diagrams, ratio, shocks};
use crate::kinematics::motion::law::Peak;
use crate::kinematics::position::Position;
use crate::math::jet::Jet;
use crate::report::csv::{number, write};
use crate::report::plot::Plot;
use crate::report::quantity::significant;
use crate::studies::cycle::CycleFigures;
use std::fmt::Write as _;

/// Joints, extremes and shocks; units of the object and of its driver.
pub fn cycle_text(found: &CycleFigures, unit: &str, driver: &str) -> String {
    let mut text = format!("cycle of {} {driver}\n\n", significant(found.period, 10));
    let heads = ["at", "U", "U′", "U″ before", "U″ after"];
    let _ = writeln!(
        text,
        "  {}",
        heads.map(|head| format!("{head:>14}")).join(" ")
    );
    let acceleration = found.acceleration.value.max(-found.deceleration.value);
    let speed = found.speed.value.max(-found.return_speed.value);
    // What is rounding of zero reads as zero; the CSV has it as it is.
    let clean = |value: f64, size: f64| {
        if value.abs() > 1e-13 * size {
            value
        } else {
            0.0
        }
    };
    for joint in &found.joints {
        let cells = [
            joint.at,
            joint.value[1],
            clean(joint.first[1], speed),
            clean(joint.second[0], acceleration),
            clean(joint.second[1], acceleration),
        ];
        let cells = cells.map(|value| format!("{:>14}", significant(value, 8)));
        let _ = writeln!(text, "  {}", cells.join(" "));
    }
    text.push('\n');
    let mut row = |name: &str, peak: Peak, unit: String| {
        let (value, at) = (significant(peak.value, 8), significant(peak.at, 8));
        let _ = writeln!(text, "  {name:<16} {value:>16} {unit} at {at}");
    };
    row("greatest U′", found.speed, format!("{unit}/{driver}"));
    row("least U′", found.return_speed, format!("{unit}/{driver}"));
    row(
        "greatest U″",
        found.acceleration,
        format!("{unit}/{driver}²"),
    );
    row("least U″", found.deceleration, format!("{unit}/{driver}²"));
    row("greatest |U‴|", found.jerk, format!("{unit}/{driver}³"));
    row(
        "greatest |U′U″|",
        found.product,
        format!("{unit}²/{driver}³"),
    );
    text.push('\n');
    let listed = shocks(&found.jumps, "φ");
    match listed.is_empty() {
        true => text.push_str("  no shocks: speed and acceleration are continuous\n"),
        false => text.push_str(&listed),
    }
    text
}

/// One cycle: `count` equal steps, and both sides of every joint.
pub(super) fn sampled(position: &Position, lever: f64, count: usize) -> Vec<(f64, Jet)> {
    let breaks = position.breaks();
    let (Some(period), Some(&first)) = (breaks.period, breaks.points.first()) else {
        return Vec::new();
    };
    let count = count.max(1);
    let mut rows = Vec::new();
    for segment in 0..breaks.points.len() as i64 {
        let (from, to) = breaks.edges(segment);
        let mut put = |phi: f64| rows.push((phi, position.jet(segment, phi).scaled(lever)));
        put(from);
        let inner = (0..=count).map(|i| first + period * i as f64 / count as f64);
        inner
            .filter(|&phi| from < phi && phi < to)
            .for_each(&mut put);
        put(to);
    }
    rows
}

/// U and its derivatives over one cycle as CSV, both sides of every joint.
///
/// # Errors
/// Never in practice: writing into memory.
pub fn cycle_csv(
    position: &Position,
    lever: f64,
    [unit, driver]: [&str; 2],
    count: usize,
) -> Result<String, csv::Error> {
    let header = [
        format!("phi [{driver}]"),
        format!("U [{unit}]"),
        format!("U1 [{unit}/{driver}]"),
        format!("U2 [{unit}/{driver}^2]"),
        format!("U3 [{unit}/{driver}^3]"),
    ];
    let rows = sampled(position, lever, count)
        .into_iter()
        .map(|(phi, jet)| {
            let cells = [phi, jet.value, jet.first, jet.second, jet.third];
            cells.map(number).to_vec()
        });
    write(header.into_iter(), rows)
}

/// The cycle's diagrams over each other, each divided by its greatest value.
pub fn cycle_chart(
    title: &str,
    position: &Position,
    lever: f64,
    found: &CycleFigures,
    driver: &str,
) -> Plot {
    let rows = sampled(position, lever, 720);
    let stroke = rows
        .iter()
        .fold(0.0, |size: f64, row| size.max(row.1.value.abs()));
    let speed = found.speed.value.max(-found.return_speed.value);
    let acceleration = found.acceleration.value.max(-found.deceleration.value);
    let shown = [
        (ratio("U", stroke), stroke),
        (ratio("U′", speed), speed),
        (ratio("U″", acceleration), acceleration),
        (ratio("U‴", found.jerk.value), found.jerk.value),
    ];
    diagrams(title, "φ", &rows, shown, driver)
}
