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
    pub(crate) fn in_series_with_compliance(self, compliance: f64) -> Self {
        let compliance = self.compliance + compliance;
        Self { compliance, ..self }
    }

    /// N and its derivatives over p.
    #[inline]
    pub(crate) fn jet(&self, p: f64) -> Jet {
        match self.is_of_point() {
            true => self.jet_of_point(p),
            false => self.jet_of_power(p),
        }
    }

    /// n = 3/2, in roots alone: r = √q.
    #[inline]
    fn jet_of_point(&self, p: f64) -> Jet {
        let side = 1.0f64.copysign(p);
        let r = self.root_of_point(p.abs());
        let k = self.stiffness;
        let slope = |r: f64| 1.0 + 1.5 * self.compliance * k * r;
        let safe = r.max(LEAST.sqrt());
        let w = slope(safe);
        Jet {
            value: side * k * r * r * r,
            first: 1.5 * k * r / slope(r),
            second: side * 0.75 * k / (safe * w.powi(3)),
            third: -0.375 * k * (4.0 * w - 3.0) / (safe.powi(3) * w.powi(5)),
        }
    }

    /// Any n.
    fn jet_of_power(&self, p: f64) -> Jet {
        let side = 1.0f64.copysign(p);
        let (a, n, k) = (self.compliance, self.exponent, self.stiffness);
        let q = self.indentation_of_power(p.abs());
        let tangent = |q: f64| n * k * q.powf(n - 1.0);
        // Derivatives over q beyond the first, where these have a limit.
        let safe = q.max(LEAST);
        let second = (n - 1.0) * tangent(safe) / safe;
        let third = (n - 2.0) * second / safe;
        let w = 1.0 + a * tangent(safe);
        Jet {
            value: side * k * q.powf(n),
            first: tangent(q) / (1.0 + a * tangent(q)),
            second: side * second / w.powi(3),
            third: (third * w - 3.0 * a * second * second) / w.powi(5),
        }
    }

    /// The energy stored up to p ≥ 0, with its derivatives.
    pub(crate) fn energy(&self, p: f64) -> Jet {
        let force = self.jet(p);
        let share = 1.0 / (self.exponent + 1.0);
        let own = share * self.indentation(p.abs()) * force.value.abs();
        Jet {
            value: own + 0.5 * self.compliance * force.value * force.value,
            first: force.value,
            second: force.first,
            third: force.second,
        }
    }

    /// p under a force N ≥ 0.
    pub(crate) fn penetration(&self, force: f64) -> f64 {
        let ratio = force / self.stiffness;
        let indentation = match self.is_of_point() {
            true => ratio.cbrt().powi(2),
            false => ratio.powf(1.0 / self.exponent),
        };
        indentation + self.compliance * force
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
    pub(crate) fn indentation(&self, p: f64) -> f64 {
        match self.is_of_point() {
            true => self.root_of_point(p).powi(2),
            false => self.indentation_of_power(p),
        }
    }

    #[inline]
    fn is_of_point(&self) -> bool {
        self.exponent == 1.5
    }

    /// r = √q at p ≥ 0 for n = 3/2: of p = r² + a·K·r³.
    fn root_of_point(&self, p: f64) -> f64 {
        let cubic = self.compliance * self.stiffness;
        if cubic == 0.0 || p == 0.0 {
            return p.sqrt();
        }
        // Both bound r from above; the function is convex there.
        from_above(p.sqrt().min((p / cubic).cbrt()), |r| {
            let miss = r * r * (1.0 + cubic * r) - p;
            miss / (r * (2.0 + 3.0 * cubic * r))
        })
    }

    /// q at p ≥ 0 for any n.
    fn indentation_of_power(&self, p: f64) -> f64 {
        let (n, both) = (self.exponent, self.compliance * self.stiffness);
        if both == 0.0 || p == 0.0 {
            return p;
        }
        from_above(p.min((p / both).powf(1.0 / n)), |q| {
            let share = both * q.powf(n - 1.0);
            (q * (1.0 + share) - p) / (1.0 + n * share)
        })
    }
}

/// Newton's method for an increasing convex function from above its zero; `step`: how far it
/// goes down.
fn from_above(start: f64, step: impl Fn(f64) -> f64) -> f64 {
    let mut x = start;
    for _ in 0..ITERATIONS {
        let next = x - step(x);
        if next >= x || !next.is_finite() {
            break;
        }
        x = next;
    }
    x
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

    #[test]
    fn a_contact_in_a_point_is_one_of_the_powers() {
        for compliance in [0.0, 1e-9, 1e-8] {
            let force = PowerForce {
                stiffness: 3e10,
                exponent: 1.5,
                compliance,
            };
            for p in [1e-6, -4e-5, 1e-3] {
                let [point, power] = [force.jet_of_point(p), force.jet_of_power(p)];
                let close = |of: fn(&super::Jet) -> f64| {
                    approx::assert_relative_eq!(of(&point), of(&power), max_relative = 1e-12);
                };
                close(|jet| jet.value);
                close(|jet| jet.first);
                close(|jet| jet.second);
                close(|jet| jet.third);
            }
        }
    }
}
