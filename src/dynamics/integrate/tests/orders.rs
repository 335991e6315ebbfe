//! Orders of the methods and of the continuous output, measured.

use super::problems::Oscillator;
use super::*;

/// Error at the end after steps of a fixed length: the scales are so great
/// that the error control never speaks.
fn error_of_fixed_steps(method: Method, tolerance: f64, damping: f64, steps: u32) -> f64 {
    let system = Oscillator {
        damping,
        amplitude: 1.0,
        driving: 0.7,
        scales: [1e12, 1e12],
        ..Oscillator::free(1.0)
    };
    let end = 4.0;
    // First steps are estimated: not greater than the limit, so equal to it.
    let fixed = settings(method, tolerance, Some(end / f64::from(steps)));
    let (outcome, keeper) = run(&system, end, &[1.0, 0.0], &[], &fixed);
    assert_eq!(outcome.stop, Stop::Complete);
    assert_eq!(outcome.statistics.steps, u64::from(steps), "{method}");
    let exact = system.exact(end);
    (keeper.y[0] - exact[0]).hypot(keeper.y[1] - exact[1])
}

fn slope(method: Method, damping: f64, steps: u32) -> f64 {
    slope_at(method, 0.5, damping, steps)
}

fn slope_at(method: Method, tolerance: f64, damping: f64, steps: u32) -> f64 {
    let coarse = error_of_fixed_steps(method, tolerance, damping, steps);
    let fine = error_of_fixed_steps(method, tolerance, damping, 2 * steps);
    (coarse / fine).log2()
}

#[test]
fn rk4_is_of_order_four() {
    for damping in [0.0, 0.1] {
        let order = slope(Method::Rk4, damping, 40);
        assert!((order - 4.0).abs() < 0.2, "{order}");
    }
}

#[test]
fn dopri5_is_of_order_five() {
    for damping in [0.0, 0.1] {
        let order = slope(Method::Dopri5, damping, 40);
        assert!((order - 5.0).abs() < 0.2, "{damping}: {order}");
    }
}

/// With the wrong nodes of the inherited solver the order would be one here:
/// the right-hand side depends on time.
#[test]
fn dop853_is_of_order_eight_also_where_the_right_hand_side_depends_on_time() {
    for damping in [0.0, 0.1] {
        let order = slope(Method::Dop853, damping, 8);
        assert!((order - 8.0).abs() < 0.4, "{damping}: {order}");
    }
}

/// Newton's method needs the tolerance, so that fixed steps would not do: the
/// order shows in how the error falls with the number of steps.
#[test]
#[cfg(feature = "diffsol")]
fn tr_bdf2_is_of_order_two_and_esdirk34_of_order_three() {
    let system = Oscillator::free(2.0);
    let end = 5.3 * system.period();
    for (method, order) in [(Method::TrBdf2, 2.0), (Method::Esdirk34, 3.0)] {
        let measure = |tolerance: f64| {
            let settings = settings(method, tolerance, None);
            let (outcome, keeper) = run(&system, end, &[1.0, 0.0], &[], &settings);
            let error = (keeper.y[0] - system.exact(end)[0]).abs();
            (error, outcome.statistics.steps as f64)
        };
        let (coarse, fine) = (measure(1e-5), measure(1e-7));
        let measured = (coarse.0 / fine.0).ln() / (fine.1 / coarse.1).ln();
        assert!((measured - order).abs() < 0.2, "{method}: {measured}");
    }
}

/// Long steps, whose error is far above rounding.
#[test]
fn rodas5p_is_of_order_five_also_where_the_right_hand_side_depends_on_time() {
    for damping in [0.0, 0.1] {
        let order = slope(Method::Rodas5p, damping, 20);
        assert!((order - 5.0).abs() < 0.3, "{damping}: {order}");
    }
}

/// The number of stages follows the tolerance.
#[test]
fn radau_is_of_order_five_nine_or_thirteen() {
    for (tolerance, steps, expected) in [(0.5, 20, 5.0), (1e-2, 4, 9.0), (1e-3, 2, 13.0)] {
        for damping in [0.0, 0.1] {
            let order = slope_at(Method::Radau, tolerance, damping, steps);
            assert!((order - expected).abs() < 0.4, "{damping}: {order}");
        }
    }
}

/// The series has degree 10 at this tolerance, that of the speed one less: so is
/// the order.
#[test]
fn taylor_is_of_the_order_of_its_degree() {
    for damping in [0.0, 0.1] {
        let order = slope(Method::Taylor, damping, 3);
        assert!((order - 9.0).abs() < 0.4, "{damping}: {order}");
    }
}

/// For every adaptive method the error follows the tolerance, and stays below
/// a few times its size over five oscillations.
#[test]
fn the_error_follows_the_tolerance() {
    let system = Oscillator::free(2.0);
    let end = 5.3 * system.period();
    for (method, bound, power) in [
        (Method::Dopri5, 1.0, 1.0),
        (Method::Dop853, 1.0, 1.0),
        (Method::Taylor, 1.0, 0.9),
        (Method::Rodas5p, 10.0, 0.9),
        (Method::Radau, 10.0, 0.9),
        (Method::Bdf, 20.0, 0.9),
        (Method::TrBdf2, 2000.0, 0.6),
        (Method::Esdirk34, 200.0, 0.7),
    ] {
        if !method.is_available() {
            continue;
        }
        let error = |tolerance: f64| {
            let (outcome, keeper) = run(
                &system,
                end,
                &[1.0, 0.0],
                &[],
                &settings(method, tolerance, None),
            );
            assert_eq!(outcome.stop, Stop::Complete);
            (keeper.y[0] - system.exact(end)[0]).abs()
        };
        let (coarse, fine) = (error(1e-4), error(1e-7));
        assert!(fine <= bound * 1e-7, "{method}: {fine:e}");
        let measured = (coarse / fine).log10() / 3.0;
        assert!(measured > power - 0.15, "{method}: {measured}");
    }
}

/// Between the ends of the steps the continuous output is as good as the
/// method, over the whole range of tolerances, and without jumps.
#[test]
fn the_continuous_output_keeps_the_tolerance_too() {
    let system = Oscillator {
        amplitude: 30.0,
        driving: 3.0,
        ..Oscillator::free(7.0)
    };
    let end = 3.0;
    for (method, factor) in [
        (Method::Dopri5, 2.0),
        (Method::Dop853, 2.0),
        (Method::Taylor, 2.0),
        (Method::Rodas5p, 10.0),
        (Method::Radau, 10.0),
        (Method::Bdf, 50.0),
        (Method::Esdirk34, 500.0),
    ] {
        if !method.is_available() {
            continue;
        }
        for tolerance in [1e-4, 1e-7, 1e-10] {
            if tolerance < 1e-8 && matches!(method, Method::Bdf | Method::Esdirk34) {
                continue;
            }
            let (_, keeper) = run(
                &system,
                end,
                &[1.0, 0.0],
                &[],
                &settings(method, tolerance, None),
            );
            let error = |&(t, u): &(f64, f64)| (u - system.exact(t)[0]).abs();
            let worst = keeper.samples.iter().map(error).fold(0.0, f64::max);
            assert!(
                worst < factor * tolerance,
                "{method} {tolerance:e}: {worst:e}"
            );
            assert!(keeper.gap < 1e-14, "{method}: jump of {:e}", keeper.gap);
        }
    }
}
