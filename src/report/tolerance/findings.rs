//! What a study of tolerances found.

use super::charts::charts;
use super::{by_effect, heading};
use crate::report::addresses::{condition_words, parameter_words, result_words};
use crate::report::findings::{Cell, Figure, Findings, Item, Layout, Section, Source, Table};
use crate::report::quantity::{counted, significant, with_unit};
use crate::report::verdict::{Sort, Verdict, capitalised};
use crate::studies::tolerance::{
    Dimension, Distribution, Effect, Estimate, Failure, FigureTolerance, Indices, LEVEL,
    SlopeSource, Tolerances, Yield,
};

/// Digits of results.
const DIGITS: usize = 7;
/// Digits of spreads.
const FEW: usize = 4;
/// Difference of a worst case of runs from that of first order, as a share of its reach, beyond which
/// the latter does not hold.
const NOT_LINEAR: f64 = 0.1;

/// The tolerance of every result, what makes it, and how many samples meet the limits.
pub fn findings<'a>(scene: &str, found: &Tolerances, source: Source<'a>) -> Findings<'a> {
    let (sort, headline, text) = verdict(found);
    let mut sections = Vec::new();
    if !found.limits.is_empty() {
        sections.push(Section::new("Limits").table(limits_table(found)));
    }
    for number in 0..found.figures.len() {
        sections.extend(figure_sections(found, number));
    }
    sections.push(Section::new("Tolerances").table(dimensions_table(&found.dimensions)));
    if !found.failures.is_empty() {
        sections.push(Section::new("Failed samples").table(failures_table(found)));
    }
    sections.push(Section::default().item(Item::Notes(notes(found))));
    Findings {
        title: scene.to_owned(),
        subtitle: format!("tolerance of {}", counted(found.figures.len(), "result")),
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

fn verdict(found: &Tolerances) -> (Sort, String, String) {
    let sort = match (found.complete, found.is_answered()) {
        (false, _) => Sort::Unfinished,
        (true, false) => Sort::Numerical,
        (true, true) => Sort::Good,
    };
    let open = if found.complete {
        ""
    } else {
        "Ended before the last sample."
    };
    let first = found.figures.first();
    let (headline, text) = match (found.of_all.filter(|_| !found.limits.is_empty()), first) {
        (Some(all), _) => {
            let limits = counted(found.limits.len(), "limit");
            let headline = match found.limits.len() {
                1 => format!(
                    "{} of the samples meet the limit.",
                    percent(all.share.value)
                ),
                _ => format!(
                    "{} of the samples meet all {limits}.",
                    percent(all.share.value)
                ),
            };
            (headline, interval_words(&all))
        }
        (None, Some(figure)) => (spread_words(figure), cause_words(found, figure)),
        (None, None) => (String::new(), String::new()),
    };
    let text = [text.as_str(), open].join(" ");
    (sort, headline, text.trim().to_owned())
}

/// A share in percent.
fn percent(share: f64) -> String {
    format!("{} %", significant(100.0 * share, FEW))
}

fn interval_words(all: &Yield) -> String {
    let [from, to] = all.share.within.map(percent);
    format!(
        "The share lies between {from} and {to} with {} confidence, by {} samples.",
        percent(LEVEL),
        all.samples
    )
}

fn spread_words(figure: &FigureTolerance) -> String {
    let words = heading(&figure.figure);
    let value = |value: f64| with_unit(value, &figure.unit, DIGITS);
    if let Some([least, greatest]) = runs_beside_first_order(figure) {
        return format!(
            "{words} is {} to {} in the worst case of runs. First order does not hold.",
            value(least),
            value(greatest)
        );
    }
    match (&figure.first_order, &figure.spread) {
        (Some(stack), _) => {
            let reach = with_unit(stack.worst_case[1] - stack.mean, &figure.unit, FEW);
            let sigma = with_unit(stack.sigma, &figure.unit, FEW);
            format!(
                "{words} is {} ± {reach} in the worst case, σ = {sigma}.",
                value(stack.mean)
            )
        }
        (None, Some(spread)) => format!(
            "{words} of the samples is {} to {}.",
            value(spread.least),
            value(spread.greatest)
        ),
        (None, None) => format!(
            "{words} is {}.",
            figure.middle.map_or("–".to_owned(), value)
        ),
    }
}

/// The worst case of runs, if that of first order is far from it.
fn runs_beside_first_order(figure: &FigureTolerance) -> Option<[f64; 2]> {
    let stack = figure.first_order.as_ref()?;
    let runs = [figure.extremes[0]?, figure.extremes[1]?];
    let reach = stack.worst_case[1] - stack.mean;
    let is_off = |end: usize| (runs[end] - stack.worst_case[end]).abs() > NOT_LINEAR * reach;
    (is_off(0) || is_off(1)).then_some(runs)
}

/// What contributes most to a result.
fn cause_words(found: &Tolerances, figure: &FigureTolerance) -> String {
    let each = figure.effects.iter().zip(&found.dimensions);
    let shares = each.filter_map(|(effect, one)| Some((effect.contribution?, one)));
    let most = shares.max_by(|a, b| a.0.total_cmp(&b.0));
    most.filter(|(share, _)| *share > 0.0 && found.dimensions.len() > 1)
        .map_or_else(String::new, |(share, one)| {
            format!(
                "{} makes {} of the variance.",
                capitalised(&words_of(one)),
                percent(share)
            )
        })
}

/// The numbers of a dimension in words.
fn words_of(one: &Dimension) -> String {
    let paths = one.paths.iter().map(|path| parameter_words(path));
    paths.collect::<Vec<_>>().join(", ")
}

fn limits_table(found: &Tolerances) -> Table {
    let share = |found: Option<f64>| found.map_or_else(|| "–".to_owned(), percent);
    let mut table = Table::new(["limit", ">by first order", ">samples", ">95 % interval"]);
    let within = |own: Option<Yield>| {
        own.map_or_else(
            || "–".to_owned(),
            |own| own.share.within.map(percent).join(" to "),
        )
    };
    for one in &found.limits {
        let words = condition_words(&one.limit.text, &one.limit.figure);
        table.push([
            Cell::address(&one.limit.text, words),
            Cell::from(share(one.by_first_order)),
            Cell::from(share(one.found.map(|own| own.share.value))),
            Cell::from(within(one.found)),
        ]);
    }
    let rows = [
        (
            "all",
            found
                .of_all
                .filter(|_| found.limits.len() > 1 || !found.failures.is_empty()),
        ),
        (
            "all, without failed samples",
            found.of_run.filter(|_| !found.failures.is_empty()),
        ),
    ];
    for (name, own) in rows {
        if own.is_some() {
            table.push([
                Cell::from(name),
                Cell::from("–"),
                Cell::from(share(own.map(|own| own.share.value))),
                Cell::from(within(own)),
            ]);
        }
    }
    table
}

/// The sections of a result: its spread, what makes it, its charts.
fn figure_sections<'a>(found: &Tolerances, number: usize) -> Vec<Section<'a>> {
    let figure = &found.figures[number];
    let section = Section::new(heading(&figure.figure))
        .figures(spread_figures(figure))
        .table(effects_table(found, number));
    let charts = charts(found, number);
    vec![section.charts(Layout::Grid, "", charts)]
}

/// Samples from which on one lies beyond the quantiles: 1/0.025 and 1/0.00135.
const QUANTILE_FROM: [usize; 2] = [40, 741];

/// The nominal result, and how far all else is from it.
fn spread_figures(figure: &FigureTolerance) -> Vec<Figure> {
    let base = figure.nominal.or(figure.middle).unwrap_or(f64::NAN);
    let signed = |value: f64| {
        let off = value - base;
        let sign = if off > 0.0 { "+" } else { "" };
        format!("{sign}{}", with_unit(off, &figure.unit, FEW))
    };
    let both = |values: [f64; 2]| values.map(signed).join(" to ");
    let spread = |name: &str, value: f64| Figure::number(name, value, &figure.unit, FEW);
    let nominal = Figure::number("nominal", base, &figure.unit, DIGITS);
    let mut all = vec![nominal.with_note("from which all others are deviations")];
    if let Some(middle) = figure.middle.filter(|_| figure.middle != figure.nominal) {
        all.push(Figure::new("middle", signed(middle)).with_note("of all tolerance zones"));
    }
    if let Some(stack) = &figure.first_order {
        all.push(Figure::new("worst case", both(stack.worst_case)).with_note("by first order"));
    }
    if let [Some(least), Some(greatest)] = figure.extremes {
        let note = "by runs with every number in the middle or at a limit";
        all.push(Figure::new("worst case", both([least, greatest])).with_note(note));
    }
    if let Some(stack) = &figure.first_order {
        all.push(spread("σ", stack.sigma).with_note("by first order"));
    }
    if let Some(shift) = figure.mean_shift {
        all.push(spread("mean shift", shift).with_note("by second order"));
    }
    if let Some(own) = &figure.spread {
        let within = both(own.mean.within);
        let note = format!(
            "of {}; 95 % interval {within}",
            counted(own.count, "sample")
        );
        all.push(Figure::new("mean", signed(own.mean.value)).with_note(note));
        all.push(spread("σ", own.sigma).with_note("of the samples"));
        let central = [own.quantiles[1], own.quantiles[3]];
        if own.count >= QUANTILE_FROM[0] {
            all.push(Figure::new("95 % of the samples", both(central)));
        }
        let wide = [own.quantiles[0], own.quantiles[4]];
        if own.count >= QUANTILE_FROM[1] {
            all.push(Figure::new("99.73 % of the samples", both(wide)));
        }
    }
    all
}

fn effects_table(found: &Tolerances, number: usize) -> Table {
    let figure = &found.figures[number];
    let heads = [
        "number",
        ">derivative",
        "from",
        ">share of variance",
        ">at lower limit",
        ">at upper limit",
        ">first index",
        ">total index",
    ];
    let change = |value: Option<f64>| {
        let words = |value: f64, middle: f64| {
            let change = value - middle;
            let is_rounding = change.abs() <= 8.0 * f64::EPSILON * middle.abs();
            with_unit(if is_rounding { 0.0 } else { change }, &figure.unit, FEW)
        };
        let known = value.zip(figure.middle);
        known.map_or_else(|| "–".to_owned(), |(value, middle)| words(value, middle))
    };
    let row = |at: usize| {
        let (one, effect) = (&found.dimensions[at], &figure.effects[at]);
        let derivative = effect.derivative.map_or_else(
            || "–".to_owned(),
            |slope| significant(slope, derivative_digits(effect)),
        );
        let index = |pick: fn(&Indices) -> &Estimate| {
            effect
                .indices
                .as_ref()
                .map_or_else(|| "–".to_owned(), |own| index_words(pick(own)))
        };
        vec![
            Cell::address(&one.name(), words_of(one)),
            Cell::from(derivative),
            Cell::from(match effect.source {
                Some(SlopeSource::Exact) => "exact",
                Some(SlopeSource::Differences) => "differences",
                None => "–",
            }),
            Cell::from(effect.contribution.map_or_else(|| "–".to_owned(), percent)),
            Cell::from(change(effect.limits.lower)),
            Cell::from(change(effect.limits.upper))
                .with_outcome(effect.not_linear.is_some().then_some(false)),
            Cell::from(index(|own| &own.first)),
            Cell::from(index(|own| &own.total)),
        ]
    };
    Table::new(heads).rows(by_effect(found, number).into_iter().map(row))
}

/// Digits of a derivative that its error leaves.
fn derivative_digits(effect: &Effect) -> usize {
    let relative = effect
        .error
        .zip(effect.derivative)
        .map(|(error, slope)| error / slope.abs());
    match relative {
        Some(relative) if relative > 0.0 => {
            let digits = (-relative.log10()).floor();
            (digits.clamp(1.0, DIGITS as f64)) as usize
        }
        _ => DIGITS,
    }
}

/// An index with its interval; one that may be 0 has a bound alone.
fn index_words(own: &Estimate) -> String {
    match own.bound() {
        Some(bound) => format!("≤ {}", significant(bound, 2)),
        None => {
            let [from, to] = own.within.map(|end| significant(end, 3));
            format!("{} ({from} to {to})", significant(own.value, 3))
        }
    }
}

fn dimensions_table(dimensions: &[Dimension]) -> Table {
    let row = |one: &Dimension| {
        let nominal: Vec<String> = one
            .nominal
            .iter()
            .map(|value| with_unit(*value, &one.unit, DIGITS))
            .collect();
        let limit = |value: f64| with_unit(value, &one.unit, FEW);
        vec![
            Cell::address(&one.name(), words_of(one)),
            Cell::from(nominal.join(", ")),
            Cell::from(limit(one.zone.lower)),
            Cell::from(limit(one.zone.upper)),
            Cell::from(match one.zone.distribution {
                Distribution::Normal => "normal, 3 σ",
                Distribution::Uniform => "uniform",
            }),
            Cell::from(limit(one.zone.sigma())),
        ]
    };
    let heads = [
        "number",
        ">nominal",
        ">lower",
        ">upper",
        "distribution",
        ">σ",
    ];
    Table::new(heads).rows(dimensions.iter().map(row))
}

fn failures_table(found: &Tolerances) -> Table {
    let row = |one: &Failure| {
        vec![
            Cell::from(one.verdict.words()),
            Cell::from(one.count.to_string()),
            Cell::from(one.cause.clone()),
        ]
    };
    Table::new(["verdict", ">samples", "~cause"]).rows(found.failures.iter().map(row))
}

/// What first order does not tell, and how the samples were made.
fn notes(found: &Tolerances) -> Vec<String> {
    let mut notes = Vec::new();
    for figure in &found.figures {
        let each = figure.effects.iter().zip(&found.dimensions);
        for (effect, one) in each {
            let Some(rest) = &effect.not_linear else {
                continue;
            };
            let value = |value: f64| with_unit(value, &figure.unit, FEW);
            notes.push(format!(
                "The {} is not linear in the {}: first order says {}, it is {}.",
                result_words(&figure.figure),
                words_of(one),
                value(rest.first_order),
                value(rest.change)
            ));
        }
        if figure.first_order.is_none() {
            let why = match figure.middle {
                None => "it has no value in the middle of the tolerances",
                Some(_) => "a derivative is not known",
            };
            notes.push(format!(
                "The {} has no stack: {why}.",
                result_words(&figure.figure)
            ));
        }
    }
    let differences = |effect: &Effect| effect.source == Some(SlopeSource::Differences);
    if found
        .figures
        .iter()
        .flat_map(|one| &one.effects)
        .any(differences)
    {
        let words =
            "Derivatives \"from differences\" are differences of runs within the tolerance.";
        notes.push(words.to_owned());
    }
    if !found.samples.is_empty() {
        notes.push(format!(
            "{} of a scrambled Sobol sequence with seed {}. Intervals are those of independent \
             samples with {} confidence, which are rather too wide.",
            capitalised(&counted(found.samples.len(), "sample")),
            found.seed,
            percent(LEVEL)
        ));
    }
    if found
        .figures
        .iter()
        .flat_map(|one| &one.effects)
        .any(|own| own.indices.is_some())
    {
        let words = "The first index is the share of the variance that a number makes by itself, \
                     the total index that with its interactions. An index that may be 0 has a bound.";
        notes.push(words.to_owned());
    }
    notes
}
