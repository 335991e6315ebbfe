//! What lies over the ranges of the inputs: singular curves over two, positions over all.

use super::super::{Grid, Plane, PlaneInput};
use super::course::frames;
use super::request::{Advance, AskedSeveral};
use crate::dynamics::model::Coordinate;
use crate::kinematics::linkage::multi::{MultiMotion, singular_curves};
use crate::math::jet::Jet;
use std::f64::consts::PI;

/// Positions on a grid over all inputs, together.
const POSITIONS: f64 = 2500.0;
/// Most inputs that a grid has room for: the others are held.
const MOST_INPUTS: usize = 3;

impl AskedSeveral<'_> {
    /// Values of the inputs where the study begins.
    fn beginning(&self) -> Vec<f64> {
        let inputs = self.inputs_at(self.span()[0]);
        inputs.iter().map(|input| input.value).collect()
    }

    /// The inputs, those that the study moves first.
    fn by_motion(&self) -> Vec<usize> {
        let [from, to] = self.span();
        let (first, last) = (self.inputs_at(from), self.inputs_at(to));
        let mut order: Vec<usize> = (0..self.inputs.len()).collect();
        let moves = |&input: &usize| match self.way {
            Advance::Time { .. } => false,
            Advance::Path { .. } => first[input].value == last[input].value,
        };
        order.sort_by_key(moves);
        order
    }

    /// The range of an input that is looked at: a turn about the middle of its way, or as much
    /// to both sides as the linkage is long; more where the way goes further.
    fn range(&self, input: usize) -> [f64; 2] {
        let ends = match self.way {
            Advance::Time { .. } => [self.beginning()[input]; 2],
            Advance::Path { span, .. } => span.map(|place| self.inputs_at(place)[input].value),
        };
        let (least, most) = (ends[0].min(ends[1]), ends[0].max(ends[1]));
        let half = match self.inputs[input] {
            Coordinate::Turning => PI,
            Coordinate::Sliding => self.linkage.typical_length(),
        };
        let middle = 0.5 * (least + most);
        [least.min(middle - half), most.max(middle + half)]
    }
}

/// Singular positions over two inputs, those that move before those that are held. `None`:
/// nothing can become singular.
pub(super) fn plane(asked: &AskedSeveral<'_>, places: &[f64]) -> Option<Plane> {
    let order = asked.by_motion();
    let &[one, other, ..] = order.as_slice() else {
        return None;
    };
    if asked.linkage.structure().groups.len() < 2 {
        return None;
    }
    let over = [one.min(other), one.max(other)];
    let ranges = over.map(|input| asked.range(input));
    let curves = singular_curves(&asked.linkage, &asked.beginning(), over, ranges);
    let path = places.iter().map(|&place| {
        let inputs = asked.inputs_at(place);
        over.map(|input| inputs[input].value)
    });
    let inputs = [0, 1].map(|k| PlaneInput {
        name: asked.name(over[k]).to_owned(),
        coordinate: asked.inputs[over[k]],
        range: ranges[k],
    });
    Some(Plane {
        inputs,
        curves,
        path: path.collect(),
    })
}

/// The positions of all links over the ranges of the inputs.
pub(super) fn grid(asked: &AskedSeveral<'_>) -> Option<Grid> {
    let mut varied = asked.by_motion();
    varied.truncate(MOST_INPUTS);
    varied.sort_unstable();
    let each = POSITIONS.powf(1.0 / varied.len() as f64).floor() as usize;
    let beginning = asked.beginning();
    let mut axes = Vec::new();
    let (mut start, mut stride) = (0, 1);
    for &input in &varied {
        let [from, to] = asked.range(input);
        let value = |k: usize| from + (to - from) * k as f64 / (each - 1) as f64;
        let share = (beginning[input] - from) / (to - from);
        start += stride * (share * (each - 1) as f64).round() as usize;
        stride *= each;
        let values = (0..each).map(value).collect();
        axes.push((asked.name(input).to_owned(), asked.inputs[input], values));
    }
    let frames = positions(asked, &varied, &axes);
    Some(Grid {
        start: nearest_position(&frames, start, each).unwrap_or(start),
        frames,
        axes,
    })
}

/// The position nearest to one of a grid, in steps of its `each` lines, in which the linkage can be
/// assembled.
fn nearest_position(frames: &[Vec<[f64; 4]>], to: usize, each: usize) -> Option<usize> {
    let assembled = |place: &usize| frames[*place].iter().flatten().all(|part| part.is_finite());
    let distance = |place: &usize| {
        let (mut one, mut other, mut square) = (*place, to, 0);
        while one != other {
            square += (one % each).abs_diff(other % each).pow(2);
            (one, other) = (one / each, other / each);
        }
        square
    };
    (0..frames.len()).filter(assembled).min_by_key(distance)
}

/// Frames on the grid, from one line to the next there and back, so that every position is
/// found from a neighbour.
fn positions(
    asked: &AskedSeveral<'_>,
    varied: &[usize],
    axes: &[(String, Coordinate, Vec<f64>)],
) -> Vec<Vec<[f64; 4]>> {
    let links = asked.linkage.spec().linkage.links.len();
    let count: usize = axes.iter().map(|axis| axis.2.len()).product();
    let mut found = vec![vec![[f64::NAN; 4]; links]; count];
    let mut motion = MultiMotion::new(&asked.linkage);
    let mut inputs: Vec<Jet> = asked.inputs_at(asked.span()[0]);
    for input in &mut inputs {
        (input.first, input.second) = (0.0, 0.0);
    }
    for number in 0..count {
        let (mut rest, mut place, mut stride) = (number, 0, 1);
        for (&input, (.., values)) in varied.iter().zip(axes) {
            let (line, own) = (rest / values.len(), rest % values.len());
            let own = match line % 2 {
                0 => own,
                _ => values.len() - 1 - own,
            };
            inputs[input].value = values[own];
            place += stride * own;
            stride *= values.len();
            rest = line;
        }
        if motion.set_inputs(&inputs).is_ok() {
            found[place] = frames(&motion, links);
        }
    }
    found
}

#[cfg(test)]
mod tests {
    use super::nearest_position;

    #[test]
    fn a_grid_starts_where_the_linkage_can_be_assembled() {
        // Of 4 × 4 positions those with the first index 3, and one more.
        let frames: Vec<Vec<[f64; 4]>> = (0..16)
            .map(|place| match place % 4 == 3 || place == 8 {
                true => vec![[0.0, 0.0, 1.0, 0.0]],
                false => vec![[f64::NAN; 4]],
            })
            .collect();
        assert_eq!(nearest_position(&frames, 7, 4), Some(7));
        // One step along either axis.
        assert_eq!(nearest_position(&frames, 6, 4), Some(7));
        assert_eq!(nearest_position(&frames, 4, 4), Some(8));
        assert_eq!(nearest_position(&frames[..3], 1, 4), None);
    }
}
