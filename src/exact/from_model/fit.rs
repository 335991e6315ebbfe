//! Polynomials for a prescribed motion, to rounding.
//!
//! The motion is interpolated at Chebyshev's points of an interval. The
//! interval is halved until the last coefficients, beyond the degree that is
//! kept, are below rounding of the function, and until the coefficients in
//! powers of the time from its start do not cancel either.

use super::hidden::Target;
use super::prescribed::{Formulas, Instant, PLACE_ROUNDING, PrescribedMotion};
use crate::exact::LAW_DEGREE;
use crate::math::chebyshev::{Nodes, combined, in_powers};
use crate::math::number::NOTHING;
use crate::math::polynomial::{MAX_DEGREE, first_positive, raise};
use std::sync::LazyLock;

/// Points of an interpolation: three coefficients more than are kept.
const POINTS: usize = LAW_DEGREE + 4;

/// Greatest coefficient beyond those kept, in units of the rounding of the
/// function's parts.
const TAIL: f64 = 16.0 * f64::EPSILON;

/// Greatest ratio of the sum of the coefficients in powers to the function.
const CANCELLATION: f64 = 60.0;

/// How often an interval is halved because samples do not show all of it.
const HALVINGS: u32 = 64;

/// A polynomial in the time from its start.
#[derive(Clone, Copy, Debug, PartialEq)]
pub(crate) struct Fit {
    /// End of its validity (s): a joint, or of accuracy.
    pub(crate) end: f64,
    /// Displacement and speed at its start.
    pub(crate) value: f64,
    pub(crate) speed: f64,
    /// Coefficients of the target.
    pub(crate) coefficients: [f64; LAW_DEGREE + 1],
    /// Limits that the final displacement was held to.
    pub(crate) limits: (f64, f64),
}

/// Tables of the interpolation.
struct Tables {
    nodes: Nodes<POINTS>,
    /// The points in [0, 1], ascending: as far from 0 as the nodes from 1, without rounding.
    places: [f64; POINTS],
    /// T_k in powers of s ∈ [0, 1].
    powers: [[f64; POINTS]; POINTS],
    /// T_k in Bernstein's form of degree POINTS − 1.
    bernstein: [[f64; POINTS]; POINTS],
}

const _: () = assert!(POINTS <= MAX_DEGREE + 1);

static TABLES: LazyLock<Tables> = LazyLock::new(|| {
    let angle = |j: usize| std::f64::consts::PI * (j as f64 + 0.5) / POINTS as f64;
    Tables {
        nodes: Nodes::new(),
        places: std::array::from_fn(|j| (0.5 * angle(j)).sin().powi(2)),
        powers: in_powers([-1.0, 2.0]),
        bernstein: std::array::from_fn(bernstein_of),
    }
});

/// T_k over [0, 1] in Bernstein's form: (−1)^{k−i}·C(2k, 2i)/C(k, i), raised
/// to the degree of the tables.
fn bernstein_of(k: usize) -> [f64; POINTS] {
    let choose = |n: usize, m: usize| -> f64 {
        (0..m)
            .map(|j| (n - j) as f64 / (j + 1) as f64)
            .product::<f64>()
            .round()
    };
    let mut c = [0.0; POINTS];
    for (i, c) in c[..=k].iter_mut().enumerate() {
        let sign = if (k - i).is_multiple_of(2) { 1.0 } else { -1.0 };
        *c = sign * choose(2 * k, 2 * i) / choose(k, i);
    }
    raise(&mut c, k);
    c
}

/// Chebyshev's coefficients of a function with given values at the places.
fn coefficients(values: &[f64; POINTS]) -> [f64; POINTS] {
    let mut found = TABLES.nodes.polynomial_through(values);
    // The places ascend, the nodes descend: T_k(−x) = (−1)ᵏ·T_k(x).
    found.iter_mut().skip(1).step_by(2).for_each(|c| *c = -*c);
    found
}

/// Result of a trial.
enum Trial {
    Good(Fit),
    /// The motion leaves its formula after so many seconds.
    Leaves(f64),
    /// Too long.
    Long,
}

