//! Tables of numbers in CSV files: a header that names the columns with their units, then
//! rows of numbers.
//!
//! Every cell knows its place, so that a fault points into the file. The separator is a tab,
//! a semicolon or a comma, whichever the header has first in this order. Beside a comma as
//! separator no number has a decimal comma.

mod record;

pub use record::TimeTable;

use super::suggest::{did_you_mean, quoted_list};
use super::tree::{Node, Value};
use super::wanted::QuantityChoice;
use crate::frontend::diagnostics::{Diagnostic, Place, Source, SourceId};
use crate::units::{number_and_unit, parse};
use std::borrow::Cow;
use std::collections::BTreeMap;
use std::ops::Range;
use std::sync::Arc;

/// Largest file that is read (bytes).
pub const MOST_BYTES: u64 = 50_000_000;

/// Most rows that are read.
const MOST_ROWS: usize = 1_000_000;

/// Faults of one table of which each is reported.
const MOST_FAULTS: usize = 20;

/// The files that a scene names, by their names in it; why one cannot be read.
pub type Files = Arc<BTreeMap<String, Result<TableFile, Diagnostic>>>;

/// A CSV file.
#[derive(Clone, Debug)]
pub struct TableFile {
    source: Arc<Source>,
    /// Number of its text among those of the scene.
    id: SourceId,
}

/// A row of two columns: the numbers, and the place of the first.
pub(super) type Row = ((f64, f64), Place);

/// A column by its header.
struct Column<'t> {
    name: &'t str,
    unit: &'t str,
    /// Bytes of the whole header.
    range: Range<usize>,
    unit_at: usize,
}

/// A file on the way to its numbers.
struct Csv<'f> {
    text: &'f str,
    id: SourceId,
    separator: char,
    columns: Vec<Column<'f>>,
    /// Where the rows begin.
    start: usize,
}

/// Takes the cells of a row.
type RowReader<'r> = dyn FnMut(&[Range<usize>]) -> Result<(), Box<Diagnostic>> + 'r;

/// The faults of a table.
type Faults = Vec<Diagnostic>;

impl TableFile {
    /// A file of its text.
    pub fn new(source: Arc<Source>, id: SourceId) -> Self {
        Self { source, id }
    }

    /// The numbers of two columns, in SI units.
    pub(super) fn rows(
        &self,
        names: Option<&[String; 2]>,
        wanted: [QuantityChoice; 2],
    ) -> Result<Vec<Row>, Faults> {
        let csv = Csv::new(&self.source.text, self.id).map_err(|fault| vec![*fault])?;
        let chosen = csv.chosen_columns(names).map_err(|fault| vec![*fault])?;
        for (at, wanted) in chosen.into_iter().zip(wanted) {
            csv.check_unit(&csv.columns[at], wanted)
                .map_err(|fault| vec![*fault])?;
        }
        let mut rows = Vec::new();
        csv.each_row(&mut |cells| {
            let cell =
                |at: usize| csv.number(&csv.columns[chosen[at]], wanted[at], &cells[chosen[at]]);
            let (x, y) = (cell(0)?, cell(1)?);
            rows.push(((x, y), csv.place(cells[chosen[0]].clone())));
            Ok(())
        })?;
        Ok(rows)
    }

    /// The same as a list in a scene has them; `None`: something is wrong.
    fn list(&self, names: Option<&[String; 2]>) -> Option<Vec<Node>> {
        let csv = Csv::new(&self.source.text, self.id).ok()?;
        let chosen = csv.chosen_columns(names).ok()?;
        let mut rows = Vec::new();
        let read = csv.each_row(&mut |cells| {
            let pair = chosen.map(|at| {
                let text = csv.with_decimal_point(&cells[at]);
                match csv.columns[at].unit {
                    "" => Node::from(text.parse().unwrap_or(f64::NAN)),
                    unit => Node::from(format!("{text} {unit}")),
                }
            });
            rows.push(Value::List(pair.into()).into());
            Ok(())
        });
        read.ok().map(|()| rows)
    }
}

