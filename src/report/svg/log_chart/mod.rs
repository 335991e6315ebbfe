//! A chart of marked points on logarithmic axes as a stand-alone picture.
//!
//! Points that failed are no part of a curve: they stand as open marks or
//! crosses, and those that have no value at all in a lane above the frame.

mod axes;
mod marks;
#[cfg(test)]
mod tests;

use super::coordinate;
use super::legend::Legend;
use crate::report::quantity::escape;
use marks::{draw, mark};

/// A chart on a logarithmic vertical and a logarithmic or linear horizontal axis.
#[derive(Clone, Debug, Default, PartialEq)]
pub struct LogChart {
    /// Title above the plot.
    pub title: String,
    /// Name and unit of the horizontal axis.
    pub x_label: String,
    /// Name and unit of the vertical axis.
    pub y_label: String,
    /// True: the horizontal axis is linear.
    pub linear_x: bool,
    /// Greatest value of the vertical axis; what lies above stands in the lane.
    pub ceiling: Option<f64>,
    /// The curves with their points.
    pub series: Vec<Series>,
    /// Horizontal lines with a name.
    pub rules: Vec<(f64, String)>,
    /// Values below this are shaded, with a name.
    pub shaded_below: Option<(f64, String)>,
    /// Name of the lane for points without a value; empty: no lane.
    pub lane: String,
}

/// One curve.
#[derive(Clone, Debug, Default, PartialEq)]
pub struct Series {
    /// Name in the legend.
    pub label: String,
    /// Which colour and shape of marks; see [`COLOURS`].
    pub style: usize,
    /// True: a line without marks, dashed (theory).
    pub bare: bool,
    /// The points in order.
    pub points: Vec<LogPoint>,
}

/// One point.
#[derive(Clone, Debug, Default, PartialEq)]
pub struct LogPoint {
    /// Horizontal value.
    pub x: f64,
    /// Vertical value; `None`: it has none and stands in the lane.
    pub y: Option<f64>,
    /// How it is marked.
    pub mark: Mark,
    /// What is said when the pointer rests on it.
    pub note: String,
}

/// How a point is marked.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq)]
pub enum Mark {
    /// Filled: it is good.
    #[default]
    Good,
    /// Open: it has a value, but is not what it should be.
    Open,
    /// A cross: it failed.
    Cross,
    /// At most this value: a filled mark with an arrow downwards.
    AtMost,
}

/// Colours that keep apart in print and for colour-blind eyes.
pub const COLOURS: [&str; 10] = [
    "#17202a", "#1d5a9e", "#c04f15", "#23804d", "#8345a0", "#b0306a", "#8a6a10", "#0b8296",
    "#566370", "#7a3b10",
];

const LEFT: f64 = 74.0;
const RIGHT: f64 = 22.0;
const TOP: f64 = 40.0;
const BOTTOM: f64 = 50.0;
const LEGEND_ROW: f64 = 19.0;
const LANE: f64 = 26.0;

const STYLE: &str = ".lc text{font:12px system-ui,-apple-system,'Segoe UI',Roboto,Arial,sans-serif;\
fill:#4a5560}.lc .title{font-size:14px;font-weight:600;fill:#17202a}.lc .grid{stroke:#e3e7ec}\
.lc .minor{stroke:#f1f3f6}.lc .axis{stroke:#5a6572;fill:none}.lc .curve{fill:none;stroke-width:1.6;\
stroke-linejoin:round}.lc .rule{stroke:#8f1d3f;stroke-dasharray:6 4;stroke-width:1.2}\
.lc .named{fill:#8f1d3f;font-size:11.5px;paint-order:stroke;stroke:#fff;stroke-width:3px}.lc .below{fill:#dfe4ea;fill-opacity:.55}\
.lc .lane{fill:#fbeef1}.lc .small{font-size:11px}";

/// Where values lie in the picture.
struct Frame {
    width: f64,
    height: f64,
    top: f64,
    x: [f64; 2],
    y: [f64; 2],
    linear_x: bool,
    lane: bool,
}

impl Frame {
    fn x(&self, value: f64) -> f64 {
        let value = if self.linear_x { value } else { value.log10() };
        LEFT + (value - self.x[0]) / (self.x[1] - self.x[0]) * self.width
    }

    /// Above the frame a value stands in the lane.
    fn y(&self, value: Option<f64>) -> f64 {
        let lane = self.top - 0.5 * LANE;
        let Some(value) = value.filter(|value| *value > 0.0) else {
            return lane;
        };
        let share = (self.y[1] - value.log10()) / (self.y[1] - self.y[0]);
        if share < 0.0 && self.lane {
            return lane;
        }
        self.top + share.clamp(0.0, 1.0) * self.height
    }
}

