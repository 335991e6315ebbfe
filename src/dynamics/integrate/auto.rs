//! Which method for which system: `method: auto`.
//!
//! `auto` takes `exact` for every branch that qualifies. For the rest it takes the method that
//! is expected to reach the tolerance soonest; the reason stands in the results.
//!
//! * The estimate follows from the eigenvalues, of up to 40 coordinates; of more, from the
//!   fastest rate.
//! * Vibrations that die out count for the share of a turn in which they exceed the tolerance.
//!   Laws and their breaks limit steps. The rest is the speed of the drives. How far a series
//!   follows the laws, the laws themselves state.
//! * A tolerance bounds the error of a step, and errors add up. `auto` gives its method a finer
//!   tolerance, by a margin measured on the scenarios, so that the whole run keeps the
//!   tolerance of the scene.
//!
//! `tests/runs/auto.rs` holds its choices by counts of evaluations; `benches/auto` by errors
//! and times on all scenarios that have something to integrate.

use super::{Dynamics, Method, Modes, Reserve};
use crate::units::shown;
use std::f64::consts::TAU;

/// Situation on which the choice of a method depends.
#[derive(Clone, Debug, PartialEq)]
pub struct Situation {
    /// Greatest rate of the system (1/s): spectral radius of its Jacobian with
    /// every pair engaged, see [`fastest_rate`]. An explicit method must follow
    /// it even when nothing of it is to be seen in the motion.
    pub fastest: f64,
    /// Vibrations that the motion sets going: those of the objects that a pair lets go
    /// and hits again, and all where the start is not the quiet one.
    pub vibrations: Vec<Vibration>,
    /// Greatest speed of the drives (rad/s).
    pub turning: f64,
    /// True when a law that is no constant ratio, or a linkage, hangs on them.
    pub has_variable_ratio: bool,
    /// Way of the fastest drive (rad) over which a power series knows those laws at
    /// tolerances of 1e-7, on the average; infinite where none has_variable_ratio.
    pub way: f64,
    /// Breaks of laws and loads that the motion passes: every method begins anew
    /// behind them.
    pub breaks: f64,
    /// True when the motion has a power series ([`Dynamics::expands`]).
    pub expands: bool,
    /// True when a motor's torque over its speed has corners (a table), at which
    /// nothing switches.
    pub corners: bool,
    /// True when joints of a linkage of several inputs have friction: implicit methods
    /// then take far more evaluations near a singular position than explicit ones.
    pub joint_friction: bool,
    /// Error wanted, relative to the scales of the state.
    pub tolerance: f64,
    /// Number of coordinates.
    pub coordinates: usize,
    /// Time to be simulated (s).
    pub duration: f64,
}

/// A vibration.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Vibration {
    /// Angular frequency (rad/s).
    pub frequency: f64,
    /// Rate of decay: inverse of the time in which it falls to 1/e (1/s); 0: it stays.
    pub decay: f64,
}

/// With joint friction of several inputs an implicit method is taken only where it costs
/// so many times less. (Measured on twelve random five-bars, as whole runs: radau took 12 to 68
/// times as long as dop853, and rodas5p was not done after 20 s.)
const NEAR_SINGULAR: f64 = 60.0;

/// A law has_variable_ratio as a sine of so many times the speed of its drive does.
const HARMONICS: f64 = 1.5;

/// A vibration that dies out takes this share of the steps that it would take if it
/// stayed until it is below the tolerance: the less is left of it, the longer they are.
const FADING: f64 = 0.5;

impl Situation {
    /// Highest angular frequency (rad/s) that the motion shows, on the average: a
    /// vibration counts for the share of the time between two turns of the drives in
    /// which it is above the tolerance.
    pub fn highest_frequency(&self) -> f64 {
        let turning = self.turning
            * if self.has_variable_ratio {
                HARMONICS
            } else {
                1.0
            };
        let turn = TAU / self.turning.max(TAU / self.duration);
        let digits = -self.tolerance.ln();
        let alive = |decay: f64| match decay > 0.0 {
            true => (FADING * digits / (decay * turn)).min(1.0),
            false => 1.0,
        };
        let vibrations = self.vibrations.iter();
        // Something is to be seen at least once in the run.
        vibrations
            .map(|vibration| vibration.frequency * alive(vibration.decay))
            .fold(turning.max(TAU / self.duration), f64::max)
    }
}

