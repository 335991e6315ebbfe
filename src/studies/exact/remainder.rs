//! What no tree holds, beside trees that are propagated exactly.
//!
//! Its steps are observed like those of an integration. If the drives prescribe all of it,
//! steps are laid over it.

use super::coupled::TreeBase;
use super::forces::Forces;
use super::lever::Drivetrain;
use super::smooth::{NODES, node};
use super::turn::{PARTS, Turn};
use crate::dynamics::integrate::{Modes, SwitchEvent};
use crate::dynamics::model::{LoadLaw, Model, NodeMotion};
use crate::dynamics::record::{FigureCollector, Observer, RecorderSettings};
use crate::dynamics::system::ObjectState;
use crate::exact::Rest;
use crate::exact::event_loop::{Motion, RemainderStep, Schedule};
use crate::kinematics::motion::DriveMotion;
use crate::math::polynomial::Step;

/// Places between the nodes of a stretch, near both its ends, where a polynomial through
/// the nodes is furthest from what it follows.
const BETWEEN: [f64; 2] = [0.125, 0.875];

/// What no tree holds.
pub(super) struct Remainder<'a> {
    pub(super) rest: &'a Rest,
    pub(super) figured: FigureCollector<'a>,
    observer: Observer<'a>,
    modes: Modes,
    /// True where it is integrated: its steps come from outside.
    pub(super) integrated: bool,
    /// True for drives of constant speed under constant loads, and nothing else.
    uniform: bool,
    /// What all objects beside the trees are doing, where nothing but angles changes.
    steady: Option<Vec<ObjectState>>,
    /// How far its figures have been taken (s).
    taken: f64,
    pub(super) coupled: Vec<TreeBase>,
    ways: Vec<Drivetrain>,
    /// What all objects of the whole are doing at the nodes of a stretch, as far as they
    /// are beside the trees.
    states: [Vec<ObjectState>; NODES],
    /// The stretch whose nodes were taken up last (s).
    noted: [f64; 2],
    /// By tree and node, the slopes of the tree's way in the stretch taken up last.
    slopes: Vec<[Vec<f64>; NODES]>,
    /// The same at a place between the nodes: states of all objects, slopes by tree.
    between: (Vec<ObjectState>, Vec<Vec<f64>>),
    /// Forces of the trees in the present stretch.
    pub(super) forces: Forces,
}

