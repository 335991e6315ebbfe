//! Results of other studies than the run, by their addresses: `frequency.1`,
//! `steady.mean_time`, `cam.follower.least_radius`, `kinematics.press.ram.speed.greatest`,
//! `forces.press.drive.greatest`. They are found when they are asked for.
//!
//! The addresses are read in `frontend::scene::study_address`. `attach` adds such results to
//! those of a run (`Figures::studies`): those that the accuracy or the expectations of a scene
//! name, and those of `compare --figure`. A prepared scene requests them for each point.

use super::cam::{
    CONTACT_RESULTS, CamForce, ElasticContact, Reserve, contact_result, disc_cam, preload_unit,
};
use super::expectations::{Verdict, verdict_on};
use super::run::run;
use super::spans;
use super::steady::{self, Answer, steady_motion_within};
use super::studied;
use super::{Control, RunSettings};
use crate::dynamics::model::{Model, SpanFigure};
use crate::dynamics::record::{Figures, StudyFigure};
use crate::dynamics::system::{Regime, System};
use crate::fault::Fault;
use crate::frontend::object::Measures;
use crate::frontend::read::closest;
use crate::frontend::scene::{
    AccuracySpec, CAM_FIGURES, Expectation, Expected, Figure, STEADY_FIGURES, StudyAddress,
    TypedScene,
};
use crate::kinematics::cam::DiscCam;
use crate::units::{Quantity, quantities::FREQUENCY};
use std::f64::consts::TAU;

/// Share of the opening force that is left in contact; no result here depends on it.
const RESERVE: f64 = 0.2;

/// Code of the fault of a study that gave numbers that are not to be trusted.
pub const NOT_TRUSTED: &str = "not-trusted";

/// A scene and what was made of it.
#[derive(Clone, Copy)]
pub struct Subject<'s> {
    /// The scene.
    pub scene: &'s TypedScene,
    /// The system made of it.
    pub system: &'s System,
    /// Settings of its run.
    pub settings: &'s RunSettings,
    /// How long the studies may take.
    pub control: &'s Control<'s>,
}

/// Adds the results of studies that are named to the figures of a run.
///
/// # Errors
/// There is no such result; a study cannot be made, or is not to be trusted.
pub fn attach<'a>(
    figures: &mut Figures,
    addresses: impl IntoIterator<Item = &'a str>,
    subject: Subject<'_>,
) -> Result<(), Vec<Fault>> {
    let mut lookup = Lookup::new(subject);
    for address in addresses {
        if figures.studies.contains_key(address) {
            continue; // found in the run itself
        }
        if let Some(found) = lookup.figure(address)? {
            figures.studies.insert(address.to_owned(), found);
        }
    }
    Ok(())
}

/// The result of a study at an address; `None`: it is no address of a study.
///
/// # Errors
/// As of [`attach`].
pub fn figure(address: &str, subject: Subject<'_>) -> Result<Option<StudyFigure>, Vec<Fault>> {
    Lookup::new(subject).figure(address)
}

/// Looks up results of the studies of one subject; the steady motion that several of them are
/// read from is found once.
pub(super) struct Lookup<'s> {
    subject: Subject<'s>,
    motion: Option<Answer>,
}

impl<'s> Lookup<'s> {
    pub(super) fn new(subject: Subject<'s>) -> Self {
        Self {
            subject,
            motion: None,
        }
    }

    /// As [`figure`].
    pub(super) fn figure(&mut self, address: &str) -> Result<Option<StudyFigure>, Vec<Fault>> {
        find(address, self.subject, &mut self.motion)
    }
}

