//! Regions along an axis as a stand-alone picture: one strip a row, one colour
//! and pattern a kind.

use super::coordinate;
use super::legend::Legend;
use crate::report::quantity::{escape, superscript};

/// Strips over a common axis.
#[derive(Clone, Debug, Default, PartialEq)]
pub struct Strips {
    /// Title above.
    pub title: String,
    /// Name and unit of the axis.
    pub x_label: String,
    /// True: the axis is logarithmic.
    pub log: bool,
    /// Values of the axis, ascending or descending.
    pub x: Vec<f64>,
    /// Name and kinds, one kind a value; `None`: nothing there.
    pub rows: Vec<(String, Vec<Option<usize>>)>,
    /// The kinds.
    pub kinds: Vec<Kind>,
}

/// A kind of region.
#[derive(Clone, Debug, Default, PartialEq)]
pub struct Kind {
    /// Name in the legend.
    pub name: String,
    /// Colour.
    pub colour: &'static str,
    /// True: hatched, for failures.
    pub hatched: bool,
}

const LEFT: f64 = 90.0;
const RIGHT: f64 = 22.0;
const TOP: f64 = 40.0;
const ROW: f64 = 26.0;
const LEGEND_ROW: f64 = 20.0;

const STYLE: &str = ".st text{font:12px system-ui,-apple-system,'Segoe UI',Roboto,Arial,sans-serif;\
fill:#4a5560}.st .title{font-size:14px;font-weight:600;fill:#17202a}.st .axis{stroke:#5a6572;fill:none}\
.st .name{fill:#17202a}";

impl Strips {
    /// The picture, `width` pixels wide, as a complete SVG document on white ground.
    pub fn svg(&self, width: f64) -> String {
        let width = width.max(320.0);
        let (legend, rows) = self.legend(width);
        let top = TOP + rows + 6.0;
        let foot = top + ROW * self.rows.len() as f64;
        let height = foot + 50.0;
        let edges = self.edges();
        let at = |place: f64| LEFT + place * (width - LEFT - RIGHT);
        let mut body = String::new();
        for (row, (name, kinds)) in self.rows.iter().enumerate() {
            let y = top + ROW * row as f64;
            body.push_str(&format!(
                "<text class=\"name\" x=\"{}\" y=\"{}\" text-anchor=\"end\">{}</text>\n",
                coordinate(LEFT - 8.0),
                coordinate(y + 0.5 * ROW + 4.0),
                escape(name)
            ));
            for (from, to, kind) in regions(kinds) {
                let (a, b) = (at(edges[from]), at(edges[to]));
                body.push_str(&self.region(a.min(b), y + 3.0, (b - a).abs(), kind));
            }
        }
        let (w, h) = (coordinate(width), coordinate(height));
        format!(
            "<svg xmlns=\"http://www.w3.org/2000/svg\" class=\"st\" viewBox=\"0 0 {w} {h}\" \
             width=\"{w}\" height=\"{h}\" role=\"img\" aria-label=\"{title}\">\n\
             <style>{STYLE}</style>\n<defs>{patterns}</defs>\n\
             <rect width=\"{w}\" height=\"{h}\" fill=\"#fff\"/>\n\
             <text class=\"title\" x=\"{LEFT}\" y=\"22\">{title}</text>\n{legend}{body}{axis}</svg>\n",
            title = escape(&self.title),
            patterns = self.patterns(),
            axis = self.axis(width, foot),
        )
    }

    /// Places of the edges between values, as shares of the axis.
    fn edges(&self) -> Vec<f64> {
        let place: Vec<f64> = self.x.iter().map(|&x| self.place(x)).collect();
        let count = place.len();
        if count < 2 {
            return vec![0.0, 1.0];
        }
        let mut edges = vec![place[0]];
        edges.extend(place.windows(2).map(|pair| 0.5 * (pair[0] + pair[1])));
        edges.push(place[count - 1]);
        edges
    }

    /// Place of a value as a share of the axis.
    fn place(&self, x: f64) -> f64 {
        let [first, last] = [self.x.first(), self.x.last()].map(|x| x.copied().unwrap_or(0.0));
        let share = match self.log {
            true => (x / first).ln() / (last / first).ln(),
            false => (x - first) / (last - first),
        };
        if share.is_finite() { share } else { 0.5 }
    }

    fn region(&self, x: f64, y: f64, width: f64, kind: usize) -> String {
        let Some(shown) = self.kinds.get(kind) else {
            return String::new();
        };
        let place = format!(
            "x=\"{}\" y=\"{}\" width=\"{}\" height=\"{}\"",
            coordinate(x),
            coordinate(y),
            coordinate(width.max(1.0)),
            coordinate(ROW - 6.0)
        );
        let title = format!("<title>{}</title>", escape(&shown.name));
        let ground = format!("<rect {place} fill=\"{}\">{title}</rect>", shown.colour);
        match shown.hatched {
            true => format!("{ground}<rect {place} fill=\"url(#st-hatch)\"/>\n"),
            false => format!("{ground}\n"),
        }
    }

