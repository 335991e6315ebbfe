//! Coloured cells: heat maps with contour lines and kinds marked over them, rows of regions,
//! a strip of kinds under a curve.

use super::frame::{Entry, Frame, STRIP};
use super::palette::{OVER, OVER_LIGHT};
use super::{coordinate, width_of};
use crate::report::quantity::escape;
use std::collections::BTreeMap;
use std::fmt::Write as _;

/// Cells between edges, row by row from the lowest.
#[derive(Clone, Debug, Default, PartialEq)]
pub struct Field {
    /// Edges of the columns on the horizontal axis, one more than columns.
    pub x: Vec<f64>,
    /// Edges of the rows on the vertical axis, one more than rows.
    pub y: Vec<f64>,
    /// The colour of each cell.
    pub fill: Vec<Option<&'static str>>,
    /// The kind of each cell.
    pub kind: Vec<Option<usize>>,
    /// The kinds.
    pub kinds: Vec<Kind>,
    /// Contour lines.
    pub lines: Vec<Contour>,
    /// Cells with a ring upon them.
    pub rings: Vec<usize>,
    /// Middles of the cells along both axes, for rings.
    pub middles: [Vec<f64>; 2],
    /// Notes on the cells, shown when the pointer rests on one; may be empty.
    pub notes: Vec<String>,
    /// True: lines are drawn between cells of different kinds.
    pub borders: bool,
    /// True: one row, drawn as a strip under the frame.
    pub strip: bool,
    /// True: rows stand apart from one another.
    pub apart: bool,
    /// True: the kinds that occur stand in the legend.
    pub named: bool,
}

/// A kind of cell.
#[derive(Clone, Debug, Default, PartialEq)]
pub struct Kind {
    /// Name in the legend.
    pub name: String,
    /// Colour where there is none of values.
    pub colour: &'static str,
    /// Name of its hatching; empty: left plain.
    pub hatching: &'static str,
}

/// A line through values of the axes.
#[derive(Clone, Debug, Default, PartialEq)]
pub struct Contour {
    /// Label that stands on it; may be empty.
    pub label: String,
    /// Parts of the line.
    pub parts: Vec<Vec<(f64, f64)>>,
    /// True: an edge of the mechanism, heavily drawn.
    pub edge: bool,
}

/// Lines of fewer points carry no label.
const SHORT: usize = 5;

impl Field {
    fn columns(&self) -> usize {
        self.x.len().saturating_sub(1)
    }

    fn rows(&self) -> usize {
        self.y.len().saturating_sub(1)
    }

    fn at<T: Copy>(&self, list: &[Option<T>], column: usize, row: usize) -> Option<T> {
        *list.get(row * self.columns() + column)?
    }

    /// The kinds that occur.
    pub(super) fn legend_entries(&self) -> Vec<Entry> {
        if !self.named {
            return Vec::new();
        }
        let occurs = |index: &usize| self.kind.contains(&Some(*index));
        let entry = |index: usize| Entry {
            sample: swatch(self.kinds[index].colour, self.kinds[index].hatching),
            text: self.kinds[index].name.clone(),
            series: None,
        };
        (0..self.kinds.len()).filter(occurs).map(entry).collect()
    }

