//! What the figures of a run are worth: sections of findings, and JSON.

mod chart;

pub(in crate::report) use chart::{LEAST, chart_section};

use crate::report::findings::{Cell, Section, Table, Value};
use crate::report::plot::Rule;
use crate::report::quantity::{significant, with_unit};
use crate::studies::order::{Certainty, Certificate, FigureAccuracy, ObjectModel};
use serde_json::json;

/// The figures with their errors, and the levels of the objects.
pub(in crate::report) fn sections<'a>(certificate: &Certificate) -> Vec<Section<'a>> {
    let figure = |(name, found): (&String, &FigureAccuracy)| {
        let number = |value: f64, digits| Value::new(value, &found.unit, digits);
        vec![
            Cell::result(name),
            number(found.value, 7).into(),
            number(found.limit.unwrap_or(f64::NAN), 7).into(),
            Cell::with_note(error_in_words(found), found.why.clone().unwrap_or_default()),
        ]
    };
    let object = |(id, model): (&String, &ObjectModel)| {
        let less = model.next_cheaper.as_ref().map_or(String::new(), |less| {
            let unit = certificate.accuracy.get(&less.figure);
            let unit = unit.map_or("", |one| &one.unit);
            let off = with_unit(less.error, unit, 2);
            format!("with {} {} is {off} off", less.level, less.figure)
        });
        let level = model.level.to_string();
        [id.as_str(), &level, &model.why, &less]
            .map(Cell::from)
            .to_vec()
    };
    let figures = Table::new(["result", ">value", ">converged value", "~error"]);
    let objects = Table::new(["object", "model", "~why", "~less is not enough"]);
    vec![
        Section::new("Accuracy, the error of the model included")
            .legend(
                "How far each result may be from that of the continuum that the objects' data \
                 describe.",
            )
            .table(figures.rows(certificate.accuracy.iter().map(figure))),
        Section::new("Models").table(objects.rows(certificate.models.iter().map(object))),
    ]
}

/// The line of the least error that is required of a figure, as a share of its converged value; none
/// where no share is.
pub(in crate::report) fn requested_error_line(certificate: &Certificate) -> Vec<Rule> {
    let allowed = certificate.accuracy.values().filter_map(|figure| {
        let share = figure.asked / figure.limit?.abs();
        (share.is_finite() && share > 0.0).then_some(share)
    });
    let least = allowed.min_by(f64::total_cmp);
    let label = |at: f64| format!("required: {} %", significant(100.0 * at, 2));
    let rule = least.map(|at| Rule::level(at, label(at)));
    rule.into_iter().collect()
}

/// How far a figure may be off, and how sure that is.
fn error_in_words(figure: &FigureAccuracy) -> String {
    let sure = match figure.kind {
        Certainty::Bound => "bound",
        Certainty::Estimate => "estimate",
        Certainty::NoLimit => return "no converged value".to_owned(),
        Certainty::NotDetermined => return "not determined by the order of the model".to_owned(),
    };
    let size = match (figure.relative, figure.error) {
        (Some(share), _) if share > 0.0 => format!("± {} %", significant(100.0 * share, 2)),
        (_, Some(error)) if error > 0.0 => {
            format!("± {}", Value::new(error, &figure.unit, 2).words())
        }
        _ => return "exact".to_owned(),
    };
    match figure.holds {
        true => format!("{size} ({sure})"),
        false => {
            let required = Value::new(figure.asked, &figure.unit, 2);
            format!("{size} ({sure}), required ± {}", required.words())
        }
    }
}

/// What a certificate adds to the document of a run: `accuracy` of the whole, `model` of
/// each object, and `models`, all that were tried.
pub fn add_to(document: &mut serde_json::Value, certificate: &Certificate) {
    document["accuracy"] = json!(certificate.accuracy);
    document["models"] = json!(certificate.tried);
    for (id, model) in &certificate.models {
        if let Some(object) = document["objects"].get_mut(id) {
            object["model"] = json!(model);
        }
    }
}
