//! Figures of a scene by their addresses, from its run and from other studies.

use super::State;
use crate::dynamics::model::{SpanAxis, SpanFigure};
use crate::fault::Fault;
use crate::studies::judgement::{RunEnd, checks, ending};
use crate::studies::lookup::{self, Subject};
use crate::studies::plausible;
use crate::studies::run::{RunResult, run};
use crate::units::shown;
use std::collections::BTreeMap;

/// Values of figures by their addresses, and what became of the scene.
pub(crate) type FigureValues<'f> = (BTreeMap<&'f str, Option<f64>>, State);

/// The figures of a scene, and what became of it; `None`: ended from outside.
///
/// # Errors
/// There is no start, or a study has no answer.
pub(crate) fn figures_of<'f>(
    asked: Vec<&'f str>,
    subject: Subject<'_>,
) -> Result<Option<FigureValues<'f>>, Vec<Fault>> {
    let (of_studies, of_run): (Vec<&str>, Vec<&str>) = asked
        .into_iter()
        .partition(|figure| lookup::is_address(figure) && lookup::span_of_run(figure).is_none());
    let mut found = BTreeMap::new();
    let mut state = State::Computed;
    if !of_run.is_empty() {
        let mut settings = subject.settings.clone();
        settings.spans = (of_run.iter())
            .filter_map(|figure| lookup::span_of_run(figure))
            .collect();
        if !plausible::needs_samples(subject.system.model()) {
            settings.samples = 0;
        }
        let result = run(subject.system, &settings, subject.control, &mut [])?;
        if subject.control.is_spent() {
            return Ok(None);
        }
        state = state_of(&result);
        let value = |name: &str| {
            let value = result.figures.value(name).ok();
            value.filter(|value| value.is_finite())
        };
        found.extend(of_run.into_iter().map(|name| (name, value(name))));
        let missed = (settings.spans.iter())
            .find(|span| value(&span.address).is_none() && state == State::Computed);
        if let Some(span) = missed {
            state = State::Refused(not_gone_through(span, result.outcome.time));
        }
    }
    for name in of_studies {
        match lookup::figure(name, subject) {
            _ if subject.control.is_spent() => return Ok(None),
            Ok(figure) => {
                found.insert(name, figure.and_then(|figure| figure.value));
            }
            Err(faults) if faults.iter().any(|fault| fault.code == lookup::NOT_TRUSTED) => {
                state = State::NotTrusted(faults[0].message.clone());
            }
            Err(faults) => return Err(faults),
        }
    }
    Ok(Some((found, state)))
}

/// Why there is no value of a figure within a span.
fn not_gone_through(span: &SpanFigure, end: f64) -> String {
    let hint = match span.span.axis {
        SpanAxis::Time => "give a span within the run, or a longer `run.duration`",
        SpanAxis::Displacement { .. } => "give a span that the motion goes through",
    };
    format!(
        "the run, which ends at {} s, does not go through all of `{}`: {hint}",
        shown(end, 6),
        span.address
    )
}

/// What became of a run that was not ended from outside.
fn state_of(result: &RunResult) -> State {
    let figures = &result.figures;
    let why = || figures.run.stopped_because.clone().unwrap_or_default();
    if !result.is_trusted() {
        let failed = checks(figures).into_iter().find(|check| !check.passed());
        return State::NotTrusted(failed.map_or_else(why, |check| check.name.to_owned()));
    }
    match ending(figures) {
        RunEnd::Complete => State::Computed,
        RunEnd::OfMechanism | RunEnd::OfScene => State::Stopped(why()),
        // (A bound on steps or switches that is spent says nothing of what comes after it.)
        RunEnd::OfComputation | RunEnd::FromOutside => State::NotTrusted(why()),
    }
}
