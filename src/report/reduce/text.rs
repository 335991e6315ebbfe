//! The smallest scene on the terminal.

use super::{answer, greatest, why};
use crate::report::accuracy;
use crate::studies::reduce::{ModelTried, Reduction, Role, Step};
use crate::units::shown;
use std::fmt::Write as _;

/// The answer, the figures, what is left out and what stays.
pub fn text(reduction: &Reduction) -> String {
    let mut text = format!("{}\n{}\n", reduction.scene, answer(reduction));
    if !reduction.complete {
        text.push_str("Ended before everything was tried.\n");
    }
    text.push_str(&accuracy::text(&reduction.certificate));
    let left_out: Vec<&Step> = reduction.removed().collect();
    section(&mut text, "left out", &left_out, |step| {
        greatest(reduction, step)
    });
    let kept: Vec<&Step> = reduction.kept().collect();
    section(&mut text, "kept", &kept, |step| {
        (step.refused.as_ref()).map_or(String::new(), |refused| why(reduction, refused))
    });
    let models = [Role::Given, Role::Reduced].map(|role| reduction.model(role));
    if let [Some(given), Some(reduced)] = models {
        let _ = writeln!(text, "\nas given  {}", cost(given));
        let _ = writeln!(text, "reduced   {}", cost(reduced));
    }
    text
}

fn section(text: &mut String, title: &str, steps: &[&Step], says: impl Fn(&Step) -> String) {
    if steps.is_empty() {
        return;
    }
    let _ = writeln!(text, "\n{title}");
    for step in steps {
        let _ = writeln!(text, "  {}\n      {}", step.removal, says(step));
    }
}

fn cost(model: &ModelTried) -> String {
    let coordinates = match model.coordinates {
        1 => "1 coordinate".to_owned(),
        count => format!("{count} coordinates"),
    };
    let milliseconds = shown(1e3 * model.seconds, 2);
    format!("{coordinates} of elastic objects, {milliseconds} ms")
}
