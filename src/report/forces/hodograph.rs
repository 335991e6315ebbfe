//! The hodograph of a reaction: the tip of its arrow over all positions, in
//! polar axes.

use crate::report::quantity::{escape, scale};
use crate::report::svg::coordinate;
use crate::report::ticks::ticks;
use std::fmt::Write as _;

/// Room around the plot (pixels).
const MARGIN: f64 = 46.0;
const TITLE: f64 = 26.0;

// Classes of their own: on a page styles reach into all pictures.
const STYLE: &str = ".polar text{font:12px system-ui,-apple-system,'Segoe UI',Roboto,Arial,sans-serif;\
fill:#4a5560}.polar .title{font-size:14px;font-weight:600;fill:#17202a}\
.polar .ring{stroke:#e2e6ea;fill:none}.polar .spoke{stroke:#aab3bd;fill:none}\
.polar .tip{fill:none;stroke:#1d5a9e;stroke-width:1.6;stroke-linejoin:round}\
.polar .first{fill:#c04f15}";

/// The vectors of a force over the positions.
#[derive(Clone, Debug, Default)]
pub struct Hodograph {
    /// Title above the plot.
    pub title: String,
    /// SI unit of the vectors.
    pub unit: String,
    /// The vectors, x to the right and y up; what is not finite interrupts.
    pub vectors: Vec<[f64; 2]>,
    /// True when the last is followed by the first.
    pub closed: bool,
}

impl Hodograph {
    /// The picture, a square of `size` pixels under its title, as a complete
    /// SVG document on white ground.
    pub fn svg(&self, size: f64) -> String {
        let size = size.max(160.0);
        let finite = self
            .vectors
            .iter()
            .filter(|v| v[0].is_finite() && v[1].is_finite());
        let greatest = finite.fold(0.0f64, |most, [x, y]| most.max(x.hypot(*y)));
        let shown = scale(greatest, &self.unit);
        let rings = ticks(
            0.0,
            if greatest > 0.0 {
                greatest / shown.factor
            } else {
                1.0
            },
            4,
        );
        let radius = 0.5 * size - MARGIN;
        let reach = rings
            .values
            .iter()
            .copied()
            .fold(greatest / shown.factor, f64::max);
        let reach = if reach > 0.0 { reach } else { 1.0 };
        let frame = Frame {
            centre: [0.5 * size, TITLE + 0.5 * size],
            pixels: radius / reach,
        };
        let mut grid = String::new();
        for &value in rings.values.iter().filter(|value| **value > 0.0) {
            let [x, y] = frame.centre.map(coordinate);
            let r = coordinate(value * frame.pixels);
            let label = coordinate(frame.centre[1] - value * frame.pixels - 3.0);
            let _ = writeln!(
                grid,
                "<circle class=\"ring\" cx=\"{x}\" cy=\"{y}\" r=\"{r}\"/>\
                 <text x=\"{}\" y=\"{label}\">{}</text>",
                coordinate(frame.centre[0] + 3.0),
                rings.label(value)
            );
        }
        let (w, h) = (coordinate(size), coordinate(size + TITLE));
        format!(
            "<svg xmlns=\"http://www.w3.org/2000/svg\" class=\"polar\" viewBox=\"0 0 {w} {h}\" width=\"{w}\" \
             height=\"{h}\" role=\"img\" aria-label=\"{title}\">\n<style>{STYLE}</style>\n\
             <rect width=\"{w}\" height=\"{h}\" fill=\"#fff\"/>\n\
             <text class=\"title\" x=\"14\" y=\"20\">{title}, {unit}</text>\n{spokes}{grid}\
             <path class=\"tip\" d=\"{path}\"/>\n{start}</svg>\n",
            title = escape(&self.title),
            unit = escape(&shown.unit),
            spokes = frame.spokes(radius),
            path = self.path(&frame, shown.factor),
            start = self.start(&frame, shown.factor),
        )
    }

    fn path(&self, frame: &Frame, factor: f64) -> String {
        let mut out = String::new();
        let mut pen_down = false;
        for vector in &self.vectors {
            let [x, y] = frame.pixel(*vector, factor);
            if !(x.is_finite() && y.is_finite()) {
                pen_down = false;
                continue;
            }
            let command = if pen_down { 'L' } else { 'M' };
            let _ = write!(out, "{command}{} {}", coordinate(x), coordinate(y));
            pen_down = true;
        }
        let whole = self
            .vectors
            .iter()
            .all(|v| v[0].is_finite() && v[1].is_finite());
        if self.closed && whole && !out.is_empty() {
            out.push('z');
        }
        out
    }

    /// A dot where the course begins.
    fn start(&self, frame: &Frame, factor: f64) -> String {
        let Some(first) = self.vectors.first() else {
            return String::new();
        };
        let [x, y] = frame.pixel(*first, factor);
        if !(x.is_finite() && y.is_finite()) {
            return String::new();
        }
        format!(
            "<circle class=\"first\" cx=\"{}\" cy=\"{}\" r=\"3.5\"><title>first position</title></circle>\n",
            coordinate(x),
            coordinate(y)
        )
    }
}

/// Where vectors lie in the picture.
struct Frame {
    centre: [f64; 2],
    /// Pixels for a shown unit.
    pixels: f64,
}

impl Frame {
    fn pixel(&self, [x, y]: [f64; 2], factor: f64) -> [f64; 2] {
        [
            self.centre[0] + x / factor * self.pixels,
            self.centre[1] - y / factor * self.pixels,
        ]
    }

    /// Directions every 30°, named every 90°.
    fn spokes(&self, radius: f64) -> String {
        let mut out = String::new();
        let [x, y] = self.centre;
        for step in 0..12 {
            let angle = f64::from(step) * std::f64::consts::FRAC_PI_6;
            let (sin, cos) = angle.sin_cos();
            let named = step % 3 == 0;
            let class = if named { "spoke" } else { "ring" };
            let _ = write!(
                out,
                "<path class=\"{class}\" d=\"M{} {}L{} {}\"/>",
                coordinate(x),
                coordinate(y),
                coordinate(x + radius * cos),
                coordinate(y - radius * sin)
            );
            if named {
                let far = radius + 16.0;
                let _ = write!(
                    out,
                    "<text x=\"{}\" y=\"{}\" dy=\"4\" text-anchor=\"middle\">{}°</text>",
                    coordinate(x + far * cos),
                    coordinate(y - far * sin),
                    30 * step
                );
            }
        }
        out.push('\n');
        out
    }
}

#[cfg(test)]
mod tests {
    use super::Hodograph;

    #[test]
    fn hodographs_are_closed_and_odd_data_make_a_picture_too() {
        let circle = (0..36).map(|k| f64::from(k) * 0.1745);
        let mut plot = Hodograph {
            title: "Force in <A>".to_owned(),
            unit: "N".to_owned(),
            vectors: circle
                .map(|angle| [2000.0 * angle.cos(), 2000.0 * angle.sin()])
                .collect(),
            closed: true,
        };
        let picture = plot.svg(300.0);
        assert!(picture.contains("Force in &lt;A&gt;, kN"), "{picture}");
        assert!(picture.contains("z\"/>"));
        plot.vectors[3] = [f64::NAN; 2];
        let broken = plot.svg(300.0);
        assert_eq!(
            broken.matches('M').count(),
            picture.matches('M').count() + 1
        );
        for vectors in [vec![], vec![[0.0; 2]], vec![[f64::NAN; 2]]] {
            plot.vectors = vectors;
            let picture = plot.svg(300.0);
            assert!(!picture.contains("NaN") && !picture.contains("inf"));
        }
    }
}
