//! Switches on the way: of pairs, by impacts, of tracks.

use super::tracks::Tracks;
use super::{EventLoop, Listener, RemainderStep};
use crate::dynamics::integrate::{Dynamics, Impact, Stop, SwitchEvent};

impl EventLoop<'_> {
    /// Tells the switch that ended the present phase of a branch.
    pub(super) fn take_switch(
        &mut self,
        index: usize,
        given: Option<&RemainderStep<'_>>,
        listener: &mut dyn Listener,
    ) {
        let Some((component, mode, impact)) = self.branches[index].switched() else {
            return;
        };
        if self.modes.0[component] == mode && impact.is_none() {
            return;
        }
        if self.branches.len() > 1 || given.is_some() {
            self.current_state(given);
        }
        self.branches[index].end_state(&mut self.y);
        self.switches += 1;
        match impact {
            None => self.change(component, mode, listener),
            Some((impact, coordinate)) => self.report_impact(mode, &impact, coordinate, listener),
        }
    }

    /// Tells an impact, after which a mode is in force; the state is that after it.
    pub(super) fn report_impact(
        &mut self,
        mode: i64,
        impact: &Impact,
        coordinate: usize,
        listener: &mut dyn Listener,
    ) {
        self.before.0.copy_from_slice(&self.modes.0);
        self.modes.0[impact.component] = mode;
        let mut before = self.y.clone();
        before[self.y.len() / 2 + coordinate] = impact.side as f64 * impact.approach;
        listener.switch(&SwitchEvent {
            time: self.time,
            y: &self.y,
            watch: None,
            before: &self.before,
            after: &self.modes,
            impact: Some((impact, &before)),
        });
    }

    pub(super) fn pass_tracks(
        &mut self,
        given: Option<&RemainderStep<'_>>,
        listener: &mut dyn Listener,
    ) {
        let Some(tracks) = &mut self.tracks else {
            return;
        };
        for (component, mode) in tracks.track_changes_at(self.system, self.time, &self.modes) {
            self.current_state(given);
            self.change(component, mode, listener);
        }
    }

    pub(super) fn change(&mut self, component: usize, mode: i64, listener: &mut dyn Listener) {
        self.before.0.copy_from_slice(&self.modes.0);
        self.modes.0[component] = mode;
        listener.switch(&SwitchEvent {
            time: self.time,
            y: &self.y,
            watch: None,
            before: &self.before,
            after: &self.modes,
            impact: None,
        });
    }

    /// A change of a component that was found elsewhere, where the walk stands, in the
    /// state y of the whole.
    pub(crate) fn take_change(
        &mut self,
        (component, mode): (usize, i64),
        y: &[f64],
        listener: &mut dyn Listener,
    ) {
        let follows = |tracks: &Tracks<'_>| tracks.follows(self.system, component);
        // What follows from the drives alone is found here.
        if self.stop.is_some() || self.tracks.as_ref().is_some_and(follows) {
            return;
        }
        self.y.copy_from_slice(y);
        self.switches += u64::from(self.system.is_pair(component));
        self.change(component, mode, listener);
        self.check_switches();
    }

    pub(super) fn check_switches(&mut self) {
        let limits = self.clock.limits;
        if self.stop.is_none() && self.time < self.end && self.switches > limits.switches {
            let bound = limits.switches;
            self.stop = Some(Stop::TooManySwitches { bound });
        }
    }
}
