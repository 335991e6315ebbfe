//! Signals of an object over a part of a stretch: polynomials with the errors of their fit.

use crate::math::chebyshev::{Nodes, derivative, value};
use crate::math::expression::{Interval, VARIABLES};

/// Places at which signals are looked at for a fit.
pub(super) const NODES: usize = 17;

/// Coefficients whose sizes tell how far a fit is off.
const LAST: usize = 3;
/// A fit may be off by so many times what they tell.
const CAUTION: f64 = 4.0;
/// Share of its size to which a signal has been fitted.
const RESOLVED: f64 = 1e-11;
/// Roundings of its size that a value of a fit may be off.
const ROUNDINGS: f64 = 16.0;

/// Parts of a stretch that may hold many vibrations, at least and at most.
const PARTS: [f64; 2] = [4.0, 1e6];

/// The parts of a stretch: with a density (1/s) so many in a second, without one it is a step.
pub(super) fn parts_of_stretch(
    [from, to]: [f64; 2],
    density: Option<f64>,
) -> impl Iterator<Item = [f64; 2]> {
    let [least, most] = PARTS;
    let count = density.map_or(1.0, |own| (own * (to - from)).clamp(least, most).ceil());
    let edge = move |part: u64| match part as f64 == count {
        true => to,
        false => from + (to - from) * (part as f64 / count),
    };
    (0..count as u64).map(move |part| [edge(part), edge(part + 1)])
}

/// One signal.
#[derive(Clone, Debug)]
enum Signal {
    /// No condition reads it.
    Unread,
    /// It does not change, or has no value.
    Fixed(f64),
    /// It is no number at some places.
    Broken,
    /// A sum of Chebyshev's polynomials, and of its derivative.
    Fit {
        series: [f64; NODES],
        slope: [f64; NODES],
        /// Bound of the second derivative.
        bend: f64,
        /// How far it may be off.
        error: f64,
        /// Bound of the values.
        size: f64,
    },
}

impl Signal {
    /// `values`: at the nodes, then at both ends.
    fn of(values: &[f64; NODES + 2], nodes: &Nodes<NODES>) -> Self {
        let first = values[0];
        if values.iter().all(|value| *value == first) || values.iter().all(|value| value.is_nan()) {
            return Self::Fixed(first);
        }
        if !values.iter().all(|value| value.is_finite()) {
            return Self::Broken;
        }
        let inner: [f64; NODES] = std::array::from_fn(|place| values[place]);
        let series = nodes.polynomial_through(&inner);
        let size = series.iter().map(|c| c.abs()).sum::<f64>();
        let last = series[NODES - LAST..].iter().map(|c| c.abs()).sum::<f64>();
        // The ends are no nodes: they tell what the coefficients may not.
        let off = |x: f64, own: f64| (value(&series, x) - own).abs();
        let ends = off(-1.0, values[NODES]).max(off(1.0, values[NODES + 1]));
        let rounding = ROUNDINGS * f64::EPSILON * size;
        let bend = series.iter().enumerate().map(|(k, c)| {
            let square = (k * k) as f64;
            square * (square - 1.0).max(0.0) / 3.0 * c.abs()
        });
        Self::Fit {
            slope: derivative(&series),
            bend: bend.sum(),
            error: CAUTION * last.max(ends) + rounding,
            series,
            size,
        }
    }

    fn is_resolved(&self) -> bool {
        match self {
            Self::Unread | Self::Fixed(_) => true,
            Self::Broken => false,
            Self::Fit { error, size, .. } => *error <= RESOLVED * size,
        }
    }

    /// Bounds about x ∈ [−1, 1], `reach` to both sides; whether more than its error.
    fn bounds(&self, x: f64, reach: f64) -> (Interval, bool) {
        match self {
            Self::Unread => (Interval::of(0.0), false),
            Self::Fixed(value) => (Interval::of(*value), false),
            Self::Broken => {
                let (low, high) = (f64::NEG_INFINITY, f64::INFINITY);
                (Interval { low, high }, true)
            }
            Self::Fit {
                series,
                slope,
                bend,
                error,
                size,
            } => {
                let middle = value(series, x);
                let change = (value(slope, x).abs() + 0.5 * bend * reach) * reach;
                let most = size + error;
                let bounds = Interval {
                    low: (middle - change - error).max(-most),
                    high: (middle + change + error).min(most),
                };
                (bounds, change > *error)
            }
        }
    }
}

