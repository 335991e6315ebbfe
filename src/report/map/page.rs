//! A map as a page that opens without a network.

use super::report::MapReport;
use super::{picture, pointing};
use crate::report::html::{facts, header, scene, shell};
use crate::report::plot::Plots;
use crate::report::quantity::{escape, significant, with_unit};
use crate::report::verdict::{Sort, Verdict as Answer};
use crate::studies::axis::Axis;
use crate::studies::map::{
    Cell, Extreme, MOST_STEPS, NEAR_HARMONIC, RESONANCE, STEADY, Study, THROWN_OFF, Verdict,
    summary,
};
use crate::studies::spread::CHANGE;
use std::collections::BTreeMap;
use std::fmt::Write as _;

/// Causes listed of each verdict and panel.
const MOST_CAUSES: usize = 12;

/// The page.
pub fn page(report: &MapReport<'_>) -> String {
    let study = report.study;
    let over = match &study.y {
        Some(y) => format!("{} over {} and {}", study.figure, study.x.path, y.path),
        None => format!("{} over {}", study.figure, study.x.path),
    };
    let mut body = header(&study.scene, &over, Some(&answer(report)));
    body.push_str("<main>\n");
    let mut plots = Plots::default();
    body.push_str(&pointing::section(report, &mut plots));
    body.push_str(&counts(report));
    body.push_str(&meanings(report));
    body.push_str(&causes(report));
    body.push_str(&scene(report.scene));
    body.push_str("</main>\n");
    let rows = [
        ("Scene", study.scene.clone()),
        ("SHA-256 of the study", study.hash.clone()),
        ("Program", format!("dam {}", report.version)),
    ];
    let _ = write!(
        body,
        "<footer>\n<h2>Provenance</h2>\n{}</footer>\n",
        facts(&rows)
    );
    shell(&study.scene, &body, &plots.json())
}

/// Between what the figure lies, how many cells are in order, and what is doubtful.
fn answer(report: &MapReport<'_>) -> Answer {
    let (study, panels) = (report.study, summary(report.study, report.result));
    let all: Vec<&Cell> = report.result.panels.iter().flatten().flatten().collect();
    let count = |verdict: Verdict| all.iter().filter(|cell| cell.verdict == verdict).count();
    let least = panels.iter().filter_map(|panel| panel.least.as_ref());
    let least = least.min_by(|a, b| a.value.total_cmp(&b.value));
    let greatest = panels.iter().filter_map(|panel| panel.greatest.as_ref());
    let greatest = greatest.max_by(|a, b| a.value.total_cmp(&b.value));
    let headline = match least.zip(greatest) {
        Some((least, greatest)) => format!(
            "{} from {} to {}.",
            study.figure,
            with_unit(least.value, &study.unit, 4),
            with_unit(greatest.value, &study.unit, 4)
        ),
        None => format!("{} has no value anywhere.", study.figure),
    };
    let (good, failed) = (
        count(Verdict::InWorkingOrder),
        count(Verdict::NumericalFailure),
    );
    let undetermined: usize = panels.iter().map(|panel| panel.undetermined).sum();
    let missing: usize = panels.iter().map(|panel| panel.missing).sum();
    let mut text = format!("{good} of {} cells are in working order", all.len());
    for (count, what) in [
        (failed, "could not be computed"),
        (undetermined, "are not known to the digits asked for"),
        (missing, "are missing: the map was interrupted"),
    ] {
        if count > 0 {
            let _ = write!(text, "; {count} {what}");
        }
    }
    let sort = match (failed + undetermined, missing, good < all.len()) {
        (1.., ..) => Sort::Numerical,
        (_, 1.., _) => Sort::Unfinished,
        (.., true) => Sort::Mechanism,
        _ => Sort::Good,
    };
    Answer::answer(sort, headline, text + ".")
}

