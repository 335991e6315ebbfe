//! What ends a command from outside: Ctrl-C, SIGTERM, the time limit.
//!
//! While nothing is there to be lost (a scene is read, lowered, looked at), the
//! program ends at once. While something is kept (a motion, finished cells, files
//! on their way to the disk), the budget that every computation looks at is spent,
//! and the command ends in good order with what it has. A second signal ends the
//! program in any case.

use super::failure::Failure;
use super::status::Status;
use crate::budget::Budget;
use std::sync::atomic::{AtomicBool, Ordering};
use std::sync::{Mutex, MutexGuard, OnceLock, PoisonError};
use std::time::Duration;

/// Raised by the first signal.
static SIGNALLED: AtomicBool = AtomicBool::new(false);

/// Number of keepers: those who keep something at present.
static KEEPERS: Mutex<usize> = Mutex::new(0);

/// Budget of the command, from its start on.
static BUDGET: OnceLock<Budget<'static>> = OnceLock::new();

/// Set once the answer is on its way to standard output: the time limit is then kept.
static ANSWERING: AtomicBool = AtomicBool::new(false);

/// What the command is about, for a time limit that ends it with nothing to keep.
static STAGE: Mutex<Stage> = Mutex::new(Stage::Reading);

/// What a command is about before it has anything to keep.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub(crate) enum Stage {
    /// The scene is read.
    Reading,
    /// The model is made, and judged where that is asked for.
    Preparing,
    /// A method is chosen, and a start is found.
    Starting,
    /// The question is answered.
    Answering,
}

impl Stage {
    fn words(self) -> &'static str {
        match self {
            Self::Reading => "while the scene was read",
            Self::Preparing => "while the model was prepared",
            Self::Starting => {
                "while a method was chosen and the start of the motion was found; `run.method` \
                 names one, \"start\": \"on_law\" needs no search"
            }
            Self::Answering => "while the question was answered",
        }
    }
}

/// Says what the command is about from now on.
pub(crate) fn enter(stage: Stage) {
    *STAGE.lock().unwrap_or_else(PoisonError::into_inner) = stage;
}

/// Says that the answer is there and being written.
pub(crate) fn answering() {
    ANSWERING.store(true, Ordering::Relaxed);
}

/// For as long as it lives, the program does not end from outside.
#[derive(Debug)]
pub(crate) struct InterruptGuard(());

/// Says that there is something to keep from now on.
pub(crate) fn hold_interrupt() -> InterruptGuard {
    *count_of_guards() += 1;
    InterruptGuard(())
}

impl Drop for InterruptGuard {
    fn drop(&mut self) {
        *count_of_guards() -= 1;
    }
}

fn count_of_guards() -> MutexGuard<'static, usize> {
    KEEPERS.lock().unwrap_or_else(PoisonError::into_inner)
}

/// Starts listening; the time `limit` counts from here on. A command that the time
/// limit ends before it has anything to keep says so as `json` asks.
pub(crate) fn start(limit: Option<Duration>, json: bool) {
    let budget = Budget::interrupted_by(&SIGNALLED);
    let budget = limit.map_or(budget, |limit| budget.within(limit));
    BUDGET.get_or_init(|| budget);
    listen();
    if let Some(limit) = limit {
        std::thread::spawn(move || {
            std::thread::sleep(limit);
            if ANSWERING.load(Ordering::Relaxed) {
                return;
            }
            exit_unless_saving(|| {
                let stage = *STAGE.lock().unwrap_or_else(PoisonError::into_inner);
                let over = Failure::Output(format!(
                    "the time limit of {} s was over before there was a result, {}",
                    limit.as_secs_f64(),
                    stage.words()
                ));
                super::report(&over, json);
                Status::NotTrusted.code()
            });
        });
    }
}

/// Budget that is left to the command.
pub(crate) fn budget() -> &'static Budget<'static> {
    BUDGET.get_or_init(|| Budget::interrupted_by(&SIGNALLED))
}

/// Status of a command that was ended from outside with what it had.
pub(crate) fn status() -> Status {
    match SIGNALLED.load(Ordering::Relaxed) {
        true => Status::Interrupted,
        false => Status::NotTrusted,
    }
}

/// A signal has come; `code` is its exit status.
#[cfg(not(target_family = "wasm"))]
fn handle_signal(code: u8) {
    if SIGNALLED.load(Ordering::Relaxed) {
        std::process::exit(i32::from(code));
    }
    Status::set_signalled(code);
    SIGNALLED.store(true, Ordering::Relaxed);
    exit_unless_saving(|| code);
}

/// Nobody can begin to keep anything while the program ends.
fn exit_unless_saving(last_words: impl FnOnce() -> u8) {
    let keepers = count_of_guards();
    if *keepers == 0 {
        std::process::exit(i32::from(last_words()));
    }
}

#[cfg(unix)]
fn listen() {
    use signal_hook::consts::{SIGINT, SIGTERM};
    // Without a handler signals still end the program, only less politely.
    let Ok(mut signals) = signal_hook::iterator::Signals::new([SIGINT, SIGTERM]) else {
        return;
    };
    std::thread::spawn(move || {
        for signal in signals.forever() {
            handle_signal(128 + u8::try_from(signal).unwrap_or(0));
        }
    });
}

#[cfg(target_family = "wasm")]
fn listen() {}

#[cfg(not(any(unix, target_family = "wasm")))]
fn listen() {
    // Without a handler Ctrl-C still ends the program, only less politely.
    let _ = ctrlc::set_handler(|| handle_signal(130));
}
