//! A motion that is written as an expression of time.

use crate::fault::{Fault, Faults};
use crate::kinematics::breaks::Breaks;
use crate::math::expression::Scalar as _;
use crate::math::expression::{
    Expression, Interval, MOST, OfOne, Program, RateBounds, Repetition, TaylorBounds, Third,
};
use crate::math::jet::Jet;

/// Jumps of a displacement or a speed below this share of its size are rounding.
const JUMP: f64 = 1e-9;

/// φ = factor·f(t), f an expression of the time in s.
#[derive(Clone, Debug, PartialEq)]
pub struct WrittenMotion {
    /// As it was written.
    text: String,
    factor: f64,
    function: OfOne,
    breaks: Breaks,
}

impl WrittenMotion {
    /// A motion of a drive; its displacement and its speed must not jump.
    ///
    /// # Errors
    /// Pieces that cannot be told, jumps, values that are not finite; paths relative to
    /// `motion`.
    pub fn new(expression: &Expression, factor: f64) -> Result<Self, Vec<Fault>> {
        let mut faults = Faults::default();
        let path = "expression";
        let (motion, whole) = Self::of(expression.program(), expression.text(), factor, MOST);
        if !whole {
            let message = "its pieces change too often";
            let hint = "conditions that repeat, sin(2*pi*t) > 0, or of t itself, t < 2";
            faults.add(path, message, hint);
            faults.check()?;
        }
        let start = motion.jet(motion.breaks.segment_at(0.0, 1.0), 0.0);
        if !start.is_finite() {
            let message = format!(
                "\"{}\" has no finite value, speed, acceleration and jerk at t = 0",
                motion.text
            );
            faults.add(path, message, "");
        }
        motion.check_jumps(path, &mut faults);
        faults.check()?;
        Ok(motion)
    }

    /// A function of time, its pieces followed to so many places; whether that is all.
    pub(crate) fn of(program: &Program, text: &str, factor: f64, most: usize) -> (Self, bool) {
        let (function, whole) = OfOne::new(program, most);
        let breaks = Breaks {
            points: function.points.clone(),
            period: function.period,
        };
        let motion = Self {
            text: text.to_owned(),
            factor,
            function,
            breaks,
        };
        (motion, whole)
    }

    /// Bounds of the value between two times, by the formula of `segment`.
    pub(super) fn bounds(&self, segment: i64, from: f64, to: f64) -> Interval {
        let time = RateBounds {
            value: Interval::between(from, to),
            rate: Interval::of(1.0),
        };
        let (piece, turn) = self.piece(segment);
        self.function.at(time, piece, turn).value
    }

    /// The value alone, by the formula of `segment`.
    pub(super) fn value(&self, segment: i64, time: f64) -> f64 {
        let (piece, turn) = self.piece(segment);
        self.factor * self.function.at(time, piece, turn)
    }

    /// The piece of a segment, and how many periods on it is.
    fn piece(&self, segment: i64) -> (usize, i64) {
        let (piece, _) = self.breaks.piece(segment);
        let turn = match self.breaks.period {
            Some(_) => segment.div_euclid(self.breaks.points.len().max(1) as i64),
            None => 0,
        };
        (piece, turn)
    }

    fn check_jumps(&self, path: &str, faults: &mut Faults) {
        let count = self.breaks.points.len() as i64;
        let first = if self.breaks.period.is_some() { -1 } else { 0 };
        for segment in first..first + count {
            let at = self.breaks.edges(segment).1;
            let (before, behind) = (self.jet(segment, at), self.jet(segment + 1, at));
            for (what, a, b) in [
                ("displacement", before.value, behind.value),
                ("speed", before.first, behind.first),
            ] {
                if !((a - b).abs() <= JUMP * (a.abs().max(b.abs()) + self.factor.abs())) {
                    let message =
                        format!("the {what} jumps at t = {at} s, from {a} to {b} in SI units");
                    let hint = "a motion goes on without a jump of displacement and speed; \
                                for moves and dwells give a `plan`";
                    faults.add(path, message, hint);
                    return;
                }
            }
        }
    }

    /// As it was written.
    pub fn text(&self) -> &str {
        &self.text
    }

    /// Factor on the value of the expression.
    pub fn factor(&self) -> f64 {
        self.factor
    }

    /// How the motion repeats from ever to ever, where the expression proves it.
    pub(crate) fn repetition(&self) -> Option<Repetition> {
        let scaled = |own: Repetition| match own {
            Repetition::Line(slope) => Repetition::Line(self.factor * slope),
            Repetition::Cycles { period, advance } => Repetition::Cycles {
                period,
                advance: self.factor * advance,
            },
        };
        self.function.repetition().map(scaled)
    }

    /// Displacement and its derivatives, by the formula of `segment`.
    pub(crate) fn jet(&self, segment: i64, time: f64) -> Jet {
        let (piece, turn) = self.piece(segment);
        let jet = self.function.at(Third::variable(time), piece, turn).0;
        jet.scaled(self.factor)
    }

    /// Bounds of the speed between two times of a segment; not numbers where none are known.
    pub(crate) fn speeds(&self, segment: i64, from: f64, to: f64) -> [f64; 2] {
        let (piece, turn) = self.piece(segment);
        let time = RateBounds {
            value: Interval::between(from, to),
            rate: Interval::of(1.0),
        };
        let rate = self.function.at(time, piece, turn).rate;
        let ends = [rate.low, rate.high].map(|end| self.factor * end);
        match self.factor < 0.0 {
            true => [ends[1], ends[0]],
            false => ends,
        }
    }

    /// Bounds of the first Taylor coefficients between two times of a segment.
    pub(crate) fn enclosed<const N: usize>(
        &self,
        segment: i64,
        from: f64,
        to: f64,
    ) -> [Interval; N] {
        let (piece, turn) = self.piece(segment);
        let time = TaylorBounds::<N>::variable(from, to);
        let found = self.function.at(time, piece, turn);
        found.affine(self.factor, 0.0).0
    }

    /// Times at which the formula changes.
    pub(crate) fn breaks(&self) -> &Breaks {
        &self.breaks
    }
}
