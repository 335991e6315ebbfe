//! The explicit methods of `ode_solvers`, and all that has to be known about
//! that crate (version 0.6.2):
//!
//! The methods are `rk4`, `dopri5` and `dop853`: for comparison, and where they are best.
//!
//! * `Rk4` takes ⌈span/step⌉ whole steps and overshoots the end: the step is
//!   made to fit, and half a step is taken off the span.
//! * `Rk4` hands `solout` the derivative of the old point: it is evaluated anew
//!   (and given back to the solver at its next step).
//! * `Rk4` ends with `Ok` on a state that is not a number: every step is checked.
//! * `Dopri5` and `Dop853` shrink the step to nothing where the right-hand side
//!   is not a number and report an underflow: the evaluator remembers why.
//! * In dense mode time and state given to `solout` do not belong together: the
//!   output is sparse, where they do. It keeps every step in memory: a leg is
//!   ended after [`STEPS_PER_LEG`] steps and taken up again.
//! * The nodes c₁₂ and c₁₃ of `Dop853` are zero instead of one: time is carried
//!   as one more state, too small to count in the error norm.
//! * One absolute tolerance for all states: the state is scaled.
//! * The search for a first step reckons in seconds: it is never used.
//! * The check for stiffness gives up after 15 suspicious steps although the
//!   result keeps its tolerance: it is off; the limits of the run apply.
//! * `rejected_steps` leaves out those before the first accepted step: they are
//!   counted from the calls.

use super::pace::SHARE_OF_OTHERS;
use super::run::{Run, Verdict};
use super::{Dynamics, Method, Stop};
use ode_solvers::dop_shared::IntegrationError;
use ode_solvers::{DVector, Dop853, Dopri5, OutputType, Rk4, SVector, System};
use std::cell::{Cell, RefCell};

/// Accepted steps after which a leg is ended, to bound the solver's memory.
const STEPS_PER_LEG: u64 = 4096;

/// Unit of the time state in leg lengths: its rounding must not be seen by the
/// error control. A power of two, so that nothing is rounded.
const TIME_UNIT: f64 = 1_048_576.0;

/// Takes the run as far towards its target as one leg goes: to the target, to
/// a switch, or until the memory of the solver has to be emptied.
pub(super) fn follow_leg<D: Dynamics>(run: &mut Run<'_, D>) {
    match run.settings.method {
        Method::Rk4 => rk4(run),
        Method::Dopri5 => dopri5(run),
        _ => dop853(run),
    }
}

fn rk4<D: Dynamics>(run: &mut Run<'_, D>) {
    let (start, span) = (run.from.time, run.target - run.from.time);
    let step = run.settings.step.unwrap_or(span);
    // A whole number of steps; a rest below a millionth of one is rounding.
    let count = (span / step - 1e-6).ceil().max(run.fewest_steps());
    let step = span / count;
    if step <= 4.0 * f64::EPSILON * start.abs().max(run.target.abs()) {
        run.end(Stop::StepFloor { step });
        return;
    }
    let steps = count.min(STEPS_PER_LEG as f64);
    let half_a_step_early = start + (steps - 0.5) * step;
    let counters = Counters::default();
    let problem = Problem::new(run, &counters, 1e-3 * step);
    let state = problem.scaled_start();
    let ended = Rk4::new(problem, start, state, half_a_step_early, step).integrate();
    debug_assert!(ended.is_ok(), "Rk4 has no way to fail");
}

