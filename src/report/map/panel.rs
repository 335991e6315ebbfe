//! A panel of a map: its plot of cells or of a curve.

use super::style::{colour, hatching};
use super::values::Values;
use crate::math::contour::contours;
use crate::report::addresses::parameter_words;
use crate::report::plot::{Axis, Contour, Field, Kind, LineStyle, Mark, Plot, Rule, Series, Shape};
use crate::studies::axis::Axis as Parameter;
use crate::studies::map::{Cell, Study, Verdict};

/// Contour lines in a plot, about.
const LEVELS: usize = 6;
/// Marks of verdicts are drawn as long as there are fewer points than this.
const MOST_MARKS: usize = 120;

/// Panel of the picture.
pub(super) struct Panel<'a> {
    pub(super) study: &'a Study<'a>,
    pub(super) cells: &'a [Option<Cell>],
    pub(super) values: &'a Values,
}

impl Panel<'_> {
    fn cell(&self, column: usize, row: usize) -> Option<&Cell> {
        self.cells
            .get(row * self.study.columns() + column)?
            .as_ref()
    }

    pub(super) fn plot(&self, id: String) -> Plot {
        let study = self.study;
        let x = Grid::new(&study.x, &study.parameter_units[0]);
        match &study.y {
            Some(axis) => {
                let y = Grid::new(axis, &study.parameter_units[1]);
                Plot {
                    id,
                    title: String::new(),
                    field: Some(self.heat(&x, &y)),
                    x: x.axis,
                    y: y.axis,
                    ..Plot::default()
                }
            }
            None => self.curve(id, x),
        }
    }

    /// Cells with their verdicts.
    fn field(&self, x: &Grid, y: &[f64]) -> Field {
        let verdict = |verdict: &Verdict| Kind {
            name: verdict.words().to_owned(),
            colour: colour(*verdict),
            hatching: hatching(*verdict),
        };
        Field {
            x: x.edges.clone(),
            y: y.to_vec(),
            kinds: Verdict::ALL.iter().map(verdict).collect(),
            fill: (self.cells.iter())
                .map(|cell| Some(colour(cell.as_ref()?.verdict)))
                .collect(),
            kind: (self.cells.iter())
                .map(|cell| cell.as_ref().map(|cell| number(cell.verdict)))
                .collect(),
            ..Field::default()
        }
    }

    fn heat(&self, x: &Grid, y: &Grid) -> Field {
        let rings = self.cells.iter().enumerate();
        let rings = rings.filter(|(_, cell)| undetermined(cell.as_ref()));
        Field {
            lines: self.lines(x, y),
            rings: rings.map(|(index, _)| index).collect(),
            middles: [x.middles.clone(), y.middles.clone()],
            borders: true,
            ..self.field(x, &y.edges)
        }
    }

    /// The edge of lift-off of the rigid mechanism, and the contour lines: those below zero
    /// apart from the others, since where the sign changes the logarithm says nothing.
    fn lines(&self, x: &Grid, y: &Grid) -> Vec<Contour> {
        let (columns, rows) = (x.middles.len(), y.middles.len());
        let placed = |lines: Vec<Vec<(f64, f64)>>| -> Vec<Vec<(f64, f64)>> {
            let place = |(column, row): (f64, f64)| {
                (x.interpolated_value(column), y.interpolated_value(row))
            };
            let line = |line: Vec<(f64, f64)>| line.into_iter().map(place).collect();
            lines.into_iter().map(line).collect()
        };
        let margin = |column: usize, row: usize| self.cell(column, row)?.rigid_margin;
        let mut all = vec![Contour {
            label: String::new(),
            parts: placed(contours(columns, rows, 0.0, &margin)),
            edge: true,
        }];
        for (level, label) in self.values.contour_levels(LEVELS) {
            let mut lines = Vec::new();
            for below in [false, true] {
                let field = |column: usize, row: usize| {
                    let value = self.cell(column, row)?.value?;
                    let own = !self.values.log || (value < 0.0) == below;
                    own.then(|| self.values.scaled(value))
                };
                if self.values.log || !below {
                    lines.extend(contours(columns, rows, self.values.scaled(level), &field));
                }
            }
            all.push(Contour {
                label,
                parts: placed(lines),
                edge: false,
            });
        }
        all
    }

    /// The figure over one parameter, its verdicts in a strip below.
    fn curve(&self, id: String, x: Grid) -> Plot {
        let few = self.cells.len() < MOST_MARKS;
        let y = self.values.axis();
        let floor = y.range.map_or(0.0, |range| range[0]);
        let (mut points, mut marks) = (Vec::new(), Vec::new());
        for (cell, &at) in self.cells.iter().zip(&x.middles) {
            let value = cell.as_ref().and_then(|cell| cell.value);
            // On a logarithmic axis the size is shown, and a zero stands on the floor.
            let shown = match self.values.log {
                true => value.map(|value| value.abs().max(floor)),
                false => value,
            };
            points.push((at, shown.unwrap_or(f64::NAN)));
            marks.push(Mark {
                shape: match cell {
                    Some(_) if undetermined(cell.as_ref()) => Shape::Ring,
                    Some(cell) if few => Shape::Kind(number(cell.verdict)),
                    _ => Shape::None,
                },
                note: String::new(),
            });
        }
        let field = Field {
            strip: true,
            ..self.field(&x, &[0.0, 1.0])
        };
        let edges = self.rigid_edges(&x).into_iter().map(Rule::upright);
        Plot {
            id,
            rules: edges.collect(),
            series: vec![Series {
                marks,
                look: LineStyle::Line,
                ..Series::line("", points)
            }],
            x: x.axis,
            y,
            field: Some(field),
            ..Plot::default()
        }
    }

    /// Values at which the rigid mechanism would begin to lift off.
    fn rigid_edges(&self, x: &Grid) -> Vec<f64> {
        let margin = |column: usize| self.cell(column, 0)?.rigid_margin;
        let mut found = Vec::new();
        for column in 1..self.cells.len() {
            let Some((before, here)) = margin(column - 1).zip(margin(column)) else {
                continue;
            };
            if (before >= 0.0) != (here >= 0.0) {
                found.push(x.interpolated_value((column - 1) as f64 + before / (before - here)));
            }
        }
        found
    }
}

