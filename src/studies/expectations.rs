//! Does a run give what its scene expects?

use super::document::blank;
use super::run::RunResult;
use crate::dynamics::model::Model;
use crate::dynamics::record::AddressError;
use crate::fault::Fault;
use crate::frontend::scene::{AllowedValues, Expectation, Expected, StudyAddress};
use crate::units::shown;
use serde::Serialize;
use std::collections::BTreeMap;

/// Verdict on one expectation.
#[derive(Clone, Debug, PartialEq, Serialize)]
pub struct Verdict {
    /// Subject: the address of a figure, or `stops: dead_position`.
    pub what: String,
    /// The value expected (a time for a stop); of a range its middle, of one limit the limit.
    pub expected: f64,
    /// How far the value found may be off; 0 of one limit, on one side of which all is right.
    pub within: f64,
    /// The least value that is right, where a limit or a range is expected.
    #[serde(skip_serializing_if = "Option::is_none")]
    pub at_least: Option<f64>,
    /// The greatest one.
    #[serde(skip_serializing_if = "Option::is_none")]
    pub at_most: Option<f64>,
    /// The value found; null when there is none.
    pub found: Option<f64>,
    /// True when it holds.
    pub holds: bool,
    /// True when the expectation itself is wrong: no such figure.
    pub unknown: bool,
    /// The verdict in words.
    pub message: String,
    /// Source of the expected value.
    pub source: Option<String>,
}

impl Verdict {
    /// On an expectation that was not judged, and why.
    pub(crate) fn not_judged(expectation: &Expectation, why: &str) -> Self {
        let open = match &expectation.what {
            Expected::Figure { figure, allowed } => Self::not_judged_yet(figure.clone(), allowed),
            Expected::Stops {
                reason,
                time,
                within,
            } => {
                let allowed = AllowedValues::Near {
                    value: *time,
                    within: *within,
                };
                Self::not_judged_yet(format!("stops: {reason}"), &allowed)
            }
        };
        Self {
            message: format!("{} is not judged: {why}", open.what),
            source: expectation.source.clone(),
            ..open
        }
    }

    /// Not judged yet.
    fn not_judged_yet(what: String, allowed: &AllowedValues) -> Self {
        let (at_least, at_most) = match *allowed {
            AllowedValues::Near { .. } => (None, None),
            AllowedValues::Between { least, most } => (least, most),
        };
        let (expected, within) = match (*allowed, at_least, at_most) {
            (AllowedValues::Near { value, within }, ..) => (value, within),
            (_, Some(least), Some(most)) => (0.5 * (least + most), 0.5 * (most - least)),
            (_, least, most) => (least.or(most).unwrap_or(f64::NAN), 0.0),
        };
        Self {
            what,
            expected,
            within,
            at_least,
            at_most,
            found: None,
            holds: false,
            unknown: false,
            message: String::new(),
            source: None,
        }
    }
}

/// An expectation with its verdict, whatever study judges it.
#[derive(Clone, Debug, PartialEq, Serialize)]
pub struct Requirement {
    /// The command whose study was asked: `run`, `steady`, `kinematics`, `forces`.
    pub study: &'static str,
    /// SI unit of the figure; empty of plain numbers, counts and answers.
    pub unit: String,
    /// The verdict; where the study has no answer, the value found is null.
    #[serde(flatten)]
    pub verdict: Verdict,
    /// Why it was not judged: the study has no answer, or none that is to be trusted.
    #[serde(skip_serializing_if = "Option::is_none")]
    pub not_judged: Option<String>,
}

impl Requirement {
    /// Whether it was judged, and holds.
    pub fn holds(&self) -> bool {
        self.verdict.holds && self.not_judged.is_none()
    }
}

/// First names of figures that no run has: those of the steady motion and of
/// the studies of linkages.
const OTHERS: [&str; 3] = ["steady.", "kinematics.", "forces."];

/// True for figures that a run has.
pub fn of_run(expectation: &Expectation) -> bool {
    match &expectation.what {
        Expected::Figure { figure, .. } => !OTHERS.iter().any(|other| figure.starts_with(other)),
        Expected::Stops { .. } => true,
    }
}

/// Judges every expectation of a run, in their order. (Those of the steady
/// motion are judged by [`super::steady::check`], those of kinematics and forces
/// by [`super::studied`].)
pub fn check(expectations: &[Expectation], result: &RunResult) -> Vec<Verdict> {
    // They are found once for all expectations.
    let known = match expectations.is_empty() {
        true => BTreeMap::new(),
        false => result.figures.addresses(),
    };
    expectations
        .iter()
        .filter(|expectation| of_run(expectation))
        .map(|expectation| Verdict {
            source: expectation.source.clone(),
            ..match &expectation.what {
                Expected::Figure { figure, allowed } => {
                    check_figure(figure, allowed, result, &known)
                }
                Expected::Stops {
                    reason,
                    time,
                    within,
                } => check_stop(reason, *time, *within, result),
            }
        })
        .collect()
}

