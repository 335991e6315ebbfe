//! Exact propagation without a recorder: for maps and charts, which want the
//! figures of many runs and no columns.

use super::clock::Clock;
use crate::exact::{
    Asked, ExactRun, ExactSwitch, ExactTree, PairState, Parts, Refusal, Request, TreeFigures,
};
use crate::fault::Fault;
use crate::integrate::{Limits, Stop};
use crate::record::{FinalState, ObjectFigures, PairFigures, choose_window_of, greatest_magnitude};
use crate::system::System;

/// A system that is propagated exactly as a whole, ready to be run.
#[derive(Debug)]
pub struct Quick {
    trees: Vec<Branch>,
    /// Window of steady figures asked for when it was made.
    window: Option<(f64, f64)>,
    /// The model's own cycle decides the window when none is asked for.
    cycle: Result<f64, String>,
}

/// One tree and what of it is looked at.
#[derive(Debug)]
struct Branch {
    tree: ExactTree,
    objects: Vec<Watched>,
}

/// An object of a tree.
#[derive(Clone, Copy, Debug)]
struct Watched {
    /// Index in the model.
    object: usize,
    /// Its first and last mass in the tree.
    first: usize,
    last: usize,
    /// δ = q_last − ratio·q of this mass.
    base: Option<(usize, f64)>,
    /// True when its pair can open.
    opens: bool,
}

/// What a quick run leaves.
#[derive(Clone, Debug, PartialEq)]
pub struct QuickRun {
    /// The elastic objects, in the order of the model.
    pub objects: Vec<QuickObject>,
    /// Why it ended: [`Stop::Complete`], or a limit.
    pub stop: Stop,
    /// Time reached (s), by the tree that stopped first.
    pub time: f64,
    /// Switches of all pairs.
    pub switches: u64,
    /// Phases gone through.
    pub phases: u64,
    /// Evaluations in the search for switches.
    pub evaluations: u64,
    /// Search steps over which a pair function could not be told from zero:
    /// there the count of switches is not guaranteed.
    pub grazing: u64,
}

/// One elastic object.
#[derive(Clone, Debug, Default, PartialEq)]
pub struct QuickObject {
    /// Index in the model.
    pub object: usize,
    /// δ at the ends of the sample intervals (t = 0 is not among them).
    pub delta: Vec<f64>,
    /// Times of the switches of its pair (s).
    pub switch_times: Vec<f64>,
    /// Its figures, when asked for.
    pub figures: Option<ObjectFigures>,
}

impl Quick {
    /// Prepares a system: its parts and its state at t = 0.
    ///
    /// # Errors
    /// A fault for every object that stands against exact propagation, or
    /// there is no start.
    pub fn new(system: &System) -> Result<Self, Vec<Fault>> {
        let parts = super::whole(system)?;
        let initial = system.initial_place()?;
        Ok(Self::of(system, &parts, &initial))
    }

    /// The parts of a system from the state y at t = 0.
    pub fn of(system: &System, parts: &Parts, y: &[f64]) -> Self {
        let branch = |part: &crate::exact::Part| {
            let watched = part.objects.iter().zip(&part.problem().objects);
            Branch {
                tree: part.tree(y),
                objects: watched
                    .map(|(&object, place)| Watched {
                        object,
                        first: place.first,
                        last: place.last,
                        base: place.driver,
                        opens: system.pair_component(object).is_some(),
                    })
                    .collect(),
            }
        };
        Self {
            trees: parts.trees.iter().map(branch).collect(),
            window: None,
            cycle: crate::record::drive_cycle(system.model()),
        }
    }

    /// With a window of steady figures (s) in place of the last whole cycle.
    #[must_use]
    pub fn with_window(mut self, window: Option<(f64, f64)>) -> Self {
        self.window = window;
        self
    }

    /// Runs to `end` (s) with `samples` equal sample intervals. Of the figures,
    /// those are found that `asked` names for the object of that index in the
    /// model (and others of its tree); `None`: no figures at all.
    ///
    /// The limits on switches and steps (of the search) hold for each tree by
    /// itself. What stops one ends the run: later trees are left out.
    ///
    /// # Errors
    /// Modes that cannot be separated, or numbers that are no longer finite.
    pub fn run(
        &self,
        end: f64,
        samples: usize,
        asked: Option<&dyn Fn(usize) -> Asked>,
        limits: &Limits<'_>,
    ) -> Result<QuickRun, Refusal> {
        let mut out = QuickRun::new(end);
        let clock = Clock::new(limits);
        for branch in &self.trees {
            let all_masses = !branch.last_alone();
            let request = Request {
                all_masses,
                switches: limits.switches,
                all_steps: limits.steps,
                figures: asked.is_some(),
                asked: branch.asked(asked),
                ..Request::new(end, samples)
            };
            let run = branch
                .tree
                .run_while(&request, &|| clock.stop().is_none())?;
            out.add(&run);
            for (index, watched) in branch.objects.iter().enumerate() {
                out.objects.push(QuickObject {
                    object: watched.object,
                    delta: watched.deltas(&run, all_masses),
                    switch_times: watched.switches(&run).map(|switch| switch.time).collect(),
                    figures: asked.map(|_| self.figures(branch, index, &run)),
                });
            }
            if let Some(halt) = run.halt {
                out.stop = clock.why(halt);
                break;
            }
        }
        out.objects.sort_by_key(|object| object.object);
        Ok(out)
    }

