//! Pressure angle, curvature and profiles of closed form.

use super::{eccentric, flat, law, places, translating, turning, zoo};
use crate::kinematics::cam::{CamGeometry, CamState, Contact, DiscCam, Guide};
use crate::kinematics::motion::LawName;
use crate::kinematics::position::{FourBar, Position, SliderCrank};

fn state(cam: &DiscCam, phi: f64) -> CamState {
    let (piece, phi) = cam.motion().piece_at(phi);
    cam.at(piece, phi)
}

fn reference(cam: &DiscCam, phi: f64) -> [f64; 2] {
    let (piece, phi) = cam.motion().piece_at(phi);
    cam.curve_point(piece, phi, 0.0)
}

/// All points of a curve lie on a circle about one point.
#[track_caller]
fn assert_circle(cam: &DiscCam, offset: f64, radius: f64, distance: f64) {
    let points: Vec<[f64; 2]> = (0..60)
        .map(|i| {
            let (piece, phi) = cam.motion().piece_at(f64::from(i) * 0.1047);
            cam.curve_point(piece, phi, offset)
        })
        .collect();
    // The centre lies in the middle of any two points half a turn apart … of a
    // circle through three of them.
    let [a, b, c] = [points[0], points[20], points[40]];
    let square = |p: [f64; 2]| p[0] * p[0] + p[1] * p[1];
    let d = 2.0 * (a[0] * (b[1] - c[1]) + b[0] * (c[1] - a[1]) + c[0] * (a[1] - b[1]));
    let x = (square(a) * (b[1] - c[1]) + square(b) * (c[1] - a[1]) + square(c) * (a[1] - b[1])) / d;
    let y = (square(a) * (c[0] - b[0]) + square(b) * (a[0] - c[0]) + square(c) * (b[0] - a[0])) / d;
    approx::assert_abs_diff_eq!(x.hypot(y), distance, epsilon = 1e-14);
    for p in points {
        let found = (p[0] - x).hypot(p[1] - y);
        approx::assert_abs_diff_eq!(found, radius, epsilon = 2e-15);
    }
}

#[test]
fn an_eccentric_under_a_flat_face_is_a_circle() {
    for (sense, direction) in [(1.0, 1.57), (-1.0, 0.3)] {
        let geometry = CamGeometry {
            contact: flat(0.0, 0.0),
            sense,
            direction,
            ..translating(0.02, 0.0, 0.003)
        };
        let cam = DiscCam::new(&eccentric(0.008), &geometry).unwrap();
        assert_circle(&cam, 0.0, 0.028, 0.008);
        let states = places(&cam).map(|phi| state(&cam, phi));
        for state in states {
            approx::assert_relative_eq!(state.profile_radius, 0.028, max_relative = 1e-14);
        }
        // s′ reaches ± the eccentricity; the follower's line stands at 3 mm.
        let [least, most] = cam.face();
        approx::assert_abs_diff_eq!(least.value, -0.011, epsilon = 1e-15);
        approx::assert_abs_diff_eq!(most.value, 0.005, epsilon = 1e-15);
        approx::assert_relative_eq!(cam.needed_width().unwrap(), 0.022, max_relative = 1e-13);
    }
}

#[test]
fn the_law_of_a_slider_crank_gives_a_round_eccentric() {
    for offset in [0.0, 0.004, -0.007] {
        let linkage = SliderCrank::new(0.01, 0.05, offset, 1.0, 0.4).unwrap();
        let geometry = translating(0.032, 0.008, -offset);
        let cam = DiscCam::new(&Position::SliderCrank(linkage), &geometry).unwrap();
        assert_circle(&cam, 0.0, 0.05, 0.01);
        assert_circle(&cam, -0.008, 0.042, 0.01);
        for phi in places(&cam) {
            let state = state(&cam, phi);
            approx::assert_relative_eq!(state.pitch_radius, 0.05, max_relative = 1e-12);
            // The normal is the rod: sin α = (distance of the crank pin from the line)/rod.
            let across = 0.01 * (phi + 0.4).sin() - offset;
            let along = (0.05f64.powi(2) - across * across).sqrt();
            let expected = (-across / along).atan();
            approx::assert_abs_diff_eq!(state.pressure_angle, expected, epsilon = 1e-13);
        }
    }
}

#[test]
fn the_law_of_a_four_bar_gives_a_round_eccentric() {
    for (branch, against) in [(1.0, 1.0), (-1.0, -1.0)] {
        let linkage = FourBar::new([0.01, 0.045, 0.07, 0.09], branch, 0.2).unwrap();
        let geometry = CamGeometry {
            outward: -branch,
            ..turning(0.027, 0.008, against)
        };
        let cam = DiscCam::new(&Position::FourBar(linkage), &geometry).unwrap();
        assert_circle(&cam, 0.0, 0.045, 0.01);
        assert_circle(&cam, -0.008, 0.037, 0.01);
    }
}

#[test]
fn curvature_is_that_of_the_points() {
    for (name, cam) in zoo() {
        for phi in places(&cam) {
            let h = 2e-4;
            let [a, b, c] = [phi - h, phi, phi + h].map(|phi| reference(&cam, phi));
            let (u, v) = ([b[0] - a[0], b[1] - a[1]], [c[0] - b[0], c[1] - b[1]]);
            let (lu, lv) = (u[0].hypot(u[1]), v[0].hypot(v[1]));
            let chord = (c[0] - a[0]).hypot(c[1] - a[1]);
            // Circle through three points, clockwise curves of a cam that turns
            // counter-clockwise being convex.
            let turn = 2.0 * (u[0] * v[1] - u[1] * v[0]) / (lu * lv * chord);
            let curvature = -cam.geometry().sense * turn;
            let found = 1.0 / state(&cam, phi).pitch_radius;
            assert!(
                (curvature - found).abs() < 2e-4 * found.abs() + 2e-3,
                "{name} at {phi}: {curvature} {found}"
            );
        }
    }
}

