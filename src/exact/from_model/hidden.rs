//! What samples of a written motion do not show: a short pulse between two of them.
//!
//! The expression is evaluated on parts of an interval as a Taylor series whose
//! coefficients are intervals. The last coefficient bounds by how much the motion differs
//! from a polynomial of lower degree on each part, wherever in the part. Where that is
//! nothing, the motion has no detail that is shorter than a part, and samples that lie
//! closer than that show all of it. Where it is something, or has no bound, the interval
//! is too long.

use crate::kinematics::motion::WrittenMotion;
use crate::math::expression::Repetition;

/// Target of a fit.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub(crate) enum Target {
    /// The displacement.
    Displacement,
    /// The acceleration.
    Acceleration,
}

/// Coefficients of the series on a part: what is not bounded is a polynomial of degree
/// 8, and an acceleration of degree 6.
const COEFFICIENTS: usize = 10;
const LAST: usize = COEFFICIENTS - 1;

/// What differs from a polynomial by less than this share of its size counts as one.
const HIDDEN: f64 = 1e-10;

/// Sizes below this are none; far above `NOTHING`, which high powers of short times
/// would make something of.
const TINY: f64 = 1e-150;

/// The size that a motion has everywhere, as a share of a bound of its values: at the foot
/// of a pulse not every digit counts.
const SHARE: f64 = 1e-12;

/// A motion that does not repeat is bounded if its bound over the one time (s) is no more
/// than so many times that over the other.
const EVER: [f64; 2] = [1e3, 1e9];
const BOUNDED: f64 = 4.0;

/// How often an interval is halved into parts.
const HALVINGS: u32 = 5;

/// A share of the time at which nothing happens that the clock tells: where a formula begins
/// without a derivative, √(t − 0.2), no piece has a bound.
const AT_ONCE: f64 = 4096.0 * f64::EPSILON;

/// Places at which the size of a motion is sampled.
const PLACES: usize = 8;

/// The golden section: places lie so in their parts that pulses which repeat after some
/// parts are not hit by all of them.
const GOLDEN: f64 = 0.618_033_988_749_894_9;

/// Bounds of rounding are wider than rounding is, by about this many operations.
const OPERATIONS: f64 = 64.0;

/// The size of a motion at an instant: as great as what is rounded as it is.
pub(super) fn size_at(written: &WrittenMotion, segment: i64, time: f64, target: Target) -> f64 {
    let [value, _, half] = written.enclosed(segment, time, time);
    let own = match target {
        Target::Displacement => value,
        Target::Acceleration => half.scale(2.0),
    };
    let rounding = (own.high - own.low) / (2.0 * OPERATIONS * f64::EPSILON);
    own.middle().abs().max(rounding)
}

/// The size that a motion which repeats, or is bounded for ever, has everywhere; 0 for
/// others.
pub(super) fn least_size(written: &WrittenMotion, target: Target) -> f64 {
    let most = match written.repetition() {
        Some(Repetition::Cycles { period, .. }) => most_until(written, target, period),
        Some(Repetition::Line(_)) => 0.0,
        None if !written.breaks().is_empty() => 0.0,
        None => {
            let [soon, ever] = EVER.map(|time| most_until(written, target, time));
            if ever <= BOUNDED * soon { ever } else { 0.0 }
        }
    };
    match most.is_finite() {
        true => SHARE * most,
        false => 0.0,
    }
}

/// A bound of the values from the start to a time at most.
fn most_until(written: &WrittenMotion, target: Target, end: f64) -> f64 {
    let breaks = written.breaks();
    let first = breaks.segment_at(0.0, 1.0);
    let pieces = first..=first + breaks.points.len() as i64;
    pieces.fold(0.0, |most: f64, piece| {
        let (low, high) = breaks.edges(piece);
        let (from, to) = (low.max(0.0), high.min(end));
        if from >= to {
            return most;
        }
        let [value, _, half] = written.enclosed(piece, from, to);
        most.max(match target {
            Target::Displacement => value.magnitude(),
            Target::Acceleration => half.scale(2.0).magnitude(),
        })
    })
}

/// True where a motion has no detail within `length` after `time`, by the formula of
/// `segment`, that samples of it do not show.
pub(super) fn is_resolved_by_samples(
    written: &WrittenMotion,
    segment: i64,
    (time, length): (f64, f64),
    target: Target,
    least: f64,
) -> bool {
    if length <= AT_ONCE * time {
        return true;
    }
    let (mut size, mut speed, mut span) = (least.max(TINY), 0.0f64, 0.0f64);
    for k in 0..PLACES {
        let inside = k as f64 + (GOLDEN * (k + 1) as f64).fract();
        let at = time + inside * length / PLACES as f64;
        let now = written.jet(segment, at);
        speed = speed.max(now.first.abs());
        span = span.max(now.value.abs() + (now.first * at).abs());
        let own = size_at(written, segment, at, target);
        size = if own.is_finite() { size.max(own) } else { size };
    }
    if target == Target::Acceleration {
        // What changes neither speed nor displacement within their rounding is rounding.
        size = size.max((speed / length).min(span / (length * length)));
    }
    let search = PartSearch {
        written,
        segment,
        target,
        allowed: HIDDEN * size,
    };
    let whole = search.part_between(time, time + length);
    search.is_plain(&whole, HALVINGS)
}

