//! A chart as a picture.

use super::frame::{BAND, Frame, STRIP, is_beyond, stroke};
use super::{LineStyle, Plot, Series, Shape, coordinate, document, marks, palette, phases};
use std::fmt::Write as _;

/// What is drawn of the curves of a chart.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub(super) enum Curves {
    /// All of them.
    Drawn,
    /// Nothing: the script has their numbers, and draws them as soon as it runs.
    Left,
}

impl Plot {
    /// The picture, `width` × `height` pixels, as a complete SVG document.
    pub fn svg(&self, width: f64, height: f64) -> String {
        let (width, height) = (width.max(160.0), height.max(140.0));
        let body = self.whole_chart(width, height, 0, Curves::Drawn);
        document(
            "dam-plot",
            [width, height],
            &self.title,
            palette::STYLE,
            &body,
        )
    }

    /// The chart with title and legend, number `index` of its document.
    pub(super) fn whole_chart(
        &self,
        width: f64,
        height: f64,
        index: usize,
        curves: Curves,
    ) -> String {
        let (frame, legend) = self.layout(width, height);
        format!(
            "<g class=\"plot\" data-plot=\"{index}\" data-frame=\"{}\">\n{}<g class=\"legend\">{legend}</g>\n{}</g>\n",
            frame.pixel_box(),
            self.heading(&frame),
            self.draw_inside_frame(&frame, index, curves)
        )
    }

    /// The chart in a frame of a sheet of several.
    pub(in crate::report) fn panel(&self, frame: &Frame, head: &str, index: usize) -> String {
        format!(
            "<g class=\"plot\" data-plot=\"{index}\" data-frame=\"{}\">\n{head}{}</g>\n",
            frame.pixel_box(),
            self.draw_inside_frame(frame, index, Curves::Drawn)
        )
    }

    fn draw_inside_frame(&self, frame: &Frame, index: usize, drawn: Curves) -> String {
        let [x, y, w, h] = [frame.left, frame.top, frame.width, frame.height].map(coordinate);
        let strip = if self.has_strip() { STRIP } else { 0.0 };
        let (field, labels) = match &self.field {
            Some(field) => field.draw(frame),
            None => Default::default(),
        };
        let curves: String = (self.series.iter().enumerate())
            .map(|(index, series)| curve(series, frame, index, drawn))
            .collect();
        let marks: String = (self.series.iter().enumerate())
            .map(|(index, series)| self.marks(series, frame, index))
            .collect();
        let solid = self.field.as_ref().is_some_and(|field| !field.strip);
        let border = match solid {
            true => format!("<path class=\"axis\" d=\"M{x} {y}h{w}v{h}h-{w}z\"/>"),
            false => String::new(),
        };
        format!(
            "<g class=\"grid\">{grid}</g>\n\
             <clipPath id=\"clip-{index}\"><rect x=\"{x}\" y=\"{y}\" width=\"{w}\" height=\"{h}\"/></clipPath>\n\
             <g class=\"field\"{clip}>{field}</g>\n<g class=\"inside\" clip-path=\"url(#clip-{index})\">\n\
             {phases}{ground}{curves}</g>\n<g class=\"points\">{marks}</g>\n\
             <g class=\"labels\">{labels}</g>{border}\n\
             <rect class=\"pad\" x=\"{x}\" y=\"{y}\" width=\"{w}\" height=\"{all}\" fill=\"none\" \
             pointer-events=\"all\"/>\n",
            grid = self.grid(frame),
            clip = match solid {
                true => format!(" clip-path=\"url(#clip-{index})\""),
                false => String::new(),
            },
            phases = phases::draw_phases(&self.phases, frame),
            ground = self.draw_background(frame),
            all = coordinate(frame.height + strip),
        )
    }

    /// Shaded parts and lines across the frame.
    fn draw_background(&self, frame: &Frame) -> String {
        let mut out = String::new();
        let foot = frame.top + frame.height;
        let strips = self.bands.iter().filter(|band| band.series.is_some());
        let strips = strips.count();
        let mut strip = 0;
        for band in &self.bands {
            let (top, height, look) = match band.series {
                None => (frame.top, frame.height, "class=\"open\"".to_owned()),
                Some(series) => {
                    strip += 1;
                    let top = foot - BAND * (strips + 1 - strip) as f64;
                    let style = palette::style(series);
                    (
                        top,
                        BAND - 1.0,
                        format!("class=\"f{style}\" opacity=\".55\""),
                    )
                }
            };
            let path = shaded(frame, &band.spans, [top, height]);
            let _ = writeln!(out, "<path {look} data-band=\"\" d=\"{path}\"/>");
        }
        if let Some((value, _)) = &self.below {
            let y = frame.y(*value).clamp(frame.top, foot);
            let _ = writeln!(
                out,
                "<path class=\"below\" d=\"M{} {}h{}V{}h-{}z\"/>",
                coordinate(frame.left),
                coordinate(y),
                coordinate(frame.width),
                coordinate(foot),
                coordinate(frame.width)
            );
        }
        for rule in &self.rules {
            let path = match rule.upright {
                true => format!(
                    "M{} {}v{}",
                    coordinate(frame.x(rule.at)),
                    coordinate(frame.top),
                    coordinate(frame.height)
                ),
                false => format!(
                    "M{} {}h{}",
                    coordinate(frame.left),
                    coordinate(frame.y(rule.at)),
                    coordinate(frame.width)
                ),
            };
            if !path.contains("NaN") {
                let _ = writeln!(out, "<path class=\"rule\" d=\"{path}\"/>");
            }
        }
        out
    }

