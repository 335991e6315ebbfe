//! Kinematic pairs, and how the groups between them are put together.

use super::names::Names;
use crate::dynamics::model::Coordinate;
use crate::frontend::read::{Bounds, Fields, Slot};
use crate::kinematics::linkage::spec::{
    AssemblyChoice, AssemblySpec, PairKind, PairSpec, PointOf, WeldSpec,
};
use crate::units::quantities as q;
use serde_json::json;

/// Corners of a block of which nothing is said (m).
const CORNERS: (f64, f64) = (0.01, -0.01);

/// Whether a pair turns or slides.
pub(super) fn coordinate(kind: &PairKind) -> Coordinate {
    match kind.slides() {
        true => Coordinate::Sliding,
        false => Coordinate::Turning,
    }
}

/// What joins two links.
enum JoinedLinks {
    Pair(PairSpec),
    Weld(WeldSpec),
}

/// Reads `pairs`, in the order of their names, and the welds among them; `free`: in a run they
/// move freely, as those of a linkage of several inputs without `joint_friction`.
pub(super) fn read(
    fields: &mut Fields<'_>,
    names: &Names,
    free: bool,
) -> Option<(Vec<PairSpec>, Vec<WeldSpec>)> {
    let doc = "The kinematic pairs by name, and the welds.";
    let all = fields.need("pairs", doc, |slot| {
        slot.names(|name, slot| {
            slot.defined("linkage_pair", |slot| read_joined(slot, name, names, free))
        })
    });
    let (mut pairs, mut welds) = (Vec::new(), Vec::new());
    for one in all? {
        match one {
            JoinedLinks::Pair(pair) => pairs.push(pair),
            JoinedLinks::Weld(weld) => welds.push(weld),
        }
    }
    Some((pairs, welds))
}

/// How two links are joined.
enum Kind {
    Pair(PairKind),
    Weld(f64),
}

fn read_joined(slot: Slot<'_>, name: &str, names: &Names, free: bool) -> Option<JoinedLinks> {
    slot.record(|fields| {
        let doc = "Coefficient of Coulomb friction μ; it counts in `dam forces`, and with `joint_friction` in the motion.";
        let friction = fields.or("friction", doc, json!(0.0), |slot| {
            slot.number(Bounds::NOT_NEGATIVE)
        });
        let mut kind = fields.one_of("how it moves");
        kind.case(
            "revolute",
            "A pin: its points on both links. Its coordinate is the angle of the second link less that of the first.",
            |slot| {
                let (on, link) = slot.pair(|slot| names.point(slot), |slot| names.point(slot))?;
                let pin = PairKind::PIN;
                Some((on, link, Kind::Pair(pin)))
            },
        );
        kind.case("sliding", "A block that slides along a guide.", |slot| {
            let (guide, block, kind) = read_sliding(slot, names)?;
            Some((guide, block, Kind::Pair(kind)))
        });
        let doc = "Two links rigidly joined, one body: no pair that moves, and no coordinate. \
                   `dam forces` prints its force and couple.";
        kind.case("weld", doc, |slot| read_weld(slot, names));
        let kind = kind.finish();
        let doc = "Diameter of the pin, for friction; default 0";
        let diameter = fields.maybe("diameter", doc, |slot| {
            slot.quantity(q::LENGTH, Bounds::NOT_NEGATIVE)
        });
        let whole = fits_a_block(fields, friction.unwrap_or(0.0)) && fits_a_weld(fields);
        if free && friction.is_some_and(|friction| friction > 0.0) {
            let message = "this friction counts in `dam forces` alone: in a run the joints are \
                           without friction, unless the linkage has `joint_friction`";
            fields.warn("friction", "no-effect", message);
        }
        let (friction, (on, link, kind), given) = (friction?, kind?, diameter?);
        if on.link == link.link {
            let message = format!("`{name}` joins a link to itself");
            fields.refuse("", "contradiction", message);
            return None;
        }
        whole.then_some(())?;
        let name = name.to_owned();
        let mut kind = match kind {
            Kind::Pair(kind) => kind,
            Kind::Weld(angle) => {
                return Some(JoinedLinks::Weld(WeldSpec {
                    name,
                    on,
                    link,
                    angle,
                }));
            }
        };
        if let PairKind::Revolute { diameter } = &mut kind {
            *diameter = given.unwrap_or(0.0);
        }
        Some(JoinedLinks::Pair(PairSpec {
            name,
            on,
            link,
            kind,
            friction,
        }))
    })
}

