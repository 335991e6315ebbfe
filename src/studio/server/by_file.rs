//! What is kept of scenes in the user's state folder: one record for every file, written as a
//! whole, for nobody but the user.

use super::atomic;
use super::token::hash;
use serde::de::DeserializeOwned;
use serde::{Deserialize, Serialize};
use std::fs;
use std::path::{Path, PathBuf};

/// A folder of records; where there is none, nothing is kept.
#[derive(Clone, Debug)]
pub(super) struct ByFile {
    folder: Option<PathBuf>,
}

/// A record as it stands in its file.
#[derive(Debug, Serialize, Deserialize)]
pub(super) struct Record<T> {
    /// The scene's file, links resolved.
    pub(super) path: PathBuf,
    /// What is kept of it.
    #[serde(flatten)]
    pub(super) content: T,
}

impl ByFile {
    /// The user's folder of a name.
    pub(super) fn of_user(name: &str) -> Self {
        Self {
            folder: state_folder().map(|folder| folder.join(name)),
        }
    }

    /// Any folder.
    #[cfg(test)]
    pub(super) fn in_folder(folder: &Path) -> Self {
        Self {
            folder: Some(folder.to_owned()),
        }
    }

    /// Where the record of a file stands.
    pub(super) fn record_path(&self, path: &Path) -> Option<PathBuf> {
        let key = hash(path.to_string_lossy().as_bytes());
        Some(self.folder.as_ref()?.join(format!("{key}.json")))
    }

    /// Keeps a record in place of the one before.
    ///
    /// # Errors
    /// There is no folder, or it cannot be written.
    pub(super) fn write_record<T: Serialize>(&self, path: &Path, content: T) -> Result<(), String> {
        let place = self
            .record_path(path)
            .ok_or("there is no folder to keep it in")?;
        let path = path.to_owned();
        let bytes = serde_json::to_vec(&Record { path, content });
        let bytes = bytes.map_err(|error| error.to_string())?;
        atomic::private_folder(place.parent().unwrap_or(Path::new(".")))
            .and_then(|()| atomic::write(&place, &bytes, true))
            .map_err(|error| error.kind().to_string())
    }

    /// The record of a file; what cannot be read is none.
    pub(super) fn find<T: DeserializeOwned>(&self, path: &Path) -> Option<T> {
        let record: Record<T> = read(&self.record_path(path)?)?;
        (record.path == path).then_some(record.content)
    }

    /// Forgets the record of a file.
    pub(super) fn forget_record(&self, path: &Path) {
        if let Some(place) = self.record_path(path) {
            // There may be none.
            let _ = fs::remove_file(place);
        }
    }

    /// All records, with their places.
    pub(super) fn all_records<T: DeserializeOwned>(&self) -> Vec<(PathBuf, Record<T>)> {
        let folder = self.folder.as_ref();
        let entries = folder.and_then(|folder| fs::read_dir(folder).ok());
        let places = entries.into_iter().flatten().flatten();
        let places = places.map(|entry| entry.path()).filter(|place| {
            let extension = place.extension();
            extension.is_some_and(|extension| extension == "json")
        });
        places
            .filter_map(|place| Some((place.clone(), read(&place)?)))
            .collect()
    }
}

fn read<T: DeserializeOwned>(place: &Path) -> Option<Record<T>> {
    serde_json::from_slice(&fs::read(place).ok()?).ok()
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

#[cfg(test)]
mod tests {
    use super::ByFile;
    use std::path::Path;

    #[test]
    fn records_are_kept_by_file_and_for_the_user_alone() {
        let folder = tempfile::tempdir().unwrap();
        let kept = ByFile::in_folder(&folder.path().join("kept"));
        let (one, other) = (Path::new("/a/one.json"), Path::new("/a/other.json"));
        let found = |path| kept.find::<std::collections::BTreeMap<String, u64>>(path);
        let record = |number: u64| std::collections::BTreeMap::from([("number", number)]);
        assert_eq!(found(one), None);
        kept.write_record(one, record(1)).unwrap();
        kept.write_record(one, record(2)).unwrap();
        kept.write_record(other, record(3)).unwrap();
        assert_eq!(found(one).unwrap()["number"], 2);
        #[cfg(unix)]
        {
            use std::os::unix::fs::PermissionsExt;
            let mode = |path: &Path| path.metadata().unwrap().permissions().mode() & 0o777;
            assert_eq!(mode(&folder.path().join("kept")), 0o700);
            assert_eq!(mode(&kept.record_path(one).unwrap()), 0o600);
        }
        // What lies in the place of another file is not taken for its record.
        std::fs::copy(
            kept.record_path(other).unwrap(),
            kept.record_path(one).unwrap(),
        )
        .unwrap();
        assert_eq!(found(one), None);
        kept.forget_record(one);
        assert_eq!(found(other).unwrap()["number"], 3);
    }
}
