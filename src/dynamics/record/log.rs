//! Samples and switches of a run.

mod finish;
mod stretch;

use super::confirmed::ConfirmedPeak;
use super::failure::Failure;
use super::observer::Observer;
use super::pairs::PairTracker;
use super::rows::{Rows, is_finite};
use super::settings::RecorderSettings;
use super::spans::SpanSearch;
use super::tally::CLAIMS;
use super::watch::Watch;
use super::{Interval, SwitchRow};
use crate::dynamics::audit::{InstantSampler, fastest_rate};
use crate::dynamics::integrate::{Dynamics, Modes, SwitchEvent};
use crate::dynamics::system::{MassState, ObjectState, System};
use std::collections::BTreeMap;
use stretch::current_view;

pub(crate) use stretch::{Course, Stretch};

/// Closeups behind a switch at most.
const CLOSEUPS: usize = 96;

/// Most instants of which the states are kept while values within spans are looked for.
const MOST_SEEN: usize = 1000;

/// Parts of a stretch that are looked at in any case.
const PARTS: u32 = 8;

/// Halvings of a part at most.
const DEEPEST: u32 = 8;

/// Share of a column's greatest value by which a straight line between two closeups may
/// miss what lies between them.
const STRAIGHT: f64 = 1e-3;

/// Takes the samples of a run and the switches of its pairs; makes the record and the
/// figures of all that was gathered.
pub(crate) struct Log<'s> {
    pub(super) observer: Observer<'s>,
    settings: RecorderSettings,
    rows: Rows,
    pairs: Vec<PairTracker>,
    switches: Vec<SwitchRow>,
    separations: Vec<Interval>,
    start: f64,
    time: f64,
    /// All masses, where they are recorded.
    masses: Vec<MassState>,
    /// Closeups that may still be taken until the next switch.
    budget: usize,
    /// Times and rows of what were the extremes of figures.
    peaks: Vec<(f64, Vec<f64>)>,
    failure: Option<Failure>,
    /// Greatest values that were seen a second time, by object; whether they are.
    pub(super) confirmed: Vec<Option<ConfirmedPeak>>,
    pub(super) confirms: bool,
    /// Draws what the check of the run looks at.
    looker: InstantSampler,
    watch: Watch,
    spans: SpanSearch,
}

impl<'s> Log<'s> {
    /// For one run of `system` from t = 0.
    pub(crate) fn new(system: &'s System, settings: RecorderSettings) -> Self {
        let model = system.model();
        let all_masses = (0..model.objects.len()).map(|object| system.masses(object));
        let all_masses: usize = all_masses.sum();
        let pair = |object| {
            let stops = system.stops_of_object(object).collect();
            let mut pair = PairTracker::new(object, system.pair_component(object)?, stops);
            pair.is_stop = model.stop(object).is_some();
            pair.is_listed = settings.listing;
            match system.is_rigid_contact(object) {
                true => Some(pair.rigid()),
                false => Some(pair),
            }
        };
        Self {
            observer: Observer::new(system).of_steps(settings.implicit),
            rows: Rows::new(system, settings.masses, settings.samples, settings.duration)
                .with_closeups(settings.closeups),
            pairs: (0..model.objects.len()).filter_map(pair).collect(),
            switches: Vec::new(),
            separations: Vec::new(),
            start: 0.0,
            time: 0.0,
            masses: match settings.masses && settings.samples > 0 {
                true => vec![MassState::default(); all_masses],
                false => Vec::new(),
            },
            budget: 0,
            peaks: Vec::new(),
            failure: None,
            confirmed: vec![None; model.objects.len() * CLAIMS],
            confirms: settings.checked && settings.listing,
            watch: Watch::new(model),
            spans: SpanSearch::new(model, &settings.spans),
            looker: match settings.checked {
                true => {
                    let entries = 2 * system.coordinates();
                    InstantSampler::new(settings.duration, entries, fastest_rate(model))
                }
                false => InstantSampler::drawing_nothing(),
            },
            settings,
        }
    }

    /// The start; what all objects are doing then.
    pub(crate) fn start(&mut self, time: f64, y: &[f64], modes: &Modes) -> &[ObjectState] {
        (self.start, self.time) = (time, time);
        for pair in &mut self.pairs {
            pair.start(time, &modes.0);
        }
        let states = self.observer.state(time, y, modes);
        let bad = states.iter().position(|state| !is_finite(state));
        self.watch.start(time, states);
        if self.rows.is_wanted() {
            let seen = current_view(&self.observer, modes, &mut self.masses);
            self.rows.sample_at(time, seen);
        }
        if bad.is_some() {
            let model = self.observer.system().model();
            self.failure = Some(Failure::of(model, time, bad));
        }
        self.observer.states()
    }

