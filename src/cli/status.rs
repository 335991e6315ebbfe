//! Exit statuses of the program.

use super::interrupt;

/// How a command that did its work ended.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub(crate) enum Status {
    /// The question was answered, whatever the answer.
    Answered,
    /// Stopped early, not to be trusted, or an expectation failed.
    NotTrusted,
    /// Ended by a signal with what was computed until then.
    Interrupted,
}

impl Status {
    /// The program's exit status: of a signal 128 and its number.
    pub(crate) fn code(self) -> u8 {
        match self {
            Self::Answered => 0,
            Self::NotTrusted => 1,
            Self::Interrupted => interrupt::code(),
        }
    }
}
