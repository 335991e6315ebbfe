//! Contacts of the model: an element of its own between an object and its law.

use super::{DampingLaw, NodeIndex};

/// A contact between an object and what its law asks for: an element of its own, whose
/// data do not depend on the number of masses. It stands in the link that holds the pair:
///
/// * before a rigid body that link is the contact alone, of no stiffness where it is rigid;
/// * before an undamped link 1, with a law without loss, it is contact and link 1 in series;
/// * else it ends at a massless point, from which link 1 leads on to mass 1. The forces on
///   that point are in balance, which determines its speed.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct ContactElement {
    /// Law of the contact force.
    pub law: ContactLaw,
    /// k_c (N/m or N·m/rad), or K of a contact in a point; 0 of a rigid one.
    pub stiffness: f64,
    /// The link that holds the pair.
    pub link: usize,
    /// The massless point between contact and link 1.
    pub point: Option<NodeIndex>,
}

/// Law of a contact element over indentation p and its rate, N ≥ 0 where the pair can open.
#[derive(Clone, Copy, Debug, PartialEq)]
pub enum ContactLaw {
    /// N = k_c·p.
    Elastic,
    /// N = k_c·p + b_c·ṗ.
    KelvinVoigt {
        /// b_c ≥ 0 (N·s/m or N·m·s/rad).
        damping: f64,
    },
    /// N = k_c·p·(1 + χ·ṗ).
    HuntCrossley {
        /// χ ≥ 0 (s/m or s/rad).
        dissipation: f64,
    },
    /// N = K·p^{3/2}·(1 + χ·ṗ).
    Hertz {
        /// χ ≥ 0 (s/m or s/rad).
        dissipation: f64,
    },
    /// Rigid: what comes together at a speed goes apart at e times that speed, at once;
    /// what presses without coming apart is held.
    Restitution {
        /// e, from 0 to 1.
        coefficient: f64,
    },
}

impl ContactLaw {
    /// The law of the pair in the link that such a contact is, with the damping of that link;
    /// `compliance`: of an undamped link in series with it, in a contact by Hertz.
    pub fn of_link(self, compliance: f64) -> (DampingLaw, f64) {
        match self {
            Self::KelvinVoigt { damping } => (DampingLaw::KelvinVoigt, damping),
            Self::HuntCrossley { dissipation } if dissipation > 0.0 => {
                let kappa = Some(dissipation);
                (DampingLaw::HuntCrossley { kappa }, 0.0)
            }
            Self::Hertz { dissipation } => {
                let law = DampingLaw::Hertz {
                    dissipation,
                    compliance,
                };
                (law, 0.0)
            }
            Self::Elastic | Self::HuntCrossley { .. } => (DampingLaw::KelvinVoigt, 0.0),
            Self::Restitution { coefficient } => (DampingLaw::Restitution { coefficient }, 0.0),
        }
    }

    /// True when it takes no energy.
    pub fn is_lossless(self) -> bool {
        match self {
            Self::Elastic => true,
            Self::KelvinVoigt { damping: loss }
            | Self::HuntCrossley { dissipation: loss }
            | Self::Hertz { dissipation: loss } => loss == 0.0,
            Self::Restitution { coefficient } => coefficient == 1.0,
        }
    }

    /// True when the force is linear in p and ṗ.
    pub fn is_linear(self) -> bool {
        match self {
            Self::Elastic | Self::KelvinVoigt { .. } => true,
            Self::HuntCrossley { dissipation } => dissipation == 0.0,
            Self::Hertz { .. } | Self::Restitution { .. } => false,
        }
    }

    /// True when nothing gives way in it: it has no stiffness and no indentation.
    pub fn is_rigid(self) -> bool {
        matches!(self, Self::Restitution { .. })
    }
}