    /// The samples that fall into a stretch, which may be a step.
    pub(crate) fn sample(&mut self, mut stretch: Stretch<'_>) {
        let [from, until] = stretch.span;
        self.draw_instants(&mut stretch);
        self.watch(&mut stretch);
        self.search_spans(&mut stretch);
        while let Some(time) = self.rows.next_sample_until(until) {
            if self.failure.is_some() {
                return;
            }
            let seen = stretch.view_at(time, &mut self.observer, &mut self.masses);
            if !self.rows.sample_at(time, seen) {
                self.note_failure(from);
            }
        }
        if !self.masses.is_empty() && self.rows.nearly_due(until) {
            // The last sample is taken from what was seen last.
            stretch.view_at(until, &mut self.observer, &mut self.masses);
        }
        if self.budget > 0 && self.failure.is_none() {
            self.refine_samples(stretch);
        }
        self.time = until;
    }

    /// The instants that are drawn from a stretch.
    fn draw_instants(&mut self, stretch: &mut Stretch<'_>) {
        let (span, modes) = (stretch.span, stretch.modes);
        match &mut stretch.course {
            Course::Step(step) => {
                let state = &mut |time: f64, y: &mut [f64]| {
                    let s = ((time - step.start) / step.length).clamp(0.0, step.end);
                    step.state(s, y);
                };
                self.looker.stretch(span, modes, false, state);
            }
            Course::Known(state) => {
                self.looker.stretch(span, modes, true, *state);
            }
        }
    }

    /// Looks for the first times of conditions.
    fn watch(&mut self, stretch: &mut Stretch<'_>) {
        if !self.watch.is_looking() || self.failure.is_some() {
            return;
        }
        let whole = matches!(stretch.course, Course::Known(_));
        let (span, observer) = (stretch.span, &mut self.observer);
        self.watch.watch_stretch(span, whole, &mut |time, object| {
            stretch.view_at(time, observer, &mut []).states[object]
        });
    }

    /// Looks for greatest values within spans.
    fn search_spans(&mut self, stretch: &mut Stretch<'_>) {
        if !self.spans.is_looking() || self.failure.is_some() {
            return;
        }
        let whole = matches!(stretch.course, Course::Known(_));
        let (span, observer) = (stretch.span, &mut self.observer);
        // (Several values are looked for at the same instants.)
        let mut seen: BTreeMap<u64, Vec<ObjectState>> = BTreeMap::new();
        self.spans.search_stretch(span, whole, &mut |time, object| {
            if seen.len() > MOST_SEEN {
                seen.clear();
            }
            let states = seen.entry(time.to_bits());
            let look = || stretch.view_at(time, observer, &mut []).states.to_vec();
            states.or_insert_with(look)[object]
        });
    }

    /// A switch.
    pub(crate) fn switch(&mut self, event: &SwitchEvent<'_>) {
        if self.failure.is_some() {
            return;
        }
        self.looker.switch(event);
        let changed = |pair: &&mut PairTracker| {
            event.before.0[pair.component] != event.after.0[pair.component]
        };
        let (mut any, mut off) = (false, Vec::new());
        if let Some((impact, _)) = event.impact {
            any = true;
            let own = |pair: &&mut PairTracker| pair.component == impact.component;
            for pair in self.pairs.iter_mut().filter(own) {
                let id = &self.observer.system().model().objects[pair.object].id;
                let intervals = match pair.is_stop {
                    true => &mut off,
                    false => &mut self.separations,
                };
                pair.add_impact((id, event.time), impact, &mut self.switches, intervals);
            }
        }
        for pair in self.pairs.iter_mut().filter(changed) {
            any = true;
            let (component, held) = (pair.component, pair.is_held(&event.after.0));
            // Impacts in ever shorter times end a little later.
            let rests = event
                .impact
                .filter(|(impact, _)| impact.component == component);
            let rests = rests.and_then(|(impact, _)| impact.rests);
            let known = self
                .observer
                .system()
                .pair_speed(pair.object, event.y, event.before);
            let speed = known.unwrap_or_else(|| {
                let states = self.observer.state(event.time, event.y, event.before);
                states[pair.object].deformation_speed
            });
            pair.switch(
                (
                    &self.observer.system().model().objects[pair.object].id,
                    rests.unwrap_or(event.time),
                ),
                (event.before.0[component], event.after.0[component], held),
                speed,
                &mut self.switches,
                match pair.is_stop {
                    true => &mut off,
                    false => &mut self.separations,
                },
            );
        }
        for pair in self
            .pairs
            .iter_mut()
            .filter(|pair| pair.is_held(&event.after.0))
        {
            let id = &self.observer.system().model().objects[pair.object].id;
            pair.reach_stop(id, event.time, &mut self.separations);
        }
        if any {
            self.budget = match self.rows.follow_switch() {
                true => CLOSEUPS,
                false => 0,
            };
        }
        if any && self.settings.switch_rows {
            let struck = event.impact.map_or(event.y, |(_, before)| before);
            for (y, modes) in [(struck, event.before), (event.y, event.after)] {
                self.observer.state(event.time, y, modes);
                let seen = current_view(&self.observer, modes, &mut self.masses);
                if !self.rows.push(event.time, seen) {
                    return self.note_failure(event.time);
                }
            }
        }
    }

