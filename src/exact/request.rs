//! What is asked of a run, and what it leaves behind.

use super::problem::PairState;
use super::requested_figures::RequestedFigures;
use super::track::TreeFigures;
use crate::dynamics::energy::EnergyAudit;
use crate::dynamics::integrate::Impact;

/// Request: what is asked of a run.
#[derive(Clone, Debug, PartialEq)]
pub struct Request {
    /// End time (s), > 0.
    pub end: f64,
    /// Number of equal intervals at whose ends samples are taken (t = 0 is not
    /// one of them); 0: none.
    pub samples: usize,
    /// Samples of every mass, q and q̇; otherwise of the last mass's q alone.
    pub all_masses: bool,
    /// Most switches.
    pub switches: u64,
    /// Most steps of the search between two switches: beyond it the run is an
    /// error and not a crawl.
    pub steps: u64,
    /// Most steps of the search, and most phases, in all: the run then ends where it
    /// stands.
    pub all_steps: u64,
    /// Figures between samples, wanted or not.
    pub figures: bool,
    /// Figures that are asked for, if any.
    pub asked: RequestedFigures,
    /// Energy audit, wanted or not.
    pub audit: bool,
}

impl Request {
    /// A run to `end` with `samples` samples of the last mass.
    pub fn new(end: f64, samples: usize) -> Self {
        Self {
            end,
            samples,
            all_masses: false,
            switches: 1_000_000,
            steps: 10_000_000,
            all_steps: u64::MAX,
            figures: false,
            asked: RequestedFigures::ALL,
            audit: false,
        }
    }
}

/// Why a run ended before its end.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Halt {
    /// There were more switches than allowed.
    Switches,
    /// There were as many steps of the search as allowed.
    Steps,
    /// The budget was cancelled: by a signal or its time limit.
    Cancelled,
}

/// A switch of a pair.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct ExactSwitch {
    /// Time (s).
    pub time: f64,
    /// The mass whose link holds the pair.
    pub mass: usize,
    /// State before.
    pub before: PairState,
    /// State after.
    pub after: PairState,
    /// Ẋ at the switch: speed of parting (> 0) or of approach (< 0).
    pub speed: f64,
    /// The impact that it is, of a rigid pair; its component is the mass.
    pub impact: Option<Impact>,
}

/// Result of a run.
#[derive(Clone, Debug, Default, PartialEq)]
pub struct ExactRun {
    /// Time reached (s).
    pub time: f64,
    /// True when the end was reached.
    pub complete: bool,
    /// Why it was not.
    pub halt: Option<Halt>,
    /// States of the pairs just after t = 0, by mass.
    pub start: Vec<PairState>,
    /// Every switch.
    pub switches: Vec<ExactSwitch>,
    /// Samples: one row an interval end; one column (δ of the last mass), or
    /// q then q̇ of every mass.
    pub samples: Vec<f64>,
    /// Columns of `samples`.
    pub columns: usize,
    /// q at the end.
    pub displacement: Vec<f64>,
    /// q̇ at the end.
    pub speed: Vec<f64>,
    /// Figures of every object, when asked for.
    pub figures: Vec<TreeFigures>,
    /// Energy audit, when asked for.
    pub audit: Option<EnergyAudit>,
    /// Phases, search steps, evaluations.
    pub phases: u64,
    /// Steps of the search.
    pub steps: u64,
    /// Evaluations of the exponentials in the search.
    pub evaluations: u64,
    /// Exponentials e^{λs} in all of them together, in whole vectors.
    pub exponentials: u64,
    /// Steps over which a watched signal could not be told from zero, and switches of a
    /// pair that has just switched at the same instant.
    pub grazing: u64,
}
