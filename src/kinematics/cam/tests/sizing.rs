//! Sizes against the definition and against brute force.

use super::{eccentric, flat, law, translating, turning};
use crate::kinematics::cam::sizing::PressureLimits;
use crate::kinematics::cam::{CamGeometry, DiscCam};
use crate::kinematics::motion::LawName;

fn limits(outward: f64, inward: f64) -> PressureLimits {
    PressureLimits {
        outward: outward.to_radians(),
        inward: inward.to_radians(),
    }
}

/// Greatest pressure angle outwards and inwards, looked at densely (deg).
fn pressures(cam: &DiscCam) -> [f64; 2] {
    let mut worst = [0.0f64; 2];
    for step in 0..40_000 {
        let (piece, phi) = cam.motion().piece_at(f64::from(step) * 1.570_796e-4);
        let state = cam.at(piece, phi);
        let side = usize::from(state.first < 0.0);
        if state.first != 0.0 {
            worst[side] = worst[side].max(state.pressure_angle.abs().to_degrees());
        }
    }
    worst
}

#[test]
fn the_least_base_circle_just_keeps_the_pressure_angle() {
    let position = law(0.02, LawName::ModifiedSine, LawName::Cycloidal);
    for (offset, out, back) in [(0.0, 30.0, 30.0), (0.005, 30.0, 45.0), (-0.004, 25.0, 40.0)] {
        let cam = DiscCam::new(&position, &translating(0.05, 0.008, offset)).unwrap();
        let range = cam.base_for_pressure(limits(out, back)).unwrap()[0];
        assert_eq!(range.to, None);
        let geometry = translating(range.from, 0.008, offset);
        let [a, b] = pressures(&DiscCam::new(&position, &geometry).unwrap());
        let tight = (a / out).max(b / back);
        assert!((tight - 1.0).abs() < 1e-6, "{a} {b}");
    }
}

#[test]
fn no_other_offset_allows_a_smaller_base_circle() {
    let position = law(0.02, LawName::ModifiedSine, LawName::Cycloidal);
    let cam = DiscCam::new(&position, &translating(0.05, 0.008, 0.0)).unwrap();
    let limits = limits(30.0, 45.0);
    let best = cam.best_offset(limits).unwrap();
    let mut least = (f64::INFINITY, 0.0);
    for step in -400..=400 {
        let offset = f64::from(step) * 5e-5;
        let cam = DiscCam::new(&position, &translating(0.05, 0.008, offset)).unwrap();
        let base = cam.base_for_pressure(limits).unwrap()[0].from;
        if base < least.0 {
            least = (base, offset);
        }
    }
    assert!(best.base_radius <= least.0 + 1e-12, "{best:?} {least:?}");
    assert!(
        (best.offset - least.1).abs() < 1e-4 && best.offset > 1e-3,
        "{best:?} {least:?}"
    );
    // Equal slopes and limits both ways: none is best.
    let cam = DiscCam::new(&eccentric(0.01), &translating(0.05, 0.008, 0.0)).unwrap();
    let even = cam.best_offset(self::limits(30.0, 30.0)).unwrap();
    assert_eq!(even.offset, 0.0);
    // tan α = a·sin φ/(s₀ + a − a·cos φ) is greatest, a/√((s₀ + a)² − a²), at cos φ = a/(s₀ + a).
    let (a, tangent) = (0.01f64, 30f64.to_radians().tan());
    let expected = a * (1.0 + 1.0 / (tangent * tangent)).sqrt() - a - 0.008;
    approx::assert_relative_eq!(even.base_radius, expected, max_relative = 1e-9);
    let flat = CamGeometry {
        contact: flat(0.0, 0.0),
        ..translating(0.05, 0.0, 0.0)
    };
    let cam = DiscCam::new(&position, &flat).unwrap();
    assert!(cam.best_offset(limits).is_err());
}

#[test]
fn base_circles_of_a_turning_follower_form_an_interval_or_there_is_none() {
    let position = law(0.35, LawName::ModifiedSine, LawName::Cycloidal);
    let cam = DiscCam::new(&position, &turning(0.04, 0.008, 1.0)).unwrap();
    let limits = limits(40.0, 45.0);
    let ranges = cam.base_for_pressure(limits).unwrap();
    assert_eq!(ranges.len(), 1);
    let (from, to) = (ranges[0].from, ranges[0].to.unwrap());
    for (radius, within) in [
        (from * 0.999, false),
        (from * 1.001, true),
        (to * 0.999, true),
        (to * 1.001, false),
    ] {
        let cam = DiscCam::new(&position, &turning(radius, 0.008, 1.0)).unwrap();
        let [a, b] = pressures(&cam);
        assert_eq!(a < 40.0 && b < 45.0, within, "{radius}: {a} {b}");
        assert_eq!(cam.pressure_excess(limits).is_none(), within);
    }
    let fault = cam.base_for_pressure(self::limits(5.0, 5.0)).unwrap_err();
    let least: f64 = fault
        .hint
        .trim_start_matches("the least that can be had here is ")
        .split(' ')
        .next()
        .unwrap()
        .parse()
        .unwrap();
    assert!(least > 5.0 && least < 40.0, "{}", fault.hint);
    assert!(cam.base_for_pressure(self::limits(0.0, 5.0)).is_err());
}

#[test]
fn the_roller_is_limited_by_the_sharpest_place_of_the_pitch_curve() {
    let position = law(0.012, LawName::Cycloidal, LawName::Cycloidal);
    for against in [1.0, -1.0, 0.0] {
        let (position, geometry) = match against {
            0.0 => (position.clone(), translating(0.03, 0.008, 0.002)),
            _ => (
                law(0.3, LawName::Cycloidal, LawName::Cycloidal),
                turning(0.03, 0.008, against),
            ),
        };
        let cam = DiscCam::new(&position, &geometry).unwrap();
        let found = cam.roller_limits(0.7).unwrap();
        let cusp = found.cusp.unwrap();
        let mut least = f64::INFINITY;
        let mut hollow = f64::INFINITY;
        for step in 0..40_000 {
            let (piece, phi) = cam.motion().piece_at(f64::from(step) * 1.570_796e-4);
            let radius = cam.at(piece, phi).pitch_radius;
            if radius > 0.0 {
                least = least.min(radius);
            } else {
                hollow = hollow.min(-radius + 0.008);
            }
        }
        assert!(
            cusp.value <= least && cusp.value > least * (1.0 - 1e-6),
            "{cusp:?} {least}"
        );
        assert_eq!(found.advised, Some(0.7 * cusp.value));
        match found.cutter {
            Some(cutter) => assert!((cutter.value / hollow - 1.0).abs() < 1e-6),
            None => assert_eq!(hollow, f64::INFINITY),
        }
    }
}

#[test]
fn the_least_base_circle_for_a_roller_just_keeps_its_share() {
    let position = law(0.02, LawName::Cycloidal, LawName::Cycloidal);
    let cam = DiscCam::new(&position, &translating(0.02, 0.012, 0.003)).unwrap();
    let ranges = cam.base_for_curvature(0.0, 0.7).unwrap();
    let last = ranges.last().unwrap();
    assert_eq!(last.to, None);
    let cam = DiscCam::new(&position, &translating(last.from, 0.012, 0.003)).unwrap();
    let cusp = cam.roller_limits(0.7).unwrap().cusp.unwrap();
    approx::assert_relative_eq!(cusp.value, 0.012 / 0.7, max_relative = 1e-9);
}
