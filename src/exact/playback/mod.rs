//! Playback: the exact motion of all trees of a system, told to a listener step
//! by step as an integration would.
//!
//! The phases of all trees are merged in time. Between their ends, and between
//! the joints of the prescribed motions, steps are laid whose polynomials of
//! degree 15 have the exact derivatives of order 0 … 7 at both ends. Their
//! length is that at which the error of the polynomial, and of five-point
//! quadrature of powers on it, is near rounding for the modes that are still
//! alive.

mod bernstein;
mod beside;
mod branch;
mod given;
mod paces;
mod tracks;

use super::{ExactTree, Parts, Refusal};
use crate::integrate::{
    Dynamics, Limits, Method, Modes, Outcome, Sink, Statistics, Stop, SwitchEvent, Watch,
};
use crate::system::{InitialState, Scratch, System};
use bernstein::{DEGREE, Output};
use branch::Branch;
use given::Given;
use paces::Paces;
use tracks::Tracks;

pub(crate) use beside::{Beside, play_beside};

/// Two instants closer than this, in units of the clock, are one.
const RESOLUTION: f64 = 16.0 * f64::EPSILON;

/// What is to be played.
#[derive(Clone, Copy, Debug)]
pub(crate) struct Piece {
    /// End time (s).
    pub(crate) end: f64,
    /// Greatest step (s).
    pub(crate) step: f64,
}

/// Plays a system, all of whose coordinates are in `parts`, from its start.
///
/// Ends at the end time, or earlier for the reason given in the outcome; what
/// was played up to then has reached the sink.
pub(crate) fn play(
    system: &System,
    parts: &Parts,
    initial: &InitialState,
    piece: Piece,
    limits: &Limits<'_>,
    sink: &mut dyn Sink,
) -> Outcome {
    let trees = trees(parts, initial);
    match Player::new(system, parts, &trees, initial, piece, limits) {
        Ok(mut player) => {
            player.begin(sink);
            player.play_to(piece.end, None, sink);
            player.outcome()
        }
        Err(stop) => {
            sink.start(0.0, &initial.y, &initial.modes);
            Outcome {
                time: 0.0,
                stop,
                statistics: Statistics::default(),
            }
        }
    }
}

/// The trees at their start.
fn trees(parts: &Parts, initial: &InitialState) -> Vec<ExactTree> {
    let trees = parts.trees.iter();
    trees.map(|part| part.tree(&initial.y)).collect()
}

struct Player<'a> {
    system: &'a System,
    branches: Vec<Branch<'a>>,
    tracks: Tracks<'a>,
    paces: Paces<'a>,
    modes: Modes,
    y: Vec<f64>,
    dy: Vec<f64>,
    scratch: Scratch,
    output: Output,
    watches: Vec<Watch>,
    time: f64,
    piece: Piece,
    limits: &'a Limits<'a>,
    steps: u64,
    switches: u64,
    stop: Option<Stop>,
}

impl<'a> Player<'a> {
    /// A player before its start; why there is none, where a tree has none.
    fn new(
        system: &'a System,
        parts: &'a Parts,
        trees: &'a [ExactTree],
        initial: &InitialState,
        piece: Piece,
        limits: &'a Limits<'a>,
    ) -> Result<Self, Stop> {
        let mut branches = Vec::with_capacity(trees.len());
        for (part, tree) in parts.trees.iter().zip(trees) {
            let branch = Branch::new(part, tree, piece.end);
            branches.push(branch.map_err(|refusal| gave_up(system, part.objects[0], refusal))?);
        }
        Ok(Self {
            system,
            branches,
            tracks: Tracks::new(system, parts, piece.end),
            paces: Paces::new(&parts.spans),
            modes: initial.modes.clone(),
            y: initial.y.clone(),
            dy: vec![0.0; initial.y.len()],
            scratch: system.scratch(),
            output: Output::new(system),
            watches: Vec::new(),
            time: 0.0,
            piece,
            limits,
            steps: 0,
            switches: 0,
            stop: None,
        })
    }

    /// Tells the start and goes into the first phases.
    fn begin(&mut self, sink: &mut dyn Sink) {
        for branch in &self.branches {
            branch.take_modes(&mut self.modes);
        }
        self.tracks.begin(&mut self.modes);
        sink.start(0.0, &self.y, &self.modes);
        for index in 0..self.branches.len() {
            self.go_on(index);
        }
    }

    /// Plays up to `end` (s), with what is `given` beside the trees.
    fn play_to(&mut self, end: f64, given: Option<&Given<'_>>, sink: &mut dyn Sink) {
        while self.stop.is_none() && self.time < end {
            let ends = self.branches.iter().map(|branch| branch.cursor.time());
            let cut = ends.fold(end, f64::min);
            let cut = cut.min(self.tracks.next(self.system, self.time, &self.modes));
            let cut = cut.min(self.paces.next(self.time));
            self.steps_to(cut, given, sink);
            if self.stop.is_none() {
                self.time = cut;
                self.advance(given, sink);
                self.pass_tracks(given, sink);
            }
        }
    }

