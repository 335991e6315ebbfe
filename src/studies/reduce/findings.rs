//! What looking for the smallest scene leaves.

use super::cost::Cost;
use super::removal::{Part, Removal};
use crate::frontend::scene::{Document, Levels};
use crate::studies::order::{Certificate, FigureAccuracy};
use serde::Serialize;
use std::collections::BTreeMap;
use std::fmt;

/// The smallest scene found, and how it was found.
#[derive(Clone, Debug)]
pub struct Reduction {
    /// Name of the scene.
    pub scene: String,
    /// False when it was ended before everything was tried.
    pub complete: bool,
    /// What was left out or tried to be, in the order of trying.
    pub steps: Vec<Step>,
    /// What the figures of the reduced scene are worth, and the level of every elastic object.
    pub certificate: Certificate,
    /// Every model that was run.
    pub models: Vec<ModelTried>,
    /// Cost of the scene as given and of the reduced one, measured; `None`: both are the same, or
    /// they could not be run again.
    pub cost: Option<Cost>,
    /// The scene that is offered: the reduced one, its descriptions saying what was left out; the
    /// scene as given where the reduced one runs slower.
    pub document: Document,
}

/// A removal that was tried.
#[derive(Clone, Debug, PartialEq)]
pub struct Step {
    /// What was left out.
    pub removal: Removal,
    /// What it changes in each figure that is asked for and has a limit.
    pub changes: BTreeMap<String, Change>,
    /// Why it stays in; `None`: it is left out.
    pub refused: Option<Refusal>,
}

/// What a removal changes in a figure.
#[derive(Clone, Copy, Debug, PartialEq, Serialize)]
pub struct Change {
    /// Value without it less value with it, in the figure's unit.
    pub change: f64,
    /// |change| as a share of the error that is asked for; null where none is allowed and
    /// there is a change.
    pub share: Option<f64>,
}

/// Why something stays in the scene.
#[derive(Clone, Debug, PartialEq)]
pub enum Refusal {
    /// A figure would be less accurate than it is asked to be.
    Figure {
        /// Its address.
        figure: String,
        /// How far it would be off; `None`: there would be no such figure.
        error: Option<f64>,
    },
    /// The pair of this object would open, which the simpler model takes to stay closed.
    Opens(String),
    /// The run would end early, or not be trusted.
    Doubt(String),
    /// There is no such scene.
    Impossible(String),
}

/// A model that was run.
#[derive(Clone, Debug, PartialEq, Serialize)]
pub struct ModelTried {
    /// What was left out beside levels, in words.
    pub without: Vec<String>,
    /// The level of every elastic object.
    pub levels: Levels,
    /// Coordinates of all of them.
    pub coordinates: usize,
    /// Time that its run took, by the clock (s).
    pub seconds: f64,
    /// How far each figure with a limit may be off; null where it has no value.
    pub errors: BTreeMap<String, Option<f64>>,
    /// Which one it is.
    pub role: Role,
}

/// Which model it is of those that were run.
#[derive(Clone, Copy, Debug, PartialEq, Eq, Serialize)]
#[serde(rename_all = "snake_case")]
pub enum Role {
    /// The scene as it was given.
    Given,
    /// One on the way.
    Tried,
    /// The reduced scene.
    Reduced,
}

impl Reduction {
    /// What is left out of the reduced scene.
    pub fn removed(&self) -> impl Iterator<Item = &Step> {
        self.steps.iter().filter(|step| step.refused.is_none())
    }

    /// What stays in it.
    pub fn refused_steps(&self) -> impl Iterator<Item = &Step> {
        self.steps.iter().filter(|step| step.refused.is_some())
    }

    /// The model in a role.
    pub fn model(&self, role: Role) -> Option<&ModelTried> {
        self.models.iter().find(|model| model.role == role)
    }

    /// True when the scene as given is as accurate as it is asked to be.
    pub fn given_holds(&self) -> bool {
        let within = |(figure, error): (&String, &Option<f64>)| {
            let asked = self.certificate.accuracy.get(figure).map(|one| one.asked);
            error.is_some_and(|error| asked.is_some_and(|asked| error <= asked))
        };
        let given = self.model(Role::Given);
        given.is_some_and(|model| model.errors.iter().all(within))
    }

    /// The figure of the scene as given that is farthest beyond its bound, with its error
    /// (`None`: it has no value) and the bound; `None`: the scene as given is as accurate as it
    /// is asked to be, or could not be run.
    pub fn given_excess(&self) -> Option<(&str, Option<f64>, &FigureAccuracy)> {
        let given = self.model(Role::Given)?;
        let beyond = given.errors.iter().filter_map(|(figure, error)| {
            let accuracy = self.certificate.accuracy.get(figure)?;
            let within = error.is_some_and(|error| error <= accuracy.asked);
            (!within).then_some((figure.as_str(), *error, accuracy))
        });
        let share = |error: Option<f64>, asked: f64| error.map_or(f64::INFINITY, |e| e / asked);
        beyond.max_by(|a, b| share(a.1, a.2.asked).total_cmp(&share(b.1, b.2.asked)))
    }

    /// False when the reduced scene runs slower than the scene as given, which is accurate enough:
    /// the latter is the answer.
    pub fn is_offered(&self) -> bool {
        let slower = self.cost.as_ref().is_some_and(Cost::is_slower);
        !(slower && self.given_holds())
    }

    /// True when every figure that has a limit is as accurate as it is asked to be, and
    /// there is at least one.
    pub fn holds(&self) -> bool {
        let mut figures = self.certificate.accuracy.values();
        self.certificate.holds() && figures.any(|figure| figure.error.is_some())
    }
}

impl Step {
    /// The greatest change, with its figure; `None`: no figure has one.
    pub fn greatest(&self) -> Option<(&String, Change)> {
        let share = |change: &Change| change.share.unwrap_or(f64::INFINITY);
        let all = self.changes.iter();
        let greatest = all.max_by(|a, b| share(a.1).total_cmp(&share(b.1)));
        greatest.map(|(figure, change)| (figure, *change))
    }
}

impl fmt::Display for Removal {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        write!(f, "{}: {}", self.object, self.part)
    }
}

impl fmt::Display for Part {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        match self {
            Self::Level { from, to } => write!(f, "{to} in place of {from}"),
            Self::Opening => f.write_str("a bilateral contact, which never separates"),
            Self::Contact => f.write_str("no contact element in the pair"),
            Self::Load(name) => write!(f, "without `{name}`"),
            Self::Stop(name) => write!(f, "without the stop `{name}`"),
            Self::JointFriction => f.write_str("without friction in its joints"),
            Self::Friction(pair) => write!(f, "without friction in `{pair}`"),
            Self::Gravity => f.write_str("without the weights of its links"),
            Self::Masses => f.write_str("massless links"),
            Self::Mass(link) => write!(f, "massless link `{link}`"),
        }
    }
}
