//! Tables of the optima, of what holds them and of the starts.

use super::words::{DIGITS, FIGURE, figure_words, goal_value, goal_words, value_words};
use crate::report::addresses::{condition_words, parameter_words};
use crate::report::findings::{Cell, Table};
use crate::report::quantity::significant;
use crate::studies::optimize::{Optimization, Optimum, StartEnd, StartResult, Variable};

/// The variables with what their bounds are worth.
pub(super) fn values_table(answer: &Optimization, best: &Optimum) -> Table {
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

pub(super) fn conditions_table(answer: &Optimization, best: &Optimum) -> Table {
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
pub(super) fn conflict_table(answer: &Optimization) -> Option<Table> {
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

pub(super) fn optima_table(answer: &Optimization) -> Table {
    // (A variable that is the goal has its column already.)
    let has_goal = !answer.goal.is_parameter;
    let goal = has_goal.then(|| format!(">{}", goal_words(answer)));
    let heads = std::iter::once(String::new()).chain(goal);
    let variables = answer.variables.iter();
    let variables = variables.map(|one| format!(">{}", parameter_words(&one.path)));
    let heads: Vec<String> = heads
        .chain(variables)
        .chain([">starts".to_owned()])
        .collect();
    let row = |(at, one): (usize, &Optimum)| {
        let mut cells = vec![Cell::from((at + 1).to_string())];
        cells.extend(has_goal.then(|| Cell::from(goal_value(answer, one.goal, DIGITS))));
        let each = answer.variables.iter().zip(&one.values);
        cells.extend(
            each.map(|(variable, value)| Cell::from(value_words(variable, *value, FIGURE))),
        );
        cells.push(Cell::from(one.starts.len().to_string()));
        cells
    };
    Table::new(heads.iter().map(String::as_str)).rows(answer.optima.iter().enumerate().map(row))
}

pub(super) fn starts_table(answer: &Optimization) -> Table {
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
