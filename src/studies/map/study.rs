//! What is asked: a scene, axes, panels and a figure, checked before any run.

use super::default_figure::{default_figure, no_elastic_object_message};
use super::panels::{Panel, Panels};
use crate::dynamics::system::System;
use crate::frontend::diagnostics::Diagnostics;
use crate::frontend::lower::lower;
use crate::frontend::scene::{Catalogue, Document, Levels, Overrides, Reading};
use crate::studies::RunSettings;
use crate::studies::axis::Axis;
use crate::studies::lookup::is_rigid;
use crate::studies::prepared::{
    PointQuestion, check_figure, figure_unit, finest_levels, shortfall,
};
use crate::studies::rigid::Rigid;
use serde_json::json;
use sha2::{Digest, Sha256};
use std::fmt::Write as _;
use std::sync::Arc;

/// Most cells of a study, all panels together.
pub const MOST_CELLS: usize = 1_000_000;

/// Cells of a row when there is one axis only.
const STRETCH: usize = 8;

/// Question that a map asks of a scene.
#[derive(Clone, Debug)]
pub struct Question {
    /// Settings made before everything else.
    pub overrides: Vec<String>,
    /// The parameter along the map.
    pub x: Axis,
    /// The parameter up the map; `None`: a curve.
    pub y: Option<Axis>,
    /// The maps.
    pub panels: Panels,
    /// Address of the figure; `None`: the greatest |δ| of the last elastic object.
    pub figure: Option<String>,
    /// True: every cell is run a second time with its loads changed by one part
    /// in 10¹⁰, to see whether its figure is determined.
    pub check_determined: bool,
    /// Digits to which a figure is to be known, so as to count as determined.
    pub digits: u8,
}

/// A question about a scene, found to make sense.
pub struct Study<'a> {
    document: Document,
    /// What is asked at the cells of each panel.
    questions: Vec<PointQuestion<'a>>,
    catalogue: &'a (dyn Catalogue + Sync),
    overrides: Vec<String>,
    x_values: Vec<f64>,
    y_values: Vec<f64>,
    /// Name of the scene.
    pub scene: String,
    /// The parameter along the map.
    pub x: Axis,
    /// The parameter up the map; `None`: a curve.
    pub y: Option<Axis>,
    /// The maps.
    pub panels: Panels,
    /// Address of the figure.
    pub figure: String,
    /// SI unit; empty for counts and answers.
    pub unit: String,
    /// Units in which the x and the y parameter are written: those of the axes,
    /// else the SI unit where it is known, else empty.
    pub parameter_units: [String; 2],
    /// See [`Question::check_determined`].
    pub check_determined: bool,
    /// See [`Question::digits`].
    pub digits: u8,
    /// SHA-256 (hex) of everything that the results depend on: version of the
    /// program, text of the scene, what its `from` copies, and the question.
    pub hash: String,
    /// Levels chosen for objects that leave theirs open: the finest that the figure needs
    /// at the corners and in the middle of the panels.
    pub levels: Levels,
    /// The label of a figure of another study, which takes elastic objects for rigid.
    pub rigid: Option<Rigid>,
    /// Points at which the figure does not hold the accuracy that the scene asks for: of those
    /// that are tried beforehand.
    pub shortfalls: Vec<String>,
}

/// Why a question makes no sense.
#[derive(Debug)]
pub enum StudyFault {
    /// The scene is wrong, at every point of a map that was tried.
    Scene(Box<Diagnostics>),
    /// The question is wrong.
    Question(String),
}

impl<'a> Study<'a> {
    /// Checks a question: a panel must be a mechanism at one of its corners or
    /// in its middle, and the figure must exist. Points inside may still be
    /// refused, each by itself.
    ///
    /// # Errors
    /// A scene that is wrong at all those points, a figure that does not
    /// exist, a parameter on both axes, too many cells.
    pub fn new(
        document: &Document,
        catalogue: &'a (dyn Catalogue + Sync),
        question: Question,
    ) -> Result<Self, StudyFault> {
        check(&question).map_err(StudyFault::Question)?;
        let mut study = Self {
            document: document.clone(),
            questions: Vec::new(),
            catalogue,
            overrides: question.overrides,
            x_values: question.x.values(),
            y_values: question.y.as_ref().map(Axis::values).unwrap_or_default(),
            scene: String::new(),
            x: question.x,
            y: question.y,
            panels: question.panels,
            figure: question.figure.unwrap_or_default(),
            unit: String::new(),
            parameter_units: Default::default(),
            check_determined: question.check_determined,
            digits: question.digits,
            hash: String::new(),
            levels: Levels::new(),
            rigid: None,
            shortfalls: Vec::new(),
        };
        let mut hashes = Vec::new();
        for panel in 0..study.panels.panels.len() {
            let (reading, system) = study.probe(panel)?;
            if study.figure.is_empty() {
                study.figure = study.default_figure(panel, &reading, &system)?;
            }
            study.check_figure(&system)?;
            study.scene.clone_from(&reading.scene.name);
            hashes.push(reading.scene.hash);
        }
        let figures = std::slice::from_ref(&study.figure);
        study.levels = finest_levels(study.probed(), figures);
        study.document = study.document.clone().with_levels(study.levels.clone());
        study.questions = study.questions_of_panels();
        study.hash = study.digest(&hashes);
        study.rigid = study.label();
        study.shortfalls = study.inaccurate();
        Ok(study)
    }

