//! Numbers that are calculated: formulas over the named numbers of the scene and of the
//! object that is being read.

use super::dimension::Dimensions;
use super::parameter::Parameters;
use super::slot::{Reader, Slot};
use super::suggest::{did_you_mean, quoted_list};
use super::wanted::QuantityChoice;
use crate::frontend::diagnostics::Place;
use crate::math::expression::{Expression, Mistake, Names, Symbol, Symbols};
use crate::units::{Measure, Scope, formula, known_units, number_and_unit, parse};
use std::collections::BTreeSet;

/// Texts that are a number with or without a unit, or a formula.
pub(super) const FORMULA_PATTERN: &str = r"^[\s(+-]*([0-9]|\.[0-9]|[A-Za-z_])";

/// Names that a message looks through.
pub(super) const MOST_NAMES: usize = 1000;

/// Faults after which no names are looked for any more.
const MOST_FAULTS: usize = 100;

/// Names that a message lists.
const MOST_LISTED: usize = 20;

/// What is wrong with a formula.
pub(super) struct Wrong {
    pub(super) code: &'static str,
    pub(super) message: String,
    pub(super) hint: String,
}

/// A mistake of a formula in the words of a scene.
pub(super) fn fault(text: &str, mistake: &Mistake, names: &[String]) -> Wrong {
    let word = text.get(mistake.place.clone()).unwrap_or_default();
    let all = || names.iter().map(String::as_str);
    let unknown = mistake.message.ends_with("is not known");
    let is_unit = known_units().iter().any(|unit| unit == word);
    let hint = match unknown {
        _ if is_unit => format!("a unit follows a number: 1 {word}"),
        true => did_you_mean(word, all()).unwrap_or_else(|| match names.is_empty() {
            true => "the scene has no `parameters`".to_owned(),
            false => format!("known are {}", quoted_list(all().take(MOST_LISTED), "and")),
        }),
        false if after_number(text, mistake) => {
            let units = known_units();
            did_you_mean(word, units.iter().map(String::as_str))
                .unwrap_or_else(|| format!("`{word}` is no unit that is known"))
        }
        false if mistake.hint.is_empty() => {
            "write a number with a unit, or a formula: \"2*r + 5 mm\"".to_owned()
        }
        false => mistake.hint.clone(),
    };
    Wrong {
        code: if unknown {
            "unknown-name"
        } else {
            "bad-formula"
        },
        message: mistake.message.clone(),
        hint,
    }
}

/// True of a word that stands where a unit may.
fn after_number(text: &str, mistake: &Mistake) -> bool {
    let word = text.get(mistake.place.clone()).unwrap_or_default();
    let before = text[..mistake.place.start].trim_end();
    let operand = |c: char| c.is_alphanumeric() || c == ')';
    word.starts_with(char::is_alphabetic) && before.ends_with(operand)
}

/// The place of a mistake in a text; its bytes follow its opening quote, on the command line
/// it has none.
pub(super) fn place_of_mistake(whole: &Place, text: &str, mistake: &Mistake) -> Place {
    let quote = usize::from(whole.range.len() > text.len());
    let (start, end) = (mistake.place.start, mistake.place.end);
    whole.within(start + quote..end.max(start + 1) + quote)
}

/// The names in force: those of the object come before those of the scene.
struct NamedNumbers<'r> {
    dimensions: &'r mut Dimensions,
    parameters: &'r Parameters,
    used: &'r mut BTreeSet<String>,
}

impl Scope for NamedNumbers<'_> {
    fn quantity(&mut self, name: &str) -> Option<Option<Measure>> {
        let own = self
            .dimensions
            .entries
            .iter_mut()
            .find(|one| one.name == name);
        if let Some(own) = own {
            own.used = true;
            return Some(own.value);
        }
        let found = self.parameters.get(name)?;
        if !self.used.contains(name) {
            self.used.insert(name.to_owned());
        }
        Some(found)
    }

    fn long_name(&self, text: &str) -> Option<usize> {
        let entries = self.dimensions.entries.iter();
        let hyphened = entries.filter(|one| one.name.contains('-') && text.starts_with(&one.name));
        let ends = hyphened.filter(|one| {
            let next = text[one.name.len()..].chars().next();
            next.is_none_or(|c| !(c.is_alphanumeric() || c == '_'))
        });
        ends.map(|one| one.name.len()).max()
    }

    fn names(&self) -> Vec<String> {
        let own = self.dimensions.entries.iter().map(|one| one.name.as_str());
        let all = own.chain(self.parameters.names()).take(MOST_NAMES);
        all.map(str::to_owned).collect()
    }
}

/// The names that a reader has in force.
fn names_in_force(reader: &mut Reader) -> NamedNumbers<'_> {
    NamedNumbers {
        dimensions: &mut reader.dimensions,
        parameters: &reader.parameters,
        used: &mut reader.used,
    }
}

fn has_names(reader: &Reader) -> bool {
    !(reader.dimensions.entries.is_empty() && reader.parameters.is_empty())
}

