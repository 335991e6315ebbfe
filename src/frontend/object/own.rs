//! Objects made in code: of the library's user, of no kind that a text can name.

use super::{Context, INPUT, Inputs, ModelBuilder, Object, Place, Ports};
use crate::dynamics::model::Coordinate;
use crate::frontend::read::{Fields, Node, OWN, Value};
use crate::kinematics::cam::CamGeometry;
use std::sync::Arc;

use super::spec::{ChainSpec, DrivenLinkage, DrivenMultiLinkage};

/// An object made in code, as the tree of a scene holds it.
#[derive(Clone, Debug)]
pub(crate) struct OwnObject(pub(crate) Arc<dyn Object>);

impl OwnObject {
    /// The object that a node holds; `None`: its properties stand in the node.
    pub(crate) fn of(node: &Node) -> Option<&Self> {
        match &node.get(OWN)?.value {
            Value::Own(own) => own.get(),
            _ => None,
        }
    }

    /// Inputs as a scene writes them.
    pub(crate) fn inputs(&self) -> Inputs {
        match self.0.ports().inputs.as_slice() {
            [] => Inputs::None,
            [one] if one.name == INPUT => Inputs::One,
            _ => Inputs::Several,
        }
    }

    /// Reads what its inputs hang on.
    pub(crate) fn read(
        fields: &mut Fields<'_>,
        context: &mut Context<'_>,
    ) -> Option<Box<dyn Object>> {
        let own: Self = fields.own("An object made in code.")?;
        let connected = match own.inputs() {
            Inputs::None => Some(()),
            Inputs::One => context.input(fields),
            Inputs::Several | Inputs::OneOrSeveral => own.connect_all(fields, context),
        };
        connected.map(|()| Box::new(own) as Box<dyn Object>)
    }

    fn connect_all(&self, fields: &mut Fields<'_>, context: &Context<'_>) -> Option<()> {
        let ports = self.0.ports().inputs;
        let doc = "The drivers of its inputs, by their names.";
        let inputs = fields.need("inputs", doc, |slot| {
            slot.names(|name, mut slot| {
                if ports.iter().any(|port| port.name == name) {
                    let connected = slot.record(|fields| context.connect(fields, "object", name));
                    return connected.map(|_| name.to_owned());
                }
                let names = ports.iter().map(|port| &*port.name);
                let hint = format!(
                    "its inputs are {}",
                    crate::frontend::read::quoted_list(names, "and")
                );
                let fault = slot.refuse("unknown-property", format!("there is no input `{name}`"));
                fault.hints.push(hint);
                None
            })
        })?;
        let missing = ports
            .iter()
            .find(|port| !inputs.iter().any(|name| *name == port.name));
        if let Some(port) = missing {
            let message = format!("nothing drives the input `{}`", port.name);
            fields.refuse("inputs", "missing-property", message);
        }
        missing.is_none().then_some(())
    }
}

/// All that a scene asks of an object is asked of the one it holds.
impl Object for OwnObject {
    fn kind(&self) -> &'static str {
        self.0.kind()
    }

    fn ports(&self) -> Ports {
        self.0.ports()
    }

    fn lower(&self, at: &Place, into: &mut ModelBuilder) {
        self.0.lower(at, into);
    }

    fn coordinate(&self) -> Coordinate {
        self.0.coordinate()
    }

    fn masses(&self) -> usize {
        self.0.masses()
    }

    fn chain(&self) -> Option<&ChainSpec> {
        self.0.chain()
    }

    fn linkage(&self) -> Option<&DrivenLinkage> {
        self.0.linkage()
    }

    fn multi_linkage(&self) -> Option<&DrivenMultiLinkage> {
        self.0.multi_linkage()
    }

    fn cam(&self) -> Option<&CamGeometry> {
        self.0.cam()
    }
}
