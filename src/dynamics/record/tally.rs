//! The figures of one object, gathered segment by segment: the only place that says
//! which extremes and integrals of which signals the figures are.
//!
//! `run`, `compare`, `map`, `spread`, `law compare` and the search for the lift-off speed
//! request what they need (`Demand`) and get it from the same walk.

use super::{FinalState, ObjectFigures, PressingFigures, greatest_magnitude};
use crate::dynamics::model::{Closure, Pair};
use crate::dynamics::segment::{MAGNITUDES, Peak, Segment, SegmentSignal, Signal};
use crate::dynamics::system::{ObjectState, System};

/// Reads a signal off a state.
pub(super) fn read(signal: Signal, state: &ObjectState) -> f64 {
    match signal {
        Signal::Deviation => state.delta,
        Signal::Speed => state.speed,
        Signal::Acceleration => state.acceleration,
        Signal::Reaction => state.reaction,
        Signal::ContactForce => state.contact_force,
        Signal::Clearance => state.lift,
        Signal::Indentation => state.indentation,
        Signal::Pressure => state.pressure,
    }
}

/// δ of an elastic object.
#[derive(Clone, Copy, Debug)]
struct Deviation {
    greatest: Peak,
    /// Of −δ.
    least: Peak,
    /// ∫|δ| dt.
    area: f64,
}

/// Where the greatest indentation of a contact element is found.
#[derive(Clone, Copy, Debug)]
enum Indentation {
    /// At a massless point, whose motion is followed.
    Followed(Peak),
    /// Of a contact without loss: the one under the greatest force N = k·p^power.
    OfForce { stiffness: f64, power: f64 },
    /// Of the contact of a rigid body: the body's own deviation, as far as it presses.
    OfDeviation { pair: Pair },
}

impl Indentation {
    fn of(system: &System, object: usize) -> Option<Self> {
        system.pair_component(object)?;
        let model = system.model();
        if model.stop(object).is_some_and(|stop| stop.law.is_rigid()) {
            return None;
        }
        if model.stop(object).is_some() {
            return Some(Self::Followed(Peak::NONE));
        }
        let part = &model.objects[object];
        let contact = part.indented()?;
        Some(match contact.law {
            _ if contact.point.is_some() => Self::Followed(Peak::NONE),
            law if !law.is_lossless() => Self::OfDeviation {
                pair: model.elastic_pair(part)?,
            },
            law => Self::OfForce {
                stiffness: contact.stiffness,
                power: law.form().exponent(),
            },
        })
    }
}

/// Figures of one object on the way.
#[derive(Clone, Debug)]
pub(crate) struct Tally {
    deviation: Option<Deviation>,
    /// Of the [`MAGNITUDES`].
    peaks: [Peak; 4],
    /// Greatest of −N of a rigid force-closed pair: over the run, in the window.
    slack: Option<[Peak; 2]>,
    /// Side to which its pair opens: −N is so many times the reaction.
    opens: f64,
    /// Greatest clearance of a pair that can open.
    lift: Option<Peak>,
    /// Greatest indentation of a contact element.
    indentation: Option<Indentation>,
    /// Greatest pressure of its contact, where that is known.
    pressure: Option<Peak>,
    last: ObjectState,
}

/// Greatest values of an object that closed forms tell.
pub(super) const CLAIMS: usize = 6;

/// A greatest value, and when it is met.
#[derive(Clone, Copy, Debug)]
pub(super) struct Claim {
    pub(super) signal: Signal,
    pub(super) sense: Sense,
    pub(super) value: f64,
    pub(super) time: f64,
}

/// Of what a value is the greatest.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub(super) enum Sense {
    /// The signal itself.
    Greatest,
    /// The signal turned round.
    Least,
    /// Its magnitude.
    Magnitude,
}

impl Claim {
    /// The value of a signal as the claim has it.
    pub(super) fn of(&self, value: f64) -> f64 {
        match self.sense {
            Sense::Greatest => value,
            Sense::Least => -value,
            Sense::Magnitude => value.abs(),
        }
    }
}

impl Tally {
    /// The greatest values so far, with their instants. (A clearance is greatest in the middle
    /// of a gap, at an instant that nobody asks for.)
    pub(super) fn claims(&self) -> [Option<Claim>; CLAIMS] {
        let claim = |peak: Peak, signal: Signal, sense: Sense| {
            let known = peak.value > f64::NEG_INFINITY;
            known.then_some(Claim {
                signal,
                sense,
                value: peak.value,
                time: peak.time,
            })
        };
        let magnitude = |k: usize| claim(self.peaks[k], MAGNITUDES[k], Sense::Magnitude);
        let deviation = self.deviation.as_ref();
        let greatest = |own: &Deviation| claim(own.greatest, Signal::Deviation, Sense::Greatest);
        let least = |own: &Deviation| claim(own.least, Signal::Deviation, Sense::Least);
        // (Those that are often met at one instant stand side by side.)
        [
            magnitude(0),
            magnitude(1),
            magnitude(2),
            magnitude(3),
            deviation.and_then(greatest),
            deviation.and_then(least),
        ]
    }

