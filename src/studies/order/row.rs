//! The row of runs from which the limit of the model is told: the coordinates of all elastic
//! objects doubled from run to run.

use super::bound::of_figure;
use super::requested_figures::{RequestedFigure, is_count, no_limit};
use super::settling::{SettledRow, scatter, settled_row};
use super::trial::{Trials, coordinates};
use crate::dynamics::builder::spec::{Level, Lumping};
use crate::fault::Fault;
use crate::frontend::scene::Levels;
use std::collections::BTreeMap;

/// Most coordinates of all objects in one run.
const MOST_COORDINATES: usize = 512;
/// A bound is small beside the error asked for when it is no more than this share of it.
const SMALL: f64 = 0.25;
/// Most runs in a row.
const MOST_RUNS: usize = 12;

/// The levels that an object goes through.
#[derive(Clone, Copy, Debug, PartialEq)]
pub(in crate::studies) enum Family {
    /// Vibration modes: of an object whose level is open, as long as its pair stays closed.
    Modes,
    /// Masses: of an object whose level is open.
    Masses(Lumping),
    /// The level that the scene gives, and its refinements.
    Given(Level),
}

impl Family {
    /// The level with so many coordinates, or so many times those of the scene.
    fn level(self, times: usize) -> Level {
        match self {
            Self::Modes => Level::Modes { count: times },
            Self::Masses(lumping) => Level::Masses {
                count: times,
                lumping,
            },
            Self::Given(level) => level
                .refined(times)
                .unwrap_or(Level::Modes { count: times }),
        }
    }

    /// That of an object whose level is open: modes as long as its pair stays closed. What
    /// strikes is told by masses: modes make the force too great where the contact is stiff.
    pub(super) fn of(trials: &Trials<'_>, id: &str) -> Self {
        match trials.may_be_reduced(id) && !trials.is_form_closed(id) {
            true => Self::Modes,
            false => Self::Masses(trials.lumping(id)),
        }
    }

    pub(in crate::studies) fn is_open(self) -> bool {
        !matches!(self, Self::Given(_))
    }
}

/// The families of all elastic objects.
pub(in crate::studies) type Families = BTreeMap<String, Family>;

/// What a figure does along the row.
#[derive(Clone, Debug, PartialEq)]
pub(in crate::studies) enum Course {
    /// It has a limit, as its settling shows.
    Limit(SettledRow),
    /// It has a limit, and what separates the finest model from it is bounded.
    Bounded(SettledRow),
    /// It counts, and the last runs count the same.
    Counts(f64),
    /// It has no limit, for a reason.
    NoLimit(String),
    /// It has not settled (yet); how far the last values lie apart.
    Open(f64),
}

/// Runs at levels that are refined together.
pub(in crate::studies) struct Row {
    /// Numbers of the trials.
    pub(in crate::studies) runs: Vec<usize>,
}

