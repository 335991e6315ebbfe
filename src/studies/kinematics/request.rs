//! What is asked of a linkage, and what is known of its input's motion.

use super::subject::Subject;
use crate::dynamics::model::{Coordinate, Model};
use crate::dynamics::trajectory::Trajectory;
use crate::kinematics::linkage::{Cause, Linkage, Reach};
use crate::math::jet::Jet;

/// Part of a reach that is kept away from dead-centre positions at its ends.
const ROOM: f64 = 1e-6;

/// Most rows of a study.
pub const MOST_POSITIONS: usize = 1_000_000;

/// Over what a linkage is looked at.
#[derive(Clone, Copy, Debug, PartialEq)]
pub enum Over {
    /// A turn: one period of the input.
    Turn,
    /// A range of the input coordinate (rad or m).
    Range {
        /// From here.
        from: f64,
        /// To here.
        to: f64,
    },
    /// Time from 0 on, under the motion of the scene's drive.
    Time {
        /// Until here (s).
        to: f64,
    },
}

/// Why a time is none.
pub(super) const NO_TIME: &str = "the time must be a number above zero";

/// Number of intervals between rows, unless another is asked for.
pub const POSITIONS: usize = 360;

/// A question as it is put.
#[derive(Clone, Debug, PartialEq)]
pub struct Question {
    /// The linkage's id; may be left out where there is one only.
    pub object: Option<String>,
    /// Over what; left out: a period where the input can turn fully and turns
    /// uniformly, else time where the drive's motion is known, else the reach.
    pub over: Option<Over>,
    /// Number of intervals between rows.
    pub positions: usize,
    /// Speed of the input over a turn or range (rad/s or m/s); left out: that
    /// of a uniform drive, else 1.
    pub speed: Option<f64>,
    /// Acceleration of the input over a turn or range.
    pub acceleration: Option<f64>,
    /// Duration of the scene's run (s), for [`Over::Time`] by default; 0: that of the
    /// scene asked.
    pub duration: f64,
    /// A place on the axis that shall have a row of its own.
    pub also: Option<f64>,
    /// Of a linkage of several inputs: what is said of each. Those that nothing is said of
    /// stay where the scene starts; where nothing is said of any, all follow the scene's
    /// drives over time, or, where these are not known, the first goes as far as it can.
    pub inputs: Vec<InputCourse>,
}

/// What one of several inputs does over a study.
#[derive(Clone, Debug, PartialEq)]
pub struct InputCourse {
    /// Name of the input.
    pub name: String,
    /// Where it goes; `None`: it stays where the scene starts.
    pub over: Option<InputOver>,
    /// Its speed at every position (rad/s or m/s); left out: that of the way, on which the
    /// first input that moves has the speed of its uniform drive, else 1.
    pub speed: Option<f64>,
    /// Its acceleration at every position; left out: 0.
    pub acceleration: Option<f64>,
}

/// Where one of several inputs goes.
#[derive(Clone, Copy, Debug, PartialEq)]
pub enum InputOver {
    /// It is held at a value (rad or m).
    At(f64),
    /// It goes evenly from one value to another, all that move together.
    Range {
        /// From here.
        from: f64,
        /// To here.
        to: f64,
    },
    /// A turn, or as far as it goes, the others held.
    Free,
}

impl Default for Question {
    /// Of the only linkage, in 360 intervals, over what suits it.
    fn default() -> Self {
        Self {
            object: None,
            over: None,
            positions: POSITIONS,
            speed: None,
            acceleration: None,
            duration: 0.0,
            also: None,
            inputs: Vec::new(),
        }
    }
}

impl Question {
    /// # Errors
    /// No positions, or too many.
    pub(super) fn check_positions(&self) -> Result<(), String> {
        match self.positions {
            1..=MOST_POSITIONS => Ok(()),
            count => Err(format!("{count} positions: give 1 to {MOST_POSITIONS}")),
        }
    }

