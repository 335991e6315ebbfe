//! Tables whose points scatter: rounded or measured displacements, whose second derivative is noise.
//!
//! A curve through all points has a second derivative that magnifies their scatter by the square of
//! the step. The scatter follows from high differences, in which a smooth law vanishes and noise
//! does not: those of fourth and sixth order then agree on it.

use crate::frontend::read::Fields;
use crate::units::shown;

/// Points that move, at least: fewer cannot tell a law from noise.
const LEAST: usize = 32;
/// Steps are equal but for this share.
const EVEN: f64 = 1e-6;
/// Share of the greatest U″ that scatter may change without a warning.
const HARMLESS: f64 = 0.05;
/// Sums of the squares of the binomial coefficients of fourth and sixth differences.
const SQUARES: [f64; 2] = [70.0, 924.0];
/// Standard deviation of the second derivative of a cubic spline through noise, over that of the
/// noise, for a step of one: the mean of ((2 − 2·cos θ)/((2 + cos θ)/3))² over θ is 36.
const SPLINE: f64 = 6.0;
/// Median of the size of a normal deviate.
const MEDIAN: f64 = 0.6745;

/// Warns of points whose scatter changes U″ by a noticeable share.
pub(super) fn warn_of_scatter(fields: &mut Fields<'_>, points: &[(f64, f64)]) {
    let Some(share) = scatter_of_bending(points).filter(|share| *share > HARMLESS) else {
        return;
    };
    let message = format!(
        "the points scatter: that changes U″ of the curve through them by up to {} % of its \
         greatest value, and with it forces and speeds of lift-off",
        shown(100.0 * share, 2)
    );
    let warning = fields.warn("points", "rough-table", message);
    warning.hints.push(
        "give the displacements with more digits, leave out points (every fifth), or smooth them first"
            .to_owned(),
    );
}

/// Change of the second derivative by the scatter of the points, over its greatest value;
/// `None`: the points do not scatter, or are too few or too uneven to tell.
fn scatter_of_bending(points: &[(f64, f64)]) -> Option<f64> {
    let steps = points.windows(2).map(|pair| pair[1].0 - pair[0].0);
    let [least, most] = steps.fold([f64::INFINITY, 0.0], |[least, most], step| {
        [step.min(least), step.max(most)]
    });
    if points.len() < LEAST || most - least > EVEN * most {
        return None;
    }
    let values: Vec<f64> = points.iter().map(|point| point.1).collect();
    let second = differences(&values, 2);
    let fourth = differences(&second, 2);
    let sixth = differences(&fourth, 2);
    let scatter = |differences: &[f64], squares: f64| {
        let mut sizes: Vec<f64> = differences.iter().map(|own| own.abs()).collect();
        // In a dwell nothing scatters.
        sizes.retain(|size| *size > 0.0);
        sizes.sort_by(f64::total_cmp);
        let median = sizes.get(sizes.len() / 2).filter(|_| sizes.len() >= LEAST);
        median.map(|median| median / (MEDIAN * squares.sqrt()))
    };
    let (one, other) = (scatter(&fourth, SQUARES[0])?, scatter(&sixth, SQUARES[1])?);
    if other < 0.5 * one {
        return None;
    }
    let greatest = second.iter().fold(0.0f64, |most, own| most.max(own.abs()));
    // Three standard deviations.
    (greatest > 0.0).then(|| 3.0 * SPLINE * other / greatest)
}

/// Differences of neighbours, so many times.
fn differences(values: &[f64], times: usize) -> Vec<f64> {
    (0..times).fold(values.to_vec(), |values, _| {
        values.windows(2).map(|pair| pair[1] - pair[0]).collect()
    })
}

#[cfg(test)]
mod tests {
    use super::scatter_of_bending;
    use std::f64::consts::PI;

    /// A cycloidal rise over 75 deg between dwells, in steps of so many degrees, rounded (m).
    fn cycloid(step: f64, rounding: f64) -> Vec<(f64, f64)> {
        let lift = |degrees: f64| {
            let share = (degrees / 75.0).clamp(0.0, 1.0);
            0.008 * (share - (2.0 * PI * share).sin() / (2.0 * PI))
        };
        let count = (360.0 / step) as usize;
        let points = (0..count).map(|k| {
            let degrees = step * k as f64;
            let lift = lift(degrees) - lift(degrees - 75.0);
            (degrees.to_radians(), (lift / rounding).round() * rounding)
        });
        points.collect()
    }

    #[test]
    fn rounding_is_found_and_measured_and_a_smooth_law_is_not_called_rough() {
        // Rounded to 1 µm every degree, 0.29 µm rms: 5.2 µm beside greatest second differences of
        // 2π·8 mm/75² = 8.9 µm, which the scatter makes greater.
        let rough = scatter_of_bending(&cycloid(1.0, 1e-6)).unwrap();
        assert!((0.35..0.75).contains(&rough), "{rough}");
        // Ten times the digits: a tenth of it.
        let finer = scatter_of_bending(&cycloid(1.0, 1e-7)).unwrap();
        assert!((0.04..0.09).contains(&finer), "{finer}");
        // Steps of five degrees bend 25 times as much, and coarse ones are no scatter.
        for (step, rounding) in [(5.0, 1e-6), (1.0, 1e-13), (5.0, 1e-13), (10.0, 1e-13)] {
            let found = scatter_of_bending(&cycloid(step, rounding));
            assert!(found.is_none_or(|share| share < 0.05), "{step} {found:?}");
        }
    }
}