fn dopri5<D: Dynamics>(run: &mut Run<'_, D>) {
    let first = run.first_length(5);
    let (start, target) = (run.from.time, run.target);
    let tolerance = SHARE_OF_OTHERS * run.tolerance();
    let longest = run.longest_step().min(target - start);
    let counters = Counters::default();
    let problem = Problem::new(run, &counters, rounding(start, target));
    let state = problem.scaled_start();
    let ended = Dopri5::from_param(
        problem,
        start,
        target,
        0.0,
        state,
        tolerance,
        tolerance,
        0.9,
        0.04,
        0.2,
        10.0,
        longest,
        first,
        u32::MAX,
        u32::MAX,
        OutputType::Sparse,
    )
    .integrate();
    let attempts = counters.calls.get().saturating_sub(1) / 6;
    run.rejected += attempts.saturating_sub(counters.accepted.get());
    if let Err(error) = ended {
        end_by_error(run, &error);
    }
}

fn dop853<D: Dynamics>(run: &mut Run<'_, D>) {
    let first = run.first_length(8);
    let (start, target) = (run.from.time, run.target);
    let dimension = run.from.y.len() as f64;
    // The norm divides by the number of states, time included.
    let tolerance = SHARE_OF_OTHERS * run.tolerance() * (dimension / (dimension + 1.0)).sqrt();
    let longest = run.longest_step().min(target - start);
    let counters = Counters::default();
    let mut problem = Problem::new(run, &counters, rounding(start, target));
    problem.time_unit = Some(TIME_UNIT * (target - start));
    let state = problem.scaled_start();
    macro_rules! solve {
        ($state:expr) => {
            Dop853::from_param(
                problem,
                start,
                target,
                0.0,
                $state,
                tolerance,
                tolerance,
                0.9,
                0.0,
                0.333,
                6.0,
                longest,
                first,
                u32::MAX,
                u32::MAX,
                OutputType::Sparse,
            )
            .integrate()
        };
    }
    // One and two coordinates, with the clock.
    let ended = match state.len() {
        3 => solve!(SVector::<f64, 3>::from_column_slice(state.as_slice())),
        5 => solve!(SVector::<f64, 5>::from_column_slice(state.as_slice())),
        _ => solve!(state),
    };
    let (calls, accepted) = (counters.calls.get(), counters.accepted.get());
    let attempts = calls.saturating_sub(1 + accepted) / 11;
    run.rejected += attempts.saturating_sub(accepted);
    if let Err(error) = ended {
        end_by_error(run, &error);
    }
}

/// Difference of two clocks that is rounding only.
fn rounding(start: f64, target: f64) -> f64 {
    4.0 * f64::EPSILON * start.abs().max(target.abs())
}

/// What a solver's error means for the run.
fn end_by_error<D: Dynamics>(run: &mut Run<'_, D>, error: &IntegrationError) {
    if run.stop.is_some() {
        return;
    }
    let method = run.settings.method;
    match error {
        IntegrationError::StepSizeUnderflow { x } => {
            run.end_at_floor(10.0 * f64::EPSILON * x.abs());
        }
        IntegrationError::StiffnessDetected { x } => {
            let reason = format!(
                "the problem is stiff from t = {x} s on: an implicit method (bdf, tr_bdf2, esdirk34) needs fewer steps"
            );
            run.end(Stop::Method { method, reason });
        }
        IntegrationError::MaxNumStepReached { x, n_step } => {
            let reason = format!("{n_step} steps within one leg, at t = {x} s");
            run.end(Stop::Method { method, reason });
        }
    }
}

/// Counts of one leg, read after the solver has gone.
#[derive(Debug, Default)]
struct Counters {
    calls: Cell<u64>,
    accepted: Cell<u64>,
}

/// A leg of a run in the solver's clothes: scaled state, time as one more
/// state where the solver's own is wrong.
struct Problem<'r, 'a, D: Dynamics> {
    run: &'r mut Run<'a, D>,
    counters: &'r Counters,
    start: f64,
    /// Closer to the target than this is on the target (s).
    snap: f64,
    /// Unit of the time state (s); `None`: the solver's time is used.
    time_unit: Option<f64>,
    /// The derivative at the next point asked for is the run's own `from.dy`.
    known: Cell<bool>,
    work: RefCell<Work>,
}

/// State and derivative without scale.
struct Work {
    y: Vec<f64>,
    dy: Vec<f64>,
}