impl Row {
    /// Refines until `enough` says so, or the most coordinates are reached. Objects whose
    /// pair turns out to open, or to strike on a contact element, are given masses in place of
    /// modes.
    ///
    /// # Errors
    /// Faults of the first model; later ones end the row.
    pub(in crate::studies) fn refine_until_enough(
        trials: &mut Trials<'_>,
        families: &mut Families,
        mut enough: impl FnMut(&mut Trials<'_>, &Row) -> bool,
    ) -> Result<Self, Vec<Fault>> {
        let mut row = Self { runs: Vec::new() };
        while row.runs.len() < MOST_RUNS {
            let levels = levels_at(families, row.runs.len());
            if coordinates(&levels) > MOST_COORDINATES && !row.runs.is_empty() {
                break;
            }
            let made = match trials.at(&levels) {
                Ok(made) => made,
                Err(faults) if row.runs.is_empty() => return Err(faults),
                Err(_) => break,
            };
            if open_pairs(trials, families, made) {
                row.runs.clear();
                continue;
            }
            if trials.made[made].doubt.is_some() {
                break;
            }
            row.runs.push(made);
            if enough(trials, &row) {
                break;
            }
        }
        Ok(row)
    }

    /// What a figure does along the row.
    pub(in crate::studies) fn course_of_figure(
        &self,
        trials: &Trials<'_>,
        asked: &RequestedFigure,
    ) -> Course {
        let figure = asked.figure.as_str();
        let runs = || self.runs.iter().map(|&run| &trials.made[run]);
        let Some(last) = runs().next_back() else {
            return Course::Open(f64::NAN);
        };
        let why =
            (trials.model()).and_then(|model| no_limit(trials.scene, model, figure, &last.figures));
        if let Some(why) = why {
            return Course::NoLimit(why);
        }
        let value = |of: &super::trial::Trial| of.figures.value(figure).unwrap_or(f64::NAN);
        let values: Vec<f64> = runs().map(value).collect();
        let open = Course::Open(scatter(&values));
        if is_count(figure) {
            return match values[..] {
                [.., a, b, c] if a == c && b == c => Course::Counts(c),
                _ => open,
            };
        }
        let bounded = |error: f64| SettledRow {
            limit: value(last),
            error,
            order: None,
        };
        let bounded = of_figure(&last.left_out, figure).map(bounded);
        if let Some(found) = bounded.filter(|found| self.serves(trials, asked, found)) {
            return Course::Bounded(found);
        }
        let noise = 2.0 * last.integration * last.scale_of_figure(figure);
        match self
            .has_same_separations(trials)
            .then(|| settled_row(&values, noise))
        {
            Some(Some(settled)) => Course::Limit(settled),
            _ => bounded.map_or(open, Course::Bounded),
        }
    }

    /// True when a bound is small beside the error that is asked for, or lets a model with
    /// fewer coordinates pass.
    pub(super) fn serves(
        &self,
        trials: &Trials<'_>,
        asked: &RequestedFigure,
        found: &SettledRow,
    ) -> bool {
        let bound = asked.accuracy.bound(found.limit);
        let passes = |&run: &usize| {
            let value = trials.made[run].figures.value(&asked.figure);
            value.is_ok_and(|value| (value - found.limit).abs() + found.error <= bound)
        };
        let before = self.runs.split_last().map_or(&[][..], |(_, before)| before);
        found.error <= SMALL * bound || before.iter().any(passes)
    }

    /// True when the pairs opened as often in the last run as in the one before.
    fn has_same_separations(&self, trials: &Trials<'_>) -> bool {
        let story = |run: &usize| -> Vec<Option<u64>> {
            let objects = trials.made[*run].figures.objects.values();
            objects
                .map(|object| object.pair.as_ref().map(|pair| pair.separations))
                .filter(|separations| separations.is_some())
                .collect()
        };
        match &self.runs[..] {
            [.., before, last] => story(before) == story(last),
            _ => false,
        }
    }
}

/// Levels of run number `place` of a row. Of modes alone the row begins with rigid objects;
/// of given levels, as far below them as they can be halved, up to twice.
fn levels_at(families: &Families, place: usize) -> Levels {
    let only_modes = families.values().all(|family| *family == Family::Modes);
    let halvings = halvings(families);
    let level = |family: &Family| match (family, place) {
        (Family::Modes, 0) if only_modes => Level::Rigid,
        (Family::Modes, _) if only_modes => family.level(1 << (place - 1)),
        (Family::Given(level), place) => match (level.coordinates(), place) {
            (0, 0) => *level,
            (0, _) => family.level(1 << (place - 1)),
            (count, _) => coarsened(*level, count >> halvings)
                .refined(1 << place)
                .unwrap_or(*level),
        },
        _ => family.level(1 << place),
    };
    let one = |(id, family): (&String, &Family)| (id.clone(), level(family));
    families.iter().map(one).collect()
}

/// How often the numbers of all given levels can be halved, at most twice.
fn halvings(families: &Families) -> u32 {
    let given = families.values().filter_map(|family| match family {
        Family::Given(level) if level.coordinates() > 0 => {
            Some(level.coordinates().trailing_zeros())
        }
        _ => None,
    });
    given.min().unwrap_or(0).min(2)
}

/// A level with another number of coordinates.
pub(in crate::studies) fn coarsened(level: Level, count: usize) -> Level {
    match level {
        Level::Modes { .. } => Level::Modes { count },
        Level::Masses { lumping, .. } => Level::Masses { count, lumping },
        other => other,
    }
}

/// Gives masses to objects of modes whose pair would open, or opened; true if there were any.
fn open_pairs(trials: &Trials<'_>, families: &mut Families, made: usize) -> bool {
    let mut opened = false;
    for (id, family) in families.iter_mut() {
        let has_modes = matches!(trials.made[made].levels[id], Level::Modes { .. });
        let opens = || trials.would_open(made, id) || trials.switched(made, id);
        if *family == Family::Modes && has_modes && opens() {
            *family = Family::Masses(trials.lumping(id));
            opened = true;
        }
    }
    opened
}

#[cfg(test)]
mod tests {
    use super::{Families, Family, Level, Lumping, levels_at};

    fn families(all: &[Family]) -> Families {
        let named = all.iter().enumerate();
        named
            .map(|(at, family)| (at.to_string(), *family))
            .collect()
    }

    fn counts(families: &Families, places: std::ops::Range<usize>) -> Vec<Vec<usize>> {
        places
            .map(|place| {
                levels_at(families, place)
                    .values()
                    .map(|l| l.coordinates())
                    .collect()
            })
            .collect()
    }

    #[test]
    fn coordinates_are_doubled_from_run_to_run() {
        let lumping = Lumping::Balanced;
        let given = |count| Family::Given(Level::Masses { count, lumping });
        let modes = families(&[Family::Modes, Family::Modes]);
        assert_eq!(counts(&modes, 0..4), [[0, 0], [1, 1], [2, 2], [4, 4]]);
        let mixed = families(&[Family::Modes, Family::Masses(Lumping::Ends)]);
        assert_eq!(counts(&mixed, 0..3), [[1, 1], [2, 2], [4, 4]]);
        // Halved where that is possible, in common.
        assert_eq!(
            counts(&families(&[given(12)]), 0..4),
            [[3], [6], [12], [24]]
        );
        assert_eq!(counts(&families(&[given(5)]), 0..3), [[5], [10], [20]]);
        let both = families(&[given(4), given(6)]);
        assert_eq!(counts(&both, 0..3), [[2, 3], [4, 6], [8, 12]]);
        let flexible = families(&[Family::Given(Level::Static)]);
        assert_eq!(counts(&flexible, 0..4), [[0], [1], [2], [4]]);
        assert_eq!(levels_at(&flexible, 0)["0"], Level::Static);
    }
}
