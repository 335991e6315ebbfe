//! Responses to frequencies as findings, as a document and as rows.

use super::left_out_table;
use crate::report::csv::{Field, Rows};
use crate::report::findings::{Cell, Findings, Layout, Section, Source, Table, Value};
use crate::report::plot::{Axis, Plot, Rule, Series};
use crate::report::quantity::{significant, with_unit};
use crate::report::verdict::{Sort, Verdict, capitalised};
use crate::studies::linear::{FrequencyResponse, PairResponse, ResponsePeak};
use serde_json::{Value as Json, json};

/// Most frequencies whose values stand in a table of the terminal.
const FEW: usize = 24;

/// Digits of results.
const DIGITS: usize = 6;

/// Peaks, values, and up to where the model is right.
pub fn response_findings<'a>(
    scene: &str,
    found: &FrequencyResponse,
    source: Source<'a>,
) -> Findings<'a> {
    let mut sections = vec![Section::new("Peaks").table(peaks_table(found))];
    let error = Section::new("Error of the model").table(error_table(found));
    sections.push(error.with_paragraph(error_words(found)));
    if found.frequencies.len() <= FEW {
        sections.push(Section::new("Values").table(values_table(found)));
    }
    let charts = Section::new("Gain and phase").charts(Layout::Grid, "frequency", charts(found));
    sections
        .push(charts.legend("An upright line is the frequency up to which the model is right."));
    let left_out = left_out_table(&found.left_out);
    sections.push(Section::new("Without linear equations").table(left_out));
    sections.retain(|section| !section.is_empty());
    Findings {
        title: scene.to_owned(),
        subtitle: format!("response to frequencies from {}", range(found)),
        answer: Some(answer(found)),
        warnings: found.warnings.clone(),
        sections,
        source,
    }
}

fn range(found: &FrequencyResponse) -> String {
    let end = |at: Option<&f64>| with_unit(at.copied().unwrap_or(f64::NAN), "Hz", 6);
    format!(
        "{} to {}",
        end(found.frequencies.first()),
        end(found.frequencies.last())
    )
}

/// The highest peak of the first pair that has one, and up to where the model is right.
fn answer(found: &FrequencyResponse) -> Verdict {
    let highest = |pair: &PairResponse| {
        let gain = |peak: &ResponsePeak| peak.gain.unwrap_or(f64::INFINITY);
        let peaks = pair.peaks.iter().copied();
        peaks.max_by(|a, b| gain(a).total_cmp(&gain(b)))
    };
    let first = found
        .pairs
        .iter()
        .find_map(|pair| Some((pair, highest(pair)?)));
    let headline = match first {
        Some((pair, peak)) => {
            let gain = match peak.gain {
                Some(gain) => with_unit(gain, plain_unit(pair), 5),
                None => "unbounded".to_owned(),
            };
            format!(
                "The greatest gain of {} by {} is {gain} at {}.",
                pair.output.name,
                pair.input.name,
                with_unit(peak.frequency, "Hz", 5)
            )
        }
        None => "No gain has a peak at these frequencies.".to_owned(),
    };
    // A peak above the frequency up to which the model is right is none of the machine.
    let is_right = first.is_none_or(|(pair, peak)| {
        pair.right_everywhere
            || pair
                .right_up_to
                .is_some_and(|up_to| peak.frequency <= up_to)
    });
    let sort = match found.warnings.is_empty() && is_right {
        true => Sort::Recommended,
        false => Sort::Numerical,
    };
    let judged = first.map(|(pair, _)| pair).or(found.pairs.first());
    let text = judged.map_or(String::new(), |pair| right_words(found, pair));
    Verdict::answer(sort, headline, text)
}

fn plain_unit(pair: &PairResponse) -> &str {
    match pair.unit.as_str() {
        "1" => "",
        unit => unit,
    }
}

/// Up to where the model of a pair is right.
fn right_words(found: &FrequencyResponse, pair: &PairResponse) -> String {
    let accuracy = format!("{} %", significant(100.0 * found.accuracy, 3));
    match (&found.judged_by.missing, pair.right_up_to) {
        (Some(why), _) => format!("The error of the model is not known: {why}."),
        (None, _) if pair.right_everywhere => {
            format!("The model is right to {accuracy} at all these frequencies.")
        }
        (None, Some(at)) => format!(
            "The model is right to {accuracy} up to {}.",
            with_unit(at, "Hz", 4)
        ),
        (None, None) => format!("The model is right to {accuracy} at none of these frequencies."),
    }
}

fn peaks_table(found: &FrequencyResponse) -> Table {
    let rows = found.pairs.iter().flat_map(|pair| {
        pair.peaks.iter().map(move |peak| {
            let gain = match peak.gain {
                Some(gain) => Value::new(gain, plain_unit(pair), DIGITS),
                None => "unbounded".into(),
            };
            let mode = peak.mode.map(|mode| mode as f64);
            vec![
                Cell::from(pair.output.name.as_str()),
                pair.input.name.as_str().into(),
                Cell::known_number(mode, "", 4),
                Value::new(peak.frequency, "Hz", DIGITS).into(),
                gain.into(),
                Cell::known_number(peak.gain.map(decibel), "dB", 4),
                Cell::known_number(peak.phase.map(f64::to_degrees), "deg", 4),
            ]
        })
    });
    let heads = [
        "output",
        "by",
        ">mode",
        ">frequency",
        ">gain",
        "?>level",
        ">phase",
    ];
    Table::new(heads).rows(rows)
}

