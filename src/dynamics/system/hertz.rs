//! The elastic force of a contact in a point, by Hertz: N = K·q^{3/2} of the indentation q,
//! alone or in series with a link of constant compliance a, p = q + a·N.
//!
//! With r = √q the series is a cubic, p = r² + a·K·r³, which Newton's method solves from
//! above without fail. Behind p = 0 the force is continued as an odd function: the methods
//! look a little beyond the place where a pair opens.

use crate::math::jet::Jet;

/// Indentations smaller than this (m or rad) count as this in the derivatives beyond the
/// first, which grow without limit towards zero.
const LEAST: f64 = 1e-15;

/// Most iterations of Newton's method; from above it needs fewer than ten.
const ITERATIONS: usize = 60;

/// N(p).
#[derive(Clone, Copy, Debug, PartialEq)]
pub(super) struct Hertz {
    /// K (N/m^{3/2} or N·m/rad^{3/2}).
    pub(super) stiffness: f64,
    /// a ≥ 0 of the link in series (m/N or rad/(N·m)).
    pub(super) compliance: f64,
}

impl Hertz {
    /// This contact with a link of a compliance behind it.
    pub(super) fn before(self, compliance: f64) -> Self {
        let compliance = self.compliance + compliance;
        Self { compliance, ..self }
    }

    /// N and its derivatives over p.
    #[inline]
    pub(super) fn jet(&self, p: f64) -> Jet {
        let side = 1.0f64.copysign(p);
        let r = self.root(p.abs());
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

    /// The energy stored up to p ≥ 0, with its derivatives.
    pub(super) fn energy(&self, p: f64) -> Jet {
        let r = self.root(p.abs());
        let force = self.jet(p);
        let own = 0.4 * (r * r) * (self.stiffness * r * r * r);
        Jet {
            value: own + 0.5 * self.compliance * force.value * force.value,
            first: force.value,
            second: force.first,
            third: force.second,
        }
    }

    /// p under a force N ≥ 0.
    pub(super) fn penetration(&self, force: f64) -> f64 {
        (force / self.stiffness).cbrt().powi(2) + self.compliance * force
    }

    /// The penetration under a force, as an odd function, with its derivatives.
    pub(super) fn deflection(&self, force: f64) -> Jet {
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
    pub(super) fn indentation(&self, p: f64) -> f64 {
        self.root(p).powi(2)
    }

    /// r = √q at p ≥ 0.
    fn root(&self, p: f64) -> f64 {
        let cubic = self.compliance * self.stiffness;
        if cubic == 0.0 || p == 0.0 {
            return p.sqrt();
        }
        // Both bound r from above; the function is convex there.
        let mut r = p.sqrt().min((p / cubic).cbrt());
        for _ in 0..ITERATIONS {
            let miss = r * r * (1.0 + cubic * r) - p;
            let next = r - miss / (r * (2.0 + 3.0 * cubic * r));
            if next >= r || !next.is_finite() {
                break;
            }
            r = next;
        }
        r
    }
}

#[cfg(test)]
mod tests {
    use super::Hertz;

    #[test]
    fn the_derivatives_are_those_of_the_force() {
        for compliance in [0.0, 1e-9, 1e-8] {
            let hertz = Hertz {
                stiffness: 3e10,
                compliance,
            };
            for p in [1e-6, 2e-5, -4e-5, 1e-3] {
                let (here, h) = (hertz.jet(p), 1e-4 * p);
                let [above, below] = [hertz.jet(p + h), hertz.jet(p - h)];
                let slope = |f: fn(&super::Jet) -> f64| (f(&above) - f(&below)) / (2.0 * h);
                approx::assert_relative_eq!(slope(|j| j.value), here.first, max_relative = 1e-7);
                approx::assert_relative_eq!(slope(|j| j.first), here.second, max_relative = 1e-7);
                approx::assert_relative_eq!(slope(|j| j.second), here.third, max_relative = 1e-6);
                let force = here.value.abs();
                approx::assert_relative_eq!(
                    hertz.penetration(force),
                    p.abs(),
                    max_relative = 1e-12
                );
                let q = hertz.indentation(p.abs());
                approx::assert_relative_eq!(q + compliance * force, p.abs(), max_relative = 1e-12);
                let [above, below] = [hertz.energy(p.abs() + h), hertz.energy(p.abs() - h)];
                let rate = (above.value - below.value) / (2.0 * h);
                approx::assert_relative_eq!(rate, force, max_relative = 1e-6);
            }
        }
    }
}
