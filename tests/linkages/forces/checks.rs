//! Properties that hold for every mechanism: sensitivities against differences,
//! equilibrium of the whole, motion under a given driver's force.

use super::mechanisms::{known, spec};
use super::reference;
use dam::linkage::kinetostatics::{ForceWorkspace, InputMotion, Kinetostatics, Options};
use dam::linkage::spec::{ForceLaw, ForceSpec, LinkageSpec, PointOf};
use serde_json::Value;
use std::f64::consts::TAU;

/// The cases with masses, friction and gravity, made richer by springs and dampers.
pub(super) fn rich() -> Vec<(String, Value, LinkageSpec)> {
    let reference = reference();
    let cases = reference["cases"].as_array().unwrap();
    let wanted = ["offset-slider-crank", "four-bar", "slotted-lever"];
    let chosen = cases
        .iter()
        .filter(|case| wanted.contains(&case["id"].as_str().unwrap()));
    chosen
        .map(|case| {
            let kind = case["kind"].as_str().unwrap();
            let mut linkage = spec(kind, &case["data"]);
            linkage.forces.extend(springs());
            (kind.to_owned(), case["data"].clone(), linkage)
        })
        .collect()
}

fn springs() -> Vec<ForceSpec> {
    let point = |link: Option<usize>, x: f64, y: f64| PointOf { link, at: [x, y] };
    let laws = [
        ForceLaw::Strut {
            from: point(None, -0.2, 0.4),
            to: point(Some(1), 0.05, 0.02),
            rate: 900.0,
            free_length: 0.2,
            damping: 15.0,
            force: -70.0,
        },
        ForceLaw::Strut {
            from: point(Some(0), 0.02, 0.01),
            to: point(Some(2), 0.03, -0.04),
            rate: 500.0,
            free_length: 0.0,
            damping: 0.0,
            force: 0.0,
        },
        ForceLaw::Torsion {
            pair: 1,
            rate: 3.0,
            free_angle: 0.3,
            damping: 0.05,
        },
        ForceLaw::Force {
            point: point(Some(1), 0.1, 0.03),
            force: [12.0, -7.0],
            follows: true,
        },
        ForceLaw::CoupleTable {
            link: 1,
            points: vec![(0.0, 2.0), (2.0, -3.0), (5.0, 1.0)],
            period: Some(TAU),
        },
        ForceLaw::Table {
            point: point(Some(2), 0.02, 0.01),
            direction: 0.4,
            points: vec![(0.0, 0.0), (1.5, 40.0), (4.0, -20.0)],
            period: Some(TAU),
        },
    ];
    let named = laws.into_iter().enumerate();
    named
        .map(|(index, law)| ForceSpec {
            name: format!("extra{index}"),
            law,
        })
        .collect()
}

const MOTION: [(f64, f64); 3] = [(40.0, -300.0), (-15.0, 50.0), (12.0, 0.0)];

pub(super) fn solve(
    linkage: &LinkageSpec,
    kind: &str,
    data: &Value,
    motion: InputMotion,
) -> (Kinetostatics, ForceWorkspace) {
    let solver = Kinetostatics::new(linkage).unwrap();
    let mut w = solver.workspace();
    let (positions, _) = known(kind, data, motion.coordinate);
    solver
        .solve(&positions, motion, &Options::default(), &mut w)
        .unwrap();
    (solver, w)
}

/// Every rich mechanism at several positions and motions.
pub(super) fn each(mut check: impl FnMut(&str, &Value, &LinkageSpec, InputMotion)) {
    for (kind, data, linkage) in rich() {
        for (speed, acceleration) in MOTION {
            for step in 0..7 {
                let motion = InputMotion {
                    coordinate: 0.3 + 0.9 * f64::from(step),
                    speed,
                    acceleration,
                };
                check(&kind, &data, &linkage, motion);
            }
        }
    }
}

