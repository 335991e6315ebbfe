//! What dam wrote into a folder: `provenance.json`.

use serde::{Deserialize, Serialize};
use sha2::{Digest, Sha256};
use std::collections::BTreeMap;
use std::fs;
use std::path::Path;

/// Name in the folder.
pub(super) const NAME: &str = "provenance.json";

/// Provenance: what dam wrote into a folder.
#[derive(Debug, Default, Deserialize, Serialize)]
pub(super) struct Provenance {
    pub(super) dam: String,
    pub(super) scene: String,
    pub(super) hash: String,
    pub(super) command: String,
    pub(super) files: BTreeMap<String, String>,
    /// Files that dam wrote there before, until all files are replaced.
    #[serde(default, skip_serializing_if = "BTreeMap::is_empty")]
    pub(super) before: BTreeMap<String, Vec<String>>,
}

impl Provenance {
    /// Provenance of a folder, if there is one.
    pub(super) fn of(folder: &Path) -> Option<Self> {
        let text = fs::read_to_string(folder.join(NAME)).ok()?;
        serde_json::from_str(&text).ok()
    }

    /// Names of all files that dam is known to have written. Only plain names count:
    /// nothing outside of the folder is dam's.
    pub(super) fn names(&self) -> impl Iterator<Item = &str> {
        let names = self.files.keys().chain(self.before.keys());
        let plain = |name: &&str| !name.contains(['/', '\\']) && *name != "..";
        names.map(String::as_str).filter(plain)
    }

    /// True when what lies in the folder under this name is as dam wrote it.
    pub(super) fn is_unchanged(&self, folder: &Path, name: &str) -> bool {
        let Ok(content) = fs::read(folder.join(name)) else {
            return false;
        };
        let digest = digest(&content);
        let before = self.before.get(name);
        self.files.get(name) == Some(&digest) || before.is_some_and(|all| all.contains(&digest))
    }

    /// Everything that dam is known to have written.
    pub(super) fn all_written_files(self) -> BTreeMap<String, Vec<String>> {
        let mut all = self.before;
        for (name, digest) in self.files {
            all.entry(name).or_default().push(digest);
        }
        all
    }
}

/// SHA-256 in hexadecimal digits.
pub(super) fn digest(content: &[u8]) -> String {
    use std::fmt::Write as _;
    Sha256::digest(content)
        .iter()
        .fold(String::new(), |mut text, byte| {
            let _ = write!(text, "{byte:02x}");
            text
        })
}
