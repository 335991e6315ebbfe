//! What happens where a step is cut: switches and breaks in time.

use super::{Run, Verdict};
use crate::dynamics::integrate::locate::{LocatedEvent, Stretch};
use crate::dynamics::integrate::{
    Dynamics, EventFunction, Guard, Impact, Modes, Stop, SwitchEvent,
};

/// Switches at one and the same instant after which a run is given up.
const MOST_AT_ONCE: u32 = 64;

/// Switches of loads by expressions after which a run is asked for its progress, and the
/// least share of the rest that it must have gone.
const MOST_CROSSINGS: u32 = 1000;
const LEAST_PROGRESS: f64 = 1e-6;

/// Switches within so many roundings of the clock are at one instant.
const AT_ONCE: f64 = 4.0;

impl<D: Dynamics> Run<'_, D> {
    /// The step up to a switch, and the switch.
    pub(super) fn switch_within_step(&mut self, found: LocatedEvent) -> Verdict {
        let watch = self.watch(found);
        let step = self.output.step(found.s);
        let stretch = Stretch {
            step,
            from: &self.from,
            to: &self.to,
            zero_at_start: &self.zero_at_start,
            touching: &self.touching,
        };
        let causes: Vec<Guard> = match found.watch < self.event_functions.len() {
            true => stretch.causes(&watch, found.s).collect(),
            false => Vec::new(),
        };
        if found.s > 0.0 {
            self.sink.step(&step, &self.evaluator.modes.borrow());
        }
        // What has just switched is still zero while the clock has hardly moved.
        if found.s * step.length > AT_ONCE * f64::EPSILON * step.start.abs() {
            self.zero_at_start.clear();
        }
        self.zero_at_start.extend(causes);
        let time = if found.s == 1.0 {
            self.to.time
        } else {
            step.end_time()
        };
        let mut y = std::mem::take(&mut self.to.y);
        match found.s {
            0.0 => y.copy_from_slice(&self.from.y),
            1.0 => {}
            s => step.state(s, &mut y),
        }
        self.switches_at_once = if time > self.from.time {
            0
        } else {
            self.switches_at_once + 1
        };
        let crossing = found.watch >= self.event_functions.len() + self.probes.len();
        let verdict = self.switch(time, &mut y, &watch);
        self.to.y = y;
        if verdict == Verdict::Stop {
            return verdict;
        }
        if let Some(stop) = crossing.then(|| self.count_crossing(time)).flatten() {
            return self.end(stop);
        }
        match self.check_limits() {
            Verdict::Continue => Verdict::Restart,
            stop => stop,
        }
    }

    /// Counts a switch that [`Dynamics::first_crossing`] found; the stop of a run that does
    /// not get on for them.
    fn count_crossing(&mut self, time: f64) -> Option<Stop> {
        let (count, since) = self.crossings;
        if count + 1 < MOST_CROSSINGS {
            self.crossings.0 += 1;
            return None;
        }
        self.crossings = (0, time);
        let progress = time - since;
        (progress < LEAST_PROGRESS * (self.target - since)).then(|| Stop::Method {
            method: self.settings.method,
            reason: format!(
                "a load jumps or bends {MOST_CROSSINGS} times within {progress:e} s, up to \
                 t = {time} s: its pieces become shorter and shorter"
            ),
        })
    }

    fn switch(&mut self, time: f64, y: &mut [f64], watch: &EventFunction) -> Verdict {
        self.remember_length();
        let before = self.evaluator.modes.borrow().clone();
        let mut after = before.clone();
        let dynamics = self.evaluator.dynamics;
        let struck = y.to_vec();
        let result = dynamics.switch(time, y, watch, &mut after);
        if dynamics.is_pair(watch.component) && result.is_ok() {
            self.switches += 1;
        }
        let impact = result.as_ref().ok().copied().flatten();
        let impact = impact.as_ref().map(|impact| (impact, struck.as_slice()));
        let apart = |function: &EventFunction| {
            let (c, open) = (function.component, after.0[function.component] == 0);
            open && before.0[c] == function.target && dynamics.is_rigid_contact(c)
        };
        let mut functions = Vec::new();
        dynamics.event_functions(&after, &mut functions);
        let mut released = Vec::new();
        for function in functions.iter().filter(|function| apart(function)) {
            self.zero_at_start.push(function.guards[0]);
            released.push(function.component);
        }
        self.enter(time, y, (before, after), Some(watch), impact);
        self.resting.retain(|own| own.component != watch.component);
        self.release_touching();
        self.find_touching(|own| !own.rising && own.component == watch.component);
        self.keep_apart(&released);
        if let Err(stop) = result {
            return self.end(Stop::Physical(stop));
        }
        if self.switches_at_once > MOST_AT_ONCE {
            let reason = format!(
                "component {} changes to and fro {MOST_AT_ONCE} times at t = {time} s without \
                 moving on",
                watch.component
            );
            let method = self.settings.method;
            return self.end(Stop::Method { method, reason });
        }
        Verdict::Restart
    }

    /// Passes the break in time that the run has just reached.
    pub(in crate::dynamics::integrate) fn pass_break(&mut self) {
        self.remember_length();
        let before = self.evaluator.modes.borrow().clone();
        let mut after = before.clone();
        let time = self.from.time;
        self.evaluator.dynamics.pass_break(time, &mut after);
        let y = self.from.y.clone();
        self.enter(time, &y, (before, after), None, None);
    }

    /// Puts new modes in force at (`time`, `y`) and tells the sink.
    fn enter(
        &mut self,
        time: f64,
        y: &[f64],
        (before, after): (Modes, Modes),
        watch: Option<&EventFunction>,
        impact: Option<(&Impact, &[f64])>,
    ) {
        self.fresh = true;
        self.given_longest = f64::INFINITY;
        self.forget_trial();
        *self.evaluator.modes.borrow_mut() = after.clone();
        self.evaluator
            .dynamics
            .event_functions(&after, &mut self.event_functions);
        self.evaluator.dynamics.probes(&after, &mut self.probes);
        self.find_singularities();
        self.move_to(time, y);
        self.sink.switch(&SwitchEvent {
            time,
            y,
            watch,
            before: &before,
            after: &after,
            impact,
        });
    }
}