#[test]
fn power_balances_and_nothing_gains_from_friction() {
    each(|kind, data, linkage, motion| {
        let (solver, mut w) = solve(linkage, kind, data, motion);
        let balance = solver.balance(&w);
        assert!(balance.residual < 1e-10, "{kind} {motion:?} {balance:?}");
        assert!(balance.loss > 0.0);
        let efficiency = balance.efficiency.unwrap();
        assert!((0.0..1.0).contains(&efficiency));
        assert!(solver.influence_error(&mut w) < 1e-12);
        let losses = (0..4).map(|pair| solver.friction(pair, &w).loss);
        assert!(losses.into_iter().all(|loss| loss >= 0.0));
    });
}

/// The frame carries weights, forces from the ground, and the shaking force.
#[test]
fn the_frame_carries_what_is_left() {
    each(|kind, data, linkage, motion| {
        let (solver, w) = solve(linkage, kind, data, motion);
        let mut expected = solver.shaking(&w);
        let applied = solver.applied(&w);
        for k in 0..3 {
            expected[k] += applied[k];
        }
        let found = solver.on_frame(&w);
        for k in 0..3 {
            let scale = 1.0 + found[k].abs() + applied[k].abs() + 1e3;
            assert!(
                (found[k] - expected[k]).abs() < 1e-11 * scale,
                "{kind} {k}: {found:?} {expected:?}"
            );
        }
    });
}

/// All derivatives of the driving force against central differences.
#[test]
fn sensitivities_agree_with_differences() {
    each(|kind, data, linkage, motion| {
        let (solver, mut w) = solve(linkage, kind, data, motion);
        let found = solver.sensitivities(&mut w).unwrap();
        let slope = |change: &dyn Fn(&mut LinkageSpec, f64), h: f64| {
            let at = |x: f64| {
                let mut changed = linkage.clone();
                change(&mut changed, x);
                solve(&changed, kind, data, motion).1.driver_force()
            };
            (at(h) - at(-h)) / (2.0 * h)
        };
        let near = |name: &str, index: usize, found: f64, wanted: f64| {
            let limit = 1e-6 * (1.0 + wanted.abs() + w.driver_force().abs());
            assert!(
                (found - wanted).abs() < limit,
                "{kind} {name}{index} {motion:?}: {found} {wanted}"
            );
        };
        for index in 0..4 {
            let wanted = slope(&|spec, h| spec.pairs[index].friction += h, 1e-5);
            near("friction", index, found.friction[index], wanted);
        }
        for index in 0..3 {
            let wanted = slope(&|spec, h| spec.links[index].mass += h, 1e-3);
            near("mass", index, found.mass[index], wanted);
            // J must not be negative.
            let h = 1e-6;
            let mut shifted = linkage.clone();
            shifted.links[index].moment += h;
            let (solver, mut w) = solve(&shifted, kind, data, motion);
            let found = solver.sensitivities(&mut w).unwrap();
            let wanted = slope(&|spec, x| spec.links[index].moment += h + x, h);
            near("moment", index, found.moment[index] * 1e-3, wanted * 1e-3);
        }
    });
}

/// A pair without friction has a derivative at zero friction too.
#[test]
fn sensitivity_of_a_frictionless_pair() {
    for (kind, data, mut linkage) in rich() {
        linkage.pairs[2].friction = 0.0;
        let motion = InputMotion {
            coordinate: 1.1,
            speed: 20.0,
            acceleration: 5.0,
        };
        let (solver, mut w) = solve(&linkage, &kind, &data, motion);
        let found = solver.sensitivities(&mut w).unwrap().friction[2];
        let mut changed = linkage.clone();
        changed.pairs[2].friction = 1e-7;
        let wanted =
            (solve(&changed, &kind, &data, motion).1.driver_force() - w.driver_force()) / 1e-7;
        assert!(
            (found - wanted).abs() < 1e-4 * (1.0 + wanted.abs()),
            "{kind}: {found} {wanted}"
        );
    }
}

