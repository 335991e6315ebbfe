//! From a scene's file to a system.

use super::args::SceneArgs;
use super::failure::Failure;
use dam::analysis::RunSettings;
use dam::analysis::expectations::unknown_figures;
use dam::analysis::{plausible, studied};
use dam::diagnostics::Diagnostics;
use dam::lower::lower;
use dam::scene::{BuiltIn, Catalogue, Document, Layered, Overrides, Reading, Scene};
use dam::system::System;
use std::borrow::Cow;
use std::fs;
use std::io::Read;
use std::path::{Path, PathBuf};

/// A scene's text with everything that its decoding needs.
#[derive(Debug)]
pub(crate) struct Input {
    document: Document,
    folder: Folder,
    overrides: Overrides,
}

/// A scene made ready to run.
#[derive(Debug)]
pub(crate) struct Ready {
    /// The scene.
    pub(crate) reading: Reading,
    /// Its system.
    pub(crate) system: System,
    /// How to run it.
    pub(crate) settings: RunSettings,
}

impl Ready {
    /// The scene.
    pub(crate) fn scene(&self) -> &Scene {
        &self.reading.scene
    }
}

impl Input {
    /// Reads and parses the scene: a file, or standard input for `-`.
    pub(crate) fn load(args: &SceneArgs) -> Result<Self, Failure> {
        let (shown, read) = match args.scene.as_os_str() == STANDARD_INPUT {
            true => (
                "standard input".to_owned(),
                read_bounded(std::io::stdin().lock()),
            ),
            false => (
                args.scene.display().to_string(),
                fs::File::open(&args.scene).and_then(read_bounded),
            ),
        };
        let bytes = read.map_err(|error| format!("cannot read the scene `{shown}`: {error}"))?;
        let beside = args.scene.parent().unwrap_or(Path::new("."));
        Ok(Self {
            document: Document::parse(&shown, &bytes)?,
            folder: Folder {
                path: beside.join("objects"),
            },
            overrides: Overrides::new(args.set.clone()),
        })
    }

    /// The scene's text.
    pub(crate) fn text(&self) -> &str {
        self.document.text()
    }

    /// The scene's text as a tree.
    pub(crate) fn document(&self) -> &Document {
        &self.document
    }

    /// Where `from` looks: the folder beside the scene, then what is built in.
    pub(crate) fn catalogue(&self) -> Layered<'_, dyn Catalogue + Sync, dyn Catalogue + Sync> {
        Layered(&self.folder, &BuiltIn)
    }

    /// Decodes the scene with further overrides.
    pub(crate) fn decode(&self, further: &[String]) -> Result<Reading, Diagnostics> {
        let mut all = self.overrides.arguments().to_vec();
        all.extend_from_slice(further);
        self.document.scene(&self.catalogue(), &Overrides::new(all))
    }

    /// Decodes the scene and builds its system; every fault of one stage at once.
    pub(crate) fn prepare(&self, further: &[String]) -> Result<Ready, Failure> {
        let reading = self.decode(further)?;
        let diagnose = |faults: Vec<dam::fault::Fault>| reading.places.diagnose(&faults);
        let mut model = lower(&reading.scene).map_err(diagnose)?;
        let expect = &reading.scene.expect;
        let mut faults = unknown_figures(expect, &model);
        faults.extend(studied::unknown_figures(expect, &model));
        if !faults.is_empty() {
            return Err(diagnose(faults).into());
        }
        let settings = RunSettings::of(&reading.scene).map_err(|fault| diagnose(vec![fault]))?;
        let unlikely = plausible::warnings(&model, settings.duration);
        model.warnings.extend(unlikely);
        let system = System::new(model).map_err(diagnose)?;
        Ok(Ready {
            system,
            settings,
            reading,
        })
    }
}

/// Largest scene that is read at all: more than the library accepts, so that
/// its own message about size is the one that is seen.
const LARGEST: u64 = 64 << 20;

/// Stands for standard input in place of a file.
const STANDARD_INPUT: &str = "-";

fn read_bounded(from: impl Read) -> std::io::Result<Vec<u8>> {
    let mut bytes = Vec::new();
    from.take(LARGEST).read_to_end(&mut bytes)?;
    Ok(bytes)
}

/// The `objects` folder beside a scene.
#[derive(Debug)]
struct Folder {
    path: PathBuf,
}

impl Folder {
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