/// The variables of a condition over a part of a stretch, the time first.
#[derive(Clone, Debug)]
pub(super) struct FittedVariables {
    span: [f64; 2],
    signals: [Signal; VARIABLES],
}

impl FittedVariables {
    /// Fits those that are `read`; `look` gives all at an instant.
    pub(super) fn new(
        [from, to]: [f64; 2],
        read: &[bool; VARIABLES],
        nodes: &Nodes<NODES>,
        look: &mut dyn FnMut(f64) -> [f64; VARIABLES],
    ) -> Self {
        let mut signals = std::array::from_fn(|_| Signal::Unread);
        if read[1..].contains(&true) {
            let inside = |x: &f64| 0.5 * ((1.0 - x) * from + (1.0 + x) * to);
            let times = nodes.places.iter().map(inside).chain([from, to]);
            let rows: Vec<[f64; VARIABLES]> = times.map(look).collect();
            for (index, signal) in signals.iter_mut().enumerate().skip(1) {
                if read[index] {
                    *signal = Signal::of(&std::array::from_fn(|row| rows[row][index]), nodes);
                }
            }
        }
        let span = [from, to];
        Self { span, signals }
    }

    /// True where all signals are known to rounding.
    pub(super) fn is_resolved(&self) -> bool {
        self.signals.iter().all(Signal::is_resolved)
    }

    /// Bounds of the variables between two instants; whether any changes there by more than
    /// it is known.
    pub(super) fn bounds(&self, from: f64, to: f64) -> ([Interval; VARIABLES], bool) {
        let [start, end] = self.span;
        let half = 0.5 * (end - start);
        let x = (0.5 * (from - start + (to - start)) / half - 1.0).clamp(-1.0, 1.0);
        let reach = 0.5 * (to - from) / half + f64::EPSILON * (end.abs() / half + 4.0);
        let mut changes = false;
        let mut bounds = [Interval::of(0.0); VARIABLES];
        bounds[0] = Interval {
            low: from,
            high: to,
        };
        for (bounds, signal) in bounds.iter_mut().zip(&self.signals).skip(1) {
            let (own, moves) = signal.bounds(x, reach);
            *bounds = own;
            changes |= moves;
        }
        (bounds, changes)
    }
}

#[cfg(test)]
mod tests {
    use super::{FittedVariables, NODES};
    use crate::math::chebyshev::Nodes;
    use crate::math::expression::VARIABLES;

    fn row(time: f64) -> [f64; VARIABLES] {
        let mut row = [0.0; VARIABLES];
        row[0] = time;
        row[1] = (3.0 * time).sin();
        row[2] = time.powi(5) - 2.0 * time;
        row[3] = 7.0;
        row
    }

    #[test]
    fn bounds_hold_what_lies_between_and_are_close() {
        let nodes = Nodes::<NODES>::new();
        let fitted = FittedVariables::new([0.2, 1.1], &[true; VARIABLES], &nodes, &mut row);
        assert!(fitted.is_resolved());
        for (from, to) in [(0.2, 1.1), (0.2, 0.3), (0.65, 0.65 + 1e-5), (1.0, 1.1)] {
            let (bounds, changes) = fitted.bounds(from, to);
            assert!(changes);
            for place in 0..=40 {
                let time = from + (to - from) * f64::from(place) / 40.0;
                for (own, value) in bounds.iter().zip(row(time)) {
                    assert!(own.low <= value && value <= own.high, "{own:?} {value}");
                }
            }
            let width = bounds[1].high - bounds[1].low;
            assert!(
                width <= 3.0 * (to - from) * (1.0 + 4.0 * (to - from)) + 1e-9,
                "{width}"
            );
            assert_eq!(bounds[3].low, bounds[3].high);
        }
    }

    #[test]
    fn what_jumps_or_vibrates_too_fast_is_not_resolved() {
        let nodes = Nodes::<NODES>::new();
        let jumps = &mut |time: f64| [f64::from(time > 0.4); VARIABLES];
        assert!(!FittedVariables::new([0.0, 1.0], &[true; VARIABLES], &nodes, jumps).is_resolved());
        let fast = &mut |time: f64| [(200.0 * time).sin(); VARIABLES];
        assert!(!FittedVariables::new([0.0, 1.0], &[true; VARIABLES], &nodes, fast).is_resolved());
    }
}
