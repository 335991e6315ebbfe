//! Colours of values.
//!
//! The colours are those of viridis (Stéfan van der Walt and Nathaniel Smith,
//! matplotlib, dedicated to the public domain under CC0), sixteen of them with
//! straight lines between: lightness grows evenly, so that they keep their
//! order in print and for colour-blind eyes.

use super::scale::{Scale, round_powers};
use crate::analysis::map::{MapResult, Study};
use crate::report::quantity::{scale, with_unit};
use crate::report::ticks::ticks;

const VIRIDIS: [[u8; 3]; 16] = [
    [68, 1, 84],
    [72, 26, 108],
    [71, 47, 125],
    [65, 68, 135],
    [57, 86, 140],
    [49, 104, 142],
    [42, 120, 142],
    [35, 136, 142],
    [31, 152, 139],
    [34, 168, 132],
    [53, 183, 121],
    [84, 197, 104],
    [122, 209, 81],
    [165, 219, 54],
    [210, 226, 27],
    [253, 231, 37],
];

/// Shades that are told apart.
pub(super) const SHADES: usize = 96;

/// Ratio of the greatest to the least value from which on the scale of colours
/// is logarithmic.
const WIDE: f64 = 30.0;

/// Ratio of the greatest size to the middle one from which on a curve is
/// logarithmic whatever its signs: half of it would lie on the axis otherwise.
const BURIED: f64 = 1e3;

/// Greatest such ratio that is shown.
const MOST_WIDE: f64 = 1e9;

/// The colour of a shade below [`SHADES`].
pub(super) fn colour(shade: usize) -> String {
    let at = shade as f64 / (SHADES - 1) as f64 * (VIRIDIS.len() - 1) as f64;
    let low = (at as usize).min(VIRIDIS.len() - 2);
    let part = at - low as f64;
    let mix = |k: usize| {
        let (a, b) = (f64::from(VIRIDIS[low][k]), f64::from(VIRIDIS[low + 1][k]));
        (a + part * (b - a)).round() as u8
    };
    format!("#{:02x}{:02x}{:02x}", mix(0), mix(1), mix(2))
}

/// The range of a figure over all panels, and how it is shown.
#[derive(Clone, Debug)]
pub(super) struct Values {
    figure: String,
    unit: String,
    /// Least and greatest, never equal.
    pub(super) range: [f64; 2],
    /// True: colours follow the logarithm.
    pub(super) log: bool,
    /// True: some values are not above zero, and colours show how large they
    /// are whatever their sign.
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
        // A curve has an axis to read signs from; colours have none.
        let buried = || largest > BURIED * middle(sizes().collect());
        let signless = low > 0.0 || study.y.is_some() || buried();
        let log = largest > WIDE * smallest && signless;
        let range = if log {
            [smallest, largest]
        } else {
            apart(low, high)
        };
        Self {
            figure: study.figure.clone(),
            unit: study.unit.clone(),
            range,
            log,
            sizes: log && low <= 0.0,
        }
    }

    /// The value as it is interpolated and coloured.
    pub(super) fn shown(&self, value: f64) -> f64 {
        if self.log {
            value.abs().max(self.range[0]).log10()
        } else {
            value
        }
    }

    /// Place of a value within the range, 0 … 1.
    pub(super) fn share(&self, value: f64) -> f64 {
        let [low, high] = self.range.map(|value| self.shown(value));
        ((self.shown(value) - low) / (high - low)).clamp(0.0, 1.0)
    }

    /// Shade of a value.
    pub(super) fn shade(&self, value: f64) -> usize {
        ((self.share(value) * SHADES as f64) as usize).min(SHADES - 1)
    }

    /// Round values within the range, about `count`, with their labels.
    pub(super) fn levels(&self, count: usize) -> Vec<(f64, String)> {
        let [low, high] = self.range;
        let values = if self.log {
            round_powers(low.log10(), high.log10(), count)
        } else {
            ticks(low, high, count).values
        };
        let label = |value: f64| (value, with_unit(value, &self.unit, 3));
        values.into_iter().map(label).collect()
    }

    /// The scale of a curve, with a margin.
    pub(super) fn scale(&self) -> Scale {
        let [low, high] = self.range;
        if self.log {
            let margin = (high / low).powf(0.05);
            let range = [low / margin, high * margin];
            let unit = if self.unit.is_empty() {
                String::new()
            } else {
                format!(", {}", self.unit)
            };
            let title = match self.sizes {
                true => format!("|{}|{unit}", self.figure),
                false => format!("{}{unit}", self.figure),
            };
            return Scale::between(title, range, true, 1.0);
        }
        let shown = scale(low.abs().max(high.abs()), &self.unit);
        let margin = 0.06 * (high - low);
        let title = match shown.unit.as_str() {
            "" => self.figure.clone(),
            unit => format!("{}, {unit}", self.figure),
        };
        Scale::between(title, [low - margin, high + margin], false, shown.factor)
    }

    /// Name of the figure with its unit, for the bar of colours.
    pub(super) fn title(&self) -> &str {
        &self.figure
    }
}

/// The middle one of some sizes.
fn middle(mut sizes: Vec<f64>) -> f64 {
    sizes.sort_by(f64::total_cmp);
    sizes.get(sizes.len() / 2).copied().unwrap_or(0.0)
}

/// A range that is never empty.
fn apart(low: f64, high: f64) -> [f64; 2] {
    let size = low.abs().max(high.abs());
    if high - low > 1e-9 * size {
        [low, high]
    } else if size > 0.0 {
        [low - 0.1 * size, high + 0.1 * size]
    } else {
        [-1.0, 1.0]
    }
}
