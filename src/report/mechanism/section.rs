//! The linkage as a stand-alone picture and as a moving part of a page.

use super::view::View;
use super::{Drawing, GridAxis, arrows, marks, parts};
use crate::report::html::player::{Arrows, Body, Player, RowAxis, Slider, player_number};
use crate::report::plot::{coordinate, document};
use crate::report::quantity::{escape, significant};

/// The style of the drawings: with the colours of a page, or with their own.
pub(in crate::report) const STYLE: &str = include_str!("mechanism.css");

/// How long all positions are played at normal speed (s).
const SECONDS: f64 = 4.0;

/// Angle from which on a link is said to turn, not to swing (rad).
const FULL: f64 = 0.95 * std::f64::consts::TAU;

impl Drawing<'_> {
    /// The picture of one position as a complete SVG document on white ground.
    /// A position that is not there shows the links in their own frames.
    pub fn svg(&self, frame: usize) -> String {
        let view = View::of(self);
        let note = self.position_note(frame);
        let body = format!(
            "{markers}\n{parts}{marks}{layer}<text class=\"note\" x=\"14\" y=\"{foot}\">{note}</text>\n",
            markers = arrows::markers(self),
            parts = parts::picture(self, &view, frame),
            marks = self.scale_mark(&view) + &self.sense_mark(&view, true, FULL),
            layer = arrows::layer(self, &view, frame),
            foot = coordinate(view.height + 12.0),
            note = escape(&note),
        );
        let size = [view.width, view.height + 26.0];
        document("mechanism", size, &note, STYLE, &body)
    }

    /// `crank angle 30 deg; speed, longest 0.63 m/s`.
    fn position_note(&self, frame: usize) -> String {
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

    /// The moving picture for a page, with its controls. One page may hold
    /// several, told apart by `id`.
    pub fn section(&self, id: &str) -> String {
        let view = View::of(self);
        let player = self.player(id, &view);
        player.figure(&self.picture(&view, 0, &self.sense_mark(&view, true, FULL)))
    }

    /// The picture with a slider for each input: the positions are those of a grid over them,
    /// the first input fastest; `start` is shown first.
    pub fn section_over(&self, id: &str, axes: &[GridAxis], start: usize) -> String {
        let view = View::of(self);
        let slider = |axis: &GridAxis| Slider {
            name: axis.name.clone(),
            unit: axis.unit.clone(),
            values: axis.values.iter().map(|v| player_number(*v, 6)).collect(),
        };
        let player = Player {
            axis: Some(RowAxis {
                values: (0..self.frames.len()).map(|row| Some(row as f64)).collect(),
                ..RowAxis::default()
            }),
            sliders: axes.iter().map(slider).collect(),
            start,
            ..self.player(id, &view)
        };
        player.figure(&self.picture(&view, start, ""))
    }

    /// The scale bar in the margin.
    fn scale_mark(&self, view: &View) -> String {
        marks::scale_bar(view.scale, [14.0, view.height - 14.0])
    }

    /// The sense in which the driving link turns from position to position, or back; empty where
    /// it turns by less than an angle (rad).
    pub(in crate::report) fn sense_mark(&self, view: &View, forward: bool, least: f64) -> String {
        marks::driving_turn(self, view, least).map_or(String::new(), |(pin, counterclockwise)| {
            marks::turning_arrow(pin, marks::ARC, counterclockwise == forward)
        })
    }

    fn picture(&self, view: &View, frame: usize, sense: &str) -> String {
        let (w, h) = (coordinate(view.width), coordinate(view.height));
        format!(
            "<svg class=\"mechanism\" viewBox=\"0 0 {w} {h}\" width=\"{w}\" height=\"{h}\" role=\"img\" \
             aria-label=\"the mechanism, to scale\">\n{markers}\n{parts}{scale}{sense}{layer}</svg>\n",
            markers = arrows::markers(self),
            parts = parts::picture(self, view, frame),
            scale = self.scale_mark(view),
            layer = arrows::layer(self, view, frame),
        )
    }

    /// The parts at a position, without arrows.
    pub(in crate::report) fn draw_parts(&self, view: &View, frame: usize) -> String {
        parts::picture(self, view, frame)
    }

    /// The place of a link over all positions: x, y, cosine, sine in pixels.
    pub(in crate::report) fn table(&self, view: &View, link: usize) -> Vec<Option<f64>> {
        let placed = self.frames.iter().map(|frame| &frame[link]);
        let flat = placed.flat_map(|placement| {
            let [x, y] = view.pixel(placement.at);
            let [c, s] = placement.turn;
            [
                player_number(x, 2),
                player_number(y, 2),
                player_number(c, 6),
                player_number(s, 6),
            ]
        });
        flat.collect()
    }

    /// Everything that moves, in pixels.
    fn player(&self, id: &str, view: &View) -> Player {
        let all = |values: &[f64], digits: i32| {
            values.iter().map(|v| player_number(*v, digits)).collect()
        };
        let arrows = |set: &super::ArrowSet| {
            let scale = arrows::pixels(set, view);
            let arrow = |arrow: &super::Arrow| -> Vec<Option<f64>> {
                let both = arrow.at.iter().zip(&arrow.vector);
                both.flat_map(|(at, vector)| {
                    let [x, y] = view.pixel(*at);
                    let (dx, dy) = (vector[0] * scale, -vector[1] * scale);
                    [
                        player_number(x, 2),
                        player_number(y, 2),
                        player_number(dx, 2),
                        player_number(dy, 2),
                    ]
                })
                .collect()
            };
            Arrows {
                name: set.name.clone(),
                caption: arrows::caption(set),
                greatest: Some((set.greatest(), set.unit.clone())),
                shown: set.shown,
                arrows: set.arrows.iter().map(arrow).collect(),
                on: Vec::new(),
            }
        };
        let links = 0..self.spec.links.len();
        Player {
            id: id.to_owned(),
            axis: Some(RowAxis {
                name: self.axis.name.clone(),
                unit: self.axis.unit.clone(),
                values: all(&self.axis.values, 6),
                times: all(&self.axis.times, 9),
                closed: self.axis.closed,
            }),
            seconds: SECONDS,
            scale: Some([1.0 / view.scale, view.origin[0], view.origin[1]]),
            names: self
                .spec
                .links
                .iter()
                .map(|link| link.name.clone())
                .collect(),
            bodies: links
                .map(|link| Body::Rows {
                    table: self.table(view, link),
                })
                .collect(),
            sets: self.arrows.iter().map(arrows).collect(),
            ..Player::default()
        }
    }
}
