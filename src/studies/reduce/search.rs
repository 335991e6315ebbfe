//! The search for the smallest scene.

use super::cost::measured;
use super::description::describe;
use super::findings::{Change, ModelTried, Reduction, Refusal, Role, Step};
use super::removal::{Part, Removal, possible_removals};
use super::variant::{at_levels, scene_without, words};
use crate::fault::Fault;
use crate::frontend::diagnostics::Diagnostics;
use crate::frontend::scene::{Document, Levels, Reading};
use crate::math::order::Total;
use crate::studies::order::Certificate;
use crate::studies::order::choose::families;
use crate::studies::order::figure_limits::{FigureLimits, first_accurate_trial};
use crate::studies::order::judge::{Judge, Objection};
use crate::studies::order::lessen::{LevelReduction, lessened};
use crate::studies::order::trial::{Trial, Trials, coordinates};
use crate::studies::{Control, RunSettings};

/// Finds the smallest scene that gives the figures asked for within their accuracy.
/// `document`: what `reading` was decoded from; `settings`: those of its run. `keep` is called
/// once there is something to be kept, should the search be ended.
///
/// # Errors
/// The model cannot be built or started.
pub fn reduce(
    document: &Document,
    mut reading: Reading,
    settings: &RunSettings,
    control: &Control<'_>,
    keep: &mut dyn FnMut(),
) -> Result<Reduction, Diagnostics> {
    let whole = document.decoded(&reading.places);
    let places = reading.places.clone();
    let diagnose = |faults: Vec<Fault>| places.diagnose(&faults);
    let given = reading.scene.elastic();
    let mut trials = Trials::all_open(&mut reading.scene, settings, control);
    let mut families = families(&trials);
    let known = FigureLimits::of(&mut trials, &mut families).map_err(diagnose)?;
    let judge = known.judge();
    let first =
        first_accurate_trial(&mut trials, &families, &known.row, &judge).map_err(diagnose)?;
    keep();
    let mut search = Search {
        whole: &whole,
        settings,
        control,
        judge,
        steps: Vec::new(),
        models: Vec::new(),
    };
    let enough = search.judge.decides() && search.judge.accepts(&trials, first);
    let mut found = first;
    if enough {
        found = search.lessen(&mut trials, first);
    }
    let levels = trials.made[found].levels.clone();
    let given: Levels = (given.objects.iter())
        .map(|(id, (_, level))| (id.clone(), level.unwrap_or(trials.made[first].levels[id])))
        .collect();
    let as_given = trials.at(&given).ok();
    let as_given = as_given.map(|as_given| {
        search.keep_for_chart(&[], &trials.made[as_given], Role::Given);
        search.judge.certificate(&trials, &families, as_given)
    });
    let tried = trials.made.iter().filter(|trial| trial.doubt.is_none());
    for trial in tried {
        search.keep_for_chart(&[], trial, Role::Tried);
    }
    let mut end = SearchEnd {
        removals: Vec::new(),
        certificate: search.judge.certificate(&trials, &families, found),
        levels,
        trial: trials.made[found].clone(),
    };
    let interrupted = trials.interrupted;
    if enough {
        end = search.remove_all(end);
    }
    Ok(search.finish(&reading.scene.name, end, (&given, as_given), interrupted))
}

/// What has been found so far.
struct Search<'s> {
    whole: &'s Document,
    settings: &'s RunSettings,
    control: &'s Control<'s>,
    judge: Judge<'s>,
    steps: Vec<Step>,
    models: Vec<ModelTried>,
}

/// The scene that the search has come to.
struct SearchEnd {
    removals: Vec<Removal>,
    levels: Levels,
    trial: Trial,
    certificate: Certificate,
}

/// A removal tried: its run, and what stands against it.
type TriedRemoval = Result<(Trial, Option<Refusal>), String>;

