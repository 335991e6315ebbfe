//! Where all figures of a scene lead as its elastic objects are refined.

use super::choose::families;
use super::requested_figures::RequestedFigure;
use super::row::{Course, Row};
use super::trial::Trials;
use crate::fault::Fault;
use crate::frontend::scene::{Accuracy, TypedScene};
use crate::studies::compare::Limit;
use crate::studies::{Control, RunSettings};
use std::collections::BTreeMap;

/// The limit of each figure, by its address.
pub type Limits = BTreeMap<String, Limit>;

/// Runs of a row: from a quarter of the coordinates of the scene to four times as many.
const RUNS: usize = 5;

/// The limits of figures, by runs with a quarter of the coordinates of the scene (where that
/// can be) to four times as many.
///
/// # Errors
/// The model cannot be built or started.
pub fn limits(
    scene: &mut TypedScene,
    settings: &RunSettings,
    figures: impl Iterator<Item = String>,
    control: &Control<'_>,
) -> Result<Limits, Vec<Fault>> {
    let mut trials = Trials::new(scene, settings, control);
    let mut families = families(&trials);
    let row =
        Row::refine_until_enough(&mut trials, &mut families, |_, row| row.runs.len() == RUNS)?;
    let asked = |figure| RequestedFigure {
        figure,
        accuracy: Accuracy::Share(0.0),
    };
    let limit = |asked: RequestedFigure| {
        let limit = limit_of_course(row.course_of_figure(&trials, &asked));
        (asked.figure, limit)
    };
    Ok(figures.map(asked).map(limit).collect())
}

fn limit_of_course(course: Course) -> Limit {
    let none = Limit {
        value: None,
        error: None,
        order: None,
        why: None,
    };
    match course {
        Course::Limit(found) | Course::Bounded(found) => Limit {
            value: Some(found.limit),
            error: Some(found.error),
            order: found.order,
            ..none
        },
        Course::Counts(count) => Limit {
            value: Some(count),
            error: Some(0.0),
            ..none
        },
        Course::NoLimit(why) => Limit {
            why: Some(why),
            ..none
        },
        Course::Open(_) => Limit {
            why: Some("it does not settle as the model is refined".to_owned()),
            ..none
        },
    }
}
