//! How hard a follower is pressed on its cam.

use crate::kinematics::cam::DiscCam;

/// A follower on its cam, both of known material, that touch along a line.
#[derive(Clone, Debug)]
pub struct Pressing {
    cam: DiscCam,
    lever: f64,
}

impl Pressing {
    /// A follower on a cam, whose displacement is so many times that of the law. `None`:
    /// nothing is known of their material.
    pub fn new(cam: DiscCam, lever: f64) -> Option<Self> {
        let known = cam.geometry().material.is_some() && lever != 0.0;
        known.then_some(Self { cam, lever })
    }

    /// The greatest Hertzian pressure along the line of contact (Pa), where the cam stands
    /// at an angle (rad) and the follower pulls at its law with a force F (N or N·m along
    /// its displacement): 0 where they do not press on each other. The profile's curvature
    /// is that at the cam's angle; what the follower gives way by changes it by nothing
    /// that counts.
    pub fn pressure(&self, angle: f64, pull: f64) -> f64 {
        if pull == 0.0 {
            return 0.0;
        }
        let (piece, phi) = self.cam.motion().locate(angle);
        let state = self.cam.at(piece, phi);
        let outward = self.lever * self.cam.geometry().outward;
        let normal = -outward * pull / state.lever;
        // (Where an edge touches, or the profile is undercut, no pressure is finite.)
        (self.cam.pressure(&state, normal)).unwrap_or(f64::INFINITY)
    }
}
