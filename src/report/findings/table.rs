//! Values, figures and tables of findings.

use crate::report::addresses::result_words;
use crate::report::display_units;
use crate::report::quantity::{readable_scale, significant, with_unit};
use crate::studies::check::Check;
use crate::units::shown;

/// A number in its unit, or words.
#[derive(Clone, Debug, PartialEq)]
pub enum Value {
    /// A number; one that is not finite is not known.
    Number {
        /// Number in that unit.
        value: f64,
        /// Unit, SI ones take prefixes; empty of a plain number.
        unit: String,
        /// Significant digits that are shown.
        digits: usize,
    },
    /// Words.
    Words(String),
}

impl Value {
    /// A number with that many significant digits.
    pub fn new(value: f64, unit: &str, digits: usize) -> Self {
        let unit = if unit == "1" { "" } else { unit };
        Self::Number {
            value,
            unit: unit.to_owned(),
            digits,
        }
    }

    /// An angle (rad) for reading in degrees, any other quantity in its unit.
    pub fn angle_or(value: f64, unit: &str, digits: usize) -> Self {
        match unit {
            "rad" => Self::new(value.to_degrees(), "deg", digits),
            unit => Self::new(value, unit, digits),
        }
    }

    /// The value in a sentence: `12.5 mm`, `−3·10⁻¹⁷ m`.
    pub fn words(&self) -> String {
        match self {
            Self::Words(words) => words.clone(),
            Self::Number { value, .. } if !value.is_finite() => "–".to_owned(),
            Self::Number {
                value,
                unit,
                digits,
            } => with_unit(*value, unit, *digits),
        }
    }

    /// The value in a table of the terminal: `12.5 mm`, `-3e-17 m`.
    pub(super) fn terminal_text(&self) -> String {
        match self {
            Self::Words(words) => words.clone(),
            Self::Number { value, .. } if !value.is_finite() => "–".to_owned(),
            Self::Number {
                value,
                unit,
                digits,
            } => {
                let scale = readable_scale(*value, unit);
                let (number, unit) = match scale.unit.starts_with("10") {
                    true => (*value, unit),
                    false => (value / scale.factor, &scale.unit),
                };
                format!(
                    "{} {unit}",
                    shown(number, display_units::shown_digits(*digits))
                )
                .trim_end()
                .to_owned()
            }
        }
    }
}

impl From<&str> for Value {
    fn from(words: &str) -> Self {
        Self::Words(words.to_owned())
    }
}

impl From<String> for Value {
    fn from(words: String) -> Self {
        Self::Words(words)
    }
}

/// Figure: a name, a value, and what is to be added: where it is, what it means.
#[derive(Clone, Debug, PartialEq)]
pub struct Figure {
    /// Name of the figure.
    pub name: String,
    /// Its value.
    pub value: Value,
    /// Addition; may be empty.
    pub note: String,
    /// Check that the figure shows, if it is one.
    pub check: Option<Check>,
}

impl Figure {
    /// A check with its bound.
    pub fn check(check: &Check) -> Self {
        Self::new(check.name, check_outcome(check)).checked(check)
    }

    /// The figure as the one that shows a check.
    #[must_use]
    pub fn checked(self, check: &Check) -> Self {
        Self {
            check: Some(check.clone()),
            ..self
        }
    }

    /// A figure without an addition.
    pub fn new(name: &str, value: impl Into<Value>) -> Self {
        Self {
            name: name.to_owned(),
            value: value.into(),
            note: String::new(),
            check: None,
        }
    }

    /// A number in its unit.
    pub fn number(name: &str, value: f64, unit: &str, digits: usize) -> Self {
        Self::new(name, Value::new(value, unit, digits))
    }

    /// The figure with an addition.
    #[must_use]
    pub fn with_note(self, note: impl Into<String>) -> Self {
        Self {
            note: note.into(),
            ..self
        }
    }
}

