//! Where a run's numbers stop being numbers.

use crate::dynamics::model::Model;
use crate::dynamics::system::{Energy, ObjectState};

/// The first force, acceleration or energy that was not a finite number.
#[derive(Clone, Debug, PartialEq)]
pub struct Failure {
    /// From here on nothing is recorded (s): the start of the step that held it.
    pub time: f64,
    /// Whose number it was: `a force or an acceleration of m`.
    pub what: String,
}

impl Failure {
    /// In a state of `object`, or in the energies.
    pub(crate) fn of(model: &Model, time: f64, object: Option<usize>) -> Self {
        Self {
            time,
            what: match object {
                Some(object) => {
                    let id = &model.objects[object].id;
                    format!("a force or an acceleration of `{id}`")
                }
                None => "the energy of the mechanism".to_owned(),
            },
        }
    }
}

/// What of a state can be told where its forces are not numbers.
pub(crate) fn motion_of(state: &ObjectState) -> ObjectState {
    let number = |value: f64| if value.is_finite() { value } else { 0.0 };
    ObjectState {
        displacement: number(state.displacement),
        speed: number(state.speed),
        delta: number(state.delta),
        ..ObjectState::default()
    }
}

/// True when an energy is a number.
pub(crate) fn is_sound(energy: &Energy) -> bool {
    (energy.kinetic + energy.elastic).is_finite()
}
