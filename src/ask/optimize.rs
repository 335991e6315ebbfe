//! The best values of several variables under conditions.

use super::gradient::figure_unit;
use super::prepared::PointSource;
use super::variables::{own_values, ready, step, variables};
use crate::Error;
use crate::dynamics::builder::spec::Level;
use crate::dynamics::model::Model;
use crate::frontend::diagnostics::{Diagnostic, Diagnostics, Sources};
use crate::frontend::lower::lower;
use crate::frontend::scene::{Levels, OptimizeSpec, Reading, in_words};
use crate::studies::condition::{Condition, Relation, counts};
use crate::studies::find::{Aim, Goal, State, figures_of};
use crate::studies::gradient::names;
use crate::studies::optimize::{
    AskedFigure, FinerCheck, MOST_STARTS, Optimization, OptimizationTask, STARTS, Variable,
    optimize as find_optimum,
};
use crate::studies::prepared::{PointQuestion, Prepared, finest_levels};
use crate::studies::rigid::Rigid;
use crate::studies::side_by_side::threads as number_of_threads;
use crate::studies::{Control, lookup};
use std::collections::BTreeMap;
use std::sync::Arc;
use std::sync::atomic::AtomicUsize;

/// Share of its size by which a condition may be violated by a finer model.
const FINER: f64 = 1e-4;

/// Share of itself by which the goal may move with a finer model, if no start tells what is gained.
const MOVED: f64 = 0.01;

/// What is sought.
#[derive(Clone, Debug, Default)]
pub struct OptimizeQuestion {
    /// The variables and their ranges: `rocker.inertia=0.05:0.4`, with `:START` for the value of the
    /// first start, and `:log` for equal ratios. Empty: those of the scene's block `optimize`.
    pub vary: Vec<String>,
    /// Conditions on figures: `valve.pair.margin >= 50 N`; `valve.pair.in_working_order = true`
    /// stands for a margin of at least zero. Empty: those of the block.
    pub subject: Vec<String>,
    /// Which end is sought, and of what: the address of a variable, or of a figure. `None`: that of
    /// the block.
    pub goal: Option<(Aim, String)>,
    /// Number of starts; 0: that of the block, else [`STARTS`].
    pub starts: usize,
    /// Number of threads; default: one for every processor core. Results do not depend on it.
    pub threads: Option<usize>,
}

impl OptimizeQuestion {
    /// The question with what it leaves open as the scene has it.
    ///
    /// # Errors
    /// The scene names two goals, and the question none.
    fn filled(&self, block: Option<&OptimizeSpec>) -> Result<Self, Error> {
        let mut all = self.clone();
        let Some(block) = block else {
            return Ok(all);
        };
        if all.vary.is_empty() {
            all.vary.clone_from(&block.vary);
        }
        if all.subject.is_empty() {
            all.subject.clone_from(&block.subject);
        }
        if all.starts == 0 {
            all.starts = block.starts.map_or(0, |count| count as usize);
        }
        if all.goal.is_none() {
            let goal = |aim, of: &Option<String>| of.clone().map(|of| (aim, of));
            let [greatest, least] = [
                goal(Aim::Maximize, &block.maximize),
                goal(Aim::Minimize, &block.minimize),
            ];
            if greatest.is_some() && least.is_some() {
                let message =
                    "the block `optimize` has `maximize` and `minimize`: give one of them";
                return Err(Error::question(message));
            }
            all.goal = greatest.or(least);
        }
        Ok(all)
    }
}

