//! Greatest and least values within parts of a motion.
//!
//! A stretch without switches is cut where a span begins and ends. On what lies within, a signal
//! is bounded by a polynomial with its error (`FittedVariables`); parts whose bound is no greater than what
//! was seen are left out, the others are halved. The ends of the span belong to it. All methods
//! alike are looked at.

use super::fitted::{FittedVariables, NODES, parts_of_stretch};
use super::tally::{Sense, read};
use crate::dynamics::audit::fastest_rate;
use crate::dynamics::model::{Model, Span, SpanFigure, owner_of};
use crate::dynamics::segment::Signal;
use crate::dynamics::system::ObjectState;
use crate::math::chebyshev::Nodes;
use crate::math::expression::{Interval, VARIABLES};
use crate::math::roots::bracketed;
use std::collections::BTreeMap;
use std::f64::consts::TAU;
use std::rc::Rc;

/// The figures that are greatest or least values of a signal.
const READINGS: [(&str, Signal, Sense); 11] = [
    ("delta_max", Signal::Deviation, Sense::Greatest),
    ("delta_min", Signal::Deviation, Sense::Least),
    ("delta_abs", Signal::Deviation, Sense::Magnitude),
    ("peak_speed", Signal::Speed, Sense::Magnitude),
    ("peak_acceleration", Signal::Acceleration, Sense::Magnitude),
    ("peak_reaction", Signal::Reaction, Sense::Magnitude),
    (
        "pair.max_contact_force",
        Signal::ContactForce,
        Sense::Magnitude,
    ),
    ("pair.margin", Signal::ContactForce, Sense::Least),
    ("pair.max_lift", Signal::Clearance, Sense::Greatest),
    ("pressing.max_pressure", Signal::Pressure, Sense::Greatest),
    (
        "stop.max_contact_force",
        Signal::ContactForce,
        Sense::Magnitude,
    ),
];

/// Names of the figures of an object that can be had within a span.
pub(crate) fn span_figures() -> impl Iterator<Item = &'static str> {
    READINGS.iter().map(|(name, ..)| *name)
}

/// Parts in a period of the fastest vibration there.
const IN_PERIOD: f64 = 1.0;
/// Places of a part at which the axis of a span is looked at.
const PLACES: u32 = 8;
/// Below this share of a part nothing is halved: a greatest value inside is flat.
const NARROW: f64 = 1e-7;
/// Signals are fitted anew down to this share of a part, so often on a part.
const FINEST_FIT: f64 = 1e-6;
const MOST_FITS: usize = 200;
/// Share of the greatest value by which a bound must exceed it.
const CLOSE: f64 = 1e-14;
/// Most halvings of a part.
const MOST: usize = 4000;

/// Looks for greatest values within spans.
#[derive(Debug)]
pub(super) struct SpanSearch {
    sought: Vec<SpanExtremum>,
    /// Parts in a second, of stretches that may have many vibrations.
    density: f64,
    nodes: Nodes<NODES>,
}

#[derive(Debug)]
struct SpanExtremum {
    address: String,
    object: usize,
    signal: Signal,
    sense: Sense,
    span: Span,
    /// The object whose displacement is the axis; `None`: time.
    axis: Option<usize>,
    /// True of times and of drives, which go on: a run that ends within the span, or begins there,
    /// shows a part of it alone.
    whole: bool,
    /// Least and greatest place of the axis so far.
    reached: [f64; 2],
    /// Greatest value so far in the sense that is sought; −∞: nothing was seen.
    best: f64,
    /// Time at which it was first met (s).
    time: f64,
}

/// A greatest or least value within a span.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct SpanExtreme {
    /// The value.
    pub value: f64,
    /// Time at which it is first met (s).
    pub time: f64,
}

/// Looks at an object at an instant.
type Look<'l> = dyn FnMut(f64, usize) -> ObjectState + 'l;

impl SpanSearch {
    pub(super) fn new(model: &Model, figures: &[SpanFigure]) -> Self {
        let sought = figures.iter().filter_map(|figure| {
            let part = |id: &str| model.objects.iter().position(|part| part.id == id);
            let (owner, name) = owner_of(&figure.figure, |id| part(id).is_some());
            let (_, signal, sense) = READINGS.iter().find(|(known, ..)| *known == name)?;
            let axis = model.axis_of(&figure.span).ok()?;
            Some(SpanExtremum {
                address: figure.address.clone(),
                object: part(owner)?,
                signal: *signal,
                sense: *sense,
                axis,
                whole: axis.is_none_or(|object| model.objects[object].is_drive()),
                reached: [f64::INFINITY, f64::NEG_INFINITY],
                span: figure.span.clone(),
                best: f64::NEG_INFINITY,
                time: f64::NAN,
            })
        });
        let sought: Vec<SpanExtremum> = sought.collect();
        let density = match sought.is_empty() {
            true => 0.0,
            false => IN_PERIOD * fastest_rate(model) / TAU,
        };
        Self {
            sought,
            density,
            nodes: Nodes::new(),
        }
    }

