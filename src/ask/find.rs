//! The best value of a parameter under conditions.

use super::Mechanism;
use crate::Error;
use crate::dynamics::model::Model;
use crate::frontend::diagnostics::{Diagnostic, Diagnostics, Sources};
use crate::studies::condition::Condition;
use crate::studies::find::{
    Aim, FigureValues, FoundValue, Goal, Sample, Span, State, figures_of, search,
};
use crate::studies::rigid::Rigid;
use crate::studies::side_by_side::{side_by_side, threads as number_of_threads};
use crate::studies::{Control, lookup};
use std::collections::BTreeMap;
use std::sync::atomic::{AtomicUsize, Ordering};
use std::sync::{Mutex, PoisonError};

/// What is sought.
#[derive(Clone, Debug, Default)]
pub struct FindQuestion {
    /// The parameter and its range: `shaft.motion.speed=100:900 rpm`, with `:PLACES` for another
    /// number of places that are looked at first, and `:log` for equal ratios between them.
    pub vary: String,
    /// Conditions on figures: `valve.delta_abs <= 0.2 mm`.
    pub subject: Vec<String>,
    /// Which end is sought, and of what: the address of the parameter, or of a figure. `None`: all
    /// ranges in which the conditions hold.
    pub goal: Option<(Aim, String)>,
    /// Number of threads; default: one for every processor core. Results do not depend on it.
    pub threads: Option<usize>,
}

/// Makes the scene ready with further settings.
type Prepare<'p> = dyn Fn(&[String]) -> Result<Mechanism, Error> + Sync + 'p;

/// Finds the best value. `prepare`: the scene with further settings made ready; `heard`: told the
/// number of places that were looked at, from any thread.
///
/// # Errors
/// As of [`Scene::find`](super::Scene::find).
pub(crate) fn find(
    question: &FindQuestion,
    prepare: &Prepare<'_>,
    control: &Control<'_>,
    heard: &(dyn Fn(usize) + Sync),
) -> Result<FoundValue, Error> {
    let span =
        Span::parse(&question.vary).map_err(|what| Error::question(format!("--vary {what}")))?;
    let (span, ready) = first_mechanism(span, prepare)?;
    let model = ready.model();
    let (conditions, goal) = resolved(question, &span, model)?;
    let places = Evaluation {
        span: &span,
        conditions: &conditions,
        goal: goal
            .as_ref()
            .filter(|goal| !goal.is_parameter)
            .map(|goal| goal.of.as_str()),
        prepare,
        control,
        heard,
        looked: AtomicUsize::new(0),
    };
    let threads = number_of_threads(question.threads);
    let evaluate = |shares: &[f64]| places.evaluate(shares, threads);
    let found = search(&span, &conditions, goal.as_ref(), &evaluate);
    let figures = places.figures();
    let is_rigid = figures.iter().any(|figure| lookup::is_rigid(figure));
    let rigid = Rigid::label(model, &["dam run"]).filter(|_| is_rigid);
    Ok(FoundValue {
        unit: span.axis.display_unit(model),
        span,
        conditions,
        goal,
        found,
        rigid,
    })
}

/// The scene at the first of a few places at which it is a mechanism; a parameter that counts has
/// a range of whole numbers.
fn first_mechanism(span: Span, prepare: &Prepare<'_>) -> Result<(Span, Mechanism), Error> {
    let at = |span: &Span, share: f64| prepare(&[span.axis.setting(span.value(share))]);
    // (Between the ends no parameter is whole by chance.)
    let counts = |error: &Error| error.faults().iter().any(Diagnostic::is_of_a_count);
    let span = match at(&span, 0.4321) {
        Ok(ready) => return Ok((span, ready)),
        Err(error) if counts(&error) => span.counting().map_err(Error::question)?,
        Err(_) => span,
    };
    let mut first = None;
    for share in [0.0, 1.0, 0.5, 0.25, 0.75] {
        match at(&span, share) {
            Ok(ready) => return Ok((span, ready)),
            Err(error) => first = first.or(Some(error)),
        }
    }
    Err(first.unwrap_or_else(|| Error::question("the scene is wrong")))
}

