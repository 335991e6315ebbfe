//! The force of a contact law as a formula, and what its letters stand for: of contact elements and of stops.

use super::Section;
use crate::dynamics::laws::Measure;
use crate::dynamics::model::{ContactForm, ContactLaw, Coordinate};
use crate::report::math::{Expr, Symbol};
use crate::report::show::contact::unit_of_stiffness;
use crate::report::show::units;

/// Letters of a contact's numbers.
pub(super) struct Letters {
    /// k, or K of a power.
    pub(super) stiffness: Symbol,
    /// b.
    pub(super) damping: Symbol,
    /// χ.
    pub(super) factor: Symbol,
    /// e.
    pub(super) restitution: Symbol,
}

/// The motion in a contact.
pub(super) struct Motion {
    /// Indentation, with the sign of the force.
    pub(super) depth: Expr,
    /// Its magnitude.
    pub(super) size: Expr,
    /// The rate on which a damper acts.
    pub(super) rate: Expr,
    /// The rate of the magnitude.
    pub(super) growth: Expr,
}

/// A contact force.
pub(super) enum Force {
    /// A function of the motion.
    Plain(Expr),
    /// The force at rest and the factor 1 + χ·ṗ.
    Dissipating(Expr, Expr),
    /// A rigid contact: what holds it.
    Reaction,
}

impl Letters {
    /// The force of a law.
    pub(super) fn force(&self, law: &ContactLaw, motion: Motion) -> Force {
        let (form, damping) = law.of_link(0.0);
        let linear = self.stiffness.clone().expr().times(motion.depth);
        let elastic = match form {
            ContactForm::Proportional(_) => linear,
            ContactForm::Power { exponent, .. } => linear.times(power_below(motion.size, exponent)),
            ContactForm::Rigid { .. } => return Force::Reaction,
        };
        match form.factor() {
            None if damping != 0.0 => {
                Force::Plain(elastic.plus(self.damping.clone().expr().times(motion.rate)))
            }
            None | Some(0.0) => Force::Plain(elastic),
            Some(_) => {
                let growth = self.factor.clone().expr().times(motion.growth);
                Force::Dissipating(elastic, Expr::Number(1.0).plus(growth))
            }
        }
    }

    /// What the letters stand for, as far as the force has them; `of`: the contact, or the stop.
    pub(super) fn entries(
        self,
        (law, stiffness): (ContactLaw, f64),
        (of, coordinate): (&str, Coordinate),
        section: &mut Section,
    ) {
        let (form, damping) = law.of_link(0.0);
        if let Some(restitution) = form.restitution() {
            let meaning = "coefficient of restitution";
            return section.add_entry(self.restitution, restitution, "", meaning);
        }
        let unit = units(coordinate);
        let own = unit_of_stiffness(form, coordinate);
        let meaning = |what: &str| format!("{what} of the {of}");
        section.add_entry(self.stiffness, stiffness, own, meaning("stiffness"));
        if damping != 0.0 {
            let own = unit.of(Measure::Damping);
            section.add_entry(self.damping, damping, own, meaning("damping"));
        }
        if let Some(chi) = form.factor().filter(|chi| *chi != 0.0) {
            let own = unit.of(Measure::TimePerDisplacement);
            section.add_entry(self.factor, chi, own, meaning("dissipation"));
        }
    }
}

/// d^(n − 1).
fn power_below(depth: Expr, exponent: f64) -> Expr {
    match exponent - 1.0 {
        0.5 => Expr::Root(Box::new(depth)),
        other => {
            let logarithm = Expr::Function("ln", Box::new(depth));
            Expr::Function("exp", Box::new(Expr::Number(other).times(logarithm)))
        }
    }
}
