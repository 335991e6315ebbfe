//! Figures and energy audit of an integrated system, step by step.

use super::audit::{Ledger, WEIGHTED};
use super::failure::{self, Failure};
use super::joints::JointTracker;
use super::observed::{Coordinates, ObservedStep, SampleCache};
use super::observer::Observer;
use super::peaks::PLACES;
use super::pieces::{self, Pieces};
use super::rows::is_finite;
use super::settings::RecorderSettings;
use super::smoothness::{Smoothness, smooth_length};
use super::tally::Tally;
use crate::dynamics::energy::EnergyAudit;
use crate::dynamics::integrate::{Modes, SwitchEvent};
use crate::dynamics::segment::Segment;
use crate::dynamics::system::{Energy, ObjectState, Power, System};
use crate::math::polynomial::Step;

mod works;

/// Gathers the figures of all objects of a system, and its works.
pub(crate) struct FigureCollector<'s> {
    observer: Observer<'s>,
    coordinates: Vec<Coordinates>,
    tallies: Vec<Tally>,
    joints: Vec<JointTracker>,
    /// [`Observer::friction_side`] at the places of the present step.
    sides: [u64; 7],
    ledger: Ledger,
    audit: EnergyAudit,
    time: f64,
    /// States at the places of the present step.
    states: Vec<ObjectState>,
    /// What was looked at within the present step.
    looks: SampleCache,
    /// False at the start and after every switch: the state at the start of the
    /// next step is then not that at the end of the last one.
    continues: bool,
    /// Ends of the parts of the present step between kinks of the powers.
    kinks: Vec<f64>,
    failure: Option<Failure>,
    /// Powers at the places of the present step, energies at its end.
    powers: [Power; 7],
    energy: Energy,
    pieces: Pieces,
    parts: Pieces,
    smoothness: Smoothness,
    /// Length of a piece that was smooth enough (s).
    smooth: f64,
    /// Longest step so far (s).
    longest: f64,
    long_steps: bool,
    window: Option<[f64; 2]>,
}

/// Figures, works and failure gathered over a run.
pub(crate) struct CollectedFigures {
    pub(crate) tallies: Vec<Tally>,
    pub(crate) joints: Vec<JointTracker>,
    pub(crate) audit: EnergyAudit,
    pub(crate) failure: Option<Failure>,
    /// Time that the run got to (s).
    pub(crate) time: f64,
}

impl<'s> FigureCollector<'s> {
    /// For one run of `system` from t = 0.
    pub(crate) fn new(system: &'s System, settings: &RecorderSettings) -> Self {
        let count = system.model().objects.len();
        Self {
            observer: Observer::new(system).of_steps(settings.implicit),
            coordinates: (0..count)
                .map(|object| Coordinates::of(system, object))
                .collect(),
            tallies: (0..count)
                .map(|object| Tally::new(system, object, settings.window))
                .collect(),
            joints: system
                .objects_with_friction()
                .map(|(object, component)| JointTracker::new(object, component))
                .collect(),
            sides: [0; 7],
            ledger: Ledger::default(),
            audit: EnergyAudit::default(),
            time: 0.0,
            states: vec![ObjectState::default(); 7 * count],
            looks: SampleCache::default(),
            continues: false,
            kinks: Vec::new(),
            failure: None,
            powers: [Power::default(); 7],
            energy: Energy::default(),
            pieces: Pieces::default(),
            parts: Pieces::default(),
            smoothness: Smoothness::new(settings.tolerance),
            smooth: 0.0,
            longest: 0.0,
            long_steps: settings.long_steps,
            window: settings.window,
        }
    }

    /// The figures of all objects so far.
    pub(crate) fn tallies(&self) -> &[Tally] {
        &self.tallies
    }

    /// The first number that was not finite.
    pub(crate) fn failure(&self) -> Option<&Failure> {
        self.failure.as_ref()
    }

    /// Ends the gathering.
    pub(crate) fn finish(self) -> CollectedFigures {
        CollectedFigures {
            tallies: self.tallies,
            joints: self.joints,
            audit: self.audit,
            failure: self.failure,
            time: self.time,
        }
    }

    /// The start.
    pub(crate) fn start(&mut self, time: f64, y: &[f64], modes: &Modes) {
        self.time = time;
        let states = self.observer.state(time, y, modes);
        let bad = states.iter().position(|state| !is_finite(state));
        for (tally, state) in self.tallies.iter_mut().zip(states) {
            let told = match bad {
                None => *state,
                Some(_) => failure::motion_of(state),
            };
            tally.include_state(time, &told);
        }
        for joints in &mut self.joints {
            joints.start(time, modes);
        }
        let energy = self.observer.energy_of(time, y, modes);
        if bad.is_some() {
            self.note_failure(time, bad);
        } else if !failure::is_sound(&energy) {
            self.note_failure(time, None);
        } else {
            self.ledger.start_energy(energy);
        }
    }

