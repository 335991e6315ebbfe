//! The one plot engine: a chart described as data, drawn as a stand-alone picture, and made
//! interactive in pages by one script.
//!
//! * [`Plot`]: what is shown over what; `field`: coloured cells with contour lines;
//! * `scale`: how values lie along an axis, and its ticks;
//! * `frame`: where frame, title and legend stand; `draw`: the picture;
//! * `palette`: all colours, light and dark; `page`: the data of a page for `plot.js`, which
//!   has `numbers.js` before it.
//!
//! `plot.js` zooms a chart, shows values at the pointer, moves cursors together and switches
//! series, with the colours and shapes of the drawing. Ticks and numbers exist a second time in
//! `numbers.js`, since a page that is zoomed has no Rust at hand; `script_tests` compares both.

mod draw;
pub(in crate::report) mod field;
mod frame;
mod grid;
mod marks;
pub(in crate::report) mod page;
pub(in crate::report) mod palette;
mod phases;
pub(in crate::report) mod scale;
#[cfg(test)]
mod script_tests;
#[cfg(test)]
mod tests;

pub use field::{Contour, Field, Kind};
pub(in crate::report) use frame::{Entry, Frame, STRIP, framed, rows as legend_rows};
pub use page::Plots;
pub use phases::{MotionPhase, PhaseKind};

/// A chart as data: quantities over one another.
#[derive(Clone, Debug, PartialEq)]
pub struct Plot {
    /// Id that tells it from the others on a page: `rocker.delta`; may be empty.
    pub id: String,
    /// Title above the frame.
    pub title: String,
    /// Axis to the right.
    pub x: Axis,
    /// Axis upwards. Without a name its unit stands behind the title.
    pub y: Axis,
    /// The curves and points.
    pub series: Vec<Series>,
    /// Shaded parts of the horizontal axis.
    pub bands: Vec<Band>,
    /// Rise, dwell and return of a displacement over the horizontal axis.
    pub phases: Vec<MotionPhase>,
    /// Lines across the frame.
    pub rules: Vec<Rule>,
    /// Values of the vertical axis below this are shaded, with a name.
    pub below: Option<(f64, String)>,
    /// Coloured cells.
    pub field: Option<Field>,
    /// Name of the lane above the frame for points without a value; empty: no lane.
    pub lane: String,
    /// True: both axes have one scale about the origin, and the grid is polar.
    pub plane: bool,
    /// True: the first point of every series is marked.
    pub start: bool,
}

impl Default for Plot {
    /// An empty chart over time.
    fn default() -> Self {
        Self {
            id: String::new(),
            title: String::new(),
            x: Axis::new("t", "s"),
            y: Axis::default(),
            series: Vec::new(),
            bands: Vec::new(),
            phases: Vec::new(),
            rules: Vec::new(),
            below: None,
            field: None,
            lane: String::new(),
            plane: false,
            start: false,
        }
    }
}

impl Plot {
    /// Curves of a quantity, which the title names, with its unit over an axis.
    pub fn new(title: impl Into<String>, x: Axis, unit: &str, series: Vec<Series>) -> Self {
        Self {
            title: title.into(),
            x,
            y: Axis::of(unit),
            series,
            ..Self::default()
        }
    }

    /// The same over the angle φ of a drive or cam.
    pub fn over_angle(title: impl Into<String>, unit: &str, series: Vec<Series>) -> Self {
        Self::new(title, Axis::new("φ", "deg"), unit, series)
    }
}

/// A quantity along an axis.
#[derive(Clone, Debug, Default, PartialEq)]
pub struct Axis {
    /// Name or symbol: `t`.
    pub name: String,
    /// Unit; empty for a plain number. SI units get prefixes.
    pub unit: String,
    /// True: logarithmic; values that are not above zero have no place on it.
    pub log: bool,
    /// True: the unit is shown as it is, without prefixes.
    pub fixed: bool,
    /// The ends shown at first; `None`: those of the values, with a margin.
    pub range: Option<[f64; 2]>,
    /// Greatest value shown; what lies above stands in the lane.
    pub ceiling: Option<f64>,
    /// Names of rows counted from the top, in place of numbers.
    pub rows: Vec<String>,
}

impl Axis {
    /// A linear axis.
    pub fn new(name: &str, unit: &str) -> Self {
        Self {
            name: name.to_owned(),
            unit: unit.to_owned(),
            ..Self::default()
        }
    }

    /// A logarithmic axis.
    pub fn logarithmic(name: &str, unit: &str) -> Self {
        Self {
            log: true,
            ..Self::new(name, unit)
        }
    }

    /// The vertical axis of a chart whose title names the quantity.
    pub fn of(unit: &str) -> Self {
        Self::new("", unit)
    }
}

/// Series: a curve, or points that belong together.
#[derive(Clone, Debug, Default, PartialEq)]
pub struct Series {
    /// Name in the legend; what has no name has no entry.
    pub label: String,
    /// (x, y); values that are not finite interrupt a curve.
    pub points: Vec<(f64, f64)>,
    /// Look: line or points.
    pub look: LineStyle,
    /// Number of the style among twelve; by its place where not given.
    pub style: Option<usize>,
    /// Marks of the points, one a point; empty: none is marked.
    pub marks: Vec<Mark>,
}

