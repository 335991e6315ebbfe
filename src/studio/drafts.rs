//! Drafts: what is not saved yet, kept in the user's state folder from crashes.

use super::atomic;
use serde::{Deserialize, Serialize};
use sha2::{Digest, Sha256};
use std::fmt::Write;
use std::fs;
use std::path::{Path, PathBuf};
use std::time::{SystemTime, UNIX_EPOCH};

/// Text of a scene that is not saved.
#[derive(Clone, Debug, PartialEq, Serialize, Deserialize)]
pub(super) struct Draft {
    /// The scene's file, links resolved.
    path: PathBuf,
    /// SHA-256 of what the file held when it was last read or saved.
    base: String,
    /// The text.
    pub(super) text: String,
    /// When it was written (s since 1970).
    pub(super) time: u64,
}

/// The folder of drafts; `None`: drafts cannot be kept.
#[derive(Clone, Debug)]
pub(super) struct Drafts {
    folder: Option<PathBuf>,
}

impl Drafts {
    /// Those of the user.
    pub(super) fn of_user() -> Self {
        Self {
            folder: state_folder().map(|folder| folder.join("drafts")),
        }
    }

    /// Those in a folder.
    #[cfg(test)]
    pub(super) fn within(folder: &Path) -> Self {
        Self {
            folder: Some(folder.to_owned()),
        }
    }

    fn place(&self, path: &Path) -> Option<PathBuf> {
        let key = hash(path.to_string_lossy().as_bytes());
        Some(self.folder.as_ref()?.join(format!("{key}.json")))
    }

    /// Keeps a text of a file that held `saved` when it was last looked at.
    ///
    /// # Errors
    /// It cannot be written.
    pub(super) fn keep(&self, path: &Path, saved: &str, text: &str) -> Result<(), String> {
        let place = self.place(path).ok_or("there is no folder for drafts")?;
        let time = SystemTime::now().duration_since(UNIX_EPOCH);
        let draft = Draft {
            path: path.to_owned(),
            base: hash(saved.as_bytes()),
            text: text.to_owned(),
            time: time.map_or(0, |time| time.as_secs()),
        };
        let content = serde_json::to_vec(&draft).map_err(|error| error.to_string())?;
        let folder = place.parent().unwrap_or(Path::new("."));
        atomic::private_folder(folder)
            .and_then(|()| atomic::write(&place, &content, true))
            .map_err(|error| error.kind().to_string())
    }

    /// The draft of a file.
    pub(super) fn find(&self, path: &Path) -> Option<Draft> {
        let bytes = fs::read(self.place(path)?).ok()?;
        let draft: Draft = serde_json::from_slice(&bytes).ok()?;
        (draft.path == path).then_some(draft)
    }

    /// Forgets the draft of a file.
    pub(super) fn forget(&self, path: &Path) {
        if let Some(place) = self.place(path) {
            // There may be none.
            let _ = fs::remove_file(place);
        }
    }
}

impl Draft {
    /// Whether the file has been changed by others since.
    pub(super) fn is_of_another(&self, saved: &str) -> bool {
        self.base != hash(saved.as_bytes())
    }
}

/// The user's folder for the state of this program.
pub(super) fn state_folder() -> Option<PathBuf> {
    let given = |name: &str| std::env::var_os(name).filter(|value| !value.is_empty());
    let absolute = |path: PathBuf| path.is_absolute().then_some(path);
    let own = given("XDG_STATE_HOME")
        .map(PathBuf::from)
        .and_then(absolute);
    let windows = given("LOCALAPPDATA").filter(|_| cfg!(windows));
    let home = || given("HOME").map(|home| PathBuf::from(home).join(".local/state"));
    let base = own.or(windows.map(PathBuf::from)).or_else(home)?;
    Some(base.join("dam"))
}

/// SHA-256, as text.
pub(super) fn hash(bytes: &[u8]) -> String {
    let mut text = String::new();
    for byte in Sha256::digest(bytes) {
        // Writing to a string cannot fail.
        let _ = write!(text, "{byte:02x}");
    }
    text
}

#[cfg(test)]
mod tests {
    use super::Drafts;
    use std::path::Path;

    #[test]
    fn drafts_are_kept_by_file_and_for_the_user_alone() {
        let folder = tempfile::tempdir().unwrap();
        let drafts = Drafts::within(&folder.path().join("drafts"));
        let (one, other) = (Path::new("/a/one.json"), Path::new("/a/other.json"));
        assert_eq!(drafts.find(one), None);
        drafts.keep(one, "saved", "first").unwrap();
        drafts.keep(one, "saved", "second").unwrap();
        drafts.keep(other, "", "third").unwrap();
        let draft = drafts.find(one).unwrap();
        assert_eq!(draft.text, "second");
        assert!(!draft.is_of_another("saved") && draft.is_of_another("changed"));
        #[cfg(unix)]
        {
            use std::os::unix::fs::PermissionsExt;
            let mode = |path: &Path| path.metadata().unwrap().permissions().mode() & 0o777;
            assert_eq!(mode(&folder.path().join("drafts")), 0o700);
            assert_eq!(mode(&drafts.place(one).unwrap()), 0o600);
        }
        drafts.forget(one);
        assert_eq!(drafts.find(one), None);
        assert_eq!(drafts.find(other).unwrap().text, "third");
    }
}
