//! Curves of a cam as polygons within a chord tolerance: profile, pitch curve,
//! path of a cutter.

use super::disc::DiscCam;
use super::motion::Piece;
use crate::fault::Fault;
use crate::math::order::Total;
use crate::units::shown;
use std::f64::consts::PI;

/// Most points of a polygon.
const MOST_POINTS: usize = 200_000;

/// Share of the tolerance aimed at: the bound from the curvature is taken at
/// places, not over all of an arc.
const SHARE: f64 = 0.8;

/// Greatest turn from one side to the next: coarse tolerances keep the shape.
const MOST_TURN: f64 = PI / 12.0;

/// A curve of the cam in the cam's frame (which lies as drawn at φ = 0).
#[derive(Clone, Debug, PartialEq)]
pub struct Polygon {
    /// φ at each corner, ascending; at corners of the curve several have one φ.
    pub angles: Vec<f64>,
    /// The corners (m), the first not repeated at the end.
    pub points: Vec<[f64; 2]>,
    /// Whether the last corner is joined with the first.
    pub closed: bool,
}

impl DiscCam {
    /// The curve at `offset` from the reference curve (0: pitch curve of a
    /// roller, profile of a flat face), so that between its corners the curve
    /// keeps within `tolerance` (m) of the polygon.
    ///
    /// The distance of a smooth arc from its chord is at most L²·|κ|/8, which
    /// is Δφ²/8 times the greatest |κ|·(rate of length)²; intervals are
    /// halved until that keeps the bound. Where U′ jumps, the roller turns
    /// about the corner of its pitch curve: an arc is put in.
    ///
    /// # Errors
    /// A tolerance that is not positive or would take more than 200 000 points.
    pub fn polygon(&self, offset: f64, tolerance: f64) -> Result<Polygon, Fault> {
        if !(tolerance.is_finite() && tolerance > 0.0) {
            let message = format!("{tolerance} m is no chord tolerance");
            return Err(Fault::new("tolerance", message, "give a length above zero"));
        }
        let mut tracer = Tracer {
            cam: self,
            offset,
            tolerance,
            angles: Vec::new(),
            points: Vec::new(),
        };
        // Told before hours are spent on it.
        let pieces = self.motion().pieces().iter();
        let fewest: f64 = pieces.map(|piece| tracer.fewest(piece)).sum();
        if !(fewest <= MOST_POINTS as f64) {
            return Err(tracer.too_many_points());
        }
        let mut before: Option<&Piece> = None;
        for piece in self.motion().pieces() {
            if let Some(before) = before {
                tracer.corner(before, piece)?;
            }
            tracer.trace(piece)?;
            before = Some(piece);
        }
        let closed = self.motion().is_closed();
        if closed {
            let pieces = self.motion().pieces();
            tracer.corner(&pieces[pieces.len() - 1], &pieces[0])?;
            tracer.close_curve();
        }
        Ok(Polygon {
            angles: tracer.angles,
            points: tracer.points,
            closed,
        })
    }
}

struct Tracer<'a> {
    cam: &'a DiscCam,
    offset: f64,
    tolerance: f64,
    angles: Vec<f64>,
    points: Vec<[f64; 2]>,
}

