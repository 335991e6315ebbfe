//! The charts of a page and their data, as compact JSON for `plot.js`.

use super::draw::Curves;
use super::frame::{Frame, plane};
use super::{Axis, LineStyle, Plot, Shape, coordinate};
use crate::report::display_units::DisplayUnits;
use crate::report::quantity::escape;
use serde_json::{Value, json};
use std::collections::BTreeMap;

/// Script that makes the charts of a page interactive.
pub(in crate::report) const SCRIPT: &str =
    concat!(include_str!("numbers.js"), include_str!("plot.js"));

/// Numbers of that script, which stand before the rest.
#[cfg(test)]
pub(super) const NUMBERS: &str = include_str!("numbers.js");

/// The charts of a page: their numbers once, however many of them show the same.
#[derive(Clone, Debug, Default)]
pub struct Plots {
    columns: Vec<Vec<Option<f64>>>,
    known: BTreeMap<Vec<u64>, usize>,
    plots: Vec<Value>,
    /// Number of the first chart: where several sets of charts stand on one page.
    first: usize,
    /// True: numbers keep all their digits, charts tell where their frames stand, and their curves
    /// are drawn by the script alone.
    live: bool,
}

/// Digits of numbers along the horizontal axis and of values: what a plot can show, in a third
/// of the bytes.
const PLACES: usize = 12;
const VALUES: usize = 9;

impl Plots {
    /// Charts that are given other numbers again and again: nothing is rounded. They are
    /// numbered from `first` on.
    #[cfg(feature = "live")]
    pub(in crate::report) fn live(first: usize) -> Self {
        Self {
            first,
            live: true,
            ..Self::default()
        }
    }

    /// The columns, and the charts as JSON.
    #[cfg(feature = "live")]
    pub(crate) fn columns_and_charts(&self) -> (&[Vec<Option<f64>>], &[Value]) {
        (&self.columns, &self.plots)
    }

    /// A chart of the page whose picture is there already.
    #[cfg(feature = "live")]
    pub(in crate::report) fn chart_of_known_picture(
        &mut self,
        plot: &Plot,
        [width, height]: [f64; 2],
        link: &str,
    ) {
        let (frame, _) = plot.layout(width, height);
        self.add(plot, &frame, link);
    }

    /// The style of a drawing, in its place on the page. The studio has the styles of all drawings
    /// in its own, and lets no other stand.
    pub(in crate::report) fn style(&self, style: &str) -> String {
        match self.live {
            true => String::new(),
            false => format!("<style>{style}</style>\n"),
        }
    }

    /// True where numbers are exchanged again and again.
    pub(in crate::report) fn is_live(&self) -> bool {
        self.live
    }

    /// Number of a column of values, added where it is new.
    pub(in crate::report) fn column(&mut self, values: &[f64], digits: usize) -> usize {
        let key: Vec<u64> = values.iter().map(|value| value.to_bits()).collect();
        if let Some(&known) = self.known.get(&key) {
            return known;
        }
        let live = self.live;
        let shown = |&v: &f64| {
            v.is_finite()
                .then(|| if live { v } else { rounded(v, digits) })
        };
        self.columns.push(values.iter().map(shown).collect());
        self.known.insert(key, self.columns.len() - 1);
        self.columns.len() - 1
    }

    /// Number of a column of instants or angles.
    pub(in crate::report) fn places(&mut self, values: &[f64]) -> usize {
        self.column(values, PLACES)
    }

    /// A chart of the page, this large as long as nothing scales it. Charts with the same
    /// `link` are zoomed together.
    pub fn figure(&mut self, plot: &Plot, [width, height]: [f64; 2], link: &str) -> String {
        let index = self.first + self.plots.len();
        let (frame, _) = plot.layout(width, height);
        let curves = match self.live {
            true => Curves::Left,
            false => Curves::Drawn,
        };
        let body = plot.whole_chart(width, height, index, curves);
        self.add(plot, &frame, link);
        let (w, h) = (coordinate(width), coordinate(height));
        format!(
            "<div class=\"chart\"><svg class=\"dam-plot\" data-fluid=\"\" viewBox=\"0 0 {w} {h}\" \
             role=\"group\" aria-label=\"{}\">\n{body}</svg></div>\n",
            escape(&plot.title)
        )
    }

