//! A line chart over time (or another axis) as a stand-alone picture.

use super::coordinate;
use super::legend::Legend;
use crate::report::quantity::{Scale, escape, scale};
use crate::report::ticks::ticks;

/// A chart of one quantity over time or another axis, one curve a run.
#[derive(Clone, Debug, Default, PartialEq)]
pub struct Chart {
    /// Title above the plot: `Positioning error δ of rocker`.
    pub title: String,
    /// SI unit of the values.
    pub unit: String,
    /// The curves.
    pub curves: Vec<Curve>,
    /// Shaded intervals of time (s).
    pub shaded: Vec<[f64; 2]>,
    /// What runs to the right.
    pub horizontal: Axis,
}

/// The quantity along a chart's horizontal axis.
#[derive(Clone, Debug, PartialEq)]
pub struct Axis {
    /// Its symbol: `t`.
    pub symbol: String,
    /// Its SI unit; empty for a plain number.
    pub unit: String,
}

impl Default for Axis {
    /// Time.
    fn default() -> Self {
        Self {
            symbol: "t".into(),
            unit: "s".into(),
        }
    }
}

/// One curve.
#[derive(Clone, Debug, Default, PartialEq)]
pub struct Curve {
    /// Its name in the legend; curves without a name have no entry.
    pub label: String,
    /// (time, value); values that are not finite interrupt the curve.
    pub points: Vec<(f64, f64)>,
}

const LEFT: f64 = 66.0;
const RIGHT: f64 = 18.0;
const TOP: f64 = 38.0;
const BOTTOM: f64 = 44.0;
const LEGEND_ROW: f64 = 18.0;

/// Colours that keep apart in print and for colour-blind eyes.
const COLOURS: [&str; 8] = [
    "#1d5a9e", "#c04f15", "#23804d", "#8345a0", "#8a6a10", "#0b8296", "#b0306a", "#566370",
];
const DASHES: [&str; 8] = [
    "", "7 3", "2 2.5", "9 3 2 3", "4 2", "12 4", "1.5 3.5", "6 2 1 2",
];

const STYLE: &str = "text{font:12px system-ui,-apple-system,'Segoe UI',Roboto,Arial,sans-serif;\
fill:#4a5560}.title{font-size:14px;font-weight:600;fill:#17202a}.grid{stroke:#e7eaee}\
.zero{stroke:#c3cad2}.axis{stroke:#5a6572;fill:none}.open{fill:#c45420;fill-opacity:.15}\
.curve{fill:none;stroke-width:1.5;stroke-linejoin:round}";

/// The chart's frame in the picture and the ranges it shows.
struct Frame {
    width: f64,
    height: f64,
    top: f64,
    time: [f64; 2],
    value: [f64; 2],
}

impl Frame {
    fn x(&self, time: f64) -> f64 {
        LEFT + (time - self.time[0]) / (self.time[1] - self.time[0]) * self.width
    }

    /// Left, top, width and height of the frame (pixels), and the ends of its
    /// horizontal axis: what a cursor needs to know.
    fn place(&self) -> String {
        let [left, top, width, height] = [LEFT, self.top, self.width, self.height].map(coordinate);
        let [from, to] = self.time;
        format!("{left} {top} {width} {height} {from} {to}")
    }

    fn y(&self, value: f64) -> f64 {
        self.top + (self.value[1] - value) / (self.value[1] - self.value[0]) * self.height
    }
}

impl Chart {
    /// The picture, `width` × `height` pixels, as a complete SVG document on
    /// white ground.
    pub fn svg(&self, width: f64, height: f64) -> String {
        let (width, height) = (width.max(240.0), height.max(160.0));
        let (legend, legend_height) = self.legend(width);
        let top = TOP + legend_height;
        let frame = Frame {
            width: width - LEFT - RIGHT,
            height: (height - top - BOTTOM).max(40.0),
            top,
            time: padded(range(self.finite().map(|p| p.0)), 0.0),
            value: padded(range(self.finite().map(|p| p.1)), 0.06),
        };
        let greatest = frame.value[0].abs().max(frame.value[1].abs()) * 0.94;
        let scale = scale(greatest, &self.unit);
        let (w, h) = (coordinate(width), coordinate(height));
        format!(
            "<svg xmlns=\"http://www.w3.org/2000/svg\" viewBox=\"0 0 {w} {h}\" width=\"{w}\" \
             height=\"{h}\" role=\"img\" aria-label=\"{title}\" data-frame=\"{place}\">\n<style>{STYLE}</style>\n\
             <rect width=\"{w}\" height=\"{h}\" fill=\"#fff\"/>\n\
             <text class=\"title\" x=\"{LEFT}\" y=\"20\">{title}{unit}</text>\n\
             {legend}{shades}{axes}{curves}</svg>\n",
            place = frame.place(),
            title = escape(&self.title),
            unit = escape(&after_comma(&scale.unit)),
            shades = self.shades(&frame),
            axes = axes(&frame, &scale, &self.horizontal),
            curves = self.curves(&frame),
        )
    }

