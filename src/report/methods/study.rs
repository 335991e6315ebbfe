//! What a study of methods on one scene found.

use super::charts::{Against, work_precision};
use super::{HEIGHT, TIMING, verdict};
use crate::dynamics::integrate::Method;
use crate::frontend::scene::in_words;
use crate::report::addresses::result_words;
use crate::report::diagram::Diagram;
use crate::report::findings::{Cell, Figure, Findings, Layout, Section, Source, Table, Value};
use crate::report::html::mechanism;
use crate::report::quantity::{significant, with_unit};
use crate::report::sentence::Sentence;
use crate::report::verdict::{Sort, Verdict as Answer, capitalised};
use crate::studies::judgement::Judgement;
use crate::studies::methods::{
    Doubt, GROWN, MethodLine, ModelError, Point, Reference, Study, Verdict,
};

/// Which method to take, speed against accuracy, the models, every point, and the limits of
/// stability.
pub fn findings<'a>(study: &Study, diagram: &'a Diagram, source: Source<'a>) -> Findings<'a> {
    let chart = |heading: &str, against, link| {
        let plot = work_precision(study, against);
        Section::new(heading).charts(Layout::Wide(HEIGHT), link, vec![plot])
    };
    let named = study.methods.iter().map(|line| line.method);
    let mut sections = vec![
        chart("Error against time", Against::Time, "time")
            .legend(TIMING)
            .legend(refused(study)),
        chart(
            "Error against evaluations",
            Against::Evaluations,
            "evaluations",
        ),
        names_section(named),
        match &study.reference {
            Some(found) => Section::new("Reference").figures(reference(study, found)),
            None => no_reference_section(study),
        },
        models_section(study),
        Section::new("Points").table(points_table(study)),
        limits_section(study),
        Section::default().drawing(|plots| mechanism(diagram, plots)),
    ];
    sections.retain(|section| !section.is_empty());
    Findings {
        title: study.scene.clone(),
        subtitle: format!(
            "{} methods on {} of motion; errors of δ relative to max|δ|, the worst object",
            study.methods.len(),
            with_unit(study.duration, "s", 4)
        ),
        answer: Some(answer(study)),
        warnings: warnings(study),
        sections,
        source,
    }
}

/// The names of methods with what they are.
pub(super) fn names_section(all: impl Iterator<Item = Method>) -> Section<'static> {
    let figures = all.map(|method| Figure::new(method.name(), method.words()));
    Section::new("Methods").figures(figures.collect())
}

/// Doubt about the reference and cautions are warnings, in every form of the answer.
fn warnings(study: &Study) -> Vec<String> {
    let doubt = study.doubt.iter();
    let sentence = |doubt: &Doubt| format!("{}.", capitalised(&doubt.sentence()));
    let cautions = study.cautions.iter().cloned();
    doubt.map(sentence).chain(cautions).collect()
}

fn answer(study: &Study) -> Answer {
    let (sort, headline) = match (&study.recommendation.method, &study.doubt) {
        (_, Some(_)) => (Sort::Numerical, "The reference is in doubt.".to_owned()),
        (Some(method), None) => (Sort::Recommended, format!("Take {method}.")),
        (None, None) => (
            Sort::Numerical,
            "No method is known to be accurate enough.".to_owned(),
        ),
    };
    let interrupted = match study.complete {
        true => "",
        false => " INTERRUPTED: points that were not run are missing.",
    };
    let mut text = capitalised(&study.recommendation.text);
    if study.verdict == Judgement::NotJudged {
        text.push_str(". The mechanism is not judged");
    }
    Answer {
        judgement: Some(study.verdict),
        ..Answer::answer(
            sort,
            headline,
            Sentence::read(&format!("{text}.{interrupted}")),
        )
    }
}

/// The methods that no line stands for.
fn refused(study: &Study) -> String {
    let refused = |line: &&MethodLine| {
        let mut points = line.points.iter();
        points.all(|point| point.verdict == Verdict::Refused)
    };
    let names: Vec<&str> = (study.methods.iter().filter(refused))
        .map(|line| line.method.name())
        .collect();
    match names.as_slice() {
        [] => String::new(),
        names => format!("Refused: {}.", names.join(", ")),
    }
}

/// What the errors are taken against, and how far they mean something.
fn reference(study: &Study, reference: &Reference) -> Vec<Figure> {
    let setting = match (reference.tolerance, reference.step) {
        (Some(tolerance), _) => format!(" at tolerance {}", significant(tolerance, 2)),
        (_, Some(step)) => format!(" at a step of {}", with_unit(step, "s", 3)),
        _ => String::new(),
    };
    let kind = match reference.exact {
        true => "no truncation error",
        false => "agrees with a different method",
    };
    let confirmed = reference.confirmed_by.as_ref().map_or_else(
        || "no other method confirms it".to_owned(),
        |pair| format!("{}, {} apart", pair.other, significant(pair.distance, 2)),
    );
    let horizon = match reference.horizon < study.duration * (1.0 - 1e-9) {
        true => format!(
            "up to {}; beyond, NOTHING is judged",
            with_unit(reference.horizon, "s", 6)
        ),
        false => "throughout".to_owned(),
    };
    let words = |name: &str, words: String| Figure::new(name, words);
    let mut rows = vec![
        words("method", format!("{}{setting}: {kind}", reference.method)),
        words("nearest to it", confirmed),
        words(
            "determined",
            format!(
                "{horizon}; loads changed by one part in 10¹⁰ move δ by {} of max|δ|",
                significant(reference.moved, 2)
            ),
        ),
        words(
            "errors are shown down to",
            significant(reference.resolution, 2),
        ),
        words("events", reference.switches.to_string()),
    ];
    if !reference.undetermined.is_empty() {
        let figures = reference.undetermined.join(", ");
        rows.push(words("results not determined to 10⁻⁷", figures));
    }
    rows
}

