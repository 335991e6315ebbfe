//! A map in words, for the terminal.

use crate::report::quantity::with_unit;
use crate::studies::axis::Axis;
use crate::studies::map::{Extreme, MapResult, PanelSummary, Study, summary};
use std::fmt::Write as _;

/// Counts of verdicts, extremes and where they lie, panel by panel.
pub fn text(study: &Study<'_>, result: &MapResult) -> String {
    let mut text = format!("{}\n{} over {}", study.scene, study.figure, over(&study.x));
    if let Some(y) = &study.y {
        let _ = write!(
            text,
            "\n{:1$} and {2}",
            "",
            study.figure.chars().count(),
            over(y)
        );
    }
    text.push('\n');
    for panel in summary(study, result) {
        text.push('\n');
        if !panel.label.is_empty() {
            let _ = writeln!(text, "{}", panel.label);
        }
        one_panel(&mut text, study, &panel);
    }
    text
}

fn over(axis: &Axis) -> String {
    let by = if axis.log { " by equal ratios" } else { "" };
    format!(
        "{}: {} values from {} to {}{by}",
        axis.path,
        axis.count,
        axis.written(axis.from),
        axis.written(axis.to)
    )
}

fn one_panel(text: &mut String, study: &Study<'_>, panel: &PanelSummary) {
    let all: usize = panel.verdicts.values().sum::<usize>() + panel.missing;
    let mut row = |name: &str, count: usize| {
        let share = 100.0 * count as f64 / all.max(1) as f64;
        let _ = writeln!(text, "  {name:<32} {count:>7}  {share:>5.1} %");
    };
    for (verdict, &count) in &panel.verdicts {
        row(verdict.words(), count);
    }
    if panel.undetermined > 0 {
        let words = format!("not determined to {} digits", study.digits);
        row(&words, panel.undetermined);
    }
    if panel.missing > 0 {
        row("not worked out", panel.missing);
    }
    for (name, extreme) in [("least", &panel.least), ("greatest", &panel.greatest)] {
        if let Some(extreme) = extreme {
            let _ = writeln!(text, "  {name:<9}{}", extreme_in_words(study, extreme));
        }
    }
}

fn extreme_in_words(study: &Study<'_>, extreme: &Extreme) -> String {
    let mut place = format!("{} = {}", study.x.path, extreme.x);
    if let (Some(axis), Some(y)) = (&study.y, &extreme.y) {
        let _ = write!(place, ", {} = {y}", axis.path);
    }
    format!(
        "{} at {place} ({})",
        with_unit(extreme.value, &study.unit, 7),
        extreme.verdict.words()
    )
}
