//! Lesser levels of single objects, tried one after the other.

use super::judge::Judge;
use super::row::{Families, Family, coarsened};
use super::trial::{Trials, with_level};
use crate::dynamics::builder::spec::Level;

/// A lesser level of one object, tried.
#[derive(Clone, Debug)]
pub(in crate::studies) struct LevelReduction {
    pub(in crate::studies) id: String,
    /// The trial before, and that with the lesser level.
    pub(in crate::studies) trials: [usize; 2],
    /// True when it is accurate enough.
    pub(in crate::studies) accepted: bool,
}

/// The trial with the least level of every open object that is accurate enough, from one
/// that is, object by object. `go_on` hears of each level tried, and ends the search.
pub(in crate::studies) fn lessened(
    trials: &mut Trials<'_>,
    families: &Families,
    judge: &Judge<'_>,
    mut found: usize,
    mut go_on: impl FnMut(&Trials<'_>, Option<LevelReduction>) -> bool,
) -> usize {
    let ids: Vec<String> = trials.elastic.open_levels().cloned().collect();
    for id in ids {
        for level in lower_levels(trials, families[&id], &id, trials.made[found].levels[&id]) {
            if !go_on(trials, None) {
                return found;
            }
            let levels = with_level(&trials.made[found].levels, &id, level);
            // A level that the object cannot have has faults.
            let Ok(made) = trials.at(&levels) else {
                continue;
            };
            let accepted = judge.accepts(trials, made);
            let tried = LevelReduction {
                id: id.clone(),
                trials: [found, made],
                accepted,
            };
            let last = !go_on(trials, Some(tried));
            if accepted {
                found = made;
            }
            if last {
                return found;
            }
            if accepted {
                break;
            }
        }
    }
    found
}

/// The levels of an object below one, from the least.
fn lower_levels(trials: &Trials<'_>, family: Family, id: &str, than: Level) -> Vec<Level> {
    let mut levels = Vec::new();
    if than != Level::Rigid && trials.may_be_rigid(id) {
        levels.push(Level::Rigid);
    }
    if than.coordinates() > 0 && trials.may_be_static(id) && family == Family::Modes {
        levels.push(Level::Static);
    }
    let counts = (0..).map(|power| 1 << power);
    let counts = counts.take_while(|&count| count < than.coordinates());
    levels.extend(counts.map(|count| coarsened(than, count)));
    let free = trials.has_contact(id);
    let masses = matches!(than, Level::Masses { .. });
    if masses && trials.may_be_reduced(id) && (free || family == Family::Modes) {
        // Modes of an object that is held need a pair that has been found to stay closed.
        let counts = (0..).map(|power| 1 << power);
        let modes = counts.map(|count| Level::Modes { count });
        levels.extend(
            modes.take_while(|&level| count_of_coordinates(level, free) <= than.coordinates()),
        );
    }
    levels.sort_by_key(|&level| count_of_coordinates(level, free));
    levels
}

/// Coordinates of an object at a level, those that its modes bring along behind a contact
/// element included: the rigid body, and what the output gives way by.
fn count_of_coordinates(level: Level, free: bool) -> usize {
    let more = match level {
        Level::Modes { .. } if free => 2,
        _ => 0,
    };
    level.coordinates() + more
}
