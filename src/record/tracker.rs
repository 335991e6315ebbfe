//! The figures of one object, gathered step by step.

use super::peaks::{PLACES, Peak};
use super::subdivision::{integral_of_magnitude, maximum, minimum};
use super::{FinalState, ObjectFigures, greatest_magnitude};
use crate::model::{Closure, Model};
use crate::polynomial::{MAX_DEGREE, Step};
use crate::system::{ObjectState, System};

/// A quantity of an object whose greatest magnitude is wanted.
type Reading = fn(&ObjectState) -> f64;

/// Quantities followed between samples: speed, acceleration, reaction, contact force.
const READINGS: [Reading; 4] = [
    |state| state.speed,
    |state| state.acceleration,
    |state| state.reaction,
    |state| state.contact_force,
];

/// Those of them that show best whether a step is smooth.
pub(super) const FOLLOWED: [Reading; 3] = [READINGS[1], READINGS[2], READINGS[3]];

/// The states of all objects at [`PLACES`] within a step, and the means to
/// look in between.
pub(crate) struct StepView<'a> {
    /// The step.
    pub(crate) step: &'a Step<'a>,
    /// The places, scaled to the valid part of the step.
    pub(crate) places: [f64; 7],
    /// `objects` states for each place.
    pub(crate) states: &'a [ObjectState],
    /// Number of objects.
    pub(crate) objects: usize,
}

impl StepView<'_> {
    /// The places of a step cut off at `end`.
    pub(crate) fn places(end: f64) -> [f64; 7] {
        PLACES.map(|place| place * end)
    }

    fn values(&self, object: usize, read: impl Fn(&ObjectState) -> f64) -> [f64; 7] {
        Self::read(self.states, self.objects, object, read)
    }

    /// What is read off an object at all places.
    pub(super) fn read(
        states: &[ObjectState],
        objects: usize,
        object: usize,
        read: impl Fn(&ObjectState) -> f64,
    ) -> [f64; 7] {
        std::array::from_fn(|place| read(&states[place * objects + object]))
    }
}

/// δ of an elastic object: a coordinate, so its figures are exact on the
/// polynomial of every step.
#[derive(Clone, Copy, Debug)]
struct Deviation {
    coordinate: usize,
    greatest: f64,
    least: f64,
    integral: f64,
}

/// Figures of one object on the way.
#[derive(Clone, Debug)]
pub(crate) struct ObjectTracker {
    object: usize,
    deviation: Option<Deviation>,
    peaks: [Peak; 4],
    /// Greatest of −N of a rigid force-closed pair: over the run, in the window.
    slack: Option<[Peak; 2]>,
    last: ObjectState,
}

impl ObjectTracker {
    /// A tracker for object `object` of the system.
    pub(crate) fn new(system: &System, object: usize, window: Option<[f64; 2]>) -> Self {
        let model: &Model = system.model();
        let part = &model.objects[object];
        let deviation = (system.last_coordinate(object))
            .filter(|_| !part.is_drive())
            .map(|coordinate| Deviation {
                coordinate,
                greatest: f64::NEG_INFINITY,
                least: f64::INFINITY,
                integral: 0.0,
            });
        let lifts_off = part
            .rigid_pair
            .is_some_and(|pair| pair.closure == Closure::Force);
        let never = [f64::INFINITY, f64::NEG_INFINITY];
        Self {
            object,
            deviation,
            peaks: [Peak::NONE; 4],
            slack: lifts_off.then(|| [Peak::NONE, Peak::within(window.unwrap_or(never))]),
            last: ObjectState::default(),
        }
    }

    /// A state outside steps: the start, an edge of the window.
    pub(crate) fn see(&mut self, time: f64, state: &ObjectState) {
        if let Some(deviation) = &mut self.deviation {
            deviation.greatest = deviation.greatest.max(state.delta);
            deviation.least = deviation.least.min(state.delta);
        }
        for (peak, read) in self.peaks.iter_mut().zip(READINGS) {
            peak.see(time, read(state).abs());
        }
        for peak in self.slack.iter_mut().flatten() {
            peak.see(time, -state.contact_force);
        }
        self.last = *state;
    }

    /// A step; `look` observes this object at a place between those seen.
    pub(crate) fn step(&mut self, view: &StepView<'_>, look: &mut dyn FnMut(f64) -> ObjectState) {
        let step = view.step;
        if let Some(deviation) = &mut self.deviation {
            let mut room = [0.0; MAX_DEGREE + 1];
            let delta = step.signal(deviation.coordinate, &mut room);
            deviation.greatest = maximum(delta, step.end, deviation.greatest);
            deviation.least = minimum(delta, step.end, deviation.least);
            deviation.integral += step.length * integral_of_magnitude(delta, step.end);
        }
        let time = |place| step.time(place);
        for (peak, read) in self.peaks.iter_mut().zip(READINGS) {
            let values = view.values(self.object, read);
            if values.iter().any(|&value| value != 0.0) {
                for sign in [1.0, -1.0] {
                    let signed = values.map(|value| sign * value);
                    peak.follow(&view.places, &signed, time, |s| sign * read(&look(s)));
                }
            }
        }
        for peak in self.slack.iter_mut().flatten() {
            let values = view.values(self.object, |state| -state.contact_force);
            peak.follow(&view.places, &values, time, |s| -look(s).contact_force);
        }
        self.last = view.states[6 * view.objects + self.object];
    }

    /// The greatest magnitudes of what is [`FOLLOWED`] so far.
    pub(super) fn greatest(&self) -> [f64; 3] {
        [1, 2, 3].map(|reading| magnitude(&self.peaks[reading]))
    }

    /// The object's state last seen.
    pub(crate) fn last(&self) -> &ObjectState {
        &self.last
    }

    /// Least contact force of a rigid force-closed pair and its time; the same
    /// within the window (NaN time when nothing was seen there).
    pub(crate) fn margins(&self) -> Option<[(f64, f64); 2]> {
        self.slack
            .map(|peaks| peaks.map(|peak| (-peak.value, peak.time)))
    }

    /// Greatest contact force.
    pub(crate) fn contact_force(&self) -> f64 {
        magnitude(&self.peaks[3])
    }

    /// The object's figures after `duration` seconds, its pair left out.
    pub(crate) fn figures(&self, duration: f64) -> ObjectFigures {
        let mut figures = ObjectFigures {
            peak_speed: magnitude(&self.peaks[0]),
            peak_acceleration: magnitude(&self.peaks[1]),
            peak_reaction: magnitude(&self.peaks[2]),
            end: FinalState {
                displacement: self.last.displacement,
                speed: self.last.speed,
            },
            ..ObjectFigures::default()
        };
        if let Some(deviation) = self.deviation {
            figures.delta_abs = greatest_magnitude(deviation.least, deviation.greatest);
            figures.delta_max = deviation.greatest;
            figures.delta_min = deviation.least;
            figures.sigma = if duration > 0.0 {
                deviation.integral / duration
            } else {
                self.last.delta.abs()
            };
        }
        figures
    }
}

/// The greatest magnitude seen; 0 when nothing was.
fn magnitude(peak: &Peak) -> f64 {
    peak.value.max(0.0)
}
