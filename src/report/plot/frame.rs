//! Where frame, title and legend of a chart stand, and which ranges it shows.

use super::scale::{Scale, ticks};
use super::{
    Axis, LineStyle, Plot, Series, Shape, characters_per_line, coordinate, marks, palette, width_of,
};
use crate::report::quantity::{escape, shortened};
use crate::report::symbols::{Setting, symbols};

pub(super) const RIGHT: f64 = 20.0;
const HEAD: f64 = 28.0;
/// Share of the range of its values that a chart leaves free above and below.
const MARGIN: f64 = 0.06;
const FOOT: f64 = 42.0;
const ROW: f64 = 18.0;
pub(super) const LANE: f64 = 26.0;
/// Height of the strip of verdicts under a frame, with its distance from it.
pub(in crate::report) const STRIP: f64 = 20.0;
/// Height at the head of a frame that names of phases take (pixels).
const NAMES: f64 = 14.0;
/// Height of the strips of bands at the foot, one a series.
pub(super) const BAND: f64 = 6.0;

/// Frame of the picture: where values lie in it.
#[derive(Clone, Debug, PartialEq)]
pub(in crate::report) struct Frame {
    pub(in crate::report) left: f64,
    pub(in crate::report) top: f64,
    pub(in crate::report) width: f64,
    pub(in crate::report) height: f64,
    pub(in crate::report) x: Scale,
    pub(in crate::report) y: Scale,
    /// True: points without a value stand above the frame.
    pub(super) lane: bool,
    /// Greatest distance from the origin of a plane; 0 elsewhere.
    pub(super) reach: f64,
}

impl Frame {
    pub(super) fn x(&self, value: f64) -> f64 {
        self.left + self.x.place_on_axis(value) * self.width
    }

    pub(super) fn y(&self, value: f64) -> f64 {
        self.top + (1.0 - self.y.place_on_axis(value)) * self.height
    }

    /// Where a marked point stands: in the lane where it has no value or one beyond the
    /// frame; `None`: nowhere.
    pub(super) fn spot(&self, (x, y): (f64, f64)) -> Option<[f64; 2]> {
        let (x, share) = (self.x(x), self.y.place_on_axis(y));
        let lane = (self.lane && is_beyond(share)).then_some(self.top - 0.5 * LANE);
        let inside = self.top + (1.0 - share) * self.height;
        let inside = share.is_finite().then_some(inside);
        let y = lane.or(inside)?;
        x.is_finite().then_some([x, y])
    }
}

/// True of what stands above the frame, or has no place on its axis.
pub(super) fn is_beyond(share: f64) -> bool {
    share.is_nan() || share > 1.0
}

/// A name in the legend.
pub(in crate::report) struct Entry {
    /// Sample that is drawn beside it, 26 pixels wide about a middle line at 0.
    pub(super) sample: String,
    pub(super) text: String,
    /// The series that it switches.
    pub(super) series: Option<usize>,
}

impl Entry {
    /// A name that switches nothing.
    pub(in crate::report) fn new(sample: String, text: String) -> Self {
        Self {
            sample,
            text,
            series: None,
        }
    }

    fn room_beside_axis(&self) -> f64 {
        46.0 + width_of(&self.text)
    }
}

/// Entries side by side between two places in x, in as many rows as they need, and the height
/// of all rows. An entry that is wider than a row is shortened.
pub(in crate::report) fn rows(
    entries: Vec<Entry>,
    [left, right]: [f64; 2],
    top: f64,
) -> (String, f64) {
    let (mut out, mut x, mut row) = (String::new(), left, 0u32);
    let any = !entries.is_empty();
    for mut entry in entries {
        let most = characters_per_line(right - left - 40.0, 12.2);
        let whole = std::mem::take(&mut entry.text);
        entry.text = shortened(&whole, most);
        let room = entry.room_beside_axis();
        if x > left && x + room - 12.0 > right {
            (x, row) = (left, row + 1);
        }
        let series = match entry.series {
            Some(series) => format!(" data-series=\"{series}\""),
            None => String::new(),
        };
        out.push_str(&format!(
            "<g class=\"entry\" data-room=\"{}\"{series} transform=\"translate({} {})\">{}\
             <text x=\"33\" y=\"4\">{}</text><title>{}</title></g>\n",
            coordinate(room),
            coordinate(x),
            coordinate(top + ROW * f64::from(row)),
            entry.sample,
            symbols(&escape(&entry.text), Setting::Picture),
            escape(&whole)
        ));
        x += room;
    }
    (out, if any { ROW * f64::from(row + 1) } else { 0.0 })
}