impl<'f> Csv<'f> {
    /// Reads the header.
    fn new(text: &'f str, id: SourceId) -> Result<Self, Box<Diagnostic>> {
        let mut csv = Self {
            text,
            id,
            separator: ',',
            columns: Vec::new(),
            start: 0,
        };
        let Some((start, line)) = lines(text, 0).next() else {
            return Err(csv.fault("the file is empty", 0..0));
        };
        csv.start = start + line.len();
        let separators = ['\t', ';', ','];
        let found = separators.into_iter().find(|&one| line.contains(one));
        csv.separator = found.unwrap_or(',');
        let cells = csv.cells(start, line);
        if cells.iter().all(|cell| csv.is_number(cell)) {
            let fault = csv.fault(
                "the first line does not name the columns",
                start..start + line.len(),
            );
            return Err(Box::new(
                fault.hint("write a header: angle [deg], lift [mm]"),
            ));
        }
        for cell in cells {
            csv.columns.push(csv.column(cell)?);
        }
        Ok(csv)
    }

    fn place(&self, range: Range<usize>) -> Place {
        Place::new(self.id, range)
    }

    fn fault(&self, message: impl Into<String>, range: Range<usize>) -> Box<Diagnostic> {
        Box::new(Diagnostic::error("bad-table", message).at(self.place(range)))
    }

