//! What the studio shows of a run and of a map: the tables, charts and drawings of the pages,
//! taken apart so that what moves is sent alone.

use super::diagram::Diagram;
use super::html::STYLE;
use super::html::runs::{RunSeries, Shown};
use super::machine::Machine;
use super::map::picture;
use super::mechanism;
use super::plot::{Plots, page, palette};
use super::quantity::with_unit;
use super::show::{equations, masses, masses::Frequencies};
use super::verdict::{Verdict, verdict};
use super::{accuracy, cam};
use crate::dynamics::model::Model;
use crate::dynamics::record::{Figures, Record};
use crate::dynamics::system::{Regime, System};
use crate::kinematics::cam::DiscCam;
use crate::studies::map::{MapResult, Study};
use crate::studies::order::Certificate;
use serde_json::Value;

/// The scripts of charts and of what moves.
pub(crate) const PLOT_SCRIPT: &str = page::SCRIPT;
pub(crate) const PLAYER_SCRIPT: &str = super::html::PLAYER;

/// Number of the first chart of a map: those of a run have the ones before.
const OF_MAP: usize = 10_000;

/// The style of charts, tables and drawings, with all colours.
pub(crate) fn style() -> String {
    [
        &palette::of_page(),
        palette::STYLE,
        STYLE,
        mechanism::STYLE,
        cam::style(),
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

/// A run with its charts; those drawn `before` are taken where they differ in numbers alone.
pub(crate) fn run(
    model: &Model,
    cams: &[(String, DiscCam)],
    figures: &Figures,
    record: &Record,
    before: &Charts,
) -> LiveRun {
    let merged = record.merged();
    let series = [RunSeries {
        label: String::new(),
        record: &merged,
    }];
    let boxes = Diagram::of(model).boxes;
    let shown = boxes.iter().filter_map(|one| {
        let kind = format!("{}, {}", one.kind.replace('_', " "), one.detail);
        Shown::of(&series, &one.id, &kind)
    });
    let mut charts = charts(&shown.collect::<Vec<_>>(), before);
    let machine = Machine { model, cams };
    let moving = machine.moving(figures, &merged, &mut charts.plots);
    let tables = super::run::objects(figures, merged.times.len());
    let tables = tables.iter().map(|section| section.html(&mut charts.plots));
    let tables: String = tables.collect();
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
        charts,
        moving,
        moves,
        pictures,
    }
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

/// The linkages as they are drawn by hand.
pub(crate) fn sketches(system: &System) -> Value {
    mechanism::sketch::sketches(system.model())
}

/// What the figures are worth, and the levels of the objects with why.
pub(crate) fn accuracy(certificate: &Certificate) -> String {
    let mut plots = Plots::live(0);
    let sections = accuracy::sections(certificate);
    let sections = sections.iter().map(|section| section.html(&mut plots));
    sections.collect()
}

/// The dynamic model, and the equations, as parts of a page.
pub(crate) fn model(system: &System) -> [String; 2] {
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

fn charts(shown: &[Shown], before: &Charts) -> Charts {
    let mut plots = Plots::live(0);
    let likeness: String = shown.iter().map(Shown::likeness).collect();
    if likeness == before.likeness {
        for one in shown {
            for chart in &one.charts {
                plots.again(chart, one.size(), &one.link());
            }
        }
        return Charts {
            html: before.html.clone(),
            likeness,
            plots,
        };
    }
    Charts {
        html: shown.iter().map(|one| one.html(&mut plots)).collect(),
        likeness,
        plots,
    }
}

/// A map as the studio shows it: its picture, the numbers behind it, and what is said of each
/// cell, row by row from the lowest.
pub(crate) fn map(study: &Study<'_>, result: &MapResult) -> (String, Plots, Vec<String>) {
    let mut plots = Plots::live(OF_MAP);
    let picture = picture::steered(study, result, &mut plots);
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
    let all = plots.parts().1.iter().enumerate();
    let all = all.map(|(index, plot)| ((OF_MAP + index).to_string(), plot.clone()));
    Value::Object(all.collect())
}
