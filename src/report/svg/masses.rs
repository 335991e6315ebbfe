//! The dynamic model as a picture: for each object its law, its driving pair, its links and
//! masses with their numbers, one row an object.

use crate::dynamics::model::{
    Closure, LinkBase, Model, NodeIndex, NodeMotion, OUTPUT, ObjectPart, STOP,
};
use crate::report::diagram::pair;
use crate::report::order::drivers_first;
use crate::report::plot::{characters_per_line, coordinate};
use crate::report::quantity::{escape, shortened, with_unit};
use crate::report::show::{motion, units};

const ROW: f64 = 104.0;
const NAME: f64 = 132.0;
const LAW: f64 = 74.0;
const LINK: f64 = 130.0;
const MASS: f64 = 78.0;
const MARGIN: f64 = 10.0;
/// Height of a row's line above its lower end.
const LINE: f64 = 52.0;
/// Masses of a chain that are drawn; of more the first ones and the last.
const DRAWN: usize = 5;

/// The picture, for pages that give the colours. A mass tells its object and number in
/// `data-object` and `data-mass`.
pub(in crate::report) fn svg(model: &Model) -> String {
    let order = drivers_first(model).into_iter();
    let shown: Vec<usize> = order
        .filter(|&index| ![OUTPUT, STOP].contains(&model.objects[index].kind))
        .collect();
    let mut width = 0.0_f64;
    let mut rows = String::new();
    for (place, &index) in shown.iter().enumerate() {
        let (row, end) = Row::new(model, index).into_drawing();
        width = width.max(end);
        let y = coordinate(MARGIN + ROW * place as f64 + LINE);
        let id = escape(&model.objects[index].id);
        rows.push_str(&format!(
            "<g class=\"row\" data-object=\"{id}\" transform=\"translate({MARGIN} {y})\">{row}</g>\n"
        ));
    }
    let (w, h) = (
        coordinate(width + 2.0 * MARGIN),
        coordinate(2.0 * MARGIN + ROW * shown.len() as f64),
    );
    format!(
        "<svg class=\"dam-model\" viewBox=\"0 0 {w} {h}\" width=\"{w}\" height=\"{h}\" role=\"group\" \
         aria-label=\"Dynamic model\">\n{rows}</svg>\n"
    )
}

/// A row while it is drawn, from left to right.
struct Row<'m> {
    model: &'m Model,
    part: &'m ObjectPart,
    out: String,
    x: f64,
}

impl<'m> Row<'m> {
    fn new(model: &'m Model, index: usize) -> Self {
        Self {
            model,
            part: &model.objects[index],
            out: String::new(),
            x: 0.0,
        }
    }

    fn into_drawing(mut self) -> (String, f64) {
        self.name();
        let first = self.part.nodes.first();
        match first.map(|&node| &self.model.nodes[node].motion) {
            Some(NodeMotion::Prescribed { motion, .. }) => {
                let words = motion::summary(motion, self.part.coordinate);
                self.source("prescribed", &words);
            }
            Some(NodeMotion::Rotor { .. }) => {
                self.source("motor", "torque");
                self.bar(24.0);
                self.masses();
            }
            Some(NodeMotion::Mass { .. }) => {
                self.law();
                self.masses();
            }
            Some(NodeMotion::Rigid { .. } | NodeMotion::Constrained { .. }) => {
                self.law();
                self.pair();
                self.masses();
            }
            None => {}
        }
        (self.out, self.x)
    }

    fn text(&mut self, class: &str, x: f64, y: f64, room: f64, words: &str) {
        let size = if class.contains("id") { 13.5 } else { 11.0 };
        let shown = escape(&shortened(words, characters_per_line(room, size)));
        let (x, y) = (coordinate(x), coordinate(y));
        self.out.push_str(&format!(
            "<text class=\"{class}\" x=\"{x}\" y=\"{y}\"><title>{}</title>{shown}</text>",
            escape(words)
        ));
    }

