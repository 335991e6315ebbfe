//! All methods at all their settings.

use super::attempt::{Attempt, Effort, Problem};
use super::doubt::Doubt;
use super::light::tracks;
use super::limit::{StabilityLimit, too_long};
use super::line::MethodLine;
use super::models::Models;
use super::point::Point;
use super::recommend::{Recommendation, recommend};
use super::reference::{Distance, NoReference, Reference, ReferenceInUse, find};
use super::setting::{Setting, all_methods, is_fixed_step, ladder};
use super::stability::{Spectrum, degree, remark};
use super::verdict::{Verdict, judge};
use crate::dynamics::integrate::Method;
use crate::dynamics::system::{InitialState, System};
use crate::fault::Fault;
use crate::studies::judgement::{Judgement as Working, RunEnd};
use crate::studies::run::settings_until_condition;
use crate::studies::{Control, RunSettings};
use serde::Serialize;
use std::time::Duration;

/// Plan of a study: what to try.
#[derive(Clone, Debug, PartialEq)]
pub struct Plan {
    /// Error of δ wanted, relative to max|δ|.
    pub accuracy: f64,
    /// The methods.
    pub methods: Vec<Method>,
    /// True: errors are taken against `exact` where it applies, even if it is
    /// not among the methods; false: against one of them only.
    pub exact_beside: bool,
    /// Tolerances, the coarsest first.
    pub tolerances: Vec<f64>,
    /// Steps of methods of fixed step (s), the longest first; `None`: from just
    /// beyond the greatest stable step downwards.
    pub steps: Option<Vec<f64>>,
    /// Timed runs of a point at most.
    pub repeats: usize,
    /// Longest time of a point.
    pub point_limit: Duration,
}

impl Plan {
    /// All methods at tolerances from 1e-3 to 1e-13, five repetitions, at most
    /// five seconds a point.
    pub fn new(accuracy: f64) -> Self {
        Self {
            accuracy,
            methods: all_methods(),
            exact_beside: true,
            tolerances: (3..=13).map(|digits| 10f64.powi(-digits)).collect(),
            steps: None,
            repeats: 5,
            point_limit: Duration::from_secs(5),
        }
    }
}

/// Progress: what is being done, for whoever waits.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Now {
    /// Points done.
    pub done: usize,
    /// Points in all, at most.
    pub total: usize,
    /// The method under way.
    pub method: Method,
    /// Setting of the method.
    pub setting: Setting,
}

/// Speed against accuracy of all methods on one scene.
#[derive(Clone, Debug, PartialEq, Serialize)]
pub struct Study {
    /// Version of the document: 1.
    pub dam: u32,
    /// Name of the scene.
    pub scene: String,
    /// Hash of the canonical scene.
    pub hash: String,
    /// Error of δ wanted, relative to max|δ|.
    pub accuracy: f64,
    /// False when interrupted: what is there was done until then.
    pub complete: bool,
    /// The verdict: a doubt about the reference takes all trust; the mechanism is not judged.
    pub verdict: Working,
    /// Simulated time (s).
    pub duration: f64,
    /// Samples of δ in a run.
    pub samples: usize,
    /// Greatest rate |λ| of the system (1/s), all pairs engaged.
    pub fastest_rate: f64,
    /// Reference that errors are taken against; null when it cannot be known.
    pub reference: Option<Reference>,
    /// Doubt about the reference: two methods agree with each other and not with it. Then
    /// there is no reference, nothing is judged, and nothing is recommended.
    #[serde(skip_serializing_if = "Option::is_none")]
    pub doubt: Option<Doubt>,
    /// What is known of single methods on such a scene, beside what was measured.
    #[serde(skip_serializing_if = "Vec::is_empty")]
    pub cautions: Vec<String>,
    /// Where there is no reference: how far the finest points are apart.
    pub mutual_distances: Vec<Distance>,
    /// Lines, one a method.
    pub methods: Vec<MethodLine>,
    /// Recommendation which method to take.
    pub recommendation: Recommendation,
    /// Errors of the models of the scene, where they were asked for.
    #[serde(skip_serializing_if = "Option::is_none")]
    pub models: Option<Models>,
}

