//! The least model that gives the figures asked for within their accuracy.

use super::asked::{Asked, asked, is_count};
use super::certificate::{
    Certainty, Certificate, Cheaper, FigureAccuracy, ObjectModel, Shares, Tried,
};
use super::row::{Course, Families, Family, Row, coarsened};
use super::trial::{Trial, Trials, coordinates, with};
use crate::dynamics::builder::spec::Level;
use crate::fault::Fault;
use crate::frontend::scene::{Levels, TypedScene};
use crate::math::order::Total;
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
    let courses: Vec<Course> = asked_for
        .iter()
        .map(|one| row.course(&trials, one))
        .collect();
    let judge = Judge {
        asked: &asked_for,
        courses: &courses,
    };
    let found = least(&mut trials, &families, &row, &judge)?;
    let levels = trials.made[found].levels.clone();
    let certificate = judge.certificate(&trials, &families, found);
    let open: Vec<String> = trials.elastic.open().cloned().collect();
    trials.elastic.clone().set(trials.scene, &levels);
    let levels = levels.into_iter().filter(|(id, _)| open.contains(id));
    Ok(Chosen {
        levels: levels.collect(),
        certificate,
    })
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

fn value(trial: &Trial, asked: &Asked) -> f64 {
    trial.figures.value(&asked.figure).unwrap_or(f64::NAN)
}

/// The figures asked for, with what they do along the row.
struct Judge<'j> {
    asked: &'j [Asked],
    courses: &'j [Course],
}

impl Judge<'_> {
    /// Error of a figure by a trial; `None`: it has none.
    fn error(trial: &Trial, asked: &Asked, course: &Course) -> Option<f64> {
        let value = value(trial, asked);
        match course {
            Course::Limit(found) => Some((value - found.limit).abs() + found.error),
            Course::Counts(count) => Some((value - count).abs()),
            Course::NoLimit(_) | Course::Open(_) => None,
        }
    }

    /// The figure that rules a trial out, with its error; `None`: all are within their
    /// accuracy.
    fn ruled_out(&self, trial: &Trial) -> Option<(&Asked, f64)> {
        let excess = |(asked, course): (&'_ Asked, &Course)| {
            let error = Self::error(trial, asked, course)?;
            let bound = match course {
                Course::Limit(found) => asked.accuracy.bound(found.limit),
                _ => 0.0,
            };
            // Written so that a number that is none is ruled out.
            let beyond = if error <= bound {
                None
            } else {
                Some(error / bound)
            };
            Some((beyond?, error))
        };
        let all = self.asked.iter().zip(self.courses);
        let beyond = all.filter_map(|(asked, course)| Some((asked, excess((asked, course))?)));
        let worst = beyond.max_by_key(|(_, (share, _))| Total(*share));
        worst.map(|(asked, (_, error))| (asked, error))
    }

    fn accepts(&self, trials: &Trials<'_>, made: usize) -> bool {
        let trial = &trials.made[made];
        let closed = |(id, level): (&String, &Level)| {
            matches!(level, Level::Masses { .. }) || !trials.would_open(made, id)
        };
        trial.doubt.is_none() && trial.levels.iter().all(closed) && self.ruled_out(trial).is_none()
    }
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
    // A row without runs: the first model ended early, or is in doubt.
    let Some(mut found) = found else {
        let base = families
            .iter()
            .map(|(id, family)| (id.clone(), family.base()));
        return trials.at(&base.collect());
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

impl Judge<'_> {
    fn certificate(&self, trials: &Trials<'_>, families: &Families, found: usize) -> Certificate {
        let chosen = &trials.made[found];
        let figures = self.asked.iter().zip(self.courses);
        let figures = figures
            .map(|(asked, course)| (asked.figure.clone(), figure_accuracy(chosen, asked, course)));
        let models = families.iter().map(|(id, family)| {
            let model = self.object_model(trials, (id, *family), chosen);
            (id.clone(), model)
        });
        let mut tried: Vec<Tried> = (trials.made.iter().enumerate())
            .filter(|(made, trial)| trial.doubt.is_none() || *made == found)
            .map(|(made, trial)| self.tried(trial, made == found))
            .collect();
        tried.sort_by_key(|one| one.coordinates);
        Certificate {
            accuracy: figures.collect(),
            models: models.collect(),
            tried,
        }
    }

    fn tried(&self, trial: &Trial, chosen: bool) -> Tried {
        let value = |asked: &Asked| {
            let value = trial.figures.value(&asked.figure).ok();
            (asked.figure.clone(), value)
        };
        Tried {
            levels: trial.levels.clone(),
            coordinates: coordinates(&trial.levels),
            values: self.asked.iter().map(value).collect(),
            chosen,
        }
    }

    fn object_model(
        &self,
        trials: &Trials<'_>,
        (id, family): (&String, Family),
        chosen: &Trial,
    ) -> ObjectModel {
        let level = chosen.levels[id];
        let next_cheaper = match family.is_open() {
            true => self.next_cheaper(trials, id, chosen),
            false => None,
        };
        let why = match (family.is_open(), &next_cheaper) {
            (false, _) => "the scene gives it".to_owned(),
            (true, Some(less)) => format!("with less {} is not accurate enough", less.figure),
            (true, None) => "the least there is".to_owned(),
        };
        ObjectModel {
            level,
            coordinates: level.coordinates(),
            chosen: family.is_open(),
            why,
            next_cheaper,
        }
    }

    /// The dearest trial that differs from the one chosen in having less of this object,
    /// with what ruled it out.
    fn next_cheaper(&self, trials: &Trials<'_>, id: &str, chosen: &Trial) -> Option<Cheaper> {
        let rank = |level: Level| (level.coordinates(), level != Level::Rigid);
        let own = rank(chosen.levels[id]);
        let less = trials.made.iter().filter(|trial| {
            let others = trial
                .levels
                .iter()
                .all(|(other, level)| other == id || *level == chosen.levels[other]);
            others && rank(trial.levels[id]) < own
        });
        let next = less.max_by_key(|trial| rank(trial.levels[id]))?;
        let (asked, error) = self.ruled_out(next)?;
        Some(Cheaper {
            level: next.levels[id],
            figure: asked.figure.clone(),
            error,
        })
    }
}

