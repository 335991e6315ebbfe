//! Studies of methods on the terminal.

use crate::dynamics::integrate::Method;
use crate::frontend::scene::in_words;
use crate::studies::methods::sweep::{Standing, Sweep};
use crate::studies::methods::{MethodLine, Point, Study, Verdict};
use crate::units::shown;
use std::fmt::Write as _;

/// A study as text.
pub(super) fn study(study: &Study) -> String {
    let mut text = format!("{}\n", study.scene);
    let _ = writeln!(
        text,
        "speed against accuracy; errors of δ relative to max|δ|, the worst object"
    );
    reference(&mut text, study);
    let _ = writeln!(
        text,
        "\n{:<9} {:>11} {:>9} {:>11} {:>11} {:>9} {:>8}  verdict",
        "method", "setting", "error", "time", "evaluations", "steps", "switches"
    );
    for line in &study.methods {
        for point in &line.points {
            row(&mut text, line, point);
        }
    }
    limits(&mut text, study);
    models(&mut text, study);
    let _ = writeln!(text, "\n{}", study.recommendation.text);
    if !study.complete {
        text.push_str("INTERRUPTED: points that were not run are missing\n");
    }
    text
}

fn reference(text: &mut String, study: &Study) {
    let Some(reference) = &study.reference else {
        text.push_str("reference: none; this cannot be known, as no two methods agree\n");
        for pair in &study.mutual_distances {
            let _ = writeln!(
                text,
                "  {} and {} are {} apart",
                pair.one,
                pair.other,
                shown(pair.distance, 2)
            );
        }
        return;
    };
    let setting = match (reference.tolerance, reference.step) {
        (Some(tolerance), _) => {
            format!(" at tolerance {tolerance}", tolerance = shown(tolerance, 1))
        }
        (_, Some(step)) => format!(" at a step of {step} s", step = shown(step, 3)),
        _ => String::new(),
    };
    let confirmed = reference.confirmed_by.as_ref().map_or_else(
        || "no other method confirms it".to_owned(),
        |pair| format!("{} comes within {}", pair.other, shown(pair.distance, 2)),
    );
    let _ = writeln!(
        text,
        "reference: {}{setting}; {confirmed}",
        reference.method
    );
    let _ = writeln!(
        text,
        "determined: loads changed by one part in 10¹⁰ move δ by {}; errors are told down to {}",
        shown(reference.moved, 2),
        shown(reference.resolution, 2)
    );
    if reference.horizon < study.duration * (1.0 - 1e-9) {
        let _ = writeln!(
            text,
            "NOT DETERMINED beyond t = {:.6} s: nothing is judged from there on",
            reference.horizon
        );
    }
    if !reference.undetermined.is_empty() {
        let _ = writeln!(
            text,
            "figures not determined to 1e-7: {}",
            reference.undetermined.join(", ")
        );
    }
}

fn row(text: &mut String, line: &MethodLine, point: &Point) {
    let count = |number: Option<u64>| number.map_or("–".to_owned(), |n| n.to_string());
    let error = point.error.map_or("–".to_owned(), |error| {
        let sign = if point.is_reference { "≤" } else { "" };
        format!("{sign}{error}", error = shown(error, 2))
    });
    let cause = match point.is_reference {
        true => "the reference".to_owned(),
        false => point.cause.clone(),
    };
    let mark = match point.verdict {
        Verdict::Converged => point.verdict.words().to_owned(),
        _ => point.verdict.words().to_uppercase(),
    };
    let _ = writeln!(
        text,
        "{:<9} {:>11} {:>9} {:>11} {:>11} {:>9} {:>8}  {mark}: {cause}",
        line.method.name(),
        point.setting(),
        error,
        time(point.measured_seconds),
        count(point.evaluations),
        count(point.steps),
        count(point.switches),
    );
}

