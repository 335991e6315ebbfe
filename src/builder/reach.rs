//! Positions that cannot be assembled, found before the run.

use super::{ModelBuilder, Place};
use crate::breaks::Breaks;
use crate::constraint::Constraint;
use crate::math::jet::Jet;
use crate::math::roots::bisect;
use crate::model::{Coordinate, Law, NodeIndex, Track, TrackSource};
use crate::motion::DriveMotion;
use crate::position::{OutOfReach, Position};
use crate::units::shown;

/// What is at the ends of a reach.
pub(super) const DEAD: &str = "in a dead position";

/// Most instants looked at when a motion is followed over the run.
const MOST_INSTANTS: f64 = 200_000.0;

/// Where an object is as long as every mass follows its law.
#[derive(Clone, Debug)]
pub(super) struct Course {
    /// Displacement at t = 0.
    pub(super) start: f64,
    origin: Origin,
}

#[derive(Clone, Debug)]
enum Origin {
    /// A drive whose motion is known.
    Prescribed(DriveMotion),
    /// A motor: known at t = 0 only.
    Motor,
    /// A law over the displacement of another node.
    Follows(NodeIndex, Step),
    /// A constraint over the displacements of several nodes.
    Combines(Vec<NodeIndex>, Constraint),
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

/// A node's motion as far as it is prescribed.
struct Way<'s> {
    builder: &'s ModelBuilder,
    node: NodeIndex,
    /// The drives that it comes from.
    drives: Vec<&'s DriveMotion>,
    /// Number of laws on the way.
    steps: usize,
}

impl Way<'_> {
    fn displacement(&self, time: f64) -> f64 {
        self.builder.at(self.node, time)
    }

    /// The first time up to `duration` at which the displacement leaves an open
    /// interval; `None`: never.
    fn leaves(&self, (from, to): (f64, f64), duration: f64) -> Option<f64> {
        if let ([DriveMotion::Constant { speed, angle }], 0) = (&self.drives[..], self.steps) {
            let edge = if *speed > 0.0 { to } else { from };
            let time = (edge - angle) / speed;
            return (time.is_finite() && time <= duration).then_some(time);
        }
        // One degree of the fastest drive at a time, as far as that is affordable.
        let speed = |time: f64| {
            let speeds = self
                .drives
                .iter()
                .map(|drive| instant(drive, time).first.abs());
            speeds.fold(0.0, f64::max)
        };
        let speed = (0..=1000)
            .map(|i| speed(duration * f64::from(i) / 1000.0))
            .fold(0.0, f64::max);
        let most = (MOST_INSTANTS / (self.steps + 1) as f64).max(1000.0);
        let count = (speed * duration).to_degrees().clamp(1000.0, most) as u32;
        let time = |index: u32| duration * f64::from(index) / f64::from(count);
        // Beyond a dead position upstream the displacement is not a number, nor
        // outside: that position is reported for the object upstream.
        let outside = |time: f64| {
            let end = self.displacement(time);
            end <= from || end >= to
        };
        let index = (1..=count).find(|&index| outside(time(index)))?;
        let ends = [time(index - 1), time(index)];
        let [_, after] = bisect(ends, 60, |time| !outside(time));
        Some(after)
    }
}

impl ModelBuilder {
    /// Displacement of a node at t = 0.
    pub fn start_of(&self, node: NodeIndex) -> f64 {
        self.known[node].start
    }

    /// Where a node will be that follows a law.
    pub(super) fn following(&self, law: &Law) -> Course {
        let step = Step {
            position: law.position.clone(),
            breaks: law.position.breaks(),
            lever: law.lever,
        };
        Course {
            start: step.displacement(self.start_of(law.driver)),
            origin: Origin::Follows(law.driver, step),
        }
    }

    /// Notes that a position function does not exist where its driver starts.
    pub(super) fn refuse_start(
        &mut self,
        at: &Place,
        property: &str,
        driver: NodeIndex,
        outside: &OutOfReach,
    ) {
        let (input, coordinate) = self.owner(driver);
        let message = format!(
            "it cannot be assembled at the start, with `{input}` at {}",
            place(self.start_of(driver), coordinate)
        );
        let within: Vec<_> = outside
            .intervals
            .iter()
            .map(|&interval| range(interval, coordinate))
            .collect();
        let hint = format!("start `{input}` {}", within.join(" or "));
        self.fault(at, property, message, &hint);
    }

    /// Where a node will be that several drive.
    pub(super) fn combined(&self, drivers: &[NodeIndex], constraint: &Constraint) -> Course {
        let starts: Vec<f64> = drivers.iter().map(|&node| self.start_of(node)).collect();
        Course {
            start: constraint.value(&starts),
            origin: Origin::Combines(drivers.to_vec(), constraint.clone()),
        }
    }

    fn origin(&self, node: NodeIndex) -> &Origin {
        &self.courses[self.known[node].course].origin
    }

    /// Displacement at `time` of a node whose motion is prescribed; NaN of any other.
    fn at(&self, node: NodeIndex, time: f64) -> f64 {
        match self.origin(node) {
            Origin::Prescribed(motion) => instant(motion, time).value,
            Origin::Motor => f64::NAN,
            Origin::Follows(driver, step) => step.displacement(self.at(*driver, time)),
            Origin::Combines(drivers, constraint) => {
                let places: Vec<f64> = drivers.iter().map(|&node| self.at(node, time)).collect();
                constraint.value(&places)
            }
        }
    }

    /// The way to a node from the drives that prescribe its motion; `None` behind a
    /// motor.
    fn way(&self, node: NodeIndex) -> Option<Way<'_>> {
        let (mut drives, mut steps) = (Vec::new(), 0);
        let mut open = vec![node];
        while let Some(node) = open.pop() {
            match self.origin(node) {
                Origin::Motor => return None,
                Origin::Prescribed(motion) => drives.push(motion),
                Origin::Follows(driver, _) => {
                    steps += 1;
                    open.push(*driver);
                }
                Origin::Combines(drivers, _) => {
                    steps += drivers.len();
                    open.extend(drivers);
                }
            }
        }
        Some(Way {
            builder: self,
            node,
            drives,
            steps,
        })
    }

    /// Ends the run where the driver leaves `reach`, and warns of it; `ends` says
    /// what is there.
    pub(super) fn limit(&mut self, at: &Place, driver: NodeIndex, reach: (f64, f64), ends: &str) {
        let left = self
            .way(driver)
            .and_then(|way| way.leaves(reach, self.duration));
        if let Some(time) = left {
            let (input, coordinate) = self.owner(driver);
            let warning = format!(
                "`{}` can be assembled only with `{input}` {}; its law leads out of that at \
                 t = {} s, where the run stops {ends}",
                at.id,
                range(reach, coordinate),
                shown(time, 6)
            );
            self.warn(warning);
        }
        self.model.tracks.push(Track {
            source: TrackSource::Node(driver),
            breaks: Breaks {
                points: vec![reach.0, reach.1],
                period: None,
            },
            stops: true,
            object: at.object,
        });
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
