//! The cycle of a cam and its curves as tables for other programs.

use super::NamedCurve;
use crate::kinematics::cam::DiscCam;
use crate::report::course::samples;
use crate::report::csv::{Field, Rows};
use crate::studies::cam::CamForce;

/// Places over the turn of charts, and of the cam that turns.
pub(super) const PLACES: usize = 720;

/// One turn in `count` equal steps, and both sides of every joint of the law:
/// motion, pressure angle, radii of curvature, profile, force and torque (left
/// empty where there is none).
pub fn cycle_rows(cam: &DiscCam, unit: &str, force: Option<&CamForce<'_>>, count: usize) -> Rows {
    let header = [
        "phi [rad]".to_owned(),
        format!("s [{unit}]"),
        format!("s1 [{unit}/rad]"),
        format!("s2 [{unit}/rad²]"),
        "pressure_angle [rad]".to_owned(),
        "pitch_radius [m]".to_owned(),
        "profile_radius [m]".to_owned(),
        "profile_x [m]".to_owned(),
        "profile_y [m]".to_owned(),
        "contact_force [N]".to_owned(),
        "torque [N m]".to_owned(),
    ];
    let flank = cam.geometry().flanks()[0];
    let rows = rows(cam, count).into_iter().map(|(piece, phi)| {
        let piece = &cam.motion().pieces()[piece];
        let state = cam.at(piece, phi);
        let profile = cam.curve_point(piece, phi, flank);
        let forces = force.map(|force| force.at_within_piece(phi, piece.from, piece.to));
        let cells = [
            phi,
            state.lift,
            state.first,
            state.second,
            state.pressure_angle,
            state.pitch_radius,
            state.profile_radius,
            profile[0],
            profile[1],
        ];
        let forces = forces.map_or([f64::NAN; 2], |[_, normal, torque]| [normal, torque]);
        cells.into_iter().chain(forces)
    });
    Rows::new(header, rows)
}

/// Pieces and angles of a table: equal steps, and the ends of every piece.
pub(super) fn rows(cam: &DiscCam, count: usize) -> Vec<(usize, f64)> {
    let (from, to) = cam.motion().range();
    let pieces = cam.motion().pieces().iter();
    let pieces = pieces.map(|piece| [piece.from, piece.to]);
    samples(pieces, [from, to - from], count, |piece, phi| (piece, phi))
}

/// The corners of curves: curve, angle of the cam, x, y in the cam's frame.
pub fn polygon_rows(curves: &[NamedCurve]) -> Rows {
    let rows = curves.iter().flat_map(|curve| {
        let corners = curve.polygon.angles.iter().zip(&curve.polygon.points);
        let name = || Field::from(curve.name.as_str());
        corners.map(move |(&phi, &[x, y])| [name(), phi.into(), x.into(), y.into()])
    });
    Rows::new(["curve", "phi [rad]", "x [m]", "y [m]"], rows)
}
