//! What is said beside the charts of methods.

use crate::report::html::facts;
use crate::report::quantity::{escape, significant, with_unit};
use crate::studies::methods::{GROWN, MethodLine, Study};

/// How points are marked and times are measured.
pub(super) fn timing_note() -> &'static str {
    "<p class=\"soft\">Filled marks: converged, the error is within the tolerance (of a fixed \
     step, within the accuracy asked for); open marks: inaccurate or not judged; crosses: failed; marks with an arrow: the reference, whose error is at most its distance from the \
     nearest other method. Pointing at a mark tells its cause. Times are wall-clock times from \
     the system ready to all samples of δ and all switch times, single thread, medians of \
     repeated runs; they vary from run to run and from machine to machine.</p>\n"
}

/// What the errors are taken against.
pub(super) fn reference_facts(study: &Study) -> String {
    let Some(reference) = &study.reference else {
        let rows: String = study
            .mutual_distances
            .iter()
            .map(|pair| {
                format!(
                    "<tr><th>{}</th><td class=\"left\">{}</td><td>{}</td></tr>\n",
                    escape(&pair.one),
                    escape(&pair.other),
                    significant(pair.distance, 2)
                )
            })
            .collect();
        return format!(
            "<p>None: no two methods agree, and no errors can be known.</p>\n\
             <table>\n<thead><tr><th>One</th><th class=\"left\">other</th><th>apart</th></tr>\
             </thead>\n<tbody>\n{rows}</tbody></table>\n"
        );
    };
    let setting = match (reference.tolerance, reference.step) {
        (Some(tolerance), _) => format!(", tolerance {}", significant(tolerance, 2)),
        (_, Some(step)) => format!(", step {}", with_unit(step, "s", 3)),
        _ => String::new(),
    };
    let kind = match reference.exact {
        true => "no truncation error",
        false => "agrees with a different method",
    };
    let confirmed = reference.confirmed_by.as_ref().map_or_else(
        || "no other method".to_owned(),
        |pair| format!("{}, {} apart", pair.other, significant(pair.distance, 2)),
    );
    let horizon = match reference.horizon < study.duration * (1.0 - 1e-9) {
        true => format!(
            "up to {}; beyond, nothing is judged",
            with_unit(reference.horizon, "s", 6)
        ),
        false => "throughout".to_owned(),
    };
    let mut rows = vec![
        ("Method", format!("{}{setting}: {kind}", reference.method)),
        ("Nearest to it", confirmed),
        (
            "Determined",
            format!(
                "{horizon}; loads changed by one part in 10¹⁰ move δ by {} of max|δ|",
                significant(reference.moved, 2)
            ),
        ),
        (
            "Errors are told down to",
            significant(reference.resolution, 2),
        ),
        ("Switches", reference.switches.to_string()),
    ];
    if !reference.undetermined.is_empty() {
        rows.push((
            "Figures not determined to 10⁻⁷",
            reference.undetermined.join(", "),
        ));
    }
    facts(&rows)
}

/// Limits of stability, theory beside measurement.
pub(super) fn limits(study: &Study) -> String {
    let rows: String = study.methods.iter().filter_map(limit_row).collect();
    format!(
        "<h2>Limits of stability</h2>\n<p class=\"soft\">Fastest rate |λ| of the system {} 1/s, \
         all pairs engaged. While a pair is open the motion is slower, so that a scene with \
         contact may bear a longer step than theory says. Measured is on this motion: the longest \
         step with which this very run grows to no more than {GROWN} times what it should be; what \
         would grow more slowly, or from another start, is not seen. Of power series: the longest \
         step that multiplies no deviation.</p>\n\
         <div class=\"scroll\"><table>\n<thead><tr><th>Method</th><th>|λ|h in theory</th>\
         <th>step in theory</th><th>|λ|h measured</th><th>step measured</th>\
         <th class=\"left\">where λ lies</th></tr></thead>\n<tbody>\n{rows}</tbody></table></div>\n",
        significant(study.fastest_rate, 4)
    )
}

fn limit_row(line: &MethodLine) -> Option<String> {
    let limit = &line.stability;
    let real = |value: Option<f64>| value.map_or("–".to_owned(), |v| significant(v, 4));
    let step = |value: Option<f64>| value.map_or("–".to_owned(), |v| with_unit(v, "s", 3));
    let words = limit.place.or(limit.remark)?;
    let degree = limit
        .degree
        .map(|degree| format!(", series of degree {degree}"));
    let words = words.to_owned() + &degree.unwrap_or_default();
    Some(format!(
        "<tr><th>{}</th><td>{}</td><td>{}</td><td>{}</td><td>{}</td><td class=\"left\">{}</td></tr>\n",
        line.method.name(),
        real(limit.theory),
        step(limit.theory_step),
        real(limit.measured),
        step(limit.measured_step),
        escape(&words)
    ))
}
