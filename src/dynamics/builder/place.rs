//! Where in the mechanism an object stands: its id, and what its inputs hang on.

use crate::dynamics::model::{Coordinate, NodeIndex};

/// An object's place in the mechanism, as its lowering sees it.
#[derive(Clone, Debug)]
pub struct Place {
    pub(super) id: String,
    /// Index into [`crate::dynamics::model::Model::objects`].
    pub(super) object: usize,
    pub(super) inputs: Vec<InputConnection>,
}

/// Connection of an object's input: the output that drives it.
#[derive(Clone, Debug, PartialEq)]
pub struct InputConnection {
    /// Name of the input port.
    pub port: String,
    /// The output that it is connected to: `press`, `press.ram`.
    pub output: String,
    /// Whether that output turns or slides.
    pub coordinate: Coordinate,
    /// The node of that output.
    pub node: NodeIndex,
}

impl Place {
    /// The object's id in the scene.
    pub fn id(&self) -> &str {
        &self.id
    }

    /// Address of one of its properties, for faults: `rocker.pair.gap`.
    pub fn path(&self, property: &str) -> String {
        match property {
            "" => self.id.clone(),
            _ => format!("{}.{property}", self.id),
        }
    }

    /// Index of the driver in [`crate::dynamics::model::Model::objects`].
    pub fn object(&self) -> usize {
        self.object
    }

    /// Connection of an input; `None` where that object has faults of its own: nothing is
    /// to be said then about what follows it.
    pub fn input(&self, port: &str) -> Option<&InputConnection> {
        self.inputs.iter().find(|input| input.port == port)
    }
}