impl Search<'_> {
    /// Lowers the levels of single objects; the trial it comes to.
    fn lessen(&mut self, trials: &mut Trials<'_>, from: usize) -> usize {
        let families = families(trials);
        let (steps, judge, control) = (&mut self.steps, &self.judge, self.control);
        lessened(trials, &families, judge, from, |trials, tried| {
            if let Some(tried) = tried {
                note_level(steps, judge, trials, &tried);
            }
            !control.is_spent()
        })
    }

    /// Leaves out everything that can be left out.
    fn remove_all(&mut self, mut end: SearchEnd) -> SearchEnd {
        let base = end.trial.clone();
        let mut alone = Vec::new();
        for removal in self.possible_removals(&base) {
            if self.control.is_spent() {
                return end;
            }
            let tried = self.try_removals(std::slice::from_ref(&removal), &end.levels);
            alone.push((removal, tried));
        }
        // A whole before its parts, then what changes least first.
        alone.sort_by_cached_key(|(removal, tried)| {
            let part = matches!(removal.part, Part::Friction(_) | Part::Mass(_));
            let greatest = |(trial, _): &(Trial, _)| {
                let changes = self.changes(&base, trial);
                let shares = changes
                    .values()
                    .map(|one| one.share.unwrap_or(f64::INFINITY));
                shares.fold(0.0, f64::max)
            };
            let greatest = tried.as_ref().map_or(f64::INFINITY, greatest);
            (part, Total(greatest))
        });
        for (removal, tried) in alone {
            if self.control.is_spent() {
                return end;
            }
            if end.removals.iter().any(|other| removal.is_within(other)) {
                continue;
            }
            match tried {
                Ok((_, None)) => self.on_top(&mut end, removal),
                tried => self.refuse_removal(removal, &base, tried),
            }
        }
        self.lower_levels_again(end)
    }

    /// What may be left out, judged by the run of the whole.
    fn possible_removals(&self, base: &Trial) -> Vec<Removal> {
        let never_opens = |id: &str| {
            let object = base.figures.objects.get(id);
            let pair = object.and_then(|object| object.pair.as_ref());
            pair.is_some_and(|pair| {
                let closed = pair.margin.is_none_or(|margin| margin > 0.0);
                pair.separations == 0 && pair.closures == 0 && closed
            })
        };
        possible_removals(self.whole.root(), never_opens)
    }

    /// Leaves something more out of the scene, if it stays accurate enough.
    fn on_top(&mut self, end: &mut SearchEnd, removal: Removal) {
        let mut removals = end.removals.clone();
        removals.push(removal.clone());
        match self.try_removals(&removals, &end.levels) {
            Ok((trial, None)) => {
                self.steps.push(Step {
                    removal,
                    changes: self.changes(&end.trial, &trial),
                    refused: None,
                });
                (end.removals, end.trial) = (removals, trial);
            }
            tried => self.refuse_removal(removal, &end.trial.clone(), tried),
        }
    }

    fn refuse_removal(&mut self, removal: Removal, before: &Trial, tried: TriedRemoval) {
        let (changes, refused) = match tried {
            Ok((trial, refused)) => (self.changes(before, &trial), refused),
            Err(why) => (Default::default(), Some(Refusal::Impossible(why))),
        };
        self.steps.push(Step {
            removal,
            changes,
            refused,
        });
    }

    /// Lowers levels once more: pairs that are bilateral now allow lower ones.
    fn lower_levels_again(&mut self, mut end: SearchEnd) -> SearchEnd {
        let Ok(mut scene) = scene_without(self.whole, &end.removals) else {
            return end;
        };
        let mut trials = Trials::all_open(&mut scene, self.settings, self.control);
        let Ok(from) = trials.at(&end.levels) else {
            return end;
        };
        let found = match end.removals.is_empty() {
            true => from,
            false => self.lessen(&mut trials, from),
        };
        for trial in &trials.made {
            self.keep_for_chart(&end.removals, trial, Role::Tried);
        }
        end.certificate = match end.removals.is_empty() {
            true => end.certificate,
            false => {
                let families = families(&trials);
                self.judge.certificate(&trials, &families, found)
            }
        };
        end.levels = trials.made[found].levels.clone();
        end.trial = trials.made[found].clone();
        end
    }

    /// The run of the scene without what is left out.
    fn try_removals(&mut self, removals: &[Removal], levels: &Levels) -> TriedRemoval {
        let mut scene = scene_without(self.whole, removals)?;
        let mut trials = Trials::all_open(&mut scene, self.settings, self.control);
        let made = trials.at(levels).map_err(|faults| words(&faults))?;
        let refused = self
            .judge
            .reason_against_trial(&trials, made)
            .map(Refusal::from);
        let trial = trials.made.swap_remove(made);
        self.keep_for_chart(removals, &trial, Role::Tried);
        Ok((trial, refused))
    }

    fn changes(&self, before: &Trial, after: &Trial) -> std::collections::BTreeMap<String, Change> {
        changes(&self.judge, before, after)
    }

    /// Keeps a model that was run for the chart; each once.
    fn keep_for_chart(&mut self, removals: &[Removal], trial: &Trial, role: Role) {
        let without: Vec<String> = removals.iter().map(Removal::to_string).collect();
        let known =
            |model: &&mut ModelTried| model.without == without && model.levels == trial.levels;
        if let Some(model) = self.models.iter_mut().find(known) {
            if role != Role::Tried && model.role != Role::Given {
                model.role = role;
            }
            return;
        }
        let figures = self.judge.asked.iter().zip(self.judge.courses);
        let errors = figures.filter_map(|(asked, course)| {
            Judge::bound(asked, course)?;
            let error = Judge::error(trial, asked, course);
            let error = error.filter(|error| error.is_finite());
            Some((asked.figure.clone(), error))
        });
        self.models.push(ModelTried {
            without,
            levels: trial.levels.clone(),
            coordinates: coordinates(&trial.levels),
            seconds: trial.seconds,
            errors: errors.collect(),
            role,
        });
    }

    /// The end; `given`: levels and certificate of the scene as given.
    fn finish(
        mut self,
        scene: &str,
        end: SearchEnd,
        (given, as_given): (&Levels, Option<Certificate>),
        interrupted: bool,
    ) -> Reduction {
        self.keep_for_chart(&end.removals, &end.trial, Role::Reduced);
        let cost = match end.removals.is_empty() && end.levels == *given {
            true => None,
            false => {
                let how = (self.settings, self.control);
                measured(self.whole, how, given, (&end.removals, &end.levels))
            }
        };
        let mut document = at_levels(self.whole, &end.removals, &end.levels);
        let mut reduction = Reduction {
            scene: scene.to_owned(),
            complete: !interrupted && !self.control.is_spent(),
            steps: self.steps,
            certificate: end.certificate,
            models: self.models,
            cost,
            document: document.clone(),
        };
        match as_given.filter(|_| !reduction.is_offered()) {
            Some(as_given) => {
                reduction.certificate = as_given;
                reduction.document = self.whole.clone();
            }
            None => {
                document.edit(|root| describe(root, &reduction));
                reduction.document = document;
            }
        }
        reduction
    }
}

