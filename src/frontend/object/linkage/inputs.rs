//! Inputs of a linkage of several: its independent coordinates, and what moves each.

use super::names::Names;
use super::{outputs, pairs};
use crate::dynamics::model::Coordinate;
use crate::frontend::object::load::{self, On};
use crate::frontend::object::measures::Measures;
use crate::frontend::object::spec::{DrivenMultiLinkage, InputDrive, LoadSpec};
use crate::frontend::object::{Context, Outputs, Port, Ports};
use crate::frontend::read::{Bounds, Fields, Node, Slot};
use crate::kinematics::linkage::multi::spec::{InputCoordinate, InputSpec, MultiSpec};
use crate::kinematics::linkage::multi::{freedom, proposal};
use crate::kinematics::linkage::spec::{LinkageSpec, PairSpec};

/// An input as it is written.
pub(super) struct InputStatement {
    name: String,
    coordinate: InputCoordinate,
    drive: InputDrive,
    /// Value at which the assembly holds, of a free input.
    start: f64,
    loads: Vec<LoadSpec>,
}

/// Whether an input turns or slides.
fn coordinate(input: InputCoordinate, pairs: &[PairSpec]) -> Coordinate {
    match input {
        InputCoordinate::Pair(pair) => {
            let pair = pairs.get(pair);
            pair.map_or(Coordinate::Turning, |pair| pairs::coordinate(&pair.kind))
        }
        InputCoordinate::X(_) | InputCoordinate::Y(_) => Coordinate::Sliding,
        InputCoordinate::Angle(_) => Coordinate::Turning,
    }
}

/// Names of the inputs in a linkage's text, which are outputs too, and whether they turn or
/// slide as far as it tells.
pub(super) fn in_text(linkage: &Node) -> Outputs {
    let inputs = linkage.get("inputs").map_or(&[][..], Node::members);
    let one = |input: &crate::frontend::read::Member| {
        let node = &input.value;
        let pair = node.get("pair").and_then(Node::text);
        let coordinate = match pair {
            Some(pair) => outputs::of_pair(linkage, pair),
            None if node.get("x").is_some() || node.get("y").is_some() => Some(Coordinate::Sliding),
            None => node.get("angle").map(|_| Coordinate::Turning),
        };
        (input.name.clone(), coordinate)
    };
    inputs.iter().map(one).collect()
}

/// Whether the first input in the order of the names turns or slides.
pub(super) fn first_in_text(linkage: &Node) -> Option<Coordinate> {
    let inputs = in_text(linkage).into_iter();
    inputs.min_by(|one, other| one.0.cmp(&other.0))?.1
}

/// Inputs that hang on others, and every input as an output.
pub(super) fn ports(spec: &DrivenMultiLinkage) -> Ports {
    let mut ports = Ports::source(spec.coordinate);
    let linkage = &spec.linkage.linkage;
    for (input, (drive, _)) in spec.linkage.inputs.iter().zip(&spec.inputs) {
        if matches!(drive, InputDrive::Object { .. }) {
            ports.inputs.push(Port::input(input.name.clone()));
        }
        let own = coordinate(input.coordinate, &linkage.pairs);
        ports.outputs.push(Port::output(input.name.clone(), own));
    }
    ports
}

/// Reads `inputs`, in the order of their names.
pub(super) fn read(
    slot: Slot<'_>,
    names: &Names,
    pairs: Option<&[PairSpec]>,
    context: &Context<'_>,
) -> Option<Vec<InputStatement>> {
    slot.names(|name, mut slot| {
        let free = !outputs::TAKEN.contains(&name);
        if !free {
            let place = slot.name_place();
            let message = format!("`{name}` cannot be an input: a result has this name");
            let fault = slot.refuse("bad-id", message);
            fault.place = Some(place);
            fault.hints.push("choose another name".to_owned());
        }
        let input = slot.defined("linkage_input", |slot| {
            slot.record(|fields| read_input(fields, name, names, pairs, context))
        });
        input.filter(|_| free)
    })
}

