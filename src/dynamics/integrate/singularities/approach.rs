//! The way to an edge.

use crate::dynamics::integrate::Singularity;
use crate::dynamics::integrate::continuous::End;

/// The distance left to an edge, with its rates (z, ż, z̈).
#[derive(Clone, Copy, Debug, PartialEq)]
pub(super) struct Approach {
    pub(super) distance: f64,
    pub(super) rate: f64,
    pub(super) acceleration: f64,
}

impl Approach {
    pub(super) fn of(edge: &Singularity, end: &End) -> Self {
        let [s, rate, acceleration] = end.signals[edge.signal];
        Self {
            distance: edge.side * (edge.place - s),
            rate: -edge.side * rate,
            acceleration: -edge.side * acceleration,
        }
    }

    pub(super) fn is_approaching(&self) -> bool {
        self.rate < 0.0 && self.distance > 0.0
    }

    /// True when z touches zero rather than falls through it: 2z·z̈/ż² is 1 for
    /// a parabola with its vertex at zero, and 0 for a straight line.
    pub(super) fn touches(&self) -> bool {
        2.0 * self.distance * self.acceleration >= 0.5 * self.rate * self.rate
    }

    /// Time until z has fallen to `aim` (s): z, or √z where z touches zero,
    /// continued as a parabola. `None`: it turns back before.
    pub(super) fn time_to(&self, aim: f64) -> Option<f64> {
        let Self {
            distance,
            rate,
            acceleration,
        } = *self;
        if !self.is_approaching() || aim > distance {
            return None;
        }
        if self.touches() {
            let root = distance.sqrt();
            let slope = 0.5 * rate / root;
            let bend = 0.5 * (acceleration - 2.0 * slope * slope) / root;
            first_zero(root - aim.sqrt(), slope, bend)
        } else {
            first_zero(distance - aim, rate, acceleration)
        }
    }
}

impl Approach {
    /// Time until z has fallen to `aim`, or, where it turns back before, that
    /// it would take at the present rate (s).
    pub(super) fn time_or_less(&self, aim: f64) -> f64 {
        let straight = (aim - self.distance) / self.rate;
        self.time_to(aim).unwrap_or(straight)
    }
}

/// First zero after 0 of value + slope·t + bend·t²/2 with value ≥ 0 > slope.
fn first_zero(value: f64, slope: f64, bend: f64) -> Option<f64> {
    let square = slope * slope - 2.0 * value * bend;
    let time = 2.0 * value / (square.sqrt() - slope);
    time.is_finite().then_some(time)
}
