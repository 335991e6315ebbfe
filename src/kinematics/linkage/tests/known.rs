//! Linkages with known figures: Andrews' mechanism, the position functions,
//! dead-centre positions, groups that need iteration.

use super::examples::{GROUND, andrews, four_bar, slider_crank, triad};
use super::support::{closure_error, compare_with_differences};
use crate::kinematics::linkage::spec::{AssemblyChoice, PointOf};
use crate::kinematics::linkage::{Cause, GroupKind, Linkage, Reach};
use crate::kinematics::position::{Position, PositionSpec};
use std::f64::consts::{FRAC_PI_2, PI, TAU};

#[test]
fn the_squeezing_mechanism_starts_as_published() {
    let linkage = Linkage::new(andrews().0).unwrap();
    let kinds: Vec<GroupKind> = linkage.structure().groups.iter().map(|g| g.kind).collect();
    let rrr = GroupKind::Rrr;
    assert_eq!(kinds, [GroupKind::Driver, rrr, rrr, rrr]);
    let mut workspace = linkage.workspace();
    let start = linkage.range().start;
    linkage.solve(start, 2, &mut workspace).unwrap();
    assert!(closure_error(&linkage, &workspace) < 1e-15);
    // The published start: every angle as given, to rounding.
    for (link, angle) in [
        (2, 0.455_279_819_163_070_4),
        (3, 0.222_668_390_165_885_88 + 0.487_364_979_543_842_55),
        (4, 0.487_364_979_543_842_55),
        (6, 1.230_547_444_549_821_2),
    ] {
        approx::assert_abs_diff_eq!(workspace.angle(link), angle, epsilon = 1e-13);
    }
    let reduced = linkage.reduced_linkage(&workspace);
    let acceleration = (reduced.force[0] - reduced.potential[1]) / reduced.inertia[0];
    approx::assert_relative_eq!(acceleration, 14222.4439199541, max_relative = 1e-9);
    let theta = (workspace.transfer(1, 1)[2] - 1.0) * acceleration;
    approx::assert_relative_eq!(theta, -10666.8329399656, max_relative = 1e-9);
}

/// The squeezing mechanism's classical loop: β̈ from energies by Runge–Kutta
/// steps ends where it is published to end.
#[test]
fn the_squeezing_mechanism_moves_as_published() {
    let linkage = Linkage::new(andrews().0).unwrap();
    let mut workspace = linkage.workspace();
    let mut acceleration = |[q, v]: [f64; 2]| {
        linkage.solve(q, 2, &mut workspace).unwrap();
        let r = linkage.reduced_linkage(&workspace);
        (r.force[0] - r.potential[1] - 0.5 * r.inertia[1] * v * v) / r.inertia[0]
    };
    let (mut y, h) = ([linkage.range().start, 0.0], 0.03 / 6000.0);
    for _ in 0..6000 {
        y = runge_kutta(y, h, &mut acceleration);
    }
    approx::assert_abs_diff_eq!(y[0], 15.81077119629904, epsilon = 1e-7);
    approx::assert_abs_diff_eq!(y[1], 1139.920302151208, epsilon = 1e-5);
    linkage.solve(y[0], 1, &mut workspace).unwrap();
    approx::assert_abs_diff_eq!(workspace.angle(2), 0.04082224013073101, epsilon = 1e-7);
    let gamma = workspace.transfer(2, 1)[2] * y[1];
    approx::assert_abs_diff_eq!(gamma, 11.03291221937134, epsilon = 1e-5);
    // Θ is the angle of K2 less that of K1, continuous over the turns.
    let theta = workspace.angle(1) - workspace.angle(0);
    approx::assert_abs_diff_eq!(theta, -15.75637105984298, epsilon = 1e-7);
}

pub(super) fn runge_kutta(
    [q, v]: [f64; 2],
    h: f64,
    acceleration: &mut impl FnMut([f64; 2]) -> f64,
) -> [f64; 2] {
    let mut slopes = [[0.0; 2]; 4];
    for stage in 0..4 {
        let part = [0.0, 0.5, 0.5, 1.0][stage] * h;
        let before = if stage == 0 {
            [0.0; 2]
        } else {
            slopes[stage - 1]
        };
        let y = [q + part * before[0], v + part * before[1]];
        slopes[stage] = [y[1], acceleration(y)];
    }
    let mean =
        |k: usize| (slopes[0][k] + 2.0 * slopes[1][k] + 2.0 * slopes[2][k] + slopes[3][k]) / 6.0;
    [q + h * mean(0), v + h * mean(1)]
}