    /// A step.
    pub(crate) fn step(&mut self, step: &Step<'_>, modes: &Modes) {
        if step.end <= 0.0 || self.failure.is_some() {
            return;
        }
        self.observer.begin_step(step.length);
        let (length, most) = (step.end * step.length, pieces::max_pieces(step.degree));
        self.longest = self.longest.max(length);
        // What is short already needs no pieces.
        if !self.long_steps || most as f64 * length <= self.longest {
            return self.short_step(step, modes);
        }
        // As long as those that were smooth in the last step.
        let count = ((length / self.smooth) as usize).min(most - 1) + 1;
        let parts = most.div_ceil(count);
        self.smooth = f64::INFINITY;
        let mut pieces = std::mem::take(&mut self.pieces);
        pieces.for_each_piece(step, count, |piece| self.long_step(piece, parts, modes));
        self.pieces = pieces;
    }

    /// A switch: forces may jump.
    pub(crate) fn switch(&mut self, event: &SwitchEvent<'_>) {
        self.continues = false;
        if self.failure.is_some() {
            return;
        }
        for joints in &mut self.joints {
            joints.switch(event);
        }
        if let Some((impact, _)) = event.impact {
            let energy = self.observer.energy_of(event.time, event.y, event.after);
            self.audit.append(&self.ledger.add_impact(impact, energy));
            let states = self.observer.state(event.time, event.y, event.after);
            for (tally, state) in self.tallies.iter_mut().zip(states) {
                tally.include_state(event.time, state);
            }
        }
    }

    /// States of all objects at all places, with the powers at those that are weighted and
    /// the energies at the end.
    fn observe_step(&mut self, step: &Step<'_>, modes: &Modes) {
        let count = self.tallies.len();
        self.observer.evaluate_places(step);
        for index in 0..PLACES.len() {
            if index > 0 || !self.continues {
                let states = &mut self.states[index * count..(index + 1) * count];
                self.observer.states_at_place(step, index, modes, states);
                if WEIGHTED.contains(&index) {
                    self.powers[index] = self.observer.last_power(modes);
                }
                self.sides[index] = match self.joints.is_empty() {
                    true => 0,
                    false => self.observer.friction_side(),
                };
            }
        }
        self.energy = self.observer.last_energy();
    }

    /// The edges of the window that lie in the step count for the margins.
    fn see_window_edges(&mut self, step: &Step<'_>, modes: &Modes) {
        if self.tallies.iter().all(|tally| tally.margins().is_none()) {
            return;
        }
        for edge in self.window.into_iter().flatten() {
            let s = (edge - step.start) / step.length;
            if 0.0 < s && s < step.end {
                let states = self.observer.at(step, s, modes);
                for (tally, state) in self.tallies.iter_mut().zip(states) {
                    tally.include_state(edge, state);
                }
            }
        }
    }

    /// A long step or a piece of it, in up to `most` parts, if it takes so many
    /// until it is smooth.
    fn long_step(&mut self, step: &Step<'_>, most: usize, modes: &Modes) {
        self.observe_step(step, modes);
        let roughness = self.smoothness.of(&self.states, &self.tallies);
        let length = step.end * step.length;
        let needed = smooth_length(length, roughness);
        let count = ((length / needed) as usize).min(most - 1) + 1;
        self.smooth = self.smooth.min(needed);
        if count == 1 || !self.states.iter().all(is_finite) {
            return self.take_step(step, modes);
        }
        // The state at its start is that of its first part.
        self.continues = true;
        let mut parts = std::mem::take(&mut self.parts);
        parts.for_each_piece(step, count, |part| self.short_step(part, modes));
        self.parts = parts;
    }

    /// A step within which a motion bends once.
    fn short_step(&mut self, step: &Step<'_>, modes: &Modes) {
        self.observe_step(step, modes);
        self.take_step(step, modes);
    }

    /// Takes a step into account that has been observed.
    fn take_step(&mut self, step: &Step<'_>, modes: &Modes) {
        if !self.observed_numbers(step.start) {
            return;
        }
        self.time = step.end_time();
        self.continues = true;
        self.see_window_edges(step, modes);
        let works = self.balance_step(step, modes);
        self.looks.clear();
        let mut segment = ObservedStep {
            step,
            modes,
            observer: &mut self.observer,
            looks: &mut self.looks,
            states: &self.states,
            coordinates: &self.coordinates,
            works,
        };
        for (object, tally) in self.tallies.iter_mut().enumerate() {
            tally.add_segment(object, &mut segment);
        }
        self.audit.append(&segment.works());
        // The end of this step is the start of the next.
        let last = 6 * self.tallies.len();
        for (tally, state) in self.tallies.iter_mut().zip(&self.states[last..]) {
            tally.set_last(state);
        }
        self.states.copy_within(last.., 0);
        self.sides[0] = self.sides[6];
    }

    /// True when all that was observed of the present step is numbers; the first
    /// failure is noted, with `time` the start of the step.
    fn observed_numbers(&mut self, time: f64) -> bool {
        let powers = &self.powers[WEIGHTED];
        let sound = powers.iter().all(|power| {
            (power.drives + power.loads + power.dissipated + power.friction).is_finite()
        });
        let objects = self.tallies.len();
        if let Some(index) = self.states.iter().position(|state| !is_finite(state)) {
            self.note_failure(time, Some(index % objects));
        } else if !(sound && failure::is_sound(&self.energy)) {
            self.note_failure(time, None);
        }
        self.failure.is_none()
    }

    /// Notes the first failure: in a state of `object`, or in the energies.
    fn note_failure(&mut self, time: f64, object: Option<usize>) {
        let model = self.observer.system().model();
        let found = || Failure::of(model, time, object);
        self.failure.get_or_insert_with(found);
    }
}
