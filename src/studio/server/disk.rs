//! The file beside a text, which others may change, and the draft of what is not saved.

use super::atomic;
use super::drafts::{Draft, Drafts};
use super::folder::Folder;
use super::token::hash;
use serde_json::{Value, json};
use std::path::{Path, PathBuf};
use std::time::SystemTime;

/// The file of a document, and its draft.
#[derive(Debug)]
pub(super) struct OnDisk {
    path: PathBuf,
    /// What the file held when it was last read or written.
    saved: String,
    /// Its SHA-256.
    base: String,
    file: File,
    drafts: Drafts,
    /// A draft that waits for a decision; the text is not to be changed before.
    offered: Option<Draft>,
    /// Version of the text in the draft on the disk; `None`: there is none.
    drafted: Option<u64>,
}

/// The file beside the text.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
enum File {
    /// As it was left.
    Same(Stamp),
    /// Changed by others, which the user has not decided on.
    Changed(Stamp),
    /// Gone.
    Gone,
}

/// Tells one state of a file from another without reading it.
type Stamp = Option<(SystemTime, u64)>;

fn file_stamp(path: &Path) -> Stamp {
    let known = path.metadata().ok()?;
    Some((known.modified().ok()?, known.len()))
}

impl OnDisk {
    /// A file as it is, with the draft of it that there may be.
    ///
    /// # Errors
    /// It cannot be read.
    pub(super) fn open(path: &Path, drafts: Drafts) -> Result<Self, String> {
        let file = File::Same(file_stamp(path));
        let saved = Folder::read(path)?;
        let offered = drafts.find(path).filter(|draft| draft.text != saved);
        if offered.is_none() {
            // One of what was saved in the end.
            drafts.forget_draft(path);
        }
        Ok(Self {
            path: path.to_owned(),
            base: hash(saved.as_bytes()),
            saved,
            file,
            drafts,
            drafted: offered.as_ref().map(|_| 0),
            offered,
        })
    }

    /// What the file held when it was last read or written.
    pub(super) fn saved(&self) -> &str {
        &self.saved
    }

    /// Tells it from what the file held at another time.
    pub(super) fn base(&self) -> &str {
        &self.base
    }

    fn hold(&mut self, text: &str) {
        self.saved = text.to_owned();
        self.base = hash(text.as_bytes());
    }

    /// Whether the file is there and holds a text, as far as is known.
    pub(super) fn has_text(&self, text: &str) -> bool {
        self.saved == text && self.file != File::Gone
    }

    /// Whether nothing of a version would be lost.
    pub(super) fn is_safe(&self, text: &str, version: u64) -> bool {
        self.saved == text || self.drafted == Some(version)
    }

    /// How it stands with the file, in a word.
    pub(super) fn state_name(&self) -> &'static str {
        match self.file {
            File::Same(_) => "same",
            File::Changed(_) => "changed",
            File::Gone => "gone",
        }
    }

    /// Whether a draft waits for a decision.
    pub(super) fn is_asking(&self) -> bool {
        self.offered.is_some()
    }

    /// The draft that waits for a decision, as windows are told of it.
    pub(super) fn waiting_draft(&self) -> Option<Value> {
        let draft = self.offered.as_ref()?;
        Some(json!({ "time": draft.time, "other_base": draft.is_of_another(&self.saved) }))
    }

    /// Whether no link has come in the way of the file since it was opened.
    fn is_itself(&self) -> Result<(), String> {
        let folder = self.path.parent();
        let folder_is = folder.is_some_and(|own| own.canonicalize().is_ok_and(|real| real == own));
        let file_is = match self.path.symlink_metadata() {
            Ok(known) => known.is_file(),
            // It is gone, and may be made anew.
            Err(_) => true,
        };
        match folder_is && file_is {
            true => Ok(()),
            false => Err("the file leads out of its folder now".to_owned()),
        }
    }

    /// Looks at the file: whether others have changed it.
    pub(super) fn check_for_changes(&mut self, text: &str) {
        let now = file_stamp(&self.path);
        let was = match self.file {
            File::Same(was) | File::Changed(was) => was,
            File::Gone => None,
        };
        if now == was && now.is_some() {
            return;
        }
        let found = self.is_itself().and_then(|()| Folder::read(&self.path));
        self.file = match (now, found) {
            (None, _) => File::Gone,
            (_, Ok(found)) if found == self.saved => File::Same(now),
            (_, Ok(found)) if found == text => {
                self.hold(&found);
                File::Same(now)
            }
            _ => File::Changed(now),
        };
    }

    /// Writes a text to the file, unless others have changed that.
    ///
    /// # Errors
    /// They have, or it cannot be written.
    pub(super) fn save(&mut self, text: &str) -> Result<(), String> {
        // The last look before it is written over.
        self.check_for_changes(text);
        if let File::Changed(_) = self.file {
            return Err("the file was changed by another program; decide first".to_owned());
        }
        self.is_itself()?;
        let written = atomic::write(&self.path, text.as_bytes(), false);
        written.map_err(|error| format!("the file cannot be written: {}", error.kind()))?;
        self.hold(text);
        self.file = File::Same(file_stamp(&self.path));
        self.drafts.forget_draft(&self.path);
        self.drafted = None;
        Ok(())
    }

    /// The file was changed by others, and that is known now: what it holds.
    ///
    /// # Errors
    /// It cannot be read, or, where it is to be taken, not be kept as a text.
    pub(super) fn decide_on_change(&mut self, take: bool) -> Result<String, String> {
        let stamp = file_stamp(&self.path);
        self.is_itself()?;
        let found = Folder::read(&self.path)?;
        if take && found.replace("\r\n", "").contains('\r') {
            return Err("lines of the file end with CR alone, which cannot be kept".to_owned());
        }
        self.hold(&found);
        self.file = File::Same(stamp);
        Ok(found)
    }

    /// The draft that was offered is decided on: its text, where it is taken. `None`: there
    /// was none.
    pub(super) fn decide_on_draft(&mut self, take: bool) -> Option<Option<String>> {
        let draft = self.offered.take()?;
        if take {
            return Some(Some(draft.text));
        }
        self.drafts.forget_draft(&self.path);
        self.drafted = None;
        Some(None)
    }

    /// Keeps what is not saved as a draft, and forgets the draft of what is; what is still to
    /// be written.
    pub(super) fn save_as_draft(
        &mut self,
        text: &str,
        version: u64,
    ) -> Option<impl FnOnce() + Send + use<>> {
        if self.offered.is_some() {
            return None;
        }
        if self.saved == text {
            if self.drafted.take().is_some() {
                self.drafts.forget_draft(&self.path);
            }
            return None;
        }
        if self.drafted == Some(version) {
            return None;
        }
        self.drafted = Some(version);
        let (drafts, path) = (self.drafts.clone(), self.path.clone());
        let (saved, text) = (self.saved.clone(), text.to_owned());
        Some(move || {
            // Where drafts cannot be kept, the next second tries again.
            let _ = drafts.write_draft(&path, &saved, &text);
        })
    }
}
