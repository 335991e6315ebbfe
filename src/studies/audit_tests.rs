//! The check of the equations of motion, against runs of models that are not what their
//! scenes state: as where a fault of a method or of the lowering takes one law for another.

use super::demand::Demand;
use super::run::{Motion, motion, run};
use super::{Control, RunSettings};
use crate::dynamics::audit::{self, AuditScope};
use crate::dynamics::integrate::Method;
use crate::dynamics::model::{LoadLaw, Model, NodeMotion};
use crate::dynamics::record::check_confirmed_peaks;
use crate::dynamics::system::System;
use crate::frontend::lower::lower;
use crate::frontend::scene::{BuiltIn, Document, Overrides};
use crate::kinematics::motion::DriveMotion;
use std::path::Path;

/// Scenes of public reports whose motions were once taken for uniform, or passed over.
const REPORTED: [&str; 8] = [
    "motion_cam_wobble",
    "motion_half_sine_cubed",
    "motion_polynomial_modulo",
    "motion_register",
    "motion_smooth_sine",
    "written_feed_smooth",
    "geneva_with_dwell",
    "shaking_ground",
];

fn lowered(text: &[u8]) -> (Model, RunSettings) {
    let document = Document::parse("scene.json", text).unwrap();
    let reading = document.scene(&BuiltIn, &Overrides::none()).unwrap();
    let settings = RunSettings::of(&reading.scene).unwrap();
    (lower(&reading.scene).unwrap(), settings)
}

fn reported(name: &str) -> (Model, RunSettings) {
    let folder = Path::new(env!("CARGO_MANIFEST_DIR")).join("tests/reference/public");
    lowered(&std::fs::read(folder.join(format!("{name}.json"))).unwrap())
}

/// Takes every prescribed motion for the uniform one that it begins with.
fn take_for_uniform(model: &mut Model) {
    for node in &mut model.nodes {
        if let NodeMotion::Prescribed { motion, track } = &mut node.motion {
            let jet = motion.jet(motion.breaks().segment_at(0.0, 1.0), 0.0);
            let (speed, angle) = (jet.first, jet.value);
            (*motion, *track) = (DriveMotion::Constant { speed, angle }, None);
        }
    }
}

/// The motion of a system by a method at a tolerance.
fn moved(system: &System, settings: RunSettings, (method, tolerance): (Method, f64)) -> Motion {
    let settings = RunSettings {
        method: Some(method),
        tolerance,
        ..settings
    };
    let control = Control::default();
    motion(system, &settings, Demand::EVERYTHING, &control, &mut []).unwrap()
}

fn is_kept(model: Model, settings: &RunSettings, method: Option<Method>) -> bool {
    let settings = RunSettings {
        method,
        ..settings.clone()
    };
    let system = System::new(model).unwrap();
    let found = run(&system, &settings, &Control::default(), &mut []).unwrap();
    assert_eq!(
        found.equations.is_kept(),
        found.figures.run.equations.is_kept()
    );
    assert!(found.equations.instants > 0, "{:?}", found.equations);
    assert!(found.equations.is_kept() || !found.is_trusted());
    found.equations.is_kept()
}

#[test]
fn a_motion_that_is_taken_for_a_uniform_one_is_found_out_by_every_method() {
    for name in REPORTED {
        for method in [Method::Dop853, Method::Radau, Method::Taylor] {
            let (mut model, settings) = reported(name);
            take_for_uniform(&mut model);
            if method == Method::Taylor && name == "motion_register" {
                continue; // (It has no power series.)
            }
            assert!(!is_kept(model, &settings, Some(method)), "{name}, {method}");
        }
        let (mut model, settings) = reported(name);
        take_for_uniform(&mut model);
        assert!(!is_kept(model, &settings, None), "{name}");
    }
}

#[test]
fn runs_as_they_stand_keep_their_equations() {
    for (name, method) in [
        ("motion_smooth_sine", Method::Dop853),
        ("motion_smooth_sine", Method::Radau),
        ("written_feed_smooth", Method::Taylor),
        ("motion_register", Method::Dop853),
        ("shaking_ground", Method::Dop853),
        ("hunting", Method::Dop853),
        ("geneva_explicit_times", Method::Exact),
    ] {
        let (model, settings) = reported(name);
        assert!(is_kept(model, &settings, Some(method)), "{name}, {method}");
    }
}

