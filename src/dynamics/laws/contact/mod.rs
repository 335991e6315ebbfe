//! Laws of the contact force N over the indentation p and its rate, one file each. A law is declared once: its
//! properties, what it says in words, and the [form](ContactForm) of its force.
//!
//! Nothing behind the form asks for the law. Force, derivatives, series, energy, impacts, closed
//! forms, the check of a run and the printed equations follow from the form; reading, schema,
//! checks and statements follow from the properties.

mod elastic;
mod form;
mod hertz;
mod hunt_crossley;
mod kelvin_voigt;
mod power;
mod restitution;

pub use form::{ContactForm, Loss};
pub(crate) use power::PowerForce;

use super::parameter::Parameter;

/// Laws of contact elements and of stops; the first is meant where none is named.
pub(crate) const CONTACT_LAWS: [&ContactForceLaw; 5] = [
    &elastic::ELASTIC,
    &kelvin_voigt::KELVIN_VOIGT,
    &hunt_crossley::HUNT_CROSSLEY,
    &hertz::HERTZ,
    &restitution::RESTITUTION,
];

/// Most numbers of a law.
const MOST: usize = 4;

/// The declaration of a contact law.
#[derive(Debug)]
pub struct ContactForceLaw {
    /// Its key in a scene.
    pub key: &'static str,
    /// Its name in words.
    pub name: &'static str,
    /// Its force, for the schema.
    pub doc: &'static str,
    /// The loss of a pair of this law without a contact element: link 1 is the contact too, with
    /// its own stiffness and damping. `None`: such a pair has no such law.
    pub pair_loss: Option<Loss>,
    /// Its other numbers, in their order.
    pub parameters: &'static [&'static Parameter],
    /// The form of its force with these numbers, and its damping b.
    pub form: fn(&[f64]) -> (ContactForm, f64),
}

impl ContactForceLaw {
    /// The form of its force as far as that does not depend on its numbers.
    fn nominal_form(&self) -> ContactForm {
        (self.form)(&[1.0; MOST]).0
    }

    /// True when the force is linear in p and ṗ, whatever the numbers are.
    pub(crate) fn is_linear(&self) -> bool {
        self.nominal_form().is_linear()
    }

    /// True when it has no stiffness.
    pub(crate) fn is_rigid(&self) -> bool {
        self.nominal_form().restitution().is_some()
    }

    /// True when its stiffness is that of a power of the indentation.
    pub(crate) fn has_power_stiffness(&self) -> bool {
        matches!(self.nominal_form(), ContactForm::Power { .. })
    }

    /// True when its force is that of a contact in a point, whatever the numbers are.
    pub(crate) fn is_of_point(&self) -> bool {
        self.nominal_form().exponent() == 1.5
    }
}

/// A contact law with its numbers (SI units).
#[derive(Clone, Copy, Debug)]
pub struct ContactLaw {
    law: &'static ContactForceLaw,
    values: [f64; MOST],
}

/// A law is known by its key.
impl PartialEq for ContactLaw {
    fn eq(&self, other: &Self) -> bool {
        self.law.key == other.law.key && self.values == other.values
    }
}

impl ContactLaw {
    /// The law of a key with its numbers, in their order; `None`: there is no such law, or it
    /// has another count of numbers.
    pub fn law_of_key(key: &str, values: &[f64]) -> Option<Self> {
        let law = CONTACT_LAWS.into_iter().find(|law| law.key == key)?;
        (values.len() == law.parameters.len()).then(|| Self::new(law, values.iter().copied()))
    }

    /// A law with its numbers.
    pub(crate) fn new(
        law: &'static ContactForceLaw,
        numbers: impl IntoIterator<Item = f64>,
    ) -> Self {
        let mut values = [0.0; MOST];
        values
            .iter_mut()
            .zip(numbers)
            .for_each(|(own, number)| *own = number);
        Self { law, values }
    }

    /// Its declaration.
    pub fn declaration(&self) -> &'static ContactForceLaw {
        self.law
    }

    /// The numbers with what they are.
    pub(crate) fn parameters(&self) -> impl Iterator<Item = (&'static Parameter, f64)> + use<> {
        self.law.parameters.iter().copied().zip(self.values)
    }

    /// The form of its force, and its damping b. `compliance`: of an undamped link in series
    /// with it, where its force is a power of the indentation.
    pub fn of_link(&self, compliance: f64) -> (ContactForm, f64) {
        let (form, damping) = (self.law.form)(&self.values);
        (form.in_series_with_link(compliance), damping)
    }

    /// The form of its force.
    pub fn form(&self) -> ContactForm {
        (self.law.form)(&self.values).0
    }

    /// True when it takes no energy.
    pub fn is_lossless(&self) -> bool {
        let (form, damping) = (self.law.form)(&self.values);
        form.is_lossless() && damping == 0.0
    }

    /// True when nothing gives way in it: it has no stiffness and no indentation.
    pub fn is_rigid(&self) -> bool {
        self.form().restitution().is_some()
    }
}

/// The law of a pair without a contact element.
pub(crate) fn law_of_link(loss: Loss) -> &'static ContactForceLaw {
    let damper = |loss: Loss| loss == Loss::Damper;
    let is_it = |own: Loss| damper(own) == damper(loss);
    let mut laws = CONTACT_LAWS.into_iter();
    laws.find(|law| law.pair_loss.is_some_and(is_it))
        .unwrap_or(CONTACT_LAWS[0])
}

/// The keys of some laws, as a sentence lists them: `a, b and c`.
pub(crate) fn keys(of: impl Fn(&ContactForceLaw) -> bool, quote: &str, joined: &str) -> String {
    let laws = CONTACT_LAWS.iter().filter(|law| of(law));
    let keys = laws.map(|law| format!("{quote}{}{quote}", law.key));
    let keys: Vec<String> = keys.collect();
    match keys.as_slice() {
        [first @ .., last] if !first.is_empty() => format!("{} {joined} {last}", first.join(", ")),
        _ => keys.concat(),
    }
}

/// What the laws say of their forces, for the schema.
pub(crate) fn doc_of_laws() -> String {
    let laws = CONTACT_LAWS.map(|law| format!("`{}` {}", law.key, law.doc));
    format!(
        "N over the indentation p and its rate: {}.",
        laws.join("; ")
    )
}

/// The keys of the properties of all laws, each once, with what they are, for the schema.
pub(crate) fn properties() -> Vec<(&'static Parameter, String)> {
    let mut found: Vec<(&'static Parameter, String)> = Vec::new();
    for own in CONTACT_LAWS.iter().flat_map(|law| law.parameters) {
        let same = |other: &&Parameter| (other.key, other.doc) == (own.key, own.doc);
        let laws = keys(|law| law.parameters.iter().any(same), "`", "and");
        let doc = own.doc.replace("{laws}", &laws);
        match found.iter_mut().find(|(other, _)| other.key == own.key) {
            None => found.push((own, doc)),
            Some((_, known)) if known.contains(&doc) => {}
            Some((_, known)) => *known = format!("{known}; {doc}"),
        }
    }
    found
}

#[cfg(test)]
mod tests;
