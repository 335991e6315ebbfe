//! One program at a time writes into a folder.

use std::fs::{File, TryLockError};
use std::io;
use std::path::Path;

/// The folder is this program's until it is dropped; the system frees it too where
/// the program is killed.
#[derive(Debug)]
pub(super) struct Lock(#[allow(dead_code, reason = "held, not examined")] File);

/// Why a folder is not to be had.
#[derive(Debug)]
pub(super) enum LockError {
    /// Another program writes there.
    Taken,
    /// The lock cannot be opened.
    System(io::Error),
}

impl Lock {
    /// Takes a folder that exists. Where the file system knows no locks (some of
    /// those over a network), there is none.
    pub(super) fn lock_folder(folder: &Path) -> Result<Self, LockError> {
        let file = open(folder).map_err(LockError::System)?;
        match file.try_lock() {
            Err(TryLockError::WouldBlock) => Err(LockError::Taken),
            Ok(()) | Err(TryLockError::Error(_)) => Ok(Self(file)),
        }
    }
}

/// The folder itself, so that nothing has to lie in it.
#[cfg(unix)]
fn open(folder: &Path) -> io::Result<File> {
    File::open(folder)
}

/// A file in the folder: the folder itself cannot be opened.
#[cfg(not(unix))]
fn open(folder: &Path) -> io::Result<File> {
    File::options()
        .create(true)
        .truncate(false)
        .write(true)
        .open(folder.join(".dam.lock"))
}
