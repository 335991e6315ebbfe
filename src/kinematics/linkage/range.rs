//! How far the input of a linkage can go.

use super::structure::Structure;
use crate::units::shown;
use std::f64::consts::TAU;
use std::fmt;

/// Range of the input from the start, without taking the linkage apart.
#[derive(Clone, Debug, PartialEq)]
pub struct Range {
    /// The input at which the approximate positions hold (rad or m).
    pub start: f64,
    /// Everywhere, or an interval around the start.
    pub reach: Reach,
    /// After which the whole configuration repeats; where it does, the reach is
    /// everywhere.
    pub period: Option<Period>,
    /// Change points, passed on the branch of continuous velocity; ascending,
    /// within one period from the start where there is one.
    pub changes: Vec<ChangePoint>,
}

/// The input displacements that can be reached.
#[derive(Clone, Debug, PartialEq)]
pub enum Reach {
    /// All.
    Everywhere,
    /// Coordinates between two ends; dead-centre positions are left out, the ends of the travel
    /// belong to it.
    Interval {
        /// The lower end.
        lower: RangeEnd,
        /// The upper end.
        upper: RangeEnd,
    },
}

/// End of the reach.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct RangeEnd {
    /// The input there (rad or m).
    pub at: f64,
    /// Why it goes no further.
    pub cause: Cause,
}

/// Why the input goes no further.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Cause {
    /// A group is in a dead-centre position: velocities grow without bound. Of a group
    /// solved by iteration also a position in which two of its assemblies meet.
    DeadPosition {
        /// Index into [`Structure::groups`].
        group: usize,
    },
    /// The travel given for the driver ends.
    Travel,
    /// Not looked further: 64 turns, or 100 times the size of the linkage.
    Unexplored,
}

/// A displacement of the input after which everything repeats.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Period {
    /// The displacement (rad).
    pub length: f64,
    /// Period in turns of the driver: 1, or more where the configuration repeats only
    /// then.
    pub turns: usize,
}

/// A position in which all links of a dyad are in line and its two assemblies meet.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct ChangePoint {
    /// The input there (rad or m).
    pub at: f64,
    /// Index into [`Structure::groups`].
    pub group: usize,
}

/// The linkage cannot be assembled at an input displacement.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct OutOfReach {
    /// The input asked for (rad or m).
    pub input: f64,
    /// The end of the reach that lies before it.
    pub end: RangeEnd,
    /// Both ends of the reach (rad or m).
    pub reach: [f64; 2],
}

impl fmt::Display for OutOfReach {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        let (input, [from, to]) = (self.input, self.reach);
        let cause = match self.end.cause {
            Cause::DeadPosition { .. } => "a dead-centre position",
            Cause::Travel => "the end of the travel",
            Cause::Unexplored => "the end of what was explored",
        };
        write!(
            f,
            "{input} lies outside {from} to {to}: {cause} at {}",
            self.end.at
        )
    }
}

impl std::error::Error for OutOfReach {}

impl Range {
    /// Ends of the reach, infinite where it goes everywhere.
    pub fn ends(&self) -> [f64; 2] {
        match self.reach {
            Reach::Everywhere => [f64::NEG_INFINITY, f64::INFINITY],
            Reach::Interval { lower, upper } => [lower.at, upper.at],
        }
    }

    /// The ends of the reach that are dead-centre positions, each with the other end.
    pub fn dead_ends(&self) -> Vec<[f64; 2]> {
        let Reach::Interval { lower, upper } = self.reach else {
            return Vec::new();
        };
        let dead = |[end, _]: &[RangeEnd; 2]| matches!(end.cause, Cause::DeadPosition { .. });
        let ends = [[lower, upper], [upper, lower]].into_iter().filter(dead);
        ends.map(|ends| ends.map(|end| end.at)).collect()
    }

    /// The range in words, `turning` telling degrees from metres.
    pub fn describe(&self, structure: &Structure, turning: bool) -> String {
        let number = |at: f64| match turning {
            true => format!(
                "{} deg",
                shown(without_negative_zero(at.to_degrees(), 1e-6), 9)
            ),
            false => format!("{} m", shown(without_negative_zero(at, 1e-9), 9)),
        };
        let mut text = match (&self.reach, self.period) {
            (Reach::Everywhere, Some(Period { turns: 1, .. })) => "turns fully".to_owned(),
            (Reach::Everywhere, Some(Period { length, turns })) => {
                let length = shown(length, 7);
                format!("turns fully, repeats after {turns} turns ({length} rad)")
            }
            (Reach::Everywhere, None) => "goes everywhere".to_owned(),
            (Reach::Interval { lower, upper }, _) => {
                let why = |end: &RangeEnd| match end.cause {
                    Cause::DeadPosition { group } => {
                        format!("dead-centre position of {}", structure.describe(group))
                    }
                    Cause::Travel => "end of the travel".to_owned(),
                    Cause::Unexplored => "not explored further".to_owned(),
                };
                format!(
                    "from {} ({}) to {} ({})",
                    number(lower.at),
                    why(lower),
                    number(upper.at),
                    why(upper)
                )
            }
        };
        let together = |one: &ChangePoint, other: &ChangePoint| number(one.at) == number(other.at);
        for meeting in self.changes.chunk_by(together) {
            let group = structure.describe(meeting[0].group);
            let more = match meeting.len() - 1 {
                0 => String::new(),
                1 => " and another group".to_owned(),
                more => format!(" and {more} other groups"),
            };
            text += &format!(
                "; passes a change point at {} ({group}{more})",
                number(meeting[0].at)
            );
        }
        text
    }
}

/// Zero for what is shown as zero, which has no sign.
fn without_negative_zero(number: f64, digit: f64) -> f64 {
    if number.abs() < 0.5 * digit {
        0.0
    } else {
        number
    }
}

impl Period {
    pub(super) fn of_turns(turns: usize) -> Self {
        Self {
            length: TAU * turns as f64,
            turns,
        }
    }
}
