//! What a study found, as data: an answer in a sentence, figures, tables, charts, drawings and
//! notes, in sections. One exporter makes the text of the terminal of it (`text`), one the page
//! (`page`); tables for other programs are [`Rows`](super::csv::Rows).
//!
//! A number is written by `units::shown` on the terminal. On pages and in sentences it is
//! written by `quantity::significant`, which is the same with a real minus sign and raised
//! powers; the terminal turns these back. Columns of sentences follow the others, in their
//! order, if the terminal has room for them, else they go below each row. Columns that are too
//! much for the terminal leave narrow pages and paper too. A table that is wider than the
//! terminal continues below under its first column.

mod page;
pub(super) mod table;
mod text;

#[cfg(feature = "live")]
pub(in crate::report) use page::WIDE;
pub use table::{Cell, Column, Figure, Row, Table, Value};
pub(in crate::report) use text::width;

use super::plot::{Plot, Plots};
use super::verdict::{Verdict, capitalised};
use crate::studies::check::Check;
use crate::studies::judgement::Judgement;
use crate::studies::rigid::Rigid;
use serde_json::json;
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
    /// The checks that the figures show, with their bounds.
    pub fn checks(&self) -> impl Iterator<Item = &Check> {
        let items = self.sections.iter().flat_map(|section| &section.items);
        items
            .filter_map(|item| match item {
                Item::Figures(figures) => Some(figures),
                Item::Words(_)
                | Item::Legend(_)
                | Item::Notes(_)
                | Item::Table(_)
                | Item::Folded(..)
                | Item::Charts(_)
                | Item::Drawing(_) => None,
            })
            .flatten()
            .filter_map(|figure| figure.check.as_ref())
    }

    /// The verdict, one of four, where something is judged.
    pub fn judgement(&self) -> Option<Judgement> {
        self.answer.as_ref().and_then(|answer| answer.judgement)
    }

    /// Adds the verdict and the label of a result without elastic objects to a document of
    /// these findings: `verdict`, `rigid`.
    pub fn judge(&self, document: &mut serde_json::Value, label: Option<&Rigid>) {
        if let Some(judgement) = self.judgement() {
            document["verdict"] = json!(judgement);
        }
        document["rigid"] = json!(label);
    }

    /// Labels the whole as computed without the elasticity of objects.
    pub fn label(&mut self, label: Option<&Rigid>, what: &str) {
        if let Some(label) = label {
            self.leave_open(Some(label.words(what)));
        }
    }

    /// States what is not judged, so that nothing is certified.
    pub fn leave_open(&mut self, unjudged: Option<String>) {
        let Some(words) = unjudged else { return };
        if let Some(answer) = &mut self.answer {
            answer.uncertify();
        }
        let words = capitalised(&words) + ".";
        self.sections
            .insert(0, Section::default().with_paragraph(words));
    }

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
    /// SHA-256 of what was asked; empty without one.
    pub hash: &'a str,
    /// What that hash is of: `the canonical scene`.
    pub hashed: &'static str,
    /// Names and texts besides these.
    pub more: Vec<(String, String)>,
}

impl<'a> Source<'a> {
    /// A scene's text and the hash of its canonical form.
    pub fn scene(text: &'a str, hash: &'a str) -> Self {
        Self {
            scene: Some(text),
            hash,
            hashed: "the canonical scene",
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
    Drawing(DeferredDrawing<'a>),
}

/// A drawing that is made when a page wants it.
pub struct DeferredDrawing<'a>(pub(in crate::report) Box<dyn Fn(&mut Plots) -> String + 'a>);

impl fmt::Debug for DeferredDrawing<'_> {
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
    /// Panels of one picture, so many beside each other.
    Panels(usize),
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
    pub fn with_paragraph(self, words: impl Into<String>) -> Self {
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
        self.item(Item::Drawing(DeferredDrawing(Box::new(make))))
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
