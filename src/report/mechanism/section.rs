//! The linkage as a stand-alone picture and as a moving part of a page.

use super::view::View;
use super::{Drawing, arrows, parts};
use crate::report::quantity::{escape, significant};
use crate::report::svg::coordinate;
use serde_json::{Value, json};

const STYLE: &str = include_str!("mechanism.css");
const SCRIPT: &str = include_str!("mechanism.js");

impl Drawing<'_> {
    /// The picture of one position as a complete SVG document on white ground.
    /// A position that is not there shows the links in their own frames.
    pub fn svg(&self, frame: usize) -> String {
        let view = View::of(self);
        let (w, h) = (coordinate(view.width), coordinate(view.height + 26.0));
        format!(
            "<svg xmlns=\"http://www.w3.org/2000/svg\" class=\"mechanism\" viewBox=\"0 0 {w} {h}\" \
             width=\"{w}\" height=\"{h}\" role=\"img\" aria-label=\"{label}\">\n\
             <style>{STYLE}</style>\n<rect width=\"{w}\" height=\"{h}\" fill=\"#fff\"/>\n\
             {markers}\n{parts}{layer}<text class=\"note\" x=\"14\" y=\"{foot}\">{note}</text>\n</svg>\n",
            label = escape(&self.note(frame)),
            markers = arrows::markers(self),
            parts = parts::picture(self, &view, frame),
            layer = arrows::layer(self, &view, frame),
            foot = coordinate(view.height + 12.0),
            note = escape(&self.note(frame)),
        )
    }

    /// `crank angle 30 deg; speed, longest 0.63 m/s`.
    fn note(&self, frame: usize) -> String {
        let value = self.axis.values.get(frame).copied().unwrap_or(f64::NAN);
        let value = format!(
            "{} {} {}",
            self.axis.name,
            significant(value, 6),
            self.axis.unit
        );
        let shown = self.arrows.iter().filter(|set| set.shown);
        let shown = shown.map(|set| format!("; {}", arrows::caption(set)));
        std::iter::once(value.trim_end().to_owned())
            .chain(shown)
            .collect()
    }

    /// The moving picture for a page: drawing, controls and the script that
    /// moves it. One page may hold several, told apart by `id`.
    pub fn section(&self, id: &str) -> String {
        let view = View::of(self);
        let (w, h) = (coordinate(view.width), coordinate(view.height));
        let id = escape(id);
        format!(
            "<style>{STYLE}</style>\n<figure class=\"moving\" id=\"{id}\">\n\
             <svg class=\"mechanism\" viewBox=\"0 0 {w} {h}\" width=\"{w}\" height=\"{h}\" role=\"img\" \
             aria-label=\"the mechanism, to scale\">\n{markers}\n{parts}{layer}</svg>\n\
             <div class=\"bar controls\"></div>\n</figure>\n\
             <script type=\"application/json\" id=\"{id}-data\">{data}</script>\n\
             <script>\n{SCRIPT}(\"{id}\");\n</script>\n",
            markers = arrows::markers(self),
            parts = parts::picture(self, &view, 0),
            layer = arrows::layer(self, &view, 0),
            data = self.data(&view),
        )
    }

    /// Everything that moves, in pixels.
    fn data(&self, view: &View) -> Value {
        let short = |value: f64, digits: i32| {
            let factor = 10f64.powi(digits);
            let rounded = (value * factor).round() / factor;
            if rounded.is_finite() {
                json!(rounded)
            } else {
                Value::Null
            }
        };
        let frames: Vec<Vec<Value>> = (self.frames.iter())
            .map(|frame| {
                let flat = frame.iter().flat_map(|placement| {
                    let [x, y] = view.pixel(placement.at);
                    let [c, s] = placement.turn;
                    [short(x, 2), short(y, 2), short(c, 6), short(s, 6)]
                });
                flat.collect()
            })
            .collect();
        let sets: Vec<Value> = (self.arrows.iter())
            .map(|set| {
                let scale = arrows::pixels(set, view);
                let arrow = |arrow: &super::Arrow| -> Vec<Value> {
                    let both = arrow.at.iter().zip(&arrow.vector);
                    both.flat_map(|(at, vector)| {
                        let [x, y] = view.pixel(*at);
                        [
                            short(x, 2),
                            short(y, 2),
                            short(vector[0] * scale, 2),
                            short(-vector[1] * scale, 2),
                        ]
                    })
                    .collect()
                };
                json!({
                    "name": set.name,
                    "caption": arrows::caption(set),
                    "shown": set.shown,
                    "arrows": set.arrows.iter().map(arrow).collect::<Vec<_>>(),
                })
            })
            .collect();
        json!({
            "axis": {
                "name": self.axis.name,
                "unit": self.axis.unit,
                "values": self.axis.values.iter().map(|v| short(*v, 6)).collect::<Vec<_>>(),
                "times": self.axis.times.iter().map(|v| short(*v, 9)).collect::<Vec<_>>(),
                "closed": self.axis.closed,
            },
            "paths": self.paths.iter().map(|path| path.name.clone()).collect::<Vec<_>>(),
            "frames": frames,
            "sets": sets,
        })
    }
}
