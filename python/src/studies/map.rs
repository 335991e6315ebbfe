//! Maps.

use super::interrupted;
use crate::answer::{Table, Told};
use crate::work::Watch;
use dam::ask::MapQuestion;
use dam::report::findings::{Findings, Source};
use dam::report::map::{document, findings};
use dam::studies::axis::Axis;
use dam::studies::map::{Cell, Listener, MapResult, map, map_cells};
use dam::{Error, Scene};
use serde_json::Value;
use std::collections::BTreeMap;
use std::ops::Range;
use std::sync::Arc;
use std::sync::atomic::{AtomicUsize, Ordering};

/// A map with its question.
pub(crate) struct Mapped {
    scene: Arc<Scene>,
    question: MapQuestion,
    result: MapResult,
    /// Numbers of values along and up.
    pub(crate) shape: (usize, usize),
    /// Address and unit of the figure.
    pub(crate) figure: (String, String),
    /// Hash of all that the values depend on.
    pub(crate) hash: String,
    /// What each panel differs in; one without words where there is a single map.
    pub(crate) panels: Vec<String>,
    columns: [Vec<f64>; 4],
}

/// What is asked.
#[derive(Debug)]
pub(crate) struct Wanted {
    pub(crate) x: Axis,
    pub(crate) y: Option<Axis>,
    pub(crate) figure: Option<String>,
    pub(crate) check: bool,
    pub(crate) digits: u8,
    pub(crate) threads: Option<usize>,
    pub(crate) panels: Vec<String>,
}

impl Wanted {
    fn question(self, scene: &Scene) -> MapQuestion {
        let mut question = scene.map(self.x).digits(self.digits);
        if let Some(y) = self.y {
            question = question.up(y);
        }
        if let Some(figure) = &self.figure {
            question = question.figure_at(figure);
        }
        if !self.check {
            question = question.unchecked();
        }
        if let Some(threads) = self.threads {
            question = question.threads(threads);
        }
        question.panels(&self.panels)
    }
}

/// Works a map out.
///
/// # Errors
/// The scene is wrong at every point tried beforehand, or the question is.
pub(crate) fn ask(scene: Arc<Scene>, wanted: Wanted, watch: &Watch) -> Result<Mapped, Error> {
    let threads = wanted.threads;
    let question = wanted.question(&scene);
    let (result, shape, figure, hash, panels, columns) = question.studied(|study| {
        let cells = study.cells() as f64;
        let counter = Counter {
            watch,
            done: AtomicUsize::new(0),
            cells,
        };
        let budget = watch.budget();
        let found = map(study, BTreeMap::new(), threads, &budget, &counter);
        let found =
            found.map_err(|what| Error::from(vec![dam::fault::Fault::new("", what, "")]))?;
        if !found.complete {
            return Err(interrupted("the map"));
        }
        let x = study.x.values();
        let y = study.y.as_ref().map(Axis::values).unwrap_or_default();
        let columns = columns(&found, &x, &y);
        let figure = (study.figure.clone(), study.unit.clone());
        let shape = (y.len(), x.len());
        let panels = study.panels.panels.iter();
        let panels = panels.map(|panel| panel.label.clone()).collect();
        Ok((found, shape, figure, study.hash.clone(), panels, columns))
    })?;
    Ok(Mapped {
        scene,
        question,
        result,
        shape,
        figure,
        hash,
        panels,
        columns,
    })
}

/// What a map will be: hash, numbers of values up and along, figure and unit, values along
/// and up.
pub(crate) type Planned = (String, (usize, usize), (String, String), Vec<f64>, Vec<f64>);

/// Plans a map, without working it out.
///
/// # Errors
/// As of [`ask`].
pub(crate) fn plan(scene: &Scene, wanted: Wanted) -> Result<Planned, Error> {
    wanted.question(scene).studied(|study| {
        let x = study.x.values();
        let y = study.y.as_ref().map(Axis::values).unwrap_or_default();
        let figure = (study.figure.clone(), study.unit.clone());
        Ok((study.hash.clone(), (y.len(), x.len()), figure, x, y))
    })
}

