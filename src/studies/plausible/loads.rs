//! Loads without effect, windows and tables that are never entered.

use super::{displacement_text, number_text};
use crate::dynamics::model::{Coordinate, LinearPiece, Load, Model, ObjectPart, TrackSource};
use crate::kinematics::breaks::Breaks;

/// How far beyond the samples a displacement may have gone, of its travel.
const MARGIN: f64 = 1e-3;

/// The range of a node's displacement, where it is known.
type Travel<'a> = dyn Fn(usize) -> Option<[f64; 2]> + 'a;

/// Loads that are zero, and those of [`never_entered`].
pub(super) fn without_effect(model: &Model, travel: &Travel<'_>, duration: f64) -> Vec<String> {
    // A motor without a torque is a rotor left to itself, which may well be meant.
    let loads = model
        .loads
        .iter()
        .filter(|load| load.name.contains(".loads."));
    let zero = loads.filter(|load| load.law.is_zero());
    let zero = zero.map(|load| format!("`{}` never acts: its force is zero throughout", load.name));
    let mut found = zero.collect();
    remove_repeats(&mut found);
    found.extend(never_entered(model, travel, Some(duration)));
    found
}

/// Loads over the way of a node whose window or table it never comes to.
pub(super) fn never_entered_over_travel(model: &Model, travel: &Travel<'_>) -> Vec<String> {
    never_entered(model, travel, None)
}

/// The same, and those over time that begin after the end of the run.
fn never_entered(model: &Model, travel: &Travel<'_>, duration: Option<f64>) -> Vec<String> {
    let told = |load: &Load| {
        let (track, pieces) = load.law.pieces()?;
        if load.law.is_zero() {
            return None;
        }
        let track = &model.tracks[track];
        let (range, axis) = match track.source {
            TrackSource::Time => ([0.0, duration?], Axis::Time),
            TrackSource::Node(node) => (widened(travel(node)?), Axis::of(model, node)?),
        };
        inactive_load_warning(&load.name, &track.breaks, pieces, range, &axis)
    };
    let mut found = model.loads.iter().filter_map(told).collect();
    remove_repeats(&mut found);
    found
}

/// A load on several masses is said once.
fn remove_repeats(found: &mut Vec<String>) {
    found.dedup();
}

fn widened([from, to]: [f64; 2]) -> [f64; 2] {
    let room = MARGIN * (to - from);
    [from - room, to + room]
}

fn has_force(piece: &LinearPiece) -> bool {
    piece.value != 0.0 || piece.slope != 0.0
}

/// Axis that a load runs over.
enum Axis<'a> {
    Time,
    Way(&'a str, Coordinate),
}

impl<'a> Axis<'a> {
    /// The way of the object whose last mass a node is.
    fn of(model: &'a Model, node: usize) -> Option<Self> {
        let own = |part: &&ObjectPart| part.nodes.last() == Some(&node);
        let part = model.objects.iter().find(own)?;
        Some(Self::Way(&part.id, part.coordinate))
    }

    fn displacement_text(&self, value: f64) -> String {
        match self {
            Self::Time => format!("{} s", number_text(value)),
            Self::Way(_, coordinate) => displacement_text(value, *coordinate),
        }
    }

    /// `where `crank` goes from 0 deg to 90 deg`.
    fn travel(&self, [from, to]: [f64; 2]) -> String {
        match self {
            Self::Time => format!("the run ends at {}", self.displacement_text(to)),
            Self::Way(id, _) => {
                format!(
                    "`{id}` goes from {} to {}",
                    self.displacement_text(from),
                    self.displacement_text(to)
                )
            }
        }
    }
}

fn inactive_load_warning(
    name: &str,
    breaks: &Breaks,
    pieces: &[LinearPiece],
    range: [f64; 2],
    axis: &Axis<'_>,
) -> Option<String> {
    let covered = segments(breaks, range)?;
    let piece = |segment: i64| pieces.get(breaks.piece(segment).0);
    if covered
        .clone()
        .any(|segment| piece(segment).is_some_and(has_force))
    {
        // Force acts; but of a table that is left at its side it is one number only.
        let outside = breaks.period.is_none()
            && covered.start() == covered.end()
            && (*covered.start() == 0 || *covered.start() == breaks.points.len() as i64);
        return outside.then(|| {
            format!(
                "the table of `{name}` is never entered: it lies {}, and {}; its force is \
                 the same throughout",
                extent(breaks, axis),
                axis.travel(range)
            )
        });
    }
    Some(format!(
        "`{name}` never acts: its force is zero but {}, and {}",
        range_of_action(breaks, pieces, axis),
        axis.travel(range)
    ))
}

/// The segments that a range touches; `None` for a range that is none.
fn segments(breaks: &Breaks, [from, to]: [f64; 2]) -> Option<std::ops::RangeInclusive<i64>> {
    if !(from <= to) {
        return None;
    }
    let first = breaks.segment_at(from, 1.0);
    // A period and one more hold every piece.
    let most = first + breaks.points.len() as i64 + 1;
    let last = breaks.segment_at(to, -1.0).max(first);
    Some(first..=last.min(most))
}

fn extent(breaks: &Breaks, axis: &Axis<'_>) -> String {
    let (first, last) = (breaks.points[0], breaks.points[breaks.points.len() - 1]);
    match first == last {
        true => format!("at {}", axis.displacement_text(first)),
        false => format!(
            "between {} and {}",
            axis.displacement_text(first),
            axis.displacement_text(last)
        ),
    }
}

/// Where a load acts: from the first piece with a force to the end of the last.
fn range_of_action(breaks: &Breaks, pieces: &[LinearPiece], axis: &Axis<'_>) -> String {
    let with_force = || (0..pieces.len()).filter(|&index| has_force(&pieces[index]));
    let (Some(first), Some(last)) = (with_force().next(), with_force().next_back()) else {
        return "nowhere".to_owned();
    };
    let (from, to) = (breaks.edges(first as i64).0, breaks.edges(last as i64).1);
    match (from.is_finite(), to.is_finite()) {
        (true, true) => format!(
            "between {} and {}",
            axis.displacement_text(from),
            axis.displacement_text(to)
        ),
        (true, false) => format!("beyond {}", axis.displacement_text(from)),
        (false, true) => format!("below {}", axis.displacement_text(to)),
        (false, false) => "everywhere".to_owned(),
    }
}
