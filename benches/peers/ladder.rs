//! The loosest tolerance that reaches an error, and the time it takes there.

use crate::case::{Case, SAMPLES};
use crate::cvode_peer::{self, Cvode};
use crate::solution::{Solution, Timing};
use crate::{diffsol_peer, ode_solvers_peer};
use std::collections::BTreeMap;
use std::time::{Duration, Instant};

/// A solver with one of its methods.
#[derive(Clone, Debug)]
pub(crate) enum Peer {
    /// diffsol.
    Diffsol(&'static str),
    /// ode_solvers.
    OdeSolvers(&'static str),
    /// CVODE.
    Cvode(Cvode, &'static str),
}

impl Peer {
    /// All of them, CVODE where its program is given.
    pub(crate) fn all(cvode: Option<&Cvode>) -> Vec<Self> {
        let diffsol = diffsol_peer::METHODS.map(Self::Diffsol);
        let ode_solvers = ode_solvers_peer::METHODS.map(Self::OdeSolvers);
        let cvode = cvode.into_iter().flat_map(|cvode| {
            let methods = cvode_peer::METHODS.into_iter();
            methods.map(|method| Self::Cvode(cvode.clone(), method))
        });
        // The explicit ones first: what takes far longer than they do is given up.
        let (explicit, implicit) = diffsol.split_at(1);
        let explicit = explicit.iter().chain(&ode_solvers).cloned();
        let implicit = implicit.iter().cloned();
        explicit.chain(implicit).chain(cvode).collect()
    }

    /// Solver and method.
    pub(crate) fn name(&self) -> String {
        match self {
            Self::Diffsol(method) => format!("diffsol {method}"),
            Self::OdeSolvers(method) => format!("ode_solvers {method}"),
            Self::Cvode(_, method) => format!("CVODE {method}"),
        }
    }

    /// True for CVODE.
    pub(crate) fn is_cvode(&self) -> bool {
        matches!(self, Self::Cvode(..))
    }

    /// One run, and its time (s).
    ///
    /// # Errors
    /// What the solver says.
    pub(crate) fn solve(&self, case: &Case, tolerance: f64) -> Result<(Solution, f64), String> {
        let begin = Instant::now();
        let solution = match self {
            Self::Diffsol(method) => diffsol_peer::solve(&case.chain, method, tolerance, SAMPLES)?,
            Self::OdeSolvers(method) => {
                ode_solvers_peer::solve(&case.chain, method, tolerance, SAMPLES)?
            }
            Self::Cvode(cvode, method) => {
                let (solution, timing) = cvode.solve(case, method, tolerance, 0.0)?;
                return Ok((solution, timing.median));
            }
        };
        Ok((solution, begin.elapsed().as_secs_f64()))
    }

    /// Repeated runs.
    fn time(&self, case: &Case, tolerance: f64, budget: Duration) -> Option<Timing> {
        if let Self::Cvode(cvode, method) = self {
            let timed = cvode.solve(case, method, tolerance, budget.as_secs_f64());
            return timed.ok().map(|(_, timing)| timing);
        }
        let run = || self.solve(case, tolerance).is_ok();
        Some(Timing::measure(budget, run))
    }
}

/// A point of a solver that reaches a target.
#[derive(Clone, Copy, Debug)]
pub(crate) struct Point {
    /// Its tolerance.
    pub(crate) tolerance: f64,
    /// The error reached, relative to max|δ|.
    pub(crate) error: f64,
    /// Switches located.
    pub(crate) switches: Option<usize>,
    /// The times.
    pub(crate) timing: Timing,
}

/// The first and the last rung; rung r is the tolerance 10^(−r/2).
const RUNGS: [u32; 2] = [6, 25];

/// Why a target is not reached.
#[derive(Clone, Copy, Debug)]
pub(crate) enum Miss {
    /// At no tolerance of the ladder.
    NoTolerance,
    /// A single run took this long (s), and the climb was given up.
    TooLong(f64),
}

/// A target reached or missed.
pub(crate) type Reached = Result<Point, Miss>;

/// How a ladder is climbed.
#[derive(Clone, Copy, Debug)]
pub(crate) struct Climb {
    /// Time for repeated runs of one point.
    pub(crate) budget: Duration,
    /// A single run longer than this (s) ends the climb.
    pub(crate) longest: f64,
}

/// What single runs gave so far, by rung.
struct Tries<'a> {
    peer: &'a Peer,
    case: &'a Case,
    done: BTreeMap<u32, (f64, Option<usize>)>,
    /// Duration of the last one (s).
    last: f64,
}

impl Tries<'_> {
    /// The error at a rung; infinite when the solver fails.
    fn error(&mut self, rung: u32) -> f64 {
        let begin = Instant::now();
        let solved = self.peer.solve(self.case, tolerance_of(rung));
        self.last = begin.elapsed().as_secs_f64();
        let complete = solved
            .ok()
            .filter(|(solution, _)| solution.samples.len() + 1 >= SAMPLES);
        let entry = complete.map_or((f64::INFINITY, None), |(solution, _)| {
            (self.case.error(&solution.samples), solution.switches)
        });
        self.done.insert(rung, entry);
        entry.0
    }

    /// The loosest rung for each target, and why the rest is missing.
    fn climb(&mut self, targets: &[f64], longest: f64) -> (Vec<Option<u32>>, Miss) {
        let mut found = vec![None; targets.len()];
        let mut miss = Miss::NoTolerance;
        for rung in (RUNGS[0]..=RUNGS[1]).step_by(2) {
            let error = self.error(rung);
            let last = self.last;
            for (target, found) in targets.iter().zip(&mut found) {
                if found.is_some() || error > *target {
                    continue;
                }
                let looser = rung - 1;
                let known = self.done.get(&looser).map(|entry| entry.0);
                let reached =
                    rung > RUNGS[0] && known.unwrap_or_else(|| self.error(looser)) <= *target;
                *found = Some(if reached { looser } else { rung });
            }
            if last > longest {
                miss = Miss::TooLong(last);
            }
            if found.iter().all(Option::is_some) || last > longest {
                break;
            }
        }
        (found, miss)
    }
}

fn tolerance_of(rung: u32) -> f64 {
    10f64.powf(-0.5 * f64::from(rung))
}

/// Climbs to smaller tolerances until the last target is reached, by whole
/// decades; where a target is reached the half decade before is tried too.
/// `targets` are errors in falling order.
pub(crate) fn climb(peer: &Peer, case: &Case, targets: &[f64], limits: Climb) -> Vec<Reached> {
    let mut tries = Tries {
        peer,
        case,
        done: BTreeMap::new(),
        last: 0.0,
    };
    let (rungs, miss) = tries.climb(targets, limits.longest);
    let mut points: BTreeMap<u32, Reached> = BTreeMap::new();
    for rung in rungs.iter().flatten() {
        points.entry(*rung).or_insert_with(|| {
            let (error, switches) = tries.done[rung];
            let tolerance = tolerance_of(*rung);
            let timing = peer.time(case, tolerance, limits.budget);
            Ok(Point {
                tolerance,
                error,
                switches,
                timing: timing.ok_or(miss)?,
            })
        });
    }
    let point = |rung: &Option<u32>| rung.map_or(Err(miss), |rung| points[&rung]);
    rungs.iter().map(point).collect()
}
