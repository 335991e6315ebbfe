//! A folder of catalogue files: with [`crate::Scene::read`], all that the library reads
//! from disk.

use super::Catalogue;
use std::borrow::Cow;
use std::fs;
use std::io::Read;
use std::path::{Path, PathBuf};

/// Largest scene that is read at all: more than the library accepts, so that
/// its own message about size is the one that is seen.
const LARGEST: u64 = 64 << 20;

/// Reads a file, or anything else, up to a size that no scene has.
///
/// # Errors
/// Those of the reading.
pub fn read_bounded(from: impl Read) -> std::io::Result<Vec<u8>> {
    let mut bytes = Vec::new();
    from.take(LARGEST).read_to_end(&mut bytes)?;
    Ok(bytes)
}

/// A folder of catalogue files: the `objects` beside a scene.
#[derive(Clone, Debug)]
pub struct Folder {
    path: PathBuf,
}

impl Folder {
    /// A folder, which need not exist.
    pub fn new(path: impl Into<PathBuf>) -> Self {
        Self { path: path.into() }
    }

    /// The folder `objects` beside a scene's file.
    pub fn beside(scene: &Path) -> Self {
        Self::new(scene.parent().unwrap_or(Path::new(".")).join("objects"))
    }

    /// A file or folder below this one, links followed; `None` where links lead out.
    fn within(&self, path: &Path) -> Option<PathBuf> {
        let root = self.path.canonicalize().ok()?;
        let real = path.canonicalize().ok()?;
        real.starts_with(root).then_some(real)
    }

    /// True for a plain file below this folder: reading a pipe might never end.
    fn is_file(&self, path: &Path) -> bool {
        let real = self.within(path);
        real.is_some_and(|real| real.is_file())
    }

    /// Names of the JSON files below a folder, a few levels deep.
    fn collect(&self, folder: &Path, prefix: &str, depth: usize, names: &mut Vec<String>) {
        let Ok(entries) = fs::read_dir(folder) else {
            return;
        };
        for entry in entries.flatten() {
            let path = entry.path();
            let Some(stem) = path.file_stem().and_then(|stem| stem.to_str()) else {
                continue;
            };
            let is_json = path.extension().is_some_and(|found| found == "json");
            if path.is_dir() {
                if depth < 3 && self.within(&path).is_some() {
                    self.collect(&path, &format!("{prefix}{stem}/"), depth + 1, names);
                }
            } else if is_json && self.is_file(&path) {
                names.push(format!("{prefix}{stem}"));
            }
        }
    }
}

impl Catalogue for Folder {
    fn lookup(&self, name: &str) -> Option<(String, Cow<'_, str>)> {
        // Only plain names below the folder: no `..`, no absolute paths.
        let plain = |part: &str| !part.is_empty() && !part.starts_with('.') && !part.contains('\\');
        if !name.split('/').all(plain) {
            return None;
        }
        let file = self.path.join(format!("{name}.json"));
        if !self.is_file(&file) {
            return None;
        }
        let bytes = fs::File::open(&file).and_then(read_bounded).ok()?;
        let text = String::from_utf8(bytes).ok()?;
        Some((file.display().to_string(), Cow::Owned(text)))
    }

    fn names(&self) -> Vec<String> {
        let mut names = Vec::new();
        self.collect(&self.path, "", 0, &mut names);
        names.sort();
        names
    }
}
