//! Scenes prepared for many values of their parameters.

use super::Scene;
use crate::Error;
use crate::dynamics::model::Model;
use crate::dynamics::system::System;
use crate::fault::Fault;
use crate::frontend::diagnostics::{Diagnostic, Diagnostics, Sources};
use crate::frontend::lower::lower;
use crate::frontend::read::did_you_mean;
use crate::frontend::scene::{Catalogue, Document, Levels, Overrides, Reading, in_words};
use crate::studies::axis::Parameter;
use crate::studies::clock::not_followable;
use crate::studies::condition::Condition;
use crate::studies::lookup::is_rigid;
use crate::studies::prepared::{Point, PointQuestion, Prepared, finest_levels, shortfall};
use crate::studies::rigid::Rigid;
use crate::studies::{Control, RunSettings};
use nalgebra::DMatrix;
use std::ops::Index;
use std::sync::Arc;

/// Most wrong values of a table that are named.
const MOST_NAMED: usize = 10;

/// Most rows of a table.
const MOST_ROWS: usize = 10_000_000;

/// A scene prepared for many values of its parameters: see [`Scene::prepare_points`]. Several
/// threads may ask it at once.
#[derive(Debug)]
pub struct PreparedScene {
    prepared: Prepared<'static>,
    parameters: Vec<String>,
    parameter_units: Vec<String>,
    values: Vec<f64>,
    figure_units: Vec<String>,
    remarks: Vec<String>,
}

/// Points of a prepared scene, in the order of the rows of values.
#[derive(Clone, Debug, PartialEq)]
pub struct PointTable {
    /// The points.
    pub points: Vec<Point>,
    figures: usize,
}

/// Text of a scene with the settings made before, and where its objects are copied from.
pub(crate) struct PointSource<'s, 'a> {
    /// The text.
    pub(crate) document: &'s Document,
    /// Where its objects are copied from.
    pub(crate) catalogue: Arc<dyn Catalogue + Send + Sync + 'a>,
    /// The settings.
    pub(crate) settings: &'s [String],
}

/// Points of a scene, prepared.
pub(crate) struct PreparedPoints<'a> {
    /// The points.
    pub(crate) prepared: Prepared<'a>,
    /// SI units of the parameters; empty where none is known.
    pub(crate) parameter_units: Vec<String>,
    /// Values of the parameters in the scene itself (SI).
    pub(crate) values: Vec<f64>,
    /// SI units of the figures.
    pub(crate) figure_units: Vec<String>,
    /// What is to be known of the figures of all points.
    pub(crate) remarks: Vec<String>,
}

impl<'a> PointSource<'_, 'a> {
    /// Reads the scene with further settings.
    pub(crate) fn decode(&self, further: &[String]) -> Result<Reading, Diagnostics> {
        let all = self.settings.iter().chain(further).cloned();
        self.document.scene(&*self.catalogue, &Overrides::new(all))
    }

    /// Prepares the points.
    ///
    /// # Errors
    /// As of [`Scene::prepare_points`].
    pub(crate) fn prepare(
        &self,
        parameters: &[&str],
        figures: &[&str],
    ) -> Result<PreparedPoints<'a>, Error> {
        let reading = self.decode(&[])?;
        let system = system_of(&reading)?;
        let model = system.model();
        let mut faults = Vec::new();
        let values = numbers(&reading, parameters, &mut faults);
        let figure_units = units_of_figures(figures, model, &mut faults);
        if !faults.is_empty() {
            return Err(Diagnostics::new(Sources::default(), faults).into());
        }
        let asked: Vec<Parameter> = parameters.iter().map(|path| si_parameter(path)).collect();
        let parameter_units = asked.iter().map(|one| one.display_unit(model)).collect();
        let figures: Vec<String> = figures.iter().map(|&one| one.to_owned()).collect();
        let mut remarks = self.remarks(&reading, model, &figures)?;
        let levels = finest_levels(std::iter::once(reading), &figures);
        remarks.extend(remark_on_levels(&levels));
        let document = self.document.without_expectations().with_levels(levels);
        let question = PointQuestion {
            document: Arc::new(document),
            catalogue: Arc::clone(&self.catalogue),
            fixed: self.settings.to_vec(),
            parameters: asked,
            figures,
            digits: None,
        };
        // What the text of the scene does not take is seen here, and not at every point.
        question.check(&values)?;
        Ok(PreparedPoints {
            prepared: Prepared::new(question),
            parameter_units,
            values,
            figure_units,
            remarks,
        })
    }

    /// What is to be known of the figures of all points.
    fn remarks(
        &self,
        reading: &Reading,
        model: &Model,
        figures: &[String],
    ) -> Result<Vec<String>, Error> {
        let rigid: Vec<&str> = (figures.iter().map(String::as_str))
            .filter(|figure| is_rigid(figure))
            .collect();
        let label = Rigid::label(model, &["dam run"]).filter(|_| !rigid.is_empty());
        let what = match rigid.as_slice() {
            [one] => format!("{one} is"),
            several => format!("{} are", several.join(", ")),
        };
        let mut remarks: Vec<String> = label.iter().map(|label| label.words(&what)).collect();
        if reading.scene.run.accuracy.is_some() {
            for figure in figures {
                // (The levels of a scene are set while it is judged.)
                remarks.extend(shortfall(self.decode(&[])?.scene, figure));
            }
        }
        Ok(remarks)
    }
}

