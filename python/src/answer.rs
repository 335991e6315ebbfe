//! Answers: what a study found, in every form that Python takes.

use crate::arrow;
use crate::work::directly;
use dam::Error;
use dam::report::findings::Findings;
use dam::report::verdict::{Sort, Verdict};
use pyo3::exceptions::PyIndexError;
use pyo3::prelude::*;
use pyo3::types::{PyCapsule, PyDict, PyTuple};
use serde_json::Value;
use std::sync::Arc;

/// Columns of numbers, all as long as the first.
pub(crate) trait Table: Send + Sync {
    /// Names and SI units, in their order.
    fn heads(&self) -> Vec<(String, String)>;
    /// Values of a column.
    fn values(&self, index: usize) -> &[f64];
}

/// Columns that are held as such.
#[derive(Debug, Default)]
pub(crate) struct Columns(pub(crate) Vec<(String, String, Vec<f64>)>);

impl Table for Columns {
    fn heads(&self) -> Vec<(String, String)> {
        let head = |(name, unit, _): &(String, String, Vec<f64>)| (name.clone(), unit.clone());
        self.0.iter().map(head).collect()
    }

    fn values(&self, index: usize) -> &[f64] {
        &self.0[index].2
    }
}

/// A figure: address, value, SI unit, error either way, how sure that is.
pub(crate) type Figure = (String, f64, String, Option<f64>, &'static str);

/// What a study found.
pub(crate) trait Found: Send + Sync {
    /// The JSON document that the program prints.
    fn document(&self) -> Result<Value, Error>;

    /// The text of the terminal, for a width.
    fn text(&self, width: Option<usize>) -> Result<String, Error>;

    /// The page.
    fn page(&self) -> Result<String, Error>;

    /// Answer in a sentence.
    fn answer(&self) -> Result<Option<Verdict>, Error>;

    /// Warnings beside it.
    fn warnings(&self) -> Result<Vec<String>, Error>;

    /// Figures by their addresses.
    fn figures(&self) -> Vec<Figure> {
        Vec::new()
    }
}

/// What is told as findings.
pub(crate) trait Told: Send + Sync {
    fn document(&self) -> Result<Value, Error>;
    fn tell<T>(&self, to: impl FnOnce(&Findings<'_>) -> T) -> Result<T, Error>;
    fn answer(&self) -> Result<Option<Verdict>, Error> {
        self.tell(|findings| findings.answer.clone())
    }
    fn figures(&self) -> Vec<Figure> {
        Vec::new()
    }
}

impl<T: Told> Found for T {
    fn document(&self) -> Result<Value, Error> {
        Told::document(self)
    }

    fn text(&self, width: Option<usize>) -> Result<String, Error> {
        self.tell(|findings| findings.text(width))
    }

    fn page(&self) -> Result<String, Error> {
        self.tell(|findings| findings.page())
    }

    fn answer(&self) -> Result<Option<Verdict>, Error> {
        Told::answer(self)
    }

    fn warnings(&self) -> Result<Vec<String>, Error> {
        self.tell(|findings| findings.warnings.clone())
    }

    fn figures(&self) -> Vec<Figure> {
        Told::figures(self)
    }
}

/// What a study found.
#[pyclass(frozen, module = "dam._dam")]
pub(crate) struct Answer {
    found: Arc<dyn Found>,
    table: Arc<dyn Table>,
}

impl Answer {
    pub(crate) fn new<F: Found + Table + 'static>(found: F) -> Self {
        let found = Arc::new(found);
        Self {
            table: Arc::clone(&found) as Arc<dyn Table>,
            found,
        }
    }

    pub(crate) fn with_columns(found: impl Found + 'static, columns: Columns) -> Self {
        Self {
            found: Arc::new(found),
            table: Arc::new(columns),
        }
    }
}

/// Sort, headline, text.
type Words = (&'static str, String, String);

fn words(verdict: Verdict) -> Words {
    let sort = match verdict.sort {
        Sort::Good | Sort::Recommended => "good",
        Sort::Mechanism => "mechanism",
        Sort::Numerical => "numerical",
        Sort::Unfinished => "unfinished",
    };
    (
        sort,
        verdict.headline.to_string(),
        verdict.following_sentence().to_string(),
    )
}

#[pymethods]
impl Answer {
    fn document(&self, py: Python<'_>) -> PyResult<String> {
        directly(py, || Ok(self.found.document()?.to_string()))
    }

    #[pyo3(signature = (width=None))]
    fn text(&self, py: Python<'_>, width: Option<usize>) -> PyResult<String> {
        directly(py, || self.found.text(width))
    }

    fn page(&self, py: Python<'_>) -> PyResult<String> {
        directly(py, || self.found.page())
    }

    fn answer(&self, py: Python<'_>) -> PyResult<Option<Words>> {
        directly(py, || Ok(self.found.answer()?.map(words)))
    }

    fn warnings(&self, py: Python<'_>) -> PyResult<Vec<String>> {
        directly(py, || self.found.warnings())
    }

    fn figures(&self, py: Python<'_>) -> PyResult<Vec<Figure>> {
        directly(py, || Ok(self.found.figures()))
    }

    fn heads(&self) -> Vec<(String, String)> {
        self.table.heads()
    }

    fn column(&self, index: usize) -> PyResult<Column> {
        if index >= self.table.heads().len() {
            return Err(PyIndexError::new_err("there is no such column"));
        }
        Ok(Column {
            table: Arc::clone(&self.table),
            index,
        })
    }

    fn arrow_c_stream<'py>(&self, py: Python<'py>) -> PyResult<Bound<'py, PyCapsule>> {
        arrow::stream(py, Arc::clone(&self.table))
    }
}

/// A column: NumPy takes its numbers where they are (`numpy.asarray`), and keeps it alive.
#[pyclass(frozen, module = "dam._dam")]
pub(crate) struct Column {
    table: Arc<dyn Table>,
    index: usize,
}

impl Column {
    pub(crate) fn new(table: Arc<dyn Table>, index: usize) -> Self {
        Self { table, index }
    }
}

#[pymethods]
impl Column {
    fn __len__(&self) -> usize {
        self.table.values(self.index).len()
    }

    fn __getitem__(&self, at: isize) -> PyResult<f64> {
        let values = self.table.values(self.index);
        let place = match at < 0 {
            true => at.checked_add_unsigned(values.len()),
            false => Some(at),
        };
        let value = place.and_then(|place| values.get(usize::try_from(place).ok()?));
        let value = value.copied();
        value.ok_or_else(|| PyIndexError::new_err("there is no such sample"))
    }

    /// NumPy's array interface, version 3: the place of the numbers, which are read only.
    #[getter]
    fn __array_interface__<'py>(&self, py: Python<'py>) -> PyResult<Bound<'py, PyDict>> {
        let values = self.table.values(self.index);
        let order = if cfg!(target_endian = "little") {
            "<f8"
        } else {
            ">f8"
        };
        let interface = PyDict::new(py);
        interface.set_item("version", 3)?;
        interface.set_item("typestr", order)?;
        interface.set_item("shape", PyTuple::new(py, [values.len()])?)?;
        interface.set_item("data", (values.as_ptr().addr(), true))?;
        Ok(interface)
    }
}
