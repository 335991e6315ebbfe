//! The first times at which conditions hold.

use crate::dynamics::audit::fastest_rate;
use crate::dynamics::model::Model;
use crate::dynamics::system::ObjectState;
use crate::math::expression::Expression;
use std::collections::BTreeMap;
use std::f64::consts::TAU;

/// Places at which a stretch is looked at, at least and at most.
const PLACES: [f64; 2] = [64.0, 1e6];
/// Places in a period of the fastest vibration, where a stretch may have many.
const IN_PERIOD: f64 = 32.0;

/// Looks for the first time of each condition of a model.
#[derive(Debug)]
pub(super) struct Watch {
    watched: Vec<Watched>,
    /// Places in a second, of stretches that may have many vibrations.
    density: f64,
}

#[derive(Debug)]
struct Watched {
    name: String,
    object: usize,
    expression: Expression,
    /// When it holds first (s).
    met: Option<f64>,
}

impl Watched {
    fn holds(&self, time: f64, state: &ObjectState) -> bool {
        let values = [
            time,
            state.displacement,
            state.speed,
            state.acceleration,
            state.delta,
            state.reaction,
            state.contact_force,
            state.lift,
        ];
        let value = self.expression.at(&values);
        value != 0.0 && !value.is_nan()
    }
}

impl Watch {
    pub(super) fn new(model: &Model) -> Self {
        let conditions = model.conditions.iter();
        let watched = conditions.filter_map(|condition| {
            let object = |part: &usize| model.objects[*part].id == condition.object;
            Some(Watched {
                name: condition.name.clone(),
                object: (0..model.objects.len()).find(object)?,
                expression: condition.expression.clone(),
                met: None,
            })
        });
        let watched: Vec<Watched> = watched.collect();
        let density = match watched.is_empty() {
            true => 0.0,
            false => IN_PERIOD * fastest_rate(model) / TAU,
        };
        Self { watched, density }
    }

    /// True while there is something to look for.
    pub(super) fn is_looking(&self) -> bool {
        self.watched.iter().any(|own| own.met.is_none())
    }

    /// The states of all objects at the start.
    pub(super) fn start(&mut self, time: f64, states: &[ObjectState]) {
        for own in &mut self.watched {
            own.met = own.holds(time, &states[own.object]).then_some(time);
        }
    }

    /// A stretch without switches; `look` gives the state of an object at an instant of it.
    /// `whole`: it may be many vibrations long, else it is a step.
    pub(super) fn follow(
        &mut self,
        [from, to]: [f64; 2],
        whole: bool,
        look: &mut dyn FnMut(f64, usize) -> ObjectState,
    ) {
        let [least, most] = PLACES;
        let dense = if whole {
            self.density * (to - from)
        } else {
            0.0
        };
        let count = dense.clamp(least, most).ceil() as u64;
        for own in self.watched.iter_mut().filter(|own| own.met.is_none()) {
            let mut before = None;
            for place in 0..=count {
                let time = match place == count {
                    true => to,
                    false => from + (to - from) * (place as f64 / count as f64),
                };
                if own.holds(time, &look(time, own.object)) {
                    let mut holds = |time| own.holds(time, &look(time, own.object));
                    let first = before.map_or(time, |before| located([before, time], &mut holds));
                    own.met = Some(first);
                    break;
                }
                before = Some(time);
            }
        }
    }

    /// The first time of each condition by its name; `None`: it did not hold.
    pub(super) fn finish(self) -> BTreeMap<String, Option<f64>> {
        let watched = self.watched.into_iter();
        watched.map(|own| (own.name, own.met)).collect()
    }
}

/// The first number from which on it holds, between two instants of which it holds at the
/// second alone.
fn located([mut low, mut high]: [f64; 2], holds: &mut dyn FnMut(f64) -> bool) -> f64 {
    loop {
        let middle = low + 0.5 * (high - low);
        if middle <= low || middle >= high {
            return high;
        }
        match holds(middle) {
            true => high = middle,
            false => low = middle,
        }
    }
}
