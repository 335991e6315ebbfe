//! The motion from event to event.

use super::expansion::{Expansion, REACH, Signal, TreeState, value_and_slope};
use super::extremes::{ExtremeSearch, Stretch};
use super::numbers::{LawNumbers, TreeNumbers};
use super::results::ObjectResults;
use super::validity::{Found, PairPhase, Touch};
use crate::exact::{ExactRun, ExactSwitch, PairState};
use crate::math::number::Number;
use crate::units::shown;

/// Most steps.
const MOST_STEPS: f64 = 2e7;

/// Steps between two looks at whether it is to go on.
const PATIENCE: u64 = 256;

/// Most that an event may lie beside where it was found before, in lengths of a step.
const AGREEMENT: f64 = 1e-4;

/// Most changes of the sequence of events that are kept.
const MOST_NEAR: usize = 4096;

/// Events closer than this share of the run count as simultaneous.
const COINCIDENT: f64 = 1e-14;

/// Whether the instants of events move with the parameters.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub(crate) enum EventTimes {
    /// They do.
    Moving,
    /// As if closures stood still: a wrong rule, which a check must notice.
    #[cfg(test)]
    ClosuresFixed,
}

/// Why a motion is not gone through again.
#[derive(Clone, Debug, PartialEq)]
pub(crate) enum Unfollowed {
    /// It is of a kind that is not followed, with the reason.
    Kind(String),
    /// An event is not met again: rounding decides.
    Event(String),
    /// It was not to go on.
    Ended,
}

/// Results of a tree.
#[derive(Clone, Debug)]
pub(crate) struct TreeResults<N> {
    /// Of its objects.
    pub(crate) objects: Vec<ObjectResults<N>>,
    /// Pair functions, positive, that change the sequence of events where they become zero.
    pub(crate) near: Vec<N>,
    /// Where a clearance becomes zero without being negative, with the clearance.
    pub(crate) touches: Vec<(Touch, N)>,
    /// The first time at which two events coincide.
    pub(crate) coincident: Option<f64>,
}

/// Goes through a motion that is known, with numbers that may carry derivatives.
///
/// # Errors
/// As of [`super::results()`].
pub(super) fn follow<N: Number>(
    numbers: &TreeNumbers<N>,
    run: &ExactRun,
    (end, events, touches): (N, EventTimes, &[Touch]),
    goes_on: &dyn Fn() -> bool,
) -> Result<TreeResults<N>, Unfollowed> {
    let mut walk = Walk::new(numbers, run, goes_on);
    let mut touches = touches.iter().peekable();
    for switch in &run.switches {
        while let Some(touch) = touches.next_if(|touch| touch.time < switch.time) {
            walk.reach_breaks(touch.time)?;
            walk.dip(touch)?;
        }
        walk.reach_breaks(switch.time)?;
        walk.reach_event(switch, events)?;
    }
    for touch in touches {
        walk.reach_breaks(touch.time)?;
        walk.dip(touch)?;
    }
    walk.reach_breaks(end.value())?;
    walk.reach_end(end)?;
    Ok(walk.finish(run))
}

struct Walk<'w, N> {
    numbers: &'w TreeNumbers<N>,
    goes_on: &'w dyn Fn() -> bool,
    state: TreeState<N>,
    motion: Expansion<N>,
    objects: Vec<ObjectResults<N>>,
    phases: Vec<PairPhase<N>>,
    found: Found<N>,
    places: ExtremeSearch,
    /// True: the last stretch ended with an event, or nothing has been gone through.
    after_event: bool,
    last_event: Option<N>,
    /// Length of a step in the present regime.
    step: f64,
    steps: u64,
}

impl<'w, N: Number> Walk<'w, N> {
    fn new(numbers: &'w TreeNumbers<N>, run: &ExactRun, goes_on: &'w dyn Fn() -> bool) -> Self {
        let objects = numbers.objects.iter().map(|object| {
            let can_open = !numbers.masses[object.first].flanks.is_empty();
            let mut own = ObjectResults::new(can_open);
            if let Some(pair) = &mut own.pair {
                pair.begin(run.start[object.first].engaged(), N::from(0.0));
            }
            own
        });
        let mut walk = Self {
            goes_on,
            state: TreeState {
                time: N::from(0.0),
                displacement: numbers.displacement.clone(),
                speed: numbers.speed.clone(),
                pairs: run.start.clone(),
            },
            motion: Expansion::new(numbers),
            objects: objects.collect(),
            phases: vec![PairPhase::default(); numbers.masses.len()],
            found: Found::default(),
            places: ExtremeSearch::default(),
            after_event: true,
            last_event: None,
            step: 0.0,
            steps: 0,
            numbers,
        };
        walk.step = walk.step_length();
        walk
    }

