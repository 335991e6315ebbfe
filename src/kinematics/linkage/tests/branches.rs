//! What the branch + of every dyad means, where the range ends, how outputs
//! count turns.

use super::examples::{Builder, GROUND, cylinder, four_bar, slider_crank, slotted_link};
use super::support::closure_error;
use crate::kinematics::linkage::spec::{AssemblyChoice, LinkageSpec, PairKind, PointOf};
use crate::kinematics::linkage::{Cause, GroupKind, Linkage, Period, RangeEnd, Reach, Workspace};
use std::f64::consts::{FRAC_PI_2, PI, TAU};

fn at(workspace: &Workspace, link: Option<usize>, at: [f64; 2]) -> [f64; 2] {
    workspace.point(PointOf { link, at }).map(|jet| jet.value)
}

fn solved(builder: Builder, q: f64) -> (Linkage, Workspace) {
    let linkage = Linkage::new(builder.0).unwrap();
    let mut workspace = linkage.workspace();
    linkage.solve(q, 3, &mut workspace).unwrap();
    (linkage, workspace)
}

#[test]
fn plus_is_to_the_left_ahead_and_with_the_block_in_front() {
    for sign in [1.0, -1.0] {
        let branch = AssemblyChoice::Branch(sign);
        let (linkage, w) = solved(four_bar([0.1, 0.4, 0.3, 0.45]).choose(1, branch), 0.7);
        assert_eq!(linkage.structure().groups[1].branch, Some(sign));
        let (a, b) = (at(&w, Some(1), [0.0; 2]), at(&w, Some(1), [0.4, 0.0]));
        let left = (0.45 - a[0]) * (b[1] - a[1]) - (0.0 - a[1]) * (b[0] - a[0]);
        assert!(left * sign > 0.0);
        let (_, w) = solved(slider_crank(0.1, 0.35, 0.03).choose(2, branch), 0.7);
        let (a, b) = (at(&w, Some(1), [0.0; 2]), at(&w, Some(2), [0.0; 2]));
        assert!((b[0] - a[0]) * sign > 0.0);
        // The guide on the link about O2 (second), then on the block (first).
        let (_, w) = solved(
            slotted_link([0.0, 0.3], [0.0; 2], 0.1).choose(1, branch),
            0.7,
        );
        assert!(w.pair(2).value * sign > 0.0);
        let turned = Builder::new(&["crank", "block", "slot"])
            .pin((GROUND, [0.0, 0.3]), (Some(0), [0.0; 2]))
            .pin((Some(0), [0.1, 0.0]), (Some(1), [0.0; 2]))
            .slide((Some(1), [0.0; 2]), (Some(2), [0.0; 2]), 0.4, 0.2)
            .pin((GROUND, [0.0; 2]), (Some(2), [0.0; 2]))
            .choose(2, branch);
        let (_, w) = solved(turned, 0.7);
        // The block is now the link about O2.
        assert!(w.pair(2).value * sign > 0.0);
    }
}

#[test]
fn approximate_positions_choose_the_nearer_assembly() {
    for (angle, below) in [(1.0, false), (-1.0, true)] {
        let (_, w) = solved(
            four_bar([0.1, 0.4, 0.3, 0.45]).choose(2, AssemblyChoice::Angle(angle)),
            0.0,
        );
        assert_eq!(w.pose(2).sin < 0.0, below);
        let near = AssemblyChoice::Near {
            point: [0.4, 0.0],
            place: [0.3, angle],
        };
        let (_, w) = solved(four_bar([0.1, 0.4, 0.3, 0.45]).choose(1, near), 0.0);
        assert_eq!(w.pose(2).sin < 0.0, below);
    }
}

