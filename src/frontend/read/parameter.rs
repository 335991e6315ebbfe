//! The named parameters of a scene, as numbers and expressions find them.

use super::suggest::quoted_list;
use crate::frontend::diagnostics::{Diagnostic, Place};
use crate::units::Measure;
use std::collections::BTreeMap;
use std::sync::Arc;

/// Faults of parameters of which each is reported.
pub(super) const MOST_FAULTS: usize = 20;

/// Names that a circle is reported with.
pub(super) const MOST_OF_CIRCLE: usize = 8;

/// The parameters of a scene, evaluated.
#[derive(Clone, Debug, Default)]
pub struct Parameters(Arc<BTreeMap<String, Parameter>>);

#[derive(Clone, Debug)]
pub(super) struct Parameter {
    pub(super) place: Place,
    /// Place of its value.
    pub(super) value_place: Place,
    /// `None`: it is faulty, which has been said.
    pub(super) value: Option<Measure>,
    /// Whether another parameter refers to it.
    pub(super) used: bool,
}

impl Parameters {
    pub(super) fn new(all: BTreeMap<String, Parameter>) -> Self {
        Self(Arc::new(all))
    }

    /// What a name stands for: see `Scope::quantity`.
    pub(super) fn get(&self, name: &str) -> Option<Option<Measure>> {
        self.0.get(name).map(|one| one.value)
    }

    /// The names, ascending.
    pub(super) fn names(&self) -> impl Iterator<Item = &str> {
        self.0.keys().map(String::as_str)
    }

    /// True when there is none.
    pub(super) fn is_empty(&self) -> bool {
        self.0.is_empty()
    }

    /// Parameters that nothing refers to, with the places of name and value.
    pub(super) fn unused<'p>(
        &'p self,
        used: impl Fn(&str) -> bool + 'p,
    ) -> impl Iterator<Item = (&'p str, &'p Place, &'p Place)> {
        let unused = self
            .0
            .iter()
            .filter(move |(name, one)| !one.used && !used(name));
        unused.map(|(name, one)| (name.as_str(), &one.place, &one.value_place))
    }
}

/// What is said of parameters that nothing refers to.
pub(super) fn unused(found: &[(&str, &Place, &Place)]) -> Vec<Diagnostic> {
    let hint = "write its name in place of a number, or remove it";
    let single = |(name, place, _): &(&str, &Place, &Place)| {
        Diagnostic::warning(
            "unused-parameter",
            format!("nothing refers to the parameter `{name}`"),
        )
        .at((*place).clone())
        .path(format!("parameters.{name}"))
        .hint(hint)
    };
    let mut all: Vec<Diagnostic> = found.iter().take(MOST_FAULTS).map(single).collect();
    if let Some((first, place, _)) = found.get(MOST_FAULTS) {
        let count = found.len() - MOST_FAULTS;
        let names = found[MOST_FAULTS..].iter().map(|one| one.0);
        let message = match count {
            1 => format!("nothing refers to the parameter `{first}`"),
            _ => format!(
                "nothing refers to {count} more parameters: {}, …",
                quoted_list(names.take(MOST_OF_CIRCLE), "and")
            ),
        };
        all.push(Diagnostic::warning("unused-parameter", message).at((*place).clone()));
    }
    all
}
