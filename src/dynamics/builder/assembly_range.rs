//! Positions that cannot be assembled, found before the run.

use super::{ModelBuilder, Place};
use crate::dynamics::model::{Coordinate, Law, NodeIndex, Track, TrackSource};
use crate::dynamics::trajectory::{Trajectory, transfer};
use crate::kinematics::breaks::Breaks;
use crate::kinematics::constraint::Constraint;
use crate::kinematics::motion::DriveMotion;
use crate::kinematics::position::OutOfReach;
use crate::math::roots::bisect;
use crate::units::shown;

/// What is at the ends of a reach.
pub(super) const DEAD: &str = "in a dead-centre position";

/// Most instants looked at when a motion is followed over the run.
const MOST_INSTANTS: f64 = 200_000.0;

/// The first time up to `duration` at which a trajectory leaves an open interval; `None`:
/// never.
fn exit_time(way: &Trajectory<'_>, (from, to): (f64, f64), duration: f64) -> Option<f64> {
    if let Some(DriveMotion::Constant { speed, angle }) = way.as_drive() {
        let edge = if *speed > 0.0 { to } else { from };
        let time = (edge - angle) / speed;
        return (time.is_finite() && time <= duration).then_some(time);
    }
    // One degree of the fastest drive at a time, as far as that is affordable.
    let speed = (0..=1000)
        .map(|i| way.fastest_drive(duration * f64::from(i) / 1000.0))
        .fold(0.0, f64::max);
    let most = (MOST_INSTANTS / (way.count_of_laws() + 1) as f64).max(1000.0);
    let count = (speed * duration).to_degrees().clamp(1000.0, most) as u32;
    let time = |index: u32| duration * f64::from(index) / f64::from(count);
    // Beyond a dead-centre position upstream the displacement is not a number, nor
    // outside: that position is reported for the object upstream.
    let outside = |time: f64| {
        let end = way.at(time).value;
        end <= from || end >= to
    };
    let index = (1..=count).find(|&index| outside(time(index)))?;
    let ends = [time(index - 1), time(index)];
    let [_, after] = bisect(ends, 60, |time| !outside(time));
    Some(after)
}

impl ModelBuilder {
    /// Displacement of a node at t = 0.
    pub fn start_of(&self, node: NodeIndex) -> f64 {
        self.known[node].start
    }

    /// Displacement at t = 0 of a node that follows a law.
    pub(super) fn displacement_at_start(&self, law: &Law) -> f64 {
        transfer(&self.model, law, self.start_of(law.driver), 1.0).value
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
            displacement_text(self.start_of(driver), coordinate)
        );
        let within: Vec<_> = outside
            .intervals
            .iter()
            .map(|&interval| range(interval, coordinate))
            .collect();
        let hint = format!("start `{input}` {}", within.join(" or "));
        self.fault(at, property, message, &hint);
    }

    /// Displacement at t = 0 of a node that several drive.
    pub(super) fn combined(&self, drivers: &[NodeIndex], constraint: &Constraint) -> f64 {
        let starts: Vec<f64> = drivers.iter().map(|&node| self.start_of(node)).collect();
        constraint.value(&starts)
    }

    /// Ends the run where the driver leaves `reach`, and warns of it; `ends` says
    /// what is there.
    pub(super) fn limit_driver(
        &mut self,
        at: &Place,
        driver: NodeIndex,
        reach: (f64, f64),
        ends: &str,
    ) {
        let way = Trajectory::of(&self.model, driver);
        let left = way.and_then(|way| exit_time(&way, reach, self.duration));
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
            repeats: false,
            stops: true,
            object: at.object,
        });
    }
}

/// Digits of a place: edges are told closely.
const DIGITS: usize = 9;

pub(super) fn displacement_text(displacement: f64, coordinate: Coordinate) -> String {
    let (value, unit) = coordinate.displacement_for_reading(displacement);
    format!("{} {unit}", shown(value, DIGITS))
}

pub(super) fn range((from, to): (f64, f64), coordinate: Coordinate) -> String {
    let (from, to) = (
        coordinate.displacement_for_reading(from),
        coordinate.displacement_for_reading(to),
    );
    let (from, to, unit) = (shown(from.0, DIGITS), shown(to.0, DIGITS), to.1);
    format!("between {from} and {to} {unit}")
}
