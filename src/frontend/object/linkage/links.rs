//! The ground and the links: points, mass, centre of mass, moment of inertia.

use super::names::{GROUND, Names, ORIGIN};
use crate::frontend::read::{Bounds, Fields, Slot};
use crate::kinematics::linkage::spec::{LinkSpec, NamedPoint};
use crate::units::quantities as q;
use serde_json::json;

/// Reads `[x, y]`.
pub(super) fn read_point(slot: Slot<'_>) -> Option<[f64; 2]> {
    let length = |slot: Slot<'_>| slot.quantity(q::LENGTH, Bounds::ANY);
    let (x, y) = slot.pair(length, length)?;
    Some([x, y])
}

fn read_points(slot: Slot<'_>) -> Option<Vec<NamedPoint>> {
    slot.names(|name, mut slot| {
        if name == ORIGIN {
            let owner = slot.name_place();
            let message = "`origin` is the origin of the frame and cannot be given";
            slot.refuse("bad-id", message).place = Some(owner);
            return None;
        }
        let name = name.to_owned();
        read_point(slot).map(|at| NamedPoint { name, at })
    })
}

/// Reads `ground` and `links`; fills their coordinates in among the names.
pub(super) fn read(
    fields: &mut Fields<'_>,
    names: &mut Names,
) -> Option<(Vec<NamedPoint>, Vec<LinkSpec>)> {
    let ground = fields.or(
        "ground",
        "Points of the ground by name, each [x, y].",
        json!({}),
        read_points,
    );
    let links = fields.need("links", "The moving links by name.", |slot| {
        slot.names(|name, mut slot| {
            if name == GROUND {
                let place = slot.name_place();
                let message = "`ground` is no moving link";
                slot.refuse("bad-id", message).place = Some(place);
                return None;
            }
            slot.defined("linkage_link", |slot| read_link(slot, name))
        })
    });
    names.fill_in(
        ground.as_deref().unwrap_or_default(),
        links.as_deref().unwrap_or_default(),
    );
    Some((ground?, links?))
}

fn read_link(slot: Slot<'_>, name: &str) -> Option<LinkSpec> {
    slot.record(|fields| {
        let doc = "Points by name, each [x, y] in the frame of the link; `origin` is always there.";
        let points = fields.or("points", doc, json!({}), read_points);
        let known = points.as_deref().map(with_origin);
        let mass = fields.maybe("mass", "Mass; default 0", |slot| {
            slot.quantity(q::MASS, Bounds::NOT_NEGATIVE)
        });
        let doc = "Centre of mass: [x, y] in the frame of the link, or the name of a point; default its origin.";
        let centre = fields.maybe("centre", doc, |slot| {
            slot.text_or(|slot| one_of(slot, name, known.as_deref()), read_point)
        });
        let doc = "Moment of inertia about the centre of mass; default 0";
        fields.synonym("moment", "moment_of_inertia");
        let moment = fields.maybe("moment", doc, |slot| {
            slot.quantity(q::INERTIA, Bounds::NOT_NEGATIVE)
        });
        let doc = "A uniform bar between two points, in place of `mass`, `centre` and `moment`.";
        let bar = fields.maybe("geometry", doc, |slot| read_bar(slot, name, known.as_deref()));
        let mut clash = false;
        for given in ["mass", "centre", "moment"] {
            clash |= fields.clash("geometry", given, "they give the same parameter in two ways");
        }
        let (mass, centre, moment, bar) = (mass?, centre?, moment?, bar?);
        let body = bar.unwrap_or(Body {
            mass: mass.unwrap_or(0.0),
            centre: centre.unwrap_or([0.0; 2]),
            moment: moment.unwrap_or(0.0),
        });
        fields.fill_in("mass", json!(body.mass));
        fields.fill_in("centre", json!(body.centre));
        fields.fill_in("moment", json!(body.moment));
        (!clash).then_some(())?;
        Some(LinkSpec {
            name: name.to_owned(),
            points: points?,
            mass: body.mass,
            centre: body.centre,
            moment: body.moment,
        })
    })
}

/// Mass, centre of mass and moment of inertia about it.
struct Body {
    mass: f64,
    centre: [f64; 2],
    moment: f64,
}

