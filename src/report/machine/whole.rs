//! The whole machine in one picture: stations in columns along the flow of motion, joined by lines.
//!
//! A scene does not say where in the plane its objects are. A cam and its follower, and a linkage
//! and its crank, have their places to each other; every other object is a station beside them.

use super::station::{LINE, Station};
use crate::dynamics::model::{Model, OUTPUT, ObjectPart};
use crate::report::mechanism::marks::scale_bar;
use crate::report::plot::coordinate;
use crate::report::quantity::escape;
use std::collections::BTreeSet;
use std::fmt::Write as _;

/// Widest picture of a page; a longer chain goes on below (pixels).
const WIDEST: f64 = 1120.0;
/// Width of a canvas over its height.
const CANVAS: f64 = 1.9;
/// Distance of columns, of stations above each other, and of rows of columns (pixels).
const GUTTER: f64 = 44.0;
const GAP: f64 = 22.0;
const MARGIN: f64 = 14.0;
/// Least width of a station: its captions have room (pixels).
const NARROWEST: f64 = 238.0;
/// Height of a scale bar below its picture (pixels).
const BAR: f64 = 18.0;
/// Largest picture to scale beside others, and the size below which nothing is seen (pixels).
const BESIDE: [f64; 2] = [500.0, 420.0];
const LEAST: f64 = 130.0;

/// Most pixels a metre of every object that is drawn: what is to scale is so to one scale, unless
/// the smallest could not be seen then.
pub(super) fn scales(stations: &[Station], objects: usize) -> Vec<f64> {
    let mut most = vec![f64::INFINITY; objects];
    let to_scale: Vec<(usize, f64, [f64; 2])> = stations
        .iter()
        .filter_map(|one| Some((one.column, one.picture.scale?, one.picture.size)))
        .collect();
    if stations.len() < 2 {
        return most;
    }
    let fitting = |scale: f64, [wide, high]: [f64; 2]| {
        scale * (BESIDE[0] / wide).min(BESIDE[1] / high).min(1.0)
    };
    let all = to_scale
        .iter()
        .map(|&(_, scale, size)| fitting(scale, size));
    let common = all.fold(f64::INFINITY, f64::min);
    let seen = |&(_, scale, [wide, high]): &(usize, f64, [f64; 2])| {
        wide.max(high) * common / scale >= LEAST
    };
    let one_scale = to_scale.iter().all(seen);
    for &(column, scale, size) in &to_scale {
        most[column] = if one_scale {
            common
        } else {
            fitting(scale, size)
        };
    }
    most
}

/// Where a picture is shown.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub(in crate::report) enum Room {
    /// On a page, as high as it needs.
    Page,
    /// On a canvas that shows all of it at once.
    #[cfg(feature = "live")]
    Canvas,
}

/// A station with its place.
#[derive(Clone)]
struct Cell<'a> {
    station: &'a Station,
    /// Number of its first part.
    first: usize,
    /// Stations that are shown in its picture and have their caption below it.
    shown: Vec<&'a Station>,
    /// What drives it.
    wires: Vec<Wire>,
    column: usize,
    at: [f64; 2],
    /// The lane that leads to it: left of its column and above its row (pixels).
    lane: [f64; 2],
}

/// Line along which motion comes to a cell.
#[derive(Clone, Debug)]
struct Wire {
    /// The cell that it comes from.
    from: usize,
    /// Id of the output that it comes from, where it is one of several.
    output: Option<String>,
    /// Number of the input that it leads to.
    input: usize,
}

/// What drives an object: the object that is drawn, and the output of it.
#[derive(Clone, Debug)]
struct Driver {
    object: usize,
    output: Option<String>,
    input: usize,
}

impl Cell<'_> {
    fn bar(&self) -> f64 {
        self.station.picture.scale.map_or(0.0, |_| BAR)
    }

    fn size(&self) -> [f64; 2] {
        let [wide, high] = self.station.picture.size;
        let lines = 2.0 * LINE * (1 + self.shown.len()) as f64;
        [wide.max(NARROWEST), high + self.bar() + lines + 6.0]
    }

    /// A pixel of its picture in the whole one.
    fn pixel(&self, [x, y]: [f64; 2]) -> [f64; 2] {
        [self.at[0] + x, self.at[1] + y]
    }
}

/// The drawn objects that drive each of them, linkages standing for their outputs.
fn drivers(model: &Model, drawn: &[&ObjectPart]) -> Vec<Vec<Driver>> {
    let place = |id: &str| drawn.iter().position(|one| one.id == id);
    let driver = |(input, object): (usize, usize)| {
        let first = &model.objects[object];
        let output = (first.kind == OUTPUT).then(|| first.id.clone());
        let mut object = object;
        while model.objects[object].kind == OUTPUT {
            match model.objects[object].driver() {
                Some(next) => object = next,
                None => break,
            }
        }
        let object = place(&model.objects[object].id)?;
        Some(Driver {
            object,
            output,
            input,
        })
    };
    let of = |part: &&ObjectPart| {
        let inputs = part.inputs.iter().map(|one| one.driver).enumerate();
        inputs.filter_map(driver).collect()
    };
    drawn.iter().map(of).collect()
}

