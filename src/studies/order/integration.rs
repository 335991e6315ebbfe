//! How finely a run is integrated whose figures are asked for within an accuracy.
//!
//! Where figures lead is told from differences between runs, which are integrated as the scene
//! says. A run of the model that was chosen needs to be no better than a tenth of what is
//! asked for. A tolerance alone promises little of a single figure: how far each is off is
//! measured by the finer run that there has been.
//!
//! This holds if the scene states neither tolerance nor method: the rows are integrated as
//! ever, and the model is chosen once more to a tenth of the accuracy. The tolerance goes with
//! the settings (`RunSettings::of_accuracy`) and holds for `studies::run` alone; other studies
//! have their own.

use super::judge::{Judge, value};
use super::requested_figures::{RequestedFigure, is_count};
use super::row::Course;
use super::trial::{Trial, Trials};
use crate::dynamics::record::Figures;
use crate::fault::Fault;
use crate::frontend::scene::{AllowedValues, Expectation, Expected};
use crate::math::order::Total;
use crate::studies::ToleranceOfAccuracy;
use crate::studies::expectations::of_run;
use crate::units::shown;
use std::collections::BTreeMap;

/// Share of the accuracy that is left to the integration.
const SHARE: f64 = 0.1;
/// No run is integrated more coarsely: beyond, the balance of its energies says little.
const COARSEST: f64 = 1e-3;
/// A tolerance that does not do is followed by so many times it.
const FINER: f64 = 0.1;
/// A difference to a finer run counts so many times: that is off too.
const SAFETY: f64 = 1.5;

/// The tolerance, relative to the scales of the figures, that is a tenth of what they may be
/// off; in round numbers.
fn tolerance(asked: &[RequestedFigure], figures: &Figures) -> f64 {
    let allowed = |one: &RequestedFigure| {
        let value = figures.value(&one.figure).unwrap_or(f64::NAN);
        one.accuracy.bound(value) / figures.scale(&one.figure)
    };
    let least = (asked.iter().filter(|one| !is_count(&one.figure)))
        .map(allowed)
        .min_by_key(|allowed| Total(*allowed));
    match least {
        Some(least) if least.is_finite() => round(SHARE * least).min(COARSEST),
        // What has no value, or only counts, tells nothing.
        _ => 0.0,
    }
}

/// The next lower of 1, 2 and 5 times a power of ten; 0 of 0.
fn round(number: f64) -> f64 {
    if !(number > 0.0) {
        return 0.0;
    }
    // A power that is met to rounding is met.
    let decade = (number * (1.0 + 1e-9)).log10().floor();
    let of = |step: f64| format!("{step}e{decade}").parse().unwrap_or(0.0);
    let steps = [5.0, 2.0].map(of);
    let met = steps
        .into_iter()
        .find(|step| *step <= number * (1.0 + 1e-9));
    met.unwrap_or_else(|| of(1.0))
}

/// Integrates the model that was chosen anew, as coarsely as the accuracy allows; that run
/// takes the place of the one before, with what its figures are off by it. `None`: somebody
/// said the tolerance, nothing is integrated, or nothing coarser will do for less.
///
/// # Errors
/// The model cannot be built or started.
pub(super) fn coarsest_tolerance(
    trials: &mut Trials<'_>,
    judge: &Judge<'_>,
    chosen: usize,
) -> Result<Option<ToleranceOfAccuracy>, Vec<Fault>> {
    let fine = trials.made[chosen].clone();
    let own = trials.own_tolerance();
    let open = trials.integration_is_open() && fine.integrated && fine.doubt.is_none();
    let mut tolerance = tolerance(judge.asked, &fine.figures);
    while open && tolerance > own && !trials.interrupted {
        let mut coarse = trials.run(&fine.levels, tolerance)?;
        // (Where pairs bounce, steps that are refused may cost more than they spare.)
        if coarse.cost < fine.cost
            && let Some(why) = measured(trials, judge, &mut coarse, &fine)
        {
            trials.made[chosen] = coarse;
            return Ok(Some(ToleranceOfAccuracy { tolerance, why }));
        }
        tolerance = round(FINER * tolerance);
    }
    Ok(None)
}

