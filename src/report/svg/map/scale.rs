//! Axes of maps, plain or logarithmic.

use super::{Drawing, coordinate};
use crate::analysis::axis::Axis;
use crate::report::quantity::{escape, scale, significant};
use crate::report::ticks::ticks;

/// How values lie along an axis of a picture, 0 … 1.
#[derive(Clone, Debug)]
pub(super) struct Scale {
    /// Name and unit beside the axis.
    pub(super) title: String,
    log: bool,
    /// Ends of the axis, as shown (logarithms of a log axis).
    from: f64,
    to: f64,
    /// Middles of the cells, 0 … 1; empty for a plain scale.
    pub(super) middles: Vec<f64>,
    /// Edges of the cells, one more.
    pub(super) edges: Vec<f64>,
    /// What a shown number is to be multiplied with.
    factor: f64,
}

impl Scale {
    /// The scale of an axis of a study: every value in the middle of its cell.
    pub(super) fn of_values(axis: &Axis, unit: &str) -> Self {
        let greatest = axis.from.abs().max(axis.to.abs());
        // Prefixes suit SI units only; a unit of the user's own stays as it is.
        let shown_in = match axis.unit.as_str() {
            "" => scale(greatest, unit),
            own => scale(1.0, own),
        };
        let factor = shown_in.factor;
        let shown = |value: f64| {
            if axis.log {
                value.abs().log10()
            } else {
                value / factor
            }
        };
        let middles: Vec<f64> = axis.values().into_iter().map(shown).collect();
        let last = middles.len() - 1;
        let mut edges = vec![1.5 * middles[0] - 0.5 * middles[1]];
        edges.extend(middles.windows(2).map(|pair| 0.5 * (pair[0] + pair[1])));
        edges.push(1.5 * middles[last] - 0.5 * middles[last - 1]);
        let (from, to) = (edges[0], edges[last + 1]);
        let share = |shown: f64| (shown - from) / (to - from);
        let title = match shown_in.unit.as_str() {
            "" => axis.path.clone(),
            unit => format!("{}, {unit}", axis.path),
        };
        Self {
            title,
            log: axis.log,
            from,
            to,
            middles: middles.into_iter().map(share).collect(),
            edges: edges.into_iter().map(share).collect(),
            factor,
        }
    }

    /// A scale between two values; `factor` is the unit in which they are shown.
    pub(super) fn between(title: String, [from, to]: [f64; 2], log: bool, factor: f64) -> Self {
        let shown = |value: f64| if log { value.log10() } else { value / factor };
        Self {
            title,
            log,
            from: shown(from),
            to: shown(to),
            middles: Vec::new(),
            edges: Vec::new(),
            factor,
        }
    }

    /// Where a value lies, 0 … 1 within the axis.
    pub(super) fn share(&self, value: f64) -> f64 {
        let shown = if self.log {
            value.abs().log10()
        } else {
            value / self.factor
        };
        (shown - self.from) / (self.to - self.from)
    }

    /// Places (0 … 1) and labels of tick marks, about `count` of them.
    pub(super) fn marks(&self, count: usize) -> Vec<(f64, String)> {
        let (low, high) = (self.from.min(self.to), self.from.max(self.to));
        let share = |shown: f64| (shown - self.from) / (self.to - self.from);
        if !self.log {
            let found = ticks(low, high, count);
            return (found.values.iter())
                .map(|&value| (share(value), found.label(value)))
                .collect();
        }
        round_powers(low, high, count)
            .into_iter()
            .map(|value| (share(value.log10()), significant(value / self.factor, 3)))
            .collect()
    }
}

/// Round numbers between 10^low and 10^high: 1, 2 and 5 times powers of ten, or
/// powers alone, or every so many of them.
pub(super) fn round_powers(low: f64, high: f64, count: usize) -> Vec<f64> {
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

/// Frame, ticks and titles of a panel; the plot goes on `below` its frame.
pub(super) fn axes(drawing: &Drawing<'_>, below: f64) -> String {
    let frame = &drawing.frame;
    let (left, right) = (coordinate(frame.left), coordinate(frame.x(1.0)));
    let (top, foot) = (coordinate(frame.top), coordinate(frame.y(0.0)));
    let grid = drawing.study.y.is_none();
    let mut out = String::new();
    for (share, label) in drawing.y.marks((frame.height / 44.0) as usize) {
        let y = coordinate(frame.y(share));
        if grid {
            out.push_str(&format!(
                "<path class=\"grid\" d=\"M{left} {y}H{right}\"/>\n"
            ));
        }
        out.push_str(&format!(
            "<path class=\"tick\" d=\"M{left} {y}h-4\"/>\
             <text x=\"{}\" y=\"{y}\" dy=\"4\" text-anchor=\"end\">{label}</text>\n",
            coordinate(frame.left - 7.0)
        ));
    }
    let low = frame.y(0.0) + below;
    for (share, label) in drawing.x.marks((frame.width / 54.0) as usize) {
        let x = coordinate(frame.x(share));
        if grid {
            out.push_str(&format!("<path class=\"grid\" d=\"M{x} {top}V{foot}\"/>\n"));
        }
        out.push_str(&format!(
            "<path class=\"tick\" d=\"M{x} {}v4\"/>\
             <text x=\"{x}\" y=\"{}\" text-anchor=\"middle\">{label}</text>\n",
            coordinate(low),
            coordinate(low + 17.0)
        ));
    }
    let (middle, height) = (
        coordinate(frame.top + frame.height / 2.0),
        coordinate(low + 34.0),
    );
    out.push_str(&format!(
        "<path class=\"axis\" d=\"M{left} {top}H{right}V{foot}H{left}z\"/>\
         <text x=\"{}\" y=\"{height}\" text-anchor=\"middle\">{}</text>\
         <text transform=\"translate({} {middle}) rotate(-90)\" text-anchor=\"middle\">{}</text>\n",
        coordinate(frame.left + frame.width / 2.0),
        escape(&drawing.x.title),
        coordinate(frame.left - 58.0),
        escape(&drawing.y.title)
    ));
    out
}