/// A gain in decibels, of its SI unit.
fn decibel(gain: f64) -> f64 {
    20.0 * gain.log10()
}

fn error_table(found: &FrequencyResponse) -> Table {
    if found.judged_by.times.is_none() {
        return Table::new(["output", "by", ">right up to"]);
    }
    let row = |pair: &PairResponse| {
        let (right, good) = match (pair.right_everywhere, pair.right_up_to) {
            (true, _) => ("all frequencies".into(), true),
            (false, Some(at)) => (Value::new(at, "Hz", 4), true),
            (false, None) => ("no frequency".into(), false),
        };
        let greatest = pair.error.iter().flatten().copied().fold(0.0, f64::max);
        vec![
            Cell::from(pair.output.name.as_str()),
            pair.input.name.as_str().into(),
            Cell::from(right).with_outcome(Some(good)),
            Value::new(100.0 * greatest, "%", 3).into(),
        ]
    };
    let heads = ["output", "by", ">right up to", ">greatest error"];
    Table::new(heads).rows(found.pairs.iter().map(row))
}

fn error_words(found: &FrequencyResponse) -> String {
    let by = &found.judged_by;
    match (by.times, &by.levels, &by.missing) {
        (Some(times), Some(levels), _) => format!(
            "Errors are those against {times} times the masses: {levels}. A model is right if its \
             error is at most {} %.",
            significant(100.0 * found.accuracy, 3)
        ),
        (_, _, Some(why)) => format!("{}.", capitalised(why)),
        _ => String::new(),
    }
}

fn values_table(found: &FrequencyResponse) -> Table {
    let rows = found.pairs.iter().flat_map(|pair| {
        found
            .frequencies
            .iter()
            .enumerate()
            .map(move |(place, &at)| {
                let gain = match pair.gain[place] {
                    Some(gain) => Value::new(gain, plain_unit(pair), DIGITS),
                    None => "unbounded".into(),
                };
                vec![
                    Cell::from(pair.output.name.as_str()),
                    pair.input.name.as_str().into(),
                    Value::new(at, "Hz", DIGITS).into(),
                    gain.into(),
                    Cell::known_number(pair.phase[place].map(f64::to_degrees), "deg", 4),
                    Cell::known_number(pair.error[place].map(|error| 100.0 * error), "%", 3),
                ]
            })
    });
    let heads = [
        "output",
        "by",
        ">frequency",
        ">gain",
        ">phase",
        "?>model error",
    ];
    Table::new(heads).rows(rows)
}

/// Of each pair the gain and the phase over the frequency.
fn charts(found: &FrequencyResponse) -> Vec<Plot> {
    let axis = || Axis::logarithmic("frequency", "Hz");
    let of = |pair: &PairResponse| {
        let curve = |values: &[Option<f64>], factor: f64| {
            let points = found.frequencies.iter().zip(values);
            let points = points.map(|(at, value)| (*at, factor * value.unwrap_or(f64::NAN)));
            Series::line("", points.collect())
        };
        let right = pair.right_up_to.filter(|_| !pair.right_everywhere);
        let rules: Vec<Rule> = right.map(Rule::upright).into_iter().collect();
        let title = |what: &str| format!("{what} of {} by {}", pair.output.name, pair.input.name);
        let gain = Plot {
            y: Axis::logarithmic("", plain_unit(pair)),
            rules: rules.clone(),
            ..Plot::new(title("Gain"), axis(), "", vec![curve(&pair.gain, 1.0)])
        };
        let phase = vec![curve(&pair.phase, 1f64.to_degrees())];
        let phase = Plot {
            rules,
            ..Plot::new(title("Phase"), axis(), "deg", phase)
        };
        [gain, phase]
    };
    found.pairs.iter().flat_map(of).collect()
}

/// The document.
///
/// # Errors
/// It cannot be written as JSON.
pub fn response_document(
    scene: &str,
    hash: &str,
    found: &FrequencyResponse,
) -> serde_json::Result<Json> {
    let mut document = serde_json::to_value(found)?;
    document["dam"] = json!(1);
    document["scene"] = json!(scene);
    document["hash"] = json!(hash);
    Ok(document)
}

/// A row for each pair and frequency.
pub fn response_rows(found: &FrequencyResponse) -> Rows {
    let head = [
        "output",
        "input",
        "unit",
        "frequency [Hz]",
        "re",
        "im",
        "gain",
        "gain [dB]",
        "phase [rad]",
        "model error",
    ];
    let rows = found.pairs.iter().flat_map(|pair| {
        found
            .frequencies
            .iter()
            .enumerate()
            .map(move |(place, &at)| {
                [
                    Field::from(pair.output.name.as_str()),
                    pair.input.name.as_str().into(),
                    pair.unit.as_str().into(),
                    at.into(),
                    pair.re[place].into(),
                    pair.im[place].into(),
                    pair.gain[place].into(),
                    pair.gain[place].map(decibel).into(),
                    pair.phase[place].into(),
                    pair.error[place].into(),
                ]
            })
    });
    Rows::new(head, rows)
}
