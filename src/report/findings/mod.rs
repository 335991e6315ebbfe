//! What a study found, as data: an answer in a sentence, figures, tables, charts, drawings and
//! notes, in sections. One exporter makes the text of the terminal of it (`text`), one the page
//! (`page`); tables for other programs are [`Rows`](super::csv::Rows).

mod page;
mod text;

pub(in crate::report) use text::width;

use super::plot::{Plot, Plots};
use super::quantity::{scale, with_unit};
use super::verdict::Verdict;
use crate::units::shown;
use std::fmt;

/// All that a study has to say.
#[derive(Debug)]
pub struct Findings<'a> {
    /// Title: name of the scene, or of what was asked for without one.
    pub title: String,
    /// What was asked, in a few words.
    pub subtitle: String,
    /// The answer in a sentence; `None`: there is nothing but what the sections list.
    pub answer: Option<Verdict>,
    /// Warnings beside the figures.
    pub warnings: Vec<String>,
    /// The sections in their order.
    pub sections: Vec<Section<'a>>,
    /// Source of what was found.
    pub source: Source<'a>,
}

impl Findings<'_> {
    /// The first chart.
    pub fn first_chart(&self) -> Option<&Plot> {
        let mut items = self.sections.iter().flat_map(|section| &section.items);
        items.find_map(|item| match item {
            Item::Charts(charts) => charts.charts.first(),
            _ => None,
        })
    }
}

/// Source of findings, for the foot of the page.
#[derive(Clone, Debug, Default)]
pub struct Source<'a> {
    /// The scene's text, shown as it is; `None`: there is no scene.
    pub scene: Option<&'a str>,
    /// SHA-256 of the canonical scene; empty without one.
    pub hash: &'a str,
    /// Names and texts besides these.
    pub more: Vec<(String, String)>,
}

impl<'a> Source<'a> {
    /// A scene's text and the hash of its canonical form.
    pub fn scene(text: &'a str, hash: &'a str) -> Self {
        Self {
            scene: Some(text),
            hash,
            more: Vec::new(),
        }
    }
}

/// Section of findings: a heading and what stands under it.
#[derive(Debug, Default)]
pub struct Section<'a> {
    /// Heading; may be empty.
    pub heading: String,
    /// What stands under it.
    pub items: Vec<Item<'a>>,
}

/// Part of a section.
#[derive(Debug)]
pub enum Item<'a> {
    /// A paragraph.
    Words(String),
    /// A paragraph that explains what a page draws.
    Legend(String),
    /// A list of remarks.
    Notes(Vec<String>),
    /// Figures, one a line.
    Figures(Vec<Figure>),
    /// A table.
    Table(Table),
    /// A long table, that a page folds away under these words.
    Folded(String, Table),
    /// Charts of a page.
    Charts(Charts),
    /// A drawing of a page.
    Drawing(Drawn<'a>),
}

/// A drawing that is made when a page wants it.
pub struct Drawn<'a>(pub(in crate::report) Box<dyn Fn(&mut Plots) -> String + 'a>);

impl fmt::Debug for Drawn<'_> {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        f.write_str("Drawn")
    }
}

/// Charts that stand together.
#[derive(Clone, Debug)]
pub struct Charts {
    /// The charts.
    pub charts: Vec<Plot>,
    /// Arrangement on the page.
    pub layout: Layout,
    /// Charts with the same link are zoomed together; empty: each by itself.
    pub link: &'static str,
}

/// Arrangement of charts on a page.
#[derive(Clone, Copy, Debug, PartialEq)]
pub enum Layout {
    /// Two beside each other.
    Grid,
    /// Over the whole width, this high (pixels).
    Wide(f64),
    /// Round ones, as many beside each other as there is room for.
    Round,
}

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
    fn plain(&self) -> String {
        match self {
            Self::Words(words) => words.clone(),
            Self::Number { value, .. } if !value.is_finite() => "–".to_owned(),
            Self::Number {
                value,
                unit,
                digits,
            } => {
                let scale = scale(*value, unit);
                let (number, unit) = match scale.unit.starts_with("10") {
                    true => (*value, unit),
                    false => (value / scale.factor, &scale.unit),
                };
                format!("{} {unit}", shown(number, *digits))
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
}

impl Figure {
    /// A figure without an addition.
    pub fn new(name: &str, value: impl Into<Value>) -> Self {
        Self {
            name: name.to_owned(),
            value: value.into(),
            note: String::new(),
        }
    }

    /// A number in its unit.
    pub fn number(name: &str, value: f64, unit: &str, digits: usize) -> Self {
        Self::new(name, Value::new(value, unit, digits))
    }

    /// The figure with an addition.
    #[must_use]
    pub fn with(self, note: impl Into<String>) -> Self {
        Self {
            note: note.into(),
            ..self
        }
    }
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
}

impl<V: Into<Value>> From<V> for Cell {
    fn from(value: V) -> Self {
        Self {
            value: value.into(),
            note: String::new(),
            good: None,
        }
    }
}

impl Cell {
    /// A value with an addition.
    pub fn with(value: impl Into<Value>, note: impl Into<String>) -> Self {
        Self {
            note: note.into(),
            ..Self::from(value.into())
        }
    }
}

impl Table {
    /// A table without rows; a name behind `>` is that of a column of numbers.
    pub fn new<'n>(names: impl IntoIterator<Item = &'n str>) -> Self {
        let column = |name: &str| Column {
            name: name.trim_start_matches('>').to_owned(),
            right: name.starts_with('>'),
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

impl<'a> Section<'a> {
    /// A section without anything under its heading.
    pub fn new(heading: impl Into<String>) -> Self {
        Self {
            heading: heading.into(),
            items: Vec::new(),
        }
    }

    /// The section with one more item.
    #[must_use]
    pub fn item(mut self, item: Item<'a>) -> Self {
        self.items.push(item);
        self
    }

    /// The section with a paragraph.
    #[must_use]
    pub fn words(self, words: impl Into<String>) -> Self {
        self.item(Item::Words(words.into()))
    }

    /// The section with a paragraph on what a page draws.
    #[must_use]
    pub fn legend(self, words: impl Into<String>) -> Self {
        self.item(Item::Legend(words.into()))
    }

    /// The section with figures.
    #[must_use]
    pub fn figures(self, figures: Vec<Figure>) -> Self {
        self.item(Item::Figures(figures))
    }

    /// The section with a table.
    #[must_use]
    pub fn table(self, table: Table) -> Self {
        self.item(Item::Table(table))
    }

    /// The section with charts.
    #[must_use]
    pub fn charts(self, layout: Layout, link: &'static str, charts: Vec<Plot>) -> Self {
        self.item(Item::Charts(Charts {
            charts,
            layout,
            link,
        }))
    }

    /// The section with a drawing.
    #[must_use]
    pub fn drawing(self, make: impl Fn(&mut Plots) -> String + 'a) -> Self {
        self.item(Item::Drawing(Drawn(Box::new(make))))
    }

    /// True when there is nothing under the heading.
    pub fn is_empty(&self) -> bool {
        self.items.iter().all(|item| match item {
            Item::Words(words) | Item::Legend(words) => words.is_empty(),
            Item::Notes(notes) => notes.is_empty(),
            Item::Figures(figures) => figures.is_empty(),
            Item::Table(table) | Item::Folded(_, table) => table.rows.is_empty(),
            Item::Charts(charts) => charts.charts.is_empty(),
            Item::Drawing(_) => false,
        })
    }
}
