//! A run taken phase by phase, so that several trees can be followed side by side.

use super::hermite::End;
use super::phase::Exponentials;
use super::problem::{PairState, Refusal};
use super::request::{ExactRun, ExactSwitch, Halt, Request};
use super::run::CompletedPhase;
use super::track::{Ahead, TreeFigures};
use super::workspace::{self, Workspace};
use super::{ExactTree, observe};
use crate::dynamics::energy::EnergyAudit;

/// A run of a tree, standing at the end of its present phase.
///
/// Over a phase the motion is known in closed form and can be evaluated anywhere.
pub struct Cursor<'a> {
    work: Workspace<'a>,
    request: Request,
    passed: Option<CompletedPhase>,
    /// States of the pairs over the present phase.
    states: Vec<PairState>,
    /// Switches taken before the present phase ended.
    before: usize,
    e: Exponentials,
}

impl<'a> Cursor<'a> {
    /// A run of `tree` to `end` (s), before its first phase; nothing but the motion is
    /// asked for.
    ///
    /// # Errors
    /// The state at t = 0 has no answer; see [`Refusal`].
    pub fn new(tree: &'a ExactTree, end: f64) -> Result<Self, Refusal> {
        Self::of(tree, &Request::new(end, 0), &workspace::never_stop)
    }

    /// A run of `tree` for a request, for as long as `goes_on` says so.
    ///
    /// # Errors
    /// As [`Self::new`].
    pub fn of(
        tree: &'a ExactTree,
        request: &Request,
        goes_on: &'a dyn Fn() -> bool,
    ) -> Result<Self, Refusal> {
        let mut work = Workspace::new(tree, request)?;
        work.goes_on = goes_on;
        Ok(Self {
            states: work.states.clone(),
            e: work.search.e.clone(),
            work,
            request: request.clone(),
            passed: None,
            before: 0,
        })
    }

    /// Goes through the next phase; false when the end has been reached, or the run is
    /// not to go on ([`Self::halt`]).
    ///
    /// # Errors
    /// Modes that cannot be separated, numbers that are no longer finite.
    pub fn next_phase(&mut self) -> Result<bool, Refusal> {
        if self.work.has_ended(&self.request) {
            return Ok(false);
        }
        self.states.copy_from_slice(&self.work.states);
        self.before = self.work.out.switches.len();
        // (Where there is no further one the run stands at the end of the last.)
        self.passed = None;
        self.passed = Some(self.work.advance_phase(&self.request)?);
        Ok(true)
    }

    /// Why the run does not go on before its end.
    pub fn halt(&self) -> Option<Halt> {
        self.work.out.halt
    }

    /// Start of the present phase (s), in double-double: the sum and its rounding error.
    pub fn start(&self) -> (f64, f64) {
        (self.work.phase.start, self.work.phase.low)
    }

    /// Length of the present phase (s).
    pub fn length(&self) -> f64 {
        self.passed.map_or(0.0, |passed| passed.length)
    }

    /// End of the present phase (s); t = 0 before the first.
    pub fn time(&self) -> f64 {
        self.work.at.0
    }

    /// Local time of the instant `time` (s) in the present phase, within it.
    pub fn local(&self, time: f64) -> f64 {
        self.work.phase.local(time).clamp(0.0, self.length())
    }

    /// States of the pairs over the present phase, by mass.
    pub fn states(&self) -> &[PairState] {
        &self.states
    }

    /// The switch that ended the present phase.
    pub fn switch(&self) -> Option<&ExactSwitch> {
        self.work.out.switches.get(self.before)
    }

    /// Phases gone through, and evaluations in the search.
    pub fn counts(&self) -> (u64, u64) {
        (self.work.out.phases, self.work.search.evaluations)
    }

    /// Steps of the search over which a pair could not be told from its flank.
    pub fn grazing(&self) -> u64 {
        self.work.search.grazing
    }

    /// Samples up to the end of the present phase, as in [`ExactRun::samples`].
    pub fn samples(&self) -> &[f64] {
        &self.work.out.samples
    }

    /// q and q̇ of every mass at the end of the present phase.
    pub fn end_state(&self) -> (&[f64], &[f64]) {
        (&self.work.q, &self.work.v)
    }

    /// q and q̇ of every mass at local time `s` of the present phase.
    pub fn state(&mut self, s: f64, q: &mut [f64], v: &mut [f64]) {
        let Some(passed) = self.passed else {
            q.copy_from_slice(&self.work.q);
            v.copy_from_slice(&self.work.v);
            return;
        };
        observe::state(&self.work, passed.regime, s, &mut self.e, (q, v));
    }

    /// Figures of an object up to the end of the present phase, the mean left out; zeros
    /// where none are asked for.
    pub fn figures(&self, object: usize) -> TreeFigures {
        let track = self.work.tracks.get(object);
        track.map_or(TreeFigures::default(), |track| track.figures)
    }

    /// ∫|δ| dt of an object up to the end of the present phase, where it is asked for.
    pub fn area(&self, object: usize) -> f64 {
        self.work.tracks.get(object).map_or(0.0, |track| track.area)
    }

    /// Energy audit up to the end of the present phase, where it is asked for.
    pub fn audit(&self) -> Option<EnergyAudit> {
        let ledger = self.work.ledger.as_ref()?;
        Some(ledger.final_energies(self.work.problem, &self.work.q, &self.work.v))
    }

    /// Bounds of the force of link 1 of an object, which has figures, between two local
    /// times of the present phase.
    pub(crate) fn force_ahead(&self, object: usize, span: [f64; 2]) -> Ahead {
        self.bounds_in_phase((object, observe::FORCE), span)
    }

    /// The force of link 1 of an object, which has figures, and its slope, at local time
    /// `s` of the present phase; positive where it pulls back a mass with x > 0.
    pub(crate) fn link_force(&mut self, object: usize, s: f64) -> End {
        let Some(passed) = self.passed.filter(|_| !self.work.tracks.is_empty()) else {
            return End::default();
        };
        let first = self.work.problem.objects[object].first;
        let (flanks, count) = self.work.problem.masses[first].pair.flanks();
        // The panel has the pull away from the flank.
        let sign = match self.states[first] {
            PairState::Engaged(flank) if count > 0 => flanks[usize::from(flank)].sign,
            _ => 1.0,
        };
        let pull = observe::force(&mut self.work, passed.regime, object, s, &mut self.e);
        End {
            f: sign * pull.f,
            g: sign * pull.g,
            ..pull
        }
    }

    /// Bounds of the acceleration of its last mass, between two local times of the
    /// present phase.
    pub(crate) fn acceleration_ahead(&self, object: usize, span: [f64; 2]) -> Ahead {
        self.bounds_in_phase((object, observe::ACCELERATION), span)
    }

    fn bounds_in_phase(&self, what: (usize, usize), span: [f64; 2]) -> Ahead {
        let passed = self.passed.filter(|_| !self.work.tracks.is_empty());
        let ahead = |passed: CompletedPhase| {
            observe::bounds_in_phase(&self.work, passed.regime, what, span)
        };
        passed.map_or(Ahead::UNKNOWN, ahead)
    }

    /// Ends the run where it stands.
    pub fn finish(self) -> ExactRun {
        self.work.finish(&self.request)
    }
}
