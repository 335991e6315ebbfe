//! Diagrams of a cam over its turn.

use super::sampled::sampled;
use crate::kinematics::cam::{CamState, DiscCam};
use crate::report::plot::{Axis, LineStyle, Mark, MotionPhase, Plot, Series};
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
    let places = sampled(cam);
    let states: Vec<CamState> = places
        .iter()
        .map(|&(piece, phi)| cam.at(&cam.motion().pieces()[piece], phi))
        .collect();
    let curve = |label: &str, f: &dyn Fn(&CamState) -> f64| {
        let points = states.iter().map(|s| (s.phi.to_degrees(), f(s)));
        Series::line(label, points.collect())
    };
    let unit = figures.unit;
    let speed = force.map(CamForce::speed);
    let mut list = vec![over(
        "Displacement outwards",
        unit,
        vec![curve("", &|s| s.lift)],
    )];
    match speed {
        Some(speed) => {
            list.push(over(
                "Speed",
                &format!("{unit}/s"),
                vec![curve("", &|s| s.first * speed)],
            ));
            let rate = format!("{unit}/s²");
            let square = speed * speed;
            list.push(over(
                "Acceleration",
                &rate,
                vec![curve("", &|s| s.second * square)],
            ));
        }
        None => {
            list.push(over(
                "U′",
                &format!("{unit}/rad"),
                vec![curve("", &|s| s.first)],
            ));
            list.push(over(
                "U″",
                &format!("{unit}/rad²"),
                vec![curve("", &|s| s.second)],
            ));
        }
    }
    // The pressure angle of a flat face says little; where it touches says much.
    match cam.geometry().roller() {
        Some(_) => list.push(pressure(cam, figures, &curve)),
        None => list.push(over(
            "Contact on the face",
            "m",
            vec![curve("", &|s| s.face)],
        )),
    }
    list.push(radii(cam, &curve));
    if let Some(force) = force {
        let column = |index: usize| -> Vec<(f64, f64)> {
            let at = |&(piece, phi): &(usize, f64)| {
                let piece = &cam.motion().pieces()[piece];
                (
                    phi.to_degrees(),
                    force.at_within_piece(phi, piece.from, piece.to)[index],
                )
            };
            places.iter().map(at).collect()
        };
        let plain = |points| Series::line("", points);
        list.push(over("Contact force", "N", vec![plain(column(1))]));
        if cam.geometry().material.is_some() {
            let at = |&(piece, phi): &(usize, f64)| {
                let piece = &cam.motion().pieces()[piece];
                let pressure = force.pressure_within_piece(phi, piece.from, piece.to);
                (phi.to_degrees(), pressure.unwrap_or(f64::NAN))
            };
            let curve = plain(places.iter().map(at).collect());
            list.push(over("Hertzian pressure", "Pa", vec![curve]));
        }
        list.push(over("Torque of the cam", "N m", vec![plain(column(2))]));
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

fn over(title: &str, unit: &str, curves: Vec<Series>) -> Plot {
    Plot {
        title: title.to_owned(),
        y: Axis::of(unit),
        series: curves,
        x: Axis::new("φ", "deg"),
        ..Plot::default()
    }
}

type Drawn<'a> = dyn Fn(&str, &dyn Fn(&CamState) -> f64) -> Series + 'a;

fn pressure(cam: &DiscCam, figures: &CamFigures, curve: &Drawn<'_>) -> Plot {
    let (from, to) = cam.motion().range();
    let line = |label: &str, angle: f64| Series {
        look: LineStyle::Theory,
        ..Series::line(
            label,
            vec![
                (from.to_degrees(), angle.to_degrees()),
                (to.to_degrees(), angle.to_degrees()),
            ],
        )
    };
    let limits = figures.limits;
    let mut curves = vec![curve("pressure angle", &|s| s.pressure_angle.to_degrees())];
    curves.push(line("limit outwards", limits.outward));
    curves.push(line("limit inwards", -limits.inward));
    over("Pressure angle", "deg", curves)
}

fn radii(cam: &DiscCam, curve: &Drawn<'_>) -> Plot {
    let far = FAR * cam.geometry().prime_radius();
    let near = |radius: f64| {
        if radius.abs() <= far {
            radius
        } else {
            f64::NAN
        }
    };
    let mut curves = vec![curve("profile", &|s| near(s.profile_radius))];
    if cam.geometry().roller().is_some_and(|roller| roller > 0.0) {
        curves.push(curve("pitch curve", &|s| near(s.pitch_radius)));
    }
    over("Radius of curvature (convex: above zero)", "m", curves)
}

/// The least preload over the rate, and the spring of the scene.
pub(super) fn springs(figures: &CamFigures) -> Option<Plot> {
    let force = figures.force.as_ref()?;
    let answer = force.closing.as_ref()?;
    let points = |list: &[[f64; 2]]| {
        list.iter()
            .map(|&[rate, preload]| (rate, preload))
            .collect()
    };
    let spring = force.spring;
    let unit = if force.unit == "N" { "N/m" } else { "N m/rad" };
    Some(Plot {
        title: "Least preload".to_owned(),
        y: Axis::of(force.unit),
        series: vec![
            Series::line("least preload with the reserve", points(&answer.boundary)),
            Series {
                look: LineStyle::Points,
                marks: vec![Mark::default()],
                ..Series::line("spring of the scene", vec![(spring.rate, spring.preload)])
            },
        ],
        x: Axis::new("rate", unit),
        ..Plot::default()
    })
}
