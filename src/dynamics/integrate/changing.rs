//! Changes of the method during a run: from one that has become dear, or that cannot go on.
//!
//! An explicit method is held to short steps where the motion has become stiff. That is
//! measured, not foreseen: now and then, ever more rarely, a long step of `radau` is tried
//! from where the run stands, and the state that it came to is compared when the run gets
//! there. A method that gives up, or whose step falls to its floor, hands over to the next.
//!
//! If `radau` is cheaper, and foresees the state that then comes, it takes over.
//! A run whose energies or equations of motion fail their checks is made anew by the next
//! method. Before each leg given functions of time are searched by bounds for stretches in
//! which they change briefly (`math::narrow`); legs end where these begin, and steps in them
//! are short with every method.

use super::run::Run;
use super::{Dynamics, Method, Stop, radau};

/// A method in reserve, with the tolerance that it is given.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Reserve {
    /// The method.
    pub method: Method,
    /// Its tolerance.
    pub tolerance: f64,
}

/// A change of the method.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Change {
    /// When (s).
    pub time: f64,
    /// The method before.
    pub from: Method,
    /// The method from then on.
    pub to: Method,
    /// Why.
    pub cause: Cause,
}

/// Why a method is changed.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Cause {
    /// The step fell below what the clock resolves.
    Floor,
    /// The motion has become stiff.
    Stiff,
    /// The method gave up, as where it switches to and fro and comes no further.
    GaveUp,
}

/// Steps before a long step is tried for the first time; each time twice as many follow.
const FIRST_WINDOW: u64 = 32;
const LONGEST_WINDOW: u64 = 1 << 14;
/// Work that the change must save: by this factor.
const GAIN: f64 = 3.0;
/// Evaluations of a step of `radau` as first expected, and what its elimination adds.
const EXPECTED: f64 = 60.0;
const ELIMINATION: f64 = 1.5;
/// Trials in succession that must come out as foreseen, and the steps between them.
const CONFIRMATIONS: u32 = 2;
const AGAIN: u64 = 12;
/// What is foreseen may differ so many tolerances from what comes.
const CONFIRMED: f64 = 100.0;
/// A step that is not so many times as long is not tried.
const LEAST_RATIO: f64 = 3.0;

/// What a run knows of its changes.
#[derive(Debug)]
pub(super) struct ChangeTracker {
    pub(super) reserve: Vec<Reserve>,
    pub(super) changes: Vec<Change>,
    window: u64,
    /// Steps since the last trial; time and evaluations when half of the window was over.
    counted: u64,
    since: (f64, u64),
    /// Where a long step would have led that seems to save work.
    trial: Option<Trial>,
    /// Trials in succession that came out as foreseen.
    confirmed: u32,
    due: bool,
}

/// A state that another method foresees.
#[derive(Debug)]
struct Trial {
    time: f64,
    y: Vec<f64>,
}

impl ChangeTracker {
    pub(super) fn new(reserve: &[Reserve]) -> Self {
        Self {
            reserve: reserve.to_vec(),
            changes: Vec::new(),
            window: FIRST_WINDOW,
            counted: 0,
            since: (0.0, 0),
            trial: None,
            confirmed: 0,
            due: false,
        }
    }

    /// True while a stiff motion would be a reason to change.
    fn watches_stiffness(&self, method: Method) -> bool {
        let explicit = match method {
            Method::Dopri5 | Method::Dop853 | Method::Taylor => true,
            Method::Rk4
            | Method::Rodas5p
            | Method::Radau
            | Method::Bdf
            | Method::TrBdf2
            | Method::Esdirk34
            | Method::Exact => false,
        };
        explicit && self.reserve.iter().any(|own| own.method == Method::Radau)
    }
}