/// How far a check is off, and whether that is within its bound.
pub(in crate::report) fn check_outcome(check: &Check) -> String {
    let judged = match check.passed() {
        true => "within",
        false => "BEYOND",
    };
    let [value, bound] = [check.value, check.bound].map(|number| significant(number, 2));
    format!("{value}, {judged} its bound of {bound}")
}

/// A table with a head.
#[derive(Clone, Debug, Default, PartialEq)]
pub struct Table {
    /// Names of the columns; those of numbers are aligned right.
    pub columns: Vec<Column>,
    /// The rows, each with a cell for every column.
    pub rows: Vec<Row>,
}

/// Column of a table.
#[derive(Clone, Debug, PartialEq)]
pub struct Column {
    /// Name in the head.
    pub name: String,
    /// True: aligned right, as numbers are.
    pub right: bool,
    /// True: sentences, that go on in several lines.
    pub prose: bool,
    /// True: too much for the terminal.
    pub minor: bool,
}

/// Row of a table.
#[derive(Clone, Debug, Default, PartialEq)]
pub struct Row {
    /// The cells.
    pub cells: Vec<Cell>,
    /// True: too much for the terminal.
    pub minor: bool,
}

/// Cell of a table: a value and what is to be added.
#[derive(Clone, Debug, PartialEq)]
pub struct Cell {
    /// The value.
    pub value: Value,
    /// Addition: where it is, how far off it is; may be empty.
    pub note: String,
    /// What it means; `None`: neither good nor bad.
    pub good: Option<bool>,
    /// True: the id of an object, whose motion a page shows.
    pub object: bool,
    /// What a page says for an address, which stands below it there; empty of everything else.
    pub words: String,
}

impl<V: Into<Value>> From<V> for Cell {
    fn from(value: V) -> Self {
        Self {
            value: value.into(),
            note: String::new(),
            good: None,
            object: false,
            words: String::new(),
        }
    }
}

impl Cell {
    /// A number, or what stands where there is none.
    pub fn known_number(value: Option<f64>, unit: &str, digits: usize) -> Self {
        Value::new(value.unwrap_or(f64::NAN), unit, digits).into()
    }

    /// The id of an object, whose motion the page shows.
    pub fn object(id: &str) -> Self {
        Self {
            object: true,
            ..id.into()
        }
    }

    /// The address of a result, of which a page has the words.
    pub fn result(address: &str) -> Self {
        Self::address(address, result_words(address))
    }

    /// An address with its words, which may be the address itself.
    pub fn address(address: &str, words: String) -> Self {
        Self {
            words: if words == address {
                String::new()
            } else {
                words
            },
            ..address.into()
        }
    }

    /// The cell as good or bad news.
    #[must_use]
    pub fn with_outcome(self, good: Option<bool>) -> Self {
        Self { good, ..self }
    }

    /// A value with an addition.
    pub fn with_note(value: impl Into<Value>, note: impl Into<String>) -> Self {
        Self {
            note: note.into(),
            ..Self::from(value.into())
        }
    }
}

impl Table {
    /// A table without rows; a name behind `>` is that of a column of numbers, behind `~` of one
    /// of sentences, behind `?` (first) of one that is too much for the terminal.
    pub fn new<'n>(names: impl IntoIterator<Item = &'n str>) -> Self {
        let column = |name: &str| {
            let of_all = name.trim_start_matches('?');
            Column {
                name: of_all.trim_start_matches(['>', '~']).to_owned(),
                right: of_all.starts_with('>'),
                prose: of_all.starts_with('~'),
                minor: name.starts_with('?'),
            }
        };
        Self {
            columns: names.into_iter().map(column).collect(),
            rows: Vec::new(),
        }
    }

    /// Adds a row.
    pub fn push(&mut self, cells: impl IntoIterator<Item = impl Into<Cell>>) {
        self.rows.push(Row {
            cells: cells.into_iter().map(Into::into).collect(),
            minor: false,
        });
    }

    /// The table with these rows.
    #[must_use]
    pub fn rows<C: Into<Cell>>(mut self, rows: impl IntoIterator<Item = Vec<C>>) -> Self {
        for cells in rows {
            self.push(cells);
        }
        self
    }
}
