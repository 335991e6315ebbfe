//! How the driving force changes with each coefficient of friction and each mass.
//!
//! The friction that the change itself causes is included: one system with the
//! transposed of the factorised matrices gives all derivatives at once.

use super::workspace::ForceWorkspace;
use super::{Kinetostatics, Reaction};
use crate::kinematics::linkage::spec::PairKind;

/// Derivatives of the driving force M₁ (N·m or N) at a position.
#[derive(Clone, Debug, Default, PartialEq)]
pub struct Sensitivities {
    /// ∂M₁/∂μ of every pair.
    pub friction: Vec<f64>,
    /// ∂M₁/∂m of every link, its moment of inertia unchanged (per kg).
    pub mass: Vec<f64>,
    /// ∂M₁/∂J of every link (per kg·m²).
    pub moment: Vec<f64>,
    /// Influence coefficients: ∂M₁ by a force along x, along y and a couple on
    /// every link, friction included.
    pub load: Vec<[f64; 3]>,
}

/// A sum of two terms that cancel but for rounding is zero below this share of them.
const CANCELLED: f64 = 1e-13;

/// The sum of two terms; zero where nothing but their rounding is left, as at a
/// link whose mass does no work on the input.
fn without_rounding([a, b]: [f64; 2]) -> f64 {
    let sum = a + b;
    if sum.abs() <= CANCELLED * (a.abs() + b.abs()) {
        0.0
    } else {
        sum
    }
}

impl Kinetostatics {
    /// Derivatives of the driving force at the position that
    /// [`Kinetostatics::solve`] solved last; `None` where the solution is not
    /// smooth (a fold, where two solutions meet).
    ///
    /// A pair without friction has the derivative at μ = 0, for sliding in the
    /// direction of the motion.
    pub fn sensitivities(&self, w: &mut ForceWorkspace) -> Option<Sensitivities> {
        let dual = self.dual(w)?;
        let unit = self.drive_unit();
        let of_friction = |index: usize| {
            let per_unit = self.friction_per_coefficient(index, w);
            let work = self.on_frictions(index, &dual, w);
            -unit * (per_unit[0] * work[0] + per_unit[1] * work[1])
        };
        let links = 0..self.spec.links.len();
        let row = |index: usize, axis: usize| unit * dual[3 * index + axis];
        let (a, v2) = (w.acceleration, w.speed * w.speed);
        let of_mass = |link: usize| {
            let centre = &w.centres[link];
            let along =
                |k: usize| centre.first[k] * a + centre.second[k] * v2 - self.spec.gravity[k];
            without_rounding([row(link, 0) * along(0), row(link, 1) * along(1)])
        };
        let of_moment = |link: usize| {
            let frame = &w.links[link];
            row(link, 2) * (frame.first[2] * a + frame.second[2] * v2) / self.length
        };
        Some(Sensitivities {
            friction: (0..self.spec.pairs.len()).map(of_friction).collect(),
            mass: links.clone().map(of_mass).collect(),
            moment: links.clone().map(of_moment).collect(),
            load: links
                .map(|link| [-row(link, 0), -row(link, 1), -row(link, 2) / self.length])
                .collect(),
        })
    }

    /// The row vector w with dF_last = w·d(right side), friction included.
    fn dual(&self, w: &mut ForceWorkspace) -> Option<Vec<f64>> {
        let size = self.equations_count();
        let mut dual = vec![0.0; size];
        dual[size - 1] = 1.0;
        if w.columns > 0 {
            let mut lambda: Vec<f64> = (0..w.columns).map(|a| w.k(size - 1, a)).collect();
            w.write_slopes();
            if !w.small.factorise() {
                return None;
            }
            w.small.solve_transposed(&mut lambda);
            for term in &w.terms {
                let slope = term.slope(&w.unknowns);
                for which in 0..term.width() {
                    let factor = lambda[term.column + which];
                    dual[term.unknown] -= slope[which][0] * factor;
                    dual[term.unknown + 1] -= slope[which][1] * factor;
                }
            }
        }
        w.factors.solve_transposed(&mut dual);
        dual.iter().all(|value| value.is_finite()).then_some(dual)
    }

    /// A pair's τ for a coefficient of friction of one, at the present reactions.
    fn friction_per_coefficient(&self, index: usize, w: &ForceWorkspace) -> [f64; 2] {
        let sense = w.pairs[index].sense;
        match (self.reaction(index, w), self.spec.pairs[index].kind) {
            (Reaction::Pin([x, y]), kind) => {
                let diameter = kind.diameter().unwrap_or(0.0);
                [-sense * diameter / 2.0 / self.length * x.hypot(y), 0.0]
            }
            (Reaction::Guide([a, b]), PairKind::Sliding { half_height, .. }) => [
                -sense * (a.abs() + b.abs()),
                -sense * half_height / self.length * (a + b),
            ],
            _ => [0.0; 2],
        }
    }

    /// Influence coefficients of the driving force without friction, the last
    /// row of W⁻¹: equal to the transfer functions of all centres of mass and
    /// angles. Returns the greatest deviation from these, relative to the
    /// greatest of them: a check of equations and kinematics against each other.
    pub fn influence_error(&self, w: &mut ForceWorkspace) -> f64 {
        let size = self.equations_count();
        let mut row = vec![0.0; size];
        row[size - 1] = self.drive_unit();
        w.factors.solve_transposed(&mut row);
        let (mut error, mut greatest) = (0.0f64, 0.0f64);
        for (index, value) in row[..3 * self.spec.links.len()].iter().enumerate() {
            let (link, axis) = (index / 3, index % 3);
            let transfer = match axis {
                2 => w.links[link].first[2] * self.length,
                axis => w.centres[link].first[axis],
            };
            greatest = greatest.max(transfer.abs());
            error = if (value - transfer).abs() <= error {
                error
            } else {
                (value - transfer).abs()
            };
        }
        if greatest > 0.0 {
            error / greatest
        } else {
            error
        }
    }
}

#[cfg(test)]
mod tests {
    use super::without_rounding;

    #[test]
    fn what_cancels_but_for_rounding_is_zero() {
        assert_eq!(without_rounding([0.1 + 0.2, -0.3]), 0.0);
        assert_eq!(without_rounding([0.0, 0.0]), 0.0);
        assert_eq!(without_rounding([1.0, -1.0 + 1e-12]), 1.0 + (-1.0 + 1e-12));
        assert_eq!(without_rounding([0.0, 1e-30]), 1e-30);
        assert!(without_rounding([f64::NAN, 1.0]).is_nan());
    }
}
