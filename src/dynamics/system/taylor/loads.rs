//! Loads along a motion.

use super::law::{HIGHEST, Series, against, product};
use crate::dynamics::model::LoadLaw;
use crate::math::polynomial::first_positive;

/// |φ̇|/width down to which a step may lead that starts farther out: 1 − tanh is
/// then 2·exp(−2·|φ̇|/width), below the digits that a series of this degree is
/// used for (see the method, which takes 1.25 degrees for a digit).
fn seen(degree: usize) -> f64 {
    (0.95 * degree as f64 - 3.0).clamp(5.0, 17.0)
}

/// What is farther out than [`seen`] by this much is far out.
const FARTHER: f64 = 2.0;

/// The farthest that φ̇/width may change in a step that starts nearer, in shares
/// of the degree: the series of exp(2x) has its greatest term at 2x.
const STEP: f64 = 0.45;

/// Earlier coefficients of a load that is not linear.
#[derive(Clone, Debug)]
pub(super) struct LoadSeries {
    /// tanh(φ̇/width), or the motor's torque.
    value: Series,
    /// 1 − tanh², or s² + s_b².
    other: Series,
    /// Slip s of the motor.
    slip: Series,
}

impl Default for LoadSeries {
    fn default() -> Self {
        let zero = [0.0; HIGHEST + 1];
        Self {
            value: zero,
            other: zero,
            slip: zero,
        }
    }
}

impl LoadSeries {
    /// Begins anew at a speed of the node.
    pub(super) fn begin(&mut self, law: &LoadLaw, speed: f64) {
        match law {
            LoadLaw::Friction { width, .. } => {
                let tanh = (speed / width).tanh();
                self.value[0] = tanh;
                self.other[0] = 1.0 - tanh * tanh;
            }
            LoadLaw::Kloss {
                breakdown_torque,
                breakdown_slip,
                synchronous_speed,
            } => {
                let slip = 1.0 - speed / synchronous_speed;
                self.slip[0] = slip;
                self.other[0] = slip * slip + breakdown_slip * breakdown_slip;
                self.value[0] = 2.0 * breakdown_torque * breakdown_slip * slip / self.other[0];
            }
            _ => {}
        }
    }

    /// Coefficient `order` ≥ 1 of the force, from the node's motion up to it;
    /// `pieces` is that of a table.
    pub(super) fn advance(
        &mut self,
        law: &LoadLaw,
        order: usize,
        [displacement, speed]: [&Series; 2],
        pieces: f64,
    ) -> f64 {
        match law {
            // Those that are not constant are not expanded here.
            LoadLaw::Constant(_)
            | LoadLaw::SpeedTable(_)
            | LoadLaw::Custom { .. }
            | LoadLaw::Written(_)
            | LoadLaw::Stop(_) => 0.0,
            LoadLaw::Pieces { .. } => pieces,
            LoadLaw::Spring { rate, .. } => -rate * displacement[order],
            LoadLaw::Viscous(damping) => -damping * speed[order],
            LoadLaw::LinearMotor {
                stall_torque,
                no_load_speed,
            } => -stall_torque / no_load_speed * speed[order],
            LoadLaw::Friction { force, width } => -force * self.tanh(order, speed, *width),
            LoadLaw::Kloss {
                breakdown_torque,
                breakdown_slip,
                synchronous_speed,
            } => {
                let factor = 2.0 * breakdown_torque * breakdown_slip;
                self.slip[order] = -speed[order] / synchronous_speed;
                self.other[order] = product(&self.slip, &self.slip, order);
                let known = against(&self.other[1..=order], &self.value[..order]);
                self.value[order] = (factor * self.slip[order] - known) / self.other[0];
                self.value[order]
            }
        }
    }

    /// Share of the step up to which the series of the force can be relied on:
    /// that of a tanh does not know of what lies beyond its saturation.
    pub(super) fn reliable(&self, law: &LoadLaw, speed: &Series, degree: usize) -> f64 {
        let LoadLaw::Friction { width, .. } = law else {
            return 1.0;
        };
        // Bernstein coefficients of (φ̇ − φ̇₀)/width.
        let mut change = [0.0; HIGHEST + 1];
        let mut factor = 1.0 / width;
        for k in 1..=degree {
            factor *= k as f64 / (degree + 1 - k) as f64;
            change[k] = speed[k] * factor;
        }
        for level in 1..=degree {
            for k in (level..=degree).rev() {
                change[k] += change[k - 1];
            }
        }
        let start = speed[0] / width;
        let first = |side: f64, most: f64| {
            let beyond = change.map(|change| side * change - most);
            first_positive(&beyond[..=degree]).unwrap_or(1.0)
        };
        let seen = seen(degree);
        if start.abs() > seen + FARTHER {
            first(-start.signum(), start.abs() - seen)
        } else {
            let step = STEP * degree as f64;
            first(1.0, step).min(first(-1.0, step))
        }
    }

    /// T = tanh z follows T′ = (1 − T²)·z′.
    fn tanh(&mut self, order: usize, speed: &Series, width: f64) -> f64 {
        let sum: f64 = (0..order)
            .map(|i| self.other[i] * (order - i) as f64 * speed[order - i])
            .sum();
        self.value[order] = sum / (width * order as f64);
        self.other[order] = -product(&self.value, &self.value, order);
        self.value[order]
    }
}
