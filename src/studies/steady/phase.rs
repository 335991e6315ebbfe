//! The map of the state over an angle of a drive that turns as its motor and its load
//! let it: the angle takes the place of time.

use super::map::{
    AGAIN, Map, Orbit, derivative_by_differences, derivative_by_greater_differences,
    integrate_from, rough_differences,
};
use super::portrait::Portrait;
use super::sink::Last;
use crate::budget::Budget;
use crate::dynamics::integrate::{Dynamics, Method, Modes, Sink, SwitchEvent};
use crate::dynamics::steady::Mean;
use crate::dynamics::system::System;
use crate::math::polynomial::Step;
use crate::units::shown;
use nalgebra::DMatrix;
use std::cell::Cell;

/// Carries a state from where the drive stands at φ = 0 over an angle. Its state is that
/// of the system, [u, u̇], without the drive's angle.
#[derive(Debug)]
pub(super) struct PhaseMap<'a> {
    system: &'a System,
    method: Method,
    budget: Budget<'a>,
    /// The drive's coordinate.
    rotor: usize,
    scales: Vec<f64>,
    /// Time for a radian, as it was last (s).
    pace: Cell<f64>,
}

/// Where and how a motion passes an angle of the drive.
#[derive(Clone, Debug)]
pub(super) struct Arrival {
    /// Time since the start (s).
    pub(super) time: f64,
    /// The state [u, u̇] of the system.
    y: Vec<f64>,
}

/// The drive is looked at after so much more than the time it took last.
const AHEAD: f64 = 1.01;
/// Looks without arriving, each at least as long as a turn at full speed.
const LOOKS: u32 = 400;
/// A drive that gains less than this in a look stands still (rad).
const STILL: f64 = 1e-9;
/// Corrections of the time of arrival.
const CORRECTIONS: u32 = 8;

impl<'a> PhaseMap<'a> {
    /// The map behind the drive with the coordinate `rotor`.
    pub(super) fn new(
        system: &'a System,
        rotor: usize,
        method: Method,
        budget: Budget<'a>,
    ) -> Self {
        let mut scales = system.scales().to_vec();
        let nominal = scales[system.coordinates() + rotor];
        scales.remove(rotor);
        Self {
            system,
            method,
            budget,
            rotor,
            scales,
            pace: Cell::new(1.0 / nominal),
        }
    }

    /// A speed that the drive has about (rad/s).
    pub(super) fn nominal_speed(&self) -> f64 {
        self.scales[self.speed()]
    }

    /// Where the drive's speed stands in a state.
    pub(super) fn speed(&self) -> usize {
        self.system.coordinates() - 1 + self.rotor
    }

    /// The system's state with the drive at an angle.
    pub(super) fn full_state(&self, state: &[f64], angle: f64) -> Vec<f64> {
        let mut y = state.to_vec();
        y.insert(self.rotor, angle);
        y
    }

    fn without_angle(&self, mut y: Vec<f64>) -> Vec<f64> {
        y.remove(self.rotor);
        y
    }

    fn integrate(
        &self,
        y: &[f64],
        modes: &Modes,
        time: f64,
        sink: &mut dyn Sink,
    ) -> Result<(), String> {
        integrate_from(self.system, self.method, self.budget, y, modes, time, sink)
    }

