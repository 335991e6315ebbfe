//! What the studio shows of a run and of a map: the tables, charts and drawings of the pages,
//! taken apart so that what moves is sent alone.
//!
//! The program draws a chart once. As long as charts differ in numbers alone, only the columns
//! go to the window, as bytes; `plot.js` and `player.js`, the scripts of the pages, draw them
//! anew (`live.update`, `machine.player`).

pub(crate) use super::course::samples;

use super::abscissa::Abscissa;
pub(crate) use super::addresses::property_words;
use super::compare;
use super::diagram::Diagram;
use super::findings::{Findings, Layout, Section, WIDE};
use super::html::runs::{ObjectCharts, RunSeries};
use super::html::{STYLE, verdict_banner, warnings};
use super::machine::{Machine, Room};
use super::map::picture;
use super::mechanism;
use super::plot::{Axis, Plot, Plots, Series, page, palette};
use super::quantity::with_unit;
use super::show::{equations, masses, masses::Frequencies};
use super::svg::graph;
use super::verdict::{Verdict, verdict};
use super::{accuracy, cam};
use crate::dynamics::model::Model;
use crate::dynamics::record::{Column, Figures, Record};
use crate::dynamics::system::{Regime, System};
use crate::kinematics::cam::DiscCam;
use crate::studies::compare::FigureTable;
use crate::studies::map::{MapResult, Study};
use crate::studies::order::Certificate;
use crate::studies::run::RunResult;
use serde_json::{Value, json};
use std::collections::BTreeMap;

/// The scripts of charts and of what moves.
pub(crate) const PLOT_SCRIPT: &str = page::SCRIPT;
pub(crate) const PLAYER_SCRIPT: &str = super::html::PLAYER;

/// Number of the first chart of a map: those of a run have the ones before.
const OF_MAP: usize = 10_000;
/// Number of the first chart of what a question found.
const OF_QUESTION: usize = 20_000;

/// Objects of which charts are drawn, and objects of a machine that is drawn moving: a page with
/// more of them is too slow to work with.
const CHARTED: usize = 40;
const MOVED: usize = 100;

/// The style of charts, tables and drawings, with all colours.
pub(crate) fn style() -> String {
    [
        &palette::of_page(),
        palette::STYLE,
        STYLE,
        mechanism::STYLE,
        cam::style(),
        graph::STYLE,
    ]
    .concat()
}

/// A run as the studio shows it.
#[derive(Debug)]
pub(crate) struct LiveRun {
    /// The answer in a sentence.
    pub(crate) verdict: Verdict,
    /// The tables of figures.
    pub(crate) tables: String,
    /// The figures beside those of pinned runs.
    pub(crate) compared: String,
    /// The charts, with the numbers that they show.
    pub(crate) charts: Charts,
    /// What moves, for the player; null: nothing does.
    pub(crate) moving: Value,
    /// The columns of the charts that the player reads.
    pub(crate) moves: Vec<usize>,
    /// The pictures that it moves in.
    pub(crate) pictures: String,
}

/// Charts, as pictures and as numbers.
#[derive(Clone, Debug, Default)]
pub(crate) struct Charts {
    /// The sections with the charts drawn.
    pub(crate) html: String,
    /// What they show besides numbers: where it is the same, the pictures are too.
    pub(crate) likeness: String,
    /// The numbers.
    pub(crate) plots: Plots,
}

/// What is shown beside a run.
#[derive(Clone, Debug, Default)]
pub(crate) struct RunExtras<'a> {
    /// Earlier runs, by names.
    pub(crate) pins: Vec<(&'a str, &'a RunResult)>,
    /// A signal over another: horizontal and vertical axis, as columns of the record by name.
    pub(crate) over: Option<&'a [String; 2]>,
}

/// Name of the present run among others.
const NOW: &str = "now";

