//! What a map shows: panels, verdicts, extremes, what the verdicts mean, causes.

use super::meanings::{meaning, not_determined};
use super::picture::{key, panel_letter, panels};
use super::pointing::section;
use crate::report::addresses::{parameter_words, result_words, setting_words};
use crate::report::findings::{Cell as Entry, Findings, Layout, Section, Source, Table, Value};
use crate::report::html::definition_list;
use crate::report::quantity::{significant, with_unit};
use crate::report::sentence::Sentence;
use crate::report::verdict::{Sort, Verdict as Answer, capitalised};
use crate::studies::axis::Axis;
use crate::studies::judgement::Judgement;
use crate::studies::map::{Cell, Extreme, MapResult, PanelSummary, Study, Verdict, summary};
use std::collections::BTreeMap;
use std::fmt::Write as _;

/// Causes listed of each verdict and panel.
const MOST_CAUSES: usize = 12;

/// The map. `command` runs the scene with the settings of all cells, word by word: `dam`, `run`,
/// `scene.json`, `--set`, `rocker.masses=2`.
pub fn findings<'a>(
    study: &'a Study<'a>,
    result: &'a MapResult,
    command: &'a [String],
    warnings: Vec<String>,
    source: Source<'a>,
) -> Findings<'a> {
    let summed = summary(study, result);
    let columns = study.panels.columns.clamp(1, 4);
    let columns = columns.min(study.panels.panels.len());
    let over = match &study.y {
        Some(y) => format!("{} and {}", axis_phrase(&study.x), axis_phrase(y)),
        None => axis_phrase(&study.x),
    };
    let mut sections = vec![
        Section::new("Map")
            .charts(Layout::Panels(columns), "map", panels(study, result))
            .drawing(|_| key(study, result))
            .drawing(|_| section(study, result, command)),
        Section::new("Verdicts").table(verdicts_table(study, &summed)),
        Section::new("Extremes").table(extremes_table(study, &summed)),
        Section::new("What they mean").drawing(|_| meanings(study, result)),
        Section::new("Causes").table(causes_table(study, result)),
    ];
    sections.retain(|section| !section.is_empty());
    let mut findings = Findings {
        title: study.scene.clone(),
        subtitle: format!("{} over {over}", result_words(&study.figure)),
        answer: Some(answer(study, result, &summed)),
        warnings,
        sections,
        source,
    };
    let what = format!("{} is", study.figure);
    findings.label(study.rigid.as_ref(), &what);
    findings
}

fn axis_phrase(axis: &Axis) -> String {
    let by = if axis.log { " by equal ratios" } else { "" };
    format!(
        "{} ({} values from {} to {}{by})",
        parameter_words(&axis.path),
        axis.count,
        value_text(axis, axis.from),
        value_text(axis, axis.to)
    )
}

