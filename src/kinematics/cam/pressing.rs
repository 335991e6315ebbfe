//! How hard cam and follower press on each other: the pressure along their line of contact.

use super::disc::{CamState, DiscCam};
use super::spec::{Contact, Surface};
use crate::kinematics::hertzian::{ApproachReference, Material, line_approach, line_pressure};

/// Depths below flat or hollow surfaces from which an approach is counted (m): of the
/// follower and of the cam.
pub(crate) type Depths = [Option<f64>; 2];

/// Why a contact of follower and cam has no stiffness.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub(crate) enum NoStiffness {
    /// Nothing is known of the material.
    Material,
    /// An edge touches.
    Edge,
    /// The follower is flat, the cam flat or hollow there: a depth is needed.
    Depth {
        /// True of the cam.
        of_cam: bool,
    },
    /// It is no small contact along a line.
    Large,
}

impl DiscCam {
    /// The secant N/p of the contact (N/m, N·m/rad) along the follower's displacement, under a
    /// load along the normal (N), at an angle of the cam (rad). Without one where the
    /// touched profile is most sharply convex, or, where it is nowhere so, at the beginning
    /// of the turn. The approach is counted from the axis of a roller, from the centre of
    /// curvature of a convex profile, from the depths below what is flat or hollow.
    ///
    /// # Errors
    /// Why there is none.
    pub(crate) fn contact_stiffness(
        &self,
        load: f64,
        angle: Option<f64>,
        depths: Depths,
    ) -> Result<f64, NoStiffness> {
        let material = self.geometry().material.ok_or(NoStiffness::Material)?;
        let sharpest = || self.radii(self.geometry().flanks()[0])[0].map(|at| at.phi);
        let outside = self.geometry().surface != Surface::Hollow;
        let angle = angle.or_else(|| sharpest().filter(|_| outside));
        let (piece, phi) = self
            .motion()
            .piece_at(angle.unwrap_or(self.motion().range().0));
        let state = self.at(piece, phi);
        let force = if outside { load } else { -load };
        let both = self
            .sum_of_curvatures(&state, force)
            .ok_or(NoStiffness::Edge)?;
        let own = match self.geometry().contact {
            Contact::Roller { radius } => 1.0 / radius,
            _ => 0.0,
        };
        let backing = |index: usize, curvature: f64| match depths[index] {
            _ if curvature > 0.0 => Ok(ApproachReference::Cylinder(1.0 / curvature)),
            Some(depth) => Ok(ApproachReference::Depth { curvature, depth }),
            None => Err(NoStiffness::Depth { of_cam: index == 1 }),
        };
        let material_of = |index: usize| Material {
            modulus: material.moduli[index],
            poisson_ratio: material.poisson_ratios[index],
        };
        let bodies = [
            (material_of(0), backing(0, own)?),
            (material_of(1), backing(1, both - own)?),
        ];
        let approach = line_approach(load / material.thickness, bodies);
        let approach = approach.ok_or(NoStiffness::Large)?;
        Ok(load / approach * state.lever * state.lever)
    }

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
        line_pressure(
            load,
            material.contact_modulus,
            self.sum_of_curvatures(state, force)?,
        )
    }

    /// Sum of the curvatures of follower and cam (1/m), positive where they bulge towards
    /// each other; of the flank of a groove that carries the force. `None`: an edge.
    fn sum_of_curvatures(&self, state: &CamState, force: f64) -> Option<f64> {
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
