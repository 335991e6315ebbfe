//! A contact force that is a power of the indentation, N = K·q^n, alone or in series with a link of constant
//! compliance a: p = q + a·N. In a point, by Hertz, n = 3/2.
//!
//! Over q the penetration p = q + a·K·q^n is convex, so Newton's method solves it from above
//! without fail. Behind p = 0 the force is continued as an odd function: the methods look a
//! little beyond the place where a pair opens.

use super::ContactForm;
use crate::math::jet::Jet;

/// Indentations smaller than this (m or rad) count as this in the derivatives beyond the
/// first, which may grow without limit towards zero.
const LEAST: f64 = 1e-15;

/// Most iterations of Newton's method; from above it needs fewer than ten.
const ITERATIONS: usize = 60;

/// N(p).
#[derive(Clone, Copy, Debug, PartialEq)]
pub(crate) struct PowerForce {
    /// K (N/m^n or N·m/rad^n).
    pub(crate) stiffness: f64,
    /// n ≥ 1.
    pub(crate) exponent: f64,
    /// a ≥ 0 of the link in series (m/N or rad/(N·m)).
    pub(crate) compliance: f64,
}

impl PowerForce {
    /// The force of a form, where that is such a power.
    pub(crate) fn of(form: &ContactForm, stiffness: f64) -> Option<Self> {
        match *form {
            ContactForm::Power {
                exponent,
                compliance,
                ..
            } => Some(Self {
                stiffness,
                exponent,
                compliance,
            }),
            ContactForm::Proportional(_) | ContactForm::Rigid { .. } => None,
        }
    }

    /// This contact with a link of a compliance behind it.
    pub(crate) fn before(self, compliance: f64) -> Self {
        let compliance = self.compliance + compliance;
        Self { compliance, ..self }
    }

    /// N and its derivatives over p.
    #[inline]
    pub(crate) fn jet(&self, p: f64) -> Jet {
        let side = 1.0f64.copysign(p);
        let (a, n, k) = (self.compliance, self.exponent, self.stiffness);
        let q = self.indentation(p.abs());
        let power = self.power_below(q);
        let tangent = n * k * power;
        // Derivatives over q beyond the first, where these have a limit.
        let safe = q.max(LEAST);
        let safe_tangent = n * k * self.power_below(safe);
        let second = (n - 1.0) * safe_tangent / safe;
        let third = (n - 2.0) * second / safe;
        let w = 1.0 + a * safe_tangent;
        Jet {
            value: side * k * power * q,
            first: tangent / (1.0 + a * tangent),
            second: side * second / w.powi(3),
            third: (third * w - 3.0 * a * second * second) / w.powi(5),
        }
    }

    /// The energy stored up to p ≥ 0, with its derivatives.
    pub(crate) fn energy(&self, p: f64) -> Jet {
        let force = self.jet(p);
        let own = self.indentation(p.abs()) * force.value.abs() / (self.exponent + 1.0);
        Jet {
            value: own + 0.5 * self.compliance * force.value * force.value,
            first: force.value,
            second: force.first,
            third: force.second,
        }
    }

    /// p under a force N ≥ 0.
    pub(crate) fn penetration(&self, force: f64) -> f64 {
        self.root(force / self.stiffness) + self.compliance * force
    }

    /// The penetration under a force, as an odd function, with its derivatives.
    pub(crate) fn deflection(&self, force: f64) -> Jet {
        let p = self.penetration(force.abs()).copysign(force);
        let jet = self.jet(p);
        // Without a force the slope of the inverse has no limit.
        let slope = jet.first.max(self.jet(LEAST).first);
        let second = -jet.second / slope.powi(3);
        Jet {
            value: p,
            first: 1.0 / slope,
            second,
            third: (3.0 * jet.second * jet.second - jet.first * jet.third) / slope.powi(5),
        }
    }

    /// Share of p ≥ 0 that is indentation: q.
    #[inline]
    pub(crate) fn indentation(&self, p: f64) -> f64 {
        let both = self.compliance * self.stiffness;
        if both == 0.0 || p == 0.0 {
            return p;
        }
        // Both bound q from above; the function is convex there.
        let mut q = p.min(self.root(p / both));
        for _ in 0..ITERATIONS {
            let share = both * self.power_below(q);
            let next = q - (q * (1.0 + share) - p) / (1.0 + self.exponent * share);
            if next >= q || !next.is_finite() {
                break;
            }
            q = next;
        }
        q
    }

    /// q^(n − 1).
    #[inline]
    fn power_below(&self, q: f64) -> f64 {
        match self.exponent == 1.5 {
            true => q.sqrt(),
            false => q.powf(self.exponent - 1.0),
        }
    }

    /// x^(1/n).
    fn root(&self, x: f64) -> f64 {
        match self.exponent == 1.5 {
            true => x.cbrt().powi(2),
            false => x.powf(1.0 / self.exponent),
        }
    }
}

#[cfg(test)]
mod tests {
    use super::PowerForce;

    #[test]
    fn the_derivatives_are_those_of_the_force() {
        let cases = [
            (1.5, 0.0),
            (1.5, 1e-9),
            (1.5, 1e-8),
            (1.2, 1e-9),
            (2.5, 0.0),
            (2.5, 1e-5),
        ];
        for (exponent, compliance) in cases {
            let force = PowerForce {
                stiffness: 3e10,
                exponent,
                compliance,
            };
            for p in [1e-6, 2e-5, -4e-5, 1e-3] {
                let (here, h) = (force.jet(p), 1e-4 * p);
                let [above, below] = [force.jet(p + h), force.jet(p - h)];
                let slope = |f: fn(&super::Jet) -> f64| (f(&above) - f(&below)) / (2.0 * h);
                approx::assert_relative_eq!(slope(|j| j.value), here.first, max_relative = 1e-7);
                approx::assert_relative_eq!(slope(|j| j.first), here.second, max_relative = 1e-7);
                approx::assert_relative_eq!(slope(|j| j.second), here.third, max_relative = 1e-6);
                let size = here.value.abs();
                approx::assert_relative_eq!(force.penetration(size), p.abs(), max_relative = 1e-12);
                let q = force.indentation(p.abs());
                approx::assert_relative_eq!(q + compliance * size, p.abs(), max_relative = 1e-12);
                let [above, below] = [force.energy(p.abs() + h), force.energy(p.abs() - h)];
                let rate = (above.value - below.value) / (2.0 * h);
                approx::assert_relative_eq!(rate, size, max_relative = 1e-6);
            }
        }
    }
}