    /// What is asked at the cells of each panel.
    fn questions_of_panels(&self) -> Vec<PointQuestion<'a>> {
        let bare = Arc::new(self.document.without_expectations());
        let panels = self.panels.panels.iter();
        let question = |panel: &Panel| PointQuestion {
            document: bare.clone(),
            catalogue: Arc::new(self.catalogue),
            fixed: self
                .overrides
                .iter()
                .chain(&panel.settings)
                .cloned()
                .collect(),
            parameters: std::iter::once(&self.x)
                .chain(&self.y)
                .map(Axis::parameter)
                .collect(),
            figures: vec![self.figure.clone()],
            digits: self.check_determined.then_some(self.digits),
        };
        panels.map(question).collect()
    }

    /// The points, of those that are tried beforehand, at which the figure does not hold the
    /// accuracy that the scene asks for.
    fn inaccurate(&self) -> Vec<String> {
        let panels = 0..self.panels.panels.len();
        let all = panels.flat_map(|panel| self.points().map(|cell| (panel, cell)));
        let mut points: Vec<(usize, usize)> = all.collect();
        points.sort_unstable();
        points.dedup();
        let found = points.into_iter().filter_map(|(panel, cell)| {
            let (reading, _) = self.try_cell(panel, cell).ok()?;
            let what = shortfall(reading.scene, &self.figure)?;
            Some(format!("{}: {what}", self.settings(panel, cell).join(", ")))
        });
        found.collect()
    }

    /// The label of the figure, where objects are elastic at any of the points that are tried
    /// beforehand.
    fn label(&self) -> Option<Rigid> {
        let panels = 0..self.panels.panels.len();
        let all = panels.flat_map(|panel| self.points().map(|cell| (panel, cell)));
        let mut all = all.filter_map(|(panel, cell)| self.try_cell(panel, cell).ok());
        match is_rigid(&self.figure) {
            true => all.find_map(|(_, system)| Rigid::label(system.model(), &["dam run"])),
            false => None,
        }
    }

    /// Cells of a panel that are tried beforehand: its corners and its middle.
    fn points(&self) -> [usize; 5] {
        let (columns, rows) = (self.columns(), self.cells_in_panel() / self.columns());
        let (last, top) = (columns - 1, rows - 1);
        let points = [
            (0, 0),
            (last, top),
            (last, 0),
            (0, top),
            (last / 2, top / 2),
        ];
        points.map(|(column, row)| row * columns + column)
    }

    /// The scenes at the points that are tried beforehand, of all panels.
    fn probed(&self) -> impl Iterator<Item = Reading> + '_ {
        let panels = 0..self.panels.panels.len();
        let all = panels.flat_map(|panel| self.points().map(|cell| (panel, cell)));
        all.filter_map(|(panel, cell)| Some(self.try_cell(panel, cell).ok()?.0))
    }

    /// The first of a panel's corners and its middle that is a mechanism.
    fn probe(&self, panel: usize) -> Result<(Reading, System), StudyFault> {
        let mut first = None;
        for cell in self.points() {
            match self.try_cell(panel, cell) {
                Ok(found) => return Ok(found),
                Err(diagnostics) => first = first.or(Some(diagnostics)),
            }
        }
        Err(StudyFault::Scene(Box::new(first.unwrap_or_default())))
    }

    /// δ_max of the last elastic object, at the first of a panel's points where
    /// something is elastic: the number of masses may be on an axis, from 0 on.
    fn default_figure(
        &self,
        panel: usize,
        reading: &Reading,
        system: &System,
    ) -> Result<String, StudyFault> {
        let of = |reading: &Reading, system: &System| {
            default_figure(system.model(), &reading.scene.order())
        };
        if let Some(found) = of(reading, system) {
            return Ok(found);
        }
        let others = self.points().into_iter();
        let mut others = others.filter_map(|cell| self.try_cell(panel, cell).ok());
        others
            .find_map(|(reading, system)| of(&reading, &system))
            .ok_or_else(|| StudyFault::Question(no_elastic_object_message(system.model())))
    }

    fn try_cell(&self, panel: usize, cell: usize) -> Result<(Reading, System), Diagnostics> {
        let settings = self.settings(panel, cell);
        let all = self.overrides.iter().cloned().chain(settings);
        let reading = self.document.scene(self.catalogue, &Overrides::new(all))?;
        let diagnose = |faults: Vec<crate::fault::Fault>| reading.places.diagnose(&faults);
        let model = lower(&reading.scene).map_err(diagnose)?;
        let system = System::new(model).map_err(diagnose)?;
        RunSettings::of(&reading.scene).map_err(|fault| diagnose(vec![fault]))?;
        Ok((reading, system))
    }

    fn check_figure(&mut self, system: &System) -> Result<(), StudyFault> {
        let model = system.model();
        check_figure(&self.figure, model).map_err(|fault| {
            let hint = match fault.hint.is_empty() {
                true => "write object.result, for example rocker.delta_abs",
                false => fault.hint.as_str(),
            };
            StudyFault::Question(format!("{}; {hint}", fault.message))
        })?;
        self.unit = figure_unit(&self.figure, model);
        let written = |axis: &Axis| axis.display_unit(model);
        self.parameter_units = [
            written(&self.x),
            self.y.as_ref().map(written).unwrap_or_default(),
        ];
        Ok(())
    }

    fn digest(&self, hashes: &[String]) -> String {
        let all = json!({
            "version": env!("CARGO_PKG_VERSION"),
            "text": self.document.text(),
            "scenes": hashes,
            "overrides": self.overrides,
            "x": self.x,
            "y": self.y,
            "panels": self.panels,
            "figure": self.figure,
            "check_determined": self.check_determined,
            "digits": self.digits,
            "levels": self.levels,
        });
        let mut hash = String::new();
        for byte in Sha256::digest(all.to_string().as_bytes()) {
            // Writing to a string cannot fail.
            let _ = write!(hash, "{byte:02x}");
        }
        hash
    }

    /// What is asked at the cells of a panel.
    pub(super) fn question(&self, panel: usize) -> &PointQuestion<'a> {
        &self.questions[panel]
    }

    /// Settings of a cell, counted along the x axis first.
    pub fn settings(&self, panel: usize, cell: usize) -> Vec<String> {
        let mut settings = self.panels.panels[panel].settings.clone();
        let (x, y) = self.parameters_at_cell(cell);
        let second = self.y.as_ref().zip(y);
        settings.push(self.x.setting(x));
        settings.extend(second.map(|(axis, y)| axis.setting(y)));
        settings
    }

    /// Values of the parameters at a cell, in the units of the axes.
    pub fn parameters_at_cell(&self, cell: usize) -> (f64, Option<f64>) {
        let columns = self.columns();
        (
            self.x_values[cell % columns],
            self.y_values.get(cell / columns).copied(),
        )
    }

    /// Cells along the x axis.
    pub fn columns(&self) -> usize {
        self.x_values.len()
    }

    /// Cells of a panel.
    pub fn cells_in_panel(&self) -> usize {
        self.columns() * self.y_values.len().max(1)
    }

    /// Cells of all panels.
    pub fn cells(&self) -> usize {
        self.cells_in_panel() * self.panels.panels.len()
    }

    /// Cells of a row, the unit of work that is finished and kept as a whole.
    pub fn cells_in_row(&self) -> usize {
        match self.y {
            Some(_) => self.columns(),
            None => STRETCH.min(self.columns()),
        }
    }

    /// Rows of a panel.
    pub fn rows_in_panel(&self) -> usize {
        self.cells_in_panel().div_ceil(self.cells_in_row())
    }

    /// Rows of all panels.
    pub fn rows(&self) -> usize {
        self.rows_in_panel() * self.panels.panels.len()
    }

    /// Panel of a row, and its cells in that panel.
    pub fn row(&self, row: usize) -> (usize, std::ops::Range<usize>) {
        let (panel, row) = (row / self.rows_in_panel(), row % self.rows_in_panel());
        let from = row * self.cells_in_row();
        let to = (from + self.cells_in_row()).min(self.cells_in_panel());
        (panel, from..to)
    }
}

