//! An asynchronous motor after Kloss: 2·T_b/(s/s_b + s_b/s), s = 1 − ω/ω_s.

use super::{Domain, ForceLaw, LawInstance, Measure, Parameter};
use crate::dynamics::load::{Force, LoadFunction, LoadSeries};
use crate::dynamics::model::LoadLaw;
use crate::math::polynomial::{Coefficients, MAX_DEGREE, convolution_term, product};
use std::sync::Arc;

pub(super) const KLOSS: ForceLaw = ForceLaw {
    key: "kloss",
    doc: "Asynchronous motor: 2·T_b/(s/s_b + s_b/s), s = 1 − ω/ω_s.",
    parameters: &[
        Parameter {
            key: "breakdown_torque",
            doc: "Greatest torque T_b",
            letter: ("T", "b"),
            meaning: "breakdown torque",
            measure: Measure::Force,
            domain: Domain::NotZero,
            usual: None,
        },
        Parameter {
            key: "breakdown_slip",
            doc: "Slip s_b of the greatest torque",
            letter: ("s", "b"),
            meaning: "breakdown slip",
            measure: Measure::Number,
            domain: Domain::UpToOne,
            usual: None,
        },
        Parameter {
            key: "synchronous_speed",
            doc: "Synchronous speed ω_s",
            letter: ("ω", "s"),
            meaning: "synchronous speed",
            measure: Measure::Speed,
            domain: Domain::NotZero,
            usual: None,
        },
    ],
    // (Without the poles of the form by quotients.)
    formula: "2*breakdown_torque*breakdown_slip*(1 - phi_dot/synchronous_speed)\
              /((1 - phi_dot/synchronous_speed)^2 + breakdown_slip^2)",
    words: "asynchronous motor, breakdown {breakdown_torque} at slip {breakdown_slip}, \
            synchronous {synchronous_speed}",
    law: |values| {
        LoadLaw::of(Arc::new(Kloss {
            breakdown: values[0],
            breakdown_slip: values[1],
            synchronous: values[2],
        }))
    },
};

/// The law.
#[derive(Clone, Copy, Debug)]
struct Kloss {
    breakdown: f64,
    breakdown_slip: f64,
    synchronous: f64,
}

impl Kloss {
    /// Slip s, s² + s_b² and 2·T_b·s_b.
    fn slip_terms(&self, speed: f64) -> (f64, f64, f64) {
        let slip = 1.0 - speed / self.synchronous;
        let square = slip * slip + self.breakdown_slip * self.breakdown_slip;
        (slip, square, 2.0 * self.breakdown * self.breakdown_slip)
    }
}

impl LoadFunction for Kloss {
    fn force(&self, _: f64, speed: f64) -> Force {
        let (slip, square, factor) = self.slip_terms(speed);
        let over_slip =
            factor * (self.breakdown_slip * self.breakdown_slip - slip * slip) / (square * square);
        Force {
            value: factor * slip / square,
            by_displacement: 0.0,
            by_speed: -over_slip / self.synchronous,
        }
    }

    fn magnitude(&self) -> f64 {
        self.breakdown.abs()
    }

    fn needs_displacement(&self) -> bool {
        false
    }

    fn description(&self) -> String {
        KLOSS.key.to_owned()
    }

    fn declared(&self) -> Option<LawInstance> {
        let values = [self.breakdown, self.breakdown_slip, self.synchronous];
        Some(LawInstance::new(&KLOSS, values))
    }

    fn series(&self) -> Option<Box<dyn LoadSeries>> {
        let zero = [0.0; MAX_DEGREE + 1];
        Some(Box::new(SlipSeries {
            law: *self,
            torque: zero,
            square: zero,
            slip: zero,
        }))
    }

    fn running_speed(&self) -> Option<f64> {
        Some(self.synchronous.abs())
    }

    fn why_not_linear(&self) -> &'static str {
        "is a motor's torque over its speed"
    }
}

/// Its power series.
#[derive(Clone, Debug)]
struct SlipSeries {
    law: Kloss,
    torque: Coefficients,
    /// s² + s_b².
    square: Coefficients,
    slip: Coefficients,
}

impl LoadSeries for SlipSeries {
    fn begin(&mut self, _: f64, speed: f64) {
        let (slip, square, factor) = self.law.slip_terms(speed);
        (self.slip[0], self.square[0]) = (slip, square);
        self.torque[0] = factor * slip / square;
    }

    /// T·(s² + s_b²) = 2·T_b·s_b·s.
    fn advance(&mut self, order: usize, _: &[f64], speed: &[f64]) -> f64 {
        let factor = 2.0 * self.law.breakdown * self.law.breakdown_slip;
        self.slip[order] = -speed[order] / self.law.synchronous;
        self.square[order] = product(&self.slip, &self.slip, order);
        let known = convolution_term(&self.square[1..=order], &self.torque[..order]);
        self.torque[order] = (factor * self.slip[order] - known) / self.square[0];
        self.torque[order]
    }

    fn copy(&self) -> Box<dyn LoadSeries> {
        Box::new(self.clone())
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn it_has_its_breakdown_torque_at_its_breakdown_slip() {
        let law = Kloss {
            breakdown: 25.0,
            breakdown_slip: 0.2,
            synchronous: 104.7,
        };
        let force = law.force(0.0, 104.7 * 0.8);
        approx::assert_relative_eq!(force.value, 25.0, max_relative = 1e-12);
        approx::assert_abs_diff_eq!(force.by_speed, 0.0, epsilon = 1e-12);
        assert_eq!(law.force(0.0, 104.7).value, 0.0);
    }
}
