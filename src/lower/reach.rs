//! Positions that cannot be assembled, found before the run.

use super::Lowering;
use crate::breaks::Breaks;
use crate::jet::Jet;
use crate::model::{Coordinate, Track, TrackSource};
use crate::motion::DriveMotion;
use crate::position::Position;
use crate::scene::StartSpec;
use crate::units::shown;

/// What is at the ends of a reach.
pub(super) const DEAD: &str = "in a dead position";

/// Most instants looked at when a motion is followed over the run.
const MOST_INSTANTS: f64 = 200_000.0;

/// Where an object is as long as every mass follows its law.
#[derive(Clone, Debug)]
pub(super) struct Course {
    /// Displacement at t = 0.
    start: f64,
    origin: Origin,
}

#[derive(Clone, Debug)]
enum Origin {
    /// A drive whose motion is known.
    Prescribed(DriveMotion),
    /// A motor: known at t = 0 only.
    Motor,
    /// A law over the displacement of another object.
    Follows(String, Step),
}

/// One law on the way from the drive.
#[derive(Clone, Debug)]
struct Step {
    position: Position,
    breaks: Breaks,
    lever: f64,
}

impl Step {
    fn displacement(&self, driver: f64) -> f64 {
        let segment = self.breaks.locate(driver, 1.0);
        self.lever * self.position.jet(segment, driver).value
    }
}

impl Course {
    /// A drive's prescribed motion.
    pub(super) fn prescribed(motion: &DriveMotion) -> Self {
        Self {
            start: instant(motion, 0.0).value,
            origin: Origin::Prescribed(motion.clone()),
        }
    }

    /// A motor that starts at an angle.
    pub(super) fn motor(angle: f64) -> Self {
        Self {
            start: angle,
            origin: Origin::Motor,
        }
    }
}

fn instant(motion: &DriveMotion, time: f64) -> Jet {
    motion.jet(motion.breaks().locate(time, 1.0), time)
}

/// The first time up to `duration` at which the displacement, from a drive's
/// motion through the laws of `steps`, leaves an open interval; `None`: never.
fn leaves(
    motion: &DriveMotion,
    steps: &[&Step],
    (from, to): (f64, f64),
    duration: f64,
) -> Option<f64> {
    if let (DriveMotion::Constant { speed, angle }, []) = (motion, steps) {
        let edge = if *speed > 0.0 { to } else { from };
        let time = (edge - angle) / speed;
        return (time.is_finite() && time <= duration).then_some(time);
    }
    // One degree of the drive at a time, as far as that is affordable.
    let speed = (0..=1000)
        .map(|i| {
            instant(motion, duration * f64::from(i) / 1000.0)
                .first
                .abs()
        })
        .fold(0.0, f64::max);
    let most = (MOST_INSTANTS / (steps.len() + 1) as f64).max(1000.0);
    let count = (speed * duration).to_degrees().clamp(1000.0, most) as u32;
    let time = |index: u32| duration * f64::from(index) / f64::from(count);
    // Beyond a dead position upstream the displacement is not a number, nor
    // outside: that position is reported for the object upstream.
    let outside = |time: f64| {
        let drive = instant(motion, time).value;
        let end = steps.iter().fold(drive, |at, step| step.displacement(at));
        end <= from || end >= to
    };
    let index = (1..=count).find(|&index| outside(time(index)))?;
    let (mut before, mut after) = (time(index - 1), time(index));
    for _ in 0..60 {
        let middle = 0.5 * (before + after);
        if outside(middle) {
            after = middle;
        } else {
            before = middle;
        }
    }
    Some(after)
}

