//! One test for each trap of the inherited solvers that the adapter has to
//! know, and for what the adapter makes of it. A test of the first kind that
//! fails after an upgrade says that a precaution may be dropped.

use super::problems::{Oscillator, Rocker};
use super::*;
use ode_solvers::{DVector, Dop853, Dopri5, OutputType, Rk4, System};
use std::cell::RefCell;

/// y′ = 3t² or not a number, noting what the solver tells.
struct Probe<'a> {
    rate: fn(f64) -> f64,
    told: &'a RefCell<Vec<[f64; 3]>>,
}

impl System<f64, DVector<f64>> for Probe<'_> {
    fn system(&self, t: f64, _: &DVector<f64>, dy: &mut DVector<f64>) {
        dy[0] = (self.rate)(t);
    }

    fn solout(&mut self, t: f64, y: &DVector<f64>, dy: &DVector<f64>) -> bool {
        self.told.borrow_mut().push([t, y[0], dy[0]]);
        false
    }
}

fn zero() -> DVector<f64> {
    DVector::from_element(1, 0.0)
}

#[test]
fn rk4_overshoots_the_end_and_gives_the_old_derivative() {
    let told = RefCell::default();
    let rate = |t: f64| 3.0 * t * t;
    let probe = Probe { rate, told: &told };
    Rk4::new(probe, 0.0, zero(), 1.0, 0.3).integrate().unwrap();
    let [t, y, dy] = *told.borrow().last().unwrap();
    assert!((t - 1.2).abs() < 1e-12, "the end was 1.0");
    assert!((y - 1.2f64.powi(3)).abs() < 1e-12);
    assert!((dy - rate(0.9)).abs() < 1e-12, "not of the point given");
}

#[test]
fn rk4_of_ours_lands_on_the_end_with_whole_steps() {
    let system = Oscillator::free(1.0);
    let (outcome, keeper) = run(
        &system,
        1.0,
        &[1.0, 0.0],
        &[],
        &settings(Method::Rk4, 1e-6, Some(0.3)),
    );
    assert_eq!((outcome.time, outcome.statistics.steps), (1.0, 4));
    // A derivative of the old point would show between the ends.
    for &(t, u) in &keeper.samples {
        assert!((u - t.cos()).abs() < 1e-4);
    }
    assert_eq!(outcome.statistics.evaluations, 1 + 4 * 4, "none twice");
}

#[test]
fn rk4_says_ok_to_a_state_that_is_no_number() {
    let told = RefCell::default();
    let rate = |_: f64| f64::NAN;
    let probe = Probe { rate, told: &told };
    assert!(Rk4::new(probe, 0.0, zero(), 1.0, 0.1).integrate().is_ok());
    assert!(told.borrow().last().unwrap()[1].is_nan());
}

#[test]
fn dense_output_of_dopri5_gives_times_and_states_that_do_not_belong_together() {
    let consistent = |output: OutputType| {
        let told = RefCell::default();
        let rate = |t: f64| 3.0 * t * t;
        let probe = Probe { rate, told: &told };
        Dopri5::from_param(
            probe,
            0.0,
            1.0,
            0.1,
            zero(),
            1e-9,
            1e-9,
            0.9,
            0.04,
            0.2,
            10.0,
            1.0,
            0.0,
            1000,
            1000,
            output,
        )
        .integrate()
        .unwrap();
        let told = told.borrow();
        told.iter().all(|[t, y, _]| (y - t.powi(3)).abs() < 1e-9)
    };
    assert!(consistent(OutputType::Sparse));
    assert!(!consistent(OutputType::Dense));
}

#[test]
fn dop853_asks_at_a_wrong_time() {
    let told = RefCell::default();
    let rate = |t: f64| 3.0 * t * t;
    let probe = Probe { rate, told: &told };
    let mut solver = Dop853::from_param(
        probe,
        0.0,
        1.0,
        0.1,
        zero(),
        1.0,
        1.0,
        0.9,
        0.0,
        0.333,
        6.0,
        1.0,
        1.0,
        1000,
        1000,
        OutputType::Sparse,
    );
    solver.integrate().unwrap();
    let end = solver.y_out().last().unwrap()[0];
    assert!((end - 1.0).abs() > 1e-2, "a cubic would be exact: {end}");
}

