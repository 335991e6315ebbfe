//! A scene run at other levels of its elastic objects.

use super::bound::{BaseMotion, LeftOutOf, truncation_bound};
use super::requested_figures::is_count;
use crate::budget::Instant;
use crate::dynamics::builder::spec::{ChainSpec, Level, Lumping};
use crate::dynamics::model::{Closure, Model};
use crate::dynamics::record::Figures;
use crate::dynamics::system::System;
use crate::fault::Fault;
use crate::frontend::lower::lower;
use crate::frontend::scene::{Elastic, Levels, TypedScene};
use crate::studies::judgement::{RunEnd, ending};
use crate::studies::lookup::{Subject, attach, named_in};
use crate::studies::run::run;
use crate::studies::{Control, RunSettings};
use std::collections::BTreeMap;

/// A run at some levels.
#[derive(Clone, Debug)]
pub(in crate::studies) struct Trial {
    /// The level of every elastic object.
    pub(in crate::studies) levels: Levels,
    /// What it found; with the warnings, but without samples.
    pub(in crate::studies) figures: Figures,
    /// Error that the integration leaves, relative to the scale of a figure.
    pub(in crate::studies) integration: f64,
    /// The same of single figures, in their units, where a finer run has shown it.
    pub(super) measured: BTreeMap<String, f64>,
    /// True when it was integrated: neither exact nor given by the drives alone.
    pub(super) integrated: bool,
    /// Why it does not count: it ended early, or is not trusted.
    pub(in crate::studies) doubt: Option<String>,
    /// How far the displacement of an object may be off by what its level leaves out, where
    /// that is known beforehand.
    pub(in crate::studies) left_out: BTreeMap<String, LeftOutOf>,
    /// How much it took: evaluations of all coordinates.
    pub(in crate::studies) cost: f64,
    /// Time that the run took (s), by the clock.
    pub(in crate::studies) seconds: f64,
}

impl Trial {
    /// Scale of a figure, no less than what the run resolves.
    pub(super) fn scale_of_figure(&self, figure: &str) -> f64 {
        let resolution = self.figures.resolution(figure);
        self.figures.scale(figure).max(resolution)
    }

    /// Error that the integration leaves in a figure, in its unit.
    pub(super) fn integration_of(&self, figure: &str) -> f64 {
        match (self.measured.get(figure), is_count(figure)) {
            (Some(measured), _) => *measured,
            (None, true) => 0.0,
            (None, false) => self.integration * self.scale_of_figure(figure),
        }
    }
}

/// The scene, and all runs of it made so far.
pub(in crate::studies) struct Trials<'s> {
    pub(in crate::studies) scene: &'s mut TypedScene,
    pub(in crate::studies) elastic: Elastic,
    settings: RunSettings,
    control: &'s Control<'s>,
    pub(in crate::studies) made: Vec<Trial>,
    /// The model of the last run.
    model: Option<Model>,
    /// The motions of driven ends that are prescribed, by their objects.
    motions: BTreeMap<String, Option<Option<BaseMotion>>>,
    /// True when a run was ended from outside.
    pub(in crate::studies) interrupted: bool,
}

/// A contact is soft up to so many times the stiffness of the object: of a rod that strikes
/// a wall balanced cells are the better ones up to 1, those of far ends from 10.
const SOFT: f64 = 2.0;
/// Error of exact propagation, relative: rounding.
const OF_EXACT: f64 = 1e-11;

impl<'s> Trials<'s> {
    /// No runs yet.
    pub(in crate::studies) fn new(
        scene: &'s mut TypedScene,
        settings: &RunSettings,
        control: &'s Control<'s>,
    ) -> Self {
        let elastic = scene.elastic();
        let settings = RunSettings {
            samples: 0,
            masses: false,
            switch_rows: false,
            closeups: false,
            of_accuracy: None,
            ..settings.clone()
        };
        Self {
            scene,
            elastic,
            settings,
            control,
            made: Vec::new(),
            model: None,
            motions: BTreeMap::new(),
            interrupted: false,
        }
    }