/// One row a panel: how often each verdict, and the extremes.
fn counts(report: &MapReport<'_>) -> String {
    let panels = summary(report.study, report.result);
    let occurring: Vec<Verdict> = (Verdict::ALL.into_iter())
        .filter(|verdict| {
            panels
                .iter()
                .any(|panel| panel.verdicts.contains_key(verdict))
        })
        .collect();
    let mut head = String::from("<th>panel</th>");
    for verdict in &occurring {
        let _ = write!(head, "<th>{}</th>", verdict.words());
    }
    let mut rows = String::new();
    for (index, panel) in panels.iter().enumerate() {
        let label = match panel.label.as_str() {
            "" => "map".to_owned(),
            label => format!("{}  {label}", picture::letter(index)),
        };
        let _ = write!(rows, "<tr><th class=\"words\">{}</th>", escape(&label));
        for verdict in &occurring {
            let _ = write!(
                rows,
                "<td>{}</td>",
                panel.verdicts.get(verdict).unwrap_or(&0)
            );
        }
        for extreme in [&panel.least, &panel.greatest] {
            let value = |extreme: &Extreme| {
                format!(
                    "{}<span class=\"sub\">at {}</span>",
                    escape(&with_unit(extreme.value, &report.study.unit, 6)),
                    escape(&place(report.study, extreme))
                )
            };
            let text = extreme.as_ref().map_or("–".to_owned(), value);
            let _ = write!(rows, "<td>{text}</td>");
        }
        rows.push_str("</tr>\n");
    }
    format!(
        "<h2>Verdicts</h2>\n<div class=\"scroll\"><table>\n<thead><tr>{head}<th>least</th>\
         <th>greatest</th></tr></thead>\n<tbody>\n{rows}</tbody></table></div>\n"
    )
}

/// Values of the parameters at an extreme, with their units; one of the user's own takes
/// no prefix.
fn place(study: &Study<'_>, extreme: &Extreme) -> String {
    let [x_unit, y_unit] = &study.parameter_units;
    let shown = |value: f64, axis: &Axis, unit: &str| match axis.unit.as_str() {
        "" => with_unit(value, unit, 6),
        own => format!("{} {own}", significant(value, 6)),
    };
    let x = shown(extreme.place.0, &study.x, x_unit);
    match study.y.as_ref().zip(extreme.place.1) {
        Some((axis, y)) => format!("{x}; {}", shown(y, axis, y_unit)),
        None => x,
    }
}

/// What the verdicts that occur mean, with the bounds they rest on.
fn meanings(report: &MapReport<'_>) -> String {
    let mut occurring: BTreeMap<Verdict, usize> = BTreeMap::new();
    for cell in report.result.panels.iter().flatten().flatten() {
        *occurring.entry(cell.verdict).or_insert(0) += 1;
    }
    let mut rows: Vec<(&str, String)> = (occurring.keys())
        .map(|&verdict| (verdict.words(), meaning(verdict)))
        .collect();
    if report.study.check_determined {
        rows.push(("not determined", not_determined(report.study)));
    }
    format!("<h2>What they mean</h2>\n{}", facts(&rows))
}

/// What a ring upon a cell means.
fn not_determined(study: &Study<'_>) -> String {
    format!(
        "A ring upon a cell: the loads changed by one part in {} move the figure by more than \
         {} of its scale (ten times the tolerance of a general method, where that is more), so \
         that nobody knows it to the {} digits asked for. The verdict on the mechanism holds; how \
         far every figure moves is in map.csv.",
        significant(1.0 / CHANGE, 2),
        significant(10f64.powi(-i32::from(study.digits)), 2),
        study.digits
    )
}

