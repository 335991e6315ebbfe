//! How hard cam and follower press on each other: the pressure along their line of contact.

use super::disc::{CamState, DiscCam};
use super::spec::{Contact, Surface};
use crate::kinematics::hertzian::line_pressure;

impl DiscCam {
    /// The greatest pressure between cam and follower (Pa) under a force along the normal
    /// (N), positive where the cam pushes outwards; 0 where a force of this sense lets them
    /// part. `None`: nothing is known of their material, or they do not touch along a line
    /// there.
    pub fn pressure(&self, state: &CamState, force: f64) -> Option<f64> {
        let material = self.geometry().material?;
        let presses = match self.geometry().surface {
            Surface::Disc => force > 0.0,
            Surface::Hollow => force < 0.0,
            Surface::Groove => true,
        };
        if !presses {
            return Some(0.0);
        }
        let load = force.abs() / material.thickness;
        line_pressure(load, material.contact_modulus, self.bulge(state, force)?)
    }

    /// Sum of the curvatures of follower and cam (1/m), positive where they bulge towards
    /// each other; of the flank of a groove that carries the force. `None`: an edge.
    fn bulge(&self, state: &CamState, force: f64) -> Option<f64> {
        let (follower, roller) = match self.geometry().contact {
            Contact::Roller { radius } => (1.0 / radius, radius),
            Contact::Flat { .. } => (0.0, 0.0),
            Contact::KnifeEdge => return None,
        };
        // A curve that is convex seen from outside is hollow for what lies within.
        let cam = match self.geometry().surface {
            Surface::Disc => 1.0 / (state.pitch_radius - roller),
            Surface::Groove if force > 0.0 => 1.0 / (state.pitch_radius - roller),
            Surface::Hollow | Surface::Groove => -1.0 / (state.pitch_radius + roller),
        };
        Some(follower + cam)
    }
}
