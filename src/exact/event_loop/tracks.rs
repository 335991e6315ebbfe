//! Which piece of a law or table is in force: tracks over prescribed motions
//! and over time.

use crate::dynamics::integrate::{Dynamics, Modes};
use crate::dynamics::model::TrackSource;
use crate::dynamics::system::System;
use crate::exact::Parts;
use crate::exact::from_model::{PrescribedMotion, Target, fit_course, place_inside};
use crate::kinematics::breaks::Breaks;

/// Pieces of a motion that are looked through at once: a walk that may be ended looks at the
/// others when it gets there.
const AT_ONCE: u32 = 256;

/// A track over a prescribed displacement.
struct Follower<'a> {
    course: &'a PrescribedMotion,
    breaks: &'a Breaks,
    component: usize,
    /// Time of the next change, and its segment, or time from which on the next change is to
    /// be looked for, and the present segment; +∞: not before the end.
    next: (f64, i64),
}

/// All tracks of a system.
pub(super) struct Tracks<'a> {
    followers: Vec<Follower<'a>>,
    /// Number of pairs, whose components come before those of the tracks.
    pairs: usize,
    end: f64,
}

impl<'a> Tracks<'a> {
    pub(super) fn new(system: &'a System, parts: &'a Parts, end: f64) -> Self {
        let model = system.model();
        let pairs = (0..)
            .take_while(|&component| system.is_pair(component))
            .count();
        let followers = model
            .tracks
            .iter()
            .enumerate()
            .filter_map(|(index, track)| {
                let TrackSource::Node(node) = track.source else {
                    return None;
                };
                let course = parts.courses[node].as_ref()?;
                Some(Follower {
                    course,
                    breaks: &track.breaks,
                    component: pairs + index,
                    next: (f64::INFINITY, 0),
                })
            });
        Self {
            followers: followers.collect(),
            pairs,
            end,
        }
    }

    /// Sets the segments in which the motion leaves the start (a drive that
    /// starts from rest on an edge shows only later which way it goes), and
    /// looks for the first changes.
    pub(super) fn set_first_segments(&mut self, modes: &mut Modes) {
        for follower in &mut self.followers {
            let formulas = follower.course.formulas(0.0);
            let limits = follower
                .course
                .interval_around(follower.breaks, &formulas, 0.0);
            modes.0[follower.component] = follower.breaks.segment_at(place_inside(limits), 1.0);
            follower.find_next_change(0.0, self.end);
        }
    }

    /// True for the component of a track that is followed here: over time or
    /// over a prescribed displacement.
    pub(super) fn follows(&self, system: &System, component: usize) -> bool {
        let tracks = &system.model().tracks;
        // (Beyond the tracks come directions of friction and conditions of loads.)
        let over_time = |track: usize| {
            (tracks.get(track)).is_some_and(|track| track.source == TrackSource::Time)
        };
        let prescribed = |follower: &Follower<'_>| follower.component == component;
        let track = component.checked_sub(self.pairs);
        track.is_some_and(over_time) || self.followers.iter().any(prescribed)
    }

    /// The next change of any track after `time` (s).
    pub(super) fn next_change(&self, system: &System, time: f64, modes: &Modes) -> f64 {
        let followers = self.followers.iter().map(|follower| follower.next.0);
        let over_time = system.next_break(time, modes);
        followers.fold(over_time, f64::min)
    }

    /// The components that change at `time`, and their new values.
    pub(super) fn track_changes_at(
        &mut self,
        system: &System,
        time: f64,
        modes: &Modes,
    ) -> Vec<(usize, i64)> {
        let now = time + super::RESOLUTION * time.abs();
        let mut changes = Vec::new();
        let mut after = modes.clone();
        system.pass_break(time, &mut after);
        for (component, (old, new)) in modes.0.iter().zip(&after.0).enumerate() {
            if old != new {
                changes.push((component, *new));
            }
        }
        for follower in &mut self.followers {
            if follower.next.0 <= now {
                if modes.0[follower.component] != follower.next.1 {
                    changes.push((follower.component, follower.next.1));
                }
                follower.find_next_change(follower.next.0, self.end);
            }
        }
        changes
    }
}

impl Follower<'_> {
    /// Finds the next change after `time`, up to `end`, or how far there is none.
    fn find_next_change(&mut self, mut time: f64, end: f64) {
        self.next = (f64::INFINITY, 0);
        let held = self
            .course
            .interval_around(self.breaks, &self.course.formulas(time), time);
        for _ in 0..AT_ONCE {
            if !(time < end) {
                return;
            }
            let turn = self.course.time_of_next_turn(time).min(end);
            let axis = Some(self.breaks);
            let found = fit_course(
                self.course,
                time,
                turn.min(end - time).max(1e-12 * end),
                Target::Displacement,
                axis,
            );
            let Some(found) = found else { return };
            time = found.end;
            let formulas = self.course.formulas(time);
            let (low, high) = self.course.interval_around(self.breaks, &formulas, time);
            if (low, high) != held {
                let inside = place_inside((low, high));
                self.next = (time, self.breaks.segment_at(inside, 1.0));
                return;
            }
        }
        if time < end {
            self.next = (time, self.breaks.segment_at(place_inside(held), 1.0));
        }
    }
}