/// The same motion in millimetres and radians: the steps are the same.
#[test]
fn the_tolerance_is_relative_to_the_scale_of_each_state() {
    let count = |unit: f64, method: Method| {
        let system = Oscillator {
            scales: [unit, 2.0 * unit],
            ..Oscillator::free(2.0)
        };
        let loose = settings(method, 1e-6, None);
        let (outcome, keeper) = run(&system, 9.0, &[unit, 0.0], &[], &loose);
        (outcome.statistics, (keeper.y[0] / unit - 18f64.cos()).abs())
    };
    for method in [Method::Dopri5, Method::Dop853, Method::Bdf] {
        if !method.is_available() {
            continue;
        }
        let (statistics, error) = count(1.0, method);
        // Powers of two: not even the rounding differs.
        assert_eq!(count(2f64.powi(-40), method), (statistics, error));
    }
}

/// The same motion a million times slower or faster takes as many steps: no
/// second is built in anywhere, and time as a state does not disturb the error.
#[test]
fn no_unit_of_time_is_built_in() {
    let count = |omega: f64, method: Method| {
        let system = Oscillator::free(omega);
        let loose = settings(method, 1e-6, None);
        let (outcome, _) = run(&system, 18.0 / omega, &[1.0, 0.0], &[], &loose);
        assert_eq!(outcome.stop, Stop::Complete, "{method}");
        outcome.statistics.steps
    };
    for method in [
        Method::Dopri5,
        Method::Dop853,
        Method::Bdf,
        Method::Esdirk34,
    ] {
        if !method.is_available() {
            continue;
        }
        let steps = count(1.0, method);
        for omega in [2f64.powi(-20), 2f64.powi(30)] {
            let other = count(omega, method);
            assert!(other.abs_diff(steps) <= 1, "{method}: {steps} and {other}");
        }
    }
}

/// More steps than a solver is given at once, and stiff for more than 15 of
/// them in a row: the run goes on to its end.
#[test]
fn long_and_stiff_runs_of_explicit_methods_reach_their_end() {
    let system = Oscillator {
        damping: 50.0,
        amplitude: 1.0,
        driving: 0.01,
        ..Oscillator::free(1.0)
    };
    for method in [Method::Dopri5, Method::Dop853] {
        let loose = settings(method, 1e-4, None);
        let (outcome, keeper) = run(&system, 1000.0, &[0.0, 0.0], &[], &loose);
        assert_eq!(outcome.stop, Stop::Complete, "{method}");
        assert!(outcome.statistics.steps > 9000, "{:?}", outcome.statistics);
        assert!(keeper.gap < 1e-12, "{method}");
    }
    let fixed = settings(Method::Rk4, 1e-4, Some(0.01));
    let (outcome, _) = run(&system, 100.0, &[0.0, 0.0], &[], &fixed);
    assert_eq!(outcome.statistics.steps, 10_000);
}

/// All evaluations are accounted for: rejected steps are counted, those before
/// the first accepted one too.
#[test]
fn rejected_steps_are_counted() {
    let system = Rocker::published(2, 0.4);
    let (y, modes) = system.static_start();
    let (outcome, _) = run(
        &system,
        0.05,
        &y,
        &modes.0,
        &settings(Method::Dopri5, 1e-6, None),
    );
    let s = outcome.statistics;
    assert!(s.rejected > 0);
    // Six for every attempt; one after every switch and at the start; two for
    // the first step in each of the two modes; four for each switch located,
    // which may be found to be none.
    let attempts = 6 * (s.steps + s.rejected);
    let others = s.evaluations - attempts;
    let expected = 1 + 2 + s.switches * (1 + 4);
    assert!(
        others >= expected - 1 && others <= expected + 8,
        "{others} {expected}"
    );
}