impl<'r, 'a, D: Dynamics> Problem<'r, 'a, D> {
    fn new(run: &'r mut Run<'a, D>, counters: &'r Counters, snap: f64) -> Self {
        let work = Work {
            y: run.from.y.clone(),
            dy: run.from.dy.clone(),
        };
        Self {
            start: run.from.time,
            counters,
            snap,
            time_unit: None,
            known: Cell::new(true),
            work: RefCell::new(work),
            run,
        }
    }

    fn scales(&self) -> &'a [f64] {
        self.run.evaluator.dynamics.scales()
    }

    fn scaled_start(&self) -> DVector<f64> {
        let states = self.run.from.y.iter().zip(self.scales());
        let clock = self.time_unit.map(|_| 0.0);
        DVector::from_iterator(
            self.run.from.y.len() + usize::from(clock.is_some()),
            states.map(|(y, scale)| y / scale).chain(clock),
        )
    }
}

impl<D: Dynamics> Problem<'_, '_, D> {
    /// Derivative of the scaled state.
    fn rates(&self, x: f64, z: &[f64], dz: &mut [f64]) {
        self.counters.calls.set(self.counters.calls.get() + 1);
        let mut work = self.work.borrow_mut();
        let Work { y, dy } = &mut *work;
        let count = y.len();
        if self.known.take() {
            dy.copy_from_slice(&self.run.from.dy);
        } else {
            let time = self
                .time_unit
                .map_or(x, |unit| self.start + unit * z[count]);
            unscale(z, self.scales(), y);
            self.run.evaluator.derivatives(time, y, dy);
        }
        for (index, scale) in self.scales().iter().enumerate() {
            dz[index] = dy[index] / scale;
        }
        if let Some(unit) = self.time_unit {
            dz[count] = 1.0 / unit;
        }
    }

    /// Hands a step on; true when the leg ends.
    fn pass_step_on(&mut self, x: f64, z: &[f64], dz: &[f64]) -> bool {
        let scales = self.scales();
        let Work { y, dy } = self.work.get_mut();
        unscale(z, scales, y);
        let near = (x - self.run.target).abs() <= self.snap;
        let time = if near { self.run.target } else { x };
        if self.run.settings.method == Method::Rk4 {
            self.run.evaluator.derivatives(time, y, dy);
            self.known.set(true);
        } else {
            unscale(dz, scales, dy);
        }
        let accepted = self.counters.accepted.get() + 1;
        self.counters.accepted.set(accepted);
        self.run.accept_step(time, y, dy, None) != Verdict::Continue || accepted >= STEPS_PER_LEG
    }
}

impl<D: Dynamics> System<f64, DVector<f64>> for Problem<'_, '_, D> {
    fn system(&self, x: f64, z: &DVector<f64>, dz: &mut DVector<f64>) {
        self.rates(x, z.as_slice(), dz.as_mut_slice());
    }

    fn solout(&mut self, x: f64, z: &DVector<f64>, dz: &DVector<f64>) -> bool {
        self.pass_step_on(x, z.as_slice(), dz.as_slice())
    }
}

/// For few states, whose vectors need no memory of their own.
impl<D: Dynamics, const N: usize> System<f64, SVector<f64, N>> for Problem<'_, '_, D> {
    fn system(&self, x: f64, z: &SVector<f64, N>, dz: &mut SVector<f64, N>) {
        self.rates(x, z.as_slice(), dz.as_mut_slice());
    }

    fn solout(&mut self, x: f64, z: &SVector<f64, N>, dz: &SVector<f64, N>) -> bool {
        self.pass_step_on(x, z.as_slice(), dz.as_slice())
    }
}

fn unscale(z: &[f64], scales: &[f64], y: &mut [f64]) {
    for ((y, z), scale) in y.iter_mut().zip(z).zip(scales) {
        *y = z * scale;
    }
}