#[test]
fn the_travel_ends_the_reach_and_the_driver_may_be_given_backwards() {
    let mut builder = cylinder();
    builder.0.travel = Some([0.3, 0.6]);
    let linkage = Linkage::new(builder.0).unwrap();
    let end = |at| RangeEnd {
        at,
        cause: Cause::Travel,
    };
    let (lower, upper) = (end(0.3), end(0.6));
    assert_eq!(linkage.range().reach, Reach::Interval { lower, upper });
    let mut workspace = linkage.workspace();
    assert_eq!(
        linkage.solve(0.7, 0, &mut workspace).unwrap_err().end,
        upper
    );
    for q in [0.3, 0.6] {
        assert!(linkage.solve(q, 3, &mut workspace).is_ok());
    }
    let mut builder = cylinder();
    builder.0.travel = Some([0.4, 0.6]);
    let linkage = Linkage::new(builder.0).unwrap();
    let mut workspace = linkage.workspace();
    for q in [0.4, 0.4 + 1e-12, 0.5, 0.6] {
        linkage.solve(q, 3, &mut workspace).unwrap();
        let wanted = ((0.34 - q * q) / 0.3).acos();
        approx::assert_abs_diff_eq!(workspace.angle(2), wanted, epsilon = 1e-13);
    }
    // A crank whose driver is written from the crank to the ground: −θ is the input.
    let mut builder = four_bar([0.1, 0.4, 0.3, 0.45]);
    let pair = &mut builder.0.pairs[0];
    std::mem::swap(&mut pair.on, &mut pair.link);
    let (linkage, workspace) = solved(builder, 4.0);
    approx::assert_abs_diff_eq!(workspace.angle(0), -4.0, epsilon = 1e-14);
    approx::assert_abs_diff_eq!(workspace.pair(0).value, 4.0, epsilon = 1e-14);
    assert!(closure_error(&linkage, &workspace) < 1e-14);
    // A sliding driver written from the slide to the ground.
    let mut builder = slider_crank(0.1, 0.35, 0.0).choose(0, AssemblyChoice::Angle(1.0));
    builder.0.driver = 3;
    let pair = &mut builder.0.pairs[3];
    std::mem::swap(&mut pair.on, &mut pair.link);
    builder.0.start = -0.4;
    let linkage = Linkage::new(builder.0).unwrap();
    let [from, to] = linkage.range().ends();
    approx::assert_abs_diff_eq!(from, -0.45, epsilon = 1e-15);
    approx::assert_abs_diff_eq!(to, -0.25, epsilon = 1e-15);
}

#[test]
fn angles_count_their_turns() {
    // A double crank gains a turn a turn; the driver's angle is the input.
    let (linkage, mut w) = solved(four_bar([0.4, 0.3, 0.45, 0.1]).start(7.0), 7.0);
    assert_eq!(
        linkage.range().period,
        Some(Period {
            length: TAU,
            turns: 1
        })
    );
    let first = w.angle(2);
    for turns in [-1000.0, -1.0, 3.0, 40.0] {
        linkage.solve(7.0 + turns * TAU, 1, &mut w).unwrap();
        approx::assert_abs_diff_eq!(w.angle(2) - first, turns * TAU, epsilon = 1e-10);
        approx::assert_abs_diff_eq!(w.angle(0), 7.0 + turns * TAU, epsilon = 1e-10);
    }
    let mut before = first;
    for i in 0..1000 {
        linkage.solve(7.0 + 0.05 * f64::from(i), 1, &mut w).unwrap();
        assert!((w.angle(2) - before).abs() < 0.3);
        before = w.angle(2);
    }
}

#[test]
fn a_lone_link_goes_everywhere() {
    let turning = Builder::new(&["link"]).pin((GROUND, [0.0; 2]), (Some(0), [0.0; 2]));
    let (linkage, w) = solved(turning.mass(0, 2.0, [0.5, 0.0], 0.1), 100.0);
    approx::assert_abs_diff_eq!(w.angle(0), 100.0, epsilon = 1e-12);
    approx::assert_relative_eq!(
        linkage.reduced_linkage(&w).inertia[0],
        0.6,
        max_relative = 1e-14
    );
    let sliding =
        Builder::new(&["link"]).slide((GROUND, [0.0; 2]), (Some(0), [0.0; 2]), FRAC_PI_2, 0.0);
    let (linkage, w) = solved(sliding.mass(0, 2.0, [0.5, 0.0], 0.1), 1e6);
    assert_eq!(linkage.range().reach, Reach::Everywhere);
    assert_eq!(linkage.reduced_linkage(&w).inertia, [2.0, 0.0, 0.0]);
    approx::assert_abs_diff_eq!(w.pose(0).y, 1e6, epsilon = 1e-9);
}

