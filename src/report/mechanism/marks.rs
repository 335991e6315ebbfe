//! What a drawing to scale bears beside the mechanism: a scale bar and the sense of rotation.

use super::names::ground_pin;
use super::view::View;
use super::{Drawing, Placement};
use crate::report::plot::coordinate;
use crate::report::quantity::{escape, with_unit};
use std::f64::consts::PI;

/// Longest scale bar (pixels).
const BAR: f64 = 96.0;
/// Radius of the arc that shows a sense of rotation (pixels).
pub(in crate::report) const ARC: f64 = 27.0;

/// A scale bar of a round length whose left end is at a pixel; empty without a scale.
pub(in crate::report) fn scale_bar(pixels_per_metre: f64, [x, y]: [f64; 2]) -> String {
    let Some(length) = round_below(BAR / pixels_per_metre) else {
        return String::new();
    };
    let wide = length * pixels_per_metre;
    format!(
        "<g class=\"dim scale\"><path d=\"M{x} {top}v8m0 -4h{wide}m0 -4v8\"/><text x=\"{text}\" y=\"{foot}\">{}</text></g>\n",
        escape(&with_unit(length, "m", 3)),
        x = coordinate(x),
        top = coordinate(y - 4.0),
        wide = coordinate(wide),
        text = coordinate(x + wide + 7.0),
        foot = coordinate(y + 4.0),
    )
}

/// The greatest of 1, 2 and 5 times a power of ten that is not greater.
fn round_below(value: f64) -> Option<f64> {
    if !(value > 0.0 && value.is_finite()) {
        return None;
    }
    let power = 10f64.powi(value.log10().floor() as i32);
    let factors = [5.0, 2.0, 1.0].into_iter();
    let mut fitting = factors.map(|factor| factor * power);
    fitting.find(|round| *round <= value * (1.0 + 1e-9))
}

/// The arc with a head that shows in which sense something turns about a pixel: from the lower
/// right a third of a turn on, or back.
pub(in crate::report) fn turning_arrow(
    [x, y]: [f64; 2],
    radius: f64,
    counterclockwise: bool,
) -> String {
    let [from, to] = match counterclockwise {
        true => [-0.42 * PI, 0.25 * PI],
        false => [0.25 * PI, -0.42 * PI],
    };
    let at = |angle: f64| [x + radius * angle.cos(), y - radius * angle.sin()];
    let ([x0, y0], [x1, y1]) = (at(from).map(coordinate), at(to));
    // Along the arc at its end, on the screen.
    let along = to
        + if counterclockwise {
            0.5 * PI
        } else {
            -0.5 * PI
        };
    let head = |turned: f64| {
        let (sin, cos) = (along + turned).sin_cos();
        [x1 - 9.0 * cos, y1 + 9.0 * sin].map(coordinate)
    };
    let ([ax, ay], [bx, by]) = (head(0.38), head(-0.38));
    let (x1, y1) = (coordinate(x1), coordinate(y1));
    format!(
        "<g class=\"sense\"><path d=\"M{x0} {y0}A{r} {r} 0 0 {sweep} {x1} {y1}\"/><path class=\"barb\" \
         d=\"M{x1} {y1}L{ax} {ay}L{bx} {by}z\"/></g>\n",
        r = coordinate(radius),
        sweep = u8::from(!counterclockwise),
    )
}

/// The pixel of the driving pin of the ground, and whether its link turns counterclockwise from
/// position to position; `None` where it does not turn in one sense, by at least an angle (rad).
pub(super) fn driving_turn(
    drawing: &Drawing<'_>,
    view: &View,
    least: f64,
) -> Option<([f64; 2], bool)> {
    let (pin, link) = driving_pin(drawing)?;
    let turn = |pair: &[Vec<Placement>]| {
        let [[c, s], [d, t]] = [&pair[0][link], &pair[1][link]].map(|placement| placement.turn);
        (c * t - s * d).atan2(c * d + s * t)
    };
    let steps = drawing.frames.windows(2).map(turn);
    let steps: Vec<f64> = steps.filter(|step| step.is_finite()).collect();
    let whole = steps.iter().sum::<f64>().abs() >= least;
    let forward = steps.iter().all(|step| *step >= 0.0);
    let back = steps.iter().all(|step| *step <= 0.0);
    (whole && (forward || back)).then(|| (view.pixel(pin), forward))
}

/// The place of the driving pair and its link, where it is a pin of the ground.
fn driving_pin(drawing: &Drawing<'_>) -> Option<([f64; 2], usize)> {
    let pair = drawing.spec.pairs.get(drawing.spec.driver)?;
    ground_pin(pair)
}
