//! Cranks: turning levers that go round.

use super::chain::{self, Rules};
use super::geometry::Beam;
use super::position;
use super::spec::{ChainSpec, InertiaSplit};
use super::{Description, Kind, Object, no_outputs};
use crate::model::{Closure, Coordinate};

/// A crank: a lever that turns about a fixed axis, as far as its position
/// function takes it.
///
/// ```text
/// driver ──U(φ), pair──○─/\/\─○ tip      (○ the fragments of the lever)
/// ```
///
/// Parameters: inertia about the axis (kg·m²), stiffness at the tip
/// (N·m/rad) and the rest of a chain. Equation: the chain's. Limits: small
/// deflections about the law of motion.
#[derive(Debug)]
pub struct Crank {
    chain: ChainSpec,
}

const RULES: Rules = Rules {
    coordinate: Some(Coordinate::Turning),
    split: InertiaSplit::Cubes,
    closure: Closure::Bilateral,
    beam: Beam::Lever,
    positions: position::ALL,
    geared: false,
};

pub(super) const KIND: Kind = Kind {
    name: "crank",
    doc: "A crank: a lever that turns about a fixed axis.",
    driven: true,
    outputs: no_outputs,
    coordinate: |_| Some(Coordinate::Turning),
    read: |fields, context| {
        let chain = chain::read(fields, context, &RULES)?;
        Some(Box::new(Crank { chain }))
    },
};

impl Object for Crank {
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
