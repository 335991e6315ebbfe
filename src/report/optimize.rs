//! The best values of several variables, as data.

use crate::report::addresses::{condition_words, parameter_words, result_words};
use crate::report::findings::{Cell, Findings, Item, Layout, Section, Source, Table};
use crate::report::plot::{Axis, Mark, Plot, Series, Shape};
use crate::report::quantity::{counted, significant, with_unit};
use crate::report::verdict::{Sort, Verdict, capitalised};
use crate::studies::optimize::{Optimization, Optimum, StartEnd, StartResult, Variable};

/// Digits of variables and of the goal at an optimum.
const DIGITS: usize = 8;
/// Digits of multipliers and figures.
const FIGURE: usize = 5;
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

fn goal_words(answer: &Optimization) -> String {
    match answer.goal.is_parameter {
        true => parameter_words(&answer.goal.of),
        false => result_words(&answer.goal.of),
    }
}

/// What is to be greatest or least: "least rate of the spring", "least value of a result".
fn extreme_words(answer: &Optimization) -> String {
    let value = if answer.goal.is_parameter {
        ""
    } else {
        "value of "
    };
    let aim = answer.goal.aim.words();
    format!("{aim} {value}{}", goal_words(answer))
}

/// What was asked, in a few words.
fn sought(answer: &Optimization) -> String {
    let goal = format!("the {}", extreme_words(answer));
    let subject = answer.conditions.iter();
    let subject = subject.map(|one| condition_words(&one.text, &one.figure));
    match subject.collect::<Vec<_>>().join(", ").as_str() {
        "" => goal,
        subject => format!("{goal} with {subject}"),
    }
}

/// A value of a variable with its unit.
fn value_words(variable: &Variable, value: f64, digits: usize) -> String {
    let number = significant(value, digits);
    format!("{number} {}", variable.unit).trim_end().to_owned()
}

/// A value of the goal with its unit: that in which a condition on it is written, else the one that
/// reads best.
fn goal_value(answer: &Optimization, value: f64, digits: usize) -> String {
    let unit = answer.goal.unit.as_str();
    match answer.goal.is_parameter {
        true => format!("{} {unit}", significant(value, digits))
            .trim_end()
            .to_owned(),
        false => with_unit(value, unit, digits),
    }
}

/// A figure in the unit in which its condition was written.
fn figure_words(answer: &Optimization, condition: usize, value: f64) -> String {
    let written = &answer.conditions[condition].written;
    let number = significant(value / written.size, FIGURE);
    format!("{number} {}", written.name).trim_end().to_owned()
}

fn verdict(answer: &Optimization) -> (Sort, String, String) {
    let Some(best) = answer.best() else {
        return without_optimum(answer);
    };
    let each = answer.variables.iter().zip(&best.values);
    let at: Vec<String> = each
        .filter(|(variable, _)| variable.path != answer.goal.of)
        .map(|(variable, value)| {
            let words = parameter_words(&variable.path);
            format!("{words} = {}", value_words(variable, *value, FIGURE))
        })
        .collect();
    let goal = goal_value(answer, best.goal, DIGITS);
    let extreme = extreme_words(answer);
    let mut headline = match answer.complete {
        true => format!("The {extreme} is {goal}"),
        false => format!("The {extreme} so far is {goal}"),
    };
    if !at.is_empty() {
        headline = format!("{headline}, at {}", at.join(", "));
    }
    let finer = answer.finer.as_ref().and_then(|finer| finer.stands);
    let (sort, text) = match (answer.complete, best.stationary, finer) {
        (false, ..) => (Sort::Unfinished, "Ended before all starts were done."),
        (true, false, _) => (
            Sort::Numerical,
            "Not certain: a slope is left, so that a nearby place may be better.",
        ),
        (true, true, Some(false)) => (
            Sort::Numerical,
            "Not certain: a finer model of the scene changes it too much.",
        ),
        (true, true, Some(true)) => (Sort::Good, "A finer model of the scene confirms it."),
        (true, true, None) => (Sort::Good, ""),
    };
    let held = match best.residual {
        Some(_) => held_by(answer, best),
        None => String::new(),
    };
    let text = [held.as_str(), text].join(" ").trim().to_owned();
    (sort, format!("{headline}."), text)
}

