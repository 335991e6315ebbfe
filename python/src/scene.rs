//! Scenes as Python holds them.

use crate::answer::Answer;
use crate::fault;
use crate::prepared::{Prepared, prepare};
use crate::studies::linkages::LinkageCourse;
use crate::studies::{
    cam, compare, find, gradient, identify, law, linear, linkages, map, methods, optimize, reduce,
    run, show, steady, tolerance,
};
use crate::tree::node;
use crate::work::{Terms, compute, compute_here, directly};
use dam::ask::{
    CamQuestion, FindQuestion, GradientQuestion, IdentifyQuestion, MeasuredRecord, ModelAssessment,
    OptimizeQuestion, StrokeQuestion, ToleranceQuestion,
};
use dam::diagnostics::{Diagnostic, Diagnostics};
use dam::linkage::kinetostatics::Convention;
use dam::motion::stroke::{Criterion, Skewness};
use dam::object::law::read_argument;
use dam::read::{Bounds, QuantityChoice};
use dam::scene::{Document, Folder, schema as schema_of_kinds, schema_text};
use dam::studies::Control;
use dam::studies::axis::Axis;
use dam::studies::cam::Reserve;
use dam::studies::find::Aim;
use dam::studies::forces::ForceChoice;
use dam::studies::linear::ResponseQuestion;
use dam::studies::methods::all_methods;
use dam::studies::orders::OrdersQuestion;
use dam::units::quantities as q;
use dam::{Error, Mechanism};
use pyo3::exceptions::PyValueError;
use pyo3::prelude::*;
use pyo3::types::PyList;
use std::path::PathBuf;
use std::sync::Arc;
use std::time::Duration;

/// A scene.
#[pyclass(frozen, module = "dam._dam")]
pub(crate) struct Scene {
    scene: Arc<dam::Scene>,
}

impl Scene {
    fn of(scene: dam::Scene) -> Self {
        Self {
            scene: Arc::new(scene),
        }
    }

    /// The scene for whoever works on a question; nothing is copied.
    fn asked(&self) -> Arc<dam::Scene> {
        Arc::clone(&self.scene)
    }

    /// A scene of one's own.
    fn copy(&self) -> dam::Scene {
        dam::Scene::clone(&self.scene)
    }
}

/// What is not to be answered, in words.
fn wrong(what: impl Into<String>) -> Error {
    vec![dam::fault::Fault::new("", what.into(), "")].into()
}

/// A quantity: a number in SI units, or a text with its unit.
fn quantity(
    name: &str,
    value: Option<String>,
    wanted: impl Into<QuantityChoice>,
    bounds: Bounds,
) -> Result<Option<f64>, Error> {
    let Some(text) = value else {
        return Ok(None);
    };
    let wanted = wanted.into();
    let read = read_argument(name, &text, |slot| slot.quantity(wanted, bounds));
    Ok(Some(read?))
}

/// The scene with a setting as the program takes it, `PATH=VALUE`.
///
/// # Errors
/// There is no `=`.
pub(crate) fn with_setting(scene: dam::Scene, setting: &str) -> Result<dam::Scene, Error> {
    let (address, value) = setting
        .split_once('=')
        .ok_or_else(|| wrong(format!("`{setting}` is no setting: no `=`")))?;
    let parsed = serde_json::from_str::<serde_json::Value>(value);
    let value = parsed.unwrap_or_else(|_| value.into());
    Ok(scene.set(address, tree_of(&value)))
}

/// Numbers of samples and of threads that make sense.
const MOST_THREADS: usize = 1024;

#[pymethods]
impl Scene {
    /// Reads a file.
    #[staticmethod]
    fn read(py: Python<'_>, path: PathBuf) -> PyResult<Self> {
        directly(py, || dam::Scene::read(path)).map(Self::of)
    }

    /// Reads a text. `folder` holds the catalogue, and lies beside the tables of the scene.
    #[staticmethod]
    #[pyo3(signature = (text, name, folder=None))]
    fn parse(py: Python<'_>, text: &str, name: &str, folder: Option<PathBuf>) -> PyResult<Self> {
        directly(py, || {
            let scene = dam::Scene::of(Document::parse(name, text.as_bytes())?);
            Ok(match folder {
                Some(path) => scene.with_catalogue(Folder::beside_scene(&path)),
                None => scene,
            })
        })
        .map(Self::of)
    }

