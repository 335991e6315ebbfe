//! What a run found: figures, what they are worth, the machine moving, the motion of every
//! object, switches, and how the run went.

mod tables;
#[cfg(test)]
mod tests;

use super::abscissa::Abscissa;
use super::accuracy;
use super::diagram::{Diagram, ObjectBox};
use super::findings::{Cell, Findings, Item, Section, Source, Table, Value};
use super::html::{mechanism, runs};
use super::machine::Machine;
use super::quantity::{significant, units, with_unit};
use super::sentence::Sentence;
use super::thinned::record_to_draw;
use super::verdict::run_answer;
use crate::dynamics::record::{Figures, Record};
use crate::studies::order::Certificate;
use crate::studies::spread::{FigureSpread, Spread};
use runs::RunSeries;
use std::rc::Rc;

/// Everything that is told of one run.
#[derive(Clone, Copy, Debug)]
pub struct RunReport<'a> {
    /// Figures, run statistics, warnings.
    pub figures: &'a Figures,
    /// Samples, switches, open intervals.
    pub record: &'a Record,
    /// The object graph.
    pub diagram: &'a Diagram,
    /// Machine that is drawn moving; `None`: nothing is.
    pub machine: Option<Machine<'a>>,
    /// What the figures are worth, where that was judged.
    pub certificate: Option<&'a Certificate>,
    /// How far the figures move under a tiny change, where that was asked.
    pub spread: Option<&'a Spread>,
    /// What the charts are drawn over.
    pub over: &'a Abscissa,
}

/// The findings of one run.
pub fn findings<'a>(report: &RunReport<'a>, source: Source<'a>) -> Findings<'a> {
    let RunReport {
        figures,
        diagram,
        machine,
        ..
    } = *report;
    let drawn = record_to_draw(report.record);
    let record = Rc::new(drawn.record);
    let samples = [report.record, &*record].map(|one| one.times.len() + one.closeups.times.len());
    let mut sections = vec![Section::default().drawing(|plots| mechanism(diagram, plots))];
    if let Some(machine) = machine {
        let record = Rc::clone(&record);
        let moving = move |plots: &mut _| machine.section(figures, &record, plots);
        sections.push(Section::default().drawing(moving));
    }
    sections.extend(objects(figures, samples));
    let left_out = omission_notes(report.record, drawn.left_out);
    sections.push(Section::default().legend(left_out.join(" ")));
    if let Some(certificate) = report.certificate {
        sections.extend(accuracy::sections(certificate));
        sections.push(accuracy::chart_section(certificate));
    }
    sections.extend(report.spread.map(|one| spread_section(one, figures)));
    let boxes = diagram.boxes.iter();
    let over = report.over;
    sections.extend(boxes.map(|one| object_section(one, Rc::clone(&record), over)));
    sections.push(switches_section(report.record, figures));
    sections.push(Section::new("Run").figures(tables::statistics(figures)));
    sections.retain(has_rows);
    let count = figures.objects.len();
    Findings {
        title: figures.scene.clone(),
        subtitle: format!(
            "{} of motion, {count} {}, method {}",
            with_unit(figures.run.time, "s", 6),
            if count == 1 { "object" } else { "objects" },
            figures.run.method
        ),
        answer: Some(run_answer(figures, result(figures, diagram))),
        warnings: figures.warnings.clone(),
        sections,
        source,
    }
}

/// Digits of the results of an answer.
const ANSWER: usize = 4;

/// What the run found of the object that is driven last: its deflection, of a rigid one its speed
/// and its reaction; of a drive alone its speed.
fn result(figures: &Figures, diagram: &Diagram) -> Option<Sentence> {
    let known = |one: &&ObjectBox| figures.objects.contains_key(&one.id);
    let boxes = || diagram.boxes.iter().rev().filter(known);
    let driven = || boxes().filter(|one| !one.is_drive());
    let of = |one: &ObjectBox| &figures.objects[&one.id];
    let units = |one: &ObjectBox| units(figures, &one.id);
    if let Some(one) = driven().find(|one| of(one).delta_abs > 0.0) {
        let said = Sentence::from(format!("Greatest |δ| of {}: ", one.id));
        let said = said.quantity(of(one).delta_abs, units(one).displacement, ANSWER);
        return Some(said.words("."));
    }
    let one = driven().next().or_else(|| boxes().next())?;
    let said = Sentence::from(format!("Peak speed of {}: ", one.id));
    let said = said.quantity(of(one).peak_speed, &tables::speed(units(one)), ANSWER);
    let said = match of(one).peak_reaction > 0.0 {
        true => {
            let force = of(one).peak_reaction;
            said.words(", peak reaction: ")
                .quantity(force, units(one).force, ANSWER)
        }
        false => said,
    };
    Some(said.words("."))
}

/// What the charts of a page leave out, in sentences.
fn omission_notes(record: &Record, columns: usize) -> Vec<String> {
    let mut notes = Vec::new();
    let every = record.closeups.every;
    if every > 1 {
        notes.push(format!(
            "The charts show the motion in detail after one switch in {every}. Elsewhere they join \
             the samples of record.csv."
        ));
    }
    if columns > 0 {
        notes.push(format!(
            "{columns} columns of the record have no chart on this page. All of them are in \
             record.csv."
        ));
    }
    notes
}

