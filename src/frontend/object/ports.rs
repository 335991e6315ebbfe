//! What objects are joined by: ports.

use crate::dynamics::model::Coordinate;
use std::borrow::Cow;

/// The inputs and outputs of an object. Along a connection, displacement φ and speed
/// φ̇ go from an output to an input, and the reaction Ω goes back.
#[derive(Clone, Debug, Default, PartialEq)]
pub struct Ports {
    /// Input ports: none (a drive), one, or several.
    pub inputs: Vec<Port>,
    /// Output ports, on which others may hang. The first is the object's own
    /// displacement, which is addressed by the object's id alone; the others by
    /// `object.output`.
    pub outputs: Vec<Port>,
}

/// An input or output of an object.
#[derive(Clone, Debug, PartialEq)]
pub struct Port {
    /// Name of the port within the object.
    pub name: Cow<'static, str>,
    /// Whether it turns or slides; `None` of an input that takes either.
    pub coordinate: Option<Coordinate>,
}

/// Name of the input of an object that has only one: the property that names its
/// driver.
pub const INPUT: &str = "input";

/// Name of the output that is an object's own displacement.
pub const OWN: &str = "";

impl Port {
    /// An input that takes both turning and sliding motion.
    pub fn input(name: impl Into<Cow<'static, str>>) -> Self {
        Self {
            name: name.into(),
            coordinate: None,
        }
    }

    /// An output that turns or slides.
    pub fn output(name: impl Into<Cow<'static, str>>, coordinate: Coordinate) -> Self {
        Self {
            name: name.into(),
            coordinate: Some(coordinate),
        }
    }
}

impl Ports {
    /// Ports of an object that nothing drives.
    pub fn source(own: Coordinate) -> Self {
        Self {
            inputs: Vec::new(),
            outputs: vec![Port::output(OWN, own)],
        }
    }

    /// Ports of an object with one driver.
    pub fn with_one_driver(own: Coordinate) -> Self {
        Self {
            inputs: vec![Port::input(INPUT)],
            ..Self::source(own)
        }
    }
}