/// What holds an optimum, as a sentence.
fn held_by(answer: &Optimization, best: &Optimum) -> String {
    let conditions = answer.conditions.iter().zip(&best.conditions);
    let conditions = conditions
        .filter(|(_, held)| held.active)
        .map(|(condition, _)| condition_words(&condition.text, &condition.figure));
    let bounds = best.bounds.iter().map(|bound| {
        let end = if bound.upper { "greatest" } else { "least" };
        format!("the {end} {}", parameter_words(&bound.variable))
    });
    let all: Vec<String> = conditions.chain(bounds).collect();
    match all.as_slice() {
        [] => "No condition holds it.".to_owned(),
        [one] => format!("It is held by {one}."),
        all => format!("It is held by {}.", all.join(" and ")),
    }
}

fn without_optimum(answer: &Optimization) -> (Sort, String, String) {
    if !answer.complete {
        let headline = "No place that meets the conditions was found.".to_owned();
        let text = "Ended before all starts were done.".to_owned();
        return (Sort::Unfinished, headline, text);
    }
    let failed = |start: &StartResult| start.end == StartEnd::Failed;
    if answer.starts.iter().all(failed) {
        let why = answer.starts.first().map_or("", |start| start.why.as_str());
        let headline = "The scene has no values at any start.".to_owned();
        return (Sort::Mechanism, headline, capitalised(&format!("{why}.")));
    }
    let headline = "No place that meets the conditions was found.".to_owned();
    let text = match &answer.least_violation {
        Some(found) if !found.conflict.is_empty() => {
            let all = found.conflict.iter().map(|&own| {
                let condition = &answer.conditions[own];
                condition_words(&condition.text, &condition.figure)
            });
            let all: Vec<String> = all.collect();
            match all.as_slice() {
                [one] => format!("Nothing near the least violation brings {one} closer."),
                all => format!(
                    "At the least violation {} contradict each other.",
                    all.join(" and ")
                ),
            }
        }
        _ => String::new(),
    };
    (Sort::Mechanism, headline, text)
}

/// The variables with what their bounds are worth.
fn values_table(answer: &Optimization, best: &Optimum) -> Table {
    let row = |(at, variable): (usize, &Variable)| {
        let held = best.bounds.iter().find(|one| one.variable == variable.path);
        let (end, worth) = match held {
            Some(held) => (
                if held.upper { "greatest" } else { "least" },
                format!("{} {}", significant(held.multiplier, FIGURE), held.unit)
                    .trim_end()
                    .to_owned(),
            ),
            None => ("", "–".to_owned()),
        };
        let range = format!(
            "{} to {}",
            value_words(variable, variable.low, FIGURE),
            value_words(variable, variable.high, FIGURE)
        );
        let stretch = best.flat.iter().find(|flat| flat.from[at] != flat.to[at]);
        let stretch = stretch.map_or_else(String::new, |flat| {
            let (low, high) = (
                flat.from[at].min(flat.to[at]),
                flat.from[at].max(flat.to[at]),
            );
            let [low, high] = [low, high].map(|end| value_words(variable, end, DIGITS));
            format!("{low} to {high}")
        });
        vec![
            Cell::address(&variable.path, parameter_words(&variable.path)),
            Cell::from(value_words(variable, best.values[at], DIGITS)),
            Cell::from(range),
            Cell::from(end),
            Cell::from(worth),
            Cell::from(stretch),
        ]
    };
    let heads = [
        "variable",
        ">value",
        ">range",
        "at bound",
        ">change of the goal by the bound",
        ">equally good",
    ];
    Table::new(heads).rows(answer.variables.iter().enumerate().map(row))
}

fn conditions_table(answer: &Optimization, best: &Optimum) -> Table {
    let each = answer.conditions.iter().zip(&best.conditions).enumerate();
    let row = |(at, (condition, held)): (
        usize,
        (
            &crate::studies::condition::Condition,
            &crate::studies::optimize::HeldCondition,
        ),
    )| {
        let worth = held.multiplier.map_or_else(
            || "–".to_owned(),
            |value| {
                let words = format!("{} {}", significant(value, FIGURE), held.unit);
                words.trim_end().to_owned()
            },
        );
        vec![
            Cell::address(
                &condition.text,
                condition_words(&condition.text, &condition.figure),
            ),
            Cell::from(figure_words(answer, at, shown_figure(condition, held))),
            Cell::from(if held.active { "at its limit" } else { "holds" }).with_outcome(Some(true)),
            Cell::from(worth),
        ]
    };
    let heads = [
        "condition",
        ">result",
        "",
        ">change of the goal by the limit",
    ];
    Table::new(heads).rows(each.map(row))
}

