//! How hard a follower is pressed on its cam.
//!
//! It is read off a state: the curvature of the profile at the cam's angle, and the force of
//! the pair. The pressure of a contact whose stiffness follows from geometry (`contact.from`)
//! is read in the same way. Records have a column of each. In `exact` such objects are observed
//! like those that trees carry.

use crate::kinematics::cam::DiscCam;
use crate::kinematics::hertzian::ContactPressure;

/// What an object presses on, where both are of known shape and material.
#[derive(Clone, Debug)]
pub enum ContactPartner {
    /// The same place all the time: a contact whose stiffness follows from geometry.
    Fixed(ContactPressure),
    /// A cam, along a line.
    Cam(OnCam),
}

/// A follower on its cam.
#[derive(Clone, Debug)]
pub struct OnCam {
    cam: DiscCam,
    lever: f64,
}

impl ContactPartner {
    /// A follower on a cam, whose displacement is so many times that of the law. `None`:
    /// nothing is known of their material.
    pub fn on_cam(cam: DiscCam, lever: f64) -> Option<Self> {
        let known = cam.geometry().material.is_some() && lever != 0.0;
        known.then_some(Self::Cam(OnCam { cam, lever }))
    }

    /// The greatest Hertzian pressure (Pa), where the cam stands
    /// at an angle (rad) and the follower pulls at its law with a force F (N or N·m along
    /// its displacement): 0 where they do not press on each other. The profile's curvature
    /// is that at the cam's angle; what the follower gives way by changes it by nothing
    /// that counts.
    pub fn pressure(&self, angle: f64, pull: f64) -> f64 {
        if pull == 0.0 {
            return 0.0;
        }
        let OnCam { cam, lever } = match self {
            Self::Fixed(pressure) => return pressure.of(pull),
            Self::Cam(on_cam) => on_cam,
        };
        let (piece, phi) = cam.motion().piece_at(angle);
        let state = cam.at(piece, phi);
        let outward = lever * cam.geometry().outward;
        let normal = -outward * pull / state.lever;
        // (Where an edge touches, or the profile is undercut, no pressure is finite.)
        (cam.pressure(&state, normal)).unwrap_or(f64::INFINITY)
    }
}
