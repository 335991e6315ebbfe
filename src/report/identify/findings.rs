//! The estimates, how sure they are, and what is left of the records.

use super::charts::charts;
use super::words::{
    DIGITS, FEW, chi_squared_words, correlation_words, direction_words, estimate_words, in_unit,
    outlier_words, verdict, verdict_words,
};
use crate::report::addresses::parameter_words;
use crate::report::findings::{Cell, Findings, Item, Layout, Section, Source, Table};
use crate::report::quantity::{counted, significant, with_unit};
use crate::report::verdict::{Verdict, capitalised};
use crate::studies::identify::{Ending, Estimate, FittedSignal, Identification, StartResult};

/// Digits of values at starts.
const AT_STARTS: usize = 5;
/// Digits of residuals of starts.
const RESIDUAL: usize = 7;

/// The answer as sections.
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
    sections.retain(|section| !section.is_empty());
    let (sort, headline, text) = verdict(found);
    let remarks = found.remarks.iter();
    Findings {
        title: scene.to_owned(),
        subtitle: format!("{} from records", counted(found.estimates.len(), "number")),
        answer: Some(Verdict::answer(sort, headline, text)),
        warnings: remarks.map(|one| capitalised(one) + ".").collect(),
        sections,
        source,
    }
}

fn estimates_table(found: &Identification) -> Table {
    let row = |one: &Estimate| {
        let unknown = || ["–".to_owned(), "–".to_owned()];
        let [value, error] = estimate_words(one).unwrap_or_else(unknown);
        vec![
            Cell::address(&one.variable.path, parameter_words(&one.variable.path)),
            Cell::from(value),
            Cell::from(error),
            Cell::from(in_unit(one.given, one, DIGITS)),
            Cell::from(verdict_words(one, found)).with_outcome(Some(one.is_determined())),
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
        let (runs, random) = match &one.test {
            _ if one.is_exact => ("–".to_owned(), "none but errors of runs"),
            Some(test) => {
                let expected = significant(test.expected, FEW);
                let random = if test.is_random() {
                    "random"
                } else {
                    "not random"
                };
                (format!("{} of {expected} expected", test.runs), random)
            }
            None => ("–".to_owned(), "of one sign"),
        };
        vec![
            Cell::from(one.record.as_str()),
            Cell::from(one.column.as_str()),
            Cell::from(one.address.as_str()),
            Cell::from(one.times.len().to_string()),
            Cell::from(with_unit(one.rms(), &one.unit, FEW)),
            Cell::from(runs),
            Cell::from(random).with_outcome(Some(one.is_random())),
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
    // (Without σ all columns have one unit.)
    let mut columns = found.signals.iter();
    let unit = columns
        .find(|one| one.sigma.is_none())
        .map(|one| one.unit.as_str());
    let row = |one: &StartResult| {
        let values = |all: &[f64]| {
            let each = all.iter().zip(&found.estimates);
            each.map(|(value, own)| in_unit(*value, own, AT_STARTS))
                .collect::<Vec<_>>()
                .join(", ")
        };
        let ending = match one.ending {
            Ending::Converged if one.is_rival => "converged, as good as the best",
            Ending::Converged => "converged",
            Ending::Stalled => "at a kink or a jump",
            Ending::MostSteps => "after the most steps",
            Ending::NoResiduals => "cannot be run",
            Ending::Interrupted => "ended from outside",
        };
        let is_good = one.ending == Ending::Converged && !one.is_rival;
        let rms = |rms| match unit {
            None => significant(rms, RESIDUAL),
            Some(unit) => with_unit(rms, unit, RESIDUAL),
        };
        vec![
            Cell::from(values(&one.start)),
            Cell::from(values(&one.end)),
            Cell::from(one.rms.map_or("–".to_owned(), rms)),
            Cell::from(ending).with_outcome(Some(is_good)),
        ]
    };
    let residuals = match unit {
        None => ">residuals over σ (rms)",
        Some(_) => ">residuals (rms)",
    };
    let heads = [">start", ">end", residuals, "ended"];
    Table::new(heads).rows(found.starts.iter().map(row))
}

fn notes(found: &Identification) -> Vec<String> {
    let directions = found.open_directions.iter();
    let mut notes: Vec<String> = directions.map(|own| direction_words(own)).collect();
    notes.extend(correlation_words(found));
    notes.extend(chi_squared_words(found));
    notes.extend(outlier_words(found));
    if found.ending == Ending::Converged && !found.is_random() {
        let words = "Residuals that are not random contain errors of the model. The standard \
                     errors do not contain these.";
        notes.push(words.to_owned());
    }
    if !found.settings.is_empty() {
        let settings = found.settings.iter();
        let settings: Vec<String> = settings.map(|one| format!("--set \"{one}\"")).collect();
        notes.push(format!(
            "For the scene with the estimates: `{}`.",
            settings.join(" ")
        ));
    }
    notes
}