impl PreparedScene {
    /// Prepares a scene.
    ///
    /// # Errors
    /// As of [`Scene::prepare_points`].
    pub(super) fn of(scene: &Scene, parameters: &[&str], figures: &[&str]) -> Result<Self, Error> {
        let found = scene.point_source()?.prepare(parameters, figures)?;
        Ok(Self {
            parameters: parameters.iter().map(|&one| one.to_owned()).collect(),
            prepared: found.prepared,
            parameter_units: found.parameter_units,
            values: found.values,
            figure_units: found.figure_units,
            remarks: found.remarks,
        })
    }

    /// With a second run of each point, with loads and gaps changed by one part in 10¹⁰, that
    /// shows whether its figures are determined to so many digits.
    #[must_use]
    pub fn check_determined(mut self, digits: u8) -> Self {
        self.prepared.question.digits = Some(digits);
        self
    }

    /// Addresses of the parameters.
    pub fn parameters(&self) -> &[String] {
        &self.parameters
    }

    /// SI units of the parameters; empty where none is known.
    pub fn parameter_units(&self) -> &[String] {
        &self.parameter_units
    }

    /// Values of the parameters in the scene itself (SI).
    pub fn values(&self) -> &[f64] {
        &self.values
    }

    /// Addresses of the figures.
    pub fn figures(&self) -> &[String] {
        &self.prepared.question.figures
    }

    /// SI units of the figures; empty of counts, answers and pure numbers.
    pub fn figure_units(&self) -> &[String] {
        &self.figure_units
    }

    /// Levels of the objects that leave theirs open.
    pub fn levels(&self) -> &Levels {
        self.prepared.question.levels()
    }

    /// What is to be known of the figures of all points, a line each: levels that were chosen,
    /// an accuracy that is missed, elastic objects that a figure takes for rigid.
    pub fn remarks(&self) -> &[String] {
        &self.remarks
    }

    /// The point at values of the parameters, one for each, in SI units. What cannot be run
    /// there is a point without values, with its verdict and cause.
    ///
    /// # Errors
    /// Another number of values than of parameters; values that are not finite.
    pub fn at(&self, values: &[f64]) -> Result<Point, Error> {
        self.at_within(values, &Control::default())
    }

    /// The same, ended from outside.
    ///
    /// # Errors
    /// As of [`Self::at`]; it was ended.
    pub fn at_within(&self, values: &[f64], control: &Control<'_>) -> Result<Point, Error> {
        self.refuse_wrong(&[values])?;
        let point = self.prepared.point(values, control);
        point.ok_or_else(|| Error::question("the point was interrupted"))
    }

    /// The points at rows of values, on all threads.
    ///
    /// # Errors
    /// As of [`Self::at`], with all rows that are wrong.
    pub fn table(&self, rows: &[impl AsRef<[f64]> + Sync]) -> Result<PointTable, Error> {
        self.table_within(rows, None, &Control::default(), &|_| {})
    }

    /// The same on a number of threads (`None`: one for every processor core), on which results
    /// do not depend; ended from outside. `heard` receives the number of points done,
    /// from any thread.
    ///
    /// # Errors
    /// As of [`Self::table`]; it was ended before the last point.
    pub fn table_within(
        &self,
        rows: &[impl AsRef<[f64]> + Sync],
        threads: Option<usize>,
        control: &Control<'_>,
        heard: &(dyn Fn(usize) + Sync),
    ) -> Result<PointTable, Error> {
        self.refuse_wrong(rows)?;
        let points = self.prepared.table(rows, threads, control, heard);
        Ok(PointTable {
            points: points.ok_or_else(|| Error::question("the table was interrupted"))?,
            figures: self.figures().len(),
        })
    }

    /// Refuses rows of values that are no values of the parameters.
    fn refuse_wrong(&self, rows: &[impl AsRef<[f64]>]) -> Result<(), Error> {
        if rows.len() > MOST_ROWS {
            return Err(Error::question(format!(
                "{} points are wanted, and a table has at most {MOST_ROWS}",
                rows.len()
            )));
        }
        let all = rows.iter().enumerate();
        let wrong = all.flat_map(|(row, values)| self.wrong_values(row, values.as_ref()));
        let mut wrong: Vec<Diagnostic> = wrong.take(MOST_NAMED + 1).collect();
        if wrong.is_empty() {
            return Ok(());
        }
        if wrong.len() > MOST_NAMED {
            wrong[MOST_NAMED] = Diagnostic::error("question", "and further values");
        }
        Err(Diagnostics::new(Sources::default(), wrong).into())
    }

