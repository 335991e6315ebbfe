//! Files that are written as a whole or not at all.

use super::token::random;
use std::fs::{self, File, OpenOptions};
use std::io::{Error, Result, Write};
use std::path::Path;

/// Replaces a file, or makes it: what is read of it at any time is all old or all new.
/// `private`: nobody but the user can read it; otherwise it keeps its permissions.
pub(super) fn write(path: &Path, content: &[u8], private: bool) -> Result<()> {
    let folder = path.parent().ok_or_else(|| Error::other("no folder"))?;
    let name = path.file_name().unwrap_or_default().to_string_lossy();
    let random = random().map_err(Error::other)?;
    let temporary = folder.join(format!(".{name}.{}", &random[..12]));
    let written = (|| {
        let mut file = new(&temporary, private)?;
        if let Some(known) = fs::metadata(path).ok().filter(|_| !private) {
            file.set_permissions(known.permissions())?;
        }
        file.write_all(content)?;
        file.sync_all()?;
        fs::rename(&temporary, path)
    })();
    if written.is_err() {
        // What remains is of no use to anybody.
        let _ = fs::remove_file(&temporary);
    }
    written
}

/// A file that was not there before.
pub(super) fn new(path: &Path, private: bool) -> Result<File> {
    let mut options = OpenOptions::new();
    options.write(true).create_new(true);
    #[cfg(unix)]
    if private {
        use std::os::unix::fs::OpenOptionsExt;
        options.mode(0o600);
    }
    #[cfg(not(unix))]
    let _ = private;
    options.open(path)
}

/// A folder that nobody but the user can look into.
pub(super) fn private_folder(path: &Path) -> Result<()> {
    let mut builder = fs::DirBuilder::new();
    builder.recursive(true);
    #[cfg(unix)]
    {
        use std::os::unix::fs::DirBuilderExt;
        builder.mode(0o700);
    }
    builder.create(path)
}
