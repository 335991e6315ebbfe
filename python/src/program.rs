//! The program `dam`, as the console script calls it.
//!
//! It calls `cli::main_with` without Python's handlers of signals, and ends the process.

use pyo3::prelude::*;
use std::panic::catch_unwind;

/// Runs the program with the arguments of the process and ends the process with its status.
///
/// Python's own handlers of SIGINT and SIGPIPE are gone by then (see `dam.__main__`): the
/// program's are the only ones, and what it writes goes past Python's buffers.
#[pyfunction]
pub(crate) fn program(py: Python<'_>, arguments: Vec<std::ffi::OsString>) -> u8 {
    let ran = py.detach(|| catch_unwind(|| dam::cli::main_with(arguments)));
    // As a program ends that panics.
    ran.unwrap_or(101)
}
