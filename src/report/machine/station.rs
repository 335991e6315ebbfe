//! One object of the machine: its picture, its moving parts, its readings.

use super::Machine;
use super::object_path::{Grip, ObjectPath, Picture, TURNS};
use super::{cams, linkages};
use crate::dynamics::model::{Coordinate, ObjectPart};
use crate::dynamics::record::{Column, Quantity, Record};
use crate::report::html::player::{Body, PartDisplacement};
use crate::report::mechanism::marks::turning_arrow;
use crate::report::plot::coordinate;
use crate::report::quantity::{escape, readable_scale, with_unit};
use std::f64::consts::TAU;
use std::fmt::Write as _;

/// Size of a diagram (pixels).
const WIDTH: f64 = 210.0;
const HEIGHT: f64 = 206.0;
/// Length of a lever and radius of a wheel (pixels).
const LEVER: f64 = 76.0;
const WHEEL: f64 = 56.0;
/// Travel of a slide on the picture (pixels), and half the size of its block.
const TRAVEL: f64 = 120.0;
const BLOCK: [f64; 2] = [19.0, 14.0];
/// Height of a line of a caption (pixels).
pub(super) const LINE: f64 = 17.0;

/// Station: an object with its picture.
#[derive(Clone, Debug)]
pub(super) struct Station {
    /// Id of the object.
    pub(super) id: String,
    kind: String,
    /// The picture with its moving parts, in the order of their numbers.
    pub(super) picture: Picture,
    /// Number of the object among those that are drawn, and of its coordinate.
    pub(super) column: usize,
    coordinate: Coordinate,
}

impl Station {
    /// The pictures of one of the objects that are drawn, whose coordinates are
    /// numbered in their order: what its geometry is, and where that does not show its
    /// deflection, a diagram. None where it has no samples. What is to scale has at most so many
    /// pixels a metre.
    pub(super) fn of(
        machine: &Machine<'_>,
        record: &Record,
        (column, most): (usize, f64),
        drawn: &[&ObjectPart],
    ) -> Vec<Self> {
        let part = drawn[column];
        let way =
            |part: &ObjectPart| ObjectPath::of(record.column(&part.id, Quantity::Displacement)?);
        let Some(own) = way(part) else {
            return Vec::new();
        };
        let elastic = !part.links.is_empty();
        let driver = part.driver().and_then(|driver| {
            let id = &machine.model.objects[driver].id;
            drawn.iter().position(|one| one.id == *id)
        });
        let cam = |driver: usize| {
            let turned = way(drawn[driver])?;
            cams::picture(
                machine,
                part,
                &own,
                (&drawn[driver].id, &turned),
                ([driver, column], elastic, most),
            )
        };
        let behind =
            driver.and_then(|driver| Some((drawn[driver].id.as_str(), way(drawn[driver])?)));
        let behind = behind
            .as_ref()
            .map(|(id, path)| (*id, path.forward == own.forward));
        let geometry = linkages::picture(machine.model, part, (&own, behind), (column, most))
            .or_else(|| linkages::multi_input_picture(machine.model, part, record, most))
            .or_else(|| cam(driver?));
        let law = || {
            let behind = (drawn[driver?].id.as_str(), way(drawn[driver?])?);
            linkages::law(machine.model, part, (behind.0, &behind.1), (driver?, most))
        };
        let diagram = || match part.coordinate {
            Coordinate::Turning => turning(&part.id, &own, column, elastic),
            Coordinate::Sliding => sliding(&part.id, &own, column, elastic),
        };
        let kind = part.kind.replace('_', " ");
        let own_kind = |picture: Picture| (kind.clone(), picture);
        let its_law = |picture: Picture| (format!("the law of the {kind}"), picture);
        let pictures: Vec<(String, Picture)> = match (geometry, elastic) {
            (Some(picture), _) => vec![own_kind(picture)],
            (None, true) => law()
                .map(its_law)
                .into_iter()
                .chain([own_kind(diagram())])
                .collect(),
            (None, false) => vec![own_kind(law().unwrap_or_else(diagram))],
        };
        let station = |(kind, picture): (String, Picture)| Self {
            id: part.id.clone(),
            kind,
            picture,
            column,
            coordinate: part.coordinate,
        };
        pictures.into_iter().map(station).collect()
    }

