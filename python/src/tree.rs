//! Python values as trees, as a text would be read into them.

use crate::own;
use dam::read::Node;
use pyo3::exceptions::{PyTypeError, PyValueError};
use pyo3::prelude::*;
use pyo3::types::{PyBool, PyDict, PyFloat, PyInt, PyList, PyMapping, PyString, PyTuple};

/// Deepest nesting of values.
const DEEPEST: usize = 64;

/// The greatest whole number that every double near it can be told from.
const WHOLE: f64 = 9_007_199_254_740_992.0;

/// A tree of a Python value: `None` in mappings stands for a property that is left out.
///
/// # Errors
/// A value of a type that no scene holds.
pub(crate) fn node(value: &Bound<'_, PyAny>) -> PyResult<Node> {
    read(value, 0)
}

fn read(value: &Bound<'_, PyAny>, depth: usize) -> PyResult<Node> {
    if depth > DEEPEST {
        return Err(PyValueError::new_err(format!(
            "values are nested deeper than {DEEPEST}"
        )));
    }
    if let Ok(text) = value.cast::<PyString>() {
        return Ok(text.to_str()?.into());
    }
    if let Ok(flag) = value.cast::<PyBool>() {
        return Ok(flag.is_true().into());
    }
    if let Ok(number) = value.cast::<PyFloat>() {
        return Ok(number.value().into());
    }
    if value.is_instance_of::<PyInt>() {
        return whole(value);
    }
    if let Ok(own) = value.cast::<own::Own>() {
        return Ok(own.get().node());
    }
    if value.is_instance_of::<PyDict>() {
        return mapping(value, depth);
    }
    if value.is_instance_of::<PyList>() || value.is_instance_of::<PyTuple>() {
        return list(value, depth);
    }
    if let Some(tree) = value.getattr_opt("_tree_")? {
        // An object of `dam.kinds`.
        return read(&tree.call0()?, depth + 1);
    }
    if value.cast::<PyMapping>().is_ok() {
        return mapping(value, depth);
    }
    if let Some(listed) = value.getattr_opt("tolist")? {
        // A number or an array of NumPy.
        return read(&listed.call0()?, depth + 1);
    }
    let class = value.get_type().name()?.to_string();
    Err(PyTypeError::new_err(format!(
        "a scene holds numbers, texts, flags, lists, mappings and objects of dam.kinds, not `{class}`"
    )))
}

fn whole(value: &Bound<'_, PyAny>) -> PyResult<Node> {
    if let Ok(number) = value.extract::<i64>() {
        return Ok(number.into());
    }
    let number: f64 = value.extract()?;
    match number.abs() < WHOLE {
        true => Ok(number.into()),
        // What is beyond is no count; as a quantity it is this double.
        false => Ok(number.into()),
    }
}

fn list(value: &Bound<'_, PyAny>, depth: usize) -> PyResult<Node> {
    let values: PyResult<Vec<Node>> = value
        .try_iter()?
        .map(|value| read(&value?, depth + 1))
        .collect();
    Ok(values?.into())
}

fn mapping(value: &Bound<'_, PyAny>, depth: usize) -> PyResult<Node> {
    let mut tree = Node::object();
    for item in value.call_method0("items")?.try_iter()? {
        let (name, value): (Bound<'_, PyAny>, Bound<'_, PyAny>) = item?.extract()?;
        let Ok(name) = name.cast::<PyString>() else {
            let class = name.get_type().name()?.to_string();
            return Err(PyTypeError::new_err(format!(
                "names of properties are texts, not `{class}`"
            )));
        };
        if !value.is_none() {
            tree.set_property(name.to_str()?, read(&value, depth + 1)?);
        }
    }
    Ok(tree)
}