    /// Cells, and what stands above everything: labels of lines.
    pub(super) fn draw(&self, frame: &Frame) -> (String, String) {
        let mut out = String::new();
        if self.kinds.iter().any(|kind| !kind.hatching.is_empty()) {
            out.push_str(&patterns());
        }
        out.push_str("<g shape-rendering=\"crispEdges\">");
        for (fill, path) in self.runs(frame, &self.fill) {
            let _ = writeln!(out, "<path fill=\"{fill}\" d=\"{path}\"/>");
        }
        out.push_str("</g>\n");
        for (kind, path) in self.runs(frame, &self.kind) {
            let name = self.kinds.get(kind).map_or("", |kind| kind.hatching);
            if !name.is_empty() {
                let _ = writeln!(out, "<path fill=\"url(#{name})\" d=\"{path}\"/>");
            }
        }
        if self.borders {
            let _ = writeln!(
                out,
                "<path class=\"border\" d=\"{}\"/>",
                self.borders(frame)
            );
        }
        let mut taken: Vec<[f64; 4]> = Vec::new();
        let mut rings = String::new();
        for &cell in &self.rings {
            let place = |axis: usize, index: usize| self.middles[axis].get(index).copied();
            let (column, row) = (cell % self.columns(), cell / self.columns());
            if let Some((x, y)) = place(0, column).zip(place(1, row)) {
                let (x, y) = (frame.x(x), frame.y(y));
                let size =
                    (frame.width / self.columns() as f64).min(frame.height / self.rows() as f64);
                let radius = (0.24 * size).clamp(0.9, 4.5);
                taken.push([x - radius, x + radius, y - radius, y + radius]);
                let _ = write!(
                    rings,
                    "<circle class=\"ring\" r=\"{}\" transform=\"translate({} {})\"/>",
                    coordinate(radius),
                    coordinate(x),
                    coordinate(y)
                );
            }
        }
        // Labels stand clear of the edges of the mechanism, and of other lines where there is
        // such a place.
        for line in self.lines.iter().filter(|line| line.edge) {
            taken.extend(boxes_along_line(line, frame));
        }
        let mut labels = String::new();
        for (index, line) in self.lines.iter().enumerate() {
            let path: String = line
                .parts
                .iter()
                .map(|part| polyline(part, frame))
                .collect();
            if path.is_empty() {
                continue;
            }
            let [back, front] = if line.edge {
                ["edge-back", "edge"]
            } else {
                ["halo", "contour"]
            };
            let _ = writeln!(
                out,
                "<path class=\"{back}\" d=\"{path}\"/><path class=\"{front}\" d=\"{path}\"/>"
            );
            let others = self.lines.iter().enumerate();
            let others = others.filter(|(other, line)| *other != index && !line.edge);
            let others: Vec<[f64; 4]> = others
                .flat_map(|(_, line)| boxes_along_line(line, frame))
                .collect();
            labels.push_str(&label(line, frame, &mut taken, &others));
        }
        (out, rings + &labels)
    }

    /// Neighbouring cells of a row that are alike, as one path for each likeness.
    fn runs<K: Ord + Copy>(&self, frame: &Frame, list: &[Option<K>]) -> BTreeMap<K, String> {
        let mut paths: BTreeMap<K, String> = BTreeMap::new();
        for row in 0..self.rows() {
            let [foot, top] = match self.strip {
                true => [
                    frame.top + frame.height + STRIP - 3.0,
                    frame.top + frame.height + 5.0,
                ],
                false => [frame.y(self.y[row]), frame.y(self.y[row + 1])],
            };
            let gap = if self.apart { 0.12 * (foot - top) } else { 0.0 };
            let (foot, top) = (coordinate(foot - gap), coordinate(top + gap));
            let mut column = 0;
            while column < self.columns() {
                let (own, start) = (self.at(list, column, row), column);
                while column < self.columns() && self.at(list, column, row) == own {
                    column += 1;
                }
                let Some(own) = own else { continue };
                let (x, end) = (
                    coordinate(frame.x(self.x[start])),
                    coordinate(frame.x(self.x[column])),
                );
                let path = paths.entry(own).or_default();
                // Writing to a string cannot fail.
                let _ = write!(path, "M{x} {foot}H{end}V{top}H{x}z");
            }
        }
        paths
    }

    /// Lines between regions of different kinds.
    fn borders(&self, frame: &Frame) -> String {
        let kind = |column, row| self.at(&self.kind, column, row);
        let differ = |a: Option<usize>, b: Option<usize>| a.zip(b).is_some_and(|(a, b)| a != b);
        let (x, y) = (
            |at: usize| coordinate(frame.x(self.x[at])),
            |at: usize| coordinate(frame.y(self.y[at])),
        );
        let mut path = String::new();
        for row in 0..self.rows() {
            for column in 0..self.columns() {
                let own = kind(column, row);
                if column + 1 < self.columns() && differ(own, kind(column + 1, row)) {
                    let _ = write!(path, "M{} {}V{}", x(column + 1), y(row), y(row + 1));
                }
                if row + 1 < self.rows() && differ(own, kind(column, row + 1)) {
                    let _ = write!(path, "M{} {}H{}", x(column), y(row + 1), x(column + 1));
                }
            }
        }
        path
    }
}

fn polyline(part: &[(f64, f64)], frame: &Frame) -> String {
    let mut out = String::new();
    for (index, &(x, y)) in part.iter().enumerate() {
        let command = if index == 0 { 'M' } else { 'L' };
        let _ = write!(
            out,
            "{command}{} {}",
            coordinate(frame.x(x)),
            coordinate(frame.y(y))
        );
    }
    out
}

