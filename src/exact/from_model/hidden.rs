//! What samples of a written motion do not show: a short pulse between two of them.
//!
//! Over parts of an interval the change of the speed is bounded by evaluating the
//! expression on intervals. A smooth motion cannot change its speed by much more than
//! its greatest sampled acceleration allows; bounds that do exceed it by far stem from
//! a pulse that the samples miss, or from bounds that are wide because the parts are
//! long. Both ask for a shorter interval.

use crate::kinematics::motion::WrittenMotion;

/// Below this numbers have lost digits, and count as zero.
pub(super) const NOTHING: f64 = f64::MIN_POSITIVE / f64::EPSILON;

/// Parts of an interval that are bounded one by one.
const PARTS: usize = 16;

/// The golden section: samples lie so in their parts that pulses which repeat after some
/// parts are not hit by all of them.
const GOLDEN: f64 = 0.618_033_988_749_894_9;

/// Bounds may be wider than the change of speed by this factor: what depends on itself,
/// t·(1 − t), is bounded that much too widely.
const WIDE: f64 = 16.0;

/// Changes of speed below this share of the speed do not count.
const SLIGHT: f64 = 1e-12;

/// How often an interval is halved because of what may lie between samples.
const HALVINGS: u32 = 64;

/// A bound that falls with the length it is of, halved, …
const FALLING: std::ops::Range<f64> = 0.4..0.65;

/// … and as what samples show does, within this factor, …
const STEADY: f64 = 1.2;

/// … over so many halvings, is wide because the expression depends on itself …
const STEADY_HALVINGS: u32 = 3;

/// … if it exceeds what samples show by no more than this. (Between a place before a
/// pulse and the far end of a long interval bounds fall with the length as well.)
const CREDIBLE: f64 = 1e6;

/// Bounds of what lies between samples.
#[derive(Clone, Copy, Debug, Default)]
pub(super) struct Between {
    /// Greatest change of speed over a part (rad/s); infinite or NaN: no bound is found.
    range: f64,
    /// The change of speed that samples show, times an allowance.
    allowed: f64,
}

impl Between {
    /// Of two motions that are added: of the one that hides more.
    pub(super) fn with(self, other: Self) -> Self {
        match other.excess() <= self.excess() {
            true => self,
            false => other,
        }
    }

    /// By how much the bound exceeds what is allowed, as a ratio: at most 1 where
    /// nothing is hidden.
    fn excess(self) -> f64 {
        match self.range {
            0.0 => 0.0,
            _ => self.range / self.allowed,
        }
    }
}

/// Bounds what a written motion may do within `length` after `time`, by the formula of
/// `segment`.
pub(super) fn between(written: &WrittenMotion, segment: i64, time: f64, length: f64) -> Between {
    let part = length / PARTS as f64;
    let place = |k: usize| time + k as f64 * part;
    let (mut value, mut speed) = (0.0f64, 0.0f64);
    // The second greatest: one sample may hit a pulse that is narrower than a part.
    let mut accelerations = [0.0f64; 2];
    for k in 0..PARTS {
        let inside = (GOLDEN * (k + 1) as f64).fract();
        let now = written.jet(segment, place(k) + inside * part);
        value = value.max(now.value.abs());
        speed = speed.max(now.first.abs());
        let [greatest, second] = accelerations;
        let own = now.second.abs();
        accelerations = [greatest.max(own), second.max(own.min(greatest))];
    }
    let [_, acceleration] = accelerations;
    let slight = SLIGHT * (speed + value / length) + NOTHING;
    let range = (0..PARTS).fold(0.0, |most: f64, k| {
        let [least, greatest] = written.speeds(segment, place(k), place(k + 1));
        let own = greatest - least;
        // (A NaN stays.)
        if own <= most { most } else { own }
    });
    Between {
        range,
        allowed: WIDE * acceleration * part + slight,
    }
}