    fn name(&mut self) {
        let part = self.part;
        let drivers = part.inputs.iter();
        let drivers: Vec<&str> = drivers
            .map(|input| self.model.objects[input.driver].id.as_str())
            .collect();
        self.text("id", 0.0, -8.0, NAME - 8.0, &part.id);
        self.text("soft", 0.0, 8.0, NAME - 8.0, &part.kind.replace('_', " "));
        if !drivers.is_empty() {
            let words = format!("on {}", drivers.join(" and "));
            self.text("soft", 0.0, 23.0, NAME - 8.0, &words);
        }
        self.x = NAME;
    }

    /// What moves by itself.
    fn source(&mut self, what: &str, words: &str) {
        let x = coordinate(self.x + 17.0);
        self.out.push_str(&format!(
            "<circle class=\"source\" cx=\"{x}\" cy=\"0\" r=\"17\"/>\
             <path class=\"turn\" d=\"M{} 3a8 8 0 1 1 8 7m-3 -4l3 4l-4 3\"/>",
            coordinate(self.x + 9.0)
        ));
        self.x += 34.0;
        let (x, room) = (self.x + 10.0, 150.0);
        if what == "prescribed" {
            self.text("", x, -2.0, room, words);
            self.text("soft", x, 13.0, room, what);
            self.x += 10.0 + room;
        }
    }

    /// The displacement U(φ) that the object is driven by.
    fn law(&mut self) {
        let (x, width) = (coordinate(self.x), coordinate(LAW));
        self.out.push_str(&format!(
            "<rect class=\"law\" x=\"{x}\" y=\"-15\" width=\"{width}\" height=\"30\" rx=\"15\"/>"
        ));
        let word = match self.part.inputs.len() {
            0 | 1 => "U(φ)",
            _ => "G(φ₁, …)",
        };
        self.text("middle", self.x + LAW / 2.0, 4.0, LAW, word);
        self.x += LAW;
    }

    fn bar(&mut self, length: f64) {
        let (x, length_written) = (coordinate(self.x), coordinate(length));
        self.out.push_str(&format!(
            "<path class=\"rod\" d=\"M{x} 0h{length_written}\"/>"
        ));
        self.x += length;
    }

    /// The driving pair, where it can open.
    fn pair(&mut self) {
        let Some(pair) = pair(self.model, self.part) else {
            self.bar(26.0);
            return;
        };
        let unit = units(self.part.coordinate).displacement;
        let at = |x: f64| coordinate(self.x + x);
        let (mark, words) = match pair.closure {
            Closure::Bilateral => {
                self.bar(26.0);
                return;
            }
            Closure::Force => (
                format!(
                    "<path class=\"rod\" d=\"M{} 0h10M{} 0h12\"/><path class=\"gap\" d=\"M{} -12v24\"/>\
                     <circle class=\"gap\" cx=\"{}\" cy=\"0\" r=\"6\"/>",
                    at(0.0),
                    at(22.0),
                    at(10.0),
                    at(17.0)
                ),
                "lifts off".to_owned(),
            ),
            Closure::Form => (
                format!(
                    "<path class=\"rod\" d=\"M{} 0h8M{} 0h10\"/>\
                     <path class=\"gap\" d=\"M{} -12h-5v24h5M{} -12h5v24h-5\"/>\
                     <circle class=\"gap\" cx=\"{}\" cy=\"0\" r=\"5\"/>",
                    at(0.0),
                    at(24.0),
                    at(13.0),
                    at(21.0),
                    at(17.0)
                ),
                format!("gap {}", with_unit(pair.gap, unit, 4)),
            ),
        };
        self.out.push_str(&mark);
        self.text("middle gap-name", self.x + 17.0, 28.0, 90.0, &words);
        self.x += 34.0;
    }

