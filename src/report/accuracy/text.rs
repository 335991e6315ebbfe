//! What the figures of a run are worth, on the terminal: a line each.

use super::worth;
use crate::studies::order::{Certificate, ObjectModel};
use crate::units::shown;
use std::fmt::Write as _;

/// Significant digits of figures.
const DIGITS: usize = 7;

/// A line for every figure and every object.
pub fn text(certificate: &Certificate) -> String {
    let mut text = "\naccuracy, the error of the model included\n".to_owned();
    let width = certificate
        .accuracy
        .keys()
        .map(|figure| figure.chars().count())
        .max();
    let width = width.unwrap_or(0);
    for (figure, found) in &certificate.accuracy {
        let value = format!("{} {}", shown(found.value, DIGITS), found.unit);
        let worth = worth(found);
        let _ = writeln!(text, "  {figure:<width$}  {} {worth}", value.trim_end());
        if let Some(why) = &found.why {
            let _ = writeln!(text, "  {:<width$}  {why}", "");
        }
    }
    if certificate.models.is_empty() {
        return text;
    }
    text.push_str("\nmodels\n");
    let width = certificate
        .models
        .keys()
        .map(|id| id.chars().count())
        .max()
        .unwrap_or(0);
    for (id, model) in &certificate.models {
        let _ = writeln!(text, "  {id:<width$}  {}", object(model, certificate));
    }
    text
}

fn object(model: &ObjectModel, certificate: &Certificate) -> String {
    let level = model.level;
    match &model.next_cheaper {
        Some(less) => {
            let unit = certificate
                .accuracy
                .get(&less.figure)
                .map_or("", |one| &one.unit);
            format!(
                "{level}: with {} {} is {} off",
                less.level,
                less.figure,
                format!("{} {unit}", shown(less.error, 2)).trim_end()
            )
        }
        None => format!("{level}: {}", model.why),
    }
}