#[test]
fn four_bars_agree_with_the_position_function() {
    for (lengths, branch) in [
        ([0.1, 0.4, 0.3, 0.45], 1.0),
        ([0.1, 0.4, 0.3, 0.45], -1.0),
        ([0.4, 0.3, 0.45, 0.1], 1.0),
        ([0.5, 0.3, 0.22, 0.4], 1.0),
        ([0.4, 0.1, 0.5, 0.45], -1.0),
    ] {
        let [crank, coupler, rocker, frame] = lengths;
        let position = Position::new(&PositionSpec::FourBar {
            crank,
            coupler,
            rocker,
            frame,
            branch,
            phase: 0.0,
        })
        .unwrap();
        let start = 1.1 * branch;
        // The open branch has the rocker's pin to the left of the line from the
        // crank's end to its pivot.
        let choice = AssemblyChoice::Branch(branch);
        let linkage = Linkage::new(four_bar(lengths).start(start).choose(1, choice).0).unwrap();
        let ends = match position.reach_from(start).unwrap() {
            None => {
                assert_eq!(linkage.range().reach, Reach::Everywhere);
                [start - 9.0, start + 9.0]
            }
            Some((from, to)) => {
                let ends = linkage.range().ends();
                approx::assert_abs_diff_eq!(ends[0], from, epsilon = 1e-14);
                approx::assert_abs_diff_eq!(ends[1], to, epsilon = 1e-14);
                ends
            }
        };
        let mut workspace = linkage.workspace();
        let turns = |q: f64, w: &crate::kinematics::linkage::Workspace| {
            (w.angle(2) - position.jet(0, q).value) / TAU
        };
        linkage.solve(start, 0, &mut workspace).unwrap();
        let turn = turns(start, &workspace).round();
        for i in 1..60 {
            let q = ends[0] + (ends[1] - ends[0]) * f64::from(i) / 60.0;
            linkage.solve(q, 3, &mut workspace).unwrap();
            let (general, short) = (linkage.output(0, &workspace), position.jet(0, q));
            approx::assert_abs_diff_eq!(turns(q, &workspace), turn, epsilon = 1e-13);
            approx::assert_relative_eq!(
                general.first,
                short.first,
                max_relative = 1e-9,
                epsilon = 1e-12
            );
            approx::assert_relative_eq!(
                general.second,
                short.second,
                max_relative = 1e-9,
                epsilon = 1e-11
            );
            approx::assert_relative_eq!(
                general.third,
                short.third,
                max_relative = 1e-9,
                epsilon = 1e-10
            );
        }
    }
}

#[test]
fn slider_cranks_agree_with_the_position_function_up_to_their_dead_positions() {
    for (crank, rod, offset, branch) in [(0.1, 0.35, 0.03, 1.0), (0.25, 0.2, 0.02, -1.0)] {
        let position = Position::new(&PositionSpec::SliderCrank {
            crank,
            rod,
            offset,
            branch,
            phase: 0.0,
        })
        .unwrap();
        let spec = slider_crank(crank, rod, offset)
            .choose(1, AssemblyChoice::Branch(branch))
            .0;
        let linkage = Linkage::new(spec).unwrap();
        let ends = match position.reach_from(0.0).unwrap() {
            None => [-7.0, 7.0],
            Some((from, to)) => {
                let ends = linkage.range().ends();
                approx::assert_abs_diff_eq!(ends[0], from, epsilon = 1e-15);
                approx::assert_abs_diff_eq!(ends[1], to, epsilon = 1e-15);
                ends
            }
        };
        let mut workspace = linkage.workspace();
        for i in 1..1000 {
            let q = ends[0] + (ends[1] - ends[0]) * f64::from(i) / 1000.0;
            linkage.solve(q, 3, &mut workspace).unwrap();
            let (general, short) = (linkage.output(0, &workspace), position.jet(0, q));
            let size = short.first.abs() + short.second.abs() + short.third.abs();
            approx::assert_relative_eq!(general.value, short.value, max_relative = 1e-12);
            approx::assert_relative_eq!(general.first, short.first, epsilon = 1e-10 * size);
            approx::assert_relative_eq!(
                general.third,
                short.third,
                max_relative = 1e-9,
                epsilon = 1e-10 * size
            );
        }
    }
}

