//! Contour lines of values on a grid: marching squares, joined to lines.
//!
//! The contour lines of maps and the singular curves of linkages with two inputs are drawn by
//! it.

use std::collections::BTreeMap;

/// A line through points (column, row) in units of the grid.
pub(crate) type Line = Vec<(f64, f64)>;

/// A side of a square: from a grid point to the right (`false`) or up (`true`).
type Side = (usize, usize, bool);

/// Lines along which values on a grid pass through `level`. `value` gives the
/// value at a column and row; squares with a corner without one are left out. Values between
/// two grid points are taken as linear.
pub(crate) fn contours(
    columns: usize,
    rows: usize,
    level: f64,
    value: &dyn Fn(usize, usize) -> Option<f64>,
) -> Vec<Line> {
    located(columns, rows, level, value, &mut |_, values| linear(values))
}

/// Where between two values a straight line through them is zero.
fn linear([from, to]: [f64; 2]) -> f64 {
    from / (from - to)
}

/// The two grid points at the ends of a side, as column and row.
pub(crate) type Ends = [[usize; 2]; 2];

/// As [`contours`], where the level is crossed between two grid points found by `share`: from
/// the points and the values less the level there, the share of the way from the first.
pub(crate) fn located(
    columns: usize,
    rows: usize,
    level: f64,
    value: &dyn Fn(usize, usize) -> Option<f64>,
    share: &mut dyn FnMut(Ends, [f64; 2]) -> f64,
) -> Vec<Line> {
    let mut sides: BTreeMap<Side, (f64, f64)> = BTreeMap::new();
    let mut joined: BTreeMap<Side, Vec<Side>> = BTreeMap::new();
    for row in 1..rows {
        for column in 1..columns {
            let Some(square) = Square::new(column - 1, row - 1, level, value) else {
                continue;
            };
            for (a, b) in square.crossings() {
                for side in [a, b] {
                    let point = sides.entry(side);
                    point.or_insert_with(|| square.point(side, share));
                }
                joined.entry(a).or_default().push(b);
                joined.entry(b).or_default().push(a);
            }
        }
    }
    lines(&sides, joined)
}

/// Four neighbouring grid points, values relative to the level.
struct Square {
    column: usize,
    row: usize,
    /// Lower left, lower right, upper right, upper left.
    corners: [f64; 4],
}

impl Square {
    fn new(
        column: usize,
        row: usize,
        level: f64,
        value: &dyn Fn(usize, usize) -> Option<f64>,
    ) -> Option<Self> {
        let corners = [
            value(column, row)? - level,
            value(column + 1, row)? - level,
            value(column + 1, row + 1)? - level,
            value(column, row + 1)? - level,
        ];
        corners
            .iter()
            .all(|value| value.is_finite())
            .then_some(Self {
                column,
                row,
                corners,
            })
    }

    /// Sides that the level crosses, in pairs.
    fn crossings(&self) -> Vec<(Side, Side)> {
        let (column, row) = (self.column, self.row);
        let sides = [
            (column, row, false),
            (column + 1, row, true),
            (column, row + 1, false),
            (column, row, true),
        ];
        let above: Vec<bool> = self.corners.iter().map(|&value| value >= 0.0).collect();
        let crossed: Vec<Side> = (0..4)
            .filter(|&side| above[side] != above[(side + 1) % 4])
            .map(|side| sides[side])
            .collect();
        match crossed[..] {
            [a, b] => vec![(a, b)],
            // A saddle: the mean says which corners hang together.
            [a, b, c, d] => {
                let middle = self.corners.iter().sum::<f64>() >= 0.0;
                if middle == above[0] {
                    vec![(a, b), (c, d)]
                } else {
                    vec![(a, d), (b, c)]
                }
            }
            _ => Vec::new(),
        }
    }