    fn finite(&self) -> impl Iterator<Item = (f64, f64)> + '_ {
        let points = self.curves.iter().flat_map(|curve| curve.points.iter());
        points
            .copied()
            .filter(|(t, v)| t.is_finite() && v.is_finite())
    }

    /// Names of the curves in rows under the title, and the height they take.
    fn legend(&self, width: f64) -> (String, f64) {
        let mut legend = Legend::new([LEFT, width - RIGHT], LEGEND_ROW);
        let mut out = String::new();
        for (index, curve) in self.curves.iter().enumerate() {
            if curve.label.is_empty() {
                continue;
            }
            let room = 44.0 + 6.8 * curve.label.chars().count() as f64;
            let (x, down) = legend.place(room);
            let y = TOP - 2.0 + down;
            out.push_str(&format!(
                "<path class=\"curve\" d=\"M{} {}h26\" {}/><text x=\"{}\" y=\"{}\">{}</text>\n",
                coordinate(x),
                coordinate(y),
                stroke(index),
                coordinate(x + 32.0),
                coordinate(y + 4.0),
                escape(&curve.label)
            ));
        }
        (out, legend.height())
    }

    fn shades(&self, frame: &Frame) -> String {
        let mut path = String::new();
        for &[from, to] in &self.shaded {
            let clamp = |time: f64| frame.x(time.clamp(frame.time[0], frame.time[1]));
            let (a, b) = (clamp(from), clamp(to));
            if b >= a {
                let span = coordinate((b - a).max(0.5));
                let (x, y, h) = (
                    coordinate(a),
                    coordinate(frame.top),
                    coordinate(frame.height),
                );
                path.push_str(&format!("M{x} {y}h{span}v{h}H{x}z"));
            }
        }
        match path.is_empty() {
            true => path,
            false => format!("<path class=\"open\" d=\"{path}\"/>\n"),
        }
    }

    fn curves(&self, frame: &Frame) -> String {
        let curve = |(index, curve): (usize, &Curve)| {
            let path = path(&curve.points, frame);
            format!("<path class=\"curve\" d=\"{path}\" {}/>\n", stroke(index))
        };
        self.curves.iter().enumerate().map(curve).collect()
    }
}

fn stroke(index: usize) -> String {
    let (colour, dash) = (COLOURS[index % 8], DASHES[index % 8]);
    match dash {
        "" => format!("stroke=\"{colour}\""),
        dash => format!("stroke=\"{colour}\" stroke-dasharray=\"{dash}\""),
    }
}

/// Least and greatest; 0 … 0 of nothing.
fn range(values: impl Iterator<Item = f64>) -> [f64; 2] {
    let start = [f64::INFINITY, f64::NEG_INFINITY];
    let found = values.fold(start, |[low, high], value| {
        [low.min(value), high.max(value)]
    });
    if found[0] <= found[1] {
        found
    } else {
        [0.0, 0.0]
    }
}

/// The range with a margin; a constant gets room on both sides.
fn padded([low, high]: [f64; 2], margin: f64) -> [f64; 2] {
    let size = low.abs().max(high.abs());
    if high - low <= 1e-9 * size || size == 0.0 {
        let room = if size > 0.0 { 0.1 * size } else { 1.0 };
        return [low - room, high + room];
    }
    let room = margin * (high - low);
    [low - room, high + room]
}

/// `, mm`; nothing of a plain number.
fn after_comma(unit: &str) -> String {
    if unit.is_empty() {
        String::new()
    } else {
        format!(", {unit}")
    }
}

