//! Grid, ticks and names of axes.

use super::frame::{Frame, LANE, STRIP};
use super::scale::{thinned, ticks};
use super::{Plot, coordinate, width_of};
use crate::report::quantity::escape;
use std::fmt::Write as _;

/// Pixels from tick to tick.
pub(super) const PITCH_X: f64 = 78.0;
pub(super) const PITCH_Y: f64 = 32.0;

impl Plot {
    /// Everything that zooming draws anew: lines of the grid, labels, names of axes.
    pub(super) fn grid(&self, frame: &Frame) -> String {
        match self.plane {
            true => self.polar(frame),
            false => self.cartesian(frame),
        }
    }

    fn cartesian(&self, frame: &Frame) -> String {
        let mut out = String::new();
        let solid = self.field.as_ref().is_some_and(|field| !field.strip);
        let (left, right) = (coordinate(frame.left), coordinate(frame.left + frame.width));
        let (top, foot) = (coordinate(frame.top), coordinate(frame.top + frame.height));
        let class = |tick: &super::scale::Tick| match (tick.zero, tick.minor) {
            (true, _) => "zero",
            (_, true) => "minor",
            _ => "gridline",
        };
        for tick in frame.y.ticks(frame.height, PITCH_Y) {
            let y = coordinate(frame.top + (1.0 - tick.share) * frame.height);
            if !solid {
                let _ = write!(
                    out,
                    "<path class=\"{}\" d=\"M{left} {y}H{right}\"/>",
                    class(&tick)
                );
            }
            if !tick.label.is_empty() {
                let _ = writeln!(
                    out,
                    "<text x=\"{}\" y=\"{y}\" dy=\"4\" text-anchor=\"end\">{}</text>",
                    coordinate(frame.left - 7.0),
                    escape(&tick.label)
                );
            }
        }
        let strip = if self.has_strip() { STRIP } else { 0.0 };
        let low = frame.top + frame.height + strip;
        for tick in thinned(frame.x.ticks(frame.width, PITCH_X), frame.width, 8.0) {
            let at = frame.left + tick.share * frame.width;
            let x = coordinate(at);
            let _ = match solid {
                true => write!(out, "<path class=\"axis\" d=\"M{x} {foot}v4\"/>"),
                false => write!(
                    out,
                    "<path class=\"{}\" d=\"M{x} {top}V{foot}\"/>",
                    class(&tick)
                ),
            };
            if !tick.label.is_empty() {
                // The last label stays within the picture.
                let most = frame.left + frame.width + 18.0 - 0.5 * width_of(&tick.label);
                let _ = writeln!(
                    out,
                    "<text x=\"{}\" y=\"{}\" text-anchor=\"middle\">{}</text>",
                    coordinate(at.min(most)),
                    coordinate(low + 17.0),
                    escape(&tick.label)
                );
            }
        }
        let _ = write!(
            out,
            "<path class=\"axis\" d=\"M{left} {top}V{foot}H{right}\"/>\
             <text class=\"x-name\" x=\"{}\" y=\"{}\" text-anchor=\"middle\">{}</text>",
            coordinate(frame.left + 0.5 * frame.width),
            coordinate(low + 35.0),
            escape(&frame.x.title(&self.x.name))
        );
        if !self.y.name.is_empty() {
            let _ = write!(
                out,
                "<text transform=\"translate({} {}) rotate(-90)\" text-anchor=\"middle\">{}</text>",
                coordinate(14.0f64.min(frame.left - 40.0).max(frame.left - 62.0)),
                coordinate(frame.top + 0.5 * frame.height),
                escape(&frame.y.title(&self.y.name))
            );
        }
        if frame.lane {
            let _ = write!(
                out,
                "<rect class=\"lane\" x=\"{left}\" y=\"{}\" width=\"{}\" height=\"{LANE}\"/>\
                 <text x=\"{}\" y=\"{}\" text-anchor=\"end\">{}</text>",
                coordinate(frame.top - LANE),
                coordinate(frame.width),
                coordinate(frame.left - 7.0),
                coordinate(frame.top - 0.5 * LANE + 4.0),
                escape(&self.lane)
            );
        }
        out.push('\n');
        out
    }

    /// Rings and directions about the origin; the rings are labelled where no curve passes.
    fn polar(&self, frame: &Frame) -> String {
        let (cx, cy) = (frame.x(0.0), frame.y(0.0));
        let pixels = frame.x(1.0) - cx;
        let shown = frame.reach / frame.x.factor;
        let rings = ticks(0.0, shown, 4);
        let (sin, cos) = self.free_direction(frame).to_radians().sin_cos();
        let mut out = String::new();
        for &value in rings.values.iter().filter(|value| **value > 0.0) {
            let r = value * frame.x.factor * pixels;
            let _ = writeln!(
                out,
                "<circle class=\"gridline\" cx=\"{}\" cy=\"{}\" r=\"{}\" fill=\"none\"/>\
                 <text x=\"{}\" y=\"{}\" dy=\"4\" text-anchor=\"middle\">{}</text>",
                coordinate(cx),
                coordinate(cy),
                coordinate(r),
                coordinate(cx + r * cos),
                coordinate(cy - r * sin),
                rings.label(value)
            );
        }
        let radius = frame.reach * pixels;
        for step in 0..12 {
            let (sin, cos) = (f64::from(step) * std::f64::consts::FRAC_PI_6).sin_cos();
            let class = if step % 3 == 0 { "zero" } else { "gridline" };
            let _ = write!(
                out,
                "<path class=\"{class}\" d=\"M{} {}L{} {}\"/>",
                coordinate(cx),
                coordinate(cy),
                coordinate(cx + radius * cos),
                coordinate(cy - radius * sin)
            );
            if step % 3 == 0 {
                let _ = write!(
                    out,
                    "<text x=\"{}\" y=\"{}\" dy=\"4\" text-anchor=\"middle\">{}°</text>",
                    coordinate(cx + (radius + 13.0) * cos),
                    coordinate(cy - (radius + 11.0) * sin),
                    30 * step
                );
            }
        }
        out.push('\n');
        out
    }

    /// The direction (degrees) along which labels of rings keep farthest from the curves.
    pub(super) fn free_direction(&self, frame: &Frame) -> f64 {
        let pixels = frame.x(1.0) - frame.x(0.0);
        let rings: Vec<f64> = ticks(0.0, frame.reach / frame.x.factor, 4).values;
        let touched = |angle: f64| {
            let (sin, cos) = angle.to_radians().sin_cos();
            let near = |&&(x, y): &&(f64, f64)| {
                rings.iter().filter(|ring| **ring > 0.0).any(|ring| {
                    let ring = ring * frame.x.factor;
                    let (dx, dy) = (x - ring * cos, y - ring * sin);
                    (dx * pixels).abs() < 20.0 && (dy * pixels).abs() < 9.0
                })
            };
            let points = self.series.iter().flat_map(|series| &series.points);
            points.filter(near).count()
        };
        // Between the directions that are drawn, beginning near the vertical.
        let angles = [
            75.0, 105.0, 45.0, 135.0, 15.0, 165.0, 255.0, 285.0, 225.0, 315.0, 195.0, 345.0,
        ];
        let best = angles.into_iter().min_by_key(|angle| touched(*angle));
        best.unwrap_or(75.0)
    }
}
