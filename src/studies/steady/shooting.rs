//! Shooting: a state that comes back after a period.

use super::map::Map;
use crate::units::shown;
use nalgebra::{DMatrix, DVector};

/// Periods of plain following before Newton's method, at first.
const SETTLING: u32 = 12;
/// Newton's steps in a row.
const STEPS: u32 = 12;
/// Rounds of following and Newton's steps.
const ROUNDS: u32 = 6;
/// States this near are the same.
const SAME_STATE: f64 = 1e-6;
/// Miss that is rounding, and the greatest that still is a periodic motion.
const MISS_ROUNDING: f64 = 1e-14;
const CLOSED: f64 = 1e-9;
/// Greatest |a − b| relative to the scales.
pub(super) fn distance(a: &[f64], b: &[f64], scales: &[f64]) -> f64 {
    let each = a.iter().zip(b).zip(scales);
    each.map(|((a, b), scale)| (a - b).abs() / scale)
        .fold(0.0, |most, d| if d > most || d.is_nan() { d } else { most })
}

/// A fixed point of a map over a time.
pub(super) struct Fixed {
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
) -> Result<Fixed, String> {
    let time = turn * periods as f64;
    let mut state = start.to_vec();
    let mut iterations = 0;
    let mut settling = SETTLING;
    let mut nearest = f64::INFINITY;
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
        if periods.is_multiple_of(turns) && distance(state, &end, map.scales()) <= SAME_STATE {
            return Ok(true);
        }
    }
    Ok(false)
}

fn newton(
    map: &dyn Map,
    start: &[f64],
    time: f64,
    iterations: &mut u32,
    nearest: &mut f64,
) -> Result<Option<Fixed>, String> {
    let n = start.len();
    let mut state = start.to_vec();
    let mut end = map.apply(&state, time)?;
    let mut miss = distance(&state, &end, map.scales());
    for _ in 0..STEPS {
        *nearest = nearest.min(miss);
        if miss <= MISS_ROUNDING {
            break;
        }
        let matrix = DMatrix::identity(n, n) - map.monodromy(&state, time)?;
        let gap = DVector::from_iterator(n, end.iter().zip(&state).map(|(e, s)| e - s));
        let Some(step) = matrix.lu().solve(&gap) else {
            return Ok(None);
        };
        let next: Vec<f64> = state.iter().zip(step.iter()).map(|(s, d)| s + d).collect();
        if next.iter().any(|entry| !entry.is_finite()) {
            return Ok(None);
        }
        // A motion that gets nowhere is a step astray.
        let Ok(next_end) = map.apply(&next, time) else {
            break;
        };
        *iterations += 1;
        let next_miss = distance(&next, &next_end, map.scales());
        // No longer better: rounding, or astray.
        if !(next_miss < miss) {
            break;
        }
        (state, end, miss) = (next, next_end, next_miss);
    }
    if !(miss <= CLOSED) {
        return Ok(None);
    }
    let monodromy = map.monodromy(&state, time)?;
    Ok(Some(Fixed {
        state,
        miss,
        monodromy,
        iterations: 0,
    }))
}
