//! Charts of methods: error against time and work, and over a parameter.

use crate::dynamics::integrate::Method;
use crate::frontend::scene::in_words;
use crate::report::addresses::parameter_words;
use crate::report::plot::palette::method_verdicts as colours;
use crate::report::plot::{Axis, Field, Kind, Mark, Plot, Rule, Series, Shape};
use crate::report::quantity::{shortened, significant, with_unit};
use crate::studies::methods::sweep::{MethodStanding, Sweep};
use crate::studies::methods::{MethodLine, ModelError, Point, Study, Verdict, all_methods};
use crate::units::shown;

/// Errors above this are beyond the chart.
const CEILING: f64 = 10.0;

/// All verdicts with their colours, and whether they are failures.
const VERDICTS: [(Verdict, &str, bool); 10] = [
    (Verdict::Converged, colours::CONVERGED, false),
    (Verdict::Inaccurate, colours::INACCURATE, true),
    (Verdict::Unstable, colours::UNSTABLE, true),
    (Verdict::StepFloor, colours::STEP_FLOOR, true),
    (Verdict::SwitchesMissed, colours::SWITCHES_MISSED, true),
    (Verdict::Chatter, colours::CHATTER, true),
    (Verdict::Refused, colours::REFUSED, true),
    (Verdict::GaveUp, colours::GAVE_UP, true),
    (Verdict::TimeLimit, colours::TIME_LIMIT, true),
    (Verdict::NotJudged, colours::NOT_JUDGED, false),
];

/// Abscissa of the errors' chart.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Against {
    /// Median wall-clock time.
    Time,
    /// Evaluations of the right-hand side.
    Evaluations,
}

/// Style of a method, the same colour and shape on every chart.
fn style(method: Method) -> usize {
    let place = all_methods().iter().position(|&known| known == method);
    place.unwrap_or(0)
}

/// Error against time or evaluations, one line a method.
pub fn work_precision(study: &Study, against: Against) -> Plot {
    let (name, label, unit) = match against {
        Against::Time => ("time", "median wall-clock time", "s"),
        Against::Evaluations => ("evaluations", "evaluations of the right-hand side", ""),
    };
    let methods = study.methods.iter();
    let methods = methods.map(|line| series(line, against));
    let methods: Vec<Series> = methods.filter(|series| !series.points.is_empty()).collect();
    let reference = study.reference.as_ref();
    let shaded = reference.filter(|r| r.resolution > 3e-15);
    let asked = format!("required: {}", significant(study.accuracy, 2));
    let noise = "cannot be distinguished from no error";
    Plot {
        title: format!("{}: error against {name}", study.scene),
        x: Axis::logarithmic(label, unit),
        y: Axis {
            ceiling: Some(CEILING),
            ..Axis::logarithmic("error of δ relative to max|δ|", "")
        },
        series: with_floors(study, methods),
        rules: vec![Rule::level(study.accuracy, asked)],
        below: shaded.map(|r| (r.resolution, noise.to_owned())),
        lane: "failed".to_owned(),
        ..Plot::default()
    }
}

/// Errors of models that lie closer than this factor share a line.
const APART: f64 = 3.0;
/// Most models that are drawn.
const MOST_MODELS: usize = 4;

/// The methods, and the errors of models as floors under them: the model that the methods
/// run first.
fn with_floors(study: &Study, mut methods: Vec<Series>) -> Vec<Series> {
    let Some(models) = &study.models else {
        return methods;
    };
    let points = methods.iter().flat_map(|series| &series.points);
    let (from, to) = points.fold((f64::INFINITY, 0.0_f64), |(from, to), (x, _)| {
        (from.min(*x), to.max(*x))
    });
    let studied = |model: &&ModelError| model.levels == models.levels;
    let given = |model: &&ModelError| model.given;
    let all = || models.tried.iter().filter(|model| model.error > 0.0);
    let ordered = all()
        .filter(studied)
        .chain(all().filter(given))
        .chain(all());
    let mut drawn: Vec<f64> = Vec::new();
    for model in ordered {
        let near = |other: &f64| (other / model.error).ln().abs() < APART.ln();
        if drawn.iter().any(near) || drawn.len() == MOST_MODELS {
            continue;
        }
        drawn.push(model.error);
        let role = match (studied(&model), model.given) {
            (true, _) => "model: ",
            (false, true) => "as given: ",
            (false, false) => "",
        };
        let label = format!(
            "{role}{}, {} % off",
            in_words(&model.levels),
            significant(100.0 * model.error, 2)
        );
        let label = shortened(&label, MOST_OF_LABEL);
        methods.push(Series::theory(
            &label,
            vec![(from, model.error), (to, model.error)],
        ));
    }
    methods
}

