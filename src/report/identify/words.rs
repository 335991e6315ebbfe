//! What a fit says, in words.

use crate::report::addresses::parameter_words;
use crate::report::quantity::{counted, significant, with_unit};
use crate::report::verdict::{Sort, capitalised};
use crate::studies::identify::{
    Change, Ending, Estimate, FittedSignal, Identification, Misfit, Standing,
};

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
pub(super) fn verdict_words(one: &Estimate, found: &Identification) -> String {
    match one.standing {
        Standing::Determined => "determined".to_owned(),
        Standing::Conditional => format!("only with {} at an end of its range", at_end(found)),
        Standing::AtEnd => "not determined: at an end of its range".to_owned(),
        Standing::Undetermined => "not determined by this record".to_owned(),
        Standing::Ambiguous => "not determined: other values fit as well".to_owned(),
        Standing::NotLinear => "not determined: its standard error does not hold".to_owned(),
        Standing::Misfit => "not determined: the fit does not explain the record".to_owned(),
        Standing::NoFit if found.ending == Ending::Stalled => {
            "not known: the fit ended at a kink".to_owned()
        }
        Standing::NoFit => "not known: no fit converged".to_owned(),
    }
}

/// The numbers at an end of their range.
fn at_end(found: &Identification) -> String {
    let each = found.estimates.iter();
    let held = each.filter(|one| one.standing == Standing::AtEnd);
    let names: Vec<String> = held
        .map(|one| parameter_words(&one.variable.path))
        .collect();
    names.join(", ")
}

/// Sort, headline and what stands below it.
pub(super) fn verdict(found: &Identification) -> (Sort, String, String) {
    let (sort, headline, mut text) = fit_verdict(found);
    if found.complete {
        return (sort, headline, text);
    }
    text = format!(
        "Ended before all {} were done.",
        counted(found.starts_requested, "start")
    );
    (Sort::Unfinished, headline, text)
}

fn fit_verdict(found: &Identification) -> (Sort, String, String) {
    let undetermined: Vec<String> = (found.estimates.iter())
        .filter(|one| !one.is_determined())
        .map(|one| parameter_words(&one.variable.path))
        .collect();
    match (found.ending, &found.misfit, undetermined.as_slice()) {
        (Ending::Converged, Some(misfit), _) => {
            let advice = "A unit, the start of the record, a number that is not sought or a local \
                          minimum may be wrong.";
            (Sort::Numerical, misfit_words(misfit), advice.to_owned())
        }
        (Ending::Converged, None, []) => answered(found),
        (Ending::Converged, None, names) => {
            let names = names.join(", ");
            let headline = format!("The record does not determine {names}.");
            (Sort::Numerical, headline, String::new())
        }
        (Ending::Stalled, ..) => {
            let headline = "The fit ended at a kink or a jump of its residuals.".to_owned();
            let text = "No step lowers the residuals, though their slopes say so. Standard \
                        errors do not hold there.";
            (Sort::Numerical, headline, text.to_owned())
        }
        (Ending::MostSteps | Ending::NoResiduals, ..) => {
            let headline = "The fit did not converge.".to_owned();
            (Sort::Numerical, headline, String::new())
        }
        (Ending::Interrupted, ..) => (Sort::Unfinished, "No fit ended.".to_owned(), String::new()),
    }
}

/// The verdict on a fit that determines all numbers.
fn answered(found: &Identification) -> (Sort, String, String) {
    let agreement = format!(
        "{} of {} ended there.",
        counted(found.starts_at_best(), "start"),
        found.starts.len()
    );
    let hold = found.is_random() && !is_above_sigma(found);
    let (sort, more) = match (hold, found.starts_at_best()) {
        (true, 2..) => (Sort::Good, ""),
        (true, _) => (
            Sort::Recommended,
            " No other start confirms it: use more `--starts`.",
        ),
        (false, _) => (
            Sort::Recommended,
            " The model has errors that the standard errors do not contain.",
        ),
    };
    let headline = estimates_headline(found, hold);
    (sort, headline, format!("{agreement}{more}"))
}

/// Whether the residuals are too great for their stated standard deviations.
pub(super) fn is_above_sigma(found: &Identification) -> bool {
    found.chi_squared.is_some_and(|own| own.is_improbable())
}

fn misfit_words(misfit: &Misfit) -> String {
    let left = match misfit {
        Misfit::AboveSigma { column, ratio } => format!(
            "the residuals of `{column}` are {} times its σ",
            significant(*ratio, FEW)
        ),
        Misfit::Unexplained { column, share } if share.is_finite() => format!(
            "{} % of the variation of `{column}` are left",
            significant(100.0 * share, FEW)
        ),
        Misfit::Unexplained { column, .. } => {
            format!("`{column}` is constant, and the fit is not")
        }
    };
    format!("The fit does not explain the record: {left}.")
}

/// What χ² says beside stated standard deviations.
pub(super) fn chi_squared_words(found: &Identification) -> Option<String> {
    let own = found.chi_squared.filter(|_| found.misfit.is_none())?;
    let ratio = significant(own.ratio(), FEW);
    match own.is_improbable() {
        true => Some(format!(
            "The residuals are {ratio} times the stated σ. A right model has a χ² as great with a \
             probability of {}.",
            significant(own.probability, FEW)
        )),
        false => None,
    }
}

/// Rows that stand out from all others.
pub(super) fn outlier_words(found: &Identification) -> Vec<String> {
    let one = |one: &FittedSignal| {
        let worst = one
            .outliers
            .iter()
            .max_by(|own, other| own.1.total_cmp(&other.1));
        let (row, ratio) = worst.filter(|_| found.misfit.is_none())?;
        Some(format!(
            "{} of `{}` in `{}` stand out. The farthest is at {}, {} times the usual residual \
             away. Least squares follow such rows.",
            counted(one.outliers.len(), "row"),
            one.column,
            one.record,
            with_unit(one.times[*row], "s", DIGITS),
            significant(*ratio, FEW)
        ))
    };
    found.signals.iter().filter_map(one).collect()
}

/// The estimates, with their standard errors if these hold.
fn estimates_headline(found: &Identification, hold: bool) -> String {
    let one = |one: &Estimate| {
        let [value, error] = estimate_words(one)?;
        let name = parameter_words(&one.variable.path);
        Some(match hold {
            true => format!("{name} {value} (± {error})"),
            false => format!("{name} {value}"),
        })
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
    let shown = found.correlated.iter().filter(|_| found.misfit.is_none());
    shown.map(one).collect()
}
