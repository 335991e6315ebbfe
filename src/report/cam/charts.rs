//! Diagrams of a cam over its turn.

use super::tables::{PLACES, rows};
use crate::kinematics::cam::{CamState, DiscCam};
use crate::report::plot::{Axis, Mark, MotionPhase, Plot, Series};
use crate::studies::cam::{CamFigures, CamForce};

/// Radii beyond this multiple of the prime circle are not drawn.
const FAR: f64 = 6.0;

/// Lift, speed, acceleration, pressure angle, radius of curvature, and with a
/// known contact its force and the cam's torque.
pub(super) fn charts(
    cam: &DiscCam,
    figures: &CamFigures,
    force: Option<&CamForce<'_>>,
) -> Vec<Plot> {
    let places = rows(cam, PLACES);
    let pieces = cam.motion().pieces();
    let states = places
        .iter()
        .map(|&(piece, phi)| cam.at(&pieces[piece], phi));
    let states: Vec<CamState> = states.collect();
    let curve = |label: &str, f: &dyn Fn(&CamState) -> f64| {
        let points = states.iter().map(|s| (s.phi.to_degrees(), f(s)));
        Series::line(label, points.collect())
    };
    let one = |title: &str, unit: &str, f: &dyn Fn(&CamState) -> f64| {
        Plot::over_angle(title, unit, vec![curve("", f)])
    };
    let unit = figures.unit;
    let mut list = vec![one("Displacement outwards", unit, &|s| s.lift)];
    match force.map(CamForce::speed) {
        Some(speed) => {
            let square = speed * speed;
            let rate = [format!("{unit}/s"), format!("{unit}/s²")];
            list.push(one("Speed", &rate[0], &|s| s.first * speed));
            list.push(one("Acceleration", &rate[1], &|s| s.second * square));
        }
        None => {
            list.push(one("U′", &format!("{unit}/rad"), &|s| s.first));
            list.push(one("U″", &format!("{unit}/rad²"), &|s| s.second));
        }
    }
    // The pressure angle of a flat face says little; where it touches says much.
    match cam.geometry().roller() {
        Some(_) => list.push(pressure(cam, figures, &curve)),
        None => list.push(one("Contact on the face", "m", &|s| s.face)),
    }
    list.push(radii(cam, &curve));
    if let Some(force) = force {
        let mut add = |title: &str, unit: &str, f: &dyn Fn(f64, f64, f64) -> f64| {
            let at = |&(piece, phi): &(usize, f64)| {
                let piece = &pieces[piece];
                (phi.to_degrees(), f(phi, piece.from, piece.to))
            };
            let points = places.iter().map(at).collect();
            list.push(Plot::over_angle(
                title,
                unit,
                vec![Series::line("", points)],
            ));
        };
        let column = |index: usize| {
            move |phi: f64, from: f64, to: f64| force.at_within_piece(phi, from, to)[index]
        };
        add("Contact force", "N", &column(1));
        if cam.geometry().material.is_some() {
            add("Hertzian pressure", "Pa", &|phi, from, to| {
                let pressure = force.pressure_within_piece(phi, from, to);
                pressure.unwrap_or(f64::NAN)
            });
        }
        add("Torque of the cam", "N m", &column(2));
    }
    let lifts: Vec<(f64, f64)> = states
        .iter()
        .map(|s| (s.phi.to_degrees(), s.lift))
        .collect();
    let phases = MotionPhase::of(&lifts);
    for plot in &mut list {
        plot.phases.clone_from(&phases);
    }
    list
}

type Drawn<'a> = dyn Fn(&str, &dyn Fn(&CamState) -> f64) -> Series + 'a;

fn pressure(cam: &DiscCam, figures: &CamFigures, curve: &Drawn<'_>) -> Plot {
    let (from, to) = cam.motion().range();
    let line = |label: &str, angle: f64| {
        let ends = [from, to].map(|phi| (phi.to_degrees(), angle.to_degrees()));
        Series::theory(label, ends.into())
    };
    let curves = vec![
        curve("pressure angle", &|s| s.pressure_angle.to_degrees()),
        line("limit outwards", figures.limits.outward),
        line("limit inwards", -figures.limits.inward),
    ];
    Plot::over_angle("Pressure angle", "deg", curves)
}

fn radii(cam: &DiscCam, curve: &Drawn<'_>) -> Plot {
    let far = FAR * cam.geometry().prime_radius();
    let near = |radius: f64| match radius.abs() <= far {
        true => radius,
        false => f64::NAN,
    };
    let mut curves = vec![curve("profile", &|s| near(s.profile_radius))];
    if cam.geometry().roller().is_some_and(|roller| roller > 0.0) {
        curves.push(curve("pitch curve", &|s| near(s.pitch_radius)));
    }
    Plot::over_angle("Radius of curvature (convex: above zero)", "m", curves)
}

/// The least preload over the rate, and the spring of the scene.
pub(super) fn springs(figures: &CamFigures) -> Option<Plot> {
    let force = figures.force.as_ref()?;
    let answer = force.closing.as_ref()?;
    let boundary = answer
        .boundary
        .iter()
        .map(|&[rate, preload]| (rate, preload));
    let spring = vec![(force.spring.rate, force.spring.preload)];
    let unit = match force.spring_unit {
        "N" => "N/m",
        _ => "N m/rad",
    };
    Some(Plot::new(
        "Least preload",
        Axis::new("rate", unit),
        force.spring_unit,
        vec![
            Series::line("least preload with the reserve", boundary.collect()),
            Series::marked("spring of the scene", spring, vec![Mark::default()]),
        ],
    ))
}