impl Study {
    /// The study with the errors of the models: the recommendation names model, method and
    /// tolerance together.
    #[must_use]
    pub fn with_models(mut self, models: Models) -> Self {
        self.recommendation = recommendation(&self.methods, self.accuracy, self.doubt.as_ref());
        let method = &self.recommendation.text;
        self.recommendation.text = format!("{}; {method}", models.sentence());
        self.models = Some(models);
        self
    }
}

/// Tries every method of a plan on a system; `progress` hears of every point.
///
/// # Errors
/// The start cannot be found, or there is nothing to integrate.
pub fn study(
    system: &System,
    settings: &RunSettings,
    plan: &Plan,
    control: &Control<'_>,
    progress: &mut dyn FnMut(&Now),
) -> Result<Study, Vec<Fault>> {
    let settings = &settings_until_condition(system, settings, control)?;
    let tracks = tracks(system);
    let initial = start(system)?;
    let problem = Problem {
        system,
        initial: &initial,
        tracks: &tracks,
        settings,
    };
    let effort = Effort {
        repeats: plan.repeats,
        limit: plan.point_limit,
        control: *control,
    };
    let coordinates = crate::dynamics::integrate::Dynamics::coordinates(system);
    let spectrum = Spectrum::of(system, coordinates);
    let beside = exact_attempt(&problem, plan, &effort);
    let (own, complete) = attempts(&problem, plan, &spectrum, &effort, progress);
    let attempts: Vec<Attempt> = beside.into_iter().chain(own).collect();
    // What was done before an interrupt is still judged; no limits are measured.
    let control = match complete {
        true => *control,
        false => Control::FREE,
    };
    let effort = Effort { control, ..effort };
    let found = find(&problem, &attempts, &effort);
    let mut methods = lines(system, plan, &spectrum, &attempts, &found);
    if let (Ok(truth), true) = (&found, complete) {
        measure_limits(&problem, &spectrum, truth, &mut methods, &effort);
    }
    let (reference, unknown) = match found {
        Ok(truth) => (Some(truth.public), NoReference::default()),
        Err(unknown) => (None, unknown),
    };
    Ok(Study {
        dam: 1,
        scene: settings.scene.clone(),
        hash: settings.hash.clone(),
        accuracy: plan.accuracy,
        complete,
        verdict: judge_working(complete, unknown.doubt.is_some()),
        duration: settings.duration,
        samples: settings.samples,
        fastest_rate: spectrum.fastest,
        reference,
        mutual_distances: unknown.distances,
        recommendation: recommendation(&methods, plan.accuracy, unknown.doubt.as_ref()),
        doubt: unknown.doubt,
        cautions: cautions(system),
        methods,
        models: None,
    })
}

/// The verdict of a study of methods, which says nothing of the mechanism.
pub(super) fn judge_working(complete: bool, doubted: bool) -> Working {
    let ending = match (doubted, complete) {
        (true, _) => RunEnd::OfComputation,
        (false, false) => RunEnd::FromOutside,
        (false, true) => RunEnd::Complete,
    };
    Working::judge_result(ending, &[], || Working::NotJudged)
}

/// What is known of methods beforehand: what a short run need not show.
fn cautions(system: &System) -> Vec<String> {
    let friction = system.has_multi_input_friction();
    let caution = "With joint friction of a linkage of several inputs radau is slow near singular \
                   positions, and rodas5p may not finish. There dop853 is faster.";
    friction.then(|| caution.to_owned()).into_iter().collect()
}

/// Recommendation; none where the reference is in doubt.
fn recommendation(lines: &[MethodLine], accuracy: f64, doubt: Option<&Doubt>) -> Recommendation {
    let mut found = recommend(lines, accuracy);
    if let Some(doubt) = doubt {
        found.text = format!("{}; no method is recommended", doubt.sentence());
    }
    found
}

/// The start of a system that there is something to study in.
///
/// # Errors
/// The same as those of [`study`].
pub(super) fn start(system: &System) -> Result<InitialState, Vec<Fault>> {
    match tracks(system).is_empty() {
        true => Err(vec![nothing_to_choose()]),
        false => system.initial_state(),
    }
}

fn nothing_to_choose() -> Fault {
    Fault::new(
        "objects",
        "nothing in the scene is elastic or driven by a motor: the motion follows from the \
         drives, and there is no method to choose",
        "give an object `masses` and a `stiffness`",
    )
}

