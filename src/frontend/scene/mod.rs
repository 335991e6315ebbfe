//! Scenes: what the engineer wrote, typed, in SI units, every value still knowing its place in the text.
//!
//! `Places` finds the place in the text for the address of a property.

mod accuracy;
mod address;
mod canonical;
mod catalogue;
mod document;
pub mod edit;
mod expect;
mod figures;
mod folder;
mod identify;
mod levels;
mod numbers;
mod objects;
mod optimize;
#[cfg(feature = "live")]
mod outline;
mod overrides;
mod root;
mod run;
mod schema;
mod span;
mod steady;
mod study_address;
mod template;
mod tolerance;
mod variation;

pub(crate) use catalogue::BeforeBuiltIn;
pub use catalogue::{BuiltIn, Catalogue, LayeredCatalogue, NamedBytes};
pub use document::{Document, Places, Reading};
#[cfg(feature = "live")]
pub(crate) use figures::is_expectable;
pub(crate) use figures::{CAM_FIGURES, Figure, STEADY_FIGURES, described_results};
pub use folder::{Folder, read_bounded};
pub use identify::IdentifySpec;
pub use levels::{Elastic, Levels, in_words};
pub use numbers::Number;
pub use optimize::OptimizeSpec;
pub use overrides::Overrides;
pub use schema::{schema, schema_of, schema_text};
pub(crate) use span::SpanAddress;
pub(crate) use study_address::StudyAddress;
pub(crate) use template::Template;
pub use tolerance::ToleranceSpec;
pub use variation::Variation;

use crate::dynamics::model::Condition;
use crate::dynamics::steady::Mean;
use crate::frontend::graph::MechanismGraph;
use crate::frontend::object::{Connection, Object};
use crate::units::Measure;
use serde::Serialize;
use std::collections::BTreeMap;

/// A scene, read and checked.
#[derive(Debug)]
pub struct TypedScene {
    /// Name of the scene.
    pub name: String,
    /// The objects by id.
    pub objects: BTreeMap<String, SceneObject>,
    /// Settings of its run.
    pub run: RunSpec,
    /// Question about its steady motion, if one is asked.
    pub steady: Option<SteadySpec>,
    /// What `dam optimize` is asked, if that is in the scene.
    pub optimize: Option<OptimizeSpec>,
    /// What `dam tolerance` is asked, if that is in the scene.
    pub tolerance: Option<ToleranceSpec>,
    /// What `dam identify` is asked, if that is in the scene.
    pub identify: Option<IdentifySpec>,
    /// Expectations of the run.
    pub expect: Vec<Expectation>,
    /// Numbers with units of figures whose quantity follows from the model.
    pub measured: Vec<MeasuredValue>,
    /// SHA-256 (hex) of the canonical scene: defaults filled in, SI, keys sorted.
    pub hash: String,
}

impl TypedScene {
    /// The mechanism: objects, joined by their ports.
    pub fn graph(&self) -> MechanismGraph<'_> {
        MechanismGraph::new(self.objects.iter().map(|(id, entry)| {
            let connections = entry.connections.iter();
            let inputs = connections.map(|one| (one.port.as_str(), one.output.as_str()));
            (id.as_str(), Some(&*entry.object), inputs.collect())
        }))
    }

    /// Ids of all objects, every driver before what it drives, otherwise in
    /// the order of the ids. A scene that was read has no cycles.
    pub fn order(&self) -> Vec<String> {
        let order = self.graph().order().unwrap_or_default();
        order.into_iter().map(str::to_owned).collect()
    }
}

/// An object of a scene.
#[derive(Debug)]
pub struct SceneObject {
    /// Connections of the inputs; empty for a drive.
    pub connections: Vec<Connection>,
    /// Objects or outputs to whose motion its loads refer.
    pub mentions: Vec<String>,
    /// The object itself.
    pub object: Box<dyn Object>,
}

impl SceneObject {
    /// The output that an input hangs on: `press`, `press.ram`; `None`: nothing.
    pub fn connection(&self, port: &str) -> Option<&str> {
        let found = self.connections.iter().find(|one| one.port == port);
        found.map(|one| one.output.as_str())
    }
}

/// The `run` block.
#[derive(Clone, Debug, PartialEq)]
pub struct RunSpec {
    /// Simulated time (s), > 0.
    pub duration: f64,
    /// State at t = 0.
    pub start: StartSpec,
    /// `auto` or the name of a method.
    pub method: String,
    /// Error wanted in δ relative to its scale; default 1e-6.
    pub tolerance: f64,
    /// True where the scene says the tolerance itself: it is not the default.
    pub tolerance_given: bool,
    /// Fixed or greatest step (s).
    pub step: Option<f64>,
    /// Number of equal sample intervals; default 1000.
    pub samples: usize,
    /// True: two rows (before, after) at each switch.
    pub switch_rows: bool,
    /// True: the record has columns of every mass and link of elastic objects too.
    pub masses: bool,
    /// Window of steady figures (s, s); `None`: chosen.
    pub window: Option<(f64, f64)>,
    /// Most switches before the run is given up; default 1 000 000.
    pub max_switches: u64,
    /// Conditions whose first times are figures; the one named `until` ends the run.
    pub conditions: Vec<Condition>,
    /// Accuracy wanted of its figures; `None`: not asked for.
    pub accuracy: Option<AccuracySpec>,
}

