//! Drafts: what is not saved yet, kept in the user's state folder from crashes.

use super::by_file::ByFile;
use super::token::hash;
use serde::{Deserialize, Serialize};
use std::path::Path;
use std::time::{SystemTime, UNIX_EPOCH};

/// Text of a scene that is not saved.
#[derive(Clone, Debug, PartialEq, Serialize, Deserialize)]
pub(super) struct Draft {
    /// SHA-256 of what the file held when it was last read or saved.
    base: String,
    /// The text.
    pub(super) text: String,
    /// When it was written (s since 1970).
    pub(super) time: u64,
}

/// The folder of drafts.
#[derive(Clone, Debug)]
pub(super) struct Drafts(ByFile);

impl Drafts {
    /// Those of the user.
    pub(super) fn of_user() -> Self {
        Self(ByFile::of_user("drafts"))
    }

    /// Those in a folder.
    #[cfg(test)]
    pub(super) fn in_folder(folder: &Path) -> Self {
        Self(ByFile::in_folder(folder))
    }

    /// Keeps a text of a file that held `saved` when it was last looked at.
    ///
    /// # Errors
    /// It cannot be written.
    pub(super) fn write_draft(&self, path: &Path, saved: &str, text: &str) -> Result<(), String> {
        let time = SystemTime::now().duration_since(UNIX_EPOCH);
        let draft = Draft {
            base: hash(saved.as_bytes()),
            text: text.to_owned(),
            time: time.map_or(0, |time| time.as_secs()),
        };
        self.0.write_record(path, draft)
    }

    /// The draft of a file.
    pub(super) fn find(&self, path: &Path) -> Option<Draft> {
        self.0.find(path)
    }

    /// Forgets the draft of a file.
    pub(super) fn forget_draft(&self, path: &Path) {
        self.0.forget_record(path);
    }
}

impl Draft {
    /// Whether the file has been changed by others since.
    pub(super) fn is_of_another(&self, saved: &str) -> bool {
        self.base != hash(saved.as_bytes())
    }
}

#[cfg(test)]
mod tests {
    use super::Drafts;
    use std::path::Path;

    #[test]
    fn a_draft_tells_what_file_it_was_made_of() {
        let folder = tempfile::tempdir().unwrap();
        let drafts = Drafts::in_folder(&folder.path().join("drafts"));
        let (one, other) = (Path::new("/a/one.json"), Path::new("/a/other.json"));
        assert_eq!(drafts.find(one), None);
        drafts.write_draft(one, "saved", "first").unwrap();
        drafts.write_draft(one, "saved", "second").unwrap();
        drafts.write_draft(other, "", "third").unwrap();
        let draft = drafts.find(one).unwrap();
        assert_eq!(draft.text, "second");
        assert!(!draft.is_of_another("saved") && draft.is_of_another("changed"));
        drafts.forget_draft(one);
        assert_eq!(drafts.find(one), None);
        assert_eq!(drafts.find(other).unwrap().text, "third");
    }
}