fn read_input(
    fields: &mut Fields<'_>,
    name: &str,
    names: &Names,
    pairs: Option<&[PairSpec]>,
    context: &Context<'_>,
) -> Option<InputStatement> {
    let mut kind = fields.one_of("which coordinate it is");
    kind.case("pair", "The coordinate of a pair.", |slot| {
        names.pair(slot).map(InputCoordinate::Pair)
    });
    let doc = "x of the origin of a link that floats: no pair joins it to the ground, and its `y` and `angle` are inputs too.";
    kind.case("x", doc, |slot| names.link(slot).map(InputCoordinate::X));
    let doc = "y of the origin of a link that floats.";
    kind.case("y", doc, |slot| names.link(slot).map(InputCoordinate::Y));
    let doc = "The angle of a link that floats.";
    kind.case("angle", doc, |slot| {
        names.link(slot).map(InputCoordinate::Angle)
    });
    let kind = kind.finish();
    let own = kind.zip(pairs).map(|(kind, pairs)| coordinate(kind, pairs));
    let measures = Measures(own);
    let driven = fields.has("object");
    let driver = context.connect_if_given(fields, "object", name);
    let of_driver = Measures(driver.flatten().flatten());
    let doc = "With `object`: input coordinate over the displacement of that; default 1";
    let ratio = fields.maybe("ratio", doc, |slot| {
        slot.quantity(measures.per(of_driver), Bounds::NOT_ZERO)
    });
    let doc = "With `object`: input coordinate where that is at zero; default 0";
    let offset = fields.maybe("offset", doc, |slot| {
        slot.quantity(measures.displacement(), Bounds::ANY)
    });
    let doc = "Value at which `assembly` holds; a free input starts there. Default 0, with `object` where that starts";
    let start = fields.maybe("start", doc, |slot| {
        slot.quantity(measures.displacement(), Bounds::ANY)
    });
    let doc = "Speed at the start of a free input; default 0";
    let speed = fields.maybe("speed", doc, |slot| {
        slot.quantity(measures.speed(), Bounds::ANY)
    });
    let loads = load::read_all(
        fields,
        On::Output {
            own: measures,
            driver: measures,
        },
        context,
    );
    let mut sound = true;
    let misplaced: &[(&str, &str)] = match driven {
        true => &[("speed", "its object gives the speed of this input")],
        false => &[
            ("ratio", "a free input has no driver"),
            ("offset", "a free input has no driver"),
        ],
    };
    if !fields.describing() {
        for &(property, message) in misplaced {
            if fields.has(property) {
                fields.refuse(property, "contradiction", message);
                sound = false;
            }
        }
    }
    let (ratio, offset, start, speed) = (ratio?, offset?, start?, speed?);
    driver?;
    let drive = match driven {
        true => InputDrive::Object {
            ratio: ratio.unwrap_or(1.0),
            offset: offset.unwrap_or(0.0),
            start,
        },
        false => InputDrive::Free {
            speed: speed.unwrap_or(0.0),
        },
    };
    let (coordinate, loads) = (kind?, loads?);
    sound.then(|| InputStatement {
        name: name.to_owned(),
        coordinate,
        drive,
        start: start.unwrap_or(0.0),
        loads,
    })
}

/// The linkage with its inputs.
pub(super) fn read_linkage_with_inputs(
    fields: &mut Fields<'_>,
    written: Vec<InputStatement>,
    linkage: LinkageSpec,
    loads: Vec<Vec<LoadSpec>>,
    joint_friction: bool,
) -> Option<DrivenMultiLinkage> {
    let twice =
        |one: &&InputStatement| linkage.outputs.iter().any(|output| output.name == one.name);
    if let Some(one) = written.iter().find(twice) {
        let message = format!("`{}` is the name of an input and of an output", one.name);
        let fault = fields.refuse("outputs", "bad-id", message);
        let hint = "every input is an output too: omit this output, or rename it";
        fault.hints.push(hint.to_owned());
        return None;
    }
    let Some(first) = written.first() else {
        let message = format!("there are no inputs, and {}", freedom(&linkage));
        let fault = fields.refuse("inputs", "missing-property", message);
        let hint = "name a coordinate for each degree of freedom";
        let spec = MultiSpec {
            linkage,
            inputs: Vec::new(),
        };
        fault.hints.push(match proposal(&spec) {
            None => hint.to_owned(),
            Some(inputs) => format!("{hint}: \"inputs\": {{ {inputs} }}"),
        });
        return None;
    };
    let coordinate = coordinate(first.coordinate, &linkage.pairs);
    let (mut specs, mut inputs) = (Vec::new(), Vec::new());
    for one in written {
        specs.push(InputSpec {
            name: one.name,
            coordinate: one.coordinate,
            start: one.start,
        });
        inputs.push((one.drive, one.loads));
    }
    Some(DrivenMultiLinkage {
        coordinate,
        linkage: MultiSpec {
            linkage,
            inputs: specs,
        },
        joint_friction,
        inputs,
        loads,
    })
}
