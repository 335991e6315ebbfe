//! The loosest tolerance that reaches an error, and the time it takes there.
//!
//! Tolerances are tried by whole decades; where a target is reached the half
//! decade before is tried too.

use crate::case::SAMPLES;
use crate::solution::{Solution, Timing};
use std::collections::BTreeMap;
use std::time::{Duration, Instant};

/// A solver with one of its methods, on one problem.
pub(crate) trait Runner {
    /// One run, and its time (s).
    ///
    /// # Errors
    /// What the solver says.
    fn solve(&self, tolerance: f64) -> Result<(Solution, f64), String>;

    /// Greatest error of δ over the samples, relative to max|δ|.
    fn error(&self, samples: &[f64]) -> f64;

    /// Repeated runs; `None`: they fail.
    fn time(&self, tolerance: f64, budget: Duration) -> Option<Timing> {
        Some(Timing::measure(budget, || self.solve(tolerance).is_ok()))
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
const RUNGS: [u32; 2] = [4, 25];

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
    runner: &'a dyn Runner,
    done: BTreeMap<u32, (f64, Option<usize>)>,
    /// Duration of the last one (s).
    last: f64,
}

impl Tries<'_> {
    /// The error at a rung; infinite when the solver fails.
    fn error(&mut self, rung: u32) -> f64 {
        let begin = Instant::now();
        let solved = self.runner.solve(tolerance_of(rung));
        self.last = begin.elapsed().as_secs_f64();
        let complete = solved
            .ok()
            .filter(|(solution, _)| solution.samples.len() + 1 >= SAMPLES);
        let entry = complete.map_or((f64::INFINITY, None), |(solution, _)| {
            (self.runner.error(&solution.samples), solution.switches)
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

/// Climbs to smaller tolerances until the last target is reached. `targets` are
/// errors in falling order.
pub(crate) fn climb(runner: &dyn Runner, targets: &[f64], limits: Climb) -> Vec<Reached> {
    let mut tries = Tries {
        runner,
        done: BTreeMap::new(),
        last: 0.0,
    };
    let (rungs, miss) = tries.climb(targets, limits.longest);
    let mut points: BTreeMap<u32, Reached> = BTreeMap::new();
    for rung in rungs.iter().flatten() {
        points.entry(*rung).or_insert_with(|| {
            let (error, switches) = tries.done[rung];
            let tolerance = tolerance_of(*rung);
            let timing = runner.time(tolerance, limits.budget);
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
