//! What is known of the figures that a scene asks for, by refining its models.

use super::bound::of_figure;
use super::judge::{Judge, value};
use super::requested_figures::{RequestedFigure, requested_figures};
use super::row::{Course, Families, Family, Row};
use super::settling::SettledRow;
use super::trial::{Trial, Trials, coordinates};
use crate::dynamics::builder::spec::Level;
use crate::fault::Fault;
use crate::frontend::scene::Levels;

/// Models are refined for the sake of a bound up to so many times the coordinates that are
/// needed.
const FINER: usize = 4;

/// The figures asked for, with the row of runs that tells where they lead.
pub(in crate::studies) struct FigureLimits {
    pub(in crate::studies) row: Row,
    pub(in crate::studies) asked: Vec<RequestedFigure>,
    pub(in crate::studies) courses: Vec<Course>,
}

impl FigureLimits {
    /// Refines until it is known as well as it is asked to be.
    ///
    /// # Errors
    /// The model cannot be built or started.
    pub(in crate::studies) fn of(
        trials: &mut Trials<'_>,
        families: &mut Families,
    ) -> Result<Self, Vec<Fault>> {
        let mut asked_for = Vec::new();
        let row = Row::refine_until_enough(trials, families, |trials, row| {
            if asked_for.is_empty() {
                let first = &trials.made[row.runs[0]].figures;
                asked_for = requested_figures(trials.scene, &trials.elastic, first);
            }
            limits_are_known(trials, row, &asked_for)
        })?;
        if row.runs.is_empty() {
            // The first run ended early, or is in doubt: nothing can be told from it.
            let base = trials.at(&base(families))?;
            let found = &trials.made[base].figures;
            asked_for = requested_figures(trials.scene, &trials.elastic, found);
        }
        let courses = asked_for
            .iter()
            .map(|one| row.course_of_figure(trials, one));
        Ok(Self {
            courses: courses.collect(),
            row,
            asked: asked_for,
        })
    }

    pub(in crate::studies) fn judge(&self) -> Judge<'_> {
        Judge {
            asked: &self.asked,
            courses: &self.courses,
        }
    }
}

/// The first trial of a row that is accurate enough; the finest one if none is.
///
/// # Errors
/// No model can be built or started.
pub(in crate::studies) fn first_accurate_trial(
    trials: &mut Trials<'_>,
    families: &Families,
    row: &Row,
    judge: &Judge<'_>,
) -> Result<usize, Vec<Fault>> {
    let mut found = None;
    for &run in &row.runs {
        let levels = as_given(&trials.made[run].levels, families);
        let Ok(made) = trials.at(&levels) else {
            continue;
        };
        found = Some(made);
        if judge.accepts(trials, made) {
            break;
        }
    }
    match found {
        Some(found) => Ok(found),
        None => trials.at(&base(families)),
    }
}

/// True when every figure that has a limit is known as well as it is asked to be; where
/// there is nothing to choose, when every one has settled.
fn limits_are_known(trials: &Trials<'_>, row: &Row, asked: &[RequestedFigure]) -> bool {
    let choice = trials.elastic.open_levels().next().is_some();
    let last = row.runs[row.runs.len() - 1];
    asked
        .iter()
        .all(|one| match row.course_of_figure(trials, one) {
            Course::NoLimit(_) | Course::Counts(_) => true,
            Course::Open(_) => false,
            Course::Bounded(found) => row.serves(trials, one, &found),
            Course::Limit(found) => {
                let bound = one.accuracy.bound(found.limit);
                let off = (value(&trials.made[last], one) - found.limit).abs();
                let known = !choice || off + found.error <= bound;
                known && !may_be_bounded(trials, row, one, &found)
            }
        })
}

/// True when a bound is to be had, and so much finer models than are needed have not been
/// run yet that it may become a small one.
fn may_be_bounded(
    trials: &Trials<'_>,
    row: &Row,
    asked: &RequestedFigure,
    found: &SettledRow,
) -> bool {
    let runs = || row.runs.iter().map(|&run| &trials.made[run]);
    let bounded = |trial: &Trial| of_figure(&trial.left_out, &asked.figure).is_some();
    let bound = asked.accuracy.bound(found.limit);
    let within = |trial: &&Trial| (value(trial, asked) - found.limit).abs() + found.error <= bound;
    let needed = runs()
        .find(within)
        .map_or(1, |trial| coordinates(&trial.levels).max(1));
    let last = runs().next_back();
    last.is_some_and(|last| bounded(last) && coordinates(&last.levels) < FINER * needed)
}

/// The levels of a run with those that the scene gives as it gives them.
fn as_given(levels: &Levels, families: &Families) -> Levels {
    let level = |(id, level): (&String, &Level)| match families[id] {
        Family::Given(given) => (id.clone(), given),
        _ => (id.clone(), *level),
    };
    levels.iter().map(level).collect()
}

/// The levels where nothing can be judged.
fn base(families: &Families) -> Levels {
    let one = |(id, family): (&String, &Family)| (id.clone(), family.base());
    families.iter().map(one).collect()
}

impl Family {
    /// The level where nothing can be judged.
    fn base(self) -> Level {
        match self {
            Self::Given(level) => level,
            Self::Modes => Level::Modes { count: 1 },
            Self::Masses(lumping) => Level::Masses { count: 1, lumping },
        }
    }
}
