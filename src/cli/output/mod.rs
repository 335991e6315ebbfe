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

use super::failure::Failure;
use super::{console, interrupt, journal};
use crate::cli::args::scene::OutArgs;
use lock::{Lock, Refused};
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
    pub(crate) fn asked(
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
    pub(crate) fn tell_report(&self) {
        console::talk(&format!("report: {}", self.path("report.html").display()));
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
        let lock = Lock::take(folder).map_err(|refused| match refused {
            Refused::Taken => format!(
                "another dam is at work for the folder `{shown}`; wait for it, or choose another \
                 folder"
            ),
            Refused::System(error) => format!("cannot open the output folder `{shown}`: {error}"),
        })?;
        let _keeping = interrupt::keep();
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
        let _keeping = interrupt::keep();
        self.replace_all(command, hash, files)
            .map_err(Failure::Output)
    }

    fn replace_all(&self, command: &str, hash: &str, files: &[ResultFile]) -> Result<(), String> {
        let signed_before = fs::read(self.path(provenance::NAME)).ok();
        let known = Provenance::of(&self.folder);
        let gone = self.no_longer_there(known.as_ref(), files);
        let digests = files.iter().map(|f| (f.name.clone(), digest(&f.content)));
        let mut provenance = Provenance {
            dam: env!("CARGO_PKG_VERSION").to_owned(),
            scene: self.scene.clone(),
            hash: hash.to_owned(),
            command: command.to_owned(),
            files: digests.collect(),
            before: known.map(Provenance::all).unwrap_or_default(),
        };
        self.sign(&provenance)?;
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
            fs::rename(self.part(&file.name), &target).map_err(|error| {
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
        self.sign(&provenance)
    }

    /// What dam wrote there before under other names than these, as it wrote it, and
    /// the journal of a map: its own that is complete, or one that is given up.
    fn no_longer_there(&self, known: Option<&Provenance>, files: &[ResultFile]) -> Vec<String> {
        let stays = |name: &str| files.iter().any(|file| file.name == name);
        let names: BTreeSet<&str> = known.iter().flat_map(|known| known.names()).collect();
        let old = |name: &&str| {
            !stays(name) && known.is_some_and(|known| known.holds(&self.folder, name))
        };
        let journal = self.path(journal::NAME).exists();
        let journal = journal.then_some(journal::NAME);
        let gone = names.into_iter().filter(old).chain(journal);
        gone.map(str::to_owned).collect()
    }

    fn sign(&self, provenance: &Provenance) -> Result<(), String> {
        let mut text = serde_json::to_string_pretty(provenance).map_err(|e| e.to_string())?;
        text.push('\n');
        self.replace(provenance::NAME, text.as_bytes())
    }

    /// Path of a file, for messages.
    pub(crate) fn path(&self, name: &str) -> PathBuf {
        self.folder.join(name)
    }

    /// Path of a file until it is whole.
    fn part(&self, name: &str) -> PathBuf {
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
        let beside = self.part(name);
        let written = fs::File::create(&beside)
            .and_then(|mut file| file.write_all(content).and_then(|()| file.sync_all()));
        written.map_err(|error| {
            let _ = fs::remove_file(&beside);
            format!("cannot write `{}`: {error}", self.path(name).display())
        })
    }

    fn remove_parts(&self, files: &[ResultFile]) {
        for file in files {
            let _ = fs::remove_file(self.part(&file.name));
        }
    }

    fn replace(&self, name: &str, content: &[u8]) -> Result<(), String> {
        self.write_part(name, content)?;
        let (beside, target) = (self.part(name), self.path(name));
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
    name == provenance::NAME || known.holds(folder, name)
}

fn list(names: &[&str]) -> String {
    names
        .iter()
        .map(|name| format!("`{name}`"))
        .collect::<Vec<_>>()
        .join(", ")
}

#[cfg(test)]
mod tests {
    use super::{OutputFolder, ResultFile};
    use crate::cli::failure::Failure;
    use std::fs;

    fn put(folder: &OutputFolder, files: &[ResultFile]) -> Result<(), String> {
        folder
            .write("run", "0", files)
            .map_err(|failure| match failure {
                Failure::Output(message) => message,
                other => panic!("{other:?}"),
            })
    }

    fn write(folder: &std::path::Path, scene: &str, force: bool) -> Result<(), String> {
        let folder = OutputFolder::prepare(folder, scene, &["summary.json"], force)?;
        put(&folder, &[ResultFile::new("summary.json", scene)])
    }

    #[test]
    fn replaces_its_own_results_and_nothing_else() {
        let folder = tempfile::tempdir().unwrap();
        let place = folder.path().join("a/b");
        write(&place, "one", false).unwrap();
        write(&place, "one", false).unwrap();
        let message = write(&place, "two", false).unwrap_err();
        assert!(message.contains("summary.json") && message.contains("--force"));
        assert_eq!(
            fs::read_to_string(place.join("summary.json")).unwrap(),
            "one"
        );
        fs::write(place.join("summary.json"), "edited by hand").unwrap();
        assert!(write(&place, "one", false).is_err());
        write(&place, "two", true).unwrap();
        assert_eq!(
            fs::read_to_string(place.join("summary.json")).unwrap(),
            "two"
        );
        let left: Vec<_> = fs::read_dir(&place).unwrap().collect();
        assert_eq!(left.len(), 2, "no part files stay behind");
    }

    #[test]
    fn files_of_a_run_that_ended_while_it_wrote_are_its_own() {
        let folder = tempfile::tempdir().unwrap();
        let names = ["summary.json", "report.html"];
        let prepare = || OutputFolder::prepare(folder.path(), "one", &names, false);
        let write = |names: [&str; 2], content: &str| {
            let files = names.map(|name| ResultFile::new(name, content));
            put(&prepare()?, &files)
        };
        // The second file cannot be written: what lay there stays whole, be it nothing.
        let broken = ["summary.json", "nowhere/report.html"];
        write(broken, "first").unwrap_err();
        assert_eq!(fs::read_dir(folder.path()).unwrap().count(), 0);
        write(names, "second").unwrap();
        for content in ["third", "fourth"] {
            write(broken, content).unwrap_err();
            let found = fs::read_to_string(folder.path().join("summary.json")).unwrap();
            assert_eq!(found, "second");
        }
        // Ended between two files: one is new, the other old.
        let signed = fs::read_to_string(folder.path().join("provenance.json")).unwrap();
        let mut known: serde_json::Value = serde_json::from_str(&signed).unwrap();
        known["before"] = serde_json::json!({
            "summary.json": [known["files"]["summary.json"]],
            "report.html": [known["files"]["report.html"]],
        });
        known["files"]["summary.json"] = super::digest(b"between").into();
        known["files"]["report.html"] = super::digest(b"between").into();
        fs::write(folder.path().join("summary.json"), "between").unwrap();
        fs::write(folder.path().join("provenance.json"), known.to_string()).unwrap();
        write(names, "fifth").unwrap();
        for name in names {
            let found = fs::read_to_string(folder.path().join(name)).unwrap();
            assert_eq!(found, "fifth");
        }
        // Nothing is remembered longer than it may matter.
        let path = folder.path().join("provenance.json");
        assert!(!fs::read_to_string(path).unwrap().contains("before"));
        fs::write(folder.path().join("report.html"), "second").unwrap();
        assert!(prepare().is_err());
    }

    #[test]
    fn parts_that_a_killed_program_left_are_cleared_away_and_nothing_else() {
        let folder = tempfile::tempdir().unwrap();
        // No process has this number: greater than the greatest that Linux gives.
        let left = [
            ".summary.json.4194999.part",
            ".provenance.json.4194999.part",
        ];
        let own = format!(".summary.json.{}.part", std::process::id());
        let foreign = [
            ".notes.txt.4194999.part",
            ".summary.json.part",
            ".summary.json.x7.part",
            ".summary.json.04194999.part",
            "summary.json.4194999.part",
        ];
        for name in left.iter().chain(&foreign).chain([&own.as_str()]) {
            fs::write(folder.path().join(name), "half").unwrap();
        }
        write(folder.path(), "one", false).unwrap();
        assert!(left.iter().all(|name| !folder.path().join(name).exists()));
        assert!(foreign.iter().all(|name| folder.path().join(name).exists()));
    }

    #[test]
    fn results_are_replaced_as_a_whole() {
        let folder = tempfile::tempdir().unwrap();
        let write = |names: &[&str], force| {
            let out = OutputFolder::prepare(folder.path(), "one", names, force)?;
            let files = names.iter().map(|name| ResultFile::new(*name, *name));
            put(&out, &files.collect::<Vec<_>>())
        };
        let there = || {
            let entries = fs::read_dir(folder.path()).unwrap();
            let names = entries.map(|entry| entry.unwrap().file_name().into_string().unwrap());
            let mut names: Vec<String> = names.collect();
            names.sort();
            names
        };
        write(&["record.csv", "report.html"], false).unwrap();
        fs::write(folder.path().join("notes.txt"), "mine").unwrap();
        write(&["methods.csv", "report.html"], false).unwrap();
        let second = ["methods.csv", "notes.txt", "provenance.json", "report.html"];
        assert_eq!(there(), second);
        // What was changed by hand would be lost: refused, and nothing is touched.
        fs::write(folder.path().join("methods.csv"), "mine").unwrap();
        let message = write(&["record.csv", "report.html"], false).unwrap_err();
        assert!(message.contains("methods.csv"), "{message}");
        assert_eq!(there(), second);
        // With --force, too, it stays: no file of these results.
        write(&["record.csv"], true).unwrap();
        let third = ["methods.csv", "notes.txt", "provenance.json", "record.csv"];
        assert_eq!(there(), third);
    }

    #[test]
    fn a_folder_belongs_to_one_at_a_time() {
        let folder = tempfile::tempdir().unwrap();
        let take = || OutputFolder::prepare(folder.path(), "one", &["summary.json"], false);
        let first = take().unwrap();
        assert!(take().unwrap_err().contains("another dam"));
        drop(first);
        take().unwrap();
    }

    #[test]
    fn a_file_in_the_way_is_refused_before_the_run() {
        let folder = tempfile::tempdir().unwrap();
        let file = folder.path().join("results");
        fs::write(&file, "x").unwrap();
        assert!(write(&file, "one", true).unwrap_err().contains("results"));
    }
}
