//! Runs of cells that leave nothing to look at: they did not come to their end, or are not to
//! be trusted.

use super::judge::reported;
use super::verdict::Verdict;
use crate::dynamics::model::Model;
use crate::dynamics::record::ObjectFigures;
use crate::studies::RunSettings;
use crate::studies::document::{spoiling, stop_in_words};
use crate::studies::judgement::{Errors, Judgement, Made, RunEnd};
use crate::studies::run::Motion;
use crate::studies::warning::Warning;
use crate::units::shown;

/// The verdict on a run that did not come to its end or is not to be trusted, with its cause.
/// `None`: the run is complete, and what it says of the mechanism holds.
pub(super) fn failure_verdict(
    model: &Model,
    settings: &RunSettings,
    found: &Motion,
) -> Option<(Verdict, String)> {
    let (name, because) = stop_in_words(&found.outcome.stop);
    let ending = RunEnd::end_of_stopped_run(name);
    let time = shown(found.outcome.time, 7);
    let method = &found.choice.name;
    let trusted = judgement(model, settings, found) != Judgement::NotToBeTrusted;
    Some(match (ending, trusted) {
        (RunEnd::OfComputation, _) => {
            let cause = format!("{method} gave up at {time} s: {because}");
            (Verdict::NumericalFailure, cause)
        }
        (RunEnd::Complete | RunEnd::FromOutside | RunEnd::OfScene | RunEnd::OfMechanism, false) => {
            let cause = format!("{method}: {}", failed_check(settings, found));
            (Verdict::NumericalFailure, cause)
        }
        (RunEnd::OfMechanism, true) => (Verdict::Stopped, format!("stops at {time} s: {because}")),
        (RunEnd::FromOutside, true) => {
            let cause = format!("{method} was ended at {time} s: {because}");
            (Verdict::NotFinished, cause)
        }
        (RunEnd::OfScene, true) => (Verdict::NotFinished, format!("ends at {time} s: {because}")),
        (RunEnd::Complete, true) => return None,
    })
}

/// The verdict that `dam run` gives on this run.
fn judgement(model: &Model, settings: &RunSettings, found: &Motion) -> Judgement {
    let figures: Vec<&ObjectFigures> = found.recorded.figures.iter().collect();
    let ending = RunEnd::end_of_stopped_run(stop_in_words(&found.outcome.stop).0);
    let errors = Errors {
        energy: found.recorded.audit.error(),
        tolerance: settings.tolerance,
        equations: [found.equations.defect, found.equations.bound],
    };
    let made = Made {
        ending,
        time: found.outcome.time,
        checks: &errors.checks(ending, reported(model, &figures)),
    };
    Judgement::of_run(made, reported(model, &figures))
}

/// The check that a run failed.
fn failed_check(settings: &RunSettings, found: &Motion) -> String {
    let open = || Warning::of_equations(&found.equations);
    let warning = spoiling(&found.recorded, settings).or_else(open);
    warning.unwrap_or(Warning::NotFinite).to_string()
}

#[cfg(test)]
mod tests {
    use super::{failure_verdict, judgement};
    use crate::ask::Scene;
    use crate::dynamics::integrate::{Method, Stop};
    use crate::studies::demand::Demand;
    use crate::studies::judgement::Judgement;
    use crate::studies::map::Verdict;
    use crate::studies::run::{motion, run};
    use crate::studies::{Control, RunSettings};

    const ROCKER: &str = concat!(
        env!("CARGO_MANIFEST_DIR"),
        "/scenarios/rocker/two_masses.json"
    );

    #[test]
    fn a_run_that_spent_its_budget_is_judged_as_by_itself() {
        let mechanism = Scene::read(ROCKER).unwrap().prepare().unwrap();
        for method in [Method::Exact, Method::Dop853] {
            let settings = RunSettings {
                method: Some(method),
                ..RunSettings::new(0.4)
            };
            let few_steps = RunSettings {
                max_steps: 10,
                ..settings.clone()
            };
            let few_switches = RunSettings {
                max_switches: 5,
                ..settings.clone()
            };
            for settings in [few_steps, few_switches, settings] {
                let (system, free) = (&mechanism.system, Control::default());
                let by_itself = run(system, &settings, &free, &mut []).unwrap();
                let demand = Demand::EVERYTHING;
                let found = motion(system, &settings, demand, &free, &mut []).unwrap();
                let model = mechanism.model();
                let judged = judgement(model, &settings, &found);
                assert_eq!(judged, by_itself.judgement(), "{:?}", found.outcome.stop);
                let ended = failure_verdict(model, &settings, &found);
                if found.outcome.stop == Stop::Complete {
                    assert_eq!(ended, None);
                    continue;
                }
                let (verdict, cause) = ended.unwrap();
                assert_eq!(verdict, Verdict::NotFinished, "{cause}");
                assert_eq!(verdict.judgement(), Some(Judgement::NotJudged));
                assert_eq!(judged, Judgement::NotJudged);
            }
        }
    }
}