/// Longest label of a line (characters).
const MOST_OF_LABEL: usize = 60;

/// A series of a method, with the colour and shape that it has on every chart.
fn marked(label: String, method: Method, points: Vec<((f64, f64), Mark)>) -> Series {
    let (points, marks) = points.into_iter().unzip();
    Series {
        style: Some(style(method)),
        marks,
        ..Series::line(&label, points)
    }
}

fn series(line: &MethodLine, against: Against) -> Series {
    let points = line.points.iter().filter_map(|point| {
        let x = match against {
            Against::Time => point.measured_seconds?,
            // A method that evaluates no right-hand side has no place here.
            Against::Evaluations => point.evaluations.filter(|&count| count > 0)? as f64,
        };
        let mark = Mark::new(shape(point), point_note(line.method, point));
        Some(((x, position(point).unwrap_or(f64::NAN)), mark))
    });
    marked(line.method.name().to_owned(), line.method, points.collect())
}

/// The error as it is drawn; a point that failed altogether has none.
fn position(point: &Point) -> Option<f64> {
    match point.verdict {
        Verdict::Converged | Verdict::Inaccurate | Verdict::SwitchesMissed => {
            // No difference at all lies at the foot of every chart.
            point.error.map(|error| error.max(1e-16))
        }
        _ => point
            .error
            .filter(|error| *error > 0.0 && *error <= CEILING),
    }
}

fn shape(point: &Point) -> Shape {
    match point.verdict {
        Verdict::Converged if point.is_reference => Shape::AtMost,
        Verdict::Converged => Shape::Good,
        Verdict::Inaccurate | Verdict::NotJudged => Shape::Open,
        _ => Shape::Cross,
    }
}

fn point_note(method: Method, point: &Point) -> String {
    let error = point.error.map_or(String::new(), |error| {
        format!(", error {}", significant(error, 2))
    });
    let time = point.measured_seconds.map_or(String::new(), |seconds| {
        format!(", {}", with_unit(seconds, "s", 3))
    });
    format!(
        "{method} at {}{error}{time}: {}: {}",
        point.setting(),
        point.verdict.words(),
        point.cause
    )
}

/// The axis of a study over a parameter.
fn axis(sweep: &Sweep) -> Axis {
    Axis {
        log: sweep.axis.log,
        // A unit of the user's own stays as it is.
        fixed: true,
        ..Axis::new(&parameter_words(&sweep.axis.path), &sweep.axis.unit)
    }
}

/// The methods of a study over a parameter.
pub(super) fn methods(sweep: &Sweep) -> Vec<Method> {
    let first = sweep.slices.first();
    let lines = first.iter().flat_map(|slice| &slice.study.methods);
    lines.map(|line| line.method).collect()
}

/// What became of a method at a value of the parameter.
fn standing_note(sweep: &Sweep, x: f64, method: Method, standing: &MethodStanding) -> String {
    let (place, verdict) = (sweep.axis.value_with_unit(x), standing.verdict.words());
    format!("{method} at {place}: {verdict}: {}", standing.cause)
}

/// Least time to the asked accuracy over the parameter; `None` without slices.
pub fn cost(sweep: &Sweep) -> Option<Plot> {
    let study = &sweep.slices.first()?.study;
    let series = methods(sweep).into_iter().map(|method| {
        let point = |slice: &crate::studies::methods::sweep::Slice| {
            let standing = slice.standing(method)?;
            let reached = standing.measured_seconds;
            let shape = match reached {
                Some(_) => Shape::Good,
                None => Shape::Cross,
            };
            let mark = Mark::new(shape, standing_note(sweep, slice.x, method, &standing));
            let place = (slice.x, reached.unwrap_or(f64::NAN));
            (standing.verdict != Verdict::Refused).then_some((place, mark))
        };
        let points = sweep.slices.iter().filter_map(point);
        marked(method.name().to_owned(), method, points.collect())
    });
    Some(Plot {
        title: format!(
            "{}: time to an error of {} of max|δ|",
            study.scene,
            significant(study.accuracy, 2)
        ),
        x: axis(sweep),
        y: Axis::logarithmic("least median wall-clock time", "s"),
        series: series.filter(|series| !series.points.is_empty()).collect(),
        lane: "not reached".to_owned(),
        ..Plot::default()
    })
}

