//! A cam on the terminal.

use super::remarks::remarks;
use super::words::{DIGITS, clean};
use super::words::{angle_at, degrees, length};
use crate::kinematics::cam::closing::LetsGo;
use crate::kinematics::cam::sizing::BaseRange;
use crate::kinematics::cam::{At, CamGeometry, Contact, DiscCam, Guide, Surface};
use crate::report::quantity::{significant, with_unit};
use crate::studies::cam::{Answer, CamFigures, FaceFigures, ForceFigures, Radii, SpringAnswer};
use crate::studies::law::LiftOff;
use std::f64::consts::TAU;
use std::fmt::Write as _;

/// All that was found, in lines.
pub fn cam_text(id: &str, cam: &DiscCam, found: &CamFigures) -> String {
    let mut text = format!("{id}: {}\n\n", describe(cam.geometry()));
    for (name, value) in facts(cam, found) {
        let _ = writeln!(text, "  {name:<38} {value}");
    }
    text.push('\n');
    let list = remarks(found);
    match list.is_empty() {
        true => text.push_str("  the profile is sound: no undercut, no corner, no shock\n"),
        false => {
            for (_, remark) in list {
                let _ = writeln!(text, "  {remark}");
            }
        }
    }
    text
}

/// Guide, contact and surface in words.
pub(super) fn describe(geometry: &CamGeometry) -> String {
    let follower = match geometry.guide {
        Guide::Translating { offset } if offset != 0.0 => {
            format!("sliding follower, offset {}", length(offset))
        }
        Guide::Translating { .. } => "sliding follower".to_owned(),
        Guide::Turning {
            centre_distance,
            against,
            ..
        } => format!(
            "turning follower, axes {} apart, swinging {} the cam",
            length(centre_distance),
            if against > 0.0 { "against" } else { "with" }
        ),
    };
    let contact = match geometry.contact {
        Contact::Roller { radius } => format!("roller of radius {}", length(radius)),
        Contact::KnifeEdge => "knife edge".to_owned(),
        Contact::Flat { inclination, .. } if inclination != 0.0 => {
            format!("flat face inclined {}", degrees(inclination))
        }
        Contact::Flat { .. } => "flat face".to_owned(),
    };
    let surface = match geometry.surface {
        Surface::Disc => "disc cam",
        Surface::Hollow => "hollow cam",
        Surface::Groove => "grooved cam",
    };
    let sense = match geometry.sense > 0.0 {
        true => "counter-clockwise",
        false => "clockwise",
    };
    format!("{surface} turning {sense}, {follower}, {contact}")
}

fn at(at: At, unit: &str) -> String {
    format!(
        "{} at {}",
        with_unit(clean(at.value), unit, DIGITS),
        degrees(at.phi)
    )
}

/// Names and values, geometry first.
pub(super) fn facts(cam: &DiscCam, found: &CamFigures) -> Vec<(&'static str, String)> {
    let unit = found.unit;
    let mut rows = vec![
        ("stroke", displacement(found.stroke, unit)),
        ("base circle", length(found.base_radius)),
    ];
    if cam.geometry().roller().is_some_and(|roller| roller > 0.0) {
        rows.push((
            "prime circle (centre of the roller)",
            length(found.prime_radius),
        ));
    }
    if let Guide::Turning { .. } = cam.geometry().guide {
        rows.push(("innermost, from the line of centres", degrees(found.start)));
    }
    rows.push((
        "greatest speed U′, outwards",
        at(found.speed[0], &format!("{unit}/rad")),
    ));
    rows.push((
        "greatest acceleration U″, outwards",
        at(found.acceleration[0], &format!("{unit}/rad²")),
    ));
    rows.push((
        "least acceleration U″",
        at(found.acceleration[1], &format!("{unit}/rad²")),
    ));
    rows.push(("greatest pressure angle", angle_at(found.pressure[1])));
    rows.push(("least pressure angle", angle_at(found.pressure[0])));
    if let Some(pitch) = &found.pitch {
        radii(
            &mut rows,
            pitch,
            ["pitch curve, convex from", "pitch curve, concave from"],
        );
    }
    let names = [
        ["profile, convex from", "profile, concave from"],
        ["outer flank, convex from", "outer flank, concave from"],
    ];
    for (profile, names) in found.profiles.iter().zip(names) {
        radii(&mut rows, profile, names);
    }
    if let Some(face) = &found.face {
        face_rows(&mut rows, face);
    }
    sizes(&mut rows, found);
    match (&found.force, &found.force_missing) {
        (Some(force), _) => force_rows(&mut rows, force),
        (None, Some(why)) => rows.push(("contact force", format!("not known: {why}"))),
        (None, None) => {}
    }
    rows
}

fn displacement(value: f64, unit: &str) -> String {
    match unit {
        "rad" => degrees(value),
        _ => length(value),
    }
}

