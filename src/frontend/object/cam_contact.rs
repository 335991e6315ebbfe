//! The stiffness of a contact that follows from the object's own cam.

use super::spec::ChainSpec;
use crate::frontend::read::Fields;
use crate::kinematics::cam::pressing::NoStiffness;
use crate::kinematics::cam::{CamGeometry, DiscCam};
use crate::kinematics::position::Position;

/// Works out the stiffness of a pair's contact where it is to follow from the cam. `None`:
/// refused.
pub(super) fn find_contact_stiffness(
    fields: &mut Fields<'_>,
    chain: &mut ChainSpec,
    cam: Option<&CamGeometry>,
) -> Option<()> {
    let Some(on_cam) = chain.pair.contact.and_then(|contact| contact.on_cam) else {
        return Some(());
    };
    let built = |cam: &CamGeometry| {
        let position = Position::new(&chain.position).ok()?;
        DiscCam::new(&position, cam).ok()
    };
    let (message, hint) = match cam.map(built) {
        None => (
            "the stiffness of its contact is to follow from its cam, and it has none",
            "give it a `cam`, or the contact a `line` with its radii",
        ),
        Some(None) => (
            "the stiffness of its contact is to follow from its cam, which cannot be built",
            "ask `dam cam` what is wrong with it",
        ),
        Some(Some(disc)) => {
            match disc.contact_stiffness(on_cam.load, on_cam.angle, on_cam.depths) {
                Ok(stiffness) => {
                    if let Some(contact) = &mut chain.pair.contact {
                        contact.stiffness = stiffness / (chain.lever * chain.lever);
                        contact.on_cam = None;
                    }
                    return Some(());
                }
                Err(none) => describe_missing_stiffness(none),
            }
        }
    };
    let fault = fields.refuse("pair", "contradiction", message);
    fault.hints.push(hint.to_owned());
    None
}

fn describe_missing_stiffness(none: NoStiffness) -> (&'static str, &'static str) {
    match none {
        NoStiffness::Material => (
            "the stiffness of its contact is to follow from its cam, of whose material nothing is known",
            "give `cam.material`: thickness and moduli",
        ),
        NoStiffness::Edge => (
            "an edge has no radius, and so its contact no stiffness",
            "give the radius of a `roller`, however small",
        ),
        NoStiffness::Depth { of_cam: false } => (
            "the approach of a flat face is counted from a depth, which is not given",
            "give `pair.contact.from.cam.depth`",
        ),
        NoStiffness::Depth { of_cam: true } => (
            "the cam is flat or hollow there: its approach is counted from a depth, which is not given",
            "give `pair.contact.from.cam.cam_depth`, or another angle `at`",
        ),
        NoStiffness::Large => (
            "follower and cam have no small contact along a line there: their surfaces fit into each \
             other, or the load presses them flat",
            "give an angle `at` at which they bulge towards each other, and a load that they can bear",
        ),
    }
}