impl LogChart {
    /// The picture, `width` × `height` pixels, as a complete SVG document on
    /// white ground.
    pub fn svg(&self, width: f64, height: f64) -> String {
        let (width, height) = (width.max(320.0), height.max(240.0));
        let (legend, rows) = self.legend(width);
        let has_lane = !self.lane.is_empty() && self.needs_lane();
        let lane = if has_lane { LANE } else { 0.0 };
        let top = TOP + rows + lane + 4.0;
        let frame = Frame {
            width: width - LEFT - RIGHT,
            height: (height - top - BOTTOM).max(60.0),
            top,
            x: self.x_range(),
            y: self.y_range(),
            linear_x: self.linear_x,
            lane: has_lane,
        };
        let (w, h) = (coordinate(width), coordinate(height));
        format!(
            "<svg xmlns=\"http://www.w3.org/2000/svg\" class=\"lc\" viewBox=\"0 0 {w} {h}\" \
             width=\"{w}\" height=\"{h}\" role=\"img\" aria-label=\"{title}\">\n\
             <style>{STYLE}</style>\n<rect width=\"{w}\" height=\"{h}\" fill=\"#fff\"/>\n\
             <text class=\"title\" x=\"{LEFT}\" y=\"22\">{title}</text>\n\
             {legend}{axes}{ground}{series}{names}</svg>\n",
            title = escape(&self.title),
            axes = self.axes(&frame),
            ground = self.ground(&frame),
            series = self
                .series
                .iter()
                .map(|s| draw(s, &frame))
                .collect::<String>(),
            names = self.names(&frame),
        )
    }

    fn points(&self) -> impl Iterator<Item = &LogPoint> {
        self.series.iter().flat_map(|series| &series.points)
    }

    fn needs_lane(&self) -> bool {
        let above = |y: f64| self.ceiling.is_some_and(|ceiling| y > ceiling);
        self.points().any(|point| point.y.is_none_or(above))
    }

    /// Range of the horizontal axis, decades where it is logarithmic.
    fn x_range(&self) -> [f64; 2] {
        let shown = self.points().map(|point| point.x);
        if self.linear_x {
            let [low, high] = range(shown);
            let room = if high > low { 0.03 * (high - low) } else { 1.0 };
            return [low - room, high + room];
        }
        let [low, high] = range(shown.filter(|x| *x > 0.0).map(f64::log10));
        let room = (0.04 * (high - low)).max(0.1);
        [low - room, high + room]
    }

    /// Range of the vertical axis: whole decades around the values.
    fn y_range(&self) -> [f64; 2] {
        let ceiling = self.ceiling.unwrap_or(f64::INFINITY);
        let values = self.points().filter_map(|point| point.y);
        let named = self.rules.iter().map(|rule| rule.0);
        let values = values.chain(named).filter(|y| *y > 0.0);
        let [low, high] = range(values.map(|y| y.min(ceiling).log10()));
        let [low, high] = [(low - 0.15).floor(), (high + 0.05).ceil()];
        if high > low {
            [low, high]
        } else {
            [low, low + 1.0]
        }
    }

    /// Names of the series in rows under the title, and the height they take.
    fn legend(&self, width: f64) -> (String, f64) {
        let mut legend = Legend::new([LEFT, width - RIGHT], LEGEND_ROW);
        let mut out = String::new();
        for series in self.series.iter().filter(|s| !s.label.is_empty()) {
            let room = 46.0 + 6.9 * series.label.chars().count() as f64;
            let (x, down) = legend.place(room);
            let y = TOP + down;
            let colour = COLOURS[series.style % COLOURS.len()];
            let dash = if series.bare {
                " stroke-dasharray=\"5 3\""
            } else {
                ""
            };
            out.push_str(&format!(
                "<path class=\"curve\" d=\"M{} {}h26\" stroke=\"{colour}\"{dash}/>",
                coordinate(x),
                coordinate(y)
            ));
            if !series.bare {
                out.push_str(&mark(x + 13.0, y, series.style, Mark::Good));
            }
            out.push_str(&format!(
                "<text x=\"{}\" y=\"{}\">{}</text>\n",
                coordinate(x + 33.0),
                coordinate(y + 4.0),
                escape(&series.label)
            ));
        }
        (out, legend.height())
    }
}

/// Least and greatest finite value; 0 … 0 of nothing.
fn range(values: impl Iterator<Item = f64>) -> [f64; 2] {
    let start = [f64::INFINITY, f64::NEG_INFINITY];
    let found = values
        .filter(|value| value.is_finite())
        .fold(start, |[low, high], value| {
            [low.min(value), high.max(value)]
        });
    if found[0] <= found[1] {
        found
    } else {
        [0.0, 0.0]
    }
}