/// A force on an output is the same as a couple or force on its link.
#[test]
fn loads_on_outputs_are_forces() {
    each(|kind, data, linkage, motion| {
        let mut with = linkage.clone();
        let law = match kind {
            "slider_crank" => ForceLaw::Force {
                point: PointOf {
                    link: Some(2),
                    at: [0.0, 0.0],
                },
                force: [37.0, 0.0],
                follows: false,
            },
            _ => ForceLaw::Couple {
                link: 2,
                couple: 37.0,
            },
        };
        with.forces.push(ForceSpec {
            name: "same".to_owned(),
            law,
        });
        let (solver, w) = solve(&with, kind, data, motion);
        let other = Kinetostatics::new(linkage).unwrap();
        let mut v = other.workspace();
        v.set_output_loads(&[37.0]);
        let (positions, _) = known(kind, data, motion.coordinate);
        other
            .solve(&positions, motion, &Options::default(), &mut v)
            .unwrap();
        assert!(
            (w.driver_force() - v.driver_force()).abs() < 1e-11 * (1.0 + w.driver_force().abs())
        );
        let (one, two) = (solver.balance(&w), other.balance(&v));
        assert!((one.forces - two.forces).abs() < 1e-9 * (1.0 + one.forces.abs()));
        assert!(two.residual < 1e-10);
        let load = |solver: &Kinetostatics, w: &ForceWorkspace| {
            let found = solver.transmission(0, &solver.loads_of(0), motion.coordinate, w);
            (found.load.unwrap(), found.load_power)
        };
        let (a, b) = (load(&solver, &w), load(&other, &v));
        assert!((a.0 - b.0).abs() < 1e-9 * (1.0 + a.0.abs()), "{a:?} {b:?}");
        assert!((a.1 - b.1).abs() < 1e-9 * (1.0 + a.1.abs()));
    });
}

/// Bad numbers are all told at once, and nothing that is not a number passes.
#[test]
fn bad_numbers_are_refused() {
    let reference = reference();
    let data = &reference["cases"][11]["data"];
    let mut linkage = spec("slider_crank", data);
    linkage.links[0].mass = -1.0;
    linkage.links[1].moment = f64::NAN;
    linkage.pairs[0].friction = -0.1;
    linkage.pairs.pop();
    let faults = Kinetostatics::new(&linkage).unwrap_err();
    let paths: Vec<_> = faults.iter().map(|fault| fault.path.as_str()).collect();
    assert_eq!(
        paths,
        [
            "links.crank.mass",
            "links.rod.moment",
            "pairs.R01.friction",
            "pairs"
        ]
    );
    let linkage = spec("slider_crank", data);
    let solver = Kinetostatics::new(&linkage).unwrap();
    let mut w = solver.workspace();
    let (mut positions, _) = known("slider_crank", data, 1.0);
    positions.links[1].origin[0] = f64::NAN;
    let motion = InputMotion {
        coordinate: 1.0,
        speed: 1.0,
        acceleration: 0.0,
    };
    let failure = solver.solve(&positions, motion, &Options::default(), &mut w);
    assert!(failure.is_err());
    let (positions, _) = known("slider_crank", data, 1.0);
    let rest = InputMotion {
        speed: 0.0,
        ..motion
    };
    let failure = solver.solve(&positions, rest, &Options::default(), &mut w);
    assert!(failure.unwrap_err().to_string().contains("rests"));
    // Just after rest the motion goes where the acceleration points.
    let start = |acceleration: f64, speed: f64, w: &mut ForceWorkspace| {
        let motion = InputMotion {
            coordinate: 1.0,
            speed,
            acceleration,
        };
        let solved = solver.solve(&positions, motion, &Options::default(), w);
        solved.map(|_| w.driver_force()).unwrap()
    };
    for acceleration in [3.0, -3.0] {
        let at_rest = start(acceleration, 0.0, &mut w);
        let after = start(acceleration, 1e-7 * acceleration, &mut w);
        assert!((at_rest - after).abs() < 1e-6 * (1.0 + after.abs()));
    }
}
