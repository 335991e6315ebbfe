//! Coulomb friction against the ground, regularised: −R·tanh(φ̇/v).

use super::{Domain, ForceLaw, LawInstance, Measure, Parameter};
use crate::dynamics::load::{Force, LoadFunction, LoadSeries};
use crate::dynamics::model::LoadLaw;
use crate::math::polynomial::{Coefficients, MAX_DEGREE, first_positive, product};
use std::sync::Arc;

pub(crate) const FRICTION: ForceLaw = ForceLaw {
    key: "friction",
    doc: "Dry friction that sticks, with `sliding`; or Coulomb friction, regularised: W = −force·tanh(φ̇/width).",
    parameters: &[
        Parameter {
            key: "force",
            doc: "Force of sliding friction",
            letter: ("R", ""),
            meaning: "sliding friction",
            measure: Measure::Force,
            domain: Domain::NotNegative,
            usual: None,
        },
        Parameter {
            key: "width",
            doc: "Regularisation width: speed at which 76 % of the force is reached",
            letter: ("v", ""),
            meaning: "regularisation width",
            measure: Measure::Speed,
            domain: Domain::Positive,
            usual: None,
        },
    ],
    formula: "-(force*tanh(phi_dot/width))",
    words: "friction {force}, regularised over {width}",
    law: |values| {
        let (force, width) = (values[0], values[1]);
        LoadLaw::of(Arc::new(Friction { force, width }))
    },
};

/// The law.
#[derive(Clone, Copy, Debug)]
struct Friction {
    force: f64,
    width: f64,
}

impl LoadFunction for Friction {
    fn force(&self, _: f64, speed: f64) -> Force {
        let tanh = (speed / self.width).tanh();
        Force {
            value: -self.force * tanh,
            by_displacement: 0.0,
            by_speed: -self.force * (1.0 - tanh * tanh) / self.width,
        }
    }

    fn magnitude(&self) -> f64 {
        self.force.abs()
    }

    fn needs_displacement(&self) -> bool {
        false
    }

    fn description(&self) -> String {
        FRICTION.key.to_owned()
    }

    fn declared(&self) -> Option<LawInstance> {
        Some(LawInstance::new(&FRICTION, [self.force, self.width]))
    }

    fn series(&self) -> Option<Box<dyn LoadSeries>> {
        Some(Box::new(TanhSeries {
            law: *self,
            tanh: [0.0; MAX_DEGREE + 1],
            rest: [0.0; MAX_DEGREE + 1],
        }))
    }

    fn regularised_friction(&self) -> Option<[f64; 2]> {
        Some([self.force, self.width])
    }

    fn why_not_linear(&self) -> &'static str {
        "is friction, which is not linear"
    }
}

/// |φ̇|/width down to which a step may lead that starts farther out: 1 − tanh is
/// then 2·exp(−2·|φ̇|/width), below the digits that a series of this degree is
/// used for (see the method, which takes 1.25 degrees for a digit).
fn narrowest_approach(degree: usize) -> f64 {
    (0.95 * degree as f64 - 3.0).clamp(5.0, 17.0)
}

/// What is farther out than [`narrowest_approach`] by this much is far out.
const FARTHER: f64 = 2.0;

/// The farthest that φ̇/width may change in a step that starts nearer, in shares
/// of the degree: the series of exp(2x) has its greatest term at 2x.
const STEP: f64 = 0.45;

/// Its power series.
#[derive(Clone, Debug)]
struct TanhSeries {
    law: Friction,
    /// tanh(φ̇/width).
    tanh: Coefficients,
    /// 1 − tanh².
    rest: Coefficients,
}

impl LoadSeries for TanhSeries {
    fn begin(&mut self, _: f64, speed: f64) {
        let tanh = (speed / self.law.width).tanh();
        self.tanh[0] = tanh;
        self.rest[0] = 1.0 - tanh * tanh;
    }

    /// T = tanh z follows T′ = (1 − T²)·z′.
    fn advance(&mut self, order: usize, _: &[f64], speed: &[f64]) -> f64 {
        let sum: f64 = (0..order)
            .map(|i| self.rest[i] * (order - i) as f64 * speed[order - i])
            .sum();
        self.tanh[order] = sum / (self.law.width * order as f64);
        self.rest[order] = -product(&self.tanh, &self.tanh, order);
        -self.law.force * self.tanh[order]
    }

    /// The series of a tanh does not know of what lies beyond its saturation.
    fn reliable(&self, speed: &[f64], degree: usize) -> f64 {
        // Bernstein coefficients of (φ̇ − φ̇₀)/width.
        let mut change = [0.0; MAX_DEGREE + 1];
        let mut factor = 1.0 / self.law.width;
        for k in 1..=degree {
            factor *= k as f64 / (degree + 1 - k) as f64;
            change[k] = speed[k] * factor;
        }
        for level in 1..=degree {
            for k in (level..=degree).rev() {
                change[k] += change[k - 1];
            }
        }
        let start = speed[0] / self.law.width;
        let first = |side: f64, most: f64| {
            let beyond = change.map(|change| side * change - most);
            first_positive(&beyond[..=degree]).unwrap_or(1.0)
        };
        let seen = narrowest_approach(degree);
        if start.abs() > seen + FARTHER {
            first(-start.signum(), start.abs() - seen)
        } else {
            let step = STEP * degree as f64;
            first(1.0, step).min(first(-1.0, step))
        }
    }

    fn copy(&self) -> Box<dyn LoadSeries> {
        Box::new(self.clone())
    }
}
