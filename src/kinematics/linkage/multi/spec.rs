//! A linkage of several inputs in plain numbers.

use crate::kinematics::linkage::spec::LinkageSpec;

/// A planar linkage of rigid links and lower pairs whose position follows from several
/// independent coordinates, its inputs: as many as its mobility.
#[derive(Clone, Debug, Default, PartialEq)]
pub struct MultiSpec {
    /// Links, pairs, assembly, gravity, forces and outputs; its `driver`, `start` and
    /// `travel` have no meaning here.
    pub linkage: LinkageSpec,
    /// The inputs q₁, …, qₘ.
    pub inputs: Vec<InputSpec>,
}

/// An independent coordinate of a linkage.
#[derive(Clone, Debug, PartialEq)]
pub struct InputSpec {
    /// Name of the input.
    pub name: String,
    /// Meaning of the coordinate.
    pub coordinate: InputCoordinate,
    /// Its value at which the assembly holds (rad or m).
    pub start: f64,
}

/// Meaning of an independent coordinate.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum InputCoordinate {
    /// The relative coordinate of a pair, index into [`LinkageSpec::pairs`].
    Pair(usize),
    /// x of the origin of a link that no pair joins to what the other inputs place (m);
    /// it has all three coordinates as inputs.
    X(usize),
    /// y of the origin of such a link (m).
    Y(usize),
    /// The angle of such a link (rad).
    Angle(usize),
}

impl InputCoordinate {
    /// The link whose place the coordinate gives; `None` of a pair.
    pub fn floating_link(self) -> Option<usize> {
        match self {
            Self::Pair(_) => None,
            Self::X(link) | Self::Y(link) | Self::Angle(link) => Some(link),
        }
    }

    /// True when the coordinate is a length.
    pub fn slides(self, spec: &LinkageSpec) -> bool {
        match self {
            Self::Pair(pair) => spec.pairs.get(pair).is_some_and(|pair| pair.slides()),
            Self::X(_) | Self::Y(_) => true,
            Self::Angle(_) => false,
        }
    }
}