impl Plot {
    /// The frame in a picture of this size, and the legend above it.
    pub(super) fn layout(&self, width: f64, height: f64) -> (Frame, String) {
        let left = self.left();
        let lane = self.needs_lane();
        let (legend, legend_height) =
            rows(self.legend_entries(), [left, width - RIGHT], HEAD + 8.0);
        let lane_height = if lane { LANE } else { 0.0 };
        let top = HEAD + legend_height + lane_height;
        let foot = match (self.plane, self.has_strip()) {
            (true, _) => 8.0,
            (_, true) => FOOT + STRIP,
            _ => FOOT,
        };
        let place = [
            left,
            top,
            width - left - RIGHT,
            (height - top - foot).max(40.0),
        ];
        (self.frame(place), legend)
    }

    /// The frame at a place: left, top, width, height.
    pub(in crate::report) fn frame(&self, [left, top, width, height]: [f64; 4]) -> Frame {
        let (mut x, mut y) = (self.x_range(), self.y_range());
        let mut reach = 0.0;
        if self.plane {
            reach = self.height_needed();
            let half = (0.5 * width.min(height) - 20.0).max(10.0);
            let [a, b] = [0.5 * width / half, 0.5 * height / half].map(|share| share * reach);
            (x, y) = ([-a, a], [-b, b]);
        }
        let strips = self.bands.iter().filter(|band| band.series.is_some());
        let strips = strips.count();
        if strips > 0 {
            y[0] -= (y[1] - y[0]) * (BAND * strips as f64 + 2.0) / height;
        }
        if !self.phases.is_empty() && !self.y.log {
            y[1] += (y[1] - y[0]) * NAMES / height;
        }
        Frame {
            left,
            top,
            width,
            height,
            x: Scale::new(&self.x, x),
            y: Scale::new(&self.y, y),
            lane: self.needs_lane(),
            reach,
        }
    }

    /// Whether a field lies under the frame as a strip.
    pub(super) fn has_strip(&self) -> bool {
        self.field.as_ref().is_some_and(|field| field.strip)
    }

    /// Room for the labels of the vertical axis.
    fn left(&self) -> f64 {
        if self.plane {
            return 20.0;
        }
        let scale = Scale::new(&self.y, self.y_range());
        let mut labels = scale.ticks(240.0, 30.0);
        // A high chart marks more than decades: 5·10⁻¹.
        if self.y.log {
            labels.extend(scale.ticks(600.0, 30.0));
        }
        let widest = labels.iter().map(|tick| width_of(&tick.label));
        let widest = widest.fold(width_of(&self.lane), f64::max);
        let named = if self.y.name.is_empty() { 0.0 } else { 20.0 };
        (widest + 16.0 + named).max(52.0)
    }

    fn points(&self) -> impl Iterator<Item = (f64, f64)> + '_ {
        self.series.iter().flat_map(|s| s.points.iter().copied())
    }

    fn needs_lane(&self) -> bool {
        let beyond = |y: f64| !y.is_finite() || self.y.ceiling.is_some_and(|most| y > most);
        let marked = self.series.iter().filter(|series| !series.marks.is_empty());
        let mut points = marked.flat_map(|series| &series.points);
        !self.lane.is_empty() && points.any(|point| beyond(point.1))
    }

    fn height_needed(&self) -> f64 {
        let sizes = self.points().map(|(x, y)| x.hypot(y));
        let greatest = sizes.filter(|size| size.is_finite()).fold(0.0, f64::max);
        if greatest == 0.0 {
            return 1.0;
        }
        let rings = ticks(0.0, greatest, 4);
        rings.values.iter().copied().fold(greatest, f64::max)
    }

    pub(super) fn x_range(&self) -> [f64; 2] {
        if let Some(range) = self.x.range {
            return range;
        }
        if let Some(field) = &self.field {
            return [field.x.first(), field.x.last()].map(|x| x.copied().unwrap_or(0.0));
        }
        let marked = self.series.iter().any(|series| !series.marks.is_empty());
        let upright = self.rules.iter().filter(|rule| rule.upright);
        let all = self.points().map(|point| point.0);
        let all = all.chain(upright.map(|rule| rule.at));
        match self.x.log {
            true => {
                let [low, high] = range(all.filter(|x| *x > 0.0).map(f64::log10));
                let room = (0.04 * (high - low)).max(0.1);
                [low - room, high + room].map(|power| 10f64.powf(power))
            }
            false => padded(range(all), if marked { 0.03 } else { 0.0 }),
        }
    }

    pub(super) fn y_range(&self) -> [f64; 2] {
        if let Some(range) = self.y.range {
            return range;
        }
        if !self.y.rows.is_empty() {
            return [self.y.rows.len() as f64, 0.0];
        }
        if let Some(field) = self.field.as_ref().filter(|field| !field.strip) {
            return [field.y.first(), field.y.last()].map(|y| y.copied().unwrap_or(0.0));
        }
        let rules = self.rules.iter().filter(|rule| !rule.upright);
        let values = self.points().map(|point| point.1);
        let values = values.chain(rules.map(|rule| rule.at));
        if !self.y.log {
            return padded(range(values), MARGIN);
        }
        let ceiling = self.y.ceiling.unwrap_or(f64::INFINITY);
        let values = values.filter(|y| *y > 0.0);
        let [low, high] = range(values.map(|y| y.min(ceiling).log10()));
        let [low, high] = [(low - 0.15).floor(), (high + 0.05).ceil()];
        [low, high.max(low + 1.0)].map(|power| 10f64.powf(power))
    }

    /// Everything that has a name: series, bands, lines, what is shaded, kinds of cells.
    pub(super) fn legend_entries(&self) -> Vec<Entry> {
        let mut list = Vec::new();
        let mut add = |sample: String, text: &str, series: Option<usize>| {
            if !text.is_empty() {
                let text = text.to_owned();
                list.push(Entry {
                    sample,
                    text,
                    series,
                });
            }
        };
        for (index, series) in self.series.iter().enumerate() {
            add(sample(series, index), &series.label, Some(index));
        }
        for band in &self.bands {
            let class = "<rect class=\"open\" width=\"26\" height=\"12\" y=\"-6\"/>";
            add(class.to_owned(), &band.label, None);
        }
        for rule in &self.rules {
            let line = "<path class=\"rule\" d=\"M0 0h26\"/>";
            add(line.to_owned(), &rule.label, None);
        }
        if let Some((_, label)) = &self.below {
            let swatch = "<rect class=\"below\" width=\"26\" height=\"12\" y=\"-6\"/>";
            add(swatch.to_owned(), label, None);
        }
        if let Some(field) = &self.field {
            list.extend(field.legend_entries());
        }
        list
    }
}

