//! Constraints with several drivers: φ = G(φ₁, …, φₖ).
//!
//! A position function ties one displacement to one other; a constraint ties one to
//! several: a differential, a planetary train, a summing lever, a cam on a moving
//! carrier. The speed is φ̇ = Σ gᵢ·φ̇ᵢ with the gradient gᵢ = ∂G/∂φᵢ, and a force F on
//! the driven coordinate loads driver i with F·gᵢ: no power is lost.

use crate::fault::{Fault, Faults};
use std::fmt;
use std::sync::Arc;

/// A constraint that this library does not know, supplied by its user.
pub trait ConstraintFunction: fmt::Debug + Send + Sync {
    /// Number k of drivers.
    fn drivers(&self) -> usize;

    /// G and its partial derivatives at the drivers' displacements (k numbers). `jet`
    /// has the right sizes; all of it is to be set. Must not allocate.
    fn jet(&self, displacements: &[f64], jet: &mut ConstraintJet);

    /// The right side of φ = … for the equations that are shown, given the names of the
    /// drivers' displacements. Default: `G(φ_1, φ_2)`.
    fn formula(&self, drivers: &[String]) -> String {
        format!("G({})", drivers.join(", "))
    }
}

/// G at a place, with its partial derivatives. SI units.
#[derive(Clone, Debug, Default, PartialEq)]
pub struct ConstraintJet {
    /// G.
    pub value: f64,
    /// ∂G/∂φᵢ at i (k numbers).
    pub first: Vec<f64>,
    /// ∂²G/∂φᵢ∂φⱼ at i·k + j (k² numbers, symmetric).
    pub second: Vec<f64>,
    /// ∂³G/∂φᵢ∂φⱼ∂φₗ at (i·k + j)·k + l (k³ numbers, symmetric). They enter only the
    /// Jacobian that implicit methods use.
    pub third: Vec<f64>,
}

impl ConstraintJet {
    /// Zeros for a number of drivers.
    pub fn new(drivers: usize) -> Self {
        Self {
            value: 0.0,
            first: vec![0.0; drivers],
            second: vec![0.0; drivers * drivers],
            third: vec![0.0; drivers * drivers * drivers],
        }
    }
}

/// A constraint, ready to be evaluated.
#[derive(Clone, Debug)]
pub enum Constraint {
    /// φ = Σ ratioᵢ·φᵢ + offset.
    Linear {
        /// ∂φ/∂φᵢ, in the order of the drivers.
        ratios: Vec<f64>,
        /// φ where all drivers are at zero.
        offset: f64,
    },
    /// Anything else.
    Custom(Arc<dyn ConstraintFunction>),
}

impl Constraint {
    /// A linear constraint.
    ///
    /// # Errors
    /// A ratio that is zero or not finite (path `[i]`), fewer than two of them, an
    /// offset that is not finite.
    pub fn linear(ratios: Vec<f64>, offset: f64) -> Result<Self, Vec<Fault>> {
        let mut faults = Faults::default();
        if ratios.len() < 2 {
            let message = format!("{} inputs are too few to combine", ratios.len());
            faults.add("", message, "give at least two");
        }
        for (index, &ratio) in ratios.iter().enumerate() {
            faults.not_zero(&format!("[{index}]"), ratio);
        }
        faults.finite("", offset);
        faults.check()?;
        Ok(Self::Linear { ratios, offset })
    }

    /// Number of drivers.
    pub fn drivers(&self) -> usize {
        match self {
            Self::Linear { ratios, .. } => ratios.len(),
            Self::Custom(function) => function.drivers(),
        }
    }

    /// True when the gradient is constant.
    pub fn is_linear(&self) -> bool {
        matches!(self, Self::Linear { .. })
    }

    /// G and its partial derivatives at the drivers' displacements; `jet` has the right
    /// sizes ([`ConstraintJet::new`]). Allocates nothing.
    pub fn jet(&self, displacements: &[f64], jet: &mut ConstraintJet) {
        match self {
            Self::Linear { ratios, .. } => {
                jet.value = self.value(displacements);
                jet.first.copy_from_slice(ratios);
                jet.second.fill(0.0);
                jet.third.fill(0.0);
            }
            Self::Custom(function) => function.jet(displacements, jet),
        }
    }

    /// G at the drivers' displacements.
    pub fn value(&self, displacements: &[f64]) -> f64 {
        match self {
            Self::Linear { ratios, offset } => {
                let terms = ratios.iter().zip(displacements);
                terms.map(|(ratio, phi)| ratio * phi).sum::<f64>() + offset
            }
            Self::Custom(function) => {
                let mut jet = ConstraintJet::new(self.drivers());
                function.jet(displacements, &mut jet);
                jet.value
            }
        }
    }
}

#[cfg(test)]
mod tests {
    use super::{Constraint, ConstraintJet};

    #[test]
    fn a_linear_constraint_is_a_weighted_sum() {
        let sum = Constraint::linear(vec![0.25, -2.0], 3.0).unwrap();
        let mut jet = ConstraintJet::new(2);
        sum.jet(&[4.0, 0.5], &mut jet);
        assert_eq!((jet.value, &jet.first[..]), (3.0, &[0.25, -2.0][..]));
        assert!(jet.second.iter().chain(&jet.third).all(|&one| one == 0.0));
    }

    /// Room for its k³ derivatives, which are zero, would be more than there is.
    #[test]
    fn a_sum_of_many_needs_no_room_for_its_derivatives() {
        let sum = Constraint::linear(vec![0.5; 100_000], 1.0).unwrap();
        assert_eq!(sum.value(&vec![2.0; 100_000]), 100_001.0);
    }

    #[test]
    fn ratios_that_do_nothing_are_refused() {
        let paths = |ratios: &[f64]| -> Vec<String> {
            let faults = Constraint::linear(ratios.to_vec(), 0.0).unwrap_err();
            faults.into_iter().map(|fault| fault.path).collect()
        };
        assert_eq!(paths(&[1.0]), [""]);
        assert_eq!(paths(&[0.0, f64::NAN]), ["[0]", "[1]"]);
    }
}
