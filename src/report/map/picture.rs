//! A map as a picture: verdicts with contour lines over two parameters, curves over one,
//! verdicts marked in both; and its parts for a page.

use super::panel::{Panel, undetermined};
use super::style::{colour, hatching};
use super::values::Values;
use crate::report::addresses::{result_words, setting_words};
use crate::report::plot::field::{patterns, swatch};
use crate::report::plot::page::Plots;
use crate::report::plot::palette::STYLE;
use crate::report::plot::{Entry, Plot, STRIP, coordinate, document, legend_rows};
use crate::report::quantity::{escape, shortened};
use crate::report::verdict::capitalised;
use crate::studies::map::{MapResult, Study, Verdict};
use std::collections::BTreeMap;
use std::fmt::Write as _;

const LEFT: f64 = 78.0;
const TOP: f64 = 40.0;
const FOOT: f64 = 48.0;
const GAP: f64 = 26.0;
/// Width of the legend on a page.
const KEY: f64 = 744.0;
/// Longest title of a panel on a page (characters).
const MOST_OF_HEAD: usize = 80;
const LINE: f64 = 15.0;
/// Size of the plot of a map that is steered.
#[cfg(feature = "live")]
const STEERED: [f64; 2] = [340.0, 270.0];
/// The picture of a study: all its panels, and a legend of the verdicts that occur. A complete SVG
/// document.
pub fn svg(study: &Study<'_>, result: &MapResult) -> String {
    let mut plots = Plots::default();
    let sheet = Sheet::new(study, result, &mut plots);
    document("dam-plot", sheet.size, &sheet.name, STYLE, &sheet.body)
}

/// The panels as charts of a page.
pub(super) fn panels(study: &Study<'_>, result: &MapResult) -> Vec<Plot> {
    let values = Values::of(study, result);
    let several = study.panels.panels.len() > 1;
    let all = study.panels.panels.iter().zip(&result.panels).enumerate();
    all.map(|(index, (panel, cells))| {
        let plot = Panel {
            study,
            cells,
            values: &values,
        };
        let settings = setting_words(&title(&panel.settings).join(", "));
        let head = match (several, settings.as_str()) {
            (true, settings) => format!("{}  {settings}", panel_letter(index)),
            (false, "") => capitalised(&result_words(&study.figure)),
            (false, settings) => settings.to_owned(),
        };
        Plot {
            title: shortened(&head, MOST_OF_HEAD),
            ..plot.plot(format!("panel {index}"))
        }
    })
    .collect()
}

/// The legend of a page's panels.
pub(super) fn key(study: &Study<'_>, result: &MapResult) -> String {
    let (body, height) = legend(study, result, [LEFT, 0.0, KEY]);
    let [w, h] = [KEY, height].map(coordinate);
    format!(
        "<div class=\"chart map\"><svg class=\"dam-plot\" viewBox=\"0 0 {w} {h}\" width=\"{w}\" \
         role=\"group\" aria-label=\"colours and verdicts\">\n{}{body}</svg></div>\n",
        patterns()
    )
}

/// The legend, from a left and an upper edge on to a width, and where it ends below.
fn legend(study: &Study<'_>, result: &MapResult, [left, top, width]: [f64; 3]) -> (String, f64) {
    let (legend, height) = legend_rows(legend_entries(study, result), [left, width], top + 14.0);
    (legend, top + height + 16.0)
}

/// The map of one panel where it is looked at and steered, no larger than needed.
#[cfg(feature = "live")]
pub(in crate::report) fn interactive_map(
    study: &Study<'_>,
    result: &MapResult,
    plots: &mut Plots,
) -> String {
    let sheet = Sheet::sized(study, result, plots, STEERED);
    let [w, h] = sheet.size.map(coordinate);
    format!(
        "<div class=\"chart map\"><svg class=\"dam-plot\" data-steers=\"\" viewBox=\"0 0 {w} {h}\" \
         width=\"{w}\" role=\"group\" aria-label=\"{}\">\n{}</svg></div>\n",
        escape(&sheet.name),
        sheet.body
    )
}

/// Letter of a panel: a … z, then by its number.
pub(in crate::report) fn panel_letter(index: usize) -> String {
    match u8::try_from(index) {
        Ok(index @ ..26) => char::from(b'a' + index).to_string(),
        _ => (index + 1).to_string(),
    }
}

struct Sheet {
    size: [f64; 2],
    name: String,
    body: String,
}

impl Sheet {
    fn new(study: &Study<'_>, result: &MapResult, plots: &mut Plots) -> Self {
        let size = plot_size(columns(study), study.y.is_some());
        Self::sized(study, result, plots, size)
    }

