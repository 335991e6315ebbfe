//! Polygons, undercuts and loops; rolling the follower on the polygon.

use super::{eccentric, flat, law, places, translating, zoo};
use crate::kinematics::cam::{CamGeometry, Contact, DiscCam, Finding, Guide, Polygon, Surface};
use crate::kinematics::motion::LawName;
use crate::kinematics::position::Position;

fn distance_to_side(p: [f64; 2], a: [f64; 2], b: [f64; 2]) -> f64 {
    let (u, w) = ([b[0] - a[0], b[1] - a[1]], [p[0] - a[0], p[1] - a[1]]);
    let share = (u[0] * w[0] + u[1] * w[1]) / (u[0] * u[0] + u[1] * u[1]);
    let share = share.clamp(0.0, 1.0);
    (w[0] - share * u[0]).hypot(w[1] - share * u[1])
}

fn distance(polygon: &Polygon, p: [f64; 2]) -> f64 {
    let count = polygon.points.len();
    let side = |i: usize| distance_to_side(p, polygon.points[i], polygon.points[(i + 1) % count]);
    (0..count).map(side).fold(f64::INFINITY, f64::min)
}

#[test]
fn chords_keep_their_tolerance_and_do_not_waste_it() {
    for (name, cam) in zoo() {
        for tolerance in [1e-4, 1e-6] {
            let offset = cam.geometry().flanks()[0];
            let polygon = cam.polygon(offset, tolerance).unwrap();
            let mut worst = 0.0f64;
            for piece in cam.motion().pieces() {
                for step in 0..=200 {
                    let phi = piece.from + (piece.to - piece.from) * f64::from(step) / 200.0;
                    let p = cam.curve_point(piece, phi, offset);
                    worst = worst.max(distance(&polygon, p));
                }
            }
            assert!(worst <= tolerance, "{name}: {worst} of {tolerance}");
            if tolerance < 1e-5 {
                assert!(worst > 0.2 * tolerance, "{name}: {worst} of {tolerance}");
                assert!(
                    polygon.points.len() < 2000,
                    "{name}: {}",
                    polygon.points.len()
                );
            }
        }
    }
    let cam = &zoo()[0].1;
    assert!(cam.polygon(0.0, 0.0).is_err());
    assert!(
        cam.polygon(0.0, 1e-16)
            .unwrap_err()
            .message
            .contains("points")
    );
}

/// Signed distance of the follower from the polygon when it stands `shift`
/// further out than its law says: positive when clear of the cam.
fn clearance(cam: &DiscCam, polygon: &Polygon, phi: f64, shift: f64) -> f64 {
    let (piece, phi) = cam.motion().piece_at(phi);
    let now = cam.at(piece, phi);
    let points = polygon.points.iter().map(|p| cam.in_cam(*p, -phi));
    let direction = cam.geometry().direction;
    let axis = match cam.geometry().guide {
        Guide::Turning {
            centre_distance, ..
        } => [
            centre_distance * direction.cos(),
            centre_distance * direction.sin(),
        ],
        Guide::Translating { .. } => [0.0; 2],
    };
    let moved = |p: [f64; 2]| match cam.geometry().guide {
        Guide::Translating { .. } => [
            p[0] + shift * direction.cos(),
            p[1] + shift * direction.sin(),
        ],
        Guide::Turning { against, .. } => {
            let angle: f64 = -cam.geometry().sense * against * shift;
            let (sin, cos) = angle.sin_cos();
            let (x, y) = (p[0] - axis[0], p[1] - axis[1]);
            [axis[0] + x * cos - y * sin, axis[1] + x * sin + y * cos]
        }
    };
    match cam.geometry().roller() {
        Some(roller) => {
            let centre = moved(now.point);
            let turned: Vec<[f64; 2]> = points.collect();
            let free = distance(
                &Polygon {
                    points: turned,
                    ..polygon.clone()
                },
                centre,
            ) - roller;
            match cam.geometry().surface {
                Surface::Hollow => -free,
                _ => free,
            }
        }
        None => {
            // The face is the line through its point across the normal, turned with it.
            let (a, tip) = (
                now.point,
                [now.point[0] + now.normal[0], now.point[1] + now.normal[1]],
            );
            let (a, tip) = (moved(a), moved(tip));
            let n = [tip[0] - a[0], tip[1] - a[1]];
            let depth = |p: [f64; 2]| (a[0] - p[0]) * n[0] + (a[1] - p[1]) * n[1];
            points.map(depth).fold(f64::INFINITY, f64::min)
        }
    }
}