#[test]
fn a_rod_as_long_as_the_crank_passes_its_change_points() {
    let linkage = Linkage::new(slider_crank(0.2, 0.2, 0.0).start(0.3).0).unwrap();
    let range = linkage.range();
    assert_eq!(range.reach, Reach::Everywhere);
    let changes: Vec<f64> = range.changes.iter().map(|change| change.at).collect();
    approx::assert_abs_diff_eq!(changes[0], FRAC_PI_2, epsilon = 1e-14);
    approx::assert_abs_diff_eq!(changes[1], 1.5 * PI, epsilon = 1e-14);
    let mut workspace = linkage.workspace();
    for i in 0..200 {
        let q = -3.0 + 0.05 * f64::from(i);
        linkage.solve(q, 3, &mut workspace).unwrap();
        // The slide goes on through the crank's axis: x = 2r·cos φ.
        let slide = linkage.output(0, &workspace);
        approx::assert_abs_diff_eq!(slide.value, 0.4 * q.cos(), epsilon = 1e-13);
        approx::assert_abs_diff_eq!(slide.first, -0.4 * q.sin(), epsilon = 1e-11);
        approx::assert_abs_diff_eq!(slide.second, -0.4 * q.cos(), epsilon = 1e-9);
        approx::assert_abs_diff_eq!(slide.third, 0.4 * q.sin(), epsilon = 1e-6);
    }
}

#[test]
fn a_triad_is_followed_by_iteration_into_its_dead_positions() {
    let linkage = Linkage::new(triad().0).unwrap();
    assert_eq!(
        linkage.structure().groups[1].kind,
        GroupKind::Newton { links: 4 }
    );
    let [from, to] = linkage.range().ends();
    let mut workspace = linkage.workspace();
    for i in 1..200 {
        let q = match linkage.range().reach {
            Reach::Everywhere => TAU * f64::from(i) / 200.0,
            _ => from + (to - from) * f64::from(i) / 200.0,
        };
        linkage.solve(q, 3, &mut workspace).unwrap();
        assert!(closure_error(&linkage, &workspace) < 1e-13, "at {q}");
        compare_with_differences(&linkage, q).unwrap();
    }
    if let Reach::Interval { lower, upper } = &linkage.range().reach {
        for (end, inwards) in [(lower, 1.0), (upper, -1.0)] {
            assert!(matches!(end.cause, Cause::DeadPosition { group: 1 }));
            // dq/dx goes to zero like the root of the distance: squares of the
            // reciprocal speed extrapolate to the end.
            let slowness = |distance: f64, w: &mut crate::kinematics::linkage::Workspace| {
                linkage.solve(end.at + inwards * distance, 1, w).unwrap();
                (0..4)
                    .map(|l| w.transfer(l + 1, 1)[2].abs())
                    .fold(0.0, f64::max)
                    .powi(-2)
            };
            let (one, two) = (
                slowness(1e-6, &mut workspace),
                slowness(2e-6, &mut workspace),
            );
            let zero = 1e-6 - one * 1e-6 / (two - one);
            assert!(zero.abs() < 1e-8, "{end:?}: {zero}");
        }
    }
}

#[test]
fn a_cylinder_between_two_moving_links_drives_a_boom() {
    // Cylinder pinned at (0.5, 0), rod pinned to the boom about the origin.
    let linkage = Linkage::new(super::examples::cylinder().0).unwrap();
    assert_eq!(linkage.structure().groups[1].kind, GroupKind::Rrr);
    let [from, to] = linkage.range().ends();
    approx::assert_abs_diff_eq!(from, 0.2, epsilon = 1e-15);
    approx::assert_abs_diff_eq!(to, 0.8, epsilon = 1e-15);
    let mut workspace = linkage.workspace();
    for i in 1..50 {
        let q = from + (to - from) * f64::from(i) / 50.0;
        linkage.solve(q, 3, &mut workspace).unwrap();
        assert!(closure_error(&linkage, &workspace) < 1e-14);
        // Law of cosines: q² = 0.3² + 0.5² − 2·0.3·0.5·cos(angle of the boom).
        let angle = workspace.angle(2);
        let wanted = ((0.34 - q * q) / 0.3).acos();
        approx::assert_abs_diff_eq!(angle, wanted, epsilon = 1e-13);
        let pin = workspace.point(PointOf {
            link: Some(2),
            at: [0.3, 0.0],
        });
        let lever = 0.5 * 0.3 * angle.sin() / q;
        approx::assert_relative_eq!(
            workspace.transfer(2, 1)[2],
            lever.recip(),
            max_relative = 1e-11
        );
        assert!(pin[1].value > 0.0);
        compare_with_differences(&linkage, q).unwrap();
    }
    let ground = workspace.point(PointOf {
        link: GROUND,
        at: [1.0, 2.0],
    });
    assert_eq!((ground[0].value, ground[1].first), (1.0, 0.0));
}
