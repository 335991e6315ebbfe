//! Exit statuses of the program.

use std::sync::atomic::{AtomicU8, Ordering};

/// The exit status that tells of the signal: 128 and its number.
static CODE: AtomicU8 = AtomicU8::new(130);

/// Status of a command that did its work.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub(crate) enum Status {
    /// The question was answered, whatever the answer.
    Answered,
    /// Stopped early, not to be trusted, or an expectation failed.
    NotTrusted,
    /// Of several scenes one is wrong, the others were asked.
    WrongScene,
    /// Ended by a signal with what was computed until then.
    Interrupted,
}

impl Status {
    /// The program's exit status: of a signal 128 and its number.
    pub(crate) fn code(self) -> u8 {
        match self {
            Self::Answered => 0,
            Self::NotTrusted => 1,
            Self::WrongScene => 2,
            Self::Interrupted => CODE.load(Ordering::Relaxed),
        }
    }

    /// A signal has come; `code` is the exit status of a command that it ends.
    #[cfg(not(target_family = "wasm"))]
    pub(crate) fn set_signalled(code: u8) {
        CODE.store(code, Ordering::Relaxed);
    }
}
