//! Systems for what the others do not show: breaks in time, a right-hand side
//! that ends, a mechanism that stops, a signal that is no coordinate.

use super::{Forced, plain_system, watch};
use crate::dynamics::integrate::{Dynamics, EventFunction, Guard, Impact, Modes, PhysicalStop};

/// u″ jumps at given times: piece k holds from `breaks[k−1]` to `breaks[k]`.
pub(crate) struct Stepped {
    pub(crate) breaks: Vec<f64>,
    pub(crate) accelerations: Vec<f64>,
    pub(crate) scales: [f64; 2],
}

impl Stepped {
    /// Closed form of [u, u′] from rest.
    pub(crate) fn exact(&self, t: f64) -> [f64; 2] {
        let (mut u, mut v, mut from) = (0.0, 0.0, 0.0);
        for (k, a) in self.accelerations.iter().enumerate() {
            let to = self.breaks.get(k).copied().unwrap_or(t).min(t);
            let h = to - from;
            u += h * (v + 0.5 * a * h);
            v += a * h;
            from = to;
        }
        [u, v]
    }
}

impl Dynamics for Stepped {
    plain_system!();

    fn coordinates(&self) -> usize {
        1
    }

    fn derivatives(&self, _: f64, y: &[f64], modes: &Modes, (): &mut (), dy: &mut [f64]) {
        dy[0] = y[1];
        dy[1] = self.accelerations[modes.0[0] as usize];
    }

    fn tangent(&self, _: f64, _: &[f64], _: &Modes, d: &[f64], (): &mut (), out: &mut [f64]) {
        out[0] = d[1];
        out[1] = 0.0;
    }

    fn derivative_by_time(&self, _: f64, _: &[f64], _: &Modes, (): &mut (), out: &mut [f64]) {
        out.fill(0.0);
    }

    fn event_functions(&self, _: &Modes, out: &mut Vec<EventFunction>) {
        out.clear();
    }

    fn next_break(&self, time: f64, _: &Modes) -> f64 {
        let next = self.breaks.iter().find(|&&b| b > time);
        next.copied().unwrap_or(f64::INFINITY)
    }

    fn pass_break(&self, _: f64, modes: &mut Modes) {
        modes.0[0] += 1;
    }
}

/// u″ = √(end − t): not a number after the end.
pub(crate) struct Ending {
    pub(crate) end: f64,
    pub(crate) scales: [f64; 2],
}

impl Dynamics for Ending {
    plain_system!();

    fn coordinates(&self) -> usize {
        1
    }

    fn derivatives(&self, t: f64, y: &[f64], _: &Modes, (): &mut (), dy: &mut [f64]) {
        dy[0] = y[1];
        dy[1] = (self.end - t).sqrt();
    }

    fn tangent(&self, _: f64, _: &[f64], _: &Modes, d: &[f64], (): &mut (), out: &mut [f64]) {
        out[0] = d[1];
        out[1] = 0.0;
    }

    fn derivative_by_time(&self, t: f64, _: &[f64], _: &Modes, (): &mut (), out: &mut [f64]) {
        out[0] = 0.0;
        out[1] = -0.5 / (self.end - t).sqrt();
    }

    fn event_functions(&self, _: &Modes, out: &mut Vec<EventFunction>) {
        out.clear();
    }

    fn next_break(&self, _: f64, _: &Modes) -> f64 {
        f64::INFINITY
    }

    fn pass_break(&self, _: f64, _: &mut Modes) {}
}

/// u″ = 6u²: from [1, 2] the motion u = (1 − t)⁻² reaches infinity at t = 1.
pub(crate) struct Collapsing {
    pub(crate) scales: [f64; 2],
}

impl Dynamics for Collapsing {
    plain_system!();

    fn coordinates(&self) -> usize {
        1
    }

    fn derivatives(&self, _: f64, y: &[f64], _: &Modes, (): &mut (), dy: &mut [f64]) {
        dy[0] = y[1];
        dy[1] = 6.0 * y[0] * y[0];
    }

    fn tangent(&self, _: f64, y: &[f64], _: &Modes, d: &[f64], (): &mut (), out: &mut [f64]) {
        out[0] = d[1];
        out[1] = 12.0 * y[0] * d[0];
    }

    fn derivative_by_time(&self, _: f64, _: &[f64], _: &Modes, (): &mut (), out: &mut [f64]) {
        out.fill(0.0);
    }

    fn event_functions(&self, _: &Modes, out: &mut Vec<EventFunction>) {
        out.clear();
    }