/// Variables of an expression, and the parameters of the scene as numbers in SI units.
struct InExpression<'r> {
    variables: &'r Names<'r>,
    named: NamedNumbers<'r>,
    faulty: bool,
}

impl Symbols for InExpression<'_> {
    fn symbol(&mut self, name: &str) -> Option<Symbol> {
        let variable = self.variables.iter().find(|one| one.0 == name);
        if let Some((_, index)) = variable {
            return Some(Symbol::Variable(*index));
        }
        let found = self.named.quantity(name)?;
        self.faulty |= found.is_none();
        Some(Symbol::Number(found.map_or(1.0, |found| found.value)))
    }

    fn names(&self) -> Vec<String> {
        let variables = self.variables.iter().map(|one| one.0.to_owned());
        variables
            .chain(self.named.names().into_iter().take(MOST_LISTED))
            .collect()
    }
}

impl Slot<'_> {
    /// An expression over variables and the parameters of the scene; `Ok(None)`: it uses a
    /// parameter of which it has been said what is wrong.
    pub(crate) fn expression(
        &mut self,
        text: &str,
        variables: &Names<'_>,
    ) -> Result<Option<Expression>, Mistake> {
        let mut symbols = InExpression {
            variables,
            named: names_in_force(self.reader),
            faulty: false,
        };
        let found = Expression::parse_with_symbols(text, &mut symbols)?;
        Ok((!symbols.faulty).then_some(found))
    }

    /// True of a text that refers to a named number.
    pub(crate) fn is_formula(&self) -> bool {
        let text = self.node().and_then(|node| node.text());
        text.is_some_and(|text| self.refers(text))
    }

    fn refers(&self, text: &str) -> bool {
        if !has_names(self.reader) {
            return false;
        }
        let mut words = text.split(|c: char| !(c.is_alphanumeric() || c == '_'));
        let Reader {
            dimensions,
            parameters,
            ..
        } = &*self.reader;
        words.any(|word| {
            let own = dimensions.entries.iter().any(|one| one.name == word);
            own || parameters.get(word).is_some()
        })
    }

    /// The quantity that a text states, alone or by a formula.
    pub(super) fn stated(&mut self, text: &str, wanted: &QuantityChoice) -> Option<Measure> {
        let starts = text
            .trim_start()
            .trim_start_matches(['-', '+'])
            .trim_start();
        let by_name = starts.starts_with(|c: char| c.is_alphabetic() || c == '_');
        // Of 10 N/r the r may be a unit too.
        let refers = self.refers(text);
        match parse(text) {
            Ok(measure) if !refers => return Some(measure),
            Err(error)
                if !(refers || has_arithmetic(text) || by_name && has_names(self.reader)) =>
            {
                self.unit_fault(text, error, wanted);
                return None;
            }
            _ => {}
        }
        if !self.refuse_parameter_after_number(text) {
            return None;
        }
        let found = formula(text, &mut names_in_force(self.reader));
        found.unwrap_or_else(|mistake| {
            let names = match self.reader.diagnostics.len() > MOST_FAULTS {
                true => Vec::new(),
                false => names_in_force(self.reader).names(),
            };
            let wrong = fault(text, &mistake, &names);
            let place = place_of_mistake(&self.place(), text, &mistake);
            let refused = self.refuse(wrong.code, wrong.message);
            refused.place = Some(place);
            refused.hints.push(wrong.hint);
            None
        })
    }

    /// The quantity that a text states, where nothing is wrong with it.
    pub(crate) fn quantity_of(&mut self, text: &str) -> Option<Measure> {
        let literal = parse(text).ok().filter(|_| !self.refers(text));
        literal.or_else(|| {
            formula(text, &mut names_in_force(self.reader))
                .ok()
                .flatten()
        })
    }

    /// Refuses a parameter right after a number, where a unit is read: `2 r`.
    fn refuse_parameter_after_number(&mut self, text: &str) -> bool {
        let unit = number_and_unit(text).map_or("", |found| found.1);
        if unit.is_empty() || self.reader.parameters.get(unit).is_none() {
            return true;
        }
        let message = format!("an operator is missing before the parameter `{unit}`");
        let number = text.trim().trim_end_matches(unit).trim();
        let hint = match parse(text) {
            Ok(_) => format!("write \"{number}*{unit}\", or \"{number} rev\" for revolutions"),
            Err(_) => format!("write \"{number}*{unit}\""),
        };
        self.refuse("ambiguous-unit", message).hints.push(hint);
        false
    }
}

/// True if a text begins with a bracket, calls a function, or has an operator after its first
/// number. Formulas that begin with a name (`r/2`) are found by `refers`.
fn has_arithmetic(text: &str) -> bool {
    let text = text
        .trim_start()
        .trim_start_matches(['-', '+'])
        .trim_start();
    if text.starts_with('(') {
        return true;
    }
    let called = text
        .find('(')
        .is_some_and(|at| super::is_name(text[..at].trim_end()));
    let after = number_and_unit(text).map_or("", |found| found.1);
    let operator = |rest: &str| rest.starts_with(['+', '-', '*', '/', '^']);
    called || operator(after) || after.contains(" + ") || after.contains(" - ")
}