/// Expectations of figures that no run of this model has, without running it.
pub fn unknown_figures(expectations: &[Expectation], model: &Model) -> Vec<Fault> {
    let figures = blank(model);
    let unknown = |(index, expectation): (usize, &Expectation)| {
        let Expected::Figure { figure, .. } = &expectation.what else {
            return None;
        };
        // How many switches there will be is not known before the run.
        let of_study = StudyAddress::of(figure).is_some();
        if figure.contains(".switch_times.") || of_study || !of_run(expectation) {
            return None;
        }
        let Err(AddressError::Unknown { close }) = figures.value(figure) else {
            return None;
        };
        Some(Fault::new(
            format!("expect.{index}.figure"),
            format!("there is no result `{figure}`"),
            suggest_instead(figure, &close),
        ))
    };
    expectations
        .iter()
        .enumerate()
        .filter_map(unknown)
        .collect()
}

/// What to write in place of a result that a run does not have: similar addresses, or what the
/// result needs.
pub(super) fn suggest_instead(figure: &str, close: &[String]) -> String {
    match figure.strip_suffix(".pair.margin") {
        Some(object) => format!(
            "only a rigid object has it, with \"masses\": 0; an elastic one has the least contact \
             force of the steady motion, `cam.{object}.margin`, and `{object}.pair.separations`"
        ),
        None => did_you_mean(close),
    }
}

/// A hint naming similar addresses; empty when there are none.
pub(super) fn did_you_mean(close: &[String]) -> String {
    if close.is_empty() {
        String::new()
    } else {
        format!("did you mean `{}`?", close.join("` or `"))
    }
}

fn check_figure(
    figure: &str,
    allowed: &AllowedValues,
    result: &RunResult,
    known: &BTreeMap<String, Option<f64>>,
) -> Verdict {
    let mut verdict = Verdict::not_judged_yet(figure.to_owned(), allowed);
    let value = match known.get(figure) {
        Some(Some(found)) => Ok(*found),
        // It says why there is none.
        _ => result.figures.value(figure),
    };
    match value {
        Ok(found) => judge(&mut verdict, allowed, found),
        Err(AddressError::NoValue) => {
            let why = match StudyAddress::span_of_run(figure) {
                Some(_) => ": the run does not go through all of this part",
                None => "",
            };
            verdict.message = format!("{figure} has no value in this run{why}");
        }
        Err(AddressError::Unknown { close }) => {
            verdict.unknown = true;
            verdict.message = format!("there is no result `{figure}`");
            if !close.is_empty() {
                verdict.message += &format!("; {}", did_you_mean(&close));
            }
        }
    }
    verdict
}

/// The verdict on a figure that was found, or has no value.
pub(super) fn verdict_on(figure: &str, allowed: &AllowedValues, found: Option<f64>) -> Verdict {
    let mut verdict = Verdict::not_judged_yet(figure.to_owned(), allowed);
    match found {
        Some(found) => judge(&mut verdict, allowed, found),
        None => verdict.message = format!("{figure} has no value in this motion"),
    }
    verdict
}

fn check_stop(reason: &str, time: f64, within: f64, result: &RunResult) -> Verdict {
    let allowed = AllowedValues::Near {
        value: time,
        within,
    };
    let mut verdict = Verdict::not_judged_yet(format!("stops: {reason}"), &allowed);
    verdict.found = Some(result.outcome.time);
    match &result.figures.run.stopped {
        Some(stopped) if stopped == reason => judge(&mut verdict, &allowed, result.outcome.time),
        Some(stopped) => {
            verdict.message = format!("the run stopped because of `{stopped}`, not `{reason}`");
        }
        None => verdict.message = "the run did not stop before its end".to_owned(),
    }
    verdict
}

fn judge(verdict: &mut Verdict, allowed: &AllowedValues, found: f64) {
    verdict.found = Some(found);
    // A number that is none fails.
    verdict.holds = allowed.contains_value(found);
    verdict.message = match *allowed {
        AllowedValues::Near { value, within } => verdict_near(verdict, found, value, within),
        AllowedValues::Between { least, most } => verdict_between(verdict, found, [least, most]),
    };
}

fn verdict_near(verdict: &Verdict, found: f64, expected: f64, within: f64) -> String {
    let what = &verdict.what;
    let off = (found - expected).abs();
    if verdict.holds {
        format!(
            "{what} = {found}: {off} off, within {within}",
            off = shown(off, 2),
            within = shown(within, 2)
        )
    } else {
        format!(
            "{what} = {found}, expected {expected}: {off} off, only {within} allowed",
            off = shown(off, 4),
            within = shown(within, 2)
        )
    }
}

fn verdict_between(verdict: &Verdict, found: f64, [least, most]: [Option<f64>; 2]) -> String {
    let what = &verdict.what;
    let limits: Vec<String> = [("at least", least), ("at most", most)]
        .into_iter()
        .filter_map(|(words, limit)| Some(format!("{words} {}", limit?)))
        .collect();
    let limits = limits.join(" and ");
    match verdict.holds {
        true => format!("{what} = {found}: {limits}"),
        false => format!("{what} = {found}, expected {limits}"),
    }
}

