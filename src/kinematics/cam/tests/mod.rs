//! Cams against closed forms and independent constructions.

mod closing;
mod curves;
mod kinematics;
mod pressing;
mod sizing;

use super::{CamGeometry, Contact, DiscCam, Guide, Surface};
use crate::kinematics::motion::LawName;
use crate::kinematics::position::{CamSpec, Position, PositionSpec};
use std::f64::consts::FRAC_PI_2;

/// A translating follower with a roller on a disc that turns counter-clockwise.
pub(super) fn translating(base_radius: f64, roller: f64, offset: f64) -> CamGeometry {
    CamGeometry {
        base_radius,
        guide: Guide::Translating { offset },
        contact: Contact::Roller { radius: roller },
        surface: Surface::Disc,
        outward: 1.0,
        sense: 1.0,
        direction: FRAC_PI_2,
        range: None,
        material: None,
    }
}

/// A turning follower with a roller: centre distance 90 mm, arm 70 mm.
pub(super) fn turning(base_radius: f64, roller: f64, against: f64) -> CamGeometry {
    CamGeometry {
        guide: Guide::Turning {
            centre_distance: 0.09,
            arm: 0.07,
            against,
        },
        direction: 0.0,
        ..translating(base_radius, roller, 0.0)
    }
}

pub(super) fn flat(inclination: f64, face_offset: f64) -> Contact {
    Contact::Flat {
        inclination,
        face_offset,
        width: None,
    }
}

/// Rise of 120 deg, dwell of 40 deg, return of 100 deg.
pub(super) fn law(lift: f64, rise: LawName, back: LawName) -> Position {
    let spec = CamSpec {
        lift,
        rise: 120f64.to_radians(),
        dwell: 40f64.to_radians(),
        return_angle: 100f64.to_radians(),
        rise_law: rise.into(),
        return_law: back.into(),
        phase: 0.3,
    };
    Position::new(&PositionSpec::Cam(spec)).unwrap()
}

/// One sine wave of amplitude a, lowest at φ = 0.
pub(super) fn eccentric(amplitude: f64) -> Position {
    Position::Sine {
        amplitude,
        harmonic: 1.0,
        phase: -FRAC_PI_2,
        offset: 0.7,
    }
}

/// Every kind of follower, on a law without shocks.
pub(super) fn zoo() -> Vec<(&'static str, DiscCam)> {
    let length = law(0.012, LawName::Polynomial4567, LawName::ModifiedSine);
    let angle = law(0.3, LawName::Cycloidal, LawName::Polynomial345);
    let mut list = Vec::new();
    let mut add = |name, position: &Position, geometry: &CamGeometry| {
        list.push((name, DiscCam::new(position, geometry).unwrap()));
    };
    let plain = translating(0.03, 0.008, 0.006);
    add("translating roller", &length, &plain);
    let clockwise = CamGeometry {
        sense: -1.0,
        direction: 0.4,
        ..plain.clone()
    };
    add("clockwise", &length, &clockwise);
    let inwards = CamGeometry {
        outward: -1.0,
        ..plain.clone()
    };
    add("inwards", &length, &inwards);
    let edge = CamGeometry {
        contact: Contact::KnifeEdge,
        ..plain.clone()
    };
    add("knife edge", &length, &edge);
    let hollow = CamGeometry {
        surface: Surface::Hollow,
        base_radius: 0.046,
        ..plain.clone()
    };
    add("hollow", &length, &hollow);
    let face = CamGeometry {
        contact: flat(0.0, 0.0),
        ..plain.clone()
    };
    add("flat", &length, &face);
    let inclined = CamGeometry {
        contact: flat(0.2, 0.0),
        sense: -1.0,
        ..plain
    };
    add("inclined flat", &length, &inclined);
    add("turning against", &angle, &turning(0.03, 0.008, 1.0));
    let with = CamGeometry {
        sense: -1.0,
        direction: -0.7,
        ..turning(0.03, 0.008, -1.0)
    };
    add("turning with", &angle, &with);
    let face = CamGeometry {
        contact: flat(0.0, 0.01),
        ..turning(0.04, 0.0, 1.0)
    };
    add(
        "turning flat against",
        &law(0.12, LawName::Cycloidal, LawName::Cycloidal),
        &face,
    );
    let face = CamGeometry {
        contact: flat(0.0, -0.004),
        sense: -1.0,
        ..turning(0.05, 0.0, -1.0)
    };
    add(
        "turning flat with",
        &law(0.1, LawName::Cycloidal, LawName::Cycloidal),
        &face,
    );
    list
}

/// Places all over the turn, away from joints.
pub(super) fn places(cam: &DiscCam) -> impl Iterator<Item = f64> + '_ {
    cam.motion().pieces().iter().flat_map(|piece| {
        let span = piece.to - piece.from;
        [0.11, 0.37, 0.52, 0.83].map(|share| piece.from + share * span)
    })
}