    /// Where the level crosses a side.
    fn point(&self, side: Side, share: &mut dyn FnMut(Ends, [f64; 2]) -> f64) -> (f64, f64) {
        let (column, row, up) = side;
        let [a, b, c, d] = self.corners;
        let (from, to) = match (up, row > self.row, column > self.column) {
            (false, false, _) => (a, b),
            (false, true, _) => (d, c),
            (true, _, false) => (a, d),
            (true, _, true) => (b, c),
        };
        let (right, above) = (usize::from(!up), usize::from(up));
        let ends = [[column, row], [column + right, row + above]];
        let part = share(ends, [from, to]).clamp(0.0, 1.0);
        let (x, y) = (column as f64, row as f64);
        if up { (x, y + part) } else { (x + part, y) }
    }
}

/// Joins neighbouring crossings to lines: open ones from their ends first, then
/// closed ones.
fn lines(sides: &BTreeMap<Side, (f64, f64)>, mut joined: BTreeMap<Side, Vec<Side>>) -> Vec<Line> {
    let ends = joined.iter().filter(|(_, others)| others.len() == 1);
    let mut starts: Vec<Side> = ends.map(|(&side, _)| side).collect();
    starts.extend(joined.keys().copied().collect::<Vec<_>>());
    let mut found = Vec::new();
    for start in starts {
        let mut line = vec![sides[&start]];
        let mut here = start;
        while let Some(next) = joined.get_mut(&here).and_then(Vec::pop) {
            if let Some(back) = joined.get_mut(&next)
                && let Some(at) = back.iter().position(|&side| side == here)
            {
                back.remove(at);
            }
            line.push(sides[&next]);
            here = next;
        }
        if line.len() > 1 {
            found.push(line);
        }
    }
    found
}

#[cfg(test)]
mod tests {
    use super::{contours, located};

    #[test]
    fn a_circle_comes_out_round_and_closed() {
        let radius = |x: usize, y: usize| Some((x as f64 - 20.0).hypot(y as f64 - 20.0));
        let lines = contours(41, 41, 12.3, &radius);
        assert_eq!(lines.len(), 1);
        assert_eq!(lines[0].first(), lines[0].last());
        for &(x, y) in &lines[0] {
            // Linear interpolation of a cone on unit squares is good to 1/(8 r).
            approx::assert_abs_diff_eq!((x - 20.0).hypot(y - 20.0), 12.3, epsilon = 0.02);
        }
    }

    #[test]
    fn what_is_located_between_grid_points_is_as_good_as_the_search() {
        let square = |[x, y]: [f64; 2]| (x - 20.0).powi(2) + (y - 20.0).powi(2);
        let value = |x: usize, y: usize| Some(square([x as f64, y as f64]));
        let mut search = |[from, to]: super::Ends, _: [f64; 2]| {
            let at = |share: f64| {
                [0, 1].map(|k| from[k] as f64 + share * (to[k] as f64 - from[k] as f64))
            };
            crate::math::roots::root(&|share| square(at(share)) - 151.29, 0.0, 1.0)
        };
        let lines = located(41, 41, 151.29, &value, &mut search);
        assert_eq!(lines.len(), 1);
        for &(x, y) in &lines[0] {
            approx::assert_abs_diff_eq!((x - 20.0).hypot(y - 20.0), 12.3, epsilon = 1e-13);
        }
    }

    #[test]
    fn a_straight_line_is_exact_and_open() {
        let plane = |x: usize, y: usize| Some(2.0 * x as f64 - y as f64);
        let lines = contours(5, 9, 3.0, &plane);
        assert_eq!(lines.len(), 1);
        for &(x, y) in &lines[0] {
            approx::assert_abs_diff_eq!(2.0 * x - y, 3.0, epsilon = 1e-12);
        }
        assert!(lines[0].len() >= 9);
    }

    #[test]
    fn saddles_do_not_cross_and_holes_are_left_out() {
        let saddle = |x: usize, y: usize| Some(if (x + y).is_multiple_of(2) { 1.0 } else { -1.0 });
        assert_eq!(contours(2, 2, 0.0, &saddle).len(), 2);
        let hole = |x: usize, y: usize| (x != 1 || y != 1).then_some(x as f64);
        assert!(contours(3, 3, 0.5, &hole).is_empty());
        assert!(contours(3, 3, 9.0, &saddle).is_empty());
    }
}
