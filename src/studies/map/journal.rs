//! Finished rows as lines of text, so that a study that was killed goes on
//! where it was.
//!
//! The first line names the study by its hash; every further line holds one
//! row. Each line begins with a digest of the rest of it: a line that was torn
//! when the program was killed is recognised, and everything from there on is
//! worked out again. Numbers keep all their digits.

use super::cell::Cell;
use super::study::Study;
use crate::studies::prepared::Verdict;
use serde::{Deserialize, Serialize};
use sha2::{Digest, Sha256};
use std::collections::BTreeMap;
use std::fmt::Write as _;

/// Length of the digest of a line, in hexadecimal digits.
const DIGITS: usize = 16;

/// Head: the first line of a journal.
#[derive(Debug, Deserialize, PartialEq, Serialize)]
struct Head {
    dam_map: u32,
    hash: String,
}

/// Cells in a line: value, verdict, cause, how far it moves, whether it is
/// determined, rigid margin.
type StoredCells = (
    Option<f64>,
    Verdict,
    String,
    Option<f64>,
    Option<bool>,
    Option<f64>,
);

/// Row of a journal: one cell.
#[derive(Debug, Deserialize, Serialize)]
struct Row {
    row: usize,
    cells: Vec<StoredCells>,
}

/// Piece of a map that was shared out: some cells, counted over all panels.
#[derive(Debug, Deserialize, Serialize)]
struct Piece {
    first: usize,
    cells: Vec<StoredCells>,
}

/// Cells in a line of a piece: a torn file loses no more.
const IN_A_LINE: usize = 64;

/// Content of a journal.
#[derive(Clone, Debug, Default, PartialEq)]
pub struct Journal {
    /// The rows.
    pub rows: BTreeMap<usize, Vec<Cell>>,
    /// Bytes up to the last whole line: what follows them is torn.
    pub whole: usize,
}

/// The first line of a study's journal.
pub fn first_line(study: &Study<'_>) -> String {
    line(&Head {
        dam_map: 2,
        hash: study.hash.clone(),
    })
}

/// The line of a row.
pub fn row(row: usize, cells: &[Cell]) -> String {
    line(&Row {
        row,
        cells: cells.iter().map(stored).collect(),
    })
}

/// Cells of a map that was shared out, from the `first` on, as a text of its own.
pub fn text_of_cells(study: &Study<'_>, first: usize, cells: &[Cell]) -> String {
    let pieces = cells.chunks(IN_A_LINE).enumerate().map(|(at, cells)| {
        line(&Piece {
            first: first + at * IN_A_LINE,
            cells: cells.iter().map(stored).collect(),
        })
    });
    std::iter::once(first_line(study)).chain(pieces).collect()
}

/// The rows of a map of all its parts, in any order; cells may be there several times.
///
/// # Errors
/// A part belongs to another study or was torn, cells are missing or not the same in two
/// parts, in words.
pub fn merge<'p>(
    study: &Study<'_>,
    parts: impl IntoIterator<Item = (&'p str, &'p [u8])>,
) -> Result<BTreeMap<usize, Vec<Cell>>, String> {
    let mut all: Vec<Option<Cell>> = vec![None; study.cells()];
    for (name, bytes) in parts {
        let wrong = |what: String| format!("`{name}`: {what}");
        let first = first_line(study);
        if !bytes.starts_with(first.as_bytes()) {
            // What is wrong with it, in the words of a journal.
            let what = read(study, bytes).err();
            return Err(wrong(what.unwrap_or_else(|| "it is torn".to_owned())));
        }
        for line in bytes[first.len()..].split_inclusive(|&byte| byte == b'\n') {
            let piece = line.strip_suffix(b"\n").and_then(parse_whole_line::<Piece>);
            let piece = piece.ok_or_else(|| wrong("it is torn".to_owned()))?;
            for (at, cell) in (piece.first..).zip(piece.cells) {
                let place = all.get_mut(at);
                let place = place.ok_or_else(|| wrong(format!("there is no cell {at}")))?;
                let cell = restored(cell);
                if place.as_ref().is_some_and(|known| *known != cell) {
                    return Err(wrong(format!("cell {at} is another one in another part")));
                }
                *place = Some(cell);
            }
        }
    }
    if let Some(from) = all.iter().position(Option::is_none) {
        let known = all[from..].iter().position(Option::is_some);
        let to = known.map_or(all.len(), |count| from + count);
        return Err(format!("the cells {from}:{to} are in no part"));
    }
    let mut cells = all.into_iter().flatten();
    let rows = (0..study.rows()).map(|row| {
        let count = study.row(row).1.len();
        (row, cells.by_ref().take(count).collect())
    });
    Ok(rows.collect())
}

fn stored(cell: &Cell) -> StoredCells {
    (
        cell.value,
        cell.verdict,
        cell.cause.clone(),
        cell.moved,
        cell.determined,
        cell.rigid_margin,
    )
}

fn line(content: &impl Serialize) -> String {
    // Plain data cannot fail to serialise; an empty line would be dropped on reading.
    let body = serde_json::to_string(content).unwrap_or_default();
    format!("{} {body}\n", digest(&body))
}

fn digest(body: &str) -> String {
    let mut text = String::new();
    for byte in &Sha256::digest(body.as_bytes())[..DIGITS / 2] {
        // Writing to a string cannot fail.
        let _ = write!(text, "{byte:02x}");
    }
    text
}

/// Reads a journal. An empty one, or one torn within its first line, is that of
/// a study that has not begun.
///
/// # Errors
/// It is the journal of another study, or no journal at all, in words.
pub fn read(study: &Study<'_>, bytes: &[u8]) -> Result<Journal, String> {
    let first = first_line(study);
    if first.as_bytes().starts_with(bytes) {
        let whole = if bytes.len() == first.len() {
            first.len()
        } else {
            0
        };
        return Ok(Journal {
            whole,
            ..Journal::default()
        });
    }
    if !bytes.starts_with(first.as_bytes()) {
        let known = bytes
            .split(|&byte| byte == b'\n')
            .next()
            .and_then(parse_whole_line::<Head>);
        return Err(match known {
            Some(_) => "it belongs to another study: the scene, the axes, the result, the \
                        settings or the program have changed since"
                .to_owned(),
            None => "it is no journal of a map".to_owned(),
        });
    }
    let mut journal = Journal {
        whole: first.len(),
        ..Journal::default()
    };
    for line in bytes[first.len()..].split_inclusive(|&byte| byte == b'\n') {
        let Some(row) = line.strip_suffix(b"\n").and_then(parse_whole_line::<Row>) else {
            break;
        };
        if row.row >= study.rows() || row.cells.len() != study.row(row.row).1.len() {
            break;
        }
        journal.whole += line.len();
        let cells = row.cells.into_iter().map(restored).collect();
        journal.rows.insert(row.row, cells);
    }
    Ok(journal)
}

/// What a whole line holds; `None` when it was torn or changed.
fn parse_whole_line<T: for<'de> Deserialize<'de>>(line: &[u8]) -> Option<T> {
    let text = std::str::from_utf8(line).ok()?;
    let (found, body) = text.split_once(' ')?;
    (found == digest(body)).then(|| serde_json::from_str(body).ok())?
}

fn restored((value, verdict, cause, moved, determined, rigid_margin): StoredCells) -> Cell {
    Cell {
        value,
        verdict,
        cause,
        moved,
        determined,
        rigid_margin,
    }
}