/// Between what the figure lies, how many cells are in order, and what is doubtful.
fn answer(study: &Study<'_>, result: &MapResult, panels: &[PanelSummary]) -> Answer {
    let all: Vec<&Cell> = result.panels.iter().flatten().flatten().collect();
    let count = |judgement: Judgement| {
        let cells = all.iter();
        let same = cells.filter(|cell| cell.verdict.judgement() == Some(judgement));
        same.count()
    };
    let least = panels.iter().filter_map(|panel| panel.least.as_ref());
    let least = least.min_by(|a, b| a.value.total_cmp(&b.value));
    let greatest = panels.iter().filter_map(|panel| panel.greatest.as_ref());
    let greatest = greatest.max_by(|a, b| a.value.total_cmp(&b.value));
    let figure = result_words(&study.figure);
    let span = match least.zip(greatest) {
        Some((least, greatest)) => Sentence::from(format!("{} from ", capitalised(&figure)))
            .quantity(least.value, &study.unit, 4)
            .words(" to ")
            .quantity(greatest.value, &study.unit, 4)
            .words("."),
        None => format!("{} has no value anywhere.", capitalised(&figure)).into(),
    };
    let (good, failed) = (
        count(Judgement::InWorkingOrder),
        count(Judgement::NotToBeTrusted),
    );
    let unjudged = count(Judgement::NotJudged);
    let undetermined: usize = panels.iter().map(|panel| panel.undetermined).sum();
    let missing: usize = panels.iter().map(|panel| panel.missing).sum();
    let mut text = String::new();
    let order = format!("{good} of {} cells are in working order", all.len());
    for (count, what) in [
        (
            count(Judgement::NotInWorkingOrder),
            "are not in working order",
        ),
        (unjudged, "are not judged"),
        (failed, "are not to be trusted"),
        (undetermined, "are not known to the required digits"),
        (missing, "are missing: the map was interrupted"),
    ] {
        if count > 0 {
            let what = match count {
                1 => what.replacen("are ", "is ", 1),
                _ => what.to_owned(),
            };
            let between = if text.is_empty() { "" } else { "; " };
            let _ = write!(text, "{between}{count} {what}");
        }
    }
    let sort = match (failed + undetermined, missing, good + unjudged < all.len()) {
        (1.., ..) => Sort::Numerical,
        (_, 1.., _) => Sort::Unfinished,
        (.., true) => Sort::Mechanism,
        _ if unjudged > 0 => Sort::Unfinished,
        _ => Sort::Good,
    };
    let text = if text.is_empty() { text } else { text + "." };
    if unjudged == all.len() {
        return Answer::answer(sort, span, text);
    }
    let (headline, text) = match interval(study, result) {
        Some(interval) => (interval, format!("{order}; {text}")),
        None => (order + ".", text),
    };
    let text = match text.as_str() {
        "" => span,
        text => Sentence::from(format!("{text} ")).sentence(span),
    };
    Answer::answer(sort, headline, text)
}

/// The interval of one parameter in which all cells are in working order, where there is one
/// and cells beyond it; the bounds are cells.
fn interval(study: &Study<'_>, result: &MapResult) -> Option<String> {
    let [cells] = &result.panels[..] else {
        return None;
    };
    if study.y.is_some() {
        return None;
    }
    let good = |cell: &Option<Cell>| {
        let judged = cell.as_ref().and_then(|cell| cell.verdict.judgement());
        judged == Some(Judgement::InWorkingOrder)
    };
    let first = cells.iter().position(good)?;
    let last = cells.iter().rposition(good)?;
    let whole = cells[first..=last].iter().all(good);
    (whole && first < last && last - first + 1 < cells.len()).then(|| {
        let [from, to] =
            [first, last].map(|index| value_text(&study.x, study.parameters_at_cell(index).0));
        let parameter = parameter_words(&study.x.path);
        format!("In working order for a {parameter} from {from} to {to}.")
    })
}

/// A panel as the picture calls it.
fn name(study: &Study<'_>, panel: usize) -> String {
    match study.panels.panels.len() {
        1 => "map".to_owned(),
        _ => panel_letter(panel),
    }
}

/// How often each verdict occurs, a column a panel.
fn verdicts_table(study: &Study<'_>, panels: &[PanelSummary]) -> Table {
    let names: Vec<String> = (0..panels.len())
        .map(|panel| match panels.len() {
            1 => ">cells".to_owned(),
            _ => format!(">{}", panel_letter(panel)),
        })
        .collect();
    let heads = std::iter::once("verdict").chain(names.iter().map(String::as_str));
    let mut table = Table::new(heads);
    let mut row = |name: &str, count: &dyn Fn(&PanelSummary) -> usize| {
        if panels.iter().all(|panel| count(panel) == 0) {
            return;
        }
        let cell = |panel: &PanelSummary| {
            let all: usize = panel.verdicts.values().sum::<usize>() + panel.missing;
            let share = 100.0 * count(panel) as f64 / all.max(1) as f64;
            Entry::with_note(count(panel).to_string(), format!("{share:.1} %"))
        };
        let first = std::iter::once(Entry::from(name));
        table.push(first.chain(panels.iter().map(cell)));
    };
    for verdict in Verdict::ALL {
        row(verdict.words(), &|panel| {
            panel.verdicts.get(&verdict).copied().unwrap_or(0)
        });
    }
    let undetermined = format!("not determined to {} digits", study.digits);
    row(&undetermined, &|panel| panel.undetermined);
    row("not worked out", &|panel| panel.missing);
    table
}

