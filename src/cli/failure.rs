//! How a command ends.

use super::status::Status;
use crate::frontend::diagnostics::Diagnostics;
use serde_json::{Value, json};

/// Why a command did not come to its end.
#[derive(Debug)]
pub(crate) enum Failure {
    /// The scene is wrong.
    Scene(Box<Diagnostics>),
    /// The arguments or the files are wrong.
    Other(String),
    /// The question was right, and its answer could not be given or written down.
    Output(String),
}

impl Failure {
    /// The program's exit status.
    pub(crate) fn code(&self) -> u8 {
        match self {
            Self::Scene(_) | Self::Other(_) => 2,
            Self::Output(_) => Status::NotTrusted.code(),
        }
    }

    /// What is wrong, in a line.
    pub(crate) fn message(&self) -> String {
        match self {
            Self::Scene(diagnostics) => diagnostics.lines().join("; "),
            Self::Other(message) | Self::Output(message) => message.clone(),
        }
    }

    /// For programs.
    pub(crate) fn json(&self) -> Value {
        let one = |code: &str, message: &str| {
            json!({
                "dam": 1,
                "errors": [{ "severity": "error", "code": code, "message": message }]
            })
        };
        match self {
            Self::Scene(diagnostics) => json!({ "dam": 1, "errors": diagnostics.json() }),
            Self::Other(message) => one("input", message),
            Self::Output(message) => one("output", message),
        }
    }
}

/// # Errors
/// An option is given that has no effect or no place here.
pub(crate) fn refuse_option(given: bool, why: &str) -> Result<(), Failure> {
    match given {
        true => Err(Failure::Other(why.to_owned())),
        false => Ok(()),
    }
}

impl From<Diagnostics> for Failure {
    fn from(diagnostics: Diagnostics) -> Self {
        Self::Scene(Box::new(diagnostics))
    }
}

impl From<crate::Error> for Failure {
    fn from(error: crate::Error) -> Self {
        error.into_diagnostics().into()
    }
}

impl From<String> for Failure {
    fn from(message: String) -> Self {
        Self::Other(message)
    }
}
