//! The folder of result files.
//!
//! The results of a command replace those of the one before as a whole: all files
//! are written beside their places first, then moved into them, and what the last
//! results had and these have not goes. `provenance.json` lists what dam wrote with
//! its hash: such files of the same scene are replaced freely, anything else only
//! with `--force`. While files are being replaced it lists the old hashes too, so
//! that a program that is killed in between finds its own files again; what it
//! left half written beside its place is cleared away before the next run. From
//! before the work until the results are written nobody else writes there.

mod lock;
mod provenance;
#[cfg(test)]
mod tests;

use super::failure::Failure;
use super::{console, interrupt, journal};
use crate::cli::args::scene::OutArgs;
use lock::{Lock, LockError};
use provenance::{Provenance, digest};
use std::collections::BTreeSet;
use std::fs;
use std::io::{self, Write};
use std::path::{Path, PathBuf};

/// A folder that has been checked before the work and receives the results after it.
#[derive(Debug)]
pub(crate) struct OutputFolder {
    folder: PathBuf,
    scene: String,
    /// Held as long as the folder is.
    _lock: Lock,
}

/// A result file.
#[derive(Debug)]
pub(crate) struct ResultFile {
    /// Name within the folder.
    pub(crate) name: String,
    /// Content of the file.
    pub(crate) content: Vec<u8>,
}

impl ResultFile {
    /// A result file.
    pub(crate) fn new(name: impl Into<String>, content: impl Into<Vec<u8>>) -> Self {
        Self {
            name: name.into(),
            content: content.into(),
        }
    }
}

/// Writes results into their folder, if one was asked for, and shows the answer: it
/// is shown even where the folder cannot take it.
pub(crate) fn deliver(
    folder: Option<&OutputFolder>,
    command: &str,
    hash: &str,
    files: impl FnOnce() -> Result<Vec<ResultFile>, Failure>,
    show: impl FnOnce() -> Result<(), Failure>,
) -> Result<(), Failure> {
    let written = match folder {
        Some(folder) => files().and_then(|files| folder.write(command, hash, &files)),
        None => Ok(()),
    };
    written.and(show())
}

impl OutputFolder {
    /// The folder that is asked for, if any, ready for the files `names`.
    pub(crate) fn from_args(
        args: &OutArgs,
        scene: &str,
        names: &[&str],
    ) -> Result<Option<Self>, String> {
        let prepare = |folder: &Path| {
            if !args.force && folder.join(journal::NAME).exists() {
                return Err(format!(
                    "`{}` holds the finished rows of an interrupted map; go on with it by `dam \
                     map --resume`, choose another folder, or replace with --force",
                    folder.display()
                ));
            }
            Self::prepare(folder, scene, names, args.force)
        };
        args.out.as_deref().map(prepare).transpose()
    }

    /// Says where the report is.
    pub(crate) fn print_report_path(&self) {
        console::print_message(&format!("report: {}", self.path("report.html").display()));
    }

    /// Makes the folder, takes it, and makes sure, before the work, that `names` can be
    /// written there without losing anybody's work.
    pub(crate) fn prepare(
        folder: &Path,
        scene: &str,
        names: &[&str],
        force: bool,
    ) -> Result<Self, String> {
        let shown = folder.display();
        fs::create_dir_all(folder)
            .map_err(|error| format!("cannot make the output folder `{shown}`: {error}"))?;
        let lock = Lock::lock_folder(folder).map_err(|refused| match refused {
            LockError::Taken => format!(
                "another dam is at work for the folder `{shown}`; wait for it, or choose another \
                 folder"
            ),
            LockError::System(error) => format!("cannot open the output folder `{shown}`: {error}"),
        })?;
        let _keeping = interrupt::hold_interrupt();
        try_writing(folder).map_err(|error| format!("cannot write into `{shown}`: {error}"))?;
        let known = Provenance::of(folder);
        // The results that lie there go as a whole, whatever command wrote them.
        let mut all: BTreeSet<&str> = names.iter().copied().chain([provenance::NAME]).collect();
        all.extend(known.iter().flat_map(Provenance::names));
        if !force {
            let foreign: Vec<&str> = all
                .iter()
                .copied()
                .filter(|name| !may_replace(folder, name, known.as_ref(), scene))
                .collect();
            if !foreign.is_empty() {
                return Err(format!(
                    "`{shown}` already holds {} that dam did not write for the scene “{scene}” \
                     or that changed since; choose another folder, or replace with --force",
                    list(&foreign)
                ));
            }
        }
        clear_left_parts(folder, &all);
        Ok(Self {
            folder: folder.to_owned(),
            scene: scene.to_owned(),
            _lock: lock,
        })
    }

    /// Puts all files in the place of what dam wrote there before, the provenance
    /// before and after them.
    pub(crate) fn write(
        &self,
        command: &str,
        hash: &str,
        files: &[ResultFile],
    ) -> Result<(), Failure> {
        let _keeping = interrupt::hold_interrupt();
        self.replace_all(command, hash, files)
            .map_err(Failure::Output)
    }

