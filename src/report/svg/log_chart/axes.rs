//! Grid, axes, named lines and the lane of a chart.

use super::{Frame, LANE, LEFT, LogChart};
use crate::report::quantity::{escape, superscript};
use crate::report::svg::coordinate;

impl LogChart {
    pub(super) fn axes(&self, frame: &Frame) -> String {
        let mut out = String::new();
        let (left, right) = (coordinate(LEFT), coordinate(LEFT + frame.width));
        let (top, foot) = (coordinate(frame.top), coordinate(frame.top + frame.height));
        for decade in decades(frame.y) {
            let y = coordinate(frame.y(Some(10f64.powf(f64::from(decade)))));
            let every = ((frame.y[1] - frame.y[0]) / (frame.height / 20.0)).ceil() as i32;
            out.push_str(&format!("<path class=\"grid\" d=\"M{left} {y}H{right}\"/>"));
            if decade.rem_euclid(every.max(1)) == 0 {
                out.push_str(&format!(
                    "<text x=\"{}\" y=\"{y}\" dy=\"4\" text-anchor=\"end\">{}</text>\n",
                    coordinate(LEFT - 8.0),
                    power(decade)
                ));
            }
        }
        for (value, label) in self.x_ticks(frame) {
            let x = coordinate(frame.x(value));
            let class = if label.is_empty() { "minor" } else { "grid" };
            out.push_str(&format!(
                "<path class=\"{class}\" d=\"M{x} {top}V{foot}\"/>\
                 <text x=\"{x}\" y=\"{foot}\" dy=\"17\" text-anchor=\"middle\">{label}</text>\n"
            ));
        }
        out.push_str(&format!(
            "<path class=\"axis\" d=\"M{left} {top}V{foot}H{right}\"/>\
             <text x=\"{}\" y=\"{foot}\" dy=\"38\" text-anchor=\"middle\">{}</text>\
             <text transform=\"translate(16 {}) rotate(-90)\" text-anchor=\"middle\">{}</text>\n",
            coordinate(LEFT + 0.5 * frame.width),
            escape(&self.x_label),
            coordinate(frame.top + 0.5 * frame.height),
            escape(&self.y_label)
        ));
        out
    }

    /// Values of the horizontal grid lines, with labels where there is room.
    fn x_ticks(&self, frame: &Frame) -> Vec<(f64, String)> {
        if self.linear_x {
            let count = (frame.width / 90.0).max(2.0) as usize;
            let ticks = crate::report::ticks::ticks(frame.x[0], frame.x[1], count);
            return ticks.values.iter().map(|&v| (v, ticks.label(v))).collect();
        }
        let span = frame.x[1] - frame.x[0];
        let every = (span / (frame.width / 48.0)).ceil().max(1.0) as i32;
        let mut ticks = Vec::new();
        for decade in frame.x[0].floor() as i32..=frame.x[1].ceil() as i32 {
            for lead in 1..=9 {
                let value = f64::from(lead) * 10f64.powi(decade);
                let inside = value.log10() >= frame.x[0] && value.log10() <= frame.x[1];
                let label = match lead {
                    1 if decade.rem_euclid(every) == 0 => power(decade),
                    2 | 5 if span < 2.5 => format!("{lead}·{}", power(decade)),
                    _ => String::new(),
                };
                if inside && (lead == 1 || span < 7.0) {
                    ticks.push((value, label));
                }
            }
        }
        ticks
    }

    /// Lane, shaded part and named lines.
    pub(super) fn ground(&self, frame: &Frame) -> String {
        let mut out = String::new();
        let (left, width) = (coordinate(LEFT), coordinate(frame.width));
        let right = coordinate(LEFT + frame.width);
        let box_of = |class: &str, y: f64, height: f64| {
            format!(
                "<rect class=\"{class}\" x=\"{left}\" y=\"{}\" width=\"{width}\" height=\"{}\"/>",
                coordinate(y),
                coordinate(height)
            )
        };
        if frame.lane {
            out.push_str(&box_of("lane", frame.top - LANE, LANE));
            out.push_str(&format!(
                "<text class=\"small\" x=\"{}\" y=\"{}\" text-anchor=\"end\">{}</text>\n",
                coordinate(LEFT - 8.0),
                coordinate(frame.top - 0.5 * LANE + 1.0),
                escape(&self.lane)
            ));
        }
        if let Some((value, name)) = &self.shaded_below {
            let y = frame.y(Some(*value));
            let foot = frame.top + frame.height;
            if foot - y > 1.0 {
                out.push_str(&box_of("below", y, foot - y));
                out.push_str(&format!(
                    "<text class=\"small\" x=\"{}\" y=\"{}\">{}</text>\n",
                    coordinate(LEFT + 8.0),
                    coordinate((y + 14.0).min(foot - 4.0)),
                    escape(name)
                ));
            }
        }
        for (value, _) in &self.rules {
            let y = coordinate(frame.y(Some(*value)));
            out.push_str(&format!(
                "<path class=\"rule\" d=\"M{left} {y}H{right}\"/>\n"
            ));
        }
        out
    }

    /// Names of the horizontal lines, above all marks.
    pub(super) fn names(&self, frame: &Frame) -> String {
        let name = |(value, name): &(f64, String)| {
            format!(
                "<text class=\"named\" x=\"{}\" y=\"{}\" dy=\"-5\" text-anchor=\"end\">{}</text>\n",
                coordinate(LEFT + frame.width - 4.0),
                coordinate(frame.y(Some(*value))),
                escape(name)
            )
        };
        self.rules.iter().map(name).collect()
    }
}

/// Whole decades within a range of exponents.
fn decades([low, high]: [f64; 2]) -> std::ops::RangeInclusive<i32> {
    (low - 1e-9).ceil() as i32..=(high + 1e-9).floor() as i32
}

fn power(decade: i32) -> String {
    match decade {
        0 => "1".to_owned(),
        1 => "10".to_owned(),
        _ => format!("10{}", superscript(decade)),
    }
}
