//! The questions besides the run, as the program's commands answer them: what a window may ask,
//! and what it is told. The program brings them along (`crate::cli`).
//!
//! `cli::questions` lends the commands to the server, since this module is below the program.
//! The form of a command is made from its clap declaration.

use super::limits::RUN;
use crate::budget::Budget;
use crate::frontend::scene::Catalogue;
use serde::Deserialize;
use serde_json::Value;
use std::collections::BTreeMap;
use std::fmt::Debug;
use std::sync::atomic::AtomicBool;

/// A question of a window: a command with some of its options.
#[derive(Clone, Debug, Deserialize, PartialEq)]
#[serde(deny_unknown_fields)]
pub(crate) struct Question {
    /// The command: `kinematics`, `law cycle`.
    pub(crate) command: String,
    /// Values of options by their names, as many as each takes; none of a flag.
    #[serde(default)]
    pub(crate) options: BTreeMap<String, Vec<String>>,
}

/// The scene that is asked.
#[derive(Clone, Copy)]
pub(crate) struct CommandScene<'a> {
    /// Its name.
    pub(crate) name: &'a str,
    /// Its text.
    pub(crate) text: &'a str,
    /// What it may copy from.
    pub(crate) catalogue: &'a (dyn Catalogue + Sync),
    /// How long the answer may take.
    pub(crate) budget: Budget<'a>,
    /// Is told how much is done of how much (0: nobody knows), and what is under way.
    pub(crate) tell: &'a dyn Fn(usize, usize, &str),
}

impl<'a> CommandScene<'a> {
    /// A scene that is asked in silence, for as long as a run may take.
    pub(super) fn new(
        (name, text): (&'a str, &'a str),
        catalogue: &'a (dyn Catalogue + Sync),
        stop: &'a AtomicBool,
    ) -> Self {
        Self {
            name,
            text,
            catalogue,
            budget: Budget::interrupted_by(stop).within(RUN),
            tell: &|_, _, _| {},
        }
    }
}

/// The commands that answer questions.
pub(crate) trait Commands: Debug + Sync {
    /// The questions with their options, and of a scene why it does not fit some of them.
    fn forms(&self, asked: &CommandScene<'_>) -> Value;

    /// What a command finds, as a message without its kind.
    ///
    /// # Errors
    /// In words: the options are wrong, the scene is, or it has no answer to this.
    fn answer(&self, question: &Question, asked: &CommandScene<'_>) -> Result<Value, String>;

    /// Content of one of the files that the command writes; `None`: there is none of this name.
    ///
    /// # Errors
    /// As of [`Self::answer`].
    fn file(
        &self,
        question: &Question,
        asked: &CommandScene<'_>,
        name: &str,
    ) -> Result<Option<String>, String>;
}
