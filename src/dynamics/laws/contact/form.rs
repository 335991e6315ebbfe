//! The form of a contact force: what every calculation with a contact law asks for.

/// How a contact force N ≥ 0 depends on the penetration p and its rate. The stiffness and the
/// damping are those of the link or of the stop that has the form.
#[derive(Clone, Copy, Debug, Default, PartialEq)]
pub struct ContactForm {
    /// N at rest.
    pub elastic: Elastic,
    /// What is added to that by a rate.
    pub loss: Loss,
}

/// The force of a contact at rest.
#[derive(Clone, Copy, Debug, Default, PartialEq)]
pub enum Elastic {
    /// c·p.
    #[default]
    Proportional,
    /// K·q^n of the indentation q, K the stiffness.
    Power {
        /// n ≥ 1.
        exponent: f64,
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

/// How a contact force depends on the rate of penetration.
#[derive(Clone, Copy, Debug, Default, PartialEq)]
pub enum Loss {
    /// N = e(p) + b·ṗ, cut off at zero.
    #[default]
    Damper,
    /// N = e(p)·max(0, 1 + χ·ṗ).
    Factor(f64),
    /// The same, χ = b₁/(c₁·p*) with p* the static penetration.
    FactorOfDamper,
}

/// A force proportional to the penetration, with a loss.
impl From<Loss> for ContactForm {
    fn from(loss: Loss) -> Self {
        let elastic = Elastic::Proportional;
        Self { elastic, loss }
    }
}

impl ContactForm {
    /// N = c·p·max(0, 1 + χ·ṗ); without χ it is the plain c·p.
    pub(crate) fn dissipating(chi: f64) -> Self {
        match chi {
            0.0 => Self::default(),
            chi => Loss::Factor(chi).into(),
        }
    }

    /// N = K·p^n·max(0, 1 + χ·ṗ).
    pub(crate) fn power(exponent: f64, chi: f64) -> Self {
        let elastic = Elastic::Power {
            exponent,
            compliance: 0.0,
        };
        Self {
            elastic,
            loss: Loss::Factor(chi),
        }
    }

    /// Rigid, with a coefficient of restitution.
    pub(crate) fn rigid(restitution: f64) -> Self {
        let elastic = Elastic::Rigid { restitution };
        Self {
            elastic,
            ..Self::default()
        }
    }

    /// In series with an undamped link. (Of a proportional force that link has the stiffness
    /// of both.)
    pub(crate) fn before(self, behind: f64) -> Self {
        match self.elastic {
            Elastic::Power {
                exponent,
                compliance,
            } => {
                let compliance = compliance + behind;
                let elastic = Elastic::Power {
                    exponent,
                    compliance,
                };
                Self { elastic, ..self }
            }
            Elastic::Proportional | Elastic::Rigid { .. } => self,
        }
    }

    /// e of a rigid contact.
    pub fn restitution(&self) -> Option<f64> {
        match self.elastic {
            Elastic::Rigid { restitution } => Some(restitution),
            Elastic::Proportional | Elastic::Power { .. } => None,
        }
    }

    /// n of a force p^n; that of a rigid contact counts as 1.
    pub fn exponent(&self) -> f64 {
        match self.elastic {
            Elastic::Power { exponent, .. } => exponent,
            Elastic::Proportional | Elastic::Rigid { .. } => 1.0,
        }
    }

    /// True when the force is linear in p and ṗ.
    pub fn is_linear(&self) -> bool {
        *self == Self::default()
    }

    /// χ of a force with the factor 1 + χ·ṗ; 0 where it is still to be found.
    pub fn factor(&self) -> Option<f64> {
        match self.loss {
            Loss::Damper => None,
            Loss::Factor(chi) => Some(chi),
            Loss::FactorOfDamper => Some(0.0),
        }
    }

    /// True when it takes no energy besides that of a damper.
    pub fn is_lossless(&self) -> bool {
        let pressed = match self.loss {
            Loss::Damper => true,
            Loss::Factor(chi) => chi == 0.0,
            Loss::FactorOfDamper => false,
        };
        pressed && self.restitution().is_none_or(|e| e == 1.0)
    }
}
