//! Redundant constraints behind several inputs: a parallelogram with three equal cranks on a frame that
//! turns, against closed forms of its positions and Lagrange's equations.

use super::examples::{GROUND, bar, input, pin};
use super::motion::at;
use crate::kinematics::linkage::kinetostatics::{Kinetostatics, Options};
use crate::kinematics::linkage::multi::spec::{InputCoordinate, MultiSpec};
use crate::kinematics::linkage::multi::{MultiLinkage, MultiMotion};
use crate::kinematics::linkage::spec::{AssemblyChoice, AssemblySpec, LinkageSpec, PointOf};
use crate::math::jet::Jet;

/// Length of the cranks (m).
const CRANK: f64 = 0.2;
/// Their axes on the frame (m).
const AXES: [[f64; 2]; 3] = [[0.1, 0.05], [0.4, 0.1], [0.7, -0.02]];
/// Masses of frame, cranks and coupler (kg).
const MASSES: [f64; 5] = [2.0, 0.5, 0.7, 0.6, 1.5];
/// Names of the links.
const NAMES: [&str; 5] = ["frame", "first", "second", "third", "coupler"];

/// The frame turns about the origin; three cranks on it carry the coupler, whose frame lies where the
/// first crank ends. The third crank holds nothing that the others do not.
fn frame(third: f64) -> MultiSpec {
    let lengths = [0.6, CRANK, CRANK, third, 0.5];
    let links = (0..5).map(|k| bar(NAMES[k], lengths[k], MASSES[k]));
    let mut pairs = vec![pin("O", (GROUND, [0.0; 2]), (Some(0), [0.0; 2]))];
    for (k, axis) in AXES.into_iter().enumerate() {
        let crank = Some(k + 1);
        let [x, y] = [0, 1].map(|part| axis[part] - AXES[0][part]);
        pairs.push(pin(&format!("A{k}"), (Some(0), axis), (crank, [0.0; 2])));
        let end = (crank, [lengths[k + 1], 0.0]);
        pairs.push(pin(&format!("B{k}"), end, (Some(4), [x, y])));
    }
    MultiSpec {
        linkage: LinkageSpec {
            links: links.collect(),
            pairs,
            assembly: vec![AssemblySpec {
                link: 4,
                choice: AssemblyChoice::Angle(0.3),
            }],
            ..LinkageSpec::default()
        },
        inputs: vec![
            input("turn", InputCoordinate::Pair(0), 0.3),
            input("swing", InputCoordinate::Pair(1), 1.1),
        ],
    }
}

/// (x, y) turned.
fn turned([x, y]: [f64; 2], angle: f64) -> [f64; 2] {
    let (sin, cos) = angle.sin_cos();
    [cos * x - sin * y, sin * x + cos * y]
}

#[test]
fn a_third_equal_crank_is_redundant_behind_two_inputs() {
    let linkage = MultiLinkage::new(frame(CRANK)).unwrap();
    assert_eq!(linkage.structure().mobility, 2);
    assert_eq!(linkage.structure().redundant.len(), 1);
    let mut motion = MultiMotion::new(&linkage);
    for k in 0..60 {
        let t = 0.1 * f64::from(k);
        let inputs = [0.3 + t, 1.1 + 0.3 * t.sin()].map(|value| Jet {
            value,
            ..Jet::default()
        });
        motion.set_inputs(&inputs).unwrap();
        let [q1, q2] = [0, 1].map(|k| inputs[k].value);
        for crank in 0..3 {
            let found = motion.point(PointOf {
                link: Some(crank + 1),
                at: [CRANK, 0.0],
            });
            let (axis, end) = (turned(AXES[crank], q1), turned([CRANK, 0.0], q1 + q2));
            for part in 0..2 {
                let wanted = axis[part] + end[part];
                approx::assert_abs_diff_eq!(found[part].value, wanted, epsilon = 1e-12);
            }
        }
        approx::assert_abs_diff_eq!(motion.pose(4).cos, q1.cos(), epsilon = 1e-12);
    }
}