/// True where the figure of a cell is not known to the digits asked for.
pub(super) fn undetermined(cell: Option<&Cell>) -> bool {
    cell.is_some_and(|cell| cell.determined == Some(false))
}

/// A verdict's place among all.
pub(super) fn number(verdict: Verdict) -> usize {
    let place = Verdict::ALL.iter().position(|one| *one == verdict);
    place.unwrap_or(0)
}

/// A parameter with the middles and edges of its cells, as values of the axis.
struct Grid {
    axis: Axis,
    middles: Vec<f64>,
    edges: Vec<f64>,
}

impl Grid {
    fn new(parameter: &Parameter, unit: &str) -> Self {
        let log = parameter.log;
        let space = |value: f64| if log { value.abs().log10() } else { value };
        let back = |place: f64| if log { 10f64.powf(place) } else { place };
        let places: Vec<f64> = parameter.values().into_iter().map(space).collect();
        let last = places.len() - 1;
        let mut edges = vec![1.5 * places[0] - 0.5 * places[1]];
        edges.extend(places.windows(2).map(|pair| 0.5 * (pair[0] + pair[1])));
        edges.push(1.5 * places[last] - 0.5 * places[last - 1]);
        let edges: Vec<f64> = edges.into_iter().map(back).collect();
        let own = !parameter.unit.is_empty();
        let unit = if own { parameter.unit.as_str() } else { unit };
        let axis = Axis {
            log,
            // Prefixes suit SI units only; a unit of the user's own stays as it is.
            fixed: own,
            range: edges
                .first()
                .copied()
                .zip(edges.last().copied())
                .map(|(a, b)| [a, b]),
            ..Axis::new(&parameter_words(&parameter.path), unit)
        };
        Self {
            axis,
            middles: places.into_iter().map(back).collect(),
            edges,
        }
    }

    /// The value at a place between the middles, counted in cells.
    fn interpolated_value(&self, at: f64) -> f64 {
        let low = (at as usize).min(self.middles.len() - 2);
        let (a, b, part) = (self.middles[low], self.middles[low + 1], at - low as f64);
        match self.axis.log {
            true => (a.ln() + part * (b.ln() - a.ln())).exp(),
            false => a + part * (b - a),
        }
    }
}
