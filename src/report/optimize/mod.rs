//! The best values of several variables, as data.

mod tables;
mod words;

use crate::report::findings::{Findings, Item, Layout, Section, Source};
use crate::report::plot::{Axis, Mark, Plot, Series, Shape};
use crate::report::quantity::counted;
use crate::report::verdict::{Verdict, capitalised};
use crate::studies::optimize::{Optimization, StartResult};
use tables::{conditions_table, conflict_table, optima_table, starts_table, values_table};
use words::{DIGITS, FIGURE, goal_value, goal_words, sought, verdict};

/// Most starts whose progress is drawn.
const MOST_DRAWN: usize = 12;

/// The optimum, what holds it, the starts and their progress.
pub fn findings<'a>(scene: &str, answer: &Optimization, source: Source<'a>) -> Findings<'a> {
    let mut sections = Vec::new();
    if let Some(best) = answer.best() {
        sections.push(Section::new("Best values").table(values_table(answer, best)));
        if !answer.conditions.is_empty() {
            sections.push(Section::new("Conditions there").table(conditions_table(answer, best)));
        }
    }
    if let Some(violation) = conflict_table(answer) {
        sections.push(Section::new("Least violation").table(violation));
    }
    if answer.optima.len() > 1 {
        sections.push(Section::new("Distinct optima").table(optima_table(answer)));
    }
    sections.push(Section::new("Starts").table(starts_table(answer)));
    let charts = charts(answer);
    if !charts.is_empty() {
        sections.push(Section::new("Progress").charts(Layout::Grid, "optimize", charts));
    }
    sections.push(Section {
        heading: String::new(),
        items: vec![Item::Notes(notes(answer))],
    });
    sections.retain(|section| !section.is_empty());
    let (sort, headline, text) = verdict(answer);
    let mut findings = Findings {
        title: scene.to_owned(),
        subtitle: sought(answer),
        answer: Some(Verdict::answer(sort, headline, text)),
        warnings: Vec::new(),
        sections,
        source,
    };
    findings.label(answer.rigid.as_ref(), "results of other studies are");
    findings
}

/// The best goal so far of each start.
fn charts(answer: &Optimization) -> Vec<Plot> {
    let line = |(at, one): (usize, &StartResult)| {
        let last = one.progress.last()?;
        let points = one
            .progress
            .iter()
            .map(|(number, goal)| (*number as f64, *goal));
        // The best stays the best up to the end.
        let points = points.chain([(one.evaluations as f64, last.1)]);
        Some(Series::line(&format!("start {}", at + 1), points.collect()))
    };
    let mut series: Vec<Series> = (answer.starts.iter().enumerate())
        .filter_map(line)
        .take(MOST_DRAWN)
        .collect();
    if series.is_empty() {
        return Vec::new();
    }
    if let Some(best) = answer.best() {
        let longest = best
            .starts
            .iter()
            .map(|&own| answer.starts[own].evaluations);
        let point = (longest.min().unwrap_or(1) as f64, best.goal);
        let mark = Mark::new(Shape::Good, goal_value(answer, best.goal, FIGURE));
        series.push(Series::marked("the optimum", vec![point], vec![mark]));
    }
    vec![Plot {
        id: "progress".to_owned(),
        title: format!(
            "{} while the starts go on",
            capitalised(&goal_words(answer))
        ),
        x: Axis {
            fixed: true,
            ..Axis::new("places examined", "")
        },
        y: Axis::of(&answer.goal.unit),
        series,
        ..Plot::default()
    }]
}

/// How far the answer goes.
fn notes(answer: &Optimization) -> Vec<String> {
    let mut notes = Vec::new();
    let ended = answer
        .starts
        .iter()
        .filter(|one| one.optimum == Some(0))
        .count();
    if answer.best().is_some() {
        notes.push(format!(
            "{} of {} ended at this optimum. A better one that no start reaches can be missed. For \
             more starts: `--starts COUNT`.",
            ended,
            counted(answer.starts.len(), "start")
        ));
    }
    if !answer.settings.is_empty() {
        let settings = answer.settings.iter().map(|one| match one.contains(' ') {
            true => format!("--set \"{one}\""),
            false => format!("--set {one}"),
        });
        notes.push(format!(
            "The scene with these values: `{}`.",
            settings.collect::<Vec<_>>().join(" ")
        ));
    }
    notes.extend(finer_note(answer));
    let slopes = &answer.slopes;
    notes.push(format!(
        "{} examined. Slopes of results: {} exact, {} central differences.",
        capitalised(&counted(answer.evaluations, "place")),
        slopes.exact,
        slopes.differences
    ));
    if !slopes.why_differences.is_empty() {
        notes.push(format!("No slope is exact: {}.", slopes.why_differences));
    }
    notes
}

fn finer_note(answer: &Optimization) -> Option<String> {
    let finer = answer.finer.as_ref()?;
    if !finer.why_not.is_empty() {
        return Some(format!(
            "Not compared with a finer model: {}.",
            finer.why_not
        ));
    }
    let gain = finer.gain.map_or_else(String::new, |gain| {
        format!(
            "; the optimum gains {} over the best start",
            goal_value(answer, gain, 2)
        )
    });
    let violated: Vec<&str> = (finer.violated.iter())
        .map(|&own| answer.conditions[own].text.as_str())
        .collect();
    let violated = match violated.as_slice() {
        [] => String::new(),
        all => format!(" It violates {}.", all.join(", ")),
    };
    let goal = match (finer.goal, finer.moved) {
        (Some(goal), Some(moved)) => format!(
            "gives {} there. The goal moves by {}{gain}.",
            goal_value(answer, goal, DIGITS),
            goal_value(answer, moved, 2)
        ),
        _ => "was asked for the conditions there.".to_owned(),
    };
    Some(format!("A finer model ({}) {goal}{violated}", finer.levels))
}