    /// # Errors
    /// The place that is looked at besides lies outside.
    pub(super) fn check_place(&self, [from, to]: [f64; 2]) -> Result<(), String> {
        match self.also {
            Some(also) if !(from.min(to) <= also && also <= from.max(to)) => Err(format!(
                "the place {also} is outside the range: {from} to {to}"
            )),
            _ => Ok(()),
        }
    }
}

/// A question that can be answered.
#[derive(Clone, Debug)]
pub struct KinematicsRequest<'a> {
    pub(in crate::studies) model: &'a Model,
    pub(in crate::studies) object: String,
    pub(in crate::studies) linkage: Linkage,
    pub(in crate::studies) input: Coordinate,
    /// Whether each output turns or slides.
    pub(super) outputs: Vec<Coordinate>,
    pub(super) trajectory: Option<Trajectory<'a>>,
    pub(in crate::studies) over: Over,
    pub(in crate::studies) positions: usize,
    pub(super) also: Option<f64>,
    /// Speed and acceleration over a turn or range.
    pub(in crate::studies) rate: [f64; 2],
    /// True when the speed is that of nothing: 1.
    pub(in crate::studies) unit_rate: bool,
}

impl<'a> KinematicsRequest<'a> {
    /// Makes the question complete.
    ///
    /// # Errors
    /// What cannot be answered, in words.
    pub fn new(model: &'a Model, question: &Question) -> Result<Self, String> {
        let subject = Subject::of(model, question.object.as_deref())?;
        if let Some(input) = question.inputs.first() {
            return Err(format!(
                "`{}` has one input and none called `{}`: ask for a turn, a range or time",
                subject.object, input.name
            ));
        }
        Self::of(model, subject, question)
    }

    /// Question about a subject that is known already; the question's `object` is not
    /// looked at.
    ///
    /// # Errors
    /// What cannot be answered, in words.
    pub fn of(model: &'a Model, subject: Subject, question: &Question) -> Result<Self, String> {
        let trajectory = Trajectory::of(model, subject.node);
        let uniform = trajectory.as_ref().and_then(Trajectory::constant_speed);
        let over = match question.over {
            Some(over) => over,
            None => default_over(
                &subject.linkage,
                trajectory.is_some(),
                uniform,
                question.duration,
            ),
        };
        let over = inside_reach(&subject.linkage, over);
        let asked = Self {
            model,
            object: subject.object,
            linkage: subject.linkage,
            input: subject.input,
            outputs: subject.outputs,
            trajectory,
            over,
            positions: question.positions,
            also: question.also,
            rate: [
                question.speed.or(uniform).unwrap_or(1.0),
                question.acceleration.unwrap_or(0.0),
            ],
            unit_rate: question.speed.is_none() && uniform.is_none(),
        };
        asked.check(question)?;
        question.check_place(span(&asked))?;
        Ok(asked)
    }

    fn check(&self, question: &Question) -> Result<(), String> {
        question.check_positions()?;
        if !self.rate.iter().all(|value| value.is_finite()) {
            return Err("speed and acceleration must be finite numbers".to_owned());
        }
        match self.over {
            Over::Turn => match self.linkage.range().period {
                Some(_) => Ok(()),
                None => Err(format!(
                    "`{}` does not repeat after a turn: {}; ask for a range or for time",
                    self.object,
                    self.range_in_words()
                )),
            },
            Over::Range { from, to } if from.is_nan() || to.is_nan() => Err(format!(
                "`{}` goes everywhere: say over which range, as in --range \"0:100 mm\"",
                self.object
            )),
            Over::Range { from, to } if !(from.is_finite() && to.is_finite()) => Err(
                "a range needs two finite ends, or the same one twice for one position".to_owned(),
            ),
            Over::Range { from, .. } if self.is_outside(from) => Err(format!(
                "the range begins outside the range of motion of `{}`: {}",
                self.object,
                self.range_in_words()
            )),
            Over::Time { to } if !(to.is_finite() && to > 0.0) => Err(NO_TIME.to_owned()),
            Over::Time { .. } if question.speed.or(question.acceleration).is_some() => Err(
                "over time the scene's drive gives speed and acceleration: leave them out, or ask \
                 for a turn or a range"
                    .to_owned(),
            ),
            Over::Time { .. } if self.trajectory.is_none() => Err(format!(
                "`{}` is driven by a motor: its motion over time follows from the forces (`dam \
                 run`); ask for a turn or a range",
                self.object
            )),
            _ => Ok(()),
        }
    }

