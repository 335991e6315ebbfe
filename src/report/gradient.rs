//! Derivatives of results, as data.

use crate::report::addresses::{parameter_words, result_words};
use crate::report::csv::{Field, Rows};
use crate::report::findings::{Cell, Findings, Item, Section, Source, Table};
use crate::report::quantity::{counted, significant, with_unit};
use crate::report::verdict::{Sort, Verdict, capitalised};
use crate::studies::gradient::{
    Derivative, DerivativeVerdict, FigureGradient, Gradient, Parameter, sides, unit_of,
};

/// Digits of derivatives.
const DIGITS: usize = 7;
/// Digits of what is less important.
const FEW: usize = 3;
/// Elasticity above which a result is told to be sensitive.
const SENSITIVE: f64 = 1e6;

/// The derivatives, what each is worth, and how they were checked.
pub fn findings<'a>(scene: &str, found: &Gradient, source: Source<'a>) -> Findings<'a> {
    let mut sections = vec![Section::new("Derivatives").table(derivatives_table(found))];
    let notes = notes(found);
    if !notes.is_empty() {
        sections.push(Section::new("").item(Item::Notes(notes)));
    }
    let (sort, headline, text) = verdict(found);
    let parameters = found
        .parameters
        .iter()
        .map(|one| parameter_words(&one.path));
    Findings {
        title: scene.to_owned(),
        subtitle: format!(
            "derivatives by {}",
            parameters.collect::<Vec<_>>().join(", ")
        ),
        answer: Some(Verdict::answer(sort, headline, text)),
        warnings: Vec::new(),
        sections,
        source,
    }
}

/// The pairs of results and parameters.
fn pairs(found: &Gradient) -> impl Iterator<Item = (&FigureGradient, &Parameter, &Derivative)> {
    found.figures.iter().flat_map(|figure| {
        let by = found.parameters.iter().zip(&figure.by);
        by.map(move |(parameter, own)| (figure, parameter, own))
    })
}

fn verdict(found: &Gradient) -> (Sort, String, String) {
    let undetermined = pairs(found)
        .filter(|one| matches!(one.2.verdict, DerivativeVerdict::NotDetermined { .. }))
        .count();
    let known = pairs(found)
        .filter(|one| one.2.derivative.is_some())
        .count();
    let strongest = pairs(found)
        .filter_map(|one| Some((one, one.2.elasticity?)))
        .max_by(|a, b| a.1.abs().total_cmp(&b.1.abs()));
    let headline = match strongest {
        Some(((figure, parameter, _), elasticity)) => format!(
            "One percent more {} changes the {} by {} %.",
            parameter_words(&parameter.path),
            result_words(&figure.figure),
            significant(elasticity, FEW)
        ),
        None => format!("{} found.", capitalised(&counted(known, "derivative"))),
    };
    if undetermined > 0 {
        let text = format!("{} not determined.", counted(undetermined, "derivative"));
        return (Sort::Numerical, headline, text);
    }
    let text = match &found.check {
        Some(check) if check.compared > 0 => format!(
            "Differences of runs confirm {} to {}.",
            counted(check.compared, "derivative"),
            significant(check.worst, 2)
        ),
        _ => "Not compared with differences of runs.".to_owned(),
    };
    (Sort::Good, headline, text)
}

fn derivatives_table(found: &Gradient) -> Table {
    let row = |(figure, parameter, own): (&FigureGradient, &Parameter, &Derivative)| {
        let unit = unit_of(&figure.unit, &parameter.unit);
        let stands = matches!(own.verdict, DerivativeVerdict::Exact);
        let number = |value: Option<f64>| {
            let words = |value: f64| significant(value, FEW);
            Cell::from(value.map_or_else(|| "–".to_owned(), words))
        };
        vec![
            Cell::result(&figure.figure),
            Cell::address(&parameter.path, parameter_words(&parameter.path)),
            Cell::from(in_unit(own, &unit)),
            number(own.elasticity),
            Cell::from(own.verdict.name()).with_outcome(stands.then_some(true)),
            number(own.agrees_to),
            Cell::from(match own.sequence_changes_at {
                Some(value) => with_unit(value, &parameter.unit, FEW + 2),
                None => "–".to_owned(),
            }),
        ]
    };
    let heads = [
        "result",
        "by",
        ">derivative",
        ">elasticity",
        "verdict",
        ">agrees to",
        ">events change at",
    ];
    Table::new(heads).rows(pairs(found).map(row))
}

/// A derivative with its unit; of one that differs on the two sides both.
fn in_unit(own: &Derivative, unit: &str) -> String {
    let number = |value: f64| {
        format!("{} {unit}", significant(value, DIGITS))
            .trim_end()
            .to_owned()
    };
    let side = |value: Option<f64>| value.map_or_else(|| "–".to_owned(), number);
    match &own.verdict {
        DerivativeVerdict::OneSided { below, above } => {
            format!("below {}, above {}", side(*below), side(*above))
        }
        _ => side(own.derivative),
    }
}

/// Reasons, and what the derivatives hold for.
fn notes(found: &Gradient) -> Vec<String> {
    let mut notes = Vec::new();
    for (figure, parameter, own) in pairs(found) {
        let why = own.verdict.why();
        if !why.is_empty() {
            notes.push(format!(
                "`{}` by `{}`: {}, since {why}.",
                figure.figure,
                parameter.path,
                own.verdict.name()
            ));
        }
    }
    for (figure, parameter, own) in pairs(found) {
        if own.elasticity.is_some_and(|one| one.abs() > SENSITIVE) {
            notes.push(format!(
                "`{}` is sensitive to `{}`: its condition number is {}.",
                figure.figure,
                parameter.path,
                significant(own.elasticity.map_or(0.0, f64::abs), 2)
            ));
        }
    }
    if found.events > 0 {
        notes.push(format!(
            "The derivatives are carried through {}. They hold while the sequence of events stays the \
             same. The table shows the nearest value, to first order, at which it changes.",
            counted(found.events, "event")
        ));
    }
    if let Some(check) = &found.check {
        notes.push(match check.why_not.as_str() {
            "" => format!(
                "The check compared {} with differences of {}.",
                counted(check.compared, "derivative"),
                counted(check.runs, "run")
            ),
            why => format!("Nothing was compared with differences of runs: {why}."),
        });
    }
    notes
}

/// One row a pair of result and parameter.
pub fn rows(found: &Gradient) -> Rows {
    let heads = [
        "figure",
        "value",
        "by",
        "at",
        "derivative",
        "unit",
        "elasticity",
        "verdict",
        "below",
        "above",
        "agrees_to",
        "sequence_changes_at",
        "why",
    ];
    let row = |(figure, parameter, own): (&FigureGradient, &Parameter, &Derivative)| {
        let [below, above] = sides(&own.verdict);
        let cells: [Field; 13] = [
            figure.figure.as_str().into(),
            figure.value.into(),
            parameter.path.as_str().into(),
            parameter.value.into(),
            own.derivative.into(),
            unit_of(&figure.unit, &parameter.unit).into(),
            own.elasticity.into(),
            own.verdict.name().into(),
            below.into(),
            above.into(),
            own.agrees_to.into(),
            own.sequence_changes_at.into(),
            own.verdict.why().into(),
        ];
        cells
    };
    Rows::new(heads, pairs(found).map(row))
}