/// The least and the greatest value of every panel.
fn extremes_table(study: &Study<'_>, panels: &[PanelSummary]) -> Table {
    let cell = |extreme: &Option<Extreme>| match extreme {
        None => Entry::from("–"),
        Some(extreme) => Entry::with_note(
            Value::new(extreme.value, &study.unit, 7),
            format!(
                "at {}, {}",
                parameters_at_extreme(study, extreme),
                extreme.verdict.words()
            ),
        ),
    };
    let row = |(index, panel): (usize, &PanelSummary)| {
        let label = match panel.label.as_str() {
            "" => "map".to_owned(),
            label => format!("{}  {}", panel_letter(index), setting_words(label)),
        };
        vec![label.into(), cell(&panel.least), cell(&panel.greatest)]
    };
    Table::new(["panel", ">least", ">greatest"]).rows(panels.iter().enumerate().map(row))
}

/// Values of the parameters at an extreme, with their units; one of the user's own takes
/// no prefix.
fn parameters_at_extreme(study: &Study<'_>, extreme: &Extreme) -> String {
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

/// The verdicts that occur, with the bounds they rest on.
fn meanings(study: &Study<'_>, result: &MapResult) -> String {
    let cells = result.panels.iter().flatten().flatten();
    let occurring: std::collections::BTreeSet<Verdict> = cells.map(|cell| cell.verdict).collect();
    let mut rows: Vec<(&str, String)> = (occurring.iter())
        .map(|&verdict| (verdict.words(), meaning(verdict)))
        .collect();
    if study.check_determined {
        rows.push(("not determined", not_determined(study)));
    }
    definition_list(&rows)
}

/// The causes of everything that is no plain answer.
fn causes_table(study: &Study<'_>, result: &MapResult) -> Table {
    let told = |cell: &Cell| {
        matches!(
            cell.verdict,
            Verdict::NotFinished | Verdict::NumericalFailure | Verdict::Refused | Verdict::Stopped
        ) || cell.determined == Some(false)
    };
    let mut table = Table::new(["panel", "where", "verdict", "~cause"]);
    for (panel, cells) in result.panels.iter().enumerate() {
        let mut seen: BTreeMap<Verdict, usize> = BTreeMap::new();
        for (index, cell) in cells.iter().enumerate() {
            let Some(cell) = cell.as_ref().filter(|cell| told(cell)) else {
                continue;
            };
            let count = seen.entry(cell.verdict).or_insert(0);
            *count += 1;
            if *count <= MOST_CAUSES {
                let (x, y) = study.parameters_at_cell(index);
                let y = study.y.as_ref().zip(y);
                let y = y.map_or(String::new(), |(axis, y)| {
                    format!("; {}", value_text(axis, y))
                });
                table.push([
                    name(study, panel),
                    value_text(&study.x, x) + &y,
                    cell.verdict.words().to_owned(),
                    cell.cause.clone(),
                ]);
            }
        }
        for (verdict, count) in seen.into_iter().filter(|(_, count)| *count > MOST_CAUSES) {
            let more = format!("and {} more, in map.csv", count - MOST_CAUSES);
            table.push([&name(study, panel), "", verdict.words(), &more]);
        }
    }
    table
}

/// A value of a parameter to six digits: all of them are in the table of the map.
fn value_text(axis: &Axis, value: f64) -> String {
    let number = significant(value, 6);
    match axis.unit.as_str() {
        "" => number,
        unit => format!("{number} {unit}"),
    }
}