    /// True where something is sought.
    pub(super) fn is_looking(&self) -> bool {
        !self.sought.is_empty()
    }

    /// A stretch without switches; `look` gives the state of an object at an instant of it.
    /// `whole`: it may be many vibrations long, else it is a step.
    pub(super) fn search_stretch(
        &mut self,
        [from, to]: [f64; 2],
        whole: bool,
        look: &mut Look<'_>,
    ) {
        if !(to > from) {
            return;
        }
        let density = whole.then_some(self.density);
        for part in parts_of_stretch([from, to], density) {
            for own in &mut self.sought {
                for inside in own.parts_inside_span(part, look) {
                    own.climb(inside, &self.nodes, look);
                }
            }
        }
    }

    /// What was found, by address; `None`: the motion was never within the span, or did not go
    /// through all of it.
    pub(super) fn finish(self) -> BTreeMap<String, Option<SpanExtreme>> {
        let found = self.sought.into_iter().map(|own| {
            let seen = own.best > f64::NEG_INFINITY;
            let seen = seen && (!own.whole || own.span.is_within(own.reached));
            let value = match own.sense {
                Sense::Greatest | Sense::Magnitude => own.best,
                Sense::Least => -own.best,
            };
            let time = own.time;
            (own.address, seen.then_some(SpanExtreme { value, time }))
        });
        found.collect()
    }
}

impl SpanExtremum {
    /// Place on the axis of the span at an instant.
    fn place_on_axis(&self, time: f64, look: &mut Look<'_>) -> f64 {
        match self.axis {
            Some(object) => look(time, object).displacement,
            None => time,
        }
    }

    fn extend_reached(&mut self, place: f64) {
        let [low, high] = self.reached;
        self.reached = [low.min(place), high.max(place)];
    }

    /// The stretches of a part that lie within the span.
    fn parts_inside_span(&mut self, [from, to]: [f64; 2], look: &mut Look<'_>) -> Vec<[f64; 2]> {
        let mut cuts = vec![from];
        let mut before = (from, self.place_on_axis(from, look));
        self.extend_reached(before.1);
        for number in 1..=PLACES {
            let time = match number == PLACES {
                true => to,
                false => from + (to - from) * (f64::from(number) / f64::from(PLACES)),
            };
            let after = (time, self.place_on_axis(time, look));
            self.extend_reached(after.1);
            let (low, high) = (before.1.min(after.1), before.1.max(after.1));
            let mut ends = self.span.ends_between([low, high]);
            if after.1 < before.1 {
                ends.reverse();
            }
            for end in ends {
                cuts.push(self.time_of_passing([before, after], end, look));
            }
            before = after;
        }
        cuts.push(to);
        let mut inside: Vec<[f64; 2]> = Vec::new();
        for ends in cuts.windows(2) {
            let [start, end] = [ends[0], ends[1]];
            let middle = start + 0.5 * (end - start);
            if end >= start && self.span.contains(self.place_on_axis(middle, look)) {
                inside.push([start, end]);
            }
        }
        inside
    }

    /// When the axis passes a place between two instants.
    fn time_of_passing(&self, ends: [(f64, f64); 2], place: f64, look: &mut Look<'_>) -> f64 {
        let mut off = |time: f64| self.place_on_axis(time, look) - place;
        bracketed(&mut off, ends.map(|(time, _)| time), 0.0).at
    }

    fn value(&self, time: f64, look: &mut Look<'_>) -> f64 {
        read(self.signal, &look(time, self.object))
    }

    fn include(&mut self, time: f64, look: &mut Look<'_>) {
        let value = self.in_sense(self.value(time, look));
        if value > self.best {
            self.best = value;
            self.time = time;
        }
    }

    /// A value so that the greatest is sought.
    fn in_sense(&self, value: f64) -> f64 {
        match self.sense {
            Sense::Greatest => value,
            Sense::Least => -value,
            Sense::Magnitude => value.abs(),
        }
    }

    /// The greatest that a value within bounds can be.
    fn greatest_possible(&self, bounds: Interval) -> f64 {
        match self.sense {
            Sense::Greatest => bounds.high,
            Sense::Least => -bounds.low,
            Sense::Magnitude => bounds.high.max(-bounds.low),
        }
    }

