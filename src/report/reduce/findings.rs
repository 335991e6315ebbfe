//! What looking for the smallest scene found, as data.

use super::chart::chart;
use super::{answer, counted, greatest, refusal_in_words};
use crate::frontend::scene::in_words;
use crate::report::accuracy;
use crate::report::diagram::Diagram;
use crate::report::findings::{Cell, Findings, Layout, Section, Source, Table, Value};
use crate::report::html::mechanism;
use crate::report::verdict::{Sort, Verdict};
use crate::studies::reduce::{Reduction, Role, Step};

/// The answer, the figures, what is left out and why the rest stays, error against cost.
pub fn findings<'a>(
    reduction: &Reduction,
    diagram: &'a Diagram,
    source: Source<'a>,
) -> Findings<'a> {
    let sort = match (reduction.holds(), reduction.complete) {
        (true, true) => Sort::Good,
        (true, false) => Sort::Unfinished,
        (false, _) => Sort::Numerical,
    };
    let more = match reduction.complete {
        true => "",
        false => "Ended before everything was tried.",
    };
    // The first sentence is the result.
    let said = answer(reduction);
    let (headline, rest) = match said.split_once(". ") {
        Some((first, rest)) => (format!("{first}."), rest),
        None => (said.clone(), ""),
    };
    let mut sections = accuracy::sections(&reduction.certificate);
    sections.extend([
        Section::new("Parts that the scene does not need").table(steps_table(reduction)),
        Section::new("Size").table(sizes_table(reduction)),
    ]);
    if let Some(chart) = chart(reduction) {
        let charts = Section::new("Error against cost");
        sections.push(charts.charts(Layout::Wide(420.0), "", vec![chart]).legend(
            "Every mark is a model that was run: filled the reduced scene, a cross the scene as \
             given. Times are of single runs; those of the table are the least of several.",
        ));
    }
    sections.push(Section::default().drawing(|plots| mechanism(diagram, plots)));
    sections.retain(|section| !section.is_empty());
    Findings {
        title: reduction.scene.clone(),
        subtitle: format!(
            "smallest scene, {} run",
            counted(reduction.models.len(), "model")
        ),
        answer: Some(Verdict::answer(
            sort,
            headline,
            format!("{rest} {more}").trim(),
        )),
        warnings: Vec::new(),
        sections,
        source,
    }
}

fn steps_table(reduction: &Reduction) -> Table {
    let row = |step: &Step| {
        let (left_out, says) = match &step.refused {
            None => (true, greatest(reduction, step)),
            Some(refused) => (false, refusal_in_words(reduction, refused)),
        };
        let verdict = Cell {
            good: Some(left_out),
            ..Cell::from(if left_out { "left out" } else { "kept" })
        };
        vec![
            step.removal.object.as_str().into(),
            step.removal.part.to_string().into(),
            verdict,
            says.into(),
        ]
    };
    let steps = reduction.removed().chain(reduction.refused_steps());
    Table::new(["object", "made simpler", "verdict", "~because it"]).rows(steps.map(row))
}

/// The scene as given beside the reduced one.
fn sizes_table(reduction: &Reduction) -> Table {
    let roles = [(Role::Given, "as given"), (Role::Reduced, "reduced")];
    let row = |(role, name): (Role, &str)| {
        let model = reduction.model(role)?;
        // Measured again where both differ; else of the one run.
        let seconds = match (&reduction.cost, role) {
            (Some(cost), Role::Given) => cost.given.least,
            (Some(cost), Role::Reduced) => cost.reduced.least,
            (None, _) | (Some(_), Role::Tried) => model.seconds,
        };
        Some(vec![
            Cell::from(name),
            in_words(&model.levels).into(),
            Value::new(model.coordinates as f64, "", 6).into(),
            Value::new(seconds, "s", 2).into(),
        ])
    };
    let heads = ["scene", "elastic objects", ">coordinates", ">time of a run"];
    Table::new(heads).rows(roles.into_iter().filter_map(row))
}