    fn wrong_values(&self, row: usize, values: &[f64]) -> Vec<Diagnostic> {
        let (found, wanted) = (values.len(), self.parameters.len());
        if found != wanted {
            let message =
                format!("point {row} has {found} values, and there are {wanted} parameters");
            let hint = format!("give one for each of {}", self.parameters.join(", "));
            return vec![Diagnostic::error("question", message).hint(hint)];
        }
        let each = self.parameters.iter().zip(values);
        let wrong = each.filter(|(_, value)| !value.is_finite());
        let fault = |(path, value): (&String, &f64)| {
            let message = format!("point {row}: the value of `{path}` is {value}");
            Diagnostic::error("question", message).hint("give finite numbers in SI units")
        };
        wrong.map(fault).collect()
    }
}

impl PointTable {
    /// The values as an array, a row a point, a column a figure; where there is none (see the
    /// verdict there), `missing` stands for it.
    pub fn values(&self, missing: f64) -> DMatrix<f64> {
        DMatrix::from_fn(self.points.len(), self.figures, |row, column| {
            self.points[row].value(column).unwrap_or(missing)
        })
    }
}

impl Index<usize> for PointTable {
    type Output = Point;

    fn index(&self, row: usize) -> &Point {
        &self.points[row]
    }
}

/// The system at the scene's own values.
pub(super) fn system_of(reading: &Reading) -> Result<System, Error> {
    let diagnose = |faults: Vec<Fault>| reading.places.diagnose(&faults);
    let model = lower(&reading.scene).map_err(diagnose)?;
    let settings = RunSettings::of(&reading.scene).map_err(|fault| diagnose(vec![fault]))?;
    let faults = not_followable(&model, &settings);
    if !faults.is_empty() {
        return Err(diagnose(faults).into());
    }
    Ok(System::new(model).map_err(diagnose)?)
}

fn si_parameter(path: &str) -> Parameter {
    Parameter {
        path: path.trim().to_owned(),
        unit: String::new(),
    }
}

/// The numbers at addresses; what is wrong with these is added to the faults.
pub(super) fn numbers(reading: &Reading, paths: &[&str], faults: &mut Vec<Diagnostic>) -> Vec<f64> {
    if paths.is_empty() {
        let hint = "name numbers of the scene, for example rocker.inertia";
        faults.push(Diagnostic::error("question", "there are no parameters").hint(hint));
    }
    let mut values = Vec::with_capacity(paths.len());
    for (at, path) in paths.iter().enumerate() {
        if paths[..at].iter().any(|other| reading.is_same(other, path)) {
            let message = format!("the parameter `{path}` is named twice");
            faults.push(Diagnostic::error("question", message).hint("name it once"));
            continue;
        }
        match reading.number(path) {
            Ok(value) => values.push(value),
            Err(Some(instead)) => {
                let message = format!("`{path}` is {instead}, and a parameter is a number");
                faults.push(Diagnostic::error("question", message).hint(match instead {
                    "a group of properties" | "a list" => "name one of its numbers",
                    _ => "compare such values by `compare`",
                }));
            }
            Err(None) => {
                let message = format!("the scene has no number `{path}`");
                let known = reading.number_addresses();
                let close = did_you_mean(path, known.iter().map(String::as_str));
                let other = || "write it into the scene first, or name another one".to_owned();
                let fault = Diagnostic::error("unknown-name", message);
                faults.push(fault.hint(close.unwrap_or_else(other)));
            }
        }
    }
    values
}

/// SI units of figures; what is wrong with these is added to the faults.
fn units_of_figures(figures: &[&str], model: &Model, faults: &mut Vec<Diagnostic>) -> Vec<String> {
    if figures.is_empty() {
        let hint = "name results, for example rocker.delta_max";
        faults.push(Diagnostic::error("question", "there are no figures").hint(hint));
    }
    let mut units = Vec::with_capacity(figures.len());
    for (at, figure) in figures.iter().enumerate() {
        if figures[..at].contains(figure) {
            let message = format!("the figure `{figure}` is named twice");
            faults.push(Diagnostic::error("question", message).hint("name it once"));
            continue;
        }
        match Condition::unit_of(figure, model) {
            Ok(unit) => units.push(unit),
            Err(what) => faults.push(Diagnostic::error("unknown-name", what)),
        }
    }
    units
}

fn remark_on_levels(levels: &Levels) -> Option<String> {
    (!levels.is_empty()).then(|| {
        format!(
            "levels chosen at the scene's own values hold at all points: {}",
            in_words(levels)
        )
    })
}
