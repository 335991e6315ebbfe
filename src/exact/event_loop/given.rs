//! What is known of the motion beside the trees: a step of an integration.

use crate::math::polynomial::Step;

/// A step of the coordinates that no tree holds.
pub(crate) struct RemainderStep<'g> {
    /// The step, in an order of coordinates of its own.
    pub(crate) step: &'g Step<'g>,
    /// Places of its coordinates in the system.
    pub(crate) coordinates: &'g [usize],
}

impl RemainderStep<'_> {
    /// Puts its part of the state y = [u, u̇] at an instant into the system's.
    pub(crate) fn write_state(&self, time: f64, y: &mut [f64]) {
        let n = y.len() / 2;
        let s = self.local(time);
        for (number, &coordinate) in self.coordinates.iter().enumerate() {
            let (value, rate) = self.step.value(number, s);
            y[coordinate] = value;
            y[n + coordinate] = rate;
        }
    }

    fn local(&self, time: f64) -> f64 {
        let s = (time - self.step.start) / self.step.length;
        s.clamp(0.0, self.step.end)
    }
}

#[cfg(test)]
mod tests {
    use super::RemainderStep;
    use crate::math::polynomial::{Step, evaluate};

    #[test]
    fn a_state_is_put_where_it_belongs() {
        let coefficients = [0.0; 4].iter().chain(&[1.0, -2.0, 0.5, 3.0]).copied();
        let coefficients: Vec<f64> = coefficients.collect();
        let step = Step {
            start: 2.0,
            length: 0.5,
            end: 0.9,
            coordinates: 2,
            degree: 3,
            bases: &[0.0; 2],
            coefficients: &coefficients,
        };
        let given = RemainderStep {
            step: &step,
            coordinates: &[1, 2],
        };
        let at = |time: f64| evaluate(step.differences(1), (time - 2.0) / 0.5);
        let mut y = [7.0; 6];
        given.write_state(2.2, &mut y);
        approx::assert_abs_diff_eq!(y[2], at(2.2).0, epsilon = 1e-14);
        approx::assert_abs_diff_eq!(y[5], at(2.2).1 / 0.5, epsilon = 1e-13);
        assert_eq!((y[0], y[3], y[1], y[4]), (7.0, 7.0, 0.0, 0.0));
    }
}
