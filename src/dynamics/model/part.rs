//! What the objects of a scene have become in the model.

use super::pressing::ContactPartner;
use super::{ContactElement, Coordinate, NodeIndex, Pair};
use std::sync::Arc;

/// The owner of a figure and the figure's name, from an address such as
/// `rocker.pair.gap` or `press.ram.peak_speed`: the longest id that `known`
/// knows; the first part when it knows none.
pub fn owner_of(address: &str, known: impl Fn(&str) -> bool) -> (&str, &str) {
    let mut ends = address.match_indices('.').map(|(at, _)| at);
    let Some(first) = ends.next() else {
        return (address, "");
    };
    let end = match ends.next() {
        Some(second) if known(&address[..second]) => second,
        _ => first,
    };
    (&address[..end], &address[end + 1..])
}

/// An object of the scene, or an output of one, in the model.
#[derive(Clone, Debug, Default)]
pub struct ObjectPart {
    /// Id in the scene; of an output `object.output`.
    pub id: String,
    /// Kind in the scene; [`OUTPUT`] of an output, [`DRIVEN_END`] of the inertia of an
    /// elastic object that moves with its law, [`MODE`] of one of its vibration modes,
    /// [`SUM`] of the output of one whose masses are no places on it.
    pub kind: &'static str,
    /// Turning or sliding.
    pub coordinate: Coordinate,
    /// Nodes, first mass first; one for a drive or a rigid object.
    pub nodes: Vec<NodeIndex>,
    /// The node on which several inputs are combined, which its law follows.
    pub combination: Option<NodeIndex>,
    /// Of an elastic object the node of the inertia that moves with its law, if it has
    /// one: it stands in the model as a part of its own, of the kind [`DRIVEN_END`].
    pub driven_end: Option<NodeIndex>,
    /// Inputs with what drives them, in their order; none of a drive.
    pub inputs: Vec<PartInput>,
    /// Links, link 1 first; empty for a drive or a rigid object. A contact element that
    /// ends at a massless point is not among them.
    pub links: Vec<usize>,
    /// The contact element of its pair.
    pub contact: Option<ContactElement>,
    /// The pair of a rigid object (an elastic object's is in its link 1).
    pub rigid_pair: Option<Pair>,
    /// What it is pressed on, where its shape and what it is made of are known.
    pub pressing: Option<Arc<ContactPartner>>,
}

/// An input of an object part.
#[derive(Clone, Debug, PartialEq, Eq)]
pub struct PartInput {
    /// Name of the port; empty of an output, which its own object drives.
    pub port: String,
    /// The driving object or output, index into [`objects`](super::Model::objects).
    pub driver: usize,
}

impl PartInput {
    /// The inputs of an object behind one driver, or of a drive (`None`).
    pub fn behind_one_driver(driver: Option<usize>) -> Vec<Self> {
        let port = String::new();
        driver
            .map(|driver| Self { port, driver })
            .into_iter()
            .collect()
    }
}

impl ObjectPart {
    /// True of a drive, prescribed or with a motor: nothing drives it.
    pub fn is_drive(&self) -> bool {
        self.inputs.is_empty()
    }

    /// Driver of an object with one input, index into [`objects`](super::Model::objects); `None` for a
    /// drive, and where there are several.
    pub fn driver(&self) -> Option<usize> {
        match self.inputs[..] {
            [ref only] => Some(only.driver),
            _ => None,
        }
    }

    /// The contact element of its pair, where that gives way.
    pub fn indented(&self) -> Option<ContactElement> {
        self.contact.filter(|contact| !contact.law.is_rigid())
    }

    /// The contact element of its pair, where that is rigid.
    pub fn strikes(&self) -> Option<ContactElement> {
        self.contact.filter(|contact| contact.law.is_rigid())
    }

    /// True of a part of an object that nothing can hang on and that no scene names.
    pub fn is_inner(&self) -> bool {
        [DRIVEN_END, MODE, STOP, SUM].contains(&self.kind)
    }

    /// False of the sum that is the output of an object: its motion and its figures are those
    /// of the object.
    pub fn is_reported(&self) -> bool {
        self.kind != SUM
    }

    /// True when one of the inputs hangs on that object part.
    pub fn is_driven_by(&self, other: usize) -> bool {
        self.inputs.iter().any(|input| input.driver == other)
    }
}

/// The kind of an object part that is an output of another one.
pub const OUTPUT: &str = "output";

/// The kind of an object part that is the share of an elastic object's inertia at its
/// driven end, which follows the law: `object.driven_end`.
pub const DRIVEN_END: &str = "driven_end";

/// The kind of an object part that is a vibration mode of an elastic object:
/// `object.mode_1`, `object.residual`.
pub const MODE: &str = "mode";

/// The kind of an object part that is the sum of the masses which an elastic object behind a
/// contact element is reduced to: `object.output`.
pub const SUM: &str = "sum";

/// The kind of an object part that is a stop of an object: `valve.seat`.
pub const STOP: &str = "stop";
