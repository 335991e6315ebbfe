//! The part of the plane that is shown, and its scale.

use super::{Drawing, Placement, arrows, guides, shape};

/// Largest picture (pixels).
const WIDEST: f64 = 860.0;
const HIGHEST: f64 = 560.0;
/// Margin around the mechanism (pixels).
const MARGIN: f64 = 46.0;

/// From metres to pixels.
#[derive(Clone, Copy, Debug)]
pub(super) struct View {
    /// Size of the picture (pixels).
    pub(super) width: f64,
    /// Size of the picture (pixels).
    pub(super) height: f64,
    /// Pixels a metre.
    pub(super) scale: f64,
    /// Place of the ground's origin (pixels).
    pub(super) origin: [f64; 2],
    /// Largest extent of the mechanism itself (m).
    pub(super) extent: f64,
}

impl View {
    /// The view that holds every position of the drawing.
    pub(super) fn of(drawing: &Drawing<'_>) -> Self {
        let mut area = Area::default();
        for point in &drawing.spec.ground {
            area.take(point.at);
        }
        for pair in &drawing.spec.pairs {
            for end in [&pair.on, &pair.link] {
                if end.link.is_none() {
                    area.take(end.at);
                }
            }
        }
        for frame in &drawing.frames {
            for (link, placement) in frame.iter().enumerate() {
                for corner in shape::corners(drawing.spec, link) {
                    area.take(placement.point(corner));
                }
            }
        }
        for point in drawing.paths.iter().flat_map(|path| &path.points) {
            area.take(*point);
        }
        let extent = Self::around(&area).extent;
        for pair in 0..drawing.spec.pairs.len() {
            for end in guides::rail_ends(drawing, pair, extent) {
                area.take(end);
            }
        }
        for set in &drawing.arrows {
            let scale = arrows::metres(set, extent);
            for arrow in &set.arrows {
                for (at, vector) in arrow.at.iter().zip(&arrow.vector) {
                    area.take([at[0] + scale * vector[0], at[1] + scale * vector[1]]);
                }
            }
        }
        Self {
            extent,
            ..Self::around(&area)
        }
    }

    fn around(area: &Area) -> Self {
        let ([left, foot], [right, top]) = (area.low, area.high);
        let (wide, high) = (right - left, top - foot);
        let extent = wide.max(high);
        if !(extent.is_finite() && extent > 0.0) {
            return Self {
                width: 2.0 * MARGIN,
                height: 2.0 * MARGIN,
                scale: 1.0,
                origin: [MARGIN, MARGIN],
                extent: 1.0,
            };
        }
        let scale = ((WIDEST - 2.0 * MARGIN) / wide.max(1e-9 * extent))
            .min((HIGHEST - 2.0 * MARGIN) / high.max(1e-9 * extent));
        Self {
            width: wide * scale + 2.0 * MARGIN,
            height: high * scale + 2.0 * MARGIN,
            scale,
            origin: [MARGIN - left * scale, MARGIN + top * scale],
            extent,
        }
    }

    /// A place in pixels.
    pub(super) fn pixel(&self, [x, y]: [f64; 2]) -> [f64; 2] {
        [
            self.origin[0] + x * self.scale,
            self.origin[1] - y * self.scale,
        ]
    }

    /// The transform that puts a link, drawn in pixels of its own frame with y
    /// upwards, into the picture.
    pub(super) fn transform(&self, placement: &Placement) -> String {
        let [x, y] = self.pixel(placement.at);
        let [c, s] = placement.turn;
        format!("matrix({c:.6} {:.6} {s:.6} {c:.6} {x:.3} {y:.3})", -s)
    }
}

/// What has to be seen.
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
    fn take(&mut self, point: [f64; 2]) {
        if point.iter().all(|value| value.is_finite()) {
            for axis in 0..2 {
                self.low[axis] = self.low[axis].min(point[axis]);
                self.high[axis] = self.high[axis].max(point[axis]);
            }
        }
    }
}