    /// Of a tree of values.
    #[staticmethod]
    fn of_tree(py: Python<'_>, tree: &Bound<'_, PyAny>) -> PyResult<Self> {
        let root = node(tree)?;
        directly(py, || Ok(dam::Scene::of(Document::of_values(root)))).map(Self::of)
    }

    fn set(&self, py: Python<'_>, address: &str, value: &Bound<'_, PyAny>) -> PyResult<Self> {
        let value = node(value)?;
        directly(py, || Ok(self.copy().set(address, value))).map(Self::of)
    }

    fn set_all(&self, py: Python<'_>, settings: Vec<String>) -> PyResult<Self> {
        directly(py, || {
            let mut scene = self.copy();
            for setting in settings {
                scene = with_setting(scene, &setting)?;
            }
            Ok(scene)
        })
        .map(Self::of)
    }

    #[getter]
    fn json(&self) -> &str {
        self.scene.json()
    }

    #[getter]
    fn settings(&self) -> Vec<String> {
        self.scene.settings().arguments().to_vec()
    }

    /// Name and hash of the canonical scene.
    fn identity(&self, py: Python<'_>) -> PyResult<(String, String)> {
        directly(py, || {
            let scene = self.scene.decode()?.scene;
            Ok((scene.name, scene.hash))
        })
    }