/// Greatest stable steps over the parameter, measured and by theory; `None`
/// when no method of fixed step is among the methods.
pub fn stable_steps(sweep: &Sweep) -> Option<Plot> {
    let mut series = Vec::new();
    for method in methods(sweep) {
        let standings = || {
            let slices = sweep.slices.iter();
            slices.filter_map(move |slice| Some((slice.x, slice.standing(method)?)))
        };
        let point = |x: f64, y: f64| {
            let place = sweep.axis.value_with_unit(x);
            let note = format!("{method} at {place}: {} s", shown(y, 4));
            ((x, y), Mark::new(Shape::Good, note))
        };
        let measured: Vec<_> = standings()
            .filter_map(|(x, s)| Some(point(x, s.stable_step?)))
            .collect();
        if measured.is_empty() {
            continue;
        }
        let theory = standings().filter_map(|(x, s)| Some((x, s.stable_step_by_theory?)));
        series.push(Series {
            style: Some(style(method)),
            ..Series::theory(&format!("{method}, theory"), theory.collect())
        });
        series.push(marked(format!("{method}, measured"), method, measured));
    }
    let named = |step: f64| Rule::level(step, "step of the verdicts");
    (!series.is_empty()).then(|| Plot {
        title: "Greatest stable step".to_owned(),
        x: axis(sweep),
        y: Axis::logarithmic("step", "s"),
        series,
        rules: sweep.fixed_step.map(named).into_iter().collect(),
        ..Plot::default()
    })
}

/// Where each method fails over the parameter.
pub fn regions(sweep: &Sweep) -> Plot {
    let kind = |verdict: Verdict| VERDICTS.iter().position(|entry| entry.0 == verdict);
    let methods = methods(sweep);
    let accuracy = sweep.slices.first().map_or(0.0, |s| s.study.accuracy);
    let fixed = sweep.fixed_step.map_or(String::new(), |step| {
        format!(", methods of fixed step at {}", with_unit(step, "s", 3))
    });
    let mut field = Field {
        x: edges_between_values(sweep),
        y: (0..=methods.len()).map(|row| row as f64).collect(),
        kinds: VERDICTS
            .iter()
            .map(|&(verdict, colour, hatched)| Kind {
                name: verdict.words().to_owned(),
                colour,
                hatching: if hatched { "dam-lifts" } else { "" },
            })
            .collect(),
        apart: true,
        named: true,
        ..Field::default()
    };
    for &method in &methods {
        for slice in &sweep.slices {
            let standing = slice.standing(method);
            let own = standing
                .as_ref()
                .and_then(|standing| kind(standing.verdict));
            field.kind.push(own);
            field.fill.push(own.map(|kind| VERDICTS[kind].1));
            let note = standing.map(|standing| standing_note(sweep, slice.x, method, &standing));
            field.notes.push(note.unwrap_or_default());
        }
    }
    Plot {
        title: format!(
            "Verdict on each method at tolerance {}{fixed}",
            significant(accuracy, 2)
        ),
        x: axis(sweep),
        y: Axis {
            rows: methods
                .iter()
                .map(|method| method.name().to_owned())
                .collect(),
            ..Axis::default()
        },
        field: Some(field),
        ..Plot::default()
    }
}

/// Height of the chart of regions (pixels).
pub fn height_of_regions(sweep: &Sweep) -> f64 {
    140.0 + 27.0 * methods(sweep).len() as f64
}

/// Edges midway between the values of the parameter; the first and the last are ends.
fn edges_between_values(sweep: &Sweep) -> Vec<f64> {
    let xs: Vec<f64> = sweep.slices.iter().map(|slice| slice.x).collect();
    let (Some(&first), Some(&last)) = (xs.first(), xs.last()) else {
        return vec![0.0, 1.0];
    };
    let middle = |pair: &[f64]| match sweep.axis.log {
        true => (pair[0] * pair[1]).sqrt(),
        false => 0.5 * (pair[0] + pair[1]),
    };
    let inner = xs.windows(2).map(middle);
    std::iter::once(first).chain(inner).chain([last]).collect()
}
