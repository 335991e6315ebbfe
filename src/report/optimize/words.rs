//! What an optimum is, in words.

use crate::report::addresses::{condition_words, parameter_words, result_words};
use crate::report::quantity::{significant, with_unit};
use crate::report::verdict::{Sort, capitalised};
use crate::studies::optimize::{Optimization, Optimum, StartEnd, StartResult, Variable};

/// Digits of variables and of the goal at an optimum.
pub(super) const DIGITS: usize = 8;
/// Digits of multipliers and figures.
pub(super) const FIGURE: usize = 5;

pub(super) fn goal_words(answer: &Optimization) -> String {
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
pub(super) fn sought(answer: &Optimization) -> String {
    let goal = format!("the {}", extreme_words(answer));
    let subject = answer.conditions.iter();
    let subject = subject.map(|one| condition_words(&one.text, &one.figure));
    match subject.collect::<Vec<_>>().join(", ").as_str() {
        "" => goal,
        subject => format!("{goal} with {subject}"),
    }
}

/// A value of a variable with its unit.
pub(super) fn value_words(variable: &Variable, value: f64, digits: usize) -> String {
    let number = significant(value, digits);
    format!("{number} {}", variable.unit).trim_end().to_owned()
}

/// A value of the goal with its unit: that in which a condition on it is written, else the one that
/// reads best.
pub(super) fn goal_value(answer: &Optimization, value: f64, digits: usize) -> String {
    let unit = answer.goal.unit.as_str();
    match answer.goal.is_parameter {
        true => format!("{} {unit}", significant(value, digits))
            .trim_end()
            .to_owned(),
        false => with_unit(value, unit, digits),
    }
}

/// A figure in the unit in which its condition was written.
pub(super) fn figure_words(answer: &Optimization, condition: usize, value: f64) -> String {
    let written = &answer.conditions[condition].written;
    let number = significant(value / written.size, FIGURE);
    format!("{number} {}", written.name).trim_end().to_owned()
}

pub(super) fn verdict(answer: &Optimization) -> (Sort, String, String) {
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
