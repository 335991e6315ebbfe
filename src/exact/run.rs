//! The run: phases and switches in turn.

use super::lanes::{Arith, Task, run_out_of_line};
use super::observe::Tracks;
use super::problem::Refusal;
use super::request::{ExactRun, ExactSwitch, Halt, Request};
use super::search::Step;
use super::workspace::Workspace;
use crate::units::shown;

/// Steps of the search between two looks at whether the run is to go on; a
/// power of two.
const PATIENCE: u64 = 1024;

/// Phases on end that a fast mode cuts short before it is asked how many are to come.
const SHORT: u64 = 1 << 16;

/// Most such phases to come.
const MOST_SHORT: f64 = (1u64 << 24) as f64;

/// Lanes times parts of steps that the figures walk through between two looks.
const WALKED: u64 = 1 << 18;

/// A phase gone through.
#[derive(Clone, Copy, Debug)]
pub(super) struct CompletedPhase {
    /// Number of its regime.
    pub(super) regime: usize,
    /// Length of the phase (s).
    pub(super) length: f64,
    /// The watch that ended it; `None`: the end of its validity.
    pub(super) event: Option<usize>,
}

#[cold]
fn not_finite() -> Refusal {
    Refusal::new("", "the motion is no longer a finite number")
}

/// Passes one phase more in the best arithmetic of this processor.
fn forward(work: &mut Workspace<'_>, end: f64) -> Result<CompletedPhase, Refusal> {
    run_out_of_line(work.plain, Pass { work, end })
}

/// A phase to be passed.
struct Pass<'a, 'p> {
    work: &'a mut Workspace<'p>,
    end: f64,
}

impl Task for Pass<'_, '_> {
    type Output = Result<CompletedPhase, Refusal>;

    #[inline(always)]
    fn run<A: Arith>(self) -> Self::Output {
        self.work.pass_phase::<A>(self.end)
    }
}

