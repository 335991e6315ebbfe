//! The singular positions over two inputs: curves in their plane.
//!
//! A group is singular where the determinant of its closing equations vanishes. Of a dyad its
//! margin, sin² of an angle or the sine of one, is a smooth function of the inputs on both
//! sides of the curve, also where the dyad cannot be assembled. Its sign is looked at on a
//! grid, and every change of sign along a line of the grid is a root that is found to
//! rounding. A larger group is known on one side only: there the end of what can be assembled
//! is bracketed, and the square of its determinant, which goes with the distance there, is
//! followed to zero from within. What is smaller than a mesh of the grid is not seen.

use super::place::{StartPosition, place_links};
use super::{Core, MultiLinkage, MultiWorkspace};
use crate::math::contour;
use crate::math::roots::{bisect, bracketed};
use std::collections::VecDeque;

/// Meshes of the grid along each input: for closed formulas, and for iterations.
const MESHES: [usize; 2] = [180, 48];
/// Halvings that bracket the end of what a larger group can reach.
const HALVINGS: u32 = 22;
/// Share of a mesh by which the search steps back from there, to where the iteration is sure.
const BACK: f64 = 1e-4;
/// Share of the way to the zero of a larger group's square that one step goes, so that it
/// stays on the side on which the group can be assembled.
const CAUTION: f64 = 0.8;
/// Most such steps: the square is then below what rounding leaves of it.
const STEPS: usize = 24;

/// A curve on which a group is singular.
#[derive(Clone, Debug, PartialEq)]
pub struct SingularCurve {
    /// Index into the groups of the structure.
    pub group: usize,
    /// Points on it: values of both inputs (rad or m).
    pub points: Vec<[f64; 2]>,
    /// True where it ends as it begins.
    pub closed: bool,
}

/// The part of the space of the inputs that is looked at: two go over their ranges, all others
/// stay.
#[derive(Clone, Debug, PartialEq)]
pub(super) struct Plane {
    /// Values of all inputs.
    pub(super) at: Vec<f64>,
    /// The inputs that vary.
    pub(super) over: [usize; 2],
    /// The range of each (rad or m).
    pub(super) ranges: [[f64; 2]; 2],
    /// Meshes along each.
    pub(super) meshes: usize,
}

impl Plane {
    fn value(&self, k: usize, place: f64) -> f64 {
        let [from, to] = self.ranges[k];
        from + (to - from) * place / self.meshes as f64
    }

    /// Inputs at a place in units of the grid.
    fn inputs(&self, [column, row]: [f64; 2]) -> Vec<f64> {
        let mut inputs = self.at.clone();
        inputs[self.over[0]] = self.value(0, column);
        inputs[self.over[1]] = self.value(1, row);
        inputs
    }
}

/// Curves over two inputs on which a group is singular, the others held at `at`, within the
/// `ranges` of the two.
pub fn singular_curves(
    linkage: &MultiLinkage,
    at: &[f64],
    over: [usize; 2],
    ranges: [[f64; 2]; 2],
) -> Vec<SingularCurve> {
    let core = &*linkage.core;
    let closed = core.plan.groups.iter().all(|group| group.dyad);
    let plane = Plane {
        at: at.to_vec(),
        over,
        ranges,
        meshes: MESHES[usize::from(!closed)],
    };
    match closed {
        true => of_dyads(core, &plane),
        false => of_groups(linkage, &plane),
    }
}

/// Margins of all dyads at inputs, up to the first that cannot be assembled; not numbers
/// beyond it.
fn margins(core: &Core, inputs: &[f64], known: &mut StartPosition, margins: &mut [f64]) {
    let ends = match place_links(&core.plan, &core.signs, inputs, &mut known.state) {
        Ok(()) => margins.len(),
        Err(stuck) => stuck.group,
    };
    for (index, margin) in margins.iter_mut().enumerate() {
        *margin = match index < ends {
            true => known.state.margins[index].value,
            false => f64::NAN,
        };
    }
}