/// The figure of a condition. At its limit it is that, where it differs by rounding alone.
fn shown_figure(
    condition: &crate::studies::condition::Condition,
    held: &crate::studies::optimize::HeldCondition,
) -> f64 {
    let apart = (held.figure - condition.value).abs();
    match held.active && apart <= 1e-9 * condition.value.abs().max(held.figure.abs()) {
        true => condition.value,
        false => held.figure,
    }
}

/// The conditions where they are violated least.
fn conflict_table(answer: &Optimization) -> Option<Table> {
    let found = answer.least_violation.as_ref()?;
    let row = |(at, condition): (usize, &crate::studies::condition::Condition)| {
        let conflict = found.conflict.contains(&at);
        let violated = found.violations[at] > 0.0;
        vec![
            Cell::address(
                &condition.text,
                condition_words(&condition.text, &condition.figure),
            ),
            Cell::from(figure_words(answer, at, found.figures[at])),
            Cell::from(figure_words(answer, at, found.violations[at])),
            Cell::from(if conflict { "in conflict" } else { "" }).with_outcome(Some(!violated)),
        ]
    };
    let heads = ["condition", ">result", ">violated by", ""];
    Some(Table::new(heads).rows(answer.conditions.iter().enumerate().map(row)))
}

fn optima_table(answer: &Optimization) -> Table {
    let heads = ["".to_owned(), format!(">{}", goal_words(answer))];
    let variables = answer.variables.iter();
    let variables = variables.map(|one| format!(">{}", parameter_words(&one.path)));
    let heads: Vec<String> = heads
        .into_iter()
        .chain(variables)
        .chain([">starts".to_owned()])
        .collect();
    let row = |(at, one): (usize, &Optimum)| {
        let mut cells = vec![
            Cell::from((at + 1).to_string()),
            Cell::from(goal_value(answer, one.goal, DIGITS)),
        ];
        let each = answer.variables.iter().zip(&one.values);
        cells.extend(
            each.map(|(variable, value)| Cell::from(value_words(variable, *value, FIGURE))),
        );
        cells.push(Cell::from(one.starts.len().to_string()));
        cells
    };
    Table::new(heads.iter().map(String::as_str)).rows(answer.optima.iter().enumerate().map(row))
}

fn starts_table(answer: &Optimization) -> Table {
    let variables = answer.variables.iter();
    let variables = variables.map(|one| format!(">{} at first", parameter_words(&one.path)));
    let heads: Vec<String> = [">start".to_owned()]
        .into_iter()
        .chain(variables)
        .chain([
            format!(">{}", goal_words(answer)),
            "ends".to_owned(),
            ">optimum".to_owned(),
            ">places".to_owned(),
            "~cause".to_owned(),
        ])
        .collect();
    let row = |(at, one): (usize, &StartResult)| {
        let mut cells = vec![Cell::from((at + 1).to_string())];
        let each = answer.variables.iter().zip(&one.from);
        cells.extend(
            each.map(|(variable, value)| Cell::from(value_words(variable, *value, FIGURE))),
        );
        let goal = one.goal.map(|goal| goal_value(answer, goal, FIGURE));
        let optimum = one.optimum.map(|own| (own + 1).to_string());
        let good = (one.end == StartEnd::Optimum).then_some(true);
        cells.extend([
            Cell::from(goal.unwrap_or_else(|| "–".to_owned())),
            Cell::from(one.end.words()).with_outcome(good),
            Cell::from(optimum.unwrap_or_else(|| "–".to_owned())),
            Cell::from(one.evaluations.to_string()),
            Cell::from(one.why.as_str()),
        ]);
        cells
    };
    Table::new(heads.iter().map(String::as_str)).rows(answer.starts.iter().enumerate().map(row))
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
