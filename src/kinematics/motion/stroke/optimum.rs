//! Optimum skewness and optimum uniform section.

use super::criterion::Criterion;
use super::figures::{Laws, StrokeSpec, figures};
use crate::fault::Fault;
use crate::math::optimise::golden;
use crate::units::shown;

/// Skewness is looked for between these (e⁻⁷ … e⁷).
const REACH: f64 = 7.0;
const STEPS: usize = 560;

/// The skewness that makes the criterion least, whatever else is given being held.
///
/// For ν1 = 1 the uniform section does not depend on f, and K1 ∝
/// (1 + f)·(1 + ξ/(ν2·f)), K2 ∝ (1 + f)·(1 + ξκ/f): the root is closed.
/// Otherwise a scan over ln f, then golden section.
pub(super) fn optimum_skewness(
    laws: &Laws,
    spec: &StrokeSpec,
    criterion: Criterion,
) -> Result<f64, Vec<Fault>> {
    let weight = criterion.weight();
    let refuse = |message: String| {
        let hint = "give a weight above zero, or the skewness itself";
        Err(vec![Fault::new("optimum", message, hint)])
    };
    if weight == 0.0 {
        return refuse("with the weight 0 there is no least value: it falls as f → 0".to_owned());
    }
    if (laws.speed_ratio() - 1.0).abs() < 1e-14 {
        let share = match criterion {
            Criterion::Acceleration { .. } => 1.0 / laws.acceleration_ratio(),
            Criterion::Product { .. } => laws.out.product / laws.up.product,
        };
        return Ok((weight * share).sqrt());
    }
    let value = |x: f64| match figures(laws, spec, x.exp()) {
        Ok(found) => criterion.of(&found),
        Err(_) => f64::INFINITY,
    };
    let at = |i: usize| -REACH + 2.0 * REACH * i as f64 / STEPS as f64;
    let samples: Vec<f64> = (0..=STEPS).map(|i| value(at(i))).collect();
    let best = (0..=STEPS)
        .min_by(|&a, &b| samples[a].total_cmp(&samples[b]))
        .unwrap_or(0);
    if !samples[best].is_finite() {
        // Nothing solvable: let the problem itself say why.
        figures(laws, spec, 1.0)?;
        return refuse("there is no skewness for which the stroke exists".to_owned());
    }
    if best == 0 || best == STEPS {
        return refuse(format!(
            "no least value for a skewness between {} and {}",
            shown((-REACH).exp(), 1),
            shown(REACH.exp(), 1)
        ));
    }
    Ok(place_of_least(value, at(best - 1), at(best + 1)).exp())
}

/// Place of the least value between `low` and `high` (golden section, then
/// the vertex of a parabola, since a minimum is flat to rounding).
fn place_of_least(f: impl Fn(f64) -> f64, low: f64, high: f64) -> f64 {
    // To 2e-4: two steps of the scan by 0.618¹².
    let (middle, h) = (golden(&mut |x| -f(x), [low, high], 12).at, 1e-3);
    // Fourth-order differences: the third derivative does not shift the vertex.
    let [a, b, c, d, e] = [-2.0, -1.0, 0.0, 1.0, 2.0].map(|k: f64| f(middle + k * h));
    let first = (a - 8.0 * b + 8.0 * d - e) / (12.0 * h);
    let second = (-a + 16.0 * b - 30.0 * c + 16.0 * d - e) / (12.0 * h * h);
    let third = (e - 2.0 * d + 2.0 * b - a) / (2.0 * h * h * h);
    if !(second > 0.0) {
        return middle;
    }
    let mut step = -first / second;
    for _ in 0..3 {
        step = -(first + 0.5 * third * step * step) / second;
    }
    middle + step.clamp(-h, h)
}
