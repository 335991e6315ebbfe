//! The range of a figure over all panels of a map, and how it is shown.

use crate::report::addresses::result_words;
use crate::report::plot::Axis;
use crate::report::plot::scale::ticks;
use crate::report::quantity::{readable_scale, with_unit};
use crate::studies::map::{MapResult, Study};

/// Ratio of the greatest to the least value from which on contour lines follow the logarithm.
const WIDE: f64 = 30.0;

/// Ratio of the greatest size to the middle one from which on a curve is
/// logarithmic whatever its signs: half of it would lie on the axis otherwise.
const BURIED: f64 = 1e3;

/// Greatest such ratio that is shown.
const MOST_WIDE: f64 = 1e9;

/// The range of a figure over all panels, and how it is shown.
#[derive(Clone, Debug)]
pub(super) struct Values {
    figure: String,
    unit: String,
    /// Least and greatest, never equal.
    pub(super) range: [f64; 2],
    /// True: contour lines and axes follow the logarithm.
    pub(super) log: bool,
    /// True: some values are not above zero, and lines show how large they are whatever their
    /// sign.
    pub(super) sizes: bool,
}

impl Values {
    /// The range of a study.
    pub(super) fn of(study: &Study<'_>, result: &MapResult) -> Self {
        let cells = || result.panels.iter().flatten().flatten();
        let values = || cells().filter_map(|cell| cell.value);
        let (least, greatest) = (values().reduce(f64::min), values().reduce(f64::max));
        let (low, high) = (least.unwrap_or(0.0), greatest.unwrap_or(1.0));
        let sizes = || values().map(f64::abs).filter(|&size| size > 0.0);
        let largest = sizes().reduce(f64::max).unwrap_or(0.0);
        // Beyond this the smallest sizes are only where a sign changes.
        let smallest = sizes().reduce(f64::min).unwrap_or(f64::INFINITY);
        let smallest = smallest.max(largest / MOST_WIDE);
        // A curve has an axis to read signs from; lines of a map are labelled with sizes.
        let buried = || largest > BURIED * median(sizes().collect());
        let signless = low > 0.0 || study.y.is_some() || buried();
        let log = largest > WIDE * smallest && signless;
        let range = if log {
            [smallest, largest]
        } else {
            nonempty_range(low, high)
        };
        Self {
            figure: result_words(&study.figure),
            unit: study.unit.clone(),
            range,
            log,
            sizes: log && low <= 0.0,
        }
    }

    /// The value as it is interpolated.
    pub(super) fn scaled(&self, value: f64) -> f64 {
        if self.log {
            value.abs().max(self.range[0]).log10()
        } else {
            value
        }
    }

    /// Round values within the range, about `count`, with their labels.
    pub(super) fn contour_levels(&self, count: usize) -> Vec<(f64, String)> {
        // Round in the unit that is shown.
        let factor = readable_scale(self.range[1], &self.unit).factor;
        let [low, high] = self.range.map(|value| value / factor);
        let values = match self.log {
            true => round_powers(low.log10(), high.log10(), count),
            false => ticks(low, high, count).values,
        };
        let label = |value: f64| (value * factor, with_unit(value * factor, &self.unit, 3));
        values.into_iter().map(label).collect()
    }

    /// The axis of a curve, with a margin.
    pub(super) fn axis(&self) -> Axis {
        let [low, high] = self.range;
        let margin = match self.log {
            true => (high / low).powf(0.05),
            false => 0.06 * (high - low),
        };
        let range = match self.log {
            true => [low / margin, high * margin],
            false => [low - margin, high + margin],
        };
        Axis {
            log: self.log,
            range: Some(range),
            ..Axis::new(&self.name(&self.figure), &self.unit)
        }
    }

    /// A name of the figure, between bars where its size is shown.
    pub(super) fn name(&self, name: &str) -> String {
        match self.sizes {
            true => format!("|{name}|"),
            false => name.to_owned(),
        }
    }
}

/// Round numbers between 10^low and 10^high: 1, 2 and 5 times powers of ten, or
/// powers alone, or every so many of them.
fn round_powers(low: f64, high: f64, count: usize) -> Vec<f64> {
    let decades = high - low;
    let factors: &[f64] = match decades * 3.0 {
        all if all <= count as f64 * 1.5 => &[1.0, 2.0, 5.0],
        _ => &[1.0],
    };
    let stride = if factors.len() > 1 {
        1
    } else {
        (decades / count.max(1) as f64).ceil().max(1.0) as i32
    };
    let (first, last) = (low.floor() as i32, high.ceil() as i32);
    let powers = (first..=last).filter(|power| power.rem_euclid(stride) == 0);
    powers
        .flat_map(|power| factors.iter().map(move |factor| factor * 10f64.powi(power)))
        .filter(|value| (low - 1e-9..=high + 1e-9).contains(&value.log10()))
        .collect()
}

/// The middle one of some sizes.
fn median(mut sizes: Vec<f64>) -> f64 {
    sizes.sort_by(f64::total_cmp);
    sizes.get(sizes.len() / 2).copied().unwrap_or(0.0)
}

/// A range that is never empty.
fn nonempty_range(low: f64, high: f64) -> [f64; 2] {
    let size = low.abs().max(high.abs());
    if high - low > 1e-9 * size {
        [low, high]
    } else if size > 0.0 {
        [low - 0.1 * size, high + 0.1 * size]
    } else {
        [-1.0, 1.0]
    }
}
