//! The form of a contact force: what every calculation with a contact law asks for.

/// How a contact force N ≥ 0 depends on the penetration p and its rate. The stiffness and the
/// damping are those of the link or of the stop that has the form.
#[derive(Clone, Copy, Debug, PartialEq)]
pub enum ContactForm {
    /// c·p at rest.
    Proportional(Loss),
    /// K·q^n·max(0, 1 + χ·ṗ) of the indentation q, K the stiffness.
    Power {
        /// n ≥ 1.
        exponent: f64,
        /// χ ≥ 0.
        factor: f64,
        /// Compliance ≥ 0 of the undamped link behind the contact, in series with it:
        /// p = q + compliance·N. With a loss it is 0.
        compliance: f64,
    },
    /// Rigid, ṗ⁺ = −e·ṗ⁻ at an impact. Of a contact element of a rigid body, and of a
    /// stop.
    Rigid {
        /// e, from 0 to 1.
        restitution: f64,
    },
}

/// How a force c·p depends on the rate of penetration.
#[derive(Clone, Copy, Debug, PartialEq)]
pub enum Loss {
    /// N = c·p + b·ṗ, cut off at zero.
    Damper,
    /// N = c·p·max(0, 1 + χ·ṗ).
    Factor(f64),
    /// The same, χ = b₁/(c₁·p*) with p* the static penetration.
    FactorOfDamper,
}

/// N = c·p + b·ṗ.
impl Default for ContactForm {
    fn default() -> Self {
        Self::Proportional(Loss::Damper)
    }
}

impl ContactForm {
    /// In series with an undamped link. (Of a proportional force that link has the stiffness
    /// of both.)
    pub(crate) fn in_series_with_link(mut self, behind: f64) -> Self {
        if let Self::Power { compliance, .. } = &mut self {
            *compliance += behind;
        }
        self
    }

    /// True when the force is linear in p and ṗ.
    pub fn is_linear(&self) -> bool {
        *self == Self::default()
    }

    /// The loss of a proportional force.
    pub fn loss(&self) -> Option<Loss> {
        match *self {
            Self::Proportional(loss) => Some(loss),
            Self::Power { .. } | Self::Rigid { .. } => None,
        }
    }

    /// e of a rigid contact.
    pub fn restitution(&self) -> Option<f64> {
        match *self {
            Self::Rigid { restitution } => Some(restitution),
            Self::Proportional(_) | Self::Power { .. } => None,
        }
    }

    /// n of a force p^n at rest; that of a rigid contact counts as 1.
    pub fn exponent(&self) -> f64 {
        match *self {
            Self::Power { exponent, .. } => exponent,
            Self::Proportional(_) | Self::Rigid { .. } => 1.0,
        }
    }

    /// χ of a force with the factor 1 + χ·ṗ; 0 where it is still to be found.
    pub fn factor(&self) -> Option<f64> {
        match *self {
            Self::Proportional(Loss::Factor(factor)) | Self::Power { factor, .. } => Some(factor),
            Self::Proportional(Loss::FactorOfDamper) => Some(0.0),
            Self::Proportional(Loss::Damper) | Self::Rigid { .. } => None,
        }
    }

    /// True when it takes no energy besides that of a damper.
    pub fn is_lossless(&self) -> bool {
        match *self {
            Self::Proportional(Loss::FactorOfDamper) => false,
            Self::Rigid { restitution } => restitution == 1.0,
            Self::Proportional(_) | Self::Power { .. } => {
                self.factor().is_none_or(|chi| chi == 0.0)
            }
        }
    }
}
