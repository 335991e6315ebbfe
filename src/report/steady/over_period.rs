//! What happens over a period of the motion of elastic objects.

use crate::report::findings::{Cell, Figure, Item, Section, Table, Value};
use crate::report::quantity::{significant, with_unit};
use crate::studies::steady::{DriveWork, Event, Extremes, OverPeriod, PeriodicAnswer};

/// Up to this many events are listed openly; more are folded away.
const OPEN_LIST: usize = 24;

/// Most events that a page lists.
const MOST_LISTED: usize = 1000;

/// Digits of figures.
const DIGITS: usize = 7;

/// Works, extremes, events and checks.
pub(super) fn sections<'a>(answer: &PeriodicAnswer) -> Vec<Section<'a>> {
    let heading = "Over a period";
    let Some(found) = &answer.over_period else {
        let missing = answer.over_period_missing.as_deref();
        let words = |why| format!("Works, extremes and events are not known: {why}.");
        let section = |why| Section::new(heading).with_paragraph(words(why));
        let sections = missing.map(section).into_iter();
        return sections.chain([checks_section(answer)]).collect();
    };
    let mut sections = vec![
        Section::new(heading).figures(work_figures(found)),
        Section::new("Work of each drive over a period").table(drives_table(&found.drives)),
        Section::new("Extremes over a period").table(extremes_table(&found.objects)),
    ];
    sections.push(events_section(&found.events));
    sections.push(checks_section(answer));
    sections
}

fn checks_section<'a>(answer: &PeriodicAnswer) -> Section<'a> {
    let checks = answer.checks();
    Section::new("Checks").figures(checks.iter().map(Figure::check).collect())
}

fn work_figures(found: &OverPeriod) -> Vec<Figure> {
    let work = |name: &str, value: f64| Figure::number(name, value, "J", DIGITS);
    vec![
        Figure::number("period", found.period, "s", DIGITS),
        work("work of prescribed drives", found.works.drives),
        work("work of loads, motors among them", found.works.loads),
        work(
            "lost in links, contacts and dampers",
            found.works.dissipated,
        ),
        work("lost in impacts", found.works.impacts),
        Figure::new("integrated by", found.method.name()),
    ]
}

fn drives_table(drives: &[DriveWork]) -> Table {
    let row = |own: &DriveWork| {
        vec![
            Cell::object(&own.id),
            Value::new(own.work, "J", DIGITS).into(),
            Value::new(own.mean_power, "W", DIGITS).into(),
        ]
    };
    Table::new(["drive", ">work", ">mean power"]).rows(drives.iter().map(row))
}

fn extremes_table(objects: &[Extremes]) -> Table {
    let row = |own: &Extremes| {
        let force = own.max_contact_force;
        let force = force.map(|force| Value::new(force, own.force_unit, DIGITS).into());
        vec![
            Cell::object(&own.id),
            Value::new(own.delta_max, own.unit, DIGITS).into(),
            Value::new(own.delta_min, own.unit, DIGITS).into(),
            Value::new(own.peak_speed, &format!("{}/s", own.unit), DIGITS).into(),
            Value::new(own.peak_reaction, own.force_unit, DIGITS).into(),
            force.unwrap_or_else(|| Cell::from("")),
        ]
    };
    let heads = [
        "object",
        ">greatest δ",
        ">least δ",
        ">peak speed",
        ">peak reaction",
        ">greatest contact force (along the follower)",
    ];
    Table::new(heads).rows(objects.iter().map(row))
}

fn events_section<'a>(events: &[Event]) -> Section<'a> {
    let section = Section::new("Events over a period");
    if events.is_empty() {
        return section.with_paragraph("No separation, closure or impact over the period.");
    }
    let row = |event: &Event| {
        vec![
            Cell::from(significant(event.time, 12)),
            Cell::object(&event.object),
            event.what.into(),
            event.flank.into(),
            Value::new(event.speed, event.unit, DIGITS).into(),
        ]
    };
    let heads = [
        ">time in the period, s",
        "object",
        "event",
        "flank",
        ">speed of approach or parting",
    ];
    let listed = &events[..events.len().min(MOST_LISTED)];
    let table = Table::new(heads).rows(listed.iter().map(row));
    if events.len() <= OPEN_LIST {
        return section.table(table);
    }
    let count = events.len();
    let summary = match count <= MOST_LISTED {
        true => format!("{count} events"),
        false => format!(
            "the first {MOST_LISTED} of {count} events, up to {}; all of them are in steady.json",
            with_unit(listed.last().map_or(0.0, |last| last.time), "s", 6)
        ),
    };
    section.item(Item::Folded(summary, table))
}