fn of_dyads(core: &Core, plane: &Plane) -> Vec<SingularCurve> {
    let mut known = core.start.clone();
    let groups = core.plan.groups.len();
    let side = plane.meshes + 1;
    let mut values = vec![f64::NAN; side * side * groups];
    for (node, own) in values.chunks_exact_mut(groups.max(1)).enumerate() {
        let inputs = plane.inputs([(node % side) as f64, (node / side) as f64]);
        margins(core, &inputs, &mut known, own);
    }
    let mut curves = Vec::new();
    let mut all = vec![0.0; groups];
    for group in 0..groups {
        let value = |column: usize, row: usize| {
            let value = values[(row * side + column) * groups + group];
            value.is_finite().then_some(value)
        };
        let mut share = |ends: contour::Ends, _: [f64; 2]| {
            let mut margin = |share: f64| {
                let inputs = plane.inputs(place_between(ends, share));
                margins(core, &inputs, &mut known, &mut all);
                all[group]
            };
            bracketed(&mut margin, [0.0, 1.0], 0.0).at
        };
        let lines = contour::located(side, side, 0.0, &value, &mut share);
        curves.extend(lines.into_iter().map(|line| curve(plane, group, &line)));
    }
    curves
}

/// A place between two points of the grid.
fn place_between([from, to]: contour::Ends, share: f64) -> [f64; 2] {
    [0, 1].map(|k| {
        let (from, to) = (from[k] as f64, to[k] as f64);
        from + share * (to - from)
    })
}

fn curve(plane: &Plane, group: usize, line: &[(f64, f64)]) -> SingularCurve {
    let point = |&(column, row): &(f64, f64)| [plane.value(0, column), plane.value(1, row)];
    SingularCurve {
        group: group + 1,
        points: line.iter().map(point).collect(),
        closed: line.len() > 3 && line.first() == line.last(),
    }
}

/// Of larger groups: what can be reached from the start, from one point of the grid to the
/// next.
struct GridReach<'a> {
    plane: &'a Plane,
    side: usize,
    /// What is known at the points that are reached.
    spaces: Vec<Option<MultiWorkspace<f64>>>,
    /// Of the others that were tried the group that cannot be assembled.
    stuck: Vec<Option<usize>>,
    rates: Vec<f64>,
}

impl<'a> GridReach<'a> {
    fn new(linkage: &MultiLinkage, plane: &'a Plane) -> Self {
        let side = plane.meshes + 1;
        let mut reached = Self {
            plane,
            side,
            spaces: vec![None; side * side],
            stuck: vec![None; side * side],
            rates: vec![0.0; plane.at.len()],
        };
        reached.flood(linkage);
        reached
    }

    fn flood(&mut self, linkage: &MultiLinkage) {
        let side = self.side;
        let nearest = [0, 1].map(|k| {
            let [from, to] = self.plane.ranges[k];
            let share = (self.plane.at[self.plane.over[k]] - from) / (to - from);
            (share * self.plane.meshes as f64)
                .round()
                .clamp(0.0, self.plane.meshes as f64) as usize
        });
        let mut first = linkage.workspace::<f64>();
        let first_node = nearest[1] * side + nearest[0];
        if let Err(group) = self.solve_node(&mut first, first_node) {
            self.stuck[first_node] = Some(group);
            return;
        }
        self.spaces[first_node] = Some(first);
        let mut open = VecDeque::from([first_node]);
        while let Some(node) = open.pop_front() {
            let (column, row) = (node % side, node / side);
            let neighbours = [
                (column > 0).then(|| node - 1),
                (column + 1 < side).then(|| node + 1),
                (row > 0).then(|| node - side),
                (row + 1 < side).then(|| node + side),
            ];
            for next in neighbours.into_iter().flatten() {
                if self.spaces[next].is_some() {
                    continue;
                }
                let Some(mut space) = self.spaces[node].clone() else {
                    continue;
                };
                match self.solve_node(&mut space, next) {
                    Ok(()) => {
                        self.spaces[next] = Some(space);
                        open.push_back(next);
                    }
                    Err(group) => self.stuck[next] = Some(group),
                }
            }
        }
    }

