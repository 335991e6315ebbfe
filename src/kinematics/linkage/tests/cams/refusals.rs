//! Cams that cannot be, and those that are hardly meant so.

use super::{CAM, ROLLER, cam_and_lever, circle, eccentric, linkage, rise_and_return};
use crate::kinematics::cam::Surface;
use crate::kinematics::linkage::Linkage;
use crate::kinematics::linkage::spec::{CamPairSpec, CouplingKind, LinkageSpec};
use crate::kinematics::motion::LawName;
use crate::kinematics::position::PositionSpec;

/// What is wrong with an eccentric cam that is changed.
fn refused(change: impl Fn(&mut LinkageSpec, &mut CamPairSpec)) -> String {
    let mut spec = eccentric().0;
    let CouplingKind::Cam(mut cam) = spec.couplings[0].kind.clone() else {
        panic!("it is a cam");
    };
    change(&mut spec, &mut cam);
    spec.couplings[0].kind = CouplingKind::Cam(cam);
    let faults = Linkage::new(spec).expect_err("it is refused");
    let line = |fault: &crate::fault::Fault| format!("{}: {}", fault.path, fault.message);
    faults.iter().map(line).collect::<Vec<_>>().join("; ")
}

#[test]
fn cams_that_cannot_be_are_told() {
    let of_lift = |lift: PositionSpec| refused(|_, cam| cam.lift = Some(lift.clone()));
    let sine = |harmonic, amplitude| PositionSpec::Sine {
        amplitude,
        harmonic,
        phase: 0.0,
        offset: 0.0,
    };
    let open = of_lift(sine(1.5, 0.01));
    assert!(
        open.contains("couplings.c0.cam.lift: the lift does not repeat after a turn"),
        "{open}"
    );
    let inside = of_lift(sine(1.0, 0.07));
    assert!(
        inside.contains("does not pass round its centre"),
        "{inside}"
    );
    let jump = of_lift(rise_and_return(LawName::Parabolic));
    assert!(
        jump.contains("the second derivative of the lift jumps at"),
        "{jump}"
    );
    let line = of_lift(PositionSpec::Ratio {
        ratio: 1.0,
        offset: 0.0,
    });
    assert!(line.contains("does not repeat"), "{line}");
    let radius = refused(|_, cam| cam.base_radius = -1.0);
    assert!(radius.contains("couplings.c0.cam.base_radius"), "{radius}");
    let hollow = refused(|_, cam| (cam.surface, cam.roller_radius) = (Surface::Hollow, 0.06));
    assert!(
        hollow.contains("does not fit into a hollow cam"),
        "{hollow}"
    );
    let twice = refused(|spec, _| spec.couplings[0].wheels = [CAM, CAM]);
    assert!(twice.contains("`cam` occurs in it twice"), "{twice}");
    let far = refused(|_, cam| cam.base_radius = 0.3);
    assert!(far.contains("cannot be joined"), "{far}");
    let both = refused(|spec, _| {
        let name = "c1".to_owned();
        let again = spec.couplings[0].clone();
        let again = crate::kinematics::linkage::spec::CouplingSpec { name, ..again };
        spec.couplings.push(again);
    });
    assert!(both.contains("c0") && both.contains("c1"), "{both}");
}

#[test]
fn undercut_profiles_are_told() {
    // R = 0.06 + 0.006·cos 3ψ: at its lobes ρ = R²/(R − R″) = 0.066²/(0.066 + 0.054) = 0.0363 m.
    let lobes = |roller_radius: f64| {
        let lift = PositionSpec::Sine {
            amplitude: 0.006,
            harmonic: 3.0,
            phase: std::f64::consts::FRAC_PI_2,
            offset: 0.0,
        };
        let cam = CamPairSpec {
            lift: Some(lift),
            roller_radius,
            base_radius: 0.06 - roller_radius,
            ..circle(ROLLER)
        };
        linkage(cam_and_lever(cam)).remarks()
    };
    assert_eq!(lobes(0.036), Vec::<String>::new());
    let told = lobes(0.0365);
    let wanted = "the cam of `c0` is undercut at 0 deg: there its pitch curve has a radius of curvature \
                  of 0.0363 m, the roller one of 0.0365 m";
    assert_eq!(told, [wanted]);
}
