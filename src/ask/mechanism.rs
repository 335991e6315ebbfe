//! A scene made ready to be asked.

use super::RunOptions;
use crate::Error;
use crate::dynamics::model::Model;
use crate::dynamics::record::Figures;
use crate::dynamics::system::System;
use crate::fault::Fault;
use crate::frontend::lower::lower;
use crate::frontend::scene::{Reading, TypedScene};
use crate::studies::expectations::{Requirement, unknown_figures};
use crate::studies::order::{Certificate, choose};
use crate::studies::run::{RunResult, run};
use crate::studies::steady::{Answer, steady_motion_within};
use crate::studies::studied::wrong_units;
use crate::studies::{Control, RunSettings, clock, lookup, plausible, requirements};

/// A scene that was checked, lowered and frozen: it is asked without being read again.
#[derive(Debug)]
pub struct Mechanism {
    /// The scene with what its reading left behind: warnings, canonical form, places.
    pub reading: Reading,
    /// Equations of motion.
    pub system: System,
    /// Settings of the run.
    pub settings: RunSettings,
    /// What its figures are worth, the error of the model included: where it was judged.
    pub certificate: Option<Certificate>,
}

impl Mechanism {
    /// Makes a scene ready that has been read; its model is judged where an object leaves its
    /// level open.
    ///
    /// # Errors
    /// Every fault of the first stage that finds any: of the model, of what the scene
    /// expects, of the start.
    pub fn of(reading: Reading) -> Result<Self, Error> {
        Self::of_within(reading, ModelAssessment::Needed, &Control::default())
    }

    /// The same, with the model judged as far as is said, and ended from outside.
    ///
    /// # Errors
    /// As of [`Self::of`].
    pub fn of_within(
        mut reading: Reading,
        judging: ModelAssessment,
        control: &Control<'_>,
    ) -> Result<Self, Error> {
        let places = reading.places.clone();
        let diagnose = |faults: Vec<Fault>| places.diagnose(&faults);
        let mut model = lower(&reading.scene).map_err(diagnose)?;
        let mut settings = sound_settings(&reading.scene, &model).map_err(diagnose)?;
        let mut certificate = None;
        if judging.applies(&reading.scene) {
            let chosen = choose(&mut reading.scene, &settings, control).map_err(diagnose)?;
            model = lower(&reading.scene).map_err(diagnose)?;
            certificate = Some(chosen.certificate);
            settings.of_accuracy = chosen.of_accuracy;
        }
        let unlikely = plausible::warnings(&model, settings.duration);
        model.warnings.extend(unlikely);
        let system = System::new(model).map_err(diagnose)?;
        Ok(Self {
            reading,
            system,
            settings,
            certificate,
        })
    }

    /// The scene, typed and in SI units.
    pub fn scene(&self) -> &TypedScene {
        &self.reading.scene
    }

    /// The model: nodes, links, loads.
    pub fn model(&self) -> &Model {
        self.system.model()
    }

    /// Warnings to the user before the run, a line each.
    pub fn warnings(&self) -> Vec<String> {
        let mut lines = self.reading.warnings.lines();
        lines.extend(self.model().warnings.iter().cloned());
        lines
    }

    /// Runs it as the scene says.
    ///
    /// # Errors
    /// The start cannot be found; the method asked for cannot be used.
    pub fn run(&self) -> Result<RunResult, Error> {
        self.run_within(&Control::default())
    }

    /// Runs it, ended from outside: by a flag, or after a time.
    ///
    /// # Errors
    /// The start cannot be found; the method asked for cannot be used.
    pub fn run_within(&self, control: &Control<'_>) -> Result<RunResult, Error> {
        let found = run(&self.system, &self.settings, control, &mut []);
        let mut found = found.map_err(|faults| self.diagnose(&faults))?;
        let named = lookup::named_in(self.scene());
        self.attach(&mut found.figures, named, control)?;
        found.figures.warnings.extend(self.shortfalls());
        Ok(found)
    }

