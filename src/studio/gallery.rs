//! Scenes that are built in: the scenarios, by the questions that they answer, and the scenes
//! to begin with.

use super::messages::Beginning;
use crate::frontend::diagnostics::Diagnostic;
use crate::frontend::read::file_names;
use crate::frontend::scene::{BuiltIn, Catalogue, Document, NamedBytes, Overrides, Template};
use serde::{Deserialize, Serialize};
use std::borrow::Cow;

include!(concat!(env!("OUT_DIR"), "/scenarios.rs"));
include!(concat!(env!("OUT_DIR"), "/tables.rs"));

/// The tables of the scenarios: what each asks, and what those of a folder ask.
const TABLES: &str = include_str!("../../scenarios/README.md");

/// A scenario.
#[derive(Clone, Debug, PartialEq, Serialize)]
pub(super) struct Scenario {
    /// `rocker/two_masses`.
    name: &'static str,
    /// The name that it gives itself.
    title: String,
    /// What it asks.
    question: String,
    /// What those of its folder ask.
    group: &'static str,
}

/// All scenarios, those that ask the same beside each other, in the order of the tables.
pub(super) fn scenarios() -> Vec<Scenario> {
    let rows = || TABLES.lines().filter_map(cells);
    let groups = rows().filter(|cells| cells.len() == 2 && cells[1].starts_with('`'));
    let groups: Vec<(&str, Vec<&str>)> = groups.map(|row| (row[0], quoted_words(row[1]))).collect();
    let group = |name: &str| {
        let folder = name.split('/').next()?;
        let asks = |(_, folders): &&(&str, Vec<&str>)| folders.contains(&folder);
        groups.iter().find(asks).map(|(question, _)| *question)
    };
    let asked = rows().filter(|cells| cells.len() == 3 && cells[0].starts_with('`'));
    let named = asked.flat_map(|row| {
        let names = quoted_words(row[0]).into_iter();
        names.map(move |name| (name, row[1].replace('`', "")))
    });
    let known = named.filter(|(name, _)| scenario(name).is_some());
    let mut all: Vec<Scenario> = known
        .filter_map(|(name, question)| {
            let group = group(name)?;
            Some(Scenario {
                name,
                title: title(name)?,
                question,
                group,
            })
        })
        .collect();
    all.sort_by_key(|one| {
        groups
            .iter()
            .position(|(question, _)| *question == one.group)
    });
    all
}

/// The text that a new scene begins with.
///
/// # Errors
/// There is none of this name.
pub(super) fn beginning(of: &Beginning) -> Result<String, String> {
    let found = match of {
        Beginning::Template(name) => {
            let found = Template::ALL.into_iter().find(|one| one.name() == name);
            found.map(|one| one.text().to_owned())
        }
        Beginning::Scenario(name) => scenario(name).map(|text| {
            let text = without_schema(text);
            with_tables(name, &text).unwrap_or(text)
        }),
    };
    found.ok_or_else(|| "there is no such scene to begin with".to_owned())
}

/// The name that a scenario gives itself.
fn title(name: &str) -> Option<String> {
    /// The name alone: all else is passed over.
    #[derive(Deserialize)]
    struct Head {
        name: String,
    }
    let head: Head = serde_json::from_str(scenario(name)?).ok()?;
    Some(head.name)
}

fn scenario(name: &str) -> Option<&'static str> {
    let found = SCENARIOS.iter().find(|(own, _)| *own == name)?;
    Some(found.1)
}

/// A scenario without the line that says where, beside it, its schema lies.
fn without_schema(text: &str) -> String {
    let lines = text.split_inclusive('\n');
    lines
        .filter(|line| !line.trim_start().starts_with("\"$schema\":"))
        .collect()
}

/// The tables beside a scenario.
struct Tables<'n>(&'n str);

impl Catalogue for Tables<'_> {
    fn lookup(&self, name: &str) -> Option<(String, Cow<'_, str>)> {
        BuiltIn.lookup(name)
    }

    fn names(&self) -> Vec<String> {
        BuiltIn.names()
    }

    fn table(&self, name: &str) -> Result<NamedBytes, Box<Diagnostic>> {
        let folder = self.0.split('/').next().unwrap_or_default();
        let wanted = format!("{folder}/{}", name.trim_end_matches(".csv"));
        match TABLE_FILES.iter().find(|(own, _)| *own == wanted) {
            Some((_, text)) => Ok((name.to_owned(), text.as_bytes().to_vec())),
            None => BuiltIn.table(name),
        }
    }
}

/// A scenario that names files, with their tables in it: it is to be right wherever it lies.
fn with_tables(name: &str, text: &str) -> Option<String> {
    let document = Document::parse(name, text.as_bytes()).ok()?;
    if file_names(document.root()).is_empty() {
        return None;
    }
    let reading = document.scene(&Tables(name), &Overrides::none()).ok()?;
    Some(document.decoded(&reading.places).text().to_owned())
}

/// The cells of a row of a table.
fn cells(line: &'static str) -> Option<Vec<&'static str>> {
    let inner = line.strip_prefix('|')?.trim_end().strip_suffix('|')?;
    Some(inner.split('|').map(str::trim).collect())
}

/// What stands in quotes.
fn quoted_words(cell: &'static str) -> Vec<&'static str> {
    cell.split('`').skip(1).step_by(2).collect()
}

#[cfg(test)]
mod tests {
    use super::{SCENARIOS, beginning, scenarios};
    use crate::frontend::scene::{BuiltIn, Document, Overrides, Template};
    use crate::studio::messages::Beginning;

    #[test]
    fn every_scenario_stands_in_the_tables_once() {
        let mut named: Vec<&str> = scenarios().iter().map(|one| one.name).collect();
        named.sort_unstable();
        let all: Vec<&str> = SCENARIOS.iter().map(|(name, _)| *name).collect();
        assert_eq!(named, all);
        assert!(all.len() > 60 && scenarios().iter().all(|one| one.question.len() > 10));
        let titled = |one: &super::Scenario| one.title.len() > 5;
        assert!(scenarios().iter().all(titled));
        // Those of a group stand together.
        let mut groups: Vec<&str> = scenarios().iter().map(|one| one.group).collect();
        groups.dedup();
        let count = groups.len();
        groups.sort_unstable();
        groups.dedup();
        assert_eq!((groups.len(), count), (count, 10));
    }

    #[test]
    fn what_a_scene_begins_with_is_right_wherever_it_lies() {
        let templates = Template::ALL.map(|one| Beginning::Template(one.name().to_owned()));
        let scenarios = SCENARIOS.iter();
        let scenarios = scenarios.map(|(name, _)| Beginning::Scenario((*name).to_owned()));
        for of in templates.into_iter().chain(scenarios) {
            let text = beginning(&of).unwrap();
            assert!(!text.contains("$schema"), "{of:?}");
            let document = Document::parse("scene", text.as_bytes()).unwrap();
            let read = document.scene(&BuiltIn, &Overrides::none());
            assert!(read.is_ok(), "{of:?}: {}", read.unwrap_err());
        }
        for wrong in ["", "../lever", "rocker", "lever.json"] {
            assert!(beginning(&Beginning::Template(wrong.to_owned())).is_err());
            assert!(beginning(&Beginning::Scenario(wrong.to_owned())).is_err());
        }
    }
}
