//! Expectations made from a run: which of its figures a scene may expect, and how closely.
//!
//! The bound is the error of the certificate if the model is judged; else how far the result
//! moves with the tolerance and with rounding (`spread`).

use super::order::Certificate;
use super::run::RunResult;
use super::spread::Spread;
use crate::dynamics::model::owner_of;
use crate::frontend::scene::is_expectable;
use serde::Serialize;

/// Least difference that an expectation allows, as a share of the figure's scale: other
/// processors and compilers round otherwise.
const ROUNDING: f64 = 1e-9;
/// Tolerances of the integration that its error is taken for where it was not looked at.
const TOLERANCES: f64 = 100.0;

/// A figure that may be expected.
#[derive(Clone, Debug, PartialEq, Serialize)]
pub(crate) struct Offer {
    /// Its address.
    pub(crate) figure: String,
    /// Its value in the run, in SI units.
    pub(crate) value: f64,
    /// SI unit; empty for counts and answers.
    pub(crate) unit: String,
    /// How far it may be off; `None`: the run does not determine it.
    pub(crate) within: Option<f64>,
    /// What that rests on, or why there is none.
    pub(crate) why: String,
}

/// All figures of a run that a scene may expect, with their errors. That of the certificate
/// where the model was judged, else twice what the figure moves where the tolerance is halved
/// (an error in proportion to the tolerance halves with it) and what it moves under rounding,
/// else so many tolerances of its scale.
pub(crate) fn offers(
    result: &RunResult,
    certificate: Option<&Certificate>,
    spread: Option<&Spread>,
) -> Vec<Offer> {
    let figures = &result.figures;
    let known = figures.addresses().into_iter();
    let values = known.filter_map(|(figure, value)| Some((figure, value?)));
    let expectable = values.filter(|(figure, value)| {
        let (id, name) = owner_of(figure, |id| figures.objects.contains_key(id));
        let object = figures.objects.get(id);
        let of_stop = object.map(|object| object.stop.is_some());
        value.is_finite() && is_expectable(name, of_stop)
    });
    let offer = |(figure, value): (String, f64)| {
        let scale = figures.scale(&figure).max(value.abs());
        let (error, why) = error(&figure, scale, result, certificate, spread);
        let unit = figures.unit(&figure);
        // A count that does not move is expected as it is.
        let is_count = unit.is_empty() && value.fract() == 0.0;
        let error = error.filter(|error| error.is_finite());
        let within = error.map(|error| match is_count {
            true => error.floor(),
            false => rounded_up(error.max(ROUNDING * scale)),
        });
        Offer {
            figure,
            value,
            unit,
            within,
            why,
        }
    };
    expectable.map(offer).collect()
}

/// The error of a figure, with what it rests on; `None`: it has none, with why.
fn error(
    figure: &str,
    scale: f64,
    result: &RunResult,
    certificate: Option<&Certificate>,
    spread: Option<&Spread>,
) -> (Option<f64>, String) {
    let judged = certificate.and_then(|found| found.accuracy.get(figure));
    if let Some(judged) = judged {
        return match (judged.error, &judged.why) {
            (Some(error), _) => (Some(error), "error of the model and of the run".to_owned()),
            (None, why) => (None, why.clone().unwrap_or_default()),
        };
    }
    let Some(spread) = spread else {
        let words = format!("{TOLERANCES} times the tolerance of the run");
        return (Some(TOLERANCES * result.tolerance * scale), words);
    };
    let moved = spread.figures.iter().find(|one| one.figure == figure);
    match moved.and_then(|one| one.by_loads.zip(one.by_tolerance)) {
        Some((loads, tolerance)) => {
            let words = "how far the result changes with the tolerance and with rounding";
            (Some(loads + 2.0 * tolerance), words.to_owned())
        }
        None => {
            let words = "it is gone when loads or tolerance change by next to nothing";
            (None, words.to_owned())
        }
    }
}

/// The next number above with one digit.
fn rounded_up(value: f64) -> f64 {
    if value <= 0.0 || !value.is_finite() {
        return 0.0;
    }
    let size = value.log10().floor();
    let digit = (value / 10f64.powf(size)).ceil();
    // Read as it is written, so that it has one digit indeed.
    let text = format!("{digit}e{size}");
    text.parse().unwrap_or(value)
}

#[cfg(test)]
mod tests {
    use super::{offers, rounded_up};
    use crate::ask::{Mechanism, ModelAssessment};
    use crate::budget::Budget;
    use crate::frontend::scene::{BuiltIn, Document, Overrides};
    use crate::studies::expectations::check;
    use crate::studies::order::{Certainty, Certificate, FigureAccuracy};
    use crate::studies::spread::repeat_with_changes;
    use serde_json::{Value, json};