/// Finds the best values. `heard`: receives the number of places that were looked at, from any
/// thread.
///
/// # Errors
/// As of [`Scene::optimize`](super::Scene::optimize).
pub(crate) fn optimize(
    question: &OptimizeQuestion,
    source: &PointSource<'_, '_>,
    control: &Control<'_>,
    heard: &(dyn Fn(usize) + Sync),
) -> Result<Optimization, Error> {
    if cfg!(target_family = "wasm") {
        let message = "a browser tab has no optimiser; `dam optimize` and `dam studio` have one";
        return Err(Error::question(message));
    }
    let reading = source.decode(&[])?;
    let question = &question.filled(reading.scene.optimize.as_ref())?;
    let model = lower(&reading.scene).map_err(|faults| reading.places.diagnose(&faults))?;
    let resolved = Resolved::of(question, &reading, &model, source)?;
    let names: Vec<String> = (resolved.figures.iter())
        .filter(|one| one.index.is_some())
        .map(|one| one.address.clone())
        .collect();
    let is_rigid = names.iter().any(|figure| lookup::is_rigid(figure));
    let rigid = Rigid::label(&model, &["dam run"]).filter(|_| is_rigid);
    let levels = finest_levels(std::iter::once(source.decode(&[])?), &names);
    let base = ready(source.decode(&[])?, &levels, control)?;
    let prepared = Prepared::new(PointQuestion {
        document: Arc::new(
            source
                .document
                .without_expectations()
                .with_levels(levels.clone()),
        ),
        catalogue: Arc::clone(&source.catalogue),
        fixed: source.settings.to_vec(),
        parameters: resolved.variables.iter().map(Variable::parameter).collect(),
        figures: names,
        digits: None,
    });
    let task = OptimizationTask {
        step: step(&base),
        variables: resolved.variables,
        conditions: resolved.conditions,
        goal: resolved.goal,
        figures: resolved.figures,
        prepared,
        why_differences: String::new(),
        control,
        heard,
        looked: AtomicUsize::new(0),
    };
    let starts = match question.starts {
        0 => STARTS,
        starts => starts,
    };
    let threads = number_of_threads(question.threads);
    let mut found = find_optimum(task, &resolved.own, starts, threads);
    found.rigid = rigid;
    if let Some(best) = found.optima.first() {
        let each = found.variables.iter().zip(&best.values);
        let settings: Vec<String> = each
            .map(|(variable, value)| variable.parameter().setting(*value))
            .collect();
        let written = source.decode(&settings)?;
        found.scene_text = source.document.decoded(&written.places).text().to_owned();
        found.finer = Some(finer_check(&found, written, &levels, control));
        found.settings = settings;
        found.complete &= !control.is_spent();
    }
    Ok(found)
}

/// The question as the scene has it.
struct Resolved {
    variables: Vec<Variable>,
    conditions: Vec<Condition>,
    goal: Goal,
    figures: Vec<AskedFigure>,
    /// Values of the variables in the scene, in their units.
    own: Vec<f64>,
}

impl Resolved {
    /// All that is wrong with the question at once.
    fn of(
        question: &OptimizeQuestion,
        reading: &Reading,
        model: &Model,
        source: &PointSource<'_, '_>,
    ) -> Result<Self, Error> {
        let mut wrong: Vec<Diagnostic> = Vec::new();
        let variables = variables(&question.vary, model, &mut wrong);
        let mut fault = |what: String| wrong.push(Diagnostic::error("question", what));
        if question.starts > MOST_STARTS {
            fault(format!(
                "--starts {}: at most {MOST_STARTS} starts",
                question.starts
            ));
        }
        let mut conditions = Vec::new();
        for text in &question.subject {
            match condition(text, model) {
                Ok(condition) => conditions.push(condition),
                Err(what) => fault(format!("--subject {what}")),
            }
        }
        let is_wrong_variable = |of: &String| {
            let named = |text: &String| text.split('=').next().map(str::trim) == Some(of);
            question.vary.iter().any(named) && !variables.iter().any(|one| one.path == *of)
        };
        let goal = match &question.goal {
            // What is wrong with it is said of its range.
            Some((_, of)) if is_wrong_variable(of) => {
                return Err(Diagnostics::new(Sources::default(), wrong).into());
            }
            Some((aim, of)) => goal(*aim, of, &variables, model),
            None => Err("nothing is to be best: name it with --minimize or --maximize".to_owned()),
        };
        let goal = goal.map_err(&mut fault).ok();
        let own = own_values(&variables, (reading, source), &mut wrong);
        let (Some(goal), true) = (goal, wrong.is_empty()) else {
            return Err(Diagnostics::new(Sources::default(), wrong).into());
        };
        Ok(Self {
            figures: figures(&goal, &conditions, model),
            variables,
            conditions,
            goal,
            own,
        })
    }
}