/// Reads a weld: its point on both links, and how they are turned.
fn read_weld(slot: Slot<'_>, names: &Names) -> Option<(PointOf, PointOf, Kind)> {
    slot.record(|fields| {
        let doc = "The weld's point on the first link, to which its force and couple refer.";
        let on = fields.need("on", doc, |slot| names.point(slot));
        let doc = "The same point on the second link, on which force and couple act.";
        let link = fields.need("link", doc, |slot| names.point(slot));
        let doc = "Angle of the second link's frame less that of the first";
        let angle = fields.or("angle", doc, json!(0.0), |slot| {
            slot.quantity(q::ANGLE, Bounds::ANY)
        });
        Some((on?, link?, Kind::Weld(angle?)))
    })
}

/// Refuses what a weld has not; true when there is nothing of it.
fn fits_a_weld(fields: &mut Fields<'_>) -> bool {
    let mut fits = true;
    for property in ["friction", "diameter"] {
        if fields.member("weld").is_some() && fields.member(property).is_some() {
            let message = format!("a weld does not move and has no `{property}`");
            fields.refuse(property, "contradiction", message);
            fits = false;
        }
    }
    fits
}

/// Whether what is said of a pair beside its kind is enough for a block, and no more;
/// also told where its guide has faults of its own.
fn fits_a_block(fields: &mut Fields<'_>, friction: f64) -> bool {
    let Some(sliding) = fields.member("sliding") else {
        return true;
    };
    let without_corners = sliding.value.get("corners").is_none();
    let mut fits = true;
    if friction > 0.0 && without_corners {
        let message = "a block with friction needs the places of its two corners";
        let fault = fields.refuse("friction", "missing-property", message);
        let hint = "add \"corners\": [\"20 mm\", \"-20 mm\"] to `sliding`";
        fault.hints.push(hint.to_owned());
        fits = false;
    }
    if fields.member("diameter").is_some() {
        let message = "a sliding pair has no pin and no `diameter`";
        fields.refuse("diameter", "contradiction", message);
        fits = false;
    }
    fits
}

fn read_sliding(slot: Slot<'_>, names: &Names) -> Option<(PointOf, PointOf, PairKind)> {
    slot.record(|fields| {
        let angle = |slot: Slot<'_>| slot.quantity(q::ANGLE, Bounds::ANY);
        let doc = "A point of the guide's axis, on the link that guides.";
        let guide = fields.need("guide", doc, |slot| names.point(slot));
        let doc = "The block's point on the axis, on the link that slides.";
        let block = fields.need("block", doc, |slot| names.point(slot));
        let doc = "Direction of the guide in the frame of its link; default 0";
        let direction = fields.maybe("direction", doc, angle);
        let doc = "In place of `direction`: another point of the guide's axis, towards which it is directed.";
        let through = fields.maybe("through", doc, |slot| names.point(slot));
        let doc = "Angle of the block's frame less the direction of the guide";
        let turned = fields.or("angle", doc, json!(0.0), angle);
        let doc = "Places of the block's two corners along the guide from its point, the forward one first, for reactions and friction; default 10 mm ahead and behind";
        let length = |slot: Slot<'_>| slot.quantity(q::LENGTH, Bounds::ANY);
        let corners = fields.maybe("corners", doc, |slot| slot.pair(length, length));
        let doc = "Half the height of the block";
        let half = fields.or("half_height", doc, json!(0.0), |slot| {
            slot.quantity(q::LENGTH, Bounds::NOT_NEGATIVE)
        });
        let clash = fields.clash("direction", "through", "both give the direction of the guide");
        let ordered = corners.is_none_or(|corners| in_order(fields, corners));
        let (guide, block, through, corners) = (guide?, block?, through?, corners?);
        let direction = match (direction?, through) {
            (given, None) => given.unwrap_or(0.0),
            (_, Some(through)) => read_direction_between(fields, guide, through)?,
        };
        fields.fill_in("direction", json!(direction));
        fields.fill_in("corners", json!(corners.unwrap_or(CORNERS)));
        let (forward, back) = corners.unwrap_or(CORNERS);
        (ordered && !clash).then_some(())?;
        let kind = PairKind::Sliding {
            direction,
            angle: turned?,
            corners: [forward, back],
            half_height: half?,
        };
        Some((guide, block, kind))
    })
}