#[test]
fn a_follower_rolled_on_the_polygon_gives_its_law_back() {
    let tolerance = 1e-7;
    for (name, cam) in zoo() {
        if cam.geometry().contact == Contact::KnifeEdge {
            continue;
        }
        let polygon = cam.polygon(cam.geometry().flanks()[0], tolerance).unwrap();
        for phi in places(&cam).step_by(3) {
            let (piece, place) = cam.motion().piece_at(phi);
            let lever = cam.at(piece, place).lever;
            let step = 2.0 * tolerance / lever;
            let sides = [step, -step].map(|shift| clearance(&cam, &polygon, phi, shift));
            let (free, pressed) = match cam.geometry().surface {
                Surface::Hollow => (sides[1], sides[0]),
                _ => (sides[0], sides[1]),
            };
            let (free, pressed) = match cam.geometry().surface {
                Surface::Hollow => (-free, -pressed),
                _ => (free, pressed),
            };
            assert!(
                free > 0.0 && pressed < 0.0,
                "{name} at {phi}: {free} {pressed}"
            );
        }
    }
}

#[test]
fn an_undercut_is_found_where_the_roller_is_greater_than_the_pitch_radius() {
    let position = law(0.02, LawName::Cycloidal, LawName::Cycloidal);
    let cam = DiscCam::new(&position, &translating(0.002, 0.03, 0.0)).unwrap();
    let found = cam.findings();
    let undercuts: Vec<[f64; 2]> = found
        .iter()
        .filter_map(|finding| match finding {
            Finding::Undercut { from, to, .. } => Some([*from, *to]),
            _ => None,
        })
        .collect();
    assert!(!undercuts.is_empty());
    for &[from, to] in &undercuts {
        for phi in [from, to] {
            let (piece, phi) = cam.motion().piece_at(phi);
            approx::assert_relative_eq!(cam.at(piece, phi).pitch_radius, 0.03, max_relative = 1e-9);
        }
    }
    // Densely looked at, the pitch radius is below the roller's there alone.
    for step in 0..20_000 {
        let phi = f64::from(step) * std::f64::consts::TAU / 20_000.0;
        let (piece, phi) = cam.motion().piece_at(phi);
        let radius = cam.at(piece, phi).pitch_radius;
        let sharp = radius > 0.0 && radius < 0.03;
        let inside = undercuts.iter().any(|[from, to]| {
            (*from..=*to).contains(&phi)
                || *from <= phi + std::f64::consts::TAU && phi + std::f64::consts::TAU <= *to
        });
        assert_eq!(sharp, inside, "{phi}");
    }
    // The loop is cut off where the profile crosses itself: both branches meet.
    let crossings = found.iter().filter_map(|finding| match finding {
        Finding::Crossing { phi, .. } => Some(*phi),
        _ => None,
    });
    let crossings: Vec<[f64; 2]> = crossings.collect();
    assert!(!crossings.is_empty());
    for phi in crossings {
        let [p, q] = phi.map(|phi| {
            let (piece, phi) = cam.motion().piece_at(phi);
            cam.curve_point(piece, phi, -0.03)
        });
        assert!((p[0] - q[0]).hypot(p[1] - q[1]) < 1e-12, "{p:?} {q:?}");
    }
    let sound = DiscCam::new(&position, &translating(0.05, 0.012, 0.0)).unwrap();
    assert!(sound.findings().is_empty(), "{:?}", sound.findings());
}

