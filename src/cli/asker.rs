//! Who asks a command: the terminal that it was typed in, or a window of the studio.
//!
//! A window has the text of its document and a budget, and takes the findings in place of
//! standard output and folders.

use super::answer::{Answer, AnswerForm};
use super::args::scene::SceneArgs;
use super::failure::Failure;
use super::input::Input;
use super::interrupt::{self, InterruptGuard};
use super::output::OutputFolder;
use crate::budget::Budget;

/// Where a command has its scene and its time from, and where its answer goes.
pub(crate) trait Asker {
    /// The scene that the arguments name.
    fn input(&self, args: &SceneArgs) -> Result<Input<'_>, Failure>;

    /// How long the answer may take.
    fn budget(&self) -> &Budget<'_>;

    /// Says that there is something to keep from now on, should the command be ended.
    fn guard_from_interrupt(&self) -> Option<InterruptGuard> {
        None
    }

    /// Whether the files of the answer are wanted even without a folder for them.
    fn wants_files(&self) -> bool {
        false
    }

    /// So much is done of so much (0: nobody knows), and this is under way.
    fn report_progress(&self, _done: usize, _of: usize, _now: &str) {}

    /// Takes the answer, to be shown in this form.
    fn deliver(
        &self,
        answer: &Answer<'_>,
        folder: Option<&OutputFolder>,
        shown: AnswerForm,
    ) -> Result<(), Failure>;
}

/// The terminal: scenes are files, answers go to standard output and into folders.
#[derive(Clone, Copy, Debug)]
pub(crate) struct Terminal;

impl Asker for Terminal {
    fn input(&self, args: &SceneArgs) -> Result<Input<'_>, Failure> {
        Input::load(args)
    }

    fn budget(&self) -> &Budget<'_> {
        interrupt::budget()
    }

    fn guard_from_interrupt(&self) -> Option<InterruptGuard> {
        Some(interrupt::hold_interrupt())
    }

    fn deliver(
        &self,
        answer: &Answer<'_>,
        folder: Option<&OutputFolder>,
        shown: AnswerForm,
    ) -> Result<(), Failure> {
        answer.deliver(folder, shown)
    }
}
