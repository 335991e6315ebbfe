//! How far one of several inputs goes while the others are held.

use crate::kinematics::linkage::multi::{MultiLinkage, MultiMotion, NotAssembled};
use crate::math::jet::Jet;
use crate::math::roots::bisect;
use std::f64::consts::TAU;

/// Steps of a turn, and of the size of the linkage, in which it is looked further.
const STEPS: f64 = 360.0;
/// A sliding input is looked at as far as so many sizes of the linkage.
const SIZES: f64 = 100.0;

/// How far an input goes.
pub(super) enum InputReach {
    /// Through a whole turn.
    Turn,
    /// Between two singular positions.
    Between([(f64, NotAssembled); 2]),
    /// Without an end that was found.
    Unknown,
}

/// How far `input` goes from where `at` has it. A gap narrower than a step is not seen.
pub(super) fn range_of_input(
    linkage: &MultiLinkage,
    at: &[f64],
    input: usize,
    turning: bool,
) -> InputReach {
    let far = match turning {
        true => TAU,
        false => SIZES * linkage.typical_length(),
    };
    let step = match turning {
        true => TAU / STEPS,
        false => linkage.typical_length() / STEPS,
    };
    let end = |sense: f64| {
        let mut motion = MultiMotion::new(linkage);
        let mut go = |place: f64| {
            let mut inputs: Vec<Jet> = at.iter().map(|&value| constant_jet(value)).collect();
            inputs[input] = constant_jet(place);
            motion.set_inputs(&inputs)
        };
        let mut inside = at[input];
        go(inside).ok()?;
        for k in 1..=(far / step).ceil() as usize {
            let place = at[input] + sense * (k as f64 * step).min(far);
            if let Err(mut why) = go(place) {
                let [last, _] = bisect([inside, place], 200, |place| match go(place) {
                    Ok(()) => true,
                    Err(found) => {
                        why = found;
                        false
                    }
                });
                return Some((last, why));
            }
            inside = place;
        }
        None
    };
    match (end(-1.0), end(1.0)) {
        (Some(lower), Some(upper)) => InputReach::Between([lower, upper]),
        (None, None) if turning => InputReach::Turn,
        _ => InputReach::Unknown,
    }
}

fn constant_jet(value: f64) -> Jet {
    Jet {
        value,
        ..Jet::default()
    }
}