/// Addresses of studies that a scene names for its run: those of its accuracy, and what it
/// expects of frequencies and cams. (Other commands judge what is expected of their studies.)
pub fn named_in(scene: &TypedScene) -> Vec<&str> {
    let accuracy = match &scene.run.accuracy {
        Some(AccuracySpec::Figures(figures)) => figures.as_slice(),
        Some(AccuracySpec::Share(_)) | None => &[],
    };
    let accuracy = accuracy.iter().map(|(figure, _)| figure.as_str());
    let accuracy = accuracy.filter(|figure| StudyAddress::of(figure).is_some());
    let expected = scene.expect.iter().filter_map(|one| match &one.what {
        Expected::Figure { figure, .. } => Some(figure.as_str()),
        Expected::Stops { .. } => None,
    });
    let expected = expected.filter(|figure| {
        let address = StudyAddress::of(figure);
        address.is_some_and(|address| address.is_judged_by_run())
    });
    let mut all: Vec<&str> = accuracy.chain(expected).collect();
    all.sort_unstable();
    all.dedup();
    all
}

/// True for addresses of results of studies.
pub fn is_address(figure: &str) -> bool {
    StudyAddress::of(figure).is_some()
}

/// The figure within a part of the motion of a run at an address; `None`: it is another address.
pub fn span_of_run(figure: &str) -> Option<SpanFigure> {
    StudyAddress::span_of_run(figure)
}

/// True for addresses of results of studies that take every object for rigid.
pub fn is_rigid(figure: &str) -> bool {
    match StudyAddress::of(figure) {
        Some(StudyAddress::Linkage { .. }) => true,
        Some(StudyAddress::Cam { name, .. }) => !CONTACT_RESULTS.contains(&name),
        Some(StudyAddress::Within(within)) => is_rigid(within.figure),
        // The steady motion of elastic objects is one of them.
        Some(StudyAddress::Steady { .. } | StudyAddress::Frequency { .. }) | None => false,
    }
}

/// Expectations of results that no study of this model has, without making it.
pub fn unknown_figures(expectations: &[Expectation], model: &Model) -> Vec<Fault> {
    let unknown = |(index, expectation): (usize, &Expectation)| {
        let Expected::Figure { figure, .. } = &expectation.what else {
            return None;
        };
        let path = format!("expect.{index}.figure");
        let fault = check(figure, model)?.err()?;
        Some(Fault { path, ..fault })
    };
    expectations
        .iter()
        .enumerate()
        .filter_map(unknown)
        .collect()
}

/// Whether a model has the result of a study at an address; `None`: it is no address of a
/// study.
pub fn check(address: &str, model: &Model) -> Option<Result<(), Fault>> {
    let unknown = |hint: String| {
        let message = format!("there is no result `{address}`");
        Err(Fault::new("", message, hint))
    };
    Some(match StudyAddress::of(address)? {
        StudyAddress::Linkage { .. } => studied::unknown(address, model)
            .map_or(Ok(()), |(message, hint)| Err(Fault::new("", message, hint))),
        StudyAddress::Steady { name } => {
            let names = || STEADY_FIGURES.iter().map(|figure| figure.name);
            match names().any(|known| known == name) {
                true => Ok(()),
                false => unknown(did_you_mean("steady.", closest(name, names()))),
            }
        }
        StudyAddress::Cam { object, name } => {
            let names = || CAM_FIGURES.iter().map(|figure| figure.name);
            let known = model.objects.iter().any(|part| part.id == object);
            match (known, names().any(|known| known == name)) {
                (true, true) => Ok(()),
                (false, _) => unknown(format!("there is no object `{object}`")),
                (true, false) => {
                    let owner = format!("cam.{object}.");
                    unknown(match did_you_mean(&owner, closest(name, names())) {
                        hint if !hint.is_empty() => hint,
                        _ => format!("a cam has {}", names().collect::<Vec<_>>().join(", ")),
                    })
                }
            }
        }
        StudyAddress::Within(within) => spans::check(within, model),
        StudyAddress::Frequency { number: 1.., .. } => Ok(()),
        StudyAddress::Frequency { .. } => {
            unknown("frequencies are counted from 1, the lowest: frequency.1".to_owned())
        }
    })
}

fn did_you_mean(owner: &str, close: Option<&str>) -> String {
    close.map_or_else(String::new, |name| format!("did you mean `{owner}{name}`?"))
}

