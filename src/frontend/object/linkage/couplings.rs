//! Gears, belts, racks and cams between the links of a linkage.

use super::cams;
use super::names::Names;
use crate::frontend::read::{Bounds, Fields, Slot};
use crate::kinematics::linkage::couplings::carriers;
use crate::kinematics::linkage::spec::{CouplingKind, CouplingSpec, PairSpec};
use crate::units::Quantity;
use crate::units::quantities as q;
use serde_json::json;

/// Greatest number of teeth.
const MOST_TEETH: u64 = 10_000;

/// Two links, `None` being the ground.
type Wheels = [Option<usize>; 2];

/// What every coupling of wheels has.
struct CouplingFields {
    wheels: Wheels,
    carrier: Option<usize>,
    offset: f64,
}

/// What couplings are read with: the names, and the pairs where they are without fault.
#[derive(Clone, Copy)]
struct CouplingContext<'a> {
    names: &'a Names,
    pairs: Option<&'a [PairSpec]>,
}

/// Reads `couplings`, in the order of their names.
pub(super) fn read(
    fields: &mut Fields<'_>,
    names: &Names,
    pairs: Option<&[PairSpec]>,
) -> Option<Vec<CouplingSpec>> {
    let known = CouplingContext { names, pairs };
    let doc = "Gears, belts and racks by name, each between two links (or a link and the ground) that a third one carries; and cams, each between two links.";
    fields.or("couplings", doc, json!({}), |slot| {
        slot.names(|name, slot| {
            slot.defined("linkage_coupling", |slot| coupling(slot, name, known))
        })
    })
}

fn coupling(slot: Slot<'_>, name: &str, known: CouplingContext<'_>) -> Option<CouplingSpec> {
    slot.record(|fields| {
        let mut kind = fields.one_of("what couples the links");
        let doc = "Two gears: seen from their carrier they turn as their numbers of teeth say.";
        kind.case("gear", doc, |slot| gear(slot, known).map(wheels));
        let doc = "A belt or chain over two pulleys.";
        kind.case("belt", doc, |slot| belt(slot, known).map(wheels));
        let doc = "A gear and a rack, which a guide joins to their carrier.";
        kind.case("rack", doc, |slot| rack(slot, known).map(wheels));
        let doc = "A cam of one link on which a roller or a point of another one runs.";
        kind.case("cam", doc, |slot| cams::read(slot, known.names));
        let coupling = kind.finish()?;
        Some(CouplingSpec {
            name: name.to_owned(),
            ..coupling
        })
    })
}

/// A coupling of wheels, its name left open.
fn wheels((coupled, kind): (CouplingFields, CouplingKind)) -> CouplingSpec {
    CouplingSpec {
        name: String::new(),
        wheels: coupled.wheels,
        carrier: coupled.carrier,
        kind,
        offset: coupled.offset,
    }
}

fn gear(slot: Slot<'_>, known: CouplingContext<'_>) -> Option<(CouplingFields, CouplingKind)> {
    slot.record(|fields| {
        let coupled = coupled(fields, known, q::ANGLE);
        let mut sizes = fields.one_of("the sizes of the gears");
        let doc = "Numbers of teeth of the first and the second gear.";
        sizes.case("teeth", doc, |slot| {
            let teeth = |slot: Slot<'_>| slot.count(1..=MOST_TEETH);
            let (one, other) = slot.pair(teeth, teeth)?;
            Some([one as f64, other as f64])
        });
        let doc = "In place of `teeth`: diameters of the pitch circles; their ratio counts.";
        sizes.case("diameters", doc, diameters);
        let sizes = sizes.finish();
        let doc = "True: one of them has internal teeth, and both turn the same way.";
        let internal = fields.or("internal", doc, json!(false), |slot| slot.flag());
        let ([one, other], internal) = (sizes?, internal?);
        let sense = if internal { 1.0 } else { -1.0 };
        let ratio = sense * one / other;
        Some((coupled?, CouplingKind::Gear { ratio }))
    })
}

