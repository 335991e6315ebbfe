//! Ordinary differential equations by extrapolation (Gragg, Bulirsch, Stoer).
//!
//! It is a method of its own beside those of `integrate`, for this module depends on no system.
//!
//! Smooth right-hand sides over a stretch without breaks, to tight tolerances.
//! Source: E. Hairer, S. P. Nørsett, G. Wanner, Solving Ordinary Differential
//! Equations I, section II.9: modified midpoint rule, harmonic sequence.

/// Midpoint rules of a step at most.
const COLUMNS: usize = 9;
/// Steps in a stretch at most.
const MOST_STEPS: u32 = 100_000;

/// The derivative; `None` where the state is not allowed.
pub(super) type Rates<'a, const N: usize> = &'a mut dyn FnMut(f64, &[f64; N]) -> Option<[f64; N]>;

/// Follows y′ = f from one end of a stretch to the other, every entry to a
/// relative `tolerance` of its size.
///
/// # Errors
/// The place at which no step is short enough: the state leaves what is allowed.
pub(super) fn integrate_stretch<const N: usize>(
    f: Rates<'_, N>,
    [from, to]: [f64; 2],
    state: &mut [f64; N],
    tolerance: f64,
) -> Result<(), f64> {
    let least = 1e-14 * (to - from).abs() + f64::MIN_POSITIVE;
    let (mut at, mut step) = (from, to - from);
    for _ in 0..MOST_STEPS {
        if at >= to {
            return Ok(());
        }
        let last = at + step >= to - 0.25 * least;
        let length = if last { to - at } else { step };
        match attempt_step(f, at, length, state, tolerance) {
            Some((next, columns)) => {
                *state = next;
                at = if last { to } else { at + length };
                if columns <= 6 {
                    step = 1.8 * length;
                } else if !last {
                    step = length;
                }
            }
            None => {
                step = 0.4 * length;
                if step < least {
                    return Err(at);
                }
            }
        }
    }
    Err(at)
}

/// One step, with the number of midpoint rules it took; `None` when they do
/// not agree.
pub(super) fn attempt_step<const N: usize>(
    f: Rates<'_, N>,
    at: f64,
    length: f64,
    state: &[f64; N],
    tolerance: f64,
) -> Option<([f64; N], usize)> {
    let mut table = [[0.0; N]; COLUMNS];
    let first = f(at, state)?;
    for k in 0..COLUMNS {
        let mut value = midpoint(f, at, length, 2 * (k + 1), state, &first)?;
        for j in 0..k {
            // Extrapolates in h², backwards through the last row.
            let ratio = ((k + 1) as f64 / (k - j) as f64).powi(2);
            let mut next = [0.0; N];
            for i in 0..N {
                next[i] = value[i] + (value[i] - table[j][i]) / (ratio - 1.0);
            }
            (table[j], value) = (value, next);
        }
        let before = if k > 0 { table[k - 1] } else { *state };
        table[k] = value;
        let agree = (0..N).all(|i| {
            let size = value[i].abs().max(state[i].abs());
            (value[i] - before[i]).abs() <= tolerance * size + f64::MIN_POSITIVE
        });
        if k >= 2 && agree {
            return value
                .iter()
                .all(|v| v.is_finite())
                .then_some((value, k + 1));
        }
    }
    None
}

fn midpoint<const N: usize>(
    f: Rates<'_, N>,
    at: f64,
    length: f64,
    count: usize,
    state: &[f64; N],
    first: &[f64; N],
) -> Option<[f64; N]> {
    let h = length / count as f64;
    let mut before = *state;
    let mut now: [f64; N] = std::array::from_fn(|i| state[i] + h * first[i]);
    for step in 1..count {
        let rates = f(at + step as f64 * h, &now)?;
        let next = std::array::from_fn(|i| before[i] + 2.0 * h * rates[i]);
        (before, now) = (now, next);
    }
    let rates = f(at + length, &now)?;
    Some(std::array::from_fn(|i| {
        0.5 * (now[i] + before[i] + h * rates[i])
    }))
}

#[cfg(test)]
mod tests {
    use super::integrate_stretch;

    #[test]
    fn an_oscillation_comes_back_to_rounding() {
        let mut state = [1.0, 0.0];
        let mut f = |_: f64, y: &[f64; 2]| Some([y[1], -y[0]]);
        integrate_stretch(&mut f, [0.0, 20.0], &mut state, 1e-13).unwrap();
        approx::assert_abs_diff_eq!(state[0], 20f64.cos(), epsilon = 2e-12);
        approx::assert_abs_diff_eq!(state[1], -20f64.sin(), epsilon = 2e-12);
    }

    #[test]
    fn the_place_where_a_state_ends_is_found() {
        // y² = 1 − x.
        let mut f = |_: f64, y: &[f64; 1]| (y[0] > 0.0).then(|| [-0.5 / y[0]]);
        let end = integrate_stretch(&mut f, [0.0, 2.0], &mut [1.0], 1e-12).unwrap_err();
        approx::assert_abs_diff_eq!(end, 1.0, epsilon = 1e-9);
    }
}