    fn next_break(&self, _: f64, _: &Modes) -> f64 {
        f64::INFINITY
    }

    fn pass_break(&self, _: f64, _: &mut Modes) {}
}

/// A damped oscillator u″ = −u − 2ζu′ whose second signal is u²; the mechanism
/// stops where u² rises above a limit.
pub(crate) struct Swinging {
    pub(crate) damping: f64,
    pub(crate) limit: f64,
}

impl Swinging {
    /// Closed form of [u, u′] from [1, 0].
    pub(crate) fn exact(&self, t: f64) -> [f64; 2] {
        let (d, w) = (self.damping, (1.0 - self.damping * self.damping).sqrt());
        let decay = (-d * t).exp();
        [
            decay * ((w * t).cos() + d / w * (w * t).sin()),
            -decay / w * (w * t).sin(),
        ]
    }
}

impl Dynamics for Swinging {
    type Scratch = ();

    fn scratch(&self) {}

    fn coordinates(&self) -> usize {
        1
    }

    fn signals(&self) -> usize {
        2
    }

    fn derivatives(&self, _: f64, y: &[f64], _: &Modes, (): &mut (), dy: &mut [f64]) {
        dy[0] = y[1];
        dy[1] = -y[0] - 2.0 * self.damping * y[1];
    }

    fn tangent(&self, _: f64, _: &[f64], _: &Modes, d: &[f64], (): &mut (), out: &mut [f64]) {
        out[0] = d[1];
        out[1] = -d[0] - 2.0 * self.damping * d[1];
    }

    fn derivative_by_time(&self, _: f64, _: &[f64], _: &Modes, (): &mut (), out: &mut [f64]) {
        out.fill(0.0);
    }

    fn extra_signals(
        &self,
        _: f64,
        y: &[f64],
        dy: &[f64],
        _: &Modes,
        (): &mut (),
        out: &mut [[f64; 3]],
    ) {
        let [u, v, a] = [y[0], y[1], dy[1]];
        out[0] = [u * u, 2.0 * u * v, 2.0 * (v * v + u * a)];
    }

    fn scales(&self) -> &[f64] {
        &[1.0, 1.0]
    }

    fn state_name(&self, index: usize) -> String {
        ["swing: displacement", "swing: speed"][index].to_owned()
    }

    fn event_functions(&self, _: &Modes, out: &mut Vec<EventFunction>) {
        out.clear();
        let square = Guard {
            signal: 1,
            offset: -self.limit,
            displacement: 1.0,
            speed: 0.0,
        };
        out.push(watch(square, true, 0, 1));
    }

    fn switch(
        &self,
        time: f64,
        _: &mut [f64],
        _: &EventFunction,
        _: &mut Modes,
    ) -> Result<Option<Impact>, PhysicalStop> {
        Err(PhysicalStop {
            name: "dead_position",
            object: "swing".to_owned(),
            message: format!("too far at {time} s"),
        })
    }

    fn next_break(&self, _: f64, _: &Modes) -> f64 {
        f64::INFINITY
    }

    fn pass_break(&self, _: f64, _: &mut Modes) {}

    fn is_pair(&self, _: usize) -> bool {
        true
    }

    fn expands(&self) -> bool {
        true
    }

    fn expand(
        &self,
        span: [f64; 2],
        y: &[f64],
        dy: &[f64],
        modes: &Modes,
        degree: usize,
        (): &mut (),
        out: &mut [f64],
    ) -> f64 {
        let (u, square) = out.split_at_mut(degree + 1);
        let way = super::expand(self, span, y, dy, modes, degree, u);
        for (order, out) in square.iter_mut().enumerate() {
            *out = (0..=order).map(|i| u[i] * u[order - i]).sum();
        }
        way
    }
}

impl Forced for Stepped {}

impl Forced for Ending {
    /// √(e − L·s) by the binomial series.
    fn forced(&self, order: usize, [t, length]: [f64; 2], _: &[f64], _: usize, out: &mut [f64]) {
        let rest = self.end - t;
        let factor = |k: usize| (0.5 - (k - 1) as f64) / k as f64 * (-length / rest);
        out[0] += rest.sqrt() * (1..=order).map(factor).product::<f64>();
    }
}

impl Forced for Collapsing {
    /// Of 6u² what is not 12·u₀·u_order.
    fn forced(&self, order: usize, _: [f64; 2], u: &[f64], _: usize, out: &mut [f64]) {
        out[0] += (1..order).map(|i| 6.0 * u[i] * u[order - i]).sum::<f64>();
    }
}

impl Forced for Swinging {}
