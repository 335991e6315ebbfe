//! Numbers of a scene from records, as data.

use crate::report::addresses::parameter_words;
use crate::report::csv::{Field, Rows};
use crate::report::findings::{Cell, Findings, Item, Layout, Section, Source, Table};
use crate::report::plot::{Axis, Plot, Series};
use crate::report::quantity::{counted, significant, with_unit};
use crate::report::verdict::{Sort, Verdict, capitalised};
use crate::studies::identify::{Ending, Estimate, FittedSignal, Identification, StartResult};

/// Digits of estimates.
const DIGITS: usize = 9;
/// Digits of errors.
const FEW: usize = 3;

/// The estimates, how sure they are, and what is left of the records.
pub fn findings<'a>(scene: &str, found: &Identification, source: Source<'a>) -> Findings<'a> {
    let mut sections = vec![
        Section::new("Estimates").table(estimates_table(found)),
        Section::new("Signals").table(signals_table(found)),
    ];
    for signal in &found.signals {
        sections.push(Section::default().charts(Layout::Grid, "t", charts(signal)));
    }
    sections.push(Section::new("Starts").table(starts_table(found)));
    sections.push(Section::default().item(Item::Notes(notes(found))));
    let (sort, headline, text) = verdict(found);
    Findings {
        title: scene.to_owned(),
        subtitle: format!("{} from a record", counted(found.estimates.len(), "number")),
        answer: Some(Verdict::answer(sort, headline, text)),
        warnings: found
            .remarks
            .iter()
            .map(|one| capitalised(one) + ".")
            .collect(),
        sections,
        source,
    }
}

fn in_unit(value: f64, one: &Estimate, digits: usize) -> String {
    let number = significant(value, digits);
    format!("{number} {}", one.unknown.unit)
        .trim_end()
        .to_owned()
}

/// An estimate with as many digits as its error leaves.
fn estimate_words(one: &Estimate) -> String {
    let digits = one.error.map_or(FEW, |error| {
        let ratio = (one.value / error).abs().log10().ceil();
        if ratio.is_finite() {
            (ratio as usize + 2).clamp(FEW, DIGITS)
        } else {
            DIGITS
        }
    });
    in_unit(one.value, one, digits)
}

fn verdict(found: &Identification) -> (Sort, String, String) {
    let undetermined: Vec<String> = found
        .estimates
        .iter()
        .filter(|one| !one.is_determined())
        .map(|one| parameter_words(&one.unknown.path))
        .collect();
    let words = found.estimates.first().map_or_else(String::new, |one| {
        let error = one
            .error
            .map_or("–".to_owned(), |error| in_unit(error, one, FEW));
        let name = capitalised(&parameter_words(&one.unknown.path));
        format!(
            "{name} is {} with a standard error of {error}.",
            estimate_words(one)
        )
    });
    match (found.ending, undetermined.as_slice()) {
        (Ending::Converged, []) => {
            let text = format!(
                "{} of {} ended there.",
                counted(found.starts_at_best(), "start"),
                found.starts.len()
            );
            (Sort::Good, words, text)
        }
        (Ending::Converged, names) => {
            let headline = format!("The record does not determine {}.", names.join(", "));
            (Sort::Numerical, headline, String::new())
        }
        (Ending::MostSteps | Ending::NoResiduals, _) => {
            let headline = "The fit did not converge.".to_owned();
            (Sort::Numerical, headline, String::new())
        }
    }
}

fn estimates_table(found: &Identification) -> Table {
    let row = |one: &Estimate| {
        let verdict = match (one.is_determined(), one.at_bound) {
            (true, _) => "determined",
            (false, true) => "at the end of its range",
            (false, false) => "not determined by this record",
        };
        let error = one
            .error
            .map_or("–".to_owned(), |error| in_unit(error, one, FEW));
        vec![
            Cell::address(&one.unknown.path, parameter_words(&one.unknown.path)),
            Cell::from(estimate_words(one)),
            Cell::from(error),
            Cell::from(in_unit(one.unknown.given, one, DIGITS)),
            Cell::from(verdict).with_outcome(Some(one.is_determined())),
        ]
    };
    let heads = [
        "number",
        ">estimate",
        ">standard error",
        ">in the scene",
        "verdict",
    ];
    Table::new(heads).rows(found.estimates.iter().map(row))
}

