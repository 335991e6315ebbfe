//! What is asked of a linkage of several inputs.

use super::super::request::{InputCourse, InputOver, NO_TIME, Over, Question};
use super::super::subject::{of_outputs, start_of};
use super::input_range::{InputReach, range_of_input};
use crate::dynamics::model::{Coordinate, Model, MultiLinkageBody};
use crate::dynamics::trajectory::Trajectory;
use crate::kinematics::linkage::multi::{MultiLinkage, MultiMotion, NotAssembled};

/// Part of a reach that is kept away from singular positions at its ends.
const ROOM: f64 = 1e-6;

/// A question about a linkage of several inputs that can be answered.
#[derive(Clone, Debug)]
pub struct AskedSeveral<'a> {
    pub(super) object: String,
    pub(in crate::studies) linkage: MultiLinkage,
    /// Whether each input turns or slides.
    pub(super) inputs: Vec<Coordinate>,
    /// Whether each output turns or slides.
    pub(super) outputs: Vec<Coordinate>,
    /// Displacements of the inputs at the start of the scene.
    pub(super) starts: Vec<f64>,
    pub(super) trajectories: Option<Vec<Trajectory<'a>>>,
    pub(super) way: Advance,
    /// True: the one input that moves goes through a turn.
    pub(in crate::studies) closed: bool,
    /// Ends of what it can go through.
    pub(super) limits: Vec<(f64, NotAssembled)>,
    pub(in crate::studies) positions: usize,
    pub(super) also: Option<f64>,
}

/// What leads from row to row.
#[derive(Clone, Debug)]
pub(super) enum Advance {
    /// Time, under the motions of the scene's drives, until here (s).
    Time { to: f64 },
    /// A straight way of the inputs.
    Path {
        /// The one input that moves: its coordinate is the axis. `None`: several move, and the
        /// axis goes from 0 to 1.
        along: Option<usize>,
        span: [f64; 2],
        /// Rate of the axis (1/s times its unit).
        rate: f64,
        legs: Vec<Leg>,
    },
}

/// One input on a straight way: base + slope·s.
#[derive(Clone, Copy, Debug)]
pub(super) struct Leg {
    pub(super) base: f64,
    pub(super) slope: f64,
    pub(super) speed: f64,
    pub(super) acceleration: f64,
}

impl<'a> AskedSeveral<'a> {
    /// Makes the question complete.
    ///
    /// # Errors
    /// What cannot be answered, in words.
    pub fn new(
        model: &'a Model,
        body: &MultiLinkageBody,
        question: &Question,
    ) -> Result<Self, String> {
        let linkage = MultiLinkage::clone(&body.linkage);
        let spec = &linkage.spec().linkage;
        let trajectories: Option<Vec<_>> = (body.inputs.iter())
            .map(|&node| Trajectory::of(model, node))
            .collect();
        let mut asked = Self {
            object: model.objects[body.object].id.clone(),
            inputs: (linkage.inputs().iter())
                .map(|input| Coordinate::sliding(input.coordinate.slides(spec)))
                .collect(),
            outputs: of_outputs(spec),
            starts: body
                .inputs
                .iter()
                .map(|&node| start_of(model, node))
                .collect(),
            trajectories,
            way: Advance::Time {
                to: question.duration,
            },
            closed: false,
            limits: Vec::new(),
            positions: question.positions,
            also: question.also,
            linkage,
        };
        asked.check(question)?;
        let over_time = match question.over {
            Some(Over::Time { to }) => Some(to),
            None if question.inputs.is_empty() && asked.trajectories.is_some() => {
                Some(question.duration)
            }
            _ => None,
        };
        match over_time {
            Some(to) => asked.over_time(to, question)?,
            None => asked.over_path(question)?,
        }
        question.check_place(asked.span())?;
        Ok(asked)
    }

    fn check(&self, question: &Question) -> Result<(), String> {
        question.check_positions()?;
        if question.speed.or(question.acceleration).is_some() {
            return Err(format!(
                "`{}` has several inputs: name the input of this speed or acceleration, as in {}=…",
                self.object,
                self.name(0)
            ));
        }
        if let Some(Over::Range { .. }) = question.over {
            return Err(format!(
                "`{}` has several inputs: name the input of this range, as in {}=0:90 deg",
                self.object,
                self.name(0)
            ));
        }
        for (index, course) in question.inputs.iter().enumerate() {
            self.input(&course.name)?;
            if question.inputs[..index]
                .iter()
                .any(|other| other.name == course.name)
            {
                return Err(format!("the input `{}` is named twice", course.name));
            }
            let range = match course.over {
                Some(InputOver::At(value)) => [value, value],
                Some(InputOver::Range { from, to }) => [from, to],
                Some(InputOver::Free) | None => [0.0; 2],
            };
            let numbers = [
                course.speed.unwrap_or(0.0),
                course.acceleration.unwrap_or(0.0),
            ];
            if !range.iter().chain(&numbers).all(|value| value.is_finite()) {
                return Err(format!(
                    "`{}`: values, speeds and accelerations must be finite numbers",
                    course.name
                ));
            }
        }
        Ok(())
    }