    /// What is wrong, and what its user should know: faults.
    fn check<'py>(&self, py: Python<'py>) -> PyResult<Bound<'py, PyList>> {
        let scene = self.asked();
        let found = compute(py, &Terms::default(), move |_| {
            let ready = scene.decode().and_then(|reading| {
                Mechanism::of_within(reading, ModelAssessment::Never, &Control::default())
            });
            Ok(match ready {
                Ok(ready) => {
                    let doubts = ready.model().warnings.iter();
                    let doubts = doubts.map(|line| Diagnostic::warning("model", line.as_str()));
                    let told = &ready.reading.warnings;
                    let all = told.items.iter().cloned().chain(doubts);
                    Diagnostics::new(told.sources.clone(), all.collect())
                }
                Err(error) => error.into_diagnostics(),
            })
        })?;
        fault::faults(py, &found)
    }

    fn run(&self, py: Python<'_>, spread: bool, terms: Terms) -> PyResult<(Answer, bool)> {
        let scene = self.asked();
        let found = compute_here(py, &terms, |watch| run::ask(scene, spread, watch))?;
        let trusted = found.is_trusted();
        Ok((Answer::new(found), trusted))
    }

    /// The models of the scene in words, as a picture or as equations.
    fn show(&self, py: Python<'_>, view: &str, form: &str) -> PyResult<String> {
        let (view, form) = (show::part(view)?, show::form(form)?);
        let scene = self.asked();
        compute(py, &Terms::default(), move |_| {
            show::ask(&scene, view, form)
        })
    }

    /// The same as a document.
    fn shown(&self, py: Python<'_>) -> PyResult<String> {
        let scene = self.asked();
        compute(py, &Terms::default(), move |_| show::document_of(&scene))
    }

    /// The text of the scene with its settings, its copies and its tables in it.
    fn written(&self, py: Python<'_>) -> PyResult<String> {
        directly(py, || {
            let reading = self.scene.decode()?;
            Ok(self
                .scene
                .document()
                .decoded(&reading.places)
                .text()
                .to_owned())
        })
    }

    /// Least time (s) that so many runs take that Rust asks for: what a run costs without Python.
    fn least_time(&self, py: Python<'_>, repeats: usize) -> PyResult<f64> {
        if !(1..=1000).contains(&repeats) {
            return Err(PyValueError::new_err("between 1 and 1000 runs are timed"));
        }
        let scene = self.asked();
        compute(py, &Terms::default(), move |watch| {
            run::least_time(&scene, repeats, watch)
        })
    }

    #[pyo3(signature = (address, values, terms))]
    fn compare(
        &self,
        py: Python<'_>,
        address: String,
        values: Vec<Bound<'_, PyAny>>,
        terms: Terms,
    ) -> PyResult<Answer> {
        let scene = self.asked();
        let values: PyResult<Vec<_>> = values.iter().map(node).collect();
        let values = values?;
        let found = compute(py, &terms, move |watch| {
            compare::ask(scene, &address, values, watch)
        })?;
        let columns = found.columns();
        Ok(Answer::with_columns(found, columns))
    }

    #[pyo3(signature = (parameters, figures, digits))]
    fn prepare(
        &self,
        py: Python<'_>,
        parameters: Vec<String>,
        figures: Vec<String>,
        digits: Option<u8>,
    ) -> PyResult<Prepared> {
        prepare(py, self.asked(), (parameters, figures), digits)
    }

    #[pyo3(signature = (x, y, figure, check, digits, threads, panels, terms))]
    #[allow(
        clippy::too_many_arguments,
        reason = "these are what a map is asked by; the stub names them"
    )]
    fn map(
        &self,
        py: Python<'_>,
        x: &str,
        y: Option<&str>,
        figure: Option<String>,
        check: bool,
        digits: u8,
        threads: Option<usize>,
        panels: Vec<String>,
        terms: Terms,
    ) -> PyResult<MapAnswer> {
        let mut wanted = wanted(py, (x, y), figure, check, digits, threads)?;
        wanted.panels = panels;
        let scene = self.asked();
        let found = compute(py, &terms, move |watch| map::ask(scene, wanted, watch))?;
        let (shape, figure) = (found.shape, found.figure.clone());
        let (hash, verdicts) = (found.hash.clone(), found.verdicts());
        let panels = found.panels.clone();
        Ok((Answer::new(found), shape, figure, hash, verdicts, panels))
    }

    /// What a map will be, without working it out.
    #[pyo3(signature = (x, y, figure, check, digits))]
    fn map_plan(
        &self,
        py: Python<'_>,
        x: &str,
        y: Option<&str>,
        figure: Option<String>,
        check: bool,
        digits: u8,
    ) -> PyResult<map::Planned> {
        let wanted = wanted(py, (x, y), figure, check, digits, None)?;
        let scene = self.asked();
        compute(py, &Terms::default(), move |_| map::plan(&scene, wanted))
    }

    /// Some cells of a map, by one thread.
    #[pyo3(signature = (x, y, figure, check, digits, first, last))]
    #[allow(
        clippy::too_many_arguments,
        reason = "these are what a map is asked by; the stub names them"
    )]
    fn map_cells(
        &self,
        py: Python<'_>,
        x: &str,
        y: Option<&str>,
        figure: Option<String>,
        check: bool,
        digits: u8,
        first: usize,
        last: usize,
    ) -> PyResult<Vec<map::ToldCell>> {
        let wanted = wanted(py, (x, y), figure, check, digits, Some(1))?;
        let scene = self.asked();
        compute(py, &Terms::default(), move |watch| {
            map::cells(&scene, wanted, first..last, watch)
        })
    }

    #[pyo3(signature = (accuracy, methods, tolerances, steps, repeats, point_limit, models, x, terms))]
    #[allow(
        clippy::too_many_arguments,
        reason = "these are what a study is asked by; the stub names them"
    )]
    fn methods(
        &self,
        py: Python<'_>,
        accuracy: Option<f64>,
        methods: Option<Vec<String>>,
        tolerances: Option<Vec<f64>>,
        steps: Option<Vec<f64>>,
        repeats: usize,
        point_limit: f64,
        models: bool,
        x: Option<&str>,
        terms: Terms,
    ) -> PyResult<Answer> {
        let refuse = |what: String| Err(fault::scene_error(py, &wrong(what)));
        let positive = |value: &f64| value.is_finite() && *value > 0.0;
        let numbers = accuracy.iter().chain(tolerances.iter().flatten());
        if !numbers.chain(steps.iter().flatten()).all(positive) {
            return refuse("accuracy, tolerances and steps are positive numbers".to_owned());
        }
        if !(1..=1000).contains(&repeats) {
            return refuse("between 1 and 1000 repeats are timed".to_owned());
        }
        let Ok(limit) = Duration::try_from_secs_f64(point_limit) else {
            return refuse("the time of a point is a positive number of seconds".to_owned());
        };
        let mut chosen = all_methods();
        if let Some(names) = methods {
            let known: Vec<&str> = chosen.iter().map(|method| method.name()).collect();
            if let Some(name) = names.iter().find(|name| !known.contains(&name.as_str())) {
                let known = known.join(", ");
                return refuse(format!("there is no method `{name}`; one of {known}"));
            }
            chosen.retain(|method| names.iter().any(|name| name == method.name()));
        }
        let descending = |list: Option<Vec<f64>>| {
            list.map(|mut list| {
                list.sort_by(|a, b| b.total_cmp(a));
                list.dedup();
                list
            })
        };
        let plan = move |plan: &mut dam::studies::methods::Plan| {
            plan.methods = chosen;
            plan.repeats = repeats;
            plan.point_limit = limit;
            plan.steps = descending(steps);
            if let Some(tolerances) = descending(tolerances) {
                plan.tolerances = tolerances;
            }
        };
        let scene = self.asked();
        if let Some(x) = x {
            if models {
                return refuse("models are chosen for one scene: leave `models` or `x` out".into());
            }
            let axis = Axis::parse(x).map_err(|what| fault::scene_error(py, &wrong(what)))?;
            let found = compute(py, &terms, move |watch| {
                methods::over(scene, &axis, accuracy, plan, watch)
            })?;
            let columns = found.columns();
            return Ok(Answer::with_columns(found, columns));
        }
        let found = compute(py, &terms, move |watch| {
            methods::ask(scene, accuracy, models, plan, watch)
        })?;
        let columns = found.columns();
        Ok(Answer::with_columns(found, columns))
    }

    fn kinematics(&self, py: Python<'_>, course: LinkageCourse) -> PyResult<Answer> {
        let question = course.question();
        let question = question.map_err(|error| fault::scene_error(py, &error))?;
        let scene = self.asked();
        let found = compute(py, &Terms::default(), move |_| {
            linkages::kinematics(scene, &question)
        })?;
        let columns = found.columns();
        Ok(Answer::with_columns(found, columns))
    }

    fn forces(
        &self,
        py: Python<'_>,
        course: LinkageCourse,
        load: Option<String>,
        load_positive: bool,
        frictionless: bool,
        direction: Option<f64>,
    ) -> PyResult<Answer> {
        let question = course.question();
        let question = question.map_err(|error| fault::scene_error(py, &error))?;
        let choice = ForceChoice {
            load,
            convention: match load_positive {
                true => Convention::LoadPositive,
                false => Convention::Paper,
            },
            frictionless,
            direction,
        };
        let scene = self.asked();
        let found = compute(py, &Terms::default(), move |_| {
            linkages::forces(scene, &question, &choice)
        })?;
        let columns = found.columns();
        Ok(Answer::with_columns(found, columns))
    }

    fn steady(&self, py: Python<'_>, terms: Terms) -> PyResult<Answer> {
        let scene = self.asked();
        let found = compute(py, &terms, move |watch| steady::ask(scene, watch))?;
        let columns = found.columns();
        Ok(Answer::with_columns(found, columns))
    }

    fn linearise(&self, py: Python<'_>, terms: Terms) -> PyResult<Answer> {
        let scene = self.asked();
        let found = compute(py, &terms, move |watch| linear::linearise(scene, watch))?;
        let columns = crate::answer::Columns::default();
        Ok(Answer::with_columns(found, columns))
    }

    fn response(
        &self,
        py: Python<'_>,
        frequencies: Vec<f64>,
        inputs: Vec<String>,
        outputs: Vec<String>,
        accuracy: f64,
        terms: Terms,
    ) -> PyResult<Answer> {
        let question = ResponseQuestion {
            frequencies,
            inputs,
            outputs,
            accuracy: Some(accuracy),
        };
        let scene = self.asked();
        let found = compute(py, &terms, move |watch| {
            linear::response(scene, &question, watch)
        })?;
        let columns = found.columns();
        Ok(Answer::with_columns(found, columns))
    }

    #[pyo3(signature = (speeds, highest, accuracy, points, terms))]
    fn orders(
        &self,
        py: Python<'_>,
        speeds: Option<[f64; 2]>,
        highest: usize,
        accuracy: Option<f64>,
        points: usize,
        terms: Terms,
    ) -> PyResult<Answer> {
        let question = OrdersQuestion {
            speeds,
            highest,
            accuracy,
            points,
        };
        let scene = self.asked();
        let found = compute(py, &terms, move |watch| {
            linear::orders(scene, &question, watch)
        })?;
        let columns = found.columns();
        Ok(Answer::with_columns(found, columns))
    }

    #[pyo3(signature = (object, speed, pressure_angle, return_pressure_angle, roller_factor,
        least_radius, reserve, reserve_is_force, tolerance, cutter, lift_off, terms))]
    #[allow(
        clippy::too_many_arguments,
        reason = "these are what a cam is asked by; the stub names them"
    )]
    fn cam(
        &self,
        py: Python<'_>,
        object: Option<String>,
        speed: Option<String>,
        pressure_angle: Option<String>,
        return_pressure_angle: Option<String>,
        roller_factor: f64,
        least_radius: Option<String>,
        reserve: String,
        reserve_is_force: bool,
        tolerance: Option<String>,
        cutter: Option<String>,
        lift_off: bool,
        terms: Terms,
    ) -> PyResult<(Answer, String, String)> {
        let any = Bounds::ANY;
        let read = || -> Result<(CamQuestion, cam::Drawn), Error> {
            let angle = |name: &str, text| quantity(name, text, q::ANGLE, any);
            let length = |name: &str, text| quantity(name, text, q::LENGTH, any);
            let forces = QuantityChoice::either(q::FORCE, q::MOMENT);
            let wanted = match reserve_is_force {
                true => forces,
                false => q::NUMBER.into(),
            };
            let left = quantity("reserve", Some(reserve), wanted, any)?.unwrap_or(0.0);
            let question = CamQuestion {
                object,
                speed: quantity("speed", speed, q::ANGULAR_SPEED, any)?,
                pressure_angle: angle("pressure_angle", pressure_angle)?,
                return_pressure_angle: angle("return_pressure_angle", return_pressure_angle)?,
                roller_factor,
                least_radius: length("least_radius", least_radius)?.unwrap_or(0.0),
                reserve: match reserve_is_force {
                    true => Reserve::Force(left),
                    false => Reserve::Share(left),
                },
            };
            let drawn = cam::Drawn {
                tolerance: length("tolerance", tolerance)?.unwrap_or(1e-6),
                cutter: length("cutter", cutter)?,
                lift_off,
            };
            Ok((question, drawn))
        };
        let (question, drawn) = read().map_err(|error| fault::scene_error(py, &error))?;
        let scene = self.asked();
        let (found, columns, dxf, svg) = compute(py, &terms, move |watch| {
            let (found, columns) = cam::ask(scene, question, drawn, watch)?;
            let (dxf, svg) = (found.dxf()?, found.svg()?);
            Ok((found, columns, dxf, svg))
        })?;
        Ok((Answer::with_columns(found, columns), dxf, svg))
    }

    fn law(&self, py: Python<'_>, object: String, samples: usize) -> PyResult<Answer> {
        sound_samples(samples)?;
        let scene = self.asked();
        let (found, columns) = compute(py, &Terms::default(), move |_| {
            law::cycle(scene, object, samples)
        })?;
        Ok(Answer::with_columns(found, columns))
    }

    #[pyo3(signature = (at, laws, by, lift_off, terms))]
    fn compare_laws(
        &self,
        py: Python<'_>,
        at: String,
        laws: Vec<String>,
        by: String,
        lift_off: bool,
        terms: Terms,
    ) -> PyResult<Answer> {
        let scene = self.asked();
        let question = dam::ask::LawQuestion { at, laws, lift_off };
        let found = compute(py, &terms, move |watch| {
            law::compare(scene, &question, &by, watch)
        })?;
        let columns = found.columns();
        Ok(Answer::with_columns(found, columns))
    }

    #[pyo3(signature = (vary, subject, maximize, minimize, threads, terms))]
    #[allow(clippy::too_many_arguments)]
    fn find(
        &self,
        py: Python<'_>,
        vary: String,
        subject: Vec<String>,
        maximize: Option<String>,
        minimize: Option<String>,
        threads: Option<usize>,
        terms: Terms,
    ) -> PyResult<(Answer, bool)> {
        sound_threads(threads)?;
        let goal = maximize.map(|of| (Aim::Maximize, of));
        let question = FindQuestion {
            vary,
            subject,
            goal: goal.or(minimize.map(|of| (Aim::Minimize, of))),
            threads,
        };
        let scene = self.asked();
        let found = compute(py, &terms, move |watch| find::ask(scene, &question, watch))?;
        let (columns, answered) = (found.columns(), found.is_answered());
        Ok((Answer::with_columns(found, columns), answered))
    }

    #[pyo3(signature = (vary, subject, maximize, minimize, starts, threads, terms))]
    #[allow(clippy::too_many_arguments)]
    fn optimize(
        &self,
        py: Python<'_>,
        vary: Vec<String>,
        subject: Vec<String>,
        maximize: Option<String>,
        minimize: Option<String>,
        starts: usize,
        threads: Option<usize>,
        terms: Terms,
    ) -> PyResult<(Answer, bool, Option<String>)> {
        sound_threads(threads)?;
        let goal = maximize.map(|of| (Aim::Maximize, of));
        let question = OptimizeQuestion {
            vary,
            subject,
            goal: goal.or(minimize.map(|of| (Aim::Minimize, of))),
            starts,
            threads,
        };
        let scene = self.asked();
        let found = compute(py, &terms, move |watch| {
            optimize::ask(scene, &question, watch)
        })?;
        let (columns, answered) = (found.columns(), found.is_answered());
        let text = found.scene_text();
        Ok((Answer::with_columns(found, columns), answered, text))
    }

    #[pyo3(signature = (by, figures, check, terms))]
    fn gradient(
        &self,
        py: Python<'_>,
        by: Vec<String>,
        figures: Vec<String>,
        check: Option<bool>,
        terms: Terms,
    ) -> PyResult<(Answer, bool)> {
        let question = GradientQuestion { by, figures, check };
        let scene = self.asked();
        let found = compute(py, &terms, move |watch| {
            gradient::ask(scene, &question, watch)
        })?;
        let answered = found.is_answered();
        let columns = crate::answer::Columns::default();
        Ok((Answer::with_columns(found, columns), answered))
    }

    #[pyo3(signature = (tolerances, figures, limits, samples, seed, threads, terms))]
    #[allow(clippy::too_many_arguments)]
    fn tolerance(
        &self,
        py: Python<'_>,
        tolerances: Vec<String>,
        figures: Vec<String>,
        limits: Vec<String>,
        samples: Option<usize>,
        seed: Option<u32>,
        threads: Option<usize>,
        terms: Terms,
    ) -> PyResult<(Answer, bool)> {
        sound_threads(threads)?;
        let question = ToleranceQuestion {
            tolerances,
            figures,
            limits,
            samples,
            seed,
            threads,
        };
        let scene = self.asked();
        let found = compute(py, &terms, move |watch| {
            tolerance::ask(scene, &question, watch)
        })?;
        let (columns, answered) = (found.columns(), found.is_answered());
        Ok((Answer::with_columns(found, columns), answered))
    }

    /// `records`: name, CSV text and settings of each.
    #[allow(
        clippy::too_many_arguments,
        reason = "these are what an identification is asked by; the stub names them"
    )]
    fn identify(
        &self,
        py: Python<'_>,
        records: Vec<(String, String, Vec<String>)>,
        signals: Vec<String>,
        vary: Vec<String>,
        sigmas: Vec<String>,
        starts: Option<usize>,
        until_first_separation: bool,
        threads: Option<usize>,
        terms: Terms,
    ) -> PyResult<(Answer, bool, Option<String>)> {
        sound_threads(threads)?;
        let record = |(name, text, settings)| MeasuredRecord {
            name,
            text,
            settings,
        };
        let question = IdentifyQuestion {
            records: records.into_iter().map(record).collect(),
            signals,
            vary,
            sigmas,
            starts,
            until_first_separation,
            threads,
        };
        let scene = self.asked();
        let found = compute(py, &terms, move |watch| {
            identify::ask(scene, &question, watch)
        })?;
        let (columns, answered) = (found.columns(), found.is_answered());
        let text = found.scene_text();
        Ok((Answer::with_columns(found, columns), answered, text))
    }

    fn verify(&self, py: Python<'_>, terms: Terms) -> PyResult<(Answer, bool, String)> {
        let scene = self.asked();
        let found = compute(py, &terms, move |watch| find::verify(&scene, watch))?;
        let (hold, junit) = (found.hold(), found.junit());
        let columns = crate::answer::Columns::default();
        Ok((Answer::with_columns(found, columns), hold, junit))
    }

    fn reduce(&self, py: Python<'_>, terms: Terms) -> PyResult<(Answer, Self, bool)> {
        let scene = self.asked();
        let found = compute(py, &terms, move |watch| reduce::ask(scene, watch))?;
        let (left, holds) = (Self::of(found.scene()), found.holds());
        let columns = crate::answer::Columns::default();
        Ok((Answer::with_columns(found, columns), left, holds))
    }
}