impl Series {
    /// A line.
    pub fn line(label: &str, points: Vec<(f64, f64)>) -> Self {
        Self {
            label: label.to_owned(),
            points,
            ..Self::default()
        }
    }

    /// A thin dashed line: theory, a limit.
    pub fn theory(label: &str, points: Vec<(f64, f64)>) -> Self {
        Self {
            look: LineStyle::Theory,
            ..Self::line(label, points)
        }
    }

    /// Marks alone, one a point.
    pub fn marked(label: &str, points: Vec<(f64, f64)>, marks: Vec<Mark>) -> Self {
        Self {
            look: LineStyle::Points,
            marks,
            ..Self::line(label, points)
        }
    }
}

/// Look of a series.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq)]
pub enum LineStyle {
    /// Straight from point to point.
    #[default]
    Line,
    /// Each value holds up to the next point.
    Steps,
    /// The marks alone.
    Points,
    /// A thin dashed line: theory, a limit.
    Theory,
}

/// The mark of a point, and what is said of it when the pointer rests on it.
#[derive(Clone, Debug, Default, PartialEq)]
pub struct Mark {
    /// Shape of the mark.
    pub shape: Shape,
    /// Note on the point; may be empty.
    pub note: String,
}

impl Mark {
    /// A mark with a note.
    pub fn new(shape: Shape, note: impl Into<String>) -> Self {
        let note = note.into();
        Self { shape, note }
    }
}

/// Shape of a point's mark.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq)]
pub enum Shape {
    /// No mark.
    None,
    /// Filled, circle, square, triangle or diamond by series: it is good.
    #[default]
    Good,
    /// Open: it has a value, but is not what it should be.
    Open,
    /// A cross: it failed, and is no part of the curve.
    Cross,
    /// At most this value: filled, with an arrow downwards.
    AtMost,
    /// A small dot in the colour of a kind of the field.
    Kind(usize),
    /// A ring: not determined, and no part of the curve.
    Ring,
}

impl Shape {
    /// True of marks that a curve passes by.
    fn is_off_curve(self) -> bool {
        matches!(self, Self::Cross | Self::Ring)
    }
}

/// Shaded intervals of the horizontal axis.
#[derive(Clone, Debug, Default, PartialEq)]
pub struct Band {
    /// Name in the legend; may be empty.
    pub label: String,
    /// The intervals.
    pub spans: Vec<[f64; 2]>,
    /// The series it belongs to: a strip at the foot in its colour. `None`: the whole height.
    pub series: Option<usize>,
}

impl Band {
    /// Intervals over the whole height, without a name; none of nothing.
    pub fn plain(spans: Vec<[f64; 2]>) -> Vec<Self> {
        let band = Self {
            spans,
            ..Self::default()
        };
        match band.spans.is_empty() {
            true => Vec::new(),
            false => vec![band],
        }
    }
}

/// A line across the frame; its name stands in the legend.
#[derive(Clone, Debug, Default, PartialEq)]
pub struct Rule {
    /// Place on the axis.
    pub at: f64,
    /// Label at the place.
    pub label: String,
    /// True: upright, at a value of the horizontal axis.
    pub upright: bool,
}

impl Rule {
    /// A line at a value of the vertical axis.
    pub fn level(at: f64, label: impl Into<String>) -> Self {
        Self {
            at,
            label: label.into(),
            upright: false,
        }
    }

    /// A line without a name at a value of the horizontal axis.
    pub fn upright(at: f64) -> Self {
        Self {
            upright: true,
            ..Self::level(at, "")
        }
    }
}

/// Characters per line that fit `width` at a font size, for a sans-serif face.
pub(in crate::report) fn characters_per_line(width: f64, font_size: f64) -> usize {
    (width / (0.56 * font_size)).max(3.0) as usize
}

/// Width of a text at the size of labels (pixels), rather too much than too little.
pub(in crate::report) fn width_of(text: &str) -> f64 {
    6.8 * text.chars().filter(|c| !is_combining(*c)).count() as f64
}

fn is_combining(c: char) -> bool {
    ('\u{300}'..='\u{36f}').contains(&c)
}

/// A coordinate for an SVG attribute: two decimals, no negative zero.
pub(in crate::report) fn coordinate(value: f64) -> String {
    let text = format!("{value:.2}");
    let text = text.trim_end_matches('0').trim_end_matches('.');
    if text == "-0" {
        "0".into()
    } else {
        text.to_owned()
    }
}

/// A complete SVG document: its colours are those of [`palette`], light or dark as the
/// reader wishes.
pub(in crate::report) fn document(
    class: &str,
    [width, height]: [f64; 2],
    label: &str,
    style: &str,
    body: &str,
) -> String {
    let (w, h) = (coordinate(width), coordinate(height));
    format!(
        "<svg xmlns=\"http://www.w3.org/2000/svg\" class=\"{class}\" viewBox=\"0 0 {w} {h}\" \
         width=\"{w}\" height=\"{h}\" role=\"img\" aria-label=\"{}\">\n<style>{}</style>\n\
         <rect class=\"paper\" width=\"{w}\" height=\"{h}\"/>\n{body}</svg>\n",
        crate::report::quantity::escape(label),
        palette::standing_alone(&format!(".paper{{fill:var(--paper)}}{style}")),
    )
}
