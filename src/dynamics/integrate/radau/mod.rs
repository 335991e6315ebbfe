//! Radau IIA: the own method for stiff systems at fine tolerances.
//!
//! Collocation at Radau's points, of order 5, 9 or 13 with 3, 5 or 7 stages: the
//! order follows the tolerance. The unknowns are the accelerations at the stages;
//! speeds and displacements are their integrals, so that a system of second order
//! is half as large. The simplified Newton iteration has the Jacobian of the
//! middle of the step; the eigenvectors of the method decouple the stages into
//! one real and some complex systems, which are eliminated side by side. The
//! collocation polynomial is the continuous output.
//!
//! It takes long steps over vibrations that have died away, and few of them at fine tolerances.
//! A step with an event in its midst is taken anew so that it ends just behind it, where the
//! method is best.
//!
//! E. Hairer and G. Wanner, Stiff differential equations solved by Radau methods,
//! Journal of Computational and Applied Mathematics 111 (1999).

mod newton;
mod step;
mod tableau;

use super::Dynamics;
use super::pace::{CAUTION, step_towards};
use super::run::{Run, StepInterpolant, Verdict};
use newton::Stages;
use std::sync::OnceLock;
use tableau::Tableau;

/// Estimated error allowed per step, relative to the tolerance asked for, up to
/// the tolerance [`RESOLVED`]. The estimate is of order S; the step itself, once
/// the vibrations that are left are resolved, of nearly twice that. Tolerances above do
/// not resolve them, and the estimate is the error.
const SAFETY: f64 = 10.0;
const RESOLVED: f64 = 1e-7;
/// How fast the share falls from there on.
const UNRESOLVED: f64 = -1.0 / 3.0;

/// The estimated error allowed.
fn allowed_error(tolerance: f64) -> f64 {
    SAFETY * effective_tolerance(tolerance)
}

/// The tolerance as fine as it is kept.
pub(super) fn effective_tolerance(tolerance: f64) -> f64 {
    tolerance * (tolerance / RESOLVED).max(1.0).powf(UNRESOLVED)
}
/// Tolerances below which five and seven stages have less work.
const FIVE_STAGES: f64 = 3e-2;
const SEVEN_STAGES: f64 = 2e-3;
/// Bounds on the change of the step from one to the next.
const SHORTEST: f64 = 0.1;
const LONGEST: f64 = 8.0;
/// The error of a step just begun anew, or refused for the second time, falls with
/// this power of its length: it is still too long for its fastest modes.
const AGAIN: f64 = 3.0;
/// A step on which Newton's iteration does not converge is shortened to this share.
const NOT_CONVERGED: f64 = 0.4;

/// The method with its working memory, of the order that it was last used with.
#[derive(Debug)]
pub(super) enum Stepper {
    /// Order 5.
    Three(Box<Radau<3, 2>>),
    /// Order 9.
    Five(Box<Radau<5, 3>>),
    /// Order 13.
    Seven(Box<Radau<7, 4>>),
}

impl Stepper {
    fn new<D: Dynamics>(dynamics: &D, tolerance: f64) -> Self {
        static THREE: OnceLock<Tableau<3, 2>> = OnceLock::new();
        static FIVE: OnceLock<Tableau<5, 3>> = OnceLock::new();
        static SEVEN: OnceLock<Tableau<7, 4>> = OnceLock::new();
        if tolerance < SEVEN_STAGES {
            Self::Seven(Radau::new(dynamics, SEVEN.get_or_init(Tableau::new)))
        } else if tolerance < FIVE_STAGES {
            Self::Five(Radau::new(dynamics, FIVE.get_or_init(Tableau::new)))
        } else {
            Self::Three(Radau::new(dynamics, THREE.get_or_init(Tableau::new)))
        }
    }
}

/// Takes the run as far towards its target as one leg goes: to the target or
/// to a switch.
pub(super) fn follow_leg<D: Dynamics>(run: &mut Run<'_, D>) {
    let known = run.radau.take();
    let tolerance = run.settings.tolerance;
    let new = || Stepper::new(run.evaluator.dynamics, tolerance);
    let mut stepper = known.unwrap_or_else(new);
    match &mut stepper {
        Stepper::Three(radau) => radau.follow_leg(run),
        Stepper::Five(radau) => radau.follow_leg(run),
        Stepper::Seven(radau) => radau.follow_leg(run),
    }
    run.radau = Some(stepper);
}