    /// [`REACH`] over a bound of the rates of the motion in the present regime.
    fn step_length(&self) -> f64 {
        let masses = &self.numbers.masses;
        let mut rows = vec![[0.0f64; 2]; masses.len()];
        for (mass, own) in masses.iter().enumerate() {
            let root = own.inertia.value().sqrt();
            let square = own.inertia.value();
            rows[mass][0] += own.ground_stiffness.value().abs() / square;
            rows[mass][1] += own.ground_damping.value().abs() / square;
            if !own.flanks.is_empty() && !self.state.pairs[mass].engaged() {
                continue;
            }
            let link = [own.stiffness.value().abs(), own.damping.value().abs()];
            for kind in 0..2 {
                rows[mass][kind] += link[kind] / square;
                let Some(parent) = own.parent else { continue };
                let lever = own.lever.value().abs();
                let driver = masses[parent].inertia.value();
                let both = lever * link[kind] / (root * driver.sqrt());
                rows[mass][kind] += both;
                rows[parent][kind] += both + lever * lever * link[kind] / driver;
            }
        }
        let rate = |[stiffness, damping]: [f64; 2]| {
            0.5 * damping + (0.25 * damping * damping + stiffness).sqrt()
        };
        let fastest = rows.into_iter().map(rate).fold(0.0, f64::max);
        let fastest = match &self.numbers.law {
            LawNumbers::Harmonic { sines, .. } => (sines.iter())
                .map(|sine| sine[1].value().abs())
                .fold(fastest, f64::max),
            // (A polynomial is its own series.)
            LawNumbers::Parts(_) => fastest,
        };
        REACH / fastest
    }

    /// The stretch just expanded is gone through.
    fn pass(&mut self, length: N, ends: bool) {
        let stretch = Stretch {
            from: self.state.time.value(),
            length,
            begins: self.after_event,
            ends,
        };
        for (object, own) in self.objects.iter_mut().enumerate() {
            let pair = self.state.pairs[self.numbers.objects[object].first];
            own.take(
                (self.numbers, object),
                (&self.motion, pair),
                stretch,
                &mut self.places,
            );
        }
        for (mass, phase) in self.phases.iter_mut().enumerate() {
            phase.take(
                (self.numbers, mass),
                (&self.motion, self.state.pairs[mass]),
                stretch,
                (&mut self.places, &mut self.found),
            );
        }
        self.motion.advance(length, &mut self.state);
        self.after_event = ends;
        self.steps += 1;
        if self.found.near.len() > MOST_NEAR {
            keep_least(&mut self.found.near);
        }
    }

    /// Steps until what is left to a time is no more than one; the motion is then expanded about
    /// where it stands.
    fn approach(&mut self, time: f64) -> Result<(), Unfollowed> {
        let left = (time - self.state.time.value()) / self.step;
        if left > MOST_STEPS {
            let why = format!("its motion is too fast: {left:.0} steps would be needed");
            return Err(Unfollowed::Kind(why));
        }
        loop {
            if self.steps.is_multiple_of(PATIENCE) && !(self.goes_on)() {
                return Err(Unfollowed::Ended);
            }
            self.motion.expand(self.numbers, &self.state);
            let now = self.state.time.value();
            if time - now <= self.step {
                return Ok(());
            }
            // (The end of the step is a number, so that no time is lost to rounding.)
            let to = now + self.step.min(0.5 * (time - now).max(self.step));
            self.pass(N::from(to - now), false);
        }
    }

    /// Goes to the breaks before a time: points of time tables, parts of the law.
    fn reach_breaks(&mut self, time: f64) -> Result<(), Unfollowed> {
        while let Some(at) = self.next_break().filter(|at| at.value() < time) {
            self.approach(at.value())?;
            self.pass(at - self.state.time, true);
            // (Exactly, so that what begins there is in force.)
            self.state.time = at;
        }
        Ok(())
    }

