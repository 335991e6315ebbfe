//! Python functions in scenes: position functions and loads.
//!
//! A position function is interpolated beforehand (`position::ChebyshevInterpolation`); a load is called.
//! An exception ends the run by its watch.

use crate::fault;
use crate::work::watched;
use dam::build::{Load, Position};
use dam::load::{Force, LoadFunction};
use dam::position::{ChebyshevInterpolation, PositionFunction};
use dam::read::Node;
use pyo3::prelude::*;
use std::fmt;
use std::sync::atomic::{AtomicU64, Ordering};

/// Share of the displacement or speed by which a force is moved for its slopes.
const MOVED: f64 = 1e-6;

/// A value that no text can state: goes into a scene where a position or a load stands.
#[pyclass(frozen, module = "dam._dam")]
pub(crate) struct Own {
    node: Node,
    values: Option<usize>,
}

impl Own {
    pub(crate) fn node(&self) -> Node {
        self.node.clone()
    }
}

#[pymethods]
impl Own {
    /// Number of values that a position function was made of.
    #[getter]
    fn values(&self) -> Option<usize> {
        self.values
    }
}

/// Words that stand for a function in texts and hashes: its name where one is given, else
/// one that no other function has.
fn words(function: &Bound<'_, PyAny>, name: Option<String>) -> String {
    static NEXT: AtomicU64 = AtomicU64::new(1);
    name.unwrap_or_else(|| {
        let known = function.getattr("__qualname__");
        let known = known.and_then(|name| name.extract::<String>());
        let number = NEXT.fetch_add(1, Ordering::Relaxed);
        format!(
            "{}#{number}",
            known.unwrap_or_else(|_| "function".to_owned())
        )
    })
}

/// A position function of its values: interpolated beforehand, over a period or a reach.
#[pyfunction]
#[pyo3(signature = (function, period, reach, breaks, name))]
pub(crate) fn position(
    function: &Bound<'_, PyAny>,
    period: f64,
    reach: Option<(f64, f64)>,
    breaks: Vec<f64>,
    name: Option<String>,
) -> PyResult<Own> {
    let py = function.py();
    let words = words(function, name);
    let mut raised = None;
    let mut ask = |phi: f64| {
        if raised.is_some() {
            return f64::NAN;
        }
        let found = function
            .call1((phi,))
            .and_then(|value| value.extract::<f64>());
        found.unwrap_or_else(|error| {
            raised = Some(error);
            f64::NAN
        })
    };
    let made = match reach {
        None => ChebyshevInterpolation::periodic(&words, &mut ask, period, &breaks),
        Some(reach) => ChebyshevInterpolation::between(&words, &mut ask, reach, &breaks),
    };
    if let Some(error) = raised {
        return Err(error);
    }
    let made = made.map_err(|fault| fault::scene_error(py, &vec![fault].into()))?;
    let values = made.values();
    Ok(Own {
        node: Node::from(Position::own(made)),
        values: Some(values),
    })
}

/// U of a position function with its derivatives, for checks.
#[pyfunction]
#[pyo3(signature = (function, period, reach, breaks, at))]
pub(crate) fn position_jets(
    function: &Bound<'_, PyAny>,
    period: f64,
    reach: Option<(f64, f64)>,
    breaks: Vec<f64>,
    at: Vec<f64>,
) -> PyResult<Vec<[f64; 4]>> {
    let py = function.py();
    let mut raised = None;
    let mut ask = |phi: f64| {
        let found = function
            .call1((phi,))
            .and_then(|value| value.extract::<f64>());
        found.unwrap_or_else(|error| {
            raised.get_or_insert(error);
            f64::NAN
        })
    };
    let made = match reach {
        None => ChebyshevInterpolation::periodic("", &mut ask, period, &breaks),
        Some(reach) => ChebyshevInterpolation::between("", &mut ask, reach, &breaks),
    };
    if let Some(error) = raised {
        return Err(error);
    }
    let made = made.map_err(|fault| fault::scene_error(py, &vec![fault].into()))?;
    let breaks = made.breaks();
    let jets = at.into_iter().map(|phi| {
        let jet = made.jet(breaks.segment_at(phi, 1.0), phi);
        [jet.value, jet.first, jet.second, jet.third]
    });
    Ok(jets.collect())
}

/// A force that a Python function gives.
#[pyfunction]
#[pyo3(signature = (function, magnitude, slopes, needs_speed, mass, name))]
pub(crate) fn load(
    function: Bound<'_, PyAny>,
    magnitude: f64,
    slopes: Option<Py<PyAny>>,
    needs_speed: bool,
    mass: Option<&Bound<'_, PyAny>>,
    name: Option<String>,
) -> PyResult<Own> {
    let words = words(&function, name);
    let called = Called {
        function: function.unbind(),
        slopes,
        magnitude,
        needs_speed,
        words,
    };
    let mut load = Load::own(called);
    if let Some(mass) = mass {
        load = load.mass(crate::tree::node(mass)?);
    }
    Ok(Own {
        node: Node::from(load),
        values: None,
    })
}

/// A Python function as a force.
struct Called {
    function: Py<PyAny>,
    slopes: Option<Py<PyAny>>,
    magnitude: f64,
    needs_speed: bool,
    words: String,
}

impl fmt::Debug for Called {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        f.write_str(&self.words)
    }
}

impl Called {
    fn value(&self, py: Python<'_>, displacement: f64, speed: f64) -> PyResult<f64> {
        let found = match self.needs_speed {
            true => self.function.call1(py, (displacement, speed))?,
            false => self.function.call1(py, (displacement,))?,
        };
        found.extract(py)
    }

    fn with_slopes(&self, py: Python<'_>, displacement: f64, speed: f64) -> PyResult<Force> {
        let at = |displacement, speed| self.value(py, displacement, speed);
        let value = at(displacement, speed)?;
        let (by_displacement, by_speed) = match &self.slopes {
            Some(slopes) if self.needs_speed => {
                slopes.call1(py, (displacement, speed))?.extract(py)?
            }
            Some(slopes) => (slopes.call1(py, (displacement,))?.extract(py)?, 0.0),
            None => {
                let moved = |by: f64| MOVED * (1e-2 + by.abs());
                let (step, faster) = (moved(displacement), moved(speed));
                let by_displacement = (at(displacement + step, speed)?
                    - at(displacement - step, speed)?)
                    / (2.0 * step);
                let by_speed = match self.needs_speed {
                    false => 0.0,
                    true => {
                        (at(displacement, speed + faster)? - at(displacement, speed - faster)?)
                            / (2.0 * faster)
                    }
                };
                (by_displacement, by_speed)
            }
        };
        Ok(Force {
            value,
            by_displacement,
            by_speed,
        })
    }
}

impl LoadFunction for Called {
    fn force(&self, displacement: f64, speed: f64) -> Force {
        // An interpreter that ends calls nobody any more.
        let found = Python::try_attach(|py| self.with_slopes(py, displacement, speed));
        match found {
            Some(Ok(force)) => force,
            Some(Err(error)) => {
                if let Some(watch) = watched() {
                    watch.raise(error);
                }
                NO_FORCE
            }
            None => NO_FORCE,
        }
    }

    fn magnitude(&self) -> f64 {
        self.magnitude
    }

    fn needs_speed(&self) -> bool {
        self.needs_speed
    }

    fn description(&self) -> String {
        self.words.clone()
    }
}

/// What a function that fails leaves: no number, so that no run goes on with it.
const NO_FORCE: Force = Force {
    value: f64::NAN,
    by_displacement: f64::NAN,
    by_speed: f64::NAN,
};
