//! The listener that turns a run into a record and figures.

mod failure;
mod works;

use crate::order::Total;
pub use failure::Failure;
use failure::{is_sound, motion_of};

use super::audit::{EnergyAudit, Ledger};
use super::joints::JointTracker;
use super::observer::Observer;
use super::pairs::PairTracker;
use super::pieces::{self, Pieces};
use super::rows::{Rows, is_finite};
use super::smoothness::{Smoothness, smooth_length};
use super::tracker::{ObjectTracker, StepView};
use super::{Interval, ObjectFigures, PairFigures, Record, SwitchRow};
use crate::integrate::{Modes, Sink, SwitchEvent};
use crate::polynomial::{MAX_DEGREE, Step};
use crate::system::{Energy, ObjectState, Power, System};

/// What to record.
#[derive(Clone, Debug, PartialEq)]
pub struct RecorderSettings {
    /// Time at which the run is to end (s); it starts at 0.
    pub duration: f64,
    /// Number of equal intervals between samples (one more row than that).
    pub samples: usize,
    /// True: two more rows (before, after) at every switch of a pair.
    pub switch_rows: bool,
    /// Window in which the working order of pairs is judged (s).
    pub window: Option<[f64; 2]>,
    /// True for power series and collocation, whose steps may be whole
    /// oscillations long: they are looked at in pieces.
    pub long_steps: bool,
    /// Tolerance of the run: the finer, the smaller the pieces.
    pub tolerance: f64,
}

/// What a recorder has gathered when the run is over.
#[derive(Clone, Debug)]
pub struct Recorded {
    /// Samples, switches, separations.
    pub record: Record,
    /// Figures of every object, in the order of the model's objects.
    pub figures: Vec<ObjectFigures>,
    /// The energy balance.
    pub audit: EnergyAudit,
    /// Rigid force-closed pairs: object, least contact force, when (s).
    pub margins: Vec<(usize, f64, f64)>,
    /// The first force, acceleration or energy that was not a finite number at
    /// a state that was. Nothing from that step on is in the figures, the audit
    /// and the record.
    pub failure: Option<Failure>,
}

/// Records a run of a system. Its memory is bounded by samples and switches.
pub struct Recorder<'s> {
    observer: Observer<'s>,
    settings: RecorderSettings,
    rows: Rows,
    objects: Vec<ObjectTracker>,
    pairs: Vec<PairTracker>,
    joints: Vec<JointTracker>,
    /// [`Observer::friction_side`] at the places of the present step.
    sides: [u64; 7],
    ledger: Ledger,
    switches: Vec<SwitchRow>,
    separations: Vec<Interval>,
    start: f64,
    time: f64,
    /// States at the places of the present step.
    states: Vec<ObjectState>,
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
}

impl<'s> Recorder<'s> {
    /// A recorder for one run of `system` from t = 0.
    pub fn new(system: &'s System, settings: RecorderSettings) -> Self {
        let model = system.model();
        let count = model.objects.len();
        let pairs = (0..count)
            .filter_map(|object| {
                let component = system.pair_component(object)?;
                let coordinate = system.first_coordinate(object)?;
                let pair = model.elastic_pair(&model.objects[object])?;
                Some(PairTracker::new(object, component, coordinate, pair))
            })
            .collect();
        Self {
            observer: Observer::new(system),
            rows: Rows::new(model, settings.samples, settings.duration),
            objects: (0..count)
                .map(|object| ObjectTracker::new(system, object, settings.window))
                .collect(),
            pairs,
            joints: system
                .rubbing_objects()
                .map(|(object, component)| JointTracker::new(object, component))
                .collect(),
            sides: [0; 7],
            ledger: Ledger::default(),
            switches: Vec::new(),
            separations: Vec::new(),
            start: 0.0,
            time: 0.0,
            states: vec![ObjectState::default(); 7 * count],
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
            settings,
        }
    }

