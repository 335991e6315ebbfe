//! Sliders: objects that move along a guide.

use super::chain::{self, Rules};
use super::geometry::Beam;
use super::position;
use super::spec::{ChainSpec, InertiaSplit};
use super::{Description, Kind, Object, no_outputs};
use crate::model::{Closure, Coordinate};

/// A slide in a straight guide.
///
/// ```text
/// driver ──U(φ), pair──▢─/\/\─▢ ⇄
/// ```
///
/// Parameters: mass (kg, as `inertia`), stiffness (N/m) and the rest of a
/// chain; `lever_arm` (m) where the position function gives an angle.
/// Equation: the chain's. Positive as the position function counts. Limits:
/// tension and compression along the guide only.
#[derive(Debug)]
pub struct Slider {
    chain: ChainSpec,
}

const RULES: Rules = Rules {
    coordinate: Some(Coordinate::Sliding),
    split: InertiaSplit::Equal,
    closure: Closure::Bilateral,
    beam: Beam::Rod,
    positions: position::ALL,
    geared: false,
};

pub(super) const KIND: Kind = Kind {
    name: "slider",
    doc: "A slide in a straight guide.",
    driven: true,
    outputs: no_outputs,
    coordinate: |_| Some(Coordinate::Sliding),
    read: |fields, context| {
        let chain = chain::read(fields, context, &RULES)?;
        Some(Box::new(Slider { chain }))
    },
};

impl Object for Slider {
    fn kind(&self) -> &'static str {
        KIND.name
    }

    fn coordinate(&self) -> Coordinate {
        self.chain.coordinate
    }

    fn description(&self) -> Description<'_> {
        Description::Chain(&self.chain)
    }

    fn chain_mut(&mut self) -> Option<&mut ChainSpec> {
        Some(&mut self.chain)
    }
}
