//! The numbers of laws: their keys, what they are and what they may be.

use crate::fault::Faults;

/// A number of a law.
#[derive(Debug)]
pub struct Parameter {
    /// Its key; empty where the law is this number alone.
    pub key: &'static str,
    /// What it is, for the schema.
    pub doc: &'static str,
    /// Its letter in equations and the index of that; without one that of the load.
    pub letter: (&'static str, &'static str),
    /// What it is, beside the equations.
    pub meaning: &'static str,
    /// Its quantity.
    pub measure: Measure,
    /// What it may be.
    pub domain: Domain,
    /// What it is where it is left out; `None`: it must be given.
    pub usual: Option<f64>,
}

/// Quantity of a number, of what turns or slides.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Measure {
    /// N m or N.
    Force,
    /// N m/rad or N/m.
    Stiffness,
    /// N m s/rad or N s/m.
    Damping,
    /// rad/s or m/s.
    Speed,
    /// s/rad or s/m.
    TimePerDisplacement,
    /// A number without unit.
    Number,
}

/// What a number may be.
#[derive(Clone, Copy, Debug, PartialEq)]
pub enum Domain {
    /// Anything finite.
    Any,
    /// ≥ 0.
    NotNegative,
    /// > 0.
    Positive,
    /// Anything finite but 0.
    NotZero,
    /// > 0, at most 1.
    UpToOne,
    /// From one number to another, both included.
    Between(f64, f64),
}

impl Parameter {
    /// Adds the fault of a value, at its address.
    pub(crate) fn check(&self, faults: &mut Faults, path: &str, value: f64) {
        match self.domain {
            Domain::Any => faults.finite(path, value),
            Domain::NotNegative => faults.not_negative(path, value),
            Domain::Positive | Domain::UpToOne => faults.positive(path, value),
            Domain::NotZero => faults.not_zero(path, value),
            Domain::Between(from, to) if (from..=to).contains(&value) => {}
            Domain::Between(from, to) => {
                let message = format!("{value} is no {}", self.meaning);
                let hint = format!("give a number between {from} and {to}");
                faults.add(path, message, &hint);
            }
        }
    }
}