/// A condition; of working order that on the least contact force.
fn condition(text: &str, model: &Model) -> Result<Condition, String> {
    let unit = |figure: &str| unit_of(figure, model);
    let found = Condition::parse_with(text, &unit)?;
    let owner = found.figure.strip_suffix("in_working_order");
    let found = match (owner, found.relation, found.value) {
        (Some(owner), Relation::Equal | Relation::AtLeast, 1.0) => {
            let stated = format!("{owner}margin >= 0");
            let margin = Condition::parse_with(&stated, &unit)
                .map_err(|_| format!("`{text}`: there is no `{owner}margin` here to be held"))?;
            Condition {
                text: found.text,
                ..margin
            }
        }
        _ => found,
    };
    match found.has_slopes() {
        true => Ok(found),
        false => Err(format!(
            "`{text}`: `{}` counts or answers, and has no slopes; hold a result that changes \
             smoothly, for example `pair.margin >= 0`",
            found.figure
        )),
    }
}

/// Unit of a result of a run or study, or of one that comes with the derivatives alone.
fn unit_of(figure: &str, model: &Model) -> Result<String, String> {
    Condition::unit_of(figure, model).or_else(|what| figure_unit(figure, model).map_err(|_| what))
}

fn aim_option(aim: Aim) -> &'static str {
    match aim {
        Aim::Maximize => "maximize",
        Aim::Minimize => "minimize",
    }
}

fn goal(aim: Aim, of: &str, variables: &[Variable], model: &Model) -> Result<Goal, String> {
    let variable = variables.iter().find(|one| one.path == of);
    if variable.is_none() && counts(of) {
        return Err(format!(
            "--{} {of}: it counts or answers, and has no slopes; name a result that changes \
             smoothly",
            aim_option(aim)
        ));
    }
    let unit = match variable {
        Some(variable) => variable.unit.clone(),
        None => unit_of(of, model).map_err(|what| {
            format!(
                "--{} {of}: {what}; name a result, or a variable",
                aim_option(aim)
            )
        })?,
    };
    Ok(Goal {
        aim,
        of: of.to_owned(),
        is_parameter: variable.is_some(),
        unit,
    })
}

/// The figures of the goal and of the conditions, each once.
fn figures(goal: &Goal, conditions: &[Condition], model: &Model) -> Vec<AskedFigure> {
    let of_goal = (!goal.is_parameter).then_some((&goal.of, &goal.unit));
    let of_conditions = conditions.iter().map(|one| (&one.figure, &one.unit));
    let mut found: BTreeMap<&String, &String> = BTreeMap::new();
    found.extend(of_goal.into_iter().chain(of_conditions));
    let mut count = 0;
    let asked = |(address, unit): (&String, &String)| {
        let is_of_run = Condition::unit_of(address, model).is_ok();
        let index = is_of_run.then_some(count);
        count += usize::from(is_of_run);
        let name = names().iter().any(|name| {
            let rest = address.strip_suffix(name);
            rest.is_some_and(|rest| rest.ends_with('.'))
        });
        AskedFigure {
            address: address.clone(),
            unit: unit.clone(),
            index,
            smooth: name && figure_unit(address, model).is_ok(),
        }
    };
    found.into_iter().map(asked).collect()
}

