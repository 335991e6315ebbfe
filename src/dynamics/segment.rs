//! What is known of a motion over a stretch without switches.
//!
//! Between two switches a motion is smooth, and some description of it holds from end
//! to end: a closed form (exact propagation), or the polynomials of an integration.
//! Whoever wants figures, works or samples asks a [`Segment`] and need not know
//! which of the two it is.
//!
//! A segment has the state at an instant, the greatest values of a signal, ∫|δ| and the works.
//! There are three:
//!
//! * a phase of a tree, in closed form (`exact::event_loop`);
//! * a step of an integration, in polynomials and observations between them
//!   (`record::observed`);
//! * a stretch of what a mass of a tree carries rigidly, in observations alone
//!   (`record::sampled`).

use crate::dynamics::energy::EnergyAudit;

/// A signal of an object.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub(crate) enum Signal {
    /// δ of the last mass.
    Deviation,
    /// φ̇ of the last mass.
    Speed,
    /// φ̈ of the last mass.
    Acceleration,
    /// F of link 1; what moves a drive.
    Reaction,
    /// N of the pair; negative where a rigid force-closed pair would have to pull.
    ContactForce,
    /// Indentation of a contact element that ends at a massless point.
    Indentation,
    /// Pressure between a follower and its cam.
    Pressure,
    /// Clearance of an open pair from the nearest flank, negative behind it.
    Clearance,
}

/// Signals of whose magnitude the greatest is wanted.
pub(crate) const MAGNITUDES: [Signal; 4] = [
    Signal::Speed,
    Signal::Acceleration,
    Signal::Reaction,
    Signal::ContactForce,
];

/// A signal of one of the objects of a segment, turned round for its least values.
#[derive(Clone, Copy, Debug, PartialEq)]
pub(crate) struct SegmentSignal {
    /// Index of the object in the model of the segment.
    pub(crate) object: usize,
    /// Signal that is looked at.
    pub(crate) signal: Signal,
    /// +1, or −1 for the negative of the signal.
    pub(crate) sign: f64,
}

/// The greatest value so far, and when it was taken.
#[derive(Clone, Copy, Debug, PartialEq)]
pub(crate) struct Peak {
    /// Greatest value; −∞ before anything was seen.
    pub(crate) value: f64,
    /// Time of the extreme (s).
    pub(crate) time: f64,
    /// Only times within these bounds count.
    bounds: [f64; 2],
}

impl Peak {
    /// Nothing seen yet; all times count.
    pub(crate) const NONE: Self = Self::within([f64::NEG_INFINITY, f64::INFINITY]);

    /// Nothing seen yet; only times within `bounds` count.
    pub(crate) const fn within(bounds: [f64; 2]) -> Self {
        Self {
            value: f64::NEG_INFINITY,
            time: f64::NAN,
            bounds,
        }
    }

    /// Takes a single value into account.
    pub(crate) fn include(&mut self, time: f64, value: f64) {
        if value > self.value && self.bounds[0] <= time && time <= self.bounds[1] {
            (self.value, self.time) = (value, time);
        }
    }

    /// True when none of the times between two instants counts.
    pub(crate) fn excludes(&self, [from, to]: [f64; 2]) -> bool {
        to < self.bounds[0] || from > self.bounds[1]
    }

    /// The greatest value; 0 when nothing greater was seen.
    pub(crate) fn magnitude(&self) -> f64 {
        self.value.max(0.0)
    }
}

/// Motion of some objects over a stretch without switches.
pub(crate) trait Segment {
    /// Puts the objects' part of the state y = [u, u̇] at an instant of the segment.
    fn state(&mut self, time: f64, y: &mut [f64]);

    /// Raises a peak to the greatest value of a signal over the segment, if that is
    /// greater; what cannot be costs next to nothing.
    fn raise(&mut self, asked: SegmentSignal, peak: &mut Peak);

    /// Raises the peak of the magnitude of a signal.
    fn raise_magnitude(&mut self, object: usize, signal: Signal, peak: &mut Peak) {
        for sign in [1.0, -1.0] {
            let asked = SegmentSignal {
                object,
                signal,
                sign,
            };
            self.raise(asked, peak);
        }
    }

    /// Raises the peaks of all [`MAGNITUDES`] of an object.
    fn raise_magnitudes(&mut self, object: usize, peaks: &mut [Peak; 4]) {
        for (peak, signal) in peaks.iter_mut().zip(MAGNITUDES) {
            self.raise_magnitude(object, signal, peak);
        }
    }

    /// ∫|δ| dt of an object (s times its unit) over what has come about since it was
    /// last asked for.
    fn area(&mut self, object: usize) -> f64;

    /// Works over what has come about since they were last asked for.
    fn works(&mut self) -> EnergyAudit;
}
