//! Geometry that no cam can have.

use super::spec::{CamGeometry, Contact, Guide, Surface};
use crate::fault::Faults;
use crate::units::shown;
use std::f64::consts::FRAC_PI_2;

/// Numbers out of range, and combinations that no follower has.
pub(super) fn check_numbers(geometry: &CamGeometry, faults: &mut Faults) {
    faults.positive("cam.base_radius", geometry.base_radius);
    faults.finite("cam.direction", geometry.direction);
    match geometry.guide {
        Guide::Translating { offset } => faults.finite("cam.offset", offset),
        Guide::Turning {
            centre_distance,
            arm,
            ..
        } => {
            faults.positive("cam.centre_distance", centre_distance);
            if geometry.roller().is_some() {
                faults.positive("cam.arm", arm);
            }
        }
    }
    match geometry.contact {
        Contact::Roller { radius } => {
            faults.positive("cam.contact.roller", radius);
            if geometry.surface == Surface::Hollow && radius >= geometry.base_radius {
                let message = "the roller does not fit into the hollow cam's base circle";
                let hint = format!("give a radius below {} m", geometry.base_radius);
                faults.add("cam.contact.roller", message, &hint);
            }
        }
        Contact::KnifeEdge => {}
        Contact::Flat {
            inclination,
            face_offset,
            width,
        } => {
            faults.finite("cam.contact.flat.face_offset", face_offset);
            if inclination.is_nan() || inclination.abs() >= FRAC_PI_2 {
                let message = "a face along the direction of motion cannot be pushed";
                let hint = "give an inclination between -90 and 90 deg";
                faults.add("cam.contact.flat.inclination", message, hint);
            }
            if let Some(width) = width {
                faults.positive("cam.contact.flat.width", width);
            }
        }
    }
    if geometry.surface != Surface::Disc && !matches!(geometry.contact, Contact::Roller { .. }) {
        let message = "only a roller can run in a groove or inside a hollow cam";
        faults.add(
            "cam.surface",
            message,
            "give a roller, or the surface `disc`",
        );
    }
}

/// A length as people read it, be it ever so great or small.
fn length(value: f64) -> String {
    format!("{} m", shown(value, 12))
}

/// Says which base circles the follower can reach.
pub(super) fn refuse_start(geometry: &CamGeometry, faults: &mut Faults) {
    let base = length(geometry.base_radius);
    let shift = geometry.base_radius - geometry.prime_radius();
    match (geometry.guide, geometry.contact) {
        (Guide::Translating { offset }, _) => {
            let message = format!(
                "with an offset of {} the follower does not reach the base circle of {base}",
                length(offset)
            );
            let hint = format!(
                "give a base radius above {}, or an offset below {}",
                length(offset.abs() + shift),
                length(geometry.prime_radius())
            );
            faults.add("cam.base_radius", message, &hint);
        }
        (
            Guide::Turning {
                centre_distance, ..
            },
            Contact::Flat { face_offset, .. },
        ) => {
            let message = format!("the face does not reach a base circle of {base}");
            let (low, high) = ((-face_offset).max(0.0), centre_distance - face_offset);
            let hint = format!(
                "give a base radius between {} and {}",
                length(low),
                length(high)
            );
            faults.add("cam.base_radius", message, &hint);
        }
        (
            Guide::Turning {
                centre_distance,
                arm,
                ..
            },
            _,
        ) => {
            let message = format!(
                "an arm of {} on an axis {} away does not reach the base circle of {base}",
                length(arm),
                length(centre_distance)
            );
            let (low, high) = ((centre_distance - arm).abs(), centre_distance + arm);
            let hint = format!(
                "give a base radius between {} and {}",
                length((low + shift).max(0.0)),
                length(high + shift)
            );
            faults.add("cam.base_radius", message, &hint);
        }
    }
}