    fn solve_node(&self, space: &mut MultiWorkspace<f64>, node: usize) -> Result<(), usize> {
        let place = [(node % self.side) as f64, (node / self.side) as f64];
        let inputs = self.plane.inputs(place);
        let found = space.solve(&inputs, &self.rates);
        found.map_err(|stuck| stuck.group - 1)
    }

    /// 1 where everything can be assembled, −1 where this group cannot, or where that was not
    /// tried since it cannot beside it; `None` where another one cannot, or nothing is known.
    fn value(&self, group: usize, column: usize, row: usize) -> Option<f64> {
        let node = row * self.side + column;
        match (&self.spaces[node], self.stuck[node]) {
            (Some(_), _) => Some(1.0),
            (None, Some(stuck)) if stuck == group => Some(-1.0),
            (None, None) if self.is_behind(group, column, row) => Some(-1.0),
            _ => None,
        }
    }

    /// Whether a point has a neighbour at which the group cannot be assembled: from there on
    /// nothing was tried.
    fn is_behind(&self, group: usize, column: usize, row: usize) -> bool {
        let stuck = |column: usize, row: usize| {
            let inside = column < self.side && row < self.side;
            inside && self.stuck[row * self.side + column] == Some(group)
        };
        let aside = [column.wrapping_sub(1), column + 1].map(|column| stuck(column, row));
        let across = [row.wrapping_sub(1), row + 1].map(|row| stuck(column, row));
        aside.into_iter().chain(across).any(|stuck| stuck)
    }

    /// Where the group is singular on the way between two points, one of them reached.
    fn share_before_singular(&self, group: usize, ends: contour::Ends) -> f64 {
        let node = |[column, row]: [usize; 2]| row * self.side + column;
        let reversed = self.spaces[node(ends[0])].is_none();
        let (from, to) = match reversed {
            false => (ends[0], ends[1]),
            true => (ends[1], ends[0]),
        };
        let Some(known) = &self.spaces[node(from)] else {
            return 0.5;
        };
        let mut space = known.clone();
        let inputs = |share: f64| self.plane.inputs(place_between([from, to], share));
        let [mut inside, outside] = bisect([0.0, 1.0], HALVINGS, |share| {
            space.solve(&inputs(share), &self.rates).is_ok()
        });
        let along: Vec<f64> = inputs(1.0)
            .iter()
            .zip(inputs(0.0))
            .map(|(to, from)| to - from)
            .collect();
        let mut first = vec![0.0; along.len()];
        let mut found = 0.5 * (inside + outside);
        inside = (inside - BACK).max(0.0);
        for _ in 0..STEPS {
            if space.solve(&inputs(inside), &self.rates).is_err() {
                break;
            }
            // Near the curve the square goes with the distance, but for its power 3/2.
            let [square, ..] = space.distance_from_singular(group, &mut first);
            let slope: f64 = first.iter().zip(&along).map(|(a, b)| a * b).sum();
            let way = -square / slope;
            if !(way.is_finite() && way >= 0.0 && inside + way <= 1.0 + BACK) {
                break;
            }
            found = inside + way;
            inside += CAUTION * way;
        }
        match reversed {
            false => found,
            true => 1.0 - found,
        }
    }
}

fn of_groups(linkage: &MultiLinkage, plane: &Plane) -> Vec<SingularCurve> {
    let reached = GridReach::new(linkage, plane);
    let side = reached.side;
    let mut curves = Vec::new();
    for group in 0..linkage.core.plan.groups.len() {
        let value = |column: usize, row: usize| reached.value(group, column, row);
        let mut share =
            |ends: contour::Ends, _: [f64; 2]| reached.share_before_singular(group, ends);
        let lines = contour::located(side, side, 0.0, &value, &mut share);
        curves.extend(lines.into_iter().map(|line| curve(plane, group, &line)));
    }
    curves
}