/// The conditions and the goal of a question; all that is wrong with them at once.
fn resolved(
    question: &FindQuestion,
    span: &Span,
    model: &Model,
) -> Result<(Vec<Condition>, Option<Goal>), Error> {
    let mut wrong = Vec::new();
    let mut conditions = Vec::new();
    for text in &question.subject {
        match Condition::parse(text, model) {
            Ok(condition) => conditions.push(condition),
            Err(what) => wrong.push(format!("--subject {what}")),
        }
    }
    if conditions.iter().filter(|one| one.is_equality()).count() > 1 {
        wrong.push(
            "--subject: one parameter can meet one `=` alone; write the others with `<=` or `>=`"
                .to_owned(),
        );
    }
    let goal = question
        .goal
        .as_ref()
        .map(|(aim, of)| goal(*aim, of, span, model));
    let goal = match goal.transpose() {
        Ok(goal) => goal,
        Err(what) => {
            wrong.push(what);
            None
        }
    };
    if question.goal.is_none() && question.subject.is_empty() {
        wrong.push(
            "nothing is sought: name conditions with --subject, or what is to be best with \
             --maximize or --minimize"
                .to_owned(),
        );
    }
    match wrong.is_empty() {
        true => Ok((conditions, goal)),
        false => {
            let faults = wrong
                .into_iter()
                .map(|what| Diagnostic::error("question", what));
            Err(Diagnostics::new(Sources::default(), faults.collect()).into())
        }
    }
}

fn goal(aim: Aim, of: &str, span: &Span, model: &Model) -> Result<Goal, String> {
    let is_parameter = of == span.axis.path;
    let unit = match is_parameter {
        true => span.axis.display_unit(model),
        false => Condition::unit_of(of, model).map_err(|what| {
            let option = match aim {
                Aim::Maximize => "--maximize",
                Aim::Minimize => "--minimize",
            };
            format!(
                "{option} {of}: {what}; name a result, or the parameter `{}`",
                span.axis.path
            )
        })?,
    };
    Ok(Goal {
        aim,
        of: of.to_owned(),
        is_parameter,
        unit,
    })
}

/// Evaluation of the scene at the places of a range.
struct Evaluation<'p> {
    span: &'p Span,
    conditions: &'p [Condition],
    /// A figure that is to be best.
    goal: Option<&'p str>,
    prepare: &'p Prepare<'p>,
    control: &'p Control<'p>,
    heard: &'p (dyn Fn(usize) + Sync),
    looked: AtomicUsize,
}

impl Evaluation<'_> {
    /// All figures that are asked for, each once.
    fn figures(&self) -> Vec<&str> {
        let of_conditions = self.conditions.iter().map(|one| one.figure.as_str());
        let mut all: Vec<&str> = of_conditions.chain(self.goal).collect();
        all.sort_unstable();
        all.dedup();
        all
    }

    /// The scene at several places, worked out side by side; fewer where it was ended from outside.
    fn evaluate(&self, shares: &[f64], threads: usize) -> Vec<Sample> {
        let found: Mutex<BTreeMap<usize, Option<Sample>>> = Mutex::default();
        let take = |(): &mut (), at: usize| {
            if self.control.is_spent() {
                return false;
            }
            let sample = self.sample(shares[at]);
            (self.heard)(self.looked.fetch_add(1, Ordering::Relaxed) + 1);
            let mut found = found.lock().unwrap_or_else(PoisonError::into_inner);
            found.insert(at, sample);
            true
        };
        side_by_side(shares.len(), threads, || (), take);
        let found = found.into_inner().unwrap_or_else(PoisonError::into_inner);
        found.into_values().flatten().collect()
    }

    /// The scene at one place; `None`: ended from outside.
    fn sample(&self, share: f64) -> Option<Sample> {
        let value = self.span.value(share);
        let (found, state) = match self.figures_at(value) {
            Ok(Some(found)) => found,
            Ok(None) => return None,
            Err(error) => (BTreeMap::new(), State::Refused(first_message(&error))),
        };
        let figure = |name: &str| found.get(name).copied().flatten();
        let goal = match self.goal {
            Some(name) => figure(name),
            None => Some(value),
        };
        let figures = self
            .conditions
            .iter()
            .map(|one| figure(&one.figure))
            .collect();
        Some(Sample {
            share,
            value,
            goal,
            figures,
            state,
        })
    }

    /// The figures at a value of the parameter, and what became of the scene; `None`: ended from
    /// outside.
    fn figures_at(&self, value: f64) -> Result<Option<FigureValues<'_>>, Error> {
        let ready = (self.prepare)(&[self.span.axis.setting(value)])?;
        let found = figures_of(self.figures(), ready.subject(self.control));
        found.map_err(|faults| ready.diagnose(&faults))
    }
}

fn first_message(error: &Error) -> String {
    let first = error.faults().first();
    first.map_or_else(
        || "the scene is wrong".to_owned(),
        |fault| fault.message.clone(),
    )
}