#[test]
fn the_pressure_angle_is_that_of_normal_and_velocity() {
    for (name, cam) in zoo() {
        for phi in places(&cam) {
            let now = state(&cam, phi);
            let h = 1e-5;
            let (a, b) = (reference(&cam, phi - h), reference(&cam, phi + h));
            // Into the machine's frame, in which the cam has turned by φ.
            let turn = |p: [f64; 2]| cam.in_cam(p, -phi);
            let along = turn([b[0] - a[0], b[1] - a[1]]);
            let length = along[0].hypot(along[1]);
            let across = (along[0] * now.normal[0] + along[1] * now.normal[1]) / length;
            assert!(
                across.abs() < 1e-7,
                "{name}: the normal stands across the curve"
            );
            let outward = outward(&cam, &now);
            let cosine = now.normal[0] * outward[0] + now.normal[1] * outward[1];
            approx::assert_abs_diff_eq!(cosine, now.pressure_angle.cos(), epsilon = 1e-12);
            let side =
                -cam.geometry().sense * (now.normal[0] * outward[1] - now.normal[1] * outward[0]);
            approx::assert_abs_diff_eq!(side, now.pressure_angle.sin(), epsilon = 1e-12);
        }
    }
}

/// Direction in which the follower's point of contact moves outwards.
fn outward(cam: &DiscCam, state: &CamState) -> [f64; 2] {
    let direction = cam.geometry().direction;
    match cam.geometry().guide {
        Guide::Translating { .. } => [direction.cos(), direction.sin()],
        Guide::Turning {
            centre_distance,
            against,
            ..
        } => {
            let axis = [
                centre_distance * direction.cos(),
                centre_distance * direction.sin(),
            ];
            let arm = [state.point[0] - axis[0], state.point[1] - axis[1]];
            let length = arm[0].hypot(arm[1]);
            let sign = -cam.geometry().sense * against / length;
            [-arm[1] * sign, arm[0] * sign]
        }
    }
}

#[test]
fn virtual_work_gives_the_lever_of_the_force() {
    // A displacement of the follower alone moves its surface along the normal
    // by `lever`: of a roller the centre, of a flat face the line.
    for (name, cam) in zoo() {
        for phi in places(&cam) {
            let now = state(&cam, phi);
            let expected = match (cam.geometry().guide, cam.geometry().contact) {
                (Guide::Translating { .. }, _) => now.pressure_angle.cos(),
                (Guide::Turning { arm, .. }, Contact::Roller { .. } | Contact::KnifeEdge) => {
                    arm * now.pressure_angle.cos()
                }
                (Guide::Turning { .. }, Contact::Flat { .. }) => now.face,
            };
            approx::assert_abs_diff_eq!(now.lever, expected, epsilon = 1e-13);
            assert!(now.lever > 0.0, "{name}");
        }
    }
}

#[test]
fn a_cam_that_cannot_be_is_refused_with_what_can() {
    let position = law(0.012, LawName::Cycloidal, LawName::Cycloidal);
    let refused = |geometry: CamGeometry, path: &str, words: &str| {
        let faults = DiscCam::new(&position, &geometry).unwrap_err();
        assert_eq!(faults[0].path, path, "{faults:?}");
        let said = format!("{} {}", faults[0].message, faults[0].hint);
        assert!(said.contains(words), "{said}");
    };
    refused(
        translating(0.02, 0.005, 0.03),
        "cam.base_radius",
        "above 0.025",
    );
    refused(
        translating(f64::NAN, 0.005, 0.0),
        "cam.base_radius",
        "positive",
    );
    refused(
        turning(0.2, 0.008, 1.0),
        "cam.base_radius",
        "between 0.012 m and 0.152 m",
    );
    let open = CamGeometry {
        range: Some((0.0, 9.0)),
        ..translating(0.02, 0.005, 0.0)
    };
    refused(open, "cam.range", "at most a turn");
    let groove = CamGeometry {
        contact: Contact::KnifeEdge,
        surface: crate::kinematics::cam::Surface::Groove,
        ..translating(0.02, 0.005, 0.0)
    };
    refused(groove, "cam.surface", "roller");
    let spiral = Position::Ratio {
        ratio: 0.01,
        offset: 0.0,
    };
    let faults = DiscCam::new(&spiral, &translating(0.02, 0.005, 0.0)).unwrap_err();
    assert!(faults[0].hint.contains("range"), "{faults:?}");
    let part = CamGeometry {
        range: Some((0.5, 3.0)),
        ..translating(0.02, 0.005, 0.0)
    };
    let cam = DiscCam::new(&spiral, &part).unwrap();
    approx::assert_relative_eq!(cam.motion().stroke(), 0.025, max_relative = 1e-14);
    let wide = law(1.4, LawName::Cycloidal, LawName::Cycloidal);
    let face = CamGeometry {
        contact: flat(0.0, 0.0),
        ..turning(0.05, 0.0, 1.0)
    };
    let faults = DiscCam::new(&wide, &face).unwrap_err();
    assert!(
        faults[0].hint.contains("the stroke may be up to"),
        "{faults:?}"
    );
    let fast = law(1.0, LawName::Cycloidal, LawName::Cycloidal);
    let with = CamGeometry {
        contact: flat(0.0, 0.0),
        ..turning(0.02, 0.0, 1.0)
    };
    let faults = DiscCam::new(&fast, &with).unwrap_err();
    assert!(
        faults[0].message.contains("as fast as the cam"),
        "{faults:?}"
    );
}
