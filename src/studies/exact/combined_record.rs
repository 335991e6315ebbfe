//! One record, one list of figures and one audit of trees that are propagated exactly
//! and of all that is beside them.
//!
//! Every tree gives its own figures and works in closed form. What no tree holds is a
//! system of its own: its steps, be they those of an integration or laid here over
//! motions that the drives prescribe, are looked at as those of any system
//! ([`super::remainder`]). What is left are the forces on prescribed objects that trees hang
//! on ([`super::coupled`]), and rigid objects that a mass of a tree carries
//! ([`super::carried`]).

use super::carried::{CarriedObserver, sampled_in_tree};
use super::remainder::Remainder;
use crate::dynamics::energy::EnergyAudit;
use crate::dynamics::integrate::{Dynamics, Modes, Sink, SwitchEvent};
use crate::dynamics::record::{
    Course, Failure, Log, RecorderSettings, RunRecord, Stretch, Tally, drive_cycle,
};
use crate::dynamics::segment::Segment;
use crate::dynamics::system::ObjectState;
use crate::exact::Rest;
use crate::exact::event_loop::{Branch, Listener, Motion, Schedule};
use crate::math::polynomial::Step;

/// Stretches in a turn of the drive over which prescribed motions are looked at.
const IN_CYCLE: f64 = 64.0;

/// Stretches in a run at least.
const IN_RUN: f64 = 64.0;

/// How often a stretch is halved at most: a polynomial through five nodes misses 32⁸ times
/// less then, and what changes by rounding alone ends there.
const HALVINGS: u32 = 8;

/// Radians of a mode that matters between two looks at what a mass carries: seven places
/// tell then where it is greatest.
const RADIANS: f64 = 1.5;

/// Records a walk.
pub(super) struct CombinedRecord<'a> {
    route: Schedule<'a>,
    /// Whether the walk goes on: what is looked at in one stretch may be long.
    goes_on: &'a dyn Fn() -> bool,
    settings: RecorderSettings,
    log: Log<'a>,
    /// By tree, then by object of the tree.
    trees: Vec<Vec<Tally>>,
    pub(super) beside: Option<Remainder<'a>>,
    /// What is looked at in trees, with the tree: see [`sampled_in_tree`].
    carried: Vec<(usize, usize, Tally)>,
    /// Length of a stretch (s).
    length: f64,
    y: Vec<f64>,
    /// States of all objects at the places of a stretch.
    seen: Vec<ObjectState>,
    /// Instants of extremes just found.
    found: Vec<f64>,
    /// Who listens beside the record.
    sink: &'a mut dyn Sink,
}