/// A piece of a series as its entry in the legend shows it.
fn sample(series: &Series, index: usize) -> String {
    let style = palette::style(series.style.unwrap_or(index));
    let line = match series.look {
        LineStyle::Points => String::new(),
        look => format!("<path {} d=\"M0 0h26\"/>", stroke(series, look, style)),
    };
    // As most of its marks are: filled, where one is.
    let has = |shape| series.marks.iter().any(|mark| mark.shape == shape);
    let shape = match () {
        () if has(Shape::Good) || has(Shape::AtMost) => Shape::Good,
        () if has(Shape::Open) => Shape::Open,
        () if series.look == LineStyle::Points => Shape::Good,
        () => Shape::None,
    };
    let index = series.style.unwrap_or(index);
    line + &marks::draw_mark([13.0, 0.0], index, shape, "", |_| None)
}

/// Class and dashes of a curve; one with marks is told apart by these.
pub(super) fn stroke(series: &Series, look: LineStyle, style: usize) -> String {
    if look == LineStyle::Theory {
        return format!("class=\"curve theory s{style}\"");
    }
    match palette::SERIES[style].2 {
        dash if !dash.is_empty() && series.marks.is_empty() => {
            format!("class=\"curve s{style}\" stroke-dasharray=\"{dash}\"")
        }
        _ => format!("class=\"curve s{style}\""),
    }
}

/// The ends of an axis for some values, with a margin; `None` of nothing.
pub(in crate::report) fn framed(values: impl Iterator<Item = f64>) -> Option<[f64; 2]> {
    let mut finite = values.filter(|value| value.is_finite()).peekable();
    finite.peek()?;
    Some(padded(range(finite), MARGIN))
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

impl Plot {
    /// The title, with the unit of the vertical axis where that has no name.
    pub(super) fn heading(&self, frame: &Frame) -> String {
        let unit = match self.y.name.is_empty() && !frame.y.unit.is_empty() {
            true => format!(", {}", frame.y.unit),
            false => String::new(),
        };
        let unit_of_plane = match self.plane && !frame.x.unit.is_empty() && unit.is_empty() {
            true => format!(", {}", frame.x.unit),
            false => unit,
        };
        let room = characters_per_line(frame.width + RIGHT - width_of(&unit_of_plane), 13.5);
        format!(
            "<text class=\"title\" x=\"{}\" y=\"18\">{}<tspan class=\"unit\">{}</tspan></text>\n",
            coordinate(frame.left),
            escape(&shortened(&self.title, room)),
            escape(&unit_of_plane)
        )
    }
}

/// Axes of a plane have one unit.
pub(in crate::report) fn plane(unit: &str) -> [Axis; 2] {
    [Axis::of(unit), Axis::of(unit)]
}