/// The best optimum by a model one level finer.
fn finer_check(
    found: &Optimization,
    mut reading: Reading,
    levels: &Levels,
    control: &Control<'_>,
) -> FinerCheck {
    let mut check = FinerCheck::default();
    let refused = |check: FinerCheck, why_not: String| FinerCheck { why_not, ..check };
    // There is a finer model, and it does not confirm what was found.
    let failed = |check: FinerCheck, why_not: String| FinerCheck {
        why_not,
        stands: Some(false),
        ..check
    };
    let Some(best) = found.optima.first() else {
        return check;
    };
    reading.scene.elastic().set(&mut reading.scene, levels);
    let elastic = reading.scene.elastic();
    let refined = |(id, (_, level)): (&String, &(_, Option<Level>))| {
        let level = level.filter(|level| level.coordinates() > 0)?;
        Some((id.clone(), level.refined(2)?))
    };
    let refined: Levels = elastic.objects.iter().filter_map(refined).collect();
    if refined.is_empty() {
        let why = "no elastic object has masses or modes of which it could have more";
        return refused(check, why.to_owned());
    }
    check.levels = in_words(&refined);
    let finer = match ready(reading, &refined, control) {
        Ok(finer) => finer,
        Err(error) => return failed(check, error.to_string()),
    };
    let of_goal = (!found.goal.is_parameter).then_some(found.goal.of.as_str());
    let of_conditions = found.conditions.iter().map(|one| one.figure.as_str());
    let mut names: Vec<&str> = of_conditions.chain(of_goal).collect();
    names.sort_unstable();
    names.dedup();
    names.retain(|name| Condition::unit_of(name, finer.model()).is_ok());
    let figures = match figures_of(names, finer.subject(control)) {
        Ok(Some((figures, State::Computed))) => figures,
        Ok(Some((_, State::Refused(why) | State::Stopped(why) | State::NotTrusted(why)))) => {
            return failed(check, why);
        }
        Ok(None) => return refused(check, "ended before it was known".to_owned()),
        Err(faults) => {
            let first = faults.first().map_or("", |fault| fault.message.as_str());
            return failed(check, first.to_owned());
        }
    };
    let figure = |name: &str| figures.get(name).copied().flatten();
    check.goal = of_goal.and_then(figure);
    let mut unknown = of_goal.filter(|_| check.goal.is_none()).map(str::to_owned);
    for (own, condition) in found.conditions.iter().enumerate() {
        let Some(value) = figure(&condition.figure) else {
            unknown.get_or_insert_with(|| condition.figure.clone());
            continue;
        };
        let before = best.conditions[own].figure;
        let size = condition.value.abs().max(before.abs()).max(value.abs());
        let by = match condition.relation {
            Relation::Equal => (value - condition.value).abs(),
            Relation::AtMost | Relation::AtLeast => -condition.margin(value),
        };
        if by > FINER * size {
            check.violated.push(own);
        }
    }
    check.gain = gain(found, best.goal);
    check.moved = check.goal.map(|goal| (goal - best.goal).abs());
    // (A variable that is itself the goal does not move.)
    let moved = check.moved.unwrap_or(0.0);
    let most = check.gain.unwrap_or(MOVED * best.goal.abs());
    let stands = moved <= most && check.violated.is_empty();
    match unknown {
        Some(one) if stands => refused(check, format!("`{one}` has no value by it")),
        _ => FinerCheck {
            stands: Some(stands),
            ..check
        },
    }
}

/// What the optimum gains over the best start that meets the conditions where it begins.
fn gain(found: &Optimization, best: f64) -> Option<f64> {
    let begins = found
        .starts
        .iter()
        .filter_map(|start| start.progress.first());
    let begins = begins.filter(|(number, _)| *number == 1);
    let least = begins
        .map(|(_, goal)| (goal - best).abs())
        .fold(f64::MAX, f64::min);
    (least > 0.0 && least < f64::MAX).then_some(least)
}