/// The figures of all objects, of their pairs, stops and joints; `samples`: of the record, and of them
/// those that the plots join.
pub(in crate::report) fn objects<'a>(
    figures: &Figures,
    [samples, joined]: [usize; 2],
) -> Vec<Section<'a>> {
    let plots = match joined == samples {
        true => String::from("that the plots join."),
        false => format!(
            "of which the plots join {joined}, of every stretch the least and the greatest."
        ),
    };
    let mut sections = vec![
        Section::new("Results")
            .table(tables::figures_table(figures))
            .legend(format!(
                "Peaks and extremes also cover what lies between the {samples} samples {plots}"
            )),
        Section::new("Driving pairs")
            .table(tables::pairs_table(figures))
            .legend(window(figures)),
        Section::new("Stops").table(tables::stops_table(figures)),
        Section::new("Impacts").table(tables::impacts_table(figures)),
        Section::new("Contact pressure").table(tables::contact_pressure_table(figures)),
        Section::new("Friction").table(tables::joints_table(figures)),
    ];
    sections.retain(has_rows);
    sections
}

/// False of a section that begins with an empty table, or has nothing.
fn has_rows(section: &Section<'_>) -> bool {
    match &section.items[..] {
        [Item::Table(table), ..] => !table.rows.is_empty(),
        _ => !section.is_empty(),
    }
}

/// The motion of an object.
fn object_section<'a>(one: &'a ObjectBox, record: Rc<Record>, over: &'a Abscissa) -> Section<'a> {
    Section::default().drawing(move |plots| {
        let kind = format!("{}, {}", one.kind.replace('_', " "), one.detail);
        let series = [RunSeries {
            label: String::new(),
            record: &record,
            over,
        }];
        runs::section(plots, &series, &one.id, &kind)
    })
}

/// What figures of pairs are taken over.
fn window(figures: &Figures) -> String {
    let run = &figures.run;
    let judged = match (run.window, &run.window_missing) {
        (Some([from, to]), _) => format!(
            "; whether a contact is in working order over the steady window from {} to {}",
            with_unit(from, "s", 6),
            with_unit(to, "s", 6)
        ),
        (None, Some(reason)) => format!(". No steady window: {reason}"),
        (None, None) => String::new(),
    };
    format!("Results are taken over the whole run{judged}.")
}

/// SI unit of a result of a run; empty of a count.
fn unit_of(address: &str, figures: &Figures) -> String {
    let owner = |id: &&String| {
        let name = address.strip_prefix(id.as_str());
        name.is_some_and(|name| name.starts_with('.'))
    };
    let id = figures
        .objects
        .keys()
        .filter(owner)
        .max_by_key(|id| id.len());
    let units = units(figures, id.map_or("", String::as_str));
    let name = address.rsplit('.').next().unwrap_or_default();
    match name {
        "time" | "separated_time" | "longest_separation" | "contact_time" => "s".to_owned(),
        _ if id.is_none() => String::new(),
        "delta_abs" | "delta_max" | "delta_min" | "sigma" | "displacement" | "max_lift"
        | "max_indentation" => units.displacement.to_owned(),
        "speed" | "peak_speed" | "max_approach_speed" => tables::speed(units),
        "peak_acceleration" => format!("{}/s²", units.displacement),
        "peak_reaction" | "max_contact_force" | "margin" => units.force.to_owned(),
        _ => String::new(),
    }
}

/// How far figures move under a tiny change.
fn spread_section<'a>(spread: &Spread, figures: &Figures) -> Section<'a> {
    let moved = |by: Option<f64>, unit: &str| match by {
        None => Cell::from("gone"),
        Some(_) => Cell::known_number(by, unit, 2),
    };
    let row = |figure: &FigureSpread| {
        let unit = unit_of(&figure.figure, figures);
        let mark = if figure.determined {
            "determined"
        } else {
            "not determined"
        };
        vec![
            Cell::result(&figure.figure),
            Value::new(figure.value, &unit, 7).into(),
            moved(figure.by_loads, &unit),
            moved(figure.by_tolerance, &unit),
            Cell::from(mark).with_outcome((!figure.determined).then_some(false)),
        ]
    };
    let heads = [
        "result",
        ">value",
        ">changed by loads",
        ">changed by tolerance",
        "~verdict",
    ];
    Section::new("Spread")
        .with_paragraph(format!(
            "How far each result changes if loads and gaps change by a share of {}, and if the \
             tolerance is multiplied by {}.",
            significant(spread.change, 7),
            spread.tolerance_factor
        ))
        .table(Table::new(heads).rows(spread.figures.iter().map(row)))
}

/// Every switch of every pair as CSV.
pub fn switches_csv(record: &Record, figures: &Figures) -> String {
    super::csv::switches_csv(record, |object| tables::speed(units(figures, object)))
}

/// Up to this many switches are listed openly; more are folded away.
const OPEN_LIST: usize = 12;

/// Most switches that a page lists.
const MOST_LISTED: usize = 1000;

/// Switches in order of time, on a page.
fn switches_section<'a>(record: &Record, figures: &Figures) -> Section<'a> {
    let section = Section::new("Events");
    let count = record.switches.len();
    let listed = &record.switches[..count.min(MOST_LISTED)];
    let (Some(first), Some(last)) = (listed.first(), listed.last()) else {
        return section.legend("No contact separates or closes during the run.");
    };
    let table = tables::switches_table(listed, figures);
    if count <= OPEN_LIST {
        return section.item(Item::Table(table));
    }
    let span = format!(
        "between {} and {}",
        with_unit(first.time, "s", 6),
        with_unit(last.time, "s", 6)
    );
    let summary = match count <= MOST_LISTED {
        true => format!("{count} events {span}"),
        false => format!(
            "the first {MOST_LISTED} of {count} events, {span}; all of them are in switches.csv"
        ),
    };
    section.item(Item::Folded(summary, table))
}
