//! The committed table of errors that are stated of models (`docs/model-order.md`): it says
//! what it is said to say, and some of its rows are found again.

#[path = "../../benches/order/cases.rs"]
mod cases;

use cases::{Case, cases};
use dam::ask::ModelAssessment;
use dam::prelude::*;
use dam::studies::Control;
use dam::studies::order::Certificate;

const TABLE: &str = include_str!("../../docs/model-order.md");
/// Accuracy that the table is made with.
const ACCURACY: &str = "1 %";

/// A row of the table; errors relative to the limit.
#[derive(Debug)]
struct Row<'t> {
    scene: &'t str,
    figure: &'t str,
    value: f64,
    /// `None`: no limit, or not determined.
    stated: Option<f64>,
    off: f64,
    limit: f64,
    doubt: f64,
    coordinates: usize,
    finest: usize,
}

fn rows() -> Vec<Row<'static>> {
    let number = |text: &str| text.trim().parse::<f64>().expect("a number");
    let percent = |text: &str| {
        let share = text.trim().strip_suffix('%');
        share.map(|share| number(share) / 100.0)
    };
    let row = |line: &'static str| {
        let cells: Vec<&str> = line.split('|').map(str::trim).collect();
        let (limit, doubt) = cells[6].split_once('±').expect("a limit and its doubt");
        Row {
            scene: cells[1],
            figure: cells[2],
            value: number(cells[3]),
            stated: percent(cells[4]),
            off: percent(cells[5]).expect("an error"),
            limit: number(limit),
            doubt: percent(doubt).expect("a doubt"),
            coordinates: number(cells[7]) as usize,
            finest: number(cells[8]) as usize,
        }
    };
    let lines = TABLE.lines().filter(|line| line.starts_with("| "));
    // The head and the line below it.
    lines.skip(2).map(row).collect()
}

#[test]
fn intervals_hold_the_limits_of_the_table_and_are_not_wide() {
    let rows = rows();
    let scenes: std::collections::BTreeSet<&str> = rows.iter().map(|row| row.scene).collect();
    assert!(scenes.len() >= 30 && rows.len() >= 60, "{}", rows.len());
    for row in &rows {
        // Two of what a row has give the third, as far as its digits go.
        let off = (row.value - row.limit).abs() / row.limit.abs();
        assert!((off - row.off).abs() <= 0.01 * row.off + 2e-6, "{row:?}");
    }
    let judged: Vec<&Row<'_>> = rows.iter().filter(|row| row.stated.is_some()).collect();
    let stated = |row: &Row<'_>| row.stated.expect("an error");
    let share = |holds: &dyn Fn(&Row<'_>) -> bool| {
        let holding = judged.iter().filter(|row| holds(row)).count();
        holding as f64 / judged.len() as f64
    };
    assert!(share(&|row| row.off <= stated(row)) >= 0.95);
    assert!(share(&|row| stated(row) <= 0.01 * (1.0 + 1e-2)) >= 0.95);
    let width = |row: &&Row<'_>| stated(row) / row.off.max(row.doubt);
    let mut widths: Vec<f64> = judged.iter().map(width).collect();
    widths.sort_by(f64::total_cmp);
    assert!(
        widths[widths.len() / 2] <= 5.0,
        "{}",
        widths[widths.len() / 2]
    );
    let open = rows.len() - judged.len();
    assert!(open as f64 <= 0.1 * rows.len() as f64, "{open}");
}

/// Scenes of which chains of up to 64 masses are chosen take too long here.
fn is_quick(row: &Row<'_>) -> bool {
    row.coordinates <= 16
}

fn prepared(case: &Case) -> Certificate {
    let figures = case.figures.iter();
    let asked: Vec<String> = figures
        .map(|figure| format!(r#""{figure}": "{ACCURACY}""#))
        .collect();
    let text = case.scene(r#""masses": "auto""#).replacen(
        r#""samples": 10"#,
        &format!(r#""samples": 10, "accuracy": {{ {} }}"#, asked.join(", ")),
        1,
    );
    let reading = Scene::from_json(&text).and_then(|scene| scene.decode());
    let reading = reading.unwrap_or_else(|error| panic!("{text}\n{error}"));
    let made = Mechanism::of_within(reading, ModelAssessment::Asked, &Control::default());
    let made = made.unwrap_or_else(|error| panic!("{text}\n{error}"));
    made.certificate.expect("a certificate")
}

#[test]
fn rows_of_the_table_are_found_again() {
    let mut found_again = 0;
    for case in cases() {
        let scene = format!("{} {}", case.regime, case.number);
        let rows: Vec<Row<'_>> = rows()
            .into_iter()
            .filter(|row| row.scene == scene)
            .collect();
        assert_eq!(rows.len(), case.figures.len(), "{scene}");
        if !rows.iter().all(is_quick) {
            continue;
        }
        let certificate = prepared(&case);
        for row in rows {
            let found = &certificate.accuracy[row.figure];
            let coordinates = certificate
                .models
                .values()
                .map(|one| one.coordinates)
                .sum::<usize>();
            assert_eq!(coordinates, row.coordinates, "{row:?}");
            let finest = certificate.tried.iter().map(|one| one.coordinates).max();
            assert_eq!(finest, Some(row.finest), "{row:?}");
            assert!(
                (found.value - row.value).abs() <= 1e-6 * row.value.abs(),
                "{row:?} {found:?}"
            );
            let error = found.error.map(|error| error / row.limit.abs());
            assert_eq!(error.is_some(), row.stated.is_some(), "{row:?}");
            let (error, stated) = (error.unwrap_or(0.0), row.stated.unwrap_or(0.0));
            assert!(
                (error - stated).abs() <= 0.01 * stated + 1e-9,
                "{row:?} {found:?}"
            );
            found_again += 1;
        }
    }
    assert!(found_again >= 40, "{found_again}");
}

/// By chains of a quarter of the masses.
#[test]
fn limits_of_the_table_are_those_of_long_chains() {
    for case in cases().into_iter().filter(|case| case.number == 1) {
        if !["rise", "harmonic", "held by a force", "motor", "work"].contains(&case.regime) {
            continue;
        }
        let run = |masses: usize| {
            let level = format!(r#""masses": {masses}, "lumping": "{}""#, case.lumping);
            let run = Scene::from_json(&case.scene(&level)).and_then(|scene| scene.run());
            run.unwrap_or_else(|error| panic!("{error}"))
        };
        let runs = [16, 32, 64].map(run);
        for row in rows()
            .iter()
            .filter(|row| row.scene == format!("{} 1", case.regime))
        {
            let values = runs
                .each_ref()
                .map(|run| run.figures.value(row.figure).expect("a value"));
            let changes = [values[1] - values[0], values[2] - values[1]];
            let factor = changes[1] / changes[0];
            let rest = match factor > 0.0 && factor < 0.8 {
                true => changes[1] * factor / (1.0 - factor),
                false => 0.0,
            };
            let off = (values[2] + rest - row.limit).abs() / row.limit.abs();
            let stated = row.stated.expect("an error");
            assert!(off <= 0.1 * stated + 1e-7, "{row:?}: {off:e}");
        }
    }
}