fn belt(slot: Slot<'_>, known: CouplingContext<'_>) -> Option<(CouplingFields, CouplingKind)> {
    slot.record(|fields| {
        let coupled = coupled(fields, known, q::ANGLE);
        let doc = "Diameters of the first and the second pulley.";
        let sizes = fields.need("diameters", doc, diameters);
        let doc = "True: the belt is crossed, and the pulleys turn against each other.";
        let crossed = fields.or("crossed", doc, json!(false), |slot| slot.flag());
        let ([one, other], crossed) = (sizes?, crossed?);
        let sense = if crossed { -1.0 } else { 1.0 };
        let radii = [0.5 * one, sense * 0.5 * other];
        Some((coupled?, CouplingKind::Belt { radii }))
    })
}

fn rack(slot: Slot<'_>, known: CouplingContext<'_>) -> Option<(CouplingFields, CouplingKind)> {
    slot.record(|fields| {
        let coupled = coupled(fields, known, q::LENGTH);
        let doc = "Radius of the gear's pitch circle; positive: the rack lies to the right of the gear, seen along its guide, and slides forwards as the gear turns counterclockwise.";
        let radius = fields.need("radius", doc, |slot| {
            slot.quantity(q::LENGTH, Bounds::NOT_ZERO)
        });
        let radius = radius?;
        Some((coupled?, CouplingKind::Rack { radius }))
    })
}

/// Reads what every coupling has; `offset` is a length where the second link is a rack.
fn coupled(
    fields: &mut Fields<'_>,
    known: CouplingContext<'_>,
    offset: Quantity,
) -> Option<CouplingFields> {
    let names = known.names;
    let doc =
        "The two links, with the wheels or the gear and its rack; `ground` for what stands still.";
    let wheels = fields.need("wheels", doc, |slot| {
        let link = |slot: Slot<'_>| names.link_or_ground(slot);
        let (one, other) = slot.pair(link, link)?;
        Some([one, other])
    });
    let doc = "The link that carries both, or `ground`; default the only one that does.";
    let carrier = fields.maybe("carrier", doc, |slot| names.link_or_ground(slot));
    let doc = "Angle of the second wheel (or displacement of the rack) seen from the carrier where that of the first is zero: how they were put together";
    let rack = offset == q::LENGTH;
    let offset = fields.or("offset", doc, json!(0.0), |slot| {
        slot.quantity(offset, Bounds::ANY)
    });
    let (wheels, carrier, offset) = (wheels?, carrier?, offset?);
    let carrier = match carrier {
        Some(given) => given,
        None => the_carrier(fields, known, wheels, rack)?,
    };
    fields.fill_in("carrier", json!(names.of_link(carrier)));
    Some(CouplingFields {
        wheels,
        carrier,
        offset,
    })
}

/// The only link that can carry both wheels.
fn the_carrier(
    fields: &mut Fields<'_>,
    known: CouplingContext<'_>,
    wheels: Wheels,
    rack: bool,
) -> Option<Option<usize>> {
    let names = known.names;
    let [one, other] = wheels.map(|wheel| names.of_link(wheel));
    let found = match one == other {
        true => Vec::new(),
        false => carriers(names.links(), known.pairs?, wheels, rack),
    };
    let (message, hint) = match found.as_slice() {
        [carrier] => return Some(*carrier),
        [] if one == other => (
            format!("`{one}` stands in it twice"),
            "name two links".to_owned(),
        ),
        [] if rack => (
            format!("no link has a pin for the gear `{one}` and a guide for the rack `{other}`"),
            "join the gear to one link (or to the ground) by a pin, and the rack to it by a guide"
                .to_owned(),
        ),
        [] => (
            format!("no link carries both `{one}` and `{other}`"),
            "join both to one link (or to the ground) by pins".to_owned(),
        ),
        several => {
            let several: Vec<String> = several
                .iter()
                .map(|&carrier| format!("\"carrier\": \"{}\"", names.of_link(carrier)))
                .collect();
            (
                format!("`{one}` and `{other}` have more than one link in common"),
                format!("say which carries them: {}", several.join(" or ")),
            )
        }
    };
    let fault = fields.refuse("wheels", "contradiction", message);
    fault.hints.push(hint);
    None
}

fn diameters(slot: Slot<'_>) -> Option<[f64; 2]> {
    let diameter = |slot: Slot<'_>| slot.quantity(q::LENGTH, Bounds::POSITIVE);
    let (one, other) = slot.pair(diameter, diameter)?;
    Some([one, other])
}
