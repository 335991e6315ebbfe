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

pub use form::{ContactForm, Elastic, Loss};
pub(crate) use power::PowerForce;

use super::parameter::Parameter;
use std::fmt::Write;

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
    /// Its stiffness.
    pub stiffness: Stiffness,
    /// True when the force is linear in p and ṗ, whatever the numbers are.
    pub linear: bool,
    /// Its other numbers, in their order.
    pub parameters: &'static [&'static Parameter],
    /// The form of its force with these numbers, and its damping b.
    pub form: fn(&[f64]) -> (ContactForm, f64),
}

/// The stiffness that a law has.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Stiffness {
    /// k, force by displacement.
    Proportional,
    /// K of a power of the indentation; its unit depends on the power.
    OfPower,
    /// None: it is rigid.
    None,
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
    pub fn named(key: &str, values: &[f64]) -> Option<Self> {
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
        (form.before(compliance), damping)
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
        self.law.stiffness == Stiffness::None
    }
}

/// The keys of the laws that are linear, as they are listed in a sentence.
pub(crate) fn linear_laws(quote: &str, joined: &str) -> String {
    keys(|law| law.linear, quote, joined)
}

fn keys(of: impl Fn(&ContactForceLaw) -> bool, quote: &str, joined: &str) -> String {
    let laws = CONTACT_LAWS.iter().filter(|law| of(law));
    let keys = laws.map(|law| format!("{quote}{}{quote}", law.key));
    listed(&keys.collect::<Vec<String>>(), joined)
}

/// The keys of the laws with such a stiffness.
pub(crate) fn laws_of(stiffness: Stiffness, quote: &str, joined: &str) -> String {
    keys(|law| law.stiffness == stiffness, quote, joined)
}

/// What the laws say of their forces, for the schema.
pub(crate) fn doc_of_laws() -> String {
    let laws = CONTACT_LAWS
        .iter()
        .map(|law| format!("`{}` {}", law.key, law.doc));
    let laws: Vec<String> = laws.collect();
    format!(
        "N over the indentation p and its rate: {}.",
        laws.join("; ")
    )
}

/// The properties of all laws, each once.
pub(crate) fn properties() -> Vec<&'static Parameter> {
    let mut found: Vec<&'static Parameter> = Vec::new();
    for own in CONTACT_LAWS
        .iter()
        .flat_map(|law| law.parameters.iter().copied())
    {
        if found.iter().all(|other| other.key != own.key) {
            found.push(own);
        }
    }
    found
}

/// What a property is, for the schema: of each law that has it, where they differ.
pub(crate) fn doc_of_property(key: &str) -> String {
    let mut groups: Vec<(&str, Vec<String>)> = Vec::new();
    for law in CONTACT_LAWS {
        let own = law.parameters.iter().find(|own| own.key == key);
        let Some(own) = own else { continue };
        let name = format!("`{}`", law.key);
        match groups.iter_mut().find(|(doc, _)| *doc == own.doc) {
            Some((_, laws)) => laws.push(name),
            None => groups.push((own.doc, vec![name])),
        }
    }
    let mut doc = String::new();
    for (own, laws) in &groups {
        let between = if doc.is_empty() { "" } else { "; " };
        let own = own.replace("{laws}", &listed(laws, "and"));
        let _ = write!(doc, "{between}{own}");
    }
    doc
}

/// `a, b and c`.
fn listed(names: &[String], joined: &str) -> String {
    match names {
        [] => String::new(),
        [only] => only.clone(),
        [first @ .., last] => format!("{} {joined} {last}", first.join(", ")),
    }
}

#[cfg(test)]
mod tests;