    /// The next break.
    fn next_break(&self) -> Option<N> {
        let now = self.state.time.value();
        let points = self.numbers.masses.iter().flat_map(|mass| &mass.tables);
        let later = points.flatten().map(|point| point[0]);
        let later = later.filter(|at| at.value() > now);
        let part = match &self.numbers.law {
            LawNumbers::Harmonic { .. } => None,
            LawNumbers::Parts(parts) => {
                let begun = parts.partition_point(|part| part.start.value() <= now);
                parts.get(begun).map(|part| part.start)
            }
        };
        later
            .chain(part)
            .min_by(|a, b| a.value().total_cmp(&b.value()))
    }

    /// The flank that an event is about.
    fn flank(&self, switch: &ExactSwitch) -> usize {
        if let Some(impact) = &switch.impact {
            let flanks = self.numbers.masses[switch.mass].flanks.iter();
            let struck = |flank: &(f64, N)| (flank.0 > 0.0) == (impact.side < 0);
            return flanks.clone().position(struck).unwrap_or(0);
        }
        match (switch.after, switch.before) {
            (PairState::Engaged(flank) | PairState::Pressed(flank), _)
            | (PairState::Free, PairState::Engaged(flank) | PairState::Pressed(flank)) => {
                usize::from(flank)
            }
            (PairState::Free, PairState::Free) => 0,
        }
    }

    /// The function that vanishes at an event.
    fn guard(&self, switch: &ExactSwitch) -> Signal<N> {
        let (mass, flank) = (switch.mass, self.flank(switch));
        let by_clearance = switch.impact.is_some()
            || matches!(
                (switch.before, switch.after),
                (PairState::Free, PairState::Engaged(_)) | (PairState::Pressed(_), PairState::Free)
            );
        match by_clearance {
            true => self.motion.clearance(self.numbers, mass, flank),
            false => self.motion.force(self.numbers, mass, Some(flank)),
        }
    }

    fn reach_event(&mut self, switch: &ExactSwitch, events: EventTimes) -> Result<(), Unfollowed> {
        self.approach(switch.time)?;
        let guard = self.guard(switch);
        let expected = switch.time - self.state.time.value();
        let place = self
            .root(&guard, expected)
            .ok_or_else(|| missed(switch.time))?;
        let moves = match events {
            EventTimes::Moving => true,
            #[cfg(test)]
            EventTimes::ClosuresFixed => !switch.after.engaged(),
        };
        let length = match moves {
            // One step of Newton's method from the root, in numbers that carry derivatives.
            true => {
                let [value, slope] = value_and_slope(&guard, N::from(place));
                N::from(place) - value / slope
            }
            false => {
                let now = self.state.time;
                N::from(place) - (now - N::from(now.value()))
            }
        };
        match length.value().is_finite() {
            true => self.take_event(switch, length),
            false => Err(missed(switch.time)),
        }
    }

    /// The root of a function near a place, to rounding.
    fn root(&self, guard: &Signal<N>, expected: f64) -> Option<f64> {
        let mut plain = [0.0; super::expansion::TERMS];
        for (plain, term) in plain.iter_mut().zip(guard) {
            *plain = term.value();
        }
        let mut place = expected;
        for _ in 0..12 {
            let [value, slope] = value_and_slope(&plain, place);
            let correction = value / slope;
            if value == 0.0 || correction.abs() <= f64::EPSILON * place.abs() {
                break;
            }
            place -= correction;
        }
        let near = (place - expected).abs() <= AGREEMENT * self.step;
        near.then_some(place)
    }

    fn take_event(&mut self, switch: &ExactSwitch, length: N) -> Result<(), Unfollowed> {
        self.pass(length, true);
        let (mass, time) = (switch.mass, self.state.time);
        self.last_event = Some(time);
        if switch.impact.is_some_and(|impact| impact.rests.is_some())
            || (self.numbers.masses[mass].restitution.is_some() && switch.before.engaged())
        {
            let why = "its rigid contact comes to rest on a flank, or leaves it from rest";
            return Err(Unfollowed::Kind(why.to_owned()));
        }
        self.phases[mass].end(&mut self.found.near);
        let closing = switch.after.engaged() || switch.impact.is_some();
        let approach = closing.then(|| self.approach_speed(switch));
        if switch.impact.is_some() {
            self.rebound(mass);
        }
        self.state.pairs[mass] = switch.after;
        self.step = self.step_length();
        let numbers = self.numbers;
        let mut objects = self.objects.iter_mut().zip(&numbers.objects);
        if let Some((own, _)) = objects.find(|(_, object)| object.first == mass)
            && let Some(pair) = &mut own.pair
        {
            if let Some(approach) = approach {
                pair.max_approach_speed.offer(time.value(), approach);
            }
            match switch.impact {
                Some(_) => pair.strike(time),
                None if switch.before.engaged() == switch.after.engaged() => {}
                None => pair.switch((switch.before, switch.after), time),
            }
        }
        Ok(())
    }

