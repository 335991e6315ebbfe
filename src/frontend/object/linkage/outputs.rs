//! Outputs of a linkage: what other objects hang on, and what is recorded.

use super::names::Names;
use super::pairs;
use crate::dynamics::model::Coordinate;
use crate::frontend::object::load::{self, On};
use crate::frontend::object::measures::Measures;
use crate::frontend::object::spec::LoadSpec;
use crate::frontend::object::{Context, Outputs};
use crate::frontend::read::{Bounds, Fields, Node, Slot};
use crate::kinematics::linkage::spec::{OutputKind, OutputSpec, PairSpec};
use crate::units::quantities as q;
use serde_json::json;

/// Names that the figures of the linkage itself have.
pub(super) const TAKEN: [&str; 12] = [
    "delta_abs",
    "delta_max",
    "delta_min",
    "sigma",
    "peak_speed",
    "peak_acceleration",
    "peak_reaction",
    "final",
    "pair",
    "friction_loss",
    "standstills",
    "time_at_rest",
];

/// Whether an output turns or slides.
pub(super) fn coordinate(kind: &OutputKind, pairs: &[PairSpec]) -> Coordinate {
    match kind {
        OutputKind::Angle { .. } => Coordinate::Turning,
        OutputKind::Point { .. } => Coordinate::Sliding,
        OutputKind::Pair { pair } => pairs
            .get(*pair)
            .map_or(Coordinate::Turning, |pair| pairs::coordinate(&pair.kind)),
    }
}

/// Names of the outputs in a linkage's text, and whether they turn or slide as
/// far as it tells.
pub(super) fn in_text(linkage: &Node) -> Outputs {
    let outputs = linkage.get("outputs").map_or(&[][..], Node::members);
    let one = |output: &crate::frontend::read::Member| {
        let has = |name: &str| output.value.get(name).is_some();
        let coordinate = match (has("angle"), has("point"), output.value.get("pair")) {
            (true, false, None) => Some(Coordinate::Turning),
            (false, true, None) => Some(Coordinate::Sliding),
            (false, false, Some(pair)) => pair.text().and_then(|pair| of_pair(linkage, pair)),
            _ => None,
        };
        (output.name.clone(), coordinate)
    };
    outputs.iter().map(one).collect()
}

/// Whether a pair of a linkage's text turns or slides.
pub(super) fn of_pair(linkage: &Node, pair: &str) -> Option<Coordinate> {
    let pair = linkage.get("pairs")?.get(pair)?;
    match (pair.get("revolute"), pair.get("sliding")) {
        (Some(_), None) => Some(Coordinate::Turning),
        (None, Some(_)) => Some(Coordinate::Sliding),
        _ => None,
    }
}

/// Outputs, and of each its loads.
type OutputsAndLoads = (Vec<OutputSpec>, Vec<Vec<LoadSpec>>);

/// Reads `outputs`, in the order of their names. `driving`: the input, and what is known of
/// other objects.
pub(super) fn read(
    fields: &mut Fields<'_>,
    names: &Names,
    pairs: Option<&[PairSpec]>,
    driving: (Measures, &Context<'_>),
) -> Option<OutputsAndLoads> {
    let doc = "Outputs by name: other objects take them as `input`, as in `press.ram`, and they are recorded.";
    let outputs = fields.or("outputs", doc, json!({}), |slot| {
        slot.names(|name, mut slot| {
            let free = !TAKEN.contains(&name);
            if !free {
                let place = slot.name_place();
                let message = format!("`{name}` cannot be an output: a result has this name");
                let fault = slot.refuse("bad-id", message);
                fault.place = Some(place);
                fault.hints.push("choose another name".to_owned());
            }
            let output = slot.defined("linkage_output", |slot| {
                read_output(slot, name, names, pairs, driving)
            });
            output.filter(|_| free)
        })
    });
    Some(outputs?.into_iter().unzip())
}

fn read_output(
    slot: Slot<'_>,
    name: &str,
    names: &Names,
    pairs: Option<&[PairSpec]>,
    (input, context): (Measures, &Context<'_>),
) -> Option<(OutputSpec, Vec<LoadSpec>)> {
    slot.record(|fields| {
        let mut kind = fields.one_of("what it is");
        kind.case("angle", "The angle of a link.", |slot| {
            names.link(slot).map(|link| OutputKind::Angle { link })
        });
        kind.case(
            "point",
            "The displacement of a point along a direction.",
            |slot| {
                let point = names.point(slot)?;
                Some(OutputKind::Point {
                    point,
                    direction: 0.0,
                })
            },
        );
        kind.case("pair", "The coordinate of a pair.", |slot| {
            names.pair(slot).map(|pair| OutputKind::Pair { pair })
        });
        let kind = kind.finish();
        let doc = "Direction of a point's displacement in the frame of the ground; default 0";
        let direction = fields.maybe("direction", doc, |slot| {
            slot.quantity(q::ANGLE, Bounds::ANY)
        });
        // Read, and so described in the schema, whatever becomes of the rest.
        let own = kind.as_ref().zip(pairs);
        let own = own.map(|(kind, pairs)| coordinate(kind, pairs));
        let on = On::Output {
            own: Measures(own),
            driver: Measures(input.0.or(own)),
        };
        let loads = load::read_all(fields, on, context);
        let kind = match (kind?, direction?) {
            (OutputKind::Point { point, .. }, direction) => OutputKind::Point {
                point,
                direction: direction.unwrap_or(0.0),
            },
            (kind, None) => kind,
            (_, Some(_)) => {
                let message = "`direction` goes with `point` only";
                fields.refuse("direction", "contradiction", message);
                return None;
            }
        };
        let (name, loads) = (name.to_owned(), loads?);
        Some((OutputSpec { name, kind }, loads))
    })
}