const CAM: &[u8] = br#"{ "dam": 1, "name": "Cam", "objects": {
    "shaft": { "kind": "drive", "motion": { "speed": "300 rpm" } },
    "follower": { "kind": "slider", "input": "shaft", "inertia": 2, "stiffness": 2e5,
        "damping_capacity": 0.3, "masses": 2,
        "position": { "cam": { "lift": "20 mm", "rise": "90 deg", "dwell": "30 deg",
            "return": "90 deg", "law": "modified_sine" } },
        "loads": { "spring": { "spring": { "rate": 3000, "preload": 200 } },
            "push": { "window": { "from": "20 deg", "to": "60 deg", "force": -50 } } } } },
    "run": { "duration": 0.4 } }"#;

/// A share of 1e-4 in a motion and a tenth in a load are enough.
#[test]
fn small_differences_from_what_the_scene_states_are_found() {
    let (model, settings) = lowered(CAM);
    for method in [Method::Exact, Method::Dop853] {
        assert!(is_kept(model.clone(), &settings, Some(method)), "{method}");
        for changed in 0..3 {
            let mut other = model.clone();
            match changed {
                0 => {
                    for node in &mut other.nodes {
                        if let NodeMotion::Prescribed { motion, .. } = &mut node.motion {
                            let speed = 10.0 * std::f64::consts::PI * (1.0 + 1e-4);
                            *motion = DriveMotion::Constant { speed, angle: 0.0 };
                        }
                    }
                }
                1 => {
                    for load in &mut other.loads {
                        if let LoadLaw::Linear(own) = &mut load.law {
                            own.rate *= 1.1;
                        }
                    }
                }
                _ => {
                    for load in &mut other.loads {
                        if let LoadLaw::Pieces { pieces, .. } = &mut load.law {
                            pieces.iter_mut().for_each(|piece| piece.value *= 1.1);
                        }
                    }
                }
            }
            assert!(
                !is_kept(other, &settings, Some(method)),
                "{method}, {changed}"
            );
        }
    }
}

/// A method that steps over a whole rise is found out by the tolerance it was asked for.
#[test]
fn a_rise_that_is_stepped_over_is_found() {
    let text = String::from_utf8(CAM.to_vec())
        .unwrap()
        .replace("2e5", "1e9");
    let (model, settings) = lowered(text.as_bytes());
    let system = System::new(model).unwrap();
    let found = moved(&system, settings, (Method::Radau, 0.1));
    let asked = AuditScope {
        tolerance: 1e-9,
        recorded: true,
        closed: false,
    };
    let check = audit::check(&system, &found.recorded.looks, asked, &[]);
    assert!(!check.is_kept(), "{check:?}");
}

#[test]
fn a_run_that_ends_late_and_one_whose_states_drift_are_found() {
    let modes = String::from_utf8(CAM.to_vec())
        .unwrap()
        .replace(r#""masses": 2"#, r#""modes": 2"#);
    for text in [CAM, modes.as_bytes()] {
        let (model, settings) = lowered(text);
        let system = System::new(model).unwrap();
        let found = moved(&system, settings, (Method::Dop853, 1e-9));
        let asked = AuditScope {
            tolerance: 1e-9,
            recorded: true,
            closed: false,
        };
        let check = |looks| audit::check(&system, &looks, asked, &[]);
        let looks = &found.recorded.looks;
        assert!(check(looks.clone()).is_kept());
        let late = check(looks.clone().late(1e-9));
        assert!(!late.is_kept());
        assert_eq!(late.what, "end");
        assert!(!check(looks.clone().moved(0, 0.01)).is_kept());
    }
}

#[test]
fn a_greatest_value_that_its_state_does_not_show_is_found() {
    let (model, settings) = lowered(CAM);
    let system = System::new(model).unwrap();
    let found = moved(&system, settings, (Method::Exact, 1e-6));
    assert!(found.equations.is_kept(), "{}", found.equations);
    let count = found.recorded.confirmed.len();
    assert!(count >= 5, "{count}");
    for one in 0..count {
        let mut recorded = found.recorded.clone();
        recorded.confirmed[one] = recorded.confirmed[one].with_share_of_error(1e-4);
        let mut check = found.equations.clone();
        check_confirmed_peaks(&mut check, &recorded, system.model(), 1e-6);
        assert!(!check.is_kept(), "{one}");
    }
}
