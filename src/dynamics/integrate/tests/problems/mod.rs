//! Small systems with known answers, for the tests of integration.

mod oscillator;
mod other;
mod rocker;
mod thrown;

pub(crate) use oscillator::Oscillator;
pub(crate) use other::{Collapsing, Ending, Stepped, Swinging};
pub(crate) use rocker::Rocker;
pub(crate) use thrown::{Bouncing, Follow, Thrown};

use super::{Dynamics, EventFunction, Guard, Modes};

/// The part of a motion's power series that the Jacobian at its start does not
/// give: what depends on time, and what is not linear.
pub(crate) trait Forced {
    /// Adds to coefficient `order` ≥ 1 of the accelerations; `rows` are the
    /// series of the coordinates, `width` each.
    fn forced(
        &self,
        _order: usize,
        _span: [f64; 2],
        _rows: &[f64],
        _width: usize,
        _out: &mut [f64],
    ) {
    }
}

/// Power series of the motion of a small system, see [`Dynamics::expand`].
pub(crate) fn expand<D: Dynamics<Scratch = ()> + Forced>(
    system: &D,
    [time, length]: [f64; 2],
    y: &[f64],
    dy: &[f64],
    modes: &Modes,
    degree: usize,
    out: &mut [f64],
) -> f64 {
    let (n, width) = (system.coordinates(), degree + 1);
    let [mut direction, mut product] = [vec![0.0; 2 * n], dy.to_vec()];
    for k in 0..n {
        out[k * width] = y[k];
        out[k * width + 1] = y[n + k] * length;
    }
    for order in 0..=degree - 2 {
        let next = (order + 1) as f64;
        if order > 0 {
            for k in 0..n {
                direction[k] = out[k * width + order];
                direction[n + k] = next * out[k * width + order + 1] / length;
            }
            system.tangent(time, y, modes, &direction, &mut (), &mut product);
            let span = [time, length];
            system.forced(order, span, &out[..n * width], width, &mut product[n..]);
        }
        for k in 0..n {
            let twice = length * length / (next * (next + 1.0));
            out[k * width + order + 2] = twice * product[n + k];
        }
    }
    0.5
}

/// Coefficient `order` of amplitude·sin(rate·t) in s = (t − time)/length.
pub(crate) fn sine(amplitude: f64, rate: f64, [time, length]: [f64; 2], order: usize) -> f64 {
    let factorial: f64 = (1..=order).map(|k| k as f64).product();
    let quarter = std::f64::consts::FRAC_PI_2 * order as f64;
    amplitude * (rate * length).powi(order as i32) / factorial * (rate * time + quarter).sin()
}

/// The parts of [`super::Dynamics`] that a system without extra signals, breaks
/// in time and physical stops needs not think about.
macro_rules! plain_system {
    () => {
        type Scratch = ();

        fn scratch(&self) {}

        fn extra_signals(
            &self,
            _: f64,
            _: &[f64],
            _: &[f64],
            _: &Modes,
            (): &mut (),
            _: &mut [[f64; 3]],
        ) {
        }

        fn signals(&self) -> usize {
            self.coordinates()
        }

        fn scales(&self) -> &[f64] {
            &self.scales
        }

        fn state_name(&self, index: usize) -> String {
            let n = self.coordinates();
            let quantity = if index < n { "displacement" } else { "speed" };
            format!("mass {}: {quantity}", index % n + 1)
        }

        fn switch(
            &self,
            _: f64,
            _: &mut [f64],
            watch: &EventFunction,
            modes: &mut Modes,
        ) -> Result<
            Option<crate::dynamics::integrate::Impact>,
            crate::dynamics::integrate::PhysicalStop,
        > {
            modes.0[watch.component] = watch.target;
            Ok(None)
        }

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
            super::expand(self, span, y, dy, modes, degree, out)
        }
    };
}
pub(crate) use plain_system;

/// A watch on one guard.
pub(crate) fn watch(guard: Guard, rising: bool, component: usize, target: i64) -> EventFunction {
    EventFunction {
        guards: [guard, guard],
        rising,
        component,
        target,
    }
}