/// Fits `target` of a course from `time` on, over at most `longest` seconds,
/// within its formulas there; `axis` holds further places of the displacement
/// at which the fit ends. `None`: the motion cannot be fitted.
pub(crate) fn fit_course(
    course: &PrescribedMotion,
    time: f64,
    longest: f64,
    target: Target,
    axis: Option<&crate::kinematics::breaks::Breaks>,
) -> Option<Fit> {
    let formulas = course.formulas(time);
    let last = axis.map_or((f64::NEG_INFINITY, f64::INFINITY), |axis| {
        course.interval_around(axis, &formulas, time)
    });
    let longest = longest.min(formulas.until - time);
    let whole = if longest == formulas.until - time {
        formulas.until
    } else {
        time + longest
    };
    // A motion that is rounded more than its parts tell is fitted as closely
    // as it goes, within reason.
    for (tail, trials) in [(TAIL, 24), (4.0 * TAIL, 24), (32.0 * TAIL, 90)] {
        let (mut length, mut end) = (longest, whole);
        // Trials that fail tell how well a motion can be fitted at all. Those that pass
        // over something are too long, whatever the tail.
        let (mut tried, mut passed) = (0, 0);
        while tried < trials && passed < HALVINGS && time + length > time {
            match attempt_fit(course, &formulas, last, (time, length), target, tail) {
                Trial::Good(fit) => {
                    if course.is_resolved_by_samples(&formulas, (time, length), target) {
                        return Some(Fit { end, ..fit });
                    }
                    length *= 0.5;
                    (passed, tried) = (passed + 1, 0);
                }
                Trial::Leaves(after) => (length, tried) = (after, tried + 1),
                Trial::Long => (length, tried) = (0.5 * length, tried + 1),
            }
            end = time + length;
        }
    }
    None
}

fn attempt_fit(
    course: &PrescribedMotion,
    formulas: &Formulas,
    last: (f64, f64),
    (time, length): (f64, f64),
    target: Target,
    tail: f64,
) -> Trial {
    let depth = course.stages.len();
    match earliest_exit(course, formulas, last, time, length) {
        Ok(None) => {}
        Ok(Some(after)) => return Trial::Leaves(after),
        Err(()) => return Trial::Long,
    }
    let (mut size, mut speed, mut span) = (0.0f64, 0.0f64, 0.0f64);
    let values = TABLES.places.map(|place| {
        // Beyond its end a formula may have no value.
        let at = (time + place * length).min(formulas.until);
        let now = course.at(formulas, depth, at);
        (speed, span) = (speed.max(now.speed.abs()), span.max(now.span));
        let (value, own) = match target {
            Target::Displacement => (now.value, now.span),
            Target::Acceleration => (now.acceleration, now.size),
        };
        size = size.max(own);
        value
    });
    if values.iter().any(|value| !value.is_finite()) {
        return Trial::Long;
    }
    size = size.max(NOTHING).max(course.least_size(target));
    if target == Target::Acceleration && course.is_written() {
        // What changes neither speed nor displacement within their rounding is rounding.
        size = size.max((speed / length).min(span / (length * length)));
    }
    let c = coefficients(&values);
    let rest = c[LAW_DEGREE + 1..]
        .iter()
        .fold(0.0, |m: f64, c| m.max(c.abs()));
    if !(rest <= tail * size) {
        let noises = [0.0, 0.5, 1.0].map(|place| {
            let at = (time + place * length).min(formulas.until);
            course.noise(formulas, at, target)
        });
        let noise = noises.into_iter().fold(0.0, f64::max);
        if !(noise.is_finite() && rest <= tail * noise) {
            return Trial::Long;
        }
        size = size.max(noise);
    }
    let kept = c[..=LAW_DEGREE].iter().rposition(|c| c.abs() > tail * size);
    let kept = kept.unwrap_or(0);
    let all = combined(&c[..=kept], &TABLES.powers);
    let mut powers: [f64; LAW_DEGREE + 1] = std::array::from_fn(|power| all[power]);
    let sum: f64 = powers.iter().map(|c| c.abs()).sum();
    if sum > CANCELLATION * size {
        return Trial::Long;
    }
    let mut scale = 1.0;
    for c in &mut powers {
        *c *= scale;
        scale /= length;
    }
    let now = course.at(formulas, depth, time);
    Trial::Good(Fit {
        end: time + length,
        value: now.value,
        speed: now.speed,
        coefficients: powers,
        limits: last,
    })
}