    fn is_outside(&self, at: f64) -> bool {
        let mut work = self.linkage.workspace();
        self.linkage.solve(at, 0, &mut work).is_err()
    }

    pub(super) fn range_in_words(&self) -> String {
        let turning = self.input == Coordinate::Turning;
        self.linkage
            .range()
            .describe(self.linkage.structure(), turning)
    }

    /// Input coordinate at which a turn begins.
    pub(in crate::studies) fn first_input(&self) -> f64 {
        match &self.trajectory {
            Some(trajectory) => trajectory.at(0.0).value,
            None => self.linkage.range().start,
        }
    }

    /// The input's motion at a place of the axis.
    pub(in crate::studies) fn input_at(&self, place: f64) -> Jet {
        match (self.over, &self.trajectory) {
            (Over::Time { .. }, Some(trajectory)) => trajectory.at(place),
            _ => Jet {
                value: place,
                first: self.rate[0],
                second: self.rate[1],
                third: 0.0,
            },
        }
    }
}

fn default_over(linkage: &Linkage, known: bool, uniform: Option<f64>, duration: f64) -> Over {
    let turns = linkage.range().period.is_some();
    if known && !(turns && uniform.is_some()) {
        return Over::Time { to: duration };
    }
    whole_travel(linkage)
}

/// A range that equals the reach, as far as its ends are told, lies inside it.
fn inside_reach(linkage: &Linkage, over: Over) -> Over {
    let (Over::Range { from, to }, &Reach::Interval { lower, upper }) =
        (over, &linkage.range().reach)
    else {
        return over;
    };
    let room = ROOM * (upper.at - lower.at);
    let mut work = linkage.workspace();
    let mut inside = |place: f64| {
        if linkage.solve(place, 0, &mut work).is_ok() {
            return place;
        }
        for (end, inwards) in [(lower, room), (upper, -room)] {
            if (place - end.at).abs() <= room {
                return match end.cause {
                    // Dead-centre positions themselves are left out.
                    Cause::DeadPosition { .. } => end.at + inwards,
                    Cause::Travel | Cause::Unexplored => end.at,
                };
            }
        }
        place
    };
    Over::Range {
        from: inside(from),
        to: inside(to),
    }
}

/// A period, or where there is none the whole reach but its very ends.
pub fn whole_travel(linkage: &Linkage) -> Over {
    let range = linkage.range();
    if range.period.is_some() {
        return Over::Turn;
    }
    // Where it goes everywhere, the ends are no numbers, which is refused.
    let [from, to] = range.ends();
    let room = ROOM * (to - from);
    Over::Range {
        from: from + room,
        to: to - room,
    }
}

/// First and last place on the axis.
pub(super) fn span(asked: &KinematicsRequest<'_>) -> [f64; 2] {
    match asked.over {
        Over::Time { to } => [0.0, to],
        Over::Range { from, to } => [from, to],
        Over::Turn => {
            let from = asked.first_input();
            let period = asked.linkage.range().period;
            let length = period.map_or(std::f64::consts::TAU, |period| period.length);
            let sense = if asked.input == Coordinate::Turning && asked.rate[0] < 0.0 {
                -1.0
            } else {
                1.0
            };
            [from, from + sense * length]
        }
    }
}