    /// Ends the recording: closes open intervals and works out the figures.
    pub fn finish(mut self) -> Recorded {
        let last: Vec<ObjectState> = self.objects.iter().map(|object| *object.last()).collect();
        self.rows.finish(self.time, &last);
        let duration = self.time - self.start;
        let mut figures: Vec<ObjectFigures> = self
            .objects
            .iter()
            .map(|object| object.figures(duration))
            .collect();
        for tracker in std::mem::take(&mut self.pairs) {
            let object = tracker.object;
            let id = &self.observer.system().model().objects[object].id;
            let mut pair = tracker.finish(id, self.time, &mut self.separations);
            pair.max_contact_force = self.objects[object].contact_force();
            pair.in_working_order = self.window().map(|[from, to]| {
                !self
                    .separations
                    .iter()
                    .any(|open| open.object == *id && open.from < to && open.to > from)
            });
            figures[object].pair = Some(pair);
        }
        for joints in std::mem::take(&mut self.joints) {
            let object = joints.object;
            figures[object].joints = Some(joints.finish(self.time));
        }
        let margins = self.margins(&mut figures);
        self.separations
            .sort_by_cached_key(|interval| (Total(interval.from), interval.object.clone()));
        let audit = self.ledger.close();
        if !audit.error().is_finite() {
            self.fail(self.time, None);
        }
        let (times, columns) = self.rows.into_columns();
        Recorded {
            record: Record {
                times,
                columns,
                switches: self.switches,
                separations: self.separations,
            },
            figures,
            audit,
            margins,
            failure: self.failure,
        }
    }

    /// The window, when the run got to its end.
    fn window(&self) -> Option<[f64; 2]> {
        self.settings
            .window
            .filter(|[_, to]| self.time >= to * (1.0 - 1e-12))
    }

    fn margins(&self, figures: &mut [ObjectFigures]) -> Vec<(usize, f64, f64)> {
        let mut margins = Vec::new();
        for (object, tracker) in self.objects.iter().enumerate() {
            let Some([(margin, time), (in_window, _)]) = tracker.margins() else {
                continue;
            };
            figures[object].pair = Some(PairFigures {
                max_contact_force: tracker.contact_force(),
                margin: Some(margin),
                in_working_order: self.window().map(|_| in_window >= 0.0),
                ..PairFigures::default()
            });
            margins.push((object, margin, time));
        }
        margins
    }

    /// States of all objects at all places, with powers and energies.
    fn observe_step(&mut self, step: &Step<'_>, modes: &Modes) {
        let count = self.objects.len();
        let places = StepView::places(step.end);
        for (index, &place) in places.iter().enumerate() {
            if index > 0 || !self.continues {
                let states = &mut self.states[index * count..(index + 1) * count];
                let (power, energy) = self.observer.closely(step, place, modes, states);
                (self.powers[index], self.energy) = (power, energy);
                self.sides[index] = match self.joints.is_empty() {
                    true => 0,
                    false => self.observer.friction_side(),
                };
            }
        }
    }

    /// The edges of the window that lie in the step count for the margins.
    fn see_window_edges(&mut self, step: &Step<'_>, modes: &Modes) {
        if self.objects.iter().all(|object| object.margins().is_none()) {
            return;
        }
        for edge in self.settings.window.into_iter().flatten() {
            let s = (edge - step.start) / step.length;
            if 0.0 < s && s < step.end {
                let states = self.observer.at(step, s, modes);
                for (tracker, state) in self.objects.iter_mut().zip(states) {
                    tracker.see(edge, state);
                }
            }
        }
    }

