//! The best value of a parameter, as data.

use crate::report::addresses::{condition_words, parameter_words, result_words};
use crate::report::findings::{Cell, Findings, Item, Layout, Section, Source, Table};
use crate::report::plot::{Axis, Band, Mark, Plot, Rule, Series, Shape};
use crate::report::quantity::{counted, significant, with_unit};
use crate::report::verdict::{Sort, Verdict, capitalised};
use crate::studies::condition::Condition;
use crate::studies::find::{Best, ConditionEnd, FoundValue, Limit, Range, Sample, State};

/// Digits of the parameter at the answer; places are known to one part in 10⁷ of the range.
const DIGITS: usize = 8;
/// Digits of figures.
const FIGURE: usize = 5;
/// Most places of the table about the answer, on either side.
const BESIDE: usize = 4;

/// The answer, the conditions there, the places about it, the ranges, and charts.
pub fn findings<'a>(scene: &str, answer: &FoundValue, source: Source<'a>) -> Findings<'a> {
    let found = &answer.found;
    let mut sections = Vec::new();
    if let Some(best) = &found.best {
        sections.push(
            Section::new("Conditions there").table(conditions_at_table(answer, &best.sample)),
        );
        sections.push(Section::new("Around it").table(neighbours_table(answer, best)));
    }
    sections.push(Section::new("Ranges in which all conditions hold").table(ranges_table(answer)));
    let charts = charts(answer);
    if !charts.is_empty() {
        sections.push(Section::new("Over the range").charts(Layout::Grid, "find", charts));
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

/// What was asked, in a few words.
fn sought(answer: &FoundValue) -> String {
    let path = parameter_words(&answer.span.axis.path);
    let subject = answer.conditions.iter();
    let subject = subject.map(|one| condition_words(&one.text, &one.figure));
    let subject = subject.collect::<Vec<_>>().join(", ");
    let wanted = match &answer.goal {
        Some(goal) if goal.is_parameter => format!("the {} {path}", goal.aim.words()),
        Some(goal) => format!(
            "{path} for the {} {}",
            goal.aim.words(),
            result_words(&goal.of)
        ),
        None => format!("the ranges of {path}"),
    };
    match subject.as_str() {
        "" => wanted,
        subject => format!("{wanted} with {subject}"),
    }
}

/// A value of the parameter with its unit.
fn parameter(answer: &FoundValue, value: f64, digits: usize) -> String {
    let number = significant(value, digits);
    match answer.unit.as_str() {
        "" => number,
        unit => format!("{number} {unit}"),
    }
}

fn verdict(answer: &FoundValue) -> (Sort, String, String) {
    let found = &answer.found;
    let path = parameter_words(&answer.span.axis.path);
    let sort = match (found.complete, found.certain, answer.is_answered()) {
        (false, ..) => Sort::Unfinished,
        (true, false, _) => Sort::Numerical,
        (true, true, true) => Sort::Good,
        (true, true, false) => Sort::Mechanism,
    };
    let (headline, text) = match (&found.best, &answer.goal) {
        (Some(best), Some(goal)) => {
            let at = parameter(answer, best.sample.value, DIGITS);
            let headline = match goal.is_parameter {
                true => format!("The {} {path} is {at}.", goal.aim.words()),
                false => format!(
                    "The {} value of {} is {}, at {path} = {at}.",
                    goal.aim.words(),
                    result_words(&goal.of),
                    figure(answer, &goal.of, best.sample.goal)
                ),
            };
            (headline, why_no_better(answer, best))
        }
        (None, Some(_)) | (_, None) if found.ranges.is_empty() => (
            match found.complete {
                true => format!("No value of {path} in the range meets the conditions."),
                false => format!("No examined value of {path} meets the conditions."),
            },
            nowhere_known(answer),
        ),
        (None, Some(goal)) => (
            format!(
                "{} has no value where the conditions hold.",
                capitalised(&result_words(&goal.of))
            ),
            String::new(),
        ),
        (_, None) => {
            let ranges: Vec<String> = found
                .ranges
                .iter()
                .map(|one| range_in_words(answer, [&one.from, &one.to]))
                .collect();
            (
                format!("All conditions hold for {path} {}.", ranges.join(" and ")),
                String::new(),
            )
        }
    };
    let open = match (found.complete, found.certain) {
        (false, _) => "Ended before all places were examined.",
        (true, false) => "Not certain: something that is not known could change it.",
        (true, true) => "",
    };
    (
        sort,
        headline,
        [text.as_str(), open].join(" ").trim().to_owned(),
    )
}

/// Why the conditions can be judged nowhere, as a sentence; empty if they can.
fn nowhere_known(answer: &FoundValue) -> String {
    let mut reasons: Vec<&str> = Vec::new();
    for sample in &answer.found.samples {
        match &sample.state {
            State::Computed => return String::new(),
            State::Refused(why) | State::Stopped(why) | State::NotTrusted(why) => {
                if !reasons.contains(&why.as_str()) {
                    reasons.push(why);
                }
            }
        }
    }
    match reasons.as_slice() {
        [only] => format!("They cannot be judged at any value: {only}."),
        _ => String::new(),
    }
}

/// The first of the reasons for which there is no result somewhere.
fn first_refusal(answer: &FoundValue) -> String {
    let first = answer
        .found
        .samples
        .iter()
        .find_map(|one| match &one.state {
            State::Refused(why) => Some(why.as_str()),
            State::Computed | State::Stopped(_) | State::NotTrusted(_) => None,
        });
    format!("there is no result: {}", first.unwrap_or_default())
}

/// The two ends of a range in words.
fn range_in_words(answer: &FoundValue, [from, to]: [&ConditionEnd; 2]) -> String {
    let [from, to] = [from, to].map(|end| end.sample.value);
    match from == to {
        true => format!("at {}", parameter(answer, from, DIGITS)),
        false => format!(
            "from {} to {}",
            parameter(answer, from, DIGITS),
            parameter(answer, to, DIGITS)
        ),
    }
}

/// What keeps the answer from being better, as a sentence.
fn why_no_better(answer: &FoundValue, best: &Best) -> String {
    let Some(limit) = &best.limit else {
        let goal = answer.goal.as_ref().map_or("best", |goal| goal.aim.words());
        return format!("No condition binds: it is the {goal} of the examined values.");
    };
    let words = limit_words(answer, limit);
    match limit {
        Limit::Range => format!("{}: a wider range may give more.", capitalised(&words)),
        Limit::Conditions(_) | Limit::State(_) | Limit::Equality(_) | Limit::Abrupt => {
            format!("{}.", capitalised(&words))
        }
    }
}

/// Why a range ends, in words.
fn limit_words(answer: &FoundValue, limit: &Limit) -> String {
    match limit {
        Limit::Range => "the range ends there".to_owned(),
        Limit::Conditions(all) => {
            let words = |&at: &usize| {
                let condition = &answer.conditions[at];
                condition_words(&condition.text, &condition.figure)
            };
            let names: Vec<String> = all.iter().map(words).collect();
            format!("beyond it {} would not hold", names.join(" and "))
        }
        Limit::Equality(at) => format!("there {} holds", answer.conditions[*at].text),
        Limit::State(state) => format!("beyond it {}", state_words(state)),
        Limit::Abrupt => "the result jumps there or has no bound".to_owned(),
    }
}

fn state_words(state: &State) -> String {
    let because = |what: &str, why: &str| match why {
        "" => what.to_owned(),
        why => format!("{what}: {why}"),
    };
    match state {
        State::Computed => "everything is known".to_owned(),
        State::Refused(why) => because("there is no such mechanism", why),
        State::Stopped(why) => because("the mechanism stops", why),
        State::NotTrusted(why) => because("the computation is not to be trusted", why),
    }
}

/// A figure in the unit in which a condition on it was written, else in the one that reads best.
fn figure(answer: &FoundValue, name: &str, value: Option<f64>) -> String {
    let Some(value) = value else {
        return "–".to_owned();
    };
    if let Some(one) = answer.conditions.iter().find(|one| one.figure == name) {
        let number = significant(value / one.written.size, FIGURE);
        return format!("{number} {}", one.written.name)
            .trim_end()
            .to_owned();
    }
    let unit = answer.goal.as_ref().map_or("", |goal| goal.unit.as_str());
    with_unit(value, unit, FIGURE)
}

/// Each condition with its figure at a place.
fn conditions_at_table(answer: &FoundValue, sample: &Sample) -> Table {
    let violated = sample.violated(&answer.conditions);
    let row = |(at, one): (usize, &Condition)| {
        let holds = !violated.contains(&at);
        vec![
            Cell::address(&one.text, condition_words(&one.text, &one.figure)),
            Cell::from(figure(answer, &one.figure, sample.figures[at])),
            Cell::from(if holds { "holds" } else { "does not hold" }).with_outcome(Some(holds)),
        ]
    };
    Table::new(["condition", ">result", ""]).rows(answer.conditions.iter().enumerate().map(row))
}

/// The places about the answer.
fn neighbours_table(answer: &FoundValue, best: &Best) -> Table {
    let all = &answer.found.samples;
    let place = all
        .iter()
        .position(|one| one.share == best.sample.share)
        .unwrap_or(0);
    let apart = |one: &&Sample| {
        let distance = (one.share - best.sample.share).abs();
        distance == 0.0 || distance > 1e-3 || best.beyond.as_ref() == Some(*one)
    };
    let before = all[..place].iter().rev().filter(apart).take(BESIDE);
    let mut shown: Vec<&Sample> = before.collect();
    shown.reverse();
    shown.extend(all[place..].iter().filter(apart).take(BESIDE + 1));
    let heads = [format!(">{}", parameter_words(&answer.span.axis.path))].into_iter();
    let goal = answer.goal.as_ref().filter(|goal| !goal.is_parameter);
    let heads = heads.chain(goal.map(|goal| format!(">{}", goal.of)));
    let heads = heads.chain(
        answer
            .conditions
            .iter()
            .map(|one| format!(">{}", one.figure)),
    );
    let heads: Vec<String> = heads.chain(["conditions".to_owned()]).collect();
    let row = |one: &&Sample| {
        let mut cells = vec![Cell::from(parameter(answer, one.value, DIGITS))];
        cells.extend(goal.map(|goal| Cell::from(figure(answer, &goal.of, one.goal))));
        let figures = answer.conditions.iter().zip(&one.figures);
        cells.extend(
            figures.map(|(condition, value)| Cell::from(figure(answer, &condition.figure, *value))),
        );
        cells.push(sample_cell(answer, one));
        cells
    };
    Table::new(heads.iter().map(String::as_str)).rows(shown.iter().map(row))
}

fn sample_cell(answer: &FoundValue, one: &Sample) -> Cell {
    if one.state != State::Computed {
        return Cell::from(state_words(&one.state)).with_outcome(Some(false));
    }
    // Of an equality the ranges know where it is met.
    let within = answer
        .found
        .ranges
        .iter()
        .any(|range| (range.from.sample.share..=range.to.sample.share).contains(&one.share));
    match within {
        true => Cell::from("hold").with_outcome(Some(true)),
        false => Cell::from("do not hold").with_outcome(Some(false)),
    }
}

fn ranges_table(answer: &FoundValue) -> Table {
    let row = |one: &Range| {
        let ends = [&one.from, &one.to];
        let [from, to] = ends.map(|end| Cell::from(parameter(answer, end.sample.value, DIGITS)));
        let [before, after] = ends.map(|end| limit_words(answer, &end.limit));
        let why = match before == after {
            true => before,
            false => format!("{before}; {after}"),
        };
        vec![from, to, Cell::from(why)]
    };
    Table::new([">from", ">to", "~ends"]).rows(answer.found.ranges.iter().map(row))
}

/// The goal and the figures of the conditions over the parameter.
fn charts(answer: &FoundValue) -> Vec<Plot> {
    let mut names: Vec<(&str, &str)> = Vec::new();
    if let Some(goal) = answer.goal.as_ref().filter(|goal| !goal.is_parameter) {
        names.push((&goal.of, &goal.unit));
    }
    for one in &answer.conditions {
        if names.iter().all(|(known, _)| *known != one.figure) {
            names.push((&one.figure, &one.unit));
        }
    }
    names
        .into_iter()
        .map(|(name, unit)| chart(answer, name, unit))
        .collect()
}

/// A relation as it is written by hand.
fn relation_sign(sign: &str) -> String {
    sign.replace(">=", "≥").replace("<=", "≤")
}

fn chart(answer: &FoundValue, name: &str, unit: &str) -> Plot {
    let index = answer.conditions.iter().position(|one| one.figure == name);
    let value = |one: &Sample| match index {
        Some(at) => one.figures[at],
        None => one.goal,
    };
    let samples = &answer.found.samples;
    let points = samples
        .iter()
        .map(|one| (one.value, value(one).unwrap_or(f64::NAN)));
    let ranges = answer.found.ranges.iter();
    let spans = ranges
        .map(|one| [one.from.sample.value, one.to.sample.value])
        .collect();
    let limits = answer.conditions.iter().filter(|one| one.figure == name);
    let limits = limits.map(|one| {
        let limit = figure(answer, name, Some(one.value));
        Rule::level(
            one.value,
            format!("{} {limit}", relation_sign(one.relation.sign())),
        )
    });
    let best = answer.found.best.as_ref().map(|best| {
        let point = (best.sample.value, value(&best.sample).unwrap_or(f64::NAN));
        let mark = Mark::new(Shape::Good, parameter(answer, best.sample.value, DIGITS));
        Series::marked("the answer", vec![point], vec![mark])
    });
    Plot {
        id: name.to_owned(),
        title: capitalised(&result_words(name)),
        x: Axis {
            fixed: true,
            log: answer.span.axis.log,
            ..Axis::new(&parameter_words(&answer.span.axis.path), &answer.unit)
        },
        y: Axis::of(unit),
        series: std::iter::once(Series::line("", points.collect()))
            .chain(best)
            .collect(),
        bands: vec![Band {
            label: "all conditions hold".to_owned(),
            spans,
            series: None,
        }],
        rules: limits.collect(),
        ..Plot::default()
    }
}

/// How far the answer goes.
fn notes(answer: &FoundValue) -> Vec<String> {
    let found = &answer.found;
    let axis = &answer.span.axis;
    let looked = counted(found.samples.len(), "value");
    let mut notes = Vec::new();
    if answer.span.whole {
        notes.push(format!(
            "All {looked} of the {} in the range were examined.",
            parameter_words(&axis.path)
        ));
    } else if found.complete {
        let apart = found.best.as_ref().map_or(0.5, |best| best.sample.share);
        let apart = parameter(answer, answer.span.spacing(apart), 2);
        notes.push(format!(
            "In all {looked} of the {} from {} to {} were examined, {} of them at equal {}. A narrower \
             feature between two of them can be missed. For more places: `--vary \
             {}=FROM:TO:PLACES`.",
            parameter_words(&axis.path),
            parameter(answer, axis.from, DIGITS),
            parameter(answer, axis.to, DIGITS),
            axis.count,
            match axis.log {
                true => "ratios".to_owned(),
                false => format!("distances of {apart}"),
            },
            axis.path
        ));
    }
    if let Some(best) = found.best.as_ref().filter(|best| best.within > 0.0) {
        notes.push(format!(
            "The answer is known to {}.",
            parameter(answer, best.within, 1)
        ));
    }
    let [mut refused, mut stopped, mut unknown] = [0; 3];
    for one in &found.samples {
        match one.state {
            State::Computed => {}
            State::Refused(_) => refused += 1,
            State::Stopped(_) => stopped += 1,
            State::NotTrusted(_) => unknown += 1,
        }
    }
    let unknown_words = "the computation is not to be trusted: nothing is known there";
    let refusal = match nowhere_known(answer).is_empty() {
        true => first_refusal(answer),
        false => "there is no result".to_owned(),
    };
    for (count, words) in [
        (refused, refusal.as_str()),
        (stopped, "the mechanism stops"),
        (unknown, unknown_words),
    ] {
        if count > 0 {
            notes.push(format!("At {} {words}.", counted(count, "value")));
        }
    }
    notes
}
