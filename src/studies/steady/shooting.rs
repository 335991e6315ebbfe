//! Shooting: a state that comes back after a period.

use super::map::Map;
use crate::units::shown;
use nalgebra::{DMatrix, DVector};

/// Periods of plain following before Newton's method, at first.
const SETTLING: u32 = 12;
/// Newton's steps in a row.
const STEPS: u32 = 24;
/// Rounds of following and Newton's steps.
const ROUNDS: u32 = 6;
/// States this near are the same.
const SAME_STATE: f64 = 1e-6;
/// Miss that is rounding, and the greatest that still is a periodic motion.
const MISS_ROUNDING: f64 = 1e-14;
pub(super) const CLOSED: f64 = 1e-9;
/// Greatest |a − b| relative to the scales.
pub(super) fn relative_distance(a: &[f64], b: &[f64], scales: &[f64]) -> f64 {
    let each = a.iter().zip(b).zip(scales);
    each.map(|((a, b), scale)| (a - b).abs() / scale)
        .fold(0.0, |most, d| if d > most || d.is_nan() { d } else { most })
}

/// A fixed point of a map over a time.
pub(super) struct FixedPoint {
    pub(super) state: Vec<f64>,
    pub(super) miss: f64,
    pub(super) monodromy: DMatrix<f64>,
    pub(super) iterations: u32,
}

/// Newton's method on y(T) = y(0), T being `periods` turns; where it leads nowhere,
/// or to a motion of fewer turns, more of the plain motion, which settles by
/// itself on what attracts.
pub(super) fn shoot(
    map: &dyn Map,
    start: &[f64],
    turn: f64,
    periods: usize,
) -> Result<FixedPoint, String> {
    shoot_near(map, start, None, turn, periods)
}

/// The same, Newton's method from a state that about comes back first, where one is known.
pub(super) fn shoot_near(
    map: &dyn Map,
    start: &[f64],
    known: Option<&[f64]>,
    turn: f64,
    periods: usize,
) -> Result<FixedPoint, String> {
    let time = turn * periods as f64;
    let mut state = start.to_vec();
    let mut iterations = 0;
    let mut nearest = f64::INFINITY;
    if let Some(known) = known
        && let Some(mut fixed) = newton(map, known, time, &mut iterations, &mut nearest)?
    {
        fixed.iterations = iterations;
        return Ok(fixed);
    }
    let mut settling = SETTLING;
    for _ in 0..ROUNDS {
        for _ in 0..settling {
            state = map.apply(&state, time)?;
            iterations += 1;
        }
        let found = newton(map, &state, time, &mut iterations, &mut nearest)?;
        if let Some(mut fixed) = found
            && !repeats_sooner(map, &fixed.state, turn, periods)?
        {
            fixed.iterations = iterations;
            return Ok(fixed);
        }
        settling *= 2;
    }
    Err(format!(
        "after {iterations} periods no state was found that comes back (nearest: {nearest} of \
         its size)",
        nearest = shown(nearest, 2)
    ))
}

/// True when a state comes back after fewer turns already.
fn repeats_sooner(map: &dyn Map, state: &[f64], turn: f64, periods: usize) -> Result<bool, String> {
    let mut end = state.to_vec();
    for turns in 1..periods {
        end = map.apply(&end, turn)?;
        if periods.is_multiple_of(turns)
            && relative_distance(state, &end, map.scales()) <= SAME_STATE
        {
            return Ok(true);
        }
    }
    Ok(false)
}

/// What a step of Newton's method leaves of the miss where the derivative in hand is
/// good for another one.
const GOOD: f64 = 0.1;
/// A miss below which a step that gains nothing has come to what the motion itself is
/// known to.
const FINE: f64 = 1e-11;

/// Shares of a step that are tried where the whole of it gains nothing.
const SHORTER: [f64; 4] = [0.5, 0.25, 0.1, 0.03];

/// How a derivative of the map was found.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
enum Slope {
    /// None in hand, any will do.
    Missing,
    /// None in hand that is good enough.
    Wanted,
    /// Found at an earlier state.
    Old,
    /// As cheaply as it goes, where the state stands.
    Rough,
    /// As well as it goes, where the state stands.
    Best,
}