impl<D: Dynamics> Run<'_, D> {
    /// True when `radau` would go on from here with much less work. Asked after every step.
    pub(super) fn is_to_change(&mut self) -> bool {
        if !self.changing.watches_stiffness(self.settings.method) {
            return false;
        }
        if let Some(trial) = self.changing.trial.take() {
            if self.from.time < trial.time {
                self.changing.trial = Some(trial);
                return false;
            }
            if !self.confirms(&trial) {
                self.changing.confirmed = 0;
                return false;
            }
            self.changing.confirmed += 1;
            self.changing.due = self.changing.confirmed >= CONFIRMATIONS;
            // What is true of a moment only, between two switches, is no reason to change.
            self.changing.window = AGAIN;
            return self.changing.due;
        }
        // The first steps behind a start or a switch are short without need.
        let half = self.changing.window / 2;
        if self.changing.counted == half {
            self.changing.since = (self.from.time, self.evaluator.evaluations());
        }
        self.changing.counted += 1;
        if self.changing.counted <= self.changing.window {
            return false;
        }
        let steps = (self.changing.counted - 1 - half) as f64;
        let (since, before) = self.changing.since;
        let last = self.output.step(1.0).length;
        let step = ((self.from.time - since) / steps).max(last);
        let work = (self.evaluator.evaluations() - before) as f64 / steps;
        let wanted = GAIN * ELIMINATION * EXPECTED / work.max(1.0) * step;
        let rest = self.target - self.from.time;
        let length = wanted.min(rest).min(self.longest_step());
        if length < LEAST_RATIO * step {
            return false; // asked again after the next step
        }
        self.changing.counted = 0;
        self.changing.window = (2 * self.changing.window).min(LONGEST_WINDOW);
        let before = self.evaluator.evaluations();
        let foreseen = radau::foresee(self, length);
        let cost = ELIMINATION * (self.evaluator.evaluations() - before) as f64;
        // Trial points may lie where there are no forces; that is no failure.
        self.evaluator.take_not_finite();
        let saves = length / cost >= GAIN * step / work.max(1.0);
        let time = self.from.time + length;
        self.changing.trial = foreseen.filter(|_| saves).map(|y| Trial { time, y });
        if self.changing.trial.is_none() {
            self.changing.confirmed = 0;
        }
        false
    }

    /// True when the last step comes by what was foreseen.
    fn confirms(&mut self, trial: &Trial) -> bool {
        let step = self.output.step(1.0);
        let s = (trial.time - step.start) / step.length;
        if !(0.0..=1.0).contains(&s) {
            return false;
        }
        let mut y = vec![0.0; trial.y.len()];
        step.state(s, &mut y);
        let allowed = CONFIRMED * self.settings.tolerance;
        let dynamics = self.evaluator.dynamics;
        let pairs = y.iter().zip(&trial.y).enumerate();
        pairs.into_iter().all(|(index, (found, foreseen))| {
            (found - foreseen).abs() <= allowed * dynamics.error_size(index, *found)
        })
    }

    /// Something has switched: what was foreseen does not come.
    pub(super) fn forget_trial(&mut self) {
        self.changing.trial = None;
        self.changing.confirmed = 0;
    }

    /// Goes on with another method where that is due, or where the method cannot go on.
    pub(super) fn change_method(&mut self) {
        let due = std::mem::take(&mut self.changing.due);
        let cause = match &self.stop {
            Some(Stop::StepFloor { .. }) => Cause::Floor,
            Some(Stop::Method { .. }) => Cause::GaveUp,
            // Where the scene itself has no value, no other method gets further either.
            Some(Stop::NotFinite { .. }) if self.from.not_finite().is_none() => Cause::GaveUp,
            None if due => Cause::Stiff,
            Some(_) | None => return,
        };
        let reserve = &mut self.changing.reserve;
        let next = match cause {
            Cause::Floor | Cause::GaveUp => (!reserve.is_empty()).then_some(0),
            Cause::Stiff => reserve.iter().position(|own| own.method == Method::Radau),
        };
        let Some(next) = next else {
            return;
        };
        let next = reserve.remove(next);
        let from = self.settings.method;
        if cause == Cause::Stiff {
            let tolerance = self.settings.tolerance;
            reserve.push(Reserve {
                method: from,
                tolerance,
            });
        }
        self.changing.trial = None;
        self.changing.changes.push(Change {
            time: self.from.time,
            from,
            to: next.method,
            cause,
        });
        self.settings.method = next.method;
        self.settings.tolerance = next.tolerance;
        self.pace = super::pace::Pace::default();
        // Its order follows the tolerance.
        self.radau = None;
        self.stop = None;
    }
}
