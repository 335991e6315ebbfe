//! Laws of motion as text, tables and diagrams.

mod compare;
mod cycle;
mod page;
mod stroke;
#[cfg(test)]
mod tests;

pub use compare::{comparison_csv, comparison_text};
pub use cycle::{cycle_chart, cycle_csv, cycle_text};
pub use page::{LawPage, comparison_chart, cycle_parts, law_parts, shocks_said, stroke_parts};
pub use stroke::{stroke_chart, stroke_csv, stroke_text};

use super::csv::{number, write};
use super::quantity::significant;
use crate::kinematics::motion::law::{Jump, Law, LawConstants, Peak};
use crate::math::jet::Jet;
use crate::report::plot::{Axis, Plot, Series};
use std::fmt::Write as _;

/// A law with its constants, for tables.
#[derive(Clone, Debug, PartialEq)]
pub struct LawRow {
    /// Name of the law.
    pub name: String,
    /// Description in a few words.
    pub words: String,
    /// Constants of the law.
    pub constants: LawConstants,
}

/// The constants shown in tables: heading and value.
fn columns(constants: &LawConstants) -> [(&'static str, f64); 7] {
    [
        ("C_v", constants.speed.value),
        ("C_a", constants.acceleration.value),
        ("least θ″", constants.deceleration.value),
        ("C_j", constants.jerk.value),
        ("C_m", constants.torque_factor),
        ("σ", constants.filling),
        ("τ*", constants.centre),
    ]
}

/// Laws side by side: greatest speed, acceleration, deceleration, jerk, torque
/// factor, filling coefficient and centre of gravity, continuity class.
pub fn constants_table(rows: &[LawRow]) -> String {
    let names = rows.iter().map(|row| row.name.chars().count());
    let width = names.max().unwrap_or(0).max(4);
    let mut text = format!("{:<width$}", "law");
    if let Some(row) = rows.first() {
        for (heading, _) in columns(&row.constants) {
            let _ = write!(text, " {heading:>10}");
        }
    }
    let _ = writeln!(text, "  class");
    for row in rows {
        let _ = write!(text, "{:<width$}", row.name);
        for (_, value) in columns(&row.constants) {
            let _ = write!(text, " {:>10}", significant(value, 7));
        }
        let _ = writeln!(text, "  {}", class(row.constants.continuity));
    }
    text
}

/// Constants of laws as CSV.
///
/// # Errors
/// Never in practice: writing into memory.
pub fn constants_csv(rows: &[LawRow]) -> Result<String, csv::Error> {
    let header = [
        "law",
        "speed",
        "acceleration",
        "deceleration",
        "jerk",
        "torque_factor",
        "filling",
        "centre",
        "continuity",
    ];
    let rows = rows.iter().map(|row| {
        let mut cells = vec![row.name.clone()];
        cells.extend(columns(&row.constants).map(|(_, value)| number(value)));
        cells.push(row.constants.continuity.to_string());
        cells
    });
    write(header.map(str::to_owned).into_iter(), rows)
}

fn class(continuity: usize) -> String {
    match continuity {
        0 => "C0, hard shock".to_owned(),
        1 => "C1, soft shock".to_owned(),
        3 => "C3 or more".to_owned(),
        order => format!("C{order}"),
    }
}

/// All that is known of one law.
pub fn law_text(row: &LawRow, law: &Law) -> String {
    let found = &row.constants;
    let mut text = format!("{}: {}\n", row.name, row.words);
    let kind = match law.is_run_up() {
        true => "run-up, from rest to uniform motion",
        false => "full stroke, from rest to rest",
    };
    let _ = writeln!(text, "{kind}; normal form: stroke 1, duration 1\n");
    let mut peak = |name: &str, peak: Peak| {
        let (value, at) = (significant(peak.value, 10), significant(peak.at, 8));
        let _ = writeln!(text, "  {name:<34} {value:>14}  at τ = {at}");
    };
    peak("greatest speed C_v", found.speed);
    peak("greatest acceleration C_a", found.acceleration);
    peak("greatest deceleration", found.deceleration);
    peak("greatest jerk C_j", found.jerk);
    peak("greatest driving torque θ′θ″", found.torque);
    peak("greatest braking torque θ′θ″", found.braking_torque);
    let mut plain = |name: &str, value: f64| {
        let _ = writeln!(text, "  {name:<34} {:>14}", significant(value, 10));
    };
    plain("torque factor C_m", found.torque_factor);
    plain("filling coefficient σ", found.filling);
    plain("centre of gravity τ*", found.centre);
    if let (Some(filling), Some(centre)) = (found.filling_after, found.centre_after) {
        plain("filling coefficient, slowing down", filling);
        plain("centre of gravity, slowing down", centre);
    }
    let _ = writeln!(text, "  {:<34} {}", "continuity", class(found.continuity));
    let joints: Vec<String> = law.joints().iter().map(|t| significant(*t, 8)).collect();
    if !joints.is_empty() {
        let _ = writeln!(text, "  {:<34} τ = {}", "joints", joints.join(", "));
    }
    text.push_str(&shocks(&found.jumps, "τ"));
    text
}

/// Hard and soft shocks, one a line; nothing when there are none.
pub fn shocks(jumps: &[Jump], symbol: &str) -> String {
    let mut text = String::new();
    for jump in jumps.iter().filter(|jump| jump.order < 3) {
        let (kind, what) = match jump.order {
            1 => ("hard shock", "speed"),
            _ => ("soft shock", "acceleration"),
        };
        let (before, after) = (significant(jump.before, 6), significant(jump.after, 6));
        let at = significant(jump.at, 8);
        let _ = writeln!(
            text,
            "  {kind} at {symbol} = {at}: {what} jumps from {before} to {after}"
        );
    }
    text
}

/// Arguments of samples: `count` equal steps, and both sides of every joint.
fn sampled(law: &Law, count: usize) -> Vec<(f64, Jet)> {
    let count = count.max(1);
    let mut rows = Vec::new();
    for (piece, from, to) in law.pieces() {
        rows.push((from, law.jet(piece, from)));
        let first = (from * count as f64).floor() as usize + 1;
        let inner = (first..count).map(|i| i as f64 / count as f64);
        let inner = inner.take_while(|&tau| tau < to).filter(|&tau| tau > from);
        rows.extend(inner.map(|tau| (tau, law.jet(piece, tau))));
        rows.push((to, law.jet(piece, to)));
    }
    rows
}

/// θ and its derivatives as CSV: `count` equal steps, and both sides of every joint.
///
/// # Errors
/// Never in practice: writing into memory.
pub fn law_csv(law: &Law, count: usize) -> Result<String, csv::Error> {
    let header = ["tau", "theta", "theta1", "theta2", "theta3"];
    let rows = sampled(law, count).into_iter().map(|(tau, jet)| {
        let cells = [tau, jet.value, jet.first, jet.second, jet.third];
        cells.map(number).to_vec()
    });
    write(header.map(str::to_owned).into_iter(), rows)
}

/// Points of each diagram of a law.
const DIAGRAM_POINTS: usize = 400;

/// The law's diagrams over each other, each divided by its greatest value.
pub fn law_chart(name: &str, law: &Law, constants: &LawConstants) -> Plot {
    let rows = sampled(law, DIAGRAM_POINTS);
    let acceleration = constants
        .acceleration
        .value
        .max(-constants.deceleration.value);
    diagrams(
        name,
        "τ",
        &rows,
        [
            ("θ".to_owned(), 1.0),
            (ratio("θ′", constants.speed.value), constants.speed.value),
            (ratio("θ″", acceleration), acceleration),
            (ratio("θ‴", constants.jerk.value), constants.jerk.value),
        ],
        "",
    )
}

fn ratio(symbol: &str, size: f64) -> String {
    format!("{symbol} / {}", significant(size, 5))
}

/// Value and derivatives over each other, each with its label and what it is divided by.
fn diagrams(
    title: &str,
    symbol: &str,
    rows: &[(f64, Jet)],
    shown: [(String, f64); 4],
    unit: &str,
) -> Plot {
    let parts: [fn(&Jet) -> f64; 4] = [|j| j.value, |j| j.first, |j| j.second, |j| j.third];
    let curves = parts
        .iter()
        .zip(shown)
        .filter(|(_, (_, size))| *size != 0.0);
    let curves = curves.map(|(part, (label, size))| {
        let points = rows.iter().map(|(x, jet)| (*x, part(jet) / size));
        Series::line(&label, points.collect())
    });
    Plot {
        title: title.to_owned(),
        series: curves.collect(),
        x: Axis::new(symbol, unit),
        ..Plot::default()
    }
}
