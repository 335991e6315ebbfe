//! Prepared scenes.

use crate::answer::{Column, Columns};
use crate::scene::sound_threads;
use crate::work::{Terms, compute, compute_here};
use dam::Scene;
use dam::ask::{Point, PointFigure, PointTable, PreparedScene};
use dam::prelude::Verdict;
use pyo3::prelude::*;
use std::sync::Arc;

/// A point: figures, verdict, cause, the verdict that a run gives, doubts; of each figure the
/// value (NaN where there is none), how far it moves, whether it is determined.
pub(crate) type ToldPoint = (
    Vec<f64>,
    &'static str,
    String,
    Option<String>,
    Vec<String>,
    Vec<Option<f64>>,
    Vec<Option<bool>>,
);

/// A scene prepared for many values of its parameters.
#[pyclass(frozen, module = "dam._dam")]
pub(crate) struct Prepared {
    prepared: Arc<PreparedScene>,
}

/// Prepares a scene; `digits`: to how many figures are to be determined, where that is asked.
pub(crate) fn prepare(
    py: Python<'_>,
    scene: Arc<Scene>,
    (parameters, figures): (Vec<String>, Vec<String>),
    digits: Option<u8>,
) -> PyResult<Prepared> {
    let prepared = compute(py, &Terms::default(), move |_| {
        let prepared = scene.prepare_points(&parameters, &figures)?;
        Ok(match digits {
            Some(digits) => prepared.check_determined(digits),
            None => prepared,
        })
    })?;
    Ok(Prepared {
        prepared: Arc::new(prepared),
    })
}

#[pymethods]
impl Prepared {
    #[getter]
    fn parameters(&self) -> Vec<String> {
        self.prepared.parameters().to_vec()
    }

    #[getter]
    fn parameter_units(&self) -> Vec<String> {
        self.prepared.parameter_units().to_vec()
    }

    /// Values of the parameters in the scene itself.
    #[getter]
    fn values(&self) -> Vec<f64> {
        self.prepared.values().to_vec()
    }

    #[getter]
    fn figures(&self) -> Vec<String> {
        self.prepared.figures().to_vec()
    }

    #[getter]
    fn figure_units(&self) -> Vec<String> {
        self.prepared.figure_units().to_vec()
    }

    #[getter]
    fn remarks(&self) -> Vec<String> {
        self.prepared.remarks().to_vec()
    }

    /// The values of the figures at a point alone; NaN where there is none.
    fn figures_at(&self, py: Python<'_>, values: Vec<f64>) -> PyResult<Vec<f64>> {
        Ok(numbers(&self.point(py, &values)?))
    }

    fn at(&self, py: Python<'_>, values: Vec<f64>) -> PyResult<ToldPoint> {
        let point = self.point(py, &values)?;
        Ok((
            numbers(&point),
            point.verdict.name(),
            point.cause,
            judgement(point.verdict),
            point.doubts,
            point.figures.iter().map(|one| one.moved).collect(),
            point.figures.iter().map(|one| one.determined).collect(),
        ))
    }

    /// Points at rows of values; on all threads where their number is not given.
    #[pyo3(signature = (rows, threads, terms))]
    fn table(
        &self,
        py: Python<'_>,
        rows: Vec<Vec<f64>>,
        threads: Option<usize>,
        terms: Terms,
    ) -> PyResult<Points> {
        sound_threads(threads)?;
        let prepared = Arc::clone(&self.prepared);
        let found = compute(py, &terms, move |watch| {
            let count = rows.len() as f64;
            let heard = |done: usize| watch.at(done as f64 / count);
            prepared.table_within(&rows, threads, &watch.budget(), &heard)
        })?;
        Ok(Points::new(found, self.prepared.figures().len()))
    }
}

impl Prepared {
    fn point(&self, py: Python<'_>, values: &[f64]) -> PyResult<Point> {
        compute_here(py, &Terms::default(), |watch| {
            self.prepared.at_within(values, &watch.budget())
        })
    }
}

/// The verdict that a run gives, by its name.
fn judgement(verdict: Verdict) -> Option<String> {
    let name = crate::studies::plain(&verdict.judgement()).unwrap_or_default();
    name.as_str().map(str::to_owned)
}

fn numbers(point: &Point) -> Vec<f64> {
    let values = point.figures.iter();
    values.map(|one| one.value.unwrap_or(f64::NAN)).collect()
}

/// Points of a table.
#[pyclass(frozen, module = "dam._dam")]
pub(crate) struct Points {
    found: PointTable,
    /// Values and how far they move: a column of both for each figure.
    columns: Arc<Columns>,
}

impl Points {
    fn new(found: PointTable, figures: usize) -> Self {
        let column = |of: fn(&PointFigure) -> Option<f64>, at: usize| {
            let points = found.points.iter();
            let values = points.map(|point| of(&point.figures[at]).unwrap_or(f64::NAN));
            (String::new(), String::new(), values.collect())
        };
        let values = (0..figures).map(|at| column(|one| one.value, at));
        let moved = (0..figures).map(|at| column(|one| one.moved, at));
        let columns = Arc::new(Columns(values.chain(moved).collect()));
        Self { found, columns }
    }

    fn of_points<T>(&self, told: impl Fn(&Point) -> T) -> Vec<T> {
        self.found.points.iter().map(told).collect()
    }
}

#[pymethods]
impl Points {
    fn __len__(&self) -> usize {
        self.found.points.len()
    }

    /// Values of the figure of this number; NaN where there is none.
    fn column(&self, index: usize) -> Option<Column> {
        let known = index < self.columns.0.len();
        known.then(|| Column::new(Arc::clone(&self.columns) as _, index))
    }

    fn verdicts(&self) -> Vec<&'static str> {
        self.of_points(|point| point.verdict.name())
    }

    fn judgements(&self) -> Vec<Option<String>> {
        self.of_points(|point| judgement(point.verdict))
    }

    fn causes(&self) -> Vec<String> {
        self.of_points(|point| point.cause.clone())
    }

    fn doubts(&self) -> Vec<Vec<String>> {
        self.of_points(|point| point.doubts.clone())
    }

    fn determined(&self) -> Vec<Vec<Option<bool>>> {
        self.of_points(|point| point.figures.iter().map(|one| one.determined).collect())
    }
}