    /// A tally for object `object` of the system; `window`: that of the margins.
    pub(crate) fn new(system: &System, object: usize, window: Option<[f64; 2]>) -> Self {
        let part = &system.model().objects[object];
        let lifts_off = part
            .rigid_pair
            .is_some_and(|pair| pair.closure == Closure::Force);
        let never = [f64::INFINITY, f64::NEG_INFINITY];
        Self {
            deviation: system.deviates(object).then_some(Deviation {
                greatest: Peak::NONE,
                least: Peak::NONE,
                area: 0.0,
            }),
            peaks: [Peak::NONE; 4],
            slack: lifts_off.then(|| [Peak::NONE, Peak::within(window.unwrap_or(never))]),
            opens: part.rigid_pair.map_or(1.0, |pair| pair.opens),
            lift: system.pair_component(object).map(|_| Peak::NONE),
            indentation: Indentation::of(system, object),
            pressure: part.pressing.as_ref().map(|_| Peak::NONE),
            last: ObjectState::default(),
        }
    }

    /// A state outside segments: the start, an edge of the window.
    pub(crate) fn include_state(&mut self, time: f64, state: &ObjectState) {
        if let Some(deviation) = &mut self.deviation {
            deviation.greatest.include(time, state.delta);
            deviation.least.include(time, -state.delta);
        }
        for (peak, signal) in self.peaks.iter_mut().zip(MAGNITUDES) {
            peak.include(time, read(signal, state).abs());
        }
        for peak in self.slack.iter_mut().flatten() {
            peak.include(time, -state.contact_force);
        }
        if let Some(peak) = &mut self.pressure {
            peak.include(time, state.pressure);
        }
        if let Some(Indentation::Followed(peak)) = &mut self.indentation {
            peak.include(time, state.indentation);
        }
        self.last = *state;
    }

    /// The motion at the start alone, where the forces on both its sides are told.
    pub(crate) fn include_motion(&mut self, time: f64, state: &ObjectState) {
        if let Some(deviation) = &mut self.deviation {
            deviation.greatest.include(time, state.delta);
            deviation.least.include(time, -state.delta);
        }
    }

    /// Takes a segment into account, of which the object is number `number`.
    pub(crate) fn add_segment(&mut self, number: usize, segment: &mut dyn Segment) {
        let asked = |signal, sign| SegmentSignal {
            object: number,
            signal,
            sign,
        };
        if let Some(deviation) = &mut self.deviation {
            segment.raise(asked(Signal::Deviation, 1.0), &mut deviation.greatest);
            segment.raise(asked(Signal::Deviation, -1.0), &mut deviation.least);
            deviation.area += segment.area(number);
        }
        segment.raise_magnitudes(number, &mut self.peaks);
        if let Some(peak) = &mut self.pressure {
            segment.raise(asked(Signal::Pressure, 1.0), peak);
        }
        self.add_contact(number, segment);
        if let Some(lift) = &mut self.lift {
            segment.raise(asked(Signal::Clearance, 1.0), lift);
        }
        if let Some(Indentation::Followed(peak)) = &mut self.indentation {
            segment.raise(asked(Signal::Indentation, 1.0), peak);
        }
    }