/// The state to which a step of a length (s) leads from where the run stands, if it keeps the
/// tolerance. The run does not take it.
pub(super) fn foresee<D: Dynamics>(run: &mut Run<'_, D>, length: f64) -> Option<Vec<f64>> {
    let tolerance = run.settings.tolerance;
    let known = run.radau.take();
    let mut stepper = known.unwrap_or_else(|| Stepper::new(run.evaluator.dynamics, tolerance));
    let foreseen = match &mut stepper {
        Stepper::Three(radau) => radau.foresee(run, length),
        Stepper::Five(radau) => radau.foresee(run, length),
        Stepper::Seven(radau) => radau.foresee(run, length),
    };
    run.radau = Some(stepper);
    foreseen
}

/// The method with S stages, L = (S + 1)/2.
#[derive(Debug)]
pub(super) struct Radau<const S: usize, const L: usize> {
    stages: Stages<S, L>,
    /// The new state and its derivative.
    y: Vec<f64>,
    dy: Vec<f64>,
    /// Coefficients of the continuous output, one signal after the other.
    output: Vec<f64>,
    /// Rates of the signals beyond the coordinates at the stages.
    rates: Vec<[f64; S]>,
    signals: Vec<[f64; 3]>,
    /// Length and error of the last accepted step, for the step control.
    last: Option<(f64, f64)>,
}

/// Result of an attempt at a step.
#[derive(Clone, Copy, Debug, PartialEq)]
enum Attempt {
    /// The error in units of what is allowed; not a number counts as too much.
    Error(f64),
    /// Newton's iteration did not converge.
    NotConverged,
}

impl<const S: usize, const L: usize> Radau<S, L> {
    fn new<D: Dynamics>(dynamics: &D, tableau: &'static Tableau<S, L>) -> Box<Self> {
        let (count, signals) = (dynamics.coordinates(), dynamics.signals());
        Box::new(Self {
            stages: Stages::new(dynamics, tableau),
            y: vec![0.0; 2 * count],
            dy: vec![0.0; 2 * count],
            output: vec![0.0; signals * (S + 3)],
            rates: vec![[0.0; S]; signals - count],
            signals: vec![[0.0; 3]; signals],
            last: None,
        })
    }

    fn follow_leg<D: Dynamics>(&mut self, run: &mut Run<'_, D>) {
        let mut wanted = run.first_length(2 * S as i32 - 1);
        let longest = run.longest_step();
        self.last = None;
        self.stages.forget_stages();
        loop {
            let (time, target) = (run.from.time, run.target);
            let floor = 4.0 * f64::EPSILON * time.abs().max(target.abs());
            let mut again = false;
            let (length, error) = loop {
                let length = step_towards(target - time, wanted.min(longest));
                if length <= floor {
                    run.end_at_floor(length);
                    return;
                }
                let factor = match self.attempt_step(run, length) {
                    Attempt::Error(error) if error <= 1.0 => break (length, error),
                    Attempt::Error(error) => {
                        let order = if again || self.stages.is_first() {
                            AGAIN
                        } else {
                            (S + 1) as f64
                        };
                        CAUTION * error.powf(-1.0 / order)
                    }
                    Attempt::NotConverged => NOT_CONVERGED,
                };
                run.rejected += 1;
                again = true;
                self.last = None;
                // Not a number, or a step out of all proportion: well back.
                wanted = length * if factor > SHORTEST { factor } else { SHORTEST };
            };
            let lands = length >= target - time;
            let end = if lands { target } else { time + length };
            self.interpolate(run, length);
            let given = StepInterpolant::Polynomial(&self.output, S + 2);
            match run.accept_with(end, &self.y, &self.dy, given) {
                Verdict::Again(shorter) => {
                    wanted = shorter;
                    continue;
                }
                Verdict::Continue if !lands => wanted = length * self.step_factor(length, error),
                _ => return,
            }
            self.stages.keep_stages(length);
        }
    }

    fn foresee<D: Dynamics>(&mut self, run: &Run<'_, D>, length: f64) -> Option<Vec<f64>> {
        self.stages.forget_stages();
        let attempt = self.attempt_step(run, length);
        matches!(attempt, Attempt::Error(error) if error <= 1.0).then(|| self.y.clone())
    }

    /// Factor on the step after one of a certain error was accepted; the
    /// predictive control of K. Gustafsson (1994).
    fn step_factor(&mut self, length: f64, error: f64) -> f64 {
        let exponent = 1.0 / (S + 1) as f64;
        let error = error.max(1e-12);
        let mut factor = CAUTION * error.powf(-exponent);
        if let Some((before, then)) = self.last {
            let trend = (length / before) * (then / error).powf(exponent);
            factor = factor.min(factor * trend);
        }
        self.last = Some((length, error));
        factor.clamp(SHORTEST, LONGEST)
    }
}