impl Workspace<'_> {
    /// The next phase with the switch that ends it; what is said of the run in the end
    /// is up to date.
    pub(super) fn advance_phase(&mut self, request: &Request) -> Result<CompletedPhase, Refusal> {
        let passed = forward(self, request.end)?;
        self.take_switch(&passed)?;
        if passed.event.is_some() || self.phase.reach < self.regimes[passed.regime].basis.longest {
            self.short = 0;
        } else {
            self.short += 1;
            let to_come = (request.end - self.at.0) / passed.length;
            if self.short > SHORT && to_come > MOST_SHORT {
                return Err(self.too_fast());
            }
        }
        // Phases without a switch take no steps of the search.
        if self.out.phases.is_multiple_of(PATIENCE) {
            self.told |= !(self.goes_on)();
        }
        self.out.halt = self.halt(request);
        Ok(passed)
    }

    /// True when the run stands at its end, or is not to go on.
    pub(super) fn has_ended(&self, request: &Request) -> bool {
        self.reached(request.end) || self.out.halt.is_some()
    }

    /// All phases, one after the other.
    pub(super) fn run(mut self, request: &Request) -> Result<ExactRun, Refusal> {
        loop {
            self.advance_phase(request)?;
            if self.has_ended(request) {
                return Ok(self.finish(request));
            }
        }
    }

    /// Why the run is not to go on.
    fn halt(&self, request: &Request) -> Option<Halt> {
        if self.reached(request.end) {
            None
        } else if self.out.switches.len() as u64 > request.switches {
            Some(Halt::Switches)
        } else if self.told {
            Some(Halt::Cancelled)
        } else {
            let steps = self.search.steps.max(self.out.phases);
            (steps >= self.most_steps[1]).then_some(Halt::Steps)
        }
    }

    /// The run's figures and end state.
    pub(super) fn finish(mut self, request: &Request) -> ExactRun {
        let length = self.at.0;
        for track in &mut self.tracks {
            track.figures.sigma = track.area / length;
            self.out.figures.push(track.figures);
        }
        if let Some(ledger) = &self.ledger {
            self.out.audit = Some(ledger.final_energies(self.problem, &self.q, &self.v));
        }
        self.out.time = self.at.0;
        self.out.complete = self.reached(request.end);
        self.out.displacement = self.q;
        self.out.speed = self.v;
        self.out.steps = self.search.steps;
        self.out.evaluations = self.search.evaluations;
        self.out.exponentials = self.search.exponentials;
        self.out.grazing = self.search.grazing;
        self.out
    }

    /// True when the run stands at `end`.
    #[inline(always)]
    pub(super) fn reached(&self, end: f64) -> bool {
        self.at.0 + self.at.1 >= end
    }

    /// One phase, up to its switch or to the end of its validity; the run then
    /// stands there, the switch not yet taken.
    #[inline(always)]
    fn pass_phase<A: Arith>(&mut self, end: f64) -> Result<CompletedPhase, Refusal> {
        let regime = self.regime()?;
        self.out.phases += 1;
        let entry = &self.regimes[regime];
        // The projection uses q, v up; the tracks look at the copy.
        self.q_end.copy_from_slice(&self.q);
        self.v_end.copy_from_slice(&self.v);
        let (basis, steady) = (&entry.basis, entry.steady.as_ref());
        let (q, v) = (&mut self.q, &mut self.v);
        self.phase
            .begin_phase::<A>(self.problem, basis, steady, self.at, q, v);
        let passed = self.follow_phase::<A>(regime, end);
        if passed.is_err() {
            // The run stands where the phase began.
            self.q.copy_from_slice(&self.q_end);
            self.v.copy_from_slice(&self.v_end);
        }
        passed
    }

    /// The phase that has begun, up to its switch or to the end of its validity.
    #[inline(always)]
    fn follow_phase<A: Arith>(
        &mut self,
        regime: usize,
        end: f64,
    ) -> Result<CompletedPhase, Refusal> {
        let horizon = self.phase.local(end).min(self.phase.reach);
        self.search.restart(&self.phase);
        self.begin_tracks::<A>(regime);
        self.begin_ledger(regime);
        let event = self.pass::<A>(regime, horizon)?;
        self.process_noted_steps::<A>(regime);
        if self.tracks.iter().any(|track| track.lost) {
            return Err(self.too_fast());
        }
        let entry = &self.regimes[regime];
        self.phase.revive(&entry.basis);
        let s = self.search.e.s;
        self.phase
            .state::<A>(&entry.basis, &mut self.search.e, &mut self.q, &mut self.v);
        if !self.q.iter().chain(&self.v).all(|x| x.is_finite()) {
            return Err(not_finite());
        }
        self.q_end.copy_from_slice(&self.q);
        self.v_end.copy_from_slice(&self.v);
        let (strides, samples) = (entry.strides.as_ref(), &mut self.out.samples);
        self.sampler
            .phase::<A>(&entry.basis, strides, &self.phase, s, samples);
        self.end_tracks::<A>(regime);
        self.end_ledger::<A>(regime);
        self.at = self.phase.time(s);
        self.keep_zeros::<A>(regime, event);
        Ok(CompletedPhase {
            regime,
            length: s,
            event,
        })
    }

    /// Remembers which signals, besides the one that fired, started on zero and
    /// are still there within rounding: where several pairs switch at one instant
    /// each is judged by its derivatives until it has left.
    #[inline(always)]
    fn keep_zeros<A: Arith>(&mut self, regime: usize, event: Option<usize>) {
        if self.watches.len() < 2 {
            self.zeros.fill(0);
            return;
        }
        let basis = &self.regimes[regime].basis;
        for number in 0..self.watches.len() {
            let f = self.watches[number].functional;
            let signal = &self.signals[f];
            let still = signal.leaving && event != Some(number) && {
                let (jet, _) = signal.jet::<A>(basis, self.phase.active, &self.search.e);
                let clock = f64::EPSILON * self.search.e.s * jet[1].abs();
                jet[0].abs() <= 2.0 * (signal.noise + clock)
            };
            let zeros = if self.search.e.s == 0.0 {
                signal.zeros
            } else {
                1
            };
            self.kept.push((f, if still { zeros } else { 0 }));
        }
        self.zeros.fill(0);
        for (f, zeros) in self.kept.drain(..) {
            self.zeros[f] = zeros;
        }
    }

    /// Takes the switch that ended a phase, if one did.
    fn take_switch(&mut self, passed: &CompletedPhase) -> Result<(), Refusal> {
        if let Some(number) = passed.event {
            self.stalled = if passed.length > 0.0 {
                0
            } else {
                self.stalled + 1
            };
            self.search.grazing += u64::from(self.returns(number));
            if self.stalled > 8 * self.states.len() {
                return Err(Refusal::new(
                    "",
                    "contacts change without end at one instant",
                ));
            }
            self.switch(number, self.at.0);
        } else {
            self.release_from_law();
        }
        Ok(())
    }

    /// True when the pair that is about to switch back has just switched at this
    /// very instant: what decides is lost in rounding.
    fn returns(&self, number: usize) -> bool {
        let watch = self.watches[number];
        let back = |last: &ExactSwitch| last.mass == watch.mass && last.before == watch.target;
        let last = self.out.switches.last();
        self.stalled > 0 && last.is_some_and(|last| back(last) && last.time == self.at.0)
    }

    /// Lets modes leave that have died away.
    #[inline(always)]
    fn drop_faded_modes<A: Arith>(&mut self, regime: usize) {
        while self
            .phase
            .fades(&self.regimes[regime].basis, &self.search.e)
        {
            self.process_noted_steps::<A>(regime);
            self.phase.drop_last_vector(&mut self.search.e);
        }
    }

    #[cold]
    fn too_fast(&self) -> Refusal {
        let time = self.at.0 + self.search.e.s;
        Refusal::new(
            "",
            format!(
                "a natural frequency is too high to be followed beyond t = {} s",
                shown(time, 7)
            ),
        )
    }

    #[cold]
    fn crawling(&self, steps: u64) -> Refusal {
        let time = self.at.0 + self.search.e.s;
        Refusal::new(
            "",
            format!(
                "the search for the next event took {steps} steps and is at t = {} s",
                shown(time, 7)
            ),
        )
    }

    /// Follows the phase to its end: the number of the watch that fired, or
    /// none at the horizon.
    #[inline(always)]
    fn pass<A: Arith>(&mut self, regime: usize, horizon: f64) -> Result<Option<usize>, Refusal> {
        let limit = self.search.steps.saturating_add(self.most_steps[0]);
        // What is watched has changed.
        let mut anew = true;
        loop {
            if anew {
                self.watch();
                self.take_signals::<A>(regime);
                if horizon <= 0.0 {
                    return Ok(None);
                }
            }
            let steps = self.search.steps;
            if steps >= limit {
                return Err(self.crawling(self.most_steps[0]));
            }
            let walked = self.tracks.iter().map(|track| track.walked).sum();
            if steps.is_multiple_of(PATIENCE) || walked > self.walked + WALKED {
                self.walked = walked;
                self.told |= !(self.goes_on)();
            }
            if self.told || steps >= self.most_steps[1] {
                return Ok(None);
            }
            let entry = &self.regimes[regime];
            let mut witness = Tracks {
                tracks: &mut self.tracks,
                variants: &self.variants,
                regime: entry,
                phase: &self.phase,
            };
            let step = self.search.step::<A>(
                &entry.basis,
                &self.phase,
                &mut self.signals,
                &self.watched,
                horizon,
                &mut witness,
            );
            match step {
                Step::NotFinite => return Err(not_finite()),
                Step::Reached => return Ok(None),
                Step::Root(number) => {
                    anew = self.release_cleared_pairs::<A>(regime, Some(number));
                    if !anew {
                        return Ok(Some(number));
                    }
                }
                Step::Free => {
                    self.drop_faded_modes::<A>(regime);
                    anew = self.release_cleared_pairs::<A>(regime, None);
                }
            }
        }
    }
}