    /// Its name and what it shows of its coordinate, as lines from a pixel on; `delta` is the
    /// greatest deflection.
    pub(super) fn caption(&self, [x, y]: [f64; 2], delta: f64) -> String {
        let (unit, factor, si) = match self.coordinate {
            Coordinate::Turning => ("deg", 1f64.to_degrees(), "rad"),
            Coordinate::Sliding => ("mm", 1e3, "m"),
        };
        let small = readable_scale(delta, si);
        let id = escape(&self.id);
        let [x, y, below] = [x, y, y + LINE].map(coordinate);
        format!(
            "<text class=\"name\" x=\"{x}\" y=\"{y}\"><a href=\"#object-{id}\">{id}</a> <tspan \
             class=\"kind\">{}</tspan></text><text class=\"note\" x=\"{x}\" y=\"{below}\" \
             data-column=\"{}\" data-unit=\"{unit}\" data-scale=\"{factor}\" data-delta-unit=\"{}\" \
             data-delta-scale=\"{}\"></text>\n",
            escape(&self.kind),
            self.column,
            escape(&small.unit),
            1.0 / small.factor
        )
    }
}

impl ObjectPath {
    fn of(column: &Column) -> Option<Self> {
        let finite = || {
            column
                .values
                .iter()
                .copied()
                .filter(|value| value.is_finite())
        };
        let start = finite().next()?;
        let least = finite().fold(start, f64::min);
        let greatest = finite().fold(start, f64::max);
        let last = finite().next_back().unwrap_or(start);
        Some(Self {
            start,
            range: [least, greatest],
            forward: last >= start,
            one_way: {
                let values: Vec<f64> = finite().collect();
                let mut steps = values.windows(2).map(|pair| pair[1] - pair[0]);
                steps.all(|step| step == 0.0 || (step > 0.0) == (last >= start))
            },
        })
    }

    pub(super) fn travel(&self) -> f64 {
        self.range[1] - self.range[0]
    }

    fn middle(&self) -> f64 {
        0.5 * (self.range[0] + self.range[1])
    }
}

/// The displacements that an object's bodies show: on its law and magnified for an
/// elastic one.
pub(super) fn displacements(elastic: bool) -> &'static [PartDisplacement] {
    match elastic {
        true => &[PartDisplacement::Law, PartDisplacement::Magnified],
        false => &[PartDisplacement::True],
    }
}

/// Opens a part; `number` counts within its picture.
pub(super) fn open_part(number: usize, shown: PartDisplacement, pose: [f64; 4]) -> String {
    let [x, y, c, s] = pose;
    let class = if shown == PartDisplacement::Law {
        " law"
    } else {
        ""
    };
    format!(
        "<g class=\"link l{}{class}\" data-link=\"{number}\" transform=\"matrix({c:.6} {:.6} {s:.6} {c:.6} {x:.2} {y:.2})\">",
        if shown == PartDisplacement::Law { 7 } else { 0 },
        -s
    )
}

/// A wheel where it makes a turn or more, else a lever of unit length.
fn turning(id: &str, way: &ObjectPath, column: usize, elastic: bool) -> Picture {
    let revolves = way.travel() > 0.98 * TAU;
    let centre = [0.5 * WIDTH, 0.5 * HEIGHT];
    // A lever swings about a horizontal place.
    let offset = if revolves { 0.0 } else { -way.middle() };
    let radius = if revolves { WHEEL } else { LEVER };
    let mut out = Picture {
        size: [WIDTH, HEIGHT],
        pixels: radius,
        inlets: vec![centre],
        outlet: centre,
        ..Picture::default()
    };
    if !revolves {
        out.drawn.push_str(&arc(way, centre));
    }
    out.drawn.push_str(&support(centre));
    for (number, &shown) in displacements(elastic).iter().enumerate() {
        let (sin, cos) = (way.start + offset).sin_cos();
        out.drawn
            .push_str(&open_part(number, shown, [centre[0], centre[1], cos, sin]));
        out.drawn.push_str(&match revolves {
            true => wheel(shown),
            false => lever(shown),
        });
        out.drawn.push_str("</g>\n");
        out.bodies.push(Body::Turn {
            column,
            at: centre,
            sense: 1.0,
            offset,
            shown,
        });
    }
    let grip = Grip {
        part: displacements(elastic).len() - 1,
        at: [radius, 0.0],
        along: [0.0, -1.0],
        fixed: false,
    };
    out.grips.push((id.to_owned(), grip));
    if revolves || (way.one_way && way.travel() > TURNS) {
        out.drawn
            .push_str(&turning_arrow(centre, WHEEL + 9.0, way.forward));
    }
    let [x, y] = centre.map(coordinate);
    let _ = writeln!(
        out.drawn,
        "<g class=\"pin\"><circle cx=\"{x}\" cy=\"{y}\" r=\"4.2\"/></g>"
    );
    out
}

