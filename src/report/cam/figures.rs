//! The figures of a cam.

use super::words::{clean, degrees, length};
use crate::kinematics::cam::closing::LetsGo;
use crate::kinematics::cam::sizing::BaseRange;
use crate::kinematics::cam::{At, CamGeometry, Contact, DiscCam, Guide, Surface};
use crate::report::findings::{Figure, Value};
use crate::report::quantity::{DIGITS, result, significant, with_unit};
use crate::report::sentence::Sentence;
use crate::studies::cam::{
    Answer, CamFigures, ElasticFigures, FaceFigures, ForceFigures, Radii, SpringAnswer,
};
use crate::studies::law::LiftOff;
use std::f64::consts::TAU;

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

/// A number that is met at an angle of the cam.
fn extreme(name: &str, at: At, unit: &str) -> Figure {
    let value = Value::angle_or(clean(at.value), unit, DIGITS);
    Figure::new(name, value).with_note(format!("at {}", degrees(at.phi)))
}

fn number(name: &str, value: f64, unit: &str) -> Figure {
    Figure::new(name, Value::angle_or(value, unit, DIGITS))
}

/// Names and values, geometry first.
pub(super) fn figures(cam: &DiscCam, found: &CamFigures) -> Vec<Figure> {
    let unit = found.unit;
    let mut rows = vec![
        number("stroke", found.stroke, unit),
        number("base circle", found.base_radius, "m"),
    ];
    if cam.geometry().roller().is_some_and(|roller| roller > 0.0) {
        let name = "prime circle (centre of the roller)";
        rows.push(number(name, found.prime_radius, "m"));
    }
    if let Guide::Turning { .. } = cam.geometry().guide {
        let name = "innermost, from the line of centres";
        rows.push(number(name, found.start, "rad"));
    }
    let (speed, second) = (format!("{unit}/rad"), format!("{unit}/rad²"));
    let [greatest, least] = [
        "greatest acceleration U″, outwards",
        "least acceleration U″",
    ];
    rows.extend([
        extreme("greatest speed U′, outwards", found.speed[0], &speed),
        extreme(greatest, found.acceleration[0], &second),
        extreme(least, found.acceleration[1], &second),
        extreme("greatest pressure angle", found.pressure[1], "rad"),
        extreme("least pressure angle", found.pressure[0], "rad"),
    ]);
    if let Some(pitch) = &found.pitch {
        let names = ["pitch curve, convex from", "pitch curve, concave from"];
        radii(&mut rows, pitch, names);
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
        (None, Some(why)) => rows.push(Figure::new("contact force", format!("not known: {why}"))),
        (None, None) => {}
    }
    rows
}

type Rows = Vec<Figure>;

fn radii(rows: &mut Rows, radii: &Radii, names: [&'static str; 2]) {
    for (name, radius) in names.into_iter().zip([radii.convex, radii.concave]) {
        if let Some(radius) = radius {
            rows.push(Figure::new(name, format!("radius {}", at(radius, "m"))));
        }
    }
}

fn face_rows(rows: &mut Rows, face: &FaceFigures) {
    let ends = format!("{} … {}", at(face.least, "m"), at(face.greatest, "m"));
    rows.push(Figure::new("contact on the face", ends));
    let enough = match face.width {
        Some(width) if width >= face.needed_width => format!("has {}", length(width)),
        Some(width) => format!("HAS ONLY {}", length(width)),
        None => String::new(),
    };
    rows.push(number("width of the face needed", face.needed_width, "m").with_note(enough));
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
        let text = format!("{} for {asked}", ranges(&found.base_for_pressure));
        rows.push(Figure::new(name, text));
    }
    if let Some(best) = found.best_offset {
        let circle = format!("base circle {}", length(best.base_radius));
        rows.push(number("best offset", best.offset, "m").with_note(circle));
    }
    let smooth = ranges(&found.base_for_curvature);
    rows.push(Figure::new("base circles smooth enough", smooth));
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
        rows.push(Figure::new("roller up to", text));
        if let Some(cutter) = roller.cutter {
            let radius = match found.profiles.len() {
                1 => at(cutter, "m"),
                _ => format!("{}, that of the roller", length(cutter.value)),
            };
            let text = format!("radius {radius}");
            rows.push(Figure::new("cutter or grinding wheel up to", text));
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
        (None, Some(why)) => format!("none: {why}"),
        (None, None) => String::new(),
    }
}