/// A fixed point near a state, without what else is asked of one; `None`: there is none
/// that Newton's method comes to.
///
/// # Errors
/// The state itself gets nowhere.
pub(super) fn fixed_point_near(
    map: &dyn Map,
    start: &[f64],
    time: f64,
) -> Result<Option<Vec<f64>>, String> {
    let (mut iterations, mut nearest) = (0, f64::INFINITY);
    let found = find_recurring_state(map, start, time, &mut iterations, &mut nearest)?;
    Ok(found.map(|(state, _)| state))
}

fn newton(
    map: &dyn Map,
    start: &[f64],
    time: f64,
    iterations: &mut u32,
    nearest: &mut f64,
) -> Result<Option<FixedPoint>, String> {
    let Some((state, miss)) = find_recurring_state(map, start, time, iterations, nearest)? else {
        return Ok(None);
    };
    let monodromy = map.monodromy(&state, time)?;
    Ok(Some(FixedPoint {
        state,
        miss,
        monodromy,
        iterations: 0,
    }))
}

/// A state that comes back, and how far it misses itself.
fn find_recurring_state(
    map: &dyn Map,
    start: &[f64],
    time: f64,
    iterations: &mut u32,
    nearest: &mut f64,
) -> Result<Option<(Vec<f64>, f64)>, String> {
    let n = start.len();
    let mut state = start.to_vec();
    let mut end = map.apply(&state, time)?;
    let mut miss = relative_distance(&state, &end, map.scales());
    let mut slope = Slope::Missing;
    let mut factors = DMatrix::zeros(0, 0).lu();
    let mut steps = 0;
    while steps < STEPS && miss > MISS_ROUNDING {
        *nearest = nearest.min(miss);
        let fresh = match slope {
            Slope::Missing => Some((map.slopes(&state, &end, time)?, Slope::Rough)),
            Slope::Wanted => Some((map.monodromy(&state, time)?, Slope::Best)),
            _ => None,
        };
        if let Some((matrix, how)) = fresh {
            (factors, slope) = ((DMatrix::identity(n, n) - matrix).lu(), how);
        }
        let gap = DVector::from_iterator(n, end.iter().zip(&state).map(|(e, s)| e - s));
        let step = factors.solve(&gap);
        // A motion that gets nowhere is a step astray.
        let take = |share: f64| {
            let moved = state.iter().zip(step.as_ref()?.iter());
            let next: Vec<f64> = moved.map(|(s, d)| s + share * d).collect();
            let finite = next.iter().all(|entry| entry.is_finite());
            let end = finite.then(|| map.apply(&next, time).ok())??;
            let miss = relative_distance(&next, &end, map.scales());
            Some((next, end, miss))
        };
        let mut found = take(1.0);
        if slope == Slope::Best && miss > FINE {
            // Across switches the whole way is often too far.
            for share in SHORTER {
                if found.as_ref().is_some_and(|found| found.2 < miss) {
                    break;
                }
                found = take(share);
            }
        }
        match found {
            // What is not the best that can be known must gain much: far from the motion a
            // poor step leads astray.
            Some((next, next_end, next_miss))
                if next_miss <= GOOD * miss || slope == Slope::Best && next_miss < miss =>
            {
                (*iterations, steps) = (*iterations + 1, steps + 1);
                let gains = next_miss <= GOOD * miss;
                (state, end, miss) = (next, next_end, next_miss);
                slope = match gains {
                    true => Slope::Old,
                    false => Slope::Wanted,
                };
            }
            // No longer better: rounding, …
            _ if miss <= FINE || slope == Slope::Best => break,
            // … a derivative that no longer holds, or one that is too rough.
            _ if slope == Slope::Old => slope = Slope::Missing,
            _ => slope = Slope::Wanted,
        }
    }
    *nearest = nearest.min(miss);
    Ok((miss <= CLOSED).then_some((state, miss)))
}
