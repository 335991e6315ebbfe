//! Loads that are tables over time, or over a displacement that is prescribed.

use super::cycle::{Cycle, Piece};
use super::fit::fit_course;
use super::hidden::Target;
use super::prescribed::{PrescribedMotion, place_inside};
use crate::dynamics::model::LinearPiece;
use crate::exact::{ForcePiece, ForceSource, LAW_DEGREE, TimeLoad};
use crate::kinematics::breaks::Breaks;
use std::sync::Arc;

/// A table over a prescribed displacement, times a factor.
#[derive(Debug)]
struct CourseLoad {
    course: PrescribedMotion,
    breaks: Breaks,
    pieces: Vec<LinearPiece>,
    factor: f64,
    /// Where the load is the motion itself, times a factor, and repeats.
    cycle: Option<Cycle<ForcePiece>>,
}

/// The load `factor`·table(course) over time.
pub(super) fn load(
    course: PrescribedMotion,
    breaks: &Breaks,
    pieces: &[LinearPiece],
    factor: f64,
) -> TimeLoad {
    let plain = breaks.is_empty() && course.is_written();
    TimeLoad::Pieces(Arc::new(CourseLoad {
        cycle: plain.then(|| Cycle::of(&course)).flatten(),
        course,
        breaks: breaks.clone(),
        pieces: pieces.to_vec(),
        factor,
    }))
}

/// A table over time that does not repeat: straight lines between its points.
pub(super) fn table(breaks: &Breaks, pieces: &[LinearPiece], factor: f64) -> Option<TimeLoad> {
    let joined = |k: usize| {
        let (before, at) = (&pieces[k], breaks.points[k]);
        let end = before.value + before.slope * (at - before.start);
        let next = &pieces[k + 1];
        next.start == at && (end - next.value).abs() <= 1e-12 * (end.abs() + next.value.abs())
    };
    let flat = |piece: &LinearPiece| piece.slope == 0.0;
    let whole = breaks.period.is_none() && pieces.len() == breaks.points.len() + 1;
    if !(whole && flat(pieces.first()?) && flat(pieces.last()?)) {
        return None;
    }
    if !(0..breaks.points.len()).all(joined) {
        return None;
    }
    let points = breaks.points.iter().zip(&pieces[1..]);
    Some(TimeLoad::Table(
        points
            .map(|(&at, piece)| (at, factor * piece.value))
            .collect(),
    ))
}

impl CourseLoad {
    fn longest_piece(&self, time: f64) -> f64 {
        let cycle = self.cycle.as_ref();
        let rest = self.course.formulas(time).until - time;
        let longest = rest.min(self.course.time_of_next_turn(time));
        let longest = longest.min(self.course.farthest(time));
        cycle.map_or(longest, |cycle| longest.min(cycle.longest_piece()))
    }

    fn fit_piece(&self, time: f64, longest: f64) -> ForcePiece {
        let nothing = |value: f64| ForcePiece {
            start: time,
            end: f64::INFINITY,
            coefficients: [value; LAW_DEGREE + 1],
        };
        let Some(fit) = fit_course(
            &self.course,
            time,
            longest,
            Target::Displacement,
            Some(&self.breaks),
        ) else {
            return nothing(f64::NAN);
        };
        let (index, shift) = self
            .breaks
            .piece(self.breaks.segment_at(place_inside(fit.limits), 1.0));
        let piece = self.pieces[index.min(self.pieces.len() - 1)];
        let mut coefficients = fit.coefficients.map(|c| self.factor * piece.slope * c);
        coefficients[0] += self.factor * (piece.value - piece.slope * (shift + piece.start));
        ForcePiece {
            start: time,
            end: fit.end,
            coefficients,
        }
    }
}

impl ForceSource for CourseLoad {
    fn piece(&self, time: f64) -> ForcePiece {
        let fresh = |time: f64, longest: f64| self.fit_piece(time, longest);
        let cycle = self.cycle.as_ref();
        let Some(place) = cycle.and_then(|cycle| cycle.at(time, fresh)) else {
            return self.fit_piece(time, self.longest_piece(time));
        };
        let mut piece = ForcePiece {
            start: place.start.0,
            end: place.end,
            ..place.piece
        };
        piece.coefficients[0] += self.factor * self.pieces[0].slope * place.gained;
        piece
    }
}

impl Piece for ForcePiece {
    fn interval(&self) -> (f64, f64) {
        (self.start, self.end)
    }

    fn ending(self, end: f64) -> Self {
        Self { end, ..self }
    }

    fn is_made(&self) -> bool {
        self.coefficients[0].is_finite()
    }
}