impl<'a> Remainder<'a> {
    /// What is beside the trees of a route; true with it where it is integrated.
    pub(super) fn new(
        route: Schedule<'a>,
        settings: &RecorderSettings,
        (rest, integrated): (&'a Rest, bool),
    ) -> Self {
        let ways = Drivetrain::of_all(route.system, route.parts);
        let objects = route.system.model().objects.len();
        Self {
            figured: FigureCollector::new(&rest.system, settings),
            observer: Observer::new(&rest.system),
            modes: Modes(vec![0; rest.modes(&route.initial.modes).0.len()]),
            integrated,
            uniform: is_uniform(rest.system.model()),
            steady: None,
            taken: 0.0,
            coupled: TreeBase::coupled_objects(route.system, &ways, settings.window),
            states: std::array::from_fn(|_| vec![ObjectState::default(); objects]),
            noted: [f64::NAN; 2],
            slopes: vec![std::array::from_fn(|_| Vec::new()); ways.len()],
            between: (
                vec![ObjectState::default(); objects],
                vec![Vec::new(); ways.len()],
            ),
            forces: Forces::new(ways.len()),
            ways,
            rest,
        }
    }

    /// The start of what is integrated.
    pub(super) fn start_integrated(&mut self, y: &[f64], modes: &Modes) {
        self.figured.start(0.0, y, modes);
        self.modes.0.copy_from_slice(&modes.0);
    }

    /// The start of what the drives prescribe.
    pub(super) fn start(&mut self, modes: &Modes, period: Option<f64>) {
        self.modes = self.rest.modes(modes);
        self.figured.start(0.0, &[], &self.modes);
        if !self.uniform {
            return;
        }
        self.take_nodes(None, [0.0, period.unwrap_or(0.0)]);
        self.steady = Some(self.states[0].clone());
        let Some(period) = period else { return };
        // What |G| comes to in every part of a turn.
        let mut turns = vec![Turn::new(period, self.ways.len()); self.coupled.len()];
        for part in 0..PARTS {
            for k in 0..turns.len() {
                self.take_nodes(None, turns[k].span(part));
                turns[k].set(part, self.coupled[k].slopes());
            }
        }
        for (turn, own) in turns.into_iter().zip(&mut self.coupled) {
            own.set_bounds(turn);
        }
        self.noted = [f64::NAN; 2];
    }

    /// A switch in what is integrated.
    pub(super) fn switch_integrated(&mut self, event: &SwitchEvent<'_>) {
        self.figured.switch(event);
        self.modes.0.copy_from_slice(&event.after.0);
        self.noted = [f64::NAN; 2];
    }

    /// A switch of the whole, which may change a formula of what the drives prescribe.
    pub(super) fn switch(&mut self, event: &SwitchEvent<'_>) {
        if self.rest.has_modes(event.after, &self.modes) {
            return;
        }
        self.advance_figures(event.time);
        let modes = self.rest.modes(event.after);
        let before = std::mem::replace(&mut self.modes, modes);
        self.figured.switch(&SwitchEvent {
            impact: None,
            y: &[],
            before: &before,
            after: &self.modes,
            ..event.clone()
        });
        self.noted = [f64::NAN; 2];
    }

    /// Takes up a stretch; false where no force can meet in it what it has not met before.
    pub(super) fn take_stretch(&mut self, motion: &Motion<'_, '_>, span: [f64; 2]) -> bool {
        if self.steady.is_none() && !self.integrated {
            self.advance_figures(span[1]);
        }
        if !self.may_rise(motion, span) {
            return false;
        }
        self.take_nodes(motion.given, span);
        true
    }

    /// False where what is known of the whole run tells that no force can meet in a stretch
    /// what it has not met before.
    pub(super) fn may_rise(&mut self, motion: &Motion<'_, '_>, span: [f64; 2]) -> bool {
        if self.coupled.is_empty() {
            return false;
        }
        self.forces.add_stretch(motion.branches, span);
        let steady = self.steady.as_ref();
        self.coupled.iter().any(|own| {
            let own_force = steady.map(|states| states[own.object].reaction);
            own.may_rise(own_force, &self.forces)
        })
    }

    /// True where nothing but angles changes beside the trees.
    pub(super) fn is_steady(&self) -> bool {
        self.steady.is_some()
    }

    /// Takes figures and works of prescribed motions up to an instant.
    pub(super) fn advance_figures(&mut self, time: f64) {
        if time > self.taken {
            let step = still([self.taken, time]);
            self.figured.step(&step, &self.modes);
            self.taken = time;
        }
    }

    /// Takes up what changes slowly at the nodes of a stretch.
    fn take_nodes(&mut self, given: Option<&RemainderStep<'_>>, span: [f64; 2]) {
        if self.noted == span {
            return;
        }
        let origin = self.state_origin(given);
        // What is given in steps is that of another step at their joint.
        let first = match given.is_none() && self.noted[1] == span[0] {
            true => self.start_next_stretch(),
            false => 0,
        };
        for k in first..NODES {
            let states = observe(&mut self.observer, &self.modes, origin, span, node(k));
            place_states(&self.rest.objects, states, &mut self.states[k]);
            for (slopes, way) in self.slopes.iter_mut().zip(&self.ways) {
                way.take_slopes(&self.states[k], &mut slopes[k]);
            }
        }
        for own in &mut self.coupled {
            own.add_states(&self.states, &self.ways, &self.slopes);
        }
        self.noted = span;
    }

    /// False where a force that may rise does not go through the nodes of the stretch
    /// taken up last as its polynomials do.
    pub(super) fn is_followed(&mut self, motion: &Motion<'_, '_>, span: [f64; 2]) -> bool {
        let rises = |own: &TreeBase| own.rises_within(&self.forces);
        if !self.coupled.iter().any(rises) {
            return true;
        }
        let origin = self.state_origin(motion.given);
        BETWEEN.into_iter().all(|share| {
            let (states, slopes) = &mut self.between;
            let seen = observe(&mut self.observer, &self.modes, origin, span, share);
            place_states(&self.rest.objects, seen, states);
            for (slopes, way) in slopes.iter_mut().zip(&self.ways) {
                way.take_slopes(states, slopes);
            }
            let mut coupled = self.coupled.iter();
            coupled.all(|own| own.follows(share, states, (&self.ways, slopes), &self.forces))
        })
    }

    /// Where the states of what is beside the trees come from.
    fn state_origin<'g>(&self, given: Option<&'g RemainderStep<'g>>) -> Origin<'g> {
        match given {
            Some(given) => Origin::Given(given),
            // Nothing else changes.
            None if self.steady.is_some() => Origin::Angles,
            None => Origin::Prescribed,
        }
    }

    /// Makes the last node of the stretch taken up last the first of the next, and gives the
    /// node to go on with.
    fn start_next_stretch(&mut self) -> usize {
        self.states.swap(0, NODES - 1);
        for slopes in &mut self.slopes {
            slopes.swap(0, NODES - 1);
        }
        1
    }
}

/// Where the states of what is beside the trees come from.
#[derive(Clone, Copy)]
enum Origin<'g> {
    /// The step of an integration.
    Given(&'g RemainderStep<'g>),
    /// The drives prescribe them.
    Prescribed,
    /// The same, of which nothing but angles changes.
    Angles,
}

/// What the objects beside the trees are doing at a share of a stretch.
fn observe<'o>(
    observer: &'o mut Observer<'_>,
    modes: &Modes,
    origin: Origin<'_>,
    span: [f64; 2],
    share: f64,
) -> &'o [ObjectState] {
    match origin {
        Origin::Given(given) => {
            let time = span[0] + share * (span[1] - span[0]);
            let s = (time - given.step.start) / given.step.length;
            let s = s.clamp(0.0, given.step.end);
            observer.at(given.step, s, modes)
        }
        Origin::Angles => observer.motion_at(&still(span), share, modes),
        Origin::Prescribed => observer.at(&still(span), share, modes),
    }
}

/// Puts the states of some objects where those of all stand.
fn place_states(objects: &[usize], states: &[ObjectState], all: &mut [ObjectState]) {
    for (&object, state) in objects.iter().zip(states) {
        all[object] = *state;
    }
}

/// A step of a system without coordinates.
fn still([from, to]: [f64; 2]) -> Step<'static> {
    Step {
        start: from,
        length: to - from,
        end: 1.0,
        coordinates: 0,
        degree: 0,
        bases: &[],
        coefficients: &[],
    }
}

/// True for drives of constant speed under constant loads, and nothing else.
fn is_uniform(model: &Model) -> bool {
    let constant = |motion: &NodeMotion| {
        let NodeMotion::Prescribed { motion, .. } = motion else {
            return false;
        };
        matches!(motion, DriveMotion::Constant { .. })
    };
    let steady = |law: &LoadLaw| law.as_constant().is_some();
    model.nodes.iter().all(|node| constant(&node.motion))
        && model.loads.iter().all(|load| steady(&load.law))
}