fn wheel(shown: PartDisplacement) -> String {
    let r = coordinate(WHEEL);
    let disc = match shown {
        PartDisplacement::Law => "",
        _ => "<circle class=\"edge\" r=\"RADIUS\"/>",
    };
    format!(
        "{}<path class=\"body\" stroke-width=\"9\" d=\"M0 0H{r}\"/><path class=\"edge\" d=\"M0 0H{r}\"/>",
        disc.replace("RADIUS", &r)
    )
}

fn lever(shown: PartDisplacement) -> String {
    let r = coordinate(LEVER);
    let width = if shown == PartDisplacement::Law {
        8
    } else {
        12
    };
    format!(
        "<path class=\"body\" stroke-width=\"{width}\" d=\"M0 0H{r}\"/><path class=\"edge\" d=\"M0 0H{r}\"/>"
    )
}

/// The ground under a pivot.
fn support([x, y]: [f64; 2]) -> String {
    let (x, y) = (coordinate(x), coordinate(y));
    format!("<g class=\"ground\"><path d=\"M{x} {y}l-11 17h22z\"/></g>\n")
}

/// The swing of a lever: a thin arc with the angle.
fn arc(way: &ObjectPath, [x, y]: [f64; 2]) -> String {
    let r = LEVER + 8.0;
    let half = 0.5 * way.travel();
    if !(half > 0.0) {
        return String::new();
    }
    let end = |angle: f64| [x + r * angle.cos(), y - r * angle.sin()].map(coordinate);
    let ([x0, y0], [x1, y1]) = (end(-half), end(half));
    let large = u8::from(half > 0.25 * TAU);
    format!(
        "<g class=\"ground\"><path class=\"swing\" d=\"M{x0} {y0}A{r} {r} 0 {large} 0 {x1} {y1}\"/></g>\n\
         <text class=\"note\" x=\"6\" y=\"{}\">swing {}</text>\n",
        coordinate(HEIGHT - 8.0),
        escape(&with_unit(way.travel().to_degrees(), "deg", 4)),
        r = coordinate(r)
    )
}

/// A block on its guide.
fn sliding(id: &str, way: &ObjectPath, column: usize, elastic: bool) -> Picture {
    let grip = Grip {
        part: displacements(elastic).len() - 1,
        at: [0.0, 0.0],
        along: [1.0, 0.0],
        fixed: false,
    };
    let travel = way.travel();
    let scale = if travel > 0.0 { TRAVEL / travel } else { 0.0 };
    let (middle, y) = (0.5 * WIDTH, 0.5 * HEIGHT);
    let at = [middle - scale * way.middle(), y];
    let mut out = Picture {
        size: [WIDTH, HEIGHT],
        pixels: scale,
        grips: vec![(id.to_owned(), grip)],
        inlets: vec![[middle - 0.5 * TRAVEL, y]],
        outlet: [middle + 0.5 * TRAVEL, y],
        drawn: guide([middle, y]),
        ..Picture::default()
    };
    for (number, &shown) in displacements(elastic).iter().enumerate() {
        let place = [at[0] + scale * way.start, y, 1.0, 0.0];
        out.drawn.push_str(&open_part(number, shown, place));
        let [w, h] = BLOCK;
        let _ = write!(
            out.drawn,
            "<rect class=\"block\" x=\"{}\" y=\"{}\" width=\"{}\" height=\"{}\"/></g>",
            -w,
            -h,
            2.0 * w,
            2.0 * h
        );
        out.bodies.push(Body::Slide {
            column,
            at,
            by: [scale, 0.0],
            shown,
        });
    }
    let _ = writeln!(
        out.drawn,
        "<text class=\"note\" x=\"6\" y=\"{}\">travel {}</text>",
        coordinate(HEIGHT - 8.0),
        escape(&with_unit(travel, "m", 4))
    );
    out
}

/// Two rails as far as the block goes.
fn guide([x, y]: [f64; 2]) -> String {
    let half = 0.5 * TRAVEL + BLOCK[0] + 4.0;
    let mut out = String::from("<g class=\"guide\">");
    for side in [-1.0, 1.0] {
        let rail = y + side * (BLOCK[1] + 2.0);
        let _ = write!(
            out,
            "<path d=\"M{} {}h{}\"/>",
            coordinate(x - half),
            coordinate(rail),
            coordinate(2.0 * half)
        );
        let hatches = (2.0 * half / 9.0) as usize;
        for hatch in 0..hatches {
            let _ = write!(
                out,
                "<path class=\"hatch\" d=\"M{} {}l-5 {}\"/>",
                coordinate(x - half + 7.0 + 9.0 * hatch as f64),
                coordinate(rail),
                coordinate(side * 6.0)
            );
        }
    }
    out.push_str("</g>\n");
    out
}