/// A run with its charts; those drawn `before` are taken where they differ in numbers alone.
pub(crate) fn run(
    model: &Model,
    cams: &[(String, DiscCam)],
    (figures, record): (&Figures, &Record),
    beside: &RunExtras<'_>,
    before: &Charts,
) -> LiveRun {
    let merged = record.with_closeups();
    let label = if beside.pins.is_empty() { "" } else { NOW };
    let pinned = beside.pins.iter();
    let pinned = pinned.map(|&(name, result)| (name, &result.record));
    let series: Vec<RunSeries<'_>> = std::iter::once((label, &merged))
        .chain(pinned)
        .map(|(label, record)| RunSeries {
            label: label.to_owned(),
            record,
            over: &Abscissa::Time,
        })
        .collect();
    let over = beside
        .over
        .and_then(|signals| signal_over_signal(&series, signals));
    let boxes = Diagram::of(model).boxes;
    let shown = boxes.iter().take(CHARTED).filter_map(|one| {
        let kind = format!("{}, {}", one.kind.replace('_', " "), one.detail);
        ObjectCharts::of(&series, &one.id, &kind)
    });
    let mut charts = charts(&shown.collect::<Vec<_>>(), over, before);
    let machine = Machine { model, cams };
    let moving = match boxes.len() <= MOVED {
        true => machine.moving(figures, &merged, &mut charts.plots, Room::Canvas),
        false => None,
    };
    let tables = super::run::objects(figures, [merged.times.len(); 2]);
    let tables = tables.iter().map(|section| section.html(&mut charts.plots));
    let mut tables: String = tables.collect();
    if boxes.len() > CHARTED {
        tables.push_str(&format!(
            "<p class=\"soft\">Charts of the first {CHARTED} of {} objects follow. The report has those of \
             all.</p>",
            boxes.len()
        ));
    }
    let compared = compared(figures, beside);
    let compared = compared
        .iter()
        .map(|section| section.html(&mut charts.plots));
    let compared = compared.collect();
    let (moving, moves, pictures) = match moving {
        // Plain numbers, strings and lists: writing them cannot fail.
        Some(moving) => (
            serde_json::to_value(&moving.player).unwrap_or_default(),
            moving.player.plotted(),
            moving.pictures,
        ),
        None => (Value::Null, Vec::new(), String::new()),
    };
    LiveRun {
        verdict: verdict(figures),
        tables,
        compared,
        charts,
        moving,
        moves,
        pictures,
    }
}

/// The machine of a run alone: what moves, its pictures, and the columns that it moves by; `None`:
/// nothing of it can be drawn.
pub(crate) fn moving(
    model: &Model,
    cams: &[(String, DiscCam)],
    (figures, record): (&Figures, &Record),
) -> Option<Value> {
    let mut plots = Plots::live(0);
    let moving =
        Machine { model, cams }.moving(figures, &record.with_closeups(), &mut plots, Room::Page)?;
    let (columns, _) = plots.columns_and_charts();
    Some(json!({ "moving": moving.player, "pictures": moving.pictures, "columns": columns }))
}

/// The columns that a chart shows.
pub(crate) fn columns_of(plot: &Value) -> Vec<usize> {
    let series = plot["series"].as_array().into_iter().flatten();
    let ends = series.flat_map(|one| [&one["x"], &one["y"]]);
    let numbers = ends.filter_map(Value::as_u64);
    numbers
        .filter_map(|one| usize::try_from(one).ok())
        .collect()
}

/// The linkages as they are drawn by hand, those of several inputs about where `at` has them.
pub(crate) fn sketches(system: &System, at: &BTreeMap<String, Vec<f64>>) -> Value {
    mechanism::sketch::sketches(system.model(), at)
}

/// What the figures are worth, and the levels of the objects with why.
pub(crate) fn accuracy(certificate: &Certificate) -> String {
    let mut plots = Plots::live(0);
    let sections = accuracy::sections(certificate);
    let sections = sections.iter().map(|section| section.html(&mut plots));
    sections.collect()
}

/// The dynamic model, and the equations, as parts of a page.
pub(crate) fn model_and_equations(system: &System) -> [String; 2] {
    let model = system.model();
    let frequencies = Frequencies {
        engaged: system.natural_frequencies(Regime::Engaged),
        open: system.natural_frequencies(Regime::Open),
    };
    [
        super::svg::masses::svg(model) + &masses::html(model, &frequencies),
        equations::mathml(&equations::equations(model)),
    ]
}

/// The figures of runs side by side, those of the present one first; differences are from the one
/// that was pinned first.
fn compared<'a>(figures: &Figures, beside: &RunExtras<'_>) -> Vec<Section<'a>> {
    let Some((first, _)) = beside.pins.first() else {
        return Vec::new();
    };
    let pinned = beside.pins.iter().rev();
    let pinned = pinned.map(|&(name, result)| (name, &result.figures));
    let runs: Vec<(&str, &Figures)> = std::iter::once((NOW, figures)).chain(pinned).collect();
    let table = FigureTable::of("pinned runs", &runs);
    let words = format!("In per cent: by how much each result differs from that of “{first}”.");
    let head = Section::new("Beside pinned runs").with_paragraph(words);
    let ids = figures.objects.keys().map(String::as_str);
    let sections = ids
        .chain(["run"])
        .map(|id| compare::figures_section(&table, id));
    let sections = std::iter::once(head).chain(sections);
    sections.filter(|section| !section.is_empty()).collect()
}

/// The names of the columns of a record, each with its unit.
pub(crate) fn signal_names(record: &Record) -> Vec<[String; 2]> {
    let columns = record.columns.iter();
    let columns = columns.map(|one| [column_name(one), one.unit.to_owned()]);
    std::iter::once([TIME.to_owned(), "s".to_owned()])
        .chain(columns)
        .collect()
}