/// How a method behaves. Steps as measured with this program on a vibration of 1 rad/s
/// that stays (two rotors on a shaft, of the scenarios), costs on the scenarios with
/// one to nine coordinates. Series follow their coefficients; the bound of stability
/// given is that of the exponential series of degree 12, about (p + ½·ln 2πp)/e.
struct Behaviour {
    method: Method,
    /// Step at tolerance 1e-8 (s).
    step: f64,
    /// The step grows with the tolerance to the power 1/`order`.
    order: f64,
    /// Greatest rate × step that remains stable.
    stable: f64,
    /// True when laws are known over a certain way only ([`Situation::way`]).
    follows_laws: bool,
    /// The tolerance bounds the error of a step. What the steps of a run add up to, in
    /// deviations that may stay far below the scale they are measured by, was at most so many
    /// times that on the scenarios: `auto` aims so much finer.
    margin: f64,
    /// Steps lost in beginning anew.
    restart: f64,
    /// Cost of a step in evaluations, and what is added for every coordinate up
    /// to [`FULL`] (columns of the Jacobian, less what is shared) …
    cost: [f64; 2],
    /// … and for every digit of the tolerance.
    digit: f64,
}

/// Digits above which methods do not change any more.
const MOST_DIGITS: f64 = 13.0;

/// Coordinates above which the cost of a step against that of an evaluation stays.
const FULL: f64 = 6.0;

/// With corners that no switch marks, a step of high order may pass over one unseen: the
/// margin of `radau` is so many times greater.
const UNSEEN: f64 = 5.0;

/// The way over which a law is known grows with the tolerance to the first of these
/// powers, up to a tolerance of 1e-4; below 1e-7 to the second (see `system::taylor::law`).
const OF_WAY: [f64; 2] = [1.0 / 8.0, 0.5 / 8.0];

/// Nothing is aimed at that is finer, unless it is asked for: rounding adds up as well.
const FINEST: f64 = 1e-13;

const BEHAVIOURS: [Behaviour; 5] = [
    Behaviour {
        method: Method::Taylor,
        step: 1.1,
        order: 46.0,
        stable: 5.0,
        follows_laws: true,
        margin: 20.0,
        restart: 1.0,
        cost: [4.0, 0.0],
        digit: 0.9,
    },
    Behaviour {
        method: Method::Dop853,
        step: 0.47,
        order: 8.0,
        stable: 6.1,
        follows_laws: false,
        margin: 4.0,
        restart: 1.0,
        cost: [20.0, 0.0],
        digit: 0.0,
    },
    Behaviour {
        method: Method::Dopri5,
        step: 0.064,
        order: 5.0,
        stable: 3.3,
        follows_laws: false,
        margin: 4.0,
        restart: 1.0,
        cost: [6.0, 0.0],
        digit: 0.0,
    },
    Behaviour {
        method: Method::Rodas5p,
        step: 0.083,
        order: 5.0,
        stable: f64::INFINITY,
        follows_laws: false,
        margin: 10.0,
        restart: 1.0,
        cost: [8.0, 1.5],
        digit: 0.0,
    },
    Behaviour {
        method: Method::Radau,
        step: 1.0,
        order: 9.0,
        stable: f64::INFINITY,
        follows_laws: false,
        margin: 20.0,
        restart: 3.0,
        // Fewer iterations and refusals, the finer the tolerance.
        cost: [36.0, -1.2],
        digit: -1.7,
    },
];

/// Methods that may go on where another cannot.
const RESERVE: [Method; 4] = [
    Method::Radau,
    Method::Dop853,
    Method::Rodas5p,
    Method::Taylor,
];

