//! Kinds of objects, and the registry that knows them.

use super::{Context, Object};
use crate::dynamics::model::Coordinate;
use crate::frontend::read::{Fields, Node, did_you_mean};

/// Outputs by name, with whether they turn or slide; `None`: not known.
pub type Outputs = Vec<(String, Option<Coordinate>)>;

/// Inputs that the objects of a kind have.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Inputs {
    /// Nothing: motion comes from them.
    None,
    /// One other object, named by the property `input`.
    One,
    /// Several, by name in the property `inputs`, each an object whose property
    /// `object` names what the input hangs on. The kind reads them itself, with
    /// [`Context::connect`].
    Several,
    /// One other object, named by `input`, or several, as above, where the property
    /// `inputs` is given; of these some may hang on nothing.
    OneOrSeveral,
}

/// A kind of object: how it is read from a scene.
#[derive(Clone, Copy, Debug)]
pub struct Kind {
    /// The value of the property `kind`.
    pub name: &'static str,
    /// Meaning of the kind, in one line.
    pub doc: &'static str,
    /// Inputs of its objects.
    pub inputs: Inputs,
    /// Outputs besides the object's own displacement, as far as the text tells: their
    /// names, and whether they turn or slide.
    pub outputs: fn(&Node) -> Outputs,
    /// Whether it turns or slides, as far as the text tells.
    pub coordinate: fn(&Node) -> Option<Coordinate>,
    /// Reads its properties, those common to all kinds (`kind`, `description`, `from`,
    /// `input`) excepted.
    pub read: fn(&mut Fields<'_>, &Context<'_>) -> Option<Box<dyn Object>>,
}

impl Kind {
    /// Most kinds have no outputs but their own displacement.
    pub fn no_outputs(_: &Node) -> Outputs {
        Vec::new()
    }
}

impl Inputs {
    /// True when the motion of an object, as its text has it, may come from itself: nothing
    /// drives it, or not all of its inputs.
    pub(crate) fn is_source(self, node: &Node) -> bool {
        match self {
            Self::None => true,
            Self::One | Self::Several => false,
            Self::OneOrSeveral => {
                let inputs = node.get("inputs").map_or(&[][..], Node::members);
                // (Of none it is told which there could be.)
                let none = node.get("inputs").is_some() && inputs.is_empty();
                none || inputs
                    .iter()
                    .any(|input| input.value.get("object").is_none())
            }
        }
    }

    /// The input ports of an object as its text has them: the name of each, and the output
    /// that it is connected to.
    pub(crate) fn ports(self, node: &Node) -> Vec<(&str, Option<&str>)> {
        match self {
            Self::None => Vec::new(),
            Self::OneOrSeveral => self.alternative_in_text(node).ports(node),
            Self::One => vec![(super::INPUT, node.get(super::INPUT).and_then(Node::text))],
            Self::Several => {
                let inputs = node.get("inputs").map_or(&[][..], Node::members);
                let ports = inputs.iter().map(|input| {
                    let output = input.value.get("object").and_then(Node::text);
                    (input.name.as_str(), output)
                });
                ports.collect()
            }
        }
    }

    /// Which of its alternatives the text of an object has.
    pub(crate) fn alternative_in_text(self, node: &Node) -> Self {
        match (self, node.get("inputs")) {
            (Self::OneOrSeveral, Some(_)) => Self::Several,
            (Self::OneOrSeveral, None) => Self::One,
            (one, _) => one,
        }
    }

    /// The outputs that the inputs of an object hang on, by its ports, as its text has
    /// them.
    pub(crate) fn references(self, node: &Node) -> Vec<(&str, &str)> {
        let ports = self.ports(node).into_iter();
        ports
            .filter_map(|(name, output)| Some((name, output?)))
            .collect()
    }
}

/// The kinds that a scene may name, in the order they are presented.
#[derive(Clone, Debug)]
pub struct Registry {
    kinds: Vec<Kind>,
}

impl Registry {
    /// The kinds of this library.
    pub fn standard() -> Self {
        Self {
            kinds: super::STANDARD.to_vec(),
        }
    }

    /// With a further kind, which takes the place of one of the same name.
    #[must_use]
    pub fn with_kind(mut self, kind: Kind) -> Self {
        match self.kinds.iter_mut().find(|known| known.name == kind.name) {
            Some(known) => *known = kind,
            None => self.kinds.push(kind),
        }
        self
    }

    /// All kinds.
    pub fn kinds(&self) -> &[Kind] {
        &self.kinds
    }

    /// The kind of a name.
    pub fn kind(&self, name: &str) -> Option<&Kind> {
        self.kinds.iter().find(|kind| kind.name == name)
    }

    /// What may have been meant by a name that no kind has.
    pub fn did_you_mean(&self, name: &str) -> Option<String> {
        did_you_mean(name, self.kinds.iter().map(|kind| kind.name))
    }
}

impl Default for Registry {
    fn default() -> Self {
        Self::standard()
    }
}