    /// With plots of a size.
    fn sized(
        study: &Study<'_>,
        result: &MapResult,
        plots: &mut Plots,
        [plot_width, plot_height]: [f64; 2],
    ) -> Self {
        let panels = &study.panels;
        let columns = columns(study);
        let rows = panels.panels.len().div_ceil(columns);
        let values = Values::of(study, result);
        let titles: Vec<Vec<String>> = (panels.panels.iter())
            .map(|panel| title(&panel.settings))
            .collect();
        let lines = titles.iter().map(Vec::len).max().unwrap_or(0);
        let cell_width = LEFT + plot_width + GAP;
        let head = LINE * lines as f64 + 10.0;
        let strip = if study.y.is_some() { 0.0 } else { STRIP };
        let cell_height = head + plot_height + strip + FOOT;
        let width = cell_width * columns as f64;
        let body_foot = TOP + cell_height * rows as f64;
        let mut body = patterns();
        let name = format!("{} of {}", study.figure, study.scene);
        let _ = writeln!(
            body,
            "<text class=\"heading\" x=\"16\" y=\"24\">{}</text>",
            escape(&shortened(&name, (width / 8.4) as usize))
        );
        for (index, (cells, title)) in result.panels.iter().zip(&titles).enumerate() {
            let panel = Panel {
                study,
                cells,
                values: &values,
            };
            let plot = panel.plot(format!("panel {index}"));
            let frame = plot.frame([
                LEFT + cell_width * (index % columns) as f64,
                TOP + head + cell_height * (index / columns) as f64,
                plot_width,
                plot_height,
            ]);
            let number = plots.add(&plot, &frame, "map");
            let head = panel_heading(title, index, panels.panels.len(), &frame);
            body.push_str(&plot.panel(&frame, &head, number));
        }
        let (below, height) = legend(study, result, [16.0, body_foot, width]);
        body.push_str(&below);
        Self {
            size: [width, height],
            name,
            body,
        }
    }
}

/// Size of one plot, by the number of plots in a row.
fn plot_size(columns: usize, map: bool) -> [f64; 2] {
    match (columns, map) {
        (1, true) => [640.0, 460.0],
        (2, true) => [420.0, 320.0],
        (_, true) => [330.0, 260.0],
        (1, false) => [760.0, 340.0],
        (2, false) => [440.0, 260.0],
        (_, false) => [330.0, 210.0],
    }
}

/// Plots in a row.
fn columns(study: &Study<'_>) -> usize {
    let panels = &study.panels;
    panels.columns.clamp(1, 4).min(panels.panels.len())
}

/// Title of a panel: what it differs in, a line a setting; how long it runs is left out.
fn title(settings: &[String]) -> Vec<String> {
    let shown = settings
        .iter()
        .filter(|setting| !setting.starts_with("run."));
    shown
        .map(|setting| setting.replacen('=', " = ", 1))
        .collect()
}

/// The settings of a panel above its frame.
fn panel_heading(
    title: &[String],
    index: usize,
    count: usize,
    frame: &crate::report::plot::Frame,
) -> String {
    let mut out = String::new();
    for (line, text) in title.iter().enumerate() {
        let y = frame.top - 8.0 - LINE * (title.len() - 1 - line) as f64;
        let letter = match (line, count) {
            (0, 2..) => format!("{}  ", panel_letter(index)),
            _ => String::new(),
        };
        let _ = writeln!(
            out,
            "<text class=\"panel\" x=\"{}\" y=\"{}\">{letter}{}</text>",
            coordinate(frame.left),
            coordinate(y),
            escape(&shortened(text, (frame.width / 6.4) as usize))
        );
    }
    out
}

/// What the colours mean, and how often they occur.
fn legend_entries(study: &Study<'_>, result: &MapResult) -> Vec<Entry> {
    let mut counts: BTreeMap<Verdict, usize> = BTreeMap::new();
    let (mut edge, mut rings) = ([false; 2], 0);
    for cell in result.panels.iter().flatten().flatten() {
        rings += usize::from(undetermined(Some(cell)));
        *counts.entry(cell.verdict).or_insert(0) += 1;
        if let Some(margin) = cell.rigid_margin {
            edge[usize::from(margin < 0.0)] = true;
        }
    }
    let occurring = Verdict::ALL.iter();
    let occurring = occurring.filter_map(|verdict| Some((*verdict, counts.get(verdict)?)));
    let mut list: Vec<Entry> = occurring
        .map(|(verdict, count)| {
            let sample = swatch(colour(verdict), hatching(verdict));
            Entry::new(sample, format!("{} ({count})", verdict.words()))
        })
        .collect();
    if rings > 0 {
        let ring = "<circle class=\"ring\" cx=\"13\" r=\"3.6\"/>";
        let words = format!("not determined to {} digits ({rings})", study.digits);
        list.push(Entry::new(ring.to_owned(), words));
    }
    if edge == [true; 2] {
        let line = match study.y {
            Some(_) => {
                "<path class=\"edge-back\" d=\"M0 0h26\"/><path class=\"edge\" d=\"M0 0h26\"/>"
            }
            None => "<path class=\"rule\" d=\"M0 0h26\"/>",
        };
        let words = "lift-off edge of the rigid mechanism".to_owned();
        list.push(Entry::new(line.to_owned(), words));
    }
    list
}