    /// No runs yet, and the levels of all objects are to be chosen, given or not.
    pub(in crate::studies) fn all_open(
        scene: &'s mut TypedScene,
        settings: &RunSettings,
        control: &'s Control<'s>,
    ) -> Self {
        let mut trials = Self::new(scene, settings, control);
        for object in trials.elastic.objects.values_mut() {
            object.1 = None;
        }
        trials
    }

    /// The run at these levels; each is made once. Its number among all.
    ///
    /// # Errors
    /// The model at these levels cannot be built or started.
    pub(in crate::studies) fn at(&mut self, levels: &Levels) -> Result<usize, Vec<Fault>> {
        if let Some(known) = self.made.iter().position(|trial| trial.levels == *levels) {
            return Ok(known);
        }
        let trial = self.run(levels, self.settings.tolerance)?;
        self.made.push(trial);
        Ok(self.made.len() - 1)
    }

    /// A run at these levels with a tolerance, whether there has been one or not.
    ///
    /// # Errors
    /// The model at these levels cannot be built or started.
    pub(in crate::studies) fn run(
        &mut self,
        levels: &Levels,
        tolerance: f64,
    ) -> Result<Trial, Vec<Fault>> {
        self.elastic.set(self.scene, levels);
        let system = System::new(lower(self.scene)?)?;
        let settings = RunSettings {
            tolerance,
            ..self.settings.clone()
        };
        let begun = Instant::now();
        let mut result = run(&system, &settings, self.control, &mut [])?;
        let seconds = begun.elapsed().as_secs_f64();
        self.interrupted |= result.outcome.stop.is_from_outside();
        let subject = Subject {
            scene: self.scene,
            system: &system,
            settings: &settings,
            control: self.control,
        };
        attach(&mut result.figures, named_in(self.scene), subject)?;
        let exact = result.figures.run.method == "exact";
        let statistics = &result.outcome.statistics;
        let passes = (statistics.steps + statistics.evaluations) as f64;
        // A mechanism that stops by itself has perfectly good figures.
        let doubt = match (ending(&result.figures), result.is_trusted()) {
            (RunEnd::FromOutside | RunEnd::OfScene, _) => {
                result.figures.run.stopped_because.clone()
            }
            (RunEnd::Complete | RunEnd::OfMechanism, true) => None,
            (RunEnd::Complete | RunEnd::OfMechanism | RunEnd::OfComputation, _) => {
                Some("its results are in doubt".to_owned())
            }
        };
        let left_out = match exact && doubt.is_none() {
            true => self.truncation_bounds(system.model(), levels),
            false => BTreeMap::new(),
        };
        self.model = Some(system.model().clone());
        let integrated = !exact && result.figures.run.method != "kinematic";
        Ok(Trial {
            levels: levels.clone(),
            left_out,
            integration: if exact {
                OF_EXACT
            } else {
                result.tolerance.max(tolerance)
            },
            measured: BTreeMap::new(),
            integrated,
            doubt,
            cost: passes * (1.0 + coordinates(levels) as f64),
            seconds,
            figures: result.figures,
        })
    }

    /// Tolerance of the scene.
    pub(super) fn own_tolerance(&self) -> f64 {
        self.settings.tolerance
    }

    /// True when nobody said how runs are to be integrated.
    pub(super) fn integration_is_open(&self) -> bool {
        self.settings.method.is_none() && !self.scene.run.tolerance_given
    }

    /// What the levels of objects leave out, where there is a bound. A motion that is
    /// prescribed at some levels is the same at all at which it is.
    fn truncation_bounds(&mut self, model: &Model, levels: &Levels) -> BTreeMap<String, LeftOutOf> {
        let end = self.settings.duration;
        let scene = &*self.scene;
        let motions = &mut self.motions;
        let bound = |(id, level): (&String, &Level)| {
            let motion = motions.entry(id.clone()).or_default();
            let bound = truncation_bound((scene, model), (id, *level), end, motion)?;
            Some((id.clone(), bound))
        };
        levels.iter().filter_map(bound).collect()
    }

