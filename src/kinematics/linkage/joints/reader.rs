//! What reads the numbers of a joint, from a scene or for its schema.

use super::super::spec::pair::PointOf;
use super::CouplingSpec;
use crate::kinematics::cam::Surface;
use crate::kinematics::position::spec::PositionSpec;

/// Reads the properties of a joint, in the order of the calls.
///
/// `None`: the value is faulty, or only described. All properties are read before the first of
/// them is looked at.
pub(crate) trait JointReader {
    /// Two wheels, or a wheel and what slides, with their carrier and their offset.
    fn carried(&mut self, slides: bool, lacks: &MissingCarrier) -> Option<CarriedLinks>;

    /// Two sizes, a pair of numbers.
    fn sizes(&mut self, key: &'static str, doc: &str, sizes: Sizes) -> Option<[f64; 2]>;

    /// Two sizes, written in one of several ways; `what`: what they are, for messages.
    fn sizes_as_written(
        &mut self,
        what: &'static str,
        ways: &[(&'static str, &str, Sizes)],
    ) -> Option<[f64; 2]>;

    /// Whether something is so; it is not if nothing is written.
    fn flag(&mut self, key: &'static str, doc: &str) -> Option<bool>;

    /// A point of a link or of the ground.
    fn point(&mut self, key: &'static str, doc: &str) -> Option<PointOf>;

    /// A length (m); `usual`: what it is where nothing is written.
    fn length(
        &mut self,
        key: &'static str,
        doc: &str,
        domain: Domain,
        usual: Option<f64>,
    ) -> Option<f64>;

    /// An angle (rad), 0 where nothing is written.
    fn angle(&mut self, key: &'static str, doc: &str) -> Option<f64>;

    /// A sense of turning, +1 (counterclockwise) where nothing is written.
    fn sense(&mut self, key: &'static str, doc: &str) -> Option<f64>;

    /// A side of a cam, its outside where nothing is written.
    fn surface(&mut self, key: &'static str, doc: &str) -> Option<Surface>;

    /// A lift that repeats after a turn, or none.
    fn lift(&mut self, key: &'static str, doc: &str) -> Option<Option<PositionSpec>>;
}

/// What a length may be.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub(crate) enum Domain {
    /// > 0.
    Positive,
    /// ≥ 0.
    NotNegative,
    /// Anything finite but 0.
    NotZero,
}

/// What two sizes are.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub(crate) enum Sizes {
    /// Numbers of teeth.
    Teeth,
    /// Diameters (m).
    Diameters,
}

/// Two links with their carrier.
#[derive(Clone, Copy, Debug)]
pub(crate) struct CarriedLinks {
    /// The links.
    pub(crate) wheels: [Option<usize>; 2],
    /// The link that carries both.
    pub(crate) carrier: Option<usize>,
    /// Coordinate of the second where that of the first is zero (rad or m).
    pub(crate) offset: f64,
}

impl CarriedLinks {
    /// A coupling of these links, its name left open.
    pub(super) fn coupled(self, kind: super::CouplingKind) -> CouplingSpec {
        CouplingSpec {
            name: String::new(),
            wheels: self.wheels,
            carrier: self.carrier,
            kind,
            offset: self.offset,
        }
    }
}

/// What is said where no link carries both, `{one}` and `{other}` being their names.
#[derive(Clone, Copy, Debug)]
pub(crate) struct MissingCarrier {
    /// What is wrong.
    pub(crate) message: &'static str,
    /// What would be right.
    pub(crate) hint: &'static str,
}