/// The search for parts on which a motion is a polynomial.
struct PartSearch<'a> {
    written: &'a WrittenMotion,
    segment: i64,
    target: Target,
    /// The greatest difference from a polynomial.
    allowed: f64,
}

/// An interval of time, with a bound of the difference from a polynomial on it.
struct Part {
    from: f64,
    to: f64,
    difference: f64,
}

impl PartSearch<'_> {
    fn part_between(&self, from: f64, to: f64) -> Part {
        let all: [_; COEFFICIENTS] = self.written.enclosed(self.segment, from, to);
        let last = all[LAST].magnitude();
        let half = 0.5 * (to - from);
        let order = LAST as i32;
        let difference = match self.target {
            Target::Displacement => last * half.powi(order),
            Target::Acceleration => f64::from(order * (order - 1)) * last * half.powi(order - 2),
        };
        Part {
            from,
            to,
            difference: if difference.is_nan() {
                f64::INFINITY
            } else {
                difference
            },
        }
    }

    /// True where the motion is a polynomial on a part, or on each of so many parts of
    /// halves.
    fn is_plain(&self, part: &Part, halvings: u32) -> bool {
        if part.difference <= self.allowed {
            return true;
        }
        let middle = 0.5 * (part.from + part.to);
        if halvings == 0 || !(part.from < middle && middle < part.to) {
            return false;
        }
        let mut halves = [
            self.part_between(part.from, middle),
            self.part_between(middle, part.to),
        ];
        // The worse one ends a search in vain sooner.
        if halves[0].difference < halves[1].difference {
            halves.swap(0, 1);
        }
        halves.iter().all(|half| self.is_plain(half, halvings - 1))
    }
}

#[cfg(test)]
mod tests {
    use super::{Target, is_resolved_by_samples};
    use crate::kinematics::motion::WrittenMotion;
    use crate::math::expression::Expression;

    const BOTH: [Target; 2] = [Target::Displacement, Target::Acceleration];

    fn written(text: &str) -> WrittenMotion {
        let expression = Expression::new(text, &["t"]).unwrap();
        WrittenMotion::new(&expression, 1.0).unwrap()
    }

    #[test]
    fn pulses_between_samples_are_seen_wherever_they_are() {
        for width in [1e-2_f64, 1e-3, 1e-5, 1e-7] {
            for text in [
                format!("exp(-((t-0.7131)/{width})^2)"),
                format!("1/(1+((t-0.7131)/{width})^2)"),
                format!("tanh((t-0.7131)/{width})-tanh((t-0.7131)/{width}-1)"),
                format!("cos(t-0.7131)^{}", f64::round(1.0 / (width * width))),
                format!("exp({}*(cos(t-0.7131)-1))", 1.0 / (width * width)),
                format!("1/(1+{}*sin(t-0.7131)^2)", 1.0 / (width * width)),
                format!("sin(t) + 1e-3*exp(-((t-0.7131)/{width})^2)"),
            ] {
                let pulse = written(&text);
                for target in BOTH {
                    // From its foot, its flank, its top, and a long way before it.
                    for from in [0.0, 0.45, 0.7131 - 2.0 * width, 0.7131] {
                        for length in [1.0, 3.0, 64.0] {
                            assert!(
                                !is_resolved_by_samples(&pulse, 0, (from, length), target, 0.0),
                                "{text} from {from} over {length}, {target:?}"
                            );
                        }
                    }
                }
            }
        }
    }

    #[test]
    fn smooth_motions_show_all_that_they_do() {
        for text in [
            "0.3*sin(20*t)",
            "0.1*t^2",
            "20*t + 0.5*sin(5*t)",
            "1 - exp(-5*t)",
            "sqrt(t^2 + 1)",
            "5*cos(t)^4/(2 + sin(t))",
        ] {
            let motion = written(text);
            for start in [0.0, 0.37, 2.0] {
                for target in BOTH {
                    assert!(
                        is_resolved_by_samples(&motion, 0, (start, 0.1), target, 0.0),
                        "{text} from {start}"
                    );
                }
            }
        }
        // Far from their steps and pulses they rest.
        for text in ["tanh((t-3)/1e-5)", "exp(-((t-3)/1e-4)^2)"] {
            for target in BOTH {
                assert!(
                    is_resolved_by_samples(&written(text), 0, (0.0, 2.9), target, 0.0),
                    "{text}"
                );
            }
        }
        // Bounds that depend on themselves, of a bend far behind.
        let bend = written("sqrt(t^2 + 1e-4)");
        for target in BOTH {
            assert!(is_resolved_by_samples(&bend, 0, (3.0, 1.0), target, 0.0));
        }
    }
}