    /// The model of the last run.
    pub(in crate::studies) fn model(&self) -> Option<&Model> {
        self.model.as_ref()
    }

    /// True when the pair of an object that is taken to stay closed would open.
    pub(in crate::studies) fn would_open(&self, trial: usize, id: &str) -> bool {
        let object = self.made[trial].figures.objects.get(id);
        let margin = object.and_then(|object| object.pair.as_ref()?.margin);
        margin.is_some_and(|margin| margin <= 0.0)
    }

    /// True when the pair of an object opened, or closed.
    pub(super) fn switched(&self, trial: usize, id: &str) -> bool {
        let object = self.made[trial].figures.objects.get(id);
        let pair = object.and_then(|object| object.pair.as_ref());
        pair.is_some_and(|pair| pair.separations + pair.closures > 0)
    }

    fn chain(&self, id: &str) -> Option<&ChainSpec> {
        self.scene.objects.get(id)?.object.chain()
    }

    /// Whether an object may be reduced to modes: those of the object held at its driven end,
    /// of a pair that stays closed, or those of the free object behind a contact element.
    pub(in crate::studies) fn may_be_reduced(&self, id: &str) -> bool {
        self.chain(id).is_some_and(|chain| {
            let modes = match chain.pair.contact {
                Some(contact) => !contact.law.is_rigid(),
                None => chain.pair.closure != Closure::Form,
            };
            modes && chain.stops.is_empty()
        })
    }

    /// Whether an object may be reduced to its static flexibility, that of its contact
    /// element in series.
    pub(in crate::studies) fn may_be_static(&self, id: &str) -> bool {
        self.chain(id).is_some_and(|chain| {
            let contact = chain.pair.contact.map(|contact| contact.law);
            let linear = contact.is_none_or(|law| law.declaration().is_linear());
            linear && chain.pair.closure != Closure::Form && chain.stops.is_empty()
        })
    }

    /// Whether there is a contact element before an object.
    pub(in crate::studies) fn has_contact(&self, id: &str) -> bool {
        self.chain(id)
            .is_some_and(|chain| chain.pair.contact.is_some())
    }

    /// Whether the pair of an object holds it between two flanks.
    pub(super) fn is_form_closed(&self, id: &str) -> bool {
        self.chain(id)
            .is_some_and(|chain| chain.pair.closure == Closure::Form)
    }

    /// Where the inertia of the cells of an object of masses is put: at both their ends, of
    /// the second order, where its contact is no stiffer than a few times the object. What
    /// strikes a stiffer one first is the first mass alone, which is then half a cell too
    /// heavy.
    pub(in crate::studies) fn lumping(&self, id: &str) -> Lumping {
        let contact = self.chain(id).and_then(|chain| chain.pair.contact);
        let (Some(contact), Some((body, _))) = (contact, self.elastic.objects.get(id)) else {
            return Lumping::Ends;
        };
        let linear = contact.law.form().exponent() == 1.0;
        match linear && contact.stiffness <= SOFT * body.stiffness {
            true => Lumping::Balanced,
            false => Lumping::Ends,
        }
    }

    /// Whether an object may be rigid.
    pub(in crate::studies) fn may_be_rigid(&self, id: &str) -> bool {
        self.chain(id).is_some_and(|chain| {
            chain.pair.contact.is_some() || chain.pair.closure != Closure::Form
        })
    }
}

/// Coordinates of all objects, as their levels name them.
pub(in crate::studies) fn coordinates(levels: &Levels) -> usize {
    levels.values().map(|level| level.coordinates()).sum()
}

/// The levels with that of one object changed.
pub(in crate::studies) fn with_level(levels: &Levels, id: &str, level: Level) -> Levels {
    let mut changed = levels.clone();
    changed.insert(id.to_owned(), level);
    changed
}