/// A cell: value, verdict, cause, how far it moves, whether it is determined, the verdict that a
/// run gives.
pub(crate) type ToldCell = (
    Option<f64>,
    String,
    String,
    Option<f64>,
    Option<bool>,
    Option<String>,
);

/// Verdict, cause, whether the value is determined, the verdict that a run gives.
pub(crate) type ToldVerdict = (String, String, Option<bool>, Option<String>);

/// Works out some cells of a map, counted row by row.
///
/// # Errors
/// As of [`ask`]; there are no such cells.
pub(crate) fn cells(
    scene: &Scene,
    wanted: Wanted,
    cells: Range<usize>,
    watch: &Watch,
) -> Result<Vec<ToldCell>, Error> {
    let threads = wanted.threads;
    wanted.question(scene).studied(|study| {
        let counter = Counter {
            watch,
            done: AtomicUsize::new(0),
            cells: cells.len() as f64,
        };
        let found = map_cells(study, cells, threads, &watch.budget(), &counter);
        let found =
            found.map_err(|what| Error::from(vec![dam::fault::Fault::new("", what, "")]))?;
        let found = found.ok_or_else(|| interrupted("the map"))?;
        Ok(found.iter().map(told).collect())
    })
}

fn told(cell: &Cell) -> ToldCell {
    let judgement = super::plain(&cell.verdict.judgement()).unwrap_or_default();
    (
        cell.value,
        cell.verdict.name().to_owned(),
        cell.cause.clone(),
        cell.moved,
        cell.determined,
        judgement.as_str().map(str::to_owned),
    )
}

/// Along, up, value, how far it moves: a row a cell.
fn columns(result: &MapResult, x: &[f64], y: &[f64]) -> [Vec<f64>; 4] {
    let mut columns: [Vec<f64>; 4] = Default::default();
    let cells = result.panels.iter().flatten();
    for (index, cell) in cells.enumerate() {
        let cell = cell.as_ref();
        let row = index / x.len().max(1);
        let up = y.get(row % y.len().max(1)).copied();
        let value = |number: Option<f64>| number.unwrap_or(f64::NAN);
        let along = x.get(index % x.len().max(1)).copied();
        columns[0].push(value(along));
        columns[1].push(value(up));
        columns[2].push(value(cell.and_then(|cell| cell.value)));
        columns[3].push(value(cell.and_then(|cell| cell.moved)));
    }
    columns
}

/// Counts the cells that are done.
struct Counter<'w> {
    watch: &'w Watch,
    done: AtomicUsize,
    cells: f64,
}

impl Listener for Counter<'_> {
    fn cell(&self) {
        let done = self.done.fetch_add(1, Ordering::Relaxed) + 1;
        self.watch.at(done as f64 / self.cells);
    }
}

impl Mapped {
    /// Verdict and cause of every cell, whether its value is determined, and the verdict that a
    /// run gives.
    pub(crate) fn verdicts(&self) -> Vec<ToldVerdict> {
        let cells = self.result.panels.iter().flatten().flatten();
        let told = cells.map(|cell: &Cell| {
            let (_, verdict, cause, _, determined, judgement) = told(cell);
            (verdict, cause, determined, judgement)
        });
        told.collect()
    }
}

impl Table for Mapped {
    fn heads(&self) -> Vec<(String, String)> {
        let head = |name: &str, unit: &str| (name.to_owned(), unit.to_owned());
        vec![
            head("x", ""),
            head("y", ""),
            head("value", &self.figure.1),
            head("moved", ""),
        ]
    }

    fn values(&self, index: usize) -> &[f64] {
        &self.columns[index]
    }
}

impl Told for Mapped {
    fn document(&self) -> Result<Value, Error> {
        self.question
            .studied(|study| Ok(document(study, &self.result)))
    }

    fn tell<T>(&self, to: impl FnOnce(&Findings<'_>) -> T) -> Result<T, Error> {
        self.question.studied(|study| {
            let source = Source {
                hashed: "the study",
                ..Source::scene(self.scene.json(), &study.hash)
            };
            let warnings = study.shortfalls.clone();
            Ok(to(&findings(study, &self.result, &[], warnings, source)))
        })
    }
}