/// When the motion, or a term of it, leaves the limits of one of its formulas within
/// `length`, or its displacement leaves `last`; `Err`: the interval is too long to tell.
fn earliest_exit(
    course: &PrescribedMotion,
    formulas: &Formulas,
    last: (f64, f64),
    time: f64,
    length: f64,
) -> Result<Option<f64>, ()> {
    let everywhere = (f64::NEG_INFINITY, f64::INFINITY);
    let mut first: Option<f64> = None;
    let mut note = |after: Option<f64>| {
        first = match (first, after) {
            (Some(one), Some(other)) => Some(one.min(other)),
            (one, other) => one.or(other),
        };
    };
    for ((_, term), formulas) in course.terms().iter().zip(&formulas.terms) {
        note(earliest_exit(term, formulas, everywhere, time, length)?);
    }
    for (index, &limits) in formulas.limits.iter().chain([&last]).enumerate() {
        let limited = limits.0.is_finite() || limits.1.is_finite();
        if limited && let Some(after) = exit_time(course, formulas, index, limits, time, length)? {
            note(Some(after));
            break;
        }
    }
    Ok(first)
}

/// The time at which a motion leaves the formulas in force just after `time`, or `end` if it does
/// not before.
pub(crate) fn formulas_end(
    course: &PrescribedMotion,
    formulas: &Formulas,
    time: f64,
    end: f64,
) -> f64 {
    let (everywhere, last) = ((f64::NEG_INFINITY, f64::INFINITY), end.min(formulas.until));
    let mut from = time;
    while from < last {
        let mut length = (last - from).min(0.125 * course.time_of_next_turn(from));
        let after = loop {
            match earliest_exit(course, formulas, everywhere, from, length) {
                Ok(found) => break found,
                Err(()) => length *= 0.5,
            }
            if from + length == from {
                break Some(0.0);
            }
        };
        match after {
            Some(after) => return from + after,
            None => from += length,
        }
    }
    last
}

/// When the displacement after `depth` stages leaves `limits` within `length`;
/// `Err`: the interval is too long to tell.
fn exit_time(
    course: &PrescribedMotion,
    formulas: &Formulas,
    depth: usize,
    (low, high): (f64, f64),
    time: f64,
    length: f64,
) -> Result<Option<f64>, ()> {
    let mut size = 0.0f64;
    let values = TABLES.places.map(|place| {
        let now = course.at(formulas, depth, time + place * length);
        size = size.max(now.span);
        now.value
    });
    let c = coefficients(&values);
    let spread: f64 = c[1..].iter().map(|c| c.abs()).sum();
    let rest = c[LAW_DEGREE + 1..]
        .iter()
        .fold(0.0, |m: f64, c| m.max(c.abs()));
    // Only the place of the crossing is wanted from it, to be polished.
    if !(rest <= 1e-12 * spread + 4.0 * TAIL * size) {
        return Err(());
    }
    if c[0] - spread >= low && c[0] + spread <= high {
        return Ok(None);
    }
    // Beyond an edge is beyond it by more than rounding: the motion may start
    // and end on one, and rest there. (Formulas are told within PLACE_ROUNDING.)
    let rounding = 2.0 * PLACE_ROUNDING * size + rest;
    let mut first: Option<f64> = None;
    for (edge, sign) in [(low, -1.0), (high, 1.0)] {
        if !edge.is_finite() {
            continue;
        }
        let beyond = combined(&c, &TABLES.bernstein);
        let beyond = beyond.map(|b| sign * b - (sign * edge + rounding));
        if let Some(s) = first_positive(&beyond) {
            first = Some(first.map_or(s, |other: f64| other.min(s)));
        }
    }
    let Some(s) = first else {
        return Ok(None);
    };
    let edges = (low, high);
    let at = |after: f64| course.at(formulas, depth, time + after);
    Ok(Some(refine_crossing(at, edges, s * length, rounding)))
}

/// The crossing near `guess`, where the motion is beyond its edge by about
/// `rounding`, by Newton's method on the motion itself.
fn refine_crossing(
    at: impl Fn(f64) -> Instant,
    (low, high): (f64, f64),
    guess: f64,
    rounding: f64,
) -> f64 {
    let mut after = guess;
    for _ in 0..8 {
        let now = at(after);
        let edge = if now.speed > 0.0 { high } else { low };
        let next = after - (now.value - edge) / now.speed;
        // Only a correction of the size of the error is believed.
        let allowed = 8.0 * rounding / now.speed.abs() + 1e-6 * guess;
        if !((next - guess).abs() <= allowed && next > 0.0) {
            return guess;
        }
        let done = (next - after).abs() <= f64::EPSILON * after;
        after = next;
        if done {
            break;
        }
    }
    after
}
