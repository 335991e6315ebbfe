//! Working memory of a run.

use super::audit::Ledger;
use super::event_function::EventFunction;
use super::functional::Functional;
use super::lanes::WIDTH;
use super::observe::tracks;
use super::phase::Phase;
use super::problem::{PairState, Refusal, TreeProblem};
use super::regime::Regime;
use super::request::{ExactRun, Request};
use super::sample::Sampler;
use super::search::Search;
use super::signal::Signal;
use super::start;
use super::track::Track;
use super::{ExactTree, Modes};

/// Working memory of a run.
pub(super) struct Workspace<'a> {
    pub(super) problem: &'a TreeProblem,
    pub(super) functionals: &'a [Functional],
    pub(super) first: &'a [usize],
    /// Modes that are known beforehand.
    pub(super) modes: &'a Modes,
    pub(super) regimes: Vec<Regime>,
    pub(super) states: Vec<PairState>,
    pub(super) key: Vec<PairState>,
    pub(super) watches: Vec<EventFunction>,
    pub(super) watched: Vec<usize>,
    pub(super) signals: Vec<Signal>,
    pub(super) phase: Phase,
    pub(super) search: Search,
    pub(super) q: Vec<f64>,
    pub(super) v: Vec<f64>,
    pub(super) q_end: Vec<f64>,
    pub(super) v_end: Vec<f64>,
    /// Number of leading derivatives known to vanish, by functional.
    pub(super) zeros: Vec<usize>,
    /// Room for those that stay.
    pub(super) kept: Vec<(usize, usize)>,
    pub(super) sampler: Sampler,
    pub(super) tracks: Vec<Track>,
    pub(super) ledger: Option<Ledger>,
    /// Panel in use and whether the object's link transmits force.
    pub(super) variants: Vec<(usize, bool)>,
    pub(super) out: ExactRun,
    /// Time at which the run stands, as a double-double (s).
    pub(super) at: (f64, f64),
    /// Switches at one and the same instant.
    pub(super) stalled: usize,
    /// Phases on end that a fast mode cut short.
    pub(super) short: u64,
    /// [`Track::walked`] of all tracks when the run was last asked whether it goes on.
    pub(super) walked: u64,
    /// Most steps of the search in a phase, and in all.
    pub(super) most_steps: [u64; 2],
    /// Asked from time to time.
    pub(super) goes_on: &'a dyn Fn() -> bool,
    /// True when it has said no.
    pub(super) told: bool,
    /// True: without special instructions of the processor.
    pub(super) plain: bool,
}

/// Goes on, whatever happens.
pub(super) fn never_stop() -> bool {
    true
}

/// Room for the samples; what is asked for beyond it is taken as it comes.
fn room_for_samples(request: &Request, n: usize) -> usize {
    const MOST: usize = 1 << 20;
    let columns = if request.all_masses { 2 * n } else { 1 };
    request
        .samples
        .saturating_add(8)
        .saturating_mul(columns)
        .min(MOST)
}

impl<'a> Workspace<'a> {
    pub(super) fn new(tree: &'a ExactTree, request: &Request) -> Result<Self, Refusal> {
        let (problem, functionals, first) = (&tree.problem, &tree.functionals, &tree.first);
        let n = problem.masses.len();
        let harmonics = problem.law.frequencies().len();
        let lanes = super::cluster::most_lanes(n) + harmonics;
        let blocks = lanes.div_ceil(WIDTH);
        let (states, zeros) = start::states(problem, functionals, first)?;
        Ok(Self {
            problem,
            functionals,
            first,
            modes: &tree.modes,
            regimes: Vec::new(),
            key: states.clone(),
            states: states.clone(),
            watches: Vec::with_capacity(2 * n),
            watched: Vec::with_capacity(2 * n),
            signals: vec![Signal::new(blocks, n * harmonics); functionals.len()],
            phase: Phase::new(problem, blocks),
            search: Search::new(blocks, harmonics),
            q: problem.displacement.clone(),
            v: problem.speed.clone(),
            q_end: problem.displacement.clone(),
            v_end: problem.speed.clone(),
            zeros,
            kept: Vec::with_capacity(2 * n),
            sampler: Sampler::new(problem, request, blocks),
            tracks: tracks(problem, request, blocks),
            ledger: request.audit.then(|| Ledger::new(problem)),
            variants: vec![(0, true); problem.objects.len()],
            out: ExactRun {
                start: states.clone(),
                switches: Vec::with_capacity(256),
                samples: Vec::with_capacity(room_for_samples(request, n)),
                columns: if request.all_masses { 2 * n } else { 1 },
                ..ExactRun::default()
            },
            at: (0.0, 0.0),
            stalled: 0,
            short: 0,
            walked: 0,
            most_steps: [request.steps, request.all_steps],
            goes_on: &never_stop,
            told: false,
            plain: false,
        })
    }
}