impl<'a> CombinedRecord<'a> {
    /// For a walk; `rest` where more is wanted than the figures of the trees' own
    /// objects, and true with it where it is integrated.
    pub(super) fn new(
        (route, goes_on): (Schedule<'a>, &'a dyn Fn() -> bool),
        settings: RecorderSettings,
        rest: Option<(&'a Rest, bool)>,
        sink: &'a mut dyn Sink,
    ) -> Self {
        let system = route.system;
        let tallies = |objects: &Vec<usize>| {
            let own = objects.iter();
            own.map(|&object| Tally::new(system, object, settings.window))
                .collect()
        };
        let trees = &route.parts.trees;
        let cycle = drive_cycle(system.model());
        let in_cycle = cycle.map_or(f64::INFINITY, |cycle| cycle / IN_CYCLE);
        let objects = system.model().objects.len();
        Self {
            log: Log::new(system, settings.clone()),
            trees: trees.iter().map(|part| tallies(&part.objects)).collect(),
            carried: match rest {
                Some(_) => sampled_in_tree(route, settings.window),
                None => Vec::new(),
            },
            beside: rest.map(|rest| Remainder::new(route, &settings, rest)),
            length: in_cycle.min(settings.duration / IN_RUN),
            y: vec![0.0; 2 * system.coordinates()],
            seen: vec![ObjectState::default(); if rest.is_some() { 7 * objects } else { 0 }],
            found: Vec::new(),
            settings,
            route,
            goes_on,
            sink,
        }
    }

    /// The walk has come up to an instant, with so many switches of pairs.
    pub(super) fn passes(&mut self, time: f64, switches: u64) {
        self.sink.passes(time, switches);
    }

    /// A step of what is integrated beside the trees, which have been followed to its end.
    pub(super) fn step(&mut self, step: &Step<'_>, modes: &Modes) {
        if let Some(beside) = &mut self.beside {
            beside.figured.step(step, modes);
        }
    }

    /// A switch in what is integrated.
    pub(super) fn switch_integrated(&mut self, event: &SwitchEvent<'_>) {
        if let Some(beside) = &mut self.beside {
            beside.switch_integrated(event);
        }
    }

    /// The start of what is integrated.
    pub(super) fn start_integrated(&mut self, y: &[f64], modes: &Modes) {
        if let Some(beside) = &mut self.beside {
            beside.start_integrated(y, modes);
        }
    }

    /// Where numbers stopped being numbers.
    pub(super) fn failure(&self) -> Option<&Failure> {
        let beside = self.beside.as_ref();
        let beside = beside.and_then(|beside| beside.figured.failure());
        beside.or(self.log.failure())
    }

    /// Forces and rigid objects over a stretch, part by part of the grid; as far as the walk
    /// goes on.
    fn record_forces(&mut self, motion: &mut Motion<'_, '_>, span: [f64; 2], modes: &Modes) {
        let Some(beside) = &mut self.beside else {
            return;
        };
        // A word on all its parts at once, where there are several.
        let several = span[1] - span[0] > self.length;
        let at_rest = several && beside.is_steady() && !beside.may_rise(motion, span);
        if at_rest && self.carried.is_empty() {
            return;
        }
        let mut from = span[0];
        // There may be very many.
        while from < span[1] && (self.goes_on)() {
            let to = self.length * ((from / self.length).floor() + 1.0);
            // Rounding must not leave one without length.
            let to = if to - from > 1e-6 * self.length {
                to.min(span[1])
            } else {
                (to + self.length).min(span[1])
            };
            let part = [from, to];
            if !at_rest {
                self.sample_forces(motion, part, modes);
            }
            if !self.record_carried(motion, part, modes) {
                return;
            }
            from = to;
        }
    }

    /// Forces in a stretch, halved where they are not followed over it.
    fn sample_forces(&mut self, motion: &mut Motion<'_, '_>, span: [f64; 2], modes: &Modes) {
        let mut parts = vec![(span, 0)];
        while let Some(([from, to], halvings)) = parts.pop() {
            let Some(beside) = &mut self.beside else {
                return;
            };
            if !beside.take_stretch(motion, [from, to]) {
                continue;
            }
            let middle = from + 0.5 * (to - from);
            let divides = halvings < HALVINGS && from < middle && middle < to;
            if divides && !beside.is_followed(motion, [from, to]) {
                parts.extend([[middle, to], [from, middle]].map(|part| (part, halvings + 1)));
                continue;
            }
            self.refine_force_extrema(motion, modes);
        }
    }

    /// Climbs to the greatest forces in the stretch taken up last.
    fn refine_force_extrema(&mut self, motion: &mut Motion<'_, '_>, modes: &Modes) {
        let Some(beside) = &mut self.beside else {
            return;
        };
        for own in &mut beside.coupled {
            self.found.clear();
            own.refine_force_extrema(motion.branches, &mut beside.forces, |time| {
                self.found.push(time);
            });
            for &time in &self.found {
                motion.state(time, &mut self.y);
                let states = self.log.observe(time, &self.y, modes);
                own.tally.include_forces(time, &states[own.object]);
            }
        }
    }

    /// False where the walk ended meanwhile.
    fn record_carried(
        &mut self,
        motion: &mut Motion<'_, '_>,
        span: [f64; 2],
        modes: &Modes,
    ) -> bool {
        let [from, to] = span;
        let model = self.route.system.model();
        let summed = |object: usize| {
            let part = &model.objects[object];
            part.combination.is_some() || part.pressing.is_some()
        };
        // The sum of modes is in several trees, and several may press on one cam.
        let all = self.carried.iter().any(|carried| summed(carried.1));
        let trees = self.carried.iter().map(|carried| carried.0);
        let trees = trees.chain(0..if all { motion.branches.len() } else { 0 });
        let rates = trees.map(|tree| motion.branches[tree].rate_ahead(span));
        let Some(rate) = rates.reduce(f64::max) else {
            return true;
        };
        let count = (rate * (to - from) / RADIANS).ceil().clamp(1.0, 1e6);
        for k in 0..count as usize {
            if !(self.goes_on)() {
                return false;
            }
            let at = |k: f64| from + (to - from) * (k / count);
            let mut looked = CarriedObserver {
                log: &mut self.log,
                y: &mut self.y,
                seen: &mut self.seen,
                motion: &mut *motion,
                modes,
            };
            looked.observe_part([at(k as f64), at(k as f64 + 1.0)], |segment| {
                for (_, object, tally) in &mut self.carried {
                    tally.add_segment(*object, segment);
                }
            });
        }
        true
    }

    /// Ends the recording of a walk that stands at `time` in the state `y`.
    pub(super) fn finish(
        mut self,
        time: f64,
        (y, modes): (&[f64], &Modes),
        branches: &mut [Branch<'_>],
    ) -> RunRecord {
        let system = self.route.system;
        let objects = 0..system.model().objects.len();
        let tally = |object| Tally::new(system, object, self.settings.window);
        let mut tallies: Vec<Tally> = objects.map(tally).collect();
        let mut audit = EnergyAudit::default();
        let mut failure = None;
        if let Some(mut beside) = self.beside.take() {
            if !beside.integrated {
                beside.advance_figures(time);
            }
            let gathered = beside.figured.finish();
            audit = gathered.audit;
            failure = gathered.failure;
            for (&object, tally) in beside.rest.objects.iter().zip(gathered.tallies) {
                tallies[object] = tally;
            }
            for own in beside.coupled {
                tallies[own.object].replace_forces(&own.tally);
            }
        }
        for (own, branch) in self.trees.into_iter().zip(branches) {
            audit.add(&branch.works());
            for (tally, &object) in own.into_iter().zip(&branch.part.objects) {
                tallies[object] = tally;
            }
        }
        for (tree, object, tally) in self.carried {
            let part = &system.model().objects[object];
            if part.pressing.is_some() {
                tallies[object].replace_pressure(&tally);
            }
            match self.route.parts.trees[tree].objects.contains(&object) {
                // All but what its driven end adds is known in closed form.
                true if part.driven_end.is_some() => tallies[object].replace_forces(&tally),
                true => {}
                false if self.route.parts.tree_of(object).is_some() => tallies[object] = tally,
                // It is prescribed, and looked at with all that is.
                false => {}
            }
        }
        let last = self.log.observe(time, y, modes);
        for (tally, state) in tallies.iter_mut().zip(last) {
            tally.set_last(state);
        }
        let mut recorded = self.log.finish(time, &tallies, Vec::new(), audit);
        recorded.failure = failure.or(recorded.failure);
        recorded
    }
}

impl Listener for CombinedRecord<'_> {
    fn start(&mut self, y: &[f64], modes: &Modes) {
        self.sink.start(0.0, y, modes);
        let states = self.log.start(0.0, y, modes);
        for (own, part) in self.trees.iter_mut().zip(&self.route.parts.trees) {
            for (tally, &object) in own.iter_mut().zip(&part.objects) {
                tally.include_motion(0.0, &states[object]);
            }
        }
        for (_, object, tally) in &mut self.carried {
            tally.include_state(0.0, &states[*object]);
        }
        if let Some(beside) = &mut self.beside {
            for own in &mut beside.coupled {
                own.tally.include_state(0.0, &states[own.object]);
            }
            if !beside.integrated {
                let period = self.route.parts.period(self.route.system);
                beside.start(modes, period);
            }
        }
    }

    fn reset_tree(&mut self, number: usize) {
        let (system, window) = (self.route.system, self.settings.window);
        let objects = &self.route.parts.trees[number].objects;
        for (tally, &object) in self.trees[number].iter_mut().zip(objects) {
            *tally = Tally::new(system, object, window);
        }
    }

    fn phase(&mut self, number: usize, branch: &mut Branch<'_>) {
        for (object, tally) in self.trees[number].iter_mut().enumerate() {
            tally.add_segment(object, branch);
        }
    }

    fn stretch(&mut self, motion: &mut Motion<'_, '_>, span: [f64; 2], modes: &Modes) {
        self.log.sample(Stretch {
            span,
            modes,
            course: Course::Known(&mut |time, y| motion.state(time, y)),
        });
        self.record_forces(motion, span, modes);
        let trees = self.trees.iter().flatten();
        let carried = self.carried.iter().map(|carried| &carried.2);
        let coupled = self.beside.iter().flat_map(|beside| &beside.coupled);
        let coupled = coupled.map(|own| &own.tally);
        let times = trees.chain(carried).chain(coupled).flat_map(Tally::times);
        let mut stretch = Stretch {
            span,
            modes,
            course: Course::Known(&mut |time, y| motion.state(time, y)),
        };
        for (own, part) in self.trees.iter().zip(&self.route.parts.trees) {
            for (tally, &object) in own.iter().zip(&part.objects) {
                self.log.confirm(object, tally, &mut stretch);
            }
        }
        self.log.keep_rows(times, stretch);
    }

    fn switch(&mut self, event: &SwitchEvent<'_>) {
        self.log.switch(event);
        if let Some(beside) = self.beside.as_mut().filter(|beside| !beside.integrated) {
            beside.switch(event);
        }
    }
}
