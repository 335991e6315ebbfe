//! Where a run's numbers stop being numbers.

use super::Recorder;
use crate::record::audit::WEIGHTED;
use crate::record::rows::is_finite;
use crate::system::{Energy, ObjectState};

/// The first force, acceleration or energy that was not a finite number.
#[derive(Clone, Debug, PartialEq)]
pub struct Failure {
    /// From here on nothing is recorded (s): the start of the step that held it.
    pub time: f64,
    /// Whose number it was: `a force or an acceleration of m`.
    pub what: String,
}

/// What of a state can be told where its forces are not numbers.
pub(super) fn motion_of(state: &ObjectState) -> ObjectState {
    let number = |value: f64| if value.is_finite() { value } else { 0.0 };
    ObjectState {
        displacement: number(state.displacement),
        speed: number(state.speed),
        delta: number(state.delta),
        ..ObjectState::default()
    }
}

pub(super) fn is_sound(energy: &Energy) -> bool {
    (energy.kinetic + energy.elastic).is_finite()
}

impl Recorder<'_> {
    /// True when all that was observed of the present step is numbers; the first
    /// failure is noted, with `time` the start of the step.
    pub(super) fn observed_numbers(&mut self, time: f64) -> bool {
        let powers = &self.powers[WEIGHTED];
        let sound = powers.iter().all(|power| {
            (power.drives + power.loads + power.dissipated + power.friction).is_finite()
        });
        let objects = self.objects.len();
        if let Some(index) = self.states.iter().position(|state| !is_finite(state)) {
            self.fail(time, Some(index % objects));
        } else if !(sound && is_sound(&self.energy)) {
            self.fail(time, None);
        }
        self.failure.is_none()
    }

    /// Notes the first failure: in a state of `object`, or in the energies.
    pub(super) fn fail(&mut self, time: f64, object: Option<usize>) {
        let parts = &self.observer.system().model().objects;
        self.failure.get_or_insert_with(|| Failure {
            time,
            what: match object {
                Some(object) => format!("a force or an acceleration of `{}`", parts[object].id),
                None => "the energy of the mechanism".to_owned(),
            },
        });
    }
}
