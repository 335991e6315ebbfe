//! When impacts in ever shorter times have come to rest.
//!
//! What leaves a flank at the speed v and is pressed back with the acceleration a > 0 comes
//! down after 2v/a, with the same speed, and leaves with e·v: its flights form a geometric
//! series, of which 2v/(a·(1 − e)) are left. While they are higher than can be told they are
//! followed one by one; the rest of the series is summed.

/// Height of a flight below which it is not followed (m or rad); of one that is told from
/// greater numbers so many roundings of those.
const LEAST_HEIGHT: f64 = 1e-18;
const ROUNDINGS: f64 = 1024.0;

/// Roundings of the clock below which a flight is not followed.
const LEAST_TIME: f64 = 256.0 * f64::EPSILON;

/// The time at which a series of impacts ends that leaves a flank at `time` with a speed
/// `rate` ≥ 0, pressed back with an acceleration, where it is too low to be followed: then
/// the contact is held. `place`: size of the numbers that its clearance is the difference
/// of. `None`: it flies, or nothing presses it back.
pub(crate) fn time_of_rest(
    time: f64,
    place: f64,
    [rate, pressing]: [f64; 2],
    coefficient: f64,
) -> Option<f64> {
    if !(pressing >= 0.0 && rate >= 0.0) {
        return None;
    }
    if rate == 0.0 {
        return Some(time);
    }
    if pressing == 0.0 {
        // (Of either sign of zero.)
        return None;
    }
    let least = LEAST_HEIGHT.max(ROUNDINGS * f64::EPSILON * place);
    let low = 0.5 * rate * rate <= least * pressing;
    let flight = 2.0 * rate / pressing;
    let short = flight <= LEAST_TIME * time.abs();
    // (Without a loss it would never end: its flights are told from rest no more.)
    let left = match coefficient < 1.0 {
        true => flight / (1.0 - coefficient),
        false => flight,
    };
    (low || short).then_some(time + left)
}

#[cfg(test)]
mod tests {
    use super::time_of_rest;

    #[test]
    fn the_rest_of_the_series_is_that_of_its_flights() {
        let (rate, pressing, e) = (1e-10, 10.0, 0.75);
        let (mut left, mut speed) = (0.0, rate);
        for _ in 0..200 {
            left += 2.0 * speed / pressing;
            speed *= e;
        }
        let end = time_of_rest(1e-3, 0.0, [rate, pressing], e).unwrap();
        approx::assert_relative_eq!(end - 1e-3, left, max_relative = 1e-4);
        approx::assert_relative_eq!(
            time_of_rest(0.0, 0.0, [rate, pressing], e).unwrap(),
            left,
            max_relative = 1e-14
        );
    }

    #[test]
    fn what_is_high_or_not_pressed_flies() {
        assert_eq!(time_of_rest(1.0, 0.0, [1e-3, 10.0], 0.5), None);
        assert_eq!(time_of_rest(1.0, 0.0, [1e-10, -1.0], 0.5), None);
        assert_eq!(time_of_rest(1.0, 0.0, [0.0, 0.0], 0.5), Some(1.0));
        assert_eq!(time_of_rest(1.0, 0.0, [1.0, 0.0], 0.5), None);
        assert_eq!(time_of_rest(1.0, 0.0, [1.0, -0.0], 0.5), None);
        assert_eq!(time_of_rest(1.0, 0.0, [0.0, -1e-30], 0.5), None);
        assert!(time_of_rest(1.0, 0.0, [1e-12, 10.0], 1.0).is_some());
        // What is told from numbers of the size of 1 is lost in their rounding before.
        assert_eq!(time_of_rest(1.0, 0.0, [1e-7, 10.0], 0.5), None);
        assert!(time_of_rest(1.0, 1.0, [1e-7, 10.0], 0.5).is_some());
    }
}
