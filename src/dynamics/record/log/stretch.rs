//! Stretches without switches, and looks at a system in them.

use crate::dynamics::integrate::Modes;
use crate::dynamics::record::observer::Observer;
use crate::dynamics::record::rows::SystemView;
use crate::dynamics::system::MassState;
use crate::math::polynomial::Step;

/// What the observer has just seen, with the masses if they are recorded.
pub(super) fn current_view<'o>(
    observer: &'o Observer<'_>,
    modes: &Modes,
    masses: &'o mut [MassState],
) -> SystemView<'o> {
    if !masses.is_empty() {
        observer.masses(modes, masses);
    }
    SystemView {
        states: observer.states(),
        masses,
    }
}

/// A stretch without switches, of which samples are taken.
pub(crate) struct Stretch<'a> {
    /// From when until when (s).
    pub(crate) span: [f64; 2],
    pub(crate) modes: &'a Modes,
    pub(crate) course: Course<'a>,
}

/// What tells the state of a system over a stretch.
pub(crate) enum Course<'a> {
    /// A step of an integration.
    Step(&'a Step<'a>),
    /// Puts y at an instant.
    Known(&'a mut dyn FnMut(f64, &mut [f64])),
}

impl Stretch<'_> {
    /// Looks at an instant.
    pub(in crate::dynamics::record) fn view_at<'o>(
        &mut self,
        time: f64,
        observer: &'o mut Observer<'_>,
        masses: &'o mut [MassState],
    ) -> SystemView<'o> {
        match &mut self.course {
            Course::Step(step) => observer.state_in(step, time, self.modes),
            Course::Known(state) => {
                observer.state_of(time, self.modes, |y| state(time, y));
            }
        }
        current_view(observer, self.modes, masses)
    }
}
