//! What is wrong with cams and what is hardly meant: profiles that do not close, jumps, undercuts.
//!
//! A profile is refused if it does not close, jumps in its second derivative, or does not go
//! round its centre. An undercut is a remark.

use super::CamPairSpec;
use super::pitch::PitchCurve;
use crate::fault::Faults;
use crate::units::shown;
use std::f64::consts::TAU;

/// Angles at which radius and curvature are looked at.
const PLACES: u32 = 3600;
/// A difference of this part of the prime radius is rounding.
const CLOSED: f64 = 1e-9;
/// A jump of the second derivative of this part of the prime radius is rounding.
const SMOOTH: f64 = 1e-6;

/// Everything wrong with a cam for itself.
pub(super) fn check(spec: &CamPairSpec, path: &str, faults: &mut Faults) {
    let before = faults.len();
    faults.positive(&format!("{path}.base_radius"), spec.base_radius);
    faults.not_negative(&format!("{path}.roller_radius"), spec.roller_radius);
    faults.finite(&format!("{path}.direction"), spec.direction);
    for coordinate in spec.centre.into_iter().chain(spec.roller) {
        faults.finite(path, coordinate);
    }
    if spec.sense != 1.0 && spec.sense != -1.0 {
        let message = format!("{} is no sense of turning", spec.sense);
        faults.add(format!("{path}.sense"), message, "give +1 or -1");
    }
    if faults.len() > before {
        return;
    }
    if !(spec.prime_radius() > 0.0) {
        let message = format!(
            "a roller of {} m does not fit into a hollow cam of {} m",
            shown(spec.roller_radius, 6),
            shown(spec.base_radius, 6)
        );
        let hint = "give a smaller roller, or a greater base circle";
        faults.add(format!("{path}.roller_radius"), message, hint);
        return;
    }
    match PitchCurve::new(spec) {
        Ok(curve) => check_shape(spec, &curve, path, faults),
        Err(found) => faults.absorb(&format!("{path}.lift"), found),
    }
}

/// The angles φ that are looked at.
fn angles() -> impl Iterator<Item = f64> {
    (0..PLACES).map(|place| TAU * f64::from(place) / f64::from(PLACES))
}

fn degrees(angle: f64) -> String {
    shown(angle.to_degrees(), 6)
}

/// The pitch curve closes, is smooth and goes round its centre.
fn check_shape(spec: &CamPairSpec, curve: &PitchCurve, path: &str, faults: &mut Faults) {
    let size = spec.prime_radius();
    let path = format!("{path}.lift");
    let open = |&phi: &f64| {
        let [here, there] = [phi, phi + TAU].map(|phi| curve.lift(phi, 1.0).value);
        !((here - there).abs() <= CLOSED * (size + here.abs()))
    };
    if let Some(phi) = angles().find(open) {
        let [here, there] = [phi, phi + TAU].map(|phi| shown(curve.lift(phi, 1.0).value, 6));
        let message = format!(
            "the lift does not repeat after a turn: {here} m at {} deg, {there} m a turn later",
            degrees(phi)
        );
        let hint = "give a law with the period of a turn: a `table` with `periodic` over 360 deg, \
                    a `sine` with whole oscillations, or a `plan` with a `period` of 360 deg";
        faults.add(path, message, hint);
        return;
    }
    for &phi in &curve.breaks().points {
        let [before, after] = [-1.0, 1.0].map(|way| curve.lift(phi, way));
        let jumps = |&(jump, rounding, _): &(f64, f64, &str)| !(jump.abs() <= rounding * size);
        let found = [
            (after.value - before.value, CLOSED, "lift"),
            (after.first - before.first, SMOOTH, "first derivative"),
            (after.second - before.second, SMOOTH, "second derivative"),
        ]
        .into_iter()
        .find(jumps);
        if let Some((_, _, what)) = found {
            let message = format!("the {what} of the lift jumps at {} deg", degrees(phi));
            let hint =
                "choose laws without a jump of the acceleration, such as `cycloidal` or `3-4-5`";
            faults.add(path, message, hint);
            return;
        }
    }
    let small = |&phi: &f64| !(size + curve.lift(phi, 1.0).value > 0.0);
    if let Some(phi) = angles().find(small) {
        let message = format!(
            "at {} deg the pitch curve does not pass round its centre: its radius is {} m",
            degrees(phi),
            shown(size + curve.lift(phi, 1.0).value, 6)
        );
        let hint = "give a greater `base_radius`, or a lift that goes less far inwards";
        faults.add(path, message, hint);
    }
}

/// Where a roller is too great for the curvature of its pitch curve: there the profile has a
/// corner, and the roller leaves the pitch curve.
pub(super) fn undercut(spec: &CamPairSpec, name: &str) -> Option<String> {
    let curve = PitchCurve::new(spec).ok()?;
    let flanks = spec.surface.flanks(spec.roller_radius);
    let all = flanks
        .iter()
        .flat_map(|&offset| angles().map(move |phi| (offset, phi)));
    let left = |(offset, phi): (f64, f64)| 1.0 + offset * curve.curvature(curve.polar(phi));
    let worst = all.min_by(|&one, &other| left(one).total_cmp(&left(other)))?;
    if left(worst) > 0.0 {
        return None;
    }
    let radius = curve.curvature(curve.polar(worst.1)).abs().recip();
    Some(format!(
        "the cam of `{}` is undercut at {} deg: there its pitch curve has a radius of curvature of {} m, \
         the roller one of {} m",
        name,
        degrees(worst.1),
        shown(radius, 4),
        shown(spec.roller_radius, 4)
    ))
}