    /// Judges everything that the scene expects, in its order, by the run and the studies that it
    /// takes; ended from outside.
    ///
    /// # Errors
    /// It was ended before everything was judged.
    pub fn verify_within(&self, control: &Control<'_>) -> Result<Vec<Requirement>, Error> {
        let all = requirements::judge_requirements(self.subject(control));
        match control.is_spent() {
            true => Err(Error::question("the judging was interrupted")),
            false => Ok(all),
        }
    }

    /// What is wrong with each figure that does not hold the accuracy that the scene asks for.
    pub fn shortfalls(&self) -> Vec<String> {
        let asked = self.scene().run.accuracy.is_some();
        let certificate = self.certificate.as_ref().filter(|_| asked);
        certificate.map_or_else(Vec::new, Certificate::shortfalls)
    }

    /// Adds the results of studies that are named, `frequency.1`, to the figures of a run.
    ///
    /// # Errors
    /// There is no such result; a study cannot be made, or is not to be trusted.
    pub(crate) fn attach<'a>(
        &self,
        figures: &mut Figures,
        addresses: impl IntoIterator<Item = &'a str>,
        control: &Control<'_>,
    ) -> Result<(), Error> {
        let attached = lookup::attach(figures, addresses, self.subject(control));
        attached.map_err(|faults| self.diagnose(&faults))
    }

    /// The steady motion that the scene's `steady` block asks for.
    ///
    /// # Errors
    /// Every fault of the question, or why there is no steady motion.
    pub fn steady(&self) -> Result<Answer, Error> {
        self.steady_within(&Control::default())
    }

    /// Finds its steady motion, ended from outside: by a flag, or after a time.
    ///
    /// # Errors
    /// As [`Self::steady`]; ended before there was an answer.
    pub fn steady_within(&self, control: &Control<'_>) -> Result<Answer, Error> {
        let spec = self.scene().steady.clone().unwrap_or_default();
        let found = steady_motion_within(&self.system, &self.settings, &spec, control);
        found.map_err(|faults| self.diagnose(&faults))
    }

    /// What studies are asked of.
    pub(super) fn subject<'s>(&'s self, control: &'s Control<'s>) -> lookup::Subject<'s> {
        lookup::Subject {
            scene: self.scene(),
            system: &self.system,
            settings: &self.settings,
            control,
        }
    }

    /// Faults found later, with their places.
    pub(super) fn diagnose(&self, faults: &[Fault]) -> Error {
        self.reading.places.diagnose(faults).into()
    }
}

/// Whether the error of the model is judged, by runs of finer and lesser models.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum ModelAssessment {
    /// Nowhere: an object whose level is open stands for one mass.
    Never,
    /// Where an object leaves its level open.
    Needed,
    /// There, and where the scene says how accurate its figures are to be.
    Asked,
}

impl ModelAssessment {
    fn applies(self, scene: &TypedScene) -> bool {
        let open = scene.elastic().open_levels().next().is_some();
        match self {
            Self::Never => false,
            Self::Needed => open,
            Self::Asked => open || scene.run.accuracy.is_some(),
        }
    }
}

/// How a scene is to be run, where that makes sense; what it expects exists.
fn sound_settings(scene: &TypedScene, model: &Model) -> Result<RunSettings, Vec<Fault>> {
    let mut faults = unknown_figures(&scene.expect, model);
    faults.extend(lookup::unknown_figures(&scene.expect, model));
    faults.extend(wrong_units(&scene.measured, model));
    if !faults.is_empty() {
        return Err(faults);
    }
    let settings = RunSettings::of(scene).map_err(|fault| vec![fault])?;
    let faults = clock::not_followable(model, &settings);
    match faults.is_empty() {
        true => Ok(settings),
        false => Err(faults),
    }
}

impl super::Scene {
    /// Runs the scene with some settings changed.
    ///
    /// # Errors
    /// Everything that is wrong with it or with the settings.
    pub fn run_with(&self, options: &RunOptions<'_>) -> Result<RunResult, Error> {
        let changed = options
            .apply(self.clone())
            .prepare_within(&options.control)?;
        changed.run_within(&options.control)
    }
}
