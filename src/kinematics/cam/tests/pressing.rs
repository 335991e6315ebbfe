//! The pressure between cam and follower against curvatures measured on the profile.

use super::super::{CamGeometry, CamMaterial, Contact, DiscCam, Surface};
use super::{flat, law, translating, turning};
use crate::kinematics::motion::LawName;
use crate::kinematics::position::Position;
use std::f64::consts::PI;

const MATERIAL: CamMaterial = CamMaterial {
    thickness: 0.02,
    contact_modulus: 1.1e11,
    moduli: [2e11; 2],
    poisson_ratios: [0.3; 2],
};

fn moved(lift: f64) -> Position {
    law(lift, LawName::Polynomial4567, LawName::Cycloidal)
}

/// Curvature of the profile at φ, positive where it bulges away from the axis: of the circle
/// through three points of it.
fn measured(cam: &DiscCam, piece: usize, phi: f64, offset: f64) -> f64 {
    let piece = &cam.motion().pieces()[piece];
    let h = 1e-4;
    let [a, b, c] = [-h, 0.0, h].map(|d| cam.curve_point(piece, phi + d, offset));
    let side = |p: [f64; 2], q: [f64; 2]| [q[0] - p[0], q[1] - p[1]];
    let length = |v: [f64; 2]| v[0].hypot(v[1]);
    let (ab, bc, ac) = (side(a, b), side(b, c), side(a, c));
    let twice_area = ab[0] * bc[1] - ab[1] * bc[0];
    let curvature = 2.0 * twice_area / (length(ab) * length(bc) * length(ac));
    // Counter-clockwise about the axis it bulges outwards where it turns left.
    let turns = (a[0] * c[1] - a[1] * c[0]).signum();
    curvature * turns
}

#[test]
fn pressures_follow_from_curvatures_measured_on_the_profile() {
    let with = |geometry: CamGeometry| CamGeometry {
        material: Some(MATERIAL),
        ..geometry
    };
    let surface = |surface| CamGeometry {
        surface,
        ..translating(0.05, 0.008, 0.0)
    };
    let face = CamGeometry {
        contact: flat(0.0, 0.0),
        ..translating(0.05, 0.0, 0.0)
    };
    // Geometry, curvature of the follower, offset of the profile, its side, force.
    let roller = 1.0 / 0.008;
    for (geometry, follower, offset, side, force) in [
        (translating(0.05, 0.008, 0.0), roller, -0.008, 1.0, 700.0),
        (turning(0.05, 0.008, 1.0), roller, -0.008, 1.0, 700.0),
        (surface(Surface::Hollow), roller, 0.008, -1.0, -300.0),
        (surface(Surface::Groove), roller, -0.008, 1.0, 300.0),
        (surface(Surface::Groove), roller, 0.008, -1.0, -300.0),
        (face, 0.0, 0.0, 1.0, 90.0),
    ] {
        let turning = matches!(geometry.guide, super::super::Guide::Turning { .. });
        let length = if turning { 0.2 } else { 0.006 };
        let cam = DiscCam::new(&moved(length), &with(geometry)).expect("a cam");
        for (piece, place) in cam.motion().pieces().iter().enumerate() {
            for share in [0.2, 0.5, 0.7] {
                let phi = place.from + share * (place.to - place.from);
                let state = cam.at(place, phi);
                let bulge = follower + side * measured(&cam, piece, phi, offset);
                let load = f64::abs(force) / MATERIAL.thickness;
                let wanted = (load * MATERIAL.contact_modulus * bulge / PI).sqrt();
                let found = cam.pressure(&state, force).expect("a pressure");
                approx::assert_relative_eq!(found, wanted, max_relative = 1e-5);
            }
        }
    }
}

#[test]
fn where_they_part_there_is_no_pressure_and_of_an_edge_none_is_known() {
    let geometry = CamGeometry {
        material: Some(MATERIAL),
        ..translating(0.05, 0.008, 0.0)
    };
    let cam = DiscCam::new(&moved(0.006), &geometry).expect("a cam");
    let state = cam.at(&cam.motion().pieces()[0], 0.1);
    assert_eq!(cam.pressure(&state, -5.0), Some(0.0));
    let unknown = CamGeometry {
        material: None,
        ..geometry.clone()
    };
    let unknown = DiscCam::new(&moved(0.006), &unknown).expect("a cam");
    assert_eq!(unknown.pressure(&state, 5.0), None);
    let edge = CamGeometry {
        contact: Contact::KnifeEdge,
        ..geometry
    };
    let edge = DiscCam::new(&moved(0.006), &edge).expect("a cam");
    assert_eq!(edge.pressure(&state, 5.0), None);
}