/// SI unit of the result at an address of a study of this model; empty of pure numbers.
pub fn unit(address: &str, model: &Model) -> String {
    match StudyAddress::of(address) {
        Some(StudyAddress::Steady { name }) => unit_in(STEADY_FIGURES, name).to_owned(),
        Some(StudyAddress::Cam { object, name }) => unit_of_cam(model, object, name).to_owned(),
        Some(StudyAddress::Frequency { .. }) => FREQUENCY.si().to_owned(),
        Some(StudyAddress::Linkage { .. }) => studied::unit(address, model).unwrap_or_default(),
        Some(StudyAddress::Within(within)) => spans::unit(within, model),
        None => String::new(),
    }
}

fn unit_of_cam(model: &Model, id: &str, name: &str) -> &'static str {
    let object = model.objects.iter().position(|part| part.id == id);
    let figure = CAM_FIGURES.iter().find(|figure| figure.name == name);
    let (Some(object), Some(figure)) = (object, figure) else {
        return "";
    };
    if name == "preload_needed" {
        return preload_unit(model, object);
    }
    let own = Measures(Some(model.objects[object].coordinate));
    (figure.measure)(own).first.si()
}

fn unit_in(figures: &[Figure<Quantity>], name: &str) -> &'static str {
    let found = figures.iter().find(|figure| figure.name == name);
    match found.map_or("1", |figure| figure.measure.si()) {
        "1" => "",
        unit => unit,
    }
}

fn find(
    address: &str,
    subject: Subject<'_>,
    motion: &mut Option<Answer>,
) -> Result<Option<StudyFigure>, Vec<Fault>> {
    let model = subject.system.model();
    match check(address, model) {
        None => return Ok(None),
        Some(Err(fault)) => return Err(vec![fault]),
        Some(Ok(())) => {}
    }
    let Some(known) = StudyAddress::of(address) else {
        return Ok(None);
    };
    let in_words = |message: String| vec![Fault::new("", format!("{address}: {message}"), "")];
    let duration = subject.settings.duration;
    let value = match known {
        StudyAddress::Linkage {
            study: "kinematics",
            object,
            name,
        } => {
            let found = studied::kinematics_of(model, object, duration).map_err(in_words)?;
            found.figure(name)
        }
        StudyAddress::Linkage { object, name, .. } => {
            let found = studied::forces_of(model, object, duration).map_err(in_words)?;
            found.figure(name)
        }
        StudyAddress::Steady { .. } => {
            let found = match motion {
                Some(found) => found,
                None => motion.insert(steady_motion(subject)?),
            };
            steady::figure(found, address)
        }
        StudyAddress::Cam { object, name } => {
            if CONTACT_RESULTS.contains(&name) {
                of_contact(subject, object, name)?
            } else {
                let cam = disc_cam(subject.scene, model, object)?;
                of_cam(&cam, model, object, name).map_err(in_words)?
            }
        }
        StudyAddress::Within(within) => match StudyAddress::span_of_run(address) {
            Some(figure) => of_motion(figure, subject)?,
            None => spans::of_course(model, within, duration).map_err(in_words)?,
        },
        StudyAddress::Frequency { open, number } => {
            let regime = if open { Regime::Open } else { Regime::Engaged };
            let all = subject.system.natural_frequencies(regime);
            number
                .checked_sub(1)
                .and_then(|at| all.get(at))
                .map(|rate| rate / TAU)
        }
    };
    Ok(Some(StudyFigure {
        value: value.filter(|value| value.is_finite()),
        unit: unit(address, model),
    }))
}

/// A greatest or least value within a part of the motion of a run of its own.
fn of_motion(figure: SpanFigure, subject: Subject<'_>) -> Result<Option<f64>, Vec<Fault>> {
    let address = figure.address.clone();
    let settings = RunSettings {
        spans: vec![figure],
        ..subject.settings.clone()
    };
    let found = run(subject.system, &settings, subject.control, &mut [])?;
    if found.is_trusted() {
        return Ok(found.figures.value(&address).ok());
    }
    let message = "the run is not to be trusted: its checks disagree";
    let fault = Fault::new("run", message, "`dam run` shows them");
    Err(vec![Fault {
        code: NOT_TRUSTED,
        ..fault
    }])
}