/// What the figures of a run are off by its integration, by a finer one, and in words; `None`:
/// more than may be left to it.
fn measured(
    trials: &Trials<'_>,
    judge: &Judge<'_>,
    coarse: &mut Trial,
    fine: &Trial,
) -> Option<String> {
    let ended = |trial: &Trial| (trial.doubt.is_some(), trial.figures.run.stopped.clone());
    if ended(coarse) != ended(fine) || !expectations_are_decided(&trials.scene.expect, coarse, fine)
    {
        return None;
    }
    let mut measured = BTreeMap::new();
    let mut deciding: Option<(f64, String)> = None;
    for (asked, course) in judge.asked.iter().zip(judge.courses) {
        let off = integration_error(coarse, fine, &asked.figure);
        let bound = Judge::bound(asked, course);
        let bound = bound.unwrap_or_else(|| asked.accuracy.bound(value(fine, asked)));
        let allowed = SHARE * bound;
        // Written so that a number that is none is too much.
        if !(off <= allowed && keeps(asked, course, bound, (coarse, off), fine)) {
            return None;
        }
        let share = off / allowed;
        if share.is_finite() && deciding.as_ref().is_none_or(|(most, _)| share > *most) {
            let unit = fine.figures.unit(&asked.figure);
            let number = |number: f64| format!("{} {unit}", shown(number, 2));
            let words = format!(
                "the required accuracy needs no finer one: {} has an error of {} by it, measured; \
                 a tenth of its accuracy is {}",
                asked.figure,
                number(off).trim_end(),
                number(allowed).trim_end()
            );
            deciding = Some((share, words));
        }
        measured.insert(asked.figure.clone(), off);
    }
    coarse.measured = measured;
    let counts = || "the wanted results are counts, and a finer run gives the same".to_owned();
    Some(deciding.map_or_else(counts, |(_, words)| words))
}

/// How far a figure is off by the integration, in its unit.
fn integration_error(coarse: &Trial, fine: &Trial, figure: &str) -> f64 {
    let of = |trial: &Trial| trial.figures.value(figure).unwrap_or(f64::NAN);
    SAFETY * (of(coarse) - of(fine)).abs() + fine.integration_of(figure)
}

/// True unless a figure is within its accuracy by the finer run alone.
fn keeps(
    asked: &RequestedFigure,
    course: &Course,
    bound: f64,
    (coarse, off): (&Trial, f64),
    fine: &Trial,
) -> bool {
    let within = |trial: &Trial, off: f64| {
        let error = Judge::error(trial, asked, course);
        error.is_none_or(|error| error + off <= bound)
    };
    within(coarse, off) || !within(fine, fine.integration_of(&asked.figure))
}

/// True when what a scene expects of its run is met or not whatever the integration.
fn expectations_are_decided(all: &[Expectation], coarse: &Trial, fine: &Trial) -> bool {
    let mut expected = all.iter().filter(|one| of_run(one));
    expected.all(|one| {
        let (figure, within) = match &one.what {
            Expected::Figure { figure, allowed } => {
                (figure.as_str(), allowed_change(allowed, fine, figure))
            }
            Expected::Stops { within, .. } => ("run.time", *within),
        };
        let gone = |trial: &Trial| trial.figures.value(figure).is_err();
        let computed = figure.starts_with("run.") && figure != "run.time";
        computed
            || (gone(coarse) && gone(fine))
            || integration_error(coarse, fine, figure) <= SHARE * within
    })
}

/// How far a figure may move: its bound, or how far its limits are.
fn allowed_change(allowed: &AllowedValues, trial: &Trial, figure: &str) -> f64 {
    match *allowed {
        AllowedValues::Near { within, .. } => within,
        AllowedValues::Between { .. } => {
            let value = trial.figures.value(figure).unwrap_or(f64::NAN);
            let [least, most] = allowed.limits().map(|limit| (value - limit).abs());
            least.min(most)
        }
    }
}

#[cfg(test)]
mod tests {
    use super::round;

    #[test]
    fn tolerances_are_round() {
        for (number, rounded) in [
            (1e-3, 1e-3),
            (0.1 * 0.01, 1e-3),
            (9.99e-4, 5e-4),
            (4.9e-5, 2e-5),
            (2e-7, 2e-7),
            (1.9e-7, 1e-7),
            (0.0, 0.0),
            (f64::NAN, 0.0),
        ] {
            assert_eq!(round(number), rounded, "{number}");
        }
    }
}
