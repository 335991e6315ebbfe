//! Linkages: any planar mechanism of rigid links, with one degree of freedom or several.

mod couplings;
mod forces;
mod inputs;
mod links;
mod names;
mod outputs;
mod pairs;

use super::measures::PositionMeasures;
use super::position;
use super::spec::{DrivenLinkage, DrivenMultiLinkage};
use super::{Context, INPUT, Inputs, Kind, Measures, ModelBuilder, Object, Place, Port, Ports};
use crate::frontend::read::{Bounds, Fields, Slot, Value};
use crate::kinematics::linkage::spec::LinkageSpec;
use crate::kinematics::position::PositionSpec;
use names::Names;
use serde_json::json;

/// A planar linkage of rigid links, pins and guides, with one degree of
/// freedom or several.
///
/// ```text
///            rod          x to the right, y up, angles counterclockwise;
///        A ────── B       points are given in the frame of their link,
///       ╱        ═╪═══    pairs say which points of two links coincide
///      O          guide
/// ```
///
/// Parameters: `ground` and `links` with named points (m), masses (kg), centres
/// of mass and moments of inertia about them (kg·m²). `pairs`. `couplings`, gears, belts, racks and
/// cams between the links. `driver`, the pair whose coordinate q is the driver's displacement (times `position`).
/// `assembly` and `start`, which way it is put together. `gravity`, `forces`.
/// `outputs`, on which other objects hang.
///
/// Equation: J(q)·q̈ + ½·J′(q)·q̇² = −V′(q) + Q(q) − D(q)·q̇ + the driver's
/// moment or force, J, V, Q, D the inertia, potential, forces and damping
/// reduced to q; with `joint_friction` also the friction of the pairs, which
/// follows from their reactions, these from q, q̇ and q̈. Limits: links do not
/// bend, pairs have no play, rollers stay on their cams; a run ends in dead-centre positions of the driver.
///
/// With `inputs` in place of `driver` there are several coordinates q₁, …, qₘ, as many as its
/// mobility: of pairs, or x, y and angle of a link that floats; each is moved by an object,
/// or free. Equation: M(q)·q̈ = Q(q, q̇) + what drives the inputs. Limits: friction of the
/// joints in `dam forces` alone, no tables over an input; a run ends in singular positions.
#[derive(Debug)]
pub struct Linkage {
    spec: DriveMode,
}

/// How it is driven.
#[derive(Debug)]
enum DriveMode {
    One(DrivenLinkage),
    Several(DrivenMultiLinkage),
}

pub(super) const KIND: Kind = Kind {
    name: "linkage",
    doc: "A planar linkage of rigid links, with one degree of freedom or several.",
    inputs: Inputs::OneOrSeveral,
    outputs: |node| {
        let mut outputs = outputs::in_text(node);
        outputs.extend(inputs::in_text(node));
        outputs
    },
    coordinate: |node| match node.get("inputs") {
        None => outputs::of_pair(node, node.get("driver")?.text()?),
        Some(_) => inputs::first_in_text(node),
    },
    read: |fields, context| {
        let spec = read(fields, context)?;
        Some(Box::new(Linkage { spec }))
    },
};

impl Object for Linkage {
    fn kind(&self) -> &'static str {
        KIND.name
    }

    fn ports(&self) -> Ports {
        let (mut ports, linkage) = match &self.spec {
            DriveMode::One(spec) => (Ports::with_one_driver(spec.coordinate), &spec.linkage),
            DriveMode::Several(spec) => (inputs::ports(spec), &spec.linkage.linkage),
        };
        let further = linkage.outputs.iter().map(|output| {
            let coordinate = outputs::coordinate(&output.kind, &linkage.pairs);
            Port::output(output.name.clone(), coordinate)
        });
        ports.outputs.extend(further);
        ports
    }

    fn lower(&self, at: &Place, into: &mut ModelBuilder) {
        match &self.spec {
            DriveMode::One(spec) => into.linkage(at, at.input(INPUT), spec),
            DriveMode::Several(spec) => into.multi_linkage(at, spec),
        }
    }

    fn linkage(&self) -> Option<&DrivenLinkage> {
        match &self.spec {
            DriveMode::One(spec) => Some(spec),
            DriveMode::Several(_) => None,
        }
    }

    fn multi_linkage(&self) -> Option<&DrivenMultiLinkage> {
        match &self.spec {
            DriveMode::One(_) => None,
            DriveMode::Several(spec) => Some(spec),
        }
    }
}

/// Reads the name of the pair that is driven: one, not several.
fn read_driven_pair(mut slot: Slot<'_>, names: &Names) -> Option<usize> {
    let given = slot.node().map(|node| &node.value);
    let Some(Value::List(list)) = given else {
        return names.pair(slot);
    };
    let message = format!(
        "a linkage with a `driver` takes one input: it is driven at one pair, found {} in `driver`",
        list.len()
    );
    let fault = slot.refuse("wrong-type", message);
    let hint = "name one pair, \"driver\": \"O\"; or give each input a name, \"inputs\": { \"left\": \
                { \"pair\": \"O\", \"object\": \"motor\" }, \"right\": { \"pair\": \"P\" } }";
    fault.hints.push(hint.to_owned());
    None
}

/// What moves a linkage.
enum MovedBy {
    /// The pair of its one input.
    Driver(usize),
    /// Its inputs by name.
    Inputs(Vec<inputs::InputStatement>),
}

