//! The same scene with more masses, by which the error of a linear model is judged.

use super::model::LinearModel;
use crate::dynamics::system::System;
use crate::frontend::lower::lower;
use crate::frontend::scene::{Levels, TypedScene, in_words};

/// Masses of the finer model for one of the model, where there is room. The finer model has a
/// sixteenth of the error of the model or less.
const TIMES: usize = 16;

/// Most masses of the finer model.
const MOST_MASSES: usize = 4000;

/// A finer model of the same scene.
#[derive(Clone, Debug)]
pub(super) struct FinerModel {
    /// Masses in place of one.
    pub(super) times: usize,
    /// Its objects with their levels, in words.
    pub(super) levels: String,
    pub(super) model: LinearModel,
}

impl FinerModel {
    /// A scene whose uniform elastic objects have more masses. The scene is left as it was.
    ///
    /// # Errors
    /// Why there is none, in a sentence.
    pub(super) fn of(scene: &mut TypedScene, model: &LinearModel) -> Result<Self, String> {
        let elastic = scene.elastic();
        let uniform = elastic.objects.iter();
        let levels = uniform.filter_map(|(id, (_, level))| Some((id.clone(), (*level)?)));
        let levels: Levels = levels
            .filter(|(id, level)| level.coordinates() > 0 && model.objects().any(|own| own == id))
            .collect();
        if levels.is_empty() {
            return Err("masses that are given one by one have no finer model".to_owned());
        }
        let masses: usize = levels.values().map(|level| level.coordinates()).sum();
        let times = TIMES.min(MOST_MASSES / masses);
        if times < 2 {
            return Err(format!("{masses} masses are too many for a finer model"));
        }
        let refined = levels.iter().filter_map(|(id, level)| {
            let finer = level.refined(times)?;
            Some((id.clone(), finer))
        });
        let refined: Levels = refined.collect();
        elastic.set(scene, &refined);
        let system = lower(scene).and_then(System::new);
        elastic.set(scene, &levels);
        let made = system.and_then(|system| LinearModel::of(&system));
        let model = made.map_err(|faults| {
            let first = faults.first().map_or("", |fault| fault.message.as_str());
            format!("there is no finer model: {first}")
        })?;
        Ok(Self {
            times,
            levels: in_words(&refined),
            model,
        })
    }
}
