//! Positions with all links in line, passed on the branch of continuous velocity.

use super::examples::{Builder, GROUND, four_bar};
use super::known::runge_kutta;
use super::support::closure_error;
use crate::kinematics::linkage::spec::AssemblyChoice;
use crate::kinematics::linkage::{Cause, Linkage, Reach};
use std::f64::consts::{FRAC_PI_2, PI, TAU};

/// `windows` squares of 1 m side by side, bars of 1 kg (IFToMM benchmark A02).
fn windows(windows: usize) -> Builder {
    let names: Vec<String> = (0..=windows)
        .map(|k| format!("crank{k}"))
        .chain((0..windows).map(|k| format!("bar{k}")))
        .collect();
    let names: Vec<&str> = names.iter().map(String::as_str).collect();
    let mut builder = Builder::new(&names).start(FRAC_PI_2);
    for k in 0..=windows {
        builder = builder
            .pin((GROUND, [k as f64, 0.0]), (Some(k), [0.0; 2]))
            .choose(k, AssemblyChoice::Angle(FRAC_PI_2));
    }
    for k in 0..windows {
        let bar = Some(windows + 1 + k);
        builder = builder
            .pin((Some(k), [1.0, 0.0]), (bar, [0.0; 2]))
            .pin((bar, [1.0, 0.0]), (Some(k + 1), [1.0, 0.0]));
    }
    for link in 0..2 * windows + 1 {
        builder = builder.mass(link, 1.0, [0.5, 0.0], 1.0 / 12.0);
    }
    builder.0.gravity = [0.0, -9.81];
    builder
}

#[test]
fn rows_of_squares_turn_through_their_flat_positions() {
    for count in [1, 2] {
        let linkage = Linkage::new(windows(count).0).unwrap();
        let range = linkage.range();
        assert_eq!(range.reach, Reach::Everywhere);
        assert_eq!(range.period.map(|period| period.turns), Some(1));
        assert_eq!(range.changes.len(), 2 * count, "{:?}", range.changes);
        let mut workspace = linkage.workspace();
        for i in 0..2000 {
            // Through, beside and far from both flat positions.
            let distance = [0.0, 1e-12, -1e-7, 3e-4, 0.02, -0.2, 0.3, 0.7][i % 8];
            let q = PI * ((i / 8) % 5) as f64 - TAU + distance;
            linkage.solve(q, 3, &mut workspace).unwrap();
            assert!(closure_error(&linkage, &workspace) < 1e-13);
            for crank in 1..=count {
                let turned = workspace.turning(crank);
                approx::assert_abs_diff_eq!(turned.value, q, epsilon = 1e-12);
                approx::assert_abs_diff_eq!(turned.first, 1.0, epsilon = 1e-11);
                approx::assert_abs_diff_eq!(turned.second, 0.0, epsilon = 1e-9);
                approx::assert_abs_diff_eq!(turned.third, 0.0, epsilon = 1e-6);
            }
        }
    }
}

/// Figures at t = 10 s of the IFToMM benchmark A02, the top moving off at 1 m/s
/// to the right.
#[test]
fn rows_of_squares_fall_as_published() {
    for (count, x, y, vx, vy) in [
        (
            1,
            0.478385057756,
            0.878150178794,
            1.7272640755,
            -0.9409521794,
        ),
        (
            2,
            0.328458111536,
            0.944518538180,
            1.4230514702,
            -0.4948688455,
        ),
    ] {
        let linkage = Linkage::new(windows(count).0).unwrap();
        let mut workspace = linkage.workspace();
        let mut acceleration = |[q, v]: [f64; 2]| {
            linkage.solve(q, 2, &mut workspace).unwrap();
            let r = linkage.reduced_linkage(&workspace);
            (-r.potential[1] - 0.5 * r.inertia[1] * v * v) / r.inertia[0]
        };
        let (mut state, steps) = ([FRAC_PI_2, -1.0], 8000);
        for _ in 0..steps {
            state = runge_kutta(state, 10.0 / f64::from(steps), &mut acceleration);
        }
        let ([q, v], (sin, cos)) = (state, state[0].sin_cos());
        assert!(
            (q - FRAC_PI_2).abs() > 3.0,
            "it has gone through flat positions"
        );
        for (found, wanted) in [(cos, x), (sin, y), (-v * sin, vx), (v * cos, vy)] {
            approx::assert_abs_diff_eq!(found, wanted, epsilon = 1e-8);
        }
    }
}

#[test]
fn an_antiparallelogram_stays_crossed() {
    // Crossed at the start: the rocker turns against the crank.
    let linkage = four_bar([0.2, 0.5, 0.2, 0.5])
        .start(1.0)
        .choose(1, AssemblyChoice::Branch(-1.0));
    let linkage = Linkage::new(linkage.0).unwrap();
    assert_eq!(linkage.range().reach, Reach::Everywhere);
    let mut workspace = linkage.workspace();
    for i in 0..400 {
        let q = 0.05 * f64::from(i) - 10.0;
        linkage.solve(q, 3, &mut workspace).unwrap();
        assert!(closure_error(&linkage, &workspace) < 1e-13);
        let first = linkage.output(0, &workspace).first;
        // ψ′ = −(k² − 1)/(k² + 1 + 2k·cos φ) with k = 0.5/0.2: always backwards.
        let k = 2.5f64;
        let wanted = [-1.0, 1.0].map(|s| -(k * k - 1.0) / (k * k + 1.0 + s * 2.0 * k * q.cos()));
        let off = wanted.map(|w| (w - first).abs());
        assert!(off[0].min(off[1]) < 1e-11, "{q}: {first}, {wanted:?}");
    }
}

#[test]
fn links_that_nearly_fold_flat_end_beside_the_flat_position_and_pass_the_other() {
    // The coupler longer by 1e-9 cannot fold flat, shorter it cannot stretch:
    // sin²(half width/2) of the arc that is left out is 1.5 and 3.5 times that.
    for (excess, centre, share) in [(1e-9f64, 0.0, 1.5), (-1e-9, PI, 3.5)] {
        let spec = four_bar([0.2, 0.5 + excess, 0.2, 0.5]).start(1.0).0;
        let linkage = Linkage::new(spec).unwrap();
        let Reach::Interval { lower, upper } = &linkage.range().reach else {
            panic!("{:?}", linkage.range());
        };
        let half = 2.0 * (share * excess.abs()).sqrt().asin();
        let (from, to) = (
            centre + half - if centre > 1.0 { TAU } else { 0.0 },
            centre - half,
        );
        let to = if to < 1.0 { to + TAU } else { to };
        // Rounding of the lengths, 1e-16, counts 1e-7 of the excess.
        approx::assert_abs_diff_eq!(lower.at, from, epsilon = 1e-6 * half);
        approx::assert_abs_diff_eq!(upper.at, to, epsilon = 1e-6 * half);
        assert!(linkage.range().changes.is_empty());
        for end in [lower, upper] {
            assert!(matches!(end.cause, Cause::DeadPosition { group: 1 }));
        }
    }
}