    /// From a state of the system to where the drive passes `target` (rad).
    fn arrive(&self, y: &[f64], target: f64) -> Result<Arrival, String> {
        let start = y[self.rotor];
        let mut at = y.to_vec();
        let mut modes = self.system.modes_at_start(y);
        let mut time = 0.0;
        for _ in 0..LOOKS {
            let rest = target - at[self.rotor];
            if rest <= 0.0 {
                return Ok(Arrival { time, y: at });
            }
            let leg = AHEAD * rest * self.pace.get().max(1.0 / self.nominal_speed());
            let mut sink = PhaseCrossing::new(self.rotor, target);
            self.integrate(&at, &modes, leg, &mut sink)?;
            if let Some(caught) = sink.caught {
                let arrival = self.arrival_on_step(caught, target, time)?;
                self.pace.set(arrival.time / (target - start));
                return Ok(arrival);
            }
            time += leg;
            let gained = sink.last.y[self.rotor] - at[self.rotor];
            (at, modes) = (sink.last.y, sink.modes);
            let speed = at[self.system.coordinates() + self.rotor];
            if gained < STILL && speed.abs() < STILL * self.nominal_speed() {
                let place = shown(at[self.rotor], 7);
                return Err(format!(
                    "the drive comes to rest at φ = {place} rad: what drives it is too weak \
                     for what it carries"
                ));
            }
            if gained < 0.0 && speed < 0.0 {
                let place = shown(at[self.rotor], 7);
                return Err(format!(
                    "the drive stalls and is turned backwards, at φ = {place} rad after \
                     {} s: what drives it is too weak for what it carries",
                    shown(time, 4)
                ));
            }
            self.pace.set(if speed > 0.0 {
                1.0 / speed
            } else {
                1.0 / self.nominal_speed()
            });
        }
        Err(format!(
            "the drive does not get from φ = {} to {} rad: after {} s it is at {} rad",
            shown(start, 7),
            shown(target, 7),
            shown(time, 4),
            shown(at[self.rotor], 7)
        ))
    }

    /// The arrival on a step that passes the target: integrated anew from the start of
    /// the step to just the time that the angle takes.
    fn arrival_on_step(
        &self,
        caught: CaughtStep,
        target: f64,
        before: f64,
    ) -> Result<Arrival, String> {
        let speed = self.system.coordinates() + self.rotor;
        let mut length = caught.length;
        let mut best: Option<(f64, Arrival)> = None;
        for _ in 0..CORRECTIONS {
            let mut last = Last::default();
            if !(length > 0.0) {
                break;
            }
            self.integrate(&caught.y, &caught.modes, length, &mut last)?;
            let miss = target - last.y[self.rotor];
            if best
                .as_ref()
                .is_some_and(|(least, _)| !(miss.abs() < *least))
            {
                break;
            }
            let arrival = Arrival {
                time: before + caught.time + length,
                y: last.y,
            };
            length += miss / arrival.y[speed];
            best = Some((miss.abs(), arrival));
            if miss == 0.0 {
                break;
            }
        }
        let standing = || Arrival {
            time: before + caught.time,
            y: caught.y.clone(),
        };
        Ok(best.map_or_else(standing, |(_, arrival)| arrival))
    }

    /// From any state of the system to the next place at which the drive has turned
    /// through whole cycles (rad); the state there.
    pub(super) fn to_section(&self, y: &[f64], cycle: f64) -> Result<Vec<f64>, String> {
        let target = cycle * (y[self.rotor] / cycle).ceil();
        let arrival = self.arrive(y, target)?;
        Ok(self.without_angle(arrival.y))
    }

    /// The state after an angle, and the mean speed on the way (rad/s).
    pub(super) fn pass(
        &self,
        state: &[f64],
        angle: f64,
        mean: Mean,
    ) -> Result<(Vec<f64>, f64), String> {
        let arrival = self.arrive(&self.full_state(state, 0.0), angle)?;
        let speed = match mean {
            Mean::Time => angle / arrival.time,
            Mean::Angle | Mean::Midrange => {
                let portrait = self.portrait(state, angle, 1)?;
                match mean {
                    Mean::Angle => portrait.speed_by_angle / angle,
                    _ => 0.5 * (portrait.least.value + portrait.greatest.value),
                }
            }
        };
        Ok((self.without_angle(arrival.y), speed))
    }