pub(super) fn rpm(speed: f64) -> String {
    format!("{} rpm", result(speed * 60.0 / TAU, DIGITS))
}

/// Up to which speed the follower stays in contact; `None` where nothing closes it by force.
pub(super) fn contact(force: &ForceFigures) -> Option<Sentence> {
    let up_to = |speed: f64| {
        Sentence::from(format!(
            "the follower stays in contact up to {}",
            rpm(speed)
        ))
    };
    if let Some(elastic) = &force.elastic {
        return Some(match *elastic {
            LiftOff::At(speed) | LiftOff::Above(speed) => up_to(speed),
            LiftOff::Below(speed) => {
                format!("the follower lifts off even at {}", rpm(speed)).into()
            }
        });
    }
    let rigid = if force.rigid.is_some() {
        ", if it is rigid"
    } else {
        ""
    };
    Some(match force.lets_go? {
        LetsGo::At(found) => up_to(found.value).words(rigid),
        LetsGo::AtRest(_) => "the follower has no contact at rest".into(),
        LetsGo::Never => Sentence::from("the follower stays in contact at any speed").words(rigid),
    })
}

fn force_rows(rows: &mut Rows, force: &ForceFigures) {
    let generalised = force.unit;
    rows.extend([
        Figure::new("speed of the cam", rpm(force.speed)),
        extreme(
            "greatest normal force of the contact",
            force.contact_force,
            "N",
        ),
        extreme(
            "greatest contact force along the follower",
            force.greatest,
            generalised,
        ),
        extreme("least contact force (margin)", force.margin, generalised),
    ]);
    if let Some(pressure) = force.pressure {
        rows.push(extreme("greatest Hertzian pressure", pressure, "Pa"));
    }
    rows.extend([
        extreme("greatest torque of the cam", force.torque, "N m"),
        extreme("least torque of the cam", force.return_torque, "N m"),
    ]);
    let rigid = force.lets_go.map(|lets_go| match lets_go {
        LetsGo::At(found) => format!("{} at {}", rpm(found.value), degrees(found.phi)),
        LetsGo::AtRest(found) => format!("AT REST: {} lacking", at(found, generalised)),
        LetsGo::Never => "at no speed".to_owned(),
    });
    let elastic = force.elastic.map(|lift_off| match lift_off {
        LiftOff::At(speed) => rpm(speed),
        LiftOff::Above(speed) => format!("not up to {}", rpm(speed)),
        LiftOff::Below(speed) => format!("even at {}", rpm(speed)),
    });
    rows.extend(rigid.map(|text| Figure::new("lift-off, rigid", text)));
    rows.extend(elastic.map(|text| Figure::new("lift-off, elastic", text)));
    if let Some(elastic) = &force.elastic_contact {
        elastic_rows(rows, force, elastic);
    }
    if let Some(answer) = &force.closing {
        spring_rows(rows, force, answer);
    }
}

fn elastic_rows(rows: &mut Rows, force: &ForceFigures, elastic: &ElasticFigures) {
    if let Some(margin) = elastic.margin {
        let name = "least contact force, elastic (runs)";
        rows.push(extreme(name, margin, force.unit));
    }
    if let Some(preload) = elastic.preload {
        let name = "preload needed, elastic (runs)";
        rows.push(number(name, clean(preload), force.unit).with_note("without a reserve"));
    }
    for why in &elastic.missing {
        rows.push(Figure::new("elastic contact", format!("not known: {why}")));
    }
}

fn spring_rows(rows: &mut Rows, force: &ForceFigures, answer: &SpringAnswer) {
    let unit = force.spring_unit;
    let rate = if unit == "N m" { "N m/rad" } else { "N/m" };
    let on = force.spring_on.as_ref();
    let on = on.map_or_else(String::new, |id| format!("spring on {id}, "));
    let has = format!(
        "at {} ({}rate {}, has {})",
        degrees(answer.preload.phi),
        on,
        with_unit(force.spring.rate, rate, DIGITS),
        with_unit(force.spring.preload, unit, DIGITS)
    );
    rows.push(number(
        "reserve wanted in contact",
        answer.reserve,
        force.unit,
    ));
    let preload = clean(answer.preload.value);
    rows.push(number("preload needed with this rate", preload, unit).with_note(has));
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
    rows.push(Figure::new("rates that do with this preload", text));
}
