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
    unit: &'static str,
    /// Least and greatest, never equal.
    pub(super) range: [f64; 2],
    /// True: colours follow the logarithm.
    pub(super) log: bool,
}

impl Values {
    /// The range of a study.
    pub(super) fn of(study: &Study<'_>, result: &MapResult) -> Self {
        let cells = result.panels.iter().flatten().flatten();
        let start = [f64::INFINITY, f64::NEG_INFINITY];
        let [low, high] = cells
            .filter_map(|cell| cell.value)
            .fold(start, |[low, high], value| {
                [low.min(value), high.max(value)]
            });
        let log = low > 0.0 && high > WIDE * low;
        let range = match (
            low <= high,
            high > low * (1.0 + 1e-12) || high - low > 1e-300,
        ) {
            (false, _) => [0.0, 1.0],
            (true, true) => [low, high],
            (true, false) if low == 0.0 => [-1.0, 1.0],
            (true, false) => [low - 0.1 * low.abs(), high + 0.1 * high.abs()],
        };
        Self {
            figure: study.figure.clone(),
            unit: study.unit,
            range,
            log,
        }
    }

    /// The value as it is interpolated and coloured.
    pub(super) fn shown(&self, value: f64) -> f64 {
        if self.log { value.log10() } else { value }
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
        let label = |value: f64| (value, with_unit(value, self.unit, 3));
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
            return Scale::between(format!("{}{unit}", self.figure), range, true, 1.0);
        }
        let shown = scale(low.abs().max(high.abs()), self.unit);
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
