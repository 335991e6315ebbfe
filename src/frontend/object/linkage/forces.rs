//! Gravity, springs, dampers and forces of a linkage.

use super::names::Names;
use super::pairs;
use crate::dynamics::builder::FREE_FALL;
use crate::dynamics::model::Coordinate;
use crate::frontend::object::measures::Measures;
use crate::frontend::read::{Bounds, Fields, QuantityChoice, Slot, read_points};
use crate::kinematics::linkage::spec::{ForceLaw, ForceSpec, PairSpec};
use crate::units::quantities as q;
use serde_json::json;
use std::f64::consts::FRAC_PI_2;

/// Reads `gravity`.
pub(super) fn gravity(fields: &mut Fields<'_>) -> Option<[f64; 2]> {
    let doc = "Weights of the links: false, true (9.80665 m/s², downwards), or acceleration and direction.";
    fields.or("gravity", doc, json!(false), |slot| {
        slot.flag_or(
            |slot| {
                let down = [0.0, -FREE_FALL];
                Some(if slot.flag()? { down } else { [0.0; 2] })
            },
            |slot| slot.record(vector),
        )
    })
}

fn vector(fields: &mut Fields<'_>) -> Option<[f64; 2]> {
    let doc = "Acceleration of free fall";
    let size = fields.or("acceleration", doc, json!(FREE_FALL), |slot| {
        slot.quantity(q::LINEAR_ACCELERATION, Bounds::NOT_NEGATIVE)
    });
    let doc = "Its direction; default downwards, −90 deg";
    let direction = fields.or("direction", doc, json!(-FRAC_PI_2), |slot| {
        slot.quantity(q::ANGLE, Bounds::ANY)
    });
    let (size, direction) = (size?, direction?);
    let (sin, cos) = direction.sin_cos();
    Some([size * cos, size * sin])
}

/// Reads `forces`, in the order of their names.
pub(super) fn read(
    fields: &mut Fields<'_>,
    names: &Names,
    pairs: Option<&[PairSpec]>,
    input: Measures,
) -> Option<Vec<ForceSpec>> {
    let doc = "Springs, dampers and forces by name.";
    fields.or("forces", doc, json!({}), |slot| {
        slot.names(|name, slot| {
            slot.defined("linkage_force", |slot| {
                let law = slot.record(|fields| read_law(fields, names, pairs, input))?;
                Some(ForceSpec {
                    name: name.to_owned(),
                    law,
                })
            })
        })
    })
}

fn read_law(
    fields: &mut Fields<'_>,
    names: &Names,
    pairs: Option<&[PairSpec]>,
    input: Measures,
) -> Option<ForceLaw> {
    let mut law = fields.one_of("its law");
    law.case(
        "strut",
        "A spring, a damper and a constant force between two points; tension pulls them together.",
        |slot| slot.record(|fields| read_strut(fields, names)),
    );
    law.case("force", "A constant force on a point.", |slot| {
        slot.record(|fields| read_force(fields, names))
    });
    law.case(
        "couple",
        "A constant couple on a link, counterclockwise.",
        |slot| slot.record(|fields| read_couple(fields, names)),
    );
    law.case(
        "torsion",
        "A spring and a damper in a revolute pair.",
        |slot| slot.record(|fields| read_torsion(fields, names, pairs)),
    );
    law.case(
        "table",
        "A force on a point along a direction, over the input coordinate.",
        |slot| slot.record(|fields| read_table(fields, names, input)),
    );
    law.case(
        "couple_table",
        "A couple on a link, counterclockwise, over the input coordinate.",
        |slot| slot.record(|fields| read_couple_table(fields, names, input)),
    );
    law.finish()
}

fn read_strut(fields: &mut Fields<'_>, names: &Names) -> Option<ForceLaw> {
    let from = fields.need("from", "One end.", |slot| names.point(slot));
    let to = fields.need("to", "The other end.", |slot| names.point(slot));
    let rate = fields.or("rate", "Rate of the spring", json!(0.0), |slot| {
        slot.quantity(q::LINEAR_STIFFNESS, Bounds::NOT_NEGATIVE)
    });
    let doc = "Length at which the spring has no force";
    let free = fields.or("free_length", doc, json!(0.0), |slot| {
        slot.quantity(q::LENGTH, Bounds::NOT_NEGATIVE)
    });
    let damping = fields.or("damping", "Damping", json!(0.0), |slot| {
        slot.quantity(q::LINEAR_DAMPING, Bounds::NOT_NEGATIVE)
    });
    let doc = "Constant force besides, as of a gas spring or a cylinder: positive pulls the ends \
               together, negative pushes them from each other";
    let force = fields.or("force", doc, json!(0.0), |slot| {
        slot.quantity(q::FORCE, Bounds::ANY)
    });
    let (from, to) = (from?, to?);
    if from.link == to.link {
        let message = "both ends are on one link: the strut has a constant length";
        fields.refuse("", "contradiction", message);
        return None;
    }
    Some(ForceLaw::Strut {
        from,
        to,
        rate: rate?,
        free_length: free?,
        damping: damping?,
        force: force?,
    })
}