pub(crate) fn sound_threads(threads: Option<usize>) -> PyResult<()> {
    if threads.is_some_and(|threads| threads == 0 || threads > MOST_THREADS) {
        let message = format!("between 1 and {MOST_THREADS} threads work on a question");
        return Err(PyValueError::new_err(message));
    }
    Ok(())
}

/// What is asked of a map.
fn wanted(
    py: Python<'_>,
    (x, y): (&str, Option<&str>),
    figure: Option<String>,
    check: bool,
    digits: u8,
    threads: Option<usize>,
) -> PyResult<map::Wanted> {
    let axis = |text: &str| Axis::parse(text).map_err(|what| fault::scene_error(py, &wrong(what)));
    sound_threads(threads)?;
    Ok(map::Wanted {
        x: axis(x)?,
        y: y.map(axis).transpose()?,
        figure,
        check,
        digits,
        threads,
        panels: Vec::new(),
    })
}

/// Answer, numbers of values up and along, figure and its unit, hash, verdicts, panels.
type MapAnswer = (
    Answer,
    (usize, usize),
    (String, String),
    String,
    Vec<map::ToldVerdict>,
    Vec<String>,
);

fn tree_of(value: &serde_json::Value) -> dam::read::Node {
    use serde_json::Value;
    match value {
        Value::Null => dam::read::Node::object(),
        Value::Bool(flag) => (*flag).into(),
        Value::Number(number) => number.as_f64().unwrap_or(f64::NAN).into(),
        Value::String(text) => text.as_str().into(),
        Value::Array(values) => values.iter().map(tree_of).collect::<Vec<_>>().into(),
        Value::Object(members) => {
            let mut tree = dam::read::Node::object();
            for (name, value) in members {
                tree.set_property(name, tree_of(value));
            }
            tree
        }
    }
}

