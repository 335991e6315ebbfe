//! How to run a system.

pub use crate::budget::Budget as Control;
use crate::dynamics::integrate::{Limits, Method};
use crate::dynamics::model::SpanFigure;
use crate::fault::Fault;
use crate::frontend::scene::{Expected, StudyAddress, TypedScene};
use serde::Serialize;

/// Most steps of a run; a bound against runs that would never end.
const MOST_STEPS: u64 = 1_000_000_000;

/// Settings of a run: everything its results depend on beside the system.
#[derive(Clone, Debug, PartialEq, Serialize)]
pub struct RunSettings {
    /// Name of the scene.
    pub scene: String,
    /// Hash of the canonical scene.
    pub hash: String,
    /// Simulated time (s), from t = 0.
    pub duration: f64,
    /// The method; `None`: chosen for the system.
    pub method: Option<Method>,
    /// Error wanted, relative to the scales of the state.
    pub tolerance: f64,
    /// The tolerance that the accuracy asked of the figures leaves, where nobody said one: runs
    /// whose method is chosen take it in place of `tolerance`.
    #[serde(skip_serializing_if = "Option::is_none")]
    pub of_accuracy: Option<ToleranceOfAccuracy>,
    /// Fixed or greatest step (s).
    pub step: Option<f64>,
    /// Number of equal sample intervals.
    pub samples: usize,
    /// True: two rows (before, after) at each switch of a pair.
    pub switch_rows: bool,
    /// True: columns of every mass and link of elastic objects too.
    pub masses: bool,
    /// True: more samples behind every switch of a pair ([`crate::dynamics::record::Closeups`]).
    pub closeups: bool,
    /// Window of steady figures (s); `None`: chosen.
    pub window: Option<(f64, f64)>,
    /// Greatest and least values within parts of the motion that are wanted.
    #[serde(skip_serializing_if = "Vec::is_empty")]
    pub spans: Vec<SpanFigure>,
    /// Most switches of pairs.
    pub max_switches: u64,
    /// Most steps.
    pub max_steps: u64,
}

/// A tolerance that follows from the accuracy that is asked of the figures.
#[derive(Clone, Debug, PartialEq, Serialize)]
pub struct ToleranceOfAccuracy {
    /// The tolerance.
    pub tolerance: f64,
    /// Why it is this one.
    pub why: String,
}

impl RunSettings {
    /// The settings that a scene asks for.
    ///
    /// # Errors
    /// The scene's method is not known.
    pub fn of(scene: &TypedScene) -> Result<Self, Fault> {
        let run = &scene.run;
        Ok(Self {
            scene: scene.name.clone(),
            hash: scene.hash.clone(),
            method: method_named(&run.method)?,
            duration: run.duration,
            tolerance: run.tolerance,
            of_accuracy: None,
            step: run.step,
            samples: run.samples,
            switch_rows: run.switch_rows,
            masses: run.masses,
            closeups: false,
            window: run.window,
            spans: spans_expected(scene),
            max_switches: run.max_switches,
            max_steps: MOST_STEPS,
        })
    }

    /// Settings of a run of a system that comes from no scene: method chosen,
    /// tolerance 1e-6, 1000 samples, at most a million switches.
    pub fn new(duration: f64) -> Self {
        Self {
            scene: String::new(),
            hash: String::new(),
            duration,
            method: None,
            tolerance: 1e-6,
            of_accuracy: None,
            step: None,
            samples: 1000,
            switch_rows: false,
            masses: false,
            closeups: false,
            window: None,
            spans: Vec::new(),
            max_switches: 1_000_000,
            max_steps: MOST_STEPS,
        }
    }

    /// The same with the tolerance that a run takes.
    pub(super) fn with_effective_tolerance(&self) -> Self {
        let of_accuracy = self.of_accuracy.clone().filter(|_| self.method.is_none());
        Self {
            tolerance: (of_accuracy.as_ref()).map_or(self.tolerance, |found| found.tolerance),
            of_accuracy,
            ..self.clone()
        }
    }
}

/// What a scene expects within parts of the motion of its run, each once.
fn spans_expected(scene: &TypedScene) -> Vec<SpanFigure> {
    let figures = scene.expect.iter().filter_map(|one| match &one.what {
        Expected::Figure { figure, .. } => StudyAddress::span_of_run(figure),
        Expected::Stops { .. } => None,
    });
    let mut found: Vec<SpanFigure> = figures.collect();
    found.sort_by(|one, other| one.address.cmp(&other.address));
    found.dedup();
    found
}

impl<'a> Control<'a> {
    /// The bounds on a run with these settings.
    pub(crate) fn limits(&self, settings: &RunSettings) -> Limits<'a> {
        Limits {
            switches: settings.max_switches,
            steps: settings.max_steps,
            budget: *self,
        }
    }
}

fn method_named(name: &str) -> Result<Option<Method>, Fault> {
    if name == "auto" {
        return Ok(None);
    }
    let known = || std::iter::once(Method::Exact).chain(Method::ALL);
    match known().find(|method| method.name() == name) {
        Some(method) if method.is_available() => Ok(Some(method)),
        Some(method) => Err(without_diffsol(method)),
        None => {
            let names: Vec<&str> = known().map(Method::name).collect();
            Err(Fault::new(
                "run.method",
                format!("unknown method `{name}`"),
                format!("one of auto, {}", names.join(", ")),
            ))
        }
    }
}

/// A method that this build of the program does not have.
fn without_diffsol(method: Method) -> Fault {
    Fault::new(
        "run.method",
        format!("`{method}` is a method of diffsol, which this build of dam does not have"),
        "build with `cargo build --release --features diffsol`, or use `rodas5p`, `radau` or `auto`",
    )
}

#[cfg(test)]
mod tests {
    use super::method_named;
    use crate::dynamics::integrate::Method;

    #[test]
    fn methods_are_known_by_name() {
        assert_eq!(method_named("auto"), Ok(None));
        assert!(super::without_diffsol(Method::Bdf).message.contains("bdf"));
        for method in Method::available().chain([Method::Exact]) {
            assert_eq!(method_named(method.name()), Ok(Some(method)));
        }
        assert!(method_named("euler").unwrap_err().hint.contains("dop853"));
    }
}
