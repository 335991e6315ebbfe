//! The exact motion of all trees of a system, side by side, with whatever is known of
//! what is left beside them.
//!
//! The phases of all trees are merged in time, with the changes of formula of the
//! prescribed motions between them: what lies between two of these is a stretch over
//! which nothing switches, and a listener is told of it as a whole. Nothing is laid
//! between its ends: a tree is known in closed form at every instant of its phase, and
//! so are its figures and its works.
//!
//! The listener takes what lies between two events; `audit` closes the energies.

mod branch;
mod clock;
mod given;
mod paces;
mod switches;
mod tracks;

use super::{ExactTree, Parts, Refusal, Request};
use crate::dynamics::integrate::{Method, Modes, Outcome, Statistics, Stop, SwitchEvent};
use crate::dynamics::system::{InitialState, System};
use paces::Paces;
use tracks::Tracks;

pub(crate) use branch::Branch;
pub(crate) use clock::Clock;
pub(crate) use given::RemainderStep;

/// Two instants closer than this, in units of the clock, are one.
const RESOLUTION: f64 = 16.0 * f64::EPSILON;

/// A change of formula farther off than this, in units of the clock, is not due yet,
/// however it is rounded.
const NEAR: f64 = 1e-9;

/// Hears of a walk.
pub(crate) trait Listener {
    /// The start.
    fn start(&mut self, y: &[f64], modes: &Modes);

    /// Forgets what was told of the phases of a tree: they are told anew.
    fn reset_tree(&mut self, number: usize);

    /// A tree, by its number, has gone through its next phase; the walk does not stand
    /// at its end yet.
    fn phase(&mut self, number: usize, branch: &mut Branch<'_>);

    /// A stretch without switches.
    fn stretch(&mut self, motion: &mut Motion<'_, '_>, span: [f64; 2], modes: &Modes);

    /// A switch of a pair, or a change of formula.
    fn switch(&mut self, event: &SwitchEvent<'_>);
}

/// The whole motion over a stretch.
pub(crate) struct Motion<'m, 'a> {
    pub(crate) branches: &'m mut [Branch<'a>],
    pub(crate) given: Option<&'m RemainderStep<'m>>,
}

impl Motion<'_, '_> {
    /// The state y = [u, u̇] at an instant.
    pub(crate) fn state(&mut self, time: f64, y: &mut [f64]) {
        use crate::dynamics::segment::Segment;
        if let Some(given) = self.given {
            given.write_state(time, y);
        }
        for branch in self.branches.iter_mut() {
            branch.state(time, y);
        }
    }
}

/// Route of a walk: the system with its trees, from the start to the end.
#[derive(Clone, Copy)]
pub(crate) struct Schedule<'a> {
    pub(crate) system: &'a System,
    pub(crate) parts: &'a Parts,
    /// Trees at their start, one for each of the parts'.
    pub(crate) trees: &'a [ExactTree],
    pub(crate) initial: &'a InitialState,
    /// End time (s).
    pub(crate) end: f64,
    /// True: listeners look at the whole system, not at the trees alone; the formulas
    /// of prescribed motions then change in their turn.
    pub(crate) whole: bool,
}

/// All trees on their way.
pub(crate) struct EventLoop<'a> {
    way: Schedule<'a>,
    requests: Vec<Request>,
    system: &'a System,
    branches: Vec<Branch<'a>>,
    tracks: Option<Tracks<'a>>,
    paces: Paces<'a>,
    modes: Modes,
    before: Modes,
    y: Vec<f64>,
    time: f64,
    end: f64,
    clock: &'a Clock<'a>,
    switches: u64,
    stop: Option<Stop>,
}

impl<'a> EventLoop<'a> {
    /// A walk before its start, `request` giving what is asked for of each tree; why
    /// there is none, where a tree has none.
    pub(crate) fn new(
        way: Schedule<'a>,
        request: &dyn Fn(usize) -> Request,
        clock: &'a Clock<'a>,
        goes_on: &'a dyn Fn() -> bool,
    ) -> Result<Self, Stop> {
        let Schedule { system, parts, .. } = way;
        let mut branches = Vec::with_capacity(way.trees.len());
        let requests: Vec<Request> = (0..way.trees.len()).map(request).collect();
        let trees = parts.trees.iter().zip(way.trees);
        for ((part, tree), request) in trees.zip(&requests) {
            let branch = Branch::new(part, tree, request, goes_on);
            branches.push(branch.map_err(|refusal| gave_up(system, part.objects[0], refusal))?);
        }
        Ok(Self {
            way,
            requests,
            system,
            branches,
            tracks: way.whole.then(|| Tracks::new(system, parts, way.end)),
            paces: Paces::new(if way.whole { &parts.spans } else { &[] }),
            modes: way.initial.modes.clone(),
            before: way.initial.modes.clone(),
            y: way.initial.y.clone(),
            time: 0.0,
            end: way.end,
            clock,
            switches: 0,
            stop: None,
        })
    }

    /// Tells the start and goes into the first phases.
    pub(crate) fn begin_phases(&mut self, listener: &mut dyn Listener) {
        for branch in &self.branches {
            branch.take_modes(&mut self.modes);
        }
        if let Some(tracks) = &mut self.tracks {
            tracks.set_first_segments(&mut self.modes);
            self.system.open_guards(&mut self.modes);
        }
        listener.start(&self.y, &self.modes);
        for index in 0..self.branches.len() {
            self.advance_branch(index, listener);
        }
    }

