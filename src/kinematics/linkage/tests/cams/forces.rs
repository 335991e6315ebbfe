//! Forces of cams: virtual power, equilibrium of the whole, the sign of pressing.

use super::{CAM, ROLLER, all, cam_and_lever, circle, eccentric, solved};
use crate::kinematics::cam::Surface;
use crate::kinematics::linkage::Linkage;
use crate::kinematics::linkage::kinetostatics::{InputMotion, Kinetostatics, Options, Outcome};
use crate::kinematics::linkage::spec::{AssemblyChoice, CamPairSpec, ForceLaw, LinkSpec, PointOf};
use crate::kinematics::linkage::tests::examples::{Builder, GROUND, four_bar};
use crate::kinematics::linkage::tests::kinetostatics::with_friction;
use crate::kinematics::linkage::tests::support::{check_driving_force, close};
use crate::kinematics::position::PositionSpec;

#[test]
fn driving_forces_are_those_of_virtual_power_and_the_frame_is_in_equilibrium() {
    for (name, spec) in all() {
        check_driving_force(name, spec);
    }
}

#[test]
fn forces_of_a_cam_on_a_coupler_are_those_of_single_links() {
    // scenarios/linkages/cam_on_a_coupler at 60 rpm; figures of tests/reference/linkage_cams.py.
    let slide = Some(3);
    let up = std::f64::consts::FRAC_PI_2;
    let cam = CamPairSpec {
        centre: [0.15, 0.02],
        base_radius: 0.09,
        lift: Some(PositionSpec::Sine {
            amplitude: 0.004,
            harmonic: 3.0,
            phase: 0.0,
            offset: 0.0,
        }),
        ..circle([0.0; 2])
    };
    let mut spec = four_bar([0.05, 0.2, 0.15, 0.18])
        .mass(1, 0.6, [0.1, 0.01], 0.003)
        .choose(1, AssemblyChoice::Branch(1.0));
    spec.0.links.push(LinkSpec {
        name: "slide".to_owned(),
        mass: 2.0,
        ..LinkSpec::default()
    });
    let mut spec = spec
        .slide((GROUND, [0.1, 0.0]), (slide, [0.0; 2]), up, -up)
        .cam([Some(1), slide], cam)
        .choose(
            3,
            AssemblyChoice::Near {
                point: [0.0; 2],
                place: [0.1, 0.22],
            },
        );
    spec.0.gravity = [0.0, -9.80665];
    let linkage = Linkage::new(spec.0).unwrap();
    let solver = Kinetostatics::new(linkage.spec()).unwrap();
    let mut w = solver.workspace();
    let motion = InputMotion {
        coordinate: 1.0,
        speed: std::f64::consts::TAU,
        acceleration: 0.0,
    };
    let at = solved(&linkage, 1.0);
    let options = Options::default();
    solver.solve(&at, motion, &options, &mut w).unwrap();
    let (force, drive) = (solver.coupling_force(0, &w).size, w.driver_force());
    assert!(close(force, 23.109_454_470_913_941, 1e-12, 0.0), "{force}");
    assert!(close(drive, 0.627_556_747_407_697_7, 1e-11, 0.0), "{drive}");
}

/// The force of an eccentric cam on the roller of a lever on which a couple acts.
fn pressed(surface: Surface, couple: f64) -> [f64; 2] {
    let cam = CamPairSpec {
        centre: [0.015, 0.0],
        surface,
        base_radius: match surface {
            Surface::Hollow => 0.07,
            _ => 0.05,
        },
        ..circle(ROLLER)
    };
    let builder = cam_and_lever(cam).force(ForceLaw::Couple { link: 1, couple });
    let Builder(spec) = builder;
    let linkage = Linkage::new(spec).unwrap();
    let solver = Kinetostatics::new(linkage.spec()).unwrap();
    let mut w = solver.workspace();
    let at = solved(&linkage, 0.4);
    let motion = InputMotion {
        coordinate: 0.4,
        ..InputMotion::default()
    };
    solver
        .solve(&at, motion, &Options::default(), &mut w)
        .unwrap();
    // The normal goes through the circle's centre: its lever arm about the pin.
    let point = |link, at| PointOf { link, at };
    let [centre, roller] = [point(CAM, [0.015, 0.0]), point(Some(1), ROLLER)]
        .map(|of| at.point(of).map(|jet| jet.value));
    let [nx, ny] = [roller[0] - centre[0], roller[1] - centre[1]].map(|x| x / 0.06);
    let arm = (roller[0] - 0.1) * ny - roller[1] * nx;
    [solver.coupling_force(0, &w).size, -couple / arm]
}

#[test]
fn a_cam_presses_its_roller_outwards_and_a_hollow_one_inwards() {
    // The lever lies above the cam and leans to the left of its pin: a couple counterclockwise
    // presses the roller on the disc.
    for surface in [Surface::Disc, Surface::Groove] {
        let [found, wanted] = pressed(surface, 3.0);
        assert!(found > 0.0 && close(found, wanted, 1e-12, 0.0), "{found}");
    }
    let [found, wanted] = pressed(Surface::Hollow, 3.0);
    assert!(found < 0.0 && close(found, -wanted, 1e-12, 0.0), "{found}");
    assert!(pressed(Surface::Disc, -3.0)[0] < 0.0);
}

#[test]
fn friction_of_the_pairs_takes_what_the_driver_gives_more() {
    let spec = with_friction(super::weighed(eccentric()).0, 0.05);
    let linkage = Linkage::new(spec).unwrap();
    let solver = Kinetostatics::new(linkage.spec()).unwrap();
    let mut w = solver.workspace();
    let (coordinate, speed, acceleration) = (0.9, 1.7, -2.3);
    let motion = InputMotion {
        coordinate,
        speed,
        acceleration,
    };
    let at = solved(&linkage, coordinate);
    let options = Options::default();
    solver.solve(&at, motion, &options, &mut w).unwrap();
    let balance = solver.balance(&w);
    assert!(balance.loss > 0.0 && balance.residual < 1e-9, "{balance:?}");
    let drive = w.driver_force();
    let back = solver.accelerate(&at, coordinate, speed, drive, &options, &mut w);
    let Outcome::Moves {
        acceleration: found,
    } = back.unwrap().outcome
    else {
        panic!("it stands");
    };
    assert!(close(found, acceleration, 1e-8, 1e-9), "{found}");
}