    /// `angle [deg]` or `angle (deg)`.
    fn column(&self, range: Range<usize>) -> Result<Column<'f>, Box<Diagnostic>> {
        let text = &self.text[range.clone()];
        let Some(open) = text.find(['[', '(']) else {
            return Ok(Column {
                name: text.trim(),
                unit: "",
                unit_at: range.start,
                range,
            });
        };
        let inner = text[open + 1..].trim_end();
        let Some(unit) = inner.strip_suffix([']', ')']) else {
            let message = format!("the unit of the column `{text}` is not closed");
            let fault = self.fault(message, range);
            return Err(Box::new(fault.hint("write angle [deg] or angle (deg)")));
        };
        let blank = unit.len() - unit.trim_start().len();
        Ok(Column {
            name: text[..open].trim(),
            unit: unit.trim(),
            unit_at: range.start + open + 1 + blank,
            range,
        })
    }

    /// The two columns that are meant.
    fn chosen_columns(&self, names: Option<&[String; 2]>) -> Result<[usize; 2], Box<Diagnostic>> {
        let all = || quoted_list(self.columns.iter().map(|one| one.name), "and");
        let header = || {
            let ends = self.columns.first().zip(self.columns.last());
            ends.map_or(0..0, |(first, last)| first.range.start..last.range.end)
        };
        let Some(names) = names else {
            let count = self.columns.len();
            if count == 2 {
                return Ok([0, 1]);
            }
            let message = format!(
                "the file has {count} columns, and two are needed: {}",
                all()
            );
            let hint = match count {
                0 | 1 => "columns are separated by commas, semicolons or tabs".to_owned(),
                _ => "choose them in the scene: \"columns\": [\"angle\", \"lift\"]".to_owned(),
            };
            return Err(Box::new(self.fault(message, header()).hint(hint)));
        };
        let find = |name: &String| {
            let mut fitting = (self.columns.iter().enumerate()).filter(|(_, column)| {
                column.name == name.trim() || self.text[column.range.clone()] == **name
            });
            let Some((at, _)) = fitting.next() else {
                let known = self.columns.iter().map(|one| one.name);
                let hint = did_you_mean(name, known);
                let fault = self.fault(format!("the file has no column `{name}`"), header());
                return Err(Box::new(
                    fault.hint(hint.unwrap_or_else(|| format!("it has {}", all()))),
                ));
            };
            match fitting.next() {
                Some((_, other)) => Err(self.fault(
                    format!("two columns are named `{name}`"),
                    other.range.clone(),
                )),
                None => Ok(at),
            }
        };
        Ok([find(&names[0])?, find(&names[1])?])
    }

    /// Whether the unit of a column fits.
    fn check_unit(
        &self,
        column: &Column<'_>,
        wanted: QuantityChoice,
    ) -> Result<(), Box<Diagnostic>> {
        let hint = format!("it is {}", wanted.words());
        if column.unit.is_empty() {
            // (A file in degrees would be read as radians, and nobody would see it.)
            if parse("1").is_ok_and(|bare| wanted.convert_measure(bare).is_ok()) {
                return Ok(());
            }
            let message = format!("the column `{}` has no unit", column.name);
            let fault = Diagnostic::error("missing-unit", message);
            let fault = fault.at(self.place(column.range.clone()));
            let write = format!("write it behind the name: {} [deg]", column.name);
            return Err(Box::new(fault.hint(hint).hint(write)));
        }
        let place = column.unit_at..column.unit_at + column.unit.len();
        let Ok(measure) = parse(&format!("1 {}", column.unit)) else {
            let message = format!("unknown unit `{}`", column.unit);
            return Err(Box::new(self.fault(message, place).hint(hint)));
        };
        if wanted.convert_measure(measure).is_ok() {
            return Ok(());
        }
        let message = format!("the column `{}` has the wrong unit", column.name);
        let fault = Diagnostic::error("wrong-unit", message).at(self.place(place));
        let label = format!("this is in {}", measure.dimension);
        Err(Box::new(fault.label(label).hint(hint)))
    }

    /// Reads row by row; the cells are those of the header.
    fn each_row(&self, read: &mut RowReader<'_>) -> Result<(), Faults> {
        let (mut faults, mut count) = (Vec::new(), 0usize);
        for (start, line) in lines(self.text, self.start) {
            count += 1;
            let whole = start..start + line.len();
            if count > MOST_ROWS {
                let message = format!("the table has more than {MOST_ROWS} rows");
                faults.push(*self.fault(message, whole));
                break;
            }
            let cells = self.cells(start, line);
            let found = match cells.len() == self.columns.len() {
                true => read(&cells),
                false => Err(self.fault(
                    format!(
                        "this row has {}, the header has {}",
                        counted(cells.len()),
                        counted(self.columns.len())
                    ),
                    whole,
                )),
            };
            faults.extend(found.err().map(|fault| *fault));
            if faults.len() == MOST_FAULTS {
                break;
            }
        }
        match faults.is_empty() {
            true => Ok(()),
            false => Err(faults),
        }
    }

    /// The cells of a line without the space and the quotes about them.
    fn cells(&self, start: usize, line: &str) -> Vec<Range<usize>> {
        let (mut cells, mut from, mut quoted) = (Vec::new(), 0, false);
        for (at, letter) in line.char_indices() {
            quoted ^= letter == '"';
            if letter == self.separator && !quoted {
                cells.push(trimmed_cell(line, from..at));
                from = at + letter.len_utf8();
            }
        }
        cells.push(trimmed_cell(line, from..line.len()));
        let moved = |cell: Range<usize>| cell.start + start..cell.end + start;
        cells.into_iter().map(moved).collect()
    }

    /// A cell with a decimal point.
    fn with_decimal_point(&self, cell: &Range<usize>) -> Cow<'f, str> {
        let text = &self.text[cell.clone()];
        let comma = self.separator != ',' && text.matches(',').count() == 1 && !text.contains('.');
        match comma {
            true => Cow::Owned(text.replace(',', ".")),
            false => Cow::Borrowed(text),
        }
    }

    /// An empty cell is pointed at beside its separator.
    fn pointed_range(&self, cell: &Range<usize>) -> Range<usize> {
        let first = self.text[..cell.start].ends_with('\n');
        match cell.is_empty() {
            true if !first && cell.start > 0 => cell.start - 1..cell.start,
            true => cell.start..cell.start + 1,
            false => cell.clone(),
        }
    }

    fn is_number(&self, cell: &Range<usize>) -> bool {
        let text = self.with_decimal_point(cell);
        number_and_unit(&text).is_some_and(|(number, _)| number.len() == text.len())
    }

    fn number(
        &self,
        column: &Column<'_>,
        wanted: QuantityChoice,
        cell: &Range<usize>,
    ) -> Result<f64, Box<Diagnostic>> {
        let text = self.with_decimal_point(cell);
        if !self.is_number(cell) {
            let message = match text.is_empty() {
                true => format!("the column `{}` has no number here", column.name),
                false => format!("`{}` is not a number", shortened(&text)),
            };
            let comma = self.separator == ',' && text.contains(',');
            let hint = comma.then(|| "a decimal comma needs a semicolon as separator".to_owned());
            return Err(Box::new(
                self.fault(message, self.pointed_range(cell))
                    .maybe_hint(hint),
            ));
        }
        let value = match column.unit {
            "" => text.parse().ok(),
            unit => parse(&format!("{text} {unit}"))
                .ok()
                .and_then(|one| wanted.convert_measure(one).ok()),
        };
        let finite = value.filter(|value: &f64| value.is_finite());
        finite
            .ok_or_else(|| self.fault(format!("`{text}` is too large for a number"), cell.clone()))
    }
}

