//! The least model that gives the figures asked for within their accuracy.

use super::asked::{Asked, asked, no_limit};
use super::certificate::{Certainty, Certificate};
use super::judge::{Judge, value};
use super::row::{Course, Families, Family, Row, coarsened};
use super::trial::{Trials, with};
use crate::dynamics::builder::spec::Level;
use crate::fault::Fault;
use crate::frontend::lower::lower;
use crate::frontend::scene::{Levels, TypedScene};
use crate::studies::{Control, RunSettings};

/// Looking for a lesser model may take so many times the dearest run.
const MOST_COST: f64 = 3.0;
/// Evaluations of a coordinate that cost next to nothing: some 10 ms.
const FREE_COST: f64 = 1e5;

/// The levels chosen, and what the figures are worth.
#[derive(Clone, Debug, PartialEq)]
pub struct Chosen {
    /// The level of every object that leaves it open.
    pub levels: Levels,
    /// Figures with their errors, objects with their levels.
    pub certificate: Certificate,
}

/// Chooses the levels of all objects that leave theirs open, and judges the figures that are
/// asked for. The scene is left with the levels chosen. `settings`: those of the run.
///
/// # Errors
/// The model cannot be built or started.
pub fn choose(
    scene: &mut TypedScene,
    settings: &RunSettings,
    control: &Control<'_>,
) -> Result<Chosen, Vec<Fault>> {
    let mut trials = Trials::new(scene, settings, control);
    let mut families = families(&trials);
    let mut asked_for = Vec::new();
    let row = Row::walk(&mut trials, &mut families, |trials, row| {
        if asked_for.is_empty() {
            let first = &trials.made[row.runs[0]].figures;
            asked_for = asked(trials.scene, &trials.elastic, first);
        }
        enough(trials, row, &asked_for)
    })?;
    if row.runs.is_empty() {
        // The first run ended early, or is in doubt: nothing can be told from it.
        let base = trials.at(&base(&families))?;
        let found = &trials.made[base].figures;
        asked_for = asked(trials.scene, &trials.elastic, found);
    }
    let courses = asked_for.iter().map(|one| row.course(&trials, one));
    let courses: Vec<Course> = courses.collect();
    let judge = Judge {
        asked: &asked_for,
        courses: &courses,
    };
    let found = least(&mut trials, &families, &row, &judge)?;
    let levels = trials.made[found].levels.clone();
    let mut certificate = judge.certificate(&trials, &families, found);
    let open: Vec<String> = trials.elastic.open().cloned().collect();
    trials.elastic.clone().set(trials.scene, &levels);
    tell_no_limit(&trials, found, &mut certificate)?;
    let levels = levels.into_iter().filter(|(id, _)| open.contains(id));
    Ok(Chosen {
        levels: levels.collect(),
        certificate,
    })
}

/// Says of the model that was chosen why figures have no limit.
fn tell_no_limit(
    trials: &Trials<'_>,
    chosen: usize,
    certificate: &mut Certificate,
) -> Result<(), Vec<Fault>> {
    let model = lower(trials.scene)?;
    let figures = &trials.made[chosen].figures;
    for (figure, found) in &mut certificate.accuracy {
        if found.kind == Certainty::NoLimit {
            found.why = no_limit(trials.scene, &model, figure, figures).or(found.why.take());
        }
    }
    Ok(())
}

/// The levels that each elastic object goes through.
pub(super) fn families(trials: &Trials<'_>) -> Families {
    let family = |id: &String, given: Option<Level>| match given {
        Some(level) => Family::Given(level),
        None if trials.may_be_reduced(id) => Family::Modes,
        None => Family::Ends,
    };
    let objects = trials.elastic.objects.iter();
    objects
        .map(|(id, (_, given))| (id.clone(), family(id, *given)))
        .collect()
}

/// True when every figure that has a limit is known as well as it is asked to be; where
/// there is nothing to choose, when every one has settled.
fn enough(trials: &Trials<'_>, row: &Row, asked: &[Asked]) -> bool {
    let choice = trials.elastic.open().next().is_some();
    let last = row.runs[row.runs.len() - 1];
    asked.iter().all(|one| match row.course(trials, one) {
        Course::NoLimit(_) | Course::Counts(_) => true,
        Course::Open(_) => false,
        Course::Limit(found) => {
            let bound = one.accuracy.bound(found.limit);
            let off = (value(&trials.made[last], one) - found.limit).abs();
            !choice || off + found.error <= bound
        }
    })
}

/// The trial with the least coordinates that is accurate enough; the finest one if none is.
fn least(
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
    let Some(mut found) = found else {
        return trials.at(&base(families));
    };
    if !judge.accepts(trials, found) {
        return Ok(found);
    }
    let ids: Vec<String> = trials.elastic.open().cloned().collect();
    for id in ids {
        for level in lesser(trials, families[&id], &id, trials.made[found].levels[&id]) {
            if spent(trials) {
                return Ok(found);
            }
            let levels = with(&trials.made[found].levels, &id, level);
            // A level that the object cannot have has faults.
            if let Ok(made) = trials.at(&levels)
                && judge.accepts(trials, made)
            {
                found = made;
                break;
            }
        }
    }
    Ok(found)
}

/// The levels of a run with those that the scene gives as it gives them.
fn as_given(levels: &Levels, families: &Families) -> Levels {
    let level = |(id, level): (&String, &Level)| match families[id] {
        Family::Given(given) => (id.clone(), given),
        _ => (id.clone(), *level),
    };
    levels.iter().map(level).collect()
}

/// The level of two that models more of an object.
pub fn finer(one: Level, other: Level) -> Level {
    let rank = |level: Level| {
        let family = match level {
            Level::Rigid => 0,
            Level::Static => 1,
            Level::Modes { .. } => 2,
            // Modes hold for a pair that stays closed alone.
            Level::Masses { .. } => 3,
        };
        (family, level.coordinates())
    };
    match rank(other) > rank(one) {
        true => other,
        false => one,
    }
}

/// The levels of an object below one, from the least.
fn lesser(trials: &Trials<'_>, family: Family, id: &str, than: Level) -> Vec<Level> {
    let mut levels = Vec::new();
    if than != Level::Rigid && trials.may_be_rigid(id) {
        levels.push(Level::Rigid);
    }
    if than.coordinates() > 0 && trials.may_be_reduced(id) && family == Family::Modes {
        levels.push(Level::Static);
    }
    let counts = (0..).map(|power| 1 << power);
    let counts = counts.take_while(|&count| count < than.coordinates());
    levels.extend(counts.map(|count| coarsened(than, count)));
    levels
}

/// True when looking for a lesser model has taken as long as it may.
fn spent(trials: &Trials<'_>) -> bool {
    let costs = || trials.made.iter().map(|trial| trial.cost);
    let dearest = costs().fold(0.0, f64::max);
    costs().sum::<f64>() > MOST_COST * dearest + FREE_COST
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
            Self::Ends => Level::Masses {
                count: 1,
                lumping: Default::default(),
            },
        }
    }
}