    /// Speed at which a mass comes to its flank.
    fn approach_speed(&self, switch: &ExactSwitch) -> N {
        let own = &self.numbers.masses[switch.mass];
        let mut speed = self.state.speed[switch.mass];
        if let Some(parent) = own.parent {
            speed -= own.lever * self.state.speed[parent];
        }
        speed.scale(-own.flanks[self.flank(switch)].0)
    }

    /// An impact: the clearance grows as e times as it shrank; the law keeps its speed, and q
    /// is measured from it.
    fn rebound(&mut self, mass: usize) {
        if let Some(e) = self.numbers.masses[mass].restitution {
            self.state.speed[mass] = -(e * self.state.speed[mass]);
        }
    }

    /// A dip into a flank that is just touched, to first order: it begins at rest and ends where it
    /// is deepest, since the damper lets go there. By it the speed changes by b times the depth.
    fn dip(&mut self, touch: &Touch) -> Result<(), Unfollowed> {
        self.approach(touch.time)?;
        let (mass, numbers) = (touch.mass, self.numbers);
        let length = touch.time - self.state.time.value();
        let clearance = self.motion.clearance(numbers, mass, touch.flank);
        let [depth, _] = value_and_slope(&clearance, N::from(length));
        self.pass(N::from(length), false);
        let own = &numbers.masses[mass];
        let sign = own.flanks[touch.flank].0;
        let impulse = (own.damping * (depth - N::from(depth.value()))).scale(sign);
        self.state.speed[mass] -= impulse / own.inertia;
        if let Some(parent) = own.parent {
            self.state.speed[parent] += own.lever * impulse / numbers.masses[parent].inertia;
        }
        Ok(())
    }

    fn reach_end(&mut self, end: N) -> Result<(), Unfollowed> {
        self.approach(end.value())?;
        let (length, last) = (end - self.state.time, self.last_event);
        self.pass(length, true);
        for mass in 0..self.phases.len() {
            let pair = self.state.pairs[mass];
            PairPhase::left(
                (self.numbers, mass),
                (&self.motion, pair),
                length,
                &mut self.found.near,
            );
        }
        // The last event may leave the run.
        self.found.near.extend(last.map(|time| end - time));
        for phase in &mut self.phases {
            phase.end(&mut self.found.near);
        }
        for own in &mut self.objects {
            if let Some(pair) = &mut own.pair {
                pair.close(end);
            }
        }
        Ok(())
    }

    fn finish(self, run: &ExactRun) -> TreeResults<N> {
        TreeResults {
            objects: self.objects,
            near: self.found.near,
            touches: self.found.touches,
            coincident: coincident(run),
        }
    }
}

/// Keeps the half with the least values. (Which are nearest depends on the parameter, too.)
fn keep_least<N: Number>(near: &mut Vec<N>) {
    near.sort_by(|a, b| a.value().total_cmp(&b.value()));
    near.truncate(MOST_NEAR / 2);
}

fn missed(time: f64) -> Unfollowed {
    let time = shown(time, 7);
    Unfollowed::Event(format!("the event at t = {time} s is not found again"))
}

/// The first time at which two pairs have events within rounding.
fn coincident(run: &ExactRun) -> Option<f64> {
    let pairs = run.switches.windows(2);
    let mut same = pairs.filter(|pair| {
        let [a, b] = [&pair[0], &pair[1]];
        let apart = (b.time - a.time).abs() > COINCIDENT * run.time;
        let jumps_across = a.before.engaged() && b.after.engaged() && a.mass == b.mass;
        !apart && (a.mass != b.mass || jumps_across)
    });
    same.next().map(|pair| pair[0].time)
}