impl<'a> Lowering<'a> {
    /// Notes where an object will be on its law, and checks that its position
    /// function exists there: at t = 0 (a fault), over the run where the motion
    /// is known (a warning), and during the run (a stopping track).
    pub(super) fn follow(
        &mut self,
        id: &str,
        input: &str,
        position: &Position,
        lever: f64,
    ) -> Option<()> {
        let phi = self.start_of(input)?;
        let coordinate = self.model.objects[self.indices[input]].coordinate;
        match position.reach_from(phi) {
            Ok(None) => {}
            Ok(Some(reach)) => self.limit(id, input, reach, DEAD),
            Err(outside) => {
                let message = format!(
                    "it cannot be assembled at the start, with `{input}` at {}",
                    place(phi, coordinate)
                );
                let within: Vec<_> = outside
                    .intervals
                    .iter()
                    .map(|&interval| range(interval, coordinate))
                    .collect();
                let hint = format!("start `{input}` {}", within.join(" or "));
                self.faults.add(format!("{id}.position"), message, &hint);
                return None;
            }
        }
        self.note_course(id, input, position, lever)
    }

    /// Displacement at t = 0 of an object, or of an output of one.
    pub(super) fn start_of(&self, input: &str) -> Option<f64> {
        let on_law = self.courses.get(input)?.start;
        Some(self.explicit_output(input).unwrap_or(on_law))
    }

    /// Notes where an object will be on its law.
    pub(super) fn note_course(
        &mut self,
        id: &str,
        input: &str,
        position: &Position,
        lever: f64,
    ) -> Option<()> {
        let step = Step {
            position: position.clone(),
            breaks: position.breaks(),
            lever,
        };
        let course = Course {
            start: step.displacement(self.start_of(input)?),
            origin: Origin::Follows(input.to_owned(), step),
        };
        self.courses.insert(id.to_owned(), Box::new(course));
        Some(())
    }

    /// The prescribed motion that an object follows, with the laws from there
    /// to it in order; `None` behind a motor.
    fn way<'s>(&'s self, mut id: &'s str) -> Option<(&'s DriveMotion, Vec<&'s Step>)> {
        let mut steps = Vec::new();
        loop {
            match &self.courses.get(id)?.origin {
                Origin::Motor => return None,
                Origin::Prescribed(motion) => {
                    steps.reverse();
                    return Some((motion, steps));
                }
                Origin::Follows(input, step) => {
                    steps.push(step);
                    id = input;
                }
            }
        }
    }

    /// Ends the run where the driver leaves `reach`, and warns of it; `ends` says
    /// what is there.
    pub(super) fn limit(&mut self, id: &str, input: &str, reach: (f64, f64), ends: &str) {
        let object = self.indices[id];
        let coordinate = self.model.objects[self.indices[input]].coordinate;
        let duration = self.scene.run.duration;
        let left = self
            .way(input)
            .and_then(|(motion, steps)| leaves(motion, &steps, reach, duration));
        if let Some(time) = left {
            self.model.warnings.push(format!(
                "`{id}` can be assembled only with `{input}` {}; its law leads out of that at \
                 t = {} s, where the run stops {ends}",
                range(reach, coordinate),
                shown(time, 6)
            ));
        }
        if let Some(&node) = self.outputs.get(input) {
            self.model.tracks.push(Track {
                source: TrackSource::Node(node),
                breaks: Breaks {
                    points: vec![reach.0, reach.1],
                    period: None,
                },
                stops: true,
                object,
            });
        }
    }

    /// Displacement of an object's last mass in an explicit start.
    fn explicit_output(&self, id: &str) -> Option<f64> {
        match &self.scene.run.start {
            StartSpec::Explicit(states) => states.get(id)?.0.last().copied(),
            _ => None,
        }
    }
}

pub(super) fn place(displacement: f64, coordinate: Coordinate) -> String {
    match coordinate {
        Coordinate::Turning => format!("{:.6} deg", displacement.to_degrees()),
        Coordinate::Sliding => format!("{displacement:.9} m"),
    }
}

pub(super) fn range((from, to): (f64, f64), coordinate: Coordinate) -> String {
    match coordinate {
        Coordinate::Turning => {
            let (from, to) = (from.to_degrees(), to.to_degrees());
            format!("between {from:.6} and {to:.6} deg")
        }
        Coordinate::Sliding => format!("between {from:.9} and {to:.9} m"),
    }
}
