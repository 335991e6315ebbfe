//! One run: what happens at every accepted step, whatever the method.

mod edges;
mod given_signals;
mod narrowing;
mod probing;
mod switching;
mod touching;

pub(super) use touching::GrazingContact;

use self::narrowing::NarrowSearch;
use super::changing::ChangeTracker;
use super::continuous::{End, Output};
use super::evaluator::Evaluator;
use super::locate::{LocatedEvent, Stretch};
use super::pace::Pace;
use super::radau;
use super::rosenbrock::Stepper;
use super::singularities::Singularities;
use super::taylor::Series;
use super::{
    Dynamics, EventFunction, Guard, Limits, Method, Probe, Settings, Singularity, Sink, Stop,
    UndecidedGuard,
};

/// A switch at these places of a step is located on a step that ends just behind
/// it, by this share of it: the polynomial is best near the ends of the step.
const AMIDST: std::ops::Range<f64> = 0.01..0.99;
const BEHIND: f64 = 1e-3;
const MOST_DRAWN_IN: u32 = 4;

/// Order to a method after an accepted step.
#[derive(Clone, Copy, Debug, PartialEq)]
pub(super) enum Verdict {
    /// Go on from the step's end.
    Continue,
    /// Begin anew from the run's present state: something has switched.
    Restart,
    /// Take the step anew, this long (s): it ends just behind a switch then, where
    /// the method is more accurate than the output in its midst.
    Again(f64),
    /// The run is over.
    Stop,
}

