//! The one error of the library.

use crate::fault::Fault;
use crate::frontend::diagnostics::{Diagnostic, Diagnostics, Sources};
use std::fmt;
use std::io;
use std::path::Path;

/// Everything that is wrong with a scene or a question, at once.
///
/// [`Display`](fmt::Display) reads like the program's messages: for each fault its
/// place, with an excerpt where there is a text, what is wrong and what would be right.
/// Of a scene made in code the place is the address of the property,
/// `rocker.pair.gap`. [`Debug`](fmt::Debug) says the same, so that a `main` that returns
/// an error shows it as it should be read.
pub struct Error {
    diagnostics: Box<Diagnostics>,
    source: Option<io::Error>,
}

impl Error {
    /// All faults, each with a short stable name ([`Diagnostic::code`]), the address of
    /// the property concerned, message and hints; warnings may be among them.
    pub fn faults(&self) -> &[Diagnostic] {
        &self.diagnostics.items
    }

    /// The faults with the texts that they point into: to render them in colour, or as
    /// JSON.
    pub fn diagnostics(&self) -> &Diagnostics {
        &self.diagnostics
    }

    /// The diagnostics of the error, taken out of it.
    pub fn into_diagnostics(self) -> Diagnostics {
        *self.diagnostics
    }

    /// A question that cannot be answered, in words.
    pub(crate) fn question(message: impl Into<String>) -> Self {
        Self::of(Diagnostic::error("question", message))
    }

    /// A name that is not known, with what may have been meant.
    pub(crate) fn unknown(what: &str, name: &str, known: &[&str]) -> Self {
        let guess = crate::frontend::read::did_you_mean(name, known.iter().copied());
        let all = || {
            let some = known.iter().copied().take(20);
            format!(
                "there are {}",
                crate::frontend::read::quoted_list(some, "and")
            )
        };
        let message = format!("there is no {what} `{name}`");
        let fault = Diagnostic::error("unknown-name", message);
        Self::of(fault.hint(guess.unwrap_or_else(all)))
    }

    /// A file that could not be read.
    pub(crate) fn file(path: &Path, error: io::Error) -> Self {
        let message = format!("cannot read the scene `{}`: {error}", path.display());
        Self {
            source: Some(error),
            ..Self::of(Diagnostic::error("file", message))
        }
    }

    /// An error of one fault.
    pub(crate) fn of(fault: Diagnostic) -> Self {
        Diagnostics::new(Sources::default(), vec![fault]).into()
    }
}

impl From<Diagnostics> for Error {
    fn from(diagnostics: Diagnostics) -> Self {
        Self {
            diagnostics: Box::new(diagnostics),
            source: None,
        }
    }
}

impl From<Vec<Fault>> for Error {
    /// Faults of a model that comes from no scene: their places are addresses.
    fn from(faults: Vec<Fault>) -> Self {
        let items = faults.into_iter().map(|fault| {
            let hint = Some(fault.hint).filter(|hint| !hint.is_empty());
            Diagnostic::error("model", fault.message)
                .path(fault.path)
                .maybe_hint(hint)
        });
        Diagnostics::new(Sources::default(), items.collect()).into()
    }
}

impl fmt::Display for Error {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        f.write_str(self.diagnostics.render(false).trim_end())
    }
}

impl fmt::Debug for Error {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        write!(f, "\n{self}")
    }
}

impl std::error::Error for Error {
    fn source(&self) -> Option<&(dyn std::error::Error + 'static)> {
        self.source.as_ref().map(|error| error as _)
    }
}
