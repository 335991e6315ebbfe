//! A step of an integration as a segment: coordinates are polynomials, everything
//! else is observed at a few places and looked for between them.

use super::area::area;
use super::contact::ContactMonitor;
use super::observer::Observer;
use super::peaks::PLACES;
use super::subdivision::{integral_of_magnitude, maximum, minimum};
use super::tally::read;
use crate::dynamics::energy::EnergyAudit;
use crate::dynamics::integrate::Modes;
use crate::dynamics::segment::{MAGNITUDES, Peak, Segment, SegmentSignal, Signal};
use crate::dynamics::system::{ObjectState, System};
use crate::math::polynomial::{MAX_DEGREE, Step};

/// Indices of an elastic object's coordinates in the state.
#[derive(Clone, Copy, Debug, Default)]
pub(super) struct Coordinates {
    /// δ.
    deviation: Option<usize>,
    /// The deformation of link 1, of a pair that can open.
    pub(super) opening: Option<ContactMonitor>,
}

impl Coordinates {
    pub(super) fn of(system: &System, object: usize) -> Self {
        let model = system.model();
        let part = &model.objects[object];
        let opening = || {
            if let Some((coordinate, zero, pair)) = system.stop_signal(object) {
                let component = system.pair_component(object)?;
                return Some(ContactMonitor {
                    component,
                    coordinate,
                    zero,
                    pair,
                });
            }
            Some(ContactMonitor {
                zero: 0.0,
                component: system.pair_component(object)?,
                coordinate: system.first_coordinate(object)?,
                pair: model.elastic_pair(part)?,
            })
        };
        Self {
            deviation: system.deviation(object),
            opening: opening(),
        }
    }
}

/// What was seen of all objects between the places of a step: several extremes are
/// often climbed to by the same looks, those of a reaction and of its pair's contact force.
#[derive(Debug, Default)]
pub(super) struct SampleCache {
    places: Vec<f64>,
    states: Vec<ObjectState>,
}

impl SampleCache {
    /// Forgets all, for the next step.
    pub(super) fn clear(&mut self) {
        self.places.clear();
        self.states.clear();
    }

    /// What one of the objects does at s, looked at if it was not yet.
    fn at(
        &mut self,
        (object, objects): (usize, usize),
        s: f64,
        look: impl FnOnce(&mut [ObjectState]),
    ) -> &ObjectState {
        let known = self.places.iter().position(|place| *place == s);
        let number = known.unwrap_or_else(|| {
            self.places.push(s);
            let from = self.states.len();
            self.states
                .resize_with(from + objects, ObjectState::default);
            look(&mut self.states[from..]);
            self.places.len() - 1
        });
        &self.states[number * objects + object]
    }
}

/// The places of a step cut off at `end`.
pub(super) fn places(end: f64) -> [f64; 7] {
    PLACES.map(|place| place * end)
}

/// What is read off an object at all places; `states` are those of all objects,
/// place after place.
pub(super) fn at_places(
    states: &[ObjectState],
    objects: usize,
    object: usize,
    signal: Signal,
) -> [f64; 7] {
    let own = |place: usize| &states[place * objects + object];
    // (One loop a signal, not a choice for every value.)
    match signal {
        Signal::Deviation => std::array::from_fn(|place| own(place).delta),
        Signal::Speed => std::array::from_fn(|place| own(place).speed),
        Signal::Acceleration => std::array::from_fn(|place| own(place).acceleration),
        Signal::Reaction => std::array::from_fn(|place| own(place).reaction),
        Signal::ContactForce => std::array::from_fn(|place| own(place).contact_force),
        Signal::Clearance => std::array::from_fn(|place| own(place).lift),
        Signal::Indentation => std::array::from_fn(|place| own(place).indentation),
        Signal::Pressure => std::array::from_fn(|place| own(place).pressure),
    }
}

/// Ranges of the [`MAGNITUDES`] at the places of a step.
struct Ranges {
    most: [f64; 4],
    least: [f64; 4],
}

impl Default for Ranges {
    fn default() -> Self {
        Self {
            most: [f64::MIN; 4],
            least: [f64::MAX; 4],
        }
    }
}

impl Ranges {
    #[inline(always)]
    fn add_state(&mut self, state: &ObjectState) {
        // (All are numbers. Four at a time.)
        let values = MAGNITUDES.map(|signal| read(signal, state));
        for ((most, least), value) in self.most.iter_mut().zip(&mut self.least).zip(values) {
            *most = if value > *most { value } else { *most };
            *least = if value < *least { value } else { *least };
        }
    }