    /// What is climbed to of the forces: the sign that makes the reaction greater, and
    /// the level that it has to pass.
    pub(crate) fn force_extrema_sought(&self) -> impl Iterator<Item = (f64, f64)> + '_ {
        let reaction = self.peaks[2].value;
        let slack = self.slack.iter().flatten();
        let slack = slack.map(|peak| (self.opens, peak.value));
        [(1.0, reaction), (-1.0, reaction)].into_iter().chain(slack)
    }

    /// The forces at an instant.
    pub(crate) fn include_forces(&mut self, time: f64, state: &ObjectState) {
        for (peak, signal) in self.peaks.iter_mut().zip(MAGNITUDES).skip(2) {
            peak.include(time, read(signal, state).abs());
        }
        for peak in self.slack.iter_mut().flatten() {
            peak.include(time, -state.contact_force);
        }
    }

    fn add_contact(&mut self, number: usize, segment: &mut dyn Segment) {
        for peak in self.slack.iter_mut().flatten() {
            let asked = SegmentSignal {
                object: number,
                signal: Signal::ContactForce,
                sign: -1.0,
            };
            segment.raise(asked, peak);
        }
    }

    /// Takes the forces of another tally in place of its own.
    pub(crate) fn replace_forces(&mut self, other: &Self) {
        self.peaks[2..].copy_from_slice(&other.peaks[2..]);
        self.slack = other.slack;
    }

    /// Takes the pressure on the cam of another tally in place of its own.
    pub(crate) fn replace_pressure(&mut self, other: &Self) {
        self.pressure = other.pressure;
    }

    /// The least of what a force may not pass without being greater than before:
    /// of the reaction, and of −N where the pair is rigid and force-closed.
    pub(crate) fn force_thresholds(&self) -> (f64, f64) {
        let slack = self.slack.iter().flatten().map(|peak| peak.value);
        let reaction = self.peaks[2].value;
        (reaction, slack.fold(f64::INFINITY, f64::min))
    }

    /// The object's state last seen.
    pub(crate) fn last(&self) -> &ObjectState {
        &self.last
    }

    /// Sets the object's state last seen.
    pub(crate) fn set_last(&mut self, state: &ObjectState) {
        self.last = *state;
    }

    /// The greatest magnitudes of acceleration, reaction and contact force so far.
    pub(super) fn greatest(&self) -> [f64; 3] {
        [1, 2, 3].map(|reading| self.peaks[reading].magnitude())
    }

    /// Least contact force of a rigid force-closed pair and its time; the same
    /// within the window (NaN time when nothing was seen there).
    pub(crate) fn margins(&self) -> Option<[(f64, f64); 2]> {
        self.slack
            .map(|peaks| peaks.map(|peak| (-peak.value, peak.time)))
    }

    /// Greatest contact force.
    pub(crate) fn contact_force(&self) -> f64 {
        self.peaks[3].magnitude()
    }

    /// Greatest indentation of the contact element.
    pub(crate) fn indentation(&self) -> Option<f64> {
        Some(match self.indentation? {
            Indentation::Followed(peak) => peak.magnitude(),
            Indentation::OfForce { stiffness, power } => {
                (self.contact_force() / stiffness).powf(1.0 / power)
            }
            Indentation::OfDeviation { pair } => {
                let deviation = self.deviation?;
                let [most, least] = [deviation.greatest.value, deviation.least.value];
                let depth = match pair.closure {
                    Closure::Force if pair.opens >= 0.0 => least,
                    Closure::Force => most,
                    Closure::Form | Closure::Bilateral => most.max(least) - 0.5 * pair.gap,
                };
                depth.max(0.0)
            }
        })
    }

    /// Greatest clearance of the pair.
    pub(crate) fn lift(&self) -> f64 {
        self.lift.map_or(0.0, |lift| lift.magnitude())
    }

    fn followed(&self) -> Option<Peak> {
        match self.indentation? {
            Indentation::Followed(peak) => Some(peak),
            _ => None,
        }
    }

    /// When the figures' extremes are met (s).
    pub(crate) fn times(&self) -> impl Iterator<Item = f64> + '_ {
        let deviation = self.deviation.iter();
        let deviation = deviation.flat_map(|own| [own.greatest, own.least]);
        let slack = self.slack.iter().flatten().copied();
        deviation
            .chain(self.peaks)
            .chain(slack)
            .chain(self.lift)
            .chain(self.followed())
            .chain(self.pressure)
            .filter(|peak| peak.value > f64::NEG_INFINITY)
            .map(|peak| peak.time)
            .filter(|time| time.is_finite())
    }

    /// The object's figures after `duration` seconds, its pair left out.
    pub(crate) fn figures(&self, duration: f64) -> ObjectFigures {
        let mut figures = ObjectFigures {
            peak_speed: self.peaks[0].magnitude(),
            peak_acceleration: self.peaks[1].magnitude(),
            peak_reaction: self.peaks[2].magnitude(),
            end: FinalState {
                displacement: self.last.displacement,
                speed: self.last.speed,
            },
            ..ObjectFigures::default()
        };
        let found = self.pressure.filter(|peak| peak.value.is_finite());
        figures.pressing = found.map(|peak| PressingFigures {
            max_pressure: peak.value.max(0.0),
            time: peak.time,
        });
        if let Some(deviation) = self.deviation {
            figures.delta_max = deviation.greatest.value;
            figures.delta_min = -deviation.least.value;
            figures.delta_abs = greatest_magnitude(figures.delta_min, figures.delta_max);
            figures.sigma = if duration > 0.0 {
                deviation.area / duration
            } else {
                self.last.delta.abs()
            };
        }
        figures
    }
}