    fn patterns(&self) -> &'static str {
        "<pattern id=\"st-hatch\" width=\"6\" height=\"6\" patternUnits=\"userSpaceOnUse\" \
         patternTransform=\"rotate(45)\"><path d=\"M0 0V6\" stroke=\"#17202a\" \
         stroke-opacity=\".35\" stroke-width=\"2\"/></pattern>"
    }

    /// The kinds that occur, in rows under the title, and the height they take.
    fn legend(&self, width: f64) -> (String, f64) {
        let mut legend = Legend::new([LEFT, width - RIGHT], LEGEND_ROW);
        let mut out = String::new();
        let occurs = |kind: usize| {
            let mut all = self.rows.iter().flat_map(|(_, kinds)| kinds);
            all.any(|found| *found == Some(kind))
        };
        for (index, kind) in self.kinds.iter().enumerate().filter(|(k, _)| occurs(*k)) {
            let room = 42.0 + 6.9 * kind.name.chars().count() as f64;
            let (x, down) = legend.place(room);
            let y = TOP - 6.0 + down;
            out.push_str(&self.region(x, y - 6.0, 20.0, index));
            out.push_str(&format!(
                "<text x=\"{}\" y=\"{}\">{}</text>\n",
                coordinate(x + 27.0),
                coordinate(y + 8.0),
                escape(&kind.name)
            ));
        }
        (out, legend.height())
    }

    fn axis(&self, width: f64, foot: f64) -> String {
        let right = width - RIGHT;
        let mut out = format!(
            "<path class=\"axis\" d=\"M{} {y}H{}\"/>\
             <text x=\"{}\" y=\"{y}\" dy=\"38\" text-anchor=\"middle\">{}</text>\n",
            coordinate(LEFT),
            coordinate(right),
            coordinate(0.5 * (LEFT + right)),
            escape(&self.x_label),
            y = coordinate(foot),
        );
        for (value, label) in self.ticks() {
            let x = coordinate(LEFT + self.place(value) * (right - LEFT));
            out.push_str(&format!(
                "<path class=\"axis\" d=\"M{x} {y}v5\"/>\
                 <text x=\"{x}\" y=\"{y}\" dy=\"18\" text-anchor=\"middle\">{label}</text>\n",
                y = coordinate(foot)
            ));
        }
        out
    }

    fn ticks(&self) -> Vec<(f64, String)> {
        let [a, b] = [self.x.first(), self.x.last()].map(|x| x.copied().unwrap_or(0.0));
        let (low, high) = (a.min(b), a.max(b));
        if self.log && low > 0.0 {
            let wide = (high / low).log10() > 2.5;
            let mut ticks = Vec::new();
            for decade in low.log10().floor() as i32..=high.log10().ceil() as i32 {
                for lead in [1.0, 2.0, 5.0] {
                    let value = lead * 10f64.powi(decade);
                    let inside = value >= low * (1.0 - 1e-9) && value <= high * (1.0 + 1e-9);
                    if inside && (lead == 1.0 || !wide) {
                        let factor = if lead == 1.0 {
                            String::new()
                        } else {
                            format!("{lead}·")
                        };
                        ticks.push((value, format!("{factor}10{}", superscript(decade))));
                    }
                }
            }
            return ticks;
        }
        let ticks = crate::report::ticks::ticks(low, high, 6);
        ticks.values.iter().map(|&v| (v, ticks.label(v))).collect()
    }
}

/// Stretches of one kind: first index, index after the last, kind.
fn regions(kinds: &[Option<usize>]) -> Vec<(usize, usize, usize)> {
    let mut found: Vec<(usize, usize, usize)> = Vec::new();
    for (index, kind) in kinds.iter().enumerate() {
        let Some(kind) = *kind else { continue };
        match found.last_mut() {
            Some(last) if last.1 == index && last.2 == kind => last.1 = index + 1,
            _ => found.push((index, index + 1, kind)),
        }
    }
    found
}

#[cfg(test)]
mod tests {
    use super::{Kind, Strips, regions};

    #[test]
    fn neighbours_of_one_kind_are_one_region() {
        let kinds = [Some(0), Some(0), None, Some(1), Some(0)];
        assert_eq!(regions(&kinds), [(0, 2, 0), (3, 4, 1), (4, 5, 0)]);
    }

    #[test]
    fn a_region_ends_midway_between_values() {
        let strips = Strips {
            log: true,
            x: vec![1e6, 1e7, 1e8, 1e9],
            rows: vec![("rk4 < 5".into(), vec![Some(0), Some(0), Some(1), Some(1)])],
            kinds: vec![
                Kind::default(),
                Kind {
                    hatched: true,
                    ..Kind::default()
                },
            ],
            ..Strips::default()
        };
        let edges = strips.edges();
        approx::assert_relative_eq!(edges[2], 0.5, max_relative = 1e-12);
        let picture = strips.svg(640.0);
        assert!(picture.contains("rk4 &lt; 5") && picture.contains("st-hatch"));
        assert!(!picture.contains("NaN"));
        assert!(!Strips::default().svg(640.0).contains("NaN"));
    }
}