    /// Walks up to `end` (s), with what is `given` beside the trees.
    pub(crate) fn advance_to(
        &mut self,
        end: f64,
        given: Option<&RemainderStep<'_>>,
        listener: &mut dyn Listener,
    ) {
        while self.is_running(end) {
            self.advance_to_next_event(end, given, listener);
        }
    }

    /// Walks to the next change of anything, at most to `end` (s).
    pub(crate) fn advance_to_next_event(
        &mut self,
        end: f64,
        given: Option<&RemainderStep<'_>>,
        listener: &mut dyn Listener,
    ) {
        let ends = self.branches.iter().map(|branch| branch.cursor.time());
        let mut cut = ends.fold(end, f64::min);
        let mut change = f64::INFINITY;
        if let Some(tracks) = &self.tracks {
            change = tracks.next_change(self.system, self.time, &self.modes);
            cut = cut.min(change).min(self.paces.next_joint(self.time));
        }
        if cut - self.time > RESOLUTION * cut.abs() {
            let mut motion = Motion {
                branches: &mut self.branches,
                given,
            };
            listener.stretch(&mut motion, [self.time, cut], &self.modes);
        }
        self.time = cut;
        self.advance_phases(given, listener);
        if change <= cut + NEAR * cut.abs() {
            self.pass_tracks(given, listener);
        }
        self.check_switches();
    }

    /// Tells the phases of trees anew that the end cuts, up to there.
    pub(crate) fn report_cut_phases(&mut self, listener: &mut dyn Listener) {
        for number in 0..self.branches.len() {
            let beyond = self.branches[number].cursor.time() - self.time;
            if beyond <= RESOLUTION * self.time.abs() {
                continue;
            }
            let (part, tree) = (&self.way.parts.trees[number], &self.way.trees[number]);
            let request = Request {
                end: self.time,
                ..self.requests[number].clone()
            };
            // It has got as far before.
            let Ok(mut branch) = Branch::new(part, tree, &request, &super::workspace::never_stop)
            else {
                continue;
            };
            listener.reset_tree(number);
            if self.time <= 0.0 {
                continue;
            }
            while let Ok(true) = branch.cursor.next_phase() {
                listener.phase(number, &mut branch);
            }
            self.branches[number] = branch;
        }
    }

    /// True before `end` (s), as long as nothing has ended it.
    pub(crate) fn is_running(&self, end: f64) -> bool {
        self.stop.is_none() && self.time < end
    }

    /// True when it is not to go on.
    pub(crate) fn has_stopped(&self) -> bool {
        self.stop.is_some()
    }

    /// Switches of pairs so far.
    pub(crate) fn switches(&self) -> u64 {
        self.switches
    }

    /// Time at which it stands (s).
    pub(crate) fn time(&self) -> f64 {
        self.time
    }

    /// Modes in force where it stands.
    pub(crate) fn modes(&self) -> &Modes {
        &self.modes
    }

    /// The trees.
    pub(crate) fn branches(&mut self) -> &mut [Branch<'a>] {
        &mut self.branches
    }

    /// The state of everything that was told last.
    pub(crate) fn state(&self) -> &[f64] {
        &self.y
    }

    /// State and modes of everything where the walk stands.
    pub(crate) fn current_state(&mut self, given: Option<&RemainderStep<'_>>) -> (&[f64], &Modes) {
        let mut motion = Motion {
            branches: &mut self.branches,
            given,
        };
        motion.state(self.time, &mut self.y);
        (&self.y, &self.modes)
    }

    /// Takes the switches due now and goes on to the next phases.
    fn advance_phases(&mut self, given: Option<&RemainderStep<'_>>, listener: &mut dyn Listener) {
        let due = self.time + 0.5 * RESOLUTION * self.time.abs();
        for index in 0..self.branches.len() {
            while self.stop.is_none() && self.branches[index].cursor.time() <= due {
                self.take_switch(index, given, listener);
                self.check_switches();
                if let Some(halt) = self.branches[index].cursor.halt() {
                    self.stop
                        .get_or_insert_with(|| self.clock.stop_of_halt(halt));
                }
                if self.stop.is_some() || !self.advance_branch(index, listener) {
                    break;
                }
            }
        }
    }

    /// The next phase of a branch; false when there is none.
    fn advance_branch(&mut self, index: usize, listener: &mut dyn Listener) -> bool {
        let branch = &mut self.branches[index];
        match branch.cursor.next_phase() {
            Ok(true) => {
                listener.phase(index, branch);
                true
            }
            Ok(false) => false,
            Err(refusal) => {
                let object = branch.part.objects[0];
                self.stop = Some(gave_up(self.system, object, refusal));
                false
            }
        }
    }

    /// Outcome: how it ended.
    pub(crate) fn outcome(&self) -> Outcome {
        let counts = self.branches.iter().map(|branch| branch.cursor.counts());
        let (steps, evaluations) = counts.fold((0, 0), |sum, own| (sum.0 + own.0, sum.1 + own.1));
        Outcome {
            time: self.time,
            stop: self.stop.clone().unwrap_or(Stop::Complete),
            statistics: Statistics {
                steps,
                rejected: 0,
                evaluations,
                switches: self.switches,
            },
        }
    }

    /// Steps over which a pair could not be told from its flank, of all trees.
    pub(crate) fn grazing(&self) -> u64 {
        let all = self.branches.iter().map(|branch| branch.cursor.grazing());
        all.sum()
    }
}

fn gave_up(system: &System, object: usize, refusal: Refusal) -> Stop {
    let id = &system.model().objects[object].id;
    Stop::Method {
        method: Method::Exact,
        reason: format!("{id}: {}", refusal.reason),
    }
}
