//! Diagnostics: everything that is wrong with a scene, at once, each with its
//! place, what is wrong, and what would be right.
//!
//! Data only; [`Diagnostics::render`] makes the text for people, [`Diagnostics::json`]
//! the document for programs.

mod codes;
mod render;
mod source;

pub use codes::{CODES, Code};
pub use render::{is_harmful, printable};
pub use source::{Place, Position, Source, SourceId, Sources};

use std::fmt;

/// Severity of a diagnostic.
#[derive(Clone, Copy, Debug, PartialEq, Eq, PartialOrd, Ord)]
pub enum Severity {
    /// The scene cannot be run.
    Error,
    /// The scene can be run; the user should know this.
    Warning,
}

/// A second place that a diagnostic speaks of.
#[derive(Clone, Debug, PartialEq, Eq)]
pub struct RelatedPlace {
    /// Place that is pointed at.
    pub place: Place,
    /// Label at the place.
    pub label: String,
}

/// A diagnostic: one thing that is wrong, with its place and hints.
#[derive(Clone, Debug, PartialEq, Eq)]
pub struct Diagnostic {
    /// Severity: error or warning.
    pub severity: Severity,
    /// Short stable name: `unknown-property`.
    pub code: &'static str,
    /// Place; `None` when it concerns no place of a text.
    pub place: Option<Place>,
    /// Address of the property concerned, `rocker.pair.gap`; empty: the whole.
    pub path: String,
    /// Message in one line: what is wrong.
    pub message: String,
    /// A word at the place itself.
    pub label: String,
    /// Hints at what would be right.
    pub hints: Vec<String>,
    /// Other places concerned.
    pub related: Vec<RelatedPlace>,
}

impl Diagnostic {
    /// Whether it is that of a value that is no whole number, at a property that counts.
    pub fn is_of_a_count(&self) -> bool {
        self.code == "not-whole"
    }

    /// An error.
    pub fn error(code: &'static str, message: impl Into<String>) -> Self {
        Self {
            severity: Severity::Error,
            code,
            place: None,
            path: String::new(),
            message: message.into(),
            label: String::new(),
            hints: Vec::new(),
            related: Vec::new(),
        }
    }

    /// A warning.
    pub fn warning(code: &'static str, message: impl Into<String>) -> Self {
        Self {
            severity: Severity::Warning,
            ..Self::error(code, message)
        }
    }

    /// Sets the place.
    pub fn at(mut self, place: Place) -> Self {
        self.place = Some(place);
        self
    }

    /// Sets the address of the property concerned.
    pub fn path(mut self, path: impl Into<String>) -> Self {
        self.path = path.into();
        self
    }

    /// Sets the word at the place.
    pub fn label(mut self, label: impl Into<String>) -> Self {
        self.label = label.into();
        self
    }

    /// Adds a hint.
    pub fn hint(mut self, hint: impl Into<String>) -> Self {
        self.hints.push(hint.into());
        self
    }

    /// Adds a hint when there is one.
    pub fn maybe_hint(mut self, hint: Option<String>) -> Self {
        self.hints.extend(hint);
        self
    }

    /// Adds another place.
    pub fn with_place(mut self, place: Place, label: impl Into<String>) -> Self {
        self.related.push(RelatedPlace {
            place,
            label: label.into(),
        });
        self
    }
}

/// A list of diagnostics with the texts they point into.
#[derive(Clone, Debug, Default, PartialEq, Eq)]
pub struct Diagnostics {
    /// The texts.
    pub sources: Sources,
    /// Errors and warnings, in the order of their places.
    pub items: Vec<Diagnostic>,
}

impl Diagnostics {
    /// Sorts the items by place (those without one last) and drops repeated ones.
    pub fn new(sources: Sources, mut items: Vec<Diagnostic>) -> Self {
        items.sort_by_cached_key(|item| {
            item.place
                .as_ref()
                .map_or((usize::MAX, 0), |place| (place.source, place.range.start))
        });
        items.dedup();
        Self { sources, items }
    }

    /// True when there is nothing to say.
    pub fn is_empty(&self) -> bool {
        self.items.is_empty()
    }

    /// True when anything in it is an error.
    pub fn has_errors(&self) -> bool {
        self.items
            .iter()
            .any(|item| item.severity == Severity::Error)
    }

    /// The text for people: each diagnostic with an excerpt, then a count.
    /// `colour` adds terminal escape sequences.
    pub fn render(&self, colour: bool) -> String {
        render::render(self, colour)
    }

    /// The messages alone, one line each: `scene.json:7:14: message (hint)`.
    pub fn lines(&self) -> Vec<String> {
        self.items.iter().map(|item| self.line(item)).collect()
    }

    fn line(&self, item: &Diagnostic) -> String {
        let mut line = match self.location(item) {
            Some((name, at)) => format!("{name}:{}:{}: ", at.line, at.column),
            None if item.path.is_empty() => String::new(),
            None => format!("{}: ", item.path),
        };
        line.push_str(&item.message);
        if !item.hints.is_empty() {
            line.push_str(&format!(" ({})", item.hints.join("; ")));
        }
        line
    }

    fn location(&self, item: &Diagnostic) -> Option<(&str, Position)> {
        let place = item.place.as_ref().filter(|place| !place.is_nowhere())?;
        let source = self.sources.get(place.source)?;
        Some((&source.name, source.position(place.range.start)))
    }

    /// The document for programs: an array of objects with severity, code,
    /// path, message, label, hints, file, line, column.
    pub fn json(&self) -> serde_json::Value {
        let items = self.items.iter().map(|item| {
            let location = self.location(item);
            serde_json::json!({
                "severity": match item.severity {
                    Severity::Error => "error",
                    Severity::Warning => "warning",
                },
                "code": item.code,
                "path": item.path,
                "message": item.message,
                "label": item.label,
                "hints": item.hints,
                "file": location.map(|(name, _)| name),
                "line": location.map(|(_, at)| at.line),
                "column": location.map(|(_, at)| at.column),
            })
        });
        items.collect()
    }
}

impl fmt::Display for Diagnostics {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        f.write_str(&self.render(false))
    }
}

impl std::error::Error for Diagnostics {}