    /// A long step or a piece of it, in up to `most` parts, if it takes so many
    /// until it is smooth.
    fn long_step(&mut self, step: &Step<'_>, most: usize, modes: &Modes) {
        self.observe_step(step, modes);
        let roughness = self.smoothness.of(&self.states, &self.objects);
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
        parts.each(step, count, |part| self.short_step(part, modes));
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
        while let Some(time) = self.rows.due(step.end_time()) {
            let s = ((time - step.start) / step.length).clamp(0.0, step.end);
            let states = self.observer.at(step, s, modes);
            let bad = states.iter().position(|state| !is_finite(state));
            self.rows.sample_at(time, states);
            if bad.is_some() {
                return self.fail(step.start, bad);
            }
        }
        let places = StepView::places(step.end);
        self.time = step.end_time();
        self.continues = true;
        self.see_window_edges(step, modes);
        self.balance_step(step, modes);
        let view = StepView {
            step,
            places,
            states: &self.states,
            objects: self.objects.len(),
        };
        for (object, tracker) in self.objects.iter_mut().enumerate() {
            let observer = &mut self.observer;
            tracker.step(&view, &mut |s| observer.at(step, s, modes)[object]);
        }
        for pair in &mut self.pairs {
            let mode = modes.0[pair.component];
            let mut room = [0.0; MAX_DEGREE + 1];
            let x = step.signal(pair.coordinate(), &mut room);
            pair.step(mode, x, step.end);
        }
        // The end of this step is the start of the next.
        self.states.copy_within(6 * self.objects.len().., 0);
        self.sides[0] = self.sides[6];
    }
}

impl Sink for Recorder<'_> {
    fn start(&mut self, time: f64, y: &[f64], modes: &Modes) {
        (self.start, self.time) = (time, time);
        let states = self.observer.state(time, y, modes);
        let finite = self.rows.sample_at(time, states);
        let bad = states.iter().position(|state| !is_finite(state));
        for (tracker, state) in self.objects.iter_mut().zip(states) {
            let told = if finite { *state } else { motion_of(state) };
            tracker.see(time, &told);
        }
        for pair in &mut self.pairs {
            pair.start(time, modes.0[pair.component]);
        }
        for joints in &mut self.joints {
            joints.start(time, modes);
        }
        let energy = self.observer.energy_of(time, y, modes);
        if bad.is_some() {
            self.fail(time, bad);
        } else if !is_sound(&energy) {
            self.fail(time, None);
        } else {
            self.ledger.open(energy);
        }
    }

    fn step(&mut self, step: &Step<'_>, modes: &Modes) {
        if step.end <= 0.0 || self.failure.is_some() {
            return;
        }
        let (length, most) = (step.end * step.length, pieces::most(step.degree));
        self.longest = self.longest.max(length);
        // What is short already needs no pieces.
        if !self.settings.long_steps || most as f64 * length <= self.longest {
            return self.short_step(step, modes);
        }
        // As long as those that were smooth in the last step.
        let count = ((length / self.smooth) as usize).min(most - 1) + 1;
        let parts = most.div_ceil(count);
        self.smooth = f64::INFINITY;
        let mut pieces = std::mem::take(&mut self.pieces);
        pieces.each(step, count, |piece| self.long_step(piece, parts, modes));
        self.pieces = pieces;
    }

    fn switch(&mut self, event: &SwitchEvent<'_>) {
        self.continues = false;
        if self.failure.is_some() {
            return;
        }
        for joints in &mut self.joints {
            joints.switch(event);
        }
        let changed = |pair: &&mut PairTracker| {
            event.before.0[pair.component] != event.after.0[pair.component]
        };
        let mut any = false;
        for pair in self.pairs.iter_mut().filter(changed) {
            any = true;
            let component = pair.component;
            let state = self.observer.state(event.time, event.y, event.before)[pair.object];
            pair.switch(
                (
                    &self.observer.system().model().objects[pair.object].id,
                    event.time,
                ),
                (event.before.0[component], event.after.0[component]),
                &state,
                &mut self.switches,
                &mut self.separations,
            );
        }
        if any && self.settings.switch_rows {
            for modes in [event.before, event.after] {
                let states = self.observer.state(event.time, event.y, modes);
                let bad = states.iter().position(|state| !is_finite(state));
                if !self.rows.push(event.time, states) {
                    self.fail(event.time, bad);
                }
            }
        }
    }
}