impl std::fmt::Debug for Study<'_> {
    fn fmt(&self, f: &mut std::fmt::Formatter<'_>) -> std::fmt::Result {
        f.debug_struct("Study")
            .field("scene", &self.scene)
            .field("figure", &self.figure)
            .field("x", &self.x)
            .field("y", &self.y)
            .field("panels", &self.panels)
            .finish_non_exhaustive()
    }
}

fn check(question: &Question) -> Result<(), String> {
    let rows = question.y.as_ref().map_or(1, |axis| axis.count);
    let panels = question.panels.panels.len();
    let cells = question.x.count as u128 * rows as u128 * panels as u128;
    if cells > MOST_CELLS as u128 {
        return Err(format!(
            "{cells} cells are wanted, and at most {MOST_CELLS} are worked out at a time; \
             take fewer values on the axes"
        ));
    }
    let path = &question.x.path;
    if question.y.as_ref().is_some_and(|axis| axis.path == *path) {
        return Err(format!(
            "`{path}` is on both axes; take another parameter for one of them"
        ));
    }
    let fixed = |setting: &&String| {
        let own = setting.split('=').next().unwrap_or("").trim();
        own == path || question.y.as_ref().is_some_and(|axis| axis.path == own)
    };
    let mut settings = question
        .panels
        .panels
        .iter()
        .flat_map(|panel| &panel.settings);
    match settings.find(fixed) {
        Some(setting) => Err(format!("the panels set `{setting}`, which is on an axis")),
        None => Ok(()),
    }
}
