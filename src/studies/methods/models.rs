//! The error of the model as a floor under the methods: nobody needs to integrate to nine
//! digits what is wrong by five per cent.
//!
//! The same errors as of `dam reduce` and of a run's accuracy are taken
//! ([`crate::studies::order`]).

use crate::fault::Fault;
use crate::frontend::scene::{Accuracy, AccuracySpec, Levels, TypedScene, in_words};
use crate::math::order::Total;
use crate::studies::order::choose::families;
use crate::studies::order::figure_limits::{FigureLimits, first_accurate_trial};
use crate::studies::order::judge::Judge;
use crate::studies::order::lessen::lessened;
use crate::studies::order::requested_figures::RequestedFigure;
use crate::studies::order::row::Course;
use crate::studies::order::trial::{Trial, Trials, coordinates};
use crate::studies::{Control, RunSettings};
use crate::units::shown;
use serde::Serialize;

/// A method needs to be no better than this share of the error of the model.
const SHARE_OF_MODEL: f64 = 0.1;
/// Errors of methods that are asked for at least and at most.
const ERRORS: (f64, f64) = (1e-12, 0.1);

/// The models of a scene, and the one that its methods are studied on.
#[derive(Clone, Debug, PartialEq, Serialize)]
pub struct Models {
    /// Error of max|δ| that is asked for, of the model, relative to it.
    pub asked: f64,
    /// The model that the methods are studied on: the level of every elastic object.
    pub levels: Levels,
    /// Error of that model: of max|δ|, relative to it, of the worst object; null where the
    /// figure has no limit or does not settle.
    pub error: Option<f64>,
    /// True when max|δ| is accurate enough without any coordinates of elastic objects.
    pub enough_without: bool,
    /// Every model that was run, by its coordinates.
    pub tried: Vec<ModelError>,
    /// Why there is no error; absent where there is one.
    #[serde(skip_serializing_if = "Option::is_none")]
    pub why: Option<String>,
}

/// A model with its error.
#[derive(Clone, Debug, PartialEq, Serialize)]
pub struct ModelError {
    /// The level of every elastic object.
    pub levels: Levels,
    /// Coordinates of all of them.
    pub coordinates: usize,
    /// Error of max|δ|, relative to it, of the worst object.
    pub error: f64,
    /// True for the scene as it was given.
    pub given: bool,
}

/// Finds the least model whose max|δ| of every elastic object is within a share, and the
/// errors of the others. The scene is left with that model.
///
/// # Errors
/// There is no elastic object to choose a model of; the model cannot be built or started.
pub fn models(
    scene: &mut TypedScene,
    settings: &RunSettings,
    asked: f64,
    control: &Control<'_>,
) -> Result<Models, Vec<Fault>> {
    let elastic = scene.elastic();
    if elastic.objects.is_empty() {
        return Err(vec![Fault::new(
            "objects",
            "no object is elastic and uniform: there are no models to choose between",
            "leave `--models` out, or give an object `inertia` and `stiffness`",
        )]);
    }
    let ids = elastic.objects.keys();
    let figures = ids.map(|id| (format!("{id}.delta_abs"), Accuracy::Share(asked)));
    scene.run.accuracy = Some(AccuracySpec::Figures(figures.collect()));
    let mut trials = Trials::all_open(scene, settings, control);
    let mut families = families(&trials);
    let known = FigureLimits::of(&mut trials, &mut families)?;
    let judge = known.judge();
    let first = first_accurate_trial(&mut trials, &families, &known.row, &judge)?;
    let mut found = first;
    if judge.accepts(&trials, first) {
        found = lessened(&mut trials, &families, &judge, first, |_, _| {
            !control.is_spent()
        });
    }
    let given = elastic.objects.iter();
    let given: Levels = given
        .filter_map(|(id, (_, level))| Some((id.clone(), (*level)?)))
        .collect();
    if given.len() == elastic.objects.len() {
        // A scene that cannot be run as it is given has no error as it is given.
        let _ = trials.at(&given);
    }
    let of = |made: usize| coordinates(&trials.made[made].levels);
    let enough_without = judge.accepts(&trials, found) && of(found) == 0;
    // Methods need something to integrate.
    let made = 0..trials.made.len();
    let next = made.filter(|&made| of(made) > 0 && judge.accepts(&trials, made));
    let studied = match of(found) {
        0 => next.min_by_key(|&made| of(made)).unwrap_or(found),
        _ => found,
    };
    let levels = trials.made[studied].levels.clone();
    let mut tried: Vec<ModelError> = (trials.made.iter())
        .filter_map(|trial| {
            Some(ModelError {
                levels: trial.levels.clone(),
                coordinates: coordinates(&trial.levels),
                error: worst(trial, &known)?,
                given: trial.levels == given,
            })
        })
        .collect();
    tried.sort_by_key(|model| (model.coordinates, Total(-model.error)));
    let error = worst(&trials.made[studied], &known);
    let why = known.courses.iter().find_map(|course| match course {
        Course::NoLimit(why) => Some(why.clone()),
        Course::Open(_) => Some("max|δ| does not settle as the model is refined".to_owned()),
        Course::Limit(_) | Course::Bounded(_) | Course::Counts(_) => None,
    });
    elastic.set(scene, &levels);
    Ok(Models {
        asked,
        levels,
        error,
        enough_without,
        tried,
        why,
    })
}

/// The greatest error of a figure by a trial, relative to where the figure leads; `None`: one
/// leads nowhere, or the trial is in doubt.
fn worst(trial: &Trial, known: &FigureLimits) -> Option<f64> {
    if trial.doubt.is_some() {
        return None;
    }
    let share = |(asked, course): (&RequestedFigure, &Course)| match course {
        Course::Limit(found) | Course::Bounded(found) => {
            let error = Judge::error(trial, asked, course)?;
            // What never deviates has no error.
            let limit = found.limit.abs();
            Some(if error == 0.0 { 0.0 } else { error / limit })
        }
        _ => None,
    };
    let shares = known.asked.iter().zip(&known.courses).map(share);
    let shares: Option<Vec<f64>> = shares.collect();
    let worst = shares?.into_iter().fold(0.0, f64::max);
    worst.is_finite().then_some(worst)
}

impl Models {
    /// Error that a method needs to keep: a tenth of the model's, or of that asked for where
    /// the model is better.
    pub fn accuracy_of_methods(&self) -> f64 {
        let error = self.error.unwrap_or(0.0).max(self.asked);
        (SHARE_OF_MODEL * error).clamp(ERRORS.0, ERRORS.1)
    }

    /// The model that the methods are studied on, in words.
    pub fn in_words(&self) -> String {
        in_words(&self.levels)
    }

    /// The model, and how good it is.
    pub(super) fn sentence(&self) -> String {
        let model = self.in_words();
        let off = match (self.error, &self.why) {
            (Some(error), _) => format!(
                "max|δ| within {} % of the continuum's",
                shown(100.0 * error, 2)
            ),
            (None, Some(why)) => format!("an error that is not known: {why}"),
            (None, None) => "an error that is not known".to_owned(),
        };
        let less = match self.enough_without {
            true => " (rigid or static models would do, and leave nothing to integrate)",
            false => "",
        };
        format!("model: {model}, {off}{less}")
    }
}
