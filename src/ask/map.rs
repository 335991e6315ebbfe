//! Maps as arrays.

use super::Scene;
use crate::Error;
use crate::dynamics::record::Figure;
use crate::studies::Control;
use crate::studies::axis::Axis;
use crate::studies::map::{Cell, Listener, Panels, Question, Silent, Study, StudyFault, map};
use nalgebra::DMatrix;
use std::collections::BTreeMap;
use std::ops::Index;

/// A question for a map, to be completed and asked.
#[derive(Clone, Debug)]
#[must_use]
pub struct MapQuestion {
    scene: Scene,
    x: Axis,
    y: Option<Axis>,
    figure: Option<String>,
    check_determined: bool,
    digits: u8,
    threads: Option<usize>,
    panels: Vec<String>,
}

/// A figure over one or two parameters, with a verdict for every point.
#[derive(Clone, Debug)]
pub struct Map {
    /// Values of the parameter along the map, in the unit of its axis: one a column.
    pub x: Vec<f64>,
    /// Values of the parameter up the map: one a row; empty with one parameter, which
    /// makes a single row.
    pub y: Vec<f64>,
    /// Address of the figure: `rocker.delta_max`.
    pub figure: String,
    /// Unit of the figure; empty for counts and answers.
    pub unit: String,
    /// The points, row by row.
    pub cells: Vec<Cell>,
}

impl Scene {
    /// A map of a figure over a parameter: where does the mechanism work?
    ///
    /// ```
    /// # use dam::prelude::*;
    /// let scene = Scene::read("scenarios/rocker/two_masses.json")?;
    /// let map = scene
    ///     .map(Axis::linear("rocker.inertia", 0.05, 1.0, 3))
    ///     .up(Axis::log("rocker.stiffness", 1e6, 1e8, 2))
    ///     .figure("rocker", Figure::DeltaMax)
    ///     .ask()?;
    /// assert_eq!(map[(1, 2)].verdict, Verdict::ThrownOff);
    /// # Ok::<(), Error>(())
    /// ```
    pub fn map(&self, x: Axis) -> MapQuestion {
        MapQuestion {
            scene: self.clone(),
            x,
            y: None,
            figure: None,
            check_determined: true,
            digits: 3,
            threads: None,
            panels: Vec::new(),
        }
    }
}

impl MapQuestion {
    /// A second parameter, up the map.
    pub fn up(mut self, y: Axis) -> Self {
        self.y = Some(y);
        self
    }

    /// The figure; default: the greatest |δ| of the last elastic object.
    pub fn figure(mut self, object: &str, figure: Figure) -> Self {
        self.figure = Some(format!("{object}.{figure}"));
        self
    }

    /// The figure by its address: `rocker.delta_max`.
    pub fn figure_at(mut self, address: &str) -> Self {
        self.figure = Some(address.to_owned());
        self
    }

    /// Leaves out the second run of every cell that tells whether its figure is
    /// determined.
    pub fn unchecked(mut self) -> Self {
        self.check_determined = false;
        self
    }

    /// Digits to which a figure is to be known, so as to count as determined; default 3.
    pub fn digits(mut self, digits: u8) -> Self {
        self.digits = digits;
        self
    }

    /// Number of threads; default: one for every processor core. Results do not depend
    /// on it.
    pub fn threads(mut self, threads: usize) -> Self {
        self.threads = Some(threads);
        self
    }

    /// Several maps in one study, as of `dam map --panels`: `"rocker.masses=1,2"`; lists that go
    /// together are separated by semicolons, several texts multiply. They are looked at by
    /// [`Self::studied`].
    pub fn panels(mut self, texts: &[String]) -> Self {
        self.panels = texts.to_vec();
        self
    }

    /// Works out all points.
    ///
    /// # Errors
    /// The scene is wrong at every point that is tried beforehand, or the question is.
    /// What is wrong at single points is their verdict.
    pub fn ask(&self) -> Result<Map, Error> {
        self.ask_within(&Control::default(), &Silent)
    }

    /// Asks, heard of by a listener and ended from outside.
    ///
    /// # Errors
    /// As of [`Self::ask`]; it was ended before the last point, or by its listener.
    pub fn ask_within(&self, control: &Control<'_>, listener: &dyn Listener) -> Result<Map, Error> {
        self.studied(|study| {
            if study.panels.panels.len() > 1 {
                return Err(Error::question("a map of several panels is no single one"));
            }
            let found = map(study, BTreeMap::new(), self.threads, control, listener);
            let mut found = found.map_err(Error::question)?;
            let cells: Option<Vec<Cell>> = found.panels.swap_remove(0).into_iter().collect();
            Ok(Map {
                x: study.x.values(),
                y: study.y.as_ref().map(Axis::values).unwrap_or_default(),
                figure: study.figure.clone(),
                unit: study.unit.clone(),
                cells: cells.ok_or_else(|| Error::question("the map was interrupted"))?,
            })
        })
    }

    /// Shows the study behind the question, found to make sense: for single rows
    /// ([`map`] takes those that are known), journals, documents and pages.
    ///
    /// # Errors
    /// As of [`Self::ask`], and those of `look`.
    pub fn studied<T>(
        &self,
        look: impl FnOnce(&Study<'_>) -> Result<T, Error>,
    ) -> Result<T, Error> {
        for axis in std::iter::once(&self.x).chain(&self.y) {
            axis.check().map_err(Error::question)?;
        }
        let panels = Panels::parse(&self.panels).map_err(Error::question)?;
        let question = Question {
            overrides: self.scene.settings().arguments().to_vec(),
            x: self.x.clone(),
            y: self.y.clone(),
            panels,
            figure: self.figure.clone(),
            check_determined: self.check_determined,
            digits: self.digits,
        };
        self.scene.built_soundly()?;
        let document = self.scene.document();
        look(&Study::new(document, &**self.scene.catalogue(), question)?)
    }
}

impl Map {
    /// Number of rows and of columns.
    pub fn shape(&self) -> (usize, usize) {
        (self.y.len().max(1), self.x.len())
    }

    /// The points, a row at a time.
    pub fn rows(&self) -> impl Iterator<Item = &[Cell]> {
        self.cells.chunks(self.x.len().max(1))
    }

    /// The values as an array, rows by columns; where there is none (see the verdict
    /// there), `missing` stands for it.
    pub fn values(&self, missing: f64) -> DMatrix<f64> {
        let (rows, columns) = self.shape();
        DMatrix::from_fn(rows, columns, |row, column| {
            self[(row, column)].value.unwrap_or(missing)
        })
    }
}

impl Index<(usize, usize)> for Map {
    type Output = Cell;

    /// The point at (row, column).
    fn index(&self, (row, column): (usize, usize)) -> &Cell {
        assert!(column < self.x.len(), "column {column} of {}", self.x.len());
        &self.cells[row * self.x.len() + column]
    }
}

impl From<StudyFault> for Error {
    fn from(fault: StudyFault) -> Self {
        match fault {
            StudyFault::Scene(diagnostics) => (*diagnostics).into(),
            StudyFault::Question(what) => Self::question(what),
        }
    }
}