/// Small boxes along a line.
fn boxes_along_line(line: &Contour, frame: &Frame) -> Vec<[f64; 4]> {
    let mut found = Vec::new();
    for ends in line.parts.iter().flat_map(|part| part.windows(2)) {
        let [a, b] = [ends[0], ends[1]].map(|(x, y)| [frame.x(x), frame.y(y)]);
        let length = (b[0] - a[0]).hypot(b[1] - a[1]);
        let count = (length / 6.0).ceil().clamp(1.0, 200.0);
        for k in 0..=count as usize {
            let share = k as f64 / count;
            let [x, y] = [0, 1].map(|axis| a[axis] + share * (b[axis] - a[axis]));
            found.push([x - 3.0, x + 3.0, y - 3.0, y + 3.0]);
        }
    }
    found
}

/// Shares of a line at which its label is tried.
const SHARES: [f64; 11] = [0.5, 0.3, 0.7, 0.15, 0.85, 0.4, 0.6, 0.22, 0.78, 0.05, 0.95];

/// The label of a line on its longest part, where neither a ring nor another label nor an edge
/// stands; where it crosses none of the `others`, if there is such a place.
fn label(line: &Contour, frame: &Frame, taken: &mut Vec<[f64; 4]>, others: &[[f64; 4]]) -> String {
    let longest = line.parts.iter().max_by_key(|part| part.len());
    let Some(part) = longest.filter(|part| part.len() >= SHORT && !line.label.is_empty()) else {
        return String::new();
    };
    let half = 0.42 * width_of(&line.label);
    let place = |share: f64| {
        let (x, y) = part[(share * (part.len() - 1) as f64) as usize];
        let [left, top] = [frame.left + half, frame.top + 10.0];
        let x = frame.x(x).clamp(left, frame.left + frame.width - half);
        let y = frame.y(y).clamp(top, frame.top + frame.height - 6.0);
        (x, y, [x - half - 3.0, x + half + 3.0, y - 7.0, y + 7.0])
    };
    let free: Vec<_> = SHARES
        .map(place)
        .into_iter()
        .filter(|(.., own)| !taken.iter().any(|other| boxes_overlap(own, other)))
        .collect();
    let alone =
        |(.., own): &&(f64, f64, [f64; 4])| !others.iter().any(|other| boxes_overlap(own, other));
    let Some(&(x, y, own)) = free.iter().find(alone).or(free.first()) else {
        return String::new();
    };
    taken.push(own);
    format!(
        "<text class=\"level\" transform=\"translate({} {})\" dy=\"3.5\" text-anchor=\"middle\">{}</text>",
        coordinate(x),
        coordinate(y),
        escape(&line.label)
    )
}

/// Whether two boxes (left, right, top, foot) have a point in common.
fn boxes_overlap(a: &[f64; 4], b: &[f64; 4]) -> bool {
    a[0] < b[1] && b[0] < a[1] && a[2] < b[3] && b[2] < a[3]
}

/// A sample of a kind.
pub(in crate::report) fn swatch(ground: &str, hatching: &str) -> String {
    let rect = "width=\"26\" height=\"14\" y=\"-7\"";
    let over = match hatching {
        "" => String::new(),
        name => format!("<rect {rect} fill=\"url(#{name})\"/>"),
    };
    format!("<rect {rect} fill=\"{ground}\" class=\"sample\"/>{over}")
}

/// The hatchings. Lines are drawn dark and light side by side, so that they show on every
/// colour.
pub(in crate::report) fn patterns() -> String {
    let cross = "M-1 9L9 -1M-1 1L1 -1M7 9L9 7M-1 -1L9 9M7 -1L9 1M-1 7L1 9";
    let list = [
        ("dam-unjudged", 8.0, "M0 4H3"),
        ("dam-failed", 8.0, cross),
        ("dam-refused", 8.0, "M0 8L8 0"),
    ];
    let one = |(name, size, path): &(&str, f64, &str)| {
        format!(
            "<pattern id=\"{name}\" width=\"{size}\" height=\"{size}\" \
             patternUnits=\"userSpaceOnUse\"><path d=\"{path}\" fill=\"none\" stroke=\"{OVER}\" \
             stroke-opacity=\".38\" stroke-width=\"1.5\"/><path d=\"{path}\" fill=\"none\" \
             stroke=\"{OVER_LIGHT}\" stroke-opacity=\".55\" stroke-width=\".6\"/></pattern>\n"
        )
    };
    format!(
        "<defs>\n{}</defs>\n",
        list.iter().map(one).collect::<String>()
    )
}
