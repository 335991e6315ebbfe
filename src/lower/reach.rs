//! Positions that cannot be assembled, found before the run.

use super::Lowering;
use crate::breaks::Breaks;
use crate::model::{Coordinate, Track, TrackSource};
use crate::motion::DriveMotion;
use crate::position::Position;
use crate::scene::StartSpec;

/// Most instants looked at when a motion is followed over the run.
const MOST_INSTANTS: f64 = 200_000.0;

/// Where an object is over time, as long as every mass follows its law.
#[derive(Clone, Debug)]
pub(super) struct Course {
    source: Source,
    steps: Vec<Step>,
}

#[derive(Clone, Debug)]
enum Source {
    /// Known over time.
    Prescribed(DriveMotion),
    /// Known at t = 0 only.
    Start(f64),
}

/// One law on the way from the source.
#[derive(Clone, Debug)]
struct Step {
    position: Position,
    breaks: Breaks,
    lever: f64,
}

impl Course {
    /// A drive's prescribed motion.
    pub(super) fn prescribed(motion: DriveMotion) -> Self {
        Self {
            source: Source::Prescribed(motion),
            steps: Vec::new(),
        }
    }

    /// A displacement known at t = 0 only.
    pub(super) fn starting_at(displacement: f64) -> Self {
        Self {
            source: Source::Start(displacement),
            steps: Vec::new(),
        }
    }

    /// Displacement at a time (of a motor: at t = 0 whatever the time).
    fn displacement(&self, time: f64) -> f64 {
        let mut displacement = match &self.source {
            Source::Prescribed(motion) => motion.jet(motion.breaks().locate(time, 1.0), time).value,
            Source::Start(displacement) => *displacement,
        };
        for step in &self.steps {
            let segment = step.breaks.locate(displacement, 1.0);
            displacement = step.lever * step.position.jet(segment, displacement).value;
        }
        displacement
    }

    fn followed(&self, position: &Position, lever: f64) -> Self {
        let mut course = self.clone();
        course.steps.push(Step {
            position: position.clone(),
            breaks: position.breaks(),
            lever,
        });
        course
    }

    /// The first time up to `duration` at which the displacement leaves the
    /// open interval; `None`: never, or not known.
    fn leaves(&self, (from, to): (f64, f64), duration: f64) -> Option<f64> {
        let Source::Prescribed(motion) = &self.source else {
            return None;
        };
        if let (DriveMotion::Constant { speed, angle }, []) = (motion, &*self.steps) {
            let edge = if *speed > 0.0 { to } else { from };
            let time = (edge - angle) / speed;
            return (time.is_finite() && time <= duration).then_some(time);
        }
        // One degree of the drive at a time, as far as that is affordable.
        let speed = (0..=1000)
            .map(|i| {
                let time = duration * f64::from(i) / 1000.0;
                motion.jet(motion.breaks().locate(time, 1.0), time).first
            })
            .fold(0.0, |most: f64, speed| most.max(speed.abs()));
        let instants = (speed * duration).to_degrees().clamp(1000.0, MOST_INSTANTS);
        let count = instants as u32;
        let time = |index: u32| duration * f64::from(index) / f64::from(count);
        // Beyond a dead position upstream the displacement is not a number:
        // that one is reported for the object upstream.
        let outside = |time: f64| {
            let displacement = self.displacement(time);
            displacement <= from || displacement >= to
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
}

impl<'a> Lowering<'a> {
    /// Notes where an object will be on its law, and checks that its position
    /// function exists there: at t = 0 (a fault), over the run where the motion
    /// is known (a warning), and during the run (a stopping track).
    pub(super) fn follow(
        &mut self,
        id: &'a str,
        input: &str,
        position: &Position,
        lever: f64,
    ) -> Option<()> {
        let course = self.courses.get(input)?.clone();
        let phi = self
            .explicit_output(input)
            .unwrap_or_else(|| course.displacement(0.0));
        let coordinate = self.model.objects[self.indices[input]].coordinate;
        let reach = match position.reach_from(phi) {
            Ok(reach) => reach,
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
        };
        if let Some(reach) = reach {
            self.limit(id, input, reach, &course);
        }
        let start = position.breaks().locate(phi, 1.0);
        let own = match course.source {
            // An explicit start moves what follows a motor.
            Source::Start(_) => Course::starting_at(lever * position.jet(start, phi).value),
            Source::Prescribed(_) => course.followed(position, lever),
        };
        self.courses.insert(id, own);
        Some(())
    }

    fn limit(&mut self, id: &str, input: &str, reach: (f64, f64), course: &Course) {
        let object = self.indices[id];
        let coordinate = self.model.objects[self.indices[input]].coordinate;
        if let Some(time) = course.leaves(reach, self.scene.run.duration) {
            self.model.warnings.push(format!(
                "`{id}` can be assembled only with `{input}` {}; its law leads out of that at \
                 t = {time:.6} s, where the run stops in a dead position",
                range(reach, coordinate)
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

fn place(displacement: f64, coordinate: Coordinate) -> String {
    match coordinate {
        Coordinate::Turning => format!("{:.6} deg", displacement.to_degrees()),
        Coordinate::Sliding => format!("{displacement:.9} m"),
    }
}

fn range((from, to): (f64, f64), coordinate: Coordinate) -> String {
    match coordinate {
        Coordinate::Turning => {
            let (from, to) = (from.to_degrees(), to.to_degrees());
            format!("between {from:.6} and {to:.6} deg")
        }
        Coordinate::Sliding => format!("between {from:.9} and {to:.9} m"),
    }
}
