//! What the figures of a run are worth: text, JSON and the section of a page.

mod page;
mod text;

pub(in crate::report) use page::{section, tables};
pub use text::text;

use crate::report::quantity::significant;
use crate::studies::order::{Certainty, Certificate, FigureAccuracy};
use serde_json::{Value, json};

/// How far a figure may be off, and how sure that is.
fn worth(figure: &FigureAccuracy) -> String {
    let sure = match figure.kind {
        Certainty::Estimate => "estimate",
        Certainty::NoLimit => return "no limit".to_owned(),
        Certainty::NotDetermined => return "not determined by the order of the model".to_owned(),
    };
    let size = match (figure.relative, figure.error) {
        (Some(share), _) if share > 0.0 => format!("± {} %", significant(100.0 * share, 2)),
        (_, Some(error)) if error > 0.0 => format!("± {} {}", significant(error, 2), figure.unit)
            .trim_end()
            .to_owned(),
        _ => return "exact".to_owned(),
    };
    match figure.holds {
        true => format!("{size} ({sure})"),
        false => format!(
            "{size} ({sure}), asked for ± {}",
            significant(figure.asked, 2)
        ),
    }
}

/// What a certificate adds to the document of a run: `accuracy` of the whole, `model` of
/// each object, and `models`, all that were tried.
pub fn add_to(document: &mut Value, certificate: &Certificate) {
    document["accuracy"] = json!(certificate.accuracy);
    document["models"] = json!(certificate.tried);
    for (id, model) in &certificate.models {
        if let Some(object) = document["objects"].get_mut(id) {
            object["model"] = json!(model);
        }
    }
}
