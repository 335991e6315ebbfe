//! Faults as exceptions. The classes stand in `dam/errors.py`, where they have their types.

use dam::Error;
use dam::diagnostics::{Diagnostic, Diagnostics, Severity};
use pyo3::prelude::*;
use pyo3::types::{PyList, PyTuple};

/// What is wrong with a scene or a question: `dam.SceneError`.
pub(crate) fn scene_error(py: Python<'_>, error: &Error) -> PyErr {
    let made = || {
        let faults = faults(py, error.diagnostics())?;
        let class = errors(py)?.getattr("SceneError")?;
        class.call1((error.to_string(), faults))
    };
    made().map_or_else(|error| error, PyErr::from_value)
}

/// A fault of `dam` itself: `dam.InternalError`.
pub(crate) fn internal(py: Python<'_>, what: &str) -> PyErr {
    of_class(
        py,
        "InternalError",
        format!("this is a fault of dam: {what}"),
    )
}

/// There is no answer in time: `dam.TimeLimitError`.
pub(crate) fn time_is_over(py: Python<'_>, what: &str) -> PyErr {
    of_class(py, "TimeLimitError", what.to_owned())
}

fn of_class(py: Python<'_>, name: &str, what: String) -> PyErr {
    let made = || errors(py)?.getattr(name)?.call1((what,));
    made().map_or_else(|error| error, PyErr::from_value)
}

fn errors(py: Python<'_>) -> PyResult<Bound<'_, PyModule>> {
    py.import("dam.errors")
}

/// Diagnostics as `dam.Fault`s.
pub(crate) fn faults<'py>(
    py: Python<'py>,
    diagnostics: &Diagnostics,
) -> PyResult<Bound<'py, PyList>> {
    let class = errors(py)?.getattr("Fault")?;
    let all: PyResult<Vec<Bound<'py, PyAny>>> = diagnostics
        .items
        .iter()
        .map(|item| class.call1(fields(py, item, diagnostics)?))
        .collect();
    PyList::new(py, all?)
}

/// Severity, code, message, path, file, line, column, hints, excerpt.
fn fields<'py>(
    py: Python<'py>,
    item: &Diagnostic,
    all: &Diagnostics,
) -> PyResult<Bound<'py, PyTuple>> {
    let severity = match item.severity {
        Severity::Error => "error",
        Severity::Warning => "warning",
    };
    let place = item.place.as_ref().filter(|place| !place.is_nowhere());
    let source = place.and_then(|place| all.sources.get(place.source));
    let at = place.and_then(|place| all.sources.position(place));
    let alone = Diagnostics::new(all.sources.clone(), vec![item.clone()]);
    let fields = (
        severity,
        item.code,
        item.message.as_str(),
        item.path.as_str(),
        source.map(|source| source.name.as_str()),
        at.map(|at| at.line),
        at.map(|at| at.column),
        PyTuple::new(py, &item.hints)?,
        alone.render(false),
    );
    fields.into_pyobject(py)
}
