//! The cycle of a cam and its curves as CSV.

use super::NamedCurve;
use crate::kinematics::cam::DiscCam;
use crate::report::csv::{number, write};
use crate::studies::cam::CamForce;

/// One turn in `count` equal steps, and both sides of every joint of the law:
/// motion, pressure angle, radii of curvature, profile, force and torque (left
/// empty where there is none).
///
/// # Errors
/// Never in practice: writing into memory.
pub fn cycle_csv(
    cam: &DiscCam,
    unit: &str,
    force: Option<&CamForce<'_>>,
    count: usize,
) -> Result<String, csv::Error> {
    let header = [
        "phi [rad]".to_owned(),
        format!("s [{unit}]"),
        format!("s1 [{unit}/rad]"),
        format!("s2 [{unit}/rad^2]"),
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
        let forces = force.map(|force| force.beside(phi, piece.from, piece.to));
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
        let cells = cells.map(finite).into_iter();
        let forces = match forces {
            Some([_, normal, torque]) => [finite(normal), finite(torque)],
            None => [String::new(), String::new()],
        };
        cells.chain(forces).collect::<Vec<String>>()
    });
    write(header.into_iter(), rows)
}

/// A number; of what is not finite (the radius of a straight place) nothing.
fn finite(value: f64) -> String {
    match value.is_finite() {
        true => number(value),
        false => String::new(),
    }
}

/// Pieces and angles of a table: equal steps, and the ends of every piece.
pub(super) fn rows(cam: &DiscCam, count: usize) -> Vec<(usize, f64)> {
    let (from, to) = cam.motion().range();
    let count = count.max(1);
    let mut found = Vec::new();
    for (index, piece) in cam.motion().pieces().iter().enumerate() {
        found.push((index, piece.from));
        let steps = (0..=count).map(|step| from + (to - from) * step as f64 / count as f64);
        found.extend(
            steps
                .filter(|&phi| piece.from < phi && phi < piece.to)
                .map(|phi| (index, phi)),
        );
        found.push((index, piece.to));
    }
    found
}

/// The corners of curves: curve, angle of the cam, x, y in the cam's frame.
///
/// # Errors
/// Never in practice: writing into memory.
pub fn polygon_csv(curves: &[NamedCurve]) -> Result<String, csv::Error> {
    let header = ["curve", "phi [rad]", "x [m]", "y [m]"].map(str::to_owned);
    let rows = curves.iter().flat_map(|curve| {
        let corners = curve.polygon.angles.iter().zip(&curve.polygon.points);
        corners.map(|(&phi, &[x, y])| vec![curve.name.clone(), number(phi), number(x), number(y)])
    });
    write(header.into_iter(), rows)
}
