//! Gears, belts and racks of a linkage: pitch circles and strands.

use super::view::View;
use super::{Drawing, Placement};
use crate::kinematics::linkage::couplings::{Outline, outlines};
use crate::report::plot::coordinate;

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
    let drawn = |outline: &Outline| match *outline {
        Outline::Circle(own, centre, radius) if own == link => {
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
        Outline::Line(own, ends) if own == link => {
            let [[x, y], [to_x, to_y]] = ends.map(pixel);
            let line = format!("<path class=\"strand\" d=\"M{x} {y}L{to_x} {to_y}\"/>");
            Some(line)
        }
        _ => None,
    };
    outlines(drawing.spec).iter().filter_map(drawn).collect()
}

/// Corners of a square about every pitch circle, and the ends of all lines, at a position (m).
pub(super) fn extent(drawing: &Drawing<'_>, frame: &[Placement]) -> Vec<[f64; 2]> {
    let placed = |link: Option<usize>, at: [f64; 2]| match link {
        Some(link) => frame.get(link).map_or(at, |placement| placement.point(at)),
        None => at,
    };
    let taken = |outline: Outline| match outline {
        Outline::Circle(link, centre, radius) => {
            let [x, y] = placed(link, centre);
            [-radius, radius].map(|reach| [x + reach, y + reach])
        }
        Outline::Line(link, ends) => ends.map(|end| placed(link, end)),
    };
    outlines(drawing.spec).into_iter().flat_map(taken).collect()
}