    /// What each magnitude may come to between the places: no parabola through three
    /// neighbours rises by more than their range, and that is doubled.
    fn magnitudes(&self) -> [f64; 4] {
        std::array::from_fn(|k| {
            let (most, least) = (self.most[k], self.least[k]);
            most.max(-least) + 2.0 * (most - least)
        })
    }
}

/// A step, its observations and the means to look in between.
pub(super) struct ObservedStep<'a, 's> {
    pub(super) step: &'a Step<'a>,
    pub(super) modes: &'a Modes,
    pub(super) observer: &'a mut Observer<'s>,
    pub(super) looks: &'a mut SampleCache,
    /// States of all objects at [`places`], place after place.
    pub(super) states: &'a [ObjectState],
    pub(super) coordinates: &'a [Coordinates],
    pub(super) works: EnergyAudit,
}

impl Segment for ObservedStep<'_, '_> {
    fn state(&mut self, time: f64, y: &mut [f64]) {
        let s = (time - self.step.start) / self.step.length;
        self.step.state(s.clamp(0.0, self.step.end), y);
    }

    fn raise(&mut self, asked: SegmentSignal, peak: &mut Peak) {
        let SegmentSignal {
            object,
            signal,
            sign,
        } = asked;
        let (step, end) = (self.step, self.step.end);
        let mut room = [0.0; MAX_DEGREE + 1];
        let own = self.coordinates[object];
        let found = match signal {
            Signal::Deviation if own.deviation.is_some() => own.deviation.and_then(|coordinate| {
                let (base, differences) = (step.bases[coordinate], step.differences(coordinate));
                let all = differences.iter().map(|other| sign * (base + other));
                // (Without a copy: most often that is all.)
                (all.fold(f64::MIN, f64::max) > peak.value).then_some(())?;
                let delta = step.signal(coordinate, &mut room);
                if sign > 0.0 {
                    maximum(delta, end, peak.value)
                } else {
                    minimum(delta, end, -peak.value).map(|(value, place)| (-value, place))
                }
            }),
            Signal::Clearance => own.opening.and_then(|opening| {
                (self.modes.0[opening.component] == 0).then_some(())?;
                let x = opening.deformation(step, &mut room);
                opening.greatest_clearance(x, end, peak.value)
            }),
            _ => {
                let values = at_places(self.states, self.coordinates.len(), object, signal);
                return self.follow_signal(asked, &values.map(|value| sign * value), peak);
            }
        };
        if let Some((value, place)) = found {
            peak.include(step.time(place), value);
        }
    }

    fn raise_magnitude(&mut self, object: usize, signal: Signal, peak: &mut Peak) {
        let values = at_places(self.states, self.coordinates.len(), object, signal);
        for sign in [1.0, -1.0] {
            let asked = SegmentSignal {
                object,
                signal,
                sign,
            };
            self.follow_signal(asked, &values.map(|value| sign * value), peak);
        }
    }

    fn raise_magnitudes(&mut self, object: usize, peaks: &mut [Peak; 4]) {
        let objects = self.coordinates.len();
        // Most often none can pass, and nothing has to be looked at twice.
        let mut ranges = Ranges::default();
        for place in 0..PLACES.len() {
            ranges.add_state(&self.states[place * objects + object]);
        }
        let passing = ranges.magnitudes();
        for (k, peak) in peaks.iter_mut().enumerate() {
            if passing[k] > peak.value {
                self.raise_magnitude(object, MAGNITUDES[k], peak);
            }
        }
    }

    fn area(&mut self, object: usize) -> f64 {
        let Some(coordinate) = self.coordinates[object].deviation else {
            // The sum of several coordinates and a prescribed motion.
            let objects = self.coordinates.len();
            let values = at_places(self.states, objects, object, Signal::Deviation);
            return self.step.length * self.step.end * area(&values);
        };
        let mut room = [0.0; MAX_DEGREE + 1];
        let delta = self.step.signal(coordinate, &mut room);
        self.step.length * integral_of_magnitude(delta, self.step.end)
    }

    fn works(&mut self) -> EnergyAudit {
        std::mem::take(&mut self.works)
    }
}

impl ObservedStep<'_, '_> {
    /// Follows a signal that is no polynomial from place to place, at which it has the
    /// values given.
    fn follow_signal(&mut self, asked: SegmentSignal, values: &[f64; 7], peak: &mut Peak) {
        let SegmentSignal {
            object,
            signal,
            sign,
        } = asked;
        let step = self.step;
        let (observer, modes, looks) = (&mut *self.observer, self.modes, &mut *self.looks);
        let of = (object, self.coordinates.len());
        let look = |s: f64| {
            let state = looks.at(of, s, |states| {
                observer.observe_into(step, s, modes, states)
            });
            sign * read(signal, state)
        };
        let time = |place| step.time(place);
        peak.add_step(&places(step.end), values, time, look);
    }
}