/// The lines from a place on that are neither empty nor remarks, with their places.
fn lines(text: &str, from: usize) -> impl Iterator<Item = (usize, &str)> {
    let mut at = from;
    let lines = text[from..].split_inclusive('\n').map(move |line| {
        let start = at;
        at += line.len();
        (start, line.trim_end_matches(['\n', '\r']))
    });
    lines.filter(|(_, line)| !line.trim().is_empty() && !line.starts_with('#'))
}

/// A cell without space and quotes.
fn trimmed_cell(line: &str, range: Range<usize>) -> Range<usize> {
    let text = &line[range.clone()];
    let start = range.start + text.len() - text.trim_start().len();
    let text = text.trim();
    let inner = text
        .strip_prefix('"')
        .and_then(|text| text.strip_suffix('"'));
    match inner {
        Some(inner) => start + 1..start + 1 + inner.len(),
        None => start..start + text.len(),
    }
}

/// The beginning of a long cell.
fn shortened(text: &str) -> String {
    match text.char_indices().nth(40) {
        None => text.to_owned(),
        Some((at, _)) => format!("{}…", &text[..at]),
    }
}

fn counted(cells: usize) -> String {
    match cells {
        1 => "1 cell".to_owned(),
        _ => format!("{cells} cells"),
    }
}

/// Why a scene without a folder takes no file.
pub fn no_folder() -> Diagnostic {
    let message = "this scene has no folder in which a file could be";
    Diagnostic::error("no-folder", message)
        .hint("read the scene from its file, or write the table into it: [[0, 0], [1, 2]]")
}

/// The names of all files that a tree names.
pub fn file_names(node: &Node) -> Vec<&str> {
    let mut names = Vec::new();
    gather(node, &mut names);
    names
}

fn gather<'n>(node: &'n Node, names: &mut Vec<&'n str>) {
    match &node.value {
        Value::Object(members) => {
            names.extend(node.get("file").and_then(Node::text));
            members
                .iter()
                .for_each(|member| gather(&member.value, names));
        }
        Value::List(items) => items.iter().for_each(|item| gather(item, names)),
        _ => {}
    }
}

/// The names of the columns that an object beside `file` chooses.
fn columns(node: &Node) -> Option<[String; 2]> {
    let Value::List(items) = &node.get("columns")?.value else {
        return None;
    };
    match items.as_slice() {
        [one, other] => Some([one.text()?.to_owned(), other.text()?.to_owned()]),
        _ => None,
    }
}

/// Puts the numbers of files into a tree in the place of their names: then it depends on
/// no file.
pub fn put_in(node: &mut Node, files: &Files) {
    let name = node.get("file").and_then(Node::text);
    if let Some(Ok(file)) = name.and_then(|name| files.get(name))
        && let Some(list) = file.list(columns(node).as_ref())
    {
        node.value = Value::List(list);
        return;
    }
    match &mut node.value {
        Value::Object(members) => members
            .iter_mut()
            .for_each(|one| put_in(&mut one.value, files)),
        Value::List(items) => items.iter_mut().for_each(|item| put_in(item, files)),
        _ => {}
    }
}
