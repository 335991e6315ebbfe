//! Loads by expressions along a motion.

use super::law::Series;
use super::{Start, Taylor};
use crate::dynamics::system::frozen::Frozen;
use crate::dynamics::system::written::{FrozenExpression, Input};
use crate::math::expression::VARIABLES;
use crate::math::number::NOTHING;

/// Places of a step at which a series is held against the expression itself.
const PLACES: [f64; 4] = [0.3, 0.6, 0.85, 1.0];

/// How often the share of a step that is relied on is halved, at most.
const HALVINGS: usize = 10;

/// Degrees that a series takes for a digit.
const DEGREES_A_DIGIT: f64 = 1.25;

impl Frozen {
    /// The force of a load at an order.
    pub(super) fn expression_coefficient(
        &self,
        load: usize,
        written: &FrozenExpression,
        start: &Start<'_>,
        order: usize,
        taylor: &mut Taylor,
    ) -> f64 {
        let Some((mut series, mut force)) = taylor.written[load].take() else {
            return f64::NAN;
        };
        let of_input = |input: Input| match input {
            Input::Unused => 0.0,
            Input::Time => match order {
                0 => start.time,
                1 => taylor.length,
                _ => 0.0,
            },
            Input::Displacement { node, .. } => taylor.displacement[node][order],
            Input::Speed { node, .. } => taylor.speed[node][order],
        };
        let value = written.extend(order, start.modes, of_input, &mut series);
        force[order] = value;
        taylor.written[load] = Some((series, force));
        value
    }

    /// Share of the step over which the series of a force agrees with the expression
    /// along the series of the motion: what the expression does farther on, no series
    /// knows.
    pub(super) fn reliable(
        &self,
        written: &FrozenExpression,
        force: &Series,
        start: &Start<'_>,
        degree: usize,
        taylor: &Taylor,
    ) -> f64 {
        let at = |series: &Series, s: f64| -> f64 {
            let terms = series[..=degree].iter().rev();
            terms.fold(0.0, |sum, c| sum * s + c)
        };
        let allowed = 10f64.powf(-(degree as f64) / DEGREES_A_DIGIT).max(1e-13);
        let agrees = |s: f64| {
            let mut values = [0.0; VARIABLES];
            for (value, input) in values.iter_mut().zip(&written.inputs) {
                *value = match *input {
                    Input::Unused => 0.0,
                    Input::Time => start.time + s * taylor.length,
                    Input::Displacement { node, .. } => at(&taylor.displacement[node], s),
                    Input::Speed { node, .. } => at(&taylor.speed[node], s),
                };
            }
            let exact = written.at(&values, start.modes);
            let mut power = 1.0;
            let mut size = exact.abs();
            for c in &force[..=degree] {
                size += (c * power).abs();
                power *= s;
            }
            let error = (at(force, s) - exact).abs();
            let allowed = allowed * size + NOTHING;
            error <= allowed || error <= allowed + written.rounding(&values, start.modes)
        };
        let mut share = 1.0;
        for _ in 0..HALVINGS {
            if PLACES.iter().all(|place| agrees(share * place)) {
                break;
            }
            share *= 0.5;
        }
        share
    }
}