/// Stands for the instants of a record among its columns.
const TIME: &str = "t";

fn column_name(column: &Column) -> String {
    format!("{}.{}", column.object, column.quantity.name())
}

/// A signal over another, a curve a run; `None` where no run has both.
fn signal_over_signal(runs: &[RunSeries<'_>], [x, y]: &[String; 2]) -> Option<Plot> {
    let signal = |record: &'_ Record, name: &str| match name {
        TIME => Some((record.times.clone(), "s")),
        name => {
            let column = record.columns.iter().find(|one| column_name(one) == name)?;
            Some((column.values.clone(), column.unit))
        }
    };
    let mut units = None;
    let mut series = Vec::new();
    for (index, run) in runs.iter().enumerate() {
        let found = signal(run.record, x).zip(signal(run.record, y));
        let Some(((xs, x_unit), (ys, y_unit))) = found else {
            continue;
        };
        units.get_or_insert((x_unit, y_unit));
        series.push(Series {
            style: Some(index),
            ..Series::line(&run.label, xs.into_iter().zip(ys).collect())
        });
    }
    let (x_unit, y_unit) = units?;
    Some(Plot {
        id: "over".to_owned(),
        title: format!("{y} over {x}"),
        x: Axis::new(x, x_unit),
        y: Axis::of(y_unit),
        series,
        start: x != TIME,
        ..Plot::default()
    })
}

/// Height of the chart of a signal over another (pixels), and its link.
const OVER: (f64, &str) = (420.0, "over");

fn charts(shown: &[ObjectCharts], over: Option<Plot>, before: &Charts) -> Charts {
    let mut plots = Plots::live(0);
    let first = over.iter().map(|plot| {
        let labels: Vec<&str> = plot.series.iter().map(|one| one.label.as_str()).collect();
        format!("{} {labels:?}", plot.title)
    });
    let likeness: String = first
        .chain(shown.iter().map(ObjectCharts::text_without_numbers))
        .collect();
    if likeness == before.likeness {
        if let Some(plot) = &over {
            plots.chart_of_known_picture(plot, [WIDE, OVER.0], OVER.1);
        }
        for one in shown {
            for chart in &one.charts {
                plots.chart_of_known_picture(chart, one.chart_size(), &one.link());
            }
        }
        return Charts {
            html: before.html.clone(),
            likeness,
            plots,
        };
    }
    let first = over.map(|plot| {
        Section::new("One signal over another")
            .charts(Layout::Wide(OVER.0), OVER.1, vec![plot])
            .html(&mut plots)
    });
    let html = shown.iter().map(|one| one.html(&mut plots));
    Charts {
        html: first.into_iter().chain(html.collect::<Vec<_>>()).collect(),
        likeness,
        plots,
    }
}

/// A map as the studio shows it: its picture, the numbers behind it, and what is said of each
/// cell, row by row from the lowest.
pub(crate) fn map(study: &Study<'_>, result: &MapResult) -> (String, Plots, Vec<String>) {
    let mut plots = Plots::live(OF_MAP);
    let picture = picture::interactive_map(study, result, &mut plots);
    let cells = result.panels.first().into_iter().flatten();
    let note = |cell: &Option<crate::studies::map::Cell>| match cell {
        None => String::new(),
        Some(cell) => {
            let value = cell.value.map(|value| with_unit(value, &study.unit, 6));
            let cause = match cell.cause.is_empty() {
                true => cell.verdict.words().to_owned(),
                false => format!("{}: {}", cell.verdict.words(), cell.cause),
            };
            value
                .into_iter()
                .chain([cause])
                .collect::<Vec<_>>()
                .join("; ")
        }
    };
    let notes = cells.map(note).collect();
    (picture, plots, notes)
}

/// The charts of a map by their number.
pub(crate) fn described_map(plots: &Plots) -> Value {
    describe_plots(plots, OF_MAP)
}

fn describe_plots(plots: &Plots, first: usize) -> Value {
    let all = plots.columns_and_charts().1.iter().enumerate();
    let all = all.map(|(index, plot)| ((first + index).to_string(), plot.clone()));
    Value::Object(all.collect())
}

/// What a study found, as the studio shows it: sentence, warnings, sections, and the charts with
/// their numbers.
pub(crate) fn findings(found: &Findings<'_>) -> Value {
    let mut plots = Plots::live(OF_QUESTION);
    let sections = found.sections.iter();
    let sections = sections.filter(|section| !section.is_empty());
    let html: String = sections.map(|section| section.html(&mut plots)).collect();
    json!({
        "subtitle": found.subtitle,
        "answer": found.answer.as_ref().map(verdict_banner),
        "warnings": warnings(&found.warnings),
        "html": html,
        "plots": describe_plots(&plots, OF_QUESTION),
        "columns": plots.columns_and_charts().0,
    })
}
