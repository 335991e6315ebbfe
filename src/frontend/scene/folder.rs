//! The folder of a scene, with its catalogue and its tables: with [`crate::Scene::read`], all
//! that the library reads from disk.

use super::{BuiltIn, Catalogue, NamedBytes};
use crate::frontend::diagnostics::Diagnostic;
use crate::frontend::read::{MOST_BYTES, did_you_mean};
use std::borrow::Cow;
use std::fs;
use std::io::Read;
use std::path::{Component, Path, PathBuf};

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
    /// The folder of the scene, in which its tables are.
    scene: Option<PathBuf>,
}

impl Folder {
    /// A folder, which need not exist.
    pub fn new(path: impl Into<PathBuf>) -> Self {
        Self {
            path: path.into(),
            scene: None,
        }
    }

    /// The folder `objects` beside a scene's file, and the tables beside it.
    pub fn beside_scene(scene: &Path) -> Self {
        let folder = scene.parent().unwrap_or(Path::new(""));
        Self {
            path: folder.join("objects"),
            scene: Some(folder.to_owned()),
        }
    }

    /// A file or folder below this one, links followed; `None` where links lead out.
    fn path_below(&self, path: &Path) -> Option<PathBuf> {
        let root = self.path.canonicalize().ok()?;
        let real = path.canonicalize().ok()?;
        real.starts_with(root).then_some(real)
    }

    /// True for a plain file below this folder: reading a pipe might never end.
    fn is_file(&self, path: &Path) -> bool {
        let real = self.path_below(path);
        real.is_some_and(|real| real.is_file())
    }

    /// Names of the JSON files below a folder, a few levels deep.
    fn collect_json_files(
        &self,
        folder: &Path,
        prefix: &str,
        depth: usize,
        names: &mut Vec<String>,
    ) {
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
                if depth < 3 && self.path_below(&path).is_some() {
                    self.collect_json_files(&path, &format!("{prefix}{stem}/"), depth + 1, names);
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
        self.collect_json_files(&self.path, "", 0, &mut names);
        names.sort();
        names
    }

    fn table(&self, name: &str) -> Result<NamedBytes, Box<Diagnostic>> {
        match &self.scene {
            Some(folder) => table(folder, name),
            None => BuiltIn.table(name),
        }
    }
}

/// Reads a file below the folder of a scene.
fn table(folder: &Path, name: &str) -> Result<NamedBytes, Box<Diagnostic>> {
    let fault = |code, message: String| Box::new(Diagnostic::error(code, message));
    let normal = |part: Component<'_>| matches!(part, Component::Normal(_));
    // (A backslash or a colon would mean something on other systems.)
    let below = Path::new(name).components().all(normal) && !name.contains(['\\', ':', '\0']);
    let outside = || {
        let message = format!("the file `{name}` is not in the folder of the scene");
        let hint = "name a file in this folder or below it: \"lift.csv\", \"tables/lift.csv\"";
        Box::new(fault("outside-folder", message).hint(hint))
    };
    if !below {
        return Err(outside());
    }
    // The folder of `scene.json` has the empty path.
    let root = match folder.as_os_str().is_empty() {
        true => Path::new("."),
        false => folder,
    };
    let shown = folder.join(name);
    let (Ok(root), Ok(real)) = (root.canonicalize(), shown.canonicalize()) else {
        let missing = fault(
            "missing-file",
            format!("there is no file `{name}` in the folder of the scene"),
        );
        return Err(Box::new(missing.maybe_hint(similar_file(folder, name))));
    };
    if !real.starts_with(root) {
        return Err(outside());
    }
    let unread = |error: &dyn std::fmt::Display| {
        fault(
            "missing-file",
            format!("the file `{name}` cannot be read: {error}"),
        )
    };
    // Reading a pipe might never end.
    if !real.is_file() {
        return Err(unread(&"it is no plain file"));
    }
    let mut bytes = Vec::new();
    let read =
        fs::File::open(&real).and_then(|file| file.take(MOST_BYTES + 1).read_to_end(&mut bytes));
    match read {
        Err(error) => Err(unread(&error)),
        Ok(_) if bytes.len() as u64 > MOST_BYTES => {
            let most = MOST_BYTES / 1_000_000;
            let message = format!("the file `{name}` is larger than {most} MB");
            Err(fault("too-large", message))
        }
        Ok(_) => Ok((shown.display().to_string(), bytes)),
    }
}

/// A file of the folder whose name is like one.
fn similar_file(folder: &Path, name: &str) -> Option<String> {
    let folder = Path::new(".").join(folder).join(Path::new(name).parent()?);
    let entries = fs::read_dir(folder).ok()?.flatten().take(1000);
    let names: Vec<String> = entries
        .filter_map(|entry| entry.file_name().into_string().ok())
        .collect();
    let last = Path::new(name).file_name()?.to_str()?;
    did_you_mean(last, names.iter().map(String::as_str))
}