#[test]
fn a_yoke_and_a_cross_slide_have_the_closed_forms() {
    // Scotch yoke: the crank's pin in a vertical slot of a slide along x.
    let yoke = Builder::new(&["crank", "block", "yoke"])
        .pin((GROUND, [0.0; 2]), (Some(0), [0.0; 2]))
        .pin((Some(0), [0.2, 0.0]), (Some(1), [0.0; 2]))
        .slide((Some(2), [0.0; 2]), (Some(1), [0.0; 2]), FRAC_PI_2, 0.0)
        .slide((GROUND, [0.0; 2]), (Some(2), [0.0; 2]), 0.0, 0.0);
    let (linkage, w) = solved(yoke, 0.8);
    assert_eq!(linkage.structure().groups[1].kind, GroupKind::Rpp);
    let slide = w.pair(3);
    approx::assert_abs_diff_eq!(slide.value, 0.2 * 0.8f64.cos(), epsilon = 1e-15);
    approx::assert_abs_diff_eq!(slide.third, 0.2 * 0.8f64.sin(), epsilon = 1e-15);
    // Ellipsograph driven by one slide: a bar of 0.5 m on two axes.
    let mut cross = Builder::new(&["one", "bar", "other"])
        .slide((GROUND, [0.0; 2]), (Some(0), [0.0; 2]), 0.0, 0.0)
        .pin((Some(0), [0.0; 2]), (Some(1), [0.0; 2]))
        .pin((Some(1), [0.5, 0.0]), (Some(2), [0.0; 2]))
        .slide((GROUND, [0.0; 2]), (Some(2), [0.0; 2]), FRAC_PI_2, 0.0)
        .start(0.3);
    cross.0.travel = Some([-1.0, 1.0]);
    let (linkage, w) = solved(cross, 0.3);
    assert_eq!(linkage.structure().groups[1].kind, GroupKind::Rrp);
    approx::assert_abs_diff_eq!(w.pair(3).value, 0.4, epsilon = 1e-15);
    let [from, to] = linkage.range().ends();
    approx::assert_abs_diff_eq!(from, -0.5, epsilon = 1e-15);
    approx::assert_abs_diff_eq!(to, 0.5, epsilon = 1e-15);
}

#[test]
fn guides_that_become_parallel_end_the_reach() {
    // A turning guide crosses a fixed one, y = 0.5, at x = 0.5·cot φ.
    let crossing = Builder::new(&["arm", "block", "slide"])
        .pin((GROUND, [0.0; 2]), (Some(0), [0.0; 2]))
        .slide((Some(0), [0.0; 2]), (Some(1), [0.0; 2]), 0.0, 0.0)
        .pin((Some(1), [0.0; 2]), (Some(2), [0.0; 2]))
        .slide((GROUND, [0.0, 0.5]), (Some(2), [0.0; 2]), 0.0, 0.0)
        .start(1.0);
    let (linkage, mut w) = solved(crossing, 1.0);
    assert_eq!(linkage.structure().groups[1].kind, GroupKind::Prp);
    let Reach::Interval { lower, upper } = linkage.range().reach.clone() else {
        panic!("{:?}", linkage.range());
    };
    approx::assert_abs_diff_eq!(lower.at, 0.0, epsilon = 1e-15);
    approx::assert_abs_diff_eq!(upper.at, PI, epsilon = 1e-15);
    assert!(matches!(lower.cause, Cause::DeadPosition { group: 1 }));
    for q in [1e-3, 0.4, 2.0, 3.1] {
        linkage.solve(q, 2, &mut w).unwrap();
        let slide = w.pair(3);
        approx::assert_relative_eq!(slide.value, 0.5 / q.tan(), max_relative = 1e-13);
        approx::assert_relative_eq!(slide.first, -0.5 / q.sin().powi(2), max_relative = 1e-12);
    }
}

#[test]
fn a_block_drives_through_the_pivot_where_crank_and_frame_are_equal() {
    let mut builder = slotted_link([0.1, 0.0], [0.0; 2], 0.1).start(0.1);
    builder.0.driver = 2;
    let linkage = Linkage::new(builder.choose(0, AssemblyChoice::Angle(-2.0)).0).unwrap();
    let range = linkage.range();
    let [from, to] = range.ends();
    approx::assert_abs_diff_eq!(from, -0.2, epsilon = 1e-14);
    approx::assert_abs_diff_eq!(to, 0.2, epsilon = 1e-14);
    approx::assert_abs_diff_eq!(range.changes[0].at, 0.0, epsilon = 1e-14);
    let mut w = linkage.workspace();
    for s in [-0.19, -1e-3, 0.0, 1e-9, 0.07] {
        linkage.solve(s, 2, &mut w).unwrap();
        // S = 2·l·cos(φ/2).
        let phi = w.angle(0);
        approx::assert_abs_diff_eq!(0.2 * (phi / 2.0).cos().abs(), f64::abs(s), epsilon = 1e-14);
        let slope = 1.0 / (0.1 * (phi / 2.0).sin()).abs();
        approx::assert_abs_diff_eq!(w.transfer(0, 1)[2], slope, epsilon = 1e-9);
    }
}

#[test]
fn a_spec_is_kept_as_it_was_given() {
    let spec: LinkageSpec = four_bar([0.1, 0.4, 0.3, 0.45]).0;
    let linkage = Linkage::new(spec.clone()).unwrap();
    assert_eq!(linkage.spec(), &spec);
    assert!(matches!(spec.pairs[0].kind, PairKind::Revolute { .. }));
    fn shared<T: Send + Sync>(_: &T) {}
    shared(&linkage);
}
