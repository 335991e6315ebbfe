//! Shafts and gears: turning, in a constant ratio to the driver.

use super::chain::{self, Rules};
use super::geometry::Beam;
use super::spec::{ChainSpec, InertiaSplit};
use super::{Description, Kind, Object, no_outputs};
use crate::model::{Closure, Coordinate};

/// A shaft, geared to its driver.
///
/// ```text
/// driver ──ratio, backlash──○─/\/\─○─/\/\─○   torsional masses
/// ```
///
/// Parameters: `position` (default: ratio 1), `backlash` (rad, ≥ 0: a
/// form-closed pair with that gap), inertia (kg·m²), stiffness (N·m/rad) and
/// the rest of a chain. Equation: the chain's, with U = ratio·φ. Positive in
/// the driver's sense while the ratio is positive. Limits: torsion only, no
/// bending, no mesh stiffness that varies with the angle.
#[derive(Debug)]
pub struct Shaft {
    chain: ChainSpec,
}

const RULES: Rules = Rules {
    coordinate: Some(Coordinate::Turning),
    split: InertiaSplit::Equal,
    closure: Closure::Bilateral,
    beam: Beam::Shaft,
    positions: &["ratio"],
    geared: true,
};

pub(super) const KIND: Kind = Kind {
    name: "shaft",
    doc: "A shaft: turns in a constant ratio to its driver, with torsional masses and backlash.",
    driven: true,
    outputs: no_outputs,
    coordinate: |_| Some(Coordinate::Turning),
    read: |fields, context| {
        let chain = chain::read(fields, context, &RULES)?;
        Some(Box::new(Shaft { chain }))
    },
};

impl Object for Shaft {
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
