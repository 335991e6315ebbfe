//! What a scene expects, judged by every study that it takes.

use super::Mechanism;
use crate::Error;
use crate::frontend::scene::{Expectation, Expected, StudyAddress};
use crate::studies::Control;
use crate::studies::condition::Condition;
use crate::studies::expectations::{self, Requirement, Verdict};
use crate::studies::forces::ForceStudy;
use crate::studies::kinematics::Kinematics;
use crate::studies::run::RunResult;
use crate::studies::steady::{self, Answer};
use crate::studies::studied::{check_forces, check_kinematics, forces_of, kinematics_of};
use std::collections::BTreeMap;

/// Judges everything that a scene expects, in its order, by the run and the studies that it takes.
pub(super) fn judged(ready: &Mechanism, control: &Control<'_>) -> Vec<Requirement> {
    let mut studies = Studies {
        ready,
        control,
        run: None,
        steady: None,
        kinematics: BTreeMap::new(),
        forces: BTreeMap::new(),
    };
    let expect = ready.scene().expect.iter();
    expect.map(|one| studies.judge(one)).collect()
}

/// The studies of a scene, each made when it is asked for first.
struct Studies<'m> {
    ready: &'m Mechanism,
    control: &'m Control<'m>,
    run: Option<Result<RunResult, String>>,
    steady: Option<Result<Answer, String>>,
    kinematics: BTreeMap<String, Result<Kinematics, String>>,
    forces: BTreeMap<String, Result<ForceStudy, String>>,
}

impl Studies<'_> {
    fn judge(&mut self, one: &Expectation) -> Requirement {
        let address = match &one.what {
            Expected::Figure { figure, .. } => StudyAddress::of(figure),
            Expected::Stops { .. } => None,
        };
        let (study, found) = match address {
            Some(StudyAddress::Linkage {
                study: "kinematics",
                object,
                ..
            }) => ("kinematics", self.kinematics(object, one)),
            Some(StudyAddress::Linkage { object, .. }) => ("forces", self.forces(object, one)),
            Some(StudyAddress::Steady { .. }) => ("steady", self.steady(one)),
            Some(StudyAddress::Cam { .. } | StudyAddress::Frequency { .. }) | None => {
                ("run", self.run(one))
            }
        };
        let (verdict, not_judged) = match found {
            Ok(verdict) => (verdict, None),
            Err(why) => (Verdict::not_judged(one, &why), Some(why)),
        };
        let unit = match &one.what {
            Expected::Figure { figure, .. } => Condition::unit_of(figure, self.ready.model()),
            Expected::Stops { .. } => Ok("s".to_owned()),
        };
        Requirement {
            study,
            unit: unit.unwrap_or_default(),
            verdict,
            not_judged,
        }
    }

    fn run(&mut self, one: &Expectation) -> Result<Verdict, String> {
        let (ready, control) = (self.ready, self.control);
        let found = self.run.get_or_insert_with(|| {
            let result = ready
                .run_within(control)
                .map_err(|error| in_words(&error))?;
            match result.is_trusted() {
                true => Ok(result),
                false => Err("the run is not to be trusted: `dam run` says why".to_owned()),
            }
        });
        let result = found.as_ref().map_err(Clone::clone)?;
        let is_stop = matches!(one.what, Expected::Stops { .. });
        let stop_is_expected = ready
            .scene()
            .expect
            .iter()
            .any(|one| matches!(one.what, Expected::Stops { .. }));
        if !result.is_complete() && !is_stop && !stop_is_expected {
            let why = result
                .figures
                .run
                .stopped_because
                .clone()
                .unwrap_or_default();
            let time = result.outcome.time;
            return Err(format!("the run ends early, at t = {time} s: {why}"));
        }
        expectations::check(std::slice::from_ref(one), result)
            .pop()
            .ok_or_else(nobody)
    }

    fn steady(&mut self, one: &Expectation) -> Result<Verdict, String> {
        let (ready, control) = (self.ready, self.control);
        let found = self.steady.get_or_insert_with(|| {
            let answer = ready
                .steady_within(control)
                .map_err(|error| in_words(&error))?;
            match answer.is_trusted() {
                true => Ok(answer),
                false => {
                    Err("the steady motion is not to be trusted: `dam steady` says why".to_owned())
                }
            }
        });
        let answer = found.as_ref().map_err(Clone::clone)?;
        steady::check(std::slice::from_ref(one), answer)
            .pop()
            .ok_or_else(nobody)
    }

    fn kinematics(&mut self, object: &str, one: &Expectation) -> Result<Verdict, String> {
        let (model, duration) = (self.ready.model(), self.ready.settings.duration);
        let known = self.kinematics.entry(object.to_owned());
        let found = known.or_insert_with(|| kinematics_of(model, object, duration));
        let found = found.as_ref().map_err(Clone::clone)?;
        check_kinematics(std::slice::from_ref(one), found)
            .pop()
            .ok_or_else(nobody)
    }

    fn forces(&mut self, object: &str, one: &Expectation) -> Result<Verdict, String> {
        let (model, duration) = (self.ready.model(), self.ready.settings.duration);
        let known = self.forces.entry(object.to_owned());
        let found = known.or_insert_with(|| forces_of(model, object, duration));
        let found = found.as_ref().map_err(Clone::clone)?;
        check_forces(std::slice::from_ref(one), object, found)
            .pop()
            .ok_or_else(nobody)
    }
}

fn nobody() -> String {
    "no study judges it".to_owned()
}

fn in_words(error: &Error) -> String {
    let messages: Vec<&str> = error
        .faults()
        .iter()
        .map(|fault| fault.message.as_str())
        .collect();
    messages.join("; ")
}