/// All stations in their places.
pub(super) struct Whole<'a> {
    cells: Vec<Cell<'a>>,
    size: [f64; 2],
}

impl<'a> Whole<'a> {
    /// Stations of objects that are drawn; `firsts`: the number of the first part of each.
    pub(super) fn of(
        model: &Model,
        drawn: &[&ObjectPart],
        stations: &'a [Station],
        firsts: &[usize],
        room: Room,
    ) -> Self {
        let cells = cells((stations, firsts), &drivers(model, drawn));
        let placed = |widest: f64| {
            let mut cells = cells.clone();
            let size = place_cells(&mut cells, widest);
            Self { cells, size }
        };
        if room == Room::Page {
            return placed(WIDEST);
        }
        // Of all ways to break the columns into rows the one that a canvas shows largest.
        let columns = cells.iter().map(|cell| cell.column + 1).max().unwrap_or(0);
        let scale = |one: &Self| (CANVAS / one.size[0]).min(1.0 / one.size[1]);
        let ways = (1..=columns).map(|count| placed(width_of(&cells, count)));
        ways.reduce(|best, one| {
            if scale(&one) > scale(&best) {
                one
            } else {
                best
            }
        })
        .unwrap_or_else(|| placed(WIDEST))
    }

    /// Every station that is drawn, with the number of its first part and its place.
    pub(super) fn placed_stations(
        &self,
    ) -> impl Iterator<Item = (&'a Station, usize, [f64; 2])> + '_ {
        let cells = self.cells.iter();
        cells.map(|cell| (cell.station, cell.first, cell.at))
    }

    /// The picture; `delta`: the greatest deflection of an object; `above`: what lies upon it.
    pub(super) fn html(&self, delta: impl Fn(&str) -> f64, above: &str) -> String {
        let mut out = String::new();
        for cell in &self.cells {
            for wire in &cell.wires {
                out.push_str(&connecting_line(&self.cells[wire.from], cell, wire));
            }
        }
        for cell in &self.cells {
            out.push_str(&content(cell, &delta));
        }
        let [w, h] = self.size.map(coordinate);
        format!(
            "<div class=\"stations\">\n<svg class=\"mechanism\" viewBox=\"0 0 {w} {h}\" width=\"{w}\" \
             height=\"{h}\" role=\"group\" aria-label=\"the machine moving\">\n{out}{above}</svg>\n</div>\n"
        )
    }
}

/// The stations that are drawn: a drive that all it drives shows in their pictures is none.
fn cells<'a>(
    (stations, firsts): (&'a [Station], &[usize]),
    drivers: &[Vec<Driver>],
) -> Vec<Cell<'a>> {
    let of = |object: usize| stations.iter().filter(move |one| one.column == object);
    let driven = |object: usize| {
        let all = drivers.iter().enumerate();
        all.filter(move |(_, own)| own.iter().any(|one| one.object == object))
            .map(|(index, _)| index)
    };
    let shows = |object: usize| {
        of(object)
            .next()
            .is_some_and(|one| one.picture.shows_driver)
    };
    let is_within = |object: usize| {
        drivers[object].is_empty() && driven(object).next().is_some() && driven(object).all(shows)
    };
    let mut cells: Vec<Cell<'_>> = Vec::new();
    let mut captioned = BTreeSet::new();
    let numbered = stations.iter().zip(firsts);
    for (station, &first) in numbered.filter(|(one, _)| !is_within(one.column)) {
        let before = cells
            .iter()
            .position(|cell| cell.station.column == station.column);
        let last = |object: usize| cells.iter().rposition(|cell| cell.station.column == object);
        let wire = |one: &Driver| {
            Some(Wire {
                from: last(one.object)?,
                output: one.output.clone(),
                input: one.input,
            })
        };
        let wires: Vec<Wire> = match before {
            Some(law) => vec![Wire {
                from: law,
                output: None,
                input: 0,
            }],
            None => drivers[station.column].iter().filter_map(wire).collect(),
        };
        let within = drivers[station.column].iter().map(|one| one.object);
        let within = within.filter(|&one| is_within(one));
        let shown = within
            .filter(|_| before.is_none())
            .filter(|&one| captioned.insert(one));
        let shown = shown.flat_map(of).collect();
        let columns = wires.iter().map(|wire| cells[wire.from].column + 1);
        let column = columns.max().unwrap_or(0);
        cells.push(Cell {
            station,
            first,
            shown,
            wires,
            column,
            at: [0.0; 2],
            lane: [0.0; 2],
        });
    }
    cells
}