type Rows = Vec<(&'static str, String)>;

fn radii(rows: &mut Rows, radii: &Radii, names: [&'static str; 2]) {
    for (name, radius) in names.into_iter().zip([radii.convex, radii.concave]) {
        if let Some(radius) = radius {
            rows.push((name, format!("radius {}", at(radius, "m"))));
        }
    }
}

fn face_rows(rows: &mut Rows, face: &FaceFigures) {
    rows.push((
        "contact on the face",
        format!("{} … {}", at(face.least, "m"), at(face.greatest, "m")),
    ));
    let enough = match face.width {
        Some(width) if width >= face.needed_width => format!(", has {}", length(width)),
        Some(width) => format!(", HAS ONLY {}", length(width)),
        None => String::new(),
    };
    rows.push((
        "width of the face needed",
        format!("{}{enough}", length(face.needed_width)),
    ));
}

fn sizes(rows: &mut Rows, found: &CamFigures) {
    let limits = found.limits;
    let name = "base circles within the pressure angle";
    let asked = match limits.inward == limits.outward {
        true => degrees(limits.outward),
        false => format!(
            "{} out, {} back",
            degrees(limits.outward),
            degrees(limits.inward)
        ),
    };
    // An inclination says no more than the pressure angle above.
    let bound =
        found.face.is_none() || found.unit == "rad" || found.base_for_pressure.found.is_none();
    if bound {
        rows.push((
            name,
            format!("{} for {asked}", ranges(&found.base_for_pressure)),
        ));
    }
    if let Some(best) = found.best_offset {
        let text = format!(
            "{}, base circle {}",
            length(best.offset),
            length(best.base_radius)
        );
        rows.push(("best offset", text));
    }
    rows.push((
        "base circles smooth enough",
        ranges(&found.base_for_curvature),
    ));
    if let Some(roller) = &found.roller {
        let text = match (roller.cusp, roller.advised) {
            (Some(cusp), Some(advised)) => format!(
                "{} advised ({} of {})",
                length(advised),
                significant(roller.factor, 4),
                at(cusp, "m")
            ),
            _ => "any".to_owned(),
        };
        rows.push(("roller up to", text));
        if let Some(cutter) = roller.cutter {
            let radius = match found.profiles.len() {
                1 => at(cutter, "m"),
                _ => format!("{}, that of the roller", length(cutter.value)),
            };
            rows.push(("cutter or grinding wheel up to", format!("radius {radius}")));
        }
    }
}

fn ranges(answer: &Answer<Vec<BaseRange>>) -> String {
    let one = |range: &BaseRange| match range.to {
        None if range.from == 0.0 => "any".to_owned(),
        Some(to) => format!("{} to {}", length(range.from), length(to)),
        None => format!("from {}", length(range.from)),
    };
    match (&answer.found, &answer.why_not) {
        (Some(list), _) => list.iter().map(one).collect::<Vec<_>>().join(", "),
        (None, Some(why)) => format!("NONE: {why}"),
        (None, None) => String::new(),
    }
}

pub(super) fn rpm(speed: f64) -> String {
    format!(
        "{} rpm ({} rad/s)",
        significant(speed * 60.0 / TAU, DIGITS),
        significant(speed, DIGITS)
    )
}

fn force_rows(rows: &mut Rows, force: &ForceFigures) {
    let generalised = force.unit;
    rows.push(("speed of the cam", rpm(force.speed)));
    rows.push(("greatest contact force", at(force.contact_force, "N")));
    rows.push((
        "least force of the pair (margin)",
        at(force.margin, generalised),
    ));
    rows.push(("greatest torque of the cam", at(force.torque, "N m")));
    rows.push(("least torque of the cam", at(force.return_torque, "N m")));
    match force.lets_go {
        Some(LetsGo::At(found)) => rows.push((
            "lets go, rigid",
            format!("{} at {}", rpm(found.value), degrees(found.phi)),
        )),
        Some(LetsGo::AtRest(found)) => rows.push((
            "lets go, rigid",
            format!("AT REST: {} lacking", at(found, generalised)),
        )),
        Some(LetsGo::Never) => rows.push(("lets go, rigid", "at no speed".to_owned())),
        None => {}
    }
    match force.elastic {
        Some(LiftOff::At(speed)) => rows.push(("lets go, elastic (runs, to 0.1 %)", rpm(speed))),
        Some(LiftOff::Above(speed)) => {
            rows.push((
                "lets go, elastic (runs, to 0.1 %)",
                format!("not up to {}", rpm(speed)),
            ));
        }
        Some(LiftOff::Below(speed)) => {
            rows.push((
                "lets go, elastic (runs, to 0.1 %)",
                format!("even at {}", rpm(speed)),
            ));
        }
        None => {}
    }
    if let Some(answer) = &force.closing {
        spring_rows(rows, force, answer, generalised);
    }
}

fn spring_rows(rows: &mut Rows, force: &ForceFigures, answer: &SpringAnswer, unit: &str) {
    let rate = if unit == "N m" { "N m/rad" } else { "N/m" };
    rows.push((
        "reserve wanted in contact",
        with_unit(answer.reserve, unit, DIGITS),
    ));
    rows.push((
        "preload needed with this rate",
        format!(
            "{} (rate {}, has {})",
            at(answer.preload, unit),
            with_unit(force.spring.rate, rate, DIGITS),
            with_unit(force.spring.preload, unit, DIGITS)
        ),
    ));
    let text = match (&answer.rates, &answer.no_rate) {
        (Some(rates), _) => match rates.to {
            Some(to) => format!(
                "{} to {}",
                with_unit(rates.from, rate, DIGITS),
                with_unit(to, rate, DIGITS)
            ),
            None => format!("from {}", with_unit(rates.from, rate, DIGITS)),
        },
        (None, Some(why)) => format!("NONE: {why}"),
        (None, None) => String::new(),
    };
    rows.push(("rates that do with this preload", text));
}
