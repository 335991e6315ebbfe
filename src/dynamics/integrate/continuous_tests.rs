//! Continuous output against an exact motion.

use super::super::Modes;
use super::super::tests::problems::Swinging;
use super::*;

/// Greatest error of both signals, u and u², over a step of length h
/// around t = 0.4 s between exact ends, after so many raises (`None`: through the middle).
fn error(damping: f64, h: f64, raises: Option<usize>) -> f64 {
    let system = Swinging {
        damping,
        limit: 9.0,
    };
    let evaluator = Evaluator::new(&system, &Modes::default());
    let end = |time: f64| {
        let mut end = End::new(1, 2);
        let (y, mut dy) = (system.exact(time), [0.0; 2]);
        evaluator.derivatives(time, &y, &mut dy);
        end.set(&evaluator, time, &y, &dy);
        end
    };
    // Around one and the same time, where no derivative happens to vanish.
    let (from, to) = (end(0.4 - 0.5 * h), end(0.4 + 0.5 * h));
    let mut output = Output::new(1, 2);
    output.quintic(&from, &to);
    match raises {
        Some(count) => (0..count).for_each(|_| output.raise(&evaluator, &from, &to)),
        None => output.through_middle(&evaluator, &from, &system.exact(0.4), &to),
    }
    let step = output.step(1.0);
    let differences = (0..=40).map(|k| {
        let s = f64::from(k) / 40.0;
        let u = system.exact(step.time(s))[0];
        let found = |signal| step.value(signal, s).0;
        (found(0) - u).abs().max((found(1) - u * u).abs())
    });
    differences.fold(0.0, f64::max)
}

#[test]
fn the_orders_are_six_eight_and_nine() {
    for (damping, raises, order) in [
        (0.0, Some(0), 6.0),
        (0.3, Some(0), 6.0),
        (0.3, None, 6.0),
        (0.3, Some(1), 8.0),
        (0.0, Some(1), 8.0),
        (0.3, Some(2), 9.0),
    ] {
        let (coarse, fine) = (error(damping, 0.6, raises), error(damping, 0.3, raises));
        let measured = (coarse / fine).log2();
        assert!(
            measured > order - 0.5,
            "damping {damping}, {raises:?}: order {measured}"
        );
    }
    assert!(error(0.1, 0.5, Some(1)) < 1e-3 * error(0.1, 0.5, Some(0)));
}

/// A great common value, as an angle has after many turns, costs no more
/// digits than its own rounding.
#[test]
fn a_great_common_value_costs_no_digits() {
    let mut output = Output::new(1, 1);
    let end = |time: f64| End {
        time,
        y: vec![0.0; 2],
        dy: vec![0.0; 2],
        signals: vec![[1e9 + time * time, 2.0 * time, 2.0]],
    };
    output.quintic(&end(0.0), &end(1.0));
    output.accelerations[0] = [2.0; 3];
    output.degree = 8;
    output.fill_ends(&end(0.0), &end(1.0));
    output.fill_middle_coefficients(3);
    let step = output.step(1.0);
    for k in 0..=10 {
        let s = f64::from(k) / 10.0;
        let value = step.value(0, s).0;
        assert!((value - 1e9 - s * s).abs() < 1e-6);
    }
}
