//! What a fit says, in words.

use crate::report::addresses::parameter_words;
use crate::report::quantity::{counted, significant};
use crate::report::verdict::{Sort, capitalised};
use crate::studies::identify::{Change, Ending, Estimate, Identification};

/// Digits of estimates.
pub(super) const DIGITS: usize = 9;
/// Digits of errors.
pub(super) const FEW: usize = 3;

/// A value of a number in its unit.
pub(super) fn in_unit(value: f64, one: &Estimate, digits: usize) -> String {
    let number = significant(value, digits);
    format!("{number} {}", one.variable.unit)
        .trim_end()
        .to_owned()
}

/// An estimate with as many digits as its error leaves, and the error; `None`: it is not
/// determined.
pub(super) fn estimate_words(one: &Estimate) -> Option<[String; 2]> {
    let (value, error) = one.value()?;
    let ratio = (value / error).abs().log10().ceil();
    let digits = match ratio.is_finite() {
        true => (ratio.max(0.0) as usize + 2).clamp(FEW, DIGITS),
        false => DIGITS,
    };
    Some([in_unit(value, one, digits), in_unit(error, one, FEW)])
}

/// What the record says of a number.
pub(super) fn verdict_words(one: &Estimate, ending: Ending) -> &'static str {
    match (ending, one) {
        (Ending::Converged, one) if one.is_determined() => "determined",
        (Ending::Converged, one) if one.at_end => "not determined: at an end of its range",
        (Ending::Converged, one) if one.is_ambiguous => "not determined: other values fit as well",
        (Ending::Converged, _) => "not determined by this record",
        (Ending::MostSteps | Ending::NoResiduals | Ending::Interrupted, _) => {
            "not known: no fit ended"
        }
    }
}

/// Sort, headline and what stands below it.
pub(super) fn verdict(found: &Identification) -> (Sort, String, String) {
    let undetermined: Vec<String> = (found.estimates.iter())
        .filter(|one| !one.is_determined())
        .map(|one| parameter_words(&one.variable.path))
        .collect();
    let (sort, headline) = match (found.ending, undetermined.as_slice()) {
        (Ending::Converged, []) => (Sort::Good, estimates_headline(found)),
        (Ending::Converged, names) => {
            let names = names.join(", ");
            let headline = format!("The record does not determine {names}.");
            (Sort::Numerical, headline)
        }
        (Ending::MostSteps | Ending::NoResiduals, _) => {
            (Sort::Numerical, "The fit did not converge.".to_owned())
        }
        (Ending::Interrupted, _) => (Sort::Unfinished, "No fit ended.".to_owned()),
    };
    let worked_on = match found.complete {
        true => String::new(),
        false => format!(
            "Ended before all {} were done.",
            counted(found.starts_requested, "start")
        ),
    };
    let agreement = format!(
        "{} of {} ended there.",
        counted(found.starts_at_best(), "start"),
        found.starts.len()
    );
    let text = match (found.complete, sort) {
        (false, _) => worked_on,
        (true, Sort::Good) => agreement,
        (true, _) => String::new(),
    };
    let sort = if found.complete {
        sort
    } else {
        Sort::Unfinished
    };
    (sort, headline, text)
}

fn estimates_headline(found: &Identification) -> String {
    let one = |one: &Estimate| {
        let [value, error] = estimate_words(one)?;
        let name = parameter_words(&one.variable.path);
        Some(format!("{name} {value} (± {error})"))
    };
    let all: Vec<String> = found.estimates.iter().filter_map(one).collect();
    capitalised(&all.join(", ")) + "."
}

/// What changes together without an effect on the fit.
pub(super) fn direction_words(direction: &[Change]) -> String {
    let name = |one: &Change| parameter_words(&one.path);
    match direction {
        [] => String::new(),
        [one] => format!(
            "The {} has too little effect on the record to be determined.",
            name(one)
        ),
        several => {
            let each = several.iter().map(|one| {
                let sign = if one.change < 0.0 { "−" } else { "+" };
                let change = significant(one.change.abs(), FEW);
                format!("{} {sign}{change} %", name(one))
            });
            let each: Vec<String> = each.collect();
            format!(
                "These changes together leave the fit as it is: {}. The record determines no one \
                 of them.",
                each.join(", ")
            )
        }
    }
}

/// Pairs of which a combination is known better than each.
pub(super) fn correlation_words(found: &Identification) -> Vec<String> {
    let one = |(one, other, value): &(usize, usize, f64)| {
        let [one, other] = [&found.estimates[*one], &found.estimates[*other]];
        // (Of numbers above zero: what rises together leaves the ratio.)
        let is_ratio = value * one.fitted * other.fitted > 0.0;
        format!(
            "The {} and the {} have a correlation of {}: the record determines mainly their {}.",
            parameter_words(&one.variable.path),
            parameter_words(&other.variable.path),
            significant(*value, FEW),
            if is_ratio { "ratio" } else { "product" }
        )
    };
    found.correlated.iter().map(one).collect()
}
