//! The couplings between the links of a linkage: each kind says what is read of it.

use super::super::cam_geometry::{SENSES, SURFACES};
use super::super::measures::{Measures, PositionMeasures};
use super::super::position;
use super::names::Names;
use crate::dynamics::model::Coordinate::{Sliding, Turning};
use crate::frontend::read::{Bounds, Fields, Slot};
use crate::kinematics::cam::Surface;
use crate::kinematics::linkage::joints::{
    COUPLINGS, CarriedLinks, DECLARATIONS, Declaration, Domain, JointReader, MissingCarrier,
    OFFSET, Sizes, WHEELS, carriers,
};
use crate::kinematics::linkage::spec::{CouplingSpec, PairSpec, PointOf};
use crate::kinematics::position::PositionSpec;
use crate::units::quantities as q;
use serde_json::json;

/// Greatest number of teeth.
const MOST_TEETH: u64 = 10_000;

/// Laws of a lift that can repeat after a turn.
const LAWS: [&str; 4] = ["sine", "table", "cam", "plan"];

/// Two links, `None` being the ground.
type Wheels = [Option<usize>; 2];

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
    fields.or("couplings", COUPLINGS, json!({}), |slot| {
        slot.names(|name, slot| {
            slot.defined("linkage_coupling", |slot| read_coupling(slot, name, known))
        })
    })
}

fn read_coupling(slot: Slot<'_>, name: &str, known: CouplingContext<'_>) -> Option<CouplingSpec> {
    slot.record(|fields| {
        let mut kind = fields.one_of("what couples the links");
        for declared in DECLARATIONS {
            kind.case(declared.key, declared.doc, |slot| {
                of_kind(slot, declared, known)
            });
        }
        let coupling = kind.finish()?;
        Some(CouplingSpec {
            name: name.to_owned(),
            ..coupling
        })
    })
}

fn of_kind(
    slot: Slot<'_>,
    declared: &Declaration,
    known: CouplingContext<'_>,
) -> Option<CouplingSpec> {
    slot.record(|fields| (declared.read)(&mut CouplingReader { fields, known }))
}

/// The properties of a coupling while it is read.
struct CouplingReader<'r, 'f, 'k> {
    fields: &'r mut Fields<'f>,
    known: CouplingContext<'k>,
}

impl JointReader for CouplingReader<'_, '_, '_> {
    fn carried(&mut self, slides: bool, lacks: &MissingCarrier) -> Option<CarriedLinks> {
        let (fields, names) = (&mut *self.fields, self.known.names);
        let wheels = fields.need("wheels", WHEELS, |slot| {
            let link = |slot: Slot<'_>| names.link_or_ground(slot);
            let (one, other) = slot.pair(link, link)?;
            Some([one, other])
        });
        let doc = "The link that carries both, or `ground`; default the only one that does.";
        let carrier = fields.maybe("carrier", doc, |slot| names.link_or_ground(slot));
        let offset = fields.or("offset", OFFSET, json!(0.0), |slot| {
            slot.quantity(if slides { q::LENGTH } else { q::ANGLE }, Bounds::ANY)
        });
        let (wheels, carrier, offset) = (wheels?, carrier?, offset?);
        let carrier = match carrier {
            Some(given) => given,
            None => read_the_carrier(fields, self.known, wheels, slides, lacks)?,
        };
        fields.fill_in("carrier", json!(names.of_link(carrier)));
        Some(CarriedLinks {
            wheels,
            carrier,
            offset,
        })
    }

    fn sizes(&mut self, key: &'static str, doc: &str, sizes: Sizes) -> Option<[f64; 2]> {
        self.fields.need(key, doc, |slot| two(slot, sizes))
    }

    fn sizes_as_written(
        &mut self,
        what: &'static str,
        ways: &[(&'static str, &str, Sizes)],
    ) -> Option<[f64; 2]> {
        let mut all = self.fields.one_of(what);
        for &(key, doc, sizes) in ways {
            all.case(key, doc, |slot| two(slot, sizes));
        }
        all.finish()
    }

    fn flag(&mut self, key: &'static str, doc: &str) -> Option<bool> {
        self.fields.or(key, doc, json!(false), |slot| slot.flag())
    }

    fn point(&mut self, key: &'static str, doc: &str) -> Option<PointOf> {
        let names = self.known.names;
        self.fields.need(key, doc, |slot| names.point(slot))
    }

    fn length(
        &mut self,
        key: &'static str,
        doc: &str,
        domain: Domain,
        usual: Option<f64>,
    ) -> Option<f64> {
        let bounds = match domain {
            Domain::Positive => Bounds::POSITIVE,
            Domain::NotNegative => Bounds::NOT_NEGATIVE,
            Domain::NotZero => Bounds::NOT_ZERO,
        };
        let read = |slot: Slot<'_>| slot.quantity(q::LENGTH, bounds);
        match usual {
            Some(usual) => self.fields.or(key, doc, json!(usual), read),
            None => self.fields.need(key, doc, read),
        }
    }

    fn angle(&mut self, key: &'static str, doc: &str) -> Option<f64> {
        let read = |slot: Slot<'_>| slot.quantity(q::ANGLE, Bounds::ANY);
        self.fields.or(key, doc, json!(0.0), read)
    }

    fn sense(&mut self, key: &'static str, doc: &str) -> Option<f64> {
        let read = |slot: Slot<'_>| slot.choice(&SENSES);
        self.fields.or(key, doc, json!("counterclockwise"), read)
    }

    fn surface(&mut self, key: &'static str, doc: &str) -> Option<Surface> {
        let read = |slot: Slot<'_>| slot.choice(&SURFACES);
        self.fields.or(key, doc, json!("disc"), read)
    }

    fn lift(&mut self, key: &'static str, doc: &str) -> Option<Option<PositionSpec>> {
        let ends = PositionMeasures {
            output: Measures(Some(Sliding)),
            driver: Measures(Some(Turning)),
        };
        let read = |slot: Slot<'_>| position::read(slot, ends, &LAWS);
        self.fields.maybe(key, doc, read)
    }
}

/// The only link that can carry both wheels.
fn read_the_carrier(
    fields: &mut Fields<'_>,
    known: CouplingContext<'_>,
    wheels: Wheels,
    slides: bool,
    lacks: &MissingCarrier,
) -> Option<Option<usize>> {
    let names = known.names;
    let [one, other] = wheels.map(|wheel| names.of_link(wheel));
    let found = match one == other {
        true => Vec::new(),
        false => carriers(names.links(), known.pairs?, wheels, slides),
    };
    let (message, hint) = match found.as_slice() {
        [carrier] => return Some(*carrier),
        [] if one == other => (
            format!("`{one}` occurs in it twice"),
            "name two links".to_owned(),
        ),
        [] => {
            let message = lacks
                .message
                .replace("{one}", one)
                .replace("{other}", other);
            (message, lacks.hint.to_owned())
        }
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

/// Two sizes.
fn two(slot: Slot<'_>, sizes: Sizes) -> Option<[f64; 2]> {
    let size = |slot: Slot<'_>| match sizes {
        Sizes::Teeth => slot.count(1..=MOST_TEETH).map(|teeth| teeth as f64),
        Sizes::Diameters => slot.quantity(q::LENGTH, Bounds::POSITIVE),
    };
    let (one, other) = slot.pair(size, size)?;
    Some([one, other])
}