fn read(fields: &mut Fields<'_>, context: &Context<'_>) -> Option<DriveMode> {
    let several = fields.has("inputs");
    let driver = Measures(context.driver);
    let doc = "Named numbers, to which the others refer: \"rod\", \"-rod\", \"rod/2\", \"rod*0.4\". Those of a catalogue object are replaced one by one.";
    fields.dimensions(doc);
    let mut names = Names::new(fields.node());
    let parts = links::read(fields, &mut names);
    // Friction that no run knows of is worth a remark.
    let written = fields.member("joint_friction");
    let rubs = written.is_some_and(|member| member.value.value == Value::Flag(true));
    let (pairs, welds) = pairs::read(fields, &names, several && !rubs).unzip();
    let couplings = couplings::read(fields, &names, pairs.as_deref());
    let mut way = fields.one_of("what moves it");
    let doc = "The pair that is driven: its coordinate is the input of the linkage.";
    way.case("driver", doc, |slot| {
        read_driven_pair(slot, &names).map(MovedBy::Driver)
    });
    let doc = "In place of `input`, `driver`, `position`, `start` and `travel`: its independent coordinates by name, as many as its mobility. Each is an output too, `press.left`.";
    way.case("inputs", doc, |slot| {
        inputs::read(slot, &names, pairs.as_deref(), context).map(MovedBy::Inputs)
    });
    let way = way.finish();
    let driven = match way {
        Some(MovedBy::Driver(pair)) => Some(pair),
        _ => None,
    };
    let kind = driven
        .zip(pairs.as_ref())
        .and_then(|(at, pairs)| pairs.get(at).map(|pair| pairs::coordinate(&pair.kind)));
    let input = Measures(kind);
    let of_one = match several {
        true => refuse_single_input_fields(fields).then_some(OneInput::default()),
        false => read_one_input(fields, input, driver),
    };
    let doc = "True: the friction of the joints acts on the motion in `dam run`. The linkage, or \
               single joints of one with several inputs, may come to rest by it. False: it counts \
               in `dam forces` only.";
    let joint_friction = fields.or("joint_friction", doc, json!(false), |slot| slot.flag());
    let assembly = pairs::read_assembly(fields, &names);
    let gravity = forces::gravity(fields);
    let forces = forces::read(fields, &names, pairs.as_deref(), input);
    let outputs = outputs::read(fields, &names, pairs.as_deref(), (input, context));
    let (ground, links) = parts?;
    let (outputs, loads) = outputs?;
    let (of_one, joint_friction) = (of_one?, joint_friction?);
    let linkage = LinkageSpec {
        links,
        ground,
        pairs: pairs?,
        couplings: couplings?,
        welds: welds?,
        redundant: Vec::new(),
        driver: driven.unwrap_or_default(),
        assembly: assembly?,
        start: of_one.start,
        travel: of_one.travel,
        gravity: gravity?,
        forces: forces?,
        outputs,
    };
    match way? {
        MovedBy::Inputs(written) => {
            let spec =
                inputs::read_linkage_with_inputs(fields, written, linkage, loads, joint_friction)?;
            Some(DriveMode::Several(spec))
        }
        MovedBy::Driver(_) => Some(DriveMode::One(DrivenLinkage {
            coordinate: kind?,
            position: of_one.position,
            joint_friction,
            linkage,
            loads,
        })),
    }
}

/// What is said of a linkage of one input alone.
struct OneInput {
    position: PositionSpec,
    start: f64,
    travel: Option<[f64; 2]>,
}

impl Default for OneInput {
    fn default() -> Self {
        Self {
            position: PositionSpec::Ratio {
                ratio: 1.0,
                offset: 0.0,
            },
            start: 0.0,
            travel: None,
        }
    }
}

fn read_one_input(fields: &mut Fields<'_>, input: Measures, driver: Measures) -> Option<OneInput> {
    let ends = PositionMeasures {
        output: input,
        driver,
    };
    let doc = "Input coordinate over the driver's displacement: a constant ratio.";
    let position = fields.or("position", doc, json!({ "ratio": 1.0 }), |slot| {
        position::read(slot, ends, &["ratio"])
    });
    let doc = "Input coordinate at which `assembly` holds: the linkage is put together there";
    let start = fields.or("start", doc, json!(0.0), |slot| {
        slot.quantity(input.displacement(), Bounds::ANY)
    });
    let doc = "Least and greatest input coordinate: the stroke of a cylinder; default as far as the links allow.";
    let travel = fields.maybe("travel", doc, |slot| travel(slot, input));
    Some(OneInput {
        position: position?,
        start: start?,
        travel: travel?,
    })
}

/// Refuses what belongs to a linkage of one input; true when there is nothing of it.
fn refuse_single_input_fields(fields: &mut Fields<'_>) -> bool {
    let mut found = false;
    for property in ["position", "start", "travel"] {
        let message = format!("`{property}` belongs to a linkage of one input");
        let hint = "leave it out: each of the `inputs` has its own `ratio`, `offset` and `start`";
        found |= fields.forbid(property, &message, hint);
    }
    !found
}

fn travel(mut slot: Slot<'_>, input: Measures) -> Option<[f64; 2]> {
    let end = |slot: Slot<'_>| slot.quantity(input.displacement(), Bounds::ANY);
    let (from, to) = slot.read_in_place(|slot| slot.pair(end, end))?;
    if from < to {
        return Some([from, to]);
    }
    let message = format!("the travel must end beyond its beginning: {to} is not above {from}");
    slot.refuse("out-of-range", message);
    None
}
