//! How a command ends.

use dam::diagnostics::Diagnostics;
use serde_json::{Value, json};

/// How a command that did its work ended.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub(crate) enum Status {
    /// The question was answered, whatever the answer.
    Answered,
    /// Stopped early, not to be trusted, or an expectation failed.
    NotTrusted,
    /// Ctrl-C.
    Interrupted,
}

impl Status {
    /// The program's exit status.
    pub(crate) fn code(self) -> u8 {
        match self {
            Self::Answered => 0,
            Self::NotTrusted => 1,
            Self::Interrupted => 130,
        }
    }
}

/// Why a command could not do its work: exit status 2.
#[derive(Debug)]
pub(crate) enum Failure {
    /// The scene is wrong.
    Scene(Box<Diagnostics>),
    /// The arguments or the files are wrong.
    Other(String),
}

impl Failure {
    /// For people.
    pub(crate) fn text(&self, colour: bool) -> String {
        match self {
            Self::Scene(diagnostics) => diagnostics.render(colour),
            Self::Other(message) => format!("error: {message}\n"),
        }
    }

    /// For programs.
    pub(crate) fn json(&self) -> Value {
        match self {
            Self::Scene(diagnostics) => json!({ "dam": 1, "errors": diagnostics.json() }),
            Self::Other(message) => json!({
                "dam": 1,
                "errors": [{ "severity": "error", "code": "input", "message": message }]
            }),
        }
    }
}

impl From<Diagnostics> for Failure {
    fn from(diagnostics: Diagnostics) -> Self {
        Self::Scene(Box::new(diagnostics))
    }
}

impl From<String> for Failure {
    fn from(message: String) -> Self {
        Self::Other(message)
    }
}