/// None is in reserve that is expected to need so many times the work of the method chosen …
const DEAREST: f64 = 300.0;

/// … unless it needs no more evaluations than this.
const CHEAP: f64 = 1e6;

impl Behaviour {
    /// The tolerance that keeps the one asked for over a whole run.
    fn tolerance_for_run(&self, situation: &Situation) -> f64 {
        let asked = situation.tolerance;
        let unseen = match situation.corners && self.method == Method::Radau {
            true => UNSEEN,
            false => 1.0,
        };
        (asked / (unseen * self.margin)).max(FINEST).min(asked)
    }

    /// Steps (s) that accuracy and stability allow.
    fn allowed_steps(&self, situation: &Situation) -> [f64; 2] {
        let aim = self.tolerance_for_run(situation);
        let kept = match self.method {
            Method::Radau => super::radau::effective_tolerance(aim),
            _ => aim,
        };
        let mut accurate =
            self.step * (kept / 1e-8).powf(1.0 / self.order) / situation.highest_frequency();
        if situation.has_variable_ratio && self.follows_laws {
            let coarse = (aim.clamp(1e-7, 1e-4) / 1e-7).powf(OF_WAY[0]);
            let fine = (aim.min(1e-7) / 1e-7).powf(OF_WAY[1]);
            accurate = accurate.min(coarse * fine * situation.way / situation.turning);
        }
        [accurate, self.stable / situation.fastest]
    }

    /// Work of the whole run in evaluations.
    fn evaluations_of_run(&self, situation: &Situation) -> f64 {
        let [accurate, stable] = self.allowed_steps(situation);
        let columns = (situation.coordinates as f64).min(FULL);
        let digits = (-self.tolerance_for_run(situation).log10()).clamp(1.0, MOST_DIGITS);
        let cost = self.cost[0] + self.cost[1] * columns + self.digit * digits;
        let steps = situation.duration / accurate.min(stable).min(situation.duration);
        cost * (steps + self.restart * (1.0 + situation.breaks))
    }
}

/// A choice.
#[derive(Clone, Debug, PartialEq)]
pub struct MethodChoice {
    /// The method.
    pub method: Method,
    /// The tolerance to give it: finer than the one asked for, which bounds the
    /// error of the whole run.
    pub tolerance: f64,
    /// Why, in a sentence.
    pub why: String,
    /// What goes on where it cannot, or where the motion becomes stiff: the first first.
    pub reserve: Vec<Reserve>,
}

/// The method that is expected to need the least work to keep the tolerance over the
/// whole run.
///
/// One of the library's own or of `ode_solvers`; explicit unless the implicit
/// one is expected to need less.
pub fn choose(situation: &Situation) -> MethodChoice {
    // A system without springs has no rate of its own.
    let situation = &Situation {
        fastest: situation.fastest.max(situation.highest_frequency()),
        ..situation.clone()
    };
    let implicit = |behaviour: &Behaviour| behaviour.stable.is_infinite();
    let least = |wanted: bool| {
        let fit = BEHAVIOURS
            .iter()
            .filter(|b| implicit(b) == wanted && (situation.expands || b.method != Method::Taylor));
        fit.min_by(|a, b| {
            a.evaluations_of_run(situation)
                .total_cmp(&b.evaluations_of_run(situation))
        })
        .expect("the list has methods of both kinds")
    };
    let (explicit, implicit) = (least(false), least(true));
    let dearer = match situation.joint_friction {
        true => NEAR_SINGULAR,
        false => 1.0,
    };
    let [for_implicit, for_explicit] =
        [implicit, explicit].map(|own| own.evaluations_of_run(situation));
    let (chosen, why) = match dearer * for_implicit < for_explicit {
        true => (implicit, why_implicit(situation, explicit, implicit)),
        false => {
            let mut why = why_explicit(situation, explicit);
            if for_implicit < for_explicit {
                let slow =
                    "; implicit methods are slow near singular positions with joint friction";
                why.push_str(slow);
            }
            (explicit, why)
        }
    };
    let tolerance = chosen.tolerance_for_run(situation);
    let why = match tolerance < situation.tolerance {
        true => format!(
            "{why}; with a tolerance of {tolerance}, as errors add up over a run",
            tolerance = shown(tolerance, 2)
        ),
        false => why,
    };
    let others = RESERVE.iter().filter(|&&method| method != chosen.method);
    let others = others.filter(|&&method| situation.expands || method != Method::Taylor);
    let others = others.filter_map(|&method| BEHAVIOURS.iter().find(|own| own.method == method));
    let dearest = (DEAREST * chosen.evaluations_of_run(situation)).max(CHEAP);
    let others = others.filter(|own| own.evaluations_of_run(situation) <= dearest);
    MethodChoice {
        method: chosen.method,
        tolerance,
        why,
        reserve: others
            .map(|own| Reserve {
                method: own.method,
                tolerance: own.tolerance_for_run(situation),
            })
            .collect(),
    }
}

