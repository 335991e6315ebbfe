//! Runs: how they are made otherwise than the scene says, and what they leave, by typed
//! keys.

use super::Scene;
use crate::Error;
use crate::dynamics::integrate::Method;
use crate::dynamics::record::{Figure, ObjectFigures, Quantity};
use crate::frontend::diagnostics::Diagnostic;
use crate::studies::Control;
use crate::studies::run::RunResult;

/// What a run does otherwise than its scene says; by default nothing.
///
/// ```
/// # use dam::prelude::*;
/// let fine = RunOptions { tolerance: Some(1e-9), ..Default::default() };
/// let scene = Scene::read("scenarios/rocker/two_masses.json")?;
/// assert!(scene.run_with(&fine)?.is_trusted());
/// # Ok::<(), Error>(())
/// ```
#[derive(Clone, Debug, Default)]
pub struct RunOptions<'a> {
    /// Simulated time (s).
    pub duration: Option<f64>,
    /// Method of integration.
    pub method: Option<Method>,
    /// Error wanted in each object's δ, relative to its scale.
    pub tolerance: Option<f64>,
    /// Fixed or greatest step (s).
    pub step: Option<f64>,
    /// Number of equal intervals between samples.
    pub samples: Option<usize>,
    /// Whether there are two rows (before, after) at each switch.
    pub switch_rows: Option<bool>,
    /// Window of steady figures (s, s).
    pub window: Option<(f64, f64)>,
    /// Control: what may end the run from outside.
    pub control: Control<'a>,
}

impl RunOptions<'_> {
    /// The scene with these settings: they are checked as its own are.
    pub(super) fn apply(&self, mut scene: Scene) -> Scene {
        if let Some(duration) = self.duration {
            scene = scene.set("run.duration", duration);
        }
        if let Some(method) = self.method {
            scene = scene.set("run.method", method.name());
        }
        if let Some(tolerance) = self.tolerance {
            scene = scene.set("run.tolerance", tolerance);
        }
        if let Some(step) = self.step {
            scene = scene.set("run.step", step);
        }
        if let Some(samples) = self.samples {
            scene = scene.set("run.samples", samples);
        }
        if let Some(switch_rows) = self.switch_rows {
            scene = scene.set("run.switch_rows", switch_rows);
        }
        if let Some(window) = self.window {
            scene = scene.set("run.window", window);
        }
        scene
    }
}

/// Arrays and figures by typed keys. Objects are named by their ids, outputs of objects
/// as `press.ram`.
impl RunResult {
    /// The times of the samples (s).
    pub fn times(&self) -> &[f64] {
        &self.record.times
    }

    /// A quantity of an object, a value for each of [`Self::times`].
    ///
    /// # Errors
    /// There is no such object; the quantity was not recorded.
    pub fn column(&self, object: &str, quantity: Quantity) -> Result<&[f64], Error> {
        if let Some(column) = self.record.column(object, quantity) {
            return Ok(&column.values);
        }
        self.figures(object)?;
        let message = format!("there is no column `{quantity}` of `{object}`");
        let hint = "masses and links of elastic objects are recorded on request: `record_all`";
        let fault = Diagnostic::error("unknown-name", message);
        Err(Error::of(
            fault.path(format!("{object}.{quantity}")).hint(hint),
        ))
    }

    /// Displacement φ (rad or m).
    ///
    /// # Errors
    /// There is no such object.
    pub fn displacement(&self, object: &str) -> Result<&[f64], Error> {
        self.column(object, Quantity::Displacement)
    }

    /// Speed φ̇.
    ///
    /// # Errors
    /// There is no such object.
    pub fn speed(&self, object: &str) -> Result<&[f64], Error> {
        self.column(object, Quantity::Speed)
    }

    /// Acceleration φ̈.
    ///
    /// # Errors
    /// There is no such object.
    pub fn acceleration(&self, object: &str) -> Result<&[f64], Error> {
        self.column(object, Quantity::Acceleration)
    }

    /// Positioning error δ.
    ///
    /// # Errors
    /// There is no such object.
    pub fn delta(&self, object: &str) -> Result<&[f64], Error> {
        self.column(object, Quantity::Delta)
    }

    /// Reaction F of link 1 (N·m or N).
    ///
    /// # Errors
    /// There is no such object.
    pub fn reaction(&self, object: &str) -> Result<&[f64], Error> {
        self.column(object, Quantity::Reaction)
    }

    /// Contact force of the driving pair (N·m or N).
    ///
    /// # Errors
    /// There is no such object.
    pub fn contact_force(&self, object: &str) -> Result<&[f64], Error> {
        self.column(object, Quantity::ContactForce)
    }

    /// The figures of an object, found between the samples too.
    ///
    /// # Errors
    /// There is no such object.
    pub fn figures(&self, object: &str) -> Result<&ObjectFigures, Error> {
        let found = self.figures.objects.get(object);
        found.ok_or_else(|| self.unknown(object))
    }

    /// One figure of an object; 0 and 1 for answers.
    ///
    /// # Errors
    /// There is no such object, or it has no such figure.
    pub fn figure(&self, object: &str, figure: Figure) -> Result<f64, Error> {
        let value = self.figures(object)?.value(figure);
        value.ok_or_else(|| {
            let message = format!("`{object}` has no `{figure}` in this run");
            Error::of(Diagnostic::error("no-value", message).path(format!("{object}.{figure}")))
        })
    }

    fn unknown(&self, object: &str) -> Error {
        let known: Vec<&str> = self.figures.objects.keys().map(String::as_str).collect();
        Error::unknown("object", object, &known)
    }
}