fn meaning(verdict: Verdict) -> String {
    match verdict {
        Verdict::InWorkingOrder => "No pair opens in the whole run.".to_owned(),
        Verdict::LiftOffDiesAway => {
            "A pair opens after the start, and not in the window of steady figures.".to_owned()
        }
        Verdict::LiftOff => {
            "A pair opens in the window of steady figures: the mechanism is not in \
             working order. Of a rigid object: its motion needs a pull."
                .to_owned()
        }
        Verdict::LiftOffNotJudged => {
            "A pair opens, and the run has no window of steady figures: give it three turns of \
             the drive or more."
                .to_owned()
        }
        Verdict::ThrownOff => format!(
            "A pair opens and the object leaves its law by more than {THROWN_OFF} times the \
             amplitude of the law."
        ),
        Verdict::Resonance => format!(
            "No pair opens, and over the last cycle the deviation is at least {RESONANCE} times \
             the quasi-static one, is not dying away (less than {} % a cycle), and a natural \
             frequency lies near a harmonic of the drive: one mode would magnify it at least \
             {NEAR_HARMONIC} times.",
            100.0 * STEADY
        ),
        Verdict::Stopped => "The mechanism reaches a dead position.".to_owned(),
        Verdict::NumericalFailure => format!(
            "The computation failed: the method gave up, a number was not finite, the energies do \
             not balance, or more than {MOST_STEPS} steps or the switches allowed were needed (no other \
             method is tried then). It says nothing about the mechanism. Cells whose motion \
             between switches is known in closed form, and whose figure needs no record, are \
             not audited: dam run audits such a scene."
        ),
        Verdict::Refused => "The scene is refused at these values.".to_owned(),
    }
}

/// The causes of everything that is no plain answer.
fn causes(report: &MapReport<'_>) -> String {
    let told = |cell: &Cell| {
        matches!(
            cell.verdict,
            Verdict::NumericalFailure | Verdict::Refused | Verdict::Stopped
        ) || cell.determined == Some(false)
    };
    let mut rows = String::new();
    for (panel, cells) in report.result.panels.iter().enumerate() {
        let mut seen: BTreeMap<Verdict, usize> = BTreeMap::new();
        for (index, cell) in cells.iter().enumerate() {
            let Some(cell) = cell.as_ref().filter(|cell| told(cell)) else {
                continue;
            };
            let count = seen.entry(cell.verdict).or_insert(0);
            *count += 1;
            if *count <= MOST_CAUSES {
                rows.push_str(&cause(report, panel, index, cell));
            }
        }
        for (verdict, count) in seen.into_iter().filter(|(_, count)| *count > MOST_CAUSES) {
            let _ = writeln!(
                rows,
                "<tr><td>{}</td><td></td><td class=\"left\">{}</td><td class=\"left\">and {} \
                 more, in map.csv</td></tr>",
                name(report, panel),
                verdict.words(),
                count - MOST_CAUSES
            );
        }
    }
    if rows.is_empty() {
        return rows;
    }
    format!(
        "<h2>Causes</h2>\n<div class=\"scroll\"><table>\n<thead><tr><th>panel</th><th \
         class=\"left\">where</th><th class=\"left\">verdict</th><th class=\"left\">cause</th>\
         </tr></thead>\n<tbody>\n{rows}</tbody></table></div>\n"
    )
}

/// A panel as the picture calls it.
fn name(report: &MapReport<'_>, panel: usize) -> String {
    match report.study.panels.panels.len() {
        1 => "map".to_owned(),
        _ => picture::letter(panel),
    }
}

/// A value of a parameter to six digits: all of them are in the table of the map.
fn short(axis: &Axis, value: f64) -> String {
    let number = significant(value, 6);
    match axis.unit.as_str() {
        "" => number,
        unit => format!("{number} {unit}"),
    }
}

fn cause(report: &MapReport<'_>, panel: usize, index: usize, cell: &Cell) -> String {
    let study = report.study;
    let (x, y) = study.place(index);
    let mut place = short(&study.x, x);
    if let (Some(axis), Some(y)) = (&study.y, y) {
        let _ = write!(place, "; {}", short(axis, y));
    }
    format!(
        "<tr><td>{}</td><td class=\"left\">{}</td><td class=\"left\">{}</td>\
         <td class=\"words\">{}</td></tr>\n",
        name(report, panel),
        escape(&place),
        cell.verdict.words(),
        escape(&cell.cause)
    )
}