    /// Keeps rows at the instants, among `times`, of extremes met in a stretch: where they
    /// last, they are closeups.
    pub(crate) fn keep_rows(&mut self, times: impl Iterator<Item = f64>, mut stretch: Stretch<'_>) {
        if !self.settings.closeups || self.failure.is_some() {
            return;
        }
        let [from, until] = stretch.span;
        for time in times.filter(|time| from <= *time && *time <= until) {
            if self.peaks.iter().any(|kept| kept.0 == time) {
                continue;
            }
            let seen = stretch.view_at(time, &mut self.observer, &mut self.masses);
            if let Some(values) = self.rows.values(seen) {
                self.peaks.push((time, values.to_vec()));
            }
        }
    }

    /// Takes samples between those that are due, where straight lines between them would
    /// not show the course of every column.
    fn refine_samples(&mut self, mut stretch: Stretch<'_>) {
        let [from, until] = stretch.span;
        let mut row = |log: &mut Self, time: f64| -> Option<Vec<f64>> {
            let seen = stretch.view_at(time, &mut log.observer, &mut log.masses);
            log.rows.values(seen).map(<[f64]>::to_vec)
        };
        let Some(first) = row(self, from) else {
            return self.note_failure(from);
        };
        self.rows.push_closeup(from, &first);
        // Ends of what is still to be looked at, the nearest last.
        let mut ends: Vec<(f64, Vec<f64>, u32)> = Vec::new();
        for part in (1..=PARTS).rev() {
            let time = from + (until - from) * (f64::from(part) / f64::from(PARTS));
            match row(self, time) {
                Some(values) => ends.push((time, values, 0)),
                None => return self.note_failure(from),
            }
        }
        let (mut time, mut values) = (from, first);
        while let Some((to, last, depth)) = ends.pop() {
            let middle = 0.5 * (time + to);
            let Some(between) = row(self, middle) else {
                return self.note_failure(from);
            };
            let straight = self.rows.is_straight([&values, &between, &last], STRAIGHT);
            if straight || depth == DEEPEST || self.budget == 0 {
                self.rows.push_closeup(to, &last);
                self.budget = self.budget.saturating_sub(1);
                (time, values) = (to, last);
            } else {
                ends.push((to, last, depth + 1));
                ends.push((middle, between, depth + 1));
            }
        }
    }

    fn note_failure(&mut self, time: f64) {
        let states = self.observer.states();
        let bad = states.iter().position(|state| !is_finite(state));
        let model = self.observer.system().model();
        self.failure = Some(Failure::of(model, time, bad));
    }

    /// States of all objects at a state of the system.
    pub(crate) fn observe(&mut self, time: f64, y: &[f64], modes: &Modes) -> &[ObjectState] {
        self.observer.state(time, y, modes)
    }

    /// The first number that was not finite.
    pub(crate) fn failure(&self) -> Option<&Failure> {
        self.failure.as_ref()
    }

    /// The window, when the run got to its end.
    fn window(&self) -> Option<[f64; 2]> {
        self.settings
            .window
            .filter(|[_, to]| self.time >= to * (1.0 - 1e-12))
    }
}