/// Whether a block's corners, if they are given, carry a couple.
fn in_order(fields: &mut Fields<'_>, corners: Option<(f64, f64)>) -> bool {
    let Some((forward, back)) = corners.filter(|(forward, back)| !(forward > back)) else {
        return true;
    };
    let message = format!("the first corner ({forward} m) must lie before the second ({back} m)");
    fields.refuse("corners", "out-of-range", message);
    false
}

/// Direction from one point of a guide to another one.
fn read_direction_between(fields: &mut Fields<'_>, from: PointOf, to: PointOf) -> Option<f64> {
    if from.link != to.link {
        let message = "`through` must be a point of the same link as `guide`";
        fields.refuse("through", "contradiction", message);
        return None;
    }
    let [x, y] = [to.at[0] - from.at[0], to.at[1] - from.at[1]];
    if x == 0.0 && y == 0.0 {
        fields.refuse(
            "through",
            "contradiction",
            "`through` is the point `guide` itself",
        );
        return None;
    }
    Some(y.atan2(x))
}

/// Reads `assembly`.
pub(super) fn read_assembly(fields: &mut Fields<'_>, names: &Names) -> Option<Vec<AssemblySpec>> {
    let doc =
        "How a group of links is put together, by one of its links: default by its branch `+`.";
    fields.or("assembly", doc, json!({}), |slot| {
        slot.values(|name, mut slot| {
            let link = names.link_named(&mut slot, name);
            let choice = slot.defined("linkage_assembly", |slot| read_choice(slot, name, names));
            Some(AssemblySpec {
                link: link?,
                choice: choice?,
            })
        })
    })
}

fn read_choice(slot: Slot<'_>, link: &str, names: &Names) -> Option<AssemblyChoice> {
    slot.record(|fields| {
        let mut choice = fields.one_of("how it is put together");
        choice.case(
            "branch",
            "Side on which a group of two links lies.",
            |slot| {
                slot.choice(&[("+", 1.0), ("-", -1.0)])
                    .map(AssemblyChoice::Branch)
            },
        );
        choice.case("angle", "Its angle at the start is near this one", |slot| {
            slot.quantity(q::ANGLE, Bounds::ANY)
                .map(AssemblyChoice::Angle)
        });
        choice.case(
            "near",
            "Its point is near this place at the start.",
            |slot| {
                super::links::read_point(slot).map(|place| AssemblyChoice::Near {
                    point: [0.0; 2],
                    place,
                })
            },
        );
        let choice = choice.finish();
        let doc = "The point of `near`; default the origin of the link's frame.";
        let point = fields.maybe("point", doc, |slot| names.own_point(slot, link));
        match (choice?, point?) {
            (AssemblyChoice::Near { place, .. }, Some(point)) => {
                Some(AssemblyChoice::Near { point, place })
            }
            (choice, None) => Some(choice),
            (_, Some(_)) => {
                let message = "`point` goes with `near` only";
                fields.refuse("point", "contradiction", message);
                None
            }
        }
    })
}