fn axes(frame: &Frame, shown: &Scale, horizontal: &Axis) -> String {
    let mut out = String::new();
    let (left, right) = (coordinate(LEFT), coordinate(LEFT + frame.width));
    let (top, foot) = (coordinate(frame.top), coordinate(frame.top + frame.height));
    let factor = shown.factor;
    let rows = (frame.height / 36.0).max(2.0) as usize;
    let values = ticks(frame.value[0] / factor, frame.value[1] / factor, rows);
    for &value in &values.values {
        let y = coordinate(frame.y(value * factor));
        let class = if value == 0.0 { "zero" } else { "grid" };
        out.push_str(&format!(
            "<path class=\"{class}\" d=\"M{left} {y}H{right}\"/>\
             <text x=\"{}\" y=\"{y}\" dy=\"4\" text-anchor=\"end\">{}</text>\n",
            coordinate(LEFT - 8.0),
            values.label(value)
        ));
    }
    let time = scale(
        frame.time[0].abs().max(frame.time[1].abs()),
        &horizontal.unit,
    );
    let columns = (frame.width / 90.0).max(2.0) as usize;
    let times = ticks(
        frame.time[0] / time.factor,
        frame.time[1] / time.factor,
        columns,
    );
    for &value in &times.values {
        let x = coordinate(frame.x(value * time.factor));
        out.push_str(&format!(
            "<path class=\"grid\" d=\"M{x} {top}V{foot}\"/>\
             <text x=\"{x}\" y=\"{foot}\" dy=\"17\" text-anchor=\"middle\">{}</text>\n",
            times.label(value)
        ));
    }
    let middle = coordinate(LEFT + frame.width / 2.0);
    out.push_str(&format!(
        "<path class=\"axis\" d=\"M{left} {top}V{foot}H{right}\"/>\
         <text x=\"{middle}\" y=\"{foot}\" dy=\"35\" text-anchor=\"middle\">{}{}</text>\n",
        escape(&horizontal.symbol),
        escape(&after_comma(&time.unit))
    ));
    out
}

/// The curve as a path; of samples denser than half pixels each half pixel
/// keeps its first, least, greatest and last.
fn path(points: &[(f64, f64)], frame: &Frame) -> String {
    let mut out = String::new();
    let mut pen_down = false;
    let mut start = 0;
    while start < points.len() {
        let column = |index: usize| (2.0 * frame.x(points[index].0)).floor();
        let mut end = start;
        while end + 1 < points.len() && column(end + 1) == column(start) {
            end += 1;
        }
        for index in kept(points, start, end) {
            let (time, value) = points[index];
            if !(time.is_finite() && value.is_finite()) {
                pen_down = false;
                continue;
            }
            let command = if pen_down { 'L' } else { 'M' };
            let (x, y) = (coordinate(frame.x(time)), coordinate(frame.y(value)));
            out.push_str(&format!("{command}{x} {y}"));
            pen_down = true;
        }
        start = end + 1;
    }
    out
}

/// First, least, greatest and last of a stretch, in order, without repetition;
/// all of it where something is not finite.
fn kept(points: &[(f64, f64)], start: usize, end: usize) -> Vec<usize> {
    let stretch = start..=end;
    if end - start < 4 || points[stretch.clone()].iter().any(|p| !p.1.is_finite()) {
        return stretch.collect();
    }
    let by_value = |&a: &usize, &b: &usize| points[a].1.total_cmp(&points[b].1);
    let low = stretch.clone().min_by(by_value).unwrap_or(start);
    let high = stretch.max_by(by_value).unwrap_or(end);
    let mut list = vec![start, low, high, end];
    list.sort_unstable();
    list.dedup();
    list
}

#[cfg(test)]
mod tests {
    use super::{Chart, Curve};

    fn curve(label: &str, count: usize, f: impl Fn(f64) -> f64) -> Curve {
        let point = |i: usize| (i as f64 * 1e-3, f(i as f64 * 1e-3));
        Curve {
            label: label.into(),
            points: (0..count).map(point).collect(),
        }
    }

    #[test]
    fn a_single_peak_among_many_samples_is_kept() {
        let mut one = curve("a < b", 20_000, |_| 0.0);
        one.points[12_345].1 = 7e-3;
        let chart = Chart {
            title: "δ".into(),
            unit: "rad".into(),
            curves: vec![one],
            shaded: vec![[1.0, 2.0]],
            ..Chart::default()
        };
        let picture = chart.svg(640.0, 320.0);
        assert!(picture.len() < 40_000, "{}", picture.len());
        assert!(picture.contains("δ, mrad"));
        assert!(picture.contains("a &lt; b"));
        assert!(picture.contains("class=\"open\""));
        // The peak stands 6 % below the top of the frame (38 + 18 high).
        let frame = 320.0 - 56.0 - 44.0;
        let y = 56.0 + frame * 0.06 / 1.12;
        let text = super::coordinate(y);
        assert!(picture.contains(&format!(" {text}L")), "{text}");
    }

    #[test]
    fn odd_data_make_a_picture_too() {
        let mut gap = curve("", 100, f64::sin);
        gap.points[50].1 = f64::NAN;
        for curves in [vec![], vec![curve("", 1, |_| 3.0)], vec![gap]] {
            let chart = Chart {
                curves,
                ..Chart::default()
            };
            let picture = chart.svg(300.0, 200.0);
            assert!(
                !picture.contains("NaN") && !picture.contains("inf"),
                "{picture}"
            );
        }
    }
}