fn read_force(fields: &mut Fields<'_>, names: &Names) -> Option<ForceLaw> {
    let point = fields.need("point", "Where it acts.", |slot| names.point(slot));
    let part = |slot: Slot<'_>| slot.quantity(q::FORCE, Bounds::ANY);
    let force = fields.need("force", "The force, [x, y].", |slot| slot.pair(part, part));
    let doc = "True: the force turns with the link; false: its direction is fixed.";
    let follows = fields.or("follows", doc, json!(false), |slot| slot.flag());
    let (x, y) = force?;
    Some(ForceLaw::Force {
        point: point?,
        force: [x, y],
        follows: follows?,
    })
}

fn read_couple(fields: &mut Fields<'_>, names: &Names) -> Option<ForceLaw> {
    let link = fields.need("link", "The link.", |slot| names.link(slot));
    let moment = fields.need("moment", "The couple", |slot| {
        slot.quantity(q::MOMENT, Bounds::ANY)
    });
    Some(ForceLaw::Couple {
        link: link?,
        couple: moment?,
    })
}

fn read_torsion(
    fields: &mut Fields<'_>,
    names: &Names,
    pairs: Option<&[PairSpec]>,
) -> Option<ForceLaw> {
    let pair = fields.need("pair", "The revolute pair.", |slot| names.pair(slot));
    let rate = fields.or("rate", "Rate of the spring", json!(0.0), |slot| {
        slot.quantity(q::ROTATIONAL_STIFFNESS, Bounds::NOT_NEGATIVE)
    });
    let doc = "The pair's angle at which the spring has no moment";
    let free = fields.or("free_angle", doc, json!(0.0), |slot| {
        slot.quantity(q::ANGLE, Bounds::ANY)
    });
    let damping = fields.or("damping", "Damping", json!(0.0), |slot| {
        slot.quantity(q::ROTATIONAL_DAMPING, Bounds::NOT_NEGATIVE)
    });
    let pair = pair?;
    let slides = pairs.is_some_and(|pairs| {
        pairs
            .get(pair)
            .is_some_and(|pair| pairs::coordinate(&pair.kind) == Coordinate::Sliding)
    });
    if slides {
        let fault = fields.refuse("pair", "contradiction", "this pair slides and has no angle");
        let hint = "use a `strut` between a point of the guide and one of the block";
        fault.hints.push(hint.to_owned());
        return None;
    }
    Some(ForceLaw::Torsion {
        pair,
        rate: rate?,
        free_angle: free?,
        damping: damping?,
    })
}

fn read_table(fields: &mut Fields<'_>, names: &Names, input: Measures) -> Option<ForceLaw> {
    let point = fields.need("point", "Where it acts.", |slot| names.point(slot));
    let doc = "Its direction in the frame of the ground";
    let direction = fields.or("direction", doc, json!(0.0), |slot| {
        slot.quantity(q::ANGLE, Bounds::ANY)
    });
    let doc = "List of [input coordinate, force]: linear between the points, constant outside.";
    let (points, period) = read_over_input(fields, doc, q::FORCE.into(), input)?;
    Some(ForceLaw::Table {
        point: point?,
        direction: direction?,
        points,
        period,
    })
}

fn read_couple_table(fields: &mut Fields<'_>, names: &Names, input: Measures) -> Option<ForceLaw> {
    let link = fields.need("link", "The link.", |slot| names.link(slot));
    let doc = "List of [input coordinate, couple]: linear between the points, constant outside.";
    let (points, period) = read_over_input(fields, doc, q::MOMENT.into(), input)?;
    Some(ForceLaw::CoupleTable {
        link: link?,
        points,
        period,
    })
}

/// Points over the input coordinate, and after how much of it they repeat.
type OverInput = (Vec<(f64, f64)>, Option<f64>);

/// Reads a table over the input coordinate.
fn read_over_input(
    fields: &mut Fields<'_>,
    doc: &'static str,
    value: QuantityChoice,
    input: Measures,
) -> Option<OverInput> {
    let list = fields.need("points", doc, |slot| {
        read_points(slot, input.displacement(), value, 1)
    });
    let doc = "Repeats after this much of the input coordinate";
    let period = fields.maybe("period", doc, |slot| {
        slot.quantity(input.displacement(), Bounds::POSITIVE)
    });
    let (list, period) = (list?, period?);
    if let Some(period) = period {
        let length = list[list.len() - 1].0 - list[0].0;
        if length > period * (1.0 + 1e-12) {
            let message = format!("the points span {length}, the period is {period}");
            fields.refuse("period", "out-of-range", message);
            return None;
        }
    }
    Some((list, period))
}