fn why_implicit(situation: &Situation, explicit: &Behaviour, implicit: &Behaviour) -> String {
    let [accurate, stable] = explicit.allowed_steps(situation);
    let (fastest, seen) = (situation.fastest, situation.highest_frequency());
    let held = if stable < accurate {
        format!(
            "the system's fastest rate, {fastest} 1/s, is {:.0} times what the motion shows",
            fastest / seen,
            fastest = shown(fastest, 3)
        )
    } else {
        format!(
            "the motion shows no more than {} rad/s most of the time",
            shown(seen, 3)
        )
    };
    format!(
        "{held}; {} would be held to steps of {} s where {} takes {} s",
        explicit.method,
        shown(accurate.min(stable), 2),
        implicit.method,
        shown(
            implicit.allowed_steps(situation)[0].min(situation.duration),
            2
        )
    )
}

fn why_explicit(situation: &Situation, explicit: &Behaviour) -> String {
    let [accurate, stable] = explicit.allowed_steps(situation);
    let bound = if accurate <= stable {
        "the tolerance"
    } else {
        "the system's fastest rate"
    };
    let series = match explicit.method {
        Method::Taylor => "power series, ",
        _ => "explicit, ",
    };
    format!(
        "{series}as the fastest rate, {} 1/s, is only {:.1} times what the motion shows; \
         {bound} asks for steps of about {} s",
        shown(situation.fastest, 3),
        situation.fastest / situation.highest_frequency(),
        shown(accurate.min(stable).min(situation.duration), 2)
    )
}

/// Spectral radius (1/s) of the Jacobian at a state: the mean growth of a
/// vector under repeated multiplication, in units of the scales. Good to a few
/// per cent, for real and complex dominant pairs alike; 0 for free masses.
pub fn fastest_rate<D: Dynamics>(dynamics: &D, time: f64, y: &[f64], modes: &Modes) -> f64 {
    const SETTLE: usize = 40;
    const MEASURE: usize = 160;
    let scales = dynamics.scales();
    let mut scratch = dynamics.scratch();
    // No symmetry of a chain may be orthogonal to the start.
    let start = |index: usize| 1.0 + 0.37 * ((index * 7 + 3) % 11) as f64;
    let mut vector: Vec<f64> = scales
        .iter()
        .enumerate()
        .map(|(i, s)| s * start(i))
        .collect();
    let mut image = vec![0.0; vector.len()];
    let mut logarithm = 0.0;
    for iteration in 0..SETTLE + MEASURE {
        dynamics.tangent(time, y, modes, &vector, &mut scratch, &mut image);
        let squares = image.iter().zip(scales).map(|(e, s)| (e / s).powi(2));
        let size = squares.sum::<f64>().sqrt();
        if !(size > 0.0 && size.is_finite()) {
            return 0.0;
        }
        if iteration >= SETTLE {
            logarithm += size.ln();
        }
        for (next, entry) in vector.iter_mut().zip(&image) {
            *next = entry / size;
        }
    }
    (logarithm / MEASURE as f64).exp()
}

#[cfg(test)]
#[path = "auto_tests.rs"]
mod tests;
