//! Linkages: any planar mechanism of rigid links with one degree of freedom.

mod forces;
mod links;
mod names;
mod outputs;
mod pairs;

use super::measures::Ends;
use super::position;
use super::spec::DrivenLinkage;
use super::{INPUT, Inputs, Kind, Measures, ModelBuilder, Object, Place, Port, Ports};
use crate::frontend::read::{Bounds, Fields, Slot, Value};
use crate::kinematics::linkage::spec::LinkageSpec;
use names::Names;
use serde_json::json;

/// A planar linkage of rigid links, pins and guides, with one degree of
/// freedom.
///
/// ```text
///            rod          x to the right, y up, angles counterclockwise;
///        A ────── B       points are given in the frame of their link,
///       ╱        ═╪═══    pairs say which points of two links coincide
///      O          guide
/// ```
///
/// Parameters: `ground` and `links` with named points (m), masses (kg), centres
/// of mass and moments of inertia about them (kg·m²); `pairs`; `driver`, the
/// pair whose coordinate q is the driver's displacement (times `position`);
/// `assembly` and `start`, which way it is put together; `gravity`, `forces`;
/// `outputs`, on which other objects hang.
///
/// Equation: J(q)·q̈ + ½·J′(q)·q̇² = −V′(q) + Q(q) − D(q)·q̇ + the driver's
/// moment or force, J, V, Q, D the inertia, potential, forces and damping
/// reduced to q; with `joint_friction` also the friction of the pairs, which
/// follows from their reactions, these from q, q̇ and q̈. Limits: links do not
/// bend, pairs have no play; a run ends in dead positions of the driver.
#[derive(Debug)]
pub struct Linkage {
    spec: DrivenLinkage,
}

pub(super) const KIND: Kind = Kind {
    name: "linkage",
    doc: "A planar linkage of rigid links with one degree of freedom.",
    inputs: Inputs::One,
    outputs: outputs::in_text,
    coordinate: |node| outputs::of_pair(node, node.get("driver")?.text()?),
    read: |fields, context| {
        let spec = read(fields, Measures(context.driver))?;
        Some(Box::new(Linkage { spec }))
    },
};

impl Object for Linkage {
    fn kind(&self) -> &'static str {
        KIND.name
    }

    fn ports(&self) -> Ports {
        let mut ports = Ports::driven(self.spec.coordinate);
        let further = self.spec.linkage.outputs.iter().map(|output| {
            let coordinate = outputs::coordinate(&output.kind, &self.spec.linkage.pairs);
            Port::output(output.name.clone(), coordinate)
        });
        ports.outputs.extend(further);
        ports
    }

    fn lower(&self, at: &Place, into: &mut ModelBuilder) {
        into.linkage(at, at.input(INPUT), &self.spec);
    }

    fn linkage(&self) -> Option<&DrivenLinkage> {
        Some(&self.spec)
    }
}

/// Reads the name of the pair that is driven: one, not several.
fn driven_pair(mut slot: Slot<'_>, names: &Names) -> Option<usize> {
    let given = slot.node().map(|node| &node.value);
    let Some(Value::List(list)) = given else {
        return names.pair(slot);
    };
    let message = format!(
        "a linkage takes one input: it is driven at one pair, found {} in `driver`",
        list.len()
    );
    let fault = slot.refuse("wrong-type", message);
    let hint = "name one pair, \"driver\": \"O\"; a `differential` sums several motions to the one \
                that drives it";
    fault.hints.push(hint.to_owned());
    None
}

fn read(fields: &mut Fields<'_>, driver: Measures) -> Option<DrivenLinkage> {
    let doc = "Named numbers, to which the others refer: \"rod\", \"-rod\", \"rod/2\", \"rod*0.4\". Those of a catalogue object are replaced one by one.";
    fields.dimensions(doc);
    let mut names = Names::new(fields.node());
    let parts = links::read(fields, &mut names);
    let pairs = pairs::read(fields, &names);
    let doc = "The pair that is driven: its coordinate is the input of the linkage.";
    let driven = fields.need("driver", doc, |slot| driven_pair(slot, &names));
    let kind = driven
        .zip(pairs.as_ref())
        .and_then(|(at, pairs)| pairs.get(at).map(|pair| pairs::coordinate(&pair.kind)));
    let input = Measures(kind);
    let ends = Ends {
        output: input,
        driver,
    };
    let doc = "Input coordinate over the driver's displacement: a constant ratio.";
    let position = fields.or("position", doc, json!({ "ratio": 1.0 }), |slot| {
        position::read(slot, ends, &["ratio"])
    });
    let assembly = pairs::assembly(fields, &names);
    let doc = "Input coordinate at which `assembly` holds: the linkage is put together there";
    let start = fields.or("start", doc, json!(0.0), |slot| {
        slot.quantity(input.displacement(), Bounds::ANY)
    });
    let doc = "Least and greatest input coordinate: the stroke of a cylinder; default as far as the links allow.";
    let travel = fields.maybe("travel", doc, |slot| travel(slot, input));
    let gravity = forces::gravity(fields);
    let forces = forces::read(fields, &names, pairs.as_deref(), input);
    let outputs = outputs::read(fields, &names, pairs.as_deref());
    let doc = "True: the friction of the pairs acts on the motion in `dam run`, and the linkage may come to rest by it; false: it counts in `dam forces` only.";
    let joint_friction = fields.or("joint_friction", doc, json!(false), |slot| slot.flag());
    let (ground, links) = parts?;
    let (outputs, loads) = outputs?;
    Some(DrivenLinkage {
        coordinate: kind?,
        position: position?,
        joint_friction: joint_friction?,
        linkage: LinkageSpec {
            links,
            ground,
            pairs: pairs?,
            driver: driven?,
            assembly: assembly?,
            start: start?,
            travel: travel?,
            gravity: gravity?,
            forces: forces?,
            outputs,
        },
        loads,
    })
}

fn travel(mut slot: Slot<'_>, input: Measures) -> Option<[f64; 2]> {
    let end = |slot: Slot<'_>| slot.quantity(input.displacement(), Bounds::ANY);
    let (from, to) = slot.look(|slot| slot.pair(end, end))?;
    if from < to {
        return Some([from, to]);
    }
    let message = format!("the travel must end beyond its beginning: {to} is not above {from}");
    slot.refuse("out-of-range", message);
    None
}
