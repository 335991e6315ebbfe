//! Sentences of answers and warnings as data: words and quantities, so that quantities can be
//! told in other units than those that read best.
//!
//! The text of a sentence has its quantities in the units that read best. A reader may choose
//! others.

mod reading;

use super::findings::table::Value;
use super::quantity::{coded, escape, with_raised_powers, with_unit};
use super::symbols::{Setting, symbols};
use serde::Serialize;
use std::fmt;

/// A sentence of words and quantities. As text it has them in SI units.
#[derive(Clone, Debug, Default, PartialEq, Serialize)]
pub struct Sentence(Vec<Part>);

/// A part of a sentence.
#[derive(Clone, Debug, PartialEq, Serialize)]
#[serde(untagged)]
pub enum Part {
    /// Words.
    Words(String),
    /// A quantity.
    Quantity(Quantity),
}

/// A quantity of a sentence.
#[derive(Clone, Debug, PartialEq, Serialize)]
pub struct Quantity {
    /// The quantity in the sentence: `7.5 mrad`.
    pub words: String,
    /// Its value in the SI unit.
    pub value: f64,
    /// The SI unit: `rad`.
    pub unit: String,
    /// Significant digits at most.
    pub digits: usize,
}

impl Sentence {
    /// The sentence with more words.
    #[must_use]
    pub fn words(mut self, words: impl Into<String>) -> Self {
        let words = words.into();
        match self.0.last_mut() {
            _ if words.is_empty() => {}
            Some(Part::Words(last)) => last.push_str(&words),
            _ => self.0.push(Part::Words(words)),
        }
        self
    }

    /// The sentence with a quantity in its SI unit.
    #[must_use]
    pub fn quantity(self, value: f64, unit: &str, digits: usize) -> Self {
        self.worded(value, (unit, digits), with_unit(value, unit, digits))
    }

    /// The sentence with a quantity that is told in degrees where it is an angle.
    #[must_use]
    pub fn angle_or(self, value: f64, unit: &str, digits: usize) -> Self {
        let words = Value::angle_or(value, unit, digits).words();
        self.worded(value, (unit, digits), words)
    }

    /// The sentence with a quantity in words of one's own.
    #[must_use]
    pub fn worded(mut self, value: f64, (unit, digits): (&str, usize), words: String) -> Self {
        if !value.is_finite() || unit.is_empty() {
            return self.words(words);
        }
        self.0.push(Part::Quantity(Quantity {
            words,
            value,
            unit: unit.to_owned(),
            digits,
        }));
        self
    }

    /// The sentence with another one after it.
    #[must_use]
    pub fn sentence(self, more: Self) -> Self {
        more.0.into_iter().fold(self, |all, part| match part {
            Part::Words(words) => all.words(words),
            Part::Quantity(one) => all.worded(one.value, (&one.unit, one.digits), one.words),
        })
    }

    /// Sentences with the same words between them.
    pub fn joined(all: impl IntoIterator<Item = Self>, between: &str) -> Self {
        let mut all = all.into_iter();
        let first = all.next().unwrap_or_default();
        all.fold(first, |sentence, more| {
            sentence.words(between).sentence(more)
        })
    }

    /// Its parts.
    pub fn parts(&self) -> &[Part] {
        &self.0
    }

    /// True where nothing is said.
    pub fn is_empty(&self) -> bool {
        self.0.is_empty()
    }

    /// As a piece of a page: of each quantity the value is its title.
    pub(in crate::report) fn html(&self) -> String {
        let part = |part: &Part| match part {
            Part::Words(words) => {
                coded(&symbols(&escape(&with_raised_powers(words)), Setting::Page))
            }
            Part::Quantity(one) => format!(
                "<span class=\"quantity\" title=\"{} {}\" data-digits=\"{}\">{}</span>",
                one.value,
                escape(&one.unit),
                one.digits,
                escape(&with_raised_powers(&one.words))
            ),
        };
        self.0.iter().map(part).collect()
    }
}

/// A text that the program wrote, its quantities in the units and to the digits that are shown.
pub(in crate::report) fn in_shown_units(text: &str) -> String {
    let part = |part: &Part| match part {
        Part::Words(words) => words.clone(),
        Part::Quantity(one) => with_unit(one.value, &one.unit, one.digits),
    };
    Sentence::read(text).parts().iter().map(part).collect()
}

impl fmt::Display for Sentence {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        self.0.iter().try_for_each(|part| match part {
            Part::Words(words) => f.write_str(words),
            Part::Quantity(one) => f.write_str(&one.words),
        })
    }
}

impl<T: Into<String>> From<T> for Sentence {
    fn from(words: T) -> Self {
        Self::default().words(words)
    }
}

#[cfg(test)]
mod tests {
    use super::{Part, Sentence};
    use serde_json::json;

    #[test]
    fn a_sentence_reads_as_its_text_and_keeps_its_quantities() {
        let first = Sentence::from("rocker turns by ").quantity(0.007_500_86, "rad", 4);
        let second = Sentence::from("at ").angle_or(std::f64::consts::PI, "rad", 6);
        let said = Sentence::joined([first, second], "; ").words(".");
        assert_eq!(said.to_string(), "rocker turns by 7.501 mrad; at 180 deg.");
        let parts = json!(said);
        assert_eq!(
            parts[1],
            json!({ "words": "7.501 mrad", "value": 0.007_500_86, "unit": "rad", "digits": 4 })
        );
        assert_eq!(parts[2], "; at ");
        assert_eq!(
            Sentence::from("<").quantity(2e3, "N", 3).html(),
            "&lt;<span class=\"quantity\" title=\"2000 N\" data-digits=\"3\">2 kN</span>"
        );
    }

    #[test]
    fn what_has_no_unit_or_is_no_number_is_words() {
        let said = Sentence::default()
            .quantity(f64::INFINITY, "N", 3)
            .quantity(2.0, "", 3);
        assert!(matches!(said.parts(), [Part::Words(_)]), "{said:?}");
        assert!(Sentence::from("").is_empty() && Sentence::joined([], ", ").is_empty());
    }
}