    fn made(text: &str) -> Mechanism {
        let document = Document::parse("scene", text.as_bytes()).unwrap();
        let reading = document.scene(&BuiltIn, &Overrides::none()).unwrap();
        Mechanism::of_within(reading, ModelAssessment::Asked, &Budget::FREE).unwrap()
    }

    #[test]
    fn what_is_offered_is_read_and_met_with_a_finer_run_too() {
        for scene in [
            "rocker/two_masses",
            "valve_train/valve_lash",
            "contact/claw_clutch",
            "joint_friction/stick_slip",
            "linkages/toggle_press",
        ] {
            let text = std::fs::read_to_string(format!("scenarios/{scene}.json")).unwrap();
            let mechanism = made(&text);
            let result = mechanism.run().unwrap();
            let free = Budget::FREE;
            let moved = repeat_with_changes(&mechanism.system, &mechanism.settings, &result, &free)
                .unwrap();
            let offered = offers(&result, mechanism.certificate.as_ref(), Some(&moved));
            assert!(offered.len() > 4, "{scene}: {offered:?}");
            let entries = offered.iter().filter_map(|one| {
                let within = one.within?;
                Some(json!({ "figure": one.figure, "value": one.value, "within": within }))
            });
            let mut changed: Value = serde_json::from_str(&text).unwrap();
            let entries: Vec<Value> = entries.collect();
            let count = entries.len();
            changed["expect"] = json!(entries);
            let again = made(&changed.to_string());
            let own = check(&again.scene().expect, &again.run().unwrap());
            assert_eq!(own.len(), count);
            // The same method with a tenth of the tolerance.
            let mut finer = again;
            finer.settings.method = Some(result.method);
            finer.settings.tolerance = 0.1 * result.tolerance;
            let finer = check(&finer.scene().expect, &finer.run().unwrap());
            for verdict in own.iter().chain(&finer) {
                assert!(verdict.holds, "{scene}: {}", verdict.message);
            }
        }
    }

    #[test]
    fn without_a_spread_the_tolerance_counts() {
        let text = std::fs::read_to_string("scenarios/rocker/two_masses.json").unwrap();
        let result = made(&text).run().unwrap();
        let offered = offers(&result, None, None);
        let find = |figure: &str| offered.iter().find(|one| one.figure == figure).unwrap();
        let delta = find("rocker.delta_max");
        let scale = result.figures.scale("rocker.delta_max");
        let within = delta.within.unwrap();
        assert!(
            within >= 100.0 * result.tolerance * scale && within < 300.0 * result.tolerance * scale
        );
        assert!(
            !offered
                .iter()
                .any(|one| one.figure.contains("switch_times") || one.figure == "run.steps")
        );
    }

    #[test]
    fn the_error_of_the_model_counts_where_it_was_judged() {
        let text = std::fs::read_to_string("scenarios/rocker/two_masses.json").unwrap();
        let result = made(&text).run().unwrap();
        let accuracy = |error, why: Option<&str>| FigureAccuracy {
            value: 1.0,
            unit: "rad".to_owned(),
            error,
            relative: None,
            asked: 1.0,
            holds: error.is_some(),
            kind: Certainty::Estimate,
            shares: None,
            limit: None,
            why: why.map(str::to_owned),
        };
        let mut certificate = Certificate::default();
        let judged = [
            ("rocker.delta_max", accuracy(Some(3.2e-5), None)),
            (
                "rocker.sigma",
                accuracy(None, Some("it grows with the masses")),
            ),
            ("rocker.pair.separations", accuracy(Some(2.0), None)),
            ("rocker.peak_speed", accuracy(Some(f64::NAN), None)),
        ];
        for (figure, found) in judged {
            certificate.accuracy.insert(figure.to_owned(), found);
        }
        let offered = offers(&result, Some(&certificate), None);
        let find = |figure: &str| offered.iter().find(|one| one.figure == figure).unwrap();
        assert_eq!(find("rocker.delta_max").within, Some(4e-5));
        let grows = find("rocker.sigma");
        assert_eq!(
            (grows.within, grows.why.as_str()),
            (None, "it grows with the masses")
        );
        assert_eq!(find("rocker.pair.separations").within, Some(2.0));
        assert_eq!(find("rocker.peak_speed").within, None);
    }

    #[test]
    fn bounds_have_one_digit() {
        for (value, wanted) in [
            (1.01e-9, 2e-9),
            (1e-9, 1e-9),
            (9.5e-4, 1e-3),
            (3.2, 4.0),
            (0.0, 0.0),
            (f64::NAN, 0.0),
        ] {
            assert_eq!(rounded_up(value), wanted, "{value}");
        }
    }
}