/// The search for a length over which nothing is hidden.
#[derive(Debug, Default)]
pub(super) struct Looks {
    halvings: u32,
    before: Between,
    steady: u32,
}

/// What to do with an interval.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub(super) enum Look {
    /// It can be taken.
    Take,
    /// It is to be halved.
    Halve,
    /// No interval can be bounded: the first one can be taken as well.
    Unbounded,
}

impl Looks {
    /// Judges an interval.
    pub(super) fn judge(&mut self, now: Between) -> Look {
        if now.excess() <= 1.0 {
            return Look::Take;
        }
        let ratio = now.excess() / self.before.excess();
        let falls = FALLING.contains(&(now.range / self.before.range));
        self.steady = match falls && (1.0 / STEADY..=STEADY).contains(&ratio) {
            true => self.steady + 1,
            false => 0,
        };
        self.before = now;
        self.halvings += 1;
        if self.steady >= STEADY_HALVINGS && now.excess() <= CREDIBLE {
            return Look::Take;
        }
        match self.halvings > HALVINGS {
            true => Look::Unbounded,
            false => Look::Halve,
        }
    }
}

#[cfg(test)]
mod tests {
    use super::{Look, Looks, between};
    use crate::kinematics::motion::WrittenMotion;
    use crate::math::expression::Expression;

    fn written(text: &str) -> WrittenMotion {
        let expression = Expression::new(text, &["t"]).unwrap();
        WrittenMotion::new(&expression, 1.0).unwrap()
    }

    #[test]
    fn a_pulse_between_samples_is_seen_by_the_bounds() {
        let pulse = written("0.01*exp(-((t-0.7131)/0.001)^2)");
        assert!(between(&pulse, 0, 0.0, 20.0).excess() > 1e3);
        assert!(between(&pulse, 0, 1.0, 20.0).excess() <= 1.0);
        let mut looks = Looks::default();
        let mut length = 1e9;
        while looks.judge(between(&pulse, 0, 0.0, length)) == Look::Halve {
            length *= 0.5;
        }
        assert!(length < 0.7131 + 0.05 && length > 0.1, "{length}");
    }

    #[test]
    fn a_pulse_is_seen_from_its_top_and_where_it_repeats_in_step() {
        for text in ["exp(-(t/0.001)^2)", "exp(1e4*(cos(2*pi*t)-1))"] {
            let pulse = written(text);
            for length in [1.0, 4.0, 16.0] {
                let excess = between(&pulse, 0, 0.0, length).excess();
                assert!(excess > 1.0, "{text} over {length}: {excess}");
            }
        }
    }

    #[test]
    fn a_pulse_is_seen_from_its_foot() {
        let pulse = written("0.01*exp(-((t-0.7131)/0.01)^2)");
        let (mut looks, mut length) = (Looks::default(), 1e9);
        while looks.judge(between(&pulse, 0, 0.45, length)) == Look::Halve {
            length *= 0.5;
        }
        // So short that samples see the pulse themselves.
        assert!(length < 1.0, "{length}");
    }

    #[test]
    fn smooth_motions_hide_nothing() {
        for text in [
            "0.3*sin(20*t)",
            "0.1*t^2",
            "20*t + 0.5*sin(5*t)",
            "1 - exp(-5*t)",
        ] {
            let motion = written(text);
            for start in [0.0, 0.37, 2.0] {
                assert!(
                    between(&motion, 0, start, 0.2).excess() <= 1.0,
                    "{text} from {start}"
                );
            }
        }
    }

    #[test]
    fn bounds_that_stay_too_wide_end_the_search() {
        let sloppy = written("sqrt(t^2 + 1e-4)");
        let (mut looks, mut length) = (Looks::default(), 4.0);
        let mut halvings = 0;
        while looks.judge(between(&sloppy, 0, 3.0, length)) == Look::Halve {
            (length, halvings) = (0.5 * length, halvings + 1);
        }
        assert!(halvings < 10, "{halvings}");
    }
}