    /// A chart that stands in a frame of a sheet: its number on the page.
    pub(in crate::report) fn add(&mut self, plot: &Plot, frame: &Frame, link: &str) -> usize {
        let series: Vec<Value> = plot.series.iter().map(|one| self.series(one)).collect();
        let axis = |axis: &Axis, ends: [f64; 2]| {
            json!({ "name": axis.name, "unit": axis.unit, "log": axis.log, "ends": ends,
                    "fixed": axis.fixed, "rows": axis.rows })
        };
        let free =
            plot.plane || plot.x.log || plot.y.log || plot.field.is_some() || runs_back(plot);
        let mut value = json!({
            "id": plot.id,
            "title": plot.title,
            "link": link,
            "x": axis(&plot.x, frame.x.ends),
            "y": axis(&plot.y, frame.y.ends),
            "both": free,
            "series": series,
            "bands": plot.bands.iter().map(|band| band.spans.clone()).collect::<Vec<_>>(),
            "rules": plot.rules.iter().map(|rule| (rule.at, rule.upright)).collect::<Vec<_>>(),
        });
        if plot.plane {
            value["plane"] = json!(plot.free_direction(frame));
        }
        if self.live {
            value["frame"] = json!(frame.pixel_box());
        }
        if plot.start {
            value["start"] = json!(true);
        }
        if let Some((below, _)) = plot.below {
            value["below"] = json!(below);
        }
        if !plot.phases.is_empty() {
            let ends = plot.phases.iter().map(|phase| [phase.from, phase.to]);
            value["phases"] = json!(ends.collect::<Vec<_>>());
        }
        if !plot.lane.is_empty() {
            value["lane"] = json!(plot.lane);
        }
        if let Some(field) = &plot.field {
            value["field"] = json!({
                "x": field.x, "y": field.y, "strip": field.strip, "notes": field.notes,
            });
        }
        self.plots.push(value);
        self.first + self.plots.len() - 1
    }

    fn series(&mut self, series: &super::Series) -> Value {
        let [x, y]: [Vec<f64>; 2] = [
            series.points.iter().map(|point| point.0).collect(),
            series.points.iter().map(|point| point.1).collect(),
        ];
        let mut value = json!({
            "label": series.label,
            "x": self.column(&x, PLACES),
            "y": self.column(&y, VALUES),
        });
        if series.look == LineStyle::Steps {
            value["steps"] = json!(true);
        }
        if series.look == LineStyle::Points {
            value["bare"] = json!(true);
        }
        if !series.marks.is_empty() {
            // 0: not marked; 1: on the curve; 2: beside it.
            let place = |mark: &super::Mark| match mark.shape {
                Shape::None => 0,
                shape => 1 + u8::from(shape.is_off_curve()),
            };
            value["marks"] = json!(series.marks.iter().map(place).collect::<Vec<_>>());
            let notes: Vec<&str> = series.marks.iter().map(|mark| mark.note.as_str()).collect();
            if notes.iter().any(|note| !note.is_empty()) {
                value["notes"] = json!(notes);
            }
        }
        value
    }

    /// The columns and the charts as JSON that cannot end the element it stands in.
    pub fn json(&self) -> String {
        let mut document = json!({ "columns": self.columns, "plots": self.plots });
        let units = DisplayUnits::units_of_thread();
        if !units.is_empty() {
            let units = units
                .into_iter()
                .map(|(si, name, size)| (si.to_owned(), json!([size, name])));
            document["units"] = units.collect::<serde_json::Map<_, _>>().into();
        }
        document.to_string().replace('<', "\\u003c")
    }
}

/// True where a curve runs back along the horizontal axis: values belong to points, not places.
fn runs_back(plot: &Plot) -> bool {
    let back = |series: &super::Series| {
        let finite = series.points.iter().map(|point| point.0);
        let places: Vec<f64> = finite.filter(|x| x.is_finite()).collect();
        let falls = places.windows(2).any(|pair| pair[1] < pair[0]);
        falls && places.windows(2).any(|pair| pair[1] > pair[0])
    };
    plot.series.iter().any(back)
}

/// A number with that many significant digits.
fn rounded(value: f64, digits: usize) -> f64 {
    format!("{:.*e}", digits - 1, value)
        .parse()
        .unwrap_or(value)
}

/// A chart of vectors about their origin.
pub(in crate::report) fn hodograph(title: &str, unit: &str, vectors: Vec<(f64, f64)>) -> Plot {
    let [x, y] = plane(unit);
    Plot {
        title: title.to_owned(),
        x,
        y,
        series: vec![super::Series::line("", vectors)],
        plane: true,
        start: true,
        ..Plot::default()
    }
}
