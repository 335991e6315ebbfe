//! Laws compared by constants and by response, as text and table.

use crate::report::csv::{number, write};
use crate::report::quantity::significant;
use crate::studies::law::{ComparedLaw, Figure, LiftOff};
use std::fmt::Write as _;

/// Laws side by side, every figure with its place, best first by `by`.
pub fn comparison_text(laws: &[ComparedLaw], by: Figure) -> String {
    let places = by.ranks(laws);
    let mut order: Vec<usize> = (0..laws.len()).collect();
    order.sort_by_cached_key(|&index| (places[index].unwrap_or(usize::MAX), index));
    let width = laws.iter().map(|law| law.name.chars().count());
    let width = width.max().unwrap_or(0).max(3);
    let shown: Vec<Figure> = Figure::ALL
        .into_iter()
        .filter(|figure| laws.iter().any(|law| figure.of(law).is_some()))
        .collect();
    let mut text = format!("{:<width$}", "law");
    for figure in &shown {
        let _ = write!(text, " {:>16}", figure.name());
    }
    text.push('\n');
    for &index in &order {
        let law = &laws[index];
        let _ = write!(text, "{:<width$}", law.name);
        for figure in &shown {
            let _ = write!(text, " {:>16}", cell(*figure, laws, index));
        }
        text.push('\n');
    }
    text.push_str(&verdict(laws, by));
    text
}

/// Value and place: `4.888 (2)`.
fn cell(figure: Figure, laws: &[ComparedLaw], index: usize) -> String {
    let law = &laws[index];
    let Some(value) = figure.of(law) else {
        return "–".to_owned();
    };
    let sign = match (figure, law.response.lift_off) {
        (Figure::LiftOff, Some(LiftOff::Above(_))) => "> ",
        (Figure::LiftOff, Some(LiftOff::Below(_))) => "< ",
        _ => "",
    };
    let place = figure.ranks(laws)[index].map_or(String::new(), |place| format!(" ({place})"));
    format!("{sign}{}{place}", significant(value, 5))
}

/// The best law by `by`, and whether the constants would have chosen another.
fn verdict(laws: &[ComparedLaw], by: Figure) -> String {
    let best = |figure: Figure| {
        let places = figure.ranks(laws);
        let winners = laws
            .iter()
            .zip(&places)
            .filter(|(_, place)| **place == Some(1));
        winners
            .map(|(law, _)| law.name.as_str())
            .collect::<Vec<_>>()
    };
    let chosen = best(by);
    let mut text = format!("\nbest by {}: {}\n", by.name(), chosen.join(", "));
    for figure in Figure::ALL
        .into_iter()
        .filter(|figure| figure.is_constant())
    {
        let named = best(figure);
        if !named.is_empty() && !named.iter().any(|name| chosen.contains(name)) {
            let _ = writeln!(
                text,
                "by {} alone it would have been: {}",
                figure.name(),
                named.join(", ")
            );
        }
    }
    text
}

/// The comparison as CSV: one row a law, every figure with its place.
///
/// # Errors
/// Never in practice: writing into memory.
pub fn comparison_csv(laws: &[ComparedLaw]) -> Result<String, csv::Error> {
    let names = Figure::ALL.into_iter().flat_map(|figure| {
        let name = figure.name();
        [name.to_owned(), format!("{name} place")]
    });
    let rows = laws.iter().enumerate().map(|(index, law)| {
        let cells = Figure::ALL.into_iter().flat_map(|figure| {
            let value = figure.of(law).map(number).unwrap_or_default();
            let place = figure.ranks(laws)[index];
            [
                value,
                place.map(|place| place.to_string()).unwrap_or_default(),
            ]
        });
        std::iter::once(law.name.clone())
            .chain(cells)
            .collect::<Vec<String>>()
    });
    write(std::iter::once("law".to_owned()).chain(names), rows)
}

#[cfg(test)]
mod tests {
    use super::{comparison_csv, comparison_text};
    use crate::kinematics::motion::{Law, LawName};
    use crate::studies::law::{ComparedLaw, Figure, LawResponse};

    fn law(name: LawName, residual: f64) -> ComparedLaw {
        ComparedLaw {
            name: name.name().to_owned(),
            constants: Law::of_stroke(&name.into()).unwrap().constants(),
            response: LawResponse {
                residual: Some(residual),
                ..LawResponse::default()
            },
        }
    }

    #[test]
    fn the_best_stands_first_and_misleading_constants_are_named() {
        let laws = [law(LawName::Parabolic, 2e-3), law(LawName::Cycloidal, 1e-4)];
        let text = comparison_text(&laws, Figure::Residual);
        let first = text.lines().nth(1).unwrap();
        assert!(first.starts_with("cycloidal"), "{text}");
        assert!(text.contains("best by residual: cycloidal"));
        assert!(text.contains("by C_a alone it would have been: parabolic"));
        let csv = comparison_csv(&laws).unwrap();
        assert!(csv.starts_with("law,C_v,C_v place"), "{csv}");
        assert!(csv.contains("\nparabolic,2,1,4,1,0,1,8,1,2e-3,2,"), "{csv}");
    }
}