#[cfg(test)]
mod tests {
    use super::{Verdict, check, unknown_figures};
    use crate::dynamics::integrate::{PhysicalStop, Stop};
    use crate::dynamics::model::{Coordinate, Model, ObjectPart, PartInput};
    use crate::frontend::scene::{AllowedValues, Expectation, Expected};
    use crate::studies::run::RunResult;
    use crate::studies::testing::result_with;

    fn judge(what: Expected, result: &RunResult) -> Verdict {
        let expectation = Expectation {
            what,
            source: Some("closed form".to_owned()),
        };
        check(&[expectation], result).remove(0)
    }

    fn figure(figure: &str, value: f64, within: f64) -> Expected {
        Expected::Figure {
            figure: figure.to_owned(),
            allowed: AllowedValues::Near { value, within },
        }
    }

    #[test]
    fn limits_hold_on_their_side_and_at_themselves() {
        let result = result_with(|rocker| rocker.delta_max = 0.5);
        let between = |least: Option<f64>, most: Option<f64>| {
            let what = Expected::Figure {
                figure: "rocker.delta_max".to_owned(),
                allowed: AllowedValues::Between { least, most },
            };
            judge(what, &result)
        };
        for (least, most, holds) in [
            (None, Some(0.5), true),
            (None, Some(0.499), false),
            (Some(0.5), None, true),
            (Some(0.501), None, false),
            (Some(0.4), Some(0.6), true),
            (Some(0.4), Some(0.45), false),
            (Some(0.55), Some(0.6), false),
        ] {
            let verdict = between(least, most);
            assert_eq!(verdict.holds, holds, "{}", verdict.message);
            assert_eq!((verdict.at_least, verdict.at_most), (least, most));
        }
        let verdict = between(Some(0.55), Some(0.75));
        assert!(
            verdict
                .message
                .ends_with("= 0.5, expected at least 0.55 and at most 0.75")
        );
        assert_eq!((verdict.expected, verdict.found), (0.65, Some(0.5)));
        let nothing = result_with(|rocker| rocker.delta_max = f64::NAN);
        let what = Expected::Figure {
            figure: "rocker.delta_max".to_owned(),
            allowed: AllowedValues::Between {
                least: Some(0.0),
                most: None,
            },
        };
        assert!(!judge(what, &nothing).holds);
    }

    #[test]
    fn a_figure_holds_within_its_bound_and_not_beyond() {
        let result = result_with(|rocker| rocker.delta_max = 0.5);
        for (value, holds) in [
            (0.5, true),
            (0.53125, true),
            (0.46, false),
            (f64::NAN, false),
        ] {
            let verdict = judge(figure("rocker.delta_max", value, 0.03125), &result);
            assert_eq!(verdict.holds, holds, "{}", verdict.message);
            assert_eq!(verdict.source.as_deref(), Some("closed form"));
        }
    }

    #[test]
    fn what_has_no_value_or_no_name_does_not_hold() {
        let result = result_with(|_| {});
        let verdict = judge(figure("rocker.pair", 0.0, 1e9), &result);
        assert!(!verdict.holds && !verdict.unknown, "{}", verdict.message);
        let verdict = judge(figure("rocker.sigme", 0.0, 1e9), &result);
        assert!(!verdict.holds && verdict.unknown);
        assert!(verdict.message.contains("did you mean `rocker.sigma`"));
    }

    #[test]
    fn wrong_addresses_are_known_before_the_run() {
        let expect = |name: &str| Expectation {
            what: figure(name, 0.0, 0.0),
            source: None,
        };
        let model = Model {
            objects: vec![ObjectPart {
                id: "drive".to_owned(),
                kind: "drive",
                coordinate: Coordinate::Turning,
                nodes: vec![0],
                inputs: PartInput::behind_one_driver(None),
                combination: None,
                driven_end: None,
                links: Vec::new(),
                contact: None,
                rigid_pair: None,
                pressing: None,
            }],
            ..Model::default()
        };
        let wanted = [
            "drive.peak_speed",
            "run.switches",
            "drive.pair.separations",
            "driv.sigma",
        ];
        let faults = unknown_figures(&wanted.map(expect), &model);
        let paths: Vec<&str> = faults.iter().map(|fault| fault.path.as_str()).collect();
        assert_eq!(paths, ["expect.2.figure", "expect.3.figure"]);
        assert!(faults[1].hint.contains("drive.sigma"));
    }

    #[test]
    fn a_stop_must_have_the_reason_and_the_time() {
        let stops = |reason: &str, time| Expected::Stops {
            reason: reason.to_owned(),
            time,
            within: 1e-6,
        };
        let mut result = result_with(|_| {});
        assert!(!judge(stops("dead_position", 0.0), &result).holds);
        result.outcome.time = 12.6163;
        result.outcome.stop = Stop::Physical(PhysicalStop {
            name: "dead_position",
            object: "rocker".to_owned(),
            message: String::new(),
        });
        result.figures.run.stopped = Some("dead_position".to_owned());
        assert!(judge(stops("dead_position", 12.616_300_5), &result).holds);
        assert!(!judge(stops("dead_position", 12.7), &result).holds);
        assert!(!judge(stops("not_finite", 12.6163), &result).holds);
    }
}
