//! Ctrl-C: the first ends the run in good order, the second ends the program.

use signal_hook::consts::SIGINT;
use signal_hook::flag;
use std::sync::atomic::AtomicBool;
use std::sync::{Arc, LazyLock};

static INTERRUPTED: LazyLock<Arc<AtomicBool>> = LazyLock::new(Arc::default);

/// Starts listening and returns the flag that Ctrl-C sets.
pub(crate) fn listen() -> &'static AtomicBool {
    // The order matters: the flag that ends the program is that of the signal
    // before. Without a handler Ctrl-C still ends the program, only less politely.
    let _ = flag::register_conditional_shutdown(SIGINT, 130, Arc::clone(&INTERRUPTED))
        .and_then(|_| flag::register(SIGINT, Arc::clone(&INTERRUPTED)));
    &INTERRUPTED
}