fn no_reference_section(study: &Study) -> Section<'static> {
    let pairs = study.mutual_distances.iter();
    let row = |pair: &crate::studies::methods::Distance| {
        vec![
            Cell::from(pair.one.as_str()),
            pair.other.as_str().into(),
            Value::new(pair.distance, "", 2).into(),
        ]
    };
    let words = match &study.doubt {
        Some(doubt) => format!("None: {}.", doubt.sentence()),
        None => "None: no two methods agree, and no errors can be known.".to_owned(),
    };
    Section::new("Reference")
        .with_paragraph(words)
        .table(Table::new(["one", "other", ">apart"]).rows(pairs.map(row)))
}

/// The models with their errors; nothing where they were not asked for.
fn models_section(study: &Study) -> Section<'static> {
    let Some(models) = &study.models else {
        return Section::default();
    };
    let row = |model: &ModelError| {
        let role = match (model.levels == models.levels, model.given) {
            (true, true) => "as given; the methods run it",
            (true, false) => "the methods run it",
            (false, true) => "as given",
            (false, false) => "",
        };
        vec![
            Cell::from(in_words(&model.levels)),
            model.coordinates.to_string().into(),
            Value::new(100.0 * model.error, "%", 2).into(),
            role.into(),
        ]
    };
    let table = Table::new(["model", ">coordinates", ">error", ""]);
    Section::new("Models")
        .with_paragraph(
            "Error of max|δ| against the continuum that the objects' data describe, the worst \
             object.",
        )
        .legend("They are the level lines across the charts.")
        .table(table.rows(models.tried.iter().map(row)))
}

fn points_table(study: &Study) -> Table {
    let heads = [
        "method",
        ">setting",
        ">error of δ",
        "?>worst result",
        ">time",
    ];
    let more = [">evaluations", ">steps", ">events", "?>|λ|h", "~verdict"];
    let lines = study.methods.iter();
    let rows = lines.flat_map(|line| line.points.iter().map(|point| row(line, point)));
    Table::new(heads.into_iter().chain(more)).rows(rows)
}

fn row(line: &MethodLine, point: &Point) -> Vec<Cell> {
    let count = |value: Option<u64>| Cell::from(value.map_or("–".to_owned(), |v| v.to_string()));
    let worst = point.worst_figure.as_deref();
    let mut figures = point.figures.iter();
    let worst = figures.find(|figure| Some(figure.figure.as_str()) == worst);
    let error = match (point.is_reference, point.error) {
        (true, Some(error)) => format!("≤ {}", significant(error, 2)).into(),
        (_, error) => Cell::known_number(error, "", 2),
    };
    let cause = match point.is_reference {
        true => "the reference",
        false => &point.cause,
    };
    vec![
        line.method.name().into(),
        match (point.tolerance, point.step) {
            (Some(tolerance), _) => Cell::known_number(Some(tolerance), "", 1),
            (_, step) => Cell::known_number(step, "s", 3),
        },
        error,
        worst.map_or("–".into(), |worst| {
            let error = Value::new(worst.error.unwrap_or(f64::NAN), "", 2);
            Cell::with_note(error, result_words(&worst.figure))
        }),
        Cell::known_number(point.measured_seconds, "s", 3),
        count(point.evaluations),
        count(point.steps),
        count(point.switches),
        Cell::known_number(point.rate_times_step, "", 3),
        verdict(point.verdict, cause),
    ]
}

/// Limits of stability, theory beside measurement.
fn limits_section(study: &Study) -> Section<'static> {
    let row = |line: &MethodLine| {
        let limit = &line.stability;
        let words = limit.place.or(limit.remark)?;
        let degree = limit.degree;
        let degree = degree.map(|degree| format!(", series of degree {degree}"));
        Some(vec![
            line.method.name().into(),
            Cell::known_number(limit.theory, "", 4),
            Cell::known_number(limit.theory_step, "s", 3),
            Cell::known_number(limit.measured, "", 4),
            Cell::known_number(limit.measured_step, "s", 3),
            (words.to_owned() + &degree.unwrap_or_default()).into(),
        ])
    };
    let heads = ["method", ">|λ|h", ">step", ">measured |λ|h", ">step"];
    let table = Table::new(heads.into_iter().chain(["~where λ lies"]));
    Section::new("Limits of stability")
        .with_paragraph(format!(
            "Fastest rate |λ| of the system {} 1/s, all pairs engaged.",
            significant(study.fastest_rate, 4)
        ))
        .legend(format!(
            "In theory, and measured. While a contact is open the motion is slower, so a scene \
             with contact may allow a longer step than theory says. The measured value belongs to \
             this motion. It is the longest step with which this run grows to no more than \
             {GROWN} times what it should be. Slower growth, or growth from another start, is not \
             seen. Of power series: the longest step that multiplies no deviation."
        ))
        .table(table.rows(study.methods.iter().filter_map(row)))
}
