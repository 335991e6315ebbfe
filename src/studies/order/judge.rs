//! How accurate the figures of a trial are, and what that says of its levels.

use super::certificate::{
    Certainty, Certificate, Cheaper, FigureAccuracy, ObjectModel, Shares, TriedModel,
};
use super::requested_figures::RequestedFigure;
use super::row::{Course, Families, Family};
use super::trial::{Trial, Trials, coordinates};
use crate::dynamics::builder::spec::Level;
use crate::frontend::scene::Accuracy;
use crate::math::order::Total;

pub(in crate::studies) fn value(trial: &Trial, asked: &RequestedFigure) -> f64 {
    trial.figures.value(&asked.figure).unwrap_or(f64::NAN)
}

/// The figures asked for, with what they do along the row.
pub(in crate::studies) struct Judge<'j> {
    pub(in crate::studies) asked: &'j [RequestedFigure],
    pub(in crate::studies) courses: &'j [Course],
}

impl Judge<'_> {
    /// Error of a figure by a trial; `None`: it has none.
    pub(in crate::studies) fn error(
        trial: &Trial,
        asked: &RequestedFigure,
        course: &Course,
    ) -> Option<f64> {
        let value = value(trial, asked);
        match course {
            Course::Limit(found) | Course::Bounded(found) => {
                Some((value - found.limit).abs() + found.error)
            }
            Course::Counts(count) => Some((value - count).abs()),
            Course::NoLimit(_) | Course::Open(_) => None,
        }
    }

    /// Greatest error that is asked for of a figure; `None`: nothing is known of where it
    /// leads.
    pub(in crate::studies) fn bound(asked: &RequestedFigure, course: &Course) -> Option<f64> {
        match course {
            Course::Limit(found) | Course::Bounded(found) => {
                Some(asked.accuracy.bound(found.limit))
            }
            Course::Counts(_) => Some(0.0),
            Course::NoLimit(_) | Course::Open(_) => None,
        }
    }

    /// True when there is a figure to judge a model by.
    pub(in crate::studies) fn decides(&self) -> bool {
        let mut all = self.asked.iter().zip(self.courses);
        all.any(|(asked, course)| Self::bound(asked, course).is_some())
    }

    /// The figure that rules a trial out, with its error; `None`: all are within their
    /// accuracy.
    fn ruled_out(&self, trial: &Trial) -> Option<(&RequestedFigure, f64)> {
        let excess = |(asked, course): (&'_ RequestedFigure, &Course)| {
            let error = Self::error(trial, asked, course)?;
            let bound = Self::bound(asked, course)?;
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

    /// True when a trial is accurate enough, and the pairs of reduced objects stay closed.
    pub(in crate::studies) fn accepts(&self, trials: &Trials<'_>, made: usize) -> bool {
        self.reason_against_trial(trials, made).is_none()
    }

    /// What stands against a trial; `None`: nothing.
    pub(in crate::studies) fn reason_against_trial(
        &self,
        trials: &Trials<'_>,
        made: usize,
    ) -> Option<Objection> {
        let trial = &trials.made[made];
        let figure = || {
            let (asked, error) = self.ruled_out(trial)?;
            let figure = asked.figure.clone();
            Some(Objection::Figure { figure, error })
        };
        self.meaningless(trials, made).or_else(figure)
    }

    /// Why a trial says nothing: it is not trusted, or a pair that it takes to stay closed
    /// would open.
    fn meaningless(&self, trials: &Trials<'_>, made: usize) -> Option<Objection> {
        let trial = &trials.made[made];
        if let Some(doubt) = &trial.doubt {
            return Some(Objection::Doubt(doubt.clone()));
        }
        let opens = |(id, level): &(&String, &Level)| {
            !matches!(level, Level::Masses { .. }) && trials.would_open(made, id)
        };
        let opened = trial.levels.iter().find(opens);
        opened.map(|(id, _)| Objection::Opens(id.clone()))
    }
}

/// Why a model is not accurate enough.
#[derive(Clone, Debug, PartialEq)]
pub(in crate::studies) enum Objection {
    /// Its run ended early, or is not trusted: for a reason.
    Doubt(String),
    /// The pair of this object is taken to stay closed, and would open.
    Opens(String),
    /// A figure is not accurate enough.
    Figure {
        /// Its address.
        figure: String,
        /// How far it may be off.
        error: f64,
    },
}

impl Judge<'_> {
    /// What is said of the trial that was chosen.
    pub(in crate::studies) fn certificate(
        &self,
        trials: &Trials<'_>,
        families: &Families,
        found: usize,
    ) -> Certificate {
        let chosen = &trials.made[found];
        let figures = self.asked.iter().zip(self.courses);
        let figures = figures
            .map(|(asked, course)| (asked.figure.clone(), figure_accuracy(chosen, asked, course)));
        let models = families.iter().map(|(id, family)| {
            let model = self.object_model(trials, (id, *family), chosen);
            (id.clone(), model)
        });
        let mut tried: Vec<TriedModel> = (trials.made.iter().enumerate())
            .filter(|(made, _)| self.meaningless(trials, *made).is_none() || *made == found)
            .map(|(made, trial)| self.tried_model(trial, made == found))
            .collect();
        tried.sort_by_key(|one| one.coordinates);
        Certificate {
            accuracy: figures.collect(),
            models: models.collect(),
            tried,
        }
    }

    fn tried_model(&self, trial: &Trial, chosen: bool) -> TriedModel {
        let value = |asked: &RequestedFigure| {
            let value = trial.figures.value(&asked.figure).ok();
            (asked.figure.clone(), value)
        };
        TriedModel {
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

/// A figure is resolved from so many errors of the integration on: those of the runs that it is
/// compared with count too.
const RESOLVED: f64 = 10.0;

fn figure_accuracy(chosen: &Trial, asked: &RequestedFigure, course: &Course) -> FigureAccuracy {
    let value = value(chosen, asked);
    let integration = chosen.integration_of(&asked.figure);
    let model = Judge::error(chosen, asked, course);
    let error = model.map(|model| model + integration);
    let (kind, limit, why) = match course {
        Course::Limit(found) => (Certainty::Estimate, Some(found.limit), None),
        Course::Bounded(found) => (Certainty::Bound, Some(found.limit), None),
        Course::Counts(count) => (Certainty::Estimate, Some(*count), None),
        Course::NoLimit(why) => (Certainty::NoLimit, None, Some(why.clone())),
        Course::Open(scatter) => (Certainty::NotDetermined, None, Some(undetermined(*scatter))),
    };
    let size = limit.unwrap_or(value);
    // No error is relative to zero, nor to what the run does not resolve.
    let resolution = RESOLVED * integration;
    let unresolved = size.abs() <= resolution;
    let (bound, why) = match (course, asked.accuracy) {
        (Course::Counts(_), _) => (0.0, why),
        (_, Accuracy::Share(_)) if unresolved && error.is_some() => (
            resolution,
            Some("zero within the resolution of the run".to_owned()),
        ),
        _ => (asked.accuracy.bound(size), why),
    };
    FigureAccuracy {
        value,
        unit: chosen.figures.unit(&asked.figure),
        error,
        relative: error
            .map(|error| error / value.abs())
            .filter(|share| share.is_finite() && !unresolved),
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
            "it does not settle as the model is refined: the last models differ by {}",
            crate::units::shown(scatter, 3)
        ),
        false => "the model cannot be refined".to_owned(),
    }
}