    fn figures(&self, branch: &Branch, index: usize, run: &ExactRun) -> ObjectFigures {
        let watched = &branch.objects[index];
        let found: &TreeFigures = &run.figures[index];
        let (place, speed) = branch.tree.law().at(run.time);
        let mass = &branch.tree.problem().masses[watched.last];
        ObjectFigures {
            delta_abs: greatest_magnitude(found.delta_min, found.delta_max),
            delta_max: found.delta_max,
            delta_min: found.delta_min,
            sigma: found.sigma,
            peak_speed: found.peak_speed,
            peak_acceleration: found.peak_acceleration,
            peak_reaction: found.peak_reaction,
            end: FinalState {
                displacement: run.displacement[watched.last] + mass.ratio * place + mass.offset,
                speed: run.speed[watched.last] + mass.ratio * speed,
            },
            joints: None,
            pair: watched.opens.then(|| {
                let mut pair = watched.pair(run, found);
                pair.in_working_order = self.working(watched, run);
                pair
            }),
        }
    }

    /// No separation within the window; `None` without one.
    fn working(&self, watched: &Watched, run: &ExactRun) -> Option<bool> {
        if !run.complete {
            return None;
        }
        let [from, to] = choose_window_of(self.cycle.clone(), run.time, self.window).ok()?;
        let overlaps = |open: &[f64; 2]| open[0] < to && open[1] > from && open[1] > open[0];
        Some(!watched.open_intervals(run).iter().any(overlaps))
    }
}

impl QuickRun {
    fn new(end: f64) -> Self {
        Self {
            objects: Vec::new(),
            stop: Stop::Complete,
            time: end,
            switches: 0,
            phases: 0,
            evaluations: 0,
            grazing: 0,
        }
    }

    /// True when it reached its end.
    pub fn is_complete(&self) -> bool {
        self.stop == Stop::Complete
    }

    fn add(&mut self, run: &ExactRun) {
        self.time = self.time.min(run.time);
        self.switches += run.switches.len() as u64;
        self.phases += run.phases;
        self.evaluations += run.evaluations;
        self.grazing += run.grazing;
    }
}

impl Branch {
    /// The figures that its objects are asked for, together.
    fn asked(&self, asked: Option<&dyn Fn(usize) -> Asked>) -> Asked {
        let all = asked.into_iter().flat_map(|asked| {
            let objects = self.objects.iter();
            objects.map(move |watched| asked(watched.object))
        });
        all.reduce(Asked::with).unwrap_or(Asked::ALL)
    }

    /// True when the tree's last mass is all that is sampled.
    fn last_alone(&self) -> bool {
        let last = self.tree.problem().masses.len() - 1;
        matches!(&self.objects[..], [only] if only.last == last && only.base.is_none())
    }
}

impl Watched {
    fn deltas(&self, run: &ExactRun, all_masses: bool) -> Vec<f64> {
        if !all_masses {
            return run.samples.clone();
        }
        let rows = run.samples.chunks_exact(run.columns);
        let base = self.base;
        rows.map(|row| row[self.last] - base.map_or(0.0, |(mass, ratio)| ratio * row[mass]))
            .collect()
    }

    fn switches<'r>(&self, run: &'r ExactRun) -> impl Iterator<Item = &'r ExactSwitch> {
        let first = self.first;
        run.switches
            .iter()
            .filter(move |switch| switch.mass == first)
    }

    /// Open intervals, the last up to the end of the run.
    fn open_intervals(&self, run: &ExactRun) -> Vec<[f64; 2]> {
        let mut since = (!run.start[self.first].engaged()).then_some(0.0);
        let mut intervals = Vec::new();
        for switch in self.switches(run) {
            if let (true, Some(from)) = (switch.after.engaged(), since.take()) {
                intervals.push([from, switch.time]);
            }
            if !switch.after.engaged() {
                since = Some(switch.time);
            }
        }
        if let Some(from) = since {
            intervals.push([from, run.time]);
        }
        intervals
    }

    fn pair(&self, run: &ExactRun, found: &TreeFigures) -> PairFigures {
        let mut pair = PairFigures {
            max_lift: found.max_lift,
            max_contact_force: found.peak_reaction,
            switch_times: Vec::with_capacity(run.switches.len()),
            ..PairFigures::default()
        };
        for switch in self.switches(run) {
            pair.switch_times.push(switch.time);
            pair.separations += u64::from(switch.before.engaged());
            if let PairState::Engaged(_) = switch.after {
                pair.closures += 1;
                pair.max_approach_speed = pair.max_approach_speed.max(-switch.speed);
            }
        }
        for [from, to] in self.open_intervals(run) {
            pair.separated_time += to - from;
            pair.longest_separation = pair.longest_separation.max(to - from);
        }
        pair
    }
}
