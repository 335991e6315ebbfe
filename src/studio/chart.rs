//! The live map: a figure over two numbers of the text, first coarse, then finer.
//!
//! It is a `studies::map` of 25, then 100, then 400 cells. The coarse one is always finished.
//! Finer ones begin if nothing newer came for longer than a move of the pointer takes, and end
//! as soon as something newer waits. A map that does not depend on the change is not made
//! again.

use super::limits::{CELLS, RUN};
use super::messages::MapRequest;
use crate::budget::Budget;
use crate::frontend::scene::{BuiltIn, Catalogue, Document, LayeredCatalogue, Overrides};
use crate::report::live;
use crate::studies::map::{Cell, Listener, MapResult, Panels, Question, Study, StudyFault, map};
use serde_json::json;
use std::collections::BTreeMap;
use std::sync::atomic::{AtomicBool, AtomicUsize, Ordering};

/// A map that is to be made.
#[derive(Clone, Copy, Debug)]
pub(super) struct Task<'a, C> {
    pub(super) version: u64,
    pub(super) name: &'a str,
    pub(super) text: &'a str,
    pub(super) catalogue: &'a C,
    pub(super) asked: &'a MapRequest,
}

/// What becomes of it on the way.
pub(super) trait ChartProgress: Sync {
    /// A map, as a message; false: something newer waits, and this is enough.
    fn map(&self, message: String) -> bool;
    /// So many cells are done of so many.
    fn progress(&self, done: usize, of: usize);
}

impl<C: Catalogue + Sync> Task<'_, C> {
    /// What the map depends on: everything but the values of its own parameters. `None`: the
    /// text is no scene.
    pub(super) fn key(&self) -> Option<String> {
        let document = Document::parse(self.name, self.text.as_bytes()).ok()?;
        let axes = std::iter::once(&self.asked.x).chain(&self.asked.y);
        let settings = axes.map(|range| {
            let axis = range.axis(CELLS[0]);
            axis.setting(axis.from)
        });
        let catalogue = LayeredCatalogue(self.catalogue, &BuiltIn);
        let reading = document.scene(&catalogue, &Overrides::new(settings)).ok()?;
        Some(format!("{} {:?}", reading.scene.hash, self.asked))
    }

    /// Makes it, from the coarse one on; what cannot be asked is told as a map without cells.
    /// False: it was ended.
    pub(super) fn make(&self, stop: &AtomicBool, told: &impl ChartProgress) -> bool {
        self.make_levels(&CELLS, stop, told)
    }

    /// Makes it with so many cells along and up, one after the other. False: it was ended.
    pub(super) fn make_levels(
        &self,
        levels: &[usize],
        stop: &AtomicBool,
        told: &impl ChartProgress,
    ) -> bool {
        let Ok(document) = Document::parse(self.name, self.text.as_bytes()) else {
            return false;
        };
        let catalogue = LayeredCatalogue(self.catalogue, &BuiltIn);
        let mut last = 0;
        for &count in levels {
            let question = Question {
                overrides: Vec::new(),
                x: self.asked.x.axis(count),
                y: self.asked.y.as_ref().map(|range| range.axis(count)),
                panels: Panels::default(),
                figure: self.asked.figure.clone(),
                check_determined: false,
                digits: 3,
            };
            let study = match Study::new(&document, &catalogue, question) {
                Ok(study) => study,
                Err(fault) => return told.map(self.refused(&fault)),
            };
            // Of a count there may be no more values.
            if study.cells() == last {
                continue;
            }
            last = study.cells();
            let budget = Budget::interrupted_by(stop).within(RUN);
            let listener = Counted::new(study.cells(), count == CELLS[0], told);
            // The coarse one comes while a number moves, and answers and the browser with it.
            let threads = (count == CELLS[0]).then(half_of_the_cores);
            let Ok(found) = map(&study, BTreeMap::new(), threads, &budget, &listener) else {
                return false;
            };
            if !found.complete {
                return false;
            }
            if !told.map(self.message(&study, &found)) {
                return false;
            }
        }
        true
    }

    fn message(&self, study: &Study<'_>, found: &MapResult) -> String {
        let (html, plots, notes) = live::map(study, found);
        let columns = plots.columns_and_charts().0;
        json!({
            "type": "map",
            "version": self.version,
            "figure": study.figure,
            "cells": study.cells(),
            "html": html,
            "plots": live::described_map(&plots),
            "columns": columns,
            "notes": notes,
        })
        .to_string()
    }

    fn refused(&self, fault: &StudyFault) -> String {
        let words = match fault {
            StudyFault::Question(words) => words.clone(),
            StudyFault::Scene(faults) => {
                let first = faults.items.first();
                first
                    .map_or("the scene is wrong", |one| &one.message)
                    .to_owned()
            }
        };
        json!({ "type": "map", "version": self.version, "refused": words }).to_string()
    }
}

fn half_of_the_cores() -> usize {
    let cores = std::thread::available_parallelism().map_or(1, usize::from);
    cores.div_ceil(2)
}

/// Counts cells, and tells of them where there are many.
struct Counted<'t, T> {
    done: AtomicUsize,
    of: usize,
    silent: bool,
    told: &'t T,
}

impl<'t, T: ChartProgress> Counted<'t, T> {
    fn new(of: usize, silent: bool, told: &'t T) -> Self {
        Self {
            done: AtomicUsize::new(0),
            of,
            silent,
            told,
        }
    }
}

impl<T: ChartProgress> Listener for Counted<'_, T> {
    fn row(&self, _row: usize, cells: &[Cell]) -> Result<(), String> {
        let done = self.done.fetch_add(cells.len(), Ordering::Relaxed) + cells.len();
        if !self.silent {
            self.told.progress(done, self.of);
        }
        Ok(())
    }
}