    /// The motion over an angle, looked at in `count` equal steps of it.
    pub(super) fn portrait(
        &self,
        state: &[f64],
        angle: f64,
        count: usize,
    ) -> Result<Portrait<'a>, String> {
        let y = self.full_state(state, 0.0);
        let Arrival { time, y: end } = self.arrive(&y, angle)?;
        let modes = self.system.modes_at_start(&y);
        let mut portrait = Portrait::new(self.system, self.rotor, angle, count);
        self.integrate(&y, &modes, time, &mut portrait)?;
        portrait.finish(time, &end);
        Ok(portrait)
    }
}

impl Map for PhaseMap<'_> {
    fn apply(&self, state: &[f64], angle: f64) -> Result<Vec<f64>, String> {
        let arrival = self.arrive(&self.full_state(state, 0.0), angle)?;
        Ok(self.without_angle(arrival.y))
    }

    fn monodromy(&self, state: &[f64], angle: f64) -> Result<DMatrix<f64>, String> {
        derivative_by_differences(self, state, angle)
    }

    fn slopes(&self, state: &[f64], end: &[f64], angle: f64) -> Result<DMatrix<f64>, String> {
        rough_differences(self, state, end, angle)
    }

    fn orbit(&self, state: &[f64], angle: f64, count: usize) -> Result<Orbit, String> {
        let portrait = self.portrait(state, angle, count)?;
        let rows = &portrait.rows;
        let others = (0..self.system.coordinates()).filter(|&one| one != self.rotor);
        let column = |one: usize| rows.iter().skip(1).map(|row| row.y[one]).collect();
        Ok(Orbit {
            times: rows.iter().skip(1).map(|row| row.time).collect(),
            columns: others.map(column).collect(),
        })
    }

    fn duration(&self, state: &[f64], angle: f64) -> Result<f64, String> {
        Ok(self.arrive(&self.full_state(state, 0.0), angle)?.time)
    }

    fn scales(&self) -> &[f64] {
        &self.scales
    }

    fn derivative_method(&self) -> &'static str {
        "central differences of the motion integrated over a cycle of the drive's angle, \
         extrapolated from two steps"
    }

    fn check(&self, state: &[f64], angle: f64) -> Result<DMatrix<f64>, String> {
        derivative_by_greater_differences(self, state, angle)
    }

    fn derivative_check(&self) -> &'static str {
        AGAIN
    }
}

/// The start of the step on which the drive passes an angle.
#[derive(Debug)]
struct CaughtStep {
    time: f64,
    y: Vec<f64>,
    modes: Modes,
    /// From there to the angle, about (s).
    length: f64,
}

/// Waits for the drive to pass an angle.
#[derive(Debug)]
struct PhaseCrossing {
    rotor: usize,
    target: f64,
    last: Last,
    modes: Modes,
    caught: Option<CaughtStep>,
}

impl PhaseCrossing {
    fn new(rotor: usize, target: f64) -> Self {
        Self {
            rotor,
            target,
            last: Last::default(),
            modes: Modes::default(),
            caught: None,
        }
    }
}

impl Sink for PhaseCrossing {
    fn start(&mut self, time: f64, y: &[f64], modes: &Modes) {
        self.last.start(time, y, modes);
        self.modes = modes.clone();
    }

    fn step(&mut self, step: &Step<'_>, modes: &Modes) {
        if self.caught.is_some() {
            return;
        }
        let passes = step.value(self.rotor, step.end).0 >= self.target;
        let before = passes.then(|| self.last.y.clone());
        self.last.step(step, modes);
        if let Some(y) = before {
            let [from, to] = [y[self.rotor], self.last.y[self.rotor]];
            let share = (self.target - from) / (to - from);
            self.caught = Some(CaughtStep {
                time: step.start,
                y,
                modes: modes.clone(),
                length: share * step.end * step.length,
            });
        }
    }

    fn switch(&mut self, event: &SwitchEvent<'_>) {
        if self.caught.is_none() {
            self.last.switch(event);
            self.modes = event.after.clone();
        }
    }

    fn reads_within_steps(&self, _: f64) -> bool {
        false
    }
}