fn steady_motion(subject: Subject<'_>) -> Result<Answer, Vec<Fault>> {
    let spec = subject.scene.steady.clone().unwrap_or_default();
    let Subject {
        system,
        settings,
        control,
        ..
    } = subject;
    let found = steady_motion_within(system, settings, &spec, control)?;
    if found.is_trusted() {
        return Ok(found);
    }
    let message = "the steady motion is not to be trusted: its checks disagree";
    let hint = "`dam steady` shows them";
    let fault = Fault::new("steady", message, hint);
    Err(vec![Fault {
        code: NOT_TRUSTED,
        ..fault
    }])
}

/// A result of the contact of a follower, by the closed form or by runs.
fn of_contact(subject: Subject<'_>, id: &str, name: &str) -> Result<Option<f64>, Vec<Fault>> {
    let Subject {
        scene,
        system,
        settings,
        control,
    } = subject;
    let object = system.model().objects.iter().position(|part| part.id == id);
    let unknown = || vec![Fault::new(id, "there is no such object", "")];
    let contact = ElasticContact {
        system,
        object: object.ok_or_else(unknown)?,
        settings,
        control,
    };
    contact_result(scene, contact, name)
}

/// Judges what is expected of the cam of an object, in its order.
pub fn check_cam(
    expectations: &[Expectation],
    subject: Subject<'_>,
    (id, cam): (&str, &DiscCam),
) -> Vec<Verdict> {
    let value = |name: &str| match CONTACT_RESULTS.contains(&name) {
        true => of_contact(subject, id, name).ok().flatten(),
        false => of_cam(cam, subject.system.model(), id, name).ok().flatten(),
    };
    let judge = |expectation: &Expectation| {
        let Expected::Figure { figure, allowed } = &expectation.what else {
            return None;
        };
        match StudyAddress::of(figure)? {
            StudyAddress::Cam { object, name } if object == id => Some(Verdict {
                source: expectation.source.clone(),
                // What has no value, for whatever reason, does not hold.
                ..verdict_on(figure, allowed, value(name))
            }),
            _ => None,
        }
    };
    expectations.iter().filter_map(judge).collect()
}

/// A result of a cam; those of forces are at the speed of the scene.
fn of_cam(cam: &DiscCam, model: &Model, id: &str, name: &str) -> Result<Option<f64>, String> {
    let radius = |concave: usize| {
        let flanks = cam.geometry().flanks();
        let radii = flanks
            .into_iter()
            .filter_map(|flank| cam.radii(flank)[concave]);
        radii.map(|at| at.value).reduce(f64::min)
    };
    let forces = || {
        let object = model.objects.iter().position(|part| part.id == id);
        let object = object.ok_or_else(|| format!("there is no object `{id}`"))?;
        let force = CamForce::new(model, object, cam, None)?;
        Ok::<_, String>(force.figures(Reserve::Share(RESERVE)))
    };
    Ok(match name {
        "base_radius" => Some(cam.geometry().base_radius),
        "prime_radius" => Some(cam.geometry().prime_radius()),
        "greatest_pressure_angle" => {
            let angles = cam.pressure_angles().map(|at| at.value.abs());
            Some(angles[0].max(angles[1]))
        }
        "least_radius" => radius(0),
        "least_concave_radius" => radius(1),
        "least_pitch_radius" => {
            let roller = cam.geometry().roller();
            roller.and_then(|_| cam.radii(0.0)[0]).map(|at| at.value)
        }
        "greatest_contact_force" => Some(forces()?.contact_force.value),
        "greatest_torque" => Some(forces()?.torque.value),
        "least_torque" => Some(forces()?.return_torque.value),
        _ => None,
    })
}
