//! A stretch of a motion of which nothing is known but what is observed at places.

use super::area::area;
use super::peaks::PLACES;
use super::tally::read;
use crate::dynamics::energy::EnergyAudit;
use crate::dynamics::segment::{Peak, Segment, SegmentSignal};
use crate::dynamics::system::ObjectState;

/// A stretch observed at the places of a step, with the means to look in between.
pub(crate) struct SampledStretch<'a> {
    span: [f64; 2],
    /// States of all objects at all places, place after place.
    states: &'a [ObjectState],
    /// What an object is doing at an instant.
    look: &'a mut dyn FnMut(f64, usize) -> ObjectState,
}

impl<'a> SampledStretch<'a> {
    /// The instants at which a stretch is to be observed.
    pub(crate) fn instants([from, to]: [f64; 2]) -> [f64; 7] {
        let mut instants = PLACES.map(|place| from + place * (to - from));
        instants[6] = to;
        instants
    }

    /// What was observed at [`Self::instants`].
    pub(crate) fn new(
        span: [f64; 2],
        states: &'a [ObjectState],
        look: &'a mut dyn FnMut(f64, usize) -> ObjectState,
    ) -> Self {
        Self { span, states, look }
    }
}

impl Segment for SampledStretch<'_> {
    /// No part of the state is known.
    fn state(&mut self, _time: f64, _y: &mut [f64]) {}

    fn raise(&mut self, asked: SegmentSignal, peak: &mut Peak) {
        let SegmentSignal {
            object,
            signal,
            sign,
        } = asked;
        let objects = self.states.len() / PLACES.len();
        let [from, to] = self.span;
        let values: [f64; 7] =
            std::array::from_fn(|k| sign * read(signal, &self.states[k * objects + object]));
        let time = |place: f64| from + place * (to - from);
        let look = |place| sign * read(signal, &(self.look)(time(place), object));
        peak.add_step(&PLACES, &values, time, look);
    }

    fn area(&mut self, object: usize) -> f64 {
        let objects = self.states.len() / PLACES.len();
        let values = std::array::from_fn(|k| self.states[k * objects + object].delta);
        (self.span[1] - self.span[0]) * area(&values)
    }

    /// No works are known.
    fn works(&mut self) -> EnergyAudit {
        EnergyAudit::default()
    }
}
