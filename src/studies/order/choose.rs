//! The least model that gives the figures asked for within their accuracy.

use super::certificate::{Certainty, Certificate};
use super::figure_limits::{FigureLimits, first_accurate_trial};
use super::integration::coarsest_tolerance;
use super::lessen::lessened;
use super::requested_figures::no_limit;
use super::row::{Families, Family};
use super::trial::Trials;
use crate::dynamics::builder::spec::Level;
use crate::fault::Fault;
use crate::frontend::lower::lower;
use crate::frontend::scene::{Levels, TypedScene};
use crate::studies::{Control, RunSettings, ToleranceOfAccuracy};

/// Looking for a lesser model may take so many times the dearest run.
const MOST_COST: f64 = 3.0;
/// Evaluations of a coordinate that cost next to nothing: some 10 ms.
const FREE_COST: f64 = 1e5;

/// The levels chosen, and what the figures are worth.
#[derive(Clone, Debug, PartialEq)]
pub struct LevelChoice {
    /// The level of every object that leaves it open.
    pub levels: Levels,
    /// Figures with their errors, objects with their levels.
    pub certificate: Certificate,
    /// The tolerance that the accuracy leaves to a run of this model, where nobody said one.
    pub of_accuracy: Option<ToleranceOfAccuracy>,
}

/// Chooses the levels of all objects that leave theirs open, and judges the figures that are
/// asked for. The scene is left with the levels chosen. `settings`: those of the run.
///
/// # Errors
/// The model cannot be built or started.
pub fn choose(
    scene: &mut TypedScene,
    settings: &RunSettings,
    control: &Control<'_>,
) -> Result<LevelChoice, Vec<Fault>> {
    choose_levels(&mut Trials::new(scene, settings, control))
}

fn choose_levels(trials: &mut Trials<'_>) -> Result<LevelChoice, Vec<Fault>> {
    let mut families = families(trials);
    let known = FigureLimits::of(trials, &mut families)?;
    let judge = known.judge();
    let mut found = first_accurate_trial(trials, &families, &known.row, &judge)?;
    if judge.accepts(trials, found) {
        found = lessened(trials, &families, &judge, found, |trials, _| !spent(trials));
    }
    let of_accuracy = coarsest_tolerance(trials, &judge, found)?;
    let levels = trials.made[found].levels.clone();
    let mut certificate = judge.certificate(trials, &families, found);
    let open: Vec<String> = trials.elastic.open_levels().cloned().collect();
    trials.elastic.clone().set(trials.scene, &levels);
    note_divergence(trials, found, &mut certificate)?;
    let levels = levels.into_iter().filter(|(id, _)| open.contains(id));
    Ok(LevelChoice {
        levels: levels.collect(),
        certificate,
        of_accuracy,
    })
}

/// Says of the model that was chosen why figures have no limit.
fn note_divergence(
    trials: &Trials<'_>,
    chosen: usize,
    certificate: &mut Certificate,
) -> Result<(), Vec<Fault>> {
    let model = lower(trials.scene)?;
    let figures = &trials.made[chosen].figures;
    for (figure, found) in &mut certificate.accuracy {
        if found.kind == Certainty::NoLimit {
            found.why = no_limit(trials.scene, &model, figure, figures).or(found.why.take());
        }
    }
    Ok(())
}

/// The levels that each elastic object goes through.
pub(in crate::studies) fn families(trials: &Trials<'_>) -> Families {
    let family = |id: &String, given: Option<Level>| match given {
        Some(level) => Family::Given(level),
        None => Family::of(trials, id),
    };
    let objects = trials.elastic.objects.iter();
    objects
        .map(|(id, (_, given))| (id.clone(), family(id, *given)))
        .collect()
}

/// The level of two that models more of an object; of modes and masses the masses, which hold
/// in any pair. (How many of them do what the modes did is another question.)
pub fn finer(one: Level, other: Level) -> Level {
    let rank = |level: Level| {
        let family = match level {
            Level::Rigid => 0,
            Level::Static => 1,
            Level::Modes { .. } => 2,
            // (Modes without a contact element hold for a pair that stays closed alone.)
            Level::Masses { .. } => 3,
        };
        (family, level.coordinates())
    };
    match rank(other) > rank(one) {
        true => other,
        false => one,
    }
}

/// True when looking for a lesser model has taken as long as it may.
fn spent(trials: &Trials<'_>) -> bool {
    let costs = || trials.made.iter().map(|trial| trial.cost);
    let dearest = costs().fold(0.0, f64::max);
    costs().sum::<f64>() > MOST_COST * dearest + FREE_COST
}

#[cfg(test)]
mod tests {
    use super::{FREE_COST, MOST_COST, Trials, choose_levels};
    use crate::frontend::scene::{BuiltIn, Document, Overrides};
    use crate::studies::{Control, RunSettings};

    /// A rod behind a drive, with more of its properties.
    fn rod(drive: &str, one: &str, run: &str) -> String {
        format!(
            r#"{{ "dam": 1, "name": "Cost", "objects": {{
                "drive": {{ "kind": "drive", {drive} }},
                "one": {{ "kind": "slider", "input": "drive", "inertia": 1, "stiffness": 1, "masses": "auto", {one} }} }},
                "run": {{ "samples": 10, {run}, "accuracy": {{ "one.delta_abs": "1 %" }} }} }}"#
        )
    }

    #[test]
    fn choosing_costs_no_more_than_three_of_the_dearest_run() {
        let sine = r#""position": { "sine": { "amplitude": 1 } }"#;
        let scenes = [
            (r#""motion": { "speed": 0.3 }"#, String::new()),
            (
                r#""motion": { "speed": 0.3 }"#,
                r#", "damping_capacity": 0.5, "pair": { "closure": "form", "gap": 0.1 }"#
                    .to_owned(),
            ),
            (
                r#""motor": { "inertia": 1, "torque": { "constant": 0.1 } }"#,
                r#", "damping_capacity": 0.2"#.to_owned(),
            ),
        ];
        for (drive, more) in scenes {
            let text = rod(drive, &format!("{sine}{more}"), r#""duration": 60"#);
            let document = Document::parse("scene.json", text.as_bytes()).unwrap();
            let mut reading = document.scene(&BuiltIn, &Overrides::none()).unwrap();
            let settings = RunSettings::of(&reading.scene).unwrap();
            let control = Control::default();
            let mut trials = Trials::new(&mut reading.scene, &settings, &control);
            choose_levels(&mut trials).unwrap();
            assert!(trials.made.len() > 2, "{text}");
            let costs = || trials.made.iter().map(|trial| trial.cost);
            let (all, dearest) = (costs().sum::<f64>(), costs().fold(0.0, f64::max));
            assert!(
                all <= MOST_COST * dearest + FREE_COST,
                "{all} {dearest} {text}"
            );
        }
    }
}