fn time(seconds: Option<f64>) -> String {
    match seconds {
        None => "–".to_owned(),
        Some(seconds) if seconds < 1e-3 => format!("{:.1} µs", 1e6 * seconds),
        Some(seconds) if seconds < 1.0 => format!("{:.3} ms", 1e3 * seconds),
        Some(seconds) => format!("{seconds:.3} s"),
    }
}

/// The models with their errors.
fn models(text: &mut String, study: &Study) {
    let Some(models) = &study.models else { return };
    let _ = writeln!(
        text,
        "\nmodels: error of max|δ| against the continuum, the worst object"
    );
    for model in &models.tried {
        let mark = match (model.levels == models.levels, model.given) {
            (true, true) => "  studied above, as given",
            (true, false) => "  studied above",
            (false, true) => "  as given",
            (false, false) => "",
        };
        let _ = writeln!(
            text,
            "  {:>9} %  {}{mark}",
            shown(100.0 * model.error, 2),
            in_words(&model.levels)
        );
    }
}

fn limits(text: &mut String, study: &Study) {
    let _ = writeln!(
        text,
        "\nstability: fastest rate |λ| = {} 1/s, all pairs engaged; measured on this motion",
        shown(study.fastest_rate, 4)
    );
    for line in &study.methods {
        let limit = &line.stability;
        let Some(theory) = limit.theory else {
            if let Some(remark) = limit.remark {
                let _ = writeln!(text, "{:<9} {remark}", line.method.name());
            }
            continue;
        };
        let _ = write!(
            text,
            "{:<9} |λ|h below {theory:.3} {}, h below {} s",
            line.method.name(),
            limit.place.unwrap_or(""),
            shown(limit.theory_step.unwrap_or(f64::NAN), 3)
        );
        if let Some(degree) = limit.degree {
            let _ = write!(text, " (degree {degree})");
        }
        match (limit.measured, limit.measured_step) {
            (Some(measured), Some(step)) => {
                let _ = writeln!(
                    text,
                    "; measured {measured:.3}, {step} s",
                    step = shown(step, 3)
                );
            }
            _ => text.push('\n'),
        }
    }
}

/// A study over a parameter as text: a table of each method.
pub(super) fn sweep(scene: &str, methods: &[Method], sweep: &Sweep) -> String {
    let mut text = format!("{scene}\n");
    let accuracy = sweep.slices.first().map_or(0.0, |s| s.study.accuracy);
    let _ = writeln!(
        text,
        "methods over {}; time to an error of δ within {accuracy} of max|δ|",
        sweep.axis.path,
        accuracy = shown(accuracy, 1)
    );
    for &method in methods {
        let _ = writeln!(text, "\n{method}");
        if let Some(step) = sweep.fixed_step.filter(|_| is_fixed(sweep, method)) {
            let _ = writeln!(
                text,
                "  verdicts at a step of {step} s",
                step = shown(step, 3)
            );
        }
        for slice in &sweep.slices {
            if let Some(standing) = slice.standing(method) {
                let x = format!("{} {}", shown(slice.x, 7), sweep.axis.unit);
                standing_row(&mut text, x.trim_end(), &standing);
            }
        }
    }
    if !sweep.complete {
        text.push_str("INTERRUPTED: values that were not reached are missing\n");
    }
    text
}

fn is_fixed(sweep: &Sweep, method: Method) -> bool {
    let lines = sweep.slices.iter().flat_map(|slice| &slice.study.methods);
    lines.filter(|l| l.method == method).any(|l| l.fixed_step)
}

fn standing_row(text: &mut String, x: &str, standing: &Standing) {
    let step = match (standing.stable_step, standing.stable_step_by_theory) {
        (Some(measured), Some(theory)) => {
            format!(
                "; greatest stable step {measured} s, in theory {theory} s",
                measured = shown(measured, 3),
                theory = shown(theory, 3)
            )
        }
        _ => String::new(),
    };
    let _ = writeln!(
        text,
        "  {x:>14} {:>11}  {}: {}{step}",
        time(standing.measured_seconds),
        standing.verdict.words(),
        standing.cause
    );
}
