//! The linkage over the rows, as a drawing that moves.

use super::axis;
use super::endless::Endless;
use crate::report::mechanism::{Arrow, ArrowSet, Axis, Drawing, MOST_FRAMES, Path, Placement};
use crate::studies::kinematics::{Kinematics, Quantity};

/// The drawing with the paths of all points that are no pins of the ground, and
/// arrows of speed and acceleration.
pub fn drawing<'a>(found: &'a Kinematics) -> Drawing<'a> {
    let rows = thinned_indices(found.frames.len());
    with_rows(found, &rows)
}

/// The picture of one row, with the paths of all rows.
pub fn picture(found: &Kinematics, row: usize) -> String {
    let all: Vec<usize> = (0..found.frames.len()).collect();
    with_rows(found, &all).svg(row)
}

fn thinned_indices(count: usize) -> Vec<usize> {
    let stride = count.div_ceil(MOST_FRAMES).max(1);
    (0..count).step_by(stride).collect()
}

fn with_rows<'a>(found: &'a Kinematics, rows: &[usize]) -> Drawing<'a> {
    let points: Vec<MovingPoint<'_>> = points(found);
    let vectors = |x: &[f64], y: &[f64]| -> Vec<[f64; 2]> {
        rows.iter().map(|&row| [x[row], y[row]]).collect()
    };
    let set = |(name, unit): (&str, &str), shown: bool, (quantity, which): (Quantity, usize)| {
        let endless = Endless::of(found, |column| column.quantity == quantity);
        let vector = |x: &[f64], y: &[f64]| -> Vec<[f64; 2]> {
            let near = |row: &usize| endless.is_near(found.axis.values[*row]);
            let value = |row: &usize| match near(row) {
                true => [f64::NAN; 2],
                false => [x[*row], y[*row]],
            };
            rows.iter().map(value).collect()
        };
        ArrowSet {
            name: match endless.ends.is_empty() {
                true => name.to_owned(),
                false => format!("{name} away from the ends, where it has no bounds"),
            },
            unit: unit.to_owned(),
            shown,
            arrows: (points.iter())
                .map(|point| Arrow {
                    name: format!("{name} of {}", point.owner),
                    at: vectors(point.values[0], point.values[1]),
                    vector: vector(point.values[which], point.values[which + 1]),
                })
                .collect(),
        }
    };
    let axis = axis(found);
    Drawing {
        spec: found.linkage.spec(),
        frames: rows
            .iter()
            .map(|&row| placements(&found.frames[row]))
            .collect(),
        axis: Axis {
            name: axis.name.to_owned(),
            unit: axis.unit().to_owned(),
            values: rows
                .iter()
                .map(|&row| axis.in_unit(found.axis.values[row]))
                .collect(),
            times: rows.iter().map(|&row| found.times[row]).collect(),
            closed: found.closed,
        },
        paths: (points.iter())
            .map(|point| Path {
                name: point.owner.to_owned(),
                points: vectors(point.values[0], point.values[1]),
            })
            .collect(),
        arrows: vec![
            set(("speed", "m/s"), true, (Quantity::SpeedSize, 2)),
            set(
                ("acceleration", "m/s²"),
                false,
                (Quantity::AccelerationSize, 4),
            ),
        ],
    }
}

/// The links of a position.
pub(super) fn placements(frame: &[[f64; 4]]) -> Vec<Placement> {
    let place = |&[x, y, cos, sin]: &[f64; 4]| Placement {
        at: [x, y],
        turn: [cos, sin],
    };
    frame.iter().map(place).collect()
}

/// A named point that moves: x, y, speed, acceleration over the rows.
struct MovingPoint<'a> {
    owner: &'a str,
    values: [&'a [f64]; 6],
}

fn points<'a>(found: &'a Kinematics) -> Vec<MovingPoint<'a>> {
    let find = |owner: &str, quantity: Quantity| {
        let mut columns = found.columns.iter();
        columns.find(|column| column.owner == owner && column.quantity == quantity)
    };
    let mut points = Vec::new();
    for column in &found.columns {
        if column.quantity != Quantity::X {
            continue;
        }
        let owner = column.owner.as_str();
        let others = [
            Quantity::Y,
            Quantity::SpeedX,
            Quantity::SpeedY,
            Quantity::AccelerationX,
            Quantity::AccelerationY,
        ];
        let others = others.map(|quantity| find(owner, quantity));
        let [Some(y), Some(vx), Some(vy), Some(ax), Some(ay)] = others else {
            continue;
        };
        let values = [column, y, vx, vy, ax, ay].map(|column| column.values.as_slice());
        let moves = values[..2]
            .iter()
            .any(|values| range_of_values(values) > 0.0);
        let twice = points
            .iter()
            .any(|other: &MovingPoint<'_>| same_path(other, values[0], values[1]));
        if moves && !twice {
            points.push(MovingPoint { owner, values });
        }
    }
    points
}

/// Greatest less least, 0 where that is rounding.
fn range_of_values(values: &[f64]) -> f64 {
    let least = values.iter().copied().fold(f64::INFINITY, f64::min);
    let most = values.iter().copied().fold(f64::NEG_INFINITY, f64::max);
    let size = least.abs().max(most.abs());
    if most - least > 1e-9 * size {
        most - least
    } else {
        0.0
    }
}

/// True when two points are one pin of two links.
fn same_path(other: &MovingPoint<'_>, x: &[f64], y: &[f64]) -> bool {
    let near = |a: &[f64], b: &[f64]| {
        let size = a.iter().fold(0.0, |size: f64, value| size.max(value.abs()));
        let pairs = a.iter().zip(b);
        pairs
            .into_iter()
            .all(|(a, b)| (a - b).abs() <= 1e-9 * size.max(1e-300))
    };
    near(other.values[0], x) && near(other.values[1], y)
}
