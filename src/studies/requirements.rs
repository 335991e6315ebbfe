//! What a scene expects, judged by every study that it takes.

use super::condition::Condition;
use super::expectations::{self, Requirement, Verdict, verdict_on as judged_figure};
use super::forces::ForceStudy;
use super::judgement::Judgement;
use super::kinematics::Kinematics;
use super::lookup::{self, Subject};
use super::run::{RunResult, run};
use super::steady::{self, Answer, steady_motion_within};
use super::studied::{check_forces, check_kinematics, forces_of, kinematics_of};
use crate::fault::Fault;
use crate::frontend::scene::{Expectation, Expected, StudyAddress};
use std::collections::BTreeMap;

/// Judges everything that a scene expects, in its order, by the run and the studies that it takes.
pub fn judge_requirements(subject: Subject<'_>) -> Vec<Requirement> {
    let mut studies = Studies {
        subject,
        run: None,
        steady: None,
        kinematics: BTreeMap::new(),
        forces: BTreeMap::new(),
    };
    let expect = subject.scene.expect.iter();
    expect.map(|one| studies.judge(one)).collect()
}

/// The studies of a scene, each made when it is asked for first.
struct Studies<'s> {
    subject: Subject<'s>,
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
            Some(StudyAddress::Linkage { object, .. }) => {
                ("forces", self.verdict_on_forces(object, one))
            }
            Some(StudyAddress::Steady { .. }) => ("steady", self.verdict_on_steady_motion(one)),
            Some(StudyAddress::Within(within)) => match StudyAddress::of(within.figure) {
                Some(StudyAddress::Linkage { study, .. }) => (study, self.verdict_over_part(one)),
                _ => ("run", self.run(one)),
            },
            Some(StudyAddress::Cam { .. } | StudyAddress::Frequency { .. }) | None => {
                ("run", self.run(one))
            }
        };
        let (verdict, not_judged) = match found {
            Ok(verdict) => (verdict, None),
            Err(why) => (Verdict::not_judged(one, &why), Some(why)),
        };
        let unit = match &one.what {
            Expected::Figure { figure, .. } => {
                Condition::unit_of(figure, self.subject.system.model())
            }
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
        let subject = self.subject;
        let found = self.run.get_or_insert_with(|| run_of(subject));
        let result = found.as_ref().map_err(Clone::clone)?;
        let is_stop = |one: &Expectation| matches!(one.what, Expected::Stops { .. });
        if !result.is_complete() && !subject.scene.expect.iter().any(is_stop) {
            let why = result.figures.run.stopped_because.as_deref();
            let time = result.outcome.time;
            let why = why.unwrap_or_default();
            return Err(format!("the run ends early, at t = {time} s: {why}"));
        }
        let verdict = expectations::check(std::slice::from_ref(one), result).pop();
        verdict.ok_or_else(not_required)
    }

    fn verdict_on_steady_motion(&mut self, one: &Expectation) -> Result<Verdict, String> {
        let subject = self.subject;
        let found = self.steady.get_or_insert_with(|| steady_of(subject));
        let answer = found.as_ref().map_err(Clone::clone)?;
        let verdict = steady::check(std::slice::from_ref(one), answer).pop();
        verdict.ok_or_else(not_required)
    }

    fn kinematics(&mut self, object: &str, one: &Expectation) -> Result<Verdict, String> {
        let (model, duration) = (self.subject.system.model(), self.subject.settings.duration);
        let known = self.kinematics.entry(object.to_owned());
        let found = known.or_insert_with(|| {
            let found = kinematics_of(model, object, duration)?;
            trusted(found.judgement(), "kinematics")?;
            Ok(found)
        });
        let found = found.as_ref().map_err(Clone::clone)?;
        check_kinematics(std::slice::from_ref(one), found)
            .pop()
            .ok_or_else(not_required)
    }

    fn verdict_on_forces(&mut self, object: &str, one: &Expectation) -> Result<Verdict, String> {
        let (model, duration) = (self.subject.system.model(), self.subject.settings.duration);
        let known = self.forces.entry(object.to_owned());
        let found = known.or_insert_with(|| {
            let found = forces_of(model, object, duration)?;
            trusted(found.judgement(), "forces")?;
            Ok(found)
        });
        let found = found.as_ref().map_err(Clone::clone)?;
        check_forces(std::slice::from_ref(one), object, found)
            .pop()
            .ok_or_else(not_required)
    }

    /// A figure of kinematics or forces over a part of the course.
    fn verdict_over_part(&self, one: &Expectation) -> Result<Verdict, String> {
        let Expected::Figure { figure, allowed } = &one.what else {
            return Err(not_required());
        };
        let found = lookup::figure(figure, self.subject).map_err(|faults| in_words(&faults))?;
        Ok(Verdict {
            source: one.source.clone(),
            ..judged_figure(figure, allowed, found.and_then(|found| found.value))
        })
    }
}

/// What is not to be trusted judges nothing.
fn trusted(judgement: Judgement, study: &str) -> Result<(), String> {
    match judgement {
        Judgement::NotToBeTrusted => Err(format!(
            "the {study} are not to be trusted: `dam {study}` says why"
        )),
        Judgement::InWorkingOrder | Judgement::NotInWorkingOrder | Judgement::NotJudged => Ok(()),
    }
}

fn not_required() -> String {
    "no study judges it".to_owned()
}

fn in_words(faults: &[Fault]) -> String {
    let messages: Vec<&str> = faults.iter().map(|fault| fault.message.as_str()).collect();
    messages.join("; ")
}

/// A run that is to be trusted, with the figures of cams and frequencies that are expected.
fn run_of(subject: Subject<'_>) -> Result<RunResult, String> {
    let Subject {
        scene,
        system,
        settings,
        control,
    } = subject;
    let found = run(system, settings, control, &mut []);
    let mut found = found.map_err(|faults| in_words(&faults))?;
    let named = lookup::named_in(scene);
    lookup::attach(&mut found.figures, named, subject).map_err(|faults| in_words(&faults))?;
    match found.is_trusted() {
        true => Ok(found),
        false => Err("the run is not to be trusted: `dam run` says why".to_owned()),
    }
}

/// A steady motion that is to be trusted.
fn steady_of(subject: Subject<'_>) -> Result<Answer, String> {
    let Subject {
        scene,
        system,
        settings,
        control,
    } = subject;
    let spec = scene.steady.clone().unwrap_or_default();
    let found = steady_motion_within(system, settings, &spec, control);
    let answer = found.map_err(|faults| in_words(&faults))?;
    match answer.is_trusted() {
        true => Ok(answer),
        false => Err("the steady motion is not to be trusted: `dam steady` says why".to_owned()),
    }
}
