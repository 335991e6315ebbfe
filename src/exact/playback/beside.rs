//! Trees played beside an integration of the rest of a system.
//!
//! What hangs on a prescribed drive on separate branches is separate: the trees
//! know nothing of the rest, nor it of them. The rest is integrated as a system
//! of its own; each of its steps is told on in parts that end where those of
//! the trees do, all coordinates together, so that a listener hears of one
//! motion of one system.

use super::given::Given;
use super::{Piece, Player, trees};
use crate::exact::{Parts, Rest};
use crate::integrate::{Dynamics, Limits, Modes, Outcome, Sink, Statistics, SwitchEvent};
use crate::polynomial::Step;
use crate::system::{InitialState, System};

/// A system taken apart: its trees, and the rest.
#[derive(Clone, Copy)]
pub(crate) struct Beside<'a> {
    pub(crate) system: &'a System,
    pub(crate) parts: &'a Parts,
    pub(crate) rest: &'a Rest,
}

/// Plays the trees beside the rest, which `integrate` integrates from the state
/// that it is given into the sink that it is given.
///
/// Ends where either does. Trees that give up are not waited for: their reason
/// is that of the whole.
pub(crate) fn play_beside(
    beside: Beside<'_>,
    initial: &InitialState,
    piece: Piece,
    limits: &Limits<'_>,
    sink: &mut dyn Sink,
    integrate: impl FnOnce(&InitialState, &mut dyn Sink) -> Outcome,
) -> Outcome {
    let trees = trees(beside.parts, initial);
    let player = Player::new(beside.system, beside.parts, &trees, initial, piece, limits);
    let player = match player {
        Ok(player) => player,
        Err(stop) => {
            sink.start(0.0, &initial.y, &initial.modes);
            return Outcome {
                time: 0.0,
                stop,
                statistics: Statistics::default(),
            };
        }
    };
    let mut duet = Duet {
        rest: beside.rest,
        player,
        sink,
    };
    let own = integrate(&beside.rest.initial(initial), &mut duet);
    let switches = duet.player.switches;
    let stopped = duet.player.stop.is_some();
    let played = duet.player.outcome();
    let (time, stop) = match stopped {
        true => (played.time, played.stop),
        false => (own.time, own.stop),
    };
    Outcome {
        time,
        stop,
        statistics: Statistics {
            steps: own.statistics.steps + played.statistics.steps,
            rejected: own.statistics.rejected,
            evaluations: own.statistics.evaluations + played.statistics.evaluations,
            switches,
        },
    }
}

/// Listens to the rest and tells of the whole.
struct Duet<'a> {
    rest: &'a Rest,
    player: Player<'a>,
    sink: &'a mut dyn Sink,
}

impl Sink for Duet<'_> {
    fn start(&mut self, _time: f64, _y: &[f64], _modes: &Modes) {
        self.player.begin(self.sink);
    }

    fn step(&mut self, step: &Step<'_>, _modes: &Modes) {
        let given = Given {
            step,
            coordinates: &self.rest.coordinates,
        };
        let end = step.end_time().min(self.player.piece.end);
        self.player.play_to(end, Some(&given), self.sink);
        // Switches at the end itself are told at its state.
        if self.player.stop.is_none() {
            self.player.look_at(self.player.time, Some(&given));
        }
    }

    fn switch(&mut self, event: &SwitchEvent<'_>) {
        let player = &mut self.player;
        if player.stop.is_some() {
            return;
        }
        let changes = event.before.0.iter().zip(&event.after.0);
        for (&component, (before, &after)) in self.rest.components.iter().zip(changes) {
            // What follows from the drives alone the player finds itself.
            if *before == after || player.tracks.follows(player.system, component) {
                continue;
            }
            player.switches += u64::from(player.system.is_pair(component));
            player.change(component, after, self.sink);
        }
        player.check_limits();
    }
}
