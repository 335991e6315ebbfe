//! Masses in free flight: every crossing in closed form.

use super::{Forced, plain_system, watch};
use crate::dynamics::integrate::{Dynamics, EventFunction, Guard, Modes};

/// One mass thrown upwards, u″ = −gravity, and a level: component 0 is 1 above
/// the level, 0 below. What follows a switch can be chosen, for the tests of
/// several switches at one instant.
pub(crate) struct Thrown {
    pub(crate) gravity: f64,
    pub(crate) level: f64,
    pub(crate) follow: Follow,
    pub(crate) scales: [f64; 2],
}

/// What a switch of [`Thrown`] brings with it.
#[derive(Clone, Copy, PartialEq, Eq)]
pub(crate) enum Follow {
    /// Nothing.
    Nothing,
    /// Component 1 follows at once.
    Second,
    /// Component 0 switches back at once, for ever.
    Back,
}

impl Thrown {
    pub(crate) fn new(gravity: f64, level: f64) -> Self {
        Self {
            gravity,
            level,
            follow: Follow::Nothing,
            scales: [1.0, 1.0],
        }
    }
}

impl Dynamics for Thrown {
    plain_system!();

    fn coordinates(&self) -> usize {
        1
    }

    fn derivatives(&self, _: f64, y: &[f64], _: &Modes, (): &mut (), dy: &mut [f64]) {
        dy[0] = y[1];
        dy[1] = -self.gravity;
    }

    fn tangent(&self, _: f64, _: &[f64], _: &Modes, d: &[f64], (): &mut (), out: &mut [f64]) {
        out[0] = d[1];
        out[1] = 0.0;
    }

    fn derivative_by_time(&self, _: f64, _: &[f64], _: &Modes, (): &mut (), out: &mut [f64]) {
        out.fill(0.0);
    }

    fn event_functions(&self, modes: &Modes, out: &mut Vec<EventFunction>) {
        out.clear();
        let above = Guard {
            offset: -self.level,
            displacement: 1.0,
            ..Guard::default()
        };
        let is_above = modes.0[0] != 0;
        match self.follow {
            Follow::Back => out.push(watch(above, true, 0, i64::from(!is_above))),
            _ => out.push(watch(above, !is_above, 0, i64::from(!is_above))),
        }
        if self.follow == Follow::Second && is_above && modes.0[1] == 0 {
            out.push(watch(above, true, 1, 1));
        }
    }

    fn next_break(&self, _: f64, _: &Modes) -> f64 {
        f64::INFINITY
    }

    fn pass_break(&self, _: f64, _: &mut Modes) {}
}

/// Masses that fall on springs of their own, without damping: component k is
/// −1 while mass k is on its spring (u < 0), 0 in flight.
pub(crate) struct Bouncing {
    pub(crate) gravity: f64,
    pub(crate) omega: f64,
    count: usize,
    scales: Vec<f64>,
}

impl Bouncing {
    pub(crate) fn new(count: usize, gravity: f64, omega: f64) -> Self {
        let mut scales = vec![1.0; count];
        scales.extend(vec![gravity.sqrt(); count]);
        Self {
            gravity,
            omega,
            count,
            scales,
        }
    }

    /// Switch times of a mass dropped from `height`: it falls for √(2h/g), is
    /// on the spring for (2/ω)(π − atan(v·ω/g)) with v = √(2gh), flies for
    /// 2v/g, and so on.
    pub(crate) fn switch_times(&self, height: f64, end: f64) -> Vec<f64> {
        let speed = (2.0 * self.gravity * height).sqrt();
        let angle = (speed * self.omega / self.gravity).atan();
        let contact = 2.0 / self.omega * (std::f64::consts::PI - angle);
        let flight = 2.0 * speed / self.gravity;
        let mut times = Vec::new();
        let mut time = 0.5 * flight;
        while time < end {
            times.push(time);
            time += if times.len() % 2 == 1 {
                contact
            } else {
                flight
            };
        }
        times
    }

    fn spring(&self, mode: i64) -> f64 {
        if mode == 0 {
            0.0
        } else {
            self.omega * self.omega
        }
    }
}

impl Dynamics for Bouncing {
    plain_system!();

    fn coordinates(&self) -> usize {
        self.count
    }

    fn derivatives(&self, _: f64, y: &[f64], modes: &Modes, (): &mut (), dy: &mut [f64]) {
        for k in 0..self.count {
            dy[k] = y[self.count + k];
            dy[self.count + k] = -self.gravity - self.spring(modes.0[k]) * y[k];
        }
    }

    fn tangent(&self, _: f64, _: &[f64], modes: &Modes, d: &[f64], (): &mut (), out: &mut [f64]) {
        for k in 0..self.count {
            out[k] = d[self.count + k];
            out[self.count + k] = -self.spring(modes.0[k]) * d[k];
        }
    }

    fn derivative_by_time(&self, _: f64, _: &[f64], _: &Modes, (): &mut (), out: &mut [f64]) {
        out.fill(0.0);
    }

    fn event_functions(&self, modes: &Modes, out: &mut Vec<EventFunction>) {
        out.clear();
        for (k, &mode) in modes.0.iter().enumerate().rev() {
            let touching = Guard {
                signal: k,
                displacement: -1.0,
                ..Guard::default()
            };
            let target = if mode == 0 { -1 } else { 0 };
            out.push(watch(touching, mode == 0, k, target));
        }
    }

    fn next_break(&self, _: f64, _: &Modes) -> f64 {
        f64::INFINITY
    }

    fn pass_break(&self, _: f64, _: &mut Modes) {}
}

impl Forced for Thrown {}

impl Forced for Bouncing {}