    fn over_time(&mut self, to: f64, question: &Question) -> Result<(), String> {
        if !question.inputs.is_empty() {
            return Err(
                "over time the scene's drives move all inputs: omit the inputs, or give their \
                 paths"
                    .to_owned(),
            );
        }
        if self.trajectories.is_none() {
            return Err(format!(
                "not all inputs of `{}` have a prescribed motion: how they move over time follows \
                 from the forces (`dam run`); give the path of an input",
                self.object
            ));
        }
        if !(to.is_finite() && to > 0.0) {
            return Err(NO_TIME.to_owned());
        }
        self.way = Advance::Time { to };
        Ok(())
    }

    fn over_path(&mut self, question: &Question) -> Result<(), String> {
        let courses: Vec<Option<&InputCourse>> = (0..self.inputs.len())
            .map(|input| {
                let mut named = question.inputs.iter();
                named.find(|course| course.name == self.name(input))
            })
            .collect();
        let over = |input: usize| courses[input].and_then(|course| course.over);
        let mut at = self.starts.clone();
        let mut moving = Vec::new();
        for (input, at) in at.iter_mut().enumerate() {
            match over(input) {
                Some(InputOver::At(value)) => *at = value,
                Some(InputOver::Range { from, .. }) => {
                    *at = from;
                    moving.push(input);
                }
                Some(InputOver::Free) => moving.push(input),
                None => {}
            }
        }
        if moving.is_empty() {
            // Nothing is said of the ways: the first that is not held goes as far as it can.
            let held = |&input: &usize| !matches!(over(input), Some(InputOver::At(_)));
            moving.extend((0..self.inputs.len()).find(held));
        }
        // Of ranges without length one is enough: with all inputs held there is one position.
        let still = |&input: &usize| matches!(over(input), Some(InputOver::Range { from, to }) if from == to);
        let single = moving
            .iter()
            .all(still)
            .then(|| moving.first().copied().unwrap_or(0));
        moving.retain(|input| !still(input));
        moving.extend(single);
        let first = moving[0];
        let free = |input: usize| !matches!(over(input), Some(InputOver::Range { .. }));
        if moving.len() > 1 && moving.iter().any(|&input| free(input)) {
            return Err("of several inputs that move, each needs a range, FROM:TO".to_owned());
        }
        let (along, span) = match (moving.as_slice(), over(first)) {
            ([_], Some(InputOver::Range { from, to })) => (Some(first), [from, to]),
            ([_], Some(InputOver::At(at))) => (Some(first), [at, at]),
            ([_], _) => (Some(first), self.free_range_of_input(&at, first)?),
            _ => (None, [0.0, 1.0]),
        };
        let slope = |input: usize| match (along, over(input)) {
            (Some(along), _) => f64::from(u8::from(along == input)),
            (None, Some(InputOver::Range { from, to })) => to - from,
            _ => 0.0,
        };
        let given = courses[first].and_then(|course| course.speed);
        let uniform = self.trajectories.as_ref();
        let uniform = uniform.and_then(|all| all[first].constant_speed());
        let speed = given.or(uniform).unwrap_or(1.0);
        let rate = match along {
            Some(_) => speed,
            None => speed / slope(first).abs(),
        };
        let legs = (0..self.inputs.len()).map(|input| Leg {
            base: if along == Some(input) { 0.0 } else { at[input] },
            slope: slope(input),
            speed: courses[input]
                .and_then(|course| course.speed)
                .unwrap_or(rate * slope(input)),
            acceleration: courses[input]
                .and_then(|course| course.acceleration)
                .unwrap_or(0.0),
        });
        self.way = Advance::Path {
            along,
            span,
            rate,
            legs: legs.collect(),
        };
        self.begins()
    }

    /// A turn of an input, or as far as it goes.
    fn free_range_of_input(&mut self, at: &[f64], input: usize) -> Result<[f64; 2], String> {
        let turning = self.inputs[input] == Coordinate::Turning;
        match range_of_input(&self.linkage, at, input, turning) {
            InputReach::Turn => {
                self.closed = true;
                Ok([at[input], at[input] + std::f64::consts::TAU])
            }
            InputReach::Between(ends) => {
                let [(from, _), (to, _)] = ends;
                self.limits = ends.to_vec();
                let room = ROOM * (to - from);
                Ok([from + room, to - room])
            }
            InputReach::Unknown => Err(format!(
                "`{name}` of `{}` goes on without an end: say over which range, as in \
                 {name}=0:100 mm",
                self.object,
                name = self.name(input)
            )),
        }
    }

    /// The first place must be one at which the linkage can be assembled.
    fn begins(&self) -> Result<(), String> {
        let mut motion = MultiMotion::new(&self.linkage);
        motion
            .set_inputs(&self.inputs_at(self.span()[0]))
            .map_err(|why| {
                format!(
                    "`{}` cannot be assembled where the path of its inputs begins: {}",
                    self.object,
                    self.cause_in_words(why)
                )
            })
    }

    fn input(&self, name: &str) -> Result<usize, String> {
        let names = self.linkage.input_names();
        let found = names.iter().position(|known| *known == name);
        found.ok_or_else(|| {
            format!(
                "`{}` has no input `{name}`; one of {}",
                self.object,
                names.join(", ")
            )
        })
    }
}
