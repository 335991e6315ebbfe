//! Small systems with known answers, for the tests of integration.

mod oscillator;
mod other;
mod rocker;
mod thrown;

pub(crate) use oscillator::Oscillator;
pub(crate) use other::{Collapsing, Ending, Stepped, Swinging};
pub(crate) use rocker::Rocker;
pub(crate) use thrown::{Bouncing, Follow, Thrown};

use super::{Guard, Watch};

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
            _: &[f64],
            watch: &Watch,
            modes: &mut Modes,
        ) -> Result<(), crate::integrate::PhysicalStop> {
            modes.0[watch.component] = watch.target;
            Ok(())
        }

        fn is_pair(&self, _: usize) -> bool {
            true
        }
    };
}
pub(crate) use plain_system;

/// A watch on one guard.
pub(crate) fn watch(guard: Guard, rising: bool, component: usize, target: i64) -> Watch {
    Watch {
        guards: [guard, guard],
        rising,
        component,
        target,
    }
}