/// The exact motion beside the methods of a plan that does not name it.
fn exact_attempt(problem: &Problem<'_>, plan: &Plan, effort: &Effort<'_>) -> Option<Attempt> {
    let wanted = plan.exact_beside && !plan.methods.contains(&Method::Exact);
    wanted.then(|| Attempt::untimed(problem, Method::Exact, Setting::Exact, effort))
}

/// Runs all points; false: interrupted.
fn attempts(
    problem: &Problem<'_>,
    plan: &Plan,
    spectrum: &Spectrum,
    effort: &Effort<'_>,
    progress: &mut dyn FnMut(&Now),
) -> (Vec<Attempt>, bool) {
    let duration = problem.settings.duration;
    let steps = plan.steps.as_deref();
    let ladders: Vec<(Method, Vec<Setting>)> = plan
        .methods
        .iter()
        .map(|&method| {
            (
                method,
                ladder(method, &plan.tolerances, steps, spectrum, duration),
            )
        })
        .collect();
    let total = ladders.iter().map(|(_, ladder)| ladder.len()).sum();
    let mut attempts = Vec::new();
    let mut done = 0;
    for (method, ladder) in ladders {
        let rungs = ladder.len();
        for (rung, setting) in ladder.into_iter().enumerate() {
            progress(&Now {
                done: done + rung,
                total,
                method,
                setting,
            });
            let attempt = Attempt::new(problem, method, setting, effort);
            if attempt.was_interrupted() || effort.control.is_spent() {
                return (attempts, false);
            }
            let last = attempt.ends_ladder();
            attempts.push(attempt);
            if last {
                break;
            }
        }
        done += rungs;
    }
    (attempts, true)
}

/// Judges all points.
fn lines(
    system: &System,
    plan: &Plan,
    spectrum: &Spectrum,
    attempts: &[Attempt],
    found: &Result<ReferenceInUse, NoReference>,
) -> Vec<MethodLine> {
    let truth = found.as_ref().ok();
    let doubt = found
        .as_ref()
        .err()
        .and_then(|unknown| unknown.doubt.as_ref());
    let line = |&method: &Method| {
        let bound = spectrum.bound_at(method, plan.accuracy);
        let stability = match degree(method, plan.accuracy) {
            Some(degree) => StabilityLimit::of_series(system, bound.as_ref(), degree),
            None => StabilityLimit::by_theory(bound.as_ref(), remark(method)),
        };
        let point = |(index, attempt): (usize, &Attempt)| {
            let tolerance = attempt.setting.tolerance().unwrap_or(plan.accuracy);
            let bound = spectrum.bound_at(method, tolerance);
            let bound = bound.as_ref();
            let mut judged = judge(attempt, truth, plan.accuracy, bound);
            if let (Verdict::NotJudged, Some(doubt)) = (judged.verdict, doubt) {
                judged.cause = format!("the reference {} is in doubt", doubt.reference);
            }
            let is_reference = truth.is_some_and(|truth| truth.index == index);
            Point::new(attempt, judged, truth, bound, is_reference)
        };
        let own = attempts.iter().enumerate();
        MethodLine {
            method,
            fixed_step: is_fixed_step(method),
            stability,
            points: own
                .filter(|(_, attempt)| attempt.method == method)
                .map(point)
                .collect(),
        }
    };
    let lines = plan.methods.iter().map(line);
    lines.filter(|line| !line.points.is_empty()).collect()
}

/// Measures the greatest stable steps of the methods of fixed step.
fn measure_limits(
    problem: &Problem<'_>,
    spectrum: &Spectrum,
    truth: &ReferenceInUse,
    lines: &mut [MethodLine],
    effort: &Effort<'_>,
) {
    for line in lines.iter_mut().filter(|line| line.fixed_step) {
        let tried: Vec<(f64, bool)> = line
            .points
            .iter()
            .filter_map(|point| Some((point.longest_step?, too_long(point.verdict))))
            .collect();
        let bound = spectrum.bound(line.method);
        let (method, stability) = (line.method, &mut line.stability);
        stability.measure(problem, method, truth, bound.as_ref(), &tried, effort);
    }
}