fn signals_table(found: &Identification) -> Table {
    let row = |one: &FittedSignal| {
        let squares: f64 = one.residuals.iter().map(|own| own * own).sum();
        let rms = one.weight * (squares / one.residuals.len().max(1) as f64).sqrt();
        let (runs, random) = match &one.test {
            Some(test) => (
                format!(
                    "{} of {} expected",
                    test.runs,
                    significant(test.expected, FEW)
                ),
                if test.is_random() {
                    "random"
                } else {
                    "not random"
                },
            ),
            None => ("–".to_owned(), "of one sign"),
        };
        let good = one.test.is_some_and(|test| test.is_random());
        vec![
            Cell::from(one.record.as_str()),
            Cell::from(one.column.as_str()),
            Cell::from(one.address.as_str()),
            Cell::from(one.times.len().to_string()),
            Cell::from(with_unit(rms, &one.unit, FEW)),
            Cell::from(runs),
            Cell::from(random).with_outcome(Some(good)),
        ]
    };
    let heads = [
        "record",
        "column",
        "signal",
        ">rows",
        ">residuals (rms)",
        ">runs of signs",
        "residuals",
    ];
    Table::new(heads).rows(found.signals.iter().map(row))
}

fn starts_table(found: &Identification) -> Table {
    let row = |one: &StartResult| {
        let values = |all: &[f64]| {
            let each = all.iter().zip(&found.estimates);
            each.map(|(value, own)| in_unit(*value, own, 5))
                .collect::<Vec<_>>()
                .join(", ")
        };
        let ending = match one.ending {
            Ending::Converged => "converged",
            Ending::MostSteps => "after the most steps",
            Ending::NoResiduals => "cannot be run",
        };
        vec![
            Cell::from(values(&one.start)),
            Cell::from(values(&one.end)),
            Cell::from(one.rms.map_or("–".to_owned(), |rms| significant(rms, 7))),
            Cell::from(ending).with_outcome(Some(one.ending == Ending::Converged)),
        ]
    };
    Table::new([">start", ">end", ">residuals (rms)", "ended"]).rows(found.starts.iter().map(row))
}

/// The record with the fit, and the residuals.
fn charts(signal: &FittedSignal) -> Vec<Plot> {
    let over = |value: &dyn Fn(usize) -> f64| -> Vec<(f64, f64)> {
        (0..signal.times.len())
            .map(|at| (signal.times[at], value(at)))
            .collect()
    };
    let residual =
        |at: usize| signal.weight * signal.residuals.get(at).copied().unwrap_or(f64::NAN);
    let fit = Series::line("fit", over(&|at| signal.measured[at] + residual(at)));
    let record = Series::theory("record", over(&|at| signal.measured[at]));
    let time = || Axis::new("t", "s");
    let name = format!("{}, {}", signal.address, signal.record);
    let mut both = Plot::new(name, time(), &signal.unit, vec![fit, record]);
    both.id = format!("{}.{}.fit", signal.record, signal.address);
    let left = Series::line("", over(&residual));
    let mut rest = Plot::new(
        "Residuals: fit less record",
        time(),
        &signal.unit,
        vec![left],
    );
    rest.id = format!("{}.{}.residuals", signal.record, signal.address);
    vec![both, rest]
}

fn notes(found: &Identification) -> Vec<String> {
    let mut notes = Vec::new();
    for (one, other, value) in &found.correlated {
        let name = |at: usize| parameter_words(&found.estimates[at].unknown.path);
        notes.push(format!(
            "The {} and the {} have a correlation of {}: the record determines only a combination of \
             both.",
            name(*one),
            name(*other),
            significant(*value, FEW)
        ));
    }
    if found
        .signals
        .iter()
        .any(|one| one.test.is_none_or(|test| !test.is_random()))
    {
        let words = "Residuals that are not random have errors of the model in them. The standard \
                     errors do not contain these.";
        notes.push(words.to_owned());
    }
    let settings: Vec<String> = found
        .estimates
        .iter()
        .map(|one| format!("--set \"{}\"", one.setting()))
        .collect();
    notes.push(format!(
        "For the scene with the estimates: `{}`.",
        settings.join(" ")
    ));
    notes
}

/// One row a time of a signal.
pub fn rows(found: &Identification) -> Rows {
    let heads = [
        "record", "signal", "t [s]", "measured", "fit", "residual", "unit",
    ];
    let each = found.signals.iter().flat_map(|one| {
        (0..one.times.len()).map(move |at| {
            let residual = one.weight * one.residuals[at];
            let cells: [Field; 7] = [
                one.record.as_str().into(),
                one.address.as_str().into(),
                one.times[at].into(),
                one.measured[at].into(),
                (one.measured[at] + residual).into(),
                residual.into(),
                one.unit.as_str().into(),
            ];
            cells
        })
    });
    Rows::new(heads, each)
}
