//! The samples as a table for other programs.

use crate::report::csv::{Field, Rows};
use crate::studies::tolerance::Tolerances;

/// One row a sample: the numbers, the results, what became of it and why.
pub fn rows(found: &Tolerances) -> Rows {
    let paths = found
        .dimensions
        .iter()
        .flat_map(|one| one.paths.iter().cloned());
    let figures = found.figures.iter().map(|one| one.figure.clone());
    let last = ["verdict", "cause"].map(str::to_owned);
    let heads: Vec<String> = paths.chain(figures).chain(last).collect();
    let each = found.samples.iter().zip(&found.deviations);
    let row = each.map(|(sample, deviations)| {
        let numbers = found
            .dimensions
            .iter()
            .zip(deviations)
            .flat_map(|(one, own)| {
                let each = one.nominal.iter();
                each.map(move |nominal| Field::from(nominal + own))
            });
        let values = sample.values.iter().map(|value| Field::from(*value));
        let words = [sample.verdict.name().into(), sample.cause.as_str().into()];
        numbers.chain(values).chain(words).collect::<Vec<Field>>()
    });
    Rows::new(heads, row)
}