/// What a model differs in from another, in each figure that has a limit.
fn changes(
    judge: &Judge<'_>,
    before: &Trial,
    after: &Trial,
) -> std::collections::BTreeMap<String, Change> {
    let figures = judge.asked.iter().zip(judge.courses);
    let change = figures.filter_map(|(asked, course)| {
        let bound = Judge::bound(asked, course)?;
        let values = [before, after].map(|trial| trial.figures.value(&asked.figure).ok());
        let change = values[1]? - values[0]?;
        let share = match change == 0.0 {
            true => 0.0,
            false => change.abs() / bound,
        };
        let share = Some(share).filter(|share| share.is_finite());
        Some((asked.figure.clone(), Change { change, share }))
    });
    change.collect()
}

/// Notes a level that was tried. Of the levels refused to an object the last, which is the
/// nearest to the one that it keeps, stands for all.
fn note_level(
    steps: &mut Vec<Step>,
    judge: &Judge<'_>,
    trials: &Trials<'_>,
    tried: &LevelReduction,
) {
    let [before, after] = tried.trials.map(|made| &trials.made[made]);
    let is_level = |step: &Step| {
        let level = matches!(step.removal.part, Part::Level { .. });
        level && step.removal.object == tried.id
    };
    steps.retain(|step| !(is_level(step) && step.refused.is_some()));
    let refused = match tried.accepted {
        true => None,
        false => (judge.reason_against_trial(trials, tried.trials[1])).map(Refusal::from),
    };
    steps.push(Step {
        removal: Removal {
            object: tried.id.clone(),
            part: Part::Level {
                from: before.levels[&tried.id],
                to: after.levels[&tried.id],
            },
        },
        changes: changes(judge, before, after),
        refused,
    });
}

impl From<Objection> for Refusal {
    fn from(objection: Objection) -> Self {
        match objection {
            Objection::Doubt(why) => Self::Doubt(why),
            Objection::Opens(id) => Self::Opens(id),
            Objection::Figure { figure, error } => Self::Figure {
                figure,
                error: Some(error).filter(|error| error.is_finite()),
            },
        }
    }
}
