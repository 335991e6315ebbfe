//! The journal of a map in its output folder: rows are on disk as they finish.

use crate::studies::map::{Cell, Study, journal};
use std::collections::BTreeMap;
use std::fs::{File, OpenOptions};
use std::io::{ErrorKind, Read, Seek, SeekFrom, Write};
use std::path::{Path, PathBuf};
use std::sync::Mutex;

/// Name of the journal within the folder. It goes when results are written there.
pub(crate) const NAME: &str = "map.journal";

/// Largest journal, or part of a map, that is read (bytes).
pub(super) const LARGEST: u64 = 4 << 30;

/// An open journal; rows may be added from any thread.
#[derive(Debug)]
pub(crate) struct Journal {
    path: PathBuf,
    file: Mutex<File>,
}

impl Journal {
    /// Opens the journal in `folder`, and returns the rows that are known
    /// already. Without `resume` a journal that lies there is somebody's
    /// unfinished work and stops everything, unless it may be `replace`d.
    pub(crate) fn open_journal(
        folder: &Path,
        study: &Study<'_>,
        resume: bool,
        replace: bool,
    ) -> Result<(Self, BTreeMap<usize, Vec<Cell>>), String> {
        let path = folder.join(NAME);
        let shown = path.display();
        let found = match File::open(&path) {
            Ok(file) => {
                Some(read(file).map_err(|error| format!("cannot read `{shown}`: {error}"))?)
            }
            Err(error) if error.kind() == ErrorKind::NotFound => None,
            Err(error) => return Err(format!("cannot read `{shown}`: {error}")),
        };
        let known = match found {
            Some(bytes) if resume => journal::read(study, &bytes).map_err(|what| {
                format!("cannot go on from `{shown}`: {what}; begin anew with --force")
            })?,
            Some(_) if !replace => {
                return Err(format!(
                    "`{shown}` holds the finished rows of an interrupted map; go on with \
                     --resume, or begin anew with --force"
                ));
            }
            _ => journal::Journal::default(),
        };
        let file = start(&path, study, known.whole)
            .map_err(|error| format!("cannot write `{shown}`: {error}"))?;
        let journal = Self {
            path,
            file: Mutex::new(file),
        };
        Ok((journal, known.rows))
    }

    /// Adds a row: one write, so that a kill leaves at most one torn line.
    pub(crate) fn add(&self, row: usize, cells: &[Cell]) -> Result<(), String> {
        let line = journal::row(row, cells);
        let mut file = (self.file.lock()).map_err(|_| "the journal is broken".to_owned())?;
        file.write_all(line.as_bytes())
            .map_err(|error| format!("cannot write `{}`: {error}", self.path.display()))
    }
}

fn read(file: File) -> std::io::Result<Vec<u8>> {
    let mut bytes = Vec::new();
    file.take(LARGEST).read_to_end(&mut bytes)?;
    Ok(bytes)
}

/// The file, cut behind its last whole line, or with a first line of its own.
fn start(path: &Path, study: &Study<'_>, whole: usize) -> std::io::Result<File> {
    let mut file = OpenOptions::new()
        .create(true)
        .truncate(false)
        .write(true)
        .open(path)?;
    file.set_len(whole as u64)?;
    file.seek(SeekFrom::End(0))?;
    if whole == 0 {
        file.write_all(journal::first_line(study).as_bytes())?;
    }
    Ok(file)
}