    fn replace_all(&self, command: &str, hash: &str, files: &[ResultFile]) -> Result<(), String> {
        let signed_before = fs::read(self.path(provenance::NAME)).ok();
        let known = Provenance::of(&self.folder);
        let gone = self.stale_files(known.as_ref(), files);
        let digests = files.iter().map(|f| (f.name.clone(), digest(&f.content)));
        let mut provenance = Provenance {
            dam: env!("CARGO_PKG_VERSION").to_owned(),
            scene: self.scene.clone(),
            hash: hash.to_owned(),
            command: command.to_owned(),
            files: digests.collect(),
            before: known.map(Provenance::all_written_files).unwrap_or_default(),
        };
        self.write_provenance(&provenance)?;
        if let Err(error) = self.write_parts(files) {
            // Nothing has been replaced: what lay there is whole. Best effort, the
            // error that matters is the one being reported.
            let _ = match signed_before {
                Some(content) => self.replace(provenance::NAME, &content),
                None => fs::remove_file(self.path(provenance::NAME)).map_err(|e| e.to_string()),
            };
            return Err(error);
        }
        for (done, file) in files.iter().enumerate() {
            let target = self.path(&file.name);
            fs::rename(self.partial_file_path(&file.name), &target).map_err(|error| {
                self.remove_parts(&files[done..]);
                format!("cannot write `{}`: {error}", target.display())
            })?;
        }
        for name in gone {
            let path = self.path(&name);
            fs::remove_file(&path)
                .map_err(|error| format!("cannot remove `{}`: {error}", path.display()))?;
        }
        provenance.before.clear();
        self.write_provenance(&provenance)
    }

    /// What dam wrote there before under other names than these, as it wrote it, and
    /// the journal of a map: its own that is complete, or one that is given up.
    fn stale_files(&self, known: Option<&Provenance>, files: &[ResultFile]) -> Vec<String> {
        let stays = |name: &str| files.iter().any(|file| file.name == name);
        let names: BTreeSet<&str> = known.iter().flat_map(|known| known.names()).collect();
        let old = |name: &&str| {
            !stays(name) && known.is_some_and(|known| known.is_unchanged(&self.folder, name))
        };
        let journal = self.path(journal::NAME).exists();
        let journal = journal.then_some(journal::NAME);
        let gone = names.into_iter().filter(old).chain(journal);
        gone.map(str::to_owned).collect()
    }

    fn write_provenance(&self, provenance: &Provenance) -> Result<(), String> {
        let mut text = serde_json::to_string_pretty(provenance).map_err(|e| e.to_string())?;
        text.push('\n');
        self.replace(provenance::NAME, text.as_bytes())
    }

    /// Path of a file, for messages.
    pub(crate) fn path(&self, name: &str) -> PathBuf {
        self.folder.join(name)
    }

    /// Path of a file until it is whole.
    fn partial_file_path(&self, name: &str) -> PathBuf {
        self.folder.join(part_name(name, std::process::id()))
    }

    /// Writes all files beside their places, or none.
    fn write_parts(&self, files: &[ResultFile]) -> Result<(), String> {
        for (done, file) in files.iter().enumerate() {
            self.write_part(&file.name, &file.content)
                .inspect_err(|_| self.remove_parts(&files[..done]))?;
        }
        Ok(())
    }

    fn write_part(&self, name: &str, content: &[u8]) -> Result<(), String> {
        let beside = self.partial_file_path(name);
        let written = fs::File::create(&beside)
            .and_then(|mut file| file.write_all(content).and_then(|()| file.sync_all()));
        written.map_err(|error| {
            let _ = fs::remove_file(&beside);
            format!("cannot write `{}`: {error}", self.path(name).display())
        })
    }

    fn remove_parts(&self, files: &[ResultFile]) {
        for file in files {
            let _ = fs::remove_file(self.partial_file_path(&file.name));
        }
    }

    fn replace(&self, name: &str, content: &[u8]) -> Result<(), String> {
        self.write_part(name, content)?;
        let (beside, target) = (self.partial_file_path(name), self.path(name));
        fs::rename(&beside, &target).map_err(|error| {
            let _ = fs::remove_file(&beside);
            format!("cannot write `{}`: {error}", target.display())
        })
    }
}

fn try_writing(folder: &Path) -> io::Result<()> {
    let probe = folder.join(format!(".dam.{}.probe", std::process::id()));
    fs::File::create(&probe)?;
    fs::remove_file(&probe)
}

/// Name of a file while the process `id` writes it.
fn part_name(name: &str, id: u32) -> String {
    format!(".{name}.{id}.part")
}

/// True for the part of one of dam's files. The folder is taken: whoever wrote it is
/// gone.
fn is_left_part(found: &str, names: &BTreeSet<&str>) -> bool {
    let part = found
        .strip_prefix('.')
        .and_then(|f| f.strip_suffix(".part"));
    let Some((name, id)) = part.and_then(|part| part.rsplit_once('.')) else {
        return false;
    };
    let id: Option<u32> = id.parse().ok();
    names.contains(name) && id.is_some_and(|id| found == part_name(name, id))
}

/// Clears away what a program that was killed left half written: dam's own files
/// by their names, and nothing else. Best effort: what stays is only in the way
/// of the eye.
fn clear_left_parts(folder: &Path, names: &BTreeSet<&str>) {
    let entries = fs::read_dir(folder).into_iter().flatten().flatten();
    for entry in entries {
        let left = entry
            .file_name()
            .to_str()
            .is_some_and(|f| is_left_part(f, names));
        if left && entry.file_type().is_ok_and(|kind| kind.is_file()) {
            let _ = fs::remove_file(entry.path());
        }
    }
}

fn may_replace(folder: &Path, name: &str, known: Option<&Provenance>, scene: &str) -> bool {
    if fs::symlink_metadata(folder.join(name)).is_err() {
        return true;
    }
    let Some(known) = known.filter(|provenance| provenance.scene == scene) else {
        return false;
    };
    name == provenance::NAME || known.is_unchanged(folder, name)
}

fn list(names: &[&str]) -> String {
    names
        .iter()
        .map(|name| format!("`{name}`"))
        .collect::<Vec<_>>()
        .join(", ")
}
