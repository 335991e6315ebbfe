//! Arrows to scale: their size in the picture, and those of one position.

use super::view::View;
use super::{ArrowSet, Drawing};
use crate::report::plot::coordinate;
use crate::report::quantity::with_unit;
use std::fmt::Write as _;

/// Pixels for a unit of the set's quantity.
pub(super) fn pixels(set: &ArrowSet, view: &View) -> f64 {
    set.metres(view.extent) * view.scale
}

/// Heads of the arrows.
pub(super) fn markers(drawing: &Drawing<'_>) -> String {
    let mut out = String::from("<defs>");
    for index in 0..drawing.arrows.len() {
        let _ = write!(
            out,
            "<marker id=\"head{index}\" class=\"head a{}\" viewBox=\"0 0 10 10\" refX=\"8.5\" \
             refY=\"5\" markerWidth=\"7\" markerHeight=\"7\" orient=\"auto-start-reverse\">\
             <path d=\"M0 0.8L10 5L0 9.2z\"/></marker>",
            index % 4
        );
    }
    out.push_str("</defs>");
    out
}

/// The arrows at a position: a group a set, hidden where it is not shown.
pub(super) fn layer(drawing: &Drawing<'_>, view: &View, frame: usize) -> String {
    let mut out = String::new();
    for (index, set) in drawing.arrows.iter().enumerate() {
        let hidden = if set.shown {
            ""
        } else {
            " visibility=\"hidden\""
        };
        let _ = write!(
            out,
            "<g class=\"arrows a{}\" data-set=\"{index}\"{hidden}>",
            index % 4
        );
        let scale = pixels(set, view);
        for arrow in &set.arrows {
            let at = arrow.at.get(frame).copied().unwrap_or([f64::NAN; 2]);
            let vector = arrow.vector.get(frame).copied().unwrap_or([f64::NAN; 2]);
            let [x, y] = view.pixel(at);
            let (dx, dy) = (vector[0] * scale, -vector[1] * scale);
            // The script needs the line even where it is too short to be seen.
            let finite = [x, y, dx, dy].iter().all(|value| value.is_finite());
            let [x, y, dx, dy] = if finite { [x, y, dx, dy] } else { [0.0; 4] };
            let short = dx.hypot(dy) < 1.0;
            let _ = write!(
                out,
                "<line x1=\"{}\" y1=\"{}\" x2=\"{}\" y2=\"{}\" marker-end=\"url(#head{index})\"{}>\
                 <title>{}</title></line>",
                coordinate(x),
                coordinate(y),
                coordinate(x + dx),
                coordinate(y + dy),
                if short { " visibility=\"hidden\"" } else { "" },
                crate::report::quantity::escape(&arrow.name)
            );
        }
        out.push_str("</g>\n");
    }
    out
}

/// What the arrows show, in words: `speed, longest 0.63 m/s`.
pub(super) fn caption(set: &ArrowSet) -> String {
    format!(
        "{}, longest {}",
        set.name,
        with_unit(set.greatest(), &set.unit, 4)
    )
}