fn figure_accuracy(chosen: &Trial, asked: &Asked, course: &Course) -> FigureAccuracy {
    let value = value(chosen, asked);
    let integration = match is_count(&asked.figure) {
        true => 0.0,
        false => chosen.integration * chosen.figures.scale(&asked.figure),
    };
    let model = Judge::error(chosen, asked, course);
    let error = model.map(|model| model + integration);
    let (kind, limit, why) = match course {
        Course::Limit(found) => (Certainty::Estimate, Some(found.limit), None),
        Course::Counts(count) => (Certainty::Estimate, Some(*count), None),
        Course::NoLimit(why) => (Certainty::NoLimit, None, Some(why.clone())),
        Course::Open(scatter) => (Certainty::NotDetermined, None, Some(undetermined(*scatter))),
    };
    let bound = match course {
        Course::Counts(_) => 0.0,
        _ => asked.accuracy.bound(limit.unwrap_or(value)),
    };
    FigureAccuracy {
        value,
        unit: chosen.figures.unit(&asked.figure),
        error,
        relative: error
            .map(|error| error / value.abs())
            .filter(|share| share.is_finite()),
        asked: bound,
        holds: error.is_some_and(|error| error <= bound),
        kind,
        shares: model.map(|model| Shares {
            model,
            integration,
            spread: None,
        }),
        limit,
        why,
    }
}

fn undetermined(scatter: f64) -> String {
    match scatter.is_finite() {
        true => format!(
            "it does not settle as the model is refined: the last models lie {} apart",
            crate::units::shown(scatter, 3)
        ),
        false => "the model cannot be refined".to_owned(),
    }
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