/// Knowledge of a step between its ends, as a method gives it.
#[derive(Clone, Copy, Debug)]
pub(super) enum StepInterpolant<'g> {
    /// Nothing: the right-hand side is to be asked.
    Nothing,
    /// The state in the middle: of implicit methods, whose steps may pass over
    /// fast modes, so that the right-hand side does not help.
    Middle(&'g [f64]),
    /// The motion itself: power series of all signals of a degree, over a time
    /// of which the step takes a share.
    Series(&'g [f64], usize, f64),
    /// The motion itself: polynomials of all signals of a degree in Bernstein form.
    Polynomial(&'g [f64], usize),
}

/// State of a run between the steps of a method.
pub(super) struct Run<'a, D: Dynamics> {
    pub(super) evaluator: &'a Evaluator<'a, D>,
    pub(super) settings: Settings,
    pub(super) limits: &'a Limits<'a>,
    sink: &'a mut dyn Sink,
    /// State where the run stands.
    pub(super) from: End,
    /// End of the present leg: the run's end or the next break in time.
    pub(super) target: f64,
    pub(super) stop: Option<Stop>,
    pub(super) steps: u64,
    pub(super) rejected: u64,
    pub(super) switches: u64,
    /// Places that signals cannot pass.
    pub(super) singularities: Singularities,
    /// End of the step under way.
    pub(super) to: End,
    pub(super) output: Output,
    middle: Vec<f64>,
    shorter_middle: Vec<f64>,
    event_functions: Vec<EventFunction>,
    probes: Vec<Probe>,
    /// The switch that [`Dynamics::first_crossing`] found last.
    crossed: Option<EventFunction>,
    /// Count of such switches, and the time from which they are counted (s).
    crossings: (u32, f64),
    /// Memory of the probes.
    probed: Vec<f64>,
    /// True before the first step after the start and after every switch.
    fresh: bool,
    zero_at_start: Vec<Guard>,
    /// Contacts that were closed without a force and a speed that could be told from 0.
    touching: Vec<GrazingContact>,
    /// Guards that have had no sign since the start.
    resting: Vec<UndecidedGuard>,
    switches_at_once: u32,
    /// Count of how often the step under way has been shortened to end just behind a
    /// switch.
    drawn_in: u32,
    pub(super) pace: Pace,
    /// The own stiff method, with its memory, once it has been used.
    pub(super) rosenbrock: Option<Box<Stepper>>,
    /// The own stiff method for fine tolerances, likewise.
    pub(super) radau: Option<radau::Stepper>,
    /// Changes of the method.
    pub(super) changing: ChangeTracker,
    /// Stretches in which steps must be short.
    narrow: NarrowSearch,
    /// Edges of pieces of laws passed by a short step: how many, and since when (s).
    edges: (u32, f64),
    /// Longest step whose polynomial follows the given signals, until the next switch (s).
    pub(super) given_longest: f64,
    /// Steps taken with it.
    given_steps: u32,
    /// Memory of the own method of Taylor series.
    pub(super) series: Series,
}

impl<'a, D: Dynamics> Run<'a, D> {
    pub(super) fn new(
        evaluator: &'a Evaluator<'a, D>,
        settings: &Settings,
        limits: &'a Limits<'a>,
        sink: &'a mut dyn Sink,
    ) -> Self {
        let (coordinates, signals) = (
            evaluator.dynamics.coordinates(),
            evaluator.dynamics.signals(),
        );
        Self {
            evaluator,
            settings: settings.clone(),
            limits,
            sink,
            from: End::new(coordinates, signals),
            target: 0.0,
            stop: None,
            steps: 0,
            rejected: 0,
            switches: 0,
            singularities: Singularities::default(),
            to: End::new(coordinates, signals),
            output: Output::new(coordinates, signals),
            middle: vec![0.0; 2 * coordinates],
            shorter_middle: vec![0.0; 2 * coordinates],
            event_functions: Vec::new(),
            probes: Vec::new(),
            crossed: None,
            crossings: (0, 0.0),
            probed: vec![0.0; 2 * coordinates],
            fresh: true,
            zero_at_start: Vec::new(),
            touching: Vec::new(),
            resting: Vec::new(),
            switches_at_once: 0,
            drawn_in: 0,
            pace: Pace::default(),
            rosenbrock: None,
            radau: None,
            changing: ChangeTracker::new(&[]),
            narrow: NarrowSearch::default(),
            edges: (0, 0.0),
            given_longest: f64::INFINITY,
            given_steps: 0,
            series: Series::default(),
        }
    }

    /// Puts the run to its start.
    pub(super) fn start(&mut self, time: f64, y: &[f64]) {
        self.move_to(time, y);
        self.find_singularities();
        let modes = self.evaluator.modes.borrow();
        self.evaluator
            .dynamics
            .event_functions(&modes, &mut self.event_functions);
        self.evaluator.dynamics.probes(&modes, &mut self.probes);
        self.sink.start(time, y, &modes);
        drop(modes);
        self.find_touching(|_| true);
        self.find_resting();
    }

    /// Ends the run before it has begun.
    pub(super) fn end_before_start(&mut self, time: f64, reason: String) {
        self.from.time = time;
        let method = self.settings.method;
        self.end(Stop::Method { method, reason });
    }

    /// Takes an accepted step from where the run stands to (`time`, `y`), whose
    /// derivative is `dy`: looks for switches, tells the sink, moves on.
    ///
    /// An implicit method gives the state in the `middle` of the step as well,
    /// for steps that pass over fast modes.
    pub(super) fn accept_step(
        &mut self,
        time: f64,
        y: &[f64],
        dy: &[f64],
        middle: Option<&[f64]>,
    ) -> Verdict {
        self.accept_with(
            time,
            y,
            dy,
            middle.map_or(StepInterpolant::Nothing, StepInterpolant::Middle),
        )
    }

    /// The same for a step of which something else is known.
    pub(super) fn accept_with(
        &mut self,
        time: f64,
        y: &[f64],
        dy: &[f64],
        given: StepInterpolant<'_>,
    ) -> Verdict {
        self.to.set(self.evaluator, time, y, dy);
        if let Some(index) = self.to.not_finite() {
            return self.end_not_finite(index);
        }
        let mut shorter = std::mem::take(&mut self.shorter_middle);
        let edge = self.locate_singularity(&mut shorter);
        let verdict = edge.map(|edge| match (given, edge) {
            (StepInterpolant::Middle(_) | StepInterpolant::Polynomial(..), Some(edge)) => {
                self.take_step(time, StepInterpolant::Middle(&shorter), Some(edge))
            }
            (_, Some(edge)) => self.take_step(time, StepInterpolant::Nothing, Some(edge)),
            (given, None) => self.take_step(time, given, None),
        });
        self.shorter_middle = shorter;
        verdict.unwrap_or_else(|verdict| verdict)
    }

    /// The step from `from` to `to`, which ends at an `edge` or at `time`.
    fn take_step(
        &mut self,
        time: f64,
        given: StepInterpolant<'_>,
        edge: Option<Singularity>,
    ) -> Verdict {
        if let Some(index) = self.to.not_finite() {
            return self.give_up_step(self.not_finite(index));
        }
        self.steps += 1;
        self.forget_failures();
        if time < self.target && edge.is_none() {
            self.pace.last_length = Some(time - self.from.time);
        }
        let found = match given {
            StepInterpolant::Middle(middle) => self.earliest_of_stiff(middle),
            StepInterpolant::Nothing => self.earliest_of_smooth(),
            StepInterpolant::Series(series, degree, share) => {
                self.output
                    .series(&self.from, &self.to, series, degree, share);
                self.earliest()
            }
            StepInterpolant::Polynomial(coefficients, degree) => {
                self.output
                    .bernstein(&self.from, &self.to, coefficients, degree);
                self.earliest()
            }
        };
        // (A series knows its own error in them; a fixed step is what was asked for.)
        let own = matches!(given, StepInterpolant::Series(..)) || !self.can_repeat_step();
        if let (None, false, Some(shorter)) = (edge, own, self.misses_given_signal()) {
            self.shorten(shorter);
            return self.repeat_step(shorter);
        }
        if edge.is_none()
            && let Some(shorter) = self.passes_over()
        {
            return self.repeat_step(shorter);
        }
        let found = self.probe_before(found);
        let found = match given {
            StepInterpolant::Nothing => self.refine_probe(found),
            _ => found,
        };
        // Trial points beyond a switch may leave the domain; that is no failure.
        self.evaluator.take_not_finite();
        if let Some(pole) = self.pole_on_step(found.map_or(1.0, |found| found.s)) {
            return self.end(Stop::Physical(pole));
        }
        if let (Some(found), None, StepInterpolant::Polynomial(..)) = (found, edge, given)
            && self.is_to_draw_in(found.s)
        {
            self.drawn_in += 1;
            return self.repeat_step(found.s * (1.0 + BEHIND) * (self.to.time - self.from.time));
        }
        if let (Some(found), None, false) = (found, edge, own)
            && found.s > 0.0
            && self.drawn_in < MOST_DRAWN_IN
            && let Some(watch) = self.event_functions.get(found.watch)
            && self.is_misplaced(watch, found.s)
        {
            self.drawn_in += 1;
            return self.repeat_step(found.s * (1.0 + BEHIND) * (self.to.time - self.from.time));
        }
        self.drawn_in = 0;
        match (found, edge) {
            (Some(found), _) => self.switch_within_step(found),
            (None, None) => match self.pass() {
                Verdict::Continue if self.is_to_slow_down() => Verdict::Restart,
                Verdict::Continue if self.is_to_change() => Verdict::Restart,
                Verdict::Continue if self.is_to_lengthen() => Verdict::Restart,
                verdict => verdict,
            },
            (None, Some(edge)) => match self.pass() {
                Verdict::Stop => Verdict::Stop,
                _ => self.end_at(&edge),
            },
        }
    }

    /// True where a step can be taken anew with another length.
    fn can_repeat_step(&self) -> bool {
        match self.settings.method {
            Method::Dopri5
            | Method::Dop853
            | Method::Taylor
            | Method::Rodas5p
            | Method::Radau
            | Method::Exact => true,
            Method::Rk4 => self.evaluator.dynamics.coordinates() == 0,
            Method::Bdf | Method::TrBdf2 | Method::Esdirk34 => false,
        }
    }

    /// The step is taken anew with a length (s).
    fn repeat_step(&mut self, length: f64) -> Verdict {
        if self.evaluator.dynamics.coordinates() == 0 {
            self.shorten(length);
        }
        self.evaluator.take_not_finite();
        self.steps -= 1;
        self.rejected += 1;
        self.pace.last_length = Some(length);
        Verdict::Again(length)
    }

    /// True when a switch at a place of the step is to be located more closely, on
    /// a step that ends just behind it.
    fn is_to_draw_in(&self, s: f64) -> bool {
        match self.drawn_in {
            0 => AMIDST.contains(&s),
            MOST_DRAWN_IN.. => false,
            // It has moved by more than the margin.
            _ => s > AMIDST.start && s < 1.0 - 2.0 * BEHIND,
        }
    }

    /// The earliest switch on an output built with the right-hand side.
    fn earliest_of_smooth(&mut self) -> Option<LocatedEvent> {
        self.output.quintic(&self.from, &self.to);
        let unseen = self.event_functions.is_empty()
            && self.probes.is_empty()
            && !self.evaluator.dynamics.has_crossings();
        if unseen && !self.sink.reads_within_steps(self.to.time) {
            return None;
        }
        if self.settings.method == Method::Dop853 {
            self.output.raise(self.evaluator, &self.from, &self.to);
        }
        self.earliest()?;
        // The state to restart from comes out of the polynomial: make it as
        // good as the method's own result, and look again.
        self.output.raise(self.evaluator, &self.from, &self.to);
        self.earliest()
    }

    /// What a probe has found on an output that only a method of low order has, once
    /// more on a better one: the run restarts from there.
    fn refine_probe(&mut self, found: Option<LocatedEvent>) -> Option<LocatedEvent> {
        let probed = found.is_some_and(|found| found.watch >= self.event_functions.len());
        if !probed || self.settings.method == Method::Dop853 {
            return found;
        }
        self.output.raise(self.evaluator, &self.from, &self.to);
        let found = self.earliest();
        self.probe_before(found)
    }

    /// The earliest switch on the output of an implicit method.
    ///
    /// Where the step is long against a fast mode, the right-hand side at its
    /// ends magnifies the error of the state by (ωh)², and only states can be
    /// trusted: ends and middle. Where it is not, and just after a switch, the
    /// accelerations are needed: states within the tolerance do not tell in
    /// which direction a guard that is zero sets out.
    fn earliest_of_stiff(&mut self, middle: &[f64]) -> Option<LocatedEvent> {
        self.output.quintic(&self.from, &self.to);
        if self.zero_at_start.is_empty() && !self.agrees_in_middle(middle) {
            self.output
                .through_middle(self.evaluator, &self.from, middle, &self.to);
        }
        self.earliest()
    }

    /// The output's state in the middle of the step is the given one, within
    /// the tolerance of the run.
    fn agrees_in_middle(&mut self, middle: &[f64]) -> bool {
        let step = self.output.step(1.0);
        step.state(0.5, &mut self.middle);
        let scales = self.evaluator.dynamics.scales();
        let states = self.middle.iter().zip(middle).zip(scales);
        states
            .into_iter()
            .all(|((a, b), scale)| (a - b).abs() <= self.settings.tolerance * (scale + b.abs()))
    }

    fn earliest(&self) -> Option<LocatedEvent> {
        let stretch = Stretch {
            step: self.output.step(1.0),
            from: &self.from,
            to: &self.to,
            zero_at_start: &self.zero_at_start,
            touching: &self.touching,
        };
        stretch.earliest(&self.event_functions)
    }

    /// The whole step without a switch.
    fn pass(&mut self) -> Verdict {
        let modes = self.evaluator.modes.borrow();
        self.sink.step(&self.output.step(1.0), &modes);
        drop(modes);
        std::mem::swap(&mut self.from, &mut self.to);
        self.zero_at_start.clear();
        self.release_touching();
        self.release_resting();
        self.fresh = false;
        self.switches_at_once = 0;
        self.check_limits()
    }

    /// Stands at (`time`, `y`), evaluating the derivative there.
    fn move_to(&mut self, time: f64, y: &[f64]) {
        let mut dy = std::mem::take(&mut self.to.dy);
        self.evaluator.derivatives(time, y, &mut dy);
        self.from.set(self.evaluator, time, y, &dy);
        self.to.dy = dy;
        let obstacle = self.evaluator.take_obstacle();
        self.evaluator.take_not_finite();
        if let Some(index) = self.from.not_finite() {
            let stop = obstacle.map(Stop::Physical);
            self.stop = Some(stop.unwrap_or_else(|| self.not_finite(index)));
        }
    }

    /// Moves over a rest of the leg in which speeds would drown in the rounding
    /// of displacements; so short a rest is a straight line.
    pub(super) fn skip_to_target(&mut self) {
        let rest = self.target - self.from.time;
        let states = self.from.y.iter().zip(&self.from.dy);
        let y: Vec<f64> = states.map(|(y, dy)| y + rest * dy).collect();
        self.move_to(self.target, &y);
    }
}