fn sound_samples(samples: usize) -> PyResult<()> {
    match (1..=1_000_000).contains(&samples) {
        true => Ok(()),
        false => Err(PyValueError::new_err(
            "between 1 and 1000000 samples are taken",
        )),
    }
}

/// A law by itself.
#[pyfunction]
pub(crate) fn law_of(
    py: Python<'_>,
    law: String,
    run_up: bool,
    samples: usize,
) -> PyResult<Answer> {
    sound_samples(samples)?;
    let found = directly(py, || law::ask(&law, run_up, samples))?;
    let columns = found.columns();
    Ok(Answer::with_columns(found, columns))
}

/// A stroke of run-up, uniform section and run-out: laws of the run-up and run-out; stroke, span
/// and greatest speed as texts; shares of the uniform section, and whether it is the best; what
/// the skewness follows from, and its number.
#[pyfunction]
#[allow(
    clippy::type_complexity,
    reason = "these are what a stroke is asked by; the stub names them"
)]
pub(crate) fn stroke_of(
    py: Python<'_>,
    laws: (String, Option<String>),
    sizes: (Option<String>, Option<String>, Option<String>),
    uniform: (Option<f64>, Option<f64>, bool),
    skewness: (String, f64),
    samples: usize,
) -> PyResult<Answer> {
    sound_samples(samples)?;
    let number = skewness.1;
    let question = StrokeQuestion {
        run_up: laws.0,
        run_out: laws.1,
        stroke: sizes.0,
        span: sizes.1,
        peak_speed: sizes.2,
        uniform_stroke: uniform.0,
        uniform_span: uniform.1,
        uniform_optimum: uniform.2,
        skewness: match skewness.0.as_str() {
            "acceleration_ratio" => Skewness::AccelerationRatio(number),
            "least_acceleration" => Skewness::Optimum(Criterion::Acceleration { weight: number }),
            "least_torque" => Skewness::Optimum(Criterion::Product { weight: number }),
            _ => Skewness::Given(number),
        },
    };
    let found = directly(py, || law::stroke(&question))?;
    let columns = found.columns(samples);
    Ok(Answer::with_columns(found, columns))
}

/// The JSON Schema of scenes.
#[pyfunction]
pub(crate) fn schema(py: Python<'_>) -> PyResult<String> {
    let kinds = dam::object::Registry::standard();
    directly(py, || Ok(schema_text(&schema_of_kinds(&kinds))))
}
