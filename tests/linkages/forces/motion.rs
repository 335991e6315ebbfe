//! Motion under a given driver's force: friction at rest, strong friction.

use super::checks::{each, rich, solve};
use super::mechanisms::{known, spec};
use super::reference;
use dam::linkage::kinetostatics::{ForceWorkspace, InputMotion, Kinetostatics, Options, Outcome};
use std::f64::consts::TAU;

/// Given the driving force of a motion, its acceleration is found again.
#[test]
fn acceleration_is_the_inverse_of_the_driving_force() {
    each(|kind, data, linkage, motion| {
        let (solver, mut w) = solve(linkage, kind, data, motion);
        let drive = w.driver_force();
        let reaction = solver.reaction(2, &w);
        let (positions, _) = known(kind, data, motion.coordinate);
        let (q, v) = (motion.coordinate, motion.speed);
        let found = solver
            .accelerate(&positions, q, v, drive, &Options::default(), &mut w)
            .unwrap();
        let Outcome::Moves { acceleration } = found.outcome else {
            panic!("{found:?}");
        };
        assert_eq!(found.solved.unwrap().solutions, 1);
        let scale = 1.0 + motion.acceleration.abs() + motion.speed * motion.speed;
        assert!(
            (acceleration - motion.acceleration).abs() < 1e-8 * scale,
            "{kind} {motion:?} {acceleration}"
        );
        let again = solver.reaction(2, &w);
        assert!(close(reaction, again), "{reaction:?} {again:?}");
    });
}

fn close(
    a: dam::linkage::kinetostatics::Reaction,
    b: dam::linkage::kinetostatics::Reaction,
) -> bool {
    use dam::linkage::kinetostatics::Reaction::{Guide, Pin};
    match (a, b) {
        (Pin(a), Pin(b)) | (Guide(a), Guide(b)) => {
            let scale = 1.0 + a[0].hypot(a[1]);
            (a[0] - b[0]).abs() + (a[1] - b[1]).abs() < 1e-8 * scale
        }
        _ => false,
    }
}

/// With friction so strong that accelerations may be missing or several, every
/// one found needs the driving force given, and where none is found none exists.
#[test]
fn accelerations_under_strong_friction() {
    let (kind, data, mut linkage) = rich().swap_remove(0);
    linkage
        .pairs
        .iter_mut()
        .for_each(|pair| pair.friction = 1.4);
    let solver = Kinetostatics::new(&linkage).unwrap();
    let mut w = solver.workspace();
    let options = Options::default();
    let (mut several, mut none) = (0, 0);
    // Ordinary positions, and some beside the dead centres.
    for step in [1, 2, 10, 25, 37, 60] {
        let q = 0.02 + f64::from(step) * TAU / 72.0;
        let (positions, _) = known(&kind, &data, q);
        for drive in [-400.0, 50.0] {
            // Driving forces that a given acceleration needs, of all solutions.
            let needed = |acceleration: f64| -> Vec<f64> {
                let motion = InputMotion {
                    coordinate: q,
                    speed: 12.0,
                    acceleration,
                };
                let mut v = solver.workspace();
                match solver.solve(&positions, motion, &options, &mut v) {
                    Ok(_) => v
                        .other_drives()
                        .iter()
                        .copied()
                        .chain([v.driver_force()])
                        .collect(),
                    Err(_) => Vec::new(),
                }
            };
            match solver.accelerate(&positions, q, 12.0, drive, &options, &mut w) {
                Ok(found) => {
                    let Outcome::Moves { acceleration } = found.outcome else {
                        panic!("{found:?}");
                    };
                    several += usize::from(found.solved.unwrap().solutions > 1);
                    for acceleration in w.other_drives().iter().chain([&acceleration]) {
                        let near = 1e-6 * (drive.abs() + 1e-2 * acceleration.abs());
                        let all = needed(*acceleration);
                        let met = all.iter().any(|found| (found - drive).abs() < near);
                        assert!(met, "{q} {drive}: {acceleration} needs {all:?}");
                    }
                }
                Err(_) => {
                    none += 1;
                    // Nothing on a wide scan crosses the driving force given.
                    let mut before: Option<f64> = None;
                    for k in -20..=20 {
                        let x = f64::from(k) / 20.0;
                        let all = needed(3e5 * x * x * x);
                        let now = (all.len() == 1).then(|| all[0] - drive);
                        if let (Some(a), Some(b)) = (before, now) {
                            assert!(a * b > 0.0, "{q} {drive}: crossed near {}", 3e5 * x * x * x);
                        }
                        before = now;
                    }
                }
            }
        }
    }
    assert!(several > 0 && none > 0, "{several} {none}");
}

/// At rest: no motion below the force that overcomes friction, in either direction.
#[test]
fn friction_holds_at_rest() {
    for (kind, data, linkage) in rich() {
        let solver = Kinetostatics::new(&linkage).unwrap();
        let mut w = solver.workspace();
        let (positions, _) = known(&kind, &data, 1.3);
        let threshold = |direction: f64, w: &mut ForceWorkspace| {
            let motion = InputMotion {
                coordinate: 1.3,
                ..InputMotion::default()
            };
            let options = Options {
                direction: Some(direction),
                ..Options::default()
            };
            solver.solve(&positions, motion, &options, w).unwrap();
            w.driver_force()
        };
        let (low, high) = (threshold(-1.0, &mut w), threshold(1.0, &mut w));
        assert!(low < high, "{kind}");
        let options = Options::default();
        let mut start = |drive: f64| {
            let found = solver.accelerate(&positions, 1.3, 0.0, drive, &options, &mut w);
            found.unwrap().outcome
        };
        let margin = 1e-6 * (high - low);
        for (drive, sign) in [
            (low - margin, -1.0),
            (low + margin, 0.0),
            (0.5 * (low + high), 0.0),
            (high - margin, 0.0),
            (high + margin, 1.0),
        ] {
            match start(drive) {
                Outcome::Rests => assert_eq!(sign, 0.0, "{kind} {drive} in {low}..{high}"),
                Outcome::Moves { acceleration } => assert!(acceleration * sign > 0.0),
                other => panic!("{other:?}"),
            }
        }
    }
}

/// At a dead centre of the output the sign of the ratio is that just after it, in the
/// direction asked for: at rest as at the slowest speed.
#[test]
fn a_dead_centre_at_rest_has_the_sign_of_the_direction_asked_for() {
    let reference = reference();
    let data = &reference["cases"][2]["data"];
    let linkage = spec("slider_crank", data);
    let solver = Kinetostatics::new(&linkage).unwrap();
    let mut w = solver.workspace();
    let mut sign = |speed: f64, direction: Option<f64>| {
        let (positions, _) = known("slider_crank", data, 0.0);
        let motion = InputMotion {
            speed,
            ..InputMotion::default()
        };
        let options = Options {
            direction,
            ..Options::default()
        };
        solver.solve(&positions, motion, &options, &mut w).unwrap();
        let found = solver.transmission(0, &solver.loads_of(0), 0.0, &w);
        assert!(found.ratio.abs() < 1e-15);
        found.sign
    };
    for direction in [1.0, -1.0] {
        let moving = sign(1e-6 * direction, None);
        assert_eq!(moving, -direction, "the slide comes back from its end");
        assert_eq!(sign(0.0, Some(direction)), moving);
    }
}
