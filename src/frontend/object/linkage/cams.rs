//! Cams between the links of a linkage.

use super::super::cam_geometry::{SENSES, SURFACES};
use super::super::measures::{Measures, PositionMeasures};
use super::super::position;
use super::names::Names;
use crate::dynamics::model::Coordinate::{Sliding, Turning};
use crate::frontend::read::{Bounds, Fields, Slot};
use crate::kinematics::linkage::spec::{CamPairSpec, CouplingKind, CouplingSpec};
use crate::kinematics::position::PositionSpec;
use crate::units::quantities as q;
use serde_json::json;

/// Laws of a lift that can repeat after a turn.
const LAWS: [&str; 4] = ["sine", "table", "cam", "plan"];

/// Reads a cam; the name of the coupling is left open.
pub(super) fn read(slot: Slot<'_>, names: &Names) -> Option<CouplingSpec> {
    slot.record(|fields| {
        let doc = "The cam's centre, about which its profile is given: a point of the link (or the ground) that carries the cam.";
        let centre = fields.need("centre", doc, |slot| names.point(slot));
        let doc = "The centre of the roller, or the point that runs on the cam: a point of another link, or of the ground.";
        let roller = fields.need("roller", doc, |slot| names.point(slot));
        let doc = "Radius of the roller; default 0, a point";
        let roller_radius = fields.or("roller_radius", doc, json!(0.0), |slot| {
            slot.quantity(q::LENGTH, Bounds::NOT_NEGATIVE)
        });
        let doc = "Radius of the profile about the centre where the lift is zero; without a `lift` that of the whole circle";
        let base_radius = fields.need("base_radius", doc, |slot| {
            slot.quantity(q::LENGTH, Bounds::POSITIVE)
        });
        let lift = lift(fields);
        let doc = "Direction from which the angle of the lift is counted, in the frame of the cam's link";
        let direction = fields.or("direction", doc, json!(0.0), |slot| {
            slot.quantity(q::ANGLE, Bounds::ANY)
        });
        let doc = "Sense in which the angle of the lift is counted. A cam that turns counterclockwise brings what lies clockwise of the roller.";
        let sense = fields.or("sense", doc, json!("counterclockwise"), |slot| {
            slot.choice(&SENSES)
        });
        let doc = "Which side of the cam is touched.";
        let surface = fields.or("surface", doc, json!("disc"), |slot| slot.choice(&SURFACES));
        let (centre, roller) = (centre?, roller?);
        let cam = CamPairSpec {
            centre: centre.at,
            roller: roller.at,
            roller_radius: roller_radius?,
            base_radius: base_radius?,
            lift: lift?,
            direction: direction?,
            sense: sense?,
            surface: surface?,
        };
        Some(CouplingSpec {
            name: String::new(),
            wheels: [centre.link, roller.link],
            carrier: centre.link,
            kind: CouplingKind::Cam(Box::new(cam)),
            offset: 0.0,
        })
    })
}

fn lift(fields: &mut Fields<'_>) -> Option<Option<PositionSpec>> {
    let ends = PositionMeasures {
        output: Measures(Some(Sliding)),
        driver: Measures(Some(Turning)),
    };
    let doc = "Lift of the roller's centre from its circle, radially, over the angle in the cam: a law that repeats after a turn; default none, a circle.";
    fields.maybe("lift", doc, |slot| position::read(slot, ends, &LAWS))
}