/// The points that a link has, in the order of their names.
fn with_origin(points: &[NamedPoint]) -> Vec<NamedPoint> {
    let mut all = points.to_vec();
    all.push(NamedPoint {
        name: ORIGIN.to_owned(),
        at: [0.0; 2],
    });
    all.sort_by_cached_key(|point| point.name.clone());
    all
}

/// Reads the name of one of the points; `known` is `None` when they are faulty.
fn one_of(mut slot: Slot<'_>, link: &str, known: Option<&[NamedPoint]>) -> Option<[f64; 2]> {
    let name = slot.read_in_place(|slot| slot.text())?;
    let known = known?;
    if let Some(point) = known.iter().find(|point| point.name == name) {
        return Some(point.at);
    }
    let names = || known.iter().map(|point| point.name.as_str());
    let hint = crate::frontend::read::did_you_mean(&name, names()).unwrap_or_else(|| {
        format!(
            "there are {}",
            crate::frontend::read::quoted_list(names(), "and")
        )
    });
    slot.refuse("unknown-part", format!("`{link}` has no point `{name}`"))
        .hints
        .push(hint);
    None
}

/// m = ρ·w·h·L, in the middle, with m·(L² + h²)/12: a uniform bar of rectangular
/// section between two points.
fn read_bar(slot: Slot<'_>, link: &str, known: Option<&[NamedPoint]>) -> Option<Body> {
    slot.record(|fields| {
        let end = |slot: Slot<'_>| one_of(slot, link, known);
        let doc = "Point at which the bar begins; both ends may be left out when the link has two points, or one besides its origin.";
        let from = fields.maybe("from", doc, end);
        let to = fields.maybe("to", "Point at which it ends.", end);
        let length = |slot: Slot<'_>| slot.quantity(q::LENGTH, Bounds::POSITIVE);
        let doc = "Height of the section, in the plane of motion; default 0: a slender bar";
        let height = fields.maybe("height", doc, length);
        let width = fields.maybe("width", "Width of the section, with `density`", length);
        let mut weight = fields.one_of("its mass");
        weight.case("mass", "Mass of the whole bar", |slot| {
            let mass = slot.quantity(q::MASS, Bounds::POSITIVE)?;
            Some((mass, false))
        });
        weight.case(
            "density",
            "Density of the material, with `width` and `height`",
            |slot| {
                let density = slot.quantity(q::DENSITY, Bounds::POSITIVE)?;
                Some((density, true))
            },
        );
        let weight = weight.finish();
        let known = known?;
        let mut own = known.iter().filter(|point| point.name != ORIGIN);
        let (from, to) = match (from?, to?, own.next(), own.next(), own.next()) {
            (Some(from), Some(to), ..) => (from, to),
            (None, None, Some(one), Some(other), None) => (one.at, other.at),
            (None, None, Some(one), None, None) => ([0.0; 2], one.at),
            _ => {
                let message = "the bar does not say between which points it lies";
                fields
                    .refuse("", "missing-property", message)
                    .hints
                    .push("give both `from` and `to`".to_owned());
                return None;
            }
        };
        let span = (to[0] - from[0]).hypot(to[1] - from[1]);
        if !(span > 0.0) {
            fields.refuse("", "out-of-range", "the ends of the bar are one point");
            return None;
        }
        let (height, width, weight) = (height?, width?, weight?);
        let mass = match (weight, width, height) {
            ((mass, false), None, _) => mass,
            ((_, false), Some(_), _) => {
                let message = "`width` belongs to `density`, not to `mass`";
                fields.refuse("width", "contradiction", message);
                return None;
            }
            ((density, true), Some(width), Some(height)) => density * width * height * span,
            ((_, true), ..) => {
                let message = "`density` needs `width` and `height`";
                fields.refuse("density", "missing-property", message);
                return None;
            }
        };
        let height = height.unwrap_or(0.0);
        Some(Body {
            mass,
            centre: [0.5 * (from[0] + to[0]), 0.5 * (from[1] + to[1])],
            moment: mass * (span * span + height * height) / 12.0,
        })
    })
}