/// The room that each column takes.
fn column_sizes(cells: &[Cell<'_>]) -> Vec<[f64; 2]> {
    let columns = cells.iter().map(|cell| cell.column + 1).max().unwrap_or(0);
    let size = |column: usize| {
        let own = cells.iter().filter(|cell| cell.column == column);
        own.map(Cell::size)
            .fold([0.0, -GAP], |[wide, high], [w, h]| {
                [wide.max(w), high + h + GAP]
            })
    };
    (0..columns).map(size).collect()
}

/// Width of a picture whose first row has so many columns (pixels).
fn width_of(cells: &[Cell<'_>], count: usize) -> f64 {
    let sizes = column_sizes(cells);
    let wide = sizes.iter().take(count).map(|[wide, _]| wide + GUTTER);
    wide.sum::<f64>() - GUTTER + 2.0 * MARGIN
}

/// Gives every cell its place, columns from left to right in rows that are not wider than
/// `widest_row` where a single column is not (pixels); the size of all.
fn place_cells(cells: &mut [Cell<'_>], widest_row: f64) -> [f64; 2] {
    let sizes = column_sizes(cells);
    let columns = sizes.len();
    let (mut begin, mut top, mut widest) = (0, MARGIN, 0.0_f64);
    while begin < columns {
        let mut end = begin + 1;
        let wide = |end: usize| -> f64 {
            let all = sizes[begin..end].iter().map(|[w, _]| w + GUTTER);
            all.sum::<f64>() - GUTTER
        };
        while end < columns && wide(end + 1) + 2.0 * MARGIN <= widest_row {
            end += 1;
        }
        let high = sizes[begin..end]
            .iter()
            .map(|[_, h]| *h)
            .fold(0.0, f64::max);
        let mut left = MARGIN;
        for column in begin..end {
            let [w, h] = sizes[column];
            let mut y = top + 0.5 * (high - h);
            for cell in cells.iter_mut().filter(|cell| cell.column == column) {
                let [own, tall] = cell.size();
                cell.at = [left + 0.5 * (w - own), y];
                cell.lane = [left - 0.5 * GUTTER, top - 0.5 * GUTTER];
                y += tall + GAP;
            }
            left += w + GUTTER;
        }
        widest = widest.max(left - GUTTER);
        top += high + GUTTER;
        begin = end;
    }
    [widest + MARGIN, top - GUTTER + MARGIN]
}

/// The line along which motion goes from one cell to another, with a head before the second.
fn connecting_line(from: &Cell<'_>, to: &Cell<'_>, wire: &Wire) -> String {
    let [x0, y0] = from.pixel(from.station.picture.outlet(wire.output.as_deref()));
    let [x1, y1] = to.pixel(to.station.picture.inlet(wire.input));
    let before = to.lane[0].max(4.0);
    let beside = to.at[0] > from.at[0] && to.lane[1] <= from.lane[1];
    let mut line = format!("M{} {}", coordinate(x0), coordinate(y0));
    if !beside {
        // To a row below: right of its own, and above the other.
        let right = from.at[0] + from.size()[0] + 0.4 * GUTTER;
        let above = to.lane[1];
        let _ = write!(line, "H{}V{}", coordinate(right), coordinate(above));
    }
    let _ = write!(
        line,
        "H{}V{}H{}",
        coordinate(before),
        coordinate(y1),
        coordinate(x1)
    );
    let tip = to.at[0].min(x1) + 2.0;
    format!(
        "<path class=\"join\" d=\"{line}\"/><path class=\"join-barb\" d=\"M{} {}l-9 -4v8z\"/>\n",
        coordinate(tip),
        coordinate(y1)
    )
}

/// The picture of a cell with scale bar and captions.
fn content(cell: &Cell<'_>, delta: impl Fn(&str) -> f64) -> String {
    let first = cell.first;
    let picture = &cell.station.picture;
    let [x, y] = cell.at;
    let mut foot = y + picture.size[1];
    let mut out = format!(
        "<g data-first=\"{first}\" transform=\"translate({} {})\">\n{}</g>\n",
        coordinate(x),
        coordinate(y),
        picture.drawn
    );
    if let Some(scale) = picture.scale {
        out.push_str(&scale_bar(scale, [x + 2.0, foot + 6.0]));
        foot += BAR;
    }
    for station in cell.shown.iter().copied().chain([cell.station]) {
        out.push_str(&station.caption([x + 2.0, foot + LINE - 2.0], delta(&station.id)));
        foot += 2.0 * LINE;
    }
    // What is clicked anywhere in its place is the object.
    let [wide, high] = cell.size().map(coordinate);
    format!(
        "<g class=\"station\" data-object=\"{}\">\n<rect class=\"area\" x=\"{}\" y=\"{}\" \
         width=\"{wide}\" height=\"{high}\" fill=\"none\" pointer-events=\"all\"/>\n{out}</g>\n",
        escape(&cell.station.id),
        coordinate(x),
        coordinate(y)
    )
}