/// How accurate figures are to be, the error of the model included.
#[derive(Clone, Debug, PartialEq)]
pub enum AccuracySpec {
    /// So great a share of each.
    Share(f64),
    /// Of each figure, by its address.
    Figures(Vec<(String, Accuracy)>),
}

/// How accurate a figure is to be.
#[derive(Clone, Copy, Debug, PartialEq, Serialize)]
#[serde(rename_all = "snake_case")]
pub enum Accuracy {
    /// A share of its magnitude: 0.01.
    Share(f64),
    /// An absolute bound, in SI units.
    Bound(f64),
}

/// The `steady` block: what is asked of the steady motion of a drive.
#[derive(Clone, Debug, PartialEq)]
pub struct SteadySpec {
    /// Id of the drive; `None`: the only one.
    pub drive: Option<String>,
    /// Required mean speed (rad/s).
    pub mean_speed: Option<f64>,
    /// Kind of mean; default: the mean over time.
    pub mean: Mean,
    /// Angle after which the machine repeats, or a part of it (rad); default: one turn.
    pub cycle: f64,
    /// True: a constant moment balances the cycle.
    pub balance: bool,
    /// Required coefficient of fluctuation.
    pub fluctuation: Option<f64>,
    /// Tolerance of the mean speed, relative; default 1e-12.
    pub tolerance: f64,
    /// Elastic scenes: most turns after which the motion may repeat; default 1.
    pub periods: usize,
}

impl Default for SteadySpec {
    fn default() -> Self {
        Self {
            drive: None,
            mean_speed: None,
            mean: Mean::Time,
            cycle: std::f64::consts::TAU,
            balance: false,
            fluctuation: None,
            tolerance: 1e-12,
            periods: 1,
        }
    }
}

/// The `start` property.
#[derive(Clone, Debug, PartialEq)]
pub enum StartSpec {
    /// `"kinetostatic"` (default).
    Kinetostatic,
    /// `"static"`.
    Static,
    /// `"on_law"`.
    OnLaw,
    /// `{ "rocker": { "displacement": […], "speed": […] } }`.
    Explicit(BTreeMap<String, (Vec<f64>, Vec<f64>)>),
}

/// One entry of `expect`.
#[derive(Clone, Debug, PartialEq)]
pub struct Expectation {
    /// Figure or end that is expected.
    pub what: Expected,
    /// Source of the figure.
    pub source: Option<String>,
}

/// A number written with a unit, of a figure whose quantity follows from the model.
#[derive(Clone, Debug, PartialEq)]
pub struct MeasuredValue {
    /// Address of the figure.
    pub figure: String,
    /// Address of the number.
    pub path: String,
    /// The number as it is written.
    pub text: String,
    /// What it says.
    pub measure: Measure,
}

/// Values that a figure may have (booleans as 0 and 1).
#[derive(Clone, Copy, Debug, PartialEq)]
pub enum AllowedValues {
    /// A value and what differs from it by no more than an absolute bound.
    Near {
        /// Expected value.
        value: f64,
        /// Absolute bound.
        within: f64,
    },
    /// Everything between two limits, which belong to it; everything on one side of a limit.
    Between {
        /// `at_least`.
        least: Option<f64>,
        /// `at_most`.
        most: Option<f64>,
    },
}

impl AllowedValues {
    /// The limits: infinite where there is none.
    pub fn limits(&self) -> [f64; 2] {
        match *self {
            Self::Near { value, within } => [value - within, value + within],
            Self::Between { least, most } => [
                least.unwrap_or(f64::NEG_INFINITY),
                most.unwrap_or(f64::INFINITY),
            ],
        }
    }

    /// Whether a value is one of them; what is no number is none.
    pub fn contains_value(&self, found: f64) -> bool {
        match *self {
            Self::Near { value, within } => (found - value).abs() <= within,
            Self::Between { least, most } => {
                found.is_finite()
                    && least.is_none_or(|least| found >= least)
                    && most.is_none_or(|most| found <= most)
            }
        }
    }
}

/// Expectation of a run: a figure, or the way it stops.
#[derive(Clone, Debug, PartialEq)]
pub enum Expected {
    /// A figure, by its address (`rocker.delta_max`, `rocker.pair.separations`,
    /// `rocker.final.speed`, `run.switches`). Those
    /// of the steady motion (`steady.period`) are judged by `dam steady`.
    Figure {
        /// Address.
        figure: String,
        /// Values that it may have.
        allowed: AllowedValues,
    },
    /// The run stops at a time for a named reason.
    Stops {
        /// `dead_position`, …
        reason: String,
        /// Time (s).
        time: f64,
        /// Absolute bound (s).
        within: f64,
    },
}
