//! The folder of result files.
//!
//! Files are written beside their place and moved into it, so that a reader
//! never meets half a file. `provenance.json` lists what dam wrote with its
//! hash: such files of the same scene are replaced freely, anything else only
//! with `--force`. While files are being replaced it lists the old hashes too, so
//! that a program that is killed in between finds its own files again; what it
//! left half written beside its place is cleared away before the next run.

use super::args::OutArgs;
use super::console;
use serde::{Deserialize, Serialize};
use sha2::{Digest, Sha256};
use std::collections::BTreeMap;
use std::fs;
use std::io::{self, Write};
use std::path::{Path, PathBuf};

const PROVENANCE: &str = "provenance.json";

/// A folder that has been checked before the run and receives the results after it.
#[derive(Debug)]
pub(crate) struct OutputFolder {
    folder: PathBuf,
    scene: String,
}

/// What dam wrote into a folder.
#[derive(Debug, Default, Deserialize, Serialize)]
struct Provenance {
    dam: String,
    scene: String,
    hash: String,
    command: String,
    files: BTreeMap<String, String>,
    /// What dam wrote there before, until all files are replaced.
    #[serde(default, skip_serializing_if = "BTreeMap::is_empty")]
    before: BTreeMap<String, Vec<String>>,
}

impl Provenance {
    /// True when dam wrote this content under this name.
    fn holds(&self, name: &str, digest: &String) -> bool {
        let before = self.before.get(name);
        self.files.get(name) == Some(digest) || before.is_some_and(|all| all.contains(digest))
    }

    /// Everything that dam is known to have written.
    fn all(self) -> BTreeMap<String, Vec<String>> {
        let mut all = self.before;
        for (name, digest) in self.files {
            all.entry(name).or_default().push(digest);
        }
        all
    }
}

/// One result file.
#[derive(Debug)]
pub(crate) struct ResultFile {
    /// Name within the folder.
    pub(crate) name: String,
    /// Its content.
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

impl OutputFolder {
    /// The folder that is asked for, if any, ready for the files `names`.
    pub(crate) fn asked(
        args: &OutArgs,
        scene: &str,
        names: &[&str],
    ) -> Result<Option<Self>, String> {
        let prepare = |folder| Self::prepare(folder, scene, names, args.force);
        args.out.as_deref().map(prepare).transpose()
    }

    /// Says where the report is.
    pub(crate) fn tell_report(&self) {
        console::talk(&format!("report: {}", self.path("report.html").display()));
    }

    /// Makes the folder and makes sure, before the run, that `names` can be
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
        try_writing(folder).map_err(|error| format!("cannot write into `{shown}`: {error}"))?;
        if !force {
            let known = read_provenance(folder);
            let foreign: Vec<&str> = names
                .iter()
                .copied()
                .chain([PROVENANCE])
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
        clear_left_parts(folder, names);
        Ok(Self {
            folder: folder.to_owned(),
            scene: scene.to_owned(),
        })
    }

    /// Writes all files, the provenance before and after them.
    pub(crate) fn write(
        &self,
        command: &str,
        hash: &str,
        files: &[ResultFile],
    ) -> Result<(), String> {
        let own = |known: &Provenance| known.scene == self.scene;
        let known = read_provenance(&self.folder).filter(own);
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
        for file in files {
            self.replace(&file.name, &file.content)?;
        }
        provenance.before.clear();
        self.sign(&provenance)
    }

    fn sign(&self, provenance: &Provenance) -> Result<(), String> {
        let mut text = serde_json::to_string_pretty(provenance).map_err(|e| e.to_string())?;
        text.push('\n');
        self.replace(PROVENANCE, text.as_bytes())
    }

    /// Where a file lies, for messages.
    pub(crate) fn path(&self, name: &str) -> PathBuf {
        self.folder.join(name)
    }

    fn replace(&self, name: &str, content: &[u8]) -> Result<(), String> {
        let target = self.path(name);
        let beside = self.folder.join(part_name(name, std::process::id()));
        let written = fs::File::create(&beside)
            .and_then(|mut file| file.write_all(content).and_then(|()| file.sync_all()))
            .and_then(|()| fs::rename(&beside, &target));
        written.map_err(|error| {
            // Best effort: the error that matters is the one being reported.
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

/// What a file is called while the process `id` writes it.
fn part_name(name: &str, id: u32) -> String {
    format!(".{name}.{id}.part")
}

/// True for the part of one of dam's files of a process that is gone.
fn is_left_part(found: &str, names: &[&str]) -> bool {
    let part = found
        .strip_prefix('.')
        .and_then(|f| f.strip_suffix(".part"));
    let Some((name, id)) = part.and_then(|part| part.rsplit_once('.')) else {
        return false;
    };
    let own = name == PROVENANCE || names.contains(&name);
    let id: Option<u32> = id.parse().ok();
    own && id.is_some_and(|id| found == part_name(name, id) && !is_running(id))
}

/// True when a process may be alive; where that cannot be seen, one is not taken
/// for alive (two programs that write into one folder at one time spoil it anyway).
fn is_running(id: u32) -> bool {
    Path::new("/proc").join(id.to_string()).exists()
}

/// Clears away what a program that was killed left half written: dam's own files
/// by their names, and nothing else. Best effort: what stays is only in the way
/// of the eye.
fn clear_left_parts(folder: &Path, names: &[&str]) {
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

fn read_provenance(folder: &Path) -> Option<Provenance> {
    let text = fs::read_to_string(folder.join(PROVENANCE)).ok()?;
    serde_json::from_str(&text).ok()
}

fn may_replace(folder: &Path, name: &str, known: Option<&Provenance>, scene: &str) -> bool {
    let path = folder.join(name);
    if fs::symlink_metadata(&path).is_err() {
        return true;
    }
    let Some(known) = known.filter(|provenance| provenance.scene == scene) else {
        return false;
    };
    if name == PROVENANCE {
        return true;
    }
    fs::read(&path).is_ok_and(|content| known.holds(name, &digest(&content)))
}

fn digest(content: &[u8]) -> String {
    use std::fmt::Write as _;
    Sha256::digest(content)
        .iter()
        .fold(String::new(), |mut text, byte| {
            let _ = write!(text, "{byte:02x}");
            text
        })
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
    use std::fs;

    fn write(folder: &std::path::Path, scene: &str, force: bool) -> Result<(), String> {
        OutputFolder::prepare(folder, scene, &["summary.json"], force)?.write(
            "run",
            "0",
            &[ResultFile::new("summary.json", scene)],
        )
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
            prepare()?.write("run", "0", &files)
        };
        // The second file cannot be written: the first time nothing lay there,
        // then the first file is new and the second old, then both are older.
        let broken = ["summary.json", "nowhere/report.html"];
        write(broken, "first").unwrap_err();
        write(names, "second").unwrap();
        write(broken, "third").unwrap_err();
        write(broken, "fourth").unwrap_err();
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
    fn a_file_in_the_way_is_refused_before_the_run() {
        let folder = tempfile::tempdir().unwrap();
        let file = folder.path().join("results");
        fs::write(&file, "x").unwrap();
        assert!(write(&file, "one", true).unwrap_err().contains("results"));
    }
}