impl Tracer<'_> {
    /// Corners of a piece, both ends among them.
    fn trace(&mut self, piece: &Piece) -> Result<(), Fault> {
        self.add_point(piece, piece.from)?;
        // A stack in place of recursion: what lies to the right waits.
        let mut waiting: Vec<(f64, f64)> = (1..=piece.intervals)
            .rev()
            .map(|step| (piece.search_place(step - 1), piece.search_place(step)))
            .collect();
        // The pieces of the search are far finer than coarse polygons need.
        let mut open: Option<f64> = None;
        while let Some((from, to)) = waiting.pop() {
            let begin = open.unwrap_or(from);
            if self.may_span(piece, begin, to) {
                open = Some(begin);
                let last = waiting.last().copied();
                let longer = last.is_some_and(|(_, next)| self.may_span(piece, begin, next));
                if !longer {
                    self.add_point(piece, to)?;
                    open = None;
                }
            } else {
                let middle = 0.5 * (from + to);
                if middle <= from || middle >= to {
                    self.add_point(piece, to)?;
                    open = None;
                } else {
                    waiting.push((middle, to));
                    waiting.push((from, middle));
                }
            }
        }
        Ok(())
    }

    /// A number of sides that a piece takes at least: the bend is taken at its least
    /// in each interval, by half, as it is looked at in places.
    fn fewest(&self, piece: &Piece) -> f64 {
        let sides = |step: usize| {
            let (from, to) = (piece.search_place(step - 1), piece.search_place(step));
            let bend = |share: usize| {
                let phi = from + (to - from) * share as f64 / 4.0;
                let touch = self.cam.touch(piece, phi);
                self.cam.curve_rates(&touch, self.offset).1.abs()
            };
            let least = (0..=4).map(bend).fold(f64::INFINITY, f64::min);
            (to - from) * (0.5 * least / (8.0 * SHARE * self.tolerance)).sqrt()
        };
        (1..=piece.intervals).map(sides).sum()
    }

    /// Whether one side may span from … to.
    fn may_span(&self, piece: &Piece, from: f64, to: f64) -> bool {
        let span = to - from;
        let (mut bend, mut turn) = (0.0f64, 0.0f64);
        for step in 0..=8 {
            let phi = from + span * f64::from(step) / 8.0;
            let touch = self.cam.touch(piece, phi);
            let (rate, curving) = self.cam.curve_rates(&touch, self.offset);
            bend = bend.max(curving.abs());
            // The curve's direction turns by |κ|·rate, however short it is.
            turn = turn.max((curving / rate).abs());
            if rate == 0.0 {
                turn = turn.max(self.reference_turn(&touch));
            }
        }
        span * span * bend <= 8.0 * SHARE * self.tolerance && span * turn <= MOST_TURN
    }

    fn reference_turn(&self, touch: &super::contact::Touch<f64>) -> f64 {
        match self.cam.geometry().roller() {
            Some(_) => (touch.rate * touch.bend).abs(),
            None => touch.rate.abs(),
        }
    }

    /// Where the normal jumps, the arc about the corner of the reference curve.
    fn corner(&mut self, before: &Piece, after: &Piece) -> Result<(), Fault> {
        let (left, right) = (
            self.cam.touch(before, before.to),
            self.cam.touch(after, after.from),
        );
        if self.cam.geometry().roller().is_none() || self.offset == 0.0 {
            return Ok(());
        }
        let turn = super::contact::cross(left.normal, right.normal)
            .atan2(super::contact::dot(left.normal, right.normal));
        if turn.abs() < 1e-9 {
            return Ok(());
        }
        let step = (8.0 * SHARE * self.tolerance / self.offset.abs()).sqrt();
        let count = (turn.abs() / step.min(MOST_TURN)).ceil().max(1.0);
        if count > MOST_POINTS as f64 {
            return Err(self.too_many_points());
        }
        for index in 1..count as usize {
            let normal = super::contact::rotated(left.normal, turn * index as f64 / count);
            let point =
                super::contact::plus(left.point, super::contact::times(normal, self.offset));
            let point = self.cam.in_cam(self.cam.in_machine(point), before.to);
            self.push(before.to, point)?;
        }
        Ok(())
    }

    fn add_point(&mut self, piece: &Piece, phi: f64) -> Result<(), Fault> {
        let point = self.cam.curve_point(piece, phi, self.offset);
        self.push(phi, point)
    }

    /// Adds a corner, unless it is the one before to rounding.
    fn push(&mut self, phi: f64, point: [f64; 2]) -> Result<(), Fault> {
        if let Some(&last) = self.points.last()
            && self.are_same_point(last, point)
        {
            return Ok(());
        }
        if self.points.len() >= MOST_POINTS {
            return Err(self.too_many_points());
        }
        self.angles.push(phi);
        self.points.push(point);
        Ok(())
    }

    fn are_same_point(&self, a: [f64; 2], b: [f64; 2]) -> bool {
        let size = self.cam.geometry().prime_radius() + self.cam.motion().stroke();
        let apart = (a[0] - b[0]).hypot(a[1] - b[1]);
        apart <= 1e-12 * size.max(b[0].hypot(b[1]))
    }

    /// The end of a closed curve is its beginning.
    fn close_curve(&mut self) {
        while self.points.len() > 1
            && self.are_same_point(self.points[0], self.points[self.points.len() - 1])
        {
            self.points.pop();
            self.angles.pop();
        }
    }

    fn too_many_points(&self) -> Fault {
        let message = format!(
            "a chord tolerance of {} m takes more than {MOST_POINTS} points",
            shown(self.tolerance, 7)
        );
        Fault::new("tolerance", message, "give a coarser tolerance")
    }
}

impl Polygon {
    /// Places where the polygon crosses itself: φ of both sides, the first
    /// twenty. Sides that only touch at a corner do not cross.
    pub fn crossings(&self) -> Vec<[f64; 2]> {
        let count = self.points.len();
        let sides = if self.closed {
            count
        } else {
            count.saturating_sub(1)
        };
        let mut boxes: Vec<(f64, f64, usize)> = (0..sides)
            .map(|side| {
                let [a, b] = self.side(side);
                (a[0].min(b[0]), a[0].max(b[0]), side)
            })
            .collect();
        // Sides are compared only while their shadows on the x axis overlap.
        boxes.sort_by_cached_key(|&(low, _, side)| (Total(low), side));
        let mut found = Vec::new();
        let mut active: Vec<(f64, usize)> = Vec::new();
        for &(low, high, side) in &boxes {
            active.retain(|&(end, _)| end >= low);
            for &(_, other) in &active {
                let (one, two) = (side.min(other), side.max(other));
                let neighbours = two - one <= 1 || (self.closed && one == 0 && two == sides - 1);
                if !neighbours && cross_at(self.side(one), self.side(two)) {
                    found.push([self.angles[one], self.angles[two]]);
                }
            }
            active.push((high, side));
        }
        found.sort_by_cached_key(|angles: &[f64; 2]| angles.map(Total));
        found.truncate(20);
        found
    }

    fn side(&self, index: usize) -> [[f64; 2]; 2] {
        let next = (index + 1) % self.points.len();
        [self.points[index], self.points[next]]
    }

    /// Length of all sides.
    pub fn length(&self) -> f64 {
        let count = self.points.len();
        let sides = if self.closed {
            count
        } else {
            count.saturating_sub(1)
        };
        (0..sides)
            .map(|index| {
                let [a, b] = self.side(index);
                (b[0] - a[0]).hypot(b[1] - a[1])
            })
            .sum()
    }
}

/// Whether two segments cross in their insides.
fn cross_at(one: [[f64; 2]; 2], two: [[f64; 2]; 2]) -> bool {
    let turn = |a: [f64; 2], b: [f64; 2], c: [f64; 2]| {
        (b[0] - a[0]) * (c[1] - a[1]) - (b[1] - a[1]) * (c[0] - a[0])
    };
    let apart = |a: f64, b: f64| (a > 0.0 && b < 0.0) || (a < 0.0 && b > 0.0);
    apart(turn(one[0], one[1], two[0]), turn(one[0], one[1], two[1]))
        && apart(turn(two[0], two[1], one[0]), turn(two[0], two[1], one[1]))
}
