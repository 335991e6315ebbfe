//! Gears, belts, racks and cams of a linkage: pitch circles, strands, flanks and rollers.

use super::Drawing;
use super::view::View;
use crate::kinematics::linkage::couplings::{Outline, outlines};
use crate::report::plot::coordinate;
use std::fmt::Write;

/// The outlines that go with a link (`None`: with the ground), in pixels of its own frame, from
/// `origin`.
pub(super) fn of_link(
    drawing: &Drawing<'_>,
    view: &View,
    link: Option<usize>,
    origin: [f64; 2],
) -> String {
    let pixel = |[x, y]: [f64; 2]| {
        let place = [origin[0] + x * view.scale, origin[1] - y * view.scale];
        place.map(coordinate)
    };
    let drawn = |outline: &Outline| match outline {
        &Outline::Circle(own, centre, radius) if own == link => {
            let [x, y] = pixel(centre);
            let size = coordinate(radius * view.scale);
            let circle = format!("<circle class=\"pitch\" cx=\"{x}\" cy=\"{y}\" r=\"{size}\"/>");
            // Spokes show how far a wheel has turned.
            let [from, to] = [-radius, radius].map(|reach| pixel([centre[0] + reach, centre[1]]));
            let spokes = format!(
                "<path class=\"strand\" d=\"M{} {}L{} {}\"/>",
                from[0], from[1], to[0], to[1]
            );
            Some(match link {
                Some(_) => circle + &spokes,
                None => circle,
            })
        }
        &Outline::Line(own, ends) if own == link => {
            let [[x, y], [to_x, to_y]] = ends.map(pixel);
            let line = format!("<path class=\"strand\" d=\"M{x} {y}L{to_x} {to_y}\"/>");
            Some(line)
        }
        Outline::Flank(own, points) if *own == link => {
            let mut path = String::new();
            for (index, &point) in points.iter().enumerate() {
                let [x, y] = pixel(point);
                let _ = write!(path, "{}{x} {y}", if index == 0 { "M" } else { "L" });
            }
            Some(format!("<path class=\"strand\" d=\"{path}Z\"/>"))
        }
        &Outline::Roller(own, centre, radius) if own == link && radius > 0.0 => {
            let [x, y] = pixel(centre);
            let size = coordinate(radius * view.scale);
            Some(format!(
                "<circle class=\"roller\" cx=\"{x}\" cy=\"{y}\" r=\"{size}\"/>"
            ))
        }
        _ => None,
    };
    outlines(drawing.spec).iter().filter_map(drawn).collect()
}