/// Drives by Lagrange's equations: T = ½·(M₁₁·q̇₁² + 2·M₁₂·q̇₁·q̇₂ + M₂₂·q̇₂²), M a function of q₂.
fn lagrange(inputs: &[Jet]) -> [f64; 2] {
    let q2 = inputs[1].value;
    let (mut mass, mut slope) = ([0.0; 3], [0.0; 2]);
    let moment = |k: usize, length: f64| MASSES[k] * length * length / 12.0;
    // The frame about the origin.
    mass[0] += MASSES[0] * 0.3 * 0.3 + moment(0, 0.6);
    // Centres at R(q₁)·a + R(q₁ + q₂)·(c, 0).
    let coupler = [AXES[0][0] + 0.25, AXES[0][1]];
    let bodies = [
        (1, AXES[0], 0.5 * CRANK),
        (2, AXES[1], 0.5 * CRANK),
        (3, AXES[2], 0.5 * CRANK),
        (4, coupler, CRANK),
    ];
    for (k, [x, y], c) in bodies {
        let (sin, cos) = q2.sin_cos();
        let (both, both_slope) = (c * (x * cos + y * sin), c * (y * cos - x * sin));
        let m = MASSES[k];
        mass[0] += m * (x * x + y * y + c * c + 2.0 * both);
        mass[1] += m * (c * c + both);
        mass[2] += m * c * c;
        slope[0] += 2.0 * m * both_slope;
        slope[1] += m * both_slope;
        let own = moment(k, if k == 4 { 0.5 } else { CRANK });
        mass[0] += own;
        // The coupler turns with the frame alone.
        if k < 4 {
            mass[1] += own;
            mass[2] += own;
        }
    }
    let [[v1, a1], [v2, a2]] = [0, 1].map(|k| [inputs[k].first, inputs[k].second]);
    [
        mass[0] * a1 + mass[1] * a2 + slope[0] * v1 * v2 + slope[1] * v2 * v2,
        mass[1] * a1 + mass[2] * a2 - 0.5 * slope[0] * v1 * v1,
    ]
}

#[test]
fn drives_obey_lagrange_and_reactions_of_the_cranks_stay_open() {
    let linkage = MultiLinkage::new(frame(CRANK)).unwrap();
    let mut motion = MultiMotion::new(&linkage);
    let solver = Kinetostatics::of_inputs(linkage.spec()).unwrap();
    let mut w = solver.workspace();
    for t in [0.0, 0.05, 0.2] {
        let inputs = at(&[0.3, 1.1], t);
        motion.set_inputs(&inputs).unwrap();
        let rates: Vec<f64> = inputs.iter().map(|input| input.first).collect();
        solver
            .solve_over_time(&motion, &rates, &Options::default(), &mut w)
            .unwrap();
        let wanted = lagrange(&inputs);
        for (k, wanted) in wanted.into_iter().enumerate() {
            approx::assert_relative_eq!(w.driver_forces()[k], wanted, max_relative = 1e-10);
            approx::assert_relative_eq!(motion.required()[k], wanted, max_relative = 1e-10);
        }
        let open = solver.indeterminate(&w);
        assert!(!open.drive);
        // The pin of the frame on the ground carries what equilibrium says.
        assert_eq!(open.pairs, [false, true, true, true, true, true, true]);
    }
}

#[test]
fn the_other_assembly_behind_a_change_point_is_not_reached() {
    let linkage = MultiLinkage::new(frame(CRANK)).unwrap();
    let mut motion = MultiMotion::new(&linkage);
    let mut reached = |swing: f64| {
        let inputs = [0.3, swing].map(|value| Jet {
            value,
            ..Jet::default()
        });
        motion.set_inputs(&inputs).is_ok()
    };
    // The first two pins of the coupler come in line with their cranks at atan(0.05/0.3) = 9.46 deg.
    assert!(reached(0.2));
    assert!(!reached(0.1));
    assert!(reached(1.1));
}

#[test]
fn a_crank_of_another_length_holds_the_frame() {
    let faults = MultiLinkage::new(frame(CRANK * 1.001)).unwrap_err();
    let message = &faults[0].message;
    assert!(
        message.starts_with("2 inputs, and 5 moving links"),
        "{message}"
    );
}

#[test]
fn friction_of_what_is_open_is_refused_in_the_motion() {
    let mut spec = frame(CRANK);
    spec.linkage.pairs[6].friction = 0.1;
    if let crate::kinematics::linkage::spec::PairKind::Revolute { diameter } =
        &mut spec.linkage.pairs[6].kind
    {
        *diameter = 0.02;
    }
    let linkage = MultiLinkage::new(spec).unwrap();
    let solver = Kinetostatics::of_inputs(linkage.spec()).unwrap();
    let fault = solver.friction_of_inputs_left_open(&linkage).unwrap();
    assert_eq!(fault.path, "pairs.B2.friction");
}
