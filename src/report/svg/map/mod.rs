//! Maps as stand-alone pictures: heat maps with contour lines over two
//! parameters, curves over one, verdicts marked in both.

mod colour;
mod contour;
mod curve;
mod heat;
mod legend;
mod scale;
mod verdict;

use super::coordinate;
use crate::analysis::map::{Cell, MapResult, Study};
use crate::report::quantity::{escape, shortened};
use colour::Values;
use scale::Scale;

const STYLE: &str = "text{font:12px system-ui,-apple-system,'Segoe UI',Roboto,Arial,sans-serif;\
fill:#4a5560}.title{font-size:15px;font-weight:600;fill:#17202a}.panel{font-size:12px;\
font-weight:600;fill:#17202a}.axis{stroke:#5a6572;fill:none}.grid{stroke:#e7eaee;fill:none}\
.tick{stroke:#5a6572}.contour{fill:none;stroke:#fff;stroke-width:.9;stroke-opacity:.85}\
.halo{fill:none;stroke:#10202c;stroke-width:2.2;stroke-opacity:.28}.level{font-size:10px;\
fill:#fff;paint-order:stroke;stroke:#22303a;stroke-width:2.2px;stroke-linejoin:round}\
.edge{fill:none;stroke:#fff;stroke-width:2.6;stroke-dasharray:7 4}.edge-back{fill:none;\
stroke:#10161c;stroke-width:4.4}.border{fill:none;stroke:#10161c;stroke-width:1.1}\
.curve{fill:none;stroke:#1d5a9e;stroke-width:1.7;stroke-linejoin:round}\
.undetermined{fill:#fff;stroke:#10161c;stroke-width:1}";

const LEFT: f64 = 74.0;
const TOP: f64 = 40.0;
const FOOT: f64 = 46.0;
const GAP: f64 = 26.0;
/// Room for the bar of colours and its labels.
const BAR: f64 = 140.0;
const LINE: f64 = 15.0;

/// Where a panel's plot lies in the picture.
#[derive(Clone, Copy, Debug)]
struct Frame {
    left: f64,
    top: f64,
    width: f64,
    height: f64,
}

impl Frame {
    fn x(&self, share: f64) -> f64 {
        self.left + share * self.width
    }

    fn y(&self, share: f64) -> f64 {
        self.top + (1.0 - share) * self.height
    }
}

/// One panel as it is drawn.
struct Drawing<'a> {
    study: &'a Study<'a>,
    cells: &'a [Option<Cell>],
    frame: Frame,
    x: &'a Scale,
    y: &'a Scale,
    values: &'a Values,
}

impl Drawing<'_> {
    fn cell(&self, column: usize, row: usize) -> Option<&Cell> {
        self.cells
            .get(row * self.study.columns() + column)?
            .as_ref()
    }
}

