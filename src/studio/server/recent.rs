//! Which scenes were opened when: kept in the user's state folder, a file for every scene, so
//! that programs that run beside each other forget nothing of each other's.
//!
//! A scene is listed only if it is below the folder and exists.

use super::by_file::{ByFile, Record};
use super::folder::Folder;
use serde::{Deserialize, Serialize};
use std::fs;
use std::path::{Path, PathBuf};
use std::time::{SystemTime, UNIX_EPOCH};

/// Scenes that are remembered in all; of more the oldest are forgotten.
const MOST: usize = 200;
/// Scenes that are told of.
const TOLD: usize = 8;

/// When a scene was opened last.
#[derive(Clone, Debug, PartialEq, Serialize, Deserialize)]
struct Opened {
    /// When (ms since 1970).
    time: u64,
}

/// The folder in which that is kept.
#[derive(Clone, Debug)]
pub(super) struct Recent(ByFile);

impl Recent {
    /// What the user opened.
    pub(super) fn of_user() -> Self {
        Self(ByFile::of_user("recent"))
    }

    /// What is kept in a folder.
    #[cfg(test)]
    pub(super) fn in_folder(folder: &Path) -> Self {
        Self(ByFile::in_folder(folder))
    }

    /// Remembers that a file is opened now. Where nothing can be kept, nothing is.
    pub(super) fn remember(&self, path: &Path) {
        let now = SystemTime::now().duration_since(UNIX_EPOCH);
        let opened = Opened {
            time: now.map_or(0, |now| u64::try_from(now.as_millis()).unwrap_or(u64::MAX)),
        };
        if self.0.write_record(path, opened).is_ok() {
            for (old, _) in self.all_records().into_iter().skip(MOST) {
                // Another program may have been there before.
                let _ = fs::remove_file(old);
            }
        }
    }

    /// Everything that is kept, with its files, the newest first.
    fn all_records(&self) -> Vec<(PathBuf, Record<Opened>)> {
        let mut all = self.0.all_records::<Opened>();
        all.sort_by(|(_, a), (_, b)| {
            let newest = b.content.time.cmp(&a.content.time);
            newest.then_with(|| a.path.cmp(&b.path))
        });
        all
    }

    /// The scenes below a folder that were opened last and are still there, by their names, the
    /// newest first.
    pub(super) fn scenes_below(&self, folder: &Folder) -> Vec<String> {
        let names = self
            .all_records()
            .into_iter()
            .filter_map(|(_, opened)| folder.name_of(&opened.path));
        names.take(TOLD).collect()
    }
}

#[cfg(test)]
mod tests {
    use super::{MOST, Recent, TOLD};
    use crate::studio::server::folder::Folder;
    use std::fs;
    use std::time::Duration;

    #[test]
    fn what_lies_below_and_is_still_there_is_told_newest_first() {
        let base = tempfile::tempdir().unwrap();
        let root = base.path().canonicalize().unwrap();
        let (open, state) = (root.join("open"), root.join("state/recent"));
        fs::create_dir_all(open.join("deep")).unwrap();
        let recent = Recent::in_folder(&state);
        let (folder, _) = Folder::open(Some(&open)).unwrap();
        assert!(recent.scenes_below(&folder).is_empty());
        let files = [
            "open/a.json",
            "open/deep/b.json",
            "other.json",
            "open/gone.json",
            "open/a.json",
        ];
        for name in files {
            fs::write(root.join(name), "{\"dam\": 1}").unwrap();
            recent.remember(&root.join(name));
            std::thread::sleep(Duration::from_millis(3));
        }
        fs::remove_file(open.join("gone.json")).unwrap();
        // What is no record is nothing.
        fs::write(state.join("x.json"), "[").unwrap();
        assert_eq!(recent.scenes_below(&folder), ["a.json", "deep/b.json"]);
        #[cfg(unix)]
        {
            use std::os::unix::fs::{PermissionsExt, symlink};
            // A file in whose place a link has come leads out, and is not told of.
            fs::remove_file(open.join("a.json")).unwrap();
            symlink(root.join("other.json"), open.join("a.json")).unwrap();
            assert_eq!(recent.scenes_below(&folder), ["deep/b.json"]);
            for entry in fs::read_dir(&state).unwrap().flatten() {
                let is_own = entry.file_name() != "x.json";
                let mode = entry.metadata().unwrap().permissions().mode() & 0o777;
                assert!(!is_own || mode == 0o600);
            }
        }
    }

    #[test]
    fn the_oldest_are_forgotten() {
        let base = tempfile::tempdir().unwrap();
        let root = base.path().canonicalize().unwrap();
        let recent = Recent::in_folder(&root.join("recent"));
        let (folder, _) = Folder::open(Some(&root)).unwrap();
        fs::write(root.join("first.json"), "{}").unwrap();
        recent.remember(&root.join("first.json"));
        std::thread::sleep(Duration::from_millis(3));
        for number in 0..MOST {
            fs::write(root.join(format!("{number}.json")), "{}").unwrap();
            recent.remember(&root.join(format!("{number}.json")));
        }
        assert_eq!(recent.all_records().len(), MOST);
        let told = recent.scenes_below(&folder);
        assert!(told.len() == TOLD && !told.contains(&"first.json".to_owned()));
    }
}
