//! What a study of methods over a parameter found.

use super::charts::{cost, height_of_regions, methods, regions, stable_steps};
use super::study::names_section;
use super::{HEIGHT, TIMING, verdict};
use crate::dynamics::integrate::Method;
use crate::report::addresses::parameter_words;
use crate::report::diagram::Diagram;
use crate::report::findings::{Cell, Findings, Layout, Section, Source, Table};
use crate::report::html::mechanism;
use crate::report::quantity::{significant, with_unit};
use crate::report::verdict::{Sort, Verdict as Answer};
use crate::studies::judgement::Judgement;
use crate::studies::methods::Verdict;
use crate::studies::methods::sweep::{MethodStanding, Slice, Sweep};

/// Where methods fail over the parameter, what they cost, and their causes.
pub fn sweep_findings<'a>(
    scene: &str,
    sweep: &Sweep,
    diagram: &'a Diagram,
    source: Source<'a>,
) -> Findings<'a> {
    let axis = &sweep.axis;
    let wide = |heading: &str, height, chart| {
        Section::new(heading).charts(Layout::Wide(height), "", vec![chart])
    };
    let fails = wide(
        "Where methods fail",
        height_of_regions(sweep),
        regions(sweep),
    );
    let cost = cost(sweep).map(|chart| wide("Cost", HEIGHT, chart).legend(TIMING));
    let stable = stable_steps(sweep).map(|chart| wide("Stable steps", 420.0, chart));
    let mut sections = vec![fails];
    sections.extend(cost);
    sections.extend(stable);
    sections.extend([
        names_section(methods(sweep).into_iter()),
        standings_section(sweep),
        causes_section(sweep),
        Section::default().drawing(|plots| mechanism(diagram, plots)),
    ]);
    Findings {
        title: scene.to_owned(),
        subtitle: format!(
            "methods over {} from {} to {}, {} values",
            parameter_words(&axis.path),
            value(sweep, axis.from),
            value(sweep, axis.to),
            sweep.slices.len()
        ),
        answer: Some(answer(sweep)),
        warnings: warnings(sweep),
        sections,
        source,
    }
}

/// The values at which the reference is in doubt.
fn warnings(sweep: &Sweep) -> Vec<String> {
    let doubts = sweep.slices.iter();
    let doubts = doubts.filter_map(|slice| Some((slice.x, slice.study.doubt.as_ref()?)));
    doubts
        .map(|(x, doubt)| {
            format!(
                "At {}: {}.",
                sweep.axis.value_with_unit(x),
                doubt.sentence()
            )
        })
        .collect()
}

/// The methods that are accurate everywhere.
fn answer(sweep: &Sweep) -> Answer {
    let good = |slice: &Slice, method: Method| {
        let standing = slice.standing(method);
        standing.is_some_and(|standing| standing.verdict == Verdict::Converged)
    };
    let everywhere = methods(sweep).into_iter();
    let everywhere: Vec<&str> = everywhere
        .filter(|&method| sweep.slices.iter().all(|slice| good(slice, method)))
        .map(Method::name)
        .collect();
    let interrupted = match sweep.complete {
        true => "",
        false => " INTERRUPTED: values that were not reached are missing.",
    };
    let count = sweep.slices.len();
    let (sort, headline, text) = match everywhere.len() {
        0 => (
            Sort::Numerical,
            "No method is accurate at every value.".to_owned(),
            "The table of values says where each of them fails.".to_owned(),
        ),
        number => (
            Sort::Recommended,
            match number {
                1 => "One method is accurate everywhere.".to_owned(),
                _ => format!("{number} of the methods are accurate everywhere."),
            },
            format!("At all {count} values: {}.", everywhere.join(", ")),
        ),
    };
    let (sort, judged) = match sweep.verdict {
        Judgement::NotToBeTrusted => (Sort::Numerical, ""),
        Judgement::NotJudged | Judgement::InWorkingOrder | Judgement::NotInWorkingOrder => {
            (sort, " The mechanism is not judged.")
        }
    };
    Answer {
        judgement: Some(sweep.verdict),
        ..Answer::answer(sort, headline, text + judged + interrupted)
    }
}

/// A value of the axis for reading.
fn value(sweep: &Sweep, x: f64) -> String {
    let text = format!("{} {}", significant(x, 6), sweep.axis.unit);
    text.trim_end().to_owned()
}

/// One row a value, one column a method.
fn standings_section(sweep: &Sweep) -> Section<'static> {
    let methods = methods(sweep);
    let cell = |standing: Option<MethodStanding>| match standing {
        None => "–".into(),
        Some(standing) => {
            let time = standing.measured_seconds;
            verdict(
                standing.verdict,
                time.map_or("–".to_owned(), |time| with_unit(time, "s", 3)),
            )
        }
    };
    let row = |slice: &Slice| {
        let cells = methods.iter().map(|&method| cell(slice.standing(method)));
        std::iter::once(value(sweep, slice.x).into())
            .chain(cells)
            .collect::<Vec<_>>()
    };
    let accuracy = sweep.slices.first().map_or(0.0, |s| s.study.accuracy);
    let fixed = sweep.fixed_step.map_or(String::new(), |step| {
        format!(" (methods of fixed step: at {})", with_unit(step, "s", 3))
    });
    let heads = methods.iter().map(|method| method.name());
    let parameter = parameter_words(&sweep.axis.path);
    let table = Table::new(std::iter::once(parameter.as_str()).chain(heads));
    Section::new("Values")
        .with_paragraph(format!(
            "The verdict at the required tolerance{fixed}, and the least time to an error of δ \
             within {} of max|δ|.",
            significant(accuracy, 1)
        ))
        .table(table.rows(sweep.slices.iter().map(row)))
}

/// Cause of every verdict, and the greatest stable steps.
fn causes_section(sweep: &Sweep) -> Section<'static> {
    let mut rows = Vec::new();
    for method in methods(sweep) {
        for slice in &sweep.slices {
            let Some(standing) = slice.standing(method) else {
                continue;
            };
            rows.push(vec![
                method.name().into(),
                value(sweep, slice.x).into(),
                Cell::known_number(standing.measured_seconds, "s", 3),
                Cell::known_number(standing.stable_step, "s", 3),
                Cell::known_number(standing.stable_step_by_theory, "s", 3),
                verdict(standing.verdict, standing.cause),
            ]);
        }
    }
    let parameter = format!(">{}", parameter_words(&sweep.axis.path));
    let heads = [
        "method",
        &parameter,
        ">time",
        ">stable step",
        ">in theory",
        "~verdict",
    ];
    Section::new("Causes").table(Table::new(heads).rows(rows))
}