/// The picture of a study: all its panels, a bar of colours for all of them,
/// and a legend of the verdicts that occur. A complete SVG document on white
/// ground.
pub fn svg(study: &Study<'_>, result: &MapResult) -> String {
    let panels = &study.panels;
    let columns = panels.columns.clamp(1, 4).min(panels.panels.len());
    let rows = panels.panels.len().div_ceil(columns);
    let values = Values::of(study, result);
    let x = Scale::of_values(&study.x, &study.parameter_units[0]);
    let y = match &study.y {
        Some(axis) => Scale::of_values(axis, &study.parameter_units[1]),
        None => values.scale(),
    };
    let titles: Vec<Vec<String>> = panels
        .panels
        .iter()
        .map(|panel| title(&panel.settings))
        .collect();
    let lines = titles.iter().map(Vec::len).max().unwrap_or(0);
    let (plot_width, plot_height) = plot_size(columns, study.y.is_some());
    let cell_width = LEFT + plot_width + GAP;
    let head = LINE * lines as f64 + 10.0;
    let strip = if study.y.is_some() { 0.0 } else { curve::STRIP };
    let cell_height = head + plot_height + strip + FOOT;
    let bar = if study.y.is_some() { BAR } else { 0.0 };
    let width = cell_width * columns as f64 + bar;
    let body_foot = TOP + cell_height * rows as f64;
    let (legend, legend_height) = legend::legend(study, result, width, body_foot + 6.0);
    let height = body_foot + legend_height + 16.0;
    let mut body = String::new();
    for (index, (cells, title)) in result.panels.iter().zip(&titles).enumerate() {
        let frame = Frame {
            left: LEFT + cell_width * (index % columns) as f64,
            top: TOP + head + cell_height * (index / columns) as f64,
            width: plot_width,
            height: plot_height,
        };
        let drawing = Drawing {
            study,
            cells,
            frame,
            x: &x,
            y: &y,
            values: &values,
        };
        body.push_str(&panel(&drawing, title, index, panels.panels.len()));
    }
    if study.y.is_some() {
        let frame = Frame {
            left: cell_width * columns as f64 + 8.0,
            top: TOP + head,
            width: 16.0,
            height: (body_foot - TOP - head - FOOT).min(420.0),
        };
        body.push_str(&legend::bar(&values, frame));
    }
    let (w, h) = (coordinate(width), coordinate(height));
    let name = format!("{} of {}", study.figure, study.scene);
    format!(
        "<svg xmlns=\"http://www.w3.org/2000/svg\" viewBox=\"0 0 {w} {h}\" width=\"{w}\" \
         height=\"{h}\" role=\"img\" aria-label=\"{label}\">\n<style>{STYLE}</style>\n{patterns}\
         <rect width=\"{w}\" height=\"{h}\" fill=\"#fff\"/>\n\
         <text class=\"title\" x=\"16\" y=\"24\">{title}</text>\n{body}{legend}</svg>\n",
        label = escape(&name),
        title = escape(&shortened(&name, (width / 8.4) as usize)),
        patterns = verdict::patterns(),
    )
}

/// Size of one plot, by the number of plots in a row.
fn plot_size(columns: usize, map: bool) -> (f64, f64) {
    match (columns, map) {
        (1, true) => (640.0, 460.0),
        (2, true) => (420.0, 320.0),
        (_, true) => (330.0, 260.0),
        (1, false) => (760.0, 340.0),
        (2, false) => (440.0, 260.0),
        (_, false) => (330.0, 210.0),
    }
}

/// What a panel differs in, a line a setting; how long it runs is left out.
fn title(settings: &[String]) -> Vec<String> {
    let shown = settings
        .iter()
        .filter(|setting| !setting.starts_with("run."));
    shown
        .map(|setting| setting.replacen('=', " = ", 1))
        .collect()
}

/// What a panel is called: a … z, then by its number.
pub(in crate::report) fn letter(index: usize) -> String {
    match u8::try_from(index) {
        Ok(index @ ..26) => char::from(b'a' + index).to_string(),
        _ => (index + 1).to_string(),
    }
}

fn panel(drawing: &Drawing<'_>, title: &[String], index: usize, count: usize) -> String {
    let frame = &drawing.frame;
    let mut out = String::new();
    for (line, text) in title.iter().enumerate() {
        let y = frame.top - 8.0 - LINE * (title.len() - 1 - line) as f64;
        let letter = match (line, count) {
            (0, 2..) => format!("{}  ", letter(index)),
            _ => String::new(),
        };
        out.push_str(&format!(
            "<text class=\"panel\" x=\"{}\" y=\"{}\">{letter}{}</text>\n",
            coordinate(frame.left),
            coordinate(y),
            escape(&shortened(text, (frame.width / 6.4) as usize))
        ));
    }
    if drawing.study.y.is_some() {
        out.push_str(&heat::plot(drawing));
        out.push_str(&scale::axes(drawing, 0.0));
    } else {
        out.push_str(&scale::axes(drawing, curve::STRIP));
        out.push_str(&curve::plot(drawing));
    }
    out.push_str(&pointed(drawing, index));
    out
}

/// Where the cells of a panel are, for what answers pointing; nothing is seen of it.
fn pointed(drawing: &Drawing<'_>, index: usize) -> String {
    let frame = &drawing.frame;
    let strip = match drawing.study.y {
        Some(_) => 0.0,
        None => curve::STRIP,
    };
    let place = [frame.left, frame.top, frame.width, frame.height + strip];
    let [x, y, width, height] = place.map(coordinate);
    format!(
        "<rect data-panel=\"{index}\" x=\"{x}\" y=\"{y}\" width=\"{width}\" height=\"{height}\" \
         fill=\"none\" pointer-events=\"all\"/>\n"
    )
}