    /// Raises the greatest value to that between two instants, their own values included.
    fn climb(&mut self, [from, to]: [f64; 2], nodes: &Nodes<NODES>, look: &mut Look<'_>) {
        self.include(from, look);
        self.include(to, look);
        let length = to - from;
        let mut fits = 1;
        let mut waiting = vec![(from, to, Rc::new(self.fitted([from, to], nodes, look)))];
        for _ in 0..MOST {
            let Some((low, high, fitted)) = waiting.pop() else {
                return;
            };
            let (bounds, changes) = fitted.bounds(low, high);
            let most = self.greatest_possible(bounds[1]);
            // (Written so that a bound that is no number is looked into.)
            if most <= self.best + CLOSE * self.best.abs() {
                continue;
            }
            let middle = low + 0.5 * (high - low);
            self.include(middle, look);
            let resolved = fitted.is_resolved();
            if (resolved && !changes) || high - low <= NARROW * length || middle <= low {
                continue;
            }
            let anew = !resolved && high - low > FINEST_FIT * length && fits + 2 <= MOST_FITS;
            fits += if anew { 2 } else { 0 };
            for ends in [[middle, high], [low, middle]] {
                let fitted = match anew {
                    true => Rc::new(self.fitted(ends, nodes, look)),
                    false => Rc::clone(&fitted),
                };
                waiting.push((ends[0], ends[1], fitted));
            }
        }
    }

    fn fitted(&self, ends: [f64; 2], nodes: &Nodes<NODES>, look: &mut Look<'_>) -> FittedVariables {
        let wanted = std::array::from_fn(|variable| variable == 1);
        FittedVariables::new(ends, &wanted, nodes, &mut |time| {
            let mut row = [0.0; VARIABLES];
            row[1] = self.value(time, look);
            row
        })
    }
}

#[cfg(test)]
mod tests {
    use super::{SpanExtremum, SpanSearch};
    use crate::dynamics::model::{Coordinate, Span, SpanAxis};
    use crate::dynamics::record::tally::Sense;
    use crate::dynamics::segment::Signal;
    use crate::dynamics::system::ObjectState;
    use crate::math::chebyshev::Nodes;

    /// A drive that turns by φ = 3·t + 0.2·sin t, and a deviation of its own.
    fn look(time: f64, object: usize) -> ObjectState {
        let angle = 3.0 * time + 0.2 * time.sin();
        ObjectState {
            displacement: if object == 0 { angle } else { 0.0 },
            delta: (7.0 * time).sin() + 0.3 * time,
            ..ObjectState::default()
        }
    }

    fn found(sense: Sense, span: Span, steps: &[f64]) -> f64 {
        let axis = match span.axis {
            SpanAxis::Time => None,
            SpanAxis::Displacement { .. } => Some(0),
        };
        let mut search = SpanSearch {
            sought: vec![SpanExtremum {
                address: String::new(),
                object: 1,
                signal: Signal::Deviation,
                sense,
                span,
                axis,
                whole: true,
                reached: [f64::INFINITY, f64::NEG_INFINITY],
                best: f64::NEG_INFINITY,
                time: f64::NAN,
            }],
            density: 3.0,
            nodes: Nodes::new(),
        };
        for ends in steps.windows(2) {
            search.search_stretch([ends[0], ends[1]], true, &mut look);
        }
        search.finish()[""].unwrap().value
    }

    #[test]
    fn extremes_within_spans_are_those_of_the_closed_form() {
        let delta = |time: f64| look(time, 1).delta;
        let span = |from: f64, to: f64| Span {
            axis: SpanAxis::Time,
            from,
            to,
        };
        let steps = [0.0, 0.7, 0.75, 2.0, 3.0];
        // 7·cos(7·t) = −0.3 at a maximum inside; else an end.
        let phase = (-0.3f64 / 7.0).acos();
        let top = (phase + std::f64::consts::TAU) / 7.0;
        for (from, to, wanted) in [
            (1.0, 1.3, delta(top)),
            (0.3, 0.5, delta(0.3)),
            (0.7, 0.9, delta(0.9)),
        ] {
            let greatest = found(Sense::Greatest, span(from, to), &steps);
            approx::assert_relative_eq!(greatest, wanted, max_relative = 1e-14);
        }
        let bottom = (std::f64::consts::TAU - phase) / 7.0;
        let least = found(Sense::Least, span(0.6, 0.8), &steps);
        approx::assert_relative_eq!(least, delta(bottom), max_relative = 1e-14);
    }

    #[test]
    fn the_ends_of_a_span_of_angles_are_located() {
        let turning = |from: f64, to: f64| Span {
            axis: SpanAxis::Displacement {
                of: None,
                coordinate: Coordinate::Turning,
            },
            from,
            to,
        };
        // δ rises from t = 0.68 to its top at 1.13; the angle there by Newton's method.
        let mut time: f64 = 1.0;
        for _ in 0..50 {
            time -= (3.0 * time + 0.2 * time.sin() - 3.1) / (3.0 + 0.2 * time.cos());
        }
        let greatest = found(Sense::Greatest, turning(2.6, 3.1), &[0.0, 0.4, 1.9]);
        approx::assert_relative_eq!(greatest, look(time, 1).delta, max_relative = 1e-13);
    }
}
