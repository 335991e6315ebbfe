use super::FourBar;
use proptest::prelude::*;
use std::f64::consts::{PI, TAU};

fn linkage(lengths: [f64; 4], branch: f64) -> FourBar {
    FourBar::new(lengths, branch, 0.0).unwrap()
}

/// Distance of crank end and rocker end, which the coupler must span.
fn span([a, _, c, d]: [f64; 4], theta: f64, psi: f64) -> f64 {
    let x = d + c * psi.cos() - a * theta.cos();
    let y = c * psi.sin() - a * theta.sin();
    x.hypot(y)
}

#[test]
fn open_and_crossed_branches_lie_where_they_should() {
    // A square with a = c = d = 1, b = 1 at θ = 90°: open ψ = 90°, crossed −180°.
    let square = [1.0, 1.0, 1.0, 1.0];
    let open = linkage(square, 1.0).jet(PI / 2.0).value;
    let crossed = linkage(square, -1.0).jet(PI / 2.0).value;
    approx::assert_abs_diff_eq!(open, PI / 2.0, epsilon = 1e-15);
    approx::assert_abs_diff_eq!(crossed.rem_euclid(TAU), PI, epsilon = 1e-15);
    // A crank-rocker: above the line of the pivots when open, below when crossed.
    let lengths = [0.1, 0.4, 0.3, 0.45];
    for i in 0..64 {
        let theta = 0.1 * f64::from(i);
        let above = linkage(lengths, 1.0).jet(theta).value;
        let below = linkage(lengths, -1.0).jet(-theta).value;
        assert!(above > 0.0 && above < PI);
        approx::assert_abs_diff_eq!(above, -below, epsilon = 1e-14);
    }
}

#[test]
fn a_crank_rocker_comes_back_and_a_double_crank_goes_round() {
    for (lengths, advance) in [
        ([0.1, 0.4, 0.3, 0.45], 0.0),
        ([0.4, 0.3, 0.45, 0.1], TAU),
        ([0.35, 0.4, 0.3, 0.1], TAU),
    ] {
        for branch in [1.0, -1.0] {
            let position = linkage(lengths, branch);
            assert_eq!(position.reach_from(0.0), Ok(None));
            let mut before = position.jet(0.0).value;
            for i in 1..=2000 {
                let theta = TAU * f64::from(i) / 1000.0;
                let now = position.jet(theta).value;
                assert!((now - before).abs() < 0.1, "{lengths:?} jumps at {theta}");
                let turned = now - position.jet(theta - TAU).value;
                approx::assert_abs_diff_eq!(turned, advance, epsilon = 1e-13);
                before = now;
            }
        }
    }
}

#[test]
fn reach_ends_where_coupler_and_rocker_are_in_line() {
    // Stretched: the crank cannot pass θ = π; cos θ = (a² + d² − (b+c)²)/2ad.
    let position = linkage([0.5, 0.3, 0.2, 0.4], 1.0);
    let limit = ((0.25 + 0.16 - 0.25) / 0.4f64).acos();
    let (from, to) = position.reach_from(0.4).unwrap().unwrap();
    approx::assert_abs_diff_eq!(to, limit, epsilon = 1e-14);
    approx::assert_abs_diff_eq!(
        span([0.5, 0.3, 0.2, 0.4], to, position.jet(to - 1e-12).value),
        0.3,
        epsilon = 1e-5
    );
    // Folded to (b − c) = 0.1 = |a − d|: a change point at θ = 0.
    approx::assert_abs_diff_eq!(from, 0.0, epsilon = 1e-7);
    assert!(position.reach_from(PI).is_err());
    // A double rocker, shortest link the coupler: forbidden at both ends.
    let position = linkage([0.4, 0.1, 0.5, 0.45], -1.0);
    let (from, to) = position.reach_from(-1.2).unwrap().unwrap();
    let edge = |f: f64| ((0.16 + 0.2025 - f * f) / 0.36f64).acos();
    approx::assert_abs_diff_eq!(from, -edge(0.6), epsilon = 1e-14);
    approx::assert_abs_diff_eq!(to, -edge(0.4), epsilon = 1e-14);
    for (inside, outside) in [(from + 1e-8, from - 1e-8), (to - 1e-8, to + 1e-8)] {
        assert!(position.jet(inside).is_finite() && position.jet(outside).value.is_nan());
    }
}

#[test]
fn a_parallelogram_turns_with_its_crank_up_to_its_change_points() {
    let position = linkage([0.2, 0.5, 0.2, 0.5], 1.0);
    let (from, to) = position.reach_from(1.0).unwrap().unwrap();
    approx::assert_abs_diff_eq!(from, 0.0, epsilon = 1e-7);
    approx::assert_abs_diff_eq!(to, PI, epsilon = 1e-7);
    for theta in [1e-3, 0.5, 2.0, 3.1] {
        let jet = position.jet(theta);
        approx::assert_abs_diff_eq!(jet.value, theta, epsilon = 1e-14);
        approx::assert_abs_diff_eq!(jet.first, 1.0, epsilon = 1e-10);
        approx::assert_abs_diff_eq!(jet.second, 0.0, epsilon = 1e-7);
    }
}

#[test]
fn links_that_cannot_close_are_refused() {
    let faults = FourBar::new([0.1, 0.2, 0.3, 0.7], 1.0, 0.0).unwrap_err();
    assert_eq!(faults.len(), 1);
    assert_eq!(faults[0].path, "four_bar.frame");
    assert_eq!(
        FourBar::new([0.0, -1.0, 1.0, f64::NAN], 0.0, 0.0)
            .unwrap_err()
            .len(),
        4
    );
}

proptest! {
    #[test]
    fn the_loop_closes_and_its_derivatives_vanish(
        lengths in prop::array::uniform4(0.1f64..1.0),
        theta in -20.0f64..20.0,
        crossed: bool,
    ) {
        let branch = if crossed { -1.0 } else { 1.0 };
        let Ok(position) = FourBar::new(lengths, branch, 0.0) else { return Ok(()) };
        let Ok(reach) = position.reach_from(theta) else {
            prop_assert!(!position.jet(theta).is_finite());
            return Ok(());
        };
        // Away from dead-centre positions, where derivatives are without bound.
        if reach.is_some_and(|(from, to)| (theta - from).min(to - theta) < 0.02) {
            return Ok(());
        }
        let jet = position.jet(theta);
        let [a, b, c, d] = lengths;
        prop_assert!((span(lengths, theta, jet.value) - b).abs() < 1e-12);
        // d/dθ and d²/dθ² of |B − A|² = b², with B − A = w.
        let (sin, cos) = theta.sin_cos();
        let (sin_rocker, cos_rocker) = jet.value.sin_cos();
        let w = [d + c * cos_rocker - a * cos, c * sin_rocker - a * sin];
        let dw = [-c * sin_rocker * jet.first + a * sin, c * cos_rocker * jet.first - a * cos];
        let square = jet.first * jet.first;
        let ddw = [
            -c * (cos_rocker * square + sin_rocker * jet.second) + a * cos,
            c * (-sin_rocker * square + cos_rocker * jet.second) + a * sin,
        ];
        let dot = |p: [f64; 2], q: [f64; 2]| p[0] * q[0] + p[1] * q[1];
        let scale = 1.0 + square + jet.second.abs();
        prop_assert!(dot(w, dw).abs() < 1e-11 * scale);
        prop_assert!((dot(dw, dw) + dot(w, ddw)).abs() < 1e-10 * scale);
    }
}