#[test]
fn a_flat_face_needs_a_convex_profile() {
    let position = law(0.03, LawName::Cycloidal, LawName::Cycloidal);
    let geometry = CamGeometry {
        contact: flat(0.0, 0.0),
        ..translating(0.03, 0.0, 0.0)
    };
    let cam = DiscCam::new(&position, &geometry).unwrap();
    assert!(
        cam.findings()
            .iter()
            .any(|f| matches!(f, Finding::Undercut { .. }))
    );
    let ranges = cam.base_for_curvature(0.005, 1.0).unwrap();
    let enough = CamGeometry {
        base_radius: ranges[0].from,
        ..geometry
    };
    let cam = DiscCam::new(&position, &enough).unwrap();
    let least = cam.curvature_extremes()[0].value;
    approx::assert_relative_eq!(least, 0.005, max_relative = 1e-11);
    assert!(cam.findings().is_empty());
}

#[test]
fn soft_shocks_and_corners_are_listed_with_both_sides() {
    let position = law(0.01, LawName::Parabolic, LawName::Cycloidal);
    let cam = DiscCam::new(&position, &translating(0.04, 0.006, 0.0)).unwrap();
    let shocks: Vec<f64> = cam
        .findings()
        .iter()
        .filter_map(|finding| match finding {
            Finding::Shock { at, radius, second } => {
                assert!(radius[0] != radius[1] && second[0] != second[1]);
                Some(*at)
            }
            _ => None,
        })
        .collect();
    assert_eq!(
        shocks.len(),
        3,
        "start, middle and end of the rise: {shocks:?}"
    );
    // Straight lines between points: a corner at each.
    let saw = Position::Plan(Box::new(
        crate::kinematics::motion::Cycle::new(&crate::kinematics::motion::CycleSpec {
            stations: [(0.0, 0.0), (3.0, 0.01), (std::f64::consts::TAU, 0.0)]
                .map(
                    |(at, displacement)| crate::kinematics::motion::cycle::Station {
                        at,
                        displacement,
                        speed: None,
                        acceleration: None,
                        order: 2,
                        motion: crate::kinematics::motion::cycle::Motion::Uniform,
                    },
                )
                .to_vec(),
            period: Some(std::f64::consts::TAU),
            ..Default::default()
        })
        .unwrap(),
    ));
    let cam = DiscCam::new(&saw, &translating(0.04, 0.006, 0.0)).unwrap();
    let corners: Vec<(f64, bool)> = cam
        .findings()
        .iter()
        .filter_map(|finding| match finding {
            Finding::Corner { turn, undercut, .. } => Some((*turn, *undercut)),
            _ => None,
        })
        .collect();
    assert_eq!(corners.len(), 2);
    assert!(
        corners[0].0 > 0.0 && corners[0].1,
        "the top is convex: {corners:?}"
    );
    assert!(
        corners[1].0 < 0.0 && !corners[1].1,
        "the foot is hollow: {corners:?}"
    );
    // The roller rests in the hollow corner: an arc of its radius.
    let polygon = cam.polygon(-0.006, 1e-6).unwrap();
    let (piece, _) = cam.motion().piece_at(0.0);
    let centre = cam.curve_point(piece, 0.0, 0.0);
    let arc = polygon.points.iter().zip(&polygon.angles);
    let arc: Vec<_> = arc
        .filter(|(_, phi)| **phi == std::f64::consts::TAU)
        .collect();
    assert!(arc.len() > 3, "{}", arc.len());
    for (p, _) in arc {
        let distance = (p[0] - centre[0]).hypot(p[1] - centre[1]);
        approx::assert_relative_eq!(distance, 0.006, max_relative = 1e-12);
    }
}

#[test]
fn the_path_of_a_cutter_stands_off_the_profile() {
    let cam = DiscCam::new(&eccentric(0.008), &translating(0.03, 0.008, 0.004)).unwrap();
    let cutter = 0.012;
    for phi in places(&cam) {
        let (piece, phi) = cam.motion().piece_at(phi);
        let (p, q) = (
            cam.curve_point(piece, phi, -0.008),
            cam.curve_point(piece, phi, cutter - 0.008),
        );
        approx::assert_relative_eq!(
            (p[0] - q[0]).hypot(p[1] - q[1]),
            cutter,
            max_relative = 1e-12
        );
    }
}