    /// Steps from where the player stands to `cut`.
    fn steps_to(&mut self, cut: f64, given: Option<&Given<'_>>, sink: &mut dyn Sink) {
        let mut open = false;
        while self.stop.is_none() && cut - self.time > RESOLUTION * cut.abs() {
            if !open {
                self.look_at(self.time, given);
                self.output.take_left(&self.branches);
                open = true;
            }
            let rest = cut - self.time;
            let longest = self.branches.iter().map(|b| b.longest(self.time));
            let greatest = self.piece.step.min(self.paces.longest());
            let longest = longest.fold(greatest, f64::min);
            // Equal steps, if no more than a few are left.
            let length = rest / (rest / longest).ceil().max(1.0);
            let to = if rest - length <= 0.5 * RESOLUTION * cut.abs() {
                cut
            } else {
                self.time + length
            };
            self.look_at(to, given);
            let span = (self.time, to);
            self.output.take_right(&self.branches, span, given);
            if let Some(what) = self.not_finite() {
                self.stop = Some(Stop::NotFinite { what });
                return;
            }
            sink.step(&self.output.step(), &self.modes);
            self.output.move_on();
            self.time = to;
            self.steps += 1;
            self.check_limits();
        }
    }

    /// Puts state and derivatives of all branches, and the extra signals, at
    /// an instant.
    fn look_at(&mut self, time: f64, given: Option<&Given<'_>>) {
        if let Some(given) = given {
            given.put(time, &mut self.y, &mut self.dy);
        }
        for branch in &mut self.branches {
            branch.look_at(time);
            branch.put(&mut self.y, &mut self.dy);
        }
        let extra = self.output.extra();
        self.system.extra_signals(
            time,
            &self.y,
            &self.dy,
            &self.modes,
            &mut self.scratch,
            extra,
        );
    }

    fn not_finite(&self) -> Option<String> {
        let bad = |entry: &f64| !entry.is_finite();
        let index = self.y.iter().chain(&self.dy).position(bad)?;
        Some(self.system.state_name(index % self.y.len()))
    }

    /// Takes the switches due now and goes on to the next phases.
    fn advance(&mut self, given: Option<&Given<'_>>, sink: &mut dyn Sink) {
        let due = self.time + 0.5 * RESOLUTION * self.time.abs();
        for index in 0..self.branches.len() {
            while self.stop.is_none() && self.branches[index].cursor.time() <= due {
                self.take_switch(index, given, sink);
                self.check_limits();
                if self.stop.is_some() || !self.go_on(index) {
                    break;
                }
            }
        }
    }

    /// The next phase of a branch; false when there is none.
    fn go_on(&mut self, index: usize) -> bool {
        let branch = &mut self.branches[index];
        match branch.cursor.advance() {
            Ok(more) => more,
            Err(refusal) => {
                let object = branch.part.objects[0];
                self.stop = Some(gave_up(self.system, object, refusal));
                false
            }
        }
    }

    /// Tells the switch that ended the present phase of a branch.
    fn take_switch(&mut self, index: usize, given: Option<&Given<'_>>, sink: &mut dyn Sink) {
        let Some((component, mode)) = self.branches[index].switched() else {
            return;
        };
        let before = self.modes.clone();
        if before.0[component] == mode {
            return;
        }
        self.look_at(self.time, given);
        self.switches += 1;
        self.change(component, mode, sink);
    }

    fn pass_tracks(&mut self, given: Option<&Given<'_>>, sink: &mut dyn Sink) {
        let changes = self.tracks.due(self.system, self.time, &self.modes);
        for (component, mode) in changes {
            self.look_at(self.time, given);
            self.change(component, mode, sink);
        }
    }

    fn change(&mut self, component: usize, mode: i64, sink: &mut dyn Sink) {
        self.system.watches(&self.modes, &mut self.watches);
        let own = |watch: &&Watch| watch.component == component && watch.target == mode;
        let watch = self.watches.iter().find(own).copied();
        let before = self.modes.clone();
        self.modes.0[component] = mode;
        sink.switch(&SwitchEvent {
            time: self.time,
            y: &self.y,
            watch: watch.as_ref(),
            before: &before,
            after: &self.modes,
        });
    }

    fn check_limits(&mut self) {
        let limits = self.limits;
        if self.stop.is_some() || self.time >= self.piece.end {
        } else if self.switches > limits.switches {
            let bound = limits.switches;
            self.stop = Some(Stop::TooManySwitches { bound });
        } else if self.steps >= limits.steps {
            let bound = limits.steps;
            self.stop = Some(Stop::TooManySteps { bound });
        } else if let Some(spent) = limits.budget.spent() {
            self.stop = Some(spent.into());
        }
    }

    fn outcome(self) -> Outcome {
        let counts = self.branches.iter().map(|branch| branch.cursor.counts());
        let (steps, evaluations) = counts.fold((0, 0), |sum, own| (sum.0 + own.0, sum.1 + own.1));
        Outcome {
            time: self.time,
            stop: self.stop.unwrap_or(Stop::Complete),
            statistics: Statistics {
                steps,
                rejected: 0,
                evaluations,
                switches: self.switches,
            },
        }
    }
}

fn gave_up(system: &System, object: usize, refusal: Refusal) -> Stop {
    let id = &system.model().objects[object].id;
    Stop::Method {
        method: Method::Exact,
        reason: format!("{id}: {}", refusal.reason),
    }
}

const _: () = assert!(DEGREE <= crate::polynomial::MAX_DEGREE);