    fn marks(&self, series: &Series, frame: &Frame, index: usize) -> String {
        let style = series.style.unwrap_or(index);
        let kinds = self.field.as_ref().map_or(&[][..], |field| &field.kinds);
        let colour = |kind: usize| kinds.get(kind).map(|kind| kind.colour);
        let mut out = format!("<g data-series=\"{index}\">");
        for (point, mark) in series.points.iter().zip(&series.marks) {
            if let Some(spot) = frame.spot(*point) {
                out.push_str(&marks::draw_mark(
                    spot, style, mark.shape, &mark.note, colour,
                ));
            } else if mark.shape != Shape::None {
                // The script counts on one mark a point.
                out.push_str("<g class=\"mark\" visibility=\"hidden\"></g>");
            }
        }
        let first = series.points.first().filter(|_| self.start);
        if let Some([x, y]) = first.and_then(|first| frame.spot(*first)) {
            let _ = write!(
                out,
                "<g class=\"mark\" transform=\"translate({} {})\"><title>first position</title>\
                 <circle class=\"first\" r=\"3.5\"/></g>",
                coordinate(x),
                coordinate(y)
            );
        }
        out + "</g>\n"
    }
}

impl Frame {
    /// Left, top, width and height (pixels), for the script.
    pub(super) fn pixel_box(&self) -> String {
        let [left, top, width, height] =
            [self.left, self.top, self.width, self.height].map(coordinate);
        format!("{left} {top} {width} {height}")
    }
}

/// Shaded intervals closer than this are drawn as one (pixels), as the script does.
const APART: f64 = 0.4;

/// Shaded intervals as a path; those that no pixel tells apart are one.
fn shaded(frame: &Frame, spans: &[[f64; 2]], [top, height]: [f64; 2]) -> String {
    let mut path = String::new();
    let mut put = |[a, b]: [f64; 2]| {
        let _ = write!(
            path,
            "M{} {}h{}v{}H{}z",
            coordinate(a),
            coordinate(top),
            coordinate((b - a).max(0.5)),
            coordinate(height),
            coordinate(a)
        );
    };
    let clamp = |at: f64| frame.left + frame.x.place_on_axis(at).clamp(0.0, 1.0) * frame.width;
    let mut last: Option<[f64; 2]> = None;
    for [a, b] in spans
        .iter()
        .map(|span| span.map(clamp))
        .filter(|[a, b]| b >= a)
    {
        match &mut last {
            Some([from, to]) if a >= *from && a - *to < APART => *to = to.max(b),
            _ => last.replace([a, b]).into_iter().for_each(&mut put),
        }
    }
    last.into_iter().for_each(put);
    path
}

fn curve(series: &Series, frame: &Frame, index: usize, drawn: Curves) -> String {
    let style = palette::style(series.style.unwrap_or(index));
    let look = stroke(series, series.look, style);
    let path = match (series.look, drawn) {
        (LineStyle::Points, _) | (_, Curves::Left) => String::new(),
        (_, Curves::Drawn) => path(series, frame),
    };
    format!("<path {look} data-series=\"{index}\" d=\"{path}\"/>\n")
}

/// The curve as a path; of samples denser than half pixels each half pixel
/// keeps its first, least, greatest and last.
fn path(series: &Series, frame: &Frame) -> String {
    let points = &series.points;
    let beside = |index: usize| {
        let mark = series.marks.get(index);
        mark.is_some_and(|mark| mark.shape.is_off_curve())
            || (frame.lane && is_beyond(frame.y.place_on_axis(points[index].1)))
    };
    let (mut out, mut pen_down, mut start) = (String::new(), false, 0);
    while start < points.len() {
        let column = |index: usize| (2.0 * frame.x(points[index].0)).floor();
        let mut end = start;
        while end + 1 < points.len() && column(end + 1) == column(start) {
            end += 1;
        }
        for index in thinned_indices(points, start, end) {
            let (x, y) = (frame.x(points[index].0), frame.y(points[index].1));
            if !(x.is_finite() && y.is_finite()) || beside(index) {
                pen_down = false;
                continue;
            }
            let (x, y) = (coordinate(x), coordinate(y));
            let _ = match (pen_down, series.look) {
                (false, _) => write!(out, "M{x} {y}"),
                (true, LineStyle::Steps) => write!(out, "H{x}V{y}"),
                (true, _) => write!(out, "L{x} {y}"),
            };
            pen_down = true;
        }
        start = end + 1;
    }
    out
}

/// First, least, greatest and last of a stretch, in order, without repetition;
/// all of it where something is not finite.
fn thinned_indices(points: &[(f64, f64)], start: usize, end: usize) -> Vec<usize> {
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