    /// A spring with a damper beside it.
    fn link(&mut self, link: usize) {
        let of = &self.model.links[link];
        let (stiffness, damping) = (of.stiffness, of.damping);
        if matches!(of.base, LinkBase::Law { .. }) {
            self.pair();
        }
        let unit = units(self.part.coordinate);
        let x = coordinate(self.x);
        let tooth = (LINK - 28.0) / 7.0;
        let (half, whole) = (coordinate(tooth / 2.0), coordinate(tooth));
        let teeth = format!("l{whole} 12l{whole} -12").repeat(3);
        let damper = match damping > 0.0 {
            false => String::new(),
            true => format!(
                "<path class=\"spring\" d=\"M{a} 0v12h{b}m12 0h{b}v-12M{c} 6h14v12h-14M{d} 8v8\"/>",
                a = coordinate(self.x + 8.0),
                b = coordinate((LINK - 28.0) / 2.0),
                c = coordinate(self.x + LINK / 2.0 - 8.0),
                d = coordinate(self.x + LINK / 2.0 - 4.0),
            ),
        };
        self.out.push_str(&format!(
            "<path class=\"spring\" d=\"M{x} 0h8v-12h6l{half} -6{teeth}l{half} 6h6v12h8\"/>{damper}"
        ));
        let (middle, room) = (self.x + LINK / 2.0, LINK - 6.0);
        let words = format!("c = {}", with_unit(stiffness, unit.stiffness, 4));
        self.text("middle", middle, -24.0, room + 14.0, &words);
        if damping > 0.0 {
            let words = format!("b = {}", with_unit(damping, unit.damping, 4));
            self.text("middle", middle, 33.0, room + 22.0, &words);
        }
        self.x += LINK;
    }

    fn masses(&mut self) {
        let nodes = &self.part.nodes;
        let last = nodes.len().saturating_sub(1);
        for (place, &node) in nodes.iter().enumerate() {
            let drawn = nodes.len() <= DRAWN + 1 || place < DRAWN || place == last;
            if !drawn {
                if place == DRAWN {
                    let words = format!("… {} more …", nodes.len() - DRAWN - 1);
                    self.text("middle", self.x + 46.0, 4.0, 90.0, &words);
                    self.x += 92.0;
                }
                continue;
            }
            if let Some(&link) = self.part.links.get(place) {
                self.link(link);
            }
            self.mass(place + 1, node);
        }
    }

    fn mass(&mut self, number: usize, node: NodeIndex) {
        let unit = units(self.part.coordinate);
        let of = &self.model.nodes[node];
        let linkage = self.model.linkages.iter().any(|body| body.node == node);
        let inertia = match linkage {
            true => "reduced to φ".to_owned(),
            false => with_unit(of.inertia, unit.inertia, 4),
        };
        let id = escape(&self.part.id);
        self.out.push_str(&format!(
            "<g class=\"mass\" data-object=\"{id}\" data-mass=\"{number}\" tabindex=\"0\" role=\"button\" \
             aria-label=\"mass {number} of {id}\"><rect class=\"box\" x=\"{}\" y=\"-21\" width=\"{MASS}\" \
             height=\"42\" rx=\"4\"/>",
            coordinate(self.x)
        ));
        let middle = self.x + MASS / 2.0;
        let name = match self.part.nodes.len() {
            _ if linkage => "(φ)".to_owned(),
            1 => String::new(),
            _ => number.to_string(),
        };
        let letter = if unit.inertia == "kg" { "m" } else { "J" };
        self.text("middle id", middle, -3.0, MASS, &format!("{letter}{name}"));
        self.text("middle", middle, 12.0, MASS - 4.0, &inertia);
        self.out.push_str("</g>");
        self.x += MASS;
        let loads: Vec<&str> = (self.model.loads.iter())
            .filter(|load| self.model.owner_of_load(load) == node)
            .map(|load| load.name.rsplit('.').next().unwrap_or(&load.name))
            .collect();
        if !loads.is_empty() {
            let x = coordinate(middle);
            self.out.push_str(&format!(
                "<path class=\"load\" d=\"M{x} -40v16m-4 -6l4 6l4 -6\"/>"
            ));
            self.text(
                "middle load-name",
                middle,
                -43.0,
                MASS + 30.0,
                &loads.join(", "),
            );
        }
    }
}
