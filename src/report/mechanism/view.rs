//! The part of the plane that is shown, and its scale.

use super::names::named_pins;
use super::{Drawing, Placement, guides, shape};

/// Largest picture (pixels).
const WIDEST: f64 = 860.0;
const HIGHEST: f64 = 560.0;
/// Margin around the mechanism (pixels).
const MARGIN: f64 = 46.0;
/// Least distance of a name from the edge of the picture (pixels).
const EDGE: f64 = 6.0;

/// From metres to pixels.
#[derive(Clone, Copy, Debug)]
pub(in crate::report) struct View {
    /// Size of the picture (pixels).
    pub(in crate::report) width: f64,
    /// Size of the picture (pixels).
    pub(in crate::report) height: f64,
    /// Pixels a metre.
    pub(in crate::report) scale: f64,
    /// Place of the ground's origin (pixels).
    pub(in crate::report) origin: [f64; 2],
    /// Largest extent of the mechanism itself (m).
    pub(in crate::report) extent: f64,
}

impl View {
    /// The view that holds every position of the drawing.
    pub(in crate::report) fn of(drawing: &Drawing<'_>) -> Self {
        Self::view_of_all_positions(drawing, f64::INFINITY)
    }

    /// The view that holds every position, of at most so many pixels a metre.
    pub(in crate::report) fn view_of_all_positions(drawing: &Drawing<'_>, most: f64) -> Self {
        let mut area = Area::default();
        for point in &drawing.spec.ground {
            area.include_point(point.at);
        }
        for pair in &drawing.spec.pairs {
            for end in [&pair.on, &pair.link] {
                if end.link.is_none() {
                    area.include_point(end.at);
                }
            }
        }
        for frame in &drawing.frames {
            for (link, placement) in frame.iter().enumerate() {
                for corner in shape::corners(drawing.spec, link) {
                    area.include_point(placement.point(corner));
                }
            }
        }
        if !drawing.spec.couplings.is_empty() {
            for point in drawing
                .frames
                .iter()
                .flat_map(|frame| shape::outline_corners(drawing.spec, frame))
            {
                area.include_point(point);
            }
        }
        for point in drawing.paths.iter().flat_map(|path| &path.points) {
            area.include_point(*point);
        }
        let extent = area.extent().unwrap_or(1.0);
        for pair in 0..drawing.spec.pairs.len() {
            for point in guides::outline(drawing, pair, extent) {
                area.include_point(point);
            }
        }
        for set in &drawing.arrows {
            let scale = set.metres(extent);
            for arrow in &set.arrows {
                for (at, vector) in arrow.at.iter().zip(&arrow.vector) {
                    area.include_point(*at);
                    area.include_point([at[0] + scale * vector[0], at[1] + scale * vector[1]]);
                }
            }
        }
        let right = right_margin(drawing, &area, MARGIN, most);
        let right = right_margin(drawing, &area, right, most);
        Self {
            extent,
            ..Self::view_of_area(&area, right, most)
        }
    }

    /// A view of an area; margins are [`MARGIN`] wide but for that on the right.
    fn view_of_area(area: &Area, right_margin: f64, most: f64) -> Self {
        let Some(extent) = area.extent() else {
            return Self {
                width: 2.0 * MARGIN,
                height: 2.0 * MARGIN,
                scale: 1.0,
                origin: [MARGIN, MARGIN],
                extent: 1.0,
            };
        };
        let ([left, foot], [right, top]) = (area.low, area.high);
        let (wide, high) = (right - left, top - foot);
        let scale = ((WIDEST - MARGIN - right_margin) / wide.max(1e-9 * extent))
            .min((HIGHEST - 2.0 * MARGIN) / high.max(1e-9 * extent))
            .min(most);
        Self {
            width: wide * scale + MARGIN + right_margin,
            height: high * scale + 2.0 * MARGIN,
            scale,
            origin: [MARGIN - left * scale, MARGIN + top * scale],
            extent,
        }
    }

    /// A place in pixels.
    pub(in crate::report) fn pixel(&self, [x, y]: [f64; 2]) -> [f64; 2] {
        [
            self.origin[0] + x * self.scale,
            self.origin[1] - y * self.scale,
        ]
    }

    /// The transform that puts a link, drawn in pixels of its own frame with y
    /// upwards, into the picture.
    pub(in crate::report) fn transform(&self, placement: &Placement) -> String {
        let [x, y] = self.pixel(placement.at);
        let [c, s] = placement.turn;
        format!("matrix({c:.6} {:.6} {s:.6} {c:.6} {x:.3} {y:.3})", -s)
    }
}

/// The margin on the right that the names of pins need, at the scale of a given one.
fn right_margin(drawing: &Drawing<'_>, area: &Area, margin: f64, most: f64) -> f64 {
    let scale = View::view_of_area(area, margin, most).scale;
    let beyond = |([x, _], room): ([f64; 2], f64)| EDGE + room - (area.high[0] - x) * scale;
    let widest = named_pins(drawing).map(beyond);
    let widest = widest.filter(|room| room.is_finite());
    widest.fold(MARGIN, f64::max).min(0.5 * WIDEST)
}

/// Area that has to be seen.
#[derive(Clone, Copy, Debug)]
struct Area {
    low: [f64; 2],
    high: [f64; 2],
}

impl Default for Area {
    fn default() -> Self {
        Self {
            low: [f64::INFINITY; 2],
            high: [f64::NEG_INFINITY; 2],
        }
    }
}

impl Area {
    /// The larger of width and height; `None` of an area without any.
    fn extent(&self) -> Option<f64> {
        let extent = (self.high[0] - self.low[0]).max(self.high[1] - self.low[1]);
        (extent.is_finite() && extent > 0.0).then_some(extent)
    }

    fn include_point(&mut self, point: [f64; 2]) {
        if point.iter().all(|value| value.is_finite()) {
            for axis in 0..2 {
                self.low[axis] = self.low[axis].min(point[axis]);
                self.high[axis] = self.high[axis].max(point[axis]);
            }
        }
    }
}
