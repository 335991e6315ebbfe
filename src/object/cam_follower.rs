//! Cam followers: turning or sliding, held to the cam by a closing force.

use super::cam_geometry;
use super::chain::{self, Rules};
use super::geometry::Beam;
use super::position;
use super::spec::{ChainSpec, InertiaSplit};
use super::{Description, Kind, Object, no_outputs};
use crate::cam::CamGeometry;
use crate::model::{Closure, Coordinate};
use crate::read::Node;

/// The follower of a cam.
///
/// ```text
/// cam ──U(φ), contact──○─/\/\─○ ◄── closing load
/// ```
///
/// Parameters: `motion` (`turning` or `sliding`), inertia (kg·m² or kg),
/// stiffness (N·m/rad or N/m) and the rest of a chain. The pair is
/// force-closed unless said otherwise: the follower lifts off where the
/// closing load is too weak. `cam` holds the geometry of cam and follower, for
/// `dam cam`. Equation: the chain's. Limits: a flank rigid in
/// shape; the contact's softness is part of link 1.
#[derive(Debug)]
pub struct CamFollower {
    chain: ChainSpec,
    cam: Option<CamGeometry>,
}

const MOTIONS: [(&str, Coordinate); 2] = [
    ("turning", Coordinate::Turning),
    ("sliding", Coordinate::Sliding),
];

fn rules(coordinate: Option<Coordinate>) -> Rules {
    let turning = coordinate == Some(Coordinate::Turning);
    Rules {
        coordinate,
        split: if turning {
            InertiaSplit::Cubes
        } else {
            InertiaSplit::Equal
        },
        closure: Closure::Force,
        beam: if turning { Beam::Lever } else { Beam::Rod },
        positions: position::ALL,
        geared: false,
    }
}

fn motion(node: &Node) -> Option<Coordinate> {
    let name = node.get("motion")?.text()?;
    MOTIONS
        .iter()
        .find(|motion| motion.0 == name)
        .map(|motion| motion.1)
}

pub(super) const KIND: Kind = Kind {
    name: "cam_follower",
    doc: "The follower of a cam, turning or sliding, held to it by a closing force.",
    driven: true,
    outputs: no_outputs,
    coordinate: motion,
    read: |fields, context| {
        let coordinate = fields.need("motion", "Whether the follower turns or slides.", |slot| {
            slot.choice(&MOTIONS)
        });
        let chain = chain::read(fields, context, &rules(coordinate));
        let cam = cam_geometry::read(fields, coordinate, context);
        Some(Box::new(CamFollower {
            chain: chain?,
            cam: cam?,
        }))
    },
};

impl Object for CamFollower {
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

    fn cam(&self) -> Option<&CamGeometry> {
        self.cam.as_ref()
    }
}
